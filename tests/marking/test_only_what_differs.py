"""Marking does again only what differs: it gives what the whole constructions give, to the last bit."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import pytest

from kulman.plans.boards.exact import run
from kulman.plans.marking.again import Judged
from kulman.plans.marking.answers import Line, Said, Verdict
from kulman.plans.marking.student import StudentBoard, settled
from kulman.plans.marking.verdicts import CLEAR, count_right, judge, mark
from kulman.plans.mistakes.book import key_of
from kulman.tests.support.marking_cases import LINKAGES, answer, key, mistakes, planted, right_answers

QUICK = "madi-four-bar"
TASKS = [pytest.param(task, marks=[pytest.mark.soak] * (task != QUICK)) for task in LINKAGES[1::8]]
FIRST = LINKAGES[1]


def same(found: Any, expected: Any) -> bool:
    return bool(found == expected or (found != found and expected != expected))


@pytest.mark.parametrize("task", TASKS)
def test_a_broken_construction_gives_what_a_whole_run_gives(task: str) -> None:
    for found in mistakes(task).signatures[::9]:
        whole = run(found.broken.program, found.broken.givens).values

        assert all(same(found.values[name], value) for name, value in whole.items()), found.broken.place


@pytest.mark.parametrize("task", TASKS)
def test_what_follows_for_a_student_is_the_same_from_made_values(task: str) -> None:
    of = key(task)
    for found in mistakes(task).signatures[5::40]:
        said = {a.name: Said(a.value, a.sense, None) for a in planted(mistakes(task), found, 1)}

        def take(name: str, value: Any, said: dict[str, Said] = said) -> tuple[Said | None, bool]:
            taken = said.get(name) if ord(name[-1]) % 2 == 0 else None
            return taken, taken is not None and len(name) % 2 == 0

        whole = StudentBoard(of.paper.program, of.paper.givens, take)
        again = StudentBoard(of.paper.program, of.values, take, made=True)
        whole.go_on()
        again.go_on()

        assert whole.follows.keys() == again.follows.keys()
        assert all(same(again.follows[name], value) for name, value in whole.follows.items())


def test_a_quantity_is_settled_where_nothing_changes_it_any_more() -> None:
    of = key(FIRST)
    taken = {name: Said(1.1 * abs(of[name]), None, None) for name in of.questions}
    whole, part = (
        StudentBoard(of.paper.program, of.paper.givens, lambda name, value: (taken.get(name), True)) for _ in "12"
    )
    whole.go_on()

    for name, end in settled(of.paper.program).items():
        if name in of.questions:
            part.go_on(end)
            assert same(part.follows[name], whole.follows[name])


@pytest.mark.parametrize("task", TASKS)
def test_what_is_clearly_wrong_or_mends_no_faulty_line_is_given_up(task: str) -> None:
    of, clearly, mended_nothing = mistakes(task), 0, 0
    for found in of.signatures[3::66]:
        answers = planted(of, found, 1)
        marking = mark(of.key, answers)
        first, faulty = str(marking.first_wrong), [line.name for line in marking.lines if line.verdict.faulty][-1:]
        judged = Judged(marking.marker, marking.lines)
        for other in of.signatures[::20] if faulty else ():
            under = key_of(of.key, other)
            whole, some = judge(under, answers), judge(under, answers, first)
            assert whole is not None
            line = next(line for line in whole if line.name == first)
            assert (some is None) == (line.verdict.faulty and line.off > CLEAR)
            assert some is None or [one.verdict for one in some] == [one.verdict for one in whole]

            under = key_of(marking.key, other)
            kept, again = judge(under, judged.answers, first), judged.under(under, first, faulty)
            mended = kept is not None and any(x.name in faulty and not x.verdict.faulty for x in kept)
            assert (again is not None) == mended, (found.broken.place, other.broken.place)
            clearly += some is None
            mended_nothing += kept is not None and again is None
    assert min(clearly, mended_nothing) > 0


def test_a_mistake_is_given_up_where_all_that_is_asked_is_a_slip_beside_it() -> None:
    of = mistakes(QUICK)
    found = next(one for one in of.signatures if one.broken.place[:2] == ("M20", "V_S3"))
    answers = [replace(one, value=3.0 * one.value) if one.name == "M_3" else one for one in planted(of, found, 1)]
    marking = mark(of.key, answers)
    judged, under, first = Judged(marking.marker, marking.lines), key_of(marking.key, found), str(marking.first_wrong)

    assert first != "M_3"
    assert next(line for line in marking.lines if line.name == "M_3").verdict.faulty
    assert judged.under(under, first, [first]) is not None
    assert judged.under(under, first, ["M_3"]) is None


def like(line: Line, other: Line) -> bool:
    faulty = line.verdict.faulty is other.verdict.faulty
    return faulty and all(same(getattr(line, x), getattr(other, x)) for x in ("off", "follows", "said", "allowed"))


@pytest.mark.parametrize("by_value", [False, True])
@pytest.mark.parametrize("task", TASKS)
def test_answers_judged_again_are_judged_as_by_the_whole_construction(task: str, by_value: bool) -> None:
    of, kept = mistakes(task), 0
    for found in of.signatures[3::66]:
        marking = mark(of.key, planted(of, found, 1))
        judged = Judged(marking.marker, marking.lines)
        judged = judged.by_value() if by_value else judged
        for other in of.signatures[::60] if marking.first_wrong else ():
            under = key_of(marking.key, other)
            whole, again = judge(under, judged.answers), judged.under(under)

            assert whole is not None
            assert again is not None
            wrong = [line.name for line, one in zip(again, whole, strict=True) if not like(line, one)]
            assert not wrong, (found.broken.place, other.broken.place)
            kept += sum(line is one for line, one in zip(again, marking.lines, strict=True))
    assert kept > 0


@pytest.mark.parametrize("task", TASKS)
def test_right_lines_are_counted_as_marked_unless_they_are_too_few(task: str) -> None:
    of = key(task)
    right = right_answers(of)
    answers = [answer(a.name, of[a.name] * (3.0 if place % 5 == 2 else 1.0)) for place, a in enumerate(right)]

    count = sum(line.verdict is Verdict.RIGHT for line in mark(of, answers).lines)

    assert 0 < count < len(answers)
    assert count_right(of, answers, 0.0) == count_right(of, answers, count) == count
    assert count_right(of, answers, math.nextafter(count, math.inf)) == 0
