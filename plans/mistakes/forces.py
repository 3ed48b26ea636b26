"""Force plans and Zhukovsky's lever: mistakes M57 to M82, M118 to M120, M122 and M124, but for M74, another scale."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from functools import partial

from ..board import POSITION, Step
from ..names import COUPLE, FORCES, MAGNITUDE, rate, role
from ..quantities import F_BAL
from .rules import (
    Change,
    Changes,
    Scene,
    aside,
    constant,
    each,
    each_and_all,
    instead,
    length_of,
    mistake,
    nothing,
    operand,
    opposed,
    otherwise,
    reversed_,
    scaled,
    then,
    times,
    with_other,
    with_sign,
)

G = 9.81
BALANCING = ("closing_moment", "closing_force")
EQUATIONS = ("moment_equation", *BALANCING)


# Known forces.


def _hung(scene: Scene) -> dict[str, list[Step]]:
    """Return the steps that hang each force on a force plan."""
    found: dict[str, list[Step]] = {}
    for step in scene.made_by("chain", plan=FORCES):
        found.setdefault(step.operands[1], []).append(step)
    return found


def _loads(scene: Scene) -> Iterator[tuple[str, list[Step]]]:
    """Go through the forces that are known beforehand (inertia forces, weights, outer loads), and what hangs them."""
    return ((f, steps) for f, steps in _hung(scene).items() if role(f).kind != "R" and role(f).shown != F_BAL)


def _left_out(steps: Iterable[Step]) -> dict[str, tuple[Step, ...]]:
    """Leave out of force plans what some steps hang there."""
    return {step.name: (Step("same", step.name, step.operands[:1]),) for step in steps}


@mistake("M57")
def _along_acceleration(scene: Scene) -> Changes:
    """Inertia forces are drawn along the accelerations: one of them, or all."""
    return each_and_all({step.name: reversed_(step) for step in scene.calculated("inertia_force")}, at="F_i")


@mistake("M58")
def _force_left_out(scene: Scene) -> Changes:
    """A known force is left out of the polygon, or of everything."""
    for force, steps in _loads(scene):
        yield Change(force, _left_out(steps), "polygon")
        if scene.steps[force].verb == "calc":
            yield instead(scene.steps[force], *nothing(scene.steps[force]), how="everywhere")
    weights = scene.calculated("weight")
    if len(weights) > 1:
        yield Change("G", {step.name: nothing(step) for step in weights}, "all")


@mistake("M59", of=_loads)
def _force_reversed(scene: Scene, force: str, steps: list[Step]) -> Changes:
    """A known force acts the other way: in the polygon, or everywhere."""
    against = f"_against_{force}"
    opposite = Step("calc", against, (force,), "opposite")
    turned = {step.name: (opposite, operand(step, 1, against)) for step in steps}
    yield Change(force, turned, "polygon")
    if scene.steps[force].law in ("along", "weight"):
        yield opposed(scene.steps[force], "everywhere")


@mistake("M122")
def _another_acceleration(scene: Scene) -> Changes:
    """An inertia force is calculated with the acceleration of another point."""
    read = [s.name for s in scene.made_by("read", plan="acceleration") if s.operands[0] == "acceleration.p"]
    absolute = [name for name in read if name not in scene.laid_off or name == f"a_{scene.pin}"]
    for step in scene.calculated("inertia_force"):
        for name in absolute:
            if name != step.operands[1] and abs(scene.values[name] - scene.values[step.operands[1]]):
                yield with_other(step, 1, name, name)


@mistake("M62")
def _force_at_wrong_point(scene: Scene) -> Changes:
    """An inertia force stands at a joint or in the middle of the link, instead of the centre of mass."""
    inertia = {step.name for step in scene.calculated("inertia_force")}
    for step in _moments(scene, POSITION):
        force, at, _ = step.operands
        centre = scene.steps.get(at)
        if force in inertia and centre is not None and centre.verb in ("divide", "similar"):
            for end in centre.operands[:2]:  # about the end where it is thought to act it has no moment
                yield with_other(step, 1, end, end)
            point = Step("divide", f"_middle_of_{at}", (*centre.operands[:2], constant(0.5), "one"))
            yield instead(step, point, operand(step, 1, point.name), how="middle")


@mistake("M63")
def _mass_and_weight(scene: Scene) -> Changes:
    """The weight stands for the mass in inertia forces, or the mass for the weight."""
    given = (step.operands[1] for step in scene.calculated("weight"))
    fall = float(next((scene.paper.givens[name] for name in given if scene.is_given(name)), G))
    for law, factor in (("inertia_force", fall), ("weight", 1.0 / fall)):
        yield from _each_and_all_scaled(factor, scene.calculated(law), law)


@mistake("M64", of=lambda scene: scene.calculated("along", "resisting_force", "resisting_along"))
def _load_from_pressure(scene: Scene, step: Step) -> Changes:
    """The force on a piston from its diameter in the place of the radius, without pi / 4, or in kilonewtons."""
    size = role(step.operands[0])
    if role(step.name).kind in ("F", "P") and (size.kind == MAGNITUDE or size.hidden):
        for factor in (4.0, 4.0 / math.pi, 1e3, 1e-3, 1e6, 1e-6):
            yield scaled(factor, step, how=f"{factor:.4g}")


@mistake("M65")
def _resistance_along_motion(scene: Scene) -> Changes:
    """A resistance acts along the motion, or in the idle stroke too."""
    for law in ("resisting_force", "resisting_along", "resisting_moment"):
        yield from map(opposed, scene.calculated(law))
    yield from (opposed(step) for step in scene.calculated("along") if scene.is_given(f"|{step.name}|"))
    for step in scene.calculated("in_working", "in_idle"):
        yield otherwise(step, "other stroke", law="in_idle" if step.law == "in_working" else "in_working")


# Moments.


def _moments(scene: Scene, plan: str) -> list[Step]:
    """Return the moments of forces taken on the plan of the mechanism, or on the lever."""
    return [step for step in scene.made_by("moment") if role(step.operands[1]).plan == plan]


def _is_couple(name: str) -> bool:
    """Whether a name is that of a couple, no moment of a force."""
    return role(name).kind == "M" and not role(name).hidden


def _sums(scene: Scene) -> Iterator[tuple[Step, str]]:
    """Go through the equations and sums of moments, the lever's too, with each of the couples in them."""
    for step in scene.calculated(*EQUATIONS, "sum"):
        first = 0 if step.law in ("closing_moment", "sum") else 1
        if step.law != "sum" or _is_couple(step.name):
            names = (name for name in step.operands[first:] if step.law == "sum" or _is_couple(name))
            yield from ((step, name) for name in names if scene.values[name])


def _in_place_of(step: Step, name: str, other: str) -> Step:
    """Return a step with another name wherever one stands."""
    return step.but(operands=tuple(other if operand == name else operand for operand in step.operands))


@mistake("M60")
def _inertia_moment_lost(scene: Scene) -> Changes:
    """The inertia moment is forgotten, or has the wrong sense, in an equation of moments or everywhere."""
    for step in scene.calculated("inertia_moment"):
        yield scaled(0.0, step, how="none")
        yield opposed(step, "sense")
    for step, name in _sums(scene):
        turned = Step("calc", f"_against_{name}", (name,), "opposite")
        yield instead(step, turned, _in_place_of(step, name, turned.name), how=f"equation {name}")


@mistake("M61")
def _inertia_about_end(scene: Scene) -> Changes:
    """The moment of inertia is taken about the end of the link: m l^2 / 3 for m l^2 / 12."""
    yield from _each_and_all_scaled(4.0, scene.calculated("inertia_moment"), "M_i")
    yield from _each_and_all_scaled(4.0, scene.calculated("inertia_by_length"), "J")


@mistake("M118", of=lambda scene: scene.calculated(*EQUATIONS))
def _sign_of_moment(scene: Scene, step: Step) -> Changes:
    """The moment of one force has the wrong sign in an equation of moments."""
    taken = [scene.steps[name] for name in step.operands if name in scene.steps and scene.values[name]]
    if len(taken) > 1:
        yield from (opposed(one, step.name) for one in taken if one.verb == "moment")


@mistake("M119", of=_sums)
def _moment_left_out(scene: Scene, step: Step, name: str) -> Changes:
    """A moment is left out of an equation or a sum of moments."""
    yield otherwise(_in_place_of(step, name, "zero"), name)


def _to_point(scene: Scene, step: Step) -> Change:
    """Measure the arm of a moment to the point of application."""
    force, at, about = step.operands
    size, arm = length_of(force), Step("distance", f"_way_{step.name}", (at, about))
    product = Step("calc", f"_whole_{step.name}", (size[-1].name, arm.name), "crank_moment")
    return with_sign(step, (*size, arm, product), scene.values[step.name])


def _equations(scene: Scene) -> Iterator[Step]:
    """Go through the moment equations of the force plans."""
    return (step for step in scene.calculated("moment_equation") if role(step.name).kind == "R")


@mistake("M67", of=_equations)
def _arms_from_another_hinge(scene: Scene, equation: Step) -> Changes:
    """Moments are taken about one hinge with arms measured from another."""
    laid = next((s for s in scene.made_by("lay", "back") if equation.name in s.operands), None)
    link = scene.steps.get(scene.along(laid.operands[1])) if laid else None
    ends = link.operands[:2] if link is not None and link.verb == "direction" else ()
    new = {
        step.name: (operand(step, 2, ends[1 - ends.index(step.operands[2])]),)
        for step in _moments(scene, POSITION)
        if step.name in equation.operands[1:] and step.operands[2] in ends
    }
    if new:
        yield Change(equation.name, new)


@mistake("M68", of=_equations, by_scale=True)
def _arms_in_millimetres(scene: Scene, equation: Step) -> Changes:
    """Arms in millimetres beside a moment in newton metres, or the other way round."""
    taken = equation.operands[1:]
    couples = [name for name in taken if scene.values[name] and (_is_couple(name) or role(name).kind != "M")]
    for factor, how in ((scene.mu("position"), "mu"), (1e3, "mm"), (1e-3, "m")):
        new, weighted = list[Step](), equation
        for name in couples:
            new.append(Step("calc", f"_weighted_{name}", (constant(factor), name), "along"))
            weighted = operand(weighted, weighted.operands.index(name), new[-1].name)
        if new:
            yield instead(equation, *new, weighted, how=how)


@mistake("M124")
def _balance_in_millimetres(scene: Scene) -> Changes:
    """What balances the driver is found with arms in millimetres."""
    found = scene.calculated(*BALANCING, "crank_moment")
    return (scaled(1000.0, step) for step in found if "bal" in step.name)


# the arm is measured to the point of application instead of the line of action; so it is on the lever
mistake("M66")(lambda scene: (_to_point(scene, step) for step in _moments(scene, POSITION)))
mistake("M120")(
    lambda scene: (_to_point(scene, s) for s in _moments(scene, "lever") if role(s.operands[0]).part != COUPLE)
)
# the minus of a tangential part is lost: it is drawn the other way
each("M69", _equations, opposed)


# Reactions.


@mistake("M70", of=lambda scene: scene.made_by("read", plan=FORCES))
def _component_for_whole(scene: Scene, step: Step) -> Changes:
    """A component is taken for the full reaction; in all that follows, or in the inner reaction the right one."""
    for part in ("_n", "_t"):
        other = scene.steps.get(step.name + part)
        if other is not None and other.verb == "read":
            yield otherwise(step, part, operands=other.operands)
            yield from _here_alone(scene, step, other.operands, f"alone {part}")


def _passed(scene: Scene) -> list[Step]:
    """Return the reactions that links before get from the groups, each with its opposite."""
    used = {name for step in scene.program if step.verb in ("chain", "moment") for name in step.operands[:2]}
    return [s for s in scene.calculated("opposite") if role(s.name).kind == "R" and s.name in used]


@mistake("M72")
def _from_driver_end(scene: Scene) -> Changes:
    """Groups are solved from the driver's end: the reaction of the later group is missing."""
    polygons = _hung(scene)
    driver = next((s.operands[1] for s in reversed(scene.made_by("chain", plan=FORCES))), "")
    for step in _passed(scene):
        if step.name != driver:
            yield instead(step, *nothing(step))
            if step.name in polygons:  # else it has been left out before
                steps = _left_out(polygons[step.name])
                taken = {s.name for s in scene.made_by("moment") if s.operands[0] == step.name}
                for equation in scene.calculated("moment_equation"):
                    if taken & set(equation.operands):
                        operands = tuple("zero" if name in taken else name for name in equation.operands)
                        steps[equation.name] = (equation.but(operands=operands),)
                yield Change(step.name, steps, "left out")


@mistake("M73")
def _reaction_along_guide(scene: Scene) -> Changes:
    """The reaction of a guide is not normal to it; or its moment is skipped."""
    for step in scene.made_by("meet", plan=FORCES):
        for place in (1, 3):
            direction = step.operands[place]
            if role(direction).across_guide:
                yield with_other(step, place, role(direction).of, direction)
    for step in scene.made_by("arm"):
        made = scene.steps[step.operands[0]]
        if _is_couple(made.name) and made.verb == "calc" and scene.values[made.name]:
            yield instead(made, *nothing(made), how="moment")


def _closing(scene: Scene) -> Iterator[Step]:
    """Go through the reactions read from force plans."""
    return (s for s in scene.made_by("read", plan=FORCES) if s.name not in scene.laid_off and role(s.name).kind == "R")


@mistake("M75", of=_closing)
def _arrow_reversed(scene: Scene, step: Step) -> Changes:
    """The polygon is closed with the arrow the wrong way round; all that follows too, or the inner reaction not."""
    yield otherwise(step, operands=step.operands[::-1])
    yield from _here_alone(scene, step, step.operands[::-1], "alone")


def _here_alone(scene: Scene, step: Step, operands: tuple[str, ...], how: str) -> Changes:
    """Read a reaction otherwise, while the polygons in which it hangs are drawn with the right one."""
    chained = _hung(scene).get(step.name, [])
    if chained:
        right = aside(step.name)
        steps = {one.name: (operand(one, 1, right),) for one in chained}
        other = step.but(operands=operands)
        yield Change(step.name, {step.name: (step.but(name=right), other), **steps}, how)


@mistake("M76")
def _wrong_vertex(scene: Scene) -> Changes:
    """A reaction is read to the vertex beside the right one."""
    for step in _closing(scene):
        for place, mark in enumerate(step.operands):
            plan, number = role(mark).plan, int(role(mark).of)
            for beside in (number - 1, number + 1):
                other = f"{plan}.{beside}"
                if other in scene.steps and other not in step.operands:
                    yield with_other(step, place, other, f"{place} {beside}")
    for step, outer in _inner(scene):
        for law in ("excess", "sum"):
            yield instead(step, *then(step, law, aside(step.name), outer), how=f"{law} {outer}")


def _inner(scene: Scene) -> Iterator[tuple[Step, str]]:
    """Go through inner reactions, each with the reactions beside it in the polygon of its group.

    Those meet in the mark that closes the polygon; the inner one is read to it, or on the plan of one link alone.
    """
    closed = {step.name: step for step in scene.made_by("meet", plan=FORCES)}
    outer: dict[str, list[str]] = {}
    for step in _closing(scene):
        for mark in closed.keys() & set(step.operands):
            outer.setdefault(closed[mark].plan, []).append(step.name)
    for step in _closing(scene):
        if not closed.keys() & set(step.operands):
            hung = {name for other in scene.made_by("chain", plan=step.plan) for name in other.operands[1:]}
            for names in outer.values():
                if hung & set(names):
                    yield from ((step, name) for name in names if name not in hung)


# a reaction is carried to the next link without being reversed
each("M71", _passed, partial(otherwise, law="given"))


# The lever.


def _turned(scene: Scene) -> dict[str, Step]:
    """Return the marks of the turned plan."""
    return {step.name: step for step in scene.made_by("normal", plan="lever")}


@mistake("M77")
def _not_turned(scene: Scene) -> Changes:
    """The plan is not turned."""
    if marks := _turned(scene):
        yield Change(next(iter(marks)), {name: (step.but(verb="same"),) for name, step in marks.items()})


@mistake("M78", of=lambda scene: _moments(scene, "lever"))
def _force_on_wrong_point(scene: Scene, step: Step) -> Changes:
    """A force hangs on another point of its link."""
    force, at, _ = step.operands
    for other in _beside(scene, role(at).of):
        if f"lever.{other}" in _turned(scene) and role(force).part != COUPLE:
            yield with_other(step, 1, f"lever.{other}", other)


def _beside(scene: Scene, letter: str) -> list[str]:
    """Return the points that lie on a link with another: its ends, or the points between them."""
    found: dict[str, None] = {}
    for step in scene.made_by("divide", "similar", plan=POSITION):
        ends = step.operands[:2]
        if role(step.name).plan == POSITION and letter in (step.name, *ends):
            found.update(dict.fromkeys(ends if letter == step.name else (step.name,)))
    return [*found]


def _couples(scene: Scene) -> tuple[Step, ...]:
    """Return the couples that hang on the lever as pairs of forces, or with their powers."""
    return scene.calculated("couple", "couple_on_lever")


@mistake("M79", of=_couples, by_scale=True)
def _moment_missing(scene: Scene, step: Step) -> Changes:
    """A moment is missing on the lever, or hangs there as it is, without ab / AB."""
    yield instead(step, *nothing(step), how="none")
    if step.law == "couple":
        yield otherwise(step, "F = M", operands=step.operands[:1], law="given")
        length = scene.values.get(step.operands[1], 0.0)
        omega = next((rate("omega", link) for link in role(step.operands[0]).links), "")
        speed = float(abs(scene.values.get(omega, 0.0)) * abs(length))  # of one end of the link about the other
        if speed:
            yield scaled((length / scene.mu(POSITION)) / (speed / scene.mu("velocity")), step, how="M")


@mistake("M81")
def _reactions_on_lever(scene: Scene) -> Changes:
    """A reaction hangs on the lever."""
    pin, names = f"lever.{scene.pin}", map(role, scene.steps)
    reaction = next((n for n in names if n.kind == "R" and not n.hidden and n.links[:1] == (1,)), None)
    last = next((s for s in scene.calculated("moment_equation") if role(s.name).kind != "R"), None)
    if last is not None and reaction is not None and pin in scene.steps:
        step = Step("moment", f"_M_{reaction}_p", (reaction, pin, "lever.p"))
        yield instead(last, step, last.but(operands=(*last.operands, step.name)), how=reaction)


# the sense of a moment on the lever is not checked against the direction of ab
each("M80", _couples, opposed)
# the balancing moment is the force, its arm being lost
each("M82", "crank_moment", lambda step: otherwise(step, operands=step.operands[:1], law="given"))


def _each_and_all_scaled(factor: float, steps: Iterable[Step], at: str) -> Iterator[Change]:
    """Make so many times what each of some steps makes, and all of them."""
    return each_and_all({step.name: times(step, factor) for step in steps}, at=at)
