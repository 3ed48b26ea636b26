"""Hoists by another way: rows of one mass solved by eigenvalues, lift-off by halving, maxima by dense sampling."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from kulman.plans.lab.ropes import Row, RowMotion

Array = NDArray[np.float64]
# plausible cranes and others, among them many swings before lift-off, one, none; speeds and accelerations of zero
SEVERAL = {
    "m": np.array([5102.0, 10208.0, 3265.0, 2041.0, 1032.0, 3098.0, 2551.0]),
    "C_01": np.array([1.2e7, 3.6e7, 1.1e7, 5.2e5, 4.3e5, 6.3e6, 1.6e6]),
    "C_12": np.array([1.6e6, 1.4e6, 1.5e6, 1.7e6, 6.1e5, 3.9e5, 2.8e6]),
    "V_t": np.array([0.10, 0.02, 0.13, 0.20, 0.13, 0.50, 0.22]),
    "a": np.array([0.15, 0.30, 0.10, 0.10, 0.20, 0.30, 0.0]),
    "g": np.full(7, 9.81),
}


@dataclass(frozen=True, slots=True, eq=False)
class Exact:
    """What integrators are held against, of N hoists."""

    first: RowMotion
    second: RowMotion
    t_1: Array
    period: Array
    F_12_max: Array
    P_12_max: Array

    def F_12(self, t: Array) -> Array:
        """Rope's force at times of shape (rows, N)."""
        on_support = -self.first.forces(np.minimum(t, self.t_1))[..., 1]
        later: Array = np.where(t < self.t_1, on_support, -self.second.forces(np.maximum(t - self.t_1, 0.0))[..., 1])
        return later


def hoist_row(values: Mapping[str, Any]) -> RowMotion:
    """Return phase 1 of a hoist as the row with n = 1: the forces are -F_01 and -F_12.

    Parameters
    ----------
    values : mapping of str to float or array
        `m C_01 C_12 V_t a g`, SI; the stiffnesses finite.
    """
    m, C_01, C_12, V_t, a, g = np.broadcast_arrays(
        *(np.asarray(values[name], float) for name in ("m", "C_01", "C_12", "V_t", "a", "g"))
    )
    none = np.zeros_like(m)
    row = Row(
        m[..., None], np.stack((C_01, C_12), axis=-1), (-m * g)[..., None], np.stack((none, np.asarray(a)), axis=-1)
    )
    return row.motion(np.stack((m * g, none), axis=-1), np.stack((none, -C_12 * V_t), axis=-1))


def lifted(values: Mapping[str, Array], first: RowMotion, t_1: Array) -> RowMotion:
    """Phase 2: the same row without its lower link."""
    none = np.zeros_like(values["m"])
    row = Row(
        values["m"][:, None],
        np.stack((none, values["C_12"]), -1),
        (-values["m"] * values["g"])[:, None],
        np.stack((none, values["a"]), -1),
    )
    there = np.array([0.0, 1.0])  # what the lower link has is lost
    return row.motion(first.forces(t_1) * there, first.rates_of_forces(t_1) * there)


def exact(values: Mapping[str, Array]) -> Exact:
    """Solve hoists of finite stiffnesses."""
    first = hoist_row(values)
    low, high = np.zeros_like(values["m"]), np.full_like(values["m"], 1e-3)
    while (resting := -first.forces(high)[..., 0] < 0.0).any():
        high = np.where(resting, 2.0 * high, high)
    for _ in range(100):
        middle = 0.5 * (low + high)
        off = -first.forces(middle)[..., 0] >= 0.0
        low, high = np.where(off, low, middle), np.where(off, middle, high)
    second = lifted(values, first, high)
    period = 2.0 * np.pi * np.sqrt(values["m"] / values["C_12"])
    part = np.linspace(0.0, 1.0, 4001)[:, None]
    maxima = [_top(-motion.forces(part * end)[..., 1]) for motion, end in ((first, high), (second, period))]
    return Exact(first, second, high, period, *maxima)


def _top(values: Array) -> Array:
    """Largest value of every column, refined by a parabola where it is not at an end."""
    at, own = values.argmax(axis=0), np.arange(values.shape[1])
    inner = np.clip(at, 1, len(values) - 2)
    before, here, after = (values[inner + s, own] for s in (-1, 0, 1))
    bend = 2.0 * here - before - after
    found: Array = np.where((inner == at) & (bend > 0.0), here + (after - before) ** 2 / (8.0 * bend), values[at, own])
    return found
