"""Half planes, and the place nearest to the origin that lies in all of them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

from ..laws import cross, dot

PARALLEL = 1e-13  # sine of the angle between lines below which they do not meet
ON = 1e-12  # part of the largest distance by which a place may be outside: rounding


@dataclass(frozen=True, slots=True)
class HalfPlane:
    """All places whose component along `normal`, a unit vector, is at least `least`.

    `name` tells where it comes from, `phi` the angle of the cam at which its line touches the curve that it bounds.
    """

    name: str
    normal: complex
    least: float
    phi: float = 0.0

    def lack(self, place: complex) -> float:
        """Return by how far a place is outside, negative inside."""
        return self.least - float(dot(self.normal, place))

    @property
    def foot(self) -> complex:
        """The foot of the perpendicular from the origin on its line."""
        return self.normal * self.least


@dataclass(frozen=True, slots=True)
class Nearest:
    """The place nearest to the origin, and the half planes, one or two, on whose lines it lies."""

    place: complex
    on: tuple[HalfPlane, ...]


def meeting(first: HalfPlane, second: HalfPlane) -> complex | None:
    """Return where two lines meet, None when they are parallel."""
    sine = cross(first.normal, second.normal)
    if abs(sine) < PARALLEL:
        return None
    return (second.normal * first.least - first.normal * second.least) * complex(0.0, -1.0 / sine)


def nearest(planes: Sequence[HalfPlane]) -> Nearest | None:
    """Return the place nearest to the origin in all half planes, None when they have none in common.

    It is the origin, a foot of the perpendicular on one line, or where two lines meet: the region is convex.
    """
    if all(plane.least <= 0.0 for plane in planes):
        return Nearest(0j, ())
    size = max(abs(plane.least) for plane in planes)
    found = [Nearest(plane.foot, (plane,)) for plane in planes if plane.least > 0.0]
    for first, second in combinations(planes, 2):
        if (place := meeting(first, second)) is not None:
            found.append(Nearest(place, (first, second)))
    inside = [one for one in found if _inside(one, planes, size)]
    return min(inside, key=lambda one: abs(one.place), default=None)


def _inside(one: Nearest, planes: Sequence[HalfPlane], size: float) -> bool:
    slack = ON * max(size, abs(one.place))
    return math.isfinite(slack) and all(plane.lack(one.place) <= slack for plane in planes if plane not in one.on)
