"""Tables, worked calculations and conclusions of a gear pair, and what sentences about its drawings name."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import cache

from ...plans.gears.construction import MESHING, THETA
from ...plans.gears.gear import SHIFTS, VALUES, WHEELS, unit_of
from ...plans.gears.geometry import POINTS
from ...plans.gears.solve import MARKS, SAME_CENTRES, rule_of
from ...plans.laws import form_of
from ...plans.names import role
from ...plans.solved import AT_LEAST, AT_MOST, Check
from ...scales.scale import Scale
from ..handouts import Shown as Begun
from ..notes.blocks import Story
from ..printed import DEGREES, Input, Shown, Symbol, worked
from ..tables import table, text_block
from ..text import symbol
from ..view import View
from ..words import indexed
from .action_view import theta_said
from .scene import PLACES, GearScene

SLIDING = 2  # decimals of ordinates, mm, and of sliding where they show so many
# rows of the data; of a wheel's quantities the name goes on with its number
PAIR = ("m", "alpha", "h_a", "h_l", "c", "x_sum", "y", "delta_y", "a_w", "alpha_w", "h", "p", "p_b")
OF_WHEELS = ("z", "x", "d", "d_w", "d_b", "d_a", "d_f", "s", "s_c", "h_c", "z_W", "W")
Lines = list[tuple[str, ...]]
# what is calculated: the main sizes, sections I and II of the note; the auxiliary ones, III, and those to measure teeth
# by; what the pair is judged by, IV and V
CALCULATED = {
    "sizes": "inv_alpha a x_sum inv_alpha_w alpha_w a_w d_1 d_2 u d_w1 d_w2 y delta_y d_a1 d_a2 d_f1 d_f2",
    "auxiliary": "d_b1 d_b2 tau_1 tau_2 P_1 P_2 p s_1 s_2 h alpha_a1 alpha_a2 rho_p1 rho_p2 nu_p1 nu_p2 p_b "
    "s_c1 s_c2 h_c1 h_c2 s_b1 s_b2 W_1 W_2",
    "quality": "x_min1 x_min2 rho_l1 rho_l2 epsilon_alpha s_a1 s_a2 rho_a1 g_alpha phi_alpha1 phi_alpha2",
}
MM, NUMBER = Shown("mm", 1e3, 3), Shown("", 1.0, 4)  # of what is calculated
PRINTED = {"m": MM, "rad": Shown("deg", DEGREES, 3), "1": NUMBER}
INV = Shown("", 1.0, 6)  # of the involute function
SHORT = 4  # decimals of a number that is printed as it is
NOISE = 1e-9  # by which it may differ
PAPER = 1  # decimals of segments on paper
SIZES = ("a_w", "g_alpha", "p", "p_b", "rho_f", "l_N1N2", "PW", *(f"s_{i}" for i in WHEELS))
LAID_OFF = tuple(name for name in SIZES if name != "PW")  # at the scale of the meshing; PW is a segment itself
ANGLES = ("alpha_w", *(f"phi_alpha{i}" for i in WHEELS))
RADII = tuple(f"{circle}{i}" for circle in ("w", "b", "a", "f", "") for i in WHEELS)
BROKEN = {AT_LEAST: "<", AT_MOST: ">"}
RULES = ("undercut", "interference", "contact_ratio", "contact_flanks", "tip")
# where on the active line a wheel slides most: at the root of its teeth
STEEPEST = {"theta_12": "A1", "theta_21": "A2"}


def data_table(scene: GearScene) -> View:
    """Return the data of the pair, and below them those of its wheels side by side."""
    words = scene.words
    rows: list[list[str | None]] = [[words["table.quantity"], words["table.symbol"], words["table.value"], None]]
    rows += ([_named(scene, name), symbol(words.symbol(name)), _number(scene, name), None] for name in PAIR)
    rows.append(["", None, words["gear.pinion"], words["gear.wheel"]])
    rows += (
        [_named(scene, n), symbol(words.symbol(n)), *(_number(scene, _of(n, i)) for i in WHEELS)] for n in OF_WHEELS
    )
    return table("data", words["heading.gear_data"], rows, scene.style)


def _of(name: str, wheel: int) -> str:
    return f"{name}{wheel}" if "_" in name else f"{name}_{wheel}"  # d_w1, d_1


def _named(scene: GearScene, name: str) -> str:
    """Return what a quantity of the data is called, with the unit in which its row is."""
    words = scene.words
    unit = _printed(_of(name, 1) if name in OF_WHEELS else name).unit
    return words[f"gear.{name}"] + {"mm": f", {words.unit('mm')}", "deg": ", °"}.get(unit, "")


def _number(scene: GearScene, name: str) -> str:
    """Return a quantity as its row has it: a given as it is, what is undefined as a dash."""
    value, words, (_, times, decimals, _) = scene.size(name), scene.words, _printed(name)
    if not math.isfinite(value):
        return words["table.calculated"]
    if role(name).kind == "z":
        return words.short(value)
    if name in scene.givens or name in ("x_1", "x_2", "x_sum"):
        return words.short(round(value * times, 9), 6)
    return words.number(value * times, decimals or 0)


def points_table(scene: GearScene) -> View:
    """Return the table of the twelve points: ordinates of the velocities, their differences, specific sliding.

    Differences are those of the printed ordinates, and sliding has as many digits as come out of these. Points end in
    N1 and N2: where A1 or A2 lies beyond, no point has its letter.
    """
    words, places = scene.words, scene.places
    order = ("N1", *(name for name in places if name in PLACES), "N2")
    letters = {
        point: indexed(name)
        for name, point in zip(order, (POINTS[0], *MARKS, POINTS[-1]), strict=True)
        if 0.0 <= places[name] <= places["N2"]
    }
    y_1, y_2, mm = words.symbol("y_1"), words.symbol("y_2"), words.unit("mm")
    head = [words["gear.point"], None, *(f"{y}, {mm}" for y in (y_1, y_2, f"{y_1} − {y_2}")), words.symbol("theta_12")]
    rows: list[list[str | None]] = [[*head, f"{y_2} − {y_1}, {mm}", words.symbol("theta_21")]]
    for point in POINTS:
        first, second = (round(scene.size(f"y_{i}_{point}") * MM.times, SLIDING) for i in WHEELS)
        cells = [words.number(y, SLIDING) for y in (first, second)]
        for pair, own, mate in (("12", first, second), ("21", second, first)):
            exact = scene.size(f"theta_{pair}_{point}")
            cells += [words.number(own - mate, SLIDING), _sliding(scene, own, mate, exact)]
        rows.append([str(int(point)), letters.get(point, ""), *cells])
    return table("points", words["heading.gear_points"], rows, scene.style)


def _sliding(scene: GearScene, own: float, mate: float, exact: float) -> str:
    """Return specific sliding with the digits with which it comes out of the printed ordinates."""
    if math.isinf(exact):
        return "−∞"
    if own == 0.0 or math.isnan(exact):
        return scene.words["table.calculated"]
    printed = (own - mate) / own
    digits = next((d for d in range(SLIDING, -4, -1) if round(printed, d) == round(exact, d)), -4)
    return scene.words.number(round(exact, digits), digits)


def checks_table(scene: GearScene) -> View:
    """Return the checks, each with its number, its limit and the verdict."""
    words = scene.words
    rows = [[words[f"table.{name}"] for name in ("check", "condition", "value", "limit", "verdict")]]
    for check in scene.solved.checks:
        wheel, about = rule_of(check)[1], words[f"gear.check.{role(check.name).kind}"]
        about += f", {words.symbol(f'z_{wheel}')}" if wheel else ""
        sides = (_side(scene, check, side) for side in (check.value, check.limit))
        rows.append([about, _condition(scene, check), *sides, words["said.ok" if check.ok else "said.fails"]])
    return table("checks", words["heading.gear_checks"], rows, scene.style)


def _condition(scene: GearScene, check: Check) -> str:
    """Return what is demanded, in symbols."""
    symbol, short, kind = scene.words.symbol, scene.words.short, role(check.name).kind
    if kind == "centre":
        return f"{symbol('a_w')} = {CENTRES[check.quantity](symbol)}"
    limit = f"{short(scene.solved.pair.least_tip)}m" if kind == "tip" else short(check.limit)
    return f"{symbol(check.quantity)} {check.sign} {symbol(check.of) if check.of else limit}"


def _side(scene: GearScene, check: Check, value: float) -> str:
    """Return one side of a check, lengths in mm."""
    unit, times, decimals, _ = _printed(check.quantity)
    number = scene.words.number(value * times, decimals or 0)
    return f"{number} {scene.words.unit(unit)}" if unit else number


# the distance of the centres in other ways, in symbols
CENTRES: dict[str, Callable[[Callable[[str], str]], str]] = {
    "a_w_rolling": lambda s: f"({s('d_w1')} + {s('d_w2')})/2",
    "a_w_shift": lambda s: f"({s('d_1')} + {s('d_2')})/2 + {s('y')}·{s('m')}",
    "a_w_tip1": lambda s: f"({s('d_a1')} + {s('d_f2')})/2 + {s('c')}·{s('m')}",
    "a_w_tip2": lambda s: f"({s('d_a2')} + {s('d_f1')})/2 + {s('c')}·{s('m')}",
}


def begun(scene: GearScene, steps: int) -> dict[str, Begun]:
    """Return what handouts show of the tables: the rows of what is given."""
    shifts = [name for name in SHIFTS if name in scene.givens]
    known = ["m", "alpha", "h_a", "h_l", "c", "z", *shifts, *(["x"] if shifts[:2] == ["x_1", "x_2"] else [])]
    cells = (_named(scene, name) for name in (*PAIR, *OF_WHEELS) if name in known)
    nothing = Begun(rows=frozenset())
    return {"points": nothing, "checks": nothing, "data": Begun(rows=frozenset(("", *cells)), columns=2)}


def calculations_block(scene: GearScene, name: str, width: float) -> View:
    """Return a calculation of the note by its key in `CALCULATED`; sizes have checks, the quality laws of sliding."""
    lines = _calculations(scene, CALCULATED[name].split())
    if name == "sizes":
        lines += _calculations(scene, SAME_CENTRES, "a_w")
    if name == "quality":
        words = scene.words  # the laws of sliding, and between which values it is on the active line
        v, omega, rho, y = ([words.symbol(f"{of}{i}") for i in (1, 2)] for of in ("V_k", "omega_", "rho_", "y_"))
        lines.append(tuple(f"{v[k]} = {omega[k]}·{rho[k]}{';' if k == 0 else ''}" for k in range(2)))
        for own, mate in ((0, 1), (1, 0)):
            theta = f"theta_{own + 1}{mate + 1}"
            values = sorted(scene.size(f"{theta}_{end}") for end in ("A1", "A2"))
            low, high = ("−∞" if math.isinf(value) else words.number(value, 2) for value in values)
            law, known = f"{words.symbol(theta)} = ({y[own]} − {y[mate]})/{y[own]}", not any(map(math.isnan, values))
            lines.append((f"{law};", f"{low} ≤ {words.symbol(theta)} ≤ {high}") if known else (law,))
    return text_block(f"equations_{name}", scene.words[f"heading.gear_{name}"], lines, scene.style, width)


def _calculations(scene: GearScene, names: Iterable[str], symbol: str = "") -> Lines:
    """Return the calculations of quantities, under one symbol if that is named; without what is undefined."""
    words, lines = scene.words, Lines()
    for step in (scene.solved.program.by_name[name] for name in names if math.isfinite(scene.size(name))):
        unit, times, decimals, _ = _printed(step.name)
        if not _prints(step.law, len(step.operands)):
            number = words.number(scene.size(step.name) * times, decimals or 0)
            lines.append((f"{words.symbol(symbol or step.name)} = {number}{words.unit(unit) if unit else ''}",))
            continue
        result = _input(scene, step.name)
        if result.exact:  # without zeros at its end
            decimals = len(f"{result.value:.{SHORT}f}".rstrip("0").rpartition(".")[2])
        inputs = [_input(scene, name) for name in step.operands]
        lines.append(worked(words, symbol or step.name, step.law, inputs, Shown(unit, times, decimals)))
    return lines


def _printed(name: str) -> Shown:
    """Return how a quantity is printed."""
    return INV if role(name).kind == "inv" else PRINTED[VALUES[name] or "1" if name in VALUES else unit_of(name)]


def _input(scene: GearScene, name: str) -> Input:
    """Return a quantity with its number as it is printed; a short one as it is."""
    unit, times, decimals, _ = _printed(name)
    value = scene.size(name) * times
    short = round(value, SHORT)
    exact = abs(value - short) < NOISE
    told = "" if exact else scene.words.number(value, decimals or 0)
    return Input(short if exact else value, exact, name=name, sign="°" * (unit == "deg"), times=times, told=told)


def story(scene: GearScene, scales: Mapping[str, Scale], texts: Mapping[str, str]) -> Story:
    """Return what the note of a gear pair says beside its views, and what tells their stages: segments on paper.

    The `scales` are by plan, the sentences of `texts` by key.
    """
    words, sizes, mu = scene.words, scene.solved.sizes, scales[MESHING].mu if MESHING in scales else 1e-3
    mm = words.unit("mm")
    said = {name: f"{scene.stated(name)} {mm}" for name in SIZES} | {name: scene.angle(name) for name in ANGLES}
    on_paper = {f"r_{name}": 0.5 * sizes[f"d_{name}"] for name in RADII}
    on_paper |= {f"{name}_drawn": sizes[name] for name in LAID_OFF}
    said |= {name: f"{words.number(length / mu, PAPER)} {mm}" for name, length in on_paper.items()}
    said |= {f"parts_{i}": str(r.parts) for i, r in zip(WHEELS, scene.solved.layout.rollings, strict=True)}
    said["mu_theta"] = theta_said(words, scales[THETA].mu if THETA in scales else scene.size("mu_theta") * 1e-3)
    return Story(conclusions=tuple(_conclusions(scene, texts)), texts=texts, said=said)


def _conclusions(scene: GearScene, texts: Mapping[str, str]) -> Iterator[str]:
    """Go through the sentences for the end of the note."""
    words = scene.words
    lengths = {name: f"{scene.stated(name)} {words.unit('mm')}" for name in ("a", "a_w")}
    numbers = {name: scene.shift(name) for name in ("x_1", "x_2")}
    yield texts["gear.conclusion.shifts"].format(alpha_w=scene.angle("alpha_w"), **lengths, **numbers)
    for rule in RULES:  # whether it is kept: of all wheels, or of which it is not
        checks = [check for check in scene.solved.checks if rule_of(check)[0] == rule]
        broken = [check for check in checks if not check.ok]
        if checks:
            said = "; ".join(_compared(scene, check) for check in broken or checks)
            yield texts[f"gear.conclusion.{rule}_{'broken' if broken else 'kept'}"].format(said=said)
        if rule == "contact_ratio" and 1.0 < checks[0].value < 2.0:
            part = words.number(100.0 * (checks[0].value - 1.0), 0)
            yield texts["gear.conclusion.pairs"].format(part=part)
    values = {name: scene.size(f"{name}_{end}") for name, end in STEEPEST.items()}
    if all(map(math.isfinite, values.values())):
        most = {name: f"{words.symbol(name)} = {words.number(value, 2)}" for name, value in values.items()}
        same = len({round(abs(value), 2) for value in values.values()}) == 1
        worse = "both" if same else max(values, key=lambda name: abs(values[name]))
        yield texts[f"gear.conclusion.wear_{worse}"].format(**most)


def _compared(scene: GearScene, check: Check) -> str:
    """Return a quantity beside its limit, as they stand to one another."""
    sign = check.sign if check.ok else BROKEN[check.relation]
    value, limit = (_side(scene, check, side) for side in (check.value, check.limit))
    of = f"{scene.words.symbol(check.of)} = " if check.of else ""
    return f"{scene.words.symbol(check.quantity)} = {value} {sign} {of}{limit}"


@cache
def _prints(law: str, operands: int) -> bool:
    """Whether a law of so many operands is an expression, not a procedure."""
    try:
        form_of(law)(*(Symbol.of("x") for _ in range(operands)))
    except TypeError:
        return False
    return True
