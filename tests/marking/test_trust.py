"""Marks that a teacher can trust: nothing calculated hides, nothing is earned by chance, no sentence is false."""

from __future__ import annotations

import math
import random
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from kulman import check
from kulman.plans.marking.answers import Answer, Said, Verdict
from kulman.plans.marking.student import StudentBoard
from kulman.plans.marking.verdicts import Marking, mark
from kulman.tests.support.marking_cases import answer, key, mistakes, right_answers
from kulman.tests.support.students import SEED, SLIPS
from kulman.tests.support.students_marked import marked, population
from kulman.variants.marking.cells import rounded
from kulman.variants.marking.marked import Desk, Marked
from kulman.variants.marking.reading import Answers, Reply
from kulman.variants.marking.report import Report
from kulman.variants.marking.result import class_rows, result_of
from kulman.variants.roster import Who
from kulman.variants.shelf import bundled_text

TASK = "nau-slider-crank"
OF = key(TASK, "3")
DRAWN = {"V_BA": 1.03, "V_S2": 0.98, "a_B": 1.03, "a_S2": 0.97, "h_2": 0.95, "h_lever_F_i2": 1.04, "h_21": 1.05}


def said(**factors: float) -> list[Answer]:
    """Return right answers in sizes, some of them times a factor."""
    answers = right_answers(OF, directions=False)
    return [replace(a, value=(a.value or 0.0) * factors.get(a.name, 1.0)) for a in answers]


def drawn_by_hand(**factors: float) -> list[Answer]:
    """Return the answers of a student who has measured a little otherwise, and calculates from that."""

    def take(name: str, value: Any) -> tuple[Said | None, bool]:
        return (Said(abs(OF[name]) * DRAWN[name], None, None), True) if name in DRAWN else (None, False)

    board = StudentBoard(OF.paper.program, OF.paper.givens, take)
    board.go_on()
    values = {name: OF[name] * DRAWN[name] if name in DRAWN else board.follows[name] for name in OF.questions}
    return [answer(name, x * factors.get(name, 1.0), directions=False) for name, x in values.items()]


def handed_in(sizes: dict[str, float], task: str = TASK, variant: str = "3") -> Marked:
    """Mark values of one student at the desk."""
    lines = {name: Reply(name, value=value, place="form") for name, value in sizes.items()}
    return Desk(check(task, variant, lang="en")).mark(Answers("form", Who(), {}, lines, {}))


def right_sizes(**factors: float) -> dict[str, float]:
    return {name: abs(OF[name]) * factors.get(name, 1.0) for name in OF.questions}


def found(marking: Marking, *names: str) -> list[str]:
    return [str(marking[name].verdict) for name in names]


@pytest.mark.parametrize("factor", [0.98, 1.02, 1.08, 1.21])
@pytest.mark.parametrize("name", ["F_bal", "M_bal", "M_i2", "omega_2", "F_i2"])
def test_what_is_calculated_must_follow_from_the_students_own_numbers(name: str, factor: float) -> None:
    marking = mark(OF, drawn_by_hand(**{name: factor}))

    assert mark(OF, drawn_by_hand()).first_wrong is None
    assert marking[name].verdict is Verdict.WRONG
    assert marking.first_wrong == name
    assert marking[name].allowed < 0.012 * abs(marking[name].follows)


def test_a_calculated_line_is_shown_the_number_that_it_was_judged_by(tmp_path: Path) -> None:
    file = tmp_path / "answers.csv"
    rows = "".join(f"{a.name};{a.value}\n" for a in drawn_by_hand(F_bal=1.05))
    file.write_text(f"quantity;value\n{rows}", encoding="utf-8")
    asked = check(TASK, "3", lang="en")

    report: Report = asked.mark(asked.read(str(file))[0])

    row = next(row for _, rows in report.parts for row in rows if row.line.name == "F_bal")
    own = mark(OF, drawn_by_hand())["F_bal"].said
    assert row.right.endswith(f"→ {own:.4g} N")
    assert float(row.tolerance.split()[1]) < 0.01 * own


@pytest.mark.parametrize("id", ["M79", "M80"])
def test_moments_on_the_lever_that_are_lost_or_turned_are_found(id: str) -> None:
    book = mistakes(TASK)
    planted = [s for s in book.signatures if s.broken.mistake == id]

    for one in planted:
        answers = [answer(name, one.values[name], directions=False) for name in book.key.questions]
        marking = mark(book.key, answers)
        moved = [
            name
            for name in book.key.questions
            if abs(abs(one.values[name]) - abs(book.key[name])) > 0.02 * abs(book.key[name])
        ]
        assert planted
        assert marking.first_wrong == moved[0]


@pytest.mark.parametrize("called", ["M_3", "M_r", "T"])
def test_a_couple_hangs_wrong_on_the_lever_in_all_ways_whatever_it_is_called(called: str, tmp_path: Path) -> None:
    text = bundled_text("scheme-03-crank-rocker").replace('name = "M_3"', f'name = "{called}"')
    (tmp_path / "x.toml").write_text(text, encoding="utf-8")

    planted = [s.broken for s in mistakes(str(tmp_path / "x.toml")).signatures if s.broken.mistake == "M79"]

    ways = {(str(one.at), one.change.how) for one in planted}
    assert {how for at, how in ways if "sum" in at} == {how for at, how in ways if "i2" in at}
    assert len({how for _, how in ways}) == 3


def test_tolerances_follow_a_smaller_value_of_the_students_own() -> None:
    small = {"V_BA": 0.05, "omega_2": 0.05, "a_BA_n": 0.05**2}
    right, wrong = mark(OF, said(**small)), mark(OF, said(**{**small, "omega_2": 0.075, "a_BA_n": 2.0 * 0.05**2}))

    assert found(right, "V_BA", "omega_2", "a_BA_n") == ["wrong", "carried", "carried"]
    assert found(wrong, "V_BA", "omega_2") == ["wrong", "wrong"]


def test_half_of_the_last_digit_is_no_error() -> None:
    v, l = abs(OF["V_BA"]), OF.paper.givens["l_AB"]
    coarse = Answer("omega_2", value=16.0, rounded=0.5)

    assert abs(v / l - 16.0) > 0.01 * 16.0
    assert found(mark(OF, [Answer("V_BA", value=v), coarse]), "omega_2") == ["right"]
    assert found(mark(OF, [Answer("V_BA", value=v), replace(coarse, rounded=0.05)]), "omega_2") == ["wrong"]


@pytest.mark.parametrize(
    ("text", "value", "half"),
    [("16,3", 16.3, 0.05), ("16", 16.0, 0.5), ("2.5 kN", 2500.0, 50.0), ("1,20e3", 1200.0, 5.0), ("1/4", 0.25, None)],
)
def test_the_last_digit_of_a_number_is_known(text: str, value: float, half: float | None) -> None:
    assert rounded(text, value) == (None if half is None else pytest.approx(half))


@pytest.mark.parametrize("task", SLIPS)
def test_random_numbers_earn_next_to_nothing(task: str) -> None:
    outcomes = marked(population("random", task, 3, random.Random(SEED)))

    assert sum(x.mark for x in outcomes) / len(outcomes) <= 10.0


@pytest.mark.parametrize("task", ["nau-slider-crank", "scheme-09-shaper"])
def test_the_sheet_of_another_variant_is_told_and_earns_little(task: str) -> None:
    outcomes = marked(population("other", task, 3, random.Random(SEED)))

    assert all(x.fits for x in outcomes)
    assert max(x.mark for x in outcomes) <= 20.0


@pytest.mark.parametrize(
    ("task", "own", "other"), [("scheme-09-shaper", "1", "5"), ("scheme-14-jaw-crusher", "0", "1")]
)
def test_sizes_of_another_variant_earn_little_on_a_format_that_is_asked_for(task: str, own: str, other: str) -> None:
    desk = Desk(check(task, format="A3", lang="en"))
    theirs = desk.keyed(other, {}).key
    lines = {name: Reply(name, value=abs(theirs[name]), place="form") for name in theirs.questions}

    result = desk.mark(Answers("form", Who(), {"variant": own}, lines, {}, ()))

    assert result.fits == other
    assert result.mark <= 20.0


def test_lines_that_follow_from_mostly_wrong_numbers_are_told_apart() -> None:
    chaos = {name: 3.0 ** math.sin(40.0 * place) for place, name in enumerate(OF.questions)}
    chaos |= {"R_21": chaos["R_12"], "R_23": chaos["R_32"]}

    result = handed_in(right_sizes(**chaos))

    line = result.marking["R_21"]
    assert line.verdict is Verdict.UNCOUNTED
    assert result.marking.first_wrong == "V_A"
    assert result.mark <= 15.0
    header, row = list(class_rows([result_of(result, "en")], [], "en"))[:2]
    told = dict(zip(header, row, strict=True))
    assert told["follows from wrong numbers, not counted"] == result.count(Verdict.UNCOUNTED) > 0
    assert told["wrong here"] == result.count(Verdict.WRONG)


def test_a_size_that_is_wrong_is_not_called_right() -> None:
    right = OF["F_3"]
    marking = mark(
        OF, [Answer("F_3", value=15.1, direction=math.pi), Answer("V_B", value=abs(OF["V_B"]), direction=math.pi)]
    )

    assert abs(right) > 4000.0
    assert marking["F_3"].about == "size"
    assert marking["V_B"].about == "direction"


def test_what_all_later_lines_need_costs_more_than_a_side_value() -> None:
    whole = handed_in(right_sizes())
    needed = handed_in(right_sizes(V_BA=1.5))
    side = handed_in(right_sizes(V_S2=1.5))

    assert whole.mark == 100.0
    assert sum(whole.parts.values()) == pytest.approx(1.0)
    assert 100.0 - needed.mark >= 2.0 * (100.0 - side.mark) > 0.0


def test_questions_whose_answer_is_zero_do_not_count() -> None:
    result = handed_in({"h_03": 0.0, "M_03": 0.0})

    assert (result.parts["h_03"], result.parts["M_03"]) == (0.0, 0.0)
    assert result.mark == 0.0
    assert handed_in(right_sizes(), "scheme-09-shaper", "1").parts["R_12_n"] == 0.0
