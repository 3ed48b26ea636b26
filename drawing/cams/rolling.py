"""What the plans of all cams with a roller show: both curves, the sharpest place, corners, one position's normal."""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from dataclasses import dataclass

from ...plans.cams.profile import RollerProfile
from ..shapes import Circle, Group, Head, Line, Pen, Polyline, Text
from ..style import Style
from ..symbols import angle_dimension
from ..text import box
from ..view import Canvas
from .inversion import corners, rests, unit_at
from .pressing import theta
from .scene import CamScene

REACH, BEYOND = 6.5, 4.0  # heights of letters from the roller's centre to the arc of theta; mm of the normal beyond it
SAME, IN_DWELL = 1e-9, 0.25  # part of a radius; of the lower dwell, at which the radius of its arc is shown
PARTS = (
    1.0,
    0.9,
    1.1,
    0.8,
    1.2,
    0.7,
    1.3,
    0.6,
    1.4,
    0.5,
    1.5,
)  # of the radius of an arc that may be taken instead of it
SHARES = (0.5, 0.4, 0.6, 0.3, 0.7)  # of an arc at which its letter may stand
ASIDE = 0.5  # rad between a position and the radius dimensioned in it
FLAT = 1e-6  # rad, of an angle that is not shown


@dataclass(frozen=True, slots=True)
class Contact:
    """One position: the roller's centre, where it touches, the instant centre of cam and follower, mm.

    `up` is the unit direction in which the roller rises.
    """

    line: int
    at: complex
    touch: complex
    pole: complex
    up: complex


def curves(canvas: Canvas, scene: CamScene, profile: RollerProfile) -> None:
    """Draw the pitch curve dash-dot and the practical profile in main lines; mark corners of the profile."""
    mu = scene.mu_l
    pitch = profile.pitch(scene.solved.motion.samples()[:-1]) * (1.0 / mu)
    outline = profile.outline() * (1.0 / mu)
    for points, pen, name, part in ((pitch, Pen.AXIS, "pitch", "pitch"), (outline, Pen.MAIN, "practical", "profile")):
        canvas.part(part)
        canvas.add(Group((Polyline(tuple(points.tolist()), pen, closed=True),), "curve", name))
    corners(canvas, scene, profile.undercuts)


def sharpest(canvas: Canvas, scene: CamScene, profile: RollerProfile) -> None:
    """Mark the place of the least radius of curvature of the pitch curve, and the radius."""
    mu, found = scene.mu_l, profile.sharpest
    if not 0.0 < found.value < math.inf:
        return
    phi, lower = found.phi, scene.solved.motion.lower
    if lower.lasts and abs(found.value * float(profile.curvature(lower.end, -1)) - 1.0) < SAME:
        phi = lower.start + IN_DWELL * lower.length  # an arc is as sharp everywhere
    kappa = [float(profile.curvature(phi, side)) for side in (1, -1)]
    side = 1 if kappa[0] >= kappa[1] else -1
    place, normal = complex(profile.pitch(phi, side)) * (1.0 / mu), complex(profile.normal(phi, side))
    core = place - normal * (found.value / mu)
    canvas.add(Group((Line(core, place, Pen.THIN), Head(place, normal)), "dimension", "rho_min"))
    size = 0.8 * scene.style.arrow / 2
    cross = (Line(core - size * d, core + size * d, Pen.THIN) for d in (1 + 0j, 1j))
    canvas.add(Group(tuple(cross), "point", "curvature"))
    canvas.add(Group((Circle(place, scene.style.node, Pen.MAIN, fill="black"),), "sharpest", "rho_min"))
    anchor = core if phi == found.phi else (core, place)  # about the cam's centre stands enough
    canvas.label(scene.words.symbol("rho_min"), anchor, prefer=-normal, clear=0.8, height=scene.style.text)


def past_normal(contact: Contact, style: Style) -> complex:
    """Return the outer end of the normal that is drawn."""
    out = (contact.at - contact.touch) / abs(contact.at - contact.touch)
    return contact.at + out * (REACH * style.label + BEYOND)


def normal(canvas: Canvas, scene: CamScene, contact: Contact) -> None:
    """Draw the normal of one position with the point of contact, the pressure and the transmission angle."""
    words, style, i = scene.words, scene.style, contact.line
    at, up = contact.at, contact.up
    out = (at - contact.touch) / abs(at - contact.touch)
    reach = REACH * style.label
    canvas.part("normal")
    canvas.add(Line(contact.pole, past_normal(contact, style), Pen.THIN, role="normal", name=str(i)))
    canvas.add(Line(at - 1j * up * reach, at + 1j * up * reach, Pen.THIN, role="transverse", name=str(i)))
    canvas.add(Line(0j, contact.pole, Pen.THIN, role="transverse", name=f"P{i}"))
    for mark, place, part in (("K", contact.touch, "profile"), ("P", contact.pole, "normal")):
        canvas.part(part)
        canvas.add(Group((Circle(place, style.node, Pen.MAIN, fill="white"),), "point", f"{mark}{i}"))
        canvas.label(f"{mark}_{{{i}}}", place, prefer=place * 1j, clear=0.8, height=style.text)
    across = up * -1j if cmath.phase(up / out) > 0.0 else up * 1j
    for name, a, b, far in (("theta", out, up, reach), ("gamma", out, across, 0.5 * reach)):
        if abs(cmath.phase(b / a)) > FLAT:
            _angle(canvas, f"{words.symbol(name)}_{{{i}}}", f"{name}_{i}", at, (a, b), far)


def _angle(canvas: Canvas, letter: str, name: str, at: complex, rays: tuple[complex, complex], far: float) -> None:
    """Dimension the angle between two rays near a radius at which its letter is clear of all lines."""
    style, height = canvas.style, canvas.style.text
    start, sweep = cmath.phase(rays[0]), cmath.phase(rays[1] / rays[0])
    free = [far * part for part in PARTS if _free(canvas, [at + ray * (far * part) for ray in rays])]
    for radius in free:
        beside = (radius + away * height for away in (1.0, -1.0, 1.2, -1.3))
        places = [at + cmath.rect(away, start + share * sweep) for away in beside for share in SHARES]
        canvas.add(angle_dimension(at, radius, start, sweep, name, style))
        if canvas.write(letter, places, height):
            return
        canvas.shapes.pop()
    far = next(iter(free), far)
    middle = at + cmath.rect(far, start + 0.5 * sweep)
    canvas.add(angle_dimension(at, far, start, sweep, name, style))
    canvas.label(letter, middle, prefer=middle - at, clear=0.8, height=height)


def _free(canvas: Canvas, places: list[complex]) -> bool:
    """Whether arrowheads in these places are clear of all numbers."""
    reach = canvas.style.arrow
    for x0, y0, x1, y1 in (box(shape) for shape in canvas.shapes if isinstance(shape, Text)):
        if any(x0 - reach < p.real < x1 + reach and y0 - reach < p.imag < y1 + reach for p in places):
            return False
    return True


def lettered_sizes(scene: CamScene, profile: RollerProfile, line: int) -> list[str]:
    """Return the numbers of what has only a letter in the figure: the angles of one position, lengths."""
    words, solved = scene.words, scene.solved
    pressure = float(theta(solved, solved.angles[line]))
    angles = {"theta": pressure, "gamma": 0.5 * math.pi - abs(pressure)}
    lengths = {"rho_min": profile.rho_min, "h": solved.values["h"], "R_roller": profile.R}
    said = (f"{words.symbol(name)}_{{{line}}} = {scene.degrees(angle)}" for name, angle in angles.items())
    sizes = (f"{words.symbol(n)} = {scene.length(size)}" for n, size in lengths.items() if math.isfinite(size))
    return [*said, *sizes]


def roller_radius(canvas: Canvas, scene: CamScene, places: Sequence[complex], R: float) -> None:
    """Dimension the radius of the roller R, m, about its centre, one of the `places`, on the side of a dwell."""
    solved, words = scene.solved, scene.words
    division, rest = solved.layout.division, rests(solved.motion)
    line = division.last if rest else division.leave
    at, aside = places[line], ASIDE if rest else -ASIDE
    rim = at + unit_at(float(solved.angles[line]) + aside, solved.cam.sense) * (R / scene.mu_l)
    canvas.add(Group((Line(at, rim, Pen.THIN), Head(rim, rim - at)), "dimension", "R_roller"))
    canvas.label(words.symbol("R_roller"), rim, prefer=rim - at, clear=1.0, height=scene.style.text)
