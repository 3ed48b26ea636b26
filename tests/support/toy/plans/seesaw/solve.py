"""A seesaw drawn and solved: the balance of moments, the reaction of the pivot as the closing side of the forces."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from kulman.plans.board import Board, recorded
from kulman.plans.boards.exact import run
from kulman.plans.condition import Condition, conditions_again
from kulman.plans.hands.shaky import Paper, Tolerance
from kulman.plans.names import role
from kulman.plans.quantities import quantities, shown_on
from kulman.plans.solved import Solved
from kulman.tests.support.toy.plans.seesaw.seesaw import BALANCE, PLANS, SCHEME, Seesaw

SCALES = {SCHEME: "mu_l", BALANCE: "mu_F"}


def balanced(board: Board) -> None:
    """The moments about the pivot are in balance."""
    board.calc("M_1", "crank_moment", "F_1", "l_1")
    board.calc("F_2", "moment_equation", "l_2", "M_1")


def scheme(board: Board) -> None:
    """Draw the arms to both sides of the pivot."""
    board.pole("scheme.O")
    board.lay("scheme.A", "scheme.O", "_side", "l_1")
    board.back("scheme.B", "scheme.O", "_side", "l_2")
    board.distance("l_AB", "scheme.A", "scheme.B")


def forces(board: Board) -> None:
    """Hang both forces on one another: what closes them is the reaction of the pivot."""
    board.pole("balance.p")
    board.lay("balance.a", "balance.p", "_down", "F_1")
    board.lay("balance.b", "balance.a", "_down", "F_2")
    board.read("Q_O", "balance.b", "balance.p")


PARTS = {SCHEME: (scheme,), BALANCE: (forces,)}


@dataclass(frozen=True, kw_only=True)
class SolvedSeesaw(Solved):
    """A seesaw solved."""

    seesaw: Seesaw
    plans: tuple[str, ...]


def unit_of(name: str) -> str:
    """Return the SI unit of a quantity."""
    return {"M": "N*m", "l": "m"}.get(role(name).kind, "N")


def solve_seesaw(seesaw: Seesaw, values: Mapping[str, float], plans: Iterable[str] = PLANS) -> SolvedSeesaw:
    """Solve a seesaw, whose side is chosen."""
    wanted = tuple(plan for plan in PLANS if plan in {*plans})
    program = recorded(balanced, *(part for plan in wanted for part in PARTS[plan]))
    numbers = {name: float(values[name]) for name in ("l_1", "l_2", "F_1")}
    givens = {**numbers, "_side": -1 + 0j if seesaw.near == "left" else 1 + 0j, "_down": -1j}
    board = run(program, givens)
    return SolvedSeesaw(
        program=program,
        values=board.values,
        quantities=quantities(program, board.values, {}, unit_of),
        sines=board.sines,
        status=board.status,
        trouble=board.trouble,
        shown_on=shown_on(program) | ({"l_AB": SCHEME} if SCHEME in wanted else {}),
        scale_of_plan={plan: SCALES[plan] for plan in wanted},
        givens=givens,
        seesaw=seesaw,
        plans=wanted,
    )


def section_of(name: str) -> str:
    """Return the section of the note, and of the form, in which a quantity stands."""
    return SCHEME if name == "l_AB" else BALANCE


def conditions_of(solved: SolvedSeesaw) -> dict[str, Condition]:
    """Return the condition of every quantity."""
    numbers = {name: solved.givens[name] for name in ("l_1", "l_2", "F_1")}
    return conditions_again(solved, lambda others: solve_seesaw(solved.seesaw, others, solved.plans), numbers)


def tolerances_of(solved: SolvedSeesaw, paper: Paper, tolerance: Tolerance) -> dict[str, float]:
    """Return nothing: the usual rule holds for all quantities."""
    return {}
