"""A hoist over time: forces of rope and support, stress, how the load rises and the beams bend; table, CSV, JSON."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...drawing.words import Words
from ...drawing.writers import Files, save_all
from ...plans.hoist.course import Course, course, end_of, marks
from ...plans.hoist.forces import Forces
from ...scales.errors import InputError, PositionError
from ..case import Case
from ..kinds.hoist import hoist
from ..tables import Cell, csv_bytes, csv_text
from .asked import Asked, OfCase
from .data import numbers
from .sized import column_table, csv_head, in_degrees_and_millimetres

TABLED, POSITIONS = 25, 361  # times in the table, beside the marks, and in files
SUFFIXES = (".csv",)
OK = "ok"


@dataclass(frozen=True, slots=True, repr=False)
class HoistSweep(OfCase):
    """A hoist over time, until one period after the lift-off; `positions` times, None for as many as are usual."""

    words: Words
    positions: int | None

    @property
    def solved(self) -> Forces:
        """The forces, and the motion where the formulas are not valid."""
        return hoist(self.case.solved).forces

    @property
    def status(self) -> str:
        """`ok`: a hoist that is solved moves."""
        return OK

    @property
    def reason(self) -> PositionError | None:
        """None: a hoist that is solved moves."""
        return None

    @property
    def marks(self) -> Mapping[str, float]:
        """Times of the lift-off and of the greatest and least forces, s."""
        return marks(self.solved.found, self.solved.motion)

    def at(self, t: NDArray[np.float64]) -> Course:
        """Return the hoist at times of shape (N,), s."""
        return course(self.solved.found, self.solved.motion, t)

    def table(self, language: str | None = None) -> str:
        """Return even times with the marks among them."""
        words = self._words(language)
        even = self._times(self.positions or TABLED)
        heads: dict[float, list[str]] = {float(t): [] for t in even}
        for name, at in self.marks.items():
            heads.setdefault(at, []).append(name)
        found = self.at(np.array(sorted(heads)))
        names = [", ".join(heads[t]) for t in sorted(heads)]
        said = [column_table(found.columned, names, words)]
        return "\n\n".join((*said, *(warning.text(words.language) for warning in self.case.warnings)))

    def csv(self, language: str | None = None) -> str:
        """Return all columns as CSV: for `uk` and `ru` with `;` and decimal commas, for `en` with `,` and points."""
        words = self._words(language)
        found = self.at(self._times(self.positions or POSITIONS))
        shown = [in_degrees_and_millimetres(column) for column in found.columned]
        rows: list[list[Cell]] = [
            [k, *(float(column.values[k]) for column in shown), state] for k, state in enumerate(found.states)
        ]
        return csv_text(["k", *csv_head(shown, words), "bears"], rows, words.language)

    def to_json(self) -> dict[str, Any]:
        """Return what `kulman sweep --json` prints: everything in SI."""
        found = self.at(self._times(self.positions or POSITIONS))
        return {
            "task": self.task.id,
            "variant": self.variant,
            "status": self.status,
            "valid": self.solved.motion is None,
            "columns": {one.name: {"unit": one.unit, "value": numbers(one.values)} for one in found.columned},
            "bears": list(found.states),
            "marks": dict(self.marks),
        }

    def save(self, *paths: str | os.PathLike[str]) -> list[Path]:
        """Write the columns to each of `paths`.

        Raises
        ------
        InputError
            A file that is not a .csv: the diagrams of the forces are on the sheet.
        """

        def files(path: Path) -> Files:
            return [(path, csv_bytes(self.csv(), self.words.language))]

        for path in map(Path, paths):
            if path.suffix.lower() not in SUFFIXES:
                raise InputError("hoist-sweep-drawing", task=self.task.id, file=path.name)
        return save_all(paths, SUFFIXES, files)

    def _times(self, count: int) -> NDArray[np.float64]:
        return np.linspace(0.0, end_of(self.solved.found, self.solved.motion), count)

    def __repr__(self) -> str:
        """Return task, variant and the number of times."""
        return f"<HoistSweep {self.task.id} {self.variant}: {self.positions or POSITIONS} times>"

    def _repr_html_(self) -> str:
        """Show the table in a notebook."""
        from html import escape

        return f"<pre>{escape(self.table())}</pre>"

    def _words(self, language: str | None) -> Words:
        return self.words if language is None else self.words.speaking(language)


def hoist_sweep(case: Case, words: Words, asked: Asked) -> HoistSweep:
    """Look at a hoist over time.

    Raises
    ------
    InputError
        Points, a beginning or end of the motion, or chords are asked for: a hoist has none.
    """
    unused = {"--points": asked.points, "--from": asked.start, "--to": asked.end, "--chords": asked.chords}
    for option, value in unused.items():
        if value is not None:
            raise InputError("kind-without", task=case.task.id, text=option)
    return HoistSweep(case, words, asked.positions)
