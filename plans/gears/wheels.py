"""The wheels of a pair as they stand in mesh, as large as they are drawn: the pole is the origin, the pinion below."""

from __future__ import annotations

import cmath
import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from .gear import WHEELS
from .meshing import Meshing
from .profile import Tooth

CIRCLES = ("a", "w", "", "b", "f")  # tip, rolling, reference, base, root: what stands in their names after d_
SHOWN = 3  # teeth of each wheel
FLANK = 40  # points of a flank that is drawn apart


@dataclass(frozen=True)
class Wheel:
    """One wheel on the paper.

    Parameters
    ----------
    number : int
        1 for the pinion, 2 for the wheel.
    tooth : Tooth
        Its tooth, m.
    centre, up : complex
        Its centre, mm; the unit direction from there to the pole.
    facing : complex
        The unit direction from its centre in which the middle line of the tooth in contact points.
    side : int
        +1 where the active flank is the counter-clockwise one of a tooth, else -1.
    k : float
        Millimetres of paper for a metre.
    sizes : mapping of str to float
        The quantities of the pair.
    """

    number: int
    tooth: Tooth
    centre: complex
    up: complex
    facing: complex
    side: int
    k: float
    sizes: Mapping[str, float]

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
