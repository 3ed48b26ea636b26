"""The cams that one motion has for each kind of follower: sizes, profile, and what the board begins with.

A rocker is an oscillating follower with a roller. At phi = 0 the rocker lies in its lowest position, from its pivot
horizontally to the right; it lifts the roller up, the cam is below. As for a roller on a line, e + i s_0 is the
roller's lowest place seen from the cam's centre, r_0 its distance; the travel is the angle psi of the rocker. The
normal runs through the point of the rocker's line that is l (1 - sense psi') from the pivot, so every position of the
rocker permits a half plane of e + i s_0, and the smallest cam is the place nearest to the origin in all of them.

With the distance l_OC of the pivot from the cam's centre given, one number is left: the angle beta at the pivot between
the rocker in its lowest position and the cam's centre, of which every position permits an interval.

Source: Artobolevsky, Theory of mechanisms and machines (cams with an oscillating follower).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from decimal import ROUND_CEILING, ROUND_FLOOR, Context, Decimal
from typing import Any

import numpy as np

from ...scales.errors import InputError
from .cam import Cam
from .envelopes import Points
from .motion import FALL, RISE, Array, Division, Extreme, Function, Motion, least, minima, motion_of
from .profile import PlateProfile, RockerPath, RollerProfile, StraightPath
from .sizes import (
    PHASE_OF,
    RIGHT_ANGLE,
    HalfPlane,
    Limit,
    Limits,
    Nearest,
    NoOffset,
    Offsets,
    PlateSizes,
    RockerSizes,
    RollerSizes,
    apex,
    central,
    least_transmission,
    nearest,
    offsets,
    smallest_plate,
    smallest_roller,
    wedge,
)

ROUNDS = 40
REACHED = 1e-12  # part of the rocker's length by which a position may be outside its limit
LOWEST, HIGHEST = "lowest", "highest"  # the cam stays below the rocker


@dataclass(frozen=True, slots=True)
class NoPlace:
    """Limits, one alone or several together, that permit no place of the cam's centre."""

    limits: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Rocker:
    """A rocker of length l, m, with its motion psi(phi), rad, over a cam that turns with a sense."""

    motion: Motion
    l: float
    sense: int = 1

    def half_planes(self, limit: Limit, phi: Any, side: int = 1) -> tuple[Points, Array]:
        """Return normals and least components of the half planes of e + i s_0 that its positions permit."""
        psi, dpsi, _ = self.motion.at(phi, side)
        sine, cosine, way = math.sin(limit.gamma), math.cos(limit.gamma), limit.way
        normal = complex(way * self.sense * sine, cosine) * (np.cos(psi) + 1j * np.sin(psi))
        least = self.l * (sine * way * (self.sense * (np.cos(psi) - 1.0) + dpsi) - cosine * np.sin(psi))
        return normal, least


def smallest_rocker(rocker: Rocker, limits: Limits) -> RockerSizes | NoPlace:
    """Return the sizes with the least r_0, the place of the cam's centre being free, or why there is none.

    The half planes of a few positions are held; as long as another position is outside its limit, it joins them. A
    wide swing and large transmission angles may leave nothing.
    """
    swing, l = rocker.motion.h, rocker.l
    high = complex(-math.sin(swing), math.cos(swing))
    planes = [HalfPlane(LOWEST, 1j, 0.0), HalfPlane(HIGHEST, high, -l * math.sin(swing))]
    found = Nearest(0j, ())
    for _ in range(ROUNDS):
        further = [plane for limit in limits.each for plane in _outside(rocker, limit, found.place)]
        if not further:
            break
        planes += further
        if (nearer := nearest(planes)) is None:
            return NoPlace(_opposed(planes))
        found = nearer
    place = found.place
    on = tuple(plane.name for plane in found.on)
    return RockerSizes(abs(place), abs(l - place), l, place.real, place.imag, on)


def _opposed(planes: list[HalfPlane]) -> tuple[str, ...]:
    """Return names of half planes that together permit nothing, as few as may be."""
    names = list(dict.fromkeys(plane.name for plane in planes))
    for name in tuple(names):
        fewer = [other for other in names if other != name]
        if nearest([plane for plane in planes if plane.name in fewer]) is None:
            names = fewer
    return tuple(names)


def _outside(rocker: Rocker, limit: Limit, place: complex) -> Iterator[HalfPlane]:
    """Go through the positions that most lack their limit."""
    for worst in _slacks(rocker, limit, place):
        if worst.value < -REACHED * rocker.l:
            side = 1 if worst.phi < rocker.motion.phase(limit.phase).end else -1
            normal, least = rocker.half_planes(limit, worst.phi, side)
            yield HalfPlane(limit.name, complex(normal), float(least), worst.phi)


def _slacks(rocker: Rocker, limit: Limit, place: complex) -> list[Extreme]:
    """Return the least distances of a place from the limit, m, negative outside of it, and where they are."""

    def slack(phi: Any, side: int) -> Array:
        normal, least = rocker.half_planes(limit, phi, side)
        room: Array = normal.real * place.real + normal.imag * place.imag - least
        return room

    return minima(slack, rocker.motion.phase(limit.phase).corners)


def tightest(rocker: Rocker, limit: Limit, place: complex) -> float:
    """Return the angle of the cam at which a place e + i s_0 comes nearest to a limit, rad."""
    return min(_slacks(rocker, limit, place), key=lambda slack: slack.value).phi


def smallest_rocker_at(rocker: Rocker, limits: Limits, l_OC: float) -> RockerSizes | NoPlace:
    """Return the sizes with the least r_0 at a given distance of the pivot, or the limits that permit none."""
    least, most = (0.0, LOWEST), (math.pi - rocker.motion.h, HIGHEST)
    for limit in limits.each:
        free, low, high = _angles_permitted(rocker, limit, l_OC)
        if free < -1.0:
            return NoPlace((limit.name,))
        least, most = max(least, (-low, limit.name)), min(most, (high, limit.name))
    beta, name = least
    if beta > most[0]:
        return NoPlace((name, most[1]))
    place, farthest = (rocker.l - l_OC * complex(math.cos(end), -math.sin(end)) for end in (beta, most[0]))
    return RockerSizes(abs(place), l_OC, rocker.l, place.real, place.imag, (name,), abs(farthest))


def _angles_permitted(rocker: Rocker, limit: Limit, d: float) -> tuple[float, ...]:
    """Return the least -q of the positions, and between which angles -beta and beta they permit the cam's centre.

    With x = beta + psi a limit at the distance d of the pivot is sin(x - way sense gamma) >= q; a -q below -1 permits
    nothing.
    """

    def sine(phi: Any, side: int) -> Array:
        q: Array = (rocker.l / d) * math.sin(limit.gamma) * limit.way * (rocker.motion.at(phi, side)[1] - rocker.sense)
        return q

    def shift(phi: Any, side: int) -> Array:
        turned: Array = rocker.motion.at(phi, side)[0] - limit.way * rocker.sense * limit.gamma
        return turned

    def arc(phi: Any, side: int) -> Array:
        return np.asarray(np.arcsin(np.clip(sine(phi, side), -1.0, 1.0)))

    ends: tuple[Function, ...] = (
        lambda phi, side: -sine(phi, side),
        lambda phi, side: shift(phi, side) - arc(phi, side),
        lambda phi, side: math.pi - shift(phi, side) - arc(phi, side),
    )
    corners = rocker.motion.phase(limit.phase).corners
    return tuple(least(end, corners).value for end in ends)


def least_rocker_transmission(profile: RollerProfile, phase: str, two_sided: bool = False) -> Extreme:
    """Return the least transmission angle of the rise or the fall with a rocker, rad, and where it is."""
    way = profile.sense * (1 if phase == RISE else -1)

    def gamma(phi: Any, side: int) -> Array:
        theta = profile.pressure(phi, side)
        return RIGHT_ANGLE - (np.abs(theta) if two_sided else way * theta)

    return least(gamma, profile.motion.phase(phase).corners)


Values = Mapping[str, float]
Range = tuple[float, float]  # the least and the greatest
MILLI = 1e3
ROUNDING = 1e-12  # part of a length by which it may be less than another, and the same


@dataclass(frozen=True, slots=True, kw_only=True)
class RollingCam:
    """A cam for a follower with a roller: its sizes, its profile, the limits of the pressure angle.

    `permitted` is the least r_0 at the offset, or at the l_OC, that is given together with r_0, and the greatest; None
    where they are not.
    """

    limits: Limits
    sizes: RollerSizes | RockerSizes
    profile: RollerProfile
    permitted: Range | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class RollerCam(RollingCam):
    """A cam for a roller on a line, the sizes where the limit tangents meet, the offsets permitted at a given r_0."""

    sizes: RollerSizes
    by_tangents: RollerSizes
    offsets: Offsets | None = None

    def givens(self, division: Division) -> dict[str, float]:
        """Return the sizes as parts of the stroke, to which they are proportional, and the limits' tangents."""
        motion, sizes, sense = self.profile.motion, self.sizes, self.profile.sense
        found = {"_e_part": sizes.e / motion.h, "_s_0_part": sizes.s_0 / motion.h}
        found["_rho_part"] = self.profile.rho_min / motion.h
        if self.offsets is not None:
            found |= {"_e_least": self.offsets.least / motion.h, "_e_most": self.offsets.most / motion.h}
        for limit in self.limits.each:
            name, gamma, side = limit.name, limit.gamma, limit.way * sense
            found |= {f"_slope_{name}": side / math.tan(gamma), f"_side_{name}": float(side)}
            found[f"_inclination_{name}"] = gamma if side > 0 else math.pi - gamma
        for phase in (RISE, FALL):
            least = least_transmission(motion, sizes, phase, sense, self.limits.two_sided)
            found[f"_gamma_{phase}_least"] = min(least.value, RIGHT_ANGLE)  # more: pressed to the other side alone
        return found


@dataclass(frozen=True, slots=True, kw_only=True)
class PlateCam:
    """A cam for a plate."""

    sizes: PlateSizes
    profile: PlateProfile
    given: bool = False  # whether r_0 is given

    def givens(self, division: Division) -> dict[str, float]:
        """Return the least radius as a part of the stroke."""
        return {"_r_0_flat_part": self.sizes.r_0_min / self.profile.motion.h}


@dataclass(frozen=True, slots=True, kw_only=True)
class RockerCam(RollingCam):
    """A cam for a rocker with a roller; `rocker` has the motion as angles, rad."""

    rocker: Rocker
    sizes: RockerSizes

    def givens(self, division: Division) -> dict[str, float]:
        """Return the rocker's positions, the directions of the limits, and sizes as parts of its length."""
        psi, dpsi, _ = self.rocker.motion.at(division.angles, -1)
        sizes, length, sense = self.sizes, self.sizes.l, self.rocker.sense
        x, y = sizes.e - length, sizes.s_0  # the pivot
        found = {"_centre_x_part": -x / length, "_centre_y_part": -y / length}
        found["_rho_part"] = self.profile.rho_min / length
        start = math.atan2(y, x)
        for i in division.lines:
            turned = sense * float(division.angles[i])
            found |= {f"_swing{i}": float(psi[i]), f"_analogue{i}": sense * float(dpsi[i])}
            found |= {f"_arm_angle{i}": float(psi[i]) - turned, f"_pivot_angle{i}": start - turned}
            limit = self.limits.each[i not in division.rise]
            found[f"_limit_angle{i}"] = float(psi[i]) - limit.way * sense * limit.gamma
        for phase in (RISE, FALL):
            least = least_rocker_transmission(self.profile, phase, self.limits.two_sided)
            found[f"_gamma_{phase}_least"] = min(least.value, RIGHT_ANGLE)
        return found


def roller_cam(cam: Cam, motion: Motion, values: Values) -> RollerCam:
    """Return the smallest cam for a roller, or the one with the given r_0, e, or both.

    Raises
    ------
    InputError
        No offset is permitted at the given r_0.
    """
    limits = Limits(values["gamma_rise"], values["gamma_fall"], cam.two_sided)
    planes = wedge(motion, limits, cam.sense)
    r_0, e, between, permitted = values.get("r_0"), values.get("e"), None, None
    if r_0 is None:
        sizes = smallest_roller(planes) if e is None else central(planes, e)
    else:
        ends = offsets(planes, r_0)
        between = ends if isinstance(ends, Offsets) else None
        if e is not None:
            permitted = central(planes, e).r_0, math.inf
        elif isinstance(ends, NoOffset):
            raise InputError("cam-no-offset", r_0=f"{r_0 * MILLI:.6g}", least=six_digits(ends.r_0_min))
        else:
            e = 0.5 * (ends.least + ends.most)
        sizes = RollerSizes(r_0, e, math.sqrt((r_0 - e) * (r_0 + e)))
    profile = RollerProfile(StraightPath(motion, sizes), values["R_roller"], cam.sense)
    tangents = apex(planes)
    return RollerCam(
        limits=limits, sizes=sizes, by_tangents=tangents, profile=profile, offsets=between, permitted=permitted
    )


def six_digits(length: float, greatest: bool = False) -> str:
    """Return a least length in mm, of six digits, or the greatest, rounded down: who takes it is within the limits.

    >>> six_digits(0.0452581786), six_digits(0.02), six_digits(0.0452581786, greatest=True)
    ('45.2582', '20', '45.2581')
    """
    within, rounding = (1.0 + ROUNDING, ROUND_FLOOR) if greatest else (1.0 - ROUNDING, ROUND_CEILING)
    digits = Context(prec=6, rounding=rounding).create_decimal(Decimal(length * MILLI * within))
    return f"{float(digits):.6g}"


def plate_cam(cam: Cam, motion: Motion, values: Values) -> PlateCam:
    """Return the smallest cam for a plate, or the one with the given r_0_flat.

    Raises
    ------
    InputError
        At the given r_0 the profile is curved with a smaller radius than is wanted.
    """
    sizes = smallest_plate(motion, values["rho_flat"], values["margin"])
    r_0 = values.get("r_0_flat")
    if r_0 is not None:
        if r_0 < sizes.r_0 * (1.0 - ROUNDING):
            lengths = {"r_0": f"{r_0 * MILLI:.6g}", "rho": f"{values['rho_flat'] * MILLI:.6g}"}
            raise InputError("cam-plate-r-0", **lengths, least=six_digits(sizes.r_0))
        sizes = replace(sizes, r_0=r_0)
    return PlateCam(sizes=sizes, profile=PlateProfile(motion, sizes.r_0, cam.sense), given=r_0 is not None)


def rocker_cam(cam: Cam, values: Values) -> RockerCam:
    """Return the smallest cam for a rocker, with the pivot at the given l_OC or wherever it is best.

    With r_0 given, too, nothing is left to be found.

    Raises
    ------
    InputError
        The limits permit no place of the cam's centre, or the sizes given are those of no rocker's cam.
    """
    limits = Limits(values["gamma_rise"], values["gamma_fall"], cam.two_sided)
    rocker = Rocker(motion_of(cam, {**values, "h": values["psi"]}), values["l_rocker"], cam.sense)
    distance, r_0, permitted = values.get("l_OC"), values.get("r_0"), None
    if distance is None:
        if r_0 is not None:
            raise InputError("cam-rocker-r-0")
        found = smallest_rocker(rocker, limits)
    elif r_0 is None:
        found = smallest_rocker_at(rocker, limits, distance)
    else:
        found, best = _given_sizes(rocker.l, distance, r_0), smallest_rocker_at(rocker, limits, distance)
        permitted = None if isinstance(best, NoPlace) else (best.r_0, best.r_0_most)
    if isinstance(found, NoPlace):
        free = found if distance is None else smallest_rocker(rocker, limits)
        if distance is None or isinstance(free, NoPlace):
            raise InputError("cam-no-place", limits=_names(found if isinstance(free, RockerSizes) else free))
        at = {"l_OC": f"{distance * MILLI:.6g}", "best": f"{free.l_OC * MILLI:.6g}"}
        raise InputError("cam-no-place-at", limits=_names(found), **at)
    profile = RollerProfile(RockerPath(rocker.motion, found), values["R_roller"], cam.sense)
    return RockerCam(limits=limits, rocker=rocker, sizes=found, profile=profile, permitted=permitted)


def _given_sizes(l: float, l_OC: float, r_0: float) -> RockerSizes:
    """Return the sizes of a cam of which the rocker, its pivot and r_0 are given: the sides of a triangle."""
    cosine = (l * l + l_OC * l_OC - r_0 * r_0) / (2.0 * l * l_OC)
    if not -1.0 < cosine < 1.0:
        sides = {"l": l, "l_OC": l_OC, "r_0": r_0}
        raise InputError("cam-rocker-triangle", **{name: f"{side * MILLI:.6g}" for name, side in sides.items()})
    place = l - l_OC * complex(cosine, -math.sqrt(1.0 - cosine * cosine))
    return RockerSizes(r_0, l_OC, l, place.real, place.imag)


def _names(found: NoPlace) -> str:
    """Return the givens that leave no place."""
    names = (f"gamma_{PHASE_OF[name]}" if name in PHASE_OF else "psi" for name in found.limits)
    return ", ".join(dict.fromkeys(names))
