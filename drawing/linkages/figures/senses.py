"""Senses of turning: arcs of omega and epsilon on the links, and the vectors carried to their joints that show them."""

from __future__ import annotations

import math
from cmath import rect
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from ....plans.linkages.compound import is_relative
from ....plans.names import role
from ...shapes import Arrow, Pen
from ...symbols import turning_arrow
from ...view import Canvas
from ..scene import Scene
from ..skeleton import Skeleton
from .arc_places import obstacles, place_arcs

PLACES = {"omega": 0.30, "epsilon": 0.45}  # parts of the link at which its arcs stand


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
        if step.law == "turning" and not is_relative(step.name):
            vector, normal, _ = step.operands
            along = made[made[normal].operands[0]]  # the direction whose normal it is, from one joint to another
            yield Turn(step.name, role(step.name).links[0], vector, *along.operands[:2])


def senses(canvas: Canvas, scene: Scene, figures: Sequence[Skeleton]) -> None:
    """Carry the vectors to the joints and draw the senses of omega and epsilon that they show.

    All else but letters has been drawn: the arcs keep clear of it.
    """
    taken: dict[tuple[complex, complex], float] = {}
    shown: dict[int, list[Turn]] = {}
    for turn in turns(scene):
        e, value = scene.direction(turn.vector), scene.solved.values[turn.rate]
        if e != 0 and value == value:
            shown.setdefault(turn.link, []).append(turn)
            _carried(canvas, scene, turn, e, taken)
    for figure in figures:
        if figure.number in shown:
            _arcs(canvas, scene, shown[figure.number], figure)


def _arcs(canvas: Canvas, scene: Scene, shown: Sequence[Turn], figure: Skeleton) -> None:
    """Draw the arcs of one link across one of its lines, that between the joints of the rate if there is one."""
    ends, own = (scene.mm(shown[0].start), scene.mm(shown[0].end)), figure.strokes
    rays = [ray for line in own for ray in (line, line[::-1])]
    belongs = shown[0].start in scene.solved.mechanism.link(figure.number).points
    if belongs or not rays:
        rays.insert(0, ends)
    force, wanted = scene.style.force, [PLACES[role(turn.rate).kind] for turn in shown]
    # centres of mass are drawn with their letters, later
    marks = [scene.mm(point) for link in scene.solved.mechanism.links for point in link.points]
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
    canvas.label(scene.words.symbol(turn.vector, bar=True), (b + e * (length * 0.6), b + e * length), clear=1.0)
