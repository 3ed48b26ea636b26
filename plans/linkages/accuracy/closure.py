"""Newton's method on closed vector contours: the analytical rival of plans, for N positions at once.

Positions come from corrections until they are smaller than a tolerance, velocities and accelerations from linear
systems with the same Jacobian.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...boards.exact import NAN
from ..mechanism import Mechanism
from .contours import Contours, Form, Pose

Array = NDArray[Any]
ROUNDS = 20  # corrections after which Newton's method is given up


@dataclass(frozen=True, slots=True, eq=False)
class Found:
    """Poses by Newton's method; `held` tells where its corrections came to an end."""

    pose: Pose
    held: NDArray[np.bool_]


class Closure:
    """A mechanism's closure equations, ready to be solved at any places of its driver.

    Parameters
    ----------
    values : mapping of str to float
        Numbers of the mechanism in SI; where its driver stands does not matter.
    """

    def __init__(self, mechanism: Mechanism, values: Mapping[str, Any]) -> None:
        self.contours = Contours(mechanism, values)
        self._angle, self._way, self._zero = self.contours.driving()
        self._angles = [k for k in range(1, self.contours.count) if k != self._angle]
        self._ways = [j for j in range(len(self.contours.guides)) if j != self._way]

    def driven(self, pose: Pose, places: Array) -> Pose:
        """Return poses with the driver at its places and the frame where it is."""
        angles, ways = pose.angles.copy(), pose.ways.copy()
        angles[0] = 0.0
        if self._angle is not None:
            angles[self._angle] = places - self._zero
        else:
            ways[self._way] = places
        return Pose(angles, ways)

    def solve(self, near: Pose, places: Array, tolerance: float) -> Found:
        """Find poses by Newton's method.

        Parameters
        ----------
        near : Pose
            Where to start in every position.
        places : float64 array of shape (N,)
            Places of the driver.
        tolerance : float
            A position is found when its last correction is smaller: in radians, and in parts of the mechanism's size.

        Returns
        -------
        Found
            NaN where the corrections have no end.
        """
        contours, pose = self.contours, self.driven(near, places)
        held = np.zeros(len(places), bool)
        for _ in range(ROUNDS):
            step = self._solved(pose, [contours.value(form, pose) for form in contours.closed])
            pose = Pose(pose.angles + step.angles, pose.ways + step.ways)
            sizes = np.concatenate((np.abs(step.angles), np.abs(step.ways) * (1.0 / contours.size)))
            held = sizes.max(axis=0) < tolerance
            if held.all():
                break
        return Found(Pose(np.where(held, pose.angles, NAN), np.where(held, pose.ways, NAN)), held)

    def rates(self, pose: Pose, speed: float) -> Pose:
        """Return velocities at a speed of the driver, by a linear system."""
        own, contours = pose.like(), self.contours
        self._driver_of(own)[:] = speed
        found = self._solved(pose, [contours.rate(form, pose, own) for form in contours.closed])
        return Pose(found.angles + own.angles, found.ways + own.ways)

    def changes(self, pose: Pose, rates: Pose, acceleration: float = 0.0) -> Pose:
        """Return accelerations, by a linear system; `acceleration` is the driver's."""
        own, contours = pose.like(), self.contours
        self._driver_of(own)[:] = acceleration
        found = self._solved(pose, [contours.change(form, pose, rates, own) for form in contours.closed])
        return Pose(found.angles + own.angles, found.ways + own.ways)

    def _driver_of(self, pose: Pose) -> Array:
        row: Array = pose.ways[self._way] if self._angle is None else pose.angles[self._angle]
        return row

    def _solved(self, pose: Pose, gaps: list[Array]) -> Pose:
        """Return the unknowns that close gaps, to first order."""
        turns = np.exp(1j * pose.angles)
        rows = [row for form in self.contours.closed for row in self._rows(form, pose, turns)]
        right = np.stack([part for gap in gaps for part in (-gap.real, -gap.imag)], axis=1)[:, :, None]
        found = _linear(np.stack(rows, axis=1), right)[:, :, 0].T
        step = pose.like()
        step.angles[self._angles] = found[: len(self._angles)]
        step.ways[self._ways] = found[len(self._angles) :]
        return step

    def _rows(self, form: Form, pose: Pose, turns: Array) -> tuple[Array, Array]:
        """Return the derivatives of both components of a contour by all unknowns, shape (N, unknowns) each."""
        contours, n = self.contours, pose.angles.shape[1]
        columns = [turns[k] * 1j * contours.arm_of(form, k, pose) for k in self._angles]
        columns += [turns[contours.turner[j]] * form.ways.get(j, 0j) for j in self._ways]
        block = np.stack([np.broadcast_to(column, n) for column in columns], axis=1)
        return block.real, block.imag


def _linear(matrices: Array, right: Array) -> Array:
    """Solve a linear system in every position; one that is singular to the last bit has no solution, the others do."""
    try:
        return np.linalg.solve(matrices, right)
    except np.linalg.LinAlgError:
        singular = np.linalg.det(matrices) == 0.0
        found = np.full_like(right, NAN)
        found[~singular] = np.linalg.solve(matrices[~singular], right[~singular])
        return found
