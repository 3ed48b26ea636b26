"""The plans of a cam by inversion: a roller, a rocker or a plate in all positions about it, and the profile."""

from __future__ import annotations

import math

from ...plans.cams.construction import PLATE_PROFILE, PROFILE
from ...plans.cams.course import dwelling, on_circle, pole_share, pressed, rests, up_at
from ..figure import Figure, Stage
from ..page import extent
from ..shapes import Arc, Circle, Group, Line, Pen, Polyline, Text
from ..symbols import Rod, fixed_pivot, polar, revolute, swept, unit
from ..text import lay_out
from ..view import Canvas, View, angle, linear
from . import inversion
from .scene import SHOWN, CamScene, is_aside, is_sharp, needed

OUT = 1.5  # heights of letters from the roller to the dimension of the stroke
NUMBERS, PHASES = 1.7, 2.8  # heights of letters from the outermost roller to the numbers, and to the arcs of the phases
ASIDE = 0.45  # rad between the rays of two radii
OVER = 4.0  # mm of the roller's arcs beyond its extreme places
SAME = 1e-4  # part of the greatest velocity within which that of the fall is the same
ANALOGUE = "|s′|"  # letter of the velocity analogue where there is little room
ABOVE = 2.2, 4.6  # heights of letters from the plate to its dimensions
STEPS = 60  # along a line, to see what it runs through
THICK = 0.5  # thickness of the plate, in heights of letters


def roller_view(scene: CamScene) -> View:
    """Draw the cam as it stands when the follower is lowest."""
    solved, canvas = scene.solved, ROLLER_FIGURE.canvas(scene)
    roller = needed(solved.roller)
    e, s_0, stroke = map(scene.drawn, (roller.sizes.e, roller.sizes.s_0, solved.motion.h))
    R, r_0 = scene.drawn(roller.profile.R), scene.drawn(roller.sizes.r_0)
    outer = max(abs(scene.mm(f"{PROFILE}.B{i}")) for i in solved.layout.division.lines) + R
    label = scene.style.label
    reach, edge = outer + NUMBERS * label, outer + (PHASES + 1.2) * label
    rod = Rod(e, s_0, edge, stroke, scene.style)
    inversion.centre(canvas, scene, r_0, rod.top + 12.0, offset=abs(e))
    canvas.part("circles")
    canvas.add(inversion.circle(r_0, "r_0"))
    if is_aside(scene):
        canvas.add(inversion.circle(abs(e), "e"))
    _roller_positions(canvas, scene, e, reach - 0.9 * label)
    inversion.curves(canvas, scene, roller.profile)
    canvas.part("lines")
    inversion.numbers(canvas, scene, e, reach)
    contact = _contact(scene, pressed(solved, SHOWN))
    canvas.part("circles")
    arcs = outer + PHASES * label
    inversion.phases(canvas, scene, on_circle(e, arcs, 1j), arcs, inversion.past_normal(contact, scene.style))
    inversion.sharpest(canvas, scene)
    inversion.normal(canvas, scene, contact)
    left = _roller_follower(canvas, scene, rod)
    inversion.letter_centre(canvas, scene, r_0, offset=abs(e))
    canvas.bounds = -edge, -edge, edge, rod.top + 16.0
    lettered = [*inversion.lettered_sizes(scene, roller.profile, contact.line), *left]
    notes = "; ".join(lettered), *inversion.undercut_notes(scene, roller.profile)
    return canvas.finish("profile", scene.heading("heading.cam_profile", PROFILE), notes)


def _roller_positions(canvas: Canvas, scene: CamScene, e: float, reach: float) -> None:
    """Draw the follower's line and the roller in each position; the line touches the circle of the offset."""
    solved, R = scene.solved, scene.drawn(float(scene.solved.values["R_roller"]))
    for i in solved.layout.division.lines:
        up = up_at(solved, i)
        foot, at = scene.mm(f"{PROFILE}.E{i}"), scene.mm(f"{PROFILE}.B{i}")
        canvas.part("lines")
        canvas.add(Line(foot, on_circle(e, reach, up), Pen.THIN, role="position", name=str(i)))
        if i:
            canvas.part("profile")
            canvas.add(Group((Circle(at, R, Pen.THIN),), "roller", str(i)))
        canvas.part("pitch")
        canvas.add(scene.node(at, str(i)))


def _contact(scene: CamScene, i: int) -> inversion.Contact:
    pole, at, touch = (scene.mm(f"{PROFILE}.{letter}{i}") for letter in "PBK")
    return inversion.Contact(i, at, touch, pole, up_at(scene.solved, i))


def _roller_follower(canvas: Canvas, scene: CamScene, rod: Rod) -> list[str]:
    """Draw the roller and its rod in position 0, dimension r_0, e, R and h; return what has no place there."""
    solved, sense, sizes = scene.solved, scene.solved.cam.sense, needed(scene.solved.roller).sizes
    r_0, R, at = scene.drawn(sizes.r_0), needed(solved.roller).profile.R, complex(rod.x, rod.low)
    canvas.part("follower")
    canvas.add(Group((Circle(at, scene.drawn(R), Pen.MAIN),), "roller", "0"), *rod.shapes())
    canvas.add(revolute(at, "B0", scene.style))
    canvas.part("circles")
    free = (0.0, scene.drawn(sizes.r_0 - R), r_0)
    left = inversion.radius_at(canvas, scene, ("r_0", sizes.r_0), inversion.quiet(scene), free)
    ends = complex(0.0, rod.top), complex(rod.x, rod.top)
    linear(canvas, ends, 6.0j, scene.dimension("e", abs(sizes.e)), "e")
    division = solved.layout.division
    canvas.part("profile")
    inversion.roller_radius(canvas, scene, R)
    canvas.part("pitch")
    if rests(solved.motion):
        low = complex(rod.x, rod.low)
        out = complex(-sense * max(scene.drawn(R) + OUT * scene.style.text, OUT * scene.style.label))
        ends = low, low + 1j * rod.stroke
    else:
        up = up_at(solved, division.top)
        out = up * (-1j * sense) * (0.5 * scene.drawn(R))
        ends = on_circle(rod.x, r_0, up), scene.mm(f"{PROFILE}.B{division.top}")
    linear(canvas, ends, out, scene.words.symbol("h"), "h")
    return [left] if left else []


def _central(scene: CamScene) -> str:
    """Return the ending of the key of a sentence that is another one where the follower's line has no offset."""
    return "" if is_aside(scene) else "_central"


ROLLER_FIGURE = Figure(
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


def rocker_view(scene: CamScene) -> View:
    """Draw the cam as it stands when the rocker is lowest."""
    solved, canvas = scene.solved, ROCKER_FIGURE.canvas(scene)
    cam = needed(solved.rocker)
    r_0, label = scene.drawn(cam.sizes.r_0), scene.style.label
    pivot, start = scene.mm(f"{PROFILE}.A0"), scene.mm(f"{PROFILE}.B0")
    far = max(abs(scene.mm(f"{PROFILE}.B{i}")) for i in solved.layout.division.lines) + scene.drawn(cam.profile.R)
    outer = max(abs(pivot), far)
    turned = swept(1j, start)
    inversion.centre(canvas, scene, r_0, far + 3.0, turned)
    canvas.part("pivots")
    canvas.add(inversion.circle(r_0, "r_0"), inversion.circle(abs(pivot), "l_OC"))
    _rocker_positions(canvas, scene)
    inversion.curves(canvas, scene, cam.profile)
    canvas.part("pivots")
    _rocker_numbers(canvas, scene, outer + NUMBERS * label)
    reach = outer + (PHASES + 1.0) * label
    inversion.phases(canvas, scene, pivot, reach)
    inversion.sharpest(canvas, scene)
    _rocker_normal(canvas, scene, pressed(solved, SHOWN))
    canvas.part("follower")
    _rocker_follower(canvas, scene)
    left = _rocker_sizes(canvas, scene, dwelling(solved) + turned)
    inversion.letter_centre(canvas, scene, r_0, turned)
    edge = reach + 1.2 * label
    canvas.bounds = -edge, -edge, edge, edge
    notes = "; ".join([*_rocker_lettered(scene), *left]), *inversion.undercut_notes(scene, cam.profile)
    return canvas.finish("profile", scene.heading("heading.cam_rocker_profile", PROFILE), notes)


def _rocker_positions(canvas: Canvas, scene: CamScene) -> None:
    """Draw the pivot, the roller's arc about it, and the roller in each position."""
    solved = scene.solved
    cam = needed(solved.rocker)
    l, R, swing = scene.drawn(cam.sizes.l), scene.drawn(cam.profile.R), cam.rocker.motion.h
    over = OVER / l
    for i, phi in enumerate(solved.angles.tolist()):
        pivot, at = (scene.mm(f"{PROFILE}.{letter}{i}") for letter in "AB")
        low = -solved.cam.sense * phi
        canvas.part("pitch")
        canvas.add(Arc(pivot, l, low - over, swing + 2.0 * over, Pen.THIN, role="arc", name=str(i)))
        if i:
            canvas.part("profile")
            canvas.add(Group((Circle(at, R, Pen.THIN),), "roller", str(i)))
            canvas.part("pivots")
            canvas.add(scene.node(pivot, f"A{i}"))
        canvas.part("pitch")
        canvas.add(scene.node(at, f"B{i}"))


def _rocker_numbers(canvas: Canvas, scene: CamScene, radius: float) -> None:
    """Write the number of each position beyond its pivot, with a tick from the pivot towards it."""
    for i in scene.solved.layout.division.lines:
        pivot = scene.mm(f"{PROFILE}.A{i}")
        tick = pivot, unit(pivot) * (radius - 0.9 * scene.style.label)
        canvas.add(Line(*tick, Pen.THIN, role="position", name=str(i)))
        inversion.number(canvas, unit(pivot) * radius, i)


def _rocker_normal(canvas: Canvas, scene: CamScene, i: int) -> None:
    """Draw the rocker of one position, and its normal through the instant centre on the line of both pivots."""
    pivot, at, touch = (scene.mm(f"{PROFILE}.{letter}{i}") for letter in "ABK")
    pole = pivot * pole_share(scene.solved, i)
    canvas.part("normal")
    canvas.add(Group((Line(pivot, at, Pen.THIN),), "rocker", str(i)))
    inversion.normal(canvas, scene, inversion.Contact(i, at, touch, pole, 1j * unit(at - pivot)))


def _rocker_follower(canvas: Canvas, scene: CamScene) -> None:
    """Draw the rocker on its pivot with the roller in position 0."""
    pivot, at = (scene.mm(f"{PROFILE}.{letter}0") for letter in "AB")
    cam, style = needed(scene.solved.rocker), scene.style
    along = unit(at - pivot)
    canvas.add(Group((Circle(at, scene.drawn(cam.profile.R), Pen.MAIN),), "roller", "0"))
    canvas.add(Group((Line(pivot + along * style.pair, at - along * style.pair, Pen.MAIN),), "rocker", "0"))
    canvas.add(fixed_pivot(pivot, "A0", style), revolute(at, "B0", style))
    canvas.label("C", pivot, prefer=1 - 1j, clear=style.pair + 0.5)
    canvas.label("B", at, prefer=1 + 1j, clear=style.pair + 0.5)


def _rocker_sizes(canvas: Canvas, scene: CamScene, quiet: float) -> list[str]:
    """Dimension r_0, l_OC, the rocker, its swing, and the roller; return what has no place in the figure.

    `quiet` is the middle of the lower dwell.
    """
    solved, words = scene.solved, scene.words
    sizes, R = needed(solved.rocker).sizes, needed(solved.rocker).profile.R
    r_0, far = scene.drawn(sizes.r_0), scene.drawn(sizes.l_OC)
    canvas.part("pivots")
    free, beside = (0.0, scene.drawn(sizes.r_0 - R), r_0), quiet + ASIDE * solved.cam.sense
    left = [
        inversion.radius_at(canvas, scene, ("r_0", sizes.r_0), quiet, free),
        inversion.radius_at(canvas, scene, ("l_OC", sizes.l_OC), beside, (r_0, far, far)),
    ]
    canvas.part("profile")
    inversion.roller_radius(canvas, scene, R)
    canvas.part("pitch")
    top = solved.layout.division.top
    pivot = scene.mm(f"{PROFILE}.A{top}")
    low = -solved.cam.sense * float(solved.angles[top])
    rays = polar(scene.drawn(sizes.l), low), scene.mm(f"{PROFILE}.B{top}") - pivot
    for ray in rays:
        canvas.add(Line(pivot, pivot + ray, Pen.THIN, role="rocker", name=str(top)))
    angle(canvas, pivot, rays, 0.4 * abs(rays[0]), "psi", words.symbol("psi"), clear=0.8)
    zero, start = scene.mm(f"{PROFILE}.A0"), scene.mm(f"{PROFILE}.B0")
    canvas.part("follower")
    canvas.label(words.symbol("l_rocker"), (zero, start), prefer=1j, clear=0.8, height=scene.style.text)
    return [text for text in left if text]


def _rocker_lettered(scene: CamScene) -> list[str]:
    """Return the numbers of what has only a letter in the figure."""
    cam = needed(scene.solved.rocker)
    lengths = {"l_rocker": cam.sizes.l, "R_roller": cam.profile.R, "rho_min": cam.profile.rho_min}
    texts = [scene.dimension(name, size) for name, size in lengths.items() if math.isfinite(size)]
    return [*texts, scene.angle("psi", cam.rocker.motion.h)]


ROCKER_FIGURE = Figure(
    PROFILE,
    rocker_view,
    ("mu_l",),
    (
        Stage("shaft", "profile.O"),
        Stage("pivots", "profile.A#"),
        Stage("pitch", "profile.B#"),
        Stage("normal", "profile.D#"),
        Stage("profile", "profile.K#"),
        Stage("sharpest", when=is_sharp),
        Stage("follower"),
    ),
    "cam.rocker_profile",
)


def plate_view(scene: CamScene) -> View:
    """Draw the cam as it stands when the follower is lowest."""
    solved, canvas = scene.solved, PLATE_FIGURE.canvas(scene)
    plate = needed(solved.plate)
    r_0, stroke, R = map(scene.drawn, (plate.sizes.r_0, solved.motion.h, plate.sizes.R_plate))
    label = scene.style.label
    outer = max(abs(end) for i in solved.layout.division.lines for end in _plate(scene, i, R))
    reach, edge = outer + NUMBERS * label, outer + (PHASES + 1.2) * label
    rod = Rod(0.0, r_0 + THICK * label, edge, stroke, scene.style)
    inversion.centre(canvas, scene, r_0, rod.top + 6.0)
    canvas.part("circles")
    canvas.add(inversion.circle(r_0, "r_0_flat"))
    _plate_positions(canvas, scene, R, reach - 0.9 * label)
    canvas.part("profile")
    outline = scene.curve(plate.profile.outline().tolist())
    canvas.add(Group((Polyline(outline, Pen.MAIN, closed=True),), "curve", "practical"))
    inversion.corners(canvas, scene, plate.profile.undercuts)
    canvas.part("circles")
    inversion.numbers(canvas, scene, 0.0, reach)
    inversion.phases(canvas, scene, 1j, outer + PHASES * label)
    canvas.part("follower")
    low = rod.low - THICK * label
    plate_box = (complex(-R, low), complex(R, low), complex(R, rod.low), complex(-R, rod.low))
    canvas.add(Group((Polyline(plate_box, Pen.MAIN, closed=True, fill="white"),), "plate", "0"), *rod.shapes())
    left = _plate_sizes(canvas, scene, rod, R)
    notes = "; ".join([*left, *_plate_lettered(scene)]), *inversion.undercut_notes(scene, plate.profile)
    inversion.letter_centre(canvas, scene, r_0)
    canvas.bounds = -edge, -edge, edge, rod.top + 16.0
    return canvas.finish("plate_profile", scene.heading("heading.cam_plate_profile", PLATE_PROFILE), notes)


def _plate_positions(canvas: Canvas, scene: CamScene, R: float, reach: float) -> None:
    """Draw the axis and the plate of each position, its centre, and where it touches the profile."""
    solved = scene.solved
    for i in solved.layout.division.lines:
        up = up_at(solved, i)
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
    at, up = scene.mm(f"{PLATE_PROFILE}.B{i}"), up_at(scene.solved, i)
    return at + 1j * up * R, at - 1j * up * R


def _plate_sizes(canvas: Canvas, scene: CamScene, rod: Rod, R: float) -> list[str]:
    """Dimension radii, the plate, how far to both sides it touches, the stroke; return what has no place there."""
    solved, words, sense = scene.solved, scene.words, scene.solved.cam.sense
    plate, motion = needed(solved.plate), solved.motion
    r_0 = scene.drawn(plate.sizes.r_0)
    canvas.part("circles")
    flat = ("r_0_flat", plate.sizes.r_0)
    left_out = inversion.radius_at(canvas, scene, flat, inversion.quiet(scene), (0.0, r_0, r_0))
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
    axis = up_at(solved, top)
    ends = axis * r_0, scene.mm(f"{PLATE_PROFILE}.B{top}")
    linear(canvas, ends, axis * (-1j * sense) * 4.0, words.symbol("h"), "h")
    return [left_out] if left_out else []


def _over(canvas: Canvas, ends: tuple[complex, complex], out: complex, text: str, name: str) -> None:
    """Dimension a level distance on a line moved upwards by `out`, the text on the line."""
    height = canvas.style.text
    over = Text(0.5 * (ends[0] + ends[1]) + out + 0.5j * height, text, height, "middle", role="label")
    narrow = abs(ends[1] - ends[0]) < lay_out(text, height).width + 1.0
    x0, y0, x1, y1 = extent((over,))
    ways = ((line.a, line.b - line.a) for line in canvas.shapes if isinstance(line, Line))  # of a plate or an axis
    points = (a + way * (k / STEPS) for a, way in ways for k in range(STEPS + 1))
    taken = narrow or any(x0 < point.real < x1 and y0 < point.imag < y1 for point in points)
    linear(canvas, ends, out, text if taken else "", name)
    if not taken:
        canvas.add(over)


def _plate_lettered(scene: CamScene) -> list[str]:
    """Return the numbers of what has only a letter in the figure."""
    motion, plate = scene.solved.motion, needed(scene.solved.plate)
    lengths = [scene.dimension("h", motion.h), scene.dimension("R_plate", plate.sizes.R_plate)]
    texts = dict.fromkeys(scene.length(motion.maximum(0.0, way, 0.0).value) for way in (1.0, -1.0))
    return [*lengths, f"{ANALOGUE} = |{scene.words.symbol('ds')}|_{{max}} = {', '.join(texts)}"]


PLATE_FIGURE = Figure(
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

FIGURES = {"roller": ROLLER_FIGURE, "rocker": ROCKER_FIGURE, "plate": PLATE_FIGURE}
