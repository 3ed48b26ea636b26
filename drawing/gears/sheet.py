"""The sheet of a gear pair: the smallest format of which one sheet holds everything, or several pages of one."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import partial
from itertools import chain, product
from typing import Any

from ...plans.gears.construction import MESHING, SLIDING, THETA
from ...plans.gears.gear import GEOMETRY_PART, MESHING_PART, SLIDING_PART
from ...plans.gears.solve import SolvedGear
from ...scales.errors import InputError
from ...scales.scale import Scale
from ..compose import BLOCK, TURNED, Nest, arrange, arrange_rest, column, names, row, zoned
from ..extents import Rungs
from ..figure import Figure
from ..formats import STYLES, Format, room
from ..packing import Placement
from ..pens import Norm
from ..rungs import Fitting, Found, SheetContents, pages
from ..table import note_block
from ..view import View
from .scene import GearScene, first_scales, lettered, mu_ladder, near_ladder, parts_of, rolled_ladder

Way = Callable[[list[View], Format, Norm], list[Placement] | None]
BESIDE = ("rolled", "part")  # ladders of what stands beside the meshing
SMALLER = sorted(product(range(3), repeat=len(BESIDE)), key=sum)  # rungs further at which a page is tried
LEAST = 0.25  # part of the area that what stands beside the meshing keeps at the last of these
FULL = 0.75  # part of a format that views may cover
GearFigure = Figure[GearScene]
# everything on one page, for sheets without the worked formulas
LAYOUT = row(
    column(TURNED, "meshing"),
    column(row("rolling", "data"), row(column("action", "sliding"), column("points", "checks", "contour", BLOCK))),
)
# what is drawn, where the calculations need a further page; where it has no room, the meshing with what belongs to it
FIRST_PAGES = (
    row(
        column(TURNED, "meshing"),
        column(row("rolling", "data"), row(column("action", "checks", "points"), column("sliding", BLOCK))),
    ),
    row(
        column(TURNED, "meshing"),
        column(row("rolling", "data"), row(column("action", "contour"), column("checks", BLOCK))),
    ),
)
LAYOUTS = (LAYOUT,)


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
        from . import action_view, meshing_view, rolling_view, text
        from .contour_view import contour_view

        note, plans = self.contents.note, self.contents.plans
        if note:
            yield Figure("note", lambda scene: note_block(scene.words, note, scene.style, width))
        if GEOMETRY_PART in plans:
            yield Figure("data", text.data_table)
        if MESHING_PART in plans:
            yield meshing_view.FIGURE
            if scene.apart:
                yield meshing_view.NEAR
            yield from (rolling_view.FIGURE, action_view.ACTION_FIGURE)
        if GEOMETRY_PART in plans:
            yield Figure("checks", text.checks_table)
            yield Figure("contour", contour_view)
            yield Figure("rack", rolling_view.rack_view, ("near",))
            for name in text.CALCULATED:
                yield Figure(f"equations_{name}", partial(text.calculations_block, name=name, width=width))
        if SLIDING_PART in plans:
            yield action_view.SLIDING_FIGURE
            yield Figure("points", text.points_table)

    def scales(self, sheet: Format, rungs: Rungs) -> dict[str, Scale]:
        """Return the scale factors of the plans as they are drawn."""
        from .action_view import rho_scale, theta_scale

        scene = self.scene(sheet, rungs)
        made: dict[str, Callable[[GearScene], Scale]] = {
            MESHING: lambda scene: Scale("mu_l", scene.mu_l, "m"),
            SLIDING: rho_scale,
            THETA: theta_scale,
        }
        return {plan: made[plan](scene) for plan in self.contents.solved.scale_of_plan}

    def on_a_page(self, sheet: Format, last: bool) -> Found | None:
        """Place everything on one page as large as wanted; on the `last` format it is tried with several pages."""
        return None if last else self.placed(sheet, self.wanted, LAYOUTS, any_order=False)

    def on_pages(self, sheet: Format) -> Found:
        """Take one page, with what is beside the meshing smaller where it must be, or several."""
        first = self.fitted(sheet, self._least(sheet))
        smaller = [self._stepped(first, steps) for steps in SMALLER]
        one = smaller if self._may_fit(sheet, first) else []
        on_one = (self.placed(sheet, rungs, LAYOUTS, any_order=False) for rungs in one)
        ways = [partial(_on_the_first_page, layout) for layout in FIRST_PAGES]
        on_more = (self._placed(sheet, rungs, way) for way in ways for rungs in smaller)
        found = next(filter(None, chain(on_one, on_more)), None)
        while found is None:  # the first page has less room than the others
            found = self._placed(sheet, first, _in_order)
            if found is None and not self.has_next(first, "mu_l"):
                raise InputError("sheet-too-small", format=sheet.name)
            first = self.lower(first, "mu_l")
        return found

    def _least(self, sheet: Format) -> Rungs:
        """Return the first rungs at which the lines that size the views have room, before any view is drawn."""
        wide, high = room(sheet, self.contents.norm)
        rungs, sizes = dict(self.wanted), self.contents.solved.sizes
        lines = {"mu_l": (sizes["a_w"], high), "near": (2.0 * sizes["p"], wide), "rolled": (sizes["l_N1N2"], wide)}
        for name, (length, most) in lines.items():
            rungs[name] = next((k for k, mu in enumerate(self.ladders[name]) if length / mu < most), 0)
        return rungs

    def _may_fit(self, sheet: Format, rungs: Rungs) -> bool:
        """Whether one page may hold everything at any of the rungs that are tried, by the areas of the views."""
        area = 0.0
        for view, figure in self.sized(sheet, rungs):
            area += view.size[0] * view.size[1] * (LEAST if {*figure.ladders} & {*BESIDE} else 1.0)
        return area < FULL * sheet.width * sheet.height

    def _stepped(self, rungs: Rungs, steps: Sequence[int]) -> Rungs:
        """Return rungs so many steps further down the ladders of what stands beside the meshing."""
        for ladder, count in zip(BESIDE, steps, strict=True):
            for _ in range(count):
                rungs = self.lower(rungs, ladder)
        return rungs

    def _placed(self, sheet: Format, rungs: Rungs, way: Way) -> Found | None:
        views = self.views(sheet, rungs)
        places = way(views, sheet, self.contents.norm)
        return None if places is None else (rungs, views, places)


def _in_order(views: list[View], sheet: Format, norm: Norm) -> list[Placement] | None:
    """Place views on as many pages as they need, the data before or after the meshing."""
    orders = views, sorted(views, key=lambda view: view.name != MESHING)
    found = []
    for order in orders:
        places = arrange([view.size for view in order], sheet, norm, None)
        if places is not None:
            by_name = {view.name: place for view, place in zip(order, places, strict=True)}
            found.append([by_name[view.name] for view in views])
    return min(found, key=pages, default=None)


def _on_the_first_page(layout: Nest, views: list[View], sheet: Format, norm: Norm) -> list[Placement] | None:
    """Place what a layout names in its zones, the rest on following pages."""
    names_there = set(names((layout,)))
    here = [view for view in views if view.name in names_there]
    rest = [view for view in views if view.name not in names_there]
    own = zoned((layout,), here, sheet, norm) if here and rest else None
    others = arrange_rest(rest, sheet, norm) if own is not None else None
    if own is None or others is None:
        return None
    places = iter(own), (replace(place, page=place.page + 1) for place in others)
    return [next(places[view.name not in names_there]) for view in views]
