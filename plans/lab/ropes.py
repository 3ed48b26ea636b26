"""How deep the model of a hoist must be: what simplifications change, and whether one mass is enough.

One reduced mass stands for the load and n masses of the rope in a row. The rope is cut into n equal parts, each a mass
in its middle; its stiffness lies between, that of the bridge in series with the uppermost half part. At the beginning
the rope hangs from the drum and only just touches the load, and its parts move as formula (4) takes them to: the faster
the nearer to the drum. In such a motion n masses count as the part (1 - 1/(4 n^2)) / 3 of the rope's mass, which tends
to the third of the formula.

The forces of the links of such a row are found without their deformations. Masses 1..n stand between two ends, 0 and
n+1, whose motions are given; link i joins mass i to mass i+1. With the forces Q_i on the masses and
Q_(i,i+1) = c_(i,i+1) (q_i - q_(i+1)) in the links,

    a_i q''_i = Q_i + Q_(i-1,i) - Q_(i,i+1)                                                    (1)
    Q''_(i,i+1) = c_(i,i+1) (q''_i - q''_(i+1))                                                (2)
    -c/a_i Q_(i-1,i) + (p^2 + k^2) Q_(i,i+1) - c/a_(i+1) Q_(i+1,i+2) = c (Q_i/a_i - Q_(i+1)/a_(i+1))   (3)

with c = c_(i,i+1), k^2 = c (1/a_i + 1/a_(i+1)), p = d/dt. At an end the acceleration of that end stands for Q/a, and
1/a = 0. A link of no stiffness carries no force: an end that is free has such a link.

Source: Karpenko, Muzyka, Gudym, formulas (1) to (3).
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..hoist.forces import forces, valid
from ..hoist.hoist import Numbers
from ..hoist.model import model

Array = NDArray[np.float64]
SAMPLES = 10  # of the shortest period
MOST_SAMPLES = 60_000  # beyond, the rope trembles too fast to be followed
ENOUGH = 1.05  # times a period of the swing, within which the greatest force is looked for
ROUNDS = 60
NAMES = ("G_1", "G_2", "g", "C_01", "C_k", "C_2", "V_t", "a")


class _TremblingError(ArithmeticError):
    """A rope whose parts tremble so fast beside the swing of the load that nobody waits until it is followed."""


@dataclass(frozen=True, slots=True)
class _Heavy:
    """What a rope of n masses gives: the greatest forces at its lower end, on the load, and at the drum, SI."""

    n: int
    t_1: float
    # at the load, in both phases
    F_12_max: float
    P_12_max: float
    F_drum_max: float  # at the drum, in both phases


def _rope_row(found: Numbers, n: int, lifted: bool) -> Row:
    """Return the row of the load and the rope's masses, from below upwards; `lifted` off its support."""
    G_1, G_2, g, C_01, C_k, C_2, _, a = (found[name] for name in NAMES)
    masses = np.array([G_1 / g] + [G_2 / (g * n)] * n)
    top = 1.0 / (1.0 / (2.0 * n * C_k) + 1.0 / C_2)
    links = np.array([0.0 if lifted else C_01, 2.0 * n * C_k, *[n * C_k] * (n - 1), top])
    return Row(masses, links, -g * masses, np.array([0.0, a]))


def _rope_of(found: Numbers, n: int) -> _Heavy:
    """Lift a load by a rope of n masses, with weight, on a support that yields.

    Needed are `G_1 G_2 g C_01 C_k C_2 V_t a k k_1 t_1`, SI. Raises TremblingError where that takes too long.
    """
    G_1, G_2, _, _, C_k, C_2, V_t, _ = (found[name] for name in NAMES)
    row = _rope_row(found, n, False)
    hanging = np.concatenate(([G_1, 0.0], -G_2 / n * np.arange(1, n + 1)))
    stretched = np.concatenate(([0.0], np.full(n + 1, -V_t / (1.0 / C_k + 1.0 / C_2))))
    first = row.motion(hanging, stretched)
    t_1 = _lift_off(first, found)
    there = np.arange(n + 2) > 0  # what the support has is lost
    after = _rope_row(found, n, True).motion(first.forces(t_1) * there, first.rates_of_forces(t_1) * there)
    F_12, F_drum = _greatest(first.of(1, n + 1), t_1)
    P_12, P_drum = _greatest(after.of(1, n + 1), ENOUGH * 2.0 * math.pi / found["k_1"])
    return _Heavy(n, t_1, F_12, P_12, max(F_drum, P_drum))


def _lift_off(motion: _RowMotion, found: Numbers) -> float:
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


def _greatest(motion: _RowMotion, end: float) -> tuple[float, float]:
    """Return the greatest forces of two links, between samples by parabolas."""
    forces = -motion.forces(_samples(motion, end))
    lower, upper = (_top(forces[:, i]) for i in range(2))
    return lower, upper


def _samples(motion: _RowMotion, end: float) -> Array:
    fastest = float(motion.frequencies.max())
    count = end * fastest * SAMPLES / (2.0 * math.pi) + 2000.0
    if not count <= MOST_SAMPLES:
        raise _TremblingError
    return np.linspace(0.0, end, int(count))


def _top(values: Array) -> float:
    at = int(values.argmax())
    if not 0 < at < len(values) - 1:
        return float(values[at])
    before, here, after = values[at - 1 : at + 2].tolist()
    bend = 2.0 * here - before - after
    return float(here + (after - before) ** 2 / (8.0 * bend)) if bend > 0.0 else float(here)


@dataclass(frozen=True, slots=True, eq=False)
class Row:
    """Masses in a row; leading axes hold many rows at once."""

    masses: Array  # shape (..., n): a_1..a_n, kg
    stiffnesses: Array  # shape (..., n + 1): c_(0,1)..c_(n,n+1), N/m; zero where there is no link
    forces: Array  # shape (..., n): Q_1..Q_n, constant, N
    ends: Array  # shape (..., 2): accelerations of both ends, constant, m/s^2

    @property
    def drive(self) -> Array:
        """Right-hand sides of (3), N/s^2, of shape (..., n + 1)."""
        own = self.forces * (1.0 / self.masses)
        along = np.concatenate((self.ends[..., :1], own, self.ends[..., 1:]), axis=-1)
        driven: Array = self.stiffnesses * (along[..., :-1] - along[..., 1:])
        return driven

    def motion(self, start: ArrayLike, rates: ArrayLike) -> _RowMotion:
        """Solve (3) from the forces of the links, N, and their rates, N/s, at t = 0.

        The matrix is that of M^(-1/2) D c^(1/2), multiplied by its transpose, between square roots of stiffnesses: the
        singular values of the one are the frequencies. Slow modes keep digits so that eigenvalues of the product lose
        beside stiff links.
        """
        c, heavy = np.sqrt(self.stiffnesses), 1.0 / np.sqrt(self.masses)
        links = c.shape[-1]
        halves = np.zeros((*np.broadcast_shapes(c.shape[:-1], heavy.shape[:-1]), links - 1, links))
        at = np.arange(links - 1)
        halves[..., at, at], halves[..., at, at + 1] = -heavy * c[..., :-1], heavy * c[..., 1:]
        _, frequencies, modes = np.linalg.svd(halves)
        still = np.zeros((*frequencies.shape[:-1], 1))  # one mode more than there are masses
        present = c > 0.0
        relaxed = np.where(present, 1.0 / np.where(present, c, 1.0), 0.0)
        driven = (np.asarray(value, float) * relaxed for value in (start, rates, self.drive))
        parts = ((modes * value[..., None, :]).sum(axis=-1) for value in driven)
        return _RowMotion(np.concatenate((frequencies, still), axis=-1), modes, c, *parts)


@dataclass(frozen=True, slots=True, eq=False)
class _RowMotion:
    """The forces of the links over time: oscillations of the modes, one of which may be still."""

    frequencies: Array  # shape (..., n + 1): of the modes, rad/s, falling; the last is zero
    modes: Array  # shape (..., n + 1, links): a mode a row, in forces divided by the square roots of the stiffnesses
    scale: Array  # shape (..., links): square roots of the stiffnesses
    # shape (..., n + 1): forces, their rates at t = 0 and right-hand sides, in modes
    start: Array
    rates: Array
    drive: Array

    def of(self, *links: int) -> _RowMotion:
        """Return the same motion, of which only some links are looked at."""
        chosen = list(links)
        return replace(self, modes=self.modes[..., chosen], scale=self.scale[..., chosen])

    def forces(self, t: ArrayLike) -> Array:
        """Return the forces, N, at times (of the shape of the leading axes, or of axes before them), s."""
        x = np.asarray(t, float)[..., None]
        w = self.frequencies
        late = 0.5 * x * _sinc(0.5 * w * x)
        found = self.start * np.cos(w * x) + self.rates * (x * _sinc(w * x)) + self.drive * (2.0 * late * late)
        return self._of_links(found)

    def rates_of_forces(self, t: ArrayLike) -> Array:
        """Return the first derivatives of the forces, N/s."""
        x = np.asarray(t, float)[..., None]
        w = self.frequencies
        found = self.rates * np.cos(w * x) + (self.drive - self.start * (w * w)) * (x * _sinc(w * x))
        return self._of_links(found)

    def _of_links(self, found: Array) -> Array:
        mixed: Array = (self.modes * found[..., :, None]).sum(axis=-2) * self.scale
        return mixed


def _sinc(x: Array) -> Array:
    """Return sin(x) / x, 1 at 0."""
    return np.sinc(x * (1.0 / math.pi))


COMPARED = ("t_1", "F_12_max", "P_12_max", "F_max")
SIMPLER: Mapping[str, Numbers] = {  # simplifications, and what is given then
    "G_2": {"G_2": 0.0},
    "I_2": {"I_2": math.inf},
    "I_0": {"I_0": math.inf},
    "beams": {"I_0": math.inf, "I_2": math.inf},
    "all": {"I_0": math.inf, "I_2": math.inf, "G_2": 0.0},
}
PRINTED = "printed"  # the article's formula (14) in the place of (14')
MASSES = (1, 2, 4, 8, 16, 32)
MANY = 8  # masses that stand for a rope with its mass spread out, where many ropes are looked at
RATIOS = tuple(10.0 ** (0.25 * i - 3.0) for i in range(13))  # G_2 / G_1, from 0.001 to 1


# what a simpler model changes, in parts of what the full one gives; None where nothing can be compared
Changes = Mapping[str, float | None]


@dataclass(frozen=True, slots=True)
class _OneMass:
    """One reduced mass beside a rope of many masses; errors in parts."""

    ratio: float
    t_1: float
    # F_max of one mass less that of the rope at its lower and upper end
    at_load: float
    at_drum: float

    @property
    def worst(self) -> float:
        """The larger error of the force."""
        return max(abs(self.at_load), abs(self.at_drum))


@dataclass(frozen=True, slots=True)
class HoistDepth:
    """How deep the model must be."""

    full: Numbers  # the quantities of the full model, of `COMPARED`, SI
    simpler: Mapping[str, Changes]  # in the order of `SIMPLER`, the article's formula last
    # ropes of more and more masses, as far as they can be followed; empty where the rope weighs nothing, the support is
    # rigid or formulas are not valid
    ropes: tuple[_Heavy, ...]
    ratio: float  # G_2 / G_1 of this hoist
    one_mass: tuple[_OneMass, ...]  # beside a rope of `MANY` masses, over the ratio of the weights
    tolerance: float  # in parts

    @property
    def here(self) -> _OneMass | None:
        """One mass beside the rope of the most masses of this hoist itself."""
        return _beside(self.full, self.ropes[-1], self.ratio) if self.ropes else None

    @property
    def enough_to(self) -> float:
        """The ratio of the weights up to which one mass misses by no more than the tolerance, between those known."""
        before: _OneMass | None = None
        for one in self.one_mass:
            if one.worst > self.tolerance:
                return 0.0 if before is None else _between(before, one, self.tolerance)
            before = one
        return math.inf

    @property
    def spare(self) -> tuple[str, ...]:
        """Simplifications that change the greatest force by no more than the tolerance."""
        parts = {key: changes["F_max"] for key, changes in self.simpler.items()}
        return tuple(key for key, part in parts.items() if part is not None and abs(part) <= self.tolerance)


def depth(
    values: Numbers, tolerance: float, masses: Iterable[int] = MASSES, ratios: Iterable[float] = RATIOS
) -> HoistDepth:
    """Look at simpler models of a hoist with complete givens, SI, and at ropes of many masses.

    The `tolerance`, in parts, is an error of the greatest force that does not count.
    """
    whole = forces(values)
    found = whole.found
    full = {name: found[name] for name in COMPARED}
    simpler = {key: _changes(full, forces({**values, **other}).found) for key, other in SIMPLER.items()}
    printed = dict.fromkeys(COMPARED, math.nan)
    printed |= dict.fromkeys(("P_12_max", "F_max"), float(found["P_12_max_printed"]))
    simpler[PRINTED] = _changes(full, printed)
    swings = math.isfinite(found["C_01"]) and whole.motion is None
    followed = (_followed(found, n) for n in masses) if swings and values["G_2"] > 0.0 else ()
    ropes = tuple(filter(None, followed))
    compared = (_at_ratio(values, ratio) for ratio in ratios) if swings else ()
    lighter = tuple(filter(None, compared))
    return HoistDepth(full, simpler, ropes, values["G_2"] / values["G_1"], lighter, tolerance)


def _changes(full: Numbers, other: Numbers) -> Changes:
    changes = {name: float(other[name]) / full[name] - 1.0 for name in COMPARED}
    return {name: change if math.isfinite(change) else None for name, change in changes.items()}


def _at_ratio(values: Numbers, ratio: float) -> _OneMass | None:
    """Compare one mass with many for the same load on a rope of other weight; None where no formula is valid."""
    found = model({**values, "G_2": ratio * values["G_1"]})
    rope = _followed(found, MANY) if valid(found) else None
    return None if rope is None else _beside(found, rope, ratio)


def _followed(found: Numbers, n: int) -> _Heavy | None:
    """Return what a rope of n masses gives; None where it trembles too fast to be followed."""
    try:
        return _rope_of(found, n)
    except _TremblingError:
        return None


def _beside(found: Numbers, rope: _Heavy, ratio: float) -> _OneMass:
    at_load = found["F_max"] / max(rope.F_12_max, rope.P_12_max) - 1.0
    return _OneMass(ratio, found["t_1"] / rope.t_1 - 1.0, at_load, found["F_max"] / rope.F_drum_max - 1.0)


def _between(low: _OneMass, high: _OneMass, tolerance: float) -> float:
    """Return the ratio at which the error is the tolerance, on a straight line of logarithms."""
    if low.worst <= 0.0:
        return low.ratio
    error_low, error_high = np.log(low.worst), np.log(high.worst)
    part = (math.log(tolerance) - error_low) / (error_high - error_low)
    return float(low.ratio * (high.ratio / low.ratio) ** part)
