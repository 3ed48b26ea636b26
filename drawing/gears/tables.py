"""Tables of a gear pair: its sizes and those of its wheels, twelve points of sliding, checks with their verdicts."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator

from ...plans.check import Check, rule_of
from ...plans.gears.gear import SHIFTS, WHEELS
from ...plans.gears.geometry import POINTS
from ...plans.names import role
from ..handouts import Shown
from ..printed import DEGREES
from ..table import table
from ..view import View
from ..words import indexed
from .scene import GearScene, marks, places

MM, DEGREE, NUMBER, WHOLE = "mm", "°", "", "whole"
DECIMALS = {MM: 3, DEGREE: 3, NUMBER: 4}  # of what is calculated
TIMES = {MM: 1e3, DEGREE: DEGREES}
SLIDING = 2  # decimals of ordinates, mm, and of sliding where they show so many
# rows of the data: names, and what they are given in; of a wheel's quantities the name goes on with its number
PAIR = (
    *(("m", MM), ("alpha", DEGREE), ("h_a", NUMBER), ("h_l", NUMBER), ("c", NUMBER), ("x_sum", NUMBER)),
    *(("y", NUMBER), ("delta_y", NUMBER), ("a_w", MM), ("alpha_w", DEGREE), ("h", MM), ("p", MM), ("p_b", MM)),
)
OF_WHEELS = (
    *(("z", WHOLE), ("x", NUMBER), ("d", MM), ("d_w", MM), ("d_b", MM), ("d_a", MM), ("d_f", MM), ("s", MM)),
    *(("s_c", MM), ("h_c", MM), ("z_W", WHOLE), ("W", MM)),
)


def data_table(scene: GearScene) -> View:
    """Return the data of the pair, and below them those of its wheels side by side."""
    words = scene.words
    rows: list[list[str | None]] = [[words["table.quantity"], words["table.symbol"], words["table.value"], None]]
    rows += ([named(scene, name, kind), words.symbol(name), number(scene, name, kind), None] for name, kind in PAIR)
    rows.append(["", None, words["gear.pinion"], words["gear.wheel"]])
    for name, kind in OF_WHEELS:
        numbers = (number(scene, of_wheel(name, i), kind) for i in WHEELS)
        rows.append([named(scene, name, kind), words.symbol(name), *numbers])
    return table("data", words["heading.gear_data"], rows, scene.style)


def of_wheel(name: str, i: int) -> str:
    """Return the name of a quantity of one wheel: d_1, d_w1."""
    return f"{name}{i}" if "_" in name else f"{name}_{i}"


def named(scene: GearScene, name: str, kind: str) -> str:
    """Return what a quantity is called, with the unit in which its row is."""
    words = scene.words
    unit = {MM: f", {words.unit('mm')}", DEGREE: f", {DEGREE}"}.get(kind, "")
    return f"{words[f'gear.{name}']}{unit}"


def number(scene: GearScene, name: str, kind: str) -> str:
    """Return a quantity as its row has it: a given as it is, what is undefined as a dash."""
    value, words = scene.size(name), scene.words
    if not math.isfinite(value):
        return words["table.calculated"]
    if kind == WHOLE:
        return words.short(value)
    value *= TIMES.get(kind, 1.0)
    if name in scene.givens or name in ("x_1", "x_2", "x_sum"):
        return words.short(round(value, 9), 6)
    return words.number(value, DECIMALS[kind])


def points_table(scene: GearScene) -> View:
    """Return the table of the twelve points: ordinates of the velocities, their differences, specific sliding.

    Differences are those of the printed ordinates, and sliding has as many digits as come out of these. Points end in
    N1 and N2: where A1 or A2 lies beyond, no point has its letter.
    """
    words, line = scene.words, scene.size("l_N1N2")
    on_line = [name for name, rho_1 in places(scene.solved.sizes).items() if 0.0 <= rho_1 <= line]
    named_points = {name: point for name, point in marks(scene.solved.sizes).items() if name in on_line}
    mm = words.unit("mm")
    letters = {point: indexed(name) for name, point in named_points.items()}
    y_1, y_2 = words.symbol("y_1"), words.symbol("y_2")
    head = [words["gear.point"], None, *(f"{y}, {mm}" for y in (y_1, y_2, f"{y_1} − {y_2}")), words.symbol("theta_12")]
    head += [f"{y_2} − {y_1}, {mm}", words.symbol("theta_21")]
    rows: list[list[str | None]] = [head]
    for point in POINTS:
        first, second = (round(_mm(scene, f"y_{i}_{point}"), SLIDING) for i in WHEELS)
        cells = [words.number(y, SLIDING) for y in (first, second)]
        for pair, own, mate in (("12", first, second), ("21", second, first)):
            exact = scene.size(f"theta_{pair}_{point}")
            cells += [words.number(own - mate, SLIDING), _sliding(scene, own, mate, exact)]
        rows.append([str(int(point)), letters.get(point, ""), *cells])
    return table("points", words["heading.gear_points"], rows, scene.style)


def _mm(scene: GearScene, name: str) -> float:
    return scene.size(name) * TIMES[MM]


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
    head = [words[f"table.{name}"] for name in ("check", "condition", "value", "limit", "verdict")]
    rows = [_check_row(scene, check) for check in scene.solved.checks]
    return table("checks", words["heading.gear_checks"], [head, *rows], scene.style)


def _check_row(scene: GearScene, check: Check) -> list[str]:
    words = scene.words
    wheel, about = rule_of(check)[1], words[f"gear.check.{role(check.name).kind}"]
    if wheel:
        about += f", {words.symbol(f'z_{wheel}')}"
    sides = number_of(scene, check, check.value), number_of(scene, check, check.limit)
    verdict = words["said.ok" if check.ok else "said.fails"]
    return [about, condition(scene, check), *sides, verdict]


def condition(scene: GearScene, check: Check) -> str:
    """Return what is demanded, in symbols."""
    words = scene.words
    if role(check.name).kind == "centre":
        return f"{words.symbol('a_w')} = {CENTRES[check.quantity](words.symbol)}"
    if check.of:
        limit = words.symbol(check.of)
    elif role(check.name).kind == "tip":
        limit = f"{words.short(scene.solved.pair.least_tip)}m"
    else:
        limit = words.short(check.limit)
    return f"{words.symbol(check.quantity)} {check.sign} {limit}"


def number_of(scene: GearScene, check: Check, value: float) -> str:
    """Return one side of a check, lengths in mm."""
    words = scene.words
    if role(check.quantity).kind in ("epsilon", "x"):
        return words.number(value, DECIMALS[NUMBER])
    return f"{words.number(value * TIMES[MM], DECIMALS[MM])} {words.unit('mm')}"


Symbol = Callable[[str], str]
# the distance of the centres in other ways, in symbols
CENTRES: dict[str, Callable[[Symbol], str]] = {
    "a_w_rolling": lambda s: f"({s('d_w1')} + {s('d_w2')})/2",
    "a_w_shift": lambda s: f"({s('d_1')} + {s('d_2')})/2 + {s('y')}·{s('m')}",
    "a_w_tip1": lambda s: f"({s('d_a1')} + {s('d_f2')})/2 + {s('c')}·{s('m')}",
    "a_w_tip2": lambda s: f"({s('d_a2')} + {s('d_f1')})/2 + {s('c')}·{s('m')}",
}


def begun(scene: GearScene) -> dict[str, Shown]:
    """Return what handouts show of the tables: the rows of what is given."""
    nothing = frozenset[str]()
    found = {name: Shown(nothing, nothing, rows=nothing) for name in ("points", "checks")}
    return found | {"data": Shown(nothing, nothing, rows=frozenset(_given(scene)), columns=2)}


def _given(scene: GearScene) -> Iterator[str]:
    """Go through the first cells of the rows of what is given, and of the heads between them."""
    shifts = [name for name in SHIFTS if name in scene.givens]
    yield ""
    for name, kind in (*PAIR, *OF_WHEELS):
        known = name in ("m", "alpha", "h_a", "h_l", "c", "z") or name in shifts
        if known or (name == "x" and shifts[:2] == ["x_1", "x_2"]):
            yield named(scene, name, kind)
