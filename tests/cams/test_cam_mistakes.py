"""Mistakes in cams: each rule does what it says, and planted ones are found among answers of a shaky hand."""

from __future__ import annotations

import math
import random
from collections.abc import Mapping
from typing import Any

import numpy as np
import pytest

from kulman.plans.boards.exact import run
from kulman.plans.hands.shaky import Paper
from kulman.plans.marking.answers import Answer
from kulman.plans.marking.key import Key
from kulman.plans.marking.verdicts import mark
from kulman.plans.mistakes.book import Signature, book, broken
from kulman.plans.mistakes.explaining import Explanation, explain
from kulman.tests.support.cam_students import (
    ROCKER,
    Settings,
    asked,
    asked_key,
    cam_book,
    keyed_cam,
    random_cams,
)
from kulman.tests.support.marking_cases import moves, students

SEED = 1868
MM = 1e3
WRONG_BY = 2.0  # tolerances by which a planted mistake moves at least one line
A_1, H_A, H_V, U = 110.0, 30.0, 30.0, 1.0 / 3.0  # of the note, mm and a part
OMEGA, PER_MM = 200.0, math.radians(1.0)


def after(id: str, how: str, at: str = "", of: Key | None = None) -> Mapping[str, Any]:
    """Return what a cam gives with one rule broken."""
    key = keyed_cam().key if of is None else of
    found = [b for b in broken(key.paper, key.values, (id,)) if b.change.how == how and at in ("", b.at)]
    assert len(found) == 1, [b.place for b in broken(key.paper, key.values, (id,))]
    return run(found[0].program, found[0].givens).values


@pytest.mark.parametrize(
    ("id", "how", "at", "name", "times"),
    [
        ("M83", "none", "mu_ds", "mu_ds", H_V),
        ("M83", "none", "mu_d2s", "mu_d2s", H_A),
        ("M83", "none, all", "", "mu_d2s", H_A * H_V),
        ("M84", "degrees", "mu_ds", "mu_ds", PER_MM),
        ("M84", "none, all", "", "mu_d2s", PER_MM**2),
        ("M84", "section", "mu_d2s", "mu_d2s", 1.0 / 9.0),
        ("M85", "none", "mu_v", "v_max", 1.0 / OMEGA),
        ("M85", "none", "mu_a", "a_max", 1.0 / OMEGA**2),
        ("M85", "once", "mu_a", "mu_a", 1.0 / OMEGA),
        ("M88", "inverse, calculated", "", "l_A2", ((1.0 - U) / U) ** 2),
        ("M88", "u, calculated", "", "A_2", 1.0 - U),
        ("M20", "0.1 paper", "S_max_chord", "mu_s", 10.0),
        ("M97", "diameter", "R_plate", "R_plate", 2.0),
    ],
)
def test_a_wrong_factor_is_carried_on(id: str, how: str, at: str, name: str, times: float) -> None:
    assert after(id, how, at)[name] == pytest.approx(times * keyed_cam().key[name], rel=1e-12)


def test_sizes_and_scales_that_are_given_otherwise() -> None:
    key = keyed_cam().key

    assert after("M14", "")["mu_s"] == pytest.approx(1.0 / key["mu_s"], rel=1e-12)
    assert after("M17", "paper", "ds_max")["ds_max"] * MM == pytest.approx(66.0, rel=1e-12)
    assert after("M17", "paper", "A_1")["A_1"] * MM == pytest.approx(A_1, rel=1e-12)
    assert after("M17", "paper", "r_0")["r_0"] * MM == pytest.approx(key["r_0"] / key.paper.mus["sizes"], rel=1e-12)
    assert after("M89", "inverse", "nu")["nu"] == pytest.approx(0.5 * math.pi - key["nu"], rel=1e-12)
    assert after("M89", "tangent", "nu")["nu"] == pytest.approx(H_V * PER_MM, rel=1e-12)
    assert after("M95", "")["r_0"] == pytest.approx(math.sqrt(key["r_0"] ** 2 - key["e"] ** 2), rel=1e-12)
    assert after("M97", "none", "r_0_flat")["r_0_flat"] == key["r_0_flat_min"]
    assert after("M98", "less")["rho_min"] == pytest.approx(key["rho_min"] - 7e-3, rel=1e-12)
    assert after("M99", "upper")["rho_min"] == pytest.approx(math.hypot(key["e"], key["s_0"] + 13e-3), rel=1e-12)


@pytest.mark.parametrize(
    ("id", "how", "said"),
    [
        ("M91", "both", {"gamma_rise": "15 deg", "gamma_fall": "30 deg"}),
        ("M91", "rise", {"gamma_rise": "15 deg"}),
        ("M92", "", {"gamma_rise": "60 deg", "gamma_fall": "75 deg"}),
        ("M93", "half", {"gamma_rise": "82.5 deg", "gamma_fall": "75 deg"}),
        ("M93", "twice", {"gamma_rise": "60 deg", "gamma_fall": "30 deg"}),
        ("M94", "sizes", {"rotation": "cw"}),
    ],
)
def test_wrong_tangents_give_the_cam_that_other_limits_have(id: str, how: str, said: dict[str, str]) -> None:
    there, found = keyed_cam((*said.items(), ("R_roller", "1 mm"))).key, after(id, how)

    for name in ("e",) if id == "M94" else ("r_0", "e"):
        assert found[name] == pytest.approx(there[name], rel=1e-9)


def test_diagrams_in_unequal_scales_have_the_tangents_of_a_wider_curve() -> None:
    key = keyed_cam().key
    wider = key["mu_s"] / key["mu_ds"]
    s, ds = (np.array([float(key.values[f"_{word}{i}_drawn"]) for i in range(26)]) for word in ("s", "ds"))
    right, left = np.tan(np.radians((75.0, 60.0)))
    x_right, x_left = max(ds * wider - s / right), min(ds * wider + s / left)  # where tangents meet the axis
    down = (x_right - x_left) / (1.0 / right + 1.0 / left)

    found = after("M90", "ds")

    assert found["r_0"] == pytest.approx(math.hypot(x_right - down / right, down), rel=0.02)
    assert after("M90", "d2s")["r_0_flat_min"] != pytest.approx(key["r_0_flat_min"], rel=0.2)


def test_second_lobes_are_drawn_as_high_as_they_have_been_calculated() -> None:
    key, found = keyed_cam().key, after("M88", "equal")

    for i, right in enumerate(key.values[f"_part{i}"] for i in range(1, 26)):
        times = 2.0 if right < 0.0 else 1.0  # of both phases: the fall is the rise backwards
        assert found[f"_part{i + 1}"] == pytest.approx(times * right, rel=1e-12)
    assert found["l_A2"] == pytest.approx(key.paper.givens["l_A1"], rel=1e-12)


def test_the_plate_by_ordinates_alone_is_the_greatest_negative_one() -> None:
    key = keyed_cam().key

    assert after("M96", "ordinate")["r_0_flat_min"] == pytest.approx(key["A_2"], rel=1e-9)
    assert after("M96", "branch")["r_0_flat_min"] > key["A_1"]
    for how in ("ordinate", "branch"):  # the tangents of the roller's cam stay
        assert after("M96", how)["r_0"] == key["r_0"]


def test_an_angle_of_the_rocker_is_that_at_another_corner() -> None:
    key = keyed_cam((), ROCKER).key
    corners = [after("M13", how, of=key)["psi_0"] for how in ("first", "second")]

    assert sum(corners) + key["psi_0"] == pytest.approx(math.pi, rel=1e-12)


def test_a_mistake_among_formulas_is_named_though_chords_give_other_numbers() -> None:
    of = keyed_cam((("law", "sine"),), hand="cad")
    behind = ("mu_ds", "mu_v", "mu_d2s", "mu_a", "ds_max", "v_max", "a_max", "A_1", "A_2")
    said = {name: float(of.solution[name].value or 0.0) for name in ("l_A2", "mu_s", *behind)}
    answers = [Answer(name, value=value * (H_V if name in behind else 1.0)) for name, value in said.items()]

    explanation = explain(book(of.key), mark(of.key, answers))

    assert abs(of.solution["mu_s"].value or 0.0) > of.key["mu_s"] + 3.0 * of.key.allowed["mu_s"]
    assert explanation.marking.first_wrong == "mu_ds"
    assert explanation.candidates[0].ids == {"M83"}
    assert {line.name for line in explanation.marking.lines if line.verdict.faulty} == {"mu_ds"}


# Planted mistakes.


def planted(settings: Settings, found: Signature, seed: int, directions: bool) -> Explanation:
    """Explain the answers of a student who has broken one rule, and draws with a shaky hand."""
    of = keyed_cam(settings)
    paper, one = of.key.paper, found.broken
    drawing = Paper(one.program, one.givens, paper.mus, paper.edges, paper.unscaled)
    answers = next(students(asked_key(of), drawing, 1, seed, directions))
    return explain(cam_book(settings), mark(of.key, answers))


def choice(settings: Settings, choose: random.Random, directions: bool) -> tuple[Signature, dict[str, float]]:
    """Choose a mistake by its number, then its place, and return by how much it moves the lines that are asked."""
    names = asked(keyed_cam(settings))
    while True:
        id = choose.choice(sorted({s.broken.mistake for s in cam_book(settings).signatures}))
        found = choose.choice([s for s in cam_book(settings).signatures if s.broken.mistake == id])
        moved = {n: v for n, v in moves(cam_book(settings).key, found, directions).items() if n in names}
        if max(moved.values()) > WRONG_BY:
            return found, moved


@pytest.mark.parametrize("directions", [True, pytest.param(False, marks=pytest.mark.soak)], ids=["signs", "sizes"])
@pytest.mark.parametrize(("cams", "each"), [(1, 12), pytest.param(4, 25, marks=pytest.mark.soak)])
def test_planted_mistakes_are_found(cams: int, each: int, directions: bool) -> None:
    choose = random.Random(SEED)
    first, named, best, carried = [], [], [], []
    for settings in random_cams(SEED, cams):
        lines = list(keyed_cam(settings).key.questions)
        for _ in range(each):
            found, moved = choice(settings, choose, directions)
            explanation = planted(settings, found, choose.randrange(10**6), directions)
            wrong, id = str(explanation.marking.first_wrong), found.broken.mistake
            clear = next(name for name in lines if moved.get(name, 0.0) > WRONG_BY)
            first.append(moved.get(wrong, 0.0) > 1.0 and lines.index(wrong) <= lines.index(clear))
            named.append(any(id in candidate.ids for candidate in explanation.candidates[:3]))
            best.append(bool(explanation.candidates) and id in explanation.candidates[0].ids)
            others = [x for x in explanation.marking.answered if moved.get(x.name, 0.0) > 1.0 and x.name != wrong]
            carried += [x.verdict.passed for x in others]

    assert np.mean(first) >= 0.95
    assert np.mean(named) >= 0.95
    assert np.mean(best) >= 0.9
    assert np.mean(carried) >= 0.95
