"""The condition of a hoist's quantities: how much of an error of the data comes through.

K is that of `plans.condition`, over Q. Roots are found beside the board, so that the derivatives are central
differences of all of it.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

from ..condition import Condition, by_solving_again, ratio
from ..references import worst_behind
from .hoist import VALUES
from .solve import SolvedHoist, solve_hoist


def conditions_of(solved: SolvedHoist) -> dict[str, Condition]:
    """Return the condition of every quantity."""
    numbers = {name: float(solved.givens[name]) for name in VALUES}

    def solve_with(others: Mapping[str, float]) -> dict[str, float]:
        there = solve_hoist(solved.hoist, others, solved.plans).quantities
        values = ((name, there[name].value if name in there else None) for name in solved.quantities)
        return {name: math.nan if value is None else value for name, value in values}

    totals, own = by_solving_again(solve_with, numbers), solve_with(numbers)
    worst = worst_behind(solved.program, solved.sines)
    return {name: Condition(ratio(total, abs(own[name])), worst.get(name, 1.0)) for name, total in totals.items()}
