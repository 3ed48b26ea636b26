"""The smallest sizes of cams: for a roller on a line, for a rocker with a roller, and for a flat plate.

A roller's line has the offset e from the cam's centre, positive to the right; r_0 is the pitch curve's least radius,
s_0 = sqrt(r_0^2 - e^2). Cam and follower have their instant centre at sense * s' beside the centre, so the pressure
angle is tan(theta) = (sense s' - e) / (s_0 + s). A limit of it is linear in (e, s_0): of the complex number
e + i s_0 every limit permits a half plane, all of them a wedge, and the smallest cam is its place nearest to the
origin, which is its apex or the foot of the perpendicular on one side.

Where the cam pushes, sense * theta is positive in the rise, negative in the fall; the transmission angle is the rest to
a right angle. On the S-ds/dphi diagram with the points (sense s', s) the cam's centre is (e, -s_0).

Of a rocker every position permits a half plane of e + i s_0, and the smallest cam is the place nearest to the origin in
all of them. With the distance l_OC of the pivot from the cam's centre given, one number is left: the angle beta at the
pivot between the rocker in its lowest position and the cam's centre, of which every position permits an interval.

Sources: Artobolevsky, Theory of mechanisms and machines (also of cams with an oscillating follower); Geronimus (flat
follower).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from decimal import ROUND_CEILING, ROUND_FLOOR, Context, Decimal
from itertools import combinations
from typing import Any

import numpy as np

from ...scales.errors import InputError
from ..laws import cross, dot
from . import followers
from .cam import Cam
from .motion import Array, Extreme, Function, Motion, least, minima, motion_of

PARALLEL = 1e-13  # sine of the angle between lines below which they do not meet
ON = 1e-12  # part of the largest distance by which a place may be outside: rounding
ON_CIRCLE = 1e-12  # part of r_0 by which a place on the circle may be outside: rounding
ROUNDS = 40
REACHED = 1e-12  # part of the rocker's length by which a position may be outside its limit
LOWEST, HIGHEST = "lowest", "highest"  # the cam stays below the rocker
MILLI = 1e3
ROUNDING = 1e-12  # part of a length by which it may be less than another, and the same
Values = Mapping[str, float]
Names = tuple[str, ...]  # of limits, one alone or several together, that permit no place of the cam's centre


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


Corner = tuple[complex, tuple[HalfPlane, ...]]  # a place, and on the lines of which half planes it lies


def _meeting(first: HalfPlane, second: HalfPlane) -> complex | None:
    """Return where two lines meet, None when they are parallel."""
    sine = cross(first.normal, second.normal)
    if abs(sine) < PARALLEL:
        return None
    return (second.normal * first.least - first.normal * second.least) * complex(0.0, -1.0 / sine)


def _nearest(planes: Sequence[HalfPlane]) -> followers.Sizes | None:
    """Return the sizes with the least r_0 in all half planes, None when they have no place in common.

    The place is the origin, a foot of the perpendicular on one line, or where two lines meet: the region is convex.
    """
    if all(plane.least <= 0.0 for plane in planes):
        return followers.Sizes(0.0, 0.0, 0.0)
    size = max(abs(plane.least) for plane in planes)
    feet = (plane for plane in planes if plane.least > 0.0)
    corners: list[Corner] = [(plane.normal * plane.least, (plane,)) for plane in feet]
    corners += [(place, pair) for pair in combinations(planes, 2) if (place := _meeting(*pair)) is not None]

    def is_inside(corner: Corner) -> bool:
        place, on = corner
        slack = ON * max(size, abs(place))
        return math.isfinite(slack) and all(plane.lack(place) <= slack for plane in planes if plane not in on)

    nearest = min(filter(is_inside, corners), key=lambda corner: abs(corner[0]), default=None)
    return None if nearest is None else _sizes_at(nearest)


def _sizes_at(corner: Corner) -> followers.Sizes:
    """Return the sizes of the cam whose roller is at e + i s_0 in its lowest place."""
    place, on = corner
    return followers.Sizes(abs(place), place.real, place.imag, tuple(plane.name for plane in on))


def wedge(motion: Motion, limits: followers.Limits, sense: int = 1) -> tuple[HalfPlane, ...]:
    """Return the half planes of the e + i s_0 that each limit permits; `sense` is +1 of a counter-clockwise cam."""
    planes = []
    for limit in limits.each:
        sine, cosine, way = math.sin(limit.gamma), math.cos(limit.gamma), limit.way
        touch = motion.maximum(-cosine, way * sine, 0.0, (limit.phase,))
        planes.append(HalfPlane(limit.name, complex(way * sense * sine, cosine), touch.value, touch.phi))
    return tuple(planes)


def _smallest_roller(planes: Sequence[HalfPlane]) -> followers.Sizes:
    """Return the sizes with the least r_0 that the half planes of `wedge` permit."""
    sizes = _nearest(planes)
    assert sizes is not None, "half planes that all open upwards have places in common"
    return sizes


def apex(planes: Sequence[HalfPlane]) -> followers.Sizes:
    """Return the sizes of the cam whose centre is the apex, where the tangents meet: not always the smallest.

    With limits on both sides, the apex of the two that bind: the lowest place permitted.
    """
    opposed = (pair for pair in combinations(planes, 2) if pair[0].normal.real * pair[1].normal.real < 0.0)
    corners: list[Corner] = [(place, pair) for pair in opposed if (place := _meeting(*pair)) is not None]
    return _sizes_at(max(corners, key=lambda corner: corner[0].imag))


def central(planes: Sequence[HalfPlane], e: float) -> followers.Sizes:
    """Return the sizes with the least r_0 at a given offset."""
    needed = (((plane.least - plane.normal.real * e) / plane.normal.imag, plane) for plane in planes)
    s_0, plane = max(needed, key=lambda at: at[0])
    return _sizes_at((complex(e, s_0), (plane,))) if s_0 > 0.0 else followers.Sizes(abs(e), e, 0.0)


def offsets(planes: Sequence[HalfPlane], r_0: float) -> followers.Range | None:
    """Return the least and the greatest offset that are permitted at a given r_0, None where none is.

    With e = r_0 sin(alpha), s_0 = r_0 cos(alpha) every limit permits one interval of alpha.
    """
    lowest, highest = -followers.RIGHT_ANGLE, followers.RIGHT_ANGLE
    for plane in planes:
        if plane.least > r_0 * (1.0 + ON_CIRCLE):
            return None
        reach = math.acos(max(-1.0, min(1.0, plane.least / r_0)))
        middle = math.atan2(plane.normal.real, plane.normal.imag)
        lowest, highest = max(lowest, middle - reach), min(highest, middle + reach)
    if lowest > highest:  # more than rounding?
        lowest = highest = 0.5 * (lowest + highest)
        place = complex(r_0 * math.sin(lowest), r_0 * math.cos(lowest))
        if any(plane.lack(place) > ON_CIRCLE * r_0 for plane in planes):
            return None
    return r_0 * math.sin(lowest), r_0 * math.sin(highest)


def _smallest_plate(motion: Motion, rho_flat: float, margin: float) -> followers.PlateSizes:
    """Return the sizes of a flat follower's cam with the least radius of curvature `rho_flat`.

    The radius of curvature is r_0 + s + s'', so that at r_0 = -(s + s'') the cam is just convex; the plate reaches
    `margin` beyond the contact, |s'| from the axis. A velocity that jumps down makes r_0 infinite.
    """
    touch = motion.maximum(-1.0, 0.0, -1.0)
    r_0_min, phi = (math.inf, motion.drops[0]) if motion.drops else (max(0.0, touch.value), touch.phi)
    return followers.PlateSizes(r_0_min, r_0_min + rho_flat, motion.ds_max.value + margin, phi)


def _smallest_rocker(rocker: followers.Rocker, limits: followers.Limits) -> followers.Sizes | Names:
    """Return the sizes with the least r_0, the place of the cam's centre being free, or the limits that permit none.

    The half planes of a few positions are held; as long as another position is outside its limit, it joins them. A
    wide swing and large transmission angles may leave nothing.
    """
    swing, l = rocker.motion.h, rocker.l
    high = complex(-math.sin(swing), math.cos(swing))
    planes = [HalfPlane(LOWEST, 1j, 0.0), HalfPlane(HIGHEST, high, -l * math.sin(swing))]
    sizes = followers.Sizes(0.0, 0.0, 0.0)
    for _ in range(ROUNDS):
        further = [plane for limit in limits.each for plane in _outside(rocker, limit, complex(sizes.e, sizes.s_0))]
        if not further:
            break
        planes += further
        if (nearer := _nearest(planes)) is None:
            return _opposed(planes)
        sizes = nearer
    return replace(sizes, l_OC=abs(l - complex(sizes.e, sizes.s_0)))


def _opposed(planes: list[HalfPlane]) -> Names:
    """Return names of half planes that together permit nothing, as few as may be."""
    names = list(dict.fromkeys(plane.name for plane in planes))
    for name in tuple(names):
        fewer = [other for other in names if other != name]
        if _nearest([plane for plane in planes if plane.name in fewer]) is None:
            names = fewer
    return tuple(names)


def _outside(rocker: followers.Rocker, limit: followers.Limit, place: complex) -> Iterator[HalfPlane]:
    """Go through the positions that most lack their limit."""
    for worst in slacks(rocker, limit, place):
        if worst.value < -REACHED * rocker.l:
            side = 1 if worst.phi < rocker.motion.phase(limit.phase).end else -1
            normal, lowest = rocker.half_planes(limit, worst.phi, side)
            yield HalfPlane(limit.name, complex(normal), float(lowest), worst.phi)


def slacks(rocker: followers.Rocker, limit: followers.Limit, place: complex) -> list[Extreme]:
    """Return the least distances of a place from the limit, m, negative outside of it, and where they are."""

    def slack(phi: Any, side: int) -> Any:
        normal, lowest = rocker.half_planes(limit, phi, side)
        return normal.real * place.real + normal.imag * place.imag - lowest

    return minima(slack, rocker.motion.phase(limit.phase).corners)


def _smallest_rocker_at(rocker: followers.Rocker, limits: followers.Limits, l_OC: float) -> followers.Sizes | Names:
    """Return the sizes with the least r_0 at a given distance of the pivot, or the limits that permit none."""
    lowest, highest = (0.0, LOWEST), (math.pi - rocker.motion.h, HIGHEST)
    for limit in limits.each:
        free, low, high = _angles_permitted(rocker, limit, l_OC)
        if free < -1.0:
            return (limit.name,)
        lowest, highest = max(lowest, (-low, limit.name)), min(highest, (high, limit.name))
    beta, name = lowest
    if beta > highest[0]:
        return name, highest[1]
    place, farthest = (rocker.l - l_OC * complex(math.cos(end), -math.sin(end)) for end in (beta, highest[0]))
    return followers.Sizes(abs(place), place.real, place.imag, (name,), l_OC, abs(farthest))


def _angles_permitted(rocker: followers.Rocker, limit: followers.Limit, d: float) -> tuple[float, ...]:
    """Return the least -q of the positions, and between which angles -beta and beta they permit the cam's centre.

    With x = beta + psi a limit at the distance d of the pivot is sin(x - way sense gamma) >= q; a -q below -1 permits
    nothing.
    """

    def sine(phi: Any, side: int) -> Any:
        dpsi = rocker.motion.at(phi, side)[1]
        return (rocker.l / d) * math.sin(limit.gamma) * limit.way * (dpsi - rocker.sense)

    def shift(phi: Any, side: int) -> Any:
        return rocker.motion.at(phi, side)[0] - limit.way * rocker.sense * limit.gamma

    def arc(phi: Any, side: int) -> Array:
        return np.asarray(np.arcsin(np.clip(sine(phi, side), -1.0, 1.0)))

    ends: tuple[Function, ...] = (
        lambda phi, side: -sine(phi, side),
        lambda phi, side: shift(phi, side) - arc(phi, side),
        lambda phi, side: math.pi - shift(phi, side) - arc(phi, side),
    )
    corners = rocker.motion.phase(limit.phase).corners
    return tuple(least(end, corners).value for end in ends)


# The cam of each follower: the smallest one, or that of given sizes.


def roller_cam(cam: Cam, motion: Motion, values: Values) -> followers.RollerCam:
    """Return the smallest cam for a roller, or the one with the given r_0, e, or both.

    Raises InputError: no offset is permitted at the given r_0.
    """
    limits = followers.Limits(values["gamma_rise"], values["gamma_fall"], cam.two_sided)
    planes = wedge(motion, limits, cam.sense)
    r_0, e, between, permitted = values.get("r_0"), values.get("e"), None, None
    if r_0 is None:
        sizes = _smallest_roller(planes) if e is None else central(planes, e)
    else:
        between = offsets(planes, r_0)
        if e is not None:
            permitted = central(planes, e).r_0, math.inf
        elif between is None:
            raise InputError("cam-no-offset", r_0=_mm(r_0), least=six_digits(_smallest_roller(planes).r_0))
        else:
            e = 0.5 * (between[0] + between[1])
        sizes = followers.Sizes(r_0, e, math.sqrt((r_0 - e) * (r_0 + e)))
    profile = followers.RollerProfile(followers.Straight(motion, cam.sense), sizes, values["R_roller"])
    return followers.RollerCam(
        profile=profile, limits=limits, by_tangents=apex(planes), offsets=between, permitted=permitted
    )


def plate_cam(cam: Cam, motion: Motion, values: Values) -> followers.PlateCam:
    """Return the smallest cam for a plate, or the one with the given r_0_flat.

    Raises InputError: at the given r_0 the profile is curved with a smaller radius than is wanted.
    """
    sizes = _smallest_plate(motion, values["rho_flat"], values["margin"])
    r_0 = values.get("r_0_flat")
    if r_0 is not None:
        if r_0 < sizes.r_0 * (1.0 - ROUNDING):
            lengths = {"r_0": _mm(r_0), "rho": _mm(values["rho_flat"]), "least": six_digits(sizes.r_0)}
            raise InputError("cam-plate-r-0", **lengths)
        sizes = replace(sizes, r_0=r_0)
    return followers.PlateCam(
        sizes=sizes, profile=followers.PlateProfile(motion, sizes.r_0, cam.sense), given=r_0 is not None
    )


def rocker_cam(cam: Cam, values: Values) -> followers.RollerCam:
    """Return the smallest cam for a rocker, with the pivot at the given l_OC or wherever it is best.

    With r_0 given, too, nothing is left to be found.
    Raises InputError: the limits permit no place of the cam's centre, or the sizes given are those of no rocker's cam.
    """
    limits = followers.Limits(values["gamma_rise"], values["gamma_fall"], cam.two_sided)
    rocker = followers.Rocker(motion_of(cam, {**values, "h": values["psi"]}), values["l_rocker"], cam.sense)
    distance, r_0, permitted = values.get("l_OC"), values.get("r_0"), None
    if distance is None:
        if r_0 is not None:
            raise InputError("cam-rocker-r-0")
        sizes = _smallest_rocker(rocker, limits)
    else:
        sizes = _smallest_rocker_at(rocker, limits, distance)
        if r_0 is not None:
            permitted = (sizes.r_0, sizes.r_0_most) if isinstance(sizes, followers.Sizes) else None
            l = rocker.l  # a triangle whose sides are given
            cosine = (l * l + distance * distance - r_0 * r_0) / (2.0 * l * distance)
            if not -1.0 < cosine < 1.0:
                raise InputError("cam-rocker-triangle", l=_mm(l), l_OC=_mm(distance), r_0=_mm(r_0))
            place = l - distance * complex(cosine, -math.sqrt(1.0 - cosine * cosine))
            sizes = followers.Sizes(r_0, place.real, place.imag, l_OC=distance)
    if not isinstance(sizes, followers.Sizes):
        free = sizes if distance is None else _smallest_rocker(rocker, limits)
        if distance is None or not isinstance(free, followers.Sizes):
            raise InputError("cam-no-place", limits=_blamed(sizes if isinstance(free, followers.Sizes) else free))
        raise InputError("cam-no-place-at", limits=_blamed(sizes), l_OC=_mm(distance), best=_mm(free.l_OC))
    return followers.RollerCam(
        profile=followers.RollerProfile(rocker, sizes, values["R_roller"]), limits=limits, permitted=permitted
    )


def _blamed(limits: Names) -> str:
    """Return the givens that leave no place."""
    names = (f"gamma_{followers.PHASE_OF[name]}" if name in followers.PHASE_OF else "psi" for name in limits)
    return ", ".join(dict.fromkeys(names))


def _mm(length: float) -> str:
    return f"{length * MILLI:.6g}"


def six_digits(length: float, greatest: bool = False) -> str:
    """Return a least length in mm, of six digits, or the greatest, rounded down: who takes it is within the limits.

    >>> six_digits(0.0452581786), six_digits(0.02), six_digits(0.0452581786, greatest=True)
    ('45.2582', '20', '45.2581')
    """
    within, rounding = (1.0 + ROUNDING, ROUND_FLOOR) if greatest else (1.0 - ROUNDING, ROUND_CEILING)
    digits = Context(prec=6, rounding=rounding).create_decimal(Decimal(length * MILLI * within))
    return f"{float(digits):.6g}"
