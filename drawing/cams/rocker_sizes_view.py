"""The plan of a rocker in all positions: analogues of its velocity, limits, permitted places of the cam's centre."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator

import numpy as np

from ...plans.cams.followers import RockerCam
from ...plans.cams.motion import RISE
from ...plans.cams.rocker import Limit, tightest
from ...plans.cams.rocker_plans import ROCKER_SIZES
from ...plans.cams.size_plans import is_back, phase_of
from ..dimensions import linear
from ..figure import Figure, Stage
from ..shapes import Arc, Circle, Group, Head, Line, Pen, Polyline
from ..symbols import angle_dimension, fixed_pivot, turning_arrow
from ..text import Box
from ..view import Canvas, View
from .fan import small
from .hatching import Side, hatched
from .pressing import pressed, theta
from .scene import COARSE, Array, CamScene, given, pieces
from .sizes_view import SHOWN, on_lines

AROUND = 24.0  # mm of the permitted places shown about the chosen one
PAST = 8.0  # mm of the rocker's path beyond its ends
LIMIT = 3.0  # length of a limit at the end of an analogue, in heights of letters: only those that bound are drawn out


def rocker_sizes_view(scene: CamScene) -> View:
    """Draw the rocker about its pivot, and the centre of the cam that is built."""
    canvas, words, cam = FIGURE.canvas(scene, COARSE), scene.words, scene.solved.rocker
    assert cam is not None
    centre = scene.mm(f"{ROCKER_SIZES}.C")
    _rocker(canvas, scene, cam)
    frame = _frame(scene, centre)
    canvas.part("limits")
    _limits(canvas, scene)
    for limit in cam.rocker.limits(cam.limits):
        _bound(canvas, scene, limit, frame)
    _permitted(canvas, scene, cam, centre)
    _nodes(canvas, scene)
    _sizes(canvas, scene, cam, centre)
    canvas.part("pressure")
    _ray(canvas, scene, centre)
    scale = f"{scene.words.drawn_at(scene.mu_l)};  {scene.factor(scene.scale(ROCKER_SIZES))}"
    notes = (*_lettered(scene, cam), *words["said.cam_analogues"].split("|"), words["said.cam_permitted"])
    return canvas.finish(ROCKER_SIZES, (words["heading.cam_rocker_sizes"], scale), notes)


def _rocker(canvas: Canvas, scene: CamScene, cam: RockerCam) -> None:
    """Draw the rocker in all positions, the path of its roller, and the curve of the analogues' ends."""
    solved, style, l = scene.solved, scene.style, cam.sizes.l / scene.mu_l
    over = PAST / l
    canvas.part("positions")
    canvas.add(Arc(0j, l, -over, cam.rocker.motion.h + 2.0 * over, Pen.AXIS, role="path", name="B"))
    canvas.part("analogues")
    for phase in (cam.rocker.motion.rise, cam.rocker.motion.fall):
        ends: list[complex] = []
        for phi, *_ in pieces(solved, phase):
            ends += _ends(cam, phi, l)
        canvas.add(Group((Polyline(tuple(ends), Pen.MAIN),), "curve", phase.name))
    division, shown = solved.layout.division, pressed(scene, SHOWN)
    canvas.part("positions")
    for i in division.lines:
        at, end = (scene.mm(f"{ROCKER_SIZES}.{letter}{i}") for letter in "BD")
        # from the pivot only the rocker itself, its highest position, and the one that is lettered
        whole = i in (0, division.top, shown)
        near, far = (0j if whole else min(at, end, key=abs)), max(at, end, key=abs)
        pen = Pen.MAIN if i == 0 else Pen.THIN
        canvas.add(Group((Line(near, at if i == 0 else far, pen),), "position", str(i)))
    canvas.part("pivot")
    canvas.add(fixed_pivot(0j, "C", style))
    canvas.label("C", 0j, prefer=-1 + 1j, clear=style.pair + 1.0)


def _ends(cam: RockerCam, phi: Array, l: float) -> list[complex]:
    """Return the ends of the analogues, laid off along the rocker: at the last angle the limit from before."""
    rows = [cam.rocker.motion.at(phi, 1), cam.rocker.motion.at(phi[-1:], -1)]
    psi, dpsi = (np.append(rows[0][k][:-1], rows[1][k]) for k in (0, 1))
    points: list[complex] = (l * np.exp(1j * psi) * (1.0 - cam.rocker.sense * dpsi)).tolist()
    return points


def _frame(scene: CamScene, centre: complex) -> Box:
    """Return the box in which limits are drawn: from beside the centre to above the highest position."""
    ends = [scene.mm(f"{ROCKER_SIZES}.{letter}{i}") for i in scene.solved.layout.division.lines for letter in "BD"]
    right, top = max(end.real for end in ends), max(end.imag for end in ends)
    left = min(min(end.real for end in ends), centre.real - AROUND)
    return left, centre.imag - AROUND, max(right + PAST, centre.real + AROUND), top + PAST


def _limits(canvas: Canvas, scene: CamScene) -> None:
    """Draw the direction of the limit at the end of each analogue, towards the cam's centre."""
    for i, phase in on_lines(scene):
        end = _end(scene, i, phase)
        past = end + _along(scene, i, phase) * (LIMIT * scene.style.label)
        canvas.add(Line(end, past, Pen.THIN, role="limit", name=f"{i}_{phase}"))


def _end(scene: CamScene, i: int, phase: str) -> complex:
    """Return the end of the analogue on a section line: where the velocity jumps, that inside of the phase."""
    solved, division = scene.solved, scene.solved.layout.division
    first = (division.rise if phase == RISE else division.fall)[0]
    if i > first:
        return scene.mm(f"{ROCKER_SIZES}.D{i}")
    ds = float(solved.motion.at(float(solved.angles[i]))[1])
    arm = complex(solved.values[f"_arm{i}"])
    return scene.mm(f"{ROCKER_SIZES}.B{i}") - arm * (solved.cam.sense * ds / scene.mu_l)


def _along(scene: CamScene, i: int, phase: str) -> complex:
    """Return the direction of the limit on a section line, downwards."""
    cam = scene.solved.rocker
    assert cam is not None
    gamma = cam.limits.gamma_rise if phase == RISE else -cam.limits.gamma_fall
    return _down(complex(scene.solved.values[f"_arm{i}"]) * cmath.rect(1.0, -scene.solved.cam.sense * gamma))


def _down(direction: complex) -> complex:
    return direction if direction.imag < 0.0 else -direction


def _bound(canvas: Canvas, scene: CamScene, limit: Limit, frame: Box) -> None:
    """Mark the end of the analogue whose limit comes nearest to the centre, and dimension the angle permitted."""
    cam, mu = scene.solved.rocker, scene.mu_l
    assert cam is not None
    at = tightest(cam.rocker, limit, complex(cam.sizes.e, cam.sizes.s_0))
    psi, dpsi, _ = (float(v) for v in cam.rocker.motion.at(at, 1 if at < limit.phase.end else -1))
    arm = cmath.rect(1.0, psi)
    end = arm * (cam.sizes.l * (1.0 - cam.rocker.sense * dpsi) / mu)
    canvas.add(Group((Circle(end, scene.style.node, Pen.THIN, fill="black"),), "touch", limit.name))
    turned = -limit.way * cam.rocker.sense * limit.gamma
    along = _down(arm * cmath.rect(1.0, turned))
    reach = (frame[1] - end.imag) / along.imag
    canvas.add(Line(end, end + along * reach, Pen.THIN, role="bound", name=limit.name))
    if is_back(limit.name) and limit.name not in cam.sizes.on:
        return
    start = arm if (along * arm.conjugate()).real > 0.0 else -arm
    radius, sweep = 5.0 * scene.style.label, cmath.phase(along / start)
    name = f"gamma_{limit.name}"
    canvas.add(angle_dimension(end, radius, cmath.phase(start), sweep, name, scene.style))
    if start == arm:  # beyond the rocker
        canvas.add(Line(end, end + arm * (radius + 2.0), Pen.THIN, role="extension"))
    middle = end + cmath.rect(radius, cmath.phase(start) + sweep / 2)
    text = scene.words.symbol(f"gamma_{phase_of(limit.name)}")
    canvas.label(text, middle, prefer=middle - end, clear=0.8, height=scene.style.text)


def _permitted(canvas: Canvas, scene: CamScene, cam: RockerCam, centre: complex) -> None:
    """Hatch the permitted places of the cam's centre, beside the chosen one."""
    x, y = centre.real, centre.imag
    box = (x - 2.0 * AROUND, y - AROUND, x + 2.0 * AROUND, min(0.0, y + 2.0 * AROUND))
    canvas.add(hatched([*_sides(scene, cam)], box, 2.5, "centre"))


def _sides(scene: CamScene, cam: RockerCam) -> Iterator[Side]:
    """Go through the half planes in which the cam's centre may lie, the rocker's pivot being the origin."""
    mu, l, swing = scene.mu_l, cam.sizes.l, cam.rocker.motion.h
    yield -1j, 0.0  # below the rocker's lowest position, and its highest one
    yield -1j * cmath.rect(1.0, swing), 0.0
    for limit in cam.rocker.limits(cam.limits):
        for phi, *_ in pieces(scene.solved, limit.phase):
            for places, side in ((phi[:-1], 1), (phi[-1:], -1)):
                normal, least = cam.rocker.half_planes(limit, places, side)
                for n, c in zip(normal.tolist(), least.tolist(), strict=True):
                    yield -n, (c - n.real * l) / mu


def _nodes(canvas: Canvas, scene: CamScene) -> None:
    """Mark the roller's centre and the end of the analogue in every position, and number the ends."""
    shared: dict[complex, list[str]] = {}
    canvas.part("positions")
    for i in scene.solved.layout.division.lines:
        at = scene.mm(f"{ROCKER_SIZES}.B{i}")
        canvas.add(Group((Circle(at, scene.style.node, Pen.THIN, fill="white"),), "node", f"B{i}"))
    canvas.part("analogues")
    for i, phase in on_lines(scene):
        at = _end(scene, i, phase)
        canvas.add(Group((Circle(at, scene.style.node, Pen.THIN, fill="white"),), "node", f"{i}_{phase}"))
        key = next((other for other in shared if abs(other - at) < 2.5 * scene.style.node), at)
        shared.setdefault(key, []).append(str(i))
    middle, named = sum(shared) / len(shared), str(pressed(scene, SHOWN))
    canvas.part("positions")
    canvas.label(f"B_{{{named}}}", scene.mm(f"{ROCKER_SIZES}.B{named}"), prefer=1 + 0j, height=scene.style.text)
    canvas.part("analogues")
    for at, numbers in shared.items():
        text = f"D_{{{named}}}" if numbers == [named] else ", ".join(dict.fromkeys(numbers))
        height = scene.style.text if numbers == [named] else small(scene.style.text)
        canvas.label(text, at, prefer=at - middle, clear=0.8, height=height)


def _sizes(canvas: Canvas, scene: CamScene, cam: RockerCam, centre: complex) -> None:
    """Mark the chosen centre; dimension r_0, l_OC, the rocker and its swing; show the sense of the cam."""
    words, style = scene.words, scene.style
    low, high = scene.mm(f"{ROCKER_SIZES}.B0"), scene.mm(f"{ROCKER_SIZES}.B{scene.solved.layout.division.top}")
    canvas.part("centre")
    for name, end in (("r_0", low), ("l_OC", 0j)):
        unit = (end - centre) / abs(end - centre)
        canvas.add(Group((Line(centre, end, Pen.THIN), Head(end, unit), Head(centre, -unit)), "dimension", name))
        canvas.label(words.symbol(name), (centre, end), prefer=unit * 1j, clear=0.8, height=style.text)
    canvas.part("positions")
    out = 1j * high / abs(high) * 3.0 * style.label
    linear(canvas, (0j, high), out, words.symbol("l_rocker"), "l_rocker")
    radius = 0.45 * abs(low)
    canvas.add(angle_dimension(0j, radius, 0.0, cam.rocker.motion.h, "psi", style))
    middle = cmath.rect(radius, 0.5 * cam.rocker.motion.h)
    canvas.label(words.symbol("psi"), middle, prefer=-1 + 0j, clear=1.0, height=style.text)
    canvas.part("centre")
    canvas.add(Group((Circle(centre, style.node * 1.5, Pen.MAIN, fill="white"),), "point", "O"))
    canvas.label("O", centre, prefer=1 + 0j, clear=1.0)
    sense = scene.solved.cam.sense
    canvas.add(turning_arrow(centre, 2.4 * style.label, math.pi, 1.4, float(sense), "omega"))
    canvas.label(words.symbol("omega"), centre - 2.4 * style.label, prefer=-1 + 0j, clear=1.0)


def _ray(canvas: Canvas, scene: CamScene, centre: complex) -> None:
    """Draw the direction of the normal in one position of the rise, and its angle to the rocker."""
    i = pressed(scene, SHOWN)
    at, end = (scene.mm(f"{ROCKER_SIZES}.{letter}{i}") for letter in "BD")
    arm = at / abs(at)
    canvas.add(Line(centre, end, Pen.DASHED, role="ray", name=str(i)))
    down = (centre - end) / abs(centre - end)
    start = arm if (down * arm.conjugate()).real > 0.0 else -arm
    radius, sweep = 3.0 * scene.style.label, cmath.phase(down / start)
    canvas.add(angle_dimension(end, radius, cmath.phase(start), sweep, f"gamma_{i}", scene.style))
    middle = end + cmath.rect(radius, cmath.phase(start) + sweep / 2)
    canvas.label(f"{scene.words.symbol('gamma')}_{{{i}}}", middle, prefer=middle - end, height=scene.style.text)


def _lettered(scene: CamScene, cam: RockerCam) -> tuple[str, str]:
    """Return the numbers of what has only a letter in the figure."""
    words, solved, i = scene.words, scene.solved, pressed(scene, SHOWN)
    lengths = {"r_0": cam.sizes.r_0, "l_OC": cam.sizes.l_OC, "l_rocker": cam.sizes.l}
    angles = {"psi": cam.rocker.motion.h, "gamma_rise": cam.limits.gamma_rise, "gamma_fall": cam.limits.gamma_fall}
    shown = 0.5 * math.pi - abs(float(theta(solved, solved.angles[i])))
    said = [f"{words.symbol(name)} = {scene.degrees(angle)}" for name, angle in angles.items()]
    said.append(f"{words.symbol('gamma')}_{{{i}}} = {scene.degrees(shown)}")
    return "; ".join(f"{words.symbol(name)} = {scene.length(size)}" for name, size in lengths.items()), "; ".join(said)


FIGURE = Figure(
    ROCKER_SIZES,
    rocker_sizes_view,
    ("mu_l",),
    (
        Stage("pivot", "rocker_sizes.#"),
        Stage("positions", "rocker_sizes.B#"),
        Stage("analogues", "rocker_sizes.D#"),
        Stage("limits", "_limit#"),
        Stage("centre", "rocker_sizes.C", variant=given("l_OC", "r_0")),
        Stage("pressure"),
    ),
    "cam.rocker_sizes",
)
