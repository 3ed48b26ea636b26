"""Random mechanisms with a triad: places of all links are drawn first, their dimensions are read from them.

The feeder of `dyads` drives links 1 to 3; the triad hangs on three of them, or on the frame. Link 5 is the central one,
4, 6 and 7 are its legs, each hinged (R), a slider in a guide (P), or a slider that carries the guide itself (G).

What may be small in a triad: the sine of two lines, that of the third line with the way to their meeting point, and
their determinant (in the size of the central link, as `plans.template` has it). A leg much shorter than that size turns
so much the faster for the same error of its joint, so the determinant counts in the shortest leg. With this product
above 0.02, 80,000 mechanisms had errors up to 2.7e-11; with the determinant alone, 4 of them had up to 4.3e-10.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import combinations
from typing import Any

import numpy as np
from numpy.typing import NDArray

from kulman.plans.linkages.mechanism import Mechanism, Start
from kulman.tests.support.dyads import LEAST_SINE, Workshop, cross, direction, feeder, joined, unit

Array = NDArray[Any]
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
