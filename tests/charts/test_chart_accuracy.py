"""Errors beside fifty digits come out as laws say; stability grows where lines meet flatly; depth of a model."""

import math
import time
from dataclasses import replace
from functools import cache, partial
from typing import Any

import numpy as np
import pytest

from kulman import solve
from kulman.drawing.charts.race import accuracy_page
from kulman.drawing.words import Words
from kulman.plans.boards.exact import run
from kulman.plans.hands.shaky import preset
from kulman.plans.lab import race as contests
from kulman.plans.lab.contours import Contours
from kulman.plans.lab.linkages import DrawnSheet, _kinds_of, _places_of, _Rivals, _truth, by_hand, contest
from kulman.plans.lab.race import Contest, Effort, Entry
from kulman.plans.lab.stability import (
    ALL,
    CHANGE,
    DEAD,
    FORCES,
    INERTIA,
    LIMIT,
    MOMENTS,
    WEIGHTS,
    Stability,
    _Model,
    _parts_of,
    depth,
    spots,
    stability,
)
from kulman.plans.linkages.chain import construct
from kulman.plans.linkages.cycle import Cycle, cycle
from kulman.plans.linkages.mechanism import Mechanism
from kulman.plans.linkages.solved import board_givens, solve_linkage
from kulman.plans.quantities import references
from kulman.scales.errors import InputError
from kulman.tests.support.dyads import random_dyads
from kulman.tests.support.linkages import (
    four_bar,
    four_bar_values,
    piston_engine,
    random_crank_rockers,
    random_slider_cranks,
    slider_crank,
    slider_crank_values,
)
from kulman.variants.reader import load_task
from kulman.variants.shelf import bundled

LITTLE = Effort((1, 10), 20)
EPS = 2.0**-52
MOTION = ("velocity", "acceleration")
PLANS = ("position", *MOTION)
KINDS = (*MOTION, "forces")
MUS = {"position": 0.0025, "velocity": 0.2, "acceleration": 20.0, "lever": 0.2, "forces_1": 50.0, "forces_23": 50.0}
FEW = (  # every kind of dyad, and a slide that drives
    *("madi-four-bar", "nau-slider-crank", "scheme-09-shaper", "scheme-10-shaper-two-blocks"),
    *("scheme-18-hydraulic-drive", "scheme-19-scotch-yoke"),
)
SCALES = {"position": 0.002, "velocity": 0.01, "acceleration": 0.1}
NORMAL = preset("normal").hand
SHAPER = "scheme-09-shaper"
TASKS = ["nau-slider-crank", "madi-four-bar", SHAPER, "scheme-14-jaw-crusher"]


@cache
def of_task(name: str, *plans: str, positions: int = 12) -> Cycle:
    task = load_task(name)
    return cycle(task.mechanism, task.values(None, {}), plans or task.plans, positions)


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
    (double,) = set(errors(race, "plan", kind).values())  # however many positions at once
    assert 1e-9 < single < 1e-3
    assert EPS * 0.01 < double < 1e-13
    assert all(value < double * 1e-2 for value in errors(race, "plan-extended", kind).values())
    assert kind != "forces" or {e.method for e in race.of(kind)} == {"plan", "plan-single", "plan-extended"}


def test_chords_differences_and_newton_err_by_their_steps_and_tolerances(race: Contest) -> None:
    for kind, order, best in (("velocity", 1, 1e-5), ("acceleration", 2, 1e-4)):
        chords, differences = (errors(race, method, kind) for method in ("chords", "differences"))
        assert chords[96] / chords[192] == pytest.approx(4.0, rel=0.05)
        assert chords[192] / chords[384] == pytest.approx(4.0, rel=0.02)
        assert differences[1e-1] / differences[1e-2] == pytest.approx(100.0, rel=0.1)
        assert min(differences, key=lambda step: differences[step]) in (best, best * 10.0)
        assert math.log(differences[1e-8] / differences[1e-6], 100.0) == pytest.approx(order, abs=0.2)  # rounding
    newton = list(errors(race, "newton", "velocity").values())
    assert newton == sorted(newton, reverse=True)
    assert newton[0] > 1e-6
    assert newton[-1] < 1e-13


def test_the_front_is_beaten_by_nobody(race: Contest) -> None:
    for kind in KINDS:
        front = race.front(kind)
        timed = [e for e in race.of(kind) if e.seconds is not None]

        assert not [e for e in front if any(o.seconds < e.seconds and o.error < e.error for o in timed)]
        assert min(timed, key=lambda e: e.seconds or 0.0) in front
        assert min(timed, key=lambda e: e.error or 0.0).error == front[0].error
    made = (("fast", 1.0, 1e-3), ("good", 2.0, 1e-6), ("bad", 3.0, 1e-4), ("best", 4.0, 1e-9))
    entries = tuple(Entry(name, 1.0, KINDS[0], e, e, "V_B", 0.0, t, 1, 0.0) for name, t, e in made)
    assert [e.method for e in Contest((), np.zeros(1), entries).front(KINDS[0])] == ["best", "good", "fast"]


def test_contours_are_no_more_than_loops_and_what_newton_does_not_find_is_not_a_number() -> None:
    whole, contours = of_task("madi-four-bar"), _Rivals(of_task("scheme-09-shaper")).contours
    assert len(contours.closed) == 2
    assert contours.count == 4  # frame and slide, crank, lever and block, rod
    assert np.isnan(_Rivals(whole).newton(0.0, _places_of(whole, 24), ("V_C",))["V_C"]).all()


def drawn(hand: str, factor: float = 1.0) -> list[float]:
    """Return what a hand misses, with scale factors `factor` times as coarse."""
    task, whole = load_task("madi-four-bar"), of_task("madi-four-bar")
    solved = solve_linkage(task.mechanism, task.values(None, {}), task.plans)
    scales = {plan: MUS.get(plan, 50.0) * factor for plan in solved.scale_of_plan}
    entries = by_hand(whole, DrawnSheet("A1", solved, scales), preset(hand).hand, _kinds_of(whole))
    return [entry.error or math.inf for entry in entries]


def test_a_hand_errs_in_per_cents_and_a_computer_less() -> None:
    normal, cad, small = drawn("normal"), drawn("cad"), drawn("normal", 2.0)
    assert all(1e-3 < error < 1.0 for error in normal)
    assert all(fine < coarse / 5.0 for fine, coarse in zip(cad, normal, strict=True))
    assert all(large < half for large, half in zip(normal, small, strict=True))


def test_a_hand_draws_the_plans_of_every_position_as_long() -> None:
    task, whole = load_task("scheme-09-shaper"), of_task("scheme-09-shaper")
    places = _places_of(whole, 12)
    found = []
    for changed in ({}, {"phi": float(places[7] % math.tau)}):
        solved = solve_linkage(task.mechanism, {**task.values(None, {}), **changed}, task.plans)
        sizes = references(solved.program, solved.values)
        paper = dict.fromkeys(solved.scale_of_plan, 0.005)
        paper |= {"acceleration": sizes["a_A"] / 100.0, "velocity": sizes["V_A"] / 100.0}  # longest vectors 100 mm long
        drawing = DrawnSheet("A1", solved, paper)
        found.append([e.error for e in by_hand(whole, drawing, preset("normal").hand, _kinds_of(whole, ["a_E"]))])

    assert found[0] == pytest.approx(found[1], rel=1e-6)


def test_errors_are_found_to_extended_precision() -> None:
    whole = of_task("madi-four-bar")
    places = _places_of(whole, 3)
    exact = _truth(whole, places, ["V_C"])
    plan = _Rivals(whole).plan(places, ["V_C"])
    off = exact.errors({"V_C": plan["V_C"] + exact.sizes["V_C"] * 1e-6})
    assert exact.errors(plan)["V_C"].max() < 4.0 * EPS
    assert exact.errors({"V_C": exact.high["V_C"]})["V_C"].max() < EPS
    assert off["V_C"] == pytest.approx(1e-6, rel=1e-8)


def test_a_crank_that_speeds_up_is_differentiated_with_its_acceleration() -> None:
    task = load_task("madi-four-bar")
    driver = replace(task.mechanism.driver, acceleration="alpha")  # type: ignore[type-var]
    mechanism = replace(task.mechanism, driver=driver)
    values = {**task.values(None, {}), "alpha": 1e4}
    rivals = _Rivals(cycle(mechanism, values, ("acceleration",), 12))
    places = _places_of(rivals.cycle, 6)

    plan = rivals.plan(places, ["a_C", "epsilon_3"])
    steady = _Rivals(cycle(task.mechanism, values, ("acceleration",), 12)).plan(places, ["a_C"])

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


def differences(found: Any, exact: Any) -> float:
    """Return the largest difference of quantities, in parts of the largest value of each kind."""
    sizes: dict[str, float] = {}
    for name, values in exact.items():
        kind = name.partition("_")[0]
        sizes[kind] = max(sizes.get(kind, 0.0), float(np.nanmax(np.abs(values))))
    return max(float(np.nanmax(np.abs(found[n] - x))) / (sizes[n.partition("_")[0]] or 1.0) for n, x in exact.items())


def both(whole: Cycle, tolerance: float) -> tuple[Any, Any]:
    """Return motion by Newton's method and by plans, half a step off the ends of the cycle."""
    rivals, places = _Rivals(whole), _places_of(whole, 24)
    names = [name for kind in _kinds_of(whole) if kind.name in MOTION for name in kind.names]
    return rivals.newton(tolerance, places, names), rivals.plan(places, names)


@pytest.mark.parametrize(
    "name", [name if name in FEW else pytest.param(name, marks=[pytest.mark.soak]) for name in bundled("mechanism")]
)
def test_newton_agrees_with_plans(name: str) -> None:
    found, exact = both(of_task(name), 1e-9)
    assert any(name.startswith("a_") for name in exact)
    assert differences(found, exact) < 1e-8


@pytest.mark.parametrize(
    ("mechanism", "values"),
    [
        *((four_bar(), values) for values in random_crank_rockers(11, 8)),
        *((slider_crank(), values) for values in random_slider_cranks(12, 8)),
    ],
)
def test_newton_agrees_with_plans_of_random_mechanisms(mechanism: Mechanism, values: dict[str, float]) -> None:
    for size in (1.0, 1e6):  # some of a few metres, and the same in micrometres
        lengths = {name: size * value for name, value in values.items() if name[0] in "lxye"}
        found, exact = both(cycle(mechanism, values | lengths, PLANS), 1e-9)
        assert differences(found, exact) < 1e-9
        assert not any(np.isnan(found[name]).any() for name in exact)


@pytest.mark.parametrize(
    ("kind", "carries"),
    [
        *(("RRR", ()), ("RRP", (False,)), ("RRP", (True,)), ("RPR", (False,)), ("RPR", (True,))),
        *(("PRP", (False, True)), ("PRP", (True, True)), ("RPP", (True, False)), ("RPP", (True, True))),
    ],
)
def test_newton_agrees_with_plans_of_dyads_on_links_that_move(kind: str, carries: tuple[bool, ...]) -> None:
    mechanism, values, places = random_dyads(kind, (2, 3), carries, seed=5, count=4)
    _, program = construct(mechanism, PLANS)
    for i in range(len(places)):
        own = {name: float(np.broadcast_to(value, len(places))[i]) for name, value in values.items()}
        exact = run(program, board_givens(mechanism, own)).values
        contours = Contours(mechanism, own)
        at = np.array([own[mechanism.driver.coordinate]])
        points = {point: np.array([exact[point]]) for link in mechanism.links for point in link.points}
        turns = {link.number: np.exp(1j * places[i, k, 2:]) for k, link in enumerate(mechanism.links)}
        near = contours.pose(turns)
        near[: contours.count] += 1e-3
        pose = contours.solve(near, at, 1e-6)
        speed = exact[f"omega_{mechanism.driver.link}"]
        rates = contours.rates(pose, speed)
        epsilon = exact.get(f"epsilon_{mechanism.driver.link}", 0.0)
        changes = contours.changes(pose, rates, epsilon)

        moving = [point for point in points if f"a_{point}" in exact]
        most = max(abs(exact[f"a_{point}"]) for point in moving)
        for point in moving:
            form = contours.point(point)
            assert abs(contours.value(form, pose)[0] - exact[point]) < 1e-8
            assert abs(contours.change(form, pose, rates, changes)[0] - exact[f"a_{point}"]) < 1e-6 * most


def test_newton_takes_a_driver_that_slides_and_speeds_up() -> None:
    driven = piston_engine()
    driven = replace(driven, driver=replace(driven.driver, acceleration="a"))
    values = {"gamma": 0.3, "l_AB": 0.5, "l_OA": 0.2, "side": 1.0, "travel": 0.55, "speed": 2.0, "a": 3.0}
    found, exact = both(cycle(driven, values, PLANS, start=0.45, end=0.6), 1e-9)
    assert differences(found, exact) < 1e-10


@pytest.mark.parametrize("name", TASKS)
def test_leaving_out_nothing_costs_nothing_and_everything_costs_everything(name: str) -> None:
    model, whole = _Model(of_task(name)), of_task(name)
    loads = [load.name for load in whole.mechanism.acting]
    nothing, everything = model.cost("", ()), model.cost("", [*_parts_of(whole.program), *loads])
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


def crank(*values: float, positions: int = 12) -> Cycle:
    return cycle(slider_crank(), slider_crank_values(*values), PLANS, positions)


@pytest.mark.parametrize("name", TASKS)
def test_costs_are_those_of_a_mechanism_without_that_mass(name: str) -> None:
    whole, task = of_task(name), load_task(name)
    model = _Model(whole)
    link = next(link for link in whole.mechanism.links[::-1] if link.mass in whole.givens)
    parts = [part for part in _parts_of(whole.program) if part in (f"F_i{link.number}", f"G_{link.number}")]
    lighter = cycle(task.mechanism, {**whole.givens, link.mass: 0.0}, task.plans, 12)
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
    assert {*found.needed, *found.spare} == set(_parts_of(whole.program))
    assert not {*found.needed} & {*found.spare}
    assert _Model(whole).cost("", found.spare).worst <= tolerance
    assert bool(found.needed) == (tolerance < 100.0)


def test_the_lever_alone_gives_the_balance_and_without_forces_there_is_no_depth() -> None:
    found = depth(of_task("nau-slider-crank", "lever"), 1.0)
    assert (found.balance, found.reaction) == ("M_bal_lever", None)
    assert all(cost.reaction is None for cost in found.costs)
    with pytest.raises(InputError, match="needs the plan of forces"):
        depth(of_task("nau-slider-crank", "acceleration"), 1.0)
