"""Random mechanisms with dyads of every kind: places of all links are drawn first, their dimensions are read from them.

A crank that speeds up drives a dyad RRR (links 2 and 3); the dyad under test (links 4 and 5) hangs on two of the links
that move, or on the frame, so that both its outer pairs move, turn and accelerate. All links are bent, have mass and a
moment of inertia, a force and a couple. Sines and branches are taken from the places, not from the code under test.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from kulman.plans.linkages.mechanism import (
    FRAME,
    Couple,
    Driver,
    Link,
    Load,
    Mechanism,
    Pair,
    Prismatic,
    Revolute,
)

Array = NDArray[Any]
LEAST_SINE, LEAST_SINE_BEFORE = 0.02, 0.2  # losses of dyads in series multiply


@dataclass(slots=True)
class Workshop:
    """Places of links and joints as they are drawn at random, and the names and values that follow from them."""

    random: np.random.Generator
    count: int
    bent: bool = True
    values: dict[str, Array] = field(default_factory=dict)
    angles: dict[int, Array] = field(default_factory=dict)
    origins: dict[int, Array] = field(default_factory=dict)
    points: dict[int, dict[str, tuple[str, str]]] = field(default_factory=dict)
    joints: dict[str, Array] = field(default_factory=dict)
    pairs: list[Pair] = field(default_factory=list)
    sines: list[Array] = field(default_factory=list)

    def anywhere(self) -> Array:
        """Draw a place on a sheet of two metres."""
        return self.random.uniform(-1, 1, self.count) + 1j * self.random.uniform(-1, 1, self.count)

    def angle(self) -> Array:
        return self.random.uniform(-7, 7, self.count)

    def given(self, name: str, value: Array) -> str:
        self.values[name] = value
        return name

    def link(self, number: int, origin: Array, angle: Array) -> None:
        """Draw a link; a straight one has its origin at a joint."""
        self.origins[number] = origin + (0.3 * self.anywhere() if self.bent else 0.0)
        self.angles[number] = angle
        self.points[number] = {}

    def local(self, number: int, at: Array) -> Array:
        """Coordinates of a place on a link."""
        if number == FRAME:
            return at
        turned: Array = (at - self.origins[number]) * np.exp(-1j * self.angles[number])
        return turned

    def coordinates(self, name: str, number: int, at: Array) -> tuple[str, str]:
        """Name the coordinates of a place on a link; what is zero on a straight one has no name."""
        own = self.local(number, at)
        plain = number != FRAME and not self.bent
        parts = zip("xy", (own.real, own.imag), strict=True)
        x, y = (
            "zero" if plain and np.all(abs(part) < 1e-9) else self.given(f"{axis}_{name}_{number}", part)
            for axis, part in parts
        )
        return x, y

    def put(self, point: str, number: int, at: Array) -> None:
        """Letter a point of a link."""
        self.points[number][point] = self.coordinates(point, number, at)
        self.joints[point] = at

    def hinge(self, point: str, links: tuple[int, int], at: Array, branch: str | None = None) -> None:
        """Join two links at a point."""
        for number in links:
            if number != FRAME:
                self.put(point, number, at)
        place = self.coordinates(point, FRAME, at) if FRAME in links else None
        self.joints[point] = at
        self.pairs.append(Revolute(point, links, place, branch))

    def slide(self, point: str, slider: int, guide: int, at: Array, branch: str | None = None) -> None:
        """Let a point of the slider, whose x axis is along the guide, run at an offset from a guide on another link."""
        self.put(point, slider, at)
        along = self.angles[slider]
        guide_angle = along - (self.angles[guide] if guide != FRAME else 0.0)
        through = self.anywhere()
        offset = ((at - through) * np.exp(-1j * along)).imag
        name = f"{slider}{guide}"
        self.pairs.append(
            Prismatic(
                point,
                (slider, guide),
                self.coordinates(f"G{name}", guide, through),
                self.given(f"gamma_{name}", guide_angle),
                self.given(f"e_{name}", offset),
                branch,
            )
        )

    def finish(self, links: int) -> tuple[Mechanism, dict[str, Array], Array]:
        """Add masses, loads and the driver; return the mechanism, its values and the places of its links."""
        made, loads, couples = [], [], []
        for number in range(1, links + 1):
            for letter in ("S", "E"):
                # on straight links these points stand on the axis
                at = self.anywhere() if self.bent else self.origins[number] + np.exp(1j * self.angles[number]) * 0.4
                self.put(f"{letter}{number}", number, at)
            mass = self.given(f"m_{number}", self.random.uniform(0.1, 5, self.count))
            inertia = self.given(f"J_S{number}", self.random.uniform(0.01, 0.5, self.count))
            made.append(Link(number, self.points[number], f"S{number}", mass, inertia))
            force = self.given(f"F_{number}", 10 ** self.random.uniform(0, 3, self.count))
            loads.append(Load(f"F_{number}", number, f"E{number}", force, self.given(f"a_F{number}", self.angle())))
            moment = self.given(f"M_{number}", 10 ** self.random.uniform(0, 3, self.count))
            sense = self.given(f"s_M{number}", self.random.choice([-1.0, 1.0], self.count))
            couples.append(Couple(f"M_{number}", number, moment, sense))
        self.given("n_1", self.random.uniform(0.5, 20, self.count))
        self.given("sense_1", self.random.choice([-1.0, 1.0], self.count))
        self.given("acceleration_1", self.random.uniform(-100, 100, self.count))
        self.given("phi", np.angle(self.joints["A"] - self.joints["O"]))
        driver = Driver(1, "O", "A", "phi", "n_1", "sense_1", "acceleration_1")
        places = np.stack(
            [np.stack([o.real, o.imag, self.angles[i]], axis=1) for i, o in sorted(self.origins.items())], axis=1
        )
        return Mechanism(tuple(made), tuple(self.pairs), driver, tuple(loads), tuple(couples)), self.values, places


def unit(vector: Array) -> Array:
    """Return unit vectors."""
    turned: Array = vector / abs(vector)
    return turned


def cross(u: Array, w: Array) -> Array:
    """Return the vector product."""
    product: Array = (u.conj() * w).imag
    return product


def dot(u: Array, w: Array) -> Array:
    """Return the scalar product."""
    product: Array = (u.conj() * w).real
    return product


def direction(w: Workshop, a: Array, b: Array) -> Array:
    """Angle of a new link between two joints: along them when it is straight, any otherwise."""
    return w.angle() if w.bent else np.angle(b - a)


def feeder(w: Workshop) -> None:
    """A crank 1 and a dyad RRR of links 2 and 3."""
    O, A, B, C = (w.anywhere() for _ in range(4))
    w.link(1, O, direction(w, O, A))
    w.link(2, A, direction(w, A, B))
    w.link(3, C, direction(w, C, B))
    w.hinge("O", (0, 1), O)
    w.hinge("A", (1, 2), A)
    w.hinge("C", (3, 0), C)
    w.hinge("B", (2, 3), B, w.given("branch_B", np.sign(cross(C - A, B - A))))
    w.sines.append(cross(unit(B - A), unit(B - C)) * (LEAST_SINE / LEAST_SINE_BEFORE))


def rrr(w: Workshop, before: tuple[int, int], carries: tuple[bool, ...]) -> None:
    P, Q, R = (w.anywhere() for _ in range(3))
    w.link(4, P, direction(w, P, R))
    w.link(5, Q, direction(w, Q, R))
    w.hinge("P", (4, before[0]), P)
    w.hinge("Q", (5, before[1]), Q)
    w.hinge("R", (4, 5), R, w.given("branch_R", np.sign(cross(Q - P, R - P))))
    w.sines.append(cross(unit(R - P), unit(R - Q)))


def joined(w: Workshop, new: int, known: int, at: Array, point: str, carries: bool, branch: str | None = None) -> Array:
    """Join a new link by a prismatic pair to a known one; return the direction. `at` is a point of the new link."""
    if carries:
        along = w.angles[known]
        w.link(new, at, w.angle())
        w.slide(point, known, new, w.anywhere(), branch)
    else:
        along = w.angle()
        w.link(new, at, along)
        w.slide(point, new, known, w.anywhere() if w.bent else at + 0.3 * np.exp(1j * along), branch)
    u: Array = np.exp(1j * along)
    return u


def rrp(w: Workshop, before: tuple[int, int], carries: tuple[bool, ...]) -> None:
    P, R = w.anywhere(), w.anywhere()
    w.link(4, P, direction(w, P, R))
    w.values["branch_R"] = np.zeros(w.count)
    u = joined(w, 5, before[1], R, "T", carries[0], "branch_R")
    w.values["branch_R"] = np.sign(dot(u, R - P))
    w.hinge("P", (4, before[0]), P)
    w.hinge("R", (4, 5), R)
    w.sines.append(dot(u, unit(R - P)))


def rpr(w: Workshop, before: tuple[int, int], carries: tuple[bool, ...]) -> None:
    P, Q = w.anywhere(), w.anywhere()
    slider, guide = (5, 4) if carries[0] else (4, 5)
    along = w.angle()
    w.link(slider, Q if carries[0] else P, along)
    w.link(guide, P if carries[0] else Q, w.angle() if w.bent else along)
    u = np.exp(1j * along)
    way = (Q - P) if carries[0] else (P - Q)  # from the guide's pin to the slider's
    w.hinge("P", (4, before[0]), P)
    w.hinge("Q", (5, before[1]), Q)
    at = w.anywhere() if w.bent else (Q if carries[0] else P) + 0.3 * u
    w.slide("T", slider, guide, at, w.given("branch_T", np.sign(dot(u, way))))
    w.sines.append(dot(u, unit(way)))


def prp(w: Workshop, before: tuple[int, int], carries: tuple[bool, ...]) -> None:
    R = w.anywhere()
    first = joined(w, 4, before[0], R, "T", carries[0])
    second = joined(w, 5, before[1], R, "U", carries[1])
    w.hinge("R", (4, 5), R)
    w.sines.append(cross(first, second))


def rpp(w: Workshop, before: tuple[int, int], carries: tuple[bool, ...]) -> None:
    """Link 4 is hinged, link 5 slides on the link before; `carries` tells who has the guides: 5 outside, 4 inside."""
    P, Q = w.anywhere(), w.anywhere()
    outside = joined(w, 5, before[1], Q, "T", carries[0])
    w.put("Q5", 5, Q)
    inside = joined(w, 4, 5, P, "U", carries[1])
    w.hinge("P", (4, before[0]), P)
    w.sines.append(cross(outside, inside))


KINDS = {"RRR": rrr, "RRP": rrp, "RPR": rpr, "PRP": prp, "RPP": rpp}


def random_dyads(
    kind: str, before: tuple[int, int], carries: tuple[bool, ...], seed: int, count: int, bent: bool = True
) -> tuple[Mechanism, dict[str, Array], Array]:
    """Return mechanisms with a dyad of `kind` between two links, values, and places; all sines above LEAST_SINE."""
    w = Workshop(np.random.default_rng(seed), count * 3 // 2 + 20, bent)
    feeder(w)
    KINDS[kind](w, before, carries)
    mechanism, values, places = w.finish(5)
    good = np.flatnonzero(np.min(np.abs(w.sines), axis=0) > LEAST_SINE)[:count]
    return mechanism, {name: value[good] for name, value in values.items()}, places[good]
