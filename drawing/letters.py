"""Our drafting letters: strokes on the grid of GOST 2.304, type B, as centre lines and as a TrueType font.

`letters.txt` has the strokes, for pens and plotters as they are; sheets embed a font that is made of their outlines by
`docs/lettering.py`, and kept beside this file as `letters-upright.ttf` and `letters-slanted.ttf`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import NamedTuple

GAP = 1.6  # between the widths of letters, h/10
WORD_GAP = 6.0  # h/10
SLANT = math.tan(math.radians(15.0))  # of slanted letters, 75 degrees to the line
DOT = 0.062  # radius of a dot, in heights of a capital
FINE = math.radians(7.5)  # steps of a rounded corner


class Glyph(NamedTuple):
    """A letter: its width and the points of its strokes, h/10."""

    width: float
    strokes: tuple[tuple[complex, ...], ...]


@cache
def glyphs() -> dict[str, Glyph]:
    """Return all letters with their strokes, rounded corners as short chords."""
    text = Path(__file__).with_name("letters.txt").read_text(encoding="utf-8")
    made = {" ": Glyph(WORD_GAP - GAP, ())}
    for line in text.splitlines():
        if not line or line.startswith("# "):
            continue
        head, *strokes = line.split(" | ")
        letters, width = head.rsplit(maxsplit=1)
        glyph = Glyph(float(width), tuple(_rounded(stroke.split()) for stroke in strokes))
        made.update(dict.fromkeys(letters, glyph))
    return made


def _rounded(words: list[str]) -> tuple[complex, ...]:
    """Return the points of a stroke, those of its rounded corners among them."""
    closed = words[-1] == "z"
    corners = [
        (complex(*map(float, word.split(",")[:2])), float(([*word.split(","), "0", "0"])[2]))
        for word in words[: len(words) - closed]
    ]
    points: list[complex] = []
    for index, (corner, radius) in enumerate(corners):
        if not radius:
            points.append(corner)
            continue
        before, after = corners[index - 1][0] - corner, corners[(index + 1) % len(corners)][0] - corner
        points += _arc(corner, before, after, radius)
    return tuple([*points, points[0]] if closed else points)


def _arc(corner: complex, before: complex, after: complex, radius: float) -> Iterator[complex]:
    """Go along the arc that rounds a corner off between the directions to its neighbours."""
    first, last = before / abs(before), after / abs(after)
    half = abs(math.remainder(math.atan2((last / first).imag, (last / first).real), math.tau)) / 2.0
    centre = corner + (first + last) / abs(first + last) * radius / math.sin(half)
    start = corner + first * radius / math.tan(half) - centre
    turn = math.pi - 2.0 * half
    if (last / first).imag > 0.0:
        turn = -turn
    steps = max(1, math.ceil(abs(turn) / FINE))
    for step in range(steps + 1):
        angle = turn * step / steps
        yield centre + start * complex(math.cos(angle), math.sin(angle))


def drawn(string: str, height: float, slanted: bool = False) -> Iterator[tuple[complex, ...]]:
    """Go through the strokes of a line of letters with capitals of `height` mm, from its start; a dot is one point.

    Raises KeyError: the alphabet lacks a character.
    """
    x, grid, lean = 0.0, height / 10.0, SLANT if slanted else 0.0
    for letter in string:
        glyph = glyphs()[letter]
        for stroke in glyph.strokes:
            yield tuple(complex(x + p.real + lean * p.imag, p.imag) * grid for p in stroke)
        x += glyph.width + GAP
