"""A page: its size, its shapes, what they cover, and the layers that a reader shows or hides together."""

from __future__ import annotations

from cmath import rect
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from enum import Enum
from math import pi, tau
from typing import assert_never

from ..scales.packaged import packaged
from .pens import Norm, Pens, pens_for
from .shapes import Arc, Arrow, Circle, Group, Head, Line, Pen, Polyline, Shape, Text, Vector
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

    Raises ValueError: there are no shapes.
    """
    points = [point for shape in shapes for point in _reach(shape)]
    xs, ys = [point.real for point in points], [point.imag for point in points]
    return min(xs), min(ys), max(xs), max(ys)


NOTE = "note"  # the name of lines under a heading, which may hold results
TASK_VIEWS = ("givens", "data", "choices", "note", "structure", "scales")  # of the task, and of how it is drawn


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
