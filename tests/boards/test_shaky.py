"""The shaky hand: nothing at zero, linear while small, worse by 1/sin and by the scale, as bad as honest drawings.

And what a teacher lets pass: the rule of millimetres, parts and sines, and how many honest hands it fails.
"""

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
from kulman.plans.boards.batch import batch
from kulman.plans.boards.exact import run
from kulman.plans.hands.shaky import PRESETS, Hand, Paper, Tolerance, draw, paper_of, preset
from kulman.plans.hands.spread import _sensitivities, drawn
from kulman.plans.linkages.chain import construct
from kulman.plans.linkages.solved import board_givens
from kulman.plans.marking.key import tolerances
from kulman.plans.quantities import results
from kulman.tests.support.dyads import random_dyads, random_triads
from kulman.tests.support.linkages import PRESS, PRESS_VALUES
from kulman.tests.support.mechanisms import SEED, nau_slider_crank, nau_values
from kulman.variants.shelf import bundled
from kulman.variants.solution import Solution

Array = NDArray[Any]
STEADY, SMALL = Hand(0.0, 0.0, 0.0), Hand(1e-6, 1e-5, 1e-6)
# between them all kinds of dyads, a triad, compound motion, both drivers, force plans and levers
SAMPLE = ("nau-slider-crank", "madi-four-bar", "scheme-09-shaper", "scheme-20-press-automaton")
MORE = [pytest.param(task, marks=pytest.mark.soak) for task in bundled("mechanism") if task not in SAMPLE]


def generator(seed: int = SEED) -> np.random.Generator:
    return np.random.default_rng(seed)


@cache
def solution_of(task: str, variant: str | None = None) -> Solution:
    return solve(task, variant)


def on_paper(solution: Solution) -> Paper:
    """Return the drawing of a solution to its own scales."""
    return paper_of(solution.solved, {symbol: scale.mu for symbol, scale in solution.scales.items()})


def example() -> Paper:
    return on_paper(solution_of("nau-slider-crank", "example"))


def same_bits(first: Any, second: Any) -> bool:
    return (np.asarray(first) + 0.0).tobytes() == (np.asarray(second) + 0.0).tobytes()


# Nothing at zero, in proportion while small.
@pytest.mark.parametrize("task", [*SAMPLE, *MORE])
def test_a_hand_without_errors_draws_the_exact_plan_to_the_last_bit(task: str) -> None:
    drawing = on_paper(solution_of(task))
    exact = run(drawing.program, drawing.givens).values

    board = draw(drawing, STEADY, generator(), 3)

    assert [name for name in drawing.program.names if not same_bits(board.values[name], exact[name])] == []
    assert board.missed == set()


GROUPS: dict[str, tuple[str, tuple[int, ...], tuple[bool, ...]]] = {
    **{"RRR": ("RRR", (1, 2), ()), "RRP": ("RRP", (2, 3), (True,)), "RPR": ("RPR", (2, 3), (False,))},
    **{"PRP": ("PRP", (1, 2), (True, False)), "RPP": ("RPP", (3, 1), (True, True))},
    **{"RRR legs": ("RRR", (1, 2, 3), ()), "a leg that slides": ("RPR", (1, 0, 3), ())},
    "a leg with a guide": ("GRR", (2, 0, 1), ()),
}


@pytest.mark.parametrize("count", [20, pytest.param(400, marks=pytest.mark.soak)])
@pytest.mark.parametrize("group", GROUPS)
def test_groups_of_every_kind_are_exact_without_errors_and_small_ones_come_through_in_proportion(
    group: str, count: int
) -> None:
    """Twice the errors of every act, the same ones, make twice the misses of what all of them come to."""
    kind, before, carries = GROUPS[group]
    if len(before) == 3:
        mechanism, values, _ = random_triads(kind, before, SEED, count)
    else:
        mechanism, values, _ = random_dyads(kind, before, carries, SEED, count)  # type: ignore[arg-type]
    _, program = construct(mechanism)
    paper = Paper(program, board_givens(mechanism, values, program), dict.fromkeys(program.plans, 1.0))
    expected, codes = batch(program, paper.givens, program.names)

    steady = draw(paper, STEADY, generator(), len(codes))
    one, two = (draw(paper, SMALL.times(factor), generator(), count).values for factor in (1.0, 2.0))

    assert np.array_equal(steady.codes, codes)
    assert steady.missed == set()
    for name in program.names:
        assert same_bits(np.broadcast_to(steady.values[name], codes.shape), expected[name]), name
    for name in [name for name in program.names if name.startswith(("V_", "a_", "R_", "M_bal", "F_bal"))]:
        exact = expected[name]
        first, second = one[name] - exact, two[name] - exact
        noise = 1e-9 * (np.abs(exact) + np.max(np.abs(exact)) * 1e-3)
        bent = np.abs(second - 2.0 * first) / np.maximum(np.abs(first), noise)
        assert np.median(bent) < 1e-2, name
        assert np.mean(bent < 0.05) > 0.9, name


def test_the_same_seed_draws_the_same_and_spread_is_linear_in_small_errors() -> None:
    hand, small = preset("normal").hand, preset("careful").hand.times(0.01)
    first, second, other = (draw(example(), hand, generator(s), 50).values["R_12"] for s in (SEED, SEED, SEED + 1))
    once, thrice = (drawn(example(), small.times(factor), generator(), 2000).spreads() for factor in (1.0, 3.0))

    assert same_bits(first, second)
    assert not np.any(first == other)
    for name, spread in once.items():
        if spread.deviation > 0.0 and not name.startswith("delta"):
            assert thrice[name].deviation == pytest.approx(3.0 * spread.deviation, rel=0.02), name


# What errs and what does not.
def test_data_and_what_follows_from_them_alone_stay_exact() -> None:
    board = draw(example(), preset("normal").hand, generator(), 20)

    assert {"omega_1", "_V_A", "_a_A", "u_30", "O", "F_3", "e_F_3"}.isdisjoint(board.missed)
    assert {"A", "B", "V_B", "omega_2", "R_12", "M_bal", "h_2"} <= board.missed


def test_what_is_read_is_what_later_steps_start_from() -> None:
    values = draw(example(), Hand(0.0, 0.0, 0.5), generator(), 200, only=("V_BA",)).values

    exact = run(example().program, example().givens).values
    along = values["V_BA"].real * values["n_AB"].real + values["V_BA"].imag * values["n_AB"].imag
    assert np.all(values["V_BA"] != exact["V_BA"])
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
    drawing = on_paper(solve("nau-slider-crank", "example", scales={"pa": 80, "mu_l": 0.0005}))
    plan = next(step.plan for step in drawing.program if step.name == name)

    values = draw(drawing, hand, generator(), 20_000, ("e_OA",) if name == "A" else (name,)).values[name]

    miss = np.abs(values - run(drawing.program, drawing.givens).values[name]) / drawing.mus[plan]
    assert math.sqrt(np.mean(miss**2)) == pytest.approx(expected, rel=0.03)


def test_legs_of_a_template_are_as_wrong_as_the_dividers_that_lay_them_off() -> None:
    _, program = construct(PRESS, ("position",))
    drawing = Paper(program, board_givens(PRESS, PRESS_VALUES, program), {"position": 0.005})

    values = draw(drawing, Hand(0.1, 0.0, 0.0), generator(), 4000).values

    for start, end in ("EC", "FD"):
        missed = (np.abs(values[end] - values[start]) - PRESS_VALUES[f"l_{start}{end}"]) / 0.005
        # the radius misses, and the mark that is read
        assert math.sqrt(np.mean(missed**2)) == pytest.approx(0.1 * math.sqrt(2.0), rel=0.05), end


def test_drawings_that_fail_are_counted() -> None:
    # the rod is a hair longer than the way from A to the guide: half of all hands cannot reach it
    values = nau_values(l_OA=0.1, phi=math.pi / 2.0, l_AB=0.1 * (1.0 + 1e-9))
    _, program = construct(nau_slider_crank(), ("velocity",))
    drawing = Paper(program, board_givens(nau_slider_crank(), values), {"position": 0.001, "velocity": 0.05})

    found = drawn(drawing, preset("normal").hand, generator(), 4000)

    assert found.spreads()["B"].undrawn == pytest.approx(0.5, abs=0.05)
    assert math.isnan(found.spreads()["B"].miss)
    assert found.spreads(0.4)["B"].miss > 0.0
    assert found.spreads()["A"].undrawn == 0.0
    assert np.mean(found.board.codes == 3) == found.spreads()["B"].undrawn
    assert found.failing(dict.fromkeys((step.name for step in results(program)), 1e9))["B"] > 0.4


# Laws.
@pytest.mark.parametrize("angle", [0.3, 0.1, 0.03])
def test_spread_grows_like_one_over_the_sine_of_an_intersection(angle: float) -> None:
    meet = next(s for s in example().program.steps if s.name == "velocity.B")
    way = complex(math.cos(angle), math.sin(angle))
    givens = dict(zip(meet.operands, (-0.1 + 0j, 1 + 0j, -0.1 * way, way), strict=True))

    values = draw(
        Paper(Program((meet,)), givens, {"velocity": 0.001}), Hand(0.01, 0.0, 0.0), generator(), 20_000
    ).values

    # each line lies 0.01 mm aside with its own error: together sqrt(2) / sin gamma
    missing = float(np.sqrt(np.mean(np.abs(values["velocity.B"]) ** 2)))
    assert missing * 1e3 == pytest.approx(0.01 * math.sqrt(2.0) / math.sin(angle), rel=0.03)


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
    ("plan", "quantities"),
    [("velocity", ("V_A", "V_B", "V_S2", "V_BA")), ("acceleration", ("a_B", "a_S2", "a_BA_t"))],
)
def test_a_smaller_scale_is_worse_in_proportion_but_for_directions(plan: str, quantities: Iterable[str]) -> None:
    steps = tuple(step.name for step in example().program.on(plan))  # what is made on this plan alone errs
    mus, exact = example().mus, run(example().program, example().givens).values
    small = replace(example(), mus={**mus, plan: mus[plan] * 4.0})
    tiny = replace(example(), mus={plan: mu * 10.0 for plan, mu in mus.items()})

    lengths = [draw(paper, Hand(0.01, 0.0, 0.01), generator(), 500, steps).values for paper in (example(), small)]
    turned = [draw(paper, Hand(0.0, 0.3, 0.0), generator(), 50).values["R_12"] for paper in (example(), tiny)]

    for name in quantities:
        near, far = (np.sqrt(np.mean(np.abs(values[name] - exact[name]) ** 2)) for values in lengths)
        assert far / near == pytest.approx(4.0, rel=1e-2), name
    assert turned[0] == pytest.approx(turned[1], rel=1e-12)


# What it says.
@pytest.mark.parametrize("task", [*SAMPLE, *MORE])
def test_spread_of_small_errors_is_that_of_single_errors_together(task: str) -> None:
    hand, paper = preset("careful").hand.times(0.05), on_paper(solution_of(task))
    alone, together = _sensitivities(paper, hand), drawn(paper, hand, generator(), 4000)

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


def test_step_that_errs_alone_makes_its_part_of_the_error_of_what_hangs_on_it() -> None:
    hand, names = preset("careful").hand, ("V_B", "omega_2", "a_B", "R_12", "M_bal")
    exact = run(example().program, example().givens).values

    found = _sensitivities(example(), hand, (*names, "B", "omega_1"))

    for name in names:
        parts = found.parts(name)
        assert sum(parts.values()) == pytest.approx(1.0)
        assert list(parts.values()) == sorted(parts.values(), reverse=True)
        step, part = next(iter(parts.items()))
        alone = draw(example(), hand, generator(), 5000, (step,)).values[name]
        whole = np.sum(np.abs(found.misses[name]) ** 2)
        assert np.mean(np.abs(alone - exact[name]) ** 2) == pytest.approx(part * whole, rel=0.08)
    assert set(found.parts("B")) == {"e_OA", "A", "B"}
    assert not any(step.startswith(("acceleration", "forces")) for step in found.parts("V_B"))
    assert found.parts("omega_1") == {}


def test_an_interval_holds_its_share_of_other_drawings() -> None:
    hand = preset("normal").hand

    found = drawn(example(), hand, generator(), 2000).spreads(0.9)
    others = drawn(example(), hand, generator(7), 2000)

    for name in ("V_B", "a_B", "epsilon_2", "R_12", "M_bal"):
        values, low, high = others[name], found[name].low, found[name].high
        sizes = np.abs(values) if np.iscomplexobj(values) else values
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
    errors: dict[str, list[tuple[float, Array]]] = {name: [] for name in ("V_B", "omega_2", "a_B", "delta")}
    for k in range(12):
        solution = solve("nau-slider-crank", "example", set={"phi": f"{30 * k} deg", "l_OA": "35.1 mm", "n_1": 191})
        solved = solution.solved
        mus = {symbol: scale.mu for symbol, scale in solution.scales.items()}
        mus |= {"mu_V": solved.size("V_A") / pa, "mu_a": solved.size("a_A") / pa, "mu_l": 0.0351 / (0.4 * pa)}
        found = drawn(paper_of(solved, mus), hand, generator(k), 200)
        for name in ("V_B", "omega_2", "a_B"):
            errors[name].append((solved.size(name), np.abs(np.abs(found[name]) - solved.size(name))))
        errors["delta"].append((abs(solved.values["M_bal"]), np.abs(found["M_bal_lever"] - found["M_bal"])))
    out = {}
    for name, missed in errors.items():
        largest = max(size for size, _ in missed)
        far = [error / size * 100.0 for size, error in missed if size > 0.3 * largest]
        median, most = np.quantile(np.concatenate(far), (0.5, 0.95))
        out[name] = (float(median), float(most))
    return out


@pytest.mark.parametrize("name", HONEST)
def test_presets_err_like_honest_drawings(name: str) -> None:
    pa, expected = HONEST[name]

    found = honest_errors(PRESETS[name].hand, pa)

    assert PRESETS[name].pa == pa
    for quantity, (median, most) in expected.items():
        assert 0.5 < found[quantity][0] / median < 2.5, (quantity, found[quantity])
        assert 0.5 < found[quantity][1] / most < 2.5, (quantity, found[quantity])


# What a teacher lets pass.
def allowed(solution: Solution, tolerance: Tolerance) -> dict[str, float]:
    return dict(tolerances(on_paper(solution), solution.solved.values, solution.solved.sines, tolerance))


def failing(solution: Solution, name: str) -> dict[str, float]:
    """Return the share of a preset's own hands that fail by its tolerance, by quantity."""
    found = drawn(on_paper(solution), PRESETS[name].hand, generator())
    return dict(found.failing(allowed(solution, PRESETS[name].tolerance)))


@pytest.mark.parametrize("phi", [20, 250])
@pytest.mark.parametrize("name", ["cad", "careful", "normal"])
def test_a_tolerance_fails_few_hands_of_its_own(name: str, phi: int) -> None:
    pa = PRESETS[name].pa or 80.0

    shares = failing(solve("nau-slider-crank", "example", set={"phi": f"{phi} deg"}, scales={"pa": pa}), name)

    assert np.mean(list(shares.values())) < 0.05
    assert np.median(list(shares.values())) < 0.01


def test_what_is_short_or_crosses_flatly_is_allowed_more() -> None:
    short = failing(solve("nau-slider-crank", "example", scales={"mu_l": 0.01, "pa": 80.0}), "normal")  # a rod of 18 mm
    assert max(short[name] for name in ("V_B", "V_BA", "omega_2", "a_B")) < 0.05  # else up to a fifth

    for variant in ("2", "3", "7"):  # an arm about the point where two lines cross misses as that point does
        shares = failing(solve("scheme-20-press-automaton", variant), "normal")
        arms = [name for name in shares if name.startswith("h_") and name.endswith("_X3")]
        assert len(arms) > 5
        assert max(shares[name] for name in arms) < 0.1


def test_tolerance_of_a_segment_is_millimetres_or_a_part_over_the_sine_and_is_inherited() -> None:
    most, solution = Tolerance(2.0, 0.05, 1.0), solution_of("nau-slider-crank", "example")
    values, yoke = solution.solved.values, solution_of("scheme-19-scotch-yoke")

    found = allowed(solution, preset("normal").tolerance)

    assert (most.of_segment(10.0), most.of_segment(-80.0)) == (2.0, 4.0)
    assert most.of_segment(80.0, math.sin(math.radians(30.0))) == pytest.approx(8.0)
    assert found["omega_2"] == pytest.approx(found["V_BA"] / values["l_AB"], rel=1e-9)
    assert found["F_i3"] == pytest.approx(found["a_B"] * values["m_3"], rel=1e-9)
    assert found["omega_1"] == 0.0
    assert found["V_B"] >= 2.0 * example().mus["velocity"]
    assert yoke["h_03"].value is None
    assert failing(yoke, "normal")["h_03"] == 0.0  # what is undefined is not marked
