"""The condition of a gear pair's quantities: how much of an error of the data comes through, how flatly lines meet.

K is that of `plans.condition`, over Q; lengths that are drawn count beside the module at least. Numbers of teeth do not
err.
"""

from __future__ import annotations

import numpy as np

from ..condition import Condition, derivatives, ratio
from ..references import worst_behind
from .gear import VALUES
from .solve import SolvedGear

WHOLE = ("z_1", "z_2")
MODULE, ONE = "m", 1.0


def conditions_of(solved: SolvedGear) -> dict[str, Condition]:
    """Return the condition of every quantity; what is given has that of a number alone."""
    varied = [name for name in VALUES if solved.givens.get(name) and name not in WHOLE]
    slopes = derivatives(solved.program, solved.givens, varied)
    slopes |= {name: solved.givens[name] * np.eye(len(varied))[i] for i, name in enumerate(varied)}
    worst = worst_behind(solved.program, solved.sines)
    found = {}
    for name in solved.quantities:
        slope = slopes.get(name, 0.0 if name in solved.givens else np.nan)
        total = float(np.abs(slope).sum())
        found[name] = Condition(ratio(total, _size(solved, name)), worst.get(name, ONE))
    return found


def _size(solved: SolvedGear, name: str) -> float:
    """Return the size beside which an error of a quantity counts, SI."""
    own = float(abs(solved.values[name]))
    drawn = name in solved.shown_on and solved.quantities[name].unit == MODULE
    return max(own, float(solved.givens["m"])) if drawn else own
