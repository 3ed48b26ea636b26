"""A gear pair over the contact of one pair of teeth: sliding, curvatures, how many pairs touch; as table, CSV, JSON."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ...drawing.words import Words
from ...drawing.writers import Files, save_all
from ...plans.gears.course import columns, extremes, marks, zones
from ...plans.gears.solve import SolvedGear
from ...scales.errors import InputError, PositionError
from ...scales.units import format_unit, unit
from ..case import Case
from ..kinds.gear import gear
from ..tables import Cell, csv_bytes, csv_text
from .asked import Asked, OfCase
from .data import numbers
from .sized import DIGITS, column_table, csv_head, extremes_table, in_degrees_and_millimetres

POSITIONS = 101  # of the files: every hundredth of the active line
SUFFIXES = (".csv",)
OK = "ok"


@dataclass(frozen=True, slots=True, repr=False)
class GearSweep(OfCase):
    """A pair over the contact of one pair of teeth.

    `positions` divide the active line evenly, its ends among them; None for the marks of the meshing in the table, and
    every hundredth in files.
    """

    solved: SolvedGear
    words: Words
    positions: int | None

    @property
    def status(self) -> str:
        """`ok`: a pair that is solved can mesh."""
        return OK

    @property
    def reason(self) -> PositionError | None:
        """None: a pair that is solved can mesh."""
        return None

    def table(self, language: str | None = None) -> str:
        """Return the contact at its marks, or at the positions asked for; extremes of sliding; zones of contact."""
        words = self._words(language)
        if self.positions is None:
            known = marks(self.solved)
            rows, heads = columns(self.solved, list(known.values())), list(known)
        else:
            rows = columns(self.solved, self._places())
            heads = [str(k) for k in range(self.positions)]
        said = [self._zones(words), *(warning.text(words.language) for warning in self.case.warnings)]
        return "\n\n".join(
            (column_table(rows, heads, words), extremes_table(extremes(self.solved), words), "\n".join(said))
        )

    def _zones(self, words: Words) -> str:
        mm = unit("mm")
        return "\n".join(
            words["sweep.zone"].format(
                **{
                    name: f"{words.short(mm.from_si(value), DIGITS)} {format_unit('mm', words.language)}"
                    for name, value in (("first", zone.first), ("last", zone.last), ("length", zone.length))
                },
                pairs=zone.pairs,
            )
            for zone in zones(self.solved)
        )

    def csv(self, language: str | None = None) -> str:
        """Return all columns as CSV: for `uk` and `ru` with `;` and decimal commas, for `en` with `,` and points."""
        words = self._words(language)
        shown = [in_degrees_and_millimetres(column) for column in columns(self.solved, self._places())]
        rows: list[list[Cell]] = [
            [k, *(float(column.values[k]) for column in shown)] for k in range(len(shown[0].values))
        ]
        return csv_text(["k", *csv_head(shown, words)], rows, words.language)

    def to_json(self) -> dict[str, Any]:
        """Return what `kulman sweep --json` prints: everything in SI."""
        found = columns(self.solved, self._places())
        return {
            "task": self.task.id,
            "variant": self.variant,
            "status": self.status,
            "columns": {column.name: {"unit": column.unit, "value": numbers(column.values)} for column in found},
            "extremes": {
                e.name: {
                    "unit": e.unit,
                    "max": {"value": e.most, "at": e.most_at},
                    "min": {"value": e.least, "at": e.least_at},
                }
                for e in extremes(self.solved)
            },
            "marks": marks(self.solved),
            "zones": [{"from": zone.first, "to": zone.last, "pairs": zone.pairs} for zone in zones(self.solved)],
        }

    def save(self, *paths: str | os.PathLike[str]) -> list[Path]:
        """Write the columns to each of `paths`.

        Raises
        ------
        InputError
            A file that is not a .csv: the diagrams of sliding are on the sheet.
        """

        def files(path: Path) -> Files:
            return [(path, csv_bytes(self.csv(), self.words.language))]

        for path in map(Path, paths):
            if path.suffix.lower() not in SUFFIXES:
                raise InputError("gear-sweep-drawing", task=self.task.id, file=path.name)
        return save_all(paths, SUFFIXES, files)

    def _places(self) -> Any:
        first, last = self.solved.meshing.touching
        return np.linspace(first, last, self.positions or POSITIONS)

    def __repr__(self) -> str:
        """Return task, variant and the number of positions."""
        return f"<GearSweep {self.task.id} {self.variant}: {self.positions or POSITIONS} positions>"

    def _repr_html_(self) -> str:
        """Show the table in a notebook."""
        from html import escape

        return f"<pre>{escape(self.table())}</pre>"

    def _words(self, language: str | None) -> Words:
        return self.words if language is None else self.words.speaking(language)


def gear_sweep(case: Case, words: Words, asked: Asked) -> GearSweep:
    """Look at a pair over the contact of one pair of teeth.

    Raises
    ------
    InputError
        Points, a beginning or end of the motion, or chords are asked for: a contact has none.
    """
    unused = {"--points": asked.points, "--from": asked.start, "--to": asked.end, "--chords": asked.chords}
    for option, value in unused.items():
        if value is not None:
            raise InputError("kind-without", task=case.task.id, text=option)
    return GearSweep(case, gear(case.solved), words, asked.positions)
