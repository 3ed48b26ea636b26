"""A thousand random slider-cranks against the second solver, every quantity (make soak)."""

from __future__ import annotations

import pytest

from kulman.plans.boards.exact import run
from kulman.plans.linkages.chain import construct
from kulman.plans.linkages.solved import board_givens
from kulman.tests.linkages.test_plans_second_solver import differing, quantities
from kulman.tests.support.mechanisms import general_slider_crank, one_of, random_slider_cranks
from kulman.tests.support.second_solver import SecondSolver


@pytest.mark.soak
@pytest.mark.parametrize("seed", range(10))
def test_every_quantity_of_a_hundred_random_mechanisms_agrees(seed: int) -> None:
    mechanism, values = general_slider_crank(), random_slider_cranks(1000 + seed, 100)
    _, program = construct(mechanism)
    names = quantities(program)

    for index in range(100):
        one = one_of(values, index)
        board = run(program, board_givens(mechanism, one))

        assert differing(board, SecondSolver(mechanism, one), names, 1e-11) == {}, (seed, index)


@pytest.mark.soak
@pytest.mark.parametrize("seed", range(3))
def test_ill_conditioned_mechanisms_lose_no_more_than_their_sine_says(seed: int) -> None:
    mechanism, values = general_slider_crank(), random_slider_cranks(2000 + seed, 100, least_sine=1e-4)
    _, program = construct(mechanism)
    names = quantities(program)

    for index in range(100):
        one = one_of(values, index)
        board = run(program, board_givens(mechanism, one))

        loss = min(board.sines.values()) ** 4  # position, velocity, acceleration and force plan meet at this angle
        assert differing(board, SecondSolver(mechanism, one), names, 1e-12 / loss) == {}, (seed, index)
