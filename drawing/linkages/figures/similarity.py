"""Similar figures: the sides of each triangle that the theorem of similarity names, on a plan and on the mechanism."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from ....plans.board import POSITION, Program
from ....plans.names import POLE, role
from ...shapes import Line, Pen
from ...view import Canvas
from ..reading import read
from ..scene import Scene
from ..skeleton import NEAR, Stroke

Triangle = tuple[str, str, str]


def triangles(program: Program, plan: str) -> Iterator[Triangle]:
    """Go through the marks of each triangle of a plan that is similar to one of a link."""
    for step in program.on(plan):
        if step.verb == "similar":
            yield (step.operands[0], step.operands[1], step.name)


def on_link(program: Program, triangle: Triangle) -> Triangle:
    """Return the points of the link to whose triangle that of a plan is similar.

    At the pole stands a pivot of the frame: its letter is that of the same step on the plan of the mechanism.
    """
    start, end, mark = triangle
    point = role(mark).of
    own = read(program).made[point].operands
    first, second = (own[i] if role(m).kind == POLE else role(m).of for i, m in enumerate((start, end)))
    return first, second, point


def draw_sides(canvas: Canvas, scene: Scene, plan: str, drawn: Iterable[Stroke]) -> None:
    """Draw thin the sides of the triangles on a plan that no line of `drawn` shows, and a'b' where a point divides it.

    On the plan of the mechanism the triangles are those of its links.
    """
    program, lines = scene.solved.program, list(drawn)
    if plan == POSITION:
        figures: list[tuple[str, ...]] = [on_link(program, found) for found in triangles(program, "velocity")]
    else:
        figures = [*triangles(program, plan)]
        figures += [step.operands[:2] for step in program.on(plan) if step.verb == "divide"]
    for marks in figures:
        for i, first in enumerate(marks[1:], 1):
            for second in marks[:i]:
                side = scene.mm(second), scene.mm(first)
                if abs(side[1] - side[0]) > NEAR and not any(_covers(line, side) for line in lines):
                    canvas.add(Line(*side, Pen.THIN, role="similarity", name=f"{second} {first}"))
                    lines.append(side)


def _covers(line: Stroke, side: Stroke) -> bool:
    """Whether a drawn line runs along the whole of a side."""
    start, way = line[0], line[1] - line[0]
    if abs(way) < NEAR:
        return False
    feet = [(end - start) / way for end in side]
    spare = NEAR / abs(way)
    return all(abs(foot.imag) < spare and -spare < foot.real < 1.0 + spare for foot in feet)
