"""Make the fonts of the drafting letters from their strokes, always the same: `.venv/bin/python docs/lettering.py`."""

from __future__ import annotations

import io
import itertools
import math
from collections.abc import Iterator
from pathlib import Path

from fontTools.fontBuilder import FontBuilder
from fontTools.pens.ttGlyphPen import TTGlyphPen
from shapely import affinity
from shapely.geometry import LineString, Point
from shapely.geometry.base import BaseGeometry
from shapely.geometry.polygon import orient
from shapely.ops import unary_union

import kulman
from kulman.drawing.letters import DOT, GAP, SLANT, Glyph, glyphs

FONTS = {"upright": False, "slanted": True}
UNIT = 100  # of the font, to h/10: capitals are 1000 units high
NEAR = 0.6  # units by which a curve of the font may miss the outline
CORNER = math.radians(15.0)  # a turn of an outline that is seen


def _outline(glyph: Glyph, slant: float = 0.0) -> BaseGeometry:
    """Return the area that the strokes of a letter cover, h/10, leaning by `slant` to a height of one."""
    drawn = []
    for stroke in glyph.strokes:
        points = [(p.real, p.imag) for p in stroke]
        line = Point(points[0]) if len(points) == 1 else LineString(points)
        drawn.append(line.buffer(10 * DOT if len(points) == 1 else 0.5, quad_segs=12))
    area = unary_union(drawn)
    return affinity.affine_transform(area, [1.0, slant, 0.0, 1.0, 0.0, 0.0]) if slant else area


def _contours(area: BaseGeometry) -> Iterator[list[complex]]:
    """Go through the rings of an area in units of the font, outer ones clockwise, holes the other way."""
    for part in getattr(area, "geoms", [area]):
        polygon = orient(part, -1.0)
        for ring in (polygon.exterior, *polygon.interiors):
            points = [complex(x * UNIT, y * UNIT) for x, y in ring.coords[:-1]]
            yield [p for p, q in zip(points, points[1:] + points[:1], strict=True) if abs(p - q) > 0.5]


def _pieces(ring: list[complex]) -> Iterator[list[complex]]:
    """Cut a ring at its corners and at the ends of its straight parts."""
    count = len(ring)
    sides = [ring[(i + 1) % count] - ring[i] for i in range(count)]
    cuts = []
    for i in range(count):
        turn = abs(math.remainder(math.atan2((sides[i] / sides[i - 1]).imag, (sides[i] / sides[i - 1]).real), math.tau))
        if turn > CORNER or max(abs(sides[i]), abs(sides[i - 1])) > 45.0:
            cuts.append(i)
    cuts = cuts or [0]
    for i, start in enumerate(cuts):
        end = cuts[(i + 1) % len(cuts)]
        length = (end - start) % count or count
        yield [ring[(start + k) % count] for k in range(length + 1)]


def _curves(piece: list[complex]) -> Iterator[tuple[complex, ...]]:
    """Go through the parts of a smooth piece: lines, (end,), and parabolas, (control, end), as few as stay near it."""
    start = 0
    while start < len(piece) - 1:
        for end in range(len(piece) - 1, start + 1, -1):
            control = _control(piece[start : end + 1])
            if control is not None:
                yield control, piece[end]
                break
        else:
            end = start + 1
            yield (piece[end],)
        start = end


def _control(points: list[complex]) -> complex | None:
    """Return the control point of the parabola from end to end along which all `points` lie, or nothing."""
    first, last = points[0], points[-1]
    middle = min(range(1, len(points) - 1), key=lambda i: abs(abs(points[i] - first) - abs(points[i] - last)))
    control = 2.0 * points[middle] - (first + last) / 2.0
    at = [k / 40 for k in range(41)]
    curve = [(1 - t) ** 2 * first + 2 * t * (1 - t) * control + t * t * last for t in at]
    return (
        control if all(min(abs(p - c) for c in curve) < 3.0 * NEAR and _off(p, curve) < NEAR for p in points) else None
    )


def _off(point: complex, curve: list[complex]) -> float:
    """Return how far a point is from a broken line."""
    return min(_distance(point, a, b) for a, b in itertools.pairwise(curve))


def _distance(point: complex, start: complex, end: complex) -> float:
    along = end - start
    share = min(max(((point - start) / along).real, 0.0), 1.0) if along else 0.0
    return abs(point - start - share * along)


def built(slanted: bool = False) -> bytes:
    """Return the letters as a TrueType font, always the same bytes."""
    slant = SLANT if slanted else 0.0
    letters = sorted(glyphs())
    names = {letter: f"uni{ord(letter):04X}" for letter in letters}
    outlines, metrics = {".notdef": TTGlyphPen(None).glyph()}, {".notdef": (600, 0)}
    for letter, name in names.items():
        pen = TTGlyphPen(None)
        glyph = glyphs()[letter]
        if glyph.strokes:
            for ring in _contours(_outline(glyph, slant)):
                pieces = list(_pieces(ring))
                pen.moveTo(_whole(pieces[0][0]))
                for piece in pieces:
                    for curve in _curves(piece):
                        if len(curve) == 1:
                            pen.lineTo(_whole(curve[0]))
                        else:
                            pen.qCurveTo(*map(_whole, curve))
                pen.closePath()
        outlines[name] = pen.glyph()
        metrics[name] = (round((glyph.width + GAP) * UNIT), 0)
    builder = FontBuilder(1370, isTTF=True)
    builder.setupGlyphOrder([".notdef", *names.values()])
    builder.setupCharacterMap({ord(letter): name for letter, name in names.items()})
    builder.setupGlyf(outlines)
    glyf = builder.font["glyf"]
    builder.setupHorizontalMetrics(
        {name: (width, getattr(glyf[name], "xMin", 0)) for name, (width, _) in metrics.items()}
    )
    builder.setupHorizontalHeader(ascent=1250, descent=-330)
    style = "Slanted" if slanted else "Regular"
    builder.setupNameTable(
        {
            "familyName": "Kulman Drafting",
            "styleName": style,
            "uniqueFontIdentifier": f"Kulman Drafting {style}",
            "fullName": f"Kulman Drafting {style}",
            "psName": f"KulmanDrafting-{style}",
            "version": "Version 1.0",
        }
    )
    heights = {"sCapHeight": 1000, "sxHeight": 700, "sTypoAscender": 1250, "sTypoDescender": -330}
    builder.setupOS2(**heights, usWinAscent=1300, usWinDescent=400)
    builder.setupPost(keepGlyphNames=False)
    builder.font["head"].created = builder.font["head"].modified = 3_000_000_000
    builder.font.recalcTimestamp = False
    file = io.BytesIO()
    builder.save(file)
    return file.getvalue()


def _whole(point: complex) -> tuple[int, int]:
    return round(point.real), round(point.imag)


if __name__ == "__main__":
    for name, slanted in FONTS.items():
        (Path(kulman.__file__).parent / "drawing" / f"letters-{name}.ttf").write_bytes(built(slanted))
