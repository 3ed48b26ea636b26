"""The sheet of a cam: the smallest format of which one sheet holds everything, or several pages of a given one."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from itertools import product

from ...plans.cams.cam import DIAGRAMS_PART, PRESSURE_PART, PROFILE_PART, SIZES_PART
from ...plans.cams.solve import EQUAL, SolvedCam, reduced
from ...scales.choose import Fixed
from ...scales.errors import InputError
from ...scales.scale import Scale
from ..compose import Drawn, arrange, arrange_closely, compose
from ..contents import SheetContents
from ..extents import from_format
from ..figure import Figure
from ..formats import Format, room
from ..givens import givens_view
from ..nesting import column, row
from ..packing import Placement
from ..rungs import Kept, fitted
from ..style import STYLES
from ..view import View
from ..words import Words
from ..zones import BLOCK, TURNED, zoned
from .ladders import SYMBOLS, first_scales, ladder, size_of
from .scene import CamScene, lettered

# what may be drawn smaller for the sake of one page, and by how many rungs
GIVING = {"mu_l": 2, "reduction": 2, "mu_s_ds": 2, "mu_s_d2s": 2}
# mm of the least radius and the stroke on a plan, so that it can be read: on S over ds/dphi more numbers stand closely
LEGIBLE = {"mu_s_ds": 60.0, "mu_s_d2s": 50.0}
Found = tuple["Rungs", list[View], list[Placement]]
TEXT_WIDTH = {"A1": 200.0, "A2": 175.0, "A3": 150.0, "A4": 175.0}
REDUCTIONS = (1.0, 0.8, 0.5, 0.4, 0.25, 0.2, 0.1)  # of the lengths that the task has on the diagrams
CamFigure = Figure[CamScene]
Contents = SheetContents[SolvedCam]
NARROW = 0.65  # part of the width of lines that those on the sizes of a cam may have
LAYOUT = row(
    column(TURNED, "diagrams", "equations_plate"),
    column(
        row("profile", "plate_profile", "sizes"),
        row(
            column("motion", "equations_roller"),
            column("givens", "choices", "pressure"),
            column("plate_sizes", "equations_scales", BLOCK),
        ),
    ),
)
ROCKER_LAYOUT = row(
    column(TURNED, "diagrams"),
    column("profile", row("motion", column("givens", "choices"))),
    column("rocker_sizes", "equations_rocker", "pressure", "equations_scales", BLOCK),
)
LAYOUTS = LAYOUT, ROCKER_LAYOUT


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


@dataclass(frozen=True, slots=True)
class Rungs:
    """How small things are drawn: the diagrams, the plans made of two of them, the profiles; each a rung."""

    reduction: int = 0
    mu_s_ds: int = 0
    mu_s_d2s: int = 0
    mu_l: int = 0


@dataclass(slots=True)
class Fitting:
    """Draws the figures of `contents` for any format, each only once."""

    contents: Contents
    ladders: Mapping[str, tuple[float, ...]] = field(init=False)
    _words: Words = field(init=False)
    _kept: Kept[CamScene] = field(default_factory=Kept)
    _scenes: dict[tuple[str, Rungs], CamScene] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Find the ladders."""
        self._words = lettered(self.contents.words)
        self.ladders = {"reduction": REDUCTIONS, **self._chosen(self.contents.solved)}

    def _chosen(self, solved: SolvedCam) -> dict[str, tuple[float, ...]]:
        return {symbol: ladder(solved, self.contents.choosers, symbol) for symbol in SYMBOLS}

    def scene(self, sheet: Format, rungs: Rungs) -> CamScene:
        """Return the scene of a sheet on a format: of the construction with lengths as they are drawn there."""
        key = sheet.letters, rungs
        if key not in self._scenes:
            part = self.reduction(rungs)
            solved = reduced(self.contents.solved, part)
            # coarser diagrams leave no fewer rungs to the plans made of them
            mus = {symbol: mus[getattr(rungs, symbol)] for symbol, mus in self._chosen(solved).items()}
            self._scenes[key] = CamScene(solved, self._words, STYLES[sheet.letters], self.contents.givens, mus, part)
        return self._scenes[key]

    def reduction(self, rungs: Rungs) -> float:
        """Return what a millimetre of the task's diagrams is on the sheet."""
        return self.ladders["reduction"][rungs.reduction]

    def views(self, sheet: Format, rungs: Rungs) -> list[tuple[View, CamFigure]]:
        """Return the views of a sheet in the order of the work."""
        scene = self.scene(sheet, rungs)
        width = min(TEXT_WIDTH[sheet.letters], room(sheet, self.contents.norm)[0])
        wanted = figures(self.contents, width)
        return [(self._kept.view(scene, sheet, rungs, figure), figure) for figure in wanted]

    def scales(self, sheet: Format, rungs: Rungs) -> dict[str, Scale]:
        """Return the scale factors of the plans as they are drawn."""
        scene = self.scene(sheet, rungs)
        return {plan: scene.scale(plan) for plan in self.contents.solved.scale_of_plan}


def figures(contents: Contents, width: float) -> list[CamFigure]:
    """Return the figures of a sheet in the order of the work; lines of text are at most `width` long."""
    made = {DIAGRAMS_PART: _diagrams, SIZES_PART: _sizes, PROFILE_PART: _profiles, PRESSURE_PART: _pressure}
    return [figure for plan in contents.plans for figure in made[plan](contents, width)]


def _givens(scene: CamScene) -> View:
    numbers = {name: given for name, given in scene.givens.items() if not isinstance(given.value, str)}
    return givens_view(numbers, scene.words, scene.style)


def _diagrams(contents: Contents, width: float) -> Iterator[CamFigure]:
    from .diagrams_view import DIAGRAMS_FIGURE
    from .text import choices_block, motion_table, scales_block

    yield Figure("givens", _givens)
    yield Figure("choices", lambda scene: choices_block(scene, contents.note, NARROW * width), ("reduction",))
    yield Figure("motion", motion_table)
    yield DIAGRAMS_FIGURE
    yield Figure("equations_scales", lambda scene: scales_block(scene, width), ("reduction",))


def _sizes(contents: Contents, width: float) -> Iterator[CamFigure]:
    from . import plate_sizes_view, rocker_sizes_view, sizes_view
    from .text import plate_block, rocker_block, roller_block

    if contents.solved.roller is not None:
        yield sizes_view.FIGURE
        yield Figure("equations_roller", lambda scene: roller_block(scene, NARROW * width))
    if contents.solved.rocker is not None:
        yield rocker_sizes_view.FIGURE
        yield Figure("equations_rocker", lambda scene: rocker_block(scene, NARROW * width))
    if contents.solved.plate is not None:
        yield plate_sizes_view.FIGURE
        yield Figure("equations_plate", lambda scene: plate_block(scene, width))


def _profiles(contents: Contents, width: float) -> Iterator[CamFigure]:
    from . import plate_view, rocker_view, roller_view

    if contents.solved.roller is not None:
        yield roller_view.FIGURE
    if contents.solved.rocker is not None:
        yield rocker_view.FIGURE
    if contents.solved.plate is not None:
        yield plate_view.FIGURE


def _pressure(contents: Contents, width: float) -> Iterator[CamFigure]:
    from ...plans.cams.dense import rolls
    from . import pressure_view

    if rolls(contents.solved):
        yield pressure_view.FIGURE
