"""Stability over the cycle grows where lines meet flatly; depth: nothing left out costs nothing, everything all."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from kulman import solve
from kulman.plans.hands.shaky import preset
from kulman.plans.lab.stability import (
    ALL,
    CHANGE,
    DEAD,
    FORCES,
    INERTIA,
    LIMIT,
    MOMENTS,
    WEIGHTS,
    Model,
    Stability,
    depth,
    parts_of,
    spots,
    stability,
    without,
)
from kulman.plans.linkages.cycle import Cycle, cycle
from kulman.plans.linkages.mechanism import Mechanism
from kulman.plans.linkages.solved import SolvedLinkage, solve_linkage
from kulman.scales.errors import InputError
from kulman.tests.support.cases import solve_case
from kulman.tests.support.linkages import four_bar, four_bar_values, slider_crank, slider_crank_values
from kulman.variants.charts import linkage as chart_of
from kulman.variants.charts.charts import Scene
from kulman.variants.reader import load_task

PLANS = ("position", "velocity", "acceleration")
MUS = {"position": 0.002, "velocity": 0.01, "acceleration": 0.1}
NORMAL = preset("normal").hand
SHAPER = "scheme-09-shaper"
TASKS = ["nau-slider-crank", "madi-four-bar", SHAPER, "scheme-14-jaw-crusher"]


@pytest.mark.parametrize("name", TASKS)
def test_leaving_out_nothing_costs_nothing_and_everything_costs_everything(name: str) -> None:
    model, whole = Model(of_task(name)), of_task(name)
    loads = [load.name for load in whole.mechanism.acting]

    nothing, everything = model.cost("", ()), model.cost("", [*parts_of(whole.program), *loads])

    assert (nothing.balance, nothing.reaction, nothing.balance_rms, nothing.reaction_rms) == (0.0, 0.0, 0.0, 0.0)
    assert (everything.balance, everything.reaction) == pytest.approx((100.0, 100.0), rel=1e-9)


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
    whole = crank(0.5, 0.5, 0.1)
    limit, _ = whole.reach.limits  # nothing assembles from the first one to the second
    near = _at(whole, limit - 10.0 ** -np.arange(2.0, 7.0))

    found = look(near, "V_B")

    products = found.conditions["V_B"] * found.sines**2
    assert found.sines[-1] < 2e-3
    assert products.max() / products.min() < 1.01
    assert (np.diff(found.digits("V_B")) < 0.0).all()


def _at(whole: Cycle, places: np.ndarray) -> Cycle:
    """Return a cycle at other places of its driver."""
    values, codes = whole.drive.along(whole.program, whole.givens, list(whole.values)).batch(places)
    return replace(whole, angles=places, times=places * 0.0, values=values, codes=codes)


def test_the_hand_misses_more_where_lines_meet_flatly() -> None:
    found = look(crank(0.48, 0.5, 0.0, positions=72), "V_B")

    flat, steep = found.angles < 25.0, found.angles > 60.0
    assert flat.any()
    assert np.median(found.misses["V_B"][flat]) > 2.0 * np.median(found.misses["V_B"][steep])
    assert found.in_mm == {"V_B": True}
    assert set(found.worst) <= {"B", "velocity.B"}  # the worst intersection is named


def test_a_number_that_no_plan_shows_misses_by_per_cents() -> None:
    plans = ("position", "velocity", "acceleration", "lever", "forces_23", "forces_2", "forces_1")

    found = stability(of_task("nau-slider-crank"), ("M_bal",), dict.fromkeys(plans, 0.001), NORMAL)

    assert found.in_mm == {"M_bal": False}
    assert np.nanmax(found.misses["M_bal"]) > 0.0


def test_scales_of_the_paper_divide_the_errors_of_drawing_and_a_seed_gives_the_same() -> None:
    whole = cycle(four_bar(), four_bar_values(0.2, 0.6, 0.5, 0.7), PLANS, 12)
    coarse = {plan: 2.0 * mu for plan, mu in MUS.items()}

    large, small, same, other = (
        stability(whole, ("V_B",), mus, NORMAL, seed).misses["V_B"]
        for mus, seed in ((MUS, 1), (coarse, 1), (MUS, 1), (MUS, 2))
    )

    assert np.median(small / large) == pytest.approx(1.0, rel=0.3)  # in mm they are alike
    assert same.tolist() == large.tolist() != other.tolist()


def test_change_points_dead_positions_and_limits_are_marked_and_have_no_condition() -> None:
    parallelogram = cycle(four_bar(), four_bar_values(0.2, 0.5, 0.2, 0.5), PLANS, 4)

    flat, apart, dead = (
        look(parallelogram, "V_B"),
        look(crank(0.5, 0.2, 0.0, positions=8), "V_B"),
        spots(of_task(SHAPER)),
    )

    assert {spot.kind for spot in flat.spots} >= {CHANGE}
    at_change = [status == "singular" for status in flat.statuses]
    assert sum(at_change) == 2
    assert np.isnan(flat.conditions["V_B"][at_change]).all()
    assert np.isnan(flat.misses["V_B"][at_change]).all()
    assert (flat.angles[at_change] == 0.0).all()
    assert {spot.kind for spot in apart.spots} >= {LIMIT}
    assert np.isnan(apart.conditions["V_B"][2])
    assert np.isfinite(apart.conditions["V_B"][0])
    assert sorted((spot.kind, spot.link) for spot in dead) == [(DEAD, 3), (DEAD, 3), (DEAD, 5), (DEAD, 5)]


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


@cache
def of_task(name: str, *plans: str) -> Cycle:
    task = load_task(name)
    return cycle(task.mechanism, task.values(None, {}), plans or task.plans, 36)


def crank(*values: float, positions: int = 12) -> Cycle:
    return cycle(slider_crank(), slider_crank_values(*values), PLANS, positions)


@pytest.mark.parametrize("name", TASKS)
def test_costs_are_those_of_a_mechanism_without_that_mass(name: str) -> None:
    whole, task = of_task(name), load_task(name)
    model = Model(whole)
    link = next(link for link in whole.mechanism.links[::-1] if link.mass in whole.givens)
    parts = [part for part in parts_of(whole.program) if part in (f"F_i{link.number}", f"G_{link.number}")]

    lighter = cycle(task.mechanism, {**whole.givens, link.mass: 0.0}, task.plans, 36)

    change = np.nanmax(np.abs(lighter.values[model.balance] - whole.values[model.balance]))
    assert parts
    assert model.cost("", parts).balance == pytest.approx(change / model.largest * 100.0, rel=1e-9, abs=1e-9)


def test_simplifications_are_those_of_each_part_and_of_all_of_a_kind() -> None:
    found, without_weight = depth(of_task(SHAPER), 1.0), depth(of_task("madi-four-bar"), 1.0)

    keys = [cost.key for cost in found.costs]
    assert keys[:8] == ["F_i3", "G_3", "M_i3", "F_i4", "G_4", "M_i4", "F_i5", "G_5"]
    assert keys[8:] == [FORCES, MOMENTS, WEIGHTS, INERTIA, ALL]
    costs = {cost.key: cost for cost in found.costs}
    assert costs["G_5"].balance < 1e-9  # the ram moves level: its weight does no work
    assert (costs["G_5"].reaction or 0.0) > 5.0  # but its guide bears it
    assert all(cost.balance_rms <= cost.balance for cost in found.costs)
    assert {cost.key for cost in without_weight.costs} & {INERTIA, ALL, WEIGHTS} == {INERTIA}  # all inertia once


@pytest.mark.parametrize("tolerance", [0.0, 5.0, 200.0, pytest.param(0.5, marks=pytest.mark.soak)])
def test_what_may_go_costs_less_than_the_tolerance(tolerance: float) -> None:
    whole = of_task(SHAPER)
    found = depth(whole, tolerance)

    assert {*found.needed, *found.spare} == set(parts_of(whole.program))
    assert not {*found.needed} & {*found.spare}
    assert Model(whole).cost("", found.spare).worst <= tolerance
    assert bool(found.needed) == (tolerance < 100.0)


def test_the_lever_alone_gives_the_balance_and_without_forces_there_is_no_depth() -> None:
    found = depth(of_task("nau-slider-crank", "lever"), 1.0)

    assert (found.balance, found.reaction) == ("M_bal_lever", None)
    assert all(cost.reaction is None for cost in found.costs)
    with pytest.raises(InputError, match="needs the plan of forces"):
        depth(of_task("nau-slider-crank", "acceleration"), 1.0)


def test_a_part_is_left_out_by_a_rewrite_of_its_own_step() -> None:
    program = of_task("nau-slider-crank").program

    rewritten = without(program, ["F_i2"])

    changed = [(a, b) for a, b in zip(program, rewritten, strict=True) if a != b]
    assert [(a.name, b.operands[0]) for a, b in changed] == [("F_i2", "zero")]
