"""What acts on each link, and where: loads, reactions of other groups, couples and arms, as the program has them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from ....plans.laws import cross
from ....plans.linkages.mechanism import Pair, Prismatic
from ....plans.linkages.structure import Group
from ....plans.names import role
from ..scene import Scene

Hung = list[tuple[str, str]]  # force, mark of the point where it acts


@dataclass(frozen=True, slots=True)
class Moment:
    """The moment of a force about a joint, and the name of its arm."""

    force: str
    arm: str
    at: str
    about: str


@dataclass(frozen=True, slots=True)
class Contact:
    """Where the reaction of a guide acts: the arm's name, the pin from which it is counted, along `u`, metres.

    `couple` names the moment of a reaction that has no size: then there is a couple and no arm.
    """

    arm: str
    pin: str
    u: complex
    offset: float
    couple: str


def loads(scene: Scene, number: int) -> Hung:
    """Return (force, point) of the loads on a link: inertia force, weight, then outer ones."""
    mechanism, link = scene.solved.mechanism, scene.solved.mechanism.link(number)
    own = [(name, str(link.centre)) for name in (f"F_i{number}", f"G_{number}") if name in scene.solved.quantities]
    return own + [(load.name, load.point) for load in mechanism.loads_on(number)]


def handed(scene: Scene, number: int) -> Hung:
    """Return (force, point) of the reactions of groups attached to a link, the last group first."""
    moments = {moment.force: moment.at for moment in moments_of(scene, (number,))}
    found = []
    for group, pair, own in _attached(scene, number):
        force = f"R_{scene.solved.mechanism.index(own, number)}"
        if scene.defined(force):
            found.append((force, moments.get(force) or group.pin(pair)))
    return found


def _attached(scene: Scene, number: int) -> Iterator[tuple[Group, Pair, int]]:
    """Go through the pairs by which later groups hang on a link: group, pair, the group's own link in it."""
    for group in reversed(scene.solved.structure.groups):
        for pair, before in zip(group.outer, group.before, strict=True):
            if before == number:
                yield group, pair, next(n for n in pair.links if n in group.links)


def couples(scene: Scene, number: int) -> list[str]:
    """Return the names of the couples on a link: of inertia, outer ones, and those that guides on it hand on."""
    mechanism = scene.solved.mechanism
    names = [f"M_i{number}", *(couple.name for couple in mechanism.couples if couple.link == number)]
    for _, pair, own in _attached(scene, number):
        if isinstance(pair, Prismatic):
            handed_on = (f"M_{mechanism.index(own, number)}", f"_M_{own}")
            names += [name for name in handed_on if scene.defined(name)][:1]
    return [name for name in names if scene.defined(name)]


def reactions(scene: Scene, group: Group) -> list[tuple[Pair, int, list[str]]]:
    """Return the outer pairs of a group, its own link in each, and the reaction's name, or those of its two parts."""
    found = []
    for pair, before in zip(group.outer, group.before, strict=True):
        own = next(number for number in pair.links if number in group.links)
        whole = f"R_{scene.solved.mechanism.index(before, own)}"
        parts = [f"{whole}_{part}" for part in ("n", "t") if f"{whole}_{part}" in scene.solved.values]
        found.append((pair, own, parts or [whole]))
    return found


def moments_of(scene: Scene, numbers: tuple[int, ...]) -> list[Moment]:
    """Return the moments that the construction takes of forces on these links, each arm once."""
    taken = {step.name: step.operands for step in scene.solved.program if step.verb == "moment"}
    found: dict[str, Moment] = {}
    for step in scene.solved.program:
        if step.verb == "arm" and step.operands[0] in taken:
            force, at, about = taken[step.operands[0]]
            if role(about).plan != "lever" and _link_of(scene, force) in numbers:
                found.setdefault(step.name, Moment(force, step.name, at, about))
    return list(found.values())


def _link_of(scene: Scene, force: str) -> int | None:
    """Return the link on which a force acts."""
    mechanism = scene.solved.mechanism
    for load in mechanism.loads:
        if load.name == force:
            return load.link
    links = role(force).links
    return next((on for on in links[-1:] if on in {link.number for link in mechanism.links}), None)


def contact(scene: Scene, group: Group, pair: Prismatic, number: int, other: int) -> Contact | None:
    """Return where the reaction R of link `other` on `number` in a prismatic pair acts, both ways of naming tried."""
    for first, second in ((other, number), (number, other)):
        index = scene.solved.mechanism.index(first, second)
        step = next((s for s in scene.solved.program if s.verb == "arm" and s.name == f"h_{index}"), None)
        if step is not None and step.operands[1] == f"R_{index}":
            break
    else:
        return None
    moment, reaction = step.operands
    pin = group.pin(pair)
    u = scene.solved.point(scene.solved.guide_name(pair))
    value = float(scene.solved.values[moment])
    # the moment of the loads, which the reaction balances, or that of the reaction itself
    turning = -value if role(moment).hidden else value
    size = cross(u, complex(scene.solved.values[reaction])) if scene.direction(reaction) != 0 else 0.0
    couple = moment if size == 0.0 and not scene.vanishes(moment) else ""
    return Contact(step.name, pin, u, turning / size if size else 0.0, couple)
