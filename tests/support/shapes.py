"""Shapes of a page one by one, whatever groups they are in."""

from collections.abc import Iterable, Iterator

from kulman.drawing.shapes import Group, Shape


def leaves(shapes: Iterable[Shape]) -> Iterator[Shape]:
    """Go through all that is no group, in the order of painting."""
    for shape in shapes:
        if isinstance(shape, Group):
            yield from leaves(shape.shapes)
        else:
            yield shape
