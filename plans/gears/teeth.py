"""The teeth of a gear pair: the profile of a tooth as a rack cuts it, how the two wheels mesh, and both on paper.

All points are complex numbers, m. Of a tooth the wheel's centre is the origin and its centre line the real axis. Only
the upper flank is computed, the lower one is its mirror image. A point of the involute is known by its radius of
curvature rho, the length of the line that touches the base circle. A point of the fillet is known by the angle beta at
which the rack's corner is there inclined to the wheel's radius: a right angle at the root, alpha at the flank.

While the rack moves, the contact normal always passes the pole, so the corner's centre is h_0 cot(beta) beside the pole
and h_0 below it when its arc touches the tooth at beta. The distance from the wheel's centre grows steadily
from the root to the flank. Where the straight edge reaches below the end N of the line of action, rho_l is negative and
the corner cuts away the involute's beginning: the flank then begins where both curves cross.

Of a pair the pole is the origin, the line of centres the imaginary axis, the pinion below. A contact is known by rho_1,
its distance from N1 along N1N2: the radius of curvature of the pinion's flank there. Angles of the pinion count from
the contact at the pole in the sense in which it turns, so rho_1 grows by r_b1 times the angle.

Source: Litvin, Gear geometry and applied theory (generation by rack-cutters); GOST 13755-81 (the rack).
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .gear import WHEELS
from .geometry import geometry, tangent_of_involute, unrolled

Array = NDArray[np.float64]
Points = NDArray[Any]  # complex
RIGHT_ANGLE = 0.5 * math.pi
HALVINGS = 100
POINTS = 48  # of a flank, of a fillet
ARC = math.radians(1.0)  # between points of the tip and the root
ROUNDING = 1e-12  # part of the module
SEEN = 400  # places of a fillet at which it is looked whether the tooth is there
NEEDED = ("d_1", "d_2", "s_1", "s_2", "inv_alpha", "d_b1", "d_b2", "d_a1", "d_a2", "d_f1", "d_f2", "rho_f")


@dataclass(frozen=True)
class _Tooth:
    """One tooth of a wheel."""

    z: float  # number of teeth
    alpha: float  # profile angle of the rack, rad
    # radii of the reference, base, tip and root circles, m
    r: float
    r_b: float
    r_a: float
    r_f: float
    psi_b: float  # half the angle of the tooth on the base circle, rad; the flanks are thought to reach it
    rho_f: float  # radius of the rack's corner, m
    e_f: float  # distance of the corner's centre from the centre line of the rack's tooth, m

    @property
    def h_0(self) -> float:
        """How far the centre of the rack's corner is inside the reference circle when it is nearest, m."""
        return self.r - self.r_f - self.rho_f

    @property
    def rho_l(self) -> float:
        """Radius of curvature where the rack's straight edge ends, m: negative for an undercut tooth."""
        sine = math.sin(self.alpha)
        return self.r * sine - self.rho_f - self.h_0 / sine

    @property
    def undercut(self) -> bool:
        """Whether the corner of the rack cuts away a part of the involute."""
        return self.rho_l < 0.0

    @cached_property
    def rho_point(self) -> float:
        """Radius of curvature where both flanks meet, m."""
        return self.r_b * float(tangent_of_involute(self.psi_b))

    @property
    def pointed(self) -> bool:
        """Whether the flanks meet inside the tip circle."""
        return self.rho_point < self._rho_tip

    @property
    def _rho_tip(self) -> float:
        square = (self.r_a - self.r_b) * (self.r_a + self.r_b)
        return math.sqrt(square) if square > 0.0 else 0.0

    @property
    def rho_end(self) -> float:
        """Radius of curvature where the flank ends, m: on the tip circle, or at the point of a pointed tooth."""
        return min(self._rho_tip, self.rho_point)

    @property
    def tip(self) -> float:
        """Distance of the tip from the wheel's centre, m: less than r_a for a pointed tooth."""
        return math.hypot(self.r_b, self.rho_point) if self.pointed else self.r_a

    @cached_property
    def beta_start(self) -> float:
        """Where the fillet ends and the involute begins, rad."""
        if not self.undercut:
            return self.alpha
        low, high = self.alpha, RIGHT_ANGLE
        for _ in range(HALVINGS):
            middle = 0.5 * (low + high)
            point = complex(self.fillet(middle))
            before = abs(point) < self.r_b or math.atan2(point.imag, point.real) < float(self.half_angle(abs(point)))
            low, high = (low, middle) if before else (middle, high)
        return high

    @cached_property
    def rho_start(self) -> float:
        """Radius of curvature where the involute begins, m."""
        if not self.undercut:
            return self.rho_l
        start = abs(complex(self.fillet(self.beta_start)))
        return math.sqrt(max((start - self.r_b) * (start + self.r_b), 0.0))

    @property
    def whole(self) -> bool:
        """Whether a tooth with a flank is left: the fillets of both sides do not meet below its involutes."""
        if not 0.0 < self.r_f < self.r_a or not self.psi_b > 0.0 or not self.rho_start < self.rho_end:
            return False
        return bool(np.all(self.fillet(np.linspace(self.beta_start, RIGHT_ANGLE, SEEN)).imag > 0.0))

    def half_angle(self, radius: Any) -> Array:
        """Return half the angle of the tooth at distances from the centre, rad, between its involutes."""
        radius = np.asarray(radius, float)
        square = np.maximum((radius - self.r_b) * (radius + self.r_b), 0.0)
        found: Array = self.psi_b - unrolled(np.sqrt(square) / self.r_b)
        return found

    def flank(self, rho: Any) -> Points:
        """Return points of the upper involute at radii of curvature, m."""
        t = np.asarray(rho, float) / self.r_b
        points: Points = self.r_b * (1.0 + 1j * t) * np.exp(1j * (self.psi_b - t))
        return points

    def fillet(self, beta: Any) -> Points:
        """Return points of the upper fillet at angles from `beta_start` to a right angle, rad."""
        beta = np.asarray(beta, float)
        sine, cosine = np.sin(beta), np.cos(beta)
        beside = self.h_0 * cosine / sine
        corner = self.r - self.h_0 - self.rho_f * sine - 1j * (beside + self.rho_f * cosine)
        points: Points = corner * np.exp(1j * ((beside - self.e_f) / self.r + math.pi / self.z))
        return points

    def half(self, points: int = POINTS, arc: float = ARC) -> Points:
        """Return points of the upper half, from the middle of the tip to the middle of the space.

        The flank has so many `points`, and the fillet; those of tip and root are at most `arc`, rad, apart.
        """
        end = 0.0 if self.pointed else float(self.half_angle(self.r_a))
        top = self.tip * np.exp(1j * _steps(0.0, end, arc))
        flank = self.flank(np.linspace(self.rho_end, self.rho_start, points))
        fillet = self.fillet(np.linspace(self.beta_start, RIGHT_ANGLE, points))
        # the fillet ends on the root circle: in the middle of the space where the rack's tip is round
        root = self.r_f * np.exp(1j * _steps(math.pi / self.z - self.e_f / self.r, math.pi / self.z, arc))
        return np.concatenate((top[:-1], flank[:-1], fillet[:-1], root))

    def outline(self, points: int = POINTS, arc: float = ARC) -> Points:
        """Return points of one tooth counter-clockwise, from the middle of one space to that of the next."""
        half = self.half(points, arc)
        return np.concatenate((half[:0:-1].conj(), half))

    def teeth(self, count: int, points: int = POINTS, arc: float = ARC) -> Points:
        """Return points of neighbouring teeth counter-clockwise, the first of them on the real axis."""
        turn = np.exp(2j * math.pi / self.z * np.arange(count))
        outline = self.outline(points, arc)
        return np.append((outline[:-1] * turn[:, np.newaxis]).ravel(), outline[-1] * turn[-1])


def tooth_of(values: Mapping[str, Any], i: int) -> _Tooth:
    """Return the tooth of the wheel `i`, 1 or 2, of a pair with its givens by name."""
    found = geometry(values, NEEDED)
    m, alpha, rho_f = found["m"], found["alpha"], found["rho_f"]
    r, r_f = 0.5 * found[f"d_{i}"], 0.5 * found[f"d_f{i}"]
    straight = (found["h_a"] + found["c"]) * m - rho_f  # of the corner's centre from the rack's middle line
    beside = 0.25 * math.pi * m - straight * math.tan(alpha) - rho_f / math.cos(alpha)
    return _Tooth(
        z=found[f"z_{i}"],
        alpha=alpha,
        r=r,
        r_b=0.5 * found[f"d_b{i}"],
        r_a=0.5 * found[f"d_a{i}"],
        r_f=r_f,
        psi_b=found[f"s_{i}"] / found[f"d_{i}"] + found["inv_alpha"],
        rho_f=rho_f,
        e_f=beside if beside > ROUNDING * m else 0.0,  # else the tip is round: both corners have one centre
    )


def _steps(begin: float, end: float, most: float) -> Array:
    """Return angles from `begin` to `end`, at most `most` apart; one where both are the same."""
    return np.linspace(begin, end, math.ceil(abs(end - begin) / most) + 1)


WANTED = ("a_w", "alpha_w", "d_w1", "d_w2", "d_b1", "d_b2", "rho_p1", "rho_a1", "l_N1N2", "p_b", "rho_w1", "rho_w2")


@dataclass(frozen=True)
class Meshing:
    """A pair in mesh without backlash."""

    teeth: tuple[_Tooth, _Tooth]  # of the pinion and of the wheel
    sizes: Mapping[str, float]  # the quantities of the pair
    sense: int = 1  # +1 when the pinion turns counter-clockwise, else -1

    @property
    def centres(self) -> tuple[complex, complex]:
        """O1 and O2."""
        return complex(0.0, -0.5 * self.sizes["d_w1"]), complex(0.0, 0.5 * self.sizes["d_w2"])

    @property
    def along(self) -> complex:
        """The unit direction from N1 to N2, in which contacts move."""
        alpha_w = self.sizes["alpha_w"]
        return complex(-self.sense * math.cos(alpha_w), math.sin(alpha_w))

    def place(self, rho_1: float) -> complex:
        """Return the point of the line of action at the distance `rho_1` from N1."""
        return self.along * (rho_1 - self.sizes["rho_w1"])

    @property
    def touching(self) -> tuple[float, float]:
        """Between which rho_1 the flanks touch: the active line, less what undercut and pointed teeth lack."""
        pinion, wheel = self.teeth
        line = self.sizes["l_N1N2"]
        return max(pinion.rho_start, line - wheel.rho_end), min(pinion.rho_end, line - wheel.rho_start)

    def angle(self, rho_1: float) -> float:
        """Return the pinion's angle from the contact at the pole to that at `rho_1`, rad."""
        return (rho_1 - self.sizes["rho_w1"]) / self.teeth[0].r_b

    def directions(self, angle: float) -> tuple[complex, complex]:
        """Return from each centre the direction of the tooth that touches at the pole when the angle is zero."""
        first, second = (
            side * complex(math.cos(turned), math.sin(turned))
            for side, turned in zip((1j, -1j), self.turned(angle), strict=True)
        )
        return first, second

    def turned(self, angle: Any) -> list[Any]:
        """Return how far those teeth are turned from the line of centres, rad."""
        found = []
        for tooth, ratio in zip(self.teeth, (1.0, -self.teeth[0].z / self.teeth[1].z), strict=True):
            half = float(tooth.half_angle(tooth.r_b / math.cos(self.sizes["alpha_w"])))
            found.append(self.sense * (ratio * angle - half))
        return found

    def outlines(self, angle: float, points: int = POINTS, arc: float = ARC) -> tuple[Points, Points]:
        """Return the outlines of both wheels at an angle of the pinion, closed without a repeated point."""
        first, second = (
            centre + tooth.teeth(round(tooth.z), points, arc)[:-1] * direction
            for tooth, centre, direction in zip(self.teeth, self.centres, self.directions(angle), strict=True)
        )
        return first, second


def meshing_of(values: Mapping[str, float], sense: int = 1) -> Meshing:
    """Return a pair in mesh with its complete givens by name."""
    return Meshing((tooth_of(values, 1), tooth_of(values, 2)), geometry(values, WANTED), sense)


CIRCLES = ("a", "w", "", "b", "f")  # tip, rolling, reference, base, root: what stands in their names after d_
SHOWN = 3  # teeth of each wheel
FLANK = 40  # points of a flank that is drawn apart


@dataclass(frozen=True)
class Wheel:
    """One wheel on the paper."""

    number: int  # 1 for the pinion, 2 for the wheel
    tooth: _Tooth  # its tooth, m
    # its centre, mm; the unit direction from there to the pole
    centre: complex
    up: complex
    facing: complex  # the unit direction from its centre in which the middle line of the tooth in contact points
    side: int  # +1 where the active flank is the counter-clockwise one of a tooth, else -1
    k: float  # millimetres of paper for a metre
    sizes: Mapping[str, float]  # the quantities of the pair

    def radius(self, circle: str) -> float:
        """Return the radius of a circle of `CIRCLES`, mm."""
        return 0.5 * self.sizes[f"d_{circle}{self.number}"] * self.k

    @property
    def pitch(self) -> float:
        """The angular pitch, rad."""
        return 2.0 * math.pi / self.tooth.z

    @property
    def direction(self) -> float:
        """The angle from the x axis to the direction to the pole, rad."""
        return cmath.phase(self.up)

    def towards(self, point: complex, radius: float) -> complex:
        """Return the point at a distance from the centre on the ray to another point."""
        arm = point - self.centre
        return self.centre + arm * (radius / abs(arm))

    def on(self, radius: float, angle: float) -> complex:
        """Return the point at a distance from the centre, at an angle from the direction to the pole."""
        return self.centre + radius * self.up * cmath.rect(1.0, angle)

    def angle(self, point: complex) -> float:
        """Return the angle from the direction to the pole to that of a point, seen from the centre."""
        return cmath.phase((point - self.centre) / self.up)

    def placed(self, points: Any, turns: float = 0.0) -> tuple[complex, ...]:
        """Return points of a tooth on the real axis, m, where the tooth in contact stands, or some pitches further."""
        turned = self.facing * cmath.rect(self.k, turns * self.pitch)
        return tuple((self.centre + np.asarray(points) * turned).tolist())

    def outline(self, count: int = SHOWN) -> tuple[complex, ...]:
        """Return the outline of neighbouring teeth counter-clockwise, the one in contact in their middle."""
        return self.placed(self.tooth.teeth(count), -0.5 * (count - 1))

    def flank(self, low: float, high: float) -> tuple[complex, ...]:
        """Return the active flank between two radii of curvature, m, from its root on."""
        points = self.tooth.flank(np.linspace(low, high, FLANK))
        return self.placed(points if self.side > 0 else points.conj())

    def at(self, radius: float, turns: float = 0.0, active: bool = True) -> complex:
        """Return where a flank meets a circle about the wheel's centre, mm."""
        half = float(self.tooth.half_angle(radius / self.k))
        point = radius / self.k * cmath.rect(1.0, half if (self.side > 0) == active else -half)
        return self.placed([point], turns)[0]

    def inward(self, point: complex) -> complex:
        """Return the unit normal of the active flank at a point of it, into the tooth."""
        arm = point - self.centre
        far = abs(arm)
        # the normal touches the base circle: it leans from the radius by the angle whose cosine is r_b / r
        lean = math.acos(min(1.0, self.radius("b") / far))
        return -arm / far * cmath.rect(1.0, self.side * (0.5 * math.pi - lean))


def wheels(meshing: Meshing, sizes: Mapping[str, float], mu: float, rho_1: float | None = None) -> tuple[Wheel, Wheel]:
    """Return both wheels on the paper while they touch at `rho_1`, m from N1; by default at the pole."""
    facing = meshing.directions(0.0 if rho_1 is None else meshing.angle(rho_1))
    k = 1.0 / mu
    first, second = (
        Wheel(i, tooth, centre * k, 1j if i == 1 else -1j, direction, meshing.sense, k, sizes)
        for i, tooth, centre, direction in zip(WHEELS, meshing.teeth, meshing.centres, facing, strict=True)
    )
    return first, second
