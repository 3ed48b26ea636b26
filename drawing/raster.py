"""What is drawn as convex areas, and as cells of a raster: how far boxes are from it, and what leaders run through."""

from __future__ import annotations

from itertools import pairwise
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

Points: TypeAlias = NDArray[np.complex128]
Reals: TypeAlias = NDArray[np.float64]
Flags: TypeAlias = NDArray[np.bool_]
Numbers: TypeAlias = NDArray[np.intp]

BEGIN = 1.6  # mm from its start on which a leader is not yet looked at by cells
CELL = 0.4  # mm: cells of the raster of all that no label may cover
MOST = 2200  # cells side by side: more than on A1; those of a drawing beyond all sheets are larger


class Convex(NamedTuple):
    """Strokes, circles and boxes: boxes of half sizes `hx` and `hy`, cut by a stroke's normal, swollen by a radius."""

    middle: Points
    along: Points  # half of a stroke
    hx: Reals
    hy: Reals
    normal: Points
    radius: Reals

    @classmethod
    def of(cls, a: Points, b: Points, boxes: Flags | bool = False) -> Convex:
        """Return strokes from `a` to `b`, or `boxes` between these corners."""
        half = (b - a) / 2
        along = half if boxes is False else np.where(boxes, 0, half)
        length = abs(along)
        normal = 1j * along / (length + (length == 0))
        return cls((a + b) / 2, along, abs(half.real), abs(half.imag), normal, np.zeros(len(a)))

    def distance(self, x: Reals, y: Reals, hw: Reals, hh: Reals) -> Reals:
        """Distance from boxes, or a little less than it between two corners; zero where they meet.

        Two convex areas are apart exactly when they are apart along x, along y or along the stroke's normal.
        """
        nx, ny = self.normal.real, self.normal.imag
        dx = x - self.middle.real
        dy = y - self.middle.imag
        across = dx * nx
        across += dy * ny
        np.abs(across, out=across)
        across -= hw * abs(nx) + hh * abs(ny)
        for d, reach in ((dx, hw + self.hx), (dy, hh + self.hy)):
            np.abs(d, out=d)
            d -= reach
            np.maximum(d, 0.0, out=d)
            d *= d
        dx += dy
        np.sqrt(dx, out=dx)
        np.maximum(dx, across, out=dx)
        dx -= self.radius
        return dx


class Cells(NamedTuple):
    """Cells of a raster with anything in them: their lower left corner, which they are, how many are below and left.

    From such sums any number of boxes are known to be free at once. Those that are `filled` have empty ones round them.
    """

    side: float
    corner: complex
    filled: Flags
    total: NDArray[np.int32]

    @classmethod
    def of(cls, *columns: Any) -> Cells:
        """Return the cells of things; they are a little larger than these."""
        middle, along, hx, hy, _, radius = columns
        if not len(middle):
            return cls(CELL, 0j, np.zeros((2, 2), dtype=bool), np.zeros((1, 1), dtype=int))
        reach = np.maximum(abs(along.real), hx) + radius + 1j * (np.maximum(abs(along.imag), hy) + radius)
        low, high = middle - reach, middle + reach
        corner = complex(low.real.min(), low.imag.min())
        size = complex(high.real.max(), high.imag.max()) - corner
        side = max(CELL, size.real / MOST, size.imag / MOST)
        corner -= side * (1 + 1j)
        filled = np.zeros((int(size.imag / side) + 6, int(size.real / side) + 6), dtype=bool)
        cells = filled[1:-1, 1:-1]
        # strokes by points that are denser than cells
        of, part, count = _counted(np.ceil(4 * abs(along) / side).astype(int) + 1)
        places = [middle[of] + along[of] * (2 * part / np.maximum(count - 1, 1) - 1)]
        places += _in_heads(middle, along, radius, side)
        wide = (along == 0) & (hx + hy + radius > 0)
        for centre, x, y, r in zip(*(column[wide].tolist() for column in (middle, hx, hy, radius)), strict=True):
            across, upward = (np.arange(-reach - r, reach + r + side / 2, side / 2) for reach in (x, y))
            within = (across + 1j * upward[:, None]).ravel()
            places.append(centre + (within[abs(within) < r + side] if r else within))
        at = (np.concatenate(places) - corner) / side
        cells[at.imag.astype(int), at.real.astype(int)] = True
        total = np.zeros((cells.shape[0] + 1, cells.shape[1] + 1), dtype=np.int32)
        cells.cumsum(axis=1, out=total[1:, 1:])
        for below, row in pairwise(total):  # four times as fast as a sum along columns
            row += below
        return cls(side, corner, filled, total)

    def free(self, at: Points, half: complex, gap: float) -> Flags:
        """Tell which boxes of one half size about places have nothing in them, nor nearer than a gap."""
        (rows, columns), reach = self.total.shape, half + (gap + self.side / 4) * (1 + 1j)
        low, high = (at - reach - self.corner) / self.side, (at + reach - self.corner) / self.side + (1 + 1j)
        x0, x1 = (within(np.floor(x), 0, columns - 1).astype(int) for x in (low.real, high.real))
        y0, y1 = (within(np.floor(y), 0, rows - 1).astype(int) for y in (low.imag, high.imag))
        count, below, above = self.total.ravel(), y0 * columns, y1 * columns
        inside = count.take(above + x1) - count.take(below + x1) - count.take(above + x0) + count.take(below + x0)
        clear: Flags = inside == 0
        return clear

    def at(self, x: Reals, y: Reals) -> Flags:
        """Tell which points are in cells with anything."""
        cell = np.zeros(x.shape, dtype=int)
        for places, corner, count in zip((y, x), (self.corner.imag, self.corner.real), self.filled.shape, strict=True):
            place = places - corner
            place /= self.side
            np.floor(place, out=place)
            place += 1.0
            np.maximum(place, 0.0, out=place)
            np.minimum(place, count - 1.0, out=place)
            cell *= count
            cell += place.astype(int)
        found: Flags = self.filled.ravel().take(cell)
        return found

    def barred(self, starts: Points, heads: Points) -> Flags:
        """Tell which leaders run through such cells, where they begin excepted."""
        length = abs(heads - starts)
        step = (starts - heads) / length * self.side
        count = within(np.ceil((length - BEGIN) / self.side), 0, np.inf).astype(int) + 1
        found = np.zeros(len(starts), dtype=bool)
        for every in (4, 1):  # some cells tell of most leaders that they are barred
            left = (~found).nonzero()[0]
            if not left.size:
                break
            some = (count[left] - 1) // every + 1
            ends = some.cumsum()
            part = np.arange(ends[-1]) - np.repeat(ends - some, some)
            part *= every
            x, y = (np.repeat(of[left], some) for of in (heads.real, heads.imag))
            x += np.repeat(step.real[left], some) * part
            y += np.repeat(step.imag[left], some) * part
            found[left] = np.logical_or.reduceat(self.at(x, y), ends - some)
        return found

    def clear(self, leads: Points, most: int) -> Numbers:
        """Return the first leaders, as `Wanted.leads` has them, at `most` so many, that run through no such cells."""
        clear = np.zeros(0, dtype=int)
        for begin in range(0, leads.shape[1], 2 * most):
            if len(clear) >= most:
                break
            own = leads[:, begin : begin + 2 * most]
            clear = np.append(clear, begin + (~self.barred(own[2], own[1])).nonzero()[0])
        return clear[:most]


def _in_heads(middle: Points, along: Points, radius: Reals, side: float) -> list[Points]:
    """Return points that fill arrowheads, strokes with half the width of their backs, more densely than cells."""
    heads = ((along != 0) & (radius > 0)).nonzero()[0]
    if not heads.size:
        return []
    middle, along, radius = middle[heads], along[heads], radius[heads]
    rows = np.linspace(0.0, 1.0, int(4 * abs(along).max() / side) + 2)
    across = np.linspace(-1.0, 1.0, int(4 * radius.max() / side) + 2)
    back = 1j * along / abs(along) * radius
    inside = (middle + along)[:, None, None] - (2 * along)[:, None, None] * rows[:, None]
    return [(inside + back[:, None, None] * rows[:, None] * across).ravel()]


def _counted(count: Numbers) -> tuple[Numbers, Numbers, Numbers]:
    """Return for as many as are counted of each its number, its rank among its own, and how many they are."""
    of = np.repeat(np.arange(len(count)), count)
    return of, np.arange(len(of)) - np.repeat(np.cumsum(count) - count, count), count[of]


def within(values: Reals, least: float, most: float) -> Reals:
    """Keep values between two bounds: `np.clip` takes four times as long for so few."""
    result: Reals = np.minimum(np.maximum(values, least), most)
    return result
