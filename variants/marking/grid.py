"""A file of cells as a grid of texts: read with bounds on what it may hold, every cell with its address."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

from ...scales.errors import InputError
from ...scales.numbers import quote

LARGEST = 20_000_000  # bytes of a file, and of what is unpacked from it: a class of 1000 needs 3
MOST_ROWS, MOST_COLUMNS, MOST_CELLS = 20_000, 1_000, 2_000_000
SUFFIXES = (".csv", ".xlsx")
SHOWN = 200  # characters of a path in a message


@dataclass(frozen=True, slots=True)
class Grid:
    """The texts of a file's cells by row.

    `formulas` and `dates` are cells (row, column) with a formula that nobody has worked out, or with a date.
    """

    file: str
    rows: tuple[tuple[str, ...], ...]
    formulas: frozenset[tuple[int, int]] = field(default_factory=frozenset)
    dates: frozenset[tuple[int, int]] = field(default_factory=frozenset)

    def text(self, row: int, column: int | None) -> str:
        """Return what a cell shows, nothing beyond the end of its row."""
        cells = self.rows[row]
        return cells[column] if column is not None and column < len(cells) else ""

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


def read_grid(file: str | Path) -> Grid:
    """Read a file of answers, or a roster, as a grid; the suffix says which kind it is.

    Raises
    ------
    InputError
        There is no such file, it is too large, or is not what its suffix says.
    """
    path = Path(file)
    shown = quote(path, SHOWN)
    suffix = path.suffix.lower()
    if suffix not in SUFFIXES:
        raise InputError("answers-suffix", file=shown, known=", ".join(SUFFIXES))
    data = _bytes(path, shown)
    if suffix == ".xlsx":
        from .xlsx_read import grid_of_xlsx

        return grid_of_xlsx(str(path), data)
    from .csv_read import grid_of_csv

    return grid_of_csv(str(path), data)


def _bytes(path: Path, shown: str) -> bytes:
    """Return what a file holds, as long as it is a file and not too large."""
    try:
        other = path.exists() and not path.is_file()
    except (OSError, ValueError):
        other = False
    if other:
        raise InputError("answers-not-file", file=shown)
    try:
        with path.open("rb") as stream:
            data = stream.read(LARGEST + 1)
    except FileNotFoundError:
        raise InputError("file-missing", file=shown) from None
    except (OSError, ValueError):
        raise InputError("file-unreadable", file=shown) from None
    if len(data) > LARGEST:
        raise InputError("answers-large", file=shown, n=LARGEST // 1_000_000)
    if not data.strip():
        raise InputError("answers-empty", file=shown)
    return data


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
