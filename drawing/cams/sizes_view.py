"""The plan of S over ds/dphi: limit tangents, the permitted places of the cam's centre, the one chosen."""

from __future__ import annotations

import cmath
import math

import numpy as np

from ...plans.cams.followers import RollerCam
from ...plans.cams.half_planes import HalfPlane
from ...plans.cams.motion import FALL, RISE
from ...plans.cams.size_plans import SIZES, is_back, phase_of
from ...plans.cams.sizes import wedge
from ..dimensions import linear
from ..figure import Figure, Stage
from ..shapes import Circle, Group, Head, Line, Pen, Polyline
from ..symbols import angle_dimension, turning_arrow
from ..view import Canvas, View
from .fan import small
from .hatching import hatched
from .offsets import permitted_offsets
from .pressing import pressed
from .scene import COARSE, CamScene, given, pieces
from .transfer import transfer

PAST = 8.0  # mm by which an axis runs past the curve
BELOW = 30.0  # mm of the permitted places shown below the lowest one
SHOWN = 0.6  # part of the greatest pressure angle: a ray clear of its limit, and of the vertical
ARC = 4.0  # radius of the arc of an angle in heights of letters
LINE = 18.0  # mm by which a limit runs past the place where it touches


def sizes_view(scene: CamScene) -> View:
    """Draw the diagram, with the centre of the cam that is built."""
    solved, words = scene.solved, scene.words
    roller = solved.roller
    assert roller is not None
    canvas = FIGURE.canvas(scene, COARSE)
    mu = scene.scale(SIZES).mu
    centre = complex(roller.sizes.e, -roller.sizes.s_0) * (1.0 / mu)
    canvas.part("points")
    outline = _curve(canvas, scene)
    canvas.part("axes")
    _axes(canvas, scene, outline, centre)
    planes = wedge(solved.motion, roller.limits, solved.cam.sense)
    low = min(centre.imag, _apex(roller, mu).imag) - BELOW
    for plane in planes:
        canvas.part(f"tangent_{plane.name}")
        _limit(canvas, scene, plane, low)
    canvas.part("permitted")
    _permitted(canvas, planes, mu, centre, low)
    canvas.part("centre")
    permitted_offsets(canvas, scene, mu)
    canvas.part("points")
    _nodes(canvas, scene)
    canvas.part("centre")
    aslant = _centre(canvas, scene, roller, centre)
    notes = (*transfer(scene, SIZES), f"{words['said.cam_permitted']};  {aslant}")
    return canvas.finish("sizes", (words["heading.cam_sizes"], scene.factor(scene.scale(SIZES))), notes)


def _curve(canvas: Canvas, scene: CamScene) -> list[complex]:
    """Draw the exact curve by phases, a line across where the velocity jumps; return its points."""
    solved, mu = scene.solved, scene.scale(SIZES).mu
    every: list[complex] = [0j]
    for phase in (solved.motion.rise, solved.motion.fall):
        points: list[complex] = []
        for _, s, ds, _ in pieces(solved, phase):
            points += [complex(x, y) for x, y in zip(solved.cam.sense * ds / mu, s / mu, strict=True)]
        canvas.add(Group((Polyline(tuple(points), Pen.MAIN),), "curve", phase.name))
        every += points
    return every


def _axes(canvas: Canvas, scene: CamScene, outline: list[complex], centre: complex) -> None:
    left, right = (end(p.real for p in outline) for end in (min, max))
    top = max(p.imag for p in outline) + PAST
    for a, b in ((complex(left - PAST, 0.0), complex(right + PAST, 0.0)), (1j * (centre.imag - 2 * PAST), 1j * top)):
        canvas.add(Line(a, b, Pen.THIN, role="axis"), Head(b, b - a))
    canvas.label(scene.words.symbol("s"), 1j * top, prefer=1 + 0j, clear=1.2)
    canvas.label(scene.words.symbol("ds"), complex(right + PAST, 0.0), prefer=-1j, clear=1.2)


def _apex(roller: RollerCam, mu: float) -> complex:
    return complex(roller.by_tangents.e, -roller.by_tangents.s_0) * (1.0 / mu)


def _limit(canvas: Canvas, scene: CamScene, plane: HalfPlane, low: float) -> None:
    """Draw a limit from above the point where it touches the curve down to `low`, with its angle to the axis."""
    solved, words, mu = scene.solved, scene.words, scene.scale(SIZES).mu
    s, ds, _ = _at_touch(scene, plane)
    touch = complex(solved.cam.sense * ds, s) * (1.0 / mu)
    up = plane.normal.conjugate() * 1j  # along the line, upwards: a mirror image turns e + i s_0 down
    up = up if up.imag > 0.0 else -up
    foot = touch - up * ((touch.imag - low) / up.imag)
    canvas.add(Line(touch + up * LINE, foot, Pen.THIN, role="limit", name=plane.name))
    canvas.add(Group((Circle(touch, scene.style.node, Pen.THIN, fill="black"),), "touch", plane.name))
    if is_back(plane.name) and scene.solved.roller and plane.name not in scene.solved.roller.sizes.on:
        return
    axis = touch - up * (touch.imag / up.imag)
    gamma = math.atan2(up.imag, abs(up.real))
    outwards = math.copysign(1.0, up.real) if up.real else 1.0
    start = math.pi if outwards > 0.0 else 0.0  # below the axis, on the side of the ordinates
    radius = ARC * scene.style.label
    canvas.add(angle_dimension(axis, radius, start, outwards * gamma, f"gamma_{plane.name}", scene.style))
    middle = axis + cmath.rect(radius, start + outwards * gamma / 2)
    text = f"{words.symbol(f'gamma_{phase_of(plane.name)}')} = {scene.degrees(gamma)}"
    canvas.label(text, middle, prefer=middle - axis, clear=1.0, height=scene.style.text)


def _at_touch(scene: CamScene, plane: HalfPlane) -> tuple[float, float, float]:
    """Return s, s', s'' where a limit touches the curve: at a jump the side that reaches farther."""
    motion, sense = scene.solved.motion, scene.solved.cam.sense
    found = [[float(v) for v in motion.at(np.array(plane.phi), side)] for side in (1, -1)]
    s, ds, d2s = min(found, key=lambda at: plane.normal.real * sense * -at[1] + plane.normal.imag * at[0])
    return s, ds, d2s


def _permitted(canvas: Canvas, planes: tuple[HalfPlane, ...], mu: float, centre: complex, low: float) -> None:
    """Hatch the permitted places of the cam's centre, beside the chosen one."""
    sides = [(plane.normal.conjugate(), plane.least / mu) for plane in planes]
    reach = 2.5 * BELOW
    canvas.add(hatched(sides, (centre.real - reach, low, centre.real + reach, 0.0), 2.5, "centre"))


def _nodes(canvas: Canvas, scene: CamScene) -> None:
    """Mark and number the points that the diagrams give on the section lines; numbers in one place stand together."""
    shared: dict[complex, list[str]] = {}
    out: dict[complex, complex] = {}
    for i, phase in on_lines(scene):
        at = scene.mm(f"{SIZES}.{i}_{phase}")
        canvas.add(Group((Circle(at, scene.style.node, Pen.THIN, fill="white"),), "node", f"{i}_{phase}"))
        key = next((other for other in shared if abs(other - at) < 2.5 * scene.style.node), at)
        shared.setdefault(key, []).append(str(i))
        out[key] = out.get(key, 0j) + _outwards(scene, i, phase)
    for at, numbers in shared.items():
        text = ", ".join(dict.fromkeys(numbers))
        canvas.label(text, at, prefer=out[at] or 1j * at.imag, clear=0.8, height=small(scene.style.text))


def _outwards(scene: CamScene, i: int, phase: str) -> complex:
    """Return the normal of the curve on a section line, out of its loop; where it turns, the mean of both."""
    solved, division = scene.solved, scene.solved.layout.division
    lines = division.rise if phase == RISE else division.fall
    sides = (1,) if i == lines[0] else (-1,) if i == lines[-1] else (1, -1)
    found = 0j
    for side in sides:
        s, ds, d2s = (float(v) for v in solved.motion.at(float(solved.angles[i]), side))
        along = complex(solved.cam.sense * d2s, ds)
        found += (
            -1j * solved.cam.sense * along / abs(along) if along else 1j * math.copysign(1.0, s - 0.5 * solved.motion.h)
        )
    return found


def _centre(canvas: Canvas, scene: CamScene, roller: RollerCam, centre: complex) -> str:
    """Mark the chosen centre, dimension r_0 and e, draw a ray, the sense of the cam; return the ray's angle."""
    solved, words, style = scene.solved, scene.words, scene.style
    r_0 = f"{words.symbol('r_0')} = {scene.length(roller.sizes.r_0)}"
    unit = centre / abs(centre)
    canvas.add(Group((Line(centre, 0j, Pen.THIN), Head(0j, -unit), Head(centre, unit)), "dimension", "r_0"))
    canvas.label(r_0, (centre, 0j), prefer=-1.0, clear=0.8, height=style.text)
    across = complex(0.0, centre.imag)
    text = f"{words.symbol('e')} = {scene.length(abs(roller.sizes.e))}"
    linear(canvas, (across, centre), -1j * (BELOW + 8.0), text, "e")
    canvas.add(Group((Circle(centre, style.node * 1.5, Pen.MAIN, fill="white"),), "point", "O"))
    canvas.label("O", centre, prefer=-1 + 0j, clear=1.0)
    sense = solved.cam.sense
    canvas.add(turning_arrow(centre, 2.4 * style.label, 0.0, 1.4, float(sense), "omega"))
    canvas.label(words.symbol("omega"), centre + 2.4 * style.label, prefer=1 + 0j, clear=1.0)
    canvas.part("pressure")
    i = pressed(scene, SHOWN)
    s, ds, _ = (float(v) for v in solved.motion.at(solved.angles[i]))
    at = complex(sense * ds, s) * (1.0 / scene.scale(SIZES).mu)
    canvas.add(Line(centre, at, Pen.DASHED, role="ray", name=str(i)))
    radius, angle = 0.55 * abs(centre), cmath.phase(at - centre)
    canvas.add(Line(centre, centre + 1.12j * radius, Pen.AXIS, role="axis"))
    canvas.add(angle_dimension(centre, radius, math.pi / 2, angle - math.pi / 2, "theta", style))
    text = f"{words.symbol('theta')}_{{{i}}}"
    middle = centre + cmath.rect(radius, (angle + math.pi / 2) / 2)
    canvas.label(text, middle, prefer=middle - centre, clear=1.0, height=style.text)
    return f"{text} = {scene.degrees(math.pi / 2 - angle)}"


def on_lines(scene: CamScene) -> list[tuple[int, str]]:
    """Return the section lines of rise and fall, each with the name of its phase."""
    division = scene.solved.layout.division
    return [*((i, RISE) for i in division.rise), *((i, FALL) for i in division.fall)]


FIGURE = Figure(
    SIZES,
    sizes_view,
    ("mu_s_ds", "reduction"),
    (
        Stage("axes", "sizes.#"),
        Stage("points", "sizes.#_rise"),
        *(Stage(f"tangent_{limit}", f"sizes.T_{limit}") for limit in ("rise", "fall", "rise_back", "fall_back")),
        Stage("permitted", "sizes.A"),
        Stage("centre", "sizes.C", variant=given("r_0", "e")),
        Stage("pressure"),
    ),
    "cam.sizes",
)
