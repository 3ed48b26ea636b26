"""Simulated students, drawn by a hand that shares nothing with the package, are marked as the guide to marking says."""

from __future__ import annotations

import random

import pytest

from kulman import load_task, solve
from kulman.tests.support import students as simulated
from kulman.tests.support.drawn_by_hand import Hand, transposed
from kulman.tests.support.students import SEED, SLIPS, Data, Student, marked, population, share

UNITY = 1e-9  # part by which the simulation may differ from the package
LEAST = 1e-3  # SI, of what is nothing


@pytest.mark.parametrize("task", SLIPS)
def test_the_simulation_without_errors_of_the_hand_agrees_with_the_program(task: str) -> None:
    dice = random.Random(SEED)
    cases = [(variant, simulated.printed(task, variant)) for variant in load_task(task).variants]
    cases += [(cases[0][0], simulated.random_data(task, dice)) for _ in range(4)]

    for variant, data in cases:
        quantities = solve(task, variant, set=data.settings).quantities
        lines = simulated.exact(task, data.givens).lines

        for name, line in lines.items():
            ours = quantities[name]
            value = complex(ours.x or 0.0, ours.y or 0.0) if ours.kind == "vector" else complex(ours.value)
            assert abs(simulated.written_value(line) - value) <= UNITY * max(abs(value), LEAST), (variant, name)
        drawn = {name for name, q in quantities.items() if q.scale and q.kind == "vector"}
        assert drawn - {"h_lever_F_5"} <= set(lines)


def test_a_usual_hand_errs_as_it_says_and_transposes_digits() -> None:
    hand = Hand(random.Random(SEED))
    spots = [hand.spot(0j) for _ in range(4000)]
    lengths = [hand.length(0j, 40.2 + 0j) for _ in range(4000)]

    assert (sum(abs(z) ** 2 for z in spots) / len(spots)) ** 0.5 == pytest.approx(0.25 * 2**0.5, rel=0.05)
    assert all(mm * 2.0 == round(mm * 2.0) for mm in lengths)
    assert 0.2 <= (sum((mm - 40.2) ** 2 for mm in lengths) / len(lengths)) ** 0.5 <= 0.4
    assert [transposed(x) for x in (2.38, -11.57, 2200.0, 2222.0)] == [3.28, -15.17, 2020.0, 2222.0]


@pytest.mark.soak
@pytest.mark.parametrize("task", SLIPS)
def test_every_planted_mistake_moves_a_line(task: str) -> None:
    dice = random.Random(SEED)

    students = [simulated.one_mistake(task, id, dice) for id in simulated.kinds(task)]

    shown = [student for student in students if student is not None]
    assert len(shown) >= len(students) - 1  # of one a rate hardly changes in any of the variants
    assert all(max(student.moved.values()) >= simulated.CLEAR for student in shown)
    assert all(simulated.misread(student.data.givens, ()) == student.data.givens for student in shown)


def first_two(task: str) -> tuple[Data, ...]:
    """Return a few of the variants: their answer keys are made once."""
    return simulated.pool(task)[:2]


def test_honest_students_are_right() -> None:
    dice = random.Random(SEED)
    outcomes = marked(simulated.honest(task, dice, first_two(task)) for task in SLIPS for _ in range(6))

    assert 100.0 * sum(x.passed for x in outcomes) / sum(x.lines for x in outcomes) >= 99.0


@pytest.mark.parametrize("every", [pytest.param(15, id="few"), pytest.param(1, id="all", marks=pytest.mark.soak)])
def test_mistakes_of_simulated_students_are_found(every: int) -> None:
    ids = sorted({slip.id for slips in SLIPS.values() for slip in slips})
    dice, students = random.Random(SEED), list[Student]()
    for id in ids[::every]:
        students += population("one", id, 3, dice, (0, 16))
    outcomes = marked(students)

    assert share(outcomes, lambda x: x.step) >= 90.0
    assert share(outcomes, lambda x: x.named) >= 85.0
    assert share(outcomes, lambda x: bool(x.names) and not x.named) <= 6.0
    assert share(outcomes, lambda x: not x.first) <= 2.0


@pytest.mark.soak
def test_both_of_two_mistakes_are_named() -> None:
    dice = random.Random(SEED)
    outcomes = marked([x for task in SLIPS for x in population("two", task, 20, dice, (0, 16))])

    assert share(outcomes, lambda x: x.named) >= 75.0
