"""A plan of velocities, accelerations or forces: the recorded steps, drawn."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence

from ....plans.board import POSITION
from ....plans.boards.exact import ILL, SMALL
from ....plans.names import role
from ....plans.quantities import intersections, pins_together, point_of
from ...shapes import Line, Pen
from ...view import Canvas, View
from ..reading import Edge
from ..scene import Scene, plan_heading
from .inset import NUMERALS, Plan, construction_line, headed, in_inset, length_of, letter_marks, with_insets
from .links import NEAR, Stroke

SHORT = 2.0  # mm below which a vector cannot be drawn as an arrow
LARGE = 1e4  # above it a number is written with a power of ten


def plan_view(scene: Scene, plan: str) -> View:
    """Draw a plan from the steps that made it: construction lines, vectors, letters; of forces also insets."""
    canvas, words = scene.canvas(), scene.words
    vectors, forces = scene.reading.on(plan), Plan(scene, plan)
    shown = forces.windows()
    left = [edge for edge in vectors if not in_inset(scene, shown, scene.ends(edge))]
    for step, number, start, direction in scene.reading.meetings(plan):
        begin, _, end = construction_line(scene, step, start, direction)
        canvas.part(step.name)
        canvas.add(Line(begin, end, Pen.DASHED, role="construction", name=f"{step.name}_{number}"))
    draw_sides(canvas, scene, plan, map(scene.ends, vectors))
    _vectors(canvas, scene, vectors, left)
    ends, poles = {mark for edge in left for mark in (edge.tail, edge.tip)}, forces.poles()
    marks = *poles, *(edge.tip for edge in vectors if edge.tip in ends)
    letter_marks(canvas, scene, {m: words.mark(m) for m in marks}, {m: scene.mm(m) for m in marks}, poles)
    notes = [*said_flat(scene, plan)]
    for vector in map(scene.vector, dict.fromkeys(left)):
        if (length := length_of(vector)) < SHORT:
            short = words["said.zero" if length < 1e-6 else "said.short"]
            notes.append(short.format(vector=scene.letter(vector.quantity), mm=words.number(length, 2)))
    for numeral, window in zip(NUMERALS, shown, strict=False):
        if symbols := dict.fromkeys(map(scene.letter, forces.read_in(window))):
            notes.append(words["said.inset"].format(vectors=", ".join(symbols), inset=numeral))
    heading = plan_heading(words, scene.solved.structure, plan), words.scale(scene.scales[plan])
    return with_insets(canvas, plan, heading, tuple(notes), [(forces, window) for window in shown])


def _vectors(canvas: Canvas, scene: Scene, vectors: Sequence[Edge], lettered: Sequence[Edge]) -> None:
    named = set[frozenset[complex]]()
    for edge in vectors:
        vector = scene.vector(edge)
        canvas.part(scene.reading.drawn_with(edge))
        canvas.add(headed(vector, SHORT))  # else an arrowhead would be longer than the vector
        names = list(dict.fromkeys(other.name for other in vectors if (other.tail, other.tip) == (edge.tail, edge.tip)))
        # others are told in words under the heading, lettered in an inset, or beside the first of them
        if length_of(vector) < SHORT or edge not in lettered or edge.name != names[0]:
            continue
        across = 1j * (vector.tip - vector.tail)
        ends = frozenset(complex(round(at.real, 3), round(at.imag, 3)) for at in (vector.tail, vector.tip))
        # the first of two vectors on one line has its letter above it or to the right
        side = (-across if (across / (0.3 + 1j)).real > 0 else across) if ends in named else 0j
        named.add(ends)
        text = " = ".join(map(scene.letter, names))
        ends_of = f"{text} = {scene.words.mark(edge.tail)}{scene.words.mark(edge.tip)}"
        canvas.label(text, (vector.tail, vector.tip), prefer=side, clear=0.9, strict=True, spare=ends_of)


def draw_sides(canvas: Canvas, scene: Scene, plan: str, drawn: Iterable[Stroke]) -> None:
    """Draw thin the sides of the triangles on a plan that no line of `drawn` shows, and a'b' where a point divides it.

    On the plan of the mechanism the triangles are those of its links.
    """
    reading, lines = scene.reading, list(drawn)
    if plan == POSITION:
        figures: list[tuple[str, ...]] = [*map(reading.on_link, reading.triangles("velocity"))]
    else:
        divided = (step.operands[:2] for step in scene.program.on(plan) if step.verb == "divide")
        figures = [*reading.triangles(plan), *divided]
    for first, second in ((a, b) for marks in figures for i, a in enumerate(marks) for b in marks[:i]):
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
        numbers = {**_meeting(scene, mark, sine), "quantity": symbol(quantity), "condition": _large(scene, condition)}
        if pins := pins_together(solved.program, solved.values, mark):
            yield words["said.ill_pins"].format(first=words.mark(pins[0]), second=words.mark(pins[1]))
        else:
            yield words["said.ill_position"].format(**numbers)
        yield words["said.ill_growth"].format(**numbers)


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
