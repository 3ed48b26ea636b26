"""Tables and blocks of text lines as views."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import accumulate

from .shapes import Group, Line, Pen, Shape, Text
from .style import Style
from .text import Box, lay_out
from .view import View, heading_shapes

INDENT = "    "


def table(name: str, heading: str, rows: Sequence[Sequence[str]], style: Style) -> View:
    """Return a ruled table; the first row is its head."""
    h = style.text
    pad = 0.5 * h
    columns = range(len(rows[0]))
    widths = [max(lay_out(row[i], h).width for row in rows) + 2 * pad for i in columns]
    edges = [sum(widths[:i]) for i in range(len(widths) + 1)]
    spans = [_span(row, h) for row in rows]
    # a row of scripts above and below needs more than a row of plain words
    levels = [0.0, *accumulate(-max(2.0 * h, top - bottom + 0.4 * h) for top, bottom in spans)]
    height = -levels[-1]
    shapes: list[Shape] = []
    for i, y in enumerate(levels):
        pen = Pen.MAIN if i in (0, 1, len(rows)) else Pen.THIN
        shapes.append(Line(complex(0, y), complex(edges[-1], y), pen))
    for i, x in enumerate(edges):
        pen = Pen.MAIN if i in (0, len(edges) - 1) else Pen.THIN
        shapes.append(Line(complex(x, 0), complex(x, -height), pen))
    for j, (row, (top, bottom)) in enumerate(zip(rows, spans, strict=True)):
        baseline = (levels[j] + levels[j + 1] - top - bottom) / 2
        for i, cell in enumerate(row):
            if cell:
                middle = (edges[i] + edges[i + 1]) / 2
                shapes.append(Text(complex(middle, baseline), cell, h, "middle", role="cell"))
    return _view(name, heading, shapes, (0.0, -height, edges[-1], 0.0), style, role="table")


def _span(row: Sequence[str], h: float) -> tuple[float, float]:
    """Return how far a row of cells reaches above and below its baseline, at least as far as a capital letter."""
    layouts = [lay_out(cell, h) for cell in row]
    return max(h, *(layout.top for layout in layouts)), min(0.0, *(layout.bottom for layout in layouts))


def text_block(name: str, heading: str, lines: Sequence[Sequence[str]], style: Style, width: float) -> View:
    """Return lines of text; each line comes in chunks, and breaks between chunks where it is wider than `width`."""
    h = style.text
    shapes: list[Shape] = []
    y, widest = 0.0, 0.0
    for line in (broken for chunks in lines for broken in _broken(chunks, h, width)):
        layout = lay_out(line, h)
        y -= layout.top
        shapes.append(Text(complex(0.0, y), line, h, role="line"))
        y += layout.bottom - 0.45 * h
        widest = max(widest, layout.width)
    return _view(name, heading, shapes, (0.0, y, widest, 0.0), style, role="text")


def _broken(chunks: Sequence[str], h: float, width: float) -> list[str]:
    lines = [chunks[0]]
    for chunk in chunks[1:]:
        longer = f"{lines[-1]} {chunk}"
        if lay_out(longer, h).width > width:
            lines.append(INDENT + chunk)
        else:
            lines[-1] = longer
    return lines


def _view(name: str, heading: str, shapes: list[Shape], box: Box, style: Style, role: str) -> View:
    """Return a view of `shapes`, which fill `box`, under their heading."""
    x0, y0, x1, _ = box
    middle = (x0 + x1) / 2
    lines, top = heading_shapes((heading,), style.heading, middle, 0.0)
    half = max((lay_out(heading, style.heading).width / 2, (x1 - x0) / 2))
    body = Group(tuple(shapes), role, name)
    return View(name, (body, *lines), (middle - half - 0.5, y0 - 0.5, middle + half + 0.5, top))
