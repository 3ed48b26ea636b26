"""The meshing: both wheels about their centres, three teeth of each, the line of action; its middle apart."""

from __future__ import annotations

from dataclasses import replace

from ..figure import ANSWERS, Figure, stages
from ..page import extent
from ..view import Canvas, View
from . import along_circles, circles, teeth
from .ladders import TOOTH
from .scene import MESHING, GearScene
from .wheels import Wheel

BESIDE = 10.0  # mm from the circles to the dimension of the distance of the centres
Pair = tuple[Wheel, Wheel]


def meshing_view(scene: GearScene) -> View:
    """Draw the pair about its centres while a pair of teeth touches at the pole."""
    canvas, pair = FIGURE.canvas(scene), scene.wheels()
    left, right = _circles(canvas, scene, pair, to_end=True)
    circles.centres(canvas, scene, pair, extent(canvas.shapes)[0] - BESIDE)
    circles.tangent(canvas, left, right)
    circles.line_of_action(canvas, scene, pair)
    circles.active_line(canvas, scene, not scene.apart)
    circles.angle_of_action(canvas, scene)
    if scene.apart:
        teeth.outlines(canvas, pair)
    else:
        _details(canvas, scene, pair)
    canvas.part(ANSWERS)
    for wheel in pair:
        along_circles.pitch(canvas, scene, wheel, to_centre=True)
    along_circles.action(canvas, scene, pair)
    return _finished(canvas, scene, "meshing", not scene.apart)


def near_view(overall: GearScene) -> View:
    """Draw the middle of the meshing apart, larger."""
    scene = replace(overall, mu_l=overall.near, close=True)
    canvas, pair = NEAR.canvas(scene), scene.wheels()
    circles.tangent(canvas, *_circles(canvas, scene, pair, to_end=False))
    circles.middle(canvas, pair)
    circles.active_line(canvas, scene)
    _details(canvas, scene, pair)
    for wheel in pair:
        along_circles.pitch(canvas, scene, wheel, to_centre=False)
    return _finished(canvas, scene, "near", detailed=True)


def _finished(canvas: Canvas, scene: GearScene, name: str, detailed: bool) -> View:
    """Close a view, with what its lines and letters mean where it has details."""
    words = scene.words
    gap = f"{scene.length(scene.size('c') * scene.size('m'))} {words.unit('mm')}"
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
    teeth.positions(canvas, scene)
    teeth.outlines(canvas, pair)
    teeth.active_flanks(canvas, scene, pair)
    teeth.lowest_points(canvas, scene, pair)
    canvas.part(ANSWERS)
    for wheel in pair:
        along_circles.thickness(canvas, scene, wheel)
    along_circles.gaps(canvas, scene, pair)


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
