"""Sizes and profiles of a cam: mistakes M90 to M99, and those of other plans that are made there, too."""

from __future__ import annotations

import math
from collections.abc import Iterator

from ..board import Step
from ..names import role
from .cams import sizes_scaled
from .rules import Change, Chapter, Scene, aside, constant, instead, operand, scaled

MISTAKES = Chapter()
mistake = MISTAKES.enter
SIZES, PLATE = "sizes", "plate_sizes"
OTHERS = ("mu_s", "mu_ds", "mu_d2s")
RIGHT_ANGLE = 0.5 * math.pi


def plans_of_sizes(scene: Scene) -> list[str]:
    """Return the plans from which sizes are read to a scale."""
    return [plan for plan in (SIZES, PLATE) if plan in scene.program.plans and plan in scene.paper.mus]


@mistake("M90")
def unequal_scales(scene: Scene) -> Iterator[Change]:
    """Ordinates of the diagrams are carried over as they are, to plans that need equal scales on both axes."""
    steps = [s for s in scene.made_by("calc", law="ordinate_to_scale") if s.operands[0] == "mu_ds"]
    changed = {s.name: (Step(s.verb, s.name, operand(s, 0, "mu_s"), s.law),) for s in steps}
    if changed and SIZES in scene.program.plans:
        yield Change("r_0", changed, {}, "ds")
    heights = [s for s in scene.made_by("calc", law="part_of_amplitude") if s.operands[0] == "A_1"]
    if heights and "l_A1" in scene.paper.givens:
        first, name = heights[0], "_A_1_unequal"
        paper = Step("calc", name, ("mu_s", "l_A1"), "to_scale")
        flat = {s.name: (Step(s.verb, s.name, operand(s, 0, name), s.law),) for s in heights}
        yield Change("r_0_flat_min", {**flat, first.name: (paper, *flat[first.name])}, {}, "d2s")


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
    return Change("r_0", {}, given, how)


@mistake("M91")
def angle_to_the_other_axis(scene: Scene) -> Iterator[Change]:
    """Pressure angles and transmission angles are confused: tangents are inclined so to the other axis."""
    found = _limits(scene)
    if found:
        yield _tangents(scene, {limit: RIGHT_ANGLE - gamma for limit, gamma in found.items()}, "both")
        for limit, gamma in found.items():
            yield _tangents(scene, {limit: RIGHT_ANGLE - gamma}, limit)


@mistake("M92")
def limits_exchanged(scene: Scene) -> Iterator[Change]:
    """The tangent of the rise is drawn on the branch of the fall, and the other way round."""
    found = _limits(scene)
    pairs = {limit: limit.replace("rise", "?").replace("fall", "rise").replace("?", "fall") for limit in found}
    if found and any(found[pairs[limit]] != gamma for limit, gamma in found.items()):
        yield _tangents(scene, {limit: found[pairs[limit]] for limit in found}, "")


@mistake("M93")
def half_the_angle(scene: Scene) -> Iterator[Change]:
    """Tangents are drawn at half or at twice the permitted pressure angle."""
    found = _limits(scene)
    for how, times in (("half", 0.5), ("twice", 2.0)):
        angles = {limit: RIGHT_ANGLE - times * (RIGHT_ANGLE - gamma) for limit, gamma in found.items()}
        if angles and min(angles.values()) > 0.0:
            yield _tangents(scene, angles, how)


@mistake("M94")
def other_rotation(scene: Scene) -> Iterator[Change]:
    """The cam turns the other way: the branches change sides; or the profile is not inverted, or e on the other side.

    The first shows in the sign of e, the others in the curvature.
    """
    for step in scene.made_by("calc", law="component"):
        if step.name == "e":
            right = aside(step.name)
            steps = (Step(step.verb, right, step.operands, step.law), Step("calc", step.name, (right,), "negative"))
            yield Change(step.name, {step.name: steps}, {}, "sizes")
    for step in scene.made_by("calc", law="sharpest"):
        turned = Step("calc", "_other_e", ("e",), "negative")
        other = Step(step.verb, step.name, operand(step, 1, "_other_e"), step.law)
        yield Change(step.name, {step.name: (turned, other)}, {}, "profile")


@mistake("M95")
def radius_to_another_point(scene: Scene) -> Iterator[Change]:
    """The depth of the cam's centre is given for its distance from the lowest place of the roller."""
    centre = next((s for s in scene.made_by("read") if s.name == "_centre"), None)
    for step in scene.made_by("distance"):
        if step.name == "r_0" and centre is not None and step.operands == centre.operands:
            depth = Step("calc", "_depth", ("_up", "_centre"), "component")
            steps = (centre, depth, Step("calc", step.name, ("_depth",), "negative"))
            yield Change(step.name, {step.name: steps, centre.name: ()}, {})


@mistake("M96")
def plate_by_another_line(scene: Scene) -> Iterator[Change]:
    """The tangent at 45 degrees touches the positive branch; or none is drawn, and the greatest ordinate is taken."""
    last = scene.steps.get("_touch_plate")
    if last is not None:
        touching = [scene.steps[name] for name in last.operands[1:]]
        steps = {s.name: (Step(s.verb, s.name, operand(s, 1, "one"), s.law),) for s in touching}
        steps[last.name] = (Step(last.verb, last.name, operand(last, 0, "one"), last.law),)
        yield Change("r_0_flat_min", steps, {}, "branch")
        upright = {s.name: (Step(s.verb, s.name, operand(s, 0, "zero"), s.law),) for s in touching}
        yield Change("r_0_flat_min", upright, {}, "ordinate")


@mistake("M97")
def not_added(scene: Scene) -> Iterator[Change]:
    """What is to be added to a size is left out, or twice the size is given: a diameter."""
    for step in scene.made_by("calc", law="enlarged"):
        if not role(step.name).hidden:
            yield instead(step, "none", operands=operand(step, 1, "zero"))
            yield scaled(step, 2.0, "diameter")


@mistake("M98")
def roller_added(scene: Scene) -> Iterator[Change]:
    """The curvature is that of the practical profile, or the roller is added where it is not to be."""
    if "rho_min" in scene.steps and scene.is_given("R_roller"):
        step = scene.steps["rho_min"]
        radius = float(scene.paper.givens["R_roller"])
        for how, value in (("less", -radius), ("more", radius)):
            right, name = aside(step.name), constant(value)
            steps = (
                Step(step.verb, right, step.operands, step.law),
                Step("calc", step.name, (right, name), "enlarged"),
            )
            yield Change(step.name, {step.name: steps}, {name: value}, how)


@mistake("M99")
def curvature_of_a_dwell(scene: Scene) -> Iterator[Change]:
    """The curvature is measured on an arc about the cam's centre: that of a dwell, and not where it is sharpest."""
    if {"rho_min", "r_0"} <= scene.steps.keys():
        yield instead(scene.steps["rho_min"], "lower", operands=("r_0",), law="given")
    if {"rho_min", "e", "s_0"} <= scene.steps.keys():
        highest = Step("calc", "_highest", ("s_0", "h"), "enlarged")
        far = Step("calc", "rho_min", ("e", "_highest"), "hypotenuse")
        yield Change("rho_min", {"rho_min": (highest, far)}, {}, "upper")


@mistake("M13")
def sides_exchanged(scene: Scene) -> Iterator[Change]:
    """An angle of a triangle is found at another corner."""
    for step in scene.made_by("calc", law="angle_of_triangle"):
        a, b, opposite = step.operands
        yield instead(step, "first", operands=(opposite, b, a))
        yield instead(step, "second", operands=(a, opposite, b))


@mistake("M15", by_scale=True)
def another_scale_of_sizes(scene: Scene) -> Iterator[Change]:
    """Sizes are read with the scale factor of a diagram."""
    for plan in plans_of_sizes(scene):
        for other in OTHERS:
            if other in scene.steps:
                factor = float(scene.values[other]) / scene.mu(plan)
                yield sizes_scaled(scene, plan, factor, other)


@mistake("M17", by_scale=True)
def paper_for_sizes(scene: Scene) -> Iterator[Change]:
    """Sizes are given in millimetres of paper."""
    for plan in plans_of_sizes(scene):
        yield sizes_scaled(scene, plan, 1e-3 / scene.mu(plan), "paper")


@mistake("M20")
def sizes_in_centimetres(scene: Scene) -> Iterator[Change]:
    """Sizes are read in centimetres."""
    for plan in plans_of_sizes(scene):
        for factor in (10.0, 0.1):
            yield sizes_scaled(scene, plan, factor, f"{factor}")
