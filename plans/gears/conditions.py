"""The condition of a gear pair's quantities: how much of an error of the data comes through, how flatly lines meet.

K = sum over the numbers of the task of |x dQ/dx| over Q, or over the size that Q is a part of: when every number errs
by one part in a thousand, Q may miss by K thousandths of that. Lengths count beside the module at least, shifts and
specific sliding beside one, for they may be nothing. Numbers of teeth do not err. Laws of calculation have no
derivatives, so that central differences stand in their place, all numbers at once.
"""

from __future__ import annotations

import numpy as np

from ..boards.arrays import ArrayBoard
from ..condition import Condition
from ..references import worst_behind
from .gear import VALUES
from .solve import SolvedGear

WHOLE = ("z_1", "z_2")
STEP = 1e-5  # part of a number; what is left out of a difference is its square
OWN = ("inv_", "epsilon_")  # numbers without a unit that count beside themselves
MODULE, ONE, PLAIN = "m", 1.0, "1"


def conditions_of(solved: SolvedGear) -> dict[str, Condition]:
    """Return the condition of every quantity; what is given has that of a number alone."""
    varied = [name for name in VALUES if solved.givens.get(name) and name not in WHOLE]
    around = np.ones((len(varied), 2 * len(varied)))
    for i in range(len(varied)):
        around[i, 2 * i : 2 * i + 2] += STEP, -STEP
    numbers = {name: solved.givens[name] * factors for name, factors in zip(varied, around, strict=True)}
    board = ArrayBoard({**solved.givens, **numbers}, 2 * len(varied))
    with np.errstate(invalid="ignore", divide="ignore"):
        board.follow(solved.program)
    worst = worst_behind(solved.program, solved.sines)
    found = {}
    for name in solved.quantities:
        column = np.broadcast_to(board.values.get(name, np.nan), 2 * len(varied))
        total = float(np.abs(column[0::2] - column[1::2]).sum() * (0.5 / STEP))
        size = _size(solved, name)
        found[name] = Condition(total / size if np.isfinite(total / size) else None, worst.get(name, ONE))
    return found


def _size(solved: SolvedGear, name: str) -> float:
    """Return the size beside which an error of a quantity counts, SI."""
    unit, own = solved.quantities[name].unit, float(abs(solved.values[name]))
    if unit == MODULE:
        return max(own, float(solved.givens["m"]))
    return max(own, ONE) if unit == PLAIN and not name.startswith(OWN) else own
