"""The circle of phase 2: abscissas are the force of the rope, ordinates its rate by k_1, both to one scale."""

from __future__ import annotations

from cmath import phase
from math import acos, cos, pi, sin

from ...plans.hoist.model import CIRCLE
from ..figure import Figure, Stage, stages
from ..shapes import Arc, Group, Head, Line, Pen
from ..symbols import angle_dimension
from ..view import Canvas, View
from .scene import COARSE, HoistScene

PAST = 14.0  # mm by which the axis runs past the circle
SAME = 1e-6  # part of the radius
ANGLE = 0.3  # part of the radius at which the angle is dimensioned


def circle_view(scene: HoistScene) -> View:
    """Draw the circle with its start, its diameter and the angle run through."""
    canvas, words = CIRCLE_FIGURE.canvas(scene, COARSE), scene.words
    centre, start = (scene.mm(f"{CIRCLE}.{mark}") for mark in ("C", "1"))
    start -= centre
    radius = abs(start)
    canvas.part("axes")
    left, right, top = complex(-radius - PAST), complex(radius + PAST), complex(0.0, radius + PAST)
    for a, b in ((left, right), (-top, top)):
        canvas.add(Line(a, b, Pen.THIN, role="axis"), Head(b, b - a))
    canvas.label(f"{words.symbol('P_12')}, {words.unit('N')}", right, prefer=-1j, clear=1.2)
    canvas.label(f"P′_{{12}}/k_{{1}}, {words.unit('N')}", top, prefer=1.0 + 0j, clear=1.2)
    canvas.part("circle")
    _circle(canvas, scene, radius)
    canvas.add(Line(0j, start, Pen.MAIN, role="radius", name="R"))
    canvas.part("ends")
    run = phase(start) % (2.0 * pi)
    canvas.add(angle_dimension(0j, max(ANGLE * radius, 8.0), run, -run, "phi_1", scene.style))
    middle = max(ANGLE * radius, 8.0) * complex(*_unit(0.5 * run))
    canvas.label(scene.stated("phi_1", unit="rad"), middle, prefer=middle, clear=1.0, height=scene.style.text)
    canvas.part("circle")
    canvas.label(words.symbol("R"), (0j, start), clear=1.0, height=scene.style.text)
    marks = {"P_m": 0j, "F_12_t1": start, "P_12_max": complex(radius), "P_12_min": complex(-radius)}
    reached = {"P_12_max": scene.size("P_m") + scene.size("R"), "P_12_min": scene.size("P_m") - scene.size("R")}
    for name, at in marks.items():
        if abs(reached.get(name, scene.size(name)) - scene.size(name)) > SAME * scene.size("R"):
            continue  # the rope goes slack before, or the load comes back
        canvas.part("ends" if name in reached else "start")
        canvas.add(scene.node(at, name, filled=True))
        canvas.label(scene.stated(name), at, prefer=(at or -1j) - 0.6j, clear=1.2, height=scene.style.text)
    notes = (scene.stated("R"), *([words["hoist.slack"]] if scene.size("P_m") < scene.size("R") else []))
    return canvas.finish("circle", (words["heading.hoist_circle"], scene.factors("mu_F_circle")), notes)


def _circle(canvas: Canvas, scene: HoistScene, radius: float) -> None:
    """Draw the circle; where the rope would push it is only dashed, beyond a line where its force is zero."""
    part = scene.size("P_m") / scene.size("R") if scene.size("R") else 1.0
    if part >= 1.0:
        canvas.add(Group(tuple(Arc(0j, radius, k * pi, pi, Pen.MAIN) for k in range(2)), "circle", "R"))
        return
    end = pi - acos(part)
    pulls = tuple(Arc(0j, radius, k * end, end, Pen.MAIN) for k in (-1, 0))
    canvas.add(Group(pulls, "circle", "R"), Arc(0j, radius, end, 2.0 * (pi - end), Pen.DASHED, role="slack"))
    x, high = -part * radius, radius * sin(end)
    canvas.add(Line(complex(x, -high), complex(x, high), Pen.THIN, role="level", name="slack"))
    symbol = scene.words.symbol("P_12")
    canvas.label(f"{symbol} = 0", complex(x, high), prefer=-1.0 + 1j, clear=1.2, height=scene.style.text)


def _unit(angle: float) -> tuple[float, float]:

    return cos(angle), sin(angle)


# a rope that goes slack need not reach the ends of the diameter: they are no step of their own
ENDS = Stage("ends", when=lambda scene: scene.solved.forces.motion is None)
CIRCLE_FIGURE = Figure(
    "circle", circle_view, ("mu_F_circle",), (*stages("axes", "start", "circle"), ENDS), "hoist.circle"
)
