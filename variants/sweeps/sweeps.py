"""A task over its whole cycle: what is asked of a sweep, and what every sweep answers, whatever it is that moves."""

from __future__ import annotations

import math
import os
from abc import ABC, abstractmethod
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ...drawing.words import Words
from ...drawing.writers import WRITERS
from ...scales.errors import PositionError
from ..arguments import positions_of
from ..case import Case, Settings, solve_case
from ..spreadsheets.cells_out import csv_bytes
from ..task import Task

CSV = ".csv"
SUFFIXES = (CSV, *WRITERS)


@dataclass(frozen=True, slots=True)
class SweepRequest:
    """Positions, points, where a driver begins and ends, what is compared with chords; None for what is not said."""

    positions: int | None
    points: str | Iterable[str] | None
    start: str | float | None
    end: str | float | None
    chords: str | None = None


@dataclass(frozen=True, slots=True)
class Swept(ABC):
    """A variant of a task over its whole cycle; `words` are those of the table and the CSV."""

    case: Case
    words: Words

    @classmethod
    @abstractmethod
    def of(cls, case: Case, words: Words, asked: SweepRequest) -> Swept:
        """Look at a case over its whole cycle.

        Raises
        ------
        InputError
            Something is asked for that it has not.
        """

    @property
    def task(self) -> Task:
        """The task."""
        return self.case.task

    @property
    def variant(self) -> str:
        """The variant."""
        return self.case.variant

    @property
    def status(self) -> str:
        """The status of the whole cycle: `ok` where something moves."""
        return "ok"

    @property
    def reason(self) -> PositionError | None:
        """Why no position at all can be assembled, or None."""
        return None

    @abstractmethod
    def table(self, language: str | None = None) -> str:
        """Return what `kulman sweep` prints."""

    @abstractmethod
    def csv(self, language: str | None = None) -> str:
        """Return all columns as CSV: for `uk` and `ru` with `;` and decimal commas, for `en` with `,` and points."""

    @abstractmethod
    def _data(self) -> dict[str, Any]:
        """Return what has been found, for JSON: everything in SI."""

    def to_json(self) -> dict[str, Any]:
        """Return what `kulman sweep --json` prints: everything in SI."""
        return {"task": self.task.id, "variant": self.variant, "status": self.status} | self._data()

    @abstractmethod
    def save(self, *paths: str | os.PathLike[str]) -> list[Path]:
        """Write the sweep to each of `paths`; the suffix says how.

        Returns
        -------
        list of Path
            The files written.

        Raises
        ------
        InputError
            A file of a kind that is not written, two outputs of one name, or a file that cannot be written: then none
            is.
        """

    def _csv_file(self) -> bytes:
        return csv_bytes(self.csv(), self.words.language)

    def _repr_html_(self) -> str:
        """Show the table in a notebook."""
        from html import escape

        return f"<pre>{escape(self.table())}</pre>"

    def _words(self, language: str | None) -> Words:
        return self.words if language is None else self.words.speaking(language)


def sweep(
    task: str | os.PathLike[str] | Task,
    variant: str | None = None,
    *,
    set: Settings | None = None,
    only: str | Iterable[str] | None = None,
    scales: Settings | None = None,
    positions: int | None = None,
    points: str | Iterable[str] | None = None,
    start: str | float | None = None,
    end: str | float | None = None,
    chords: str | None = None,
    notation: str | None = None,
    lang: str | None = None,
) -> Swept:
    """Solve one variant of a task over its whole cycle.

    Parameters
    ----------
    task, variant, set, only, scales, notation, lang
        As for `solve`.
    positions : int, optional
        How many positions: they divide the circle of the crank evenly, into 12 when left out. Without it a table
        of a cam has its section lines, and files every degree of a cam, 101 places of contact of gears, 361 times of
        a hoist.
    points : str or iterable of str, optional
        Letters of points and numbers of links, `"B,S2,3"`: only their columns are shown.
    start : str or number, optional
        Where the driver begins: a quantity, or a number in the unit of the task's own given. Without it the crank
        begins where the working stroke begins, if the task names its output, otherwise at zero.
    end : str or number, optional
        Where a sliding driver stops; without `start` and `end` it moves as far as the links let it.
    chords : str, optional
        A point's letter, or the number of a link: the table shows its motion by plans and by chords.

    Returns
    -------
    Swept
        `Sweep` of a linkage, `CamSweep`, `GearSweep`, `HoistSweep`.
        Also when some positions, or all, have no plan: each has its status.

    Raises
    ------
    InputError
        As for `solve`; also a number of positions that makes no cycle, and an unknown point.

    >>> from kulman import sweep
    >>> swept = sweep("nau-slider-crank", "example")
    >>> round(swept.cycle.motions[0].travel.length, 6)
    0.1
    """
    if positions is not None:
        positions_of("positions", positions)
    case = solve_case(task, variant, set, only, scales)
    asked = SweepRequest(positions, points, start, end, chords)
    return case.kind.sweep(case, case.words(lang, notation), asked)


def numbers(values: Iterable[float]) -> list[float | None]:
    """Return numbers for JSON."""
    return [value + 0.0 if math.isfinite(value) else None for value in np.asarray(values).tolist()]
