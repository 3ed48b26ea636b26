"""The curves of a hoist's diagrams, densely: their constructions done for many places at once, in metres of paper."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..board import Board
from ..laws import TURN
from ..solved import PAPER_MM
from .beam_plans import BENT, bent_beam
from .course import article_force, course, end_of
from .diagram_plan import FORCES, line, point
from .root_plans import EXTREMES, LIFT_OFF, extremes_point, lift_off_points, seen
from .solve import SolvedHoist

POINTS, OF_BEAM, MAGNIFIED = 300, 121, 81  # of a curve
INSIDE = 1.0 - 1e-12  # of an interval at whose end the phase is another one
Places = NDArray[np.complex128]


def bent(solved: SolvedHoist, i: int, letter: str, force: str) -> Places:
    """Return a beam bent by a force, the load's place among the points."""
    found = solved.forces.found
    x = np.unique(np.append(np.linspace(0.0, found[f"l_{i}"], OF_BEAM), found[f"b_{i}"]))
    return solved.dense(lambda board: bent_beam(board, i, letter, force), f"{BENT[i]}.{letter}", _x=x)


def equation(solved: SolvedHoist, curve: str, about: float | None = None, half: float = 0.0) -> Places:
    """Return a curve of an equation: `Y` and `O` of (11), `W` of (12); all of it, or `half` about an abscissa, mm."""
    roots = solved.layout.roots
    assert roots is not None
    times = np.linspace(0.0, roots.sections * roots.section, POINTS)
    if about is not None:
        times = np.linspace(about - half, about + half, MAGNIFIED) * (solved.values["mu_t1"] * PAPER_MM)

    def draw(board: Board) -> None:
        lift_off_points(board, "x")
        extremes_point(board, "x")

    plan = EXTREMES if curve == "W" else LIFT_OFF
    return solved.dense(draw, f"{plan}.{curve}x", **{seen("x"): times})


def forces_over(solved: SolvedHoist) -> dict[str, Places]:
    """Return the forces until the lift-off and the rope's after it, with the article's over one swing."""
    forces, found = solved.forces, solved.forces.found
    t_1, end = found["t_1"], end_of(found, forces.motion)
    before, after = np.linspace(0.0, t_1 * INSIDE, POINTS), np.linspace(t_1, end * INSIDE, POINTS)
    first, second = (course(found, forces.motion, t).columns for t in (before, after))
    swing = after[after <= t_1 + TURN / found["k_1"]]
    curves = {"F_01": (before, first["F_01"]), "F_12": (before, first["F_12"]), "P_12": (after, second["F_12"])}
    curves["printed"] = swing, np.asarray(article_force(found, swing - t_1))

    def draw(board: Board) -> None:
        point(board, FORCES, "x", line(board, FORCES, "fx", "_t"), "_F", "mu_F")

    return {name: solved.dense(draw, f"{FORCES}.x", _t=t, _F=F) for name, (t, F) in curves.items()}
