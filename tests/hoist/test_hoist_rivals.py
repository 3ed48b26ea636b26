"""Closed forms and integrators of a hoist beside one another; a hoist over time."""

from __future__ import annotations

import math
import time
from functools import cache

import mpmath as mp
import numpy as np
import pytest

from kulman.plans.hands.shaky import preset
from kulman.plans.hoist.forces import BEAM, BOTH, COLUMN_UNITS, NEITHER, ROPE, course, forces
from kulman.plans.hoist.hoist import Hoist
from kulman.plans.hoist.solve import solve_hoist
from kulman.plans.lab import hoists as races
from kulman.plans.lab import race as contests
from kulman.plans.lab.finders import FINDERS, NEWTON
from kulman.plans.lab.hoists import (
    COURSE,
    FORMULAS,
    LIFT_OFF,
    PEAK,
    by_board,
    by_hand,
    exact,
    rivals,
    step_limits,
)
from kulman.plans.lab.integrators import EXPLICIT, RK4, STEPPERS, SYMPLECTIC, TRAPEZOID, VERLET
from kulman.plans.lab.race import Contest, Effort
from kulman.tests.support.hoists import VARIANTS

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
    found = exact(STEADY)
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
    found = exact(STEADY)

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
    assert {method: found[method].order for method in orders} == pytest.approx(orders, abs=0.15)
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
