"""Which step errs most: the construction drawn once for each single error of the hand, all others being none.

To first order these errors add up like variances. Nothing here is left to chance. Along a chain of marks, each drawn
from the one before it, they add up to what a teacher should let pass.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..boards.exact import run
from ..laws import dot
from ..references import results
from .hand import Hand, Tolerance, hand_within
from .shaky import Paper, Shape, draw

Array = NDArray[Any]
STEP = 1e-3  # standard deviations; the error of a central difference is its square


@dataclass(slots=True)
class _OneByOne:
    """Errors one at a time, forth and back, in the second axis; none at all where there is no such axis."""

    done: int = 0

    def standard_normal(self, size: Shape, /) -> Array:
        errors = np.zeros(size)
        if errors.ndim == 2:
            errors[:, self.done] = STEP, -STEP
        self.done += 1
        return errors


@dataclass(frozen=True, slots=True)
class Sensitivities:
    """How far each quantity misses for each error of one standard deviation.

    `steps` are those at which the errors are made; `misses` arrays of shape (errors,), SI, complex for vectors and
    points.
    """

    steps: tuple[str, ...]
    misses: Mapping[str, Array]
    exact: Mapping[str, Any]

    def parts(self, name: str) -> dict[str, float]:
        """Return the steps at which a quantity's error is made, with their parts of its variance, largest first.

        Where the least error of a step already breaks the construction, only such steps, and NaN for their parts.
        """
        squares: dict[str, float] = {}
        for step, miss in zip(self.steps, self.misses[name], strict=True):
            squares[step] = squares.get(step, 0.0) + abs(miss) ** 2
        broken = [step for step, square in squares.items() if square != square]
        if broken:
            return dict.fromkeys(broken, float("nan"))
        total = sum(squares.values())
        ranked = sorted(squares.items(), key=lambda item: -item[1])
        return {step: float(square / total) for step, square in ranked if square > 0.0}

    def deviation(self, name: str) -> float:
        """Return the standard deviation of a quantity to first order, of a vector that of its magnitude, SI."""
        misses, exact = self.misses[name], self.exact[name]
        if isinstance(exact, complex) and exact:
            misses = dot(misses, exact * (1.0 / abs(exact)))
        return float(np.sqrt(np.sum(np.abs(misses) ** 2)))


def sensitivities(paper: Paper, hand: Hand, names: Iterable[str] = ()) -> Sensitivities:
    """Draw a construction once for each error of the hand alone.

    Parameters
    ----------
    names : iterable of str
        Quantities wanted; all when empty. Steps that they do not need are not done.
    """
    wanted = tuple(names) or tuple(step.name for step in results(paper.program))
    paper = replace(paper, program=paper.program.needed_for(wanted))
    steps = tuple(draw(paper, hand, _OneByOne(), 1).erred)
    board = draw(paper, hand, _OneByOne(), (2, len(steps)))
    exact = run(paper.program, paper.givens).values
    misses = {name: _misses(np.broadcast_to(board.values[name], (2, len(steps))), exact[name]) for name in wanted}
    return Sensitivities(steps, misses, exact)


def _misses(values: Array, exact: Any) -> Array:
    """Return what errors forth and back do: a distance that should be none grows with either."""
    if np.isinf(exact):  # of a rigid beam
        return np.zeros(values.shape[1:])
    forth, back = values
    slope, kink = (forth - back) * (0.5 / STEP), abs((forth + back) * 0.5 - exact) * (1.0 / STEP)
    found: Array = np.where(kink > abs(slope), kink, slope)
    return found


MOST = 2.0  # standard deviations that nearly all honest hands keep


def added_up(paper: Paper, tolerance: Tolerance, names: Iterable[str]) -> dict[str, float]:
    """Return by how much quantities may differ, SI: twice what all errors of the hand come to, as variances do.

    The rule of `tolerances` looks at a segment and at the lines that meet at its ends. The last mark of a curve that is
    drawn chord by chord also misses by what all marks before it have missed.
    """
    wanted = tuple(names)
    found = sensitivities(paper, hand_within(tolerance), wanted)
    return {name: MOST * found.deviation(name) for name in wanted}
