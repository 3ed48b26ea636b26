"""A group drawn apart with all its forces, and a slider drawn apart with its own."""

from __future__ import annotations

import math

from ...plans.laws import cross
from ...plans.linkages.parts import arm_of
from ...plans.linkages.rrp import Dyad
from cmath import phase
from ..shapes import Arc, Arrow, Line, Pen
from ..symbols import arm, centre_of_mass, force_arrow, link, revolute, slider, slider_up, turning_arrow
from ..view import Canvas, View
from .scene import Scene


def group_view(scene: Scene, d: Dyad) -> View:
    """Draw group (rod, slider) without the crank: loads, reactions at its outer pairs, the arm of each moment."""
    canvas = Canvas(scene.style)
    a, b, u = scene.mm(d.A), scene.mm(d.B), scene.solved.point(d.u)
    rod_and_slider(canvas, scene, d, apart=True)
    canvas.add(revolute(a, d.A, scene.style))
    canvas.label(scene.words.mark(d.A), a, clear=scene.style.pair + 0.8)
    along = (b - a) / abs(b - a)
    i, j, k = d.before, d.rod.number, d.slider.number
    at_a: list[complex] = []
    at_b: list[complex] = []
    _force(canvas, scene, f"R_{i}{j}_n", a, [along], at_a)
    _force(canvas, scene, f"R_{i}{j}_t", a, [along], at_a)
    for name, point in loads(scene, k):
        _force(canvas, scene, name, scene.mm(point), [-along], at_b, gap=scene.style.slider[0] / 2)
    guide = b + u * (guide_offset(scene, d) / scene.scales["position"].mu)
    _force(canvas, scene, f"R_0{k}", guide, [-along], at_b, gap=scene.style.slider[1] / 2)
    for name, point in loads(scene, j):
        inside = point not in (d.A, d.B)
        _force(canvas, scene, name, scene.mm(point), [along, -along] if inside else [-along], [] if inside else at_b)
        if point != d.B:
            force_arm(canvas, scene, [name], [arm_of(name, j)], scene.mm(point), b)
    moment = f"M_i{j}"
    if d.rod.inertia and scene.defined(moment):
        _moment(canvas, scene, moment, a + (b - a) * 0.5, along)
    forces = [f"R_{i}{j}_n", f"R_{i}{j}_t", f"R_0{k}", *(name for name, _ in (*loads(scene, k), *loads(scene, j)))]
    zero = zeros(scene, [*forces, moment], [arm_of(n, j) for n, _ in loads(scene, j) if scene.direction(n) != 0])
    notes = (scene.words["said.arrows"], *zero)
    return canvas.finish(f"group_{d.name}", scene.heading("heading.group", "position", links=f"{j}, {k}"), notes)


def slider_view(scene: Scene, d: Dyad) -> View:
    """Draw the slider apart with the forces on it, all of which pass through B when h_03 = 0."""
    canvas = Canvas(scene.style)
    k, j = d.slider.number, d.rod.number
    b, u = 0j, scene.solved.point(d.u)
    canvas.add(*slider(b, u, str(k), scene.style, guides=False), revolute(b, d.B, scene.style))
    taken: list[complex] = []
    half = scene.style.slider[0] / 2
    _force(canvas, scene, f"R_{j}{k}", b, [], taken, gap=half)
    for name, point in loads(scene, k):
        at = (scene.solved.point(point) - scene.solved.point(d.B)) * (1.0 / scene.scales["position"].mu)
        _force(canvas, scene, name, at, [], taken if point == d.B else [], gap=half)
    at = u * (guide_offset(scene, d) / scene.scales["position"].mu)
    _force(canvas, scene, f"R_0{k}", at, [], taken, gap=half)
    canvas.label(scene.words.mark(d.B), b, clear=scene.style.pair + 0.8)
    offset = f"h_0{k}"
    length = f"{scene.segment(offset)} {scene.words['unit.mm']}" if scene.solved.quantities[offset].value else "0"
    notes = (scene.words["said.arrows"], f"{scene.words.symbol(offset)} = {length}")
    return canvas.finish(f"link_{k}", (scene.words["heading.link"].format(link=k),), notes)


def guide_offset(scene: Scene, d: Dyad) -> float:
    """Return where along the guide from B the guide's reaction stands, so that it balances the slider's moments."""
    k = d.slider.number
    moment, reaction = scene.solved.values.get(f"_M_{k}", 0.0), scene.solved.values[f"R_0{k}"]
    size = cross(scene.solved.point(d.u), complex(reaction))
    return -float(moment) / size if moment and size else 0.0


def loads(scene: Scene, number: int) -> list[tuple[str, str]]:
    """Return (force, point) of the loads on a link: its inertia force, then outer ones."""
    force, link = f"F_i{number}", scene.solved.mechanism.link(number)
    inertia = [(force, str(link.centre))] if force in scene.solved.quantities else []
    return inertia + [(load.name, load.point) for load in scene.solved.mechanism.loads_on(number)]


def force_arm(canvas: Canvas, scene: Scene, forces: list[str], names: list[str], at: complex, about: complex) -> None:
    """Draw the line of forces that share it, thin, and the arm from `about` to it with its millimetres."""
    e = scene.direction(forces[0])
    if e == 0 or not scene.defined(names[0]):
        return
    foot = at + e * (((about - at) / e).real)
    reach = 0.6 * scene.style.force
    ends = sorted(((p - at) / e).real for p in (at - e * reach, at + e * reach, foot))
    line = (at + e * (ends[0] - 4.0), at + e * (ends[-1] + 4.0))
    canvas.add(Line(*line, Pen.THIN, role="line-of-action", name=" ".join(forces)))
    if abs(foot - about) < 0.05:
        return
    canvas.add(*(arm(about, foot, name, e, scene.style) for name in names[:1]))
    symbols = " = ".join(scene.words.symbol(name) for name in names)
    # smaller than a node's letter: a number with its symbol is long, and the arms of a lever lie close together
    text = f"{symbols} = {scene.segment(names[0])}"
    canvas.label(text, (about, foot), clear=0.9, height=scene.style.text, strict=True)


def zeros(scene: Scene, loads_and_couples: list[str], arms: list[str]) -> tuple[str, ...]:
    """Say in one line which forces, couples and arms are zero: the figure cannot show them."""
    w, values = scene.words, scene.solved.values
    names = [name for name in loads_and_couples if scene.defined(name) and scene.solved.size(name) == 0.0]
    parts = [w.symbol(name.removeprefix("_"), bar=not name.startswith("M")) for name in names]
    parts += [w.symbol(name) for name in arms if scene.defined(name) and values[name] == 0.0]
    return (f"{' = '.join(parts)} = 0",) if parts else ()


def _force(
    canvas: Canvas,
    scene: Scene,
    name: str,
    at: complex,
    lines: list[complex],
    arrows: list[complex],
    gap: float = 0.0,
) -> None:
    """Hang the arrow of a force on a point, clear of links and of other arrows there, and letter it."""
    e = scene.direction(name)
    if e != 0:
        letter_arrow(canvas, scene, *force_arrow(at, e, name, lines, arrows, scene.style, gap))


def letter_arrow(canvas: Canvas, scene: Scene, arrow: Arrow, ray: complex) -> None:
    """Draw a force arrow with its letter beside its outer half."""
    canvas.add(arrow)
    far = arrow.tip if abs((arrow.tip - arrow.tail) / abs(arrow.tip - arrow.tail) - ray) < 1.0 else arrow.tail
    name = scene.words.symbol(arrow.name.removeprefix("_"), bar=True)
    canvas.label(name, (far - ray * 0.55 * scene.style.force, far), clear=0.9)


def _moment(canvas: Canvas, scene: Scene, name: str, at: complex, along: complex) -> None:
    value = scene.solved.values[name]
    if value == 0.0:
        return
    sense, radius = math.copysign(1.0, value), 0.5 * scene.style.force
    middle = math.atan2(along.imag, along.real)
    canvas.add(turning_arrow(at, radius, middle, 2.0, sense, name))
    canvas.label(scene.words.symbol(name), at + along * radius, clear=1.2)


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


