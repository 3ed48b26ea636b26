"""What the plans of both cams share: positions numbered against the sense of the cam, phases, shaft, sense, axes."""

from __future__ import annotations

import cmath
import math

from ...plans.cams.motion import TURN, Motion
from ..shapes import Head, Line, Pen, Text
from ..symbols import angle_dimension, turning_arrow
from ..text import lay_out
from ..view import Canvas
from .hardware import SHAFT, shaft
from .scene import CamScene

PAST = 5.0  # mm of the axes of a cam beyond its circles
SMALL = math.radians(1e-6)


def ratio(scene: CamScene) -> str:
    """Return the scale of a profile as drawings have it: M 1:1, M 2:1, M 1:2."""
    size = 1e-3 / scene.mu_l
    words = scene.words
    text = f"{words.short(round(size, 6))}:1" if size >= 1.0 else f"1:{words.short(round(1.0 / size, 6))}"
    return words["said.cam_drawn"].format(ratio=text)


def heading(scene: CamScene, key: str, plan: str) -> tuple[str, str]:
    """Return the heading of the plan of a cam: its name, its scale."""
    return scene.words[key], f"{ratio(scene)};  {scene.factor(scene.scale(plan))}"


def unit_at(phi: float, sense: int) -> complex:
    """Return the direction of the follower's axis in the position phi, on the cam that stands still."""
    return cmath.rect(1.0, math.pi / 2 - sense * phi)


def on_circle(e: float, radius: float, up: complex, sense: int) -> complex:
    """Return where the follower's line along `up`, at the offset e, meets a circle about the cam's centre."""
    return up * complex(math.sqrt(max(radius * radius - e * e, 0.0)), -e)


def numbers(canvas: Canvas, scene: CamScene, e: float, radius: float) -> None:
    """Write the number of each position on its line, at `radius`; that of position 0 beside the rod."""
    height, solved = scene.style.text, scene.solved
    for i, phi in enumerate(solved.angles.tolist()):
        up = unit_at(phi, solved.cam.sense)
        at = on_circle(e, radius, up, solved.cam.sense)
        if i == 0:  # beyond the cam's axis from there
            at = complex(-math.copysign(scene.style.label, e), at.imag)
        canvas.add(Text(at - 0.5j * height, str(i), height, "middle", role="position", name=str(i)))


def phases(canvas: Canvas, scene: CamScene, e: float, radius: float) -> None:
    """Dimension the phases in degrees, on an arc outside of all positions."""
    motion, sense, words = scene.solved.motion, scene.solved.cam.sense, scene.words
    first = cmath.phase(on_circle(e, radius, 1j, sense))
    for phase in motion.phases:
        if phase.length < SMALL:
            continue
        start, sweep = first - sense * phase.start, -sense * phase.length
        name = f"phi_{phase.name}"
        canvas.add(angle_dimension(0j, radius, start, sweep, name, scene.style))
        for angle in (start, start + sweep):
            canvas.add(
                Line(cmath.rect(radius - 3.0, angle), cmath.rect(radius + 2.0, angle), Pen.THIN, role="extension")
            )
        text = f"{words.symbol(name)} = {scene.degrees(phase.length)}"
        canvas.add(_along(text, radius, start + sweep / 2, abs(sweep), scene.style.text))


def _along(text: str, radius: float, angle: float, sweep: float, height: float) -> Text:
    """Return a text outside of an arc about the cam's centre, along it; where the arc is short, clear of its ends."""
    away = 0.5 * height if radius * sweep > 1.3 * lay_out(text, height).width else 1.4 * height
    out = cmath.rect(1.0, angle)
    below = out.imag < -1e-9
    turn = cmath.phase(out * (1j if below else -1j))
    return Text(out * (radius + away + (height if below else 0.0)), text, height, "middle", turn)


def centre(canvas: Canvas, scene: CamScene, reach: float, top: float) -> None:
    """Draw the cam's shaft, its axes, and the arrow of omega."""
    style, sense = scene.style, scene.solved.cam.sense
    for a, b in ((complex(-reach - PAST, 0.0), complex(reach + PAST, 0.0)), (complex(0.0, -reach - PAST), 1j * top)):
        canvas.add(Line(a, b, Pen.AXIS, role="axis"))
    canvas.add(shaft(0j, style))
    middle = dwelling(scene.solved.motion, sense)
    arrow, radius = middle - 0.65 * sense, 1.9 * SHAFT * style.label
    canvas.add(turning_arrow(0j, radius, arrow, 0.9, float(sense), "omega"))
    places = ("O", 1.5 * SHAFT, middle + 0.75 * sense), (scene.words.symbol("omega"), 1.9 * SHAFT + 0.9, arrow)
    for text, far, angle in places:
        at = cmath.rect(far * style.label, angle) - 0.5j * style.label
        canvas.add(Text(at, text, style.label, "middle"))


def radius_at(
    canvas: Canvas, scene: CamScene, name: str, value: float, angle: float, free: tuple[float, float]
) -> None:
    """Dimension the radius of a circle about the cam's centre along a ray.

    The text runs along the ray: between the shaft and the first of the radii `free`, or else beyond the second.
    """
    height, size = scene.style.text, value / scene.mu_l
    ray, text = cmath.rect(1.0, angle), f"{scene.words.symbol(name)} = {scene.length(value)}"
    wide, low = lay_out(text, height).width, SHAFT * scene.style.label + 1.0
    inside = wide < min(free[0], size - scene.style.arrow) - low
    tip = size if inside else free[1] + wide + 3.0
    middle = 0.5 * (low + min(free[0], size - scene.style.arrow)) if inside else free[1] + 0.5 * wide + 1.5
    canvas.add(Line(0j, ray * tip, Pen.THIN, role="radius", name=name), Head(ray * size, ray))
    turn = 1.0 if ray.real > -1e-9 else -1.0
    at = ray * complex(middle, turn)
    canvas.add(Text(at, text, height, "middle", cmath.phase(ray * turn), role="label", name=name))


def dwelling(motion: Motion, sense: int) -> float:
    """Return the direction in the middle of the lower dwell, or of the rise where there is none."""
    low, high = (motion.lower.start, TURN) if motion.lower.length > SMALL else (0.0, motion.rise.end)
    return cmath.phase(unit_at(0.5 * (low + high), sense))
