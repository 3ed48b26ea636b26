"""The walk through a page that all writers share: a format adds how it puts down strokes, letters and groups."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from math import pi
from typing import TypeAlias, assert_never

from .page import Layer, Page, parts_of
from .pens import HEAD_HALF_WIDTH, ZERO
from .shapes import Arc, Arrow, Circle, Group, Head, Line, Pen, Polyline, Shape, Text, Vector, sides_of
from .text import Run, lay_out, placer

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
        lines, place = lay_out(text.markup, text.height), placer(text)
        alone = len(lines.runs) == 1 and not lines.rules
        if not alone:
            self.begin(text)
        self.letters(text, [(run, place(run.x, run.y)) for run in lines.runs], alone)
        for x0, y0, x1, y1 in lines.rules:
            self.draw(Line(place(x0, y0), place(x1, y1), Pen.THIN, "rule", "", text.colour))
        if not alone:
            self.end(text)

    def _arrow(self, arrow: Vector | Arrow) -> None:
        """Put down the shaft and the head of an arrow, or the dot of a zero vector.

        The shaft ends inside the head, so that a wide line does not blunt the tip. A head asked for at the tip of an
        arrow shorter than two heads moves to the middle while there is room for it.
        """
        head, (tail, tip, colour) = self.pens.arrow, (arrow.tail, arrow.tip, arrow.colour)
        span, length = tip - tail, abs(tip - tail)
        if length < ZERO:
            return self.draw(Circle(tip, self.pens.main, Pen.THIN, fill=True, colour=colour))
        in_middle = arrow.head == "middle" or head < length < 2 * head
        reach = length if arrow.head == "none" or in_middle else length - 0.6 * head
        if reach > 0:
            end = tip if reach == length else tail + span * (reach / length)
            self.draw(Line(tail, end, arrow.pen, colour=colour))
        if arrow.head != "none":
            middle = tail + span * ((length + head) / (2 * length))
            self.draw(Head(middle if in_middle else tip, span, colour))
        return None


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
