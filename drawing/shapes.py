"""What can stand on a sheet: a closed union of shapes in millimetres, y up, points as complex numbers."""

from __future__ import annotations

from cmath import rect
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from enum import Enum
from itertools import pairwise
from math import ceil
from typing import Any, Literal, TypeAlias, assert_never

BESIDE = 0.1  # mm between an arc and chords that stand for it
Fill: TypeAlias = bool | Literal["white", "black"]
Anchor: TypeAlias = Literal["left", "middle", "right"]
HeadPlace: TypeAlias = Literal["tip", "middle", "none"]


class Pen(Enum):
    """A line by its meaning; its width belongs to the format of the sheet (`formats.py`)."""

    MAIN = "main"
    THIN = "thin"
    DASHED = "dashed"
    AXIS = "axis"
    EXTREME = "extreme"


@dataclass(frozen=True, slots=True)
class Line:
    """A straight line from `a` to `b`."""

    a: complex
    b: complex
    pen: Pen = Pen.MAIN
    role: str = ""
    name: str = ""
    colour: str | None = None


@dataclass(frozen=True, slots=True)
class Polyline:
    """A broken line or an area; `fill=True` fills it with the colour of its line."""

    points: tuple[complex, ...]
    pen: Pen = Pen.MAIN
    closed: bool = False
    fill: Fill = False
    role: str = ""
    name: str = ""
    colour: str | None = None


@dataclass(frozen=True, slots=True)
class Circle:
    """A circle about `centre`."""

    centre: complex
    radius: float
    pen: Pen = Pen.MAIN
    fill: Fill = False
    role: str = ""
    name: str = ""
    colour: str | None = None


@dataclass(frozen=True, slots=True)
class Arc:
    """An arc about `centre` from the angle `start` through `sweep`, radians, counter-clockwise positive."""

    centre: complex
    radius: float
    start: float
    sweep: float
    pen: Pen = Pen.THIN
    role: str = ""
    name: str = ""
    colour: str | None = None


@dataclass(frozen=True, slots=True)
class Head:
    """An arrowhead of the sheet's one size: its tip, and the direction in which it points."""

    tip: complex
    direction: complex
    colour: str | None = None


@dataclass(frozen=True, slots=True)
class Text:
    """One line of text in the markup of `text.py`.

    `at` lies on the baseline, at the end or middle that `anchor` names; `height` is the height of a capital letter in
    mm; `angle` turns the text about `at` (radians); `squeeze` below 1 makes the letters narrower. A letter is `of` a
    node, or of the line from one point to another.
    """

    at: complex
    markup: str
    height: float = 3.5
    anchor: Anchor = "left"
    angle: float = 0.0
    role: str = "label"
    name: str = ""
    colour: str | None = None
    squeeze: float = 1.0
    of: tuple[complex, ...] = ()


@dataclass(frozen=True, slots=True)
class Vector:
    """A quantity drawn to the scale `mu` (units per millimetre), from `tail` to `tip`.

    `value` is the full-precision magnitude in `unit`; a zero vector is drawn as a dot.
    """

    tail: complex
    tip: complex
    quantity: str
    value: float
    unit: str
    mu: float
    pen: Pen = Pen.MAIN
    title: str = ""
    head: HeadPlace = "tip"
    colour: str | None = None


@dataclass(frozen=True, slots=True)
class Arrow:
    """An arrow that only shows a direction; its length means nothing."""

    tail: complex
    tip: complex
    pen: Pen = Pen.THIN
    name: str = ""
    title: str = ""
    head: HeadPlace = "tip"
    colour: str | None = None


@dataclass(frozen=True, slots=True)
class Group:
    """Shapes that belong together: a link, an arm, a dimension, a point, a curve, a view.

    `layer` names the layer that they are in, whatever their roles say (`page.py`).
    """

    shapes: tuple[Shape, ...]
    role: str
    name: str = ""
    title: str = ""
    layer: str = ""


Shape: TypeAlias = Line | Polyline | Circle | Arc | Head | Text | Vector | Arrow | Group


def sides_of(shape: Line | Polyline | Arc) -> Iterator[tuple[complex, complex]]:
    """Go through the straight pieces of a line; an arc is taken for chords, a tenth of a mm beside it."""
    match shape:
        case Line(a=a, b=b):
            yield a, b
        case Polyline(points=points, closed=closed):
            yield from pairwise((*points, points[0]) if closed else points)
        case Arc(centre=centre, radius=radius, start=start, sweep=sweep):
            count = max(8, ceil(abs(sweep) * (radius / (8.0 * BESIDE)) ** 0.5))
            yield from pairwise(centre + rect(radius, start + sweep * k / count) for k in range(count + 1))


def changed(shape: Shape, change: Callable[[Any], Shape]) -> Shape:
    """Return `shape` with a change of all that is no group."""
    if isinstance(shape, Group):
        return replace(shape, shapes=tuple(changed(part, change) for part in shape.shapes))
    return change(shape)


def shifted(shape: Shape, by: complex) -> Shape:
    """Return `shape` moved by the vector `by` (mm)."""
    match shape:  # the most numerous ones without the detour of `replace`
        case Line(a=a, b=b):
            return Line(a + by, b + by, shape.pen, shape.role, shape.name, shape.colour)
        case Text(at=at, markup=markup, height=height, anchor=anchor, angle=angle, squeeze=squeeze):
            of = tuple([point + by for point in shape.of])
            return Text(at + by, markup, height, anchor, angle, shape.role, shape.name, shape.colour, squeeze, of)
        case Group(shapes=shapes, role=role, name=name, title=title, layer=layer):
            return Group(tuple([shifted(part, by) for part in shapes]), role, name, title, layer)
        case Head(tip=tip, direction=direction, colour=colour):
            return Head(tip + by, direction, colour)
        case Polyline(points=points, pen=pen, closed=closed, fill=fill):
            moved = tuple([point + by for point in points])
            return Polyline(moved, pen, closed, fill, shape.role, shape.name, shape.colour)
        case Circle(centre=centre) | Arc(centre=centre):
            return replace(shape, centre=centre + by)
        case Vector(tail=tail, tip=tip) | Arrow(tail=tail, tip=tip):
            return replace(shape, tail=tail + by, tip=tip + by)
        case _:
            assert_never(shape)
