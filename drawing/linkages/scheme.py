"""The plan of the mechanism: links, pairs and guide to scale, the compass arc, angles and senses of turning."""

from __future__ import annotations

import cmath
import math
from cmath import phase, rect

from ...plans.linkages.rrp import Dyad
from ..shapes import Arc, Arrow, Line, Pen
from ..symbols import (
    angle_dimension,
    centre_of_mass,
    fixed_pivot,
    link,
    revolute,
    slider,
    slider_up,
    turning_arrow,
)
from ..view import Canvas, View
from .scene import Scene


def scheme(scene: Scene) -> View:
    """Draw the plan of the mechanism in the given position."""
    canvas = Canvas(scene.style)
    crank(canvas, scene)
    for dyad in scene.dyads:
        rod_and_slider(canvas, scene, dyad)
    driver = scene.solved.mechanism.driver
    for dyad in scene.dyads:
        _senses(canvas, scene, dyad)
    pivot = scene.mm(driver.pivot)
    canvas.add(fixed_pivot(pivot, driver.pivot, scene.style))
    canvas.add(revolute(scene.mm(driver.point), driver.point, scene.style))
    _angle(canvas, scene)
    _frame_number(canvas, scene, pivot)
    for name in (driver.pivot, driver.point):
        canvas.label(scene.words.mark(name), scene.mm(name), clear=scene.style.pair + 0.8)
    return canvas.finish("position", scene.heading("heading.position", "position"))


def crank(canvas: Canvas, scene: Scene) -> None:
    """Draw the crank with its number."""
    driver = scene.solved.mechanism.driver
    o, a = scene.mm(driver.pivot), scene.mm(driver.point)
    canvas.add(link(o, a, str(driver.link), scene.style))
    canvas.label(str(driver.link), (o, a))


def rod_and_slider(canvas: Canvas, scene: Scene, d: Dyad, apart: bool = False) -> None:
    """Draw the rod, its centre of mass, and the slider on its guide; the compass arc unless drawn apart."""
    a, b, u = scene.mm(d.A), scene.mm(d.B), scene.solved.point(d.u)
    style = scene.style
    if not apart:
        origin = scene.mm(f"_{d.u}_origin")
        along = ((b - origin) / u).real
        reach = sorted((0.0, along))
        low, high = (b + u * (end - along) for end in (reach[0] - 16.0, reach[1] + 16.0))
        canvas.add(Line(low, high, Pen.AXIS))
        # at the pivot's end, where there is no guide
        canvas.label("x–x", max(low, high, key=lambda end: abs(end - b)), clear=1.0, prefer=-slider_up(u))
    canvas.add(*slider(b, u, str(d.slider.number), style, guides=not apart))
    if not apart:
        # the compass arc runs past the slider on both sides
        radius, direction = abs(b - a), phase(b - a)
        spread = (2.4 * style.slider[1] + 4.0) / radius
        canvas.add(Arc(a, radius, direction - spread / 2, spread, Pen.THIN, role="construction", name=f"arc_{d.B}"))
    canvas.add(link(a, b, str(d.rod.number), style))
    canvas.add(revolute(b, d.B, style))
    canvas.label(str(d.rod.number), (a + (b - a) * 0.58, a + (b - a) * 0.92), clear=0.8)
    for point in (*d.rod.points, *d.slider.points):
        if point not in (d.A, d.B):
            canvas.add(centre_of_mass(scene.mm(point), point, style))
            canvas.label(scene.words.mark(point), scene.mm(point), clear=style.centre + 0.8)
    # beside the slider's free edge: the compass arc and the arrows at B leave no room beside the pair itself
    up = slider_up(u)
    edge = b + up * (style.slider[1] / 2)
    half = u * (style.slider[0] / 2)
    canvas.label(scene.words.mark(d.B), (edge - half, edge + half), clear=1.0, prefer=up, priority=1)
    # on the side away from the rod: nearer to it the number would seem to be the rod's
    far = -half if ((a - b) / u).real > 0 else half
    if apart:
        foot = edge - up * style.slider[1]
        canvas.label(str(d.slider.number), (foot, foot + far), clear=1.0, prefer=-up)
    else:
        canvas.label(str(d.slider.number), edge + far, clear=0.8, prefer=up)


def _angle(canvas: Canvas, scene: Scene) -> None:
    """Dimension phi from the axis x, and draw the arrow of omega_1 on the other side."""
    driver = scene.solved.mechanism.driver
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
    radius = crank_mm * 0.78 if crank_mm > 24.0 else radius + 5.0
    middle = phi + math.pi * 0.78 if phi < math.pi else phi / 2 + math.pi * 0.86
    middle = _away_from_rods(scene, o, phi, middle)
    canvas.add(turning_arrow(o, radius, middle, 1.0, sense, f"omega_{driver.link}"))
    canvas.label(words.symbol(f"omega_{driver.link}"), o + rect(radius, middle), prefer=rect(1.0, middle))


def _away_from_rods(scene: Scene, o: complex, phi: float, wanted: float) -> float:
    """Choose the direction for the arrow of omega_1 that is farthest from the crank, the rods and the pivot's foot."""
    busy = [rect(1.0, phi), rect(1.0, phi / 2), -1j, 1.0 + 0j]
    for d in scene.dyads:
        for k in (0.25, 0.5, 1.0):
            at = scene.mm(d.A) + (scene.mm(d.B) - scene.mm(d.A)) * k - o
            if abs(at) > 1.0:
                busy.append(at / abs(at))

    def room(angle: float) -> float:
        return min(abs(cmath.phase(rect(1.0, angle) / other)) for other in busy)

    return max((wanted, *(k * math.pi / 12 for k in range(24))), key=lambda angle: (round(room(angle), 6), -angle))


def _senses(canvas: Canvas, scene: Scene, d: Dyad) -> None:
    """Carry V_BA and a^t_BA to B and draw the senses of omega_2 and epsilon_2 that they show."""
    a, b = scene.mm(d.A), scene.mm(d.B)
    along = phase(b - a)
    reach = abs(b - a)
    taken: dict[complex, float] = {}
    pairs = ((f"V_{d.B}{d.A}", f"omega_{d.rod.number}", 0.30), (f"a_{d.B}{d.A}_t", f"epsilon_{d.rod.number}", 0.45))
    for carried, turning, place in pairs:
        if not scene.defined(carried):
            continue
        e = scene.direction(carried)
        rate = scene.solved.values[turning]
        if e == 0:
            continue
        sense = math.copysign(1.0, rate)
        radius = _off_points(scene, d, max(14.0, place * reach))
        spread = min(0.9, 1.1 * scene.style.force / radius)  # long enough to be seen as an arc
        canvas.add(turning_arrow(a, radius, along, spread, sense, turning))
        tip = a + rect(radius, along + sense * spread / 2)
        canvas.label(scene.words.symbol(turning), tip, prefer=rect(sense, along + math.pi / 2), clear=1.4)
        key = complex(round(e.real, 6), round(e.imag, 6))
        start = taken.get(key, 0.0)
        length = 0.62 * scene.style.force + start
        taken[key] = length + 0.2 * scene.style.force
        canvas.add(Arrow(b, b + e * length, Pen.THIN, name=carried))
        canvas.label(scene.words.symbol(carried, bar=True), (b + e * (length * 0.6), b + e * length), clear=1.0)


def _off_points(scene: Scene, d: Dyad, radius: float) -> float:
    """Return the radius of an arc about A, changed where the arc would run through a point of the rod."""
    room = 0.3 * scene.style.force
    for reach in sorted(abs(scene.mm(point) - scene.mm(d.A)) for point in d.rod.points if point not in (d.A, d.B)):
        if abs(radius - reach) < room:
            radius = reach - room if radius < reach and reach > 2 * room else reach + room
    return radius


def _frame_number(canvas: Canvas, scene: Scene, pivot: complex) -> None:
    """Letter the frame 0 beside the hatching of the pivot and keep letters off the hatching."""
    _, height, base = scene.style.pivot
    foot = pivot - 1j * (height + scene.style.pair)
    canvas.keep_clear(foot - base / 2 - 1j * scene.style.hatch[0], foot + base / 2)
    crank_to = scene.mm(scene.solved.mechanism.driver.point) - pivot
    side = -1.0 if crank_to.real > 0 > crank_to.imag else 1.0
    canvas.label("0", foot + side * base / 2 - 0.5j * scene.style.hatch[0], prefer=side + 0j, clear=1.0)
    for d in scene.dyads:
        b, u = scene.mm(d.B), scene.solved.point(d.u)
        length, height = scene.style.slider
        corners = [
            b + u * (s * length * 1.1) + slider_up(u) * (t * (height / 2 + scene.style.hatch[0]))
            for s in (-1, 1)
            for t in (-1, 0)
        ]
        canvas.keep_clear(*corners)
