"""Curves p_0 + p_1 t + p_2 t^2 + A cos w t + B sin w t: how a load on a spring moves, and where it passes zero.

The slope of such a curve turns where its bend is zero, which is known in closed form; between two such places it passes
zero once at most, and so does the curve between two of its own turnings. No passage can be missed.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import chain, pairwise

from ...scales.errors import InputError
from ..laws import TURN
from .waves import CLOSE, MOST_ROUNDS

MOST = 8_000  # pieces and swings of one motion: beyond, nobody wants to know them
LATEST = 1e12  # swings after which the next one cannot be told from it
Real = Callable[[float], float]


@dataclass(frozen=True, slots=True)
class Curve:
    """p_0 + p_1 t + p_2 t^2 + A cos w t + B sin w t; without a swing A, B and w are zero."""

    p_0: float
    p_1: float
    p_2: float
    A: float = 0.0
    B: float = 0.0
    w: float = 0.0

    def __neg__(self) -> Curve:
        """Return the curve turned over."""
        return Curve(-self.p_0, -self.p_1, -self.p_2, -self.A, -self.B, self.w)

    def at(self, t: float) -> float:
        """Return the ordinate."""
        swing = self.A * math.cos(self.w * t) + self.B * math.sin(self.w * t)
        return self.p_0 + (self.p_1 + self.p_2 * t) * t + swing

    def slope(self, t: float) -> float:
        """Return the slope."""
        swing = self.B * math.cos(self.w * t) - self.A * math.sin(self.w * t)
        return self.p_1 + 2.0 * self.p_2 * t + self.w * swing

    def bend(self, t: float) -> float:
        """Return the slope of the slope."""
        swing = self.A * math.cos(self.w * t) + self.B * math.sin(self.w * t)
        return 2.0 * self.p_2 - self.w * self.w * swing

    @property
    def swing(self) -> float:
        """How far it swings to either side."""
        return math.hypot(self.A, self.B)

    def surely(self, side: float, room: float) -> float:
        """Return a time from which on it is on one side of zero, +1 or -1, by more than `room`.

        Its parabola runs away to that side.
        """
        p_0, p_1, p_2 = side * self.p_0 - self.swing - 2.0 * room, side * self.p_1, side * self.p_2
        root = math.sqrt(max(p_1 * p_1 - 4.0 * p_0 * p_2, 0.0))
        if p_1 < 0.0:
            return (root - p_1) / (2.0 * p_2)
        return max(-2.0 * p_0 / (p_1 + root), 0.0)

    def turnings(self, end: float, begin: float = 0.0) -> Iterator[float]:
        """Go through the places from `begin` to `end` where it turns from rising to falling or back."""
        if self.w == 0.0:
            if self.p_2 != 0.0 and begin < -self.p_1 / (2.0 * self.p_2) < end:
                yield -self.p_1 / (2.0 * self.p_2)
            return
        slope = self.slope(begin)
        for node in self._nodes(begin, end):
            other = self.slope(node)
            if slope < 0.0 < other or other < 0.0 < slope:
                yield zero_between(self.slope, self.bend, begin, node)
            elif other == 0.0 and slope != 0.0:
                yield node
            begin, slope = node, other

    def _nodes(self, begin: float, end: float) -> Iterator[float]:
        """Go through places after `begin`, `end` the last, between which the slope does not turn.

        Raises
        ------
        InputError
            They are in more swings than anybody wants to know, or so late that they cannot be told apart.
        """
        size, psi = self.swing * self.w * self.w, math.atan2(self.B, self.A)
        part = 2.0 * self.p_2 / size if size else 2.0
        reach = math.acos(part) if abs(part) < 1.0 else 0.5 * math.pi
        first = (begin * self.w - reach - psi) / TURN
        late = not abs(first) < LATEST
        for n in range(0 if late else math.floor(first), 0 if late else math.floor(first) + MOST):
            for angle in (psi - reach, psi + reach):
                t = (angle + TURN * n) / self.w
                if t >= end:
                    yield end
                    return
                if t > begin:
                    yield t
        raise InputError("hoist-pieces", n=MOST)

    def falls_through(self, end: float, room: float) -> float | None:
        """Return where before `end` it first falls through zero, None where it does not.

        At the beginning it is above zero, or there and rising; `room` is by how much it may dip below for rounding.
        """
        if self.w == 0.0:
            return self._falls_straight(end, room)
        for low, high in self._reached(end, room):
            begin, value = low, max(self.at(low), 0.0)
            for turning in chain(self.turnings(high, low), (high,)):
                other = self.at(turning)
                if other < -room:
                    return zero_between(self.at, self.slope, begin, turning) if value > 0.0 else begin
                begin, value = turning, other
        return None

    def _reached(self, end: float, room: float) -> Iterator[tuple[float, float]]:
        """Go through the times before `end`, from and to, at which its swing may reach zero: one, or two."""
        straight = Curve(self.p_0 - self.swing - room, self.p_1, self.p_2)
        ends = [0.0, *sorted(t for t in straight._zeros()[1] if 0.0 < t < end), end]
        for low, high in pairwise(ends):
            if straight.at(0.5 * (low + high)) < 0.0:
                yield low, high

    def _zeros(self) -> tuple[float, list[float]]:
        """Return the discriminant of its parabola, and where that is zero; where it turns if it nowhere is."""
        half, square = 0.5 * self.p_1, 0.25 * self.p_1 * self.p_1 - self.p_0 * self.p_2
        root = math.sqrt(max(square, 0.0))
        larger = -(half + math.copysign(root, half))
        found = [larger / self.p_2] if self.p_2 else []
        return square, found + ([self.p_0 / larger] if larger else [])

    def _falls_straight(self, end: float, room: float) -> float | None:
        """Return the same of a parabola."""
        square, zeros = self._zeros()
        if self.at(end) >= -room and (self.p_2 <= 0.0 or square <= 0.0):
            return None
        return min((t for t in zeros if 0.0 < t <= end and self.slope(t) < 0.0), default=None)


def zero_between(function: Real, slope: Real, low: float, high: float) -> float:
    """Return where a function is zero that has different signs at `low` and `high`, and does not turn between.

    Newton's steps that stay between the two, and every third time the middle.
    """
    rises, x = function(high) > 0.0, 0.5 * (low + high)
    for done in range(MOST_ROUNDS):
        value = function(x)
        if value == 0.0:
            return x
        low, high = (low, x) if (value > 0.0) == rises else (x, high)
        rate = slope(x)
        following = x - value / rate if rate and done % 3 != 2 else low
        if not low < following < high:
            following = 0.5 * (low + high)
        if not low < following < high or abs(following - x) <= CLOSE * abs(x):
            return following
        x = following
    return x
