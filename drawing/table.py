"""Tables and blocks of text lines as views."""

from __future__ import annotations

from collections.abc import Sequence

from .shapes import Group, Line, Pen, Shape, Text
from .style import Style
from .text import lay_out
from .view import View, heading_shapes

INDENT = "    "


def table(name: str, heading: str, rows: Sequence[Sequence[str]], style: Style) -> View:
    """Return a ruled table; the first row is its head."""
    h = style.text
    pad, row_height = 0.5 * h, 2.0 * h
    columns = range(len(rows[0]))
    widths = [max(lay_out(row[i], h).width for row in rows) + 2 * pad for i in columns]
    edges = [sum(widths[:i]) for i in range(len(widths) + 1)]
    height = row_height * len(rows)
    shapes: list[Shape] = []
    for i in range(len(rows) + 1):
        pen = Pen.MAIN if i in (0, 1, len(rows)) else Pen.THIN
        shapes.append(Line(complex(0, -i * row_height), complex(edges[-1], -i * row_height), pen))
    for i, x in enumerate(edges):
        pen = Pen.MAIN if i in (0, len(edges) - 1) else Pen.THIN
        shapes.append(Line(complex(x, 0), complex(x, -height), pen))
    for j, row in enumerate(rows):
        baseline = -(j + 1) * row_height + 0.5 * (row_height - h)
        for i, cell in enumerate(row):
            if cell:
                middle = (edges[i] + edges[i + 1]) / 2
                shapes.append(Text(complex(middle, baseline), cell, h, "middle", role="cell"))
    return _view(name, heading, shapes, edges[-1] / 2, (0.0, -height, edges[-1], 0.0), style, role="table")


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
    return _view(name, heading, shapes, widest / 2, (0.0, y, widest, 0.0), style, role="text")


def _broken(chunks: Sequence[str], h: float, width: float) -> list[str]:
    lines = [chunks[0]]
    for chunk in chunks[1:]:
        longer = f"{lines[-1]} {chunk}"
        if lay_out(longer, h).width > width:
            lines.append(INDENT + chunk)
        else:
            lines[-1] = longer
    return lines


def _view(
    name: str, heading: str, shapes: list[Shape], middle: float, box: tuple[float, ...], style: Style, role: str
) -> View:
    x0, y0, x1, _ = box
    lines, top = heading_shapes((heading,), style.heading, middle, 0.0)
    half = max((lay_out(heading, style.heading).width / 2, (x1 - x0) / 2))
    body = Group(tuple(shapes), role, name)
    return View(name, (body, *lines), (middle - half - 0.5, y0 - 0.5, middle + half + 0.5, top))
