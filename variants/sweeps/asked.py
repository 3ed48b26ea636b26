"""What is asked of a sweep, and what every sweep answers, whatever it is that moves."""

from __future__ import annotations

import os
from abc import ABC, abstractmethod
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

from ...drawing.words import Words
from ...scales.errors import PositionError
from ..case import Case
from ..task import Task


@dataclass(frozen=True, slots=True)
class SweepRequest:
    """Positions, points, where a driver begins and ends, what is compared with chords; None for what is not said."""

    positions: int | None
    points: str | Iterable[str] | None
    start: str | float | None
    end: str | float | None
    chords: str | None = None


@dataclass(frozen=True, slots=True)
class OfCase(ABC):
    """What is swept: a variant of a task; `words` are those of the table and the CSV."""

    case: Case
    words: Words

    @property
    def task(self) -> Task:
        """The task."""
        return self.case.task

    @property
    def variant(self) -> str:
        """The variant."""
        return self.case.variant

    @abstractmethod
    def table(self, language: str | None = None) -> str:
        """Return what `kulman sweep` prints."""

    def _repr_html_(self) -> str:
        """Show the table in a notebook."""
        from html import escape

        return f"<pre>{escape(self.table())}</pre>"

    def _words(self, language: str | None) -> Words:
        return self.words if language is None else self.words.speaking(language)


class Swept(Protocol):
    """A variant of a task over its whole cycle."""

    @property
    def task(self) -> Task:
        """The task."""

    @property
    def variant(self) -> str:
        """The variant."""

    @property
    def status(self) -> str:
        """The status of the whole cycle."""

    @property
    def reason(self) -> PositionError | None:
        """Why no position at all can be assembled, or None."""

    def table(self, language: str | None = None) -> str:
        """Return what `kulman sweep` prints."""

    def csv(self, language: str | None = None) -> str:
        """Return all columns as CSV."""

    def to_json(self) -> dict[str, Any]:
        """Return what `kulman sweep --json` prints: everything in SI."""

    def save(self, *paths: str | os.PathLike[str]) -> list[Path]:
        """Write the sweep to each of `paths`.

        Raises
        ------
        InputError
            A file of a kind that is not written, or that cannot be written: then none is.
        """
