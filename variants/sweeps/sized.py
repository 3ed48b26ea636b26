"""What sweeps of cams, gears and hoists share: columns as table, CSV, JSON; what they have, write and refuse.

As text, lengths are in mm, angles in degrees, stresses in MPa, all else is in SI, as everything is in JSON.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar, Self

import numpy as np

from ...drawing.words import Words
from ...drawing.writers import save_all
from ...plans.solved import Columned, Ends
from ...scales.errors import InputError
from ...scales.numbers import quote
from ...scales.units import format_unit, unit
from ..case import Case
from ..spreadsheets.cells_out import csv_text
from ..tables import aligned
from .sweeps import CSV, SweepRequest, Swept, numbers

SHOWN = {"m": "mm", "rad": "deg", "Pa": "MPa"}
DIGITS, PLACES = 6, 9  # of a number in the table; decimals of the degrees of what drives
DRIVES = "phi"
NOTHING = 1e-9  # part of the largest value of a column below which one is rounding


@dataclass(frozen=True, slots=True, repr=False)
class SizedSweep(Swept):
    """What is found of a subject that is solved, at `positions` places; None for as many as are usual."""

    positions: int | None

    usual: ClassVar[int]  # places in files
    places: ClassVar[str] = "positions"  # what they are
    not_drawn: ClassVar[str]  # key of the message that refuses files of other kinds

    @classmethod
    def of(cls, case: Case, words: Words, asked: SweepRequest) -> Self:
        """Look at what has been solved over its motion.

        Raises
        ------
        InputError
            Points, a beginning or end of the motion, or chords are asked for, which only the cycle of a linkage has.
        """
        unused = {"--points": asked.points, "--from": asked.start, "--to": asked.end, "--chords": asked.chords}
        for option, value in unused.items():
            if value is not None:
                raise InputError("kind-without", task=quote(case.task.id), text=option)
        return cls(case, words, asked.positions)

    @property
    def count(self) -> int:
        """The number of places in files."""
        return self.positions or self.usual

    def save(self, *paths: str | os.PathLike[str]) -> list[Path]:
        """Write the columns to each of `paths`, .csv alone: diagrams are on the sheet."""
        for path in map(Path, paths):
            if path.suffix.lower() != CSV:
                raise InputError(self.not_drawn, task=quote(self.task.id), file=quote(path.name))
        return save_all(paths, (CSV,), lambda path: [(path, self._csv_file())])

    def _warned(self, words: Words) -> list[str]:
        """Return what a user should know."""
        return [warning.text(words.language) for warning in self.case.warnings]

    def __repr__(self) -> str:
        """Return task, variant and the number of places."""
        return f"<{type(self).__name__} {self.task.id} {self.variant}: {self.count} {self.places}>"


def columns_json(found: Iterable[Columned]) -> dict[str, Any]:
    """Return columns for JSON, by name."""
    return {column.name: {"unit": column.unit, "value": numbers(column.values)} for column in found}


def extremes_json(found: Iterable[Ends]) -> dict[str, Any]:
    """Return the extremes of columns for JSON, by name."""
    return {
        one.name: {
            "unit": one.unit,
            "max": {"value": one.most, "at": one.most_at},
            "min": {"value": one.least, "at": one.least_at},
        }
        for one in found
    }


def columns_csv(found: Iterable[Columned], words: Words, said: Mapping[str, Sequence[str]] | None = None) -> str:
    """Return columns as CSV, the number of the row before them, after them what is `said` of each row, by heading."""
    shown, said = [in_degrees_and_millimetres(column) for column in found], said or {}
    rows = zip(*(map(float, column.values) for column in shown), *said.values(), strict=True)
    heads = (f"{one.name} [{of}]" if (of := format_unit(one.unit, words.language)) else one.name for one in shown)
    head = ["k", *heads, *said]
    return csv_text([head, *([k, *row] for k, row in enumerate(rows))], words.language)


def in_degrees_and_millimetres(column: Columned) -> Columned:
    """Return a column as it is shown."""
    shown = SHOWN.get(column.unit)
    if shown is None:
        return column
    to: Callable[[Any], Any] = unit(shown).from_si
    values = to(column.values)
    return Columned(column.name, shown, np.round(values, PLACES) if column.name == DRIVES else values)


def column_table(found: Collection[Columned], heads: list[str], words: Words) -> str:
    """Return columns as a table, the heads of the rows before them, one that comes again but once."""
    shown = [in_degrees_and_millimetres(column) for column in found]
    rows = [["", *(_titled(column.name, column.unit, words) for column in shown)]]
    for k, head in enumerate(heads):
        rows.append([head if k == 0 or heads[k - 1] != head else "", *(_cell(column, k, words) for column in shown)])
    return aligned(rows, ())


def _titled(name: str, of: str, words: Words) -> str:
    spelled = format_unit(of, words.language)
    return f"{name}, {spelled}" if spelled else name


def _cell(column: Columned, k: int, words: Words) -> str:
    size = float(np.max(np.abs(column.values), initial=0.0, where=np.isfinite(column.values)))
    value = float(column.values[k])
    if np.isinf(value):
        return "−∞" if value < 0.0 else "∞"
    return words.short(0.0 if abs(value) <= NOTHING * size else value, DIGITS)


def extremes_table(found: Collection[Ends], words: Words) -> str:
    """Return the extremes of columns, and at which angles of what drives they are."""
    rows = [["", words["sweep.most"], "", words["sweep.least"], ""]]
    for one in found:
        shown = SHOWN.get(one.unit, one.unit)
        of = unit(shown)
        cells = [_titled(one.name, shown, words)]
        small = NOTHING * max(abs(one.most), abs(one.least))
        for value, at in ((one.most, one.most_at), (one.least, one.least_at)):
            tidy = 0.0 if abs(value) <= small else value
            cells += [words.short(of.from_si(tidy) + 0.0, DIGITS), f"{DRIVES} = {degrees(at, words)}"]
        rows.append(cells)
    return aligned(rows, (0, 2, 4))


def degrees(at: float, words: Words) -> str:
    """Return an angle in degrees."""
    return f"{words.short(round(unit('deg').from_si(at), 4), DIGITS)}°"


def millimetres(length: float, words: Words) -> str:
    """Return a length in millimetres."""
    return f"{words.short(unit('mm').from_si(length), DIGITS)} {format_unit('mm', words.language)}"
