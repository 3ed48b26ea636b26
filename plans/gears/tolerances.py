"""What a teacher should let pass of angles that are read between two flanks, and of what is calculated from them."""

from __future__ import annotations

from ..hands.adding import added_up
from ..hands.hand import Tolerance
from ..hands.shaky import Paper
from ..marking.key import rounded
from .gear import WHEELS
from .solve import SolvedGear

ANGULAR = tuple(f"{name}{i}{end}" for name, end in (("phi_alpha", "_drawn"), ("epsilon_alpha_arc", "")) for i in WHEELS)


def tolerances_of(solved: SolvedGear, paper: Paper, tolerance: Tolerance) -> dict[str, float]:
    """Return by how much quantities that hang on angles of the drawing may differ, SI.

    A flank at the start of engagement stands as its mark on the line of action does, and as it is turned: such an angle
    may miss what all these errors add up to. The usual rule is that of lengths.
    """
    names = [name for name in ANGULAR if name in solved.quantities]
    found = added_up(paper, tolerance, names)
    return {name: max(found[name], rounded(solved.values[name], tolerance)) for name in names}
