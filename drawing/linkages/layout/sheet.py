"""The sheet of a linkage: on one page of the format that follows from its extents, or on several of it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

from ....plans.linkages.cycles.limits import Runs, slider_runs
from ....plans.linkages.solved import SolvedLinkage
from ....plans.linkages.structure import Structure
from ....plans.names import role
from ....scales.choices import SIZES
from ....scales.choose import UNITS
from ....scales.errors import InputError
from ....scales.scale import Scale, steps
from ...compose import Drawn, arrange, arrange_halves, arrange_parts, arrange_rest, compose
from ...extents import Extents, Rungs, from_format
from ...formats import FORMATS, STYLES, Format, printable, room
from ...packing import Placement, pack
from ...text import Box
from ...view import View
from ..reading import lettered
from ..scene import Scales, Scene
from ..views import Contents, LinkageFigure, figures
from .ladders import by_plan, chosen, extents_of, marks_on, mus_of

# views with which the part of the forces begins
OF_FORCES = ("load_", "equations_forces_loads", "group_", "driver", "lever")

Found = tuple[list[View], Mapping[str, Scale], list[Placement]]
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
OWN = {"positions": "l", "velocity": "V", "acceleration": "a", "last": "F", "first": "F", "driver": "F"}
BOTH = (295.0, 12.0, 645.0, 325.0)  # of a mechanism with one group
GAP = 5.0
PATIENCE = 5  # rungs by which a scale factor may become coarser for the sake of its zone
TEXT_WIDTH = {"A1": 235.0, "A2": 190.0, "A3": 150.0, "A4": 175.0}
SURELY = 0.85  # part of the excess of a view that certainly comes from what is drawn to scale
Fitted = tuple[list[View], Mapping[str, Scale]]


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
    found, candidate = None, FORMATS["A1"]
    if contents.cycle is not None and {"velocity", "acceleration"} <= {*contents.plans} and sheet in (None, candidate):
        found = zoned(fitting, candidate, rungs)
    if found is None:
        formats = [sheet] if sheet is not None else from_format(usual)
        for candidate in formats:
            found = _single(fitting, candidate, rungs, candidate is formats[-1])
            if found is not None:
                break
    found = found or _roomy(fitting, candidate, rungs) or _reordered(fitting, candidate, rungs)
    if found is None:
        raise InputError("sheet-too-small", format=candidate.name)
    views, scales, places = found
    return compose(views, places, scales, candidate, contents.norm)


def _single(fitting: Fitting, sheet: Format, rungs: Rungs, last: bool) -> Found | None:
    """Try one page: in reading order, with kinematics on the left and forces on the right, at last in any order."""
    try:
        (views, scales), taken = fitting.fitted(sheet, rungs)
    except InputError:
        if last:
            raise
        return None
    if taken != rungs and not last:
        return None  # a larger format may hold them
    sizes, norm = [view.size for view in views], fitting.contents.norm
    places = arrange(sizes, sheet, norm, 1)
    if places is None:
        places = arrange_halves(sizes, forces_begin(views), sheet, norm)
    if places is None:
        places = arrange(sizes, sheet, norm, 1, any_order=True)
    return None if places is None else (views, scales, places)


def forces_begin(views: Sequence[View]) -> int:
    """Return how many views come before the part of the forces."""
    return next((i for i, view in enumerate(views) if view.name.startswith(OF_FORCES)), len(views))


def _roomy(fitting: Fitting, sheet: Format, rungs: Rungs) -> Found | None:
    """Place the views on several pages in reading order, the larger ones smaller if the first cannot hold them."""
    for first in (False, True):
        try:
            (views, scales), taken = fitting.fitted(sheet, rungs, first)
        except InputError:
            if not first:
                raise
            return None
        if first and any(taken[symbol] > rung for symbol, rung in rungs.items() if fitting.is_fixed(symbol)):
            return None
        places = _placed(fitting, sheet, views)
        if places is not None:
            return views, scales, places
    return None


def _reordered(fitting: Fitting, sheet: Format, rungs: Rungs) -> Found | None:
    """Begin with the first view that the first page can hold: a text, where a fixed plan is too large for it."""
    (views, scales), _ = fitting.fitted(sheet, rungs)
    wide, high = room(sheet, fitting.contents.norm, first=True)
    fit = [i for i, view in enumerate(views) if view.size[0] <= wide and view.size[1] <= high]
    for i in fit[:1]:
        order = [views[i], *views[:i], *views[i + 1 :]]
        places = _placed(fitting, sheet, order)
        if places is not None:
            return order, scales, places
    return None


def _placed(fitting: Fitting, sheet: Format, views: Sequence[View]) -> list[Placement] | None:
    """Place views: kinematics on the first pages, forces on the others."""
    sizes, forces = [view.size for view in views], forces_begin(views)
    return arrange_parts((sizes[:forces], sizes[forces:]), sheet, fitting.contents.norm)


def zoned(fitting: Fitting, sheet: Format, first: Rungs) -> Found | None:
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
    rest = [i for i in range(len(views)) if i not in placed]  # what has no zone is put on the pages that follow
    places = None if "positions" in tight else arrange_rest([views[i] for i in rest], sheet, fitting.contents.norm)
    if places is None:
        return None
    placed |= {i: Placement(p.page + 1, p.x, p.y) for i, p in zip(rest, places, strict=True)}
    return views, scales, [placed[i] for i in range(len(views))]


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
    """Pack each zone; tell which zones cannot take all of theirs, and take as many as go in from the first on.

    The zones of the groups are one where there is one group.
    """
    placed: dict[int, Placement] = {}
    tight = set()
    boxes = ZONES if len(structure.groups) > 1 else {**ZONES, "first": BOTH, "last": BOTH}
    for zone, box in boxes.items():
        own = [i for i, name in enumerate(zones) if name == zone]
        for count in range(len(own), 0, -1):
            places = pack([views[i].size for i in own[:count]], box, gap=GAP)
            if places is not None:
                placed |= dict(zip(own, places, strict=False))
                break
            tight.add(zone)
    return placed, tight


@dataclass(slots=True)
class Fitting:
    """Builds the views of `contents` for any format, each only once."""

    contents: Contents
    extents: Extents = field(init=False)
    runs: Runs = field(init=False)
    _drawings: dict[tuple[str, str], list[tuple[dict[str, Scale], View]]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Find what figures take up, the ladders among it, and how long guides are."""
        contents = self.contents
        self.runs = slider_runs(contents.solved)
        self.extents = extents_of(contents.solved, contents.choosers, contents.plans)

    def is_fixed(self, symbol: str) -> bool:
        """Whether the task or the user has fixed a scale factor."""
        return self.extents.ladders[symbol].fixed

    def fitted(self, sheet: Format, rungs: Rungs, first: bool = False) -> tuple[Fitted, Rungs]:
        """Return views, scale factors and rungs for pages of `sheet`: these rungs, coarser ones where they must be.

        What is fixed, too, becomes coarser only where a page cannot hold it alone. With `first` all have room even on
        the first page.

        Raises
        ------
        InputError
            When a view has no room on a page even at the last rung.
        """
        norm = self.contents.norm
        own, printed = room(sheet, norm, first), room(printable(sheet), norm, first)
        rooms = {  # what may be coarser is so on any printer: a handout has the scale factors of the sheet
            symbol: own if ladder.fixed else (min(own[0], printed[0]), min(own[1], printed[1]))
            for symbol, ladder in self.extents.ladders.items()
        }
        rungs = dict(rungs)
        while True:
            built, scales = self.build(sheet, rungs)
            sized = [(s, view, max(view.size[0] / rooms[s][0], view.size[1] / rooms[s][1])) for view, s in built if s]
            too_large = {symbol: (view, excess) for symbol, view, excess in sized if excess > 1.0}
            if not too_large:
                return ([view for view, _ in built], scales), rungs
            for symbol, (view, excess) in too_large.items():
                rungs[symbol] = self._next(symbol, rungs[symbol], excess)
                if rungs[symbol] >= len(self.extents.ladders[symbol].values):
                    raise self._does_not_fit(sheet, symbol, view.size)

    def _next(self, symbol: str, rung: int, excess: float) -> int:
        """Return the next rung worth drawing for a view that is `excess` times as large as its room.

        Letters keep their size, so that a view shrinks by less than its scale factor grows; even if they find better
        places, so far off no rung fits. Where none can be right, the last one shows how far off it is.
        """
        ladder = self.extents.ladders[symbol].values
        wanted = ladder[rung] * excess * SURELY
        return next((k for k in range(rung + 1, len(ladder)) if ladder[k] >= wanted), max(rung + 1, len(ladder) - 1))

    def build(self, sheet: Format, rungs: Rungs) -> tuple[list[tuple[View, str]], Mapping[str, Scale]]:
        """Draw all figures with the scale factors on these rungs; each with the ladder that sizes it, or ""."""
        contents = self.contents
        text_width = min(TEXT_WIDTH[sheet.letters], room(sheet, contents.norm)[0])
        mus = mus_of(self.extents, rungs)
        words, style = lettered(contents.words, contents.solved), STYLES[sheet.letters]
        scene = Scene(contents.solved, words, style, contents.givens, by_plan(contents.solved, mus), self.runs)
        built = []
        for figure in figures(contents, text_width):
            # of two scale factors the one with the longer lines makes the figure as large as it is
            symbol = max(figure.ladders, key=lambda s: _reach(contents.solved, s) / mus[s], default="")
            built.append((self._drawn(sheet, figure, scene), self.extents.root(symbol)))
        return built, scene.scales

    def _drawn(self, sheet: Format, figure: LinkageFigure, scene: Scene) -> View:
        """Draw a figure, unless it has been drawn for this format at the same of the scale factors that it used."""
        drawings = self._drawings.setdefault((sheet.name, figure.name), [])
        for used, view in drawings:
            if all(scene.scales[plan] == scale for plan, scale in used.items()):
                return view
        watched = Scales(scene.scales)
        view = figure.draw(replace(scene, scales=watched))
        drawings.append((watched.used, view))
        return view

    def _does_not_fit(self, sheet: Format, symbol: str, size: tuple[float, float]) -> InputError:
        """Say which format, or which scale factor, would do."""
        norm, mu = self.contents.norm, self.extents.ladders[symbol].values[-1]
        width, height = room(sheet, norm)
        excess = max(size[0] / width, size[1] / height)
        rooms = {name: room(FORMATS[name], norm) for name in SIZES}
        larger = [name for name, (w, h) in rooms.items() if w >= size[0] and h >= size[1]]
        return InputError(
            "plan-too-large" if larger else "plan-too-large-everywhere",
            symbol=symbol,
            mu=f"{mu:g}",
            unit=Scale(symbol, mu, UNITS[role(symbol).of]).per_mm_unit,
            format=sheet.name,
            fits=f"{steps(mu * excess * 1.1)[0]:g}",
            larger=larger[0] if larger else "",
        )


def _reach(solved: SolvedLinkage, symbol: str) -> float:
    """Return the longest distance between marks of the plans that a scale factor sizes, in its own unit."""
    longest = 0.0
    for plan in (plan for plan, name in solved.scale_of_plan.items() if name == symbol):
        marks = marks_on(solved, plan)
        longest = max((longest, *(abs(a - b) for a in marks for b in marks)))
    return longest
