"""Roots of the hoist's equations (11) and (12), each found between two known places, for one hoist or for many.

With x = k t, u = a/k the first is V (x - sin x) + u (x^2/2 - 1 + cos x) = k h, h = m g / C, whose left side never
falls; the second is u sin x + V cos x + (C_01/C_12) (V + u x) = 0, a cosine on a rising line. The second differs by one
positive factor from the rate of the rope's force, so that its roots on the way down are maxima of the force. A turn of
k t later the force is always greater by what has been wound up: maxima follow one another upwards, and so do minima.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..laws import NAN, TURN
from .series import cosine_rest, sine_rest
from .waves import Wave, rising_zero

STANDING = 1e-9  # part of the speeds that is none


def time_to_wind(V: Any, a: Any, length: Any) -> Any:
    """Return the time in which V t + a t^2/2 becomes a length; zero where that is not positive."""
    length = np.where(length > 0.0, length, 0.0)
    root = np.sqrt(V * V + 2.0 * a * length)
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.where(length > 0.0, 2.0 * length / (V + root), 0.0)


def lag(V: Any, u: Any, x: Any) -> Any:
    """Return k (y - osc) of (11), without cancellation: what is wound up less the oscillation, at x = k t, u = a/k."""
    return V * sine_rest(x) + u * cosine_rest(x)


def lag_rate(V: Any, u: Any, x: Any) -> Any:
    """Return the derivative of `lag` by x: V (1 - cos x) + u (x - sin x), never negative."""
    half = np.sin(0.5 * x)
    return 2.0 * V * half * half + u * sine_rest(x)


def bracket(V: Any, a: Any, k: Any, height: Any) -> tuple[Any, Any]:
    """Return two places x = k t between which (11) has its root: its oscillation is between -V/k and V/k + 2 a/k^2."""
    return k * time_to_wind(V, a, height - V / k), k * time_to_wind(V, a, height + V / k + 2.0 * a / (k * k))


@np.errstate(invalid="ignore", divide="ignore")
def lift_off(V: Any, a: Any, k: Any, height: Any) -> Any:
    """Return t_1, the root of (11): when the support carries nothing any more.

    Parameters
    ----------
    V, a : float or array
        Speed and acceleration of the rope's upper end, m/s, m/s^2; not both zero.
    k : float or array
        rad/s; infinite on a rigid support.
    height : float or array
        m g / C, m.
    """
    V, a, k, height = np.broadcast_arrays(V, a, k, height)
    rigid = np.isinf(k)
    rate = np.where(rigid, 1.0, k)
    u = a / rate
    low, high = bracket(V, a, rate, height)
    wanted = rate * height

    def surplus(x: Any) -> tuple[Any, Any]:
        return lag(V, u, x) - wanted, lag_rate(V, u, x)

    x = rising_zero(surplus, np.where(rigid, NAN, low), np.where(rigid, NAN, high))
    return np.where(rigid, time_to_wind(V, a, height), x / rate)


def force_rate(V: Any, a: Any, k: Any, ratio: Any) -> Wave:
    """Return the left side of (12) as a wave of x = k t; `ratio` is C_01/C_12, infinite where nothing swings."""
    u = a / k
    return Wave(np.sqrt(V * V + u * u), np.arctan2(u, V), ratio * V, ratio * u)


@np.errstate(invalid="ignore", divide="ignore")
def last_maximum(V: Any, a: Any, k: Any, ratio: Any, t_1: Any) -> Any:
    """Return when the force of the rope was greatest for the last time before t_1; NaN where it never was."""
    wave, end = force_rate(V, a, k, ratio), np.asarray(k * t_1)
    n = np.fmin(np.floor((end - wave.psi - wave.crest) / TURN), wave.last)
    late, early = wave.falling(n), wave.falling(n - 1.0)
    found = np.where(late < end, late, np.where(n >= 1.0, early, NAN))
    return np.where((n >= 0.0) & (wave.last >= 0.0), found, NAN) / k


@np.errstate(invalid="ignore", divide="ignore")
def first_minimum(V: Any, a: Any, k: Any, ratio: Any, t_1: Any) -> Any:
    """Return when the force of the rope was least for the first time before t_1; NaN where it never was."""
    wave, end = force_rate(V, a, k, ratio), np.asarray(k * t_1)
    x = wave.rising(0.0)
    return np.where((wave.last >= 0.0) & (x < end), x, NAN) / k


@np.errstate(invalid="ignore", divide="ignore")
def extremes(V: float, a: float, k: float, ratio: float, t_1: float, begin: float = 0.0) -> tuple[Any, Any]:
    """Return the roots of (12) from `begin` to t_1, times of maxima and of minima of the rope's force, in order."""
    wave, end, start = force_rate(V, a, k, ratio), k * t_1, k * begin
    if not wave.last >= 0.0:
        return np.zeros(0), np.zeros(0)
    most = min(float(np.floor((end - wave.psi - wave.crest) / TURN)), float(wave.last))
    n = np.arange(max(np.floor((start - wave.psi - wave.crest) / TURN) - 1.0, 0.0), most + 1.0)
    maxima, minima = (roots[(roots > start) & (roots < end)] for roots in (wave.falling(n), wave.rising(n)))
    return maxima / k, minima / k


@np.errstate(invalid="ignore", divide="ignore")
def lowest_after(speed: Any, a: Any, k_1: Any, D_0: Any, D_1: Any, m: Any) -> Any:
    """Return after which time T the lifted load is lowest; a whole swing where it never sinks.

    Its speed is V + a t_1 + a T - P'/C_12 with P' = k_1 (D_1 cos k_1 T - D_0 sin k_1 T), and C_12 = m k_1^2: at the
    first time that it ceases to sink it is lowest, for a swing later it is always higher.

    Parameters
    ----------
    speed : float or array
        V + a t_1 of the rope's upper end at the lift-off.
    """
    part = 1.0 / (m * k_1)
    swing, psi = part * np.sqrt(D_0 * D_0 + D_1 * D_1), np.arctan2(D_0, -D_1)
    wave = Wave(swing, psi, speed, a / k_1)
    sinking = Wave(swing, psi, speed + STANDING * (swing + speed), a / k_1)  # at the lift-off it may stand
    n = wave.first
    return np.where(sinking.last >= n, wave.rising(n), TURN) / k_1
