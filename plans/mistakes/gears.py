"""Mistakes M100 to M114: of the geometry of a gear pair, and of its sliding."""

from __future__ import annotations

import math
from functools import partial

from ..board import Step
from ..names import role
from .rules import (
    Change,
    Changes,
    Scene,
    after,
    aside,
    constant,
    each,
    each_and_all,
    instead,
    mirrored,
    mistake,
    operand,
    otherwise,
    reversed_,
    scaled,
    then,
    with_operand,
)

SHIFTED = {"tip_diameter": 2, "root_diameter": 3}  # laws with a shift, and the place of its operand
WITH_SHIFT = {"tooth_thickness": 1, "tip_thickness": 2, "constant_chord": 1, **SHIFTED, "boundary_curvature": 4}
IN_DEGREES = math.degrees(1.0) - 1.0


def _halved_sum(step: Step) -> tuple[Step, ...]:
    """Return the steps that make half the sum of what one step makes and its first operand."""
    total = Step("calc", f"_both_{step.name}", (step.operands[0], aside(step.name)), "sum")
    return after(step, total, Step("calc", step.name, (total.name,), "half_of"))


@mistake("M100", of="involute")
def _involute_in_degrees(scene: Scene, step: Step) -> Changes:
    """In tan(alpha) - alpha the angle is subtracted in degrees."""
    if not role(step.name).hidden:
        degrees = Step("calc", f"_more_{step.name}", (constant(IN_DEGREES), *step.operands), "along")
        yield instead(step, degrees, *then(step, "excess", aside(step.name), degrees.name))


# the profile angle is taken for the angle of action; the shifts count once in its involute
each("M101", "angle_of_involute", lambda step: otherwise(step, "profile", operands=("alpha",), law="given"))
each("M101", "working_involute", lambda step: instead(step, *_halved_sum(step), how="once"))


@mistake("M102")
def _shifts_exchanged(scene: Scene) -> Changes:
    """The shifts of both wheels are exchanged, everywhere or in one formula."""
    givens = scene.paper.givens
    if not {"x_1", "x_2"} <= givens.keys() or givens["x_1"] == givens["x_2"]:
        return
    if scene.calculated("tip_diameter"):
        yield Change("d_a1", {}, "everywhere", {"x_1": givens["x_2"], "x_2": givens["x_1"]})
    other = {"x_1": "x_2", "x_2": "x_1"}
    for law, place in WITH_SHIFT.items():
        if steps := scene.calculated(law):
            changed = {s.name: (operand(s, place, other[s.operands[place]]),) for s in steps}
            yield Change(steps[0].name, changed, law)


@mistake("M103")
def _shift_left_out(scene: Scene) -> Changes:
    """A shift is left out, or laid off to the wrong side."""
    for law, place in WITH_SHIFT.items():
        yield from each_and_all(with_operand(scene.calculated(law), place, "zero"), f"none {law}")
        for step in scene.calculated(law):
            if scene.is_given(step.operands[place]):
                yield mirrored(step, place, f"side {law}")


@mistake("M106")
def _height_counted_once(scene: Scene) -> Changes:
    """The height above or below the reference circle is added to the diameter once, as to a radius."""
    for law in SHIFTED:
        yield from each_and_all({step.name: _halved_sum(step) for step in scene.calculated(law)}, law)


# the shortening of the teeth is left out of the tip diameters, or of the depth; the clearance of the root diameters
@mistake("M104", "zero", ("tip_diameter", 3, "tip"), ("tooth_depth", 2, "depth"))
@mistake("M105", "zero", ("root_diameter", 2, "root"), ("tooth_depth", 1, "depth"))
# the base diameter, or the base pitch, is found with the angle of action
@mistake("M107", "alpha_w", ("base_diameter", 1, "diameter"), ("base_pitch", 1, "pitch"))
def _with_operands(scene: Scene, name: str, *places: tuple[str, int, str]) -> Changes:
    for law, place, how in places:
        yield from each_and_all(with_operand(scene.calculated(law), place, name), how)


@mistake("M108")
def _chord_of_the_whole_angle(scene: Scene) -> Changes:
    """The chord of the pitch is half the sine of the whole angle, or its arc."""
    halved = {}
    for step in scene.calculated("pitch_chord"):
        d, tau = step.operands
        whole, chord = f"_whole_{step.name}", f"_chord_{step.name}"
        halved[step.name] = (
            Step("calc", whole, (tau, tau), "sum"),
            Step("calc", chord, (d, whole), "pitch_chord"),
            Step("calc", step.name, (chord,), "half_of"),
        )
    yield from each_and_all(halved, "sine")


@mistake("M109")
def _sine_of_half_the_angle(scene: Scene) -> Changes:
    """In the curvature at the boundary point d sin(alpha / 2) stands for d sin(alpha) / 2."""
    changed = {}
    for step in scene.calculated("boundary_curvature"):
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
def _curvature_of_the_mate(scene: Scene) -> Changes:
    """The curvature at the lower point is found with the wheel's own tip, not with that of its mate."""
    own = {"1": "2", "2": "1"}
    changed = {
        s.name: (s.but(operands=(*s.operands[:2], *(f"{o[:-1]}{own[o[-1]]}" for o in s.operands[2:]))),)
        for s in scene.calculated("lower_curvature")
    }
    yield from each_and_all(changed)


# the sum is divided by pi, or not divided, or multiplied by pi; or the angle of action is added
each(
    "M111",
    "contact_ratio",
    partial(scaled, 2.0, how="pi"),
    partial(scaled, 2.0 * math.pi, how="none"),
    partial(scaled, math.pi**2, how="times"),
    lambda step: mirrored(step, 4, "sign"),
)


@mistake("M112")
def _normal_over_one_more(scene: Scene) -> Changes:
    """The common normal has one base pitch too many, or too few."""
    for how, law in (("more", "sum"), ("less", "excess")):
        steps = scene.calculated("common_normal")
        yield from each_and_all({s.name: then(s, law, aside(s.name), s.operands[1]) for s in steps}, how)


@mistake("M113")
def _rows_exchanged(scene: Scene) -> Changes:
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
            changed[second.name] = second.but(name=first.name), first.but(name=second.name)
        if changed:
            yield Change(pairs[0][0].name, changed, how)


@mistake("M114")
def _sliding_by_the_other_ordinate(scene: Scene) -> Changes:
    """The difference of the ordinates is divided by that of the mate, or has the other sign, or both are exchanged."""
    by_ordinates = scene.calculated("sliding_by_ordinates")
    steps = (*by_ordinates, *scene.calculated("sliding_of_pinion"), *scene.calculated("sliding_of_wheel"))
    exchanged = {s.name: s.but(operands=(s.operands[1], s.operands[0], *s.operands[2:])) for s in by_ordinates}
    if steps:
        yield Change(steps[0].name, {s.name: reversed_(s) for s in steps}, "sign")
    for first in by_ordinates[:1]:
        yield Change(first.name, {name: reversed_(s) for name, s in exchanged.items()}, "mate")
        yield Change(first.name, {name: (s,) for name, s in exchanged.items()}, "exchanged")
