"""Cells as a grid of texts, every one with its address; bounds on what a file may hold."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cache

from ...scales.errors import InputError
from ...scales.numbers import quote

LARGEST = 20_000_000  # bytes of a file, and of what is unpacked from it: a class of 1000 needs 3
MOST_MERGED = 2_000  # ranges of merged cells that are looked at
MOST_ROWS, MOST_COLUMNS, MOST_CELLS = 20_000, 1_000, 2_000_000
SUFFIXES = (".csv", ".xlsx")
SHOWN = 200  # characters of a path in a message


@dataclass(frozen=True, slots=True)
class Grid:
    """The texts of a file's cells by row.

    `formulas` and `dates` are cells (row, column) with a formula that nobody has worked out, or with a date; `merged`
    are the first and last ones of those that are one.
    """

    file: str
    rows: tuple[tuple[str, ...], ...]
    formulas: frozenset[tuple[int, int]] = field(default_factory=frozenset)
    dates: frozenset[tuple[int, int]] = field(default_factory=frozenset)
    merged: tuple[tuple[tuple[int, int], tuple[int, int]], ...] = ()

    def text(self, row: int, column: int | None) -> str:
        """Return what a cell shows, nothing beyond the end of its row."""
        cells = self.rows[row]
        return cells[column] if column is not None and column < len(cells) else ""

    def shared(self, row: int, column: int) -> str:
        """Return what a cell shows, within a merged one what that shows."""
        text = self.text(row, column)
        if text or not self.merged:
            return text
        ends = (ends for ends in self.merged if ends[0][0] <= row <= ends[1][0] and ends[0][1] <= column <= ends[1][1])
        first = next(ends, ((row, column), (row, column)))[0]
        return self.text(*first) if first[0] < len(self.rows) else ""

    def place(self, row: int, column: int | None = None) -> str:
        """Return the address of a cell as a spreadsheet shows it, or of a row: `answers.csv: D12`."""
        return f"{_shown(self.file)}: {'' if column is None else letters(column)}{row + 1}"


@cache
def _shown(file: str) -> str:
    return quote(file, SHOWN)


@cache
def letters(column: int) -> str:
    """Return the letters of a column, counted from 0.

    >>> letters(0), letters(25), letters(26)
    ('A', 'Z', 'AA')
    """
    name = ""
    column += 1
    while column:
        column, at = divmod(column - 1, 26)
        name = chr(ord("A") + at) + name
    return name


def bounded(file: str, rows: list[tuple[str, ...]]) -> tuple[tuple[str, ...], ...]:
    """Return the rows without blank ones at the end; refuse more than a class needs.

    Raises
    ------
    InputError
        Too many rows or columns.
    """
    while rows and not any(rows[-1]):
        rows.pop()
    if len(rows) > MOST_ROWS or max(map(len, rows), default=0) > MOST_COLUMNS:
        raise too_many_cells(file)
    if not rows:
        raise InputError("answers-empty", file=quote(file, SHOWN))
    return tuple(rows)


def too_many_cells(file: str) -> InputError:
    """Return the error for a file with more rows or columns than any class has."""
    return InputError("answers-cells", file=quote(file, SHOWN), rows=MOST_ROWS, columns=MOST_COLUMNS)
