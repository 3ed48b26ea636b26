"""The plan of the mechanism: links, pairs, guides, how joints are found, the angle or the speed of the driver."""

from __future__ import annotations

import math
from cmath import phase, rect
from collections.abc import Iterable, Sequence

from ....plans.board import POSITION, Step
from ....plans.linkages.legs import guide_letters
from ....plans.linkages.mechanism import FRAME, ZERO, Driver, Prismatic
from ....plans.names import role
from ...figure import ANSWERS, GIVEN
from ...shapes import Arc, Arrow, Line, Pen
from ...symbols import angle_dimension
from ...view import Canvas, View
from ..scene import Scene
from .arcs import senses, turning_of_driver
from .links import Skeleton, draw_links, foot_of, guide_of, guide_up, letter_links, letter_point, skeleton
from .plan import draw_sides, said_flat

FAR = 40.0  # mm from the pivot at which the arrow of omega_1 stands
PAST = 16.0  # mm by which the axis of a guide runs past its slider and a pivot
LEAVES, LONGEST = 1.6, 34.0  # mm by which the end of an arc leaves its tangent, unless the arc would be too long
CROSS = 8.0  # mm by which arcs and lines run past the joint that they find


def scheme(scene: Scene) -> View:
    """Draw the plan of the mechanism in the given position."""
    canvas, driver = scene.canvas(), scene.mechanism.driver
    canvas.part(GIVEN)
    _axes(canvas, scene)
    for step in scene.program.on(POSITION):
        if step.name in scene.points or step.verb == "tangent":
            _found_by(canvas, scene, step)
    special_points(canvas, scene)
    draw_sides(canvas, scene, POSITION, [stroke for n in scene.numbers for stroke in skeleton(scene, n).strokes])
    figures = draw_links(canvas, scene, scene.numbers)
    canvas.part(driver.point)
    if isinstance(driver, Driver):
        _angle(canvas, scene, driver)
    elif speed := scene.values[driver.speed]:
        canvas.part(ANSWERS)
        pair = scene.sliding(driver.link)[0]
        up, e = guide_up(scene, pair), guide_of(scene, pair) * math.copysign(1.0, speed)
        tail = scene.mm(pair.point) + up * (scene.style.slider[1] / 2 + 3.0) - e * (0.3 * scene.style.force)
        tip = tail + e * 0.6 * scene.style.force
        canvas.add(Arrow(tail, tip, name=driver.speed))
        canvas.label(scene.letter(f"V_{driver.point}"), (tail, tip))
    senses(canvas, scene, figures)
    canvas.part(GIVEN)
    _letter_frame(canvas, scene, figures)
    letter_links(canvas, scene, figures)
    return canvas.finish("position", scene.heading("heading.position", "position"), tuple(said_flat(scene, POSITION)))


def _angle(canvas: Canvas, scene: Scene, driver: Driver) -> None:
    """Dimension phi from the axis x, and draw the arrows of omega_1 and epsilon_1 on the other side."""
    o, style = scene.mm(driver.pivot), scene.style
    crank_mm = abs(scene.mm(driver.point) - o)
    phi = math.remainder(scene.values[driver.angle], 2 * math.pi)
    phi = phi + 2 * math.pi if phi < -1e-12 else phi
    text = f"{scene.words.symbol(driver.angle)} = {scene.words.short(round(math.degrees(phi), 9))}°"
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


def _letter_frame(canvas: Canvas, scene: Scene, figures: Sequence[Skeleton]) -> None:
    """Letter the frame 0, once, beside the hatching of the driver's pivot or guide; keep letters off the hatching.

    The guides of moving links, too, have their letters: those that no two pins name.
    """
    mechanism, style, zero = scene.mechanism, scene.style, scene.words.frame
    driver, letters = mechanism.driver, guide_letters(scene.program)
    for pair in scene.sliding():
        u, (length, height) = guide_of(scene, pair), style.slider
        edge = scene.mm(pair.point) - guide_up(scene, pair) * (height / 2 + style.hatch[0])
        at = scene.mm(pair.point)
        canvas.keep_clear(*(at + u * (s * length * 1.1) for s in (-1, 1)), edge - u * length, edge + u * length)
        if pair.links[0] == driver.link:
            canvas.label(zero, edge + u * length, prefer=u)
    if isinstance(driver, Driver):
        pivot, down = scene.mm(driver.pivot), foot_of(scene, driver.pivot, figures)
        foot, crank = pivot + down * (style.pivot[1] + style.pair), scene.mm(driver.point) - pivot
        base, across = style.pivot[2], 1j * down * (-1.0 if crank.real > 0 > crank.imag else 1.0)
        canvas.label(zero, foot + across * base / 2 + down * 0.5 * style.hatch[0], prefer=across)
    for pair in (pair for pair in mechanism.pairs if isinstance(pair, Prismatic) and FRAME not in pair.links):
        letter, u, at = letters.get(scene.solved.guide_name(pair)), guide_of(scene, pair), scene.mm(pair.point)
        figure = next(figure for figure in figures if figure.number == pair.links[1])
        ends = [end for stroke in figure.guides for end in stroke if abs(((end - at) / u).imag) < 0.1]
        if letter and ends:
            far = max(ends, key=lambda end: (min(abs(end - pin) for pin in (*figure.pins, 1e9 + 0j)), end.real))
            canvas.label(letter, far)


def _axes(canvas: Canvas, scene: Scene) -> None:
    """Draw the axes of the frame's guides: past the slider, and past a pivot that is near the same line."""
    pairs = scene.sliding()
    joints = {scene.mm(pair.point) for pair in scene.mechanism.pairs}  # near them is the less room for a letter
    letters = guide_letters(scene.program)
    for pair in pairs:
        at, u = scene.mm(pair.point), guide_of(scene, pair)
        feet = [(scene.mm(point) - at) / u for point in scene.mechanism.frame_points]
        near = [foot.real for foot in feet if abs(foot.imag) < 0.3 * abs(foot.real)]
        way = near[:1] or scene.run_of(pair)
        line = at + u * (min(0.0, *way) - PAST), at + u * (max(0.0, *way) + PAST)
        canvas.add(Line(*line, Pen.AXIS))
        # of several axes the far ends meet at one pivot
        crowd = {end: len([joint for joint in joints if abs(joint - end) < 1.2 * scene.style.force]) for end in line}
        sign = 1.0 if len(pairs) > 1 else -1.0
        far = min(line, key=lambda end: (crowd[end], sign * abs(end - at)))
        canvas.label(letters.get(scene.solved.guide_name(pair), ""), far, prefer=-guide_up(scene, pair))


def _found_by(canvas: Canvas, scene: Scene, step: Step) -> None:
    """Draw the arcs of the compass, or the lines, that cross at a joint."""
    if role(step.name).hidden:
        return
    canvas.part(step.name)
    operands, arc, past = step.operands, f"arc_{step.name}", CROSS
    ways: list[tuple[str, str, str]] = []  # where an arc or a line comes from, the direction of a line, its name
    if step.verb == "arc":
        ways, past = [(operands[0], "", arc)], 1.2 * scene.style.slider[1] + 2.0
    elif step.verb == "arcs":
        ways = [(operands[0], "", f"{arc}_1"), (operands[2], "", f"{arc}_2")]
    elif step.verb == "template":  # the path that a leg leaves to its joint of the central link
        own, legs = operands[0], operands[-12:]  # joint on the template, start, radius, direction of each leg
        joint = next(i for i in (0, 4, 8) if legs[i] == own)
        start, radius, direction = legs[joint + 1 : joint + 4]
        ways = [(start, "", arc) if radius != ZERO else (start, direction, step.name)]
    elif step.verb == "meet":
        ways = [(operands[i], operands[i + 1], f"{step.name}_{i // 2 + 1}") for i in (0, 2)]
    elif step.verb == "tangent":
        centre, point, offset = operands[:3]
        radius = scene.values[offset] / scene.scales[POSITION].mu
        if abs(radius) > scene.style.pair:
            side = math.copysign(1.0, radius) * 1j * scene.solved.point(step.name)
            ends = phase(side) - 0.7, 1.4
            canvas.add(Arc(scene.mm(centre), abs(radius), *ends, role="construction", name=f"arc_{point}"))
    for start, direction, name in ways:
        at, way = scene.mm(step.name), scene.mm(step.name) - scene.mm(start)
        if direction:
            e = scene.solved.point(direction)
            along = (way / e).real
            beyond = math.copysign(2 * CROSS, along)
            start_at = at - e * (along if abs(along) > 2 * CROSS else beyond)
            canvas.add(Line(start_at, at + e * beyond, Pen.AXIS, role="construction", name=name))
        elif way:  # else the joints coincide on paper
            # a vector carried to the joint lies along the tangent: the arc must leave it before it ends
            reach = max(past, min(math.sqrt(2.0 * abs(way) * LEAVES), LONGEST))
            spread = min(2 * reach / abs(way), math.tau)
            ends = phase(way) - spread / 2, spread
            canvas.add(Arc(scene.mm(start), abs(way), *ends, role="construction", name=name))


def special_points(canvas: Canvas, scene: Scene, wanted: Iterable[str] | None = None) -> None:
    """Draw and letter the points of the plan that are no point of any link by right, with the lines that meet there.

    Such is the special point of a group of class III; without `wanted` all of them.
    """
    lettered = {*scene.points, *scene.mechanism.frame_points}
    for step in (step for step in scene.program.on(POSITION) if step.verb == "meet" and step.name not in lettered):
        if not role(step.name).hidden and (wanted is None or step.name in wanted):
            _found_by(canvas, scene, step)
            letter_point(canvas, scene, step.name)
