"""Kulman from Python: what is shown, what can be asked, and wrong arguments answered in one line of our own."""

from __future__ import annotations

import datetime
import json
import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import kulman
from kulman import KulmanError
from kulman.scales.errors import LANGUAGES
from kulman.variants.solution import Solution

TASK = "nau-slider-crank"
# what `solve`, `sheet` and `sweep` refuse: arguments, and the key of the message
WRONG: dict[str, tuple[dict[str, Any], str]] = {
    "no task": ({"task": None}, "argument-type"),
    "task of bytes": ({"task": b"nau-slider-crank"}, "argument-type"),
    "tasks in a list": ({"task": [TASK]}, "argument-type"),
    "unknown task": ({"task": "nau-slider-crnk"}, "task-unknown-like"),
    "missing file": ({"task": Path("none.toml")}, "file-missing"),
    "unknown variant": ({"variant": "11"}, "variant-unknown"),
    "negative variant": ({"variant": -1}, "variant-unknown"),
    "variant of no kind": ({"variant": ["3"]}, "argument-type"),
    "set as a list": ({"set": ["l_OA=3"]}, "argument-type"),
    "set as a text": ({"set": "l_OA=3"}, "argument-type"),
    "set by a number": ({"set": {1: 3}}, "argument-type"),
    "set of an unknown given": ({"set": {"l_XX": 3}}, "given-unknown"),
    "set to nan": ({"set": {"l_OA": float("nan")}}, "number-bad"),
    "set to infinity": ({"set": {"l_OA": float("inf")}}, "number-infinite"),
    "set below zero": ({"set": {"l_OA": -1}}, "not-positive"),
    "set to None": ({"set": {"l_OA": None}}, "type-quantity"),
    "set to an array": ({"set": {"l_OA": np.array([40.0, 50.0])}}, "type-quantity"),
    "set to no choice": ({"set": {"rotation": 3}}, "choice-unknown"),
    "scale of a text": ({"scales": {"pa": "abc"}}, "number-bad"),
    "scale of None": ({"scales": {"pa": None}}, "number-bad"),
    "scale below zero": ({"scales": {"mu_V": -1}}, "scale-not-positive"),
    "scale of an unknown segment": ({"scales": {"pz": 80}}, "scale-segment"),
    "scale of an unknown symbol": ({"scales": {"mu_F_9": 80}}, "scale-unknown-like"),
    "scale of a plan not drawn": ({"scales": {"mu_a": 80}, "only": "velocity"}, "scale-not-drawn"),
    "scale by a number": ({"scales": {1: 80}}, "argument-type"),
    "scales as a text": ({"scales": "pa=80"}, "argument-type"),
    "unknown plan": ({"only": ["nonsense"]}, "plan-unknown"),
    "plan of None": ({"only": [None]}, "argument-type"),
    "plans as a number": ({"only": 3}, "argument-type"),
    "unknown language": ({"lang": "de"}, "language"),
    "language of no kind": ({"lang": ["uk"]}, "language"),
    "unknown notation": ({"notation": "x"}, "notation-unknown"),
    "empty notation": ({"notation": ""}, "notation-unknown"),
    "notation of no kind": ({"notation": 3}, "notation-unknown"),
}
WRONG_SHEET: dict[str, tuple[dict[str, Any], str]] = {
    "unknown format": ({"format": "A9"}, "format-unknown"),
    "empty format": ({"format": ""}, "format-unknown"),
    "format of no kind": ({"format": 3}, "format-unknown"),
    "unknown norm": ({"norm": "din"}, "norm-unknown"),
    "norm of no kind": ({"norm": None}, "norm-unknown"),
    "no language": ({"lang": None}, "language"),
    "student of no kind": ({"student": None}, "argument-type"),
    "date of no kind": ({"date": datetime.date(2026, 1, 2)}, "argument-type"),
    "name too long": ({"student": "щ" * 500}, "stamp-too-long"),
    "character of no font": ({"student": "😀"}, "character-missing"),
}


@pytest.fixture(scope="module")
def solution() -> Solution:
    return kulman.solve(TASK, "3")


@pytest.mark.parametrize("name", WRONG)
@pytest.mark.parametrize("verb", ["solve", "sheet", "sweep"])
def test_a_wrong_argument_is_answered_in_one_line(verb: str, name: str) -> None:
    arguments, key = WRONG[name]

    with pytest.raises(KulmanError) as caught:
        getattr(kulman, verb)(**{"task": TASK, **arguments})

    assert caught.value.key == key
    assert all(caught.value.text(language).isprintable() for language in LANGUAGES)


@pytest.mark.parametrize("name", WRONG_SHEET)
def test_a_wrong_argument_of_a_sheet_is_answered_in_one_line(name: str) -> None:
    arguments, key = WRONG_SHEET[name]

    with pytest.raises(KulmanError) as caught:
        kulman.sheet(TASK, **arguments)

    assert caught.value.key == key
    assert all(caught.value.text(language).isprintable() for language in LANGUAGES)


@pytest.mark.parametrize("value", [40, 40.0, "40", "4 cm", np.float64(40), np.int64(40), np.float32(40)])
def test_a_given_is_any_real_number_or_a_text_with_a_unit(value: Any) -> None:
    assert kulman.solve(TASK, set={"l_OA": value})["l_OA"].value == pytest.approx(0.04, rel=1e-15)


@pytest.mark.parametrize(
    "only", ["velocity,lever", ["velocity", "lever"], ("velocity,lever",), iter(["velocity", "lever"])]
)
def test_plans_are_named_one_by_one_or_with_commas(only: Any) -> None:
    drawn = kulman.sheet(TASK, only=only)

    views = [shape.name for page in drawn.pages for shape in page.shapes if getattr(shape, "role", "") == "view"]
    assert {"velocity", "lever"} <= set(views)
    assert "forces_23" not in views


def test_a_variant_may_be_a_number() -> None:
    assert kulman.solve(TASK, 3).variant == "3"  # type: ignore[arg-type]


def test_a_task_that_has_been_read_is_taken_as_it_is() -> None:
    task = kulman.load_task(TASK)

    assert kulman.solve(task, "3").quantities == kulman.solve(TASK, "3").quantities


def test_a_solution_is_asked_by_the_names_of_its_quantities(solution: Solution) -> None:
    assert "V_B" in solution
    assert "V_Q" not in solution
    assert None not in solution
    assert list(solution) == list(solution.quantities)
    assert len(solution) == len(solution.quantities)
    for name in ("V_Q", None, 3):
        with pytest.raises(KulmanError):
            solution[name]  # type: ignore[index]


def test_the_checks_of_a_solution_are_those_of_its_json(solution: Solution) -> None:
    assert solution.checks["lever"]["ok"]
    assert solution.to_json()["checks"] == solution.checks
    assert kulman.solve(TASK, only="velocity").checks == {}


def test_solution_and_sheet_are_short_on_a_python_prompt(solution: Solution) -> None:
    assert repr(solution) == f"<Solution {TASK} 3: ok, {len(solution)} quantities>"
    assert repr(kulman.sheet(TASK, only="velocity", lang="en")) == (
        "<Sheet 'Slider-crank: kinematic and force analysis': A4, pages: 1>"
    )


def test_a_notebook_shows_a_solution_as_its_table(solution: Solution) -> None:
    apart = kulman.solve(TASK, set={"l_AB": 20, "phi": 90}, lang="uk")

    assert solution.table() in solution._repr_html_()
    assert apart.status == "no-assembly"
    assert apart.reason is not None
    assert apart.reason.text("uk") in apart._repr_html_()


def test_a_notebook_shows_a_sheet_as_its_first_page() -> None:
    pages = kulman.sheet(TASK, "3", format="A3")

    assert len(pages.pages) > 1
    assert pages._repr_svg_() == pages.svg(1) != pages.svg(2)
    for number in (0, len(pages.pages) + 1):
        with pytest.raises(KulmanError, match="there is no page"):
            pages.svg(number)
    with pytest.raises(KulmanError, match="page: expected int"):
        pages.svg("x")  # type: ignore[arg-type]


def test_a_table_without_quantities_is_empty() -> None:
    solved = kulman.solve(TASK)

    empty = Solution(solved.task, "0", solved.solved, {}, {}, None, (), solved.words)

    assert empty.table() == ""


@pytest.mark.parametrize(
    ("paths", "key"),
    [
        ((None,), "argument-type"),
        ((["x.svg"],), "argument-type"),
        (("x",), "output-suffix"),
        (("a\0.svg",), "output-name"),
        (("none/x.svg",), "output-folder-missing"),
        (("x.svg", "y.doc"), "output-suffix"),
        (("x.svg", "./x.svg"), "output-twice"),
    ],
)
def test_a_sheet_that_cannot_be_saved_writes_nothing(
    paths: tuple[Any, ...], key: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)

    with pytest.raises(KulmanError) as caught:
        kulman.sheet(TASK, only="velocity").save(*paths)

    assert caught.value.key == key
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    "work",
    [
        lambda: kulman.solve(TASK, "99"),
        lambda: kulman.solve(TASK, set={"l_OA": -1}),
        lambda: kulman.load_task("none.toml"),
        lambda: kulman.sheet(TASK, set={"l_AB": 20, "phi": 90}),
    ],
)
def test_an_error_crosses_to_another_process_whole(work: Any) -> None:
    with pytest.raises(KulmanError) as caught:
        work()

    same = pickle.loads(pickle.dumps(caught.value))

    assert type(same) is type(caught.value)
    assert same.text("uk") == caught.value.text("uk")
    assert same.status == caught.value.status


def test_a_solution_crosses_to_another_process_whole() -> None:
    solved = kulman.solve(TASK, set={"l_AB": 20, "phi": 90})

    same = pickle.loads(pickle.dumps(solved))

    assert json.dumps(same.to_json()) == json.dumps(solved.to_json())
    assert str(same.reason) == str(solved.reason)
