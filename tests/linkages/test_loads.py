"""Loads in positions where their laws change: dead positions, ends of strokes, jumps of diagrams, pivots."""

from __future__ import annotations

import math
from dataclasses import replace
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
    Driver,
    Link,
    Load,
    Mechanism,
    Prismatic,
    Revolute,
    SlidingDriver,
    Stroke,
)
from kulman.plans.linkages.solved import SolvedLinkage, board_givens, solve_linkage
from kulman.scales.errors import LANGUAGES, InputError
from kulman.tests.support.mechanisms import ORIGIN, ZERO

CRANK, ROD, FRONT = 0.1, 0.35, 0.25  # the slider runs from 0.25 to 0.45 m
VALUES = {
    **{"l_OA": CRANK, "l_AB": ROD, "l_S": 0.15, "n_1": 8.0, "sense_1": 1.0, "phi": 1.0, "gamma": 0.0},
    **{"m_2": 3.0, "J_S2": 0.04, "m_3": 5.0, "F": 700.0, "M": 20.0, "g": 9.81, "minus": -1.0},
    **{f"at_{i}": at for i, at in enumerate((0.0, 0.25, 0.25, 1.0))},
    **{f"P_{i}": force for i, force in enumerate((100.0, 100.0, 400.0, 1000.0))},
    **{f"Q_{i}": force for i, force in enumerate((10.0, 20.0, 30.0, 40.0))},
}
SLIDER_CRANK = Mechanism(
    links=(
        Link(1, {"O": ORIGIN, "A": ("l_OA", ZERO)}, "O", "m_2"),
        Link(2, {"A": ORIGIN, "B": ("l_AB", ZERO), "S2": ("l_S", ZERO)}, "S2", "m_2", "J_S2"),
        Link(3, {"B": ORIGIN}, "B", "m_3"),
    ),
    pairs=(
        Revolute("O", (0, 1), ORIGIN),
        Revolute("A", (1, 2)),
        Revolute("B", (2, 3)),
        Prismatic("B", (3, 0), ORIGIN, "gamma"),
    ),
    driver=Driver(1, "O", "A", "phi", "n_1", "sense_1"),
    loads=(Load("F_3", 3, "B", "F"),),
    stroke=Stroke(3),
)
FOUR_BAR = Mechanism(
    links=(
        Link(1, {"O": ORIGIN, "A": ("l_OA", ZERO)}),
        Link(2, {"A": ORIGIN, "B": ("l_AB", ZERO)}),
        Link(3, {"C": ORIGIN, "B": ("l_CB", ZERO)}, "C", "m_3", "J_S2"),
    ),
    pairs=(
        Revolute("O", (0, 1), ORIGIN),
        Revolute("A", (1, 2)),
        Revolute("B", (2, 3), None, "one"),
        Revolute("C", (3, 0), ("l_OC", ZERO)),
    ),
    driver=Driver(1, "O", "A", "phi", "n_1", "sense_1"),
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


@pytest.mark.parametrize("phi", [0.0, math.pi, -math.pi])
def test_force_that_resists_is_zero_where_its_point_rests(phi: float) -> None:
    assert solve(phi=phi).values["F_3"] == 0.0


@pytest.mark.parametrize(("phi", "sense"), [(0.001, 1.0), (-2.0, 1.0), (1.0, -1.0), (math.pi + 1e-9, 1.0)])
def test_force_that_resists_is_opposite_to_the_velocity(phi: float, sense: float) -> None:
    found = solve(phi=phi, sense_1=sense)

    assert found.size("F_3") == pytest.approx(700.0, rel=1e-12)
    assert (found.point("F_3").conjugate() * found.point("V_B")).real == pytest.approx(-700.0 * found.size("V_B"))


def test_couple_that_resists_is_zero_where_its_link_does_not_turn() -> None:
    found = [solve(FOUR_BAR, phi=INNER + d).values["M_3"] for d in (-1e-9, 0.0, 1e-9)]

    assert sorted(found) == [-20.0, 0.0, 20.0]
    assert found[1] == 0.0


def test_couple_that_resists_on_a_link_that_never_turns_is_zero() -> None:
    found = solve(replace(SLIDER_CRANK, couples=(Couple("M_3", 3, "M", None),)))

    assert found.values["M_3"] == 0.0


@pytest.mark.parametrize("direction", ["one", "minus"])
@pytest.mark.parametrize("acts", [WORKING, IDLE])
def test_load_acts_in_its_stroke_from_its_beginning_to_before_its_end(direction: str, acts: str) -> None:
    """The slider goes along its guide while the crank turns from pi to 2 pi; a stroke begins where it rests."""
    load = Load("F_3", 3, "B", "F", ZERO, acts)
    mechanism = replace(SLIDER_CRANK, loads=(load,), stroke=Stroke(3, direction))
    along = (direction == "one") == (acts == WORKING)

    found = {phi: solve(mechanism, phi=phi).size("F_3") for phi in (math.pi, 4.0, 6.0, 2 * math.pi, 1.0, 3.0)}

    assert list(found.values()) == [700.0 * size for size in ((1, 1, 1, 0, 0, 0) if along else (0, 0, 0, 1, 1, 1))]


@pytest.mark.parametrize(
    ("place", "force"),
    [(0.25, 100.0), (0.28, 100.0), (0.2999, 100.0), (0.3001, 400.4), (0.375, 700.0), (0.45, 1000.0)],
)
def test_diagram_is_read_where_the_slider_stands_in_its_stroke(place: float, force: float) -> None:
    mechanism = replace(
        SLIDER_CRANK, loads=(Load("F_3", 3, "B", "P", ZERO),), diagrams=(Diagram("P", STROKE, PLACES, SIZES),)
    )

    found = solve(mechanism, phi=at_place(place))

    assert found.size("F_3") == pytest.approx(force, rel=1e-6)


@pytest.mark.parametrize(
    ("direction", "forth", "force"),
    [("one", 1.0, 700.0), ("one", -1.0, 30.0 + 10.0 / 3.0), ("minus", 1.0, 30.0 + 10.0 / 3.0), ("minus", -1.0, 700.0)],
)
def test_idle_stroke_has_values_of_its_own(direction: str, forth: float, force: float) -> None:
    """Half of the stroke is done at 0.35 m, whichever way it is counted."""
    diagram = Diagram("P", STROKE, PLACES, SIZES, BACK)
    loads = (Load("F_3", 3, "B", "P", ZERO),)
    mechanism = replace(SLIDER_CRANK, loads=loads, diagrams=(diagram,), stroke=Stroke(3, direction))
    expected = 600.0 if force == 700.0 else force  # from 400 at 0.25 to 1000 at 1

    found = solve(mechanism, phi=at_place(0.35, forth))

    assert found.size("F_3") == pytest.approx(expected, rel=1e-9)


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


@pytest.mark.parametrize("turns", [-3, 0, 2])
@pytest.mark.parametrize(
    ("phi", "force"), [(0.0, 10.0), (0.125, 15.0), (0.25, 20.0), (0.26, 30.4 - 0.2666), (1.0, 40.0), (3.6, 25.0)]
)
def test_diagram_over_the_angle_goes_round_with_the_crank(turns: int, phi: float, force: float) -> None:
    """Behind its last place, at 1 rad, it runs on to the first one, at 2 pi."""
    mechanism = replace(
        SLIDER_CRANK,
        loads=(Load("F_3", 3, "B", "P", ZERO),),
        diagrams=(Diagram("P", ANGLE, PLACES, BACK),),
        stroke=None,
    )
    expected = {0.26: 30.0 + 10.0 * 0.01 / 0.75, 3.6: 40.0 - 30.0 * 2.6 / (2 * math.pi - 1.0)}.get(phi, force)

    assert solve(mechanism, phi=phi + turns * 2 * math.pi).size("F_3") == pytest.approx(expected, rel=1e-9)


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

    assert with_it.point("G_1") == pytest.approx(-3.0 * 9.81j)
    assert with_it.point("R_01") - without.point("R_01") == pytest.approx(3.0 * 9.81j)
    assert with_it.values["M_bal"] == pytest.approx(without.values["M_bal"], rel=1e-14)
    assert "h_lever_G_1" not in with_it.values


def test_weight_of_a_balanced_rocker_loads_its_pivot() -> None:
    heavy, light = solve(replace(FOUR_BAR, gravity="g")), solve(FOUR_BAR)

    assert heavy.point("R_03") - light.point("R_03") == pytest.approx(5.0 * 9.81j)
    assert heavy.point("R_12") == pytest.approx(light.point("R_12"))


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
    links = {link.number: link for link in SLIDER_CRANK.links}
    renumbered = (
        Link(1, links[3].points, "B", "m_3"),
        links[2],
        Link(3, links[1].points, "O", "m_2"),
    )
    mechanism = Mechanism(
        renumbered,
        (
            Prismatic("B", (1, 0), ORIGIN, "gamma"),
            Revolute("B", (1, 2)),
            Revolute("A", (2, 3), None, "side"),
            Revolute("O", (3, 0), ORIGIN),
        ),
        SlidingDriver(1, "B", "s", "v", "a"),
        couples=(Couple("M_3", 3, "M", None),),
    )
    along = np.exp(1j * values["gamma"])
    sizes = {name: float((along.conjugate() * crank.point(name)).real) for name in ("B", "V_B", "a_B")}
    # seen from B towards O, the left is below the guide
    side = -math.copysign(1.0, math.sin(values["phi"] - values["gamma"]))
    return mechanism, {**values, "s": sizes["B"], "v": sizes["V_B"], "a": sizes["a_B"], "side": side}


@pytest.mark.parametrize("gamma", [0.0, 0.7])
@pytest.mark.parametrize("phi", [0.4, 2.0, -1.0])
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


IN_A_STROKE = (Load("F_3", 3, "B", "F", None, WORKING),)
BY_DIAGRAM = (Load("F_3", 3, "B", "P"),)
SLIDER_BY_LENGTH = (*SLIDER_CRANK.links[:2], Link(3, {"B": ORIGIN}, "B", "m_3", None, "m_2"))
REFUSED = {
    "no output": (changed(stroke=None, loads=IN_A_STROKE), "stroke-missing"),
    "output off the frame": (changed(stroke=Stroke(2), loads=IN_A_STROKE), "stroke-link"),
    "the driver as output": (changed(stroke=Stroke(1), loads=IN_A_STROKE), "stroke-link"),
    "resisting at a pivot": (changed(loads=(Load("F_1", 1, "O", "F"),)), "load-still"),
    "mass by length of a slider": (changed(links=SLIDER_BY_LENGTH), "no-length"),
    "sliding driver without a guide": (changed(driver=SlidingDriver(1, "A", "l_S", "n_1")), "driver-guide"),
    "places that decrease": (
        changed(loads=BY_DIAGRAM, diagrams=(Diagram("P", STROKE, PLACES[::-1], SIZES),)),
        "diagram-stroke",
    ),
    "more than a turn": (
        changed(loads=BY_DIAGRAM, diagrams=(Diagram("P", ANGLE, ("minus", "F"), SIZES[:2]),)),
        "diagram-angle",
    ),
}


@pytest.mark.parametrize(("mechanism", "key"), REFUSED.values(), ids=REFUSED)
def test_load_without_a_sense_is_refused(mechanism: Mechanism, key: str) -> None:
    with pytest.raises(InputError) as refused:
        solve(mechanism)

    assert refused.value.key == key
    assert all(refused.value.text(language) for language in LANGUAGES)


def test_output_that_goes_round_has_no_stroke() -> None:
    double_crank = replace(FOUR_BAR, couples=(Couple("M_3", 3, "M", None, WORKING),), stroke=Stroke(3))

    with pytest.raises(InputError) as refused:
        solve(double_crank, l_OC=0.05, l_OA=0.3, l_AB=0.3, l_CB=0.3)

    assert refused.value.key == "stroke-none"
