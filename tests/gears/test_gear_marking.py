"""Marking answers to gear pairs: what a form asks for, the printed answers, right and wrong ones."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from kulman import check, solve
from kulman.plans.marking.answers import Verdict
from kulman.variants.solution import Solution

TASK = "madi-gear"
WRONG = {  # at any tolerance
    "a",  # a slip of the pen
    *("P_1", "P_2", "rho_l1", "rho_l2"),  # sines of other angles
    "epsilon_alpha",  # contradicts the numbers beside it
    "y_2_03",  # 39 for 59
    *(f"y_{i}_{k:02d}" for i in (1, 2) for k in range(7, 12)),  # rows exchanged beyond the pole
    "y_1_12",
}
FOLLOWS = {f"theta_{pair}_{k:02d}" for pair in ("12", "21") for k in range(7, 12)}


@pytest.fixture(scope="module")
def solution() -> Solution:
    return solve(TASK)


def verdicts(path: Path, answers: dict[str, float], preset: str = "normal") -> dict[str, Verdict]:
    """Mark one student's values, in the units of the task."""
    asked = check(TASK, preset=preset, lang="en")
    path.write_text(
        f"student,{','.join(answers)}\nA,{','.join(f'{value!r}' for value in answers.values())}\n", encoding="utf-8"
    )
    (read,) = asked.read(str(path))
    return {line.name: line.verdict for line in asked.mark(read).marked.lines}


def test_printed_answers_are_wrong_where_the_note_is() -> None:
    asked = check(TASK, preset="careful", lang="en")

    (answers,) = asked.read("printed")
    marked = asked.mark(answers).marked

    found = {line.name: line.verdict for line in marked.lines}
    assert {name for name, verdict in found.items() if verdict is Verdict.WRONG} == WRONG
    assert {name for name, verdict in found.items() if verdict is Verdict.CARRIED} == FOLLOWS
    assert marked.count(Verdict.MISSING) == 0


def test_form_asks_for_no_given_and_in_the_sections_of_the_note(tmp_path: Path) -> None:
    lines = check(TASK, lang="en").write_form(tmp_path / "form.csv").read_text(encoding="utf-8-sig").splitlines()

    asked = [line.split(",")[0] for line in lines]
    assert not {"m", "z_1", "x_1", "alpha", "PW", "mu_theta", "theta_12_01", "y_1_01"} & set(asked)
    headings = ["Main sizes", "Auxiliary sizes", "Quality by geometry", "Sizes to measure", "Measured on the drawing"]
    assert [asked.index(heading) for heading in headings] == sorted(asked.index(heading) for heading in headings)
    assert asked.index("Main sizes") < asked.index("a_w") < asked.index("Auxiliary sizes") < asked.index("d_b1")


def test_right_answers_get_the_full_mark(tmp_path: Path, solution: Solution) -> None:
    lines = check(TASK, lang="en").write_form(tmp_path / "form.csv").read_text(encoding="utf-8-sig").splitlines()
    names = [name for name in (line.split(",")[0] for line in lines) if name in solution]

    values = {name: solution[name].shown(solution.words.display).value for name in names}
    found = verdicts(
        tmp_path / "class.csv", {name: float(value) for name, value in values.items() if value is not None}
    )

    assert len(values) > 100
    assert set(found.values()) <= {Verdict.RIGHT, Verdict.MISSING}
    assert [name for name in names if found[name] is Verdict.MISSING] == []


def test_the_sign_of_a_number_without_unit_counts(tmp_path: Path, solution: Solution) -> None:
    right = {name: solution[name].value or 0.0 for name in ("x_min2", "theta_21_07", "theta_12_05")}

    found = verdicts(tmp_path / "class.csv", {name: -value for name, value in right.items()})

    assert all(value < 0.0 for value in right.values())
    assert {found[name] for name in right} == {Verdict.WRONG}


@pytest.mark.parametrize(
    ("name", "answer", "verdict"),
    [
        pytest.param("alpha_w", 26.654, Verdict.RIGHT, id="degrees"),
        pytest.param("alpha_w", math.radians(26.654), Verdict.SCALE, id="radians"),
        pytest.param("W_1", 2.3875, Verdict.SCALE, id="centimetres"),
        pytest.param("theta_12_A1", -2.9, Verdict.RIGHT, id="of a drawing"),
        pytest.param("theta_12_A1", -3.9, Verdict.WRONG, id="too far for a drawing"),
        pytest.param("epsilon_alpha", 3.72121, Verdict.WRONG, id="as printed"),
    ],
)
def test_an_answer_is_judged_by_what_it_is(name: str, answer: float, verdict: Verdict, tmp_path: Path) -> None:
    assert verdicts(tmp_path / "class.csv", {name: answer})[name] is verdict


def test_what_follows_from_a_wrong_size_is_right(tmp_path: Path) -> None:
    """With s_1 = 9 mm the thickness on the base circle and the common normal are larger by as much."""
    found = verdicts(tmp_path / "class.csv", {"s_1": 9.0, "s_b1": 9.508, "W_1": 24.268}, "cad")

    assert found["s_1"] is Verdict.WRONG
    assert (found["s_b1"], found["W_1"]) == (Verdict.CARRIED, Verdict.CARRIED)
