"""Dimensions with their texts over or along their lines, and diagrams: two axes with divisions, curves over them."""

from __future__ import annotations

import math
from cmath import phase, rect
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

from ..scales.scale import Scale
from .formats import HEAD_HALF_WIDTH, ZERO
from .page import extent
from .shapes import Circle, Group, Head, Line, Pen, Polyline, Text
from .symbols import angle_dimension, dimension, swept, turning_arrow
from .text import lay_out
from .view import Canvas
from .words import Words

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
    if (level and _over_line(canvas, line, text, chained)) or (upright and _along(canvas, line, text)):
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


def _over_line(canvas: Canvas, ends: tuple[complex, complex], text: str, chained: bool = False) -> bool:
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


STEPS = (1, 2, 3, 5, 10)  # from one number of a section line to the next
AT_POLE = 3.0  # mm of an axis beyond the pole
BEYOND = 8.0  # mm by which an axis runs past its last division
FINEST = 9  # decimals of a division at most


@dataclass(frozen=True, slots=True)
class Axis:
    """An axis: its letter, its scale factor, its ends and the divisions with what stands beside them, in its unit."""

    letter: str
    scale: Scale
    low: float
    high: float
    divisions: Mapping[float, str]


@dataclass(frozen=True, slots=True)
class Field:
    """The area of a diagram: where x = 0 meets y = 0 on the view, and the two axes."""

    origin: complex
    x: Axis
    y: Axis

    def at(self, x: float, y: float) -> complex:
        """Return a place of the diagram on the view, mm."""
        return self.origin + complex(self.x.scale.drawn(x), self.y.scale.drawn(y))


def axes(canvas: Canvas, field: Field, lettered: bool = True, past: float = BEYOND) -> None:
    """Draw both axes with arrows, letters and divisions; a thin line through each division of x.

    `lettered` is false for the upper of several diagrams over one axis x: its divisions have their numbers below. The
    axes run `past` mm past their ends.
    """
    x, y = field.x, field.y
    left, right = field.at(x.low, 0.0), field.at(x.high, 0.0) + past
    foot, top = field.at(0.0, y.low), field.at(0.0, y.high) + 1j * past
    for a, b in ((left, right), (foot, top)):
        canvas.add(Line(a, b, Pen.THIN, role="axis"), Head(b, b - a))
    canvas.label(y.letter, top, prefer=1.0 - 0.3j, clear=1.2)
    if x.letter:
        canvas.label(x.letter, right, prefer=1j, clear=1.2)
    tick = 0.4 * canvas.style.text
    for value, number in x.divisions.items():
        canvas.add(Line(field.at(value, y.low), field.at(value, y.high), Pen.THIN, role="section"))
        if lettered and number:
            canvas.small(number, field.at(value, y.low), -1j)
    for value, number in y.divisions.items():
        at = field.at(0.0, value)
        canvas.add(Line(at - tick, at + tick, Pen.THIN, role="division"))
        if number:
            canvas.small(number, at - tick, -1.0 + 0j)


def curve(
    canvas: Canvas,
    field: Field,
    places: Iterable[tuple[float, float]],
    name: str,
    pen: Pen = Pen.MAIN,
    role: str = "curve",
) -> None:
    """Draw a curve through `places` (x, y); it breaks where a value is not a number."""
    drawn_through(canvas, (field.at(x, y) for x, y in places), name, pen, role)


def drawn_through(
    canvas: Canvas, points: Iterable[complex], name: str, pen: Pen = Pen.MAIN, role: str = "curve"
) -> None:
    """Draw a curve through points on the view, mm; it breaks where one is not a number."""
    pieces: list[list[complex]] = [[]]
    for point in points:
        if math.isfinite(point.imag):
            pieces[-1].append(point)
        elif pieces[-1]:
            pieces.append([])
    lines = tuple(Polyline(tuple(piece), pen) for piece in pieces if len(piece) > 1)
    if lines:
        canvas.add(Group(lines, role, name))


@dataclass(frozen=True, slots=True)
class Pole:
    """The pole of a graphical integration or differentiation, `reach` mm to the left of the ordinates.

    `letter` stands beside it, `name` names its distance and `text` is the dimension.
    """

    reach: float
    letter: str
    name: str
    text: str


def small(text: float) -> float:
    """Return the height of the numbers of rays beside texts of a height, mm."""
    return max(2.5, 0.7 * text)


def rays(canvas: Canvas, field: Field, pole: Pole, ordinates: Iterable[tuple[int, float]]) -> None:
    """Draw the pole at its distance, and a ray to each ordinate, mm, with the numbers of its sections."""
    at, style = field.origin - pole.reach, canvas.style
    cuts: dict[float, list[str]] = {}
    for number, y in ordinates:
        cuts.setdefault(round(y, 4), []).append(str(number))
    for cut, numbers in sorted(cuts.items()):
        end = field.origin + 1j * cut
        canvas.add(Line(at, end, Pen.THIN, role="ray", name=" ".join(numbers)))
        canvas.label(", ".join(numbers), end, prefer=end - at, clear=0.8, height=small(style.text))
    canvas.add(Line(at - AT_POLE, field.origin, Pen.THIN, role="axis"))
    mark_pole(canvas, pole, at, field.at(0.0, field.y.low), 4.0)


def mark_pole(canvas: Canvas, pole: Pole, at: complex, foot: complex, below: float) -> None:
    """Mark a pole, and dimension its distance at least `below` mm under the lowest place of its line, its `foot`."""
    style = canvas.style
    level = foot.imag - max(below, 2.2 * style.text)
    canvas.add(Circle(at, style.node, Pen.MAIN, fill="white", role="pole"))
    canvas.small(pole.letter, at, -1.0 + 1j, 1.0)
    feet = complex(at.real, level), complex(foot.real, level)
    for start, end in zip((at, foot), feet, strict=True):
        canvas.add(Line(start, end - 1.5j, Pen.THIN, role="extension"))
    canvas.add(dimension(*feet, pole.name, style))
    if not _over_line(canvas, feet, pole.text):
        canvas.small(pole.text, feet, -1j)


def numbers(lines: Sequence[float], level: float, height: float, first: int = 0) -> list[Text]:
    """Return the numbers of section lines at a level, from the `first` on: every one, or every second, third ...

    Where two lines are nearer than all others, a number that would touch the one before is left out.
    """
    halves = [0.5 * lay_out(str(i), height).width for i in range(first, first + len(lines))]
    apart = 0.25 * height

    def clear(i: int, j: int) -> bool:
        return lines[j] - halves[j] > lines[i] + halves[i] + apart

    gaps = sorted(range(len(lines) - 1), key=lambda i: lines[i + 1] - lines[i])
    usual = gaps[len(gaps) // 2 :] if gaps else []  # half of the lines stand as far apart, or farther
    step = next((k for k in STEPS if all(clear(i, i + k) for i in usual if i + k < len(lines))), STEPS[-1])
    found: list[Text] = []
    last = -1
    for i in range(-first % step, len(lines), step):
        if last < 0 or clear(last, i):
            found.append(
                Text(complex(lines[i], level), str(i + first), height, "middle", role="number", name=str(i + first))
            )
            last = i
    return found


def numbered(words: Words, values: Iterable[float]) -> dict[float, str]:
    """Return the numbers of the divisions of an axis, all with as many decimals as one of them needs, zero without."""
    rounded = [round(value, FINEST) for value in values]
    decimals = max(len(f"{value:.{FINEST}f}".rstrip("0").partition(".")[2]) for value in rounded)
    return {value: words.number(value, decimals) if value else "0" for value in rounded}


def divisions(high: float, low: float, mu: float, apart: float = 12.0) -> Sequence[float]:
    """Return round values from `low` to `high`, at least `apart` mm from one another, zero left out."""
    least = apart * mu
    power = 10.0 ** math.floor(math.log10(least))
    step = next(m * power for m in (1.0, 2.0, 5.0, 10.0) if m * power >= least * (1 - 1e-9))
    first, last = math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9)
    return [k * step for k in range(first, last + 1) if k]
