"""The views of a cam's sheet for a format: in the order of the work, at scale factors for which they have room."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from ...plans.cams.cam import DIAGRAMS_PART, PRESSURE_PART, PROFILE_PART, SIZES_PART
from ...plans.cams.solve import SolvedCam, reduced
from ...scales.scale import Scale
from ..contents import SheetContents
from ..figure import Figure
from ..formats import Format, room
from ..givens import givens_view
from ..rungs import Kept
from ..style import STYLES
from ..view import View
from ..words import Words
from .ladders import SYMBOLS, ladder
from .letters import lettered
from .scene import CamScene

TEXT_WIDTH = {"A1": 200.0, "A2": 175.0, "A3": 150.0, "A4": 175.0}
REDUCTIONS = (1.0, 0.8, 0.5, 0.4, 0.25, 0.2, 0.1)  # of the lengths that the task has on the diagrams
CamFigure = Figure[CamScene]
NARROW = 0.65  # part of the width of lines that those on the sizes of a cam may have


@dataclass(frozen=True, slots=True)
class Contents(SheetContents[SolvedCam]):
    """What the sheet of a cam shows."""


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


# A view is imported when its plan is wanted.


def _diagrams(contents: Contents, width: float) -> Iterator[CamFigure]:
    from .diagrams_view import DIAGRAMS_FIGURE
    from .tables import motion_table
    from .text import choices_block, scales_block

    yield Figure("givens", _givens)
    yield Figure("choices", lambda scene: choices_block(scene, contents.note, NARROW * width), ("reduction",))
    yield Figure("motion", motion_table)
    yield DIAGRAMS_FIGURE
    yield Figure("equations_scales", lambda scene: scales_block(scene, width), ("reduction",))


def _sizes(contents: Contents, width: float) -> Iterator[CamFigure]:
    from . import plate_sizes_view, rocker_sizes_view, sizes_view
    from .rocker_text import rocker_block
    from .text import plate_block, roller_block

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
    from . import pressure_view
    from .pressing import rolls

    if rolls(contents.solved):
        yield pressure_view.FIGURE
