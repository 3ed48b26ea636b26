"""How much of an error of the data comes through in a gear pair's quantities, and what a teacher should let pass.

K is that of `plans.condition`, over Q; lengths that are drawn count beside the module at least. Numbers of teeth do not
err.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ..condition import Condition, derivatives, ratio
from ..hands.hand import Tolerance
from ..hands.sensitivities import added_up
from ..hands.shaky import Paper
from ..marking.key import rounded
from ..references import worst_behind
from ..solved import PAPER_MM
from .gear import VALUES, WHEELS
from .solve import SolvedGear

WHOLE = ("z_1", "z_2")
MODULE, ONE = "m", 1.0


def conditions_of(solved: SolvedGear) -> dict[str, Condition]:
    """Return the condition of every quantity; what is given has that of a number alone."""
    varied = [name for name in VALUES if solved.givens.get(name) and name not in WHOLE]
    slopes = derivatives(solved.program, solved.givens, varied)
    slopes |= {name: solved.givens[name] * np.eye(len(varied))[i] for i, name in enumerate(varied)}
    worst = worst_behind(solved.program, solved.sines)
    found = {}
    for name in solved.quantities:
        slope = slopes.get(name, 0.0 if name in solved.givens else np.nan)
        total = float(np.abs(slope).sum())
        found[name] = Condition(ratio(total, _size(solved, name)), worst.get(name, ONE))
    return found


def _size(solved: SolvedGear, name: str) -> float:
    """Return the size beside which an error of a quantity counts, SI."""
    own = float(abs(solved.values[name]))
    drawn = name in solved.shown_on and solved.quantities[name].unit == MODULE
    return max(own, float(solved.givens["m"])) if drawn else own


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
