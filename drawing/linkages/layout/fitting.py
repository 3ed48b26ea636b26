"""Scale factors that fit: for each format the first rung of every ladder at which the views have room on a page."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from ....plans.linkages.cycles.slider_runs import Runs, slider_runs
from ....plans.linkages.solved import SolvedLinkage
from ....scales.choices import SIZES
from ....scales.choose import UNITS, CrankScale, Fixed
from ....scales.errors import InputError
from ....scales.scale import Scale, steps
from ...compose import room
from ...contents import SheetContents
from ...formats import FORMATS, Format
from ...style import STYLES
from ...view import View
from ..letters import lettered
from ..scene import Scene
from ..views import Figure, figures, noted
from .ladders import Ladders, by_plan, finer_of, ladders_of

if TYPE_CHECKING:
    from ....plans.linkages.cycles.cycle import Cycle

TEXT_WIDTH = {"A1": 235.0, "A2": 190.0, "A3": 150.0, "A4": 175.0}
SURELY = 0.85  # part of the excess of a view that certainly comes from what is drawn to scale
FORCES_ONLY = 3
# mm below which no plan is made smaller for want of room, by format, and how many times that by kind of plan
LEAST = {"A1": 60.0, "A2": 60.0, "A3": 45.0, "A4": 40.0}
LARGER = {"l": 2.5, "V": 1.3, "a": 1.3, "F": 1.0}
MARKS = ("place", "pole", "lay", "back", "chain", "meet", "arc", "divide", "same")
Fitted = tuple[list[View], Mapping[str, Scale]]


@dataclass(frozen=True, slots=True)
class Contents(SheetContents[SolvedLinkage]):
    """What the sheet of a linkage shows; its whole cycle, too, where that is wanted."""

    cycle: Cycle | None = None


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
    ladders: Ladders = field(init=False)
    finer: Ladders = field(init=False)
    runs: Runs = field(init=False)
    _root: dict[str, str] = field(init=False)
    _built: dict[tuple[str, int, bool], tuple[Fitted, dict[str, int]]] = field(default_factory=dict)
    _drawings: dict[tuple[str, int], list[tuple[dict[str, Scale], View]]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Find the ladders and how long guides are; a crank scale stands on the rung of mu_l."""
        self.runs = slider_runs(self.contents.solved)
        choosers = self.contents.choosers
        self.ladders = ladders_of(self.contents.solved, choosers)
        self.finer = finer_of(self.ladders, choosers)
        self._root = {s: "mu_l" if isinstance(choosers.get(s), CrankScale) else s for s in self.ladders}

    def is_fixed(self, symbol: str) -> bool:
        """Whether the task or the user has fixed a scale factor: several pages are better than a coarser one."""
        chooser = self.contents.choosers.get(symbol)
        return isinstance(chooser, Fixed) or (chooser is not None and chooser.firm)

    def keeps(self, scales: Mapping[str, Scale]) -> bool:
        """Whether all fixed scale factors are among these as they were fixed."""
        return all(s.mu == self.ladders[s.symbol][0] for s in scales.values() if self.is_fixed(s.symbol))

    def views(self, sheet: Format, step: int = 0) -> Fitted:
        """Return views and scale factors as `fitted` does."""
        return self.fitted(sheet, step)[0]

    def fitted(self, sheet: Format, step: int = 0, first: bool = False) -> tuple[Fitted, dict[str, int]]:
        """Return views, scale factors and rungs for pages of `sheet`, force plans `step` rungs or more coarser.

        After `FORCES_ONLY` steps the other plans follow, too: a student sooner shrinks forces than pa or OA. What is
        fixed becomes coarser only where a page cannot hold it alone. With `first` all have room even on the first page.

        Raises
        ------
        InputError
            When a view has no room on a page even at the last rung.
        """
        key = sheet.name, step, first
        if key not in self._built:
            self._built[key] = self._fitted(sheet, step, first)
        return self._built[key]

    def _fitted(self, sheet: Format, step: int, first: bool) -> tuple[Fitted, dict[str, int]]:
        width, height = room(sheet, self.contents.norm, first)
        rungs = self.rungs(sheet, step)
        while True:
            built, scales = self.build(sheet, rungs)
            too_large = {s: view for view, s in built if s and (view.size[0] > width or view.size[1] > height)}
            if not too_large:
                return ([view for view, _ in built], scales), rungs
            for symbol, view in too_large.items():
                excess = max(view.size[0] / width, view.size[1] / height)
                rungs[symbol] = self._next(symbol, rungs[symbol], excess)
                if rungs[symbol] >= len(self.ladders[symbol]):
                    raise self._does_not_fit(sheet, symbol, view.size)

    def _next(self, symbol: str, rung: int, excess: float) -> int:
        """Return the next rung worth drawing for a view that is `excess` times as large as its room.

        Letters keep their size, so that a view shrinks by less than its scale factor grows; even if they find better
        places, so far off no rung fits.
        """
        ladder, wanted = self.ladders[symbol], self.mu(symbol, rung) * excess * SURELY
        return next((k for k in range(rung + 1, len(ladder)) if ladder[k] >= wanted), rung + 1)

    def rungs(self, sheet: Format, step: int) -> dict[str, int]:
        """Return the first rung of every ladder at which the marks alone have room."""
        return {s: self._rung(s, step, sheet) for s, root in self._root.items() if root == s}

    def build(self, sheet: Format, rungs: Mapping[str, int]) -> tuple[list[tuple[View, str]], Mapping[str, Scale]]:
        """Draw all figures with the scale factors on these rungs; each with the ladder that sizes it, or ""."""
        contents, root = self.contents, self._root
        text_width = min(TEXT_WIDTH[sheet.letters], room(sheet, contents.norm)[0])
        mus = {s: self.mu(s, rungs[root[s]]) for s in self.ladders}
        scene = self._scene(sheet, mus)
        built = []
        wanted = [*noted(contents.note, text_width)]
        wanted += figures(contents.solved, contents.plans, text_width, contents.cycle)
        for number, figure in enumerate(wanted):
            view = self._drawn(sheet, number, figure, scene)
            built.append((view, root.get(self._sizing(figure, mus), "")))
        return built, scene.scales

    def mu(self, symbol: str, rung: int) -> float:
        """Return a scale factor on a rung; those below 0 are finer than the wanted one, where there are such."""
        finer = self.finer[symbol]
        return self.ladders[symbol][max(rung, 0)] if rung >= 0 or not finer else finer[min(-rung, len(finer)) - 1]

    def _sizing(self, figure: Figure, mus: Mapping[str, float]) -> str:
        """Return the scale factor that makes a figure as large as it is: of two the one with the longer lines."""
        if not figure.beside:
            return figure.symbol
        return max((figure.symbol, figure.beside), key=lambda s: _reach(self.contents.solved, s) / mus[s])

    def _drawn(self, sheet: Format, number: int, figure: Figure, scene: Scene) -> View:
        """Draw a figure, unless it has been drawn for this format at the same of the scale factors that it used."""
        drawings = self._drawings.setdefault((sheet.name, number), [])
        for used, view in drawings:
            if all(scene.scales[plan] == scale for plan, scale in used.items()):
                return view
        watched = Watched(scene.scales)
        view = figure.draw(replace(scene, scales=watched))
        drawings.append((watched.used, view))
        return view

    def _rung(self, symbol: str, step: int, sheet: Format) -> int:
        """Return the first rung at which the marks alone have room, before any view is built."""
        ladder, reach = self.ladders[symbol], _reach(self.contents.solved, symbol)
        diagonal = math.hypot(*room(sheet, self.contents.norm))
        first = step if symbol.startswith("mu_F") else step - FORCES_ONLY
        # several pages are better than a plan on which nothing can be measured
        least = LEAST[sheet.letters] * LARGER[symbol.split("_")[1]]
        if self.is_fixed(symbol):
            first = 0
        legible = sum(reach >= least * mu for mu in ladder) - 1
        for rung in range(max(min(first, legible), 0), len(ladder)):
            if reach <= diagonal * ladder[rung]:
                return rung
        raise self._does_not_fit(sheet, symbol, (reach / ladder[-1], reach / ladder[-1]))

    def _scene(self, sheet: Format, mus: Mapping[str, float]) -> Scene:
        solved, contents = self.contents.solved, self.contents
        scales = by_plan(solved, mus)
        words = lettered(contents.words, solved)
        return Scene(solved, scales, words, STYLES[sheet.letters], contents.givens, self.runs)

    def _does_not_fit(self, sheet: Format, symbol: str, size: tuple[float, float]) -> InputError:
        """Say which format, or which scale factor, would do."""
        norm, mu = self.contents.norm, self.ladders[symbol][-1]
        width, height = room(sheet, norm)
        excess = max(size[0] / width, size[1] / height)
        rooms = {name: room(FORMATS[name], norm) for name in SIZES}
        larger = [name for name, (w, h) in rooms.items() if w >= size[0] and h >= size[1]]
        return InputError(
            "plan-too-large" if larger else "plan-too-large-everywhere",
            symbol=symbol,
            mu=f"{mu:g}",
            unit=Scale(symbol, mu, UNITS[symbol.split("_")[1]]).per_mm_unit,
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
        marks = [solved.point(step.name) for step in steps_here if not step.name.startswith(("_", "P_"))]
        longest = max((longest, *(abs(a - b) for a in marks for b in marks)))
    return longest
