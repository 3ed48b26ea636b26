"""Places over a turn of a cam at which something is looked at, and its least values between them.

At a corner of the motion there are two places, one for the limit from each side.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .motion import TURN

Array = NDArray[np.float64]
Function = Callable[[Any, int], NDArray[Any]]
FINE = math.radians(0.25)  # between places
FEWEST = 8  # cells of a piece
APART = 2e-12  # rad, from a corner, where the side of a limit no longer matters
GOLDEN, ROUNDS = 0.5 * (math.sqrt(5.0) - 1.0), 60


@dataclass(frozen=True, slots=True)
class Minimum:
    """A least value and the angle of the cam there."""

    value: float
    phi: float


@dataclass(frozen=True, slots=True, eq=False)
class Places:
    """Angles `phi` in order, each with the side of its limit, +1 right or -1 left."""

    phi: Array
    side: NDArray[np.intp]

    @classmethod
    def between(cls, corners: Sequence[float], extra: Iterable[float] = ()) -> Places:
        """Return places at most `FINE` apart between corners, those of `extra` among them, of any turn."""
        further = np.mod(np.fromiter(extra, float), TURN)
        parts, sides = [], []
        for low, high in pairwise(corners):
            even = np.linspace(low, high, max(FEWEST, math.ceil((high - low) / FINE)) + 1)
            inner = further[(further > low) & (further < high)]
            parts.append(np.unique(np.concatenate((even, inner))))
            sides.append(np.ones(len(parts[-1]), int))
            sides[-1][-1] = -1
        return cls(np.concatenate(parts), np.concatenate(sides))

    def values(self, function: Function) -> NDArray[Any]:
        """Return the values of a function of the angle and the side."""
        return np.where(self.side > 0, function(self.phi, 1), function(self.phi, -1))

    def cell(self, i: int) -> tuple[float, float, int]:
        """Return the cell between the places i and i + 1, all round: its ends and the side for what is in it."""
        a, b = i % len(self.phi), (i + 1) % len(self.phi)
        low, high = float(self.phi[a]), float(self.phi[b])
        return low, high if high >= low else high + TURN, int(self.side[b])


def refined(function: Function, low: Array, high: Array) -> tuple[Array, Array]:
    """Return the least values in brackets, and where, by golden section; each bracket lies inside one piece."""
    low, high = np.atleast_1d(low) + APART, np.atleast_1d(high) - APART
    a, b = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
    left, right = function(a, 1), function(b, 1)
    for _ in range(ROUNDS):
        down = left <= right
        low, high = np.where(down, low, a), np.where(down, b, high)
        kept, value = np.where(down, a, b), np.where(down, left, right)
        fresh = np.where(down, high - GOLDEN * (high - low), low + GOLDEN * (high - low))
        found = function(fresh, 1)
        a, b = np.where(down, fresh, kept), np.where(down, kept, fresh)
        left, right = np.where(down, found, value), np.where(down, value, found)
    return np.minimum(left, right), np.where(left <= right, a, b)


def minima(function: Function, corners: Sequence[float]) -> list[Minimum]:
    """Return the minima of a function between corners of the motion, the limits there among them, in order of phi.

    Where it is constant its first place stands for all.
    """
    places = Places.between(corners)
    values, phi = places.values(function), places.phi
    begins = np.append(True, np.diff(phi) == 0.0)
    ends = np.roll(begins, -1)
    before = np.where(begins, np.inf, np.roll(values, 1))
    after = np.where(ends, np.inf, np.roll(values, -1))
    at = np.flatnonzero((values < before) & (values <= after))
    low, high = phi[np.where(begins[at], at, at - 1)], phi[np.where(ends[at], at, at + 1)]
    lower, where = refined(function, low, high)
    better = lower < values[at]
    found = np.where(better, lower, values[at]), np.where(better, where, phi[at])
    return [Minimum(float(value), float(place)) for value, place in zip(*found, strict=True)]
