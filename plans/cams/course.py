"""The course of a cam over its turn: column by column, and as dense curves of its figures beside their marks.

Columns are motion, pressure angle, points and curvature of the profiles. Points are those of the cam as it stands at
phi = 0, its centre at the origin, the follower's line upwards.

Figures show exact curves piece by piece, limits, places of the profiles: points are complex numbers, m, from the origin
of the plan that shows them; what is drawn as a mark is read as one.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..solved import Columned, Ends
from .cam import PLATE, ROCKER, ROLLER
from .construction import ROCKER_SIZES
from .envelopes import Undercut
from .followers import Limit, RockerCam, rocker_pressure, tightest
from .motion import FALL, RISE, TURN, Array, Function, Minimum, Motion, Phase, minima
from .profile import PlateProfile, RollerProfile
from .sizes import SIDES, HalfPlane, Limits, pressure_angle
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
        jumps = number > 0 and any(abs(jump.phi - phi) < NEAR for jump in solved.motion.jumps)
        found += [(number, phi, side) for side in ((-1, 1) if jumps else (1,))]
    return found


NEAR = 1e-9  # rad, from a section line, where a jump is on it
Side = tuple[complex, float]  # unit normal into an area, its least component
FINE = np.radians(0.5)  # between points of a curve
SAME, IN_DWELL = 1e-9, 0.25  # part of a radius; of the lower dwell, at which the radius of its arc is shown
UPRIGHT = 0.5 * math.pi


def pieces(solved: SolvedCam, phase: Phase) -> list[tuple[Array, Array, Array, Array]]:
    """Return the smooth pieces of a phase, densely: phi, s, s', s'' of each, with the limits at both its ends."""
    found = []
    for low, high in pairwise(phase.corners):
        phi = np.linspace(low, high, max(2, int(np.ceil((high - low) / FINE))) + 1)
        found.append((phi, *_from_before(solved.motion.at, phi)))
    return found


def _from_before(function: Callable[[Array, int], Any], phi: Array) -> Array:
    """Return the values of a function of places and a side, at the last place the limit from before it."""
    values = np.array(function(phi, 1))
    values[..., -1:] = function(phi[-1:], -1)
    return values


def diagram(solved: SolvedCam, order: int, phases: tuple[Phase, ...]) -> list[list[tuple[float, float]]]:
    """Return the smooth pieces of s or of a derivative of it, as places phi, ordinate."""
    every = (piece for phase in phases for piece in pieces(solved, phase))
    return [list(zip(piece[0].tolist(), piece[1 + order].tolist(), strict=True)) for piece in every]


def over_velocity(solved: SolvedCam, phase: Phase) -> list[complex]:
    """Return S over ds/dphi, to the side to which the cam's sense turns it."""
    found: list[complex] = []
    for _, s, ds, _ in pieces(solved, phase):
        found += (solved.cam.sense * ds + 1j * s).tolist()
    return found


def over_acceleration(solved: SolvedCam, phase: Phase) -> list[list[complex]]:
    """Return the smooth pieces of S over d2s/dphi2."""
    return [(d2s + 1j * s).tolist() for _, s, _, d2s in pieces(solved, phase)]


def touch_of(solved: SolvedCam, plane: HalfPlane) -> complex:
    """Return where a limit touches S over ds/dphi: at a jump the side that reaches farther."""
    sense, normal = solved.cam.sense, plane.normal
    ends = [[float(v) for v in solved.motion.at(np.array(plane.phi), side)] for side in (1, -1)]
    s, ds, _ = min(ends, key=lambda at: normal.real * sense * -at[1] + normal.imag * at[0])
    return complex(sense * ds, s)


def touch_of_plate(solved: SolvedCam) -> complex:
    """Return where the tangent at 45 degrees touches S over d2s/dphi2."""
    assert solved.plate is not None
    ends = [solved.motion.at(solved.plate.sizes.phi, side) for side in (1, -1)]
    s, _, d2s = min(ends, key=lambda at: float(at[0] + at[2]))
    return complex(float(d2s), float(s))


def outwards(solved: SolvedCam, line: int, phase: str) -> complex:
    """Return the normal of S over ds/dphi on a section line, out of its loop; where it turns, the sum of both."""
    division, sense, motion = solved.layout.division, solved.cam.sense, solved.motion
    lines = division.rise if phase == RISE else division.fall
    found = 0j
    for side in (1,) if line == lines[0] else (-1,) if line == lines[-1] else (1, -1):
        s, ds, d2s = (float(v) for v in motion.at(float(solved.angles[line]), side))
        along = complex(sense * d2s, ds)
        level = 1j * math.copysign(1.0, s - 0.5 * motion.h)
        found += -1j * sense * along / abs(along) if along else level
    return found


def analogue(solved: SolvedCam, line: int) -> complex:
    """Return the place of S over ds/dphi on a section line."""
    s, ds, _ = (float(v) for v in solved.motion.at(solved.angles[line]))
    return complex(solved.cam.sense * ds, s)


# The pressure angle.


def rolls(solved: SolvedCam) -> bool:
    """Whether a follower has a roller."""
    return solved.roller is not None or solved.rocker is not None


def rolling(solved: SolvedCam) -> tuple[RollerProfile, Limits]:
    """Return the profile for a roller, and the limits of its pressure angle."""
    cam = solved.roller or solved.rocker
    assert cam is not None
    return cam.profile, cam.limits


def theta(solved: SolvedCam, phi: Any, side: int = 1) -> Array:
    """Return the pressure angle, rad; where the velocity jumps, the limit from one side."""
    pressure = pressure_of(solved)
    assert pressure is not None
    return pressure(phi, side)


def transmission(pressure: float) -> float:
    """Return the transmission angle that goes with a pressure angle, rad."""
    return UPRIGHT - abs(pressure)


def courses(solved: SolvedCam) -> list[list[tuple[float, float]]]:
    """Return the smooth pieces of theta over phi, with the limits at both their ends."""
    found = []
    for phase in solved.motion.phases[:3]:
        for phi, *_ in pieces(solved, phase):
            values = _from_before(partial(theta, solved), phi)
            found.append(list(zip(phi.tolist(), values.tolist(), strict=True)))
    return found


def permitted(solved: SolvedCam) -> list[tuple[str, float]]:
    """Return the phases with what theta must not pass in them, rad."""
    _, limits = rolling(solved)
    gammas = {RISE: limits.gamma_rise, FALL: limits.gamma_fall}
    return [
        (phase, way * solved.cam.sense * (UPRIGHT - gamma))
        for phase, gamma in gammas.items()
        for way in SIDES[phase][: 1 + limits.two_sided]
    ]


def pressed(solved: SolvedCam, part: float) -> int:
    """Return the section line at which the pressure angle is nearest to a part of the greatest one.

    It is a line within the phase in which the cam presses more aslant, where the angle is best seen.
    """
    division = solved.layout.division
    phases = (division.rise[1:-1], 1), (division.fall[1:-1], -1)
    found = [(way * solved.cam.sense * theta(solved, solved.angles[[*lines]]), lines) for lines, way in phases]
    angles, lines = max(found, key=lambda phase: float(np.max(phase[0])))
    return int(lines[int(np.argmin(np.abs(angles - part * np.max(angles))))])


# A rocker about its pivot.


def rocker_of(solved: SolvedCam) -> RockerCam:
    """Return the cam for a rocker."""
    assert solved.rocker is not None
    return solved.rocker


def analogues(solved: SolvedCam, phase: Phase) -> list[complex]:
    """Return the ends of the analogues, laid off along the rocker; at the last angle of a piece the limit before it."""
    cam = rocker_of(solved)
    found: list[complex] = []
    for phi, *_ in pieces(solved, phase):
        psi, dpsi, _ = _from_before(cam.rocker.motion.at, phi)
        found += (cam.sizes.l * np.exp(1j * psi) * (1.0 - cam.rocker.sense * dpsi)).tolist()
    return found


def analogue_end(solved: SolvedCam, line: int, phase: str) -> complex:
    """Return the end of the analogue on a section line: where the velocity jumps, that inside of the phase."""
    division = solved.layout.division
    if line > (division.rise if phase == RISE else division.fall)[0]:
        return solved.point(f"{ROCKER_SIZES}.D{line}")
    ds = float(solved.motion.at(float(solved.angles[line]))[1])
    return solved.point(f"{ROCKER_SIZES}.B{line}") - complex(solved.values[f"_arm{line}"]) * (solved.cam.sense * ds)


def limit_direction(solved: SolvedCam, line: int, phase: str) -> complex:
    """Return the direction of the limit on a section line, downwards."""
    limits = rocker_of(solved).limits
    gamma = limits.gamma_rise if phase == RISE else -limits.gamma_fall
    return downwards(complex(solved.values[f"_arm{line}"]) * cmath.rect(1.0, -solved.cam.sense * gamma))


def downwards(direction: complex) -> complex:
    """Return a direction or the opposite one, that which points down."""
    return direction if direction.imag < 0.0 else -direction


@dataclass(frozen=True, slots=True)
class Bound:
    """A limit that comes nearest to the cam's centre: the end of the analogue, the rocker and the limit there."""

    limit: Limit
    end: complex
    arm: complex
    along: complex


def bounds(solved: SolvedCam) -> Iterator[Bound]:
    """Go through the limits, each where it comes nearest to the centre."""
    cam = rocker_of(solved)
    rocker = cam.rocker
    for limit in rocker.limits(cam.limits):
        at = tightest(rocker, limit, complex(cam.sizes.e, cam.sizes.s_0))
        psi, dpsi, _ = (float(v) for v in rocker.motion.at(at, 1 if at < limit.phase.end else -1))
        arm = cmath.rect(1.0, psi)
        along = downwards(arm * cmath.rect(1.0, -limit.way * rocker.sense * limit.gamma))
        yield Bound(limit, arm * (cam.sizes.l * (1.0 - rocker.sense * dpsi)), arm, along)


def half_planes(solved: SolvedCam) -> Iterator[Side]:
    """Go through the half planes in which the cam's centre may lie, the rocker's pivot being the origin."""
    cam = rocker_of(solved)
    yield -1j, 0.0  # below the rocker's lowest position, and its highest one
    yield -1j * cmath.rect(1.0, cam.rocker.motion.h), 0.0
    for limit in cam.rocker.limits(cam.limits):
        for phi, *_ in pieces(solved, limit.phase):
            for places, side in ((phi[:-1], 1), (phi[-1:], -1)):
                normal, least = cam.rocker.half_planes(limit, places, side)
                for n, c in zip(normal.tolist(), least.tolist(), strict=True):
                    yield -n, c - n.real * cam.sizes.l


def turning(solved: SolvedCam, line: int) -> float:
    """Return how fast a rocker turns on a section line beside the cam, dpsi/dphi, with the sense of the cam."""
    return float(rocker_of(solved).rocker.motion.at(float(solved.angles[line]))[1]) * solved.cam.sense


def pole_share(solved: SolvedCam, line: int) -> float:
    """Return which part of the way from the centre to the pivot the instant centre of cam and rocker is at."""
    dpsi = turning(solved, line)
    return dpsi / (dpsi - 1.0)  # the roller's velocity is that of the cam there


# The cam that stands still.


def up_at(phi: float, sense: int) -> complex:
    """Return the direction of the follower's axis in the position phi, on the cam that stands still."""
    return cmath.rect(1.0, UPRIGHT - sense * phi)


def on_circle(e: float, radius: float, up: complex) -> complex:
    """Return where the follower's line along `up`, at the offset e, meets a circle about the cam's centre."""
    return up * complex(math.sqrt(max(radius * radius - e * e, 0.0)), -e)


def rests(motion: Motion) -> bool:
    """Whether the lower dwell is the longer one: then there is room beside the follower in its lowest position."""
    return motion.lower.lasts and motion.lower.length >= motion.upper.length


def dwelling(motion: Motion, sense: int) -> float:
    """Return the direction in the middle of the longer dwell, or of the rise where there is none, rad."""
    longer = motion.lower if rests(motion) or not motion.upper.lasts else motion.upper
    low, high = (longer.start, longer.end) if longer.lasts else (0.0, motion.rise.end)
    return cmath.phase(up_at(0.5 * (low + high), sense))


def offset_places(solved: SolvedCam) -> tuple[complex, complex, complex] | None:
    """Return the cam's centre at the least and the greatest offset that a given r_0 permits, and at the chosen one."""
    roller = solved.roller
    if roller is None or roller.offsets is None:
        return None
    radius = roller.sizes.r_0
    angles = (math.asin(e / radius) - UPRIGHT for e in (roller.offsets.least, roller.offsets.most, roller.sizes.e))
    low, high, at = (cmath.rect(radius, angle) for angle in angles)
    return low, high, at


@dataclass(frozen=True, slots=True)
class SharpestPlace:
    """Where a pitch curve is curved most: the place, the outward normal, the centre of curvature.

    On an arc about the cam's centre, `arc`, every place is as sharp.
    """

    place: complex
    normal: complex
    core: complex
    arc: bool


def sharpest_place(solved: SolvedCam) -> SharpestPlace | None:
    """Return the place of the least radius of curvature of the pitch curve, where it is convex anywhere."""
    profile, lower = rolling(solved)[0], solved.motion.lower
    found = profile.sharpest
    if not 0.0 < found.value < math.inf:
        return None
    phi = found.phi
    if lower.lasts and abs(found.value * float(profile.curvature(lower.end, -1)) - 1.0) < SAME:
        phi = lower.start + IN_DWELL * lower.length
    kappa = [float(profile.curvature(phi, side)) for side in (1, -1)]
    side = 1 if kappa[0] >= kappa[1] else -1
    place, normal = complex(profile.pitch(phi, side)), complex(profile.normal(phi, side))
    return SharpestPlace(place, normal, place - normal * found.value, phi != found.phi)


def pitch_curve(solved: SolvedCam) -> tuple[complex, ...]:
    """Return the pitch curve of a cam for a roller, closed without a repeated point."""
    return tuple(rolling(solved)[0].pitch(solved.motion.samples()[:-1]).tolist())
