"""Views in rows of columns, in reading order: how the sequence is cut into rows and pages.

A page is a pile of rows, a row stands columns side by side, a column piles layers, a layer is a view or a few views
side by side. So the order is always clear: rows from the top, columns from the left, down each column.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import inf
from operator import itemgetter
from typing import NamedTuple, TypeAlias, TypeVar

Size: TypeAlias = tuple[float, float]

SLACK = 1e-9  # mm, for rounding
LAYERS, BESIDE, VIEWS = 4, 3, 5  # most layers in a column, views in a layer, views in a column
FULL = 0.5  # least part of a column that its views cover, and of a row of three columns or more
KEPT_COLUMNS, KEPT_ROWS, KEPT_PAGES = 3, 4, 3  # of those that place the same views, how many are followed further
LAYER_COST, BESIDE_COST = 0.002, 0.01  # what a departure from plain rows may gain in evenness


class Edge(NamedTuple):
    """How a row goes round reserved corners: widths left free beside it, its least height, a box below or above."""

    left: float = 0.0
    right: float = 0.0
    height: float = 0.0
    box: Size = (0.0, 0.0)


class Room(NamedTuple):
    """A page for rows: how its first and last row may go round the corners; the whole heights of the corners."""

    width: float
    height: float
    heads: tuple[Edge, ...] = (Edge(),)
    tails: tuple[Edge, ...] = (Edge(),)
    over: float = 0.0
    under: float = 0.0


class Column(NamedTuple):
    """Layers over one another; `end` is the view after the last."""

    width: float
    height: float
    cost: float
    area: float  # of its views, each with the gap on two sides
    end: int
    layers: tuple[tuple[int, ...], ...]


class _Partial(NamedTuple):
    """The first columns of a row."""

    width: float
    height: float
    cost: float
    area: float
    before: _Partial | None = None
    column: Column | None = None


_T = TypeVar("_T", Column, _Partial)
_by_size = itemgetter(0, 1, 2)


class Row(NamedTuple):
    """Columns side by side, up to the view `end`."""

    height: float
    cost: float
    end: int
    head: Edge
    tail: Edge
    last: _Partial

    @property
    def columns(self) -> list[Column]:
        """The columns from the left."""
        found, partial = [], self.last
        while partial.before is not None and partial.column is not None:
            found.append(partial.column)
            partial = partial.before
        return found[::-1]


class _Part(NamedTuple):
    """Pages finished, the height used on the page begun, and the last row (None where a page ended)."""

    pages: int
    used: float
    cost: float
    before: _Part | None = None
    row: Row | None = None


def _best(items: list[_T], most: int) -> list[_T]:
    """Those that no other beats in both width and height; if too many, those that waste the least."""
    if len(items) == 1:
        return items
    kept: list[_T] = []
    lowest = inf
    for item in sorted(items, key=_by_size):
        if item.height < lowest - SLACK:
            kept.append(item)
            lowest = item.height
    return kept if len(kept) <= most else sorted(kept, key=lambda item: item.width * item.height)[:most]


def _worthwhile(rows: list[Row]) -> list[Row]:
    """Those that no other beats in both height and cost."""
    kept: list[Row] = []
    for row in sorted(rows, key=lambda row: row[:2]):
        if not kept or row.cost < kept[-1].cost - SLACK:
            kept.append(row)
    return kept


class Search:
    """The search for rows and pages of a sequence of views; what it has found out about columns it keeps.

    `ended[i]` is the best way to end a page before view i, `opened[i]` a row only.
    """

    def __init__(
        self, views: Sequence[Size], first: Room, later: Room, gap: float, limit: int | None, nested: bool
    ) -> None:
        self.views, self.rooms, self.gap, self.limit = views, (first, later), gap, limit
        self.nested = nested  # may a layer hold several views?
        areas = [(w + gap) * (h + gap) for w, h in views]
        self.left = [sum(areas[i:]) for i in range(len(views) + 1)]
        # mm2 of a row of a single page that may stay empty
        self.waste = (first.width + gap) * (first.height + gap) - self.left[0] if limit == 1 else inf
        self.found: dict[int, list[Column]] = {}
        self.ended: list[_Part | None] = [_Part(0, 0.0, 0.0)] + [None] * len(views)
        self.opened: list[list[_Part]] = [[] for _ in range(len(views) + 1)]

    def cut(self) -> list[list[Row]] | None:
        """Cut the sequence into rows and pages: as few pages as possible, then the most even ones; None if none fit."""
        for i in range(len(self.views)):
            start = self.ended[i]
            if start is not None and (self.limit is None or start.pages < self.limit):
                room = self.rooms[start.pages > 0]
                for head in room.heads:
                    self._add(start, -self.gap, self.rows(i, room, head), room)
                if room.over:
                    self._add(start, room.over, self.rows(i, room, Edge()), room)
            parts = self._followed(i)
            if parts:
                room = self.rooms[parts[0].pages > 0]
                rows = self.rows(i, room, Edge(), self._spent(i, parts, room))
                for part in parts:
                    self._add(part, part.used, rows, room)
        last = end = self.ended[len(self.views)]
        pages: list[list[Row]] = []
        while end is not None and end.before is not None:
            if end.row is None:
                pages.append([])
            else:
                pages[-1].append(end.row)
            end = end.before
        return None if last is None else [rows[::-1] for rows in pages[::-1]]

    def _followed(self, i: int) -> list[_Part]:
        """Of the pages that end with a row before view `i` those that no other beats in both height and cost."""
        kept: list[_Part] = []
        for part in sorted(self.opened[i], key=lambda part: part[:3]):
            if not kept or (part.pages == kept[0].pages and part.cost < kept[-1].cost - SLACK):
                kept.append(part)
        if len(kept) > KEPT_PAGES:
            kept = [kept[k * (len(kept) - 1) // (KEPT_PAGES - 1)] for k in range(KEPT_PAGES)]
        return kept

    def _spent(self, i: int, parts: list[_Part], room: Room) -> float:
        """Return the area that all these parts of a single page leave empty above view `i`."""
        if self.limit != 1:
            return 0.0
        highest = min(part.used for part in parts)
        return (highest + self.gap) * (room.width + self.gap) - (self.left[0] - self.left[i]) - SLACK

    def _add(self, part: _Part, used: float, rows: tuple[list[Row], list[Row]], room: Room) -> None:
        lowest = room.height + SLACK - self.gap - used
        for row in rows[0]:
            if row.height > lowest:
                continue
            low = used + self.gap + row.height
            if self.limit == 1 and (room.height - low) * (room.width + self.gap) < self.left[row.end] - SLACK:
                continue
            grown = _Part(part.pages, low, part.cost + row.cost, part, row)
            self.opened[row.end].append(grown)
            if room.under and (self.limit != 1 or row.end == len(self.views)):
                self._end(grown, row.end, low + self.gap + room.under, room)
        for row in rows[1]:
            if row.height <= lowest:
                low = used + self.gap + row.height
                self._end(_Part(part.pages, low, part.cost + row.cost, part, row), row.end, low, room)

    def _end(self, part: _Part, i: int, used: float, room: Room) -> None:
        empty = (room.height - used) / room.height
        pages, cost, best = part.pages + 1, part.cost + empty * empty / 2, self.ended[i]
        if used <= room.height + SLACK and (best is None or (pages, cost) < (best.pages, best.cost)):
            self.ended[i] = _Part(pages, 0.0, cost, part)

    def columns(self, i: int, room: Room) -> list[Column]:
        """Columns that begin with view `i`, the narrow ones first."""
        if i not in self.found:
            by_end: dict[int, list[Column]] = {}
            for column in self._piles(i, room):
                by_end.setdefault(column.end, []).append(column)
            self.found[i] = sorted(c for columns in by_end.values() for c in _best(columns, KEPT_COLUMNS))
        return self.found[i]

    def _piles(self, i: int, room: Room) -> Iterator[Column]:
        layers = {k: list(self._layers(k, room)) for k in range(i, min(i + VIEWS, len(self.views)))}
        piles, gap = layers[i], self.gap
        yield from (pile for pile in piles if len(pile.layers[0]) == 1)
        for _ in range(LAYERS - 1):
            higher = []
            for w0, h0, cost, area, end, below in piles:
                for w1, h1, more, extra, last, layer in layers.get(end, ()):
                    width, height = max(w0, w1), h0 + gap + h1
                    filled = area + extra
                    if (
                        height <= room.height + SLACK
                        and last <= i + VIEWS
                        and filled >= FULL * (width + gap) * (height + gap)
                    ):
                        higher.append(Column(width, height, cost + more + LAYER_COST, filled, last, below + layer))
            yield from higher
            piles = higher

    def _layers(self, i: int, room: Room) -> Iterator[Column]:
        gap = self.gap
        w, h = self.views[i]
        if w <= room.width + SLACK and h <= room.height + SLACK:
            yield Column(w, h, 0.0, (w + gap) * (h + gap), i + 1, ((i,),))
        width, height, area = -gap, 0.0, 0.0
        for j in range(i, min(i + BESIDE, len(self.views)) if self.nested else 0):
            w, h = self.views[j]
            width, height, area = width + gap + w, max(height, h), area + (w + gap) * (h + gap)
            if width > room.width or area < FULL * (width + gap) * (height + gap):
                return
            if j > i:
                yield Column(width, height, BESIDE_COST * (j - i), area, j + 1, (tuple(range(i, j + 1)),))

    def rows(self, i: int, room: Room, head: Edge, spent: float = 0.0) -> tuple[list[Row], list[Row]]:
        """Rows that begin with view `i`: those that leave the page open, and those that end it.

        At least `spent` mm2 have been left empty above them.
        """
        gap, count, waste = self.gap, len(self.views), self.waste - spent
        widest, highest = room.width - head.left - head.right + SLACK, room.height + SLACK
        partial: dict[int, list[_Partial]] = {i: [_Partial(-gap, head.height, 0.0, 0.0)]}
        opened: list[Row] = []
        closed: list[Row] = []
        for k in range(i, count + 1):
            if k not in partial:
                continue
            kept = _best(partial[k], KEPT_ROWS)
            if k > i:
                opened += _worthwhile([self._row(p, p.height, k, room, head, Edge()) for p in kept])
                if self.limit != 1 or k == count:
                    closed += self._closed(partial[k], k, room, head)
            over, thick = head.box if k == i and head.box[1] else (0.0, -gap)
            for before in kept if k < count else ():
                base, least, cost, area, _, _ = before
                base += gap
                for column in self.columns(k, room):
                    w, h, more, extra, end, _ = column
                    width, height = base + (w if w > over else over), h + gap + thick
                    if width > widest:
                        break
                    height = height if height > least else least
                    filled = area + extra
                    if (width + gap) * (height + gap) - filled <= waste and height <= highest:
                        grown = _Partial(width, height, cost + more, filled, before, column)
                        partial.setdefault(end, []).append(grown)
        return opened, closed

    def _closed(self, partial: list[_Partial], end: int, room: Room, head: Edge) -> Iterator[Row]:
        """The lowest row with the lower corners beside it, and the one with a corner under its last column."""
        gap = self.gap
        for tail in room.tails:
            widest = room.width - head.left - head.right - tail.left - tail.right + SLACK
            wide, thick = tail.box
            found: list[tuple[float, float, _Partial]] = []
            for p in partial:
                width, height, cost, _, before, column = p
                if thick and before is not None and column is not None:
                    width = max(width, before.width + gap + wide)
                    own = height if before.before is None else column.height
                    height = max(height, own + gap + thick)
                if width <= widest:
                    found.append((height, cost, p))
            if found:
                height, _, lowest = min(found)
                height = max(height, tail.height)
                if height <= room.height + SLACK:
                    yield self._row(lowest, height, end, room, head, tail)

    def _row(self, p: _Partial, height: float, end: int, room: Room, head: Edge, tail: Edge) -> Row:
        empty = 1 - p.area / ((room.width + self.gap) * (height + self.gap))
        return Row(height, p.cost + empty * empty * height / room.height, end, head, tail, p)
