"""Calculations of a gear pair with their numbers: main sizes, auxiliary sizes, quality; in the order of the note.

Every line is a step of the construction: its law computes the printed result from the printed numbers.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable
from typing import Any

from ...plans.board import Step
from ...plans.gears.checks import CENTRES
from ...plans.gears.gear import VALUES, unit_of
from ...plans.laws import LAWS
from ..printed import Formula, Terms, worked
from ..table import text_block
from ..view import View
from .scene import GearScene

Lines = list[tuple[str, ...]]
SIZES = "inv_alpha a x_sum inv_alpha_w alpha_w a_w d_1 d_2 u d_w1 d_w2 y delta_y d_a1 d_a2 d_f1 d_f2"
TEETH = "d_b1 d_b2 tau_1 tau_2 P_1 P_2 p s_1 s_2 h alpha_a1 alpha_a2 rho_p1 rho_p2 nu_p1 nu_p2 p_b"
MEASURES = "s_c1 s_c2 h_c1 h_c2 s_b1 s_b2 W_1 W_2"
QUALITY = "x_min1 x_min2 rho_l1 rho_l2 epsilon_alpha s_a1 s_a2 rho_a1 g_alpha phi_alpha1 phi_alpha2"
# the laws in symbols: {0} is the first operand; what has no formula is only stated
FORMULAS = {
    "involute": "tan {0} − {0}·π/180°",
    "reference_centre": "{0}·({1} + {2})/2",
    "sum": "{0} + {1}",
    "excess": "{0} − {1}",
    "working_involute": "{0} + 2·{1}·tan {2}/({3} + {4})",
    "working_centre": "{0}·cos {1}/cos {2}",
    "reference_diameter": "{0}·{1}",
    "gear_ratio": "{1}/{0}",
    "rolling_diameter_of_pinion": "2·{0}/({1} + 1)",
    "rolling_diameter_of_wheel": "2·{0}·{1}/({1} + 1)",
    "perceived_shift": "({0} − {1})/{2}",
    "tip_diameter": "{0} + 2·({1} + {2} − {3})·{4}",
    "root_diameter": "{0} − 2·({1} + {2} − {3})·{4}",
    "centre_by_rolling": "{0}/2 + {1}/2",
    "centre_by_shift": "{0}/2 + {1}/2 + {2}·{3}",
    "centre_by_clearance": "{0}/2 + {1}/2 + {2}·{3}",
    "base_diameter": "{0}·cos {1}",
    "angular_pitch": "360°/{0}",
    "pitch_chord": "{0}·sin ({1}/2)",
    "pitch": "π·{0}",
    "base_pitch": "{0}·cos {1}",
    "tooth_thickness": "(π/2 + 2·{1}·tan {2})·{0}",
    "tooth_depth": "(2·{0} + {1} − {2})·{3}",
    "tip_angle": "arccos ({0}/{1})",
    "radius_of_curvature": "{0}·tan {1}/2",
    "lower_curvature": "{0}·sin {1} − {2}·tan {3}/2",
    "unrolled_angle": "(2·{0}/{1})·180°/π",
    "least_shift": "{0} − {1} − {2}·sin^{{2}} {3}/2",
    "boundary_curvature": "{0}·sin {1}/2 − ({2} − {3} − {4})·{5}/sin {1}",
    "contact_ratio": "({0}·tan {1} + {2}·tan {3} − ({0} + {2})·tan {4})/(2π)",
    "tip_thickness": "(π/2 + 2·{2}·tan {3} + {1}·(inv {3} − inv {4}))·{0}·cos {3}/cos {4}",
    "constant_chord": "(π/2·cos^{{2}} {2} + {1}·sin (2·{2}))·{0}",
    "height_of_chord": "({0} − {1} − {2}·tan {3})/2",
    "base_thickness": "({0}/{1} + {2})·{3}",
    "common_normal": "{0} + ({2} − 1)·{1}",
}
SHOWN = {"m": ("mm", 1e3, 3), "rad": ("deg", 180.0 / math.pi, 3), "1": ("", 1.0, 4)}  # unit, how many, decimals
INV = "", 1.0, 6  # of the involute function
SHORT = 4  # decimals of a number that is printed as it is
NOISE = 1e-9  # by which it may differ


def sizes_block(scene: GearScene, width: float) -> View:
    """Return the calculation of the main sizes and its checks, sections I and II of the note."""
    lines = [*_lines(scene, SIZES.split()), *_lines(scene, CENTRES, "a_w")]
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
    if step.law not in FORMULAS:
        number = words.number(scene.size(step.name) * times, decimals)
        return (f"{words.symbol(symbol)} = {number}{words.unit(unit) if unit else ''}",)
    text = re.sub(r"(?<!\{)\{(\d)\}(?!\})", lambda found: _operand(step.operands[int(found[1])]), FORMULAS[step.law])
    text = text.replace("tan", words.symbol("tan"))
    terms: Terms = [_term(scene, name) for name in step.operands]
    _, value, exact = _term(scene, step.name)
    if exact:  # without zeros at its end
        decimals = len(f"{value:.{SHORT}f}".rstrip("0").rpartition(".")[2])
    return worked(words, Formula(symbol, text, _in_print(step), terms, unit, decimals))


def shown(name: str) -> tuple[str, float, int]:
    """Return the unit in which a quantity is printed, how many of it an SI unit has, and the decimals."""
    return INV if name.startswith("inv") else SHOWN[VALUES[name] or "1" if name in VALUES else unit_of(name)]


def _operand(name: str) -> str:
    """Return the place of a term in a formula, an angle with its sign behind its number."""
    return f"{{{name}}}" + ("{deg}" if shown(name)[0] == "deg" else "")


def _term(scene: GearScene, name: str) -> tuple[str, float, bool]:
    """Return a quantity with its number as it is printed; a short one as it is."""
    value = scene.size(name) * shown(name)[1]
    short = round(value, SHORT)
    exact = abs(value - short) < NOISE
    return name, short if exact else value, exact


def _in_print(step: Step) -> Callable[..., float]:
    """Return the law of a step for numbers as they are printed."""
    law: Callable[..., Any] = LAWS[step.law]
    times = [shown(name)[1] for name in step.operands]

    def found(*numbers: float) -> float:
        return float(law(*(number / of for number, of in zip(numbers, times, strict=True)))) * shown(step.name)[1]

    return found


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
