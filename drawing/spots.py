"""Places that a label may take beside its node or vector, what each of them would cover, and which are clear of all."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

Box: TypeAlias = tuple[float, float, float, float]
Segment: TypeAlias = tuple[complex, complex]
Points: TypeAlias = NDArray[np.complex128]
Reals: TypeAlias = NDArray[np.float64]
Flags: TypeAlias = NDArray[np.bool_]
NONE: Points = np.empty(0, dtype=complex)

# Costs. Only their order matters: covering something is worse than any sum of the rest.
COVER, AMBIGUOUS, THIN, CROWDED, STEP, TURN, SLIDE, CROSSING = 1e4, 30.0, 300.0, 1.5, 1.0, 1.5, 4.0, 40.0
CLOSE = 6.0  # for each mm that something is nearer than it should be to leave no doubt
ROOM = 2.5  # mm around a label that should be empty where there is a choice
BARE = 2.5  # mm around a label: a thin line nearer than this looks like a bar over or under the letter
APART = 1.4  # mm that should be left between two labels side by side, beyond the gap around each
DOUBT = 1.0  # mm by which a label should be nearer to its own anchor than to anything else with a name
NEAR = (0.0, 0.8, 2.0, 3.5)  # mm added to the distance that was asked for
FAR = (5.0, 8.0, 11.0, 14.0, 17.0, 20.0, 25.0, 30.0)  # the same for a label on a leader
AFIELD, PITCH = 75.0, 5.0  # mm, how far a label may go when it has no place nearer, and how dense its places are then
ALONG = np.array([0.5, 0.4, 0.6, 0.3, 0.7, 0.22, 0.78, 0.86])  # places along a segment
TOUCH = 0.3  # mm: a stroke that comes so near to a node ends there
SLACK = 1e-9  # mm, for rounding
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


def circle_table(circles: Sequence[tuple[complex, float]]) -> tuple[Points, Reals]:
    """Return the centres and the radii of circles as two arrays."""
    table = np.array([(c.real, c.imag, r) for c, r in circles], dtype=float).reshape(-1, 3)
    return table[:, 0] + 1j * table[:, 1], table[:, 2]


def _compass() -> tuple[Reals, Reals, Points]:
    """Sixteen sides of a box: where its centre lies in half sizes, and along what normal it leaves the anchor."""
    e = np.exp(1j * np.pi / 8 * np.arange(16))
    s = e / np.maximum(abs(e.real), abs(e.imag))
    corner = np.minimum(abs(s.real), abs(s.imag)) > 0.99
    axis = np.where(abs(e.real) > abs(e.imag), np.sign(e.real) + 0j, 1j * np.sign(e.imag))
    return s.real, s.imag, np.where(corner, e, axis)


SIDE_X, SIDE_Y, LEAVE = _compass()
HEADING = np.exp(1j * np.pi / 8 * np.arange(16))


@dataclass(frozen=True, slots=True, eq=False)
class Wanted:
    """The requests as arrays of shape (L,); `a` equals `b` for a node."""

    a: Points
    b: Points
    hw: Reals
    hh: Reals
    clear: Reals
    rim: Reals  # radius of the node's own circle
    prefer: Points
    priority: NDArray[np.int64]
    strict: Flags
    gap: float

    @classmethod
    def of(cls, requests: Sequence[Request], circles: tuple[Points, Reals], gap: float) -> Wanted:
        """Read the requests; a node's own circle keeps its label at least `gap` away."""
        ends = [r.anchor if isinstance(r.anchor, tuple) else (r.anchor, r.anchor) for r in requests]
        a, b = np.array(ends, dtype=complex).T
        numbers = np.array([(r.width / 2, r.height / 2, r.clear, r.priority) for r in requests], dtype=float).T
        prefer = np.array([r.prefer for r in requests], dtype=complex)
        prefer *= 1 / np.where(prefer == 0, 1, abs(prefer))
        b = np.where(abs(b - a) > 1e-6, b, a)
        centres, radii = circles
        own = (a == b)[:, None] & (abs(a[:, None] - centres) < TOUCH)
        rim = np.where(own, radii, 0.0).max(axis=1, initial=0.0)
        clear = np.maximum(numbers[2], rim + gap)
        strict = np.array([r.strict for r in requests], dtype=bool)
        return cls(a, b, numbers[0], numbers[1], clear, rim, prefer, numbers[3].astype(int), strict, gap)

    def some(self, rows: NDArray[np.intp]) -> Wanted:
        """Return the same of some labels."""
        a, b, prefer = self.a[rows], self.b[rows], self.prefer[rows]
        hw, hh, clear, rim = self.hw[rows], self.hh[rows], self.clear[rows], self.rim[rows]
        return Wanted(a, b, hw, hh, clear, rim, prefer, self.priority[rows], self.strict[rows], self.gap)

    def at(self, share: float) -> Wanted:
        """Return the same labels, those of segments as if they named the node at this share of the length."""
        node = self.a + (self.b - self.a) * share
        return replace(self, a=node, b=node)

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
        cost = STEP * np.broadcast_to(np.abs(around), centre.shape) + COVER * near
        return centre, np.broadcast_to(np.abs(around), centre.shape), cost


@dataclass(frozen=True, slots=True, eq=False)
class Bodies:
    """Strokes, circles and boxes in one table: a box of half sizes hx, hy, cut by a normal, swollen by a radius."""

    middle: Points
    along: Points  # half of a stroke
    hx: Reals
    hy: Reals
    normal: Points
    radius: Reals
    hard: Flags
    rival: Flags  # something with a name of its own

    @classmethod
    def of(cls, obstacles: Obstacles, a: Points = NONE, b: Points = NONE) -> Bodies:
        """Gather the obstacles, and what is to be labelled: segments from `a` to `b`, nodes where these are equal."""
        main = np.asarray(obstacles.segments, dtype=complex).reshape(-1, 2)
        thin = np.asarray(obstacles.thin, dtype=complex).reshape(-1, 2)
        centres, radii = circle_table(obstacles.circles)
        is_point = a == b
        edges = np.array(obstacles.boxes, dtype=float).reshape(-1, 4)
        # The first body lies far away: so every label has a neighbour, and sums over neighbours are never empty.
        far = np.array([1e9 + 1e9j])
        starts, ends = edges[:, 0] + 1j * edges[:, 1], edges[:, 2] + 1j * edges[:, 3]
        kinds = (
            (far, far),
            (main[:, 0], main[:, 1]),
            (thin[:, 0], thin[:, 1]),
            (centres, centres),
            (a[is_point], a[is_point]),
            (starts, ends),
            (a[~is_point], b[~is_point]),
        )
        is_main, is_thin, is_circle, is_node, is_box, is_named = (
            np.repeat(np.arange(7), [len(begins) for begins, _ in kinds]) == kind for kind in range(1, 7)
        )
        bodies = cls.strokes(*(np.concatenate(points) for points in zip(*kinds, strict=True)))
        bodies.radius[is_circle] = radii
        bodies.along[is_box] = bodies.normal[is_box] = 0.0
        rival = is_main | is_circle | is_node | is_named
        return replace(bodies, hard=~(is_thin | is_named), rival=rival)

    @classmethod
    def strokes(cls, a: Points, b: Points) -> Bodies:
        """Return bodies that are the strokes from `a` to `b`."""
        half = (b - a) / 2
        length = abs(half)
        normal = np.where(length == 0, 0, 1j * half / np.where(length == 0, 1, length))
        yes = np.ones(len(a), dtype=bool)
        return cls((a + b) / 2, half, abs(half.real), abs(half.imag), normal, np.zeros(len(a)), yes, yes)

    def distance(self, x: Reals, y: Reals, hw: Reals, hh: Reals, i: NDArray[np.intp] | slice) -> Reals:
        """Distance from boxes to bodies `i`, or a little less than it between two corners; zero where they meet.

        Two convex bodies are apart exactly when they are apart along x, along y or along the stroke's normal.
        """
        nx, ny = self.normal.real[i], self.normal.imag[i]
        dx = x - self.middle.real[i]
        dy = y - self.middle.imag[i]
        across = dx * nx
        across += dy * ny
        np.abs(across, out=across)
        across -= hw * abs(nx) + hh * abs(ny)
        for d, reach in ((dx, hw + self.hx[i]), (dy, hh + self.hy[i])):
            np.abs(d, out=d)
            d -= reach
            np.maximum(d, 0.0, out=d)
            d *= d
        dx += dy
        np.sqrt(dx, out=dx)
        np.maximum(dx, across, out=dx)
        dx -= self.radius[i]
        result: Reals = dx
        return result


def _within(values: Reals, least: float, most: float) -> Reals:
    """Keep values between two bounds: `np.clip` takes four times as long for so few."""
    result: Reals = np.minimum(np.maximum(values, least), most)
    return result


def _from_point(p: Points, middle: Points, half: Points) -> Reals:
    """Distance from points to strokes."""
    square = np.where(half == 0, 1, (half * half.conj()).real)
    t = _within(((p - middle) * half.conj()).real / square, -1, 1)
    result: Reals = np.abs(p - middle - t * half)
    return result


@dataclass(frozen=True, slots=True, eq=False)
class Grid:
    """Places that the labels may take, shape (L, K), and what each would cost; from COVER up it covers something."""

    x: Reals
    y: Reals
    cost: Reals

    @classmethod
    def around(
        cls, wanted: Wanted, bodies: Bodies, steps: Sequence[float], bounds: Box | None, led: bool = False
    ) -> Grid:
        """Weigh all candidates at the given steps, or all round (`steps` empty).

        A label on a leader (`led`) may be nearer to another thing.
        """
        centre, own, cost = wanted.candidates(np.asarray(steps)) if len(steps) else wanted.lattice()
        x, y = centre.real.copy(), centre.imag.copy()
        hw, hh = wanted.hw[:, None], wanted.hh[:, None]
        left, right, low, high = x.min(axis=1), x.max(axis=1), y.min(axis=1), y.max(axis=1)
        # Most bodies are far from most labels: only neighbours are looked at place by place.
        reach_x, reach_y = (right - left)[:, None] / 2 + hw, (high - low)[:, None] / 2 + hh
        middle_x, middle_y = (left + right)[:, None] / 2, (low + high)[:, None] / 2
        near = bodies.distance(middle_x, middle_y, reach_x, reach_y, slice(None)) < ROOM
        near[:, 0] = True
        i, j = np.nonzero(near)
        distance = bodies.distance(x[i], y[i], hw[i], hh[i], j[:, None])
        hard = bodies.hard[j]
        weight = np.where(hard, COVER, THIN)[:, None]
        price = np.where(distance < wanted.gap - SLACK, weight, 0.0)
        crowd = np.where(hard, CROWDED / ROOM, CROWDED / ROOM / 2)[:, None]
        price += crowd * _within(ROOM - distance, 0.0, ROOM)
        belongs = _belongs(wanted, bodies, i, j)
        own_line = belongs & (wanted.a != wanted.b)[i]
        r = (~hard & ~bodies.rival[j] & ~own_line).nonzero()[0]
        price[r] += CLOSE * _within(BARE - distance[r], 0.0, BARE)
        if not led:
            r = (bodies.rival[j] & ~belongs).nonzero()[0]
            lead = distance[r] - own[i[r]]
            doubtful = np.where(wanted.strict[i[r]], THIN, AMBIGUOUS)[:, None]
            price[r] += np.where(lead < 0.1, doubtful, CLOSE * _within(DOUBT - lead, 0.0, DOUBT))
        cost = cost + np.add.reduceat(price, np.searchsorted(i, np.arange(len(x))), axis=0)
        if bounds is not None:
            x0, y0, x1, y1 = bounds
            cost = cost + COVER * ((x - hw < x0) | (x + hw > x1) | (y - hh < y0) | (y + hh > y1))
        return cls(x, y, cost)


def _belongs(wanted: Wanted, bodies: Bodies, i: NDArray[np.intp], j: NDArray[np.intp]) -> Flags:
    """Tell which bodies j are part of what labels i name: they end in the node, or lie along the segment."""
    half = (wanted.b[i] - wanted.a[i]) / 2
    middle = wanted.a[i] + half
    is_node = half == 0
    reach = np.minimum(
        _from_point(middle, bodies.middle[j], bodies.along[j]),
        np.where(is_node, np.inf, _from_point(bodies.middle[j], middle, half)),
    )
    slope = abs((half * bodies.normal[j].conj()).real)
    aligned = is_node | ((bodies.along[j] != 0) & (slope < 0.05 * abs(half)))
    at_end = ~is_node & (bodies.along[j] == 0) & (reach < TOUCH)  # a node on the vector itself is no rival
    result: Flags = ((reach < wanted.rim[i] + TOUCH) & aligned) | at_end
    return result


def crossings(lines: Bodies, bodies: Bodies) -> NDArray[np.intp]:
    """Count, for each line, the hard strokes and circles that it crosses."""
    p, u = lines.middle[:, None], lines.along[:, None]
    q, v = bodies.middle, bodies.along
    d = q - p
    n, m = lines.normal[:, None], bodies.normal
    over = abs((d * n.conj()).real) < abs((v * n.conj()).real)  # the stroke's ends lie on both sides of the line
    under = abs((d * m.conj()).real) < abs((u * m.conj()).real)
    hit = over & under & (v != 0) & bodies.hard
    hit |= (_from_point(q[None, :], p, u) < bodies.radius) & (v == 0) & bodies.hard & (bodies.radius > 0)
    count: NDArray[np.intp] = hit.sum(axis=1)
    return count


def overlaps(lines: Bodies, bodies: Bodies) -> NDArray[np.intp]:
    """Count, for each line, the boxes through which it runs, and `MERGED` times the strokes along which it runs.

    A box in which it begins is that of the arrow which it names, and does not count; strokes do, thin ones too: along
    an axis a leader cannot be seen.
    """
    box = ((bodies.along == 0) & (bodies.hx > 0) & (bodies.hy > 0)).nonzero()[0]
    x, y, hx, hy = (
        part[:, None] for part in (bodies.middle.real[box], bodies.middle.imag[box], bodies.hx[box], bodies.hy[box])
    )
    start = lines.middle - lines.along
    begins = (abs(start.real - x) < hx + TOUCH) & (abs(start.imag - y) < hy + TOUCH)
    through = (lines.distance(x, y, hx, hy, slice(None)) < SLACK) & ~begins
    stroke = (bodies.along != 0).nonzero()[0]
    q, v, m = bodies.middle[stroke], bodies.along[stroke], bodies.normal[stroke]
    d, u = lines.middle[:, None] - q, lines.along[:, None]
    beside = abs((d * m.conj()).real) + abs((u * m.conj()).real) < TOUCH  # both its ends
    way = abs((d * v.conj()).real) * (1.0 / abs(v))
    along = beside & (way < abs(v) + abs(u) - TOUCH)
    count: NDArray[np.intp] = through.sum(axis=0) + MERGED * along.sum(axis=1)
    return count


def first_clear(
    places: Sequence[complex], size: tuple[float, float], obstacles: Obstacles, gap: float
) -> complex | None:
    """Return the first place about which a box of this width and height is at least `gap` from everything, mm."""
    at, (wide, high) = np.array(places, dtype=complex), 0.5 * np.array(size)
    away = Bodies.of(obstacles).distance(at.real[:, None], at.imag[:, None], wide, high, slice(None))
    clear = (away >= gap).all(axis=1)
    return complex(at[int(np.argmax(clear))]) if clear.any() else None
