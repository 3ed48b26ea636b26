"""The work on a hoist told step by step, as an explanatory note numbers it: formulas with their numbers, drawings.

A formula is written once, as an expression in names of quantities; `formula` prints it with letters and with numbers.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass

from ...plans.hoist.model import CIRCLE
from ...scales.scale import Scale
from ..notes.blocks import Story
from .conclusions import conclusions
from .scene import HoistScene

LARGE, SMALL, DIGITS, PAPER = 1e8, 1e-3, 4, 1  # sizes from which on a number has a power of ten; decimals
NAME = re.compile(r"\b(?!sqrt\b)[A-Za-z]\w*")
SIGNS = (("**1.5", "^{3/2}"), ("**2", "^{2}"), ("**3", "^{3}"), ("*", "·"), (" - ", " − "), ("sqrt", "√"))


@dataclass(frozen=True, slots=True)
class Formula:
    """A quantity, the expression that it follows from, its unit, and its number in the article."""

    name: str
    expression: str
    unit: str = ""
    number: str = ""


REDUCED = (
    Formula("m", "(G_1 + G_2/3)/g", "kg", "4"),
    Formula("alpha_0", "1/(beta_0**2*(1 - beta_0)**2)", "", "6"),
    Formula("C_01", "3*E_0*I_0*alpha_0/l_0**3", "N/m", "5"),
    Formula("alpha_2", "1/(beta_2**2*(1 - beta_2)**2)", "", "7"),
    Formula("C_2", "3*E_2*I_2*alpha_2/l_2**3", "N/m", "7"),
    Formula("C_k", "S*E_k/L", "N/m", "7"),
    Formula("C_12", "C_k*C_2/(C_k + C_2)", "N/m", "7"),
    Formula("C", "C_01*C_12/(C_01 + C_12)", "N/m"),
    Formula("k", "sqrt((C_01 + C_12)/m)", "rad/s"),
    Formula("k_1", "sqrt(C_12/m)", "rad/s"),
)
SLACK = Formula("V_t", "sqrt(V_0**2 + 2*a*slack)", "m/s")
STARTED = (
    Formula("P_m", "m*(g + a)", "N"),
    Formula("D_0", "F_12_t1 - P_m", "N"),
    Formula("R", "sqrt(D_0**2 + D_1**2)", "N"),
)
HANGING = (
    Formula("T_1", "phi_1/k_1", "s", "15′"),
    Formula("P_12_max", "P_m + R", "N", "15′"),
    Formula("P_12_min", "P_m - R", "N"),
)
BENT = tuple(
    formula
    for i, force in ((0, "P_st"), (2, "P_12_max"))
    for formula in (
        Formula(f"w_{i}_max", f"{force}*b_{i}*(l_{i}**2 - b_{i}**2)**1.5/(9*sqrt(3)*E_{i}*I_{i}*l_{i})", "m"),
        Formula(f"x_w{i}", f"sqrt((l_{i}**2 - b_{i}**2)/3)", "m"),
    )
)


def story(scene: HoistScene, scales: Mapping[str, Scale], texts: Mapping[str, str]) -> Story:
    """Return what the note of a hoist says beside its views: formulas with numbers, and how each drawing is made.

    Parameters
    ----------
    scales : mapping of str to Scale
        By plan.
    texts : mapping of str to str
        The sentences, by key.
    """
    moved = scene.solved.forces.motion is not None
    slack = (SLACK,) if scene.size("slack") > 0.0 else ()
    circle = (*_lines(scene, STARTED[:2]), _value(scene, "D_1", "F′_{12}(t_{1})/k_{1}"), *_lines(scene, STARTED[2:]))
    equations = {
        "model": _lines(scene, (*REDUCED, *slack)),
        "lift_off": () if moved else _lift_off(scene),
        "extremes": () if moved else _resting(scene),
        "circle": circle if moved else (*circle, *_lines(scene, HANGING)),
        "beams": _lines(scene, BENT),
    }
    return Story(
        equations=equations, conclusions=tuple(conclusions(scene, texts)), texts=texts, said=_said(scene, scales)
    )


def formula(scene: HoistScene, told: Formula) -> tuple[str, ...]:
    """Return a formula with letters, with numbers and with its value; what is infinite is not put in."""
    names = NAME.findall(told.expression)
    value = scene.size(told.name)
    chunks = [f"{scene.words.symbol(told.name)} = {_printed(told.expression, _letters(scene, names))}"]
    if all(math.isfinite(scene.size(name)) for name in names):
        numbers = {name: _number(scene, scene.size(name), inside=True) for name in names}
        chunks.append(f"= {_printed(told.expression, numbers)}")
    unit = f" {scene.words.unit(told.unit)}" if told.unit else ""
    chunks.append(f"= {_number(scene, value)}{unit}")
    return (*chunks, f"({told.number})") if told.number else tuple(chunks)


def _lines(scene: HoistScene, formulas: tuple[Formula, ...]) -> tuple[tuple[str, ...], ...]:
    """Return formulas, without what is nothing because a beam is rigid."""
    return tuple(formula(scene, told) for told in formulas if not (told.name[0] == "w" and not scene.size(told.name)))


def _letters(scene: HoistScene, names: list[str]) -> dict[str, str]:
    return {name: scene.words.symbol(name) for name in names}


def _printed(expression: str, parts: Mapping[str, str]) -> str:
    """Return an expression as it is printed, with letters or numbers in the place of names."""
    pieces = NAME.split(expression)
    for plain, sign in SIGNS:
        pieces = [piece.replace(plain, sign) for piece in pieces]
    names = [parts[name] for name in NAME.findall(expression)]
    raised = [f"({name})" if "^{" in after and "·10" in name else name for name, after in _followed(names, pieces)]
    return "".join(piece + name for piece, name in zip(pieces, [*raised, ""], strict=True))


def _followed(names: list[str], pieces: list[str]) -> list[tuple[str, str]]:
    """Return names with what follows at once."""
    return [(name, after[:2]) for name, after in zip(names, pieces[1:], strict=True)]


def _number(scene: HoistScene, value: float, inside: bool = False) -> str:
    """Return a number, a very large or small one with a power of ten, a negative one inside a formula in brackets."""
    size = abs(value)
    if math.isinf(value):
        return "∞"
    if size == 0.0 or SMALL <= size < LARGE:
        text = scene.words.short(value) if value == round(value, 2) else scene.value(value)
    else:
        power = math.floor(math.log10(size))
        text = f"{scene.words.short(float(f'{value * 10.0**-power:.{DIGITS}g}'))}·10^{{{power}}}".replace("{-", "{−")
    return f"({text})" if inside and value < 0.0 else text


def _value(scene: HoistScene, name: str, expression: str, unit: str = "N") -> tuple[str, ...]:
    number = f"= {scene.value(scene.size(name))} {scene.words.unit(unit)}"
    return f"{scene.words.symbol(name)} = {expression}", number


def _lift_off(scene: HoistScene) -> tuple[tuple[str, ...], ...]:
    V = scene.words.symbol("V_t")
    height = f"= {_number(scene, scene.size('P_st') / scene.size('C'))} {scene.words.unit('m')}"
    return (
        (f"y(t) = {V}·t + a·t^{{2}}/2",),
        (f"osc(t) = (a/k^{{2}})·(1 − cos kt) + ({V}/k)·sin kt",),
        ("y(t) − osc(t) = mg/C", height, "(11)"),
        (scene.stated("t_1", unit="s"),),
    )


def _resting(scene: HoistScene) -> tuple[tuple[str, ...], ...]:
    words = scene.words
    V, ratio = words.symbol("V_t"), f"({words.symbol('C_01')}/{words.symbol('C_12')})"
    force = f"F_{{12}}(t) = C·[({words.symbol('C_12')}/{words.symbol('C_01')})·osc(t) + y(t)]"
    return (
        (f"(a/k)·sin kt + {V}·cos kt = −{ratio}·({V} + a·t)", "(12)"),
        (force, "(10)"),
        (scene.stated("F_12_t1"),),
        (scene.stated("F_12_max"),),
    )


def _said(scene: HoistScene, scales: Mapping[str, Scale]) -> dict[str, str]:
    """Return what sentences may name: quantities with letters and units, the circle on paper."""
    words = scene.words
    forces = ("P_st", "P_m", "F_12_t1", "F_12_max", "P_12_max", "P_12_min", "R")
    found = {name: scene.stated(name) for name in forces}
    found |= {name: scene.stated(name, unit="s") for name in ("t_1", "T_1")}
    found |= {name: scene.stated(name, unit="m") for name in ("l_0", "b_0", "l_2", "b_2", "L", "x_w0", "x_w2")}
    found["phi_1"] = scene.stated("phi_1", unit="rad")
    mu = scales[CIRCLE].mu if CIRCLE in scales else 1.0
    drawn = {f"{name}_drawn": scene.size(name) / mu for name in ("P_m", "R")}
    return found | {name: f"{words.number(size, PAPER)} {words.unit('mm')}" for name, size in drawn.items()}
