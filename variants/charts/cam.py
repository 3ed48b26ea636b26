"""The charts of cams: error against the number of sections, speed against accuracy, stability of the diagrams."""

from __future__ import annotations

import time
from collections.abc import Mapping
from typing import ClassVar

from ...plans.cams.rivals import rivals
from ...plans.cams.solve import SolvedCam
from ...plans.contest import FULL, Effort
from ...plans.hands.hand import preset
from .accuracy import AccuracyChart
from .cam_stability import cam_stability_chart
from .data import Scene
from .gallery import Chart, ChartRequest
from .sections import sections_chart


class CamCharts:
    """Makes the charts of one cam."""

    charts: ClassVar[tuple[str, ...]] = ("sections", "accuracy", "stability")
    used_by: ClassVar[Mapping[str, tuple[str, ...]]] = {"quantities": ("sections",), "hand": ("accuracy",)}

    def make(self, name: str, scene: Scene, asked: ChartRequest) -> Chart:
        """Make one of the charts.

        Raises
        ------
        InputError
            An unknown quantity, or diagrams that have no errors.
        """
        solved = SolvedCam.of(scene.case.solved)
        if name == "accuracy":
            return cam_accuracy_chart(scene, solved)
        if name == "stability":
            return cam_stability_chart(scene, solved)
        return sections_chart(scene, solved, asked.quantities)


def cam_accuracy_chart(scene: Scene, solved: SolvedCam, effort: Effort = FULL) -> AccuracyChart:
    """Let all ways to the motion of a cam compete."""
    found = rivals(solved, time.process_time, preset(scene.hand).hand, effort)
    return AccuracyChart(scene, "rad", found, "chart.cam_compared")
