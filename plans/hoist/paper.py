"""What the board begins with beside the numbers of a hoist: parts of sections, scale factors, ordinates of a motion."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from ...scales.scale import steps
from ..laws import TURN
from ..solved import PAPER_MM
from .beam_plans import BENT
from .beam_plans import SECTIONS as BEAM_SECTIONS
from .construction import Layout, Roots
from .course import course, marks
from .diagram_plan import HANGING, RESTING, part
from .forces import Forces, motion_givens
from .model import rest_of_root

TIMES, ORDINATES, SPAN, BEND = 180.0, 120.0, 160.0, 40.0  # mm of paper that axes should take
WIDEST = 2.0  # ratio of neighbours in the series of scale factors
TALLEST = 1.05  # of the greatest force, the axis of forces
SWINGS = 1.1  # of T_1, the axis of times beyond the lift-off
# units of the scale factors of diagrams
SCALED = {"mu_t": "s", "mu_F": "N", "mu_t1": "s", "mu_y": "m", "mu_v": "m/s", "mu_x": "m", "mu_w": "m"}


def board_givens(forces: Forces, layout: Layout, part_of: float = 1.0) -> dict[str, Any]:
    """Return the complete givens of the construction, beside the numbers of the hoist.

    Diagrams have about `part_of` their usual size.
    """
    found, motion = forces.found, forces.motion
    given: dict[str, Any] = {"_turn": TURN, "_t_P12_min": marks(found, motion)["P_12_min"]}
    parts = {(i, n) for n in (layout.resting, layout.hanging, BEAM_SECTIONS) for i in range(n + 1)}
    if layout.roots is not None:
        parts |= {(i, 1) for i in range(layout.roots.sections + 1)}
        given |= {"_begin": layout.roots.begin, "_section": layout.roots.section}
        given |= {f"_t_2_{n}_exact": time for n, time in enumerate(layout.roots.times, 1)}
    given |= {part(i, n): i / n for i, n in parts}
    given |= {name: mu / PAPER_MM for name, mu in scale_factors(found, layout, end_of(forces), part_of).items()}
    if motion is None:
        return given | {"_rest": rest_of_root(found)}
    return given | motion_givens(motion) | _ordinates(forces, layout)


def end_of(forces: Forces) -> float:
    """Return until when the forces are drawn."""
    found, motion = forces.found, forces.motion
    if motion is not None:
        return motion.pieces[-1].end
    return found["t_1"] + max(TURN / found["k_1"], SWINGS * found["T_1"])


def _ordinates(forces: Forces, layout: Layout) -> dict[str, float]:
    """Return times and forces of a motion on the section lines."""
    found, end = forces.found, end_of(forces)
    t_1 = found["t_1"]
    before = np.linspace(0.0, t_1, layout.resting + 1)
    after = np.linspace(t_1, end, layout.hanging + 1)
    columns = course(found, forces.motion, np.concatenate((before, after))).columns
    given: dict[str, float] = {}
    for i, t in enumerate(before.tolist()):
        values = t, float(columns["F_01"][i]), float(columns["F_12"][i])
        names = f"_t_{RESTING}{i}", f"_F_01_{i}", f"_F_12_{i}"
        given |= {f"{name}_motion": value for name, value in zip(names, values, strict=True)}
    for i, t in enumerate(after.tolist()):
        force = float(columns["F_12"][layout.resting + 1 + i])
        given |= {f"_T_{HANGING}{i}_motion": t - t_1, f"_P_12_{i}_motion": force}
    return given


def scale_factors(found: Mapping[str, float], layout: Layout, end: float, part_of: float = 1.0) -> dict[str, float]:
    """Return the scale factors of the diagrams, SI per millimetre, by which they fill their axes."""
    wanted = {
        "mu_t": end / TIMES,
        "mu_F": (TALLEST * found["F_max"] + found["P_st"]) / ORDINATES,
    }
    if layout.roots is not None:
        wanted |= _of_roots(found, layout.roots)
    if layout.bent:
        wanted["mu_x"] = max(found[f"l_{i}"] for i in BENT) / SPAN
        wanted["mu_w"] = max(found[f"w_{i}_max"] for i in layout.bent) / BEND
    return {name: _nearest(mu / part_of) for name, mu in wanted.items()}


def _nearest(mu: float) -> float:
    """Return the scale factor of the customary series that is nearest to one, by their ratio."""
    return min(steps(mu / WIDEST), key=lambda step: abs(math.log(step / mu)))


def _of_roots(found: Mapping[str, float], roots: Roots) -> dict[str, float]:
    V, a, k = (found[name] for name in ("V_t", "a", "k"))
    seen = roots.sections * roots.section
    end = roots.begin + seen
    wound = V * end + 0.5 * a * end * end
    known = {"mu_t1": seen / TIMES, "mu_y": wound / ORDINATES}
    if roots.waves:
        swing = math.hypot(V, a / k)
        known["mu_v"] = (swing + max(swing, found["C_01"] / found["C_12"] * (V + a * end))) / ORDINATES
    return known
