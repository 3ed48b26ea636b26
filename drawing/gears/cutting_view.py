"""Wheels cut by a rack: involutes by rolling, the pinion with the rack, and which shifts of it a pair can have.

The blocking contour stands in the plane of both shifts: the curves that bound them, and the shifts of the pair.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from ...plans.gears.blocking import BLOCKING, CURVES, LEAST_TIP, OF_CURVE, Plane, plane_of
from ...plans.gears.course import Rack
from ...plans.gears.teeth import Wheel
from ...scales.scale import Scale, steps
from ..areas import freest, thinned
from ..dimensions import Axis, Field, angle, divisions, linear, numbered
from ..figure import ANSWERS, GIVEN, Figure, stages
from ..page import extent
from ..shapes import Anchor, Arc, Circle, Group, Head, Line, Pen, Polyline, Text
from ..symbols import HALF_TURN, right_angle, unit
from ..view import Canvas, View
from .meshing_view import PAST, PENS, WIDEST, node
from .scene import GearScene

DOT = 0.6  # of a division, in radii of nodes
TIP = "a"  # the division that ends on the tip circle
BESIDE = 0.03  # rad of an arc beyond what is drawn on it
TIP_ARC = 3.0  # heights of letters of the tip circle to both sides
LINE = "line-of-action"
RACK_PAST = 6.0  # mm of a line beyond what it goes to
SPACES = 1.2  # pitches of the wheel to both sides
OUT = unit(-1.0 - 1.0j)  # in which the radius of a corner of the rack is drawn


def _rolling_view(overall: GearScene) -> View:
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
    canvas.part("line_of_action", Line(first - PAST * along, last + PAST * along, Pen.THIN, role=LINE, name="N1N2"))
    canvas.part("start")
    node(canvas, scene, "P", 1j * along)
    heading = scene.words["heading.gear_rolling"], scene.factor
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
        canvas.part("line_of_action" if name == "b" else "involutes", Group((arc,), "circle", f"d_{name}{i}"))
    far = max(base, key=abs)
    at = wheel.on(wheel.radius("b"), far + (BESIDE if far > 0.0 else -BESIDE))
    canvas.part(ANSWERS)
    canvas.label(scene.stated(f"d_b{i}"), at, prefer=-wheel.up, clear=1.0, height=height)
    tip, away = wheel.on(wheel.radius("a"), end - wheel.side * beside), wheel.side * wheel.up * -1j  # from N
    canvas.label(scene.stated(f"d_a{i}"), tip, prefer=away, clear=1.0, height=height)


def _involute(canvas: Canvas, scene: GearScene, wheel: Wheel) -> None:
    """Draw the tangents with the points of the involute, and the curve through these."""
    i, height = wheel.number, scene.style.text
    for k in (*_divisions(scene, wheel), TIP):
        foot, end = scene.mm(f"T{i}_{k}"), scene.mm(f"E{i}_{k}")
        canvas.part("tangents", Line(foot, end, Pen.THIN, role="tangent", name=f"{i}_{k}"))
        for letter, at, stage in (("T", foot, "arcs"), ("E", end, "involutes")):
            canvas.part(stage, _division(scene, at, f"{letter}{i}_{k}"))
    canvas.part("parts")
    for k in _divisions(scene, wheel):  # numbered on PN and the base circle, or here alone where both are one
        foot, part = scene.mm(f"T{i}_{k}"), scene.mm(f"D{i}_{k}")
        inward = unit(wheel.centre - foot)
        canvas.add(_division(scene, part, f"D{i}_{k}"))
        canvas.label(str(k), foot, prefer=inward, clear=1.0, height=height)
        if k and abs(part - foot) > height:
            canvas.label(str(k), part, prefer=-inward, clear=1.0, height=height)
    canvas.part("involutes")
    curve = wheel.flank(0.0, wheel.sizes[f"rho_a{i}"])
    canvas.group("curve", f"involute_{i}", Polyline(curve, Pen.MAIN))


def _division(scene: GearScene, at: complex, name: str) -> Group:
    return Group((Circle(at, DOT * scene.style.node, Pen.THIN, fill="black"),), "division", name)


def _foot(canvas: Canvas, scene: GearScene, wheel: Wheel, inside: complex) -> None:
    """Mark the foot of the radius on the line of action, with a piece of the radius."""
    name, label = f"N{wheel.number}", scene.style.label
    at = scene.mm(name)
    inward = unit(wheel.centre - at)
    canvas.part("line_of_action", Line(at, at + 3.0 * label * inward, Pen.THIN, role="radius", name=name))
    canvas.part(ANSWERS, right_angle(at, inward, inside, 0.6 * label))
    canvas.part("line_of_action")
    node(canvas, scene, name, inward - inside)


def _divisions(scene: GearScene, wheel: Wheel) -> range:
    return range(scene.solved.layout.rollings[wheel.number - 1].last + 1)


FIGURE = Figure(
    "rolling",
    _rolling_view,
    ("rolled",),
    stages("start", line_of_action=("", "meshing.line_of_action"), parts="", arcs="", tangents="", involutes=""),
    "gear.rolling",
)


def rack_view(overall: GearScene) -> View:
    """Draw the pinion, a space of it in the middle of a tooth of the rack."""
    scene = replace(overall, mu_l=overall.near)
    canvas, rack = Canvas(scene.style), Rack(scene.solved, 1.0 / scene.mu_l)
    pinion = rack.pinion  # two teeth beside the space, the reference and the base circle
    teeth = Polyline(pinion.placed(pinion.tooth.teeth(2), -0.5), Pen.MAIN, role="profile", name="pinion")
    canvas.group("wheel", "1", teeth)
    half = min(SPACES * pinion.pitch, WIDEST)
    for name in ("", "b"):
        arc = Arc(pinion.centre, pinion.radius(name), 0.5 * HALF_TURN - half, 2.0 * half, PENS[name])
        canvas.group("circle", f"d_{name}1", arc)
        symbol = scene.words.symbol(f"d_{name}1")
        canvas.small(symbol, pinion.on(pinion.radius(name), -half), 1 + 0j, 1.0)
    line = Polyline(tuple(rack.outline()), Pen.MAIN, role="profile", name="rack")
    canvas.group("rack", "rack", line)
    x0, _, x1, _ = extent((line,))
    _lines(canvas, scene, rack, x0 - RACK_PAST, x1 + RACK_PAST)
    _line_of_action(canvas, scene, rack)
    at = rack.corner + scene.paper("rho_f") * OUT
    canvas.add(Line(rack.corner, at, Pen.THIN, role="radius", name="rho_f"), Head(at, OUT))
    canvas.small(scene.stated("rho_f"), at, OUT, 1.0)
    heading = scene.words["heading.gear_rack"], scene.factor
    return canvas.finish("rack", heading, tuple(scene.words["said.gear_rack"].split("|")))


def _lines(canvas: Canvas, scene: GearScene, rack: Rack, left: float, right: float) -> None:
    """Draw the pitch line of the rack, which rolls on the reference circle, its middle line, and the shift."""
    words, shift = scene.words, rack.shift
    for name, y, pen in (("pitch", 0.0, Pen.THIN), ("middle", shift, Pen.AXIS)):
        canvas.add(Line(complex(left, y), complex(right, y), pen, role="rack-line", name=name))
    if abs(shift) > 0.01:
        text = f"{words.symbol('x_1')}{words.symbol('m')} = {scene.length(shift * scene.mu_l)}"
        linear(canvas, (complex(right, 0.0), complex(right, shift)), 0j, "", "x_1")
        canvas.small(text, complex(right, 0.5 * shift), 1 + 0j, 1.0)


def _line_of_action(canvas: Canvas, scene: GearScene, rack: Rack) -> None:
    """Draw the line of action of cutting, where it touches the base circle, and where the rack's edge ends on it."""
    style, touch = scene.style, rack.touch
    far = max(touch, rack.edge, key=abs)
    canvas.add(Line(-far, far + RACK_PAST * unit(far), Pen.THIN, role="line-of-action", name="PN"))
    inward = unit(rack.pinion.centre - touch)
    canvas.add(Line(touch, touch + 3.0 * style.label * inward, Pen.THIN, role="radius", name="N"))
    canvas.add(right_angle(touch, inward, -rack.down, 0.6 * style.label))
    places = (("N", touch, inward), ("B", rack.edge, rack.down), ("P", 0j, -1 + 1j))
    for name, at, prefer in places:
        canvas.add(scene.node(at, name, "point"))
        canvas.label(name, at, prefer=prefer, clear=style.node + 0.6)
    rays = -1.0 + 0j, -rack.down
    angle(canvas, 0j, rays, 0.8 * abs(far), "alpha", scene.angle("alpha"), prefer=-1 + 0j)


SIDE = {5.0: 200.0, 3.5: 80.0}  # mm of the longer side of the window, by the height of letters
FINE = 0.05  # mm by which a chord may miss its curve: places between are left out
APART = 4.2  # heights of numbers at least between divisions
REACH = 4.0  # mm of a curve to both sides of the place where its name stands
BEYOND = 1.6  # heights of letters by which arrows run past the window
EACH = 0.7  # of the longer side of the window: a curve has a number for each such part of it
LEAST = 0.2  # of the longer side: shorter curves in a corner of the window, which bound nothing, are left out
IN_A_LINE = 3  # entries of the legend
STEP = 2.0  # mm between places that are looked at
AT_SIDE = 3.0  # mm from a side of the window, within which the line of zero is left out


def contour_view(scene: GearScene) -> View:
    """Draw the window round the contour of the wheels."""
    plane, words, style = plane_of(scene.solved.givens, scene.solved.pair.least_tip), scene.words, scene.style
    canvas, field, sides = Canvas(style), _field(scene, plane), plane.contour()
    _frame(canvas, scene, field)
    curves = {name: [_thinned(field, run) for run in runs] for name, runs in plane.curves.items()}
    for name in {*CURVES}.difference(name for name, _ in sides):
        curves[name] = [run for run in curves[name] if abs(run[-1] - run[0]) >= LEAST * SIDE[style.label]]
    for name, runs in curves.items():
        pen = Pen.THIN if name in BLOCKING else Pen.DASHED
        canvas.add(Group(tuple(Polyline(run, pen) for run in runs), "limit", name))
    for name, side in sides:
        canvas.group("contour", name, Polyline(_thinned(field, side), Pen.MAIN))
    x_1, x_2 = scene.size("x_1"), scene.size("x_2")
    at, feet = field.at(x_1, x_2), (field.at(x_1, field.y.low), field.at(field.x.low, x_2))
    canvas.add(*(Line(at, foot, Pen.DASHED, role="projection") for foot in feet))
    canvas.group("point", "chosen", Circle(at, 1.5 * style.node, Pen.MAIN, fill="black"))
    # curves have numbers, long ones in several places, where they are far from others
    seen = [name for name, runs in curves.items() if runs]
    numbered = [(number, run) for number, name in enumerate(seen, start=1) for run in curves[name]]
    for n, middle, along in freest([run for _, run in numbered], STEP, EACH * SIDE[style.label]):
        ends = middle - REACH * along, middle + REACH * along
        canvas.label(str(numbered[n][0]), ends, clear=0.8, height=style.text)
    mu = f"{words.symbol('mu_x')} = {words.short(field.x.scale.mu)} {words.unit('mm')}^{{−1}}"
    texts = [f"{number}: {_limit(scene, name)}" for number, name in enumerate(seen, start=1)]
    legend = (";  ".join(texts[k : k + IN_A_LINE]) for k in range(0, len(texts), IN_A_LINE))
    notes = words["gear.contour_lines"], *legend, f"●  {';  '.join(map(scene.shift, ('x_1', 'x_2')))}"
    return canvas.finish("contour", (words["heading.gear_contour"], mu), notes)


def _field(scene: GearScene, plane: Plane) -> Field:
    """Return the plane on the paper, equal scale factors on both axes."""
    size, words = plane.high - plane.low, scene.words
    mu = steps(max(size.real, size.imag) / SIDE[scene.style.label])[0]
    scale = Scale("mu_x", mu, "1")
    ends = ((plane.low.real, plane.high.real), (plane.low.imag, plane.high.imag))
    axes = []
    for i, (low, high) in enumerate(ends, start=1):
        numbers = (*divisions(high, low, mu, APART * scene.style.text), 0.0)
        axes.append(Axis(words.symbol(f"x_{i}"), scale, low, high, numbered(words, numbers)))
    return Field(0j, *axes)


def _frame(canvas: Canvas, scene: GearScene, field: Field) -> None:
    """Draw the sides of the window with divisions below and on the left, the axes where they pass through it."""
    x, y, height = field.x, field.y, scene.style.text
    before = canvas.part(GIVEN)
    corners = tuple(field.at(*at) for at in ((x.low, y.low), (x.high, y.low), (x.high, y.high), (x.low, y.high)))
    canvas.add(Polyline(corners, Pen.THIN, closed=True, role="window"))
    sides: tuple[tuple[Axis, complex, complex, Anchor], ...]
    sides = (x, 1j, 1.6j, "middle"), (y, 1.0 + 0j, 0.6 + 0.5j, "right")
    for axis, inward, outward, anchor in sides:
        for value, text in axis.divisions.items():
            if axis.low <= value <= axis.high:
                foot = field.at(value, y.low) if axis is x else field.at(x.low, value)
                canvas.add(Line(foot, foot + 0.4 * height * inward, Pen.THIN, role="division"))
                canvas.add(Text(foot - height * outward, text, height, anchor, role="number"))
    if _inside(y):
        canvas.add(Line(field.at(x.low, 0.0), field.at(x.high, 0.0), Pen.AXIS, role="axis"))
    if _inside(x):
        canvas.add(Line(field.at(0.0, y.low), field.at(0.0, y.high), Pen.AXIS, role="axis"))
    label = scene.style.label
    for end, along, letter, aside in (
        (corners[1], 1 + 0j, x.letter, complex(0.0, 0.6 * label)),
        (corners[3], 1j, y.letter, complex(0.8 * label, -0.5 * label)),
    ):
        tip = end + BEYOND * label * along
        canvas.add(Line(end, tip, Pen.THIN, role="axis"), Head(tip, along))
        canvas.add(Text(tip + aside, letter, label, "middle" if along == 1 else "left"))
    canvas.part(before)
    canvas.bounds = (corners[0].real, corners[0].imag, corners[2].real, corners[2].imag)


def _inside(axis: Axis) -> bool:
    """Whether zero lies so far inside of the window that its line is told apart from the side."""
    return axis.scale.drawn(min(-axis.low, axis.high)) > AT_SIDE


def _thinned(field: Field, run: Iterable[complex]) -> tuple[complex, ...]:
    """Return places of a curve on the paper, those left out that a chord passes closely."""
    return thinned([field.at(place.real, place.imag) for place in run], FINE)


def _limit(scene: GearScene, name: str) -> str:
    """Return what a curve stands for, in symbols."""
    symbol, (greater, less, _) = scene.words.symbol, OF_CURVE[name]
    if less == LEAST_TIP:
        return f"{symbol(greater)} = {scene.words.short(scene.solved.pair.least_tip)}m"
    if isinstance(less, float):
        return f"{symbol(greater)} = {scene.words.short(less)}"
    first, second = sorted((greater, less))  # x_1 = x_min1, rho_l1 = rho_p1
    return f"{symbol(first)} = {symbol(second)}"
