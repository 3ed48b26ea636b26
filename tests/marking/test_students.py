"""Simulated students, who share nothing with the package, are marked as docs/marking.md says."""

from __future__ import annotations

import random

import pytest

from kulman import load_task, solve
from kulman.tests.support.drawn_by_hand import Hand, transposed
from kulman.tests.support.students import SEED, SLIPS, exact, honest, kinds, misread, random_data, written_value
from kulman.tests.support.students_marked import marked, one_mistake, population, printed, share

UNITY = 1e-9  # part by which the simulation may differ from the package
LEAST = 1e-3  # SI, of what is nothing


@pytest.mark.parametrize("task", SLIPS)
def test_the_simulation_without_errors_of_the_hand_agrees_with_the_program(task: str) -> None:
    dice = random.Random(SEED)
    cases = [(variant, printed(task, variant)) for variant in load_task(task).variants]
    cases += [(cases[0][0], random_data(task, dice)) for _ in range(4)]

    for variant, data in cases:
        quantities = solve(task, variant, set=data.settings).quantities
        lines = exact(task, data.givens).lines

        for name, line in lines.items():
            ours = quantities[name]
            value = complex(ours.x or 0.0, ours.y or 0.0) if ours.kind == "vector" else complex(ours.value)
            assert abs(written_value(line) - value) <= UNITY * max(abs(value), LEAST), (variant, name)
        drawn = {name for name, q in quantities.items() if q.scale and q.kind == "vector"}
        assert drawn - {"h_lever_F_5"} <= set(lines)


def test_a_usual_hand_errs_as_it_says() -> None:
    hand = Hand(random.Random(SEED))
    spots = [hand.spot(0j) for _ in range(4000)]
    lengths = [hand.length(0j, 40.2 + 0j) for _ in range(4000)]

    rms = (sum(abs(z) ** 2 for z in spots) / len(spots)) ** 0.5
    assert rms == pytest.approx(0.25 * 2**0.5, rel=0.05)
    assert all(mm * 2.0 == round(mm * 2.0) for mm in lengths)
    assert 0.2 <= (sum((mm - 40.2) ** 2 for mm in lengths) / len(lengths)) ** 0.5 <= 0.4


def test_digits_are_transposed() -> None:
    assert transposed(2.38) == 3.28
    assert transposed(-11.57) == -15.17
    assert transposed(1000.0) == 1000.0


@pytest.mark.soak
@pytest.mark.parametrize("task", SLIPS)
def test_every_planted_mistake_moves_a_line(task: str) -> None:
    dice = random.Random(SEED)

    for id in kinds(task):
        student = one_mistake(task, id, dice)

        assert max(student.moved.values()) >= 2.0, id
        assert misread(student.data.givens, ()) == student.data.givens


def test_honest_students_are_right() -> None:
    outcomes = marked(honest(task, dice) for dice in [random.Random(SEED)] for task in SLIPS for _ in range(5))

    assert 100.0 * sum(x.passed for x in outcomes) / sum(x.lines for x in outcomes) >= 99.0


def test_mistakes_of_simulated_students_are_found() -> None:
    ids = ("M07", "M26", "M30", "M38", "M49", "M57")
    outcomes = [one for id in ids for one in marked(population("one", id, 3, random.Random(f"{SEED} {id}")))]

    assert share(outcomes, lambda x: x.step) >= 90.0
    assert share(outcomes, lambda x: x.named) >= 85.0
