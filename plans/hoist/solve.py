"""A hoist solved: its construction, values and quantities together, and what formulas and rope are judged by."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..boards.exact import run
from ..quantities import Quantity, quantities
from ..solved import Solved
from .forces import Forces, forces, motion_givens
from .givens import complete
from .hoist import PLANS, Hoist
from .model import model_program
from .refining import rest_of_root

UNITS = {
    "m": "kg",
    "alpha": "1",
    "k": "rad/s",
    "t": "s",
    "T": "s",
    "F": "N",
    "P": "N",
    "R": "N",
    "D": "N",
    "sigma": "Pa",
    "safety": "1",
    "dynamic": "1",
    "V": "m/s",
    "phi": "rad",
}
STIFFNESSES = ("C", "C_01", "C_k", "C_2", "C_12")


def unit_of(name: str) -> str:
    """Return the SI unit of a quantity of a hoist by its name."""
    return "N/m" if name in STIFFNESSES else UNITS.get(name.partition("_")[0], "m")


@dataclass(frozen=True, slots=True, kw_only=True)
class SolvedHoist(Solved):
    """A hoist solved; `forces` are its numbers and checks, and its motion where the formulas are not valid."""

    hoist: Hoist
    forces: Forces


def solve_hoist(hoist: Hoist, values: Mapping[str, Any], plans: Iterable[str] = PLANS) -> SolvedHoist:
    """Solve a hoist.

    Parameters
    ----------
    hoist : Hoist
        With its sides chosen.
    values : mapping of str to float
        Its numbers in SI, as `givens.complete` takes them.
    plans : iterable of str
        Plans wanted, of `hoist.PLANS`: the numbers need none of them.

    Raises
    ------
    InputError
        Numbers that no hoist can have, or a motion of too many pieces.
    """
    found = forces(values)
    givens = complete(values)
    program = model_program(found.motion is not None)
    begin = givens | ({"_rest": rest_of_root(givens)} if found.motion is None else motion_givens(found.motion))
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        board = run(program, begin)
    return SolvedHoist(
        program=program,
        values=board.values,
        quantities=_stated(quantities(program, board.values, {}, unit_of)),
        sines=board.sines,
        status=board.status,
        trouble=board.trouble,
        shown_on={},
        scale_of_plan={},
        givens=begin,
        hoist=hoist,
        forces=found,
    )


def _stated(found: Mapping[str, Quantity]) -> dict[str, Quantity]:
    """Return the quantities without marks of plans."""
    return {name: quantity for name, quantity in found.items() if quantity.kind == "scalar"}
