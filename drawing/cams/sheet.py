"""The sheet of a cam: the smallest format of which one sheet holds everything, or several pages of a given one."""

from __future__ import annotations

from itertools import product

from ...scales.choices import SIZES
from ...scales.errors import InputError
from ..compose import arrange, compose, room
from ..formats import FORMATS, Format
from ..packing import Placement
from ..page import Drawn
from ..titleblock import Stamp
from ..view import View
from .fitting import COARSER, REDUCTIONS, Rungs, mu_ladder, scales, scene_of, views
from .fitting import Contents as Contents
from .zones import zoned

FULL = 1.05  # parts of a page whose figures no arrangement brings on one page


def draw(contents: Contents, stamp: Stamp, sheet: Format | None = None) -> Drawn:
    """Draw the sheet on `sheet`, or on the smallest format of which one sheet holds everything.

    Raises
    ------
    InputError
        When a view has no room on a page of the format.
    """
    formats = [sheet] if sheet is not None else [FORMATS[name] for name in SIZES]
    for candidate in formats:
        found = _single(contents, candidate)
        if found is not None:
            return _drawn(contents, stamp, candidate, *found)
    return _drawn(contents, stamp, formats[-1], *_several(contents, formats[-1]))


def _single(contents: Contents, sheet: Format) -> tuple[Rungs, list[View], list[Placement]] | None:
    """Try one page: diagrams as they are given, the S-ds/dphi diagram smaller if it must be."""
    for coarser in COARSER:
        rungs = Rungs(1.0, coarser, mu_ladder(contents)[0])
        drawn = views(contents, sheet, rungs)
        if sum(view.size[0] * view.size[1] for view in drawn) > FULL * sheet.width * sheet.height:
            continue
        places = zoned(drawn, sheet, contents.norm) or arrange([view.size for view in drawn], sheet, contents.norm, 1)
        if places is not None:
            return rungs, drawn, places
    return None


def _several(contents: Contents, sheet: Format) -> tuple[Rungs, list[View], list[Placement]]:
    """Take as many pages as are needed; what no page can hold is drawn smaller."""
    wide, high = room(sheet, contents.norm)
    for mu_l, reduction, coarser in product(mu_ladder(contents), REDUCTIONS, COARSER):
        rungs = Rungs(reduction, coarser, mu_l)
        drawn = views(contents, sheet, rungs)
        if all(view.size[0] <= wide and view.size[1] <= high for view in drawn):
            places = arrange([view.size for view in drawn], sheet, contents.norm, None)
            if places is not None:
                return rungs, drawn, places
    raise InputError("sheet-too-small", format=sheet.name)


def _drawn(
    contents: Contents, stamp: Stamp, sheet: Format, rungs: Rungs, drawn: list[View], places: list[Placement]
) -> Drawn:
    factors = scales(contents, scene_of(contents, sheet, rungs))
    return Drawn(compose(drawn, places, sheet, contents.norm, stamp), factors, sheet.name)
