"""Ways to the root of (11): their orders with 2,000 digits, what keeps a bracket, what fails near triple roots."""

from __future__ import annotations

import math
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

SAFE = (BISECTION, ILLINOIS, BRENT)
SEED = 7


def random_equations(count: int) -> list[tuple[Equation, float]]:
    """Equations of hoists that do not stand still when they lift off, with their roots."""
    random = np.random.default_rng(SEED)
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
    for equation, right in random_equations(60):
        found = find(finder, equation, 1e-8)

        assert math.isnan(found.root) or found.root == pytest.approx(right, rel=2e-7)


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
    root = 1.2134116627622296

    assert [away for _, away in guesses] == [0.5 ** (i + 2) for i in range(40)]
    assert all(abs(x - root) <= away + 1e-15 for x, away in guesses)


def test_closed_forms_need_few_evaluations() -> None:
    spent = {
        finder: np.median([find(finder, equation, 1e-12).evaluations for equation, _ in random_equations(60)])
        for finder in FINDERS
    }

    assert spent[BRENT] <= spent[ILLINOIS] <= 12
    assert spent[BISECTION] > 3 * spent[ILLINOIS]
