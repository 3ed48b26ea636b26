"""The plan of a cam with a flat-faced follower by inversion: the plate in all positions, and the profile."""

from __future__ import annotations

from ...plans.cams.construction import PLATE_PROFILE
from ...plans.cams.course import up_at
from ..dimensions import linear
from ..figure import Figure, Stage
from ..hardware import Rod
from ..shapes import Group, Line, Pen, Polyline, Text
from ..text import Box, box, lay_out
from ..view import Canvas, View
from .inversion import (
    centre,
    circle,
    corners,
    heading,
    letter_centre,
    numbers,
    phases,
    quiet,
    radius_at,
    undercut_notes,
)
from .roller_view import NUMBERS, PHASES
from .scene import CamScene, needed

SAME = 1e-4  # part of the greatest velocity within which that of the fall is the same
ANALOGUE = "|s′|"  # letter of the velocity analogue where there is little room
ABOVE = 2.2, 4.6  # heights of letters from the plate to its dimensions
STEPS = 60  # along a line, to see what it runs through
THICK = 0.5  # thickness of the plate, in heights of letters


def plate_view(scene: CamScene) -> View:
    """Draw the cam as it stands when the follower is lowest."""
    solved, canvas = scene.solved, FIGURE.canvas(scene)
    plate = needed(solved.plate)
    r_0, stroke, R = map(scene.drawn, (plate.sizes.r_0, solved.motion.h, plate.sizes.R_plate))
    label = scene.style.label
    outer = max(abs(end) for i in solved.layout.division.lines for end in _plate(scene, i, R))
    rod = Rod(0.0, r_0 + THICK * label, outer + (PHASES + 1.2) * label, stroke, scene.style)
    reach = outer + NUMBERS * label
    canvas.part("shaft")
    centre(canvas, scene, r_0, rod.top + 6.0)
    canvas.part("circles")
    canvas.add(circle(r_0, "r_0_flat"))
    _positions(canvas, scene, R, reach - 0.9 * label)
    canvas.part("profile")
    outline = scene.curve(plate.profile.outline().tolist())
    canvas.add(Group((Polyline(outline, Pen.MAIN, closed=True),), "curve", "practical"))
    corners(canvas, scene, plate.profile.undercuts)
    canvas.part("circles")
    numbers(canvas, scene, 0.0, reach)
    phases(canvas, scene, 1j, outer + PHASES * label)
    canvas.part("follower")
    _follower(canvas, scene, rod, R)
    left = _sizes(canvas, scene, rod, R)
    notes = "; ".join([*left, *_numbers(scene)]), *undercut_notes(scene, plate.profile.undercuts)
    canvas.part("shaft")
    letter_centre(canvas, scene, r_0)
    edge = outer + (PHASES + 1.2) * label
    canvas.bounds = -edge, -edge, edge, rod.top + 16.0
    return canvas.finish("plate_profile", heading(scene, "heading.cam_plate_profile", PLATE_PROFILE), notes)


def _positions(canvas: Canvas, scene: CamScene, R: float, reach: float) -> None:
    """Draw the axis and the plate of each position, its centre, and where it touches the profile."""
    solved = scene.solved
    for i, phi in enumerate(solved.angles.tolist()):
        up = up_at(phi, solved.cam.sense)
        at, contact = (scene.mm(f"{PLATE_PROFILE}.{letter}{i}") for letter in "BK")
        canvas.part("circles")
        canvas.add(Line(0j, up * reach, Pen.THIN, role="position", name=str(i)))
        canvas.part("profile")
        if i:
            canvas.add(Line(*_plate(scene, i, R), Pen.THIN, role="plate", name=str(i)))
        for role, place, part in (("node", at, "centres"), ("contact", contact, "profile")):
            canvas.part(part)
            canvas.add(scene.node(place, str(i), role))


def _plate(scene: CamScene, i: int, R: float) -> tuple[complex, complex]:
    """Return the ends of the plate in a position."""
    at, up = scene.mm(f"{PLATE_PROFILE}.B{i}"), up_at(float(scene.solved.angles[i]), scene.solved.cam.sense)
    return at + 1j * up * R, at - 1j * up * R


def _follower(canvas: Canvas, scene: CamScene, rod: Rod, R: float) -> None:
    """Draw the plate and its rod in position 0."""
    low = rod.low - THICK * scene.style.label
    corners = (complex(-R, low), complex(R, low), complex(R, rod.low), complex(-R, rod.low))
    canvas.add(Group((Polyline(corners, Pen.MAIN, closed=True, fill="white"),), "plate", "0"))
    canvas.add(*rod.shapes())


def _sizes(canvas: Canvas, scene: CamScene, rod: Rod, R: float) -> list[str]:
    """Dimension radii, the plate, how far to both sides it touches, the stroke; return what has no place there."""
    solved, words, sense = scene.solved, scene.words, scene.solved.cam.sense
    plate, motion = needed(solved.plate), solved.motion
    middle, r_0 = quiet(motion, sense), scene.drawn(plate.sizes.r_0)
    canvas.part("circles")
    left_out = radius_at(canvas, scene, "r_0_flat", plate.sizes.r_0, middle, (0.0, r_0, r_0))
    canvas.part("follower")
    level, up = 1j * rod.low, 1j * scene.style.text
    _over(canvas, (level, level - sense * R), ABOVE[1] * up, words.symbol("R_plate"), "R_plate")
    right, left = (motion.maximum(0.0, side, 0.0).value for side in (1.0, -1.0))
    for far, name in ((right, "ds_right"), (-left, "ds_left")):
        ends = level, level + scene.drawn(far)
        if (far < 0.0) == (sense > 0):  # where the lower dwell leaves room
            _over(canvas, ends, ABOVE[0] * up, ANALOGUE, name)
        else:
            same = abs(right - left) < SAME * right
            linear(canvas, ends, ABOVE[0] * up, "" if same else ANALOGUE, name)
    canvas.part("centres")
    top = solved.layout.division.top
    axis = up_at(float(solved.angles[top]), sense)
    ends = axis * r_0, scene.mm(f"{PLATE_PROFILE}.B{top}")
    linear(canvas, ends, axis * (-1j * sense) * 4.0, words.symbol("h"), "h")
    return [left_out] if left_out else []


def _over(canvas: Canvas, ends: tuple[complex, complex], out: complex, text: str, name: str) -> None:
    """Dimension a level distance on a line moved upwards by `out`, the text on the line."""
    height = canvas.style.text
    over = Text(0.5 * (ends[0] + ends[1]) + out + 0.5j * height, text, height, "middle", role="label")
    narrow = abs(ends[1] - ends[0]) < lay_out(text, height).width + 1.0
    taken = narrow or _crossed(canvas, box(over))
    linear(canvas, ends, out, text if taken else "", name)
    if not taken:
        canvas.add(over)


def _crossed(canvas: Canvas, place: Box) -> bool:
    """Whether the line of a plate or an axis runs through a place."""
    x0, y0, x1, y1 = place
    lines = (shape for shape in canvas.shapes if isinstance(shape, Line))
    ways = ((line.a, line.b - line.a) for line in lines)
    points = (a + way * (k / STEPS) for a, way in ways for k in range(STEPS + 1))
    return any(x0 < point.real < x1 and y0 < point.imag < y1 for point in points)


def _numbers(scene: CamScene) -> list[str]:
    """Return the numbers of what has only a letter in the figure."""
    words, motion, plate = scene.words, scene.solved.motion, needed(scene.solved.plate)
    sizes = {"h": motion.h, "R_plate": plate.sizes.R_plate}
    lengths = [f"{words.symbol(name)} = {scene.length(size)}" for name, size in sizes.items()]
    said = dict.fromkeys(scene.length(motion.maximum(0.0, way, 0.0).value) for way in (1.0, -1.0))
    return [*lengths, f"{ANALOGUE} = |{words.symbol('ds')}|_{{max}} = {', '.join(said)}"]


FIGURE = Figure(
    PLATE_PROFILE,
    plate_view,
    ("mu_l",),
    (
        Stage("shaft", "plate_profile.O"),
        Stage("circles", "_axis#"),
        Stage("centres", "plate_profile.B#"),
        Stage("profile", "plate_profile.K#"),
        Stage("follower"),
    ),
    "cam.plate_profile",
)
