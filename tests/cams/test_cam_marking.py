"""Marking cams: forms, printed answers, students who draw, planted mistakes, condition of quantities."""

from __future__ import annotations

import math
import random
from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from itertools import cycle
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from kulman import check, solve
from kulman.plans.boards.exact import run
from kulman.plans.cams.cam import LAWS
from kulman.plans.cams.solve import BESIDE
from kulman.plans.hands.shaky import PRESETS, Hand, preset
from kulman.plans.hands.spread import drawn, kept
from kulman.plans.marking.answers import Answer, Line, Verdict
from kulman.plans.marking.key import Key
from kulman.plans.marking.verdicts import mark
from kulman.plans.mistakes.book import book, broken
from kulman.plans.mistakes.explaining import _Explanation, explain
from kulman.tests.support.cams import MADI, ROCKER, Settings, asked, asked_key, cam_book, keyed_cam, random_cams
from kulman.tests.support.cases import some
from kulman.tests.support.commands import Run
from kulman.tests.support.marking_cases import HAND, moves, students
from kulman.variants.shelf import bundled_text
from kulman.variants.solution import Solution

PRINTED = dict.fromkeys(("mu_s", "mu_a", "ds_max", "r_0", "e", "R_plate"), Verdict.RIGHT) | {
    "rho_min": Verdict.WRONG,  # the radius of the upper dwell
    "r_0_flat_min": Verdict.WRONG,  # an amplitude on paper
    "r_0_flat": Verdict.CARRIED,
}


def test_printed_answers_are_right_but_for_two_that_are_no_sizes_of_a_cam() -> None:
    asked_now = check(MADI, lang="en")

    (answers,) = asked_now.read("printed")
    marked = asked_now.mark(answers).marked

    verdicts = {line.name: line.verdict for line in marked.lines}
    assert {name: verdicts[name] for name in PRINTED} == PRINTED
    assert marked.count(Verdict.MISSING) == 0
    passed = sum(part for name, part in marked.parts.items() if verdicts[name].passed)
    assert 0.7 < passed < 13 / 15  # what is wrong here is needed by the plate: it weighs more than a side value
    assert marked.mark == pytest.approx(100.0 * passed, abs=0.1)


def test_a_form_asks_for_each_size_once_by_its_plain_name_and_for_no_given() -> None:
    names, rocking = asked(keyed_cam()), asked(keyed_cam((), ROCKER))

    assert {"mu_s", "mu_ds", "mu_d2s", "mu_v", "mu_a", "nu", "r_0", "e", "s_0"} <= names
    assert {"r_0_flat_min", "rho_min", "R_plate"} <= names
    assert not {"s_max", "s_close", "v_close", "mu_s_chord", "r_0_tangents", "r_0_flat_tangent"} & names
    assert {"psi_0", "r_0", "l_OC", "rho_min", "gamma_rise_min"} <= rocking
    assert not {"e", "l_rocker", "R_roller", "H_a"} & rocking
    assert "l_OC" not in asked(keyed_cam((("l_OC", "140 mm"),), ROCKER))
    for given, value in (("r_0", "60 mm"), ("e", "5 mm")):  # then there is nothing to find by tangents
        of = keyed_cam(((given, value),))
        assert given not in asked(of)
        assert {"r_0_tangents", "e_tangents", "s_0"} <= asked(of)
        assert of.key["s_0"] == of.solution["s_0"].value


def test_scale_factor_that_is_asked_may_stand_in_the_column_of_scales(tmp_path: Path) -> None:
    for written in ("0.0001641 m/mm", "0.1641 мм/мм", "0,0001641"):
        (tmp_path / "form.csv").write_text(f"quantity;mm;scale;value\nmu_s;;{written};\n", encoding="utf-8")

        (answers,) = check(MADI, only="diagrams").read(str(tmp_path / "form.csv"))

        assert answers.problems == ()
        assert answers.lines["mu_s"].value == pytest.approx(0.0001641)


def test_a_value_in_another_unit_is_told_from_a_wrong_one(tmp_path: Path) -> None:
    times, solution = {"mu_s": 1e3, "mu_a": 10.0, "gamma_rise_min": math.degrees(1.0), "r_0": 0.1}, keyed_cam().solution
    values = [factor * (solution[name].shown(solution.words.display).value or 0.0) for name, factor in times.items()]
    (tmp_path / "class.csv").write_text(f"student,{','.join(times)}\nA,{','.join(f'{x:.6g}' for x in values)}\n")
    asked_now = check(MADI, lang="en")

    (answers,) = asked_now.read(str(tmp_path / "class.csv"))

    verdicts = {line.name: line.verdict for line in asked_now.mark(answers).marked.lines}
    assert {verdicts[name] for name in times} == {Verdict.SCALE}


def test_a_report_has_degrees_and_the_letters_of_diagrams(tmp_path: Path, run: Run) -> None:
    (tmp_path / "form.csv").write_text(
        "quantity,value\nnu,27.6\ngamma_rise_min,75\nr_0_flat_min,55\n", encoding="utf-8"
    )

    _, out, _ = run("check", MADI, tmp_path / "form.csv", "--lang", "en")

    assert "27.6 °" in out
    assert "75 °" in out
    assert "rad" not in out.replace("radius", "")
    assert "First wrong step: r_0 pl min, S – d" in out


SEED = 1868
CHORDS = ("S_max_chord", "V_max_chord", "s_close", "v_close", "mu_s", "mu_d2s", "ds_max", "v_max", "r_0", "e", "s_0")
ON_PAPER, SIZES = CHORDS[:4], CHORDS[-3:]


def honest(settings: Settings, count: int, task: str = MADI) -> list[Line]:
    """Return the lines of students who draw a cam with the usual hand, and make no mistake."""
    of = keyed_cam(settings, task)
    drawn = students(asked_key(of), of.key.paper, count, SEED)
    return [line for answers in drawn for line in mark(of.key, answers).answered]


def passed(lines: list[Line]) -> float:
    return float(np.mean([line.verdict.passed for line in lines]))


@pytest.mark.parametrize(
    ("law", "count"), [("sine", 1), *(pytest.param(law, 5, marks=pytest.mark.soak, id=f"{law}-5") for law in LAWS)]
)
def test_faultless_drawings_are_right(law: str, count: int) -> None:
    lines = [line for settings in random_cams(SEED, count, law) for line in honest(settings, 20)]

    assert {"v_max", "r_0", "e"} <= {line.name for line in lines}
    assert passed(lines) >= 0.98


@pytest.mark.parametrize(
    ("settings", "task", "names"),
    some(
        [
            ((("rotation", "cw"), ("law", "cosine")), MADI, {"r_0", "e"}),
            pytest.param((), MADI, {"r_0", "e"}, marks=pytest.mark.soak),
            ((), ROCKER, {"psi_0", "l_OC", "r_0"}),
        ],
        2,
    ),
)
def test_no_line_of_a_faultless_drawing_fails_often(settings: Settings, task: str, names: set[str]) -> None:
    lines = honest(settings, 40, task)

    failed = {name: np.mean([x.verdict.faulty for x in lines if x.name == name]) for name in {x.name for x in lines}}
    assert names <= failed.keys()
    assert passed(lines) >= 0.98
    assert max(failed.values()) <= 0.15, failed


@pytest.mark.parametrize("hand", [HAND, pytest.param("cad", marks=pytest.mark.soak)])
def test_sizes_are_right_by_formulas_and_by_chords_and_mixed(hand: str) -> None:
    choose = random.Random(SEED)
    for settings in random_cams(SEED, 1 if hand == HAND else 4):
        of = keyed_cam(settings, hand=hand)
        ways = [
            {name: of.solution[name].value for name in asked(of)},
            {name: of.key[name] for name in asked(of)},
            {name: choose.choice(of.key.right(name)) for name in asked(of)},
        ]

        for values in ways:
            marking = mark(of.key, [Answer(name, value=value) for name, value in values.items()])
            assert {line.verdict for line in marking.answered} == {Verdict.RIGHT}


@pytest.mark.parametrize(
    "hand", [hand if hand in (HAND, "cad") else pytest.param(hand, marks=pytest.mark.soak) for hand in PRESETS]
)
def test_what_is_let_pass_is_what_hands_do(hand: str) -> None:
    key = keyed_cam((), hand=hand).key
    found = drawn(key.paper, preset(hand).hand, np.random.default_rng(SEED), 1000)

    for name in CHORDS:
        missed, size = kept(found[name], key[name]), abs(key[name])  # by 95 % of the drawings
        mu = 1e-3 if name in ON_PAPER else key.paper.mus["sizes"] if name in SIZES else None
        alone = key.tolerance.part * size if mu is None else key.tolerance.of_segment(size / mu) * mu
        assert 0.75 * missed <= key.allowed[name] <= 1.3 * max(missed, alone), name


@pytest.mark.parametrize("task", [MADI, pytest.param(ROCKER, marks=pytest.mark.soak)])
def test_a_size_of_a_cam_that_is_a_seventh_off_is_wrong(task: str) -> None:
    of = keyed_cam((), task)
    names = sorted(name for name in asked(of) if of.key[name] and name not in of.key.paper.givens)

    for name in names:
        marking = mark(of.key, [Answer(name, value=1.15 * abs(of.key[name]))])
        assert marking.answered[0].verdict.faulty, name
    assert max(of.key.allowed[name] / abs(of.key[name]) for name in names if name != "e") < 0.1


def test_a_hand_closes_its_diagrams_and_an_exact_one_errs_nowhere() -> None:
    paper, most = keyed_cam().key.paper, preset(HAND)

    by_hand, exact = (drawn(paper, hand, np.random.default_rng(SEED), 200) for hand in (most.hand, Hand(0.0, 0.0, 0.0)))

    assert 1e3 * kept(by_hand["s_close"], 0.0) <= 2.0 * most.tolerance.mm
    assert kept(exact["r_0"], exact.exact["r_0"], 1.0) == 0.0


@pytest.mark.parametrize("task", [MADI, pytest.param(ROCKER, marks=pytest.mark.soak)])
def test_a_hand_is_let_pass_what_marking_lets_pass(task: str) -> None:
    of, drawing = keyed_cam((), task), solve(task, hand=HAND).drawing
    assert drawing is not None

    told = {name: drawing.expected[name].allowed for name in of.key.questions}

    assert told == pytest.approx(dict(of.key.allowed), rel=1e-9)
    if task == MADI:  # sizes by chords are drawn by the hand that draws what they stand for
        for exact, chords in (("mu_s", "mu_s_chord"), ("r_0", "r_0_tangents"), ("r_0_flat_min", "r_0_flat_tangent")):
            assert drawing.expected[exact] is drawing.expected[chords]


@pytest.mark.parametrize(
    ("follower", "unused", "only"),
    [
        ("roller", "rho_flat margin r_0_flat", "sizes"),
        pytest.param("plate", "gamma_rise gamma_fall R_roller e limits", None, marks=pytest.mark.soak),
        pytest.param("roller", "rho_flat margin r_0_flat", "diagrams", marks=pytest.mark.soak),
    ],
)
def test_a_cam_for_one_follower_or_a_part_of_it_is_marked(
    follower: str, unused: str, only: str | None, tmp_path: Path
) -> None:
    lines = bundled_text("madi-cam").replace('["roller", "plate"]', f'["{follower}"]').splitlines()
    own, form = tmp_path / "own.toml", tmp_path / "form.csv"
    own.write_text("\n".join(line for line in lines if line.partition(" =")[0] not in unused.split()), encoding="utf-8")

    asked_now, solution = check(own, only=only, lang="en"), solve(own, only=only)
    text = asked_now.write_form(form).read_text(encoding="utf-8-sig")
    names = [name for line in text.splitlines() if (name := line.partition(",")[0]) in solution]
    rows = [f"{name},{solution[name].shown(solution.words.display).value}" for name in names]
    form.write_text("\n".join(("quantity,value", *rows)), encoding="utf-8")
    (answers,) = asked_now.read(str(form))

    assert "mu_s" in names
    assert ("r_0" in names, "r_0_flat" in names) == (only == "sizes", follower == "plate")
    assert asked_now.mark(answers).marked.mark == 100.0


def test_an_ordinate_on_paper_has_no_scale_factor_or_that_which_was_found() -> None:
    key = keyed_cam().key
    right = 1e3 * key["S_max_chord"]

    for answer, verdict in (
        (Answer("S_max_chord", mm=right), Verdict.RIGHT),
        (Answer("S_max_chord", mm=right, mu=key["mu_s"]), Verdict.RIGHT),
        (Answer("S_max_chord", mm=0.7 * right), Verdict.WRONG),
        (Answer("ds_max", mm=66.0, mu=key["mu_ds"], value=key["ds_max"]), Verdict.RIGHT),
        (Answer("ds_max", mm=66.0, value=key["ds_max"]), Verdict.RIGHT),
        (Answer("ds_max", mm=66.0), Verdict.RIGHT),
        (Answer("ds_max", mm=40.0), Verdict.WRONG),
        (Answer("ds_max", mm=66.0, mu=key["mu_ds"], value=2.0 * key["ds_max"]), Verdict.ARITHMETIC),
    ):
        assert mark(key, [answer])[answer.name].verdict is verdict
    marking = mark(key, [Answer("mu_d2s", value=2.0 * key["mu_d2s"]), Answer("A_1", mm=110.0)])
    assert [line.verdict for line in marking.answered] == [Verdict.WRONG, Verdict.CARRIED]
    assert marking["A_1"].said == pytest.approx(2.0 * key["A_1"])


def test_what_hangs_on_a_wrong_ordinate_is_carried_through_the_whole_cam() -> None:
    of = keyed_cam()
    givens = {**of.key.paper.givens, "h": 2.0 * of.key.paper.givens["h"]}  # as S_max / 2
    values = run(of.key.paper.program, givens).values
    wrong = {name: values[name] for name in asked(of)} | {"S_max_chord": 0.5 * of.key["S_max_chord"]}

    marking = mark(of.key, [Answer(name, value=value) for name, value in wrong.items()])

    assert marking.first_wrong == "S_max_chord"
    left = {line.name for line in marking.lines if line.verdict.faulty} - {"S_max_chord"}
    assert left == set()


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
    some(
        [
            ("M91", "both", {"gamma_rise": "15 deg", "gamma_fall": "30 deg"}),
            ("M91", "rise", {"gamma_rise": "15 deg"}),
            ("M92", "", {"gamma_rise": "60 deg", "gamma_fall": "75 deg"}),
            ("M93", "half", {"gamma_rise": "82.5 deg", "gamma_fall": "75 deg"}),
            ("M93", "twice", {"gamma_rise": "60 deg", "gamma_fall": "30 deg"}),
            ("M94", "sizes", {"rotation": "cw"}),
        ],
        2,
        5,
    ),
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
    key, rocking = keyed_cam().key, keyed_cam((), ROCKER).key

    assert after("M96", "ordinate")["r_0_flat_min"] == pytest.approx(key["A_2"], rel=1e-9)
    assert after("M96", "branch")["r_0_flat_min"] > key["A_1"]
    for how in ("ordinate", "branch"):  # the tangents of the roller's cam stay
        assert after("M96", how)["r_0"] == key["r_0"]
    corners = [after("M13", how, of=rocking)["psi_0"] for how in ("first", "second")]  # of the rocker's triangle
    assert sum(corners) + rocking["psi_0"] == pytest.approx(math.pi, rel=1e-12)


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


def planted(settings: Settings, choose: random.Random, directions: bool) -> tuple[str, dict[str, float], _Explanation]:
    """Plant a mistake that shows among the answers of a shaky hand, chosen by its number, then its place.

    Return its number, by how much it moves the lines that are asked, and how the answers are explained.
    """
    of, names = keyed_cam(settings), asked(keyed_cam(settings))
    signatures, moved = cam_book(settings).signatures, {"": 0.0}
    while max(moved.values()) <= WRONG_BY:
        id = choose.choice(sorted({s.broken.mistake for s in signatures}))
        found = choose.choice([s for s in signatures if s.broken.mistake == id])
        moved = {n: v for n, v in moves(cam_book(settings).key, found, directions).items() if n in names}
    paper, one = of.key.paper, found.broken
    drawing = replace(paper, program=one.program, givens=one.givens)
    answers = next(students(asked_key(of), drawing, 1, choose.randrange(10**6), directions))
    return id, moved, explain(cam_book(settings), mark(of.key, answers))


@pytest.mark.parametrize("directions", [True, pytest.param(False, marks=pytest.mark.soak)], ids=["signs", "sizes"])
@pytest.mark.parametrize(("cams", "each"), [(1, 20), pytest.param(4, 15, marks=pytest.mark.soak)])
def test_planted_mistakes_are_found(cams: int, each: int, directions: bool) -> None:
    choose = random.Random(SEED)
    first, named, best, carried = [], [], [], []
    for settings in random_cams(SEED, cams):
        lines = list(keyed_cam(settings).key.questions)
        for _ in range(each):
            id, moved, explanation = planted(settings, choose, directions)
            wrong = str(explanation.marking.first_wrong)
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


# of h, phi_rise, u, omega, mu_phi, H_a, H_v, l_A1 the sums of the powers: v_max = 2 h omega / phi_rise
POWERS = {
    "s_max": 1.0,
    # the greatest of rise and fall, which are alike: half of an error of either
    "ds_max": 2.0,
    "v_max": 3.0,
    "A_1": 4.0,  # 4 h / (u phi_rise^2)
    "a_max": 6.0,
    "l_A2": 1.0 + 1.5,  # u / (1 - u) of u = 1/3
    "mu_s": 9.0,
    "mu_ds": 7.0,
    "mu_d2s": 5.0,
    "gamma_rise_min": 1.0,
    "R_roller": 1.0,
    "s_close": 0.0,
}
STEP = 1e-4
NUMBERS = ("h", "phi_rise", "phi_fall", "phi_upper", "omega", "l_A1", "H_a", "H_v", "gamma_rise", "gamma_fall")


@cache
def madi() -> Solution:
    return solve(MADI, condition=True)


def test_products_of_powers_have_the_sum_of_their_powers() -> None:
    found = madi().conditions

    assert {name: found[name].value for name in POWERS} == pytest.approx(POWERS, abs=1e-4)


def test_what_is_a_power_of_data_has_it_where_phases_fill_the_turn_or_the_velocity_jumps() -> None:
    full = {"phi_rise": "150 deg", "phi_upper": "0 deg", "phi_fall": "210 deg"}

    filled = solve(MADI, set=full, only="diagrams", condition=True).conditions
    jumping = solve(MADI, set={"law": "uniform"}, condition=True).conditions

    assert [filled[name].value for name in ("v_max", "a_max")] == pytest.approx([3.0, 6.0], abs=1e-3)
    assert jumping["v_max"].value == pytest.approx(3.0, abs=1e-4)
    assert jumping["rho_min"].value == 0.0  # a corner, whatever the data


@pytest.mark.parametrize(
    ("numbers", "names"),
    [
        ("h phi_rise phi_fall u gamma_rise gamma_fall", ("r_0", "s_0")),
        pytest.param("h phi_rise phi_fall u rho_flat", ("r_0_flat",), marks=pytest.mark.soak),
    ],
)
def test_sizes_hang_on_the_data_as_they_do_when_solved_again(numbers: str, names: tuple[str, ...]) -> None:
    right = madi()

    totals = dict.fromkeys(names, 0.0)
    for name in numbers.split():
        given, unit = right.solved.givens[name], right.task.givens[name].unit
        assert unit is not None
        there = [solve(MADI, set={name: unit.from_si(given * (1.0 + step))}).solved.values for step in (STEP, -STEP)]
        for quantity in names:
            moved = abs(float(there[0][quantity]) - float(there[1][quantity])) * (0.5 / STEP)
            totals[quantity] += moved / abs(float(right.solved.values[quantity]))

    assert {name: right.conditions[name].value for name in names} == pytest.approx(totals, rel=2e-3)


def test_sines_are_those_of_the_flattest_rays_of_the_chords() -> None:
    solution = madi()
    steepest = math.hypot(110.0 * 11.0 / 12.0 - 110.0 / 12.0 / 2.0 + 110.0 / 24.0, 30.0)

    sine = solution.conditions["S_max_chord"].sine

    assert sine == min(solution.solved.sines.values())
    assert sine == pytest.approx(30.0 / steepest, rel=0.1)
    assert solution.conditions["mu_s"].sine == 1.0


def test_no_size_of_a_cam_loses_more_than_its_condition_says() -> None:
    right, err, signs = madi(), 1e-6, cycle((1.0, -1.0, -1.0))
    units = {name: unit for name in NUMBERS if (unit := right.task.givens[name].unit) is not None}
    givens = {name: right.solved.givens[name] * (1.0 + err * next(signs)) for name in units}
    there = solve(MADI, set={name: unit.from_si(givens[name]) for name, unit in units.items()})

    for name, condition in right.conditions.items():
        value, size = float(right.solved.values[name]), float(right.solved.values[BESIDE.get(name, name)])
        moved = abs(float(there.solved.values[name]) - value)
        assert condition.value is not None, name
        assert moved <= err * (condition.value * 1.01 + 1e-3) * abs(size), name
