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
from kulman.plans.linkages.mechanism import ZERO, Mechanism, Prismatic, SlidingDriver, Start
from kulman.plans.linkages.solved import SolvedLinkage, board_givens, solve_linkage
from kulman.scales.errors import LANGUAGES, InputError
from kulman.tests.support.cases import some
from kulman.tests.support.dyads import random_triads
from kulman.tests.support.linkages import BENT, DEAD, PARALLELOGRAM, PRESS, RAM, RAM_VALUES, SHIFTS, two_presses
from kulman.tests.support.linkages import PRESS_VALUES as VALUES
from kulman.tests.support.mechanisms import ORIGIN, one_of, pins
from kulman.tests.support.printed_numbers import decimal

TURN = 2.0 * math.pi
CASES = [pytest.param(PRESS, id="hinged legs"), pytest.param(RAM, id="a ram in a guide")]


def given(of: Mechanism, **changed: Any) -> dict[str, Any]:
    return {**(RAM_VALUES if of is RAM else VALUES), **(PARALLELOGRAM if of is BENT else {}), **changed}


def solve(of: Mechanism, **changed: float) -> SolvedLinkage:
    return solve_linkage(of, given(of, **changed))


def refusal(found: SolvedLinkage) -> tuple[str, str, dict[str, Any]]:
    """Return the status, and the key and the data of the reason."""
    error = found.error()
    assert error is not None
    return found.status, error.key, dict(error.data)


def over(of: Mechanism, phi: Any, **changed: float) -> tuple[dict[str, Any], list[str]]:
    """Solve for many angles of the crank at once; return values and statuses."""
    values = given(of, **changed, phi=np.asarray(phi))
    _, program = construct(of)
    results, codes = batch(program, board_givens(of, values, program), program.names)
    return results, [STATUSES[code] for code in codes]


@pytest.mark.parametrize("of", CASES)
def test_whole_cycle_keeps_all_links_rigid_and_stays_on_one_branch(of: Mechanism) -> None:
    """Every joint comes to the next position by its mean velocity, and back to the first one after the turn."""
    phi, v = np.linspace(0.0, TURN, 1441), given(of)

    results, statuses = over(of, phi)

    assert set(statuses) == {"ok"}
    lengths = {"AB": v["l_AB"], "BC": v["l_BC"], "EC": v["l_EC"], "BD": math.hypot(v["x_D"], v["y_D"])}
    for (a, b), length in {**lengths, **({"FD": v["l_FD"]} if of is PRESS else {})}.items():
        assert np.max(abs(abs(results[b] - results[a]) - length)) <= 1e-12 * 0.45
    for joint in "BCD":
        way, mean = np.diff(results[joint]), (results[f"V_{joint}"][1:] + results[f"V_{joint}"][:-1]) / 2
        assert np.max(abs(way - mean * (phi[1] / VALUES["n_1"]))) < 1e-6
        assert abs(results[joint][-1] - results[joint][0]) < 1e-13


@pytest.mark.parametrize("of", CASES)
def test_one_at_a_time_equals_many_in_any_order_to_the_last_bit(of: Mechanism) -> None:
    phi = np.random.default_rng(3).uniform(-TURN, 2 * TURN, 40)
    _, program = construct(of)

    together, _ = over(of, phi)
    in_order, _ = over(of, np.sort(phi))

    for index in range(0, 40, 13):
        board = run(program, board_givens(of, given(of, phi=float(phi[index]))))
        place = np.argsort(phi).tolist().index(index)
        for name in program.names:
            one = np.asarray(board.values[name]).tobytes()
            assert one == together[name][index].tobytes() == in_order[name][place].tobytes(), name


def test_many_mechanisms_are_followed_as_each_alone() -> None:
    values = {**VALUES, "phi": np.linspace(-3.0, 4.0, 9), "l_AB": np.linspace(0.36, 0.43, 9)}
    four_bar = replace(
        PRESS, pairs=(*PRESS.pairs[:3], *pins("C30@x_E,y_E")), links=PRESS.links[:3], starts=(), loads=()
    )

    together = followed(PRESS, values)

    for index in range(9):
        alone = followed(PRESS, {**VALUES, "phi": values["phi"][index], "l_AB": values["l_AB"][index]})
        assert {name: array[index] for name, array in together.items()} == alone
    assert followed(four_bar, VALUES) == {}  # revolute pairs alone need no start


@pytest.mark.parametrize("of", CASES)
def test_start_elsewhere_on_the_branch_and_more_turns_lead_to_the_same(of: Mechanism) -> None:
    there, here = solve(of, phi=4.0), solve(of, phi=0.3)
    angle = np.angle(there.point("C") - there.point("B"))
    start = {"x_0": there.point("B").real, "y_0": there.point("B").imag, "angle_0": angle, "phi_0": 4.0}

    again, later = solve(of, phi=0.3, **start), solve(of, phi=0.3 + 5 * TURN)

    assert abs(again.point("D") - here.point("D")) < 1e-14
    assert again.values["M_bal"] == pytest.approx(here.values["M_bal"], rel=1e-11)
    assert abs(later.point("D") - here.point("D")) < 1e-13


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


def test_parallelogram_moves_like_the_four_bar_between_its_dead_positions() -> None:
    phi = np.linspace(-DEAD + 1e-6, DEAD - 1e-6, 101)
    of = with_special_points(BENT, given(BENT, phi=phi))

    results, statuses = over(of, phi, **PARALLELOGRAM)

    a = 0.1 * np.exp(1j * phi)
    base = 0.5 - a
    along = (abs(base) ** 2 + 0.3**2 - 0.25**2) / (2 * abs(base))
    b = a + base / abs(base) * (along + 1j * np.sqrt(0.3**2 - along**2))
    assert Follower(BENT, given(BENT)).limits() == pytest.approx((-DEAD, DEAD), abs=1e-9)
    assert set(statuses) <= {"ok", "ill-conditioned"}
    assert np.max(abs(results["B"] - b)) < 1e-9
    assert np.max(abs(results["B"] - b)[10:-10]) < 1e-14
    assert np.max(abs(results["omega_3"][10:-10])) < 1e-11


@pytest.mark.parametrize("beyond", [1e-9, 0.5, *(pytest.param(x, marks=pytest.mark.soak) for x in (1e-6, 0.01))])
def test_position_beyond_a_dead_one_cannot_be_reached(beyond: float) -> None:
    found = solve(BENT, phi=DEAD + beyond)

    status, key, data = refusal(found)
    assert (status, key) == ("no-assembly", "no-way")
    assert float(data["high"]) == pytest.approx(math.degrees(DEAD), abs=1e-4)
    assert found.quantities["V_B"].value is None
    assert found.quantities["V_A"].value == pytest.approx(1.0)
    for language in LANGUAGES:
        assert decimal("115.15", language) in found.error().text(language)  # type: ignore[union-attr]
    assert over(BENT, [DEAD + beyond])[1] == ["no-assembly"]


def test_gap_beyond_a_dead_position_is_the_least_that_a_leg_lacks() -> None:
    """All legs are parallel there: forces that hold one another along them say by which leg the gap is mended best."""
    found = solve(BENT, phi=DEAD + 0.01)

    line = np.exp(1j * np.angle(0.5 - 0.1 * np.exp(1j * DEAD)))
    c, d = ((line.conjugate() * SHIFTS[joint]).imag for joint in "CD")
    shares = [1.0, abs(d / (d - c)), abs(c / (d - c))]
    lacking = abs(0.5 - 0.1 * np.exp(1j * (DEAD + 0.01))) - 0.55
    assert found.trouble is not None
    assert found.trouble.gap == pytest.approx(lacking / max(shares), rel=0.02)


def test_angle_behind_a_dead_position_is_reached_the_other_way_round_but_for_the_dead_arc() -> None:
    found, there = solve(BENT, phi=TURN - 1.0), solve(BENT, phi=-1.0)
    degrees = np.arange(0, 360, 5)

    results, statuses = over(BENT, np.radians(degrees))

    apart = np.array([status == "no-assembly" for status in statuses])
    assert found.status == "ok"
    assert abs(found.point("D") - there.point("D")) < 1e-14
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
    (b, c, d), (a, e, f) = map(complex, places), map(complex, outer)
    phi = float(np.angle(a))
    values = {"l_OA": abs(a), "phi_0": phi, "l_AB": 0.3, "l_EC": 0.3, "l_FD": 0.3, "angle_0": 0.0}
    for name, at in (("E", e), ("F", f), ("0", b), ("C", c - b), ("D", d - b)):
        values |= {f"x_{name}": at.real, f"y_{name}": at.imag}

    assert refusal(solve(BENT, **values, phi=phi))[:2] == ("singular", "singular-triad")
    assert over(BENT, [phi], **values)[1] == ["singular"]


def test_start_that_leads_nowhere_is_explained() -> None:
    status, key, data = refusal(solve(PRESS, l_AB=3.0))

    assert (status, key) == ("no-assembly", "start-far")
    assert float(data["gap"]) > 900.0


SLIDER = tuple(Prismatic("D", (5, 3), ORIGIN, ZERO) if p.point == "D" else p for p in PRESS.pairs)


@pytest.mark.parametrize(
    ("of", "key"),
    [
        pytest.param(replace(PRESS, starts=()), "start-missing", id="no start"),
        pytest.param(
            replace(PRESS, starts=(Start(2, "x_0", "y_0", "angle_0", "phi_0"),)), "start-missing", id="start of a leg"
        ),
        pytest.param(
            replace(PRESS, starts=(replace(PRESS.starts[0], legs=(2, 3)),)), "start-legs", id="central link is no leg"
        ),
        pytest.param(replace(PRESS, starts=(replace(PRESS.starts[0], legs=(2, 2)),)), "start-legs", id="one leg twice"),
        pytest.param(replace(PRESS, pairs=SLIDER), "triad-slide", id="slider on the central link"),
    ],
)
def test_start_must_name_the_central_link_and_two_legs_hinged_to_it(of: Mechanism, key: str) -> None:
    with pytest.raises(InputError) as refused:
        construct(of)

    assert refused.value.key == key
    assert all(refused.value.text(language) for language in LANGUAGES)


def test_best_legs_make_the_special_point() -> None:
    """The legs 4 and 5 of the parallelogram are parallel, so that one of them goes with leg 2."""
    found = solve(BENT, phi=0.2)

    assert found.mechanism.starts[0].legs in ((2, 4), (2, 5))
    assert found.worst_sine()[1] > 0.3


def test_positions_where_the_legs_of_the_others_are_parallel_take_legs_of_their_own() -> None:
    """Two legs of this press are nearly parallel in some positions, and for each two of them there are such ones."""
    lengths = {"l_OA": 0.1319, "l_AB": 0.4488, "l_BC": 0.2362, "x_D": 0.0918, "y_D": -0.0872, "l_EC": 0.2694}
    places = {"l_FD": 0.278, "x_E": 0.5459, "y_E": -0.3121, "x_F": 0.5272, "y_F": 0.1498}
    own = {**lengths, **places, "x_0": 0.4992, "y_0": -0.2848, "angle_0": 2.7583, "phi_0": 0.0}
    phi = np.linspace(0.0, TURN, 61)
    values = {**VALUES, **own, "phi": phi}

    whole, near = with_special_points(PRESS, values), followed(PRESS, values)
    best = [
        with_special_points(PRESS, {**values, "phi": at}, {name: value[i] for name, value in near.items()}, enough=1.0)
        for i, at in enumerate(phi)
    ]
    choices = {of.starts[0].legs: of for of in best}

    expected, _ = over(whole, phi, **own)
    assert len(choices) > 1
    for legs, of in choices.items():
        part = [i for i, one in enumerate(best) if one.starts[0].legs == legs]
        results, statuses = over(of, phi[part], **own)
        assert set(statuses) == {"ok"}
        assert np.max(abs(results["a_D"] - expected["a_D"][part])) < 1e-11 * np.max(abs(expected["a_D"]))


def test_triad_that_hangs_on_a_triad_is_followed() -> None:
    of, values = two_presses()
    _, program = construct(of)

    results, codes = batch(
        program, board_givens(of, {**values, "phi": np.linspace(0.0, TURN, 361)}), ["K", "M_bal", "M_bal_lever"]
    )

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

    found, beyond = (solve_linkage(of, {**values, "travel": high + step}) for step in (-0.01, 0.01))

    assert low < 0.1 < high < 1.2
    assert found.status == "ok"
    assert found.values["F_bal"] == pytest.approx(found.values["F_bal_lever"], rel=1e-11)
    assert refusal(beyond)[:2] == ("no-assembly", "no-way-slide")


@pytest.mark.parametrize("kinds", some(["RRR", "RRP", "PRR"], 1))
def test_a_sweep_has_the_names_and_values_of_the_position_of_the_task(kinds: str) -> None:
    mechanism, values, _ = random_triads(kinds, (0, 2, 3), seed=5, count=3)
    for i in range(3):
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
