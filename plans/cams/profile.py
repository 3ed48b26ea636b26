"""Profiles of cams by inversion: the pitch curve of a roller, its practical profile, and the profile under a plate.

All points are complex numbers, m, in the frame of the cam as it stands at phi = 0: the centre at the origin, the
follower above it. In that frame the follower goes round against the sense of the cam, by exp(-i sense phi).

A roller's centre q(phi), seen from the frame, moves on the cam with the velocity w = q' - i sense q; the derivative of
that is q'' - 2 i sense q' - q. Its curvature is positive where the pitch curve is convex. The practical profile is
parallel to the pitch curve, R inside. A plate at the height r_0 + s touches its profile under the instant centre,
sense * s' beside its axis, where the radius of curvature is r_0 + s + s''.

Source: Artobolevsky, Theory of mechanisms and machines (inversion of motion).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from ..laws import cross, dot
from .envelopes import Array, Envelope, Points
from .motion import Extreme, Motion, least
from .sizes import RockerSizes, RollerSizes

OF_R_0, OF_RHO_MIN = 0.4, 0.7  # the roller's radius is at most these parts of r_0 and of the pitch curve's rho_min


@dataclass(frozen=True, slots=True)
class StraightPath:
    """The roller of a follower that moves up along a line at the offset e to the right of the cam's centre."""

    motion: Motion
    sizes: RollerSizes

    def centre(self, phi: Any, side: int = 1) -> tuple[Points, Points, Points]:
        """Return q, q', q''."""
        s, ds, d2s = self.motion.at(phi, side)
        return self.sizes.e + 1j * (self.sizes.s_0 + s), 1j * ds, 1j * d2s

    def seat(self, corner: Points, R: float) -> Array:
        """Return the travel at which a roller of radius R rests on points of the frame; NaN where it passes them."""
        beside = corner.real - self.sizes.e
        with np.errstate(invalid="ignore"):
            height: Array = corner.imag + np.sqrt(R * R - beside * beside) - self.sizes.s_0
        return height

    def pressure(self, sense: int, phi: Any, side: int = 1) -> Array:
        """Return the pressure angle theta, rad."""
        s, ds, _ = self.motion.at(phi, side)
        theta: Array = np.arctan2(sense * ds - self.sizes.e, self.sizes.s_0 + s)
        return theta


@dataclass(frozen=True, slots=True)
class RockerPath:
    """The path of a rocker's roller."""

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

    def pressure(self, sense: int, phi: Any, side: int = 1) -> Array:
        """Return the pressure angle, rad: from the roller's velocity in the rise to the normal, its sign as usual."""
        psi, dpsi, _ = self.motion.at(phi, side)
        cosine, sine = np.cos(psi), np.sin(psi)
        x, y = self.pivot.real, self.pivot.imag
        across = self.sizes.l * (sense * dpsi - 1.0) - (x * cosine + y * sine)
        theta: Array = np.arctan2(across, y * cosine - x * sine)
        return theta


@dataclass(frozen=True)
class RollerProfile(Envelope):
    """The profile of a cam for a roller of the radius R that moves along a path; `sense` +1 counter-clockwise.

    The `centre` of a path is q, q', q'' of the roller's centre, seen from the cam's centre, m.
    """

    path: StraightPath | RockerPath
    R: float
    sense: int = 1
    motion: Motion = field(init=False)

    def __post_init__(self) -> None:
        """Take the motion of the path."""
        object.__setattr__(self, "motion", self.path.motion)

    def pressure(self, phi: Any, side: int = 1) -> Array:
        """Return the pressure angle theta, rad, at the angles `phi` of the cam; where s' jumps, a limit."""
        return self.path.pressure(self.sense, phi, side)

    def pitch(self, phi: Any, side: int = 1) -> Points:
        """Return points of the pitch curve."""
        return self.path.centre(phi, side)[0] * turned_back(phi, self.sense)

    def _velocity(self, phi: Any, side: int) -> tuple[Points, Points]:
        """Return the first and second derivative of the pitch curve, as seen in the frame."""
        q, dq, d2q = self.path.centre(phi, side)
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

    def depth(self, points: Any, phi: Any) -> Array:
        """Return how deep points of the cam are inside the roller, m."""
        depth: Array = self.R - np.abs(points - self.pitch(phi))
        return depth

    def seat(self, corner: complex, phi: Any) -> Array:
        """Return the travel at which the roller rests on a corner of the cam."""
        return self.path.seat(corner * np.conj(turned_back(phi, self.sense)), self.R)

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
        rho: Array = self.r_0 + s + d2s
        return rho

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
    angle = np.asarray(phi, float)
    turn: Points = np.cos(angle) - 1j * (sense * np.sin(angle))
    return turn
