"""Views on pages: in reading order, clear of each other and of the reserved corners, spread evenly."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import islice, product
from typing import TypeAlias

Size: TypeAlias = tuple[float, float]
Corner: TypeAlias = tuple[float, float]
Box: TypeAlias = tuple[float, float, float, float]

SLACK = 1e-9  # mm, for rounding
KEPT = 4  # partial layouts that are followed further, for each number of views placed
SHAPES_TRIED = 16  # combinations of alternative shapes
SHAPES_PAGED = 4  # the same where there may be more pages anyway


@dataclass(frozen=True, slots=True)
class Placement:
    """Where a view stands: its page from 0, its lower left corner in mm (y up), which of its shapes was taken."""

    page: int
    x: float
    y: float
    shape: int = 0


@dataclass(frozen=True, slots=True)
class _Page:
    area: Box
    reserved: tuple[Box, ...]  # already with the gap around them
    gap: float

    def free_row(self, sizes: Sequence[Size], top: float, space: float = 0.0) -> list[float] | None:
        """Left edges of views that hang side by side from `top`, `space` more than the gap around each, or None."""
        left, low, right, _ = self.area
        lefts = []
        for w, h in sizes:
            if top - h < low - SLACK:
                return None
            left = self._step_over(left, w + 2 * space, top - h, top)
            if left + w + 2 * space > right + SLACK:
                return None
            lefts.append(left + space)
            left += w + space + self.gap
        return lefts

    def _step_over(self, left: float, width: float, bottom: float, top: float) -> float:
        moved = True
        while moved:
            moved = False
            for x0, y0, x1, y1 in self.reserved:
                if left < x1 - SLACK and left + width > x0 + SLACK and bottom < y1 - SLACK and top > y0 + SLACK:
                    left, moved = x1, True
        return left

    def may_hold(self, sizes: Sequence[Size]) -> bool:
        """Compare the areas."""
        x0, y0, x1, y1 = self.area
        gap = self.gap
        return sum((w + gap) * (h + gap) for w, h in sizes) <= (x1 - x0 + gap) * (y1 - y0 + gap) + SLACK

    def even_row(self, sizes: Sequence[Size], top: float) -> list[float] | None:
        """Return the same with as much space around each view as the row has room for."""
        left, _, right, _ = self.area
        used = sum(w for w, _ in sizes) + self.gap * (len(sizes) - 1)
        most, step = max(0.0, (right - left - used) / (len(sizes) + 1)), 1.0
        row, share = self.free_row(sizes, top), 0.0
        for _ in range(7):
            wider = self.free_row(sizes, top, min(1.0, share + step) * most)
            if wider is not None:
                row, share = wider, share + step
            if share >= 1.0:
                break
            step /= 2
        return row


_Method: TypeAlias = Callable[[Sequence[Size], _Page], list[Corner] | None]


def pack(
    views: Sequence[Sequence[Size]],
    area: Box,
    reserved: Sequence[Box] = (),
    *,
    later: Sequence[Box] | None = None,
    gap: float = 8.0,
    pages: int | None = 1,
) -> list[Placement] | None:
    """Place views on as few pages as they need.

    Parameters
    ----------
    views : sequence of sequences of (width, height)
        The shapes that each view may take, in mm, the preferred one first.
    area : (x0, y0, x1, y1)
        The usable area of a page, y up.
    reserved : sequence of boxes
        What is taken on the first page: the title block, the corner with the turned designation.
    later : sequence of boxes, optional
        What is taken on the following pages; the same as on the first one if left out.
    gap : float
        The least distance between views, and from them to reserved boxes.
    pages : int or None
        How many pages there may be; None for as many as are needed.

    Returns
    -------
    list of Placement or None
        In the order of `views`; None if they do not fit.
    """
    first = _page(area, reserved, gap)
    rest = first if later is None else _page(area, later, gap)
    whole = _one_page(views, first, (_rows, _in_order, _in_any_order), SHAPES_TRIED)
    if whole is not None or pages == 1 or not views:
        return whole
    return _pages(views, first, rest, pages)


def _page(area: Box, reserved: Sequence[Box], gap: float) -> _Page:
    return _Page(area, tuple((x0 - gap, y0 - gap, x1 + gap, y1 + gap) for x0, y0, x1, y1 in reserved), gap)


def _pages(views: Sequence[Sequence[Size]], first: _Page, rest: _Page, limit: int | None) -> list[Placement] | None:
    """Break the views into pages: as few as possible, then as equally full as possible."""
    layouts: dict[tuple[int, int], list[Placement] | None] = {}

    def layout(i: int, j: int) -> list[Placement] | None:
        if (i, j) not in layouts:
            methods = (_rows, _in_order)
            layouts[i, j] = _one_page(views[i:j], rest if i else first, methods, SHAPES_PAGED)
        return layouts[i, j]

    count = len(views)
    reach: list[int] = []
    for i in range(count):
        j = max([i + 1, *reach[-1:]])
        while j > i and layout(i, j) is None:
            j -= 1
        while j < count and layout(i, j + 1) is not None:
            j += 1
        reach.append(j)
    while (breaks := _breaks(views, reach, layouts)) is not None:
        pages = [layout(i, j) for i, j in breaks]
        if None not in pages:
            fits = limit is None or len(pages) <= limit
            numbered = [Placement(n, p.x, p.y, p.shape) for n, page in enumerate(pages) for p in page or ()]
            return numbered if fits else None
    return None


def _breaks(
    views: Sequence[Sequence[Size]], reach: Sequence[int], layouts: dict[tuple[int, int], list[Placement] | None]
) -> list[tuple[int, int]] | None:
    """First and last view of each page, none of them beyond its reach or known not to fit."""
    weight = [min(w * h for w, h in shapes) for shapes in views]
    # For the first j views: pages used, unevenness, these pages.
    best: list[tuple[int, float, list[tuple[int, int]]] | None] = [(0, 0.0, [])] + [None] * len(views)
    for i in range(len(views)):
        before = best[i]
        for j in range(i + 1, reach[i] + 1 if before else 0):
            if before and layouts.get((i, j), []) is not None:
                filled = sum(weight[i:j])
                candidate = (before[0] + 1, before[1] + filled * filled, [*before[2], (i, j)])
                best[j] = min(best[j] or candidate, candidate)
    last = best[-1]
    return last and last[2]


def _one_page(
    views: Sequence[Sequence[Size]], page: _Page, methods: Sequence[_Method], tries: int
) -> list[Placement] | None:
    """Return what the first method finds that fits the views on the page, the preferred shapes first."""
    choices = [
        (choice, sizes)
        for choice in islice(_choices(views), tries)
        if page.may_hold(sizes := [shapes[k] for shapes, k in zip(views, choice, strict=True)])
    ]
    for method in methods:
        for choice, sizes in choices:
            corners = method(sizes, page)
            if corners is not None:
                return [Placement(0, x, y, k) for (x, y), k in zip(corners, choice, strict=True)]
    return None


def _choices(views: Sequence[Sequence[Size]]) -> Iterator[tuple[int, ...]]:
    """Combinations of shapes, the preferred ones first."""
    several = [i for i, shapes in enumerate(views) if len(shapes) > 1]
    combinations = product(*(range(len(views[i])) for i in several[:4]))
    for ranks in sorted(combinations, key=lambda ranks: (sum(ranks), ranks)):
        choice = [0] * len(views)
        for i, rank in zip(several, ranks, strict=False):
            choice[i] = rank
        yield tuple(choice)


# Rows ---------------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class _Part:
    """The first views in rows: how low these reach, how unevenly they fill, and where each row begins and hangs."""

    low: float
    uneven: float
    rows: tuple[tuple[int, int, float], ...]  # first view, view after the last, top


def _rows(sizes: Sequence[Size], page: _Page) -> list[Corner] | None:
    """Break the views into rows; of the ways that fit the one with the most even spaces."""
    count = len(sizes)
    _, low, _, top = page.area
    parts: list[list[_Part]] = [[] for _ in range(count + 1)]
    parts[0] = [_Part(top + page.gap, 0.0, ())]
    for i in range(count):
        for part in _worth_following(parts[i]):
            for hang in _tops(part.low - page.gap, page):
                _add_rows(parts, i, part, hang, sizes, page)
    height = top - low
    done = [(part.uneven + ((part.low - low) / height) ** 2, part) for part in parts[count]]
    for _, part in sorted(done, key=lambda pair: pair[0]):
        return _spread(part, sizes, page)
    return None


def _tops(top: float, page: _Page) -> list[float]:
    """A row may hang as high as possible, or below a reserved box in its way."""
    return [top] + [y0 for _, y0, _, y1 in page.reserved if y0 < top - SLACK and y1 > top + SLACK and y0 > page.area[1]]


def _worth_following(parts: list[_Part]) -> list[_Part]:
    """Those that no other part beats in both height and evenness."""
    kept: list[_Part] = []
    for part in sorted(parts, key=lambda part: (-part.low, part.uneven)):
        if not kept or part.uneven < kept[-1].uneven - SLACK:
            kept.append(part)
    if len(kept) > KEPT:
        kept = [kept[k * (len(kept) - 1) // (KEPT - 1)] for k in range(KEPT)]
    return kept


def _add_rows(parts: list[list[_Part]], i: int, part: _Part, hang: float, sizes: Sequence[Size], page: _Page) -> None:
    x0, _, x1, _ = page.area
    for j in range(i + 1, len(sizes) + 1):
        lefts = page.free_row(sizes[i:j], hang)
        if lefts is None:
            return
        slack = (x1 - lefts[-1] - sizes[j - 1][0]) / (x1 - x0)
        deepest = max(h for _, h in sizes[i:j])
        ragged = sum(deepest - h for _, h in sizes[i:j]) / deepest / 10
        grown = _Part(hang - deepest, part.uneven + slack * slack + ragged, (*part.rows, (i, j, hang)))
        parts[j].append(grown)


def _spread(part: _Part, sizes: Sequence[Size], page: _Page) -> list[Corner] | None:
    """Share the empty height among the rows, as much of it as the reserved boxes permit."""
    for share in (1.0, 0.8, 0.6, 0.4, 0.2, 0.0):
        corners = _hung(part, share * (part.low - page.area[1]) / (len(part.rows) + 1), sizes, page)
        if corners is not None:
            return corners
    return None


def _hung(part: _Part, space: float, sizes: Sequence[Size], page: _Page) -> list[Corner] | None:
    """Hang the rows with so much space above each."""
    corners: list[Corner] = []
    ceiling = page.area[3]
    for number, (i, j, hang) in enumerate(part.rows, start=1):
        top = min(hang - space * number, ceiling)
        # A little lower the whole width may be free.
        top = min((t for t in _tops(top, page) if t > top - space / 2), default=top)
        lefts = page.even_row(sizes[i:j], top)
        if lefts is None:
            return None
        corners += [(left, top - h) for left, (_, h) in zip(lefts, sizes[i:j], strict=True)]
        ceiling = top - max(h for _, h in sizes[i:j]) - page.gap
    return corners


# Close packing --------------------------------------------------------------------------------------------------------


def _in_order(sizes: Sequence[Size], page: _Page) -> list[Corner] | None:
    """Put each view, in the given order, as high and as far left as it goes."""
    corners = _maximal(sizes, range(len(sizes)), page)
    return None if corners is None else _stretch(corners, sizes, page)


def _in_any_order(sizes: Sequence[Size], page: _Page) -> list[Corner] | None:
    """Put the views so in the order that keeps nearest to the given one, of some that waste less room."""
    numbers = range(len(sizes))
    orders = (
        sorted(numbers, key=lambda i: (-sizes[i][1], i)),
        sorted(numbers, key=lambda i: (-sizes[i][0] * sizes[i][1], i)),
        sorted(numbers, key=lambda i: (-sizes[i][0], i)),
    )
    found = [corners for order in orders if (corners := _maximal(sizes, order, page)) is not None]
    if not found:
        return None
    return _stretch(max(found, key=lambda corners: order_kept(corners, sizes)), sizes, page)


def order_kept(corners: Sequence[Corner], sizes: Sequence[Size]) -> float:
    """Part of the pairs of views on one page that a reader meets in their order, rows before columns."""
    boxes = [(x, y, x + w, y + h) for (x, y), (w, h) in zip(corners, sizes, strict=True)]
    kept = pairs = 0
    for j, (left, bottom, _, top) in enumerate(boxes):
        for a, b, _, d in boxes[:j]:
            side_by_side = min(d, top) - max(b, bottom) > 0.3 * min(d - b, top - bottom)
            kept += a < left if side_by_side else d > top
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


def _stretch(corners: list[Corner], sizes: Sequence[Size], page: _Page) -> list[Corner]:
    """Draw the views apart, away from the top left corner; what is clear along an axis stays so when stretched."""
    x0, y0, x1, y1 = page.area
    boxes = [(x, y, x + w, y + h) for (x, y), (w, h) in zip(corners, sizes, strict=True)]
    for share in (0.8, 0.4, 0.0):
        wide = min([(x1 - x0 - (c - a)) / (a - x0) for a, _, c, _ in boxes if a > x0 + 1] or [1.0])
        boxes = _moved(boxes, page, wide, 1.0, share)
        high = min([(y1 - y0 - (d - b)) / (y1 - d) for _, b, _, d in boxes if d < y1 - 1] or [1.0])
        boxes = _moved(boxes, page, 1.0, high, share)
    return [(a, b) for a, b, _, _ in boxes]


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
