"""Velocity and acceleration plans: mistakes M23 to M56, M115, M116, M121 and M125."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from functools import partial

from ..board import Step
from ..laws import define, dot
from ..linkages.mechanism import positive
from ..linkages.parts import normal_of
from ..names import CORIOLIS, POINT, POLE, mark, pole, role, spelled
from .rules import (
    Change,
    Changes,
    Scene,
    aside,
    constant,
    each,
    instead,
    length_of,
    mirrored,
    mistake,
    operand,
    opposed,
    otherwise,
    scaled,
    then,
    with_other,
    with_sign,
)

# of a segment that may run any way: its whole size over the length, with the sense in which it turns
define(turning_whole=lambda v, normal, length: abs(v) * ((dot(v, normal) >= 0.0) * 2.0 - 1.0) / length)
VELOCITY, ACCELERATION = "velocity", "acceleration"

START = pole(ACCELERATION)


def _drive(scene: Scene, plan: str) -> tuple[Step, ...]:
    """Return the step that lays off the vector of the driver's point, if any."""
    return scene.made_by("lay", "back", plan=plan)[:1]


@mistake("M24", of=lambda scene: _drive(scene, VELOCITY))
def _along_crank(scene: Scene, step: Step) -> Changes:
    """The vector pa is drawn along the crank: away from its pivot, or towards it."""
    if link := scene.along(step.operands[1]):
        along = operand(step, 1, link)
        yield otherwise(along)
        yield otherwise(along, "other way", verb="back")


# Lines that meet.


def _lines(scene: Scene, plan: str) -> Iterator[tuple[Step, int, str]]:
    """Go through the lines that meet on the plans of a kind: the step, the place and the name of the direction."""
    return ((step, place, step.operands[place]) for step in scene.made_by("meet", plan=plan) for place in (1, 3))


@mistake("M25", of=lambda scene: _lines(scene, VELOCITY))
@mistake("M42", of=lambda scene: _lines(scene, ACCELERATION))
def _along_links(scene: Scene, step: Step, place: int, direction: str) -> Changes:
    """Draw the line of a relative vector along the link instead of normal to it.

    Then the vector has no sense about the link: whoever goes on takes either.
    """
    along = scene.along(direction)
    if along and not role(direction).across_guide:
        yield from _of_either_sense(scene, with_other(step, place, along, direction), direction)


def _slotted(scene: Scene, plan: str = VELOCITY, wanted: bool = True) -> list[Step]:
    """Return the meetings of lines of slotted pairs, or all others.

    There one line goes through the mark of the pair's pin, the other is normal to the link.
    """
    return [step for step in scene.made_by("meet", plan=plan) if _is_slotted(step) is wanted]


def _is_slotted(step: Step) -> bool:
    lines = [(role(start), role(u)) for start, u in zip(step.operands[0::2], step.operands[1::2], strict=True)]
    pins = [start.of for start, u in lines if u.kind == "u" and start.kind == POINT]
    normals = [u for _, u in lines if u.kind == "n" and not u.across_guide]
    return bool(normals) and normals[0].about in pins


def _exchanged(scene: Scene, step: Step) -> Change:
    """Draw each of two lines through the mark of the other."""
    p, u, q, w = step.operands
    return _by_size(scene, otherwise(step, operands=(p, w, q, u)))


@mistake("M26", VELOCITY)
@mistake("M121", ACCELERATION)
def _through_other_marks(scene: Scene, plan: str) -> Changes:
    """Each of two lines is drawn through the mark of the other."""
    return (_exchanged(scene, step) for step in _slotted(scene, plan, False))


def _by_size(scene: Scene, change: Change, against: str = "") -> Change:
    """Let the rates that follow from a mark be calculated from whole segments, whichever way these run now.

    Those of links whose normal is `against` get the other sense.
    """
    steps = {**change.steps}
    for rate, reading in rates(scene, role(change.at).plan):
        if change.at in reading.operands:
            whole = rate.but(law="turning_whole")
            other = rate.operands[1] == against
            steps[rate.name] = then(whole, "opposite", aside(rate.name)) if other else (whole,)
    return replace(change, steps=steps)


def _of_either_sense(scene: Scene, change: Change, normal: str) -> tuple[Change, Change]:
    """Return both senses of the rate of the link with a normal, which does not show in the drawing."""
    other = replace(_by_size(scene, change, normal), how=f"against {normal}")
    return replace(_by_size(scene, change), how=f"with {normal}"), other


@mistake("M27", of=lambda scene: _lines(scene, VELOCITY))
def _across_guide(scene: Scene, step: Step, place: int, direction: str) -> Changes:
    """The line of the guide is drawn normal to it."""
    normal = normal_of(direction)
    if role(direction).kind == "u" and normal in scene.steps:
        yield with_other(step, place, normal, direction)


@mistake("M33", of=_slotted)
def _slide_and_rotation_exchanged(scene: Scene, step: Step) -> Changes:
    """In a slotted pair the directions of sliding and of rotation are exchanged."""
    normal = next(u for u in step.operands[1::2] if role(u).kind == "n")
    yield from _of_either_sense(scene, _exchanged(scene, step), normal)


@mistake("M34", of=_slotted)
def _over_cosine(scene: Scene, step: Step) -> Changes:
    """The velocity is divided by the cosine instead of multiplied: the right angle stands at the wrong vertex."""
    place = 1 if role(step.operands[1]).kind == "u" else 3
    start, pole = step.operands[place - 1], f"{step.plan}.p"
    size, along, across = (f"_{kind}_at_{step.name}" for kind in ("size", "along", "across"))
    direction = Step("direction", along, (pole, start, size))
    normal = Step("normal", across, (along,))
    yield instead(step, Step("measure", size, (pole, start)), direction, normal, operand(step, place, across))


@mistake("M35", of=_slotted)
def _points_not_distinguished(scene: Scene, step: Step) -> Changes:
    """The point of the slotted link is taken for that of the slider."""
    start = step.operands[0 if role(step.operands[1]).kind == "u" else 2]
    yield _by_size(scene, instead(step, Step("same", step.name, (start,))))


# Points of links.


@mistake("M30", VELOCITY)
def _other_end(scene: Scene, plan: str) -> Changes:
    """Count a point of a link from the other end of its segment."""
    points = scene.made_by("divide", "similar", plan=plan)
    return (otherwise(s, operands=(s.operands[1], s.operands[0], *s.operands[2:])) for s in points)


@mistake("M31", VELOCITY)
def _middle(scene: Scene, plan: str) -> Changes:
    """Put a point that divides a segment in its middle."""
    for step in scene.made_by("divide", "similar", plan=plan):
        if step.verb == "divide" or not scene.values[step.operands[3]]:
            yield instead(step, Step("divide", step.name, (*step.operands[:2], constant(0.5), "one")))


@mistake("M32", VELOCITY)
def _other_side(scene: Scene, plan: str) -> Changes:
    """Draw a similar figure on the other side: against the order of the letters."""
    return (mirrored(step, 3) for step in scene.made_by("similar", plan=plan))


@mistake("M36")
def _same_side(scene: Scene) -> Changes:
    """A point on the other side of the shaft is put on the side of the pin."""
    for step in scene.made_by("divide", plan=VELOCITY):
        part = positive(step.operands[2])
        if part != step.operands[2]:
            yield with_other(step, 2, part)
    for step in scene.made_by("similar", plan=VELOCITY):
        if role(step.operands[0]).kind == POLE and scene.values[step.operands[2]] < 0.0:
            yield mirrored(step, 2)


@mistake("M55")
def _point_wrong(scene: Scene) -> Changes:
    """A point of a link counted from the other end, put in the middle, or on the other side, on the plan."""
    for how, found in (("end", _other_end), ("middle", _middle), ("mirrored", _other_side)):
        yield from (replace(change, how=how) for change in found(scene, ACCELERATION))


# Rates of links.


def rates(scene: Scene, plan: str = "", law: str = "turning") -> Iterator[tuple[Step, Step]]:
    """Go through the rates (or normal parts) that follow from a reading on a plan, with the reading."""
    for step in scene.calculated(law):
        reading = scene.steps.get(step.operands[0])
        if reading is not None and reading.verb == "read" and plan in ("", reading.plan, reading.plan.kind):
            yield step, reading


def _absolute_reading(scene: Scene, relative: Step) -> Step | None:
    """Return the reading of the absolute vector that ends where a relative one does."""
    start = f"{relative.plan}.p"
    wanted = (start, relative.operands[1])
    found = (s for s in scene.made_by("read", plan=relative.plan) if s.operands == wanted)
    return None if relative.operands[0] == start else next(found, None)


def rate_from(scene: Scene, rate: Step, vector: str, how: str = "") -> Change:
    """Calculate an angular velocity or acceleration from the size of another vector."""
    size = length_of(vector)
    over = Step("calc", aside(rate.name), (size[-1].name, rate.operands[2]), "rate_over")
    return with_sign(rate, (*size, over), scene.values[rate.name], how)


@mistake("M28", of=lambda scene: rates(scene, VELOCITY))
def _rate_from_absolute(scene: Scene, step: Step, reading: Step) -> Changes:
    """The angular velocity is calculated from the absolute velocity."""
    absolute = _absolute_reading(scene, reading)
    if absolute is not None:
        yield rate_from(scene, step, absolute.name)
    elif f"V_{scene.pin}" in scene.steps:
        yield rate_from(scene, step, f"V_{scene.pin}", "of the driver")


@mistake("M43", of=lambda scene: rates(scene, ACCELERATION))
def _rate_from_full(scene: Scene, step: Step, reading: Step) -> Changes:
    """The angular acceleration is calculated from the full relative acceleration."""
    full = role(reading.name).whole
    if full != reading.name and full in scene.steps:
        yield rate_from(scene, step, full)


@mistake("M44", of=lambda scene: rates(scene, ACCELERATION))
def _rate_from_absolute_acceleration(scene: Scene, step: Step, reading: Step) -> Changes:
    """The angular acceleration is calculated from the absolute acceleration."""
    absolute = _absolute_reading(scene, reading)
    if absolute is not None and absolute.name != role(reading.name).whole:
        yield rate_from(scene, step, absolute.name)


@mistake("M29", VELOCITY)
@mistake("M45", ACCELERATION)
def _opposite_rate(scene: Scene, plan: str) -> Changes:
    """The sense of a rate is wrong: the vector stands at the wrong end of the link."""
    return (opposed(step) for step, _ in rates(scene, plan))


# pa is drawn against the rotation
each("M23", partial(_drive, plan=VELOCITY), partial(otherwise, verb="back"))


# Normal parts of accelerations.


def _normals(scene: Scene, *kinds: str) -> Iterator[Step]:
    """Go through the steps that lay off normal parts of links of groups of some kinds.

    That is `slotted` for the link of a slotted pair, `rocker` for one on a fixed pivot after another of its group,
    else `link`.
    """
    partner = False
    for step in scene.made_by("back", plan=ACCELERATION):
        if step not in _drive(scene, ACCELERATION):
            rocker = "rocker" if partner and step.operands[0] == START else "link"
            if ("slotted" if role(role(step.name).of).links else rocker) in kinds:
                yield step
            partner = True


def _forgotten(step: Step) -> Change:
    return with_other(step, 2, "zero", "none")


@mistake("M40", of=lambda scene: rates(scene, law="normal_part"))
def _normal_from_another(scene: Scene, step: Step, reading: Step) -> Changes:
    """The normal part is calculated from the absolute velocity, or from the angular velocity of the crank."""
    for other in scene.made_by("read", plan=reading.plan):
        start, end = other.operands
        if end == reading.operands[1] and start != reading.operands[0]:
            yield with_other(step, 0, other.name, "v" if role(start).kind == POLE else other.name)
    if "omega_1" in scene.steps:
        yield otherwise(operand(step, 0, "omega_1"), "omega_1", law="centripetal")


@mistake("M41", of=lambda scene: rates(scene, law="normal_part"))
def _square_lost(scene: Scene, step: Step, reading: Step) -> Changes:
    """The normal part is v / l, or omega l^2: a square is lost, or is in the wrong place."""
    size = length_of(reading.name)
    for how, law in (("v/l", "rate_over"), ("omega l^2", "circular_speed")):
        last = step.but(operands=(size[-1].name, step.operands[1]), law=law)
        yield instead(step, *size, last, how=how)


def _normal_sizes(scene: Scene) -> Iterator[tuple[Step, tuple[Step, ...]]]:
    """Go through normal parts: the step, steps that find the size of omega, the last one makes it.

    Parts of links of groups are calculated from the relative velocity, omega being its size over the length.
    """
    for step, reading in rates(scene, law="normal_part"):
        size = length_of(reading.name)
        yield step, (*size, Step("calc", f"_omega_of_{step.name}", (size[-1].name, step.operands[1]), "rate_over"))
    for step in scene.calculated("centripetal"):
        sense = constant(math.copysign(1.0, scene.values[step.operands[0]]))
        yield step, (Step("calc", f"_omega_of_{step.name}", (sense, step.operands[0]), "along"),)


@mistake("M115", "circular_speed", of=_normal_sizes)  # omega l
@mistake("M116", "centripetal", constant(1.0), of=_normal_sizes)  # omega^2
def _normal_by(scene: Scene, step: Step, omega: tuple[Step, ...], law: str, length: str = "") -> Changes:
    """Calculate normal parts from omega and the length, or another number, by another law."""
    yield instead(step, *omega, Step("calc", step.name, (omega[-1].name, length or step.operands[1]), law))


@mistake("M125")
def _parts_exchanged(scene: Scene) -> Changes:
    """The normal part is written for the tangential one, and the other way round; the rate follows."""
    laid = [scene.steps.get(role(step.operands[2]).shown) for step in _normals(scene, "link", "rocker", "slotted")]
    by_end = {normal.operands[1]: normal for normal in laid if normal is not None and normal.verb == "read"}
    for rate, tangential in rates(scene, ACCELERATION):
        normal = by_end.get(tangential.operands[0])
        if normal is not None:
            found = rate_from(scene, rate, tangential.name)
            both = tangential.but(operands=normal.operands), normal.but(operands=tangential.operands)
            yield Change(tangential.name, {normal.name: (), tangential.name: both, **found.steps})


@mistake("M46", of="circular_acceleration")
def _crank_tangential_lost(scene: Scene, step: Step) -> Changes:
    """The tangential part of the crank pin is lost though the crank speeds up."""
    laid = (s for s in scene.made_by("lay", plan=ACCELERATION) if step.name in s.operands)
    yield from (with_other(s, 2, "zero") for s in list(laid)[:1])


# the acceleration of the crank pin is drawn away from the pivot
mistake("M37")(lambda scene: (otherwise(s, verb="lay") for s in _drive(scene, ACCELERATION) if s.verb == "back"))
# the normal part is drawn from A to B; it is forgotten, that of the rocker too
mistake("M38")(lambda scene: (otherwise(step, verb="lay") for step in _normals(scene, "link", "rocker")))
each("M39", lambda scene: _normals(scene, "link"), _forgotten)
each("M47", lambda scene: _normals(scene, "rocker"), _forgotten)
# that of the slotted link is forgotten, or drawn away from its pivot
each("M54", lambda scene: _normals(scene, "slotted"), _forgotten, partial(otherwise, how="away", verb="lay"))


# The acceleration of Coriolis, and what is read.


@mistake("M51", of="coriolis")
def _coriolis_of_crank(scene: Scene, step: Step) -> Changes:
    """The acceleration of Coriolis with the angular velocity of the crank, or with the velocity of its pin."""
    if "omega_1" in scene.steps and step.operands[0] != "omega_1":
        yield with_other(step, 0, "omega_1", "omega_1")
        driver, own = scene.values["omega_1"], scene.values[step.operands[0]]
        if driver * own < 0.0:
            yield scaled(-driver / own, step, how="omega_1, own sense")
    pin, slide = abs(scene.values.get(f"V_{scene.pin}", 0.0)), abs(scene.values[step.operands[1]])
    if pin and slide:
        yield scaled(pin / slide, step, how="v")


@mistake("M52", of="coriolis")
def _coriolis_along_guide(scene: Scene, step: Step) -> Changes:
    """The acceleration of Coriolis is drawn along the guide."""
    twice = f"_twice_{step.name}"
    for how, factor in (("with", 2.0), ("against", -2.0)):
        double = Step("calc", twice, (constant(factor), step.operands[0]), "along")
        along = Step("calc", step.name, (twice, step.operands[1]), "along")
        yield instead(step, double, along, how=how)


@mistake("M53", of=lambda scene: _lines(scene, ACCELERATION))
def _coriolis_without_rotation(scene: Scene, step: Step, place: int, direction: str) -> Changes:
    """An acceleration of Coriolis is added where the guide does not turn."""
    speed = f"V_{role(step.name).of}"
    own = next((u for u in step.operands[1::2] if role(u).kind == "n" and not role(u).across_guide), None)
    rate = next((s.name for s, _ in rates(scene, VELOCITY) if s.operands[1] == own), None)
    still = role(direction).kind == "u" and step.operands[place - 1] == START
    if still and rate is not None and speed in scene.steps:
        for omega in dict.fromkeys((rate, "omega_1" if "omega_1" in scene.steps else rate)):
            vector, end = f"_k_at_{step.name}", mark(ACCELERATION, role(step.name).of, CORIOLIS)
            chain = Step("chain", end, (step.operands[place - 1], vector))
            added = Step("calc", vector, (omega, speed), "coriolis")
            yield instead(step, added, chain, operand(step, place - 1, end), how=omega)


@mistake("M56", of=lambda scene: scene.made_by("read", plan=ACCELERATION), by_scale=True)
def _read_from_velocity_plan(scene: Scene, step: Step) -> Changes:
    """An acceleration is read from the letter of the velocity plan."""
    read = role(step.name)
    speed = spelled("V", read.of, read.about, read.part)
    if step.plan == ACCELERATION and speed in scene.steps and step.name not in scene.laid_off:
        other = Step("calc", step.name, (speed,), "given")
        yield scaled(scene.mu(ACCELERATION) / scene.mu(VELOCITY), other)


# the acceleration of Coriolis is forgotten, turned against the rotation, has no factor two
each("M48", "coriolis", lambda step: otherwise(step, operands=("zero", step.operands[1]), law="along"))
each("M49", "coriolis", opposed)
each("M50", "coriolis", partial(scaled, 0.5))
