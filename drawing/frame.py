"""The frame of a sheet, and what stands in and round it: a title block after GOST 2.104 or ISO 7200, column 26."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from math import pi

from .cells import fitted
from .formats import Format, block_box, drawing_area, turned_box
from .pens import Norm
from .shapes import Group, Line, Pen, Polyline, Shape, Text, shifted
from .text import Box
from .titleblock import Stamp, form_1, form_2a, iso_block, words

T, t = Pen.MAIN, Pen.THIN
UNDER = 3.7  # mm from the frame down to the words under it


def frame_shapes(sheet: Format, stamp: Stamp, norm: Norm = "gost", first: bool = True) -> tuple[Shape, ...]:
    """Return edge, frame, title block and what stands round them; following sheets get the small block.

    Raises
    ------
    InputError
        A field is too long for its cell, or the font lacks one of its characters.
    """
    edge = _rectangle((0.0, 0.0, sheet.width, sheet.height), t, "edge")
    frame = _rectangle(drawing_area(sheet, norm), T, "frame")
    x0, y0, _, _ = block_box(sheet, norm, first)
    identity = (_identity(sheet, stamp),) if stamp.identity else ()
    if norm == "iso":
        return edge, frame, _centring_marks(sheet), _at_corner(iso_block(stamp), "iso-7200", x0, y0), *identity
    parts, name = (form_1(stamp), "form-1") if first else (form_2a(stamp), "form-2a")
    around = [_below(sheet, stamp), _turned(sheet, stamp)] if first else [_below(sheet, stamp)]
    return edge, frame, _at_corner(parts, name, x0, y0), *around, *identity


def _centring_marks(sheet: Format) -> Group:
    """Return the four marks of ISO 5457 in the middles of the sides, from 5 mm outside the frame to 5 mm inside it."""
    x0, y0, x1, y1 = drawing_area(sheet, "iso")
    across, up = sheet.width / 2, sheet.height / 2
    left, _, right, _ = block_box(sheet, "iso")
    inward = 0 if left < across < right else 5  # a mark through the title block would cross its words
    ends = (
        (complex(x0 - 5, up), complex(x0 + 5, up)),
        (complex(x1 + 5, up), complex(x1 - 5, up)),
        (complex(across, y0 - 5), complex(across, y0 + inward)),
        (complex(across, y1 + 5), complex(across, y1 - 5)),
    )
    return Group(tuple(Line(a, b, T) for a, b in ends), "margin", "centring")


def _rectangle(box: Box, pen: Pen, role: str) -> Polyline:
    """Return the outline of a box."""
    x0, y0, x1, y1 = box
    corners = (complex(x0, y0), complex(x1, y0), complex(x1, y1), complex(x0, y1))
    return Polyline(corners, pen, closed=True, role=role)


def _at_corner(parts: Iterable[Shape], name: str, x0: float, y0: float) -> Group:
    """Return a title block whose bottom left corner lies at (x0, y0), its outer corner mitred."""
    moved = [shifted(part, complex(x0, y0)) for part in parts]
    lines = [part for part in moved if isinstance(part, Line)]
    corner = complex(x0, max(line.a.imag for line in lines))
    return Group((*moved, Polyline((corner - 1j, corner, corner + 1), T, role="corner")), "titleblock", name)


def _below(sheet: Format, stamp: Stamp) -> Group:
    """Return the words under the frame: who copied it, and the format."""
    caption = words(stamp.language)
    _, foot, right, _ = drawing_area(sheet)
    y = foot - UNDER
    copied = Text(complex(right - 120, y), caption["copied"], 2.5, role="stamp", name="copied")
    size = Text(complex(right - 50, y), caption["format"].format(sheet.letters), 2.5, role="stamp", name="format")
    return Group((copied, size), "margin")


def _identity(sheet: Format, stamp: Stamp) -> Group:
    """Return the id of the sheet under the frame, at its left end, to be copied into a form of answers."""
    left, foot, *_ = drawing_area(sheet)
    at = complex(left + 2.0, foot - UNDER)
    text = words(stamp.language)["identity"].format(stamp.identity)
    return Group((Text(at, text, 2.5, role="stamp", name="identity"),), "margin", "identity")


def _turned(sheet: Format, stamp: Stamp) -> Group:
    """Return column 26: the designation turned round, for whoever looks through a pile of folded sheets."""
    x0, y0, x1, y1 = turned_box(sheet)
    tall = y1 - y0 > x1 - x0
    near, far = (x0, x1) if tall else (x1, x0)
    bend = complex(near, y0)
    lines = Polyline((complex(far, y0), bend, complex(near, y1)), T, role="cell")
    middle, turn, angle = complex((x0 + x1) / 2, (y0 + y1) / 2), (-1j if tall else -1), (-pi / 2 if tall else pi)
    texts = fitted(stamp.designation, (-35.0, -7.0, 35.0, 7.0), (7.0, 5.0, 3.5, 2.5), name="designation_turned")
    turned = (replace(text, at=middle + text.at * turn, angle=angle) for text in texts)
    return Group((lines, *turned), "titleblock", "column-26")
