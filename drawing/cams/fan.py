"""The fan of rays of a graphical integration: pole, rays and their numbers, on a line of their own beside the axis."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

from ..diagram import Field, Pole
from ..shapes import Circle, Line, Pen, Text
from ..symbols import dimension
from ..text import Box, lay_out
from ..view import Canvas

APART = 1.2  # heights of letters between the numbers of rays under one another
AROUND = 0.5  # mm between a number and the broken lines beside it
RUN = 3  # how many numbers in a row are written with a dash
PAST = 3.0  # mm of an axis beyond the pole


@dataclass(frozen=True, slots=True)
class Number:
    """The numbers of rays that end in almost one place, at their mean height, mm above the zero of the ordinates."""

    text: str
    level: float


def numbers(ordinates: Iterable[tuple[int, float]], height: float) -> list[Number]:
    """Return the numbers of rays to these ordinates, mm, from below; those too near to one another stand together."""
    groups = sorted(([y], [i]) for i, y in ordinates)
    while True:
        means = [sum(ys) / len(ys) for ys, _ in groups]
        gaps = [b - a for a, b in pairwise(means)]
        if not gaps or min(gaps) >= APART * height:
            return [Number(_joined(found), mean) for (_, found), mean in zip(groups, means, strict=True)]
        k = gaps.index(min(gaps))
        groups[k : k + 2] = [(groups[k][0] + groups[k + 1][0], groups[k][1] + groups[k + 1][1])]


def _joined(found: Sequence[int]) -> str:
    """Return numbers as text: 2, 9-12, 25."""
    every, runs = sorted(found), list[list[int]]()
    for i in every:
        if runs and i == runs[-1][-1] + 1:
            runs[-1].append(i)
        else:
            runs.append([i])
    parts = (f"{run[0]}–{run[-1]}" if len(run) >= RUN else ", ".join(map(str, run)) for run in runs)
    return ", ".join(parts)


def shelved(found: Sequence[Number], height: float) -> Number | None:
    """Return the number of several rays that run almost along the axis: it stands beyond the pole, on their shelf."""
    near = [n for n in found if abs(n.level) < APART * height and not n.text.isdigit()]
    return min(near, key=lambda n: abs(n.level), default=None)


def small(text: float) -> float:
    """Return the height of the numbers of rays beside texts of a height, mm."""
    return max(2.5, 0.7 * text)


def aside(ordinates: Sequence[Sequence[tuple[int, float]]], text: float) -> float:
    """Return how far to the left of the ordinates the rays of several diagrams end: there is room for all numbers."""
    height = small(text)
    every = (numbers(found, height) for found in ordinates)
    wide = (lay_out(n.text, height).width for found in every for n in found if n is not shelved(found, height))
    return max(wide, default=0.0) + 4.0 * AROUND + 1.0


def fan(canvas: Canvas, field: Field, pole: Pole, means: Sequence[tuple[int, complex]], away: float) -> None:
    """Draw projections of mean ordinates to a line `away` mm to the left, and rays from the pole to their feet.

    Parameters
    ----------
    means : sequence of (number of the section, place of its mean ordinate)
        Those of one height have one ray.
    away : float
        What `aside` has returned.

    The pole, and the line from which its distance counts, are there with the axes, before any ray.
    """
    style, zero = canvas.style, field.origin - away
    height = small(style.text)
    at = zero - pole.reach
    ordinates = [(i, (mean - field.origin).imag) for i, mean in means]
    found = numbers(ordinates, height)
    beyond = shelved(found, height)
    boxes = list(_written(canvas, [n for n in found if n is not beyond], field.origin - 0.5 * away, height))
    cuts: dict[float, list[tuple[int, complex]]] = {}
    for i, mean in means:
        cuts.setdefault(round(mean.imag, 4), []).append((i, mean))
    feet = [complex(zero.real, cut) for cut in sorted(cuts)]
    for foot, (_, equal) in zip(feet, sorted(cuts.items()), strict=True):
        canvas.add(Line(at, foot, Pen.THIN, role="ray", name=" ".join(str(i) for i, _ in equal)))
        nearest = min((mean for _, mean in equal), key=lambda mean: mean.real)
        canvas.add(*_broken(nearest, foot, boxes, Pen.DASHED, "projection"))
    rays = canvas.part("axes")
    if len(feet) > 1:
        canvas.add(Line(min(feet[0], zero, key=_height), max(feet[-1], zero, key=_height), Pen.THIN, role="feet"))
    wide = lay_out(beyond.text, height).width + AROUND if beyond else 0.0
    canvas.add(*_broken(field.origin, at - max(PAST, wide), boxes, Pen.THIN, "axis"))
    if beyond:
        canvas.part(rays)
        canvas.add(Text(at - wide - 1j * (height + 2.0 * AROUND), beyond.text, height, role="number"))
        canvas.part("axes")
    canvas.add(Circle(at, style.node, Pen.MAIN, fill="white", role="pole"))
    canvas.label(pole.letter, at, prefer=-1.0 + 1j, clear=1.0, height=style.text)
    _distance(canvas, pole, (at, min(feet[0], zero, key=_height)))


def _height(place: complex) -> float:
    return place.imag


def _written(canvas: Canvas, found: Sequence[Number], middle: complex, height: float) -> Iterator[Box]:
    """Write numbers in the middle of the strip, go through the boxes that they fill."""
    for number in found:
        at = middle + 1j * (number.level - 0.5 * height)
        half = 0.5 * lay_out(number.text, height).width + AROUND
        canvas.add(Text(at, number.text, height, "middle", role="number"))
        yield at.real - half, at.imag - AROUND, at.real + half, at.imag + height + AROUND


def _broken(a: complex, b: complex, boxes: Sequence[Box], pen: Pen, role: str) -> Iterator[Line]:
    """Go through the pieces of a level line from the right to the left that lie beside the boxes."""
    gaps = sorted(
        ((x1, x0) for x0, y0, x1, y1 in boxes if y0 < a.imag < y1 and b.real < x1 and x0 < a.real), reverse=True
    )
    ends = [a.real, *(x for gap in gaps for x in gap), b.real]
    for start, end in zip(ends[::2], ends[1::2], strict=True):
        yield Line(complex(start, a.imag), complex(end, a.imag), pen, role=role)


def _distance(canvas: Canvas, pole: Pole, ends: tuple[complex, complex]) -> None:
    """Dimension the distance of the pole below the lowest ray."""
    at, foot = ends
    level = foot.imag - 5.0
    feet = complex(at.real, level), complex(foot.real, level)
    for start, below in zip(ends, feet, strict=True):
        canvas.add(Line(start, below - 1.5j, Pen.THIN, role="extension"))
    canvas.add(dimension(*feet, pole.name, canvas.style))
    canvas.label(pole.text, feet, prefer=-1j, clear=0.8, height=canvas.style.text)
