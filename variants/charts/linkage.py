"""The charts of linkages: speed against accuracy, stability over the cycle, depth of the model."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from ...plans.board import with_needs
from ...plans.linkages.chain import NEEDS
from ...plans.linkages.cycles.cycle import Cycle, cycle
from ...scales.errors import PositionError
from ...scales.names import unknown
from ..case import Case
from ..kinds.linkage import mechanism_of
from .accuracy import accuracy_chart
from .data import Scene
from .depth import depth_chart
from .gallery import Asked, Chart
from .stability import stability_chart

POSITIONS = {"accuracy": 36, "stability": 360, "depth": 360}


class LinkageCharts:
    """Makes the charts of one linkage; a cycle of so many positions is looked at once for all of them."""

    charts: ClassVar[tuple[str, ...]] = tuple(POSITIONS)
    used_by: ClassVar[Mapping[str, tuple[str, ...]]] = {
        "quantities": ("accuracy", "stability"),
        "hand": ("accuracy", "stability"),
        "tolerance": ("depth",),
        "positions": charts,
    }

    def __init__(self) -> None:
        self._cycles: dict[int, Cycle] = {}

    def make(self, name: str, scene: Scene, asked: Asked) -> Chart:
        """Make one of the charts.

        Raises
        ------
        InputError
            An unknown quantity, or a chart that the plans of the case do not allow.
        PositionError
            No position at all can be assembled.
        """
        count = asked.positions or POSITIONS[name]
        if count not in self._cycles:
            self._cycles[count] = _cycle(scene.case, count)
        whole = self._cycles[count]
        for one in asked.quantities:
            if one not in whole.quantities:
                raise unknown("quantity-unknown", one, whole.quantities)
        if name == "accuracy":
            return accuracy_chart(scene, whole, asked.quantities)
        if name == "stability":
            return stability_chart(scene, whole, asked.quantities)
        return depth_chart(scene, whole, asked.tolerance)


def _cycle(case: Case, positions: int) -> Cycle:
    """Return the cycle with the plans of the case."""
    wanted = with_needs((*case.plans, "position"), NEEDS)
    plans = tuple(plan for plan in wanted if plan not in ("cycle", "compound"))
    found = cycle(mechanism_of(case.task), case.task.values(case.variant, case.settings), plans, positions)
    if not found.reach.stretches:
        raise case.solved.error() or PositionError("no-assembly", status_word="no-assembly", point="", gap="")
    return found
