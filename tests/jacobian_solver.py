"""A third solver: it knows constraint equations and their Jacobian, nothing of dyads, plans or their order.

Every link has a place and an angle. Positions come from Newton's method, velocities and accelerations from the
derivatives of the constraints, all reactions and the driving moment from one system with the transposed Jacobian.
Residuals are taken in extended precision, so that the double-precision solutions are refined to the last bits.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from kulman.plans.linkages.mechanism import FRAME, Mechanism, Prismatic, Revolute

Array = NDArray[Any]
LONG = np.longdouble
ROUNDS = 4


def turned(angle: Array, x: Array, y: Array) -> tuple[Array, Array]:
    """Turn a vector by an angle."""
    c, s = np.cos(angle), np.sin(angle)
    return c * x - s * y, s * x + c * y


def refined(matrix: Array, right: Array) -> Array:
    """Solve many linear systems, rows and columns scaled, the residual refined in extended precision."""
    rows = np.abs(matrix).max(axis=2)
    scaled = matrix / rows[:, :, None]
    columns = np.abs(scaled).max(axis=1)
    scaled = scaled / columns[:, None, :]
    inverse, right = np.linalg.inv(scaled.astype(float)).astype(LONG), right / rows
    found = np.zeros_like(right)
    for _ in range(ROUNDS):
        left = right - np.einsum("nij,nj->ni", scaled, found)
        found = found + np.einsum("nij,nj->ni", inverse, left)
    return found / columns


class JacobianSolver:
    """Many positions of one mechanism; `start` are rough places (x, y, angle) of its links, shape (N, links, 3)."""

    def __init__(self, mechanism: Mechanism, values: Mapping[str, Any], start: Array) -> None:
        self.m = mechanism
        self.size, self.count = len(start), len(mechanism.links)
        self.v = {name: np.broadcast_to(np.asarray(value, LONG), self.size) for name, value in values.items()}
        self.v |= {"zero": np.zeros(self.size, LONG), "one": np.ones(self.size, LONG)}
        self.index = {link.number: i for i, link in enumerate(mechanism.links)}
        self.q = start.astype(LONG)
        for _ in range(8):
            self.q = self.q - refined(self.jacobian(), self.residual()).reshape(self.q.shape)
        self._move()
        self._balance()

    def local(self, number: int, point: str) -> tuple[Array, Array]:
        x, y = self.m.link(number).points[point]
        return self.v[x], self.v[y]

    def arm(self, number: int, xy: tuple[Array, Array]) -> tuple[Array, Array]:
        """Vector from a link's origin to a place on it."""
        return turned(self.angle(number), *xy)

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
        (x, y), (z, w) = (self.local(driver.link, point) for point in (driver.point, driver.pivot))
        rows.append(np.sin(self.angle(driver.link) + np.arctan2(y - w, x - z) - self.v[driver.angle]))
        return np.stack(rows, axis=1)

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
        add(self.m.driver.link, row, 2, 1)
        return matrix

    def _move(self) -> None:
        """Velocities and accelerations of the links."""
        driver, matrix = self.m.driver, self.jacobian()
        right = np.zeros((self.size, 3 * self.count), LONG)
        right[:, -1] = self.v[driver.speed] * self.v[driver.sense]
        self.dq = refined(matrix, right).reshape(self.q.shape)
        right = np.zeros((self.size, 3 * self.count), LONG)
        if driver.acceleration:
            right[:, -1] = self.v[driver.acceleration] * self.v[driver.sense]
        for i, pair in enumerate(self.m.pairs):
            rows = slice(2 * i, 2 * i + 2)
            right[:, rows] = self._pinned_rate(pair) if isinstance(pair, Revolute) else self._guided_rate(pair)
        self.ddq = refined(matrix, right).reshape(self.q.shape)

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

        def act(number: int, point: str, fx: Array, fy: Array, name: str) -> None:
            x, y = self.arm(number, self.local(number, point))
            right[:, self.index[number]] -= np.stack([fx, fy, x * fy - y * fx], axis=1)
            vx, vy = self.velocity(number, self.local(number, point))
            self.power += fx * vx + fy * vy
            self.forces[name] = fx + 1j * fy

        for link in self.m.links:
            moment = np.zeros(self.size, LONG)
            if link.mass:
                a = self.acceleration(link.number, self.local(link.number, str(link.centre)))
                act(link.number, str(link.centre), *(-self.v[link.mass] * part for part in a), f"F_i{link.number}")
            if link.inertia:
                moment = moment - self.v[link.inertia] * self.ddq[:, self.index[link.number], 2]
            for couple in self.m.couples:
                if couple.link == link.number:
                    moment = moment + self.v[couple.magnitude] * self.v[couple.sense]
            right[:, self.index[link.number], 2] -= moment
            self.power += moment * self.dq[:, self.index[link.number], 2]
        for load in self.m.loads:
            size, angle = self.v[load.magnitude], self.v[load.direction]
            act(load.link, load.point, size * np.cos(angle), size * np.sin(angle), load.name)
        solved = refined(self.jacobian().transpose(0, 2, 1), right.reshape(self.size, -1))
        self._read_reactions(solved)

    def _read_reactions(self, solved: Array) -> None:
        self.reactions: dict[str, Array] = {}
        self.moments: dict[tuple[int, int, str], tuple[Array, Array]] = {}
        for i, pair in enumerate(self.m.pairs):
            first, second = pair.links
            on_first, on_second = f"R_{second}{first}", f"R_{first}{second}"
            a, b = solved[:, 2 * i], solved[:, 2 * i + 1]
            if isinstance(pair, Revolute):
                force = a + 1j * b
            else:
                c, s, _, _ = self.guide(pair)
                force = b * (-s + 1j * c)
                self.moments[first, second, pair.point] = a, force
            self.reactions |= {on_first: force, on_second: -force}
        self.M_bal = solved[:, -1]

    def expected(self) -> dict[str, Array]:
        """Everything that has a name of its own: points, their motion, links, forces."""
        found = {**self.forces, **self.reactions, "M_bal": self.M_bal}
        found["M_bal_lever"] = -self.power / self.rate(self.m.driver.link)
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
