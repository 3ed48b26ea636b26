"""Cells as a grid of texts, every one with its address; bounds on what a file may hold."""

from __future__ import annotations

from bisect import bisect_right
from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from typing import TypeAlias

from ...scales.errors import InputError, Written
from ...scales.names import seen
from ...scales.numbers import SHOWN, quote

LARGEST = 20_000_000  # bytes of a file, and of what is unpacked from it: a class of 1000 needs 12
LONGEST, MOST_LETTERS = 32_767, 8_000_000  # characters of a cell, as programs have it, and of all: a class needs 5
MOST_MERGED = 100_000  # rows of ranges of merged cells that are looked at
MOST_ROWS, MOST_COLUMNS, MOST_CELLS = 20_000, 1_000, 270_000
SUFFIXES = (".csv", ".xlsx")

Merged: TypeAlias = Mapping[int, Sequence[tuple[int, int, int]]]


@dataclass(frozen=True, slots=True)
class Grid:
    """The texts of a file's cells by row.

    `formulas` and `dates` are cells (row, column) with a formula that nobody has worked out, or with a date; `merged`
    are those that are one, by row, from left to right: first and last column, and the row that has the text.
    """

    file: str
    rows: tuple[tuple[str, ...], ...]
    formulas: frozenset[tuple[int, int]] = field(default_factory=frozenset)
    dates: frozenset[tuple[int, int]] = field(default_factory=frozenset)
    merged: Merged = field(default_factory=dict)

    def text(self, row: int, column: int | None) -> str:
        """Return what a cell shows, nothing beyond the end of its row."""
        cells = self.rows[row]
        return cells[column] if column is not None and column < len(cells) else ""

    def shared(self, row: int, column: int) -> str:
        """Return what a cell shows, within a merged one what that shows."""
        text = self.text(row, column)
        if text or not self.merged:
            return text
        ranges = self.merged.get(row, ())
        at = bisect_right(ranges, (column, MOST_COLUMNS, MOST_ROWS)) - 1
        first, last, top = ranges[at] if at >= 0 else (column, column, row)
        return self.text(top, first) if column <= last else ""

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


def by_row(ranges: Iterable[tuple[tuple[int, int], tuple[int, int]]], rows: int) -> Merged:
    """Return ranges of merged cells, given by their first and last ones, as a grid of so many rows has them."""
    found: dict[int, list[tuple[int, int, int]]] = defaultdict(list)
    left = MOST_MERGED
    for (top, first), (bottom, last) in ranges:
        bottom = min(bottom, rows - 1)
        left -= max(bottom - top + 1, 0)
        if left < 0:
            break
        for row in range(top, bottom + 1):
            found[row].append((first, last, top))
    return {row: sorted(spans) for row, spans in found.items()}


def bounded(file: str, rows: list[tuple[str, ...]]) -> tuple[tuple[str, ...], ...]:
    """Return the rows without blank ones at the end and signs that nobody sees; refuse more than a class needs.

    Raises
    ------
    InputError
        Too many rows or columns.
    """
    rows = [row if all(map(str.isprintable, row)) else tuple(seen(text).strip() for text in row) for row in rows]
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


def too_many_texts(file: str) -> InputError:
    """Return the error for a file with more in its cells than any class has."""
    return InputError("answers-many", file=quote(file, SHOWN))


def too_long(file: str, row: int, column: int) -> InputError:
    """Return the error for a cell with a text that belongs in no table."""
    return InputError("answers-long", place=Written(Grid(file, ()).place(row, column)), n=LONGEST)
