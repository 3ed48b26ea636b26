"""XLSX read with bounds: the first sheet's texts, numbers and worked-out results; formulas are never evaluated.

An XLSX file is a ZIP of XML. Nothing is unpacked beyond a fixed size, and XML that declares entities is refused.
"""

from __future__ import annotations

import io
import posixpath
import re
import zipfile
import zlib
from collections.abc import Callable
from xml.parsers import expat

from ...scales.errors import InputError
from ...scales.numbers import quote
from .grid import LARGEST, MOST_CELLS, MOST_COLUMNS, MOST_MERGED, MOST_ROWS, SHOWN, Grid, bounded, too_many_cells

MOST_PARTS = 2_000
_ADDRESS = re.compile(r"([A-Z]{1,3})([0-9]{1,7})")
_ESCAPED = re.compile("_x((?!D[89A-Fa-f])[0-9A-Fa-f]{4})_", re.IGNORECASE)
_RANGE = re.compile(rf"{_ADDRESS.pattern}:{_ADDRESS.pattern}")
# number formats of dates and times that have no code of their own in the file (ECMA-376, part 1, 18.8.30)
_DATES = frozenset((*range(14, 23), *range(27, 37), *range(45, 48), *range(50, 59)))
_QUOTED = re.compile(r'"[^"]*"|\[[^\]]*\]|\\.')


class _BrokenError(Exception):
    """The file is not what it should be."""


def grid_of_xlsx(file: str, data: bytes) -> Grid:
    """Return the cells of the first sheet.

    Raises
    ------
    InputError
        No XLSX file, one with a password, or one that unpacks into more than is allowed.
    """
    shown = quote(file, SHOWN)
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            if len(archive.infolist()) > MOST_PARTS:
                raise InputError("answers-bomb", file=shown, n=LARGEST // 1_000_000)
            parts = _Parts(archive, shown)
            return _grid(file, parts)
    except (zipfile.BadZipFile, _BrokenError, expat.ExpatError, zlib.error, KeyError, EOFError):
        raise InputError("answers-not-xlsx", file=shown) from None
    except (RuntimeError, NotImplementedError, OSError, ValueError, OverflowError) as problem:
        if isinstance(problem, InputError):
            raise
        raise InputError("answers-not-xlsx", file=shown) from None


class _Parts:
    """The parts of the package, unpacked up to a size that they share."""

    def __init__(self, archive: zipfile.ZipFile, shown: str) -> None:
        self.archive, self.shown, self.left = archive, shown, LARGEST

    def has(self, name: str) -> bool:
        """Tell whether there is a part."""
        return name in self.archive.namelist()

    def read(self, name: str) -> bytes:
        """Unpack a part as far as the size allows."""
        with self.archive.open(name) as stream:
            data = stream.read(self.left + 1)
        self.left -= len(data)
        if self.left < 0:
            raise InputError("answers-bomb", file=self.shown, n=LARGEST // 1_000_000)
        return data

    def parse(
        self,
        name: str,
        start: Callable[[str, dict[str, str]], None],
        end: Callable[[str], None] | None = None,
        text: Callable[[str], None] | None = None,
    ) -> None:
        """Parse a part; names come without their namespace."""
        parser = expat.ParserCreate()
        parser.buffer_text = True
        parser.StartElementHandler = lambda tag, given: start(tag.rpartition(":")[2], given)
        if end is not None:
            parser.EndElementHandler = lambda tag: end(tag.rpartition(":")[2])
        if text is not None:
            parser.CharacterDataHandler = text
        parser.StartDoctypeDeclHandler = _refuse_doctype
        parser.Parse(self.read(name), True)


def _refuse_doctype(*_: object) -> None:
    raise _BrokenError


def _grid(file: str, parts: _Parts) -> Grid:
    """Read the first sheet with the texts and formats it shares with others."""
    strings = _shared_strings(parts)
    sheet = _Sheet(strings, _date_styles(parts), file)
    parts.parse(_first_sheet(parts), sheet.start, sheet.end, sheet.text)
    if sum(max(row) + 1 for row in sheet.cells.values()) > MOST_CELLS:
        raise too_many_cells(file)
    rows = []
    for number in range(max(sheet.cells, default=-1) + 1):
        row = sheet.cells.get(number, {})
        rows.append(tuple(row.get(column, "") for column in range(max(row, default=-1) + 1)))
    merged = tuple(sheet.merged[:MOST_MERGED])
    return Grid(file, bounded(file, rows), frozenset(sheet.formulas), frozenset(sheet.dates), merged)


def _first_sheet(parts: _Parts) -> str:
    """Return the part that holds the first sheet of the workbook."""
    ids: list[str] = []
    targets: dict[str, str] = {}

    def sheet(tag: str, given: dict[str, str]) -> None:
        if tag == "sheet":
            ids.extend(value for key, value in given.items() if key.rpartition(":")[2] == "id" and ":" in key)

    def relation(tag: str, given: dict[str, str]) -> None:
        if tag == "Relationship":
            targets[given["Id"]] = given["Target"]

    parts.parse("xl/workbook.xml", sheet)
    parts.parse("xl/_rels/workbook.xml.rels", relation)
    if not ids:
        raise _BrokenError
    target = targets[ids[0]]
    return target.lstrip("/") if target.startswith("/") else posixpath.normpath(f"xl/{target}")


def _shared_strings(parts: _Parts) -> list[str]:
    """Return the texts that cells refer to by number, without the readings that Asian texts have."""
    found: list[list[str]] = []
    inside: list[str] = []

    def start(tag: str, given: dict[str, str]) -> None:
        inside.append(tag)
        if tag == "si":
            found.append([])

    def end(tag: str) -> None:
        inside.pop()

    def text(piece: str) -> None:
        if inside and inside[-1] == "t" and "rPh" not in inside:
            found[-1].append(piece)

    if parts.has("xl/sharedStrings.xml"):
        parts.parse("xl/sharedStrings.xml", start, end, text)
    return ["".join(pieces) for pieces in found]


def _date_styles(parts: _Parts) -> frozenset[int]:
    """Return the numbers of the cell styles that show a number as a date."""
    own: set[int] = set()
    styles: list[int] = []
    inside: list[str] = []

    def start(tag: str, given: dict[str, str]) -> None:
        inside.append(tag)
        if tag == "numFmt" and re.search("[dmyhs]", _QUOTED.sub("", given["formatCode"]).lower()):
            own.add(int(given["numFmtId"]))
        if tag == "xf" and "cellXfs" in inside:
            styles.append(int(given.get("numFmtId", "0")))

    def end(tag: str) -> None:
        inside.pop()

    if parts.has("xl/styles.xml"):
        parts.parse("xl/styles.xml", start, end)
    return frozenset(at for at, style in enumerate(styles) if style in _DATES or style in own)


class _Sheet:
    """The cells of a sheet while it is read."""

    def __init__(self, strings: list[str], date_styles: frozenset[int], file: str) -> None:
        self.strings, self.date_styles, self.file = strings, date_styles, file
        self.cells: dict[int, dict[int, str]] = {}
        self.formulas: set[tuple[int, int]] = set()
        self.dates: set[tuple[int, int]] = set()
        self.merged: list[tuple[tuple[int, int], tuple[int, int]]] = []
        self._row, self._column, self._kind, self._style = -1, -1, "", 0
        self._inside: list[str] = []
        self._pieces: list[str] = []
        self._formula = False

    def start(self, tag: str, given: dict[str, str]) -> None:
        """Begin a row or a cell."""
        self._inside.append(tag)
        if tag == "row":
            self._row = int(given["r"]) - 1 if "r" in given else self._row + 1
            self._column = -1
        elif tag == "c":
            address = _ADDRESS.fullmatch(given.get("r", ""))
            self._column = _column(address[1]) if address else self._column + 1
            self._row = int(address[2]) - 1 if address else self._row
            self._kind, self._style = given.get("t", "n"), int(given.get("s", "0"))
            self._pieces, self._formula = [], False
        elif tag == "f":
            self._formula = True
        elif tag == "mergeCell" and (range_ := _RANGE.fullmatch(given.get("ref", ""))):
            first, last = ((int(range_[at + 1]) - 1, _column(range_[at])) for at in (1, 3))
            self.merged.append((first, last))

    def text(self, piece: str) -> None:
        """Take a piece of what a cell shows."""
        if self._inside and self._inside[-1] in ("v", "t") and "c" in self._inside and "rPh" not in self._inside:
            self._pieces.append(piece)

    def end(self, tag: str) -> None:
        """Put a whole cell where it belongs."""
        self._inside.pop()
        if tag != "c":
            return
        text = _unescaped("".join(self._pieces))
        if self._kind == "s" and text:
            text = _unescaped(self.strings[int(text)]) if int(text) < len(self.strings) else ""
        at = (self._row, self._column)
        if self._formula and not text:
            self.formulas.add(at)
            text = "="
        elif self._kind == "n" and text and self._style in self.date_styles:
            self.dates.add(at)
        if not text.strip():
            return  # such as one that is only coloured, however far away
        if self._row < 0:
            raise _BrokenError
        if self._row >= MOST_ROWS or self._column >= MOST_COLUMNS:
            raise too_many_cells(self.file)
        self.cells.setdefault(self._row, {})[self._column] = text.strip()


def _unescaped(text: str) -> str:
    """Return a text with the signs for which their numbers stand (ECMA-376, part 1, 22.9.2.19)."""
    return _ESCAPED.sub(lambda found: chr(int(found[1], 16)), text)


def _column(name: str) -> int:
    """Return the number of a column, counted from 0, by its letters."""
    number = 0
    for letter in name:
        number = 26 * number + ord(letter) - ord("A") + 1
    return number - 1
