"""The sheet of a gear pair: the smallest format of which one sheet holds everything, or several pages of one."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from itertools import product

from ...plans.gears.construction import MESHING, SLIDING, THETA
from ...plans.gears.gear import GEOMETRY_PART, MESHING_PART, SLIDING_PART
from ...plans.gears.solve import SolvedGear
from ...scales.errors import InputError
from ...scales.scale import Scale
from ..compose import Drawn, arrange, arrange_rest, compose
from ..contents import SheetContents
from ..extents import from_format
from ..figure import Figure
from ..formats import Format, room
from ..nesting import Nest, column, names, row
from ..packing import Placement
from ..pens import Norm
from ..rungs import Kept, fitted, has_next, lower
from ..style import STYLES
from ..table import note_block
from ..view import View
from ..words import Words
from ..zones import BLOCK, TURNED, zoned
from .ladders import first_scales, mu_ladder, near_ladder, parts_of, rolled_ladder
from .scene import GearScene, lettered

Found = tuple["Rungs", list[View], list[Placement]]
Way = Callable[[list[View], Format, Norm], list[Placement] | None]
BESIDE = ("rolled", "part")  # ladders of what stands beside the meshing
SMALLER = sorted(product(range(3), repeat=len(BESIDE)), key=sum)  # rungs further at which a page is tried
LEAST = 0.25  # part of the area that what stands beside the meshing keeps at the last of these
FULL = 0.75  # part of a format that views may cover
TEXT_WIDTH = {"A1": 200.0, "A2": 175.0, "A3": 150.0, "A4": 175.0}
GearFigure = Figure[GearScene]
Contents = SheetContents[SolvedGear]
# everything on one page, for sheets without the worked formulas
LAYOUT = row(
    column(TURNED, "meshing"),
    column(
        row("rolling", "data"),
        row(column("action", "sliding"), column("points", "checks", "contour", BLOCK)),
    ),
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


def draw(contents: Contents, sheet: Format | None = None) -> Drawn:
    """Draw the sheet on `sheet`, or on the smallest format of which one sheet holds everything.

    Raises
    ------
    InputError
        When a view has no room on a page of the format.
    """
    fitting, norm = Fitting(contents), contents.norm
    usual, _ = first_scales(contents.solved, contents.choosers, contents.plans)
    formats = [sheet] if sheet is not None else from_format(usual)
    for candidate in formats[:-1]:
        found = _placed(fitting, candidate, Rungs(), _on_a_page)
        if found is not None:
            break
    else:
        candidate = formats[-1]
        found = _pages(fitting, candidate)
    rungs, views, places = found
    return compose(views, places, fitting.scales(candidate, rungs), candidate, norm)


def _pages(fitting: Fitting, sheet: Format) -> Found:
    """Take one page, with what is beside the meshing smaller where it must be, or several."""
    norm = fitting.contents.norm
    first = fitted(fitting, sheet, norm, fitting.least(sheet))
    first_pages: list[Way] = [partial(_on_the_first_page, layout) for layout in FIRST_PAGES]
    one: list[Way] = [_on_a_page] if _may_fit(fitting, sheet, first) else []
    ways = [(steps, way) for way in (*one, *first_pages) for steps in SMALLER]
    tried = (_placed(fitting, sheet, _stepped(fitting, first, steps), way) for steps, way in ways)
    found = next(filter(None, tried), None)
    while found is None:  # the first page has less room than the others
        found = _placed(fitting, sheet, first, _in_order)
        if found is None and not has_next(fitting, first, "mu_l"):
            raise InputError("sheet-too-small", format=sheet.name)
        first = lower(first, "mu_l") if found is None else first
    return found


def _may_fit(fitting: Fitting, sheet: Format, rungs: Rungs) -> bool:
    """Whether one page may hold everything at any of the rungs that are tried, by the areas of the views."""
    area = 0.0
    for view, figure in fitting.views(sheet, rungs):
        area += view.size[0] * view.size[1] * (LEAST if {*figure.ladders} & {*BESIDE} else 1.0)
    return area < FULL * sheet.width * sheet.height


def _stepped(fitting: Fitting, rungs: Rungs, steps: Sequence[int]) -> Rungs:
    """Return rungs so many steps further down the ladders of what stands beside the meshing."""
    for ladder, count in zip(BESIDE, steps, strict=True):
        for _ in range(count):
            rungs = lower(rungs, ladder) if has_next(fitting, rungs, ladder) else rungs
    return rungs


def _placed(fitting: Fitting, sheet: Format, rungs: Rungs, way: Way) -> Found | None:
    views = [view for view, _ in fitting.views(sheet, rungs)]
    places = way(views, sheet, fitting.contents.norm)
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
    return min(found, key=lambda places: max(place.page for place in places), default=None)


def _on_a_page(views: list[View], sheet: Format, norm: Norm) -> list[Placement] | None:
    """Place views on one page, in the customary zones or in reading order."""
    places = zoned(LAYOUTS, views, sheet, norm)
    if places is None and sum(view.size[0] * view.size[1] for view in views) < sheet.width * sheet.height:
        places = arrange([view.size for view in views], sheet, norm, 1)
    return places


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


@dataclass(frozen=True, slots=True)
class Rungs:
    """How small things are drawn: the meshing, its middle apart, the involutes, diagrams of sliding; each a rung."""

    mu_l: int = 0
    near: int = 0
    rolled: int = 0
    part: int = 0


@dataclass(slots=True)
class Fitting:
    """Draws the figures of `contents` for any format, each only once."""

    contents: Contents
    ladders: Mapping[str, tuple[float, ...]] = field(init=False)
    _words: Words = field(init=False)
    _kept: Kept[GearScene] = field(default_factory=Kept)

    def __post_init__(self) -> None:
        """Find the ladders."""
        self._words = lettered(self.contents.words)
        solved = self.contents.solved
        self.ladders = {
            "mu_l": mu_ladder(solved, self.contents.choosers),
            "near": near_ladder(solved),
            "rolled": rolled_ladder(solved),
            "part": parts_of(self.contents.plans),
        }

    def scene(self, sheet: Format, rungs: Rungs) -> GearScene:
        """Return the scene of a sheet on a format."""
        mus = {name: self.ladders[name][getattr(rungs, name)] for name in self.ladders}
        contents, style = self.contents, STYLES[sheet.letters]
        return GearScene(contents.solved, self._words, style, contents.givens, **mus)

    def views(self, sheet: Format, rungs: Rungs) -> list[tuple[View, GearFigure]]:
        """Return the views of a sheet in the order of the work."""
        scene = self.scene(sheet, rungs)
        width = min(TEXT_WIDTH[sheet.letters], room(sheet, self.contents.norm)[0])
        return [
            (self._kept.view(scene, sheet, rungs, figure, figure.name == MESHING and scene.apart), figure)
            for figure in figures(self.contents, scene, width)
        ]

    def least(self, sheet: Format) -> Rungs:
        """Return the first rungs at which the lines that size the views have room, before any view is drawn."""
        wide, high = room(sheet, self.contents.norm)
        sizes = self.contents.solved.sizes
        lines = {"mu_l": (sizes["a_w"], high), "near": (2.0 * sizes["p"], wide), "rolled": (sizes["l_N1N2"], wide)}
        rungs = {
            name: next((k for k, mu in enumerate(self.ladders[name]) if length / mu < most), 0)
            for name, (length, most) in lines.items()
        }
        return Rungs(**rungs)

    def scales(self, sheet: Format, rungs: Rungs) -> dict[str, Scale]:
        """Return the scale factors of the plans as they are drawn."""
        from .sliding_view import rho_scale, theta_scale

        scene = self.scene(sheet, rungs)
        made: dict[str, Callable[[GearScene], Scale]] = {
            MESHING: lambda scene: Scale("mu_l", scene.mu_l, "m"),
            SLIDING: rho_scale,
            THETA: theta_scale,
        }
        return {plan: made[plan](scene) for plan in self.contents.solved.scale_of_plan}


def figures(contents: Contents, scene: GearScene, width: float) -> Iterator[GearFigure]:
    """Go through the figures of a sheet in the order of the work; lines of text are at most `width` long."""
    made: tuple[tuple[str, Callable[[], Iterator[GearFigure]]], ...] = (
        (GEOMETRY_PART, _data),
        (MESHING_PART, partial(_meshing, scene.apart)),
        (GEOMETRY_PART, partial(_quality, width)),
        (SLIDING_PART, _sliding),
    )
    if contents.note:
        yield Figure("note", lambda scene: note_block(scene.words, contents.note, scene.style, width))
    for part, figures_of in made:
        if part in contents.plans:
            yield from figures_of()


def _data() -> Iterator[GearFigure]:
    from .tables import data_table

    yield Figure("data", data_table)


def _meshing(apart: bool) -> Iterator[GearFigure]:
    from . import action_view, meshing_view, rolling_view

    yield meshing_view.FIGURE
    if apart:
        yield meshing_view.NEAR
    yield rolling_view.FIGURE
    yield action_view.FIGURE


def _quality(width: float) -> Iterator[GearFigure]:
    from .contour_view import contour_view
    from .rack_view import rack_view
    from .tables import checks_table
    from .text import auxiliary_block, quality_block, sizes_block

    yield Figure("checks", checks_table)
    yield Figure("contour", contour_view)
    yield Figure("rack", rack_view, ("near",))
    for name, block in (("sizes", sizes_block), ("auxiliary", auxiliary_block), ("quality", quality_block)):
        yield Figure(f"equations_{name}", partial(block, width=width))


def _sliding() -> Iterator[GearFigure]:
    from . import sliding_view
    from .tables import points_table

    yield sliding_view.FIGURE
    yield Figure("points", points_table)
