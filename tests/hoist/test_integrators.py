"""Integrators of a hoist and ways to the root of (11): their orders, stability limits, events, refusals."""

from __future__ import annotations

import math
from functools import cache
from itertools import islice

import mpmath as mp
import numpy as np
import pytest

from kulman.plans.hoist import roots
from kulman.plans.lab.finders import (
    BISECTION,
    BRENT,
    FINDERS,
    ILLINOIS,
    NEWTON,
    SECANT,
    Equation,
    find,
    lift_off_equation,
)
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
    return float(np.nanmax(np.abs(found.F_12 - right().F_12(found.t)) / right().P_12_max))


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
    z = np.geomspace(1e-3, 10.0, 20)

    assert stability_limit(method) == pytest.approx(LIMITS[method], rel=1e-7)
    assert growth(EXPLICIT, z) == pytest.approx(np.sqrt(1.0 + z * z), rel=1e-12)  # its polynomial


@pytest.mark.parametrize(
    ("method", "square", "fourth"), [(VERLET, -1.0 / 24.0, 0.0), (TRAPEZOID, 1.0 / 12.0, 0.0), (RK4, 0.0, 1.0 / 120.0)]
)
def test_periods_are_longer_by_the_leading_term(method: str, square: float, fourth: float) -> None:
    z = 0.05
    uu, uv, vu, vv = (float(value) for value in one_step(method, z))

    swing = 0.5 * (uu + vv) / np.sqrt(uu * vv - uv * vu)

    assert z / np.arccos(swing) - 1.0 == pytest.approx(square * z**2 + fourth * z**4, rel=5e-3)


@pytest.mark.parametrize("method", [RK4, VERLET, SYMPLECTIC])
def test_steps_beyond_the_limit_are_refused_where_oscillations_grow(method: str) -> None:
    limit = stability_limit(method)

    found = run(method, 1.01 * limit)

    assert found.refused.all()
    for values in (found.t_1, found.F_max, found.P_12_max, found.F_12):
        assert np.isnan(values).all()
    assert not run(method, 0.99 * limit).refused.any()
    for z, grows in ((0.995 * limit, False), (1.005 * limit, True)):
        motion, state = Motion(1.0, lambda t: 0.0), (1.0, 0.0)
        largest = 0.0
        for _ in range(3000):
            state = STEPPERS[method](motion, 0.0, state, z)
            largest = max(largest, abs(state[0]))
        assert largest > 1e6 if grows else largest < 20.0


def test_no_run_that_is_returned_has_grown(monkeypatch: pytest.MonkeyPatch) -> None:
    found, coarse = run(EXPLICIT, 0.01), run(EXPLICIT, 0.1)

    assert found.refused.any()
    assert found.grown[found.refused].min() > GROWN
    assert np.all(found.grown[~found.refused] <= GROWN)
    assert coarse.refused.all()
    monkeypatch.setattr("kulman.plans.lab.integrators.GROWN", np.inf)
    wrong = integrate(SEVERAL, EXPLICIT, 0.1).F_max / right().P_12_max
    assert 1.1 < wrong.max() < 3.0  # would have passed for results


def test_many_hoists_go_as_one() -> None:
    together = run(VERLET, 0.1)

    for i in range(len(SEVERAL["m"])):
        alone = integrate({name: value[i] for name, value in SEVERAL.items()}, VERLET, 0.1)
        for name in ("t_1", "F_12_t1", "F_12_max", "P_12_max", "F_max", "grown"):
            assert getattr(alone, name).tolist() == [getattr(together, name)[i]]


SAFE = (BISECTION, ILLINOIS, BRENT)
OF_EQUATIONS = 7


def random_equations(count: int) -> list[tuple[Equation, float]]:
    """Equations of hoists that do not stand still when they lift off, with their roots."""
    random = np.random.default_rng(OF_EQUATIONS)
    V, a = 10.0 ** random.uniform(-2.5, 0.0, count), random.uniform(0.05, 1.0, count)
    k, height = 10.0 ** random.uniform(1.0, 2.2, count), 10.0 ** random.uniform(-2.5, -0.5, count)
    right = k * roots.lift_off(V, a, k, height)
    return [
        (lift_off_equation(*one), x)
        for *one, x in zip(V.tolist(), a.tolist(), k.tolist(), height.tolist(), right.tolist(), strict=True)
    ]


def near_triple(away: float) -> tuple[Equation, float]:
    """A hoist without acceleration that lifts off when k t is `away` from a whole turn."""
    V, k, x = 0.2, 50.0, 2.0 * math.pi + away
    return lift_off_equation(V, 0.0, k, V / k * (x - math.sin(x))), x


@pytest.mark.parametrize("count", [60, pytest.param(2000, marks=pytest.mark.soak)])
@pytest.mark.parametrize("finder", SAFE)
def test_brackets_lead_to_the_root_always(finder: str, count: int) -> None:
    for equation, right in random_equations(count):
        found = find(finder, equation, 1e-14)

        assert found.root == pytest.approx(right, rel=3e-13)
        assert found.evaluations < 60


@pytest.mark.parametrize("finder", FINDERS)
def test_finders_stop_within_their_tolerance_or_say_that_they_failed(finder: str) -> None:
    for equation, right_root in random_equations(60):
        found = find(finder, equation, 1e-8)

        assert math.isnan(found.root) or found.root == pytest.approx(right_root, rel=2e-7)


def test_newton_and_the_secant_fail_where_brackets_do_not() -> None:
    equation, right = near_triple(1e-4)

    failed = [finder for finder in FINDERS if math.isnan(find(finder, equation, 1e-14).root)]

    assert failed == [NEWTON, SECANT]
    for finder in SAFE:
        assert find(finder, equation, 1e-14).root == pytest.approx(right, abs=2e-6)


def test_newton_slows_down_to_thirds_at_a_triple_root() -> None:
    equation, right = near_triple(0.0)
    equation = Equation(equation.value, equation.slope, equation.low, right + 0.1)
    start = 2.0 * right - equation.high  # the other side: tangents come down to the root
    guesses = FINDERS[NEWTON](Equation(equation.value, equation.slope, start, start))

    errors = np.abs(np.array([guess for guess, _ in islice(guesses, 17)][1::2]) - right)

    assert errors[1:6] / errors[:5] == pytest.approx(np.full(5, 2.0 / 3.0), abs=0.01)


def cubic() -> Equation:
    return Equation(lambda x: x * x * x + x - 3, lambda x: 3 * x * x + 1, mp.mpf(1), mp.mpf(2))


@pytest.mark.parametrize(
    ("finder", "evaluations", "order"),
    [(NEWTON, 2, 2.0), (SECANT, 1, 0.5 * (1.0 + math.sqrt(5.0))), (ILLINOIS, 3, 3.0)],
)
def test_orders_are_those_of_theory(finder: str, evaluations: int, order: float) -> None:
    with mp.workdps(2000):
        root = mp.findroot(cubic().value, (1.2, 1.3), tol=mp.mpf(10) ** -3900)
        guesses = [x for x, _ in islice(FINDERS[finder](cubic()), 18)]

        # of Illinois three steps together are of the order three
        digits = [float(-mp.log10(abs(x - root))) for x in guesses[evaluations - 1 :: evaluations] if x != root]

    digits = [d for d in digits if d < 1500.0]
    assert digits[-1] / digits[-2] == pytest.approx(order, rel=0.08)


def test_bisection_halves_its_doubt() -> None:
    guesses = list(islice(FINDERS[BISECTION](cubic()), 40))

    assert [away for _, away in guesses] == [0.5 ** (i + 2) for i in range(40)]
    assert all(abs(x - 1.2134116627622296) <= away + 1e-15 for x, away in guesses)


def test_closed_forms_need_few_evaluations() -> None:
    spent = {
        finder: np.median([find(finder, equation, 1e-12).evaluations for equation, _ in random_equations(60)])
        for finder in FINDERS
    }

    assert spent[BRENT] <= spent[ILLINOIS] <= 12
    assert spent[BISECTION] > 3 * spent[ILLINOIS]
