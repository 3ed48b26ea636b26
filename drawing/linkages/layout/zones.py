"""The customary arrangement of an A1 sheet with the whole cycle: each plan in its own zone of the first page.

What has no zone, equations and tables, follows on the next pages in reading order, and so does what its zone cannot
hold.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ....plans.linkages.structure import Structure
from ....plans.names import role
from ....scales.scale import Scale
from ...compose import arrange_rest
from ...extents import Rungs
from ...formats import Format
from ...packing import Placement, pack
from ...pens import Norm
from ...text import Box
from ...view import View
from .fitting import Fitting

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
