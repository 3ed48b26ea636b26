"""Places that a label may take beside its node or vector, what each of them would cover, and which are clear of all.

What is drawn is areas, lines and points of shapely: which of them are near a label, and what a leader would run through
or along, is asked of their tree. What each of its places costs is reckoned over arrays, since a sheet has up to two
million pairs of a place and a thing near it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple, TypeAlias

import numpy as np
import shapely
from numpy.typing import ArrayLike, NDArray

from .areas import Shapes, lines, pairs
from .text import Box

Segment: TypeAlias = tuple[complex, complex]
Points: TypeAlias = NDArray[np.complex128]
Reals: TypeAlias = NDArray[np.float64]
Flags: TypeAlias = NDArray[np.bool_]
Numbers: TypeAlias = NDArray[np.intp]

# Costs. Only their order matters: covering something is worse than any sum of the rest.
COVER, AMBIGUOUS, THIN, CROWDED, STEP, TURN, SLIDE, CROSSING = 1e4, 30.0, 300.0, 1.5, 1.0, 1.5, 4.0, 40.0
CLOSE = 6.0  # for each mm that something is nearer than it should be to leave no doubt
ROOM = 2.5  # mm around a label that should be empty where there is a choice
BARE = 2.5  # mm around a label: a thin line nearer than this looks like a bar over or under the letter
DOUBT = 1.0  # mm by which a label should be nearer to its own anchor than to anything else with a name
NEAR = (0.0, 0.8, 2.0, 3.5)  # mm added to the distance that was asked for
FAR = (5.0, 8.0, 11.0, 14.0, 17.0, 20.0, 25.0, 30.0)  # the same for a label on a leader
AFIELD, PITCH = 75.0, 5.0  # mm, how far a label may go when it has no place nearer, and how dense its places are then
ALONG = np.array([0.5, 0.4, 0.6, 0.3, 0.7, 0.22, 0.78, 0.86])  # places along a segment
TOUCH = 0.3  # mm: a stroke that comes so near to a node ends there
SLACK = 1e-9  # mm, for rounding
ROUND = 64  # corners of what stands for a circle where a leader may run through it
MERGED = 5  # boxes through which a leader would rather run than along a stroke


@dataclass(frozen=True, slots=True)
class Obstacles:
    """What is drawn already, in mm: `segments` are main strokes, `thin` ones are only avoided where possible."""

    segments: ArrayLike = ()
    thin: ArrayLike = ()
    circles: Sequence[tuple[complex, float]] = ()
    boxes: Sequence[Box] = ()


@dataclass(frozen=True, slots=True)
class Request:
    """A label of `width` x `height` mm that belongs to a node (a point) or stands beside a segment.

    `clear` is the distance wanted between the box and its anchor, `prefer` the side where it should stand;
    where two labels want the same place, the one with the higher `priority` chooses first. A `strict` label, such as
    that of a dimension, stands rather on a leader than nearer to something else. One that may go `afield` takes a long
    leader, through whatever is drawn, where it has no place nearer.
    """

    name: str
    width: float
    height: float
    anchor: complex | Segment
    clear: float = 1.0
    prefer: complex = 0j
    priority: int = 0
    strict: bool = False
    afield: bool = True


# sixteen sides of a box: where its centre lies in half sizes, and along what normal it leaves the anchor
HEADING = np.exp(1j * np.pi / 8 * np.arange(16))
_SQUARE = HEADING / np.maximum(abs(HEADING.real), abs(HEADING.imag))
SIDE_X, SIDE_Y = _SQUARE.real, _SQUARE.imag
_AXIS = np.where(abs(HEADING.real) > abs(HEADING.imag), np.sign(HEADING.real) + 0j, 1j * np.sign(HEADING.imag))
LEAVE = np.where(np.minimum(abs(SIDE_X), abs(SIDE_Y)) > 0.99, HEADING, _AXIS)


class Wanted(NamedTuple):
    """The requests as arrays of shape (L,); `a` equals `b` for a node, `rim` is the radius of its own circle."""

    a: Points
    b: Points
    hw: Reals
    hh: Reals
    clear: Reals
    rim: Reals
    prefer: Points
    priority: Reals
    strict: Flags

    @classmethod
    def of(cls, requests: Sequence[Request], obstacles: Obstacles, gap: float) -> Wanted:
        """Read the requests; a node's own circle keeps its label at least `gap` away."""
        ends = [r.anchor if isinstance(r.anchor, tuple) else (r.anchor, r.anchor) for r in requests]
        a, b = np.array(ends, dtype=complex).T
        numbers = np.array([(r.width / 2, r.height / 2, r.clear, r.priority) for r in requests], dtype=float).T
        prefer = np.array([r.prefer for r in requests], dtype=complex)
        prefer *= 1 / np.where(prefer == 0, 1, abs(prefer))
        b = np.where(abs(b - a) > 1e-6, b, a)
        centres, radii = np.array(obstacles.circles, dtype=complex).reshape(-1, 2).T
        own = (a == b)[:, None] & (abs(a[:, None] - centres) < TOUCH)
        rim = np.where(own, radii.real, 0.0).max(axis=1, initial=0.0)
        strict = np.array([r.strict for r in requests], dtype=bool)
        return cls(a, b, numbers[0], numbers[1], np.maximum(numbers[2], rim + gap), rim, prefer, numbers[3], strict)

    def feet(self, centre: Points) -> Points:
        """Where leaders from boxes around `centre` should end: on the node, or on the middle part of the segment."""
        along = self.b - self.a
        square = np.where(along == 0, 1, (along * along.conj()).real)
        return self.a + along * _within(((centre - self.a) * along.conj()).real / square, 0.2, 0.8)

    def candidates(self, steps: Reals) -> tuple[Points, Reals, Reals]:
        """Return centres (L, K), distances from the anchor (L, K) and the cost of standing there for its own sake."""
        centre = np.empty((len(self.a), 16, len(steps)), dtype=complex)
        taste = np.empty((len(self.a), 16))
        away = self.clear[:, None] + steps
        is_node = self.a == self.b
        i = is_node.nonzero()[0]
        if i.size:
            side = self.a[i, None] + self.hw[i, None] * SIDE_X + 1j * self.hh[i, None] * SIDE_Y
            centre[i] = side[:, :, None] + LEAVE[:, None] * away[i, None]
            # Without a wish: to the right and up, where a hand writes first.
            wish = np.where(self.prefer[i] == 0, 0.3 * HEADING[2], self.prefer[i])
            taste[i] = TURN * (abs(wish)[:, None] - (np.conj(wish)[:, None] * HEADING).real)
        i = (~is_node).nonzero()[0]
        if i.size:
            along = self.b[i] - self.a[i]
            normal = np.outer(1j * along / abs(along), [1, -1])
            reach = self.hw[i, None] * abs(normal.real) + self.hh[i, None] * abs(normal.imag)
            spot = self.a[i, None] + along[:, None] * ALONG
            out = normal[:, :, None] * (reach[:, :, None] + away[i, None])
            centre[i] = (spot[:, :, None, None] + out[:, None]).reshape(i.size, 16, -1)
            wish = np.where(self.prefer[i] == 0, 0.1 * (0.3 + 1j), self.prefer[i])
            turn = TURN * (abs(wish)[:, None] - (np.conj(wish)[:, None] * normal).real)
            taste[i] = (SLIDE * abs(ALONG - 0.5)[:, None] + turn[:, None]).reshape(i.size, 16)
        shape = (len(self.a), 16 * len(steps))
        own = np.broadcast_to(away[:, None], centre.shape).reshape(shape)
        return centre.reshape(shape), own, (taste[:, :, None] + STEP * steps).reshape(shape)

    def lattice(self) -> tuple[Points, Reals, Reals]:
        """Return the same of places all round the middle of the anchors, a lattice as wide as leaders may be long."""
        across = np.arange(-AFIELD, AFIELD + PITCH / 2, PITCH)
        around = np.ravel(across[:, None] + 1j * across)
        centre = (self.a + self.b)[:, None] / 2 + around
        near = (np.abs(around.real) < self.hw[:, None] + FAR[0]) & (np.abs(around.imag) < self.hh[:, None] + FAR[0])
        own = np.broadcast_to(np.abs(around), centre.shape)
        return centre, own, STEP * own + COVER * near


class Grid(NamedTuple):
    """Places that the labels may take, shape (L, K), and what each would cost; from COVER up it covers something."""

    x: Reals
    y: Reals
    cost: Reals


MAIN, FINE, CIRCLE, NODE, BOX, NAMED = range(6)  # a stroke of the main pen or of another one; a named segment


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
        along = np.where(boxes, 0, half)
        length = abs(along)
        normal = np.where(length == 0, 0, 1j * along / np.where(length == 0, 1, length))
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


class Surroundings:
    """What is drawn, and the nodes and segments to be labelled; labels keep `gap` mm from all of it.

    Inside of `bounds` labels should stand.
    """

    def __init__(
        self, obstacles: Obstacles, gap: float, wanted: Wanted | None = None, bounds: Box | None = None
    ) -> None:
        main = np.asarray(obstacles.segments, dtype=complex).reshape(-1, 2).T
        thin = np.asarray(obstacles.thin, dtype=complex).reshape(-1, 2).T
        centres, radii = np.array(obstacles.circles, dtype=complex).reshape(-1, 2).T
        low_x, low_y, high_x, high_y = np.array(obstacles.boxes, dtype=float).reshape(-1, 4).T
        named = np.array((wanted.a, wanted.b) if wanted else ((), ()), dtype=complex)
        is_node = named[0] == named[1]
        corners = np.array((low_x + 1j * low_y, high_x + 1j * high_y))
        drawn = (main, thin, np.array((centres, centres)), named[:, is_node], corners, named[:, ~is_node])
        self.kind = kind = np.repeat(np.arange(6), [ends.shape[1] for ends in drawn])
        a, b = np.concatenate(drawn, axis=1)
        self.gap, self.bounds, self.things = gap, bounds, Convex.of(a, b, kind == BOX)
        self.things.radius[kind == CIRCLE] = radii.real
        self.hard = (kind != FINE) & (kind != NAMED)
        self.rival = (kind != FINE) & (kind != BOX)  # something with a name of its own
        self._drawn = a, b, np.array(obstacles.boxes, dtype=float).reshape(-1, 4).T, centres, radii

    @cached_property
    def shapes(self) -> Shapes:
        """All things as areas, lines and points of shapely: made when first asked for."""
        a, b, corners, centres, radii = self._drawn
        shapes = lines(a, b)
        shapes[a == b] = shapely.points(pairs(a[a == b]))
        shapes[self.kind == BOX] = shapely.box(*corners)
        rims = centres[:, None] + radii[:, None] * np.exp(2j * np.pi / ROUND * np.arange(ROUND))
        shapes[self.kind == CIRCLE] = shapely.polygons(pairs(rims))
        return shapes

    @cached_property
    def tree(self) -> shapely.STRtree:
        """The tree of the shapes, to be asked what is near."""
        return shapely.STRtree(self.shapes)

    @cached_property
    def middles(self) -> Shapes:
        """The middles of all things."""
        return np.asarray(shapely.points(pairs(self.things.middle)))

    def grid(self, wanted: Wanted, steps: Sequence[float], led: bool = False) -> Grid:
        """Weigh all places of labels at the given steps, or all round (`steps` empty): these may leave the bounds.

        A label on a leader (`led`) may be nearer to another thing.
        """
        centre, own, cost = wanted.candidates(np.asarray(steps)) if len(steps) else wanted.lattice()
        x, y = centre.real.copy(), centre.imag.copy()
        hw, hh = wanted.hw[:, None], wanted.hh[:, None]
        all_round = (x - hw).min(axis=1), (y - hh).min(axis=1), (x + hw).max(axis=1), (y + hh).max(axis=1)
        i, j = self.tree.query(shapely.box(*all_round), predicate="dwithin", distance=ROOM)
        order = np.lexsort((j, i))
        i, j = i[order], j[order]
        near = Convex._make(column[j, None] for column in self.things)
        distance = near.distance(x[i], y[i], hw[i], hh[i])
        hard = self.hard[j]
        weight = np.where(hard, COVER, THIN)[:, None]
        price = np.where(distance < self.gap - SLACK, weight, 0.0)
        crowd = np.where(hard, CROWDED / ROOM, CROWDED / ROOM / 2)[:, None]
        price += crowd * _within(ROOM - distance, 0.0, ROOM)
        belongs = self._belongs(wanted, i, j)
        r = ((self.kind[j] == FINE) & ~(belongs & (wanted.a != wanted.b)[i])).nonzero()[0]
        price[r] += CLOSE * _within(BARE - distance[r], 0.0, BARE)
        if not led:
            r = (self.rival[j] & ~belongs).nonzero()[0]
            lead = distance[r] - own[i[r]]
            doubtful = np.where(wanted.strict[i[r]], THIN, AMBIGUOUS)[:, None]
            price[r] += np.where(lead < 0.1, doubtful, CLOSE * _within(DOUBT - lead, 0.0, DOUBT))
        cost = cost.copy()
        crowded, starts = np.unique(i, return_index=True)
        if len(crowded):
            cost[crowded] += np.add.reduceat(price, starts, axis=0)
        if self.bounds is not None and len(steps):
            x0, y0, x1, y1 = self.bounds
            cost += COVER * ((x - hw < x0) | (x + hw > x1) | (y - hh < y0) | (y + hh > y1))
        return Grid(x, y, cost)

    def _belongs(self, wanted: Wanted, i: Numbers, j: Numbers) -> Flags:
        """Tell which things j are part of what labels i name: they end in the node, or lie along the segment."""
        half = (wanted.b[i] - wanted.a[i]) / 2
        is_node, is_stroke = half == 0, self.things.along[j] != 0
        reach = shapely.distance(
            shapely.points(pairs((wanted.a + wanted.b) / 2))[i], np.where(is_stroke, self.shapes[j], self.middles[j])
        )
        n = (~is_node).nonzero()[0]
        reach[n] = np.minimum(reach[n], shapely.distance(self.middles[j[n]], lines(wanted.a, wanted.b)[i[n]]))
        slope = abs((half * self.things.normal[j].conj()).real)
        aligned = is_node | (is_stroke & (slope < 0.05 * abs(half)))
        at_end = ~is_node & ~is_stroke & (reach < TOUCH)  # a node on the vector itself is no rival
        result: Flags = ((reach < wanted.rim[i] + TOUCH) & aligned) | at_end
        return result

    def crossed(self, heads: Points, starts: Points) -> Numbers:
        """Count what leaders cross or run through, and `MERGED` times the strokes along which they run.

        A box in which one begins is that of the arrow which it names, and does not count; strokes that it runs along
        do, thin ones too: along an axis a leader cannot be seen.
        """
        leaders = lines(starts, heads)
        k, j = self.tree.query(leaders, predicate="dwithin", distance=TOUCH)
        q, v, hx, hy, m, radius = (column[j] for column in self.things)
        p, u, _, _, n, _ = (column[k] for column in Convex.of(starts, heads))
        kind, is_stroke, d = self.kind[j], v != 0, q - p

        def across(vector: Points, normal: Points) -> Reals:
            return np.abs((vector * normal.conj()).real)

        # by determinants, since leaders begin on rims and on strokes: there rounding decides, and should not change
        crosses = is_stroke & self.hard[j] & (across(d, n) < across(v, n)) & (across(d, m) < across(u, m))
        part = _within((d * u.conj()).real / (u * u.conj()).real, -1, 1)
        crosses |= (kind == CIRCLE) & (abs(d - part * u) < radius)
        begins = (abs((starts[k] - q).real) < hx + TOUCH) & (abs((starts[k] - q).imag) < hy + TOUCH)
        crosses |= (kind == BOX) & ~begins & shapely.intersects(self.shapes[j], leaders[k])
        beside = is_stroke & (across(d, m) + across(u, m) < TOUCH)  # both its ends
        merged = beside & (across(d, v) / np.where(is_stroke, abs(v), 1) < abs(v) + abs(u) - TOUCH)
        count: Numbers = np.bincount(k, crosses + MERGED * merged, len(starts))
        return count


def _within(values: Reals, least: float, most: float) -> Reals:
    """Keep values between two bounds: `np.clip` takes four times as long for so few."""
    result: Reals = np.minimum(np.maximum(values, least), most)
    return result


def first_clear(
    places: Sequence[complex], size: tuple[float, float], obstacles: Obstacles, gap: float
) -> complex | None:
    """Return the first place about which a box of this width and height is at least `gap` from everything, mm."""
    at, (wide, high) = np.array(places, dtype=complex), 0.5 * np.array(size)
    # a few places once: the tree of all that is drawn would take three times as long
    away = Surroundings(obstacles, gap).things.distance(at.real[:, None], at.imag[:, None], wide, high)
    clear = (away >= gap).all(axis=1)
    return complex(at[int(np.argmax(clear))]) if clear.any() else None
