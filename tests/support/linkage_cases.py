"""Sheets of any bundled linkage, read back, beside what constraint equations say of the mechanism."""

from __future__ import annotations

import cmath
import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np

from kulman import sheet, solve
from kulman.plans.linkages.chain import moving_bodies
from kulman.plans.linkages.mechanism import FRAME, Mechanism, Revolute
from kulman.tests.support.jacobian_solver import JacobianSolver
from kulman.tests.support.readback import Sheet, read_back
from kulman.variants.sheets import Sheet as DrawnSheet
from kulman.variants.solution import Solution

PARTS = ("n", "t", "k", "r")


@dataclass(frozen=True)
class Linkage:
    """One sheet of one variant of a task."""

    task: str
    variant: str
    lang: str = "uk"
    format: str | None = None
    only: tuple[str, ...] | None = None

    def __str__(self) -> str:
        return "-".join(filter(None, (self.task, self.variant, self.lang, self.format or "", *(self.only or ()))))

    @property
    def drawn(self) -> DrawnSheet:
        return _drawn(self)

    @property
    def sheet(self) -> Sheet:
        return _read(self)

    @property
    def solution(self) -> Solution:
        return _solution(self.task, self.variant)

    @property
    def oracle(self) -> Oracle:
        return _oracle(self.task, self.variant)


@lru_cache(maxsize=2)
def _drawn(case: Linkage) -> DrawnSheet:
    return sheet(case.task, case.variant, lang=case.lang, format=case.format, only=case.only)


@lru_cache(maxsize=32)
def _read(case: Linkage) -> Sheet:
    return read_back(case.drawn)


@lru_cache(maxsize=64)
def _solution(task: str, variant: str) -> Solution:
    return solve(task, variant)


@lru_cache(maxsize=64)
def _oracle(task: str, variant: str) -> Oracle:
    return Oracle(_solution(task, variant))


class Oracle:
    """What the constraint equations and their Jacobian say of one position, by the names of the quantities."""

    def __init__(self, solution: Solution, settings: Mapping[str, str] | None = None) -> None:
        solved = solution.solved
        self.m: Mechanism = solved.mechanism
        # what is given comes first: the plan calls a load and its size by one name
        values = {name: value for name, value in solved.values.items() if isinstance(value, float)}
        values |= solution.task.values(solution.variant, settings)
        values["output_angle"] = _output_angle(solution)
        self.solver = JacobianSolver(self.m, values, _rough_places(solution))
        self.known = {name: complex(value[0]) for name, value in self.solver.expected.items()}
        self.values = values
        # a special point stands on two legs; how it moves as a point of its link is not taken from the plan
        self.special = {name: solved.point(name) for name in solved.values if re.fullmatch(r"X\d+", name)}

    @cached_property
    def still(self) -> dict[str, complex]:
        """Places of the pivots on the frame."""
        found = {}
        for pair in self.m.pairs:
            if isinstance(pair, Revolute) and FRAME in pair.links and pair.at:
                x, y = (0.0 if name == "zero" else self.values[name] for name in pair.at)
                found[pair.point] = complex(x, y)
        return found

    def place(self, letter: str) -> complex:
        """Where a lettered point stands; `A3`, the point of link 3 under A, stands at A."""
        known = self.known.get(letter, self.known.get(letter[:-1], 0j))
        return self.still.get(letter) or self.special.get(letter) or known

    def points(self) -> set[str]:
        return {point for link in self.m.links for point in link.points} | {*self.still}

    def link_of(self, *letters: str) -> int:
        """The link to which all these letters belong."""
        for link in self.m.links:
            if all(x in link.points or (x not in self.points() and x[-1:] == str(link.number)) for x in letters):
                return link.number
        raise KeyError(letters)

    def moves(self, letter: str) -> tuple[complex, complex]:
        """Velocity and acceleration of a point, or of the point of a link that lies under it."""
        if letter in self.still:
            return 0j, 0j
        if f"V_{letter}" in self.known:
            return self.known[f"V_{letter}"], self.known[f"a_{letter}"]
        if letter[-1] == "0":
            return 0j, 0j
        v, a = self.solver.under(int(letter[-1]), np.array([self.place(letter)]))
        return complex(v[0]), complex(a[0])

    def rates(self, link: int) -> tuple[float, float]:
        return self.known[f"omega_{link}"].real, self.known[f"epsilon_{link}"].real

    def vector(self, name: str) -> complex | None:
        """What a vector of a plan must be, or None for one that this judge does not know."""
        if name in self.known:
            return self.known[name]
        kind, _, rest = name.partition("_")
        index, _, part = rest.partition("_")
        # `S3C` is S3 and C, `A3A2` is A3 and A2
        motion = kind in ("V", "a") and part in ("", *PARTS)
        return self._motion(kind, re.findall(r"[A-Z][a-z]?\d*", index), part) if motion else None

    def _motion(self, kind: str, letters: list[str], part: str) -> complex:
        if len(letters) == 1 and not part:
            return self.moves(letters[0])[kind == "a"]
        about = letters[1] if len(letters) > 1 else self._pivot(letters[0])
        (v, a), (w, b) = self.moves(letters[0]), self.moves(about)
        if kind == "V":
            return v - w
        if not part:
            return a - b
        if part in ("k", "r"):
            omega = self.rates(int(letters[0][-1]))[0] if letters[0][-1].isdigit() else 0.0
            coriolis = 2j * omega * (v - w)
            return coriolis if part == "k" else a - b - coriolis
        omega, epsilon = self.rates(self.link_of(letters[0], about))
        r = self.place(letters[0]) - self.place(about)
        return -omega * omega * r if part == "n" else 1j * epsilon * r

    def _pivot(self, letter: str) -> str:
        """The pivot on the frame about which the link of a point turns."""
        for link in self.m.links:
            held = [point for point in link.points if point in self.still]
            if held and (letter in link.points or letter[-1:] == str(link.number)):
                return held[0]
        return letter


def _output_angle(solution: Solution) -> float:
    """Return the angle on the output link of the direction by which its stroke is measured."""
    solved = solution.solved
    if solved.mechanism.stroke is None:
        return 0.0
    local = moving_bodies(solved.mechanism, solved.structure)[solved.mechanism.stroke.link].local
    return cmath.phase(complex(solved.values[local])) if local else 0.0


def _rough_places(solution: Solution) -> np.ndarray:
    """Return places and angles of the links as the plan has them, shape (1, links, 3)."""
    solved = solution.solved
    bodies = moving_bodies(solved.mechanism, solved.structure)
    rows = []
    for link in solved.mechanism.links:
        body = bodies[link.number]
        local = complex(solved.values[body.local]) if body.local else 1 + 0j
        turn = complex(solved.values[body.direction]) / local
        x, y = (0.0 if name == "zero" else float(solved.values[name]) for name in link.points[body.pin])
        origin = complex(solved.values[body.pin]) - turn / abs(turn) * complex(x, y)
        rows.append((origin.real, origin.imag, cmath.phase(turn)))
    return np.array([rows])
