"""The views of a linkage sheet, in the order of the work."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

from ...plans.linkages.chain import hinged
from ...plans.linkages.compound import Coupler
from ...plans.linkages.mechanism import Diagram
from ...plans.linkages.solved import SolvedLinkage
from ...plans.linkages.structure import Group
from ...plans.names import role, scale_factor
from ..table import note_block
from ..view import View
from .calculations.forces import LOADS, WHOLE, force_parts, forces_block, lever_block
from .calculations.kinematics import KinematicsPart, kinematics_block, kinematics_parts
from .calculations.tables import Part, givens_table, results_parts, results_table, structure_block
from .figures.diagrams import load_diagram
from .figures.group import driver_view, group_view, link_view
from .figures.lever import lever_view
from .figures.plan import plan_view
from .figures.scheme import scheme
from .layout.ladders import links_apart
from .scene import Scene

if TYPE_CHECKING:
    from ...plans.linkages.cycles.cycle import Cycle


@dataclass(frozen=True, slots=True)
class Figure:
    """One figure of the sheet: how it is drawn, and the scale factor that sizes it ("" for a table or text).

    Vectors that stand on the mechanism have two: `beside` is then that of the mechanism.
    """

    draw: Callable[[Scene], View]
    symbol: str = ""
    beside: str = ""


def figures(solved: SolvedLinkage, plans: tuple[str, ...], width: float, cycle: Cycle | None = None) -> list[Figure]:
    """Return the figures for `plans` in the order of the work; lines of text are at most `width` long."""
    return [
        *_kinematics(solved, plans, width),
        *_compound(solved, plans, width),
        *_cycle(solved, cycle),
        *_forces(solved, plans, width),
        *_lever(solved, plans, width),
    ]


def noted(note: str, width: float) -> Iterator[Figure]:
    """Return the figure of what the task says of its data; none where it says nothing."""
    if note:
        yield Figure(lambda scene: note_block(scene.words, note, scene.style, width))


def _kinematics(solved: SolvedLinkage, plans: tuple[str, ...], width: float) -> Iterator[Figure]:
    symbols = solved.scale_of_plan
    if "structure" in plans:
        yield Figure(givens_table)
        yield Figure(lambda scene: structure_block(scene, width))
    if "position" in plans:
        yield Figure(scheme, "mu_l")
    for plan in ("velocity", "acceleration"):
        if plan in plans:
            yield _plan(plan, symbols[plan])
    yield from (_kinematics_text(part, width) for part in kinematics_parts(solved, plans))
    parts = results_parts(solved)
    yield from (_results(p) for p in parts if p.kind in ("velocity", "acceleration") and p.kind in plans)


def _compound(solved: SolvedLinkage, plans: tuple[str, ...], width: float) -> Iterator[Figure]:
    if "compound" not in plans:
        return
    from .figures.compound import velocity_figure  # few tasks split motions

    couplers = hinged(solved.mechanism, solved.structure)
    if couplers:
        yield Figure(lambda scene: velocity_figure(scene, couplers), "mu_V", "mu_l")
    yield from (_compound_text(coupler, "V", width) for coupler in couplers)
    for coupler in couplers:
        yield from (_accelerations(coupler, point) for point in coupler.letters)
        yield _compound_text(coupler, "a", width)
    yield from (_results(p) for p in results_parts(solved) if p.kind == "compound")


def _cycle(solved: SolvedLinkage, cycle: Cycle | None) -> Iterator[Figure]:
    if cycle is not None:
        # a sheet of one position does not pay for the import
        from .figures.diagrams import diagrams_view
        from .figures.positions import coupler, field_view, main_output, positions_view

        yield Figure(lambda scene: positions_view(scene, cycle), "mu_l")
        if main_output(cycle) is not None:
            yield Figure(lambda scene: diagrams_view(scene, cycle))
        link = coupler(solved)
        if link is not None:
            yield Figure(lambda scene: field_view(scene, link), "mu_l")


def _forces(solved: SolvedLinkage, plans: tuple[str, ...], width: float) -> Iterator[Figure]:
    if "forces" in plans:
        symbols, link = solved.scale_of_plan, str(solved.structure.driver)
        parts = force_parts(solved)  # one text after all figures, or one for each group after its own
        yield from (_load_diagram(diagram) for diagram in solved.mechanism.diagrams)
        yield from (_forces_text(part, width) for part in parts if part == LOADS)
        for group in reversed(solved.structure.groups):
            yield from _group(solved, group)
            yield from (_forces_text(part, width) for part in parts if part == group.name)
        yield Figure(driver_view, "mu_l")
        yield _plan(f"forces_{link}", symbols[f"forces_{link}"])
        yield from (_forces_text(part, width) for part in parts if part in (WHOLE, link))


def _load_diagram(diagram: Diagram) -> Figure:
    """Return the figure of a load diagram that the task gives."""
    return Figure(lambda scene: load_diagram(scene, diagram))


def _group(solved: SolvedLinkage, group: Group) -> Iterator[Figure]:
    """Go through a group, its plans of forces in the order of construction, and its sliders apart.

    A slider whose plan the construction draws stands before it; that of a rod beside it stands after the plans.
    """
    symbols, apart = solved.scale_of_plan, links_apart(solved, group)
    plans = [plan for plan in symbols if plan in {f"forces_{n}" for n in (group.name, *group.links)}]
    plans.sort(key=solved.program.plans.index)
    yield _apart(group, None)
    for plan in plans:
        link = role(plan).of
        if link != group.name and int(link) in apart:
            yield _apart(group, int(link))
        yield _plan(plan, symbols[plan])
    yield from (_apart(group, number) for number in apart if f"forces_{number}" not in plans)


def _apart(group: Group, number: int | None) -> Figure:
    """Return the figure of a whole group, or of one of its links."""
    if number is None:
        return Figure(lambda scene: group_view(scene, group), "mu_l")
    return Figure(lambda scene: link_view(scene, group, number), "mu_l")


def _lever(solved: SolvedLinkage, plans: tuple[str, ...], width: float) -> Iterator[Figure]:
    if "lever" in plans:
        yield Figure(lever_view, "mu_V")
        yield Figure(lambda scene: lever_block(scene, width, with_inertia="forces" not in plans))
    yield from (_results(p) for p in results_parts(solved) if p.kind in ("forces", "lever") and p.kind in plans)


def _accelerations(coupler: Coupler, point: str) -> Figure:
    """Return the figure of the accelerations of one point of a coupler."""
    from .figures.compound import acceleration_figure

    symbol = scale_factor("a", coupler.letters[point])
    return Figure(lambda scene: acceleration_figure(scene, coupler, point), symbol, "mu_l")


def _compound_text(coupler: Coupler, kind: str, width: float) -> Figure:
    from .calculations.compound import compound_block

    return Figure(lambda scene: compound_block(scene, width, coupler, kind))


def _plan(plan: str, symbol: str) -> Figure:
    return Figure(lambda scene: plan_view(scene, plan), symbol)


def _kinematics_text(part: KinematicsPart, width: float) -> Figure:
    return Figure(lambda scene: kinematics_block(scene, width, part))


def _forces_text(part: str, width: float) -> Figure:
    return Figure(lambda scene: forces_block(scene, width, part))


def _results(part: Part) -> Figure:
    return Figure(lambda scene: results_table(scene, part))
