"""Dimensions of lengths: extension lines, a dimension line beside what is measured, its text."""

from __future__ import annotations

from math import pi

from .pens import ZERO
from .shapes import Line, Pen, Text
from .symbols import dimension
from .text import lay_out
from .view import Canvas

ABOVE = 0.5  # heights of letters between an upright dimension line and the lowest part of its text
PAST = 2.0  # mm by which an extension line runs past the dimension line


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
