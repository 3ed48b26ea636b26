"""The plans of a linkage told step by step, in words, from the recorded program: for the explanatory note."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import chain

from ...plans.board import POSITION
from ...plans.names import FORCES, role
from ..notes.blocks import Block, Equations, Heading, Story
from .at_point import is_at_point
from .calculations.equations import Lines
from .calculations.forces import force_parts, lines_by_plan, load_lines
from .calculations.kinematics import PLANS as KINEMATICS
from .calculations.kinematics import kinematics_lines
from .layout.ladders import links_apart
from .scene import Scene
from .telling.compound import compound_blocks, compound_equations, compound_told
from .telling.conclusions import conclusions
from .telling.lever import lever_told
from .telling.marks import TOLD
from .telling.teller import Teller, Told

SET = ("pole", "place")  # verbs that set a drawing up


def story(scene: Scene, texts: Mapping[str, str]) -> Story:
    """Return what the note of a linkage says: equations and steps of every plan, what the numbers mean.

    Parameters
    ----------
    texts : mapping of str to str
        The sentences, by key.
    """
    teller = Teller.of(scene, texts)
    steps = {view: [told.text for told in told_of(teller, view)] for view in drawn_views(teller)}
    equations, views = _kinematics(scene)
    equations |= compound_equations(teller)
    before: dict[str, tuple[Block, ...]] = {}
    if any(role(plan).kind == FORCES for plan in steps):
        groups = scene.solved.structure.groups
        apart = {number for group in groups for number in links_apart(scene.solved, group)}
        equations |= lines_by_plan(scene, apart)
        views |= {"equations_forces", *(f"equations_forces_{part}" for part in force_parts(scene.solved) if part)}
        loads = Heading(scene.words["heading.equations_loads"]), Equations(tuple(map(tuple, load_lines(scene))))
        before[f"group_{groups[-1].name}"] = loads
    told = frozenset(views | compound_blocks(teller))
    return Story(steps, equations, told, tuple(conclusions(teller)), before)


def _kinematics(scene: Scene) -> tuple[dict[str, Lines], set[str]]:
    """Return the equations of the plans of velocities and accelerations, and the views of the sheet with these."""
    lengths: set[str] = set()
    drawn = [plan for plan in KINEMATICS if plan in scene.scales]
    equations = {plan: kinematics_lines(scene, plan, lengths) for plan in drawn}
    return equations, {"equations_kinematics", *(f"equations_{plan}" for plan in drawn)}


def drawn_views(teller: Teller) -> list[str]:
    """Return the views whose drawing is told step by step, in order: the plans, the figures of compound motion."""
    scene = teller.scene
    plans = [plan for plan in scene.solved.program.plans if plan in scene.scales and not is_at_point(plan)]
    forces = next((at for at, plan in enumerate(plans) if role(plan).kind == FORCES), len(plans))
    return [*plans[:forces], *teller.figures, *plans[forces:]]


def told_of(teller: Teller, view: str) -> Iterator[Told]:
    """Go through the steps of a view, each with its sentence."""
    if view in teller.figures:
        yield from compound_told(teller, view)
    elif view == "lever":
        yield from lever_told(teller)
    else:
        yield from chain.from_iterable(_plan(teller, view))


def _plan(teller: Teller, plan: str) -> Iterator[Iterator[Told]]:
    """Go through the steps of a plan; instant centres of compound motion are marked on its own figure."""
    centres = {at.coupler.centre for points in teller.figures.values() for at in points}
    for step in teller.scene.solved.program.on(plan):
        if step.verb not in TOLD or step.name in centres:
            continue
        if role(step.name).hidden and step.verb not in ("place", "read"):
            continue
        if plan == POSITION and step.verb == "read":  # an arm that a calculation takes
            continue
        yield (Told(step, text, before=step.verb in SET) for text in TOLD[step.verb](teller, step))
