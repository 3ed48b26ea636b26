"""Integrators of a hoist: their orders and stability limits, events within steps, refusals."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from kulman.plans.lab.integrators import (
    EXPLICIT,
    GROWN,
    RK4,
    STEPPERS,
    SYMPLECTIC,
    TRAPEZOID,
    VERLET,
    Motion,
    Run,
    growth,
    integrate,
    one_step,
    stability_limit,
)
from kulman.tests.support.hoist_rows import SEVERAL, Exact, exact

COARSE, FINE = 0.1, 0.05  # rad
LIMITS = {RK4: 2.0 * np.sqrt(2.0), VERLET: 2.0, SYMPLECTIC: 2.0, TRAPEZOID: np.inf, EXPLICIT: 0.0}


@cache
def right() -> Exact:
    return exact(SEVERAL)


@cache
def run(method: str, step: float, located: bool = True) -> Run:
    return integrate(SEVERAL, method, step, located)


def course_error(found: Run) -> float:
    errors = np.abs(found.F_12 - right().F_12(found.t)) / right().P_12_max
    return float(np.nanmax(errors))


@pytest.mark.parametrize(("method", "order"), [(RK4, 4.0), (VERLET, 2.0), (TRAPEZOID, 2.0), (SYMPLECTIC, 2.0)])
def test_forces_have_the_order_of_their_method(method: str, order: float) -> None:
    # symplectic Euler too: it begins without acceleration, so its places are those of Verlet's method
    measured = np.log2(course_error(run(method, COARSE)) / course_error(run(method, FINE)))

    assert measured == pytest.approx(order, abs=0.1)


def test_explicit_euler_is_of_first_order_where_it_is_not_refused() -> None:
    hoist = {name: value[-1:] for name, value in SEVERAL.items()}
    coarse, fine = (integrate(hoist, EXPLICIT, step) for step in (8e-3, 4e-3))

    assert not any((*coarse.refused, *fine.refused))
    ratio = (coarse.P_12_max[0] / right().P_12_max[-1] - 1.0) / (fine.P_12_max[0] / right().P_12_max[-1] - 1.0)
    assert np.log2(ratio) == pytest.approx(1.0, abs=0.1)


def test_lift_off_and_maxima_keep_the_order_within_steps() -> None:
    errors = [
        [np.abs(found.t_1 / right().t_1 - 1.0).max(), np.abs(found.F_max / right().P_12_max - 1.0).max()]
        for found in (run(RK4, 4.0 * FINE), run(RK4, FINE))
    ]

    assert np.log2(np.divide(*errors)) / 2.0 == pytest.approx([4.0, 4.0], abs=0.3)


def test_order_is_lost_where_the_lift_off_is_missed() -> None:
    steps = 0.32 * 0.5 ** np.arange(4)

    errors = [course_error(run(RK4, float(step), False)) for step in steps]

    slope = np.polyfit(np.log(steps), np.log(errors), 1)[0]
    assert 1.5 < slope < 2.8
    assert errors[-1] > 20.0 * course_error(run(RK4, float(steps[-1])))


def test_maxima_on_the_support_are_found() -> None:
    found = run(RK4, FINE)

    assert found.F_12_max == pytest.approx(right().F_12_max, rel=1e-7)
    assert np.any(found.F_12_max > found.F_12_t1)


@pytest.mark.parametrize("method", LIMITS)
def test_stability_limits_are_those_of_theory(method: str) -> None:
    assert stability_limit(method) == pytest.approx(LIMITS[method], rel=1e-7)


@pytest.mark.parametrize("method", [RK4, VERLET, SYMPLECTIC])
def test_oscillations_grow_just_beyond_the_limit_only(method: str) -> None:
    limit = stability_limit(method)

    def amplitude(z: float) -> float:
        motion, state = Motion(1.0, lambda t: 0.0), (1.0, 0.0)
        largest = 0.0
        for _ in range(3000):
            state = STEPPERS[method](motion, 0.0, state, z)
            largest = max(largest, abs(state[0]))
        return largest

    assert amplitude(0.995 * limit) < 20.0
    assert amplitude(1.005 * limit) > 1e6


def test_growth_of_explicit_euler_is_that_of_its_polynomial() -> None:
    z = np.geomspace(1e-3, 10.0, 20)

    assert growth(EXPLICIT, z) == pytest.approx(np.sqrt(1.0 + z * z), rel=1e-12)


def slowing(method: str, z: float) -> float:
    """Return the part by which a method's period is longer than the exact one at w h = z."""
    uu, uv, vu, vv = (float(value) for value in one_step(method, z))
    swing = 0.5 * (uu + vv) / np.sqrt(uu * vv - uv * vu)
    return float(z / np.arccos(swing) - 1.0)


@pytest.mark.parametrize(
    ("method", "square", "fourth"), [(VERLET, -1.0 / 24.0, 0.0), (TRAPEZOID, 1.0 / 12.0, 0.0), (RK4, 0.0, 1.0 / 120.0)]
)
def test_periods_are_longer_by_the_leading_term(method: str, square: float, fourth: float) -> None:
    z = 0.05

    assert slowing(method, z) == pytest.approx(square * z**2 + fourth * z**4, rel=5e-3)


@pytest.mark.parametrize("method", [RK4, VERLET, SYMPLECTIC])
def test_steps_beyond_the_limit_are_refused(method: str) -> None:
    limit = stability_limit(method)

    found = run(method, 1.01 * limit)

    assert found.refused.all()
    for values in (found.t_1, found.F_max, found.P_12_max, found.F_12):
        assert np.isnan(values).all()
    assert not run(method, 0.99 * limit).refused.any()


def test_no_run_that_is_returned_has_grown() -> None:
    found = run(EXPLICIT, 0.01)

    assert found.refused.any()
    assert found.grown[found.refused].min() > GROWN
    assert np.all(found.grown[~found.refused] <= GROWN)


def test_what_is_refused_would_have_passed_for_results(monkeypatch: pytest.MonkeyPatch) -> None:
    refused = run(EXPLICIT, 0.1)
    monkeypatch.setattr("kulman.plans.lab.integrators.GROWN", np.inf)

    wrong = integrate(SEVERAL, EXPLICIT, 0.1).F_max / right().P_12_max

    assert refused.refused.all()
    assert 1.1 < wrong.max() < 3.0


def test_many_hoists_go_as_one() -> None:
    together = run(VERLET, 0.1)

    for i in range(len(SEVERAL["m"])):
        alone = integrate({name: value[i] for name, value in SEVERAL.items()}, VERLET, 0.1)
        for name in ("t_1", "F_12_t1", "F_12_max", "P_12_max", "F_max", "grown"):
            assert getattr(alone, name).tolist() == [getattr(together, name)[i]]
