"""What the plans of both cams share: positions numbered against the sense of the cam, phases, shaft, sense, axes."""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence

import numpy as np

from ...plans.cams.envelopes import Undercut
from ...plans.cams.motion import LOWER, Motion
from ..printed import decimals_for
from ..shapes import Circle, Group, Head, Line, Pen, Text
from ..symbols import angle_dimension, turning_arrow
from ..text import lay_out
from ..view import Canvas
from .hardware import shaft, shaft_radius
from .scene import CamScene

PAST = 5.0  # mm of the axes of a cam beyond its circles
Free = tuple[float, float, float]  # radii, mm: text stands between the first two, or beyond the third
SHARES = (0.5, 0.7, 0.3, 0.8, 0.2)  # of the arc of a phase at which its text may stand
LOST = 3  # significant digits of a travel that is lost
SIDEWAYS = 0.3  # sine of the angle below the horizontal from which on the support is there
BESIDE = 0.15  # rad between the middle of the lower dwell and the letter of the centre
RADIUS, ARROW = 0.35, 1.2  # rad from that middle towards the rod to the radius dimensioned, and to the arrow of omega
SMALLEST = 7.0  # least radius of a cam, in heights of letters, that has room for letters inside


def heading(scene: CamScene, key: str, plan: str) -> tuple[str, str]:
    """Return the heading of the plan of a cam: its name, its scale."""
    return scene.words[key], f"{scene.words.drawn_at(scene.mu_l)};  {scene.factor(scene.scale(plan))}"


def unit_at(phi: float, sense: int) -> complex:
    """Return the direction of the follower's axis in the position phi, on the cam that stands still."""
    return cmath.rect(1.0, math.pi / 2 - sense * phi)


def on_circle(e: float, radius: float, up: complex) -> complex:
    """Return where the follower's line along `up`, at the offset e, meets a circle about the cam's centre."""
    return up * complex(math.sqrt(max(radius * radius - e * e, 0.0)), -e)


def numbers(canvas: Canvas, scene: CamScene, e: float, radius: float) -> None:
    """Write the number of each position on its line, at `radius`; that of position 0 beside the rod."""
    height, solved = scene.style.text, scene.solved
    written: list[complex] = []
    for i, phi in enumerate(solved.angles.tolist()):
        up = unit_at(phi, solved.cam.sense)
        at = on_circle(e, radius, up)
        if i == 0:  # beyond the cam's axis from there
            at = complex(-math.copysign(scene.style.label, e), at.imag)
        needed = lay_out(str(i), height).width + 0.3 * height
        on_rod = i > 0 and at.imag > 0.0 and abs(at.real - e) < scene.style.label
        if not on_rod and all(
            abs(at - other) > needed for other in written
        ):  # where there are many, some have no number
            canvas.add(Text(at - 0.5j * height, str(i), height, "middle", role="position", name=str(i)))
            written.append(at)


def phases(canvas: Canvas, scene: CamScene, e: float, radius: float, past: complex = 0j) -> None:
    """Dimension the phases in degrees, on an arc outside of all positions; no text stands at the line to `past`."""
    motion, sense, words = scene.solved.motion, scene.solved.cam.sense, scene.words
    first = cmath.phase(on_circle(e, radius, 1j))
    for phase in motion.phases:
        if not phase.lasts:
            continue
        start, sweep = first - sense * phase.start, -sense * phase.length
        name = f"phi_{phase.name}"
        canvas.add(angle_dimension(0j, radius, start, sweep, name, scene.style))
        for angle in (start, start + sweep):
            canvas.add(
                Line(cmath.rect(radius - 1.5, angle), cmath.rect(radius + 2.0, angle), Pen.THIN, role="extension")
            )
        text = f"{words.symbol(name)} = {scene.degrees(phase.length)}"
        shares = SHARES[2:] if phase.name == LOWER else SHARES  # beside the radius dimensioned
        half = 0.6 * lay_out(text, scene.style.text).width / radius
        middles = [start + sweep * share for share in shares]
        clear = (a for a in middles if not past or abs(cmath.phase(past * cmath.rect(1.0, -a))) > half)
        canvas.add(_along(text, radius, next(clear, middles[0]), abs(sweep), scene.style.text))


def _along(text: str, radius: float, angle: float, sweep: float, height: float) -> Text:
    """Return a text outside of an arc about the cam's centre, along it; where the arc is short, clear of its ends."""
    away = 0.5 * height if radius * sweep > 1.3 * lay_out(text, height).width else 1.4 * height
    out = cmath.rect(1.0, angle)
    below = out.imag < -1e-9
    turn = cmath.phase(out * (1j if below else -1j))
    return Text(out * (radius + away + (height if below else 0.0)), text, height, "middle", turn)


def centre(canvas: Canvas, scene: CamScene, reach: float, top: float, turned: float = 0.0, offset: float = 0.0) -> None:
    """Draw the cam's shaft, its axes, and the arrow of omega.

    `turned` is the angle from the upright to the roller's centre in its lowest position, `offset` the radius of the
    circle that the follower's line touches, mm.
    """
    style, sense = scene.style, scene.solved.cam.sense
    for a, b in ((complex(-reach - PAST, 0.0), complex(reach + PAST, 0.0)), (complex(0.0, -reach - PAST), 1j * top)):
        canvas.add(Line(a, b, Pen.AXIS, role="axis"))
    r = shaft_radius(reach, style, offset)
    canvas.add(shaft(0j, r, style))
    middle = dwelling(scene.solved.motion, sense) + turned
    arrow, radius = middle - ARROW * sense, max(1.9 * r, offset + 0.6 * style.label)
    if math.sin(arrow) < -SIDEWAYS:  # the support is there
        arrow = -arrow
    canvas.add(turning_arrow(0j, radius, arrow, 0.9, float(sense), "omega"))
    canvas.label(scene.words.symbol("omega"), cmath.rect(radius, arrow), prefer=cmath.rect(1.0, arrow), clear=0.8)


def letter_centre(canvas: Canvas, scene: CamScene, reach: float, turned: float = 0.0, offset: float = 0.0) -> None:
    """Write the letter of the cam's centre, when all else is drawn: near the shaft, clear of all lines if it can be."""
    style, sense = scene.style, scene.solved.cam.sense
    size, middle = max(shaft_radius(reach, style, offset), offset), dwelling(scene.solved.motion, sense) + turned
    turns = sorted(np.arange(-1.2, 1.21, 0.1), key=lambda turn: abs(turn - BESIDE))
    far = (size + style.label * part for part in (0.8, 0.95, 1.1, 1.3, 1.6, 2.0))
    places = [cmath.rect(away, middle + turn * sense) for away in far for turn in turns]
    if not canvas.write("O", places, style.label):
        side = cmath.rect(1.0, middle + BESIDE * sense)
        canvas.label("O", size * side, prefer=side, clear=0.8, priority=1)


def circle(radius: float, name: str) -> Group:
    """Return a thin circle about the cam's centre."""
    return Group((Circle(0j, radius, Pen.THIN),), "circle", name)


def radius_at(canvas: Canvas, scene: CamScene, name: str, value: float, angle: float, free: Free) -> str:
    """Dimension the radius of a circle about the cam's centre along a ray.

    The text runs along the ray: between the first two of the radii `free`, beyond the shaft, if need be without its
    number, or else beyond the third; that of a cam without room for letters stands where it finds a place.

    Returns
    -------
    str
        The number, if it has no place in the figure.
    """
    style, size = scene.style, value / scene.mu_l
    ray, whole = cmath.rect(1.0, angle), f"{scene.words.symbol(name)} = {scene.length(value)}"
    low, high = max(shaft_radius(size, style), free[0]) + 1.0, min(free[1], size - style.arrow)
    text = whole if lay_out(whole, style.text).width < high - low else scene.words.symbol(name)
    left = "" if text == whole else whole
    wide = lay_out(text, style.text).width
    inside, small = wide < high - low, size < SMALLEST * style.label
    tip = size if inside or small else free[2] + wide + 1.5
    line = Line(0j, ray * tip, Pen.THIN, role="radius", name=name)
    canvas.add(Group((line, Head(ray * size, ray)), "dimension", name))
    if small:
        canvas.label(text, (0.5 * ray * size, ray * size), prefer=ray, clear=0.8, height=style.text)
        return left
    middle = 0.5 * (low + high) if inside else free[2] + 0.5 * wide + 1.5
    turn = 1.0 if ray.real > -1e-9 else -1.0
    at = ray * complex(middle, turn)
    canvas.add(Text(at, text, style.text, "middle", cmath.phase(ray * turn), role="label", name=name))
    return left


def quiet(motion: Motion, sense: int) -> float:
    """Return the direction along which a radius is dimensioned: in the lower dwell, beside the letter of the centre."""
    return dwelling(motion, sense) - RADIUS * sense


def dwelling(motion: Motion, sense: int) -> float:
    """Return the direction in the middle of the longer dwell, or of the rise where there is none."""
    longer = motion.lower if rests(motion) or not motion.upper.lasts else motion.upper
    low, high = (longer.start, longer.end) if longer.lasts else (0.0, motion.rise.end)
    return cmath.phase(unit_at(0.5 * (low + high), sense))


def rests(motion: Motion) -> bool:
    """Whether the lower dwell is the longer one: then there is room beside the follower in its lowest position."""
    return motion.lower.lasts and motion.lower.length >= motion.upper.length


def corners(canvas: Canvas, scene: CamScene, cuts: Sequence[Undercut]) -> None:
    """Mark the corners of an undercut profile."""
    for k, cut in enumerate(cuts):
        corner, radius = cut.corner * (1.0 / scene.mu_l), 2.5 * scene.style.node
        canvas.add(Group((Circle(corner, radius, Pen.THIN),), "corner", str(k + 1)))
        canvas.label(_corner(cuts, k), corner, prefer=-corner, clear=radius + 0.5, height=scene.style.text)


def undercut_notes(scene: CamScene, cuts: Sequence[Undercut], rocks: bool = False) -> tuple[str, ...]:
    """Say where a profile does not give the motion; the travels of a rocker that `rocks` are angles."""
    words, found = scene.words, []
    for k, cut in enumerate(cuts):
        lost = math.degrees(cut.lost) if rocks else cut.lost * 1e3
        unit = "°" if rocks else f" {words.unit('mm')}"
        text = f"{words.number(lost, decimals_for(lost, LOST))}{unit}"
        ends = {"start": scene.degrees(cut.start), "end": scene.degrees(cut.end)}
        warning, where = words["said.cam_undercut"].format(**ends, lost=text, corner=_corner(cuts, k)).split("|")
        found += [warning, where] if not k else [where]
    return tuple(found)


def _corner(cuts: Sequence[Undercut], k: int) -> str:
    return "Q" if len(cuts) == 1 else f"Q_{{{k + 1}}}"
