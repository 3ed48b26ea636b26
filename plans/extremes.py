"""The largest and smallest values of many functions of one variable at once, refined between the points of a grid."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .zeros import END, Stretch

Array = NDArray[np.float64]
Functions = Callable[[Array], Array]
SECTIONS, ROUNDS, MORE_ROUNDS = 16, 2, 8
GROWS, UNBOUNDED = 1.01, 1.5  # growth in a round of sections that asks for another, that has no end
FLAT = 1e-12  # part of its size within which a function is constant
TIE = 1e-9  # part of its height by which a peak must be higher than an earlier one to count: rounding must not choose
PEAKS = 4  # so many of the highest peaks of a row are followed; noise has many


@dataclass(frozen=True, slots=True)
class Extreme:
    """An extreme value and where it is; infinite where the function grows without bound."""

    value: float
    at: float


@dataclass(slots=True)
class _Search:
    """Peaks of the rows of `functions` (row -1 - k: of row k turned over) on one stretch, each in its bracket."""

    functions: Functions
    stretch: Stretch
    rows: NDArray[np.intp]
    low: Array
    high: Array

    def rated(self, theta: Array) -> Array:
        """Return the values of each peak's own row at `theta`, shape (points, peaks), minus infinity for none."""
        values = self.functions(self.stretch.place(theta.ravel())).reshape(-1, *theta.shape)
        turned = self.rows < 0
        row = np.where(turned, -1 - self.rows, self.rows)
        own = values[row, :, np.arange(len(row))].T * np.where(turned, -1.0, 1.0)
        return np.where(np.isnan(own), -np.inf, own)


def extremes(functions: Functions, stretches: Sequence[Stretch]) -> list[tuple[Extreme, Extreme] | None]:
    """Return (largest, smallest) of every row, the first of equal ones; None for a row that has no value anywhere.

    Parameters
    ----------
    functions : callable
        Takes places of shape (N,), gives values of shape (rows, N), NaN where there are none.
    stretches : sequence of Stretch
        Where to look; the functions may be singular at their ends only.
    """
    best: dict[int, Extreme] = {}
    for stretch in stretches:
        for row, value, theta in _peaks(functions, stretch):
            if row not in best or value > best[row].value + TIE * abs(best[row].value):
                within = theta % (2.0 * math.pi) if stretch.closed else theta
                best[row] = Extreme(value, float(stretch.place(np.array([within]))[0]))
    count = max((max(row, -1 - row) for row in best), default=-1) + 1
    return [
        (best[row], Extreme(-best[-1 - row].value, best[-1 - row].at)) if row in best else None for row in range(count)
    ]


def _peaks(functions: Functions, stretch: Stretch) -> list[tuple[int, float, float]]:
    """Return row, value and place of every peak on a stretch that may be the highest of its row."""
    theta = stretch.grid()
    found = functions(stretch.place(theta))
    rows, at = _candidates(found)
    low, high = theta[np.maximum(at - 1, 0)], theta[np.minimum(at + 1, len(theta) - 1)]
    search = _Search(functions, stretch, rows, low, high)
    value, place = _climb(search)
    if not stretch.closed:
        value = np.where(_endless(search, place, value), np.inf, value)
    return list(zip(rows.tolist(), value.tolist(), place.tolist(), strict=True))


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


def _climb(search: _Search) -> tuple[Array, Array]:
    """Close in on every peak; return its height and place."""
    parts = np.linspace(0.0, 1.0, SECTIONS + 1)[:, None]
    columns = np.arange(len(search.rows))
    going = columns
    value, place = np.full(len(columns), -np.inf), search.low.copy()
    low, high = search.low.copy(), search.high.copy()
    grown = np.ones(len(columns))
    for done in range(ROUNDS + MORE_ROUNDS):
        part = _Search(search.functions, search.stretch, search.rows[going], low[going], high[going])
        points = part.low + (part.high - part.low) * parts
        heights = part.rated(points)
        highest, own = heights.argmax(axis=0), np.arange(len(going))
        low[going] = points[np.maximum(highest - 1, 0), own]
        high[going] = points[np.minimum(highest + 1, SECTIONS), own]
        with np.errstate(invalid="ignore", divide="ignore"):
            grown[going] = heights[highest, own] / value[going]
        value[going], place[going] = heights[highest, own], points[highest, own]
        if done >= ROUNDS - 1:
            going = going[(grown[going] > GROWS) & (value[going] > 0.0)]
            if not len(going):
                break
    value, place = _topped(search, value, place, 0.5 * (high - low))
    return np.where((grown > UNBOUNDED) & (value > 0.0), np.inf, value), place


def _topped(search: _Search, value: Array, place: Array, half: Array) -> tuple[Array, Array]:
    """Put parabolas on the peaks, narrower and narrower ones; keep what is higher."""
    for width in (half, half / 32.0, half / 1024.0):
        points = place + width * np.array([-1.0, 0.0, 1.0])[:, None]
        if not search.stretch.closed:
            points = np.clip(points, END, math.pi - END)
        before, here, after = search.rated(points)
        with np.errstate(invalid="ignore", divide="ignore"):
            shift = 0.5 * (before - after) / (before - 2.0 * here + after)
        top = place + np.where(np.abs(shift) <= 1.0, shift, 0.0) * width
        height = search.rated(top[None, :])[0]
        place, value = np.where(height >= value, top, place), np.maximum(height, value)
    return value, place


def _endless(search: _Search, place: Array, value: Array) -> NDArray[np.bool_]:
    """Tell for which peaks at an end of the stretch the function still grows as the end comes nearer."""
    before = np.array([10.0 * END, math.pi - 10.0 * END])[:, None] + np.zeros(len(place))
    heights = search.rated(before)
    earlier = np.where(place < 0.5 * math.pi, heights[0], heights[1])
    with np.errstate(invalid="ignore", divide="ignore"):
        grows = value > 3.0 * earlier
    endless: NDArray[np.bool_] = grows & (value > 0.0) & ((place <= 2.0 * END) | (place >= math.pi - 2.0 * END))
    return endless
