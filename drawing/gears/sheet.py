"""The sheet of a gear pair: its figures, and the pages on which they stand."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from itertools import chain, product
from typing import Any

from ...plans.gears.construction import MESHING
from ...plans.gears.gear import GEOMETRY_PART, MESHING_PART, SLIDING_PART
from ...plans.gears.solve import SolvedGear
from ...scales.errors import InputError
from ...scales.scale import Scale
from ..compose import BLOCK, TURNED, Nest, arrange, column, names, row, zoned
from ..extents import Rungs
from ..figure import Figure, Fitting, Found, SheetContents, pages
from ..formats import STYLES, Format, room
from ..view import note_block
from .scene import GearScene, first_scales, lettered, mu_ladder, near_ladder, parts_of, rolled_ladder

BESIDE = ("rolled", "part")  # ladders of what stands beside the meshing
# rungs further at which a page is tried
SMALLER = [dict(zip(BESIDE, steps, strict=True)) for steps in sorted(product(range(3), repeat=len(BESIDE)), key=sum)]
LEAST = 0.25  # part of the area that what stands beside the meshing keeps at the last of these
FULL = 0.75  # part of a format that views may cover
GearFigure = Figure[GearScene]


def _page(*below: Nest) -> Nest:
    """Return a page with the meshing on the left, and so much below the involutes and the data."""
    return row(column(TURNED, "meshing"), column(row("rolling", "data"), row(*below)))


# everything on one page, for sheets without the worked formulas
LAYOUTS = (_page(column("action", "sliding"), column("points", "checks", "contour", BLOCK)),)
# what is drawn, where the calculations need a further page; where it has no room, the meshing with what belongs to it
FIRST_PAGES = (
    _page(column("action", "checks", "points"), column("sliding", BLOCK)),
    _page(column("action", "contour"), column("checks", BLOCK)),
)


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

        note, plans = self.contents.note, self.contents.plans
        if note:
            yield Figure("note", lambda scene: note_block(scene.words, note, scene.style, width))
        if GEOMETRY_PART in plans:
            yield Figure("data", text.data_table)
        if MESHING_PART in plans:
            yield meshing_view.FIGURE
            if scene.apart:
                yield meshing_view.NEAR
            yield from (cutting_view.FIGURE, action_view.ACTION_FIGURE)
        if GEOMETRY_PART in plans:
            yield Figure("checks", text.checks_table)
            yield Figure("contour", cutting_view.contour_view)
            yield Figure("rack", cutting_view.rack_view, ("near",))
            for name in text.CALCULATED:
                yield Figure(f"equations_{name}", partial(text.calculations_block, name=name, width=width))
        if SLIDING_PART in plans:
            yield action_view.SLIDING_FIGURE
            yield Figure("points", text.points_table)

    def scales(self, sheet: Format, rungs: Rungs) -> dict[str, Scale]:
        """Return the scale factors of the plans as they are drawn."""
        scene = self.scene(sheet, rungs)
        return {plan: scene.scale(plan) for plan in self.contents.solved.scale_of_plan}

    def on_a_page(self, sheet: Format, last: bool) -> Found | None:
        """Place everything on one page as large as wanted; on the `last` format it is tried with several pages."""
        return None if last else self.placed(sheet, self.wanted, LAYOUTS, any_order=False)

    def on_pages(self, sheet: Format) -> Found:
        """Take one page, with what is beside the meshing smaller where it must be, or several."""
        wide, high = room(sheet, self.contents.norm)
        rungs, sizes = dict(self.wanted), self.contents.solved.sizes
        # the first rungs at which the lines that size the views have room, before any view is drawn
        lines = {"mu_l": (sizes["a_w"], high), "near": (2.0 * sizes["p"], wide), "rolled": (sizes["l_N1N2"], wide)}
        for name, (length, most) in lines.items():
            rungs[name] = next((k for k, mu in enumerate(self.ladders[name]) if length / mu < most), 0)
        first = self.fitted(sheet, rungs)
        last = {ladder: len(self.ladders[ladder]) - 1 for ladder in BESIDE}
        smaller = [
            first | {ladder: min(first[ladder] + steps[ladder], last[ladder]) for ladder in BESIDE} for steps in SMALLER
        ]
        area = 0.0  # of the views at the last of these
        for view, figure in self.sized(sheet, first):
            area += view.size[0] * view.size[1] * (LEAST if {*figure.ladders} & {*BESIDE} else 1.0)
        one = smaller if area < FULL * sheet.width * sheet.height else []
        on_one = (self.placed(sheet, rungs, LAYOUTS, any_order=False) for rungs in one)
        on_more = (self._on_the_first(layout, sheet, rungs) for layout in FIRST_PAGES for rungs in smaller)
        placed = next(filter(None, chain(on_one, on_more)), None)
        while placed is None:  # the first page has less room than the others
            placed = self._in_order(sheet, first)
            if placed is None and not self.has_next(first, "mu_l"):
                raise InputError("sheet-too-small", format=sheet.name)
            first = self.lower(first, "mu_l")
        return placed

    def _in_order(self, sheet: Format, rungs: Rungs) -> Found | None:
        """Place views on as many pages as they need, the data before or after the meshing."""
        views, ways = self.views(sheet, rungs), []
        for order in (views, sorted(views, key=lambda view: view.name != MESHING)):
            places = arrange([view.size for view in order], sheet, self.contents.norm, None)
            if places is not None:
                by_name = {view.name: place for view, place in zip(order, places, strict=True)}
                ways.append([by_name[view.name] for view in views])
        return (rungs, views, min(ways, key=pages)) if ways else None

    def _on_the_first(self, layout: Nest, sheet: Format, rungs: Rungs) -> Found | None:
        """Place what a layout names in its zones, the rest on following pages."""
        views, norm, names_there = self.views(sheet, rungs), self.contents.norm, {*names((layout,))}
        here, rest = ([view for view in views if (view.name in names_there) is there] for there in (True, False))
        own = zoned((layout,), here, sheet, norm) if here and rest else None
        others = arrange([view.size for view in rest], sheet, norm, None, first=False) if own is not None else None
        if own is None or others is None:
            return None
        places = iter(own), (replace(place, page=place.page + 1) for place in others)
        return rungs, views, [next(places[view.name not in names_there]) for view in views]
