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
    Reals,
    Request,
    Segment,
    Wanted,
    circle_table,
    crossings,
)

__all__ = ["Labels", "Obstacles", "Request", "place"]


@dataclass(frozen=True, slots=True)
class Labels:
    """Lower left corners by name, leaders (from label to anchor) of those set apart, and who covers something."""

    corners: dict[str, complex] = field(default_factory=dict)
    leaders: dict[str, Segment] = field(default_factory=dict)
    failed: tuple[str, ...] = ()


def place(requests: Sequence[Request], obstacles: Obstacles, gap: float = 0.6, bounds: Box | None = None) -> Labels:
    """Find a place for every label, the same places for the same input.

    Parameters
    ----------
    requests : sequence of Request
        Their names differ.
    obstacles : Obstacles
        What the labels must not cover.
    gap : float
        The empty distance around every label, mm.
    bounds : box, optional
        The labels stay inside of it.

    Returns
    -------
    Labels
        Every request has a corner; `failed` names those that cover something none the less.
    """
    if len({request.name for request in requests}) != len(requests):
        raise ValueError("two labels have one name")
    if not requests:
        return Labels()
    wanted = Wanted.of(requests, circle_table(obstacles.circles), max(gap, 0.01))
    bodies = Bodies.of(obstacles, wanted)
    grid = Grid.around(wanted, bodies, NEAR, bounds)
    board = _Board(wanted, grid.x, grid.y, grid.cost)
    board.settle()
    board.repair()
    return _finish(requests, wanted, bodies, board, bounds)


class _Board:
    """The places taken so far; it is changed in place while labels are tried and moved."""

    def __init__(self, wanted: Wanted, x: Reals, y: Reals, cost: Reals) -> None:
        self.wanted, self.x, self.y, self.cost = wanted, x, y, cost
        rows = np.arange(len(x))
        pick = cost.argmin(axis=1)
        self.now_x, self.now_y, self.now = x[rows, pick], y[rows, pick], cost[rows, pick]
        self.down = np.zeros(len(x), dtype=bool)

    def clashes(self, i: int, x: Reals, y: Reals, apart: float = 0.0) -> Flags:
        """Tell, shape (K, L), which labels on the board label i would touch at x, y, or stand less than `apart` beside.

        Two letters side by side read as one word.
        """
        w = self.wanted
        wide, high = w.hw + (w.hw[i] + w.gap - SLACK), w.hh + (w.hh[i] + w.gap - SLACK)
        touch = (abs(x[:, None] - self.now_x) < wide + apart) & (abs(y[:, None] - self.now_y) < high)
        touch &= self.down
        touch[:, i] = False
        result: Flags = touch
        return result

    def best(self, i: int) -> tuple[float, int]:
        """Return the cost and the number of the best place of label i among the others."""
        x, y = self.x[i], self.y[i]
        cost = self.cost[i] + COVER * np.count_nonzero(self.clashes(i, x, y), axis=1)
        cost += CLOSE * np.count_nonzero(self.clashes(i, x, y, APART), axis=1)
        k = int(cost.argmin())
        return float(cost[k]), k

    def put(self, i: int, k: int) -> None:
        self.now_x[i], self.now_y[i], self.now[i] = self.x[i, k], self.y[i, k], self.cost[i, k]
        self.down[i] = True

    def settle(self) -> None:
        """Leave alone who is in nobody's way; then the most constrained label chooses first."""
        w = self.wanted
        touch = abs(self.now_x[:, None] - self.now_x) < w.hw[:, None] + w.hw + w.gap + APART
        touch &= abs(self.now_y[:, None] - self.now_y) < w.hh[:, None] + w.hh + w.gap
        self.down = np.count_nonzero(touch, axis=1) == 1
        free = np.count_nonzero(self.cost < COVER, axis=1)
        rest = np.flatnonzero(~self.down)
        for i in rest[np.lexsort((rest, free[rest], -w.priority[rest]))].tolist():
            self.put(i, self.best(i)[1])

    def in_trouble(self) -> list[int]:
        """Labels that cover something or touch another label."""
        w = self.wanted
        touch = abs(self.now_x[:, None] - self.now_x) < w.hw[:, None] + w.hw + w.gap - SLACK
        touch &= abs(self.now_y[:, None] - self.now_y) < w.hh[:, None] + w.hh + w.gap - SLACK
        touch &= self.down & self.down[:, None]
        bad = (self.now >= COVER) | (np.count_nonzero(touch, axis=1) > 1)
        return [int(i) for i in np.flatnonzero(bad & self.down)]

    def repair(self, rounds: int = 3) -> None:
        """Give each label in trouble a place by moving those that block it."""
        for _ in range(rounds):
            moved = [i for i in self.in_trouble() if self._improve(i)]
            if not moved:
                return

    def _improve(self, i: int) -> bool:
        cost, k = self.best(i)
        if cost < COVER:
            self.put(i, k)
            return True
        blocked = self.clashes(i, self.x[i], self.y[i])
        order = np.argsort(self.cost[i], kind="stable")[:24].tolist()
        return any(self.cost[i, k] < COVER and self._push(i, k, np.flatnonzero(blocked[k]).tolist()) for k in order)

    def _push(self, i: int, k: int, blockers: list[int]) -> bool:
        if len(blockers) > 3:
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


def _finish(requests: Sequence[Request], wanted: Wanted, bodies: Bodies, board: _Board, bounds: Box | None) -> Labels:
    """Set apart, on leaders, the labels that found no free place or that a thin line would run through.

    Those that find no free place there either are given up.
    """
    leaders: dict[int, Segment] = {}
    bad = board.in_trouble()
    # Of two labels that touch, one may stay: take them up one by one, the less important first.
    bad.sort(key=lambda i: (requests[i].priority, board.now[i] < COVER, i))
    crossed = np.flatnonzero((board.now >= THIN) & (board.now < COVER)).tolist()
    for i, limit in [*((i, COVER) for i in bad), *((i, THIN) for i in crossed if i not in bad)]:
        if limit == THIN or i in board.in_trouble():
            one = wanted.some(np.array([i]))
            # beside a line a leader leaves along its normal; where that is barred, from a point of it to any side
            ends = (one, one.at(0.5), one.at(0.25), one.at(0.75))
            any(_lead(i, end, wanted, bodies, board, leaders, bounds, limit) for end in ends)
    return Labels(
        {
            r.name: complex(x - r.width / 2, y - r.height / 2)
            for r, x, y in zip(requests, board.now_x.tolist(), board.now_y.tolist(), strict=True)
        },
        {requests[i].name: leader for i, leader in sorted(leaders.items())},
        tuple(requests[i].name for i in board.in_trouble()),
    )


def _lead(
    i: int,
    one: Wanted,
    wanted: Wanted,
    bodies: Bodies,
    board: _Board,
    leaders: dict[int, Segment],
    bounds: Box | None,
    limit: float,
) -> bool:
    """Move label i, which is `one`, away onto a leader, if there is a place for both that costs less than `limit`."""
    grid = Grid.around(one, bodies, FAR, bounds, led=True)
    x, y, cost = grid.x[0], grid.y[0], grid.cost[0]
    cost = cost + COVER * np.count_nonzero(board.clashes(i, x, y), axis=1)
    foot = one.feet(x + 1j * y)
    head = np.clip(foot.real, x - one.hw, x + one.hw) + 1j * np.clip(foot.imag, y - one.hh, y + one.hh)
    way = (head - foot) / abs(head - foot)
    start = foot + way * one.rim[0]
    lines = Bodies.strokes(start + TOUCH * way, head)
    # No leader runs through another label, and no label stands on a leader.
    others = board.now_x[:, None], board.now_y[:, None], wanted.hw[:, None], wanted.hh[:, None]
    touched = lines.distance(*others, slice(None)) < wanted.gap / 2
    touched[i] = False
    cost += COVER * np.count_nonzero(touched, axis=0)
    if leaders:
        old = Bodies.strokes(*np.array(list(leaders.values())).T)
        on = old.distance(x[:, None], y[:, None], one.hw, one.hh, slice(None)) < wanted.gap
        cost += COVER * np.count_nonzero(on, axis=1) + CROSSING * crossings(lines, old)
    cost += CROSSING * crossings(lines, bodies)
    k = int(cost.argmin())
    if cost[k] >= limit:
        return False
    board.now_x[i], board.now_y[i], board.now[i] = x[k], y[k], 0.0
    leaders[i] = (complex(head[k] - way[k] * wanted.gap / 2), complex(start[k]))
    return True
