"""Customary arrangements of a page: rows and columns of views within one another, laid out by hand, spread evenly."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from .formats import Format, reserved_boxes, usable
from .packing import Placement
from .pens import Norm
from .rows import SLACK, Size
from .view import View

Place: TypeAlias = tuple[str, float, float]  # of a view: its name, its lower left corner


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


def nested(nest: Nest, sizes: Mapping[str, Size], room: Size, gap: float) -> list[Place] | None:
    """Return where each view of a nest stands in a room whose lower left corner is (0, 0); None if it is too small."""
    wide, high = _size(nest, sizes, gap)
    if wide > room[0] + SLACK or high > room[1] + SLACK:
        return None
    return list(_placed(nest, sizes, (0.0, room[1]), room, gap))


def _size(part: Nest | str, sizes: Mapping[str, Size], gap: float) -> Size:
    if isinstance(part, str):
        return sizes.get(part, (0.0, 0.0))
    inner = [size for size in (_size(one, sizes, gap) for one in part.parts) if size != (0.0, 0.0)]
    if not inner:
        return 0.0, 0.0
    widths, heights = [size[0] for size in inner], [size[1] for size in inner]
    gaps = gap * (len(inner) - 1)
    return (sum(widths) + gaps, max(heights)) if part.beside else (max(widths), sum(heights) + gaps)


def _placed(
    part: Nest | str, sizes: Mapping[str, Size], corner: tuple[float, float], room: Size, gap: float
) -> Iterator[Place]:
    """Go through the views of a part in a room with this upper left corner; a view stands in the middle of its room."""
    (x, y), (wide, high) = corner, room
    if isinstance(part, str):
        own = sizes[part]
        yield part, x + 0.5 * (wide - own[0]), y - 0.5 * (high + own[1])
        return
    inner = [(one, size) for one in part.parts if (size := _size(one, sizes, gap)) != (0.0, 0.0)]
    needed = sum(size[not part.beside] for _, size in inner)
    spaces = max(len(inner) - 1, 1)
    between = ((wide if part.beside else high) - needed) / spaces
    if len(inner) == 1:
        yield from _placed(inner[0][0], sizes, corner, room, gap)
        return
    for one, size in inner:
        yield from _placed(one, sizes, (x, y), (size[0], high) if part.beside else (wide, size[1]), gap)
        if part.beside:
            x += size[0] + between
        else:
            y -= size[1] + between


def names(parts: Sequence[Nest | str]) -> Iterator[str]:
    """Go through the names of the views of parts."""
    for part in parts:
        yield from (part,) if isinstance(part, str) else names(part.parts)


BLOCK, TURNED = "block", "turned"  # the title block below the last column, column 26 above the first one
GAP = 4.0  # mm between views


def zoned(layouts: Sequence[Nest], views: Sequence[View], sheet: Format, norm: Norm) -> list[Placement] | None:
    """Return the places of the views on one page by the first layout with room for them all; None if none has."""
    x0, y0, x1, y1 = usable(sheet, norm)
    block, *turned = reserved_boxes(sheet, norm)
    sizes = {view.name: view.size for view in views}
    fitting = [nest for nest in layouts if sizes.keys() <= set(names((nest,)))]
    sizes[BLOCK] = x1 - block[0], block[3] - y0
    for box in turned:
        sizes[TURNED] = box[2] - x0, y1 - box[1]
    tried = (nested(layout, sizes, (x1 - x0, y1 - y0), GAP) for layout in fitting)
    found = next((places for places in tried if places is not None), None)
    if found is None:
        return None
    places = {name: Placement(0, x0 + x, y0 + y) for name, x, y in found}
    return [places[view.name] for view in views]
