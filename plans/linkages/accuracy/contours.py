"""Closed vector contours of any mechanism of revolute and prismatic pairs: the analytical rival of plans.

Links are walked from the frame, pair by pair; a pair that leads to a link that is known already closes a contour, whose
vectors add up to zero. Unknown are angles of links and ways of sliders; links that a prismatic pair joins turn alike
and share one angle. By Newton's method positions come from corrections until they are smaller than a tolerance, for N
positions at once, velocities and accelerations from linear systems with the same Jacobian.

A pose is a float64 array of shape (unknowns, N): first the angles, rad, that of the frame among them, then the ways, m.
Rates of these, and rates of rates, have the same shape.

Source: Zinoviev, method of closed vector contours; Artobolevsky, Theory of mechanisms and machines.
"""

from __future__ import annotations

import cmath
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...boards.exact import NAN
from ..mechanism import FRAME, ZERO, Driver, Mechanism, Pair, Prismatic, Revolute

Array = NDArray[Any]
ROUNDS = 20  # corrections after which Newton's method is given up


@dataclass(frozen=True, slots=True)
class Form:
    """A vector as a sum: `parts` by the row of the angle with which they turn, `ways` by that of a slider's way.

    All are complex numbers for an angle of zero; that of a way is the direction of its guide.
    """

    parts: dict[int, complex]
    ways: dict[int, complex] = field(default_factory=dict)

    def __add__(self, other: Form) -> Form:
        """Add a vector."""
        sums = ((self.parts, other.parts), (self.ways, other.ways))
        return Form(*({row: one.get(row, 0j) + more.get(row, 0j) for row in one | more} for one, more in sums))

    def __sub__(self, other: Form) -> Form:
        """Subtract a vector."""
        return self + Form(*({row: -x for row, x in part.items()} for part in (other.parts, other.ways)))


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
        self._turner = {row: self.angle_of[pair.links[1]] for row, pair in self._guides.items()}
        self._origins: dict[int, Form] = {FRAME: Form({})}
        self.closed = tuple(self._walk())
        self.size = max((abs(x) for form in self.closed for x in form.parts.values()), default=1.0) or 1.0
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

    def _walk(self) -> Iterator[Form]:
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

    def _between(self, pair: Pair) -> Form:
        """Return the way from the origin of the first link of a pair to that of the second."""
        first, second = pair.links
        if isinstance(pair, Revolute):
            at = pair.at or (ZERO, ZERO)
            ends = [at if link == FRAME else self._m.link(link).points[pair.point] for link in pair.links]
            return self._arm(first, ends[0]) - self._arm(second, ends[1])
        on_slider, through = self._arm(first, self._m.link(first).points[pair.point]), self._arm(second, pair.through)
        along = cmath.rect(1.0, self._ahead[second] + self._v[pair.direction])
        aside = Form({self.angle_of[second]: along * 1j * self._v[pair.offset]})
        row = next(row for row, guide in self._guides.items() if guide is pair)
        return on_slider - through - aside - Form({}, {row: along})

    def _at(self, place: tuple[str, str]) -> complex:
        return complex(self._v[place[0]], self._v[place[1]])

    def _arm(self, link: int, place: tuple[str, str]) -> Form:
        """Return the vector from a link's origin to a place on it."""
        return Form({self.angle_of[link]: cmath.rect(1.0, self._ahead[link]) * self._at(place)})

    def point(self, letter: str) -> Form:
        """Return the place of a lettered point."""
        if letter in self._m.frame_points:
            return Form({0: self._at(self._m.frame_points[letter])})
        link = next(link for link in self._m.links if letter in link.points)
        return self._origins[link.number] + self._arm(link.number, link.points[letter])

    def pose(self, directions: Mapping[int, Array], places: Mapping[str, Array]) -> Array:
        """Return the pose in which the links lie, from unit directions of their x axes, by number, and lettered points.

        All are complex128 of shape (N,).
        """
        pose = np.zeros((self.count + len(self._guides), len(next(iter(directions.values())))))
        for link, direction in directions.items():
            if self.angle_of[link]:
                pose[self.angle_of[link]] = np.angle(direction) - self._ahead[link]
        for row, pair in self._guides.items():  # how far the slider's point is from where the guide passes
            guide, through = pair.links[1], self._at(pair.through)
            turn = np.exp(1j * (pose[self.angle_of[guide]] + self._ahead[guide]))
            if guide != FRAME:
                letter, origin = next(iter(self._m.link(guide).points.items()))
                through = places[letter] + turn * (through - self._at(origin))
            along = turn * cmath.rect(1.0, self._v[pair.direction])
            pose[row] = np.real((places[pair.point] - through) * np.conj(along))
        return pose

    def value(self, form: Form, pose: Array) -> Array:
        """Return a vector in every position, shape (N,)."""
        return self._turned(form, pose, self._turns(pose))

    def rate(self, form: Form, pose: Array, rates: Array) -> Array:
        """Return its first derivative by time."""
        turns = self._turns(pose)
        found = self._turned(form, pose, turns * (1j * rates[: self.count]))
        for row, way in form.ways.items():
            found = found + turns[self._turner[row]] * way * rates[row]
        return found

    def change(self, form: Form, pose: Array, rates: Array, changes: Array) -> Array:
        """Return its second derivative by time."""
        turns = self._turns(pose)
        found = self._turned(form, pose, turns * (1j * changes[: self.count] - rates[: self.count] ** 2))
        for row, way in form.ways.items():
            k = self._turner[row]
            found = found + turns[k] * way * (changes[row] + 2j * rates[k] * rates[row])
        return found

    def _turns(self, pose: Array) -> Array:
        return np.asarray(np.exp(1j * pose[: self.count]))

    def _turned(self, form: Form, pose: Array, turns: Array) -> Array:
        found = np.zeros(pose.shape[1], complex)
        for k in dict.fromkeys((*form.parts, *(self._turner[row] for row in form.ways))):
            found = found + turns[k] * self._arm_of(form, k, pose)
        return found

    def _arm_of(self, form: Form, k: int, pose: Array) -> Array | complex:
        """Return what turns with angle `k`, for an angle of zero."""
        ways = (way * pose[row] for row, way in form.ways.items() if self._turner[row] == k)
        return sum(ways, start=form.parts.get(k, 0j))

    def solve(self, near: Array, places: Array, tolerance: float) -> Array:
        """Find poses by Newton's method, from a pose `near` each place of the driver, float64 of shape (N,).

        A position is found when its last correction is smaller than the `tolerance`, in radians, and in parts of the
        mechanism's size; NaN where the corrections have no end.
        """
        pose, held = near.copy(), np.zeros(len(places), bool)
        pose[0], pose[self._driven] = 0.0, places - self._zero
        parts = np.where(np.arange(len(pose)) < self.count, 1.0, 1.0 / self.size)[:, None]
        for _ in range(ROUNDS):
            step = self._solved(pose, [self.value(form, pose) for form in self.closed])
            pose = pose + step
            held = (np.abs(step) * parts).max(axis=0) < tolerance
            if held.all():
                break
        return np.where(held, pose, NAN)

    def rates(self, pose: Array, speed: float) -> Array:
        """Return velocities at a speed of the driver, by a linear system."""
        return self._driven_by(pose, speed, lambda form, own: self.rate(form, pose, own))

    def changes(self, pose: Array, rates: Array, acceleration: float = 0.0) -> Array:
        """Return accelerations, by a linear system; `acceleration` is the driver's."""
        return self._driven_by(pose, acceleration, lambda form, own: self.change(form, pose, rates, own))

    def _driven_by(self, pose: Array, driver: float, gap: Callable[[Form, Array], Array]) -> Array:
        own = np.zeros_like(pose)
        own[self._driven] = driver
        return self._solved(pose, [gap(form, own) for form in self.closed]) + own

    def _solved(self, pose: Array, gaps: list[Array]) -> Array:
        """Return the unknowns that close gaps, to first order."""
        turns, rows = self._turns(pose), []
        for form in self.closed:  # derivatives of both components of a contour by all unknowns
            columns = [
                turns[row] * 1j * self._arm_of(form, row, pose)
                if row < self.count
                else turns[self._turner[row]] * form.ways.get(row, 0j)
                for row in self._free
            ]
            block = np.stack([np.broadcast_to(column, pose.shape[1]) for column in columns], axis=1)
            rows += [block.real, block.imag]
        right = np.stack([part for gap in gaps for part in (-gap.real, -gap.imag)], axis=1)[:, :, None]
        step = np.zeros_like(pose)
        step[self._free] = _linear(np.stack(rows, axis=1), right)[:, :, 0].T
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
