"""Scale factors that fit: for each format the first rung of every ladder at which the views have room on a page."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from ...plans.linkages.rrp import dyad
from ...plans.linkages.solved import Solved
from ...scales.choose import UNITS, Choosers, CrankScale, Round
from ...scales.errors import InputError
from ...scales.scale import Scale, steps
from ..compose import room
from ..formats import FORMATS, Format
from ..pens import Norm
from ..style import STYLES
from ..view import View
from ..words import Words
from .scene import Given, Scene
from .views import build

SMALLEST_FIRST = ("A4", "A3", "A2", "A1")
TEXT_WIDTH = {"A1": 235.0, "A2": 190.0, "A3": 150.0, "A4": 175.0}
MARKS = ("place", "pole", "lay", "back", "chain", "meet", "arc", "divide")
Ladders = Mapping[str, tuple[float, ...]]
Fitted = tuple[list[View], Mapping[str, Scale]]


@dataclass(frozen=True, slots=True)
class Contents:
    """What a sheet shows: a solved mechanism, the plans wanted, choosers of scales, givens, words, norm."""

    solved: Solved
    plans: tuple[str, ...]
    choosers: Choosers
    givens: Mapping[str, Given]
    words: Words
    norm: Norm = "gost"


def first_scales(solved: Solved, choosers: Choosers) -> dict[str, Scale]:
    """Return the scale factors as they are wanted, by plan, before any format has its say."""
    return _by_plan(solved, {symbol: ladder[0] for symbol, ladder in ladders_of(solved, choosers).items()})


def ladders_of(solved: Solved, choosers: Choosers) -> dict[str, tuple[float, ...]]:
    """Return for each scale factor of the plans its values from the wanted one to ever coarser ones."""
    plans, shown = solved.scale_of_plan, solved.shown_on

    def value(name: str) -> float:
        if name in plans.values():
            drawn = [
                q.value or 0.0 for q in solved.quantities.values() if plans.get(shown.get(q.name, "position")) == name
            ]
            size = max(map(abs, drawn), default=0.0)
        else:
            item = solved.quantities.get(name)
            size = abs(item.value or 0.0) if item is not None else abs(float(solved.values.get(name, 0.0)))
        if not size > 0.0:
            raise InputError("scale-of-zero", quantity=name)
        return size

    ladders: dict[str, tuple[float, ...]] = {}
    for symbol in dict.fromkeys(plans.values()):
        chooser = choosers.get(symbol, Round(symbol, 100.0))
        ladders[symbol] = (
            chooser.ladder(value, ladders["mu_l"]) if isinstance(chooser, CrankScale) else chooser.ladder(value)
        )
    return ladders


def _by_plan(solved: Solved, mus: Mapping[str, float]) -> dict[str, Scale]:
    plans = solved.scale_of_plan.items()
    return {plan: Scale(symbol, mus[symbol], UNITS[symbol.split("_")[1]]) for plan, symbol in plans}


@dataclass(slots=True)
class Fitting:
    """Builds the views of `contents` for any format, each only once."""

    contents: Contents
    ladders: Ladders = field(init=False)
    _root: dict[str, str] = field(init=False)
    _built: dict[tuple[str, int], Fitted] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Find the ladders; a crank scale stands on the rung of mu_l."""
        choosers = self.contents.choosers
        self.ladders = ladders_of(self.contents.solved, choosers)
        self._root = {s: "mu_l" if isinstance(choosers.get(s), CrankScale) else s for s in self.ladders}

    @property
    def firm(self) -> bool:
        """Whether the user has fixed a scale factor himself."""
        return any(chooser.firm for chooser in self.contents.choosers.values())

    def views(self, sheet: Format, step: int = 0) -> Fitted:
        """Return views and scale factors for pages of `sheet`, each factor `step` rungs or more below the wanted one.

        Raises
        ------
        InputError
            When a view has no room on a page even at the last rung.
        """
        key = sheet.name, step
        if key not in self._built:
            self._built[key] = self._fitted(sheet, step)
        return self._built[key]

    def _fitted(self, sheet: Format, step: int) -> Fitted:
        contents, root = self.contents, self._root
        width, height = room(sheet, contents.norm)
        rungs = {root[s]: self._rung(s, step, max(width, height)) for s in self.ladders if root[s] == s}
        while True:
            scene = self._scene(sheet, {s: ladder[rungs[root[s]]] for s, ladder in self.ladders.items()})
            views, too_large = [], {}
            for view, symbol in build(scene, contents.plans, min(TEXT_WIDTH[sheet.letters], width)):
                views.append(view)
                if symbol and (view.size[0] > width or view.size[1] > height):
                    too_large[root[symbol]] = view
            if not too_large:
                return views, scene.scales
            for symbol, view in too_large.items():
                rungs[symbol] += 1
                if rungs[symbol] >= len(self.ladders[symbol]):
                    raise self._does_not_fit(sheet, symbol, view)

    def _rung(self, symbol: str, step: int, longest: float) -> int:
        """Return the first rung at which the marks alone have room, before any view is built."""
        ladder, reach = self.ladders[symbol], _reach(self.contents.solved, symbol)
        rung = min(step, len(ladder) - 1)
        while rung + 1 < len(ladder) and reach > longest * ladder[rung]:
            rung += 1
        return rung

    def _scene(self, sheet: Format, mus: Mapping[str, float]) -> Scene:
        solved, contents = self.contents.solved, self.contents
        dyads = tuple(dyad(solved.mechanism, group) for group in solved.structure.groups)
        scales = _by_plan(solved, mus)
        return Scene(solved, dyads, scales, contents.words, STYLES[sheet.letters], contents.givens)

    def _does_not_fit(self, sheet: Format, symbol: str, view: View) -> InputError:
        """Say which format, or which scale factor, would do."""
        norm, mu = self.contents.norm, self.ladders[symbol][-1]
        width, height = room(sheet, norm)
        excess = max(view.size[0] / width, view.size[1] / height)
        rooms = {name: room(FORMATS[name], norm) for name in SMALLEST_FIRST}
        larger = [name for name, (w, h) in rooms.items() if w >= view.size[0] and h >= view.size[1]]
        return InputError(
            "plan-too-large" if larger else "plan-too-large-everywhere",
            symbol=symbol,
            mu=f"{mu:g}",
            unit=Scale(symbol, mu, UNITS[symbol.split("_")[1]]).per_mm_unit,
            format=sheet.name,
            fits=f"{steps(mu * excess * 1.1)[0]:g}",
            larger=larger[0] if larger else "",
        )


def _reach(solved: Solved, symbol: str) -> float:
    """Return the longest distance between marks of the plans that a scale factor sizes, in its own unit."""
    longest = 0.0
    for plan in (plan for plan, name in solved.scale_of_plan.items() if name == symbol):
        steps_here = (step for step in solved.program.on(plan) if step.verb in MARKS)
        marks = [solved.point(step.name) for step in steps_here if not step.name.startswith("_")]
        longest = max((abs(a - b) for a in marks for b in marks), default=longest)
    return longest
