"""The involute function inv(alpha) = tan(alpha) - alpha and its inverse, to the last digits at every angle.

Both work on t = tan(alpha), in which t - arctan(t) is a series where the difference of the two would lose digits.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
SMALL = 0.5  # below it the series is summed
TERMS = tuple((-1.0) ** k / (2 * k + 3) for k in range(26))  # t - arctan(t) = t^3 (1/3 - t^2/5 + t^4/7 - ...)
STEPS = 6  # of Newton, which needs four from the start that it has


def _known(slope: Callable[[Any], Any]) -> Callable[[Callable[[Any], Array]], Callable[[Any], Any]]:
    """Return what lets a function take numbers that know their derivatives, by its own `slope`."""
    return lambda function: wraps(function)(
        lambda x: x.through(function, slope) if hasattr(x, "through") else function(x)
    )


@_known(lambda t: t * t / (1.0 + t * t))
def unrolled(t: Any) -> Array:
    """Return t - arctan(t): the involute function of an angle whose tangent is `t`.

    For a point of an involute t is also the angle by which the line has been unrolled from the base circle.
    """
    t = np.asarray(t, float)
    square = np.minimum(t * t, SMALL * SMALL)
    series = np.full_like(t, TERMS[-1])
    for term in TERMS[-2::-1]:
        series = series * square + term
    found: Array = np.where(np.abs(t) < SMALL, t * square * series, t - np.arctan(t))
    return found


def involute(alpha: Any) -> Any:
    """Return inv(alpha) of angles, rad, between right angles."""
    return unrolled(np.tan(alpha))


@_known(lambda inv: 1.0 + tangent_of_involute(inv) ** -2.0)
def tangent_of_involute(inv: Any) -> Array:
    """Return tan(alpha) of the angles with the given involute functions, at least 0; NaN where these are negative.

    Newton's steps on t - arctan(t), which is convex: the first one passes the root, the others come down to it.
    """
    inv = np.asarray(inv, float)
    kept = np.where(inv > 0.0, inv, 1.0)
    t = np.maximum(np.cbrt(3.0 * kept), kept)  # both are below the root
    for _ in range(STEPS):
        t = t - (unrolled(t) - kept) * (1.0 + 1.0 / (t * t))
    found: Array = np.where(inv > 0.0, t, np.where(inv == 0.0, 0.0, np.nan))
    return found


def angle_of_involute(inv: Any) -> Any:
    """Return the angles, rad, with the given involute functions; NaN where these are negative."""
    return np.arctan(tangent_of_involute(inv))
