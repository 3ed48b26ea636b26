"""The plans from which the sizes of a cam are read: S over its derivatives, and a rocker in all positions.

Over ds/dphi stand the limit tangents, the permitted places of the centre and the one chosen; over d2s/dphi2 the tangent
at 45 degrees to the negative branch; along a rocker the analogues of its velocity, limits and permitted places.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace

from ...plans.cams import course
from ...plans.cams.construction import PLATE_SIZES, ROCKER_SIZES, SIZES
from ...plans.cams.followers import PHASE_OF
from ...plans.cams.motion import FALL, RISE
from ...plans.cams.sizes import apex, wedge
from ..areas import hatched
from ..dimensions import angle, linear, small, turning
from ..figure import Figure, Stage, stages
from ..shapes import Arc, Circle, Head, Line, Pen, Polyline
from ..symbols import HALF_TURN, arc_between, at_level, fixed_pivot, nearer, swept, unit
from ..text import lay_out
from ..view import Canvas, View
from .diagrams_view import jumps
from .scene import CamScene, given
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
CROWDED = 0.8  # heights of numbers between points that cannot both have one beside them
Ends = Iterable[tuple[int, str, complex]]  # number of a section line, name of a point on it, its place
Shared = dict[complex, list[tuple[int, str]]]  # by place the lines, and names of points on them, that have one number


def _sizes_view(scene: CamScene) -> View:
    """Draw S over ds/dphi, with the centre of the cam that is built."""
    solved, canvas, centre = scene.solved, FIGURES["roller"].canvas(scene), scene.mm(f"{SIZES}.C")
    canvas.part("points")
    outline = [0j]
    for phase in (RISE, FALL):  # a line across where the velocity jumps
        points = scene.curve(course.analogues(solved, phase), SIZES)
        canvas.group("curve", phase, Polyline(points, Pen.MAIN))
        outline += points
    canvas.part("axes")
    _axes(canvas, scene, outline, centre.imag - 2 * PAST, "ds", -solved.cam.sense)
    _limits(canvas, scene, centre)
    canvas.part("centre")
    _permitted_offsets(canvas, scene)
    canvas.part("points")
    ends = [(i, phase, scene.mm(f"{SIZES}.{i}_{phase}")) for i, phase in solved.layout.division.on_lines]
    for at, group in _told_apart(canvas, _marked(canvas, scene, ends)):
        out = sum((course.outwards(solved, i, phase) for i, phase in group), 0j)
        _number(canvas, group, at, out or 1j * at.imag)
    canvas.part("centre")
    _radius(canvas, centre, 0j, "r_0")
    side = 1.0 if centre.real > 0.0 else -1.0  # of the ordinates on which the centre is
    canvas.small(scene.lettered("r_0")[0], (centre, 0j), -side)
    offset = scene.dimension("e", abs(float(solved.values["e"])))
    linear(canvas, (complex(0.0, centre.imag), centre), -1j * (BELOW + 8.0), offset, "e")
    _mark_centre(canvas, scene, centre, -side + 0j, 0.0 if side > 0.0 else HALF_TURN)
    canvas.part("pressure")
    at = scene.drawn(course.analogue(solved, scene.shown), SIZES)
    canvas.add(Line(centre, at, Pen.DASHED, role="ray", name=str(scene.shown)))
    radius, theta = 0.55 * abs(centre), f"{scene.symbol('theta')}_{{{scene.shown}}}"
    canvas.add(Line(centre, centre + 1.12j * radius, Pen.AXIS, role="axis"))
    angle(canvas, centre, (1j, at - centre), radius, "theta", theta)
    aslant = f"{theta} = {scene.degrees(swept(1j, at - centre))}"
    notes = (*transfer(scene, SIZES), f"{scene.words['said.cam_permitted']};  {aslant}")
    return canvas.finish("sizes", (scene.words["heading.cam_sizes"], scene.factor(scene.scale(SIZES))), notes)


def _axes(canvas: Canvas, scene: CamScene, outline: Sequence[complex], foot: float, letter: str, way: int = 1) -> None:
    """Draw both axes through the origin past an outline: that of S from `foot`, the other one to the right or left."""
    left, right = (end(p.real for p in outline) for end in (min, max))
    top = 1j * (max(p.imag for p in outline) + PAST)
    first, last = (complex(end, 0.0) for end in (left - PAST, right + PAST)[::way])
    for a, b in ((first, last), (1j * foot, top)):
        canvas.add(Line(a, b, Pen.THIN, role="axis"), Head(b, b - a))
    canvas.label(scene.symbol("s"), top, prefer=1 + 0j, clear=1.2)
    canvas.label(scene.symbol(letter), last, prefer=-1j, clear=1.2)


def _limits(canvas: Canvas, scene: CamScene, centre: complex) -> None:
    """Draw the limits with their angles to the axis, and hatch the permitted places of the cam's centre.

    A limit goes from above the point where it touches the curve down to a level below all places of interest.
    """
    cam, sense = scene.rolling, scene.solved.cam.sense
    planes = wedge(scene.solved.motion, cam.limits, sense)
    corner = scene.drawn(complex(0.0, -apex(planes).s_0), SIZES)
    low, reach = min(centre.imag, corner.imag) - BELOW, 2.5 * BELOW
    for plane in planes:
        canvas.part(f"tangent_{plane.name}")
        touch = scene.drawn(course.touch_of(scene.solved, plane), SIZES)
        up = plane.normal * 1j  # along the line, upwards: the centre is at -e - i s_0
        up = up if up.imag > 0.0 else -up
        canvas.thin("limit", plane.name, touch + up * LINE, at_level(touch, up, low))
        canvas.add(scene.node(touch, plane.name, "touch", filled=True))
        if not _is_lettered(scene, plane.name):
            continue
        across = -1.0 + 0j if up.real >= 0.0 else 1.0 + 0j  # below the axis, on the side of the ordinates
        text = scene.angle(f"gamma_{PHASE_OF[plane.name]}", abs(swept(across, -up)))
        axis = at_level(touch, up, 0.0)
        angle(canvas, axis, (across, -up), ARC * scene.style.label, f"gamma_{plane.name}", text)
    canvas.part("permitted")
    sides = [(-plane.normal, scene.drawn(float(plane.least), SIZES)) for plane in planes]
    canvas.add(hatched(sides, (centre.real - reach, low, centre.real + reach, 0.0), 2.5, "centre"))


def _is_lettered(scene: CamScene, limit: str) -> bool:
    """Whether the angle of a limit is dimensioned: to the sides to which the cam does not push, where it binds."""
    return PHASE_OF[limit] == limit or limit in scene.rolling.sizes.on


def _marked(canvas: Canvas, scene: CamScene, ends: Ends, once: bool = False) -> Shared:
    """Mark the points of section lines; return places with the lines, and names of points, that share one number.

    A line that is to stand `once` in a place has one mark there.
    """
    shared: Shared = {}
    for i, name, at in ends:
        key = next((other for other in shared if abs(other - at) < 2.5 * scene.style.node), at)
        group = shared.setdefault(key, [])
        if not once or all(i != other for other, _ in group):
            group.append((i, name))
            canvas.add(scene.node(at, f"{i}_{name}"))
    return shared


def _told_apart(canvas: Canvas, shared: Shared) -> Iterator[tuple[complex, list[tuple[int, str]]]]:
    """Go through the places that get their numbers: along a curve none so near the one before that letters crowd."""
    before: complex | None = None
    for at, group in shared.items():
        if before is None or abs(at - before) >= CROWDED * small(canvas.style.text):
            before = at
            yield at, group


def _number(canvas: Canvas, group: list[tuple[int, str]], at: complex, prefer: complex) -> None:
    """Write the numbers of the section lines that share a place."""
    text = ", ".join(dict.fromkeys(str(i) for i, _ in group))
    canvas.label(text, at, prefer=prefer, clear=0.8, height=small(canvas.style.text))


def _radius(canvas: Canvas, centre: complex, end: complex, name: str) -> complex:
    """Draw the dimension line from the cam's centre to a point; return its direction."""
    out = unit(end - centre)
    canvas.group("dimension", name, Line(centre, end, Pen.THIN), Head(end, out), Head(centre, -out))
    return out


def _mark_centre(
    canvas: Canvas, scene: CamScene, centre: complex, prefer: complex, middle: float | None = None
) -> None:
    """Mark the centre of the cam, and where its middle is said show its sense."""
    canvas.group("point", "O", Circle(centre, canvas.style.node * 1.5, Pen.MAIN, fill="white"))
    canvas.label("O", centre, prefer=prefer, clear=1.0)
    if middle is not None:
        radius, sense = 2.4 * scene.style.label, float(scene.solved.cam.sense)
        turning(canvas, centre, radius, middle, 1.4, sense, "omega", scene.symbol("omega"))


def _permitted_offsets(canvas: Canvas, scene: CamScene) -> None:
    """Draw the circle of a given r_0 about the lowest place of the roller's centre, its permitted part thick."""
    places = course.offset_places(scene.solved)
    if not places:
        return
    low, high, at = (scene.drawn(place, SIZES) for place in places)
    ends = sorted((low, high, at), key=lambda place: place.real)
    whole = arc_between(0j, ends[0], ends[-1], Pen.AXIS, "circle", "r_0")
    canvas.add(replace(whole, start=whole.start - OVER, sweep=whole.sweep + 2.0 * OVER))
    canvas.group("offsets", "e", arc_between(0j, high, low, Pen.MAIN))
    for name, end, side in (("e_least", low, 1.0), ("e_most", high, -1.0)):
        tick = TICK * unit(end)
        canvas.thin("offset", name, end - tick, end + tick)
        canvas.small(scene.symbol(name), end, complex(side, -1.0), 1.0)


def _plate_sizes_view(scene: CamScene) -> View:
    """Draw S over d2s/dphi2, and what it gives: r_0min, and r_0 with the radius of curvature wanted."""
    solved, canvas, values = scene.solved, FIGURES["plate"].canvas(scene), scene.solved.values
    low, centre = (-1j * scene.drawn(float(values[name]), PLATE_SIZES) for name in ("r_0_flat_min", "r_0_flat"))
    canvas.part("points")
    outline: list[complex] = []
    for phase in (solved.motion.rise, solved.motion.fall):  # a line across where the acceleration jumps
        curves = [scene.curve(piece, PLATE_SIZES) for piece in course.over_acceleration(solved, phase)]
        canvas.group("curve", phase.name, *(Polyline(points, Pen.MAIN) for points in curves))
        feet = ((complex(0.0, place.imag),) for place in (curves[0][0], curves[-1][-1]))
        jumps(canvas, [next(feet), *curves, next(feet)], phase.name)
        outline += [point for points in curves for point in points]
    canvas.part("axes")
    _axes(canvas, scene, outline, centre.imag - PAST, "d2s")
    canvas.part("tangent")  # from past the place where it touches to its foot on the axis
    touch = scene.drawn(course.touch_of_plate(solved), PLATE_SIZES)
    canvas.thin("limit", "convex", touch + ALONG * TANGENT, low - ALONG * TANGENT)
    canvas.add(scene.node(touch, "convex", "touch", filled=True))
    angle(canvas, low, (1j, ALONG), 3.5 * scene.style.label, "tangent", "45°")
    canvas.part("points")
    marks = [
        (i, end, f"{PLATE_SIZES}.{i}_{end}") for i, _ in solved.layout.division.on_lines for end in ("before", "after")
    ]
    ends = [(i, end, scene.mm(mark)) for i, end, mark in marks if mark in values]
    for at, group in _told_apart(canvas, _marked(canvas, scene, ends, once=True)):  # at a jump both ends
        _number(canvas, group, at, 1j)
    canvas.part("centre")
    _mark_centre(canvas, scene, centre, 1 - 1j)
    for at, name in ((low, "r_0_flat_min"), (centre, "r_0_flat")):
        symbol, (text,) = scene.symbol(name), scene.lettered(name)
        wide = (lay_out(written, scene.style.text).width for written in (text, symbol))
        between = abs(at) - 2.0 * scene.style.arrow
        if next(wide) >= between > next(wide):
            text = symbol  # the number stands with the calculations
        linear(canvas, (at, 0j), complex(OUT[name], 0.0), text, name)
    heading = scene.words["heading.cam_plate_sizes"], scene.factor(scene.scale(PLATE_SIZES))
    return canvas.finish("plate_sizes", heading, transfer(scene, PLATE_SIZES))


def _rocker_sizes_view(scene: CamScene) -> View:
    """Draw the rocker about its pivot, and the centre of the cam that is built."""
    canvas, words, solved, i = FIGURES["rocker"].canvas(scene), scene.words, scene.solved, scene.shown
    centre, division = scene.mm(f"{ROCKER_SIZES}.C"), solved.layout.division
    _rocker(canvas, scene)
    canvas.part("limits")
    ends = [(k, phase, scene.drawn(course.analogue(solved, k, phase))) for k, phase in division.on_lines]
    for k, phase, end in ends:  # towards the cam's centre
        past = end + course.limit_direction(solved, k, phase) * (LIMIT * scene.style.label)
        canvas.thin("limit", f"{k}_{phase}", end, past)
    _bounds(canvas, scene, centre.imag - AROUND)
    x, y = centre.real, centre.imag
    box = (x - 2.0 * AROUND, y - AROUND, x + 2.0 * AROUND, min(0.0, y + 2.0 * AROUND))
    sides = [(normal, scene.drawn(least)) for normal, least in course.half_planes(solved)]
    canvas.add(hatched(sides, box, 2.5, "centre"))
    _rocker_nodes(canvas, scene, ends)
    low, high = (scene.mm(f"{ROCKER_SIZES}.B{k}") for k in (0, division.top))
    canvas.part("centre")
    for name, end in (("r_0", low), ("l_OC", 0j)):
        canvas.small(words.symbol(name), (centre, end), _radius(canvas, centre, end, name) * 1j)
    canvas.part("positions")
    linear(canvas, (0j, high), 1j * unit(high) * 3.0 * scene.style.label, words.symbol("l_rocker"), "l_rocker")
    angle(canvas, 0j, (low, high), 0.45 * abs(low), "psi", words.symbol("psi"), prefer=-1 + 0j)
    canvas.part("centre")
    _mark_centre(canvas, scene, centre, 1 + 0j, HALF_TURN)
    canvas.part("pressure")  # the direction of the normal in one position of the rise, and its angle to the rocker
    at, end = (scene.mm(f"{ROCKER_SIZES}.{letter}{i}") for letter in "BD")
    canvas.add(Line(centre, end, Pen.DASHED, role="ray", name=str(i)))
    rays = nearer(unit(at), centre - end), centre - end
    angle(canvas, end, rays, 3.0 * scene.style.label, f"gamma_{i}", f"{words.symbol('gamma')}_{{{i}}}")
    angles = [*scene.lettered("psi", "gamma_rise", "gamma_fall"), scene.pressed()[1]]
    lengths, notes = scene.lettered("r_0", "l_OC", "l_rocker"), words["said.cam_analogues"].split("|")
    notes = ["; ".join(lengths), "; ".join(angles), *notes, words["said.cam_permitted"]]
    return canvas.finish(ROCKER_SIZES, scene.heading("heading.cam_rocker_sizes", ROCKER_SIZES), tuple(notes))


def _rocker(canvas: Canvas, scene: CamScene) -> None:
    """Draw the rocker in all positions, the path of its roller, and the curve of the analogues' ends."""
    division, (l,) = scene.division, scene.sizes("l_rocker")
    over, swing = PAST / l, scene.value_of("psi")
    canvas.part("positions", Arc(0j, l, -over, swing + 2.0 * over, Pen.AXIS, role="path", name="B"))
    canvas.part("analogues")
    for phase in (RISE, FALL):
        points = scene.curve(course.analogues(scene.solved, phase))
        canvas.group("curve", phase, Polyline(points, Pen.MAIN))
    canvas.part("positions")
    for i in division.lines:
        at, end = (scene.mm(f"{ROCKER_SIZES}.{letter}{i}") for letter in "BD")
        # from the pivot only the rocker itself, its highest position, and the one that is lettered
        near = 0j if i in (0, division.top, scene.shown) else min(at, end, key=abs)
        line = Line(near, at, Pen.MAIN) if i == 0 else Line(near, max(at, end, key=abs), Pen.THIN)
        canvas.group("position", str(i), line)
    canvas.part("pivot", fixed_pivot(0j, "C", scene.style))
    canvas.label("C", 0j, prefer=-1 + 1j, clear=scene.style.pair + 1.0)


def _bounds(canvas: Canvas, scene: CamScene, low: float) -> None:
    """Mark the ends of the analogues whose limits come nearest to the centre, and dimension the angles permitted."""
    for limit, place, arm, along in course.bounds(scene.solved):
        end, radius = scene.drawn(place), 5.0 * scene.style.label
        canvas.add(scene.node(end, limit.name, "touch", filled=True))
        canvas.thin("bound", limit.name, end, at_level(end, along, low))
        if not _is_lettered(scene, limit.name):
            continue
        start, text = nearer(arm, along), scene.symbol(f"gamma_{limit.phase}")
        angle(canvas, end, (start, along), radius, f"gamma_{limit.name}", text, clear=0.8)
        if start == arm:  # beyond the rocker
            canvas.thin("extension", "", end, end + arm * (radius + 2.0))


def _rocker_nodes(canvas: Canvas, scene: CamScene, ends: Ends) -> None:
    """Mark the roller's centre and the end of the analogue in every position, and number the ends."""
    shown = scene.shown
    canvas.part("positions")
    for i in scene.division.lines:
        canvas.add(scene.node(scene.mm(f"{ROCKER_SIZES}.B{i}"), f"B{i}"))
    canvas.part("analogues")
    shared = _marked(canvas, scene, ends)
    middle = sum(shared) / len(shared)
    canvas.part("positions")
    canvas.small(f"B_{{{shown}}}", scene.mm(f"{ROCKER_SIZES}.B{shown}"), 1 + 0j, 1.0)
    canvas.part("analogues")
    for at, group in shared.items():
        if [i for i, _ in group] == [shown]:
            canvas.small(f"D_{{{shown}}}", at, at - middle)
        else:
            _number(canvas, group, at, at - middle)


FIGURES = {
    "roller": Figure(
        SIZES,
        _sizes_view,
        ("mu_s_ds", "reduction"),
        (
            *stages(axes="sizes.#", points=("sizes.#_rise", "diagrams.scales")),
            *(Stage(f"tangent_{limit}", f"sizes.T_{limit}") for limit in PHASE_OF),
            Stage("permitted", "sizes.A"),
            Stage("centre", "sizes.C", variant=given("r_0", "e")),
            Stage("pressure"),
        ),
        "cam.sizes",
    ),
    "plate": Figure(
        PLATE_SIZES,
        _plate_sizes_view,
        ("mu_s_d2s", "reduction"),
        (
            Stage("axes", "plate_sizes.#"),
            *stages(points=("plate_sizes.#_before", "diagrams.scales"), tangent="plate_sizes.T"),
            Stage("centre", variant=given("r_0_flat")),
        ),
        "cam.plate_sizes",
    ),
    "rocker": Figure(
        ROCKER_SIZES,
        _rocker_sizes_view,
        ("mu_l",),
        (
            *stages(pivot="rocker_sizes.#", positions=("rocker_sizes.B#", "diagrams.scales")),
            *stages(analogues="rocker_sizes.D#", limits="_limit#"),
            Stage("centre", "rocker_sizes.C", variant=given("l_OC", "r_0")),
            Stage("pressure"),
        ),
        "cam.rocker_sizes",
    ),
}
