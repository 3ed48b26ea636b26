"""Marks of a plan: poles, points, their letters outside of the figure, and the vectors between them."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from ...plans.board import Step
from ...plans.names import role
from ..shapes import Circle, Group, Pen
from ..view import Canvas
from .scene import Scene

TOGETHER = 0.7  # mm within which marks share their letters: side by side they would cover one another


def letter_marks(
    canvas: Canvas,
    scene: Scene,
    letters: Mapping[str, str],
    poles: Sequence[str],
    place_of: Callable[[Scene, str], complex] = Scene.mm,
) -> None:
    """Draw poles and points with their letters outside of the figure; marks that coincide share one letter."""
    places = {mark: place_of(scene, mark) for mark in letters}
    if not places:
        return
    middle = sum(places.values()) / len(places)
    at: dict[complex, list[str]] = {}
    for mark, letter in letters.items():
        near = next((place for place in at if abs(place - places[mark]) < TOGETHER), places[mark])
        at.setdefault(near, []).append(letter)
    for mark in poles:
        canvas.add(Group((Circle(places[mark], scene.style.node, Pen.MAIN, fill="white"),), "point", mark))
    for place, names in at.items():
        canvas.label(", ".join(names), place, prefer=place - middle, clear=1.0, priority=1)
    for mark in letters:
        if mark not in poles:
            canvas.add(Group((Circle(places[mark], 0.3, Pen.THIN, fill="black"),), "point", mark))


def symbol(scene: Scene, quantity: str) -> str:
    """Return the symbol of a vector with its bar."""
    return scene.words.symbol(role(quantity).shown, bar=True)


def vectors_of(steps: tuple[Step, ...]) -> list[tuple[str, str, str]]:
    """Return (quantity, tail, tip) of the vectors that the steps draw."""
    drawn = (step for step in steps if step.verb in ("read", "chain"))
    ends = ((step.name, *step.operands) if step.verb == "read" else (*step.operands[::-1], step.name) for step in drawn)
    return [(quantity, tail, tip) for quantity, tail, tip in ends]
