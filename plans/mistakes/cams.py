"""Diagrams of a cam and their scale factors: mistakes M83 to M89, and those of other plans that are made there, too."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator

from ..board import Step
from ..names import role
from .rules import Change, Chapter, Scene, all_scaled, aside, constant, instead, operand, scaled

MISTAKES = Chapter()
mistake = MISTAKES.enter
MILLIMETRE = 1e-3  # m of paper: a pole distance that is left out
PART = re.compile(r"_part(\d+)")
CENTIMETRES = (10.0, 0.1)


def with_operand(steps: list[Step], place: int, value: float, how: str) -> Iterator[Change]:
    """Put a number into each of some steps, and into all of them."""
    name = constant(value)
    changed = {step.name: (Step(step.verb, step.name, operand(step, place, name), step.law),) for step in steps}
    for step in steps:
        yield Change(step.name, {step.name: changed[step.name]}, {name: value}, how)
    if len(steps) > 1:
        yield Change(steps[0].name, changed, {name: value}, f"{how}, all")


def factors(scene: Scene) -> list[Step]:
    """Return the scale factors of the diagrams that are integrated: each is that of the next one over mu_phi H."""
    return list(scene.made_by("calc", law="derived_scale"))


@mistake("M83")
def pole_distance_lost(scene: Scene) -> Iterator[Change]:
    """The pole distance is left out of a scale factor, or that of the other integration stands there."""
    found = factors(scene)
    yield from with_operand(found, 2, MILLIMETRE, "none")
    distances = list(dict.fromkeys(step.operands[2] for step in found))
    if len(distances) == 2 and scene.values[distances[0]] != scene.values[distances[1]]:
        other = dict(zip(distances, reversed(distances), strict=True))
        steps = {s.name: (Step(s.verb, s.name, operand(s, 2, other[s.operands[2]]), s.law),) for s in found}
        yield Change(found[0].name, steps, {}, "other")


@mistake("M84")
def angles_to_another_scale(scene: Scene) -> Iterator[Change]:
    """The scale factor of angles is in degrees, or left out, or is the angle of a whole section."""
    found = factors(scene)
    if found:
        mu = float(scene.values[found[0].operands[1]])
        yield from with_operand(found, 1, math.degrees(mu), "degrees")
        yield from with_operand(found, 1, 1.0, "none")
        yield from with_operand(found, 1, float(scene.values["_phi1"]), "section")


@mistake("M85")
def angular_velocity_lost(scene: Scene) -> Iterator[Change]:
    """The analogue is taken for the velocity, or for the acceleration; or omega is not squared."""
    speeds = list(scene.made_by("calc", law="speed_scale"))
    yield from with_operand(speeds, 0, 1.0, "none")
    for step in scene.made_by("calc", law="acceleration_scale"):
        yield from with_operand([step], 0, 1.0, "none")
        yield instead(step, "once", law="speed_scale")
        for other in speeds:
            one = {s.name: (Step(s.verb, s.name, operand(s, 0, "one"), s.law),) for s in (other, step)}
            yield Change(other.name, one, {}, "both")


@mistake("M86")
def ordinates_of_the_wrong_line(scene: Scene) -> Iterator[Change]:
    """The ordinate at the beginning or at the end of a section is taken for its mean."""
    means = {s.name: s for s in scene.made_by("calc", law="part_of_amplitude") if role(s.name).kind == "mean"}
    for how, back, word in (("begin", 1, "after"), ("end", 0, "before")):
        steps = {}
        for name, step in means.items():
            part = f"_part{int(role(name).of) - back}_{word}"
            steps[name] = (Step(step.verb, name, operand(step, 1, part), step.law),)
        if steps:
            yield Change(next(scene.made_by("distance")).name, steps, {}, how)


@mistake("M88")
def second_amplitude(scene: Scene) -> Iterator[Change]:
    """The ratio of the amplitudes is the wrong way round, or A_2 = A_1 u; in the calculation, or drawn so, too."""
    for step in scene.made_by("calc", law="second_amplitude"):
        u = float(scene.values[step.operands[1]])
        right = u / (1.0 - u)
        for how, ratio in (("inverse", 1.0 / right), ("u", u), ("equal", 1.0)):
            if abs(ratio - right) > 1e-3 * right:
                alone = scaled(step, ratio / right, f"{how}, calculated")
                yield alone
                yield _drawn(scene, alone, ratio / right, right, how)


def _drawn(scene: Scene, alone: Change, times: float, right: float, how: str) -> Change:
    """Return the change in which the second lobes are drawn as high as they have been calculated."""
    givens = scene.paper.givens
    parts = {name: float(givens[name]) for name in givens if PART.match(name)}
    highest = next(scene.made_by("distance")).operands[1]  # of the travel, at the end of the rise
    second = set(_second_lobe(parts, right, int(role(highest).of)))
    higher = {name: value * times for name, value in parts.items() if name in second}
    return Change(alone.at, alone.steps, {**alone.givens, **higher}, how)


def _second_lobe(parts: dict[str, float], ratio: float, top: int) -> Iterator[str]:
    """Go through the parts of ordinates in the second lobe of each phase: the one whose height has the ratio."""
    for rises in (True, False):
        phase = {n: v for n, v in parts.items() if (_line(n) <= top) is rises}
        lobes = [{n: v for n, v in phase.items() if sign * v > 0.0} for sign in (-1.0, 1.0)]
        yield from min(lobes, key=lambda lobe: abs(max(map(abs, lobe.values()), default=0.0) - ratio))


def _line(name: str) -> int:
    found = PART.match(name)
    assert found is not None
    return int(found[1])


@mistake("M89")
def transfer_angle(scene: Scene) -> Iterator[Change]:
    """The line of transfer is inclined by the ratio the wrong way round; or the tangent is given for the angle."""
    steps = list(scene.made_by("calc", law="transfer_angle"))
    turned = {s.name: (Step(s.verb, s.name, s.operands[::-1], s.law),) for s in steps}
    ratio = {s.name: (Step(s.verb, s.name, s.operands, "part_of"),) for s in steps}
    for how, changed in (("inverse", turned), ("tangent", ratio)):
        for name, step in changed.items():
            yield Change(name, {name: step}, {}, how)
        if len(steps) > 1:
            yield Change(steps[0].name, changed, {}, f"{how}, all")


@mistake("M14")
def scale_factor_upside_down(scene: Scene) -> Iterator[Change]:
    """The scale factor of the travel is millimetres by the stroke."""
    for step in scene.made_by("calc", law="scale_factor"):
        right = aside(step.name)
        steps = (Step("calc", right, step.operands, step.law), Step("calc", step.name, ("one", right), "part_of"))
        yield Change(step.name, {step.name: steps}, {})


@mistake("M17")
def paper_for_size(scene: Scene) -> Iterator[Change]:
    """An ordinate in millimetres of paper is given for what it shows."""
    steps = [s for s in scene.made_by("calc", law="to_scale") if s.operands[0] in ("mu_s", "mu_ds", "mu_d2s")]
    changed = {s.name: (Step("calc", s.name, s.operands[1:], "given"),) for s in steps}
    for name, step in changed.items():
        yield Change(name, {name: step}, {}, "paper")
    if len(steps) > 1:
        yield Change(steps[0].name, changed, {}, "paper, all")


@mistake("M20")
def ordinates_in_centimetres(scene: Scene) -> Iterator[Change]:
    """An ordinate of a diagram is measured in centimetres."""
    for step in scene.made_by("distance"):
        if step.plan in scene.paper.unscaled or role(step.operands[0]).plan in scene.paper.unscaled:
            for factor in CENTIMETRES:
                yield scaled(step, factor, f"{factor} paper")


def sizes_scaled(scene: Scene, plan: str, factor: float, how: str) -> Change:
    """Read all sizes on a plan as so many times larger."""
    steps = [s for s in scene.made_by("distance", "read") if role(s.operands[0]).plan == plan]
    return all_scaled(steps[0].name, steps, factor, how)
