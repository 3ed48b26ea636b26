"""Groups of class III over the cycle: one branch from the named start, dead positions, starts that lead nowhere."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from kulman.plans.boards.batch import batch
from kulman.plans.boards.exact import STATUSES, run
from kulman.plans.linkages.chain import construct
from kulman.plans.linkages.following import Follower, followed, with_special_points
from kulman.plans.linkages.limits import swept
from kulman.plans.linkages.mechanism import ZERO, Mechanism, Prismatic, Revolute, SlidingDriver, Start
from kulman.plans.linkages.solved import SolvedLinkage, board_givens, solve_linkage
from kulman.scales.errors import LANGUAGES, InputError
from kulman.tests.support.linkages import BENT, DEAD, PARALLELOGRAM, PRESS, RAM, RAM_VALUES, SHIFTS, two_presses
from kulman.tests.support.linkages import PRESS_VALUES as VALUES
from kulman.tests.support.mechanisms import ORIGIN, one_of
from kulman.tests.support.printed_numbers import decimal
from kulman.tests.support.triads import random_triads

TURN = 2.0 * math.pi
CASES = [pytest.param(PRESS, id="hinged legs"), pytest.param(RAM, id="a ram in a guide")]


def given(of: Mechanism, **changed: Any) -> dict[str, Any]:
    return {**(RAM_VALUES if of is RAM else VALUES), **changed}


def solve(of: Mechanism, **changed: float) -> SolvedLinkage:
    return solve_linkage(of, given(of, **changed))


def over(of: Mechanism, phi: Any, **changed: float) -> tuple[dict[str, Any], list[str]]:
    """Solve for many angles of the crank at once; return values and statuses."""
    values = given(of, **changed, phi=np.asarray(phi))
    _, program = construct(of)
    results, codes = batch(program, board_givens(of, values, program), program.names)
    return results, [STATUSES[code] for code in codes]


def legs_of(of: Mechanism, results: dict[str, Any]) -> list[tuple[Any, float]]:
    """Distances of the joints of every link with two joints, as found and as given."""
    ends = [("A", "B", "l_AB"), ("B", "C", "l_BC"), ("E", "C", "l_EC")] + [("F", "D", "l_FD")] * (of is PRESS)
    v = given(of)
    found = [(abs(results[b] - results[a]), v[length]) for a, b, length in ends]
    return [*found, (abs(results["D"] - results["B"]), math.hypot(v["x_D"], v["y_D"]))]


@pytest.mark.parametrize("of", CASES)
def test_whole_cycle_keeps_all_links_rigid(of: Mechanism) -> None:
    results, statuses = over(of, np.linspace(0.0, TURN, 721))

    assert set(statuses) == {"ok"}
    for found, given in legs_of(of, results):
        assert np.max(abs(found - given)) <= 1e-12 * 0.45


@pytest.mark.parametrize("of", CASES)
def test_whole_cycle_stays_on_one_branch(of: Mechanism) -> None:
    """Every joint comes to the next position by its mean velocity, and back to the first one after the turn."""
    phi = np.linspace(0.0, TURN, 1441)
    results, _ = over(of, phi)

    for joint in "BCD":
        way, mean = np.diff(results[joint]), (results[f"V_{joint}"][1:] + results[f"V_{joint}"][:-1]) / 2
        assert np.max(abs(way - mean * (phi[1] / VALUES["n_1"]))) < 1e-6
        assert abs(results[joint][-1] - results[joint][0]) < 1e-13


@pytest.mark.parametrize("of", CASES)
def test_one_at_a_time_equals_many_in_any_order_to_the_last_bit(of: Mechanism) -> None:
    phi = np.random.default_rng(3).uniform(-TURN, 2 * TURN, 40)
    _, program = construct(of)

    together, _ = over(of, phi)
    sorted_ones, _ = over(of, np.sort(phi))

    for index in range(0, 40, 8):
        board = run(program, board_givens(of, given(of, phi=float(phi[index]))))
        place = np.argsort(phi).tolist().index(index)
        for name in program.names:
            one = np.asarray(board.values[name]).tobytes()
            assert one == together[name][index].tobytes() == sorted_ones[name][place].tobytes(), name


def test_many_mechanisms_are_followed_as_each_alone() -> None:
    values = {**VALUES, "phi": np.linspace(-3.0, 4.0, 9), "l_AB": np.linspace(0.36, 0.43, 9)}

    together = followed(PRESS, values)

    for index in range(9):
        alone = followed(PRESS, {**VALUES, "phi": values["phi"][index], "l_AB": values["l_AB"][index]})
        assert {name: array[index] for name, array in together.items()} == alone


@pytest.mark.parametrize("of", CASES)
def test_start_elsewhere_on_the_branch_leads_to_the_same(of: Mechanism) -> None:
    there = solve(of, phi=4.0)
    angle = np.angle(there.point("C") - there.point("B"))
    start = {"x_0": there.point("B").real, "y_0": there.point("B").imag, "angle_0": angle, "phi_0": 4.0}

    again = solve(of, phi=0.3, **start)

    assert abs(again.point("D") - solve(of, phi=0.3).point("D")) < 1e-14
    assert again.values["M_bal"] == pytest.approx(solve(of, phi=0.3).values["M_bal"], rel=1e-11)


def test_crank_turned_several_times_gives_the_same() -> None:
    once, later = solve(PRESS, phi=0.3), solve(PRESS, phi=0.3 + 5 * TURN)

    assert abs(once.point("D") - later.point("D")) < 1e-13


def test_crank_that_goes_a_little_more_than_a_turn_jumps_nowhere() -> None:
    """Found among random ones: dead positions at -64 and 367 degrees, two positions of the triad at 0 and 360."""
    lengths = {"l_OA": 0.1793, "l_AB": 0.328, "l_BC": 0.1846, "l_EC": 0.3159, "l_FD": 0.246, "x_D": 0.0565}
    places = {"y_D": 0.3358, "x_E": 0.3457, "y_E": -0.0237, "x_F": 0.2097, "y_F": 0.4389}
    start = {"x_0": 0.6273, "y_0": -0.0157, "angle_0": 1.7238, "phi_0": 0.0}
    degrees = np.arange(-100, 500)

    results, statuses = over(PRESS, np.radians(degrees), **lengths, **places, **start)

    stands = [status in ("ok", "ill-conditioned") for status in statuses]
    assert degrees[stands].tolist() == list(range(-64, 368))
    assert abs(results["D"][460] - results["D"][100]) > 0.2  # at 360 and at 0 degrees
    assert np.max(abs(np.diff(results["D"][stands]))) < 0.03


def test_limits_are_the_dead_positions() -> None:
    limits = Follower(BENT, {**VALUES, **PARALLELOGRAM}).limits()

    assert limits == pytest.approx((-DEAD, DEAD), abs=1e-9)


def test_parallelogram_moves_like_the_four_bar() -> None:
    phi = np.linspace(-DEAD + 1e-6, DEAD - 1e-6, 101)
    of = with_special_points(BENT, {**VALUES, **PARALLELOGRAM, "phi": phi})

    results, statuses = over(of, phi, **PARALLELOGRAM)

    a = 0.1 * np.exp(1j * phi)
    base = 0.5 - a
    along = (abs(base) ** 2 + 0.3**2 - 0.25**2) / (2 * abs(base))
    b = a + base / abs(base) * (along + 1j * np.sqrt(0.3**2 - along**2))
    assert set(statuses) <= {"ok", "ill-conditioned"}
    assert np.max(abs(results["B"] - b)) < 1e-9
    assert np.max(abs(results["B"] - b)[10:-10]) < 1e-14
    assert np.max(abs(results["omega_3"][10:-10])) < 1e-11


@pytest.mark.parametrize("beyond", [1e-9, 0.5, *(pytest.param(x, marks=pytest.mark.soak) for x in (1e-6, 0.01))])
def test_position_beyond_a_dead_one_cannot_be_reached(beyond: float) -> None:
    found = solve(BENT, **PARALLELOGRAM, phi=DEAD + beyond)
    error = found.error()

    assert found.status == "no-assembly"
    assert error is not None
    assert error.key == "no-way"
    assert float(error.data["high"]) == pytest.approx(math.degrees(DEAD), abs=1e-4)
    assert found.quantities["V_B"].value is None
    assert found.quantities["V_A"].value == pytest.approx(1.0)
    assert all(decimal("115.15", language) in error.text(language) for language in LANGUAGES)
    assert over(BENT, [DEAD + beyond], **PARALLELOGRAM)[1] == ["no-assembly"]


def test_gap_beyond_a_dead_position_is_the_least_that_a_leg_lacks() -> None:
    """All legs are parallel there: forces that hold one another along them say by which leg the gap is mended best."""
    found = solve(BENT, **PARALLELOGRAM, phi=DEAD + 0.01)

    line = np.exp(1j * np.angle(0.5 - 0.1 * np.exp(1j * DEAD)))
    c, d = ((line.conjugate() * SHIFTS[joint]).imag for joint in "CD")
    shares = [1.0, abs(d / (d - c)), abs(c / (d - c))]
    lacking = abs(0.5 - 0.1 * np.exp(1j * (DEAD + 0.01))) - 0.55
    assert found.trouble is not None
    assert found.trouble.gap == pytest.approx(lacking / max(shares), rel=0.02)


def test_dead_position_itself_is_singular() -> None:
    found = solve(BENT, **PARALLELOGRAM, phi=DEAD)
    error = found.error()

    assert found.status == "singular"
    assert error is not None
    assert (error.key, error.data) == ("singular-triad", {"link": 3, "legs": "2, 4, 5"})
    assert over(BENT, [DEAD], **PARALLELOGRAM)[1] == ["singular"]


def test_angle_behind_a_dead_position_is_reached_the_other_way_round() -> None:
    found, there = solve(BENT, **PARALLELOGRAM, phi=TURN - 1.0), solve(BENT, **PARALLELOGRAM, phi=-1.0)

    assert found.status == "ok"
    assert abs(found.point("D") - there.point("D")) < 1e-14


def test_statuses_of_a_sweep_mark_the_dead_arc() -> None:
    degrees = np.arange(0, 360, 5)

    results, statuses = over(BENT, np.radians(degrees), **PARALLELOGRAM)

    apart = np.array([status == "no-assembly" for status in statuses])
    assert (apart == (np.abs((degrees + 180) % 360 - 180) > math.degrees(DEAD))).all()
    assert np.isnan(results["D"][apart]).all()
    assert not np.isnan(results["A"]).any()


@pytest.mark.parametrize(
    ("places", "of"),
    [
        pytest.param([0.0, 1j, 1.0 - 0.3j], "one point", id="the lines of all legs meet in one point"),
        pytest.param([1.0, 0.5 - 1j, 1.5 + 1j], "parallel", id="all legs are parallel"),
    ],
)
def test_legs_that_do_not_hold_the_central_link_are_refused(places: list[complex], of: str) -> None:
    """B, C, D stand at `places`; A, E, F a leg's length from them, towards one point or all along one direction."""
    towards = [place / abs(place) if place else 1.0 for place in np.array(places) - (0.4 + 0.2j)]
    outer = [place + 0.3 * (u if of == "one point" else 1j) for place, u in zip(places, towards, strict=True)]
    b, c, d = places
    a, e, f = outer
    values = {"l_OA": abs(a), "phi": float(np.angle(a)), "phi_0": float(np.angle(a)), "l_AB": 0.3, "l_EC": 0.3}
    values |= {"l_FD": 0.3, "x_E": e.real, "y_E": e.imag, "x_F": f.real, "y_F": f.imag}
    values |= {"x_0": b.real, "y_0": complex(b).imag, "angle_0": 0.0}
    values = {name: float(value) for name, value in values.items()}
    values |= {"x_C": (c - b).real, "y_C": (c - b).imag, "x_D": (d - b).real, "y_D": (d - b).imag}

    found = solve(BENT, **values)
    error = found.error()

    assert found.status == "singular"
    assert error is not None
    assert error.key == "singular-triad"
    assert over(BENT, [values.pop("phi")], **values)[1] == ["singular"]


def test_start_that_leads_nowhere_is_explained() -> None:
    found = solve(PRESS, l_AB=3.0)
    error = found.error()

    assert found.status == "no-assembly"
    assert error is not None
    assert error.key == "start-far"
    assert float(error.data["gap"]) > 900.0


@pytest.mark.parametrize(
    ("starts", "key"),
    [
        pytest.param((), "start-missing", id="no start"),
        pytest.param((Start(2, "x_0", "y_0", "angle_0", "phi_0"),), "start-missing", id="start of a leg"),
        pytest.param((replace(PRESS.starts[0], legs=(2, 3)),), "start-legs", id="the central link is no leg"),
        pytest.param((replace(PRESS.starts[0], legs=(2, 2)),), "start-legs", id="one leg twice"),
    ],
)
def test_start_must_name_the_central_link_and_two_legs(starts: tuple[Start, ...], key: str) -> None:
    with pytest.raises(InputError) as refused:
        construct(replace(PRESS, starts=starts))

    assert refused.value.key == key
    assert all(refused.value.text(language) for language in LANGUAGES)


def test_slider_on_the_central_link_is_refused() -> None:
    pairs = tuple(Prismatic("D", (5, 3), ORIGIN, ZERO) if p.point == "D" else p for p in PRESS.pairs)

    with pytest.raises(InputError) as refused:
        construct(replace(PRESS, pairs=pairs))

    assert (refused.value.key, refused.value.data["link"]) == ("triad-slide", 3)


def test_best_legs_make_the_special_point() -> None:
    """The legs 4 and 5 of the parallelogram are parallel, so that one of them goes with leg 2."""
    found = solve(BENT, **PARALLELOGRAM, phi=0.2)
    legs = found.mechanism.starts[0].legs

    assert legs in ((2, 4), (2, 5))
    assert found.worst_sine()[1] > 0.3


def test_parallel_legs_that_the_task_wants_make_no_special_point() -> None:
    """The mechanism is not singular, but this construction of it is."""
    found = solve(replace(BENT, starts=(replace(BENT.starts[0], legs=(4, 5)),)), **PARALLELOGRAM, phi=0.2)
    error = found.error()

    assert found.status == "singular"
    assert error is not None
    assert (error.key, error.data["point"]) == ("singular-position", "X3")
    assert found.quantities["D"].x is not None


def test_positions_where_the_legs_of_the_others_are_parallel_take_legs_of_their_own() -> None:
    """Two legs of this press are nearly parallel in some positions, and for each two of them there are such ones."""
    lengths = {"l_OA": 0.1319, "l_AB": 0.4488, "l_BC": 0.2362, "x_D": 0.0918, "y_D": -0.0872, "l_EC": 0.2694}
    places = {"l_FD": 0.278, "x_E": 0.5459, "y_E": -0.3121, "x_F": 0.5272, "y_F": 0.1498}
    start = {"x_0": 0.4992, "y_0": -0.2848, "angle_0": 2.7583, "phi_0": 0.0}
    phi = np.linspace(0.0, TURN, 61)
    values = {**VALUES, **lengths, **places, **start, "phi": phi}

    whole = with_special_points(PRESS, values)
    near = followed(PRESS, values)
    best = []
    for i, at in enumerate(phi):
        here = {name: value[i] for name, value in near.items()}
        best.append(with_special_points(PRESS, {**values, "phi": at}, here, enough=1.0))
    choices = {of.starts[0].legs: of for of in best}

    expected, _ = over(whole, phi, **lengths, **places, **start)
    assert len(choices) > 1
    for legs, of in choices.items():
        part = [i for i, one in enumerate(best) if one.starts[0].legs == legs]
        results, statuses = over(of, phi[part], **lengths, **places, **start)
        assert set(statuses) == {"ok"}
        assert np.max(abs(results["a_D"] - expected["a_D"][part])) < 1e-11 * np.max(abs(expected["a_D"]))


def test_triad_that_hangs_on_a_triad_is_followed() -> None:
    of, values = two_presses()
    phi = np.linspace(0.0, TURN, 361)
    _, program = construct(of)

    results, codes = batch(program, board_givens(of, {**values, "phi": phi}), program.names)

    assert {STATUSES[code] for code in codes} == {"ok"}
    assert np.max(abs(np.diff(results["K"]))) < 0.02
    assert np.max(abs(results["M_bal"] - results["M_bal_lever"])) < 1e-11 * np.max(abs(results["M_bal"]))


def test_triad_behind_a_sliding_driver_is_followed() -> None:
    """A slides on the frame instead of on a crank."""
    pairs = (Prismatic("A", (1, 0), ORIGIN, ZERO), *(p for p in PRESS.pairs if p.point != "O"))
    driver = SlidingDriver(1, "A", "travel", "n_1", "acceleration")
    of = replace(PRESS, links=(replace(PRESS.links[0], points={"A": ORIGIN}), *PRESS.links[1:]), pairs=pairs)
    of = replace(of, driver=driver, starts=(replace(PRESS.starts[0], driver="travel_0"),))
    values = {**VALUES, "travel_0": 0.1, "acceleration": 3.0}
    low, high = Follower(of, values).limits(10.0) or (0.0, 0.0)

    found = solve_linkage(of, {**values, "travel": high - 0.01})
    beyond = solve_linkage(of, {**values, "travel": high + 0.01})

    assert low < 0.1 < high < 1.2
    assert found.status == "ok"
    assert found.values["F_bal"] == pytest.approx(found.values["F_bal_lever"], rel=1e-11)
    assert beyond.status == "no-assembly"
    assert beyond.error() is not None
    assert beyond.error().key == "no-way-slide"  # type: ignore[union-attr]


def test_revolute_pairs_alone_need_no_start() -> None:
    four_bar = replace(PRESS, pairs=PRESS.pairs[:3], links=PRESS.links[:3], starts=())
    four_bar = replace(four_bar, pairs=(*four_bar.pairs, Revolute("C", (3, 0), ("x_E", "y_E"), None)), loads=())

    assert followed(four_bar, VALUES) == {}


@pytest.mark.parametrize("kinds", ["RRR", "RRP", "PRR"])
def test_a_sweep_has_the_names_and_values_of_the_position_of_the_task(kinds: str) -> None:
    mechanism, values, _ = random_triads(kinds, (0, 2, 3), seed=5, count=6)
    for i in range(6):
        one = one_of(values, i)
        solved, drive = solve_linkage(mechanism, one), swept(mechanism, one)
        program = construct(drive.mechanism)[1]
        there = drive.givens(one, np.array([drive.start]))

        here = run(program, {name: float(np.ravel(value)[0]) for name, value in there.items()}).values

        # moments of a dyad that stands flat are taken about another joint in that position alone
        names = construct(replace(solved.mechanism, centres=()))[1].names
        assert {*names} == {*program.names}
        for name in (name for name in solved.quantities if name in names):
            assert here[name] == pytest.approx(solved.values[name], rel=1e-6, abs=1e-6, nan_ok=True), name
