"""Files of cells read as a grid: CSV as programs of any country write it, XLSX; one too large is refused."""

from __future__ import annotations

import codecs
import csv
import io
from collections import Counter
from itertools import islice
from pathlib import Path

from ...scales.errors import InputError
from ...scales.numbers import SHOWN, quote
from .grid import (
    LARGEST,
    LONGEST,
    LOOKED_AT,
    MOST_CELLS,
    MOST_COLUMNS,
    MOST_LETTERS,
    MOST_ROWS,
    SUFFIXES,
    Grid,
    bounded,
    recognised,
    too_long,
    too_many_cells,
    too_many_texts,
)
from .xlsx_read import grid_of_xlsx

SEPARATORS = (";", "\t", ",")
_ZIP = b"PK\x03\x04"


def read_grid(file: str | Path) -> Grid:
    """Read a file of answers, or a roster, as a grid; one too large, or not what its suffix says, is refused."""
    path = Path(file)
    shown = quote(path, SHOWN)
    if path.suffix.lower() not in SUFFIXES:
        raise InputError("answers-suffix", file=shown, known=", ".join(SUFFIXES))
    data = _bytes(path, shown)
    return (grid_of_xlsx if path.suffix.lower() == ".xlsx" else _grid_of_csv)(str(path), data)


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


def _grid_of_csv(file: str, data: bytes) -> Grid:
    """Return the cells of a CSV file; the separator is the one at which most header words are found.

    Where hardly any are, it is the one that cuts most rows into as many cells.
    """
    if data.startswith(_ZIP):
        raise InputError("answers-is-xlsx", file=quote(file, SHOWN))
    text = _decoded(file, data)
    if len(text) > MOST_LETTERS:
        raise too_many_texts(file)
    first, _, rest = text.partition("\n")
    if first.strip().lower().startswith("sep=") and len(first.strip()) == 5 and not first.strip().endswith('"'):
        return Grid(file, bounded(file, _rows(file, rest, first.strip()[-1])))
    head = "".join(islice(io.StringIO(text, newline=""), LOOKED_AT))
    best = max(SEPARATORS, key=lambda separator: _told(_rows(file, head, separator)))
    return Grid(file, bounded(file, _rows(file, text, best)))


def _told(rows: list[tuple[str, ...]]) -> tuple[int, int, int]:
    """Return how well a separator tells cells apart: by header words, by rows of one width."""
    widths = Counter(len(row) for row in rows if len(row) > 1)
    words = recognised(rows)
    return max(words, 1), max(widths.values(), default=0), words


def _decoded(file: str, data: bytes) -> str:
    """Return the text: UTF-8 if it can be, else the encoding of Cyrillic Windows; none has a NUL."""
    if data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        encodings: tuple[str, ...] = ("utf-16",)
    else:
        encodings = ("utf-8-sig", "cp1251")
    for encoding in encodings:
        try:
            text = data.decode(encoding)
        except UnicodeDecodeError:
            continue
        if "\0" not in text:
            return text
    raise InputError("answers-encoding", file=quote(file, SHOWN))


def _rows(file: str, text: str, separator: str) -> list[tuple[str, ...]]:
    """Cut a text into cells."""
    rows: list[tuple[str, ...]] = []
    cells = 0
    try:
        for row in csv.reader(io.StringIO(text, newline=""), delimiter=separator):
            cells += len(row)
            if cells > MOST_CELLS or len(rows) > 2 * MOST_ROWS:
                places = len(row) > MOST_COLUMNS or len(rows) > MOST_ROWS
                raise too_many_cells(file) if places else too_many_texts(file)
            long = next((at for at, cell in enumerate(row) if len(cell) > LONGEST), None)
            if long is not None:
                raise too_long(file, len(rows), long)
            rows.append(tuple(map(_cell, row)))
    except csv.Error:
        raise InputError("answers-quotes", file=quote(file, SHOWN), row=len(rows) + 1) from None
    return rows


def _cell(text: str) -> str:
    """Return a cell without the spaces round it, and without the apostrophe that keeps a text from being a formula."""
    text = text.strip()
    return text[1:] if text.startswith("'") and text[1:2] in {"=", "+", "-", "@", "'"} else text
