"""Positions of a cycle at a change point or a limit of assembly, but for rounding: they have no plan of velocities.

Links in line leave the motion undetermined. The angle between them is a root of the rounding there, small but not zero,
and what is computed with it means nothing.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...board import POSITION, Program
from ...boards.exact import STATUSES
from ...laws import TURN
from .limits import Reach
from .swept import Swept

Array = NDArray[Any]
NEAR_CHANGE, NEAR_LIMIT = 1e-7, 1e-12  # radians, or parts of a slide's travel: how well these places are known


def strike_out(
    results: dict[str, Array], codes: NDArray[np.int8], program: Program, undetermined: NDArray[np.bool_]
) -> None:
    """Call the undetermined positions singular, and take from them what hangs on lines that meet in their plans."""
    if not undetermined.any():
        return
    codes[undetermined] = np.maximum(codes[undetermined], STATUSES.index("singular"))
    for name in _hanging(program).intersection(results):
        results[name] = np.where(undetermined, np.nan, results[name])


def undetermined_at(drive: Swept, reach: Reach, places: Array) -> NDArray[np.bool_]:
    """Tell which places of the driver are those of change points or limits."""
    spots = [(x, NEAR_CHANGE) for x in reach.changes] + [(x, NEAR_LIMIT) for x in reach.limits]
    size = 1.0 if drive.turns else reach.whole.length
    found = np.zeros(places.shape, bool)
    for spot, near in spots:
        off = places - spot
        found |= (np.minimum(off % TURN, -off % TURN) if drive.turns else np.abs(off)) <= near * size
    return found


def _hanging(program: Program) -> set[str]:
    """Return the names that hang on lines that meet on plans of velocities, accelerations and forces."""
    found: set[str] = set()
    for step in program:
        if (step.verb == "meet" and step.plan != POSITION) or not found.isdisjoint(step.operands):
            found.add(step.name)
    return found
