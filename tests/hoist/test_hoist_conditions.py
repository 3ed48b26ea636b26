"""The condition of a hoist's quantities: no quantity loses more than K says."""

from __future__ import annotations

import numpy as np
import pytest

from kulman import load_task, solve
from kulman.plans.hoist.hoist import VALUES
from kulman.plans.hoist.solve import SolvedHoist, conditions_of, solve_hoist

TASK, ERR = "karpenko-hoist", 1e-7
VARIANTS = [pytest.param(v, marks=[] if v in ("V01", "V09") else pytest.mark.soak) for v in load_task(TASK).variants]


@pytest.mark.parametrize("variant", VARIANTS)
def test_no_quantity_of_a_hoist_loses_more_than_its_condition_says(variant: str) -> None:
    random, right = np.random.default_rng(7), SolvedHoist.of(solve(TASK, variant).solved)
    known = conditions_of(right)
    for _ in range(5):
        err = {name: -ERR if name in ("beta_0", "beta_2") else ERR * random.choice((-1.0, 1.0)) for name in VALUES}

        there = solve_hoist(right.hoist, {n: right.givens[n] * (1.0 + err[n]) for n in VALUES}, right.plans).quantities

        for name, item in right.quantities.items():
            value, moved, K = item.value, there[name].value, known[name].value
            if value is None or moved is None or K is None:
                assert not value, name
                continue
            assert abs(moved - value) <= ERR * (K * 1.01 + 1e-3) * abs(value), name


def test_what_is_proportional_to_data_has_the_sum_of_their_powers() -> None:
    known = solve(TASK, "V01", condition=True).conditions

    assert known["P_st"].value == pytest.approx(1.0, abs=1e-6)  # G_1 + G_2 / 3
    assert known["C_k"].value == pytest.approx(3.0, abs=1e-4)  # E_k S / L
    assert known["sigma_max"].value == pytest.approx((known["F_max"].value or 0.0) + 1.0, abs=1e-4)
