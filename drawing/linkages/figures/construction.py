"""How the joints of the plan were found: arcs of the compass, lines, special points, and the axes of guides."""

from __future__ import annotations

import math
from cmath import phase
from collections.abc import Iterable, Sequence

from ....plans.board import POSITION, Step
from ....plans.linkages.mechanism import FRAME, ZERO, Prismatic
from ....plans.names import role
from ...shapes import Arc, Circle, Group, Line, Pen
from ...view import Canvas
from ..letters import guide_letters
from ..scene import Scene
from ..skeleton import Skeleton, guide_of
from .guides import guide_up

PAST = 16.0  # mm by which the axis of a guide runs past its slider and a pivot
LEAVES, FARTHEST = 1.6, 34.0  # mm by which the end of an arc leaves its tangent, unless the arc would be too long
CROSS = 8.0  # mm by which arcs and lines run past the joint that they find


def axes(canvas: Canvas, scene: Scene) -> None:
    """Draw the axes of the frame's guides: past the slider, and past a pivot that is near the same line."""
    pivots = [scene.mm(point) for point in scene.solved.mechanism.frame_points]
    pairs = [p for p in scene.solved.mechanism.pairs if isinstance(p, Prismatic) and FRAME in p.links]
    letters, per_mm = guide_letters(scene.solved.program), 1.0 / scene.scales[POSITION].mu
    for pair in pairs:
        at, u, name = scene.mm(pair.point), guide_of(scene, pair), scene.solved.guide_name(pair)
        feet = [(pivot - at) / u for pivot in pivots]
        near = [foot.real for foot in feet if abs(foot.imag) < 0.3 * abs(foot.real)]
        way = near[:1] or [end * per_mm for end in scene.runs.get(name, ())]
        line = at + u * (min(0.0, *way) - PAST), at + u * (max(0.0, *way) + PAST)
        canvas.add(Line(*line, Pen.AXIS))
        # of several axes the far ends meet at one pivot
        far = min(line, key=lambda end: (len(_near(scene, end)), (1.0 if len(pairs) > 1 else -1.0) * abs(end - at)))
        canvas.label(letters.get(name, ""), far, clear=1.0, prefer=-guide_up(scene, pair))


def _near(scene: Scene, place: complex) -> set[complex]:
    """Return the joints near a place, which has the less room for a letter."""
    joints = {scene.mm(pair.point) for pair in scene.solved.mechanism.pairs}
    return {joint for joint in joints if abs(joint - place) < 1.2 * scene.style.force}


def moving_guides(canvas: Canvas, scene: Scene, figures: Sequence[Skeleton]) -> None:
    """Letter the guides of moving links that have letters: those that no two pins name."""
    letters = guide_letters(scene.solved.program)
    for pair in (p for p in scene.solved.mechanism.pairs if isinstance(p, Prismatic) and FRAME not in p.links):
        letter = letters.get(scene.solved.guide_name(pair))
        figure = next(figure for figure in figures if figure.number == pair.links[1])
        u = guide_of(scene, pair)
        ends = [end for stroke in figure.guides for end in stroke if abs(((end - scene.mm(pair.point)) / u).imag) < 0.1]
        if letter and ends:
            far = max(ends, key=lambda end: (min(abs(end - pin) for pin in (*figure.pins, 1e9 + 0j)), end.real))
            canvas.label(letter, far, clear=1.0)


def found_by(canvas: Canvas, scene: Scene, step: Step) -> None:
    """Draw the arcs of the compass, or the lines, that cross at a joint."""
    if role(step.name).hidden:
        return
    name = f"arc_{step.name}"
    if step.verb == "arc":
        _arc(canvas, scene, step.operands[0], step.name, 1.2 * scene.style.slider[1] + 2.0, name)
    elif step.verb == "arcs":
        _arc(canvas, scene, step.operands[0], step.name, CROSS, f"{name}_1")
        _arc(canvas, scene, step.operands[2], step.name, CROSS, f"{name}_2")
    elif step.verb == "template":
        _leg(canvas, scene, step)
    elif step.verb == "tangent":
        _touched(canvas, scene, step)
    elif step.verb == "meet":
        for i in (0, 2):
            start, direction = step.operands[i : i + 2]
            _line(canvas, scene, start, direction, step.name, f"{step.name}_{i // 2 + 1}")


def _leg(canvas: Canvas, scene: Scene, step: Step) -> None:
    """Draw the path that a leg leaves to its joint of the central link: an arc, or a line."""
    own, legs = step.operands[0], step.operands[-12:]  # joint on the template, start, radius, direction of each leg
    joint = next(i for i in (0, 4, 8) if legs[i] == own)
    start, radius, direction = legs[joint + 1 : joint + 4]
    if radius != ZERO:
        _arc(canvas, scene, start, step.name, CROSS, f"arc_{step.name}")
    else:
        _line(canvas, scene, start, direction, step.name, step.name)


def _line(canvas: Canvas, scene: Scene, start: str, direction: str, point: str, name: str) -> None:
    """Draw the line from a mark, along a direction, past the point that lies on it."""
    at, e = scene.mm(point), scene.solved.point(direction)
    way = ((at - scene.mm(start)) / e).real
    past = math.copysign(2 * CROSS, way)
    ends = at - e * (way if abs(way) > 2 * CROSS else past), at + e * past
    canvas.add(Line(*ends, Pen.AXIS, role="construction", name=name))


def _arc(canvas: Canvas, scene: Scene, centre: str, point: str, past: float, name: str) -> None:
    """Draw an arc about one joint through another, `past` it on both sides, and farther where it is nearly straight.

    A vector carried to the joint lies along the tangent: the arc must leave it before it ends.
    """
    way = scene.mm(point) - scene.mm(centre)
    if not way:  # the joints coincide on paper
        return
    past = max(past, min(math.sqrt(2.0 * abs(way) * LEAVES), FARTHEST))
    spread = min(2 * past / abs(way), math.tau)
    start = phase(way) - spread / 2
    canvas.add(Arc(scene.mm(centre), abs(way), start, spread, Pen.THIN, role="construction", name=name))


def _touched(canvas: Canvas, scene: Scene, step: Step) -> None:
    """Draw the circle that the guide of a rocking link touches when it does not run through the link's pivot."""
    centre, point, offset = step.operands[:3]
    radius = abs(scene.solved.values[offset]) / scene.scales[POSITION].mu
    if radius > scene.style.pair:
        u = scene.solved.point(step.name)
        side = math.copysign(1.0, scene.solved.values[offset]) * 1j * u
        start, sweep = phase(side) - 0.7, 1.4
        canvas.add(Arc(scene.mm(centre), radius, start, sweep, Pen.THIN, role="construction", name=f"arc_{point}"))


def special_points(canvas: Canvas, scene: Scene, wanted: Iterable[str] | None = None) -> None:
    """Draw and letter the points of the plan that are no point of any link by right, with the lines that meet there.

    Such is the special point of a group of class III; without `wanted` all of them.
    """
    mechanism = scene.solved.mechanism
    lettered = {point for link in mechanism.links for point in link.points} | {*mechanism.frame_points}
    for step in scene.solved.program.on(POSITION):
        if step.verb != "meet" or role(step.name).hidden or step.name in lettered:
            continue
        if wanted is None or step.name in wanted:
            found_by(canvas, scene, step)
            at = scene.mm(step.name)
            canvas.add(Group((Circle(at, scene.style.node, Pen.MAIN, fill="white"),), "point", step.name))
            canvas.label(scene.words.mark(step.name), at, clear=scene.style.node + 0.8)
