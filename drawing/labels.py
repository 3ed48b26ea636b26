"""Where the labels of a view stand: free of everything else, each beside its own node or vector."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
import shapely

from . import spots
from .areas import lines
from .spots import Convex, Flags, Grid, Obstacles, Points, Reals, Request, Segment, Surroundings, Wanted
from .text import Box

APART = 1.4  # mm that should be left between two labels side by side, beyond the gap around each
SOME = 300  # places on a leader, the cheapest for their own sake, that are looked at
AGAIN = 4  # times that all labels are placed anew when some found no place
ROUNDS = 3  # times that labels in trouble are looked through
MANY = 24  # of these, for whom no order helps: the drawing is crowded


@dataclass(frozen=True, slots=True)
class Labels:
    """Lower left corners by name, leaders (from label to anchor) of those set apart, and who covers something.

    `crossed` are those through which a thin line runs, or which stand nearer to another thing than they should.
    """

    corners: dict[str, complex] = field(default_factory=dict)
    leaders: dict[str, Segment] = field(default_factory=dict)
    failed: tuple[str, ...] = ()
    crossed: tuple[str, ...] = ()


def place(requests: Sequence[Request], obstacles: Obstacles, gap: float = 0.6, bounds: Box | None = None) -> Labels:
    """Find a place for every label, the same places for the same input; their names differ.

    They cover none of the `obstacles`, have an empty distance of `gap` mm around them, and stay inside of the `bounds`
    if there is a place for all there. Every request has a corner; `failed` names those that cover something none the
    less.
    """
    if len({request.name for request in requests}) != len(requests):
        raise ValueError("two labels have one name")
    if not requests:
        return Labels()
    scene = _Scene(requests, obstacles, max(gap, 0.01), bounds)
    best, first = _Board(scene, ()).labels(), tuple[int, ...]()
    for _ in range(AGAIN):
        failed = [i for i, request in enumerate(requests) if request.name in best.failed]
        if len(failed) > MANY or not any(requests[i].afield for i in failed):
            break
        # who found no place the last time chooses first the next time
        first = (*first, *(i for i in failed if i not in first))
        best = min(best, _Board(scene, first).labels(), key=lambda labels: len(labels.failed))
    return best


class _Scene:
    """What is to be lettered, all that is in the way, and the places weighed so far."""

    def __init__(self, requests: Sequence[Request], obstacles: Obstacles, gap: float, bounds: Box | None) -> None:
        self.requests, self.gap = requests, gap
        self.wanted = Wanted.of(requests, obstacles, gap)
        self.around = Surroundings(obstacles, gap, self.wanted, bounds)
        self.grid = self.around.grid(self.wanted, spots.NEAR)
        self._apart: dict[tuple[int, float | None, tuple[float, ...]], tuple[Wanted, Grid]] = {}

    def apart(self, i: int, share: float | None, steps: tuple[float, ...]) -> tuple[Wanted, Grid]:
        """Return label i, which names its anchor or the point at a share of it, and its places on leaders, shape (K,).

        They are the same every time that all labels are placed anew.
        """
        key = i, share, steps
        if key not in self._apart:
            one = Wanted._make(column[[i]] for column in self.wanted)
            if share is not None:
                node = one.a + (one.b - one.a) * share
                one = one._replace(a=node, b=node)
            grid = self.around.grid(one, steps, led=True)
            order = np.argsort(grid.cost[0], kind="stable")[:SOME]
            self._apart[key] = one, Grid._make(column[0][order] for column in grid)
        return self._apart[key]


class _Board:
    """The places taken so far; it is changed in place while labels are tried and moved.

    Those of `first` are placed before the others and as far away as they must.
    """

    def __init__(self, scene: _Scene, first: Sequence[int]) -> None:
        self.scene, self.requests, self.wanted, self.gap = scene, scene.requests, scene.wanted, scene.gap
        self.x, self.y, self.cost = scene.grid
        rows = np.arange(len(self.x))
        pick = self.cost.argmin(axis=1)
        self.now_x, self.now_y, self.now = (column[rows, pick] for column in scene.grid)
        self.down = np.zeros(len(self.x), dtype=bool)
        self.leaders: dict[int, Segment] = {}
        for i in first:
            cost, k = self._best(i)
            if cost < spots.COVER or not self._lead(i, spots.COVER, afield=self.requests[i].afield):
                self._put(i, k)
        # leave alone who is in nobody's way; then the most constrained label chooses first
        self.down |= self._touching(APART, 0.0).sum(axis=1) == 1
        free, rest = (self.cost < spots.COVER).sum(axis=1), (~self.down).nonzero()[0]
        for i in rest[np.lexsort((rest, free[rest], -self.wanted.priority[rest]))].tolist():
            self._put(i, self._best(i)[1])
        for _ in range(ROUNDS):  # give each label in trouble a place by moving those that block it
            if not [i for i in self._in_trouble() if self._improve(i)]:
                break
        # set apart, on leaders, who found no free place or whom a thin line would run through, but for those that find
        # no free place there either; of two labels that touch one may stay: the less important is taken up first
        bad = self._in_trouble()
        bad.sort(key=lambda i: (self.requests[i].priority, self.now[i] < spots.COVER, i))
        for i, limit in [*((i, spots.COVER) for i in bad), *((i, spots.THIN) for i in self._crossed() if i not in bad)]:
            if limit == spots.THIN or i in self._in_trouble():
                self._lead(i, limit, afield=bool(first) and limit == spots.COVER and self.requests[i].afield)

    def labels(self) -> Labels:
        """Return where all stand, and who of them does not stand well."""
        names, w = [request.name for request in self.requests], self.wanted
        corners = (self.now_x - w.hw) + 1j * (self.now_y - w.hh)
        return Labels(
            dict(zip(names, corners.tolist(), strict=True)),
            {names[i]: leader for i, leader in sorted(self.leaders.items())},
            tuple(names[i] for i in self._in_trouble()),
            tuple(names[i] for i in self._crossed()),
        )

    def _crossed(self) -> list[int]:
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

    def _in_trouble(self) -> list[int]:
        """Labels that cover something or touch another label."""
        touch = self._touching(0.0, spots.SLACK) & self.down & self.down[:, None]
        bad = (self.now >= spots.COVER) | (touch.sum(axis=1) > 1)
        labels: list[int] = (bad & self.down).nonzero()[0].tolist()
        return labels

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

    def _lead(self, i: int, limit: float, afield: bool) -> bool:
        """Move label i away onto a leader, if there is a place for both that costs less than `limit`."""
        # beside a line a leader leaves along its normal; where that is barred, from a point of it to any side
        shares: tuple[float | None, ...] = (None,) if self.wanted.a[i] == self.wanted.b[i] else (None, 0.5, 0.25, 0.75)
        ways = [(share, spots.FAR) for share in shares] + [(None, ())] * afield
        return any(self._led(i, *self.scene.apart(i, share, steps), limit) for share, steps in ways)

    def _led(self, i: int, one: Wanted, grid: Grid, limit: float) -> bool:
        leads, cost = self._leads(i, one, grid, limit)
        if not cost.size or (cost := cost + self._in_the_way(i, leads)).min() >= limit:
            return False
        at, head, start, way = leads[:, int(cost.argmin())].tolist()
        self.now_x[i], self.now_y[i], self.now[i] = at.real, at.imag, 0.0
        self.down[i], self.leaders[i] = True, (head - way * self.gap / 2, start)
        # no other label may stand on the leader from now on
        line, w = Convex.of(*np.array([self.leaders[i]]).T), self.wanted
        self.cost = self.cost + spots.COVER * (line.distance(self.x, self.y, w.hw[:, None], w.hh[:, None]) < self.gap)
        rows = (~self.down).nonzero()[0]
        pick = self.cost[rows].argmin(axis=1)
        self.now_x[rows], self.now_y[rows] = self.x[rows, pick], self.y[rows, pick]
        self.now[rows] = self.cost[rows, pick]
        return True

    def _leads(self, i: int, one: Wanted, grid: Grid, limit: float) -> tuple[Points, Reals]:
        """Return places of label i on leaders that cost less than `limit`, shape (4, K), and their costs, shape (K,).

        The four are the middle of the label, head and start of its leader, and the way from the start to the head.
        """
        few = grid.cost < limit
        x, y, cost = (column[few] for column in grid)
        cost = cost + spots.COVER * self._beside(i, x, y)[0].sum(axis=1)
        foot = one.feet(x + 1j * y)
        head = np.clip(foot.real, x - one.hw, x + one.hw) + 1j * np.clip(foot.imag, y - one.hh, y + one.hh)
        far = abs(head - foot)
        way = (head - foot) / np.where(far > spots.TOUCH, far, 1.0)
        cost[far < spots.FAR[0] - 1.0] += spots.COVER
        leads, few = np.array([x + 1j * y, head, foot + way * one.rim[0], way]), cost < limit
        return leads[:, few], cost[few]

    def _in_the_way(self, i: int, leads: Points) -> Reals:
        """Return what it costs that leaders of label i run through other labels, cross what is drawn or run along it.

        None may run through a label, and label i not stand on older leaders.
        """
        (at, head, start, way), w = leads, self.wanted
        start = start + spots.TOUCH * way
        others = self.now_x[:, None], self.now_y[:, None], w.hw[:, None], w.hh[:, None]
        touched = (Convex.of(start, head).distance(*others) < self.gap / 2) & self.down[:, None]
        touched[i] = False
        older = np.array(list(self.leaders.values()), dtype=complex).reshape(-1, 2).T
        on = Convex.of(*older).distance(at.real[:, None], at.imag[:, None], w.hw[i], w.hh[i]) < self.gap
        crossed = shapely.crosses(lines(start, head)[:, None], lines(*older)).sum(axis=1)
        crossed = crossed + self.scene.around.crossed(head, start)
        return np.asarray(spots.COVER * (touched.sum(axis=0) + on.sum(axis=1)) + spots.CROSSING * crossed)
