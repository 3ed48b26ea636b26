"""What a sheet shows, whatever its subject: what is solved, the plans wanted, scales, givens, words, norm."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Generic, TypeVar

from ..plans.solved import Solved
from ..scales.choose import Choosers
from .givens import Given
from .pens import Norm
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
