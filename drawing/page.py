"""A page: its size, its shapes, and what they cover."""

from __future__ import annotations

from cmath import rect
from collections.abc import Iterable
from dataclasses import dataclass
from math import pi, tau
from typing import assert_never

from .pens import Norm, Pens, pens_for
from .shapes import Arc, Arrow, Circle, Group, Head, Line, Polyline, Shape, Text, Vector
from .text import Box, corners


@dataclass(frozen=True, slots=True)
class Page:
    """A sheet of paper of `width` x `height` mm with shapes on it, ready for any writer.

    `language` is the language of its words ("uk", "ru", "en"); `norm` picks the widths of its lines. With `layers` a
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

    Raises
    ------
    ValueError
        There are no shapes.
    """
    points = [point for shape in shapes for point in _reach(shape)]
    xs, ys = [point.real for point in points], [point.imag for point in points]
    return min(xs), min(ys), max(xs), max(ys)
