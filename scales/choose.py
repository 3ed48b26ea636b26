"""How a scale factor is chosen: a given mu, a chosen segment such as pa = 80 mm, a round mu, or the crank scale.

Each chooser gives a ladder of scale factors, the wanted one first, then coarser and coarser: the sheet takes the first
that fits. What a user has fixed has one rung.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from .scale import SEGMENTS, rounded, steps

RUNGS = 16


@dataclass(frozen=True, slots=True)
class Fixed:
    """A given mu in SI per millimetre; `firm` when the user has said so himself."""

    mu: float
    firm: bool = False

    def ladder(self, value: Callable[[str], float]) -> tuple[float, ...]:
        """Return mu, then the rounder coarser ones."""
        if self.firm:
            return (self.mu,)
        return (self.mu, *(mu for mu in steps(self.mu) if mu > self.mu * 1.0001))[:RUNGS]


@dataclass(frozen=True, slots=True)
class Segment:
    """The segment of quantity `quantity` is `millimetres` long: mu = value / segment, rounded to three digits."""

    quantity: str
    millimetres: float
    firm: bool = False

    def ladder(self, value: Callable[[str], float]) -> tuple[float, ...]:
        """Return mu for the segment wanted, then for shorter ones of the preferred numbers."""
        size = value(self.quantity)
        if self.firm:
            return (rounded(size / self.millimetres),)
        shorter = [10.0**e * m for e in (2, 1, 0) for m in reversed(SEGMENTS)]
        lengths = [self.millimetres, *(mm for mm in shorter if mm < self.millimetres * 0.999)]
        return tuple(rounded(size / mm) for mm in lengths)[:RUNGS]


@dataclass(frozen=True, slots=True)
class Round:
    """The finest mu of the customary series at which quantity `quantity` is at most `millimetres` long."""

    quantity: str
    millimetres: float

    def ladder(self, value: Callable[[str], float]) -> tuple[float, ...]:
        """Return the series from that mu on."""
        return steps(value(self.quantity) / self.millimetres)[:RUNGS]


@dataclass(frozen=True, slots=True)
class CrankScale:
    """mu_V = omega_1 * mu_l and mu_a = omega_1^2 * mu_l: the crank's segment shows its velocity and acceleration."""

    base: Segment | Fixed | Round
    power: int

    def ladder(self, value: Callable[[str], float]) -> tuple[float, ...]:
        """Return the ladder of the length scale times omega_1 or its square, not rounded: pa = OA exactly."""
        factor = abs(value("omega_1")) ** self.power
        return tuple(mu * factor for mu in self.base.ladder(value))


Chooser = Fixed | Segment | Round | CrankScale
Choosers = Mapping[str, Chooser]
