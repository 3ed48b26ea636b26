"""Senses of turning: arcs of omega and epsilon on the links, and the vectors carried to their joints that show them."""

from __future__ import annotations

import math
from cmath import phase, rect
from collections.abc import Iterator
from dataclasses import dataclass

from ...plans.linkages.compound import RELATIVE
from ..shapes import Arrow, Pen
from ..symbols import turning_arrow
from ..view import Canvas
from .scene import Scene

PLACES = {"omega": 0.30, "epsilon": 0.45}  # parts of the link at which its arcs stand
NEAREST, LEAST = 14.0, 10.0  # mm from the joint about which they are drawn: wanted, and where there is no room
SHARES = (1.0, 0.8, 0.6, 0.45, 0.3)  # of the room that should be left between an arc and what else is on the link


@dataclass(frozen=True, slots=True)
class Turn:
    """A rate read off a plan: the link, the vector that turns its joint `end` about its joint `start`."""

    rate: str
    link: int
    vector: str
    start: str
    end: str


def turns(scene: Scene) -> Iterator[Turn]:
    """Go through the rates of turning that the construction reads off its plans."""
    made = {step.name: step for step in scene.solved.program}
    for step in scene.solved.program:
        if step.law == "turning" and not RELATIVE.match(step.name):
            vector, normal, _ = step.operands
            along = made[made[normal].operands[0]]  # the direction whose normal it is, from one joint to another
            yield Turn(step.name, int(step.name.rpartition("_")[2]), vector, *along.operands[:2])


def senses(canvas: Canvas, scene: Scene) -> None:
    """Carry the vectors to the joints and draw the senses of omega and epsilon that they show."""
    taken: dict[tuple[complex, complex], float] = {}
    arcs: dict[tuple[int, str], list[float]] = {}
    for turn in turns(scene):
        e, value = scene.direction(turn.vector), scene.solved.values[turn.rate]
        if e == 0 or value != value:
            continue
        _arc(canvas, scene, turn, math.copysign(1.0, value), arcs.setdefault((turn.link, turn.start), []))
        _carried(canvas, scene, turn, e, taken)


def _arc(canvas: Canvas, scene: Scene, turn: Turn, sense: float, others: list[float]) -> None:
    """Draw the arc across the link, about the joint from which it is reckoned; `others` are there already."""
    a, b = scene.mm(turn.start), scene.mm(turn.end)
    along, reach = phase(b - a), abs(b - a)
    radius = _off_points(scene, turn, max(NEAREST, PLACES[turn.rate.partition("_")[0]] * reach), others)
    others.append(radius)
    spread = min(0.9, 1.1 * scene.style.force / radius)  # long enough to be seen as an arc
    canvas.add(turning_arrow(a, radius, along, spread, sense, turn.rate))
    tip = a + rect(radius, along + sense * spread / 2)
    canvas.label(scene.words.symbol(turn.rate), tip, prefer=rect(sense, along + math.pi / 2), clear=1.4)


def _carried(canvas: Canvas, scene: Scene, turn: Turn, e: complex, taken: dict[tuple[complex, complex], float]) -> None:
    """Draw the vector at the joint that it turns, beyond another one on the same ray."""
    b = scene.mm(turn.end)
    key = complex(round(b.real, 3), round(b.imag, 3)), complex(round(e.real, 6), round(e.imag, 6))
    start = taken.get(key, 0.0)
    length = 0.62 * scene.style.force + start
    taken[key] = length + 0.2 * scene.style.force
    canvas.add(Arrow(b, b + e * length, Pen.THIN, name=turn.vector))
    canvas.label(scene.words.symbol(turn.vector, bar=True), (b + e * (length * 0.6), b + e * length), clear=1.0)


def _off_points(scene: Scene, turn: Turn, radius: float, arcs: list[float]) -> float:
    """Return the radius of an arc about `start`, changed where it would run through a point or along another arc."""
    room, a = 0.3 * scene.style.force, scene.mm(turn.start)
    points = [p for p in scene.solved.mechanism.link(turn.link).points if p != turn.start]
    others, end = [*(abs(scene.mm(point) - a) for point in points), *arcs], abs(scene.mm(turn.end) - a)
    for share in SHARES:
        free = [radius, *(reach + side * share * room for reach in others for side in (1, -1))]
        free = [r for r in free if max(share * room, LEAST) <= r < max(end, radius + 1.0)]
        free = [r for r in free if all(abs(r - other) >= 0.999 * share * room for other in others)]
        if free:
            return min(free, key=lambda r: abs(r - radius))
    return radius
