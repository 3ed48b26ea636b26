"""How far the beams bend, magnified: the support beam under the load at rest, the bridge beam under the rope."""

from __future__ import annotations

from ...plans.hoist.construction import BENT, FORCE, LETTERS, SECTIONS
from ...plans.hoist.solve import OF_BEAM, bent
from ..dimensions import linear
from ..figure import Figure, stages
from ..shapes import Group, Line, Pen, Polyline
from ..symbols import revolute
from ..view import Canvas, View
from .scene import HoistScene

APART = 14.0  # mm between the beams
SAME = 0.5  # mm


def beams_view(scene: HoistScene) -> View:
    """Draw the bent beams under their axes."""
    canvas, words, low = BEAMS.canvas(scene), scene.words, 0.0
    for i in scene.solved.layout.bent:
        low = _beam(canvas, scene, i, low) - APART
    heading = (words["heading.hoist_beams"], scene.factors("mu_w", "mu_x"))
    return canvas.finish("beams", heading, (words["hoist.from_farther"],))


def _beam(canvas: Canvas, scene: HoistScene, i: int, top: float) -> float:
    """Draw one beam with its axis at `top`; return how low it reaches, mm."""
    plan, words, by = BENT[i], scene.words, 1j * top
    feet = [scene.mm(f"{plan}.f{n}") + by for n in range(SECTIONS + 1)]
    canvas.part("axes")
    canvas.add(Line(feet[0], feet[-1], Pen.AXIS, role="axis", name=plan))
    canvas.part("bent")
    for letter, force in zip(LETTERS, FORCE[i], strict=False):
        points = tuple(place + by for place in scene.places(bent(scene.solved, i, letter, force)))
        nodes = (scene.node(scene.mm(f"{plan}.{letter}{n}") + by, f"{letter}{n}") for n in range(1, SECTIONS))
        pen = Pen.MAIN if letter == LETTERS[0] else Pen.THIN
        canvas.add(Group((Polyline(points, pen),), "curve", f"{plan}_{letter}"), *nodes)
        canvas.label(words.symbol(force), points[2 * OF_BEAM // 3], prefer=-1j, clear=1.2, height=scene.style.text)
    canvas.part("axes")
    for end in (feet[0], feet[-1]):
        canvas.add(revolute(end, plan, scene.style))
    canvas.label(words["hoist.beam_0" if i == 0 else "hoist.beam_2"], feet[0], prefer=-1.0 + 0j, clear=2.0)
    places = [("M", "fM", f"w_{i}_max")]
    if abs(scene.mm(f"{plan}.A") - scene.mm(f"{plan}.M")) > SAME:  # in the middle of the beam they are one
        places.insert(0, ("A", "fA", f"w_{i}"))
    for mark, foot, name in places:
        canvas.part("bent" if mark == "A" else "greatest")
        at, above = scene.mm(f"{plan}.{mark}") + by, scene.mm(f"{plan}.{foot}") + by
        canvas.add(Line(above, at, Pen.THIN, role="deflection", name=name), scene.node(at, name, filled=True))
        said = scene.stated(name, float(scene.solved.quantities[name].value or 0.0) * 1e3, "mm")
        canvas.label(said, at, prefer=-1.0 - 1j if mark == "A" else 1.0 - 1j, clear=1.2, height=scene.style.text)
    canvas.part("greatest")
    ends = scene.mm(f"{plan}.fM") + by, feet[-1]
    linear(canvas, ends, 6j, scene.stated(f"x_w{i}", unit="m"), f"x_w{i}")
    return top + min(scene.mm(f"{plan}.M").imag, 0.0)


BEAMS = Figure("beams", beams_view, ("part",), stages("axes", "bent", "greatest"), "hoist.beams")
