"""A task over its whole cycle: what every sweep answers, whatever moves; columns of cams, gears and hoists."""

from __future__ import annotations

import os
from abc import abstractmethod
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar, Self

import numpy as np

from ...drawing.words import Words
from ...drawing.writers import WRITERS, Files
from ...plans.solved import Columned, Ends
from ...scales.errors import InputError, PositionError
from ...scales.numbers import quote
from ...scales.units import format_unit, unit
from ..case import Case, Request, Settings, positions_of
from ..reader import load_task
from ..tables import Result, aligned, csv_bytes, csv_text, plain
from ..task import Task

CSV = ".csv"
SUFFIXES = (CSV, *WRITERS)
SHOWN = {"m": "mm", "rad": "deg", "Pa": "MPa"}
DIGITS, PLACES = 6, 9  # of a number in the table; decimals of the degrees of what drives
DRIVES = "phi"
NOTHING = 1e-9  # part of the largest value of a column below which one is rounding
Rows = tuple[list[str], Sequence[Columned]]  # what stands before the rows of a table, and its columns


@dataclass(frozen=True, slots=True)
class SweepRequest:
    """Positions, points, where a driver begins and ends, what is compared with chords; None for what is not said."""

    positions: int | None
    points: str | Iterable[str] | None
    start: str | float | None
    end: str | float | None
    chords: str | None = None


@dataclass(frozen=True, slots=True)
class Swept(Result):
    """A variant of a task over its whole cycle; `words` are those of the table and the CSV."""

    suffixes = SUFFIXES
    case: Case
    words: Words

    @classmethod
    @abstractmethod
    def of(cls, case: Case, words: Words, asked: SweepRequest) -> Swept:
        """Look at a case over its whole cycle; what is asked for that it has not is refused."""

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
    def csv(self, language: str | None = None) -> str:
        """Return all columns as CSV: for `uk` and `ru` with `;` and decimal commas, for `en` with `,` and points."""

    @abstractmethod
    def _data(self) -> dict[str, Any]:
        """Return what has been found, for JSON: everything in SI."""

    def to_json(self) -> dict[str, Any]:
        """Return what `kulman sweep --json` prints: everything in SI."""
        data = {"task": self.task.id, "variant": self.variant, "status": self.status} | self._data()
        return {name: plain(value) for name, value in data.items()}

    def _csv_file(self) -> bytes:
        return csv_bytes(self.csv(), self.words.language)


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
    language = "en" if lang is None else lang
    case = Request(load_task(task), variant, set, only, scales, notation, language).case()
    return case.kind.sweep(case, case.words(), SweepRequest(positions, points, start, end, chords))


@dataclass(frozen=True, slots=True, repr=False)
class SizedSweep(Swept):
    """What is found of a subject that is solved, at `positions` places; None for as many as are usual."""

    positions: int | None

    usual: ClassVar[int]  # places in files
    places: ClassVar[str] = "positions"  # what they are
    not_drawn: ClassVar[str]  # key of the message that refuses files of other kinds

    @classmethod
    def of(cls, case: Case, words: Words, asked: SweepRequest) -> Self:
        """Look at what has been solved over its motion; refuse what only the cycle of a linkage has."""
        unused = {"--points": asked.points, "--from": asked.start, "--to": asked.end, "--chords": asked.chords}
        for option, value in unused.items():
            if value is not None:
                raise InputError("kind-without", task=quote(case.task.id), text=option)
        return cls(case, words, asked.positions)

    @property
    def count(self) -> int:
        """The number of places in files."""
        return self.positions or self.usual

    @abstractmethod
    def _places(self, count: int) -> Any:
        """Return so many places, evenly."""

    @abstractmethod
    def _columns(self, places: Any) -> Sequence[Columned]:
        """Return the columns at places."""

    def _rows(self) -> Rows:
        """Return what stands before the rows of the table, and its columns."""
        return list(map(str, range(self.count))), self._columns(self._places(self.count))

    def _extremes(self) -> Sequence[Ends]:
        """Return the extremes of columns, where they are told."""
        return ()

    def _remarks(self, words: Words) -> list[str]:
        """Return what is said below the table."""
        return self._warned(words)

    def _states(self, places: Any) -> Mapping[str, Sequence[str]]:
        """Return what is said of each place in files, by heading."""
        return {}

    def table(self, language: str | None = None) -> str:
        """Return the columns at what is marked, or at the positions asked for, then extremes and remarks."""
        words = self._words(language)
        heads, columns = self._rows()
        shown = [in_degrees_and_millimetres(column) for column in columns]
        rows = [["", *(_titled(column.name, column.unit, words) for column in shown)]]
        for k, head in enumerate(heads):  # one that comes again stands but once
            first = k == 0 or heads[k - 1] != head
            rows.append([head if first else "", *(_cell(column, k, words) for column in shown)])
        parts = aligned(rows, ()), _extremes_table(self._extremes(), words), *self._remarks(words)
        return "\n\n".join(part for part in parts if part)

    def csv(self, language: str | None = None) -> str:
        """Return all columns as CSV, the number of the row before them, after them what is said of each row."""
        places, words = self._places(self.count), self._words(language)
        shown, states = [in_degrees_and_millimetres(column) for column in self._columns(places)], self._states(places)
        heads = (f"{one.name} [{of}]" if (of := format_unit(one.unit, words.language)) else one.name for one in shown)
        rows = zip(*(map(float, column.values) for column in shown), *states.values(), strict=True)
        return csv_text([["k", *heads, *states], *([k, *row] for k, row in enumerate(rows))], words.language)

    def _data(self) -> dict[str, Any]:
        """Return columns, and extremes where they are told."""
        found: dict[str, Any] = {"columns": {}, "extremes": {}}
        for column in self._columns(self._places(self.count)):
            found["columns"][column.name] = {"unit": column.unit, "value": column.values}
        for ends in self._extremes():
            most, least = (ends.most, ends.most_at), (ends.least, ends.least_at)
            found["extremes"][ends.name] = ends_data(ends.unit, most, least)
        return {name: columns for name, columns in found.items() if columns}

    def _files(self, path: Path, drawn: Callable[[], Any]) -> Files:
        """Return the file of the columns, .csv alone: diagrams are on the sheet."""
        if path.suffix.lower() != CSV:
            raise InputError(self.not_drawn, task=quote(self.task.id), file=quote(path.name))
        return [(path, self._csv_file())]

    def _warned(self, words: Words) -> list[str]:
        """Return what a user should know."""
        return [warning.text(words.language) for warning in self.case.warnings]

    def __repr__(self) -> str:
        """Return task, variant and the number of places."""
        return f"<{type(self).__name__} {self.task.id} {self.variant}: {self.count} {self.places}>"


def ends_data(of: str, most: tuple[float, float], least: tuple[float, float]) -> dict[str, Any]:
    """Return the largest and the smallest value, each with its place, as data."""
    return {"unit": of} | {key: {"value": x, "at": at} for key, (x, at) in (("max", most), ("min", least))}


def in_degrees_and_millimetres(column: Columned) -> Columned:
    """Return a column as it is shown."""
    shown = SHOWN.get(column.unit)
    if shown is None:
        return column
    values: Any = column.values
    values = unit(shown).from_si(values)
    return Columned(column.name, shown, np.round(values, PLACES) if column.name == DRIVES else values)


def _titled(name: str, of: str, words: Words) -> str:
    spelled = format_unit(of, words.language)
    return f"{name}, {spelled}" if spelled else name


def _cell(column: Columned, k: int, words: Words) -> str:
    size = float(np.max(np.abs(column.values), initial=0.0, where=np.isfinite(column.values)))
    value = float(column.values[k])
    if np.isinf(value):
        return "−∞" if value < 0.0 else "∞"
    return words.short(0.0 if abs(value) <= NOTHING * size else value, DIGITS)


def _extremes_table(found: Collection[Ends], words: Words) -> str:
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
    return aligned(rows, (0, 2, 4)) if found else ""


def degrees(at: float, words: Words) -> str:
    """Return an angle in degrees."""
    return f"{words.short(round(unit('deg').from_si(at), 4), DIGITS)}°"


def millimetres(length: float, words: Words) -> str:
    """Return a length in millimetres."""
    return f"{words.short(unit('mm').from_si(length), DIGITS)} {format_unit('mm', words.language)}"
