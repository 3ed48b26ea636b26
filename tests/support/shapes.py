"""Shapes of a page one by one, whatever groups they are in."""

from collections.abc import Iterable, Iterator

from kulman.drawing.shapes import Arc, Group, Line, Pen, Polyline, Shape


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
    return shape
