"""How much of an error of the data comes through in a cam's quantities, and what a teacher should let pass of them.

K is that of `plans.condition`, over Q, or over the size that Q is a part of (of e that is r_0). Much of a cam is found
beside the board, by closed forms of its law, so that the derivatives are central differences of all of it.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from ..boards.exact import run
from ..condition import Condition, by_solving_again, ratio
from ..hands.hand import Tolerance
from ..hands.sensitivities import added_up
from ..hands.shaky import Paper
from ..marking.key import rounded
from ..names import role
from ..references import results, worst_behind
from .cam import VALUES
from .solve import SolvedCam, again

# numbers that neither the motion nor the smallest sizes depend on
ON_BOARD = {"l_A1", "H_a", "H_v", "mu_phi", "omega", "R_roller", "rho_flat", "margin"}
# sizes beside which others count, that may be nothing
BESIDE = {
    **dict.fromkeys(("e", "e_least", "e_most"), "r_0"),
    "e_tangents": "r_0_tangents",
    "s_close": "S_max_chord",
    "v_close": "V_max_chord",
}


def conditions_of(solved: SolvedCam) -> dict[str, Condition]:
    """Return the condition of every quantity, given ones among them."""
    numbers = {name: float(solved.givens[name]) for name in VALUES if name in solved.givens}

    def solve_with(others: Mapping[str, float]) -> Mapping[str, Any]:
        changed = {name for name, value in others.items() if value != numbers[name]}
        on_board = changed <= ON_BOARD
        values = run(solved.program, {**solved.givens, **others}).values if on_board else again(solved, others)
        return {name: values[name] for name in solved.quantities}

    totals = by_solving_again(solve_with, numbers)
    worst = worst_behind(solved.program, solved.sines)
    sizes = {name: float(abs(solved.values[BESIDE.get(name, name)])) for name in totals}
    return {name: Condition(ratio(total, sizes[name]), worst.get(name, 1.0)) for name, total in totals.items()}


MEASURED = ("distance", "read")


def tolerances_of(drawn: SolvedCam, paper: Paper, tolerance: Tolerance) -> dict[str, float]:
    """Return by how much the quantities of a cam that is drawn may differ, SI.

    Each may miss what all errors of the hand add up to; a length that the sheet shows as a segment, also what is let
    pass of such a segment; an angle, what is let pass of a direction where a protractor may have found it. What is
    only calculated from exact numbers, such as the inclination of the line of transfer, is rounded.
    """
    names = [step.name for step in results(paper.program)]
    found = added_up(paper, tolerance, names)
    return {name: max(found[name], _alone(name, drawn, paper, tolerance)) for name in names}


def _alone(name: str, drawn: SolvedCam, paper: Paper, tolerance: Tolerance) -> float:
    """Return what a quantity may miss by itself."""
    value = float(abs(drawn.values[name]))
    least = rounded(value, tolerance)
    if drawn.quantities[name].unit == "rad":
        return max(least, math.radians(tolerance.degrees))
    step = paper.program.by_name[name]
    plan = role(step.operands[0]).plan if step.verb in MEASURED else drawn.shown_on.get(name, "")
    if not plan:
        return least
    calculated_there = plan in paper.unscaled and step.verb not in MEASURED
    mu = drawn.values[drawn.scale_of_plan[plan]] if calculated_there else paper.mus[plan]
    return max(least, float(tolerance.of_segment(value / mu) * mu))
