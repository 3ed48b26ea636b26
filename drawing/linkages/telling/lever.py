"""Zhukovsky's lever, told: the velocity plan turned, then what hangs on each of its ends, with the arms."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from ....plans.board import Step
from ....plans.names import COUPLE, role
from ..calculations.equations import size_of
from ..figures.lever import BALANCE, LeverArm, arms_on_lever, driven, hung_on_lever, images, letter_of, lines_of_lever
from .marks import TOLD
from .teller import Teller, Told


def lever_told(teller: Teller) -> Iterator[Told]:
    """Go through the steps of the lever."""
    for step in teller.scene.solved.program.on("lever"):
        if step.verb == "pole":
            yield from (Told(step, text, before=True) for text in TOLD["pole"](teller, step))
    yield from _turned(teller)
    hung: dict[str, list[Step]] = {}
    for step in teller.scene.solved.program.which(("moment",)):
        if step.operands[2] == "lever.p":
            hung.setdefault(step.operands[1], []).append(step)
    told, left = set[str](), arms_on_lever(teller.scene)
    for mark, moments in hung.items():
        told.update(moment.operands[0] for moment in moments)
        drawn = [arm for arm in left if told.issuperset(arm.forces)]
        left = [arm for arm in left if arm not in drawn]
        yield _hung(teller, mark, moments, drawn)
    yield from _balance(teller)


def _turned(teller: Teller) -> Iterator[Told]:
    """Tell which segments are turned; a line is there with both its ends, the rest of the plan with the last one."""
    scene, told = teller.scene, {"lever.p"}
    lines, marks = lines_of_lever(scene), images(scene)
    steps = [step for step in scene.solved.program.on("lever") if step.verb == "normal"]
    for step in steps:
        told |= set(marks) if step is steps[-1] else {step.name}
        drawn = {line.name for line in lines if step is steps[-1] or told.issuperset((line.start, line.end))}
        segment = f"{teller.mark('velocity.p')}{teller.mark(step.operands[0])}"
        letters = frozenset(letter_of(scene, mark) for mark in told & set(marks))
        yield Told(step, teller.say("turned", segment=segment), names=frozenset(drawn | told), letters=letters)


def _hung(teller: Teller, mark: str, moments: list[Step], drawn: Iterable[LeverArm]) -> Told:
    """Tell the forces on one end of the lever, and their arms about its pole; those `drawn` have all their forces."""
    scene = teller.scene
    forces = [moment.operands[0] for moment in moments]
    arms = [user.name for moment in moments for user in teller.reading.users(moment.name) if user.verb == "arm"]
    said = {
        "point": letter_of(scene, mark),
        "forces": ", ".join(map(teller.vector, forces)),
        "arms": ", ".join(f"{scene.words.symbol(arm)} = {_on_lever(teller, arm)}" for arm in arms),
    }
    couples = {role(force).of for force in forces if role(force).part == COUPLE}
    at_pole = (
        name
        for name, at in hung_on_lever(scene)
        if at == "lever.p" and role(name).part == COUPLE and role(name).of in couples
    )
    hung = (*forces, *at_pole)
    names = (*hung, *(arm.line for arm in drawn), *(name for arm in drawn for name in arm.names))
    letters = (*map(teller.vector, hung), *(arm.said(scene) for arm in drawn))
    return Told(moments[0], teller.say("lever_forces", **said), names=frozenset(names), letters=frozenset(letters))


def _balance(teller: Teller) -> Iterator[Told]:
    """Tell the force that balances, at the end of the driver's velocity and normal to it when turned."""
    point = teller.scene.solved.mechanism.driver.point
    for step in teller.scene.solved.program.which(("normal",)):
        if step.name == f"lever.{point}":
            pole, end = teller.mark("velocity.p"), teller.mark(f"velocity.{point}")
            vector = teller.vector(hung_on_lever(teller.scene)[-1][0])
            text = teller.say("lever_balance", point=end, segment=f"{pole}{end}", vector=vector)
            yield Told(step, text, names=frozenset(BALANCE), letters=frozenset((vector, driven(teller.scene))))


def _on_lever(teller: Teller, arm: str) -> str:
    """Return an arm in millimetres of the lever."""
    if not teller.scene.defined(arm) or size_of(teller.scene, arm) == 0.0:
        return "0"
    words = teller.scene.words
    return f"{teller.scene.segment(arm)} {words.unit(words.display.paper)}"
