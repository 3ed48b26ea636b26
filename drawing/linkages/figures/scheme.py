"""The plan of the mechanism: links, pairs and guides to scale, the construction of its joints, the driver's angle."""

from __future__ import annotations

import math
from cmath import phase, rect
from collections.abc import Iterable, Sequence

from ....plans.board import POSITION, Step
from ....plans.linkages.legs import guide_letters
from ....plans.linkages.mechanism import FRAME, ZERO, Driver, Prismatic, SlidingDriver
from ....plans.names import role
from ...figure import ANSWERS, GIVEN
from ...shapes import Arc, Arrow, Line, Pen
from ...symbols import angle_dimension, turning_arrow
from ...view import Canvas, View
from ..scene import Scene
from ..skeleton import Skeleton, guide_of, skeleton
from .links import draw_frame, draw_links, foot_of, guide_up, letter_links
from .plan import draw_sides, said_flat
from .senses import free_arc, obstacles, senses

FAR = 40.0  # mm from the pivot at which the arrow of omega_1 stands
PAST = 16.0  # mm by which the axis of a guide runs past its slider and a pivot
LEAVES, FARTHEST = 1.6, 34.0  # mm by which the end of an arc leaves its tangent, unless the arc would be too long
CROSS = 8.0  # mm by which arcs and lines run past the joint that they find


def scheme(scene: Scene) -> View:
    """Draw the plan of the mechanism in the given position."""
    canvas = scene.canvas()
    numbers = [link.number for link in scene.mechanism.links]
    canvas.part(GIVEN)
    axes(canvas, scene)
    points = {point for link in scene.mechanism.links for point in link.points}
    for step in scene.program.on(POSITION):
        if step.name in points or step.verb == "tangent":
            found_by(canvas, scene, step)
    special_points(canvas, scene)
    strokes = [stroke for number in numbers for stroke in skeleton(scene, number).strokes]
    draw_sides(canvas, scene, POSITION, strokes)
    figures = draw_links(canvas, scene, numbers)
    draw_frame(canvas, scene, numbers, figures)
    driver = scene.mechanism.driver
    canvas.part(driver.point)
    if isinstance(driver, Driver):
        _angle(canvas, scene, driver)
    else:
        _speed(canvas, scene, driver)
    senses(canvas, scene, figures)
    canvas.part(GIVEN)
    _frame_number(canvas, scene, figures)
    moving_guides(canvas, scene, figures)
    letter_links(canvas, scene, numbers, figures)
    return canvas.finish("position", scene.heading("heading.position", "position"), tuple(said_flat(scene, POSITION)))


def angle_said(scene: Scene, driver: Driver) -> tuple[float, str]:
    """Return the angle of the crank from the axis x, not negative, and what is written at it."""
    phi = math.remainder(scene.solved.values[driver.angle], 2 * math.pi)
    phi = phi + 2 * math.pi if phi < -1e-12 else phi
    return phi, f"{scene.words.symbol(driver.angle)} = {scene.words.short(round(math.degrees(phi), 9))}°"


def _angle(canvas: Canvas, scene: Scene, driver: Driver) -> None:
    """Dimension phi from the axis x, and draw the arrows of omega_1 and epsilon_1 on the other side."""
    o, style = scene.mm(driver.pivot), scene.style
    crank_mm = abs(scene.mm(driver.point) - o)
    phi, text = angle_said(scene, driver)
    radius = max(0.45 * crank_mm, 9.0)
    zero = o + max(crank_mm, radius + 6.0) * 1.1
    canvas.add(Line(o + style.pair, zero, Pen.THIN, role="zero-direction", name=driver.angle))
    if phi > 0.05:
        canvas.add(angle_dimension(o, radius, 0.0, phi, driver.angle, style))
        middle = o + rect(radius, min(phi / 2, 1.2))
        canvas.label(text, middle, prefer=rect(1.0, phi / 2), clear=1.2)
    else:
        canvas.label(text, o + radius, prefer=1j, clear=1.2)
    radius = min(crank_mm * 0.78, FAR) if crank_mm > 24.0 else radius + 5.0
    wanted = phi + math.pi * 0.78 if phi < math.pi else phi / 2 + math.pi * 0.86
    radii = tuple(radius * part for part in (1.0, 0.75, 1.3, 1.6))
    turning_of_driver(canvas, scene, driver, radii, 1.0, wanted)


def turning_of_driver(
    canvas: Canvas, scene: Scene, driver: Driver, radii: Sequence[float], spread: float, wanted: float
) -> None:
    """Draw the arrows of omega_1 and epsilon_1 about the pivot where there is room, near the direction `wanted`."""
    o, words = scene.mm(driver.pivot), scene.words
    canvas.part(ANSWERS)
    omega = scene.solved.values.get(f"omega_{driver.link}")
    sense = math.copysign(1.0, omega) if omega else scene.solved.values[driver.sense]
    arrows = [(f"omega_{driver.link}", sense)]
    epsilon = scene.solved.values.get(f"epsilon_{driver.link}")
    if epsilon:
        arrows.append((f"epsilon_{driver.link}", math.copysign(1.0, epsilon)))
    for name, turn in arrows:
        busy = list(obstacles(canvas.shapes))
        at, middle = free_arc(o, radii, spread, wanted, busy)
        canvas.add(turning_arrow(o, at, middle, spread, turn, name))
        canvas.label(words.symbol(name), o + rect(at, middle), prefer=rect(1.0, middle))


def _speed(canvas: Canvas, scene: Scene, driver: SlidingDriver) -> None:
    """Draw the arrow of the speed of a driver that slides, beside its block."""
    pair = next(p for p in scene.mechanism.pairs if isinstance(p, Prismatic) and driver.link in p.links)
    at, u = scene.mm(pair.point), guide_of(scene, pair)
    speed = scene.solved.values[driver.speed]
    if speed:
        canvas.part(ANSWERS)
        up, e = guide_up(scene, pair), u * math.copysign(1.0, speed)
        tail = at + up * (scene.style.slider[1] / 2 + 3.0) - e * (0.3 * scene.style.force)
        canvas.add(Arrow(tail, tail + e * 0.6 * scene.style.force, Pen.THIN, name=driver.speed))
        canvas.label(scene.words.symbol(f"V_{driver.point}", bar=True), (tail, tail + e * 0.6 * scene.style.force))


def _frame_number(canvas: Canvas, scene: Scene, figures: Sequence[Skeleton]) -> None:
    """Letter the frame 0, once, beside the hatching of the driver's pivot or guide; keep letters off the hatching."""
    mechanism, style = scene.mechanism, scene.style
    driver, zero = mechanism.driver, scene.words.frame
    for pair in mechanism.pairs:
        if isinstance(pair, Prismatic) and FRAME in pair.links:
            at, u = scene.mm(pair.point), guide_of(scene, pair)
            length, height = style.slider
            below = -guide_up(scene, pair)
            edge = at + below * (height / 2 + style.hatch[0])
            canvas.keep_clear(*(at + u * (s * length * 1.1) for s in (-1, 1)), edge - u * length, edge + u * length)
            if pair.links[0] == driver.link:
                canvas.label(zero, edge + u * length, prefer=u, clear=1.0)
    if isinstance(driver, Driver):
        pivot, down = scene.mm(driver.pivot), foot_of(scene, driver.pivot, figures)
        _, height, base = style.pivot
        foot = pivot + down * (height + style.pair)
        crank_to = scene.mm(driver.point) - pivot
        side = -1.0 if crank_to.real > 0 > crank_to.imag else 1.0
        across = 1j * down * side
        canvas.label(zero, foot + across * base / 2 + down * 0.5 * style.hatch[0], prefer=across, clear=1.0)


def axes(canvas: Canvas, scene: Scene) -> None:
    """Draw the axes of the frame's guides: past the slider, and past a pivot that is near the same line."""
    pivots = [scene.mm(point) for point in scene.mechanism.frame_points]
    pairs = [p for p in scene.mechanism.pairs if isinstance(p, Prismatic) and FRAME in p.links]
    joints = {scene.mm(pair.point) for pair in scene.mechanism.pairs}  # near them is the less room for a letter
    letters, per_mm = guide_letters(scene.program), 1.0 / scene.scales[POSITION].mu
    for pair in pairs:
        at, u, name = scene.mm(pair.point), guide_of(scene, pair), scene.solved.guide_name(pair)
        feet = [(pivot - at) / u for pivot in pivots]
        near = [foot.real for foot in feet if abs(foot.imag) < 0.3 * abs(foot.real)]
        way = near[:1] or [end * per_mm for end in scene.runs.get(name, ())]
        line = at + u * (min(0.0, *way) - PAST), at + u * (max(0.0, *way) + PAST)
        canvas.add(Line(*line, Pen.AXIS))
        # of several axes the far ends meet at one pivot
        crowd = {end: len([joint for joint in joints if abs(joint - end) < 1.2 * scene.style.force]) for end in line}
        sign = 1.0 if len(pairs) > 1 else -1.0
        far = min(line, key=lambda end: (crowd[end], sign * abs(end - at)))
        canvas.label(letters.get(name, ""), far, clear=1.0, prefer=-guide_up(scene, pair))


def moving_guides(canvas: Canvas, scene: Scene, figures: Sequence[Skeleton]) -> None:
    """Letter the guides of moving links that have letters: those that no two pins name."""
    letters = guide_letters(scene.program)
    for pair in (p for p in scene.mechanism.pairs if isinstance(p, Prismatic) and FRAME not in p.links):
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
    canvas.part(step.name)
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
    mechanism = scene.mechanism
    lettered = {point for link in mechanism.links for point in link.points} | {*mechanism.frame_points}
    for step in scene.program.on(POSITION):
        if step.verb != "meet" or role(step.name).hidden or step.name in lettered:
            continue
        if wanted is None or step.name in wanted:
            found_by(canvas, scene, step)
            at = scene.mm(step.name)
            canvas.add(scene.point(at, step.name))
            canvas.label(scene.words.mark(step.name), at, clear=scene.style.node + 0.8)
