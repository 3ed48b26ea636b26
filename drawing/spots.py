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
from numpy.typing import ArrayLike

from .areas import Shapes, lines, pairs
from .formats import HEAD_HALF_WIDTH
from .raster import CELL, Cells, Convex, Flags, Numbers, Points, Reals, within
from .text import Box

Segment: TypeAlias = tuple[complex, complex]

# Costs. Only their order matters: covering something, or being read as the name of another, is worse than all the rest.
COVER, AMBIGUOUS, THIN, CROWDED, STEP, TURN, SLIDE, CROSSING = 1e4, 30.0, 300.0, 1.5, 1.0, 1.5, 4.0, 120.0
CLOSE = 6.0  # for each mm that something is nearer than it should be to leave no doubt
ONE = 15.0  # for each letter with which a label reads as one word or as a fraction
ROW = 5.0  # for each letter before or behind it on one line, so near that both may be read as one
ROOM = 2.5  # mm around a label that should be empty where there is a choice
BARE = 2.5  # mm around a label: a thin line nearer than this looks like a bar over or under the letter
LEVEL = 0.2  # sine of the angle up to which one through its own node does so, too
DOUBT = 1.0  # mm by which a label should be nearer to its own anchor than to anything else with a name
SURELY = 0.3  # mm by which it must be nearer than to another node
PLAINLY = 0.7  # mm by which it must beside a segment be nearer than to another segment: letters that lean fill no box
WIDE = 3.0  # mm: a larger circle stands for no node
EVEN = 1e-6  # mm by which it may be further from it than from another one in the same place
NEAR = (0.0, 0.8, 2.0, 3.5)  # mm added to the distance that was asked for; beside a segment the second is best
FAR = np.array([5.0, 8.0, 11.0, 14.0, 17.0, 20.0, 25.0, 30.0])  # mm, how long leaders are
AFIELD = np.array([35.0, 42.0, 50.0, 60.0, 75.0])  # mm, how long where there is no place nearer
ALONG = np.array([0.5, 0.4, 0.6, 0.3, 0.7, 0.22, 0.78, 0.86])  # places along a segment
STARTS = np.array([0.5, 0.35, 0.65, 0.2, 0.8, 0.08, 0.92])  # the same for the start of a leader
LONE = 1.0  # mm from them at which a leader is plainly that of its own
NEARER = 150.0  # what it costs that letters without their bar are nearer to another vector
AWAY = 2.5  # mm from other segments at which one on a leader is plainly not theirs
SHARED = 40.0  # what it costs a leader to start where its own line lies on another one
STEEP = np.exp(1j * np.radians([*range(30, 151, 15), *range(-150, -29, 15)]))  # a level leader would be a bar or a dash
FROM_RIGHT = complex(np.exp(1j * np.radians(105.0)))  # a steeper line would be read from the left
ACROSS, GRAZING = 0.42, 0.2  # sines of the least angle between a leader and its own segment, and any other line
TOUCH = 0.3  # mm: a stroke that comes so near to a node ends there
LEAVES, PASSING = 0.2, 0.45  # mm at which a leader has left its node, and that it keeps from the circle of another one
KNEES = np.arange(3.0, 25.0, 2.0)  # mm from its start at which a leader may bend
ROUND_ABOUT = np.exp(1j * np.radians(np.arange(0.0, 360.0, 10.0)))  # where it may run before it bends
AFTER = ROUND_ABOUT[abs(ROUND_ABOUT.imag) > 0.49]  # and then: neither a bar nor a dash
BEND, SHARPEST = 12.0, -0.3  # what a bend costs; cosine of the sharpest
WIDER = np.array([1.0, 1.1, 1.2, 1.3, 1.4])  # times as wide as what it is about may be the circle of a detail
SLACK = 1e-9  # mm, for rounding
ROUND = 64  # corners of what stands for a circle where a leader may run through it


@dataclass(frozen=True, slots=True)
class Obstacles:
    """What is drawn already, in mm: `segments` are main strokes, `thin` ones are only avoided where possible."""

    segments: ArrayLike = ()
    thin: ArrayLike = ()
    circles: Sequence[tuple[complex, float]] = ()
    boxes: Sequence[Box] = ()
    heads: Sequence[tuple[complex, complex]] = ()  # arrowheads, from the middle of their back to the tip
    kept: Sequence[Box] = ()  # clear of labels; leaders may run through


@dataclass(frozen=True, slots=True)
class Request:
    """A label of `width` x `height` mm that belongs to a node (a point) or stands beside a segment.

    `clear` is the least distance between the box and its anchor, from a segment a little more where there is room,
    `prefer` the side where it should stand; where two labels want the same place, the one with the higher `priority`
    chooses first. A `strict` label, such as that of a dimension, stands rather on a leader than nearer to something
    else. One that may go `afield` takes a long leader where it has no place nearer, through whatever is drawn where it
    must. One that may run `along` its segment is turned with it before it is set apart. An `optional` one runs along it
    rather than not, gives way to all others, and is left out where there is no room. One with a bar has its `bare` box,
    that of its letters only, from its corner: they, too, stand nearest to what they name.
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
    along: bool = True
    optional: bool = False
    other: Segment | None = None
    bare: Box | None = None


# sixteen sides of a box: where its centre lies in half sizes, and along what normal it leaves the anchor
HEADING = np.exp(1j * np.pi / 8 * np.arange(16))
_SQUARE = HEADING / np.maximum(abs(HEADING.real), abs(HEADING.imag))
SIDE_X, SIDE_Y = _SQUARE.real, _SQUARE.imag
_AXIS = np.where(abs(HEADING.real) > abs(HEADING.imag), np.sign(HEADING.real) + 0j, 1j * np.sign(HEADING.imag))
LEAVE = np.where(np.minimum(abs(SIDE_X), abs(SIDE_Y)) > 0.99, HEADING, _AXIS)


class Wanted(NamedTuple):
    """The requests as arrays of shape (L,); `a` equals `b` for a node, `rim` is the radius of its own circle.

    The `bare` box of a label with a bar is about a place `aside` of its middle, of half sizes as a complex number.
    """

    a: Points
    b: Points
    hw: Reals
    hh: Reals
    clear: Reals
    rim: Reals
    prefer: Points
    priority: Reals
    strict: Flags
    aside: Points
    bare: Points

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
        clear = np.maximum(numbers[2], rim + gap)
        return cls(a, b, numbers[0], numbers[1], clear, rim, prefer, numbers[3], strict, *cls._bare(requests))

    @staticmethod
    def _bare(requests: Sequence[Request]) -> tuple[Points, Points]:
        """Return where the middles of letters without bars are from those of the labels, and their half sizes."""
        boxes = np.array([r.bare or (0.0, 0.0, r.width, r.height) for r in requests], dtype=float).T
        low, high = boxes[0] + 1j * boxes[1], boxes[2] + 1j * boxes[3]
        whole = np.array([complex(r.width, r.height) for r in requests])
        return (low + high - whole) / 2, (high - low) / 2

    def sized(self, requests: Sequence[Request]) -> Wanted:
        """Return the same wishes for labels of other sizes."""
        half = np.array([(r.width / 2, r.height / 2) for r in requests], dtype=float).T
        aside, bare = self._bare(requests)
        return self._replace(hw=half[0], hh=half[1], aside=aside, bare=bare)

    def at(self, i: int, a: complex, b: complex) -> Wanted:
        """Return the requests with another segment for label i."""
        ends = self.a.copy(), self.b.copy()
        ends[0][i], ends[1][i] = a, b
        return self._replace(a=ends[0], b=ends[1])

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
        far = np.broadcast_to(steps, (len(self.a), 1, len(steps))).copy()
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
            far[i] = abs(steps - NEAR[1])
        shape = (len(self.a), 16 * len(steps))
        own = np.broadcast_to(away[:, None], centre.shape).reshape(shape)
        return centre.reshape(shape), own, (taste[:, :, None] + STEP * far).reshape(shape)

    def leads(self, i: int, lengths: Reals, ways: Points, starts: Reals) -> tuple[Points, Reals]:
        """Return leaders of label i, shape (4, K), and what each costs for its own sake; from a segment at `starts`.

        The four are the middle of the label, head and start of the leader, and the way from the start to the head.
        """
        a, along = self.a[i], self.b[i] - self.a[i]
        share, way, length = starts if along else STARTS[:1], ways, lengths
        if along:  # beside a segment it should not be taken for a part of it
            way = way[abs((way * np.conj(along)).imag) >= ACROSS * abs(along)]
        wish = self.prefer[i] if self.prefer[i] != 0 else 0.3 * HEADING[2]
        cost = SLIDE * abs(share - 0.5)[:, None, None] + TURN * (1.0 - (np.conj(wish) * way).real)[:, None]
        start = (a + along * share)[:, None, None] + (way * self.rim[i])[:, None]
        head = start + way[:, None] * length
        at = head + self.beside_head(i, way)[:, None]
        shape = len(share), len(way), len(length)
        leads = np.array([np.broadcast_to(part, shape).ravel() for part in (at, head, start, way[:, None])])
        return leads, np.broadcast_to(cost + STEP * length, shape).flatten()

    def beside_head(self, i: int, way: Points) -> Points:
        """Return where the middle of label i is from the heads of leaders that come in these directions."""
        side: Points = np.clip(1.5 * way.real, -1.0, 1.0) * self.hw[i] + 1j * np.sign(way.imag) * self.hh[i]
        return side

    def bent(self, i: int, knees: Points, ways: Points, costs: Reals) -> tuple[Points, Reals, Numbers]:
        """Return leaders of label i, as `leads` does, from knees to which others run; the number of each knee."""
        length, way, k = (grid.ravel() for grid in np.meshgrid(FAR, AFTER, np.arange(len(knees)), indexing="ij"))
        turn = (np.conj(way) * ways[k]).real
        kept = (turn > SHARPEST) & (turn < 0.99)
        length, way, k = length[kept].real, way[kept], k[kept]
        head = knees[k] + way * length
        leads = np.array([head + self.beside_head(i, way), head, knees[k], way])
        return leads, costs[k] + STEP * length + BEND, k

    def turned(self, i: int) -> tuple[Points, complex, Reals]:
        """Return middles of label i where it runs along its segment, its direction, and what each place costs.

        It is read from below or from the right.
        """
        along = self.b[i] - self.a[i]
        e = along / abs(along)
        e = -e if (e / FROM_RIGHT).imag > SLACK else e
        sides, steps = np.array([1j, -1j]) * e, np.array(NEAR[:3])
        wish = self.prefer[i] if self.prefer[i] != 0 else 0.1j * e
        cost = SLIDE * abs(ALONG - 0.5)[:, None, None] + STEP * abs(steps - NEAR[1])
        cost = cost + TURN * (1.0 - (np.conj(wish) * sides).real)[:, None]
        out = sides[:, None] * (self.hh[i] + self.clear[i] + steps)
        at = (self.a[i] + along * ALONG)[:, None, None] + out
        order = np.argsort(cost.ravel(), kind="stable")
        return at.ravel()[order], complex(e), cost.ravel()[order]


class _Grid(NamedTuple):
    """Places that the labels may take, shape (L, K), and what each would cost; from COVER up it covers something."""

    x: Reals
    y: Reals
    cost: Reals


# a stroke of the main pen or of another one; a named segment; an arrowhead
MAIN, FINE, CIRCLE, NODE, BOX, NAMED, HEAD = range(7)


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
        boxes = np.array([*obstacles.boxes, *obstacles.kept], dtype=float).reshape(-1, 4)
        low_x, low_y, high_x, high_y = boxes.T
        heads = np.array(obstacles.heads, dtype=complex).reshape(-1, 2).T
        named = np.array((wanted.a, wanted.b) if wanted else ((), ()), dtype=complex)
        is_node = named[0] == named[1]
        corners = np.array((low_x + 1j * low_y, high_x + 1j * high_y))
        drawn = (main, thin, np.array((centres, centres)), named[:, is_node], corners, named[:, ~is_node], heads)
        self.kind = kind = np.repeat(np.arange(7), [ends.shape[1] for ends in drawn])
        a, b = np.concatenate(drawn, axis=1)
        self.gap, self.bounds, self.things = gap, bounds, Convex.of(a, b, kind == BOX)
        self.things.radius[kind == CIRCLE] = radii.real
        self.things.radius[kind == HEAD] = abs(heads[1] - heads[0]) * HEAD_HALF_WIDTH
        self.hard = (kind != FINE) & (kind != NAMED)
        self.bars = self.hard.copy()  # leaders, too
        self.bars[(kind == BOX).nonzero()[0][len(obstacles.boxes) :]] = False
        self.rival = (kind != FINE) & (kind != BOX) & (kind != HEAD)  # something with a name of its own
        self._drawn = a, b, boxes.T, centres, radii

    @cached_property
    def shapes(self) -> Shapes:
        """All things as areas, lines and points of shapely: made when first asked for."""
        a, b, corners, centres, radii = self._drawn
        shapes = lines(a, b)
        shapes[a == b] = shapely.points(pairs(a[a == b]))
        shapes[self.kind == BOX] = shapely.box(*corners)
        rims = centres[:, None] + radii[:, None] * np.exp(2j * np.pi / ROUND * np.arange(ROUND))
        shapes[self.kind == CIRCLE] = shapely.polygons(pairs(rims))
        back, tip = a[self.kind == HEAD], b[self.kind == HEAD]
        across = 1j * (tip - back) * HEAD_HALF_WIDTH
        shapes[self.kind == HEAD] = shapely.polygons(pairs(np.stack((back - across, tip, back + across), axis=-1)))
        return shapes

    @cached_property
    def tree(self) -> shapely.STRtree:
        """The tree of the shapes, to be asked what is near."""
        return shapely.STRtree(self.shapes)

    @cached_property
    def middles(self) -> Shapes:
        """The middles of all things."""
        return np.asarray(shapely.points(pairs(self.things.middle)))

    def grid(self, wanted: Wanted, steps: Sequence[float]) -> _Grid:
        """Weigh all places of labels beside their nodes and segments at the given steps."""
        centre, own, cost = wanted.candidates(np.asarray(steps))
        x, y = centre.real.copy(), centre.imag.copy()
        hw, hh = wanted.hw[:, None], wanted.hh[:, None]
        all_round = (x - hw).min(axis=1), (y - hh).min(axis=1), (x + hw).max(axis=1), (y + hh).max(axis=1)
        i, j = self.tree.query(
            shapely.box(*all_round), predicate="dwithin", distance=np.maximum(ROOM, wanted.clear + steps[-1] + PLAINLY)
        )
        order = np.lexsort((j, i))
        i, j = i[order], j[order]
        near = Convex._make(column[j, None] for column in self.things)
        distance = near.distance(x[i], y[i], hw[i], hh[i])
        hard = self.hard[j]
        weight = np.where(hard, COVER, THIN)[:, None]
        price = np.where(distance < self.gap - SLACK, weight, 0.0)
        belongs = self._belongs(wanted, i, j)
        # what ends in its own node crowds no letter: away from it the letter would only be far from the node
        crowd = (np.where(hard, 1.0, 0.5) * ~(belongs & (wanted.a == wanted.b)[i]) * CROWDED / ROOM)[:, None]
        price += crowd * within(ROOM - distance, 0.0, ROOM)
        steep = abs(self.things.normal[j].real) > LEVEL
        r = ((self.kind[j] == FINE) & ~(belongs & ((wanted.a != wanted.b)[i] | steep))).nonzero()[0]
        price[r] += CLOSE * within(BARE - distance[r], 0.0, BARE)
        r = (self.rival[j] & ~belongs).nonzero()[0]
        lead, same = distance[r] - own[i[r]], self._same_kind(wanted, i[r], j[r])
        doubtful = np.where(same, COVER, np.where(wanted.strict[i[r]], THIN, AMBIGUOUS))[:, None]
        apart = np.where(same, np.where((wanted.a == wanted.b)[i[r]], SURELY, PLAINLY), 0.1)
        price[r] += np.where(lead < apart[:, None], doubtful, 0.0)
        price[r] += CLOSE * within(DOUBT - lead, 0.0, DOUBT)
        r, lead = self._barely(wanted, i, j, (x, y))
        price[r] += np.where(lead < np.where(belongs[r], -EVEN, SURELY)[:, None], NEARER, 0.0)
        price += np.where(self._foreign(wanted, i, j, belongs, distance, own[i]), COVER, 0.0)
        cost = cost.copy()
        crowded, starts = np.unique(i, return_index=True)
        if len(crowded):
            cost[crowded] += np.add.reduceat(price, starts, axis=0)
        if self.bounds is not None:
            cost += COVER * self._beyond(centre, hw + 1j * hh)
        return _Grid(x, y, cost)

    def _barely(self, wanted: Wanted, i: Numbers, j: Numbers, at: tuple[Reals, Reals]) -> tuple[Numbers, Reals]:
        """Return which pairs are letters with bars and other segments; by how much they are nearer to their own."""
        barred = (wanted.a != wanted.b) & (wanted.bare.imag < wanted.hh - SLACK)
        r = (barred[i] & self._same_kind(wanted, i, j)).nonzero()[0]
        r = r[(abs(self.things.middle[j[r]] - 0.5 * (wanted.a + wanted.b)[i[r]]) > SLACK)]
        k = i[r]
        x, y, half = at[0] + wanted.aside.real[:, None], at[1] + wanted.aside.imag[:, None], wanted.bare[:, None]
        own = Convex._make(column[:, None] for column in Convex.of(wanted.a, wanted.b))
        far = own.distance(x, y, half.real, half.imag)
        others = Convex._make(column[j[r], None] for column in self.things)
        return r, others.distance(x[k], y[k], half.real[k], half.imag[k]) - far[k]

    def _foreign(self, wanted: Wanted, i: Numbers, j: Numbers, belongs: Flags, distance: Reals, own: Reals) -> Flags:
        """Tell which places of labels i are nearer to things j in the place of their own, or to circles of others.

        Of two vectors in one place, or nearly so, a letter stands on the side of its own.
        """
        lead, is_circle = distance - own, (self.kind[j] == CIRCLE) & (self.things.radius[j] < WIDE)
        lead += np.where(is_circle, wanted.rim[i], 0.0)[:, None]
        other = is_circle & (wanted.a == wanted.b)[i] & (abs(self.things.middle[j] - wanted.a[i]) > SLACK)
        foreign = np.where(belongs & (other | self._same_kind(wanted, i, j)), -EVEN, np.where(other, SURELY, -np.inf))
        nearer: Flags = lead < foreign[:, None]
        return nearer

    def _same_kind(self, wanted: Wanted, i: Numbers, j: Numbers) -> Flags:
        """Tell which things j could be what labels i name: other nodes, or other segments."""
        same: Flags = np.where((wanted.a == wanted.b)[i], self.kind[j] == NODE, self.named[j])
        return same

    @cached_property
    def named(self) -> Flags:
        """Tell what is a segment with a name, or a stroke along which one lies: an arrow that has its letter aside."""
        named: Flags = self.kind == NAMED
        if named.any():
            strokes = (self.kind == MAIN).nonzero()[0]
            middle, along = self.things.middle[strokes, None], self.things.along[strokes, None]
            long = np.maximum(abs(along), SLACK)
            on = np.ones((len(strokes), int(named.sum())), dtype=bool)
            for end in (-1, 1):
                foot = (self.things.middle[named] + end * self.things.along[named] - middle) * along.conj() / long
                on &= (abs(foot.imag) < TOUCH) & (abs(foot.real) < long + TOUCH)
            named[strokes[on.any(axis=1)]] = True
        return named

    def _beyond(self, at: Points, reach: complex | Points) -> Flags:
        """Tell which boxes about places, of half sizes `reach`, leave the bounds."""
        x0, y0, x1, y1 = self.bounds or (-np.inf, -np.inf, np.inf, np.inf)
        low, high = at - reach, at + reach
        beyond: Flags = (low.real < x0) | (high.real > x1) | (low.imag < y0) | (high.imag > y1)
        return beyond

    def free(self, at: Points, hw: float, hh: float, beyond: bool) -> Flags:
        """Tell which boxes of one size about places cover nothing; without `beyond` they stay in the bounds, too."""
        clear = self.cells.free(at, complex(hw, hh), self.gap)
        return clear if beyond else clear & ~self._beyond(at, complex(hw, hh))

    @cached_property
    def cells(self) -> Cells:
        """All that no label may cover, by cells."""
        return Cells.of(*(column[self.hard] for column in self.things))

    @cached_property
    def barring(self) -> Cells:
        """All that leaders may not cross, by cells."""
        return (
            Cells.of(*(column[self.bars] for column in self.things)) if (self.bars != self.hard).any() else self.cells
        )

    @cached_property
    def fine(self) -> Cells:
        """Thin strokes, by cells."""
        return Cells.of(*(column[self.kind == FINE] for column in self.things))

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
        rim = np.where(self.kind[j] == NODE, 0.0, wanted.rim[i])
        result: Flags = ((reach < rim + TOUCH) & aligned) | at_end
        return result

    def alone(self, starts: Points, a: complex, b: complex) -> Reals:
        """Return how far places on the segment from a to b are from other lines and arrowheads, at most `LONE`."""
        none, strokes = np.zeros(1), (self.kind == NAMED) | (self.kind == MAIN)
        others = strokes & self._off(a, b)
        middle, tip = self.things.middle, self.things.middle + self.things.along
        # its own head is at its tip, or in the middle of a short one
        others |= (self.kind == HEAD) & (abs(tip - b) > TOUCH) & (abs(middle - (a + b) / 2) > TOUCH)
        near = Convex._make(column[others] for column in self.things)
        away = near.distance(starts.real[:, None], starts.imag[:, None], none, none)
        nearest: Reals = away.min(axis=1, initial=LONE)
        return nearest

    def beside(self, at: Points, half: complex, a: complex, b: complex) -> Reals:
        """Return how near boxes of half size `half` about places are to other segments than that from a to b.

        It is `AWAY` mm at most.
        """
        near = Convex._make(column[self.named & (self._off(a, b) | (a == b))] for column in self.things)
        away = near.distance(at.real[:, None], at.imag[:, None], np.array(half.real), np.array(half.imag))
        nearest: Reals = away.min(axis=1, initial=AWAY)
        return nearest

    def _off(self, a: complex, b: complex) -> Flags:
        """Tell which things the segment from a to b does not lie along."""
        none, ends = np.zeros(1), np.array((a, b))[:, None]
        off: Flags = self.things.distance(ends.real, ends.imag, none, none).max(axis=0) > TOUCH
        return off

    def crossed(self, heads: Points, starts: Points) -> Numbers:
        """Count what leaders cross, run through or along, or leave at so small an angle that they seem to belong to it.

        An arrowhead in which one begins is that of the arrow which it names, and does not count; thin strokes count
        only where it runs along them: along an axis a leader cannot be seen.
        """
        low, high = np.minimum(starts.real, heads.real), np.maximum(starts.real, heads.real)
        under, over = np.minimum(starts.imag, heads.imag), np.maximum(starts.imag, heads.imag)
        k, j = self.tree.query(shapely.box(low - PASSING, under - PASSING, high + PASSING, over + PASSING))
        leaders = lines(starts, heads)
        q, v, hx, hy, m, radius = (column[j] for column in self.things)
        sides = Convex.of(starts, heads)
        u, n = sides.along[k], sides.normal[k]
        kind, d = self.kind[j], q - sides.middle[k]
        is_head = kind == HEAD
        is_stroke = (v != 0) & ~is_head

        def across(vector: Points, normal: Points) -> Reals:
            return np.abs((vector * normal.conj()).real)

        # by determinants, since leaders begin on rims and on strokes: there rounding decides, and should not change
        crosses = is_stroke & self.hard[j] & (across(d, n) < across(v, n)) & (across(d, m) < across(u, m))
        runs = is_stroke & (kind != NAMED) & (across(u, m) < GRAZING * abs(u))
        # nodes on the way, but for the first half of a millimetre, where the leader leaves its own
        begin = starts + (heads - starts) * np.minimum(LEAVES / np.maximum(abs(heads - starts), SLACK), 0.5)
        few = ((kind == CIRCLE) | (kind == NODE)).nonzero()[0]
        half, d = (heads - begin)[k[few]] / 2, q[few] - (heads + begin)[k[few]] / 2
        near = abs(d - within((d * half.conj()).real / (half * half.conj()).real, -1, 1) * half)
        crosses[few] |= near < radius[few] + PASSING
        begins = (abs((starts[k] - q).real) < hx + TOUCH) & (abs((starts[k] - q).imag) < hy + TOUCH)
        few = (is_head & begins).nonzero()[0]
        begins[few] = shapely.dwithin(self.shapes[j[few]], shapely.points(pairs(starts[k[few]])), TOUCH)
        solid = ((kind == BOX) & self.bars[j]) | is_head
        few = ((runs & ~crosses) | (solid & ~begins)).nonzero()[0]
        crosses[few] = shapely.dwithin(self.shapes[j[few]], leaders[k[few]], TOUCH)
        count: Numbers = np.bincount(k, crosses, len(starts))
        return count

    def struck(self, boxes: Sequence[Box]) -> list[bool]:
        """Tell which boxes thin strokes run through."""
        k, j = self.tree.query(shapely.box(*np.array(boxes, dtype=float).reshape(-1, 4).T), predicate="intersects")
        through: list[bool] = (np.bincount(k, self.kind[j] == FINE, len(boxes)) > 0).tolist()
        return through

    def along(self, wanted: Wanted, i: int, at: Points, e: complex) -> Flags:
        """Tell at which places label i, turned into the direction `e`, covers nothing and names its own segment."""
        (hw, hh), near = (wanted.hw[i], wanted.hh[i]), self.gap / 2
        across, upward = (np.arange(-size - near, size + near + CELL, CELL) for size in (hw, hh))
        rows = (across + 1j * upward[:, None]) * e
        free = np.ones(len(at), dtype=bool)
        for inside in (rows[len(rows) // 2], rows[::4], rows):  # some rows tell of most places that they are taken
            left = free.nonzero()[0]
            points = at[left, None] + inside.ravel()
            free[left] = ~self.cells.at(points.real, points.imag).any(axis=1)
        half = abs((hw * e).real) + abs((hh * e).imag) + 1j * (abs((hw * e).imag) + abs((hh * e).real))
        free &= ~self._beyond(at, half)
        if not free.any():
            return free
        left, reach = free.nonzero()[0], float(wanted.clear[i]) + NEAR[2] + SURELY
        corners = np.array([s * hw + t * 1j * hh for s, t in ((-1, -1), (1, -1), (1, 1), (-1, 1))]) * e
        boxes = shapely.polygons(pairs(at[left, None] + corners))
        # what is far from the upright box round a turned one is far from it, too
        away = self.things.distance(at.real[left, None], at.imag[left, None], half.real, half.imag)
        close_by: Flags = away <= reach
        k, j = close_by.nonzero()
        distance = shapely.distance(boxes[k], self.shapes[j])
        far = abs(((at - wanted.a[i]) / e).imag) - hh  # from its own segment
        own, every = Wanted._make(column[i : i + 1] for column in wanted), np.flatnonzero(close_by.any(axis=0))
        one = np.zeros(len(every), dtype=int)
        lead, same = np.full(len(self.kind), SURELY), np.zeros(len(self.kind), dtype=bool)
        lead[every[self._belongs(own, one, every)]] = -EVEN
        same[every] = self._same_kind(own, one, every)
        bad = (distance < self.gap - SLACK) & (self.kind[j] != NAMED)
        bad |= same[j] & (distance < far[left[k]] + lead[j])
        free[left] &= np.bincount(k, bad, len(left)) == 0
        return free


def first_clear(
    places: Sequence[complex], size: tuple[float, float], obstacles: Obstacles, gap: float
) -> complex | None:
    """Return the first place about which a box of this width and height is at least `gap` from everything, mm."""
    at, (wide, high) = np.array(places, dtype=complex), 0.5 * np.array(size)
    # a few places once: the tree of all that is drawn would take three times as long
    away = Surroundings(obstacles, gap).things.distance(at.real[:, None], at.imag[:, None], wide, high)
    clear = (away >= gap).all(axis=1)
    return complex(at[int(np.argmax(clear))]) if clear.any() else None


def shelf(
    centre: complex, radius: float, size: tuple[float, float], obstacles: Obstacles, gap: float = 1.0
) -> tuple[complex, complex, complex]:
    """Return the leader of a letter on a shelf, from a circle: its start, its knee and the end of the shelf.

    Leader and letter, of this width and height, are clear of all that is drawn where that is possible: the circle may
    be `WIDER` then, so that the leader begins outside of lines that close round it.
    """
    around, (wide, high) = Surroundings(obstacles, gap), 0.5 * np.array(size)
    way, length, wider = (grid.ravel() for grid in np.meshgrid(STEEP[abs(STEEP.real) > SLACK], FAR, WIDER))
    starts, knees = centre + radius * wider * way, centre + (radius * wider + length) * way
    ends = knees + 2.0 * wide * np.sign(way.real)
    middles = 0.5 * (knees + ends) + 1j * high
    near = around.things.distance(middles.real[:, None], middles.imag[:, None], wide, high) < gap
    cost = THIN * (near.sum(axis=1) + around.crossed(knees, starts) + wider - 1.0)
    cost += length - TURN * (way * (1.0 - 1.0j)).real
    best = int(cost.argmin())
    return complex(starts[best]), complex(knees[best]), complex(ends[best])
