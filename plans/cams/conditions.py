"""The condition of a cam's quantities: how much of an error of the data comes through, how flatly lines meet.

K is that of `plans.condition`, over Q, or over the size that Q is a part of (of e that is r_0). Much of a cam is found
beside the board, by closed forms of its law, so that the derivatives are central differences of all of it.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from ...scales.errors import InputError
from ..boards.exact import run
from ..condition import STEP, Condition, ratio
from ..references import worst_behind
from .cam import VALUES
from .solve import SolvedCam, again

# numbers that neither the motion nor the smallest sizes depend on
ON_BOARD = ("l_A1", "H_a", "H_v", "mu_phi", "omega", "R_roller", "rho_flat", "margin")
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
    totals = dict.fromkeys(solved.quantities, 0.0)
    for name in filter(numbers.get, numbers):  # what is nothing has no parts
        (more, up), (less, down) = (_beside(solved, numbers, name, step) for step in (STEP, -STEP))
        for quantity in totals:
            change = abs(more[quantity] - less[quantity])
            totals[quantity] += change / (up - down) if up > down else math.inf
    worst = worst_behind(solved.program, solved.sines)
    sizes = {name: float(abs(solved.values[BESIDE.get(name, name)])) for name in totals}
    return {name: Condition(ratio(total, sizes[name]), worst.get(name, 1.0)) for name, total in totals.items()}


def _beside(solved: SolvedCam, numbers: Mapping[str, float], name: str, step: float) -> tuple[Mapping[str, Any], float]:
    """Return the values of a cam with a number larger by a step, a part of it, and the step: none where it may not be.

    A size that is given may be the least that the limits permit, and others at their ends.
    """
    try:
        return _with(solved, numbers, name, numbers[name] * (1.0 + step)), step
    except InputError:
        return solved.values, 0.0


def _with(solved: SolvedCam, numbers: Mapping[str, float], name: str, value: float) -> Mapping[str, Any]:
    """Return the values of a cam of which one number is another one."""
    if name in ON_BOARD:
        return run(solved.program, {**solved.givens, name: value}).values
    return again(solved, {**numbers, name: value})
