"""Students who draw a cam: honest ones are right, whichever way they go, and none may miss what no hand misses."""

from __future__ import annotations

import random
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from kulman import check, solve
from kulman.plans.boards.exact import run
from kulman.plans.cams.cam import LAWS
from kulman.plans.hands.shaky import PRESETS, draw, preset
from kulman.plans.hands.spread import kept
from kulman.plans.marking.answers import Answer, Line, Verdict
from kulman.plans.marking.verdicts import mark
from kulman.tests.support.cam_students import MADI, ROCKER, Settings, asked, asked_key, keyed_cam, random_cams
from kulman.tests.support.marking_cases import HAND, students
from kulman.variants.hands import Drawing
from kulman.variants.shelf import bundled_text

SEED = 1868
CHORDS = ("S_max_chord", "V_max_chord", "s_close", "v_close", "mu_s", "mu_d2s", "ds_max", "v_max", "r_0", "e", "s_0")
ON_PAPER = CHORDS[:4]
CLOCKWISE = (("rotation", "cw"), ("law", "cosine"))


def honest(settings: Settings, count: int, task: str = MADI) -> list[Line]:
    """Return the lines of students who draw a cam with the usual hand, and make no mistake."""
    of = keyed_cam(settings, task)
    drawn = students(asked_key(of), of.key.paper, count, SEED)
    return [line for answers in drawn for line in mark(of.key, answers).answered]


@cache
def drawn_by_hand(task: str) -> Drawing:
    """Return what `kulman solve --hand` tells."""
    found = solve(task, hand=HAND).drawing
    assert found is not None
    return found


def passed(lines: list[Line]) -> float:
    return float(np.mean([line.verdict.passed for line in lines]))


@pytest.mark.parametrize(
    ("law", "count"), [("sine", 1), *(pytest.param(law, 5, marks=pytest.mark.soak, id=f"{law}-5") for law in LAWS)]
)
def test_faultless_drawings_are_right(law: str, count: int) -> None:
    lines = [line for settings in random_cams(SEED, count, law) for line in honest(settings, 20)]

    assert {"v_max", "r_0", "e"} <= {line.name for line in lines}
    assert passed(lines) >= 0.98


@pytest.mark.parametrize("settings", [CLOCKWISE, pytest.param((), marks=pytest.mark.soak)])
def test_no_line_of_a_faultless_drawing_fails_often(settings: Settings) -> None:
    lines = honest(settings, 40)

    failed = {name: np.mean([x.verdict.faulty for x in lines if x.name == name]) for name in {x.name for x in lines}}
    assert passed(lines) >= 0.98
    assert max(failed.values()) <= 0.15, failed


def test_faultless_drawings_of_a_rocker_are_right() -> None:
    lines = honest((), 40, ROCKER)

    assert {"psi_0", "l_OC", "r_0"} <= {line.name for line in lines}
    assert passed(lines) >= 0.98


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
@pytest.mark.parametrize("settings", [(), pytest.param(CLOCKWISE, marks=pytest.mark.soak)])
def test_what_is_let_pass_is_what_hands_do(hand: str, settings: Settings) -> None:
    key = keyed_cam(settings, hand=hand).key
    board = draw(key.paper, preset(hand).hand, np.random.default_rng(SEED), 1000)

    for name in CHORDS:
        missed, size = kept(board.values[name], key[name]), abs(key[name])  # by 95 % of the drawings
        alone = key.tolerance.of_segment(1e3 * size) * 1e-3 if name in ON_PAPER else key.tolerance.part * size
        assert 0.75 * missed <= key.allowed[name] <= 1.3 * max(missed, alone), name


@pytest.mark.parametrize("task", [MADI, pytest.param(ROCKER, marks=pytest.mark.soak)])
def test_a_hand_is_let_pass_what_marking_lets_pass(task: str) -> None:
    of, drawing = keyed_cam((), task), drawn_by_hand(task)

    told = {name: drawing.expected[name].allowed for name in of.key.questions}

    assert told == pytest.approx(dict(of.key.allowed), rel=1e-9)


def test_sizes_by_chords_are_drawn_by_the_hand_that_draws_what_they_stand_for() -> None:
    drawing = drawn_by_hand(MADI)

    for exact, chords in (("mu_s", "mu_s_chord"), ("r_0", "r_0_tangents"), ("r_0_flat_min", "r_0_flat_tangent")):
        assert drawing.expected[exact] is drawing.expected[chords]


ROLLER_ONLY = ("rho_flat", "margin", "r_0_flat")
PLATE_ONLY = ("gamma_rise", "gamma_fall", "R_roller", "e", "limits")


@pytest.mark.parametrize(
    ("follower", "unused", "only"),
    [
        ("roller", ROLLER_ONLY, "sizes"),
        pytest.param("plate", PLATE_ONLY, None, marks=pytest.mark.soak),
        pytest.param("roller", ROLLER_ONLY, "diagrams", marks=pytest.mark.soak),
    ],
)
def test_a_cam_for_one_follower_or_a_part_of_it_is_marked(
    follower: str, unused: tuple[str, ...], only: str | None, tmp_path: Path
) -> None:
    lines = bundled_text("madi-cam").replace('["roller", "plate"]', f'["{follower}"]').splitlines()
    (tmp_path / "own.toml").write_text(
        "\n".join(line for line in lines if line.partition(" =")[0] not in unused), encoding="utf-8"
    )

    asked_now = check(tmp_path / "own.toml", only=only, lang="en")
    solution = solve(tmp_path / "own.toml", only=only)
    form = asked_now.write_form(tmp_path / "form.csv").read_text(encoding="utf-8-sig")
    names = [name for line in form.splitlines() if (name := line.partition(",")[0]) in solution]
    values = (solution[name].shown(solution.words.display).value for name in names)
    rows = [f"{name},{value}" for name, value in zip(names, values, strict=True)]
    (tmp_path / "answers.csv").write_text("\n".join(("quantity,value", *rows)), encoding="utf-8")
    (answers,) = asked_now.read(str(tmp_path / "answers.csv"))

    assert "mu_s" in names
    assert ("r_0" in names, "r_0_flat" in names) == (only == "sizes", follower == "plate")
    assert asked_now.mark(answers).marked.mark == 100.0


@pytest.mark.parametrize("given", ["r_0", "e"])
def test_a_cam_whose_sizes_are_given_is_not_drawn_by_tangents(given: str) -> None:
    of = keyed_cam(((given, "60 mm" if given == "r_0" else "5 mm"),))

    assert given not in asked(of)
    assert {"r_0_tangents", "e_tangents", "s_0"} <= asked(of)
    assert of.key["s_0"] == of.solution["s_0"].value


def test_an_ordinate_on_paper_has_no_scale_factor() -> None:
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


def test_an_ordinate_alone_is_taken_by_the_scale_factor_that_was_found() -> None:
    key = keyed_cam().key

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
