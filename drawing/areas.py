"""Areas: hatching of one that a closed line bounds, and of one that half planes bound; lines in and beside boxes."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from math import hypot

from .shapes import Group, Line, Pen
from .text import Box

SLACK = 1e-9  # mm
Side = tuple[complex, float]  # unit normal into the area, its least component
SHORTEST = 0.3  # mm: a shorter stroke would be a dot


def strokes(outline: Sequence[complex], along: complex, apart: float) -> list[Line]:
    """Return lines in the unit direction `along`, so far apart, over the area inside of a closed line.

    Where the line crosses itself every part counts that an odd number of its sides surrounds.
    """
    turned = [point * along.conjugate() for point in outline]  # the strokes level
    sides = list(zip(turned, turned[1:] + turned[:1], strict=True))
    low, high = min(p.imag for p in turned), max(p.imag for p in turned)
    first = int(low // apart) + 1  # strokes of areas side by side lie in one line
    found = []
    for level in (k * apart for k in range(first, int(high // apart) + 1)):
        cuts = sorted(
            a.real + (b.real - a.real) * (level - a.imag) / (b.imag - a.imag)
            for a, b in sides
            if (a.imag < level) != (b.imag < level)
        )
        ends = zip(cuts[::2], cuts[1::2], strict=True)
        found += [(complex(x, level) * along, complex(y, level) * along) for x, y in ends if y - x > SHORTEST]
    return [Line(a, b, Pen.THIN, role="hatch") for a, b in found]


def hatched(sides: Sequence[Side], box: Box, apart: float, name: str) -> Group:
    """Return strokes at 45 degrees over the part of a box that lies inside of all `sides`."""
    x0, y0, x1, y1 = box
    frame: list[Side] = [(1 + 0j, x0), (-1 + 0j, -x1), (1j, y0), (-1j, -y1)]
    along = complex(1.0, 1.0) / 2**0.5
    across = along * 1j
    corners = [complex(x, y) for x in (x0, x1) for y in (y0, y1)]
    reach = [(corner * across.conjugate()).real for corner in corners]
    count = int((max(reach) - min(reach)) / apart)
    lines = (across * (min(reach) + (k + 0.5) * apart) for k in range(count))
    return Group(tuple(_within(lines, along, [*frame, *sides], hypot(x1 - x0, y1 - y0))), "permitted", name)


def _within(lines: Iterable[complex], along: complex, sides: Sequence[Side], reach: float) -> Iterator[Line]:
    """Go through the parts of lines, through points along a direction, that lie inside of all sides."""
    for point in lines:
        low, high = -1e3 * reach, 1e3 * reach
        for normal, least in sides:
            slope = (normal.conjugate() * along).real
            lack = least - (normal.conjugate() * point).real
            if abs(slope) < SLACK:
                low = high if lack > 0.0 else low
            elif slope > 0.0:
                low = max(low, lack / slope)
            else:
                high = min(high, lack / slope)
        if high - low > SLACK * reach:
            yield Line(point + along * low, point + along * high, Pen.THIN, role="hatch")


def clipped(a: complex, b: complex, box: Box) -> tuple[complex, complex] | None:
    """Return the part of the line from `a` to `b` inside of a box (Liang and Barsky), None when there is none."""
    x0, y0, x1, y1 = box
    low, high, way = 0.0, 1.0, b - a
    for start, step, least, most in ((a.real, way.real, x0, x1), (a.imag, way.imag, y0, y1)):
        if abs(step) < 1e-12:
            if not least <= start <= most:
                return None
            continue
        first, last = sorted(((least - start) / step, (most - start) / step))
        low, high = max(low, first), min(high, last)
    return (a + way * low, a + way * high) if low <= high else None


def beside(a: complex, b: complex, boxes: Sequence[Box]) -> Iterator[tuple[complex, complex]]:
    """Go through the pieces of a line from `a` to `b` that lie outside of all boxes, or on their sides."""
    inside = ((clipped(a, b, box), box) for box in boxes)
    start, gaps = a, (ends for ends, box in inside if ends and _within_sides(0.5 * (ends[0] + ends[1]), box))
    for first, last in sorted(gaps, key=lambda gap: abs(gap[0] - a)):
        if abs(first - a) > abs(start - a):
            yield start, first
        start = max(start, last, key=lambda place: abs(place - a))
    if abs(b - a) > abs(start - a):
        yield start, b


def _within_sides(place: complex, box: Box) -> bool:
    return box[0] < place.real < box[2] and box[1] < place.imag < box[3]
