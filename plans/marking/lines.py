"""What marking says: the verdict of every line, and the first one with an error of its own."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any

from ..board import Step
from .answers import Answer, Said
from .key import Key


class Verdict(StrEnum):
    """What a line is; `passed` where it counts as right, `faulty` where there is an error in this very line."""

    RIGHT = "right"
    CARRIED = "carried"
    WRONG = "wrong"
    UNCOUNTED = "uncounted"  # follows from numbers most of which are wrong
    ARITHMETIC = "arithmetic"
    SCALE = "scale"
    MISSING = "missing"

    passed: bool
    faulty: bool

    def __init__(self, value: str) -> None:
        """Say once what is asked of every line again and again."""
        self.passed, self.faulty = value in ("right", "carried"), value in ("wrong", "arithmetic", "scale")


@dataclass(frozen=True, slots=True)
class Line:
    """One line marked; sizes in SI, vectors complex.

    Parameters
    ----------
    said : float or complex, optional
        What the answer says; what it leaves out (a direction, a sense) is that of what follows.
    right, follows : float or complex
        The right value, and what follows from the answers before it.
    allowed : float
        The tolerance of the size.
    off : float
        By how many tolerances it misses the better of the two.
    about : str
        Of a line that does not pass: "size" or "direction", that of a scalar being its sense.
    way : Said, optional
        How the answer was taken.
    """

    name: str
    plan: str
    verdict: Verdict
    answer: Answer | None
    said: Any
    right: Any
    follows: Any
    allowed: float
    off: float
    about: str = ""
    way: Said | None = None


@dataclass(frozen=True, slots=True)
class Marking:
    """All lines in order of construction, the first one with an error of its own, and the step that it shows.

    `marker` is the `Marker` that has judged them.
    """

    key: Key
    lines: tuple[Line, ...]
    first_wrong: str | None
    step: Step | None
    marker: Any = field(default=None, repr=False, compare=False)

    def __getitem__(self, name: str) -> Line:
        """Return the line of a quantity."""
        return next(line for line in self.lines if line.name == name)

    @property
    def answered(self) -> tuple[Line, ...]:
        """The lines that are not missing."""
        return tuple(line for line in self.lines if line.verdict is not Verdict.MISSING)
