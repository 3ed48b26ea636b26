"""Closed vector contours of any mechanism of revolute and prismatic pairs: the analytical rival of plans.

Links are walked from the frame, pair by pair; a pair that leads to a link that is known already closes a contour, whose
vectors add up to zero. Unknown are angles of links and ways of sliders; links that a prismatic pair joins turn alike
and share one angle. By Newton's method positions come from corrections until they are smaller than a tolerance, for N
positions at once, velocities and accelerations from linear systems with the same Jacobian.

A pose is a float64 array of shape (unknowns, N): first the angles, rad, that of the frame among them, then the ways, m.
Rates of these, and rates of rates, have the same shape.

A vector is a form, complex128 of shape (unknowns,): what turns with each angle, as it is for an angle of zero, then the
direction of each slider's guide, which turns with the guide and counts as long as its way. Forms add up as arrays do.

Source: Zinoviev, method of closed vector contours; Artobolevsky, Theory of mechanisms and machines.
"""

from __future__ import annotations

import cmath
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..boards.exact import NAN
from ..linkages.mechanism import FRAME, ZERO, Driver, Mechanism, Pair, Prismatic, Revolute

Array = NDArray[Any]
ROUNDS = 20  # corrections after which Newton's method is given up


class Contours:
    """The contours of one mechanism with its numbers, in SI; where its driver stands among them does not matter."""

    def __init__(self, mechanism: Mechanism, values: Mapping[str, Any]) -> None:
        self._m = mechanism
        self._v = {name: float(x) for name, x in values.items() if not np.ndim(x)} | {ZERO: 0.0}
        self._v |= {opposite: -self._v[length] for opposite, length in mechanism.opposites.items()}
        guides = [pair for pair in mechanism.pairs if isinstance(pair, Prismatic)]
        # by link the row of its angle, zero for the frame, and by how much it lies ahead of it
        self.angle_of, self._ahead = self._alike(guides)
        self.count = len(set(self.angle_of.values()))  # of the angles
        self._guides = dict(enumerate(guides, start=self.count))
        self._rows = [*range(self.count), *(self.angle_of[pair.links[1]] for pair in guides)]  # with what each turns
        self._slides = (np.arange(len(self._rows)) >= self.count)[:, None]
        self._origins = {FRAME: np.zeros(len(self._rows), complex)}
        self.closed = np.stack([*self._walk()])
        self.size = float(np.abs(self.closed[:, : self.count]).max()) or 1.0
        driver, self._zero = mechanism.driver, 0.0  # the driver's variable where its row is zero
        if isinstance(driver, Driver):
            points = mechanism.link(driver.link).points
            arm = self._at(points[driver.point]) - self._at(points[driver.pivot])
            self._driven, self._zero = self.angle_of[driver.link], cmath.phase(arm) + self._ahead[driver.link]
        else:
            ends = {FRAME, driver.link}
            self._driven = next(row for row, pair in self._guides.items() if {*pair.links} == ends)
        self._free = [row for row in range(1, self.count + len(guides)) if row != self._driven]

    def _alike(self, guides: list[Prismatic]) -> tuple[dict[int, int], dict[int, float]]:
        """Return for every link the row of its angle, zero for the frame, and by how much it lies ahead of it."""
        root = {link: link for link in (FRAME, *(x.number for x in self._m.links))}
        ahead = dict.fromkeys(root, 0.0)
        for pair in guides:
            slider, guide = pair.links
            turn = ahead[guide] + self._v[pair.direction] - ahead[slider]
            old, new = root[slider], root[guide]
            if old == FRAME:
                old, new, turn = new, old, -turn
            for link in [link for link, of in root.items() if of == old and old != new]:
                root[link], ahead[link] = new, ahead[link] + turn
        rows = {of: row for row, of in enumerate(dict.fromkeys(root.values()))}
        return {link: rows[of] for link, of in root.items()}, ahead

    def _walk(self) -> Iterator[Array]:
        """Walk over all pairs from the frame; go through the contours that they close."""
        left = list(self._m.pairs)
        known = self._origins
        while left:
            pair = next(pair for pair in left if not known.keys().isdisjoint(pair.links))
            left.remove(pair)
            first, second = pair.links
            if first in known and second in known:
                yield known[first] + self._between(pair) - known[second]
            elif first in known:
                known[second] = known[first] + self._between(pair)
            else:
                known[first] = known[second] - self._between(pair)

    def _between(self, pair: Pair) -> Array:
        """Return the way from the origin of the first link of a pair to that of the second."""
        first, second = pair.links
        if isinstance(pair, Revolute):
            at = pair.at or (ZERO, ZERO)
            ends = [at if link == FRAME else self._m.link(link).points[pair.point] for link in pair.links]
            return self._arm(first, ends[0]) - self._arm(second, ends[1])
        on_slider, through = self._arm(first, self._m.link(first).points[pair.point]), self._arm(second, pair.through)
        along = cmath.rect(1.0, self._ahead[second] + self._v[pair.direction])
        slid, row = np.zeros_like(through), next(row for row, guide in self._guides.items() if guide is pair)
        slid[self.angle_of[second]], slid[row] = along * 1j * self._v[pair.offset], along
        return on_slider - through - slid

    def _at(self, place: tuple[str, str]) -> complex:
        return complex(self._v[place[0]], self._v[place[1]])

    def _arm(self, link: int, place: tuple[str, str]) -> Array:
        """Return the vector from a link's origin to a place on it."""
        arm = np.zeros(len(self._rows), complex)
        arm[self.angle_of[link]] = cmath.rect(1.0, self._ahead[link]) * self._at(place)
        return arm

    def point(self, letter: str) -> Array:
        """Return the place of a lettered point."""
        if letter in self._m.frame_points:
            return self._arm(FRAME, self._m.frame_points[letter])
        link = next(link for link in self._m.links if letter in link.points)
        return self._origins[link.number] + self._arm(link.number, link.points[letter])

    def pose(self, directions: Mapping[int, Array]) -> Array:
        """Return the pose in which the links lie, from unit directions of their x axes, by number, complex128 (N,).

        The ways are those that close the contours.
        """
        pose = np.zeros((self.count + len(self._guides), len(next(iter(directions.values())))))
        for link, direction in directions.items():
            if self.angle_of[link]:
                pose[self.angle_of[link]] = np.angle(direction) - self._ahead[link]
        turned = self._turned(self.closed, pose).transpose(2, 0, 1)
        parts = np.concatenate((turned.real, turned.imag), axis=1)
        gaps = parts[:, :, : self.count].sum(axis=2, keepdims=True)
        pose[self.count :] = -(np.linalg.pinv(parts[:, :, self.count :]) @ gaps)[:, :, 0].T
        return pose

    def _turned(self, form: Array, pose: Array) -> Array:
        """Return what turns of forms of shape (..., unknowns) in every position: shape (..., unknowns, N)."""
        return np.asarray(form[..., None] * np.exp(1j * pose[: self.count])[self._rows])

    def _lengths(self, pose: Array) -> Array:
        """Return what each part of a form counts: a constant one once, a way as it is long."""
        return np.where(self._slides, pose, 1.0)

    def _speeds(self, pose: Array, rates: Array) -> Array:
        """Return the first derivatives of lengths that turn, in parts of the turn."""
        return np.asarray(self._slides * rates + 1j * rates[self._rows] * self._lengths(pose))

    def _bends(self, pose: Array, rates: Array, changes: Array) -> Array:
        """Return their second derivatives."""
        omega = rates[self._rows]
        turned = (1j * changes[self._rows] - omega * omega) * self._lengths(pose)
        return np.asarray(self._slides * (changes + 2j * omega * rates) + turned)

    def value(self, form: Array, pose: Array) -> Array:
        """Return a vector in every position, shape (N,)."""
        return np.asarray((self._turned(form, pose) * self._lengths(pose)).sum(axis=0))

    def rate(self, form: Array, pose: Array, rates: Array) -> Array:
        """Return its first derivative by time."""
        return np.asarray((self._turned(form, pose) * self._speeds(pose, rates)).sum(axis=0))

    def change(self, form: Array, pose: Array, rates: Array, changes: Array) -> Array:
        """Return its second derivative by time."""
        return np.asarray((self._turned(form, pose) * self._bends(pose, rates, changes)).sum(axis=0))

    def solve(self, near: Array, places: Array, tolerance: float) -> Array:
        """Find poses by Newton's method, from a pose `near` each place of the driver, float64 of shape (N,).

        A position is found when its last correction is smaller than the `tolerance`, in radians, and in parts of the
        mechanism's size; NaN where the corrections have no end.
        """
        pose, held = near.copy(), np.zeros(len(places), bool)
        pose[0], pose[self._driven] = 0.0, places - self._zero
        parts = np.where(np.arange(len(pose)) < self.count, 1.0, 1.0 / self.size)[:, None]
        for _ in range(ROUNDS):
            step = self._solved(pose, self._lengths(pose))
            pose = pose + step
            held = (np.abs(step) * parts).max(axis=0) < tolerance
            if held.all():
                break
        return np.where(held, pose, NAN)

    def rates(self, pose: Array, speed: float) -> Array:
        """Return velocities at a speed of the driver, by a linear system."""
        own = self._own(pose, speed)
        return self._solved(pose, self._speeds(pose, own)) + own

    def changes(self, pose: Array, rates: Array, acceleration: float = 0.0) -> Array:
        """Return accelerations, by a linear system; `acceleration` is the driver's."""
        own = self._own(pose, acceleration)
        return self._solved(pose, self._bends(pose, rates, own)) + own

    def _own(self, pose: Array, driver: float) -> Array:
        """Return what the driver has alone."""
        own = np.zeros_like(pose)
        own[self._driven] = driver
        return own

    def _solved(self, pose: Array, parts: Array) -> Array:
        """Return the unknowns that close the gaps of all contours whose parts count so, to first order."""
        slopes = self._turned(self.closed, pose)
        gaps = (slopes * parts).sum(axis=1)
        for row, pair in self._guides.items():  # what slides turns with its guide, too
            slopes[:, self.angle_of[pair.links[1]]] += slopes[:, row] * pose[row]
        slopes[:, : self.count] *= 1j
        free = slopes[:, self._free].transpose(2, 0, 1)
        right = -np.concatenate((gaps.real, gaps.imag)).T[:, :, None]
        step = np.zeros_like(pose)
        step[self._free] = _linear(np.concatenate((free.real, free.imag), axis=1), right)[:, :, 0].T
        return step


def _linear(matrices: Array, right: Array) -> Array:
    """Solve a linear system in every position; one that is singular to the last bit has no solution, the others do."""
    try:
        return np.linalg.solve(matrices, right)
    except np.linalg.LinAlgError:
        singular = np.linalg.det(matrices) == 0.0
        found = np.full_like(right, NAN)
        found[~singular] = np.linalg.solve(matrices[~singular], right[~singular])
        return found
