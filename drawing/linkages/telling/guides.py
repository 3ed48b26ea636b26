"""Guides, told: those of the frame are there from the start, those of moving links are laid off from the link."""

from __future__ import annotations

import cmath
import math
import re
from collections.abc import Iterator

from ....plans.board import Step
from ..letters import guide_letters
from .teller import Teller

GUIDES = re.compile(r"_(u_\w+)_origin")  # the mark on a guide from which distances count


def guide_told(teller: Teller, step: Step) -> Iterator[str]:
    """Tell how a guide lies: one of the frame with its mark, one of a moving link with its direction."""
    letters = guide_letters(teller.scene.solved.program)
    if step.verb == "incline":
        if step.name in letters:
            base = teller.line(step.operands[0]).removeprefix("∥ ")
            yield teller.say("guide_on_link", line=letters[step.name], base=base, angle=_between(teller, step))
        return
    found = GUIDES.fullmatch(step.name)
    if found is not None and found[1] in letters:
        angle = _degrees(teller, cmath.phase(complex(teller.scene.solved.values[found[1]])))
        place = teller.place(step.name)
        yield teller.say("guide_drawn", line=letters[found[1]], place=place, angle=angle)


def _between(teller: Teller, step: Step) -> str:
    """Return the angle from a link's own direction to that of a guide on it."""
    values = teller.scene.solved.values
    turn, base = (cmath.phase(complex(values[name])) for name in (step.name, step.operands[0]))
    return _degrees(teller, turn - base)


def _degrees(teller: Teller, angle: float) -> str:
    """Return the angle of a line, 0 to 180 degrees."""
    degrees = round(math.degrees(angle) % 180.0, 2) % 180.0
    return f"{teller.scene.words.short(degrees)}°"
