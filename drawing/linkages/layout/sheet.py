"""The sheet of a linkage: on one page of the format that follows from its extents, or on several of it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ....plans.linkages.structure import Structure
from ....plans.names import role
from ....scales.errors import InputError
from ....scales.scale import Scale
from ...compose import Drawn, arrange, arrange_halves, arrange_parts, arrange_rest, compose
from ...extents import Rungs, from_format
from ...formats import FORMATS, Format, room
from ...packing import Placement, pack
from ...pens import Norm
from ...text import Box
from ...view import View
from ..views import Contents
from .fitting import Fitted, Fitting
from .ladders import chosen

# views with which the part of the forces begins
OF_FORCES = ("load_", "equations_forces_loads", "group_", "driver", "lever")

Several = tuple[Fitted, list[Placement]]
# mm from the left bottom corner of the trimmed sheet
ZONES: dict[str, Box] = {
    "positions": (25.0, 330.0, 355.0, 572.0),
    "velocity": (365.0, 330.0, 600.0, 584.0),
    "acceleration": (610.0, 330.0, 831.0, 584.0),
    "diagrams": (25.0, 12.0, 285.0, 325.0),
    "last": (295.0, 12.0, 468.0, 325.0),
    "first": (475.0, 12.0, 645.0, 325.0),
    "driver": (651.0, 65.0, 831.0, 325.0),
}
# what may become coarser for the sake of a zone: the plan's own scale factor, not one that other zones share
OWN = {
    "positions": "l",
    "velocity": "V",
    "acceleration": "a",
    "last": "F",
    "first": "F",
    "driver": "F",
}
BOTH = (295.0, 12.0, 645.0, 325.0)  # of a mechanism with one group
GAP = 5.0
PATIENCE = 5  # rungs by which a scale factor may become coarser for the sake of its zone

Zoned = tuple[list[View], Mapping[str, Scale], list[Placement]]


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


def several(fitting: Fitting, sheet: Format, rungs: Rungs) -> Several:
    """Return views, scale factors and places on as many pages of `sheet` as they need, from these rungs on.

    Raises
    ------
    InputError
        When a plan cannot fit at the scale factor that was asked for; it names what would fit.
    """
    found = _roomy(fitting, sheet, rungs) or _reordered(fitting, sheet, rungs)
    if found is None:
        raise InputError("sheet-too-small", format=sheet.name)
    return found


def forces_begin(names: Sequence[str]) -> int:
    """Return how many views of these names come before the part of the forces."""
    return next((i for i, name in enumerate(names) if name.startswith(OF_FORCES)), len(names))


def _roomy(fitting: Fitting, sheet: Format, rungs: Rungs) -> Several | None:
    """Place the views in reading order, the larger ones smaller if the first page cannot hold them."""
    for first in (False, True):
        try:
            fitted, taken = fitting.fitted(sheet, rungs, first)
        except InputError:
            if not first:
                raise
            return None
        if first and any(taken[symbol] > rung for symbol, rung in rungs.items() if fitting.is_fixed(symbol)):
            return None
        places = _placed(fitting, sheet, fitted[0])
        if places is not None:
            return fitted, places
    return None


def _reordered(fitting: Fitting, sheet: Format, rungs: Rungs) -> Several | None:
    """Begin with the first view that the first page can hold: a text, where a fixed plan is too large for it."""
    (views, scales), _ = fitting.fitted(sheet, rungs)
    wide, high = room(sheet, fitting.contents.norm, first=True)
    fit = [i for i, view in enumerate(views) if view.size[0] <= wide and view.size[1] <= high]
    for i in fit[:1]:
        order = [views[i], *views[:i], *views[i + 1 :]]
        places = _placed(fitting, sheet, order)
        if places is not None:
            return (order, scales), places
    return None


def _placed(fitting: Fitting, sheet: Format, views: Sequence[View]) -> list[Placement] | None:
    """Place views: kinematics on the first pages, forces on the others."""
    sizes, forces = [view.size for view in views], forces_begin([view.name for view in views])
    return arrange_parts((sizes[:forces], sizes[forces:]), sheet, fitting.contents.norm)


def zoned(fitting: Fitting, sheet: Format, norm: Norm, first: Rungs) -> Zoned | None:
    """Return views, scale factors and places in zones, or None where the plan of positions has no room in its own."""
    structure = fitting.contents.solved.structure
    crowded, rungs = set[str](), dict(first)
    while True:
        built, scales = fitting.build(sheet, rungs)
        views = [view for view, _ in built]
        zones = [zone_of(view.name, structure) for view in views]
        placed, tight = _place(views, zones, structure)
        coarser: dict[str, str] = {}
        for (_, symbol), zone in zip(built, zones, strict=True):
            own = bool(symbol) and zone in tight - crowded and role(symbol).of == OWN[zone]
            if own and not fitting.is_fixed(symbol):
                coarser[symbol] = zone
        if not coarser:
            break
        for symbol, zone in coarser.items():
            rungs[symbol] += 1
            if rungs[symbol] > min(first[symbol] + PATIENCE, len(fitting.extents.ladders[symbol].values) - 1):
                rungs[symbol] = first[symbol]
                crowded.add(zone)
    return None if "positions" in tight else _with_rest(views, scales, placed, sheet, norm)


def zone_of(name: str, structure: Structure) -> str:
    """Return the zone of a view by its name, or ""."""
    if name in ("positions", "velocity", "acceleration", "diagrams"):
        return name
    if name in ("driver", "lever", f"forces_{structure.driver}"):
        return "driver"
    for group in structure.groups:
        if name in {f"{kind}_{own}" for kind in ("group", "forces", "link") for own in (group.name, *group.links)}:
            return "last" if group is structure.groups[-1] else "first"
    return ""


def _place(views: Sequence[View], zones: Sequence[str], structure: Structure) -> tuple[dict[int, Placement], set[str]]:
    """Pack each zone; tell which zones cannot take all of theirs, and take as many as go in from the first on."""
    placed: dict[int, Placement] = {}
    tight = set()
    for zone, box in _boxes(structure).items():
        own = [i for i, name in enumerate(zones) if name == zone]
        for count in range(len(own), 0, -1):
            places = pack([[views[i].size] for i in own[:count]], box, gap=GAP)
            if places is not None:
                placed |= dict(zip(own, places, strict=False))
                break
            tight.add(zone)
    return placed, tight


def _boxes(structure: Structure) -> dict[str, Box]:
    """Return the zones; those of the groups are one where there is one group."""
    if len(structure.groups) > 1:
        return ZONES
    return {zone: BOTH if zone == "last" else box for zone, box in ZONES.items() if zone != "first"}


def _with_rest(
    views: list[View], scales: Mapping[str, Scale], placed: dict[int, Placement], sheet: Format, norm: Norm
) -> Zoned | None:
    """Put what has no zone on the pages that follow."""
    rest = [i for i in range(len(views)) if i not in placed]
    places = arrange_rest([views[i] for i in rest], sheet, norm)
    if places is None:
        return None
    placed |= {i: Placement(p.page + 1, p.x, p.y, p.shape) for i, p in zip(rest, places, strict=True)}
    return views, scales, [placed[i] for i in range(len(views))]
