"""A large page on small paper: overlapping A4 sheets to glue together, with marks and names."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil
from typing import BinaryIO

from ..scales.errors import InputError
from ..scales.numbers import quote
from .page import Page
from .pdf import POINT, draw_page, draw_shapes, new_canvas
from .pdf_layers import DocumentLayers
from .pens import pens_for
from .shapes import Line, Pen, Shape, Text
from .text import Box

PAPERS = {"A4": (210.0, 297.0), "A3": (297.0, 420.0)}
MARGIN = 10.0  # no printer reaches the edge of its paper
OVERLAP = 10.0  # to glue on
MARK = 5.0  # length of a cut mark


@dataclass(frozen=True, slots=True)
class Tile:
    """One small sheet: its name (column letter, row number from the top) and the part of the page that it shows."""

    name: str
    window: Box


def tiles(page: Page, paper: str = "A4") -> list[Tile]:
    """Return the tiles of a page, row by row from the top left; neighbours share a strip.

    Raises
    ------
    InputError
        `paper` is not a paper for tiles.
    """
    if paper not in PAPERS:
        raise InputError("tile-unknown", text=quote(paper), known=", ".join(PAPERS))
    wide, high = (side - 2 * MARGIN for side in PAPERS[paper])
    columns, rows = _count(page.width, wide), _count(page.height, high)
    found = []
    for row in range(rows):
        for column in range(columns):
            x, y = column * (wide - OVERLAP), page.height - row * (high - OVERLAP)
            window = (x, max(0.0, y - high), min(page.width, x + wide), y)
            found.append(Tile(f"{chr(ord('A') + column)}{row + 1}", window))
    return found


def _count(length: float, room: float) -> int:
    return max(1, ceil((length - OVERLAP) / (room - OVERLAP) - 1e-9))


def write_tiles(pages: Sequence[Page], stream: BinaryIO, paper: str = "A4") -> None:
    """Write pages as a PDF of small sheets at full size: print it at 100 %, cut at the marks, glue."""
    canvas, out = new_canvas(pages[0])
    document = DocumentLayers(canvas, pages[0].language)
    width, height = PAPERS.get(paper, PAPERS["A4"])
    for number, page in enumerate(pages):
        whole = f"page-{number}"
        parts = tiles(page, paper)
        canvas.beginForm(whole, 0, 0, page.width * POINT, page.height * POINT)
        layers = draw_page(canvas, page)
        canvas.endForm(Resources=document.resources(layers))
        for part in parts:
            canvas.setPageSize((width * POINT, height * POINT))
            x0, y0, x1, y1 = part.window
            left, bottom = MARGIN, height - MARGIN - (y1 - y0)
            canvas.saveState()
            clip = canvas.beginPath()
            clip.rect(left * POINT, bottom * POINT, (x1 - x0) * POINT, (y1 - y0) * POINT)
            canvas.clipPath(clip, stroke=0, fill=0)
            canvas.translate((left - x0) * POINT, (bottom - y0) * POINT)
            canvas.doForm(whole)
            canvas.restoreState()
            draw_shapes(canvas, _marks(part, (left, bottom, left + x1 - x0, bottom + y1 - y0)), pens_for(width, height))
            canvas.showPage()
    document.close()
    canvas.save()
    stream.write(out.getvalue())


def _marks(part: Tile, box: Box) -> list[Shape]:
    """Return cut marks outside the corners of `box`, and the tile's name under its left bottom corner."""
    x0, y0, x1, y1 = box
    shapes: list[Shape] = []
    for x, outward in ((x0, -1), (x1, 1)):
        for y, up in ((y0, -1), (y1, 1)):
            corner = complex(x, y)
            shapes.append(Line(corner + outward, corner + outward * MARK, Pen.THIN))
            shapes.append(Line(corner + up * 1j, corner + up * MARK * 1j, Pen.THIN))
    return [*shapes, Text(complex(x0 + 3, y0 - 5), part.name, 3.5)]
