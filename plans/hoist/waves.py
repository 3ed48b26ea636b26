"""Zeros of a cosine on a rising line, A cos(x - psi) + c + d x with d >= 0: every one between two known places.

The slope of such a function is zero where sin(x - psi) = d/A, at crests and troughs in turn. From a crest to the next
trough it only falls, from there to the next crest it only rises; every trough is higher than the one before. So each
zero stands alone between a crest and a trough, and if one trough is not below zero none of the later ones is.

The rate of the rope's force, and the speed of the lifted load, are such functions. All arguments may be arrays.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..laws import NAN, TURN

Function = Callable[[Any], tuple[Any, Any]]
MOST_ROUNDS = 600  # halving alone needs 54 beside one end that is not zero
CLOSE = 2.0**-52


def rising_zero(function: Function, low: Any, high: Any) -> Any:
    """Return the zero of a function that only rises, between `low` and `high`.

    Newton's steps that stay inside the bracket and are at most half as long as the last but one; else the bracket is
    halved: nothing can make it fail. Each element of an array goes its own way, and stays where it has arrived.

    Parameters
    ----------
    function : callable
        Returns value and slope.
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
class Wave:
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
        crest = self.crest
        place = rising_zero(lambda z: self._at(z, n, -1.0), crest, math.pi - crest)
        return self.psi + TURN * n + place

    def rising(self, n: Any) -> Any:
        """Return the zero on the way up from trough `n`."""
        crest = self.crest
        place = rising_zero(lambda z: self._at(z, n, 1.0), math.pi - crest, TURN + crest)
        return self.psi + TURN * n + place

    def _at(self, z: Any, n: Any, sign: float) -> tuple[Any, Any]:
        """Return value and slope at z beyond psi + 2 pi n."""
        value = self.amplitude * np.cos(z) + (self.c + self.d * (self.psi + TURN * n + z))
        return sign * value, sign * (self.d - self.amplitude * np.sin(z))
