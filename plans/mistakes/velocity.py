"""The velocity plan: mistakes M23 to M36 and M117; M55 is the same on the acceleration plan."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from ..board import Step
from ..laws import define, dot
from ..linkages.mechanism import positive
from ..linkages.parts import normal_of
from ..names import POINT, POLE, role
from .inputs import lengths
from .rules import Change, Chapter, Scene, aside, constant, instead, length_of, mirrored, operand, opposed, with_sign

MISTAKES = Chapter()
mistake = MISTAKES.enter
# of a segment that may run any way: its whole size over the length, with the sense in which it turns
define(turning_whole=lambda v, normal, length: abs(v) * ((dot(v, normal) >= 0.0) * 2.0 - 1.0) / length)
VELOCITY, ACCELERATION = "velocity", "acceleration"


def drive(scene: Scene, plan: str) -> Step | None:
    """Return the step that lays off the vector of the driver's point."""
    return next(scene.made_by("lay", "back", plan=plan), None)


@mistake("M23")
def against_rotation(scene: Scene) -> Iterator[Change]:
    """The vector pa is drawn against the rotation."""
    step = drive(scene, VELOCITY)
    if step is not None:
        yield instead(step, verb="back")


@mistake("M24")
def along_crank(scene: Scene) -> Iterator[Change]:
    """The vector pa is drawn along the crank: away from its pivot, or towards it."""
    step = drive(scene, VELOCITY)
    if step is not None and (link := scene.along(step.operands[1])):
        along = operand(step, 1, link)
        yield instead(step, operands=along)
        yield instead(step, "other way", operands=along, verb="back")


def lines(scene: Scene, plan: str) -> Iterator[tuple[Step, int, str]]:
    """Go through the lines that meet on the plans of a kind: the step, the place and the name of the direction."""
    for step in scene.made_by("meet", plan=plan):
        for place in (1, 3):
            yield step, place, step.operands[place]


def along_links(scene: Scene, plan: str) -> Iterator[Change]:
    """Draw the line of a relative vector along the link instead of normal to it.

    Then the vector has no sense about the link: whoever goes on takes either.
    """
    for step, place, direction in lines(scene, plan):
        along = scene.along(direction)
        if along and not role(direction).across_guide:
            yield from of_either_sense(scene, instead(step, direction, operands=operand(step, place, along)), direction)


def _slotted(step: Step) -> bool:
    """Whether a slotted pair meets here: one line goes through the mark of its pin, the other is normal to the link."""
    lines = [(role(start), role(u)) for start, u in zip(step.operands[0::2], step.operands[1::2], strict=True)]
    pins = [start.of for start, u in lines if u.kind == "u" and start.kind == POINT]
    normals = [u for _, u in lines if u.kind == "n" and not u.across_guide]
    return bool(normals) and normals[0].about in pins


def _exchanged(scene: Scene, step: Step) -> Change:
    p, u, q, w = step.operands
    return by_size(scene, instead(step, operands=(p, w, q, u)))


def from_swapped_points(scene: Scene, plan: str) -> Iterator[Change]:
    """Draw each of two lines through the mark of the other."""
    yield from (_exchanged(scene, step) for step in scene.made_by("meet", plan=plan) if not _slotted(step))


@mistake("M27")
def across_guide(scene: Scene) -> Iterator[Change]:
    """The line of the guide is drawn normal to it."""
    for step, place, direction in lines(scene, VELOCITY):
        normal = normal_of(direction)
        if role(direction).kind == "u" and normal in scene.steps:
            yield instead(step, direction, operands=operand(step, place, normal))


def absolute_reading(scene: Scene, relative: Step) -> Step | None:
    """Return the reading of the absolute vector that ends where a relative one does."""
    pole = f"{relative.plan}.p"
    wanted = (pole, relative.operands[1])
    if relative.operands[0] == pole:
        return None
    return next((s for s in scene.made_by("read", plan=relative.plan) if s.operands == wanted), None)


def rate_from(scene: Scene, rate: Step, vector: str, how: str = "") -> Change:
    """Calculate an angular velocity or acceleration from the size of another vector."""
    size = length_of(vector)
    over = Step("calc", aside(rate.name), (size[-1].name, rate.operands[2]), "rate_over")
    return with_sign(rate, (*size, over), scene.values[rate.name], how)


def by_size(scene: Scene, change: Change, against: str = "") -> Change:
    """Let the rates that follow from a mark be calculated from whole segments, whichever way these run now.

    Those of links whose normal is `against` get the other sense.
    """
    steps, plan = {**change.steps}, role(change.at).plan
    for rate, reading in rates(scene, plan):
        if change.at in reading.operands:
            whole = replace(rate, law="turning_whole")
            steps[rate.name] = (whole,)
            if rate.operands[1] == against:
                name = aside(rate.name)
                steps[rate.name] = (replace(whole, name=name), Step("calc", rate.name, (name,), "opposite"))
    return replace(change, steps=steps)


def of_either_sense(scene: Scene, change: Change, normal: str) -> Iterator[Change]:
    """Go through both senses of the rate of the link with a normal, which does not show in the drawing."""
    yield replace(by_size(scene, change), how=f"with {normal}")
    yield replace(by_size(scene, change, normal), how=f"against {normal}")


@mistake("M117")
def with_another_length(scene: Scene) -> Iterator[Change]:
    """Calculate an angular velocity or acceleration with the length of another link, or of a part of one."""
    spans = [name for name in lengths(scene) if role(name).kind == "l"]
    spans += [s.name for s in scene.made_by("measure") if role(s.name).kind == "l" and not role(s.name).hidden]
    for rate in scene.made_by("calc", law="turning"):
        for name in spans:
            if name != rate.operands[2]:
                yield instead(rate, name, operands=operand(rate, 2, name))


def rates(scene: Scene, plan: str) -> Iterator[tuple[Step, Step]]:
    """Go through the rates that follow from a reading on a plan, with the reading."""
    for step in scene.made_by("calc", law="turning"):
        reading = scene.steps.get(step.operands[0])
        if reading is not None and reading.verb == "read" and plan in (reading.plan, reading.plan.kind):
            yield step, reading


@mistake("M28")
def rate_from_absolute(scene: Scene) -> Iterator[Change]:
    """The angular velocity is calculated from the absolute velocity."""
    for step, reading in rates(scene, VELOCITY):
        absolute = absolute_reading(scene, reading)
        if absolute is not None:
            yield rate_from(scene, step, absolute.name)
        elif f"V_{scene.pin}" in scene.steps:
            yield rate_from(scene, step, f"V_{scene.pin}", "of the driver")


def other_end(scene: Scene, plan: str) -> Iterator[Change]:
    """Count a point of a link from the other end of its segment."""
    for step in scene.made_by("divide", "similar", plan=plan):
        start, end, *where = step.operands
        yield instead(step, operands=(end, start, *where))


def middle(scene: Scene, plan: str) -> Iterator[Change]:
    """Put a point that divides a segment in its middle."""
    half = constant(0.5)
    for step in scene.made_by("divide", "similar", plan=plan):
        if step.verb == "divide" or not scene.values[step.operands[3]]:
            middle = Step("divide", step.name, (*step.operands[:2], half, "one"))
            yield Change(step.name, {step.name: (middle,)}, {half: 0.5})


def other_side(scene: Scene, plan: str) -> Iterator[Change]:
    """Draw a similar figure on the other side: against the order of the letters."""
    yield from (mirrored(step, 3) for step in scene.made_by("similar", plan=plan))


@mistake("M33")
def slide_and_rotation_exchanged(scene: Scene) -> Iterator[Change]:
    """In a slotted pair the directions of sliding and of rotation are exchanged."""
    for step in scene.made_by("meet", plan=VELOCITY):
        if _slotted(step):
            normal = next(u for u in step.operands[1::2] if role(u).kind == "n")
            yield from of_either_sense(scene, _exchanged(scene, step), normal)


@mistake("M34")
def over_cosine(scene: Scene) -> Iterator[Change]:
    """The velocity is divided by the cosine instead of multiplied: the right angle stands at the wrong vertex."""
    for step in scene.made_by("meet", plan=VELOCITY):
        if _slotted(step):
            place = 1 if role(step.operands[1]).kind == "u" else 3
            start, pole = step.operands[place - 1], f"{step.plan}.p"
            size, along, across = (f"_{kind}_at_{step.name}" for kind in ("size", "along", "across"))
            new = (
                Step("measure", size, (pole, start)),
                Step("direction", along, (pole, start, size)),
                Step("normal", across, (along,)),
                replace(step, operands=operand(step, place, across)),
            )
            yield Change(step.name, {step.name: new}, {})


@mistake("M35")
def points_not_distinguished(scene: Scene) -> Iterator[Change]:
    """The point of the slotted link is taken for that of the slider."""
    for step in scene.made_by("meet", plan=VELOCITY):
        if _slotted(step):
            start = step.operands[0 if role(step.operands[1]).kind == "u" else 2]
            yield by_size(scene, Change(step.name, {step.name: (Step("same", step.name, (start,)),)}, {}))


@mistake("M36")
def same_side(scene: Scene) -> Iterator[Change]:
    """A point on the other side of the shaft is put on the side of the pin."""
    for step in scene.made_by("divide", plan=VELOCITY):
        part = step.operands[2]
        if positive(part) != part:
            yield instead(step, operands=operand(step, 2, positive(part)))
    for step in scene.made_by("similar", plan=VELOCITY):
        if role(step.operands[0]).kind == POLE and scene.values[step.operands[2]] < 0.0:
            yield mirrored(step, 2)


# the relative velocity is drawn along the link
mistake("M25")(lambda scene: along_links(scene, VELOCITY))
# each of two lines is drawn through the mark of the other
mistake("M26")(lambda scene: from_swapped_points(scene, VELOCITY))
# the sense of an angular velocity is wrong: the vector stands at the wrong end of the link
mistake("M29")(lambda scene: (opposed(step) for step, _ in rates(scene, VELOCITY)))
# a point of a link is counted from the other end of ab
mistake("M30")(lambda scene: other_end(scene, VELOCITY))
# a point of a link is always put in the middle of ab
mistake("M31")(lambda scene: middle(scene, VELOCITY))
# the similar triangle is mirrored
mistake("M32")(lambda scene: other_side(scene, VELOCITY))
