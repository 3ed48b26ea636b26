"""The condition of a hoist's quantities: how much of an error of the data comes through.

K is that of `plans.condition`, over Q. Roots are found beside the board, so that the derivatives are central
differences of all of it.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

from ..condition import STEP, Condition, ratio
from ..references import worst_behind
from .givens import NEAREST
from .hoist import PARTS, VALUES
from .solve import SolvedHoist, solve_hoist


def conditions_of(solved: SolvedHoist) -> dict[str, Condition]:
    """Return the condition of every quantity."""
    numbers = {name: float(solved.givens[name]) for name in VALUES}
    totals = dict.fromkeys(solved.quantities, 0.0)
    for name, value in numbers.items():
        if value == 0.0 or math.isinf(value):  # a beam without a load is as rigid as one that is infinitely stiff
            continue
        high, low = value * (1.0 + STEP), value * (1.0 - STEP)
        if name in PARTS:
            high = min(high, NEAREST)
        more, less = (_sizes(solved, {**numbers, name: other}) for other in (high, low))
        for quantity in totals:
            totals[quantity] += abs(more[quantity] - less[quantity]) * (value / (high - low))
    worst, own = worst_behind(solved.program, solved.sines), _sizes(solved, numbers)
    return {name: Condition(ratio(total, abs(own[name])), worst.get(name, 1.0)) for name, total in totals.items()}


def _sizes(solved: SolvedHoist, numbers: Mapping[str, float]) -> dict[str, float]:
    """Return the values of the quantities of a hoist with other numbers, NaN for what it has not."""
    there = solve_hoist(solved.hoist, numbers, solved.plans).quantities
    values = ((name, there[name].value if name in there else None) for name in solved.quantities)
    return {name: math.nan if value is None else value for name, value in values}
