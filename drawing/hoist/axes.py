"""Axes of a hoist's diagrams: ticks with numbers in fixed places, so that no grid runs through curves and letters."""

from __future__ import annotations

from ..diagram import Field
from ..shapes import Head, Line, Pen, Text
from ..view import Canvas

TICK = 1.4  # mm
PAST = 6.0  # mm by which an axis runs past its end


def ruled(canvas: Canvas, field: Field) -> None:
    """Draw both axes; the numbers of the abscissas stand at the foot of the diagram."""
    x, y, h = field.x, field.y, canvas.style.text
    foot, top = field.at(0.0, y.low), field.at(0.0, y.high) + 1j * PAST
    left, right = field.at(x.low, 0.0), field.at(x.high, 0.0) + PAST
    for a, b in ((foot, top), (left, right)):
        canvas.add(Line(a, b, Pen.THIN, role="axis"), Head(b, b - a))
    canvas.add(Line(foot, field.at(x.high, y.low), Pen.THIN, role="scale"))
    canvas.label(y.letter, top, prefer=1.0 + 0.2j, clear=1.2)
    canvas.label(x.letter, right, prefer=1j, clear=1.2)
    for value, number in x.divisions.items():
        at = field.at(value, y.low)
        canvas.add(Line(at - 1j * TICK, at, Pen.THIN, role="division"))
        canvas.add(Text(at - 1j * (TICK + 0.6 + h), number, h, "middle", role="number"))
    for value, number in y.divisions.items():
        at = field.at(0.0, value)
        canvas.add(Line(at - TICK, at, Pen.THIN, role="division"))
        canvas.add(Text(at - complex(TICK + 0.8, 0.5 * h), number, h, "right", role="number"))
