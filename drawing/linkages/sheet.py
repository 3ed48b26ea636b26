"""The sheet of a linkage: the smallest format of which one sheet holds everything, or several pages of a given one."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from operator import is_

from ...scales.errors import InputError
from ...scales.scale import Scale
from ..compose import arrange, arrange_parts, compose
from ..formats import FORMATS, Format
from ..packing import Placement
from ..page import Page
from ..titleblock import Stamp
from ..view import View
from .fitting import SMALLEST_FIRST, Contents, Fitted, Fitting
from .zones import zoned

# part of the area on the largest format that the same figures take on a smaller one, with its smaller letters
LIGHTER = {"A4": 0.5, "A3": 0.55, "A2": 0.9, "A1": 1.0}
COARSER = 5  # steps below the wanted scales, pa = 50 mm, beyond which several pages are better than one
FORCES = ("equations_forces_loads", "group_", "driver", "lever")  # views with which the part of the forces begins
CROWDED = 1.6  # parts of a page whose figures no coarser rung brings on one page


@dataclass(frozen=True, slots=True)
class Drawn:
    """A drawn sheet: its pages, and the scale factors that they have, by plan."""

    pages: list[Page]
    scales: Mapping[str, Scale]
    format: str


def draw(contents: Contents, stamp: Stamp, sheet: Format | None = None) -> Drawn:
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
            return _drawn(fitting, stamp, customary, (zoned_views, zoned_scales), zoned_places)
    formats = [sheet] if sheet is not None else _worth_trying(fitting)
    for candidate in formats:
        found = _single(fitting, candidate, COARSER if candidate is formats[-1] else 0)
        if found is not None:
            return _drawn(fitting, stamp, candidate, *found)
    views, scales = fitting.views(formats[-1])
    # several pages: kinematics on the first ones, forces on the others
    forces = next((i for i, view in enumerate(views) if view.name.startswith(FORCES)), len(views))
    places = arrange_parts((views[:forces], views[forces:]), formats[-1], contents.norm)
    if places is None:
        raise InputError("sheet-too-small", format=formats[-1].name)
    return _drawn(fitting, stamp, formats[-1], (views, scales), places)


def _area(fitted: Fitted) -> float:
    return sum(view.size[0] * view.size[1] for view in fitted[0])


def _worth_trying(fitting: Fitting) -> list[Format]:
    """Return the formats that the figures can fit by their area, and the largest one."""
    largest = FORMATS[SMALLEST_FIRST[-1]]
    area = _area(fitting.views(largest))
    names = [name for name in SMALLEST_FIRST if area * LIGHTER[name] < FORMATS[name].width * FORMATS[name].height]
    return [FORMATS[name] for name in dict.fromkeys([*names, largest.name])]


def _single(fitting: Fitting, sheet: Format, coarser: int) -> tuple[Fitted, list[Placement]] | None:
    """Try one page, each scale factor up to `coarser` rungs beyond the first at which its views fit."""
    tries = [(step, False) for step in range(coarser + 1)] + [(coarser, True)] * bool(coarser)
    before: list[View] = []
    for step, any_order in tries:
        try:
            fitted = fitting.views(sheet, step)
        except InputError:
            if coarser or fitting.firm:
                raise
            return None
        same = len(before) == len(fitted[0]) and all(map(is_, before, fitted[0]))
        if same and not any_order:  # a coarser rung that sizes nothing
            continue
        before = fitted[0]
        places = arrange(fitted[0], sheet, fitting.contents.norm, 1, any_order)
        if places is not None:
            return fitted, places
        if _area(fitted) > CROWDED * sheet.width * sheet.height:
            return None
    return None


def _drawn(fitting: Fitting, stamp: Stamp, sheet: Format, fitted: Fitted, places: list[Placement]) -> Drawn:
    views, scales = fitted
    return Drawn(compose(views, places, sheet, fitting.contents.norm, stamp), scales, sheet.name)
