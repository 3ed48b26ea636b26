"""The sheet of a hoist: the smallest format of which one sheet holds everything, or several pages of a given one."""

from __future__ import annotations

from ..compose import Drawn, arrange, arrange_closely, compose
from ..extents import from_format
from ..formats import Format
from ..rungs import fitted, on_pages
from .fitting import PARTS, Fitting, Rungs
from .fitting import Contents as Contents
from .ladders import first_scales


def draw(contents: Contents, sheet: Format | None = None) -> Drawn:
    """Draw the sheet on `sheet`, or on the smallest format of which one sheet holds everything.

    Raises
    ------
    InputError
        When a view has no room on a page of the format.
    """
    fitting, norm = Fitting(contents), contents.norm
    usual, _ = first_scales(contents.solved, contents.choosers, contents.plans)
    formats = [sheet] if sheet else from_format(usual)
    rungs, places = Rungs(), None
    for candidate in formats:
        views = [view for view, _ in fitting.views(candidate, rungs)]
        places = arrange([view.size for view in views], candidate, norm, 1, any_order=True)
        if places is not None:
            break
    if places is None:
        rungs = fitted(fitting, candidate, norm, rungs)
        views = [view for view, _ in fitting.views(candidate, rungs)]
        ways = on_pages(views, candidate, norm), arrange_closely([view.size for view in views], candidate, norm)
        places = min(filter(None, ways), key=lambda found: max(place.page for place in found))
    return compose(views, places, fitting.scales(candidate, rungs), candidate, norm, PARTS[rungs.part])
