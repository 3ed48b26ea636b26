"""Both involutes by rolling: equal parts of PN numbered, the same arcs on the base circles, tangents from there."""

from __future__ import annotations

import cmath
from dataclasses import replace
from itertools import chain

from ..shapes import Arc, Circle, Group, Line, Pen, Polyline
from ..symbols import right_angle
from ..view import Canvas, View
from .circles import PAST, PENS, node
from .scene import GearScene
from .wheels import Wheel

DOT = 0.6  # of a division, in radii of nodes
TIP = "a"  # the division that ends on the tip circle
BESIDE = 0.03  # rad of an arc beyond what is drawn on it


def rolling_view(overall: GearScene) -> View:
    """Draw how the flanks that touch at the pole are constructed."""
    scene = replace(overall, mu_l=overall.rolled)
    canvas, pair, along = Canvas(scene.style), scene.wheels(), overall.meshing.along
    for wheel in pair:
        _circles(canvas, scene, wheel)
        _involute(canvas, scene, wheel)
    ends = scene.mm("N1"), scene.mm("N2")
    canvas.add(Line(ends[0] - PAST * along, ends[1] + PAST * along, Pen.THIN, role="line-of-action", name="N1N2"))
    for wheel, inside in zip(pair, (along, -along), strict=True):
        _foot(canvas, scene, wheel, inside)
    node(canvas, scene, "P", 1j)
    heading = scene.words["heading.gear_rolling"], scene.factor(scene.mu_l)
    return canvas.finish("rolling", heading, tuple(scene.words["said.gear_rolling"].split("|")))


def _circles(canvas: Canvas, scene: GearScene, wheel: Wheel) -> None:
    """Draw the parts of the base circle and of the tip circle that the construction needs."""
    i = wheel.number
    feet = [wheel.angle(scene.mm(f"T{i}_{k}")) for k in _divisions(scene, wheel)]
    end = wheel.angle(scene.mm(f"E{i}_{TIP}"))
    spans = {"b": (min(feet), max(feet)), "a": (end - 2.0 * BESIDE, end + 2.0 * BESIDE)}
    for name, (low, high) in spans.items():
        start = cmath.phase(wheel.up) + low - BESIDE
        arc = Arc(wheel.centre, wheel.radius(name), start, high - low + 2.0 * BESIDE, PENS[name])
        canvas.add(Group((arc,), "circle", f"d_{name}{i}"))
        canvas.label(scene.stated(f"d_{name}{i}"), wheel.on(wheel.radius(name), high), height=scene.style.text)


def _involute(canvas: Canvas, scene: GearScene, wheel: Wheel) -> None:
    """Draw the tangents with the points of the involute, and the curve through these."""
    i, style = wheel.number, scene.style
    for k in chain(_divisions(scene, wheel), (TIP,)):
        foot, end = scene.mm(f"T{i}_{k}"), scene.mm(f"E{i}_{k}")
        canvas.add(Line(foot, end, Pen.THIN, role="tangent", name=f"{i}_{k}"))
        places = {"T": foot, "E": end} | ({"D": scene.mm(f"D{i}_{k}")} if k != TIP else {})
        for letter, at in places.items():
            dot = Circle(at, DOT * style.node, Pen.THIN, fill="black")
            canvas.add(Group((dot,), "division", f"{letter}{i}_{k}"))
        if k == TIP:
            continue
        inward = (wheel.centre - foot) / abs(wheel.centre - foot)
        canvas.label(str(k), foot, prefer=inward, clear=1.0, height=style.text)
        if abs(places["D"] - foot) > style.text:
            canvas.label(str(k), places["D"], prefer=-inward, clear=1.0, height=style.text)
    curve = wheel.flank(0.0, wheel.sizes[f"rho_a{i}"])
    canvas.add(Group((Polyline(curve, Pen.MAIN),), "curve", f"involute_{i}"))


def _foot(canvas: Canvas, scene: GearScene, wheel: Wheel, inside: complex) -> None:
    """Mark the foot of the radius on the line of action, with a piece of the radius."""
    name, label = f"N{wheel.number}", scene.style.label
    at = scene.mm(name)
    inward = (wheel.centre - at) / abs(wheel.centre - at)
    canvas.add(Line(at, at + 3.0 * label * inward, Pen.THIN, role="radius", name=name))
    canvas.add(right_angle(at, inward, inside, 0.6 * label))
    node(canvas, scene, name, inward - inside)


def _divisions(scene: GearScene, wheel: Wheel) -> range:
    """Return the numbers of the divisions."""
    return range(scene.solved.layout.rollings[wheel.number - 1].last + 1)
