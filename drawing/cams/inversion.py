"""What plans of cams by inversion share: numbered positions, phases, shaft, sense; of a roller curves, a normal."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from ...plans.cams import course
from ...plans.cams.construction import PROFILE
from ...plans.cams.envelopes import Envelope, Undercut
from ...plans.cams.motion import LOWER
from ...plans.cams.profile import RollerProfile
from ..formats import Style
from ..page import extent
from ..printed import DEGREES, decimals_for
from ..shapes import Circle, Group, Head, Line, Pen, Polyline, Text
from ..symbols import angle_dimension, polar, shaft, shaft_radius, swept, turning_arrow, unit
from ..text import lay_out
from ..view import Canvas
from .scene import CamScene

PAST = 5.0  # mm of the axes of a cam beyond its circles
Free = tuple[float, float, float]  # radii, mm: text stands between the first two, or beyond the third
OF_PHASE = (0.5, 0.7, 0.3, 0.8, 0.2)  # of the arc of a phase at which its text may stand
LOST = 3  # significant digits of a travel that is lost
TURNS = [0.1 * k - 1.2 for k in range(25)]  # rad from the middle of the dwell, for the letter of the centre
SIDEWAYS = 0.3  # sine of the angle below the horizontal from which on the support is there
BESIDE = 0.15  # rad between the middle of the lower dwell and the letter of the centre
RADIUS, ARROW = 0.35, 1.2  # rad from that middle towards the rod to the radius dimensioned, and to the arrow of omega
SMALLEST = 7.0  # least radius of a cam, in heights of letters, that has room for letters inside
REACH, BEYOND = 6.5, 4.0  # heights of letters from the roller's centre to the arc of theta; mm of the normal beyond it
# of the radius of an arc that may be taken instead of it
PARTS = (1.0, 0.9, 1.1, 0.8, 1.2, 0.7, 1.3, 0.6, 1.4, 0.5, 1.5)
SHARES = (0.5, 0.4, 0.6, 0.3, 0.7)  # of an arc at which its letter may stand
ASIDE = 0.5  # rad between a position and the radius dimensioned in it
FLAT = 1e-6  # rad, of an angle that is not shown


def numbers(canvas: Canvas, scene: CamScene, e: float, radius: float) -> None:
    """Write the number of each position on its line, at `radius`; that of position 0 beside the rod."""
    height, solved = scene.style.text, scene.solved
    written: list[complex] = []
    for i in solved.layout.division.lines:
        up = course.up_at(solved, i)
        at = course.on_circle(e, radius, up)
        if i == 0:  # beyond the cam's axis from there
            at = complex(-scene.style.label if e >= 0.0 else scene.style.label, at.imag)
        needed = lay_out(str(i), height).width + 0.3 * height
        on_rod = i > 0 and at.imag > 0.0 and abs(at.real - e) < scene.style.label
        if not on_rod and all(abs(at - other) > needed for other in written):  # where there are many, some have none
            number(canvas, at, i)
            written.append(at)


def number(canvas: Canvas, at: complex, i: int) -> None:
    """Write the number of a position about a place."""
    height = canvas.style.text
    canvas.add(Text(at - 0.5j * height, str(i), height, "middle", role="position", name=str(i)))


def phases(canvas: Canvas, scene: CamScene, start: complex, radius: float, past: complex = 0j) -> None:
    """Dimension the phases in degrees, from the ray to `start` on, outside of all positions.

    No text stands at the line to `past`.
    """
    motion, sense = scene.solved.motion, scene.solved.cam.sense
    first = swept(1.0 + 0j, start)
    for phase in motion.phases:
        if not phase.lasts:
            continue
        begin, sweep = first - sense * phase.start, -sense * phase.length
        name = f"phi_{phase.name}"
        canvas.add(angle_dimension(0j, radius, begin, sweep, name, scene.style))
        for angle in (begin, begin + sweep):
            canvas.add(Line(polar(radius - 1.5, angle), polar(radius + 2.0, angle), Pen.THIN, role="extension"))
        text = scene.angle(name, phase.length)
        shares = OF_PHASE[2:] if phase.name == LOWER else OF_PHASE  # beside the radius dimensioned
        half = 0.6 * lay_out(text, scene.style.text).width / radius
        middles = [begin + share * sweep for share in shares]
        clear = (a for a in middles if not past or abs(swept(1.0 + 0j, past * polar(1.0, -a))) > half)
        canvas.add(_along(text, radius, next(clear, middles[0]), abs(sweep), scene.style.text))


def _along(text: str, radius: float, angle: float, sweep: float, height: float) -> Text:
    """Return a text outside of an arc about the cam's centre, along it; where the arc is short, clear of its ends."""
    away = 0.5 * height if radius * sweep > 1.3 * lay_out(text, height).width else 1.4 * height
    out = polar(1.0, angle)
    below = out.imag < -1e-9
    turn = swept(1.0 + 0j, out * (1j if below else -1j))
    return Text(out * (radius + away + (height if below else 0.0)), text, height, "middle", turn)


def centre(canvas: Canvas, scene: CamScene, reach: float, top: float, turned: float = 0.0, offset: float = 0.0) -> None:
    """Draw the cam's shaft, its axes, and the arrow of omega.

    `turned` is the angle from the upright to the roller's centre in its lowest position, `offset` the radius of the
    circle that the follower's line touches, mm.
    """
    style, sense = scene.style, scene.solved.cam.sense
    canvas.part("shaft")
    for a, b in ((complex(-reach - PAST, 0.0), complex(reach + PAST, 0.0)), (complex(0.0, -reach - PAST), 1j * top)):
        canvas.add(Line(a, b, Pen.AXIS, role="axis"))
    r = shaft_radius(reach, style, offset)
    canvas.add(shaft(0j, r, style))
    middle = course.dwelling(scene.solved) + turned
    arrow, radius = middle - ARROW * sense, max(1.9 * r, offset + 0.6 * style.label)
    if polar(1.0, arrow).imag < -SIDEWAYS:  # the support is there
        arrow = -arrow
    canvas.add(turning_arrow(0j, radius, arrow, 0.9, float(sense), "omega"))
    canvas.label(scene.words.symbol("omega"), polar(radius, arrow), prefer=polar(1.0, arrow), clear=0.8)


def letter_centre(canvas: Canvas, scene: CamScene, reach: float, turned: float = 0.0, offset: float = 0.0) -> None:
    """Write the letter of the cam's centre, when all else is drawn: near the shaft, clear of all lines if it can be."""
    style, sense = scene.style, scene.solved.cam.sense
    canvas.part("shaft")
    size, middle = max(shaft_radius(reach, style, offset), offset), course.dwelling(scene.solved) + turned
    turns = sorted(TURNS, key=lambda turn: abs(turn - BESIDE))
    far = (size + style.label * part for part in (0.8, 0.95, 1.1, 1.3, 1.6, 2.0))
    places = [polar(away, middle + turn * sense) for away in far for turn in turns]
    if not canvas.write("O", places, style.label):
        side = polar(1.0, middle + BESIDE * sense)
        canvas.label("O", size * side, prefer=side, clear=0.8, priority=1)


def circle(radius: float, name: str) -> Group:
    """Return a thin circle about the cam's centre."""
    return Group((Circle(0j, radius, Pen.THIN),), "circle", name)


def radius_at(canvas: Canvas, scene: CamScene, radius: tuple[str, float], angle: float, free: Free) -> str:
    """Dimension a radius, by name and in m, of a circle about the cam's centre along a ray.

    The text runs along the ray: between the first two of the radii `free`, beyond the shaft, if need be without its
    number, or else beyond the third; that of a cam without room for letters stands where it finds a place. Returns the
    number, if it has no place in the figure.
    """
    name, style, size = radius[0], scene.style, scene.drawn(radius[1])
    ray, whole = polar(1.0, angle), scene.dimension(*radius)
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
    canvas.add(Text(at, text, style.text, "middle", swept(1.0 + 0j, ray * turn), role="label", name=name))
    return left


def quiet(scene: CamScene) -> float:
    """Return the direction along which a radius is dimensioned: in the lower dwell, beside the letter of the centre."""
    return course.dwelling(scene.solved) - RADIUS * scene.solved.cam.sense


def corners(canvas: Canvas, scene: CamScene, cuts: Sequence[Undercut]) -> None:
    """Mark the corners of an undercut profile."""
    for k, cut in enumerate(cuts):
        corner, radius = scene.drawn(cut.corner), 2.5 * scene.style.node
        canvas.add(Group((Circle(corner, radius, Pen.THIN),), "corner", str(k + 1)))
        canvas.label(_corner(cuts, k), corner, prefer=-corner, clear=radius + 0.5, height=scene.style.text)


def undercut_notes(scene: CamScene, profile: Envelope) -> tuple[str, ...]:
    """Say where a profile does not give the motion; the travels of a rocker are angles."""
    words, rocks, cuts, found = scene.words, scene.solved.rocker is not None, profile.undercuts, []
    for k, cut in enumerate(cuts):
        lost = cut.lost * DEGREES if rocks else cut.lost * 1e3
        unit = "°" if rocks else f" {words.unit('mm')}"
        text = f"{words.number(lost, decimals_for(lost, LOST))}{unit}"
        ends = {"start": scene.degrees(cut.start), "end": scene.degrees(cut.end)}
        warning, where = words["said.cam_undercut"].format(**ends, lost=text, corner=_corner(cuts, k)).split("|")
        found += [warning, where] if not k else [where]
    return tuple(found)


def _corner(cuts: Sequence[Undercut], k: int) -> str:
    return "Q" if len(cuts) == 1 else f"Q_{{{k + 1}}}"


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
    pitch = scene.curve(profile.pitch(scene.solved.motion.samples()[:-1]).tolist())
    outline = scene.curve(profile.outline().tolist())
    for points, pen, name, part in ((pitch, Pen.AXIS, "pitch", "pitch"), (outline, Pen.MAIN, "practical", "profile")):
        canvas.part(part)
        canvas.add(Group((Polyline(points, pen, closed=True),), "curve", name))
    corners(canvas, scene, profile.undercuts)


def sharpest(canvas: Canvas, scene: CamScene) -> None:
    """Mark the place of the least radius of curvature of the pitch curve, and the radius."""
    canvas.part("sharpest")
    found = course.sharpest_place(scene.solved)
    if found is None:
        return
    place, core, normal = scene.drawn(found.place), scene.drawn(found.core), found.normal
    canvas.add(Group((Line(core, place, Pen.THIN), Head(place, normal)), "dimension", "rho_min"))
    size = 0.8 * scene.style.arrow / 2
    cross = (Line(core - size * d, core + size * d, Pen.THIN) for d in (1 + 0j, 1j))
    canvas.add(Group(tuple(cross), "point", "curvature"))
    canvas.add(scene.node(place, "rho_min", "sharpest", filled=True, pen=Pen.MAIN))
    anchor = (core, place) if found.arc else core  # about the cam's centre stands enough
    canvas.label(scene.words.symbol("rho_min"), anchor, prefer=-normal, clear=0.8, height=scene.style.text)


def past_normal(contact: Contact, style: Style) -> complex:
    """Return the outer end of the normal that is drawn."""
    out = unit(contact.at - contact.touch)
    return contact.at + out * (REACH * style.label + BEYOND)


def normal(canvas: Canvas, scene: CamScene, contact: Contact) -> None:
    """Draw the normal of one position with the point of contact, the pressure and the transmission angle."""
    words, style, i = scene.words, scene.style, contact.line
    at, up = contact.at, contact.up
    out = unit(at - contact.touch)
    reach = REACH * style.label
    canvas.part("normal")
    canvas.add(Line(contact.pole, past_normal(contact, style), Pen.THIN, role="normal", name=str(i)))
    canvas.add(Line(at - 1j * up * reach, at + 1j * up * reach, Pen.THIN, role="transverse", name=str(i)))
    canvas.add(Line(0j, contact.pole, Pen.THIN, role="transverse", name=f"P{i}"))
    for mark, place, part in (("K", contact.touch, "profile"), ("P", contact.pole, "normal")):
        canvas.part(part)
        canvas.add(scene.node(place, f"{mark}{i}", "point", pen=Pen.MAIN))
        canvas.label(f"{mark}_{{{i}}}", place, prefer=place * 1j, clear=0.8, height=style.text)
    across = up * -1j if swept(out, up) > 0.0 else up * 1j
    for name, a, b, far in (("theta", out, up, reach), ("gamma", out, across, 0.5 * reach)):
        if abs(swept(a, b)) > FLAT:
            _angle(canvas, f"{words.symbol(name)}_{{{i}}}", f"{name}_{i}", at, (a, b), far)


def _angle(canvas: Canvas, letter: str, name: str, at: complex, rays: tuple[complex, complex], far: float) -> None:
    """Dimension the angle between two rays near a radius at which its letter is clear of all lines."""
    style, height = canvas.style, canvas.style.text
    start, sweep = swept(1.0 + 0j, rays[0]), swept(*rays)
    boxes, reach = [extent((shape,)) for shape in canvas.shapes if isinstance(shape, Text)], style.arrow

    def is_free(places: list[complex]) -> bool:  # whether arrowheads there are clear of all numbers
        beside = ((x0 - reach, y0 - reach, x1 + reach, y1 + reach) for x0, y0, x1, y1 in boxes)
        return not any(x0 < p.real < x1 and y0 < p.imag < y1 for x0, y0, x1, y1 in beside for p in places)

    free = [far * part for part in PARTS if is_free([at + ray * (far * part) for ray in rays])]
    for radius in free:
        beside = (radius + away * height for away in (1.0, -1.0, 1.2, -1.3))
        places = [at + polar(away, start + share * sweep) for away in beside for share in SHARES]
        canvas.add(angle_dimension(at, radius, start, sweep, name, style))
        if canvas.write(letter, places, height):
            return
        canvas.shapes.pop()
    far = next(iter(free), far)
    middle = at + polar(far, start + 0.5 * sweep)
    canvas.add(angle_dimension(at, far, start, sweep, name, style))
    canvas.label(letter, middle, prefer=middle - at, clear=0.8, height=height)


def lettered_sizes(scene: CamScene, profile: RollerProfile, line: int) -> list[str]:
    """Return the numbers of what has only a letter in the figure: the angles of one position, lengths."""
    pressure = float(course.theta(scene.solved, scene.solved.angles[line]))
    texts = [scene.angle("theta", pressure, line), scene.angle("gamma", course.transmission(pressure), line)]
    lengths = {"rho_min": profile.rho_min, "h": scene.solved.values["h"], "R_roller": profile.R}
    return [*texts, *(scene.dimension(name, size) for name, size in lengths.items() if math.isfinite(size))]


def roller_radius(canvas: Canvas, scene: CamScene, R: float) -> None:
    """Dimension the radius of the roller R, m, about its centre in a position on the side of a dwell."""
    solved, words, rest = scene.solved, scene.words, course.rests(scene.solved.motion)
    line = solved.layout.division.last if rest else solved.layout.division.leave
    at, aside = scene.mm(f"{PROFILE}.B{line}"), ASIDE if rest else -ASIDE
    rim = at + course.up_at(solved, line, aside) * scene.drawn(R)
    canvas.add(Group((Line(at, rim, Pen.THIN), Head(rim, rim - at)), "dimension", "R_roller"))
    canvas.label(words.symbol("R_roller"), rim, prefer=rim - at, clear=1.0, height=scene.style.text)
