"""The sheet of a hoist: which figures it has, and how large its diagrams are drawn."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from ...plans.hoist.construction import SCHEME
from ...plans.hoist.hoist import BEAMS_PART, CIRCLE_PART, FORCES_PART, ROOTS_PART, SCHEME_PART
from ...plans.hoist.model import CIRCLE
from ...plans.hoist.solve import SCALES, SolvedHoist, reduced
from ...scales.scale import Scale
from ..compose import last
from ..extents import Rungs
from ..figure import Figure, Fitting, Found, SheetContents
from ..formats import STYLES, Format
from .scene import UNITS, HoistScene, first_scales, ladder, lettered

PARTS = 1.0, 0.8, 0.63, 0.5, 0.4  # of the usual size of diagrams
HoistFigure = Figure[HoistScene]


class HoistFitting(Fitting[SolvedHoist, HoistScene]):
    """Draws what the sheet of a hoist shows."""

    first_scales = staticmethod(first_scales)

    def __init__(self, contents: SheetContents[SolvedHoist]) -> None:
        roots = contents.solved.layout.roots
        chosen = {symbol: ladder(contents.solved, contents.choosers, symbol) for symbol in UNITS}
        words = lettered(contents.words, len(roots.times) if roots else 0)
        self._solved = {1.0: contents.solved}
        super().__init__(contents, words, {**chosen, "part": PARTS})

    def scene(self, sheet: Format, rungs: Rungs) -> HoistScene:
        """Return the scene of a sheet on a format: of the hoist with diagrams as large as they are drawn."""
        part = self.part(rungs)
        if part not in self._solved:
            self._solved[part] = reduced(self.contents.solved, part)
        mus = {name: values[rungs[name]] for name, values in self.ladders.items()}
        return HoistScene(self._solved[part], self.words, STYLES[sheet.letters], self.contents.givens, mus)

    def scales(self, sheet: Format, rungs: Rungs) -> dict[str, Scale]:
        """Return the scale factors of the plans as they are drawn."""
        scene = self.scene(sheet, rungs)
        return {plan: scene.scale(SCALES[plan]) for plan in self.contents.solved.scale_of_plan}

    def part(self, rungs: Rungs) -> float:
        """Return how large diagrams are drawn, in their usual size."""
        return PARTS[rungs["part"]]

    def on_pages(self, sheet: Format) -> Found:
        """Take several pages in reading order, with scheme and circle a step smaller where that spares one."""
        smaller = self.lower(self.lower(self.wanted, SCALES[SCHEME]), SCALES[CIRCLE])
        return min((self.in_order(sheet, rungs) for rungs in (self.wanted, smaller)), key=lambda way: last(way[2]))

    def figures(self, scene: HoistScene, width: float) -> Iterator[HoistFigure]:
        """Go through the figures of a sheet in the order of the work."""
        from . import diagrams_view, scheme_view, text

        contents = self.contents
        layout, plans = contents.solved.layout, contents.plans
        yield Figure("givens", partial(text.data_table, stated=self.stated))
        if SCHEME_PART in plans:
            yield from (scheme_view.SCHEME_FIGURE, scheme_view.MODEL)
        yield Figure("results", text.results_table)
        if FORCES_PART in plans:
            yield diagrams_view.FORCES_FIGURE
        if ROOTS_PART in plans and layout.roots is not None:
            yield diagrams_view.LIFT_OFF_FIGURE
            if layout.roots.waves:
                yield diagrams_view.EXTREMES_FIGURE
        if CIRCLE_PART in plans:
            yield diagrams_view.CIRCLE_FIGURE
        if BEAMS_PART in plans and layout.bent:
            yield scheme_view.BEAMS_FIGURE
        if FORCES_PART in plans:
            yield Figure("strength", text.strength_block)
            yield Figure("checks", text.checks_table)
            yield Figure("flow", scheme_view.flow_view)
        yield Figure("scales", text.scales_table, ("mu_l", "mu_F_circle", "part"))
