"""The sheet of a cam: the smallest format of which one sheet holds everything, or several pages of a given one."""

from __future__ import annotations

from dataclasses import replace
from itertools import product

from ...plans.cams.solve import EQUAL
from ...scales.choose import Fixed
from ...scales.errors import InputError
from ..compose import Drawn, arrange, arrange_closely, compose
from ..extents import from_format
from ..formats import Format, room
from ..packing import Placement
from ..rungs import fitted
from ..view import View
from ..zones import zoned
from .fitting import Contents as Contents
from .fitting import Fitting, Rungs
from .ladders import first_scales, size_of
from .zones import LAYOUTS

# what may be drawn smaller for the sake of one page, and by how many rungs
GIVING = {"mu_l": 2, "reduction": 2, "mu_s_ds": 2, "mu_s_d2s": 2}
# mm of the least radius and the stroke on a plan, so that it can be read: on S over ds/dphi more numbers stand closely
LEGIBLE = {"mu_s_ds": 60.0, "mu_s_d2s": 50.0}
Found = tuple[Rungs, list[View], list[Placement]]


def draw(contents: Contents, sheet: Format | None = None) -> Drawn:
    """Draw the sheet on `sheet`, or on the smallest format of which one sheet holds everything.

    Raises
    ------
    InputError
        When a view has no room on a page of the format.
    """
    fitting = Fitting(contents)
    formats = (
        [sheet]
        if sheet is not None
        else from_format(first_scales(contents.solved, contents.choosers, contents.plans)[0])
    )
    for candidate in formats:
        last = candidate is formats[-1]
        found = _single(fitting, candidate, last)
        if found is None and last:
            found = _several(fitting, candidate)
        if found is not None:
            break
    assert found is not None, "on the last format there are as many pages as it takes"
    return _drawn(fitting, candidate, found)


def _restored(fitting: Fitting, sheet: Format, rungs: Rungs, first: bool) -> Rungs:
    """Return rungs at which plans made of two diagrams are as large as a page has room for, now diagrams are small."""
    wide, high = room(sheet, fitting.contents.norm, first)
    for name in EQUAL:
        for rung in range(getattr(rungs, name)):
            larger = replace(rungs, **{name: rung})
            sizes = [view.size for view, figure in fitting.views(sheet, larger) if name in figure.ladders]
            if all(own[0] <= wide and own[1] <= high for own in sizes):
                rungs = larger
                break
    return rungs


def _several(fitting: Fitting, sheet: Format) -> Found:
    """Take several pages in reading order, or fewer on which views stand closely.

    Raises
    ------
    InputError
        When a view has no room on any page.
    """
    norm = fitting.contents.norm
    for first in (False, True):  # where nothing stands on the first page as it is, all becomes small enough for it
        rungs = _restored(fitting, sheet, fitted(fitting, sheet, norm, Rungs(), first), first)
        views = _views(fitting, sheet, rungs)
        sizes = [view.size for view in views]
        ways = [way for way in (arrange(sizes, sheet, norm, None), arrange_closely(sizes, sheet, norm)) if way]
        if ways:
            return rungs, views, min(ways, key=lambda places: max(place.page for place in places))
    raise InputError("sheet-too-small", format=sheet.name)


def _single(fitting: Fitting, sheet: Format, last: bool) -> Found | None:
    """Try one page as large as wanted, then with plans and, on the `last` format, diagrams and profiles smaller."""
    wanted, *smaller = _ways(fitting, last)
    found = _placed(fitting, sheet, wanted)
    if found is not None or not smaller or not _may_fit(_views(fitting, sheet, smaller[-1]), sheet):
        return found
    tried = (_placed(fitting, sheet, rungs) for rungs in smaller if _legible(fitting, sheet, rungs))
    return next((page for page in tried if page is not None), None)


def _placed(fitting: Fitting, sheet: Format, rungs: Rungs) -> Found | None:
    """Try one page at these rungs: in customary zones, in reading order, or wherever there is room."""
    views = _views(fitting, sheet, rungs)
    if not _may_fit(views, sheet):
        return None
    norm = fitting.contents.norm
    places = zoned(LAYOUTS, views, sheet, norm)
    if places is None:
        places = arrange([view.size for view in views], sheet, norm, 1, any_order=True)
    return None if places is None else (rungs, views, places)


def _views(fitting: Fitting, sheet: Format, rungs: Rungs) -> list[View]:
    return [view for view, _ in fitting.views(sheet, rungs)]


def _ways(fitting: Fitting, last: bool) -> list[Rungs]:
    """Return rungs to be tried: first what is least missed gives way, what the task asks for at the end."""
    asked = ["mu_l"] * isinstance(fitting.contents.choosers.get("mu_l"), Fixed)
    most = {name: rungs for name, rungs in GIVING.items() if name not in asked and (last or name in EQUAL)}
    ranges = (range(min(rungs + 1, len(fitting.ladders[name]))) for name, rungs in most.items())
    ways = (Rungs(**dict(zip(most, steps, strict=True))) for steps in product(*ranges))
    return sorted(ways, key=_missed)


def _legible(fitting: Fitting, sheet: Format, rungs: Rungs) -> bool:
    """Whether no plan made of two diagrams becomes too small to be read for the sake of one page."""
    scene = fitting.scene(sheet, rungs)
    smaller = (name for name in EQUAL if getattr(rungs, name))
    return all(size_of(scene.solved, name) >= LEGIBLE[name] * scene.mus[name] for name in smaller)


def _missed(rungs: Rungs) -> tuple[int, int]:
    """Return how much is given up at these rungs; of equal losses that of the diagrams is the least."""
    return 3 * (rungs.mu_l + rungs.reduction) + rungs.mu_s_ds + rungs.mu_s_d2s, rungs.mu_l


def _may_fit(views: list[View], sheet: Format) -> bool:
    return sum(view.size[0] * view.size[1] for view in views) < sheet.width * sheet.height


def _drawn(fitting: Fitting, sheet: Format, found: Found) -> Drawn:
    rungs, views, places = found
    scales, norm = fitting.scales(sheet, rungs), fitting.contents.norm
    return compose(views, places, scales, sheet, norm, fitting.reduction(rungs))
