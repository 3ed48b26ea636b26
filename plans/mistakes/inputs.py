"""Data, units and position: mistakes M01 to M13."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial
from itertools import combinations

from ..board import POSITION, Step
from ..names import ORIGIN, role
from .rules import Change, Chapter, Scene, all_scaled, constant, instead, mirrored, operand, scaled

MISTAKES = Chapter()
mistake = MISTAKES.enter
TWELFTH = math.pi / 6.0  # between positions
# which operands of a step are lengths, in the laws too
LENGTHS = {"place": (0, 1), "arc": (1,), "arcs": (1, 3), "tangent": (2,), "divide": (2, 3)}
IN_LAWS = {
    "circular_speed": 1,
    "centripetal": 1,
    "normal_part": 1,
    "turning": 2,
    "moment_equation": 0,
    "crank_moment": 1,
}


def _speed(scene: Scene) -> str | None:
    """Return the given number of revolutions of the crank, where it is that which is given."""
    step = next((s for s in scene.made_by("calc", law="signed") if role(s.name).kind == "omega"), None)
    return step.operands[0] if step and step.operands[0].startswith("n") and scene.is_given(step.operands[0]) else None


def _speed_times(factor: float, scene: Scene) -> Iterator[Change]:
    name = _speed(scene)
    if name is not None:
        yield Change(name, {}, {name: scene.paper.givens[name] * factor})


# n in rpm is taken for omega; n / 60; 2 pi n; pi n / 60; 6 n in degrees a second
for _id, _factor in (
    ("M01", 30.0 / math.pi),
    ("M02", 0.5 / math.pi),
    ("M03", 60.0),
    ("M04", 0.5),
    ("M05", 180.0 / math.pi),
):
    mistake(_id)(partial(_speed_times, _factor))


def lengths(scene: Scene) -> list[str]:
    """Return the data that are lengths, in order of use."""
    found: dict[str, None] = {}
    for step in scene.program:
        places = LENGTHS.get(step.verb, ())
        if step.verb in ("lay", "back") and step.plan == POSITION:
            places = (2,)
        if step.law in IN_LAWS:
            places = (IN_LAWS[step.law],)
        found.update((step.operands[i], None) for i in places if scene.is_given(step.operands[i]))
        if step.law in ("opposite", "excess", "sum") and role(step.name).kind in ("minus", "offset", "slope"):
            found.update((name, None) for name in step.operands if scene.is_given(name))
    if "_stroke_travel" in scene.steps:
        found.update({"_stroke_begin": None, "_stroke_end": None})
    return [name for name in found if isinstance(scene.paper.givens[name], float)]


@mistake("M05")
def rates_in_degrees(scene: Scene) -> Iterator[Change]:
    """Angular velocities and accelerations of links are given in degrees."""
    steps = list(scene.made_by("calc", law="turning"))
    if steps:
        yield all_scaled("", steps, 180.0 / math.pi, "degrees")


@mistake("M07")
def diameter_for_radius(scene: Scene) -> Iterator[Change]:
    """The stroke, or the diameter of the crank circle, is taken for the crank, or half the crank."""
    for step in scene.made_by("calc", law="circular_speed"):
        name = step.operands[1]
        if scene.is_given(name):
            yield Change(name, {}, {name: scene.paper.givens[name] * 2.0}, "x2")
            yield Change(name, {}, {name: scene.paper.givens[name] * 0.5}, "x1/2")


def angle_of_driver(scene: Scene) -> str | None:
    """Return the name of the crank's angle."""
    crank = next((s for s in scene.made_by("lay", plan=POSITION) if s.name == scene.pin and s.plan == POSITION), None)
    turn = scene.steps.get(crank.operands[1]) if crank else None
    return turn.operands[0] if turn and turn.verb == "turn" and turn.operands[0] in scene.paper.givens else None


def _turned(scene: Scene, how: str, angle: float) -> Iterator[Change]:
    name = angle_of_driver(scene)
    if name is not None and name != "zero":
        yield Change(name, {}, {name: angle}, how)


def _angle(scene: Scene) -> float:
    return float(scene.paper.givens.get(angle_of_driver(scene) or "", 0.0))


@mistake("M09")
def clockwise(scene: Scene) -> Iterator[Change]:
    """The angle is laid off clockwise; or the crank turns the other way."""
    yield from _turned(scene, "angle", -_angle(scene))
    for step in scene.made_by("calc", law="signed"):
        if role(step.name).kind == "omega":
            sense = constant(-1.0)
            steps = (Step("calc", f"_against_{step.name}", step.operands, "signed"),)
            again = Step("calc", step.name, (f"_against_{step.name}", sense), "signed")
            yield Change(step.name, {step.name: (*steps, again)}, {sense: -1.0}, "sense")


@mistake("M10")
def another_zero(scene: Scene) -> Iterator[Change]:
    """The angle is counted from the other dead position, or from the other axis."""
    for how, shift in (("+180", math.pi), ("+90", 0.5 * math.pi), ("-90", -0.5 * math.pi)):
        yield from _turned(scene, how, _angle(scene) + shift)


@mistake("M10")
def another_position(scene: Scene) -> Iterator[Change]:
    """The positions are numbered from another one: the whole plan is that of another position."""
    for number in (1, -1, 2, -2, 4, -4, 5, -5):
        yield from _turned(scene, f"{30 * number:+}", _angle(scene) + number * TWELFTH)


@mistake("M11")
def other_assembly(scene: Scene) -> Iterator[Change]:
    """A dyad is put together on the other side."""
    for step in scene.made_by("arc", "arcs", "tangent"):
        yield mirrored(step, len(step.operands) - 1)


@mistake("M12")
def offset_lost(scene: Scene) -> Iterator[Change]:
    """The offset of a guide is forgotten, or laid off on the wrong side."""
    for step in scene.made_by("lay", "back", plan=POSITION):
        if step.plan == POSITION and role(step.operands[1]).across_guide and scene.values[step.operands[2]]:
            yield instead(step, "none", operands=operand(step, 2, "zero"))
            yield instead(step, "side", verb="back" if step.verb == "lay" else "lay")
    for step in scene.made_by("tangent"):
        if scene.values[step.operands[2]]:
            yield from _offset_at(step, 2)
    for step in scene.made_by("place"):
        if role(step.name).kind == ORIGIN:
            yield from (x for i in (0, 1) if scene.is_given(step.operands[i]) for x in _offset_at(step, i))


def _offset_at(step: Step, place: int) -> Iterator[Change]:
    yield instead(step, f"none {place}", operands=operand(step, place, "zero"))
    yield mirrored(step, place, f"side {place}")


@mistake("M13")
def lengths_exchanged(scene: Scene) -> Iterator[Change]:
    """The lengths of two links are exchanged."""
    given = scene.paper.givens
    whole = {s.operands[i] for s in scene.made_by("arc", "arcs") for i in LENGTHS[s.verb]}
    whole |= {s.operands[1] for s in scene.made_by("calc", law="circular_speed")}
    whole |= {s.operands[2] for s in scene.made_by("divide")}
    names = [name for name in lengths(scene) if name in whole]
    for first, second in combinations(names, 2):
        yield Change(first, {}, {first: given[second], second: given[first]}, second)


# lengths stay in millimetres
mistake("M06")(lambda scene: [Change("l", {}, {name: scene.paper.givens[name] * 1000.0 for name in lengths(scene)})])
# one arm is left in millimetres
mistake("M06")(lambda scene: (scaled(step, 1000.0, "arm") for step in scene.made_by("arm")))
# degrees are given to a function of radians
mistake("M08")(lambda scene: _turned(scene, "", math.degrees(_angle(scene))))
# the angle is laid off from the other end of the axis
mistake("M10")(lambda scene: _turned(scene, "180-", math.pi - _angle(scene)))
