"""Rows of cells written as CSV: nothing is taken for a formula, numbers as spreadsheets of a language read them."""

from __future__ import annotations

import csv
import io
import math
import re
from collections.abc import Callable, Iterable, Sequence
from typing import TypeAlias

Cell: TypeAlias = str | float | int | None
Rows: TypeAlias = Sequence[Sequence[Cell]]
DANGEROUS = tuple("=+-@|%\t\r\n＝＋－＠")  # with which programs begin a formula or a command
# the same behind what another program, or one of another country, takes for the end of a cell; -5 mm is no formula
_INSIDE = re.compile(r"([,;\t\r\n][^\S\t\r\n]*+)(?=[=@|%＝＠]|[-+－＋][^,;\t\r\n]*[(|!=@])")


def csv_text(
    rows: Iterable[Sequence[Cell]],
    language: str,
    separator: str | None = None,
    number: Callable[[float], str] | None = None,
) -> str:
    """Return rows as CSV: for `uk` and `ru` with `;` and decimal commas.

    Parameters
    ----------
    separator : str, optional
        For another program than a spreadsheet: decimal points.
    number : callable, optional
        How a number is written; in full precision when left out.
    """
    comma = separator is None and language != "en"
    stream = io.StringIO(newline="")
    writer = csv.writer(stream, delimiter=separator or (";" if comma else ","), lineterminator="\r\n")
    writer.writerows([_text(cell, comma, number or exact) for cell in row] for row in rows)
    return stream.getvalue()


def _text(cell: Cell, comma: bool, number: Callable[[float], str]) -> str:
    """Return a cell as a spreadsheet reads it; nothing for an undefined number."""
    if cell is None or (isinstance(cell, float) and not math.isfinite(cell)):
        return ""
    if isinstance(cell, str):
        return harmless(cell)
    text = number(cell)
    return text.replace(".", ",") if comma else text


def harmless(text: str) -> str:
    """Return a text that no spreadsheet takes for a formula: an apostrophe is put before what might be one.

    >>> harmless("=1+1"), harmless("V_B"), harmless("-5 mm")
    ("'=1+1", 'V_B', "'-5 mm")
    >>> harmless("x,=1+1"), harmless("2, -5 mm")
    ("x,'=1+1", '2, -5 mm')
    """
    within = _INSIDE.sub(r"\1'", text)
    seen = next((sign for sign in text if sign in DANGEROUS or (sign.isprintable() and sign != " ")), "")
    return f"'{within}" if seen in DANGEROUS else within


def exact(value: float) -> str:
    """Return a number in full precision, without the sign of a zero."""
    return repr(float(value) + 0.0) if isinstance(value, float) else str(value)


def rounded(value: float) -> str:
    """Return a number as people want to see it in a table."""
    return f"{value:.10g}"


def csv_bytes(text: str, language: str) -> bytes:
    """Return CSV of numbers as bytes; spreadsheets know UTF-8 by the mark at its beginning, English ones need none."""
    return text.encode("utf-8" if language == "en" else "utf-8-sig")
