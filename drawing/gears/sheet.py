"""The sheet of a gear pair: the smallest format of which one sheet holds everything, or several pages of one."""

from __future__ import annotations

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
from .fitting import Contents, Fitting, Rungs
from .zones import LAYOUTS


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
        views = [view for view, _ in fitting.views(candidate, rungs)]
        places = _on_a_page(views, candidate, norm)
        if places is not None:
            break
    if places is None:
        places = on_pages(views, candidate, norm)
    pages = compose(views, places, candidate, norm, stamp)
    return Drawn(pages, fitting.scales(candidate, rungs), candidate.name)


def _on_a_page(views: list[View], sheet: Format, norm: Norm) -> list[Placement] | None:
    """Place views on one page, in the customary zones or in reading order."""
    places = zoned(LAYOUTS, views, sheet, norm)
    if places is None and sum(view.size[0] * view.size[1] for view in views) < sheet.width * sheet.height:
        places = arrange([view.size for view in views], sheet, norm, 1)
    return places
