"""Random mechanisms with groups of every kind: places of all links are drawn first, dimensions are read from them.

A crank (or a slider) that speeds up drives a dyad RRR (links 2 and 3); the dyad under test (links 4 and 5) hangs on
two of the links that move, or on the frame, so that both its outer pairs move, turn and accelerate. All links are bent,
have mass and a moment of inertia, a force and a couple. Sines and branches are taken from the places, not from the code
under test.

In place of the dyad there may be a triad. It hangs on three links, or on the frame. Link 5 is the central one,
4, 6 and 7 are its legs, each hinged (R), a slider in a guide (P), or a slider that carries the guide itself (G).

What may be small in a triad: the sine of two lines, that of the third line with the way to their meeting point, and
their determinant (in the size of the central link, as `plans.template` has it). A leg much shorter than that size turns
so much the faster for the same error of its joint, so the determinant counts in the shortest leg. With this product
above 0.02, 80,000 mechanisms had errors up to 2.7e-11; with the determinant alone, 4 of them had up to 4.3e-10.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from itertools import combinations
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
    SlidingDriver,
    Start,
)
from kulman.tests.support.jacobian_solver import cross, dot

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
    numbers: tuple[int, int] = (4, 5)
    letters: str = "PQRTU"

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
        return np.asarray((at - self.origins[number]) * np.exp(-1j * self.angles[number]))

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
        offset: Any = ((at - through) * np.exp(-1j * along)).imag
        name = f"{slider}{guide}"
        place = self.coordinates(f"G{name}", guide, through)
        turned, offset = self.given(f"gamma_{name}", guide_angle), self.given(f"e_{name}", offset)
        self.pairs.append(Prismatic(point, (slider, guide), place, turned, offset, branch))

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
        driver = self.crank() if "O" in self.joints else self.slider()
        places = np.stack(
            [np.stack([o.real, o.imag, self.angles[i]], axis=1) for i, o in sorted(self.origins.items())], axis=1
        )
        return Mechanism(tuple(made), tuple(self.pairs), driver, tuple(loads), tuple(couples)), self.values, places

    def crank(self) -> Driver:
        self.given("phi", np.angle(self.joints["A"] - self.joints["O"]))
        return Driver(1, "O", "A", "phi", "n_1", "sense_1", "acceleration_1")

    def slider(self) -> SlidingDriver:
        """The first link slides on the frame, either way."""
        guide = next(pair for pair in self.pairs if isinstance(pair, Prismatic) and pair.links == (1, FRAME))
        x, y = (self.values.get(name, 0.0) for name in guide.through)
        along = np.exp(1j * self.values[guide.direction])
        self.given("travel", dot(along, self.joints["A"] - (x + 1j * y)))
        self.given("v_1", self.values["n_1"] * self.values["sense_1"])
        return SlidingDriver(1, "A", "travel", "v_1", "acceleration_1")


def unit(vector: Array) -> Array:
    """Return unit vectors."""
    return np.asarray(vector / abs(vector))


def direction(w: Workshop, a: Array, b: Array) -> Array:
    """Angle of a new link between two joints: along them when it is straight, any otherwise."""
    return w.angle() if w.bent else np.angle(b - a)


def bars(w: Workshop, A: Array, B: Array, C: Array) -> None:
    """Draw a dyad RRR of links 2 and 3 on link 1 and the frame."""
    w.link(2, A, direction(w, A, B))
    w.link(3, C, direction(w, C, B))
    w.hinge("A", (1, 2), A)
    w.hinge("C", (3, 0), C)
    w.hinge("B", (2, 3), B, w.given("branch_B", np.sign(cross(C - A, B - A))))
    w.sines.append(cross(unit(B - A), unit(B - C)) * (LEAST_SINE / LEAST_SINE_BEFORE))


def feeder(w: Workshop) -> None:
    """A crank 1 and a dyad RRR of links 2 and 3."""
    O, A, B, C = (w.anywhere() for _ in range(4))
    w.link(1, O, direction(w, O, A))
    w.hinge("O", (0, 1), O)
    bars(w, A, B, C)


def sliding_feeder(w: Workshop) -> None:
    """A slider 1 on the frame and a dyad RRR of links 2 and 3."""
    A, B, C = (w.anywhere() for _ in range(3))
    w.link(1, A, w.angle())
    w.slide("D", 1, 0, w.anywhere())
    bars(w, A, B, C)


def rrr(w: Workshop, before: tuple[int, int], carries: tuple[bool, ...]) -> None:
    (first, second), (p, q, r, _, _) = w.numbers, w.letters
    P, Q, R = (w.anywhere() for _ in range(3))
    w.link(first, P, direction(w, P, R))
    w.link(second, Q, direction(w, Q, R))
    w.hinge(p, (first, before[0]), P)
    w.hinge(q, (second, before[1]), Q)
    w.hinge(r, (first, second), R, w.given(f"branch_{r}", np.sign(cross(Q - P, R - P))))
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
    return np.asarray(np.exp(1j * along))


def rrp(w: Workshop, before: tuple[int, int], carries: tuple[bool, ...]) -> None:
    (first, second), (p, _, r, t, _) = w.numbers, w.letters
    P, R = w.anywhere(), w.anywhere()
    w.link(first, P, direction(w, P, R))
    u = joined(w, second, before[1], R, t, carries[0], f"branch_{r}")
    w.given(f"branch_{r}", np.sign(dot(u, R - P)))
    w.hinge(p, (first, before[0]), P)
    w.hinge(r, (first, second), R)
    w.sines.append(dot(u, unit(R - P)))


def rpr(w: Workshop, before: tuple[int, int], carries: tuple[bool, ...]) -> None:
    """The second link carries the guide, or (`carries`) the first."""
    (first, second), (p, q, _, t, _) = w.numbers, w.letters
    P, Q = w.anywhere(), w.anywhere()
    slider, guide = (second, first) if carries[0] else (first, second)
    along = w.angle()
    w.link(slider, Q if carries[0] else P, along)
    w.link(guide, P if carries[0] else Q, w.angle() if w.bent else along)
    u = np.exp(1j * along)
    way = (Q - P) if carries[0] else (P - Q)  # from the guide's pin to the slider's
    w.hinge(p, (first, before[0]), P)
    w.hinge(q, (second, before[1]), Q)
    at = w.anywhere() if w.bent else (Q if carries[0] else P) + 0.3 * u
    w.slide(t, slider, guide, at, w.given(f"branch_{t}", np.sign(dot(u, way))))
    w.sines.append(dot(u, unit(way)))


def prp(w: Workshop, before: tuple[int, int], carries: tuple[bool, ...]) -> None:
    numbers, (_, _, r, *ends) = w.numbers, w.letters
    R = w.anywhere()
    directions = [joined(w, numbers[i], before[i], R, ends[i], carries[i]) for i in (0, 1)]
    w.hinge(r, numbers, R)
    w.sines.append(cross(directions[0], directions[1]))


def rpp(w: Workshop, before: tuple[int, int], carries: tuple[bool, ...]) -> None:
    """The first link is hinged, the second slides on the link before.

    `carries` tells whether the second has the guide outside, and whether the first has that between them.
    """
    (first, second), (p, q, _, t, u) = w.numbers, w.letters
    P, Q = w.anywhere(), w.anywhere()
    outside = joined(w, second, before[1], Q, t, carries[0])
    w.put(f"{q}{second}", second, Q)
    inside = joined(w, first, second, P, u, carries[1])
    w.hinge(p, (first, before[0]), P)
    w.sines.append(cross(outside, inside))


KINDS = {"RRR": rrr, "RRP": rrp, "RPR": rpr, "PRP": prp, "RPP": rpp}


def random_dyads(
    kind: str,
    before: tuple[int, int],
    carries: tuple[bool, ...],
    seed: int,
    count: int,
    bent: bool = True,
    feed: Callable[[Workshop], None] = feeder,
) -> tuple[Mechanism, dict[str, Array], Array]:
    """Return mechanisms with a dyad of `kind` between two links, values, and places; all sines above LEAST_SINE."""
    w = Workshop(np.random.default_rng(seed), count * 3 // 2 + 20, bent)
    feed(w)
    KINDS[kind](w, before, carries)
    return chosen(w, count, 5)


def chosen(w: Workshop, count: int, links: int) -> tuple[Mechanism, dict[str, Array], Array]:
    """Finish the mechanisms and keep the first `count` that are not near a singular position."""
    mechanism, values, places = w.finish(links)
    good = np.flatnonzero(np.min(np.abs(w.sines), axis=0) > LEAST_SINE)[:count]
    return mechanism, {name: value[good] for name, value in values.items()}, places[good]


def random_trains(
    kinds: tuple[str, str], before: tuple[tuple[int, int], tuple[int, int]], seed: int, count: int
) -> tuple[Mechanism, dict[str, Array], Array]:
    """Return mechanisms with two dyads (links 4, 5 and 6, 7) after the first, in series or in parallel."""
    w = Workshop(np.random.default_rng(seed), count * 4 + 50)
    feeder(w)
    for kind, joints, numbers, letters in zip(kinds, before, ((4, 5), (6, 7)), ("PQRTU", "KLNWX"), strict=True):
        w.numbers, w.letters = numbers, letters
        KINDS[kind](w, joints, {"RPP": (False, False), "PRP": (False, True)}.get(kind, (True,)))
        w.sines[-1] = w.sines[-1] * (LEAST_SINE / LEAST_SINE_BEFORE)
    return chosen(w, count, 7)


CENTRAL, LEGS = 5, (4, 6, 7)
INNER, OUTER = "PQR", "KLN"
PAIRS = ((4, 6), (4, 7), (6, 7))


def random_triads(
    kinds: str, before: tuple[int, int, int], seed: int, count: int, bent: bool = True
) -> tuple[Mechanism, dict[str, Array], Array]:
    """Return mechanisms with a triad, values, and places of all links; nothing in them is below LEAST_SINE."""
    w = Workshop(np.random.default_rng(seed), count * 4 + 40, bent)
    feeder(w)
    triad(w, kinds, before)
    mechanism, values, places = w.finish(7)
    for i, name in enumerate(("x", "y", "angle")):
        values[f"{name}_start"] = places[:, CENTRAL - 1, i] + w.random.normal(0, 1e-4, w.count)
    values["phi_start"] = values["phi"]
    mechanism = replace(mechanism, starts=(Start(CENTRAL, "x_start", "y_start", "angle_start", "phi_start"),))
    good = np.flatnonzero(np.min(np.abs(w.sines), axis=0) > LEAST_SINE)[:count]
    return mechanism, {name: value[good] for name, value in values.items()}, places[good]


def triad(w: Workshop, kinds: str, before: tuple[int, int, int]) -> None:
    """Draw a triad and note what may be small in it."""
    joints = [w.anywhere() for _ in INNER]
    w.link(CENTRAL, joints[0], direction(w, joints[0], joints[1]))
    lines, lengths = [], []
    for kind, number, known, at, inner, outer in zip(kinds, LEGS, before, joints, INNER, OUTER, strict=True):
        if kind == "R":
            end = w.anywhere()
            w.link(number, end, direction(w, end, at))
            w.hinge(outer, (number, known), end)
            lines.append(unit(at - end))
            lengths.append(abs(at - end))
        else:
            lines.append(1j * joined(w, number, known, at, outer, kind == "G"))
        w.hinge(inner, (number, CENTRAL), at)
    size = np.sqrt(sum(abs(joints[i] - joints[j]) ** 2 for i, j in combinations(range(3), 2)) / 2)
    shortest = np.min([size, *lengths], axis=0)
    moments = [cross(at, line) / size for at, line in zip(joints, lines, strict=True)]
    determinant = sum(moments[i] * cross(lines[j], lines[k]) for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)))
    w.sines += [determinant * shortest / size, *sines_of(joints, lines)]


def sines_of(joints: list[Array], lines: list[Array]) -> Iterator[Array]:
    """Go through the sines of the construction with every two legs."""
    for i, j in combinations(range(3), 2):
        k = 3 - i - j
        sine = cross(lines[i], lines[j])
        special = joints[i] + lines[i] * cross(joints[j] - joints[i], lines[j]) / sine
        yield sine
        yield cross(unit(joints[k] - special), lines[k])
