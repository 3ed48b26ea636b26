"""How much of an error of the data comes through in a hoist's quantities, and what a teacher should let pass of them.

K is that of `plans.condition`, over Q. Roots are found beside the board, so that the derivatives are central
differences of all of it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

from ..condition import Condition, by_solving_again, ratio
from ..hands.hand import Tolerance
from ..marking.key import rounded
from ..references import worst_behind
from ..solved import PAPER_MM
from . import root_plans
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


def tolerances_of(solved: SolvedHoist, tolerance: Tolerance) -> dict[str, float]:
    """Return by how much times may miss, SI: what chords err by, and the error of a segment of the drawing."""
    return dict(_times(solved, tolerance))


def _times(solved: SolvedHoist, tolerance: Tolerance) -> Iterator[tuple[str, float]]:
    for name, quantity in solved.quantities.items():
        drawn = solved.quantities.get(root_plans.drawn(name))
        if drawn is None or quantity.value is None or drawn.value is None or not math.isfinite(drawn.value):
            continue
        mu = float(solved.values["mu_t1"]) * PAPER_MM
        of_segment = tolerance.of_segment(abs(drawn.value) / mu) * mu
        yield name, max(abs(drawn.value - quantity.value) + of_segment, rounded(quantity.value, tolerance))
        yield root_plans.drawn(name), max(of_segment, rounded(quantity.value, tolerance))
