"""Mistakes M83 to M99: of diagrams, sizes and profiles of a cam.

Mistakes of other plans that are made there, too, are here as well.
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
    aside,
    constant,
    each,
    each_and_all,
    instead,
    mistake,
    operand,
    otherwise,
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
            steps = (centre, Step("calc", step.name, ("_up", "_centre"), "component"))
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
