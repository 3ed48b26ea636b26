"""Geometry and sliding of a gear pair: mistakes M100 to M114."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

from ..board import Step
from ..names import role
from .rules import (
    Change,
    Chapter,
    Scene,
    Steps,
    aside,
    constant,
    each_and_all,
    instead,
    mirrored,
    operand,
    reversed_,
    scaled,
    with_operand,
)

MISTAKES = Chapter()
mistake = MISTAKES.enter
SHIFTED = {"tip_diameter": 2, "root_diameter": 3}  # laws with a shift, and the place of its operand
WITH_SHIFT = {"tooth_thickness": 1, "tip_thickness": 2, "constant_chord": 1, **SHIFTED, "boundary_curvature": 4}
IN_DEGREES = math.degrees(1.0) - 1.0


def in_law(scene: Scene, law: str, place: int, name: str) -> Steps:
    """Put another operand into the steps of a law."""
    return with_operand(scene.made_by("calc", law=law), place, name)


def after(step: Step, *more: Step) -> tuple[Step, ...]:
    """Return a step aside, then others, of which the last one makes what it made."""
    return (replace(step, name=aside(step.name)), *more)


@mistake("M100")
def involute_in_degrees(scene: Scene) -> Iterator[Change]:
    """In tan(alpha) - alpha the angle is subtracted in degrees."""
    for step in scene.made_by("calc", law="involute"):
        if role(step.name).hidden:
            continue
        right, more, factor = aside(step.name), f"_more_{step.name}", constant(IN_DEGREES)
        degrees = Step("calc", more, (factor, *step.operands), "along")
        steps = after(step, degrees, Step("calc", step.name, (right, more), "excess"))
        yield Change(step.name, {step.name: steps}, {factor: IN_DEGREES})


@mistake("M101")
def angle_of_action(scene: Scene) -> Iterator[Change]:
    """The profile angle is taken for the angle of action, or the shifts count once in its involute."""
    for step in scene.made_by("calc", law="angle_of_involute"):
        yield instead(step, "profile", operands=("alpha",), law="given")
    for step in scene.made_by("calc", law="working_involute"):
        right, both = aside(step.name), f"_both_{step.name}"
        steps = after(
            step, Step("calc", both, (step.operands[0], right), "sum"), Step("calc", step.name, (both,), "half_of")
        )
        yield Change(step.name, {step.name: steps}, {}, "once")


@mistake("M102")
def shifts_exchanged(scene: Scene) -> Iterator[Change]:
    """The shifts of both wheels are exchanged, everywhere or in one formula."""
    givens = scene.paper.givens
    if not {"x_1", "x_2"} <= givens.keys() or givens["x_1"] == givens["x_2"]:
        return
    if any(True for _ in scene.made_by("calc", law="tip_diameter")):
        yield Change("d_a1", {}, {"x_1": givens["x_2"], "x_2": givens["x_1"]}, "everywhere")
    other = {"x_1": "x_2", "x_2": "x_1"}
    for law, place in WITH_SHIFT.items():
        steps = list(scene.made_by("calc", law=law))
        if steps:
            changed = {s.name: (replace(s, operands=operand(s, place, other[s.operands[place]])),) for s in steps}
            yield Change(steps[0].name, changed, {}, law)


@mistake("M103")
def shift_left_out(scene: Scene) -> Iterator[Change]:
    """A shift is left out, or laid off to the wrong side."""
    for law, place in WITH_SHIFT.items():
        yield from each_and_all(in_law(scene, law, place, "zero"), f"none {law}")
        for step in scene.made_by("calc", law=law):
            if scene.is_given(step.operands[place]):
                yield mirrored(step, place, f"side {law}")


@mistake("M104")
def tips_not_shortened(scene: Scene) -> Iterator[Change]:
    """The shortening of the teeth is left out of the tip diameters, or of the depth."""
    yield from each_and_all(in_law(scene, "tip_diameter", 3, "zero"), "tip")
    yield from each_and_all(in_law(scene, "tooth_depth", 2, "zero"), "depth")


@mistake("M105")
def clearance_left_out(scene: Scene) -> Iterator[Change]:
    """The clearance is left out of the root diameters, or of the depth."""
    yield from each_and_all(in_law(scene, "root_diameter", 2, "zero"), "root")
    yield from each_and_all(in_law(scene, "tooth_depth", 1, "zero"), "depth")


@mistake("M106")
def height_counted_once(scene: Scene) -> Iterator[Change]:
    """The height above or below the reference circle is added to the diameter once, as to a radius."""
    for law in SHIFTED:
        changed = {}
        for step in scene.made_by("calc", law=law):
            right, both = aside(step.name), f"_both_{step.name}"
            joined = Step("calc", both, (step.operands[0], right), "sum")
            changed[step.name] = after(step, joined, Step("calc", step.name, (both,), "half_of"))
        yield from each_and_all(changed, law)


@mistake("M107")
def base_by_another_angle(scene: Scene) -> Iterator[Change]:
    """The base diameter, or the base pitch, is found with the angle of action."""
    yield from each_and_all(in_law(scene, "base_diameter", 1, "alpha_w"), "diameter")
    yield from each_and_all(in_law(scene, "base_pitch", 1, "alpha_w"), "pitch")


@mistake("M108")
def chord_of_the_whole_angle(scene: Scene) -> Iterator[Change]:
    """The chord of the pitch is half the sine of the whole angle, or its arc."""
    halved = {}
    for step in scene.made_by("calc", law="pitch_chord"):
        d, tau = step.operands
        whole, chord = f"_whole_{step.name}", f"_chord_{step.name}"
        halved[step.name] = (
            Step("calc", whole, (tau, tau), "sum"),
            Step("calc", chord, (d, whole), "pitch_chord"),
            Step("calc", step.name, (chord,), "half_of"),
        )
    yield from each_and_all(halved, "sine")


@mistake("M109")
def sine_of_half_the_angle(scene: Scene) -> Iterator[Change]:
    """In the curvature at the boundary point d sin(alpha / 2) stands for d sin(alpha) / 2."""
    changed = {}
    for step in scene.made_by("calc", law="boundary_curvature"):
        d, alpha, *_ = step.operands
        name = step.name
        right, whole, long, short, more = (f"_{word}_{name}" for word in ("right", "whole", "long", "short", "more"))
        changed[name] = after(
            step,
            Step("calc", short, (d, alpha), "pitch_chord"),  # d sin(alpha / 2)
            Step("calc", whole, (alpha, alpha), "sum"),
            Step("calc", long, (d, whole), "pitch_chord"),
            Step("calc", f"{long}_half", (long,), "half_of"),
            Step("calc", more, (right, short), "sum"),
            Step("calc", name, (more, f"{long}_half"), "excess"),
        )
    yield from each_and_all(changed)


@mistake("M110")
def curvature_of_the_mate(scene: Scene) -> Iterator[Change]:
    """The curvature at the lower point is found with the wheel's own tip, not with that of its mate."""
    steps = list(scene.made_by("calc", law="lower_curvature"))
    own = {"1": "2", "2": "1"}
    changed = {
        s.name: (replace(s, operands=(*s.operands[:2], *(f"{o[:-1]}{own[o[-1]]}" for o in s.operands[2:]))),)
        for s in steps
    }
    yield from each_and_all(changed)


@mistake("M111")
def contact_ratio(scene: Scene) -> Iterator[Change]:
    """The sum is divided by pi, or not divided, or multiplied by pi; or the angle of action is added."""
    for step in scene.made_by("calc", law="contact_ratio"):
        for how, times in (("pi", 2.0), ("none", 2.0 * math.pi), ("times", math.pi**2)):
            yield scaled(step, times, how)
        yield mirrored(step, 4, "sign")


@mistake("M112")
def normal_over_one_more(scene: Scene) -> Iterator[Change]:
    """The common normal has one base pitch too many, or too few."""
    found = list(scene.made_by("calc", law="common_normal"))
    for how, law in (("more", "sum"), ("less", "excess")):
        last = {s.name: Step("calc", s.name, (aside(s.name), s.operands[1]), law) for s in found}
        yield from each_and_all({s.name: after(s, last[s.name]) for s in found}, how)


@mistake("M113")
def rows_exchanged(scene: Scene) -> Iterator[Change]:
    """The rows of the ordinates are exchanged, all of them or beyond the pole."""
    steps = scene.steps
    points = [here.about for here in map(role, steps) if (here.kind, here.of) == ("y", "1") and here.about]
    pole = next((p for p in points if scene.values[f"y_1_{p}"] == scene.values[f"y_2_{p}"]), "")
    for how, chosen in (("all", points), ("beyond", [p for p in points if pole and p > pole])):
        pairs = [(steps[f"y_1_{p}"], steps[f"y_2_{p}"]) for p in chosen]
        changed: dict[str, tuple[Step, ...]] = {}
        for first, second in pairs:
            # both are read when all marks are there
            changed[first.name] = ()
            changed[second.name] = replace(second, name=first.name), replace(first, name=second.name)
        if changed:
            yield Change(pairs[0][0].name, changed, {}, how)


@mistake("M114")
def sliding_by_the_other_ordinate(scene: Scene) -> Iterator[Change]:
    """The difference of the ordinates is divided by that of the mate, or has the other sign, or both are exchanged."""
    steps = list(scene.made_by("calc", law="sliding_by_ordinates"))
    steps += [s for law in ("sliding_of_pinion", "sliding_of_wheel") for s in scene.made_by("calc", law=law)]
    if steps:
        exchanged = {s.name: replace(s, operands=(s.operands[1], s.operands[0], *s.operands[2:])) for s in steps}
        by_ordinates = [s for s in steps if s.law == "sliding_by_ordinates"]
        yield Change(steps[0].name, {s.name: reversed_(s) for s in steps}, {}, "sign")
        if by_ordinates:
            first = by_ordinates[0].name
            yield Change(first, {s.name: reversed_(exchanged[s.name]) for s in by_ordinates}, {}, "mate")
            yield Change(first, {s.name: (exchanged[s.name],) for s in by_ordinates}, {}, "exchanged")
