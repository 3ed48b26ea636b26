"""What is drawn of a cam when only the first stages of each view have been done: a blank has axes, centres."""

from __future__ import annotations

from ...plans.cams.solve import SolvedCam
from ..handouts.begun import Shown
from .stages import stages

NOTHING = frozenset[str]()
NUMBERED, DIVIDED = 1, 2  # columns of the table of the motion: numbers of section lines, and their angles, from step 1


def begun(solved: SolvedCam, steps: int) -> dict[str, Shown]:
    """Return for every view what its first stages draw; what stands under a heading is known when all are done."""
    found = {
        view: Shown(NOTHING, NOTHING, notes=steps >= len(parts) - 1, parts=frozenset(parts[: steps + 1]))
        for view, parts in stages(solved).items()
    }
    return found | {"motion": Shown(NOTHING, NOTHING, notes=False, columns=DIVIDED if steps else NUMBERED)}
