"""The acceleration plan: mistakes M37 to M56, M115, M116, M121 and M125."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

from ..board import Step
from ..names import CORIOLIS, POLE, mark, pole, role, spelled
from .rules import (
    Change,
    Chapter,
    Scene,
    constant,
    instead,
    length_of,
    operand,
    opposed,
    scaled,
    times,
)
from .velocity import (
    ACCELERATION,
    absolute_reading,
    along_links,
    drive,
    from_swapped_points,
    middle,
    other_end,
    other_side,
    rate_from,
    rates,
)

MISTAKES = Chapter()
mistake = MISTAKES.enter
SENSES = {constant(sense): sense for sense in (1.0, -1.0)}
START = pole(ACCELERATION)


@mistake("M37")
def away_from_pivot(scene: Scene) -> Iterator[Change]:
    """The acceleration of the crank pin is drawn away from the pivot."""
    step = drive(scene, ACCELERATION)
    if step is not None and step.verb == "back":
        yield instead(step, verb="lay")


def normals(scene: Scene) -> Iterator[tuple[Step, str]]:
    """Go through the steps that lay off normal parts of links of groups, with the kind of link.

    That is `slotted` for the link of a slotted pair, `rocker` for one on a fixed pivot after another of its group,
    else `link`.
    """
    first, partner = drive(scene, ACCELERATION), None
    for step in scene.made_by("back", plan=ACCELERATION):
        if step is first:
            continue
        if role(role(step.name).of).links:
            yield step, "slotted"
        elif step.operands[0] == START and partner is not None:
            yield step, "rocker"
        else:
            yield step, "link"
        partner = step


def _normals(scene: Scene, *kinds: str) -> Iterator[Step]:
    return (step for step, kind in normals(scene) if kind in kinds)


def _forgotten(step: Step) -> Change:
    return instead(step, "none", operands=operand(step, 2, "zero"))


@mistake("M54")
def normal_of_slotted_link(scene: Scene) -> Iterator[Change]:
    """The normal part of the slotted link is forgotten, or drawn away from its pivot."""
    for step in _normals(scene, "slotted"):
        yield _forgotten(step)
        yield instead(step, "away", verb="lay")


def normal_laws(scene: Scene) -> Iterator[tuple[Step, Step]]:
    """Go through the calculations of normal parts, with the readings of their velocities."""
    for step in scene.made_by("calc", law="normal_part"):
        reading = scene.steps.get(step.operands[0])
        if reading is not None and reading.verb == "read":
            yield step, reading


@mistake("M40")
def normal_from_another(scene: Scene) -> Iterator[Change]:
    """The normal part is calculated from the absolute velocity, or from the angular velocity of the crank."""
    for step, reading in normal_laws(scene):
        for other in scene.made_by("read", plan=reading.plan):
            start, end = other.operands
            if end == reading.operands[1] and start != reading.operands[0]:
                how = "v" if role(start).kind == POLE else other.name
                yield instead(step, how, operands=operand(step, 0, other.name))
        if "omega_1" in scene.steps:
            yield instead(step, "omega_1", operands=operand(step, 0, "omega_1"), law="centripetal")


@mistake("M41")
def square_lost(scene: Scene) -> Iterator[Change]:
    """The normal part is v / l, or omega l^2: a square is lost, or is in the wrong place."""
    for step, reading in normal_laws(scene):
        size = length_of(reading.name)
        for how, law in (("v/l", "rate_over"), ("omega l^2", "circular_speed")):
            last = replace(step, operands=(size[-1].name, step.operands[1]), law=law)
            yield Change(step.name, {step.name: (*size, last)}, {}, how)


def normal_sizes(scene: Scene) -> Iterator[tuple[Step, tuple[Step, ...], str, str]]:
    """Go through normal parts: the step, steps that find omega and its name, the length.

    Parts of links of groups are calculated from the relative velocity, omega being its size over the length.
    """
    for step, reading in normal_laws(scene):
        size, omega = length_of(reading.name), f"_omega_of_{step.name}"
        yield (
            step,
            (*size, Step("calc", omega, (size[-1].name, step.operands[1]), "rate_over")),
            omega,
            step.operands[1],
        )
    for step in scene.made_by("calc", law="centripetal"):
        sense, omega = constant(math.copysign(1.0, scene.values[step.operands[0]])), f"_omega_of_{step.name}"
        yield step, (Step("calc", omega, (sense, step.operands[0]), "along"),), omega, step.operands[1]


@mistake("M125")
def parts_exchanged(scene: Scene) -> Iterator[Change]:
    """The normal part is written for the tangential one, and the other way round; the rate follows."""
    laid = [scene.steps.get(role(step.operands[2]).shown) for step, _ in normals(scene)]
    by_end = {normal.operands[1]: normal for normal in laid if normal is not None and normal.verb == "read"}
    for rate, tangential in rates(scene, ACCELERATION):
        normal = by_end.get(tangential.operands[0])
        if normal is not None:
            found = rate_from(scene, rate, tangential.name)
            both = replace(tangential, operands=normal.operands), replace(normal, operands=tangential.operands)
            yield Change(tangential.name, {normal.name: (), tangential.name: both, **found.steps}, found.givens)


@mistake("M115")
def omega_not_squared(scene: Scene) -> Iterator[Change]:
    """The normal part is omega l."""
    for step, found, omega, length in normal_sizes(scene):
        product = Step("calc", step.name, (omega, length), "circular_speed")
        yield Change(step.name, {step.name: (*found, product)}, SENSES)


@mistake("M116")
def length_lost(scene: Scene) -> Iterator[Change]:
    """The normal part is omega^2."""
    for step, found, omega, _ in normal_sizes(scene):
        square = Step("calc", step.name, (omega, constant(1.0)), "centripetal")
        yield Change(step.name, {step.name: (*found, square)}, SENSES)


@mistake("M43")
def rate_from_full(scene: Scene) -> Iterator[Change]:
    """The angular acceleration is calculated from the full relative acceleration."""
    for step, reading in rates(scene, ACCELERATION):
        full = role(reading.name).whole
        if full != reading.name and full in scene.steps:
            yield rate_from(scene, step, full)


@mistake("M44")
def rate_from_absolute(scene: Scene) -> Iterator[Change]:
    """The angular acceleration is calculated from the absolute acceleration."""
    for step, reading in rates(scene, ACCELERATION):
        absolute = absolute_reading(scene, reading)
        if absolute is not None and absolute.name != role(reading.name).whole:
            yield rate_from(scene, step, absolute.name)


@mistake("M46")
def crank_tangential_lost(scene: Scene) -> Iterator[Change]:
    """The tangential part of the crank pin is lost though the crank speeds up."""
    for step in scene.made_by("calc", law="circular_acceleration"):
        laid = next((s for s in scene.made_by("lay", plan=ACCELERATION) if step.name in s.operands), None)
        if laid is not None:
            yield instead(laid, operands=operand(laid, 2, "zero"))


def coriolis(scene: Scene) -> Iterator[Step]:
    """Go through the accelerations of Coriolis."""
    return scene.made_by("calc", law="coriolis")


@mistake("M48")
def coriolis_forgotten(scene: Scene) -> Iterator[Change]:
    """The acceleration of Coriolis is forgotten."""
    for step in coriolis(scene):
        yield instead(step, operands=("zero", step.operands[1]), law="along")


@mistake("M51")
def coriolis_of_crank(scene: Scene) -> Iterator[Change]:
    """The acceleration of Coriolis with the angular velocity of the crank, or with the velocity of its pin."""
    for step in coriolis(scene):
        if "omega_1" in scene.steps and step.operands[0] != "omega_1":
            yield instead(step, "omega_1", operands=operand(step, 0, "omega_1"))
            driver, own = scene.values["omega_1"], scene.values[step.operands[0]]
            if driver * own < 0.0:
                yield scaled(step, -driver / own, "omega_1, own sense")
        pin, slide = abs(scene.values.get(f"V_{scene.pin}", 0.0)), abs(scene.values[step.operands[1]])
        if pin and slide:
            yield scaled(step, pin / slide, "v")


@mistake("M52")
def coriolis_along_guide(scene: Scene) -> Iterator[Change]:
    """The acceleration of Coriolis is drawn along the guide."""
    for step in coriolis(scene):
        twice = f"_twice_{step.name}"
        for how, factor in (("with", 2.0), ("against", -2.0)):
            double = Step("calc", twice, (constant(factor), step.operands[0]), "along")
            along = Step("calc", step.name, (twice, step.operands[1]), "along")
            yield Change(step.name, {step.name: (double, along)}, {constant(factor): factor}, how)


@mistake("M53")
def coriolis_without_rotation(scene: Scene) -> Iterator[Change]:
    """An acceleration of Coriolis is added where the guide does not turn."""
    for step in scene.made_by("meet", plan=ACCELERATION):
        for place in (1, 3):
            tip = role(step.name).of
            own = next((u for u in step.operands[1::2] if role(u).kind == "n" and not role(u).across_guide), None)
            rate = next((s.name for s, _ in rates(scene, "velocity") if s.operands[1] == own), None)
            still = role(step.operands[place]).kind == "u" and step.operands[place - 1] == START
            if still and rate is not None and f"V_{tip}" in scene.steps:
                for omega in dict.fromkeys((rate, "omega_1" if "omega_1" in scene.steps else rate)):
                    yield _with_coriolis(step, place, omega, f"V_{tip}")


def _with_coriolis(step: Step, place: int, omega: str, speed: str) -> Change:
    vector, end = f"_k_at_{step.name}", mark(ACCELERATION, role(step.name).of, CORIOLIS)
    new = (
        Step("calc", vector, (omega, speed), "coriolis"),
        Step("chain", end, (step.operands[place - 1], vector)),
        replace(step, operands=operand(step, place - 1, end)),
    )
    return Change(step.name, {step.name: new}, {}, omega)


@mistake("M55")
def point_wrong(scene: Scene) -> Iterator[Change]:
    """A point of a link counted from the other end, put in the middle, or on the other side, on the plan."""
    for how, found in (
        ("end", other_end(scene, ACCELERATION)),
        ("middle", middle(scene, ACCELERATION)),
        ("mirrored", other_side(scene, ACCELERATION)),
    ):
        yield from (replace(change, how=how) for change in found)


@mistake("M56", by_scale=True)
def read_from_velocity_plan(scene: Scene) -> Iterator[Change]:
    """An acceleration is read from the letter of the velocity plan."""
    for step in scene.made_by("read", plan=ACCELERATION):
        read = role(step.name)
        speed = spelled("V", read.of, read.about, read.part)
        if step.plan == ACCELERATION and speed in scene.steps and step.name not in scene.laid_off:
            factor = scene.mu(ACCELERATION) / scene.mu("velocity")
            made, givens = times(Step("calc", step.name, (speed,), "given"), factor)
            yield Change(step.name, {step.name: made}, givens)


# the normal part is drawn from A to B
mistake("M38")(lambda scene: (instead(step, verb="lay") for step in _normals(scene, "link", "rocker")))
# the normal part is forgotten
mistake("M39")(lambda scene: map(_forgotten, _normals(scene, "link")))
# the normal part of the rocker is forgotten
mistake("M47")(lambda scene: map(_forgotten, _normals(scene, "rocker")))
# each of two lines is drawn through the mark of the other
mistake("M121")(lambda scene: from_swapped_points(scene, ACCELERATION))
# the line of the tangential part is drawn along the link
mistake("M42")(lambda scene: along_links(scene, ACCELERATION))
# the sense of an angular acceleration is wrong: the tangential part stands at the wrong end of the link
mistake("M45")(lambda scene: (opposed(step) for step, _ in rates(scene, ACCELERATION)))
# the acceleration of Coriolis is turned against the rotation
mistake("M49")(lambda scene: map(opposed, coriolis(scene)))
# the acceleration of Coriolis without its factor two
mistake("M50")(lambda scene: (scaled(step, 0.5) for step in coriolis(scene)))
