"""What plans of cams by inversion share: numbered positions, phases, shaft, sense; of a roller curves, a normal."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence

from ...plans.cams import course
from ...plans.cams.construction import PROFILE
from ...plans.cams.envelopes import Envelope, Undercut
from ...plans.cams.followers import RollerProfile
from ...plans.cams.motion import LOWER
from ..dimensions import above
from ..figure import Figure
from ..page import extent
from ..printed import DEGREES, decimals_for
from ..shapes import Circle, Group, Head, Line, Pen, Polyline, Shape, Text
from ..symbols import angle_dimension, polar, shaft, shaft_radius, swept, turning_arrow, unit
from ..text import lay_out
from ..view import View
from .scene import CamScene

PAST = 5.0  # mm of the axes of a cam beyond its circles
OF_PHASE = (0.5, 0.7, 0.3, 0.8, 0.2)  # of the arc of a phase at which its text may stand
LOST = 3  # significant digits of a travel that is lost
TURNS = [0.1 * k - 1.2 for k in range(25)]  # rad from the middle of the dwell, for the letter of the centre
SIDEWAYS = 0.3  # sine of the angle below the horizontal from which on the support is there
BESIDE = 0.15  # rad between the middle of the lower dwell and the letter of the centre
RADIUS, ARROW = 0.35, 1.4  # rad from that middle towards the rod to the radius dimensioned, and to the arrow of omega
SMALLEST = 7.0  # least radius of a cam, in heights of letters, that has room for letters inside
REACH, BEYOND = 6.5, 4.0  # heights of letters from the roller's centre to the arc of theta; mm of the normal beyond it
# of the radius of an arc that may be taken instead of it
PARTS = (1.0, 0.9, 1.1, 0.8, 1.2, 0.7, 1.3, 0.6, 1.4, 0.5, 1.5)
SHARES = (0.5, 0.4, 0.6, 0.3, 0.7)  # of an arc at which its letter may stand
ASIDE = 0.5  # rad between a position and the radius dimensioned in it
OVER_KEY = 1.5  # radii of the shaft that clear its key
FLAT = 1e-6  # rad, of an angle that is not shown
SAME = 1e-3  # mm of an offset that is none
ALONG, BESIDE_ARC = 24, 1.0  # places along an arc, and mm between it and a number
NUMBERS, PHASES = 1.7, 2.8  # heights of letters from the outermost roller to the numbers, and to the arcs of the phases
EDGE = 1.2  # heights of letters from these arcs to the edge


class Inversion(ABC):
    """The plan of a cam with its follower in all positions: what is drawn of every one, in the order of the work.

    The `circles` about the cam's centre are named by their radii, the least radius is the first; `outer` is a radius
    beyond all positions, mm.
    """

    figure: Figure[CamScene]
    plan, heading = PROFILE, "heading.cam_profile"
    base, numbered = "circles", "circles"  # stages of circles and phases, and of the numbers of positions
    phased = PHASES
    start, past = 1j, 0j  # along which the lowest position is seen from the centre; where no text of a phase stands
    e = 0.0  # offset of the follower's line, mm
    turned = 0.0  # angle from the upright to the roller's centre in its lowest position

    def __init__(self, scene: CamScene, profile: Envelope, *circles: str, outer: float) -> None:
        self.scene, self.profile, self.outer, self.sense = scene, profile, outer, scene.solved.cam.sense
        self.canvas, self.style, self.lines = self.figure.canvas(scene), scene.style, scene.division.lines
        self.canvas.breaks = {"position": True, "transverse": True, "axis": False}
        self.circles = dict(zip(circles, scene.sizes(*circles), strict=True))
        self.r_0, self.arcs = self.circles[circles[0]], outer + self.phased * scene.style.label
        self.edge = self.axis = self.top = self.arcs + EDGE * scene.style.label  # also of the upright axis, of letters
        self.left: list[str] = []  # sizes that have no place in the figure
        self.numbered_at: list[complex] = []  # places of numbers

    def mark(self, letter: str, line: int) -> complex:
        """Return a mark of a position, mm."""
        return self.scene.mm(f"{self.plan}.{letter}{line}")

    @property
    def quiet(self) -> float:
        """The direction in the middle of the longer dwell."""
        return course.dwelling(self.scene.solved) + self.turned

    def view(self) -> View:
        """Draw the cam as it stands when the follower is lowest."""
        canvas, scene = self.canvas, self.scene
        self._centre()
        canvas.part(self.base, *(Group((Circle(0j, r, Pen.THIN),), "circle", name) for name, r in self.circles.items()))
        for i in self.lines:
            self.position(i)
        curves = [("profile", "practical", self.profile.outline(), Pen.MAIN)]
        if isinstance(self.profile, RollerProfile):
            curves.insert(0, ("pitch", "pitch", self.profile.pitch(self.profile.motion.samples()[:-1]), Pen.AXIS))
        for part, name, points, pen in curves:
            canvas.part(part)
            canvas.group("curve", name, Polyline(scene.curve(points.tolist()), pen, closed=True))
        for k, undercut in enumerate(self.profile.undercuts):
            corner, radius = scene.drawn(undercut.corner), 2.5 * self.style.node
            canvas.group("corner", str(k + 1), Circle(corner, radius, Pen.THIN))
            canvas.small(_corner(self.profile.undercuts, k), corner, -corner, radius + 0.5)
        canvas.part(self.numbered)
        self.numbers(self.outer + NUMBERS * self.style.label)
        canvas.part(self.base)
        dimensions = self._phases()
        notes = "; ".join(self.follower()), *undercut_notes(scene, self.profile)
        canvas.part(self.base, *dimensions)  # over the rod, which would hide their arrowheads
        self._letter_centre()
        canvas.bounds = -self.edge, -self.edge, self.edge, self.top
        return canvas.finish(self.plan, scene.heading(self.heading, self.plan), notes)

    @abstractmethod
    def position(self, i: int) -> None:
        """Draw the follower in a position."""

    @abstractmethod
    def follower(self) -> list[str]:
        """Draw the follower as it stands, dimensioned; return the numbers of what has only a letter."""

    def numbers(self, radius: float) -> None:
        """Write the number of each position on its line, at `radius`; that of position 0 beside the rod."""
        label, height, e = self.style.label, self.style.text, self.e
        for i in self.lines:
            at = course.on_circle(e, radius, course.up_at(self.scene.solved, i))
            if i == 0:
                at = self._beside_rod(at)
            needed = lay_out(str(i), height).width + 0.3 * height
            on_rod = i > 0 and at.imag > 0.0 and abs(at.real - e) < label
            if not on_rod and all(abs(at - other) > needed for other in self.numbered_at):  # of many, some have none
                self.number(at, i)

    def _beside_rod(self, at: complex) -> complex:
        """Return the place of number 0: by the rod, away from the cam's axis, or beyond that if rays are there.

        A rod over the centre has it on the side of the lower dwell.
        """
        label, e, height = self.style.label, self.e, self.style.text
        side = 1.0 if e > 0.0 else -1.0
        near = complex(e + side * (0.5 * label + 0.9 * height), at.imag)
        others = (self.mark("B", i) for i in self.lines if i)
        rays = (course.up_at(self.scene.solved, i) for i in self.lines if i)
        apart = (abs(((near - b) / up).imag) for b, up in zip(others, rays, strict=True) if up.imag > 0.0)
        if abs(e) > SAME and min(apart, default=label) > height:
            return near
        return complex(-label if e >= 0.0 else label, at.imag)

    def number(self, at: complex, i: int) -> None:
        """Write the number of a position about a place."""
        height = self.style.text
        self.canvas.add(Text(at - 0.5j * height, str(i), height, "middle", role="position", name=str(i)))
        self.numbered_at.append(at)

    def _phases(self) -> list[Shape]:
        """Write the phases in degrees, outside of all positions; return their dimensions, from the lowest one on."""
        scene, radius, height, past = self.scene, self.arcs, self.style.text, self.past
        dimensions = list[Shape]()
        first = swept(1.0 + 0j, self.start)
        for phase in scene.solved.motion.phases:
            if not phase.lasts:
                continue
            begin, sweep, name = first - self.sense * phase.start, -self.sense * phase.length, f"phi_{phase.name}"
            dimensions.append(angle_dimension(0j, radius, begin, sweep, name, self.style))
            for angle in (begin, begin + sweep):
                ends = polar(radius - 1.5, angle), polar(radius + 2.0, angle)
                dimensions.append(Line(*ends, Pen.THIN, role="extension"))
            text = scene.angle(name, phase.length)
            half = 0.6 * lay_out(text, height).width / radius
            # beside the radius dimensioned
            middles = [begin + share * sweep for share in OF_PHASE[2 * (phase.name == LOWER) :]]
            clear = (a for a in middles if not past or abs(swept(1.0 + 0j, past * polar(1.0, -a))) > half)
            out = polar(1.0, next(clear, middles[0]))
            # outside of the arc, along it; where the arc is short, clear of its ends
            away, below = 1.4 if radius * abs(sweep) <= 1.3 * lay_out(text, height).width else 0.5, out.imag < -1e-9
            turn = swept(1.0 + 0j, out * (1j if below else -1j))
            at = out * (radius + away * height + height * below)
            self.canvas.add(Text(at, text, height, "middle", turn))
        return dimensions

    def _centre(self) -> None:
        """Draw the cam's shaft, its axes, and the arrow of omega."""
        canvas, reach = self.canvas, self.r_0 + PAST
        canvas.part("shaft")
        for a, b in ((complex(-reach, 0.0), complex(reach, 0.0)), (complex(0.0, -reach), 1j * self.axis)):
            canvas.add(Line(a, b, Pen.AXIS, role="axis"))
        r = shaft_radius(self.r_0, self.style, abs(self.e))
        canvas.add(shaft(0j, r, self.style))
        arrow, radius = self.quiet - ARROW * self.sense, max(1.9 * r, abs(self.e) + 0.6 * self.style.label)
        if polar(1.0, arrow).imag < -SIDEWAYS:  # the support is there
            arrow = -arrow
        canvas.add(turning_arrow(0j, radius, arrow, 0.9, float(self.sense), "omega"))
        canvas.label(self.scene.symbol("omega"), polar(radius, arrow), prefer=polar(1.0, arrow), clear=0.8)

    def _letter_centre(self) -> None:
        """Write the letter of the cam's centre, when all else is drawn: near the shaft, clear of all lines."""
        canvas, label, sense = self.canvas, self.style.label, self.sense
        canvas.part("shaft")
        size = max(shaft_radius(self.r_0, self.style, abs(self.e)), abs(self.e))
        turns = sorted(TURNS, key=lambda turn: abs(turn - BESIDE))
        far = (size + label * part for part in (0.8, 0.95, 1.1, 1.3, 1.6, 2.0))
        places = [polar(away, self.quiet + turn * sense) for away in far for turn in turns]
        if not canvas.write("O", places, label):
            side = polar(1.0, self.quiet + BESIDE * sense)
            canvas.label("O", size * side, prefer=side, clear=0.8, priority=1)

    def radius_at(self, name: str, angle: float, free: tuple[float, float, float]) -> None:
        """Dimension a radius of a circle about the cam's centre along a ray.

        The text runs along the ray: between the first two of the radii `free`, mm, beyond the shaft, if need be without
        its number, or else beyond the third; that of a cam without room for letters stands where it finds a place.
        """
        canvas, style, (size,) = self.canvas, self.style, self.scene.sizes(name)
        ray, (whole,) = polar(1.0, angle), self.scene.lettered(name)
        low, high = max(OVER_KEY * shaft_radius(size, style), free[0]) + 1.0, min(free[1], size - style.arrow)
        text = whole if lay_out(whole, style.text).width < high - low else self.scene.symbol(name)
        self.left += [whole] if text != whole else []
        wide = lay_out(text, style.text).width
        inside, is_small = wide < high - low, size < SMALLEST * style.label
        line = Line(
            0j, ray * (size if inside or is_small else free[2] + wide + 1.5), Pen.THIN, role="radius", name=name
        )
        canvas.group("dimension", name, line, Head(ray * size, ray))
        if is_small:
            canvas.small(text, (0.5 * ray * size, ray * size), ray)
            return
        middle = 0.5 * (low + high) if inside else free[2] + 0.5 * wide + 1.5
        turn = 1.0 if ray.real > -1e-9 else -1.0
        at = ray * complex(middle, turn * above(text, style.text))
        canvas.add(Text(at, text, style.text, "middle", swept(1.0 + 0j, ray * turn), role="label", name=name))


def undercut_notes(scene: CamScene, profile: Envelope) -> tuple[str, ...]:
    """Say where a profile does not give the motion; the travels of a rocker are angles."""
    words, rocks, notes = scene.words, scene.solved.layout.rocks, list[str]()
    for k, cut in enumerate(profile.undercuts):
        lost, unit = (cut.lost * DEGREES, "°") if rocks else (cut.lost * 1e3, f" {words.unit('mm')}")
        text = f"{words.number(lost, decimals_for(lost, LOST))}{unit}"
        ends = {"start": scene.degrees(cut.start), "end": scene.degrees(cut.end)}
        said = words["said.cam_undercut"].format(**ends, lost=text, corner=_corner(profile.undercuts, k))
        notes += said.split("|")[k > 0 :]  # the warning once
    return tuple(notes)


def _corner(cuts: Sequence[Undercut], k: int) -> str:
    return "Q" if len(cuts) == 1 else f"Q_{{{k + 1}}}"


class RollerInversion(Inversion):
    """That of a follower with a roller, the normal of one position on it."""

    @abstractmethod
    def rising(self, i: int) -> tuple[complex, complex]:
        """Return the instant centre of cam and follower in a position, mm, and the direction in which it rises."""

    def roller(self, i: int, pen: Pen = Pen.THIN) -> None:
        """Draw the roller in a position."""
        (R,) = self.scene.sizes("R_roller")
        self.canvas.group("roller", str(i), Circle(self.mark("B", i), R, pen))

    def sharpest(self) -> None:
        """Mark the place of the least radius of curvature of the pitch curve, and the radius."""
        canvas, scene = self.canvas, self.scene
        canvas.part("sharpest")
        sharpest = course.sharpest_place(scene.solved)
        if sharpest is None:
            return
        at, normal, centre, is_arc = sharpest
        place, core = scene.drawn(at), scene.drawn(centre)
        canvas.group("dimension", "rho_min", Line(core, place, Pen.THIN), Head(place, normal))
        size = 0.8 * self.style.arrow / 2
        cross = (Line(core - size * d, core + size * d, Pen.THIN) for d in (1 + 0j, 1j))
        canvas.group("point", "curvature", *cross)
        canvas.add(scene.node(place, "rho_min", "sharpest", filled=True, pen=Pen.MAIN))
        anchor = (core, place) if is_arc else core  # about the cam's centre stands enough
        canvas.small(scene.symbol("rho_min"), anchor, -normal)

    def normal_end(self, i: int) -> complex:
        """Return the outer end of the normal that is drawn in a position."""
        at = self.mark("B", i)
        return at + unit(at - self.mark("K", i)) * (REACH * self.style.label + BEYOND)

    def axis_end(self, i: int) -> complex:
        """Return how far the line in which the follower rises is drawn in a position."""
        return self.mark("B", i)

    def normal(self, i: int) -> None:
        """Draw the normal of one position with the point of contact, the pressure and the transmission angle."""
        canvas, scene, reach = self.canvas, self.scene, REACH * self.style.label
        at, touch, (pole, up) = self.mark("B", i), self.mark("K", i), self.rising(i)
        out = unit(at - touch)
        canvas.part("normal")
        canvas.thin("normal", str(i), pole, self.normal_end(i))
        canvas.thin("transverse", str(i), at - 1j * up * reach, at + 1j * up * reach)
        canvas.thin("transverse", f"P{i}", 0j, pole)
        for mark, place, part in (("K", touch, "profile"), ("P", pole, "normal")):
            canvas.part(part, scene.node(place, f"{mark}{i}", "point", pen=Pen.MAIN))
            canvas.label(f"{mark}_{{{i}}}", place, prefer=place * 1j, height=self.style.text, strict=True)
        across = up * -1j if swept(out, up) > 0.0 else up * 1j
        for name, rays, far in (("theta", (out, up), reach), ("gamma", (out, across), 0.5 * reach)):
            if abs(swept(*rays)) > FLAT:
                radius = self._angle(f"{scene.symbol(name)}_{{{i}}}", f"{name}_{i}", at, rays, far)
                if name == "theta":  # both sides of it are drawn beyond its arrowheads
                    self._drawn_on((at, out), self.normal_end(i), radius, "normal", str(i))
                    self._drawn_on((at, up), self.axis_end(i), radius, "position", str(i))

    def _drawn_on(self, ray: tuple[complex, complex], end: complex, radius: float, role: str, name: str) -> None:
        """Draw a ray on from where it ends until it is beyond a radius."""
        (at, along), beyond = ray, radius + BEYOND
        if ((end - at) / along).real < beyond:
            self.canvas.thin(role, name, end, at + along * beyond)

    def _angle(self, text: str, name: str, at: complex, rays: tuple[complex, complex], far: float) -> float:
        """Dimension the angle between two rays near a radius at which its letter is clear of all lines; return it."""
        canvas, style, height = self.canvas, self.style, self.style.text
        start, sweep = swept(1.0 + 0j, rays[0]), swept(*rays)
        boxes = [extent((shape,)) for shape in canvas.shapes if isinstance(shape, Text)]
        boxes = [(x0 - BESIDE_ARC, y0 - BESIDE_ARC, x1 + BESIDE_ARC, y1 + BESIDE_ARC) for x0, y0, x1, y1 in boxes]

        def is_free(radius: float) -> bool:  # whether the arc with its arrowheads is clear of all numbers
            past = 0.0 if abs(sweep) * radius > 2.5 * style.arrow else 2.0 * style.arrow / radius
            past = past if sweep > 0.0 else -past
            first, whole = start - past, sweep + 2.0 * past
            arc = [at + polar(radius, first + whole * k / ALONG) for k in range(ALONG + 1)]
            return not any(x0 < p.real < x1 and y0 < p.imag < y1 for x0, y0, x1, y1 in boxes for p in arc)

        free = [far * part for part in PARTS if is_free(far * part)]
        for radius in free:
            beside = (radius + away * height for away in (1.0, -1.0, 1.2, -1.3))
            places = [at + polar(away, start + share * sweep) for away in beside for share in SHARES]
            canvas.add(angle_dimension(at, radius, start, sweep, name, style))
            if canvas.write(text, places, height):
                return radius
            canvas.shapes.pop()
        far = next(iter(free), far)
        middle = at + polar(far, start + 0.5 * sweep)
        canvas.add(angle_dimension(at, far, start, sweep, name, style))
        canvas.small(text, middle, middle - at)
        return far

    def roller_radius(self) -> None:
        """Dimension the radius of the roller about its centre in a position on the side of a dwell."""
        solved, rest, (R,) = self.scene.solved, course.rests(self.scene.solved.motion), self.scene.sizes("R_roller")
        line = solved.layout.division.last if rest else solved.layout.division.leave
        at = self.mark("B", line)
        rim = at + course.up_at(solved, line, ASIDE if rest else -ASIDE) * R
        self.canvas.part("profile")
        self.canvas.group("dimension", "R_roller", Line(at, rim, Pen.THIN), Head(rim, rim - at))
        self.canvas.small(self.scene.symbol("R_roller"), rim, rim - at, 1.0)
