"""Forces and force plans: mistakes M57 to M76, M118, M119, M122, M124; M74, another scale, stands with the scales."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace

from ..board import POSITION, Step
from ..names import FORCES, MAGNITUDE, role
from ..quantities import F_BAL
from .rules import (
    Change,
    Chapter,
    Scene,
    all_scaled,
    aside,
    constant,
    instead,
    length_of,
    nothing,
    operand,
    opposed,
    reversed_,
    scaled,
    with_sign,
)

MISTAKES = Chapter()
mistake = MISTAKES.enter
G = 9.81


def inertia_forces(scene: Scene) -> list[Step]:
    """Return the calculations of inertia forces."""
    return list(scene.made_by("calc", law="inertia_force"))


def inertia_moments(scene: Scene) -> list[Step]:
    """Return the calculations of inertia moments."""
    return list(scene.made_by("calc", law="inertia_moment"))


def hung(scene: Scene) -> dict[str, list[Step]]:
    """Return the steps that hang each force on a force plan."""
    found: dict[str, list[Step]] = {}
    for step in scene.made_by("chain", plan=FORCES):
        found.setdefault(step.operands[1], []).append(step)
    return found


def loads(scene: Scene) -> list[str]:
    """Return the forces that are known beforehand: inertia forces, weights, outer loads."""
    return [force for force in hung(scene) if role(force).kind != "R" and role(force).shown != F_BAL]


@mistake("M57")
def along_acceleration(scene: Scene) -> Iterator[Change]:
    """Inertia forces are drawn along the accelerations: one of them, or all."""
    steps = inertia_forces(scene)
    yield from map(opposed, steps)
    if len(steps) > 1:
        yield Change("F_i", {step.name: reversed_(step) for step in steps}, {}, "all")


@mistake("M58")
def force_left_out(scene: Scene) -> Iterator[Change]:
    """A known force is left out of the polygon, or of everything."""
    polygons = hung(scene)
    for force in loads(scene):
        gone = {step.name: (Step("same", step.name, step.operands[:1]),) for step in polygons[force]}
        yield Change(force, gone, {}, "polygon")
        made = scene.steps[force]
        if made.verb == "calc":
            yield Change(force, {force: nothing(made)}, {}, "everywhere")
    weights = list(scene.made_by("calc", law="weight"))
    if len(weights) > 1:
        yield Change("G", {step.name: nothing(step) for step in weights}, {}, "all")


@mistake("M59")
def force_reversed(scene: Scene) -> Iterator[Change]:
    """A known force acts the other way: in the polygon, or everywhere."""
    inertia = {step.name for step in inertia_forces(scene)}
    for force in loads(scene):
        against = f"_against_{force}"
        opposite = Step("calc", against, (force,), "opposite")
        turned = {
            step.name: (opposite, replace(step, operands=(step.operands[0], against))) for step in hung(scene)[force]
        }
        yield Change(force, turned, {}, "polygon")
        made = scene.steps[force]
        if force not in inertia and made.law in ("along", "weight"):
            yield opposed(made, "everywhere")


@mistake("M60")
def inertia_moment_lost(scene: Scene) -> Iterator[Change]:
    """The inertia moment is forgotten, or has the wrong sense."""
    for step in inertia_moments(scene):
        yield scaled(step, 0.0, "none")
        yield opposed(step, "sense")


def _is_couple(name: str) -> bool:
    """Whether a name is that of a couple, no moment of a force."""
    return role(name).kind == "M" and not role(name).hidden


def sums(scene: Scene) -> Iterator[tuple[Step, list[str]]]:
    """Go through the equations and sums of moments, the lever's too, with the couples in them."""
    for step in scene.made_by("calc"):
        if step.law in ("moment_equation", "closing_moment", "closing_force"):
            first = 0 if step.law == "closing_moment" else 1
            yield step, [name for name in step.operands[first:] if _is_couple(name) and scene.values[name]]
        elif step.law == "sum" and _is_couple(step.name):
            yield step, [name for name in step.operands if scene.values[name]]


@mistake("M60")
def inertia_moment_in_equation(scene: Scene) -> Iterator[Change]:
    """The inertia moment has the wrong sense in an equation of moments."""
    for step, names in sums(scene):
        for name in names:
            against = f"_against_{name}"
            turned = Step("calc", against, (name,), "opposite")
            operands = tuple(against if x == name else x for x in step.operands)
            yield Change(step.name, {step.name: (turned, replace(step, operands=operands))}, {}, f"equation {name}")


@mistake("M119")
def moment_left_out(scene: Scene) -> Iterator[Change]:
    """A moment is left out of an equation or a sum of moments."""
    for step, names in sums(scene):
        for name in names:
            yield instead(step, name, operands=tuple("zero" if x == name else x for x in step.operands))


@mistake("M118")
def sign_of_moment(scene: Scene) -> Iterator[Change]:
    """The moment of one force has the wrong sign in an equation of moments."""
    for step in scene.made_by("calc"):
        if step.law in ("moment_equation", "closing_moment", "closing_force"):
            taken = [scene.steps[name] for name in step.operands if name in scene.steps and scene.values[name]]
            if len(taken) > 1:
                yield from (opposed(one, step.name) for one in taken if one.verb == "moment")


@mistake("M122")
def another_acceleration(scene: Scene) -> Iterator[Change]:
    """An inertia force is calculated with the acceleration of another point."""
    read = [s.name for s in scene.made_by("read", plan="acceleration") if s.operands[0] == "acceleration.p"]
    absolute = [name for name in read if name not in scene.laid_off or name == f"a_{scene.pin}"]
    for step in inertia_forces(scene):
        for name in absolute:
            if name != step.operands[1] and abs(scene.values[name] - scene.values[step.operands[1]]):
                yield instead(step, name, operands=operand(step, 1, name))


@mistake("M124")
def balance_in_millimetres(scene: Scene) -> Iterator[Change]:
    """What balances the driver is found with arms in millimetres."""
    for step in scene.made_by("calc"):
        if step.law in ("closing_moment", "closing_force", "crank_moment") and "bal" in step.name:
            yield scaled(step, 1000.0)


@mistake("M61")
def inertia_about_end(scene: Scene) -> Iterator[Change]:
    """The moment of inertia is taken about the end of the link: m l^2 / 3 for m l^2 / 12."""
    for name, steps in (("M_i", inertia_moments(scene)), ("J", list(scene.made_by("calc", law="inertia_by_length")))):
        yield from (scaled(step, 4.0) for step in steps)
        if len(steps) > 1:
            yield all_scaled(name, steps, 4.0, "all")


@mistake("M62")
def force_at_wrong_point(scene: Scene) -> Iterator[Change]:
    """An inertia force stands at a joint or in the middle of the link, instead of the centre of mass."""
    inertia = {step.name for step in inertia_forces(scene)}
    for step in scene.made_by("moment"):
        force, at, _ = step.operands
        centre = scene.steps.get(at)
        if (
            force not in inertia
            or role(at).plan != POSITION
            or centre is None
            or centre.verb not in ("divide", "similar")
        ):
            continue
        for end in centre.operands[:2]:  # about the end where it is thought to act it has no moment
            yield instead(step, end, operands=operand(step, 1, end))
        half, middle = constant(0.5), f"_middle_of_{at}"
        point = Step("divide", middle, (*centre.operands[:2], half, "one"))
        moved = replace(step, operands=operand(step, 1, middle))
        yield Change(step.name, {step.name: (point, moved)}, {half: 0.5}, "middle")


def free_fall(scene: Scene) -> float:
    """Return the acceleration of free fall: that of the weights, or the usual one where nothing weighs anything."""
    given = (step.operands[1] for step in scene.made_by("calc", law="weight"))
    return float(next((scene.paper.givens[name] for name in given if scene.is_given(name)), G))


@mistake("M63")
def mass_and_weight(scene: Scene) -> Iterator[Change]:
    """The weight stands for the mass in inertia forces, or the mass for the weight."""
    fall = free_fall(scene)
    for law, factor in (("inertia_force", fall), ("weight", 1.0 / fall)):
        steps = list(scene.made_by("calc", law=law))
        yield from (scaled(step, factor) for step in steps)
        if len(steps) > 1:
            yield all_scaled(law, steps, factor, "all")


@mistake("M64")
def load_from_pressure(scene: Scene) -> Iterator[Change]:
    """The force on a piston from its diameter in the place of the radius, without pi / 4, or in kilonewtons."""
    for step in scene.made_by("calc"):
        size = step.operands[0] if step.operands else ""
        if (
            step.law in ("along", "resisting_force", "resisting_along")
            and role(step.name).kind in ("F", "P")
            and (role(size).kind == MAGNITUDE or role(size).hidden)
        ):
            for factor in (4.0, 4.0 / math.pi, 1e3, 1e-3, 1e6, 1e-6):
                yield scaled(step, factor, f"{factor:.4g}")


@mistake("M65")
def resistance_along_motion(scene: Scene) -> Iterator[Change]:
    """A resistance acts along the motion, or in the idle stroke too."""
    for law in ("resisting_force", "resisting_along", "resisting_moment"):
        yield from map(opposed, scene.made_by("calc", law=law))
    outer = (step for step in scene.made_by("calc", law="along") if scene.is_given(f"|{step.name}|"))
    yield from map(opposed, outer)
    for step in scene.made_by("calc"):
        if step.law in ("in_working", "in_idle"):
            yield instead(step, "other stroke", law="in_idle" if step.law == "in_working" else "in_working")


def moments(scene: Scene) -> Iterator[Step]:
    """Go through the moments taken on the plan of the mechanism."""
    return (step for step in scene.made_by("moment") if role(step.operands[1]).plan == POSITION)


def to_point(scene: Scene, step: Step) -> Change:
    """Measure the arm of a moment to the point of application."""
    force, at, about = step.operands
    size, arm, turning = length_of(force), f"_way_{step.name}", f"_whole_{step.name}"
    way = Step("distance", arm, (at, about))
    product = Step("calc", turning, (size[-1].name, arm), "crank_moment")
    return with_sign(step, (*size, way, product), scene.values[step.name])


def equations(scene: Scene) -> Iterator[tuple[Step, list[Step]]]:
    """Go through the moment equations of the force plans, with the moments of forces in them."""
    for step in scene.made_by("calc", law="moment_equation"):
        taken = [scene.steps[name] for name in step.operands[1:] if name in scene.steps]
        found = [s for s in taken if s.verb == "moment" and role(s.operands[1]).plan == POSITION]
        if role(step.name).kind == "R":
            yield step, found


@mistake("M67")
def arms_from_another_hinge(scene: Scene) -> Iterator[Change]:
    """Moments are taken about one hinge with arms measured from another."""
    for equation, found in equations(scene):
        direction = next((s for s in scene.made_by("lay", "back") if equation.name in s.operands), None)
        link = scene.steps.get(scene.along(direction.operands[1])) if direction else None
        if link is None or link.verb != "direction":
            continue
        new = {}
        for step in found:
            other = next((end for end in link.operands[:2] if end != step.operands[2]), None)
            if other is not None and step.operands[2] in link.operands[:2]:
                new[step.name] = (replace(step, operands=operand(step, 2, other)),)
        if new:
            yield Change(equation.name, new, {})


@mistake("M68", by_scale=True)
def arms_in_millimetres(scene: Scene) -> Iterator[Change]:
    """Arms in millimetres beside a moment in newton metres, or the other way round."""
    for equation, _ in equations(scene):
        couples = [
            name
            for name in equation.operands[1:]
            if not (role(name).kind == "M" and role(name).hidden) and scene.values[name]
        ]
        for factor, how in ((scene.mu("position"), "mu"), (1e3, "mm"), (1e-3, "m")):
            new, operands = [], list(equation.operands)
            for name in couples:
                weighted = f"_weighted_{name}"
                new.append(Step("calc", weighted, (constant(factor), name), "along"))
                operands[operands.index(name)] = weighted
            if new:
                steps = (*new, replace(equation, operands=tuple(operands)))
                yield Change(equation.name, {equation.name: steps}, {constant(factor): factor}, how)


@mistake("M70")
def component_for_whole(scene: Scene) -> Iterator[Change]:
    """A component is taken for the full reaction; in all that follows, or in the inner reaction the right one."""
    for step in scene.made_by("read", plan=FORCES):
        for part in ("_n", "_t"):
            other = scene.steps.get(step.name + part)
            if other is not None and other.verb == "read":
                yield instead(step, part, operands=other.operands)
                yield from _here_alone(scene, step, replace(step, operands=other.operands), f"alone {part}")


def passed(scene: Scene) -> list[Step]:
    """Return the reactions that links before get from the groups, each with its opposite."""
    used = {name for step in scene.program if step.verb in ("chain", "moment") for name in step.operands[:2]}
    return [s for s in scene.made_by("calc", law="opposite") if role(s.name).kind == "R" and s.name in used]


@mistake("M72")
def from_driver_end(scene: Scene) -> Iterator[Change]:
    """Groups are solved from the driver's end: the reaction of the later group is missing."""
    driver = next((s.operands[1] for s in reversed(list(scene.made_by("chain", plan=FORCES)))), "")
    polygons = hung(scene)
    for step in passed(scene):
        if step.name != driver:
            yield Change(step.name, {step.name: nothing(step)}, {})
            if step.name in polygons:  # else it has been left out before
                yield _left_out(scene, step.name, polygons[step.name])


def _left_out(scene: Scene, force: str, hangs: Sequence[Step]) -> Change:
    """Leave a known force out of the steps that hang it on polygons, and out of the equations of moments."""
    steps = {step.name: (Step("same", step.name, step.operands[:1]),) for step in hangs}
    taken = {step.name for step in scene.made_by("moment") if step.operands[0] == force}
    for step in scene.made_by("calc", law="moment_equation"):
        if taken & set(step.operands):
            operands = tuple("zero" if name in taken else name for name in step.operands)
            steps[step.name] = (replace(step, operands=operands),)
    return Change(force, steps, {}, "left out")


@mistake("M73")
def reaction_along_guide(scene: Scene) -> Iterator[Change]:
    """The reaction of a guide is not normal to it; or its moment is skipped."""
    for step in scene.made_by("meet", plan=FORCES):
        for place in (1, 3):
            direction = step.operands[place]
            if role(direction).across_guide:
                yield instead(step, direction, operands=operand(step, place, role(direction).of))
    for step in scene.made_by("arm"):
        made = scene.steps[step.operands[0]]
        if _is_couple(made.name) and made.verb == "calc" and scene.values[made.name]:
            yield Change(made.name, {made.name: nothing(made)}, {}, "moment")


def closing(scene: Scene) -> Iterator[Step]:
    """Go through the reactions read from force plans."""
    return (s for s in scene.made_by("read", plan=FORCES) if s.name not in scene.laid_off and role(s.name).kind == "R")


@mistake("M75")
def arrow_reversed(scene: Scene) -> Iterator[Change]:
    """The polygon is closed with the arrow the wrong way round; all that follows too, or the inner reaction not."""
    for step in closing(scene):
        yield instead(step, operands=step.operands[::-1])
        yield from _here_alone(scene, step, replace(step, operands=step.operands[::-1]), "alone")


def _here_alone(scene: Scene, step: Step, other: Step, how: str) -> Iterator[Change]:
    """Read a reaction otherwise, while the polygons in which it hangs are drawn with the right one."""
    chained = hung(scene).get(step.name, [])
    if chained:
        right = aside(step.name)
        steps = {one.name: (replace(one, operands=(one.operands[0], right)),) for one in chained}
        yield Change(step.name, {step.name: (replace(step, name=right), other), **steps}, {}, how)


@mistake("M76")
def wrong_vertex(scene: Scene) -> Iterator[Change]:
    """A reaction is read to the vertex beside the right one."""
    for step in closing(scene):
        for place, mark in enumerate(step.operands):
            plan, number = role(mark).plan, int(role(mark).of)
            for beside in (number - 1, number + 1):
                other = f"{plan}.{beside}"
                if other in scene.steps and other not in step.operands:
                    yield instead(step, f"{place} {beside}", operands=operand(step, place, other))
    for step, outer in _inner(scene):
        for law in ("excess", "sum"):
            read = replace(step, name=aside(step.name))
            yield Change(
                step.name, {step.name: (read, Step("calc", step.name, (read.name, outer), law))}, {}, f"{law} {outer}"
            )


def _inner(scene: Scene) -> Iterator[tuple[Step, str]]:
    """Go through inner reactions, each with the reactions beside it in the polygon of its group.

    Those meet in the mark that closes the polygon; the inner one is read to it, or on the plan of one link alone.
    """
    closed = {step.name: step for step in scene.made_by("meet", plan=FORCES)}
    outer: dict[str, list[str]] = {}
    for step in closing(scene):
        for mark in closed.keys() & set(step.operands):
            outer.setdefault(closed[mark].plan, []).append(step.name)
    for step in closing(scene):
        if not closed.keys() & set(step.operands):
            hung = {name for other in scene.made_by("chain", plan=step.plan) for name in other.operands[1:]}
            for names in outer.values():
                if hung & set(names):
                    yield from ((step, name) for name in names if name not in hung)


# the arm is measured to the point of application instead of the line of action
mistake("M66")(lambda scene: (to_point(scene, step) for step in moments(scene)))
# the minus of a tangential part is lost: it is drawn the other way
mistake("M69")(lambda scene: (opposed(equation) for equation, _ in equations(scene)))
# a reaction is carried to the next link without being reversed
mistake("M71")(lambda scene: (instead(step, law="given") for step in passed(scene)))
