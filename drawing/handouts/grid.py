"""A light grid of 5 mm under a drawing, as on squared paper."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from math import ceil

from ..formats import Format, drawing_area, reserved_boxes
from ..layers import Layer
from ..page import Page
from ..pens import Norm
from ..shapes import Group, Line, Pen
from ..text import Box

SIDE = 5.0  # of a square, mm
LIGHT = "#d9d9d9"


def gridded(page: Page, sheet: Format, norm: Norm, first: bool) -> Page:
    """Return a page of `sheet` with squares inside its frame, but for the title block and column 26."""
    x0, y0, x1, y1 = drawing_area(sheet, norm)
    boxes = reserved_boxes(sheet, norm, first)
    turned = [(box[1], box[0], box[3], box[2]) for box in boxes]
    ends = [(complex(x, a), complex(x, b)) for x, a, b in _lines((x0, y0, x1, y1), boxes)]
    ends += [(complex(a, y), complex(b, y)) for y, a, b in _lines((y0, x0, y1, x1), turned)]
    squares = tuple(Line(a, b, Pen.THIN, role="grid", colour=LIGHT) for a, b in ends)
    return replace(page, shapes=(Group(squares, "grid", layer=Layer.GRID.value), *page.shapes))


def _lines(area: Box, taken: Sequence[Box]) -> Iterator[tuple[float, float, float]]:
    """Go through pieces of upright lines in `area` outside of boxes that are `taken`: place, lower and upper end."""
    x0, y0, x1, y1 = area
    for k in range(1, ceil((x1 - x0) / SIDE - 1e-9)):
        x, start = x0 + k * SIDE, y0
        for _, low, _, high in sorted((box for box in taken if box[0] < x < box[2]), key=lambda box: box[1]):
            if low > start:
                yield x, start, low
            start = high
        if y1 > start:
            yield x, start, y1
