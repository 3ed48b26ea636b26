"""Zhukovsky's lever, told: the velocity plan turned, then what hangs on each of its ends, with the arms."""

from __future__ import annotations

from collections.abc import Iterator

from ....plans.board import Step
from ..calculations.equations import size_of
from ..figures.lever import BALANCE
from .marks import TOLD
from .teller import Teller, Told


def lever_told(teller: Teller) -> Iterator[Told]:
    """Go through the steps of the lever."""
    for step in teller.scene.solved.program.on("lever"):
        if step.verb == "pole":
            yield from (Told(step, text, counted=False) for text in TOLD["pole"](teller, step))
        elif step.verb == "normal":
            segment = f"{teller.mark('velocity.p')}{teller.mark(step.operands[0])}"
            yield Told(step, teller.say("turned", segment=segment))
    hung: dict[str, list[Step]] = {}
    for step in teller.scene.solved.program.which(("moment",)):
        if step.operands[2] == "lever.p":
            hung.setdefault(step.operands[1], []).append(step)
    yield from (_hung(teller, mark, moments) for mark, moments in hung.items())
    yield from _balance(teller)


def _hung(teller: Teller, mark: str, moments: list[Step]) -> Told:
    """Tell the forces on one end of the lever, and their arms about its pole."""
    words = teller.scene.words
    forces = [moment.operands[0] for moment in moments]
    arms = [user.name for moment in moments for user in teller.reading.users(moment.name) if user.verb == "arm"]
    letters = [teller.vector(force) for force in forces]
    sizes = [f"{words.symbol(arm)} = {_on_lever(teller, arm)}" for arm in arms]
    point = teller.mark(f"velocity.{mark.removeprefix('lever.')}")
    text = teller.say("lever_forces", point=point, forces=", ".join(letters), arms=", ".join(sizes))
    return Told(moments[0], text, names=frozenset((*forces, *arms)), letters=frozenset(letters))


def _balance(teller: Teller) -> Iterator[Told]:
    """Tell the force that balances, at the end of the driver's velocity and normal to it when turned."""
    point = teller.scene.solved.mechanism.driver.point
    for step in teller.scene.solved.program.which(("normal",)):
        if step.name == f"lever.{point}":
            pole, end = teller.mark("velocity.p"), teller.mark(f"velocity.{point}")
            vector = teller.vector("F_bal")
            text = teller.say("lever_balance", point=end, segment=f"{pole}{end}", vector=vector)
            yield Told(step, text, names=frozenset(BALANCE), letters=frozenset((vector,)))


def _on_lever(teller: Teller, arm: str) -> str:
    """Return an arm in millimetres of the lever."""
    if not teller.scene.defined(arm) or size_of(teller.scene, arm) == 0.0:
        return "0"
    words = teller.scene.words
    return f"{teller.scene.segment(arm)} {words.unit(words.display.paper)}"
