"""The meshing: both wheels about their centres, three teeth of each, the line of action; its middle apart, larger."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

from ...plans.gears.construction import MESHING
from ...plans.gears.teeth import CIRCLES, SHOWN, Wheel
from ...plans.names import role
from ..dimensions import angle, linear, turning
from ..figure import ANSWERS, Figure, stages
from ..page import extent
from ..shapes import Anchor, Arc, Circle, Group, Line, Pen, Polyline, Text
from ..symbols import HALF_TURN, arc_between, fixed_pivot, right_angle, unit
from ..view import Canvas, View
from ..words import indexed
from .scene import TOOTH, GearScene

PENS = {"a": Pen.THIN, "w": Pen.EXTREME, "": Pen.AXIS, "b": Pen.DASHED, "f": Pen.THIN}
# lines that break off at letters, and whether letters take no heed of them
BREAKS = dict.fromkeys(("circle", "tangent", "axis", "extension", "swing", "position"), True)
BREAKS |= {"line-of-action": False}
PAST = 8.0  # mm of a line beyond what it goes to
PITCH = 1.9  # heights of letters between diameters written under one another
SHELF = 5.0  # mm from the longest arc to the diameters
SAME = 0.02  # mm between circles that are one line
STAGE = {"w": "rolling_circles", "b": "line_of_action"}  # of the circles, but for those of the teeth
WIDEST = 0.9 * HALF_TURN  # half the angle of circles at most
SCHEME = 45.0  # mm between the centres where only the kind of the pair is told
TURNING = 3.2  # radius of the arrows of omega, in heights of letters
INSIDE = 1.8  # heights of letters from the root circle to the arc of the pitch
TAU, PHI = 0.48, 0.76  # parts of the root's radius at which the angles of pitch and of action are dimensioned
CLOSE = 6.0  # radius of an arc in heights of letters
Ends = tuple[complex, complex]
BESIDE = 10.0  # mm from the circles to the dimension of the distance of the centres
Pair = tuple[Wheel, Wheel]
STRIP, STROKES = 0.5, 0.5  # width of the strip along an active flank, distance of its strokes, in heights of letters
ROUNDING = 1.0 + 1e-9
ENDS = ("start", "end")  # of the engagement


def pair_view(scene: GearScene) -> View:
    """Draw what is given of the pair: two wheels that roll on one another, their centres, the sense of the pinion."""
    canvas, style, (pinion, wheel) = Canvas(scene.style), scene.style, scene.wheels()
    for one in (pinion, wheel):
        letter, radius = indexed(f"O{one.number}"), one.radius("w")
        canvas.group("circle", str(one.number), Circle(one.centre, radius, Pen.MAIN))  # letters may stand inside
        canvas.add(fixed_pivot(one.centre, f"O{one.number}", style))
        canvas.label(letter, one.centre, prefer=1.0 + 0.6j, clear=2.0)
        canvas.label(str(one.number), one.on(radius, 0.5 * HALF_TURN), prefer=1j * one.up, clear=1.2)
    canvas.add(Line(pinion.centre, wheel.centre, Pen.AXIS, role="axis"))
    canvas.label("W", 0j, prefer=1.0 + 0j, clear=2.0)
    radius, letter = 0.6 * pinion.radius("w"), scene.words.symbol("omega_1")
    turning(canvas, pinion.centre, radius, 0.0, 0.5 * HALF_TURN, scene.solved.pair.sense, "omega_1", letter)
    return canvas.finish("kinematic", (scene.words["heading.kinematic"],))


def _diameters(canvas: Canvas, scene: GearScene, wheel: Wheel, end: float, others: Sequence[complex]) -> None:
    """Write the diameters where the circles end on the free side, under one another, each on a leader.

    They stand beyond the `others`, points of teeth and circles, that come as high as they are. Beside the middle of the
    meshing that is drawn apart they have only their letters.
    """
    height, side = scene.style.text, -wheel.up.imag  # in which the wheel is from the pole: +1 above, -1 below
    out = wheel.side * side  # to the right, or to the left
    ends = {name: wheel.on(wheel.radius(name), end) for name in CIRCLES}
    circles = sorted(ends, key=lambda circle: side * ends[circle].imag)
    apart = _apart([side * ends[circle].imag for circle in circles], PITCH * height)
    levels = [max(level, (k + 1) * PITCH * height) for k, level in enumerate(apart)]  # clear of t-t and its letters
    near = [p for p in others if levels[0] - 2.0 * height < side * p.imag < levels[-1] + height]
    x = max(out * end.real for end in (*ends.values(), *near)) + SHELF
    anchor: Anchor = "left" if out > 0.0 else "right"
    for circle, level in zip(circles, levels, strict=True):
        name, at = f"d_{circle}{wheel.number}", complex(out * x, side * level)
        canvas.part(STAGE.get(circle, "circles"), Line(ends[circle], at, Pen.THIN, role="leader", name=name))
        text = scene.words.symbol(name) if scene.close else scene.stated(name)
        place = at + complex(out, -0.5 * height)
        canvas.add(Text(place, text, height, anchor, role="diameter", name=name))


def _apart(levels: Sequence[float], least: float) -> list[float]:
    """Return rising levels moved as little as it takes for them to stand apart."""
    groups: list[tuple[float, int]] = []  # of levels side by side: their middle, how many they are
    for level in levels:
        groups.append((level, 1))
        while len(groups) > 1:
            (a, m), (b, n) = groups[-2:]
            if b - a >= 0.5 * least * (m + n):
                break
            groups[-2:] = [((a * m + b * n) / (m + n), m + n)]
    return [middle + (k - 0.5 * (count - 1)) * least for middle, count in groups for k in range(count)]


def _centres(canvas: Canvas, scene: GearScene, pair: Pair, left: float) -> None:
    """Draw both centres on the line of centres, their distance as a dimension at the abscissa `left`."""
    style, sense = scene.style, scene.meshing.sense
    below, above = (scene.mm(f"O{wheel.number}") for wheel in pair)
    canvas.part("centres", Line(below - 2j * PAST, above + 2j * PAST, Pen.AXIS, role="axis", name="O1O2"))
    for wheel, at in zip(pair, (below, above), strict=True):
        canvas.part("centres" if wheel.number == 2 else "start")
        canvas.add(fixed_pivot(at, f"O{wheel.number}", style, -wheel.up))
        canvas.label(f"O_{{{wheel.number}}}", at, prefer=complex(1.0, 0.3), clear=style.pair + 0.8)
        turns, name = float(sense if wheel.number == 1 else -sense), f"omega_{wheel.number}"
        canvas.part(ANSWERS)
        radius, middle = TURNING * style.label, 0.0  # on the right: the extension lines run to the left
        turning(canvas, wheel.centre, radius, middle, 0.9, turns, name, scene.words.symbol(name))
    canvas.part(ANSWERS)
    linear(canvas, (below, above), complex(left, 0.0), scene.stated("a_w"), "a_w")


def _tangent(canvas: Canvas, left: float, right: float) -> None:
    """Draw the common tangent t-t of the rolling circles through the pole."""
    canvas.part("rolling_circles", Line(complex(left, 0.0), complex(right, 0.0), Pen.THIN, role="tangent", name="t"))
    for end in (left, right):
        canvas.label("t", complex(end, 0.0), prefer=complex(end, 0.0), clear=0.8)


def _line_of_action(canvas: Canvas, scene: GearScene, pair: Pair) -> None:
    """Draw N1N2 with the radii to its ends."""
    along, size = scene.meshing.along, 0.6 * scene.style.label
    ends = [scene.mm(f"N{wheel.number}") for wheel in pair]
    canvas.part("line_of_action")
    canvas.add(Line(ends[0] - PAST * along, ends[1] + PAST * along, Pen.THIN, role="line-of-action", name="N1N2"))
    for wheel, end, inside in zip(pair, ends, (along, -along), strict=True):
        name = f"N{wheel.number}"
        canvas.add(Line(wheel.centre, end, Pen.THIN, role="radius", name=name))
        radius = unit(wheel.centre - end)
        canvas.part(ANSWERS, right_angle(end, radius, inside, size))
        canvas.part("line_of_action")
        node(canvas, scene, name, -radius)


def _active_line(canvas: Canvas, scene: GearScene, inner: bool = True) -> None:
    """Draw the active part of the line of action thick, the pole on it, and its `inner` ends of single contact.

    Where undercut or pointed teeth lack a part of their flanks, it is thick only along what is left.
    """
    along = scene.meshing.along
    first, last = scene.mm("A1"), scene.mm("A2")
    canvas.part("active_line")
    if inner or scene.lacking:
        canvas.add(Line(first - PAST * along, last + PAST * along, Pen.THIN, role="line-of-action", name="A1A2"))
    if scene.lacking:
        first, last = (scene.meshing.place(rho_1) * (1.0 / scene.mu_l) for rho_1 in scene.touching)
    canvas.add(Line(first, last, Pen.MAIN, role="active", name="A1A2"))
    node(canvas, scene, "A1", -along - 1j)
    node(canvas, scene, "A2", along + 1j)
    canvas.part("centres")
    node(canvas, scene, "P", along.conjugate() * -1j)
    canvas.part("single_contact")
    for name in ("K1", "K2") if inner else ():
        node(canvas, scene, name, 1j * along)


def node(canvas: Canvas, scene: GearScene, name: str, prefer: complex) -> None:
    """Mark a point of the meshing with its letter."""
    at, radius = scene.mm(name), scene.style.node
    canvas.group("point", name, Circle(at, radius, Pen.THIN, fill="white"))
    canvas.label(indexed(name), at, prefer=prefer, clear=radius + 0.6)


def _pitch(canvas: Canvas, scene: GearScene, wheel: Wheel, to_centre: bool) -> None:
    """Dimension the pitch below the root, on lines from the reference circle; these run `to_centre` with its angle."""
    i, radius = wheel.number, wheel.radius("")
    ends = wheel.at(radius, wheel.side), wheel.at(radius)
    low = wheel.radius("f") - INSIDE * scene.style.label
    for end in ends:
        foot = wheel.centre if to_centre else wheel.towards(end, low - 0.4 * scene.style.label)
        canvas.add(Line(end, foot, Pen.THIN, role="extension", name=f"p_{i}"))
    _along(canvas, scene, wheel, _on(wheel, ends, low), f"p_{i}")
    if to_centre:
        _along(canvas, scene, wheel, _on(wheel, ends, TAU * wheel.radius("f")), f"tau_{i}")


def _along(canvas: Canvas, scene: GearScene, wheel: Wheel, ends: Ends, name: str) -> None:
    """Dimension an arc about the wheel's centre between two points of it; the pitch of both wheels is one."""
    a, b = (end - wheel.centre for end in ends)
    kind = role(name).kind
    text = scene.angle(name) if kind in ("tau", "phi") else scene.stated("p" if kind == "p" else name)
    spare = text if abs(a) < CLOSE * scene.style.label else ""  # near the centre there may be no room
    last = text if scene.close else ""  # nor among teeth on a small format
    angle(canvas, wheel.centre, (a, b), abs(a), name, text, inside=True, spare=spare, last=last)


def _on(wheel: Wheel, ends: Ends, radius: float) -> Ends:
    """Return the points of a circle about the centre that lie on the rays to the ends."""
    a, b = (wheel.towards(end, radius) for end in ends)
    return a, b


def _meshing_view(scene: GearScene) -> View:
    """Draw the pair about its centres while a pair of teeth touches at the pole."""
    canvas, pair = FIGURE.canvas(scene, coarse=0.0), scene.wheels()
    canvas.breaks = BREAKS
    left, right = _circles(canvas, scene, pair, to_end=True)
    _centres(canvas, scene, pair, extent(canvas.shapes)[0] - BESIDE)
    _tangent(canvas, left, right)
    _line_of_action(canvas, scene, pair)
    _active_line(canvas, scene, not scene.apart)
    far = max(scene.mm("N1"), scene.mm("N2"), key=abs)
    canvas.part(ANSWERS)
    angle(
        canvas, 0j, (complex(-1.0 if far.real < 0.0 else 1.0), far), 0.85 * abs(far), "alpha_w", scene.angle("alpha_w")
    )
    if scene.apart:
        _outlines(canvas, pair)
    else:
        _details(canvas, scene, pair)
    canvas.part(ANSWERS)
    for wheel in pair:
        _pitch(canvas, scene, wheel, to_centre=True)
    for wheel in pair:  # the angle by which it turns while one pair of teeth touches, between rays to its flanks
        i, name = wheel.number, f"phi_alpha{wheel.number}"
        ends = scene.mm(f"B{i}_start"), scene.mm(f"B{i}_end")
        canvas.add(*(Line(end, wheel.centre, Pen.THIN, role="ray", name=name) for end in ends))
        _along(canvas, scene, wheel, _on(wheel, ends, PHI * wheel.radius("f")), name)
    return _finished(canvas, scene, "meshing", not scene.apart)


def _near_view(overall: GearScene) -> View:
    """Draw the middle of the meshing apart, larger."""
    scene = replace(overall, mu_l=overall.near, close=True)
    canvas, pair = NEAR.canvas(scene, coarse=0.0), scene.wheels()
    canvas.breaks = BREAKS
    _tangent(canvas, *_circles(canvas, scene, pair, to_end=False))
    low, high = (wheel.on(wheel.radius("f") - PAST, 0.0) for wheel in pair)
    canvas.part("centres", Line(low, high, Pen.AXIS, role="axis", name="O1O2"))
    _active_line(canvas, scene)
    _details(canvas, scene, pair)
    for wheel in pair:
        _pitch(canvas, scene, wheel, to_centre=False)
    return _finished(canvas, scene, "near", detailed=True)


def _finished(canvas: Canvas, scene: GearScene, name: str, detailed: bool) -> View:
    """Close a view, with what its lines and letters mean where it has details."""
    words = scene.words
    gap = f"{scene.length(scene.solved.size('c_1'))} {words.unit('mm')}"
    notes = words["said.gear_meshing"].format(gap=gap).split("|") if detailed else []
    if detailed and scene.paper("h") < TOOTH:
        height = words.number(scene.paper("h"), 1)
        notes.append(words["said.gear_small"].format(height=height, usual=words.short(TOOTH)))
    return canvas.finish(name, (words[f"heading.gear_{name}"], scene.factor), tuple(notes))


def _circles(canvas: Canvas, scene: GearScene, pair: Pair, to_end: bool) -> tuple[float, float]:
    """Draw the circles with their diameters; return the abscissas between which they lie.

    Each has a line of its own; the base circle reaches `to_end` of the line of action.
    """
    spans = []  # angles from the direction to the pole just beyond the teeth; the second away from the line of action
    for wheel in pair:
        lean = abs(wheel.angle(wheel.centre + wheel.facing))
        reach = 0.5 * SHOWN * wheel.pitch + PAST / wheel.radius("a")
        spans.append((-wheel.side * min(reach + lean, WIDEST), wheel.side * min(reach - lean, WIDEST)))
    tips = [[wheel.on(wheel.radius("a"), a) for a in span] for wheel, span in zip(pair, spans, strict=True)]
    others = [*tips[0], *tips[1], *(point for wheel in pair for point in wheel.outline())]
    for wheel, span in zip(pair, spans, strict=True):
        for name in CIRCLES:
            low, high = span
            if to_end and name == "b":
                low = -wheel.side * max(abs(low), wheel.sizes["alpha_w"] + PAST / wheel.radius("b"))
            same = abs(wheel.radius(name) - wheel.radius("")) < SAME
            arc = Arc(wheel.centre, wheel.radius(name), wheel.direction + low, high - low, PENS["" if same else name])
            canvas.part(STAGE.get(name, "circles"), Group((arc,), "circle", f"d_{name}{wheel.number}"))
        _diameters(canvas, scene, wheel, span[1], others)
    xs = [tip.real for both in tips for tip in both]
    return min(xs), max(xs)


def _details(canvas: Canvas, scene: GearScene, pair: Pair) -> None:
    """Draw the teeth and what is measured on them."""
    canvas.part("single_contact")
    for name, rho_1 in zip(ENDS, scene.meshing.touching, strict=True):  # thin, those that touch at both ends
        for wheel in scene.wheels(rho_1):
            line = Polyline(wheel.outline(1), Pen.THIN, role="profile", name=f"{name}_{wheel.number}")
            canvas.group("position", name, line)
    _outlines(canvas, pair)
    canvas.part("lowest_points")
    lowest = [_active_flank(canvas, scene, wheel) for wheel in pair]
    for wheel, low in zip(pair, lowest, strict=True):
        name = f"L{wheel.number}"
        if low > scene.size(f"rho_p{wheel.number}") * ROUNDING:
            continue  # there is no flank: it is undercut
        # the end of the active line swung about the centre to the flank, which begins to touch there
        end, at = scene.mm(f"A{wheel.number}"), scene.mm(name)
        canvas.add(arc_between(wheel.centre, end, at, Pen.THIN, "swing", name, turn=0))
        node(canvas, scene, name, -wheel.inward(at))
    canvas.part(ANSWERS)
    for wheel in pair:  # a tooth beside the one in contact, away from N, and the space between both
        radius, i = wheel.radius(""), wheel.number
        tooth = wheel.at(radius, wheel.side), wheel.at(radius, wheel.side, active=False)
        _along(canvas, scene, wheel, tooth, f"s_{i}")
        _along(canvas, scene, wheel, (tooth[1], wheel.at(radius)), f"e_{i}")
    text, height = f"{scene.words.symbol('c')}{scene.words.symbol('m')}", scene.style.text
    for wheel, mate in zip(pair, reversed(pair), strict=True):  # radial gaps on the line of centres
        ends = scene.mm(f"C_f{wheel.number}"), scene.mm(f"C_a{mate.number}")
        linear(canvas, ends, 0j, "", f"gap_{wheel.number}")
        canvas.label(text, 0.5 * (ends[0] + ends[1]), prefer=complex(wheel.side, 0.0), clear=2.0, height=height)


def _outlines(canvas: Canvas, pair: Pair) -> None:
    """Draw the teeth of both wheels."""
    canvas.part("teeth")
    for wheel in pair:
        line = Polyline(wheel.outline(), Pen.MAIN, role="profile", name=f"teeth_{wheel.number}")
        canvas.group("wheel", str(wheel.number), line)


def _active_flank(canvas: Canvas, scene: GearScene, wheel: Wheel) -> float:
    """Double the active flank with a strip of strokes; return the radius of curvature at which it begins, m."""
    label, line, (first, last) = scene.style.label, scene.size("l_N1N2"), scene.meshing.touching
    low, high = (first, last) if wheel.number == 1 else (line - last, line - first)
    flank = wheel.flank(low, high)
    strip = [point + STRIP * label * wheel.inward(point) for point in flank]
    length = sum(abs(b - a) for a, b in pairwise(flank))
    picked = _spread(len(flank) - 1, round(length / (STROKES * label)))
    strokes = (Line(flank[i], strip[i], Pen.THIN, role="hatch") for i in picked)
    canvas.add(Group((Polyline(tuple(strip), Pen.THIN), *strokes), "active", f"flank_{wheel.number}"))
    return low


def _spread(last: int, steps: int) -> list[int]:
    """Return places from 0 to the `last`, evenly spread in so many steps, three or more where there are so many."""
    steps = min(max(3, steps), last)
    return [round(k * last / steps) for k in range(steps + 1)]


STAGES = stages(
    *("start", "centres", "rolling_circles", "line_of_action", "circles"),
    *("active_line", "teeth", "lowest_points", "single_contact"),
)
FIGURE = Figure(MESHING, _meshing_view, ("mu_l",), STAGES, "gear.meshing")
NEAR = Figure("near", _near_view, ("near",), STAGES)  # told with the meshing
