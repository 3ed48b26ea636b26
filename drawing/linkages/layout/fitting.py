"""Scale factors that fit: for each format the first rung of every ladder at which the views have room on a page."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace

from ....plans.linkages.cycles.swept import Runs, slider_runs
from ....plans.linkages.solved import SolvedLinkage
from ....plans.names import role
from ....scales.choices import SIZES
from ....scales.choose import UNITS
from ....scales.errors import InputError
from ....scales.scale import Scale, steps
from ...extents import Extents, Rungs
from ...formats import FORMATS, STYLES, Format, printable, room
from ...view import View
from ..reading import lettered
from ..scene import Scene
from ..views import Contents, LinkageFigure, figures
from .ladders import MARKS, by_plan, extents_of, mus_of

TEXT_WIDTH = {"A1": 235.0, "A2": 190.0, "A3": 150.0, "A4": 175.0}
SURELY = 0.85  # part of the excess of a view that certainly comes from what is drawn to scale
Fitted = tuple[list[View], Mapping[str, Scale]]


class Watched(Mapping[str, Scale]):
    """Scale factors by plan that note which of them a figure has asked for."""

    def __init__(self, scales: Mapping[str, Scale]) -> None:
        self._scales = scales
        self.used: dict[str, Scale] = {}

    def __getitem__(self, plan: str) -> Scale:
        """Return the scale factor of a plan and note it."""
        scale = self._scales[plan]
        self.used[plan] = scale
        return scale

    def __iter__(self) -> Iterator[str]:
        """Go through the plans."""
        return iter(self._scales)

    def __len__(self) -> int:
        """Return the number of plans."""
        return len(self._scales)


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
        scene = self._scene(sheet, mus)
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
        watched = Watched(scene.scales)
        view = figure.draw(replace(scene, scales=watched))
        drawings.append((watched.used, view))
        return view

    def _scene(self, sheet: Format, mus: Mapping[str, float]) -> Scene:
        solved, contents = self.contents.solved, self.contents
        scales = by_plan(solved, mus)
        words = lettered(contents.words, solved)
        return Scene(solved, scales, words, STYLES[sheet.letters], contents.givens, self.runs)

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
        steps_here = (step for step in solved.program.on(plan) if step.verb in MARKS)
        # an instant centre may be anywhere: its figure says so in words where it is far
        marks = [
            solved.point(step.name) for step in steps_here if not role(step.name).hidden and role(step.name).kind != "P"
        ]
        longest = max((longest, *(abs(a - b) for a in marks for b in marks)))
    return longest
