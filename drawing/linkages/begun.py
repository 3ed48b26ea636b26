"""What is drawn of a linkage's plans when only the first steps of each have been done."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from ...plans.board import POSITION, Step
from ..handouts.begun import Shown
from .letters import guide_letters
from .reading import read
from .scene import Scene
from .steps import drawn_views, told_of
from .telling.teller import Teller, Told


def begun(scene: Scene, steps: int) -> dict[str, Shown]:
    """Return for every view what its first steps draw, as the note numbers them; poles and pivots are there before."""
    teller = Teller.of(scene)
    return {view: _view(teller, view, steps) for view in drawn_views(teller)}


def _view(teller: Teller, view: str, steps: int) -> Shown:
    scene, names, letters = teller.scene, set[str](), set[str]()
    every = list(told_of(teller, view))
    for told in _first(every, steps):
        names |= told.names
        letters |= told.letters
        if told.step.plan == view:
            _add_mark(scene, told.step, names, letters)
    if view == POSITION:
        links = [link for link in scene.solved.mechanism.links if names.issuperset(link.points)]
        names |= {f"link:{link.number}" for link in links}
        letters |= {str(link.number) for link in links}
        letters |= {scene.words.frame, *guide_letters(scene.solved.program).values()}
    # what is zero, or too short, is told when all is drawn
    return Shown(frozenset(names), frozenset(letters), notes=sum(told.counted for told in every) <= steps)


def _add_mark(scene: Scene, step: Step, names: set[str], letters: set[str]) -> None:
    """Add what a step of a plan draws: its mark with the letter, its construction lines, its vector."""
    words = scene.words
    names |= {step.name, f"arc_{step.name}", f"{step.name}_1", f"{step.name}_2"}
    if step.verb == "read":
        letters.add(words.symbol(step.name, bar=True))
        return
    if step.verb != "tangent":
        letters.add(words.mark(step.name))
    edges = (e for e in read(scene.solved.program).on(step.plan) if e.tip == step.name and _laid(step, e.tail))
    for edge in edges:
        names.add(edge.name)
        letters.add(words.symbol(edge.name, bar=True))


def _laid(step: Step, tail: str) -> bool:
    return step.verb in ("lay", "back", "chain") and step.operands[0] == tail


def _first(every: Iterable[Told], steps: int) -> Iterator[Told]:
    """Go through the steps that are done: those that set the drawing up, and so many that the note tells."""
    done = 0
    for told in every:
        done += told.counted
        if done <= steps or not told.counted:
            yield told
