"""Triads, all outer joints moving, turning and accelerating, against a solver by the Jacobian.

Of each case 34 random mechanisms, more than 300 together; with the marker `soak` 1,250 of more cases, that is 10,000
hinged triads and more than 10,000 with prismatic legs. A third of them are ten million times as large or as small.
Errors are parts of the largest value of a kind (points, velocities, forces ...) in the same mechanism.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from itertools import pairwise
from typing import Any

import numpy as np
import pytest

from kulman.plans.boards.batch import batch
from kulman.plans.boards.exact import STATUSES, run
from kulman.plans.linkages.chain import construct
from kulman.plans.linkages.mechanism import Mechanism, Prismatic
from kulman.plans.linkages.solved import board_givens
from kulman.tests.linkages.test_dyads_against_jacobian import (
    ALL_KINDS,
    TOLERANCE,
    Both,
    solve_both,
    wrong,
)
from kulman.tests.support.triads import CENTRAL, PAIRS, random_triads

COUNT, MANY = 34, 1_250
Case = tuple[str, tuple[int, int, int], bool]  # kinds of the legs, links before, bent links
CASES: list[Case] = [
    *(("RRR", before, True) for before in ((1, 2, 3), (3, 1, 2), (1, 0, 0))),
    ("RRR", (1, 2, 3), False),
    *((kinds, before, True) for kinds, before in (("RRP", (1, 2, 3)), ("RGR", (2, 3, 1)), ("PRG", (1, 2, 3)))),
    *((kinds, before, True) for kinds, before in (("RPP", (2, 1, 0)), ("GPP", (3, 1, 2)))),
]
MORE: list[Case] = [
    *(("RRR", before, True) for before in ((2, 3, 1), (1, 1, 2), (0, 2, 3))),
    ("RRR", (2, 0, 0), False),
    *((kinds, before, True) for kinds, before in (("RRP", (3, 1, 2)), ("RRP", (1, 0, 0)))),
    *((kinds, before, False) for kinds, before in (("RRP", (1, 2, 0)), ("PPP", (1, 2, 3)))),
]


def named(case: Case) -> str:
    kinds, before, bent = case
    return f"{kinds}-{''.join(map(str, before))}{'-bent' if bent else ''}"


@pytest.fixture(
    scope="module",
    params=[
        *(pytest.param((case, COUNT), id=f"{named(case)}-{COUNT}") for case in CASES),
        *(pytest.param((c, MANY), id=f"{named(c)}-{MANY}", marks=pytest.mark.soak) for c in (*CASES, *MORE)),
    ],
)
def both(request: pytest.FixtureRequest) -> Both:
    (kinds, before, bent), count = request.param
    return solve_both(*random_triads(kinds, before, 78, count, bent))


def test_positions_motion_and_forces_agree(both: Both) -> None:
    expected = both.second.expected

    unnamed = {name for name in expected if name not in both.results}

    assert len(both.codes) in (COUNT, MANY)
    assert max(both.codes) == STATUSES.index("ok")
    assert wrong(both.results, expected, ALL_KINDS) == {}
    # a slider on the frame does not turn, and what acts on the frame may go without a name
    assert {name for name in unnamed if name not in still(both.mechanism)} == set()


def still(mechanism: Mechanism) -> set[str]:
    on_frame = {n for pair in mechanism.pairs if 0 in pair.links for n in pair.links}
    sliders = {n for p in mechanism.pairs if 0 in p.links and isinstance(p, Prismatic) for n in p.links}
    return {f"R_{n}0" for n in on_frame} | {f"{symbol}_{n}" for n in sliders for symbol in ("omega", "epsilon")}


def test_every_two_legs_give_the_same(both: Both) -> None:
    expected = both.second.expected

    for legs in PAIRS if len(both.codes) == MANY else PAIRS[::2]:  # two of three by default
        other = solve_by(both, legs)

        assert wrong(other, expected, ALL_KINDS) == {}


def solve_by(both: Both, legs: tuple[int, int]) -> Mapping[str, Any]:
    """Solve with the special point of these two legs."""
    (start,) = both.mechanism.starts
    mechanism = replace(both.mechanism, starts=(replace(start, legs=legs),))
    program = construct(mechanism)[1]
    given = {name: value for name, value in both.second.expected.items() if name in program.names}
    return batch(program, board_givens(mechanism, both.values), [*given, "A", "O"])[0]


def test_legs_are_rigid_and_sliders_in_their_guides(both: Both) -> None:
    results, values = both.results, both.values
    for link in both.mechanism.links:
        joints = [point for point in link.points if point in "KLNPQR"]
        place = {point: values[x] + 1j * values[y] for point, (x, y) in link.points.items() if "zero" not in (x, y)}
        for first, second in pairwise(joints):
            if {first, second} <= place.keys():
                length = np.abs(place[second] - place[first])

                stretched = np.abs(np.abs(results[second] - results[first]) - length)

                assert np.max(stretched / length.clip(0.1 * both.k)) <= 1e-12


def test_reactions_of_guides_stand_where_their_moments_say(both: Both) -> None:
    results, second = both.results, both.second
    points = second.expected
    for pair in both.mechanism.pairs:
        if isinstance(pair, Prismatic):
            own = next(n for n in pair.links if n > 3)
            other = next(n for n in pair.links if n != own)
            pin = next(p for p in both.mechanism.link(own).points if p in "PQR")

            moment = second.moment_at(own, other, points[pin])

            largest = np.max([np.abs(moment), np.abs(results[f"R_{other}{own}"]) * both.k], axis=0)
            assert np.max(np.abs(results[f"M_{other}{own}"] - moment) / largest) <= TOLERANCE
            arm = np.abs(moment) / np.abs(results[f"R_{other}{own}"])
            assert np.max(np.abs(results[f"h_{other}{own}"] - arm) / arm.clip(both.k)) <= TOLERANCE


def test_balancing_moment_balances_the_power_of_all_loads(both: Both) -> None:
    loads, drive = (power / both.k**2 for power in (both.second.power, both.results["M_bal"] * both.results["omega_1"]))

    size = np.abs(loads) + np.abs(drive)
    assert np.max(np.abs(loads + drive) / size.clip(np.max(size) * 1e-6)) <= TOLERANCE * 10


def test_many_at_once_equal_one_at_a_time_to_the_last_bit(both: Both) -> None:
    names = both.program.names

    for index in range(0, len(both.codes), max(1, len(both.codes) // 3)):
        one = {name: float(array[index]) for name, array in both.values.items()}
        board = run(both.program, board_givens(both.mechanism, one))

        different = [n for n in names if np.asarray(board.values[n]).tobytes() != both.results[n][index].tobytes()]
        assert (index, different) == (index, [])
        assert board.status == STATUSES[both.codes[index]]


def test_triad_has_its_class_and_central_link(both: Both) -> None:
    structure, _ = construct(both.mechanism)

    group = structure.groups[-1]

    assert (group.kind, group.links, group.central) == ("III", (4, 5, 6, 7), CENTRAL)
