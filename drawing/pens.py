"""Pens by meaning: widths, dashes and arrowheads of each format, after GOST 2.303 and 2.307 or ISO 128."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from math import isfinite, pi, tan
from typing import Literal, TypeAlias

from .shapes import Arc, Arrow, Circle, Head, Line, Pen, Polyline, Shape, Vector, sides_of

Norm: TypeAlias = Literal["gost", "iso"]

HEAD_HALF_WIDTH = tan(pi / 18)  # of an arrowhead of unit length with an opening of 20 degrees
ZERO = 1e-9  # mm; a shorter vector has no direction that a reader could see


@dataclass(frozen=True, slots=True)
class Pens:
    """Two widths, two patterns and one arrowhead for a whole sheet, all in mm."""

    main: float
    thin: float
    arrow: float
    dashed: tuple[float, ...]
    axis: tuple[float, ...]

    @property
    def extreme(self) -> tuple[float, ...]:
        """The pattern of extreme positions: the axis with two dots (GOST 2.303, line 9)."""
        dash, gap, dot, _ = self.axis
        return dash, gap, dot, gap, dot, gap

    def width(self, pen: Pen) -> float:
        """Return the width of `pen`."""
        return self.main if pen is Pen.MAIN else self.thin

    def dashes(self, pen: Pen, length: float) -> tuple[float, ...]:
        """Return dashes and gaps for a line of `length`, stretched so that it starts and ends with a dash.

        An empty tuple means a solid line, which is also right for a line too short for two dashes.
        """
        pattern = {Pen.DASHED: self.dashed, Pen.AXIS: self.axis, Pen.EXTREME: self.extreme}.get(pen)
        if pattern is None:
            return ()
        period, dash = sum(pattern), pattern[0]
        repeats = round((length - dash) / period) if isfinite(length) else 0
        if repeats < 1:
            return ()
        factor = length / (repeats * period + dash)
        return tuple(factor * part for part in pattern)


_GOST = {
    "A1": Pens(0.8, 0.3, 4.0, (4.0, 1.5), (12.0, 1.5, 0.5, 1.5)),
    "A2": Pens(0.8, 0.3, 3.5, (4.0, 1.5), (12.0, 1.5, 0.5, 1.5)),
    "A3": Pens(0.6, 0.25, 3.0, (4.0, 1.5), (10.0, 1.3, 0.4, 1.3)),
    "A4": Pens(0.5, 0.2, 2.5, (4.0, 1.5), (8.0, 1.3, 0.4, 1.3)),
}


def _iso(main: float, arrow: float) -> Pens:
    """Lay the patterns of ISO 128 out in units of the narrow line."""
    d = main / 2
    return Pens(main, d, arrow, (12 * d, 3 * d), (24 * d, 3 * d, 0.5 * d, 3 * d))


_ISO = {"A1": _iso(0.7, 4.0), "A2": _iso(0.5, 3.5), "A3": _iso(0.5, 3.0), "A4": _iso(0.5, 2.5)}


@cache
def pens_for(width: float, height: float, norm: Norm = "gost") -> Pens:
    """Return the pens of a sheet of `width` x `height` mm."""
    side = max(width, height)
    name = "A1" if side >= 841 else "A2" if side >= 594 else "A3" if side >= 420 else "A4"
    return (_ISO if norm == "iso" else _GOST)[name]


def head_outline(head: Head, pens: Pens) -> tuple[complex, complex, complex]:
    """Return the corners of an arrowhead, its tip first."""
    along = head.direction * (pens.arrow / abs(head.direction))
    across = along * 1j * HEAD_HALF_WIDTH
    return head.tip, head.tip - along + across, head.tip - along - across


def arrow_parts(arrow: Vector | Arrow, pens: Pens) -> tuple[Shape, ...]:
    """Return the stroked shaft and the head of an arrow, or the dot of a zero vector.

    The shaft ends inside the head, so that a wide line does not blunt the tip. A head asked for at the tip of an
    arrow shorter than two heads moves to the middle while there is room for it.
    """
    span = arrow.tip - arrow.tail
    length = abs(span)
    if length < ZERO:
        return (Circle(arrow.tip, pens.main, Pen.THIN, fill=True, colour=arrow.colour),)
    if arrow.head == "none":
        return (Line(arrow.tail, arrow.tip, arrow.pen, colour=arrow.colour),)
    in_middle = arrow.head == "middle" or pens.arrow < length < 2 * pens.arrow
    tip = arrow.tail + span * ((length + pens.arrow) / (2 * length)) if in_middle else arrow.tip
    head = Head(tip, span, arrow.colour)
    if in_middle:
        return Line(arrow.tail, arrow.tip, arrow.pen, colour=arrow.colour), head
    reach = length - 0.6 * pens.arrow
    if reach <= 0:
        return (head,)
    return Line(arrow.tail, arrow.tail + span * (reach / length), arrow.pen, colour=arrow.colour), head


def length_of(shape: Line | Polyline | Circle | Arc) -> float:
    """Return the length of a line, as its dashes need it."""
    match shape:
        case Line() | Polyline():
            return sum(abs(b - a) for a, b in sides_of(shape))
        case Circle(radius=radius):
            return 2 * pi * radius
        case Arc(radius=radius, sweep=sweep):
            return abs(radius * sweep)
