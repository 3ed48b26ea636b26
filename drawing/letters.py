"""Our drafting letters: strokes on the grid of GOST 2.304, type B, as centre lines and as a TrueType font.

`letters.txt` has the strokes, for pens and plotters as they are; sheets embed a font that is made of their outlines,
`built`, and kept beside this file as `letters-upright.ttf` and `letters-slanted.ttf`.
"""

from __future__ import annotations

import io
import itertools
import math
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

UNIT = 100  # of the font, to h/10: capitals are 1000 units high
GAP = 1.6  # between the widths of letters, h/10
WORD_GAP = 6.0  # h/10
SLANT = math.tan(math.radians(15.0))  # of slanted letters, 75 degrees to the line
DOT = 0.062  # radius of a dot, in heights of a capital
FINE = math.radians(7.5)  # steps of a rounded corner
NEAR = 0.6  # units by which a curve of the font may miss the outline
CORNER = math.radians(15.0)  # a turn of an outline that is seen


class _Glyph(NamedTuple):
    """A letter: its width and the points of its strokes, h/10."""

    width: float
    strokes: tuple[tuple[complex, ...], ...]


@cache
def glyphs() -> dict[str, _Glyph]:
    """Return all letters with their strokes, rounded corners as short chords."""
    text = Path(__file__).with_name("letters.txt").read_text(encoding="utf-8")
    made = {" ": _Glyph(WORD_GAP - GAP, ())}
    for line in text.splitlines():
        if not line or line.startswith("# "):
            continue
        head, *strokes = line.split(" | ")
        letters, width = head.rsplit(maxsplit=1)
        glyph = _Glyph(float(width), tuple(_rounded(stroke.split()) for stroke in strokes))
        made.update(dict.fromkeys(letters, glyph))
    return made


def _rounded(words: list[str]) -> tuple[complex, ...]:
    """Return the points of a stroke, those of its rounded corners among them."""
    closed = words[-1] == "z"
    corners = [
        (complex(*map(float, word.split(",")[:2])), float(([*word.split(","), "0", "0"])[2]))
        for word in words[: len(words) - closed]
    ]
    points: list[complex] = []
    for index, (corner, radius) in enumerate(corners):
        if not radius:
            points.append(corner)
            continue
        before, after = corners[index - 1][0] - corner, corners[(index + 1) % len(corners)][0] - corner
        points += _arc(corner, before, after, radius)
    return tuple([*points, points[0]] if closed else points)


def _arc(corner: complex, before: complex, after: complex, radius: float) -> Iterator[complex]:
    """Go along the arc that rounds a corner off between the directions to its neighbours."""
    first, last = before / abs(before), after / abs(after)
    half = abs(math.remainder(math.atan2((last / first).imag, (last / first).real), math.tau)) / 2.0
    centre = corner + (first + last) / abs(first + last) * radius / math.sin(half)
    start = corner + first * radius / math.tan(half) - centre
    turn = math.pi - 2.0 * half
    if (last / first).imag > 0.0:
        turn = -turn
    steps = max(1, math.ceil(abs(turn) / FINE))
    for step in range(steps + 1):
        angle = turn * step / steps
        yield centre + start * complex(math.cos(angle), math.sin(angle))


def drawn(string: str, height: float, slanted: bool = False) -> Iterator[tuple[complex, ...]]:
    """Go through the strokes of a line of letters with capitals of `height` mm, from its start; a dot is one point.

    Raises KeyError: the alphabet lacks a character.
    """
    x, grid, lean = 0.0, height / 10.0, SLANT if slanted else 0.0
    for letter in string:
        glyph = glyphs()[letter]
        for stroke in glyph.strokes:
            yield tuple(complex(x + p.real + lean * p.imag, p.imag) * grid for p in stroke)
        x += glyph.width + GAP


def _outline(glyph: _Glyph, slant: float = 0.0) -> BaseGeometry:
    """Return the area that the strokes of a letter cover, h/10, leaning by `slant` to a height of one."""
    from shapely import affinity
    from shapely.geometry import LineString, Point
    from shapely.ops import unary_union

    drawn = []
    for stroke in glyph.strokes:
        points = [(p.real, p.imag) for p in stroke]
        line = Point(points[0]) if len(points) == 1 else LineString(points)
        drawn.append(line.buffer(10 * DOT if len(points) == 1 else 0.5, quad_segs=12))
    area = unary_union(drawn)
    return affinity.affine_transform(area, [1.0, slant, 0.0, 1.0, 0.0, 0.0]) if slant else area


def _contours(area: BaseGeometry) -> Iterator[list[complex]]:
    """Go through the rings of an area in units of the font, outer ones clockwise, holes the other way."""
    from shapely.geometry.polygon import orient

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
    from fontTools.fontBuilder import FontBuilder
    from fontTools.pens.ttGlyphPen import TTGlyphPen

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
