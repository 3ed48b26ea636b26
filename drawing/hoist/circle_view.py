"""The circle of phase 2: abscissas are the force of the rope, ordinates its rate by k_1, both to one scale."""

from __future__ import annotations

from ...plans.hoist.model import CIRCLE
from ..dimensions import angle
from ..figure import Figure, Stage, stages
from ..shapes import Arc, Group, Head, Line, Pen
from ..symbols import arc_between
from ..view import Canvas, View
from .scene import HoistScene

PAST = 14.0  # mm by which the axis runs past the circle
SAME = 1e-6  # part of the radius
ANGLE = 0.3  # part of the radius at which the angle is dimensioned


def circle_view(scene: HoistScene) -> View:
    """Draw the circle with its start, its diameter and the angle run through."""
    canvas, words = CIRCLE_FIGURE.canvas(scene), scene.words
    centre = scene.mm(f"{CIRCLE}.C")  # the origin of the view
    start, right, left = (scene.mm(f"{CIRCLE}.{mark}") - centre for mark in ("1", "max", "min"))
    radius = right.real
    canvas.part("axes")
    end, top = right + PAST, 1j * (radius + PAST)
    for a, b in ((left - PAST, end), (-top, top)):
        canvas.add(Line(a, b, Pen.THIN, role="axis"), Head(b, b - a))
    canvas.label(f"{words.symbol('P_12')}, {words.unit('N')}", end, prefer=-1j, clear=1.2)
    canvas.label(f"P′_{{12}}/k_{{1}}, {words.unit('N')}", top, prefer=1.0 + 0j, clear=1.2)
    canvas.part("circle")
    _circle(canvas, scene, (left, right))
    canvas.add(Line(0j, start, Pen.MAIN, role="radius", name="R"))
    canvas.part("ends")
    angle(canvas, 0j, (start, right), max(ANGLE * radius, 8.0), "phi_1", scene.stated("phi_1", unit="rad"), turn=-1)
    canvas.part("circle")
    canvas.label(words.symbol("R"), (0j, start), clear=1.0, height=scene.style.text)
    marks = {"P_m": 0j, "F_12_t1": start, "P_12_max": right, "P_12_min": left}
    reached = {"P_12_max": scene.size("P_m") + scene.size("R"), "P_12_min": scene.size("P_m") - scene.size("R")}
    for name, at in marks.items():
        if abs(reached.get(name, scene.size(name)) - scene.size(name)) > SAME * scene.size("R"):
            continue  # the rope goes slack before, or the load comes back
        canvas.part("ends" if name in reached else "start")
        canvas.add(scene.node(at, name, filled=True))
        canvas.label(scene.stated(name), at, prefer=(at or -1j) - 0.6j, clear=1.2, height=scene.style.text)
    notes = (scene.stated("R"), *([words["hoist.slack"]] if scene.solved.layout.slack else []))
    return canvas.finish("circle", (words["heading.hoist_circle"], scene.factors("mu_F_circle")), notes)


def _arc(a: complex, b: complex) -> Arc:
    return arc_between(0j, a, b, Pen.MAIN)


def _circle(canvas: Canvas, scene: HoistScene, ends: tuple[complex, complex]) -> None:
    """Draw the circle; where the rope would push it is only dashed, beyond a line where its force is zero."""
    left, right = ends
    if not scene.solved.layout.slack:
        canvas.add(Group((_arc(right, left), _arc(left, right)), "circle", "R"))
        return
    high, low = (scene.mm(f"{CIRCLE}.{mark}") - scene.mm(f"{CIRCLE}.C") for mark in ("high", "low"))
    canvas.add(Group((_arc(low, right), _arc(right, high)), "circle", "R"))
    canvas.add(arc_between(0j, high, low, Pen.DASHED, role="slack"))
    canvas.add(Line(low, high, Pen.THIN, role="level", name="slack"))
    symbol = scene.words.symbol("P_12")
    canvas.label(f"{symbol} = 0", high, prefer=-1.0 + 1j, clear=1.2, height=scene.style.text)


# a rope that goes slack need not reach the ends of the diameter: they are no step of their own
ENDS = Stage("ends", when=lambda scene: scene.solved.forces.motion is None)
CIRCLE_FIGURE = Figure(
    "circle", circle_view, ("mu_F_circle",), (*stages("axes", "start", "circle"), ENDS), "hoist.circle"
)
