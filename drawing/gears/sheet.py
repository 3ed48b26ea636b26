"""The sheet of a gear pair: the smallest format of which one sheet holds everything, or several pages of one."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from itertools import product

from ...scales.errors import InputError
from ..compose import Drawn, arrange, arrange_rest, compose
from ..extents import from_format
from ..formats import Format
from ..nesting import Nest, names
from ..packing import Placement
from ..pens import Norm
from ..rungs import fitted, has_next, lower
from ..view import View
from ..zones import zoned
from .fitting import Contents, Fitting, Rungs
from .ladders import first_scales
from .scene import MESHING
from .zones import FIRST_PAGES, LAYOUTS

Found = tuple[Rungs, list[View], list[Placement]]
Way = Callable[[list[View], Format, Norm], list[Placement] | None]
BESIDE = ("rolled", "part")  # ladders of what stands beside the meshing
SMALLER = sorted(product(range(3), repeat=len(BESIDE)), key=sum)  # rungs further at which a page is tried
LEAST = 0.25  # part of the area that what stands beside the meshing keeps at the last of these
FULL = 0.75  # part of a format that views may cover


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
