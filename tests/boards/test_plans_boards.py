"""A board of another kind is one class with one method: a shaky hand, a student's values, a broken rule."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import pytest

from kulman import load_task, solve
from kulman.plans.board import POSITION, Program
from kulman.plans.boards.arrays import ArrayBoard
from kulman.plans.boards.exact import ExactBoard, run
from kulman.plans.linkages.chain import construct
from kulman.plans.linkages.solved import board_givens

TASK = load_task("nau-slider-crank")
PROGRAM = construct(TASK.mechanism)[1]
GIVENS = board_givens(TASK.mechanism, TASK.values("example"))
MARKS = ("lay", "back", "chain", "meet", "arc", "divide")
SAMPLES = 10_000


class ShakyHand(ArrayBoard):
    """Every mark is missed by some tenths of a millimetre on paper."""

    def __init__(self, givens: Mapping[str, Any], mus: Mapping[str, float], millimetres: float) -> None:
        super().__init__(givens, SAMPLES)
        self.mus, self.millimetres, self.random = mus, millimetres, np.random.default_rng(1)

    def step(self, verb: str, name: str, *operands: str, law: str = "") -> None:
        super().step(verb, name, *operands, law=law)
        if verb in MARKS:
            missed = self.random.normal(size=SAMPLES) + 1j * self.random.normal(size=SAMPLES)
            mu = self.mus[name.rpartition(".")[0] or POSITION]
            self.values[name] = self.values[name] + missed * (mu * self.millimetres)


class StudentsValues(ExactBoard):
    """What the student has said replaces a quantity where it is defined; it keeps our direction and sense."""

    def __init__(self, givens: Mapping[str, Any], said: Mapping[str, float]) -> None:
        super().__init__(givens)
        self.said = said

    def step(self, verb: str, name: str, *operands: str, law: str = "") -> None:
        super().step(verb, name, *operands, law=law)
        if verb in ("read", "calc") and name in self.said:
            self.values[name] *= self.said[name] / abs(self.values[name])


def shaken(millimetres: float) -> ShakyHand:
    solution = solve(TASK, "example")
    mus = {plan: solution.scales[symbol].mu for plan, symbol in solution.solved.scale_of_plan.items()}
    board = ShakyHand({name: np.full(SAMPLES, value) for name, value in GIVENS.items()}, mus, millimetres)
    PROGRAM.run(board)
    return board


def test_a_hand_that_does_not_shake_draws_the_exact_plan() -> None:
    board, exact = shaken(0.0), run(PROGRAM, GIVENS)

    for name in ("V_B", "a_B", "R_12", "M_bal"):
        assert np.all(np.abs(board.values[name] - exact.values[name]) <= 1e-12 * abs(exact.values[name]))


def test_a_shaky_hand_misses_in_proportion_to_its_errors() -> None:
    exact = run(PROGRAM, GIVENS).values["V_B"]
    fine, coarse = (np.std(np.abs(shaken(mm).values["V_B"])) / abs(exact) for mm in (0.05, 0.1))

    assert 0.001 < coarse < 0.01
    assert coarse / fine == pytest.approx(2.0, rel=0.02)


def test_what_follows_from_a_students_value_follows_and_what_does_not_stays() -> None:
    exact = run(PROGRAM, GIVENS).values
    board = StudentsValues(GIVENS, {"V_BA": 2.5})

    PROGRAM.run(board)

    ratio = 2.5 / abs(exact["V_BA"])
    assert board.values["omega_2"] == pytest.approx(exact["omega_2"] * ratio, rel=1e-12)
    assert abs(board.values["a_BA_n"]) == pytest.approx(abs(exact["a_BA_n"]) * ratio**2, rel=1e-12)
    assert board.values["V_B"] == exact["V_B"]


def test_a_broken_rule_is_one_step_rewritten() -> None:
    def wrong_way(program: Program) -> Program:
        """Lay the normal part off away from the centre."""
        steps = (s.but(verb="lay") if s.name == "acceleration.n_BA" else s for s in program)
        return Program(tuple(steps))

    right, wrong = run(PROGRAM, GIVENS).values, run(wrong_way(PROGRAM), GIVENS).values

    assert abs(wrong["a_BA_n"]) == pytest.approx(abs(right["a_BA_n"]), rel=1e-12)
    assert abs(wrong["a_B"]) > 1.2 * abs(right["a_B"])
    assert wrong["V_B"] == right["V_B"]
