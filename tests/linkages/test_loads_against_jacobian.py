"""Weights, masses by length, loads that resist or act in one stroke, load diagrams, every driver and its balance.

Random mechanisms with dyads of every kind and with triads, against a solver by the Jacobian, and by virtual power. Of
each case 30 random mechanisms; with the marker `soak` 1,000. Errors are parts of the largest value of a kind.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from itertools import cycle
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from kulman.plans.board import Program
from kulman.plans.boards.batch import batch
from kulman.plans.boards.exact import STATUSES, run
from kulman.plans.linkages.chain import construct
from kulman.plans.linkages.mechanism import (
    ANGLE,
    FORCE,
    FRAME,
    IDLE,
    STROKE,
    WORKING,
    Diagram,
    Driver,
    Link,
    Mechanism,
    Prismatic,
    Revolute,
    Stroke,
)
from kulman.plans.linkages.solved import board_givens
from kulman.tests.support.dyads import feeder, random_dyads, sliding_feeder
from kulman.tests.support.jacobian_solver import JacobianSolver
from kulman.tests.support.triads import random_triads

Array = NDArray[Any]
COUNT, MANY = 30, 1_000
TOLERANCE = 1e-10
# kind, links before, who carries the guides, bent links, what feeds them, the output link
CASES = [
    ("RRR", (2, 3), (), True, "crank", 3),
    ("RRR", (1, 2), (), False, "force", 3),
    ("RRR", (2, 0), (), True, "slider", 5),
    ("RRP", (2, 0), (False,), True, "force", 5),
    ("RRP", (3, 0), (False,), False, "slider", 5),
    ("RRP", (2, 3), (True,), True, "crank", 3),
    ("RPR", (2, 0), (True,), True, "crank", 5),
    ("RPR", (2, 3), (False,), True, "slider", 3),
    ("PRP", (2, 0), (False, False), True, "crank", 5),
    ("PRP", (1, 2), (True, False), True, "force", 3),
    ("RPP", (2, 0), (False, False), True, "slider", 5),
    ("RPP", (1, 3), (True, True), True, "force", 3),
    ("RRR", (2, 3, 0), (), True, "crank", 3),
    ("RRP", (1, 2, 0), (), False, "force", 7),
]


@dataclass(frozen=True, slots=True)
class Both:
    """Random mechanisms solved by the plans and by the Jacobian."""

    mechanism: Mechanism
    program: Program
    values: dict[str, Array]
    results: dict[str, Array]
    codes: NDArray[np.int8]
    second: JacobianSolver


def loaded(mechanism: Mechanism, values: dict[str, Array], balance: str, output: int) -> Mechanism:
    """Give the mechanism loads of every kind, and masses by length where a link has two joints."""
    random, size = np.random.default_rng(5), len(values["n_1"])

    def given(name: str, value: Array) -> str:
        values[name] = value
        return name

    def nodes(name: str, low: float, high: float) -> tuple[tuple[str, ...], tuple[str, ...]]:
        at = np.sort(random.uniform(low, high, (5, size)), axis=0)
        at[2] = at[1]  # a jump
        sizes = random.uniform(-500, 500, (5, size))
        return (
            tuple(given(f"{name}_at_{i}", at[i]) for i in range(5)),
            tuple(given(f"{name}_{i}", sizes[i]) for i in range(5)),
        )

    places, forth = nodes("P", 0.0, 1.0)
    _, back = nodes("back", 0.0, 1.0)
    diagrams = [Diagram("P", STROKE, places, forth, back)]
    if isinstance(mechanism.driver, Driver):
        diagrams.append(Diagram("Q", ANGLE, *nodes("Q", -1.0, 4.0)))
    loads = tuple(
        replace(load, **changed)
        for load, changed in zip(
            mechanism.loads,
            cycle(
                [{}, {"direction": None}, {"magnitude": "P"}, {"stroke": WORKING}, {"direction": None, "stroke": IDLE}]
            ),
            strict=False,
        )
    )
    couples = tuple(
        replace(couple, **changed)
        for couple, changed in zip(
            mechanism.couples,
            cycle([{}, {"magnitude": diagrams[-1].name}, {"sense": None}, {"stroke": IDLE, "sense": None}, {}]),
            strict=False,
        )
    )
    joints = {link.number: joints_on(mechanism, link.number) for link in mechanism.links}
    links = tuple(by_length(link, given, size) if len(joints[link.number]) == 2 else link for link in mechanism.links)
    driver = mechanism.driver
    return replace(
        mechanism,
        links=links,
        driver=replace(driver, balance=balance) if isinstance(driver, Driver) else driver,
        loads=loads,
        couples=couples,
        diagrams=tuple(diagrams),
        stroke=Stroke(output, given("working", random.choice([-1.0, 1.0], size))),
        gravity=given("g", random.uniform(1.0, 20.0, size)),
    )


def joints_on(mechanism: Mechanism, number: int) -> set[str]:
    return {pair.point for pair in mechanism.pairs if isinstance(pair, Revolute) and number in pair.links}


def by_length(link: Link, given: Any, size: int) -> Link:
    k = given(f"k_{link.number}", np.linspace(8.0, 12.0, size))
    return replace(link, per_length=k, inertia_factor=given(f"j_{link.number}", np.linspace(0.1, 0.12, size)))


def ends_of_stroke(mechanism: Mechanism, values: dict[str, Array]) -> dict[str, Array]:
    """Ends anywhere about where the output stands; the direction of a rocker is taken from the plans."""
    geometry = replace(mechanism, loads=(), couples=(), diagrams=(), gravity=None)
    _, program = construct(geometry, ["position"])
    givens = board_givens(geometry, values)
    assert mechanism.stroke is not None
    number = mechanism.stroke.link
    pair = next(pair for pair in mechanism.pairs if {*pair.links} == {FRAME, number})
    random, size = np.random.default_rng(6), len(values["n_1"])
    if isinstance(pair, Prismatic):
        results, _ = batch(program, givens, [pair.point])
        x, y, along = (values.get(name, 0.0) for name in (*pair.through, pair.direction))
        place = ((results[pair.point] - x - 1j * y) * np.exp(-1j * along)).real
        length = random.uniform(0.3, 2.0, size)
    else:
        name = next(n for n in program.names if n in turning_names(mechanism, number))
        results, _ = batch(program, givens, [name])
        place, length = np.angle(results[name]), random.uniform(0.3, 6.0, size)
    begin = place - random.uniform(-0.2, 1.2, size) * length
    ends = [begin, begin + length]
    return dict(zip(("_stroke_begin", "_stroke_end"), ends if number == 3 else ends[::-1], strict=True))


def turning_names(mechanism: Mechanism, number: int) -> set[str]:
    """Directions that may turn with a rocker: from its pivot to another joint, or along its guide."""
    pair = next(p for p in mechanism.pairs if {*p.links} == {FRAME, number})
    return {f"e_{pair.point}{other}" for other in joints_on(mechanism, number)} | {f"u_{number}4", f"u_4{number}"}


def angle_of_direction(mechanism: Mechanism, second: JacobianSolver, results: dict[str, Array]) -> Array:
    """Angle of the plans' direction of the rocker against its own x axis."""
    assert mechanism.stroke is not None
    names = turning_names(mechanism, mechanism.stroke.link)
    name = next((name for name in results if name in names), None)
    angle = second.angle(mechanism.stroke.link)
    return np.zeros(second.size) if name is None else np.angle(results[name]) - angle


@pytest.fixture(
    scope="module",
    params=[
        pytest.param(
            (case, count),
            id=f"{case[0]}-{len(case[1])}-{case[4]}-{count}",
            marks=[pytest.mark.soak] if count == MANY else [],
        )
        for count in (COUNT, MANY)
        for case in CASES
    ],
)
def both(request: pytest.FixtureRequest) -> Both:
    (kind, before, carries, bent, feed, output), count = request.param
    feeds = sliding_feeder if feed == "slider" else feeder
    if len(before) == 3:
        mechanism, values, places = random_triads(kind, before, 41, count, bent)
    else:
        mechanism, values, places = random_dyads(kind, before, carries, 41, count, bent, feeds)
    mechanism = loaded(mechanism, values, FORCE if feed == "force" else "moment", output)
    values |= ends_of_stroke(mechanism, values)
    _, program = construct(mechanism)
    results, codes = batch(program, board_givens(mechanism, values, program), program.names)
    plain = JacobianSolver(replace(mechanism, loads=(), couples=(), diagrams=(), stroke=None), values, places)
    angle = angle_of_direction(mechanism, plain, results)
    second = JacobianSolver(mechanism, {**values, "output_angle": angle}, places)
    return Both(mechanism, program, values, results, codes, second)


def test_every_load_and_reaction_agrees(both: Both) -> None:
    expected = both.second.expected
    forces = {name for name in expected if name.partition("_")[0] in ("F", "R", "G")}
    moments = {name for name in expected if name.startswith("M")}

    assert max(both.codes) == STATUSES.index("ok")
    assert {f"G_{link.number}" for link in both.mechanism.links} <= forces
    assert errors(both.results, expected, forces) <= TOLERANCE
    assert errors(both.results, expected, moments, frozenset(forces)) <= TOLERANCE


def errors(
    results: Mapping[str, Array], expected: Mapping[str, Array], names: set[str], also: frozenset[str] = frozenset()
) -> float:
    """Largest error of `names` in parts of the largest of them (for moments also of the forces, on arms of metres)."""
    known = [name for name in names if name in results]
    assert len(known) >= len(names) - 5  # what acts on the frame has no name
    largest = np.max([np.abs(expected[name]) for name in (*names, *also)], axis=0)
    return float(np.max(np.max([np.abs(results[n] - expected[n]) for n in known], axis=0) / largest))


def test_what_balances_the_driver_balances_the_power_of_all_loads(both: Both) -> None:
    results, still = both.results, both.mechanism.frame_points
    power: list[Array] = []
    for link in both.mechanism.links:
        number, omega = link.number, results.get(f"omega_{link.number}", 0.0)
        hung = [(f"F_i{number}", link.centre), (f"G_{number}", link.centre)]
        for name, point in (*hung, *((load.name, load.point) for load in both.mechanism.loads_on(number))):
            if point not in still:
                power.append((results[name].conj() * results[f"V_{point}"]).real)
        couples = [c.name for c in both.mechanism.couples if c.link == number] + [f"M_i{number}"]
        power += [results[name] * omega for name in couples if name in results]
    if "M_bal" in results:
        power.append(results["M_bal"] * results["omega_1"])
    else:
        power.append(results["F_bal"] * results["_V_A"])

    assert np.max(np.abs(sum(power)) / np.sum(np.abs(power), axis=0)) <= 1e-11


def test_lever_agrees_with_the_force_plan(both: Both) -> None:
    name = "M_bal" if "M_bal" in both.results else "F_bal"
    forces = [n for n in both.results if n.startswith("R_")]
    largest = np.max([np.abs(both.results[n]) for n in forces], axis=0)

    assert np.max(np.abs(both.results[name] - both.results[f"{name}_lever"]) / largest) <= TOLERANCE


def test_many_at_once_equal_one_at_a_time_to_the_last_bit(both: Both) -> None:
    for index in range(0, len(both.codes), max(1, len(both.codes) // 20)):
        one = {name: float(array[index]) for name, array in both.values.items()}
        board = run(both.program, board_givens(both.mechanism, one, both.program))

        for name in both.program.names:
            assert np.asarray(board.values[name]).tobytes() == both.results[name][index].tobytes(), (index, name)


def test_sums_of_couples_are_named_by_their_links(both: Both) -> None:
    sums = {name for name in both.results if name.startswith("M_sum")}

    for name in sums:
        number = int(name[-1])
        parts = [c.name for c in both.mechanism.couples if c.link == number] + [f"M_i{number}"]
        assert np.allclose(both.results[name], sum(both.results[part] for part in parts), rtol=1e-14, atol=0.0)
    turning = {link.number for link in both.mechanism.links if f"M_i{link.number}" in both.results}
    assert {int(name[-1]) for name in sums} == turning
