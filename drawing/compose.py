"""Composing a sheet: views on as few pages as hold them in reading order, and frames round them."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import lru_cache
from heapq import heappop, heappush
from itertools import chain, combinations, cycle, islice, pairwise, product, takewhile
from itertools import count as numbers
from typing import TypeAlias

from ..scales.scale import Scale
from .formats import FORMATS, STYLES, Format, Norm, drawing_area, reserved_boxes, usable
from .packing import LEAST, STEPS, Cut, Placement, Size, Slicing, bare, inset, spread
from .page import Page
from .shapes import Group
from .tables import BETWEEN, after, larger, narrower, part_of, roomier
from .text import Box
from .titleblock import Stamp, frame_shapes
from .view import View

HELD, BESIDE = 9, 1  # bonds of the corners to the views beside them, of a text to the figure before it
TRIES, NEARLY = 60, 1.2  # orders that are tried for the only page; how much more height than it has all may need
ALONE = 0.95  # part of the width of a page that leaves no room for a view beside
FULL = 0.69  # part of a page that views should take at least before the next one begins
TOLD, TEXT, FIGURE, GROUP, PART = range(-2, 3)  # what may begin with a view
ENOUGH = {"A4": 0.505, "A3": 0.655, "A2": 0.655, "A1": 0.655}  # part of a page that views and title block should take
GROWN = 2.0  # times as large as before texts are at most that have larger letters, tables that are roomier
KEPT = 8  # parts of the views of a page that are tried in reading order
EMPTY = 0.116  # part of a page that may be one bare rectangle, between lines
OVER = 0.44  # heights of a heading between its letters and the box of its view
INK = 1.0, 0.5  # mm between the lines of a view and its box: of a figure, of a text
# heights of rows, mm, and the part of the width of a page that tables take, as wide as the widest of them or more
ROWS = (6.5, 0.0), (8.0, 0.0), (8.0, 0.7), (1.0, 1.0), (8.0, 1.0)
NARROWEST = 0.38  # part of the width of a page that texts beside a figure have at least
PARTS, NUDGES = (0.25, 0.5, 0.75), 2  # of its free way that a view is moved, and how often each at most
PIECES, LATER = 2, 2  # rows or lines at least on each page; whole texts that come late at most
CROWDED = 0.85  # part of a page that views with their gaps never take
CLOSEST = 0.95  # part of a page that views with their gaps may take
TRIED, EVENED = 150, 400  # pages that are looked at to find some, to find even ones
LONG = 0.5  # part of a page from which a text is long
GROWTH = 8  # of these that one with larger letters is worth
HOPE = 0.3  # part of what a page is short of that may be left where letters are larger
SPLIT = 0.15, 0.3, 0.5, 0.7, 0.85  # of its rows or lines that a text has on the page where it begins
FARTHER = 0.03  # parts of a page that may be short so that pages come farther
LATEST = 0.3  # part of a page that a text is worth that comes yet later
Standing: TypeAlias = tuple[View, Placement]  # a view and where it stands
Beginning: TypeAlias = Callable[[Sequence[View]], list[int]]  # what begins with each view


def on_a_page(
    sizes: Sequence[Size],
    sheet: Format,
    norm: Norm,
    begins: Sequence[int] = (),
    first: bool = True,
    loose: bool = False,
) -> list[Placement] | None:
    """Place views of these sizes on one page of `sheet` in reading order; return None if they do not fit.

    The title block stands in the lower right corner and, on the `first` page, column 26 in an upper one. A text stands
    beside the figure before it where that can be; `begins` are as of `Pages`, and `loose` as of `spread`.
    """
    found = _cut(tuple(sizes), sheet, norm, tuple(begins), first)
    if found is None:
        return None
    page, (x0, y0), begun, cut = found
    room, corners = page.room, (len(sizes) + begun, 0 if begun else -1)
    edge = inset(cut, page.sizes, room[0])
    spots = spread(cut, page.sizes, (edge, room[1]), (room[0] - 2.0 * edge, room[1]), *corners, loose)
    places = {i: (x, y) for i, x, y in spots}
    return [Placement(x0 + places[i + begun][0], y0 + places[i + begun][1]) for i in range(len(sizes))]


@lru_cache(maxsize=512)
def _cut(
    sizes: tuple[Size, ...], sheet: Format, norm: Norm, begins: tuple[int, ...], first: bool
) -> tuple[Slicing, Size, int, Cut] | None:
    """Return how a page is cut; what was tried is kept, since pages and orders that are tried ask it again."""
    (x0, y0, x1, y1) = usable(sheet, norm)
    room = x1 - x0 + LEAST, y1 - y0 + LEAST
    if sum((w + LEAST) * (h + LEAST) for w, h in sizes) > room[0] * room[1]:
        return None
    if sum(h + LEAST for w, h in sizes if 2.0 * (w + LEAST) > room[0]) > room[1]:  # no two of them stand side by side
        return None
    page, corner, begun = _cuts(sizes, sheet, norm, begins, first)
    return (page, corner, begun, page.cut()) if page.fits else None


def _cuts(
    sizes: Sequence[Size], sheet: Format, norm: Norm, begins: Sequence[int], first: bool
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
    return Slicing(own, (x1 - x0, y1 - y0), joined), (x0, y0), begun


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
    sizes: Sequence[Size], sheet: Format, norm: Norm, begins: Sequence[int] = ()
) -> list[Placement] | None:
    """Place views of these sizes on the only page where no usual order has room; return None if none is found.

    Views in the order of the work change places in pairs, those from wide to narrow move one at a time, as long as all
    need less height then, and once there is room as long as fewer stand before what comes before them. Texts with which
    the page begins stay first, and the figure after them; `begins` are as of `Pages`.
    """
    lead = [*range(min(len(_lead(begins)) + 1, len(sizes)))]
    rest = [*range(len(lead), len(sizes))]

    def high(order: Sequence[int]) -> int:
        return _cuts([sizes[i] for i in order], sheet, norm, (), True)[0].high

    by_width, pairs = sorted(rest, key=lambda i: -sizes[i][0]), [*combinations(rest, 2)]
    moves = [move for i, j in pairs for move in ((i, j), (j, i))]
    for begun, change, every in ((rest, _exchanged, pairs), (by_width, _moved, moves)):
        order = [*lead, *begun]
        least, idle = high(order), 0
        for i, j in islice(cycle(every), TRIES if least < NEARLY * STEPS else 0):
            other = change(order, i, j)
            back = _turned(other) < _turned(order)
            now = high(other) if least > STEPS or back else least
            if now < least or (now <= STEPS and back):
                order, least, idle = other, now, 0
            elif (idle := idle + 1) == len(every):
                break
        if least <= STEPS:
            kinds = [begins[i] for i in order] if begins else ()
            placed = on_a_page([sizes[i] for i in order], sheet, norm, kinds)
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
    others = [*order[:i], *order[i + 1 :]]
    return [*others[:j], order[i], *others[j:]]


def arrange(
    views: Sequence[View],
    sheet: Format,
    norm: Norm,
    goes_on: str,
    begins: Beginning | None = None,
    most: int = 0,
) -> list[list[Standing]] | None:
    """Place views in turn on as few pages of `sheet` as hold them, or on so many at `most`.

    `goes_on` and `begins` are as of `Pages`. None if a view has no room on a page.
    """
    if not views:
        return []
    pages = Pages(views, sheet, norm, goes_on, begins or begins_of)
    best, count = None, most or len(views) + pages.least
    while count >= pages.least and (found := pages.found(count)) is not None:
        best, count = found[0], 0 if most else len(found[0]) - 1
    read = pages.found(len(best), place=on_a_page) if best is not None else None  # each page as one reads it
    return read[0] if read is not None and len(read[0]) == len(best or ()) else best


def in_turn(views: Sequence[View]) -> list[View]:
    """Return views as they come on several pages: a text or a table follows the figure that it is about.

    Where it is not said which one that is, it stays where it is.
    """
    names = {"", *(view.name for view in views)}
    moving = [view for view in views if view.about is not None and view.about in names]
    turn = [*(view for view in moving if not view.about), *(view for view in views if view not in moving)]
    for view in (view for view in moving if view.about):
        at = next(i for i, one in enumerate(turn, start=1) if one.name == view.about)
        turn.insert(at + sum(1 for _ in takewhile(lambda one: one.pieces, turn[at:])), view)
    return turn


@dataclass(frozen=True, slots=True)
class _Leaf:
    """A page that may come: its views, of one that is `broken` so many pieces, and where the others go on after it.

    The views in turn up to the `end` have come then, but those that are `late`.
    """

    number: int
    views: tuple[View, ...]
    end: int
    late: tuple[View, ...] = ()
    broken: tuple[int, int] | None = None
    before: _Leaf | None = None


@dataclass(slots=True)
class Pages:
    """The ways to part views in turn into pages of `sheet`, and how each page is laid out.

    A text or a table stands on the page of its figure or late, on the next one, or breaks between them: what `goes_on`
    has its heading so. A page ends where most `begins`, if it is full enough: a part of the work is more than a group,
    and that than a figure. One that is too empty, or has too large a bare rectangle, has larger letters, roomier
    tables, views that are moved aside.
    """

    views: Sequence[View]
    sheet: Format
    norm: Norm
    goes_on: str
    begins: Beginning
    _place: Callable[..., list[Placement] | None] = on_one_page
    _fewest: list[int] = field(init=False)  # pages that views in turn from each on take at least
    _parted: dict[tuple[int, int], list[View]] = field(default_factory=dict)
    _found: dict[tuple[int, ...], tuple[float, list[Standing]] | None] = field(default_factory=dict)
    _made: dict[tuple[int, float, float], View] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Bring views in turn, and see how many pages their figures take alone."""
        self.views = views = in_turn(self.views)
        figures = [i for i, view in enumerate(self.views) if not view.pieces]
        ends, self._fewest = len(figures), [0] * (len(self.views) + 1)
        for k in reversed(range(len(figures))):
            while ends > k + 1 and not self._laid(_Leaf(1, tuple(views[i] for i in figures[k:ends]), 0), False, False):
                ends -= 1
            later = figures[ends] if ends < len(figures) else len(self.views)
            self._fewest[figures[k]] = 1 + self._fewest[later]
        for i in reversed(range(len(self.views))):
            self._fewest[i] = self._fewest[i] or self._fewest[i + 1]

    @property
    def least(self) -> int:
        """How many pages there are at least."""
        return max(1, self._fewest[0], math.ceil(_most(sum(map(self._needs, self.views)))))

    def _needs(self, view: View) -> complex:
        """Return what a view needs of a page: of its area, and of its height where no two so wide are side by side."""
        (wide, high), (x0, y0, x1, y1) = view.size, usable(self.sheet, self.norm)
        block = reserved_boxes(self.sheet, self.norm, first=False)[0]
        area = (x1 - x0 + LEAST) * (y1 - y0 + LEAST) - _area([block])
        alone = 2.0 * wide + LEAST > x1 - x0 or high > y1 - y0
        return complex((wide + LEAST) * (high + LEAST) / (CLOSEST * area), alone * (high + LEAST) / (y1 - y0 + LEAST))

    def even(self, pages: Sequence[list[Standing]], enough: float = 0.0) -> tuple[list[list[Standing]], float]:
        """Return pages like these, or as many others, with what they are short of: as little as can be found.

        What is short of less than is `enough` is not looked for.
        """
        *others, end = pages
        every = [self.grown(page, number) for number, page in enumerate(others)]
        short = sum(own for own, _ in every)
        better = None
        if short and not enough:
            better = self.found(len(pages), short, on_a_page)
            if better is None or better[1]:
                better = self.found(len(pages), better[1] if better else short) or better
        return better or ([*(page for _, page in every), end], short)

    def found(
        self, count: int, most: float = 0.0, place: Callable[..., list[Placement] | None] = on_one_page
    ) -> tuple[list[list[Standing]], float] | None:
        """Return at most so many pages that are short of less than `most`, or of anything where that is 0.

        Of the ways that are short of least the one that has come farthest goes on first; `place` lays out a page.
        """
        even, best, self._place = most > 0.0, None, place
        begun, serial, tried = [*self.begins(self.views), PART], numbers(), set[tuple[int, ...]]()
        reserved = [_area(reserved_boxes(self.sheet, self.norm, first=first)) for first in (False, True)]
        whole, enough = _area([drawing_area(self.sheet, self.norm)]), ENOUGH[self.sheet.letters] if even else 0.0
        farthest: dict[int, list[tuple[int, float]]] = defaultdict(list)  # where pages have come, and what is late then
        heap: list[tuple[float, int, tuple[float, ...], int, float, bool | None, _Leaf]] = []
        left = EVENED if even else TRIED

        def add(leaf: _Leaf, cost: float, odd: int) -> None:
            figures, texts = (
                _area_of(view for view in leaf.views if bool(view.pieces) is kind) for kind in (False, True)
            )
            fill = (figures + texts + reserved[leaf.number == 0]) / whole
            worth = (2 + begun[leaf.end]) * (fill >= FULL)
            rank = odd, -worth, -fill
            hope = 0.0 if self._ends(leaf) else max(0.0, enough - fill - (GROWN - 1.0) * texts / whole)
            if not even or cost + hope < most:
                # any pages, but texts on those where they belong; else the farther ones before those hardly shorter
                first = cost + hope - FARTHER * leaf.number if even else cost // LATEST
                heappush(heap, (first, -leaf.number, rank, next(serial), cost, False, leaf))

        for page in self._next(None, count):
            add(*page)
        while heap and left > 0:
            first, depth, rank, _, before, grown, leaf = heappop(heap)
            if not even:
                come = leaf.end, self._behind(leaf)
                if any(end >= come[0] and behind <= come[1] for end, behind in farthest[leaf.number]):
                    continue
            if grown is not None:
                left -= GROWTH if grown else 1
                if (laid := self._laid(leaf, even, grown)) is None:
                    continue
                again = None if grown or not laid[0] else True
                now = before + (HOPE if again else 1.0) * laid[0]
                if even and now >= most:
                    continue
                if again or (even and now - FARTHER * leaf.number > first):
                    way = now - FARTHER * leaf.number, depth, rank, next(serial), before if again else now, again, leaf
                    heappush(heap, way)
                    continue
            else:
                now = before
            if self._ends(leaf):
                best, most = (self._told(leaf, even), now), now
                if not now or not even:
                    break
                continue
            key = leaf.number, leaf.end, *map(id, self._late(leaf))
            if key in tried:
                continue
            tried.add(key)
            if not even:
                farthest[leaf.number].append(come)
            for other, late, odd in self._next(leaf, count):
                add(other, now + late, odd)
        return best

    def _behind(self, leaf: _Leaf) -> float:
        """Return what is late after a page, as parts of the next one."""
        late = sum(map(self._needs, leaf.late))
        if leaf.broken is not None:
            view = leaf.views[leaf.broken[0]]
            late = self._needs(view) * (1.0 - leaf.broken[1] / view.pieces)
        return _most(late)

    def _ends(self, leaf: _Leaf) -> bool:
        """Whether nothing comes after a page."""
        return leaf.end == len(self.views) and not leaf.late and leaf.broken is None

    def _next(self, before: _Leaf | None, count: int) -> Iterator[tuple[_Leaf, float, int]]:
        """Go through pages that may follow one, with what they are short of since texts come later than late.

        With each it is told how odd it is that texts are late or break.
        """
        at, own, number = (before.end, self._late(before), before.number + 1) if before else (0, (), 0)
        views, left = self.views, count - number - 1
        needs = {id(view): self._needs(view) for view in (*own, *views[at:])}
        due = next((i for i in range(at, len(views)) if not views[i].pieces), len(views))  # texts of figures before
        begun = any(not view.pieces for view in views[:at])
        for end in range(at + (not own), len(views) + 1):
            stay, after = (*own, *views[at:end]), sum(needs[id(view)] for view in views[end:])
            taken, free = sum(needs[id(view)] for view in stay), [v for v in views[due:end] if v.pieces and not v.of]
            if _most(sum(needs[id(view)] for view in stay if not view.pieces)) > 1.0:
                break
            if self._fewest[end] > left:
                continue
            cost = LATEST * max(0, due - end) * begun
            for late in (some for many in range(LATER + 1) for some in combinations(free, many)):
                gone = sum(needs[id(view)] for view in late)
                if _most(taken - gone) <= 1.0 and _most(after + gone) <= left:
                    yield (
                        _Leaf(number, tuple(view for view in stay if view not in late), end, late, None, before),
                        cost,
                        len(late),
                    )
            for i, view in enumerate(stay):
                # one of several parts breaks where the next one comes on another page
                if not view.pieces or (view.of and view.of in (other.of for other in stay[i + 1 :])):
                    continue
                before_all = i < len(own) + due - at  # it goes on yet later, or is what is given
                if before_all and view.of and _most(needs[id(view)]) < LONG:
                    continue
                for pieces in sorted({round(part * view.pieces) for part in SPLIT}):
                    gone = needs[id(view)] * (1.0 - pieces / view.pieces)
                    if (
                        PIECES <= pieces <= view.pieces - PIECES
                        and _most(taken - gone) <= 1.0
                        and _most(after + gone) <= left
                    ):
                        yield _Leaf(number, stay, end, (), (i, pieces), before), cost, 1 + before_all

    def _parts(self, leaf: _Leaf) -> list[View]:
        """Return what stands on a page of the view that is broken, and the rest of it; nothing if none is."""
        if leaf.broken is None:
            return []
        view, pieces = leaf.views[leaf.broken[0]], leaf.broken[1]
        key, said = (id(view), pieces), "".join(view.heading)
        if key not in self._parted:
            goes_on = said if view.of else self.goes_on.format(heading=said)  # of a part its heading says so already
            ends = (0, pieces, said), (pieces, view.pieces, goes_on)
            self._parted[key] = [part_of(view, *end) for end in ends]
        return self._parted[key]

    def _late(self, leaf: _Leaf) -> tuple[View, ...]:
        return (*leaf.late, *self._parts(leaf)[1:])

    def _laid(self, leaf: _Leaf, even: bool, grown: bool) -> tuple[float, list[Standing]] | None:
        """Return what a page is short of that is to be `even`, and how it is laid out; None if it has no room.

        What has `grown` is short of as little as can be.
        """
        views = [*leaf.views]
        if leaf.broken is not None:
            views[leaf.broken[0]] = self._parts(leaf)[0]
        first = leaf.number == 0
        key = first, even, grown, self._place is on_a_page, *map(id, views)
        if key not in self._found:
            placed = self._place([view.size for view in views], self.sheet, self.norm, begins_of(views), first)
            self._found[key] = None
            if placed is not None:
                page = [*zip(views, placed, strict=True)]
                short = self.short(page, leaf.number) if even and not self._ends(leaf) else 0.0
                self._found[key] = self.grown(page, leaf.number) if grown else (short, page)
        return self._found[key]

    def _told(self, leaf: _Leaf | None, even: bool) -> list[list[Standing]]:
        """Return the pages up to one."""
        if leaf is None:
            return []
        page = self._laid(leaf, even, False)
        if page and page[0]:
            page = self._laid(leaf, even, True)
        return [*self._told(leaf.before, even), *([page[1]] if page else [])]

    def grown(self, page: list[Standing], number: int = 0) -> tuple[float, list[Standing]]:
        """Return what a page is short of at least, and how it is laid out so."""
        views, best = [view for view, _ in page], (self.short(page, number), page)
        if not best[0]:
            return best
        begins, first, nudged = begins_of(views), number == 0, self._nudged(page, number)
        best = self.short(nudged, number), nudged
        for place in (on_a_page, on_one_page):  # in another order only where none as one reads them is even
            least = math.inf  # what had no room
            for again, loose in product(self._written(views, begins), (False, True)):
                if not best[0]:
                    return best
                if (area := _area_of(again)) >= least:
                    continue
                placed = place([view.size for view in again], self.sheet, self.norm, begins, first, loose)
                if placed is None:
                    least = area
                    continue
                other = [*zip(again, placed, strict=True)]
                best = min(best, (self.short(other, number), other), key=lambda way: way[0])
        nudged = self._nudged(best[1], number)
        return min(best, (self.short(nudged, number), nudged), key=lambda way: way[0])

    def short(self, page: Sequence[Standing], number: int) -> float:
        """Return by which part of it a page is too empty, and its largest bare rectangle too large."""
        return sum(self._lacks(page, number)[:2])

    def _lacks(self, page: Sequence[Standing], number: int) -> tuple[float, float, Box]:
        """Return by which part a page is too empty, and its largest bare rectangle too large, and that rectangle."""
        room, boxes = drawing_area(self.sheet, self.norm), [*reserved_boxes(self.sheet, self.norm, first=number == 0)]
        over = OVER * STYLES[self.sheet.letters].heading
        for view, at in page:
            (left, low, right, high), edge = _box_of((view, at)), INK[bool(view.pieces)]
            below = BETWEEN * view.style.text if view.style and view.lines else 0.0  # where no line follows
            boxes.append((left + edge, low + edge + below, right - edge, high - over))
        hole, area = bare(room, boxes), _area([room])
        lacks = ENOUGH[self.sheet.letters] - _area(boxes) / area, _area([hole]) / area - EMPTY
        return max(0.0, lacks[0]), max(0.0, lacks[1]), hole

    def _nudged(self, page: list[Standing], number: int) -> list[Standing]:
        """Return a page with views a little aside, as long as that makes its largest bare rectangle smaller.

        Of two that stand one above the other one goes to the left and one to the right where either alone is no help.
        """
        _, cost, hole = self._lacks(page, number)
        for _ in range(NUDGES * len(page)):
            if not cost:
                break
            ways = [*self._ways(page, number)]
            into = {way for way in ways if _meet(_box_of(page[way[0]]), hole, *way[1:])}
            pairs = ((a, b) for a, b in combinations(ways, 2) if a[0] != b[0] and a[1] * b[1] < 0.0 and {a, b} & into)
            for moves in ([way] for way in ways if way in into), map(list, pairs):
                others = (other for some in moves if (other := self._aside(page, some)))
                found = [(*self._lacks(other, number)[1:], other) for other in others]
                least = min(found, key=lambda way: way[0], default=(cost, hole, page))
                if least[0] < cost:
                    break
            else:
                break
            cost, hole, page = least
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

    def _written(self, views: list[View], begins: Sequence[int]) -> Iterator[list[View]]:
        """Go through the views with larger letters and roomier tables, from many to few.

        Larger letters have all tables and texts, or all texts, or all but those with which the page begins.
        """
        x0, y0, x1, y1 = usable(self.sheet, self.norm)
        parted, lead, wide = any(view.of for view in views), len(_lead(begins)), x1 - x0
        texts = [i for i, view in enumerate(views) if view.style and not view.of and (view.lines or not parted)]
        told = [i for i in texts if not views[i].rows]
        rows = ((0.0, 0.0), *ROWS) if any(view.rows for view in views) else ((0.0, 0.0),)
        for some, by in (*product((texts, told, [i for i in told if i >= lead]), (1.0, 0.0)), ((), 0.0)):
            if _area_of(views) + (GROWN - 1.0) * _area_of(views[i] for i in some) > CROWDED * wide * (y1 - y0):
                continue
            own = self._lettered(views, some, by)
            for row, part in (way for way in rows if not way[1] or not some or some is texts):
                widest = max(part * wide, *(view.size[0] for view in own if view.rows), 0.0)
                again = [self._once(view, widest, row) if row and view.rows else view for view in own]
                taken = sum((view.size[0] + LEAST) * (view.size[1] + LEAST) for view in again)
                if taken < CROWDED * (wide + LEAST) * (y1 - y0 + LEAST):
                    yield again
        figures = [view.size[0] for view, kind in zip(views, begins, strict=True) if kind == FIGURE]
        for left in sorted({wide - LEAST - own for own in figures}):
            if left >= NARROWEST * wide:
                yield [self._once(view, left, 0.0) if view.lines and view.size[0] > left else view for view in views]

    def _lettered(self, views: Sequence[View], some: Sequence[int], wide: float) -> list[View]:
        """Return views of which some have larger letters, in lines as much longer or not."""
        return [self._once(view, -wide, 0.0) if i in some else view for i, view in enumerate(views)]

    def _once(self, view: View, wide: float, row: float) -> View:
        """Return a table with rows so high, a text no wider than that, or, where `wide` is -1 or 0, larger letters."""
        key = id(view), wide, row
        if key not in self._made:
            inner = wide - 2.0 * INK[True]
            changed = (
                roomier(view, inner, row) if row else narrower(view, inner) if wide > 0.0 else larger(view, wide < 0.0)
            )
            self._made[key] = changed
        return self._made[key]


def _box_of(standing: Standing) -> Box:
    """Return the box that a view fills where it stands."""
    view, at = standing
    return at.x, at.y, at.x + view.size[0], at.y + view.size[1]


def _as_read(page: list[Standing], sheet: Format, norm: Norm, first: bool) -> list[Standing]:
    """Return the views of a page at places in reading order, as many from the first one on as can be.

    The others come as on the only page: figures before tables, or high ones before low ones.
    """
    views, count = [view for view, _ in page], len(page)
    begins = begins_of(views)
    for kept in range(count, 1, -max(1, count // KEPT)):
        rest = sorted(range(kept, count), key=lambda i: -views[i].size[1])
        figures = [i for i in range(kept, count) if begins[i] == FIGURE]
        for order in dict.fromkeys(
            ((*range(kept), *figures, *(i for i in rest if i not in figures)), (*range(kept), *rest))
        ):
            sizes, kinds = [views[i].size for i in order], [begins[i] for i in order]
            placed = on_a_page(sizes, sheet, norm, kinds, first)
            if placed is not None:
                return page if kept == count else [(views[i], place) for i, place in zip(order, placed, strict=True)]
    return page


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
    pages: Sequence[list[Standing]],
    scales: Mapping[str, Scale],
    sheet: Format,
    norm: Norm,
    goes_on: str,
    reduction: float = 1.0,
    smaller: bool = False,
    begins: Beginning | None = None,
) -> Drawn:
    """Lay out the pages of `sheet` on which views stand; the last of several may be `smaller`.

    The heading of what `goes_on` from a page before has these words; `begins` is as of `Pages`.
    """
    ways, short = Pages(views, sheet, norm, goes_on, begins or begins_of), 0.0
    if len(pages) == 1:
        places = {id(view): place for view, place in pages[0]}  # of the only page tables may stand at the end
        pages = [ways.grown(_as_read([(view, places[id(view)]) for view in views], sheet, norm, True))[1]]
    elif sheet is FORMATS[sheet.name]:  # on paper for printers there is less room
        pages, short = ways.even(pages)
    sheets, pages = [sheet] * len(pages), [*pages]
    if smaller and len(pages) > 1:
        own = [view for view, _ in pages[-1]]
        for less in takewhile(lambda less: less is not sheet, FORMATS.values()):
            placed = on_one_page([view.size for view in own], less, norm, begins_of(own), first=False)
            if placed is not None:
                sheets[-1], pages[-1] = less, [*zip(own, placed, strict=True)]
                break
    drawn = tuple(tuple(view.at(place.x, place.y) for view, place in page) for page in pages)
    shown = [view for page in pages for view, _ in page]
    whole = {view.name: view for view in shown if not view.of}
    for view in (view for view in views if view.of):  # what came in parts
        whole[view.of] = after(whole[view.of], view) if view.of in whole else replace(view, of="")
    begun = (view for view in views if view.of in ("", view.name))
    every_one = (*(whole.get(view.name, view) for view in begun), *(view for view in shown if view.of))
    return Drawn(every_one, drawn, scales, tuple(sheets), norm, reduction, short=short)


def _meet(a: Box, b: Box, x: float, y: float) -> bool:
    """Whether a box meets another one as soon as it is moved."""
    return a[0] + x < b[2] and b[0] < a[2] + x and a[1] + y < b[3] and b[1] < a[3] + y


def _most(needs: complex) -> float:
    """Return the greater of what views need of the area and of the height of a page."""
    return max(needs.real, needs.imag)


def _area(boxes: Iterable[Box]) -> float:
    return sum((x1 - x0) * (y1 - y0) for x0, y0, x1, y1 in boxes)


def _area_of(views: Iterable[View]) -> float:
    return sum(math.prod(view.size) for view in views)
