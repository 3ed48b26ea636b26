"""Views on a page: cut by straight lines into columns and rows, in reading order, clear of the reserved corners.

A page is cut in two from top to bottom or from side to side, each part again, until every view has a part of its own;
what comes first stands on the left of a cut, or above it. For each run of views that follow one another a table has the
least height that it needs at every width, and the least width at every height: a run is the best of all ways to cut it
in two. So all ways to lay a page out are looked at, and the cost grows with the cube of the number of views alone.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import pairwise, product
from typing import TYPE_CHECKING, TypeAlias

from .text import Box

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

Size: TypeAlias = tuple[float, float]
STEPS = 300  # of the grid on the width and on the height of a page
MOST_BANDS = 3  # of columns that stand one under another on a page
NEVER = 9999  # more steps than any page has
LEAST = 3.0  # mm between views; what the grid adds to it is shared out
UNDER = 10.0  # mm at most between column 26 and what stands under it
APART = 50.0, 120.0  # mm between columns of a page at which its edges share in what is left
SLACK = 1e-9  # mm, for rounding


@dataclass(frozen=True, slots=True)
class Placement:
    """Where a view stands: its page from 0, its lower left corner in mm (y up)."""

    page: int
    x: float
    y: float


@dataclass(frozen=True, slots=True)
class _Cut:
    """Parts of a page side by side from the left (`beside`) or one under another; a view is a part by its number."""

    parts: tuple[_Cut | int, ...]
    beside: bool

    def size(self, sizes: Sequence[Size]) -> Size:
        """Return the width and the height that its views need."""
        wide, high = zip(*(_size_of(part, sizes) for part in self.parts), strict=True)
        gaps = LEAST * (len(self.parts) - 1)
        return (sum(wide) + gaps, max(high)) if self.beside else (max(wide), sum(high) + gaps)


def _size_of(part: _Cut | int, sizes: Sequence[Size]) -> Size:
    """Return the width and the height of a part of a page."""
    return sizes[part] if isinstance(part, int) else part.size(sizes)


def inset(part: _Cut | int, sizes: Sequence[Size], wide: float) -> float:
    """Return how far columns on a page that is so wide keep from its edges, mm: where much is left between them.

    Where yet more is left, a text under a figure must not come nearer to that of the next column.
    """
    if isinstance(part, int) or not part.beside:
        return 0.0
    free, count = wide - sum(_size_of(one, sizes)[0] for one in part.parts), len(part.parts)
    return 0.5 * free / count if APART[0] < free / (count - 1) < APART[1] else 0.0


def spread(
    part: _Cut | int,
    sizes: Sequence[Size],
    corner: Size,
    room: Size,
    last: int = -1,
    first: int = -1,
    loose: bool = False,
) -> Iterator[tuple[int, float, float]]:
    """Go through the views of a part with their lower left corners; `corner` is the upper left one of its `room`.

    What is left empty is shared out evenly between parts; a view hangs from the top of its room, in the middle of its
    width; the `last` one stands in the lower right corner, and what alone is under the `first` one close to it. In a
    `loose` layout what is left is shared out among the parts themselves, and a view hangs in the middle of its room.
    """
    (x, y), (wide, high) = corner, room
    if isinstance(part, int):
        own = sizes[part]
        if part == last:
            yield part, x + wide - own[0], y - high
        else:
            yield part, x + 0.5 * (wide - own[0]), y - (0.5 * (high + own[1]) if loose and part != first else own[1])
        return
    inner = [_size_of(one, sizes) for one in part.parts]
    free = (wide if part.beside else high) - sum(size[not part.beside] for size in inner)
    between, more = free / (len(inner) - 1), 0.0
    if loose:
        grown = sum(one != first for one in part.parts)
        between, more = LEAST, (free - LEAST * (len(inner) - 1)) / grown
    if not part.beside and part.parts[0] == first and len(inner) == 2:
        between = min(between, UNDER)
    for one, size in zip(part.parts, inner, strict=True):
        own_wide, own_high = size[0] + more * (one != first), size[1] + more * (one != first)
        yield from spread(one, sizes, (x, y), (own_wide, high) if part.beside else (wide, own_high), last, first, loose)
        if part.beside:
            x += own_wide + between
        else:
            y -= own_high + between


def bare(room: Box, taken: Sequence[Box]) -> float:
    """Return the area of the largest rectangle in a room that none of the boxes touches, mm^2."""
    x0, y0, x1, y1 = room
    best, low = 0.0, sorted(taken, key=lambda box: box[1])
    for left, right in product({x0, *(box[2] for box in taken)}, {x1, *(box[0] for box in taken)}):
        if (right - left) * (y1 - y0) > best:
            top = y0
            for box in (*(box for box in low if box[0] < right and box[2] > left), (x0, y1, x1, y1)):
                best, top = max(best, (right - left) * (box[1] - top)), max(top, box[3])
    return best


@dataclass(slots=True)
class Slicing:
    """All ways to cut a room of width and height `room`, mm, for views of these `sizes` in order.

    `bonds` say before each view but the first how much it belongs to the one before: a cut goes where that is least.
    Where it is said which are `figures`, these stand in columns, no two of them side by side in one: all columns beside
    each other, or some under others.
    """

    sizes: Sequence[Size]
    room: Size
    bonds: Sequence[int] = ()
    figures: Sequence[bool] = ()
    # by how many views: the least heights by the first view and the width, the least widths by it and the height; of
    # all ways, of one column, of columns side by side
    _tables: list[NDArray[np.int16]] = field(init=False)
    _column: list[NDArray[np.int16]] = field(init=False)
    _columns: list[NDArray[np.int16]] = field(init=False)

    def __post_init__(self) -> None:
        """Fill the tables, from runs of one view on."""
        import numpy as np

        n = len(self.sizes)
        one = np.full((2, n, STEPS + 1), NEVER, np.int16)
        for i, size in enumerate(self.sizes):
            sides = zip(size, self.room, strict=True)
            wide, high = (math.ceil(STEPS * (side + LEAST) / (most + LEAST) - SLACK) for side, most in sides)
            one[0, i, wide:], one[1, i, high:] = min(high, NEVER), min(wide, NEVER)
        self._tables, self._column, self._columns = ([one[:, :0], one] for _ in range(3))
        for long in range(2, n + 1):
            least = _in_two(self._tables, n - long + 1)
            self._tables.append(_either_way(least))
            if not self.figures:
                continue
            alone = np.array([sum(self.figures[i : i + long]) < 2 for i in range(n - long + 1)])[:, None]
            under = _in_two(self._column, n - long + 1)
            under[1] = NEVER
            self._column.append(np.where(alone, self._tables[long], _either_way(under)))
            beside = _in_two(self._columns, n - long + 1)
            beside[0] = NEVER
            self._columns.append(np.minimum(self._column[long], _either_way(beside)))
        if not self.figures:
            self._column = self._columns = self._tables

    @property
    def high(self) -> int:
        """How many steps of its height all views need at its whole width, `STEPS` being all of them."""
        return self._bands()[0]

    def _bands(self) -> tuple[int, tuple[int, ...]]:
        """Return how many steps of its height all need in bands of columns one under another, and where these end.

        They are as few as have room; where nothing is said of figures there is but one.
        """
        count = len(self.sizes)
        one = [int(self._columns[j][0, 0, STEPS]) for j in range(1, count + 1)]
        best: list[tuple[int, tuple[int, ...]]] = [(0, ()), *((high, (j,)) for j, high in enumerate(one, start=1))]
        for _ in range(MOST_BANDS - 1 if self.figures else 0):
            if best[-1][0] <= STEPS:
                break
            more = (
                min((best[i][0] + int(self._columns[j - i][0, i, STEPS]), (*best[i][1], j)) for i in range(1, j))
                for j in range(2, count + 1)
            )
            best = [*best[:2], *map(min, best[2:], more)]
        return best[-1]

    @property
    def fits(self) -> bool:
        """Whether the room holds all views."""
        return bool(self.sizes) and self.high <= STEPS

    def cut(self) -> _Cut | int:
        """Return one way to cut the room, where it holds all views."""
        high, ends = self._bands()
        spare = (STEPS - high) // len(ends)
        each = [(i, j, int(self._columns[j - i][0, i, STEPS]) + spare) for i, j in pairwise((0, *ends))]
        first, *others = (self._cut(i, j, STEPS, own) for i, j, own in each)
        return (
            _Cut(tuple(part for band in (first, *others) for part in _parts(band, False)), False) if others else first
        )

    def _cut(self, i: int, j: int, wide: int, high: int) -> _Cut | int:
        """Return how a part of the room is cut for a run of views: where bonds are least, then where room is left."""
        if j == i + 1:
            return i
        alone = sum(self.figures[i:j]) < 2
        column = int(self._column[j - i][0, i, wide]) <= high
        best: tuple[float, float, bool, int, int, int] = (math.inf, 0.0, False, 0, 0, 0)
        for k in range(i + 1, j):
            bond = self.bonds[k] if self.bonds else 0
            for beside, most, room in ((True, high, wide), (False, wide, high)):
                if not alone and beside is column:
                    continue
                tables = self._tables if alone else self._columns if beside else self._column
                first, second = (int(tables[b - a][int(beside), a, most]) for a, b in ((i, k), (k, j)))
                if first + second <= room:
                    best = min(best, (bond, (first + second) / room, not beside, k, first, second))
        _, _, under, k, first, second = best
        spare = ((high if under else wide) - first - second) // 2
        if under:
            parts = self._cut(i, k, wide, first + spare), self._cut(k, j, wide, high - first - spare)
        else:
            parts = self._cut(i, k, first + spare, high), self._cut(k, j, wide - first - spare, high)
        return _Cut(tuple(part for own in parts for part in _parts(own, not under)), not under)


def _parts(part: _Cut | int, beside: bool) -> tuple[_Cut | int, ...]:
    """Return the parts of a part of the page that is cut alike, else it alone."""
    return part.parts if isinstance(part, _Cut) and part.beside is beside else (part,)


def _either_way(least: NDArray[np.int16]) -> NDArray[np.int16]:
    """Return the least of each side by the other one: a row is as high as its width allows, and the other way about."""
    import numpy as np

    return np.minimum(least, _turned(least)[::-1])  # what is least never rises


def _in_two(tables: Sequence[NDArray[np.int16]], count: int) -> NDArray[np.int16]:
    """Return the least of all ways to cut each of the next longer runs, so many, in two."""
    import numpy as np

    long = len(tables)
    least: NDArray[np.int16] = tables[1][:, :count] + tables[-1][:, 1 : 1 + count]
    for k in range(2, long):
        np.minimum(least, tables[k][:, :count] + tables[long - k][:, k : k + count], out=least)
    return least


def _turned(least: NDArray[np.int16]) -> NDArray[np.int16]:
    """Return by every number of steps of one side how few of the other one there may be; `least` is that the other way.

    It never rises along a row: at each step it falls from so many of the other side to so many, at which that step is
    the first. Counted from the most of the other side down, and turned round.
    """
    import numpy as np

    rows = np.zeros((*least.shape[:-1], STEPS + 3), np.int16)
    rows[..., 0] = STEPS + 1
    np.minimum(least, STEPS + 1, out=rows[..., 1:-1])
    falls, steps = rows[..., :-1] - rows[..., 1:], np.append(np.arange(STEPS + 1, dtype=np.int16), np.int16(NEVER))
    first = np.repeat(np.broadcast_to(steps, falls.shape).ravel(), falls.ravel())
    return first.reshape(least.shape)[..., ::-1]
