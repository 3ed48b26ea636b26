"""The plan of a rocker in all positions: analogues of its velocity, limits, permitted places of the cam's centre."""

from __future__ import annotations

from ...plans.cams.construction import ROCKER_SIZES, is_back, phase_of
from ...plans.cams.course import (
    Bound,
    analogue_end,
    analogues,
    bounds,
    half_planes,
    limit_direction,
    pressed,
    theta,
    transmission,
)
from ...plans.cams.followers import RockerCam
from ..areas import hatched
from ..diagram import small
from ..dimensions import angle, linear, turning
from ..figure import Figure, Stage
from ..shapes import Arc, Circle, Group, Head, Line, Pen, Polyline
from ..symbols import HALF_TURN, at_level, fixed_pivot, nearer, unit
from ..text import Box
from ..view import Canvas, View
from .scene import CamScene, given, needed
from .sizes_view import SHOWN, on_lines

AROUND = 24.0  # mm of the permitted places shown about the chosen one
PAST = 8.0  # mm of the rocker's path beyond its ends
LIMIT = 3.0  # length of a limit at the end of an analogue, in heights of letters: only those that bound are drawn out


def rocker_sizes_view(scene: CamScene) -> View:
    """Draw the rocker about its pivot, and the centre of the cam that is built."""
    canvas, words, cam = FIGURE.canvas(scene), scene.words, needed(scene.solved.rocker)
    centre = scene.mm(f"{ROCKER_SIZES}.C")
    _rocker(canvas, scene, cam)
    frame = _frame(scene, centre)
    canvas.part("limits")
    _limits(canvas, scene)
    for bound in bounds(scene.solved):
        _bound(canvas, scene, bound, frame)
    _permitted(canvas, scene, centre)
    _nodes(canvas, scene)
    _sizes(canvas, scene, centre)
    canvas.part("pressure")
    _ray(canvas, scene, centre)
    scale = f"{scene.words.drawn_at(scene.mu_l)};  {scene.factor(scene.scale(ROCKER_SIZES))}"
    notes = (*_lettered(scene, cam), *words["said.cam_analogues"].split("|"), words["said.cam_permitted"])
    return canvas.finish(ROCKER_SIZES, (words["heading.cam_rocker_sizes"], scale), notes)


def _rocker(canvas: Canvas, scene: CamScene, cam: RockerCam) -> None:
    """Draw the rocker in all positions, the path of its roller, and the curve of the analogues' ends."""
    solved, style, l = scene.solved, scene.style, scene.drawn(cam.sizes.l)
    over = PAST / l
    canvas.part("positions")
    canvas.add(Arc(0j, l, -over, cam.rocker.motion.h + 2.0 * over, Pen.AXIS, role="path", name="B"))
    canvas.part("analogues")
    for phase in (cam.rocker.motion.rise, cam.rocker.motion.fall):
        canvas.add(Group((Polyline(scene.curve(analogues(solved, phase)), Pen.MAIN),), "curve", phase.name))
    division, shown = solved.layout.division, pressed(scene.solved, SHOWN)
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


def _frame(scene: CamScene, centre: complex) -> Box:
    """Return the box in which limits are drawn: from beside the centre to above the highest position."""
    ends = [scene.mm(f"{ROCKER_SIZES}.{letter}{i}") for i in scene.solved.layout.division.lines for letter in "BD"]
    right, top = max(end.real for end in ends), max(end.imag for end in ends)
    left = min(min(end.real for end in ends), centre.real - AROUND)
    return left, centre.imag - AROUND, max(right + PAST, centre.real + AROUND), top + PAST


def _limits(canvas: Canvas, scene: CamScene) -> None:
    """Draw the direction of the limit at the end of each analogue, towards the cam's centre."""
    for i, phase in on_lines(scene):
        end = scene.drawn(analogue_end(scene.solved, i, phase))
        past = end + limit_direction(scene.solved, i, phase) * (LIMIT * scene.style.label)
        canvas.add(Line(end, past, Pen.THIN, role="limit", name=f"{i}_{phase}"))


def _bound(canvas: Canvas, scene: CamScene, bound: Bound, frame: Box) -> None:
    """Mark the end of the analogue whose limit comes nearest to the centre, and dimension the angle permitted."""
    cam, limit, arm, along = needed(scene.solved.rocker), bound.limit, bound.arm, bound.along
    end = scene.drawn(bound.end)
    canvas.add(scene.node(end, limit.name, "touch", filled=True))
    canvas.add(Line(end, at_level(end, along, frame[1]), Pen.THIN, role="bound", name=limit.name))
    if is_back(limit.name) and limit.name not in cam.sizes.on:
        return
    text, radius = scene.words.symbol(f"gamma_{phase_of(limit.name)}"), 5.0 * scene.style.label
    start = nearer(arm, along)
    angle(canvas, end, (start, along), radius, f"gamma_{limit.name}", text, clear=0.8)
    if start == arm:  # beyond the rocker
        canvas.add(Line(end, end + arm * (radius + 2.0), Pen.THIN, role="extension"))


def _permitted(canvas: Canvas, scene: CamScene, centre: complex) -> None:
    """Hatch the permitted places of the cam's centre, beside the chosen one."""
    x, y = centre.real, centre.imag
    box = (x - 2.0 * AROUND, y - AROUND, x + 2.0 * AROUND, min(0.0, y + 2.0 * AROUND))
    sides = [(normal, scene.drawn(least)) for normal, least in half_planes(scene.solved)]
    canvas.add(hatched(sides, box, 2.5, "centre"))


def _nodes(canvas: Canvas, scene: CamScene) -> None:
    """Mark the roller's centre and the end of the analogue in every position, and number the ends."""
    shared: dict[complex, list[str]] = {}
    canvas.part("positions")
    for i in scene.solved.layout.division.lines:
        at = scene.mm(f"{ROCKER_SIZES}.B{i}")
        canvas.add(scene.node(at, f"B{i}"))
    canvas.part("analogues")
    for i, phase in on_lines(scene):
        at = scene.drawn(analogue_end(scene.solved, i, phase))
        canvas.add(scene.node(at, f"{i}_{phase}"))
        key = next((other for other in shared if abs(other - at) < 2.5 * scene.style.node), at)
        shared.setdefault(key, []).append(str(i))
    middle, named = sum(shared) / len(shared), str(pressed(scene.solved, SHOWN))
    canvas.part("positions")
    canvas.label(f"B_{{{named}}}", scene.mm(f"{ROCKER_SIZES}.B{named}"), prefer=1 + 0j, height=scene.style.text)
    canvas.part("analogues")
    for at, numbers in shared.items():
        text = f"D_{{{named}}}" if numbers == [named] else ", ".join(dict.fromkeys(numbers))
        height = scene.style.text if numbers == [named] else small(scene.style.text)
        canvas.label(text, at, prefer=at - middle, clear=0.8, height=height)


def _sizes(canvas: Canvas, scene: CamScene, centre: complex) -> None:
    """Mark the chosen centre; dimension r_0, l_OC, the rocker and its swing; show the sense of the cam."""
    words, style = scene.words, scene.style
    low, high = scene.mm(f"{ROCKER_SIZES}.B0"), scene.mm(f"{ROCKER_SIZES}.B{scene.solved.layout.division.top}")
    canvas.part("centre")
    for name, end in (("r_0", low), ("l_OC", 0j)):
        out = unit(end - centre)
        canvas.add(Group((Line(centre, end, Pen.THIN), Head(end, out), Head(centre, -out)), "dimension", name))
        canvas.label(words.symbol(name), (centre, end), prefer=out * 1j, clear=0.8, height=style.text)
    canvas.part("positions")
    out = 1j * unit(high) * 3.0 * style.label
    linear(canvas, (0j, high), out, words.symbol("l_rocker"), "l_rocker")
    angle(canvas, 0j, (low, high), 0.45 * abs(low), "psi", words.symbol("psi"), prefer=-1 + 0j)
    canvas.part("centre")
    canvas.add(Group((Circle(centre, style.node * 1.5, Pen.MAIN, fill="white"),), "point", "O"))
    canvas.label("O", centre, prefer=1 + 0j, clear=1.0)
    sense = scene.solved.cam.sense
    turning(canvas, centre, 2.4 * style.label, HALF_TURN, 1.4, float(sense), "omega", words.symbol("omega"))


def _ray(canvas: Canvas, scene: CamScene, centre: complex) -> None:
    """Draw the direction of the normal in one position of the rise, and its angle to the rocker."""
    i = pressed(scene.solved, SHOWN)
    at, end = (scene.mm(f"{ROCKER_SIZES}.{letter}{i}") for letter in "BD")
    canvas.add(Line(centre, end, Pen.DASHED, role="ray", name=str(i)))
    rays = nearer(unit(at), centre - end), centre - end
    text = f"{scene.words.symbol('gamma')}_{{{i}}}"
    angle(canvas, end, rays, 3.0 * scene.style.label, f"gamma_{i}", text)


def _lettered(scene: CamScene, cam: RockerCam) -> tuple[str, str]:
    """Return the numbers of what has only a letter in the figure."""
    words, solved, i = scene.words, scene.solved, pressed(scene.solved, SHOWN)
    lengths = {"r_0": cam.sizes.r_0, "l_OC": cam.sizes.l_OC, "l_rocker": cam.sizes.l}
    angles = {"psi": cam.rocker.motion.h, "gamma_rise": cam.limits.gamma_rise, "gamma_fall": cam.limits.gamma_fall}
    shown = transmission(float(theta(solved, solved.angles[i])))
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
