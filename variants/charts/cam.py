"""The charts of cams: error against the number of sections, speed against accuracy, stability of the diagrams."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from ...plans.cams.solve import SolvedCam
from ...scales.errors import InputError
from .cam_stability import cam_stability_chart
from .data import Scene
from .gallery import Asked, Chart
from .sections import sections_chart


class CamCharts:
    """Makes the charts of one cam."""

    charts: ClassVar[tuple[str, ...]] = ("sections", "stability")
    used_by: ClassVar[Mapping[str, tuple[str, ...]]] = {"quantities": ("sections",)}

    def make(self, name: str, scene: Scene, asked: Asked) -> Chart:
        """Make one of the charts.

        Raises
        ------
        InputError
            An unknown quantity, no diagrams, or diagrams that have no errors.
        """
        solved = scene.case.solved
        assert isinstance(solved, SolvedCam)
        if not solved.program.plans:
            raise InputError("chart-no-diagrams")
        if name == "stability":
            return cam_stability_chart(scene, solved)
        return sections_chart(scene, solved, asked.quantities)
