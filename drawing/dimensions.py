"""Dimensions on a canvas: angles, senses of turning, distances with their texts over or along their lines."""

from __future__ import annotations

from cmath import phase, rect
from dataclasses import replace

from .formats import HEAD_HALF_WIDTH, ZERO
from .page import extent
from .shapes import Line, Pen
from .symbols import angle_dimension, dimension, swept, turning_arrow
from .text import lay_out
from .view import Canvas

SHARES = (0.5, 0.4, 0.6, 0.3, 0.7)  # of a dimension line at which its text may stand
SPARE = 2.0  # mm by which a dimension line is longer than its text
SHELF, CLEAR = 2.0, 0.9  # mm from a dimension to a text beside it on the same line, and from the line to the text
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
    last: str = "",
) -> None:
    """Dimension the angle from one ray to another with its text at the middle of the arc.

    `turn` says whether it runs counter-clockwise, 1, or clockwise, -1; without it the shorter way. The text stands
    beyond the arc, or `inside` of it, or to the side that it should `prefer`; `spare` and `last` are as of a label.
    """
    start, sweep = phase(rays[0]), swept(*rays, turn)
    canvas.add(angle_dimension(vertex, radius, start, sweep, name, canvas.style))
    if text:
        out = rect(1.0, start + 0.5 * sweep)
        at = vertex + radius * out
        toward = prefer or (-out if inside else out)
        canvas.label(text, at, prefer=toward, clear=clear, height=canvas.style.text, spare=spare, last=last)


def turning(
    canvas: Canvas, centre: complex, radius: float, middle: float, spread: float, sense: float, name: str, text: str
) -> None:
    """Draw an arrow about a centre that shows in which sense something turns, its letter beyond its middle.

    The arrow reaches to both sides of the direction `middle` by half of `spread`, rad.
    """
    at = centre + rect(radius, middle)
    canvas.add(turning_arrow(centre, radius, middle, spread, sense, name))
    canvas.label(text, at, prefer=at - centre, clear=1.0)


def linear(
    canvas: Canvas,
    ends: tuple[complex, complex],
    out: complex,
    text: str,
    name: str,
    *,
    bodies: tuple[float, float] = (0.0, 0.0),
    chained: bool = False,
) -> None:
    """Dimension the distance between two points on a line parallel to it, moved by the vector `out`.

    Points in one place have no dimension; one that says the same as another may have no text. Extension lines begin
    beyond the `bodies` that stand at the points, which reach so many mm. Of `chained` dimensions others stand beside it
    on the same line.
    """
    a, b = ends
    if abs(b - a) < ZERO:
        return
    if abs(out) > PAST:
        e = out / abs(out)
        lines = (Line(end + e * gap, end + out + e * PAST, Pen.THIN) for end, gap in zip(ends, bodies, strict=True))
        canvas.add(*(replace(line, role="extension") for line in lines))
    canvas.add(dimension(a + out, b + out, name, canvas.style))
    if not text:
        return
    line, level, upright = (a + out, b + out), abs((b - a).imag) < ZERO, abs((b - a).real) < ZERO
    if (level and over_line(canvas, line, text, chained)) or (upright and _along(canvas, line, text)):
        return
    canvas.label(text, line, prefer=1j if level else out, clear=0.8, height=canvas.style.text)


def _along(canvas: Canvas, ends: tuple[complex, complex], text: str) -> bool:
    """Write the text of an upright dimension along its line, on its left; tell whether it has room there."""
    (a, b), layout = ends, lay_out(text, canvas.style.text)
    spare = abs(b - a) - 2.0 * canvas.style.arrow - layout.width  # between the arrowheads
    aside = CLEAR + 0.5 * (layout.top - layout.bottom)
    shares = [share for share in SHARES if abs(share - 0.5) * abs(b - a) <= 0.5 * spare]
    return canvas.write(text, [a + share * (b - a) - aside for share in shares], canvas.style.text, upright=True)


def above(text: str, height: float) -> float:
    """Return how far above a line a text has its baseline, so that it stands clear of the line, mm."""
    return CLEAR - lay_out(text, height).bottom


def over_line(canvas: Canvas, ends: tuple[complex, complex], text: str, chained: bool = False) -> bool:
    """Write the text of a level dimension over its line; tell whether it has room there.

    Else it stands over the line drawn on, if none is there, on the side on which the figure ends sooner.
    """
    layout, arrow = lay_out(text, canvas.style.text), canvas.style.arrow
    left, right = sorted(ends, key=lambda end: end.real)
    reach, up = abs(right - left), 1j * (CLEAR + 0.5 * (layout.top - layout.bottom))
    over_heads = 1j * arrow * HEAD_HALF_WIDTH
    if reach > layout.width + SPARE:
        spare = 0.5 * (reach - layout.width - SPARE) / reach
        shares = [share for share in SHARES if abs(share - 0.5) <= spare]
        places = [left + share * reach + up + more for more in (0j, over_heads) for share in shares]
        if canvas.write(text, places, canvas.style.text):
            return True
    if chained:
        return False
    beyond = 2.0 * arrow if reach <= 2.5 * arrow else 0.0  # the heads stand there
    x0, _, x1, _ = extent(canvas.shapes)
    sides = [(left, -1.0), (right, 1.0)] if left.real - x0 <= x1 - right.real else [(right, 1.0), (left, -1.0)]
    for end, side in sides:
        far = end + side * (beyond + layout.width + SHELF)
        if canvas.write(text, [far - side * 0.5 * layout.width + up], canvas.style.text):
            canvas.add(Line(end, far, Pen.THIN, role="shelf"))
            return True
    return False
