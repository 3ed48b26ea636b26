"""Zeros and extremes of functions of one variable on stretches: a grid fine enough to see them, then each refined.

A zero is where the sign changes. Between grid points a function may dip to zero and come back: wherever it comes near
on the grid the dip is followed down. Only signs and sizes are asked for, no derivatives. Extremes are found for many
functions at once.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]
Function = Callable[[Array], Array]
Rated = Callable[[NDArray[np.intp], Array], Array]  # heights of the peaks of some rows at places of each
SECTIONS, ROUNDS, MOST_ROUNDS, DIP_ROUNDS = 24, 4, 9, 8
LEAST_CELLS = 48
DIP = 4.0  # a grid value so many second differences away from zero does not come there between the points
TOUCH = 1e-12  # part of the largest value within which a dip counts as touching zero
REACHES = (0.3, 0.1, 0.03, 0.01, 0.003)  # radians around a touch in which it is looked for by a polynomial
NODES, DEGREE, NEWTON = 256, 24, 6
WORST = 1e-9  # radians that a polynomial may be off: then there is a corner
END = 1e-6  # how near the grid comes to the ends of a stretch, in radians of its circle
# Of extremes:
PEAK_SECTIONS, PEAK_ROUNDS, MORE_ROUNDS = 16, 2, 8
GROWS, UNBOUNDED = 1.01, 1.5  # growth in a round of sections that asks for another, that has no end
FLAT = 1e-12  # part of its size within which a function is constant
TIE = 1e-9  # part of its height by which a peak must be higher than an earlier one to count: rounding must not choose
PEAKS = 4  # so many of the highest peaks of a row are followed; noise has many


@dataclass(frozen=True, slots=True)
class Stretch:
    """A part of a variable's range, from `low` to `high`; `closed` when the end is the beginning, as of a full turn.

    Its own coordinate `theta` makes what has a vertical tangent at the ends, as the motion at a limit of assembly has,
    as smooth as it is elsewhere: x = middle - half cos(theta).
    """

    low: float
    high: float
    step: float  # the largest of the grid
    closed: bool = False

    @property
    def length(self) -> float:
        """Length of the stretch."""
        return self.high - self.low

    @property
    def cells(self) -> int:
        """Number of cells of the grid; on an open stretch those in the middle are the longest."""
        cells = self.length / self.step
        return round(cells) if self.closed else max(LEAST_CELLS, math.ceil(0.5 * math.pi * cells))

    def place(self, theta: Array) -> Array:
        """Return the variable at `theta`."""
        if self.closed:
            return self.low + theta * (self.length / (2.0 * math.pi))
        from_low, from_high = (self.length * np.square(part(0.5 * theta)) for part in (np.sin, np.cos))
        places: Array = np.where(theta < 0.5 * math.pi, self.low + from_low, self.high - from_high)
        return places

    def grid(self) -> Array:
        """Return coordinates, one cell more than all the way round where the stretch is closed."""
        cells = self.cells
        if self.closed:
            around: Array = np.arange(cells + 2) * (2.0 * math.pi / cells)
            return around
        grid: Array = np.linspace(0.0, math.pi, cells + 1)
        grid[0], grid[-1] = END, math.pi - END
        return grid

    def part(self, low: float, high: float) -> Stretch:
        """Return an open part of it, with as fine a grid."""
        return Stretch(low, high, self.step)


def zeros(function: Function, stretch: Stretch) -> tuple[Array, Array]:
    """Return where `function` changes its sign on `stretch`, and where it only touches zero, both in order.

    Where it has no value at all it may be minus infinity: then the zero is the last place that has one.
    """
    theta = stretch.grid()

    def at(theta: Array) -> Array:
        return function(stretch.place(theta))

    values = at(theta)
    size = float(np.max(np.abs(values), initial=0.0, where=np.isfinite(values)))
    above, known = values >= 0.0, ~np.isnan(values)
    cells = np.flatnonzero((above[1:] != above[:-1]) & known[1:] & known[:-1])
    if stretch.closed:
        cells = cells[cells < stretch.cells]
    inner, touches = _dips(at, theta, values, size)
    low, high, held = (
        np.concatenate(pair) for pair in zip((theta[cells], theta[cells + 1], above[cells]), inner, strict=True)
    )
    roots = refined(at, low, high, held.astype(bool)) if len(low) else low
    return _sorted(roots, stretch), _sorted(touches, stretch)


def _sorted(theta: Array, stretch: Stretch) -> Array:
    places = stretch.place(theta % (2.0 * math.pi) if stretch.closed else theta)
    places.sort()
    return places


def refined(function: Function, low: Array, high: Array, above: Array) -> Array:
    """Return the zeros in cells at whose ends the signs differ, cut, then interpolated.

    `above` tells which functions are above zero at `low`. Each is found as it would be alone.
    """
    parts = np.linspace(0.0, 1.0, SECTIONS + 1)[:, None]
    columns, zero, going = np.arange(len(low)), np.empty(len(low)), np.full(len(low), True)
    for done in range(MOST_ROUNDS):
        theta = low + (high - low) * parts
        values = function(theta.ravel()).reshape(theta.shape)
        changed = (values >= 0.0) != above
        changed[0], changed[-1] = False, True  # as it was found: nearer to the zero a sign may be that of rounding
        first = changed.argmax(axis=0)
        low, high = theta[first - 1, columns], theta[first, columns]
        left, right = values[first - 1, columns], values[first, columns]
        with np.errstate(invalid="ignore", divide="ignore"):
            share = left / (left - right)
        between = (share >= 0.0) & (share <= 1.0) & np.isfinite(right) & np.isfinite(left)  # false for NaN
        zero[going] = (low + (high - low) * np.where(between, share, above))[going]
        if done >= ROUNDS - 1:
            going &= ~between
            if not going.any():
                break
    return zero


def dipping(values: Array) -> NDArray[np.bool_]:
    """Tell, of the inner points of a grid along the first axis, where a function comes near zero on one side of it."""
    before, here, after = values[:-2], values[1:-1], values[2:]
    sign = np.where(here >= 0.0, 1.0, -1.0)
    depth = here * sign
    with np.errstate(invalid="ignore"):
        bend = (before - 2.0 * here + after) * sign
    near: NDArray[np.bool_] = (before * sign >= depth) & (after * sign >= depth) & (depth < DIP * bend)
    return near


def _dips(function: Function, theta: Array, values: Array, size: float) -> tuple[Array, Array]:
    """Follow every dip towards zero: cells in which the sign does change, and places where zero is only touched.

    A cell is (low, high, whether the function is above zero at low).
    """
    at = np.flatnonzero(dipping(values))
    low, high, sign = theta[at], theta[at + 2], np.where(values[at + 1] >= 0.0, 1.0, -1.0)
    cells: list[tuple[float, float, bool]] = []
    touches: list[float] = []
    for last in (*(False,) * (DIP_ROUNDS - 1), True):
        if not len(low):
            break
        points = low + (high - low) * np.linspace(0.0, 1.0, SECTIONS + 1)[:, None]
        found = function(points.ravel()).reshape(points.shape) * sign
        found = np.where(np.isnan(found), np.inf, found)
        columns = np.arange(points.shape[1])
        lowest = np.clip(found.argmin(axis=0), 1, len(points) - 2)
        left, depth, right = (found[lowest + k, columns] for k in (-1, 0, 1))
        passed = (found < 0.0).any(axis=0)
        with np.errstate(invalid="ignore"):
            going = ~passed & (depth < DIP * (left - 2.0 * depth + right)) & (not last)
        cells += _cells(points[:, passed], found[:, passed] < 0.0, sign[passed] > 0.0)
        touches += list(points[lowest, columns][~passed & ~going & (depth <= TOUCH * size)])
        low, high, sign = points[lowest - 1, columns][going], points[lowest + 1, columns][going], sign[going]
    return np.array(cells, float).reshape(-1, 3).T, np.array([_bottom(function, touch) for touch in touches])


def _bottom(function: Function, touch: float) -> float:
    """Return where a smooth function that touches zero near `touch` turns there.

    Values around a touch are those of rounding within the root of it, about 1e-8; the slope of a polynomial through
    places far enough around it has its zero where the function turns, to 1e-13. The width is taken at which what the
    polynomial misses shifts this zero least; a corner stays where it was found.
    """
    from numpy.polynomial import Chebyshev

    nodes = np.cos(math.pi * (np.arange(NODES) + 0.5) / NODES)
    found, least = touch, WORST
    for reach in REACHES:
        values = function(touch + reach * nodes)
        if not np.all(np.isfinite(values)):
            continue
        fitted = Chebyshev.fit(nodes, values, DEGREE, domain=(-1.0, 1.0))
        slope, bend, x = fitted.deriv(), fitted.deriv(2), 0.0
        for _ in range(NEWTON):
            if abs(x) < 1.0:
                x -= float(slope(x) / bend(x)) if bend(x) else 1.0
        if abs(x) < 1.0:
            missed = reach * DEGREE * float(np.max(np.abs(fitted(nodes) - values)) / abs(bend(x)))
            found, least = (touch + reach * x, missed) if missed < least else (found, least)
    return found


def _cells(points: Array, below: Array, above: Array) -> list[tuple[float, float, bool]]:
    """Return the cells in which dips, one in each column, pass zero, on the way down and on the way up."""
    cells = []
    for column in range(points.shape[1]):
        beyond, held = np.flatnonzero(below[:, column]), bool(above[column])
        for at, sign in ((beyond[0] - 1, held), (beyond[-1], not held)):
            cells.append((float(points[at, column]), float(points[at + 1, column]), sign))
    return cells


@dataclass(frozen=True, slots=True)
class Extreme:
    """An extreme value and where it is; infinite where the function grows without bound."""

    value: float
    at: float


def extremes(functions: Function, stretches: Sequence[Stretch]) -> list[tuple[Extreme, Extreme] | None]:
    """Return (largest, smallest) of every row, the first of equal ones; None for a row that has no value anywhere.

    The functions take places of shape (N,) and give values of shape (rows, N), NaN where there are none; they may be
    singular at the ends of stretches only.
    """
    best: dict[int, Extreme] = {}
    for stretch in stretches:
        theta = stretch.grid()
        rows, at = _candidates(functions(stretch.place(theta)))
        low, high = theta[np.maximum(at - 1, 0)], theta[np.minimum(at + 1, len(theta) - 1)]
        values, places = _climb(partial(_rated, functions, stretch), rows, low, high, stretch.closed)
        for row, value, theta in zip(rows.tolist(), values.tolist(), places.tolist(), strict=True):
            if row not in best or value > best[row].value + TIE * abs(best[row].value):
                within = theta % (2.0 * math.pi) if stretch.closed else theta
                best[row] = Extreme(value, float(stretch.place(np.array([within]))[0]))
    count = max((max(row, -1 - row) for row in best), default=-1) + 1
    return [
        (best[row], Extreme(-best[-1 - row].value, best[-1 - row].at)) if row in best else None for row in range(count)
    ]


def _rated(functions: Function, stretch: Stretch, rows: NDArray[np.intp], theta: Array) -> Array:
    """Return the values of each peak's own row at `theta`, shape (points, peaks), minus infinity for none.

    Row -1 - k is row k of the functions turned over.
    """
    values = functions(stretch.place(theta.ravel())).reshape(-1, *theta.shape)
    turned = rows < 0
    own = values[np.where(turned, -1 - rows, rows), :, np.arange(len(rows))].T * np.where(turned, -1.0, 1.0)
    return np.where(np.isnan(own), -np.inf, own)


def _candidates(found: Array) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Return row and grid index of the peaks on the grid whose true height may be the largest of the row."""
    heights = np.concatenate((found, -found[::-1]))
    heights = np.where(np.isnan(heights), -np.inf, heights)
    top = heights.max(axis=1, keepdims=True)
    padded = np.pad(heights, ((0, 0), (1, 1)), constant_values=-np.inf)
    before, after = padded[:, :-2], padded[:, 2:]
    with np.errstate(invalid="ignore"):
        bend = np.maximum(2.0 * heights - before - after, 0.0)
        peak = (heights >= before) & (heights >= after) & (heights + bend >= top) & np.isfinite(top)
        flat = np.ptp(np.where(np.isinf(heights), top, heights), axis=1) <= FLAT * np.abs(top[:, 0])
    peak[flat] = False
    peak[flat, np.isfinite(heights[flat]).argmax(axis=1)] = np.isfinite(top[flat, 0])
    many = np.flatnonzero(peak.sum(axis=1) > PEAKS)
    least = -np.partition(-np.where(peak[many], heights[many], -np.inf), PEAKS - 1, axis=1)[:, PEAKS - 1 : PEAKS]
    peak[many] &= heights[many] >= least
    rows, at = np.nonzero(peak)
    return np.where(rows < len(found), rows, rows - 2 * len(found)), at


def _climb(rated: Rated, rows: NDArray[np.intp], low: Array, high: Array, closed: bool) -> tuple[Array, Array]:
    """Close in on every peak in its bracket; return its height and place."""
    parts = np.linspace(0.0, 1.0, PEAK_SECTIONS + 1)[:, None]
    going = np.arange(len(rows))
    value, place = np.full(len(rows), -np.inf), low.copy()
    low, high, grown = low.copy(), high.copy(), np.ones(len(rows))
    for done in range(PEAK_ROUNDS + MORE_ROUNDS):
        points = low[going] + (high[going] - low[going]) * parts
        heights = rated(rows[going], points)
        highest, own = heights.argmax(axis=0), np.arange(len(going))
        low[going] = points[np.maximum(highest - 1, 0), own]
        high[going] = points[np.minimum(highest + 1, PEAK_SECTIONS), own]
        with np.errstate(invalid="ignore", divide="ignore"):
            grown[going] = heights[highest, own] / value[going]
        value[going], place[going] = heights[highest, own], points[highest, own]
        if done >= PEAK_ROUNDS - 1:
            going = going[(grown[going] > GROWS) & (value[going] > 0.0)]
            if not len(going):
                break
    half = 0.5 * (high - low)
    for width in (half, half / 32.0, half / 1024.0):  # parabolas on the peaks, narrower and narrower ones
        points = place + width * np.array([-1.0, 0.0, 1.0])[:, None]
        before, here, after = rated(rows, points if closed else np.clip(points, END, math.pi - END))
        with np.errstate(invalid="ignore", divide="ignore"):
            shift = 0.5 * (before - after) / (before - 2.0 * here + after)
        top = place + np.where(np.abs(shift) <= 1.0, shift, 0.0) * width
        height = rated(rows, top[None, :])[0]
        place, value = np.where(height >= value, top, place), np.maximum(height, value)
    value = np.where((grown > UNBOUNDED) & (value > 0.0), np.inf, value)
    if closed:
        return value, place
    # at an end of the stretch a function may still grow as the end comes nearer
    heights = rated(rows, np.array([10.0 * END, math.pi - 10.0 * END])[:, None] + np.zeros(len(place)))
    with np.errstate(invalid="ignore", divide="ignore"):
        grows = value > 3.0 * np.where(place < 0.5 * math.pi, heights[0], heights[1])
    endless = grows & (value > 0.0) & ((place <= 2.0 * END) | (place >= math.pi - 2.0 * END))
    return np.where(endless, np.inf, value), place
