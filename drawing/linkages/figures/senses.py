"""Senses of turning: arcs of omega and epsilon on the links, and the vectors carried to their joints that show them."""

from __future__ import annotations

import math
from cmath import phase, rect
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations, pairwise

import numpy as np

from ....plans.linkages.compound import is_relative
from ....plans.names import role
from ...figure import ANSWERS
from ...shapes import Arc, Arrow, Circle, Group, Head, Line, Pen, Polyline, Shape, Text, Vector
from ...symbols import turning_arrow
from ...view import Canvas
from ..scene import Scene
from ..skeleton import NEAR, Skeleton, Stroke

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


@dataclass(frozen=True, slots=True)
class Turn:
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
            vector, normal, _ = step.operands
            # the direction whose normal it is runs from one joint to another
            joints = scene.reading.made[scene.reading.made[normal].operands[0]].operands[:2]
            e = scene.direction(vector)
            if e != 0 and scene.defined(step.name):
                turn = Turn(step.name, vector, *joints)
                shown.setdefault(role(step.name).links[0], []).append(turn)
                _carried(canvas, scene, turn, e, taken)
    for figure in figures:
        if figure.number in shown:
            _arcs(canvas, scene, shown[figure.number], figure)


def _arcs(canvas: Canvas, scene: Scene, shown: Sequence[Turn], figure: Skeleton) -> None:
    """Draw the arcs of one link across one of its lines, that between the joints of the rate if there is one."""
    ends, own = (scene.mm(shown[0].start), scene.mm(shown[0].end)), figure.strokes
    rays = [ray for line in own for ray in (line, line[::-1])]
    belongs = shown[0].start in scene.mechanism.link(figure.number).points
    if belongs or not rays:
        rays.insert(0, ends)
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
    """Draw the vector at the joint that it turns, beyond another one on the same ray."""
    b = scene.mm(turn.end)
    key = complex(round(b.real, 3), round(b.imag, 3)), complex(round(e.real, 6), round(e.imag, 6))
    start = taken.get(key, 0.0)
    length = 0.62 * scene.style.force + start
    taken[key] = length + 0.2 * scene.style.force
    canvas.add(Arrow(b, b + e * length, Pen.THIN, name=turn.vector))
    canvas.label(scene.letter(turn.vector), (b + e * (length * 0.6), b + e * length), clear=1.0)


@dataclass(frozen=True, slots=True)
class Place:
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
    angles = np.array([middle for _, middle in tries])[:, None] + spread * np.linspace(-0.5, 0.5, SAMPLES)
    points = centre + np.array([radius for radius, _ in tries])[:, None] * np.exp(1j * angles)
    away = np.array([abs(middle - wanted) for _, middle in tries])
    first = np.array([radius != radii[0] for radius, _ in tries])
    cost = crowd(points, busy) + 0.1 * away + 0.2 * first
    return tries[int(np.round(cost, 6).argmin())]


def _on(line: Stroke, one: Obstacle) -> bool:
    """Whether an obstacle lies along a line."""
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
    result: np.ndarray = close @ weight
    return result


def _gaps(points: np.ndarray, a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Return how far points are from the lines from `a` to `b`."""
    way = b - a
    along = np.clip(((points - a) * way.conj()).real / np.maximum(np.abs(way), NEAR) ** 2, 0.0, 1.0)
    gaps: np.ndarray = np.abs(points - a - along * way)
    return gaps


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
    """Return points along arcs, a row for each."""
    along, spread, radius = np.array([(p.along, p.spread, p.radius) for p in places]).T
    return _along_arcs(np.array([p.centre for p in places]), along, radius, spread)


def _along_arcs(centres: np.ndarray, along: np.ndarray, radii: np.ndarray, spreads: np.ndarray) -> np.ndarray:
    """Return points along arcs, a row for each, about one centre or each about its own."""
    turns = np.exp(1j * (along[:, None] + spreads[:, None] * np.linspace(-0.5, 0.5, SAMPLES)))
    points: np.ndarray = centres[:, None] + radii[:, None] * turns
    return points


def obstacles(shapes: Iterable[Shape]) -> Iterator[Obstacle]:
    """Go through what is drawn, as lines that count by their pen, and circles."""
    for shape in shapes:
        match shape:
            case Line(a=a, b=b, role="hatch"):
                yield a, b, 0.0, 1.0
            case Line(a=a, b=b) | Vector(tail=a, tip=b) | Arrow(tail=a, tip=b):
                yield a, b, 0.0, 1.0 if shape.pen is Pen.MAIN else LIGHT
            case Polyline(points=points, closed=closed):
                ends = (*points, points[0]) if closed else points
                yield from ((a, b, 0.0, 1.0 if shape.pen is Pen.MAIN else LIGHT) for a, b in pairwise(ends))
            case Circle(centre=centre, radius=radius):
                yield centre, centre, radius, 1.0
            case Arc(centre=centre, radius=radius, start=start, sweep=sweep):
                ends = tuple(centre + rect(radius, start + sweep * k / 8) for k in range(9))
                yield from ((a, b, 0.0, LIGHT) for a, b in pairwise(ends))
            case Group(shapes=parts):
                yield from obstacles(parts)
            case Head() | Text():
                pass
