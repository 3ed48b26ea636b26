"""Areas and curves: hatching of areas, lines in and beside boxes; curves as broken lines, and where they are freest."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import lru_cache, reduce
from itertools import pairwise
from typing import Any, TypeAlias

import numpy as np
import shapely
from numpy.typing import ArrayLike, NDArray

from .shapes import Arc, Group, Line, Pen, Polyline, Shape, changed
from .text import Box

Shapes: TypeAlias = NDArray[Any]  # of shapely
SLACK = 1e-9  # mm
HAIR = 0.1  # mm
Side = tuple[complex, float]  # unit normal into the area, its least component
SHORTEST = 0.3  # mm: a shorter stroke would be a dot
STEP = 0.25  # mm along an arc between places at which it may break off
FEW = 8  # points of a line that is left as it is
FAR = shapely.Point(1e6, 0.0)  # mm


def pairs(places: ArrayLike) -> NDArray[np.float64]:
    """Return complex places as pairs of coordinates, shape (..., 2), as shapely takes them."""
    return np.ascontiguousarray(places, dtype=complex)[..., np.newaxis].view(float)


def lines(a: ArrayLike, b: ArrayLike) -> Shapes:
    """Return straight lines from places `a` to places `b`, each of which may be a point."""
    found: Shapes = shapely.linestrings(pairs(np.stack((a, b), axis=-1)))
    return found


def _pieces(found: Shapes, along: complex, shortest: float) -> list[tuple[complex, complex]]:
    """Return the ends of what is left of parallel lines, each piece in the direction `along`, those of a line so, too.

    Pieces that are not longer than `shortest` are left out.
    """
    parts, of = shapely.get_parts(found, return_index=True)
    long = shapely.length(parts) > shortest
    parts, of = parts[long], of[long]
    ends = shapely.get_coordinates(shapely.get_point(parts[:, np.newaxis], [0, -1])).view(complex).reshape(-1, 2)
    ends = np.take_along_axis(ends, np.argsort((ends * np.conj(along)).real, axis=1), axis=1)
    order = np.lexsort(((ends[:, 0] * np.conj(along)).real, of))
    return [(a, b) for a, b in ends[order].tolist()]


def _hatch(area: shapely.Geometry, levels: NDArray[np.float64], along: complex, shortest: float) -> list[Line]:
    """Return strokes over an area, on lines in a unit direction that have these levels across it."""
    across, reach = along * 1j * levels, along * float(np.abs(shapely.total_bounds(area)).sum())
    found = shapely.intersection(lines(across - reach, across + reach), area)
    return [Line(a, b, Pen.THIN, role="hatch") for a, b in _pieces(found, along, shortest)]


def strokes(outline: Sequence[complex], along: complex, apart: float) -> list[Line]:
    """Return lines in the unit direction `along`, so far apart, over the area inside of a closed line.

    Where the line crosses itself every part counts that an odd number of its sides surrounds. Strokes of areas side by
    side lie in one line.
    """
    levels = (np.array(outline) * np.conj(along)).imag // apart
    area = shapely.make_valid(shapely.Polygon(pairs(outline)))
    return _hatch(area, np.arange(levels.min() + 1.0, levels.max() + 1.0) * apart, along, SHORTEST)


def hatched(sides: Sequence[Side], box: Box, apart: float, name: str) -> Group:
    """Return strokes at 45 degrees over the part of a box that lies inside of all `sides`."""
    frame, along = shapely.box(*box), (1.0 + 1.0j) / 2**0.5
    corners = shapely.get_coordinates(frame).view(complex)
    far = 2.0 * float(np.max(np.abs(corners))) + max((abs(least) for _, least in sides), default=0.0)
    halves = (
        shapely.Polygon(pairs(normal * (least + far * np.array([1j, -1j, 2 - 1j, 2 + 1j])))) for normal, least in sides
    )
    reach = (corners * np.conj(along)).imag
    levels = reach.min() + (np.arange(int(np.ptp(reach) / apart)) + 0.5) * apart
    area = reduce(shapely.intersection, halves, frame)
    return Group(() if area.is_empty else tuple(_hatch(area, levels, along, SLACK)), "permitted", name)


def clipped(a: complex, b: complex, box: Box) -> tuple[complex, complex] | None:
    """Return the part of the line from `a` to `b` inside of a box, None when there is none."""
    line = lines(a, b) if a != b else shapely.points(pairs(a))
    part = shapely.get_coordinates(shapely.intersection(line, shapely.box(*box))).view(complex).ravel()
    ends = sorted(part.tolist(), key=lambda place: abs(place - a))
    return (ends[0], ends[-1]) if ends else None


def beside(a: complex, b: complex, boxes: Sequence[Box]) -> list[tuple[complex, complex]]:
    """Return the pieces of a line from `a` to `b` that lie outside of all boxes, or on their sides.

    No end is cut off that lies inside of a box by less than `HAIR`: an arm is as long as it says.
    """
    whole, area = lines([a], [b]), _inside(tuple(boxes))
    if not shapely.intersects(area, whole[0]):  # by far faster than what is left of it
        return [(a, b)] if abs(b - a) > SLACK else []
    pieces = _pieces(shapely.difference(whole, area), b - a, 2 * SLACK)
    if pieces and abs(pieces[0][0] - a) < HAIR:
        pieces[0] = a, pieces[0][1]
    if pieces and abs(pieces[-1][1] - b) < HAIR:
        pieces[-1] = pieces[-1][0], b
    return pieces


def around(line: Arc | Polyline, boxes: Sequence[Box]) -> list[Arc | Polyline]:
    """Return the pieces of an arc, to a quarter of a millimetre, or of a broken line, outside of all boxes."""
    if isinstance(line, Polyline):
        points = (*line.points, line.points[0]) if line.closed else line.points
        struck = shapely.intersects(_inside(tuple(boxes)), lines(points[:-1], points[1:]))
        if not struck.any():
            return [line]
        each = zip(pairwise(points), struck.tolist(), strict=True)
        sides = (piece for side, hit in each for piece in (beside(*side, boxes) if hit else [side]))
        ways = list[list[complex]]()
        for a, b in sides:
            if ways and abs(ways[-1][-1] - a) < 10 * SLACK:
                ways[-1].append(b)
            else:
                ways.append([a, b])
        if len(ways) == 1 and abs(ways[0][0] - points[0]) + abs(ways[0][-1] - points[-1]) < 10 * SLACK:
            return [line]
        return [replace(line, points=tuple(way), closed=False) for way in ways]
    count = max(2, round(abs(line.sweep) * line.radius / STEP))
    turned = line.sweep * np.arange(count + 1) / count
    places = line.centre + line.radius * np.exp(1j * (line.start + turned))
    inside = shapely.contains_xy(_inside(tuple(boxes)), places.real, places.imag)
    if not inside.any():
        return [line]
    edges = np.flatnonzero(np.diff(np.concatenate(([True], inside, [True])).astype(int)))
    ends = ((turned[a], turned[b - 1]) for a, b in zip(edges[::2], edges[1::2], strict=True) if b - a > 1)
    return [replace(line, start=line.start + float(a), sweep=float(b - a)) for a, b in ends]


@lru_cache(maxsize=8)  # many lines are broken at the same boxes
def _inside(boxes: tuple[Box, ...]) -> shapely.Geometry:
    """Return the area of boxes without their sides."""
    x0, y0, x1, y1 = np.array(boxes, dtype=float).reshape(-1, 4).T
    area = shapely.union_all(shapely.box(x0 + SLACK, y0 + SLACK, x1 - SLACK, y1 - SLACK))
    shapely.prepare(area)
    return area


def coarser(shape: Shape, within: float) -> Shape:
    """Return a shape with its curves as broken lines of few points, none of them further than `within` mm away."""

    def thinner(part: Shape) -> Shape:
        if isinstance(part, Polyline) and len(part.points) > FEW:
            return replace(part, points=thinned(part.points, within))
        return part

    return changed(shape, thinner)


def thinned(points: Sequence[complex], within: float) -> tuple[complex, ...]:
    """Return as few of these points as keep the line through them within so many mm (Douglas and Peucker).

    The simplification of shapely keeps others, and letters beside a curve would stand elsewhere.
    """
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
    whole = [shapely.LineString(pairs(curve)) for curve in curves]
    dense = [shapely.line_interpolate_point(c, np.linspace(0.0, c.length, max(3, int(c.length / step)))) for c in whole]
    for n, places in enumerate(dense):
        others = shapely.multipoints([place for m, found in enumerate(dense) if m != n for place in found] or [FAR])
        room, own = shapely.distance(places, others), shapely.get_coordinates(places).view(complex).ravel()
        room[[0, -1]] = -1.0  # not at the ends
        for _ in range(1 + int(len(own) / (each / step))):
            k = int(np.argmax(room))
            along = complex(own[min(k + 1, len(own) - 1)] - own[max(k - 1, 0)])
            yield n, complex(own[k]), along / abs(along)
            room = np.minimum(room, np.abs(own - own[k]) - 0.5 * each)
