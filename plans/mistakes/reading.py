"""Scales and reading: mistakes M14 to M22, and M74 of the force plans, which is the same."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

from ..board import POSITION, Step
from ..boards.exact import run
from ..names import FORCES, POLE, role
from .inputs import TWELFTH, angle_of_driver
from .rules import Broken, Change, Chapter, Scene, all_scaled, constant, scaled
from .velocity import rate_from, rates

MISTAKES = Chapter()
mistake = MISTAKES.enter
ROUNDED = (1.03, 0.97)
PRINTED = 0.955  # of a sheet that the printer has fitted to its page


def readings(scene: Scene, plan: str = "") -> list[Step]:
    """Return the readings of a plan, or of all, that need its scale."""
    steps = scene.made_by("read", plan=plan)
    return [s for s in steps if not role(s.name).hidden and s.plan != POSITION and s.name not in scene.laid_off]


def drawn_plans(scene: Scene) -> list[tuple[str, ...]]:
    """Return the plans that are read, those of one scale together."""
    by_scale: dict[float, list[str]] = {}
    for plan in dict.fromkeys(step.plan for step in readings(scene)):
        by_scale.setdefault(scene.mu(plan), []).append(plan)
    return [tuple(plans) for plans in by_scale.values()]


def _on(scene: Scene, plans: tuple[str, ...]) -> list[Step]:
    return [step for step in readings(scene) if step.plan in plans]


@mistake("M14", by_scale=True)
def scale_inverted(scene: Scene) -> Iterator[Change]:
    """Divided by the scale factor instead of multiplied."""
    for plans in drawn_plans(scene):
        yield all_scaled(plans[0], _on(scene, plans), scene.mu(plans[0]) ** -2)


@mistake("M15", by_scale=True)
def another_scale(scene: Scene) -> Iterator[Change]:
    """The scale factor of velocities is taken for accelerations, or the other way round, or that of lengths."""
    for plans in drawn_plans(scene):
        if role(plans[0]).kind != FORCES:
            for other in ("velocity", "acceleration", POSITION):
                if other in scene.paper.mus and other not in plans:
                    yield all_scaled(plans[0], _on(scene, plans), scene.mu(other) / scene.mu(plans[0]), other)


@mistake("M74", by_scale=True)
def scale_of_another_group(scene: Scene) -> Iterator[Change]:
    """The force plan of one group, or one segment of it, is read with the scale factor of another."""
    groups = [plans for plans in drawn_plans(scene) if role(plans[0]).kind == FORCES]
    for plans in groups:
        for other in groups:
            if other != plans:
                factor = scene.mu(other[0]) / scene.mu(plans[0])
                yield all_scaled(plans[0], _on(scene, plans), factor, other[0])
                yield from (scaled(step, factor, f"{other[0]} alone") for step in _on(scene, plans))


@mistake("M16", by_scale=True)
def segments_without_scale(scene: Scene) -> Iterator[Change]:
    """The segment of a normal part is ab^2 / AB in millimetres, which needs the crank's scale."""
    if "acceleration" in scene.paper.mus and "velocity" in scene.paper.mus:
        factor = scene.mu("acceleration") * scene.mu(POSITION) / scene.mu("velocity") ** 2
        yield all_scaled("acceleration", list(scene.made_by("calc", law="normal_part")), factor)


@mistake("M17", by_scale=True)
def millimetres_for_length(scene: Scene) -> Iterator[Change]:
    """The drawn millimetres of a link stand in omega = v / l in the place of its length."""
    for rate in ("omega", "epsilon"):
        steps = [s for s in scene.made_by("calc", law="turning") if role(s.name).kind == rate]
        if steps:
            yield all_scaled(steps[0].name, steps, scene.mu(POSITION), "all")
            yield all_scaled(steps[0].name, steps, 1e-3, "mm")
        if len(steps) > 1:
            yield from (scaled(step, scene.mu(POSITION), "alone") for step in steps)


@mistake("M18")
def scale_rounded(scene: Scene) -> Iterator[Change]:
    """The scale factor is rounded after the plan is drawn."""
    for plans in drawn_plans(scene):
        for factor in ROUNDED:
            yield all_scaled(plans[0], _on(scene, plans), factor, f"{factor}")


@mistake("M20")
def centimetres(scene: Scene) -> Iterator[Change]:
    """Centimetres for millimetres, on a plan or in one reading."""
    for factor in (10.0, 0.1):
        for plans in drawn_plans(scene):
            yield all_scaled(plans[0], _on(scene, plans), factor, f"{factor}")
        for step in readings(scene):
            yield scaled(step, factor, f"{factor} alone")


@mistake("M21")
def relative_for_absolute(scene: Scene) -> Iterator[Change]:
    """The segment ab is read for v_B, and pb for v_BA."""
    by_tip: dict[str, list[Step]] = {}
    for step in readings(scene):
        if step.plan in ("velocity", "acceleration"):
            by_tip.setdefault(step.operands[1], []).append(step)
    for steps in by_tip.values():
        absolute = next((s for s in steps if role(s.operands[0]).kind == POLE), None)
        for step in steps:
            if absolute is not None and step is not absolute:
                first = Step("read", absolute.name, step.operands)
                second = Step("read", step.name, absolute.operands)
                change = Change(step.name, {absolute.name: (first,), step.name: (second,)}, {}, absolute.name)
                yield _with_rates(scene, change, (absolute, step))


def _with_rates(scene: Scene, change: Change, exchanged: tuple[Step, Step]) -> Change:
    """Let the rates that follow from exchanged readings have their sizes; the senses show in the drawing."""
    steps, givens = {**change.steps}, {**change.givens}
    for rate, reading in rates(scene, exchanged[0].plan):
        if reading in exchanged:
            found = rate_from(scene, rate, reading.name)
            steps |= found.steps
            givens |= found.givens
    return replace(change, steps=steps, givens=givens)


@mistake("M22")
def another_position(scene: Scene) -> Iterator[Change]:
    """One segment is copied from the plan of a neighbouring position."""
    name = angle_of_driver(scene)
    if name is None or name == "zero":
        return
    for how, shift in (("+30", TWELFTH), ("-30", -TWELFTH)):
        angle = float(scene.paper.givens[name]) + shift
        there = run(scene.program, {**scene.paper.givens, name: math.fmod(angle, 2.0 * math.pi)}).values
        for step in readings(scene):
            if step.plan in ("velocity", "acceleration") and there[step.name] == there[step.name]:
                given = f"{constant(shift)}_{step.name}"
                copied = Step("calc", step.name, (given,), "given")
                yield Change(step.name, {step.name: (copied,)}, {given: there[step.name]}, how)


@mistake("M123", by_scale=True)
def digits_transposed(scene: Scene) -> Iterator[Change]:
    """Two digits of a number are transposed: that hangs on the number, and is found from the answers."""
    return iter(())


def transposed(scene: Scene, name: str, written: float, meant: float) -> Broken:
    """Return the construction in which a number was written for another one of the same digits, and gone on with."""
    step = scene.steps.get(f"_{name}", scene.steps[name])  # what is laid off and read again is calculated before
    change = scaled(step, abs(written / meant), f"{meant:.4g}")
    return Broken("M123", scene.paper, replace(change, at=name))


def other_orders(number: float) -> Iterator[float]:
    """Go through the numbers of four digits in which two neighbouring digits of a number are exchanged."""
    mantissa, _, power = f"{abs(number):.3e}".partition("e")
    digits = mantissa.replace(".", "")
    for i in range(len(digits) - 1):
        if digits[i] != digits[i + 1]:
            swapped = digits[:i] + digits[i + 1] + digits[i] + digits[i + 2 :]
            yield float(f"{swapped[0]}.{swapped[1:]}e{power}")


# the sheet was not printed at 100 per cent
mistake("M19")(lambda scene: [all_scaled("", readings(scene), PRINTED)])
