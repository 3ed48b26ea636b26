"""Dimensions of lengths: extension lines, a dimension line beside what is measured, its text."""

from __future__ import annotations

from cmath import phase, rect
from math import pi

from .pens import ZERO
from .shapes import Line, Pen, Text
from .symbols import angle_dimension, dimension, swept, turning_arrow
from .text import lay_out
from .view import Canvas

ABOVE = 0.5  # heights of letters between an upright dimension line and the lowest part of its text
PAST = 2.0  # mm by which an extension line runs past the dimension line


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
