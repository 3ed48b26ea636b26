"""The condition of a cam's quantities: by hand where they are products of powers, else by solving again."""

from __future__ import annotations

import math
from functools import cache
from itertools import cycle

import pytest

from kulman import solve
from kulman.plans.cams.solve import BESIDE
from kulman.tests.support.cam_students import ROCKER
from kulman.variants.solution import Solution

# of h, phi_rise, u, omega, mu_phi, H_a, H_v, l_A1 the sums of the powers: v_max = 2 h omega / phi_rise
POWERS = {
    "s_max": 1.0,
    # the greatest of rise and fall, which are alike: half of an error of either
    "ds_max": 2.0,
    "v_max": 3.0,
    "A_1": 4.0,  # 4 h / (u phi_rise^2)
    "a_max": 6.0,
    "l_A2": 1.0 + 1.5,  # u / (1 - u) of u = 1/3
    "mu_s": 9.0,
    "mu_ds": 7.0,
    "mu_d2s": 5.0,
    "gamma_rise_min": 1.0,
    "R_roller": 1.0,
    "s_close": 0.0,
}
STEP = 1e-4
NUMBERS = ("h", "phi_rise", "phi_fall", "phi_upper", "omega", "l_A1", "H_a", "H_v", "gamma_rise", "gamma_fall")


@cache
def madi() -> Solution:
    return solve("madi-cam", condition=True)


def test_products_of_powers_have_the_sum_of_their_powers() -> None:
    found = madi().conditions

    assert {name: found[name].value for name in POWERS} == pytest.approx(POWERS, abs=1e-4)


def test_phases_that_fill_the_turn_have_a_condition() -> None:
    full = {"phi_rise": "150 deg", "phi_upper": "0 deg", "phi_fall": "210 deg"}

    found = solve("madi-cam", set=full, only="diagrams", condition=True).conditions

    assert {name: found[name].value for name in ("v_max", "a_max")} == pytest.approx(
        {"v_max": 3.0, "a_max": 6.0}, abs=1e-3
    )


@pytest.mark.parametrize(
    ("numbers", "names"),
    [
        pytest.param(("h", "phi_rise", "phi_fall", "u", "gamma_rise", "gamma_fall"), ("r_0", "s_0"), id="roller"),
        pytest.param(("h", "phi_rise", "phi_fall", "u", "rho_flat"), ("r_0_flat",), id="plate", marks=pytest.mark.soak),
    ],
)
def test_sizes_hang_on_the_data_as_they_do_when_solved_again(numbers: tuple[str, ...], names: tuple[str, ...]) -> None:
    right = madi()

    totals = dict.fromkeys(names, 0.0)
    for name in numbers:
        unit, given = right.task.givens[name].unit, right.solved.givens[name]
        assert unit is not None
        there = [solve("madi-cam", set={name: unit.from_si(given * (1.0 + step))}) for step in (STEP, -STEP)]
        for quantity in names:
            more, less = (float(one[quantity].value or 0.0) for one in there)
            totals[quantity] += abs(more - less) * (0.5 / STEP) / abs(float(right[quantity].value or 0.0))

    for quantity in names:
        assert right.conditions[quantity].value == pytest.approx(totals[quantity], rel=2e-3)


@pytest.mark.soak
def test_conditions_of_a_rocker_are_those_of_its_triangle() -> None:
    found = solve(ROCKER, condition=True).conditions

    assert found["l_rocker"].value == pytest.approx(1.0, abs=1e-4)
    assert all(0.0 < (found[name].value or 0.0) < 20.0 for name in ("r_0", "l_OC", "psi_0", "rho_min"))


def test_sines_are_those_of_the_flattest_rays_of_the_chords() -> None:
    solution = madi()
    steepest = math.hypot(110.0 * 11.0 / 12.0 - 110.0 / 12.0 / 2.0 + 110.0 / 24.0, 30.0)

    sine = solution.conditions["S_max_chord"].sine

    assert sine == min(solution.solved.sines.values())
    assert sine == pytest.approx(30.0 / steepest, rel=0.1)
    assert solution.conditions["mu_s"].sine == 1.0


def test_conditions_of_a_law_with_jumps_of_the_velocity() -> None:
    found = solve("madi-cam", set={"law": "uniform"}, condition=True).conditions

    assert found["v_max"].value == pytest.approx(3.0, abs=1e-4)
    assert found["rho_min"].value == 0.0  # a corner, whatever the data


def test_no_size_of_a_cam_loses_more_than_its_condition_says() -> None:
    right, err, signs = madi(), 1e-6, cycle((1.0, -1.0, -1.0))
    units = {name: right.task.givens[name].unit for name in NUMBERS}
    erring = {
        name: unit.from_si(right.solved.givens[name] * (1.0 + err * next(signs)))
        for name, unit in units.items()
        if unit is not None
    }
    there = solve("madi-cam", set=erring)

    for name, condition in right.conditions.items():
        value, size = float(right.solved.values[name]), float(right.solved.values[BESIDE.get(name, name)])
        moved = float(there.solved.values[name])
        assert condition.value is not None, name
        assert abs(moved - value) <= err * (condition.value * 1.01 + 1e-3) * abs(size), name
