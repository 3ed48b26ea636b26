"""The smallest sizes of cams whose follower moves along a line: with a roller, and with a flat plate.

A roller's line has the offset e from the cam's centre, positive to the right; r_0 is the pitch curve's least radius,
s_0 = sqrt(r_0^2 - e^2). Cam and follower have their instant centre at sense * s' beside the centre, so the pressure
angle is tan(theta) = (sense s' - e) / (s_0 + s). A limit of it is linear in (e, s_0): of the complex number
e + i s_0 every limit permits a half plane, all of them a wedge, and the smallest cam is its place nearest to the
origin, which is its apex or the foot of the perpendicular on one side.

Where the cam pushes, sense * theta is positive in the rise, negative in the fall; the transmission angle is the rest to
a right angle. On the S-ds/dphi diagram with the points (sense s', s) the cam's centre is (e, -s_0).

Sources: Artobolevsky, Theory of mechanisms and machines; Geronimus (flat follower).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

from ..laws import cross, dot
from .motion import FALL, RISE, Extreme, Motion

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
    found = [Nearest(plane.normal * plane.least, (plane,)) for plane in planes if plane.least > 0.0]
    for first, second in combinations(planes, 2):
        if (place := meeting(first, second)) is not None:
            found.append(Nearest(place, (first, second)))

    def is_inside(one: Nearest) -> bool:
        slack = ON * max(size, abs(one.place))
        return math.isfinite(slack) and all(plane.lack(one.place) <= slack for plane in planes if plane not in one.on)

    return min(filter(is_inside, found), key=lambda one: abs(one.place), default=None)


RIGHT_ANGLE = 0.5 * math.pi
BACK = "_back"  # ends the name of a limit on the side to which the cam does not push
PHASE_OF = {phase + end: phase for end in ("", BACK) for phase in (RISE, FALL)}  # of limits, by their names
ON_CIRCLE = 1e-12  # part of r_0 by which a place on the circle may be outside: rounding


@dataclass(frozen=True, slots=True)
class Limit:
    """A limit of the pressure angle in one phase; `way` is +1 where it is to the side of a rise, -1 of a fall."""

    name: str
    phase: str
    gamma: float
    way: int


@dataclass(frozen=True, slots=True)
class Limits:
    """The least transmission angles, rad: of the rise, of the fall, and whether on both sides of the normal."""

    gamma_rise: float
    gamma_fall: float
    two_sided: bool = False

    @property
    def each(self) -> list[Limit]:
        """The limits of the rise and the fall, then, if wanted, those to the other sides."""
        phases = ((RISE, self.gamma_rise, 1), (FALL, self.gamma_fall, -1))
        pushes = ((1, ""), (-1, BACK))[: 1 + self.two_sided]
        return [Limit(phase + end, phase, gamma, push * up) for push, end in pushes for phase, gamma, up in phases]


@dataclass(frozen=True, slots=True)
class RollerSizes:
    """Sizes of a cam with a roller follower; `on` names the limits that it just reaches: two at the wedge's apex."""

    r_0: float
    e: float
    s_0: float
    on: tuple[str, ...] = ()

    @classmethod
    def at(cls, place: complex, on: tuple[str, ...]) -> RollerSizes:
        """Return the sizes of the cam whose roller is at e + i s_0 in its lowest place."""
        return cls(abs(place), place.real, place.imag, on)


@dataclass(frozen=True, slots=True)
class RockerSizes:
    """Sizes of a cam with a rocker of length l, m; `on` names the limits that it just reaches."""

    r_0: float
    l_OC: float
    l: float
    e: float
    s_0: float
    on: tuple[str, ...] = ()
    r_0_most: float = math.inf  # the greatest r_0 that the limits permit at this l_OC


@dataclass(frozen=True, slots=True)
class Offsets:
    """The permitted offsets at a given r_0, from `least` to `most`, with the limits (or `r_0`) that end them."""

    least: float
    most: float
    at_least: str
    at_most: str


@dataclass(frozen=True, slots=True)
class NoOffset:
    """Why no offset is permitted at a given r_0: limits that exclude all, one alone or two together.

    `r_0_min` is the least r_0 at which all limits permit one.
    """

    limits: tuple[str, ...]
    r_0_min: float


@dataclass(frozen=True, slots=True)
class PlateSizes:
    """Sizes of a cam with a flat follower: r_0_min makes the profile just convex, at the angle phi of the cam."""

    r_0_min: float
    r_0: float
    R_plate: float
    phi: float


def wedge(motion: Motion, limits: Limits, sense: int = 1) -> tuple[HalfPlane, ...]:
    """Return the half planes of the e + i s_0 that each limit permits; `sense` is +1 of a counter-clockwise cam."""
    planes = []
    for limit in limits.each:
        sine, cosine, way = math.sin(limit.gamma), math.cos(limit.gamma), limit.way
        touch = motion.maximum(-cosine, way * sine, 0.0, (limit.phase,))
        planes.append(HalfPlane(limit.name, complex(way * sense * sine, cosine), touch.value, touch.phi))
    return tuple(planes)


def smallest_roller(planes: Sequence[HalfPlane]) -> RollerSizes:
    """Return the sizes with the least r_0 that the half planes of `wedge` permit."""
    found = nearest(planes)
    assert found is not None, "half planes that all open upwards have places in common"
    return RollerSizes.at(found.place, tuple(plane.name for plane in found.on))


def apex(planes: Sequence[HalfPlane]) -> RollerSizes:
    """Return the sizes of the cam whose centre is the apex, where the tangents meet: not always the smallest.

    With limits on both sides, the apex of the two that bind: the lowest place permitted.
    """
    corners = [
        (place, (first.name, second.name))
        for k, first in enumerate(planes)
        for second in planes[k + 1 :]
        if (place := meeting(first, second)) is not None and first.normal.real * second.normal.real < 0.0
    ]
    place, on = max(corners, key=lambda corner: corner[0].imag)
    return RollerSizes.at(place, on)


def central(planes: Sequence[HalfPlane], e: float = 0.0) -> RollerSizes:
    """Return the sizes with the least r_0 at a given offset, by default none."""
    needed = {plane.name: (plane.least - plane.normal.real * e) / plane.normal.imag for plane in planes}
    name = max(needed, key=lambda key: needed[key])
    if needed[name] <= 0.0:
        return RollerSizes(abs(e), e, 0.0)
    return RollerSizes.at(complex(e, needed[name]), (name,))


def offsets(planes: Sequence[HalfPlane], r_0: float) -> Offsets | NoOffset:
    """Return the offsets that are permitted at a given r_0, or why there is none.

    With e = r_0 sin(alpha), s_0 = r_0 cos(alpha) every limit permits one interval of alpha.
    """
    least, most, at_least, at_most = -RIGHT_ANGLE, RIGHT_ANGLE, "r_0", "r_0"
    for plane in planes:
        if plane.least > r_0 * (1.0 + ON_CIRCLE):
            return NoOffset((plane.name,), smallest_roller(planes).r_0)
        reach = math.acos(max(-1.0, min(1.0, plane.least / r_0)))
        middle = math.atan2(plane.normal.real, plane.normal.imag)
        if middle - reach > least:
            least, at_least = middle - reach, plane.name
        if middle + reach < most:
            most, at_most = middle + reach, plane.name
    if least > most:  # more than rounding?
        least = most = 0.5 * (least + most)
        place = complex(r_0 * math.sin(least), r_0 * math.cos(least))
        if any(plane.lack(place) > ON_CIRCLE * r_0 for plane in planes):
            both = tuple(plane.name for plane in planes if plane.name in (at_least, at_most))
            return NoOffset(both, smallest_roller(planes).r_0)
    return Offsets(r_0 * math.sin(least), r_0 * math.sin(most), at_least, at_most)


def smallest_plate(motion: Motion, rho_flat: float, margin: float) -> PlateSizes:
    """Return the sizes of a flat follower's cam with the least radius of curvature `rho_flat`.

    The radius of curvature is r_0 + s + s'', so that at r_0 = -(s + s'') the cam is just convex; the plate reaches
    `margin` beyond the contact, |s'| from the axis. A velocity that jumps down makes r_0 infinite.
    """
    touch = motion.maximum(-1.0, 0.0, -1.0)
    r_0_min, phi = (math.inf, motion.drops[0]) if motion.drops else (max(0.0, touch.value), touch.phi)
    return PlateSizes(r_0_min, r_0_min + rho_flat, motion.ds_max.value + margin, phi)


ROUNDS = 60  # of a search that doubles its figures in every round
SIDES = {RISE: (1, -1), FALL: (-1, 1)}  # of the velocity: first where the cam pushes, then the other


def least_transmission(
    motion: Motion, sizes: RollerSizes, phase: str, sense: int = 1, two_sided: bool = False
) -> Extreme:
    """Return the least transmission angle of the rise or the fall, rad, exactly, and where it is.

    One-sided, only pressure to the side to which the cam pushes counts, and the angle may exceed a right angle.
    """
    sides = SIDES[phase][: 1 + two_sided]
    steepest = max((_steepest(motion, sizes, phase, sense, way) for way in sides), key=lambda found: found.value)
    return Extreme(RIGHT_ANGLE - math.atan(steepest.value), steepest.phi)


def _steepest(motion: Motion, sizes: RollerSizes, phase: str, sense: int, way: int) -> Extreme:
    """Return the greatest way * sense * tan(theta) = way * (s' - sense e) / (s_0 + s).

    A quotient is greatest where its numerator less so many times its denominator is (Dinkelbach).
    """
    best, slope = Extreme(-math.inf, 0.0), 0.0
    for _ in range(ROUNDS):
        found = motion.maximum(-slope, way, 0.0, (phase,))
        s = float(motion.at(found.phi)[0])
        slope = (found.value + slope * s - way * sense * sizes.e) / (sizes.s_0 + s)
        if slope <= best.value:
            break
        best = Extreme(slope, found.phi)
    return best
