"""The sheet of a hoist: the smallest format of which one sheet holds everything, or several pages of a given one."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from ...plans.hoist.hoist import BEAMS_PART, CIRCLE_PART, FORCES_PART, ROOTS_PART, SCHEME_PART
from ...plans.hoist.solve import SCALES, SolvedHoist, reduced
from ...scales.scale import Scale
from ..compose import Drawn, arrange, arrange_closely, compose
from ..contents import SheetContents
from ..extents import from_format
from ..figure import Figure
from ..formats import Format
from ..rungs import Kept, fitted, on_pages
from ..style import STYLES
from ..table import note_block, text_block
from ..view import View
from ..words import Words
from .ladders import UNITS, first_scales, ladder
from .scene import HoistScene, lettered

TEXT_WIDTH = 120.0
PARTS = 1.0, 0.8, 0.63, 0.5, 0.4  # of the usual size of diagrams
HoistFigure = Figure[HoistScene]
Contents = SheetContents[SolvedHoist]


@dataclass(frozen=True, slots=True)
class Rungs:
    """How small things are drawn: the scheme, the circle, the diagrams; each a rung."""

    mu_l: int = 0
    mu_F_circle: int = 0
    part: int = 0


@dataclass(slots=True)
class Fitting:
    """Draws the figures of `contents` for any format, each only once."""

    contents: Contents
    ladders: Mapping[str, tuple[float, ...]] = field(init=False)
    _words: Words = field(init=False)
    _kept: Kept[HoistScene] = field(default_factory=Kept)
    _solved: dict[float, SolvedHoist] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Find the ladders."""
        contents, roots = self.contents, self.contents.solved.layout.roots
        self._words = lettered(contents.words, len(roots.times) if roots else 0)
        chosen = {symbol: ladder(contents.solved, contents.choosers, symbol) for symbol in UNITS}
        self.ladders = {**chosen, "part": PARTS}

    def scene(self, sheet: Format, rungs: Rungs) -> HoistScene:
        """Return the scene of a sheet on a format."""
        contents = self.contents
        mus = {name: values[getattr(rungs, name)] for name, values in self.ladders.items()}
        return HoistScene(self.solved(rungs), self._words, STYLES[sheet.letters], contents.givens, mus)

    def solved(self, rungs: Rungs) -> SolvedHoist:
        """Return the hoist with diagrams as large as they are drawn."""
        part = PARTS[rungs.part]
        if part not in self._solved:
            whole = self.contents.solved
            self._solved[part] = whole if part == 1.0 else reduced(whole, part)
        return self._solved[part]

    def views(self, sheet: Format, rungs: Rungs) -> list[tuple[View, HoistFigure]]:
        """Return the views of a sheet in the order of the work."""
        scene, wanted = self.scene(sheet, rungs), figures(self.contents)
        return [(self._kept.view(scene, sheet, rungs, figure), figure) for figure in wanted]

    def scales(self, sheet: Format, rungs: Rungs) -> dict[str, Scale]:
        """Return the scale factors of the plans as they are drawn."""
        scene = self.scene(sheet, rungs)
        return {plan: scene.scale(SCALES[plan]) for plan in self.contents.solved.scale_of_plan}


def figures(contents: Contents) -> Iterator[HoistFigure]:
    """Go through the figures of a sheet in the order of the work."""
    from .tables import checks_table, data_table, results_table, scales_table

    layout, plans = contents.solved.layout, contents.plans
    yield Figure("givens", data_table)
    if contents.note:
        yield Figure("note", lambda scene: note_block(scene.words, contents.note, scene.style, TEXT_WIDTH))
    if SCHEME_PART in plans:
        from .scheme_view import MODEL, SCHEME_FIGURE

        yield SCHEME_FIGURE
        yield MODEL
    yield Figure("results", results_table)
    if FORCES_PART in plans:
        from .forces_view import FORCES_FIGURE

        yield FORCES_FIGURE
    if ROOTS_PART in plans and layout.roots is not None:
        from .roots_view import EXTREMES_FIGURE, LIFT_OFF_FIGURE

        yield LIFT_OFF_FIGURE
        if layout.roots.waves:
            yield EXTREMES_FIGURE
    if CIRCLE_PART in plans:
        from .circle_view import CIRCLE_FIGURE

        yield CIRCLE_FIGURE
    if BEAMS_PART in plans and layout.bent:
        from .beams_view import BEAMS

        yield BEAMS
    if FORCES_PART in plans:
        from .flow_view import flow_view

        yield Figure("strength", strength_block)
        yield Figure("checks", checks_table)
        yield Figure("flow", flow_view)
    yield Figure("scales", scales_table, ("mu_l", "mu_F_circle", "part"))


def strength_block(scene: HoistScene) -> View:
    """Return the check of strength."""
    from .tables import strength_lines

    return text_block("strength", scene.words["heading.hoist_safety"], strength_lines(scene), scene.style, TEXT_WIDTH)


def draw(contents: Contents, sheet: Format | None = None) -> Drawn:
    """Draw the sheet on `sheet`, or on the smallest format of which one sheet holds everything.

    Raises
    ------
    InputError
        When a view has no room on a page of the format.
    """
    fitting, norm = Fitting(contents), contents.norm
    usual, _ = first_scales(contents.solved, contents.choosers, contents.plans)
    formats = [sheet] if sheet else from_format(usual)
    rungs, places = Rungs(), None
    for candidate in formats:
        views = [view for view, _ in fitting.views(candidate, rungs)]
        places = arrange([view.size for view in views], candidate, norm, 1, any_order=True)
        if places is not None:
            break
    if places is None:
        rungs = fitted(fitting, candidate, norm, rungs)
        views = [view for view, _ in fitting.views(candidate, rungs)]
        ways = on_pages(views, candidate, norm), arrange_closely([view.size for view in views], candidate, norm)
        places = min(filter(None, ways), key=lambda found: max(place.page for place in found))
    return compose(views, places, fitting.scales(candidate, rungs), candidate, norm, PARTS[rungs.part])
