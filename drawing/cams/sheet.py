"""The sheet of a cam: the smallest format of which one sheet holds everything, or several pages of a given one."""

from __future__ import annotations

from dataclasses import replace

from ...scales.choices import SIZES
from ..compose import arrange, compose, worth_trying
from ..formats import FORMATS, Format
from ..packing import Placement
from ..page import Drawn
from ..pens import Norm
from ..rungs import fitted, on_pages
from ..titleblock import Stamp
from ..view import View
from ..zones import zoned
from .fitting import Contents as Contents
from .fitting import Fitting, Rungs
from .zones import LAYOUTS

Found = tuple[Rungs, list[View], list[Placement]]


def draw(contents: Contents, stamp: Stamp, sheet: Format | None = None) -> Drawn:
    """Draw the sheet on `sheet`, or on the smallest format of which one sheet holds everything.

    Raises
    ------
    InputError
        When a view has no room on a page of the format.
    """
    fitting, largest = Fitting(contents), FORMATS[SIZES[-1]]
    formats = [sheet] if sheet is not None else worth_trying([v for v, _ in fitting.views(largest, Rungs())])
    for candidate in formats:
        last = candidate is formats[-1]
        rungs = fitted(fitting, candidate, contents.norm, Rungs()) if last else Rungs()
        found = _single(fitting, candidate, rungs)
        if found is None and last:
            views = [view for view, _ in fitting.views(candidate, rungs)]
            found = rungs, views, on_pages(views, candidate, contents.norm)
        if found is not None:
            break
    assert found is not None, "on the last format there are as many pages as it takes"
    return _drawn(fitting, stamp, candidate, found)


def _single(fitting: Fitting, sheet: Format, rungs: Rungs) -> Found | None:
    """Try one page with the S-ds/dphi diagram, if it must be, smaller than at these rungs."""
    norm = fitting.contents.norm
    others = [view for view, figure in fitting.views(sheet, rungs) if "mu_s_ds" not in figure.ladders]
    if _on_a_page(others, sheet, norm) is None:
        return None
    for rung in range(rungs.mu_s_ds, len(fitting.ladders["mu_s_ds"])):
        rungs = replace(rungs, mu_s_ds=rung)
        views = [view for view, _ in fitting.views(sheet, rungs)]
        places = _on_a_page(views, sheet, norm)
        if places is not None:
            return rungs, views, places
    return None


def _on_a_page(views: list[View], sheet: Format, norm: Norm) -> list[Placement] | None:
    """Place views on one page, in the customary zones or in reading order."""
    places = zoned(LAYOUTS, views, sheet, norm)
    if places is None and sum(view.size[0] * view.size[1] for view in views) < sheet.width * sheet.height:
        places = arrange([view.size for view in views], sheet, norm, 1)
    return places


def _drawn(fitting: Fitting, stamp: Stamp, sheet: Format, found: Found) -> Drawn:
    rungs, views, places = found
    pages = compose(views, places, sheet, fitting.contents.norm, stamp)
    return Drawn(pages, fitting.scales(sheet, rungs), sheet.name, fitting.reduction(rungs))
