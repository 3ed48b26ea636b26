"""Zhukovsky's lever: mistakes M77 to M82 and M120."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from ..board import POSITION, Step
from ..names import COUPLE, rate, role
from .forces import to_point
from .rules import Change, Chapter, Scene, instead, nothing, opposed, scaled

MISTAKES = Chapter()
mistake = MISTAKES.enter
LEVER = "lever"


def turned(scene: Scene) -> list[Step]:
    """Return the marks of the turned plan."""
    return list(scene.made_by("normal", plan=LEVER))


def moments(scene: Scene) -> Iterator[Step]:
    """Go through the moments of forces on the lever."""
    return (step for step in scene.made_by("moment") if role(step.operands[1]).plan == LEVER)


@mistake("M77")
def not_turned(scene: Scene) -> Iterator[Change]:
    """The plan is not turned."""
    marks = turned(scene)
    if marks:
        yield Change(marks[0].name, {step.name: (replace(step, verb="same"),) for step in marks}, {})


@mistake("M78")
def force_on_wrong_point(scene: Scene) -> Iterator[Change]:
    """A force hangs on another point of its link."""
    marks = {step.name for step in turned(scene)}
    for step in moments(scene):
        force, at, about = step.operands
        letter = role(at).of
        for other in _beside(scene, letter):
            mark = f"{LEVER}.{other}"
            if mark in marks and role(force).part != COUPLE:
                yield instead(step, other, operands=(force, mark, about))


def _beside(scene: Scene, letter: str) -> list[str]:
    """Return the points that lie on a link with another: its ends, or the points between them."""
    found: dict[str, None] = {}
    for step in scene.made_by("divide", "similar", plan=POSITION):
        if role(step.name).plan != POSITION:
            continue
        ends = step.operands[:2]
        if letter == step.name:
            found.update(dict.fromkeys(ends))
        elif letter in ends:
            found[step.name] = None
    return [*found]


@mistake("M120")
def arm_to_point(scene: Scene) -> Iterator[Change]:
    """The arm is measured to the point where the force hangs."""
    yield from (to_point(scene, step) for step in moments(scene) if role(step.operands[0]).part != COUPLE)


def couples(scene: Scene) -> list[Step]:
    """Return the couples that hang on the lever as pairs of forces, or with their powers."""
    return [s for s in scene.made_by("calc") if s.law in ("couple", "couple_on_lever")]


@mistake("M79", by_scale=True)
def moment_missing(scene: Scene) -> Iterator[Change]:
    """A moment is missing on the lever, or hangs there as it is, without ab / AB."""
    for step in couples(scene):
        yield Change(step.name, {step.name: nothing(step)}, {}, "none")
        if step.law == "couple":
            yield instead(step, "F = M", operands=step.operands[:1], law="given")
        length = scene.values.get(step.operands[1])
        speed = _relative(scene, step)
        if step.law == "couple" and speed and length:
            factor = (length / scene.mu(POSITION)) / (speed / scene.mu("velocity"))
            yield scaled(step, factor, "M")


def _relative(scene: Scene, couple: Step) -> float:
    """Return the size of the relative velocity of the ends of a link with a couple."""
    omega = next((rate("omega", link) for link in role(couple.operands[0]).links), "")
    return float(abs(scene.values.get(omega, 0.0)) * abs(scene.values[couple.operands[1]]))


@mistake("M81")
def reactions_on_lever(scene: Scene) -> Iterator[Change]:
    """A reaction hangs on the lever."""
    last = next((s for s in scene.made_by("calc", law="moment_equation") if role(s.name).kind != "R"), None)
    mark, reaction = (
        f"{LEVER}.{scene.pin}",
        next((n for n in map(role, scene.steps) if n.kind == "R" and not n.hidden and n.links[:1] == (1,)), None),
    )
    if last is None or reaction is None or mark not in scene.steps:
        return
    extra = f"_M_{reaction}_p"
    step = Step("moment", extra, (reaction, mark, f"{LEVER}.p"))
    yield Change(last.name, {last.name: (step, replace(last, operands=(*last.operands, extra)))}, {}, reaction)


@mistake("M82")
def force_for_moment(scene: Scene) -> Iterator[Change]:
    """The balancing moment is the force, its arm being lost."""
    for step in scene.made_by("calc", law="crank_moment"):
        yield instead(step, operands=step.operands[:1], law="given")


# the sense of a moment on the lever is not checked against the direction of ab
mistake("M80")(lambda scene: map(opposed, couples(scene)))
