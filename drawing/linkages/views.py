"""The views of a linkage sheet, in the order of the work."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

from ...plans.linkages.rrp import Dyad, dyad
from ...plans.linkages.solved import Solved
from ..view import View
from .driver_view import driver_view
from .forces_text import forces_block
from .group_view import group_view, slider_view
from .kinematics_text import kinematics_block
from .lever_text import lever_block
from .lever_view import lever_view
from .plan_view import plan_view
from .scene import Scene
from .scheme import scheme
from .structure_text import structure_block
from .tables import givens_table, kinds_of_results, results_table


@dataclass(frozen=True, slots=True)
class Figure:
    """One figure of the sheet: how it is drawn, and the scale factor that sizes it ("" for a table or text)."""

    draw: Callable[[Scene], View]
    symbol: str = ""


def figures(solved: Solved, plans: tuple[str, ...], width: float) -> list[Figure]:
    """Return the figures for `plans` in the order of the work; lines of text are at most `width` long."""
    return [*_kinematics(solved, plans, width), *_forces(solved, plans, width), *_lever(solved, plans, width)]


def _kinematics(solved: Solved, plans: tuple[str, ...], width: float) -> Iterator[Figure]:
    symbols, results = solved.scale_of_plan, kinds_of_results(solved)
    if "structure" in plans:
        yield Figure(givens_table)
        yield Figure(lambda scene: structure_block(scene, width))
    if "position" in plans:
        yield Figure(scheme, "mu_l")
    for plan in ("velocity", "acceleration"):
        if plan in plans:
            yield _plan(plan, f"heading.{plan}", symbols[plan])
    if {"velocity", "acceleration"} & set(plans):
        yield Figure(lambda scene: kinematics_block(scene, width, plans))
    yield from (_results(kind) for kind in ("velocity", "acceleration") if kind in results and kind in plans)


def _forces(solved: Solved, plans: tuple[str, ...], width: float) -> Iterator[Figure]:
    if "forces" in plans:
        symbols, link = solved.scale_of_plan, str(solved.structure.driver)
        for group in reversed(solved.structure.groups):
            yield from _group(dyad(solved.mechanism, group), symbols[f"forces_{group.name}"])
        yield Figure(driver_view, "mu_l")
        yield _plan(f"forces_{link}", "heading.link_forces", symbols[f"forces_{link}"], link=link)
        yield Figure(lambda scene: forces_block(scene, width))


def _group(d: Dyad, symbol: str) -> Iterator[Figure]:
    links, rod = f"{d.rod.number}, {d.slider.number}", str(d.rod.number)
    yield Figure(lambda scene: group_view(scene, d), "mu_l")
    yield _plan(f"forces_{d.name}", "heading.group_forces", symbol, links=links)
    yield _plan(f"forces_{rod}", "heading.link_forces", symbol, link=rod)
    yield Figure(lambda scene: slider_view(scene, d))


def _lever(solved: Solved, plans: tuple[str, ...], width: float) -> Iterator[Figure]:
    if "lever" in plans:
        yield Figure(lever_view, "mu_V")
        yield Figure(lambda scene: lever_block(scene, width, with_inertia="forces" not in plans))
    yield from (_results(kind) for kind in ("forces", "lever") if kind in kinds_of_results(solved) and kind in plans)


def _plan(plan: str, key: str, symbol: str, **fill: str) -> Figure:
    return Figure(lambda scene: plan_view(scene, plan, key, **fill), symbol)


def _results(kind: str) -> Figure:
    return Figure(lambda scene: results_table(scene, kind))
