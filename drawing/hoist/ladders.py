"""Scale factors of the plans of hoists: ladders of the scheme and of the circle; those of the diagrams are known."""

from __future__ import annotations

from ...plans.hoist.beam_plans import BENT, SCHEME
from ...plans.hoist.model import CIRCLE
from ...plans.hoist.paper import SCALED
from ...plans.hoist.solve import SCALES, SolvedHoist
from ...plans.solved import PAPER_MM
from ...scales.choose import Choosers, From
from ...scales.scale import Scale, steps

LEAST = 1e-3  # part of the mean force that the circle is taken for at least
SPAN, DIAMETER = 160.0, 110.0  # mm of paper that the longer beam and the circle may take


def scheme_ladder(solved: SolvedHoist, choosers: Choosers) -> tuple[float, ...]:
    """Return the scale factors of the scheme, the one wanted first: where nothing is said, beams of 160 mm at most."""
    return _ladder(solved, choosers, SCHEME, max(solved.size(f"l_{i}") for i in BENT) / SPAN)


def circle_ladder(solved: SolvedHoist, choosers: Choosers) -> tuple[float, ...]:
    """Return the scale factors of the circle, the one wanted first: where nothing is said, one of 110 mm at most."""
    return _ladder(solved, choosers, CIRCLE, max(2.0 * solved.size("R"), LEAST * solved.size("P_m")) / DIAMETER)


def _ladder(solved: SolvedHoist, choosers: Choosers, plan: str, finest: float) -> tuple[float, ...]:
    return choosers.get(SCALES[plan], From(steps(finest)[0])).ladder(solved.size)


def scales_of(solved: SolvedHoist, choosers: Choosers) -> dict[str, Scale]:
    """Return the scale factors by plan as they are wanted."""
    found = {}
    for plan, symbol in solved.scale_of_plan.items():
        if symbol in SCALED:
            found[plan] = Scale(symbol, float(solved.values[symbol]) * PAPER_MM, SCALED[symbol])
        else:
            ladder = scheme_ladder if plan == SCHEME else circle_ladder
            found[plan] = Scale(symbol, ladder(solved, choosers)[0], "m" if plan == SCHEME else "N")
    return found
