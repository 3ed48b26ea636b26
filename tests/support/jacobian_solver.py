"""A third solver: it knows constraint equations and their Jacobian, nothing of dyads, plans or their order.

Every link has a place and an angle. Positions come from Newton's method, velocities and accelerations from the
derivatives of the constraints, all reactions and the driving moment from one system with the transposed Jacobian.
Residuals are taken in extended precision, so that the double-precision solutions are refined to the last bits.
Vectors are complex numbers.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from kulman.plans.linkages.mechanism import (
    ANGLE,
    FRAME,
    MOMENT,
    WORKING,
    Couple,
    Diagram,
    Driver,
    Link,
    Load,
    Mechanism,
    Prismatic,
    Revolute,
)

Array = NDArray[Any]
LONG = np.longdouble
ROUNDS = 4
CLOSE = 1e-12  # parts of a step of Newton's method that leaves its square


def dot(u: Array, w: Array) -> Array:
    return np.real(np.conj(u) * w)


def cross(u: Array, w: Array) -> Array:
    return np.imag(np.conj(u) * w)


def wrench(arm: Array, force: Array) -> Array:
    """Return a force and its moment; of a unit vector, how its part of a place changes with a link's coordinates."""
    arm, force = np.broadcast_arrays(arm, force)
    return np.stack([force.real, force.imag, cross(arm, force)], axis=1)


class Refined:
    """Many linear systems, rows and columns scaled, the residual refined in extended precision."""

    def __init__(self, matrix: Array) -> None:
        self.rows = np.abs(matrix).max(axis=2)
        scaled = matrix / self.rows[:, :, None]
        self.columns = np.abs(scaled).max(axis=1)
        self.scaled = scaled / self.columns[:, None, :]
        self.inverse = np.linalg.inv(self.scaled.astype(float)).astype(LONG)

    def solve(self, right: Array) -> Array:
        right = right / self.rows
        found = np.einsum("nij,nj->ni", self.inverse, right)
        for _ in range(ROUNDS - 1):
            left = right - np.einsum("nij,nj->ni", self.scaled, found)
            found = found + np.einsum("nij,nj->ni", self.inverse, left)
        return found / self.columns


class JacobianSolver:
    """Many positions of one mechanism; `start` are rough places (x, y, angle) of its links, shape (N, links, 3)."""

    def __init__(self, mechanism: Mechanism, values: Mapping[str, Any], start: Array) -> None:
        self.m = mechanism
        self.size, self.count = len(start), len(mechanism.links)
        self.none = np.zeros(self.size, LONG)
        self.v = {name: np.broadcast_to(np.asarray(value, LONG), self.size) for name, value in values.items()}
        self.v |= {"zero": self.none, "one": self.none + 1}
        self.index = {link.number: i for i, link in enumerate(mechanism.links)}
        self.q = start.astype(LONG)
        for _ in range(8):
            step = Refined(self.jacobian()).solve(self.residual()).reshape(self.q.shape)
            self.q = self.q - step
            # small beside the largest coordinate of each mechanism, of angles beside a radian
            sizes = np.abs(self.q[:, :, :2]).max(axis=(1, 2))[:, None, None] * [1, 1, 0] + np.array([0, 0, 1])
            if np.all(np.abs(step) <= CLOSE * sizes):
                break
        self._move()
        self._balance()

    def at(self, xy: tuple[str, str]) -> Array:
        """Return a place of given coordinates."""
        return self.v[xy[0]] + 1j * self.v[xy[1]]

    def local(self, number: int, point: str) -> Array:
        return self.at(self.m.link(number).points[point])

    def angle(self, number: int) -> Array:
        return self.none if number == FRAME else self.q[:, self.index[number], 2]

    def origin(self, number: int) -> Array:
        return self._vector(self.q, number)

    def _vector(self, of: Array, number: int) -> Array:
        """Return the first two coordinates of a link, or their derivatives."""
        return 1j * self.none if number == FRAME else of[:, self.index[number], 0] + 1j * of[:, self.index[number], 1]

    def arm(self, number: int, place: Array) -> Array:
        """Vector from a link's origin to a place on it."""
        return place * (np.cos(self.angle(number)) + 1j * np.sin(self.angle(number)))

    def place(self, number: int, place: Array) -> Array:
        """Return where a place on a link stands."""
        return self.origin(number) + self.arm(number, place)

    def pinned(self, pair: Revolute, number: int) -> Array:
        """Coordinates of a joint on one of its links."""
        if number != FRAME:
            return self.local(number, pair.point)
        assert pair.at is not None
        return self.at(pair.at)

    def guide(self, pair: Prismatic) -> tuple[Array, Array, Array]:
        """Direction of the guide, the point on the slider, and the place on the guide link."""
        slider, guide = pair.links
        direction = self.angle(guide) + self.v[pair.direction]
        return np.cos(direction) + 1j * np.sin(direction), self.local(slider, pair.point), self.at(pair.through)

    def driving_guide(self) -> Prismatic:
        """Guide of a sliding driver on the frame."""
        ends = {FRAME, self.m.driver.link}
        return next(pair for pair in self.m.pairs if isinstance(pair, Prismatic) and {*pair.links} == ends)

    def residual(self) -> Array:
        rows: list[Array] = []
        for pair in self.m.pairs:
            if isinstance(pair, Revolute):
                first, second = (self.place(number, self.pinned(pair, number)) for number in pair.links)
                rows += [(first - second).real, (first - second).imag]
            else:
                u, point, through = self.guide(pair)
                turn = self.angle(pair.links[0]) - self.angle(pair.links[1]) - self.v[pair.direction]
                way = self.place(pair.links[0], point) - self.place(pair.links[1], through)
                rows += [np.sin(turn), cross(u, way) - self.v[pair.offset]]
        driver = self.m.driver
        if isinstance(driver, Driver):
            crank = self.local(driver.link, driver.point) - self.local(driver.link, driver.pivot)
            rows.append(np.sin(self.angle(driver.link) + np.angle(crank) - self.v[driver.angle]))
        else:
            u, _, through = self.guide(self.driving_guide())
            at = self.place(driver.link, self.local(driver.link, driver.point))
            rows.append(dot(u, at - through) - self.v[driver.travel])
        return np.stack(rows, axis=1)

    def driven(self) -> Array:
        """Generalised force of a unit of what balances the driver, which is also how its coordinate changes."""
        driver = self.m.driver
        if isinstance(driver, Driver):
            return np.stack([self.none, self.none, self.none + 1], axis=1)
        arm = self.arm(driver.link, self.local(driver.link, driver.point))
        return wrench(arm, self.guide(self.driving_guide())[0])

    def balancing(self) -> Array:
        """Generalised force on the driver of a unit of what balances it: a moment, or a force at its point."""
        driver = self.m.driver
        if not isinstance(driver, Driver) or driver.balance == MOMENT:
            return self.driven()
        end, pivot = (self.arm(driver.link, self.local(driver.link, p)) for p in (driver.point, driver.pivot))
        return wrench(end, 1j * (end - pivot) / np.abs(end - pivot))

    def jacobian(self) -> Array:
        matrix = np.zeros((self.size, 3 * self.count, 3 * self.count), LONG)

        def add(number: int, row: int, parts: Any) -> None:
            if number != FRAME:
                matrix[:, row, 3 * self.index[number] : 3 * self.index[number] + 3] += parts

        for i, pair in enumerate(self.m.pairs):
            if isinstance(pair, Revolute):
                for number, sign in zip(pair.links, (1, -1), strict=True):
                    arm = self.arm(number, self.pinned(pair, number))
                    add(number, 2 * i, sign * wrench(arm, 1 + 0 * arm))
                    add(number, 2 * i + 1, sign * wrench(arm, 1j + 0 * arm))
            else:
                slider, guide = pair.links
                u, point, through = self.guide(pair)
                way = self.place(slider, point) - self.place(guide, through)
                add(slider, 2 * i, [0, 0, 1])
                add(guide, 2 * i, [0, 0, -1])
                add(slider, 2 * i + 1, wrench(self.arm(slider, point), 1j * u))
                add(guide, 2 * i + 1, -wrench(self.arm(guide, through) + way, 1j * u))  # the guide's normal turns, too
        add(self.m.driver.link, 2 * len(self.m.pairs), self.driven())
        return matrix

    def _move(self) -> None:
        """Velocities and accelerations of the links."""
        driver, system = self.m.driver, Refined(self.jacobian())
        right = np.zeros((self.size, 3 * self.count), LONG)
        sense = self.v[driver.sense] if isinstance(driver, Driver) else self.v["one"]
        right[:, -1] = self.v[driver.speed] * sense
        self.dq = system.solve(right).reshape(self.q.shape)
        right[:, -1] = self.v[driver.acceleration] * sense if driver.acceleration else 0
        for i, pair in enumerate(self.m.pairs):
            if isinstance(pair, Revolute):
                first, second = (self.rate(n) ** 2 * self.arm(n, self.pinned(pair, n)) for n in pair.links)
                right[:, 2 * i], right[:, 2 * i + 1] = (first - second).real, (first - second).imag
            else:
                right[:, 2 * i + 1] = self._guided_rate(pair)
        self.ddq = system.solve(right).reshape(self.q.shape)

    def rate(self, number: int) -> Array:
        return self.none if number == FRAME else self.dq[:, self.index[number], 2]

    def _guided_rate(self, pair: Prismatic) -> Array:
        """Minus the second derivative of the guide's equation that is left when no link accelerates."""
        (slider, guide), (u, point, through) = pair.links, self.guide(pair)
        turn = self.rate(guide)
        way = self.place(slider, point) - self.place(guide, through)
        v = self.velocity(slider, point) - self.velocity(guide, through)
        a = turn**2 * self.arm(guide, through) - self.rate(slider) ** 2 * self.arm(slider, point)
        return turn**2 * cross(u, way) + 2 * turn * dot(u, v) - cross(u, a)

    def velocity(self, number: int, place: Array) -> Array:
        return self._vector(self.dq, number) + 1j * self.rate(number) * self.arm(number, place)

    def acceleration(self, number: int, place: Array) -> Array:
        turn = 1j * self.ddq[:, self.index[number], 2] - self.rate(number) ** 2
        return self._vector(self.ddq, number) + turn * self.arm(number, place)

    def under(self, number: int, point: Array) -> tuple[Array, Array]:
        """Velocity and acceleration of the point of a link that stands at `point`."""
        place = (point - self.origin(number)) / self.arm(number, 1 + 0 * point)
        return self.velocity(number, place), self.acceleration(number, place)

    def _balance(self) -> None:
        """All reactions and the driving moment at once; power of the loads on the way."""
        right = np.zeros((self.size, self.count, 3), LONG)
        self.power = self.none
        self.forces: dict[str, Array] = {}
        self.couples: dict[str, Array] = {}

        def act(number: int, point: str, force: Array, name: str) -> None:
            place = self.local(number, point)
            right[:, self.index[number]] -= wrench(self.arm(number, place), force)
            self.power = self.power + dot(force, self.velocity(number, place))
            self.forces[name] = force

        for link in self.m.links:
            i, centre = self.index[link.number], str(link.centre)
            mass, inertia = self.inertia(link)
            if link.mass:
                act(
                    link.number,
                    centre,
                    -mass * self.acceleration(link.number, self.local(link.number, centre)),
                    f"F_i{link.number}",
                )
                if self.m.gravity:
                    act(link.number, centre, -1j * mass * self.v[self.m.gravity], f"G_{link.number}")
            own = {couple.name: self.couple(couple) for couple in self.m.couples if couple.link == link.number}
            moment = -inertia * self.ddq[:, i, 2] + sum(own.values())
            self.couples |= own
            right[:, i, 2] -= moment
            self.power = self.power + moment * self.dq[:, i, 2]
        for load in self.m.loads:
            act(load.link, load.point, self.load(load), load.name)
        matrix = self.jacobian()
        matrix[:, -1] = 0
        row = 3 * self.index[self.m.driver.link]
        matrix[:, -1, row : row + 3] = self.balancing()
        self._read_reactions(Refined(matrix.transpose(0, 2, 1)).solve(right.reshape(self.size, -1)))

    def inertia(self, link: Link) -> tuple[Array, Array]:
        """Mass and moment of inertia of a link, given or by its length."""
        joints = {pair.point for pair in self.m.pairs if isinstance(pair, Revolute) and link.number in pair.links}
        length = self.none
        if link.per_length or link.inertia_factor:
            first, second = (self.local(link.number, point) for point in joints)
            length = np.abs(first - second)
        mass = self.v[link.per_length] * length if link.per_length else self.v[link.mass] if link.mass else self.none
        if link.inertia_factor:
            return mass, self.v[link.inertia_factor] * mass * length**2
        return mass, self.v[link.inertia] if link.inertia else self.none

    def load(self, load: Load) -> Array:
        """Outer force."""
        size = self.magnitude(load)
        if load.direction is not None:
            return size * (np.cos(self.v[load.direction]) + 1j * np.sin(self.v[load.direction]))
        v = self.velocity(load.link, self.local(load.link, load.point))
        return -size * v / np.abs(v)

    def couple(self, couple: Couple) -> Array:
        """Outer moment."""
        rate = self.rate(couple.link)
        turns = np.abs(rate) > 1e-14 * np.abs(self.dq[:, :, 2]).max(axis=1)
        sense = self.v[couple.sense] if couple.sense is not None else -np.sign(rate) * turns
        return np.asarray(self.magnitude(couple) * sense)

    def magnitude(self, load: Load | Couple) -> Array:
        """Size of a load: zero in the stroke in which it does not act."""
        diagram = next((d for d in self.m.diagrams if d.name == load.magnitude), None)
        size = self.v[load.magnitude] if diagram is None else self.on_diagram(diagram)
        if load.stroke == "both":
            return size
        return np.where(self.works() == (load.stroke == WORKING), size, 0)

    def works(self) -> Array:
        """Whether the output is in its working stroke."""
        assert self.m.stroke is not None
        return np.asarray(self.output()[1] * self.v[self.m.stroke.sense] > 0)

    def output(self) -> tuple[Array, Array]:
        """Place and velocity of the output: metres along the guide, radians of the direction in which it is given."""
        pair, number = self.output_pair()
        if isinstance(pair, Revolute):
            return self.angle(number) + self.v["output_angle"], self.rate(number)
        u, point, through = self.guide(pair)
        return dot(u, self.place(number, point) - through), dot(u, self.velocity(number, point))

    def output_pair(self) -> tuple[Revolute | Prismatic, int]:
        assert self.m.stroke is not None
        number = self.m.stroke.link
        return next(p for p in self.m.pairs if {*p.links} == {FRAME, number}), number

    def on_diagram(self, diagram: Diagram) -> Array:
        """Value of a load diagram, one position at a time."""
        turn, at = 2 * np.pi, [self.v[name] for name in diagram.at]
        if diagram.over == ANGLE:
            x = at[0] + np.mod(self.v[self.m.driver.coordinate] - at[0], turn)
            return self._interpolated(x, [*at, at[0] + turn], [*diagram.values, diagram.values[0]])
        place, _ = self.output()
        begin, end = self.v["_stroke_begin"], self.v["_stroke_end"]
        if isinstance(self.output_pair()[0], Revolute):
            middle = (begin + end) / 2
            place = middle + np.mod(place - middle + np.pi, turn) - np.pi
        x = (place - begin) / (end - begin)
        forth = self._interpolated(x, at, list(diagram.values))
        return forth if diagram.back is None else np.where(self.works(), forth, self._interpolated(x, at, diagram.back))

    def _interpolated(self, x: Array, at: list[Array], names: Any) -> Array:
        values = [self.v[name] for name in names]
        found = np.where(x <= at[0], values[0], values[-1])
        for a, b, low, high in zip(at, at[1:], values, values[1:], strict=False):
            wide = b > a
            line = low + (high - low) * (x - a) / np.where(wide, b - a, 1)
            found = np.where(wide & (a < x) & (x <= b), line, found)
        return np.asarray(found)

    def _read_reactions(self, solved: Array) -> None:
        self.reactions: dict[str, Array] = {}
        self.moments: dict[tuple[int, int, str], tuple[Array, Array]] = {}
        parting = "_" if self.count > 9 else ""  # links 12 and 10: R_12_10
        for i, pair in enumerate(self.m.pairs):
            first, second = pair.links
            a, b = solved[:, 2 * i], solved[:, 2 * i + 1]
            force = a + 1j * b
            if isinstance(pair, Prismatic):
                force = 1j * b * self.guide(pair)[0]
                self.moments[first, second, pair.point] = a, force
            self.reactions |= {f"R_{second}{parting}{first}": force, f"R_{first}{parting}{second}": -force}
        self.balance = solved[:, -1]

    @cached_property
    def expected(self) -> dict[str, Array]:
        """Everything that has a name of its own: points, their motion, links, forces."""
        name = "M_bal" if getattr(self.m.driver, "balance", "force") == MOMENT else "F_bal"
        rate = np.sum(self.balancing() * self.dq[:, self.index[self.m.driver.link]], axis=1)
        found = {**self.forces, **self.couples, **self.reactions, name: self.balance}
        found[f"{name}_lever"] = -self.power / rate
        still = [pair.point for pair in self.m.pairs if isinstance(pair, Revolute) and FRAME in pair.links]
        for link in self.m.links:
            i = self.index[link.number]
            found |= {f"omega_{link.number}": self.dq[:, i, 2], f"epsilon_{link.number}": self.ddq[:, i, 2]}
            for point in link.points:
                place = self.local(link.number, point)
                found[point] = self.place(link.number, place)
                if point not in still:
                    found[f"V_{point}"] = self.velocity(link.number, place)
                    found[f"a_{point}"] = self.acceleration(link.number, place)
        return found

    def moment_at(self, on: int, by: int, at: Array) -> Array:
        """Moment about `at` of the force by which one link of a prismatic pair acts on the other."""
        for (slider, guide, point), (couple, force) in self.moments.items():
            if {slider, guide} == {on, by}:
                moment = couple + cross(self.place(slider, self.local(slider, point)) - at, force)
                return moment if on == slider else -moment
        raise KeyError((on, by))
