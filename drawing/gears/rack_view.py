"""The pinion with the rack that cuts it: pitch line and middle line with the shift, line of action, undercutting."""

from __future__ import annotations

import cmath
import math
from dataclasses import replace

import numpy as np

from ...plans.gears.profile import Tooth
from ..dimensions import linear
from ..page import extent
from ..shapes import Arc, Circle, Group, Head, Line, Pen, Polyline
from ..symbols import angle_dimension, right_angle
from ..view import Canvas, View
from .circles import PENS
from .scene import GearScene

PAST = 6.0  # mm of a line beyond what it goes to
CORNER = 12  # points of a corner of the rack
NEIGHBOURS = (-1, 0, 1)  # teeth of the rack, in pitches from the one in the middle
SPACES = 1.2  # pitches of the wheel to both sides
TURN = cmath.rect(1.0, 0.5 * math.pi)  # from the real axis to the direction from the centre to the pole


def rack_view(overall: GearScene) -> View:
    """Draw the pinion, a space of it in the middle of a tooth of the rack."""
    scene = replace(overall, mu_l=overall.near)
    canvas, tooth = Canvas(scene.style), overall.meshing.teeth[0]
    _wheel(canvas, scene, tooth)
    line = Polyline(tuple(rack(scene, tooth)), Pen.MAIN, role="profile", name="rack")
    canvas.add(Group((line,), "rack", "rack"))
    x0, _, x1, _ = extent((line,))
    _lines(canvas, scene, x0 - PAST, x1 + PAST)
    _line_of_action(canvas, scene, tooth)
    _corner(canvas, scene, tooth)
    heading = scene.words["heading.gear_rack"], scene.factor(scene.mu_l)
    return canvas.finish("rack", heading, tuple(scene.words["said.gear_rack"].split("|")))


def rack(scene: GearScene, tooth: Tooth) -> list[complex]:
    """Return the outline of the rack, mm from the pole: flanks from its spaces to the round corners of its tips."""
    m, k, alpha = scene.size("m"), 1.0 / scene.mu_l, tooth.alpha
    depth = (scene.size("h_a") + scene.size("c")) * m
    middle = scene.size("x_1") * m
    turns = np.linspace(alpha, 0.5 * math.pi, CORNER)
    corner = complex(tooth.e_f, middle - depth + tooth.rho_f) + tooth.rho_f * (np.cos(turns) - 1j * np.sin(turns))
    top = complex(0.25 * math.pi * m + depth * math.tan(alpha), middle + depth)
    half = np.concatenate(([top], corner))  # to the right of the centre line, from the root to the tip
    one = np.concatenate((-half.conj(), half[::-1]))
    return [point * k for n in NEIGHBOURS for point in (one + math.pi * m * n).tolist()]


def _wheel(canvas: Canvas, scene: GearScene, tooth: Tooth) -> None:
    """Draw two teeth beside the space, the reference and the base circle."""
    k, pitch = 1.0 / scene.mu_l, 2.0 * math.pi / tooth.z
    centre = complex(0.0, -tooth.r * k)
    points = centre + tooth.teeth(2) * TURN * cmath.rect(k, -0.5 * pitch)
    line = Polyline(tuple(points.tolist()), Pen.MAIN, role="profile", name="pinion")
    canvas.add(Group((line,), "wheel", "1"))
    half = min(SPACES * pitch, 0.9 * math.pi)
    for name, radius in (("", tooth.r), ("b", tooth.r_b)):
        arc = Arc(centre, radius * k, 0.5 * math.pi - half, 2.0 * half, PENS[name])
        canvas.add(Group((arc,), "circle", f"d_{name}1"))
        end = centre + radius * k * cmath.rect(1.0, 0.5 * math.pi - half)
        canvas.label(scene.words.symbol(f"d_{name}1"), end, prefer=1 + 0j, clear=1.0, height=scene.style.text)


def _lines(canvas: Canvas, scene: GearScene, left: float, right: float) -> None:
    """Draw the pitch line of the rack, which rolls on the reference circle, its middle line, and the shift."""
    shift = scene.size("x_1") * scene.size("m") / scene.mu_l
    for name, y, pen in (("pitch", 0.0, Pen.THIN), ("middle", shift, Pen.AXIS)):
        canvas.add(Line(complex(left, y), complex(right, y), pen, role="rack-line", name=name))
    words = scene.words
    if abs(shift) > 0.01:
        text = f"{words.symbol('x_1')}{words.symbol('m')} = {scene.length(shift * scene.mu_l)}"
        linear(canvas, (complex(right, 0.0), complex(right, shift)), 0j, "", "x_1")
        canvas.label(text, complex(right, 0.5 * shift), prefer=1 + 0j, clear=1.0, height=scene.style.text)


def _corner(canvas: Canvas, scene: GearScene, tooth: Tooth) -> None:
    """Give the radius of the rack's corner at its last tooth on the left."""
    k, m = 1.0 / scene.mu_l, scene.size("m")
    depth = (scene.size("h_a") + scene.size("c") - scene.size("x_1")) * m
    centre = complex(-math.pi * m - tooth.e_f, tooth.rho_f - depth) * k
    out = cmath.rect(1.0, 1.25 * math.pi)
    at = centre + tooth.rho_f * k * out
    canvas.add(Line(centre, at, Pen.THIN, role="radius", name="rho_f"), Head(at, out))
    canvas.label(scene.stated("rho_f"), at, prefer=out, clear=1.0, height=scene.style.text)


def _line_of_action(canvas: Canvas, scene: GearScene, tooth: Tooth) -> None:
    """Draw the line of action of cutting, where it touches the base circle, and where the rack's edge ends on it."""
    k, alpha, style = 1.0 / scene.mu_l, tooth.alpha, scene.style
    down = cmath.rect(1.0, -alpha)
    touch = down * (tooth.r * math.sin(alpha) * k)
    depth = (scene.size("h_l") - scene.size("h_a") - scene.size("x_1")) * scene.size("m") * k
    edge = down * (depth / math.sin(alpha))
    far = max(touch, edge, key=abs)
    reach = PAST / abs(far)
    canvas.add(Line(-far, far * (1.0 + reach), Pen.THIN, role="line-of-action", name="PN"))
    centre = complex(0.0, -tooth.r * k)
    inward = (centre - touch) / abs(centre - touch)
    canvas.add(Line(touch, touch + 3.0 * style.label * inward, Pen.THIN, role="radius", name="N"))
    canvas.add(right_angle(touch, inward, -down, 0.6 * style.label))
    places = (("N", touch, inward), ("B", edge, down), ("P", 0j, -1 + 1j))
    for name, at, prefer in places:
        canvas.add(Group((Circle(at, style.node, Pen.THIN, fill="white"),), "point", name))
        canvas.label(name, at, prefer=prefer, clear=style.node + 0.6)
    radius = 0.8 * abs(far)
    canvas.add(angle_dimension(0j, radius, math.pi, -alpha, "alpha", style))
    place = radius * cmath.rect(1.0, math.pi - 0.5 * alpha)
    canvas.label(scene.angle("alpha"), place, prefer=-1 + 0j, clear=1.0, height=style.text)
