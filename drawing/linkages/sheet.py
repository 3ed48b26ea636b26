"""The sheet of a linkage: its views in the order of the work, at scale factors at which they fit the format."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from ...plans.linkages.rrp import Dyad, dyad
from ...plans.linkages.solved import Solved
from ...scales.choose import UNITS, Choosers, CrankScale, Round
from ...scales.errors import InputError
from ...scales.scale import Scale, steps
from ..compose import arrange, compose, room
from ..formats import FORMATS, Format
from ..packing import Placement
from ..page import Page
from ..pens import Norm
from ..style import STYLES
from ..titleblock import Stamp
from ..view import View
from ..words import Words
from .driver_view import driver_view
from .forces_text import forces_block
from .group_view import group_view, slider_view
from .kinematics_text import kinematics_block
from .lever_text import lever_block
from .lever_view import lever_view
from .plan_view import plan_view
from .scene import Given, Scene
from .scheme import scheme
from .structure_text import structure_block
from .tables import givens_table, results_tables

SMALLEST_FIRST = ("A4", "A3", "A2", "A1")
TEXT_WIDTH = {"A1": 235.0, "A2": 190.0, "A3": 150.0, "A4": 175.0}
FINER = 3  # how many rungs coarser than wanted a single sheet may be before several pages are better


@dataclass(frozen=True, slots=True)
class Order:
    """What a sheet is made of: a solved mechanism, the plans wanted, choosers of scales, givens, words, stamp."""

    solved: Solved
    plans: tuple[str, ...]
    choosers: Choosers
    givens: Mapping[str, Given]
    words: Words
    stamp: Stamp
    norm: Norm = "gost"


@dataclass(frozen=True, slots=True)
class Drawn:
    """A drawn sheet: its pages, and the scale factors that they have, by plan."""

    pages: list[Page]
    scales: Mapping[str, Scale]
    format: str


def draw(order: Order, sheet: Format | None = None) -> Drawn:
    """Draw the sheet on `sheet`, or on the smallest format of which one sheet holds everything.

    Raises
    ------
    InputError
        When a plan cannot fit at the scale factor that was asked for: it names what would fit.
    """
    ladders = _ladders(order.solved, order.choosers)
    formats = [sheet] if sheet is not None else [FORMATS[name] for name in SMALLEST_FIRST]
    for candidate in formats:
        found = _single(order, candidate, ladders, coarser=FINER if candidate is formats[-1] else 0)
        if found is not None:
            return found
    return _several(order, formats[-1], ladders)


def first_scales(solved: Solved, choosers: Choosers) -> dict[str, Scale]:
    """Return the scale factors as they are wanted, by plan, before any format has its say."""
    return _by_plan(solved, {symbol: ladder[0] for symbol, ladder in _ladders(solved, choosers).items()})


def _ladders(solved: Solved, choosers: Choosers) -> dict[str, tuple[float, ...]]:
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


def _single(order: Order, sheet: Format, ladders: Mapping[str, tuple[float, ...]], coarser: int) -> Drawn | None:
    """Try one page, each scale factor up to `coarser` rungs beyond the first at which its views fit."""
    for step in range(coarser + 1):
        try:
            views, scales = _fitted(order, sheet, ladders, step)
        except InputError:
            if step == 0 and not any(chooser.firm for chooser in order.choosers.values()):
                return None
            raise
        places = arrange(views, sheet, order.norm, 1)
        if places is not None:
            return _drawn(order, sheet, views, places, scales)
    return None


def _several(order: Order, sheet: Format, ladders: Mapping[str, tuple[float, ...]]) -> Drawn:
    views, scales = _fitted(order, sheet, ladders, 0)
    places = arrange(views, sheet, order.norm, None)
    if places is None:
        raise InputError("sheet-too-small", format=sheet.name)
    return _drawn(order, sheet, views, places, scales)


def _drawn(
    order: Order, sheet: Format, views: list[View], places: list[Placement], scales: Mapping[str, Scale]
) -> Drawn:
    return Drawn(compose(views, places, sheet, order.norm, order.stamp), scales, sheet.name)


def _fitted(
    order: Order, sheet: Format, ladders: Mapping[str, tuple[float, ...]], step: int
) -> tuple[list[View], dict[str, Scale]]:
    """Build the views, each scale factor at the first rung at which its views have room on the format."""
    root = {s: "mu_l" if isinstance(order.choosers.get(s), CrankScale) else s for s in ladders}
    rungs = {root[symbol]: min(step, len(ladders[root[symbol]]) - 1) for symbol in ladders}
    width, height = room(sheet, order.norm)
    while True:
        scene = _scene(order, sheet, {symbol: ladder[rungs[root[symbol]]] for symbol, ladder in ladders.items()})
        views, too_large = [], {}
        for view, symbol in build(scene, order.plans, min(TEXT_WIDTH[sheet.letters], width)):
            views.append(view)
            if symbol and (view.size[0] > width or view.size[1] > height):
                too_large[root[symbol]] = view
        for symbol, view in too_large.items():
            rungs[symbol] += 1
            if rungs[symbol] >= len(ladders[symbol]):
                raise _does_not_fit(order, sheet, symbol, ladders[symbol][-1], view)
        if not too_large:
            return views, dict(scene.scales)


def _does_not_fit(order: Order, sheet: Format, symbol: str, mu: float, view: View) -> InputError:
    """Say which format, or which scale factor, would do."""
    width, height = room(sheet, order.norm)
    excess = max(view.size[0] / width, view.size[1] / height)
    wide = [
        name
        for name in SMALLEST_FIRST
        if all(a >= b for a, b in zip(room(FORMATS[name], order.norm), view.size, strict=True))
    ]
    unit = Scale(symbol, mu, UNITS[symbol.split("_")[1]]).per_mm_unit
    return InputError(
        "plan-too-large" if wide else "plan-too-large-everywhere",
        symbol=symbol,
        mu=f"{mu:g}",
        unit=unit,
        format=sheet.name,
        fits=f"{steps(mu * excess * 1.1)[0]:g}",
        larger=wide[0] if wide else "",
    )


def _scene(order: Order, sheet: Format, mus: Mapping[str, float]) -> Scene:
    solved = order.solved
    dyads = tuple(dyad(solved.mechanism, group) for group in solved.structure.groups)
    return Scene(solved, dyads, _by_plan(solved, mus), order.words, STYLES[sheet.letters], order.givens)


def build(scene: Scene, plans: tuple[str, ...], width: float) -> Iterator[tuple[View, str]]:
    """Yield the views in the order of the work, each with the symbol of the scale factor that sizes it."""
    symbols = scene.solved.scale_of_plan
    results = results_tables(scene)
    if "structure" in plans:
        yield givens_table(scene), ""
        yield structure_block(scene, width), ""
    if "position" in plans:
        yield scheme(scene), "mu_l"
    for plan in ("velocity", "acceleration"):
        if plan in plans:
            yield plan_view(scene, plan, f"heading.{plan}"), symbols[plan]
    if "velocity" in plans:
        yield kinematics_block(scene, width, plans), ""
    for kind in ("velocity", "acceleration"):
        if kind in results:
            yield results[kind], ""
    if "forces" in plans:
        for d in reversed(scene.dyads):
            yield from _group(scene, d, symbols)
        yield from _driver(scene, symbols)
        yield forces_block(scene, width), ""
    if "lever" in plans:
        yield lever_view(scene), "mu_V"
        yield lever_block(scene, width, with_inertia="forces" not in plans), ""
    for kind in ("forces", "lever"):
        if kind in results:
            yield results[kind], ""


def _group(scene: Scene, d: Dyad, symbols: Mapping[str, str]) -> Iterator[tuple[View, str]]:
    symbol = symbols[f"forces_{d.name}"]
    links = f"{d.rod.number}, {d.slider.number}"
    yield group_view(scene, d), "mu_l"
    yield plan_view(scene, f"forces_{d.name}", "heading.group_forces", links=links), symbol
    yield plan_view(scene, f"forces_{d.rod.number}", "heading.link_forces", link=str(d.rod.number)), symbol
    yield slider_view(scene, d), ""


def _driver(scene: Scene, symbols: Mapping[str, str]) -> Iterator[tuple[View, str]]:
    link = str(scene.solved.structure.driver)
    yield driver_view(scene), "mu_l"
    yield plan_view(scene, f"forces_{link}", "heading.link_forces", link=link), symbols[f"forces_{link}"]
