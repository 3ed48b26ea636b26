"""The views of a gear pair's sheet for a format, in the order of the work, at scale factors that have room."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import partial

from ...plans.gears.gear import GEOMETRY_PART, MESHING_PART, SLIDING_PART
from ...plans.gears.sliding_plan import SLIDING, THETA
from ...plans.gears.solve import SolvedGear
from ...scales.scale import Scale
from ..contents import SheetContents
from ..figure import Figure
from ..formats import Format, room
from ..rungs import Kept
from ..style import STYLES
from ..table import note_block
from ..view import View
from ..words import Words
from .ladders import mu_ladder, near_ladder, parts_of, rolled_ladder
from .letters import lettered
from .scene import MESHING, GearScene

TEXT_WIDTH = {"A1": 200.0, "A2": 175.0, "A3": 150.0, "A4": 175.0}
GearFigure = Figure[GearScene]


@dataclass(frozen=True, slots=True)
class Contents(SheetContents[SolvedGear]):
    """What the sheet of a gear pair shows."""


@dataclass(frozen=True, slots=True)
class Rungs:
    """How small things are drawn: the meshing, its middle apart, the involutes, diagrams of sliding; each a rung."""

    mu_l: int = 0
    near: int = 0
    rolled: int = 0
    part: int = 0


@dataclass(slots=True)
class Fitting:
    """Draws the figures of `contents` for any format, each only once."""

    contents: Contents
    ladders: Mapping[str, tuple[float, ...]] = field(init=False)
    _words: Words = field(init=False)
    _kept: Kept[GearScene] = field(default_factory=Kept)

    def __post_init__(self) -> None:
        """Find the ladders."""
        self._words = lettered(self.contents.words)
        solved = self.contents.solved
        self.ladders = {
            "mu_l": mu_ladder(solved, self.contents.choosers),
            "near": near_ladder(solved),
            "rolled": rolled_ladder(solved),
            "part": parts_of(self.contents.plans),
        }

    def scene(self, sheet: Format, rungs: Rungs) -> GearScene:
        """Return the scene of a sheet on a format."""
        mus = {name: self.ladders[name][getattr(rungs, name)] for name in self.ladders}
        contents, style = self.contents, STYLES[sheet.letters]
        return GearScene(contents.solved, self._words, style, contents.givens, **mus)

    def views(self, sheet: Format, rungs: Rungs) -> list[tuple[View, GearFigure]]:
        """Return the views of a sheet in the order of the work."""
        scene = self.scene(sheet, rungs)
        width = min(TEXT_WIDTH[sheet.letters], room(sheet, self.contents.norm)[0])
        return [
            (self._kept.view(scene, sheet, rungs, figure, figure.name == MESHING and scene.apart), figure)
            for figure in figures(self.contents, scene, width)
        ]

    def least(self, sheet: Format) -> Rungs:
        """Return the first rungs at which the lines that size the views have room, before any view is drawn."""
        wide, high = room(sheet, self.contents.norm)
        sizes = self.contents.solved.sizes
        lines = {"mu_l": (sizes["a_w"], high), "near": (2.0 * sizes["p"], wide), "rolled": (sizes["l_N1N2"], wide)}
        rungs = {
            name: next((k for k, mu in enumerate(self.ladders[name]) if length / mu < most), 0)
            for name, (length, most) in lines.items()
        }
        return Rungs(**rungs)

    def scales(self, sheet: Format, rungs: Rungs) -> dict[str, Scale]:
        """Return the scale factors of the plans as they are drawn."""
        from .sliding_view import rho_scale
        from .theta_diagram import theta_scale

        scene = self.scene(sheet, rungs)
        made: dict[str, Callable[[GearScene], Scale]] = {
            MESHING: lambda scene: Scale("mu_l", scene.mu_l, "m"),
            SLIDING: rho_scale,
            THETA: theta_scale,
        }
        return {plan: made[plan](scene) for plan in self.contents.solved.scale_of_plan}


def figures(contents: Contents, scene: GearScene, width: float) -> Iterator[GearFigure]:
    """Go through the figures of a sheet in the order of the work; lines of text are at most `width` long."""
    made: tuple[tuple[str, Callable[[], Iterator[GearFigure]]], ...] = (
        (GEOMETRY_PART, _data),
        (MESHING_PART, partial(_meshing, scene.apart)),
        (GEOMETRY_PART, partial(_quality, width)),
        (SLIDING_PART, _sliding),
    )
    if contents.note:
        yield Figure("note", lambda scene: note_block(scene.words, contents.note, scene.style, width))
    for part, figures_of in made:
        if part in contents.plans:
            yield from figures_of()


# A view is imported when its plan is wanted.


def _data() -> Iterator[GearFigure]:
    from .tables import data_table

    yield Figure("data", data_table)


def _meshing(apart: bool) -> Iterator[GearFigure]:
    from . import action_view, meshing_view, rolling_view

    yield meshing_view.FIGURE
    if apart:
        yield meshing_view.NEAR
    yield rolling_view.FIGURE
    yield action_view.FIGURE


def _quality(width: float) -> Iterator[GearFigure]:
    from .contour_view import contour_view
    from .rack_view import rack_view
    from .tables import checks_table
    from .text import auxiliary_block, quality_block, sizes_block

    yield Figure("checks", checks_table)
    yield Figure("contour", contour_view)
    yield Figure("rack", rack_view, ("near",))
    for name, block in (("sizes", sizes_block), ("auxiliary", auxiliary_block), ("quality", quality_block)):
        yield Figure(f"equations_{name}", partial(block, width=width))


def _sliding() -> Iterator[GearFigure]:
    from . import sliding_view
    from .tables import points_table

    yield sliding_view.FIGURE
    yield Figure("points", points_table)
