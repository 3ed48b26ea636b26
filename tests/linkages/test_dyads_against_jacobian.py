"""Dyads of every kind, both outer pairs moving, turning and accelerating, against a solver by the Jacobian.

Of each case 100 random mechanisms; with the marker `soak` 2,000, that is 10,000 of each kind and more. A third of them
are ten million times as large or as small. Errors are parts of the largest value of a kind (points, velocities, forces
...) in the same mechanism.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import product
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from kulman.plans.board import Program
from kulman.plans.boards.batch import batch
from kulman.plans.boards.exact import STATUSES, run
from kulman.plans.linkages.chain import construct
from kulman.plans.linkages.mechanism import Mechanism, Prismatic, Revolute
from kulman.plans.linkages.solved import board_givens, moment_points
from kulman.plans.linkages.structure import analyse
from kulman.tests.support.dyads import KINDS, random_dyads, random_trains
from kulman.tests.support.jacobian_solver import JacobianSolver

COUNT, MANY = 100, 2_000
TOLERANCE = 1e-10
ALL_KINDS = ("point", "V", "a", "omega", "epsilon", "force", "M")
Case = tuple[str, tuple[int, int], tuple[bool, ...], bool]  # kind, links before, who carries the guides, bent links
ONE = [(False,), (True,)]
TWO = [(False, False), (False, True), (True, False), (True, True)]
INNER = [(False, False), (True, False), (True, True)]
CASES: list[Case] = [
    *(("RRR", before, (), bent) for before in ((1, 2), (2, 3), (3, 1), (0, 2), (3, 0)) for bent in (True, False)),
    *(("RRP", before, one, True) for before in ((1, 2), (2, 3), (3, 1), (0, 2)) for one in ONE),
    *(("RRP", before, (False,), bent) for before in ((2, 0), (1, 3)) for bent in (True, False)),
    *(("RPR", before, one, True) for before in ((1, 2), (2, 3), (3, 1), (0, 2), (3, 0)) for one in ONE),
    *(("RPR", before, one, False) for before in ((1, 0), (2, 3)) for one in ONE),
    *(("PRP", before, two, True) for before in ((1, 2), (2, 3)) for two in TWO),
    *(("PRP", (0, before), (False, carried), True) for before in (2, 3) for carried in (False, True)),
    *(("PRP", before, (False, False), False) for before in ((1, 2), (3, 0))),
    *(("RPP", before, two, True) for before in ((1, 2), (2, 3), (3, 1)) for two in INNER),
    *(("RPP", before, (False, False), bent) for before in ((2, 0), (1, 0)) for bent in (True, False)),
]


def named(case: Case) -> str:
    """Name a case: kind, links before, who carries guides (s the link before, g the link of the dyad)."""
    kind, before, carries, bent = case
    return f"{kind}-{before[0]}{before[1]}{''.join('sg'[carried] for carried in carries)}{'-bent' if bent else ''}"


@dataclass(frozen=True, slots=True)
class Both:
    """Random mechanisms solved by the plans and by the Jacobian; `k` are their sizes."""

    k: NDArray[Any]
    mechanism: Mechanism
    program: Program
    values: dict[str, NDArray[Any]]
    results: dict[str, NDArray[Any]]
    codes: NDArray[np.int8]
    second: JacobianSolver


def solve_both(mechanism: Mechanism, values: dict[str, NDArray[Any]], places: NDArray[Any]) -> Both:
    """Lengths times k, moments of inertia times k^2, so that forces grow as k and moments as k^2."""
    k = np.resize([1.0, 1.0, 1.0, 1.0, 1e-7, 1e7], len(places))
    power = {"x": 1, "y": 1, "e": 1, "J": 2, "F": 1, "M": 2}
    values = {name: array * k ** power.get(name.partition("_")[0], 0) for name, array in values.items()}
    places = places * np.stack([k, k, np.ones_like(k)], axis=1)[:, None, :]

    _, program = construct(mechanism)
    results, codes = batch(program, board_givens(mechanism, values), program.names)
    return Both(k, mechanism, program, values, results, codes, JacobianSolver(mechanism, values, places))


@pytest.fixture(
    scope="module",
    params=[
        pytest.param((case, count), id=f"{named(case)}-{count}", marks=[pytest.mark.soak] if count == MANY else [])
        for count in (COUNT, MANY)
        for case in CASES
    ],
)
def both(request: pytest.FixtureRequest) -> Both:
    (kind, before, carries, bent), count = request.param
    return solve_both(*random_dyads(kind, before, carries, 77, count, bent))


def kind_of(name: str) -> str:
    """Values of one kind are compared with the largest of them."""
    head = name.partition("_")[0]
    return "force" if head in ("F", "R") else head if "_" in name else "point"


def wrong(results: Mapping[str, Any], expected: Mapping[str, Any], kinds: tuple[str, ...]) -> dict[str, float]:
    """Return by kind the errors above the tolerance."""
    found = {}
    for kind in kinds:
        names = [name for name in expected if kind_of(name) == kind and name in results]
        largest = np.max([np.abs(expected[name]) for name in names], axis=0)
        if kind == "M":  # the balancing moment may be a small remainder of the moments of large forces on the crank
            forces = [np.abs(expected[name]) for name in expected if kind_of(name) == "force"]
            largest = np.maximum(largest, np.max(forces, axis=0) * np.abs(expected["A"] - expected["O"]))
        errors = np.max([np.abs(results[name] - expected[name]) for name in names], axis=0)
        found[kind] = float(np.max(errors / largest))
    return {kind: error for kind, error in found.items() if not error <= TOLERANCE}


def test_positions_motion_and_forces_agree(both: Both) -> None:
    expected = both.second.expected

    unnamed = {name for name in expected if name not in both.results}

    assert len(both.codes) in (COUNT, MANY)
    assert max(both.codes) == STATUSES.index("ok")
    assert wrong(both.results, expected, ALL_KINDS) == {}
    # a link that does not turn has no angular velocity, and what acts on the frame may go without a name
    assert {name for name in unnamed if not re.fullmatch("(omega|epsilon)_[45]|(R|M)_[1-5]0", name)} == set()


def test_points_of_one_link_under_a_point_of_another_agree(both: Both) -> None:
    found, expected = {}, {}
    for name in both.results:
        letters = re.fullmatch("V_([A-Z])([1-5])", name)
        if letters and name[2:] not in both.results:
            point, number = letters[1], int(letters[2])
            v, a = both.second.under(number, both.second.expected[point])
            found |= {name: both.results[name], f"a_{name[2:]}": both.results[f"a_{name[2:]}"]}
            expected |= {name: v, f"a_{name[2:]}": a}

    if found:
        assert wrong(found, expected, ("V", "a")) == {}


def test_reactions_of_guides_stand_where_their_moments_say(both: Both) -> None:
    """The arm of a guide's reaction is its moment about the pin over the force."""
    results, second = both.results, both.second
    points = second.expected
    largest = np.max([np.abs(points[p]) for p in "ABC"], axis=0)
    for pair in both.mechanism.pairs:
        if isinstance(pair, Prismatic):
            own, other, pin = pinned(pair, both.mechanism)
            force = np.abs(results[f"R_{other}{own}"])

            arm = np.abs(second.moment_at(own, other, points[pin])) / force

            assert np.max(np.abs(results[f"h_{other}{own}"] - arm) / np.maximum(arm, largest)) <= TOLERANCE


def test_moments_of_guides_are_taken_about_the_points_that_are_named(both: Both) -> None:
    named = moment_points(both.mechanism, analyse(both.mechanism))
    results, points = both.results, both.second.expected
    largest = np.max([np.abs(points[p]) for p in "ABC"], axis=0)
    for name in (name for name in results if re.fullmatch(r"M_\d\d", name)):
        other, own = int(name[2]), int(name[3])

        expected = both.second.moment_at(own, other, points[named[name]])

        beside = np.abs(results[f"R_{other}{own}"]) * largest + np.abs(expected)
        assert np.max(np.abs(results[name] - expected) / beside) <= TOLERANCE, name
    assert all(f"M_{a}{b}" in named for p in both.mechanism.pairs if isinstance(p, Prismatic) for a, b in [p.links])


def pinned(pair: Prismatic, mechanism: Mechanism) -> tuple[int, int, str]:
    """Return the link of a prismatic pair on which the reaction is sought, the other one, and the pin counted from."""
    joints = {p.point: p.links for p in mechanism.pairs if isinstance(p, Revolute)}
    if set(pair.links) == {4, 5}:  # RPR: the slider about its own pin; RPP: the hinged link about its pin
        own = pair.links[0] if "Q" in joints else 4
        return own, 9 - own, next(point for point in "PQ" if own in joints.get(point, ()))
    own = max(pair.links)
    return own, min(pair.links), "R" if "R" in joints else "P"


def test_balancing_moment_balances_the_power_of_all_loads(both: Both) -> None:
    loads, drive = (power / both.k**2 for power in (both.second.power, both.results["M_bal"] * both.results["omega_1"]))

    size = np.abs(loads) + np.abs(drive)
    assert np.max(np.abs(loads + drive) / size.clip(np.max(size) * 1e-6)) <= TOLERANCE * 10


def test_many_at_once_equal_one_at_a_time_to_the_last_bit(both: Both) -> None:
    names = both.program.names

    for index in range(0, len(both.codes), len(both.codes) // (10 if len(both.codes) == COUNT else 60)):
        one = {name: float(array[index]) for name, array in both.values.items()}
        board = run(both.program, board_givens(both.mechanism, one))

        different = [n for n in names if np.asarray(board.values[n]).tobytes() != both.results[n][index].tobytes()]
        assert (index, different) == (index, [])
        assert board.status == STATUSES[both.codes[index]]


WAYS = {"series": ((1, 3), (5, 4)), "crank and dyad": ((2, 3), (1, 4)), "parallel": ((1, 2), (1, 3))}


def trains() -> Iterator[Any]:
    """Go through two dyads of every kind, hung on each other in one way; with the marker `soak` in all three."""
    for (i, middle), (j, last), (k, way) in product(enumerate(KINDS), enumerate(KINDS), enumerate(WAYS)):
        if (i + j) % len(WAYS) == k:
            yield pytest.param(middle, last, WAYS[way], 30, id=f"{way}-{middle}-{last}-30")
        yield pytest.param(middle, last, WAYS[way], 100, id=f"{way}-{middle}-{last}-100", marks=pytest.mark.soak)


@pytest.mark.parametrize(("middle", "last", "before", "count"), [*trains()])
def test_three_dyads_agree(middle: str, last: str, before: tuple[tuple[int, int], tuple[int, int]], count: int) -> None:
    both = solve_both(*random_trains((middle, last), before, 5, count))

    assert max(both.codes) == STATUSES.index("ok")
    assert len(both.codes) == count
    assert wrong(both.results, both.second.expected, ALL_KINDS) == {}
