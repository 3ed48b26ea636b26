"""The plan of the mechanism: links, pairs and guides to scale, the construction of its joints, the driver's angle."""

from __future__ import annotations

import math
from cmath import rect
from collections.abc import Sequence

from ....plans.board import POSITION
from ....plans.linkages.mechanism import FRAME, Driver, Prismatic, SlidingDriver
from ...shapes import Arrow, Line, Pen
from ...symbols import angle_dimension, turning_arrow
from ...view import Canvas, View
from ..scene import Scene
from ..skeleton import Skeleton, guide_of, skeleton
from .arc_places import free_arc, obstacles
from .construction import axes, found_by, moving_guides, special_points
from .flat import said_flat
from .guides import guide_up
from .links import draw_frame, draw_links, foot_of, letter_links
from .senses import senses
from .similarity import draw_sides

FARTHEST = 40.0  # mm from the pivot at which the arrow of omega_1 stands


def scheme(scene: Scene) -> View:
    """Draw the plan of the mechanism in the given position."""
    canvas = Canvas(scene.style)
    numbers = [link.number for link in scene.solved.mechanism.links]
    axes(canvas, scene)
    points = {point for link in scene.solved.mechanism.links for point in link.points}
    for step in scene.solved.program.on(POSITION):
        if step.name in points or step.verb == "tangent":
            found_by(canvas, scene, step)
    special_points(canvas, scene)
    strokes = [stroke for number in numbers for stroke in skeleton(scene, number).strokes]
    draw_sides(canvas, scene, POSITION, strokes)
    figures = draw_links(canvas, scene, numbers)
    draw_frame(canvas, scene, numbers, figures)
    driver = scene.solved.mechanism.driver
    if isinstance(driver, Driver):
        _angle(canvas, scene, driver)
    else:
        _speed(canvas, scene, driver)
    senses(canvas, scene, figures)
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
    radius = min(crank_mm * 0.78, FARTHEST) if crank_mm > 24.0 else radius + 5.0
    wanted = phi + math.pi * 0.78 if phi < math.pi else phi / 2 + math.pi * 0.86
    radii = tuple(radius * part for part in (1.0, 0.75, 1.3, 1.6))
    turning_of_driver(canvas, scene, driver, radii, 1.0, wanted)


def turning_of_driver(
    canvas: Canvas, scene: Scene, driver: Driver, radii: Sequence[float], spread: float, wanted: float
) -> None:
    """Draw the arrows of omega_1 and epsilon_1 about the pivot where there is room, near the direction `wanted`."""
    o, words = scene.mm(driver.pivot), scene.words
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
    pair = next(p for p in scene.solved.mechanism.pairs if isinstance(p, Prismatic) and driver.link in p.links)
    at, u = scene.mm(pair.point), guide_of(scene, pair)
    speed = scene.solved.values[driver.speed]
    if speed:
        up, e = guide_up(scene, pair), u * math.copysign(1.0, speed)
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
