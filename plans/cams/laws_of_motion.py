"""Laws of motion of a follower: the travel s over a phase, both from 0 to 1, with its two derivatives in closed form.

A law has two lobes of acceleration: on the first part u of the phase the lobe f(x / u) with the amplitude A_1, on the
rest the same lobe turned round with A_2 = A_1 u / (1 - u), so that the areas are equal and the velocity returns to
zero. With F'' = f, F(0) = F'(0) = 0 it follows that A_1 = 1 / (u F(1)), that s = u where the lobes join, and that the
greatest velocity F'(1) / F(1) does not depend on u.

Everything asked of a law that is linear in the travel and its derivatives is exact: the law consists of smooth pieces,
a polynomial plus one sine wave each, which derivatives, integrals and sums leave of that kind. All roots of such a
piece are found, because those of its derivative part it into stretches on which it only rises or only falls.

Source: Artobolevsky, Theory of mechanisms and machines; Rothbart, Cam Design Handbook (modified laws).
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise, zip_longest

import numpy as np
from numpy.typing import NDArray

from ...scales.errors import InputError
from ...scales.numbers import quote
from .cam import LAWS, PIECES, Curve

STEPS = 80  # halvings of an interval after which nothing is left of it in double precision
ROUNDING = 1e-15  # part of an interval within which two of its points are one


@dataclass(frozen=True, slots=True)
class Smooth:
    """c0 + c1 t + c2 t^2 + ... + the real part of wave exp(i rate t), t = x - origin, for low <= x <= high."""

    # the piece's ends
    low: float
    high: float
    origin: float  # from where t is counted: that end at which small values must be exact
    coefficients: tuple[float, ...]  # of the polynomial, beginning with the constant
    wave: complex = 0j  # amplitudes: of the cosine, less i times that of the sine
    rate: float = 0.0  # angle of the wave per unit of x

    def value(self, x: float) -> float:
        """Return the value at one place."""
        t, value = x - self.origin, 0.0
        for coefficient in reversed(self.coefficients):
            value = value * t + coefficient
        angle = self.rate * t
        return value + (self.wave.real * math.cos(angle) - self.wave.imag * math.sin(angle)) if self.wave else value

    def derivative(self) -> Smooth:
        """Return the derivative."""
        powers = tuple(k * c for k, c in enumerate(self.coefficients))[1:] or (0.0,)
        return replace(self, coefficients=powers, wave=1j * self.rate * self.wave)

    def integral(self, start: float) -> Smooth:
        """Return the integral that is `start` at the origin."""
        powers = (c / (k + 1) for k, c in enumerate(self.coefficients))
        wave = self.wave / (1j * self.rate) if self.wave else 0j
        return replace(self, coefficients=(start - wave.real, *powers), wave=wave)

    def times(self, factor: float) -> Smooth:
        """Return the curve multiplied by a number."""
        return replace(self, coefficients=tuple(factor * c for c in self.coefficients), wave=factor * self.wave)

    def plus(self, other: Smooth) -> Smooth:
        """Return the sum with another curve of the same piece."""
        powers = tuple(a + b for a, b in zip_longest(self.coefficients, other.coefficients, fillvalue=0.0))
        return replace(self, coefficients=powers, wave=self.wave + other.wave, rate=self.rate or other.rate)

    def stretched(self, length: float, start: float) -> Smooth:
        """Return the curve over x = start + length * (the present x)."""
        powers = tuple(c / length**k for k, c in enumerate(self.coefficients))
        low, high, origin = (start + length * x for x in (self.low, self.high, self.origin))
        return replace(self, low=low, high=high, origin=origin, coefficients=powers, rate=self.rate / length)

    def mirrored(self) -> Smooth:
        """Return the curve run through backwards: over x = 1 - (the present x)."""
        powers = tuple(c * (-1.0) ** k for k, c in enumerate(self.coefficients))
        low, high, origin = 1.0 - self.high, 1.0 - self.low, 1.0 - self.origin
        return replace(self, low=low, high=high, origin=origin, coefficients=powers, wave=self.wave.conjugate())

    def less_than_one(self) -> Smooth:
        """Return 1 less the curve."""
        back = self.times(-1.0)
        return replace(back, coefficients=(1.0 + back.coefficients[0], *back.coefficients[1:]))

    def extreme_places(self) -> list[float]:
        """Return where the curve may have its extremes: the ends, and where its derivative changes sign."""
        return [self.low, *self.derivative().roots(), self.high]

    def roots(self) -> list[float]:
        """Return the places of the piece where the curve changes its sign, its ends left out, in order."""
        slope, steady = self.derivative(), not any(self.coefficients[1:])
        if self.high <= self.low or (steady and not self.wave):
            return []
        turns = self._crests() if steady else slope.roots()
        changes = [
            self._root(slope, low, high)
            for low, high in pairwise((self.low, *turns, self.high))
            if (self.value(low) < 0.0) != (self.value(high) < 0.0)
        ]
        return [root for root in changes if self.low < root < self.high]

    def _crests(self) -> list[float]:
        """Return the crests and troughs of the wave, where its derivative is zero."""
        first = -cmath.phase(self.wave)
        a, b = sorted(self.rate * (x - self.origin) for x in (self.low, self.high))
        turns = range(math.ceil((a - first) / math.pi), math.floor((b - first) / math.pi) + 1)
        return sorted(self.origin + (first + k * math.pi) / self.rate for k in turns)

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


Array = NDArray[np.float64]
UNIFORM = "uniform"
SAME = 1e-9  # part of the greatest acceleration within which two accelerations are equal
CLOSED = 1e-9  # part of the greatest velocity within which it counts as returned to zero
_TURN = 2.0 * math.pi


def _ramp(low: float, high: float, *coefficients: float) -> Smooth:
    return Smooth(low, high, low, coefficients)


def _wave(low: float, high: float, rate: float, sine: float, cosine: float) -> Smooth:
    return Smooth(low, high, low, (0.0,), complex(cosine, -sine), rate)


# the first lobe of every law, its height any, over 0..1; at 1 it joins the second
LOBES: dict[str, tuple[Smooth, ...]] = {
    "constant": (_ramp(0.0, 1.0, 1.0),),
    "falling": (_ramp(0.0, 1.0, 1.0, -1.0),),
    "sawtooth": (_ramp(0.0, 1.0, 0.0, 1.0),),
    "cosine": (_wave(0.0, 1.0, 0.25 * _TURN, 0.0, 1.0),),
    "sine": (_wave(0.0, 1.0, 0.5 * _TURN, 1.0, 0.0),),
    "trapezoid": (_ramp(0.0, 0.25, 0.0, 4.0), _ramp(0.25, 0.75, 1.0), _ramp(0.75, 1.0, 1.0, -4.0)),
    "modified-trapezoid": (
        _wave(0.0, 0.25, _TURN, 1.0, 0.0),
        _ramp(0.25, 0.75, 1.0),
        _wave(0.75, 1.0, _TURN, 0.0, 1.0),
    ),
    "modified-sine": (_wave(0.0, 0.25, _TURN, 1.0, 0.0), _wave(0.25, 1.0, _TURN / 3.0, 0.0, 1.0)),
    "polynomial-345": (_ramp(0.0, 1.0, 0.0, 1.0, -1.5, 0.5),),
    "polynomial-4567": (_ramp(0.0, 1.0, 0.0, 0.0, 1.0, -2.0, 1.25, -0.25),),
}


# the travel over one phase, from (0, 0) to (1, 1), as smooth pieces: each begins where the one before ends
Law = tuple[Smooth, ...]


def _integrated(pieces: Sequence[Smooth]) -> Law:
    """Return the integral of pieces, each with its origin at its low end, that begins with zero."""
    found, start = [], 0.0
    for piece in pieces:
        found.append(piece.integral(start))
        start = found[-1].value(piece.high)
    return tuple(found)


def law_of_motion(name: str, u: float = 0.5) -> Law:
    """Return the law of this name, of `cam.LAWS`, whose first lobe takes the part u of the phase; the uniform has none.

    Raises InputError: when there is no such law, or u is not between 0 and 1.
    """
    if name == UNIFORM:
        return (Smooth(0.0, 1.0, 0.0, (0.0, 1.0)),)
    if name not in LOBES:
        raise InputError("choice-unknown", text=quote(name), known=", ".join(LAWS))
    if not 0.0 < u < 1.0:
        raise InputError("law-u", text=f"{u:.6g}")
    lobe = _integrated(_integrated(LOBES[name]))
    whole = lobe[-1].value(1.0)
    first = [piece.times(u / whole).stretched(u, 0.0) for piece in lobe]
    second = [piece.times((1.0 - u) / whole).stretched(1.0 - u, 0.0).mirrored() for piece in reversed(lobe)]
    second[0] = replace(second[0], low=first[-1].high)  # not an ulp beside it
    return (*first, *(piece.less_than_one() for piece in second))


def _law_of_pieces(at: Sequence[float], values: Sequence[float]) -> Law:
    """Return the law whose acceleration is made of straight pieces, in any scale, integrated exactly.

    `values` are the accelerations at the nodes `at`, from 0 to 1; twice the same place where the acceleration jumps.

    Raises InputError: when the places do not run from 0 to 1, the velocity does not return to zero, or nothing is
    travelled.
    """
    _rising(at, values, strict=False)
    nodes = list(zip(at, values, strict=True))
    acceleration = [
        _ramp(low, high, a, (b - a) / (high - low)) for (low, a), (high, b) in pairwise(nodes) if high > low
    ]
    velocity = _integrated(acceleration)
    greatest = max(abs(piece.value(x)) for piece in velocity for x in piece.extreme_places())
    rest = velocity[-1].value(1.0)
    if abs(rest) > CLOSED * greatest:
        raise InputError("law-open", text=f"{rest / greatest:+.3g}")
    travel = _integrated(velocity)
    whole = travel[-1].value(1.0)
    if whole <= CLOSED * greatest:
        raise InputError("law-still")
    return tuple(piece.times(1.0 / whole) for piece in travel)


def _law_of_points(at: Sequence[float], values: Sequence[float]) -> Law:
    """Return the law whose travel runs smoothly through points, in any scale, and rests at both ends.

    The curve is the cubic spline with s' = 0 at the ends: of all smooth curves through the points that with the least
    mean square of acceleration; the acceleration is a chain of straight pieces without jumps between the ends. `values`
    are the travels `at` places that rise from 0 to 1: the first is where the follower rests, the last the whole stroke.

    Raises InputError: when the places do not rise from 0 to 1, nothing is travelled, or the curve leaves the stroke.
    """
    _rising(at, values, strict=True)
    x = np.asarray(at, float)
    if values[-1] == values[0]:
        raise InputError("law-still")
    s = (np.asarray(values, float) - values[0]) / (values[-1] - values[0])
    travel = _integrated(_integrated(_spline(x, s)))
    scale = 1.0 / travel[-1].value(1.0)  # rounding
    for piece in travel:
        for place in piece.extreme_places():
            if not -CLOSED <= piece.value(place) <= 1.0 + CLOSED:
                raise InputError("law-leaves", text=f"{place:.3g}")
    return tuple(piece.times(scale) for piece in travel)


def law_of_curve(curve: Curve) -> Law:
    """Return the law that a table of one's own gives."""
    return (_law_of_pieces if curve.kind == PIECES else _law_of_points)(curve.at, curve.values)


def _spline(x: Array, s: Array) -> list[Smooth]:
    """Return the acceleration of the cubic spline through points, clamped at both ends."""
    width = np.diff(x)
    chord = np.concatenate(([0.0], np.diff(s) / width, [0.0]))
    matrix = np.diag(np.concatenate((width, [0.0])) + np.concatenate(([0.0], width)) * 1.0) * 2.0
    matrix += np.diag(width, 1) + np.diag(width, -1)
    a = np.linalg.solve(matrix, 6.0 * np.diff(chord))
    return [
        _ramp(float(low), float(high), float(p), float((q - p) / (high - low)))
        for (low, high), (p, q) in zip(pairwise(x), pairwise(a), strict=True)
    ]


def _rising(at: Sequence[float], values: Sequence[float], strict: bool) -> None:
    """See that the places of a table run from 0 to 1."""
    backward = any(b <= a if strict else b < a for a, b in pairwise(at))
    if len(at) < 2 or len(at) != len(values) or at[0] != 0.0 or at[-1] != 1.0 or backward:
        raise InputError("law-places")
