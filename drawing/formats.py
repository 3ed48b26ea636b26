"""Formats of the sheet: the frame, places that views leave free, sizes of letters and symbols, pens by meaning, mm."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache
from math import isfinite, pi, tan
from typing import Literal, TypeAlias

from ..scales.errors import InputError
from ..scales.numbers import quote
from .shapes import Pen
from .text import Box

BLOCK = {"gost": (185.0, 55.0), "iso": (180.0, 36.0)}  # the title block of a first sheet, mm
FOLLOWING = {"gost": (185.0, 15.0), "iso": (180.0, 36.0)}
TURNED = (70.0, 14.0)  # the additional block with the designation turned round (column 26)
MARGINS = {"A4": 2.0, "A3": 4.0, "A2": 4.0, "A1": 4.0}  # mm between the frame and any view
GAPS = {"A4": 4.0, "A3": 7.0, "A2": 7.0, "A1": 7.0}  # mm between views
CLOSE = 4.0  # mm between views and the title block of a following page
PRINTED, FOOT = 8.0, 14.0  # mm of the frame from the edges of the paper: most printers reach no farther than 5


@dataclass(frozen=True, slots=True)
class Format:
    """A trimmed sheet of `width` x `height` mm; its frame may keep farther from the edges than the norm wants."""

    name: str
    width: float
    height: float
    margin: float = 0.0
    foot: float = 0.0

    @property
    def letters(self) -> str:
        """Return the name as the sheet prints it: A3, upright or not."""
        return self.name[:2]


FORMATS = {
    item.name: item
    for item in (  # from the smallest: the first that holds everything is the one to take
        Format("A4", 210.0, 297.0),
        Format("A3", 420.0, 297.0),
        Format("A3-portrait", 297.0, 420.0),
        Format("A2", 594.0, 420.0),
        Format("A1", 841.0, 594.0),
    )
}


def format_named(name: str | Format) -> Format:
    """Return the format called `name`; small letters and a Cyrillic А are understood. A format stays as it is.

    Raises InputError: there is no such format.
    """
    if isinstance(name, Format):
        return name
    wanted = str(name).strip().upper().replace("А", "A").replace("-PORTRAIT", "-portrait")
    if wanted not in FORMATS:
        raise InputError("format-unknown", text=quote(name), known=", ".join(FORMATS))
    return FORMATS[wanted]


def printable(sheet: Format) -> Format:
    """Return a format whose frame keeps clear of where printers do not reach."""
    return replace(sheet, margin=PRINTED, foot=FOOT)


def drawing_area(sheet: Format, norm: Norm = "gost") -> Box:
    """Return the box inside the frame: 20 mm for binding, the rest after GOST 2.301 or ISO 5457."""
    margin = max(10.0 if norm == "iso" else 5.0, sheet.margin)
    left = 20.0 - max(sheet.margin - 5.0, 0.0)  # a title block is as wide as the frame of an A4
    return left, max(margin, sheet.foot), sheet.width - margin, sheet.height - margin


def block_box(sheet: Format, norm: Norm = "gost", first: bool = True) -> Box:
    """Return the box of the title block, in the bottom right corner of the frame."""
    _, y0, x1, _ = drawing_area(sheet, norm)
    width, height = (BLOCK if first else FOLLOWING)[norm]
    return x1 - width, y0, x1, y0 + height


def turned_box(sheet: Format) -> Box:
    """Return the box of column 26: top left, or upright in the top right corner of a tall sheet above A4."""
    x0, _, x1, y1 = drawing_area(sheet)
    long, short = TURNED
    if sheet.height > max(sheet.width, 297.0):
        return x1 - short, y1 - long, x1, y1
    return x0, y1 - short, x0 + long, y1


def reserved_boxes(sheet: Format, norm: Norm = "gost", first: bool = True) -> tuple[Box, ...]:
    """Return the boxes inside the frame in which no view may stand."""
    block = block_box(sheet, norm, first)
    return (block, turned_box(sheet)) if norm == "gost" and first else (block,)


def usable(sheet: Format, norm: Norm) -> Box:
    """Return the box in which views may stand, but for reserved boxes."""
    x0, y0, x1, y1 = drawing_area(sheet, norm)
    margin = MARGINS[sheet.letters]
    return x0 + margin, y0 + margin, x1 - margin, y1 - margin


def room(sheet: Format, norm: Norm, first: bool = False) -> tuple[float, float]:
    """Return width and height of the largest view that a page of its own can hold, beside nothing else.

    The `first` page has the larger title block, and column 26 in another corner.
    """
    x0, _, x1, y1 = usable(sheet, norm)
    gap = GAPS[sheet.letters]
    block, *turned = reserved_boxes(sheet, norm, first=first)
    top = min((box[1] - gap for box in turned), default=y1)
    return x1 - x0, top - block[3] - gap * first - CLOSE * (not first)


@dataclass(frozen=True, slots=True)
class Style:
    """What a format wants: cap heights after GOST 2.304, and sizes of symbols that read well."""

    label: float  # letters of nodes and vectors
    heading: float  # names of views
    text: float  # tables and equations
    pair: float  # radius of a revolute pair
    pivot: tuple[float, float, float]  # width, height, base of a fixed pivot
    slider: tuple[float, float]
    hatch: tuple[float, float]  # stroke, pitch
    centre: float  # radius of a centre of mass
    arrow: float  # arrowhead
    force: float  # an arrow that only shows a direction
    node: float  # radius of a node of a plan
    row: float = 0.0  # the least height of rows of tables


STYLES = {
    "A1": Style(5.0, 5.0, 3.5, 2.5, (12.0, 9.0, 16.0), (16.0, 9.0), (3.5, 2.5), 1.25, 4.8, 26.0, 0.8),
    "A2": Style(5.0, 5.0, 3.5, 2.0, (10.0, 8.0, 14.0), (13.0, 8.0), (3.0, 2.2), 1.1, 4.8, 22.0, 0.7),
    "A3": Style(3.5, 3.5, 2.5, 1.75, (9.0, 7.0, 12.0), (11.0, 6.5), (2.5, 1.8), 1.0, 3.6, 19.0, 0.6),
    "A4": Style(3.5, 3.5, 2.5, 1.5, (7.0, 5.5, 9.0), (9.0, 5.0), (2.0, 1.5), 0.9, 3.0, 16.0, 0.5),
}


Norm: TypeAlias = Literal["gost", "iso"]

HEAD_HALF_WIDTH = tan(pi / 18)  # of an arrowhead of unit length with an opening of 20 degrees
ZERO = 1e-9  # mm; a shorter vector has no direction that a reader could see


@dataclass(frozen=True, slots=True)
class Pens:
    """Two widths, two patterns and one arrowhead for a whole sheet, all in mm."""

    main: float
    thin: float
    arrow: float
    dashed: tuple[float, ...]
    axis: tuple[float, ...]

    def width(self, pen: Pen) -> float:
        """Return the width of `pen`."""
        return self.main if pen is Pen.MAIN else self.thin

    def pattern(self, pen: Pen) -> tuple[float, ...]:
        """Return dashes and gaps of `pen` as the norm has them; none are a solid line."""
        extreme = (*self.axis, *self.axis[2:])  # the axis with two dots (GOST 2.303, line 9)
        return {Pen.DASHED: self.dashed, Pen.AXIS: self.axis, Pen.EXTREME: extreme}.get(pen, ())

    def dashes(self, pen: Pen, length: float) -> tuple[float, ...]:
        """Return dashes and gaps for a line of `length`, stretched so that it starts and ends with a dash.

        An empty tuple means a solid line, which is also right for a line too short for two dashes.
        """
        pattern = self.pattern(pen)
        if not pattern:
            return ()
        period, dash = sum(pattern), pattern[0]
        repeats = round((length - dash) / period) if isfinite(length) else 0
        if repeats < 1:
            return ()
        factor = length / (repeats * period + dash)
        return tuple(factor * part for part in pattern)


_GOST = {
    "A1": Pens(0.8, 0.3, 4.8, (4.0, 1.5), (12.0, 1.5, 0.5, 1.5)),
    "A2": Pens(0.8, 0.3, 4.8, (4.0, 1.5), (12.0, 1.5, 0.5, 1.5)),
    "A3": Pens(0.6, 0.25, 3.6, (4.0, 1.5), (10.0, 1.3, 0.4, 1.3)),
    "A4": Pens(0.5, 0.2, 3.0, (4.0, 1.5), (8.0, 1.3, 0.4, 1.3)),
}


def _iso(main: float, arrow: float) -> Pens:
    """Lay the patterns of ISO 128 out in units of the narrow line."""
    d = main / 2
    return Pens(main, d, arrow, (12 * d, 3 * d), (24 * d, 3 * d, 0.5 * d, 3 * d))


_ISO = {"A1": _iso(0.7, 4.8), "A2": _iso(0.5, 4.8), "A3": _iso(0.5, 3.6), "A4": _iso(0.5, 3.0)}


@cache
def pens_for(width: float, height: float, norm: Norm = "gost") -> Pens:
    """Return the pens of a sheet of `width` x `height` mm."""
    side = max(width, height)
    name = "A1" if side >= 841 else "A2" if side >= 594 else "A3" if side >= 420 else "A4"
    return (_ISO if norm == "iso" else _GOST)[name]
