"""Diagrams, sizes and profiles of a cam: mistakes M83 to M99, and those of other plans that are made there, too."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator
from dataclasses import replace

from ..board import Step
from ..names import role
from .rules import Change, Chapter, Scene, aside, constant, operand, then, with_operand

MISTAKES = Chapter()
mistake, each = MISTAKES.enter, MISTAKES.each
MILLIMETRE = 1e-3  # m of paper: a pole distance that is left out
PART = re.compile(r"_part(\d+)")
CENTIMETRES = (10.0, 0.1)
SIZES, PLATE = "sizes", "plate_sizes"
DIAGRAM_SCALES = ("mu_s", "mu_ds", "mu_d2s")
RIGHT_ANGLE = 0.5 * math.pi


def with_number(steps: Iterable[Step], place: int, value: float, how: str) -> Iterator[Change]:
    """Put a number into each of some steps, and into all of them."""
    name = constant(value)
    return Change.each_and_all(with_operand(steps, place, name), how, {name: value})


@mistake("M83")
def pole_distance_lost(scene: Scene) -> Iterator[Change]:
    """The pole distance is left out of a scale factor, or that of the other integration stands there."""
    found = scene.calculated("derived_scale")
    yield from with_number(found, 2, MILLIMETRE, "none")
    distances = list(dict.fromkeys(step.operands[2] for step in found))
    if len(distances) == 2 and scene.values[distances[0]] != scene.values[distances[1]]:
        other = dict(zip(distances, reversed(distances), strict=True))
        steps = {s.name: (operand(s, 2, other[s.operands[2]]),) for s in found}
        yield Change(found[0].name, steps, {}, "other")


@mistake("M84")
def angles_to_another_scale(scene: Scene) -> Iterator[Change]:
    """The scale factor of angles is in degrees, or left out, or is the angle of a whole section."""
    if found := scene.calculated("derived_scale"):
        mu = float(scene.values[found[0].operands[1]])
        yield from with_number(found, 1, math.degrees(mu), "degrees")
        yield from with_number(found, 1, 1.0, "none")
        yield from with_number(found, 1, float(scene.values["_phi1"]), "section")


@mistake("M85")
def angular_velocity_lost(scene: Scene) -> Iterator[Change]:
    """The analogue is taken for the velocity, or for the acceleration; or omega is not squared."""
    speeds = scene.calculated("speed_scale")
    yield from with_number(speeds, 0, 1.0, "none")
    for step in scene.calculated("acceleration_scale"):
        yield from with_number([step], 0, 1.0, "none")
        yield Change.instead(step, "once", law="speed_scale")
        for other in speeds:
            yield Change(other.name, with_operand((other, step), 0, "one"), {}, "both")


@mistake("M86")
def ordinates_of_the_wrong_line(scene: Scene) -> Iterator[Change]:
    """The ordinate at the beginning or at the end of a section is taken for its mean."""
    means = [s for s in scene.calculated("part_of_amplitude") if role(s.name).kind == "mean"]
    for how, back, word in (("begin", 1, "after"), ("end", 0, "before")):
        steps = {s.name: (operand(s, 1, f"_part{int(role(s.name).of) - back}_{word}"),) for s in means}
        if steps:
            yield Change(scene.made_by("distance")[0].name, steps, {}, how)


@mistake("M88")
def second_amplitude(scene: Scene) -> Iterator[Change]:
    """The ratio of the amplitudes is the wrong way round, or A_2 = A_1 u; in the calculation, or drawn so, too."""
    for step in scene.calculated("second_amplitude"):
        u = float(scene.values[step.operands[1]])
        right = u / (1.0 - u)
        for how, ratio in (("inverse", 1.0 / right), ("u", u), ("equal", 1.0)):
            if abs(ratio - right) > 1e-3 * right:
                alone = Change.scaled(step, ratio / right, f"{how}, calculated")
                higher = _second_lobes(scene, right, ratio / right)
                yield alone
                yield replace(alone, givens={**alone.givens, **higher}, how=how)


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
def transfer_angle(scene: Scene) -> Iterator[Change]:
    """The line of transfer is inclined by the ratio the wrong way round; or the tangent is given for the angle."""
    steps = scene.calculated("transfer_angle")
    yield from Change.each_and_all({s.name: (s.but(operands=s.operands[::-1]),) for s in steps}, "inverse")
    yield from Change.each_and_all({s.name: (s.but(law="part_of"),) for s in steps}, "tangent")


@mistake("M17")
def paper_for_size(scene: Scene) -> Iterator[Change]:
    """An ordinate in millimetres of paper is given for what it shows."""
    steps = [s for s in scene.calculated("to_scale") if s.operands[0] in DIAGRAM_SCALES]
    yield from Change.each_and_all({s.name: (s.but(operands=s.operands[1:], law="given"),) for s in steps}, "paper")


@mistake("M20")
def ordinates_in_centimetres(scene: Scene) -> Iterator[Change]:
    """An ordinate of a diagram is measured in centimetres."""
    for step in scene.made_by("distance"):
        if step.plan in scene.paper.unscaled or role(step.operands[0]).plan in scene.paper.unscaled:
            for factor in CENTIMETRES:
                yield Change.scaled(step, factor, f"{factor} paper")


def sizes_scaled(scene: Scene, plan: str, factor: float, how: str) -> Change:
    """Read all sizes on a plan as so many times larger."""
    steps = [s for s in scene.made_by("distance", "read") if role(s.operands[0]).plan == plan]
    return Change.all_scaled(steps[0].name, steps, factor, how)


def plans_of_sizes(scene: Scene) -> list[str]:
    """Return the plans from which sizes are read to a scale."""
    return [plan for plan in (SIZES, PLATE) if plan in scene.program.plans and plan in scene.paper.mus]


@mistake("M90")
def unequal_scales(scene: Scene) -> Iterator[Change]:
    """Ordinates of the diagrams are carried over as they are, to plans that need equal scales on both axes."""
    steps = [s for s in scene.calculated("ordinate_to_scale") if s.operands[0] == "mu_ds"]
    if steps and SIZES in scene.program.plans:
        yield Change("r_0", with_operand(steps, 0, "mu_s"), {}, "ds")
    heights = [s for s in scene.calculated("part_of_amplitude") if s.operands[0] == "A_1"]
    if heights and "l_A1" in scene.paper.givens:
        first, name = heights[0], "_A_1_unequal"
        paper = Step("calc", name, ("mu_s", "l_A1"), "to_scale")
        flat = with_operand(heights, 0, name)
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
    for step in scene.calculated("component"):
        if step.name == "e":
            yield Change(step.name, {step.name: then(step, "negative", aside(step.name))}, {}, "sizes")
    for step in scene.calculated("sharpest"):
        turned = Step("calc", "_other_e", ("e",), "negative")
        yield Change(step.name, {step.name: (turned, operand(step, 1, "_other_e"))}, {}, "profile")


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
        branch = with_operand(touching, 1, "one") | with_operand((last,), 0, "one")
        yield Change("r_0_flat_min", branch, {}, "branch")
        yield Change("r_0_flat_min", with_operand(touching, 0, "zero"), {}, "ordinate")


@mistake("M97")
def not_added(scene: Scene) -> Iterator[Change]:
    """What is to be added to a size is left out, or twice the size is given: a diameter."""
    for step in scene.calculated("enlarged"):
        if not role(step.name).hidden:
            yield Change.with_other(step, 1, "zero", "none")
            yield Change.scaled(step, 2.0, "diameter")


@mistake("M98")
def roller_added(scene: Scene) -> Iterator[Change]:
    """The curvature is that of the practical profile, or the roller is added where it is not to be."""
    if "rho_min" in scene.steps and scene.is_given("R_roller"):
        step = scene.steps["rho_min"]
        radius = float(scene.paper.givens["R_roller"])
        for how, value in (("less", -radius), ("more", radius)):
            steps = then(step, "enlarged", aside(step.name), constant(value))
            yield Change(step.name, {step.name: steps}, {constant(value): value}, how)


@mistake("M99")
def curvature_of_a_dwell(scene: Scene) -> Iterator[Change]:
    """The curvature is measured on an arc about the cam's centre: that of a dwell, and not where it is sharpest."""
    if {"rho_min", "r_0"} <= scene.steps.keys():
        yield Change.instead(scene.steps["rho_min"], "lower", operands=("r_0",), law="given")
    if {"rho_min", "e", "s_0"} <= scene.steps.keys():
        highest = Step("calc", "_highest", ("s_0", "h"), "enlarged")
        far = Step("calc", "rho_min", ("e", "_highest"), "hypotenuse")
        yield Change("rho_min", {"rho_min": (highest, far)}, {}, "upper")


@mistake("M13")
def sides_exchanged(scene: Scene) -> Iterator[Change]:
    """An angle of a triangle is found at another corner."""
    for step in scene.calculated("angle_of_triangle"):
        a, b, opposite = step.operands
        yield Change.instead(step, "first", operands=(opposite, b, a))
        yield Change.instead(step, "second", operands=(a, opposite, b))


@mistake("M15", by_scale=True)
def another_scale_of_sizes(scene: Scene) -> Iterator[Change]:
    """Sizes are read with the scale factor of a diagram."""
    for plan in plans_of_sizes(scene):
        for other in DIAGRAM_SCALES:
            if other in scene.steps:
                factor = float(scene.values[other]) / scene.mu(plan)
                yield sizes_scaled(scene, plan, factor, other)


# sizes are given in millimetres of paper
mistake("M17", by_scale=True)(
    lambda scene: (sizes_scaled(scene, p, 1e-3 / scene.mu(p), "paper") for p in plans_of_sizes(scene))
)
# sizes are read in centimetres
mistake("M20")(lambda scene: (sizes_scaled(scene, p, x, f"{x}") for p in plans_of_sizes(scene) for x in CENTIMETRES))
# the scale factor of the travel is millimetres by the stroke
each("M14", "scale_factor", lambda s: Change(s.name, {s.name: then(s, "part_of", "one", aside(s.name))}, {}))
