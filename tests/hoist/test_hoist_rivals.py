"""Closed forms, integrators and finders of a hoist beside one another: orders, stability limits, events, refusals."""

from __future__ import annotations

import math
import time
from functools import cache
from itertools import islice

import mpmath as mp
import numpy as np
import pytest

from kulman import solve
from kulman.plans.hands.shaky import preset
from kulman.plans.hoist import roots
from kulman.plans.hoist.forces import BEAM, BOTH, COLUMN_UNITS, NEITHER, ROPE, course, forces
from kulman.plans.hoist.hoist import Hoist
from kulman.plans.hoist.solve import solve_hoist
from kulman.plans.lab import hoists as races
from kulman.plans.lab import race as contests
from kulman.plans.lab.hoists import (
    BISECTION,
    BRENT,
    COURSE,
    FINDERS,
    FORMULAS,
    ILLINOIS,
    LIFT_OFF,
    NEWTON,
    PEAK,
    SECANT,
    _Equation,
    _find,
    _lift_off_equation,
    by_board,
    by_hand,
    rivals,
    root_race,
    step_limits,
)
from kulman.plans.lab.hoists import exact as digits
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
    _one_step,
    growth,
    integrate,
    stability_limit,
)
from kulman.plans.lab.race import Contest, Effort
from kulman.tests.support.hoists import SEVERAL, VARIANTS, Exact, exact

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
    uu, uv, vu, vv = (float(value) for value in _one_step(method, z))

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


def test_errors_of_guesses_come_down_to_that_of_the_root_where_a_method_stops() -> None:
    hoist = solve("karpenko-hoist", "V03").solved.givens

    for ways in root_race(hoist).values():
        for method, errors in ways.errors.items():
            if math.isfinite(ways.found[method].root):
                assert np.nanmin(errors) <= max(ways.error(method), 1e-15), method


def test_hoists_of_a_slower_clock_do_the_same_more_slowly() -> None:
    slow = {"C_01": 1e-2, "C_12": 1e-2, "V_t": 0.1, "a": 1e-2, "g": 1e-2}  # to what a tenfold time brings them
    usual, slowly = (
        integrate(values, VERLET, 0.1)
        for values in (SEVERAL, {name: slow.get(name, 1.0) * value for name, value in SEVERAL.items()})
    )

    assert slowly.t_1 == pytest.approx(10.0 * usual.t_1, rel=1e-9)
    assert slowly.F_max == pytest.approx(1e-2 * usual.F_max, rel=1e-9)


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


def random_equations(count: int) -> list[tuple[_Equation, float]]:
    """Equations of hoists that do not stand still when they lift off, with their roots."""
    random = np.random.default_rng(OF_EQUATIONS)
    V, a = 10.0 ** random.uniform(-2.5, 0.0, count), random.uniform(0.05, 1.0, count)
    k, height = 10.0 ** random.uniform(1.0, 2.2, count), 10.0 ** random.uniform(-2.5, -0.5, count)
    right = k * roots.lift_off(V, a, k, height)
    return [
        (_lift_off_equation(*one), x)
        for *one, x in zip(V.tolist(), a.tolist(), k.tolist(), height.tolist(), right.tolist(), strict=True)
    ]


def near_triple(away: float) -> tuple[_Equation, float]:
    """A hoist without acceleration that lifts off when k t is `away` from a whole turn."""
    V, k, x = 0.2, 50.0, 2.0 * math.pi + away
    return _lift_off_equation(V, 0.0, k, V / k * (x - math.sin(x))), x


@pytest.mark.parametrize("count", [60, pytest.param(2000, marks=pytest.mark.soak)])
@pytest.mark.parametrize("finder", SAFE)
def test_brackets_lead_to_the_root_always(finder: str, count: int) -> None:
    for equation, right in random_equations(count):
        found = _find(finder, equation, 1e-14)

        assert found.root == pytest.approx(right, rel=3e-13)
        assert found.evaluations < 60


@pytest.mark.parametrize("finder", FINDERS)
def test_finders_stop_within_their_tolerance_or_say_that_they_failed(finder: str) -> None:
    for equation, right_root in random_equations(60):
        found = _find(finder, equation, 1e-8)

        assert math.isnan(found.root) or found.root == pytest.approx(right_root, rel=2e-7)


def test_newton_and_the_secant_fail_where_brackets_do_not() -> None:
    equation, right = near_triple(1e-4)

    failed = [finder for finder in FINDERS if math.isnan(_find(finder, equation, 1e-14).root)]

    assert failed == [NEWTON, SECANT]
    for finder in SAFE:
        assert _find(finder, equation, 1e-14).root == pytest.approx(right, abs=2e-6)


def test_newton_slows_down_to_thirds_at_a_triple_root() -> None:
    equation, right = near_triple(0.0)
    equation = _Equation(equation.value, equation.slope, equation.low, right + 0.1)
    start = 2.0 * right - equation.high  # the other side: tangents come down to the root
    guesses = FINDERS[NEWTON](_Equation(equation.value, equation.slope, start, start))

    errors = np.abs(np.array([guess for guess, _ in islice(guesses, 17)][1::2]) - right)

    assert errors[1:6] / errors[:5] == pytest.approx(np.full(5, 2.0 / 3.0), abs=0.01)


def cubic() -> _Equation:
    return _Equation(lambda x: x * x * x + x - 3, lambda x: 3 * x * x + 1, mp.mpf(1), mp.mpf(2))


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
        finder: np.median([_find(finder, equation, 1e-12).evaluations for equation, _ in random_equations(60)])
        for finder in FINDERS
    }

    assert spent[BRENT] <= spent[ILLINOIS] <= 12
    assert spent[BISECTION] > 3 * spent[ILLINOIS]


STEADY = VARIANTS["V10"]  # 2.5 t on a soft support, no acceleration
PUSHING = STEADY | {"I_0": 1e-6, "V_0": 0.5}  # the rope would have to push on so soft a support


@cache
def race() -> Contest:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(contests, "ROUNDS", 1)
        patch.setattr(races, "STEPS", (0.4, 0.2, 0.1))
        patch.setattr(races, "TINY", (0.0125,))
        return rivals(STEADY, time.process_time, Effort((1, 10), 10))


def errors(method: str, kind: str) -> dict[float | str, float | None]:
    return {entry.setting: entry.error for entry in race().of(kind) if entry.method == method}


def test_exact_values_have_more_digits_than_float64() -> None:
    found = digits(STEADY)
    with mp.workdps(40):
        m, C_01, C_12 = (mp.mpf(float(found[name])) for name in ("m", "C_01", "C_12"))
        k, V, g = mp.sqrt((C_01 + C_12) / m), mp.mpf(0.22), mp.mpf(9.81)
        height = m * g * (1 / C_01 + 1 / C_12)
        t_1 = mp.findroot(lambda t: V * t - V / k * mp.sin(k * t) - height, (0.15, 0.152))
        force = C_12 * (V * t_1 - height) + m * g  # the load is where its beam is straight
        rate = V * mp.cos(k * t_1) * C_12**2 / (C_01 + C_12) + C_01 * C_12 / (C_01 + C_12) * V
        peak = m * g + mp.sqrt((force - m * g) ** 2 + rate**2 * m / C_12)

    # rounding of the reduced values, with which both begin, is a few units of float64
    assert float(found["t_1"]) == pytest.approx(float(t_1), rel=5e-15)
    assert float(found["F_max"]) == pytest.approx(float(peak), rel=5e-15)


def test_closed_forms_err_by_rounding() -> None:
    for kind in (LIFT_OFF, COURSE, PEAK):
        found = errors(FORMULAS, kind)
        assert list(found) == [1, 10]
        assert max(found.values()) < 2e-15  # type: ignore[type-var, operator]


@pytest.mark.parametrize("finder", FINDERS)
def test_ways_to_the_root_keep_their_tolerance_or_give_nothing(finder: str) -> None:
    for tolerance, error in errors(finder, LIFT_OFF).items():
        assert error is None if finder == NEWTON else error is not None and error <= 2.0 * float(tolerance)


def test_greatest_force_does_not_feel_a_lift_off_that_is_a_little_wrong() -> None:
    found = digits(STEADY)

    wrong = [float(races.follow(STEADY, float(found["t_1"]) * (1.0 + part))["F_max"]) for part in (1e-3, 1e-4)]

    coarse, fine = (abs(force / float(found["F_max"]) - 1.0) for force in wrong)
    assert coarse < 1e-5
    assert coarse / fine == pytest.approx(100.0, rel=0.1)


def test_runs_that_are_refused_give_nothing_and_are_in_no_front() -> None:
    assert set(errors(EXPLICIT, PEAK).values()) == {errors(EXPLICIT, PEAK)[0.0125], None}
    assert errors(EXPLICIT, PEAK)[0.0125] is not None
    refused = [entry for entry in race().entries if entry.failed]

    assert {entry.error for entry in refused} == {None}
    for kind in (LIFT_OFF, COURSE, PEAK):
        assert not set(map(id, refused)) & set(map(id, race().front(kind)))
        assert all(entry.error < 1e-15 for entry in race().front(kind)[:1])  # type: ignore[operator]


def test_steps_show_their_orders_and_are_refused_beyond_their_limits() -> None:
    found = step_limits(STEADY, (4.0, 2.4, 1.0, 0.32, 0.16, 0.08), (0.0125, 0.00625))

    orders = {RK4: 4.0, VERLET: 2.0, TRAPEZOID: 2.0, SYMPLECTIC: 2.0, EXPLICIT: 1.0}
    assert {method: found[method].order for method in orders} == pytest.approx(orders, abs=0.1)
    refused = {RK4: 4.0, VERLET: 2.4, SYMPLECTIC: 2.4, TRAPEZOID: None, EXPLICIT: 0.08}
    assert {method: found[method].refused_from for method in STEPPERS} == refused
    assert np.nanmax(found[RK4].errors) < 0.5


def test_runs_of_too_many_steps_give_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(contests, "ROUNDS", 1)
    monkeypatch.setattr(races, "STEPS", (0.4, 0.1))
    monkeypatch.setattr(races, "TINY", (0.05, 0.0125))
    monkeypatch.setattr(races, "MOST_STEPS", 100)
    found = rivals(STEADY, time.process_time, Effort((1,), 10))  # 15 rad of the swing

    taken = {(entry.method, entry.setting) for entry in found.of(PEAK) if entry.error is not None}
    assert {(RK4, 0.4), (VERLET, 0.4)} <= taken
    assert not {(method, step) for method, step in taken if step in (0.1, 0.0125)}


@pytest.mark.parametrize("values", [STEADY, STEADY | {"a": 0.3, "slack": 0.01}, PUSHING], ids=["a=0", "a>0", "slack"])
def test_forces_over_time_move_the_load_and_are_greatest_at_their_marks(values: dict[str, float]) -> None:
    found = forces(values)
    t = np.linspace(0.0, found.end, 4001)

    moved, marks = course(found, t), found.marks
    at_marks = dict(zip(marks, course(found, np.array([*marks.values()])).columns["F_12"], strict=True))

    column = moved.columns
    m, step = found.found["m"], t[1] - t[0]
    pulled = (column["F_12"] - column["F_01"] - m * 9.81)[1:-1]
    bent = m * np.diff(column["s"], 2) / step**2
    events = np.flatnonzero(np.array(moved.states[1:]) != np.array(moved.states[:-1]))
    smooth = np.ones(len(bent), bool)
    smooth[np.clip(np.concatenate((events - 1, events)), 0, len(bent) - 1)] = False
    assert bent[smooth] == pytest.approx(pulled[smooth], abs=1e-4 * column["F_12"].max())
    assert list(column) == list(COLUMN_UNITS)
    for name in ("F_12_max", "P_12_max", "P_12_min"):
        assert at_marks[name] == pytest.approx(found.found[name], rel=1e-9, abs=1e-6)
        assert 0.0 <= marks[name] <= found.end * (1.0 + 1e-12)
    assert list(marks.values()) == sorted(marks.values())


def test_states_say_what_bears() -> None:
    found = forces(PUSHING)

    moved = course(found, np.linspace(0.0, found.end, 2001))

    states, rope, beam = np.array(moved.states), moved.columns["F_12"], moved.columns["F_01"]
    assert {BOTH, ROPE, BEAM} <= set(moved.states) <= {BOTH, ROPE, BEAM, NEITHER}
    assert np.all(rope[(states == BEAM) | (states == NEITHER)] == 0.0)
    assert np.all(beam[(states == ROPE) | (states == NEITHER)] == 0.0)
    assert np.all(rope >= 0.0)
    assert np.all(beam <= 1e-9 * 25e3)


def test_beams_bend_as_they_are_loaded_and_a_rigid_one_does_not() -> None:
    found, rigid = forces(STEADY), forces(STEADY | {"I_0": math.inf})

    moved = course(found, np.array([0.0, found.found["t_1"] + found.found["T_1"]])).columns
    stiff = course(rigid, np.linspace(0.0, 0.2, 21)).columns

    assert moved["w_0"].tolist() == [pytest.approx(found.found["P_st"] / found.found["C_01"], rel=1e-14), 0.0]
    assert moved["w_2"][1] == pytest.approx(found.found["P_12_max"] / found.found["C_2"], rel=1e-12)
    assert moved["F_12"][1] == pytest.approx(found.found["P_12_max"], rel=1e-12)
    assert np.all(stiff["w_0"] == 0.0)
    assert np.all(np.isfinite(stiff["F_01"]))
    assert stiff["F_01"][0] == pytest.approx(-rigid.found["P_st"], rel=1e-15)


def test_drawings_err_as_the_square_of_a_section_and_hands_as_they_are_careful() -> None:
    drawn = solve_hoist(Hoist(), STEADY)
    mus = dict.fromkeys(drawn.scale_of_plan, 400.0)

    sections = {entry.setting: entry.error for entry in by_board(drawn, time.process_time)}
    kept = {
        name: {entry.kind: entry.error for entry in by_hand(drawn, mus, preset(name).hand)}
        for name in ("careful", "normal")
    }

    assert np.log2(sections[40] / sections[160]) / 2.0 == pytest.approx(2.0, abs=0.1)  # type: ignore[operator]
    assert set(kept["normal"]) == {LIFT_OFF, PEAK, COURSE}
    for kind, error in kept["normal"].items():
        assert 0.0 < kept["careful"][kind] < error < 0.1  # type: ignore[operator]
