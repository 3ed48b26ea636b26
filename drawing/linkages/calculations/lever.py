"""Equation of Zhukovsky's lever, what balances the driver by it, and the difference from the force plans."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

from ....plans.board import Step
from ....plans.names import role
from ....scales.display import AS_INSIDE
from ...formulas import Symbol
from ...printed import value_text
from ...table import text_block
from ...view import View
from ..reading import read
from ..scene import Scene
from .equations import Lines, Product, moments_in_letters, segment, size_by_law, size_of, turned, worked
from .forces import load_lines
from .moments import terms


def lever_block(scene: Scene, width: float, with_inertia: bool) -> View:
    """Return the moment equation of Zhukovsky's lever and the comparison of what balances the driver."""
    lines = [*(load_lines(scene) if with_inertia else []), *lever_lines(scene)]
    return text_block("equations_lever", scene.words["heading.equations_lever"], lines, scene.style, width)


def lever_lines(scene: Scene) -> Lines:
    """Return the lines of the lever in order of construction."""
    scene = replace(scene, words=scene.words.showing(AS_INSIDE))  # N and kg go with metres
    lines: Lines = []
    for step in scene.solved.program:
        if step.law in TOLD and (step.law != "moment_equation" or role(step.operands[0]).kind == "V"):
            lines += TOLD[step.law](scene, step)
    return lines


def _couple(scene: Scene, step: Step) -> Lines:
    """A couple as two forces on the ends of its link."""
    words = scene.words
    pair = [s.name for s in scene.solved.program if role(s.name).whole == step.name != s.name]
    if not scene.defined(step.name):
        return []
    symbols = " = ".join(dict.fromkeys(words.symbol(name) for name in pair))
    return [size_by_law(scene, symbols, step, "N")]


def _sum(scene: Scene, step: Step) -> Lines:
    """Sum of moments about the pole, each force times its arm in mm, solved for the balancing force."""
    words = scene.words
    speed, *moments = step.operands
    found = terms(scene, moments)
    laid = next(s for s in read(scene.solved.program).users(speed) if s.verb in ("lay", "back"))
    reach = segment(scene, words.mark(laid.operands[0]) + words.mark(laid.name), "lever", size_of(scene, speed))
    # the balancing force along the line of its point's velocity has the moment -F * V, with the signs of both
    turn = math.copysign(1.0, scene.solved.values[step.name] * scene.solved.values[speed])
    symbol = words.symbol(step.name)
    own = Symbol.of(symbol) * reach.letter * -turn
    lines: Lines = [(f"ΣM_{{{words.mark('lever.p')}}} = 0:", *moments_in_letters(own, found), "= 0")]
    if found:
        lines.append(worked(words, symbol, turned(found, turn), "N", Product((reach,))))
    return lines


def _moment(scene: Scene, step: Step) -> Lines:
    """The balancing force as a moment on the crank."""
    return [size_by_law(scene, scene.words.symbol(step.name), step, "N*m")]


def _difference(scene: Scene, step: Step) -> Lines:
    """The difference of two values in per cent, of their printed values."""
    words, values = scene.words, scene.solved.values
    lever, plan = (abs(values[name]) for name in step.operands)
    if lever == 0.0:
        return []
    a, b = value_text(words, lever), value_text(words, plan)
    first, second = (words.symbol(name) for name in step.operands)
    head = f"{words.symbol(step.name)} = ({first} − {second})/{first}·100 % ="
    return [(head, f"({a} − {b})/{a}·100 % =", f"{words.number(values[step.name], 2)} %")]


TOLD: dict[str, Callable[[Scene, Step], Lines]] = {
    "couple": _couple,
    "moment_equation": _sum,
    "crank_moment": _moment,
    "difference": _difference,
}
