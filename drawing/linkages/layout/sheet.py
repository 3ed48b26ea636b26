"""The sheet of a linkage: the smallest format of which one sheet holds everything, or several pages of a given one."""

from __future__ import annotations

from operator import is_

from ....scales.errors import InputError
from ...compose import Drawn, arrange, arrange_halves, compose, worth_trying
from ...formats import FORMATS, Format
from ...packing import Placement
from ...pens import Norm
from ...view import View
from .fitting import Contents, Fitted, Fitting
from .several import forces_begin, several
from .zones import zoned

COARSER = 5  # steps below the wanted scales, pa = 50 mm, beyond which several pages are better than one
CROWDED = 1.6  # parts of a page whose figures no coarser rung brings on one page


def draw(contents: Contents, sheet: Format | None = None) -> Drawn:
    """Draw the sheet on `sheet`, or on the smallest format of which one sheet holds everything.

    Raises
    ------
    InputError
        When a plan cannot fit at the scale factor that was asked for; it names what would fit.
    """
    fitting = Fitting(contents)
    customary = FORMATS["A1"]
    whole = contents.cycle is not None and {"velocity", "acceleration"} <= {*contents.plans}
    if whole and sheet in (None, customary):
        laid_out = zoned(fitting, customary, contents.norm)
        if laid_out is not None:
            zoned_views, zoned_scales, zoned_places = laid_out
            return _drawn(fitting, customary, (zoned_views, zoned_scales), zoned_places)
    formats = [sheet] if sheet is not None else worth_trying(fitting.views(customary)[0])
    for candidate in formats:
        found = _single(fitting, candidate, COARSER if candidate is formats[-1] else 0)
        if found is not None:
            return _drawn(fitting, candidate, *found)
    return _drawn(fitting, formats[-1], *several(fitting, formats[-1]))


def _area(fitted: Fitted) -> float:
    return sum(view.size[0] * view.size[1] for view in fitted[0])


def _single(fitting: Fitting, sheet: Format, coarser: int) -> tuple[Fitted, list[Placement]] | None:
    """Try one page, each scale factor up to `coarser` rungs beyond the first at which its views fit."""
    before: list[View] = []
    tried: list[Fitted] = []
    for step in range(coarser + 1):
        try:
            fitted = fitting.views(sheet, step)
        except InputError:
            if coarser:
                raise
            return None
        if not coarser and not fitting.keeps(fitted[1]):
            return None  # a larger format may hold what is fixed
        if len(before) == len(fitted[0]) and all(map(is_, before, fitted[0])):
            continue  # a coarser rung that sizes nothing
        before = fitted[0]
        tried.append(fitted)
        places = arrange([view.size for view in fitted[0]], sheet, fitting.contents.norm, 1)
        if places is not None:
            return fitted, places
        if _area(fitted) > CROWDED * sheet.width * sheet.height:
            return None
    halved = ((fitted, _halved(fitted, sheet, fitting.contents.norm)) for fitted in tried)
    return next(((fitted, places) for fitted, places in halved if places is not None), None)


def _halved(fitted: Fitted, sheet: Format, norm: Norm) -> list[Placement] | None:
    """Try kinematics in the left part of a page, forces in the right one."""
    views, _ = fitted
    return arrange_halves([view.size for view in views], forces_begin([view.name for view in views]), sheet, norm)


def _drawn(fitting: Fitting, sheet: Format, fitted: Fitted, places: list[Placement]) -> Drawn:
    views, scales = fitted
    return compose(views, places, scales, sheet, fitting.contents.norm)
