"""Stability over the cycle: condition and errors of drawing grow where lines meet flatly; special places are marked."""

from __future__ import annotations

import numpy as np
import pytest

from kulman import solve
from kulman.plans.hands.shaky import preset
from kulman.plans.lab.stability import CHANGE, DEAD, LIMIT, Stability, spots, stability
from kulman.plans.linkages.cycles.cycle import Cycle, cycle
from kulman.plans.linkages.mechanism import Mechanism
from kulman.plans.linkages.solved import SolvedLinkage, solve_linkage
from kulman.tests.support.cases import solve_case
from kulman.tests.support.linkages import four_bar, four_bar_values, slider_crank, slider_crank_values
from kulman.variants.charts import linkage as chart_of
from kulman.variants.charts.charts import Scene
from kulman.variants.reader import load_task

PLANS = ("position", "velocity", "acceleration")
MUS = {"position": 0.002, "velocity": 0.01, "acceleration": 0.1}
NORMAL = preset("normal").hand


def look(whole: Cycle, *names: str) -> Stability:
    return stability(whole, names, MUS, NORMAL)


def test_condition_is_that_of_a_solution_at_the_same_place() -> None:
    task = load_task("madi-four-bar")
    values = task.values(None, {})
    whole = cycle(task.mechanism, values, task.plans, 12, start=values["phi"])
    mus = dict.fromkeys(("position", "velocity", "acceleration", "forces_23", "forces_1", "lever"), 1.0)

    found = stability(whole, ("V_C", "a_C", "F_bal"), mus, NORMAL)

    expected = solve("madi-four-bar", condition=True).conditions
    for name, values_of in found.conditions.items():
        assert values_of[0] == pytest.approx(expected[name].value, rel=1e-9)
    assert found.sines[0] == min(expected[name].sine for name in found.conditions)


def test_condition_grows_as_one_over_the_square_of_the_sine_towards_a_limit() -> None:
    """The sine goes with the root of the way to the limit, the velocity with one over the sine."""
    whole = cycle(slider_crank(), slider_crank_values(0.5, 0.5, 0.1), PLANS, 12)
    limit, _ = whole.reach.limits  # nothing assembles from the first one to the second
    near = _at(whole, limit - 10.0 ** -np.arange(2.0, 7.0))

    found = look(near, "V_B")

    products = found.conditions["V_B"] * found.sines**2
    assert found.sines[-1] < 2e-3
    assert products.max() / products.min() < 1.01
    assert (np.diff(found.digits("V_B")) < 0.0).all()


def _at(whole: Cycle, places: np.ndarray) -> Cycle:
    """Return a cycle at other places of its driver."""
    from dataclasses import replace

    wanted = list(whole.values)
    values, codes = whole.drive.along(whole.program, whole.givens, wanted).batch(places)
    return replace(whole, angles=places, times=places * 0.0, values=values, codes=codes)


def test_the_hand_misses_more_where_lines_meet_flatly() -> None:
    whole = cycle(slider_crank(), slider_crank_values(0.48, 0.5, 0.0), PLANS, 72)

    found = look(whole, "V_B")

    flat, steep = found.angles < 25.0, found.angles > 60.0
    assert flat.any()
    assert np.median(found.misses["V_B"][flat]) > 2.0 * np.median(found.misses["V_B"][steep])
    assert found.in_mm == {"V_B": True}


def test_a_number_that_no_plan_shows_misses_by_per_cents() -> None:
    task = load_task("nau-slider-crank")
    whole = cycle(task.mechanism, task.values(None, {}), task.plans, 12)
    mus = dict.fromkeys(("position", "velocity", "acceleration", "lever", "forces_23", "forces_2", "forces_1"), 0.001)

    found = stability(whole, ("M_bal",), mus, NORMAL)

    assert found.in_mm == {"M_bal": False}
    assert np.nanmax(found.misses["M_bal"]) > 0.0


def test_scales_of_the_paper_divide_the_errors_of_drawing() -> None:
    whole = cycle(four_bar(), four_bar_values(0.2, 0.6, 0.5, 0.7), PLANS, 12)

    large, small = (
        stability(whole, ("V_B",), {plan: mu * factor for plan, mu in MUS.items()}, NORMAL) for factor in (1.0, 2.0)
    )

    assert np.median(small.misses["V_B"] / large.misses["V_B"]) == pytest.approx(1.0, rel=0.3)  # in mm they are alike
    assert stability(whole, ("V_B",), MUS, NORMAL).misses["V_B"].tolist() == large.misses["V_B"].tolist()


def test_positions_for_scales_are_solved_once_where_they_are_sound(monkeypatch: pytest.MonkeyPatch) -> None:
    case = solve_case("madi-four-bar", None, None, None, None)
    values = case.task.values(case.variant, case.settings)
    whole = cycle(case.task.mechanism, values, case.plans, 2 * chart_of.LOOKED, start=values["phi"])
    places: list[float] = []

    def solved_at(mechanism: Mechanism, values: dict[str, float], plans: tuple[str, ...]) -> SolvedLinkage:
        places.append(values["phi"])
        return solve_linkage(mechanism, values, plans)

    monkeypatch.setattr(chart_of, "solve_linkage", solved_at)

    chart_of.scales_of_cycle(Scene(case, case.words("en"), "normal"), whole)

    assert places == [*whole.angles[::2]]


def test_dead_positions_of_the_bundled_shaper_are_marked() -> None:
    task = load_task("scheme-09-shaper")
    whole = cycle(task.mechanism, task.values(None, {}), PLANS, 12)

    found = spots(whole)

    assert {(spot.kind, spot.link) for spot in found} == {(DEAD, 3), (DEAD, 5)}
    assert len(found) == 4


def test_change_points_and_limits_are_marked_and_have_no_condition() -> None:
    parallelogram = cycle(four_bar(), four_bar_values(0.2, 0.5, 0.2, 0.5), PLANS, 4)
    short = cycle(slider_crank(), slider_crank_values(0.5, 0.2, 0.0), PLANS, 8)

    flat, apart = look(parallelogram, "V_B"), look(short, "V_B")

    assert {spot.kind for spot in flat.spots} >= {CHANGE}
    at_change = [status == "singular" for status in flat.statuses]
    assert sum(at_change) == 2
    assert np.isnan(flat.conditions["V_B"][at_change]).all()
    assert np.isnan(flat.misses["V_B"][at_change]).all()
    assert (flat.angles[at_change] == 0.0).all()
    assert {spot.kind for spot in apart.spots} >= {LIMIT}
    assert np.isnan(apart.conditions["V_B"][2])
    assert np.isfinite(apart.conditions["V_B"][0])


def test_the_worst_intersection_is_named() -> None:
    found = look(cycle(slider_crank(), slider_crank_values(0.2, 0.5, 0.1), PLANS, 12), "V_B")

    assert set(found.worst) <= {"B", "velocity.B"}


def test_the_same_seed_draws_the_same() -> None:
    whole = cycle(slider_crank(), slider_crank_values(0.2, 0.5, 0.1), PLANS, 6)

    one, same, other = (stability(whole, ("V_B",), MUS, NORMAL, seed).misses["V_B"] for seed in (1, 1, 2))

    assert one.tolist() == same.tolist()
    assert one.tolist() != other.tolist()
