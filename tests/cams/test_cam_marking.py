"""Marking answers of cams: what a form asks for, the printed answers, right and wrong ones."""

from __future__ import annotations

import csv
import math
from functools import cache
from typing import Any

import pytest

from kulman import check, solve
from kulman.plans.marking.answers import Verdict
from kulman.tests.support.cam_students import ROCKER
from kulman.variants.marking.checks import Check
from kulman.variants.solution import Solution

TASK = "madi-cam"
PRINTED = {
    "mu_s": Verdict.RIGHT,
    "mu_a": Verdict.RIGHT,
    "ds_max": Verdict.RIGHT,
    "r_0": Verdict.RIGHT,
    "e": Verdict.RIGHT,
    "rho_min": Verdict.WRONG,  # the radius of the upper dwell
    "r_0_flat_min": Verdict.WRONG,  # an amplitude on paper
    "r_0_flat": Verdict.CARRIED,
    "R_plate": Verdict.RIGHT,
}


@cache
def marker(task: str = TASK) -> Check:
    return check(task, lang="en")


@pytest.fixture(scope="module")
def solution() -> Solution:
    return solve(TASK)


def test_printed_answers_are_right_but_for_two_that_are_no_sizes_of_a_cam() -> None:
    asked = marker()

    (answers,) = asked.read("printed")
    marked = asked.mark(answers).marked

    verdicts = {line.name: line.verdict for line in marked.lines}
    assert {name: verdicts[name] for name in PRINTED} == PRINTED
    assert marked.count(Verdict.MISSING) == 0
    passed = sum(part for name, part in marked.parts.items() if verdicts[name].passed)
    assert 0.7 < passed < 13 / 15  # what is wrong here is needed by the plate: it weighs more than a side value
    assert marked.mark == pytest.approx(100.0 * passed, abs=0.1)


def test_form_asks_for_each_size_once_by_its_plain_name(tmp_path: Any) -> None:
    text = marker().write_form(tmp_path / "form.csv").read_text(encoding="utf-8-sig")

    asked = {line.split(",")[0] for line in text.splitlines()}
    assert {"mu_s", "mu_ds", "mu_d2s", "mu_v", "mu_a", "nu", "r_0", "e", "s_0"} <= asked
    assert {"r_0_flat_min", "rho_min", "R_plate"} <= asked
    assert not {"s_max", "s_close", "v_close", "mu_s_chord", "r_0_tangents", "r_0_flat_tangent"} & asked
    assert "Zhukovsky" not in text


@pytest.mark.parametrize("written", ["0.0001641 m/mm", "0.1641 мм/мм", "0,0001641"])
def test_scale_factor_that_is_asked_may_stand_in_the_column_of_scales(tmp_path: Any, written: str) -> None:
    (tmp_path / "form.csv").write_text(f"quantity;mm;scale;value\nmu_s;;{written};\n", encoding="utf-8")

    (answers,) = marker().read(str(tmp_path / "form.csv"))

    assert answers.problems == ()
    assert answers.lines["mu_s"].value == pytest.approx(0.0001641)


def test_form_asks_for_the_first_angle_of_a_rocker_and_for_no_given(tmp_path: Any) -> None:
    text = marker(ROCKER).write_form(tmp_path / "form.csv").read_text(encoding="utf-8-sig")

    asked = {line.split(",")[0] for line in text.splitlines()}
    assert {"psi_0", "r_0", "l_OC", "rho_min"} <= asked
    assert not {"e", "l_rocker", "R_roller", "H_a"} & asked


def test_form_of_a_rocker_is_headed_by_its_own_plans(tmp_path: Any) -> None:
    text = marker(ROCKER).write_form(tmp_path / "form.csv").read_text(encoding="utf-8-sig")

    for heading in ("Positions of the rocker, place of the cam's centre", "Cam with a rocker"):
        assert f'{heading}"' in text or heading in text.splitlines()
    assert "roller follower" not in text


def test_right_answers_get_the_full_mark(tmp_path: Any, solution: Solution) -> None:
    asked = marker()
    form = asked.write_form(tmp_path / "form.csv")
    rows = list(csv.reader(form.read_text(encoding="utf-8-sig").splitlines()))
    for cells in rows:
        if cells[0] in solution and len(cells) > 6:
            cells[5] = f"{solution[cells[0]].shown(solution.words.display).value:.4g}"
    with form.open("w", encoding="utf-8-sig", newline="") as file:
        csv.writer(file).writerows(rows)

    (answers,) = asked.read(str(form))

    assert asked.mark(answers).marked.mark == 100.0


@pytest.mark.parametrize(
    ("name", "times"),
    [("mu_s", 1e3), ("mu_a", 10.0), ("gamma_rise_min", math.degrees(1.0)), ("r_0", 0.1)],
)
def test_a_value_in_another_unit_is_told_from_a_wrong_one(
    name: str, times: float, tmp_path: Any, solution: Solution
) -> None:
    asked = marker()
    written = solution[name].shown(solution.words.display)
    file = tmp_path / "class.csv"
    file.write_text(f"student,{name}\nA,{times * (written.value or 0.0):.6g}\n", encoding="utf-8")

    (answers,) = asked.read(str(file))
    (line,) = [line for line in asked.mark(answers).marked.lines if line.name == name]

    assert line.verdict is Verdict.SCALE
