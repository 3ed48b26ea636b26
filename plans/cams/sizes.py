"""The smallest sizes of cams whose follower moves along a line: with a roller, and with a flat plate.

A roller's line has the offset e from the cam's centre, positive to the right; r_0 is the pitch curve's least radius,
s_0 = sqrt(r_0^2 - e^2). Cam and follower have their instant centre at sense * s' beside the centre, so the pressure
angle is tan(theta) = (sense s' - e) / (s_0 + s). A limit of it is linear in (e, s_0): of the complex number
e + i s_0 every limit permits a half plane, all of them a wedge, and the smallest cam is its place nearest to the
origin, which is its apex or the foot of the perpendicular on one side.

On the S-ds/dphi diagram with the points (sense s', s) the cam's centre is (e, -s_0).

Sources: Artobolevsky, Theory of mechanisms and machines; Geronimus (flat follower).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from .half_planes import HalfPlane, meeting, nearest
from .motion import FALL, RISE, Extreme, Motion

RIGHT_ANGLE = 0.5 * math.pi
BACK = "_back"  # ends the name of a limit on the side to which the cam does not push
ON_CIRCLE = 1e-12  # part of r_0 by which a place on the circle may be outside: rounding


@dataclass(frozen=True, slots=True)
class Limits:
    """The least transmission angles, rad: of the rise, of the fall, and whether on both sides of the normal."""

    gamma_rise: float
    gamma_fall: float
    two_sided: bool = False


@dataclass(frozen=True, slots=True)
class RollerSizes:
    """Sizes of a cam with a roller follower; `on` names the limits that it just reaches: two at the wedge's apex."""

    r_0: float
    e: float
    s_0: float
    on: tuple[str, ...] = ()


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
    """Return the half planes of the permitted e + i s_0: of the rise and the fall, then the other sides if limited.

    Parameters
    ----------
    motion : Motion
        Travel in m.
    limits : Limits
        Permitted transmission angles, between 0 and a right angle.
    sense : int
        +1 when the cam turns counter-clockwise, -1 when clockwise.
    """
    planes = []
    for end, push in (("", 1), (BACK, -1))[: 1 + limits.two_sided]:
        for phase, gamma, up in ((RISE, limits.gamma_rise, 1), (FALL, limits.gamma_fall, -1)):
            sine, cosine = math.sin(gamma), math.cos(gamma)
            touch = motion.maximum(-cosine, push * up * sine, 0.0, (phase,))
            normal = complex(push * up * sense * sine, cosine)
            planes.append(HalfPlane(phase + end, normal, touch.value, touch.phi))
    return tuple(planes)


def smallest_roller(planes: Sequence[HalfPlane]) -> RollerSizes:
    """Return the sizes with the least r_0 that the half planes of `wedge` permit."""
    found = nearest(planes)
    assert found is not None, "half planes that all open upwards have places in common"
    return _sizes(found.place, tuple(plane.name for plane in found.on))


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
    return _sizes(place, on)


def central(planes: Sequence[HalfPlane], e: float = 0.0) -> RollerSizes:
    """Return the sizes with the least r_0 at a given offset, by default none."""
    needed = {plane.name: (plane.least - plane.normal.real * e) / plane.normal.imag for plane in planes}
    name = max(needed, key=lambda key: needed[key])
    if needed[name] <= 0.0:
        return RollerSizes(abs(e), e, 0.0)
    return _sizes(complex(e, needed[name]), (name,))


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


def convexity(motion: Motion) -> Extreme:
    """Return the greatest -(s + s''): the r_0 at which a flat follower's cam is just convex, and where."""
    return motion.maximum(-1.0, 0.0, -1.0)


def smallest_plate(motion: Motion, rho_flat: float, margin: float) -> PlateSizes:
    """Return the sizes of a flat follower's cam with the least radius of curvature `rho_flat`.

    The radius of curvature is r_0 + s + s''; the plate reaches `margin` beyond the contact, |s'| from the axis.
    A velocity that jumps down makes r_0 infinite.
    """
    touch = convexity(motion)
    r_0_min, phi = (math.inf, motion.drops[0]) if motion.drops else (max(0.0, touch.value), touch.phi)
    return PlateSizes(r_0_min, r_0_min + rho_flat, motion.ds_max.value + margin, phi)


def _sizes(place: complex, on: tuple[str, ...]) -> RollerSizes:
    return RollerSizes(abs(place), place.real, place.imag, on)
