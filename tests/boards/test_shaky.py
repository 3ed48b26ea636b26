"""The shaky hand: nothing at zero, linear while small, worse by 1/sin and by the scale, as bad as honest drawings."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from kulman import solve
from kulman.plans.board import Program
from kulman.plans.boards.exact import run
from kulman.plans.hands.shaky import PRESETS, Hand, Paper, draw, paper_of, preset
from kulman.plans.hands.spread import drawn, sensitivities
from kulman.plans.linkages.chain import construct
from kulman.plans.linkages.solved import board_givens
from kulman.plans.quantities import results
from kulman.tests.support.mechanisms import (
    SEED,
    Solved,
    general_slider_crank,
    nau_slider_crank,
    nau_values,
    random_slider_cranks,
)
from kulman.variants.shelf import bundled
from kulman.variants.solution import Solution

Array = NDArray[Any]
STEADY = Hand(0.0, 0.0, 0.0)
# between them all kinds of dyads, a triad, compound motion, both drivers, force plans and levers
SAMPLE = ("nau-slider-crank", "madi-four-bar", "scheme-09-shaper", "scheme-20-press-automaton")
MORE = [pytest.param(task, marks=pytest.mark.soak) for task in bundled("mechanism") if task not in SAMPLE]


def generator() -> np.random.Generator:
    return np.random.default_rng(SEED)


@cache
def solution_of(task: str, variant: str | None = None) -> Solution:
    return solve(task, variant)


def paper(task: str = "nau-slider-crank", variant: str | None = None) -> Paper:
    solution = solution_of(task, variant)
    return paper_of(solution.solved, {symbol: scale.mu for symbol, scale in solution.scales.items()})


def example() -> Paper:
    return paper("nau-slider-crank", "example")


def random_paper(count: int, least_sine: float = 0.3) -> Paper:
    """Return many slider-cranks, one drawing of each; every plan of each is drawn to its own scale, 100 mm large."""
    mechanism, values = general_slider_crank(), random_slider_cranks(SEED, count, least_sine)
    _, program = construct(mechanism)
    givens = board_givens(mechanism, values)
    exact = draw(Paper(program, givens, dict.fromkeys(program.plans, 1.0)), STEADY, generator(), count).values
    mus = {plan: largest(program, exact, plan) / 100.0 for plan in program.plans}
    return Paper(program, givens, mus)


def largest(program: Program, values: Any, plan: str) -> Array:
    sizes = [np.abs(values[step.name]) for step in program.on(plan) if step.verb in ("read", "lay", "chain", "arc")]
    if plan == "lever":
        sizes = [np.abs(values["V_A"])]
    return np.max(np.broadcast_arrays(*sizes), axis=0)


def same_bits(first: Any, second: Any) -> bool:
    return (np.asarray(first) + 0.0).tobytes() == (np.asarray(second) + 0.0).tobytes()


# Nothing at zero.


@pytest.mark.parametrize("task", bundled("mechanism"))
def test_a_hand_without_errors_draws_the_exact_plan_to_the_last_bit(task: str) -> None:
    drawing = paper(task)
    exact = run(drawing.program, drawing.givens).values

    board = draw(drawing, STEADY, generator(), 3)

    assert [name for name in drawing.program.names if not same_bits(board.values[name], exact[name])] == []
    assert board.missed == set()


def test_hands_without_errors_draw_random_mechanisms_to_the_last_bit(cranks: Solved) -> None:
    count = len(cranks.codes)
    givens = board_givens(cranks.mechanism, cranks.values)
    drawing = Paper(cranks.program, givens, dict.fromkeys(cranks.program.plans, 1.0))

    board = draw(drawing, STEADY, generator(), count)

    assert np.array_equal(board.codes, cranks.codes)
    for name in cranks.program.names:
        assert same_bits(np.broadcast_to(board.values[name], (count,)), cranks[name]), name


def test_the_same_seed_draws_the_same() -> None:
    hand = preset("normal").hand
    first, second = (draw(example(), hand, generator(), 50).values["R_12"] for _ in range(2))
    other = draw(example(), hand, np.random.default_rng(SEED + 1), 50).values["R_12"]

    assert same_bits(first, second)
    assert not np.any(first == other)


# What errs and what does not.


def test_data_and_what_follows_from_them_alone_stay_exact() -> None:
    board = draw(example(), preset("normal").hand, generator(), 20)

    assert {"omega_1", "_V_A", "_a_A", "u_30", "O", "F_3", "e_F_3"}.isdisjoint(board.missed)
    assert {"A", "B", "V_B", "omega_2", "R_12", "M_bal", "h_2"} <= board.missed


def test_what_is_read_is_what_later_steps_start_from() -> None:
    board = draw(example(), Hand(0.0, 0.0, 0.5), generator(), 200, only=("V_BA",))
    values = board.values
    exact = run(example().program, example().givens).values

    assert np.all(values["V_BA"] != exact["V_BA"])
    along = values["V_BA"].real * values["n_AB"].real + values["V_BA"].imag * values["n_AB"].imag
    assert values["omega_2"] == pytest.approx(along / example().givens["l_AB"], rel=1e-14)
    assert values["velocity.S2"] == exact["velocity.S2"]  # marks stay where they are


@pytest.mark.parametrize(
    ("hand", "name", "expected"),
    [
        pytest.param(Hand(0.2, 0.0, 0.0), "velocity.A", 0.2 * math.sqrt(2.0), id="both coordinates of a mark"),
        pytest.param(Hand(0.0, 0.0, 0.2), "V_A", 0.2 * math.sqrt(2.0), id="both components of what is read"),
        pytest.param(Hand(0.0, 1.0, 0.0), "velocity.A", 80.0 * math.radians(1.0), id="direction on its length"),
        pytest.param(Hand(0.0, 1.0, 0.0), "A", 100.0 * math.radians(1.0), id="protractor on the crank"),
    ],
)
def test_an_error_is_as_large_as_it_is_said(hand: Hand, name: str, expected: float) -> None:
    solution = solve("nau-slider-crank", "example", scales={"pa": 80, "mu_l": 0.0005})
    drawing = paper_of(solution.solved, {symbol: scale.mu for symbol, scale in solution.scales.items()})
    program = drawing.program
    step = next(step for step in program if step.name == name)
    only = ("e_OA",) if name == "A" else (name,)

    values = draw(drawing, hand, generator(), 20_000, only).values[name]

    miss = np.abs(values - run(program, drawing.givens).values[name]) / drawing.mus[step.plan]
    assert math.sqrt(np.mean(miss**2)) == pytest.approx(expected, rel=0.03)


def test_drawings_that_fail_are_counted() -> None:
    # the rod is a hair longer than the way from A to the guide: half of all hands cannot reach it
    values = nau_values(l_OA=0.1, phi=math.pi / 2.0, l_AB=0.1 * (1.0 + 1e-9))
    mechanism = nau_slider_crank()
    _, program = construct(mechanism, ("velocity",))
    drawing = Paper(program, board_givens(mechanism, values), {"position": 0.001, "velocity": 0.05})

    found = drawn(drawing, preset("normal").hand, generator(), 4000)

    assert found.spreads()["B"].undrawn == pytest.approx(0.5, abs=0.05)
    assert math.isnan(found.spreads()["B"].miss)
    assert found.spreads(0.4)["B"].miss > 0.0
    assert found.spreads()["A"].undrawn == 0.0
    assert np.mean(found.board.codes == 3) == found.spreads()["B"].undrawn
    assert found.failing(dict.fromkeys((step.name for step in results(program)), 1e9))["B"] > 0.4


# Laws.


def test_spread_is_linear_in_small_errors() -> None:
    small = preset("careful").hand.times(0.01)
    once, thrice = (drawn(example(), small.times(factor), generator(), 2000).spreads() for factor in (1.0, 3.0))

    for name, spread in once.items():
        if spread.deviation > 0.0 and not name.startswith("delta"):
            assert thrice[name].deviation == pytest.approx(3.0 * spread.deviation, rel=0.02), name


@pytest.mark.parametrize("count", [2000, pytest.param(10_000, marks=pytest.mark.soak)])
def test_errors_of_random_mechanisms_are_linear_too(count: int) -> None:
    drawing = random_paper(count)
    hand = Hand(1e-4, 1e-3, 1e-4)
    exact, one, two = (draw(drawing, hand.times(k), generator(), count).values for k in (0.0, 1.0, 2.0))

    for name in ("V_B", "omega_2", "a_B", "R_12", "M_bal"):
        first, second = one[name] - exact[name], two[name] - exact[name]
        bent = np.abs(second - 2.0 * first) / np.maximum(np.abs(first), 1e-9 * np.abs(exact[name]))
        assert np.median(bent) < 1e-3
        assert np.mean(bent < 0.05) > 0.99


@pytest.mark.parametrize("angle", [0.3, 0.1, 0.03])
def test_spread_grows_like_one_over_the_sine_of_an_intersection(angle: float) -> None:
    def missing(gamma: float) -> float:
        """Return by how much a mark misses where two lines meet at `gamma`, mm, distances being the same."""
        step = solve("nau-slider-crank", "example").solved.program.steps
        meet = next(s for s in step if s.name == "velocity.B")
        way = complex(math.cos(gamma), math.sin(gamma))
        givens = dict(zip(meet.operands, (-0.1 + 0j, 1 + 0j, -0.1 * way, way), strict=True))
        drawing = Paper(Program((meet,)), givens, {"velocity": 0.001})
        values = draw(drawing, Hand(0.01, 0.0, 0.0), generator(), 20_000).values["velocity.B"]
        return float(np.sqrt(np.mean(np.abs(values) ** 2)))

    # each line lies 0.01 mm aside with its own error: together sqrt(2) / sin gamma
    assert missing(angle) * 1e3 == pytest.approx(0.01 * math.sqrt(2.0) / math.sin(angle), rel=0.03)


def test_piston_misses_by_one_over_the_sine_as_the_rod_nears_the_normal_to_the_guide() -> None:
    def missing(sine: float) -> float:
        """Return the deviation of B along the guide; the sine is that of arc and guide."""
        phi = math.asin(0.08 * math.sqrt(1.0 - sine**2) / 0.1)
        mechanism, values = nau_slider_crank(), nau_values(l_OA=0.1, l_AB=0.08, phi=phi)
        _, program = construct(mechanism, ("position",))
        drawing = Paper(program, board_givens(mechanism, values), {"position": 0.001})
        return drawn(drawing, Hand(1e-4, 0.0, 1e-4), generator(), 4000).spreads()["B"].deviation

    assert missing(0.05) / missing(0.2) == pytest.approx(4.0, rel=0.1)
    assert missing(0.01) / missing(0.05) == pytest.approx(5.0, rel=0.1)


@pytest.mark.parametrize(
    ("plan", "symbol", "quantities"),
    [
        pytest.param("velocity", "mu_V", ("V_A", "V_B", "V_S2", "V_BA"), id="velocities"),
        pytest.param("acceleration", "mu_a", ("a_B", "a_S2", "a_BA_t"), id="accelerations"),
    ],
)
def test_a_smaller_scale_is_worse_in_proportion(plan: str, symbol: str, quantities: Iterable[str]) -> None:
    steps = tuple(step.name for step in example().program.on(plan))  # what is made on this plan alone errs
    hand = Hand(0.01, 0.0, 0.01)  # an error of direction is the same at every scale
    large, small = (
        draw(replace(example(), mus={**example().mus, plan: example().mus[plan] * k}), hand, generator(), 500, steps)
        for k in (1.0, 4.0)
    )
    exact = run(example().program, example().givens).values

    for name in quantities:
        near, far = (np.sqrt(np.mean(np.abs(board.values[name] - exact[name]) ** 2)) for board in (large, small))
        assert far / near == pytest.approx(4.0, rel=1e-2), name


def test_an_error_of_direction_is_the_same_at_every_scale() -> None:
    hand = Hand(0.0, 0.3, 0.0)
    large, small = (
        draw(replace(example(), mus={plan: mu * k for plan, mu in example().mus.items()}), hand, generator(), 50)
        for k in (1.0, 10.0)
    )

    assert large.values["R_12"] == pytest.approx(small.values["R_12"], rel=1e-12)


# What it says.


@pytest.mark.parametrize("task", [*SAMPLE, *MORE])
def test_spread_of_small_errors_is_that_of_single_errors_together(task: str) -> None:
    hand = preset("careful").hand.times(0.05)
    alone, together = sensitivities(paper(task), hand), drawn(paper(task), hand, generator(), 4000)

    compared = 0
    for name, spread in together.spreads().items():
        exact, missed = alone.exact[name], alone.misses[name]
        # the size of what is all error, a vector or an arm, is not linear in it
        size = isinstance(exact, complex) or name.startswith("h_")
        if spread.exact is not None and not (size and abs(spread.exact) < 20.0 * spread.miss):
            rounding = 1e-11 * abs(spread.exact)
            assert spread.deviation == pytest.approx(alone.deviation(name), rel=0.05, abs=rounding), name
            compared += 1
        if isinstance(exact, complex):  # what a vector misses, direction and all, is linear also there
            found = math.sqrt(np.mean(np.abs(together[name] - exact) ** 2))
            expected = math.sqrt(np.sum(np.abs(missed) ** 2))
            assert found == pytest.approx(expected, rel=0.05, abs=1e-11 * abs(exact)), name
    assert compared > 0.7 * len(together.spreads())


def test_the_tasks_hold_every_kind_of_group_and_of_plan() -> None:
    solved = [solution_of(task).solved for task in bundled("mechanism")]

    kinds = {group.kind for one in solved for group in one.structure.groups}
    assert kinds == {"RRR", "RRP", "RPR", "PRP", "RPP", "III"}
    assert sum("lever" in one.program.plans for one in solved) > 20
    assert {type(one.mechanism.driver).__name__ for one in solved} == {"Driver", "SlidingDriver"}


def test_step_that_errs_alone_makes_its_part_of_the_error() -> None:
    hand, names = preset("careful").hand, ("V_B", "omega_2", "a_B", "R_12", "M_bal")
    exact = run(example().program, example().givens).values
    found = sensitivities(example(), hand, names)

    for name in names:
        parts = found.parts(name)
        assert sum(parts.values()) == pytest.approx(1.0)
        assert list(parts.values()) == sorted(parts.values(), reverse=True)
        step, part = next(iter(parts.items()))
        alone = draw(example(), hand, generator(), 5000, (step,)).values[name]
        whole = np.sum(np.abs(found.misses[name]) ** 2)
        assert np.mean(np.abs(alone - exact[name]) ** 2) == pytest.approx(part * whole, rel=0.08)


def test_no_step_contributes_to_what_does_not_hang_on_it() -> None:
    found = sensitivities(example(), preset("normal").hand, ("B", "V_B", "omega_1"))

    assert set(found.parts("B")) == {"e_OA", "A", "B"}
    assert not any(step.startswith(("acceleration", "forces")) for step in found.parts("V_B"))
    assert found.parts("omega_1") == {}


def test_an_interval_holds_its_share_of_other_drawings() -> None:
    hand = preset("normal").hand
    found = drawn(example(), hand, generator(), 2000).spreads(0.9)
    others = drawn(example(), hand, np.random.default_rng(7), 2000)

    for name in ("V_B", "a_B", "epsilon_2", "R_12", "M_bal"):
        values = others[name]
        sizes = np.abs(values) if np.iscomplexobj(values) else values
        low, high = found[name].low, found[name].high
        assert low is not None
        assert high is not None
        assert np.mean((sizes >= low) & (sizes <= high)) == pytest.approx(0.9, abs=0.03)
        assert low < (found[name].exact or 0.0) < high


# Monte-Carlo of a slider-crank, lambda = 0.27, 12 positions, values above 30 % of the largest: median and 95 % of
# errors in per cent, of another program with a model of its own; pa in mm. Ours err alike, to a factor of two or so.
HONEST = {
    "careful": (100.0, {"V_B": (0.3, 1.7), "omega_2": (0.2, 1.1), "a_B": (0.4, 1.7), "delta": (0.4, 1.8)}),
    "normal": (80.0, {"V_B": (0.8, 3.8), "omega_2": (0.6, 2.4), "a_B": (0.9, 3.8), "delta": (1.1, 4.0)}),
    "lenient": (50.0, {"V_B": (2.1, 9.4), "omega_2": (1.6, 5.9), "a_B": (2.5, 9.5), "delta": (3.1, 10.4)}),
}


def honest_errors(hand: Hand, pa: float) -> dict[str, tuple[float, float]]:
    """Return median and 95 % of the errors of large values over a turn, per cent."""
    errors: dict[str, list[Array]] = {name: [] for name in ("V_B", "omega_2", "a_B", "delta")}
    sizes: dict[str, list[float]] = {name: [] for name in errors}
    for k in range(12):
        solution = solve("nau-slider-crank", "example", set={"phi": f"{30 * k} deg", "l_OA": "35.1 mm", "n_1": 191})
        solved = solution.solved
        mus = {symbol: scale.mu for symbol, scale in solution.scales.items()}
        mus |= {"mu_V": solved.size("V_A") / pa, "mu_a": solved.size("a_A") / pa, "mu_l": 0.0351 / (0.4 * pa)}
        found = drawn(paper_of(solved, mus), hand, np.random.default_rng(k), 200)
        for name in ("V_B", "omega_2", "a_B"):
            errors[name].append(np.abs(np.abs(found[name]) - solved.size(name)))
            sizes[name].append(solved.size(name))
        errors["delta"].append(np.abs(found["M_bal_lever"] - found["M_bal"]))
        sizes["delta"].append(abs(solved.values["M_bal"]))
    out = {}
    for name, own in sizes.items():
        far = [e / size * 100.0 for e, size in zip(errors[name], own, strict=True) if size > 0.3 * max(own)]
        median, most = np.quantile(np.concatenate(far), (0.5, 0.95))
        out[name] = (float(median), float(most))
    return out


@pytest.mark.parametrize("name", HONEST)
def test_presets_err_like_honest_drawings(name: str) -> None:
    pa, expected = HONEST[name]

    found = honest_errors(PRESETS[name].hand, pa)

    for quantity, (median, most) in expected.items():
        assert 0.5 < found[quantity][0] / median < 2.5, (quantity, found[quantity])
        assert 0.5 < found[quantity][1] / most < 2.5, (quantity, found[quantity])
