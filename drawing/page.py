"""A page: its size, its shapes, what they cover, and the layers that a reader shows or hides together.

All writers share the walk through a page: a format adds how it puts down strokes, letters and groups.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from cmath import rect
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from enum import Enum
from itertools import groupby
from math import pi, tau
from typing import TypeAlias, assert_never

from ..scales.packaged import packaged
from .font import SCREEN, SLANTED, font
from .formats import HEAD_HALF_WIDTH, ZERO, Norm, Pens, pens_for
from .letters import DOT, drawn
from .shapes import Arc, Arrow, Circle, Group, Head, Line, Pen, Polyline, Shape, Text, Vector, sides_of
from .text import LETTERING, STROKES, Box, Run, corners, laid_out, lettered, placer


@dataclass(frozen=True, slots=True)
class Page:
    """A sheet of paper of `width` x `height` mm with shapes on it, ready for any writer.

    `language` is the language of its words ("uk", "ru", "en"); `norm` picks the widths of its lines, `lettering`
    its letters. With `layers` a
    file keeps what is given, construction, results and letters apart, so that a reader can hide any of them; without
    them each view is one group.
    """

    width: float
    height: float
    shapes: tuple[Shape, ...]
    title: str
    language: str
    norm: Norm = "gost"
    layers: bool = False
    lettering: str = field(default_factory=lambda: LETTERING.get().name)

    @property
    def pens(self) -> Pens:
        """Return the widths, dashes and arrowheads of a page of this size."""
        return pens_for(self.width, self.height, self.norm)


def _reach(shape: Shape) -> tuple[complex, ...]:
    """Return points whose box is the box of `shape`, line widths and arrowheads left out."""
    match shape:
        case Line(a=a, b=b):
            return a, b
        case Polyline(points=points):
            return points
        case Circle(centre=centre, radius=radius):
            return centre - complex(radius, radius), centre + complex(radius, radius)
        case Arc(centre=centre, radius=radius, start=start, sweep=sweep):
            low = min(start, start + sweep)
            high = min(max(start, start + sweep), low + tau)  # however often it goes round
            quarters = (quarter * pi / 2 for quarter in range(int(low // (pi / 2)) + 1, int(high // (pi / 2)) + 1))
            return tuple(centre + radius * rect(1.0, angle) for angle in (low, high, *quarters))
        case Head(tip=tip):
            return (tip,)
        case Text():
            return corners(shape)
        case Vector(tail=tail, tip=tip) | Arrow(tail=tail, tip=tip):
            return tail, tip
        case Group(shapes=shapes):
            return tuple(point for part in shapes for point in _reach(part))
        case _:
            assert_never(shape)


def extent(shapes: Iterable[Shape]) -> Box:
    """Return the box (x0, y0, x1, y1) that shapes cover, texts included, line widths left out.

    Raises ValueError: there are no shapes.
    """
    points = [point for shape in shapes for point in _reach(shape)]
    xs, ys = [point.real for point in points], [point.imag for point in points]
    return min(xs), min(ys), max(xs), max(ys)


NOTE = "note"  # the name of lines under a heading, which may hold results
SCHEME, DATA, TASK = STATEMENT = ("kinematic", "givens", "task")  # views of the statement of a task
TASK_VIEWS = (*STATEMENT, "data", "choices", "scales")  # of the task, and of how it is drawn


class Layer(Enum):
    """A layer by its name in a file; those that come later are painted over those before them."""

    GRID = "grid"
    FRAME = "frame"
    CONSTRUCTION = "construction"
    GIVEN = "given"
    RESULT = "result"
    LABELS = "labels"
    KEY = "key"

    @property
    def hidden(self) -> bool:
        """Whether a file opens without it."""
        return self is Layer.KEY

    def title(self, language: str) -> str:
        """Return what it is called in a list of layers."""
        text: str = packaged(__package__, "texts", language)[f"layer.{self.value}"]
        return text


# by role; what has none of these is judged by its pen, and a text is a label
_ROLES = {
    Layer.FRAME: "edge titleblock margin ruler",
    Layer.GIVEN: "heading axis pivot guide ground support shaft pole",
    Layer.RESULT: "link pair centre node curve mean contact touch sharpest extreme rigid spring arrow arm "
    "line-of-action enlarged magnified table text",
    Layer.LABELS: "dimension extension leader point ordinate",
}
_LAYERS = {role: layer for layer, roles in _ROLES.items() for role in roles.split()}


def parts_of(page: Page) -> Sequence[tuple[Layer | None, Sequence[Shape]]]:
    """Return the shapes of a page by layers, in the order of painting; all as they come where it has none.

    A view is parted into groups of one name. Within a layer shapes keep their order.
    """
    if not page.layers:
        return [(None, page.shapes)]
    layers: dict[Layer, list[Shape]] = {layer: [] for layer in Layer}
    for shape in page.shapes:
        if not isinstance(shape, Group) or shape.role != "view":
            layers[Layer.FRAME if getattr(shape, "role", "") == "frame" else _layer_of(shape)].append(shape)
        elif shape.layer or shape.name in TASK_VIEWS:
            layers[Layer(shape.layer or Layer.GIVEN)].append(shape)
        else:
            for layer in dict.fromkeys(map(_layer_of, shape.shapes)):
                parts = tuple(part for part in shape.shapes if _layer_of(part) is layer)
                layers[layer].append(replace(shape, shapes=parts))
    return [(layer, shapes) for layer, shapes in layers.items() if shapes]


def _layer_of(shape: Shape) -> Layer:
    """Return the layer of a part of a view, which is in it as a whole."""
    if isinstance(shape, Group) and shape.layer:
        return Layer(shape.layer)
    if isinstance(shape, Vector | Arrow):
        return Layer.RESULT
    if isinstance(shape, Head):  # of an axis: others are in groups
        return Layer.GIVEN
    if shape.name == NOTE and isinstance(shape, Text):
        return Layer.LABELS
    known = _LAYERS.get(shape.role)
    if known is not None:
        return known
    if isinstance(shape, Text):
        return Layer.LABELS
    if isinstance(shape, Group):
        return _layer_of(shape.shapes[0]) if shape.shapes else Layer.CONSTRUCTION
    if shape.pen is Pen.AXIS:
        return Layer.GIVEN
    return Layer.RESULT if shape.pen is Pen.MAIN else Layer.CONSTRUCTION


BLACK = "#000"
Stroke: TypeAlias = Line | Polyline | Circle | Arc
Part: TypeAlias = Layer | Group | Vector | Arrow | Text  # what is a group in a file


class Walk(ABC):
    """Goes through a page, layer by layer, and puts down what can be seen."""

    def __init__(self, page: Page) -> None:
        self.page, self.pens = page, page.pens

    @abstractmethod
    def stroke(self, shape: Stroke, dashes: tuple[float, ...]) -> None:
        """Put down a line; no `dashes` are a solid one."""

    @abstractmethod
    def head(self, corners: tuple[complex, complex, complex], colour: str) -> None:
        """Put down an arrowhead, its tip first."""

    @abstractmethod
    def letters(self, text: Text, runs: Sequence[tuple[Run, complex]], alone: bool) -> None:
        """Put down the runs of a text at their places; `alone` there is one, and nothing above it or below."""

    @abstractmethod
    def begin(self, part: Part) -> None:
        """Begin a group, or a layer."""

    @abstractmethod
    def end(self, part: Part) -> None:
        """End it."""

    def whole(self) -> None:
        """Go through the page. Raises ValueError: a coordinate is not a finite number."""
        with lettered(self.page.lettering, self.page.language):
            for layer, shapes in parts_of(self.page):
                if layer is not None:
                    self.begin(layer)
                for shape in shapes:
                    self.draw(shape)
                if layer is not None:
                    self.end(layer)

    def draw(self, shape: Shape) -> None:
        """Put down a shape."""
        match shape:
            case Line() | Polyline() | Circle() | Arc():
                solid = shape.pen in (Pen.MAIN, Pen.THIN)
                self.stroke(shape, () if solid else self.pens.dashes(shape.pen, _length(shape)))
            case Head(tip=tip, direction=direction):
                along = direction * (self.pens.arrow / abs(direction))
                across = along * 1j * HEAD_HALF_WIDTH
                self.head((tip, tip - along + across, tip - along - across), shape.colour or BLACK)
            case Text():
                self._text(shape)
            case Vector() | Arrow():
                self.begin(shape)
                self._arrow(shape)
                self.end(shape)
            case Group(shapes=shapes):
                self.begin(shape)
                for part in shapes:
                    self.draw(part)
                self.end(shape)
            case _:
                assert_never(shape)

    def _text(self, text: Text) -> None:
        """Put down the runs of a text, and its rules as thin lines."""
        lines, place = laid_out(text), placer(text)
        strokes = self.page.lettering == STROKES
        alone = len(lines.runs) == 1 and not lines.rules and not strokes
        if not alone:
            self.begin(text)
        for as_lines, some in groupby(lines.runs, lambda run: strokes and run.face != SCREEN):
            runs = [(run, place(run.x, run.y)) for run in some]
            if as_lines:
                for run, at in runs:
                    self.strokes(text, run, at)
            else:
                self.letters(text, runs, alone)
        for x0, y0, x1, y1 in lines.rules:
            self.draw(Line(place(x0, y0), place(x1, y1), Pen.THIN, "rule", "", text.colour))
        if not alone:
            self.end(text)

    def strokes(self, text: Text, run: Run, at: complex) -> None:
        """Put down letters of the drafting alphabet as lines."""
        along, height = rect(1.0, text.angle), run.size / font(run.face).size
        for line in drawn(run.string, height, run.face == SLANTED):
            points = tuple(at + complex(text.squeeze * point.real, point.imag) * along for point in line)
            if len(points) == 1:
                self.draw(Circle(*points, DOT * height, Pen.THIN, fill=True, role="letter", colour=text.colour))
            else:
                self.draw(Polyline(points, Pen.THIN, role="letter", colour=text.colour))

    def _arrow(self, arrow: Vector | Arrow) -> None:
        """Put down the shaft and the head of an arrow, or the dot of a zero vector.

        The shaft ends inside the head, so that a wide line does not blunt the tip. A head asked for at the tip of an
        arrow shorter than two heads moves to the middle while there is room for it.
        """
        head, (tail, tip, colour) = self.pens.arrow, (arrow.tail, arrow.tip, arrow.colour)
        span, length = tip - tail, abs(tip - tail)
        if length < ZERO:
            return self.draw(Circle(tip, self.pens.main, Pen.THIN, fill=True, colour=colour))
        point = head_of(arrow, head)
        reach = length if point != tip else length - 0.6 * head
        if reach > 0:
            end = tip if reach == length else tail + span * (reach / length)
            self.draw(Line(tail, end, arrow.pen, colour=colour))
        if point is not None:
            self.draw(Head(point, span, colour))
        return None


def head_of(arrow: Vector | Arrow, head: float) -> complex | None:
    """Return where the point of an arrow's head of so many mm is, if it has one: at its tip, or near its middle."""
    span, length = arrow.tip - arrow.tail, abs(arrow.tip - arrow.tail)
    if arrow.head == "none" or length < ZERO:
        return None
    in_middle = arrow.head == "middle" or head < length < 2 * head
    return arrow.tail + span * ((length + head) / (2 * length)) if in_middle else arrow.tip


def filled(shape: Polyline | Circle) -> str | None:
    """Return the colour of an area, if it has one."""
    match shape.fill:
        case "white":
            return "#fff"
        case "black":
            return BLACK
        case True:
            return shape.colour or BLACK
        case False:
            return None
        case _:
            assert_never(shape.fill)


def _length(shape: Stroke) -> float:
    match shape:
        case Line() | Polyline():
            return sum(abs(b - a) for a, b in sides_of(shape))
        case Circle(radius=radius):
            return 2 * pi * radius
        case Arc(radius=radius, sweep=sweep):
            return abs(radius * sweep)
