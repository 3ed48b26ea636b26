"""The meshing: both wheels about their centres, three teeth of each, the line of action; its middle apart, larger."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

from ...plans.gears.construction import MESHING
from ...plans.gears.meshing import Wheel
from ..figure import ANSWERS, Figure, stages
from ..page import extent
from ..shapes import Group, Line, Pen, Polyline
from ..symbols import arc_between
from ..view import Canvas, View
from . import circles
from .circles import node
from .ladders import TOOTH
from .scene import GearScene

BESIDE = 10.0  # mm from the circles to the dimension of the distance of the centres
Pair = tuple[Wheel, Wheel]
STRIP, STROKES = 0.5, 0.5  # width of the strip along an active flank, distance of its strokes, in heights of letters
ROUNDING = 1.0 + 1e-9
ENDS = ("start", "end")  # of the engagement


def meshing_view(scene: GearScene) -> View:
    """Draw the pair about its centres while a pair of teeth touches at the pole."""
    canvas, pair = FIGURE.canvas(scene, coarse=0.0), scene.wheels()
    left, right = _circles(canvas, scene, pair, to_end=True)
    circles.centres(canvas, scene, pair, extent(canvas.shapes)[0] - BESIDE)
    circles.tangent(canvas, left, right)
    circles.line_of_action(canvas, scene, pair)
    circles.active_line(canvas, scene, not scene.apart)
    circles.angle_of_action(canvas, scene)
    if scene.apart:
        outlines(canvas, pair)
    else:
        _details(canvas, scene, pair)
    canvas.part(ANSWERS)
    for wheel in pair:
        circles.pitch(canvas, scene, wheel, to_centre=True)
    circles.action(canvas, scene, pair)
    return _finished(canvas, scene, "meshing", not scene.apart)


def near_view(overall: GearScene) -> View:
    """Draw the middle of the meshing apart, larger."""
    scene = replace(overall, mu_l=overall.near, close=True)
    canvas, pair = NEAR.canvas(scene, coarse=0.0), scene.wheels()
    circles.tangent(canvas, *_circles(canvas, scene, pair, to_end=False))
    circles.middle(canvas, pair)
    circles.active_line(canvas, scene)
    _details(canvas, scene, pair)
    for wheel in pair:
        circles.pitch(canvas, scene, wheel, to_centre=False)
    return _finished(canvas, scene, "near", detailed=True)


def _finished(canvas: Canvas, scene: GearScene, name: str, detailed: bool) -> View:
    """Close a view, with what its lines and letters mean where it has details."""
    words = scene.words
    gap = f"{scene.length(scene.solved.size('c_1'))} {words.unit('mm')}"
    notes = words["said.gear_meshing"].format(gap=gap).split("|") if detailed else []
    if detailed and scene.paper("h") < TOOTH:
        height = words.number(scene.paper("h"), 1)
        notes.append(words["said.gear_small"].format(height=height, usual=words.short(TOOTH)))
    return canvas.finish(name, (words[f"heading.gear_{name}"], scene.factor(scene.mu_l)), tuple(notes))


def _circles(canvas: Canvas, scene: GearScene, pair: Pair, to_end: bool) -> tuple[float, float]:
    """Draw the circles with their diameters; return the abscissas between which they lie."""
    spans = [circles.beside_teeth(wheel) for wheel in pair]
    tips = [[wheel.on(wheel.radius("a"), a) for a in span] for wheel, span in zip(pair, spans, strict=True)]
    others = [*tips[0], *tips[1], *(point for wheel in pair for point in wheel.outline())]
    for wheel, span in zip(pair, spans, strict=True):
        circles.circles(canvas, wheel, span, to_end)
        circles.diameters(canvas, scene, wheel, span[1], others)
    xs = [tip.real for both in tips for tip in both]
    return min(xs), max(xs)


def _details(canvas: Canvas, scene: GearScene, pair: Pair) -> None:
    """Draw the teeth and what is measured on them."""
    positions(canvas, scene)
    outlines(canvas, pair)
    active_flanks(canvas, scene, pair)
    lowest_points(canvas, scene, pair)
    canvas.part(ANSWERS)
    for wheel in pair:
        circles.thickness(canvas, scene, wheel)
    circles.gaps(canvas, scene, pair)


def outlines(canvas: Canvas, pair: Sequence[Wheel]) -> None:
    """Draw the teeth of both wheels."""
    canvas.part("teeth")
    for wheel in pair:
        line = Polyline(wheel.outline(), Pen.MAIN, role="profile", name=f"teeth_{wheel.number}")
        canvas.add(Group((line,), "wheel", str(wheel.number)))


def positions(canvas: Canvas, scene: GearScene) -> None:
    """Draw with thin lines the teeth that touch at both ends of the active line."""
    canvas.part("single_contact")
    for name, rho_1 in zip(ENDS, scene.meshing.touching, strict=True):
        for wheel in scene.wheels(rho_1):
            line = Polyline(wheel.outline(1), Pen.THIN, role="profile", name=f"{name}_{wheel.number}")
            canvas.add(Group((line,), "position", name))


def active_flanks(canvas: Canvas, scene: GearScene, pair: Sequence[Wheel]) -> None:
    """Double the active flanks of the teeth in contact with a strip of strokes."""
    label = scene.style.label
    canvas.part("lowest_points")
    for wheel in pair:
        flank = wheel.flank(*active_part(scene, wheel))
        strip = [point + STRIP * label * wheel.inward(point) for point in flank]
        length = sum(abs(b - a) for a, b in pairwise(flank))
        count = min(max(3, round(length / (STROKES * label))), len(flank) - 1)
        picked = (round(k * (len(flank) - 1) / count) for k in range(count + 1))
        strokes = (Line(flank[i], strip[i], Pen.THIN, role="hatch") for i in picked)
        canvas.add(Group((Polyline(tuple(strip), Pen.THIN), *strokes), "active", f"flank_{wheel.number}"))


def active_part(scene: GearScene, wheel: Wheel) -> tuple[float, float]:
    """Return between which radii of curvature the flank of a wheel touches its mate, m."""
    first, last = scene.meshing.touching
    line = scene.size("l_N1N2")
    return (first, last) if wheel.number == 1 else (line - last, line - first)


def lowest_points(canvas: Canvas, scene: GearScene, pair: Sequence[Wheel]) -> None:
    """Swing the ends of the active line about the wheel's centre to its flank: there the flank begins to touch."""
    canvas.part("lowest_points")
    for wheel in pair:
        name = f"L{wheel.number}"
        if active_part(scene, wheel)[0] > scene.size(f"rho_p{wheel.number}") * ROUNDING:
            continue  # there is no flank: it is undercut
        end, low = scene.mm(f"A{wheel.number}"), scene.mm(name)
        canvas.add(arc_between(wheel.centre, end, low, Pen.THIN, "swing", name, turn=0))
        node(canvas, scene, name, -wheel.inward(low))


STAGES = stages(
    "centres",
    "rolling_circles",
    "line_of_action",
    "circles",
    "active_line",
    "teeth",
    "lowest_points",
    "single_contact",
)
FIGURE = Figure(MESHING, meshing_view, ("mu_l",), STAGES, "gear.meshing")
NEAR = Figure("near", near_view, ("near",), STAGES)  # told with the meshing
