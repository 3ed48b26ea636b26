"""The whole construction of a hoist: its numbers with the circle of phase 2, and the drawings that are wanted."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from ..board import Program, RecordingBoard
from ..laws import TURN
from . import formulas as formulas  # its laws of calculation
from .beam_plans import BENT, beam, scheme
from .checks import ROPE_1
from .diagram_plan import SECTIONS, axes, diameter, extreme_points, hanging, moving, resting
from .forces import Forces
from .hoist import BEAMS_PART, CIRCLE_PART, FORCES_PART, PLANS, ROOTS_PART, SCHEME_PART, Hoist
from .model import ONE_SIDED, TWO_SIDED
from .root_plans import extremes_plan, lift_off_plan
from .roots import extremes

PER_TURN = 16  # section lines in a swing, on the drawings of the equations; and at least so many in all
FEWEST = 10
MOST_TURNS, LAST_TURNS = 12.0, 2.0  # swings that are drawn; of more than so many the last ones


@dataclass(frozen=True, slots=True)
class Roots:
    """How the equations (11) and (12) are drawn: from `begin` on, a line every `section`, s.

    `lift_off` is the line before the lift-off, `extremes` are those before the roots of (12), whose times are `times`;
    these are none where (12) is not drawn, for the support is rigid: `waves` tells.
    """

    begin: float
    section: float
    lift_off: int
    extremes: tuple[int, ...]
    times: tuple[float, ...]
    waves: bool

    @property
    def sections(self) -> int:
        """How many sections there are: one and a half more than until the lift-off."""
        return self.lift_off + 2


@dataclass(frozen=True, slots=True)
class Layout:
    """What the construction of a hoist depends on beside numbers.

    `near` says which end of a beam is the nearer one, `moved` whether the forces are those of a motion, `resting` and
    `hanging` into how many sections the phases are divided; `bent` are the beams that bend, `slack` says whether the
    circle goes on where the rope would push; `roots` tells how the equations are drawn, where they are valid.
    """

    near: tuple[str, str]
    moved: bool
    resting: int
    hanging: int
    bent: tuple[int, ...]
    slack: bool
    roots: Roots | None


def layout_of(hoist: Hoist, forces: Forces) -> Layout:
    """Return what the construction of a hoist with these forces depends on."""
    found, moved = forces.found, forces.motion is not None
    bent = tuple(i for i in BENT if math.isfinite(found[f"I_{i}"]))
    resting_sections = SECTIONS * max(1, min(math.ceil(_turns(found)), int(MOST_TURNS)))
    slack = found["P_m"] < found["R"]
    roots = roots_of(found) if forces.ok[ROPE_1] else None
    return Layout(
        (hoist.near_0, hoist.near_2), moved, resting_sections, SECTIONS * (2 if moved else 1), bent, slack, roots
    )


def _turns(found: Mapping[str, float]) -> float:
    return 0.0 if math.isinf(found["k"]) else found["k"] * found["t_1"] / TURN


def roots_of(found: Mapping[str, float]) -> Roots:
    """Return how the equations are drawn: the lift-off is in the middle of a section."""
    V, a, k, t_1 = (found[name] for name in ("V_t", "a", "k", "t_1"))
    turns, begin = _turns(found), 0.0
    if turns > MOST_TURNS:
        begin, turns = t_1 * (1.0 - LAST_TURNS / turns), LAST_TURNS
    before = max(FEWEST, math.ceil(PER_TURN * turns))
    section, waves = (t_1 - begin) / (before + 0.5), math.isfinite(k)
    ratio = found["C_01"] / found["C_12"]
    times = np.sort(np.concatenate(extremes(V, a, k, ratio, t_1, begin))) if waves else np.zeros(0)
    lines = np.floor((times - begin) / section).astype(int)
    return Roots(begin, section, before, tuple(lines.tolist()), tuple(times.tolist()), waves)


def construct(layout: Layout, plans: Iterable[str] = PLANS) -> Program:
    """Record the construction: all numbers, and the drawings of the plans wanted."""
    timeless = layout.roots and replace(layout.roots, begin=0.0, section=0.0, times=())
    return _constructed(replace(layout, roots=timeless), frozenset(plans))


@lru_cache(maxsize=16)
def _constructed(layout: Layout, wanted: frozenset[str]) -> Program:
    """Record it once: hoists that differ in numbers alone have the same steps."""
    board = RecordingBoard()
    for part in ONE_SIDED if layout.moved else TWO_SIDED:
        part(board)
    axes(board)
    if SCHEME_PART in wanted:
        scheme(board, dict(zip(BENT, layout.near, strict=True)))
    if CIRCLE_PART in wanted:
        diameter(board, layout.slack)
    if FORCES_PART in wanted and layout.moved:
        moving(board, layout.resting, layout.hanging)
    elif FORCES_PART in wanted:
        resting(board, layout.resting)
        hanging(board, layout.hanging)
    if FORCES_PART in wanted:
        extreme_points(board, "_t_P12_min")
    if ROOTS_PART in wanted and layout.roots is not None:
        _roots(board, layout.roots)
    if BEAMS_PART in wanted:
        for i in layout.bent:
            beam(board, i)
    return Program(board.steps)


def _roots(board: RecordingBoard, roots: Roots) -> None:
    board.calc("_height", "ratio", "P_st", "C")
    board.calc("_ratio", "ratio", "C_01", "C_12")
    lift_off_plan(board, roots.sections, roots.lift_off)
    if roots.waves:
        extremes_plan(board, roots.sections, roots.extremes)
