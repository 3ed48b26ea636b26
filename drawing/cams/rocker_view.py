"""The plan of a cam with a rocker by inversion: its pivot goes round the cam, the roller's centre gives the curves."""

from __future__ import annotations

import math

from ...plans.cams.construction import PROFILE
from ...plans.cams.course import dwelling, pole_share, pressed
from ..dimensions import angle
from ..figure import Figure, Stage
from ..shapes import Arc, Circle, Group, Line, Pen, Text
from ..symbols import fixed_pivot, polar, revolute, swept, unit
from ..view import Canvas, View
from .inversion import (
    Contact,
    centre,
    circle,
    curves,
    letter_centre,
    normal,
    phases,
    radius_at,
    roller_radius,
    sharpest,
    undercut_notes,
)
from .roller_view import NUMBERS, PHASES
from .scene import CamScene, is_sharp, needed
from .sizes_view import SHOWN

ASIDE = 0.45  # rad between the rays of two radii
OVER = 4.0  # mm of the roller's arcs beyond its extreme places


def rocker_view(scene: CamScene) -> View:
    """Draw the cam as it stands when the rocker is lowest."""
    solved, canvas = scene.solved, FIGURE.canvas(scene)
    cam = needed(solved.rocker)
    r_0, label = scene.drawn(cam.sizes.r_0), scene.style.label
    pivot, start = scene.mm(f"{PROFILE}.A0"), scene.mm(f"{PROFILE}.B0")
    far = max(abs(scene.mm(f"{PROFILE}.B{i}")) for i in solved.layout.division.lines) + scene.drawn(cam.profile.R)
    outer = max(abs(pivot), far)
    turned = swept(1j, start)
    canvas.part("shaft")
    centre(canvas, scene, r_0, far + 3.0, turned)
    canvas.part("pivots")
    canvas.add(circle(r_0, "r_0"), circle(abs(pivot), "l_OC"))
    _positions(canvas, scene)
    curves(canvas, scene, cam.profile)
    canvas.part("pivots")
    _numbers(canvas, scene, outer + NUMBERS * label)
    reach = outer + (PHASES + 1.0) * label
    phases(canvas, scene, pivot, reach)
    canvas.part("sharpest")
    sharpest(canvas, scene)
    line = pressed(solved, SHOWN)
    _normal(canvas, scene, line)
    canvas.part("follower")
    _follower(canvas, scene)
    left = _sizes(canvas, scene, dwelling(solved.motion, solved.cam.sense) + turned)
    canvas.part("shaft")
    letter_centre(canvas, scene, r_0, turned)
    edge = reach + 1.2 * label
    canvas.bounds = -edge, -edge, edge, edge
    scale = f"{scene.words.drawn_at(scene.mu_l)};  {scene.factor(scene.scale(PROFILE))}"
    notes = "; ".join([*_lettered(scene), *left]), *undercut_notes(scene, cam.profile.undercuts, rocks=True)
    return canvas.finish("profile", (scene.words["heading.cam_rocker_profile"], scale), notes)


def _positions(canvas: Canvas, scene: CamScene) -> None:
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


def _numbers(canvas: Canvas, scene: CamScene, radius: float) -> None:
    """Write the number of each position beyond its pivot, with a tick from the pivot towards it."""
    height = scene.style.text
    for i in scene.solved.layout.division.lines:
        pivot = scene.mm(f"{PROFILE}.A{i}")
        out = unit(pivot)
        canvas.add(Line(pivot, out * (radius - 0.9 * scene.style.label), Pen.THIN, role="position", name=str(i)))
        canvas.add(Text(out * radius - 0.5j * height, str(i), height, "middle", role="position", name=str(i)))


def _normal(canvas: Canvas, scene: CamScene, i: int) -> None:
    """Draw the rocker of one position, and its normal through the instant centre on the line of both pivots."""
    pivot, at, touch = (scene.mm(f"{PROFILE}.{letter}{i}") for letter in "ABK")
    pole = pivot * pole_share(scene.solved, i)
    canvas.part("normal")
    canvas.add(Group((Line(pivot, at, Pen.THIN),), "rocker", str(i)))
    normal(canvas, scene, Contact(i, at, touch, pole, 1j * unit(at - pivot)))


def _follower(canvas: Canvas, scene: CamScene) -> None:
    """Draw the rocker on its pivot with the roller in position 0."""
    pivot, at = (scene.mm(f"{PROFILE}.{letter}0") for letter in "AB")
    cam, style = needed(scene.solved.rocker), scene.style
    along = unit(at - pivot)
    canvas.add(Group((Circle(at, scene.drawn(cam.profile.R), Pen.MAIN),), "roller", "0"))
    canvas.add(Group((Line(pivot + along * style.pair, at - along * style.pair, Pen.MAIN),), "rocker", "0"))
    canvas.add(fixed_pivot(pivot, "A0", style), revolute(at, "B0", style))
    canvas.label("C", pivot, prefer=1 - 1j, clear=style.pair + 0.5)
    canvas.label("B", at, prefer=1 + 1j, clear=style.pair + 0.5)


def _sizes(canvas: Canvas, scene: CamScene, quiet: float) -> list[str]:
    """Dimension r_0, l_OC, the rocker, its swing, and the roller; return what has no place in the figure.

    `quiet` is the middle of the lower dwell.
    """
    solved, words = scene.solved, scene.words
    cam, division = needed(solved.rocker), solved.layout.division
    sizes, R = cam.sizes, cam.profile.R
    r_0, far = scene.drawn(sizes.r_0), scene.drawn(sizes.l_OC)
    canvas.part("pivots")
    left = [radius_at(canvas, scene, "r_0", sizes.r_0, quiet, (0.0, scene.drawn(sizes.r_0 - R), r_0))]
    left += [radius_at(canvas, scene, "l_OC", sizes.l_OC, quiet + ASIDE * solved.cam.sense, (r_0, far, far))]
    canvas.part("profile")
    roller_radius(canvas, scene, [scene.mm(f"{PROFILE}.B{i}") for i in division.lines], R)
    canvas.part("pitch")
    top = division.top
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


def _lettered(scene: CamScene) -> list[str]:
    """Return the numbers of what has only a letter in the figure."""
    cam, words = needed(scene.solved.rocker), scene.words
    lengths = {"l_rocker": cam.sizes.l, "R_roller": cam.profile.R, "rho_min": cam.profile.rho_min}
    said = [f"{words.symbol(n)} = {scene.length(size)}" for n, size in lengths.items() if math.isfinite(size)]
    return [*said, f"{words.symbol('psi')} = {scene.degrees(cam.rocker.motion.h)}"]


FIGURE = Figure(
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
