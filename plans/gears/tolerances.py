"""What a teacher should let pass of what is read between two flanks or off the diagrams of sliding."""

from __future__ import annotations

from collections.abc import Iterator

from ..hands.adding import added_up
from ..hands.hand import Tolerance
from ..hands.shaky import Paper
from ..marking.key import rounded
from ..solved import PAPER_MM
from .gear import WHEELS
from .solve import SolvedGear

ANGULAR = tuple(f"{name}{i}{end}" for name, end in (("phi_alpha", "_drawn"), ("epsilon_alpha_arc", "")) for i in WHEELS)
# curvatures of both flanks at the ends of the active line
ENDS = {"A1": ("rho_p1", "rho_a2"), "A2": ("rho_a1", "rho_p2")}


def tolerances_of(solved: SolvedGear, paper: Paper, tolerance: Tolerance) -> dict[str, float]:
    """Return by how much quantities that hang on angles or diagrams of the drawing may differ, SI.

    A flank at the start of engagement stands as its mark on the line of action does, and as it is turned: such an angle
    may miss what all these errors add up to. Sliding at the ends of the active line can be calculated, but is taken
    from the diagram: it may miss what comes of both ordinates.
    """
    names = [name for name in ANGULAR if name in solved.quantities]
    found = added_up(paper, tolerance, names)
    found = {name: max(found[name], rounded(solved.values[name], tolerance)) for name in names}
    return found | dict(_extremes(solved, tolerance))


def _extremes(solved: SolvedGear, tolerance: Tolerance) -> Iterator[tuple[str, float]]:
    """Go through the extremes of sliding: theta = 1 - y / y_own errs by what either segment may miss."""
    sizes = solved.sizes
    for end, rhos in ENDS.items():
        y = [sizes["PW"] / PAPER_MM * sizes[rho] / sizes[f"rho_w{i}"] for i, rho in zip(WHEELS, rhos, strict=True)]
        for i in WHEELS:
            name, own, mate = f"theta_{i}{3 - i}_{end}", y[i - 1], y[2 - i]
            if own > 0.0:
                missed = (tolerance.of_segment(mate) + mate / own * tolerance.of_segment(own)) / own
                yield name, max(float(missed), rounded(sizes[name], tolerance))
