"""The plan of the mechanism: links, pairs, guides, how joints are found, the angle of the driver, senses of turning."""

from __future__ import annotations

import math
from cmath import phase, rect
from collections.abc import Iterable, Iterator, Sequence
from itertools import combinations
from typing import NamedTuple

import numpy as np

from ....plans.board import POSITION, Step
from ....plans.linkages.compound import is_relative
from ....plans.linkages.legs import guide_letters
from ....plans.linkages.mechanism import FRAME, ZERO, Driver, Prismatic, SlidingDriver
from ....plans.names import role
from ...figure import ANSWERS, GIVEN
from ...shapes import Arc, Arrow, Circle, Group, Head, Line, Pen, Polyline, Shape, Text, Vector, sides_of
from ...symbols import angle_dimension, turning_arrow
from ...view import Canvas, View
from ..scene import Scene
from .links import NEAR, Skeleton, Stroke, draw_frame, draw_links, foot_of, guide_of, guide_up, letter_links, skeleton
from .plan import draw_sides, said_flat

FAR = 40.0  # mm from the pivot at which the arrow of omega_1 stands
PAST = 16.0  # mm by which the axis of a guide runs past its slider and a pivot
LEAVES, LONGEST = 1.6, 34.0  # mm by which the end of an arc leaves its tangent, unless the arc would be too long
CROSS = 8.0  # mm by which arcs and lines run past the joint that they find
PLACES = {"omega": 0.30, "epsilon": 0.45}  # parts of the link at which its arcs stand
CLEAR = 3.5  # mm that should be left between an arc and what it passes
CROSSED, CROSSING = 1.2, 3.0  # mm between points of an arc that crosses a line and the line; what that costs
APART = 0.25  # lengths of the arrow of a force between two arcs about one joint
NEAREST, STEP = 14.0, 1.0  # mm from the joint: the least radius, and between radii that are tried
FARTHEST = 1200.0  # mm: on no sheet two points are so far apart
SAMPLES = 13  # points of an arc at which its neighbours are looked for
LENGTHS, SHORTER = (1.0, 0.6, 0.4), 0.3  # of an arc, and the cost of each step shorter
LIGHT = 0.35  # how much a thin line counts beside a main one
KEPT = 24  # places of each arc, the cheapest, that are looked at together
AWAY, OTHER = 1.5, 0.4  # cost of a place a whole link away from the wanted one, and of a line that was not wanted
Obstacle = tuple[complex, complex, float, float]  # ends, how far it reaches about itself, how much it counts


def scheme(scene: Scene) -> View:
    """Draw the plan of the mechanism in the given position."""
    canvas = scene.canvas()
    numbers = [link.number for link in scene.mechanism.links]
    canvas.part(GIVEN)
    axes(canvas, scene)
    points = {point for link in scene.mechanism.links for point in link.points}
    for step in scene.program.on(POSITION):
        if step.name in points or step.verb == "tangent":
            found_by(canvas, scene, step)
    special_points(canvas, scene)
    strokes = [stroke for number in numbers for stroke in skeleton(scene, number).strokes]
    draw_sides(canvas, scene, POSITION, strokes)
    figures = draw_links(canvas, scene, numbers)
    draw_frame(canvas, scene, numbers, figures)
    driver = scene.mechanism.driver
    canvas.part(driver.point)
    if isinstance(driver, Driver):
        _angle(canvas, scene, driver)
    else:
        _speed(canvas, scene, driver)
    senses(canvas, scene, figures)
    canvas.part(GIVEN)
    _frame_number(canvas, scene, figures)
    moving_guides(canvas, scene, figures)
    letter_links(canvas, scene, figures)
    return canvas.finish("position", scene.heading("heading.position", "position"), tuple(said_flat(scene, POSITION)))


def _angle(canvas: Canvas, scene: Scene, driver: Driver) -> None:
    """Dimension phi from the axis x, and draw the arrows of omega_1 and epsilon_1 on the other side."""
    o, style = scene.mm(driver.pivot), scene.style
    crank_mm = abs(scene.mm(driver.point) - o)
    phi = math.remainder(scene.solved.values[driver.angle], 2 * math.pi)
    phi = phi + 2 * math.pi if phi < -1e-12 else phi
    text = f"{scene.words.symbol(driver.angle)} = {scene.words.short(round(math.degrees(phi), 9))}°"
    radius = max(0.45 * crank_mm, 9.0)
    zero = o + max(crank_mm, radius + 6.0) * 1.1
    canvas.add(Line(o + style.pair, zero, Pen.THIN, role="zero-direction", name=driver.angle))
    if phi > 0.05:
        canvas.add(angle_dimension(o, radius, 0.0, phi, driver.angle, style))
        middle = o + rect(radius, min(phi / 2, 1.2))
        canvas.label(text, middle, prefer=rect(1.0, phi / 2), clear=1.2)
    else:
        canvas.label(text, o + radius, prefer=1j, clear=1.2)
    radius = min(crank_mm * 0.78, FAR) if crank_mm > 24.0 else radius + 5.0
    wanted = phi + math.pi * 0.78 if phi < math.pi else phi / 2 + math.pi * 0.86
    radii = tuple(radius * part for part in (1.0, 0.75, 1.3, 1.6))
    turning_of_driver(canvas, scene, driver, radii, 1.0, wanted)


def turning_of_driver(
    canvas: Canvas, scene: Scene, driver: Driver, radii: Sequence[float], spread: float, wanted: float
) -> None:
    """Draw the arrows of omega_1 and epsilon_1 about the pivot where there is room, near the direction `wanted`."""
    o, values = scene.mm(driver.pivot), scene.solved.values
    omega, epsilon = (f"{kind}_{driver.link}" for kind in ("omega", "epsilon"))
    canvas.part(ANSWERS)
    for name, turn in ((omega, values.get(omega) or values[driver.sense]), (epsilon, values.get(epsilon))):
        if turn:
            at, middle = free_arc(o, radii, spread, wanted, list(obstacles(canvas.shapes)))
            canvas.add(turning_arrow(o, at, middle, spread, math.copysign(1.0, turn), name))
            canvas.label(scene.words.symbol(name), o + rect(at, middle), prefer=rect(1.0, middle))


def _speed(canvas: Canvas, scene: Scene, driver: SlidingDriver) -> None:
    pair = next(p for p in scene.mechanism.pairs if isinstance(p, Prismatic) and driver.link in p.links)
    speed = scene.solved.values[driver.speed]
    if speed:
        canvas.part(ANSWERS)
        up, e = guide_up(scene, pair), guide_of(scene, pair) * math.copysign(1.0, speed)
        tail = scene.mm(pair.point) + up * (scene.style.slider[1] / 2 + 3.0) - e * (0.3 * scene.style.force)
        tip = tail + e * 0.6 * scene.style.force
        canvas.add(Arrow(tail, tip, Pen.THIN, name=driver.speed))
        canvas.label(scene.words.symbol(f"V_{driver.point}", bar=True), (tail, tip))


def _frame_number(canvas: Canvas, scene: Scene, figures: Sequence[Skeleton]) -> None:
    """Letter the frame 0, once, beside the hatching of the driver's pivot or guide; keep letters off the hatching."""
    mechanism, style = scene.mechanism, scene.style
    driver, zero = mechanism.driver, scene.words.frame
    for pair in mechanism.pairs:
        if isinstance(pair, Prismatic) and FRAME in pair.links:
            at, u, (length, height) = scene.mm(pair.point), guide_of(scene, pair), style.slider
            edge = at - guide_up(scene, pair) * (height / 2 + style.hatch[0])
            canvas.keep_clear(*(at + u * (s * length * 1.1) for s in (-1, 1)), edge - u * length, edge + u * length)
            if pair.links[0] == driver.link:
                canvas.label(zero, edge + u * length, prefer=u, clear=1.0)
    if isinstance(driver, Driver):
        pivot, down = scene.mm(driver.pivot), foot_of(scene, driver.pivot, figures)
        foot, crank = pivot + down * (style.pivot[1] + style.pair), scene.mm(driver.point) - pivot
        base, across = style.pivot[2], 1j * down * (-1.0 if crank.real > 0 > crank.imag else 1.0)
        canvas.label(zero, foot + across * base / 2 + down * 0.5 * style.hatch[0], prefer=across, clear=1.0)


def axes(canvas: Canvas, scene: Scene) -> None:
    """Draw the axes of the frame's guides: past the slider, and past a pivot that is near the same line."""
    pivots = [scene.mm(point) for point in scene.mechanism.frame_points]
    pairs = [p for p in scene.mechanism.pairs if isinstance(p, Prismatic) and FRAME in p.links]
    joints = {scene.mm(pair.point) for pair in scene.mechanism.pairs}  # near them is the less room for a letter
    letters = guide_letters(scene.program)
    for pair in pairs:
        at, u, name = scene.mm(pair.point), guide_of(scene, pair), scene.solved.guide_name(pair)
        feet = [(pivot - at) / u for pivot in pivots]
        near = [foot.real for foot in feet if abs(foot.imag) < 0.3 * abs(foot.real)]
        way = near[:1] or scene.run_of(pair)
        line = at + u * (min(0.0, *way) - PAST), at + u * (max(0.0, *way) + PAST)
        canvas.add(Line(*line, Pen.AXIS))
        # of several axes the far ends meet at one pivot
        crowd = {end: len([joint for joint in joints if abs(joint - end) < 1.2 * scene.style.force]) for end in line}
        sign = 1.0 if len(pairs) > 1 else -1.0
        far = min(line, key=lambda end: (crowd[end], sign * abs(end - at)))
        canvas.label(letters.get(name, ""), far, clear=1.0, prefer=-guide_up(scene, pair))


def moving_guides(canvas: Canvas, scene: Scene, figures: Sequence[Skeleton]) -> None:
    """Letter the guides of moving links that have letters: those that no two pins name."""
    letters = guide_letters(scene.program)
    for pair in (p for p in scene.mechanism.pairs if isinstance(p, Prismatic) and FRAME not in p.links):
        letter, u = letters.get(scene.solved.guide_name(pair)), guide_of(scene, pair)
        figure = next(figure for figure in figures if figure.number == pair.links[1])
        ends = [end for stroke in figure.guides for end in stroke if abs(((end - scene.mm(pair.point)) / u).imag) < 0.1]
        if letter and ends:
            far = max(ends, key=lambda end: (min(abs(end - pin) for pin in (*figure.pins, 1e9 + 0j)), end.real))
            canvas.label(letter, far, clear=1.0)


def found_by(canvas: Canvas, scene: Scene, step: Step) -> None:
    """Draw the arcs of the compass, or the lines, that cross at a joint."""
    if role(step.name).hidden:
        return
    name = f"arc_{step.name}"
    canvas.part(step.name)
    if step.verb == "arc":
        _arc(canvas, scene, step.operands[0], step.name, 1.2 * scene.style.slider[1] + 2.0, name)
    elif step.verb == "arcs":
        _arc(canvas, scene, step.operands[0], step.name, CROSS, f"{name}_1")
        _arc(canvas, scene, step.operands[2], step.name, CROSS, f"{name}_2")
    elif step.verb == "template":  # the path that a leg leaves to its joint of the central link
        own, legs = step.operands[0], step.operands[-12:]  # joint on the template, start, radius, direction of each leg
        joint = next(i for i in (0, 4, 8) if legs[i] == own)
        start, radius, direction = legs[joint + 1 : joint + 4]
        if radius != ZERO:
            _arc(canvas, scene, start, step.name, CROSS, name)
        else:
            _line(canvas, scene, start, direction, step.name, step.name)
    elif step.verb == "tangent":
        _touched(canvas, scene, step)
    elif step.verb == "meet":
        for i in (0, 2):
            start, direction = step.operands[i : i + 2]
            _line(canvas, scene, start, direction, step.name, f"{step.name}_{i // 2 + 1}")


def _line(canvas: Canvas, scene: Scene, start: str, direction: str, point: str, name: str) -> None:
    at, e = scene.mm(point), scene.solved.point(direction)
    way = ((at - scene.mm(start)) / e).real
    past = math.copysign(2 * CROSS, way)
    ends = at - e * (way if abs(way) > 2 * CROSS else past), at + e * past
    canvas.add(Line(*ends, Pen.AXIS, role="construction", name=name))


def _arc(canvas: Canvas, scene: Scene, centre: str, point: str, past: float, name: str) -> None:
    """Draw an arc about one joint through another, `past` it on both sides, and farther where it is nearly straight.

    A vector carried to the joint lies along the tangent: the arc must leave it before it ends.
    """
    way = scene.mm(point) - scene.mm(centre)
    if way:  # else the joints coincide on paper
        past = max(past, min(math.sqrt(2.0 * abs(way) * LEAVES), LONGEST))
        spread = min(2 * past / abs(way), math.tau)
        ends = phase(way) - spread / 2, spread
        canvas.add(Arc(scene.mm(centre), abs(way), *ends, Pen.THIN, role="construction", name=name))


def _touched(canvas: Canvas, scene: Scene, step: Step) -> None:
    centre, point, offset = step.operands[:3]
    radius = abs(scene.solved.values[offset]) / scene.scales[POSITION].mu
    if radius > scene.style.pair:
        side = math.copysign(1.0, scene.solved.values[offset]) * 1j * scene.solved.point(step.name)
        ends = phase(side) - 0.7, 1.4
        canvas.add(Arc(scene.mm(centre), radius, *ends, Pen.THIN, role="construction", name=f"arc_{point}"))


def special_points(canvas: Canvas, scene: Scene, wanted: Iterable[str] | None = None) -> None:
    """Draw and letter the points of the plan that are no point of any link by right, with the lines that meet there.

    Such is the special point of a group of class III; without `wanted` all of them.
    """
    mechanism = scene.mechanism
    lettered = {point for link in mechanism.links for point in link.points} | {*mechanism.frame_points}
    for step in (step for step in scene.program.on(POSITION) if step.verb == "meet" and step.name not in lettered):
        if not role(step.name).hidden and (wanted is None or step.name in wanted):
            found_by(canvas, scene, step)
            at = scene.mm(step.name)
            canvas.add(scene.point(at, step.name))
            canvas.label(scene.words.mark(step.name), at, clear=scene.style.node + 0.8)


class Turn(NamedTuple):
    """A rate of a link read off a plan: the vector that turns its joint `end` about its joint `start`."""

    rate: str
    vector: str
    start: str
    end: str


def senses(canvas: Canvas, scene: Scene, figures: Sequence[Skeleton]) -> None:
    """Carry the vectors to the joints and draw the senses of omega and epsilon that they show.

    All else but letters has been drawn: the arcs keep clear of it.
    """
    canvas.part(ANSWERS)
    taken: dict[tuple[complex, complex], float] = {}
    shown: dict[int, list[Turn]] = {}
    for step in scene.program:
        if step.law == "turning" and not is_relative(step.name):
            (vector, normal, _), made = step.operands, scene.reading.made
            joints = made[made[normal].operands[0]].operands[:2]  # between which the direction runs whose normal it is
            e = scene.direction(vector)
            if e != 0 and scene.defined(step.name):
                turn = Turn(step.name, vector, *joints)
                shown.setdefault(role(step.name).links[0], []).append(turn)
                _carried(canvas, scene, turn, e, taken)
    for figure in figures:
        if figure.number in shown:
            _arcs(canvas, scene, shown[figure.number], figure)


def _arcs(canvas: Canvas, scene: Scene, shown: Sequence[Turn], figure: Skeleton) -> None:
    own = figure.strokes
    rays = [ray for line in own for ray in (line, line[::-1])]
    if shown[0].start in scene.mechanism.link(figure.number).points or not rays:
        rays.insert(0, (scene.mm(shown[0].start), scene.mm(shown[0].end)))
    force, wanted = scene.style.force, [PLACES[role(turn.rate).kind] for turn in shown]
    # centres of mass are drawn with their letters, later
    marks = [scene.mm(point) for link in scene.mechanism.links for point in link.points]
    busy = [*obstacles(canvas.shapes), *((at, at, scene.style.centre, 2.0) for at in marks)]
    places = place_arcs(rays, wanted, busy, force, own)
    for turn, place in zip(shown, places, strict=True):
        sense = math.copysign(1.0, scene.solved.values[turn.rate])
        canvas.add(turning_arrow(place.centre, place.radius, place.along, place.spread, sense, turn.rate))
        tip = place.centre + rect(place.radius, place.along + sense * place.spread / 2)
        prefer = rect(sense, place.along + math.pi / 2)
        canvas.label(scene.words.symbol(turn.rate), tip, prefer=prefer, clear=1.4)


def _carried(canvas: Canvas, scene: Scene, turn: Turn, e: complex, taken: dict[tuple[complex, complex], float]) -> None:
    b = scene.mm(turn.end)
    key = complex(round(b.real, 3), round(b.imag, 3)), complex(round(e.real, 6), round(e.imag, 6))
    length = 0.62 * scene.style.force + taken.get(key, 0.0)
    taken[key] = length + 0.2 * scene.style.force
    canvas.add(Arrow(b, b + e * length, Pen.THIN, name=turn.vector))
    canvas.label(scene.letter(turn.vector), (b + e * (length * 0.6), b + e * length), clear=1.0)


class Place(NamedTuple):
    """Where an arc stands: about the point `centre`, on both sides of the ray at the angle `along`."""

    centre: complex
    along: float
    radius: float
    spread: float


def place_arcs(
    rays: Sequence[Stroke], wanted: Sequence[float], busy: Sequence[Obstacle], force: float, own: Sequence[Stroke]
) -> tuple[Place, ...]:
    """Choose for the arcs of one link the ray across which they are least in the way of anything.

    Parameters
    ----------
    rays : sequence of (complex, complex)
        Lines of the link, each from the point about which arcs would be drawn, mm; the usual one first.
    wanted : sequence of float
        Where the arcs should stand, parts of the line.
    busy : sequence of Obstacle
        What is drawn; of it the lines `own` of the link along the ray are not in the way.
    force : float
        Length of the arrow of a force, mm, to which arcs are proportioned.
    """
    tries = []
    for ray in rays:  # the line of the link itself along a ray is crossed by all arcs about its start
        along = [line for line in own if _on(line, (*ray, 0.0, 0.0))]
        tries.append(_tries(ray, [one for one in busy if not any(_on(line, one) for line in along)], force))
    kept: list[list[tuple[float, int, Place]]] = []
    for share in wanted:
        found = []
        for number, (ray, (radii, spreads, costs)) in enumerate(zip(rays, tries, strict=True)):
            reach, angle = abs(ray[1] - ray[0]), phase(ray[1] - ray[0])
            cost = costs + AWAY * np.abs(radii - share * reach) / reach
            order = np.argsort(np.round(cost, 6), kind="stable")[:KEPT].tolist()
            places = (Place(ray[0], angle, float(radii[k]), float(spreads[k])) for k in order)
            found += [(round(float(cost[k]), 6), number, place) for k, place in zip(order, places, strict=True)]
        kept.append(sorted(found, key=lambda one: one[:2])[:KEPT])
    return _together(kept, APART * force)


def _together(kept: Sequence[Sequence[tuple[float, int, Place]]], apart: float) -> tuple[Place, ...]:
    """Choose one place for each arc, together the cheapest: apart, and about the usual joint, or both about another."""
    lines = [_points([place for _, _, place in one]) for one in kept]
    total = sum(np.ix_(*([cost + OTHER * (number != 0) for cost, number, _ in one] for one in kept)), start=np.zeros(1))
    for i, j in combinations(range(len(kept)), 2):
        gaps = np.abs(lines[i][:, None, :, None] - lines[j][None, :, None, :]).min(axis=(2, 3))
        centres = [np.array([place.centre for _, _, place in kept[k]]) for k in (i, j)]
        radii = [np.array([place.radius for _, _, place in kept[k]]) for k in (i, j)]
        same = centres[0][:, None] == centres[1]
        close = np.where(same, np.abs(radii[0][:, None] - radii[1]) < apart - NEAR, gaps < apart - NEAR)
        both = np.array([number for _, number, _ in kept[i]])[:, None] == np.array([n for _, n, _ in kept[j]])
        pair = 10.0 * close - OTHER * (both & (np.array([n for _, n, _ in kept[j]]) != 0))
        shape = [1] * len(kept)
        shape[i], shape[j] = pair.shape
        total = total + pair.reshape(shape)
    best = np.unravel_index(int(np.round(total, 6).argmin()), total.shape)
    return tuple(one[int(k)][2] for one, k in zip(kept, best, strict=True))


def free_arc(
    centre: complex, radii: Sequence[float], spread: float, wanted: float, busy: Sequence[Obstacle]
) -> tuple[float, float]:
    """Return radius and middle direction of an arc about a point, off all that is drawn, near `wanted`."""
    middles = wanted + np.arange(-12, 12) * (np.pi / 12)
    tries = [(radius, middle) for radius in radii for middle in middles.tolist()]
    every, angles = np.array(tries).T
    turns = np.exp(1j * (angles[:, None] + spread * np.linspace(-0.5, 0.5, SAMPLES)))
    far = 0.1 * np.abs(angles - wanted) + 0.2 * (every != radii[0])
    cost = crowd(centre + every[:, None] * turns, busy) + far
    return tries[int(np.round(cost, 6).argmin())]


def _on(line: Stroke, one: Obstacle) -> bool:
    way = line[1] - line[0]
    return abs(one[1] - one[0]) > NEAR and all(abs(((end - line[0]) / way).imag) * abs(way) < NEAR for end in one[:2])


def crowd(points: np.ndarray, busy: Sequence[Obstacle]) -> np.ndarray:
    """Return for each arc, a row of points on it, how much it is in the way of what is drawn."""
    if not busy:
        return np.zeros(len(points))
    a, b = (np.array([one[i] for one in busy]) for i in (0, 1))
    size, weight = (np.array([one[i] for one in busy], dtype=float) for i in (2, 3))
    # most obstacles are far from most arcs: only near ones are looked at point by point
    middle = points[:, points.shape[1] // 2, None]
    half = np.abs(points - middle).max(axis=1)[:, None]
    new = np.append(True, middle[1:] != middle[:-1])  # arcs of several lengths have one middle
    i, j = (_gaps(middle[new], a, b)[np.cumsum(new) - 1] - size < CLEAR + half).nonzero()
    gap = _gaps(points[i], a[j, None], b[j, None]) - size[j, None]
    # to each obstacle the nearest point counts, and much more where the arc crosses it
    close = np.zeros((len(points), len(busy)))
    close[i, j] = (np.clip(1.0 - gap / CLEAR, 0.0, 1.0) + CROSSING * (gap < CROSSED)).max(axis=1)
    return np.asarray(close @ weight)


def _gaps(points: np.ndarray, a: np.ndarray, b: np.ndarray) -> np.ndarray:
    way = b - a
    along = np.clip(((points - a) * way.conj()).real / np.maximum(np.abs(way), NEAR) ** 2, 0.0, 1.0)
    return np.asarray(np.abs(points - a - along * way))


def _tries(ray: Stroke, busy: Sequence[Obstacle], force: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return radii and spreads of arcs about the start of a ray, and how much each is in the way of what is drawn."""
    reach, along = abs(ray[1] - ray[0]), phase(ray[1] - ray[0])
    every = np.arange(NEAREST, min(max(reach - CLEAR, NEAREST + 3 * APART * force), FARTHEST), STEP)
    radii, lengths = np.repeat(every, len(LENGTHS)), np.tile(LENGTHS, len(every))
    spreads = lengths * np.minimum(0.9, 1.1 * force / radii)  # long enough to be seen as arcs
    costs = crowd(_along_arcs(np.array([ray[0]]), np.array([along]), radii, spreads), busy)
    costs += SHORTER * np.tile(range(len(LENGTHS)), len(every)) + 10.0 * (radii > reach)
    return radii, spreads, costs


def _points(places: Sequence[Place]) -> np.ndarray:
    along, spread, radius = np.array([(p.along, p.spread, p.radius) for p in places]).T
    return _along_arcs(np.array([p.centre for p in places]), along, radius, spread)


def _along_arcs(centres: np.ndarray, along: np.ndarray, radii: np.ndarray, spreads: np.ndarray) -> np.ndarray:
    """Return points along arcs, a row for each, about one centre or each about its own."""
    turns = np.exp(1j * (along[:, None] + spreads[:, None] * np.linspace(-0.5, 0.5, SAMPLES)))
    return np.asarray(centres[:, None] + radii[:, None] * turns)


def obstacles(shapes: Iterable[Shape]) -> Iterator[Obstacle]:
    """Go through what is drawn, as lines that count by their pen, and circles."""
    for shape in shapes:
        match shape:
            case Line(a=a, b=b, role="hatch"):
                yield a, b, 0.0, 1.0
            case Vector(tail=a, tip=b) | Arrow(tail=a, tip=b):
                yield a, b, 0.0, 1.0 if shape.pen is Pen.MAIN else LIGHT
            case Line() | Polyline():
                yield from ((a, b, 0.0, 1.0 if shape.pen is Pen.MAIN else LIGHT) for a, b in sides_of(shape))
            case Circle(centre=centre, radius=radius):
                yield centre, centre, radius, 1.0
            case Arc():
                yield from ((a, b, 0.0, LIGHT) for a, b in sides_of(shape))
            case Group(shapes=parts):
                yield from obstacles(parts)
            case Head() | Text():
                pass
