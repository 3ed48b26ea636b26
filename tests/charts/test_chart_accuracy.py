"""Speed against accuracy: errors beside fifty digits come out as the methods' own laws say; times are not tested."""

from __future__ import annotations

import math
import time
from dataclasses import replace
from functools import cache, partial

import numpy as np
import pytest

from kulman.drawing.charts.race import accuracy_page
from kulman.drawing.words import Words
from kulman.plans.hands.shaky import preset
from kulman.plans.lab import race as contests
from kulman.plans.lab.linkages import DrawnSheet, Rivals, by_hand, contest, kinds_of, places_of, truth
from kulman.plans.lab.race import Contest, Effort, Entry
from kulman.plans.linkages.cycles.cycle import Cycle, cycle
from kulman.plans.linkages.solved import solve_linkage
from kulman.plans.quantities import references
from kulman.variants.reader import load_task

LITTLE = Effort((1, 10), 20)
KINDS = ("velocity", "acceleration", "forces")
EPS = 2.0**-52


@cache
def of_task(name: str) -> Cycle:
    task = load_task(name)
    return cycle(task.mechanism, task.values(None, {}), task.plans, 12)


@pytest.fixture(scope="module", params=["madi-four-bar", "scheme-09-shaper"])
def race(request: pytest.FixtureRequest) -> Contest:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(contests, "ROUNDS", 1)
        return contest(of_task(request.param), 12, time.process_time, effort=LITTLE)


def errors(race: Contest, method: str, kind: str) -> dict[float | str, float]:
    return {e.setting: e.error for e in race.of(kind) if e.method == method and e.error is not None}


@pytest.mark.parametrize("kind", KINDS)
def test_more_digits_err_less(race: Contest, kind: str) -> None:
    (single,) = errors(race, "plan-single", kind).values()
    double = set(errors(race, "plan", kind).values())
    extended = errors(race, "plan-extended", kind).values()

    assert len(double) == 1  # however many positions at once
    assert 1e-9 < single < 1e-3
    assert EPS * 0.01 < max(double) < 1e-13
    assert all(value < max(double) * 1e-2 for value in extended)


@pytest.mark.parametrize("kind", KINDS[:2])
def test_chords_err_as_the_square_of_a_section(race: Contest, kind: str) -> None:
    found = errors(race, "chords", kind)

    assert found[96] / found[192] == pytest.approx(4.0, rel=0.05)
    assert found[192] / found[384] == pytest.approx(4.0, rel=0.02)


@pytest.mark.parametrize(("kind", "best"), [("velocity", 1e-5), ("acceleration", 1e-4)])
def test_differences_err_by_the_step_and_then_by_rounding(race: Contest, kind: str, best: float) -> None:
    found = errors(race, "differences", kind)

    assert found[1e-1] / found[1e-2] == pytest.approx(100.0, rel=0.1)
    assert min(found, key=lambda step: found[step]) in (best, best * 10.0)
    order = 1 if kind == "velocity" else 2
    assert math.log(found[1e-8] / found[1e-6], 100.0) == pytest.approx(order, abs=0.2)


def test_newton_errs_less_with_every_tolerance(race: Contest) -> None:
    found = list(errors(race, "newton", "velocity").values())

    assert found == sorted(found, reverse=True)
    assert found[0] > 1e-6
    assert found[-1] < 1e-13


def test_forces_are_known_by_plans_alone(race: Contest) -> None:
    assert {e.method for e in race.of("forces")} == {"plan", "plan-single", "plan-extended"}


def test_the_front_is_beaten_by_nobody(race: Contest) -> None:
    for kind in KINDS:
        front = race.front(kind)
        timed = [e for e in race.of(kind) if e.seconds is not None]
        beaten = [e for e in front if any(o.seconds < e.seconds and o.error < e.error for o in timed)]  # type: ignore[operator]

        assert front
        assert beaten == []
        assert min(timed, key=lambda e: e.seconds or 0.0) in front
        assert min(timed, key=lambda e: e.error or 0.0).error == front[0].error


def test_the_front_of_a_made_up_contest() -> None:
    def entry(method: str, seconds: float, error: float) -> Entry:
        return Entry(method, 1.0, "velocity", error, error, "V_B", 0.0, seconds, 1, 0.0)

    entries = entry("fast", 1.0, 1e-3), entry("good", 2.0, 1e-6), entry("bad", 3.0, 1e-4), entry("best", 4.0, 1e-9)

    assert [e.method for e in Contest((), np.zeros(1), entries).front("velocity")] == ["best", "good", "fast"]


MUS = {"position": 0.0025, "velocity": 0.2, "acceleration": 20.0, "lever": 0.2, "forces_1": 50.0, "forces_23": 50.0}


def drawn(hand: str, factor: float = 1.0, name: str = "madi-four-bar") -> list[Entry]:
    """Return what a hand misses, with scale factors `factor` times as coarse."""
    task, whole = load_task(name), of_task(name)
    solved = solve_linkage(task.mechanism, task.values(None, {}), task.plans)
    scales = {plan: MUS.get(plan, 50.0) * factor for plan in solved.scale_of_plan}
    return list(by_hand(whole, DrawnSheet("A1", solved, scales), preset(hand).hand, kinds_of(whole)))


def test_a_hand_errs_in_per_cents_and_a_computer_less() -> None:
    ways = (("normal", 1.0), ("cad", 1.0), ("normal", 2.0))
    normal, cad, small = ([entry.error or math.inf for entry in drawn(*way)] for way in ways)

    assert all(1e-3 < error < 1.0 for error in normal)
    assert all(fine < coarse / 5.0 for fine, coarse in zip(cad, normal, strict=True))
    assert all(large < half for large, half in zip(normal, small, strict=True))


def test_a_hand_draws_the_plans_of_every_position_as_long() -> None:
    task, whole = load_task("scheme-09-shaper"), of_task("scheme-09-shaper")
    places = places_of(whole, 12)
    elsewhere = {**task.values(None, {}), "phi": float(places[7] % math.tau)}
    mus: list[list[Entry]] = []
    for values in (task.values(None, {}), elsewhere):
        solved = solve_linkage(task.mechanism, values, task.plans)
        sizes = references(solved.program, solved.values)
        paper = dict.fromkeys(solved.scale_of_plan, 0.005)
        paper |= {"acceleration": sizes["a_A"] / 100.0, "velocity": sizes["V_A"] / 100.0}  # longest vectors 100 mm long
        mus.append(
            list(by_hand(whole, DrawnSheet("A1", solved, paper), preset("normal").hand, kinds_of(whole, ["a_E"])))
        )

    assert [e.error for e in mus[0]] == pytest.approx([e.error for e in mus[1]], rel=1e-6)


def test_places_of_a_cycle_are_off_its_ends() -> None:
    whole = of_task("scheme-18-hydraulic-drive")
    places = places_of(whole, 10)

    low, high = sorted((whole.range.low, whole.range.high))
    assert low < places.min() < places.max() < high


def test_errors_are_found_to_extended_precision() -> None:
    whole = of_task("madi-four-bar")
    places = places_of(whole, 3)
    exact = truth(whole, places, ["V_C"])
    plan = Rivals(whole).plan(places, ["V_C"])

    off = exact.errors({"V_C": plan["V_C"] + exact.sizes["V_C"] * 1e-6})

    assert exact.errors(plan)["V_C"].max() < 4.0 * EPS
    assert exact.errors({"V_C": exact.high["V_C"]})["V_C"].max() < EPS
    assert off["V_C"] == pytest.approx(1e-6, rel=1e-8)


def test_a_crank_that_speeds_up_is_differentiated_with_its_acceleration() -> None:
    task = load_task("madi-four-bar")
    driver = replace(task.mechanism.driver, acceleration="alpha")  # type: ignore[type-var]
    mechanism = replace(task.mechanism, driver=driver)
    values = {**task.values(None, {}), "alpha": 1e4}
    rivals = Rivals(cycle(mechanism, values, ("acceleration",), 12))
    places = places_of(rivals.cycle, 6)

    plan = rivals.plan(places, ["a_C", "epsilon_3"])
    steady = Rivals(cycle(task.mechanism, values, ("acceleration",), 12)).plan(places, ["a_C"])

    assert abs(plan["a_C"] - steady["a_C"]).max() > 0.1 * abs(plan["a_C"]).max()
    for way in (partial(rivals.differences, 1e-4), partial(rivals.chords, 4000)):
        found = way(places, ["a_C", "epsilon_3"])
        for name, value in found.items():
            assert abs(value - plan[name]).max() < 1e-5 * abs(plan[name]).max()


def test_a_clock_too_coarse_for_every_method_leaves_the_field_empty() -> None:
    race = contest(of_task("madi-four-bar"), 12, lambda: 0.0, ["V_B"], LITTLE)

    assert {entry.seconds for entry in race.entries} == {0.0}
    drawn = accuracy_page(race, Words.of("en", "madi"), "", "", "normal", "rad")  # warnings are errors
    assert not drawn.axes[0].lines[-1].get_xdata().size
