"""Areas and curves: hatching of areas, lines in and beside boxes; curves as broken lines, and where they are freest."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from math import hypot

import numpy as np

from .shapes import Group, Line, Pen, Polyline, Shape
from .text import Box

SLACK = 1e-9  # mm
Side = tuple[complex, float]  # unit normal into the area, its least component
SHORTEST = 0.3  # mm: a shorter stroke would be a dot
FEW = 8  # points of a line that is left as it is
FAR = 1e6 + 0j  # mm


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


def coarser(shape: Shape, within: float) -> Shape:
    """Return a shape with its curves as broken lines of few points, none of them further than `within` mm away."""
    match shape:
        case Polyline(points=points) if len(points) > FEW:
            return replace(shape, points=thinned(points, within))
        case Group(shapes=parts):
            return replace(shape, shapes=tuple(coarser(part, within) for part in parts))
        case _:
            return shape


def thinned(points: Sequence[complex], within: float) -> tuple[complex, ...]:
    """Return as few of these points as keep the line through them within so many mm (Douglas and Peucker)."""
    line, kept = np.array(points), np.zeros(len(points), dtype=bool)
    kept[[0, -1]] = True
    open_parts = [(0, len(points) - 1)]
    while open_parts:
        a, b = open_parts.pop()
        between, chord = line[a + 1 : b] - line[a], line[b] - line[a]
        if not len(between):
            continue
        away = np.abs((between * chord.conjugate()).imag) / abs(chord) if chord else np.abs(between)
        k = int(np.argmax(away))
        if away[k] > within:
            kept[a + 1 + k] = True
            open_parts += [(a, a + 1 + k), (a + 1 + k, b)]
    result: tuple[complex, ...] = tuple(line[kept].tolist())
    return result


def freest(curves: Sequence[Sequence[complex]], step: float, each: float) -> Iterator[tuple[int, complex, complex]]:
    """Go through places where curves are far from one another: the curve, the place, its direction there.

    They are looked for `step` mm apart; a curve has one such place for `each` mm of it, and one more.
    """
    dense = [_dense(curve, step) for curve in curves]
    for n, places in enumerate(dense):
        others = np.array([place for m, found in enumerate(dense) if m != n for place in found] or [FAR])
        own = np.array(places)
        room = np.min(np.abs(own[:, np.newaxis] - others[np.newaxis, :]), axis=1)
        room[[0, -1]] = -1.0  # not at the ends
        for _ in range(1 + int(len(places) / (each / step))):
            k = int(np.argmax(room))
            along = places[min(k + 1, len(places) - 1)] - places[max(k - 1, 0)]
            yield n, places[k], along / abs(along)
            room = np.minimum(room, np.abs(own - own[k]) - 0.5 * each)


def _dense(curve: Sequence[complex], step: float) -> list[complex]:
    """Return places along a curve, equally far apart, three at least."""
    reach = np.concatenate(([0.0], np.cumsum(np.abs(np.diff(curve)))))
    at = np.linspace(0.0, reach[-1], max(3, int(reach[-1] / step)))
    places: list[complex] = (np.interp(at, reach, np.real(curve)) + 1j * np.interp(at, reach, np.imag(curve))).tolist()
    return places
