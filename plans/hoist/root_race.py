"""Ways to the lift-off evaluation by evaluation: at the root of a hoist, and at one that is nearly triple.

A root is nearly triple where a load without acceleration stands still as it lifts off: the same rope and speed with a
load that does so.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..laws import TURN
from .finders import FINDERS, Equation, Found, approximations, find, lift_off_equation
from .rivals import exact
from .roots import sine_rest

Array = NDArray[np.float64]
EVALUATIONS = 60
AWAY = 1e-3  # rad by which the nearly triple root is from a whole turn
LEAST = 1e-17  # part of a root that is no error
TOLERANCE = 1e-14  # at which evaluations are counted


@dataclass(frozen=True, slots=True, eq=False)
class Ways:
    """Ways to one root.

    Parameters
    ----------
    root : float
        x = k t_1, rad.
    errors : mapping of str to array of shape (N,)
        By method: of the approximation after each evaluation, in parts of the root; NaN where there is none.
    found : mapping of str to Found
        Where each method stops; the root is NaN where it fails.
    """

    root: float
    errors: Mapping[str, Array]
    found: Mapping[str, Found]

    def error(self, method: str) -> float:
        """Return the error where a method stops, in parts of the root."""
        return abs(self.found[method].root / self.root - 1.0)


@dataclass(frozen=True, slots=True, eq=False)
class RootRace:
    """Ways to the root of the hoist itself, and to the nearly triple one."""

    own: Ways
    triple: Ways


def root_race(values: Mapping[str, float]) -> RootRace:
    """Follow all ways to both roots.

    Parameters
    ----------
    values : mapping of str to float
        The complete givens of a hoist on a support that yields, SI.
    """
    right = exact(values)
    k, height = float(right["k"]), float(right["P_st"] / right["C"])
    V = float(right["V_t"])
    own = lift_off_equation(V, values["a"], k, height)
    speed = V if V > 0.0 else values["a"] / k  # of a rope that starts from rest: what it has soon after
    x = TURN + AWAY
    triple = lift_off_equation(speed, 0.0, k, speed / k * float(sine_rest(x)))
    return RootRace(_ways(own, float(right["k"] * right["t_1"])), _ways(triple, x))


def _ways(equation: Equation, root: float) -> Ways:
    errors = {}
    for method in FINDERS:
        with np.errstate(invalid="ignore", over="ignore"):
            guesses = np.array(approximations(method, equation, EVALUATIONS))
            away = np.abs(guesses / root - 1.0)
        errors[method] = np.where(np.isfinite(away), np.maximum(away, LEAST), np.nan)
    return Ways(root, errors, {method: find(method, equation, TOLERANCE) for method in FINDERS})
