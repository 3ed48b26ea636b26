"""Tables and blocks of text as views under their headings; parts of them where they go on on another page."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import accumulate, pairwise
from typing import TypeAlias

from .formats import Style
from .shapes import Anchor, Group, Line, Pen, Shape, Text
from .text import Box, lay_out, symbol
from .view import View, heading_shapes
from .words import Given, Words

Row: TypeAlias = Sequence[str | None]
INDENT = "    "
NUMBER = re.compile(r"([−±]?\d+)(?:[.,]\d+)?(?:·10\^\{−?\d+\})?")  # and what of it stands before the comma
SENTENCE = re.compile(r"[^\W\d_]{3,} +[^\W\d_]{2,}(?![\w.])")  # two words, none cut short
WORD, SCRIPTS = re.compile(r"[^\W\d_]{3,}"), re.compile(r"[_^]\{[^}]*\}")  # in words; in symbols what is no letter
BREAKS = re.compile(r" +(?![^{]*\})")
LARGER = {2.5: 3.5, 3.5: 5.0}  # heights of letters where a page has room, by the usual ones
PITCH = 1.7  # heights of letters from line to line (GOST 2.304)
CELL = 1.75  # mm at least on both sides of what stands in a cell
BETWEEN, UNDERLINED = 0.45, 0.9  # heights of letters between lines of text, and below one that is underlined
SURELY = 0.9  # part of the width of a text in which chunks surely have room that together are no longer
LONG, DENOMINATOR, ROUNDING = 10, 100, 1e-11  # characters of a number that may be a simple fraction


def table(name: str, heading: str, rows: Sequence[Row], style: Style, least: float = 0.0) -> View:
    """Return a ruled table at `least` so wide; the first row is its head. A None belongs to the cell on its left.

    Capitals stand in the middle of their row; numbers of a column with their commas under one another, sentences and
    the words above and below them from its left edge, all else in its middle.
    """
    h, columns = style.text, range(len(rows[0]))
    every = [[*cells(row)] for row in rows]
    alone = [{j: cell for j, own in enumerate(every) for k, end, cell in own if k == i == end - 1} for i in columns]
    placed = [_in_column(column, h) for column in alone]
    beside = 2.0 * max(0.5 * h, CELL)
    widths = [wide + beside for wide, *_ in placed]
    for i, end, cell in (found for own in every for found in own if found[1] > found[0] + 1 and found[2]):
        short = lay_out(cell, h).width + beside - sum(widths[i:end])  # of what stands in several columns
        widths[i:end] = [wide + max(short, 0.0) / (end - i) for wide in widths[i:end]]
    more = max(least - sum(widths), 0.0) / len(widths)  # each column has its share of it
    widths = [wide + more for wide in widths]
    edges = [0.0, *accumulate(widths)]
    # scripts reach past the capitals in the middle of a row: it is as much higher on both sides
    reach = (max(top - h, -bottom) for top, bottom in (_span(row, h) for row in rows))
    levels = [0.0, *accumulate(-max(2.0 * h, 1.25 * h + 2.0 * past, style.row) for past in reach)]
    shapes: list[Shape] = []
    for i, y in enumerate(levels):
        pen = Pen.MAIN if i in (0, 1, len(rows)) else Pen.THIN
        shapes.append(Line(complex(0, y), complex(edges[-1], y), pen))
    for i, x in enumerate(edges):
        pen = Pen.MAIN if i in (0, len(edges) - 1) else Pen.THIN
        shapes += (Line(complex(x, levels[j]), complex(x, levels[k]), pen) for j, k in _ruled(rows, i))
    for j, own in enumerate(every):
        baseline = 0.5 * (levels[j] + levels[j + 1] - h)
        for i, end, cell in own:
            start = placed[i][1].get(j) if end == i + 1 else None
            x = 0.5 * (edges[i] + edges[end]) if start is None else edges[i] + placed[i][2] * more + start
            if cell:
                anchor: Anchor = "middle" if start is None else "left"
                shapes.append(Text(complex(x, baseline), cell, h, anchor, role="cell"))
    view = _view(name, heading, shapes, (0.0, levels[-1], edges[-1], 0.0), style, role="table")
    return replace(view, rows=tuple(tuple(row) for row in rows), style=style, width=least)


def _in_column(column: Mapping[int, str], h: float) -> tuple[float, dict[int, float], float]:
    """Return how wide the texts of a column are, and where those begin that do not stand in its middle, by row.

    These stand by so much of what a column is wider than its texts farther to the right.
    """
    wide = {j: lay_out(cell, h).width for j, cell in column.items()}
    widest = max(wide.values(), default=0.0)
    if any(SENTENCE.search(cell) for j, cell in column.items() if j):
        said = (j for j, cell in column.items() if j and WORD.search(SCRIPTS.sub("", cell)))
        return widest, dict.fromkeys(said, max(0.5 * h, CELL)), 0.0
    before = {j: lay_out(number[1], h).width for j, cell in column.items() if (number := NUMBER.fullmatch(cell))}
    left, right = max(before.values(), default=0.0), max((wide[j] - before[j] for j in before), default=0.0)
    widest = max(widest, left + right)
    start = max(0.5 * h, CELL) + 0.5 * (widest - left - right) + left
    return widest, {j: start - own for j, own in before.items()}, 0.5


def cells(row: Row) -> Iterator[tuple[int, int, str]]:
    """Go through the cells of a row: the columns where they begin and before which they end, and their text."""
    for i, cell in enumerate(row):
        if cell is not None or i == 0:
            yield i, next((k for k in range(i + 1, len(row)) if row[k] is not None), len(row)), cell or ""


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
    givens: Mapping[str, Given],
    words: Words,
    style: Style,
    more: Sequence[tuple[str, str, str]] = (),
    called: Mapping[str, str] | None = None,
) -> View:
    """Return the table of the givens in the task's own units; `more` rows of the same columns follow.

    Where it is said what they are `called`, that stands in a column of its own, and nothing follows.
    """
    rows = [[words["table.symbol"], words["table.value"], words["table.unit"]]]
    for name, given in givens.items():
        if isinstance(given.value, str):
            rows.append([*words.choice(name, given.value), ""])
        else:
            rows.append([symbol(words.symbol(name)), _number(words, given.value), words.unit(given.unit)])
    rows += map(list, more)
    if called is None:
        return table("givens", words["heading.givens"], rows, style)
    named: list[Row] = [[rows[0][0], words["table.called"], *rows[0][1:]]]
    for (shown, *cells), (name, given) in zip(rows[1:], givens.items(), strict=False):
        chosen = ["", shown[:1].upper() + shown[1:], cells[0], None]
        named.append(chosen if isinstance(given.value, str) else [shown, called.get(name, ""), *cells])
    return table("givens", words["heading.givens"], named, style)


def with_unit(value: str, unit: str) -> str:
    """Return a number with its unit; the sign of degrees stands close."""
    return f"{value}{'' if unit.startswith('°') else ' '}{unit}".rstrip()


def _number(words: Words, value: float) -> str:
    """Return a number as short as it is: a third as a fraction."""
    if math.isinf(value):
        return "∞"
    if len(text := words.short(value)) > LONG:
        from fractions import Fraction  # few numbers need it

        simple = Fraction(value).limit_denominator(DENOMINATOR)
        if simple.denominator != 1 and abs(value - simple) < ROUNDING * abs(value):
            return f"{simple.numerator}/{simple.denominator}"
    return text


def text_block(name: str, heading: str, lines: Sequence[Sequence[str]], style: Style, width: float) -> View:
    """Return lines of text; each line comes in chunks, and breaks between chunks where it is wider than `width`."""
    h = style.text
    shapes: list[Shape] = []
    base, low, widest = 0.0, 0.0, 0.0  # of the line before
    for first, *others in lines:
        broken, wide = [first], lay_out(first, h).width
        for chunk in others:
            longer, own = f"{broken[-1]} {chunk}", h + lay_out(chunk, h).width
            # few lines are laid out whole: only those whose chunks tell nearly as much as there is room for
            fits = wide + own <= SURELY * width or lay_out(longer, h).width <= width
            broken[-1:], wide = ([longer], wide + own) if fits else ([broken[-1], INDENT + chunk], 2.0 * h + own)
        for line in broken:
            layout = lay_out(line, h)
            base = min(low - layout.top, base - PITCH * h) if shapes else -layout.top
            shapes.append(Text(complex(0.0, base), line, h, role="line"))
            underlined = any(rule[1] < 0.0 for rule in layout.rules)
            low = base + layout.bottom - (UNDERLINED if underlined else BETWEEN) * h
            widest = max(widest, layout.width)
    view = _view(name, heading, shapes, (0.0, low, widest, 0.0), style, role="text")
    return replace(view, lines=tuple(tuple(line) for line in lines), style=style, width=width)


def part_of(view: View, begin: int, end: int, heading: str) -> View:
    """Return these rows of a table, under its head, or lines of a text; the first part has its name."""
    rows = view.rows[:1] + view.rows[1 + begin : 1 + end]
    part = replace(view, heading=(heading,), rows=rows, lines=view.lines[begin:end], of=view.of or view.name)
    return _again(replace(part, name=view.name if begin == 0 else f"{view.name}_continued"), view.style)


def paged(view: View, high: float, goes_on: str) -> Iterator[View]:
    """Go through the parts, at most `high` mm each and nearly equal, of a table or a text that is higher than that.

    Any other view comes as it is. Headings of the parts after the first one are worded by `goes_on`.
    """
    heading = "".join(view.heading)
    while view.size[1] > high and view.pieces > 1:
        most = view.pieces // math.ceil(view.size[1] / high)
        parts = ((count, part_of(view, 0, count, "".join(view.heading))) for count in range(most, 0, -1))
        found = next(((count, part) for count, part in parts if part.size[1] <= high), None)
        if found is None:
            break
        yield found[1]
        view = part_of(view, found[0], view.pieces, goes_on.format(heading=heading))
    yield view


def after(view: View, rest: View) -> View:
    """Return a part of a table or of a text with the rows or lines of the part that follows it."""
    rows = (*view.rows, *rest.rows[1:])
    return _again(replace(view, rows=rows, lines=(*view.lines, *rest.lines)), view.style)


def larger(view: View, wide: bool) -> View:
    """Return a table or a text with letters of the next height; a figure stays, and what is to be written in."""
    style = view.style
    if style is None or style.row or style.text not in LARGER:
        return view
    width = view.width * (LARGER[style.text] / style.text if wide and view.lines else 1.0)
    return _again(replace(view, width=width), replace(style, text=LARGER[style.text]))


def roomier(view: View, wide: float, row: float) -> View:
    """Return a table at least so wide and with rows at least so high; all else stays."""
    if view.style is None or not view.rows:
        return view
    return _again(replace(view, width=max(view.width, wide)), replace(view.style, row=max(view.style.row, row)))


def narrower(view: View, wide: float) -> View:
    """Return a text whose lines are no longer, mm."""
    return _again(replace(view, width=wide), view.style)


def _again(view: View, style: Style | None) -> View:
    """Return a table or a text with its own rows or lines, in this style."""
    if style is None:
        raise ValueError(f"{view.name} has no parts")
    heading = "".join(view.heading)
    if view.rows:
        again = table(view.name, heading, view.rows, style, view.width)
    else:
        again = text_block(view.name, heading, view.lines, style, view.width)
    return replace(again, of=view.of, about=view.about)


def words_of(sentence: str) -> tuple[str, ...]:
    """Return a sentence as a line of text that may break between any two words, but within no index."""
    return tuple(BREAKS.split(sentence))


def _view(name: str, heading: str, shapes: list[Shape], box: Box, style: Style, role: str) -> View:
    """Return a view of `shapes`, which fill `box`, under their heading."""
    x0, y0, x1, _ = box
    middle = (x0 + x1) / 2
    lines, top = heading_shapes((heading,), style.heading, middle, 0.0)
    half = max((lay_out(heading, style.heading).width / 2, (x1 - x0) / 2))
    body = Group(tuple(shapes), role, name)
    return View(name, (body, *lines), (middle - half - 0.5, y0 - 0.5, middle + half + 0.5, top + 1.0), (heading,))
