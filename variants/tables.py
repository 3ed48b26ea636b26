"""Rows as lines of aligned text, and as CSV that spreadsheets of a language read."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Container, Iterable, Sequence

Cell = str | float | int | None


def aligned(rows: Sequence[Sequence[str]], left: Container[int] = (0,)) -> str:
    """Return rows as lines, the columns that `left` names to the left, the others to the right.

    A row may have fewer cells than others.
    """
    widths = [max(len(row[i]) for row in rows if i < len(row)) for i in range(max(map(len, rows)))]

    def cell(text: str, i: int) -> str:
        return f"{text:{widths[i]}}" if i in left else f"{text:>{widths[i]}}"

    return "\n".join("  ".join(cell(text, i) for i, text in enumerate(row)).rstrip() for row in rows)


def csv_text(head: Sequence[str], rows: Iterable[Sequence[Cell]], language: str) -> str:
    """Return rows as CSV, numbers in full precision: for `uk` and `ru` with `;` and decimal commas."""
    comma = language != "en"
    stream = io.StringIO(newline="")
    writer = csv.writer(stream, delimiter=";" if comma else ",", lineterminator="\r\n")
    writer.writerow(head)
    writer.writerows([_plain(value, comma) for value in row] for row in rows)
    return stream.getvalue()


def _plain(value: Cell, comma: bool) -> str:
    """Return a cell as a spreadsheet reads it; nothing for an undefined number."""
    if value is None or (isinstance(value, float) and not math.isfinite(value)):
        return ""
    if not isinstance(value, float):
        return str(value)
    text = repr(float(value) + 0.0)
    return text.replace(".", ",") if comma else text


def csv_bytes(text: str, language: str) -> bytes:
    """Return CSV as bytes; spreadsheets know UTF-8 by the mark at its beginning, English ones need none."""
    return text.encode("utf-8" if language == "en" else "utf-8-sig")
