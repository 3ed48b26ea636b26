"""What a teacher should let pass of a cam's sizes: as far as chords go astray, and no less than of a single segment."""

from __future__ import annotations

import math

from ..hands.adding import added_up
from ..hands.hand import Tolerance
from ..hands.shaky import Paper
from ..marking.key import rounded
from ..names import role
from ..references import results
from .solve import SolvedCam

MEASURED = ("distance", "read")


def tolerances_of(drawn: SolvedCam, paper: Paper, tolerance: Tolerance) -> dict[str, float]:
    """Return by how much the quantities of a cam that is drawn may differ, SI.

    Each may miss what all errors of the hand add up to; a length that the sheet shows as a segment, also what is let
    pass of such a segment; an angle, what is let pass of a direction where a protractor may have found it. What is
    only calculated from exact numbers, such as the inclination of the line of transfer, is rounded.
    """
    names = [step.name for step in results(paper.program)]
    found = added_up(paper, tolerance, names)
    return {name: max(found[name], _alone(name, drawn, paper, tolerance)) for name in names}


def _alone(name: str, drawn: SolvedCam, paper: Paper, tolerance: Tolerance) -> float:
    """Return what a quantity may miss by itself."""
    value = float(abs(drawn.values[name]))
    least = rounded(value, tolerance)
    if drawn.quantities[name].unit == "rad":
        return max(least, math.radians(tolerance.degrees))
    step = paper.program.by_name[name]
    plan = role(step.operands[0]).plan if step.verb in MEASURED else drawn.shown_on.get(name, "")
    if not plan:
        return least
    calculated_there = plan in paper.unscaled and step.verb not in MEASURED
    mu = drawn.values[drawn.scale_of_plan[plan]] if calculated_there else paper.mus[plan]
    return max(least, float(tolerance.of_segment(value / mu) * mu))
