"""The sheet of a gear pair: its figures, and the pages on which they stand."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import partial
from itertools import product
from typing import Any

from ...plans.gears.gear import GEOMETRY_PART, MESHING_PART, SLIDING_PART
from ...plans.gears.solve import SolvedGear
from ...scales.errors import InputError
from ...scales.scale import Fixed, Scale
from ..compose import arrange, last
from ..extents import Rungs
from ..figure import Figure, Fitting, Found, SheetContents
from ..formats import FORMATS, STYLES, Format, room
from .scene import GearScene, first_scales, lettered, mu_ladder, near_ladder, parts_of, rolled_ladder

BESIDE = ("rolled", "part")  # ladders of what stands beside the meshing
# rungs further at which a page is tried
SMALLER = [dict(zip(BESIDE, steps, strict=True)) for steps in sorted(product(range(3), repeat=len(BESIDE)), key=sum)]
GearFigure = Figure[GearScene]


class GearFitting(Fitting[SolvedGear, GearScene]):
    """Draws what the sheet of a gear pair shows."""

    first_scales = staticmethod(first_scales)

    def __init__(self, contents: SheetContents[SolvedGear]) -> None:
        solved = contents.solved
        ladders = {
            "mu_l": mu_ladder(solved, contents.choosers),
            "near": near_ladder(solved),
            "rolled": rolled_ladder(solved),
            "part": parts_of(contents.plans),
        }
        super().__init__(contents, lettered(contents.words), ladders)

    def scene(self, sheet: Format, rungs: Rungs) -> GearScene:
        """Return the scene of a sheet on a format."""
        mus: dict[str, Any] = {name: self.ladders[name][rung] for name, rung in rungs.items()}
        return GearScene(self.contents.solved, self.words, STYLES[sheet.letters], self.contents.givens, **mus)

    def figures(self, scene: GearScene, width: float) -> Iterator[GearFigure]:
        """Go through the figures of a sheet in the order of the work; lines of text are at most `width` mm long."""
        from . import action_view, cutting_view, meshing_view, text

        plans = self.contents.plans
        if MESHING_PART in plans:
            yield meshing_view.FIGURE
            if scene.apart:
                yield meshing_view.NEAR
            yield cutting_view.FIGURE
        if GEOMETRY_PART in plans:
            yield Figure("data", text.data_table)
        if MESHING_PART in plans:
            yield action_view.ACTION_FIGURE
        if GEOMETRY_PART in plans:
            yield Figure("checks", text.checks_table)
        if SLIDING_PART in plans:
            yield from (Figure("points", text.points_table), action_view.SLIDING_FIGURE)
        if GEOMETRY_PART in plans:
            yield Figure("contour", cutting_view.contour_view)
            yield Figure("rack", cutting_view.rack_view, ("near",))
            for name in text.CALCULATED:
                yield Figure(f"equations_{name}", partial(text.calculations_block, name=name, width=width))

    def scales(self, sheet: Format, rungs: Rungs) -> dict[str, Scale]:
        """Return the scale factors of the plans as they are drawn."""
        scene = self.scene(sheet, rungs)
        return {plan: scene.scale(plan) for plan in self.contents.solved.scale_of_plan}

    def on_a_page(self, sheet: Format, last: bool) -> Found | None:
        """Place everything on one page as large as wanted; on the `last` format it is tried with several pages."""
        return None if last else self.placed(sheet, self.wanted)

    def on_pages(self, sheet: Format) -> Found:
        """Take as few pages as there can be, with what is beside the meshing smaller where that helps."""
        # the pages of a handout, with another frame, have what those of the sheet have
        (wide, high), usual = room(sheet, self.contents.norm), FORMATS[sheet.name]
        first, sizes = dict(self.wanted), self.contents.solved.sizes
        # the first rungs at which the lines that size the views have room, before any view is drawn
        lines = {"mu_l": (sizes["a_w"], high), "near": (2.0 * sizes["p"], wide), "rolled": (sizes["l_N1N2"], wide)}
        for name, (length, most) in lines.items():
            first[name] = next((k for k, mu in enumerate(self.ladders[name]) if length / mu < most), 0)
        first = self._as_wanted(self.fitted(sheet, self._as_wanted(first, sheet)), sheet)
        while True:
            ways = [own for steps in SMALLER if (own := self._in_order(usual, self._lowered(first, steps)))]
            rungs = min(ways, key=lambda found: last(found[2]))[0] if ways else first
            if ways and (found := self._in_order(sheet, rungs)):
                return found
            if not self.has_next(first, "mu_l"):
                raise InputError("sheet-too-small", format=sheet.name)
            first = self.lower(first, "mu_l")  # the first page has less room than the others

    def _as_wanted(self, rungs: Rungs, sheet: Format) -> Rungs:
        """Return rungs; where all is to be drawn as wanted they are refused if the task's own scale is given up."""
        if rungs["mu_l"] and isinstance(self.contents.choosers.get("mu_l"), Fixed):
            self.refuse_smaller(sheet)
        return rungs

    def _lowered(self, rungs: Rungs, steps: Mapping[str, int]) -> Rungs:
        """Return rungs so many steps further, as far as there are any."""
        return rungs | {name: min(rungs[name] + step, len(self.ladders[name]) - 1) for name, step in steps.items()}

    def _in_order(self, sheet: Format, rungs: Rungs) -> Found | None:
        """Place views on as many pages as they need."""
        views = self.views(sheet, rungs)
        places = arrange([view.size for view in views], sheet, self.contents.norm)
        return None if places is None else (rungs, views, places)
