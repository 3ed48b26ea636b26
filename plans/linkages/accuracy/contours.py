"""Closed vector contours of any mechanism of revolute and prismatic pairs: the analytical rival of plans.

Links are walked from the frame, pair by pair; a pair that leads to a link that is known already closes a contour, whose
vectors add up to zero. Unknown are angles of links and ways of sliders; links that a prismatic pair joins turn alike
and share one angle. By Newton's method positions come from corrections until they are smaller than a tolerance, for N
positions at once, velocities and accelerations from linear systems with the same Jacobian.

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
    """A vector as a sum: `parts` by the number of the angle with which they turn, `ways` by sliding pair.

    All are complex numbers for an angle of zero; that of a way is the direction of its guide.
    """

    parts: Mapping[int, complex]
    ways: Mapping[int, complex] = field(default_factory=dict)

    def __add__(self, other: Form) -> Form:
        """Add a vector."""
        return Form(_sum(self.parts, other.parts), _sum(self.ways, other.ways))

    def __neg__(self) -> Form:
        """Turn the vector round."""
        return Form({k: -x for k, x in self.parts.items()}, {j: -x for j, x in self.ways.items()})

    def __sub__(self, other: Form) -> Form:
        """Subtract a vector."""
        return self + -other


def _sum(one: Mapping[int, complex], other: Mapping[int, complex]) -> dict[int, complex]:
    return {key: one.get(key, 0j) + other.get(key, 0j) for key in dict.fromkeys((*one, *other))}


@dataclass(frozen=True, slots=True, eq=False)
class Pose:
    """Angles, rad, shape (angles, N), and ways of sliders, m, shape (ways, N); or their rates, or rates of these."""

    angles: Array
    ways: Array

    def at(self, which: Any) -> Pose:
        """Return the poses of some positions."""
        return Pose(self.angles[:, which], self.ways[:, which])

    def like(self) -> Pose:
        """Return as many zeros."""
        return Pose(np.zeros_like(self.angles), np.zeros_like(self.ways))


class Contours:
    """The contours of one mechanism with its numbers, in SI; the driver's own variable does not matter."""

    def __init__(self, mechanism: Mechanism, values: Mapping[str, Any]) -> None:
        self._m = mechanism
        self._v = {name: float(x) for name, x in values.items() if not np.ndim(x)} | {ZERO: 0.0}
        self._v |= {opposite: -self._v[length] for opposite, length in mechanism.opposites.items()}
        self.guides = tuple(pair for pair in mechanism.pairs if isinstance(pair, Prismatic))
        # by link the number of its angle, zero for the frame, and by how much it lies ahead of it
        self.angle_of, self._ahead = self._alike()
        self.count = len(set(self.angle_of.values()))
        self.turner = tuple(self.angle_of[pair.links[1]] for pair in self.guides)
        self._origins: dict[int, Form] = {FRAME: Form({})}
        self.closed = tuple(self._walk())
        self.size = max((abs(x) for form in self.closed for x in form.parts.values()), default=1.0) or 1.0

    def _alike(self) -> tuple[dict[int, int], dict[int, float]]:
        """Return for every link the number of its angle, zero for the frame, and by how much it lies ahead of it."""
        root = {link: link for link in (FRAME, *(x.number for x in self._m.links))}
        ahead = dict.fromkeys(root, 0.0)
        for pair in self.guides:
            slider, guide = pair.links
            turn = ahead[guide] + self._v[pair.direction] - ahead[slider]
            old, new = root[slider], root[guide]
            if old == FRAME:
                old, new, turn = new, old, -turn
            for link in [link for link, of in root.items() if of == old and old != new]:
                root[link], ahead[link] = new, ahead[link] + turn
        numbers = {of: number for number, of in enumerate(dict.fromkeys(root.values()))}
        return {link: numbers[of] for link, of in root.items()}, ahead

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
            return self._arm(first, self._joint(pair, first)) - self._arm(second, self._joint(pair, second))
        on_slider = self._arm(first, self._place(first, pair.point))
        through = self._arm(second, self._at(pair.through))
        along = cmath.rect(1.0, self._ahead[second] + self._v[pair.direction])
        aside = Form({self.angle_of[second]: along * 1j * self._v[pair.offset]})
        return on_slider - through - aside - Form({}, {self.guides.index(pair): along})

    def _joint(self, pair: Revolute, link: int) -> complex:
        if link != FRAME:
            return self._place(link, pair.point)
        return self._at(pair.at or (ZERO, ZERO))

    def _place(self, link: int, point: str) -> complex:
        return self._at(self._m.link(link).points[point])

    def _at(self, place: tuple[str, str]) -> complex:
        return complex(self._v[place[0]], self._v[place[1]])

    def _arm(self, link: int, place: complex) -> Form:
        """Return the vector from a link's origin to a place on it."""
        return Form({self.angle_of[link]: cmath.rect(1.0, self._ahead[link]) * place})

    # What the user asks for.

    def point(self, letter: str) -> Form:
        """Return the place of a lettered point."""
        if letter in self._m.frame_points:
            return Form({0: self._at(self._m.frame_points[letter])})
        link = next(link.number for link in self._m.links if letter in link.points)
        return self._origins[link] + self._arm(link, self._place(link, letter))

    def driving(self) -> tuple[int | None, int | None, float]:
        """Return the number of the driver's angle or of its way, and the variable's value at which that is zero."""
        driver = self._m.driver
        if isinstance(driver, Driver):
            arm = self._place(driver.link, driver.point) - self._place(driver.link, driver.pivot)
            return self.angle_of[driver.link], None, cmath.phase(arm) + self._ahead[driver.link]
        ends = {FRAME, driver.link}
        return None, next(i for i, pair in enumerate(self.guides) if {*pair.links} == ends), 0.0

    def pose(self, directions: Mapping[int, Array], places: Mapping[str, Array]) -> Pose:
        """Return the pose in which the links lie, from unit directions of their x axes, by number, and lettered points.

        All are complex128 of shape (N,).
        """
        n = len(next(iter(directions.values())))
        angles, ways = np.zeros((self.count, n)), np.zeros((len(self.guides), n))
        for link, direction in directions.items():
            if self.angle_of[link]:
                angles[self.angle_of[link]] = np.angle(direction) - self._ahead[link]
        for j, pair in enumerate(self.guides):
            ways[j] = self._way(pair, angles, places)
        return Pose(angles, ways)

    def _way(self, pair: Prismatic, angles: Array, places: Mapping[str, Array]) -> Array:
        """Return how far the slider's point stands from the place through which the guide passes."""
        _, guide = pair.links
        turn = np.exp(1j * (angles[self.angle_of[guide]] + self._ahead[guide]))
        through = self._at(pair.through)
        if guide != FRAME:
            letter, origin = next(iter(self._m.link(guide).points.items()))
            through = places[letter] + turn * (through - self._at(origin))
        along = turn * cmath.rect(1.0, self._v[pair.direction])
        return np.real((places[pair.point] - through) * np.conj(along))

    # The sum, and how it changes.

    def value(self, form: Form, pose: Pose) -> Array:
        """Return a vector in every position, shape (N,)."""
        return self._turned(form, pose, np.exp(1j * pose.angles))

    def rate(self, form: Form, pose: Pose, rates: Pose) -> Array:
        """Return its first derivative by time."""
        turns = np.exp(1j * pose.angles)
        found = self._turned(form, pose, turns * (1j * rates.angles))
        for j, way in form.ways.items():
            found = found + turns[self.turner[j]] * way * rates.ways[j]
        return found

    def change(self, form: Form, pose: Pose, rates: Pose, changes: Pose) -> Array:
        """Return its second derivative by time."""
        turns = np.exp(1j * pose.angles)
        found = self._turned(form, pose, turns * (1j * changes.angles - rates.angles**2))
        for j, way in form.ways.items():
            k = self.turner[j]
            found = found + turns[k] * way * (changes.ways[j] + 2j * rates.angles[k] * rates.ways[j])
        return found

    def arm_of(self, form: Form, k: int, pose: Pose) -> Array | complex:
        """Return what turns with angle `k`, for an angle of zero."""
        ways = (way * pose.ways[j] for j, way in form.ways.items() if self.turner[j] == k)
        return sum(ways, start=form.parts.get(k, 0j))

    def _turned(self, form: Form, pose: Pose, turns: Array) -> Array:
        numbers = dict.fromkeys((*form.parts, *(self.turner[j] for j in form.ways)))
        found = np.zeros(pose.angles.shape[1], complex)
        for k in numbers:
            found = found + turns[k] * self.arm_of(form, k, pose)
        return found


class Closure:
    """A mechanism's closure equations with its numbers in SI, ready to be solved at any places of its driver."""

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

    def solve(self, near: Pose, places: Array, tolerance: float) -> Pose:
        """Find poses by Newton's method, from a pose `near` each place of the driver, float64 of shape (N,).

        A position is found when its last correction is smaller than the `tolerance`, in radians, and in parts of the
        mechanism's size; NaN where the corrections have no end.
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
        return Pose(np.where(held, pose.angles, NAN), np.where(held, pose.ways, NAN))

    def rates(self, pose: Pose, speed: float) -> Pose:
        """Return velocities at a speed of the driver, by a linear system."""
        return self._driven_by(pose, speed, lambda form, own: self.contours.rate(form, pose, own))

    def changes(self, pose: Pose, rates: Pose, acceleration: float = 0.0) -> Pose:
        """Return accelerations, by a linear system; `acceleration` is the driver's."""
        return self._driven_by(pose, acceleration, lambda form, own: self.contours.change(form, pose, rates, own))

    def _driven_by(self, pose: Pose, driver: float, gap: Callable[[Form, Pose], Array]) -> Pose:
        own = pose.like()
        row = own.ways[self._way] if self._angle is None else own.angles[self._angle]
        row[:] = driver
        found = self._solved(pose, [gap(form, own) for form in self.contours.closed])
        return Pose(found.angles + own.angles, found.ways + own.ways)

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
