"""The sheet of a seesaw: scheme, forces, what is given and found."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from kulman.drawing.extents import Rungs, smallest
from kulman.drawing.figure import Figure, Fitting, Found, SheetContents, SubjectScene, stages
from kulman.drawing.formats import STYLES, Format
from kulman.drawing.shapes import Line, Pen
from kulman.drawing.tables import givens_view
from kulman.drawing.view import View
from kulman.drawing.words import Words
from kulman.scales.scale import Choosers, From, Scale, steps
from kulman.tests.support.toy.plans.seesaw.solve import BALANCE, SCALES, SCHEME, SolvedSeesaw

LONGEST = {"mu_l": 120.0, "mu_F": 80.0}  # mm of paper
UNITS = {"mu_l": "m", "mu_F": "N"}


@dataclass(frozen=True, slots=True)
class SeesawScene(SubjectScene[SolvedSeesaw]):
    """A solved seesaw on a certain format; `mus` are the scale factors, SI per mm."""

    mus: Mapping[str, float] = field(default_factory=dict)


def lettered(words: Words, solved: object = None) -> Words:
    """Return the words: letters of a seesaw are those of their names."""
    return words


def ladder(solved: SolvedSeesaw, choosers: Choosers, symbol: str) -> tuple[float, ...]:
    """Return the values of a scale factor, the one wanted first."""
    ends = ("l_1", "l_2") if symbol == "mu_l" else ("F_1", "F_2")
    finest = sum(solved.size(name) for name in ends) / LONGEST[symbol]
    return tuple(choosers.get(symbol, From(steps(finest)[0])).ladder(solved.size))


def first_scales(solved: SolvedSeesaw, choosers: Choosers, plans: Sequence[str]) -> tuple[Format, dict[str, Scale]]:
    """Return the format and the scale factors by plan."""
    factors = {
        plan: Scale(symbol, ladder(solved, choosers, symbol)[0], UNITS[symbol])
        for plan, symbol in solved.scale_of_plan.items()
    }
    return smallest(2e4 for _ in plans), factors


def drawn(figure: Figure[SeesawScene], scene: SeesawScene, plan: str, parts: Mapping[str, tuple[str, ...]]) -> View:
    """Draw broken lines through marks of a plan, a stage each, with letters at their ends."""
    canvas, mu = figure.canvas(scene), scene.mus[SCALES[plan]]
    for stage, marks in parts.items():
        canvas.part(stage)
        places = [scene.solved.point(f"{plan}.{mark}") * (1.0 / mu) for mark in marks]
        for mark, start, end in zip(marks[1:], places, places[1:], strict=False):
            canvas.add(Line(start, end, Pen.MAIN, role="link", name=mark))
            canvas.label(mark, end)
    scale = Scale(SCALES[plan], mu, UNITS[SCALES[plan]])
    return canvas.finish(plan, (scene.words[f"heading.seesaw_{plan}"], scene.words.scale(scale)))


def scheme(scene: SeesawScene) -> View:
    """Draw the arms."""
    return drawn(SCHEME_FIGURE, scene, SCHEME, {"pivot": ("O",), "load": ("O", "A"), "balance": ("O", "B")})


def forces(scene: SeesawScene) -> View:
    """Draw the forces on one another."""
    return drawn(FORCES_FIGURE, scene, BALANCE, {"pole": ("p",), "first": ("p", "a"), "second": ("a", "b")})


SCHEME_FIGURE = Figure(SCHEME, scheme, ("mu_l",), stages("pivot", "load", "balance"), "seesaw.scheme")
FORCES_FIGURE = Figure(BALANCE, forces, ("mu_F",), stages("pole", "first", "second"), "seesaw.forces")


class SeesawFitting(Fitting[SolvedSeesaw, SeesawScene]):
    """Draws what the sheet of a seesaw shows."""

    first_scales = staticmethod(first_scales)

    def __init__(self, contents: SheetContents[SolvedSeesaw]) -> None:
        symbols = contents.solved.scale_of_plan.values()
        ladders = {symbol: ladder(contents.solved, contents.choosers, symbol) for symbol in symbols}
        super().__init__(contents, lettered(contents.words), ladders)

    def scene(self, sheet: Format, rungs: Rungs) -> SeesawScene:
        """Return the scene of a sheet on a format."""
        mus = {symbol: values[rungs[symbol]] for symbol, values in self.ladders.items()}
        contents = self.contents
        return SeesawScene(contents.solved, self.words, STYLES[sheet.letters], contents.givens, mus)

    def scales(self, sheet: Format, rungs: Rungs) -> dict[str, Scale]:
        """Return the scale factors of the plans as they are drawn."""
        mus, plans = self.scene(sheet, rungs).mus, self.contents.solved.scale_of_plan
        return {plan: Scale(symbol, mus[symbol], UNITS[symbol]) for plan, symbol in plans.items()}

    def on_a_page(self, sheet: Format, last: bool) -> Found | None:
        """Place everything on one page."""
        return self.placed(sheet, self.wanted)

    def figures(self, scene: SeesawScene, width: float) -> Iterator[Figure[SeesawScene]]:
        """Go through the figures of a sheet."""
        yield Figure("givens", lambda scene: givens_view(scene.givens, scene.words, scene.style))
        yield from (figure for figure in (SCHEME_FIGURE, FORCES_FIGURE) if figure.name in self.contents.plans)
