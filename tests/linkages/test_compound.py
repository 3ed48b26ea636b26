"""Compound motion: it agrees with the plans for random trains of dyads, and its parts are what the theorems say.

Of each train random mechanisms, bent links, a crank that speeds up; with the marker `soak` 10,000.
"""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from kulman.plans.boards.batch import batch
from kulman.plans.linkages.chain import construct, hinged
from kulman.plans.linkages.compound import COMPOUND, Coupler
from kulman.plans.linkages.mechanism import ZERO, Driver, Mechanism, Prismatic
from kulman.plans.linkages.solved import board_givens, disagreement, solve_linkage
from kulman.tests.support.dyads import KINDS, LEAST_SINE, LEAST_SINE_BEFORE, Workshop, chosen, feeder
from kulman.tests.support.mechanisms import CRANK, ORIGIN, bodies, nau_slider_crank, nau_values, one_of, pins

Array = NDArray[np.complex128]
Train = tuple[tuple[str, tuple[int, int], tuple[bool, ...]], ...]
TRAINS: dict[str, tuple[Train, tuple[int, ...]]] = {  # dyads after links 2 and 3, and which links are couplers
    "coupler and rocker": ((), (2,)),
    "three rockers": ((("RRR", (3, 0), ()), ("RRR", (5, 0), ())), (2, 4, 6)),
    "five dyads": (
        (("RRR", (3, 0), ()), ("RRR", (0, 5), ()), ("RRR", (6, 0), ()), ("RRP", (9, 0), (False,))),
        (2, 4, 7, 8, 10),
    ),
    "two couplers meet": ((("RRR", (1, 3), ()),), (2, 4, 5)),
    "rocker hangs on a coupler": ((("RRR", (3, 2), ()),), (2, 4)),
    "slider on the frame": ((("RRP", (3, 0), (False,)),), (2, 4)),
    "slider on a link": ((("RRP", (3, 2), (False,)),), (2, 4)),
    "slider with the guide": ((("RRP", (1, 3), (True,)),), (2, 4)),
    "slotted lever": ((("RPR", (1, 0), (False,)), ("RRP", (5, 0), (False,))), (2, 6)),
}
LETTERS = ("PQRTU", "KLNWX", "FGHIJ", "VYZab")


def random_train(name: str, count: int) -> tuple[Mechanism, dict[str, NDArray[np.float64]]]:
    """Return mechanisms of a crank, links 2 and 3, and the dyads of a train after them; no sine below 0.2."""
    train, _ = TRAINS[name]
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


def couplers(mechanism: Mechanism) -> dict[int, Coupler]:
    return {c.number: c for c in hinged(mechanism, construct(mechanism, ())[0])}


def largest(results: dict[str, Array], kind: str, letter: str) -> NDArray[np.float64]:
    """Return the longest vector of the figure of a point."""
    return np.max([abs(results[f"{kind}_{letter}_{part}"]) for part in COMPOUND[kind]], axis=0)


def same(value: Array, expected: Array, size: NDArray[np.float64], part: float = 1e-11) -> bool:
    return bool(np.all(abs(value - expected) <= part * size + 1e-300))


@pytest.mark.parametrize("count", [100, pytest.param(10_000, marks=pytest.mark.soak)])
@pytest.mark.parametrize("train", TRAINS)
def test_compound_motion_agrees_with_the_plans_and_its_parts_are_those_of_the_theorems(train: str, count: int) -> None:
    mechanism, values = random_train(train, count)

    got = run(mechanism, values)

    found = couplers(mechanism).values()
    assert tuple(sorted(c.number for c in found)) == TRAINS[train][1]
    for kind in COMPOUND:
        letters = [(point, letter) for c in found for point, letter in c.letters.items()]
        size = np.max([largest(got, kind, letter) for _, letter in letters], axis=0)
        for point, letter in letters:
            assert same(got[f"_{kind}_{letter}_total"], got[f"{kind}_{point}"], size, 1e-12), (kind, letter)
    for c in found:
        we, ee = got[c.omega_e], got[c.epsilon_e]
        wr, er = got[f"omega_{c.number}"] - we, got[f"epsilon_{c.number}"] - ee
        assert same(got[f"omega_r_{c.number}"], wr, abs(we) + abs(wr))
        assert same(got[f"epsilon_r_{c.number}"], er, abs(ee) + abs(er) + we**2 + wr**2)
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
                assert same(got[f"{kind}_{letter}_{part}"], value, largest(got, kind, letter)), (letter, name)
            assert same(got[f"l_{c.pivot}{point}"], abs(from_pivot), abs(from_pivot))


@pytest.mark.parametrize("train", TRAINS)
def test_line_of_the_end_closes_a_figure_where_the_other_link_of_the_dyad_hangs_on_the_frame(train: str) -> None:
    mechanism, _ = random_train(train, 2)
    on_frame = {n for pair in mechanism.pairs if 0 in pair.links for n in pair.links}

    for c in couplers(mechanism).values():
        other = c.number ^ 1  # dyads are links 2 and 3, 4 and 5 ...
        assert (c.closing is not None) == (other in on_frame), c.number


@pytest.mark.parametrize("train", ["three rockers", "slider on a link", "slotted lever"])
def test_instant_centre_stands_still_on_the_line_of_the_pivots(train: str) -> None:
    mechanism, values = random_train(train, 100)

    got = run(mechanism, values)

    for c in couplers(mechanism).values():
        P, omega = got[c.centre], got[f"omega_{c.number}"]
        line, way = got[c.hinge] - got[c.pivot], P - got[c.pivot]
        v = got[f"V_{c.hinge}"] + 1j * omega * (P - got[c.hinge])
        assert np.all(abs(v) <= 1e-11 * (abs(got[f"V_{c.hinge}"]) + abs(omega * P)))
        assert np.all(abs((line.conj() * way).imag) <= 1e-12 * abs(line) * (abs(way) + abs(got[c.pivot])))
        assert same(got[f"l_{c.hinge}P{c.number}"], abs(P - got[c.hinge]), abs(P))
        assert same(got[f"l_{c.pivot}P{c.number}"], abs(way), abs(way))


def test_one_position_equals_the_batch_and_points_of_two_couplers_are_numbered() -> None:
    mechanism, values = random_train("five dyads", 8)
    meeting = couplers(random_train("two couplers meet", 1)[0])
    results = run(mechanism, values)
    for i in range(8):
        one = solve_linkage(mechanism, one_of(values, i), ("compound",))
        assert [name for name in results if one.values[name] != results[name][i]] == []
        assert (disagreement(one) or 0.0) < 1e-12
    assert (meeting[4].letters["R"], meeting[5].letters["R"]) == ("R", "R5")


def test_link_that_does_not_turn_has_no_instant_centre() -> None:
    """Two equal cranks 1 and 3 and a coupler 2 as long as the frame: it never turns."""
    values = {"r": 0.5, "l": 1.0, "phi": np.pi / 2, "n_1": 2.0, "sense": 1.0, "side": 1.0}
    driver = Driver(1, "O", "A", "phi", "n_1", "sense")
    parallelogram = Mechanism(bodies("O A:r", "A B:l", "C B:r"), pins("O01 A12 B23:side C03@l"), driver)

    solved = solve_linkage(parallelogram, values, ("compound",))

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
    assert (solved.scale_of_plan["V_at_S2"], solved.scale_of_plan["a_at_S2"]) == ("mu_V", "mu_a_S2")
    assert (disagreement(solved) or 0.0) < 1e-14


def test_rod_is_split_where_what_carries_it_turns_about_a_pivot() -> None:
    """Not on a coupler; the pair of rod 4 at B may be said to be with the coupler 2: the rocker 3 carries B as well."""
    first, second = (Prismatic(p, (n, 0), ORIGIN, ZERO, ZERO, "one") for p, n in (("B", 3), ("D", 5)))
    on_rod = Mechanism(
        bodies("O A:l_OA", "A B:l_AB C:l_AC", "B", "C D:l_CD", "D"),
        (*pins("O01 A12 B23 C24 D45"), first, second),
        CRANK,
    )
    on_rocker = Mechanism(
        bodies("O A:l_OA", "A B:l_AB", "C B:l_CB", "B D:l_BD", "D"),
        (*pins("O01 A12 B23:one C03@x_C B24 D45"), second),
        CRANK,
    )

    found = couplers(on_rocker)

    assert [*couplers(on_rod)] == [2]
    assert sorted(found) == [2, 4]
    assert (found[4].pivot, found[4].omega_e) == ("C", "omega_3")
