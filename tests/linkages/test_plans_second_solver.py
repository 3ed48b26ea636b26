"""Every quantity of the chain against a second solver: derivatives of the closure, one linear system, virtual power."""

from __future__ import annotations

from collections.abc import Iterable

import pytest
from mpmath import mp, mpf

from kulman.plans.board import Program
from kulman.plans.boards.exact import ExactBoard, run
from kulman.plans.linkages.chain import construct
from kulman.plans.linkages.mechanism import Mechanism
from kulman.plans.linkages.solved import board_givens
from kulman.tests.support.mechanisms import (
    general_slider_crank,
    nau_cases,
    nau_slider_crank,
    nau_values,
    one_of,
    random_slider_cranks,
    twin,
    twin_values,
)
from kulman.tests.support.second_solver import SecondSolver

RELATIVE = 1e-11


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
    values, q = second.v, second.quantities
    speed = abs(second.omega_1) * values["l_OA"]
    if name.startswith("h_lever"):
        return speed
    if name.startswith("h_"):
        return values["l_AB"]
    if name.startswith(("omega", "epsilon")):
        return abs(second.omega_1) ** (2 if name.startswith("epsilon") else 1)
    if name.startswith(("V_", "a_")):
        return speed if name[0] == "V" else speed * abs(second.omega_1)
    force = max(abs(force) for forces in second.loads.values() for _, force, _ in forces)
    if name.startswith("M_"):
        return force * values["l_OA"]
    if name == "delta_M_bal":
        return mpf(100) * max(1, force * values["l_OA"] / abs(q["M_bal"]))
    return force if name.startswith(("F_", "R_")) else values["l_AB"]


@pytest.mark.parametrize(("variant", "side", "rotation"), nau_cases())
def test_every_quantity_of_a_variant_agrees_with_the_second_solver(variant: str, side: str, rotation: str) -> None:
    mechanism, values = nau_slider_crank(), nau_values(variant, side, rotation)

    program, board, second = solve_both(mechanism, values)

    assert board.status == "ok"
    assert differing(board, second, quantities(program), RELATIVE) == {}


@pytest.mark.parametrize(("variant", "side", "rotation"), nau_cases())
def test_balancing_moment_of_a_variant_agrees_by_plan_lever_and_virtual_power(
    variant: str, side: str, rotation: str
) -> None:
    mechanism, values = nau_slider_crank(), nau_values(variant, side, rotation)

    _, board, second = solve_both(mechanism, values)

    by_power = second.quantities["M_bal_lever"]
    assert abs(board.values["M_bal"] / by_power - 1) <= 1e-12
    assert abs(board.values["M_bal_lever"] / by_power - 1) <= 1e-12
    assert abs(second.M_bal / by_power - 1) <= mpf("1e-20")


@pytest.mark.parametrize("index", range(60))
def test_every_quantity_of_a_random_mechanism_agrees_with_the_second_solver(index: int) -> None:
    mechanism, values = general_slider_crank(), one_of(random_slider_cranks(7, 60), index)

    program, board, second = solve_both(mechanism, values)

    assert differing(board, second, quantities(program), RELATIVE) == {}


@pytest.mark.parametrize("series", [False, True], ids=["parallel", "series"])
def test_two_dyads_agree_with_the_second_solver(series: bool) -> None:
    mechanism, values = twin(series), twin_values()

    program, board, second = solve_both(mechanism, values)

    assert differing(board, second, quantities(program), RELATIVE) == {}


def test_second_solver_notices_a_wrong_number() -> None:
    mechanism, values = nau_slider_crank(), nau_values()
    program, board, second = solve_both(mechanism, values)

    board.values["h_2"] *= 1 + 1e-10

    assert list(differing(board, second, quantities(program), RELATIVE)) == ["h_2"]
