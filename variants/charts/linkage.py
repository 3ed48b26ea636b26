"""The charts of linkages: speed against accuracy, stability over the cycle, depth of the model."""

from __future__ import annotations

import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import ClassVar

from ...drawing.formats import format_named
from ...drawing.linkages.layout.ladders import first_scales
from ...plans.board import with_needs
from ...plans.contest import FULL, Contest, Effort, Entry
from ...plans.hands.hand import preset
from ...plans.linkages.accuracy.comparison import contest
from ...plans.linkages.accuracy.hand_drawn import DrawnSheet, by_hand
from ...plans.linkages.chain import NEEDS
from ...plans.linkages.cycles.cycle import Cycle, cycle
from ...plans.linkages.solved import SolvedLinkage
from ...scales.choices import SIZES
from ...scales.errors import InputError, PositionError
from ...scales.names import unknown
from ..case import Case
from .accuracy import AccuracyChart
from .data import Scene, driver_unit
from .depth import depth_chart
from .gallery import Chart, ChartRequest
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

    def make(self, name: str, scene: Scene, asked: ChartRequest) -> Chart:
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
    found = cycle(case.task.mechanism, case.task.values(case.variant, case.settings), plans, positions)
    if not found.reach.stretches:
        raise case.solved.error() or PositionError("no-assembly", status_word="no-assembly", point="", gap="")
    return found


def accuracy_chart(scene: Scene, cycle: Cycle, names: Sequence[str], effort: Effort = FULL) -> AccuracyChart:
    """Let all methods compete.

    Raises
    ------
    InputError
        With the key `chart-no-rivals`: nothing that is wanted can be compared.
    """
    found = contest(cycle, len(cycle.angles), time.process_time, names, effort)
    if not found.kinds:
        raise InputError("chart-no-rivals")
    hands = tuple(_hands(scene, cycle, found))
    return AccuracyChart(scene, driver_unit(cycle), replace(found, entries=found.entries + hands))


def _hands(scene: Scene, cycle: Cycle, found: Contest) -> Iterator[Entry]:
    """Go through the errors of a hand on the sheets of all formats."""
    for name in SIZES:
        mus = _mus(scene, name)
        if mus is not None:
            drawn = DrawnSheet(name, SolvedLinkage.of(scene.case.solved), mus)
            yield from by_hand(cycle, drawn, preset(scene.hand).hand, found.kinds)


def _mus(scene: Scene, name: str) -> Mapping[str, float] | None:
    """Return the scale factors, by plan, that a format takes by the extents; None where a plan has no room on it."""
    case = scene.case
    if case.solved.trouble is not None:
        return None
    try:
        _, scales = first_scales(SolvedLinkage.of(case.solved), case.choosers, case.plans, format_named(name))
    except InputError:  # too small for a plan, or for a scale factor that was asked for
        return None
    return {plan: scale.mu for plan, scale in scales.items()}
