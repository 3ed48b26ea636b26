"""A plan of velocities, accelerations or forces: the recorded steps, drawn."""

from __future__ import annotations

from dataclasses import replace

from ....plans.board import Step
from ....plans.names import FORCES, role
from ...shapes import Line, Pen
from ...view import Canvas, View
from ..marks import letter_marks, symbol, vectors_of
from ..scene import Scene, plan_heading
from .flat import said_flat
from .force_plan import ForcePlan, construction_line, in_inset
from .inset import with_insets
from .similarity import draw_sides

SHORT = 2.0  # mm below which a vector cannot be drawn as an arrow


def plan_view(scene: Scene, plan: str) -> View:
    """Draw a plan from the steps that made it: construction lines, vectors, letters; of forces also insets."""
    canvas = Canvas(scene.style)
    steps = scene.solved.program.on(plan)
    vectors = vectors_of(steps)
    forces = ForcePlan(scene, plan)
    shown = forces.windows() if role(plan).kind == FORCES else []
    left = [ends for ends in vectors if not in_inset(scene, shown, (scene.mm(ends[1]), scene.mm(ends[2])))]
    _construction(canvas, scene, steps)
    draw_sides(canvas, scene, plan, [(scene.mm(tail), scene.mm(tip)) for _, tail, tip in vectors])
    _vectors(canvas, scene, vectors, left)
    ends = {mark for _, *marks in left for mark in marks}
    _letters(canvas, scene, plan, [tip for _, _, tip in vectors if tip in ends])
    heading = plan_heading(scene.words, scene.solved.structure, plan), scene.words.scale(scene.scales[plan])
    notes = *_said(scene, plan, left), *forces.said(shown)
    return with_insets(canvas, plan, heading, notes, [(forces, window) for window in shown])


def _construction(canvas: Canvas, scene: Scene, steps: tuple[Step, ...]) -> None:
    """Draw the two lines of each meeting, both running past the point where they meet."""
    for step in steps:
        if step.verb == "meet":
            p, u, q, w = step.operands
            for i, (start, direction) in enumerate(((p, u), (q, w))):
                begin, _, end = construction_line(scene, step, start, direction)
                canvas.add(Line(begin, end, Pen.DASHED, role="construction", name=f"{step.name}_{i + 1}"))


def _vectors(
    canvas: Canvas, scene: Scene, vectors: list[tuple[str, str, str]], lettered: list[tuple[str, str, str]]
) -> None:
    """Draw the vectors, with letters those to be lettered that are long enough."""
    named: dict[frozenset[complex], None] = {}
    shared = {(tail, tip): [name for name, *ends in vectors if ends == [tail, tip]] for _, tail, tip in vectors}
    for quantity, tail, tip in vectors:
        vector = scene.vector(quantity, tail, tip)
        short = abs(vector.tip - vector.tail) < SHORT
        # an arrowhead would be longer than the vector
        canvas.add(replace(vector, head="none") if short else vector)
        ends = frozenset((_rounded(vector.tail), _rounded(vector.tip)))
        if short or (quantity, tail, tip) not in lettered:
            continue  # said in words under the heading, or lettered in an inset
        names = list(dict.fromkeys(shared[tail, tip]))
        if quantity != names[0]:
            continue  # its letter stands beside that of the first of them
        across = 1j * (vector.tip - vector.tail)
        # the first of two vectors on one line has its letter above it or to the right
        side = (-across if (across / (0.3 + 1j)).real > 0 else across) if ends in named else 0j
        named[ends] = None
        text = " = ".join(symbol(scene, name) for name in names)
        ends_of = f"{text} = {scene.words.mark(tail)}{scene.words.mark(tip)}"
        canvas.label(text, (vector.tail, vector.tip), prefer=side, clear=0.9, strict=True, spare=ends_of)


def _letters(canvas: Canvas, scene: Scene, plan: str, tips: list[str]) -> None:
    """Letter the pole and these ends of vectors."""
    steps = scene.solved.program.on(plan)
    poles = [step.name for step in steps if step.verb == "pole"]
    letter_marks(canvas, scene, {mark: scene.words.mark(mark) for mark in (*poles, *tips)}, poles)


def _said(scene: Scene, plan: str, vectors: list[tuple[str, str, str]]) -> list[str]:
    """Say in words what is too short for an arrow."""
    lines = [*said_flat(scene, plan)]
    for quantity, tail, tip in dict.fromkeys(vectors):
        length = abs(scene.mm(tip) - scene.mm(tail))
        if length < 1e-6:
            lines.append(scene.words["said.zero"].format(vector=symbol(scene, quantity)))
        elif length < SHORT:
            lines.append(
                scene.words["said.short"].format(vector=symbol(scene, quantity), mm=scene.words.number(length, 2))
            )
    return lines


def _rounded(point: complex) -> complex:
    return complex(round(point.real, 3), round(point.imag, 3))
