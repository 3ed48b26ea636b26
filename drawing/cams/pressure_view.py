"""The pressure angle over the turn of the cam, between its limits."""

from __future__ import annotations

from collections.abc import Sequence

from ...plans.cams.course import courses, permitted, theta
from ...plans.cams.motion import RISE
from ...scales.scale import Scale, steps
from ..areas import beside
from ..diagram import Axis, Field, axes, divisions, numbers
from ..figure import Figure, stages
from ..printed import DEGREES
from ..shapes import Group, Line, Pen, Polyline, Text
from ..text import Box, box
from ..view import Canvas, View
from .scene import CamScene

SHARES = (0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8)  # of the line of a limit at which its text may stand
AROUND = 0.8  # mm around that text
Place = tuple[float, float]
WIDE = {5.0: 160.0, 3.5: 120.0}  # mm of the axis of angles beyond which it is half as long as on the diagrams
TALL = {5.0: 60.0, 3.5: 45.0}  # mm of the axis of pressure angles, by the height of letters


def pressure_view(scene: CamScene) -> View:
    """Draw theta over phi with the limits dashed over their phases."""
    solved, words = scene.solved, scene.words
    canvas, limits = FIGURE.canvas(scene), permitted(solved)
    curves = courses(solved)
    every = [y for points in curves for _, y in points] + [limit for _, limit in limits] + [0.0]
    field = _field(scene, min(every), max(every))
    canvas.part("axes")
    axes(canvas, field, lettered=False)
    canvas.part("curve")
    canvas.add(Group(tuple(Polyline(tuple(field.at(*p) for p in points)) for points in curves), "curve", "theta"))
    canvas.part("limits")
    boxes = [_limit(canvas, scene, field, curves, at) for at in limits]
    canvas.part("curve")
    _sections(canvas, scene, field, [found for found in boxes if found is not None])
    per_mm = f"{words.symbol('mu_theta')} = {scene.degrees(field.y.scale.mu)}/{words.unit('mm')}"
    heading = words["heading.cam_pressure"], f"{per_mm};  {scene.factor(field.x.scale)}"
    return canvas.finish("pressure", heading)


def _field(scene: CamScene, low: float, high: float) -> Field:
    words = scene.words
    tall = TALL[scene.style.label]
    mu = steps((high - low) * DEGREES / tall)[0] / DEGREES
    last = float(scene.solved.angles[-1])
    half = scene.across.drawn(last) > WIDE[scene.style.label]
    scale = Scale("mu_phi", scene.across.measured(2.0 if half else 1.0), "rad")
    across = Axis(words.symbol("phi"), scale, 0.0, last, {})
    marks = {x / DEGREES: f"{words.short(x)}°" for x in divisions(high * DEGREES, low * DEGREES, mu * DEGREES, 9.0)}
    return Field(0j, across, Axis(words.symbol("theta"), Scale("mu_theta", mu, "rad"), low, high, marks))


def _limit(
    canvas: Canvas, scene: CamScene, field: Field, curves: Sequence[Sequence[Place]], at: tuple[str, float]
) -> Box | None:
    """Draw a limit over its phase, and write it on the line; return the box of what stands among section lines."""
    name, limit = at
    motion, height = scene.solved.motion, scene.style.text
    phase = motion.rise if name == RISE else motion.fall
    ends = field.at(phase.start, limit), field.at(phase.end, limit)
    canvas.add(Group((Line(*ends, Pen.DASHED),), "limit", f"{name}{'' if limit > 0 else '-'}"))
    markup = f"[{scene.words.symbol('theta')}] = {scene.degrees(abs(limit))}"
    points = [field.at(*p) for course in curves for p in course]
    for share in SHARES if limit < field.y.high else ():  # section lines run through, or their numbers stand below
        text = Text(ends[0] + share * (ends[1] - ends[0]) + 0.5j * height, markup, height, "middle", role="label")
        x0, y0, x1, y1 = (side + AROUND * way for side, way in zip(box(text), (-1, -1, 1, 1), strict=True))
        if not any(x0 < p.real < x1 and y0 < p.imag < y1 for p in points):
            canvas.add(text)
            return x0, y0, x1, y1
    canvas.label(markup, ends, prefer=complex(0.0, limit), clear=0.8, height=height)
    return None


def _sections(canvas: Canvas, scene: CamScene, field: Field, boxes: Sequence[Box]) -> None:
    """Draw the section lines with their numbers, broken where a text stands, and mark the curve on them."""
    solved, height = scene.solved, scene.style.text
    values = theta(solved, solved.angles)
    lines = [field.at(phi, 0.0).real for phi in solved.angles.tolist()]
    canvas.add(*numbers(lines, field.at(0.0, field.y.low).imag - 2.3 - height, height))
    for i, (phi, value) in enumerate(zip(solved.angles.tolist(), values.tolist(), strict=True)):
        foot = field.at(phi, field.y.low) - 1.5j
        for a, b in beside(field.at(phi, field.y.high), foot, boxes):
            canvas.add(Line(a, b, Pen.THIN, role="section", name=str(i)))
        canvas.add(scene.node(field.at(phi, value), str(i)))


FIGURE = Figure("pressure", pressure_view, ("reduction",), stages("axes", "curve", "limits"), "cam.pressure")
