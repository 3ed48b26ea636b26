"""Scale factors of the plans of hoists: ladders of the scheme and of the circle; those of the diagrams are known."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ...plans.hoist.construction import BENT, SCHEME
from ...plans.hoist.hoist import BEAMS_PART, CIRCLE_PART, FORCES_PART, ROOTS_PART, SCHEME_PART
from ...plans.hoist.model import CIRCLE
from ...plans.hoist.solve import SCALED, SCALES, SolvedHoist
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
UNITS = {SCALES[SCHEME]: "m", SCALES[CIRCLE]: "N"}  # of the scale factors that may be chosen


def ladder(solved: SolvedHoist, choosers: Choosers, symbol: str) -> tuple[float, ...]:
    """Return the values of a scale factor that may be chosen, one of `UNITS`, the one wanted first.

    Where nothing is said, beams take 160 mm at most and a rope 350, a circle 110.
    """
    if symbol == SCALES[SCHEME]:
        span, rope = max(solved.size(f"l_{i}") for i in BENT), solved.size("L")
        finest, largest = max(span / SPAN, rope / ROPE), max(span, rope)
    else:
        largest = 2.0 * solved.size("R")
        finest = max(largest, LEAST * solved.size("P_m")) / DIAMETER
    chooser = choosers.get(symbol, From(steps(finest)[0]))
    values = chooser.ladder(solved.size)
    if symbol in solved.scale_of_plan.values():
        visible(chooser, symbol, values[0], largest, UNITS[symbol])
    return values


def scale_of(solved: SolvedHoist, symbol: str, mus: Mapping[str, float]) -> Scale:
    """Return a scale factor as it is drawn: of a diagram the one that is known, else the one of `mus`, SI per mm."""
    if symbol in SCALED:
        return Scale(symbol, float(solved.values[symbol]) * PAPER_MM, SCALED[symbol])
    return Scale(symbol, mus[symbol], UNITS[symbol])


def first_scales(solved: SolvedHoist, choosers: Choosers, plans: Sequence[str]) -> tuple[Format, dict[str, Scale]]:
    """Return the format and the scale factors by plan: those of the diagrams are known."""
    symbols = solved.scale_of_plan
    mus = {symbol: ladder(solved, choosers, symbol)[0] for symbol in symbols.values() if symbol in UNITS}
    found = {plan: scale_of(solved, symbol, mus) for plan, symbol in symbols.items()}
    return smallest((TABLES, *(AREAS[plan] for plan in plans))), found
