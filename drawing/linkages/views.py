"""The views of a linkage sheet, in the order of the work."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from ...plans.linkages.rrp import Dyad
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
from .tables import givens_table, results_tables


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
