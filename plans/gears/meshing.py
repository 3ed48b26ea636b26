"""How the two wheels of a pair mesh: centres, line of action, contacts, both wheels turned together, and as drawn.

All points are complex numbers, m. The pole is the origin, the line of centres the imaginary axis, the pinion below. A
contact is known by rho_1, its distance from N1 along N1N2: the radius of curvature of the pinion's flank there. Angles
of the pinion count from the contact at the pole in the sense in which it turns, so rho_1 grows by r_b1 times the angle.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .gear import WHEELS
from .geometry import geometry
from .profile import ARC, POINTS, Points, Tooth, tooth_of

Array = NDArray[np.float64]
WANTED = ("a_w", "alpha_w", "d_w1", "d_w2", "d_b1", "d_b2", "rho_p1", "rho_a1", "l_N1N2", "p_b", "rho_w1", "rho_w2")


@dataclass(frozen=True)
class Meshing:
    """A pair in mesh without backlash."""

    teeth: tuple[Tooth, Tooth]  # of the pinion and of the wheel
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

    @property
    def ends(self) -> tuple[complex, complex]:
        """N1 and N2, where the line of action touches the base circles."""
        return self.place(0.0), self.place(self.sizes["l_N1N2"])

    @property
    def active(self) -> tuple[complex, complex]:
        """A1 and A2, where the tip circles cut the line of action: of the wheel, of the pinion."""
        return self.place(self.sizes["rho_p1"]), self.place(self.sizes["rho_a1"])

    def place(self, rho_1: float) -> complex:
        """Return the point of the line of action at the distance `rho_1` from N1."""
        return self.along * (rho_1 - self.sizes["rho_w1"])

    @property
    def touching(self) -> tuple[float, float]:
        """Between which rho_1 the flanks touch: the active line, less what undercut and pointed teeth lack."""
        pinion, wheel = self.teeth
        line = self.sizes["l_N1N2"]
        return max(pinion.rho_start, line - wheel.rho_end), min(pinion.rho_end, line - wheel.rho_start)

    @property
    def single(self) -> tuple[float, float]:
        """Between which rho_1 one pair alone touches; in reverse order where there are always two."""
        first, last = self.touching
        return last - self.sizes["p_b"], first + self.sizes["p_b"]

    def angle(self, rho_1: float) -> float:
        """Return the pinion's angle from the contact at the pole to that at `rho_1`, rad."""
        return (rho_1 - self.sizes["rho_w1"]) / self.teeth[0].r_b

    def contacts(self, angle: float) -> Array:
        """Return rho_1 of all pairs that touch at an angle of the pinion, from first to last to leave, rising."""
        first, last = self.touching
        pitch = self.sizes["p_b"]
        base = self.sizes["rho_w1"] + self.teeth[0].r_b * angle
        numbers = np.arange(math.ceil((first - base) / pitch), math.floor((last - base) / pitch) + 1)
        return np.asarray(base + pitch * numbers)

    def directions(self, angle: float) -> tuple[complex, complex]:
        """Return from each centre the direction of the tooth that touches at the pole when the angle is zero."""
        found = []
        for tooth, side, ratio in zip(self.teeth, (1j, -1j), (1.0, -self._ratio), strict=True):
            half = float(tooth.half_angle(tooth.r_b / math.cos(self.sizes["alpha_w"])))
            turned = self.sense * (ratio * angle - half)
            found.append(side * complex(math.cos(turned), math.sin(turned)))
        return found[0], found[1]

    @property
    def _ratio(self) -> float:
        return self.teeth[0].z / self.teeth[1].z

    def outlines(self, angle: float, points: int = POINTS, arc: float = ARC) -> tuple[Points, Points]:
        """Return the outlines of both wheels at an angle of the pinion, closed without a repeated point."""
        first, second = (
            centre + tooth.wheel(points, arc) * direction
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
    tooth: Tooth  # its tooth, m
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

    def flank(self, low: float, high: float, turns: float = 0.0, active: bool = True) -> tuple[complex, ...]:
        """Return the active flank, or the other one, between two radii of curvature, m, from its root on."""
        points = self.tooth.flank(np.linspace(low, high, FLANK))
        return self.placed(points if (self.side > 0) == active else points.conj(), turns)

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
