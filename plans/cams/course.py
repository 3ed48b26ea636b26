"""The course of a cam over its turn: column by column, and as dense curves of its figures beside their marks.

Columns are motion, pressure angle, points and curvature of the profiles. Points are those of the cam as it stands at
phi = 0, its centre at the origin, the follower's line upwards.

Figures show exact curves piece by piece, limits, places of the profiles: points are complex numbers, m, from the origin
of the plan that shows them; what is drawn as a mark is read as one.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import partial
from itertools import pairwise
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from ..solved import AT, Columned, Course, Ends, Pieces, Rows
from .followers import RIGHT_ANGLE, Limit, Range, Rocker, RollerCam, RollerProfile, Sizes, turned_back
from .motion import FALL, RISE, TURN, Array, Motion, Phase, least
from .sizes import HalfPlane, slacks
from .solve import SolvedCam

PSI = "psi."  # begins the names of numbers of the motion of a rocker
STROKES = ("h", "l_rocker")  # what the stroke is proportional to: that of a rocker is the arc of its roller
NEAR = 1e-9  # rad, from a section line, where a jump is on it
FINE = np.radians(0.5)  # between points of a curve
CUT, MANY = math.radians(0.02), 400  # between points of a profile to be cut; cells of its arcs
TABLED = ("phi", "s", "ds", "d2s", "v", "a", "psi", "theta", "gamma", "theta_rocker", "gamma_rocker")
SAME, IN_DWELL = 1e-9, 0.25  # part of a radius; of the lower dwell, at which the radius of its arc is shown


@dataclass(frozen=True, slots=True)
class _ReadMotion:
    """A motion at a place, read from the numbers of its piece; of another stroke it is so many times as large."""

    motion: Motion
    given: Callable[[str], Any]
    times: Any

    def at(self, phi: Any, side: int = 1) -> tuple[Any, Any, Any]:
        """Return s, ds/dphi, d2s/dphi2."""
        s, ds, d2s = self.motion.read(self.given(AT), self.given)
        return s * self.times, ds * self.times, d2s * self.times


class _Read:
    """A cam at a place: what its motion, and that of a rocker, is read from is given, and so are changeable sizes."""

    def __init__(self, solved: SolvedCam, given: Callable[[str], Any], changeable: Mapping[str, float]) -> None:
        of = {name: given(name) for name in changeable}
        times = {name: of[name] / changeable[name] for name in STROKES if name in of}
        self.omega = of.get("omega", solved.givens["omega"])
        self.motion = cast("Motion", _ReadMotion(solved.motion, given, math.prod(times.values())))
        self.rolling, self.plate = solved.rolling, solved.plate
        if self.rolling is not None:
            profile, own = self.rolling.profile, self.motion
            follower = profile.follower
            if isinstance(follower, Rocker):
                read = partial(_ReadMotion, profile.motion, lambda name: given(name if name == AT else PSI + name))
                own, follower = cast("Motion", read(1.0)), replace(follower, l=of.get("l_rocker", follower.l))
            sizes, R = _sizes(profile, of), of.get("R_roller", profile.R)
            profile = replace(profile, follower=replace(follower, motion=own), sizes=sizes, R=R)
            self.rolling = replace(self.rolling, profile=profile)
        if self.plate is not None:
            plate = self.plate.profile
            plate = replace(plate, motion=self.motion, r_0=of.get("r_0_flat", plate.r_0))
            self.plate = replace(self.plate, profile=plate)


def _sizes(profile: RollerProfile, of: Mapping[str, Any]) -> Sizes:
    """Return the sizes of a cam with a roller, of which others may be given."""
    if "r_0" not in of:
        return profile.sizes
    r_0, e = of["r_0"], of.get("e")
    if e is None:  # pivot, centre and the roller in its lowest place are a triangle of l, r_0 and l_OC
        l, l_OC = of["l_rocker"], of["l_OC"]
        e = (l * l + r_0 * r_0 - l_OC * l_OC) / (2.0 * l)
    return replace(profile.sizes, r_0=r_0, e=e, s_0=np.sqrt(r_0 * r_0 - e * e))


class CamCourse(Course):
    """A cam over its turn, which places divide evenly."""

    usual = 360  # one place a degree

    def __init__(self, solved: SolvedCam) -> None:
        self.solved, self.motion, self.rolling = solved, solved.motion, solved.rolling
        self.of = "_rocker" * (solved.rocker is not None)  # ends the names of what rollers on lines have, too

    def places(self, count: int) -> Array:
        """Return so many angles of the cam."""
        return np.asarray(TURN * (np.arange(count) / count))

    def columns(self, places: Any, side: int = 1) -> list[Columned]:
        """Return the columns at angles of the cam, rad; where something jumps, the limits from one side."""
        return [Columned(*column) for column in self._table(np.asarray(places, float), self.solved, side)]

    def _table(self, phi: Any, cam: SolvedCam | _Read, side: int = 1) -> list[tuple[str, str, Any]]:
        """Return names, units and values of the columns."""

        def points(name: str, places: Any) -> list[tuple[str, str, Any]]:
            return [(f"{name}.x", "m", places.real), (f"{name}.y", "m", places.imag)]

        omega = cam.omega if isinstance(cam, _Read) else self.solved.givens["omega"]
        s, ds, d2s = cam.motion.at(phi, side)
        table = [("phi", "rad", phi), ("t", "s", phi / omega), ("s", "m", s), ("ds", "m", ds), ("d2s", "m", d2s)]
        table += [("v", "m/s", omega * ds), ("a", "m/s^2", omega * omega * d2s)]
        if cam.rolling is not None:
            of, profile = self.of, cam.rolling.profile
            if of:
                table.append(("psi", "rad", profile.motion.at(phi, side)[0]))
            pressure = profile.pressure(phi, side)
            with np.errstate(divide="ignore"):
                rho = 1.0 / profile.curvature(phi, side)
            table += [(f"theta{of}", "rad", pressure), (f"gamma{of}", "rad", RIGHT_ANGLE - np.abs(pressure))]
            table += [*points(f"pitch{of}", profile.pitch(phi, side)), (f"rho_pitch{of}", "m", rho)]
            table += [*points(f"profile{of}", profile.practical(phi, side)), (f"rho{of}", "m", rho - profile.R)]
        if cam.plate is not None:
            plate = cam.plate.profile
            table += [*points("profile_plate", plate.practical(phi, side)), ("rho_plate", "m", plate.bend(phi, side))]
        return table

    def formulas(self, given: Callable[[str], Any]) -> dict[str, Any]:
        """Return the columns, and points of cams and followers as they stand, and of followers about a cam that does.

        `turn` is the direction of the cam, `up` and `across` are those of the follower about the cam that stands still.
        """
        phi, sense = given("phi"), self.solved.cam.sense
        cam = _Read(self.solved, given, self.changeable)
        found = {name: value for name, _, value in self._table(phi, cam)}
        turn, back = turned_back(phi, -sense), turned_back(phi, sense)
        found |= {"turn": turn, "up": back * 1j, "across": back * 1.0}
        if cam.rolling is not None:
            rolling = cam.rolling.profile
            found |= {"roller.B": rolling.follower.centre(rolling.sizes, phi)[0], "inverted.B": rolling.pitch(phi)}
            found |= {"roller.K": rolling.practical(phi) * turn, "roller.n": rolling.normal(phi) * turn}
            found |= {"limit.undercut": rolling.bend(phi), "roller.0": rolling.sizes.e + rolling.sizes.s_0 * 1j}
            if isinstance(rolling.follower, Rocker):
                pivot = rolling.follower.pivot(rolling.sizes)
                found |= {"rocker.C": pivot, "inverted.A": pivot * back}
        if cam.plate is not None:
            plate = cam.plate.profile
            found["limit.undercut_plate"] = plate.bend(phi)
            found |= {"plate.B": (plate.r_0 + found["s"]) * 1j, "inverted_plate.B": plate.centre(phi)}
            found["plate.K"] = plate.practical(phi) * turn
        return found

    @property
    def changeable(self) -> Mapping[str, float]:
        """The stroke, the speed and the sizes, where the profiles are what the roller and the plate envelop.

        Laws and lengths of the phases are none of them: they are other pieces.
        """
        profiles = self.solved.profiles
        if self.motion.velocity_jumps or any(profile.undercuts for _, _, profile in profiles):
            return {}
        found = {name: float(self.solved.givens[name]) for name in (*STROKES, "omega") if name in self.solved.givens}
        if self.rolling is not None:
            profile = self.rolling.profile
            sizes, follower = profile.sizes, profile.follower
            found |= {"R_roller": profile.R, "r_0": sizes.r_0}
            found |= {"l_OC": abs(follower.pivot(sizes))} if isinstance(follower, Rocker) else {"e": sizes.e}
        if self.solved.plate is not None:
            found["r_0_flat"] = self.solved.plate.profile.r_0
        return found

    def pieces(self) -> Pieces:
        """Return the smooth pieces of the motion, of a rocker with those of its angle, which begin where they do."""
        starts, names, rows = self.motion.written
        if self.solved.rocker is None:
            return Pieces(starts, names, rows)
        _, own, angles = self.solved.rocker.profile.motion.written
        return Pieces(starts, [*names, *(PSI + name for name in own)], np.column_stack((rows, angles)))

    def rows(self, count: int | None) -> Rows:
        """Return the motion at so many places, without a number on the section lines, with both limits at jumps."""
        if count is not None:
            heads, columns = super().rows(count)
        else:
            lines = []  # number, angle, side
            for number, phi in enumerate(self.solved.angles.tolist()):
                jumps = number > 0 and any(abs(jump.phi - phi) < NEAR for jump in self.motion.jumps)
                lines += [(str(number), phi, side) for side in ((-1, 1) if jumps else (1,))]
            names, angles, sides = zip(*lines, strict=True)
            heads, after = list(names), np.array(sides) > 0
            before_and_after = zip(*(self.columns(angles, side) for side in (-1, 1)), strict=True)
            columns = [Columned(b.name, b.unit, np.where(after, b.values, a.values)) for a, b in before_and_after]
        return heads, [column for column in columns if column.name in TABLED]

    def extremes(self) -> list[Ends]:
        """Return the extremes of travel, velocity, acceleration and pressure angles; at jumps both limits count."""
        motion, omega, ends = self.motion, self.solved.givens["omega"], []
        rates = ("s", "m", (1.0, 0.0, 0.0)), ("v", "m/s", (0.0, omega, 0.0)), ("a", "m/s^2", (0.0, 0.0, omega * omega))
        for name, unit, parts in rates:
            most, lowest = motion.maximum(*parts), motion.minimum(*parts)
            ends.append(Ends(name, unit, most.value, most.phi, lowest.value + 0.0, lowest.phi))
        if self.rolling is not None:
            pressure = self.rolling.profile.pressure
            low, high = least(pressure, motion.corners), least(lambda phi, side: -pressure(phi, side), motion.corners)
            ends.append(Ends(f"theta{self.of}", "rad", -high.value, high.phi, low.value, low.phi))
        return ends

    def remarks(self) -> Iterator[tuple[str, Mapping[str, Any]]]:
        """Say where profiles are curved most."""
        for curve, _, profile in self.solved.profiles:
            sharpest = profile.sharpest
            yield f"sweep.sharpest.{curve}", {"rho": (sharpest.value, "m"), "at": (sharpest.phi, "rad")}

    def states(self, places: Any) -> dict[str, list[str]]:
        """Return at which places a follower rests on a corner of an undercut profile, which followers, joined by +."""
        cuts = [(follower, cut) for _, follower, profile in self.solved.profiles for cut in profile.undercuts]
        states = []
        for at in places.tolist():
            resting = dict.fromkeys(name for name, cut in cuts if (at - cut.start) % TURN < cut.end - cut.start)
            states.append(f"undercut: {'+'.join(resting)}" if resting else "ok")
        return {"status": states}

    def data(self, places: Any) -> dict[str, Any]:
        """Return the least radii of curvature, jumps and what an undercut profile loses."""
        every = self.solved.profiles
        return {
            "rho_min": {curve: {"value": p.sharpest.value, "at": p.sharpest.phi} for curve, _, p in every},
            "jumps": [
                {"at": jump.phi, "of": "ds" if jump.order == 1 else "d2s", "before": jump.before, "after": jump.after}
                for jump in self.motion.jumps
            ],
            "undercut": [
                {"follower": follower, "from": cut.start, "to": cut.end, "lost": cut.lost, "at": cut.phi_lost}
                for _, follower, profile in every
                for cut in profile.undercuts
            ],
        }

    def outlines(self) -> dict[str, NDArray[Any]]:
        """Return the profiles as they are cut, as the cam stands at phi = 0."""
        every = self.solved.profiles
        return {f"profile_{follower}": profile.outline(CUT, MANY) for _, follower, profile in every}


# Dense curves.


def _over(function: Callable[[Any, int], Any], *phases: Phase) -> list[tuple[Array, NDArray[Any]]]:
    """Return the smooth pieces of a function over phases, densely: places phi and values, along the last axis.

    The function is one of places and a side; at the last place of a piece stands the limit from before it.
    """
    pieces = []
    for low, high in (ends for phase in phases for ends in pairwise(phase.corners)):
        phi = np.linspace(low, high, max(2, int(np.ceil((high - low) / FINE))) + 1)
        values = np.array(function(phi, 1))
        values[..., -1:] = function(phi[-1:], -1)
        pieces.append((phi, values))
    return pieces


def diagram(solved: SolvedCam, order: int, *phases: Phase) -> list[list[Range]]:
    """Return the smooth pieces of s or of a derivative of it, as places phi, ordinate."""
    return [np.column_stack((phi, curves[order])).tolist() for phi, curves in _over(solved.motion.at, *phases)]


def over_acceleration(solved: SolvedCam, phase: Phase) -> list[list[complex]]:
    """Return the smooth pieces of S over d2s/dphi2."""
    return [(d2s + 1j * s).tolist() for _, (s, _, d2s) in _over(solved.motion.at, phase)]


def courses(solved: SolvedCam) -> list[list[Range]]:
    """Return the smooth pieces of theta over phi, with the limits at both their ends, as places phi, theta."""
    pieces = _over(_rolling(solved).profile.pressure, *solved.motion.phases[:3])
    return [np.column_stack(piece).tolist() for piece in pieces]


def analogues(solved: SolvedCam, phase: str) -> list[complex]:
    """Return S over ds/dphi in a phase, of a rocker the ends of the analogues laid off along it."""
    follower = _rolling(solved).profile.follower
    return [place for _, piece in _over(follower.analogue, follower.motion.phase(phase)) for place in piece.tolist()]


def analogue(solved: SolvedCam, line: int, phase: str = "") -> complex:
    """Return the end of the analogue on a section line; of one that jumps there that inside of a phase, if any."""
    side = -1 if phase and line > solved.layout.division.of(phase)[0] else 1
    return complex(_rolling(solved).profile.follower.analogue(float(solved.angles[line]), side))


def _rolling(solved: SolvedCam) -> RollerCam:
    assert solved.rolling is not None
    return solved.rolling


# Limits, and places that they permit.


def touch_of(solved: SolvedCam, plane: HalfPlane) -> complex:
    """Return where a limit touches S over ds/dphi: at a jump the side that reaches farther."""
    follower = _rolling(solved).profile.follower
    ends = (complex(follower.analogue(plane.phi, side)) for side in (1, -1))
    return max(ends, key=lambda end: (-plane.normal.conjugate() * end).real)


def touch_of_plate(solved: SolvedCam) -> complex:
    """Return where the tangent at 45 degrees touches S over d2s/dphi2: at a jump the side that reaches farther."""
    assert solved.plate is not None
    ends = ([float(value) for value in solved.motion.at(solved.plate.sizes.phi, side)] for side in (1, -1))
    s, _, d2s = min(ends, key=lambda at: at[0] + at[2])
    return complex(d2s, s)


def outwards(solved: SolvedCam, line: int, phase: str) -> complex:
    """Return the normal of S over ds/dphi on a section line, out of its loop; where it turns, the sum of both."""
    of_phase, sense, motion = solved.layout.division.of(phase), solved.cam.sense, solved.motion
    normal = 0j
    for side in (1,) if line == of_phase[0] else (-1,) if line == of_phase[-1] else (1, -1):
        s, ds, d2s = (float(v) for v in motion.at(float(solved.angles[line]), side))
        along = complex(-sense * d2s, ds)
        level = 1j * math.copysign(1.0, s - 0.5 * motion.h)
        normal += 1j * sense * along / abs(along) if along else level
    return normal


def permitted(solved: SolvedCam) -> list[tuple[str, float]]:
    """Return the phases with what theta must not pass in them, rad."""
    limits = sorted(_rolling(solved).limits.each, key=lambda limit: limit.phase != RISE)
    return [(limit.phase, limit.way * solved.cam.sense * (RIGHT_ANGLE - limit.gamma)) for limit in limits]


def pressed(solved: SolvedCam, part: float) -> int:
    """Return the section line at which the pressure angle is nearest to a part of the greatest one.

    It is a line within the phase in which the cam presses more aslant, where the angle is best seen.
    """
    division, profile = solved.layout.division, _rolling(solved).profile
    phases = (division.rise[1:-1], 1), (division.fall[1:-1], -1)
    pressed = [(way * solved.cam.sense * profile.pressure(solved.angles[[*lines]]), lines) for lines, way in phases]
    angles, lines = max(pressed, key=lambda phase: float(np.max(phase[0])))
    return int(lines[int(np.argmin(np.abs(angles - part * np.max(angles))))])


def _rocker(solved: SolvedCam) -> Rocker:
    """Return the rocker that follows a cam."""
    rocker = _rolling(solved).profile.follower
    assert isinstance(rocker, Rocker)
    return rocker


def limit_direction(solved: SolvedCam, line: int, phase: str) -> complex:
    """Return the direction of the limit on a section line, downwards."""
    limit = _rolling(solved).limits.each[phase == FALL]
    return _limit_along(complex(solved.values[f"_arm{line}"]), limit, solved.cam.sense)


def _limit_along(arm: complex, limit: Limit, sense: int) -> complex:
    """Return the direction of a limit that goes with that of the rocker, the way that points down."""
    direction = arm * cmath.rect(1.0, -limit.way * sense * limit.gamma)
    return direction if direction.imag < 0.0 else -direction


def bounds(solved: SolvedCam) -> Iterator[tuple[Limit, complex, complex, complex]]:
    """Go through the limits, each where it comes nearest to the cam's centre.

    With each go the end of the analogue there, m, and the directions of the rocker and of the limit.
    """
    rocker, cam = _rocker(solved), _rolling(solved)
    for limit in cam.limits.each:
        at = min(slacks(rocker, limit, complex(cam.sizes.e, cam.sizes.s_0)), key=lambda slack: slack.value).phi
        side = 1 if at < rocker.motion.phase(limit.phase).end else -1
        arm = cmath.rect(1.0, float(rocker.motion.at(at, side)[0]))
        yield limit, complex(rocker.analogue(at, side)), arm, _limit_along(arm, limit, rocker.sense)


def half_planes(solved: SolvedCam) -> Iterator[tuple[complex, float]]:
    """Go through the half planes in which the cam's centre may lie, the rocker's pivot being the origin.

    Each is the unit normal into it and its least component, m.
    """
    rocker = _rocker(solved)
    motion = rocker.motion
    yield -1j, 0.0  # below the rocker's lowest position, and its highest one
    yield -1j * cmath.rect(1.0, motion.h), 0.0
    for limit in _rolling(solved).limits.each:
        for _, planes in _over(partial(rocker.half_planes, limit), motion.phase(limit.phase)):
            for normal, lowest in planes.T.tolist():
                yield -normal, lowest.real - normal.real * rocker.l


def turning(solved: SolvedCam, line: int) -> float:
    """Return how fast a rocker turns on a section line beside the cam, dpsi/dphi, with the sense of the cam."""
    return float(_rocker(solved).motion.at(float(solved.angles[line]))[1]) * solved.cam.sense


# The cam that stands still.


def up_at(solved: SolvedCam, line: int, turned: float = 0.0) -> complex:
    """Return the direction of the follower's axis, rad past a section line, on the cam that stands still."""
    return _up_at(float(solved.angles[line]) + turned, solved.cam.sense)


def _up_at(phi: float, sense: int) -> complex:
    return cmath.rect(1.0, RIGHT_ANGLE - sense * phi)


def on_circle(e: float, radius: float, up: complex) -> complex:
    """Return where the follower's line along `up`, at the offset e, meets a circle about the cam's centre."""
    return up * complex(math.sqrt(max(radius * radius - e * e, 0.0)), -e)


def rests(motion: Motion) -> bool:
    """Whether the lower dwell is the longer one: then there is room beside the follower in its lowest position."""
    return motion.lower.lasts and motion.lower.length >= motion.upper.length


def dwelling(solved: SolvedCam) -> float:
    """Return the direction in the middle of the longer dwell, or of the rise where there is none, rad."""
    motion = solved.motion
    longer = motion.lower if rests(motion) or not motion.upper.lasts else motion.upper
    low, high = (longer.start, longer.end) if longer.lasts else (0.0, motion.rise.end)
    return cmath.phase(_up_at(0.5 * (low + high), solved.cam.sense))


def offset_places(solved: SolvedCam) -> tuple[complex, ...]:
    """Return the cam's centre at the least and the greatest offset that a given r_0 permits, and at the chosen one."""
    roller = solved.roller
    if roller is None or roller.offsets is None:
        return ()
    radius = roller.sizes.r_0
    angles = (-math.asin(e / radius) - RIGHT_ANGLE for e in (*roller.offsets, roller.sizes.e))
    return tuple(cmath.rect(radius, angle) for angle in angles)


def sharpest_place(solved: SolvedCam) -> tuple[complex, complex, complex, bool] | None:
    """Return where a pitch curve is curved most, None where it is convex nowhere.

    Those are the place, the outward normal, the centre of curvature, and whether every place of an arc is as sharp.
    """
    profile, lower = _rolling(solved).profile, solved.motion.lower
    rho, at = profile.sharpest.value, profile.sharpest.phi
    if not 0.0 < rho < math.inf:
        return None
    arc = lower.lasts and abs(rho * float(profile.curvature(lower.end, -1)) - 1.0) < SAME
    phi = lower.start + IN_DWELL * lower.length if arc else at
    kappa = [float(profile.curvature(phi, side)) for side in (1, -1)]
    side = 1 if kappa[0] >= kappa[1] else -1
    place, normal = complex(profile.pitch(phi, side)), complex(profile.normal(phi, side))
    return place, normal, place - normal * rho, phi != at
