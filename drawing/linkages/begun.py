"""What is drawn of a linkage's plans when only the first steps of each have been done."""

from __future__ import annotations

from collections.abc import Iterator

from ...plans.board import POSITION, Step
from ..handouts.begun import Shown
from .letters import guide_letters
from .reading import read
from .scene import Scene
from .steps import SET, Teller, drawn_plans


def begun(scene: Scene, steps: int) -> dict[str, Shown]:
    """Return for every plan what its first steps draw, as the note numbers them; poles and pivots are there before."""
    return {plan: _plan(scene, plan, steps) for plan in drawn_plans(scene)}


def _plan(scene: Scene, plan: str, steps: int) -> Shown:
    words, names, letters = scene.words, set[str](), set[str]()
    for step in _first(scene, plan, steps):
        names |= {step.name, f"arc_{step.name}", f"{step.name}_1", f"{step.name}_2"}
        if step.verb == "read":
            letters.add(words.symbol(step.name, bar=True))
            continue
        letters.add(words.mark(step.name))
        edge = next(
            (e for e in read(scene.solved.program).on(plan) if e.tip == step.name and _laid(step, e.tail)), None
        )
        if edge is not None:
            names.add(edge.name)
            letters.add(words.symbol(edge.name, bar=True))
    if plan == POSITION:
        links = [link for link in scene.solved.mechanism.links if names.issuperset(link.points)]
        names |= {f"link:{link.number}" for link in links}
        letters |= {str(link.number) for link in links} | {words.frame, *guide_letters(scene.solved.program).values()}
    return Shown(frozenset(names), frozenset(letters))


def _laid(step: Step, tail: str) -> bool:
    return step.verb in ("lay", "back", "chain") and step.operands[0] == tail


def _first(scene: Scene, plan: str, steps: int) -> Iterator[Step]:
    """Go through the steps that are done: those that set the drawing up, and so many that the note tells."""
    done = 0
    for step, _ in Teller.of(scene).told(plan):
        done += step.verb not in SET
        if done <= steps or step.verb in SET:
            yield step
