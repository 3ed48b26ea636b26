"""Hoists to try, and their forces by other ways than the article's solutions.

Forces of hoists come from the motion integrated in extended precision, all at once: Newton's law, Hooke's law and power
series of the motion step by step; stiffnesses and the mass from integrals over the beams and the rope. Rows of one mass
are solved by eigenvalues, their lift-off found by halving, their maxima by dense sampling.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from kulman.plans.lab.ropes import Row, _RowMotion

Array = np.ndarray[Any, np.dtype[Any]]
LONG = np.longdouble
SEED = 2011
LONGEST = 40.0  # rad
NAMES = (
    *("G_1", "G_2", "L", "S", "E_k", "sigma", "K", "l_0", "I_0", "E_0", "beta_0", "l_2", "I_2", "E_2", "beta_2"),
    *("V_0", "a"),
)
# bridge cranes, V01 to V10, in SI
ROWS = (
    (50000, 160, 8, 234e-6, 1.1e11, 1400e6, 5.0, 6, 2.676e-4, 2.06e11, 0.5, 16.5, 1.20e-3, 2.06e11, 0.5, 0.10, 0.15),
    (100000, 420, 12, 412e-6, 1.05e11, 1500e6, 5.0, 5, 6.5e-4, 2.06e11, 0.5, 22.5, 4.6e-3, 2.06e11, 0.5, 0.02, 0.30),
    (32000, 90, 7, 160e-6, 1.0e11, 1400e6, 5.5, 4, 5.0e-5, 2.06e11, 0.3, 13.5, 6.0e-4, 2.06e11, 0.25, 0.13, 0.10),
    (20000, 60, 5, 117e-6, 1.1e11, 1400e6, 5.0, 8, 2.70e-5, 2.06e11, 0.5, 10.5, 4.0e-4, 2.06e11, 0.3, 0.20, 0.10),
    (200000, 1180, 14, 888e-6, 1.1e11, 1500e6, 5.0, 6, 1.6e-3, 2.06e11, 0.5, 25.5, 1.35e-2, 2.06e11, 0.5, 0.20, 0.20),
    (125000, 600, 10, 560e-6, 1.15e11, 1570e6, 6.0, 4.5, 8.0e-4, 2.06e11, 0.4, 19.5, 5.5e-3, 2.06e11, 0.45, 0.01, 0.4),
    (10000, 36, 6, 60e-6, 1.0e11, 1500e6, 5.6, 3, 2.4e-5, 1.0e10, 0.5, 6, 3.46e-5, 2.06e11, 0.5, 0.13, 0.20),
    (500000, 7400, 18, 2500e-6, 1.2e11, 1600e6, 5.5, 7, 5.5e-3, 2.06e11, 0.45, 31.5, 5.0e-2, 2.06e11, 0.4, 0.08, 0.05),
    (30000, 1180, 60, 230e-6, 1.05e11, 1450e6, 6.0, 5, 8.0e-5, 2.06e11, 0.5, 4, 7.0e-5, 2.06e11, 0.5, 0.50, 0.30),
    (25000, 70, 5, 150e-6, 1.1e11, 1440e6, 5.6, 7, 3.2e-5, 2.06e11, 0.4, 12, 5.0e-4, 2.06e11, 0.35, 0.22, 0.0),
)
VARIANTS = {
    f"V{i:02d}": {**dict(zip(NAMES, map(float, row), strict=True)), "slack": 0.0, "g": 9.81}
    for i, row in enumerate(ROWS, 1)
}


def together(hoists: list[Mapping[str, float]] | tuple[Mapping[str, float], ...]) -> dict[str, Array]:
    """Return the givens of hoists as arrays."""
    return {name: np.array([hoist[name] for hoist in hoists]) for name in hoists[0]}


def random_hoists(random: np.random.Generator, count: int, longest: float = LONGEST) -> dict[str, Array]:
    """Return the givens of cranes with all numbers varied, soft and stiff supports; some start from rest, some slack.

    Those are left out that swing for much longer than `longest`, rad, before they lift off.
    """
    found = _any_hoists(random, 4 * count)
    at = constants(found)
    height = at["m"] * at["g"] * (1 / at["C_01"] + 1 / at["C_12"])
    time = 2 * height / (at["V"] + np.sqrt(at["V"] ** 2 + 2 * at["a"] * height))
    short = np.flatnonzero(time * np.sqrt((at["C_01"] + at["C_12"]) / at["m"]) < longest)
    assert len(short) >= count
    return {name: column[short[:count]] for name, column in found.items()}


def _any_hoists(random: np.random.Generator, count: int) -> dict[str, Array]:
    pick = random.integers(len(VARIANTS), size=count)
    found = {name: column[pick] for name, column in together(tuple(VARIANTS.values())).items()}
    for name in ("G_1", "G_2", "L", "S", "l_0", "I_0", "l_2", "I_2"):
        found[name] = found[name] * 10.0 ** random.uniform(-0.4, 0.4, count)
    found["I_0"] *= 10.0 ** random.uniform(-1.0, 1.0, count)
    for name in ("beta_0", "beta_2"):
        found[name] = random.uniform(0.05, 0.5, count)
    found["V_0"] = 10.0 ** random.uniform(-1.5, 0.3, count)
    found["a"] = np.where(random.random(count) < 0.3, 0.0, 10.0 ** random.uniform(-1.5, 0.3, count))
    found["V_0"][(random.random(count) < 0.2) & (found["a"] > 0.0)] = 0.0
    found["slack"] = np.where(random.random(count) < 0.2, random.uniform(0.0, 0.1, count), 0.0)
    found["G_2"][random.random(count) < 0.1] = 0.0
    return found


def _simpson(function: Any, low: Any, high: Any) -> Any:
    """Return an integral, exact for parabolas."""
    return (high - low) / 6 * (function(low) + 4 * function((low + high) / 2) + function(high))


def _beam(l: Any, beta: Any, E: Any, I: Any) -> Any:
    """Return the stiffness of a simple beam at beta l: its work under a unit load is half the deflection there."""
    b = beta * l
    near = _simpson(lambda x: ((l - b) / l * x) ** 2, 0 * b, b)
    far = _simpson(lambda x: (b / l * (l - x)) ** 2, b, l)
    return E * I / (near + far)


def constants(values: Mapping[str, Any]) -> dict[str, Any]:
    """Return m, C_01, C_12, the speed when the rope is taut, a, g in extended precision."""
    at = {name: np.asarray(value, LONG) for name, value in values.items()}
    g, L, V, a = at["g"], at["L"], at["V_0"], at["a"]
    of_rope = _simpson(lambda x: at["G_2"] / (g * L) * (x / L) ** 2, 0 * L, L)
    C_2 = _beam(at["l_2"], at["beta_2"], at["E_2"], at["I_2"])
    compliance = L / (at["S"] * at["E_k"]) + 1 / C_2
    time = 2 * at["slack"] / np.where(at["slack"] > 0, V + np.sqrt(V * V + 2 * a * at["slack"]), 1)
    C_01 = _beam(at["l_0"], at["beta_0"], at["E_0"], at["I_0"])
    return {"m": at["G_1"] / g + of_rope, "C_01": C_01, "C_12": 1 / compliance, "V": V + a * time, "a": a, "g": g}


ORDER = 34  # of the power series; with such steps the next term is below 1e-33
STEP = 1.5
PARTS = 8  # of a step, in which extremes are looked for
ROUNDS, CLOSE = 200, 1e-19


class Series:
    """Power series of the motion over one step: coefficients along the first axis."""

    def __init__(self, coefficients: list[Any]) -> None:
        self.coefficients = np.array(np.broadcast_arrays(*coefficients))

    def at(self, t: Any) -> Any:
        """Return the value at a time since the begin of the step."""
        found = self.coefficients[-1]
        for c in self.coefficients[-2::-1]:
            found = found * t + c
        return found

    def some(self, which: Any) -> Series:
        """Return the series of some of the hoists."""
        return Series(list(self.coefficients[:, which]))

    def rate(self) -> Series:
        """Return its derivative."""
        powers = np.arange(1, len(self.coefficients), dtype=LONG)
        return Series(list(self.coefficients[1:] * powers[:, np.newaxis]))

    def zero(self, low: Any, high: Any) -> Any:
        """Return a zero between places where the sign differs, by Newton's steps inside and by halving."""
        above, rate, x = self.at(low) > 0, self.rate(), (low + high) / 2
        for done in range(ROUNDS):
            value = self.at(x)
            low, high = np.where((value > 0) == above, x, low), np.where((value > 0) == above, high, x)
            newton = x - value / np.where((slope := rate.at(x)) == 0, 1, slope)
            inside = (newton > low) & (newton < high) & (done % 3 != 2)
            before, x = x, np.where(inside, newton, (low + high) / 2)
            if np.all(np.abs(x - before) <= CLOSE * np.abs(x)):
                break
        return x


class Extremes:
    """The largest and the smallest of what has turned: value and time of each, for every hoist."""

    def __init__(self, size: int) -> None:
        self.most, self.at_most = np.full(size, -np.inf, LONG), np.full(size, np.nan, LONG)
        self.least, self.at_least = np.full(size, np.inf, LONG), np.full(size, np.nan, LONG)

    def look(self, curve: Series, begin: Any, end: Any) -> None:
        """Look for turnings of a curve from 0 to `end`; its times count from `begin`."""
        rate, places = curve.rate(), end * (np.arange(PARTS + 1, dtype=LONG) / PARTS)[:, np.newaxis]
        slopes = rate.at(places)
        for sign, best, when in ((1, self.most, self.at_most), (-1, self.least, self.at_least)):
            rows, turns = np.nonzero((sign * slopes[:-1] > 0) & (sign * slopes[1:] <= 0))
            if len(turns):
                t = rate.some(turns).zero(places[rows, turns], places[rows + 1, turns])
                for hoist, value, time in zip(turns, curve.some(turns).at(t), begin[turns] + t, strict=True):
                    if sign * value > sign * best[hoist]:
                        best[hoist], when[hoist] = value, time


def two_sided(values: Mapping[str, Any]) -> dict[str, Array]:
    """Return t_1, the forces and times of both phases by integration, as long as nothing is one-sided."""
    at = constants(values)
    m, C_01, C_12, V, a, g = (np.atleast_1d(at[name]) for name in ("m", "C_01", "C_12", "V", "a", "g"))
    size = len(m)
    V, a, g = (np.broadcast_to(value, size) for value in (V, a, g))
    h = STEP / np.sqrt((C_01 + C_12) / m)
    t, u, v = (np.zeros(size, LONG) for _ in range(3))  # displacement and speed from the static place
    found, forces, t_1 = Extremes(size), np.full(size, np.nan, LONG), np.full(size, np.nan, LONG)
    start = [np.zeros(size, LONG) for _ in range(2)]
    while np.isnan(t_1).any():
        y = [V * t + a * t * t / 2, V + a * t, a / 2]
        c = [u, v]
        for j in range(ORDER):
            wound = C_12 * y[j] if j < 3 else 0
            c.append((wound - (C_01 + C_12) * c[j]) / (m * (j + 1) * (j + 2)))
        place, stretch = Series(c), Series([(y[j] if j < 3 else 0) - c[j] for j in range(len(c))])
        going = np.isnan(t_1)
        leaves = going & (C_01 * place.at(h) >= m * g)
        tau, left = h + 0, np.flatnonzero(leaves)
        if len(left):
            over = Series([c[0] - m * g / C_01, *c[1:]]).some(left)
            tau[left] = over.zero(np.zeros(len(left), LONG), h[left])
        found.look(Series(list(stretch.coefficients * np.where(going, C_12, np.nan))), t, tau)
        t_1 = np.where(leaves, t + tau, t_1)
        forces = np.where(leaves, C_12 * stretch.at(tau), forces)
        start = [
            np.where(leaves, curve.rate().at(tau), old) for curve, old in zip((stretch, place), start, strict=True)
        ]
        u, v, t = place.at(h), place.rate().at(h), t + h
    phase_1 = {"t_1": t_1, "F_12_t1": forces, "F_12_max": np.fmax(found.most, forces)}
    phase_1["t_F12_max"] = np.where(found.most > forces, found.at_most, t_1)
    phase_1["F_12_min"] = np.fmin(found.least, forces)
    hanging = _hanging({"m": m, "C_12": C_12, "V": V, "a": a, "g": g}, forces / C_12, *start)
    return {name: np.asarray(value, float) for name, value in {**phase_1, **hanging}.items()}


def _hanging(at: Mapping[str, Any], e: Any, de: Any, ds: Any) -> dict[str, Any]:
    """Return what is found after the lift-off, over one swing, from stretch, its rate, and the speed of the load."""
    m, C_12, a, g = (at[name] for name in ("m", "C_12", "a", "g"))
    turn = 2 * np.pi * np.sqrt(m / C_12)
    steps = 16
    h, T, s = turn / steps, np.zeros_like(e), np.zeros_like(e)
    forces, heights = Extremes(len(e)), Extremes(len(e))
    for _ in range(steps):
        c, z = [e, de], [s, ds]
        for j in range(ORDER):
            pull = C_12 * c[j] / m
            bend = ((a + g if j == 0 else 0) - pull, pull - (g if j == 0 else 0))
            for row, part in zip((c, z), bend, strict=True):
                row.append(part / ((j + 1) * (j + 2)))
        stretch, height = Series(c), Series(z)
        forces.look(Series(list(stretch.coefficients * C_12)), T, h)
        heights.look(height, T, h)
        e, de, s, ds, T = stretch.at(h), stretch.rate().at(h), height.at(h), height.rate().at(h), T + h
    lowest = np.where(np.isfinite(heights.least), heights.least, s)
    return {"P_12_max": forces.most, "T_1": forces.at_most, "P_12_min": forces.least, "s_min": lowest}


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

    first: _RowMotion
    second: _RowMotion
    t_1: Array
    period: Array
    F_12_max: Array
    P_12_max: Array

    def F_12(self, t: Array) -> Array:
        """Rope's force at times of shape (rows, N)."""
        on_support = -self.first.forces(np.minimum(t, self.t_1))[..., 1]
        later: Array = np.where(t < self.t_1, on_support, -self.second.forces(np.maximum(t - self.t_1, 0.0))[..., 1])
        return later


def hoist_row(values: Mapping[str, Any]) -> _RowMotion:
    """Return phase 1 of a hoist as the row with n = 1: the forces are -F_01 and -F_12.

    Parameters
    ----------
    values : mapping of str to float or array
        `m C_01 C_12 V_t a g`, SI; the stiffnesses finite.
    """
    m, C_12, V_t, g, none = np.broadcast_arrays(
        *(np.asarray(values[name], float) for name in ("m", "C_12", "V_t", "g")), 0.0
    )
    return _row(values, values["C_01"]).motion(np.stack((m * g, none), axis=-1), np.stack((none, -C_12 * V_t), axis=-1))


def _row(values: Mapping[str, Any], C_01: Any) -> Row:
    """Return a load between its support and the drum, which winds with the acceleration a."""
    m, C_12, a, g, low, none = np.broadcast_arrays(
        *(np.asarray(values[name], float) for name in ("m", "C_12", "a", "g")), C_01, 0.0
    )
    return Row(m[..., None], np.stack((low, C_12), axis=-1), (-m * g)[..., None], np.stack((none, a), axis=-1))


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
    there = np.array([0.0, 1.0])  # what the lower link has is lost
    second = _row(values, 0.0).motion(first.forces(high) * there, first.rates_of_forces(high) * there)
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
