"""The DXF writer (R2010, mm, the extra `dxf`): lines, true circles and arcs, letters that keep their width.

Layers are those of `page.py`; supports, pairs and the title block are blocks, the fields of the title block their
attributes. A vector is one line from tail to tip; its extended data (`APP`) name quantity, value, unit and mu.
"""

from __future__ import annotations

import re
from cmath import rect
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import replace
from io import StringIO
from math import degrees, tau
from typing import TYPE_CHECKING, Any, BinaryIO, cast

from ..plans.solved import FINE
from ..scales.errors import InputError
from . import titleblock
from .font import SCREEN, SLANTED, font
from .formats import ZERO
from .letters import GAP
from .page import BLACK, Layer, Page, Part, Stroke, Walk, extent, filled
from .shapes import Arc, Arrow, Circle, Group, Line, Pen, Polyline, Shape, Text, Vector, shifted
from .text import Run, plain

if TYPE_CHECKING:
    from ezdxf.document import Drawing
    from ezdxf.layouts.base import BaseLayout

APP = "KULMAN"
# LibreCAD takes the name of a style for that of its font; this one of its own has Cyrillic, Greek, scripts and marks
STYLE, FONT = "lc_opengost-br", "gost_au.ttf"
BLOCKS = ("pair", "pivot", "support", "ground", "shaft", "titleblock")  # roles of groups
WIDTHS = (0, 5, 9, 13, 15, 18, 20, 25, 30, 35, 40, 50, 53, 60, 70, 80, 90, 100)
LACKING = "←↑→↓↺↻∈∑∩∪●ʹ"  # marks of ours that this font does not have are drawn
APART = 10.0  # mm between outlines
FITTED = 3  # characters of a text that is fitted: a program may measure ink, of which a single i has none across
SLANT = 15.0  # degrees of letters that lean
PENS = {Layer.FRAME: Pen.MAIN, Layer.RESULT: Pen.MAIN}  # of layers; of others the thin one
PATTERNS = {Pen.DASHED: "KULMAN_DASHED", Pen.AXIS: "KULMAN_AXIS", Pen.EXTREME: "KULMAN_EXTREME"}
_PARTS = re.compile(rf"[{LACKING}]|[^{LACKING} ]+(?: +[^{LACKING} ]+)*")
_DIGITS = re.compile(r"-?\d+\.\d+(?:e[-+]\d+)?")


def write(pages: Sequence[Page], stream: BinaryIO) -> None:
    """Write the first of `pages` as DXF in UTF-8, always the same bytes.

    Raises InputError: the extra `dxf` is not installed. ValueError: a coordinate is not a finite number.
    """
    page, document = replace(pages[0], layers=True), _new()
    _tables(document, page)
    _Walk(page, document).whole()
    _close(document, page)
    stream.write(_bytes(document))


def outlined(outlines: Mapping[str, Iterable[complex]]) -> bytes:
    """Return outlines, m, as a drawing to cut from: closed polylines beside each other, each in a layer of its name.

    The axis of the first is the origin. Chords are as few as stay within `FINE` of the points. Errors as of `write`.
    """
    from shapely import LinearRing

    document, x = _new(), 0.0
    for name, points in outlines.items():
        document.layers.add(name)
        ring = LinearRing([_place(1000.0 * point) for point in points]).simplify(1000.0 * FINE)
        left, _, right, _ = ring.bounds
        x -= left if x else 0.0
        corners = [(x + a, b) for a, b in ring.coords[:-1]]
        document.modelspace().add_lwpolyline(corners, close=True, dxfattribs={"layer": name})
        x += right + APART
    return _bytes(document)


def _new() -> Drawing:
    try:
        from ezdxf import units
        from ezdxf.filemanagement import new
    except ImportError:
        raise InputError("extra-missing", packages="ezdxf", suffix=".dxf") from None
    with _undated():
        return new("R2010", units=units.MM)


def _bytes(document: Drawing) -> bytes:
    for kind in sorted(document.entitydb.dxf_types_in_use()):  # in one order: writing goes through them as a set has it
        document.classes.add_class(kind)
    text = StringIO()
    with _undated():
        document.write(text)
    return text.getvalue().encode("utf-8", "dxfreplace")


@contextmanager
def _undated() -> Iterator[None]:
    """Leave out of a document when it was made: the same drawing is always the same bytes."""
    from ezdxf import options  # type: ignore[attr-defined]

    before, options.write_fixed_meta_data_for_testing = options.write_fixed_meta_data_for_testing, True
    try:
        yield
    finally:
        options.write_fixed_meta_data_for_testing = before


def _tables(document: Drawing, page: Page) -> None:
    """Give a document the layers, patterns, letters of a page."""
    pens = page.pens
    for pen, name in PATTERNS.items():
        dashes = pens.pattern(pen)
        signed = [-part if index % 2 else part for index, part in enumerate(dashes)]
        document.linetypes.add(name, [sum(dashes), *signed], description=pen.value)
    document.styles.add(STYLE, font=FONT)
    document.appids.add(APP)
    for layer in Layer:
        entry = document.layers.add(layer.value, lineweight=_weight(pens.width(PENS.get(layer, Pen.THIN))))
        entry.description = layer.title(page.language)
        if layer.hidden:
            entry.off()


def _close(document: Drawing, page: Page) -> None:
    """Say how large the sheet is, so that it opens as a whole, with its widths of lines."""
    document.header["$LWDISPLAY"] = 1
    document.header["$LIMMAX"] = document.header["$PLIMMAX"] = (page.width, page.height)
    document.header["$EXTMIN"], document.header["$EXTMAX"] = (0.0, 0.0, 0.0), (page.width, page.height, 0.0)
    document.set_modelspace_vport(page.height, (page.width / 2, page.height / 2))


def _weight(width: float) -> int:
    """Return the nearest width that DXF knows to one in mm, in hundredths."""
    return min(WIDTHS, key=lambda known: abs(known - 100 * width))


def _place(point: complex) -> tuple[float, float]:
    """Return a point as CAD has it. Raises ValueError: it is none."""
    if point != point or abs(point) == float("inf"):
        raise ValueError(f"not a place on a sheet: {point}")
    return point.real, point.imag


class _Walk(Walk):
    """Adds shapes to the space of a drawing, or to a block of it."""

    def __init__(self, page: Page, document: Drawing) -> None:
        super().__init__(page)
        self.document, self.space = document, cast("BaseLayout", document.modelspace())
        self.layer = Layer.FRAME.value
        self.blocks: dict[str, str] = {}
        self.in_arrow = False

    def draw(self, shape: Shape) -> None:
        """Put down a shape; a group that is a block is inserted."""
        if isinstance(shape, Group) and shape.role in BLOCKS:
            self.insert(shape)
        else:
            super().draw(shape)

    def insert(self, group: Group) -> None:
        """Insert a block, which is made where it is the first of its shape; its fields are attributes."""
        # the point by which it is inserted: the centre of its first circle, else the corner of its box
        centres = (part.centre for part in group.shapes if isinstance(part, Circle))
        at = next(centres, complex(*extent(group.shapes)[:2]))
        fields = _fields(group, at, self.page.language)
        lines = tuple(shifted(part, -at) for part in group.shapes)
        key = _DIGITS.sub(lambda found: f"{round(float(found[0]), 6) + 0.0}", repr(lines))
        name = self.blocks.get(key)
        if name is None:
            name = self.blocks[key] = f"{group.role.upper()}_{len(self.blocks) + 1}"
            before, self.space, layer, self.layer = self.space, self.document.blocks.new(name), self.layer, "0"
            for part in lines:
                self.draw(part)
            for tag, text in fields.items():
                self.field(self.space.add_attdef, tag, replace(text, at=text.at - at))
            self.space, self.layer = before, layer
        inserted = self.space.add_blockref(name, _place(at), {"layer": self.layer})
        for tag, text in fields.items():
            self.field(inserted.add_attrib, tag, text)

    def field(self, add: Callable[..., Any], tag: str, text: Text) -> None:
        """Add a field of the title block; one that is filled in is hidden: not every program shows fields."""
        from ezdxf.enums import TextEntityAlignment

        looks = self.lettered(text.height) | {"width": text.squeeze}
        said = _written(plain(text.markup))
        place = TextEntityAlignment.CENTER if text.anchor == "middle" else TextEntityAlignment.LEFT
        field = add(tag=tag.upper(), text=said, dxfattribs=looks)
        field.set_placement(_place(text.at), align=place)
        field.is_invisible = bool(said)

    def stroke(self, shape: Stroke, dashes: tuple[float, ...]) -> None:
        """Add a line with its width and pattern, an area before it."""
        looks = self.looks(shape.pen, shape.colour, dashes)
        match shape:
            case Line(a=a, b=b):
                if not self.in_arrow:  # whose line is there already, and on paper ends inside the head
                    self.space.add_line(_place(a), _place(b), looks)
            case Polyline(points=points, closed=closed):
                self.area(filled(shape), lambda hatch: hatch.paths.add_polyline_path([_place(p) for p in points]))
                self.space.add_lwpolyline([_place(point) for point in points], close=closed, dxfattribs=looks)
            case Circle(centre=centre, radius=radius):
                place = _place(centre)
                self.area(filled(shape), lambda hatch: hatch.paths.add_edge_path().add_arc(place, radius))
                self.space.add_circle(place, radius, looks)
            case Arc(centre=centre, radius=radius, start=start, sweep=sweep):
                if abs(sweep) >= tau:
                    self.space.add_circle(_place(centre), radius, looks)
                else:
                    low, high = sorted((start, start + sweep))
                    self.space.add_arc(_place(centre), radius, degrees(low), degrees(high), dxfattribs=looks)

    def area(self, colour: str | None, bound: Any) -> None:
        """Fill an area before its outline; white hides what lies under it."""
        if colour is not None:
            bound(self.space.add_hatch(dxfattribs={"layer": self.layer, **_coloured(colour)}))

    def looks(self, pen: Pen, colour: str | None, dashes: tuple[float, ...] = ()) -> dict[str, Any]:
        """Return layer, width, pattern and colour of a line; patterns end with a dash, as `Pens.dashes` has them."""
        found = {"layer": self.layer, "lineweight": _weight(self.pens.width(pen)), **_coloured(colour or BLACK)}
        if dashes:
            found |= {"linetype": PATTERNS[pen], "ltscale": dashes[0] / self.pens.pattern(pen)[0]}
        return found

    def head(self, corners: tuple[complex, complex, complex], colour: str) -> None:
        """Add a filled triangle."""
        self.space.add_solid([_place(corner) for corner in corners], {"layer": self.layer, **_coloured(colour)})

    def letters(self, text: Text, runs: Sequence[tuple[Run, complex]], alone: bool) -> None:
        """Add a text for each run, fitted between its ends, so that another font takes no more room."""
        for run, at in runs:
            face, along = font(run.face), run.size * text.squeeze * rect(1.0, text.angle)
            for part in _PARTS.finditer(run.string):
                start, end = (
                    at + sum(face.ink(letter)[0] for letter in run.string[:place]) * along for place in part.span()
                )
                if part[0] in LACKING:
                    self.strokes(text, replace(run, string=part[0]), start)
                else:
                    self.written(text, part[0], run, (start, end))

    def written(self, text: Text, string: str, run: Run, ends: tuple[complex, complex]) -> None:
        """Add characters between two ends; of few only the middle is kept."""
        from ezdxf.enums import TextEntityAlignment

        height, (start, end) = run.size / font(run.face).size, ends
        looks = self.lettered(height) | _coloured(text.colour or BLACK)
        looks |= {"oblique": SLANT} if run.face == SLANTED else {}
        entity = self.space.add_text(_written(string), dxfattribs=looks)
        if run.face != SCREEN:  # our letters have all of their distance behind them
            end -= GAP * height / 10 * text.squeeze * rect(1.0, text.angle)
        if len(string) < FITTED:
            entity.dxf.width, entity.dxf.rotation = text.squeeze, degrees(text.angle)
            entity.set_placement(_place((start + end) / 2), align=TextEntityAlignment.CENTER)
        else:
            entity.set_placement(_place(start), _place(end), align=TextEntityAlignment.FIT)

    def lettered(self, height: float) -> dict[str, Any]:
        """Return style, height and width of strokes of letters."""
        return {"style": STYLE, "layer": self.layer, "height": height, "lineweight": _weight(height / 10)}

    def begin(self, part: Part) -> None:
        """Go on in a layer, or put down the line of an arrow from tail to tip."""
        if isinstance(part, Layer):
            self.layer = part.value
        elif isinstance(part, Vector | Arrow) and abs(part.tip - part.tail) >= ZERO:
            line = self.space.add_line(_place(part.tail), _place(part.tip), self.looks(part.pen, part.colour))
            line.set_xdata(APP, _named(part))
            self.in_arrow = True

    def end(self, part: Part) -> None:
        """Go on behind it."""
        self.in_arrow = False


def _coloured(colour: str) -> dict[str, int]:
    """Return a colour; black is that of the layer, which a dark screen shows white."""
    if colour == BLACK:
        return {}
    if colour == "#fff":  # LibreCAD prints white itself as black
        colour = "#fefefe"
    digits = colour[1:] if len(colour) == 7 else "".join(2 * digit for digit in colour[1:])
    return {"true_color": int(digits, 16)}


def _named(vector: Vector | Arrow) -> list[tuple[int, str | float]]:
    """Return what a vector says of itself in extended data; an arrow only its name."""
    if isinstance(vector, Arrow):
        return [(1000, vector.name)]
    return [(1000, vector.quantity), (1040, vector.value), (1000, vector.unit), (1040, vector.mu)]


def _written(string: str) -> str:
    """Return characters as a text of CAD spells them, which takes some for codes."""
    return string.replace("%%", "%%%%%%").replace("^", "^ ")


def _fields(group: Group, at: complex, language: str) -> dict[str, Text]:
    """Return the lines of the fields of a title block by their tags, those that nobody has filled in among them."""
    found = {}
    for name, blank in titleblock.fields(group.name, language).items():
        lines = [part for part in group.shapes if isinstance(part, Text) and part.name == name]
        for row, line in enumerate(lines or [replace(blank, at=blank.at + at, markup="")], start=1):
            found[name if row == 1 else f"{name}_{row}"] = line
    return found
