"""Calculations of a gear pair with their numbers: main sizes, auxiliary sizes, quality; in the order of the note.

Every line is a step of the construction: its law computes the printed result from the printed numbers.
"""

from __future__ import annotations

import math
from collections.abc import Iterable

from ...plans.board import Step
from ...plans.gears.gear import VALUES, unit_of
from ...plans.gears.solve import SAME_CENTRES
from ...plans.names import role
from ..printed import DEGREES, Input, Shown, prints, worked
from ..table import text_block
from ..view import View
from .scene import GearScene

Lines = list[tuple[str, ...]]
SIZES = "inv_alpha a x_sum inv_alpha_w alpha_w a_w d_1 d_2 u d_w1 d_w2 y delta_y d_a1 d_a2 d_f1 d_f2"
TEETH = "d_b1 d_b2 tau_1 tau_2 P_1 P_2 p s_1 s_2 h alpha_a1 alpha_a2 rho_p1 rho_p2 nu_p1 nu_p2 p_b"
MEASURES = "s_c1 s_c2 h_c1 h_c2 s_b1 s_b2 W_1 W_2"
QUALITY = "x_min1 x_min2 rho_l1 rho_l2 epsilon_alpha s_a1 s_a2 rho_a1 g_alpha phi_alpha1 phi_alpha2"
SHOWN = {"m": Shown("mm", 1e3, 3), "rad": Shown("deg", DEGREES, 3), "1": Shown("", 1.0, 4)}
INV = Shown("", 1.0, 6)  # of the involute function
SHORT = 4  # decimals of a number that is printed as it is
NOISE = 1e-9  # by which it may differ


def sizes_block(scene: GearScene, width: float) -> View:
    """Return the calculation of the main sizes and its checks, sections I and II of the note."""
    lines = [*_lines(scene, SIZES.split()), *_lines(scene, SAME_CENTRES, "a_w")]
    return text_block("equations_sizes", scene.words["heading.gear_sizes"], lines, scene.style, width)


def auxiliary_block(scene: GearScene, width: float) -> View:
    """Return the calculation of the auxiliary sizes, section III, and of the sizes to measure teeth by."""
    lines = _lines(scene, [*TEETH.split(), *MEASURES.split()])
    return text_block("equations_auxiliary", scene.words["heading.gear_auxiliary"], lines, scene.style, width)


def quality_block(scene: GearScene, width: float) -> View:
    """Return the calculation of what the pair is judged by, sections IV and V."""
    lines = [*_lines(scene, QUALITY.split()), *_sliding(scene)]
    return text_block("equations_quality", scene.words["heading.gear_quality"], lines, scene.style, width)


def _lines(scene: GearScene, names: Iterable[str], symbol: str = "") -> Lines:
    """Return the calculations of quantities, under one symbol if that is named; without what is undefined."""
    steps = scene.solved.program.by_name
    return [_line(scene, steps[name], symbol or name) for name in names if math.isfinite(scene.size(name))]


def _line(scene: GearScene, step: Step, symbol: str) -> tuple[str, ...]:
    """Return one calculation: symbols, numbers, result."""
    words, (unit, times, decimals) = scene.words, shown(step.name)
    if not prints(step.law, len(step.operands)):
        number = words.number(scene.size(step.name) * times, decimals or 0)
        return (f"{words.symbol(symbol)} = {number}{words.unit(unit) if unit else ''}",)
    result = _input(scene, step.name)
    if result.exact:  # without zeros at its end
        decimals = len(f"{result.value:.{SHORT}f}".rstrip("0").rpartition(".")[2])
    inputs = [_input(scene, name) for name in step.operands]
    return worked(words, symbol, step.law, inputs, Shown(unit, times, decimals))


def shown(name: str) -> Shown:
    """Return how a quantity is printed."""
    return INV if role(name).kind == "inv" else SHOWN[VALUES[name] or "1" if name in VALUES else unit_of(name)]


def _input(scene: GearScene, name: str) -> Input:
    """Return a quantity with its number as it is printed; a short one as it is."""
    unit, times, _ = shown(name)
    value = scene.size(name) * times
    short = round(value, SHORT)
    exact = abs(value - short) < NOISE
    return Input(short if exact else value, exact, name=name, sign="°" * (unit == "deg"), times=times)


def _sliding(scene: GearScene) -> Lines:
    """Return the laws of sliding, and between which values it is on the active line."""
    words = scene.words
    v, omega, rho, y = ([words.symbol(f"{name}{i}") for i in (1, 2)] for name in ("V_k", "omega_", "rho_", "y_"))
    lines: Lines = [tuple(f"{v[k]} = {omega[k]}·{rho[k]}{';' if k == 0 else ''}" for k in range(2))]
    for own, mate in ((0, 1), (1, 0)):
        name = f"theta_{own + 1}{mate + 1}"
        values = sorted(scene.size(f"{name}_{end}") for end in ("A1", "A2"))
        texts = ["−∞" if math.isinf(value) else words.number(value, 2) for value in values]
        law = f"{words.symbol(name)} = ({y[own]} − {y[mate]})/{y[own]};"
        ranges = f"{texts[0]} ≤ {words.symbol(name)} ≤ {texts[1]}"
        lines.append((law, ranges) if not any(math.isnan(value) for value in values) else (law.rstrip(";"),))
    return lines
