"""Where the labels of a view stand: free of everything else, each beside its own node or vector."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from .spots import (
    APART,
    CLOSE,
    COVER,
    CROSSING,
    FAR,
    NEAR,
    SLACK,
    THIN,
    TOUCH,
    Bodies,
    Box,
    Flags,
    Grid,
    Obstacles,
    Points,
    Reals,
    Request,
    Segment,
    Wanted,
    circle_table,
    crossings,
    overlaps,
)

SOME = 300  # places on a leader, the cheapest for their own sake, that are looked at
AGAIN = 4  # times that all labels are placed anew when some found no place
ROUNDS = 3  # times that labels in trouble are looked through
MANY = 24  # of these, for whom no order helps: the drawing is crowded

__all__ = ["Labels", "Obstacles", "Request", "place"]


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
    wanted = Wanted.of(requests, circle_table(obstacles.circles), max(gap, 0.01))
    scene = _Scene(requests, wanted, Bodies.of(obstacles, wanted.a, wanted.b), bounds)
    grid = Grid.around(wanted, scene.bodies, NEAR, bounds)
    best, first = scene.placed(grid, ()), tuple[int, ...]()
    for _ in range(AGAIN):
        failed = [i for i, request in enumerate(requests) if request.name in best.failed]
        if len(failed) > MANY or not any(requests[i].afield for i in failed):
            break
        # who found no place the last time chooses first the next time
        first = (*first, *(i for i in failed if i not in first))
        other = scene.placed(grid, first)
        best = min(best, other, key=lambda labels: len(labels.failed))
    return best


class _Board:
    """The places taken so far; it is changed in place while labels are tried and moved."""

    def __init__(self, wanted: Wanted, grid: Grid) -> None:
        self.wanted, self.x, self.y, self.cost = wanted, grid.x, grid.y, grid.cost
        rows = np.arange(len(self.x))
        pick = self.cost.argmin(axis=1)
        self.now_x, self.now_y, self.now = self.x[rows, pick], self.y[rows, pick], self.cost[rows, pick]
        self.down = np.zeros(len(self.x), dtype=bool)
        self.leaders: dict[int, Segment] = {}

    def beside(self, i: int, x: Reals, y: Reals, apart: float = 0.0) -> tuple[Flags, Flags]:
        """Tell, shape (K, L), which labels label i would touch at x, y, and which also stand less than `apart` beside.

        Two letters side by side read as one word.
        """
        w = self.wanted
        wide, high = w.hw + (w.hw[i] + w.gap - SLACK), w.hh + (w.hh[i] + w.gap - SLACK)
        level = abs(y[:, None] - self.now_y) < high
        level &= self.down
        level[:, i] = False
        across = abs(x[:, None] - self.now_x)
        return level & (across < wide), level & (across < wide + apart)

    def best(self, i: int) -> tuple[float, int]:
        """Return the cost and the number of the best place of label i among the others."""
        touched, close = self.beside(i, self.x[i], self.y[i], APART)
        cost = self.cost[i] + COVER * touched.sum(axis=1)
        cost += CLOSE * close.sum(axis=1)
        k = int(cost.argmin())
        return float(cost[k]), k

    def put(self, i: int, k: int) -> None:
        self.now_x[i], self.now_y[i], self.now[i] = self.x[i, k], self.y[i, k], self.cost[i, k]
        self.down[i] = True

    def set_apart(self, i: int, at: complex, leader: Segment) -> None:
        """Put label i on a leader, on which no other label may stand from now on."""
        w = self.wanted
        self.now_x[i], self.now_y[i], self.now[i] = at.real, at.imag, 0.0
        self.down[i], self.leaders[i] = True, leader
        line = Bodies.strokes(*np.array([leader]).T)
        on = line.distance(self.x, self.y, w.hw[:, None], w.hh[:, None], slice(None)) < w.gap
        self.cost = self.cost + COVER * on
        rows = (~self.down).nonzero()[0]
        pick = self.cost[rows].argmin(axis=1)
        self.now_x[rows], self.now_y[rows] = self.x[rows, pick], self.y[rows, pick]
        self.now[rows] = self.cost[rows, pick]

    def settle(self) -> None:
        """Leave alone who is in nobody's way; then the most constrained label chooses first."""
        self.down |= self._touching(APART, 0.0).sum(axis=1) == 1
        free = (self.cost < COVER).sum(axis=1)
        rest = (~self.down).nonzero()[0]
        for i in rest[np.lexsort((rest, free[rest], -self.wanted.priority[rest]))].tolist():
            self.put(i, self.best(i)[1])

    def _touching(self, apart: float, slack: float) -> Flags:
        """Tell, shape (L, L), which labels touch one another, or stand less than `apart` beside one another."""
        w = self.wanted
        touch: Flags = abs(self.now_x[:, None] - self.now_x) < w.hw[:, None] + w.hw + w.gap + apart - slack
        touch &= abs(self.now_y[:, None] - self.now_y) < w.hh[:, None] + w.hh + w.gap - slack
        return touch

    def in_trouble(self) -> list[int]:
        """Labels that cover something or touch another label."""
        touch = self._touching(0.0, SLACK) & self.down & self.down[:, None]
        bad = (self.now >= COVER) | (touch.sum(axis=1) > 1)
        found: list[int] = (bad & self.down).nonzero()[0].tolist()
        return found

    def repair(self) -> None:
        """Give each label in trouble a place by moving those that block it."""
        for _ in range(ROUNDS):
            if not [i for i in self.in_trouble() if self._improve(i)]:
                return

    def _improve(self, i: int) -> bool:
        cost, k = self.best(i)
        if cost < COVER:
            self.put(i, k)
            return True
        blocked, _ = self.beside(i, self.x[i], self.y[i])
        order = np.argsort(self.cost[i], kind="stable")[:24].tolist()
        return any(self.cost[i, k] < COVER and self._push(i, k, blocked[k].nonzero()[0].tolist()) for k in order)

    def _push(self, i: int, k: int, blockers: list[int]) -> bool:
        if len(blockers) > 3 or not self.leaders.keys().isdisjoint(blockers):
            return False
        before = self.now_x.copy(), self.now_y.copy(), self.now.copy()
        self.put(i, k)
        for j in blockers:
            cost, place = self.best(j)
            if cost >= COVER:
                self.now_x, self.now_y, self.now = before
                return False
            self.put(j, place)
        return True


@dataclass(frozen=True, slots=True, eq=False)
class _Scene:
    """What is to be lettered, and all that is in the way."""

    requests: Sequence[Request]
    wanted: Wanted
    bodies: Bodies
    bounds: Box | None
    apart: dict[tuple[int, float | None, tuple[float, ...]], tuple[Wanted, Grid]] = field(default_factory=dict)

    def placed(self, grid: Grid, first: Sequence[int]) -> Labels:
        """Place all labels, those of `first` before the others and as far away as they must."""
        board = _Board(self.wanted, grid)
        for i in first:
            cost, k = board.best(i)
            if cost < COVER or not self._lead(i, board, COVER, afield=self.requests[i].afield):
                board.put(i, k)
        board.settle()
        board.repair()
        self._set_apart(board, first)
        return Labels(
            {
                r.name: complex(x - r.width / 2, y - r.height / 2)
                for r, x, y in zip(self.requests, board.now_x.tolist(), board.now_y.tolist(), strict=True)
            },
            {self.requests[i].name: leader for i, leader in sorted(board.leaders.items())},
            tuple(self.requests[i].name for i in board.in_trouble()),
            tuple(self.requests[i].name for i in ((board.now >= THIN) & (board.now < COVER)).nonzero()[0].tolist()),
        )

    def _set_apart(self, board: _Board, first: Sequence[int]) -> None:
        """Set apart, on leaders, the labels that found no free place or that a thin line would run through.

        Those that find no free place there either are given up.
        """
        bad = board.in_trouble()
        # Of two labels that touch, one may stay: take them up one by one, the less important first.
        bad.sort(key=lambda i: (self.requests[i].priority, board.now[i] < COVER, i))
        crossed = ((board.now >= THIN) & (board.now < COVER)).nonzero()[0].tolist()
        for i, limit in [*((i, COVER) for i in bad), *((i, THIN) for i in crossed if i not in bad)]:
            if limit == THIN or i in board.in_trouble():
                self._lead(i, board, limit, afield=bool(first) and limit == COVER and self.requests[i].afield)

    def _lead(self, i: int, board: _Board, limit: float, afield: bool) -> bool:
        """Move label i away onto a leader, if there is a place for both that costs less than `limit`."""
        # beside a line a leader leaves along its normal; where that is barred, from a point of it to any side
        shares: tuple[float | None, ...] = (None,) if self.wanted.a[i] == self.wanted.b[i] else (None, 0.5, 0.25, 0.75)
        ways = [(share, FAR) for share in shares] + [(None, ())] * afield
        return any(self._led(i, *self._places(i, share, steps), board, limit) for share, steps in ways)

    def _places(self, i: int, share: float | None, steps: tuple[float, ...]) -> tuple[Wanted, Grid]:
        """Return label i, which names its anchor or a point of it, and its places on leaders, shape (K,).

        They are the same every time that all labels are placed anew.
        """
        key = i, share, steps
        if key not in self.apart:
            one = self.wanted.some(np.array([i]))
            one = one if share is None else one.at(share)
            # what goes far afield may even leave the bounds
            grid = Grid.around(one, self.bodies, steps, self.bounds if steps else None, led=True)
            order = np.argsort(grid.cost[0], kind="stable")[:SOME]
            self.apart[key] = one, Grid(grid.x[0][order], grid.y[0][order], grid.cost[0][order])
        return self.apart[key]

    def _led(self, i: int, one: Wanted, grid: Grid, board: _Board, limit: float) -> bool:
        leads, cost = _leads(i, one, grid, board, limit)
        for price in (self._on_labels, self._on_leaders, self._on_bodies):
            cost = cost + price(i, one, leads, board)
            few = cost < limit  # what follows only adds to the cost
            if not few.any():
                return False
            leads, cost = leads[:, few], cost[few]
        at, head, start, way = leads[:, int(cost.argmin())].tolist()
        board.set_apart(i, at, (head - way * one.gap / 2, start))
        return True

    def _on_labels(self, i: int, one: Wanted, leads: Points, board: _Board) -> Reals:
        """Return what it costs that leaders of label i run through other labels: none may."""
        w = self.wanted
        others = board.now_x[:, None], board.now_y[:, None], w.hw[:, None], w.hh[:, None]
        touched = _lines(leads).distance(*others, slice(None)) < w.gap / 2
        touched &= board.down[:, None]
        touched[i] = False
        result: Reals = COVER * touched.sum(axis=0)
        return result

    def _on_leaders(self, i: int, one: Wanted, leads: Points, board: _Board) -> Reals:
        """Return what it costs that label i stands on older leaders, or its own crosses them."""
        if not board.leaders:
            return np.zeros(leads.shape[1])
        old = Bodies.strokes(*np.array(list(board.leaders.values())).T)
        x, y = leads[0].real[:, None], leads[0].imag[:, None]
        on = old.distance(x, y, one.hw, one.hh, slice(None)) < one.gap
        result: Reals = COVER * on.sum(axis=1) + CROSSING * crossings(_lines(leads), old)
        return result

    def _on_bodies(self, i: int, one: Wanted, leads: Points, board: _Board) -> Reals:
        """Return what it costs that leaders of label i cross what is drawn, or run along it."""
        lines = _lines(leads)
        count = crossings(lines, self.bodies) + overlaps(lines, self.bodies)
        result: Reals = np.multiply(CROSSING, count)
        return result


def _leads(i: int, one: Wanted, grid: Grid, board: _Board, limit: float) -> tuple[Points, Reals]:
    """Return places of label i on leaders that cost less than `limit`: shape (4, K), and what they cost, shape (K,).

    The four are the middle of the label, head and start of its leader, and the way from the start to the head.
    """
    few = grid.cost < limit
    x, y, cost = grid.x[few], grid.y[few], grid.cost[few]
    cost = cost + COVER * board.beside(i, x, y)[0].sum(axis=1)
    foot = one.feet(x + 1j * y)
    head = np.clip(foot.real, x - one.hw, x + one.hw) + 1j * np.clip(foot.imag, y - one.hh, y + one.hh)
    far = abs(head - foot)
    way = (head - foot) / np.where(far > TOUCH, far, 1.0)
    cost[far < FAR[0] - 1.0] += COVER
    leads, few = np.array([x + 1j * y, head, foot + way * one.rim[0], way]), cost < limit
    return leads[:, few], cost[few]


def _lines(leads: Points) -> Bodies:
    _, head, start, way = leads
    return Bodies.strokes(start + TOUCH * way, head)
