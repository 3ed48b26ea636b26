"""Shapes of a page one by one, whatever groups they are in; places along a line and within a box."""

from collections.abc import Iterable, Iterator

import numpy as np

from kulman.drawing.shapes import Arc, Group, Line, Pen, Polyline, Shape, Text


def leaves(shapes: Iterable[Shape]) -> Iterator[Shape]:
    """Go through all that is no group, in the order of painting."""
    for shape in shapes:
        if isinstance(shape, Group):
            yield from leaves(shape.shapes)
        else:
            yield shape


def line_of(shape: Shape) -> object:
    """The straight line or the circle on which a piece lies that letters may break off, else the shape as it is."""
    match shape:
        case Line(a=a, b=b, role=role, name=name) if shape.pen is not Pen.MAIN and a != b:
            u = (b - a) / abs(b - a)
            return role, name, shape.pen, round(u.real, 6), round(u.imag, 6), round((a * u.conjugate()).imag, 4)
        case Arc(centre=centre, radius=radius, role=role, name=name):
            return role, name, shape.pen, round(centre.real, 4), round(centre.imag, 4), round(radius, 4)
        case Polyline(pen=Pen.THIN, role="profile", name=name):
            return "profile", name
        case Text(at=at, markup=markup, role="label"):  # letters that share a place come one after another
            return markup.partition(", ")[0], round(at.real, 4), round(at.imag, 4), shape.height
    return shape


def places(a: complex, b: complex, count: int = 2000) -> np.ndarray:
    """Places along a line, none of them at its ends."""
    return a + (b - a) * (np.arange(count) + 0.5) / count


def within(at: np.ndarray, box: tuple[float, float, float, float]) -> np.ndarray:
    x0, y0, x1, y1 = box
    return (at.real > x0) & (at.real < x1) & (at.imag > y0) & (at.imag < y1)
