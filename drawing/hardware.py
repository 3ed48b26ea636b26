"""Parts of machines: springs, the guided rod of a follower that moves up along a line, a cam's shaft on its support."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from .formats import Style
from .shapes import Circle, Group, Line, Pen, Polyline, Shape
from .symbols import guide, hatching, unit

COILS = 5
GUIDE = 0.75  # length of a guide in sliders
OF_CAM = 0.2  # largest radius of the shaft in least radii of the cam
OF_OFFSET, NEAR = 0.65, (0.6, 1.5)  # radius of the shaft in offsets where that of the circle is near, in shaft radii
SHAFT, KEY = 1.8, 0.45  # radius of the shaft in heights of letters; half width of its key in radii


@dataclass(frozen=True, slots=True)
class Rod:
    """A follower's rod along x = const: from `low` up; its guide begins at `guide`, and it is lifted by `stroke` mm."""

    x: float
    low: float
    collar: float
    stroke: float
    style: Style

    @property
    def half(self) -> float:
        """Half the width of the rod."""
        return 0.5 * self.style.label

    @property
    def guide(self) -> tuple[float, float]:
        """Where the guide begins and ends: with room for the spring pressed together by the stroke."""
        low = self.collar + self.stroke + 2.0 * self.style.label
        return low, low + GUIDE * self.style.slider[0]

    @property
    def top(self) -> float:
        """The end of the rod."""
        return self.guide[1] + 3.0

    def shapes(self) -> tuple[Shape, ...]:
        """Return the rod with its collar, the spring on it, and the guide of the frame."""
        x, w = self.x, self.half
        body = _box(x - w, self.low, x + w, self.top)
        collar = _box(x - 2.2 * w, self.collar - 0.5 * w, x + 2.2 * w, self.collar)
        link = Group((body, collar), "link", "rod")
        return link, self._spring(), *self._guides()

    def _spring(self) -> Group:
        low, step = complex(self.x, self.collar), 1j * ((self.guide[0] - self.collar) / (2 * COILS))
        points = coils([low + step * k for k in range(2 * COILS + 1)], 1.9 * self.half)
        return Group((Polyline(tuple(points), Pen.THIN),), "spring", "spring")

    def _guides(self) -> tuple[Shape, ...]:
        low, high = self.guide
        found: list[Shape] = []
        for side in (-1.0, 1.0):
            x = self.x + side * (self.half + 0.8)
            foot = complex(x, low), complex(x + side * 2.4 * self.half, low)
            found.append(guide(((complex(x, low), complex(x, high)),), complex(-side, 0.0), "guide", self.style))
            found.append(Line(*foot, Pen.MAIN))
        return tuple(found)


def coils(places: Sequence[complex], half: float) -> list[complex]:
    """Return the bends of a spring, `half` beside places on its axis in turn on both sides, the first on the right."""
    across = -1j * half * unit(places[-1] - places[0])
    return [place - across if k % 2 else place + across for k, place in enumerate(places)]


def shaft_radius(cam: float, style: Style, offset: float = 0.0) -> float:
    """Return the radius of the shaft of a cam whose least radius is `cam`, mm; clear of the circle of the offset."""
    radius = min(SHAFT * style.label, OF_CAM * cam)
    return OF_OFFSET * offset if NEAR[0] * radius < offset < NEAR[1] * radius else radius


def shaft(centre: complex, r: float, style: Style) -> Group:
    """Return the shaft of the cam with its key, on a support of the frame below it."""
    key = KEY * r
    width, height, base = style.pivot
    foot = centre - 1j * (r + 0.6 * height)
    legs = (
        Line(centre + r * complex(side * 0.5, -math.sqrt(0.75)), foot + side * width / 2, Pen.MAIN)
        for side in (-1.0, 1.0)
    )
    ground = foot - base / 2, foot + base / 2
    slot = (
        centre + complex(-key, math.sqrt(r * r - key * key)),
        centre + complex(-key, r + key),
        centre + complex(key, r + key),
        centre + complex(key, math.sqrt(r * r - key * key)),
    )
    bottom = Line(centre + complex(-key, r - key), centre + complex(key, r - key), Pen.THIN)
    sides = (Line(centre + complex(s * key, r - key), centre + complex(s * key, r), Pen.THIN) for s in (-1.0, 1.0))
    return Group(
        (
            *legs,
            Line(*ground, Pen.MAIN),
            *hatching(*ground, -1j, style),
            Circle(centre, r, Pen.MAIN),
            Polyline(slot, Pen.MAIN),
            bottom,
            *sides,
        ),
        "shaft",
        "O",
    )


def _box(x0: float, y0: float, x1: float, y1: float) -> Polyline:
    corners = (complex(x0, y0), complex(x1, y0), complex(x1, y1), complex(x0, y1))
    return Polyline(corners, Pen.MAIN, closed=True, fill="white")
