"""The views of a linkage sheet, in the order of the work."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

from ...plans.linkages.chain import hinged
from ...plans.linkages.compound import Coupler
from ...plans.linkages.solved import SolvedLinkage
from ...plans.linkages.structure import Group
from ...plans.names import scale_factor
from ..figure import Figure
from ..rungs import SheetContents
from ..table import note_block, text_block
from ..view import View
from .calculations.equations import Lines
from .calculations.forces import LOADS, WHOLE, equations_heading, force_lines, force_parts, lever_lines
from .calculations.kinematics import PLANS, kinematics_text
from .calculations.tables import givens_table, results_parts, results_table, structure_lines
from .figures.group import driver_view, group_view, link_view
from .figures.lever import lever_view
from .figures.plan import plan_view
from .figures.scheme import scheme
from .layout.ladders import links_apart
from .scene import Scene
from .telling.compound import block_name, compound_heading, compound_lines

if TYPE_CHECKING:
    from ...plans.linkages.cycles.cycle import Cycle

LinkageFigure = Figure[Scene]


@dataclass(frozen=True, slots=True)
class Contents(SheetContents[SolvedLinkage]):
    """What the sheet of a linkage shows; its whole cycle, too, where that is wanted."""

    cycle: Cycle | None = None


def figures(contents: Contents, width: float) -> Iterator[LinkageFigure]:
    """Go through the figures of a sheet in the order of the work; lines of text are at most `width` long.

    The ladders of a figure are the scale factors that size it; vectors that stand on the mechanism have two.
    """
    solved, plans = contents.solved, contents.plans
    if contents.note:
        yield Figure("note", lambda scene: note_block(scene.words, contents.note, scene.style, width))
    yield from _kinematics(solved, plans, width)
    if "compound" in plans:
        yield from _compound(solved, width)
        yield from _results(solved, ("compound",))
    yield from _cycle(contents)
    if "forces" in plans:
        yield from _forces(solved, width)
    if "lever" in plans:
        yield Figure("lever", lever_view, ("mu_V",))
        lines = partial(lever_lines, with_loads="forces" not in plans)
        yield _text("equations_lever", lines, width, "heading.equations_lever")
    yield from _results(solved, [kind for kind in ("forces", "lever") if kind in plans])


def _text(
    name: str, lines: Callable[[Scene], Lines], width: float, heading: str | Callable[[Scene], str]
) -> LinkageFigure:
    """Return lines of text with their heading, or with that of this key."""

    def draw(scene: Scene) -> View:
        said = scene.words[heading] if isinstance(heading, str) else heading(scene)
        return text_block(name, said, lines(scene), scene.style, width)

    return Figure(name, draw)


def _results(solved: SolvedLinkage, kinds: Sequence[str]) -> Iterator[LinkageFigure]:
    for part in results_parts(solved):
        if part.kind in kinds:
            yield Figure(part.name, partial(results_table, part=part))


def _plan(solved: SolvedLinkage, plan: str) -> LinkageFigure:
    return Figure(plan, partial(plan_view, plan=plan), (solved.scale_of_plan[plan],))


def _kinematics(solved: SolvedLinkage, plans: Sequence[str], width: float) -> Iterator[LinkageFigure]:
    """Go through what is given, the mechanism, its plans, and their equations: for each plan where groups are many."""
    if "structure" in plans:
        yield Figure("givens", givens_table)
        yield _text("structure", structure_lines, width, "heading.structure")
    if "position" in plans:
        yield Figure("position", scheme, ("mu_l",))
    drawn = [plan for plan in PLANS if plan in plans]
    yield from (_plan(solved, plan) for plan in drawn)
    single = len(solved.structure.groups) < 2
    for i, plan in enumerate(drawn[:1] if single else drawn):
        own = drawn if single else [plan]
        lines = partial(kinematics_text, plans=own, before=drawn[:i])
        name = "equations_kinematics" if single else f"equations_{plan}"
        heading = "heading.equations_kinematics" if len(own) > 1 else f"heading.equations_{plan}"
        yield _text(name, lines, width, heading)
    yield from _results(solved, drawn)


def _compound(solved: SolvedLinkage, width: float) -> Iterator[LinkageFigure]:
    from .figures.compound import acceleration_figure, velocity_figure  # few tasks split motions

    couplers = hinged(solved.mechanism, solved.structure)

    def text(coupler: Coupler, kind: str) -> LinkageFigure:
        lines = partial(compound_lines, c=coupler, kind=kind)
        return _text(block_name(coupler, kind), lines, width, partial(compound_heading, c=coupler, kind=kind))

    if couplers:
        yield Figure("compound_velocity", partial(velocity_figure, couplers=couplers), ("mu_V", "mu_l"))
    yield from (text(coupler, "V") for coupler in couplers)
    for coupler in couplers:
        for point, letter in coupler.letters.items():
            draw = partial(acceleration_figure, coupler=coupler, point=point)
            yield Figure(f"compound_a_{letter}", draw, (scale_factor("a", letter), "mu_l"))
        yield text(coupler, "a")


def _cycle(contents: Contents) -> Iterator[LinkageFigure]:
    solved, cycle = contents.solved, contents.cycle
    if cycle is not None:
        # a sheet of one position does not pay for the import
        from .figures.diagrams import diagrams_view
        from .figures.positions import coupler, field_view, main_output, positions_view

        yield Figure("positions", partial(positions_view, cycle=cycle), ("mu_l",))
        if main_output(cycle) is not None:
            yield Figure("diagrams", partial(diagrams_view, cycle=cycle))
        link = coupler(solved)
        if link is not None:
            yield Figure("field", partial(field_view, link=link), ("mu_l",))


def _forces(solved: SolvedLinkage, width: float) -> Iterator[LinkageFigure]:
    """Go through the force plans from the last group to the driver, with their equations.

    These are one text after all figures, or one for each group after its own.
    """
    if solved.mechanism.diagrams:
        from .figures.diagrams import load_diagram

        yield from (Figure(f"load_{d.name}", partial(load_diagram, diagram=d)) for d in solved.mechanism.diagrams)
    texts = {part: _equations_of_forces(part, width) for part in force_parts(solved)}
    yield from (texts[part] for part in texts if part == LOADS)
    for group in reversed(solved.structure.groups):
        yield from _group(solved, group)
        yield from (texts[part] for part in texts if part == group.name)
    driver = str(solved.structure.driver)
    yield Figure("driver", driver_view, ("mu_l",))
    yield _plan(solved, f"forces_{driver}")
    yield from (texts[part] for part in texts if part in (WHOLE, driver))


def _equations_of_forces(part: str, width: float) -> LinkageFigure:
    name = f"equations_forces_{part}" if part else "equations_forces"
    return _text(name, partial(force_lines, part=part), width, partial(equations_heading, part=part))


def _group(solved: SolvedLinkage, group: Group) -> Iterator[LinkageFigure]:
    """Go through a group, its plans of forces in the order of construction, and its sliders apart.

    A slider whose plan the construction draws stands before it; that of a rod beside it stands after the plans.
    """
    sliders = {
        f"forces_{n}": Figure(f"link_{n}", partial(link_view, group=group, number=n), ("mu_l",))
        for n in links_apart(solved, group)
    }
    own = {f"forces_{n}" for n in (group.name, *group.links)}
    yield Figure(f"group_{group.name}", partial(group_view, group=group), ("mu_l",))
    for plan in sorted(own.intersection(solved.scale_of_plan), key=solved.program.plans.index):
        if plan in sliders:
            yield sliders.pop(plan)
        yield _plan(solved, plan)
    yield from sliders.values()
