"""Composing a sheet: views on as few pages as hold them in reading order, and frames round them."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache, lru_cache
from itertools import accumulate, chain, combinations, cycle, islice, pairwise, product, takewhile

from ..scales.scale import Scale
from .formats import FORMATS, Format, Norm, drawing_area, reserved_boxes, usable
from .packing import LEAST, SLACK, STEPS, Placement, Size, Slicing, bare, inset, spread
from .page import STATEMENT, TASK_VIEWS, Page
from .shapes import Group
from .tables import after, larger, narrower, part_of, roomier
from .text import Box
from .titleblock import Stamp, frame_shapes
from .view import View

HELD, BESIDE = 9, 1  # bonds of the corners to the views beside them, of a text to the figure before it
SOON = 5  # views from which one may stand on a page before its turn
TRIES, NEARLY = 60, 1.2  # orders that are tried for the only page; how much more height than it has all may need
ALONE = 0.95  # part of the width of a page that leaves no room for a view beside
HALF = 0.5  # part of a page in reading order that larger letters fill
FULL = 0.69  # part of a page that views should take at least before the next one begins
TOLD, TEXT, FIGURE, GROUP, PART = range(-2, 3)  # what may begin with a view
TABLE, LEAD = range(2)  # kinds of texts that may have larger letters, beside what tells of the work
MANY = 3  # pages on which views may come in another order
ENOUGH = {"A4": 0.502, "A3": 0.652, "A2": 0.652, "A1": 0.652}  # part of a page below which texts break for it
ROOMY = ENOUGH | {"A3": 0.69, "A2": 0.69, "A1": 0.69}  # part of a page below which its letters are larger
GROWN = 2.0  # times as large as before are texts with larger letters
CROWDED = 0.85  # part of a page that views, with what is between them, never fill
LARGE = {TABLE, LEAD, TOLD}, {LEAD, TOLD}, {TABLE, TOLD}, {TOLD}, {TABLE, LEAD}, {TABLE}, set[int](), {LEAD}
KEPT = 8  # parts of the views of a page that are tried in reading order
BARE = 0.105  # part of a page that may be one bare rectangle
EMPTY = 0.119  # the same, between lines
SIDE = 0.5  # mm between the lines of a text and the sides of its box
# heights of rows, mm, and the part of the width of a page that tables take, as wide as the widest of them or more
ROWS = (6.5, 0.0), (8.0, 0.0), (8.0, 0.7), (1.0, 1.0), (8.0, 1.0)
HIGH = 0.0, *(row for row, part in ROWS if not part)  # of these in reading order, tables as wide as they are
NARROWEST = 0.38  # part of the width of a page that texts beside a figure have at least
PARTS, NUDGES = (0.25, 0.5, 0.75), 2  # of its free way that a view is moved, and how often each at most
FAR = 2  # pages that a view may move, and that a text may come after its figure
ROUNDS, GAIN = 40, 1e-3  # moves of views to other pages, and parts of a page that each is worth
LATE, FARTHER = 2e-3, 0.1  # parts of a page that it costs that a text is a page late, or early or yet later
EVENER = 0.01  # the same, for the sake of even pages
AHEAD = 0.05  # of what moves a page ahead for a last one with texts alone, as a gain
PIECES = 3  # rows or lines at least on each page
SHORT = 10  # rows, with the head, of a table that stays whole


def on_a_page(
    sizes: Sequence[Size],
    sheet: Format,
    norm: Norm,
    begins: Sequence[int] = (),
    first: bool = True,
    loose: bool = False,
    columns: bool = False,
) -> list[Placement] | None:
    """Place views of these sizes on one page of `sheet` in reading order; return None if they do not fit.

    The title block stands in the lower right corner and, on the `first` page, column 26 in an upper one. A text stands
    beside the figure before it where that can be; `begins` are as of `Pages`, and `loose` as of `spread`. In `columns`
    figures come down one column after the other.
    """
    placed = _on_a_page(tuple(sizes), sheet, norm, tuple(begins), first, loose, columns)
    return None if placed is None else [*placed]


@lru_cache(maxsize=256)
def _on_a_page(
    sizes: tuple[Size, ...],
    sheet: Format,
    norm: Norm,
    begins: tuple[int, ...],
    first: bool,
    loose: bool,
    columns: bool,
) -> tuple[Placement, ...] | None:
    """Place them, as `on_a_page` says; what was tried is kept, since pages and orders that are tried ask it again."""
    left, low, right, top = usable(sheet, norm)
    if sum((w + LEAST) * (h + LEAST) for w, h in sizes) > (right - left + LEAST) * (top - low + LEAST):
        return None
    page, (x0, y0), begun = _cuts(sizes, sheet, norm, begins, first, columns)
    if not page.fits:
        return None
    cut, room, corners = page.cut(), page.room, (len(sizes) + begun, 0 if begun else -1)
    edge = inset(cut, page.sizes, room[0])
    spots = spread(cut, page.sizes, (edge, room[1]), (room[0] - 2.0 * edge, room[1]), *corners, loose)
    places = {i: (x, y) for i, x, y in spots}
    return tuple(Placement(0, x0 + places[i + begun][0], y0 + places[i + begun][1]) for i in range(len(sizes)))


def _cuts(
    sizes: Sequence[Size], sheet: Format, norm: Norm, begins: Sequence[int], first: bool, columns: bool = False
) -> tuple[Slicing, Size, int]:
    """Return all ways to cut a page for views and its corners, where it begins, how many corners come before them."""
    (x0, y0, x1, y1), (block, *turned) = usable(sheet, norm), reserved_boxes(sheet, norm, first=first)
    own, joined, begun = list(sizes), [BESIDE * (kind == TOLD) for kind in begins] or [0 for _ in sizes], 0
    for box in turned:
        if box[0] > x0:  # upright on the right of a tall sheet
            x1 = box[0] - LEAST
        else:
            own, joined, begun = [(box[2] - x0, y1 - box[1]), *own], [0, HELD, *joined[1:]], 1
    wide, high = x1 - block[0], block[3] - y0
    if wide < ALONE * (x1 - x0):
        own, joined = [*own, (wide, high)], [*joined, HELD]
    else:
        y0 += high + LEAST
    figures = [False] * begun + [kind == FIGURE for kind in begins] + [False] * (len(own) - begun - len(sizes))
    return Slicing(own, (x1 - x0, y1 - y0), joined, figures if columns else ()), (x0, y0), begun


def on_one_page(
    sizes: Sequence[Size],
    sheet: Format,
    norm: Norm,
    begins: Sequence[int] = (),
    first: bool = True,
    loose: bool = False,
) -> list[Placement] | None:
    """Place views of these sizes on the only page, or on the last one; return None if they do not fit.

    Where they do not fit as one reads them, high ones stand before low ones, so that rows have little empty room: first
    tables alone, behind the figures, then figures with what tells of them, texts alone, in the end all. Texts with
    which the page begins, as what is given, stay first. `begins` are as of `Pages`, and `loose` as of `spread`.
    """
    every, lead = range(len(sizes)), _lead(begins)
    rest = every[len(lead) :]

    def low(i: int) -> float:
        return -sizes[i][1]

    def behind(*kinds: int) -> list[int]:
        texts = [i for i in rest if begins and begins[i] in kinds]
        return [*lead, *(i for i in rest if i not in texts), *sorted(texts, key=low)]

    starts = [*(i for i in rest if i == len(lead) or not begins or begins[i] != TOLD), len(sizes)]
    told = sorted((range(i, j) for i, j in pairwise(starts)), key=lambda own: min(map(low, own)))
    ways = [*every], behind(TEXT), [*lead, *chain(*told)], behind(TOLD, TEXT), [*lead, *sorted(rest, key=low)]
    for order in dict.fromkeys(map(tuple, ways)):
        kinds = [begins[i] for i in order] if begins else ()
        if (placed := on_a_page([sizes[i] for i in order], sheet, norm, kinds, first, loose)) is not None:
            return [placed[order.index(i)] for i in every]
    return None


def in_any_order(
    sizes: Sequence[Size], sheet: Format, norm: Norm, begins: Sequence[int] = (), first: bool = True
) -> list[Placement] | None:
    """Place views of these sizes on the only page where no usual order has room; return None if none is found.

    Texts and tables in the order of the work move one at a time between the figures, then views change places in pairs,
    then those from wide to narrow move, as long as all need less height then, and once there is room as long as fewer
    stand before what comes before them. Texts with which the page begins stay first, and the figure after them;
    `begins` are as of `Pages`.
    """
    lead = [*range(min(len(_lead(begins)) + 1, len(sizes)))]
    rest = [*range(len(lead), len(sizes))]

    def high(order: Sequence[int]) -> int:
        return _cuts([sizes[i] for i in order], sheet, norm, (), first)[0].high

    texts = [i for i in rest if begins and begins[i] < FIGURE]
    by_width, pairs = sorted(rest, key=lambda i: -sizes[i][0]), [*combinations(rest, 2)]
    for begun, change, every in (
        (rest, _moved, [(i, j) for j in rest for i in texts]),
        (rest, _exchanged, pairs),
        (by_width, _moved, [(i, j) for i in rest for j in rest]),
    ):
        order = [*lead, *begun]
        least, idle = high(order), 0
        for i, j in islice(cycle(every), TRIES if least < NEARLY * STEPS else 0):
            other = change(order, i, j)
            back = _turned(other) < _turned(order)
            now = high(other) if other != order and (least > STEPS or back) else least
            if now < least or (now <= STEPS and back):
                order, least, idle = other, now, 0
            elif (idle := idle + 1) == len(every):
                break
        if least <= STEPS:
            kinds = [begins[i] for i in order] if begins else ()
            placed = on_a_page([sizes[i] for i in order], sheet, norm, kinds, first)
            return None if placed is None else [placed[order.index(i)] for i in range(len(sizes))]
    return None


def _turned(order: Sequence[int]) -> int:
    """Return how many pairs do not stand in the order of the work."""
    return sum(a > b for a, b in combinations(order, 2))


def _lead(begins: Sequence[int]) -> list[int]:
    """Return the texts with which a page begins."""
    return [*takewhile(lambda i: begins[i] == TEXT, range(len(begins)))]


def _exchanged(order: Sequence[int], i: int, j: int) -> list[int]:
    return [order[{i: j, j: i}.get(k, k)] for k in range(len(order))]


def _moved(order: Sequence[int], i: int, j: int) -> list[int]:
    others = [k for k in order if k != i]
    return [*others[:j], i, *others[j:]]


def arrange(
    sizes: Sequence[Size], sheet: Format, norm: Norm, begins: Sequence[int] = (), count: int = 0
) -> list[Placement] | None:
    """Place views of these sizes on as few pages of `sheet` as hold them, or on `count`; `begins` as of `Pages`.

    Of two or three pages each is a run of the views, and ends where most begins anew, if it is full enough. Of more,
    and where runs take more pages, a page that has no room for the next view may have texts that `SOON` follow. Where
    that leaves a page too empty, high views stand before low ones on it. Where `count` pages do not hold them they take
    more. None if a view has no room on a page.
    """
    strict, loose = (Pages(sizes, sheet, norm, begins, loose=loose) for loose in (False, True))
    packed = strict.packed()
    if packed is None or not max(last(packed), count - 1) > 0:
        return packed
    end, ways, read = (count - 1 if count else last(packed)), [packed], [packed]

    def worth(places: list[Placement]) -> tuple[bool, int, float]:
        return last(places) == end, -last(places), min(FULL, strict.least(places))

    for pages in (strict, loose):
        if 0 < end < MANY and (runs := pages.runs(0, 0, end)) is not None:
            ways.insert(0 if pages is strict else len(ways), runs)
            read += [runs] if pages is strict else []
        best = max(ways, key=worth)
        if not begins or (last(best) == end and strict.least(best) >= FULL):
            break
        if pages is strict and (more := loose.packed()) is not None:
            ways.append(more)
    best = max(ways, key=worth)
    alone = sum(place.page == last(best) for place in best) == 1  # what may have room on the page before
    # larger letters fill pages in reading order that are but half full
    read = [way for way in read if last(way) == last(best) and strict.least(way) >= HALF and not alone]
    return best if best in read else max(read, key=strict.least, default=best)


@dataclass(slots=True)
class Pages:
    """The ways to part views of these sizes into pages of `sheet`.

    `begins` say how much begins with each view: a part of the work is more than a group, and that than a figure; a
    table is nothing of its own, and a text belongs to the figure before it. Where nothing is said, all may stand before
    their turn as tables may. Where pages are `loose`, high views stand before low ones on a page that does not hold
    them in order, and tables on any.
    """

    sizes: Sequence[Size]
    sheet: Format
    norm: Norm
    begins: Sequence[int] = ()
    loose: bool = False
    _tried: dict[tuple[tuple[int, ...], bool], list[Placement] | None] = field(default_factory=dict)

    def tried(self, own: Sequence[int], page: int) -> list[Placement] | None:
        """Place some of the views, by number, on one page."""
        key = tuple(own), page == 0
        if key not in self._tried:
            sizes, begins = [self.sizes[i] for i in own], [self.begins[i] for i in own] if self.begins else ()
            place = on_one_page if self.loose else on_a_page
            self._tried[key] = place(sizes, self.sheet, self.norm, begins, page == 0)
        return [replace(place, page=page) for place in placed] if (placed := self._tried[key]) is not None else None

    def fill(self, own: Iterable[int], page: int) -> float:
        """Return the part of a page inside its frame that views and title block take."""
        boxes = reserved_boxes(self.sheet, self.norm, first=page == 0)
        taken = sum(math.prod(self.sizes[i]) for i in own) + sum((x1 - x0) * (y1 - y0) for x0, y0, x1, y1 in boxes)
        x0, y0, x1, y1 = drawing_area(self.sheet, self.norm)
        return taken / ((x1 - x0) * (y1 - y0))

    def least(self, places: Sequence[Placement]) -> float:
        """Return the fill of the page, but for the last one, that is least filled."""
        begin, end = places[0].page, last(places)
        own = ([i for i, place in enumerate(places) if place.page == page] for page in range(begin, end))
        return min(map(self.fill, own, range(begin, end)), default=1.0)

    def runs(self, begin: int, page: int, most: int) -> list[Placement] | None:
        """Place the views from this one on in runs on the pages from this one to the last one that there may be."""
        count = len(self.sizes)
        if page == most:
            return self.tried(range(begin, count), page)

        def worth(end: int) -> tuple[int, int]:  # none is half empty for what begins, nor the last one for a part
            full = self.fill(range(begin, end), page) >= FULL
            return (2 + (self.begins[end] if self.begins else FIGURE)) * full, -end if full and self.begins else end

        ends = (end for end in range(begin + 1, count) if self.fill(range(begin, end), page) <= 1.0)
        for end in sorted(ends, key=worth, reverse=True):
            own = self.tried(range(begin, end), page)
            if own is not None and (others := self.runs(end, page + 1, most)) is not None:
                return own + others
        return None

    def packed(self) -> list[Placement] | None:
        """Place each view on the first page that has room, but that one that follows soon may stand before it."""
        places: dict[int, Placement] = {}
        page = 0
        while rest := [i for i in range(len(self.sizes)) if i not in places]:
            own, placed = self._most(rest, page)
            if placed is None:
                return None
            for i in rest[len(own) :] if self.loose else rest[len(own) : len(own) + SOON]:
                kind = self.begins[i] if self.begins else TEXT
                free = kind == TEXT or (kind == TOLD and i - 1 in {*own, *places})
                if free and (more := self.tried([*own, i], page)) is not None:
                    own, placed = [*own, i], more
            places |= dict(zip(own, placed, strict=True))
            page += 1
        return [places[i] for i in range(len(self.sizes))]

    def _most(self, rest: Sequence[int], page: int) -> tuple[list[int], list[Placement] | None]:
        """Return the longest run of these views that one page holds: it holds every shorter one."""
        least, most = 0, len(rest)
        held: list[Placement] | None = None
        while least < most:
            middle = (least + most + 1) // 2
            if (placed := self.tried(rest[:middle], page)) is not None:
                held, least = placed, middle
            else:
                most = middle - 1
        return [*rest[:least]], held


Standing = tuple[View, Placement]  # a view and where it stands
Span = tuple[int, int]  # the first of the rows or lines that stand on a page, and the one before which they end


def _as_read(page: list[Standing], sheet: Format, norm: Norm, first: bool) -> list[Standing]:
    """Return the views of a page at places in reading order, as many from the first one on as can be.

    The others come as on the only page: figures before tables, or high ones before low ones; so that fewest figures
    stand before one that they follow. Where they can, figures come down one column after the other.
    """
    best = _with_few_turned(page, sheet, norm, first)
    return _in_columns(best, sheet, norm, first) if _climbs(best) else best


def _with_few_turned(page: list[Standing], sheet: Format, norm: Norm, first: bool) -> list[Standing]:
    """Return the views of a page at places at which fewest figures stand before one that they follow."""
    views, count = [view for view, _ in page], len(page)
    begins, best, least = begins_of(views), page, _turned_figures(page)
    for kept in range(count, 1, -max(1, count // KEPT)):
        rest = sorted(range(kept, count), key=lambda i: -views[i].size[1])
        figures = [i for i in range(kept, count) if begins[i] == FIGURE]
        for order in dict.fromkeys(
            ((*range(kept), *figures, *(i for i in rest if i not in figures)), (*range(kept), *rest))
        ):
            sizes, kinds = [views[i].size for i in order], [begins[i] for i in order]
            placed = on_a_page(sizes, sheet, norm, kinds, first)
            if placed is None:
                continue
            at = dict(zip(order, placed, strict=True))
            other = [(view, at[i]) for i, view in enumerate(views)]
            now = _turned_figures(other)
            if now < least or (best is page and now == least and kept < count):
                best, least = other, now
            if not least:
                return best
    placed = in_any_order([view.size for view in views], sheet, norm, begins, first) if least else None
    other = page if placed is None else [*zip(views, placed, strict=True)]
    return other if _turned_figures(other) < least else best


def _turned_figures(page: Sequence[Standing]) -> int:
    """Return in how many pairs of figures the later one stands neither on the right of the other one nor below it."""
    kinds = begins_of(view for view, _ in page)
    boxes = [_box_of(standing) for standing, kind in zip(page, kinds, strict=True) if kind == FIGURE]
    return sum(after[0] < before[2] and after[3] > before[1] for before, after in combinations(boxes, 2))


def _climbs(page: Sequence[Standing]) -> int:
    """Return in how many pairs of figures the later one stands higher in one column, or in one more to the left.

    Below all figures before it there begin new columns.
    """
    kinds, count = begins_of(view for view, _ in page), 0
    boxes = [_box_of(standing) for standing, kind in zip(page, kinds, strict=True) if kind == FIGURE]
    lows, tops = [*accumulate((box[1] for box in boxes), min)], [*accumulate((box[3] for box in boxes[::-1]), max)]
    bands = [*accumulate((low >= top for low, top in zip(lows, tops[-2::-1], strict=False)), initial=0)]
    for (band, before), (other, later) in combinations(zip(bands, boxes, strict=False), 2):
        (x, y), (u, v) = ((0.5 * (box[0] + box[2]), 0.5 * (box[1] + box[3])) for box in (before, later))
        if band == other:
            count += v > y if before[0] < u < before[2] or later[0] < x < later[2] else u < x
    return count


def _in_columns(page: list[Standing], sheet: Format, norm: Norm, first: bool) -> list[Standing]:
    """Return a page with its figures in columns, where that leaves it no emptier than it may be.

    Tables and texts come as they are read, or behind the figures from high to low.
    """
    views = [view for view, _ in page]
    begins, sizes = begins_of(views), [view.size for view in views]
    lead, paper = len(_lead(begins)), (sheet, norm)
    rest = range(lead, len(views))
    texts = sorted((i for i in rest if begins[i] != FIGURE), key=lambda i: -sizes[i][1])

    def turned(page: Sequence[Standing]) -> tuple[float, ...]:
        return _climbs(page), *_lacks(page, *paper, first)

    best, least = page, turned(page)
    enough = least[1:]

    def behind(*kinds: int) -> tuple[int, ...]:
        return (*range(lead), *(i for i in rest if begins[i] not in kinds), *(i for i in texts if begins[i] in kinds))

    orders = dict.fromkeys((tuple(range(len(views))), behind(TEXT), behind(TEXT, TOLD)))
    for order, loose in product(orders, (False, True)):
        kinds = [begins[i] for i in order]
        placed = on_a_page([sizes[i] for i in order], *paper, kinds, first, loose, columns=True)
        if placed is None:
            continue
        at = dict(zip(order, placed, strict=True))
        other = [(view, at[i]) for i, view in enumerate(views)]
        now = turned(other)
        if now < least and all(a <= b + SLACK for a, b in zip(now[1:], enough, strict=True)):
            best, least = other, now
    return best


def _area(box: Box) -> float:
    return (box[2] - box[0]) * (box[3] - box[1])


def _box_of(standing: Standing) -> Box:
    """Return the box that a view fills where it stands."""
    view, at = standing
    return at.x, at.y, at.x + view.size[0], at.y + view.size[1]


def _lacks(page: Sequence[Standing], sheet: Format, norm: Norm, first: bool) -> tuple[float, float]:
    """Return by which part of it a page is too empty, and its largest bare rectangle too large."""
    room, boxes = drawing_area(sheet, norm), [*reserved_boxes(sheet, norm, first=first)]
    for view, at in page:
        x, y, (left, low, right, high) = at.x - view.box[0], at.y - view.box[1], view.ink
        boxes.append((x + left, y + low, x + right, y + high))
    area = (room[2] - room[0]) * (room[3] - room[1])
    fill = sum((x1 - x0) * (y1 - y0) for x0, y0, x1, y1 in boxes) / area
    return max(0.0, ENOUGH[sheet.letters] - fill), max(0.0, bare(room, boxes) / area - EMPTY)


@dataclass(slots=True)
class _Parting:
    """Moves views between pages, texts by rows or lines, too, until none is too empty or has a large bare rectangle.

    `views` are all in reading order, texts whole; those with which the first page begins stay there. What `goes_on`
    from a page before has its heading so. Where pages stay `plain` only texts move, and all keep their letters; what
    moves ahead on them may `spare` the last one.
    """

    sheet: Format
    norm: Norm
    goes_on: str
    views: Sequence[View]
    plain: bool = True
    spare: bool = False
    _kinds: list[int] = field(init=False)
    _figures: list[int] = field(init=False)  # to which each text belongs; -1 for any
    _parts: dict[tuple[int, Span], View] = field(default_factory=dict)
    _found: dict[tuple[object, ...], tuple[float, list[Standing]] | None] = field(default_factory=dict)
    _made: dict[tuple[int, float, float], View] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """See which figure each text belongs to."""
        self._kinds, self._figures, figure = begins_of(self.views), [], -1
        numbers = {view.name: i for i, view in enumerate(self.views)}
        for i, (view, kind) in enumerate(zip(self.views, self._kinds, strict=True)):
            figure = i if kind == FIGURE else figure
            self._figures.append(numbers.get(view.about or "", figure if kind == TOLD else -1))

    def evened(self, pages: Sequence[list[Standing]]) -> tuple[list[list[Standing]], float]:
        """Return pages like these, and what they are short of: as little as can be found."""
        spans, places, end = self._spans(pages), [*pages], len(pages) - 1
        costs = [self._short(page, number, end) for number, page in enumerate(pages)]
        for number in (number for number in range(end) if costs[number] and not self.plain):
            page = self._nudged(places[number], number)  # it may have places that no order of its views gives
            ways = (self._short(page, number, end), page), self._best(spans[number], number, end)
            costs[number], places[number] = min((way for way in ways if way), key=lambda way: way[0])
        for _ in range(ROUNDS):
            tried = (self._moved(spans, costs, *move) for move in self._moves(spans, costs))
            gains = (way for way in tried if way[1])  # all are looked at where that is quick
            _, changed = max(gains, key=lambda way: way[0], default=(0.0, {})) if self.plain else next(gains, (0.0, {}))
            if not changed:
                break
            for number, (own, cost, page) in changed.items():
                spans[number], costs[number], places[number] = own, cost, page
            if not spans[-1]:
                spans, places = spans[:-1], places[:-1]
                costs = [*costs[:-2], self._short(places[-1], len(places) - 1, len(places) - 1)]
        return places, sum(costs)

    def _spans(self, pages: Sequence[Sequence[Standing]]) -> list[dict[int, Span]]:
        """Return which rows or lines stand on each page, by the number of their view."""
        numbers, begun = {view.name: i for i, view in enumerate(self.views)}, [0] * len(self.views)
        spans = list[dict[int, Span]]()
        for page in pages:
            spans.append({})
            for view, _ in page:
                i = numbers[view.of or view.name]
                span = begun[i], begun[i] + view.pieces
                self._parts.setdefault((i, span), view)
                spans[-1][i], begun[i] = (spans[-1].get(i, span)[0], span[1]), span[1]
        return spans

    def _part(self, i: int, span: Span) -> View:
        """Return these rows or lines of a view."""
        if (i, span) not in self._parts:
            view, said = self.views[i], "".join(self.views[i].heading)
            heading = self.goes_on.format(heading=said) if span[0] else said
            self._parts[i, span] = view if span == (0, view.pieces) else part_of(view, *span, heading)
        return self._parts[i, span]

    def _astray(self, spans: Sequence[Mapping[int, Span]]) -> list[float]:
        """Return what it costs, as parts of a page, that texts of each page stand away from their figures."""
        at = {i: number for number, page in enumerate(spans) for i in page if self._kinds[i] == FIGURE}
        costs, farther = [], FARTHER if self.plain else EVENER
        for number, page in enumerate(spans):
            late = [number - at.get(self._figures[i], number) for i in page]
            costs.append(sum(LATE * max(far, 0) + farther * max(-far, far - FAR, 0) for far in late))
        return costs

    def _moves(
        self, spans: Sequence[Mapping[int, Span]], costs: Sequence[float]
    ) -> Iterator[tuple[int, int, dict[int, int]]]:
        """Go through moves from a page to another one: of which views, and of how many pieces of each.

        One of both is short, or the last one without a figure. A figure keeps its turn, and leaves no page to texts
        alone; parts of a text keep theirs, too.
        """
        end, away = len(spans) - 1, self._astray(spans)
        whole = TASK_VIEWS if self.sheet is not FORMATS[self.sheet.name] else ()  # as a blank says them
        stays = {*_lead(self._kinds), *(i for i, view in enumerate(self.views) if view.name in STATEMENT)}
        at = {i: number for number, page in enumerate(spans) for i in page if self._kinds[i] == FIGURE}
        for a, page in enumerate(spans):
            figures = [i for i in sorted(page) if self._kinds[i] == FIGURE]
            for i, b in product(page, range(end + 1)):
                needed = costs[a] or costs[b] or away[a] >= EVENER or (b < a and costs[end])
                far = min(abs(a - b), abs(at.get(self._figures[i], a) - b))
                if a == b or i in stays or not needed or far > FAR or (len(page) == 1 and (a < end or not self.plain)):
                    continue
                if self._kinds[i] == FIGURE:
                    alone = len(figures) == 1 if a < end else len(page) > 1 and self.plain
                    if abs(a - b) > 1 or alone or i != figures[-1 if b > a else 0]:
                        continue
                    told = {k: span[1] - span[0] for k, span in page.items() if self._figures[k] == i}
                    yield from ((a, b, {i: 0, **own}) for own in (({}, told) if told else ({},)))
                elif not any(i in spans[number] for number in range(min(a, b) + 1, max(a, b))):
                    count = page[i][1] - page[i][0]
                    some = range(count, 0, -1) if self.plain else sorted({round(part * count) for part in PARTS})
                    if self.views[i].name not in whole and not 0 < len(self.views[i].rows) <= SHORT:
                        yield from ((a, b, {i: n}) for n in some if PIECES <= n <= count - PIECES)
                    yield a, b, {i: count}

    def _moved(
        self, spans: Sequence[dict[int, Span]], costs: Sequence[float], a: int, b: int, moved: Mapping[int, int]
    ) -> tuple[float, dict[int, tuple[dict[int, Span], float, list[Standing]]]]:
        """Return what a move gains, and both pages with what these are short of then; none where it gains nothing."""
        own = {a: {**spans[a]}, b: {**spans[b]}}
        for i, count in moved.items():
            begin, end = own[a].pop(i)
            cut = begin + count if b < a else end - count
            goes, stays = ((begin, cut), (cut, end)) if b < a else ((cut, end), (begin, cut))
            if stays[0] < stays[1]:
                own[a][i] = stays
            there = own[b].get(i, goes)
            own[b][i] = min(goes[0], there[0]), max(goes[1], there[1])
        after = [own.get(number, page) for number, page in enumerate(spans)]
        gain = costs[a] + costs[b] + sum(self._astray(spans)) - sum(self._astray(after)) + (not own[a])
        end = len(spans) - 1
        if costs[end]:  # where a page has less there is room for what comes later
            gain += (a - b) * AHEAD * sum(self._area(i, (0, count)) for i, count in moved.items())
        found = dict[int, tuple[dict[int, Span], float, list[Standing]]]()
        if gain - sum(self._lack(page, number) for number, page in own.items() if page and number < end) < GAIN:
            return 0.0, {}
        for number, page in own.items():
            best = self._best(page, number, end)
            if best is None or gain - best[0] < GAIN:
                return 0.0, {}
            found[number], gain = (page, *best), gain - best[0]
        return gain, found

    def _lack(self, spans: Mapping[int, Span], number: int) -> float:
        """Return what a page of these views is too empty by at least, its texts being as large as can be."""
        grown = 1.0 if self.plain else GROWN
        own = sum(self._area(i, span) * (grown if self.views[i].pieces else 1.0) for i, span in spans.items())
        blocks = sum(map(_area, reserved_boxes(self.sheet, self.norm, first=number == 0)))
        return max(0.0, ENOUGH[self.sheet.letters] - own - blocks / _area(drawing_area(self.sheet, self.norm)))

    def _area(self, i: int, span: Span) -> float:
        """Return which part of a page these rows or lines of a view take."""
        part = (span[1] - span[0]) / self.views[i].pieces if self.views[i].pieces else 1.0
        return part * math.prod(self.views[i].size) / _area(drawing_area(self.sheet, self.norm))

    def _best(self, spans: Mapping[int, Span], number: int, end: int) -> tuple[float, list[Standing]] | None:
        """Return what a page of these views is short of at least, and how it is laid out so; None without room."""
        key = self.plain, number == 0, (number == end) * (1 + self.spare), *sorted(spans.items())
        if key not in self._found:
            views = [self._part(i, span) for i, span in sorted(spans.items())]
            even, best = number < end, ((0.0, list[Standing]()) if not views else None)
            kinds, first = begins_of(views), number == 0
            ways = [self._larger, self._beside] if even and not self.plain else []
            for way in (lambda own, _: [own], *ways) if views else ():
                if way == self._larger and best is None:
                    continue
                for again, loose in product(way(views, kinds), (False, True)[: 1 if self.plain else 2]):
                    if best is not None and not best[0]:
                        break
                    placed = on_one_page([view.size for view in again], self.sheet, self.norm, kinds, first, loose)
                    page = [] if placed is None else [*zip(again, placed, strict=True)]
                    cost = self._short(page, number, end) if page else 0.0
                    if page and (best is None or cost < best[0]):
                        best = cost, page
            if best and best[0] and not self.plain and not _lacks(best[1], self.sheet, self.norm, first)[0]:
                nudged = self._nudged(best[1], number)
                best = self._short(nudged, number, end), nudged
            self._found[key] = best
        return self._found[key]

    def _short(self, page: Sequence[Standing], number: int, end: float = math.inf) -> float:
        """Return what a page is short of; of the last one what is taken, where texts alone might have room before."""
        if number < end:
            lacks = _lacks(page, self.sheet, self.norm, number == 0)
            return lacks[0] if self.plain else sum(lacks)
        texts = self.spare and all(view.pieces for view, _ in page)
        return sum(map(math.prod, (view.size for view, _ in page))) / _area(drawing_area(self.sheet, self.norm)) * texts

    def _nudged(self, page: list[Standing], number: int) -> list[Standing]:
        """Return a page with views a little aside, as long as that makes its largest bare rectangle smaller.

        Of two that stand one above the other one goes to the left and one to the right where either alone is no help.
        """
        cost = self._short(page, number)
        for _ in range(NUDGES * len(page) if cost else 0):
            ways = [*self._ways(page, number)]
            pairs = ((a, b) for a, b in combinations(ways, 2) if a[0] != b[0] and a[1] * b[1] < 0.0)
            for moves in (([way] for way in ways), map(list, pairs)):
                others = (self._aside(page, some) for some in moves)
                found = [(self._short(other, number), k, other) for k, other in enumerate(others) if other]
                least = min(found, key=lambda way: way[:2], default=(cost, 0, page))
                if least[0] < cost:
                    break
            else:
                break
            cost, _, page = least
            if not cost:
                break
        return page

    def _ways(self, page: Sequence[Standing], number: int) -> Iterator[tuple[int, float, float]]:
        """Go through views of a page, by number, and how far each may go to the right or up."""
        x0, y0, x1, y1 = usable(self.sheet, self.norm)
        blocks = reserved_boxes(self.sheet, self.norm, first=number == 0)
        boxes = [_box_of(standing) for standing in page]
        for i, (left, low, right, high) in enumerate(boxes):
            others = [*boxes[:i], *boxes[i + 1 :], *blocks]
            beside = [box for box in others if box[1] < high + LEAST and box[3] > low - LEAST]
            along = [box for box in others if box[0] < right + LEAST and box[2] > left - LEAST]
            for free, right_way, up in (
                (left - max((box[2] + LEAST for box in beside if box[2] <= left), default=x0), -1.0, 0.0),
                (min((box[0] - LEAST for box in beside if box[0] >= right), default=x1) - right, 1.0, 0.0),
                (low - max((box[3] + LEAST for box in along if box[3] <= low), default=y0), 0.0, -1.0),
                (min((box[1] - LEAST for box in along if box[1] >= high), default=y1) - high, 0.0, 1.0),
            ):
                yield from ((i, part * free * right_way, part * free * up) for part in PARTS if free > LEAST)

    def _aside(self, page: Sequence[Standing], moves: Sequence[tuple[int, float, float]]) -> list[Standing]:
        """Return a page with some of its views aside; nothing where they would come too near to each other."""
        other = [*page]
        for i, x, y in moves:
            view, at = page[i]
            other[i] = view, replace(at, x=at.x + x, y=at.y + y)
        boxes = [_box_of(other[i]) for i, *_ in moves]
        near = (
            a[0] < b[2] + LEAST and b[0] < a[2] + LEAST and a[1] < b[3] + LEAST and b[1] < a[3] + LEAST
            for a, b in combinations(boxes, 2)
        )
        return [] if any(near) else other

    def _larger(self, views: list[View], _: Sequence[int]) -> Iterator[list[View]]:
        """Go through the views with ever larger letters and roomier tables."""
        x0, y0, x1, y1 = usable(self.sheet, self.norm)
        parted = any(view.of for view in views)
        texts = [*((view.style and not view.of and (view.lines or not parted)) for view in views)]
        larger_ones = [self._once(view, 0.0, 0.0) if text else view for view, text in zip(views, texts, strict=True)]
        tables = any(view.rows for view in views)
        for (row, part), own in product(((0.0, 0.0), *ROWS[: len(ROWS) * tables]), (views, larger_ones)):
            widest = max(part * (x1 - x0), *(view.size[0] for view in own if view.rows), 0.0)
            again = [self._once(view, widest, row) if row and view.rows else view for view in own]
            if sum(math.prod(view.size) for view in again) < (x1 - x0) * (y1 - y0):
                yield again

    def _beside(self, views: list[View], begins: Sequence[int]) -> Iterator[list[View]]:
        """Go through the views with texts narrow enough to stand beside a figure."""
        x0, _, x1, _ = usable(self.sheet, self.norm)
        figures = [view.size[0] for view, kind in zip(views, begins, strict=True) if kind == FIGURE]
        for left in sorted({x1 - x0 - LEAST - wide for wide in figures}):
            if left >= NARROWEST * (x1 - x0):
                yield [self._once(view, left, 0.0) if view.lines and view.size[0] > left else view for view in views]

    def _once(self, view: View, wide: float, row: float) -> View:
        """Return a table with rows so high, a text no wider than that, or either with larger letters, once."""
        key = id(view), wide, row
        if key not in self._made:
            inner = wide - 2.0 * SIDE
            changed = roomier(view, inner, row) if row else narrower(view, inner) if wide else larger(view, True)
            self._made[key] = changed
        return self._made[key]


def _without_holes(page: list[Standing], sheet: Format, norm: Norm, first: bool) -> list[Standing]:
    """Return a page with its views in the middle of their parts where that spares it a large bare rectangle.

    They come from the upper left on in the order in which they stand.
    """
    room, blocks = drawing_area(sheet, norm), reserved_boxes(sheet, norm, first=first)

    def hole(page: list[Standing]) -> float:
        return bare(room, [*map(_box_of, page), *blocks]) / ((room[2] - room[0]) * (room[3] - room[1]))

    if (least := hole(page)) <= BARE:
        return page
    views = [view for view, _ in page]
    placed = on_a_page([view.size for view in views], sheet, norm, begins_of(views), first, loose=True)
    other = page if placed is None else [*zip(views, placed, strict=True)]
    return other if hole(other) < least and _climbs(other) <= _climbs(page) else page


def begins_of(views: Iterable[View]) -> list[int]:
    """Return what begins with each view: a figure, or nothing, since it is a table or a text, perhaps of a figure.

    A further part of a text belongs to the part before it as a text does to its figure.
    """
    found, before = list[int](), ""
    for view in views:
        told = view.lines and (found[-1:] == [FIGURE] or view.of == before != "")
        before = view.of
        found.append(TOLD if told else TEXT if view.rows or view.lines else FIGURE)
    return found


def last(places: Sequence[Placement]) -> int:
    """Return the number of the last page, from 0."""
    return max((place.page for place in places), default=-1)


@dataclass(frozen=True, slots=True)
class Drawn:
    """A sheet but for its title block: views in order of the work, and at their places, by page.

    `scales` are the scale factors that it has, by plan. `reduction` is what a millimetre of a drawing is there whose
    lengths on paper the task has given. Unless it `begins` a work, its first page has the small title block, too. It is
    `short` of what fills its pages, but the last one, by so much of a page.
    """

    views: tuple[View, ...]
    placed: tuple[tuple[Group, ...], ...]
    scales: Mapping[str, Scale]
    sheets: tuple[Format, ...]
    norm: Norm
    reduction: float = 1.0
    begins: bool = True
    short: float = 0.0

    @property
    def sheet(self) -> Format:
        """The format of its pages, but that the last of several may be smaller."""
        return self.sheets[0]

    @property
    def format(self) -> str:
        """The name of its format."""
        return self.sheet.name

    def pages(self, stamp: Stamp) -> tuple[Page, ...]:
        """Return the finished pages: frame, title block and the views at their places.

        Raises InputError: the title block cannot hold its words.
        """
        pages = []
        for number, (figures, sheet) in enumerate(zip(self.placed, self.sheets, strict=True)):
            own = replace(stamp, sheet=number + 1, sheets=len(self.placed))
            frame = frame_shapes(sheet, own, self.norm, first=self.begins and number == 0)
            pages.append(Page(sheet.width, sheet.height, (*frame, *figures), stamp.title, stamp.language, self.norm))
        return tuple(pages)


def compose(
    views: Sequence[View],
    places: Sequence[Placement],
    scales: Mapping[str, Scale],
    sheet: Format,
    norm: Norm,
    goes_on: str,
    reduction: float = 1.0,
    smaller: bool = False,
) -> Drawn:
    """Set views at their places on the pages of `sheet`; the last of several pages may be `smaller`.

    The heading of what `goes_on` from a page before has these words.
    """
    pages = [[own for own in zip(views, places, strict=True) if own[1].page == k] for k in range(last(places) + 1)]
    whole = dict[str, View]()
    for view in views:  # what comes in parts
        name, one = view.of or view.name, replace(view, of="") if view.of else view
        whole[name] = after(whole[name], view) if name in whole else one
    parting, short = _Parting(sheet, norm, goes_on, [*whole.values()]), 0.0
    if len(pages) > 1:
        ways = []
        for parting.spare in (True, False):
            ways.append(parting.evened(pages)[0])
        pages = min(reversed(ways), key=len)
    sheets = [sheet] * len(pages)
    if smaller and len(pages) > 1:
        own = [view for view, _ in pages[-1]]
        for less in takewhile(lambda less: less is not sheet, FORMATS.values()):
            if (
                placed := on_one_page([view.size for view in own], less, norm, begins_of(own), first=False)
            ) is not None:
                sheets[-1], pages[-1] = less, [*zip(own, placed, strict=True)]
                break
    for k, paper in enumerate(sheets):
        on, end = (paper, norm, k == 0), 0 < k == len(sheets) - 1
        page = pages[k] if end else _legible(pages[k], *on, several=len(sheets) > 1)
        pages[k] = _without_holes(_as_read(page, *on), *on)
    if len(pages) > 1 and sheets[-1] is sheet is FORMATS[sheet.name]:  # on paper for printers there is less room
        parting.plain = False
        pages, short = parting.evened(pages)
        sheets = sheets[: len(pages)]
        for k, page in enumerate(pages):
            if _turned_figures(page) or _climbs(page):
                read = _as_read(page, sheet, norm, k == 0)
                if k == len(pages) - 1 or _lacks(read, sheet, norm, k == 0) <= _lacks(page, sheet, norm, k == 0):
                    pages[k] = read
    parts, shown = Counter[str](), list[list[Standing]]()
    for page in pages:
        shown.append([])
        for view, at in page:
            name = f"{view.of}{parts[view.of] * '_continued'}" if view.of else view.name
            parts[view.of] += 1
            shown[-1].append((replace(view, name=name) if view.of else view, at))
    drawn = tuple(tuple(view.at(at.x, at.y) for view, at in page) for page in shown)
    every = [view for page in shown for view, _ in page]
    alone = {view.name: view for view in every if not view.of}
    every_one = (*(alone.get(name, view) for name, view in whole.items()), *(view for view in every if view.of))
    return Drawn(every_one, drawn, scales, tuple(sheets), norm, reduction, short=short)


def _legible(page: list[Standing], sheet: Format, norm: Norm, first: bool, several: bool) -> list[Standing]:
    """Return a page with larger letters and roomier tables where figures leave it too empty else.

    Of `several` pages all have letters of one height but those that would be short of what fills them. On the only one
    all tables and texts have larger letters in reading order, or none; where it would be short, all, some, or those
    with which it begins, as the structure: as many as have room in reading order so that it is not, or else in any.
    Parts of what stands on another page, too, stay as they are.
    """
    views = [view for view, _ in page]
    begins, paper = begins_of(views), (sheet, norm)
    full = Pages([view.size for view in views], *paper).fill(range(len(views)), 0 if first else 1)
    short = full < ROOMY[sheet.letters] and any(_lacks(page, *paper, first))
    if full >= ROOMY[sheet.letters] or any(view.of for view in views) or (several and not short):
        return page
    lead = len([*takewhile(lambda kind: kind == TEXT, begins)])
    of = [TABLE if view.rows else LEAD if i < lead else TOLD for i, view in enumerate(views)]
    x0, y0, x1, y1 = usable(*paper)

    @cache
    def written(i: int, large: bool, wide: bool, row: float) -> View:
        view = larger(views[i], wide) if large else views[i]
        return roomier(view, 0.0, row) if row else view

    room, without = (x1 - x0 + LEAST) * (y1 - y0 + LEAST), {on_a_page: CROWDED, on_one_page: CROWDED}
    ways = product((on_a_page, on_one_page), LARGE) if short else product((on_a_page,), (LARGE[0], set[int]()))
    for place, kinds in ways:
        areas = (
            math.prod(view.size) * (GROWN if view.style and k in kinds else 1.0)
            for k, view in zip(of, views, strict=True)
        )
        if sum(areas) > CROWDED * (x1 - x0) * (y1 - y0):  # surely without room
            continue
        for row, wide in product((0.0,) if place is on_one_page else HIGH, (True, False)):
            again = [written(i, k in kinds, wide and k != TABLE, row * (k == TABLE)) for i, k in enumerate(of)]
            area = sum((view.size[0] + LEAST) * (view.size[1] + LEAST) for view in again)
            if area >= without[place] * room:  # hardly with room, where less had none
                continue
            for loose in (False,) if place is on_one_page else (False, True):
                placed = place([view.size for view in again], *paper, begins, first, loose)
                found = [] if placed is None else [*zip(again, placed, strict=True)]
                if found and (place is on_one_page or not any(_lacks(found, *paper, first))):
                    return found
                if not found:
                    without[place] = area / room
                    break
    return page
