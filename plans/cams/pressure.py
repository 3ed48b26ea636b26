"""The pressure angle of a roller follower that moves along a line, and its least transmission angles.

theta runs from the follower's line to the common normal: tan(theta) = (sense s' - e) / (s_0 + s). Where the cam pushes,
sense * theta is positive in the rise, negative in the fall; the transmission angle is the rest to a right angle.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .motion import FALL, RISE, Extreme, Motion
from .sizes import RIGHT_ANGLE, RollerSizes

ROUNDS = 60  # of a search that doubles its figures in every round
SIDES = {RISE: (1, -1), FALL: (-1, 1)}  # of the velocity: first where the cam pushes, then the other


def pressure_angle(motion: Motion, sizes: RollerSizes, phi: Any, sense: int = 1, side: int = 1) -> NDArray[np.float64]:
    """Return theta, rad, at the angles `phi` of the cam; where s' jumps, the limit from one side."""
    s, ds, _ = motion.at(phi, side)
    theta: NDArray[np.float64] = np.arctan2(sense * ds - sizes.e, sizes.s_0 + s)
    return theta


def least_transmission(
    motion: Motion, sizes: RollerSizes, phase: str, sense: int = 1, two_sided: bool = False
) -> Extreme:
    """Return the least transmission angle of the rise or the fall, rad, exactly, and where it is.

    One-sided, only pressure to the side to which the cam pushes counts, and the angle may exceed a right angle.
    """
    sides = SIDES[phase][: 1 + two_sided]
    steepest = max((_steepest(motion, sizes, phase, sense, way) for way in sides), key=lambda found: found.value)
    return Extreme(RIGHT_ANGLE - math.atan(steepest.value), steepest.phi, phase)


def _steepest(motion: Motion, sizes: RollerSizes, phase: str, sense: int, way: int) -> Extreme:
    """Return the greatest way * sense * tan(theta) = way * (s' - sense e) / (s_0 + s).

    A quotient is greatest where its numerator less so many times its denominator is (Dinkelbach).
    """
    best = Extreme(-math.inf, 0.0, phase)
    slope = 0.0
    for _ in range(ROUNDS):
        found = motion.maximum(-slope, way, 0.0, (phase,))
        s = float(motion.at(found.phi)[0])
        slope = (found.value + slope * s - way * sense * sizes.e) / (sizes.s_0 + s)
        if slope <= best.value:
            break
        best = Extreme(slope, found.phi, phase)
    return best
