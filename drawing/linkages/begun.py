"""What is drawn of a linkage's plans when only the first steps of each have been done."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from ...plans.board import POSITION, Step
from ...plans.linkages.legs import guide_letters
from ...plans.linkages.mechanism import Driver
from ..handouts.begun import Shown
from .figures.inset import NUMERALS
from .figures.scheme import angle_said
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
        driver = scene.solved.mechanism.driver
        if isinstance(driver, Driver) and driver.point in names:
            names.add(driver.angle)
            letters.add(angle_said(scene, driver)[1])
    # what is zero, or too short, is told when all is drawn, and drawn larger
    whole = len(every) <= steps
    letters |= set(NUMERALS) if whole else set()
    return Shown(frozenset(names), frozenset(letters), notes=whole, whole=whole)


def _add_mark(scene: Scene, step: Step, names: set[str], letters: set[str]) -> None:
    """Add what a step of a plan draws: its mark with the letter, its construction lines, its vector."""
    words = scene.words
    lines = (step.name, f"arc_{step.name}")
    names |= {*lines, *(f"{line}_{number}" for line in lines for number in (1, 2))}
    if step.verb == "read":
        same = [other.name for other in scene.solved.program.on(step.plan) if _same(other, step)]
        names |= set(same)
        letters |= {scene.letter(name) for name in same}
        return
    if step.verb != "tangent":
        letters.add(words.mark(step.name))
    edges = (e for e in read(scene.solved.program).on(step.plan) if e.tip == step.name and _laid(step, e.tail))
    for edge in edges:
        names.add(edge.name)
        letters.add(scene.letter(edge.name))


def _same(other: Step, step: Step) -> bool:
    """Whether a step measures the same vector: that of a point about another that rests, and that of the point."""
    return other.verb == "read" and other.operands == step.operands


def _laid(step: Step, tail: str) -> bool:
    return step.verb in ("lay", "back", "chain") and step.operands[0] == tail


def _first(every: Iterable[Told], steps: int) -> Iterator[Told]:
    """Go through the steps that are done: those that set the drawing up, and so many that the note tells."""
    return (told for number, told in enumerate(every, 1) if told.before or number <= steps)
