"""Compound motion: it agrees with the plans for random trains of dyads, and its parts are what the theorems say.

Of each train 300 random mechanisms, bent links, a crank that speeds up; with the marker `soak` 10,000.
"""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from kulman.plans.boards.batch import batch
from kulman.plans.linkages.chain import construct, hinged
from kulman.plans.linkages.compound import COMPOUND, Coupler
from kulman.plans.linkages.mechanism import Driver, Link, Mechanism, Prismatic, Revolute
from kulman.plans.linkages.solved import board_givens, disagreement, solve_linkage
from kulman.tests.support.dyads import KINDS, LEAST_SINE, LEAST_SINE_BEFORE, Workshop, chosen, feeder
from kulman.tests.support.mechanisms import ORIGIN, nau_slider_crank, nau_values

Array = NDArray[np.complex128]
Train = tuple[tuple[str, tuple[int, int], tuple[bool, ...]], ...]
TRAINS: dict[str, Train] = {
    "coupler and rocker": (),
    "three rockers": (("RRR", (3, 0), ()), ("RRR", (5, 0), ())),
    "five dyads": (
        ("RRR", (3, 0), ()),
        ("RRR", (0, 5), ()),
        ("RRR", (6, 0), ()),
        ("RRP", (9, 0), (False,)),
    ),
    "two couplers meet": (("RRR", (1, 3), ()),),
    "rocker hangs on a coupler": (("RRR", (3, 2), ()),),
    "slider on the frame": (("RRP", (3, 0), (False,)),),
    "slider on a link": (("RRP", (3, 2), (False,)),),
    "slider with the guide": (("RRP", (1, 3), (True,)),),
    "slotted lever": (("RPR", (1, 0), (False,)), ("RRP", (5, 0), (False,))),
}
LETTERS = ("PQRTU", "KLNWX", "FGHIJ", "VYZab")
COUPLERS = {
    "coupler and rocker": (2,),
    "three rockers": (2, 4, 6),
    "five dyads": (2, 4, 7, 8, 10),
    "two couplers meet": (2, 4, 5),
    "rocker hangs on a coupler": (2, 4),
    "slider on the frame": (2, 4),
    "slider on a link": (2, 4),
    "slider with the guide": (2, 4),
    "slotted lever": (2, 6),
}


def random_train(train: Train, count: int) -> tuple[Mechanism, dict[str, NDArray[np.float64]]]:
    """Return mechanisms of a crank, links 2 and 3, and the dyads of `train` after them; no sine below 0.2."""
    w = Workshop(np.random.default_rng(20240607), count * (3 + 2 * len(train)) + 100)
    feeder(w)
    for k, (kind, before, carries) in enumerate(train):
        w.numbers, w.letters = (4 + 2 * k, 5 + 2 * k), LETTERS[k]
        KINDS[kind](w, before, carries)
        w.sines[-1] = w.sines[-1] * (LEAST_SINE / LEAST_SINE_BEFORE)
    mechanism, values, _ = chosen(w, count, 3 + 2 * len(train))
    assert len(values["phi"]) == count
    return mechanism, values


def run(mechanism: Mechanism, values: dict[str, NDArray[np.float64]]) -> dict[str, Array]:
    _, program = construct(mechanism, ("compound",))
    results, codes = batch(program, board_givens(mechanism, values), program.names)
    assert not codes.any()
    return results


def largest(results: dict[str, Array], kind: str, letter: str) -> NDArray[np.float64]:
    """Return the longest vector of the figure of a point."""
    return np.max([abs(results[f"{kind}_{letter}_{part}"]) for part in COMPOUND[kind]], axis=0)


def cases(*trains: str) -> list[object]:
    return [
        pytest.param(name, count, id=f"{name}-{count}", marks=[pytest.mark.soak] if count > 1000 else [])
        for name in trains
        for count in (300, 10_000)
    ]


@pytest.mark.parametrize(("train", "count"), cases(*TRAINS))
def test_compound_motion_agrees_with_the_plans(train: str, count: int) -> None:
    mechanism, values = random_train(TRAINS[train], count)

    results = run(mechanism, values)
    found = hinged(mechanism, construct(mechanism, ())[0])

    assert tuple(sorted(c.number for c in found)) == COUPLERS[train]
    letters = [(point, letter) for c in found for point, letter in c.letters.items()]
    for kind in COMPOUND:
        size = np.max([largest(results, kind, letter) for _, letter in letters], axis=0)
        for point, letter in letters:
            gap = abs(results[f"_{kind}_{letter}_total"] - results[f"{kind}_{point}"])
            assert np.all(gap <= 1e-12 * size), (kind, letter)


@pytest.mark.parametrize("train", TRAINS)
def test_parts_are_those_of_the_theorems(train: str) -> None:
    mechanism, values = random_train(TRAINS[train], 300)

    got = run(mechanism, values)

    for c in hinged(mechanism, construct(mechanism, ())[0]):
        we, ee = got[c.omega_e], got.get(c.epsilon_e)
        wr, er = got[f"omega_{c.number}"] - we, got[f"epsilon_{c.number}"] - ee
        same(got[f"omega_r_{c.number}"], wr, abs(we) + abs(wr))
        same(got[f"epsilon_r_{c.number}"], er, abs(ee) + abs(er) + we**2 + wr**2)
        for point, letter in c.letters.items():
            from_pivot, from_hinge = got[point] - got[c.pivot], got[point] - got[c.hinge]
            expected = {
                "V_e": 1j * we * from_pivot,
                "V_r": 1j * wr * from_hinge,
                "a_en": -(we**2) * from_pivot,
                "a_et": 1j * ee * from_pivot,
                "a_rn": -(wr**2) * from_hinge,
                "a_rt": 1j * er * from_hinge,
                "a_k": 2j * we * 1j * wr * from_hinge,
            }
            for name, value in expected.items():
                kind, part = name.split("_")
                same(got[f"{kind}_{letter}_{part}"], value, largest(got, kind, letter))
            same(got[f"l_{c.pivot}{point}"], abs(from_pivot), abs(from_pivot))


@pytest.mark.parametrize("train", TRAINS)
def test_line_of_the_end_closes_a_figure_where_the_other_link_of_the_dyad_hangs_on_the_frame(train: str) -> None:
    mechanism, _ = random_train(TRAINS[train], 2)
    on_frame = {n for pair in mechanism.pairs if 0 in pair.links for n in pair.links}

    for c in hinged(mechanism, construct(mechanism, ())[0]):
        other = c.number ^ 1  # dyads are links 2 and 3, 4 and 5 ...
        assert (c.closing is not None) == (other in on_frame), c.number


@pytest.mark.parametrize("train", ["three rockers", "slider on a link", "slotted lever"])
def test_instant_centre_stands_still_on_the_line_of_the_pivots(train: str) -> None:
    mechanism, values = random_train(TRAINS[train], 300)

    got = run(mechanism, values)

    for c in hinged(mechanism, construct(mechanism, ())[0]):
        P, omega = got[c.centre], got[f"omega_{c.number}"]
        line, way = got[c.hinge] - got[c.pivot], P - got[c.pivot]
        v = got[f"V_{c.hinge}"] + 1j * omega * (P - got[c.hinge])
        assert np.all(abs(v) <= 1e-11 * (abs(got[f"V_{c.hinge}"]) + abs(omega * P)))
        assert np.all(abs((line.conj() * way).imag) <= 1e-12 * abs(line) * (abs(way) + abs(got[c.pivot])))
        same(got[f"l_{c.hinge}P{c.number}"], abs(P - got[c.hinge]), abs(P))
        same(got[f"l_{c.pivot}P{c.number}"], abs(way), abs(way))


def same(value: Array, expected: Array, size: NDArray[np.float64]) -> None:
    assert np.all(abs(value - expected) <= 1e-11 * size + 1e-300)


def test_one_position_equals_the_batch() -> None:
    mechanism, values = random_train(TRAINS["five dyads"], 20)
    results = run(mechanism, values)

    for i in range(20):
        one = solve_linkage(mechanism, {name: float(value[i]) for name, value in values.items()}, ("compound",))
        for name in results:
            assert one.values[name] == results[name][i], name
        assert (disagreement(one) or 0.0) < 1e-12


def parallelogram() -> Mechanism:
    """Two equal cranks 1 and 3 and a coupler 2 as long as the frame: it never turns."""
    return Mechanism(
        links=(
            Link(1, {"O": ORIGIN, "A": ("r", "zero")}),
            Link(2, {"A": ORIGIN, "B": ("l", "zero")}),
            Link(3, {"C": ORIGIN, "B": ("r", "zero")}),
        ),
        pairs=(
            Revolute("O", (0, 1), ORIGIN),
            Revolute("A", (1, 2)),
            Revolute("B", (2, 3), branch="side"),
            Revolute("C", (0, 3), ("l", "zero")),
        ),
        driver=Driver(1, "O", "A", "phi", "n_1", "sense"),
    )


def test_link_that_does_not_turn_has_no_instant_centre() -> None:
    values = {"r": 0.5, "l": 1.0, "phi": np.pi / 2, "n_1": 2.0, "sense": 1.0, "side": 1.0}

    solved = solve_linkage(parallelogram(), values, ("compound",))

    assert solved.status == "ok"
    assert solved.quantities["omega_2"].value == pytest.approx(0.0, abs=1e-15)
    assert solved.quantities["omega_r_2"].value == pytest.approx(-2.0)
    assert solved.quantities["P_2"].to_json() == {"unit": "m", "x": None, "y": None}
    assert solved.quantities["l_AP2"].value is None
    assert (disagreement(solved) or 0.0) < 1e-15


def test_steady_crank_has_no_tangential_transport_part() -> None:
    solved = solve_linkage(nau_slider_crank(), nau_values(), ("compound",))

    assert solved.quantities["a_B_et"].value == 0.0
    assert solved.quantities["a_S2_et"].unit == "m/s^2"
    assert solved.scale_of_plan["V_at_S2"] == "mu_V"
    assert solved.scale_of_plan["a_at_S2"] == "mu_a_S2"
    assert (disagreement(solved) or 0.0) < 1e-14


def test_point_of_two_couplers_takes_the_number_of_the_second() -> None:
    mechanism, _ = random_train(TRAINS["two couplers meet"], 1)

    found: dict[int, Coupler] = {c.number: c for c in hinged(mechanism, construct(mechanism, ())[0])}

    assert found[4].letters["R"] == "R"
    assert found[5].letters["R"] == "R5"


def test_rod_on_a_coupler_or_on_a_slider_is_not_split() -> None:
    mechanism = Mechanism(
        links=(
            Link(1, {"O": ORIGIN, "A": ("l_OA", "zero")}),
            Link(2, {"A": ORIGIN, "B": ("l_AB", "zero"), "C": ("l_AC", "zero")}),
            Link(3, {"B": ORIGIN}),
            Link(4, {"C": ORIGIN, "D": ("l_CD", "zero")}),
            Link(5, {"D": ORIGIN}),
        ),
        pairs=(
            Revolute("O", (0, 1), ORIGIN),
            Revolute("A", (1, 2)),
            Revolute("B", (2, 3)),
            Prismatic("B", (3, 0), ORIGIN, "zero", "zero", "one"),
            Revolute("C", (2, 4)),
            Revolute("D", (4, 5)),
            Prismatic("D", (5, 0), ORIGIN, "gamma", "zero", "one"),
        ),
        driver=Driver(1, "O", "A", "phi", "n_1", "sense"),
    )

    assert [c.number for c in hinged(mechanism, construct(mechanism, ())[0])] == [2]


def test_hinge_of_three_links_hangs_on_the_one_that_turns() -> None:
    """The pair of rod 4 at B may be said to be with the coupler 2: the rocker 3 carries B as well."""
    mechanism = Mechanism(
        links=(
            Link(1, {"O": ORIGIN, "A": ("l_OA", "zero")}),
            Link(2, {"A": ORIGIN, "B": ("l_AB", "zero")}),
            Link(3, {"C": ORIGIN, "B": ("l_CB", "zero")}),
            Link(4, {"B": ORIGIN, "D": ("l_BD", "zero")}),
            Link(5, {"D": ORIGIN}),
        ),
        pairs=(
            Revolute("O", (0, 1), ORIGIN),
            Revolute("A", (1, 2)),
            Revolute("B", (2, 3), branch="one"),
            Revolute("C", (0, 3), ("x_C", "zero")),
            Revolute("B", (2, 4)),
            Revolute("D", (4, 5)),
            Prismatic("D", (5, 0), ORIGIN, "gamma", "zero", "one"),
        ),
        driver=Driver(1, "O", "A", "phi", "n_1", "sense"),
    )

    found = {c.number: c for c in hinged(mechanism, construct(mechanism, ())[0])}

    assert sorted(found) == [2, 4]
    assert (found[4].pivot, found[4].omega_e) == ("C", "omega_3")
