"""Guides, told: those of the frame are there from the start, those of moving links are laid off from the link."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator

from ....plans.board import Step
from ....plans.names import ORIGIN, role
from ..letters import guide_letters
from .teller import Teller


def guide_told(teller: Teller, step: Step) -> Iterator[str]:
    """Tell how a guide lies: one of the frame with its mark, one of a moving link with its direction."""
    letters = guide_letters(teller.scene.solved.program)
    if step.verb == "incline":
        if step.name in letters:
            base = teller.plain_line(step.operands[0])
            yield teller.say("guide_on_link", line=letters[step.name], base=base, angle=_between(teller, step))
        return
    guide = role(step.name).of
    if role(step.name).kind == ORIGIN and guide in letters:
        angle = _degrees(teller, cmath.phase(complex(teller.scene.solved.values[guide])))
        place = teller.place(step.name)
        yield teller.say("guide_drawn", line=letters[guide], place=place, angle=angle)


def _between(teller: Teller, step: Step) -> str:
    """Return the angle from a link's own direction to that of a guide on it."""
    values = teller.scene.solved.values
    turn, base = (cmath.phase(complex(values[name])) for name in (step.name, step.operands[0]))
    return _degrees(teller, turn - base)


def _degrees(teller: Teller, angle: float) -> str:
    """Return the angle of a line, 0 to 180 degrees."""
    degrees = round(math.degrees(angle) % 180.0, 2) % 180.0
    return f"{teller.scene.words.short(degrees)}°"
