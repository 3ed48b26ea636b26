"""Groups of every kind, all outer pairs moving, turning and accelerating, and loads of every kind, by the Jacobian.

Of each case some random mechanisms; with the marker `soak` so many that there are 10,000 of each kind of group. A third
of them are ten million times as large or as small. Errors are parts of the largest value of a kind (points, velocities,
forces ...) in the same mechanism.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import chain, cycle, product
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
    MOMENT,
    STROKE,
    WORKING,
    Diagram,
    Driver,
    Mechanism,
    Prismatic,
    Revolute,
    Stroke,
)
from kulman.plans.linkages.solved import _moment_points, board_givens
from kulman.plans.linkages.structure import analyse
from kulman.tests.support.dyads import (
    CENTRAL,
    KINDS,
    PAIRS,
    feeder,
    random_dyads,
    random_trains,
    random_triads,
    sliding_feeder,
)
from kulman.tests.support.jacobian_solver import JacobianSolver
from kulman.tests.support.mechanisms import one_of

Array = NDArray[Any]
TOLERANCE = 1e-10
KINDS_OF_VALUES = ("point", "V", "a", "omega", "epsilon", "force", "M")
Case = tuple[str, tuple[int, ...], tuple[bool, ...], bool]  # kind, links before, who carries the guides, bent links

ONE = [(False,), (True,)]
TWO = [(False, False), (False, True), (True, False), (True, True)]
INNER = [(False, False), (True, False), (True, True)]
DYADS: list[Case] = [
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
TRIADS: list[Case] = [
    *(("RRR", before, (), True) for before in ((1, 2, 3), (3, 1, 2), (1, 0, 0))),
    *(("RRR", (1, 2, 3), (), False), ("RRP", (1, 2, 3), (), True), ("RGR", (2, 3, 1), (), True)),
    *(("PRG", (1, 2, 3), (), True), ("RPP", (2, 1, 0), (), True), ("GPP", (3, 1, 2), (), True)),
]
MORE: list[Case] = [
    *(("RRR", before, (), True) for before in ((2, 3, 1), (1, 1, 2), (0, 2, 3))),
    *(("RRR", (2, 0, 0), (), False), ("RRP", (3, 1, 2), (), True), ("RRP", (1, 0, 0), (), True)),
    *(("RRP", (1, 2, 0), (), False), ("PPP", (1, 2, 3), (), True)),
]
LOADED: dict[Case, tuple[str, int]] = {  # what feeds them, the output link
    ("RRR", (2, 3), (), True): ("crank", 3),
    ("RRR", (1, 2), (), False): ("force", 3),
    ("RRR", (2, 0), (), True): ("slider", 5),
    ("RRP", (2, 0), (False,), True): ("force", 5),
    ("RRP", (3, 0), (False,), False): ("slider", 5),
    ("RRP", (2, 3), (True,), True): ("crank", 3),
    ("RPR", (2, 0), (True,), True): ("crank", 5),
    ("RPR", (2, 3), (False,), True): ("slider", 3),
    ("PRP", (2, 0), (False, False), True): ("crank", 5),
    ("PRP", (1, 2), (True, False), True): ("force", 3),
    ("RPP", (2, 0), (False, False), True): ("slider", 5),
    ("RPP", (1, 3), (True, True), True): ("force", 3),
    ("RRR", (2, 3, 0), (), True): ("crank", 3),
    ("RRP", (1, 2, 0), (), False): ("force", 7),
}


@dataclass(frozen=True, slots=True)
class Both:
    """Random mechanisms solved by the plans and by the Jacobian; `k` are their sizes."""

    k: Array
    mechanism: Mechanism
    program: Program
    values: dict[str, Array]
    results: dict[str, Array]
    codes: NDArray[np.int8]
    second: JacobianSolver


def solve_both(mechanism: Mechanism, values: dict[str, Array], places: Array, scaled: bool = True) -> Both:
    """Lengths times k, moments of inertia times k^2, so that forces grow as k and moments as k^2."""
    k = np.resize([1.0, 1.0, 1.0, 1.0, 1e-7, 1e7] if scaled else [1.0], len(places))
    power = {"x": 1, "y": 1, "e": 1, "J": 2, "F": 1, "M": 2}
    values = {name: array * k ** power.get(name.partition("_")[0], 0) for name, array in values.items()}
    places = places * np.stack([k, k, np.ones_like(k)], axis=1)[:, None, :]
    _, program = construct(mechanism)
    results, codes = batch(program, board_givens(mechanism, values, program), program.names)
    if mechanism.stroke is not None:
        plain = replace(mechanism, loads=(), couples=(), diagrams=(), stroke=None)
        own = JacobianSolver(plain, values, places).angle(mechanism.stroke.link)
        turning = next((results[name] for name in results if name in turning_names(mechanism)), None)
        angle = np.zeros(len(k)) if turning is None else np.angle(turning) - own
        values["output_angle"] = angle
    return Both(k, mechanism, program, values, results, codes, JacobianSolver(mechanism, values, places))


# Loads: weights, masses by length, resistances, diagrams, strokes, every driver and what balances it.
LOADS = [{}, {"direction": None}, {"magnitude": "P"}, {"stroke": WORKING}, {"direction": None, "stroke": IDLE}]


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
        places = tuple(given(f"{name}_at_{i}", at[i]) for i in range(5))
        return places, tuple(given(f"{name}_{i}", sizes[i]) for i in range(5))

    diagrams = [Diagram("P", STROKE, *nodes("P", 0.0, 1.0), nodes("back", 0.0, 1.0)[1])]
    driver = mechanism.driver
    if isinstance(driver, Driver):
        diagrams.append(Diagram("Q", ANGLE, *nodes("Q", -1.0, 4.0)))
        driver = replace(driver, balance=balance)
    moments = [{}, {"magnitude": diagrams[-1].name}, {"sense": None}, {"stroke": IDLE, "sense": None}, {}]
    links = []
    for link in mechanism.links:
        if len(joints_on(mechanism, link.number)) == 2:
            k = given(f"k_{link.number}", np.linspace(8.0, 12.0, size))
            link = replace(link, per_length=k, inertia_factor=given(f"j_{link.number}", np.linspace(0.1, 0.12, size)))
        links.append(link)
    made = replace(
        mechanism,
        links=tuple(links),
        driver=driver,
        loads=tuple(replace(load, **new) for load, new in zip(mechanism.loads, cycle(LOADS), strict=False)),
        couples=tuple(replace(couple, **new) for couple, new in zip(mechanism.couples, cycle(moments), strict=False)),
        diagrams=tuple(diagrams),
        stroke=Stroke(output, given("working", random.choice([-1.0, 1.0], size))),
        gravity=given("g", random.uniform(1.0, 20.0, size)),
    )
    values |= ends_of_stroke(made, values)
    return made


def joints_on(mechanism: Mechanism, number: int) -> set[str]:
    return {pair.point for pair in mechanism.pairs if isinstance(pair, Revolute) and number in pair.links}


def guided(mechanism: Mechanism) -> Prismatic | Revolute:
    """Return the pair of the output with the frame."""
    assert mechanism.stroke is not None
    return next(pair for pair in mechanism.pairs if {*pair.links} == {FRAME, mechanism.stroke.link})


def turning_names(mechanism: Mechanism) -> set[str]:
    """Directions that may turn with a rocker: from its pivot to another joint, or along its guide."""
    assert mechanism.stroke is not None
    number, pivot = mechanism.stroke.link, guided(mechanism).point
    return {f"e_{pivot}{other}" for other in joints_on(mechanism, number)} | {f"u_{number}4", f"u_4{number}"}


def ends_of_stroke(mechanism: Mechanism, values: dict[str, Array]) -> dict[str, Array]:
    """Ends anywhere about where the output stands; the direction of a rocker is taken from the plans."""
    geometry = replace(mechanism, loads=(), couples=(), diagrams=(), gravity=None)
    _, program = construct(geometry, ["position"])
    pair, random, size = guided(mechanism), np.random.default_rng(6), len(values["n_1"])
    slides = isinstance(pair, Prismatic)
    name = pair.point if slides else next(n for n in program.names if n in turning_names(mechanism))
    results, _ = batch(program, board_givens(geometry, values), [name])
    if isinstance(pair, Prismatic):
        x, y, along = (values.get(n, 0.0) for n in (*pair.through, pair.direction))
        place = ((results[name] - x - 1j * y) * np.exp(-1j * along)).real
    else:
        place = np.angle(results[name])
    length = random.uniform(0.3, 2.0 if slides else 6.0, size)
    begin = place - random.uniform(-0.2, 1.2, size) * length
    ends = [begin, begin + length]
    return dict(zip(("_stroke_begin", "_stroke_end"), ends if 3 in pair.links else ends[::-1], strict=True))


def cases() -> Iterator[Any]:
    few = DYADS[::4]  # of all kinds, with guides on either link, straight links and bent ones
    free = ((few, 30), (TRIADS[::3], 18), (DYADS, 2_000), (TRIADS, 1_250), (MORE, 1_250))
    groups = ((False, *group) for group in free), ((True, *group) for group in (([*LOADED][::3], 18), (LOADED, 1_000)))
    for under_loads, group, count in chain(*groups):
        for case in group:
            kind, before, carries, bent = case
            name = f"{kind}-{''.join(map(str, before))}{''.join('sg'[carried] for carried in carries)}{'-bent' * bent}"
            load = f"{LOADED[case][0]}-" if under_loads else ""
            marks = [pytest.mark.soak] if count >= 1_000 else []
            yield pytest.param((case, bool(load), count), id=f"{name}-{load}{count}", marks=marks)


@pytest.fixture(scope="module", params=[*cases()])
def both(request: pytest.FixtureRequest) -> Both:
    (kind, before, carries, bent), loads, count = request.param
    feed, output = LOADED[kind, before, carries, bent] if loads else ("crank", 0)
    if len(before) == 3:
        made = random_triads(kind, before, 78, count, bent)
    else:
        made = random_dyads(kind, before, carries, 77, count, bent, sliding_feeder if feed == "slider" else feeder)
    mechanism, values, places = made
    assert len(places) == count
    if loads:
        mechanism = loaded(mechanism, values, FORCE if feed == "force" else MOMENT, output)
    return solve_both(mechanism, values, places, scaled=not loads)


def kind_of(name: str) -> str:
    """Values of one kind are compared with the largest of them."""
    head = name.partition("_")[0]
    return "force" if head in ("F", "R", "G") else head if "_" in name else "point"


def wrong(results: Mapping[str, Any], expected: Mapping[str, Any], kinds: tuple[str, ...]) -> dict[str, float]:
    """Return by kind the errors above the tolerance."""
    found = {}
    for kind in kinds:
        names = [name for name in expected if kind_of(name) == kind and name in results]
        largest = np.max([np.abs(expected[name]) for name in names], axis=0)
        if kind == "M":  # the balancing moment may be a small remainder of the moments of large forces on the crank
            forces = [np.abs(expected[name]) for name in expected if kind_of(name) == "force"]
            arm = np.abs(expected["A"] - expected["O"]) if "O" in expected else 1.0
            largest = np.maximum(largest, np.max(forces, axis=0) * arm)
        errors = np.max([np.abs(results[name] - expected[name]) for name in names], axis=0)
        found[kind] = float(np.max(errors / largest))
    return {kind: error for kind, error in found.items() if not error <= TOLERANCE}


def test_positions_motion_and_forces_agree(both: Both) -> None:
    expected, results = both.second.expected, both.results
    unnamed = expected.keys() - results.keys()

    assert max(both.codes) == STATUSES.index("ok")
    assert wrong(results, expected, KINDS_OF_VALUES) == {}
    # what acts on the frame may go without a name, and so may the rates of a link that does not turn
    rates = {name for name in unnamed if name.startswith(("omega", "epsilon"))}
    assert all(np.max(np.abs(expected[name])) < 1e-9 for name in rates)
    assert [name for name in unnamed - rates if not re.fullmatch("(R|M)_[1-9]0", name)] == []


def test_points_of_one_link_under_a_point_of_another_agree(both: Both) -> None:
    found, expected = {}, {}
    for name in both.results:
        letters = re.fullmatch("V_([A-Z])([1-5])", name)
        if letters and name[2:] not in both.results:
            v, a = both.second.under(int(letters[2]), both.second.expected[letters[1]])
            found |= {name: both.results[name], f"a_{name[2:]}": both.results[f"a_{name[2:]}"]}
            expected |= {name: v, f"a_{name[2:]}": a}

    if found:
        assert wrong(found, expected, ("V", "a")) == {}


def test_reactions_of_guides_stand_where_their_moments_say(both: Both) -> None:
    """The moment is about the point that is named; the arm is the moment about the pin over the force."""
    named = _moment_points(both.mechanism, analyse(both.mechanism))
    results, second, points = both.results, both.second, both.second.expected
    largest = np.max([np.abs(points[p]) for p in "ABC"], axis=0)
    guides = [pair for pair in both.mechanism.pairs if isinstance(pair, Prismatic)]

    assert all(f"M_{a}{b}" in named for a, b in (pair.links for pair in guides))
    for name in (name for name in results if re.fullmatch(r"M_\d\d", name)):
        other, own = int(name[2]), int(name[3])
        moment = second.moment_at(own, other, points[named[name]])
        beside = np.abs(results[f"R_{other}{own}"]) * largest + np.abs(moment)
        assert np.max(np.abs(results[name] - moment) / beside) <= TOLERANCE, name
    for pair in guides:
        own, other, pin = pinned(pair, both.mechanism)
        if own > 3:
            arm = np.abs(second.moment_at(own, other, points[pin]) / results[f"R_{other}{own}"])
            assert np.max(np.abs(results[f"h_{other}{own}"] - arm) / np.maximum(arm, largest)) <= TOLERANCE


def pinned(pair: Prismatic, mechanism: Mechanism) -> tuple[int, int, str]:
    """Return the link of a prismatic pair on which the reaction is sought, the other one, and the pin counted from."""
    joints = {p.point: p.links for p in mechanism.pairs if isinstance(p, Revolute)}
    own = max(pair.links)
    if {*pair.links} == {4, 5}:  # RPR: the slider about its own pin; RPP: the hinged link about its pin
        own = pair.links[0] if "Q" in joints else 4
    return own, sum(pair.links) - own, next((p for p in "RPQ" if own in joints.get(p, ())), "P")


def test_what_balances_the_driver_balances_the_power_of_all_loads(both: Both) -> None:
    results = both.results
    drive = results["M_bal"] * results["omega_1"] if "M_bal" in results else results["F_bal"] * results["_V_A"]
    loads, drive = (power / both.k**2 for power in (both.second.power, drive))
    size = np.abs(loads) + np.abs(drive)

    assert np.max(np.abs(loads + drive) / size.clip(np.max(size) * 1e-6)) <= TOLERANCE * 10


def test_couples_of_a_link_are_summed_under_its_number(both: Both) -> None:
    numbers = {link.number for link in both.mechanism.links if f"M_i{link.number}" in both.results}
    for number in numbers:
        parts = [c.name for c in both.mechanism.couples if c.link == number] + [f"M_i{number}"]
        total = sum(both.results[part] for part in parts)
        assert np.allclose(both.results[f"M_sum_{number}"], total, rtol=1e-14, atol=0.0)
    assert {int(name[6:]) for name in both.results if re.fullmatch(r"M_sum_\d", name)} == numbers


def test_many_at_once_equal_one_at_a_time_to_the_last_bit(both: Both) -> None:
    names, count = both.program.names, len(both.codes)
    for index in range(0, count, max(1, count // (3 if count < 100 else 20))):
        board = run(both.program, board_givens(both.mechanism, one_of(both.values, index), both.program))
        different = [n for n in names if np.asarray(board.values[n]).tobytes() != both.results[n][index].tobytes()]
        assert (index, different) == (index, [])
        assert board.status == STATUSES[both.codes[index]]


def test_every_two_legs_of_a_triad_give_the_same(both: Both) -> None:
    group, expected = analyse(both.mechanism).groups[-1], both.second.expected
    for legs in PAIRS if both.mechanism.starts else ():
        starts = (replace(both.mechanism.starts[0], legs=legs),)
        program = construct(replace(both.mechanism, starts=starts))[1]
        other, _ = batch(
            program,
            board_givens(both.mechanism, both.values, program),
            [name for name in expected if name in program.names],
        )
        assert wrong(other, expected, KINDS_OF_VALUES) == {}
        assert (group.kind, group.links, group.central) == ("III", (4, 5, 6, 7), CENTRAL)


WAYS = {"series": ((1, 3), (5, 4)), "crank and dyad": ((2, 3), (1, 4)), "parallel": ((1, 2), (1, 3))}


def trains() -> Iterator[Any]:
    """Go through two dyads of every kind, hung on each other in one way; with the marker `soak` in all three."""
    for (i, middle), (j, last), (k, way) in product(enumerate(KINDS), enumerate(KINDS), enumerate(WAYS)):
        if (i + j) % len(WAYS) == k and (i - j) % 5 == 0:  # a few of the pairs
            yield pytest.param(middle, last, WAYS[way], 12, id=f"{way}-{middle}-{last}-12")
        yield pytest.param(middle, last, WAYS[way], 100, id=f"{way}-{middle}-{last}-100", marks=pytest.mark.soak)


@pytest.mark.parametrize(("middle", "last", "before", "count"), [*trains()])
def test_three_dyads_agree(middle: str, last: str, before: tuple[tuple[int, int], tuple[int, int]], count: int) -> None:
    both = solve_both(*random_trains((middle, last), before, 5, count))

    assert max(both.codes) == STATUSES.index("ok")
    assert len(both.codes) == count
    assert wrong(both.results, both.second.expected, KINDS_OF_VALUES) == {}
