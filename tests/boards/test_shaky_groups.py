"""The shaky hand on random dyads of every kind and on triads: exact without errors, linear in small ones."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from kulman.plans.boards.batch import batch
from kulman.plans.hands.shaky import Hand, Paper, draw
from kulman.plans.linkages.chain import construct
from kulman.plans.linkages.mechanism import Mechanism
from kulman.plans.linkages.solved import board_givens
from kulman.tests.support.dyads import random_dyads
from kulman.tests.support.mechanisms import SEED
from kulman.tests.support.triads import random_triads

Array = NDArray[Any]
STEADY, SMALL = Hand(0.0, 0.0, 0.0), Hand(1e-6, 1e-5, 1e-6)
DYADS: dict[str, tuple[str, tuple[int, int], tuple[bool, ...]]] = {
    "RRR": ("RRR", (1, 2), ()),
    "RRP": ("RRP", (2, 3), (True,)),
    "RPR": ("RPR", (2, 3), (False,)),
    "PRP": ("PRP", (1, 2), (True, False)),
    "RPP": ("RPP", (3, 1), (True, True)),
}
TRIADS = {
    "RRR legs": ("RRR", (1, 2, 3)),
    "a leg that slides": ("RPR", (1, 0, 3)),
    "a leg with a guide": ("GRR", (2, 0, 1)),
}
COUNTS = [20, pytest.param(400, marks=pytest.mark.soak)]
GROUPS = [*DYADS, *TRIADS]


def drawing(group: str, count: int) -> tuple[Mechanism, Paper]:
    """Return random mechanisms, one drawing of each, every plan to the scale 1."""
    if group in DYADS:
        kind, before, carries = DYADS[group]
        mechanism, values, _ = random_dyads(kind, before, carries, SEED, count)
    else:
        legs, on = TRIADS[group]
        mechanism, values, _ = random_triads(legs, on, SEED, count)
    _, program = construct(mechanism)
    return mechanism, Paper(program, board_givens(mechanism, values, program), dict.fromkeys(program.plans, 1.0))


@pytest.mark.parametrize("count", COUNTS)
@pytest.mark.parametrize("group", GROUPS)
def test_hands_without_errors_draw_groups_of_every_kind_to_the_last_bit(group: str, count: int) -> None:
    _, paper = drawing(group, count)
    expected, codes = batch(paper.program, paper.givens, paper.program.names)

    board = draw(paper, STEADY, np.random.default_rng(SEED), len(codes))

    assert np.array_equal(board.codes, codes)
    assert board.missed == set()
    for name in paper.program.names:
        found = np.broadcast_to(board.values[name], codes.shape)
        assert (found + 0.0).tobytes() == (expected[name] + 0.0).tobytes(), name


@pytest.mark.parametrize("count", COUNTS)
@pytest.mark.parametrize("group", GROUPS)
def test_small_errors_come_through_in_proportion(group: str, count: int) -> None:
    """Twice the errors of every act, the same ones, make twice the misses of what all of them come to."""
    _, paper = drawing(group, count)
    exact, one, two = (
        draw(paper, SMALL.times(factor), np.random.default_rng(SEED), count).values for factor in (0.0, 1.0, 2.0)
    )

    for name in [name for name in paper.program.names if name.startswith(("V_", "a_", "R_", "M_bal", "F_bal"))]:
        first, second = one[name] - exact[name], two[name] - exact[name]
        noise = 1e-9 * (np.abs(exact[name]) + np.max(np.abs(exact[name])) * 1e-3)
        bent = np.abs(second - 2.0 * first) / np.maximum(np.abs(first), noise)
        assert np.median(bent) < 1e-2, name
        assert np.mean(bent < 0.05) > 0.9, name
