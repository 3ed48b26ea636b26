"""Roots of the hoist's equations (11) and (12), each found between two known places, for one hoist or for many.

With x = k t, u = a/k the first is V (x - sin x) + u (x^2/2 - 1 + cos x) = k h, h = m g / C, whose left side never
falls; the second is u sin x + V cos x + (C_01/C_12) (V + u x) = 0, a cosine on a rising line. The second differs by one
positive factor from the rate of the rope's force, so that its roots on the way down are maxima of the force. A turn of
k t later the force is always greater by what has been wound up: maxima follow one another upwards, and so do minima.

A wave A cos(x - psi) + c + d x with d >= 0 is level where sin(x - psi) = d/A, at crests and troughs in turn, and only
rises or only falls between two of them; if one trough is not below zero none of the later ones is.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..laws import NAN, TURN

NEAR = 1.0
TERMS = 10  # the next one is 1e-22 of the first at `NEAR`


def sine_rest(x: Any) -> Any:
    """Return x - sin x."""
    return np.where(np.abs(x) < NEAR, _series(x, 3), x - np.sin(x))


def _cosine_rest(x: Any) -> Any:
    """Return x^2 / 2 - 1 + cos x."""
    half = np.sin(0.5 * x)
    return np.where(np.abs(x) < NEAR, _series(x, 4), 0.5 * x * x - 2.0 * (half * half))


def _series(x: Any, power: int) -> Any:
    """Return x^p/p! - x^(p+2)/(p+2)! + ..., by Horner's rule; places that are far have no part in it."""
    x = np.where(np.abs(x) < NEAR, x, 0.0)
    square, found = x * x, 0.0
    for k in range(TERMS, 0, -1):
        n = power + 2 * k
        found = (1.0 - found) * square * (1.0 / (n * (n - 1)))
    first = x * square if power == 3 else square * square
    return (1.0 - found) * first * (1.0 / math.factorial(power))


Function = Callable[[Any], tuple[Any, Any]]
MOST_ROUNDS = 600  # halving alone needs 54 beside one end that is not zero
CLOSE = 2.0**-52


def _rising_zero(function: Function, low: Any, high: Any) -> Any:
    """Return the zero of a function that only rises, which returns value and slope, between `low` and `high`.

    Newton's steps that stay inside the bracket and are at most half as long as the last but one; else the bracket is
    halved: nothing can make it fail. Each element of an array goes its own way, and stays where it has arrived.
    """
    low, high = (np.array(end, float) for end in np.broadcast_arrays(low, high))
    x, step = 0.5 * (low + high), high - low
    last, arrived = step, np.isnan(x)
    for _ in range(MOST_ROUNDS):
        value, slope = function(x)
        low, high = np.where(value <= 0.0, x, low), np.where(value >= 0.0, x, high)
        with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
            by_newton = x - value / slope
        quick = (by_newton >= low) & (by_newton <= high) & (2.0 * np.abs(by_newton - x) <= np.abs(last))
        following = np.where(arrived, x, np.where(quick, by_newton, 0.5 * (low + high)))
        last, step = step, following - x
        x = following
        arrived |= np.abs(step) <= CLOSE * np.abs(x)
        if bool(np.all(arrived)):
            break
    return x


@dataclass(frozen=True, slots=True, eq=False)
class _Wave:
    """A cos(x - psi) + c + d x; not negative at x = 0, and d >= 0."""

    amplitude: Any
    psi: Any
    c: Any
    d: Any

    @property
    def crest(self) -> Any:
        """How far a crest is beyond x = psi + 2 pi n; NaN where the function only rises."""
        with np.errstate(invalid="ignore", divide="ignore"):
            sine = np.asarray(self.d / self.amplitude)
            return np.arcsin(np.where(sine < 1.0, sine, NAN))

    @property
    def first(self) -> Any:
        """The number n of the first trough beyond zero."""
        return np.ceil((self.crest - self.psi - math.pi) / TURN)

    @property
    def last(self) -> Any:
        """The number of the last trough below zero: less than the first where none is, infinite where all are."""
        crest = self.crest
        trough = self.c + self.d * (self.psi + math.pi - crest) - self.amplitude * np.cos(crest)
        with np.errstate(invalid="ignore", divide="ignore"):
            return np.ceil(-trough / (self.d * TURN)) - 1.0

    def falling(self, n: Any) -> Any:
        """Return the zero on the way down to trough `n`."""
        return self._zero(n, -1.0, self.crest, math.pi - self.crest)

    def rising(self, n: Any) -> Any:
        """Return the zero on the way up from trough `n`."""
        return self._zero(n, 1.0, math.pi - self.crest, TURN + self.crest)

    def _zero(self, n: Any, sign: float, low: Any, high: Any) -> Any:
        begin = self.psi + TURN * n

        def beyond(z: Any) -> tuple[Any, Any]:
            value = self.amplitude * np.cos(z) + (self.c + self.d * (begin + z))
            return sign * value, sign * (self.d - self.amplitude * np.sin(z))

        return begin + _rising_zero(beyond, low, high)


STANDING = 1e-9  # part of the speeds that is none


def time_to_wind(V: Any, a: Any, length: Any) -> Any:
    """Return the time in which V t + a t^2/2 becomes a length; zero where that is not positive."""
    length = np.where(length > 0.0, length, 0.0)
    root = np.sqrt(V * V + 2.0 * a * length)
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.where(length > 0.0, 2.0 * length / (V + root), 0.0)


def lag(V: Any, u: Any, x: Any) -> Any:
    """Return k (y - osc) of (11), without cancellation: what is wound up less the oscillation, at x = k t, u = a/k."""
    return V * sine_rest(x) + u * _cosine_rest(x)


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

    Speed V and acceleration a of the rope's upper end, m/s and m/s^2, are not both zero; k, rad/s, is infinite on a
    rigid support; the `height` is m g / C, m. All are numbers or arrays.
    """
    V, a, k, height = np.broadcast_arrays(V, a, k, height)
    rigid = np.isinf(k)
    rate = np.where(rigid, 1.0, k)
    u = a / rate
    low, high = bracket(V, a, rate, height)
    wanted = rate * height

    def surplus(x: Any) -> tuple[Any, Any]:
        return lag(V, u, x) - wanted, lag_rate(V, u, x)

    x = _rising_zero(surplus, np.where(rigid, NAN, low), np.where(rigid, NAN, high))
    return np.where(rigid, time_to_wind(V, a, height), x / rate)


def _force_rate(V: Any, a: Any, k: Any, ratio: Any) -> _Wave:
    """Return the left side of (12) as a wave of x = k t; `ratio` is C_01/C_12, infinite where nothing swings."""
    u = a / k
    return _Wave(np.sqrt(V * V + u * u), np.arctan2(u, V), ratio * V, ratio * u)


@np.errstate(invalid="ignore", divide="ignore")
def last_maximum(V: Any, a: Any, k: Any, ratio: Any, t_1: Any) -> Any:
    """Return when the force of the rope was greatest for the last time before t_1; NaN where it never was."""
    wave, end = _force_rate(V, a, k, ratio), np.asarray(k * t_1)
    n = np.fmin(np.floor((end - wave.psi - wave.crest) / TURN), wave.last)
    late, early = wave.falling(n), wave.falling(n - 1.0)
    found = np.where(late < end, late, np.where(n >= 1.0, early, NAN))
    return np.where((n >= 0.0) & (wave.last >= 0.0), found, NAN) / k


@np.errstate(invalid="ignore", divide="ignore")
def first_minimum(V: Any, a: Any, k: Any, ratio: Any, t_1: Any) -> Any:
    """Return when the force of the rope was least for the first time before t_1; NaN where it never was."""
    wave, end = _force_rate(V, a, k, ratio), np.asarray(k * t_1)
    x = wave.rising(0.0)
    return np.where((wave.last >= 0.0) & (x < end), x, NAN) / k


@np.errstate(invalid="ignore", divide="ignore")
def extremes(V: float, a: float, k: float, ratio: float, t_1: float, begin: float = 0.0) -> tuple[Any, Any]:
    """Return the roots of (12) from `begin` to t_1, times of maxima and of minima of the rope's force, in order."""
    wave, end, start = _force_rate(V, a, k, ratio), k * t_1, k * begin
    if not wave.last >= 0.0:
        return np.zeros(0), np.zeros(0)
    most = min(float(np.floor((end - wave.psi - wave.crest) / TURN)), float(wave.last))
    n = np.arange(max(np.floor((start - wave.psi - wave.crest) / TURN) - 1.0, 0.0), most + 1.0)
    maxima, minima = (roots[(roots > start) & (roots < end)] for roots in (wave.falling(n), wave.rising(n)))
    return maxima / k, minima / k


@np.errstate(invalid="ignore", divide="ignore")
def lowest_after(speed: Any, a: Any, k_1: Any, D_0: Any, D_1: Any, m: Any) -> Any:
    """Return after which time T the lifted load is lowest; a whole swing where it never sinks.

    With the `speed` V + a t_1 of the rope's upper end at the lift-off, that of the load is V + a t_1 + a T - P'/C_12
    with P' = k_1 (D_1 cos k_1 T - D_0 sin k_1 T), and C_12 = m k_1^2: at the first time that it ceases to sink it is
    lowest, for a swing later it is always higher.
    """
    part = 1.0 / (m * k_1)
    swing, psi = part * np.sqrt(D_0 * D_0 + D_1 * D_1), np.arctan2(D_0, -D_1)
    wave = _Wave(swing, psi, speed, a / k_1)
    sinking = _Wave(swing, psi, speed + STANDING * (swing + speed), a / k_1)  # at the lift-off it may stand
    n = wave.first
    return np.where(sinking.last >= n, wave.rising(n), TURN) / k_1
