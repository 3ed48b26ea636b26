"""Senses of turning on the plan of the mechanism: the vectors that show them, and arcs where they are least in the way.

Places for arcs are tried all at once: about each joint of a link radii, and of each radius arcs of several lengths.
"""

from __future__ import annotations

import math
from cmath import phase, rect
from collections.abc import Iterable, Iterator, Sequence
from itertools import combinations
from typing import Any, NamedTuple

import numpy as np

from ....plans.linkages.compound import is_relative
from ....plans.linkages.mechanism import Driver
from ....plans.names import role
from ...figure import ANSWERS
from ...shapes import Arc, Arrow, Circle, Group, Line, Pen, Polyline, Shape, Vector, sides_of
from ...symbols import turning_arrow
from ...view import Canvas
from ..scene import Scene
from .links import NEAR, Skeleton, Stroke

PLACES = {"omega": 0.30, "epsilon": 0.45}  # parts of the link at which its arcs stand
CLEAR = 3.5  # mm that should be left between an arc and what it passes
CROSSED, CROSSING = 1.2, 3.0  # mm between points of an arc that crosses a line and the line; what that costs
APART = 0.25  # lengths of the arrow of a force between two arcs about one joint
NEAREST, STEP = 14.0, 1.0  # mm from the joint: the least radius, and between radii that are tried
FARTHEST = 1200.0  # mm: on no sheet two points are so far apart
ALONG = np.linspace(-0.5, 0.5, 13)  # parts of an arc from its middle where its neighbours are looked for
MIDDLE = len(ALONG) // 2
LENGTHS, SHORTER = (1.0, 0.6, 0.4), 0.3  # of an arc, and the cost of each step shorter
LIGHT = 0.35  # how much a thin line counts beside a main one
KEPT = 24  # places of each arc, the cheapest, that are looked at together
AWAY, OTHER = 1.5, 0.4  # cost of a place a whole link away from the wanted one, and of a line that was not wanted
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
        canvas.label(scene.letter(vector), (end + e * (length * 0.6), end + e * length))
    for figure in figures:
        if figure.number in turns:
            _arcs(canvas, scene, turns[figure.number], figure)


def _arcs(canvas: Canvas, scene: Scene, turns: Sequence[_Turn], figure: Skeleton) -> None:
    rays = [ray for line in figure.strokes for ray in (line, line[::-1])]
    if turns[0].start in scene.mechanism.link(figure.number).points or not rays:
        rays.insert(0, (scene.mm(turns[0].start), scene.mm(turns[0].end)))
    # centres of mass are drawn with their letters, later; a joint counts for each of its links
    marks = [scene.mm(point) for link in scene.mechanism.links for point in link.points]
    busy = [*_obstacles(canvas.shapes), *((at, at, scene.style.centre, 2.0) for at in marks)]
    wanted = [PLACES[role(turn.rate).kind] for turn in turns]
    places = _places(rays, wanted, busy, scene.style.force, figure.strokes)
    for (rate, *_), (centre, along, radius, spread) in zip(turns, places, strict=True):
        sense = math.copysign(1.0, scene.values[rate])
        canvas.add(turning_arrow(centre, radius, along, spread, sense, rate))
        tip = centre + rect(radius, along + sense * spread / 2)
        canvas.label(scene.words.symbol(rate), tip, prefer=rect(sense, along + math.pi / 2), clear=1.4)


def _places(
    rays: Sequence[Stroke], wanted: Sequence[float], busy: Sequence[Obstacle], force: float, own: Sequence[Stroke]
) -> list[tuple[complex, float, float, float]]:
    """Choose for the arcs of one link where they are least in the way of anything, and not of one another.

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

    Returns
    -------
    list of (complex, float, float, float)
        Centre, direction of the middle, radius and spread of each arc.
    """
    tries = []
    for number, (start, end) in enumerate(rays):
        reach, angle = abs(end - start), phase(end - start)
        every = np.arange(NEAREST, min(max(reach - CLEAR, NEAREST + 3 * APART * force), FARTHEST), STEP)
        # long enough to be seen as arcs
        spreads = np.array(LENGTHS) * np.minimum(0.9, 1.1 * force / every)[:, None]
        radii = np.repeat(every[:, None], len(LENGTHS), axis=1)
        points = _points(start, radii, angle, spreads)
        # the line of the link itself along a ray is crossed by all arcs about its start
        along = [line for line in own if _on(line, (start, end))]
        costs = _crowd(points, [thing for thing in busy if not any(_on(line, thing[:2]) for line in along)])
        costs += SHORTER * np.arange(len(LENGTHS)) + 10.0 * (radii > reach)
        columns = (number, start, angle, reach, radii, spreads, costs)
        tries.append([*(np.broadcast_to(c, costs.shape).ravel() for c in columns), points.reshape(-1, len(ALONG))])
    numbers, centres, angles, reaches, radii, spreads, costs, points = map(np.concatenate, zip(*tries, strict=True))
    kept, totals = [], []
    for share in wanted:
        cost = np.round(costs + AWAY * np.abs(radii - share * reaches) / reaches, 6)
        kept.append(np.argsort(cost, kind="stable")[:KEPT])
        totals.append((cost + OTHER * (numbers != 0))[kept[-1]])
    total: Any = sum(np.ix_(*totals))  # together the cheapest: about the usual joint, or both about another
    for i, j in combinations(range(len(kept)), 2):
        one, other = kept[i][:, None], kept[j]
        gaps = np.abs(points[one][..., None] - points[other][:, None]).min(axis=(2, 3))
        apart = np.where(centres[one] == centres[other], np.abs(radii[one] - radii[other]), gaps)
        both = (numbers[one] == numbers[other]) & (numbers[other] != 0)
        pair = 10.0 * (apart < APART * force - NEAR) - OTHER * both
        total = total + np.expand_dims(pair, [axis for axis in range(len(kept)) if axis not in (i, j)])
    best = np.unravel_index(int(np.round(total, 6).argmin()), total.shape)
    chosen = [own_kept[k] for own_kept, k in zip(kept, best, strict=True)]
    return [(complex(centres[k]), float(angles[k]), float(radii[k]), float(spreads[k])) for k in chosen]


def free_arc(
    centre: complex, radii: Sequence[float], spread: float, wanted: float, shapes: Iterable[Shape]
) -> tuple[float, float]:
    """Return radius and middle direction of an arc about a point, off all that is drawn, near `wanted`."""
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
    o, values = scene.mm(driver.pivot), scene.values
    omega, epsilon = (f"{kind}_{driver.link}" for kind in ("omega", "epsilon"))
    canvas.part(ANSWERS)
    for name, turn in ((omega, values.get(omega) or values[driver.sense]), (epsilon, values.get(epsilon))):
        if turn:
            radius, middle = free_arc(o, radii, spread, wanted, canvas.shapes)
            canvas.add(turning_arrow(o, radius, middle, spread, math.copysign(1.0, turn), name))
            canvas.label(scene.words.symbol(name), o + rect(radius, middle), prefer=rect(1.0, middle))


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
