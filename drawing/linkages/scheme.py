"""The plan of the mechanism: links, pairs and guides to scale, the construction of its joints, the driver's angle."""

from __future__ import annotations

import math
from cmath import phase, rect
from collections.abc import Sequence

from ...plans.board import POSITION, Step
from ...plans.linkages.mechanism import FRAME, ZERO, Driver, Prismatic, SlidingDriver
from ..shapes import Arc, Arrow, Line, Pen
from ..symbols import angle_dimension, slider_up, turning_arrow
from ..view import Canvas, View
from .letters import guide_letters
from .links import draw_frame, draw_links, foot_of, letter_links
from .reach import guide_name
from .scene import Scene
from .senses import senses
from .skeleton import Skeleton, guide_of, spread_of

PAST = 16.0  # mm by which the axis of a guide runs past its slider and a pivot
FARTHEST = 40.0  # mm from the pivot at which the arrow of omega_1 stands
CROSS = 8.0  # mm by which arcs and lines run past the joint that they find


def scheme(scene: Scene) -> View:
    """Draw the plan of the mechanism in the given position."""
    canvas = Canvas(scene.style)
    numbers = [link.number for link in scene.solved.mechanism.links]
    _axes(canvas, scene)
    for step in scene.solved.program.on(POSITION):
        _construction(canvas, scene, step)
    figures = draw_links(canvas, scene, numbers)
    senses(canvas, scene)
    draw_frame(canvas, scene, numbers, figures)
    driver = scene.solved.mechanism.driver
    if isinstance(driver, Driver):
        _angle(canvas, scene, driver, figures)
    else:
        _speed(canvas, scene, driver)
    _frame_number(canvas, scene, figures)
    _moving_guides(canvas, scene, figures)
    letter_links(canvas, scene, numbers, figures)
    return canvas.finish("position", scene.heading("heading.position", "position"))


def _axes(canvas: Canvas, scene: Scene) -> None:
    """Draw the axes of the frame's guides: past the slider, and past a pivot that is near the same line."""
    pivots = [scene.mm(point) for point in scene.solved.mechanism.frame_points]
    pairs = [p for p in scene.solved.mechanism.pairs if isinstance(p, Prismatic) and FRAME in p.links]
    letters, per_mm = guide_letters(scene.solved.program), 1.0 / scene.scales[POSITION].mu
    for pair in pairs:
        at, u, name = scene.mm(pair.point), guide_of(scene, pair), guide_name(scene.solved, pair)
        feet = [(pivot - at) / u for pivot in pivots]
        near = [foot.real for foot in feet if abs(foot.imag) < 0.3 * abs(foot.real)]
        way = near[:1] or [end * per_mm for end in scene.reaches.get(name, ())]
        line = at + u * (min(0.0, *way) - PAST), at + u * (max(0.0, *way) + PAST)
        canvas.add(Line(*line, Pen.AXIS))
        # at the pivot's end, where there is no guide, unless other axes meet there
        choose = max if len(pairs) == 1 else min
        far = choose(line, key=lambda end: abs(end - at))
        canvas.label(letters.get(name, ""), far, clear=1.0, prefer=-slider_up(u))


def _moving_guides(canvas: Canvas, scene: Scene, figures: Sequence[Skeleton]) -> None:
    """Letter the guides of moving links that have letters: those that no two pins name."""
    letters = guide_letters(scene.solved.program)
    for pair in (p for p in scene.solved.mechanism.pairs if isinstance(p, Prismatic) and FRAME not in p.links):
        letter = letters.get(guide_name(scene.solved, pair))
        figure = next(figure for figure in figures if figure.number == pair.links[1])
        u = guide_of(scene, pair)
        ends = [end for stroke in figure.guides for end in stroke if abs(((end - scene.mm(pair.point)) / u).imag) < 0.1]
        if letter and ends:
            far = max(ends, key=lambda end: (min(abs(end - pin) for pin in (*figure.pins, 1e9 + 0j)), end.real))
            canvas.label(letter, far, clear=1.0)


def _construction(canvas: Canvas, scene: Scene, step: Step) -> None:
    """Draw the arcs of the compass, or the lines, that cross at a joint."""
    if step.name.startswith("_"):
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
    canvas.add(Line(at - e * (way if abs(way) > 2 * CROSS else past), at + e * past, Pen.AXIS, role="construction", name=name))


def _arc(canvas: Canvas, scene: Scene, centre: str, point: str, past: float, name: str) -> None:
    """Draw an arc about one joint through another, `past` it on both sides."""
    way = scene.mm(point) - scene.mm(centre)
    spread = 2 * past / abs(way)
    canvas.add(Arc(scene.mm(centre), abs(way), phase(way) - spread / 2, spread, Pen.THIN, role="construction", name=name))


def _touched(canvas: Canvas, scene: Scene, step: Step) -> None:
    """Draw the circle that the guide of a rocking link touches when it does not run through the link's pivot."""
    centre, point, offset, _ = step.operands
    radius = abs(scene.solved.values[offset]) / scene.scales[POSITION].mu
    if radius > scene.style.pair:
        u = scene.solved.point(step.name)
        side = math.copysign(1.0, scene.solved.values[offset]) * 1j * u
        start, sweep = phase(side) - 0.7, 1.4
        canvas.add(Arc(scene.mm(centre), radius, start, sweep, Pen.THIN, role="construction", name=f"arc_{point}"))


def _angle(canvas: Canvas, scene: Scene, driver: Driver, figures: Sequence[Skeleton]) -> None:
    """Dimension phi from the axis x, and draw the arrows of omega_1 and epsilon_1 on the other side."""
    o, style, words = scene.mm(driver.pivot), scene.style, scene.words
    crank_mm = abs(scene.mm(driver.point) - o)
    phi = math.remainder(scene.solved.values[driver.angle], 2 * math.pi)
    phi = phi + 2 * math.pi if phi < -1e-12 else phi
    text = f"{words.symbol(driver.angle)} = {words.short(round(math.degrees(phi), 9))}°"
    radius = max(0.45 * crank_mm, 9.0)
    canvas.add(Line(o + style.pair, o + max(crank_mm, radius + 6.0) * 1.1, Pen.THIN, role="zero-direction"))
    if phi > 0.05:
        canvas.add(angle_dimension(o, radius, 0.0, phi, driver.angle, style))
        middle = o + rect(radius, min(phi / 2, 1.2))
        canvas.label(text, middle, prefer=rect(1.0, phi / 2), clear=1.2)
    else:
        canvas.label(text, o + radius, prefer=1j, clear=1.2)
    omega = scene.solved.values.get(f"omega_{driver.link}")
    sense = math.copysign(1.0, omega) if omega else scene.solved.values[driver.sense]
    radius = min(crank_mm * 0.78, FARTHEST) if crank_mm > 24.0 else radius + 5.0
    middle = phi + math.pi * 0.78 if phi < math.pi else phi / 2 + math.pi * 0.86
    busy = _busy(scene, o, phi, figures)
    arrows = [(f"omega_{driver.link}", sense)]
    epsilon = scene.solved.values.get(f"epsilon_{driver.link}")
    if epsilon:
        arrows.append((f"epsilon_{driver.link}", math.copysign(1.0, epsilon)))
    for name, turn in arrows:
        middle = _free(busy, middle)
        canvas.add(turning_arrow(o, radius, middle, 1.0, turn, name))
        canvas.label(words.symbol(name), o + rect(radius, middle), prefer=rect(1.0, middle))
        busy += [rect(1.0, middle + k * 0.5) for k in (-1, 0, 1)]


def _busy(scene: Scene, o: complex, phi: float, figures: Sequence[Skeleton]) -> list[complex]:
    """Return the directions from the pivot in which there is something: links, the angle, the foot."""
    driver = scene.solved.mechanism.driver
    foot = foot_of(scene, driver.pivot, figures) if isinstance(driver, Driver) else -1j
    busy = [rect(1.0, phi), rect(1.0, phi / 2), foot, 1.0 + 0j]
    for figure in figures:
        for a, b in figure.strokes:
            for k in (0.0, 0.25, 0.5, 1.0):
                at = a + (b - a) * k - o
                if abs(at) > 1.0:
                    busy.append(at / abs(at))
    return busy


def _free(busy: list[complex], wanted: float) -> float:
    """Choose the direction for a turning arrow that is farthest from all else."""

    def room(angle: float) -> float:
        return min(spread_of(rect(1.0, angle), other) for other in busy)

    return max((wanted, *(k * math.pi / 12 for k in range(24))), key=lambda angle: (round(room(angle), 6), -angle))


def _speed(canvas: Canvas, scene: Scene, driver: SlidingDriver) -> None:
    """Draw the arrow of the speed of a driver that slides, beside its block."""
    pair = next(p for p in scene.solved.mechanism.pairs if isinstance(p, Prismatic) and driver.link in p.links)
    at, u = scene.mm(pair.point), guide_of(scene, pair)
    speed = scene.solved.values[driver.speed]
    if speed:
        up, e = slider_up(u), u * math.copysign(1.0, speed)
        tail = at + up * (scene.style.slider[1] / 2 + 3.0) - e * (0.3 * scene.style.force)
        canvas.add(Arrow(tail, tail + e * 0.6 * scene.style.force, Pen.THIN, name=driver.speed))
        canvas.label(scene.words.symbol(f"V_{driver.point}", bar=True), (tail, tail + e * 0.6 * scene.style.force))


def _frame_number(canvas: Canvas, scene: Scene, figures: Sequence[Skeleton]) -> None:
    """Letter the frame 0, once, beside the hatching of the driver's pivot or guide; keep letters off the hatching."""
    mechanism, style = scene.solved.mechanism, scene.style
    driver, zero = mechanism.driver, scene.words.frame
    for pair in mechanism.pairs:
        if isinstance(pair, Prismatic) and FRAME in pair.links:
            at, u = scene.mm(pair.point), guide_of(scene, pair)
            length, height = style.slider
            below = -slider_up(u)
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
