"""The sheet of a linkage: on one page of the format that follows from its extents, or on several of it."""

from __future__ import annotations

from ....scales.errors import InputError
from ...compose import Drawn, arrange, arrange_halves, compose
from ...extents import Rungs, from_format
from ...formats import FORMATS, Format
from ...packing import Placement
from .fitting import Contents, Fitted, Fitting
from .ladders import chosen
from .several import forces_begin, several
from .zones import zoned


def draw(contents: Contents, sheet: Format | None = None) -> Drawn:
    """Draw the sheet at the scale factors that follow from its extents, on `sheet` or on the format that does.

    Where views have no room on one page of a smaller format than the largest, the next one is taken; where one has no
    room on a page of its own, its scale factor becomes coarser.

    Raises
    ------
    InputError
        When a plan cannot fit at the scale factor that was asked for; it names what would fit.
    """
    fitting = Fitting(contents)
    usual, rungs = chosen(fitting.extents, sheet)
    customary = FORMATS["A1"]
    whole = contents.cycle is not None and {"velocity", "acceleration"} <= {*contents.plans}
    if whole and sheet in (None, customary):
        laid_out = zoned(fitting, customary, contents.norm, rungs)
        if laid_out is not None:
            zoned_views, zoned_scales, zoned_places = laid_out
            return _drawn(fitting, customary, (zoned_views, zoned_scales), zoned_places)
    formats = [sheet] if sheet is not None else from_format(usual)
    for candidate in formats:
        found = _single(fitting, candidate, rungs, candidate is formats[-1])
        if found is not None:
            return _drawn(fitting, candidate, *found)
    return _drawn(fitting, formats[-1], *several(fitting, formats[-1], rungs))


def _single(fitting: Fitting, sheet: Format, rungs: Rungs, last: bool) -> tuple[Fitted, list[Placement]] | None:
    """Try one page: in reading order, with kinematics on the left and forces on the right, at last in any order."""
    try:
        fitted, taken = fitting.fitted(sheet, rungs)
    except InputError:
        if last:
            raise
        return None
    if taken != rungs and not last:
        return None  # a larger format may hold them
    views, norm = fitted[0], fitting.contents.norm
    sizes = [view.size for view in views]
    places = arrange(sizes, sheet, norm, 1)
    if places is None:
        places = arrange_halves(sizes, forces_begin([view.name for view in views]), sheet, norm)
    if places is None:
        places = arrange(sizes, sheet, norm, 1, any_order=True)
    return None if places is None else (fitted, places)


def _drawn(fitting: Fitting, sheet: Format, fitted: Fitted, places: list[Placement]) -> Drawn:
    views, scales = fitted
    return compose(views, places, scales, sheet, fitting.contents.norm)
