"""A hoist solved: its construction, values and quantities together, and what a teacher should let pass of them.

K is that of `plans.condition`, over Q. Roots are found beside the board, so that the derivatives are central
differences of all of it.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..board import Program
from ..boards.exact import run
from ..condition import Condition, by_solving_again, ratio
from ..hands.hand import Tolerance
from ..marking.key import rounded
from ..names import role
from ..quantities import Quantity, quantities, shown_on
from ..references import worst_behind
from ..solved import PAPER_MM, Solved, in_sections
from . import root_plans
from .beam_plans import BENT, SCHEME
from .construction import Layout, construct, layout_of
from .diagram_plan import FORCES, UP
from .forces import Forces, forces
from .hoist import PLANS, VALUES, Hoist, complete
from .model import CIRCLE, HORIZONTAL, SECTIONS, section_of
from .paper import SCALED, board_givens
from .root_plans import EXTREMES, LIFT_OFF

# the scale factor in which each plan shows values; on the diagrams that of the axis of ordinates
SCALES = {
    SCHEME: "mu_l",
    FORCES: "mu_F",
    LIFT_OFF: "mu_y",
    EXTREMES: "mu_v",
    CIRCLE: "mu_F_circle",
    **dict.fromkeys(BENT.values(), "mu_w"),
}
ON_PAPER = (FORCES, LIFT_OFF, EXTREMES, *BENT.values())  # plans that are drawn in millimetres of paper
# the plan that shows a quantity as a segment, the first of them that is drawn
SHOWN_ON = {
    **dict.fromkeys(("L", "l_0", "l_2", "b_0", "b_2"), (SCHEME,)),
    **dict.fromkeys(("P_st", "F_12_t1", "F_12_max", "P_12_max", "P_12_min"), (FORCES, CIRCLE)),
    **dict.fromkeys(("R", "D_0", "D_1", "P_m"), (CIRCLE,)),
    **{f"{name}_{i}{end}": (plan,) for i, plan in BENT.items() for name, end in (("w", ""), ("w", "_max"))},
}
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
    return "N/m" if name in STIFFNESSES else UNITS.get(role(name).kind or name, "m")


@dataclass(frozen=True, slots=True, kw_only=True)
class SolvedHoist(Solved):
    """A hoist solved; `forces` are its numbers and checks, and its motion where the formulas are not valid."""

    hoist: Hoist
    forces: Forces
    layout: Layout
    plans: tuple[str, ...]

    @property
    def edges(self) -> tuple[str, ...]:
        """The directions of axes, beams and rope."""
        return HORIZONTAL, UP

    def worth(self, mus: Mapping[str, float]) -> dict[str, float]:
        """Return what a millimetre of every plan is worth to the board: the diagrams are drawn in paper itself."""
        return {plan: PAPER_MM if plan in ON_PAPER else mu for plan, mu in mus.items()}


def solve_hoist(
    hoist: Hoist, values: Mapping[str, Any], plans: Iterable[str] = PLANS, part_of: float = 1.0
) -> SolvedHoist:
    """Solve a hoist.

    Parameters
    ----------
    hoist : Hoist
        With its sides chosen.
    values : mapping of str to float
        Its numbers in SI, as `givens.complete` takes them.
    plans : iterable of str
        Plans wanted, of `hoist.PLANS`: the numbers, with the circle, need none of them.
    part_of : float
        How much of their usual size diagrams on paper have, about.

    Raises
    ------
    InputError
        Numbers that no hoist can have, or a motion of too many pieces.
    """
    found = forces(values)
    layout = layout_of(hoist, found)
    plans = tuple(plans)
    program = construct(layout, plans)
    given = complete(values) | board_givens(found, layout, part_of)
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        board = run(program, {name: np.float64(value) for name, value in given.items()})  # where 1/0 is inf
    drawn = {*program.plans}
    results = _scales(given, drawn)  # marks of plans are no results
    results |= {name: q for name, q in quantities(program, board.values, {}, unit_of).items() if q.kind == "scalar"}
    return SolvedHoist(
        program=program,
        values=board.values,
        quantities=in_sections(results, SECTIONS, section_of),
        sines=board.sines,
        status=board.status,
        trouble=board.trouble,
        shown_on=_shown_on(program, drawn),
        scale_of_plan={plan: SCALES[plan] for plan in program.plans if plan in SCALES},
        givens=given,
        hoist=hoist,
        forces=found,
        layout=layout,
        plans=plans,
    )


def reduced(solved: SolvedHoist, part_of: float) -> SolvedHoist:
    """Return a hoist with diagrams of about a part of their usual size."""
    return solve_hoist(solved.hoist, {name: solved.givens[name] for name in VALUES}, solved.plans, part_of)


def _scales(given: Mapping[str, Any], drawn: set[str]) -> dict[str, Quantity]:
    """Return the scale factors of the diagrams that are drawn: they are found, and so are results."""
    of_plan = {"mu_t": FORCES, "mu_t1": LIFT_OFF, "mu_x": "", **{SCALES[plan]: plan for plan in ON_PAPER}}
    names = (name for name in SCALED if name in given and (of_plan[name] in drawn or _bends(name, drawn)))
    return {name: Quantity(name, float(given[name]) * PAPER_MM, f"{_bracketed(SCALED[name])}/mm") for name in names}


def _bends(name: str, drawn: set[str]) -> bool:
    return name in ("mu_x", "mu_w") and not drawn.isdisjoint(BENT.values())


def _bracketed(unit: str) -> str:
    return f"({unit})" if "/" in unit else unit


def _shown_on(program: Program, drawn: set[str]) -> dict[str, str]:
    shown = {name: next((plan for plan in plans if plan in drawn), "") for name, plans in SHOWN_ON.items()}
    return shown_on(program) | {name: plan for name, plan in shown.items() if plan}


def conditions_of(solved: SolvedHoist) -> dict[str, Condition]:
    """Return the condition of every quantity."""
    numbers = {name: float(solved.givens[name]) for name in VALUES}

    def solve_with(others: Mapping[str, float]) -> dict[str, float]:
        there = solve_hoist(solved.hoist, others, solved.plans).quantities
        values = ((name, there[name].value if name in there else None) for name in solved.quantities)
        return {name: math.nan if value is None else value for name, value in values}

    totals, own = by_solving_again(solve_with, numbers), solve_with(numbers)
    worst = worst_behind(solved.program, solved.sines)
    return {name: Condition(ratio(total, abs(own[name])), worst.get(name, 1.0)) for name, total in totals.items()}


def tolerances_of(solved: SolvedHoist, tolerance: Tolerance) -> dict[str, float]:
    """Return by how much times may miss, SI: what chords err by, and the error of a segment of the drawing."""
    return dict(_times(solved, tolerance))


def _times(solved: SolvedHoist, tolerance: Tolerance) -> Iterator[tuple[str, float]]:
    for name, quantity in solved.quantities.items():
        drawn = solved.quantities.get(root_plans.drawn(name))
        if drawn is None or quantity.value is None or drawn.value is None or not math.isfinite(drawn.value):
            continue
        mu = float(solved.values["mu_t1"]) * PAPER_MM
        of_segment = tolerance.of_segment(abs(drawn.value) / mu) * mu
        yield name, max(abs(drawn.value - quantity.value) + of_segment, rounded(quantity.value, tolerance))
        yield root_plans.drawn(name), max(of_segment, rounded(quantity.value, tolerance))
