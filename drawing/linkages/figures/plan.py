"""A plan of velocities, accelerations or forces: the recorded steps, drawn."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace

from ....plans.board import POSITION
from ....plans.boards.exact import ILL, SMALL
from ....plans.names import FORCES, role
from ....plans.quantities import intersections, pins_together, point_of
from ...shapes import Line, Pen
from ...view import Canvas, View
from ..reading import Edge, meetings, on_link, triangles
from ..scene import Scene, plan_heading
from .inset import ForcePlan, construction_line, in_inset, letter_marks, with_insets
from .links import NEAR, Stroke

SHORT = 2.0  # mm below which a vector cannot be drawn as an arrow
LARGE = 1e4  # above it a number is written with a power of ten


def plan_view(scene: Scene, plan: str) -> View:
    """Draw a plan from the steps that made it: construction lines, vectors, letters; of forces also insets."""
    canvas = scene.canvas()
    vectors = scene.reading.on(plan)
    forces = ForcePlan(scene, plan)
    shown = forces.windows() if role(plan).kind == FORCES else []
    left = [edge for edge in vectors if not in_inset(scene, shown, scene.ends(edge))]
    for step, number, start, direction in meetings(scene.program.on(plan)):
        begin, _, end = construction_line(scene, step, start, direction)
        canvas.part(step.name)
        canvas.add(Line(begin, end, Pen.DASHED, role="construction", name=f"{step.name}_{number}"))
    draw_sides(canvas, scene, plan, map(scene.ends, vectors))
    _vectors(canvas, scene, vectors, left)
    ends = {mark for edge in left for mark in (edge.tail, edge.tip)}
    marks = *forces.poles(), *(edge.tip for edge in vectors if edge.tip in ends)
    letters = {mark: scene.words.mark(mark) for mark in marks}
    letter_marks(canvas, scene, letters, {mark: scene.mm(mark) for mark in marks}, forces.poles())
    heading = plan_heading(scene.words, scene.solved.structure, plan), scene.words.scale(scene.scales[plan])
    notes = *_said(scene, plan, left), *forces.said(shown)
    return with_insets(canvas, plan, heading, notes, [(forces, window) for window in shown])


def _vectors(canvas: Canvas, scene: Scene, vectors: Sequence[Edge], lettered: Sequence[Edge]) -> None:
    named: dict[frozenset[complex], None] = {}
    for edge in vectors:
        vector = scene.vector(edge)
        canvas.part(scene.reading.drawn_with(edge))
        short = abs(vector.tip - vector.tail) < SHORT
        # an arrowhead would be longer than the vector
        canvas.add(replace(vector, head="none") if short else vector)
        ends = frozenset(complex(round(at.real, 3), round(at.imag, 3)) for at in (vector.tail, vector.tip))
        if short or edge not in lettered:
            continue  # said in words under the heading, or lettered in an inset
        same = (other for other in vectors if (other.tail, other.tip) == (edge.tail, edge.tip))
        names = list(dict.fromkeys(other.name for other in same))
        if edge.name != names[0]:
            continue  # its letter stands beside that of the first of them
        across = 1j * (vector.tip - vector.tail)
        # the first of two vectors on one line has its letter above it or to the right
        side = (-across if (across / (0.3 + 1j)).real > 0 else across) if ends in named else 0j
        named[ends] = None
        text = " = ".join(scene.letter(name) for name in names)
        ends_of = f"{text} = {scene.words.mark(edge.tail)}{scene.words.mark(edge.tip)}"
        canvas.label(text, (vector.tail, vector.tip), prefer=side, clear=0.9, strict=True, spare=ends_of)


def _said(scene: Scene, plan: str, vectors: Iterable[Edge]) -> Iterator[str]:
    yield from said_flat(scene, plan)
    for edge in dict.fromkeys(vectors):
        tail, tip = scene.ends(edge)
        length = abs(tip - tail)
        if length < SHORT:
            said = scene.words["said.zero" if length < 1e-6 else "said.short"]
            yield said.format(vector=scene.letter(edge.name), mm=scene.words.number(length, 2))


def draw_sides(canvas: Canvas, scene: Scene, plan: str, drawn: Iterable[Stroke]) -> None:
    """Draw thin the sides of the triangles on a plan that no line of `drawn` shows, and a'b' where a point divides it.

    On the plan of the mechanism the triangles are those of its links.
    """
    program, lines = scene.program, list(drawn)
    if plan == POSITION:
        figures: list[tuple[str, ...]] = [on_link(program, found) for found in triangles(program, "velocity")]
    else:
        figures = [*triangles(program, plan)]
        figures += [step.operands[:2] for step in program.on(plan) if step.verb == "divide"]
    pairs = [(a, b) for marks in figures for i, a in enumerate(marks) for b in marks[:i]]
    for first, second in pairs:
        side = scene.mm(second), scene.mm(first)
        if abs(side[1] - side[0]) > NEAR and not any(_covers(line, side) for line in lines):
            canvas.part(scene.last((first, second)))
            canvas.add(Line(*side, Pen.THIN, role="similarity", name=f"{second} {first}"))
            lines.append(side)


def _covers(line: Stroke, side: Stroke) -> bool:
    way = line[1] - line[0]
    if abs(way) < NEAR:
        return False
    feet, spare = [(end - line[0]) / way for end in side], NEAR / abs(way)
    return all(abs(foot.imag) < spare and -spare < foot.real < 1.0 + spare for foot in feet)


def said_flat(scene: Scene, plan: str) -> Iterator[str]:
    """Say of each point of a plan whose lines meet flatly; in an ill-conditioned position of the worst one, with K."""
    solved, words = scene.solved, scene.words
    for mark, sine in solved.sines.items():
        if role(mark).plan == plan and ILL <= sine < SMALL and plan != POSITION:
            yield words["said.ill"].format(**_meeting(scene, mark, sine))
    if solved.status != "ill-conditioned":
        return
    here = {mark: sine for mark, sine in intersections(solved.program, solved.sines).items() if role(mark).plan == plan}
    mark, sine = min(here.items(), key=lambda item: item[1], default=("", 1.0))
    if 0.0 < sine < ILL:
        from ....plans.linkages.solved import worst_condition  # needs numpy, and few positions need it

        quantity, condition = worst_condition(solved, plan)
        symbol = words.mark if solved.quantities[quantity].kind == "point" else words.symbol
        said = {**_meeting(scene, mark, sine), "quantity": symbol(quantity), "condition": _large(scene, condition)}
        pins = pins_together(solved.program, solved.values, mark)
        if pins is None:
            yield words["said.ill_position"].format(**said)
        else:
            yield words["said.ill_pins"].format(first=words.mark(pins[0]), second=words.mark(pins[1]))
        yield words["said.ill_growth"].format(**said)


def _meeting(scene: Scene, mark: str, sine: float) -> dict[str, str]:
    """Return which point lines find, at which angle they meet, and by how much errors grow."""
    return {
        "point": scene.words.mark(point_of(scene.program, mark)),
        "angle": scene.words.short(math.degrees(math.asin(sine)), 3),
        "loss": _large(scene, 1.0 / sine),
    }


def _large(scene: Scene, value: float) -> str:
    if value < LARGE:
        return scene.words.short(float(f"{value:.3g}"))
    mantissa, _, power = f"{value:.1e}".partition("e")
    return f"{scene.words.decimal(mantissa)}·10^{{{int(power)}}}"
