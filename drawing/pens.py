"""Pens by meaning: widths, dashes and arrowheads of each format, after GOST 2.303 and 2.307 or ISO 128."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from math import isfinite, pi, tan
from typing import Literal, TypeAlias

from .shapes import Pen

Norm: TypeAlias = Literal["gost", "iso"]

HEAD_HALF_WIDTH = tan(pi / 18)  # of an arrowhead of unit length with an opening of 20 degrees
ZERO = 1e-9  # mm; a shorter vector has no direction that a reader could see


@dataclass(frozen=True, slots=True)
class Pens:
    """Two widths, two patterns and one arrowhead for a whole sheet, all in mm."""

    main: float
    thin: float
    arrow: float
    dashed: tuple[float, ...]
    axis: tuple[float, ...]

    def width(self, pen: Pen) -> float:
        """Return the width of `pen`."""
        return self.main if pen is Pen.MAIN else self.thin

    def dashes(self, pen: Pen, length: float) -> tuple[float, ...]:
        """Return dashes and gaps for a line of `length`, stretched so that it starts and ends with a dash.

        An empty tuple means a solid line, which is also right for a line too short for two dashes.
        """
        extreme = (*self.axis, *self.axis[2:])  # the axis with two dots (GOST 2.303, line 9)
        pattern = {Pen.DASHED: self.dashed, Pen.AXIS: self.axis, Pen.EXTREME: extreme}.get(pen)
        if pattern is None:
            return ()
        period, dash = sum(pattern), pattern[0]
        repeats = round((length - dash) / period) if isfinite(length) else 0
        if repeats < 1:
            return ()
        factor = length / (repeats * period + dash)
        return tuple(factor * part for part in pattern)


_GOST = {
    "A1": Pens(0.8, 0.3, 4.0, (4.0, 1.5), (12.0, 1.5, 0.5, 1.5)),
    "A2": Pens(0.8, 0.3, 3.5, (4.0, 1.5), (12.0, 1.5, 0.5, 1.5)),
    "A3": Pens(0.6, 0.25, 3.0, (4.0, 1.5), (10.0, 1.3, 0.4, 1.3)),
    "A4": Pens(0.5, 0.2, 2.5, (4.0, 1.5), (8.0, 1.3, 0.4, 1.3)),
}


def _iso(main: float, arrow: float) -> Pens:
    """Lay the patterns of ISO 128 out in units of the narrow line."""
    d = main / 2
    return Pens(main, d, arrow, (12 * d, 3 * d), (24 * d, 3 * d, 0.5 * d, 3 * d))


_ISO = {"A1": _iso(0.7, 4.0), "A2": _iso(0.5, 3.5), "A3": _iso(0.5, 3.0), "A4": _iso(0.5, 2.5)}


@cache
def pens_for(width: float, height: float, norm: Norm = "gost") -> Pens:
    """Return the pens of a sheet of `width` x `height` mm."""
    side = max(width, height)
    name = "A1" if side >= 841 else "A2" if side >= 594 else "A3" if side >= 420 else "A4"
    return (_ISO if norm == "iso" else _GOST)[name]
