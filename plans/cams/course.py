"""The course of a cam over its turn, column by column: motion, pressure angle, points and curvature of the profiles.

Points are those of the cam as it stands at phi = 0, its centre at the origin, the follower's line upwards.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..solved import Columned, Ends
from .cam import PLATE, ROCKER, ROLLER
from .envelopes import Undercut
from .motion import TURN, Array, Jump
from .places import Function, Minimum, minima
from .profile import PlateProfile, RollerProfile
from .rocker import rocker_pressure
from .sizes import pressure_angle
from .solve import SolvedCam


@dataclass(frozen=True, slots=True)
class Sharpest:
    """The least radius of curvature of a curve, m, and where."""

    curve: str
    rho: float
    phi: float


def columns(solved: SolvedCam, phi: Any, side: int = 1) -> list[Columned]:
    """Return the columns at the angles `phi` of the cam, rad; where something jumps, the limits from one side."""
    phi = np.asarray(phi, float)
    omega = solved.givens["omega"]
    found = [Columned("phi", "rad", phi), Columned("t", "s", phi / omega), *_motion(solved, phi, side, omega)]
    rolling, theta = solved.roller or solved.rocker, pressure_of(solved)
    if rolling is not None and theta is not None:
        of = "_rocker" * (solved.rocker is not None)
        found += _angles(of, theta(phi, side)) + _of_roller(of, rolling.profile, phi, side)
    if solved.plate is not None:
        plate = solved.plate.profile
        found += _point("profile_plate", plate.practical(phi, side))
        found.append(Columned("rho_plate", "m", np.asarray(plate.bend(phi, side))))
    return found


def _motion(solved: SolvedCam, phi: Array, side: int, omega: float) -> list[Columned]:
    s, ds, d2s = solved.motion.at(phi, side)
    found = [Columned("s", "m", s), Columned("ds", "m", ds), Columned("d2s", "m", d2s)]
    found += [Columned("v", "m/s", omega * ds), Columned("a", "m/s^2", omega * omega * d2s)]
    if solved.rocker is not None:
        found.append(Columned("psi", "rad", solved.rocker.rocker.motion.at(phi, side)[0]))
    return found


def _angles(of: str, theta: Array) -> list[Columned]:
    return [Columned(f"theta{of}", "rad", theta), Columned(f"gamma{of}", "rad", 0.5 * math.pi - np.abs(theta))]


def _of_roller(of: str, profile: RollerProfile, phi: Array, side: int) -> list[Columned]:
    with np.errstate(divide="ignore"):
        rho = 1.0 / profile.curvature(phi, side)
    pitch = [*_point(f"pitch{of}", profile.pitch(phi, side)), Columned(f"rho_pitch{of}", "m", rho)]
    return [*pitch, *_point(f"profile{of}", profile.practical(phi, side)), Columned(f"rho{of}", "m", rho - profile.R)]


def _point(name: str, points: NDArray[Any]) -> list[Columned]:
    return [Columned(f"{name}.x", "m", points.real), Columned(f"{name}.y", "m", points.imag)]


def extremes(solved: SolvedCam) -> list[Ends]:
    """Return the extremes of travel, velocity, acceleration and pressure angles; at jumps both limits count."""
    motion, omega = solved.motion, solved.givens["omega"]
    weights = {
        ("s", "m"): (1.0, 0.0, 0.0),
        ("v", "m/s"): (0.0, omega, 0.0),
        ("a", "m/s^2"): (0.0, 0.0, omega * omega),
    }
    found = []
    for (name, unit), parts in weights.items():
        most, least = motion.maximum(*parts), motion.minimum(*parts)
        found.append(Ends(name, unit, most.value, most.phi, least.value + 0.0, least.phi))
    theta = pressure_of(solved)
    if theta is not None:
        low, high = (_least(theta, sign, motion.corners) for sign in (1.0, -1.0))
        name = "theta" if solved.rocker is None else "theta_rocker"
        found.append(Ends(name, "rad", -high.value, high.phi, low.value, low.phi))
    return found


def pressure_of(solved: SolvedCam) -> Function | None:
    """Return the pressure angle of the roller, rad, as a function of the angle and the side; None without a roller."""
    if solved.rocker is not None:
        rocker, at = solved.rocker.rocker, solved.rocker.sizes
        return lambda phi, side: np.asarray(rocker_pressure(rocker, at, phi, side))
    if solved.roller is not None:
        sizes, sense = solved.roller.sizes, solved.cam.sense
        return lambda phi, side: pressure_angle(solved.motion, sizes, phi, sense, side)
    return None


def _least(theta: Function, sign: float, corners: Sequence[float]) -> Minimum:
    found = minima(lambda phi, side: sign * theta(phi, side), corners)
    return min(found, key=lambda minimum: minimum.value)


def sharpest(solved: SolvedCam) -> list[Sharpest]:
    """Return where the pitch curves and the profile of a plate are curved most."""
    return [Sharpest(curve, profile.sharpest.value, profile.sharpest.phi) for curve, _, profile in profiles(solved)]


def undercuts(solved: SolvedCam) -> list[tuple[str, Undercut]]:
    """Return what profiles do not give of the motion, each with its follower."""
    return [(follower, cut) for _, follower, profile in profiles(solved) for cut in profile.undercuts]


def profiles(solved: SolvedCam) -> Iterator[tuple[str, str, RollerProfile | PlateProfile]]:
    """Go through the profiles: the curve whose curvature counts, the follower, the profile."""
    if solved.roller is not None:
        yield "pitch", ROLLER, solved.roller.profile
    if solved.rocker is not None:
        yield "pitch_rocker", ROCKER, solved.rocker.profile
    if solved.plate is not None:
        yield "profile_plate", PLATE, solved.plate.profile


def cut_at(solved: SolvedCam, phi: Array) -> list[str]:
    """Return for every angle the followers, joined by +, that rest on a corner of an undercut profile there."""
    found: list[list[str]] = [[] for _ in phi]
    for follower, cut in undercuts(solved):
        inside = np.mod(phi - cut.start, TURN) < cut.end - cut.start
        for i in np.flatnonzero(inside):
            if follower not in found[i]:
                found[i].append(follower)
    return ["+".join(followers) for followers in found]


def lines(solved: SolvedCam) -> list[tuple[int, float, int]]:
    """Return the section lines: number, angle, side; where velocity or acceleration jumps inside, one for each."""
    found = []
    for number, phi in enumerate(solved.angles.tolist()):
        jump = jump_at(solved, phi)
        first = number == 0
        sides = (1,) if first or jump is None else (-1, 1)
        found += [(number, phi, side) for side in sides]
    return found


def jump_at(solved: SolvedCam, phi: float) -> Jump | None:
    """Return the jump at an angle."""
    near = 1e-9
    return next((jump for jump in solved.motion.jumps if abs(jump.phi - phi) < near), None)
