"""Tables and blocks of text lines as views."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import accumulate, pairwise
from typing import TypeAlias

from .formats import Style
from .shapes import Group, Line, Pen, Shape, Text
from .text import Box, lay_out
from .view import View, heading_shapes
from .words import Given, Words

Row: TypeAlias = Sequence[str | None]
INDENT = "    "
LONG, DENOMINATOR, ROUNDING = 10, 100, 1e-11  # characters of a number that may be a simple fraction


def table(name: str, heading: str, rows: Sequence[Row], style: Style) -> View:
    """Return a ruled table; the first row is its head. A cell that is None belongs to the one on its left."""
    h = style.text
    pad = 0.5 * h
    widths = [wide + 2 * pad for wide in _widths(rows, h)]
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
        shapes += (Line(complex(x, levels[j]), complex(x, levels[k]), pen) for j, k in _ruled(rows, i))
    for j, (row, (top, bottom)) in enumerate(zip(rows, spans, strict=True)):
        baseline = (levels[j] + levels[j + 1] - top - bottom) / 2
        shapes += (
            Text(complex((edges[i] + edges[end]) / 2, baseline), cell, h, "middle", role="cell")
            for i, end, cell in cells(row)
            if cell
        )
    view = _view(name, heading, shapes, (0.0, -height, edges[-1], 0.0), style, role="table")
    return replace(view, rows=tuple(tuple(row) for row in rows))


def cells(row: Row) -> Iterator[tuple[int, int, str]]:
    """Go through the cells of a row: the columns where they begin and before which they end, and their text."""
    for i, cell in enumerate(row):
        if cell is not None or i == 0:
            yield i, next((k for k in range(i + 1, len(row)) if row[k] is not None), len(row)), cell or ""


def _widths(rows: Sequence[Row], h: float) -> list[float]:
    """Return for every column how wide the widest text is that stands in it alone."""
    alone = [(i, lay_out(cell, h).width) for row in rows for i, end, cell in cells(row) if end == i + 1]
    return [max((width for i, width in alone if i == column), default=0.0) for column in range(len(rows[0]))]


def _ruled(rows: Sequence[Row], edge: int) -> list[tuple[int, int]]:
    """Return from which level to which a line runs on the left of a column: broken where a cell goes on over it."""
    crossed = [j for j, row in enumerate(rows) if 0 < edge < len(row) and row[edge] is None]
    ends = [-1, *crossed, len(rows)]
    return [(a + 1, b) for a, b in pairwise(ends) if b > a + 1]


def _span(row: Row, h: float) -> tuple[float, float]:
    """Return how far a row of cells reaches above and below its baseline, at least as far as a capital letter."""
    layouts = [lay_out(cell or "", h) for cell in row]
    return max(h, *(layout.top for layout in layouts)), min(0.0, *(layout.bottom for layout in layouts))


def givens_view(
    givens: Mapping[str, Given], words: Words, style: Style, more: Sequence[tuple[str, str, str]] = ()
) -> View:
    """Return the table of the givens in the task's own units; `more` rows of the same columns follow."""
    rows = [[words["table.symbol"], words["table.value"], words["table.unit"]]]
    for name, given in givens.items():
        if isinstance(given.value, str):
            rows.append([*words.choice(name, given.value), ""])
        else:
            rows.append([words.symbol(name), _number(words, given.value), words.unit(given.unit)])
    rows += map(list, more)
    return table("givens", words["heading.givens"], rows, style)


def _number(words: Words, value: float) -> str:
    """Return a number as short as it is: a third as a fraction."""
    if math.isinf(value):
        return "∞"
    simple = Fraction(value).limit_denominator(DENOMINATOR)
    whole = simple.denominator == 1
    if len(text := words.short(value)) > LONG and not whole and abs(value - simple) < ROUNDING * abs(value):
        return f"{simple.numerator}/{simple.denominator}"
    return text


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
    view = _view(name, heading, shapes, (0.0, y, widest, 0.0), style, role="text")
    return replace(view, lines=tuple(tuple(line) for line in lines))


def note_block(words: Words, note: str, style: Style, width: float) -> View:
    """Return what the task says of its data as a block of text."""
    return text_block("note", words["heading.note"], [words_of(note)], style, width)


def words_of(sentence: str) -> tuple[str, ...]:
    """Return a sentence as a line of text that may break between any two words."""
    return tuple(sentence.split())


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
    return View(name, (body, *lines), (middle - half - 0.5, y0 - 0.5, middle + half + 0.5, top), (heading,))
