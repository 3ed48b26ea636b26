"""The plans of a cam by inversion: a roller, a rocker or a plate in all positions about it, and the profile."""

from __future__ import annotations

import math

from ...plans.cams.construction import PLATE_PROFILE, PROFILE
from ...plans.cams.course import on_circle, rests, turning, up_at
from ..dimensions import angle, linear
from ..figure import Figure, Stage, stages
from ..shapes import Arc, Group, Line, Pen, Polyline
from ..symbols import Rod, fixed_pivot, polar, revolute, swept, unit
from ..text import lay_out
from .inversion import NUMBERS, PHASES, RADIUS, Inversion, RollerInversion
from .scene import CamScene, is_aside

OUT = 1.5  # heights of letters from the roller to the dimension of the stroke
ASIDE = 0.45  # rad between the rays of two radii
OVER = 4.0  # mm of the roller's arcs beyond its extreme places
SAME = 1e-4  # part of the greatest velocity within which that of the fall is the same
ANALOGUE = "|s′|"  # letter of the velocity analogue where there is little room
ABOVE = 2.2, 4.6  # heights of letters from the plate to its dimensions
THICK = 0.5  # thickness of the plate, in heights of letters
ROOM = 16.0  # mm for letters above a rod


def _farthest(scene: CamScene) -> float:
    """Return a radius about the cam's centre beyond the roller in all positions, mm."""
    return max(abs(scene.mm(f"{PROFILE}.B{i}")) for i in scene.division.lines) + scene.sizes("R_roller")[0]


class _Roller(RollerInversion):
    """The cam for a roller on a line."""

    numbered = "lines"

    def __init__(self, scene: CamScene) -> None:
        e, s_0, stroke = scene.sizes("e", "s_0", "h")
        super().__init__(scene, scene.rolling.profile, "r_0", outer=_farthest(scene))
        self.circles |= {"e": abs(e)} if is_aside(scene) else {}
        self.e, self.start, self.past = e, on_circle(e, self.arcs, 1j), self.normal_end(scene.shown)
        self.rod = Rod(e, s_0, self.edge, stroke, scene.style)
        self.axis, self.top = self.rod.top + 12.0, self.rod.top + ROOM

    def position(self, i: int) -> None:
        """Draw the follower's line and the roller; the line touches the circle of the offset."""
        canvas = self.canvas
        canvas.part("lines")
        canvas.thin("position", str(i), self.mark("E", i), self.axis_end(i))
        if i:
            canvas.part("profile")
            self.roller(i)
        canvas.part("pitch", self.scene.node(self.mark("B", i), str(i)))

    def axis_end(self, i: int) -> complex:
        """Return the outer end of the follower's line in a position."""
        reach = self.outer + (NUMBERS - 0.9) * self.style.label
        return on_circle(self.e, reach, up_at(self.scene.solved, i))

    def rising(self, i: int) -> tuple[complex, complex]:
        """Return the instant centre, on the normal to the line through the cam's centre, and the line's direction."""
        return self.mark("P", i), up_at(self.scene.solved, i)

    def follower(self) -> list[str]:
        """Draw the normal of one position, roller and rod in position 0; dimension r_0, e, R and h."""
        canvas, scene, rod, division = self.canvas, self.scene, self.rod, self.scene.division
        (R,), low = scene.sizes("R_roller"), complex(rod.x, rod.low)
        self.sharpest()
        self.normal(scene.shown)
        canvas.part("follower")
        self.roller(0, Pen.MAIN)
        canvas.add(*rod.shapes(), revolute(low, "B0", self.style))
        canvas.part("circles")
        self.radius_at("r_0", self.quiet - RADIUS * self.sense, (0.0, self.r_0 - R, self.r_0))
        ends = complex(0.0, rod.top), complex(rod.x, rod.top)
        linear(canvas, ends, 6.0j, scene.dimension("e", abs(scene.value_of("e"))), "e")
        self.roller_radius()
        canvas.part("pitch")
        if rests(scene.solved.motion):
            out = complex(-self.sense * max(R + OUT * self.style.text, OUT * self.style.label))
            ends = low, low + 1j * rod.stroke
        else:
            up = up_at(scene.solved, division.top)
            out = up * (-1j * self.sense) * (0.5 * R)
            ends = on_circle(rod.x, self.r_0, up), self.mark("B", division.top)
        linear(canvas, ends, out, scene.symbol("h"), "h")
        return [*scene.pressed(), *scene.lettered("rho_min", "h", "R_roller"), *self.left]


class _Rocker(RollerInversion):
    """The cam for a rocker."""

    heading, base, numbered = "heading.cam_rocker_profile", "pivots", "pivots"
    phased = PHASES + 1.0

    def __init__(self, scene: CamScene) -> None:
        self.start, low = (scene.mm(f"{PROFILE}.{letter}0") for letter in "AB")
        self.turned, far = swept(1j, low), _farthest(scene)
        super().__init__(scene, scene.rolling.profile, "r_0", "l_OC", outer=max(abs(self.start), far))
        self.axis = far + 3.0

    def position(self, i: int) -> None:
        """Draw the pivot, the roller's arc about it, and the roller."""
        canvas, scene, pivot = self.canvas, self.scene, self.mark("A", i)
        (l,), low = scene.sizes("l_rocker"), -self.sense * float(scene.solved.angles[i])
        over = OVER / l
        canvas.part("pitch")
        sweep = scene.value_of("psi") + 2.0 * over
        canvas.add(Arc(pivot, l, low - over, sweep, Pen.THIN, role="arc", name=str(i)))
        if i:
            canvas.part("profile")
            self.roller(i)
            canvas.part("pivots", scene.node(pivot, f"A{i}"))
        canvas.part("pitch", scene.node(self.mark("B", i), f"B{i}"))

    def numbers(self, radius: float) -> None:
        """Write the number of each position beyond its pivot, with a tick from the pivot towards it."""
        for i in self.lines:
            pivot = self.mark("A", i)
            tick = pivot, unit(pivot) * (radius - 0.9 * self.style.label)
            self.canvas.thin("position", str(i), *tick)
            at, wide = unit(pivot) * radius, lay_out(str(i), self.style.text).width
            gaps = (at - other for other in self.numbered_at)
            if all(abs(gap.real) > wide or abs(gap.imag) > self.style.text for gap in gaps):  # clear of all before
                self.number(at, i)

    def rising(self, i: int) -> tuple[complex, complex]:
        """Return the instant centre, on the line of both pivots, and the direction across the rocker."""
        pivot, dpsi = self.mark("A", i), turning(self.scene.solved, i)  # where the roller moves as the cam does
        return pivot * (dpsi / (dpsi - 1.0)), 1j * unit(self.mark("B", i) - pivot)

    def follower(self) -> list[str]:
        """Draw one position with its normal, the rocker in position 0; dimension sizes and swing."""
        canvas, scene, words, pair = self.canvas, self.scene, self.scene.words, self.style.pair
        pivot, at, top = self.start, self.mark("B", 0), scene.division.top
        self.sharpest()
        canvas.part("normal")
        shown = self.mark("A", scene.shown), self.mark("B", scene.shown)
        canvas.group("rocker", str(scene.shown), Line(*shown, Pen.THIN))
        self.normal(scene.shown)
        canvas.part("follower")
        along = unit(at - pivot)
        self.roller(0, Pen.MAIN)
        canvas.group("rocker", "0", Line(pivot + along * pair, at - along * pair, Pen.MAIN))
        canvas.add(fixed_pivot(pivot, "A0", self.style), revolute(at, "B0", self.style))
        canvas.label("C", pivot, prefer=1 - 1j, clear=pair + 0.5)
        canvas.label("B", at, prefer=1 + 1j, clear=pair + 0.5)
        canvas.part("pivots")
        (R, l), far = scene.sizes("R_roller", "l_rocker"), self.circles["l_OC"]
        self.radius_at("r_0", self.quiet, (0.0, self.r_0 - R, self.r_0))
        self.radius_at("l_OC", self.quiet + ASIDE * self.sense, (self.r_0, far, far))
        self.roller_radius()
        canvas.part("pitch")
        high, low = self.mark("A", top), -self.sense * float(scene.solved.angles[top])
        rays = polar(l, low), self.mark("B", top) - high
        for ray in rays:
            canvas.thin("rocker", str(top), high, high + ray)
        angle(canvas, high, rays, 0.4 * abs(rays[0]), "psi", words.symbol("psi"), clear=0.8)
        canvas.part("follower")
        canvas.small(words.symbol("l_rocker"), (pivot, at), 1j)
        return [*scene.lettered("l_rocker", "R_roller", "rho_min", "psi"), *self.left]


class _Plate(Inversion):
    """The cam for a flat plate."""

    plan, heading = PLATE_PROFILE, "heading.cam_plate_profile"

    def __init__(self, scene: CamScene) -> None:
        (self.R, stroke, r_0), lines = scene.sizes("R_plate", "h", "r_0_flat"), scene.division.lines
        self.scene = scene
        outer = max(abs(end) for i in lines for end in self.plate(i))
        super().__init__(scene, scene.plate.profile, "r_0_flat", outer=outer)
        self.rod = Rod(0.0, r_0 + THICK * scene.style.label, self.edge, stroke, scene.style)
        self.axis, self.top = self.rod.top + 6.0, self.rod.top + ROOM

    def plate(self, i: int) -> tuple[complex, complex]:
        """Return the ends of the plate in a position."""
        at, up = self.mark("B", i), up_at(self.scene.solved, i)
        return at + 1j * up * self.R, at - 1j * up * self.R

    def position(self, i: int) -> None:
        """Draw the axis and the plate, its centre, and where it touches the profile."""
        canvas, reach = self.canvas, self.outer + (NUMBERS - 0.9) * self.style.label
        canvas.part("circles")
        canvas.thin("position", str(i), 0j, up_at(self.scene.solved, i) * reach)
        canvas.part("profile")
        if i:
            canvas.thin("plate", str(i), *self.plate(i))
        for role, mark, part in (("node", "B", "centres"), ("contact", "K", "profile")):
            canvas.part(part, self.scene.node(self.mark(mark, i), str(i), role))

    def follower(self) -> list[str]:
        """Draw plate and rod; dimension radii, the plate, how far to both sides it touches, the stroke."""
        canvas, scene, motion, rod, R = self.canvas, self.scene, self.scene.solved.motion, self.rod, self.R
        canvas.part("follower")
        low, level, up = rod.low - THICK * self.style.label, 1j * rod.low, 1j * self.style.text
        corners = (complex(-R, low), complex(R, low), complex(R, rod.low), complex(-R, rod.low))
        canvas.add(Group((Polyline(corners, Pen.MAIN, closed=True, fill="white"),), "plate", "0"), *rod.shapes())
        canvas.part("circles")
        self.radius_at("r_0_flat", self.quiet - RADIUS * self.sense, (0.0, self.r_0, self.r_0))
        canvas.part("follower")
        linear(canvas, (level, level - self.sense * R), ABOVE[1] * up, scene.symbol("R_plate"), "R_plate")
        right, left = (motion.maximum(0.0, side, 0.0).value for side in (1.0, -1.0))
        for far, name in ((right, "ds_right"), (-left, "ds_left")):
            ends = level, level + scene.drawn(far)
            if (far < 0.0) == (self.sense > 0):  # where the lower dwell leaves room
                linear(canvas, ends, ABOVE[0] * up, ANALOGUE, name)
            else:
                same = abs(right - left) < SAME * right
                linear(canvas, ends, ABOVE[0] * up, "" if same else ANALOGUE, name)
        canvas.part("centres")
        top = scene.division.top
        axis = up_at(scene.solved, top)
        ends = axis * self.r_0, self.mark("B", top)
        linear(canvas, ends, axis * (-1j * self.sense) * 4.0, scene.symbol("h"), "h")
        analogues = ", ".join(dict.fromkeys(scene.length(value) for value in (right, left)))
        greatest = f"{ANALOGUE} = |{scene.symbol('ds')}|_{{max}} = {analogues}"
        return [*self.left, *scene.lettered("h", "R_plate"), greatest]


def _is_sharp(scene: CamScene) -> bool:
    """Whether a pitch curve is convex anywhere, so that it has a least radius of curvature."""
    cam = scene.solved.rolling
    return cam is not None and 0.0 < cam.profile.sharpest.value < math.inf


def _central(scene: CamScene) -> str:
    """Return the ending of the key of a sentence that is another one where the follower's line has no offset."""
    return "" if is_aside(scene) else "_central"


LAST = Stage("sharpest", when=_is_sharp), Stage("follower")  # of cams for rollers
_Roller.figure = Figure(
    PROFILE,
    lambda scene: _Roller(scene).view(),
    ("mu_l",),
    (
        Stage("shaft", "profile.O"),
        Stage("circles", "_axis#", variant=_central, needs=("sizes.centre",)),
        Stage("lines", "profile.E#", variant=_central),
        *stages(pitch="profile.B#", normal="profile.P#", profile="profile.K#"),
        *LAST,
    ),
    "cam.profile",
)
_Rocker.figure = Figure(
    PROFILE,
    lambda scene: _Rocker(scene).view(),
    ("mu_l",),
    (
        Stage("shaft", "profile.O"),
        Stage("pivots", "profile.A#", needs=("rocker_sizes.centre",)),
        *stages(pitch="profile.B#", normal="profile.D#", profile="profile.K#"),
        *LAST,
    ),
    "cam.rocker_profile",
)
_Plate.figure = Figure(
    PLATE_PROFILE,
    lambda scene: _Plate(scene).view(),
    ("mu_l",),
    (
        Stage("shaft", "plate_profile.O"),
        Stage("circles", "_axis#", needs=("plate_sizes.centre",)),
        *stages(centres="plate_profile.B#", profile="plate_profile.K#"),
        Stage("follower"),
    ),
    "cam.plate_profile",
)
FIGURES = {"roller": _Roller.figure, "rocker": _Rocker.figure, "plate": _Plate.figure}
