"""The sheet of a hoist: which figures it has, and how large its diagrams are drawn."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial

from ...plans.hoist.construction import BENT, SCHEME
from ...plans.hoist.hoist import BEAMS_PART, CIRCLE_PART, FORCES_PART, ROOTS_PART, SCHEME_PART
from ...plans.hoist.model import CIRCLE
from ...plans.hoist.solve import SCALES, SolvedHoist, reduced
from ...scales.scale import Choosers, From, Scale, steps
from ..compose import last
from ..extents import Rungs, smallest, visible
from ..figure import Figure, Fitting, Found, SheetContents
from ..formats import FORMATS, STYLES, Format
from .scene import UNITS, HoistScene, lettered, scale_of

PARTS = 1.0, 0.8, 0.63, 0.5, 0.4  # of the usual size of diagrams
LEAST = 1e-3  # part of the mean force that the circle is taken for at least
SPAN, ROPE, DIAMETER = 280.0, 350.0, 210.0  # mm of paper that the longer beam, the rope and the circle may take
# mm that letters, dimensions and heading add to the scheme and to the circle; mm^2 that the scheme, and both, may take
ABOUT_SCHEME, ABOUT_CIRCLE = (41.0, 91.0), 63.0
LARGEST, BOTH = 7.2e4, 1.1e5
# mm^2 of A1: of figures with their texts, and of tables that every sheet has
AREAS = {SCHEME_PART: 2e4, FORCES_PART: 1.25e5, ROOTS_PART: 9e4, CIRCLE_PART: 3e4, BEAMS_PART: 3e4}
TABLES = 4e4
HoistFigure = Figure[HoistScene]


def _ladder(solved: SolvedHoist, choosers: Choosers, symbol: str) -> tuple[float, ...]:
    """Return the values of a scale factor that may be chosen, one of `UNITS`, the one wanted first.

    Where nothing is said, scheme and circle are as large as they may be, the circle as the scheme leaves room.
    """
    span, rope = max(solved.size(f"l_{i}") for i in BENT), solved.size("L")

    def scheme(mu: float) -> float:  # mm^2
        return (span / mu + ABOUT_SCHEME[0]) * (rope / mu + ABOUT_SCHEME[1])

    if symbol == SCALES[SCHEME]:
        largest = max(span, rope)
        wanted = next(mu for mu in steps(max(span / SPAN, rope / ROPE)) if scheme(mu) <= LARGEST)
    else:
        largest = 2.0 * solved.size("R")
        left = BOTH - scheme(_ladder(solved, choosers, SCALES[SCHEME])[0])
        diameter = min(DIAMETER, max(left, BOTH - LARGEST) ** 0.5 - ABOUT_CIRCLE)
        wanted = steps(max(largest, LEAST * solved.size("P_m")) / diameter)[0]
    chooser = choosers.get(symbol, From(wanted))
    values = chooser.ladder(solved.size)
    if symbol in solved.scale_of_plan.values():
        visible(chooser, symbol, values[0], largest, UNITS[symbol])
    return values


def first_scales(solved: SolvedHoist, choosers: Choosers, plans: Sequence[str]) -> tuple[Format, dict[str, Scale]]:
    """Return the format and the scale factors by plan: those of the diagrams are known."""
    symbols = solved.scale_of_plan
    mus = {symbol: _ladder(solved, choosers, symbol)[0] for symbol in symbols.values() if symbol in UNITS}
    found = {plan: scale_of(solved, symbol, mus) for plan, symbol in symbols.items()}
    return smallest((TABLES, *(AREAS[plan] for plan in plans))), found


class HoistFitting(Fitting[SolvedHoist, HoistScene]):
    """Draws what the sheet of a hoist shows."""

    first_scales = staticmethod(first_scales)

    def __init__(self, contents: SheetContents[SolvedHoist]) -> None:
        chosen = {symbol: _ladder(contents.solved, contents.choosers, symbol) for symbol in UNITS}
        self._solved = {1.0: contents.solved}
        super().__init__(contents, lettered(contents.words, contents.solved), {**chosen, "part": PARTS})

    def scene(self, sheet: Format, rungs: Rungs) -> HoistScene:
        """Return the scene of a sheet on a format: of the hoist with diagrams as large as they are drawn."""
        part = self.part(rungs)
        if part not in self._solved:
            self._solved[part] = reduced(self.contents.solved, part)
        mus = {name: values[rungs[name]] for name, values in self.ladders.items()}
        return HoistScene(self._solved[part], self.words, STYLES[sheet.letters], self.contents.givens, mus)

    def scales(self, sheet: Format, rungs: Rungs) -> dict[str, Scale]:
        """Return the scale factors of the plans as they are drawn."""
        scene = self.scene(sheet, rungs)
        return {plan: scene.scale(SCALES[plan]) for plan in self.contents.solved.scale_of_plan}

    def part(self, rungs: Rungs) -> float:
        """Return how large diagrams are drawn, in their usual size."""
        return PARTS[rungs["part"]]

    def on_pages(self, sheet: Format) -> Found:
        """Take several pages in reading order, with scheme, circle and diagrams smaller where that spares one.

        A handout, with another frame, is drawn as the sheet is.
        """
        smaller, stated = self.lower(self.lower(self.wanted, SCALES[SCHEME]), SCALES[CIRCLE]), self.stated
        ways = (own | {"part": part} for part in range(len(PARTS)) for own in (self.wanted, smaller))
        self.stated = False
        found = min((self.in_order(FORMATS[sheet.name], rungs) for rungs in ways), key=lambda way: last(way[2]))
        if not stated:
            return found
        self.stated = True
        return self.in_order(sheet, found[0])

    def figures(self, scene: HoistScene, width: float) -> Iterator[HoistFigure]:
        """Go through the figures of a sheet in the order of the work."""
        from . import diagrams_view, scheme_view, text

        contents = self.contents
        layout, plans = contents.solved.layout, contents.plans
        yield Figure("givens", partial(text.data_table, stated=self.stated))
        if SCHEME_PART in plans:
            yield from (scheme_view.SCHEME_FIGURE, scheme_view.MODEL)
        yield Figure("results", text.results_table)
        if FORCES_PART in plans:
            yield diagrams_view.FORCES_FIGURE
        if ROOTS_PART in plans and layout.roots is not None:
            yield diagrams_view.LIFT_OFF_FIGURE
            if layout.roots.waves:
                yield diagrams_view.EXTREMES_FIGURE
        if CIRCLE_PART in plans:
            yield diagrams_view.CIRCLE_FIGURE
        if BEAMS_PART in plans and layout.bent:
            yield scheme_view.BEAMS_FIGURE
        if FORCES_PART in plans:
            yield Figure("strength", text.strength_block)
            yield Figure("checks", text.checks_table)
            yield Figure("flow", scheme_view.flow_view)
        yield Figure("scales", text.scales_table, ("mu_l", "mu_F_circle", "part"))
