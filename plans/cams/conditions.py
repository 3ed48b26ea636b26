"""The condition of a cam's quantities: how much of an error of the data comes through, how flatly lines meet.

K is that of `plans.condition`, over Q, or over the size that Q is a part of (of e that is r_0). Much of a cam is found
beside the board, by closed forms of its law, so that the derivatives are central differences of all of it.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ..boards.exact import run
from ..condition import Condition, by_solving_again, ratio
from ..references import worst_behind
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
