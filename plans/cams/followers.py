"""The cams that one motion has for each kind of follower: sizes, profile, and what the board begins with."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from decimal import ROUND_CEILING, ROUND_FLOOR, Context, Decimal

from ...scales.errors import InputError
from .cam import Cam
from .construction import OUTWARDS, phase_of, side_of
from .integration import Division
from .motion import FALL, RISE, Array, Motion, motion_of
from .profile import PlateProfile, RollerProfile, StraightPath
from .rocker import (
    NoPlace,
    Rocker,
    RockerPath,
    RockerSizes,
    least_rocker_transmission,
    smallest_rocker,
    smallest_rocker_at,
)
from .sizes import (
    BACK,
    RIGHT_ANGLE,
    Limits,
    NoOffset,
    Offsets,
    PlateSizes,
    RollerSizes,
    apex,
    central,
    least_transmission,
    offsets,
    smallest_plate,
    smallest_roller,
    wedge,
)

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
