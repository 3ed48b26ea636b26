"""The plan of a cam with a roller by inversion: pitch curve, roller in all positions, practical profile, follower."""

from __future__ import annotations

from ...plans.cams.construction import PROFILE
from ...plans.cams.course import on_circle, pressed, rests, up_at
from ..dimensions import linear
from ..figure import Figure, Stage
from ..hardware import Rod
from ..shapes import Circle, Group, Line, Pen
from ..symbols import revolute
from ..view import Canvas, View
from .inversion import (
    Contact,
    centre,
    circle,
    curves,
    heading,
    letter_centre,
    lettered_sizes,
    normal,
    numbers,
    past_normal,
    phases,
    quiet,
    radius_at,
    roller_radius,
    sharpest,
    undercut_notes,
)
from .scene import CamScene, is_aside, is_sharp, needed
from .sizes_view import SHOWN

OUT = 1.5  # heights of letters from the roller to the dimension of the stroke
NUMBERS, PHASES = 1.7, 2.8  # heights of letters from the outermost roller to the numbers, and to the arcs of the phases


def roller_view(scene: CamScene) -> View:
    """Draw the cam as it stands when the follower is lowest."""
    solved, canvas = scene.solved, FIGURE.canvas(scene)
    roller = needed(solved.roller)
    e, s_0, stroke = map(scene.drawn, (roller.sizes.e, roller.sizes.s_0, solved.motion.h))
    R, r_0 = scene.drawn(roller.profile.R), scene.drawn(roller.sizes.r_0)
    outer = max(abs(scene.mm(f"{PROFILE}.B{i}")) for i in solved.layout.division.lines) + R
    label = scene.style.label
    rod = Rod(e, s_0, outer + (PHASES + 1.2) * label, stroke, scene.style)
    reach = outer + NUMBERS * label
    canvas.part("shaft")
    centre(canvas, scene, r_0, rod.top + 12.0, offset=abs(e))
    canvas.part("circles")
    canvas.add(circle(r_0, "r_0"))
    if is_aside(scene):
        canvas.add(circle(abs(e), "e"))
    _positions(canvas, scene, e, reach - 0.9 * label)
    curves(canvas, scene, roller.profile)
    canvas.part("lines")
    numbers(canvas, scene, e, reach)
    contact = _contact(scene, pressed(solved, SHOWN))
    canvas.part("circles")
    arcs = outer + PHASES * label
    phases(canvas, scene, on_circle(e, arcs, 1j), arcs, past_normal(contact, scene.style))
    canvas.part("sharpest")
    sharpest(canvas, scene)
    normal(canvas, scene, contact)
    canvas.part("follower")
    _follower(canvas, scene, rod, R)
    left = _sizes(canvas, scene, rod)
    canvas.part("shaft")
    letter_centre(canvas, scene, r_0, offset=abs(e))
    edge = outer + (PHASES + 1.2) * label
    canvas.bounds = -edge, -edge, edge, rod.top + 16.0
    notes = (
        "; ".join([*lettered_sizes(scene, roller.profile, contact.line), *left]),
        *undercut_notes(scene, roller.profile.undercuts),
    )
    return canvas.finish("profile", heading(scene, "heading.cam_profile", PROFILE), notes)


def _positions(canvas: Canvas, scene: CamScene, e: float, reach: float) -> None:
    """Draw the follower's line and the roller in each position; the line touches the circle of the offset."""
    solved, R = scene.solved, scene.drawn(float(scene.solved.values["R_roller"]))
    for i, phi in enumerate(solved.angles.tolist()):
        up = up_at(phi, solved.cam.sense)
        foot, at = scene.mm(f"{PROFILE}.E{i}"), scene.mm(f"{PROFILE}.B{i}")
        canvas.part("lines")
        canvas.add(Line(foot, on_circle(e, reach, up), Pen.THIN, role="position", name=str(i)))
        if i:
            canvas.part("profile")
            canvas.add(Group((Circle(at, R, Pen.THIN),), "roller", str(i)))
        canvas.part("pitch")
        canvas.add(scene.node(at, str(i)))


def _contact(scene: CamScene, i: int) -> Contact:
    """Return the position of a section line."""
    pole, at, touch = (scene.mm(f"{PROFILE}.{letter}{i}") for letter in "PBK")
    return Contact(i, at, touch, pole, up_at(float(scene.solved.angles[i]), scene.solved.cam.sense))


def _follower(canvas: Canvas, scene: CamScene, rod: Rod, R: float) -> None:
    """Draw the roller and its rod in position 0, guided and pressed down by a spring."""
    at = complex(rod.x, rod.low)
    canvas.add(Group((Circle(at, R, Pen.MAIN),), "roller", "0"))
    canvas.add(*rod.shapes())
    canvas.add(revolute(at, "B0", scene.style))


def _sizes(canvas: Canvas, scene: CamScene, rod: Rod) -> list[str]:
    """Dimension r_0, e, the roller and the stroke; return what has no place in the figure."""
    solved, words = scene.solved, scene.words
    roller, sense = needed(solved.roller), solved.cam.sense
    middle = quiet(solved.motion, sense)
    r_0, R = scene.drawn(roller.sizes.r_0), scene.drawn(roller.profile.R)
    canvas.part("circles")
    left = radius_at(
        canvas, scene, "r_0", roller.sizes.r_0, middle, (0.0, scene.drawn(roller.sizes.r_0 - roller.profile.R), r_0)
    )
    level = rod.top + 6.0
    ends = complex(0.0, rod.top), complex(rod.x, rod.top)
    linear(canvas, ends, 1j * (level - rod.top), f"{words.symbol('e')} = {scene.length(abs(roller.sizes.e))}", "e")
    division = solved.layout.division
    canvas.part("profile")
    roller_radius(canvas, scene, [scene.mm(f"{PROFILE}.B{i}") for i in division.lines], roller.profile.R)
    canvas.part("pitch")
    if rests(solved.motion):
        low = complex(rod.x, rod.low)
        out = complex(-sense * max(R + OUT * scene.style.text, OUT * scene.style.label))
        ends = low, low + 1j * rod.stroke
    else:
        up = up_at(float(solved.angles[division.top]), sense)
        out = up * (-1j * sense) * (0.5 * R)
        ends = on_circle(rod.x, r_0, up), scene.mm(f"{PROFILE}.B{division.top}")
    linear(canvas, ends, out, words.symbol("h"), "h")
    return [left] if left else []


def _central(scene: CamScene) -> str:
    """Return the ending of the key of a sentence that is another one where the follower's line has no offset."""
    return "" if is_aside(scene) else "_central"


FIGURE = Figure(
    PROFILE,
    roller_view,
    ("mu_l",),
    (
        Stage("shaft", "profile.O"),
        Stage("circles", "_axis#", variant=_central),
        Stage("lines", "profile.E#", variant=_central),
        Stage("pitch", "profile.B#"),
        Stage("normal", "profile.P#"),
        Stage("profile", "profile.K#"),
        Stage("sharpest", when=is_sharp),
        Stage("follower"),
    ),
    "cam.profile",
)
