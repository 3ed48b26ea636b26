"""Dyads in positions where something vanishes, in singular ones, and in ones that cannot be assembled."""

from __future__ import annotations

import math
import re
from dataclasses import replace

import numpy as np
import pytest

from kulman.plans.boards.batch import batch
from kulman.plans.boards.exact import STATUSES
from kulman.plans.linkages.chain import construct
from kulman.plans.linkages.mechanism import ZERO, Driver, Link, Load, Mechanism, Pair, Prismatic, Revolute
from kulman.plans.linkages.solved import SolvedLinkage, board_givens, solve_linkage
from kulman.scales.errors import InputError
from kulman.tests.support.mechanisms import nau_slider_crank

ORIGIN = (ZERO, ZERO)
DRIVER = Driver(1, "O", "A", "phi", "n_1", "sense_1")
CRANK = Link(1, {"O": ORIGIN, "A": ("l_OA", ZERO)})
PIVOT, PIN = Revolute("O", (0, 1), ORIGIN), Revolute("A", (1, 2))
VALUES = {
    **{"phi": 0.7, "l_OA": 0.1, "n_1": 10.0, "sense_1": 1.0, "l_OC": 0.3, "e": 0.0, "l_AB": 0.25, "l_CB": 0.2},
    **{"branch": 1.0, "m": 2.0, "J": 0.03, "l_S": 0.15, "F": 50.0, "alpha": 0.3, "up": math.pi / 2, "gamma": 0.0},
}


def rocker(number: int, pin: str, *more: str) -> Link:
    points = {pin: ORIGIN, **dict.fromkeys(more, ("l_CB", ZERO)), "S": ("l_S", ZERO)}
    return Link(number, points, "S", "m", "J")


def mechanism(links: tuple[Link, ...], *pairs: Pair) -> Mechanism:
    return Mechanism((CRANK, *links), (PIVOT, *pairs), DRIVER, (Load("F", 3, "S", "F", "alpha"),))


SLOTTED_LEVER = mechanism(
    (Link(2, {"A": ORIGIN}), rocker(3, "C")),
    PIN,
    Prismatic("A", (2, 3), ORIGIN, ZERO, "e", "branch"),
    Revolute("C", (3, 0), ("l_OC", ZERO)),
)
FOUR_BAR = mechanism(
    (Link(2, {"A": ORIGIN, "B": ("l_AB", ZERO)}), rocker(3, "C", "B")),
    PIN,
    Revolute("B", (2, 3), None, "branch"),
    Revolute("C", (3, 0), ("l_OC", ZERO)),
)
SCOTCH_YOKE = mechanism(
    (Link(2, {"A": ORIGIN}), Link(3, {"S": ORIGIN}, "S", "m")),
    PIN,
    Prismatic("A", (2, 3), ORIGIN, "up"),
    Prismatic("S", (3, 0), ORIGIN, ZERO),
)
TANGENT = mechanism(  # a slider on the crank, a slider on the frame, a common pin
    (Link(2, {"B": ORIGIN}), Link(3, {"B": ORIGIN, "S": ("l_S", ZERO)}, "S", "m")),
    Prismatic("B", (2, 1), ORIGIN, ZERO),
    Revolute("B", (2, 3)),
    Prismatic("B", (3, 0), ("l_OC", ZERO), "gamma"),
)


def solve(of: Mechanism, **changed: float) -> SolvedLinkage:
    return solve_linkage(of, {**VALUES, **changed})


def test_crank_in_line_with_the_pivots_of_a_slotted_lever_has_no_sliding_and_no_coriolis() -> None:
    found = solve(SLOTTED_LEVER, phi=math.pi)

    assert found.status == "ok"
    assert found.size("V_A3A2") == found.size("a_A3A2_k") == 0.0
    assert found.values["omega_3"] == pytest.approx(10.0 * 0.1 / 0.4, rel=1e-15)
    assert math.isfinite(found.values["M_bal"])


def test_crank_across_the_slot_stops_the_lever_which_still_accelerates() -> None:
    found = solve(SLOTTED_LEVER, phi=math.acos(0.1 / 0.3))

    assert found.status == "ok"
    assert abs(found.values["omega_3"]) < 1e-14
    assert found.size("a_A3A2_k") < 1e-13
    assert found.values["epsilon_3"] == pytest.approx(found.size("a_A") / found.values["l_CA"], rel=1e-13)


def test_slotted_lever_turns_as_its_closed_form_says() -> None:
    phi, r, c = np.linspace(0, 7, 200), 0.1, 0.3
    program = construct(SLOTTED_LEVER)[1]

    results, codes = batch(program, board_givens(SLOTTED_LEVER, {**VALUES, "phi": phi}), ["omega_3", "V_A3A2"])

    square = r * r + c * c - 2 * r * c * np.cos(phi)
    assert not codes.any()
    assert np.allclose(results["omega_3"], 10 * (r * r - r * c * np.cos(phi)) / square, rtol=0, atol=1e-13)
    assert np.allclose(abs(results["V_A3A2"]), abs(10 * r * c * np.sin(phi)) / np.sqrt(square), rtol=0, atol=1e-13)


def test_scotch_yoke_moves_by_the_sine() -> None:
    found = solve(SCOTCH_YOKE)

    assert found.point("S") == pytest.approx(0.1 * math.cos(0.7), rel=1e-15)
    assert found.point("V_S") == pytest.approx(-math.sin(0.7), rel=1e-14)
    assert found.point("a_S") == pytest.approx(-10 * math.cos(0.7), rel=1e-14)
    assert not {"omega_2", "omega_3", "a_A3A2_k"} & set(found.values)


def test_tangent_mechanism_moves_by_the_tangent() -> None:
    found = solve(TANGENT, gamma=math.pi / 2)

    assert found.point("B") == pytest.approx(complex(0.3, 0.3 * math.tan(0.7)), rel=1e-14)
    assert found.point("V_B") == pytest.approx(3j / math.cos(0.7) ** 2, rel=1e-14)
    assert found.point("a_B") == pytest.approx(60j * math.tan(0.7) / math.cos(0.7) ** 2, rel=1e-13)


def test_coupler_of_a_parallelogram_translates() -> None:
    found = solve(FOUR_BAR, l_AB=0.3, l_CB=0.1, phi=math.pi / 2)

    assert found.point("B") == pytest.approx(0.3 + 0.1j)
    assert abs(found.values["omega_2"]) < 1e-14
    assert abs(found.values["epsilon_2"]) < 1e-13
    assert found.status == "ok"


def test_unloaded_slider_and_guide_without_forces_have_no_arms_out_of_nothing() -> None:
    found = solve_linkage(replace(SLOTTED_LEVER, loads=()), {**VALUES, "m": 0.0, "J": 0.0})

    assert [found.values[name] for name in ("h_32", "M_32", "M_bal", "M_bal_lever")] == [0.0] * 4


def test_couple_on_a_slider_without_a_force_has_no_arm() -> None:
    yoke = replace(SCOTCH_YOKE, loads=(Load("F", 3, "S", "F", "alpha"),))

    found = solve(yoke, phi=0.0, F=0.0)

    assert found.size("R_03") == 0.0  # the yoke's force of inertia is along the guide, through A
    assert found.values["h_03"] == 0.0


@pytest.mark.parametrize(
    ("of", "changed", "point", "gap"),
    [
        pytest.param(FOUR_BAR, {"phi": math.pi, "l_AB": 0.15}, "B", 50.0, id="two links too short"),
        pytest.param(FOUR_BAR, {"phi": 0.0, "l_AB": 0.45}, "B", 50.0, id="one link too long"),
        pytest.param(SLOTTED_LEVER, {"phi": 0.0, "e": 0.25}, "A", 50.0, id="offset larger than the distance of pins"),
    ],
)
def test_dyad_that_cannot_be_assembled_says_by_how_much(
    of: Mechanism, changed: dict[str, float], point: str, gap: float
) -> None:
    found = solve(of, **changed)
    error = found.error()

    assert found.status == "no-assembly"
    assert error is not None
    assert error.key == "no-assembly-here"
    assert error.data["point"] == point
    assert float(error.data["gap"]) == pytest.approx(gap, rel=1e-3)
    assert in_batch(of, changed) == "no-assembly"


@pytest.mark.parametrize(
    ("of", "changed", "key"),
    [
        pytest.param(FOUR_BAR, {"phi": math.pi, "l_AB": 0.2}, "singular-velocity", id="four-bar stretched"),
        pytest.param(FOUR_BAR, {"phi": 0.0, "l_OC": 0.1, "l_AB": 0.2}, "singular-pins", id="equal links on one pin"),
        pytest.param(SLOTTED_LEVER, {"phi": 0.0, "l_OC": 0.1}, "singular-pins", id="slider on the lever's pivot"),
        pytest.param(SLOTTED_LEVER, {"phi": 0.0, "e": 0.2}, "singular-velocity", id="slider at the foot of the normal"),
        pytest.param(TANGENT, {"gamma": 0.7}, "singular-position", id="parallel guides"),
        pytest.param(SCOTCH_YOKE, {"up": 0.0}, "singular-position", id="slot along the guide"),
    ],
)
def test_singular_position_names_its_cause(of: Mechanism, changed: dict[str, float], key: str) -> None:
    found = solve(of, **changed)
    error = found.error()

    assert found.status == "singular"
    assert error is not None
    assert error.key == key
    assert in_batch(of, changed) == "singular"


def in_batch(of: Mechanism, changed: dict[str, float]) -> str:
    values = {**VALUES, **changed}
    _, codes = batch(construct(of)[1], board_givens(of, {**values, "phi": np.full(3, values["phi"])}), ["M_bal"])
    assert len(set(codes)) == 1
    return STATUSES[codes[0]]


@pytest.mark.parametrize("offset", [1e-3, 1e-6, 1e-9])
def test_position_near_a_singular_one_is_called_ill_conditioned(offset: float) -> None:
    angle = math.pi - offset

    found = solve(FOUR_BAR, phi=angle, l_AB=0.2)

    assert found.status in ("ill-conditioned", "singular")
    assert in_batch(FOUR_BAR, {"phi": angle, "l_AB": 0.2}) == found.status


def test_slider_of_two_guides_is_refused() -> None:
    twice = replace(SCOTCH_YOKE, pairs=(PIVOT, PIN, Prismatic("S", (3, 2), ORIGIN, "up"), SCOTCH_YOKE.pairs[3]))

    with pytest.raises(InputError) as refused:
        construct(twice)

    assert (refused.value.key, refused.value.data) == ("slider-twice", {"link": 3})


def test_two_points_with_one_letter_are_refused() -> None:
    links = (CRANK, Link(2, {**FOUR_BAR.links[1].points, "S": ("l_S", ZERO)}), FOUR_BAR.links[2])

    with pytest.raises(InputError) as refused:
        construct(replace(FOUR_BAR, links=links))

    assert (refused.value.key, refused.value.data) == ("name-twice", {"name": "S"})


def test_two_dyads_on_one_crank_pin_and_one_pivot_of_the_frame_move_as_alone() -> None:
    """Two equal dyads side by side: each moves as alone, and the crank and the pivot bear both."""
    twin = (
        Link(4, {"A": ORIGIN, "D": ("l_AB", ZERO)}),
        Link(5, {"C": ORIGIN, "D": ("l_CB", ZERO), "S5": ("l_S", ZERO)}, "S5", "m", "J"),
    )
    pairs = (Revolute("A", (1, 4)), Revolute("D", (4, 5), None, "branch"), Revolute("C", (5, 0), ("l_OC", ZERO)))
    load = Load("F_5", 5, "S5", "F", "alpha")
    both = Mechanism((*FOUR_BAR.links, *twin), (*FOUR_BAR.pairs, *pairs), FOUR_BAR.driver, (*FOUR_BAR.loads, load))

    alone, found = solve(FOUR_BAR), solve(both)

    assert found.point("V_D") == found.point("V_B") == alone.point("V_B")
    assert found.point("R_14") == found.point("R_12") == alone.point("R_12")
    assert found.values["M_bal"] == pytest.approx(2 * alone.values["M_bal"], rel=1e-14)
    assert found.point("R_01") == pytest.approx(2 * alone.point("R_01"), rel=1e-14)


def test_given_with_the_name_of_a_result_is_refused() -> None:
    """The distance of the pins of a slotted lever is measured; a given of that name would be overwritten."""
    with pytest.raises(InputError) as refused:
        construct(replace(SLOTTED_LEVER, pairs=(*SLOTTED_LEVER.pairs[:3], Revolute("C", (3, 0), ("l_CA", ZERO)))))

    assert (refused.value.key, refused.value.data) == ("name-twice", {"name": "l_CA"})


@pytest.mark.parametrize("of", [FOUR_BAR, SLOTTED_LEVER, SCOTCH_YOKE, TANGENT, nau_slider_crank()])
def test_what_acts_on_the_frame_has_no_name_and_every_guide_has_its_moment(of: Mechanism) -> None:
    _, program = construct(of)
    guides = [pair for pair in of.pairs if isinstance(pair, Prismatic)]

    assert [name for name in program.names if re.fullmatch("[RM]_[0-9]0", name)] == []
    for slider, guide in (pair.links for pair in guides):
        assert {f"M_{guide}{slider}", f"M_{slider}{guide}"} & set(program.names)


def test_length_of_a_bent_link_is_measured_and_listed() -> None:
    points = {"A": ("l_S", "l_S"), "B": ("l_AB", ZERO)}
    bent = replace(FOUR_BAR, links=(CRANK, Link(2, points), FOUR_BAR.links[2]))
    free = replace(bent, links=(CRANK, Link(2, {**points, "B": ("l_long", ZERO)}), FOUR_BAR.links[2]))

    hidden, listed = solve(bent), solve_linkage(free, {**VALUES, "l_long": VALUES["l_AB"]})

    length = math.hypot(VALUES["l_AB"] - VALUES["l_S"], VALUES["l_S"])
    assert listed.quantities["l_AB"].value == pytest.approx(length)
    assert listed.size("V_BA") == pytest.approx(abs(listed.values["omega_2"]) * length)
    # a coordinate that is called so keeps its name
    assert hidden.quantities["l_AB"].value == VALUES["l_AB"]
    assert hidden.point("V_B") == listed.point("V_B")


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("runs", ["pin", "point"])
def test_branch_of_an_outer_guide_is_that_of_the_dyads_own_pin(runs: str, sign: float) -> None:
    guide = Prismatic("B", (3, 1), ORIGIN, ZERO, branch="branch")  # the pin B runs along the crank
    if runs == "point":
        guide = Prismatic("A", (1, 3), ORIGIN, ZERO, branch="branch")  # the crank's point A runs in a guide of link 3
    points = ({"O": ORIGIN, "A": ("l_OA", ZERO)}, {"C": ORIGIN, "B": ("l_CB", ZERO)}, {"B": ORIGIN})
    pairs = (Revolute("O", (0, 1), ORIGIN), Revolute("C", (0, 2), ("x_C", ZERO)), Revolute("B", (2, 3)), guide)
    links = tuple(Link(number, at) for number, at in enumerate(points, start=1))
    values = {"phi": 0.7, "speed": 1.0, "sense": 1.0, "l_OA": 1.0, "l_CB": 2.5, "x_C": 1.5, "branch": sign}

    solved = solve_linkage(Mechanism(links, pairs, Driver(1, "O", "A", "phi", "speed", "sense")), values, ("position",))

    along = solved.point("B") * complex(solved.values["u_31"]).conjugate()
    middle = 1.5 * math.cos(0.7)  # the foot of the normal from C to the line through O
    assert along.imag == pytest.approx(0.0, abs=1e-14)
    assert along.real - middle == pytest.approx(sign * math.sqrt(2.5**2 - (1.5 * math.sin(0.7)) ** 2), rel=1e-13)
