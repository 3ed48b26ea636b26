"""A view: one figure of a sheet about its own origin, lettered without collisions, under its heading; tables, texts."""

from __future__ import annotations

import math
from cmath import phase, rect
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import accumulate, pairwise
from math import pi
from typing import NamedTuple, TypeAlias, assert_never

from .areas import coarser
from .formats import HEAD_HALF_WIDTH, ZERO, Style
from .labels import Labels, place
from .page import NOTE, extent
from .shapes import Arc, Arrow, Circle, Group, Head, Line, Pen, Polyline, Shape, Text, Vector, shifted, sides_of
from .spots import Obstacles, Request, first_clear
from .symbols import angle_dimension, dimension, swept, turning_arrow
from .text import Box, lay_out
from .words import Given, Words

WIDE = "circle"  # the role of a circle that goes round other things
ROUND = 48  # pieces of it, for the letters that keep clear of it
EACH = 4  # letters left out that stand in one line of the notes
ABOVE = 0.5  # heights of letters between an upright dimension line and the lowest part of its text
PAST = 2.0  # mm by which an extension line runs past the dimension line


@dataclass(frozen=True, slots=True)
class View:
    """A finished figure: its shapes and the box that they fill, mm.

    What it says is kept beside the shapes: the lines of its `heading` and its `notes`, the `lines` of a text, each in
    chunks between which it may break, and the `rows` of a table, the first of which is its head. `stages` are those in
    which it is drawn, in order, with the keys of the sentences that tell them; `parts` has the stage of every shape.
    """

    name: str
    shapes: tuple[Shape, ...]
    box: Box
    heading: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    lines: tuple[tuple[str, ...], ...] = ()
    rows: tuple[tuple[str | None, ...], ...] = ()
    parts: tuple[str, ...] = ()
    stages: Mapping[str, str] = field(default_factory=dict)

    @property
    def size(self) -> tuple[float, float]:
        """Width and height."""
        return self.box[2] - self.box[0], self.box[3] - self.box[1]

    def at(self, x: float, y: float) -> Group:
        """Return the view as a group whose lower left corner stands at x, y."""
        by = complex(x - self.box[0], y - self.box[1])
        return Group(tuple(shifted(shape, by) for shape in self.shapes), "view", self.name)


class _Letter(NamedTuple):
    """A letter that is asked for, the stage to which it belongs, and what the notes say where it is left out."""

    request: Request
    markup: str
    height: float
    stage: str
    spare: str


@dataclass(slots=True)
class Canvas:
    """Where a view is drawn; letters are asked for here and placed when all lines are known."""

    style: Style
    shapes: list[Shape] = field(default_factory=list)
    _letters: dict[str, _Letter] = field(default_factory=dict)  # by the names under which they are placed
    _boxes: list[Box] = field(default_factory=list)
    _begun: list[tuple[int, str]] = field(default_factory=list)
    bounds: Box | None = None  # letters stay inside of it
    coarse: float = 0.0  # mm by which letters may take a curve of many points for a shorter broken line
    parts: Mapping[str, str] = field(default_factory=dict)  # stages of a figure, with those in which they are drawn
    stages: Mapping[str, str] = field(default_factory=dict)  # these, with the keys of their sentences if they have any

    def add(self, *shapes: Shape) -> None:
        """Draw shapes."""
        self.shapes.extend(shapes)

    def group(self, role: str, name: str, *shapes: Shape) -> None:
        """Draw shapes that are one thing."""
        self.shapes.append(Group(shapes, role, name))

    def thin(self, role: str, name: str, a: complex, b: complex) -> None:
        """Draw a thin line."""
        self.shapes.append(Line(a, b, Pen.THIN, role, name))

    def part(self, name: str, *shapes: Shape) -> str:
        """Begin, or go on with, a stage, of these shapes and all that is drawn from here on; return the one before."""
        before = self._begun[-1][1] if self._begun else ""
        own = self.parts[name] if self.stages else self.parts.get(name, name)
        self._begun.append((len(self.shapes), own))
        self.shapes.extend(shapes)
        return before

    def keep_clear(self, *points: complex) -> None:
        """Let no letter stand in the box of these points."""
        xs, ys = [p.real for p in points], [p.imag for p in points]
        self._boxes.append((min(xs), min(ys), max(xs), max(ys)))

    def label(
        self,
        markup: str,
        anchor: complex | tuple[complex, complex],
        *,
        prefer: complex = 0j,
        clear: float = 1.0,
        height: float | None = None,
        priority: int = 0,
        strict: bool = False,
        spare: str = "",
    ) -> None:
        """Ask for a letter beside a node, or beside a line from one point to another.

        One that would cover something and has a `spare` text is left out, and the text goes into the notes.
        """
        height = height or self.style.label
        layout = lay_out(markup, height)
        size = layout.width, layout.top - layout.bottom
        name, stage = str(len(self._letters)), self._begun[-1][1] if self._begun else ""
        request = Request(name, *size, anchor, clear, prefer, priority, strict, afield=not spare)
        self._letters[name] = _Letter(request, markup, height, stage, spare)

    def small(
        self, markup: str, anchor: complex | tuple[complex, complex], prefer: complex = 0j, clear: float = 0.8
    ) -> None:
        """Ask for a letter as small as texts beside a node or a line."""
        self.label(markup, anchor, prefer=prefer, clear=clear, height=self.style.text)

    def write(self, markup: str, places: Sequence[complex], height: float) -> bool:
        """Write a letter about the first of some places that is clear of all that is drawn; tell whether there is one.

        What is drawn afterwards, and other letters, keep clear of it.
        """
        layout = lay_out(markup, height)
        size = layout.width, layout.top - layout.bottom
        middle = first_clear(places, size, _obstacles(self.shapes, self._boxes, self.style), 0.8)
        if middle is None:
            return False
        self.add(Text(middle - 0.5j * (layout.top + layout.bottom), markup, height, "middle", role="label"))
        return True

    def finish(self, name: str, heading: tuple[str, ...] = (), notes: tuple[str, ...] = ()) -> View:
        """Place the letters, write the heading lines and smaller notes above, and close the view."""
        kept, placed = self._placed()
        starts = [0, *(start for start, _ in self._begun), len(self.shapes)]
        names = ["", *(name for _, name in self._begun)]
        parts = [name for name, (a, b) in zip(names, pairwise(starts), strict=True) for _ in range(a, b)]
        parts += (letter.stage for letter in kept.values())
        spare = [letter.spare for name, letter in self._letters.items() if name not in kept]
        notes = (*notes, *("; ".join(spare[i : i + EACH]) for i in range(0, len(spare), EACH)))
        for label, letter in kept.items():
            at = placed.corners[label] - 1j * lay_out(letter.markup, letter.height).bottom
            self.shapes.append(Text(at, letter.markup, letter.height, role="label"))
        for label, ends in placed.leaders.items():
            self.shapes.append(Line(*ends, Pen.THIN, role="leader", name=kept[label].markup))
            parts.append(kept[label].stage)
        x0, y0, x1, y1 = write_above(self.shapes, heading, notes, self.style)
        box = x0 - 1.0, y0 - 1.0, x1 + 1.0, y1 + 1.0
        every = (*parts, *("" for _ in self.shapes[len(parts) :])) if self._begun else ()
        return View(name, tuple(self.shapes), box, heading, tuple(notes), parts=every, stages=self.stages)

    def _placed(self) -> tuple[dict[str, _Letter], Labels]:
        """Place the letters; leave out spare ones that cover something, or that stand in the way of others."""
        shapes = [coarser(shape, self.coarse) for shape in self.shapes] if self.coarse else self.shapes
        obstacles, kept = _obstacles(shapes, self._boxes, self.style), self._letters
        while True:
            placed = place([letter.request for letter in kept.values()], obstacles, bounds=self.bounds)
            spare = [name for name, letter in kept.items() if letter.spare]
            out = {name for name in placed.failed if name in spare}
            # or numbers of arms that lines cross, which say the same under the heading
            out = out or {name for name in placed.crossed if kept[name].spare == kept[name].markup}
            if not out and spare:  # for each letter that found no place the nearest one
                corners = placed.corners
                out = {min(spare, key=lambda n: abs(corners[n] - corners[failed])) for failed in placed.failed}
            if not out:
                return kept, placed
            kept = {name: letter for name, letter in kept.items() if name not in out}


def write_above(shapes: list[Shape], heading: tuple[str, ...], notes: tuple[str, ...], style: Style) -> Box:
    """Write heading lines over shapes, and smaller notes between; return the box of all, with the top of the lines."""
    x0, y0, x1, y1 = extent(shapes)
    for texts, height, name in ((notes, style.text, NOTE), (heading, style.heading, "")):
        lines, y1 = heading_shapes(texts, height, (x0 + x1) / 2, y1, name)
        shapes += lines
    x0, _, x1, _ = extent(shapes)
    return x0, y0, x1, y1


def heading_shapes(
    lines: tuple[str, ...], height: float, middle: float, top: float, name: str = ""
) -> tuple[list[Shape], float]:
    """Write centred lines above `top`; return them and the new top."""
    texts: list[Shape] = []
    y = top + 0.7 * height if lines else top
    for line in reversed(lines):
        layout = lay_out(line, height)
        y -= layout.bottom
        texts.append(Text(complex(middle, y), line, height, "middle", role="heading", name=name))
        y += layout.top + 0.35 * height
    return texts, y


def _obstacles(shapes: list[Shape], boxes: list[Box], style: Style) -> Obstacles:
    circles: list[tuple[complex, float]] = []
    strokes: dict[bool, list[tuple[complex, complex]]] = {True: [], False: []}  # of the main pen, of others
    solid = list(boxes)

    def gather(shape: Shape) -> None:
        match shape:
            case Line() | Polyline() | Arc():
                strokes[shape.pen is Pen.MAIN].extend(sides_of(shape))
            case Circle(centre=centre, radius=radius):
                circles.append((centre, radius))
            case Head(tip=tip, direction=direction):
                solid.append(_head_box(tip, direction, style.arrow))
            case Text():
                solid.append(extent((shape,)))
            case Vector(tail=tail, tip=tip) | Arrow(tail=tail, tip=tip):
                strokes[shape.pen is Pen.MAIN].append((tail, tip))
                if shape.head != "none" and abs(tip - tail) > 0.01:
                    solid.append(_head_box(tip, tip - tail, style.arrow))
            case Group(shapes=parts, role=role):
                for part in parts:
                    if role == WIDE and isinstance(part, Circle):  # a letter may stand inside
                        ring = (part.centre + rect(part.radius, 2.0 * pi * k / ROUND) for k in range(ROUND))
                        part = Polyline(tuple(ring), part.pen, closed=True)
                    gather(part)
            case _:
                assert_never(shape)

    for shape in shapes:
        gather(shape)
    return Obstacles(strokes[True], strokes[False], circles, solid)


def _head_box(tip: complex, direction: complex, length: float) -> Box:
    along = direction / abs(direction) * length
    half = abs(along) * HEAD_HALF_WIDTH
    xs, ys = (tip.real, (tip - along).real), (tip.imag, (tip - along).imag)
    return min(xs) - half, min(ys) - half, max(xs) + half, max(ys) + half


def angle(
    canvas: Canvas,
    vertex: complex,
    rays: tuple[complex, complex],
    radius: float,
    name: str,
    text: str = "",
    *,
    turn: int = 0,
    inside: bool = False,
    prefer: complex = 0j,
    clear: float = 1.0,
    spare: str = "",
) -> None:
    """Dimension the angle from one ray to another with its text at the middle of the arc.

    `turn` says whether it runs counter-clockwise, 1, or clockwise, -1; without it the shorter way. The text stands
    beyond the arc, or `inside` of it, or to the side that it should `prefer`.
    """
    start, sweep = phase(rays[0]), swept(*rays, turn)
    canvas.add(angle_dimension(vertex, radius, start, sweep, name, canvas.style))
    if text:
        out = rect(1.0, start + 0.5 * sweep)
        at = vertex + radius * out
        toward = prefer or (-out if inside else out)
        canvas.label(text, at, prefer=toward, clear=clear, height=canvas.style.text, spare=spare)


def turning(
    canvas: Canvas, centre: complex, radius: float, middle: float, spread: float, sense: float, name: str, text: str
) -> None:
    """Draw an arrow about a centre that shows in which sense something turns, its letter beyond its middle.

    The arrow reaches to both sides of the direction `middle` by half of `spread`, rad.
    """
    at = centre + rect(radius, middle)
    canvas.add(turning_arrow(centre, radius, middle, spread, sense, name))
    canvas.label(text, at, prefer=at - centre, clear=1.0)


def linear(canvas: Canvas, ends: tuple[complex, complex], out: complex, text: str, name: str) -> None:
    """Dimension the distance between two points on a line parallel to it, moved by the vector `out`.

    Points in one place have no dimension; one that says the same as another may have no text.
    """
    a, b = ends
    if abs(b - a) < ZERO:
        return
    if abs(out) > PAST:
        past = out * (PAST / abs(out))
        canvas.add(*(Line(end, end + out + past, Pen.THIN, role="extension") for end in ends))
    canvas.add(dimension(a + out, b + out, name, canvas.style))
    if not text:
        return
    height, middle = canvas.style.text, 0.5 * (a + b) + out
    room = abs(b - a) - 2.0 * canvas.style.arrow  # between the arrowheads
    if abs((b - a).real) < ZERO and room > lay_out(text, height).width:  # upright: from below, on its left
        canvas.add(Text(middle - ABOVE * height, text, height, "middle", 0.5 * pi))
    else:
        canvas.label(text, (a + out, b + out), prefer=out, clear=0.8, height=height)


Row: TypeAlias = Sequence[str | None]
INDENT = "    "
LONG, DENOMINATOR, ROUNDING = 10, 100, 1e-11  # characters of a number that may be a simple fraction


def table(name: str, heading: str, rows: Sequence[Row], style: Style) -> View:
    """Return a ruled table; the first row is its head. A cell that is None belongs to the one on its left."""
    h = style.text
    pad = 0.5 * h
    # every column is as wide as the widest text that stands in it alone
    alone = [(i, lay_out(cell, h).width) for row in rows for i, end, cell in cells(row) if end == i + 1]
    columns = range(len(rows[0]))
    widths = [max((wide for i, wide in alone if i == column), default=0.0) + 2 * pad for column in columns]
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
    y, widest = 0.0, 0.0
    for first, *others in lines:
        broken = [first]
        for chunk in others:
            longer = f"{broken[-1]} {chunk}"
            broken[-1:] = [broken[-1], INDENT + chunk] if lay_out(longer, h).width > width else [longer]
        for line in broken:
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


def _view(name: str, heading: str, shapes: list[Shape], box: Box, style: Style, role: str) -> View:
    """Return a view of `shapes`, which fill `box`, under their heading."""
    x0, y0, x1, _ = box
    middle = (x0 + x1) / 2
    lines, top = heading_shapes((heading,), style.heading, middle, 0.0)
    half = max((lay_out(heading, style.heading).width / 2, (x1 - x0) / 2))
    body = Group(tuple(shapes), role, name)
    return View(name, (body, *lines), (middle - half - 0.5, y0 - 0.5, middle + half + 0.5, top), (heading,))
