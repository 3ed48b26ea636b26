"""What a teacher should let pass where errors add up: along a chain of marks, each drawn from the one before it."""

from __future__ import annotations

from collections.abc import Iterable

from .hand import Tolerance, hand_within
from .sensitivities import sensitivities
from .shaky import Paper

MOST = 2.0  # standard deviations that nearly all honest hands keep


def added_up(paper: Paper, tolerance: Tolerance, names: Iterable[str]) -> dict[str, float]:
    """Return by how much quantities may differ, SI: twice what all errors of the hand come to, as variances do.

    The rule of `tolerances` looks at a segment and at the lines that meet at its ends. The last mark of a curve that is
    drawn chord by chord also misses by what all marks before it have missed.
    """
    wanted = tuple(names)
    found = sensitivities(paper, hand_within(tolerance), wanted)
    return {name: MOST * found.deviation(name) for name in wanted}
