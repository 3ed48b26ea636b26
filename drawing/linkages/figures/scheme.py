"""The plan of the mechanism: links, pairs, guides, how joints are found, the angle of the driver, senses of turning.

The arcs of these stand where they are least in the way: about the pivot of a link radii are tried all at once, and of
each radius arcs of several lengths.
"""

from __future__ import annotations

import math
from cmath import phase, rect
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import combinations
from typing import Any, NamedTuple

import numpy as np

from ....plans.board import POSITION, Step
from ....plans.linkages.compound import is_relative
from ....plans.linkages.legs import guide_letters
from ....plans.linkages.mechanism import FRAME, ZERO, Driver, Prismatic, SlidingDriver
from ....plans.linkages.solved import SolvedLinkage
from ....plans.names import role
from ...figure import ANSWERS, GIVEN
from ...shapes import Arc, Arrow, Circle, Group, Line, Pen, Polyline, Shape, Vector, sides_of
from ...symbols import angle_dimension, dimension, turning_arrow, unit
from ...text import lay_out
from ...view import Canvas, View
from ..ladders import ON_AXIS
from ..scene import Scene
from .links import (
    NEAR,
    Skeleton,
    Stroke,
    draw_links,
    foot_of,
    guide_of,
    guide_up,
    lay_down,
    letter_links,
    letter_point,
    pins_of,
    rays_of,
    skeleton,
)
from .plan import draw_sides, said_flat

SHORT = 0.8  # lengths of the arrow of a force: across a shorter crank the arrow of omega_1 has no room
ACROSS = 0.7, 0.6, 0.8, 0.3, 0.25  # parts of a longer one at which it stands
PAST = 16.0  # mm by which the axis of a guide runs past its slider and a pivot
LEAVES, LONGEST = 1.6, 34.0  # mm by which the end of an arc leaves its tangent, unless the arc would be too long
AROUND = [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1)]  # sides of a place for a letter
UNDER = 10.0  # mm from the hatching under a slider that drives to the dimension of its travel
LEAST_ARC = 9.0  # mm, the least radius of the arc of phi
BEYOND, OVER = (5.0, 8.0, 12.0, 16.0), 2.0  # mm from a short crank to an arc beyond it, and from that to its line's end
FARTHEST_ARC = 200.0  # mm, the largest radius of an arc, however large a scale factor draws the crank
CROSS = 8.0  # mm by which arcs and lines run past the joint that they find


def scheme(scene: Scene, dead: Sequence[SolvedLinkage] = ()) -> View:
    """Draw the plan of the mechanism in the given position, and thin those at the ends of the working stroke."""
    canvas = scene.canvas()
    canvas.part(GIVEN)
    draw_axes(canvas, scene)
    notes = _dead_positions(canvas, scene, dead)
    for step in scene.program.on(POSITION):
        if step.name in scene.points or step.verb == "tangent":
            _found_by(canvas, scene, step)
    special_points(canvas, scene)
    draw_sides(canvas, scene, POSITION, [stroke for n in scene.numbers for stroke in skeleton(scene, n).strokes])
    figures = draw_links(canvas, scene, scene.numbers)
    draw_driver(canvas, scene)
    senses(canvas, scene, figures)
    canvas.part(GIVEN)
    letter_axes(canvas, scene)
    letter_frame(canvas, scene, figures)
    letter_links(canvas, scene, figures)
    return canvas.finish(
        "position", scene.heading("heading.position", "position"), (*notes, *said_flat(scene, POSITION))
    )


def draw_driver(canvas: Canvas, scene: Scene) -> None:
    """Draw where the driver stands, and which way it moves."""
    driver = scene.mechanism.driver
    canvas.part(driver.point)
    if isinstance(driver, Driver):
        _angle(canvas, scene, driver)
        return
    _travel(canvas, scene, driver)
    if speed := scene.values[driver.speed]:
        canvas.part(ANSWERS)
        pair = scene.sliding(driver.link)[0]
        up, e = guide_up(scene, pair), guide_of(scene, pair) * math.copysign(1.0, speed)
        tail = scene.mm(pair.point) + up * (scene.style.slider[1] / 2 + 3.0) - e * (0.3 * scene.style.force)
        tip = tail + e * 0.6 * scene.style.force
        canvas.add(Arrow(tail, tip, name=driver.speed))
        canvas.label(scene.letter(f"V_{driver.point}"), (tail, tip))


def _travel(canvas: Canvas, scene: Scene, driver: SlidingDriver) -> None:
    """Dimension the travel of a driver that slides from the place where it is zero."""
    style, pair, travel = scene.style, scene.sliding(driver.link)[0], scene.values[driver.travel]
    at, down = scene.mm(pair.point), -guide_up(scene, pair)
    zero = at - guide_of(scene, pair) * travel / scene.scales[POSITION].mu
    low = down * (style.slider[1] / 2 + 2.0 * style.pair + UNDER)
    for end in (zero, at) if travel else (zero,):
        begin = end + down * (style.slider[1] / 2 if end == at else -OVER)
        canvas.add(Line(begin, end + low + down * OVER, Pen.THIN, role="extension", name=driver.travel))
    text = f"{scene.words.symbol(driver.travel)} = {scene.words.short(round(travel * 1e3, 9))}"
    if travel:
        canvas.add(dimension(zero + low, at + low, driver.travel, style))
    canvas.label(text, (zero + low, at + low) if travel else zero + low, prefer=down)


def _dead_positions(canvas: Canvas, scene: Scene, dead: Sequence[SolvedLinkage]) -> tuple[str, ...]:
    """Draw the mechanism where the working stroke begins, its zero position, and ends; return what the notes say."""
    words, places = scene.words, list[str]()
    canvas.part(ANSWERS)
    joints = dict.fromkeys(pair.point for pair in scene.mechanism.pairs if FRAME not in pair.links)
    for solved, index in zip(dead, ("0", words["dead.end"]), strict=False):
        stand = replace(scene, solved=solved, runs={})
        lay_down(canvas, stand, Pen.EXTREME, "dead-position")
        for point in joints:
            at = stand.mm(point)
            away = at - scene.mm(point)
            canvas.small(f"{words.mark(point)}_{{{index}}}", at, away, scene.style.node + 0.6)
        driver = solved.mechanism.driver
        place = solved.values[driver.coordinate]
        turned = f"{words.number(math.degrees(place), 2)}°"
        places.append(turned if isinstance(driver, Driver) else f"{words.number(place * 1e3, 2)} {words.unit('mm')}")
    canvas.part(GIVEN)
    symbol = words.symbol(scene.mechanism.driver.coordinate)
    return (
        tuple(words["said.dead_ends"].format(symbol=symbol, begin=places[0], end=places[1]).split("|")) if dead else ()
    )


def _angle(canvas: Canvas, scene: Scene, driver: Driver) -> None:
    """Dimension phi from the axis x, and draw the arrows of omega_1 and epsilon_1 on the other side."""
    o, style = scene.mm(driver.pivot), scene.style
    crank_mm = abs(scene.mm(driver.point) - o)
    phi = math.remainder(scene.values[driver.angle], 2 * math.pi)
    phi = phi + 2 * math.pi if phi < -1e-12 else phi
    radius = _dimension_radius(canvas, scene, driver, phi)
    _dimensioned(canvas, scene, driver, phi, radius)
    if crank_mm > max(SHORT * style.force, 2.0 * radius):  # across the crank, else beyond it on its other side
        reach, wanted = min(crank_mm, CURVED / ACROSS[0]), phi
        radii = tuple(reach * part for part in ACROSS if reach * part > NEAREST * style.force)
    else:
        wanted = phi + math.pi * 0.78 if phi < math.pi else phi / 2 + math.pi * 0.86
        radii = tuple((radius + 5.0) * part for part in (1.0, 0.75, 1.3, 1.6))
    spread = min(1.0, max(TURNED[0], 1.1 * style.force / radii[0]))
    turning_of_driver(canvas, scene, driver, radii, spread, wanted)


def _dimensioned(canvas: Canvas, scene: Scene, driver: Driver, phi: float, radius: float) -> None:
    """Dimension phi on an arc of this radius, or on one beyond a short crank where links leave its text no room."""
    o, style = scene.mm(driver.pivot), scene.style
    crank_mm = abs(scene.mm(driver.point) - o)
    text = f"{scene.words.symbol(driver.angle)} = {scene.words.short(round(math.degrees(phi), 9))}°"
    size, turned = lay_out(text, style.label).size, phi > 0.05
    if turned and canvas.clear(_beside_arc(o, radius, phi, size), size) is None:
        beyond = (crank_mm + more for more in BEYOND)
        radius = next((r for r in beyond if _is_free(canvas, o, r, phi, size)), radius)
        if radius > crank_mm:
            near, far = (o + rect(reach, phi) for reach in (crank_mm + style.pair, radius + OVER))
            canvas.add(Line(near, far, Pen.THIN, role="extension", name=driver.angle))
    zero = o + max(crank_mm, radius + 6.0) * 1.1
    canvas.add(Line(o + style.pair, zero, Pen.THIN, role="zero-direction", name=driver.angle))
    if turned:
        canvas.add(angle_dimension(o, radius, 0.0, phi, driver.angle, style))
        middle = o + rect(radius, min(phi / 2, 1.2))
        canvas.label(text, middle, prefer=rect(1.0, phi / 2), clear=1.2)
    else:
        canvas.label(text, o + radius, prefer=1j, clear=1.2)


def _beside_arc(o: complex, radius: float, phi: float, size: tuple[float, float]) -> list[complex]:
    """Return places of a text of this size beyond an arc from the axis x."""
    rays = [rect(1.0, share * phi) for share in (0.5, 0.35, 0.65, 0.2, 0.8)]
    reaches = (0.5 * (abs(ray.real) * size[0] + abs(ray.imag) * size[1]) for ray in rays)
    return [o + ray * (radius + 1.2 + reach) for ray, reach in zip(rays, reaches, strict=True)]


def _is_free(canvas: Canvas, o: complex, radius: float, phi: float, size: tuple[float, float]) -> bool:
    """Whether nothing drawn lies on an arc from the axis x, and a text has room beyond it."""
    on = (o + rect(radius, share * phi) for share in np.linspace(0.0, 1.0, 2 + round(radius * phi / 2.0)))
    free = canvas.clear(_beside_arc(o, radius, phi, size), size) is not None
    return free and all(canvas.clear([at], (0.1, 0.1)) is not None for at in on)


def _dimension_radius(canvas: Canvas, scene: Scene, driver: Driver, phi: float) -> float:
    """Return the radius of the arc that dimensions phi: near the middle of the crank, off supports and other links."""
    o, own = scene.mm(driver.pivot), str(driver.link)
    crank_mm = abs(scene.mm(driver.point) - o)
    usual = min(max(0.45 * crank_mm, LEAST_ARC), FARTHEST_ARC)
    most = min(crank_mm - 2.0 * scene.style.pair, FARTHEST_ARC)
    radii = np.array([usual, *np.arange(LEAST_ARC, most, STEP)])
    turns = np.exp(1j * phi * np.linspace(0.0, 1.0, 1 + max(len(ALONG), round(usual * phi / CROSSED))))
    things = (shape for shape in canvas.shapes if not (isinstance(shape, Group) and shape.name == own))
    crowd = _crowd((o + radii[:, None] * turns)[:, None], list(_obstacles(things)))[:, 0]
    return float(radii[int(np.round(crowd + AWAY * np.abs(radii - usual) / usual, 6).argmin())])


def letter_frame(canvas: Canvas, scene: Scene, figures: Sequence[Skeleton]) -> None:
    """Letter the frame 0, once, beside the hatching of the driver's pivot or guide; keep letters off the hatching.

    The guides of moving links, too, have their letters: those that no two pins name.
    """
    mechanism, style, zero = scene.mechanism, scene.style, scene.words.frame
    driver, letters = mechanism.driver, guide_letters(scene.program)
    for pair in scene.sliding():
        u, (length, height) = guide_of(scene, pair), style.slider
        edge = scene.mm(pair.point) - guide_up(scene, pair) * (height / 2 + style.hatch[0])
        at = scene.mm(pair.point)
        canvas.keep_clear(*(at + u * (s * length * 1.1) for s in (-1, 1)), edge - u * length, edge + u * length)
        if pair.links[0] == driver.link:
            canvas.label(zero, edge + u * length, prefer=u)
    if isinstance(driver, Driver):
        pivot, down = scene.mm(driver.pivot), foot_of(scene, driver.pivot, figures)
        foot, crank = pivot + down * (style.pivot[1] + style.pair), scene.mm(driver.point) - pivot
        base, across = style.pivot[2], 1j * down * (-1.0 if crank.real > 0 > crank.imag else 1.0)
        # beside the end of the hatching that lines of links leave freer: another would stand at a link
        corners = {side: foot + side * base / 2 + down * 0.5 * style.hatch[0] for side in (across, -across)}
        room = {side: _clear_of(end, (line for f in figures for line in f.strokes)) for side, end in corners.items()}
        across = max(corners, key=lambda side: min(room[side], base / 2))
        canvas.label(zero, corners[across], prefer=across)
    for pair in (pair for pair in mechanism.pairs if isinstance(pair, Prismatic) and FRAME not in pair.links):
        letter, u, at = letters.get(scene.solved.guide_name(pair)), guide_of(scene, pair), scene.mm(pair.point)
        figure = next(figure for figure in figures if figure.number == pair.links[1])
        ends = [end for stroke in figure.guides for end in stroke if abs(((end - at) / u).imag) < 0.1]
        if letter and ends:
            far = max(ends, key=lambda end: (min(abs(end - pin) for pin in (*figure.pins, 1e9 + 0j)), end.real))
            canvas.label(letter, far)


def _clear_of(at: complex, lines: Iterable[Stroke]) -> float:
    """Return how far a place is from lines, mm."""
    return min((float(_gaps(np.array([at]), np.array([a]), np.array([b]))[0]) for a, b in lines), default=math.inf)


def draw_axes(canvas: Canvas, scene: Scene) -> None:
    """Draw the axes of the frame's guides: past the slider, and past a pivot that is near the same line."""
    for pair in scene.sliding():
        at, u = scene.mm(pair.point), guide_of(scene, pair)
        feet = [(scene.mm(point) - at) / u for point in scene.mechanism.frame_points]
        near = [foot.real for foot in feet if abs(foot.imag) < ON_AXIS * abs(foot.real)]
        way = near[:1] or scene.run_of(pair)
        canvas.add(Line(at + u * (min(0.0, *way) - PAST), at + u * (max(0.0, *way) + PAST), Pen.AXIS))


def letter_axes(canvas: Canvas, scene: Scene) -> None:
    """Letter the axes of the frame's guides at one end of all that is drawn on them: that with more room."""
    pairs, letters = scene.sliding(), guide_letters(scene.program)
    centres = {link.centre for link in scene.mechanism.links if link.centre}
    nodes = {scene.mm(name) for name in centres | {pair.point for pair in scene.mechanism.pairs}}  # have letters, too
    axes = [(line.a, line.b) for line in canvas.shapes if isinstance(line, Line) and line.pen is Pen.AXIS]
    for pair in pairs:
        at, u = scene.mm(pair.point), guide_of(scene, pair)
        own = [end for line in axes if all(abs(((end - at) / u).imag) < NEAR for end in line) for end in line]
        line = [choose(own, key=lambda end: ((end - at) / u).real) for choose in (min, max)]
        # near a node there is less room; of several axes the far ends meet at one pivot
        crowd = {end: len([node for node in nodes if abs(node - end) < 1.2 * scene.style.force]) for end in line}
        sign = 1.0 if len(pairs) > 1 else -1.0
        far = min(line, key=lambda end: (crowd[end], sign * abs(end - at)))
        canvas.label(letters.get(scene.solved.guide_name(pair), ""), far, prefer=-guide_up(scene, pair))


def _found_by(canvas: Canvas, scene: Scene, step: Step) -> None:
    """Draw the arcs of the compass, or the lines, that cross at a joint."""
    if role(step.name).hidden:
        return
    canvas.part(step.name)
    operands, arc, past = step.operands, f"arc_{step.name}", CROSS
    ways: list[tuple[str, str, str]] = []  # where an arc or a line comes from, the direction of a line, its name
    if step.verb == "arc":
        ways, past = [(operands[0], "", arc)], 1.2 * scene.style.slider[1] + 2.0
    elif step.verb == "arcs":
        ways = [(operands[0], "", f"{arc}_1"), (operands[2], "", f"{arc}_2")]
    elif step.verb == "template":  # the path that a leg leaves to its joint of the central link
        own, legs = operands[0], operands[-12:]  # joint on the template, start, radius, direction of each leg
        joint = next(i for i in (0, 4, 8) if legs[i] == own)
        start, radius, direction = legs[joint + 1 : joint + 4]
        ways = [(start, "", arc) if radius != ZERO else (start, direction, step.name)]
    elif step.verb == "meet":
        ways = [(operands[i], operands[i + 1], f"{step.name}_{i // 2 + 1}") for i in (0, 2)]
    elif step.verb == "tangent":
        centre, point, offset = operands[:3]
        radius = scene.values[offset] / scene.scales[POSITION].mu
        if abs(radius) > scene.style.pair:
            side = math.copysign(1.0, radius) * 1j * scene.solved.point(step.name)
            ends = phase(side) - 0.7, 1.4
            canvas.add(Arc(scene.mm(centre), abs(radius), *ends, role="construction", name=f"arc_{point}"))
    for start, direction, name in ways:
        at, way = scene.mm(step.name), scene.mm(step.name) - scene.mm(start)
        if direction:
            e = scene.solved.point(direction)
            along = (way / e).real
            beyond = math.copysign(2 * CROSS, along)
            start_at = at - e * (along if abs(along) > 2 * CROSS else beyond)
            canvas.add(Line(start_at, at + e * beyond, Pen.AXIS, role="construction", name=name))
        elif way:  # else the joints coincide on paper
            # a vector carried to the joint lies along the tangent: the arc must leave it before it ends
            reach = max(past, min(math.sqrt(2.0 * abs(way) * LEAVES), LONGEST))
            spread = min(2 * reach / abs(way), math.tau)
            ends = phase(way) - spread / 2, spread
            canvas.add(Arc(scene.mm(start), abs(way), *ends, role="construction", name=name))


def special_points(canvas: Canvas, scene: Scene, wanted: Iterable[str] | None = None) -> None:
    """Draw and letter the points of the plan that are no point of any link by right, with the lines that meet there.

    Such is the special point of a group of class III; without `wanted` all of them.
    """
    lettered = {*scene.points, *scene.mechanism.frame_points}
    for step in (step for step in scene.program.on(POSITION) if step.verb == "meet" and step.name not in lettered):
        if not role(step.name).hidden and (wanted is None or step.name in wanted):
            _found_by(canvas, scene, step)
            letter_point(canvas, scene, step.name)


PLACES = {"omega": 0.40, "epsilon": 0.55}  # parts of the link at which its arcs stand
CLEAR = 3.5  # mm that should be left between an arc and what it passes
CROSSED, CROSSING = 1.2, 3.0  # mm between points of an arc that crosses a line and the line; what that costs
APART = 0.25  # lengths of the arrow of a force between two arcs about one joint
NEAREST, STEP = 0.5, 1.0  # of these from the joint: the least radius; mm between radii that are tried
CURVED = 60.0  # mm: a larger arc looks straight
ALONG = np.linspace(-0.5, 0.5, 13)  # parts of an arc from its middle where its neighbours are looked for
MIDDLE = len(ALONG) // 2
LENGTHS, SHORTER = (1.0, 0.75, 0.5), 0.3  # of an arc, and the cost of each step shorter
TURNED = 0.4, 1.3  # rad, the least and the largest spread of an arc that is seen as one
LIGHT = 0.35  # how much a thin line counts beside a main one
AWAY, OTHER = 1.5, 0.4  # cost of a place a whole link away from the wanted one, and of a line that was not wanted
PASSED, TAKEN = 10.0, 1e3  # cost of a place beyond the end of the link, and of one where the other arc is
Obstacle = tuple[complex, complex, float, float]  # ends, how far it reaches about itself, how much it counts


class _Turn(NamedTuple):
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
    made, force = scene.made, scene.style.force
    taken: dict[tuple[complex, complex], float] = {}  # mm that vectors take at a joint in a direction
    turns: dict[int, list[_Turn]] = {}
    for step in scene.program:
        if step.law != "turning" or is_relative(step.name):
            continue
        vector, normal, _ = step.operands
        e = scene.direction(vector)
        if e == 0 or not scene.defined(step.name):
            continue
        # the joints between which the direction runs whose normal the law takes
        turn = _Turn(step.name, vector, *made[made[normal].operands[0]].operands[:2])
        turns.setdefault(role(step.name).links[0], []).append(turn)
        end = scene.mm(turn.end)
        key = complex(round(end.real, 3), round(end.imag, 3)), complex(round(e.real, 6), round(e.imag, 6))
        length = 0.62 * force + taken.get(key, 0.0)
        taken[key] = length + 0.2 * force
        canvas.add(Arrow(end, end + e * length, name=vector))
        letter = scene.letter(vector)
        canvas.label(letter, (end + e * (length * 0.6), end + e * length), last=scene.hung(letter, turn.end))
    for figure in figures:
        if figure.number in turns:
            rates = {turn.rate: scene.values[turn.rate] for turn in turns[figure.number]}
            _arcs(canvas, scene, rates, _arms(scene, turns[figure.number][0], figure), figure)


def _arcs(canvas: Canvas, scene: Scene, rates: Mapping[str, float], rays: Sequence[Stroke], figure: Skeleton) -> None:
    """Draw the senses of rates of a link across its lines, about the starts of these."""
    # centres of mass are drawn with their letters, later; a joint counts for each of its links
    marks = [scene.mm(point) for link in scene.mechanism.links for point in link.points]
    busy = [*_obstacles(canvas.shapes), *((at, at, scene.style.centre, 2.0) for at in marks)]
    wanted = [PLACES[role(rate).kind] for rate in rates]
    places = _places(rays, wanted, busy, scene.style.force, figure.strokes)
    for (rate, value), (centre, along, radius, spread) in zip(rates.items(), places, strict=True):
        sense = math.copysign(1.0, value)
        canvas.add(turning_arrow(centre, radius, along, spread, sense, rate))
        letter, ahead = scene.words.symbol(rate), rect(sense, along + math.pi / 2)
        wide, high = size = lay_out(letter, scene.style.label).size
        ends = {way: centre + rect(radius, along + way * sense * spread / 2) for way in (1.0, -1.0)}
        sides = [complex(x * (0.5 * wide + 1.4), y * (0.5 * high + 1.4)) for x, y in AROUND]
        # behind the arrow where links leave no room before it
        way = next((way for way, end in ends.items() if canvas.clear([end + by for by in sides], size)), 1.0)
        canvas.label(letter, ends[way], prefer=way * ahead, clear=1.4)


def _arms(scene: Scene, turn: _Turn, figure: Skeleton) -> list[Stroke]:
    """Return the lines of a link from the point about which its arcs are drawn, the usual one first.

    That is its fixed pivot: about a joint that moves arcs would show the opposite sense beside the vectors of the link.
    Without a pivot it is the joint about which the vector is carried, or that of the link nearest to it.
    """
    start, end, pins = scene.mm(turn.start), scene.mm(turn.end), pins_of(scene, figure.number)
    still = [scene.mm(pin) for pin in pins if pin in scene.mechanism.frame_points]
    about = min(still or figure.nodes, key=lambda node: abs(node - start))
    way = next((unit(at - about) for at in (end, start) if abs(at - about) > NEAR), 1.0 + 0.0j)
    rays = sorted(rays_of(about, figure.strokes), key=lambda ray: abs(phase(ray / way)))
    return [(about, about + ray * _reach(about, ray, figure.strokes)) for ray in rays] or [(about, end)]


def _reach(start: complex, e: complex, lines: Iterable[Stroke]) -> float:
    """Return how far the ends of lines on a ray are from its start, mm."""
    return max(((end - start) / e).real for line in lines for end in line if abs(((end - start) / e).imag) < NEAR)


def _places(
    rays: Sequence[Stroke], wanted: Sequence[float], busy: Sequence[Obstacle], force: float, own: Sequence[Stroke]
) -> list[tuple[complex, float, float, float]]:
    """Choose for the arcs of one link where they are least in the way of anything, and not of one another.

    The `rays` are lines of the link, mm, each from the point about which arcs would be drawn, the usual one first; arcs
    should stand at the `wanted` parts of them. Of what is drawn, `busy`, the lines `own` of the link along the ray are
    not in the way; arcs are proportioned to the arrow of a `force`, mm. Returned are centre, direction of the middle,
    radius and spread of each arc.
    """
    tries = []
    for number, (start, end) in enumerate(rays):
        reach, angle, near = abs(end - start), phase(end - start), NEAREST * force
        every = np.arange(near, min(max(reach - CLEAR, near + 3 * APART * force), CURVED), STEP)
        spreads = np.clip(np.array(LENGTHS) * 1.1 * force / every[:, None], *TURNED)
        radii = np.repeat(every[:, None], len(LENGTHS), axis=1)
        points = _points(start, radii, angle, spreads)
        # the line of the link itself along a ray is crossed by all arcs about its start
        along = [line for line in own if _on(line, (start, end))]
        costs = _crowd(points, [thing for thing in busy if not any(_on(line, thing[:2]) for line in along)])
        costs += SHORTER * np.arange(len(LENGTHS)) + PASSED * (radii > reach) + OTHER * (number != 0)
        columns = start, angle, min(reach, CURVED), radii, spreads, costs
        tries.append([np.broadcast_to(column, costs.shape).ravel() for column in columns])
    centres, angles, reaches, radii, spreads, costs = map(np.concatenate, zip(*tries, strict=True))
    totals = [costs + AWAY * np.abs(radii - share * reaches) / reaches for share in wanted]
    total: Any = sum(np.ix_(*totals))
    taken = TAKEN * (np.abs(radii[:, None] - radii) < APART * force - NEAR)
    for i, j in combinations(range(len(wanted)), 2):
        total = total + np.expand_dims(taken, [axis for axis in range(len(wanted)) if axis not in (i, j)])
    chosen = np.unravel_index(int(np.round(total, 6).argmin()), total.shape)
    return [(complex(centres[k]), float(angles[k]), float(radii[k]), float(spreads[k])) for k in chosen]


def free_arc(
    centre: complex, radii: Sequence[float], spread: float, wanted: float, shapes: Iterable[Shape]
) -> tuple[float, float]:
    """Return radius and middle direction of an arc about a point, off all that is drawn, near `wanted`.

    The first of the radii is the usual one.
    """
    middles = wanted + np.arange(-12, 12) * (np.pi / 12)
    radius, middle = (grid.reshape(-1, 1) for grid in np.meshgrid(radii, middles, indexing="ij"))
    far = 0.1 * np.abs(middle - wanted) + 0.2 * (radius != radii[0])
    cost = _crowd(_points(centre, radius, middle, spread), list(_obstacles(shapes))) + far
    best = int(np.round(cost, 6).argmin())
    return float(radius[best, 0]), float(middle[best, 0])


def turning_of_driver(
    canvas: Canvas, scene: Scene, driver: Driver, radii: Sequence[float], spread: float, wanted: float
) -> None:
    """Draw the arrows of omega_1 and epsilon_1 about the pivot where there is room, near the direction `wanted`."""
    o = scene.mm(driver.pivot)
    own = {id(shape) for shape in canvas.shapes if isinstance(shape, Group) and shape.name == str(driver.link)}
    canvas.part(ANSWERS)
    for name, turn in _rates(scene, driver).items():
        around = (shape for shape in canvas.shapes if id(shape) not in own)  # it may cross the crank
        radius, middle = free_arc(o, radii, spread, wanted, around)
        canvas.add(turning_arrow(o, radius, middle, spread, math.copysign(1.0, turn), name))
        canvas.label(scene.words.symbol(name), o + rect(radius, middle), prefer=rect(1.0, middle))


def _rates(scene: Scene, driver: Driver) -> dict[str, float]:
    """Return omega and epsilon of the driver, those that are not zero; of one that stands still its sense."""
    omega, epsilon = (f"{kind}_{driver.link}" for kind in ("omega", "epsilon"))
    rates = {omega: scene.values.get(omega) or scene.values[driver.sense], epsilon: scene.values.get(epsilon)}
    return {name: rate for name, rate in rates.items() if rate}


def _points(centre: complex, radii: Any, angles: Any, spreads: Any) -> np.ndarray:
    """Return points along arcs about a centre, behind the axes of the other arguments; their middles in the middle."""
    turns = np.exp(1j * (np.asarray(angles)[..., None] + np.asarray(spreads)[..., None] * ALONG))
    return np.asarray(centre + radii[..., None] * turns)


def _on(line: Stroke, other: Stroke) -> bool:
    way = line[1] - line[0]
    return abs(other[1] - other[0]) > NEAR and all(abs(((end - line[0]) / way).imag) * abs(way) < NEAR for end in other)


def _crowd(points: np.ndarray, busy: Sequence[Obstacle]) -> np.ndarray:
    """Return how much arcs are in the way of what is drawn; arcs of several lengths have one middle.

    `points` has axes for places, lengths and the points of an arc; the result has the first two.
    """
    if not busy:
        return np.zeros(points.shape[:2])
    a, b, size, weight = (np.array(column) for column in zip(*busy, strict=True))
    # most obstacles are far from most arcs: only near ones are looked at point by point
    middle = points[:, :1, MIDDLE]
    half = np.abs(points - middle[..., None]).max(axis=2)[..., None]
    i, k, j = ((_gaps(middle, a, b) - size)[:, None] < CLEAR + half).nonzero()
    gap = _gaps(points[i, k], a[j, None], b[j, None]) - size[j, None]
    # to each obstacle the nearest point counts, and much more where the arc crosses it
    close = np.zeros((*points.shape[:2], len(busy)))
    close[i, k, j] = (np.clip(1.0 - gap / CLEAR, 0.0, 1.0) + CROSSING * (gap < CROSSED)).max(axis=1)
    return np.asarray(close @ weight)


def _gaps(points: np.ndarray, a: np.ndarray, b: np.ndarray) -> np.ndarray:
    way = b - a
    along = np.clip(((points - a) * way.conj()).real / np.maximum(np.abs(way), NEAR) ** 2, 0.0, 1.0)
    return np.asarray(np.abs(points - a - along * way))


def _obstacles(shapes: Iterable[Shape]) -> Iterator[Obstacle]:
    """Go through what is drawn, as lines that count by their pen, and circles."""
    for shape in shapes:
        match shape:
            case Group(shapes=parts):
                yield from _obstacles(parts)
            case Circle(centre=centre, radius=radius):
                yield centre, centre, radius, 1.0
            case Vector(tail=a, tip=b) | Arrow(tail=a, tip=b):
                yield a, b, 0.0, 1.0 if shape.pen is Pen.MAIN else LIGHT
            case Line() | Polyline() | Arc():
                main = shape.role == "hatch" or (shape.pen is Pen.MAIN and not isinstance(shape, Arc))
                yield from ((*side, 0.0, 1.0 if main else LIGHT) for side in sides_of(shape))
