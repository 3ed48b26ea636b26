"""The plans from which the sizes of a cam are read: S over its derivatives, and a rocker in all positions.

Over ds/dphi stand the limit tangents, the permitted places of the centre and the one chosen; over d2s/dphi2 the tangent
at 45 degrees to the negative branch; along a rocker the analogues of its velocity, limits and permitted places.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from ...plans.cams import course
from ...plans.cams.construction import PLATE_SIZES, ROCKER_SIZES, SIZES
from ...plans.cams.followers import RockerCam, RollerCam
from ...plans.cams.motion import FALL, RISE
from ...plans.cams.sizes import PHASE_OF, HalfPlane, Limit, wedge
from ..areas import hatched
from ..diagram import small
from ..figure import Figure, Stage
from ..shapes import Arc, Circle, Group, Head, Line, Pen, Polyline
from ..symbols import HALF_TURN, arc_between, at_level, fixed_pivot, nearer, swept, unit
from ..text import lay_out
from ..view import Canvas, View, angle, linear, turning
from .diagrams_view import jumps
from .scene import SHOWN, CamScene, given, needed
from .text import transfer

PAST = 8.0  # mm by which an axis runs past the curve, a rocker's path past its ends
BELOW = 30.0  # mm of the permitted places shown below the lowest one
ARC = 4.0  # radius of the arc of an angle in heights of letters
LINE = 18.0  # mm by which a limit runs past the place where it touches
OVER = 4.0 / 180.0 * HALF_TURN  # of the circle beyond the permitted part
OUT = {"r_0_flat_min": 14.0, "r_0_flat": 46.0}  # mm from the axis to the dimensions
ALONG = unit(-1.0 + 1.0j)  # up the tangent
TANGENT = 12.0  # mm by which the tangent runs past the place where it touches
TICK = 2.0  # mm to both sides of the circle
AROUND = 24.0  # mm of the permitted places shown about the chosen one
LIMIT = 3.0  # length of a limit at the end of an analogue, in heights of letters: only those that bound are drawn out


def sizes_view(scene: CamScene) -> View:
    """Draw the diagram, with the centre of the cam that is built."""
    solved, words = scene.solved, scene.words
    roller = needed(solved.roller)
    canvas = ROLLER_FIGURE.canvas(scene)
    centre = scene.mm(f"{SIZES}.C")
    canvas.part("points")
    outline = [0j]
    for phase in (solved.motion.rise, solved.motion.fall):  # a line across where the velocity jumps
        points = scene.curve(course.over_velocity(solved, phase), SIZES)
        canvas.add(Group((Polyline(points, Pen.MAIN),), "curve", phase.name))
        outline += points
    canvas.part("axes")
    _axes(canvas, scene, outline, centre.imag - 2 * PAST, "ds")
    _limits(canvas, scene, roller, centre)
    canvas.part("centre")
    _permitted_offsets(canvas, scene)
    canvas.part("points")
    ends = [(i, phase, scene.mm(f"{SIZES}.{i}_{phase}")) for i, phase in _on_lines(scene)]
    for at, group in _marked(canvas, scene, ends).items():
        out = sum((course.outwards(solved, i, phase) for i, phase in group), 0j)
        canvas.label(_numbers(group), at, prefer=out or 1j * at.imag, clear=0.8, height=small(scene.style.text))
    canvas.part("centre")
    aslant = _centre(canvas, scene, roller, centre)
    notes = (*transfer(scene, SIZES), f"{words['said.cam_permitted']};  {aslant}")
    return canvas.finish("sizes", (words["heading.cam_sizes"], scene.factor(scene.scale(SIZES))), notes)


def _axes(canvas: Canvas, scene: CamScene, outline: list[complex], foot: float, letter: str) -> None:
    """Draw both axes through the origin past an outline, that of S down to `foot`."""
    left, right = (end(p.real for p in outline) for end in (min, max))
    top = max(p.imag for p in outline) + PAST
    for a, b in ((complex(left - PAST, 0.0), complex(right + PAST, 0.0)), (1j * foot, 1j * top)):
        canvas.add(Line(a, b, Pen.THIN, role="axis"), Head(b, b - a))
    canvas.label(scene.words.symbol("s"), 1j * top, prefer=1 + 0j, clear=1.2)
    canvas.label(scene.words.symbol(letter), complex(right + PAST, 0.0), prefer=-1j, clear=1.2)


def _limits(canvas: Canvas, scene: CamScene, roller: RollerCam, centre: complex) -> None:
    """Draw the limits, and hatch the permitted places of the cam's centre beside the chosen one."""
    planes = wedge(scene.solved.motion, roller.limits, scene.solved.cam.sense)
    apex = scene.drawn(complex(roller.by_tangents.e, -roller.by_tangents.s_0), SIZES)
    low, reach = min(centre.imag, apex.imag) - BELOW, 2.5 * BELOW
    for plane in planes:
        canvas.part(f"tangent_{plane.name}")
        _limit(canvas, scene, plane, low)
    canvas.part("permitted")
    sides = [(plane.normal.conjugate(), scene.drawn(float(plane.least), SIZES)) for plane in planes]
    canvas.add(hatched(sides, (centre.real - reach, low, centre.real + reach, 0.0), 2.5, "centre"))


def _limit(canvas: Canvas, scene: CamScene, plane: HalfPlane, low: float) -> None:
    """Draw a limit from above the point where it touches the curve down to `low`, with its angle to the axis."""
    touch = scene.drawn(course.touch_of(scene.solved, plane), SIZES)
    up = plane.normal.conjugate() * 1j  # along the line, upwards: a mirror image turns e + i s_0 down
    up = up if up.imag > 0.0 else -up
    foot = at_level(touch, up, low)
    canvas.add(Line(touch + up * LINE, foot, Pen.THIN, role="limit", name=plane.name))
    canvas.add(scene.node(touch, plane.name, "touch", filled=True))
    if PHASE_OF[plane.name] != plane.name and scene.solved.roller and plane.name not in scene.solved.roller.sizes.on:
        return
    axis = at_level(touch, up, 0.0)
    across = -1.0 + 0j if up.real >= 0.0 else 1.0 + 0j  # below the axis, on the side of the ordinates
    gamma = abs(swept(across, -up))
    name, text = f"gamma_{plane.name}", scene.angle(f"gamma_{PHASE_OF[plane.name]}", gamma)
    angle(canvas, axis, (across, -up), ARC * scene.style.label, name, text)


def _on_lines(scene: CamScene) -> list[tuple[int, str]]:
    """Return the section lines of rise and fall, each with the name of its phase."""
    division = scene.solved.layout.division
    return [*((i, RISE) for i in division.rise), *((i, FALL) for i in division.fall)]


def _marked(
    canvas: Canvas, scene: CamScene, ends: Iterable[tuple[int, str, complex]], once: bool = False
) -> dict[complex, list[tuple[int, str]]]:
    """Mark the points of section lines; return places with the lines, and names of points, that share one number.

    A line that is to stand `once` in a place has one mark there.
    """
    shared: dict[complex, list[tuple[int, str]]] = {}
    for i, name, at in ends:
        key = next((other for other in shared if abs(other - at) < 2.5 * scene.style.node), at)
        group = shared.setdefault(key, [])
        if not once or all(i != other for other, _ in group):
            group.append((i, name))
            canvas.add(scene.node(at, f"{i}_{name}"))
    return shared


def _numbers(group: list[tuple[int, str]]) -> str:
    return ", ".join(dict.fromkeys(str(i) for i, _ in group))


def _radius(canvas: Canvas, centre: complex, end: complex, name: str) -> complex:
    """Draw the dimension line from the cam's centre to a point; return its direction."""
    out = unit(end - centre)
    canvas.add(Group((Line(centre, end, Pen.THIN), Head(end, out), Head(centre, -out)), "dimension", name))
    return out


def _mark_centre(canvas: Canvas, centre: complex, prefer: complex) -> None:
    canvas.add(Group((Circle(centre, canvas.style.node * 1.5, Pen.MAIN, fill="white"),), "point", "O"))
    canvas.label("O", centre, prefer=prefer, clear=1.0)


def _turns(canvas: Canvas, scene: CamScene, centre: complex, middle: float) -> None:
    """Show the sense of the cam."""
    radius, sense = 2.4 * scene.style.label, float(scene.solved.cam.sense)
    turning(canvas, centre, radius, middle, 1.4, sense, "omega", scene.words.symbol("omega"))


def _centre(canvas: Canvas, scene: CamScene, roller: RollerCam, centre: complex) -> str:
    """Mark the chosen centre, dimension r_0 and e, draw a ray, the sense of the cam; return the ray's angle."""
    words = scene.words
    _radius(canvas, centre, 0j, "r_0")
    text = scene.dimension("r_0", roller.sizes.r_0)
    canvas.label(text, (centre, 0j), prefer=-1.0, clear=0.8, height=scene.style.text)
    across = complex(0.0, centre.imag)
    linear(canvas, (across, centre), -1j * (BELOW + 8.0), scene.dimension("e", abs(roller.sizes.e)), "e")
    _mark_centre(canvas, centre, -1 + 0j)
    _turns(canvas, scene, centre, 0.0)
    canvas.part("pressure")
    i = course.pressed(scene.solved, SHOWN)
    at = scene.drawn(course.analogue(scene.solved, i), SIZES)
    canvas.add(Line(centre, at, Pen.DASHED, role="ray", name=str(i)))
    radius, text = 0.55 * abs(centre), f"{words.symbol('theta')}_{{{i}}}"
    canvas.add(Line(centre, centre + 1.12j * radius, Pen.AXIS, role="axis"))
    angle(canvas, centre, (1j, at - centre), radius, "theta", text)
    return f"{text} = {scene.degrees(swept(at - centre, 1j))}"


def _permitted_offsets(canvas: Canvas, scene: CamScene) -> None:
    """Draw the circle of a given r_0 about the lowest place of the roller's centre, its permitted part thick."""
    places = course.offset_places(scene.solved)
    if not places:
        return
    low, high, at = (scene.drawn(place, SIZES) for place in places)
    ends = sorted((low, high, at), key=lambda place: place.real)
    whole = arc_between(0j, ends[0], ends[-1], Pen.AXIS, "circle", "r_0")
    canvas.add(replace(whole, start=whole.start - OVER, sweep=whole.sweep + 2.0 * OVER))
    canvas.add(Group((arc_between(0j, low, high, Pen.MAIN),), "offsets", "e"))
    for name, end, side in (("e_least", low, -1.0), ("e_most", high, 1.0)):
        tick = TICK * unit(end)
        canvas.add(Line(end - tick, end + tick, Pen.THIN, role="offset", name=name))
        canvas.label(scene.words.symbol(name), end, prefer=complex(side, -1.0), height=scene.style.text)


ROLLER_FIGURE = Figure(
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


def plate_sizes_view(scene: CamScene) -> View:
    """Draw the diagram, and what it gives: r_0min, and r_0 with the radius of curvature wanted."""
    plate, canvas = needed(scene.solved.plate), PLATE_FIGURE.canvas(scene)
    canvas.part("points")
    outline = _plate_curve(canvas, scene)
    canvas.part("axes")
    _axes(canvas, scene, outline, -scene.drawn(plate.sizes.r_0, PLATE_SIZES) - PAST, "d2s")
    canvas.part("tangent")  # from past the place where it touches to its foot on the axis
    foot = -1j * scene.drawn(plate.sizes.r_0_min, PLATE_SIZES)
    touch = scene.drawn(course.touch_of_plate(scene.solved), PLATE_SIZES)
    canvas.add(Line(touch + ALONG * TANGENT, foot - ALONG * TANGENT, Pen.THIN, role="limit", name="convex"))
    canvas.add(scene.node(touch, "convex", "touch", filled=True))
    angle(canvas, foot, (1j, ALONG), 3.0 * scene.style.label, "tangent", "45°")
    canvas.part("points")
    marks = [(i, end, f"{PLATE_SIZES}.{i}_{end}") for i, _ in _on_lines(scene) for end in ("before", "after")]
    ends = [(i, end, scene.mm(mark)) for i, end, mark in marks if mark in scene.solved.values]
    for at, group in _marked(canvas, scene, ends, once=True).items():  # at a jump both ends
        canvas.label(_numbers(group), at, prefer=1j, clear=0.8, height=small(scene.style.text))
    canvas.part("centre")
    _plate_centre(canvas, scene)
    heading = scene.words["heading.cam_plate_sizes"], scene.factor(scene.scale(PLATE_SIZES))
    return canvas.finish("plate_sizes", heading, transfer(scene, PLATE_SIZES))


def _plate_curve(canvas: Canvas, scene: CamScene) -> list[complex]:
    """Draw the exact curve by smooth pieces, and the lines across where the acceleration jumps."""
    motion = scene.solved.motion
    every: list[complex] = []
    for phase in (motion.rise, motion.fall):
        curves = [scene.curve(piece, PLATE_SIZES) for piece in course.over_acceleration(scene.solved, phase)]
        canvas.add(Group(tuple(Polyline(points, Pen.MAIN) for points in curves), "curve", phase.name))
        ends = [(complex(0.0, curves[0][0].imag),), *curves, (complex(0.0, curves[-1][-1].imag),)]
        jumps(canvas, ends, phase.name)
        every += [point for points in curves for point in points]
    return every


def _plate_centre(canvas: Canvas, scene: CamScene) -> None:
    """Dimension r_0min and r_0 downwards from the lowest place of the plate."""
    words, style, plate = scene.words, scene.style, needed(scene.solved.plate)
    low, centre = (-1j * scene.drawn(size, PLATE_SIZES) for size in (plate.sizes.r_0_min, plate.sizes.r_0))
    _mark_centre(canvas, centre, 1 - 1j)
    sizes = ((low, "r_0_flat_min", plate.sizes.r_0_min), (centre, "r_0_flat", plate.sizes.r_0))
    for at, name, size in sizes:
        symbol, text = words.symbol(name), scene.dimension(name, size)
        between = abs(at) - 2.0 * style.arrow
        if lay_out(text, style.text).width >= between > lay_out(symbol, style.text).width:
            text = symbol  # the number stands with the calculations
        linear(canvas, (at, 0j), complex(OUT[name], 0.0), text, name)


PLATE_FIGURE = Figure(
    PLATE_SIZES,
    plate_sizes_view,
    ("mu_s_d2s", "reduction"),
    (
        Stage("axes", "plate_sizes.#"),
        Stage("points", "plate_sizes.#_before"),
        Stage("tangent", "plate_sizes.T"),
        Stage("centre", variant=given("r_0_flat")),
    ),
    "cam.plate_sizes",
)


def rocker_sizes_view(scene: CamScene) -> View:
    """Draw the rocker about its pivot, and the centre of the cam that is built."""
    canvas, words, cam = ROCKER_FIGURE.canvas(scene), scene.words, needed(scene.solved.rocker)
    centre = scene.mm(f"{ROCKER_SIZES}.C")
    _rocker(canvas, scene, cam)
    low = centre.imag - AROUND
    canvas.part("limits")
    ends = [(i, phase, scene.drawn(course.analogue_end(scene.solved, i, phase))) for i, phase in _on_lines(scene)]
    for i, phase, end in ends:  # towards the cam's centre
        past = end + course.limit_direction(scene.solved, i, phase) * (LIMIT * scene.style.label)
        canvas.add(Line(end, past, Pen.THIN, role="limit", name=f"{i}_{phase}"))
    for bound in course.bounds(scene.solved):
        _bound(canvas, scene, bound, low)
    x, y = centre.real, centre.imag
    box = (x - 2.0 * AROUND, y - AROUND, x + 2.0 * AROUND, min(0.0, y + 2.0 * AROUND))
    sides = [(normal, scene.drawn(least)) for normal, least in course.half_planes(scene.solved)]
    canvas.add(hatched(sides, box, 2.5, "centre"))
    _rocker_nodes(canvas, scene, ends)
    _rocker_sizes(canvas, scene, centre)
    canvas.part("pressure")
    _ray(canvas, scene, centre)
    notes = (*_rocker_lettered(scene, cam), *words["said.cam_analogues"].split("|"), words["said.cam_permitted"])
    return canvas.finish(ROCKER_SIZES, scene.heading("heading.cam_rocker_sizes", ROCKER_SIZES), notes)


def _rocker(canvas: Canvas, scene: CamScene, cam: RockerCam) -> None:
    """Draw the rocker in all positions, the path of its roller, and the curve of the analogues' ends."""
    solved, style, l = scene.solved, scene.style, scene.drawn(cam.sizes.l)
    over = PAST / l
    canvas.part("positions")
    canvas.add(Arc(0j, l, -over, cam.rocker.motion.h + 2.0 * over, Pen.AXIS, role="path", name="B"))
    canvas.part("analogues")
    for phase in (cam.rocker.motion.rise, cam.rocker.motion.fall):
        canvas.add(Group((Polyline(scene.curve(course.analogues(solved, phase)), Pen.MAIN),), "curve", phase.name))
    division, shown = solved.layout.division, course.pressed(scene.solved, SHOWN)
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


def _bound(canvas: Canvas, scene: CamScene, bound: tuple[Limit, complex, complex, complex], low: float) -> None:
    """Mark the end of the analogue whose limit comes nearest to the centre, and dimension the angle permitted."""
    cam, (limit, far, arm, along) = needed(scene.solved.rocker), bound
    end = scene.drawn(far)
    canvas.add(scene.node(end, limit.name, "touch", filled=True))
    canvas.add(Line(end, at_level(end, along, low), Pen.THIN, role="bound", name=limit.name))
    if PHASE_OF[limit.name] != limit.name and limit.name not in cam.sizes.on:
        return
    text, radius = scene.words.symbol(f"gamma_{PHASE_OF[limit.name]}"), 5.0 * scene.style.label
    start = nearer(arm, along)
    angle(canvas, end, (start, along), radius, f"gamma_{limit.name}", text, clear=0.8)
    if start == arm:  # beyond the rocker
        canvas.add(Line(end, end + arm * (radius + 2.0), Pen.THIN, role="extension"))


def _rocker_nodes(canvas: Canvas, scene: CamScene, ends: list[tuple[int, str, complex]]) -> None:
    """Mark the roller's centre and the end of the analogue in every position, and number the ends."""
    canvas.part("positions")
    for i in scene.solved.layout.division.lines:
        canvas.add(scene.node(scene.mm(f"{ROCKER_SIZES}.B{i}"), f"B{i}"))
    canvas.part("analogues")
    shared = _marked(canvas, scene, ends)
    middle, named, height = sum(shared) / len(shared), course.pressed(scene.solved, SHOWN), scene.style.text
    canvas.part("positions")
    canvas.label(f"B_{{{named}}}", scene.mm(f"{ROCKER_SIZES}.B{named}"), prefer=1 + 0j, height=height)
    canvas.part("analogues")
    for at, group in shared.items():
        alone = [i for i, _ in group] == [named]
        text = f"D_{{{named}}}" if alone else _numbers(group)
        canvas.label(text, at, prefer=at - middle, clear=0.8, height=height if alone else small(height))


def _rocker_sizes(canvas: Canvas, scene: CamScene, centre: complex) -> None:
    """Mark the chosen centre; dimension r_0, l_OC, the rocker and its swing; show the sense of the cam."""
    words, style = scene.words, scene.style
    low, high = scene.mm(f"{ROCKER_SIZES}.B0"), scene.mm(f"{ROCKER_SIZES}.B{scene.solved.layout.division.top}")
    canvas.part("centre")
    for name, end in (("r_0", low), ("l_OC", 0j)):
        out = _radius(canvas, centre, end, name)
        canvas.label(words.symbol(name), (centre, end), prefer=out * 1j, clear=0.8, height=style.text)
    canvas.part("positions")
    out = 1j * unit(high) * 3.0 * style.label
    linear(canvas, (0j, high), out, words.symbol("l_rocker"), "l_rocker")
    angle(canvas, 0j, (low, high), 0.45 * abs(low), "psi", words.symbol("psi"), prefer=-1 + 0j)
    canvas.part("centre")
    _mark_centre(canvas, centre, 1 + 0j)
    _turns(canvas, scene, centre, HALF_TURN)


def _ray(canvas: Canvas, scene: CamScene, centre: complex) -> None:
    """Draw the direction of the normal in one position of the rise, and its angle to the rocker."""
    i = course.pressed(scene.solved, SHOWN)
    at, end = (scene.mm(f"{ROCKER_SIZES}.{letter}{i}") for letter in "BD")
    canvas.add(Line(centre, end, Pen.DASHED, role="ray", name=str(i)))
    rays = nearer(unit(at), centre - end), centre - end
    text = f"{scene.words.symbol('gamma')}_{{{i}}}"
    angle(canvas, end, rays, 3.0 * scene.style.label, f"gamma_{i}", text)


def _rocker_lettered(scene: CamScene, cam: RockerCam) -> tuple[str, str]:
    """Return the numbers of what has only a letter in the figure."""
    solved, i = scene.solved, course.pressed(scene.solved, SHOWN)
    lengths = {"r_0": cam.sizes.r_0, "l_OC": cam.sizes.l_OC, "l_rocker": cam.sizes.l}
    angles = {"psi": cam.rocker.motion.h, "gamma_rise": cam.limits.gamma_rise, "gamma_fall": cam.limits.gamma_fall}
    shown = course.transmission(float(course.theta(solved, solved.angles[i])))
    texts = [scene.angle(name, angle) for name, angle in angles.items()]
    texts.append(scene.angle("gamma", shown, i))
    return "; ".join(scene.dimension(name, size) for name, size in lengths.items()), "; ".join(texts)


ROCKER_FIGURE = Figure(
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

FIGURES = {"roller": ROLLER_FIGURE, "rocker": ROCKER_FIGURE, "plate": PLATE_FIGURE}
