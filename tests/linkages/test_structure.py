"""Mobility and Assur groups of known schemes; schemes that are none are explained."""

from __future__ import annotations

from collections.abc import Sequence

import pytest

from kulman.plans.linkages.chain import construct
from kulman.plans.linkages.mechanism import Mechanism
from kulman.plans.linkages.structure import analyse
from kulman.scales.errors import LANGUAGES, InputError
from kulman.tests.support.mechanisms import bare, general_slider_crank, nau_slider_crank, revolutes, slide, twin

CRANK = (("O", 0, 1), ("A", 1, 2))

FOUR_BAR = bare(revolutes(*CRANK, ("B", 2, 3), ("C", 3, 0)), 3)
ROCKER_AND_SLIDER = bare((*revolutes(*CRANK, ("B", 2, 3), ("C", 3, 0), ("D", 3, 4), ("E", 4, 5)), slide("E", 5, 0)), 5)
TWO_FOUR_BARS = bare(revolutes(*CRANK, ("B", 2, 3), ("C", 3, 0), ("A", 1, 4), ("D", 4, 5), ("E", 5, 0)), 5)
SLOTTED_LINK = bare((*revolutes(*CRANK, ("C", 3, 0)), slide("A", 2, 3)), 3)
SINE_MECHANISM = bare((*revolutes(*CRANK), slide("A", 2, 3), slide("A", 3, 0)), 3)
TANGENT_MECHANISM = bare((*revolutes(("O", 0, 1), ("B", 2, 3)), slide("B", 2, 1), slide("B", 3, 0)), 3)
TRIAD = bare(revolutes(*CRANK, ("B", 2, 3), ("C", 3, 4), ("E", 4, 0), ("D", 3, 5), ("F", 5, 0)), 5)
CLOSED_CONTOUR = bare(revolutes(*CRANK, ("B", 2, 3), ("C", 3, 4), ("D", 4, 5), ("E", 5, 2), ("F", 4, 0)), 5)


@pytest.mark.parametrize(
    "mechanism", [nau_slider_crank(), FOUR_BAR, ROCKER_AND_SLIDER, TWO_FOUR_BARS, TRIAD, SLOTTED_LINK]
)
def test_mechanism_with_one_driver_has_mobility_one(mechanism: Mechanism) -> None:
    structure = analyse(mechanism)

    assert structure.mobility == 3 * structure.moving - 2 * structure.lower - structure.higher == 1
    assert (structure.moving, structure.lower) == (len(mechanism.links), len(mechanism.pairs))
    assert structure.driver == 1


@pytest.mark.parametrize(
    ("mechanism", "kind", "view", "links"),
    [
        pytest.param(FOUR_BAR, "RRR", 1, (2, 3), id="four-bar"),
        pytest.param(nau_slider_crank(), "RRP", 2, (2, 3), id="slider-crank"),
        pytest.param(SLOTTED_LINK, "RPR", 3, (2, 3), id="slotted link"),
        pytest.param(TANGENT_MECHANISM, "PRP", 4, (2, 3), id="tangent mechanism"),
        pytest.param(SINE_MECHANISM, "RPP", 5, (2, 3), id="sine mechanism"),
    ],
)
def test_dyad_has_the_kind_of_its_pairs(mechanism: Mechanism, kind: str, view: int, links: tuple[int, ...]) -> None:
    (group,) = analyse(mechanism).groups

    assert (group.kind, group.view, group.links) == (kind, view, links)
    assert (group.group_class, group.order, group.name) == (2, 2, "23")


def test_dyad_names_its_pairs_in_the_order_of_its_letters() -> None:
    (group,) = analyse(nau_slider_crank()).groups

    assert [pair.point for pair in (group.outer[0], group.inner[0], group.outer[1])] == ["A", "B", "B"]
    assert group.outer[1].links == (3, 0)


def test_dyad_written_backwards_reads_the_same() -> None:
    mechanism = nau_slider_crank()
    backwards = Mechanism(mechanism.links[::-1], mechanism.pairs[::-1], mechanism.driver, mechanism.loads)

    groups = analyse(backwards).groups

    assert groups == analyse(mechanism).groups


def test_dyads_in_series_come_in_order_of_attachment() -> None:
    groups = analyse(ROCKER_AND_SLIDER).groups

    assert [(group.links, group.kind) for group in groups] == [((2, 3), "RRR"), ((4, 5), "RRP")]


def test_dyads_in_series_come_in_order_whatever_their_numbers() -> None:
    pairs = (*revolutes(("O", 0, 1), ("A", 1, 4), ("B", 4, 5), ("C", 5, 0), ("D", 5, 2), ("E", 2, 3)), slide("E", 3, 0))

    groups = analyse(bare(pairs, 5)).groups

    assert [(group.links, group.kind) for group in groups] == [((4, 5), "RRR"), ((2, 3), "RRP")]


@pytest.mark.parametrize("mechanism", [TWO_FOUR_BARS, twin(series=False)])
def test_dyads_in_parallel_both_hang_on_the_driver(mechanism: Mechanism) -> None:
    groups = analyse(mechanism).groups

    assert [group.links for group in groups] == [(2, 3), (4, 5)]
    assert all(group.outer[0].links[0] == 1 for group in groups)


def test_triad_is_one_group_of_class_three_and_third_order() -> None:
    (group,) = analyse(TRIAD).groups

    assert (group.links, group.kind, group.group_class, group.order) == ((2, 3, 4, 5), "III", 3, 3)
    assert (len(group.inner), group.view) == (3, 3)


def test_closed_contour_of_four_links_is_of_class_four_and_second_order() -> None:
    (group,) = analyse(CLOSED_CONTOUR).groups

    assert (group.links, group.kind, group.group_class, group.order) == ((2, 3, 4, 5), "IV", 4, 2)


@pytest.mark.parametrize(
    ("mechanism", "w"),
    [
        pytest.param(bare(revolutes(("O", 0, 1), ("A", 1, 2), ("B", 2, 0)), 2), 0, id="three-bar truss"),
        pytest.param(bare(revolutes(*CRANK, ("B", 2, 3), ("C", 3, 4), ("D", 4, 0)), 4), 2, id="five-bar"),
        pytest.param(bare(revolutes(("O", 0, 1), ("O", 0, 1)), 1), -1, id="crank with two pivots"),
    ],
)
def test_mechanism_of_another_mobility_is_refused_with_its_mobility(mechanism: Mechanism, w: int) -> None:
    with pytest.raises(InputError) as refused:
        analyse(mechanism)

    assert refused.value.key in {"links-rigid", "links-free"}
    assert refused.value.data["w"] == w
    assert all(f"W = {w}" in refused.value.text(language) for language in LANGUAGES)


@pytest.mark.parametrize(
    ("pairs", "count", "key", "links"),
    [
        pytest.param((("A", 1, 2), ("B", 2, 0), ("C", 2, 1)), 3, "link-loose", "3", id="loose link"),
        pytest.param(
            (("A", 1, 2), ("B", 2, 3), ("C", 3, 0), ("D", 3, 4)), 4, "link-loose", "4", id="link with one pair"
        ),
        pytest.param((("A", 2, 3), ("B", 2, 3), ("C", 2, 3)), 3, "links-apart", "2, 3", id="loose group"),
        pytest.param((("A", 1, 2), ("B", 2, 3), ("C", 2, 3)), 3, "links-rigid", "2, 3", id="welded links"),
        pytest.param((("A", 1, 2), ("B", 2, 0)), 2, "links-rigid", "0, 1, 2", id="truss"),
        pytest.param(
            (("A", 1, 2), ("B", 2, 3), ("C", 3, 0), ("D", 2, 4), ("E", 3, 4)), 4, "links-rigid", "2, 3, 4", id="brace"
        ),
        pytest.param((("A", 1, 2), ("B", 2, 3), ("C", 3, 4), ("D", 4, 0)), 4, "links-free", "2, 3, 4", id="five-bar"),
        pytest.param(
            (("A", 1, 2), ("B", 2, 3), ("C", 3, 0), ("D", 3, 4), ("E", 4, 5), ("F", 5, 6), ("G", 6, 0)),
            6,
            "links-free",
            "4, 5, 6",
            id="five-bar on a rocker",
        ),
    ],
)
def test_links_at_fault_are_named(pairs: Sequence[tuple[str, int, int]], count: int, key: str, links: str) -> None:
    with pytest.raises(InputError) as refused:
        analyse(bare(revolutes(("O", 0, 1), *pairs), count))

    named = refused.value.data.get("links", refused.value.data.get("link"))
    assert (refused.value.key, str(named)) == (key, links)
    assert all(links in refused.value.text(language) for language in LANGUAGES)


def test_driver_off_the_frame_is_refused() -> None:
    pairs = (*revolutes(("A", 1, 2), ("B", 2, 3), ("C", 3, 0)), slide("C", 3, 0))

    with pytest.raises(InputError):
        analyse(bare(pairs, 3))


def test_three_sliding_pairs_form_no_group() -> None:
    pairs = (*revolutes(("O", 0, 1)), slide("A", 2, 1), slide("B", 2, 3), slide("C", 3, 0))

    with pytest.raises(InputError) as refused:
        analyse(bare(pairs, 3))

    assert refused.value.key == "no-revolute"


def test_group_without_a_construction_is_named() -> None:
    with pytest.raises(InputError) as refused:
        construct(CLOSED_CONTOUR)

    assert refused.value.key == "no-construction"
    assert refused.value.data == {"kind": "IV", "links": "2, 3, 4, 5"}


@pytest.mark.parametrize("mechanism", [nau_slider_crank(), general_slider_crank()])
@pytest.mark.parametrize(
    ("plan", "drawn"),
    [
        ("structure", ()),
        ("position", ("position",)),
        ("velocity", ("position", "velocity")),
        ("acceleration", ("position", "velocity", "acceleration")),
        ("forces", ("position", "velocity", "acceleration", "forces_23", "forces_2", "forces_1")),
        ("lever", ("position", "velocity", "acceleration", "lever")),
    ],
)
def test_construction_draws_only_the_plans_that_are_needed(
    mechanism: Mechanism, plan: str, drawn: tuple[str, ...]
) -> None:
    _, program = construct(mechanism, [plan])

    assert program.plans == drawn


def test_velocity_plan_records_no_acceleration_and_no_force() -> None:
    _, program = construct(nau_slider_crank(), ["velocity"])

    beyond = ("a_", "F_", "M_", "R_", "h_", "epsilon", "acceleration", "forces", "lever", "e_F")
    assert [name for name in program.names if name.removeprefix("_").startswith(beyond)] == []
    assert {"V_A", "V_B", "V_BA", "V_S2", "omega_1", "omega_2"} <= set(program.names)


def test_position_plan_records_no_velocity() -> None:
    _, program = construct(nau_slider_crank(), ["position"])

    assert [name for name in program.names if "V_" in name or "omega" in name] == []


def test_acceleration_plan_records_no_inertia() -> None:
    _, program = construct(nau_slider_crank(), ["acceleration"])

    assert [name for name in program.names if name.startswith(("F_", "M_", "e_F", "R_"))] == []


def test_lever_alone_records_no_reaction() -> None:
    _, program = construct(nau_slider_crank(), ["lever"])

    assert [name for name in program.names if "R_" in name or name in ("M_bal", "delta_M_bal")] == []
    assert "M_bal_lever" in program.names


def test_every_step_that_draws_stands_on_one_plan() -> None:
    _, program = construct(nau_slider_crank())

    drawn = [step for plan in program.plans for step in program.on(plan) if step.verb != "calc"]

    assert sorted(drawn, key=program.steps.index) == [step for step in program if step.verb != "calc"]
    assert [step.name for step in program.on("velocity") if step.verb == "read"] == ["V_A", "V_BA", "V_B", "V_S2"]


def test_every_step_uses_only_names_made_before_it() -> None:
    for mechanism in (nau_slider_crank(), general_slider_crank(), twin(series=True), twin(series=False)):
        _, program = construct(mechanism)
        made = set(program.names)
        seen: set[str] = set()

        for step in program:
            assert made.isdisjoint(set(step.operands) - seen), step
            seen.add(step.name)

        assert len(program.names) == len(made)
