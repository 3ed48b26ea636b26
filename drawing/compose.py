"""Composing a sheet: views on pages, in rows, halves, parts or arrangements laid out by hand; frames round them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TypeAlias

from ..scales.scale import Scale
from .formats import GAPS, Format, Norm, reserved_boxes, usable
from .packing import Placement, pack
from .page import Page
from .rows import SLACK, Size
from .shapes import Group
from .titleblock import Stamp, frame_shapes
from .view import View

BLOCK, TURNED = "block", "turned"  # the title block below the last column, column 26 above the first one
GAP = 4.0  # mm between views that are laid out by hand
Place: TypeAlias = tuple[str, float, float]  # of a view: its name, its lower left corner
SHARES = (0.0, 0.02, -0.02, 0.04, -0.04, 0.06, -0.06, 0.09, -0.09)  # of the width, by which halves may be unequal


def arrange(
    sizes: Sequence[Size], sheet: Format, norm: Norm, pages: int | None, any_order: bool = False, first: bool = True
) -> list[Placement] | None:
    """Place views of these sizes, in reading order, on at most `pages` pages of `sheet`, or on as many as they need.

    Where they do not fit so, a single page may have them in `any_order`. Without `first` all are following pages.
    None if they do not fit.
    """
    return pack(
        sizes,
        usable(sheet, norm),
        reserved_boxes(sheet, norm, first=first),
        later=reserved_boxes(sheet, norm, first=False),
        gap=GAPS[sheet.letters],
        pages=pages,
        any_order=any_order,
    )


def arrange_closely(sizes: Sequence[Size], sheet: Format, norm: Norm) -> list[Placement] | None:
    """Place views on pages one after the other: on each those that have room beside the ones before, in any order.

    None if one has no room on a page.
    """
    places: dict[int, Placement] = {}
    page = 0
    while len(places) < len(sizes):
        own: list[int] = []
        found: list[Placement] = []
        for i in range(len(sizes)):
            if i in places:
                continue
            tried = arrange([sizes[k] for k in (*own, i)], sheet, norm, 1, any_order=True, first=not page)
            if tried is not None:
                own, found = [*own, i], tried
        if not own:
            return None
        places |= {i: replace(place, page=page) for i, place in zip(own, found, strict=True)}
        page += 1
    return [places[i] for i in range(len(sizes))]


def arrange_parts(parts: Sequence[Sequence[Size]], sheet: Format, norm: Norm) -> list[Placement] | None:
    """Place views on as many pages as they need, each part on pages of its own where that takes no more of them."""
    together = arrange([size for part in parts for size in part], sheet, norm, None)
    places: list[Placement] = []
    for part in filter(None, parts):
        pages = max((place.page + 1 for place in places), default=0)
        own = arrange(part, sheet, norm, None, first=not pages)
        if own is None:
            return together
        places += [replace(place, page=place.page + pages) for place in own]
    if together is None or max(p.page for p in places) <= max(p.page for p in together):
        return places
    return together


def arrange_halves(sizes: Sequence[Size], boundary: int, sheet: Format, norm: Norm) -> list[Placement] | None:
    """Place views on one page: those before about the `boundary` in its left part, the others in the right one."""
    (x0, y0, x1, y1), taken, gap = usable(sheet, norm), reserved_boxes(sheet, norm), GAPS[sheet.letters]
    areas = [(wide + gap) * (high + gap) for wide, high in sizes]
    for end in (end for end in (boundary, boundary + 1, boundary - 1) if 0 < end < len(sizes)):
        for share in SHARES:
            middle = x0 + (sum(areas[:end]) / sum(areas) + share) * (x1 - x0)
            left, right = (x0, y0, middle - gap / 2, y1), (middle + gap / 2, y0, x1, y1)
            if min(left[2] - x0, x1 - right[0]) < max(wide for wide, _ in sizes):
                continue
            places: list[Placement] = []
            for part, box in ((sizes[:end], left), (sizes[end:], right)):
                own = [block for block in taken if block[0] < box[2] and block[2] > box[0]]
                places += pack(part, box, own, gap=gap, any_order=False) or []
            if len(places) == len(sizes):
                return places
    return None


@dataclass(frozen=True, slots=True)
class Drawn:
    """A sheet but for its title block: views in order of the work, and at their places, by page.

    `scales` are the scale factors that it has, by plan. `reduction` is what a millimetre of a drawing is there whose
    lengths on paper the task has given.
    """

    views: tuple[View, ...]
    placed: tuple[tuple[Group, ...], ...]
    scales: Mapping[str, Scale]
    sheet: Format
    norm: Norm
    reduction: float = 1.0

    @property
    def format(self) -> str:
        """The name of its format."""
        return self.sheet.name

    def pages(self, stamp: Stamp) -> tuple[Page, ...]:
        """Return the finished pages: frame, title block and the views at their places.

        Raises InputError: the title block cannot hold its words.
        """
        sheet, pages = self.sheet, []
        for number, figures in enumerate(self.placed):
            own = replace(stamp, sheet=number + 1, sheets=len(self.placed))
            frame = frame_shapes(sheet, own, self.norm, first=number == 0)
            pages.append(Page(sheet.width, sheet.height, (*frame, *figures), stamp.title, stamp.language, self.norm))
        return tuple(pages)


def compose(
    views: Sequence[View],
    places: Sequence[Placement],
    scales: Mapping[str, Scale],
    sheet: Format,
    norm: Norm,
    reduction: float = 1.0,
) -> Drawn:
    """Set views at their places on the pages of `sheet`."""
    pages: list[list[Group]] = [[] for _ in range(max(place.page for place in places) + 1)]
    for view, place in zip(views, places, strict=True):
        pages[place.page].append(view.at(place.x, place.y))
    return Drawn(tuple(views), tuple(map(tuple, pages)), scales, sheet, norm, reduction)


@dataclass(frozen=True, slots=True)
class Nest:
    """Views, or further nests, side by side from the left (`beside`) or one under another from the top.

    The first and the last stand at the ends of the room, the others evenly between them; what is not among the views
    is left out.
    """

    parts: tuple[Nest | str, ...]
    beside: bool = False


def row(*parts: Nest | str) -> Nest:
    """Return parts side by side."""
    return Nest(parts, beside=True)


def column(*parts: Nest | str) -> Nest:
    """Return parts one under another."""
    return Nest(parts)


def _size(part: Nest | str, sizes: Mapping[str, Size]) -> Size:
    if isinstance(part, str):
        return sizes.get(part, (0.0, 0.0))
    inner = [size for size in (_size(one, sizes) for one in part.parts) if size != (0.0, 0.0)]
    if not inner:
        return 0.0, 0.0
    widths, heights = [size[0] for size in inner], [size[1] for size in inner]
    gaps = GAP * (len(inner) - 1)
    return (sum(widths) + gaps, max(heights)) if part.beside else (max(widths), sum(heights) + gaps)


def _placed(part: Nest | str, sizes: Mapping[str, Size], corner: tuple[float, float], room: Size) -> Iterator[Place]:
    """Go through the views of a part in a room with this upper left corner; a view stands in the middle of its room."""
    (x, y), (wide, high) = corner, room
    if isinstance(part, str):
        own = sizes[part]
        yield part, x + 0.5 * (wide - own[0]), y - 0.5 * (high + own[1])
        return
    inner = [(one, size) for one in part.parts if (size := _size(one, sizes)) != (0.0, 0.0)]
    needed = sum(size[not part.beside] for _, size in inner)
    spaces = max(len(inner) - 1, 1)
    between = ((wide if part.beside else high) - needed) / spaces
    if len(inner) == 1:
        yield from _placed(inner[0][0], sizes, corner, room)
        return
    for one, size in inner:
        yield from _placed(one, sizes, (x, y), (size[0], high) if part.beside else (wide, size[1]))
        if part.beside:
            x += size[0] + between
        else:
            y -= size[1] + between


def names(parts: Sequence[Nest | str]) -> Iterator[str]:
    """Go through the names of the views of parts."""
    for part in parts:
        yield from (part,) if isinstance(part, str) else names(part.parts)


def zoned(layouts: Sequence[Nest], views: Sequence[View], sheet: Format, norm: Norm) -> list[Placement] | None:
    """Return the places of the views on one page by the first layout with room for them all; None if none has."""
    x0, y0, x1, y1 = usable(sheet, norm)
    block, *turned = reserved_boxes(sheet, norm)
    sizes = {view.name: view.size for view in views}
    fitting = [nest for nest in layouts if sizes.keys() <= set(names((nest,)))]
    sizes[BLOCK] = x1 - block[0], block[3] - y0
    for box in turned:
        sizes[TURNED] = box[2] - x0, y1 - box[1]
    room = x1 - x0, y1 - y0
    for nest in fitting:
        wide, high = _size(nest, sizes)
        if wide <= room[0] + SLACK and high <= room[1] + SLACK:
            places = {name: Placement(0, x0 + x, y0 + y) for name, x, y in _placed(nest, sizes, (0.0, room[1]), room)}
            return [places[view.name] for view in views]
    return None
