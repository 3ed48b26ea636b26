"""Scale factors of the plans of hoists: ladders of the scheme and of the circle; those of the diagrams are known."""

from __future__ import annotations

from collections.abc import Sequence

from ...plans.hoist.beam_plans import BENT, SCHEME
from ...plans.hoist.hoist import BEAMS_PART, CIRCLE_PART, FORCES_PART, ROOTS_PART, SCHEME_PART
from ...plans.hoist.model import CIRCLE
from ...plans.hoist.paper import SCALED
from ...plans.hoist.solve import SCALES, SolvedHoist
from ...plans.solved import PAPER_MM
from ...scales.choose import Choosers, From
from ...scales.scale import Scale, steps
from ..extents import smallest, visible
from ..formats import Format

LEAST = 1e-3  # part of the mean force that the circle is taken for at least
SPAN, ROPE, DIAMETER = 160.0, 350.0, 110.0  # mm of paper that the longer beam, the rope and the circle may take
# mm^2 of A1: of figures with their texts, and of tables that every sheet has
AREAS = {SCHEME_PART: 2e4, FORCES_PART: 1.25e5, ROOTS_PART: 9e4, CIRCLE_PART: 3e4, BEAMS_PART: 3e4}
TABLES = 4e4


def scheme_ladder(solved: SolvedHoist, choosers: Choosers) -> tuple[float, ...]:
    """Return the scale factors of the scheme, the one wanted first: beams of 160 mm at most, a rope of 350."""
    return _ladder(
        solved, choosers, SCHEME, max(max(solved.size(f"l_{i}") for i in BENT) / SPAN, solved.size("L") / ROPE)
    )


def circle_ladder(solved: SolvedHoist, choosers: Choosers) -> tuple[float, ...]:
    """Return the scale factors of the circle, the one wanted first: where nothing is said, one of 110 mm at most."""
    return _ladder(solved, choosers, CIRCLE, max(2.0 * solved.size("R"), LEAST * solved.size("P_m")) / DIAMETER)


def _ladder(solved: SolvedHoist, choosers: Choosers, plan: str, finest: float) -> tuple[float, ...]:
    symbol, part = SCALES[plan], SPAN if plan == SCHEME else DIAMETER
    chooser = choosers.get(symbol, From(steps(finest)[0]))
    values = chooser.ladder(solved.size)
    if plan in solved.scale_of_plan:
        visible(chooser, symbol, values[0], finest * part, "m" if plan == SCHEME else "N")
    return values


def first_scales(solved: SolvedHoist, choosers: Choosers, plans: Sequence[str]) -> tuple[Format, dict[str, Scale]]:
    """Return the format and the scale factors by plan: those of the diagrams are known."""
    found = {}
    for plan, symbol in solved.scale_of_plan.items():
        if symbol in SCALED:
            found[plan] = Scale(symbol, float(solved.values[symbol]) * PAPER_MM, SCALED[symbol])
        else:
            ladder = scheme_ladder if plan == SCHEME else circle_ladder
            found[plan] = Scale(symbol, ladder(solved, choosers)[0], "m" if plan == SCHEME else "N")
    return smallest((TABLES, *(AREAS[plan] for plan in plans))), found
