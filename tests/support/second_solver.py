"""A second solver: closures at 60 digits, numerical derivatives, one linear system for all forces. Slow and obvious.

It shares the mechanism's data with the code under test and nothing else: positions are roots of |AB|^2 = l^2,
velocities and accelerations are central differences of positions, all reactions and the balancing moment are solved at
once from three equilibrium equations a link, moments taken about the origin; a second balancing moment comes from
virtual power.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from mpmath import mp, mpf

from kulman.plans.linkages.mechanism import Mechanism, Prismatic, Revolute

mp.dps = 60
STEP = mpf(10) ** -13  # rad; the differences keep 26 of the 60 digits


class SecondSolver:
    """One position of driver and slider dyads; everything by name in `quantities`."""

    def __init__(self, mechanism: Mechanism, values: Mapping[str, float]) -> None:
        self.m = mechanism
        self.v = {"zero": mpf(0), **{name: mpf(value) for name, value in values.items()}}
        self.quantities: dict[str, Any] = {}
        self.dyads = self._dyads()
        self._move()
        self._weigh()
        self._balance()
        self._read()

    def _dyads(self) -> list[tuple[int, int, int, str, str, Prismatic]]:
        """Return (link before, rod, slider, A, B, guide) of each dyad, in order of attachment."""
        found, known, left = [], {0, 1}, [p for p in self.m.pairs if isinstance(p, Prismatic)]
        while left:
            for guide in left:
                slider = guide.links[0]
                pin = next(p for p in self.m.pairs if isinstance(p, Revolute) and slider in p.links)
                rod = sum(pin.links) - slider
                pins = [p for p in self.m.pairs if isinstance(p, Revolute) and rod in p.links]
                outer = next(p for p in pins if set(p.links) & known)
                before = sum(outer.links) - rod
                if before in known:
                    found.append((before, rod, slider, outer.point, pin.point, guide))
                    known |= {rod, slider}
                    left.remove(guide)
                    break
        return found

    def _along(self, guide: Prismatic) -> Any:
        return mp.expj(self.v[guide.direction])

    def positions(self, phi: Any) -> dict[str, Any]:
        """Return all points of the mechanism with the crank at `phi`."""
        v, driver = self.v, self.m.driver
        pivot = next(p for p in self.m.pairs if p.point == driver.pivot)
        assert isinstance(pivot, Revolute)
        assert pivot.at is not None
        at = mp.mpc(v[pivot.at[0]], v[pivot.at[1]])
        points = {name: at + mp.mpc(v[x], v[y]) * mp.expj(phi) for name, (x, y) in self.m.link(1).points.items()}
        for _, rod, _, A, B, guide in self.dyads:
            u, length = self._along(guide), v[self.m.link(rod).points[B][0]]
            start = mp.mpc(v[guide.through[0]], v[guide.through[1]]) + 1j * u * v[guide.offset]
            # s^2 + b s + c = 0 for B = start + s u
            b = 2 * mp.re((start - points[A]) * mp.conj(u))
            c = abs(start - points[A]) ** 2 - length**2
            s = (-b + v.get(str(guide.branch), mpf(1)) * mp.sqrt(b * b - 4 * c)) / 2
            points[B] = start + s * u
            for name, (x, _) in self.m.link(rod).points.items():
                points[name] = points[A] + (points[B] - points[A]) * v[x] / length
        return points

    def _move(self) -> None:
        """Differentiate the points and the rods' angles."""
        v, q, driver = self.v, self.quantities, self.m.driver
        self.omega_1 = v[driver.speed] * v[driver.sense]
        before, now, after = (self.positions(v[driver.angle] + i * STEP) for i in (-1, 0, 1))
        self.points = now
        self.V = {P: self.omega_1 * (after[P] - before[P]) / (2 * STEP) for P in now}
        self.a = {P: self.omega_1**2 * (after[P] - 2 * now[P] + before[P]) / STEP**2 for P in now}
        self.omega, self.epsilon = {1: self.omega_1}, {1: mpf(0)}
        for _, rod, slider, A, B, _ in self.dyads:
            earlier, present, later = (points[B] - points[A] for points in (before, now, after))
            self.omega[rod] = self.omega_1 * mp.arg(later / earlier) / (2 * STEP)
            self.epsilon[rod] = self.omega_1**2 * mp.arg(later * earlier / present**2) / STEP**2
            self.omega[slider] = self.epsilon[slider] = mpf(0)
        q.update(now)
        q.update({f"V_{P}": vector for P, vector in self.V.items() if driver.pivot != P})
        q.update({f"a_{P}": vector for P, vector in self.a.items() if driver.pivot != P})
        q["omega_1"] = self.omega_1

    def _weigh(self) -> None:
        """Collect loads, forces and moments of inertia: (name, force, point) and moments by link."""
        v = self.v
        self.loads: dict[int, list[tuple[str, Any, str]]] = {link.number: [] for link in self.m.links}
        self.moments = {link.number: mpf(0) for link in self.m.links}
        for link in self.m.links:
            if link.mass and link.centre != self.m.driver.pivot:
                centre = str(link.centre)
                self.loads[link.number].append((f"F_i{link.number}", -v[link.mass] * self.a[centre], centre))
            if link.inertia:
                self.moments[link.number] = -v[link.inertia] * self.epsilon[link.number]
                self.quantities[f"M_i{link.number}"] = self.moments[link.number]
        for load in self.m.loads:
            force = v[load.magnitude] * mp.expj(v[load.direction])
            self.loads[load.link].append((load.name, force, load.point))
        self.quantities.update({name: force for forces in self.loads.values() for name, force, _ in forces})

    def _balance(self) -> None:
        """Solve the equilibrium of all links at once."""
        count = len(self.m.links)
        matrix, right = mp.zeros(3 * count, 3 * count), mp.zeros(3 * count, 1)
        column = 0
        parts: dict[tuple[int, int], list[tuple[int, Any]]] = {}

        def act(link: int, at: Any, force: Any) -> None:
            row = 3 * (link - 1)
            for offset, part in enumerate((mp.re(force), mp.im(force), mp.im(mp.conj(at) * force))):
                matrix[row + offset, column] += part

        for pair in self.m.pairs:
            i, j = pair.links
            if isinstance(pair, Revolute):
                for unit in (mpf(1), mp.mpc(0, 1)):
                    for link, sign in ((j, 1), (i, -1)):
                        if link:
                            act(link, self.points[pair.point], sign * unit)
                    parts.setdefault((i, j), []).append((column, unit))
                    column += 1
            else:
                act(i, self.points[pair.point], 1j * self._along(pair))
                parts[j, i] = [(column, 1j * self._along(pair))]
                matrix[3 * (i - 1) + 2, column + 1] = 1
                self.quantities[f"_couple_{i}"] = column + 1
                column += 2
        matrix[2, column] = 1
        for link, forces in self.loads.items():
            row = 3 * (link - 1)
            for _, force, point in forces:
                right[row] -= mp.re(force)
                right[row + 1] -= mp.im(force)
                right[row + 2] -= mp.im(mp.conj(self.points[point]) * force)
            right[row + 2] -= self.moments[link]
        solved = mp.lu_solve(matrix, right)
        self.R: dict[tuple[int, int], Any] = {}
        for (i, j), columns in parts.items():
            self.R[i, j] = sum(solved[k] * unit for k, unit in columns)
            self.R[j, i] = -self.R[i, j]
        self.couples = {i: solved[self.quantities.pop(f"_couple_{i}")] for _, _, i, *_ in self.dyads}
        self.M_bal = solved[column]
        self.power = sum(mp.re(mp.conj(f) * self.V[P]) for forces in self.loads.values() for _, f, P in forces)
        self.power += sum(self.moments[k] * self.omega[k] for k in self.moments)

    def _read(self) -> None:
        """Name what a student reads off the plans."""
        q, driver = self.quantities, self.m.driver
        q["M_bal"], q["M_bal_lever"] = self.M_bal, -self.power / self.omega_1
        q["F_bal"] = q["M_bal_lever"] / abs(self.points[driver.point] - self.points[driver.pivot])
        q["delta_M_bal"] = mpf(0)
        q["R_01"] = self.R[0, 1]
        pivot = self.points[driver.pivot]
        for name, force, point in self.loads[1]:
            q["h_1" if name == "F_i1" else f"h_{name}"] = self._arm(force, self.points[point] - pivot)
        crank = (self.points[driver.point] - pivot) / abs(self.points[driver.point] - pivot)
        q[f"e_{driver.pivot}{driver.point}"], q[f"n_{driver.pivot}{driver.point}"] = crank, 1j * crank
        for load in self.m.loads:
            q[f"e_{load.name}"] = mp.expj(self.v[load.direction])
        for forces in self.loads.values():
            for name, force, point in forces:
                if point != driver.pivot:
                    q[f"h_lever_{name}"] = self._arm(force, 1j * self.V[point])
        for dyad in self.dyads:
            self._read_dyad(*dyad)

    def _read_dyad(self, i: int, j: int, k: int, A: str, B: str, guide: Prismatic) -> None:
        q, u, R = self.quantities, self._along(guide), self.R
        rod = self.points[B] - self.points[A]
        length = self.v[self.m.link(j).points[B][0]]
        e = rod / length
        q[f"e_{A}{B}"], q[f"n_{A}{B}"], q[f"u_{k}0"], q[f"n_u_{k}0"] = e, 1j * e, u, 1j * u
        q[f"V_{B}{A}"], q[f"a_{B}{A}"] = self.V[B] - self.V[A], self.a[B] - self.a[A]
        q[f"a_{B}{A}_n"], q[f"a_{B}{A}_t"] = -(self.omega[j] ** 2) * rod, 1j * self.epsilon[j] * rod
        q[f"omega_{j}"], q[f"epsilon_{j}"] = self.omega[j], self.epsilon[j]
        for first, second in ((i, j), (j, i), (j, k), (k, j), (0, k)):
            q[f"R_{first}{second}"] = R[first, second]
        q[f"R_{i}{j}_n"] = e * mp.re(mp.conj(e) * R[i, j])
        q[f"R_{i}{j}_t"] = 1j * e * mp.im(mp.conj(e) * R[i, j])
        for name, force, point in self.loads[j]:
            if point != B:
                arm = f"h_{j}" if name == f"F_i{j}" else f"h_{name}"
                q[arm] = self._arm(force, self.points[point] - self.points[B])
        q[f"M_0{k}"] = self.couples[k]
        q[f"h_0{k}"] = abs(self.couples[k]) / abs(R[0, k]) if abs(self.couples[k]) > mpf(10) ** -40 else mpf(0)
        turns_about = {1: self.m.driver.pivot, **{rod: B for _, rod, _, _, B, _ in self.dyads}}[i]
        q[f"h_{j}{i}"] = self._arm(R[j, i], self.points[A] - self.points[turns_about])
        if self.m.link(j).inertia:
            pair = self.moments[j] / length
            q[f"F_i{j}_couple"] = pair
            q[f"F_i{j}_couple_{B}"], q[f"F_i{j}_couple_{A}"] = pair * 1j * e, -pair * 1j * e
            for point in (A, B):
                q[f"h_lever_M_i{j}_{point}"] = self._arm(1j * e, 1j * self.V[point])

    @staticmethod
    def _arm(force: Any, from_pole: Any) -> Any:
        return abs(mp.im(mp.conj(from_pole) * force)) / abs(force) if force else mpf(0)
