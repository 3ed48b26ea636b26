"""A third solver: it knows constraint equations and their Jacobian, nothing of dyads, plans or their order.

Every link has a place and an angle. Positions come from Newton's method, velocities and accelerations from the
derivatives of the constraints, all reactions and the driving moment from one system with the transposed Jacobian.
Residuals are taken in extended precision, so that the double-precision solutions are refined to the last bits.
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
        self.v = {name: np.broadcast_to(np.asarray(value, LONG), self.size) for name, value in values.items()}
        self.v |= {"zero": np.zeros(self.size, LONG), "one": np.ones(self.size, LONG)}
        self.index = {link.number: i for i, link in enumerate(mechanism.links)}
        self._stand(start.astype(LONG))
        for _ in range(8):
            step = Refined(self.jacobian()).solve(self.residual()).reshape(self.q.shape)
            self._stand(self.q - step)
            if np.all(np.abs(step) <= CLOSE * self._sizes()):
                break
        self._move()
        self._balance()

    def _stand(self, q: Array) -> None:
        """Put the links there."""
        self.q = q
        self.cosines, self.sines = np.cos(q[:, :, 2]), np.sin(q[:, :, 2])

    def _sizes(self) -> Array:
        """Return what a step is small beside: the largest coordinate of each mechanism, and of angles a radian."""
        largest = np.abs(self.q[:, :, :2]).max(axis=(1, 2))
        return np.stack([largest, largest, np.ones_like(largest)], axis=1)[:, None, :]

    def local(self, number: int, point: str) -> tuple[Array, Array]:
        x, y = self.m.link(number).points[point]
        return self.v[x], self.v[y]

    def arm(self, number: int, xy: tuple[Array, Array]) -> tuple[Array, Array]:
        """Vector from a link's origin to a place on it."""
        if number == FRAME:
            return xy
        (x, y), i = xy, self.index[number]
        c, s = self.cosines[:, i], self.sines[:, i]
        return c * x - s * y, s * x + c * y

    def angle(self, number: int) -> Array:
        return np.zeros(self.size, LONG) if number == FRAME else self.q[:, self.index[number], 2]

    def place(self, number: int, xy: tuple[Array, Array]) -> tuple[Array, Array]:
        """Return where a place on a link stands."""
        if number == FRAME:
            return xy
        x, y = self.arm(number, xy)
        return self.q[:, self.index[number], 0] + x, self.q[:, self.index[number], 1] + y

    def pinned(self, pair: Revolute, number: int) -> tuple[Array, Array]:
        """Coordinates of a joint on one of its links."""
        if number == FRAME:
            assert pair.at is not None
            return self.v[pair.at[0]], self.v[pair.at[1]]
        return self.local(number, pair.point)

    def guide(self, pair: Prismatic) -> tuple[Array, Array, tuple[Array, Array], tuple[Array, Array]]:
        """Direction of the guide, the point on the slider, and the place on the guide link."""
        slider, guide = pair.links
        direction = self.angle(guide) + self.v[pair.direction]
        through = self.v[pair.through[0]], self.v[pair.through[1]]
        return np.cos(direction), np.sin(direction), self.local(slider, pair.point), through

    def residual(self) -> Array:
        rows: list[Array] = []
        for pair in self.m.pairs:
            if isinstance(pair, Revolute):
                (x, y), (z, w) = (self.place(number, self.pinned(pair, number)) for number in pair.links)
                rows += [x - z, y - w]
            else:
                c, s, point, through = self.guide(pair)
                (x, y), (z, w) = self.place(pair.links[0], point), self.place(pair.links[1], through)
                turn = self.angle(pair.links[0]) - self.angle(pair.links[1]) - self.v[pair.direction]
                rows += [np.sin(turn), c * (y - w) - s * (x - z) - self.v[pair.offset]]
        driver = self.m.driver
        if isinstance(driver, Driver):
            (x, y), (z, w) = (self.local(driver.link, point) for point in (driver.point, driver.pivot))
            rows.append(np.sin(self.angle(driver.link) + np.arctan2(y - w, x - z) - self.v[driver.angle]))
        else:
            c, s, _, (z, w) = self.guide(self.driving_guide())
            x, y = self.place(driver.link, self.local(driver.link, driver.point))
            rows.append(c * (x - z) + s * (y - w) - self.v[driver.travel])
        return np.stack(rows, axis=1)

    def driving_guide(self) -> Prismatic:
        """Guide of a sliding driver on the frame."""
        ends = {FRAME, self.m.driver.link}
        return next(pair for pair in self.m.pairs if isinstance(pair, Prismatic) and {*pair.links} == ends)

    def driven(self) -> tuple[Array, Array, Array]:
        """Generalised force of a unit of what balances the driver, which is also how its coordinate changes."""
        driver, one = self.m.driver, np.ones(self.size, LONG)
        if isinstance(driver, Driver):
            return 0 * one, 0 * one, one
        c, s, _, _ = self.guide(self.driving_guide())
        a, b = self.arm(driver.link, self.local(driver.link, driver.point))
        return c, s, a * s - b * c

    def balancing(self) -> tuple[Array, Array, Array]:
        """Generalised force on the driver of a unit of what balances it: a moment, or a force at its point."""
        driver = self.m.driver
        if not isinstance(driver, Driver) or driver.balance == MOMENT:
            return self.driven()
        (x, y), (z, w) = (self.arm(driver.link, self.local(driver.link, p)) for p in (driver.point, driver.pivot))
        length = np.sqrt((x - z) ** 2 + (y - w) ** 2)
        nx, ny = -(y - w) / length, (x - z) / length
        return nx, ny, x * ny - y * nx

    def jacobian(self) -> Array:
        matrix = np.zeros((self.size, 3 * self.count, 3 * self.count), LONG)
        row = 0

        def add(number: int, row: int, column: int, value: Any) -> None:
            if number != FRAME:
                matrix[:, row, 3 * self.index[number] + column] += value

        for pair in self.m.pairs:
            if isinstance(pair, Revolute):
                for number, sign in zip(pair.links, (1, -1), strict=True):
                    x, y = self.arm(number, self.pinned(pair, number))
                    add(number, row, 0, sign)
                    add(number, row, 2, -sign * y)
                    add(number, row + 1, 1, sign)
                    add(number, row + 1, 2, sign * x)
            else:
                slider, guide = pair.links
                c, s, point, through = self.guide(pair)
                add(slider, row, 2, 1)
                add(guide, row, 2, -1)
                (x, y), (z, w) = self.place(slider, point), self.place(guide, through)
                (a, b), (d, e) = self.arm(slider, point), self.arm(guide, through)
                add(slider, row + 1, 0, -s)
                add(slider, row + 1, 1, c)
                add(slider, row + 1, 2, c * a + s * b)
                add(guide, row + 1, 0, s)
                add(guide, row + 1, 1, -c)
                add(guide, row + 1, 2, -c * d - s * e - s * (y - w) - c * (x - z))
            row += 2
        for column, value in enumerate(self.driven()):
            add(self.m.driver.link, row, column, value)
        return matrix

    def _move(self) -> None:
        """Velocities and accelerations of the links."""
        driver, system = self.m.driver, Refined(self.jacobian())
        right = np.zeros((self.size, 3 * self.count), LONG)
        sense = self.v[driver.sense] if isinstance(driver, Driver) else self.v["one"]
        right[:, -1] = self.v[driver.speed] * sense
        self.dq = system.solve(right).reshape(self.q.shape)
        right = np.zeros((self.size, 3 * self.count), LONG)
        if driver.acceleration:
            right[:, -1] = self.v[driver.acceleration] * sense
        for i, pair in enumerate(self.m.pairs):
            rows = slice(2 * i, 2 * i + 2)
            right[:, rows] = self._pinned_rate(pair) if isinstance(pair, Revolute) else self._guided_rate(pair)
        self.ddq = system.solve(right).reshape(self.q.shape)

    def rate(self, number: int) -> Array:
        return np.zeros(self.size, LONG) if number == FRAME else self.dq[:, self.index[number], 2]

    def _pinned_rate(self, pair: Revolute) -> Array:
        total = np.zeros((self.size, 2), LONG)
        for number, sign in zip(pair.links, (1, -1), strict=True):
            square = sign * self.rate(number) ** 2
            total += np.stack([square * part for part in self.arm(number, self.pinned(pair, number))], axis=1)
        return total

    def _guided_rate(self, pair: Prismatic) -> Array:
        """Minus the second derivative of the guide's equation that is left when no link accelerates."""
        slider, guide = pair.links
        c, s, point, through = self.guide(pair)
        turn = self.rate(guide)
        (x, y), (z, w) = self.place(slider, point), self.place(guide, through)
        (vx, vy), (vz, vw) = self.velocity(slider, point), self.velocity(guide, through)
        ax, ay = (-(self.rate(slider) ** 2) * part for part in self.arm(slider, point))
        bx, by = (-(turn**2) * part for part in self.arm(guide, through))
        second = -(turn**2) * (c * (y - w) - s * (x - z)) + 2 * turn * (-s * (vy - vw) - c * (vx - vz))
        second = second + c * (ay - by) - s * (ax - bx)
        return np.stack([np.zeros(self.size, LONG), -second], axis=1)

    def velocity(self, number: int, xy: tuple[Array, Array]) -> tuple[Array, Array]:
        if number == FRAME:
            return np.zeros(self.size, LONG), np.zeros(self.size, LONG)
        (x, y), dq = self.arm(number, xy), self.dq[:, self.index[number]]
        return dq[:, 0] - dq[:, 2] * y, dq[:, 1] + dq[:, 2] * x

    def acceleration(self, number: int, xy: tuple[Array, Array]) -> tuple[Array, Array]:
        if number == FRAME:
            return np.zeros(self.size, LONG), np.zeros(self.size, LONG)
        (x, y), w = self.arm(number, xy), self.rate(number)
        ddq = self.ddq[:, self.index[number]]
        return ddq[:, 0] - ddq[:, 2] * y - w * w * x, ddq[:, 1] + ddq[:, 2] * x - w * w * y

    def _balance(self) -> None:
        """All reactions and the driving moment at once; power of the loads on the way."""
        right = np.zeros((self.size, self.count, 3), LONG)
        self.power = np.zeros(self.size, LONG)
        self.forces: dict[str, Array] = {}
        self.couples: dict[str, Array] = {}

        def act(number: int, point: str, fx: Array, fy: Array, name: str) -> None:
            x, y = self.arm(number, self.local(number, point))
            right[:, self.index[number]] -= np.stack([fx, fy, x * fy - y * fx], axis=1)
            vx, vy = self.velocity(number, self.local(number, point))
            self.power += fx * vx + fy * vy
            self.forces[name] = fx + 1j * fy

        for link in self.m.links:
            mass, inertia = self.inertia(link)
            if link.mass:
                a = self.acceleration(link.number, self.local(link.number, str(link.centre)))
                act(link.number, str(link.centre), *(-mass * part for part in a), f"F_i{link.number}")
                if self.m.gravity:
                    weight = mass * self.v[self.m.gravity]
                    act(link.number, str(link.centre), 0 * weight, -weight, f"G_{link.number}")
            moment = -inertia * self.ddq[:, self.index[link.number], 2]
            for couple in self.m.couples:
                if couple.link == link.number:
                    self.couples[couple.name] = self.couple(couple)
                    moment = moment + self.couples[couple.name]
            right[:, self.index[link.number], 2] -= moment
            self.power += moment * self.dq[:, self.index[link.number], 2]
        for load in self.m.loads:
            act(load.link, load.point, *self.load(load), load.name)
        matrix = self.jacobian()
        matrix[:, -1] = 0
        row = 3 * self.index[self.m.driver.link]
        matrix[:, -1, row : row + 3] = np.stack(self.balancing(), axis=1)
        self._read_reactions(Refined(matrix.transpose(0, 2, 1)).solve(right.reshape(self.size, -1)))

    def inertia(self, link: Link) -> tuple[Array, Array]:
        """Mass and moment of inertia of a link, given or by its length."""
        none = np.zeros(self.size, LONG)
        joints = {pair.point for pair in self.m.pairs if isinstance(pair, Revolute) and link.number in pair.links}
        length = none
        if link.per_length or link.inertia_factor:
            (x, y), (z, w) = (self.local(link.number, point) for point in joints)
            length = np.hypot(x - z, y - w)
        mass = self.v[link.per_length] * length if link.per_length else self.v[link.mass] if link.mass else none
        if link.inertia_factor:
            return mass, self.v[link.inertia_factor] * mass * length**2
        return mass, self.v[link.inertia] if link.inertia else none

    def load(self, load: Load) -> tuple[Array, Array]:
        """Components of an outer force."""
        size = self.magnitude(load)
        if load.direction is not None:
            return size * np.cos(self.v[load.direction]), size * np.sin(self.v[load.direction])
        x, y = self.velocity(load.link, self.local(load.link, load.point))
        speed = np.hypot(x, y)
        return -size * x / speed, -size * y / speed

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
        assert self.m.stroke is not None
        number = self.m.stroke.link
        pair = next(p for p in self.m.pairs if {*p.links} == {FRAME, number})
        if isinstance(pair, Revolute):
            return self.angle(number) + self.v["output_angle"], self.rate(number)
        c, s, point, (z, w) = self.guide(pair)
        (x, y), (vx, vy) = self.place(number, point), self.velocity(number, point)
        return c * (x - z) + s * (y - w), c * vx + s * vy

    def on_diagram(self, diagram: Diagram) -> Array:
        """Value of a load diagram, one position at a time."""
        turn = 2 * np.pi
        if diagram.over == ANGLE:
            x, at = self.v[self.m.driver.coordinate], [self.v[name] for name in diagram.at]
            x = at[0] + np.mod(x - at[0], turn)
            at.append(at[0] + turn)
            return self._interpolated(x, at, [*diagram.values, diagram.values[0]])
        place, _ = self.output()
        begin, end = self.v["_stroke_begin"], self.v["_stroke_end"]
        if isinstance(next(p for p in self.m.pairs if {*p.links} == {FRAME, self.m.stroke.link}), Revolute):
            middle = (begin + end) / 2
            place = middle + np.mod(place - middle + np.pi, turn) - np.pi
        x, at = (place - begin) / (end - begin), [self.v[name] for name in diagram.at]
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
        for i, pair in enumerate(self.m.pairs):
            first, second = pair.links
            parting = "_" if len(self.m.links) > 9 else ""  # links 12 and 10: R_12_10
            on_first, on_second = f"R_{second}{parting}{first}", f"R_{first}{parting}{second}"
            a, b = solved[:, 2 * i], solved[:, 2 * i + 1]
            if isinstance(pair, Revolute):
                force = a + 1j * b
            else:
                c, s, _, _ = self.guide(pair)
                force = b * (-s + 1j * c)
                self.moments[first, second, pair.point] = a, force
            self.reactions |= {on_first: force, on_second: -force}
        self.balance = solved[:, -1]

    @cached_property
    def expected(self) -> dict[str, Array]:
        """Everything that has a name of its own: points, their motion, links, forces."""
        name = "M_bal" if getattr(self.m.driver, "balance", "force") == MOMENT else "F_bal"
        row = self.index[self.m.driver.link]
        rate = sum(value * self.dq[:, row, column] for column, value in enumerate(self.balancing()))
        found = {**self.forces, **self.couples, **self.reactions, name: self.balance}
        found[f"{name}_lever"] = -self.power / rate
        still = [pair.point for pair in self.m.pairs if isinstance(pair, Revolute) and FRAME in pair.links]
        for link in self.m.links:
            i = self.index[link.number]
            found |= {f"omega_{link.number}": self.dq[:, i, 2], f"epsilon_{link.number}": self.ddq[:, i, 2]}
            for point in link.points:
                xy = self.local(link.number, point)
                found[point] = together(self.place(link.number, xy))
                if point not in still:
                    found[f"V_{point}"] = together(self.velocity(link.number, xy))
                    found[f"a_{point}"] = together(self.acceleration(link.number, xy))
        return found

    def under(self, number: int, point: Array) -> tuple[Array, Array]:
        """Velocity and acceleration of the point of a link that stands at `point`."""
        i = self.index[number]
        x, y = point.real - self.q[:, i, 0], point.imag - self.q[:, i, 1]
        w, e = self.dq[:, i, 2], self.ddq[:, i, 2]
        v = self.dq[:, i, 0] - w * y + 1j * (self.dq[:, i, 1] + w * x)
        a = self.ddq[:, i, 0] - e * y - w * w * x + 1j * (self.ddq[:, i, 1] + e * x - w * w * y)
        return v, a

    def moment_at(self, on: int, by: int, at: Array) -> Array:
        """Moment about `at` of the force by which one link of a prismatic pair acts on the other."""
        for (slider, guide, point), (couple, force) in self.moments.items():
            if {slider, guide} == {on, by}:
                where = together(self.place(slider, self.local(slider, point)))
                arm = where - at
                moment = couple + arm.real * force.imag - arm.imag * force.real
                return moment if on == slider else -moment
        raise KeyError((on, by))


def together(xy: tuple[Array, Array]) -> Array:
    """Return a vector as complex numbers."""
    return xy[0] + 1j * xy[1]
