"""What a sheet shows, whatever its subject, and what every view of a cam, a gear pair or a hoist needs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Generic, TypeVar

from ..plans.solved import Solved
from ..scales.choose import Choosers
from .formats import Style
from .givens import Given
from .pens import Norm
from .printed import DEGREES, value_text
from .shapes import Circle, Group, Pen
from .words import Words

Subject = TypeVar("Subject", bound=Solved)


@dataclass(frozen=True, slots=True)
class SheetContents(Generic[Subject]):
    """What a sheet shows: a solved subject, the plans wanted, choosers of scales, givens, words, norm.

    `note` is what the task says of its data, in the language of the sheet.
    """

    solved: Subject
    plans: tuple[str, ...]
    choosers: Choosers
    givens: Mapping[str, Given]
    words: Words
    norm: Norm = "gost"
    note: str = field(default="", kw_only=True)


@dataclass(frozen=True, slots=True)
class SubjectScene(Generic[Subject]):
    """What is solved, on a certain format, in certain words."""

    solved: Subject
    words: Words
    style: Style
    givens: Mapping[str, Given]

    def value(self, value: float) -> str:
        """Return a value with the usual digits."""
        return value_text(self.words, value)

    def degrees(self, angle: float) -> str:
        """Return an angle as a dimension has it: to a hundredth of a degree, without zeros at the end."""
        return f"{self.words.short(round(float(angle) * DEGREES, 2))}°"

    def node(self, at: complex, name: str, role: str = "node", filled: bool = False, pen: Pen = Pen.THIN) -> Group:
        """Return the mark of a point of a figure."""
        return Group((Circle(at, self.style.node, pen, fill="black" if filled else "white"),), role, name)
