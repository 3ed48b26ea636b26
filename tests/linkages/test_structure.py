"""Mobility and Assur groups of known schemes and of joints of three links; schemes that are none are explained."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations, permutations

import numpy as np
import pytest

from kulman.plans.linkages.chain import construct
from kulman.plans.linkages.mechanism import ZERO, Load, Mechanism, Pair, Prismatic, Revolute
from kulman.plans.linkages.solved import SolvedLinkage, solve_linkage
from kulman.plans.linkages.structure import analyse
from kulman.scales.errors import LANGUAGES, InputError
from kulman.tests.support.jacobian_solver import JacobianSolver
from kulman.tests.support.mechanisms import (
    CRANK,
    bare,
    bodies,
    general_slider_crank,
    nau_slider_crank,
    pins,
    slide,
    twin,
)

SLIDER_CRANK = nau_slider_crank()
FOUR_BAR = bare("O01 A12 B23 C30")
ROCKER_AND_SLIDER = bare("O01 A12 B23 C30 D34 E45", slide("E", 5, 0))
TWO_FOUR_BARS = bare("O01 A12 B23 C30 A14 D45 E50")
SLOTTED_LINK = bare("O01 A12 C30", slide("A", 2, 3))
SINE_MECHANISM = bare("O01 A12", slide("A", 2, 3), slide("A", 3, 0))
TANGENT_MECHANISM = bare("O01 B23", slide("B", 2, 1), slide("B", 3, 0))
TRIAD = bare("O01 A12 B23 C34 E40 D35 F50")
CLOSED_CONTOUR = bare("O01 A12 B23 C34 D45 E52 F40")


def test_mechanism_with_one_driver_has_mobility_one() -> None:
    for mechanism in (SLIDER_CRANK, FOUR_BAR, ROCKER_AND_SLIDER, TWO_FOUR_BARS, TRIAD, SLOTTED_LINK):
        structure = analyse(mechanism)
        assert structure.mobility == 3 * structure.moving - 2 * structure.lower - structure.higher == 1
        assert (structure.moving, structure.lower) == (len(mechanism.links), len(mechanism.pairs))
        assert structure.driver == 1


@pytest.mark.parametrize(
    ("mechanism", "kind", "view"),
    [
        pytest.param(FOUR_BAR, "RRR", 1, id="four-bar"),
        pytest.param(SLIDER_CRANK, "RRP", 2, id="slider-crank"),
        pytest.param(SLOTTED_LINK, "RPR", 3, id="slotted link"),
        pytest.param(TANGENT_MECHANISM, "PRP", 4, id="tangent mechanism"),
        pytest.param(SINE_MECHANISM, "RPP", 5, id="sine mechanism"),
    ],
)
def test_dyad_has_the_kind_of_its_pairs(mechanism: Mechanism, kind: str, view: int) -> None:
    (group,) = analyse(mechanism).groups

    assert (group.kind, group.view, group.links) == (kind, view, (2, 3))
    assert (group.group_class, group.order, group.name) == (2, 2, "23")


def test_dyad_names_its_pairs_in_the_order_of_its_letters_also_when_written_backwards() -> None:
    backwards = replace(SLIDER_CRANK, links=SLIDER_CRANK.links[::-1], pairs=SLIDER_CRANK.pairs[::-1])

    (group,) = analyse(SLIDER_CRANK).groups

    assert [pair.point for pair in (group.outer[0], group.inner[0], group.outer[1])] == ["A", "B", "B"]
    assert group.outer[1].links == (3, 0)
    assert analyse(backwards).groups == (group,)


@pytest.mark.parametrize(
    ("mechanism", "expected"),
    [
        pytest.param(ROCKER_AND_SLIDER, [((2, 3), "RRR"), ((4, 5), "RRP")], id="in series"),
        pytest.param(
            bare("O01 A14 B45 C50 D52 E23", slide("E", 3, 0)), [((4, 5), "RRR"), ((2, 3), "RRP")], id="whatever numbers"
        ),
        pytest.param(TWO_FOUR_BARS, [((2, 3), "RRR"), ((4, 5), "RRR")], id="in parallel"),
        pytest.param(twin(series=False), [((2, 3), "RRP"), ((4, 5), "RRP")], id="two rods on a crank pin"),
    ],
)
def test_dyads_come_in_order_of_attachment(mechanism: Mechanism, expected: list[tuple[tuple[int, int], str]]) -> None:
    groups = analyse(mechanism).groups

    assert [(group.links, group.kind) for group in groups] == expected
    series = any({*groups[0].links} & {*pair.links} for pair in groups[1].outer)
    assert all(group.outer[0].links[0] == 1 for group in groups) == (not series)


def test_group_of_four_links_is_a_triad_or_a_closed_contour_that_has_no_construction() -> None:
    (triad,), (contour,) = analyse(TRIAD).groups, analyse(CLOSED_CONTOUR).groups
    with pytest.raises(InputError) as refused:
        construct(CLOSED_CONTOUR)

    assert (triad.links, triad.kind, triad.group_class, triad.order) == ((2, 3, 4, 5), "III", 3, 3)
    assert (len(triad.inner), triad.view) == (3, 3)
    assert (contour.links, contour.kind, contour.group_class, contour.order) == ((2, 3, 4, 5), "IV", 4, 2)
    assert (refused.value.key, refused.value.data) == ("no-construction", {"kind": "IV", "links": "2, 3, 4, 5"})


@pytest.mark.parametrize(
    ("mechanism", "w"),
    [
        pytest.param(bare("O01 A12 B20"), 0, id="three-bar truss"),
        pytest.param(bare("O01 A12 B23 C34 D40"), 2, id="five-bar"),
        pytest.param(bare("O01 O01"), -1, id="crank with two pivots"),
    ],
)
def test_mechanism_of_another_mobility_is_refused_with_its_mobility(mechanism: Mechanism, w: int) -> None:
    with pytest.raises(InputError) as refused:
        analyse(mechanism)

    assert refused.value.key in {"links-rigid", "links-free"}
    assert refused.value.data["w"] == w
    assert all(f"W = {w}" in refused.value.text(language) for language in LANGUAGES)


@pytest.mark.parametrize(
    ("mechanism", "key", "links"),
    [
        pytest.param(bare("O01 A12 B20 C21", more=1), "link-loose", "3", id="loose link"),
        pytest.param(bare("O01 A12 B23 C30 D34"), "link-loose", "4", id="link with one pair"),
        pytest.param(bare("O01 A23 B23 C23"), "links-apart", "2, 3", id="loose group"),
        pytest.param(bare("O01 A12 B23 C23"), "links-rigid", "2, 3", id="welded links"),
        pytest.param(bare("O01 A12 B20"), "links-rigid", "0, 1, 2", id="truss"),
        pytest.param(bare("O01 A12 B23 C30 D24 E34"), "links-rigid", "2, 3, 4", id="brace"),
        pytest.param(bare("O01 A12 B23 C34 D40"), "links-free", "2, 3, 4", id="five-bar"),
        pytest.param(bare("O01 A12 B23 C30 D34 E45 F56 G60"), "links-free", "4, 5, 6", id="five-bar on a rocker"),
        pytest.param(bare("A12 B23 C30", slide("C", 3, 0)), "links-rigid", "0, 3", id="driver off the frame"),
        pytest.param(
            bare("O01", slide("A", 2, 1), slide("B", 2, 3), slide("C", 3, 0)), "no-revolute", "2, 3", id="PPP"
        ),
        pytest.param(bare("A12 A14 A24 O01 B23 C30 D45 E50"), "joint-closed", "1, 2, 4", id="pair too many in a joint"),
    ],
)
def test_links_at_fault_are_named(mechanism: Mechanism, key: str, links: str) -> None:
    with pytest.raises(InputError) as refused:
        analyse(mechanism)

    named = refused.value.data.get("links", refused.value.data.get("link"))
    assert (refused.value.key, str(named)) == (key, links)
    assert all(links in refused.value.text(language) for language in LANGUAGES)


@pytest.mark.parametrize("mechanism", [SLIDER_CRANK, general_slider_crank()])
@pytest.mark.parametrize(
    ("plan", "drawn", "beyond"),
    [
        ("structure", "", ("V_", "e_", "omega")),
        ("position", "position", ("V_", "omega", "velocity")),
        (
            "velocity",
            "position velocity",
            ("a_", "F_i", "M_", "R_", "h_", "epsilon", "acceleration", "forces", "lever"),
        ),
        ("acceleration", "position velocity acceleration", ("F_i", "M_", "e_F", "R_", "forces")),
        ("forces", "position velocity acceleration forces_23 forces_2 forces_1", ("lever", "M_bal_lever", "delta")),
        ("lever", "position velocity acceleration lever", ("R_", "forces", "delta")),
    ],
)
def test_construction_draws_only_the_plans_that_are_needed(
    mechanism: Mechanism, plan: str, drawn: str, beyond: tuple[str, ...]
) -> None:
    _, program = construct(mechanism, [plan])

    assert " ".join(program.plans) == drawn
    assert [name for name in program.names if name.removeprefix("_").startswith(beyond)] == []


def test_every_step_stands_on_one_plan_and_uses_only_names_made_before_it() -> None:
    for mechanism in (SLIDER_CRANK, general_slider_crank(), twin(series=True), twin(series=False)):
        _, program = construct(mechanism)

        drawn = [step for plan in program.plans for step in program.on(plan) if step.verb != "calc"]
        assert sorted(drawn, key=program.steps.index) == [step for step in program if step.verb != "calc"]
        seen: set[str] = set()
        for step in program:
            assert seen.isdisjoint({step.name}), step
            assert ({*step.operands} - seen).isdisjoint(program.names), step
            seen.add(step.name)


# A toggle press: rocker 3, coupler 2 and the rod 4 of the ram 5 share the joint B.
VALUES = {
    **{"phi": 0.9, "n_1": 7.0, "sense_1": -1.0, "l_OA": 0.1, "l_AB": 0.42, "l_CB": 0.35, "l_BD": 0.5, "l_S": 0.2},
    **{"x_C": 0.4, "y_C": 0.45, "branch": -1.0, "x_g": 0.7, "down": -1.2, "side": 1.0},
    **{"m": 3.0, "J": 0.05, "F": 900.0, "alpha": 1.1},
}
RODS = (f"{ends} S{i}:l_S / S{i} m J" for i, ends in enumerate(("A B:l_AB", "C B:l_CB", "B D:l_BD"), 2))
LINKS = bodies("O A:l_OA", *RODS, "D / D m")
OTHERS: tuple[Pair, ...] = (
    *pins("O01 A12 C30@x_C,y_C D45"),
    Prismatic("D", (5, 0), ("x_g", ZERO), "down", ZERO, "side"),
)
LOADS = (Load("F_2", 2, "S2", "F", "alpha"), Load("F_5", 5, "D", "F", "down"))
Tree = tuple[tuple[int, int], tuple[int, int]]


def press(first: tuple[int, int], second: tuple[int, int]) -> Mechanism:
    """Return the press with two pairs at B, the branch of the dyad stated by the second of them."""
    at_B = (Revolute("B", first), Revolute("B", second, None, "branch"))
    return Mechanism(LINKS, (*OTHERS, *at_B), CRANK, LOADS)


def force_at(found: SolvedLinkage, link: int) -> complex:
    """Return the sum of the forces with which the other links of the joint B act on one of them."""
    return sum((found.point(f"R_{o}{link}") for o in (2, 3, 4) if f"R_{o}{link}" in found.values), 0j)


@pytest.mark.parametrize("tree", [*combinations(((2, 3), (3, 4), (2, 4)), 2)], ids=str)
def test_press_is_the_same_whichever_pairs_at_a_joint_of_three_links_a_task_names(tree: Tree) -> None:
    mechanism = press(*tree)
    usual, found = solve_linkage(press((2, 3), (3, 4)), VALUES), solve_linkage(mechanism, VALUES)
    backwards = solve_linkage(press(tree[0][::-1], tree[1][::-1]), VALUES)
    first = (Revolute("B", tree[0], None, "branch"), Revolute("B", tree[1]))  # whichever pair states the branch
    other_states = solve_linkage(replace(mechanism, pairs=(*OTHERS, *first)), VALUES)
    ends = ("OA", "AB", "CB", "BD", "DD")
    places = [(found.point(a).real, found.point(a).imag, np.angle(found.point(b) - found.point(a))) for a, b in ends]
    places[-1] = (*places[-1][:2], -1.2)

    expected = JacobianSolver(mechanism, VALUES, np.array([places])).expected

    assert [(group.links, group.kind) for group in found.structure.groups] == [((2, 3), "RRR"), ((4, 5), "RRP")]
    assert found.structure.lower == 7
    for other in (usual, backwards, other_states):
        for name in ("B", "V_D", "a_S4", "R_12", "R_03", "R_05", "R_54", "R_01"):
            assert found.point(name) == pytest.approx(other.point(name), rel=1e-12)
        for link in (2, 3, 4):
            assert force_at(found, link) == pytest.approx(force_at(other, link), rel=1e-11)
    assert found.values["M_bal"] == pytest.approx(float(expected["M_bal"][0]), rel=1e-10)
    assert found.values["M_bal_lever"] == pytest.approx(found.values["M_bal"], rel=1e-12)
    for name in ("R_12", "R_03", "R_54", "R_05"):
        assert found.point(name) == pytest.approx(complex(expected[name][0]), rel=1e-9)
    for link in (2, 3, 4):
        whole = sum(complex(expected[f"R_{o}{link}"][0]) for o in (2, 3, 4) if f"R_{o}{link}" in expected)
        assert force_at(found, link) == pytest.approx(whole, rel=1e-9)


@pytest.mark.parametrize("tree", [*permutations((12, 14, 24), 2)], ids=str)
def test_two_dyads_on_one_crank_pin_whatever_pairs_are_named(tree: tuple[int, int]) -> None:
    groups = analyse(bare(f"A{tree[0]} A{tree[1]} O01 B23 C30 D45 E50")).groups

    assert sorted(group.links for group in groups) == [(2, 3), (4, 5)]
    named = [{*divmod(links, 10)} for links in tree]
    assert all({*pair.links} in named for group in groups for pair in group.outer if pair.point == "A")


@pytest.mark.parametrize("tree", [*permutations(("01", "04", "14"), 2)], ids=str)
def test_two_links_on_one_pivot_of_the_frame_are_both_joined_with_it(tree: tuple[str, str]) -> None:
    structure = analyse(bare(f"O{tree[0]} O{tree[1]} A12 B23 C30 B35 D45"))

    assert [group.kind for group in structure.groups] == ["RRR", "RRR"]
    assert structure.groups[1].outer[0].point == "O"
