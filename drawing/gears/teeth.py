"""Teeth in mesh: outlines, active flanks, and the pair where it begins and where it ends to touch."""

from __future__ import annotations

import cmath
from collections.abc import Sequence
from itertools import pairwise

from ..shapes import Arc, Group, Line, Pen, Polyline
from ..view import Canvas
from .circles import node
from .scene import GearScene
from .wheels import Wheel

STRIP, STROKES = 0.5, 0.5  # width of the strip along an active flank, distance of its strokes, in heights of letters
ROUNDING = 1.0 + 1e-9
ENDS = ("start", "end")  # of the engagement


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
        radius, start = abs(end - wheel.centre), cmath.phase(end - wheel.centre)
        sweep = cmath.phase((low - wheel.centre) / (end - wheel.centre))
        canvas.add(Arc(wheel.centre, radius, start, sweep, Pen.THIN, role="swing", name=name))
        node(canvas, scene, name, -wheel.inward(low))
