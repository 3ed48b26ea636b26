"""Ropes of n masses against displacements and the continuous rope; what simpler models of a hoist change."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pytest

from kulman.plans.hoist.forces import forces
from kulman.plans.hoist.model import model
from kulman.plans.lab.ropes import PRINTED, SIMPLER, Heavy, HoistDepth, depth, rope_of, rope_row

# 3 t on a long rope: V09 of hoist-variants.json
LONG = {
    "G_1": 30e3, "G_2": 1180.0, "L": 60.0, "S": 230e-6, "E_k": 1.05e11, "sigma": 1450e6, "K": 6.0,
    "l_0": 5.0, "I_0": 8e-5, "E_0": 2.06e11, "beta_0": 0.5, "l_2": 4.0, "I_2": 7e-5, "E_2": 2.06e11, "beta_2": 0.5,
    "V_0": 0.5, "a": 0.3, "slack": 0.0, "g": 9.81,
}  # fmt: skip


@cache
def rope(n: int) -> Heavy:
    return rope_of(model(LONG), n)


def displaced(n: int) -> tuple[float, float, float]:
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
    t_1, at_load, at_drum = displaced(2)

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
        motion = rope_row(found, n, True).motion(np.zeros(n + 2), np.zeros(n + 2))
        errors.append(float(np.sort(motion.frequencies)[-n - 1]) / right - 1.0)

    assert abs(errors[1]) < 5e-5
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.02)


def test_lift_off_tends_to_its_limit_as_the_rope_is_cut_finer() -> None:
    steps = np.abs(np.diff([rope(n).t_1 for n in (1, 4, 16)]))  # the parts tremble: no clean order

    assert steps[0] > 4.0 * steps[1]


def test_light_rope_is_one_mass() -> None:
    values = LONG | {"G_2": 0.1}
    found = model(values)

    light = rope_of(found, 2)

    assert light.t_1 == pytest.approx(found["t_1"], rel=1e-5)
    assert light.P_12_max == pytest.approx(found["P_12_max"], rel=1e-5)
    assert light.F_12_max == pytest.approx(found["F_12_max"], rel=1e-5)


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


def test_rigid_support_and_weightless_rope_have_no_ropes_of_masses() -> None:
    assert depth(LONG | {"I_0": math.inf}, 0.01, (1,), (1e-2,)).here is None
    assert depth(LONG | {"G_2": 0.0}, 0.01, (1,), (1e-2,)).ropes == ()


def test_formulas_that_do_not_hold_are_not_compared() -> None:
    values = LONG | {"V_0": 8.0}

    found = depth(values, 0.01, (1,), (1e-2,))

    assert forces(values).motion is not None
    assert found.full["F_max"] == forces(values).found["F_max"]
    assert found.ropes == found.one_mass == ()
