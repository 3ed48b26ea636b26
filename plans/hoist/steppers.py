"""Steps in time for u'' = b(t) - w^2 u: the load on its springs, driven by the rope; and where steps become unstable.

Every stepper takes times, states (u, v = u') and steps, numbers or arrays, and gives the state a step later. Explicit
Euler grows at any step; symplectic Euler and Verlet hold to w h = 2, RK4 to 2 sqrt(2), the trapezoid at all steps.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
State = tuple[Any, Any]  # u, m, and v, m/s
EXPLICIT, SYMPLECTIC, VERLET, TRAPEZOID, RK4 = "euler", "symplectic", "verlet", "trapezoid", "rk4"
LEAST = 1e-4  # w h at which a method that grows has no stability limit at all
STABLE = 1e-12  # growth in a step that is rounding
MOST = 1e6  # w h up to which a method is looked at


@dataclass(frozen=True, slots=True, eq=False)
class Motion:
    """u'' = b(t) - w^2 u, or another acceleration.

    Parameters
    ----------
    square : float or array
        w^2, rad^2/s^2.
    drive : callable
        b(t), m/s^2.
    bent : callable, optional
        The acceleration at (t, u) where it is not linear in u.
    """

    square: Any
    drive: Callable[[Any], Any]
    bent: Callable[[Any, Any], Any] | None = None

    def acceleration(self, t: Any, u: Any) -> Any:
        """Return u'', m/s^2."""
        return self.drive(t) - self.square * u if self.bent is None else self.bent(t, u)


Stepper = Callable[[Motion, Any, State, Any], State]


def explicit_euler(motion: Motion, t: Any, state: State, h: Any) -> State:
    """Step along the tangents at the beginning."""
    u, v = state
    return u + h * v, v + h * motion.acceleration(t, u)


def symplectic_euler(motion: Motion, t: Any, state: State, h: Any) -> State:
    """Step the velocity first, then the place with the new velocity."""
    u, v = state
    v = v + h * motion.acceleration(t, u)
    return u + h * v, v


def verlet(motion: Motion, t: Any, state: State, h: Any) -> State:
    """Half a step of the velocity, a step of the place, half a step of the velocity."""
    u, v = state
    half = 0.5 * h
    v = v + half * motion.acceleration(t, u)
    u = u + h * v
    return u, v + half * motion.acceleration(t + h, u)


def trapezoid(motion: Motion, t: Any, state: State, h: Any) -> State:
    """Take the means of both ends: implicit, solved for the new velocity as the motion is linear."""
    u, v = state
    half = 0.5 * h
    before, after = motion.drive(t) - motion.square * u, motion.drive(t + h)
    ahead = u + half * v  # the new place without the new velocity
    late = (v + half * (before + after - motion.square * ahead)) / (1.0 + motion.square * (half * half))
    return ahead + half * late, late


def rk4(motion: Motion, t: Any, state: State, h: Any) -> State:
    """Runge and Kutta's method of fourth order."""
    u, v = state
    half, sixth = 0.5 * h, h * (1.0 / 6.0)
    a_1 = motion.acceleration(t, u)
    v_2 = v + half * a_1
    a_2 = motion.acceleration(t + half, u + half * v)
    v_3 = v + half * a_2
    a_3 = motion.acceleration(t + half, u + half * v_2)
    v_4 = v + h * a_3
    a_4 = motion.acceleration(t + h, u + h * v_3)
    return u + sixth * (v + 2.0 * (v_2 + v_3) + v_4), v + sixth * (a_1 + 2.0 * (a_2 + a_3) + a_4)


STEPPERS: Mapping[str, Stepper] = {
    RK4: rk4,
    VERLET: verlet,
    TRAPEZOID: trapezoid,
    SYMPLECTIC: symplectic_euler,
    EXPLICIT: explicit_euler,
}
ORDERS: Mapping[str, int] = {RK4: 4, VERLET: 2, TRAPEZOID: 2, SYMPLECTIC: 1, EXPLICIT: 1}


def one_step(method: str, z: Any) -> tuple[Any, Any, Any, Any]:
    """Return the matrix of a step h = z / w with no drive, found by taking it: of (u, v / w), row by row."""
    step = STEPPERS[method]
    motion = Motion(1.0, lambda t: 0.0 * t)
    none = 0.0 * np.asarray(z, float)
    (uu, vu), (uv, vv) = (step(motion, none, (one + none, 1.0 - one + none), z) for one in (1.0, 0.0))
    return uu, uv, vu, vv


def growth(method: str, z: Any) -> Array:
    """Return by what an oscillation grows in a step with w h = z in the long run: the spectral radius."""
    uu, uv, vu, vv = one_step(method, z)
    determinant, half = uu * vv - uv * vu, 0.5 * (uu + vv)
    bend = half * half - determinant
    rounding = 8.0 * np.finfo(float).eps * np.maximum(half * half, np.abs(determinant))
    turning = np.sqrt(np.maximum(determinant, 0.0))
    found: Array = np.where(bend <= rounding, turning, np.abs(half) + np.sqrt(np.maximum(bend, 0.0)))
    return found


@cache
def stability_limit(method: str) -> float:
    """Return the largest w h at which oscillations do not grow: 0 when they always do, infinity when they never do."""

    def grows(z: float) -> bool:
        return float(growth(method, z)) > 1.0 + STABLE

    if grows(LEAST):
        return 0.0
    low, high = LEAST, 2.0 * LEAST
    while not grows(high):
        low, high = high, 2.0 * high
        if high > MOST:
            return math.inf
    while low < 0.5 * (low + high) < high:
        middle = 0.5 * (low + high)
        low, high = (low, middle) if grows(middle) else (middle, high)
    return low
