"""Mistakes M83 to M114: of diagrams, sizes and profiles of a cam, of the geometry of a gear pair and of its sliding.

Mistakes of other plans that are made on a cam's, too, are here as well.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable
from dataclasses import replace
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
    with_other,
)

MILLIMETRE = 1e-3  # m of paper: a pole distance that is left out
PART = re.compile(r"_part(\d+)")
CENTIMETRES = (10.0, 0.1)
SIZES, PLATE = "sizes", "plate_sizes"
DIAGRAM_SCALES = ("mu_s", "mu_ds", "mu_d2s")
RIGHT_ANGLE = 0.5 * math.pi


def _with_number(steps: Iterable[Step], place: int, value: float, how: str) -> Changes:
    """Put a number into each of some steps, and into all of them."""
    return each_and_all(with_operand(steps, place, constant(value)), how)


@mistake("M83")
def _pole_distance_lost(scene: Scene) -> Changes:
    """The pole distance is left out of a scale factor, or that of the other integration stands there."""
    found = scene.calculated("derived_scale")
    yield from _with_number(found, 2, MILLIMETRE, "none")
    distances = list(dict.fromkeys(step.operands[2] for step in found))
    if len(distances) == 2 and scene.values[distances[0]] != scene.values[distances[1]]:
        other = dict(zip(distances, reversed(distances), strict=True))
        steps = {s.name: (operand(s, 2, other[s.operands[2]]),) for s in found}
        yield Change(found[0].name, steps, "other")


@mistake("M84")
def _angles_to_another_scale(scene: Scene) -> Changes:
    """The scale factor of angles is in degrees, or left out, or is the angle of a whole section."""
    if found := scene.calculated("derived_scale"):
        mu = float(scene.values[found[0].operands[1]])
        yield from _with_number(found, 1, math.degrees(mu), "degrees")
        yield from _with_number(found, 1, 1.0, "none")
        yield from _with_number(found, 1, float(scene.values["_phi1"]), "section")


@mistake("M85")
def _angular_velocity_lost(scene: Scene) -> Changes:
    """The analogue is taken for the velocity, or for the acceleration; or omega is not squared."""
    speeds = scene.calculated("speed_scale")
    yield from _with_number(speeds, 0, 1.0, "none")
    for step in scene.calculated("acceleration_scale"):
        yield from _with_number([step], 0, 1.0, "none")
        yield otherwise(step, "once", law="speed_scale")
        for other in speeds:
            yield Change(other.name, with_operand((other, step), 0, "one"), "both")


@mistake("M86")
def _ordinates_of_the_wrong_line(scene: Scene) -> Changes:
    """The ordinate at the beginning or at the end of a section is taken for its mean."""
    means = [s for s in scene.calculated("part_of_amplitude") if role(s.name).kind == "mean"]
    for how, back, word in (("begin", 1, "after"), ("end", 0, "before")):
        steps = {s.name: (operand(s, 1, f"_part{int(role(s.name).of) - back}_{word}"),) for s in means}
        if steps:
            yield Change(scene.made_by("distance")[0].name, steps, how)


@mistake("M88", of="second_amplitude")
def _second_amplitude(scene: Scene, step: Step) -> Changes:
    """The ratio of the amplitudes is the wrong way round, or A_2 = A_1 u; in the calculation, or drawn so, too."""
    u = float(scene.values[step.operands[1]])
    right = u / (1.0 - u)
    for how, ratio in (("inverse", 1.0 / right), ("u", u), ("equal", 1.0)):
        if abs(ratio - right) > 1e-3 * right:
            alone = scaled(ratio / right, step, how=f"{how}, calculated")
            yield alone
            yield replace(alone, data=_second_lobes(scene, right, ratio / right), how=how)


def _second_lobes(scene: Scene, ratio: float, times: float) -> dict[str, float]:
    """Return the ordinates in the second lobe of each phase, the one whose height has the ratio, drawn higher."""
    givens, higher = scene.paper.givens, dict[str, float]()
    lines = {name: int(found[1]) for name in givens if (found := PART.match(name))}
    top = int(role(scene.made_by("distance")[0].operands[1]).of)  # of the travel, at the end of the rise
    for rises in (True, False):
        phase = {name: float(givens[name]) for name, line in lines.items() if (line <= top) is rises}
        lobes = [{n: v for n, v in phase.items() if sign * v > 0.0} for sign in (-1.0, 1.0)]
        second = min(lobes, key=lambda lobe: abs(max(map(abs, lobe.values()), default=0.0) - ratio))
        higher |= {name: value * times for name, value in second.items()}
    return higher


@mistake("M89")
def _transfer_angle(scene: Scene) -> Changes:
    """The line of transfer is inclined by the ratio the wrong way round; or the tangent is given for the angle."""
    steps = scene.calculated("transfer_angle")
    yield from each_and_all({s.name: (s.but(operands=s.operands[::-1]),) for s in steps}, "inverse")
    yield from each_and_all({s.name: (s.but(law="part_of"),) for s in steps}, "tangent")


@mistake("M17")
def _paper_for_size(scene: Scene) -> Changes:
    """An ordinate in millimetres of paper is given for what it shows."""
    steps = [s for s in scene.calculated("to_scale") if s.operands[0] in DIAGRAM_SCALES]
    yield from each_and_all({s.name: (s.but(operands=s.operands[1:], law="given"),) for s in steps}, "paper")


@mistake("M20", of=lambda scene: scene.made_by("distance"))
def _ordinates_in_centimetres(scene: Scene, step: Step) -> Changes:
    """An ordinate of a diagram is measured in centimetres."""
    if step.plan in scene.paper.unscaled or role(step.operands[0]).plan in scene.paper.unscaled:
        for factor in CENTIMETRES:
            yield scaled(factor, step, how=f"{factor} paper")


def _sizes_scaled(scene: Scene, plan: str, factor: float, how: str) -> Change:
    """Read all sizes on a plan as so many times larger."""
    steps = [s for s in scene.made_by("distance", "read") if role(s.operands[0]).plan == plan]
    return scaled(factor, *steps, how=how)


def _plans_of_sizes(scene: Scene) -> list[str]:
    """Return the plans from which sizes are read to a scale."""
    return [plan for plan in (SIZES, PLATE) if plan in scene.program.plans and plan in scene.paper.mus]


@mistake("M90")
def _unequal_scales(scene: Scene) -> Changes:
    """Ordinates of the diagrams are carried over as they are, to plans that need equal scales on both axes."""
    steps = [s for s in scene.calculated("ordinate_to_scale") if s.operands[0] == "mu_ds"]
    if steps and SIZES in scene.program.plans:
        yield Change("r_0", with_operand(steps, 0, "mu_s"), "ds")
    heights = [s for s in scene.calculated("part_of_amplitude") if s.operands[0] == "A_1"]
    if heights and "l_A1" in scene.paper.givens:
        first, name = heights[0], "_A_1_unequal"
        paper = Step("calc", name, ("mu_s", "l_A1"), "to_scale")
        flat = with_operand(heights, 0, name)
        yield Change("r_0_flat_min", {**flat, first.name: (paper, *flat[first.name])}, "d2s")


def _limits(scene: Scene) -> dict[str, float]:
    """Return the permitted transmission angle of every tangent."""
    givens = scene.paper.givens
    tangents = (s.operands[0] for s in scene.made_by("turn") if role(s.name).kind == "tangent")
    names = {role(name).of: float(givens[name]) for name in tangents if name in givens}
    return {limit: angle if angle < RIGHT_ANGLE else math.pi - angle for limit, angle in names.items()}


def _tangents(scene: Scene, angles: dict[str, float], how: str) -> Change:
    """Draw the tangents at other angles to the axis of the analogue."""
    given = {}
    for limit, gamma in angles.items():
        side = float(scene.paper.givens[f"_side_{limit}"])
        given[f"_inclination_{limit}"] = gamma if side > 0.0 else math.pi - gamma
        given[f"_slope_{limit}"] = side / math.tan(gamma)
    return Change("r_0", {}, how, given)


@mistake("M91")
def _angle_to_the_other_axis(scene: Scene) -> Changes:
    """Pressure angles and transmission angles are confused: tangents are inclined so to the other axis."""
    found = _limits(scene)
    if found:
        yield _tangents(scene, {limit: RIGHT_ANGLE - gamma for limit, gamma in found.items()}, "both")
        for limit, gamma in found.items():
            yield _tangents(scene, {limit: RIGHT_ANGLE - gamma}, limit)


@mistake("M92")
def _limits_exchanged(scene: Scene) -> Changes:
    """The tangent of the rise is drawn on the branch of the fall, and the other way round."""
    found = _limits(scene)
    pairs = {limit: limit.replace("rise", "?").replace("fall", "rise").replace("?", "fall") for limit in found}
    if found and any(found[pairs[limit]] != gamma for limit, gamma in found.items()):
        yield _tangents(scene, {limit: found[pairs[limit]] for limit in found}, "")


@mistake("M93")
def _half_the_angle(scene: Scene) -> Changes:
    """Tangents are drawn at half or at twice the permitted pressure angle."""
    found = _limits(scene)
    for how, times in (("half", 0.5), ("twice", 2.0)):
        angles = {limit: RIGHT_ANGLE - times * (RIGHT_ANGLE - gamma) for limit, gamma in found.items()}
        if angles and min(angles.values()) > 0.0:
            yield _tangents(scene, angles, how)


@mistake("M94")
def _other_rotation(scene: Scene) -> Changes:
    """The cam turns the other way: the branches change sides; or the profile is not inverted, or e on the other side.

    The first shows in the sign of e, the others in the curvature.
    """
    for step in scene.calculated("component"):
        if step.name == "e":
            yield instead(step, *then(step, "negative", aside(step.name)), how="sizes")
    for step in scene.calculated("sharpest"):
        turned = Step("calc", "_other_e", ("e",), "negative")
        yield instead(step, turned, operand(step, 1, "_other_e"), how="profile")


@mistake("M95")
def _radius_to_another_point(scene: Scene) -> Changes:
    """The depth of the cam's centre is given for its distance from the lowest place of the roller."""
    centre = next((s for s in scene.made_by("read") if s.name == "_centre"), None)
    for step in scene.made_by("distance"):
        if step.name == "r_0" and centre is not None and step.operands == centre.operands:
            depth = Step("calc", "_depth", ("_up", "_centre"), "component")
            steps = (centre, depth, Step("calc", step.name, ("_depth",), "negative"))
            yield Change(step.name, {step.name: steps, centre.name: ()})


@mistake("M96")
def _plate_by_another_line(scene: Scene) -> Changes:
    """The tangent at 45 degrees touches the positive branch; or none is drawn, and the greatest ordinate is taken."""
    last = scene.steps.get("_touch_plate")
    if last is not None:
        touching = [scene.steps[name] for name in last.operands[1:]]
        branch = with_operand(touching, 1, "one") | with_operand((last,), 0, "one")
        yield Change("r_0_flat_min", branch, "branch")
        yield Change("r_0_flat_min", with_operand(touching, 0, "zero"), "ordinate")


@mistake("M98")
def _roller_added(scene: Scene) -> Changes:
    """The curvature is that of the practical profile, or the roller is added where it is not to be."""
    if "rho_min" in scene.steps and scene.is_given("R_roller"):
        step = scene.steps["rho_min"]
        radius = float(scene.paper.givens["R_roller"])
        for how, value in (("less", -radius), ("more", radius)):
            yield instead(step, *then(step, "enlarged", aside(step.name), constant(value)), how=how)


@mistake("M99")
def _curvature_of_a_dwell(scene: Scene) -> Changes:
    """The curvature is measured on an arc about the cam's centre: that of a dwell, and not where it is sharpest."""
    if {"rho_min", "r_0"} <= scene.steps.keys():
        yield otherwise(scene.steps["rho_min"], "lower", operands=("r_0",), law="given")
    if {"rho_min", "e", "s_0"} <= scene.steps.keys():
        highest = Step("calc", "_highest", ("s_0", "h"), "enlarged")
        far = Step("calc", "rho_min", ("e", "_highest"), "hypotenuse")
        yield instead(scene.steps["rho_min"], highest, far, how="upper")


@mistake("M15", of=_plans_of_sizes, by_scale=True)
def _another_scale_of_sizes(scene: Scene, plan: str) -> Changes:
    """Sizes are read with the scale factor of a diagram."""
    for other in DIAGRAM_SCALES:
        if other in scene.steps:
            factor = float(scene.values[other]) / scene.mu(plan)
            yield _sizes_scaled(scene, plan, factor, other)


# sizes are given in millimetres of paper
mistake("M17", by_scale=True)(
    lambda scene: (_sizes_scaled(scene, p, 1e-3 / scene.mu(p), "paper") for p in _plans_of_sizes(scene))
)
# sizes are read in centimetres
mistake("M20")(lambda scene: (_sizes_scaled(scene, p, x, f"{x}") for p in _plans_of_sizes(scene) for x in CENTIMETRES))
# what is to be added to a size is left out, or twice the size is given: a diameter
each(
    "M97",
    lambda scene: (step for step in scene.calculated("enlarged") if not role(step.name).hidden),
    lambda step: with_other(step, 1, "zero", "none"),
    partial(scaled, 2.0, how="diameter"),
)
# an angle of a triangle is found at another corner
each(
    "M13",
    "angle_of_triangle",
    lambda step: otherwise(step, "first", operands=step.operands[::-1]),
    lambda step: otherwise(step, "second", operands=(step.operands[0], step.operands[2], step.operands[1])),
)
# the scale factor of the travel is millimetres by the stroke
each("M14", "scale_factor", lambda step: instead(step, *then(step, "part_of", "one", aside(step.name))))


# Gear pairs.

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
