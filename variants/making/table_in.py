"""Variants as departments keep them in a spreadsheet: parameters in rows and variants in columns, or the other way."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from ...drawing.writers import slug
from ...scales.errors import InputError
from ...scales.names import latin
from ...scales.numbers import quote
from ..spreadsheets.cells_in import read_grid
from ..spreadsheets.grid import SHOWN, Grid
from ..spreadsheets.headers import about_kind, column_kind, split_unit
from ..task import LocatedError, Task

_WORD = re.compile(r"^\s*(?:варіант|вариант|variant|вар\.?|var\.?|№)\s*(?:№)?\s*", re.IGNORECASE)
_NUMBER = re.compile(r"[-−+0-9.,\s]+(?:[eE][-+]?\d+)?")
PLAIN = "1"  # a unit of numbers that have none


@dataclass(frozen=True, slots=True)
class Read:
    """One variant of a spreadsheet: its givens as they are written, and what is wrong with its cells."""

    id: str
    place: str
    row: Mapping[str, str]
    problems: tuple[InputError, ...]


@dataclass(frozen=True, slots=True)
class _Table:
    """A grid seen so that variants are rows; `names` are the givens by column, `turned`: it lay on its side."""

    grid: Grid
    turned: bool
    head: int
    names: Mapping[int, tuple[str, str]]

    @property
    def _size(self) -> tuple[int, int]:
        rows, columns = len(self.grid.rows), max(map(len, self.grid.rows), default=0)
        return (columns, rows) if self.turned else (rows, columns)

    def text(self, row: int, column: int) -> str:
        """Return what a cell shows."""
        row, column = (column, row) if self.turned else (row, column)
        return self.grid.text(row, column).strip()

    def place(self, row: int, column: int) -> str:
        """Return the address of a cell."""
        return self.grid.place(*((column, row) if self.turned else (row, column)))

    @property
    def id_column(self) -> int:
        """Where the ids of the variants stand: under such a word, else before the first given."""
        columns = range(self._size[1])
        said = (column for column in columns if about_kind(self.text(self.head, column)) == "variant")
        return next(said, max(min(self.names) - 1, 0))

    @property
    def rows(self) -> Iterator[int]:
        """Go through the rows under the header."""
        return iter(range(self.head + 1, self._size[0]))


def read_variants(file: str, task: Task) -> list[Read]:
    """Read the variants of a task from a spreadsheet, .csv or .xlsx.

    A row, or a column, names the givens, `l_OA [mm]`; beside the names units may stand.

    Raises
    ------
    InputError
        A file that cannot be read, or in which no given is named.
    """
    grid = read_grid(file)
    table = max((_seen(grid, task, turned) for turned in (False, True)), key=lambda seen: len(seen.names))
    if not table.names:
        raise InputError("variants-header", file=quote(grid.file, SHOWN), known=", ".join(task.givens))
    column, units = table.id_column, dict[int, str]()
    found: list[Read] = []
    for row in table.rows:
        if not any(table.text(row, at) for at in table.names):
            continue
        if column_kind(table.text(row, column)) == "unit":
            units = {at: table.text(row, at) for at in table.names}
            continue
        name = slug(_WORD.sub("", table.text(row, column))) if column not in table.names else ""
        found.append(_read(table, row, name if name not in ("", "x") else str(len(found) + 1), units, task))
    return found


def _seen(grid: Grid, task: Task, turned: bool) -> _Table:
    """Look at a grid with variants in rows, or in columns: its header is where most givens are named."""
    rows = list(map(list, grid.rows))
    if turned:
        width = max(map(len, rows), default=0)
        rows = [[row[at] if at < len(row) else "" for row in rows] for at in range(width)]
    heads = [_names(row, task) for row in rows]
    best = max(range(len(heads)), key=lambda at: (len(heads[at]), -at), default=0)
    return _Table(grid, turned, best, heads[best] if heads else {})


def _names(cells: list[str], task: Task) -> dict[int, tuple[str, str]]:
    """Return the givens that cells name, with the units that stand beside them."""
    found: dict[int, tuple[str, str]] = {}
    for column, text in enumerate(cells):
        name, unit = split_unit(text)
        name = latin(name.replace(" ", ""))
        if name in task.givens and name not in (given for given, _ in found.values()):
            found[column] = (name, unit)
    return found


def _read(table: _Table, row: int, number: str, units: Mapping[int, str], task: Task) -> Read:
    said: dict[str, str] = {}
    problems: list[InputError] = []
    for column, (name, unit) in table.names.items():
        text, unit = table.text(row, column), unit or units.get(column, "")
        if text:
            said[name] = f"{text} {unit}" if unit not in ("", PLAIN) and _NUMBER.fullmatch(text) else text
            try:
                said[name] = _plain(task, name, said[name])
            except InputError as error:
                problems.append(LocatedError(f"{table.place(row, column)}, {name}", error))
    return Read(number, f"{table.place(row, table.id_column)}, {number}", said, tuple(problems))


def _plain(task: Task, name: str, text: str) -> str:
    """Return a value as a task file has it: a decimal point, the given's own unit."""
    given = task.givens[name]
    value = given.read(text)
    if given.unit is None or isinstance(value, str):
        return str(value)
    return f"{given.unit.from_si(value):.12g} {given.unit.behind}".strip()
