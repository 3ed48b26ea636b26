"""A class of simulated students: honest hands and hands that make mistakes on purpose, drawn and marked.

A roster and a table of the class go in, as a teacher does it; marks and mistakes come out.
What is counted, of the lines that a student has written and of the first explanation that the report gives:

right lines
    Lines of honest students that pass.
first wrong step
    The line named first is one that the mistake moves (by half a tolerance or more), and stands no later than the
    first line that it moves clearly (by two). Tolerances are those of the simulation (`moved`).
named
    The number of the mistake is that of the first explanation, or of one reported with it as not to be told apart.
    Of two mistakes both are.
wrong name
    There is an explanation, and the first one does not have the number.
unnoticed
    No line at all is wrong.

A mistake is planted only where it moves a line clearly: one within the tolerances cannot be seen.
"""

from __future__ import annotations

import math
import random
import tempfile
from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path

from kulman import check, load_task
from kulman.variants.marking.marked import Desk, Marked

from .answer_files import write
from .drawn_by_hand import Hand, Line, Sheet, Slip, named_value
from .drawn_mechanisms import MECHANISMS, Givens

SEED = 9
POOL = 48  # random variants of a task
PATTERNS = 24  # honest drawings from which the spread of a line is known
TOLERATED = 2.0, 0.05  # mm of a segment, part of a value
SPREADS = 3.0  # rms of an honest hand that are no mistake
LEAST_MM = 12.0  # of the vectors of the crank pin: who has shorter ones takes another scale, or sees the mistake
CLEAR = 2.0  # tolerances by which a mistake moves at least one line, or it is not planted
NOTHING = Line(0.0)
TRIES, FEW = 300, 40  # at variants on which mistakes show; at those that are wanted first
TOUCHED = 0.5  # tolerances by which a line is moved at all
SYMBOLS = {"velocity": "mu_V", "acceleration": "mu_a"}
SCALE_SLIPS = {"M14", "M15", "M16", "M17", "M20", "M56", "M68", "M74"}


# the mistakes that are made: a number of the list, and places where it is made, each with one of several ways
COMMON = """
    M01; M02; M03; M04; M05; M06; M08; M09; M11; M23; M37; M61; M77; M07: =2, =0.5; M10: =30, =-30; M14: velocity,
    acceleration; M15: velocity=acceleration, acceleration=velocity; M24: =out, =in
"""
MADE = {
    "nau-slider-crank": """
    M16: a_BA_n; M17: omega_2, epsilon_2; M20: V_B, V_BA, a_B, a_S2, R_12; M21; M22: V_B, V_BA, V_S2, a_B, a_BA_t,
    a_S2; M25: V_BA; M26: V_BA; M27: velocity V_BA; M28: omega_2=V_B; M29: omega_2; M30: V_S2; M31: velocity V_S2;
    M38: a_BA_n; M39: a_BA_n; M40: a_BA_n=V_B, a_BA_n=omega_1; M41: a_BA_n=v/l, a_BA_n=v*l; M42: a_BA_t; M43:
    epsilon_2=a_BA; M44: epsilon_2=a_B; M45: epsilon_2; M53; M55: a_S2; M56: a_B; M57: F_i2, F_i3; M58: F_i2, F_i3,
    F_3; M59: F_i2, F_i3, F_3; M60: M_i2=none, M_i2=sign; M62: F_i2=first, F_i2=middle; M63: F_i2, F_i3; M65; M66:
    h_2, h_21; M67: h_2; M68: R_12_t; M69: R_12_t; M70: R_12=R_12_n; M73; M74: mu_F_1=mu_F_23; M75: R_12, R_03,
    R_32; M76; M78: F_i2=B, F_i2=A; M79: M_i2=none, M_i2=whole; M80: M_i2; M82; M115: a_A, a_BA_n; M116: a_A,
    a_BA_n; M117: omega_2=crank, omega_2=l_AS2, epsilon_2=crank, epsilon_2=l_AS2; M118: R_12_t F_i2, lever F_i2,
    lever F_i3; M120: h_lever_F_i2; M121: a_BA_t; M122: F_i2=a_B, F_i2=a_A, F_i3=a_S2; M123: V_B, V_BA, omega_2,
    a_BA_n, a_B, a_S2, F_i2, R_12, M_bal, epsilon_2; M124
""",
    "madi-four-bar": """
    M13: l_BC=l_DC; M16: a_CB_n, a_C_n; M17: omega_2, omega_3, epsilon_3; M20: V_C, V_CB, a_C, a_S2, R_12; M21; M22:
    V_C, V_CB, V_S2, a_C, a_CB_t, a_S2; M25: V_CB, V_C; M26: V_CB; M28: omega_2=V_C; M29: omega_2, omega_3; M38:
    a_CB_n, a_C_n; M39: a_CB_n, a_C_n; M40: a_CB_n=V_C, a_CB_n=omega_1, a_C_n=V_CB; M41: a_CB_n=v/l, a_C_n=v*l; M42:
    a_CB_t; M43: epsilon_2=a_CB, epsilon_3=a_C; M44: epsilon_2=a_C; M45: epsilon_2, epsilon_3; M47: a_C_n; M56: a_C;
    M57: F_i2, F_i3; M58: F_i2, F_i3; M59: F_i2, F_i3; M60: M_i2=none, M_i2=sign; M62: F_i2=first, F_i2=second,
    F_i3=first, F_i3=second; M63: F_i2, F_i3; M65; M66: h_2, h_3, h_21; M67: h_2, h_3; M68: R_12_t, R_03_t; M69:
    R_12_t, R_03_t; M70: R_12=R_12_n, R_03=R_03_n; M74: mu_F_1=mu_F_23; M75: R_12, R_03, R_32; M76; M78: F_i2=C,
    F_i2=B, F_i3=C; M79: M_i2=none, M_sum=none, M_i2=whole; M80: M_i2, M_sum; M115: a_B, a_CB_n, a_C_n; M116: a_B,
    a_CB_n, a_C_n; M117: omega_2=l_DC, omega_3=l_BC, epsilon_2=l_DC, epsilon_3=crank; M118: R_12_t F_i2, R_03_t
    F_i3, lever F_i2, lever F_i3; M119: =M_i3, =M_3; M120: h_lever_F_i2, h_lever_F_i3; M121: a_CB_t; M122: F_i2=a_C,
    F_i2=a_B, F_i3=a_C; M123: V_C, V_CB, omega_3, a_C_n, a_C, a_S2, F_i2, R_12, F_bal, epsilon_3
""",
    "scheme-09-shaper": """
    M12; M21; M33; M34; M35; M48; M49; M50; M52; M72; M73; M82; M124; M16: a_A3C_n; M17: omega_3, omega_4,
    epsilon_3; M20: V_A3A2, V_E, a_A3, a_E, R_34; M22: V_E, V_A3C, V_A3A2, a_E, a_A3A2_r; M28: omega_3=V_A,
    omega_4=V_E; M29: omega_3, omega_4; M38: a_ED_n; M39: a_ED_n; M40: a_A3C_n=V_A, a_A3C_n=omega_1; M43:
    epsilon_4=a_ED; M44: epsilon_3=a_A3, epsilon_4=a_E; M45: epsilon_3, epsilon_4; M51: =omega, =V_A; M54:
    a_A3C_n=none, a_A3C_n=away; M56: a_E; M58: F_5, G_5, R_43; M59: F_5, G_5, R_43; M63: G_3, G_4, G_5, F_i5; M65;
    M66: h_43, h_G_3, h_21; M69: R_12_t, R_34_t; M70: R_34=R_34_t; M71: R_43; M74: mu_F_23=mu_F_45, mu_F_1=mu_F_23;
    M75: R_05, R_34, R_03; M76; M115: a_A, a_A3C_n, a_ED_n; M116: a_A, a_A3C_n; M117: omega_3=l_CD, omega_3=l_OC,
    epsilon_3=l_CD, omega_4=l_CD; M118: R_12_t R_43, R_12_t G_3; M123: V_A3C, V_A3A2, omega_3, a_A3A2_k, a_E, R_34,
    R_12_t, M_bal
""",
}


def planned(text: str) -> list[Slip]:
    """Return the mistakes of a text such as `M07: =2, =0.5; M16: a_BA_n; M21`."""
    found = []
    for entry in " ".join(text.split()).split(";"):
        id, _, places = entry.partition(":")
        found += [Slip(id.strip(), *place.strip().partition("=")[::2]) for place in places.split(",")]
    return found


SLIPS = {task: planned(f"{COMMON};{text}") for task, text in MADE.items()}
ALIKE = {  # other names of the same mistake at these places
    "M47": {"M39"},
    "M60": {"M119"},
    "M39": {"M47", "M54"},
    "M38": {"M54"},
    "M54": {"M38", "M39"},
    "M119": {"M58", "M60"},
    "M120": {"M66"},
}


@dataclass(frozen=True, slots=True, eq=False)
class Data:
    """One variant: what a roster says of it, and the givens in SI as the drawing takes them."""

    settings: dict[str, str]
    givens: Givens


def data_of(task: str, written: dict[str, float], turn: int, side: int) -> Data:
    """Return a variant of values as they are printed: mm, degrees, rpm, kg, kN."""
    crank = "l_AB" if task == "madi-four-bar" else "l_OA"
    units = {"phi": "deg", "n_1": "rpm", "m": "kg", "J": "kg*m^2", "F": "kN", "M": "N*m", "q": "kg/m"}
    factors = {"l": 1e-3, "y": 1e-3, "F": 1e3}
    givens = {name: value * factors.get(name[0], 1.0) for name, value in written.items()}
    givens["crank"] = givens.pop(crank)
    settings = {name: f"{value:.10g} {units.get(name, units.get(name[0], 'mm'))}" for name, value in written.items()}
    if task != "scheme-09-shaper":
        settings["rotation"] = "ccw" if turn > 0 else "cw"
    if task == "nau-slider-crank":
        settings["side"] = "right" if side > 0 else "left"
    return Data(settings, {**givens, "turn": turn, "side": side, "press": -side})


@cache
def pool(task: str) -> tuple[Data, ...]:
    """Return the random variants from which students have theirs."""
    dice = random.Random(f"{SEED} {task}")
    return tuple(random_data(task, dice) for _ in range(POOL))


def random_data(task: str, dice: random.Random) -> Data:
    """Return a random variant whose plans can be drawn well: no line meets another under less than 24 degrees."""
    while True:
        data = {"nau-slider-crank": _slider, "madi-four-bar": _four_bar, "scheme-09-shaper": _shaper}[task](dice)
        try:
            sheet = exact(task, data.givens)
        except ValueError:
            continue
        well = all(abs(sheet.size(name)) > part * sheet.size(of) for name, of, part in WELL_DRAWN[task])
        if well and (task != "madi-four-bar" or _meets(sheet)):
            return data


WELL_DRAWN = {  # what is not much smaller than what
    "nau-slider-crank": [("V_B", "V_A", 0.15), ("V_BA", "V_A", 0.15)],
    "madi-four-bar": [("V_C", "V_B", 0.15), ("V_CB", "V_B", 0.15)],
    "scheme-09-shaper": [("V_A3", "V_A", 0.25), ("V_A3A2", "V_A", 0.15), ("V_E", "V_A", 0.15)],
}


def _meets(sheet: Sheet) -> bool:
    tangents = sheet.lines["a_CB_t"].vector, sheet.lines["a_C_t"].vector
    a, b = (complex(v or 0j) for v in tangents)
    return abs((a.conjugate() * b).imag) > 0.4 * abs(a) * abs(b)


def _slider(dice: random.Random) -> Data:
    crank = dice.randrange(25, 51)
    rod = round(crank * dice.uniform(3.6, 5.2))
    m_2 = dice.randrange(8, 41) / 10
    written = {
        "phi": 5.0 * dice.randrange(72),
        "l_OA": crank,
        "l_AB": rod,
        "l_AS2": round(rod * dice.uniform(0.3, 0.45)),
        "n_1": 10.0 * dice.randrange(80, 200),
        "m_2": m_2,
        "m_3": round(m_2 * dice.uniform(0.7, 0.95), 1),
        "J_S2": float(f"{m_2 * rod * rod * 1e-6 * dice.uniform(0.1, 0.3):.2g}"),
        "F_3": dice.randrange(15, 61) / 10,
    }
    return data_of("nau-slider-crank", written, dice.choice((-1, 1)), dice.choice((-1, 1)))


def _four_bar(dice: random.Random) -> Data:
    lengths = {"l_AD": 510, "l_AB": 120, "l_BC": 480, "l_DC": 380}
    written = {name: round(length * dice.uniform(0.9, 1.1)) for name, length in lengths.items()}
    written |= {"l_AS1": written["l_AB"] / 2, "l_BS2": written["l_BC"] / 2, "l_DS3": written["l_DC"] / 2}
    for number, link in enumerate(("l_AB", "l_BC", "l_DC"), start=1):
        mass = round(10.0 * written[link] * 1e-3 * dice.uniform(0.8, 1.2), 1)
        written |= {f"m_{number}": mass, f"J_S{number}": float(f"{mass * (written[link] * 1e-3) ** 2 / 12.0:.3g}")}
    written |= {"phi": 5.0 * dice.randrange(72), "n_1": 10.0 * dice.randrange(60, 120), "M_3": dice.randrange(200, 600)}
    return data_of("madi-four-bar", written, dice.choice((-1, 1)), 1)


def _shaper(dice: random.Random) -> Data:
    pivot = dice.randrange(210, 400)
    lever = round(pivot * dice.uniform(1.65, 1.95))
    rod = round(pivot * dice.uniform(0.6, 0.8))
    written = {
        "phi": 5.0 * dice.randrange(72),
        "l_OA": round(pivot * dice.uniform(0.32, 0.44)),
        "l_OC": pivot,
        "l_CD": lever,
        "l_DE": rod,
        "y_E": round(pivot * dice.uniform(0.6, 0.85)),
        "l_CS3": lever / 2,
        "l_DS4": rod / 2,
        "n_1": dice.randrange(45, 70),
        "q": dice.randrange(20, 30),
        "m_5": dice.randrange(20, 70),
        "F_5": dice.randrange(10, 31) / 10,
    }
    return data_of("scheme-09-shaper", written, 1, 1)


def misread(givens: Givens, slips: tuple[Slip, ...]) -> Givens:
    """Return the givens as they are taken by somebody who makes mistakes in them."""
    found = dict(givens)
    for slip in slips:
        if slip.id == "M06":
            found |= {name: x * 1e3 for name, x in found.items() if name[:2] in ("l_", "y_") or name == "crank"}
        if slip.id == "M07":
            found["crank"] *= float(slip.way)
        if slip.id == "M08":
            found["phi"] = math.degrees(found["phi"])
        if slip.id == "M09":
            found["phi"] = -found["phi"]
        if slip.id == "M10":
            found["phi"] += float(slip.way)
        if slip.id == "M11":
            found["side"] = -found["side"]
        if slip.id == "M13":
            found[slip.at], found[slip.way] = found[slip.way], found[slip.at]
    return found


def exact(task: str, givens: Givens, slips: tuple[Slip, ...] = (), mus: dict[str, float] | None = None) -> Sheet:
    """Draw without errors of the hand, in SI where no scale factors are given."""
    return drawn(task, givens, Hand(), slips, mus)


def drawn(
    task: str, givens: Givens, hand: Hand, slips: tuple[Slip, ...] = (), mus: dict[str, float] | None = None
) -> Sheet:
    """Draw a sheet; raises ValueError or ZeroDivisionError where arcs or lines do not meet."""
    taken = misread(givens, slips)
    there = None
    if any(slip.id == "M22" for slip in slips):
        others = tuple(slip for slip in slips if slip.id != "M22")
        there = exact(task, {**taken, "phi": taken["phi"] + 30.0}, others, mus)
    return MECHANISMS[task](Sheet(hand, taken, slips, dict(mus or {}), there), taken)


def scale_factors(task: str, givens: Givens, slips: tuple[Slip, ...], dice: random.Random) -> dict[str, float]:
    """Choose scale factors of two digits: a plan's longest segment is of 90 to 130 mm, a link's of 160 to 220."""
    plain = tuple(slip for slip in slips if slip.id not in SCALE_SLIPS)
    sheet = exact(task, givens, plain)
    longest = {"mu_l": max(abs(x) for name, x in sheet.givens.items() if name[:2] == "l_")}
    for name, plan in sheet.plans.items():
        if plan != "mu_l":
            longest[plan] = max(longest.get(plan, 0.0), abs(sheet.lines[name].vector or 0j))
    mm = {plan: dice.uniform(160, 220) if plan == "mu_l" else dice.uniform(90, 130) for plan in longest}
    return {plan: float(f"{length / mm[plan]:.2g}") for plan, length in longest.items()}


def written_value(line: Line) -> complex:
    """Return a line as a vector, or as a number."""
    v = line.vector
    return complex(line.value) if v is None else v / abs(v) * line.value if v else 0j


def moved(task: str, data: Data, slips: tuple[Slip, ...], mus: dict[str, float], told: bool) -> dict[str, float]:
    """Return by how many tolerances mistakes move every line; `told` where directions and senses are written.

    A tolerance is 2 mm or 5 % or three times what an honest hand misses, whichever is most.
    """
    right, wrong = exact(task, data.givens), exact(task, data.givens, slips, mus)
    return _apart(right, wrong, spread(task, data), told)


def _apart(one: Sheet, other: Sheet, allowed: dict[str, float], told: bool) -> dict[str, float]:
    """Return by how many tolerances two drawings differ; what is not drawn at all is zero."""
    found = {}
    for name, most in allowed.items():
        a, b = (written_value(sheet.lines.get(name, NOTHING)) for sheet in (one, other))
        found[name] = abs(a - b if told else abs(a) - abs(b)) / most
    return found


@cache
def spread(task: str, data: Data) -> dict[str, float]:
    right, mus = exact(task, data.givens), scale_factors(task, data.givens, (), random.Random(SEED))
    dice, missed = random.Random(SEED), dict.fromkeys(right.lines, 0.0)
    for _ in range(PATTERNS):
        sheet = drawn(task, data.givens, Hand(dice), (), mus)
        for name in missed:
            off = written_value(sheet.lines.get(name, NOTHING)) - written_value(right.lines[name])
            missed[name] += abs(off) ** 2 / PATTERNS
    found = {}
    for name, line in right.lines.items():
        mm, part = TOLERATED[0] * mus.get(right.plans.get(name, ""), 0.0), TOLERATED[1] * abs(line.value)
        found[name] = max(mm, part, SPREADS * math.sqrt(missed[name]), 1e-12)
    return found


@dataclass(frozen=True, slots=True)
class Student:
    """One simulated student: what was to be solved, what was done wrong, what is handed in."""

    task: str
    data: Data
    slips: tuple[Slip, ...]
    sheet: Sheet
    told: bool  # whether directions and senses are written
    moved: dict[str, float]
    variant: str = ""


def honest(task: str, dice: random.Random, among: Sequence[Data] = (), told: bool = True) -> Student:
    """Draw a variant, one of all where not `among` some, without a mistake."""
    data = dice.choice(among or pool(task))
    sheet = drawn(task, data.givens, Hand(dice), (), scale_factors(task, data.givens, (), dice))
    return Student(task, data, (), sheet, told, {})


def mistaken(
    task: str,
    choose: Callable[[], tuple[Slip, ...]],
    dice: random.Random,
    among: Sequence[Data] = (),
    told: bool = True,
) -> Student | None:
    """Draw a variant with mistakes, each of which moves a line clearly, also after the others; None if none does."""
    for attempt in range(TRIES):
        data, slips = dice.choice((attempt < FEW and among) or pool(task)), choose()
        try:
            mus = scale_factors(task, data.givens, slips, dice)
            moves = moved(task, data, slips, mus, told)
            if not drawable(exact(task, data.givens, slips, mus)):
                continue
            if all(max(each.values()) >= CLEAR for each in _each(task, data, slips, mus, told)):
                return Student(task, data, slips, drawn(task, data.givens, Hand(dice), slips, mus), told, moves)
        except (ValueError, ZeroDivisionError):
            continue
    return None


def drawable(sheet: Sheet) -> bool:
    """Whether the vectors of the crank pin are not mere dots where the longest one just fits on the sheet."""
    pins = ("V_A", "a_A") if "V_A" in sheet.lines else ("V_B", "a_B")
    return all(sheet.size(name) >= LEAST_MM * sheet.mu(sheet.plans[name]) for name in pins)


def _each(
    task: str, data: Data, slips: tuple[Slip, ...], mus: dict[str, float], told: bool
) -> Iterator[dict[str, float]]:
    """Go through what each mistake moves, alone and where the others have been made."""
    allowed, whole = spread(task, data), exact(task, data.givens, slips, mus)
    for slip in slips:
        yield moved(task, data, (slip,), mus, told)
        without = exact(task, data.givens, tuple(s for s in slips if s is not slip), mus)
        yield _apart(without, whole, allowed, told)


def at_random(task: str, dice: random.Random, among: Sequence[Data] = ()) -> Student:
    """Return a sheet of invented numbers: segments of 5 to 150 mm with their values, sizes within a decade."""
    student = honest(task, dice, among)
    sheet = student.sheet
    for name, line in sheet.lines.items():
        plan = sheet.plans.get(name)
        if plan:
            mm = round(dice.uniform(5.0, 150.0) * 2.0) / 2.0
            line.mm, line.value = mm, sheet.hand.number(mm * sheet.mu(plan))
        else:
            line.value = sheet.hand.number(line.value * 10.0 ** dice.uniform(-0.5, 0.5)) * dice.choice((-1, 1))
        if line.vector is not None:
            line.value, line.degrees = abs(line.value), float(dice.randrange(360))
    return replace(student, moved={})


@cache
def kinds(task: str) -> dict[str, list[Slip]]:
    found: dict[str, list[Slip]] = {}
    for slip in SLIPS[task]:
        found.setdefault(slip.id, []).append(slip)
    return found


def accepted(id: str) -> set[str]:
    """Return the numbers under which a mistake may be named."""
    return {id, *ALIKE.get(id, ())}


@dataclass(frozen=True, slots=True)
class Outcome:
    """What became of one student; shares of lines are those that were written."""

    task: str
    slips: tuple[str, ...]
    places: tuple[str, ...]
    mark: float
    lines: int
    passed: int
    first: str  # wrong step, as named
    step: bool  # whether it is right
    names: frozenset[str]  # numbers of the first explanation
    fits: str  # another variant that the answers are said to fit

    @property
    def named(self) -> bool:
        return all(self.has(slip) for slip in self.slips)

    def has(self, slip: str) -> bool:
        return not accepted(slip).isdisjoint(self.names)


def marked(students: Iterable[Student]) -> list[Outcome]:
    """Mark students, a class for each task."""
    by_task = defaultdict(list)
    for number, student in enumerate(students):
        by_task[student.task].append((number, student))
    found: dict[int, Outcome] = {}
    for task, group in by_task.items():
        ordered = sorted(group, key=lambda one: (one[1].variant, sorted(one[1].data.settings.items())))
        found |= zip((n for n, _ in ordered), _class(task, [student for _, student in ordered]), strict=True)
    return [found[number] for number in sorted(found)]


def _class(task: str, students: list[Student]) -> Iterator[Outcome]:
    with tempfile.TemporaryDirectory() as folder:
        first = next(iter(load_task(task).variants))
        rows = [{"student": f"S{i}", "variant": s.variant or first} for i, s in enumerate(students)]
        tables = {
            "roster": [row | s.data.settings for row, s in zip(rows, students, strict=True)],
            "class": [row | dict(cells(s)) for row, s in zip(rows, students, strict=True)],
        }
        heads = {name: list(dict.fromkeys(column for row in table for column in row)) for name, table in tables.items()}
        roster, answers = (
            write(Path(folder), [head, *([row.get(column, "") for column in head] for row in tables[name])], name=name)
            for name, head in heads.items()
        )
        asked = check(task, roster=roster, lang="en")
        desk, handed_in = Desk(asked), {read.who.student: read for read in asked.read(str(answers))}
        for i, student in enumerate(students):
            yield _outcome(student, desk.mark(handed_in[f"S{i}"]))


def _outcome(student: Student, result: Marked) -> Outcome:
    first = result.marking.first_wrong or ""
    lines = [line for line in result.lines if line.answer is not None]
    moves = student.moved
    clearly = next((line.name for line in result.marking.lines if moves.get(line.name, 0.0) >= CLEAR), "")
    order = [line.name for line in result.marking.lines]
    step = bool(first and clearly) and moves.get(first, 0.0) >= TOUCHED and order.index(first) <= order.index(clearly)
    return Outcome(
        student.task,
        tuple(slip.id for slip in student.slips),
        tuple(f"{slip.at} {slip.way}".strip() for slip in student.slips),
        result.mark,
        len(lines),
        sum(line.verdict.passed for line in lines),
        first,
        step,
        frozenset(result.candidates[0].ids) if result.candidates else frozenset(),
        result.fits,
    )


def cells(student: Student) -> Iterator[tuple[str, str]]:
    """Go through what a student writes: scale factors, millimetres, values; directions and signs where told."""
    sheet = student.sheet
    for plan, mu in sheet.mus.items():
        yield SYMBOLS.get(plan, plan), f"{mu:.10g}"
    for name, line in sheet.lines.items():
        if line.mm is not None:
            yield f"{name}.mm", f"{line.mm:.10g}"
        if named_value(name):
            size = line.vector is not None or not student.told or not line.value or line.mm is not None
            yield name, f"{abs(line.value):.10g}" if size else f"{line.value:+.10g}"
        if student.told and line.degrees is not None:
            yield f"{name}.dir", f"{line.degrees:g}"


def printed(task: str, variant: str) -> Data:
    loaded = load_task(task)
    values, factors = loaded.resolve(variant), {"deg": 180.0 / 3.141592653589793, "rpm": 30.0 / 3.141592653589793}
    written, turn, side = {}, 1, 1
    for name, given in loaded.givens.items():
        if given.unit is None:
            continue
        scale = {"mm": 1e3, "kN": 1e-3}.get(given.unit.name) or factors.get(given.unit.name, 1.0)
        written[name] = float(f"{float(values[name]) * scale:.12g}")
    if task == "nau-slider-crank":
        turn, side = (1 if values["rotation"] == "ccw" else -1), (1 if values["side"] == "right" else -1)
    return data_of(task, written, turn, side)


def share(outcomes: Sequence[Outcome], counts: Callable[[Outcome], bool]) -> float:
    """Return the percentage of students of whom something holds."""
    return 100.0 * sum(map(counts, outcomes)) / max(len(outcomes), 1)


def swapped_sheet(task: str, dice: random.Random) -> Student:
    """Return a student who hands in an honest sheet of another variant of the task."""
    own, other = dice.sample(list(load_task(task).variants), 2)
    data = printed(task, other)
    sheet = drawn(task, data.givens, Hand(dice), (), scale_factors(task, data.givens, (), dice))
    return Student(task, Data({}, {}), (), sheet, True, {}, own)


def population(group: str, name: str, count: int, dice: random.Random, part: tuple[int, int] = (0, 1)) -> list[Student]:
    """Draw one kind of students: `name` is a mistake, of the groups `one` and `sizes`, or a task.

    `part` is which of several parts of all variants they have, and of how many.
    """
    tasks = [task for task in SLIPS if name in kinds(task)] if group in ("one", "sizes") else [name]
    some = {task: pool(task)[part[0] :: part[1]] for task in tasks}
    if group in ("one", "sizes"):
        chosen = [tasks[i % len(tasks)] for i in range(count)]
        found = [one_mistake(task, name, dice, some[task], group == "one") for task in chosen]
        return [student for student in found if student is not None]
    if group == "other":
        return [swapped_sheet(name, dice) for _ in range(count)]
    draw = {"honest": honest, "two": two_mistakes, "random": at_random}[group]
    return [draw(name, dice, some[name]) for _ in range(count)]


def one_mistake(
    task: str, id: str, dice: random.Random, among: Sequence[Data] = (), told: bool = True
) -> Student | None:
    """Draw a student with one mistake; None where it moves no line clearly, as in sizes one of a sense."""
    slips = kinds(task)[id]
    return mistaken(task, lambda: (dice.choice(slips),), dice, among, told)


def two_mistakes(task: str, dice: random.Random, among: Sequence[Data] = ()) -> Student:
    """Draw a student with two mistakes of different numbers."""
    of_task = kinds(task)

    def choose() -> tuple[Slip, ...]:
        return tuple(dice.choice(of_task[id]) for id in dice.sample(sorted(of_task), 2))

    student = mistaken(task, choose, dice, among)
    assert student is not None
    return student
