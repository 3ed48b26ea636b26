"""Mechanisms for tests: the variants of the slider-crank, random slider-cranks, and schemes for the structure."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import product
from typing import Any

import numpy as np
from numpy.typing import NDArray

from kulman.plans.board import Program
from kulman.plans.boards.batch import batch
from kulman.plans.linkages.chain import construct
from kulman.plans.linkages.mechanism import ZERO, Driver, Link, Load, Mechanism, Pair, Prismatic, Revolute
from kulman.plans.linkages.solved import board_givens

SEED = 20160101
ORIGIN = (ZERO, ZERO)
CRANK = Driver(1, "O", "A", "phi", "n_1", "sense_1")
GENERAL_LENGTHS = ("x_O", "y_O", "l_OA", "l_AB", "l_AS2", "l_AC", "x_g", "y_g", "e")

# phi deg, l_OA, l_AB, l_AS2 mm, n_1 rpm, m_2, m_3 kg, J_S2 kg m^2, F_3 kN; see the source in the task file
NAU_VARIANTS: dict[str, tuple[float, ...]] = {
    "0": (30, 25, 125, 42, 2000, 0.8, 0.6, 0.005, 2.0),
    "1": (45, 30, 140, 46, 1800, 1.8, 1.5, 0.010, 3.5),
    "2": (60, 35, 170, 55, 1600, 2.5, 2.0, 0.015, 4.0),
    "3": (120, 40, 190, 65, 1400, 3.0, 2.5, 0.020, 4.5),
    "4": (150, 45, 215, 72, 1200, 3.5, 3.0, 0.025, 5.0),
    "5": (210, 50, 240, 80, 1000, 4.0, 3.8, 0.030, 6.0),
    "6": (240, 28, 136, 45, 1750, 1.5, 1.2, 0.008, 2.8),
    "7": (300, 34, 165, 48, 1700, 2.0, 1.7, 0.012, 3.8),
    "8": (315, 42, 210, 70, 1350, 3.2, 2.8, 0.022, 4.6),
    "9": (330, 46, 220, 75, 1150, 3.4, 2.9, 0.028, 4.8),
    "example": (60, 50, 130, 60, 765, 2.5, 2.0, 0.015, 1.5),
}
SIDES = ("left", "right")
ROTATIONS = ("cw", "ccw")


def nau_cases() -> list[tuple[str, str, str]]:
    """Return all variants on both sides in both rotations."""
    return list(product(NAU_VARIANTS, SIDES, ROTATIONS))


def place(text: str) -> tuple[str, str]:
    """Return coordinates from "x,y", from one along the axis, or from nothing: the origin."""
    x, _, y = text.partition(",")
    return x or ZERO, y or ZERO


def bodies(*texts: str) -> tuple[Link, ...]:
    """Return links 1, 2 ...: "A B:l_AB D:x,y / S2 m_2 J_S2" says points, centre of mass, mass, moment of inertia."""
    parts = [text.partition("/") for text in texts]
    pointed = [{word.partition(":")[0]: place(word.partition(":")[2]) for word in part[0].split()} for part in parts]
    return tuple(Link(i, pointed[i - 1], *part[2].split()) for i, part in enumerate(parts, 1))


def pins(text: str) -> tuple[Pair, ...]:
    """Return revolute pairs: "O01 A12 B23:side C30@x_C,y_C" says points, links, a branch, a place on the frame."""
    pairs = []
    for word in text.split():
        links, rest = (int(word[1]), int(word[2])), word[3:]
        at = place(rest.removeprefix("@")) if 0 in links else None
        pairs.append(Revolute(word[0], links, at, rest[1:] if rest[:1] == ":" else None))
    return tuple(pairs)


def nau_slider_crank() -> Mechanism:
    """Slider-crank with a central guide, the piston loaded."""
    return Mechanism(
        bodies("O A:l_OA / O", "A B:l_AB S2:l_AS2 / S2 m_2 J_S2", "B / B m_3"),
        (*pins("O01 A12 B23"), Prismatic("B", (3, 0), ORIGIN, ZERO, ZERO, "branch_B")),
        CRANK,
        (Load("F_3", 3, "B", "F_3", "alpha_F3"),),
    )


def nau_values(
    variant: str = "example", side: str = "left", rotation: str = "cw", **changed: float
) -> dict[str, float]:
    """Return the values of one variant in SI."""
    phi, l_OA, l_AB, l_AS2, n_1, m_2, m_3, J_S2, F_3 = NAU_VARIANTS[variant]
    return {
        **{"phi": math.radians(phi), "l_OA": l_OA / 1000, "l_AB": l_AB / 1000, "l_AS2": l_AS2 / 1000},
        **{"n_1": n_1 * math.pi / 30, "m_2": m_2, "m_3": m_3, "J_S2": J_S2, "F_3": F_3 * 1000},
        "sense_1": -1.0 if rotation == "cw" else 1.0,
        "branch_B": -1.0 if side == "left" else 1.0,
        "alpha_F3": 0.0 if side == "left" else math.pi,
        **changed,
    }


def general_slider_crank() -> Mechanism:
    """Slider-crank with every freedom of its kind: an oblique guide with offset off the pivot, loads on all links."""
    loads = (("1", 1, "A"), ("C", 2, "C"), ("B", 2, "B"), ("3", 3, "B"))
    return Mechanism(
        bodies("O A:l_OA / A m_1", "A B:l_AB S2:l_AS2 C:l_AC / S2 m_2 J_S2", "B / B m_3"),
        (*pins("O01@x_O,y_O A12 B23"), Prismatic("B", (3, 0), ("x_g", "y_g"), "gamma", "e", "branch_B")),
        CRANK,
        tuple(Load(f"F_{name}", link, point, f"F_{name}", f"alpha_F{name}") for name, link, point in loads),
    )


def random_slider_cranks(seed: int, count: int, least_sine: float = 0.3) -> dict[str, Any]:
    """Return values of `count` general slider-cranks that assemble with sines above `least_sine`.

    In four of five the rod reaches the guide in the whole cycle, in the others perhaps in this position alone.
    """
    random = np.random.default_rng(seed)
    uniform = random.uniform
    l_OA = 10.0 ** uniform(-2.0, 0.0, count)
    gamma, phi = uniform(-7.0, 7.0, count), uniform(-7.0, 7.0, count)
    x_O, y_O, x_g, y_g = (l_OA * uniform(-3.0, 3.0, count) for _ in range(4))
    e = l_OA * uniform(-1.0, 1.0, count)
    pivot_distance = np.abs((x_O - x_g) * np.sin(gamma) - (y_O - y_g) * np.cos(gamma) + e)
    x_A, y_A = x_O + l_OA * np.cos(phi), y_O + l_OA * np.sin(phi)
    distance = np.abs((x_A - x_g) * np.sin(gamma) - (y_A - y_g) * np.cos(gamma) + e)
    reach = np.where(random.random(count) < 0.8, pivot_distance + l_OA, np.maximum(distance, l_OA * 0.2))
    l_AB = reach * uniform(1.0, 4.0, count) / math.sqrt(1.0 - least_sine**2) * (1.0 + 1e-9)
    angles = {f"alpha_{load}": uniform(-7.0, 7.0, count) for load in ("F1", "FC", "FB", "F3")}
    forces = {load: 10.0 ** uniform(0.0, 4.0, count) for load in ("F_1", "F_C", "F_B", "F_3")}
    return {
        **{"x_O": x_O, "y_O": y_O, "x_g": x_g, "y_g": y_g, "e": e, "gamma": gamma, "phi": phi},
        **{"l_OA": l_OA, "l_AB": l_AB},
        **{"l_AS2": l_AB * uniform(-0.2, 1.2, count), "l_AC": l_AB * uniform(-0.5, 2.0, count)},
        "n_1": uniform(1.0, 300.0, count),
        **{name: random.choice([-1.0, 1.0], count) for name in ("sense_1", "branch_B")},
        **{"m_1": uniform(0.0, 5.0, count), "m_2": uniform(0.1, 5.0, count), "m_3": uniform(0.1, 5.0, count)},
        "J_S2": uniform(0.001, 0.1, count),
        **angles,
        **forces,
    }


def one_of(values: Mapping[str, Any], index: int) -> dict[str, float]:
    """Return position `index` of an array of values."""
    return {name: float(array[index]) for name, array in values.items()}


def bare(text: str, *guides: Pair, more: int = 0) -> Mechanism:
    """Return a mechanism about which only the pairs are known, driven at link 1; `more` links hang nowhere."""
    pairs = (*pins(text), *guides)
    count = max(number for pair in pairs for number in pair.links) + more
    return Mechanism(bodies(*[""] * count), pairs, CRANK)


def slide(point: str, slider: int, guide: int) -> Prismatic:
    """Return a prismatic pair of `slider` on `guide`."""
    return Prismatic(point, (slider, guide), ORIGIN, ZERO)


def twin(series: bool) -> Mechanism:
    """Two connecting rods: the second one hangs on the crank pin, or (in series) on point C of the first rod."""
    root, second = ("C", "C24") if series else ("A", "A14")
    rods = ("A B:l_AB S2:l_AS2 C:l_AC / S2 m_2 J_S2", "B / B m_3", f"{root} D:l_4 S4:l_S4 / S4 m_4 J_S4", "D / D m_5")
    guides = (
        Prismatic("B", (3, 0), ORIGIN, "gamma", ZERO, "branch_B"),
        Prismatic("D", (5, 0), ORIGIN, "gamma_5", "e_5", "branch_D"),
    )
    loads = (Load("F_3", 3, "B", "F_3", "alpha_F3"), Load("F_5", 5, "D", "F_5", "alpha_F5"))
    return Mechanism(bodies("O A:l_OA / O", *rods), (*pins(f"O01 A12 B23 {second} D45"), *guides), CRANK, loads)


def twin_values() -> dict[str, float]:
    """Return values for both forms of `twin`."""
    own = {"gamma": 0.7, "l_AC": 0.03, "l_4": 0.15, "l_S4": 0.07, "m_4": 1.1, "J_S4": 0.004, "m_5": 0.9, "gamma_5": 2.1}
    return {**nau_values(), **own, "e_5": 0.012, "branch_D": 1.0, "F_5": 800.0, "alpha_F5": 2.3}


@dataclass(frozen=True, slots=True, eq=False)
class Solved:
    """Random mechanisms in one array: the values that were given and every name that the program makes."""

    mechanism: Mechanism
    program: Program
    values: dict[str, Any]
    results: dict[str, NDArray[Any]]
    codes: NDArray[np.int8]

    def __getitem__(self, name: str) -> NDArray[Any]:
        """Return a result or a given, as one array."""
        return self.results[name] if name in self.results else np.asarray(self.values[name])


def solved(mechanism: Mechanism, values: dict[str, Any]) -> Solved:
    """Run `mechanism` for arrays of values and keep every name."""
    _, program = construct(mechanism)
    results, codes = batch(program, board_givens(mechanism, values), program.names)
    return Solved(mechanism, program, values, results, codes)
