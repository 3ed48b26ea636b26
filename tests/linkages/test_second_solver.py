"""Every quantity of the chain against a second solver: derivatives of the closure, one linear system, virtual power."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import replace

import pytest
from mpmath import mp, mpf

from kulman import load_task, solve
from kulman.plans.board import Program
from kulman.plans.boards.exact import ExactBoard, run
from kulman.plans.linkages.chain import construct
from kulman.plans.linkages.mechanism import ZERO, Link, Load, Mechanism, Prismatic
from kulman.plans.linkages.solved import board_givens, solve_linkage
from kulman.scales.errors import InputError
from kulman.tests.support.mechanisms import (
    NAU_VARIANTS,
    ORIGIN,
    ROTATIONS,
    general_slider_crank,
    nau_cases,
    nau_slider_crank,
    nau_values,
    one_of,
    pins,
    random_slider_cranks,
    twin,
    twin_values,
)
from kulman.tests.support.second_solver import SecondSolver

RELATIVE = 1e-11
NAU = nau_slider_crank()


def solve_both(mechanism: Mechanism, values: dict[str, float]) -> tuple[Program, ExactBoard, SecondSolver]:
    """Solve one position by the plans and by the second solver."""
    _, program = construct(mechanism)
    return program, run(program, board_givens(mechanism, values)), SecondSolver(mechanism, values)


def quantities(program: Program) -> list[str]:
    """Names that are neither intermediate values nor marks of a plan."""
    return [name for name in program.names if not name.startswith("_") and "." not in name]


def differing(board: ExactBoard, second: SecondSolver, names: Iterable[str], relative: float) -> dict[str, float]:
    """Return the names whose values differ, with the part by which they do; one of two equal values may be zero."""
    found = {}
    for name in names:
        expected = second.quantities[name]
        error = abs(mp.mpmathify(board.values[name]) - expected)
        if not error <= relative * abs(expected) and not error <= mpf("1e-12") * size_of(second, name):
            found[name] = float(error / abs(expected)) if expected else float(error)
    return found


def size_of(second: SecondSolver, name: str) -> mpf:
    """Size of a kind of quantity, below 1e-12 of which a value counts as zero."""
    values, omega = second.v, abs(second.omega_1)
    speed = omega * values["l_OA"]
    force = max(abs(force) for forces in second.loads.values() for _, force, _ in forces)
    moment = force * values["l_OA"]
    sizes = {"h_lever": speed, "omega": omega, "epsilon": omega**2, "V_": speed, "a_": speed * omega}
    sizes |= {"M_": moment, "F_": force, "R_": force}
    if name == "delta_M_bal":
        return mpf(100) * max(1, moment / abs(second.quantities["M_bal"]))
    return next((size for kind, size in sizes.items() if name.startswith(kind)), values["l_AB"])


@pytest.mark.parametrize(("variant", "side", "rotation"), nau_cases())
def test_every_quantity_of_a_variant_agrees_with_the_second_solver(variant: str, side: str, rotation: str) -> None:
    task, expected = load_task("nau-slider-crank"), nau_values(variant, side, rotation)
    values = task.values(variant, {"side": side, "rotation": rotation})
    program, board, second = solve_both(NAU, expected)

    solved = solve_linkage(task.mechanism, values)

    by_power = second.quantities["M_bal_lever"]
    assert list(task.variants) == list(NAU_VARIANTS)
    assert {name: values[name] for name in expected} == pytest.approx(expected, rel=1e-15)  # those of the guide
    assert board.status == solved.status == "ok"
    assert differing(board, second, quantities(program), RELATIVE) == {}
    assert abs(board.values["M_bal"] / by_power - 1) <= 1e-12
    assert abs(board.values["M_bal_lever"] / by_power - 1) <= 1e-12
    assert abs(second.M_bal / by_power - 1) <= mpf("1e-20")
    for name, quantity in solved.quantities.items():
        right, value = (second.v | second.quantities)[name], mp.mpmathify(solved.values.get(name, quantity.value))
        assert abs(value - right) <= max(abs(right) * mpf(RELATIVE), mpf("1e-12") * size_of(second, name)), name
        if quantity.kind == "vector":
            assert quantity.value == pytest.approx(math.hypot(quantity.x or 0.0, quantity.y or 0.0), rel=1e-15)


@pytest.mark.parametrize("index", range(20))
def test_every_quantity_of_a_random_mechanism_agrees_with_the_second_solver(index: int) -> None:
    program, board, second = solve_both(general_slider_crank(), one_of(random_slider_cranks(7, 60), index))

    assert differing(board, second, quantities(program), RELATIVE) == {}


@pytest.mark.soak
@pytest.mark.parametrize("seed", range(10))
def test_every_quantity_of_a_hundred_random_mechanisms_agrees(seed: int) -> None:
    values, flat = random_slider_cranks(1000 + seed, 100), random_slider_cranks(2000 + seed, 30, least_sine=1e-4)
    for index in range(100):
        program, board, second = solve_both(general_slider_crank(), one_of(values, index))
        assert differing(board, second, quantities(program), RELATIVE) == {}, index
    for index in range(30):
        program, board, second = solve_both(general_slider_crank(), one_of(flat, index))
        loss = min(board.sines.values()) ** 4  # position, velocity, acceleration and force plan meet at this angle
        assert differing(board, second, quantities(program), 1e-12 / loss) == {}, index


def test_second_solver_notices_a_wrong_number() -> None:
    program, board, second = solve_both(NAU, nau_values())

    board.values["h_2"] *= 1 + 1e-10

    assert list(differing(board, second, quantities(program), RELATIVE)) == ["h_2"]


# Slider-cranks that a user may write: other points and masses, none at all, guides without a branch.
CRANK, ROD, SLIDER = NAU.links
PIN = {"O": ORIGIN, "A": ("l_OA", ZERO)}
VALUES = {**twin_values(), "l_S1": -0.02, "m_1": 1.3, "J_1": 0.01, "F_1": 400.0, "alpha_F1": 0.9}


def with_links(*links: Link) -> Mechanism:
    own = {link.number: link for link in links}
    return replace(NAU, links=tuple(own.get(link.number, link) for link in NAU.links))


def loaded_at(link: int, point: str) -> Mechanism:
    return replace(NAU, loads=(*NAU.loads, Load("F_1", link, point, "F_1", "alpha_F1")))


OWN = {
    "crank with its mass at the pivot": with_links(replace(CRANK, mass="m_1", inertia="J_1")),
    "crank with its mass at the pin": with_links(Link(1, PIN, "A", "m_1")),
    "counterweight": with_links(Link(1, {**PIN, "S1": ("l_S1", ZERO)}, "S1", "m_1", "J_1")),
    "slider with a moment of inertia": with_links(replace(SLIDER, inertia="J_1")),
    "no masses": with_links(Link(1, PIN), Link(2, ROD.points), Link(3, SLIDER.points)),
    "rod without a moment of inertia": with_links(replace(ROD, inertia=None)),
    "rod with a centre of mass but no mass": with_links(replace(ROD, mass=None)),
    "rod with its mass at A": with_links(replace(ROD, centre="A")),
    "rod with its mass at B": with_links(replace(ROD, centre="B")),
    "load on the pivot": loaded_at(1, "O"),
    "load on the crank pin": loaded_at(1, "A"),
    "load on the rod at A": loaded_at(2, "A"),
    "load on the rod at its centre of mass": loaded_at(2, "S2"),
    "links the other way round": replace(NAU, pairs=(NAU.pairs[0], *pins("A21 B32"), NAU.pairs[3])),
    "two dyads in parallel": twin(series=False),
    "two dyads in series": twin(series=True),
    "pairs in another order": replace(NAU, pairs=NAU.pairs[::-1], links=NAU.links[::-1]),
}


@pytest.mark.parametrize("mechanism", OWN.values(), ids=OWN)
def test_every_quantity_of_an_own_mechanism_agrees_with_the_second_solver(mechanism: Mechanism) -> None:
    program, board, second = solve_both(mechanism, VALUES)

    assert differing(board, second, quantities(program), 1e-11) == {}


def test_guide_without_a_branch_takes_the_position_along_its_direction_and_the_frame_is_no_slider() -> None:
    plain, moving = (replace(NAU, pairs=(*NAU.pairs[:3], Prismatic("B", n, ORIGIN, ZERO))) for n in ((3, 0), (0, 3)))

    board = run(construct(plain)[1], board_givens(plain, VALUES))
    with pytest.raises(InputError) as refused:
        construct(moving)

    assert board.values["B"] == run(construct(NAU)[1], board_givens(NAU, nau_values(branch_B=1.0))).values["B"]
    assert refused.value.key == "moving-guide"


@pytest.mark.parametrize("rotation", ROTATIONS)
@pytest.mark.parametrize("variant", ["0", "5"])
def test_sides_mirror_each_other_with_phi_taken_from_the_slider(variant: str, rotation: str) -> None:
    values = nau_values(variant, "left", rotation)
    other = nau_values(variant, "right", "ccw" if rotation == "cw" else "cw", phi=math.pi - values["phi"])

    left, right = (solve_linkage(NAU, each) for each in (values, other))

    for name, quantity in left.quantities.items():
        if quantity.kind == "vector" and "couple" not in name:
            assert right.values[name] == pytest.approx(-left.values[name].conjugate(), rel=1e-12, abs=1e-9), name


def test_where_a_template_lies_about_is_no_given_whose_errors_come_through() -> None:
    found = solve("scheme-20-press-automaton", only="forces,lever", condition=True).conditions

    balance, lever, off = (found[name].value for name in ("M_bal", "M_bal_lever", "delta_M_bal"))

    assert balance is not None
    assert off is not None
    assert off < 1e-12  # of two ways to one number
    assert lever == pytest.approx(balance, rel=1e-9)
