"""A plan of velocities, accelerations or forces: the recorded steps, drawn."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

from ...plans.board import Step
from ...plans.exact import SMALL
from ..shapes import Circle, Group, Line, Pen
from ..view import Canvas, View
from .scene import Scene
from .similarity import draw_sides

PAST = 6.0  # mm by which a construction line runs past the point that it finds
TOGETHER = 0.7  # mm within which marks share their letters: side by side they would cover one another
SHORT = 2.0  # mm below which a vector cannot be drawn as an arrow


def plan_view(scene: Scene, plan: str, key: str, **fill: str) -> View:
    """Draw a plan from the steps that made it: construction lines, vectors, letters."""
    canvas = Canvas(scene.style)
    steps = scene.solved.program.on(plan)
    vectors = vectors_of(steps)
    _construction(canvas, scene, steps)
    draw_sides(canvas, scene, plan, [(scene.mm(tail), scene.mm(tip)) for _, tail, tip in vectors])
    _vectors(canvas, scene, vectors)
    _letters(canvas, scene, plan, [tip for _, _, tip in vectors])
    return canvas.finish(plan, scene.heading(key, plan, **fill), tuple(_said(scene, plan, vectors)))


def vectors_of(steps: tuple[Step, ...]) -> list[tuple[str, str, str]]:
    """Return (quantity, tail, tip) of the vectors that the steps draw."""
    vectors = []
    for step in steps:
        if step.verb == "read":
            vectors.append((step.name, step.operands[0], step.operands[1]))
        elif step.verb == "chain":
            vectors.append((step.operands[1], step.operands[0], step.name))
    return vectors


def _construction(canvas: Canvas, scene: Scene, steps: tuple[Step, ...]) -> None:
    """Draw the two lines of each meeting, both running past the point where they meet."""
    for step in steps:
        if step.verb != "meet":
            continue
        p, u, q, w = step.operands
        end = scene.mm(step.name)
        for i, (start, direction) in enumerate(((p, u), (q, w))):
            e, tail = scene.solved.point(direction), scene.mm(start)
            along = ((end - tail) / e).real
            ends = (tail, end + e * PAST) if along > 0 else (tail, end - e * PAST)
            if abs(along) < PAST:
                ends = (end - e * 2 * PAST, end + e * 2 * PAST)
            canvas.add(Line(*ends, Pen.DASHED, role="construction", name=f"{step.name}_{i + 1}"))


def _vectors(canvas: Canvas, scene: Scene, vectors: list[tuple[str, str, str]]) -> None:
    named: dict[frozenset[complex], None] = {}
    shared = {(tail, tip): [name for name, *ends in vectors if ends == [tail, tip]] for _, tail, tip in vectors}
    for quantity, tail, tip in vectors:
        vector = scene.vector(quantity, tail, tip)
        short = abs(vector.tip - vector.tail) < SHORT
        # an arrowhead would be longer than the vector
        canvas.add(replace(vector, head="none") if short else vector)
        ends = frozenset((_rounded(vector.tail), _rounded(vector.tip)))
        if short:
            continue  # said in words under the heading
        names = list(dict.fromkeys(shared[tail, tip]))
        if quantity != names[0]:
            continue  # its letter stands beside that of the first of them
        across = 1j * (vector.tip - vector.tail)
        # the first of two vectors on one line has its letter above it or to the right
        side = (-across if (across / (0.3 + 1j)).real > 0 else across) if ends in named else 0j
        named[ends] = None
        text = " = ".join(_symbol(scene, name) for name in names)
        ends_of = f"{text} = {scene.words.mark(tail)}{scene.words.mark(tip)}"
        canvas.label(text, (vector.tail, vector.tip), prefer=side, clear=0.9, strict=True, spare=ends_of)


def _symbol(scene: Scene, quantity: str) -> str:
    return scene.words.symbol(quantity.removeprefix("_"), bar=True)


def _letters(canvas: Canvas, scene: Scene, plan: str, tips: list[str]) -> None:
    """Letter the pole and every mark at which a vector ends."""
    steps = scene.solved.program.on(plan)
    poles = [step.name for step in steps if step.verb == "pole"]
    letter_marks(canvas, scene, {mark: scene.words.mark(mark) for mark in (*poles, *tips)}, poles)


def letter_marks(
    canvas: Canvas,
    scene: Scene,
    letters: Mapping[str, str],
    poles: Sequence[str],
    place_of: Callable[[Scene, str], complex] = Scene.mm,
) -> None:
    """Draw poles and points with their letters outside of the figure; marks that coincide share one letter."""
    places = {mark: place_of(scene, mark) for mark in letters}
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


def _said(scene: Scene, plan: str, vectors: list[tuple[str, str, str]]) -> list[str]:
    """Say in words what is too short for an arrow."""
    lines = []
    for mark, sine in scene.solved.sines.items():
        if mark.startswith(f"{plan}.") and sine < SMALL:
            angle = scene.words.short(math.degrees(math.asin(sine)), 3)
            loss = scene.words.short(1.0 / sine, 3)
            lines.append(scene.words["said.ill"].format(point=scene.words.mark(mark), angle=angle, loss=loss))
    for quantity, tail, tip in dict.fromkeys(vectors):
        length = abs(scene.mm(tip) - scene.mm(tail))
        if length < 1e-6:
            lines.append(scene.words["said.zero"].format(vector=_symbol(scene, quantity)))
        elif length < SHORT:
            lines.append(
                scene.words["said.short"].format(vector=_symbol(scene, quantity), mm=scene.words.number(length, 2))
            )
    return lines


def _rounded(point: complex) -> complex:
    return complex(round(point.real, 3), round(point.imag, 3))
