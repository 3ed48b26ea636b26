"""Ways to a root of one equation, which tell evaluation by evaluation how fast they are.

Bisection, Illinois's false position and Brent's method keep a bracket and cannot fail; Newton's method and the secant
can: near k t_1 = 2 pi n without acceleration the load stands still when it lifts off, and the root is nearly triple.

Source: R. P. Brent, Algorithms for Minimization without Derivatives, 1973, chapter 4; M. Dowell and P. Jarratt, A
modified regula falsi method, BIT 11 (1971), for Illinois.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import partial
from itertools import islice

from ..hoist.roots import bracket, lag, lag_rate

BISECTION, NEWTON, SECANT, ILLINOIS, BRENT = "bisection", "newton-root", "secant", "illinois", "brent"
MOST = 200  # evaluations
STILL = 2.0**-51  # parts of a root that are no step
BEYOND = 1e-9  # parts of a bracket by which a root on its end may be beyond it


@dataclass(frozen=True, slots=True)
class Equation:
    """f(x) = 0 with its derivative f', and a bracket of its root: f(low) <= 0 <= f(high)."""

    value: Callable[[float], float]
    slope: Callable[[float], float]
    low: float
    high: float


@dataclass(frozen=True, slots=True)
class Found:
    """The root that a finder stopped at, NaN where it failed, and how often it evaluated f or f'."""

    root: float
    evaluations: int


def lift_off_equation(V: float, a: float, k: float, height: float) -> Equation:
    """Return (11) in x = k t: V (x - sin x) + (a/k) (x^2/2 - 1 + cos x) = k m g / C, k finite, `height` m g / C."""
    u, wanted = a / k, k * height
    low, high = map(float, bracket(V, a, k, height))
    return Equation(lambda x: float(lag(V, u, x)) - wanted, lambda x: float(lag_rate(V, u, x)), low, high)


Guess = tuple[float, float]  # an approximation, and how far it is believed to be from the root


def _bisection(equation: Equation) -> Iterator[Guess]:
    """Halve the bracket."""
    low, high = equation.low, equation.high
    while True:
        middle = 0.5 * (low + high)
        if equation.value(middle) < 0.0:
            low = middle
        else:
            high = middle
        yield 0.5 * (low + high), 0.5 * (high - low)


def _newton(equation: Equation) -> Iterator[Guess]:
    """Go along the tangent, from the middle of the bracket; f and f' are two evaluations."""
    x = 0.5 * (equation.low + equation.high)
    step = math.inf
    while True:
        value, slope = equation.value(x), equation.slope(x)
        yield x, abs(step)
        step = -value / slope if slope else math.nan
        x += step
        yield x, abs(step)


def _chords(equation: Equation, bracketed: bool) -> Iterator[Guess]:
    """Go along the chord of the two latest places, from the ends of the bracket.

    Illinois's rule keeps the root `bracketed`: an end that stays twice counts half.
    """
    x, y = equation.low, equation.high
    f_x, f_y = equation.value(x), equation.value(y)
    yield x, math.inf
    yield y, y - x
    while True:
        step = f_y * (y - x) / (f_x - f_y) if f_y != f_x else 0.0 if bracketed or f_y == 0.0 else math.nan
        z = y + step
        f_z = equation.value(z)
        yield z, abs(step)
        if bracketed and (f_z < 0.0) == (f_y < 0.0):
            f_x = 0.5 * f_x
        else:
            x, f_x = y, f_y
        y, f_y = z, f_z


def _brent(equation: Equation) -> Iterator[Guess]:
    """Interpolate by chords and inverse parabolas where that is quick, halve where it is not."""
    a, b = equation.low, equation.high
    f_a, f_b = equation.value(a), equation.value(b)
    yield a, math.inf
    yield b, b - a
    c, f_c = a, f_a
    step = before = b - a
    while True:
        if (f_b > 0.0) == (f_c > 0.0):
            c, f_c = a, f_a
            step = before = b - a
        if abs(f_c) < abs(f_b):
            a, b, c = b, c, b
            f_a, f_b, f_c = f_b, f_c, f_b
        half, least = 0.5 * (c - b), STILL * abs(b)
        if abs(half) <= least or f_b == 0.0:
            yield b, 0.0
            continue
        if abs(before) < least or abs(f_a) <= abs(f_b):
            before = step = half
        else:
            before, step = _interpolated((a, b, c), (f_a, f_b, f_c), half, (before, step), least)
        a, f_a = b, f_b
        b += step if abs(step) > least else math.copysign(least, half)
        f_b = equation.value(b)
        yield b, abs(step)


Three = tuple[float, float, float]


def _interpolated(x: Three, f: Three, half: float, steps: tuple[float, float], least: float) -> tuple[float, float]:
    """Return the last step and the next: interpolated when that stays inside and shrinks, else half the bracket."""
    (a, b, c), (f_a, f_b, f_c), (before, step) = x, f, steps
    s = f_b / f_a
    if a == c:
        p, q = 2.0 * half * s, 1.0 - s
    else:
        q, r = f_a / f_c, f_b / f_c
        p = s * (2.0 * half * q * (q - r) - (b - a) * (r - 1.0))
        q = (q - 1.0) * (r - 1.0) * (s - 1.0)
    p, q = abs(p), (-q if p > 0.0 else q)
    if 2.0 * p < min(3.0 * half * q - abs(least * q), abs(before * q)):
        return step, p / q
    return half, half


FINDERS: Mapping[str, Callable[[Equation], Iterator[Guess]]] = {
    BISECTION: _bisection,
    NEWTON: _newton,
    SECANT: partial(_chords, bracketed=False),
    ILLINOIS: partial(_chords, bracketed=True),
    BRENT: _brent,
}


def find(finder: str, equation: Equation, tolerance: float) -> Found:
    """Return the root in the bracket, believed to be right to a part `tolerance` of itself.

    A method that finds another root, or none in `MOST` evaluations, has failed.
    """
    for count, (x, away) in enumerate(islice(FINDERS[finder](equation), MOST), 1):
        if not math.isfinite(x):
            break
        if away <= max(tolerance, STILL) * abs(x):
            inside = equation.low * (1.0 - BEYOND) <= x <= equation.high * (1.0 + BEYOND)
            return Found(x if inside else math.nan, count)
    return Found(math.nan, count)
