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
from numpy.typing import NDArray

from ...scales.errors import InputError
from .cam import Cam
from .construction import OUTWARDS, phase_of, side_of
from .motion import FALL, RISE, Array, Division, Extreme, Minimum, Motion, Phase, minima, motion_of
from .profile import PlateProfile, RollerProfile, StraightPath
from .sizes import (
    BACK,
    RIGHT_ANGLE,
    HalfPlane,
    Limits,
    Nearest,
    NoOffset,
    Offsets,
    PlateSizes,
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

Points = NDArray[Any]  # complex
ROUNDS = 40
REACHED = 1e-12  # part of the rocker's length by which a position may be outside its limit
LOWEST, HIGHEST = "lowest", "highest"  # the cam stays below the rocker


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
class NoPlace:
    """Limits, one alone or several together, that permit no place of the cam's centre."""

    limits: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Limit:
    """A limit of the pressure angle in one phase; `way` is +1 where it is to the side of a rise, -1 of a fall."""

    name: str
    phase: Phase
    gamma: float
    way: int


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

    def limits(self, limits: Limits) -> list[Limit]:
        """Return the limits in rise and fall, and to the other sides if wanted."""
        ways = ((1, ""), (-1, BACK))[: 1 + limits.two_sided]
        phases = ((self.motion.rise, limits.gamma_rise, 1), (self.motion.fall, limits.gamma_fall, -1))
        return [Limit(p.name + end, p, gamma, push * up) for push, end in ways for p, gamma, up in phases]


@dataclass(frozen=True, slots=True)
class RockerPath:
    """The path of a rocker's roller, for `RollerProfile`."""

    motion: Motion
    sizes: RockerSizes

    @property
    def pivot(self) -> complex:
        """The rocker's pivot, seen from the cam's centre."""
        return complex(self.sizes.e - self.sizes.l, self.sizes.s_0)

    def centre(self, phi: Any, side: int = 1) -> tuple[Points, Points, Points]:
        """Return q, q', q''."""
        psi, dpsi, d2psi = self.motion.at(phi, side)
        arm = self.sizes.l * (np.cos(psi) + 1j * np.sin(psi))
        return self.pivot + arm, 1j * dpsi * arm, (1j * d2psi - dpsi * dpsi) * arm

    def seat(self, corner: Points, R: float) -> Array:
        """Return the angle at which a roller of radius R rests on points of the frame; NaN where it passes them."""
        reach = corner - self.pivot
        far, l = np.abs(reach), self.sizes.l
        with np.errstate(invalid="ignore"):
            psi: Array = np.arctan2(reach.imag, reach.real) + np.arccos((l * l + far * far - R * R) / (2.0 * l * far))
        return psi


def smallest_rocker(rocker: Rocker, limits: Limits) -> RockerSizes | NoPlace:
    """Return the sizes with the least r_0, the place of the cam's centre being free, or why there is none.

    The half planes of a few positions are held; as long as another position is outside its limit, it joins them. A
    wide swing and large transmission angles may leave nothing.
    """
    swing, l = rocker.motion.h, rocker.l
    high = complex(-math.sin(swing), math.cos(swing))
    planes = [HalfPlane(LOWEST, 1j, 0.0), HalfPlane(HIGHEST, high, -l * math.sin(swing))]
    wanted = rocker.limits(limits)
    found = Nearest(0j, ())
    for _ in range(ROUNDS):
        further = [plane for limit in wanted for plane in _outside(rocker, limit, found.place)]
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
            side = 1 if worst.phi < limit.phase.end else -1
            normal, least = rocker.half_planes(limit, worst.phi, side)
            yield HalfPlane(limit.name, complex(normal), float(least), worst.phi)


def _slacks(rocker: Rocker, limit: Limit, place: complex) -> list[Minimum]:
    """Return the least distances of a place from the limit, m, negative outside of it, and where they are."""

    def slack(phi: Any, side: int) -> Array:
        normal, least = rocker.half_planes(limit, phi, side)
        room: Array = normal.real * place.real + normal.imag * place.imag - least
        return room

    return minima(slack, limit.phase.corners)


def tightest(rocker: Rocker, limit: Limit, place: complex) -> float:
    """Return the angle of the cam at which a place e + i s_0 comes nearest to a limit, rad."""
    return min(_slacks(rocker, limit, place), key=lambda one: one.value).phi


def smallest_rocker_at(rocker: Rocker, limits: Limits, l_OC: float) -> RockerSizes | NoPlace:
    """Return the sizes with the least r_0 at a given distance of the pivot, or the limits that permit none."""
    least, most = (0.0, LOWEST), (math.pi - rocker.motion.h, HIGHEST)
    for limit in rocker.limits(limits):
        bounds = _Bounds(rocker, limit, l_OC)
        ends = (bounds.free, bounds.low, bounds.high)
        free, low, high = (min(one.value for one in minima(end, limit.phase.corners)) for end in ends)
        if free < -1.0:
            return NoPlace((limit.name,))
        least, most = max(least, (-low, limit.name)), min(most, (high, limit.name))
    beta, name = least
    if beta > most[0]:
        return NoPlace((name, most[1]))
    place, farthest = (rocker.l - l_OC * complex(math.cos(end), -math.sin(end)) for end in (beta, most[0]))
    return RockerSizes(abs(place), l_OC, rocker.l, place.real, place.imag, (name,), abs(farthest))


@dataclass(frozen=True, slots=True)
class _Bounds:
    """Between which angles beta the positions of a rocker permit the cam's centre at the distance d of the pivot.

    With x = beta + psi a limit is sin(x - way sense gamma) >= q.
    """

    rocker: Rocker
    limit: Limit
    d: float

    def sine(self, phi: Any, side: int = 1) -> Array:
        """Return q."""
        _, dpsi, _ = self.rocker.motion.at(phi, side)
        way = self.limit.way
        q: Array = (self.rocker.l / self.d) * math.sin(self.limit.gamma) * way * (dpsi - self.rocker.sense)
        return q

    def free(self, phi: Any, side: int) -> Array:
        """Return -q: below -1 nothing is permitted."""
        return -self.sine(phi, side)

    def low(self, phi: Any, side: int) -> Array:
        """Return the least beta of the positions, negative so that the greatest of them is a minimum."""
        return self._shift(phi, side) - np.arcsin(np.clip(self.sine(phi, side), -1.0, 1.0))

    def high(self, phi: Any, side: int) -> Array:
        """Return the greatest beta of the positions."""
        return math.pi - self._shift(phi, side) - np.arcsin(np.clip(self.sine(phi, side), -1.0, 1.0))

    def _shift(self, phi: Any, side: int) -> Array:
        shift: Array = self.rocker.motion.at(phi, side)[0] - self.limit.way * self.rocker.sense * self.limit.gamma
        return shift


def rocker_pressure(rocker: Rocker, sizes: RockerSizes, phi: Any, side: int = 1) -> Array:
    """Return the pressure angle theta, rad: from the roller's velocity in the rise to the normal, its sign as usual."""
    psi, dpsi, _ = rocker.motion.at(phi, side)
    cosine, sine = np.cos(psi), np.sin(psi)
    x, y = sizes.e - sizes.l, sizes.s_0  # the pivot
    across = rocker.l * (rocker.sense * dpsi - 1.0) - (x * cosine + y * sine)
    theta: Array = np.arctan2(across, y * cosine - x * sine)
    return theta


def least_rocker_transmission(rocker: Rocker, sizes: RockerSizes, phase: Phase, two_sided: bool = False) -> Extreme:
    """Return the least transmission angle of the rise or the fall, rad, and where it is."""
    way = rocker.sense * (1 if phase.name == RISE else -1)

    def gamma(phi: Any, side: int) -> Array:
        theta = rocker_pressure(rocker, sizes, phi, side)
        return RIGHT_ANGLE - (np.abs(theta) if two_sided else way * theta)

    least = min(minima(gamma, phase.corners), key=lambda one: one.value)
    return Extreme(least.value, least.phi, phase.name)


Values = Mapping[str, float]
Range = tuple[float, float]  # the least and the greatest
MILLI = 1e3
ROUNDING = 1e-12  # part of a length by which it may be less than another, and the same


@dataclass(frozen=True, slots=True, kw_only=True)
class RollerCam:
    """A cam for a roller: its sizes, those where the limit tangents meet, and the offsets permitted at a given r_0.

    `permitted` is the least r_0 at an offset that is given together with r_0, and the greatest, which is infinite.
    """

    limits: Limits
    sizes: RollerSizes
    by_tangents: RollerSizes
    profile: RollerProfile
    offsets: Offsets | None = None
    permitted: Range | None = None

    def givens(self, cam: Cam) -> dict[str, float]:
        """Return the sizes as parts of the stroke, to which they are proportional, and the limits' tangents."""
        motion, sizes = self.profile.motion, self.sizes
        found = {"_e_part": sizes.e / motion.h, "_s_0_part": sizes.s_0 / motion.h}
        found["_rho_part"] = self.profile.rho_min / motion.h
        if self.offsets is not None:
            found |= {"_e_least": self.offsets.least / motion.h, "_e_most": self.offsets.most / motion.h}
        gammas = {RISE: self.limits.gamma_rise, FALL: self.limits.gamma_fall}
        for limit in limits_of(cam):
            gamma, side = gammas[phase_of(limit)], side_of(limit, cam.sense)
            found |= {f"_slope_{limit}": side / math.tan(gamma), f"_side_{limit}": float(side)}
            found[f"_inclination_{limit}"] = gamma if side > 0 else math.pi - gamma
        for phase in (RISE, FALL):
            least = least_transmission(motion, sizes, phase, cam.sense, cam.two_sided)
            found[f"_gamma_{phase}_least"] = min(least.value, RIGHT_ANGLE)  # more: pressed to the other side alone
        return found


@dataclass(frozen=True, slots=True, kw_only=True)
class PlateCam:
    """A cam for a plate."""

    sizes: PlateSizes
    profile: PlateProfile
    given: bool = False  # whether r_0 is given

    def givens(self) -> dict[str, float]:
        """Return the least radius as a part of the stroke."""
        return {"_r_0_flat_part": self.sizes.r_0_min / self.profile.motion.h}


@dataclass(frozen=True, slots=True, kw_only=True)
class RockerCam:
    """A cam for a rocker with a roller; `rocker` has the motion as angles, rad.

    `permitted` is the least and the greatest r_0 at an l_OC that is given together with r_0, None where no r_0 is.
    """

    limits: Limits
    rocker: Rocker
    sizes: RockerSizes
    profile: RollerProfile
    permitted: Range | None = None

    def givens(self, cam: Cam, angles: Array, division: Division) -> dict[str, float]:
        """Return the rocker's positions, the directions of the limits, and sizes as parts of its length."""
        psi, dpsi, _ = self.rocker.motion.at(angles, -1)
        pivot, length = RockerPath(self.rocker.motion, self.sizes).pivot, self.sizes.l
        found = {"_centre_x_part": -pivot.real / length, "_centre_y_part": -pivot.imag / length}
        found["_rho_part"] = self.profile.rho_min / length
        start = math.atan2(pivot.imag, pivot.real)
        for i in division.lines:
            turned = cam.sense * float(angles[i])
            found |= {f"_swing{i}": float(psi[i]), f"_analogue{i}": cam.sense * float(dpsi[i])}
            found |= {f"_arm_angle{i}": float(psi[i]) - turned, f"_pivot_angle{i}": start - turned}
            way, gamma = (1, self.limits.gamma_rise) if i in division.rise else (-1, self.limits.gamma_fall)
            found[f"_limit_angle{i}"] = float(psi[i]) - way * cam.sense * gamma
        for phase in (self.rocker.motion.rise, self.rocker.motion.fall):
            least = least_rocker_transmission(self.rocker, self.sizes, phase, cam.two_sided)
            found[f"_gamma_{phase.name}_least"] = min(least.value, RIGHT_ANGLE)
        return found


def limits_of(cam: Cam) -> tuple[str, ...]:
    """Return the names of the limits of the pressure angle."""
    return (RISE, FALL, RISE + BACK, FALL + BACK) if cam.two_sided else (RISE, FALL)


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
        raise _no_place(rocker, limits, distance, found)
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


def _no_place(rocker: Rocker, limits: Limits, l_OC: float | None, found: NoPlace) -> InputError:
    """Tell which limits leave no place, at a given l_OC the one that the smallest cam has."""
    free = found if l_OC is None else smallest_rocker(rocker, limits)
    if l_OC is None or isinstance(free, NoPlace):
        assert isinstance(free, NoPlace)
        return InputError("cam-no-place", limits=_names(free))
    distances = {"l_OC": f"{l_OC * MILLI:.6g}", "best": f"{free.l_OC * MILLI:.6g}"}
    return InputError("cam-no-place-at", limits=_names(found), **distances)


def _names(found: NoPlace) -> str:
    """Return the givens that leave no place."""
    names = (f"gamma_{phase_of(name)}" if phase_of(name) in OUTWARDS else "psi" for name in found.limits)
    return ", ".join(dict.fromkeys(names))
