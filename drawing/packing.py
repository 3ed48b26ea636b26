"""Views on pages: in reading order, clear of each other and of the reserved corners, spread evenly."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from .rows import SLACK, Edge, Room, Row, Search, Size
from .text import Box

Corner: TypeAlias = tuple[float, float]
Place: TypeAlias = tuple[int, float, float]  # of a view: its number, its lower left corner
SINK = 12.0  # mm that a layer may move away from the one above it
NEIGHBOURS = (5, 7, 12, 19)  # how many views may change places if they do not fit in order


@dataclass(frozen=True, slots=True)
class Placement:
    """Where a view stands: its page from 0, its lower left corner in mm (y up)."""

    page: int
    x: float
    y: float


def pack(
    views: Sequence[Size],
    area: Box,
    reserved: Sequence[Box] = (),
    *,
    later: Sequence[Box] | None = None,
    gap: float = 8.0,
    pages: int | None = 1,
    any_order: bool = True,
) -> list[Placement] | None:
    """Place views of these widths and heights, mm, on as few pages as they need; return None if they do not fit.

    `reserved` is what is taken on the first page, as if each box reached the nearest corner of the usable `area`, and
    `later` on the following ones, the same if left out. Between views, and from them to reserved boxes, is a `gap` at
    least. There may be as many `pages`, None for any number; a single one may give up the reading order if the views
    do not fit otherwise (`any_order`).
    """
    if not views:
        return []
    first, rest = _room(area, reserved, gap), _room(area, reserved if later is None else later, gap)

    def cut(most: int | None, nested: bool) -> list[list[Row]] | None:
        return Search(views, first, rest, gap, most, nested).cut()

    pages_of_rows = cut(1, nested=False) or cut(1, nested=True)
    if pages_of_rows is None and any_order:
        taken = tuple((x0 - gap, y0 - gap, x1 + gap, y1 + gap) for x0, y0, x1, y1 in reserved)
        corners = _in_any_order(views, _Page(area, taken, gap))
        if corners is not None:
            return [Placement(0, x, y) for x, y in corners]
    if pages_of_rows is None and pages != 1:
        pages_of_rows = cut(pages, nested=True)
    if pages_of_rows is None:
        return None
    places: dict[int, Placement] = {}
    for number, rows in enumerate(pages_of_rows):
        for i, x, y in _Hanging(views, rest if number else first, gap).places(rows):
            places[i] = Placement(number, area[0] + x, area[1] + y)
    return [places[i] for i in range(len(views))]


def _room(area: Box, reserved: Sequence[Box], gap: float) -> Room:
    """Tell how the first and the last row of a page may go round the reserved corners."""
    x0, y0, x1, y1 = area
    corners: dict[tuple[bool, bool], Size] = {}
    for a, b, c, d in reserved:
        right, top = a + c > x0 + x1, b + d > y0 + y1
        w, h = x1 - max(a, x0) if right else min(c, x1) - x0, y1 - max(b, y0) if top else min(d, y1) - y0
        if w > -gap and h > -gap:
            w, h = max(w, SLACK), max(h, SLACK)
            before = corners.get((right, top), (0.0, 0.0))
            corners[right, top] = max(before[0], w), max(before[1], h)
    none = (-gap, 0.0)
    tl, tr = corners.get((False, True), none), corners.get((True, True), none)
    bl, br = corners.get((False, False), none), corners.get((True, False), none)
    heads, tails = _edges(tl, tr, gap, left=True), _edges(br, bl, gap, left=False)
    return Room(x1 - x0, y1 - y0, heads, tails, max(tl[1], tr[1]), max(bl[1], br[1]))


def _edges(main: Size, other: Size, gap: float, left: bool) -> tuple[Edge, ...]:
    """Beside both corners, or beside one of them and under or over the main one."""
    wide, aside = main[0] + gap, other[0] + gap
    beside = Edge(wide if left else aside, aside if left else wide, max(main[1], other[1]))
    if not main[1]:
        return (beside,)
    return beside, Edge(0.0 if left else aside, aside if left else 0.0, other[1], main)


@dataclass(frozen=True, slots=True)
class _Hanging:
    """Where the views of a page of rows stand: what is left empty is shared out evenly."""

    views: Sequence[Size]
    room: Room
    gap: float

    def places(self, rows: Sequence[Row]) -> Iterator[Place]:
        """Yield each view with its lower left corner, from the lower left corner of the room."""
        room, gap = self.room, self.gap
        over = room.over + gap if room.over and rows[0].head == Edge() else 0.0
        under = room.under + gap if room.under and rows[-1].tail == Edge() else 0.0
        free = room.height - over - under - gap * (len(rows) - 1)
        space = max(0.0, free - sum(row.height for row in rows)) / (len(rows) + 1)
        # The space itself keeps the rows clear of the corners, so that the first and the last row need less.
        space = max(0.0, free - sum(self._height(row, space) for row in rows)) / (len(rows) + 1)
        top = room.height - over
        for row in rows:
            top -= space
            height = self._height(row, space)
            yield from self._row(row, top, height, space)
            top -= height + gap

    def _inset(self, edge: Edge, space: float) -> float:
        """How far a column keeps away from the row's outer line because of the box over or under it."""
        return max(0.0, edge.box[1] + self.gap - space) if edge.box[1] else 0.0

    def _height(self, row: Row, space: float) -> float:
        tall = [column.height for column in row.columns]
        tall[0] += self._inset(row.head, space)
        tall[-1] += self._inset(row.tail, space)
        return max(*tall, row.head.height - space, row.tail.height - space)

    def _row(self, row: Row, top: float, height: float, space: float) -> Iterator[Place]:
        columns, gap, left = row.columns, self.gap, row.head.left + row.tail.left
        widths = [column.width for column in columns]
        widths[0], widths[-1] = max(widths[0], row.head.box[0]), max(widths[-1], row.tail.box[0])
        right = self.room.width - row.head.right - row.tail.right
        share = (right - left - sum(widths) - gap * (len(columns) - 1)) / (len(columns) + 1)
        x = left + share
        for n, (column, width) in enumerate(zip(columns, widths, strict=True)):
            head = self._inset(row.head, space) if n == 0 else 0.0
            tail = self._inset(row.tail, space) if n == len(columns) - 1 else 0.0
            level, sink = top - head, min(SINK, max(0.0, height - head - tail - column.height) / len(column.layers))
            for layer in column.layers:
                sizes = [self.views[i] for i in layer]
                beside = (width - sum(w for w, _ in sizes) - gap * (len(sizes) - 1)) / (len(sizes) + 1)
                left = x + beside
                for i, (w, h) in zip(layer, sizes, strict=True):
                    yield i, left, level - h
                    left += w + gap + beside
                level -= max(h for _, h in sizes) + gap + sink
            x += width + gap + share


# Close packing: the last resort ---------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class _Page:
    area: Box
    reserved: tuple[Box, ...]  # already with the gap around them
    gap: float


def _in_any_order(sizes: Sequence[Size], page: _Page) -> list[Corner] | None:
    """Put each view as high and as far left as it goes, the large ones of each few neighbours first."""
    (x0, y0, x1, y1), gap = page.area, page.gap
    taken = sum(max(0.0, min(c, x1) - max(a, x0)) * max(0.0, min(d, y1) - max(b, y0)) for a, b, c, d in page.reserved)
    if sum((w + gap) * (h + gap) for w, h in sizes) > (x1 - x0 + gap) * (y1 - y0 + gap) - taken + SLACK:
        return None
    sides = [-w * h for w, h in sizes], [-h for _, h in sizes]
    for near in NEIGHBOURS:
        found = []
        for shift in range(0, near, max(1, near // 5)):
            for side in sides:
                order = [i for *_, i in sorted(((i + shift) // near, side[i], i) for i in range(len(sizes)))]
                corners = _maximal(sizes, order, page)
                if corners is not None:
                    found.append(corners)
        if found:
            best = max(found, key=lambda corners: order_kept(corners, sizes))
            boxes = [(x, y, x + w, y + h) for (x, y), (w, h) in zip(best, sizes, strict=True)]
            # drawn apart, away from the top left corner; what is clear along an axis stays so when stretched
            for share in (0.8, 0.4, 0.0):
                wide = min([(x1 - x0 - (c - a)) / (a - x0) for a, _, c, _ in boxes if a > x0 + 1] or [1.0])
                boxes = _moved(boxes, page, wide, 1.0, share)
                high = min([(y1 - y0 - (d - b)) / (y1 - d) for _, b, _, d in boxes if d < y1 - 1] or [1.0])
                boxes = _moved(boxes, page, 1.0, high, share)
            return [(a, b) for a, b, _, _ in boxes]
    return None


def order_kept(corners: Sequence[Corner], sizes: Sequence[Size]) -> float:
    """Part of the pairs of views whose earlier one is above or on the left; half if also below."""
    boxes = [(x, y, x + w, y + h) for (x, y), (w, h) in zip(corners, sizes, strict=True)]
    kept, pairs = 0.0, 0
    for j, (x0, y0, _, y1) in enumerate(boxes):
        for _, b, c, d in boxes[:j]:
            kept += 1.0 if b >= y1 or (c <= x0 and d > y0) else 0.5 if c <= x0 else 0.0
            pairs += 1
    return kept / pairs if pairs else 1.0


def _maximal(sizes: Sequence[Size], order: Sequence[int], page: _Page) -> list[Corner] | None:
    """Maximal empty rectangles: each view takes the highest, then leftmost corner where it fits."""
    x0, y0, x1, y1 = page.area
    gap = page.gap
    # Each view owns the gap on its right and below it.
    empty = [(x0, y0 - gap, x1 + gap, y1)]
    for a, b, c, d in page.reserved:
        empty = _cut(empty, (a + gap, b, c, d - gap))
    corners = [(0.0, 0.0)] * len(sizes)
    for i in order:
        w, h = sizes[i][0] + gap, sizes[i][1] + gap
        fitting = [e for e in empty if e[2] - e[0] >= w - SLACK and e[3] - e[1] >= h - SLACK]
        if not fitting:
            return None
        left, _, _, top = min(fitting, key=lambda e: (-e[3], e[0]))
        corners[i] = (left, top - h + gap)
        empty = _cut(empty, (left, top - h, left + w, top))
    return corners


def _cut(empty: list[Box], taken: Box) -> list[Box]:
    """Return the maximal rectangles that are left of `empty` when `taken` is taken."""
    a, b, c, d = taken
    whole: list[Box] = []
    pieces: list[Box] = []
    for box in empty:
        x0, y0, x1, y1 = box
        if a >= x1 - SLACK or c <= x0 + SLACK or b >= y1 - SLACK or d <= y0 + SLACK:
            whole.append(box)
            continue
        if a > x0 + SLACK:
            pieces.append((x0, y0, a, y1))
        if c < x1 - SLACK:
            pieces.append((c, y0, x1, y1))
        if b > y0 + SLACK:
            pieces.append((x0, y0, x1, b))
        if d < y1 - SLACK:
            pieces.append((x0, d, x1, y1))
    # Only a piece can lie within another rectangle: the whole ones did not before.
    kept: list[Box] = []
    for n, (x0, y0, x1, y1) in enumerate(pieces):
        rivals = whole + kept + pieces[n + 1 :]
        if not any(p <= x0 and q <= y0 and r >= x1 and s >= y1 for p, q, r, s in rivals):
            kept.append((x0, y0, x1, y1))
    return whole + kept


def _moved(boxes: list[Box], page: _Page, wide: float, high: float, share: float) -> list[Box]:
    """Stretch by a share of what is possible and centre; leave all as it is if a reserved box is in the way."""
    x0, y0, x1, y1 = page.area
    wide, high = max(1.0, 1 + share * (wide - 1)), max(1.0, 1 + share * (high - 1))
    moved = []
    for a, b, c, d in boxes:
        left, top = x0 + (a - x0) * wide, y1 - (y1 - d) * high
        moved.append((left, top - (d - b), left + (c - a), top))
    right = share * (x1 - max(c for _, _, c, _ in moved)) / 2 if wide > 1 else 0.0
    down = share * (min(b for _, b, _, _ in moved) - y0) / 2 if high > 1 else 0.0
    moved = [(a + right, b - down, c + right, d - down) for a, b, c, d in moved]
    free = not any(
        a < r - SLACK and c > p + SLACK and b < s - SLACK and d > q + SLACK
        for a, b, c, d in moved
        for p, q, r, s in page.reserved
    )
    return moved if free else boxes
