"""Variants as departments keep them in a spreadsheet: parameters in rows and variants in columns, or the other way."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from ...drawing.writers import slug
from ...scales.errors import InputError
from ...scales.numbers import SHOWN, quote
from ...scales.units import parse
from ..spreadsheets.grid import Grid, read_grid
from ..spreadsheets.headers import UNDERSTOOD, about_kind, column_kind, symbol, variant_said
from ..task import Given, LocatedError, Task

_NUMBER = re.compile(r"[-−+0-9.,\s]+(?:[eE][-+]?\d+)?")
_BETWEEN = re.compile(r"[,:;()\[\]]")  # parts of a header: what it is, its symbol, its unit
PLAIN = "1"  # a unit of numbers that have none
NOTHING = frozenset(UNDERSTOOD["none"])  # in the place of a unit


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
        """Return what a cell shows, in merged ones that of all."""
        row, column = (column, row) if self.turned else (row, column)
        return self.grid.shared(row, column).strip()

    def place(self, row: int, column: int) -> str:
        """Return the address of a cell."""
        return self.grid.place(*((column, row) if self.turned else (row, column)))

    @property
    def id_column(self) -> int:
        """Where the ids of the variants stand: under such a word, else before the first given where all differ."""
        columns = range(self._size[1])
        said = (column for column in columns if about_kind(self.text(self.head, column)) == "variant")
        before = range(min(self.names) - 1, -1, -1)
        return next(said, next(filter(self._tells, before), max(min(self.names) - 1, 0)))

    def _tells(self, column: int) -> bool:
        """Whether a column tells the rows that have numbers apart."""
        rows = (row for row in self.rows if any(_NUMBER.fullmatch(self.text(row, at)) for at in self.names))
        found = [self.text(row, column) for row in rows]
        return "" not in found and len(set(found)) == len(found) > 0

    @property
    def rows(self) -> Iterator[int]:
        """Go through the rows under the header."""
        return iter(range(self.head + 1, self._size[0]))


def read_variants(file: str, task: Task) -> list[Read]:
    """Read the variants of a task from a spreadsheet, .csv or .xlsx.

    A row, or a column, names the givens, `l_OA [mm]`; beside the names units may stand.
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
        if _is_units(table, row, column, task):
            units = {at: table.text(row, at) for at in table.names if table.text(row, at) not in NOTHING}
            continue
        name = slug(variant_said(table.text(row, column))) if column not in table.names else ""
        found.append(_read(table, row, name if name not in ("", "x") else str(len(found) + 1), units, task))
    return found


def _is_units(table: _Table, row: int, column: int, task: Task) -> bool:
    """Whether a row holds the units of the givens: it says so, or units of theirs stand there, and no number."""
    if column_kind(table.text(row, column)) == "unit":
        return True
    said = [(table.text(row, at), task.givens[name]) for at, (name, _) in table.names.items()]
    return any(_is_unit(*one) for one in said) and not any(re.match(r"[-−+]?[0-9]", text) for text, _ in said)


def _is_unit(text: str, given: Given) -> bool:
    """Whether a text is a unit in which a given can be written."""
    if given.unit is None or not text or text[0].isdigit():
        return False
    try:
        parse(f"1 {text}", given.unit)
    except InputError:
        return False
    return True


def _seen(grid: Grid, task: Task, turned: bool) -> _Table:
    """Look at a grid with variants in rows, or in columns: its header is where most givens are named."""
    rows = list(map(list, grid.rows))
    if turned:
        width = max(map(len, rows), default=0)
        rows = [[row[at] if at < len(row) else "" for row in rows] for at in range(width)]
    symbols = {symbol(name): name for name in task.givens}
    small = [letters.lower() for letters in symbols]
    # in small letters, too, where these tell them apart
    known = {letters.lower(): name for letters, name in symbols.items() if small.count(letters.lower()) == 1} | symbols
    heads = [_names(row, task, known) for row in rows]
    best = max(range(len(heads)), key=lambda at: (len(heads[at]), -at), default=0)
    return _Table(grid, turned, best, heads[best] if heads else {})


def _names(cells: list[str], task: Task, known: Mapping[str, str]) -> dict[int, tuple[str, str]]:
    """Return the givens that cells name, with the units that stand beside them."""
    found: dict[int, tuple[str, str]] = {}
    for column, text in enumerate(cells):
        parts = [part.strip() for part in _BETWEEN.split(text) if part.strip()]
        named = ((at, name) for at, part in enumerate(parts) if (name := _named(part, at == 0, known)))
        at, name = next(named, (0, ""))
        if name and name not in (given for given, _ in found.values()):
            found[column] = (name, _unit_beside(parts, at, task.givens[name]))
    return found


def _named(part: str, first: bool, known: Mapping[str, str]) -> str:
    """Return the given that a part of a header names: as a whole, or as one of its words, `Маса шатуна m_2`."""
    whole = symbol(part)
    if len(whole) > 1 or first:
        name = known.get(whole) or known.get(whole.lower())
        if name:
            return name
    words = {known[letters] for word in part.split() if len(letters := symbol(word)) > 1 and letters in known}
    return words.pop() if len(words) == 1 else ""


def _unit_beside(parts: list[str], at: int, given: Given) -> str:
    """Return the unit in a header: a part that is one, else what stands behind the name, to be refused with a value."""
    others = [*parts[at + 1 :], *parts[:at]]
    behind = parts[-1] if at < len(parts) - 1 else ""
    return next((part for part in others if _is_unit(part, given)), behind)


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
