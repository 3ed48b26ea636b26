"""The plans of a linkage told step by step, in words, from the recorded program: for the explanatory note."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import chain

from ...plans.board import POSITION, Step
from ...plans.linkages.legs import guide_letters
from ...plans.linkages.mechanism import Driver
from ...plans.names import FORCES, role
from ..handouts import Shown
from ..notes.blocks import Block, Equations, Heading, Story
from .at_point import is_at_point
from .calculations.forces import LOADS, force_lines, force_parts, lines_by_plan
from .calculations.kinematics import PLANS as KINEMATICS
from .calculations.kinematics import kinematics_lines
from .figures.inset import NUMERALS
from .figures.scheme import angle_said
from .layout.ladders import links_apart
from .reading import Reading
from .scene import Scene
from .telling.compound import compound_blocks, compound_equations, compound_told
from .telling.conclusions import conclusions
from .telling.marks import TOLD, lever_told
from .telling.teller import Teller, Told

SET = ("pole", "place")  # verbs that set a drawing up


def story(scene: Scene, texts: Mapping[str, str]) -> Story:
    """Return what the note of a linkage says: equations and steps of every plan, what the numbers mean.

    Parameters
    ----------
    texts : mapping of str to str
        The sentences, by key.
    """
    teller, lengths = Teller.of(scene, texts), set[str]()
    steps = {view: [told.text for told in told_of(teller, view)] for view in drawn_views(teller)}
    plans = [plan for plan in KINEMATICS if plan in scene.scales]
    equations = {plan: kinematics_lines(scene, plan, lengths) for plan in plans} | compound_equations(teller)
    views = {"equations_kinematics", *(f"equations_{plan}" for plan in plans), *compound_blocks(teller)}
    before: dict[str, tuple[Block, ...]] = {}
    if any(role(plan).kind == FORCES for plan in steps):
        groups = scene.solved.structure.groups
        apart = {number for group in groups for number in links_apart(scene.solved, group)}
        equations |= lines_by_plan(scene, apart)
        views |= {"equations_forces", *(f"equations_forces_{part}" for part in force_parts(scene.solved))}
        loads = Heading(scene.words["heading.equations_loads"]), Equations(tuple(map(tuple, force_lines(scene, LOADS))))
        before[f"group_{groups[-1].name}"] = loads
    return Story(steps, equations, frozenset(views), tuple(conclusions(teller)), before)


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
        hidden = role(step.name).hidden and step.verb not in ("place", "read")
        arm = plan == POSITION and step.verb == "read"  # that a calculation takes
        if step.verb in TOLD and step.name not in centres and not hidden and not arm:
            yield (Told(step, text, before=step.verb in SET) for text in TOLD[step.verb](teller, step))


def begun(scene: Scene, steps: int) -> dict[str, Shown]:
    """Return for every view what its first steps draw, as the note numbers them; poles and pivots are there before."""
    teller = Teller.of(scene)
    return {view: _begun(teller, view, steps) for view in drawn_views(teller)}


def _begun(teller: Teller, view: str, steps: int) -> Shown:
    scene, names, letters = teller.scene, set[str](), set[str]()
    every = list(told_of(teller, view))
    for told in (told for number, told in enumerate(every, 1) if told.before or number <= steps):
        vectors, step = set(told.vectors), told.step
        if step.plan == view:
            vectors |= _vectors_by(teller.reading, step)
            lines = (step.name, f"arc_{step.name}")
            names |= {*lines, *(f"{line}_{number}" for line in lines for number in (1, 2))}
            letters |= {scene.words.mark(step.name)} if step.verb not in ("read", "tangent") else set()
        names |= told.names | vectors
        letters |= told.letters | {scene.letter(vector) for vector in vectors}
    if view == POSITION:
        links = [str(link.number) for link in scene.solved.mechanism.links if names.issuperset(link.points)]
        names |= {f"link:{number}" for number in links}
        letters |= {*links, scene.words.frame, *guide_letters(scene.solved.program).values()}
        driver = scene.solved.mechanism.driver
        if isinstance(driver, Driver) and driver.point in names:
            names.add(driver.angle)
            letters.add(angle_said(scene, driver)[1])
    # what is zero, or too short, is told when all is drawn, and drawn larger
    whole = len(every) <= steps
    return Shown(frozenset(names), frozenset(letters | set(NUMERALS if whole else ())), notes=whole, whole=whole)


def _vectors_by(reading: Reading, step: Step) -> set[str]:
    """Return the vectors that a step draws; that of a point about another that rests is that of the point, too."""
    if step.verb == "read":
        steps = reading.program.on(step.plan)
        return {same.name for same in steps if (same.verb, same.operands) == (step.verb, step.operands)}
    return {edge.name for edge in reading.on(step.plan) if edge.tip == step.name and reading.is_hung(edge)}
