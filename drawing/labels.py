"""Where the labels of a view stand: free of everything else, each beside its own node or vector."""

from __future__ import annotations

from cmath import phase, rect
from collections.abc import Collection, Sequence
from copy import copy
from dataclasses import dataclass, field
from functools import lru_cache

import numpy as np
import shapely

from . import spots
from .areas import Shapes, lines
from .raster import Convex, Flags, Numbers, Points, Reals
from .spots import Obstacles, Request, Segment, Surroundings, Wanted
from .text import Box

APART = 1.4  # mm that should be left between two labels side by side, beyond the gap around each
BAR = 1.2  # mm between a label and the leader of another, which nearer would look like a bar over or under it
SOME = 120  # leaders, the cheapest for their own sake, that are looked at
AGAIN = 4  # times that all labels are placed anew when some found no place; the last time leaders may cross lines
FARTHEST = 1e4  # mm: so far apart labels stand in nobody's way
ROUNDS = 3  # times that labels in trouble are looked through
MANY = 24  # of these, for whom no order helps: the drawing is crowded


@dataclass(frozen=True, slots=True)
class Labels:
    """Lower left corners by name, leaders (from label to anchor) of those set apart, and who covers something.

    A leader may have a bend.

    The corner of one that runs along its segment is that in its own direction, an angle in radians. `crossed` are those
    through which a thin line runs, or which stand nearer to another thing than they should, or whose leader had to
    cross a line.
    """

    corners: dict[str, complex] = field(default_factory=dict)
    leaders: dict[str, tuple[complex, ...]] = field(default_factory=dict)
    angles: dict[str, float] = field(default_factory=dict)
    failed: tuple[str, ...] = ()
    crossed: tuple[str, ...] = ()


def place(requests: Sequence[Request], obstacles: Obstacles, gap: float = 0.6, bounds: Box | None = None) -> Labels:
    """Find a place for every label, the same places for the same input; their names differ.

    They cover none of the `obstacles`, have an empty distance of `gap` mm around them, and stay inside of the `bounds`
    if there is a place for all there. Every request has a corner, but for optional ones without room; `failed` names
    those that cover something none the less.
    """
    return Scene(requests, obstacles, gap, bounds).place()


@lru_cache(maxsize=64)
def scene_of(requests: tuple[Request, ...], obstacles: Obstacles, bounds: Box | None = None) -> Scene:
    """Return what is to be lettered: the same scene for the same, as views of one variant come again on its pages."""
    return Scene(requests, obstacles, bounds=bounds)


class Scene:
    """What is to be lettered, all that is in the way, the places weighed so far, and what came of them."""

    def __init__(
        self, requests: Sequence[Request], obstacles: Obstacles, gap: float = 0.6, bounds: Box | None = None
    ) -> None:
        if len({request.name for request in requests}) != len(requests):
            raise ValueError("two labels have one name")
        self.requests, self.gap = requests, max(gap, 0.01)
        self._asked: dict[tuple[Request, ...], Scene] = {}
        self._placed: dict[tuple[frozenset[str], bool], Labels] = {}
        if requests:
            self._weigh(obstacles, bounds)

    def asking(self, requests: tuple[Request, ...]) -> Scene:
        """Return the scene for `requests` of other sizes, or that may go farther; what is weighed already stays."""
        if requests not in self._asked:
            self._asked[requests] = self._asking(requests)
        return self._asked[requests]

    def _asking(self, requests: tuple[Request, ...]) -> Scene:
        other = copy(self)
        other._asked, other._placed = {}, {}
        other.requests = requests
        if [(r.width, r.height) for r in requests] != [(r.width, r.height) for r in self.requests]:
            half = np.array([(r.width / 2, r.height / 2) for r in requests], dtype=float).T
            other.wanted = self.wanted._replace(hw=half[0], hh=half[1])
            other._lay_out()
        return other

    def place(self, without: Collection[str] = (), may_cross: bool = True) -> Labels:
        """Find a place for every label but those left out; what these name is still no place for another.

        Leaders cross lines at last, where they may.
        """
        key = frozenset(without), may_cross
        if key not in self._placed:
            self._placed[key] = self._place(*key) if self.requests else Labels()
        return self._placed[key]

    def _place(self, without: Collection[str], may_cross: bool) -> Labels:
        board, first, cross = _Board(self, without, ()), tuple[int, ...](), False
        better, tried = board, (first, cross)
        for again in range(AGAIN):
            failed = board.in_trouble()
            if not failed or len(failed) > MANY or not all(self.requests[i].afield for i in failed):
                break
            # who found no place the last time chooses first the next time
            first, cross = (*first, *(i for i in failed if i not in first)), again == AGAIN - 1 or cross
            if (first, cross) != tried:
                better, tried = _Board(self, without, first, cross and may_cross), (first, cross)
            if len(better.in_trouble()) < len(failed):
                board = better
            elif cross or not may_cross:
                break
            else:
                cross = True  # no order helps
        return board.labels()

    def _weigh(self, obstacles: Obstacles, bounds: Box | None) -> None:
        self.wanted = Wanted.of(self.requests, obstacles, self.gap)
        self.around = Surroundings(obstacles, self.gap, self.wanted, bounds)
        self._lay_out()

    def _lay_out(self) -> None:
        self.grid = self.around.grid(self.wanted, spots.NEAR)
        self._leads: dict[tuple[int, bool, bool], tuple[Points, Reals, Flags]] = {}
        self._bent: dict[int, tuple[Points, Reals, Points]] = {}
        self._along: dict[int, tuple[Points, complex]] = {}

    def leads(self, i: int, afield: bool, cross: bool) -> tuple[Points, Reals, Flags]:
        """Return leaders of label i whose ends cover nothing, shape (4, K), their costs, and which cross lines.

        They cross nothing, unless they may `cross` lines. They are the same every time that all labels are placed anew.
        """
        key = i, afield, cross
        if key not in self._leads:
            leads, cost = self.wanted.leads(i, np.append(spots.FAR, spots.AFIELD) if afield else spots.FAR)
            half = float(self.wanted.hw[i]), float(self.wanted.hh[i])
            few = _cheapest(cost, self.around.free(leads[0], *half, afield).nonzero()[0])
            cost[few] += spots.THIN * ~self.around.fine.free(leads[0, few], complex(*half), self.gap / 2)
            few = _cheapest(cost, few)
            clear = slice(None, None, -(-len(few) // SOME) or 1)
            few = few[clear if cross else self.around.barring.clear(leads[:, few], SOME)]
            leads, cost = leads[:, few], cost[few]
            _, head, start, way = leads
            crossings = self.around.crossed(head, start + spots.TOUCH * way)
            few = np.arange(len(cost)) if cross else (crossings == 0).nonzero()[0]
            self._leads[key] = leads[:, few], (cost + spots.CROSSING * crossings)[few], crossings[few] > 0
        return self._leads[key]

    def bent(self, i: int) -> tuple[Points, Reals, Points]:
        """Return leaders of label i with a bend that cross nothing and whose ends cover nothing, as `leads` does.

        Returned are the parts from the bends, shape (4, K), what each costs, and where they start.
        """
        if i not in self._bent:
            around, half = self.around, (float(self.wanted.hw[i]), float(self.wanted.hh[i]))
            (_, knee, start, way), cost = self.wanted.leads(i, spots.KNEES, spots.ROUND_ABOUT)
            few = _cheapest(cost, (~around.barring.barred(start, knee)).nonzero()[0])
            few = few[:: -(-len(few) // SOME) or 1]  # not only the shortest
            few = few[around.crossed(knee[few], start[few] + spots.TOUCH * way[few]) == 0]
            leads, costs, k = self.wanted.bent(i, knee[few], way[few], cost[few])
            left = _cheapest(costs, around.free(leads[0], *half, True).nonzero()[0])
            left = left[around.barring.clear(leads[:, left], SOME)]
            left = left[around.crossed(leads[1, left], leads[2, left]) == 0]
            self._bent[i] = leads[:, left], costs[left], start[few][k[left]]
        return self._bent[i]

    @property
    def shut_in(self) -> int:
        """How many labels have no place beside their own things that covers nothing, whatever the others do."""
        return int((self.grid.cost.min(axis=1) >= spots.COVER).sum()) if self.requests else 0

    def struck(self, boxes: Sequence[Box]) -> list[bool]:
        """Tell which boxes thin strokes run through."""
        return self.around.struck(boxes) if self.requests else [False] * len(boxes)

    def along(self, i: int) -> tuple[Points, complex]:
        """Return where label i may run along its segment, the best place first, and in which direction."""
        if i not in self._along:
            at, e, _ = self.wanted.turned(i)
            self._along[i] = at[self.around.along(self.wanted, i, at, e)], e
        return self._along[i]


def _cheapest(costs: Reals, few: Numbers) -> Numbers:
    """Return a few, by number, the cheapest first; of two that cost the same the first one stays before the other."""
    return few[np.argsort(costs[few], kind="stable")]


class _Board:
    """The places taken so far; it is changed in place while labels are tried and moved.

    Those of `first` are placed before the others and as far away as they must, on leaders that may `cross` lines; some
    are `without` a place.
    """

    def __init__(self, scene: Scene, without: Collection[str], first: Sequence[int], cross: bool = False) -> None:
        self.scene, self.requests, self.wanted, self.gap = scene, scene.requests, scene.wanted, scene.gap
        self.x, self.y, self.cost = scene.grid
        rows = np.arange(len(self.x))
        pick = self.cost.argmin(axis=1)
        self.now_x, self.now_y, self.now = (column[rows, pick] for column in scene.grid)
        self.down = np.zeros(len(self.x), dtype=bool)
        self.leaders: dict[int, tuple[complex, ...]] = {}
        self.angles: dict[int, tuple[complex, float]] = {}  # middles and directions of labels along their segments
        self._laid: list[tuple[complex, complex, float]] = []  # what these and leaders take: strokes, their half widths
        self._strokes: tuple[Convex, Shapes, Reals] | None = None
        self._out = [i for i, request in enumerate(self.requests) if request.name in without]
        self._optional = [i for i, request in enumerate(self.requests) if request.optional and i not in self._out]
        away = self._out + self._optional
        self.now_x[away] = FARTHEST * (np.array(away) + 1.0)
        self.now[away], self.down[away] = 0.0, True
        for i in first:
            cost, k = self._best(i)
            afield = self.requests[i].afield
            if cost < spots.COVER or not self._apart(i, spots.COVER, afield, cross and afield):
                self._put(i, k)
        # leave alone who is in nobody's way; then the most constrained label chooses first
        self.down |= self._touching(APART, 0.0).sum(axis=1) == 1
        free, rest = (self.cost < spots.COVER).sum(axis=1), (~self.down).nonzero()[0]
        for i in rest[np.lexsort((rest, free[rest], -self.wanted.priority[rest]))].tolist():
            self._put(i, self._best(i)[1])
        for _ in range(ROUNDS):  # give each label in trouble a place by moving those that block it
            if not [i for i in self.in_trouble() if self._improve(i)]:
                break
        # set apart, on leaders, who found no free place or whom a thin line would run through, but for those that find
        # no free place there either; of two labels that touch one may stay: the less important is taken up first
        bad = self.in_trouble()
        bad.sort(key=lambda i: (self.requests[i].priority, self.now[i] < spots.COVER, i))
        for i in bad:
            if self._troubled(i):
                afield = bool(first) and self.requests[i].afield
                self._apart(i, spots.COVER, afield, cross and afield)
        for i in self._crossed() * 2:  # who moves may leave room for another
            if i not in self.leaders and i not in self.angles:
                self._apart(i, spots.THIN, False, False)

    def labels(self) -> Labels:
        """Return where all stand, and who of them does not stand well."""
        names, w = [request.name for request in self.requests], self.wanted
        gone = {names[i] for i in self._optional if not self._room(i)} | {names[i] for i in self._out}
        corners = (self.now_x - w.hw) + 1j * (self.now_y - w.hh)
        for i, (at, angle) in self.angles.items():
            corners[i] = at - complex(w.hw[i], w.hh[i]) * rect(1.0, angle)
        return Labels(
            {name: at for name, at in zip(names, corners.tolist(), strict=True) if name not in gone},
            {names[i]: leader for i, leader in sorted(self.leaders.items())},
            {names[i]: angle for i, (_, angle) in sorted(self.angles.items())},
            tuple(names[i] for i in self.in_trouble()),
            tuple(names[i] for i in self._crossed()),
        )

    def _room(self, i: int) -> bool:
        """Give an optional label a place where it is in nobody's way."""
        if self.wanted.a[i] != self.wanted.b[i] and self._turned(i):
            return True
        cost, k = self._best(i)
        if cost < spots.THIN:
            self._put(i, k)
        return cost < spots.THIN

    def _crossed(self) -> list[int]:
        """Labels through which a thin line runs, or which are in doubt; those whose leaders cross lines."""
        crossed: list[int] = ((self.now >= spots.THIN) & (self.now < spots.COVER)).nonzero()[0].tolist()
        return crossed

    def _beside(self, i: int, x: Reals, y: Reals, apart: float = 0.0) -> tuple[Flags, Flags]:
        """Tell, shape (K, L), which labels label i would touch at x, y, and which also stand less than `apart` beside.

        Two letters side by side read as one word.
        """
        w = self.wanted
        wide, high = w.hw + (w.hw[i] + self.gap - spots.SLACK), w.hh + (w.hh[i] + self.gap - spots.SLACK)
        level = abs(y[:, None] - self.now_y) < high
        level &= self.down
        level[:, i] = False
        across = abs(x[:, None] - self.now_x)
        return level & (across < wide), level & (across < wide + apart)

    def _best(self, i: int) -> tuple[float, int]:
        """Return the cost and the number of the best place of label i among the others."""
        touched, close = self._beside(i, self.x[i], self.y[i], APART)
        cost = self.cost[i] + spots.COVER * touched.sum(axis=1)
        cost += spots.CLOSE * close.sum(axis=1)
        k = int(cost.argmin())
        return float(cost[k]), k

    def _put(self, i: int, k: int) -> None:
        self.now_x[i], self.now_y[i], self.now[i] = self.x[i, k], self.y[i, k], self.cost[i, k]
        self.down[i] = True

    def _touching(self, apart: float, slack: float) -> Flags:
        """Tell, shape (L, L), which labels touch one another, or stand less than `apart` beside one another."""
        w = self.wanted
        touch: Flags = abs(self.now_x[:, None] - self.now_x) < w.hw[:, None] + w.hw + self.gap + apart - slack
        touch &= abs(self.now_y[:, None] - self.now_y) < w.hh[:, None] + w.hh + self.gap - slack
        return touch

    def in_trouble(self) -> list[int]:
        """Labels that cover something or touch another label."""
        touch = self._touching(0.0, spots.SLACK) & self.down & self.down[:, None]
        bad = (self.now >= spots.COVER) | (touch.sum(axis=1) > 1)
        labels: list[int] = (bad & self.down).nonzero()[0].tolist()
        return labels

    def _troubled(self, i: int) -> bool:
        """Tell whether label i is in trouble."""
        touched = self._beside(i, self.now_x[i : i + 1], self.now_y[i : i + 1])[0]
        return bool(self.down[i] and (self.now[i] >= spots.COVER or touched.any()))

    def _improve(self, i: int) -> bool:
        cost, k = self._best(i)
        if cost < spots.COVER:
            self._put(i, k)
            return True
        blocked, _ = self._beside(i, self.x[i], self.y[i])
        order = np.argsort(self.cost[i], kind="stable")[:24].tolist()
        return any(self.cost[i, k] < spots.COVER and self._push(i, k, blocked[k].nonzero()[0].tolist()) for k in order)

    def _push(self, i: int, k: int, blockers: list[int]) -> bool:
        if len(blockers) > 3 or not self.leaders.keys().isdisjoint(blockers):
            return False
        before = self.now_x.copy(), self.now_y.copy(), self.now.copy()
        self._put(i, k)
        for j in blockers:
            cost, place = self._best(j)
            if cost >= spots.COVER:
                self.now_x, self.now_y, self.now = before
                return False
            self._put(j, place)
        return True

    def _apart(self, i: int, limit: float, afield: bool, cross: bool) -> bool:
        """Turn label i along its segment, or move it away onto a leader, where that costs less than `limit`.

        Leaders go through what is drawn only where they may `cross` it and there is no other way.
        """
        if self.requests[i].along and self.wanted.a[i] != self.wanted.b[i] and self._turned(i):
            return True
        if any(self._led(i, (far, False), limit) for far in (False, True)[: 1 + afield]):
            return True
        if afield and self._bent(i):
            return True
        return cross and any(self._led(i, (far, True), limit) for far in (False, True))

    def _turned(self, i: int) -> bool:
        """Let label i run along its segment, if it finds room there."""
        (at, e), w = self.scene.along(i), self.wanted
        strokes = Convex.of(at - w.hw[i] * e, at + w.hw[i] * e)
        strokes.radius[:] = w.hh[i]
        clear = (strokes.distance(self.now_x[:, None], self.now_y[:, None], w.hw[:, None], w.hh[:, None]) >= self.gap).T
        clear |= ~self.down
        clear[:, i] = True
        if not (at := at[clear.all(axis=1)]).size:
            return False
        _, laid, radius = self._laid_down()
        line = lines(at - w.hw[i] * e, at + w.hw[i] * e)
        free = (shapely.distance(line[:, None], laid) >= w.hh[i] + radius + self.gap).all(axis=1)
        if not free.any():
            return False
        middle = complex(at[int(free.argmax())])
        self.angles[i] = middle, phase(e)
        self._set_apart(i, complex(FARTHEST * (i + 1)), (middle - w.hw[i] * e, middle + w.hw[i] * e), float(w.hh[i]))
        return True

    def _laid_down(self) -> tuple[Convex, Shapes, Reals]:
        """Return what leaders and labels along their segments take: as areas, as lines, and by their half widths."""
        if self._strokes is None or len(self._strokes[1]) < len(self._laid):
            a, b, radius = np.array(self._laid, dtype=complex).reshape(-1, 3).T
            self._strokes = Convex.of(a, b)._replace(radius=radius.real), lines(a, b), radius.real
        return self._strokes

    def _set_apart(self, i: int, at: complex, stroke: Segment, radius: float) -> None:
        """Note where label i stands; no other label may stand on the stroke that it takes from now on."""
        self.now_x[i], self.now_y[i], self.now[i], self.down[i] = at.real, at.imag, 0.0, True
        self._laid.append((*stroke, radius))
        line, w = Convex.of(*np.array([stroke]).T), self.wanted
        line.radius[:] = radius
        near = line.distance(self.x, self.y, w.hw[:, None], w.hh[:, None])
        self.cost = self.cost + spots.COVER * (near < (self.gap if radius else BAR))
        rows = (~self.down).nonzero()[0]
        pick = self.cost[rows].argmin(axis=1)
        self.now_x[rows], self.now_y[rows] = self.x[rows, pick], self.y[rows, pick]
        self.now[rows] = self.cost[rows, pick]

    def _bent(self, i: int) -> bool:
        """Move label i onto the cheapest leader with a bend that is in nobody's way."""
        leads, cost, starts = self.scene.bent(i)
        if not cost.size:
            return False
        cost = cost + self._in_the_way(i, leads) + self._on_the_way(i, starts, leads[2])
        best = int(cost.argmin())
        if cost[best] >= spots.CROSSING:
            return False
        at, head, knee, e = leads[:, best].tolist()
        end, start = head - e * self.gap / 2, complex(starts[best])
        self.leaders[i] = end, knee, start
        self._set_apart(i, at, (end, knee), 0.0)
        self._set_apart(i, at, (knee, start), 0.0)
        return True

    def _led(self, i: int, way: tuple[bool, bool], limit: float) -> bool:
        """Move label i onto the cheapest leader of a way that is in nobody's way."""
        leads, cost, barred = self.scene.leads(i, *way)
        if not cost.size or cost.min() >= limit or (cost := cost + self._in_the_way(i, leads)).min() >= limit:
            return False
        best = int(cost.argmin())
        at, head, start, e = leads[:, best].tolist()
        leader = head - e * self.gap / 2, start
        self.leaders[i] = leader
        self._set_apart(i, at, leader, 0.0)
        self.now[i] = spots.THIN if barred[best] else 0.0
        return True

    def _in_the_way(self, i: int, leads: Points) -> Reals:
        """Return what it costs that label i on a leader touches others, or the leader runs through or along them."""
        (at, head, start, way), w = leads, self.wanted
        touched, close = self._beside(i, at.real, at.imag, APART)
        laid, _, radius = self._laid_down()
        on = laid.distance(at.real[:, None], at.imag[:, None], w.hw[i], w.hh[i]) < np.where(radius, self.gap, BAR)
        cost = np.where(touched.any(axis=1) | on.any(axis=1), spots.COVER, spots.CLOSE * close.sum(axis=1))
        left = (cost < spots.COVER).nonzero()[0]  # the others are lost already
        cost[left] += self._on_the_way(i, (start + spots.TOUCH * way)[left], head[left])
        return cost

    def _on_the_way(self, i: int, start: Points, head: Points) -> Reals:
        """Return what it costs that parts of leaders of label i run through or along other labels and leaders."""
        (_, older, radius), w = self._laid_down(), self.wanted
        others = self.now_x[:, None], self.now_y[:, None], w.hw[:, None], w.hh[:, None]
        barred = (Convex.of(start, head).distance(*others) < BAR) & self.down[:, None]
        barred[i] = False
        cost: Reals = np.where(barred.any(axis=0), spots.COVER, 0.0)
        left, of = (cost == 0).nonzero()[0], radius > 0
        leaders = lines(start[left], head[left])[:, None]
        cost[left] += spots.COVER * (shapely.distance(leaders, older[of]) < radius[of] + BAR).any(axis=1)
        cost[left] += spots.CROSSING * shapely.crosses(leaders, older[~of]).sum(axis=1)
        return cost
