"""Both involutes by rolling: equal parts of PN numbered, the same arcs on the base circles, tangents from there."""

from __future__ import annotations

from dataclasses import replace

from ...plans.gears.meshing import Wheel
from ..figure import ANSWERS, Figure, stages
from ..shapes import Arc, Circle, Group, Line, Pen, Polyline
from ..symbols import right_angle, unit
from ..view import Canvas, View
from .circles import PAST, PENS, node
from .scene import GearScene

DOT = 0.6  # of a division, in radii of nodes
TIP = "a"  # the division that ends on the tip circle
BESIDE = 0.03  # rad of an arc beyond what is drawn on it
TIP_ARC = 3.0  # heights of letters of the tip circle to both sides
LINE = "line-of-action"


def rolling_view(overall: GearScene) -> View:
    """Draw how the flanks that touch at the pole are constructed."""
    scene = replace(overall, mu_l=overall.rolled)
    canvas, pair, along = FIGURE.canvas(scene, coarse=0.0), scene.wheels(), overall.meshing.along
    for wheel in pair:
        _circles(canvas, scene, wheel)
        _involute(canvas, scene, wheel)
    for wheel, inside in zip(pair, (along, -along), strict=True):
        _foot(canvas, scene, wheel, inside)
    ends = (_end(scene, wheel) for wheel in pair)
    canvas.part("line_of_action")
    canvas.add(Line(next(ends) - PAST * along, next(ends) + PAST * along, Pen.THIN, role=LINE, name="N1N2"))
    canvas.part("pole")
    node(canvas, scene, "P", 1j * along)
    heading = scene.words["heading.gear_rolling"], scene.factor(scene.mu_l)
    return canvas.finish("rolling", heading, tuple(scene.words["said.gear_rolling"].split("|")))


def _end(scene: GearScene, wheel: Wheel) -> complex:
    """Return the last division of PN, or N itself."""
    i = wheel.number
    return max(scene.mm(f"N{i}"), scene.mm(f"D{i}_{_divisions(scene, wheel)[-1]}"), key=abs)


def _circles(canvas: Canvas, scene: GearScene, wheel: Wheel) -> None:
    """Draw the parts of the base circle and of the tip circle that the construction needs."""
    i, height = wheel.number, scene.style.text
    feet = [wheel.angle(scene.mm(f"T{i}_{k}")) for k in (*_divisions(scene, wheel), TIP)]
    end = wheel.angle(scene.mm(f"E{i}_{TIP}"))
    base = min(*feet, wheel.angle(scene.mm(f"N{i}"))), max(*feet, wheel.angle(scene.mm(f"N{i}")))
    beside = TIP_ARC * scene.style.label / wheel.radius("a")
    spans = {"b": base, "a": (end - beside, end + beside)}
    for name, (low, high) in spans.items():
        start = wheel.direction + low - BESIDE
        arc = Arc(wheel.centre, wheel.radius(name), start, high - low + 2.0 * BESIDE, PENS[name])
        canvas.part("line_of_action" if name == "b" else "involutes")
        canvas.add(Group((arc,), "circle", f"d_{name}{i}"))
    far = max(base, key=abs)
    at = wheel.on(wheel.radius("b"), far + (BESIDE if far > 0.0 else -BESIDE))
    canvas.part(ANSWERS)
    canvas.label(scene.stated(f"d_b{i}"), at, prefer=-wheel.up, clear=1.0, height=height)
    out = wheel.side * wheel.up * -1j  # away from N
    tip = wheel.on(wheel.radius("a"), end - wheel.side * beside)
    canvas.label(scene.stated(f"d_a{i}"), tip, prefer=out, clear=1.0, height=height)


def _involute(canvas: Canvas, scene: GearScene, wheel: Wheel) -> None:
    """Draw the tangents with the points of the involute, and the curve through these."""
    i = wheel.number
    for k in (*_divisions(scene, wheel), TIP):
        foot, end = scene.mm(f"T{i}_{k}"), scene.mm(f"E{i}_{k}")
        canvas.part("tangents")
        canvas.add(Line(foot, end, Pen.THIN, role="tangent", name=f"{i}_{k}"))
        for letter, at, stage in (("T", foot, "arcs"), ("E", end, "involutes")):
            canvas.part(stage)
            canvas.add(_division(scene, at, f"{letter}{i}_{k}"))
    canvas.part("parts")
    for k in _divisions(scene, wheel):
        _number(canvas, scene, wheel, k)
    canvas.part("involutes")
    curve = wheel.flank(0.0, wheel.sizes[f"rho_a{i}"])
    canvas.add(Group((Polyline(curve, Pen.MAIN),), "curve", f"involute_{i}"))


def _number(canvas: Canvas, scene: GearScene, wheel: Wheel, k: int) -> None:
    """Number a division of PN, and the same on the base circle; where both are one, only this."""
    i, height = wheel.number, scene.style.text
    foot, part = scene.mm(f"T{i}_{k}"), scene.mm(f"D{i}_{k}")
    inward = unit(wheel.centre - foot)
    canvas.add(_division(scene, part, f"D{i}_{k}"))
    canvas.label(str(k), foot, prefer=inward, clear=1.0, height=height)
    if k and abs(part - foot) > height:
        canvas.label(str(k), part, prefer=-inward, clear=1.0, height=height)


def _division(scene: GearScene, at: complex, name: str) -> Group:
    return Group((Circle(at, DOT * scene.style.node, Pen.THIN, fill="black"),), "division", name)


def _foot(canvas: Canvas, scene: GearScene, wheel: Wheel, inside: complex) -> None:
    """Mark the foot of the radius on the line of action, with a piece of the radius."""
    name, label = f"N{wheel.number}", scene.style.label
    at = scene.mm(name)
    inward = unit(wheel.centre - at)
    canvas.part("line_of_action")
    canvas.add(Line(at, at + 3.0 * label * inward, Pen.THIN, role="radius", name=name))
    canvas.part(ANSWERS)
    canvas.add(right_angle(at, inward, inside, 0.6 * label))
    canvas.part("line_of_action")
    node(canvas, scene, name, inward - inside)


def _divisions(scene: GearScene, wheel: Wheel) -> range:
    """Return the numbers of the divisions."""
    return range(scene.solved.layout.rollings[wheel.number - 1].last + 1)


FIGURE = Figure(
    "rolling",
    rolling_view,
    ("rolled",),
    stages("pole", "line_of_action", "parts", "arcs", "tangents", "involutes"),
    "gear.rolling",
)
