"""The charts of hoists: speed against accuracy, steps, ways to the lift-off, depth of the model, choice of places."""

from __future__ import annotations

import math
import time
from collections.abc import Mapping
from dataclasses import replace
from typing import ClassVar

from ...plans.contest import FULL, Effort
from ...plans.hands.hand import preset
from ...plans.hoist.choice import choose
from ...plans.hoist.depth import depth
from ...plans.hoist.drawn import by_board, by_hand
from ...plans.hoist.hoist import complete
from ...plans.hoist.rivals import rivals
from ...plans.hoist.root_race import root_race
from ...plans.hoist.solve import SolvedHoist
from ...plans.hoist.step_limits import step_limits
from ...scales.errors import InputError
from .accuracy import AccuracyChart
from .data import Scene
from .gallery import Chart, ChartRequest
from .hoist_choice import HoistChoiceChart
from .hoist_depth import HoistDepthChart
from .hoist_roots import HoistRootsChart
from .hoist_steps import HoistStepsChart

ACCURACY, STABILITY, ROOTS, DEPTH, CHOICE = "accuracy", "stability", "roots", "depth", "choice"


class HoistCharts:
    """Makes the charts of one hoist."""

    charts: ClassVar[tuple[str, ...]] = (ACCURACY, STABILITY, ROOTS, DEPTH, CHOICE)
    used_by: ClassVar[Mapping[str, tuple[str, ...]]] = {"tolerance": (DEPTH,), "hand": (ACCURACY,)}

    def make(self, name: str, scene: Scene, asked: ChartRequest) -> Chart:
        """Make one of the charts.

        Raises
        ------
        InputError
            A support that is rigid has no phase 1 to integrate; formulas that are not valid have no rivals.
        """
        return hoist_chart(name, scene, asked.tolerance)


def hoist_chart(name: str, scene: Scene, tolerance: float, effort: Effort = FULL) -> Chart:
    """Make a chart of a hoist; the tolerance of a simpler model is in per cent."""
    solved = SolvedHoist.of(scene.case.solved)
    givens = complete(solved.givens)
    if name == DEPTH:
        return HoistDepthChart(scene, depth(givens, 0.01 * tolerance))
    if name == CHOICE:
        return HoistChoiceChart(scene, choose(givens), givens["S"])
    if math.isinf(givens["I_0"]):
        raise InputError("chart-hoist-rigid")
    if solved.forces.motion is not None:
        raise InputError("chart-hoist-one-sided")
    if name == ROOTS:
        return HoistRootsChart(scene, root_race(givens))
    if name == STABILITY:
        return HoistStepsChart(scene, step_limits(givens))
    return _accuracy(scene, solved, givens, effort)


def _accuracy(scene: Scene, solved: SolvedHoist, givens: Mapping[str, float], effort: Effort) -> AccuracyChart:
    """Let all methods compete, a board and a hand that draw among them."""
    found = rivals(givens, time.process_time, effort)
    case = scene.case
    mus = {plan: scale.mu for plan, scale in case.kind.first_scales(solved, case.choosers, case.plans)[1].items()}
    drawn = (*by_board(solved, time.process_time), *by_hand(solved, mus, preset(scene.hand).hand))
    whole = replace(found, entries=(*found.entries, *drawn))
    return AccuracyChart(scene, "s", whole, "chart.hoist_compared")
