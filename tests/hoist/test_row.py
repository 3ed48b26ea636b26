"""Equations (1) to (3) of a row of masses against displacements, closed forms and (8)."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from kulman.plans.lab.ropes import Row
from kulman.tests.support.hoist_rows import hoist_row

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


def displaced(row: Row, begin: Array, t: float) -> Array:
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
        right = displaced(row, begin, t)
        assert motion.forces(t) == pytest.approx(right, abs=1e-12 * np.abs(right).max() * (1.0 + t))


def matrix_of(row: Row) -> np.ndarray:
    """Coefficients of the forces in (3), rad^2/s^2: three diagonals; the ends do not yield."""
    yielding, c = np.concatenate(([0.0], 1.0 / row.masses, [0.0])), row.stiffnesses
    beside = yielding[1:-1]
    return np.diag(c * (yielding[:-1] + yielding[1:])) - np.diag(c[1:] * beside, -1) - np.diag(c[:-1] * beside, 1)


@pytest.mark.parametrize("masses", [1, 2, 5])
def test_equation_3_holds_at_any_time(masses: int) -> None:
    row, begin, times = random_row(np.random.default_rng(SEED), masses)
    motion = row.motion(*(row.stiffnesses * (q[:-1] - q[1:]) for q in begin))

    h = 1e-4
    for t in times:
        second = (motion.rates_of_forces(t + h) - motion.rates_of_forces(t - h)) * (0.5 / h)
        left = second + matrix_of(row) @ motion.forces(t)
        assert left == pytest.approx(row.drive, abs=1e-5 * np.abs(second).max())


def test_rates_at_the_start_are_the_given_ones() -> None:
    row, begin, _ = random_row(np.random.default_rng(SEED), 4)
    start, rates = (row.stiffnesses * (q[:-1] - q[1:]) for q in begin)

    motion = row.motion(start, rates)

    assert motion.forces(0.0) == pytest.approx(start, rel=1e-12)
    assert motion.rates_of_forces(0.0) == pytest.approx(rates, rel=1e-12)


def test_free_row_of_two_masses_swings_with_k_of_the_article() -> None:
    a, c = np.array([2.0, 5.0]), np.array([0.0, 70.0, 0.0])
    row = Row(a, c, np.array([3.0, -4.0]), np.zeros(2))
    k = np.sqrt(70.0 * (2.0 + 5.0) / (2.0 * 5.0))
    mean = 70.0 * (5.0 * 3.0 + 2.0 * 4.0) / (2.0 * 5.0) / k**2

    motion = row.motion([0.0, 11.0, 0.0], [0.0, 13.0, 0.0])

    t = 0.37
    right = mean + (11.0 - mean) * np.cos(k * t) + 13.0 / k * np.sin(k * t)
    assert motion.forces(t) == pytest.approx([0.0, right, 0.0], rel=1e-13)


HOISTS = {
    "m": np.array([5100.0, 2045.0, 3098.0]),
    "C_01": np.array([3.7e7, 1.1e6, 1.6e7]),
    "C_12": np.array([1.6e6, 1.9e6, 4.0e5]),
    "V_t": np.array([0.1, 0.0, 0.5]),
    "a": np.array([0.15, 0.4, 0.0]),
    "g": np.full(3, 9.81),
}


def test_hoist_is_the_row_of_one_mass() -> None:
    m, C_01, C_12, V_0, a, g = (HOISTS[name] for name in ("m", "C_01", "C_12", "V_t", "a", "g"))
    C, k = C_01 * C_12 / (C_01 + C_12), np.sqrt((C_01 + C_12) / m)

    motion = hoist_row(HOISTS)

    for t in np.linspace(0.0, 0.6, 25):
        osc = a / k**2 * (1.0 - np.cos(k * t)) + V_0 / k * np.sin(k * t)
        y = V_0 * t + 0.5 * a * t * t
        F_01, F_12 = C * (y - osc) - m * g, C * (C_12 / C_01 * osc + y)
        size = np.maximum(m * g, np.abs(F_12))
        assert np.all(np.abs(-motion.forces(t) - np.stack((F_01, F_12), -1)) <= 1e-12 * size[:, None])


def test_force_of_the_support_obeys_the_fourth_order_equation() -> None:
    m, C_01, C_12 = (HOISTS[name] for name in ("m", "C_01", "C_12"))
    k2 = (C_01 + C_12) / m
    motion = hoist_row(HOISTS)

    h = 1e-3 / np.sqrt(k2)
    t = 0.2
    rates = [-motion.rates_of_forces(t + s * h)[..., 0] for s in (-2.0, -1.0, 1.0, 2.0)]
    bend = (rates[2] - rates[1]) / (2.0 * h)
    fourth = (rates[3] - 2.0 * rates[2] + 2.0 * rates[1] - rates[0]) / (2.0 * h**3)

    driven = C_01 * C_12 / m * HOISTS["a"]
    assert fourth + k2 * bend == pytest.approx(driven, abs=1e-5 * float(np.abs(k2 * bend).max()))


def test_many_rows_are_solved_as_one() -> None:
    together = hoist_row(HOISTS).forces(0.123)

    for i in range(3):
        alone = hoist_row({name: value[i] for name, value in HOISTS.items()}).forces(0.123)
        assert alone.tolist() == together[i].tolist()


def test_slow_modes_keep_their_digits_beside_stiff_links() -> None:
    values = {name: value[:1] for name, value in HOISTS.items()} | {"C_01": np.array([1e19])}
    m, C_12 = values["m"], values["C_12"]

    motion = hoist_row(values)

    t = 0.5
    y = 0.1 * t + 0.5 * 0.15 * t * t
    assert -motion.forces(t)[0, 1] == pytest.approx(float(C_12[0] * y), rel=1e-9)
    trembling = float(C_12[0] * 0.1 / np.sqrt(1e19 / m[0]))  # what the load swings with on the hard support
    assert -motion.forces(t)[0, 0] == pytest.approx(float(C_12[0] * y - m[0] * 9.81), abs=1.01 * trembling)
