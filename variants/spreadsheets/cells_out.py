"""Tables of people and their results written as the kind of file that its suffix picks, CSV or XLSX."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from .csv_write import Rows, csv_text, rounded
from .xlsx_write import xlsx_bytes


def table_bytes(path: Path, rows: Rows, language: str, title: str, bold: Iterable[int] = (), frozen: int = 0) -> bytes:
    """Return rows as the kind of file that the suffix of `path` picks."""
    if path.suffix.lower() == ".xlsx":
        return xlsx_bytes(rows, title, bold, frozen)
    return csv_table(rows, language)


def csv_table(rows: Rows, language: str, separator: str | None = None) -> bytes:
    """Return rows as CSV that a spreadsheet of the language opens, names in it, too: with a byte order mark.

    With a `separator` of its own the file is for another program: decimal points.
    """
    return csv_text(rows, language, separator, rounded).encode("utf-8-sig", "replace")  # bytes in a name of a file
