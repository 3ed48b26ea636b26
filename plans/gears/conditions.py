"""The condition of a gear pair's quantities: how much of an error of the data comes through, how flatly lines meet.

K is that of `plans.condition`, over Q; lengths that are drawn count beside the module at least. Numbers of teeth do not
err. Laws of calculation have no derivatives, so that central differences stand in their place, all numbers at once.
"""

from __future__ import annotations

import numpy as np

from ..boards.arrays import ArrayBoard
from ..condition import STEP, Condition, ratio
from ..references import worst_behind
from .gear import VALUES
from .solve import SolvedGear

WHOLE = ("z_1", "z_2")
MODULE, ONE = "m", 1.0


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
        with np.errstate(invalid="ignore"):  # a sliding without bounds has no difference
            total = float(np.abs(column[0::2] - column[1::2]).sum() * (0.5 / STEP))
        found[name] = Condition(ratio(total, _size(solved, name)), worst.get(name, ONE))
    return found


def _size(solved: SolvedGear, name: str) -> float:
    """Return the size beside which an error of a quantity counts, SI."""
    own = float(abs(solved.values[name]))
    drawn = name in solved.shown_on and solved.quantities[name].unit == MODULE
    return max(own, float(solved.givens["m"])) if drawn else own
