"""The plan of a cam with a roller by inversion: pitch curve, roller in all positions, practical profile, follower."""

from __future__ import annotations

import cmath
import math

import numpy as np

from ...plans.cams.inversion import PROFILE
from ..dimensions import linear
from ..shapes import Circle, Group, Head, Line, Pen, Polyline
from ..symbols import angle_dimension, revolute
from ..view import Canvas, View
from .hardware import Rod
from .inversion import centre, dwelling, heading, numbers, on_circle, phases, radius_at, unit_at
from .scene import CamScene
from .sizes_view import SHOWN, pressed

NUMBERS, PHASES = 1.4, 2.5  # heights of letters from the outermost roller to the numbers, and to the arcs of the phases


def roller_view(scene: CamScene) -> View:
    """Draw the cam as it stands when the follower is lowest."""
    solved, canvas, mu = scene.solved, Canvas(scene.style), scene.mu_l
    roller = solved.roller
    assert roller is not None
    e, s_0, stroke = roller.sizes.e / mu, roller.sizes.s_0 / mu, solved.motion.h / mu
    R = roller.profile.R / mu
    outer = math.hypot(e, s_0 + stroke) + R
    label = scene.style.label
    rod = Rod(e, s_0, outer + (PHASES + 1.5) * label, stroke, scene.style)
    reach = outer + NUMBERS * label
    centre(canvas, scene, roller.sizes.r_0 / mu, rod.top + 12.0)
    canvas.add(Circle(0j, roller.sizes.r_0 / mu, Pen.THIN, role="circle", name="r_0"))
    if abs(e) > 0.05:
        canvas.add(Circle(0j, abs(e), Pen.THIN, role="circle", name="e"))
    _positions(canvas, scene, e, reach - 0.9 * label)
    _curves(canvas, scene)
    numbers(canvas, scene, e, reach)
    phases(canvas, scene, e, outer + PHASES * label)
    _sharpest(canvas, scene)
    _normal(canvas, scene, pressed(scene, SHOWN))
    _follower(canvas, scene, rod, R)
    _sizes(canvas, scene, rod)
    edge = outer + (PHASES + 1.2) * label
    canvas.bounds = -edge, -edge, edge, rod.top + 16.0
    return canvas.finish("profile", heading(scene, "heading.cam_profile", PROFILE), _notes(scene))


def _positions(canvas: Canvas, scene: CamScene, e: float, reach: float) -> None:
    """Draw the follower's line and the roller in each position; the line touches the circle of the offset."""
    solved, R = scene.solved, scene.solved.values["R_roller"] / scene.mu_l
    for i, phi in enumerate(solved.angles.tolist()):
        up = unit_at(phi, solved.cam.sense)
        foot, at = scene.mm(f"{PROFILE}.E{i}"), scene.mm(f"{PROFILE}.B{i}")
        canvas.add(Line(foot, on_circle(e, reach, up, solved.cam.sense), Pen.THIN, role="position", name=str(i)))
        if i:
            canvas.add(Circle(at, R, Pen.THIN, role="roller", name=str(i)))
        canvas.add(Group((Circle(at, scene.style.node, Pen.THIN, fill="white"),), "node", str(i)))


def _curves(canvas: Canvas, scene: CamScene) -> None:
    """Draw the pitch curve dash-dot and the practical profile in main lines."""
    roller, mu = scene.solved.roller, scene.mu_l
    assert roller is not None
    pitch = roller.profile.pitch(scene.solved.motion.samples()[:-1]) * (1.0 / mu)
    outline = roller.profile.outline() * (1.0 / mu)
    for points, pen, name in ((pitch, Pen.AXIS, "pitch"), (outline, Pen.MAIN, "practical")):
        canvas.add(Group((Polyline(tuple(points.tolist()), pen, closed=True),), "curve", name))


def _sharpest(canvas: Canvas, scene: CamScene) -> None:
    """Mark the place of the least radius of curvature of the pitch curve, and the radius."""
    roller, mu = scene.solved.roller, scene.mu_l
    assert roller is not None
    profile = roller.profile
    found = profile.sharpest
    if not 0.0 < found.value < math.inf:
        return
    at = [complex(profile.pitch(found.phi, side)) * (1.0 / mu) for side in (1, -1)]
    kappa = [float(profile.curvature(found.phi, side)) for side in (1, -1)]
    side = 1 if kappa[0] >= kappa[1] else -1
    place, normal = at[0], complex(profile.normal(found.phi, side))
    core = place - normal * (found.value / mu)
    canvas.add(Group((Line(core, place, Pen.THIN), Head(place, normal)), "dimension", "rho_min"))
    size = 0.8 * scene.style.arrow / 2
    cross = (Line(core - size * d, core + size * d, Pen.THIN) for d in (1 + 0j, 1j))
    canvas.add(Group(tuple(cross), "point", "curvature"))
    canvas.add(Group((Circle(place, scene.style.node, Pen.MAIN, fill="black"),), "sharpest", "rho_min"))
    text = f"{scene.words.symbol('rho_min')} = {scene.length(found.value)}"
    canvas.label(text, (core, place), prefer=normal * 1j, clear=0.8, height=scene.style.text, spare=text)


def _normal(canvas: Canvas, scene: CamScene, i: int) -> None:
    """Draw the normal of one position with the point of contact, the pressure and the transmission angle."""
    solved, words, style = scene.solved, scene.words, scene.style
    pole, at, contact = (scene.mm(f"{PROFILE}.{letter}{i}") for letter in "PBK")
    up = unit_at(float(solved.angles[i]), solved.cam.sense)
    out = (at - pole) / abs(at - pole)
    reach = 7.0 * style.label
    canvas.add(Line(pole, at + out * (reach + 6.0), Pen.THIN, role="normal", name=str(i)))
    canvas.add(Line(at - 1j * up * reach, at + 1j * up * reach, Pen.THIN, role="transverse", name=str(i)))
    canvas.add(Line(0j, pole, Pen.THIN, role="transverse", name=f"P{i}"))
    for mark, place in (("K", contact), ("P", pole)):
        canvas.add(Group((Circle(place, style.node, Pen.MAIN, fill="white"),), "point", f"{mark}{i}"))
        canvas.label(f"{mark}_{{{i}}}", place, prefer=place * 1j, clear=0.8, height=style.text)
    theta = cmath.phase(up / out)
    across = up * -1j if theta > 0.0 else up * 1j
    for name, a, b, radius in (("theta", out, up, reach), ("gamma", out, across, 0.5 * reach)):
        sweep = cmath.phase(b / a)
        if abs(sweep) < 1e-6:
            continue
        canvas.add(angle_dimension(at, radius, cmath.phase(a), sweep, f"{name}_{i}", style))
        middle = at + cmath.rect(radius, cmath.phase(a) + sweep / 2)
        text = f"{words.symbol(name)}_{{{i}}} = {scene.degrees(abs(sweep))}"
        canvas.label(text, middle, prefer=middle - at, clear=1.0, height=style.text, spare=text)


def _follower(canvas: Canvas, scene: CamScene, rod: Rod, R: float) -> None:
    """Draw the roller and its rod in position 0, guided and pressed down by a spring."""
    at = complex(rod.x, rod.low)
    canvas.add(Group((Circle(at, R, Pen.MAIN),), "roller", "0"))
    canvas.add(*rod.shapes())
    canvas.add(revolute(at, "B0", scene.style))


def _sizes(canvas: Canvas, scene: CamScene, rod: Rod) -> None:
    """Dimension r_0, e, the roller and the stroke."""
    solved, words, mu, style = scene.solved, scene.words, scene.mu_l, scene.style
    roller, sense = solved.roller, solved.cam.sense
    assert roller is not None
    middle = dwelling(solved.motion, sense)
    r_0 = roller.sizes.r_0
    radius_at(canvas, scene, "r_0", r_0, middle, ((r_0 - roller.profile.R) / mu, r_0 / mu))
    level = rod.top + 6.0
    ends = complex(0.0, rod.top), complex(rod.x, rod.top)
    linear(canvas, ends, 1j * (level - rod.top), f"{words.symbol('e')} = {scene.length(abs(roller.sizes.e))}", "e")
    last = solved.layout.division.last
    at, R = scene.mm(f"{PROFILE}.B{last}"), roller.profile.R / mu
    rim = at + unit_at(float(solved.angles[last]) + 0.5, sense) * R
    canvas.add(Group((Line(at, rim, Pen.THIN), Head(rim, rim - at)), "dimension", "R_roller"))
    canvas.label(
        f"{words.symbol('R_roller')} = {scene.length(roller.profile.R)}",
        rim,
        prefer=rim - at,
        clear=1.0,
        height=style.text,
    )
    top = solved.layout.division.top
    up = unit_at(float(solved.angles[top]), sense)
    low = on_circle(rod.x, roller.sizes.r_0 / mu, up, sense)
    aside = up * (-1j * sense) * 0.5 * R
    linear(
        canvas,
        (low, scene.mm(f"{PROFILE}.B{top}")),
        aside,
        f"{words.symbol('h')} = {scene.length(solved.motion.h)}",
        "h",
    )


def _notes(scene: CamScene) -> tuple[str, ...]:
    """Say where the profile does not give the motion."""
    roller = scene.solved.roller
    assert roller is not None
    return tuple(
        scene.words["said.cam_undercut"].format(
            start=scene.degrees(cut.start), end=scene.degrees(cut.end), lost=scene.length(cut.lost)
        )
        for cut in roller.profile.undercuts
        if np.isfinite(cut.lost)
    )
