"""What a teacher lets pass: the rule of millimetres, parts and sines, and how many honest hands it fails."""

from __future__ import annotations

import math

import numpy as np
import pytest

from kulman import solve
from kulman.plans.hands.shaky import PRESETS, Hand, Paper, Tolerance, paper_of, preset
from kulman.plans.hands.spread import drawn
from kulman.plans.marking.key import tolerances
from kulman.scales.errors import InputError
from kulman.tests.support.mechanisms import SEED
from kulman.variants.solution import Solution


def paper(solution: Solution) -> Paper:
    """Return the drawing of a solution to its own scales."""
    return paper_of(solution.solved, {symbol: scale.mu for symbol, scale in solution.scales.items()})


@pytest.mark.parametrize("phi", [20, 60, 130, 250])
@pytest.mark.parametrize("name", ["cad", "careful", "normal"])
def test_a_tolerance_fails_few_hands_of_its_own(name: str, phi: int) -> None:
    found = PRESETS[name]
    solution = solve("nau-slider-crank", "example", set={"phi": f"{phi} deg"}, scales={"pa": found.pa or 80.0})
    drawing = paper(solution)

    allowed = tolerances(drawing, solution.solved.values, solution.solved.sines, found.tolerance)
    shares = drawn(drawing, found.hand, np.random.default_rng(SEED)).failing(allowed)

    assert np.mean(list(shares.values())) < 0.05
    assert np.median(list(shares.values())) < 0.01


def test_links_short_on_paper_tilt_what_is_drawn_across_them() -> None:
    solution = solve("nau-slider-crank", "example", scales={"mu_l": 0.01, "pa": 80.0})  # a rod of 18 mm
    drawing, found = paper(solution), preset("normal")

    allowed = tolerances(drawing, solution.solved.values, solution.solved.sines, found.tolerance)
    shares = drawn(drawing, found.hand, np.random.default_rng(SEED)).failing(allowed)

    assert max(shares[name] for name in ("V_B", "V_BA", "omega_2", "a_B")) < 0.05  # else up to a fifth


def test_tolerance_of_a_segment_is_millimetres_or_a_part_over_the_sine() -> None:
    most = Tolerance(2.0, 0.05, 1.0)

    assert most.of_segment(10.0) == 2.0
    assert most.of_segment(-80.0) == 4.0
    assert most.of_segment(80.0, math.sin(math.radians(30.0))) == pytest.approx(8.0)


@pytest.mark.parametrize("variant", ["2", "3", "7"])
def test_an_arm_about_the_point_where_two_lines_cross_misses_as_that_point_does(variant: str) -> None:
    solution = solve("scheme-20-press-automaton", variant)
    drawing, found = paper(solution), preset("normal")

    allowed = tolerances(drawing, solution.solved.values, solution.solved.sines, found.tolerance)
    shares = drawn(drawing, found.hand, np.random.default_rng(SEED)).failing(allowed)

    arms = [name for name in shares if name.startswith("h_") and name.endswith("_X3")]
    assert len(arms) > 5
    assert max(shares[name] for name in arms) < 0.1


def test_calculated_quantities_inherit_the_tolerance_of_the_segments() -> None:
    solution = solve("nau-slider-crank", "example")
    drawing, values = paper(solution), solution.solved.values

    allowed = tolerances(drawing, values, solution.solved.sines, preset("normal").tolerance)

    assert allowed["omega_2"] == pytest.approx(allowed["V_BA"] / values["l_AB"], rel=1e-9)
    assert allowed["F_i3"] == pytest.approx(allowed["a_B"] * values["m_3"], rel=1e-9)
    assert allowed["omega_1"] == 0.0
    least = 2.0 * drawing.mus["velocity"]
    assert allowed["V_B"] >= least


def test_a_wrong_hand_is_refused() -> None:
    with pytest.raises(InputError, match="'normel'; did you mean 'normal'"):
        preset("normel")
    with pytest.raises(InputError, match="negative"):
        Hand(-0.1, 0.0, 0.0)


def test_what_is_undefined_is_not_marked() -> None:
    solution = solve("scheme-19-scotch-yoke")
    drawing = paper(solution)
    allowed = tolerances(drawing, solution.solved.values, solution.solved.sines, preset("normal").tolerance)

    shares = drawn(drawing, preset("normal").hand, np.random.default_rng(SEED), 50).failing(allowed)

    assert solution["h_03"].value is None
    assert shares["h_03"] == 0.0
