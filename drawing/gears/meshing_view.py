"""The meshing: both wheels about their centres, three teeth of each, the line of action; its middle apart."""

from __future__ import annotations

from dataclasses import replace

from ..view import Canvas, View
from . import along_circles, circles, teeth
from .scene import GearScene
from .wheels import Wheel

BESIDE = 10.0  # mm from the circles to the dimension of the distance of the centres
Pair = tuple[Wheel, Wheel]


def meshing_view(scene: GearScene) -> View:
    """Draw the pair about its centres while a pair of teeth touches at the pole."""
    canvas, pair = Canvas(scene.style), scene.wheels()
    left, reach = _circles(canvas, scene, pair, [circles.beside_ends(wheel) for wheel in pair])
    circles.centres(canvas, scene, pair, left - BESIDE)
    circles.tangent(canvas, reach)
    circles.line_of_action(canvas, scene, pair)
    circles.active_line(canvas, scene, not scene.apart)
    circles.angle_of_action(canvas, scene)
    if scene.apart:
        teeth.outlines(canvas, pair)
    else:
        _details(canvas, scene, pair)
    for wheel in pair:
        along_circles.pitch(canvas, scene, wheel, to_centre=True)
    along_circles.action(canvas, scene, pair)
    return canvas.finish("meshing", (scene.words["heading.gear_meshing"], scene.factor(scene.mu_l)))


def near_view(overall: GearScene) -> View:
    """Draw the middle of the meshing apart, larger."""
    scene = replace(overall, mu_l=overall.near)
    canvas, pair = Canvas(scene.style), scene.wheels()
    _, reach = _circles(canvas, scene, pair, [circles.beside_teeth(wheel) for wheel in pair])
    circles.tangent(canvas, reach)
    circles.active_line(canvas, scene)
    _details(canvas, scene, pair)
    for wheel in pair:
        along_circles.pitch(canvas, scene, wheel, to_centre=False)
    return canvas.finish("teeth", (scene.words["heading.gear_teeth"], scene.factor(scene.mu_l)))


def _circles(canvas: Canvas, scene: GearScene, pair: Pair, halves: list[float]) -> tuple[float, float]:
    """Draw the circles; return the abscissa of their left end, and how far t-t reaches."""
    for wheel, half in zip(pair, halves, strict=True):
        circles.circles(canvas, wheel, half)
        circles.diameters(canvas, scene, wheel, half)
    ends = [abs(wheel.on(wheel.radius("a"), half).real) for wheel, half in zip(pair, halves, strict=True)]
    return -max(ends), min(ends)


def _details(canvas: Canvas, scene: GearScene, pair: Pair) -> None:
    """Draw the teeth and what is measured on them."""
    teeth.positions(canvas, scene)
    teeth.outlines(canvas, pair)
    teeth.active_flanks(canvas, scene, pair)
    teeth.lowest_points(canvas, scene, pair)
    for wheel in pair:
        along_circles.thickness(canvas, scene, wheel)
    along_circles.gaps(canvas, scene, pair)
