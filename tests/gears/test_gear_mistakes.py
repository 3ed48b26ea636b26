"""Mistakes in gears: each rule does what it says, and planted ones are found among answers with rounded digits."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from typing import Any

import pytest

from kulman.plans.boards.exact import run
from kulman.plans.hands.shaky import preset
from kulman.plans.marking.answers import Answer
from kulman.plans.marking.key import Key
from kulman.plans.marking.verdicts import mark
from kulman.plans.mistakes.book import Book, book, broken
from kulman.plans.mistakes.explaining import explain
from kulman.plans.mistakes.rules import Broken
from kulman.variants.case import Request
from kulman.variants.marking.keyed import keyed
from kulman.variants.marking.rubric import Rubric
from kulman.variants.reader import load_task

IDS = [f"M{n}" for n in range(100, 115)]
DIGITS = 4  # of an answer
MM = 1e-3


@cache
def key(*settings: tuple[str, str]) -> Key:
    request = Request(load_task("madi-gear"), "", settings=dict(settings), language="en")
    return keyed(request, "17", {}, Rubric(preset("careful").tolerance)).key


@cache
def mistakes(*settings: tuple[str, str]) -> Book:
    return book(key(*settings))


def wrong(id: str, how: str, at: str = "") -> Broken:
    found = [b for b in broken(key().paper, key().values, (id,)) if b.change.how == how and at in ("", b.at)]
    assert len(found) == 1, [b.place for b in broken(key().paper, key().values, (id,))]
    return found[0]


def values(found: Broken) -> Mapping[str, Any]:
    return run(found.program, found.givens).values


@pytest.mark.parametrize(
    ("id", "how", "at", "name", "value"),
    [
        pytest.param("M100", "", "", "inv_alpha", math.tan(math.radians(20.0)) - 20.0, id="degrees subtracted"),
        pytest.param("M101", "profile", "", "a_w", 87.5 * MM, id="a for a_w"),
        pytest.param("M101", "once", "", "inv_alpha_w", 0.0149044 + 1.05 * 0.36397 / 35.0, id="the sum once"),
        pytest.param("M102", "everywhere", "", "s_1", 10.94773 * MM, id="shifts exchanged"),
        pytest.param("M102", "tip_diameter", "", "d_a1", 91.99971 * MM, id="shifts exchanged at the tips"),
        pytest.param("M103", "none tooth_thickness", "s_1", "s_1", math.pi * 2.5 * MM, id="half a pitch"),
        pytest.param("M103", "side root_diameter", "d_f1", "d_f1", 60.5 * MM, id="shift inwards"),
        pytest.param("M104", "tip", "d_a1", "d_a1", 87.0 * MM, id="tip not shortened"),
        pytest.param("M105", "root", "d_f1", "d_f1", 67.0 * MM, id="no clearance"),
        pytest.param("M106", "root_diameter", "d_f1", "d_f1", 69.75 * MM, id="dedendum once"),
        pytest.param("M107", "diameter", "d_b1", "d_b1", 75.0 * MM * math.cos(math.radians(26.65411)), id="alpha_w"),
        pytest.param("M108", "sine", "P_1", "P_1", 15.25262 * MM, id="chord as printed"),
        pytest.param("M109", "", "rho_l1", "rho_l1", 1.32853 * MM, id="curvature as printed"),
        pytest.param("M109", "", "rho_l2", "rho_l2", 15.17197 * MM, id="the other one as printed"),
        pytest.param("M110", "", "rho_p1", "rho_p1", 17.06819 * MM, id="own tip"),
        pytest.param("M111", "none", "", "epsilon_alpha", 1.20483 * 2.0 * math.pi, id="not divided"),
        pytest.param("M112", "more", "W_1", "W_1", (23.87544 + 14.76066) * MM, id="one pitch more"),
        pytest.param("M113", "beyond", "", "theta_12_08", (28.949 - 54.735) / 28.949, id="rows as printed"),
        pytest.param("M114", "mate", "", "theta_12_03", (14.5168 - 59.1124) / 59.1124, id="by the mate"),
        pytest.param("M114", "sign", "", "theta_12_A1", 3.072, id="sign"),
    ],
)
def test_a_broken_rule_gives_what_it_says(id: str, how: str, at: str, name: str, value: float) -> None:
    assert values(wrong(id, how, at))[name] == pytest.approx(value, rel=2e-4)


def test_rows_exchanged_beyond_the_pole_leave_the_others() -> None:
    found = values(wrong("M113", "beyond"))

    for k in range(1, 13):
        first, second = key()[f"y_1_{k:02d}"] if k > 1 else 0.0, key()[f"y_2_{k:02d}"] if k < 12 else 0.0
        expected = (second, first) if k > 6 else (first, second)
        assert (found[f"y_1_{k:02d}"], found[f"y_2_{k:02d}"]) == pytest.approx(expected, abs=1e-9)


def answers(found: Broken) -> list[Answer]:
    """Return what a student with one mistake writes, numbers rounded; what is nothing by construction is not asked."""
    made = values(found)
    asked = [name for name, question in key().questions.items() if question.step.operands != ("_zero",)]
    names = [name for name in asked if math.isfinite(made[name])]
    return [Answer(name, value=float(f"{made[name]:.{DIGITS}g}")) for name in names]


@pytest.mark.parametrize("id", IDS)
def test_a_planted_mistake_is_the_first_that_is_told(id: str) -> None:
    planted = list(broken(key().paper, key().values, (id,)))[:: 1 if id != "M103" else 6]

    told = [explain(mistakes(), mark(key(), answers(found))).candidates for found in planted]

    assert [found.place for found, told_of in zip(planted, told, strict=True) if not told_of] == []
    assert [(f.place, t[0].ids) for f, t in zip(planted, told, strict=True) if id not in t[0].ids] == []


@pytest.mark.parametrize("ids", [("M108", "M109", "M113"), ("M102", "M108", "M109", "M113")], ids=["three", "four"])
def test_each_of_several_mistakes_is_named(ids: tuple[str, ...]) -> None:
    paper, made = key().paper, key().values
    for id in ids:
        found = next(iter(broken(paper, made, (id,))))
        made = {**made, **values(found)}
        paper = replace(paper, program=found.program, givens=found.givens)

    told = explain(mistakes(), mark(key(), answers(found))).candidates[0]

    assert set(ids) <= told.ids
    assert told.left == ()


def test_right_answers_have_no_mistake_told() -> None:
    right = [Answer(name, value=float(f"{key()[name]:.{DIGITS}g}")) for name in key().questions]

    assert explain(mistakes(), mark(key(), right)).candidates == ()


def test_beams_of_a_hoist_that_bend_are_no_rows_of_the_sliding() -> None:
    found = keyed(Request(load_task("karpenko-hoist"), ""), "V01", {}, Rubric(preset("careful").tolerance)).key

    assert "M113" not in {one.mistake for one in broken(found.paper, found.values)}
