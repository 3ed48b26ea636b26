"""Loads in positions where their laws change: dead positions, ends of strokes, jumps of diagrams, pivots."""

from __future__ import annotations

import math
from dataclasses import replace
from itertools import product
from typing import Any

import numpy as np
import pytest

from kulman.plans.boards.batch import batch
from kulman.plans.linkages.chain import construct
from kulman.plans.linkages.mechanism import (
    ANGLE,
    FORCE,
    IDLE,
    STROKE,
    WORKING,
    Couple,
    Diagram,
    Link,
    Load,
    Mechanism,
    Prismatic,
    SlidingDriver,
    Stroke,
)
from kulman.plans.linkages.solved import SolvedLinkage, board_givens, solve_linkage
from kulman.scales.errors import LANGUAGES, InputError
from kulman.tests.support.mechanisms import CRANK as DRIVER
from kulman.tests.support.mechanisms import ORIGIN, ZERO, bodies, pins

CRANK, ROD, FRONT = 0.1, 0.35, 0.25  # the slider runs from 0.25 to 0.45 m
VALUES = {
    **{"l_OA": CRANK, "l_AB": ROD, "l_S": 0.15, "n_1": 8.0, "sense_1": 1.0, "phi": 1.0, "gamma": 0.0},
    **{"m_2": 3.0, "J_S2": 0.04, "m_3": 5.0, "F": 700.0, "M": 20.0, "g": 9.81, "minus": -1.0},
    **{f"at_{i}": at for i, at in enumerate((0.0, 0.25, 0.25, 1.0))},
    **{f"P_{i}": force for i, force in enumerate((100.0, 100.0, 400.0, 1000.0))},
    **{f"Q_{i}": force for i, force in enumerate((10.0, 20.0, 30.0, 40.0))},
}
SLIDER_CRANK = Mechanism(
    bodies("O A:l_OA / O m_2", "A B:l_AB S2:l_S / S2 m_2 J_S2", "B / B m_3"),
    (*pins("O01 A12 B23"), Prismatic("B", (3, 0), ORIGIN, "gamma")),
    DRIVER,
    loads=(Load("F_3", 3, "B", "F"),),
    stroke=Stroke(3),
)
FOUR_BAR = Mechanism(
    bodies("O A:l_OA", "A B:l_AB", "C B:l_CB / C m_3 J_S2"),
    pins("O01 A12 B23:one C30@l_OC"),
    DRIVER,
    couples=(Couple("M_3", 3, "M", None),),
)
BARS = {"l_CB": 0.3, "l_OC": 0.4}
PLACES, SIZES, BACK = (tuple(f"{name}_{i}" for i in range(4)) for name in ("at", "P", "Q"))
INNER = math.acos((0.4**2 + (ROD - CRANK) ** 2 - 0.3**2) / (2 * 0.4 * (ROD - CRANK))) + math.pi  # A beyond O from B


def solve(mechanism: Mechanism = SLIDER_CRANK, **changed: float) -> SolvedLinkage:
    return solve_linkage(mechanism, {**VALUES, **BARS, **changed})


def at_place(place: float, sense: float = 1.0) -> float:
    """Angle of the crank at which the slider stands at `place`, on its way out (below the guide) or in."""
    return -sense * math.acos(min(1.0, (CRANK**2 + place**2 - ROD**2) / (2 * CRANK * place)))


def test_what_resists_is_zero_where_nothing_moves_and_opposite_to_the_motion_elsewhere() -> None:
    never = solve(replace(SLIDER_CRANK, couples=(Couple("M_3", 3, "M", None),)))
    couples = [solve(FOUR_BAR, phi=INNER + d).values["M_3"] for d in (-1e-9, 0.0, 1e-9)]

    assert [solve(phi=phi).values["F_3"] for phi in (0.0, math.pi, -math.pi)] == [0.0] * 3
    assert sorted(couples) == [-20.0, 0.0, 20.0]
    assert couples[1] == never.values["M_3"] == 0.0
    for phi, sense in ((0.001, 1.0), (-2.0, 1.0), (1.0, -1.0), (math.pi + 1e-9, 1.0)):
        found = solve(phi=phi, sense_1=sense)
        assert found.size("F_3") == pytest.approx(700.0, rel=1e-12)
        assert (found.point("F_3").conjugate() * found.point("V_B")).real == pytest.approx(-700.0 * found.size("V_B"))


def with_diagram(diagram: Diagram, stroke: Stroke | None = SLIDER_CRANK.stroke) -> Mechanism:
    """Return the slider-crank under a load that a diagram says."""
    return replace(SLIDER_CRANK, loads=(Load("F_3", 3, "B", "P", ZERO),), diagrams=(diagram,), stroke=stroke)


@pytest.mark.parametrize("direction", ["one", "minus"])
def test_load_acts_in_its_stroke_from_its_beginning_to_before_its_end(direction: str) -> None:
    """The slider goes along its guide while the crank turns from pi to 2 pi; a stroke begins where it rests."""
    for acts in (WORKING, IDLE):
        mechanism = replace(SLIDER_CRANK, loads=(Load("F_3", 3, "B", "F", ZERO, acts),), stroke=Stroke(3, direction))
        found = [solve(mechanism, phi=phi).size("F_3") for phi in (math.pi, 4.0, 6.0, 2 * math.pi, 1.0, 3.0)]
        along = (direction == "one") == (acts == WORKING)
        assert found == [700.0 * along] * 3 + [700.0 * (not along)] * 3


def test_diagram_is_read_where_the_slider_stands_in_its_stroke_and_the_idle_one_has_values_of_its_own() -> None:
    """Half of the stroke is done at 0.35 m, whichever way it is counted."""
    mechanism = with_diagram(Diagram("P", STROKE, PLACES, SIZES))
    expected = {0.25: 100.0, 0.28: 100.0, 0.2999: 100.0, 0.3001: 400.4, 0.375: 700.0, 0.45: 1000.0}
    for place, force in expected.items():
        assert solve(mechanism, phi=at_place(place)).size("F_3") == pytest.approx(force, rel=1e-6), place
    for direction, forth in product(("one", "minus"), (1.0, -1.0)):
        mechanism = with_diagram(Diagram("P", STROKE, PLACES, SIZES, BACK), Stroke(3, direction))
        works = (direction == "one") == (forth > 0)
        # from 400 at 0.25 to 1000 at 1, or from 30 to 40
        expected_force = 600.0 if works else 30.0 + 10.0 / 3.0
        assert solve(mechanism, phi=at_place(0.35, forth)).size("F_3") == pytest.approx(expected_force, rel=1e-9)


def test_diagram_of_a_rocker_is_read_by_its_angle() -> None:
    """The rocker's dead positions are those where crank and rod lie in line."""
    mechanism = replace(
        FOUR_BAR,
        couples=(Couple("M_3", 3, "P"),),
        diagrams=(Diagram("P", STROKE, (ZERO, "one"), (ZERO, "one")),),
        stroke=Stroke(3, "minus"),
    )

    def rocker(reach: float) -> float:
        return math.pi - math.acos((0.4**2 + 0.3**2 - reach**2) / (2 * 0.4 * 0.3))

    low, high = rocker(ROD + CRANK), rocker(ROD - CRANK)
    for phi in (0.3, 1.7, 2.9, 4.4, 5.9):
        found = solve(mechanism, phi=phi)
        angle = np.angle(found.point("B") - found.point("C")) % (2 * math.pi)
        assert found.values["M_3"] == pytest.approx((high - angle) / (high - low), abs=1e-9)


def test_diagram_over_the_angle_goes_round_with_the_crank() -> None:
    """Behind its last place, at 1 rad, it runs on to the first one, at 2 pi."""
    mechanism = with_diagram(Diagram("P", ANGLE, PLACES, BACK), None)
    expected = {0.0: 10.0, 0.125: 15.0, 0.25: 20.0, 0.26: 30.0 + 10.0 * 0.01 / 0.75, 1.0: 40.0}
    expected[3.6] = 40.0 - 30.0 * 2.6 / (2 * math.pi - 1.0)
    for turns, (phi, force) in product((-3, 0, 2), expected.items()):
        assert solve(mechanism, phi=phi + turns * 2 * math.pi).size("F_3") == pytest.approx(force, rel=1e-9), phi


def test_many_positions_and_many_mechanisms_read_their_diagrams_alike() -> None:
    diagram = Diagram("P", STROKE, PLACES, SIZES, BACK)
    loads = (Load("F_3", 3, "B", "P"), Load("F_f", 3, "B", "F", None, IDLE))
    mechanism = replace(SLIDER_CRANK, loads=loads, diagrams=(diagram,), gravity="g")
    _, program = construct(mechanism)
    for varying in ({"phi": np.linspace(0.0, 2 * math.pi, 9)}, {"l_OA": np.linspace(0.05, 0.2, 9)}):
        values: dict[str, Any] = {**VALUES, **varying}

        results, _ = batch(program, board_givens(mechanism, values, program), ["F_3", "F_f", "M_bal"])

        for i in range(9):
            one = solve(mechanism, **{name: float(array[i]) for name, array in varying.items()})
            assert [one.values[name] for name in results] == [results[name][i] for name in results]


def test_weight_at_a_pivot_is_borne_by_the_pivot_alone() -> None:
    mechanism = replace(SLIDER_CRANK, gravity="g", loads=())
    light = replace(mechanism, links=(Link(1, SLIDER_CRANK.links[0].points), *SLIDER_CRANK.links[1:]))

    with_it, without = solve(mechanism), solve(light)
    heavy_rocker, rocker = solve(replace(FOUR_BAR, gravity="g")), solve(FOUR_BAR)

    assert with_it.point("G_1") == pytest.approx(-3.0 * 9.81j)
    assert with_it.point("R_01") - without.point("R_01") == pytest.approx(3.0 * 9.81j)
    assert with_it.values["M_bal"] == pytest.approx(without.values["M_bal"], rel=1e-14)
    assert "h_lever_G_1" not in with_it.values
    assert heavy_rocker.point("R_03") - rocker.point("R_03") == pytest.approx(5.0 * 9.81j)
    assert heavy_rocker.point("R_12") == pytest.approx(rocker.point("R_12"))


def test_masses_follow_from_the_distance_of_two_joints() -> None:
    """The empirical formulas of a course project: m = 10 l, J = 0.1 m l^2."""
    links = (
        Link(1, {"O": ("l_S", "l_S"), "A": ("l_AB", ZERO)}, "O", "m_1", "J_S1", "k", "j"),
        replace(SLIDER_CRANK.links[1], per_length="k", inertia_factor="j"),
        SLIDER_CRANK.links[2],
    )
    found = solve(replace(SLIDER_CRANK, links=links), k=10.0, j=0.1, phi=-1.3)
    length = math.hypot(ROD - 0.15, 0.15)

    assert found.quantities["m_2"].value == pytest.approx(3.5)
    assert found.quantities["J_S2"].value == pytest.approx(0.1 * 3.5 * 0.35**2)
    assert found.quantities["l_OA"].value == pytest.approx(length)
    assert found.quantities["m_1"].value == pytest.approx(10.0 * length)
    assert (found.quantities["m_2"].unit, found.quantities["J_S2"].unit) == ("kg", "kg*m^2")


def test_force_at_the_crank_pin_balances_like_a_moment_and_relieves_the_pivot() -> None:
    by_force = solve(replace(SLIDER_CRANK, driver=replace(SLIDER_CRANK.driver, balance=FORCE)))  # type: ignore[type-var]
    by_moment = solve()

    assert by_force.values["F_bal"] * CRANK == pytest.approx(by_moment.values["M_bal"], rel=1e-13)
    assert by_force.values["F_bal_lever"] == pytest.approx(by_force.values["F_bal"], rel=1e-12)
    assert by_moment.values["F_bal"] == pytest.approx(by_force.values["F_bal"], rel=1e-12)
    assert by_force.point("R_01") == pytest.approx(by_moment.point("R_01") - by_force.point("_F_bal"))
    assert by_force.shown_on["F_bal"] == "forces_1"
    assert "M_bal" not in by_force.quantities


def piston(values: dict[str, float]) -> tuple[Mechanism, dict[str, float]]:
    """Return the slider-crank driven by its slider, from where the crank has brought it."""
    crank = solve_linkage(SLIDER_CRANK, values)
    mechanism = Mechanism(
        bodies("B / B m_3", "A B:l_AB S2:l_S / S2 m_2 J_S2", "O A:l_OA / O m_2"),
        (Prismatic("B", (1, 0), ORIGIN, "gamma"), *pins("B12 A23:side O30")),
        SlidingDriver(1, "B", "s", "v", "a"),
        couples=(Couple("M_3", 3, "M", None),),
    )
    along = np.exp(1j * values["gamma"])
    sizes = {name: float((along.conjugate() * crank.point(name)).real) for name in ("B", "V_B", "a_B")}
    # seen from B towards O, the left is below the guide
    side = -math.copysign(1.0, math.sin(values["phi"] - values["gamma"]))
    return mechanism, {**values, "s": sizes["B"], "v": sizes["V_B"], "a": sizes["a_B"], "side": side}


@pytest.mark.parametrize(("phi", "gamma"), [(0.4, 0.0), (2.0, 0.7), (-1.0, 0.7)])
def test_slider_that_drives_a_crank_moves_it_as_the_crank_moved_the_slider(phi: float, gamma: float) -> None:
    values = {**VALUES, "phi": phi + gamma, "gamma": gamma}
    mechanism, own = piston(values)

    found = solve_linkage(mechanism, own)

    assert found.status == "ok"
    assert found.values["omega_3"] == pytest.approx(8.0, rel=1e-12)
    assert found.values["epsilon_3"] == pytest.approx(0.0, abs=1e-10)
    assert found.values["M_3"] == -20.0
    assert found.values["F_bal"] == pytest.approx(found.values["F_bal_lever"], rel=1e-11)
    u = np.exp(1j * gamma)
    assert (found.point("R_01").conjugate() * u).real == pytest.approx(0.0, abs=1e-9)
    whole = found.point("_F_bal") + found.point("R_01") + found.point("R_21") + found.point("F_i1")
    assert whole == pytest.approx(0.0, abs=1e-9)


def test_slider_that_drives_bears_a_load_off_its_guide_with_an_arm() -> None:
    mechanism, own = piston(VALUES)
    high = replace(mechanism.links[0], points={"B": ORIGIN, "E": (ZERO, "l_OA")})
    loaded = replace(mechanism, links=(high, *mechanism.links[1:]), loads=(Load("F_1", 1, "E", "F", ZERO),))

    found = solve_linkage(loaded, own)

    assert found.values["M_01"] == pytest.approx(700.0 * CRANK)
    assert found.values["h_01"] == pytest.approx(700.0 * CRANK / found.size("R_01"))


def changed(**parts: Any) -> Mechanism:
    return replace(SLIDER_CRANK, **parts)


def by_diagram(over: str, *at: str) -> Mechanism:
    diagram = Diagram("P", over, at, SIZES[: len(at)])
    return changed(loads=(Load("F_3", 3, "B", "P"),), diagrams=(diagram,))


IN_A_STROKE = (Load("F_3", 3, "B", "F", None, WORKING),)
SLIDER_BY_LENGTH = (*SLIDER_CRANK.links[:2], Link(3, {"B": ORIGIN}, "B", "m_3", None, "m_2"))
DOUBLE_CRANK = replace(
    FOUR_BAR, couples=(Couple("M_3", 3, "M", None, WORKING),), stroke=Stroke(3), pairs=pins("O01 A12 B23:one C30@m_l")
)
REFUSED = {
    "no output": (changed(stroke=None, loads=IN_A_STROKE), "stroke-missing"),
    "output off the frame": (changed(stroke=Stroke(2), loads=IN_A_STROKE), "stroke-link"),
    "the driver as output": (changed(stroke=Stroke(1), loads=IN_A_STROKE), "stroke-link"),
    "output that goes round": (replace(DOUBLE_CRANK, links=bodies("O A:l_CB", "A B:l_CB", "C B:l_CB")), "stroke-none"),
    "resisting at a pivot": (changed(loads=(Load("F_1", 1, "O", "F"),)), "load-still"),
    "mass by length of a slider": (changed(links=SLIDER_BY_LENGTH), "no-length"),
    "sliding driver without a guide": (changed(driver=SlidingDriver(1, "A", "l_S", "n_1")), "driver-guide"),
    "places that decrease": (by_diagram(STROKE, *PLACES[::-1]), "diagram-stroke"),
    "more than a turn": (by_diagram(ANGLE, "minus", "F"), "diagram-angle"),
}


@pytest.mark.parametrize(("mechanism", "key"), REFUSED.values(), ids=REFUSED)
def test_load_without_a_sense_is_refused(mechanism: Mechanism, key: str) -> None:
    with pytest.raises(InputError) as refused:
        solve(mechanism, m_l=0.05)

    assert refused.value.key == key
    assert all(refused.value.text(language) for language in LANGUAGES)
