"""How teeth come about: both involutes by rolling, and the pinion with the rack that cuts it."""

from __future__ import annotations

from dataclasses import replace

from ...plans.gears.course import Rack
from ...plans.gears.teeth import Wheel
from ..figure import ANSWERS, Figure, stages
from ..page import extent
from ..shapes import Arc, Circle, Group, Head, Line, Pen, Polyline
from ..symbols import HALF_TURN, right_angle, unit
from ..view import Canvas, View, angle, linear
from .meshing_view import PAST, PENS, WIDEST, node
from .sheet import GearScene

DOT = 0.6  # of a division, in radii of nodes
TIP = "a"  # the division that ends on the tip circle
BESIDE = 0.03  # rad of an arc beyond what is drawn on it
TIP_ARC = 3.0  # heights of letters of the tip circle to both sides
LINE = "line-of-action"
RACK_PAST = 6.0  # mm of a line beyond what it goes to
SPACES = 1.2  # pitches of the wheel to both sides
OUT = unit(-1.0 - 1.0j)  # in which the radius of a corner of the rack is drawn


def rolling_view(overall: GearScene) -> View:
    """Draw how the flanks that touch at the pole are constructed."""
    scene = replace(overall, mu_l=overall.rolled)
    canvas, pair, along = FIGURE.canvas(scene, coarse=0.0), scene.wheels(), overall.meshing.along
    for wheel in pair:
        _circles(canvas, scene, wheel)
        _involute(canvas, scene, wheel)
    for wheel, inside in zip(pair, (along, -along), strict=True):
        _foot(canvas, scene, wheel, inside)
    lasts = ((f"N{wheel.number}", f"D{wheel.number}_{_divisions(scene, wheel)[-1]}") for wheel in pair)
    first, last = (max(map(scene.mm, names), key=abs) for names in lasts)
    canvas.part("line_of_action")
    canvas.add(Line(first - PAST * along, last + PAST * along, Pen.THIN, role=LINE, name="N1N2"))
    canvas.part("pole")
    node(canvas, scene, "P", 1j * along)
    heading = scene.words["heading.gear_rolling"], scene.factor(scene.mu_l)
    return canvas.finish("rolling", heading, tuple(scene.words["said.gear_rolling"].split("|")))


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
    tip, away = wheel.on(wheel.radius("a"), end - wheel.side * beside), wheel.side * wheel.up * -1j  # from N
    canvas.label(scene.stated(f"d_a{i}"), tip, prefer=away, clear=1.0, height=height)


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


def rack_view(overall: GearScene) -> View:
    """Draw the pinion, a space of it in the middle of a tooth of the rack."""
    scene = replace(overall, mu_l=overall.near)
    canvas, rack = Canvas(scene.style), Rack(scene.solved, 1.0 / scene.mu_l)
    _wheel(canvas, scene, rack)
    line = Polyline(tuple(rack.outline()), Pen.MAIN, role="profile", name="rack")
    canvas.add(Group((line,), "rack", "rack"))
    x0, _, x1, _ = extent((line,))
    _lines(canvas, scene, rack, x0 - RACK_PAST, x1 + RACK_PAST)
    _line_of_action(canvas, scene, rack)
    at = rack.corner + scene.paper("rho_f") * OUT
    canvas.add(Line(rack.corner, at, Pen.THIN, role="radius", name="rho_f"), Head(at, OUT))
    canvas.label(scene.stated("rho_f"), at, prefer=OUT, clear=1.0, height=scene.style.text)
    heading = scene.words["heading.gear_rack"], scene.factor(scene.mu_l)
    return canvas.finish("rack", heading, tuple(scene.words["said.gear_rack"].split("|")))


def _wheel(canvas: Canvas, scene: GearScene, rack: Rack) -> None:
    """Draw two teeth beside the space, the reference and the base circle."""
    line = Polyline(rack.teeth(), Pen.MAIN, role="profile", name="pinion")
    canvas.add(Group((line,), "wheel", "1"))
    half = min(SPACES * rack.pitch, WIDEST)
    for name in ("", "b"):
        arc = Arc(rack.centre, rack.radius(name), 0.5 * HALF_TURN - half, 2.0 * half, PENS[name])
        canvas.add(Group((arc,), "circle", f"d_{name}1"))
        symbol = scene.words.symbol(f"d_{name}1")
        canvas.label(symbol, rack.on(name, -half), prefer=1 + 0j, clear=1.0, height=scene.style.text)


def _lines(canvas: Canvas, scene: GearScene, rack: Rack, left: float, right: float) -> None:
    """Draw the pitch line of the rack, which rolls on the reference circle, its middle line, and the shift."""
    words, shift = scene.words, rack.shift
    for name, y, pen in (("pitch", 0.0, Pen.THIN), ("middle", shift, Pen.AXIS)):
        canvas.add(Line(complex(left, y), complex(right, y), pen, role="rack-line", name=name))
    if abs(shift) > 0.01:
        text = f"{words.symbol('x_1')}{words.symbol('m')} = {scene.length(shift * scene.mu_l)}"
        linear(canvas, (complex(right, 0.0), complex(right, shift)), 0j, "", "x_1")
        canvas.label(text, complex(right, 0.5 * shift), prefer=1 + 0j, clear=1.0, height=scene.style.text)


def _line_of_action(canvas: Canvas, scene: GearScene, rack: Rack) -> None:
    """Draw the line of action of cutting, where it touches the base circle, and where the rack's edge ends on it."""
    style, touch = scene.style, rack.touch
    far = max(touch, rack.edge, key=abs)
    canvas.add(Line(-far, far + RACK_PAST * unit(far), Pen.THIN, role="line-of-action", name="PN"))
    inward = unit(rack.centre - touch)
    canvas.add(Line(touch, touch + 3.0 * style.label * inward, Pen.THIN, role="radius", name="N"))
    canvas.add(right_angle(touch, inward, -rack.down, 0.6 * style.label))
    places = (("N", touch, inward), ("B", rack.edge, rack.down), ("P", 0j, -1 + 1j))
    for name, at, prefer in places:
        canvas.add(scene.node(at, name, "point"))
        canvas.label(name, at, prefer=prefer, clear=style.node + 0.6)
    rays = -1.0 + 0j, -rack.down
    angle(canvas, 0j, rays, 0.8 * abs(far), "alpha", scene.angle("alpha"), prefer=-1 + 0j)
