"""The sheet of a gear pair: the smallest format of which one sheet holds everything, or several pages of one."""

from __future__ import annotations

from ...scales.choices import SIZES
from ..compose import arrange, compose, worth_trying
from ..formats import FORMATS, Format
from ..packing import Placement
from ..page import Drawn
from ..pens import Norm
from ..rungs import fitted, has_next, lower, on_pages
from ..titleblock import Stamp
from ..view import View
from ..zones import zoned
from .fitting import Contents, Fitting, Rungs
from .zones import LAYOUTS

Found = tuple[Rungs, list[View], list[Placement]]
BESIDE = ("rolled", "part")  # ladders of what stands beside the meshing
TRIES = 3  # rungs of these at which one page is tried


def draw(contents: Contents, stamp: Stamp, sheet: Format | None = None) -> Drawn:
    """Draw the sheet on `sheet`, or on the smallest format of which one sheet holds everything.

    Raises
    ------
    InputError
        When a view has no room on a page of the format.
    """
    fitting, largest, norm = Fitting(contents), FORMATS[SIZES[-1]], contents.norm
    formats = [sheet] if sheet is not None else worth_trying([v for v, _ in fitting.views(largest, Rungs())])
    for candidate in formats:
        last = candidate is formats[-1]
        rungs = fitted(fitting, candidate, norm, Rungs()) if last else Rungs()
        found = _single(fitting, candidate, rungs, last)
        if found is not None:
            break
    if found is None:
        views = [view for view, _ in fitting.views(candidate, rungs)]
        found = rungs, views, on_pages(views, candidate, norm)
    rungs, views, places = found
    pages = compose(views, places, candidate, norm, stamp)
    return Drawn(pages, fitting.scales(candidate, rungs), candidate.name)


def _single(fitting: Fitting, sheet: Format, rungs: Rungs, smaller: bool) -> Found | None:
    """Try one page; with what is beside the meshing `smaller` where it must be."""
    for _ in range(TRIES if smaller else 1):
        views = [view for view, _ in fitting.views(sheet, rungs)]
        places = _on_a_page(views, sheet, fitting.contents.norm)
        if places is not None:
            return rungs, views, places
        for ladder in BESIDE:
            if has_next(fitting, rungs, ladder):
                rungs = lower(rungs, ladder)
    return None


def _on_a_page(views: list[View], sheet: Format, norm: Norm) -> list[Placement] | None:
    """Place views on one page, in the customary zones or in reading order."""
    places = zoned(LAYOUTS, views, sheet, norm)
    if places is None and sum(view.size[0] * view.size[1] for view in views) < sheet.width * sheet.height:
        places = arrange([view.size for view in views], sheet, norm, 1)
    return places
