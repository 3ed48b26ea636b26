"""The condition of each quantity: how much of an error of the data comes through, how flatly lines meet behind it.

K = sum over the givens of |x dQ/dx| over a size: when every given errs by one part in a thousand, Q may miss by K
thousandths of that size. It is the largest vector of the plan that shows Q (for points and lengths the size of the
mechanism), and the magnitude of Q itself where Q is calculated and no plan shows it: of a calculated Q log10 K digits
are lost. Per cents count beside a hundred. A value that is zero but for rounding has no digit to lose, and no K. The
derivatives are exact: the same program runs on dual numbers.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..scales.errors import InputError
from .board import Program
from .boards.dual import Dual, root, slopes_of, value_of
from .boards.exact import PlainBoard
from .laws import cross, dot
from .quantities import plans_of, references, results, unit_of, worst_behind

STEP = 1e-5  # part of a given, of central differences where duals do not reach; what these leave out is its square
MOST = 2.0**52  # K from which on a value is nothing but rounding


@dataclass(frozen=True, slots=True)
class Condition:
    """The condition of a quantity, None where it has none, and the sine of the worst intersection behind it."""

    value: float | None
    sine: float


class DualBoard(PlainBoard):
    """One position with its derivatives by the givens that are dual numbers."""

    @staticmethod
    def _sqrt(square: Any) -> Any:
        return root(square) if isinstance(square, Dual) else PlainBoard._sqrt(square)

    @staticmethod
    def _complex(real: Any, imag: Any) -> Any:
        value = complex(value_of(real), value_of(imag))
        if isinstance(real, Dual) or isinstance(imag, Dual):
            return Dual(value, slopes_of(real) + slopes_of(imag) * 1j)
        return value

    def _turn(self, angle: Any) -> Any:
        """Turn a direction by 90 degrees for its derivative by the angle: the protractor's table has none."""
        if not isinstance(angle, Dual):
            return super()._turn(angle)
        direction = super()._turn(angle.value)
        return Dual(direction, angle.slopes * (direction * 1j))

    def _angle(self, first: Any, second: Any) -> Any:
        angle = super()._angle(value_of(first), value_of(second))
        return Dual(angle, _turning(second) - _turning(first))


def _turning(direction: Any) -> Any:
    """Return the derivatives of the angle of a direction."""
    value, slopes = value_of(direction), slopes_of(direction)
    return cross(value, slopes) / dot(value, value)


def derivatives(program: Program, givens: Mapping[str, Any], varied: Collection[str]) -> dict[str, Any]:
    """Return x dQ/dx of every name that the program makes, for each given x of `varied`, in this order.

    The derivatives, in units of the quantity, have the shape (givens,), and are complex for vectors.
    """
    one = np.eye(len(varied))
    own = {name: Dual(float(givens[name]), one[i] * givens[name]) for i, name in enumerate(varied)}
    board = DualBoard({**givens, **own})
    with np.errstate(invalid="ignore", divide="ignore"):
        program.run(board)
    return {name: np.broadcast_to(slopes_of(board.values[name]), len(varied)) for name in program.names}


def by_solving_again(
    solve_with: Callable[[Mapping[str, float]], Mapping[str, Any]], numbers: Mapping[str, float]
) -> dict[str, float]:
    """Return the sum of |x dQ/dx| over the `numbers` x of every Q, by differences: of what is found beside the board.

    A number at the end of what is permitted is changed to one side alone; one that is nothing or infinite has no parts.
    """
    right = solve_with(numbers)
    totals = dict.fromkeys(right, 0.0)
    for name, value in numbers.items():
        if value == 0.0 or math.isinf(value):
            continue
        found, apart = [], 0.0
        for step in (STEP, -STEP):
            try:
                found.append(solve_with({**numbers, name: value * (1.0 + step)}))
                apart += STEP
            except InputError:
                found.append(right)
        more, less = found
        for quantity in totals:
            totals[quantity] += abs(more[quantity] - less[quantity]) / apart if apart else math.inf
    return totals


def conditions(
    program: Program, givens: Mapping[str, Any], varied: Collection[str], values: Mapping[str, Any], sines: Any
) -> dict[str, Condition]:
    """Return the condition of every quantity of `program`, whose exact run gave `values` and `sines`.

    The givens `varied` may err: not senses and branches.
    """
    slopes, sizes = derivatives(program, givens, varied), sizes_beside(program, values)
    worst = worst_behind(program, sines)
    found = {}
    for name in (step.name for step in results(program)):
        total = float(np.abs(slopes[name]).sum())
        found[name] = Condition(ratio(total, sizes[name]) if values[name] == values[name] else None, worst[name])
    return found


def sizes_beside(program: Program, values: Mapping[str, Any]) -> dict[str, float]:
    """Return for each quantity the size that its condition refers to, in its unit: see above."""
    shown, sizes = plans_of(program), references(program, values)
    own = {name: float(abs(values[name])) for name in sizes if name not in shown and unit_of(name) != "%"}
    return sizes | own


def ratio(total: float, size: float) -> float | None:
    """Return K from what data do together to a quantity, None for what is undefined or nothing but rounding."""
    if not math.isfinite(total) or size != size:
        return None
    if total == 0.0:
        return 0.0
    return total / size if total < MOST * size else None
