"""Slider-cranks that a user may write: other points and masses of the crank, none at all, guides without a branch."""

from __future__ import annotations

from dataclasses import replace

import pytest

from kulman.plans.boards.batch import batch
from kulman.plans.boards.exact import run
from kulman.plans.linkages.chain import construct
from kulman.plans.linkages.mechanism import ZERO, Link, Load, Mechanism, Prismatic, Revolute
from kulman.plans.linkages.solved import board_givens
from kulman.scales.errors import InputError
from kulman.tests.linkages.test_plans_second_solver import differing, quantities
from kulman.tests.support.mechanisms import ORIGIN, nau_slider_crank, nau_values
from kulman.tests.support.second_solver import SecondSolver

NAU = nau_slider_crank()
CRANK, ROD, SLIDER = NAU.links
PIN = {"O": ORIGIN, "A": ("l_OA", ZERO)}
VALUES = {**nau_values(), "l_S1": -0.02, "m_1": 1.3, "J_1": 0.01, "F_1": 400.0, "alpha_F1": 0.9}


def with_links(*links: Link) -> Mechanism:
    own = {link.number: link for link in links}
    return replace(NAU, links=tuple(own.get(link.number, link) for link in NAU.links))


def loaded_at(link: int, point: str) -> Mechanism:
    return replace(NAU, loads=(*NAU.loads, Load("F_1", link, point, "F_1", "alpha_F1")))


@pytest.mark.parametrize(
    "mechanism",
    [
        pytest.param(with_links(replace(CRANK, mass="m_1", inertia="J_1")), id="crank with its mass at the pivot"),
        pytest.param(with_links(Link(1, PIN, "A", "m_1")), id="crank with its mass at the pin"),
        pytest.param(with_links(Link(1, {**PIN, "S1": ("l_S1", ZERO)}, "S1", "m_1", "J_1")), id="counterweight"),
        pytest.param(with_links(replace(SLIDER, inertia="J_1")), id="slider with a moment of inertia"),
        pytest.param(with_links(Link(1, PIN), Link(2, ROD.points), Link(3, SLIDER.points)), id="no masses"),
        pytest.param(with_links(replace(ROD, inertia=None)), id="rod without a moment of inertia"),
        pytest.param(with_links(replace(ROD, mass=None)), id="rod with a centre of mass but no mass"),
        pytest.param(with_links(replace(ROD, centre="A")), id="rod with its mass at A"),
        pytest.param(with_links(replace(ROD, centre="B")), id="rod with its mass at B"),
        pytest.param(loaded_at(1, "O"), id="load on the pivot"),
        pytest.param(loaded_at(1, "A"), id="load on the crank pin"),
        pytest.param(loaded_at(2, "A"), id="load on the rod at A"),
        pytest.param(loaded_at(2, "S2"), id="load on the rod at its centre of mass"),
        pytest.param(
            replace(NAU, pairs=(NAU.pairs[0], Revolute("A", (2, 1)), Revolute("B", (3, 2)), NAU.pairs[3])),
            id="pairs with their links the other way round",
        ),
        pytest.param(replace(NAU, pairs=NAU.pairs[::-1], links=NAU.links[::-1]), id="pairs in another order"),
    ],
)
def test_every_quantity_of_an_own_mechanism_agrees_with_the_second_solver(mechanism: Mechanism) -> None:
    _, program = construct(mechanism)

    board = run(program, board_givens(mechanism, VALUES))

    assert differing(board, SecondSolver(mechanism, VALUES), quantities(program), 1e-11) == {}


def test_mechanism_without_any_load_has_no_reactions() -> None:
    mechanism = Mechanism((Link(1, PIN), Link(2, ROD.points), Link(3, SLIDER.points)), NAU.pairs, NAU.driver)
    _, program = construct(mechanism)

    board = run(program, board_givens(mechanism, VALUES))
    results, _ = batch(program, {**VALUES, "phi": [VALUES["phi"]] * 2}, ["R_12", "M_bal", "M_bal_lever"])

    assert [board.values[name] for name in ("R_12", "R_03", "R_01", "M_bal", "M_bal_lever")] == [0] * 5
    assert not any(array.any() for array in results.values())


def test_guide_without_a_branch_takes_the_position_along_its_direction() -> None:
    mechanism = replace(NAU, pairs=(*NAU.pairs[:3], Prismatic("B", (3, 0), ORIGIN, ZERO)))
    _, program = construct(mechanism)

    board = run(program, board_givens(mechanism, VALUES))

    assert board.values["B"] == run(construct(NAU)[1], board_givens(NAU, nau_values(branch_B=1.0))).values["B"]


def test_frame_as_a_slider_is_refused() -> None:
    moving = replace(NAU, pairs=(*NAU.pairs[:3], Prismatic("B", (0, 3), ORIGIN, ZERO)))

    with pytest.raises(InputError) as refused:
        construct(moving)

    assert refused.value.key == "moving-guide"
