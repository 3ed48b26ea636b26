"""A smooth piece of a curve: a polynomial plus one sine wave, which derivatives, integrals and sums leave of that kind.

Everything asked of a law of motion that is linear in the travel and its derivatives is therefore exact: all roots of
such a piece are found, because those of its derivative part it into stretches on which it only rises or only falls.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import pairwise, zip_longest
from typing import Any

import numpy as np

STEPS = 80  # halvings of an interval after which nothing is left of it in double precision
ROUNDING = 1e-15  # part of an interval within which two of its points are one


@dataclass(frozen=True, slots=True)
class Smooth:
    """c0 + c1 t + c2 t^2 + ... + sine sin(rate t) + cosine cos(rate t), t = x - origin, for low <= x <= high.

    Parameters
    ----------
    low, high : float
        The piece's ends.
    origin : float
        From where t is counted: that end at which small values must be exact.
    coefficients : tuple of float
        Of the polynomial, beginning with the constant.
    sine, cosine, rate : float
        Amplitudes of the wave, and its angle per unit of x.
    """

    low: float
    high: float
    origin: float
    coefficients: tuple[float, ...]
    sine: float = 0.0
    cosine: float = 0.0
    rate: float = 0.0

    @property
    def waves(self) -> bool:
        """Whether there is a wave."""
        return self.sine != 0.0 or self.cosine != 0.0

    def at(self, x: Any) -> Any:
        """Return the values at the places `x`, also beyond the ends."""
        t = np.asarray(x, float) - self.origin
        value = np.full_like(t, self.coefficients[-1])
        for coefficient in self.coefficients[-2::-1]:
            value = value * t + coefficient
        if self.waves:
            value = value + (self.sine * np.sin(self.rate * t) + self.cosine * np.cos(self.rate * t))
        return value

    def value(self, x: float) -> float:
        """Return the value at one place."""
        t, value = x - self.origin, 0.0
        for coefficient in reversed(self.coefficients):
            value = value * t + coefficient
        if self.waves:
            value += self.sine * math.sin(self.rate * t) + self.cosine * math.cos(self.rate * t)
        return value

    def derivative(self) -> Smooth:
        """Return the derivative."""
        powers = tuple(k * c for k, c in enumerate(self.coefficients))[1:] or (0.0,)
        return replace(self, coefficients=powers, sine=-self.rate * self.cosine, cosine=self.rate * self.sine)

    def integral(self, start: float) -> Smooth:
        """Return the integral that is `start` at the origin."""
        powers = (0.0, *(c / (k + 1) for k, c in enumerate(self.coefficients)))
        if not self.waves:
            return replace(self, coefficients=(start, *powers[1:]))
        sine, cosine = self.cosine / self.rate, -self.sine / self.rate
        return replace(self, coefficients=(start - cosine, *powers[1:]), sine=sine, cosine=cosine)

    def times(self, factor: float) -> Smooth:
        """Return the curve multiplied by a number."""
        powers = tuple(factor * c for c in self.coefficients)
        return replace(self, coefficients=powers, sine=factor * self.sine, cosine=factor * self.cosine)

    def plus(self, other: Smooth) -> Smooth:
        """Return the sum with another curve of the same piece."""
        powers = tuple(a + b for a, b in zip_longest(self.coefficients, other.coefficients, fillvalue=0.0))
        return replace(
            self,
            coefficients=powers,
            sine=self.sine + other.sine,
            cosine=self.cosine + other.cosine,
            rate=self.rate or other.rate,
        )

    def stretched(self, length: float, start: float) -> Smooth:
        """Return the curve over x = start + length * (the present x)."""
        powers = tuple(c / length**k for k, c in enumerate(self.coefficients))
        low, high, origin = (start + length * x for x in (self.low, self.high, self.origin))
        return replace(self, low=low, high=high, origin=origin, coefficients=powers, rate=self.rate / length)

    def mirrored(self, span: float = 1.0) -> Smooth:
        """Return the curve run through backwards: over x = span - (the present x)."""
        powers = tuple(c * (-1.0) ** k for k, c in enumerate(self.coefficients))
        low, high, origin = span - self.high, span - self.low, span - self.origin
        return replace(self, low=low, high=high, origin=origin, coefficients=powers, sine=-self.sine)

    def roots(self) -> list[float]:
        """Return the places of the piece where the curve changes its sign, its ends left out, in order."""
        return [] if self.high <= self.low else list(self._roots())

    def extreme_places(self) -> list[float]:
        """Return where the curve may have its extremes: the ends, and where its derivative changes sign."""
        return [self.low, *self.derivative().roots(), self.high]

    def _roots(self) -> Iterator[float]:
        slope = self.derivative()
        steady = not any(self.coefficients[1:])
        if steady and not self.waves:
            return
        turns = list(self._crests()) if steady else list(slope._roots())
        for low, high in pairwise((self.low, *turns, self.high)):
            if (self.value(low) < 0.0) != (self.value(high) < 0.0):
                root = self._root(slope, low, high)
                if self.low < root < self.high:
                    yield root

    def _crests(self) -> Iterator[float]:
        """Go through the crests and troughs of the wave, where sine cos(rate t) = cosine sin(rate t)."""
        first = math.atan2(self.sine, self.cosine)
        a, b = sorted(self.rate * (x - self.origin) for x in (self.low, self.high))
        turns = range(math.ceil((a - first) / math.pi), math.floor((b - first) / math.pi) + 1)
        yield from sorted(self.origin + (first + k * math.pi) / self.rate for k in turns)

    def _root(self, slope: Smooth, low: float, high: float) -> float:
        """Return the root between places at which the signs differ, by Newton's steps kept between them."""
        below, x, least = self.value(low) < 0.0, 0.5 * (low + high), ROUNDING * (high - low)
        for _ in range(STEPS):
            value, steep = self.value(x), slope.value(x)
            low, high = (x, high) if (value < 0.0) == below else (low, x)
            step = value / steep if steep else math.inf
            following = x - step
            if not low <= following <= high:
                following = 0.5 * (low + high)
            if abs(following - x) <= least:
                return following
            x = following
        return x
