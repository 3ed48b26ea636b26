"""Rows of masses against displacements, closed forms and the continuous rope; what simpler models of a hoist change."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pytest
from numpy.typing import NDArray

from kulman.plans.hoist.forces import forces
from kulman.plans.hoist.model import model
from kulman.plans.lab.ropes import PRINTED, SIMPLER, HoistDepth, Row, _Heavy, _rope_of, _rope_row, depth
from kulman.tests.support.hoists import SEVERAL, VARIANTS, hoist_row

Array = NDArray[np.float64]
SEED = 20


def random_row(random: np.random.Generator, masses: int) -> tuple[Row, Array, Array]:
    """A row with random displacements and velocities of its masses; its ends stand at 0 and begin to move."""
    row = Row(
        np.exp(random.normal(0.0, 1.0, masses)),
        np.exp(random.normal(3.0, 1.0, masses + 1)),
        random.normal(0.0, 5.0, masses),
        random.normal(0.0, 2.0, 2),
    )
    return row, random.normal(0.0, 1.0, (2, masses + 2)), np.linspace(0.1, 4.0, 7)


def by_exponential(row: Row, begin: Array, t: float) -> Array:
    """Forces of the links from displacements: the exponential of the matrix of (1), by its series."""
    n = len(row.masses)
    size = 2 * (n + 2)
    system = np.zeros((size + 1, size + 1), np.longdouble)  # displacements, velocities, and 1
    system[: n + 2, n + 2 : size] = np.eye(n + 2)
    for i in range(1, n + 1):
        for link, other in ((i - 1, i - 1), (i, i + 1)):
            system[n + 2 + i, other] += row.stiffnesses[link] / row.masses[i - 1]
            system[n + 2 + i, i] -= row.stiffnesses[link] / row.masses[i - 1]
        system[n + 2 + i, size] = row.forces[i - 1] / row.masses[i - 1]
    system[n + 2, size], system[size - 1, size] = row.ends
    state = np.concatenate((begin.ravel(), [1.0])).astype(np.longdouble)
    for _ in range(parts := 64):
        term = state
        for k in range(1, 40):
            term = system @ term * (t / parts / k)
            state = state + term
    q = state[: n + 2]
    return (row.stiffnesses * (q[:-1] - q[1:])).astype(float)


@pytest.mark.parametrize("masses", [1, 2, 3, 6])
def test_forces_of_a_row_are_those_of_its_displacements(masses: int) -> None:
    row, begin, times = random_row(np.random.default_rng(SEED), masses)
    start, rates = (row.stiffnesses * (q[:-1] - q[1:]) for q in begin)

    motion = row.motion(start, rates)

    for t in times:
        right = by_exponential(row, begin, t)
        assert motion.forces(t) == pytest.approx(right, abs=1e-12 * np.abs(right).max() * (1.0 + t))


def test_free_row_of_two_masses_swings_with_k_of_the_article() -> None:
    a, c = np.array([2.0, 5.0]), np.array([0.0, 70.0, 0.0])
    row = Row(a, c, np.array([3.0, -4.0]), np.zeros(2))
    k = np.sqrt(70.0 * (2.0 + 5.0) / (2.0 * 5.0))
    mean = 70.0 * (5.0 * 3.0 + 2.0 * 4.0) / (2.0 * 5.0) / k**2

    motion = row.motion([0.0, 11.0, 0.0], [0.0, 13.0, 0.0])

    t = 0.37
    right = mean + (11.0 - mean) * np.cos(k * t) + 13.0 / k * np.sin(k * t)
    assert motion.forces(t) == pytest.approx([0.0, right, 0.0], rel=1e-13)


def test_hoist_is_the_row_of_one_mass() -> None:
    m, C_01, C_12, V_0, a, g = (SEVERAL[name] for name in ("m", "C_01", "C_12", "V_t", "a", "g"))
    C, k = C_01 * C_12 / (C_01 + C_12), np.sqrt((C_01 + C_12) / m)

    motion = hoist_row(SEVERAL)

    for t in np.linspace(0.0, 0.6, 25):
        osc = a / k**2 * (1.0 - np.cos(k * t)) + V_0 / k * np.sin(k * t)
        y = V_0 * t + 0.5 * a * t * t
        F_01, F_12 = C * (y - osc) - m * g, C * (C_12 / C_01 * osc + y)
        size = np.maximum(m * g, np.abs(F_12))
        assert np.all(np.abs(-motion.forces(t) - np.stack((F_01, F_12), -1)) <= 1e-12 * size[:, None])


def test_slow_modes_keep_their_digits_beside_stiff_links() -> None:
    values = {name: value[:1] for name, value in SEVERAL.items()} | {"C_01": np.array([1e19])}
    m, C_12 = values["m"], values["C_12"]

    motion = hoist_row(values)

    t = 0.5
    y = 0.1 * t + 0.5 * 0.15 * t * t
    assert -motion.forces(t)[0, 1] == pytest.approx(float(C_12[0] * y), rel=1e-9)
    trembling = float(C_12[0] * 0.1 / np.sqrt(1e19 / m[0]))  # what the load swings with on the hard support
    assert -motion.forces(t)[0, 0] == pytest.approx(float(C_12[0] * y - m[0] * 9.81), abs=1.01 * trembling)


LONG = VARIANTS["V09"]  # 3 t on a long rope


@cache
def rope(n: int) -> _Heavy:
    return _rope_of(model(LONG), n)


def by_steps(n: int) -> tuple[float, float, float]:
    """Lift-off and the greatest forces at load and drum, from displacements of all masses by steps of fourth order."""
    found = model(LONG)
    r, c = 1180.0 / 9.81 / n, n * found["C_k"]
    mass = np.array([30e3 / 9.81] + [r] * n)
    springs = np.array([2.0 * c, *[c] * (n - 1), 1.0 / (0.5 / c + 1.0 / found["C_2"])])
    hanging = np.array([0.0, *(r * 9.81 * np.arange(1, n + 1))])
    rest = np.concatenate(([-30e3 / found["C_01"]], np.zeros(n)))
    for i in range(n):  # how far the rope's parts are from one another where nothing pulls
        rest[i + 1] = rest[i] + hanging[i] / springs[i]
    drum = rest[-1] + hanging[-1] / springs[-1]

    def forces(t: float, q: np.ndarray) -> np.ndarray:
        upper = np.append(q[1:], drum + 0.5 * t + 0.15 * t * t)
        return springs * (upper - q)

    def rate(t: float, state: np.ndarray) -> np.ndarray:
        pull = forces(t, state[0])
        bend = pull - np.concatenate(([found["C_01"] * state[0][0] * (not off)], pull[:-1])) - mass * 9.81
        return np.stack((state[1], bend / mass))

    below = np.concatenate(([0.0], (np.arange(n) + 0.5) / c))  # what yields below each mass
    state = np.stack((rest, 0.5 * below / (1.0 / found["C_k"] + 1.0 / found["C_2"])))
    h, t, off, t_1, greatest = 2e-4, 0.0, False, math.nan, np.zeros(2)
    while t < 0.46:
        k_1 = rate(t, state)
        k_2 = rate(t + 0.5 * h, state + 0.5 * h * k_1)
        k_3 = rate(t + 0.5 * h, state + 0.5 * h * k_2)
        new = state + h / 6.0 * (k_1 + 2.0 * (k_2 + k_3) + rate(t + h, state + h * k_3))
        if not off and new[0][0] >= 0.0:
            off, t_1 = True, t - h * state[0][0] / (new[0][0] - state[0][0])
        state, t = new, t + h
        greatest = np.maximum(greatest, forces(t, state[0])[[0, -1]])
    return t_1, *greatest.tolist()


def test_rope_of_masses_has_the_forces_of_its_displacements() -> None:
    t_1, at_load, at_drum = by_steps(2)

    assert rope(2).t_1 == pytest.approx(t_1, rel=1e-5)
    assert max(rope(2).F_12_max, rope(2).P_12_max) == pytest.approx(at_load, rel=1e-4)
    assert rope(2).F_drum_max == pytest.approx(at_drum, rel=1e-4)


def test_slowest_swing_tends_to_that_of_a_continuous_rope() -> None:
    found = model(LONG) | {"C_2": math.inf}
    ratio = 1180.0 / 30e3
    low, high = 0.0, 0.5 * math.pi
    for _ in range(60):  # x tg x = m_rope / m_load
        middle = 0.5 * (low + high)
        low, high = (low, middle) if middle * math.tan(middle) > ratio else (middle, high)
    right = low * math.sqrt(found["C_k"] / (1180.0 / 9.81))

    errors = []
    for n in (4, 8):
        motion = _rope_row(found, n, True).motion(np.zeros(n + 2), np.zeros(n + 2))
        errors.append(float(np.sort(motion.frequencies)[-n - 1]) / right - 1.0)

    assert abs(errors[1]) < 5e-5
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.02)


def test_lift_off_tends_to_its_limit_as_the_rope_is_cut_finer_and_to_one_mass_as_it_is_lighter() -> None:
    steps = np.abs(np.diff([rope(n).t_1 for n in (1, 4, 16)]))  # the parts tremble: no clean order
    assert steps[0] > 4.0 * steps[1]

    found = model(LONG | {"G_2": 0.1})
    light = _rope_of(found, 2)
    for name in ("t_1", "P_12_max", "F_12_max"):
        assert getattr(light, name) == pytest.approx(found[name], rel=1e-5)


@cache
def looked_at() -> HoistDepth:
    return depth(LONG, 0.01, (1, 4), (1e-3, 1e-2, 1e-1))


def test_every_simplification_says_what_it_changes() -> None:
    found = looked_at().simpler

    assert list(found) == [*SIMPLER, PRINTED]
    full, light = model(LONG), model(LONG | {"G_2": 0.0})
    assert found["G_2"]["F_max"] == pytest.approx(light["F_max"] / full["F_max"] - 1.0, rel=1e-12)
    assert found[PRINTED]["t_1"] is None
    assert found[PRINTED]["F_max"] == pytest.approx(full["P_12_max_printed"] / full["F_max"] - 1.0, rel=1e-12)
    assert set(looked_at().spare) == {key for key, changes in found.items() if abs(changes["F_max"] or 0.0) <= 0.01}


def test_one_mass_is_enough_for_light_ropes_only() -> None:
    found = looked_at()

    assert found.here is not None
    assert found.here.worst > 0.01 > found.one_mass[1].worst
    assert 1e-2 < found.enough_to < found.ratio
    assert found.one_mass[0].at_drum == pytest.approx(0.1 * found.one_mass[1].at_drum, rel=0.1)


def test_what_has_no_ropes_of_masses_or_no_formulas_is_not_compared() -> None:
    pushed = LONG | {"V_0": 8.0}
    found = depth(pushed, 0.01, (1,), (1e-2,))

    assert depth(LONG | {"I_0": math.inf}, 0.01, (1,), (1e-2,)).here is None
    assert depth(LONG | {"G_2": 0.0}, 0.01, (1,), (1e-2,)).ropes == ()
    assert forces(pushed).motion is not None
    assert found.full["F_max"] == forces(pushed).found["F_max"]
    assert found.ropes == found.one_mass == ()
