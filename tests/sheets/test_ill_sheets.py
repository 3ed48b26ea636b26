"""A sheet of an ill-conditioned position says so, on the plans and in its warnings: where, and how much errors grow."""

from __future__ import annotations

import html
import re

import pytest

from kulman import sheet, solve
from kulman.drawing.words import Words
from kulman.plans.board import POINTS
from kulman.plans.linkages.solved import conditions_of, worst_condition
from kulman.plans.quantities import plans_of
from kulman.scales.errors import LANGUAGES
from kulman.tests.support.printed_numbers import decimal

PLANS = ("structure", "position", "velocity")
POSITIONS = {
    "nau-slider-crank": ({"phi": 90, "l_OA": 50, "l_AB": "50.00001", "l_AS2": 60}, "B"),
    "madi-four-bar": ({"phi": 180, "l_AB": 120, "l_BC": "390.00001", "l_DC": 240}, "C"),
    "scheme-09-shaper": ({"phi": 90, "l_DE": "20.00001"}, "E"),
    "scheme-18-hydraulic-drive": ({"s": "100.00001", "l_AB": 270, "l_CB": 230, "x_C": 500, "y_C": -300}, "B"),
}


def texts(task: str, language: str, **settings: str | float) -> list[str]:
    """Return the lines of text of a sheet, letters with their indices."""
    drawn = sheet(task, set=settings, only=PLANS, lang=language)
    pages = "".join(drawn.svg(number) for number in range(1, len(drawn.pages) + 1))
    return [
        html.unescape(re.sub("<[^>]+>", "", text)) for text in re.findall(r"<text[^>]*>.*?</text>", pages, re.DOTALL)
    ]


def beginning(language: str, key: str) -> str:
    return Words.of(language, "nau")[key].partition("{")[0]


@pytest.mark.parametrize(
    ("task", "language"),
    [
        pytest.param(task, language, marks=[pytest.mark.soak] * (i % 4 != 0))
        for i, (task, language) in enumerate((task, language) for task in POSITIONS for language in LANGUAGES)
    ],
)
def test_plans_of_an_ill_conditioned_position_say_so(task: str, language: str) -> None:
    settings, _ = POSITIONS[task]
    growth = beginning(language, "said.ill_growth")

    lines, usual = texts(task, language, **settings), texts(task, language)

    assert not any(line.startswith(beginning(language, "said.ill_position")) for line in usual)
    assert sum(line.startswith(beginning(language, "said.ill_position")) for line in lines) == 2
    assert sum(line.startswith(growth) and "K = " in line for line in lines) == 2


@pytest.mark.parametrize("task", POSITIONS)
def test_warnings_name_the_point_the_angle_and_the_condition(task: str) -> None:
    settings, point = POSITIONS[task]
    solution = solve(task, set=settings)

    (warning,) = solution.warnings

    assert solution.status == "ill-conditioned"
    assert (warning.key, warning.data["point"]) == ("ill-conditioned", point)
    worst = max(item.value or 0.0 for item in conditions_of(solution.solved).values())
    assert float(warning.data["condition"]) == pytest.approx(worst, rel=0.05)
    assert solution.solved.worst_sine()[1] == pytest.approx(1.0 / float(warning.data["loss"]), rel=0.05)
    for language in LANGUAGES:
        assert decimal(str(warning.data["angle"]), language) in warning.text(language)


def test_an_angle_that_is_only_small_is_warned_of_without_a_condition() -> None:
    (warning,) = solve("nau-slider-crank", set={"phi": 90, "l_OA": 50, "l_AB": 51}).warnings

    assert warning.key == "small-angle"
    assert float(warning.data["loss"]) == pytest.approx(5.07, rel=0.01)


def test_the_worst_condition_is_that_of_the_plan_that_shows_it() -> None:
    solved = solve("madi-four-bar").solved

    name, value = worst_condition(solved, "velocity")

    shown = [step.name for step in solved.program if plans_of(solved.program).get(step.name) == "velocity"]
    assert name in shown
    assert value == max(conditions_of(solved)[one].value or 0.0 for one in shown if one in conditions_of(solved))
    points = {step.name for step in solved.program if step.verb in POINTS}
    assert worst_condition(solved, "position")[0] in points | {"h_1", "h_2", "h_3", "h_21"}


def test_joints_that_nearly_coincide_are_named() -> None:
    settings = {"l_OC": 150, "phi": "270.02", "l_DE": 500}
    (warning,) = solve("scheme-09-shaper", set=settings).warnings

    lines = texts("scheme-09-shaper", "en", **settings)

    assert (warning.key, warning.data["first"], warning.data["second"]) == ("ill-conditioned-pins", "C", "A")
    assert sum(line.startswith("Ill-conditioned position: the joints C and A nearly coincide") for line in lines) == 1
