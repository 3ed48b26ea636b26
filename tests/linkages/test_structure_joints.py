"""Joints of three links: the structure and the forces are the same whichever two pairs a task names of them."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations, permutations

import numpy as np
import pytest

from kulman.plans.linkages.mechanism import Driver, Link, Load, Mechanism, Pair, Prismatic, Revolute
from kulman.plans.linkages.solved import SolvedLinkage, solve_linkage
from kulman.plans.linkages.structure import analyse
from kulman.scales.errors import LANGUAGES, InputError
from kulman.tests.support.jacobian_solver import JacobianSolver
from kulman.tests.support.mechanisms import ORIGIN, ZERO, bare, revolutes

# a toggle press: rocker 3, coupler 2 and the rod 4 of the ram 5 share the joint B
VALUES = {
    **{"phi": 0.9, "n_1": 7.0, "sense_1": -1.0, "l_OA": 0.1, "l_AB": 0.42, "l_CB": 0.35, "l_BD": 0.5, "l_S": 0.2},
    **{"x_C": 0.4, "y_C": 0.45, "branch": -1.0, "x_g": 0.7, "down": -1.2, "side": 1.0},
    **{"m": 3.0, "J": 0.05, "F": 900.0, "alpha": 1.1},
}
LINKS = (
    Link(1, {"O": ORIGIN, "A": ("l_OA", ZERO)}),
    Link(2, {"A": ORIGIN, "B": ("l_AB", ZERO), "S2": ("l_S", ZERO)}, "S2", "m", "J"),
    Link(3, {"C": ORIGIN, "B": ("l_CB", ZERO), "S3": ("l_S", ZERO)}, "S3", "m", "J"),
    Link(4, {"B": ORIGIN, "D": ("l_BD", ZERO), "S4": ("l_S", ZERO)}, "S4", "m", "J"),
    Link(5, {"D": ORIGIN}, "D", "m"),
)
OTHERS: tuple[Pair, ...] = (
    Revolute("O", (0, 1), ORIGIN),
    Revolute("A", (1, 2)),
    Revolute("C", (3, 0), ("x_C", "y_C")),
    Revolute("D", (4, 5)),
    Prismatic("D", (5, 0), ("x_g", ZERO), "down", ZERO, "side"),
)
TREES = list(combinations(((2, 3), (3, 4), (2, 4)), 2))
LOADS = (Load("F_2", 2, "S2", "F", "alpha"), Load("F_5", 5, "D", "F", "down"))


def press(first: tuple[int, int], second: tuple[int, int]) -> Mechanism:
    """Return the press with two pairs at B, the branch of the dyad stated by the second of them."""
    at_B = (Revolute("B", first), Revolute("B", second, None, "branch"))
    return Mechanism(LINKS, (*OTHERS, *at_B), Driver(1, "O", "A", "phi", "n_1", "sense_1"), LOADS)


def force_at(found: SolvedLinkage, link: int, joint: tuple[int, ...]) -> complex:
    """Return the sum of the forces with which the other links of a joint act on one of them."""
    return sum((found.point(f"R_{o}{link}") for o in joint if o != link and f"R_{o}{link}" in found.values), 0j)


@pytest.mark.parametrize("tree", TREES)
@pytest.mark.parametrize("backwards", [False, True])
def test_press_has_two_dyads_and_the_same_forces(
    tree: tuple[tuple[int, int], tuple[int, int]], backwards: bool
) -> None:
    first, second = (pair[::-1] if backwards else pair for pair in tree)
    usual = solve_linkage(press((2, 3), (3, 4)), VALUES)

    found = solve_linkage(press(first, second), VALUES)

    assert [(group.links, group.kind) for group in found.structure.groups] == [((2, 3), "RRR"), ((4, 5), "RRP")]
    assert found.structure.lower == 7
    for name in ("B", "V_D", "a_S4", "R_12", "R_03", "R_05", "R_54", "R_01"):
        assert found.point(name) == pytest.approx(usual.point(name), rel=1e-12)
    assert found.values["M_bal"] == pytest.approx(usual.values["M_bal"], rel=1e-12)
    assert found.values["M_bal_lever"] == pytest.approx(found.values["M_bal"], rel=1e-12)
    for link in (2, 3, 4):
        assert force_at(found, link, (2, 3, 4)) == pytest.approx(force_at(usual, link, (2, 3, 4)), rel=1e-11)


@pytest.mark.parametrize("tree", TREES)
def test_forces_between_links_that_a_task_joins_agree_with_a_solver_that_takes_the_pairs_as_they_are(
    tree: tuple[tuple[int, int], tuple[int, int]],
) -> None:
    mechanism = press(*tree)
    found = solve_linkage(mechanism, VALUES)
    corner = {1: "O", 2: "A", 3: "C", 4: "B", 5: "D"}
    ends = {1: "A", 2: "B", 3: "B", 4: "D", 5: "D"}
    places = [
        (found.point(p).real, found.point(p).imag, np.angle(found.point(ends[i]) - found.point(p)) if i < 5 else -1.2)
        for i, p in corner.items()
    ]

    expected = JacobianSolver(mechanism, VALUES, np.array([places])).expected

    assert found.values["M_bal"] == pytest.approx(float(expected["M_bal"][0]), rel=1e-10)
    for i, j in ((1, 2), (0, 3), (5, 4), (0, 5)):
        assert found.point(f"R_{i}{j}") == pytest.approx(complex(expected[f"R_{i}{j}"][0]), rel=1e-9)
    for link in (2, 3, 4):
        whole = sum(complex(expected[f"R_{o}{link}"][0]) for o in (2, 3, 4) if f"R_{o}{link}" in expected)
        assert force_at(found, link, (2, 3, 4)) == pytest.approx(whole, rel=1e-9)


@pytest.mark.parametrize("tree", list(permutations(((1, 2), (1, 4), (2, 4)), 2)))
def test_two_dyads_on_one_crank_pin_whatever_pairs_are_named(tree: tuple[tuple[int, int], tuple[int, int]]) -> None:
    at_A = revolutes(*(("A", *links) for links in tree))
    rest = revolutes(("O", 0, 1), ("B", 2, 3), ("C", 3, 0), ("D", 4, 5), ("E", 5, 0))

    groups = analyse(bare((*at_A, *rest), 5)).groups

    assert sorted(group.links for group in groups) == [(2, 3), (4, 5)]
    named = [{*links} for links in tree]
    assert all({*pair.links} in named for group in groups for pair in group.outer if pair.point == "A")


@pytest.mark.parametrize("tree", list(permutations(((0, 1), (0, 4), (1, 4)), 2)))
def test_two_links_on_one_pivot_of_the_frame_are_both_joined_with_it(
    tree: tuple[tuple[int, int], tuple[int, int]],
) -> None:
    at_O = revolutes(*(("O", *links) for links in tree))
    rest = revolutes(("A", 1, 2), ("B", 2, 3), ("C", 3, 0), ("B", 3, 5), ("D", 4, 5))

    structure = analyse(bare((*at_O, *rest), 5))

    assert [group.kind for group in structure.groups] == ["RRR", "RRR"]
    assert structure.groups[1].outer[0].point == "O"


def test_pair_too_many_in_a_joint_is_explained() -> None:
    at_A = revolutes(("A", 1, 2), ("A", 1, 4), ("A", 2, 4))
    rest = revolutes(("O", 0, 1), ("B", 2, 3), ("C", 3, 0), ("D", 4, 5), ("E", 5, 0))

    with pytest.raises(InputError) as refused:
        analyse(bare((*at_A, *rest), 5))

    assert (refused.value.key, refused.value.data) == ("joint-closed", {"point": "A", "links": "1, 2, 4", "n": 2})
    assert all("1, 2, 4" in refused.value.text(language) for language in LANGUAGES)


def test_branch_is_that_of_the_joint_whichever_pair_states_it() -> None:
    mechanism = press((2, 3), (3, 4))
    own = replace(mechanism, pairs=(*OTHERS, Revolute("B", (2, 3), None, "branch"), Revolute("B", (3, 4))))

    assert solve_linkage(mechanism, VALUES).point("B") == solve_linkage(own, VALUES).point("B")
