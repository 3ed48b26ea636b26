"""Where the labels of a view stand: free of everything else, each beside its own node or vector."""

from __future__ import annotations

from cmath import phase, rect
from collections.abc import Callable, Collection, Iterator, Sequence
from copy import copy
from dataclasses import dataclass, field
from functools import cached_property, lru_cache
from itertools import pairwise

import numpy as np
import shapely

from . import spots
from .areas import lines
from .raster import Convex, Flags, Numbers, Points, Reals
from .spots import Obstacles, Request, Segment, Surroundings, Wanted
from .text import Box

APART = 1.4  # mm that should be left between two labels, beyond the gap around each, lest they read as one
NEXT = 2.4  # mm beyond that gap between two on one line, which nearer would read as one word
IN_ROW = 1.3  # of the lower one's height that should be left between two labels on one line
BAR = 1.2  # mm between a label and the leader of another, which nearer would look like a bar over or under it
SOME = 120  # leaders, the cheapest for their own sake, that are looked at
AGAIN = 4  # times that all labels are placed anew when some found no place; the last time leaders may cross lines
BEST = (0, 6, 48)  # places along its segment, from the best one on, that are looked at together
FARTHEST = 1e4  # mm: so far apart labels stand in nobody's way
NOBODY = np.zeros(0, dtype=int)
MOVED = 3  # labels at most that are moved for one
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
        self._boards: dict[tuple[frozenset[str], tuple[int, ...], bool], _Board] = {}
        if requests:
            self._weigh(obstacles, bounds)

    def asking(self, requests: tuple[Request, ...]) -> Scene:
        """Return the scene for `requests` of other sizes, or that may go farther; what is weighed already stays."""
        if requests not in self._asked:
            self._asked[requests] = self._asking(requests)
        return self._asked[requests]

    def _asking(self, requests: tuple[Request, ...]) -> Scene:
        other = copy(self)
        other._asked, other._boards = {}, {}
        other.requests = requests
        if [(r.width, r.height) for r in requests] != [(r.width, r.height) for r in self.requests]:
            other.wanted = self.wanted.sized(requests)
            other._lay_out()
        return other

    def place(self, without: Collection[str] = (), may_cross: bool = True) -> Labels:
        """Find a place for every label but those left out; what these name is still no place for another.

        Leaders cross lines at last, where they may.
        """
        if not self.requests:
            return Labels()
        out, first, cross = frozenset(without), tuple[int, ...](), False
        board = self._board(out, first, cross)
        for again in range(AGAIN):
            failed = board.failed
            if not failed or len(failed) > MANY or not all(self.requests[i].afield for i in failed):
                break
            # who found no place the last time chooses first the next time
            first, cross = (*first, *(i for i in failed if i not in first)), again == AGAIN - 1 or cross
            better = self._board(out, first, cross and may_cross)
            if len(better.failed) < len(failed):
                board = better
            elif cross or not may_cross:
                break
            else:
                cross = True  # no order helps
        return board.labels

    def _board(self, without: frozenset[str], first: tuple[int, ...], cross: bool) -> _Board:
        """Return what comes of an order: whoever leaves the same ones out, or may cross lines, tries it again."""
        key = without, first, cross
        if key not in self._boards:
            self._boards[key] = _Board(self, *key)
        return self._boards[key]

    def _weigh(self, obstacles: Obstacles, bounds: Box | None) -> None:
        self.wanted = Wanted.of(self.requests, obstacles, self.gap)
        self.around = Surroundings(obstacles, self.gap, self.wanted, bounds)
        self._lay_out()

    def _lay_out(self) -> None:
        self.grid = self.around.grid(self.wanted, spots.NEAR)
        (x, y, _), w, about = self.grid, self.wanted, self.gap + APART
        beside = self.gap + np.maximum(APART, 2.0 * IN_ROW * w.hh)
        self.low = x.min(axis=1) - w.hw - beside + 1j * (y.min(axis=1) - w.hh - about)
        self.high = x.max(axis=1) + w.hw + beside + 1j * (y.max(axis=1) + w.hh + about)
        self._leads: dict[tuple[int, bool, bool], tuple[_Ways, Points, Reals, Flags]] = {}
        self._bent: dict[int, tuple[_Ways, Points, Reals, Points]] = {}
        self._along: dict[tuple[int, int, Segment | None], tuple[_Ways, Points, complex]] = {}

    def leads(self, i: int, afield: bool, cross: bool) -> tuple[_Ways, Points, Reals, Flags]:
        """Return leaders of label i whose ends cover nothing, shape (4, K), their costs, and which cross lines.

        They cross nothing, unless they may `cross` lines. They are the same every time that all labels are placed anew.
        """
        key = i, afield, cross
        if key not in self._leads:
            lengths = np.append(spots.FAR, spots.AFIELD) if afield else spots.FAR
            starts, a, b = self._starts(i), complex(self.wanted.a[i]), complex(self.wanted.b[i])
            leads, cost = self.wanted.leads(i, lengths, spots.STEEP, starts)
            if a != b:
                shared = spots.LONE - self.around.alone(np.asarray(a + (b - a) * starts, dtype=complex), a, b)
                cost += np.repeat(spots.SHARED * shared / spots.LONE, len(cost) // len(starts))
            half = float(self.wanted.hw[i]), float(self.wanted.hh[i])
            few = _cheapest(cost, self.around.free(leads[0], *half, afield).nonzero()[0])
            cost[few] += spots.THIN * ~self.around.fine.free(leads[0, few], complex(*half), self.gap / 2)
            few = _cheapest(cost, few)
            clear = slice(None, None, -(-len(few) // SOME) or 1)
            few = few[clear if cross else self.around.barring.clear(leads[:, few], SOME)]
            leads, cost = leads[:, few], cost[few]
            at, head, start, way = leads
            cost += spots.CLOSE * (spots.AWAY - self.around.beside(at, complex(*half), a, b))
            crossings = self.around.crossed(head, start + spots.TOUCH * way)
            few = np.arange(len(cost)) if cross else (crossings == 0).nonzero()[0]
            at, head, start, way = leads = leads[:, few]
            ways = self._ways(i, at, (start + spots.TOUCH * way, head))
            self._leads[key] = ways, leads, (cost + spots.CROSSING * crossings)[few], crossings[few] > 0
        return self._leads[key]

    def bent(self, i: int) -> tuple[_Ways, Points, Reals, Points]:
        """Return leaders of label i with a bend that cross nothing and whose ends cover nothing, as `leads` does.

        Returned are the parts from the bends, shape (4, K), what each costs, and where they start.
        """
        if i not in self._bent:
            around, half = self.around, (float(self.wanted.hw[i]), float(self.wanted.hh[i]))
            (_, knee, start, way), cost = self.wanted.leads(i, spots.KNEES, spots.ROUND_ABOUT, self._starts(i))
            few = _cheapest(cost, (~around.barring.barred(start, knee)).nonzero()[0])
            few = few[:: -(-len(few) // SOME) or 1]  # not only the shortest
            few = few[around.crossed(knee[few], start[few] + spots.TOUCH * way[few]) == 0]
            leads, costs, k = self.wanted.bent(i, knee[few], way[few], cost[few])
            left = _cheapest(costs, around.free(leads[0], *half, True).nonzero()[0])
            left = left[around.barring.clear(leads[:, left], SOME)]
            left = left[around.crossed(leads[1, left], leads[2, left]) == 0]
            (at, head, knee, way), start = leads[:, left], start[few][k[left]]
            ways = self._ways(i, at, (knee + spots.TOUCH * way, head), (start, knee))
            self._bent[i] = ways, leads[:, left], costs[left], start
        return self._bent[i]

    def _starts(self, i: int) -> Reals:
        """Return at which parts of its segment leaders of label i may start: an optional one's runs past its line."""
        return spots.STARTS[spots.STARTS <= 0.5] if self.requests[i].optional else spots.STARTS

    def _ways(self, i: int, at: Points, *parts: tuple[Points, Points]) -> _Ways:
        """Return label i at places on leaders, whose parts have these starts and ends."""
        hw, hh, gap = self.wanted.hw[i], self.wanted.hh[i], self.gap
        sides, leaders = [Convex.of(*part) for part in parts], [lines(*part)[:, None] for part in parts]

        def by_labels(x: Reals, y: Reals, wide: Reals, high: Reals) -> Flags:
            taken: Flags = abs(at.real[:, None] - x) < wide + (hw + gap - spots.SLACK)
            taken &= abs(at.imag[:, None] - y) < high + (hh + gap - spots.SLACK)
            for side in sides:
                taken |= side.distance(x[:, None], y[:, None], wide[:, None], high[:, None]).T < BAR
            return taken

        def by_strokes(a: Points, b: Points, radius: Reals) -> Flags:
            laid, of = Convex.of(a, b)._replace(radius=radius), radius > 0
            taken: Flags = laid.distance(at.real[:, None], at.imag[:, None], hw, hh) < np.where(of, gap, BAR)
            for leader in leaders if of.any() else ():
                taken[:, of] |= shapely.distance(leader, lines(a[of], b[of])) < radius[of] + BAR
            return taken

        return _Ways(np.append(at, parts), hw + gap + APART, hh + gap + APART, by_labels, by_strokes)

    @property
    def shut_in(self) -> int:
        """How many labels have no place beside their own things that covers nothing, whatever the others do."""
        return int((self.grid.cost.min(axis=1) >= spots.COVER).sum()) if self.requests else 0

    def struck(self, boxes: Sequence[Box]) -> list[bool]:
        """Tell which boxes thin strokes run through."""
        return self.around.struck(boxes) if self.requests else [False] * len(boxes)

    def along(self, i: int, other: Segment | None) -> Iterator[tuple[_Ways, Points, complex]]:
        """Go through places where label i may run along its segment, the best few first, and its direction there.

        Or along the `other` segment of its line.
        """
        for begin, end in pairwise(BEST):
            if (i, begin, other) not in self._along:
                wanted = self.wanted.at(i, *other) if other else self.wanted
                at, e, _ = wanted.turned(i)
                at = at[begin:end]
                at = at[self.around.along(wanted, i, at, e)]
                self._along[i, begin, other] = self._turned(i, at, e), at, e
            yield self._along[i, begin, other]

    def _turned(self, i: int, at: Points, e: complex) -> _Ways:
        """Return label i at places along its segment, in the direction `e`: there it is a stroke as wide as itself."""
        start, end, half = at - self.wanted.hw[i] * e, at + self.wanted.hw[i] * e, self.wanted.hh[i]
        gap = self.gap + APART * self.requests[i].optional
        strokes, line = Convex.of(start, end), lines(start, end)[:, None]
        strokes.radius[:] = half

        def by_labels(x: Reals, y: Reals, wide: Reals, high: Reals) -> Flags:
            taken: Flags = (strokes.distance(x[:, None], y[:, None], wide[:, None], high[:, None]) < gap).T
            return taken

        def by_strokes(a: Points, b: Points, radius: Reals) -> Flags:
            taken: Flags = shapely.distance(line, lines(a, b)) < half + radius + gap
            return taken

        return _Ways(np.append(start, end), half + gap, half + gap, by_labels, by_strokes)


def _cheapest(costs: Reals, few: Numbers) -> Numbers:
    """Return a few, by number, the cheapest first; of two that cost the same the first one stays before the other."""
    return few[np.argsort(costs[few], kind="stable")]


class _Ways:
    """Some places of a label, and which of them others take: all are placed anew many times, most where they stood."""

    def __init__(
        self,
        points: Points,
        wide: float,
        high: float,
        by_labels: Callable[[Reals, Reals, Reals, Reals], Flags],
        by_strokes: Callable[[Points, Points, Reals], Flags],
    ) -> None:
        if points.size:  # whoever stands farther away than that from all of them takes none
            x, y, about = points.real, points.imag, complex(wide, high)
            self.low, self.high = complex(x.min(), y.min()) - about, complex(x.max(), y.max()) + about
        self.by_labels, self.by_strokes = by_labels, by_strokes
        self._taken: dict[tuple[complex, ...], int] = {}  # a bit for each place, by what takes it

    def left(self, labels: Sequence[tuple[float, ...]], strokes: Sequence[tuple[complex, ...]], count: int) -> Numbers:
        """Return which of `count` places labels, by middles and half sizes, and strokes leave free."""
        taken = 0
        for every, of in ((labels, self.by_labels), (strokes, self.by_strokes)):
            new = [one for one in every if one not in self._taken]
            if new:
                flags = np.packbits(of(*map(np.array, zip(*new, strict=True))), axis=0, bitorder="little")
                for one, bits in zip(new, flags.T, strict=True):
                    self._taken[one] = int.from_bytes(bits.tobytes(), "little")
            for one in every:
                taken |= self._taken[one]
        bits = np.frombuffer(taken.to_bytes(-(-count // 8), "little"), dtype=np.uint8)
        free: Numbers = (np.unpackbits(bits, count=count, bitorder="little") == 0).nonzero()[0]
        return free


class _Board:
    """The places taken so far; it is changed in place while labels are tried and moved.

    Those of `first` are placed before the others and as far away as they must, on leaders that may `cross` lines; some
    are `without` a place.
    """

    def __init__(self, scene: Scene, without: Collection[str], first: Sequence[int], cross: bool = False) -> None:
        self.scene, self.requests, self.wanted, self.gap = scene, scene.requests, scene.wanted, scene.gap
        self.x, self.y, self.cost = scene.grid._replace(cost=scene.grid.cost.copy())
        rows = np.arange(len(self.x))
        self.open: Flags = np.any(
            self.cost < spots.COVER, axis=1
        )  # who has a place that covers nothing, without the others
        pick = self.cost.argmin(axis=1)
        self.now_x, self.now_y, self.now = (column[rows, pick] for column in scene.grid)
        self.down = np.zeros(len(self.x), dtype=bool)
        self.leaders: dict[int, tuple[complex, ...]] = {}
        self.angles: dict[int, tuple[complex, float]] = {}  # middles and directions of labels along their segments
        self._laid: list[tuple[complex, complex, float]] = []  # what these and leaders take: strokes, their half widths
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
        self.down |= self._close().sum(axis=1) == 1
        free, rest = (self.cost < spots.COVER).sum(axis=1), (~self.down).nonzero()[0]
        for i in rest[np.lexsort((rest, free[rest], -self.wanted.priority[rest]))].tolist():
            self._put(i, self._best(i)[1])
        for _ in range(ROUNDS):  # give each label in trouble a place by moving those that block it
            if not [i for i in self.in_trouble() if self._improve(i)]:
                break
        # who reads as one with another chose before that one, and chooses again
        for i in self._read_as_one():
            cost, k = self._best(i)
            if cost < self._here(i):
                self._put(i, k)
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
        for i in self._read_as_one():
            if self._here(i) > spots.ONE:  # the other one may have gone
                self._led(i, (False, False), self._here(i))
        self.failed = self.in_trouble()
        if not self._optional:
            self.cost = scene.grid.cost  # nobody is placed any more: orders are many, and are kept

    @cached_property
    def labels(self) -> Labels:
        """Where all stand, and who of them does not stand well; optional ones are placed last."""
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
        if cost < spots.ONE:
            self._put(i, k)
            return True
        other = None if self.failed else self.requests[i].other  # this order is hardly the last one
        return bool(other) and (self._turned(i, other) or self._led(i, (False, False), spots.CROSSING) or self._bent(i))

    def _crossed(self) -> list[int]:
        """Labels through which a thin line runs, or which are in doubt; those whose leaders cross lines."""
        crossed: list[int] = ((self.now >= spots.THIN) & (self.now < spots.COVER)).nonzero()[0].tolist()
        return crossed

    def _near(self, i: int, low: complex, high: complex) -> Numbers:
        """Return the labels, but for label i, that reach into the box between two corners: those that are looked at."""
        w = self.wanted
        near = abs(self.now_x - 0.5 * (low.real + high.real)) <= w.hw + 0.5 * (high.real - low.real)
        near &= abs(self.now_y - 0.5 * (low.imag + high.imag)) <= w.hh + 0.5 * (high.imag - low.imag)
        near &= self.down
        near[i] = False
        labels: Numbers = near.nonzero()[0]
        return labels

    def _beside(self, i: int, x: Reals, y: Reals, near: Numbers) -> tuple[Flags, Reals]:
        """Tell, shape (K, N), which of the labels `near` label i would touch at x, y, and what others cost, shape (K,).

        Two letters side by side read as one word, one over another as a fraction.
        """
        w = self.wanted
        wide, high = w.hw[near] + (w.hw[i] + self.gap - spots.SLACK), w.hh[near] + (w.hh[i] + self.gap - spots.SLACK)
        across, up = abs(x[:, None] - self.now_x[near]), abs(y[:, None] - self.now_y[near])
        over = (across < np.maximum(w.hw[near], w.hw[i])) & (up < high + APART)
        low = np.minimum(w.hh[near], w.hh[i])
        level = up < low
        close = (up < high) & (across < wide + APART) | level & (across < wide + NEXT) | over
        row = level & (across < wide + 2.0 * IN_ROW * low)
        cost: Reals = np.where(close, spots.ONE, spots.ROW * row).sum(axis=1)
        return (up < high) & (across < wide), cost

    def _among(self, i: int) -> tuple[Reals, Flags, Numbers]:
        """Return what places of label i cost among the others, which of these it would touch there, who they are."""
        near = self._near(i, self.scene.low[i], self.scene.high[i])
        if not near.size:
            return self.cost[i], np.zeros((len(self.cost[i]), 0), dtype=bool), near
        touched, close = self._beside(i, self.x[i], self.y[i], near)
        return self.cost[i] + spots.COVER * touched.sum(axis=1) + close, touched, near

    def _best(self, i: int) -> tuple[float, int]:
        """Return the cost and the number of the best place of label i among the others."""
        cost = self._among(i)[0]
        k = int(cost.argmin())
        return float(cost[k]), k

    def _read_as_one(self) -> list[int]:
        """Labels that stand close to another one, but for those set apart."""
        close = self._close() & self.down & self.down[:, None]
        labels: list[int] = (close.sum(axis=1) > 1).nonzero()[0].tolist()
        return [i for i in labels if i not in self.leaders and i not in self.angles]

    def _here(self, i: int) -> float:
        """Return what it costs label i among the others to stay where it is."""
        own, near = slice(i, i + 1), self._near(i, self.scene.low[i], self.scene.high[i])
        touched, close = self._beside(i, self.now_x[own], self.now_y[own], near)
        return float(self.now[i] + spots.COVER * touched.sum() + close.sum()) - spots.SLACK

    def _put(self, i: int, k: int) -> None:
        self.now_x[i], self.now_y[i], self.now[i] = self.x[i, k], self.y[i, k], self.cost[i, k]
        self.down[i] = True

    def _touching(self, apart: float, slack: float) -> Flags:
        """Tell, shape (L, L), which labels touch one another, or stand less than `apart` beside one another."""
        w = self.wanted
        touch: Flags = abs(self.now_x[:, None] - self.now_x) < w.hw[:, None] + w.hw + self.gap + apart - slack
        touch &= abs(self.now_y[:, None] - self.now_y) < w.hh[:, None] + w.hh + self.gap + apart - slack
        return touch

    def _close(self) -> Flags:
        """Tell, shape (L, L), which labels may be read as one: close to one another, or in a row."""
        w = self.wanted
        low = np.minimum(w.hh[:, None], w.hh)
        row: Flags = abs(self.now_x[:, None] - self.now_x) < w.hw[:, None] + w.hw + self.gap + 2.0 * IN_ROW * low
        row &= abs(self.now_y[:, None] - self.now_y) < low
        row |= self._touching(APART, 0.0)
        return row

    def in_trouble(self) -> list[int]:
        """Labels that cover something or touch another label."""
        touch = self._touching(0.0, spots.SLACK) & self.down & self.down[:, None]
        bad = (self.now >= spots.COVER) | (touch.sum(axis=1) > 1)
        labels: list[int] = (bad & self.down).nonzero()[0].tolist()
        return labels

    def _troubled(self, i: int) -> bool:
        """Tell whether label i is in trouble."""
        own, w = slice(i, i + 1), self.wanted
        at, reach = complex(self.now_x[i], self.now_y[i]), complex(w.hw[i] + self.gap, w.hh[i] + self.gap)
        touched, _ = self._beside(i, self.now_x[own], self.now_y[own], self._near(i, at - reach, at + reach))
        return bool(self.down[i] and (self.now[i] >= spots.COVER or touched.any()))

    def _improve(self, i: int) -> bool:
        if not self.open[i]:
            return False
        cost, blocked, near = self._among(i)
        k = int(cost.argmin())
        if cost[k] < spots.COVER:
            self._put(i, k)
            return True
        own, few = self.cost[i], blocked.sum(axis=1) <= MOVED
        order = [k for k in np.argsort(own, kind="stable")[:24].tolist() if own[k] < spots.COVER and few[k]]
        return any(self._push(i, k, near[blocked[k]].tolist()) for k in order)

    def _push(self, i: int, k: int, blockers: list[int]) -> bool:
        if not self.open[blockers].all() or not self.leaders.keys().isdisjoint(blockers):
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

    def _turned(self, i: int, other: Segment | None = None) -> bool:
        """Let label i run along its segment, or the `other` one of its line, if it finds room there."""
        for ways, at, e in self.scene.along(i, other):
            free, _ = self._free(i, ways, len(at))
            if free.size:
                middle, half = complex(at[free[0]]), complex(self.wanted.hw[i] * e)
                self.angles[i] = middle, phase(e)
                stroke, high = (middle - half, middle + half), float(self.wanted.hh[i])
                self._set_apart(i, complex(FARTHEST * (i + 1)), stroke, high)
                return True
        return False

    def _free(self, i: int, ways: _Ways, count: int) -> tuple[Numbers, Numbers]:
        """Return which of `count` places of label i no other label and no leader takes, and the labels near them."""
        if not count:
            return NOBODY, NOBODY
        near, w = self._near(i, ways.low, ways.high), self.wanted
        labels = zip(*(column[near].tolist() for column in (self.now_x, self.now_y, w.hw, w.hh)), strict=True)
        return ways.left([*labels], self._laid, count), near

    def _set_apart(self, i: int, at: complex, stroke: Segment, radius: float) -> None:
        """Note where label i stands; no other label may stand on the stroke that it takes from now on."""
        self.now_x[i], self.now_y[i], self.now[i], self.down[i] = at.real, at.imag, 0.0, True
        self._laid.append((*stroke, radius))
        line, w = Convex.of(*np.array([stroke]).T), self.wanted
        line.radius[:] = radius
        (a, b), (low, high), reach = stroke, (self.scene.low, self.scene.high), max(radius, BAR)
        rows = (low.real <= max(a.real, b.real) + reach) & (high.real >= min(a.real, b.real) - reach)
        rows &= (low.imag <= max(a.imag, b.imag) + reach) & (high.imag >= min(a.imag, b.imag) - reach)
        rows = rows.nonzero()[0]  # of labels that may stand there
        near = line.distance(self.x[rows], self.y[rows], w.hw[rows, None], w.hh[rows, None])
        self.cost[rows] += spots.COVER * (near < (self.gap if radius else BAR))
        self.open[rows] = (self.cost[rows] < spots.COVER).any(axis=1)
        rows = rows[~self.down[rows]]
        pick = self.cost[rows].argmin(axis=1)
        self.now_x[rows], self.now_y[rows] = self.x[rows, pick], self.y[rows, pick]
        self.now[rows] = self.cost[rows, pick]

    def _bent(self, i: int) -> bool:
        """Move label i onto the cheapest leader with a bend that is in nobody's way."""
        ways, leads, cost, starts = self.scene.bent(i)
        free, near = self._free(i, ways, len(cost))
        if not free.size:
            return False
        leads, starts = leads[:, free], starts[free]
        cost = cost[free] + self._in_the_way(i, leads, near) + self._across(starts, leads[2])
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
        ways, leads, cost, barred = self.scene.leads(i, *way)
        free, near = self._free(i, ways, len(cost))
        if not free.size:
            return False
        leads = leads[:, free]
        cost = cost[free] + self._in_the_way(i, leads, near)
        best = int(cost.argmin())
        if cost[best] >= limit:
            return False
        at, head, start, e = leads[:, best].tolist()
        leader = head - e * self.gap / 2, start
        self.leaders[i] = leader
        self._set_apart(i, at, leader, 0.0)
        self.now[i] = spots.THIN if barred[free[best]] else 0.0
        return True

    def _in_the_way(self, i: int, leads: Points, near: Numbers) -> Reals:
        """Return what it costs that label i stands on leaders close to others `near`, or these cross other leaders."""
        at, head, start, way = leads
        _, close = self._beside(i, at.real, at.imag, near)
        return close + self._across(start + spots.TOUCH * way, head)

    def _across(self, start: Points, head: Points) -> Reals:
        """Return what it costs that leaders, or parts of them, cross other leaders."""
        if not (laid := [(a, b) for a, b, radius in self._laid if radius == 0.0]):
            return np.zeros(len(start))
        across = shapely.crosses(lines(start, head)[:, None], lines(*np.array(laid).T)).sum(axis=1)
        cost: Reals = spots.CROSSING * across
        return cost
