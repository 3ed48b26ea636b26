"""The charts of hoists: speed against accuracy, steps, ways to the lift-off, depth of the model, choice of places."""

from __future__ import annotations

import math
import time
from collections.abc import Mapping
from typing import ClassVar

from ...plans.contest import FULL, Effort
from ...plans.hoist.checks import valid
from ...plans.hoist.choice import choose
from ...plans.hoist.depth import depth
from ...plans.hoist.givens import complete
from ...plans.hoist.model import model
from ...plans.hoist.rivals import rivals
from ...plans.hoist.root_race import root_race
from ...plans.hoist.step_limits import step_limits
from ...scales.errors import InputError
from .accuracy import AccuracyChart
from .data import Scene
from .gallery import Asked, Chart
from .hoist_choice import HoistChoiceChart
from .hoist_depth import HoistDepthChart
from .hoist_roots import HoistRootsChart
from .hoist_steps import HoistStepsChart

ACCURACY, STABILITY, ROOTS, DEPTH, CHOICE = "accuracy", "stability", "roots", "depth", "choice"


class HoistCharts:
    """Makes the charts of one hoist."""

    charts: ClassVar[tuple[str, ...]] = (ACCURACY, STABILITY, ROOTS, DEPTH, CHOICE)
    used_by: ClassVar[Mapping[str, tuple[str, ...]]] = {"tolerance": (DEPTH,)}

    def make(self, name: str, scene: Scene, asked: Asked) -> Chart:
        """Make one of the charts.

        Raises
        ------
        InputError
            A support that is rigid has no phase 1 to integrate; formulas that are not valid have no rivals.
        """
        return hoist_chart(name, scene, scene.case.solved.givens, asked.tolerance)


def hoist_chart(name: str, scene: Scene, values: Mapping[str, float], tolerance: float, effort: Effort = FULL) -> Chart:
    """Make a chart of the hoist with these givens, SI; the tolerance of a simpler model is in per cent."""
    givens = complete(values)
    if name == DEPTH:
        return HoistDepthChart(scene, depth(givens, 0.01 * tolerance))
    if name == CHOICE:
        return HoistChoiceChart(scene, choose(givens), givens["S"])
    if math.isinf(givens["I_0"]):
        raise InputError("chart-hoist-rigid")
    if name == ROOTS:
        return HoistRootsChart(scene, root_race(givens))
    if not valid(model(givens)):
        raise InputError("chart-hoist-one-sided")
    if name == STABILITY:
        return HoistStepsChart(scene, step_limits(givens))
    return AccuracyChart(scene, None, rivals(givens, time.process_time, effort), "chart.hoist_compared")
