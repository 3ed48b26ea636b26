"""The pinion with the rack that cuts it: pitch line and middle line with the shift, line of action, undercutting."""

from __future__ import annotations

from dataclasses import replace

from ...plans.gears.course import Rack
from ..dimensions import angle, linear
from ..page import extent
from ..shapes import Arc, Group, Head, Line, Pen, Polyline
from ..symbols import HALF_TURN, right_angle, unit
from ..view import Canvas, View
from .circles import PENS, WIDEST
from .scene import GearScene

PAST = 6.0  # mm of a line beyond what it goes to
SPACES = 1.2  # pitches of the wheel to both sides
OUT = unit(-1.0 - 1.0j)  # in which the radius of a corner of the rack is drawn


def rack_view(overall: GearScene) -> View:
    """Draw the pinion, a space of it in the middle of a tooth of the rack."""
    scene = replace(overall, mu_l=overall.near)
    canvas, rack = Canvas(scene.style), Rack(scene.solved, 1.0 / scene.mu_l)
    _wheel(canvas, scene, rack)
    line = Polyline(tuple(rack.outline()), Pen.MAIN, role="profile", name="rack")
    canvas.add(Group((line,), "rack", "rack"))
    x0, _, x1, _ = extent((line,))
    _lines(canvas, scene, rack, x0 - PAST, x1 + PAST)
    _line_of_action(canvas, scene, rack)
    _corner(canvas, scene, rack)
    heading = scene.words["heading.gear_rack"], scene.factor(scene.mu_l)
    return canvas.finish("rack", heading, tuple(scene.words["said.gear_rack"].split("|")))


def _wheel(canvas: Canvas, scene: GearScene, rack: Rack) -> None:
    """Draw two teeth beside the space, the reference and the base circle."""
    line = Polyline(rack.teeth(), Pen.MAIN, role="profile", name="pinion")
    canvas.add(Group((line,), "wheel", "1"))
    half = min(SPACES * rack.pitch, WIDEST)
    for name in ("", "b"):
        arc = Arc(rack.centre, rack.radius(name), 0.5 * HALF_TURN - half, 2.0 * half, PENS[name])
        canvas.add(Group((arc,), "circle", f"d_{name}1"))
        symbol = scene.words.symbol(f"d_{name}1")
        canvas.label(symbol, rack.on(name, -half), prefer=1 + 0j, clear=1.0, height=scene.style.text)


def _lines(canvas: Canvas, scene: GearScene, rack: Rack, left: float, right: float) -> None:
    """Draw the pitch line of the rack, which rolls on the reference circle, its middle line, and the shift."""
    words, shift = scene.words, rack.shift
    for name, y, pen in (("pitch", 0.0, Pen.THIN), ("middle", shift, Pen.AXIS)):
        canvas.add(Line(complex(left, y), complex(right, y), pen, role="rack-line", name=name))
    if abs(shift) > 0.01:
        text = f"{words.symbol('x_1')}{words.symbol('m')} = {scene.length(shift * scene.mu_l)}"
        linear(canvas, (complex(right, 0.0), complex(right, shift)), 0j, "", "x_1")
        canvas.label(text, complex(right, 0.5 * shift), prefer=1 + 0j, clear=1.0, height=scene.style.text)


def _corner(canvas: Canvas, scene: GearScene, rack: Rack) -> None:
    """Give the radius of the rack's corner at its last tooth on the left."""
    at = rack.corner + scene.paper("rho_f") * OUT
    canvas.add(Line(rack.corner, at, Pen.THIN, role="radius", name="rho_f"), Head(at, OUT))
    canvas.label(scene.stated("rho_f"), at, prefer=OUT, clear=1.0, height=scene.style.text)


def _line_of_action(canvas: Canvas, scene: GearScene, rack: Rack) -> None:
    """Draw the line of action of cutting, where it touches the base circle, and where the rack's edge ends on it."""
    style, touch = scene.style, rack.touch
    far = max(touch, rack.edge, key=abs)
    canvas.add(Line(-far, far + PAST * unit(far), Pen.THIN, role="line-of-action", name="PN"))
    inward = unit(rack.centre - touch)
    canvas.add(Line(touch, touch + 3.0 * style.label * inward, Pen.THIN, role="radius", name="N"))
    canvas.add(right_angle(touch, inward, -rack.down, 0.6 * style.label))
    places = (("N", touch, inward), ("B", rack.edge, rack.down), ("P", 0j, -1 + 1j))
    for name, at, prefer in places:
        canvas.add(scene.node(at, name, "point"))
        canvas.label(name, at, prefer=prefer, clear=style.node + 0.6)
    rays = -1.0 + 0j, -rack.down
    angle(canvas, 0j, rays, 0.8 * abs(far), "alpha", scene.angle("alpha"), prefer=-1 + 0j)
