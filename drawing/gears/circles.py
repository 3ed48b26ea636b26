"""The frame of a meshing: circles with their diameters, line of centres, common tangent, line of action."""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence

from ..dimensions import linear
from ..figure import ANSWERS
from ..shapes import Anchor, Arc, Circle, Group, Line, Pen, Text
from ..symbols import angle_dimension, fixed_pivot, right_angle, turning_arrow
from ..view import Canvas
from ..words import indexed
from .scene import GearScene
from .wheels import CIRCLES, SHOWN, Wheel

Span = tuple[float, float]
PENS = {"a": Pen.THIN, "w": Pen.EXTREME, "": Pen.AXIS, "b": Pen.DASHED, "f": Pen.THIN}
PAST = 8.0  # mm of a line beyond what it goes to
PITCH = 1.9  # heights of letters between diameters written under one another
SHELF = 5.0  # mm from the longest arc to the diameters
SAME = 0.02  # mm between circles that are one line
STAGE = {"w": "rolling_circles", "b": "line_of_action"}  # of the circles, but for those of the teeth
WIDEST = 0.9 * math.pi  # half the angle of circles at most
TURNING = 3.2  # radius of the arrows of omega, in heights of letters


def beside_teeth(wheel: Wheel) -> Span:
    """Return between which angles from the direction to the pole the circles of a wheel are drawn, just beyond teeth.

    The second one lies on the free side, away from the line of action.
    """
    lean = abs(wheel.angle(wheel.centre + wheel.facing))
    reach = 0.5 * SHOWN * wheel.pitch + PAST / wheel.radius("a")
    return -wheel.side * min(reach + lean, WIDEST), wheel.side * min(reach - lean, WIDEST)


def circles(canvas: Canvas, wheel: Wheel, span: Span, to_end: bool) -> None:
    """Draw arcs of the five circles, each with a line of its own; the base circle `to_end` of the line of action."""
    for name in CIRCLES:
        low, high = span
        if to_end and name == "b":
            low = -wheel.side * max(abs(low), wheel.sizes["alpha_w"] + PAST / wheel.radius("b"))
        same = abs(wheel.radius(name) - wheel.radius("")) < SAME
        arc = Arc(wheel.centre, wheel.radius(name), cmath.phase(wheel.up) + low, high - low, PENS["" if same else name])
        canvas.part(STAGE.get(name, "circles"))
        canvas.add(Group((arc,), "circle", f"d_{name}{wheel.number}"))


def diameters(canvas: Canvas, scene: GearScene, wheel: Wheel, angle: float, others: Sequence[complex]) -> None:
    """Write the diameters where the circles end on the free side, under one another, each on a leader.

    They stand beyond the `others`, points of teeth and circles, that come as high as they are. Beside the middle of the
    meshing that is drawn apart they have only their letters.
    """
    height, side = scene.style.text, -wheel.up.imag  # in which the wheel is from the pole: +1 above, -1 below
    out = wheel.side * side  # to the right, or to the left
    ends = {f"d_{name}{wheel.number}": wheel.on(wheel.radius(name), angle) for name in CIRCLES}
    stage_of = {f"d_{name}{wheel.number}": STAGE.get(name, "circles") for name in CIRCLES}
    names = sorted(ends, key=lambda name: side * ends[name].imag)
    apart = _apart([side * ends[name].imag for name in names], PITCH * height)
    levels = [max(level, (k + 1) * PITCH * height) for k, level in enumerate(apart)]  # clear of t-t and its letters
    near = [p for p in others if levels[0] - 2.0 * height < side * p.imag < levels[-1] + height]
    x = max(out * end.real for end in (*ends.values(), *near)) + SHELF
    anchor: Anchor = "left" if out > 0.0 else "right"
    for name, level in zip(names, levels, strict=True):
        at = complex(out * x, side * level)
        canvas.part(stage_of[name])
        canvas.add(Line(ends[name], at, Pen.THIN, role="leader", name=name))
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


def centres(canvas: Canvas, scene: GearScene, pair: tuple[Wheel, Wheel], left: float) -> None:
    """Draw both centres on the line of centres, their distance as a dimension at the abscissa `left`."""
    style, sense = scene.style, scene.meshing.sense
    below, above = (scene.mm(f"O{wheel.number}") for wheel in pair)
    canvas.part("centres")
    canvas.add(Line(below - 2j * PAST, above + 2j * PAST, Pen.AXIS, role="axis", name="O1O2"))
    for wheel, at in zip(pair, (below, above), strict=True):
        canvas.add(fixed_pivot(at, f"O{wheel.number}", style, -wheel.up))
        canvas.label(f"O_{{{wheel.number}}}", at, prefer=complex(1.0, 0.3), clear=style.pair + 0.8)
        turns = sense if wheel.number == 1 else -sense
        canvas.part(ANSWERS)
        _turning(canvas, scene, wheel, float(turns))
        canvas.part("centres")
    canvas.part(ANSWERS)
    linear(canvas, (below, above), complex(left, 0.0), scene.stated("a_w"), "a_w")


def _turning(canvas: Canvas, scene: GearScene, wheel: Wheel, turns: float) -> None:
    """Draw the arrow of a wheel's turning beside its centre, away from the teeth."""
    radius, name = TURNING * scene.style.label, f"omega_{wheel.number}"
    middle = cmath.phase(wheel.up) + turns * 0.5 * math.pi
    canvas.add(turning_arrow(wheel.centre, radius, middle, 0.9, turns, name))
    at = wheel.centre + cmath.rect(radius, middle)
    canvas.label(scene.words.symbol(name), at, prefer=at - wheel.centre, clear=1.0)


def tangent(canvas: Canvas, left: float, right: float) -> None:
    """Draw the common tangent t-t of the rolling circles through the pole."""
    canvas.part("rolling_circles")
    canvas.add(Line(complex(left, 0.0), complex(right, 0.0), Pen.THIN, role="tangent", name="t"))
    for end in (left, right):
        canvas.label("t", complex(end, 0.0), prefer=complex(end, 0.0), clear=0.8)


def line_of_action(canvas: Canvas, scene: GearScene, pair: tuple[Wheel, Wheel]) -> None:
    """Draw N1N2 with the radii to its ends."""
    along, size = scene.meshing.along, 0.6 * scene.style.label
    ends = [scene.mm(f"N{wheel.number}") for wheel in pair]
    canvas.part("line_of_action")
    canvas.add(Line(ends[0] - PAST * along, ends[1] + PAST * along, Pen.THIN, role="line-of-action", name="N1N2"))
    for wheel, end, inside in zip(pair, ends, (along, -along), strict=True):
        name = f"N{wheel.number}"
        canvas.add(Line(wheel.centre, end, Pen.THIN, role="radius", name=name))
        radius = (wheel.centre - end) / abs(wheel.centre - end)
        canvas.part(ANSWERS)
        canvas.add(right_angle(end, radius, inside, size))
        canvas.part("line_of_action")
        node(canvas, scene, name, -radius)


def active_line(canvas: Canvas, scene: GearScene, inner: bool = True) -> None:
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


def middle(canvas: Canvas, pair: tuple[Wheel, Wheel]) -> None:
    """Draw the line of centres as far as the teeth go."""
    low, high = (wheel.on(wheel.radius("f") - PAST, 0.0) for wheel in pair)
    canvas.part("centres")
    canvas.add(Line(low, high, Pen.AXIS, role="axis", name="O1O2"))


def angle_of_action(canvas: Canvas, scene: GearScene) -> None:
    """Dimension alpha_w between t-t and N1N2, on the side of the farther end of the line."""
    first, second = (scene.mm(name) for name in ("N1", "N2"))
    far = max((first, second), key=abs)
    reach = 0.85 * abs(far)
    start = math.pi if far.real < 0.0 else 0.0
    sweep = math.remainder(cmath.phase(far) - start, 2.0 * math.pi)
    canvas.part(ANSWERS)
    canvas.add(angle_dimension(0j, reach, start, sweep, "alpha_w", scene.style))
    middle = cmath.rect(reach, start + 0.5 * sweep)
    canvas.label(scene.angle("alpha_w"), middle, prefer=middle, clear=1.0, height=scene.style.text)


def node(canvas: Canvas, scene: GearScene, name: str, prefer: complex) -> None:
    """Mark a point of the meshing with its letter."""
    at, radius = scene.mm(name), scene.style.node
    canvas.add(Group((Circle(at, radius, Pen.THIN, fill="white"),), "point", name))
    canvas.label(indexed(name), at, prefer=prefer, clear=radius + 0.6)
