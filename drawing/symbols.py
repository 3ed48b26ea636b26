"""Symbols of links and pairs (GOST 2.770), hatching, arms, dimensions, turning arrows; springs, rods, shafts."""

from __future__ import annotations

import cmath
import math
from cmath import rect
from collections.abc import Sequence
from dataclasses import dataclass

from .formats import Style
from .shapes import Arc, Circle, Group, Head, Line, Pen, Polyline, Shape

# radii of a revolute pair: what a filled corner reaches at most, and how far apart sides at a sharper angle must be
SHARPEST, PARTED = 2.6, 0.7
COILS = 5
NEAREST = 2.0  # arrowheads from the vertex of an angle within which no head stands on its arc
GUIDE = 0.75  # length of a guide in sliders
OF_CAM = 0.2  # largest radius of the shaft in least radii of the cam
OF_OFFSET, NEAR = 0.65, (0.6, 1.5)  # radius of the shaft in offsets where that of the circle is near, in shaft radii
SQUARE = 1.5, 2.0  # mm, the mark of a right angle: the least, and the usual one
SHAFT, KEY = 1.8, 0.45  # radius of the shaft in heights of letters; half width of its key in radii


def revolute(at: complex, name: str, style: Style) -> Group:
    """Return a revolute pair: a white circle on which the links stop."""
    return Group((Circle(at, style.pair, Pen.MAIN, fill="white"),), "pair", name)


def hatching(a: complex, b: complex, below: complex, style: Style) -> tuple[Shape, ...]:
    """Return strokes at 45 degrees along the line a-b, on the side of the unit vector `below`."""
    stroke, pitch = style.hatch
    e = (b - a) / abs(b - a)
    count = max(2, round(abs(b - a) / pitch))
    lean = (below - e) * (stroke / math.sqrt(2.0))
    feet = (a + e * (abs(b - a) * (k + 0.5) / count) for k in range(count))
    return tuple(Line(foot, foot + lean, Pen.THIN, role="hatch") for foot in feet)


def fixed_pivot(at: complex, name: str, style: Style, down: complex = -1j) -> Group:
    """Return a pivot on the frame: circle, triangle, base line, hatching on its far side, towards `down`."""
    width, height, base = style.pivot
    across = 1j * down  # to the right where the foot stands below
    foot = at + down * (height + style.pair)
    sides = (rect(style.pair, math.pi / 2 - 2.15), rect(style.pair, math.pi / 2 - 0.99))
    ends = (foot - across * (width / 2), foot + across * (width / 2))
    legs = tuple(Line(at + side * down, end, Pen.MAIN) for side, end in zip(sides, ends, strict=True))
    ground = (foot - across * (base / 2), foot + across * (base / 2))
    strokes = hatching(*ground, down, style)
    circle = Circle(at, style.pair, Pen.MAIN, fill="white")
    return Group((*legs, Line(*ground, Pen.MAIN), *strokes, circle), "pivot", name)


def rigid_corner(at: complex, u: complex, w: complex, style: Style, pin: bool) -> Polyline:
    """Return the filled corner between two sides of one link, along `u` and `w`; around the circle of a `pin`.

    Sides at a sharp angle run one on the other near their corner: between them only a strip is filled, where they have
    left each other, lest the whole corner look like a wedge.
    """
    sweep = cmath.phase(w / u)
    apart = math.sin(min(abs(sweep), math.pi / 2))
    inner = style.pair if pin else 0.0
    outer = max(inner + 0.65 * style.pair, 1.1 * style.pair / max(apart, 1e-3))
    if outer > SHARPEST * style.pair:
        inner = max(inner, min(PARTED * style.pair / (2.0 * math.tan(abs(sweep) / 2.0)), 8.0 * style.pair))
        outer = inner + 0.8 * style.pair
    near, far = (tuple(at + u * rect(radius, sweep * k / 12) for k in range(13)) for radius in (inner, outer))
    rim = far if pin else (at + u * outer, at + w * outer)
    foot = tuple(reversed(near)) if inner > 0.0 else (at,)
    return Polyline((*foot, *rim), Pen.THIN, closed=True, fill="black", role="rigid")


def block(at: complex, u: complex, name: str, size: tuple[float, float]) -> Group:
    """Return a block of this length and height, turned along the unit direction `u`."""
    length, height = size
    corners = tuple(
        at + u * (sx * length / 2) + 1j * u * (sy * height / 2) for sx, sy in ((-1, -1), (1, -1), (1, 1), (-1, 1))
    )
    return Group((Polyline(corners, Pen.MAIN, closed=True, fill="white"),), "link", name)


def slider_up(u: complex) -> complex:
    """Return the side of a slider along the unit vector `u` that is usually free of its guide."""
    return 1j * u if (1j * u).imag >= -1e-12 else -1j * u


def guide(pieces: tuple[tuple[complex, complex], ...], up: complex, name: str, style: Style) -> Group:
    """Return a guide of the frame: its lines, hatched on the side away from `up`."""
    strokes = (stroke for a, b in pieces for stroke in hatching(a, b, -up, style))
    return Group((*(Line(a, b, Pen.MAIN) for a, b in pieces), *strokes), "guide", name)


def right_angle(at: complex, u: complex, w: complex, size: float) -> Polyline:
    """Return the mark of a right angle at `at` between the unit directions `u` and `w`."""
    return Polyline((at + u * size, at + (u + w) * size, at + w * size), Pen.THIN, role="right-angle")


def arm(about: complex, foot: complex, name: str, along: complex, style: Style) -> Group:
    """Return an arm as a dimension: from the centre of moments to the foot on the line of the force.

    `along` is the unit direction of the force's line.
    """
    reach = abs(foot - about)
    parts: list[Shape] = [Line(about, foot, Pen.THIN)]
    if reach > 2.2 * style.arrow:
        e = (foot - about) / reach
        parts += [Head(foot, e), Head(about, -e)]
    if reach > SQUARE[0]:
        size = min(SQUARE[1], max(SQUARE[0], reach / 3))
        parts.append(right_angle(foot, (about - foot) / reach, along, size))
    return Group(tuple(parts), "arm", name)


def turning_arrow(centre: complex, radius: float, middle: float, spread: float, sense: float, name: str) -> Group:
    """Return an arc with an arrowhead that shows a sense of turning (+1 counter-clockwise) about `centre`."""
    start = middle - sense * spread / 2
    end = start + sense * spread
    tip = centre + rect(radius, end)
    # an arrowhead on a small circle points along the chord of its own length, not along the tangent at its tip
    lean = min(0.5, 1.5 / radius)
    direction = rect(1.0, end + sense * (math.pi / 2 - lean))
    return Group((Arc(centre, radius, start, sense * spread, Pen.THIN), Head(tip, direction)), "arrow", name)


HALF_TURN = math.pi


def unit(vector: complex) -> complex:
    """Return the unit vector in the direction of a vector."""
    return vector / abs(vector)


def nearer(ray: complex, to: complex) -> complex:
    """Return a direction or its opposite, that which makes an acute angle with another one."""
    return ray if (to * ray.conjugate()).real > 0.0 else -ray


def at_level(start: complex, along: complex, level: float) -> complex:
    """Return where a line through a point reaches a level."""
    return start + along * ((level - start.imag) / along.imag)


def polar(radius: float, angle: float) -> complex:
    """Return the vector of a length in a direction, rad from the abscissa."""
    return rect(radius, angle)


def swept(a: complex, b: complex, turn: int = 0) -> float:
    """Return the angle from one direction to another: counter-clockwise, 1, clockwise, -1, or the shorter way."""
    return turn * (cmath.phase(b / a) * turn % math.tau) if turn else cmath.phase(b / a)


def arc_between(
    centre: complex, a: complex, b: complex, pen: Pen, role: str = "", name: str = "", turn: int = 1
) -> Arc:
    """Return the arc about a centre from one point to the ray to another, counter-clockwise, or as `swept` turns."""
    start, end = a - centre, b - centre
    return Arc(centre, abs(start), cmath.phase(start), swept(start, end, turn), pen, role=role, name=name)


def angle_dimension(centre: complex, radius: float, start: float, sweep: float, name: str, style: Style) -> Group:
    """Return a dimensioned angle: an arc between two arrowheads, which stand outside where they have no room between.

    So close to the vertex that they would not stand on the arc there are none.
    """
    parts: list[Shape] = [Arc(centre, radius, start, sweep, Pen.THIN)]
    inside, sign, end = abs(sweep) * radius > 2.5 * style.arrow, math.copysign(1.0, sweep), start + sweep
    if inside or (radius > NEAREST * style.arrow and abs(sweep) * radius > style.node):
        lean = style.arrow / 2 / radius
        for at, turn in ((end, sign), (start, -sign)):  # outwards, or inwards on the arc drawn on
            turn = turn if inside else -turn
            parts.append(Head(centre + rect(radius, at), rect(turn, at + math.pi / 2 - turn * lean)))
            if not inside:
                parts.append(Arc(centre, radius, at, -turn * 4.0 * lean, Pen.THIN, role="tail"))
    return Group(tuple(parts), "dimension", name)


def clear_ray(direction: complex, lines: Sequence[complex]) -> complex:
    """Return the ray on which an arrow along `direction` lies at its point: along which it points or the other one.

    Lines of links, which leave the point in these directions, must not be covered.
    """
    outward, inward = (
        min((abs(cmath.phase(other / ray)) for other in lines), default=math.pi) for ray in (direction, -direction)
    )
    return direction if outward >= inward - 0.1 else -direction


def dimension(a: complex, b: complex, name: str, style: Style) -> Group:
    """Return a dimension line from `a` to `b`, its heads outside where they have no room between."""
    e, reach = (b - a) / abs(b - a), abs(b - a)
    if reach > 2.5 * style.arrow:
        return Group((Line(a, b, Pen.THIN), Head(a, -e), Head(b, e)), "dimension", name)
    out = 2.0 * style.arrow
    return Group((Line(a - e * out, b + e * out, Pen.THIN), Head(a, e), Head(b, -e)), "dimension", name)


@dataclass(frozen=True, slots=True)
class Rod:
    """A follower's rod along x = const: from `low` up; its guide begins at `guide`, and it is lifted by `stroke` mm."""

    x: float
    low: float
    collar: float
    stroke: float
    style: Style

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
        x, w = self.x, 0.5 * self.style.label  # half its width
        body = _box(x - w, self.low, x + w, self.top)
        collar = _box(x - 2.2 * w, self.collar - 0.5 * w, x + 2.2 * w, self.collar)
        (low, high), start = self.guide, complex(x, self.collar)
        step = 1j * ((low - self.collar) / (2 * COILS))
        bends = coils([start + step * k for k in range(2 * COILS + 1)], 1.9 * w)
        spring = Group((Polyline(tuple(bends), Pen.THIN),), "spring", "spring")
        shapes: list[Shape] = [Group((body, collar), "link", "rod"), spring]
        for side in (-1.0, 1.0):
            x = self.x + side * (w + 0.8)
            shapes.append(guide(((complex(x, low), complex(x, high)),), complex(-side, 0.0), "guide", self.style))
            shapes.append(Line(complex(x, low), complex(x + side * 2.4 * w, low), Pen.MAIN))
        return tuple(shapes)


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
    rim, top, low = math.sqrt(r * r - key * key), r + key, r - key  # of the key above the centre
    width, height, base = style.pivot
    foot = centre - 1j * (r + 0.6 * height)
    ground = foot - base / 2, foot + base / 2
    slot = tuple(centre + complex(x, y) for x, y in ((-key, rim), (-key, top), (key, top), (key, rim)))
    parts: list[Shape] = [
        Line(centre + r * complex(side * 0.5, -math.sqrt(0.75)), foot + side * width / 2) for side in (-1.0, 1.0)
    ]
    parts += [Line(*ground), *hatching(*ground, -1j, style), Circle(centre, r), Polyline(slot)]
    parts += [
        Line(centre + complex(x0, low), centre + complex(x1, y), Pen.THIN)
        for x0, x1, y in ((-key, key, low), (-key, -key, r), (key, key, r))
    ]
    return Group(tuple(parts), "shaft", "O")


def _box(x0: float, y0: float, x1: float, y1: float) -> Polyline:
    corners = (complex(x0, y0), complex(x1, y0), complex(x1, y1), complex(x0, y1))
    return Polyline(corners, Pen.MAIN, closed=True, fill="white")
