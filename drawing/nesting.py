"""A page laid out by hand: rows and columns of views within one another, spread evenly over the room that they have."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from .rows import SLACK, Size

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
