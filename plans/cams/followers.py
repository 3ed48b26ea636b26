"""The followers of a cam, and its profiles by inversion: for a roller on a line, on a rocker, and under a plate.

All points are complex numbers, m, in the frame of the cam as it stands at phi = 0: the centre at the origin, the
follower above it. In that frame the follower goes round against the sense of the cam, by exp(-i sense phi).

A roller's centre q(phi), seen from the frame, moves on the cam with the velocity w = q' - i sense q; the derivative of
that is q'' - 2 i sense q' - q. Its curvature is positive where the pitch curve is convex. The practical profile is
parallel to the pitch curve, R inside. A plate at the height r_0 + s touches its profile under the instant centre,
sense * s' beside its axis, where the radius of curvature is r_0 + s + s''.

A rocker is an oscillating follower with a roller. At phi = 0 the rocker lies in its lowest position, from its pivot
horizontally to the right; it lifts the roller up, the cam is below. As for a roller on a line, e + i s_0 is the
roller's lowest place seen from the cam's centre, r_0 its distance; the travel is the angle psi of the rocker. The
normal runs through the point of the rocker's line that is l (1 - sense psi') from the pivot.

Source: Artobolevsky, Theory of mechanisms and machines (inversion of motion, cams with an oscillating follower).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from ..laws import cross, dot
from .envelopes import Envelope, Points
from .motion import FALL, RISE, Array, Division, Extreme, Motion, least

OF_R_0, OF_RHO_MIN = 0.4, 0.7  # the roller's radius is at most these parts of r_0 and of the pitch curve's rho_min
RIGHT_ANGLE = 0.5 * math.pi
BACK = "_back"  # ends the name of a limit on the side to which the cam does not push
PHASE_OF = {phase + end: phase for end in ("", BACK) for phase in (RISE, FALL)}  # of limits, by their names
ROUNDS = 60  # of a search that doubles its figures in every round
Range = tuple[float, float]  # the least and the greatest


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
class Sizes:
    """Sizes of a cam with a roller, m; `on` names the limits that it just reaches: two at the apex of a wedge.

    Those of a rocker have the distance l_OC of its pivot, and the greatest r_0 that the limits permit there.
    """

    r_0: float
    e: float
    s_0: float
    on: tuple[str, ...] = ()
    l_OC: float = math.nan
    r_0_most: float = math.inf


NOWHERE = Sizes(math.nan, math.nan, math.nan)


@dataclass(frozen=True, slots=True)
class PlateSizes:
    """Sizes of a cam with a flat follower: r_0_min makes the profile just convex, at the angle phi of the cam."""

    r_0_min: float
    r_0: float
    R_plate: float
    phi: float


@dataclass(frozen=True, slots=True)
class Straight:
    """A roller that moves up along a line, at the offset e to the right of the cam's centre.

    The `sense` of the cam is +1 counter-clockwise. `centre` is q, q', q'' of the roller's centre.
    """

    motion: Motion
    sense: int = 1

    @property
    def unit(self) -> float:
        """The length to which the sizes of a cam are proportional, m."""
        return self.motion.h

    def centre(self, sizes: Sizes, phi: Any, side: int = 1) -> tuple[Points, Points, Points]:
        """Return q, q', q''."""
        s, ds, d2s = self.motion.at(phi, side)
        return sizes.e + 1j * (sizes.s_0 + s), 1j * ds, 1j * d2s

    def seat(self, sizes: Sizes, corner: Points, R: float) -> Points:
        """Return the travel at which a roller of radius R rests on points of the frame; NaN where it passes them."""
        beside = corner.real - sizes.e
        with np.errstate(invalid="ignore"):
            return corner.imag + np.sqrt(R * R - beside * beside) - sizes.s_0

    def pressure(self, sizes: Sizes, phi: Any, side: int = 1) -> Any:
        """Return the pressure angle theta, rad."""
        s, ds, _ = self.motion.at(phi, side)
        return np.arctan2(self.sense * ds - sizes.e, sizes.s_0 + s)

    def analogue(self, phi: Any, side: int = 1) -> Points:
        """Return S over ds/dphi, to the side to which a velocity upwards turns with the cam."""
        s, ds, _ = self.motion.at(phi, side)
        return 1j * s - self.sense * ds

    def least_transmission(self, sizes: Sizes, phase: str, two_sided: bool = False) -> Extreme:
        """Return the least transmission angle of the rise or the fall, rad, exactly, and where it is.

        One-sided, only pressure to the side to which the cam pushes counts, and the angle may exceed a right angle.
        """
        ways = _pushed(phase)[: 1 + two_sided]
        steepest = max((self._steepest(sizes, phase, way) for way in ways), key=lambda extreme: extreme.value)
        return Extreme(RIGHT_ANGLE - math.atan(steepest.value), steepest.phi)

    def _steepest(self, sizes: Sizes, phase: str, way: int) -> Extreme:
        """Return the greatest way * sense * tan(theta) = way * (s' - sense e) / (s_0 + s).

        A quotient is greatest where its numerator less so many times its denominator is (Dinkelbach).
        """
        best, slope = Extreme(-math.inf, 0.0), 0.0
        for _ in range(ROUNDS):
            greatest = self.motion.maximum(-slope, way, 0.0, (phase,))
            s = float(self.motion.at(greatest.phi)[0])
            slope = (greatest.value + slope * s - way * self.sense * sizes.e) / (sizes.s_0 + s)
            if slope <= best.value:
                break
            best = Extreme(slope, greatest.phi)
        return best

    def givens(self, cam: RollerCam, division: Division) -> dict[str, float]:
        """Return the sizes as parts of the stroke, to which they are proportional, and the limits' tangents."""
        h = self.motion.h
        numbers = {"_e_part": cam.sizes.e / h, "_s_0_part": cam.sizes.s_0 / h}
        if cam.offsets is not None:
            numbers |= {"_e_least": cam.offsets[0] / h, "_e_most": cam.offsets[1] / h}
        for limit in cam.limits.each:
            name, gamma, side = limit.name, limit.gamma, -limit.way * self.sense
            numbers |= {f"_slope_{name}": side / math.tan(gamma), f"_side_{name}": float(side)}
            numbers[f"_inclination_{name}"] = gamma if side > 0 else math.pi - gamma
        return numbers


@dataclass(frozen=True, slots=True)
class Rocker:
    """A rocker of length l, m, with its motion psi(phi), rad, over a cam that turns with a sense."""

    motion: Motion
    l: float
    sense: int = 1

    @property
    def unit(self) -> float:
        """The length to which the sizes of a cam are proportional, m."""
        return self.l

    def pivot(self, sizes: Sizes) -> complex:
        """Return the rocker's pivot, seen from the cam's centre."""
        return sizes.e - self.l + 1j * sizes.s_0

    def centre(self, sizes: Sizes, phi: Any, side: int = 1) -> tuple[Points, Points, Points]:
        """Return q, q', q''."""
        psi, dpsi, d2psi = self.motion.at(phi, side)
        arm = self.l * (np.cos(psi) + 1j * np.sin(psi))
        return self.pivot(sizes) + arm, 1j * dpsi * arm, (1j * d2psi - dpsi * dpsi) * arm

    def seat(self, sizes: Sizes, corner: Points, R: float) -> Points:
        """Return the angle at which a roller of radius R rests on points of the frame; NaN where it passes them."""
        reach, l = corner - self.pivot(sizes), self.l
        far = np.abs(reach)
        with np.errstate(invalid="ignore"):
            return np.arctan2(reach.imag, reach.real) + np.arccos((l * l + far * far - R * R) / (2.0 * l * far))

    def pressure(self, sizes: Sizes, phi: Any, side: int = 1) -> Any:
        """Return the pressure angle, rad: from the roller's velocity in the rise to the normal, its sign as usual."""
        psi, dpsi, _ = self.motion.at(phi, side)
        cosine, sine, pivot = np.cos(psi), np.sin(psi), self.pivot(sizes)
        x, y = pivot.real, pivot.imag
        across = self.l * (self.sense * dpsi - 1.0) - (x * cosine + y * sine)
        return np.arctan2(across, y * cosine - x * sine)

    def analogue(self, phi: Any, side: int = 1) -> Any:
        """Return the ends of the analogues of velocity, laid off along the rocker, seen from the pivot."""
        psi, dpsi, _ = self.motion.at(phi, side)
        return self.l * np.exp(1j * psi) * (1.0 - self.sense * dpsi)

    def half_planes(self, limit: Limit, phi: Any, side: int = 1) -> tuple[Points, Array]:
        """Return normals and least components of the half planes of e + i s_0 that its positions permit."""
        psi, dpsi, _ = self.motion.at(phi, side)
        sine, cosine, way = math.sin(limit.gamma), math.cos(limit.gamma), limit.way
        normal = complex(way * self.sense * sine, cosine) * (np.cos(psi) + 1j * np.sin(psi))
        lowest = self.l * (sine * way * (self.sense * (np.cos(psi) - 1.0) + dpsi) - cosine * np.sin(psi))
        return normal, lowest

    def least_transmission(self, sizes: Sizes, phase: str, two_sided: bool = False) -> Extreme:
        """Return the least transmission angle of the rise or the fall, rad, and where it is."""
        way = self.sense * _pushed(phase)[0]

        def gamma(phi: Any, side: int) -> Any:
            theta = self.pressure(sizes, phi, side)
            return RIGHT_ANGLE - (np.abs(theta) if two_sided else way * theta)

        return least(gamma, self.motion.phase(phase).corners)

    def givens(self, cam: RollerCam, division: Division) -> dict[str, float]:
        """Return the rocker's positions, the directions of the limits, and the pivot in parts of its length."""
        psi, dpsi, _ = self.motion.at(division.angles, -1)
        pivot, sense = self.pivot(cam.sizes), self.sense
        numbers = {"_centre_x_part": -pivot.real / self.l, "_centre_y_part": -pivot.imag / self.l}
        start = math.atan2(pivot.imag, pivot.real)
        for i in division.lines:
            turned, limit = sense * float(division.angles[i]), cam.limits.each[i not in division.rise]
            numbers |= {f"_swing{i}": float(psi[i]), f"_analogue{i}": sense * float(dpsi[i])}
            numbers |= {f"_arm_angle{i}": float(psi[i]) - turned, f"_pivot_angle{i}": start - turned}
            numbers[f"_limit_angle{i}"] = float(psi[i]) - limit.way * sense * limit.gamma
        return numbers


def _pushed(phase: str) -> tuple[int, int]:
    """Return the ways of the velocity in a phase: first where the cam pushes, then the other."""
    return (1, -1) if phase == RISE else (-1, 1)


@dataclass(frozen=True)
class RollerProfile(Envelope):
    """The profile of a cam for a follower with a roller of the radius R."""

    follower: Straight | Rocker
    sizes: Sizes
    R: float

    @property
    def motion(self) -> Motion:  # type: ignore[override]
        """That of the follower."""
        return self.follower.motion

    @property
    def sense(self) -> int:
        """That of the cam."""
        return self.follower.sense

    def pressure(self, phi: Any, side: int = 1) -> Any:
        """Return the pressure angle theta, rad, at the angles `phi` of the cam; where s' jumps, a limit."""
        return self.follower.pressure(self.sizes, phi, side)

    def pitch(self, phi: Any, side: int = 1) -> Points:
        """Return points of the pitch curve."""
        return self.follower.centre(self.sizes, phi, side)[0] * turned_back(phi, self.sense)

    def _velocity(self, phi: Any, side: int) -> tuple[Points, Points]:
        """Return the first and second derivative of the pitch curve, as seen in the frame."""
        q, dq, d2q = self.follower.centre(self.sizes, phi, side)
        return dq - 1j * self.sense * q, d2q - 2j * self.sense * dq - q

    def unit(self, phi: Any, side: int = 1) -> Points:
        """Return the unit tangent of the pitch curve, in the sense of growing phi."""
        w, _ = self._velocity(phi, side)
        return w / np.abs(w) * turned_back(phi, self.sense)

    def normal(self, phi: Any, side: int = 1) -> Points:
        """Return the unit normal of the pitch curve, out of the cam."""
        return self.unit(phi, side) * (1j * self.sense)

    def curvature(self, phi: Any, side: int = 1) -> Array:
        """Return the curvature of the pitch curve, 1/m, positive where it is convex."""
        w, dw = self._velocity(phi, side)
        kappa: Array = -self.sense * cross(w, dw) / np.abs(w) ** 3
        return kappa

    def practical(self, phi: Any, side: int = 1) -> Points:
        """Return points of the practical profile, loops and all."""
        return self.pitch(phi, side) - self.R * self.normal(phi, side)

    def tangent(self, phi: Any, side: int = 1) -> Points:
        """Return the derivative of `practical`."""
        w, _ = self._velocity(phi, side)
        return w * turned_back(phi, self.sense) * self.bend(phi, side)

    def bend(self, phi: Any, side: int = 1) -> Array:
        """Return 1 - R / rho, negative where the envelope runs backwards."""
        return 1.0 - self.R * self.curvature(phi, side)

    def depth(self, points: Any, phi: Any) -> Any:
        """Return how deep points of the cam are inside the roller, m."""
        return self.R - np.abs(points - self.pitch(phi))

    def seat(self, corner: complex, phi: Any) -> Array:
        """Return the travel at which the roller rests on a corner of the cam."""
        return self.follower.seat(self.sizes, corner * np.conj(turned_back(phi, self.sense)), self.R)

    def across(self, phi: float, part: Any) -> tuple[Points, Points]:
        """Return the arc, of the roller's radius, by which the profile goes on where the velocity jumps up."""
        before, after = (complex(self.normal(phi, side)) for side in (-1, 1))
        angle = math.atan2(float(cross(before, after)), float(dot(before, after)))
        spoke = self.R * before * turned_back(angle * np.asarray(part), -1)
        return self.pitch(phi) - spoke, -1j * angle * spoke

    @cached_property
    def sharpest(self) -> Extreme:
        """The least radius of curvature of the convex pitch curve, and where: zero where it has a corner."""
        if self.motion.drops:
            return Extreme(0.0, self.motion.drops[0])
        bent = least(lambda phi, side: -self.curvature(phi, side), self.motion.corners)
        return Extreme(-1.0 / bent.value if bent.value < 0.0 else math.inf, bent.phi)


@dataclass(frozen=True)
class PlateProfile(Envelope):
    """The profile of a cam for a flat plate whose lowest height above the centre is r_0."""

    motion: Motion
    r_0: float
    sense: int = 1

    def centre(self, phi: Any) -> Points:
        """Return the plate's centre, on its axis."""
        return 1j * (self.r_0 + self.motion.at(phi)[0]) * turned_back(phi, self.sense)

    def practical(self, phi: Any, side: int = 1) -> Points:
        """Return points of the profile: where the plate touches it."""
        s, ds, _ = self.motion.at(phi, side)
        return (self.sense * ds + 1j * (self.r_0 + s)) * turned_back(phi, self.sense)

    def tangent(self, phi: Any, side: int = 1) -> Points:
        """Return the derivative of `practical`."""
        return self.sense * self.bend(phi, side) * turned_back(phi, self.sense)

    def bend(self, phi: Any, side: int = 1) -> Array:
        """Return the radius of curvature r_0 + s + s'', m, negative where the envelope runs backwards."""
        s, _, d2s = self.motion.at(phi, side)
        return self.r_0 + s + d2s

    def depth(self, points: Any, phi: Any) -> Array:
        """Return how far points of the cam are above the plate, m."""
        return self.seat(points, phi) - self.motion.at(phi)[0]

    def seat(self, corner: Any, phi: Any) -> Array:
        """Return the travel at which the plate rests on a corner of the cam."""
        travel: Array = (corner * np.conj(turned_back(phi, self.sense))).imag - self.r_0
        return travel

    def across(self, phi: float, part: Any) -> tuple[Points, Points]:
        """Return the flat of the profile on which the plate lies where the velocity jumps up."""
        begin, end = self.practical(phi, -1), self.practical(phi, 1)
        along = (end - begin) * np.ones_like(part, float)
        return begin + along * part, along

    @cached_property
    def sharpest(self) -> Extreme:
        """The least radius of curvature, m, and where; negative where the profile is undercut."""
        found, drops = self.motion.minimum(1.0, 0.0, 1.0), self.motion.drops
        return Extreme(-math.inf, drops[0]) if drops else Extreme(self.r_0 + found.value, found.phi)


def turned_back(phi: Any, sense: int) -> Points:
    """Return exp(-i sense phi): what turns a vector of the frame onto the cam that stands still."""
    turn: Points = np.cos(phi) - 1j * (sense * np.sin(phi))
    return turn


@dataclass(frozen=True, slots=True, kw_only=True)
class RollerCam:
    """A cam for a follower with a roller: its profile, the limits of the pressure angle.

    Of a roller on a line the sizes where the limit tangents meet, and the least and the greatest offset that a given
    r_0 permits. `permitted` is the least r_0 at the offset, or at the l_OC, that is given together with r_0, and the
    greatest; None where they are not.
    """

    profile: RollerProfile
    limits: Limits
    by_tangents: Sizes = NOWHERE
    offsets: Range | None = None
    permitted: Range | None = None

    @property
    def sizes(self) -> Sizes:
        """The sizes of the cam."""
        return self.profile.sizes

    def givens(self, division: Division) -> dict[str, float]:
        """Return what the board begins with: curvature, transmission angles, what is the follower's own."""
        follower, numbers = self.profile.follower, {}
        for phase in (RISE, FALL):
            lowest = follower.least_transmission(self.sizes, phase, self.limits.two_sided).value
            numbers[f"_gamma_{phase}_least"] = min(lowest, RIGHT_ANGLE)  # more: pressed to the other side alone
        return follower.givens(self, division) | numbers | {"_rho_part": self.profile.rho_min / follower.unit}


@dataclass(frozen=True, slots=True, kw_only=True)
class PlateCam:
    """A cam for a plate."""

    sizes: PlateSizes
    profile: PlateProfile
    given: bool = False  # whether r_0 is given

    @property
    def part(self) -> float:
        """Half of the plate as a part of the stroke."""
        return self.sizes.R_plate / self.profile.motion.h

    def givens(self, division: Division) -> dict[str, float]:
        """Return the least radius as a part of the stroke."""
        return {"_r_0_flat_part": self.sizes.r_0_min / self.profile.motion.h}
