"""The pressure angle over the turn of the cam, between its limits."""

from __future__ import annotations

import math

import numpy as np

from ...plans.cams.motion import FALL, RISE
from ...plans.cams.pressure import SIDES, pressure_angle
from ...scales.scale import Scale, steps
from ..diagram import Axis, Field, axes, divisions
from ..shapes import Circle, Group, Line, Pen, Polyline, Text
from ..view import Canvas, View
from .scene import CamScene, pieces

DEGREE = math.radians(1.0)
WIDE = {5.0: 160.0, 3.5: 120.0}  # mm of the axis of angles beyond which it is half as long as on the diagrams
TALL = {5.0: 60.0, 3.5: 45.0}  # mm of the axis of pressure angles, by the height of letters


def pressure_view(scene: CamScene) -> View:
    """Draw theta over phi with the limits dashed over their phases."""
    solved, words = scene.solved, scene.words
    roller = solved.roller
    assert roller is not None
    canvas, sense = Canvas(scene.style), solved.cam.sense
    curves = []
    for phase in solved.motion.phases[:3]:
        for phi, s, ds, _ in pieces(solved, phase):
            theta = np.arctan2(sense * ds - roller.sizes.e, roller.sizes.s_0 + s)
            curves.append(list(zip(phi.tolist(), theta.tolist(), strict=True)))
    gammas = {RISE: roller.limits.gamma_rise, FALL: roller.limits.gamma_fall}
    limits = [
        (phase, way * sense * (0.5 * math.pi - gamma))
        for phase, gamma in gammas.items()
        for way in SIDES[phase][: 1 + roller.limits.two_sided]
    ]
    every = [y for points in curves for _, y in points] + [limit for _, limit in limits] + [0.0]
    field = _field(scene, min(every), max(every))
    axes(canvas, field, lettered=False)
    canvas.add(Group(tuple(Polyline(tuple(field.at(*p) for p in points)) for points in curves), "curve", "theta"))
    for name, limit in limits:
        phase = solved.motion.rise if name == RISE else solved.motion.fall
        ends = field.at(phase.start, limit), field.at(phase.end, limit)
        canvas.add(Group((Line(*ends, Pen.DASHED),), "limit", f"{name}{'' if limit > 0 else '-'}"))
        text = f"[{words.symbol('theta')}] = {scene.degrees(abs(limit))}"
        canvas.label(text, ends, prefer=complex(0.0, limit), clear=0.8, height=scene.style.text)
    _sections(canvas, scene, field)
    per_mm = f"{words.symbol('mu_theta')} = {scene.degrees(field.y.scale.mu)}/{words.unit('mm')}"
    heading = words["heading.cam_pressure"], f"{per_mm};  {scene.factor(field.x.scale)}"
    return canvas.finish("pressure", heading)


def _field(scene: CamScene, low: float, high: float) -> Field:
    words = scene.words
    tall = TALL[scene.style.label]
    mu = steps((high - low) / DEGREE / tall)[0] * DEGREE
    last = float(scene.solved.angles[-1])
    half = last > WIDE[scene.style.label] * scene.across.mu
    scale = Scale("mu_phi", scene.across.mu * (2.0 if half else 1.0), "rad")
    across = Axis(words.symbol("phi"), scale, 0.0, last, {})
    marks = {x * DEGREE: f"{words.short(x)}°" for x in divisions(high / DEGREE, low / DEGREE, mu / DEGREE, 9.0)}
    return Field(0j, across, Axis(words.symbol("theta"), Scale("mu_theta", mu, "rad"), low, high, marks))


def _sections(canvas: Canvas, scene: CamScene, field: Field) -> None:
    """Draw the section lines with their numbers, and mark the curve on them."""
    solved, height = scene.solved, scene.style.text
    assert solved.roller is not None
    theta = pressure_angle(solved.motion, solved.roller.sizes, solved.angles, solved.cam.sense)
    for i, (phi, value) in enumerate(zip(solved.angles.tolist(), theta.tolist(), strict=True)):
        foot = field.at(phi, field.y.low) - 1.5j
        canvas.add(Line(field.at(phi, field.y.high), foot, Pen.THIN, role="section", name=str(i)))
        canvas.add(Text(foot - 1j * (0.8 + height), str(i), height, "middle"))
        canvas.add(Group((Circle(field.at(phi, value), scene.style.node, Pen.THIN, fill="white"),), "node", str(i)))
