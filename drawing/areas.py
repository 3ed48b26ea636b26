"""Hatching of an area that a closed line bounds."""

from __future__ import annotations

from collections.abc import Sequence

from .shapes import Line, Pen

SHORTEST = 0.3  # mm: a shorter stroke would be a dot


def strokes(outline: Sequence[complex], along: complex, apart: float) -> list[Line]:
    """Return lines in the unit direction `along`, so far apart, over the area inside of a closed line.

    Where the line crosses itself every part counts that an odd number of its sides surrounds.
    """
    turned = [point * along.conjugate() for point in outline]  # the strokes level
    sides = list(zip(turned, turned[1:] + turned[:1], strict=True))
    low, high = min(p.imag for p in turned), max(p.imag for p in turned)
    first = int(low // apart) + 1  # strokes of areas side by side lie in one line
    found = []
    for level in (k * apart for k in range(first, int(high // apart) + 1)):
        cuts = sorted(
            a.real + (b.real - a.real) * (level - a.imag) / (b.imag - a.imag)
            for a, b in sides
            if (a.imag < level) != (b.imag < level)
        )
        ends = zip(cuts[::2], cuts[1::2], strict=True)
        found += [(complex(x, level) * along, complex(y, level) * along) for x, y in ends if y - x > SHORTEST]
    return [Line(a, b, Pen.THIN, role="hatch") for a, b in found]
