"""What a pair's figures show beside marks, densely: specific sliding over the line of action, the rack that cuts."""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..laws import LAWS
from .profile import Tooth
from .solve import SolvedGear

Curve = list[tuple[float, float]]
PLACES = 240  # of a curve
SLIDING = {1: "sliding_of_pinion", 2: "sliding_of_wheel"}
CORNER = 12  # points of a corner of the rack
NEIGHBOURS = (-1, 0, 1)  # teeth of the rack, in pitches from the one in the middle
TO_POLE = cmath.rect(1.0, 0.5 * math.pi)  # from the real axis to the direction from the centre to the pole


def sliding_curve(solved: SolvedGear, i: int, low: float) -> Curve:
    """Return specific sliding of a wheel by rho_1, from where it is cut off on; closely where it is steep."""
    line, u = solved.sizes["l_N1N2"], solved.sizes["u"]
    ratio = u if i == 1 else 1.0 / u
    first = line / (1.0 + ratio * (1.0 - low))  # own curvature there
    own = first * (line / first) ** np.linspace(0.0, 1.0, PLACES)
    own[-1] = line
    theta = LAWS[SLIDING[i]](own, line - own, u)
    return list(zip((own if i == 1 else line - own).tolist(), theta.tolist(), strict=True))


def active_area(solved: SolvedGear, i: int, low: float) -> Curve:
    """Return the outline of the area between a curve, cut off, and the axis over the active line; it may be empty."""
    line = solved.sizes["l_N1N2"]
    first, last = (min(max(float(solved.sizes[name]), 0.0), line) for name in ("rho_p1", "rho_a1"))
    if last <= first:
        return []
    rho_1 = np.linspace(first, last, PLACES)[1:-1]
    own, other = (rho_1, line - rho_1) if i == 1 else (line - rho_1, rho_1)
    theta = np.maximum(LAWS[SLIDING[i]](own, other, solved.sizes["u"]), low)
    return [(first, 0.0), *zip(rho_1.tolist(), theta.tolist(), strict=True), (last, 0.0)]


@dataclass(frozen=True)
class Rack:
    """The rack that cuts the pinion, a tooth of it in a space of the pinion, k times as large as it is.

    All points are complex numbers, the pole is the origin.
    """

    solved: SolvedGear
    k: float

    @property
    def tooth(self) -> Tooth:
        """The pinion's tooth."""
        return self.solved.meshing.teeth[0]

    @property
    def shift(self) -> float:
        """How far the middle line lies above the pitch line."""
        return self._sizes("x_1") * self._sizes("m") * self.k

    @property
    def centre(self) -> complex:
        """The pinion's centre."""
        return complex(0.0, -self.tooth.r * self.k)

    def radius(self, circle: str) -> float:
        """Return the radius of the pinion's reference circle or, `b`, of its base circle."""
        return (self.tooth.r_b if circle == "b" else self.tooth.r) * self.k

    def on(self, circle: str, angle: float) -> complex:
        """Return the point of a circle of the pinion at an angle from the direction to the pole."""
        return self.centre + self.radius(circle) * cmath.rect(1.0, 0.5 * math.pi + angle)

    @property
    def pitch(self) -> float:
        """The angular pitch of the pinion, rad."""
        return 2.0 * math.pi / self.tooth.z

    @property
    def down(self) -> complex:
        """The direction of the line of action of cutting."""
        return cmath.rect(1.0, -self.tooth.alpha)

    @property
    def touch(self) -> complex:
        """N, where that line touches the base circle."""
        return self.down * (self.tooth.r * math.sin(self.tooth.alpha) * self.k)

    @property
    def edge(self) -> complex:
        """B, where the straight edge of the rack ends on that line."""
        return self.touch - self.down * (self._sizes("rho_l1") * self.k)

    @property
    def corner(self) -> complex:
        """The centre of the corner of the last tooth on the left, on its right side."""
        return complex(-math.pi * self._sizes("m") - self.tooth.e_f, -self.tooth.h_0) * self.k

    def outline(self) -> list[complex]:
        """Return the outline of the rack: flanks from its spaces to the round corners of its tips."""
        m, tooth = self._sizes("m"), self.tooth
        depth, middle = (self._sizes("h_a") + self._sizes("c")) * m, self._sizes("x_1") * m
        turns = np.linspace(tooth.alpha, 0.5 * math.pi, CORNER)
        corner = complex(tooth.e_f, middle - depth + tooth.rho_f) + tooth.rho_f * (np.cos(turns) - 1j * np.sin(turns))
        top = complex(0.25 * math.pi * m + depth * math.tan(tooth.alpha), middle + depth)
        half = np.concatenate(([top], corner))  # to the right of the centre line, from the root to the tip
        one = np.concatenate((-half.conj(), half[::-1]))
        return [point * self.k for n in NEIGHBOURS for point in (one + math.pi * m * n).tolist()]

    def teeth(self) -> tuple[complex, ...]:
        """Return the outline of the two teeth beside the space."""
        turned = TO_POLE * cmath.rect(self.k, -0.5 * self.pitch)
        points: NDArray[np.complex128] = self.centre + self.tooth.teeth(2) * turned
        return tuple(points.tolist())

    def _sizes(self, name: str) -> float:
        return float(self.solved.sizes[name])
