"""A rope with mass: the load and n masses of the rope in a row, as which one reduced mass stands.

The rope is cut into n equal parts, each a mass in its middle; its stiffness lies between, that of the bridge in series
with the uppermost half part. At the beginning the rope hangs from the drum and only just touches the load, and its
parts move as formula (4) takes them to: the faster the nearer to the drum. In such a motion n masses count as the part
(1 - 1/(4 n^2)) / 3 of the rope's mass, which tends to the third of the formula.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .row import Row, RowMotion

Array = NDArray[np.float64]
SAMPLES = 10  # of the shortest period
MOST_SAMPLES = 60_000  # beyond, the rope trembles too fast to be followed
ENOUGH = 1.05  # times a period of the swing, within which the greatest force is looked for
ROUNDS = 60
NAMES = ("G_1", "G_2", "g", "C_01", "C_k", "C_2", "V_t", "a")


class TremblingError(ArithmeticError):
    """A rope whose parts tremble so fast beside the swing of the load that nobody waits until it is followed."""


@dataclass(frozen=True, slots=True)
class Heavy:
    """What a rope of n masses gives: the greatest forces at its lower end, on the load, and at the drum, SI.

    Parameters
    ----------
    F_12_max, P_12_max : float
        At the load, in both phases.
    F_drum_max : float
        At the drum, in both phases.
    """

    n: int
    t_1: float
    F_12_max: float
    P_12_max: float
    F_drum_max: float


def rope_row(found: Mapping[str, float], n: int, lifted: bool) -> Row:
    """Return the row of the load and the rope's masses, from below upwards; `lifted` off its support."""
    G_1, G_2, g, C_01, C_k, C_2, _, a = (found[name] for name in NAMES)
    masses = np.array([G_1 / g] + [G_2 / (g * n)] * n)
    top = 1.0 / (1.0 / (2.0 * n * C_k) + 1.0 / C_2)
    links = np.array([0.0 if lifted else C_01, 2.0 * n * C_k, *[n * C_k] * (n - 1), top])
    return Row(masses, links, -g * masses, np.array([0.0, a]))


def rope_of(found: Mapping[str, float], n: int) -> Heavy:
    """Lift a load by a rope of n masses.

    Parameters
    ----------
    found : mapping of str to float
        Quantities `G_1 G_2 g C_01 C_k C_2 V_t a k k_1 t_1`, SI: of a rope with weight, on a support that yields.

    Raises
    ------
    TremblingError
        It takes too long.
    """
    G_1, G_2, _, _, C_k, C_2, V_t, _ = (found[name] for name in NAMES)
    row = rope_row(found, n, False)
    hanging = np.concatenate(([G_1, 0.0], -G_2 / n * np.arange(1, n + 1)))
    stretched = np.concatenate(([0.0], np.full(n + 1, -V_t / (1.0 / C_k + 1.0 / C_2))))
    first = row.motion(hanging, stretched)
    t_1 = _lift_off(first, found)
    there = np.arange(n + 2) > 0  # what the support has is lost
    after = rope_row(found, n, True).motion(first.forces(t_1) * there, first.rates_of_forces(t_1) * there)
    F_12, F_drum = _greatest(first.of(1, n + 1), t_1)
    P_12, P_drum = _greatest(after.of(1, n + 1), ENOUGH * 2.0 * math.pi / found["k_1"])
    return Heavy(n, t_1, F_12, P_12, max(F_drum, P_drum))


def _lift_off(motion: RowMotion, found: Mapping[str, float]) -> float:
    """Return when the support is free: the first time between two samples, then by halving."""
    support = motion.of(0)
    end = found["t_1"] + 2.0 * math.pi / found["k"]
    while True:
        t = _samples(motion, end)
        free = -support.forces(t)[:, 0] >= 0.0
        if free.any():
            break
        end *= 1.5
    at = int(free.argmax())
    low, high = float(t[at - 1]), float(t[at])
    for _ in range(ROUNDS):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if -support.forces(middle)[0] >= 0.0 else (middle, high)
    return high


def _greatest(motion: RowMotion, end: float) -> tuple[float, float]:
    """Return the greatest forces of two links, between samples by parabolas."""
    forces = -motion.forces(_samples(motion, end))
    lower, upper = (_top(forces[:, i]) for i in range(2))
    return lower, upper


def _samples(motion: RowMotion, end: float) -> Array:
    fastest = float(motion.frequencies.max())
    count = end * fastest * SAMPLES / (2.0 * math.pi) + 2000.0
    if not count <= MOST_SAMPLES:
        raise TremblingError
    return np.linspace(0.0, end, int(count))


def _top(values: Array) -> float:
    at = int(values.argmax())
    if not 0 < at < len(values) - 1:
        return float(values[at])
    before, here, after = values[at - 1 : at + 2].tolist()
    bend = 2.0 * here - before - after
    return float(here + (after - before) ** 2 / (8.0 * bend)) if bend > 0.0 else float(here)
