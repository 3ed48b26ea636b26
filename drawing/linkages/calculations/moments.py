"""Terms of sums of moments as products: force times arm times scale factor, couples, powers on the lever."""

from __future__ import annotations

import math
from collections.abc import Iterable

from ....plans.board import Step
from ....plans.linkages.mechanism import ZERO, Driver, Revolute
from ....plans.linkages.structure import Group
from ....plans.names import role
from ...printed import POINT
from ..reading import read
from ..scene import Scene
from .equations import Factor, Product, factor, paper, segment, size_of


def terms(scene: Scene, names: Iterable[str]) -> list[Product]:
    """Return the moments that are not zero, each with its sign, counter-clockwise positive."""
    found = []
    for name in names:
        value = 0.0 if name == ZERO else scene.solved.values[name]
        factors = _factors(scene, name) if value != 0.0 else ()
        # a force whose line passes through the point has no moment but rounding
        if factors and min(factor.value for factor in factors if not factor.exact) >= POINT:
            found.append(Product(factors, math.copysign(1.0, value)))
    return found


def _factors(scene: Scene, name: str) -> tuple[Factor, ...]:
    """Return what makes a moment: a force and its arm, a couple's power, or a couple that is known."""
    reading = read(scene.solved.program)
    step = reading.step(name)
    if step is not None and step.verb == "moment":
        arm = next(s for s in reading.users(name) if s.verb == "arm")
        return factor(scene, step.operands[0]), *on_arm(scene, arm.name)
    if step is not None and step.law == "couple_on_lever":
        scale = paper(scene.words, scene.scales["lever"])
        over = Factor(scale.symbol, scale.value, scale.exact, -scale.power)
        return factor(scene, step.operands[0]), factor(scene, step.operands[1]), over
    return (factor(scene, name),)


def on_arm(scene: Scene, arm: str) -> tuple[Factor, ...]:
    """Return an arm in mm, and the scale factor unless the plan's own cancels, as on the lever."""
    plan = scene.figure_of(arm)
    own = segment(scene, scene.words.symbol(arm), plan, size_of(scene, arm))
    return (own,) if plan == "lever" else (own, paper(scene.words, scene.scales[plan]))


def about(scene: Scene, step: Step) -> str:
    """Return the point about which the moments of a calculation are taken."""
    reading = read(scene.solved.program)
    moments = (made for name in step.operands if (made := reading.step(name)) is not None and made.verb == "moment")
    point = next((moment.operands[2] for moment in moments), "")
    return point or _joint(scene, link_of(scene, step.name))


def _joint(scene: Scene, number: int) -> str:
    """Return the joint about which a link without loads would turn: its pin in the group, or the group's only one."""
    group, driver = group_of(scene, number), scene.solved.mechanism.driver
    if group is None:
        return driver.pivot if isinstance(driver, Driver) else driver.point
    pins = [pair for pair in (*group.inner, *group.outer) if isinstance(pair, Revolute)]
    return next((pair.point for pair in pins if number in pair.links), pins[0].point)


def group_of(scene: Scene, number: int) -> Group | None:
    """Return the group of a link; None for the driver."""
    return next((group for group in scene.solved.structure.groups if number in group.links), None)


def link_of(scene: Scene, name: str) -> int:
    """Return the link on which a reaction or the moment of one acts: 2 of `R_12_t`, 3 of `_M_3`; else the driver."""
    numbers = role(name).links if role(name).kind in ("R", "M") else ()
    moving = {link.number for link in scene.solved.mechanism.links}
    return numbers[-1] if moving.intersection(numbers[-1:]) else scene.solved.structure.driver


def links_in(scene: Scene, number: int, point: str) -> str:
    """Return the links whose moments a sum about a point has: the link's own, or those of the whole group.

    About a point that is not the link's the inner reactions of the group would have moments, too.
    """
    group = group_of(scene, number)
    if group is None or point in scene.solved.mechanism.link(number).points or len(group.links) < 2:
        return str(number)
    return ", ".join(map(str, sorted(group.links)))
