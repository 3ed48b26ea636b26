"""Files of cells read as a grid, behind bounds: CSV as programs of any country write it, and XLSX by openpyxl.

Of XLSX the first sheet's texts, numbers and worked-out results are read, no formula is evaluated. openpyxl reads whole
parts before the first row, makes as many rows as a file claims, and fails at looks that it does not know. So parts are
unpacked as far as they may be, XML without declarations, and gone through element by element, rows and cells in order
at their places; what a cell holds openpyxl says, one row at a time.
"""

from __future__ import annotations

import codecs
import csv
import io
import posixpath
import re
import warnings
import zipfile
import zlib
from collections import Counter
from collections.abc import Iterator, Sequence
from contextlib import suppress
from datetime import date, time, timedelta
from itertools import islice
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

from ...scales.errors import InputError, KeptError
from ...scales.numbers import SHOWN, quote
from ..drawings.apart import handed_in
from . import grid

MOST_PARTS, MOST_SHEETS = 2_000, 50
RATIO, FREE = 250, 1_000_000  # times its size that a part may unpack into, from so many bytes on
DEEPEST, STEP = 50, 32_768  # elements in one another; bytes parsed at a time
MOST_TAGS = 1_300_000  # in all: a class of 1000 with 259 numbers each has 1,040,000
TEXT, LOOK = 3, 8  # cells that a text, or a look of a cell, counts for: so much longer it takes
BLANKS = 50  # rows or cells left out that count for one
LOOKED_AT = 65_536  # bytes of a worksheet in which a value is looked for
EXACT = 1e15  # whole numbers below are written as such
TIMES = (date, time, timedelta)
MOST_FORMATS, LONGEST_FORMAT, MOST_BRACKETS = 1_000, 255, 10  # of numbers, made in the file; programs make 250
_MAIN = b"http://schemas.openxmlformats.org/spreadsheetml/2006/main"
_STRICT = b"http://purl.oclc.org/ooxml/spreadsheetml/main"
_REFUSED = re.compile(rb"<!(?:DOCTYPE|ENTITY)|\0")  # declarations; signs that no text in ASCII or UTF-8 has
_LONG = re.compile(b"<[^<>]{200000}")  # tags that no program writes
_ESCAPED = re.compile("_x((?!D[89A-Fa-f])[0-9A-Fa-f]{4})_", re.IGNORECASE)
_RANGE = re.compile("([A-Z]{1,3})([0-9]{1,7}):([A-Z]{1,3})([0-9]{1,7})")
_VALUE = re.compile(rb"<(?:\w+:)?(?:v|is)>")
_PLACE = re.compile("[0-9]{1,7}")  # of a text among those that are shared, of a row
SEPARATORS = (";", "\t", ",")
_ZIP = b"PK\x03\x04"
Cell = tuple[int, int]  # row and column, counted from 0


def read_grid(file: str | Path) -> grid.Grid:
    """Read a file of answers, or a roster, as a grid; one too large, or not what its suffix says, is refused."""
    if Path(file).suffix.lower() not in grid.SUFFIXES:
        raise InputError("answers-suffix", file=quote(file, SHOWN), known=", ".join(grid.SUFFIXES))
    data, shown, suffix = handed_in(file, grid.LARGEST, "answers-not-file")
    if len(data) > grid.LARGEST:
        raise InputError("answers-large", file=shown, n=grid.LARGEST // 1_000_000)
    if not data.strip():
        raise InputError("answers-empty", file=shown)
    return (_grid_of_xlsx if suffix == ".xlsx" else _grid_of_csv)(str(Path(file)), data)


def keep_filled_in(file: Path) -> None:
    """Raise a KeptError where there is a table that people fill in: a form, answers, a roster, data of variants."""
    if file.suffix.lower() in grid.SUFFIXES and file.is_file() and _is_filled_in(file):
        raise KeptError("output-form", file=quote(file, SHOWN))


def _is_filled_in(file: Path) -> bool:
    """Tell whether a table is one that people fill in, by the words over its columns; no result of this program is."""
    with suppress(InputError):
        for row in read_grid(file).rows[: grid.LOOKED_AT]:
            kinds, about = {*map(grid.column_kind, row)}, {*map(grid.about_kind, row)} - {None}
            if any(heads in f";{';'.join(row)};" for heads in grid.UNDERSTOOD["results"]):
                break
            if {"name"} <= kinds and kinds & {"mm", "value", "direction"}:
                return True
            if about and "unit" not in kinds and len([*filter(None, row)]) > 1:
                return True
    return False


def _grid_of_csv(file: str, data: bytes) -> grid.Grid:
    """Return the cells of a CSV file; the separator is the one at which most header words are found.

    Where hardly any are, it is the one that cuts most rows into as many cells.
    """
    if data.startswith(_ZIP):
        raise InputError("answers-is-xlsx", file=quote(file, SHOWN))
    text = _decoded(file, data)
    if len(text) > grid.MOST_LETTERS:
        raise grid.too_many_texts(file)
    first, _, rest = text.partition("\n")
    if first.strip().lower().startswith("sep=") and len(first.strip()) == 5 and not first.strip().endswith('"'):
        return grid.Grid(file, grid.bounded(file, _rows(file, rest, first.strip()[-1])))
    head = "".join(islice(io.StringIO(text, newline=""), grid.LOOKED_AT))
    best = max(SEPARATORS, key=lambda separator: _told(_rows(file, head, separator)))
    return grid.Grid(file, grid.bounded(file, _rows(file, text, best)))


def _told(rows: list[tuple[str, ...]]) -> tuple[int, int, int]:
    """Return how well a separator tells cells apart: by header words, by rows of one width."""
    widths = Counter(len(row) for row in rows if len(row) > 1)
    words = grid.recognised(rows)
    return max(words, 1), max(widths.values(), default=0), words


def _decoded(file: str, data: bytes) -> str:
    """Return the text: UTF-8 if it can be, else Cyrillic of Windows or DOS, or Western Windows; none has a NUL."""
    if data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        encodings: tuple[str, ...] = ("utf-16",)
    else:
        other = "cp866" if _is_of_dos(data) else "cp1252" if _is_western(data) else "cp1251"
        encodings = "utf-8-sig", other, "cp1251"
    for encoding in encodings:
        try:
            text = data.decode(encoding)
        except UnicodeDecodeError:
            continue
        if encoding == "cp866":  # which has no Ukrainian i: a Latin one stands there
            text = re.sub(r"i(?=[’'а-яєїґ])|(?<=[а-яєїґ])i", "і", re.sub(r"I(?=[’'А-яЄЇєї])|(?<=[А-ЯЄЇ])I", "І", text))
        if "\0" not in text:
            return text
    raise InputError("answers-encoding", file=quote(file, SHOWN))


def _is_of_dos(data: bytes) -> bool:
    """Whether a text is in Cyrillic of DOS, as Excel's CSV (MS-DOS) is: most letters are where Windows has signs.

    >>> _is_of_dos("Мельник;група".encode("cp866")), _is_of_dos("Мельник;група".encode("cp1251"))
    (True, False)
    >>> _is_of_dos("O’Neil;–5;–6 m/s²".encode("cp1252"))
    False
    """
    signs, letters = (len(re.findall(one, data)) for one in (rb"[\x80-\xaf]", rb"[\xb0-\xff]"))
    return signs > letters and bool(re.search(rb"[\x80-\xaf\xe0-\xef]{4}", data))


def _is_western(data: bytes) -> bool:
    """Whether a text of Windows is none in Cyrillic: read so, more of its words have letters of both scripts.

    >>> _is_western("Müller;m/s²".encode("cp1252")), _is_western("Мельник;V_А".encode("cp1251"))
    (True, False)
    """
    words = re.findall(r"[^\W\d_]{2,}", data.decode("cp1251", "replace"))
    scripts = Counter((bool(re.search("[A-Za-z]", word)), not word.isascii()) for word in words)
    return scripts[True, True] > scripts[False, True]


def _rows(file: str, text: str, separator: str) -> list[tuple[str, ...]]:
    """Cut a text into cells."""
    rows: list[tuple[str, ...]] = []
    cells = 0
    try:
        for row in csv.reader(io.StringIO(text, newline=""), delimiter=separator):
            cells += len(row)
            if cells > grid.MOST_CELLS or len(rows) > 2 * grid.MOST_ROWS:
                places = len(row) > grid.MOST_COLUMNS or len(rows) > grid.MOST_ROWS
                raise grid.too_many_cells(file) if places else grid.too_many_texts(file)
            long = next((at for at, cell in enumerate(row) if len(cell) > grid.LONGEST), None)
            if long is not None:
                raise grid.too_long(file, len(rows), long)
            rows.append(tuple(map(_csv_cell, row)))
    except csv.Error:
        raise InputError("answers-quotes", file=quote(file, SHOWN), row=len(rows) + 1) from None
    return rows


def _csv_cell(text: str) -> str:
    """Return a cell without the spaces round it, and without the apostrophe that keeps a text from being a formula."""
    text = text.strip()
    return text[1:] if text.startswith("'") and text[1:2] in {"=", "+", "-", "@", "'"} else text


class _BrokenError(Exception):
    """The file is not what it should be."""


def _grid_of_xlsx(file: str, data: bytes) -> grid.Grid:
    """Return the cells of the first sheet; a file with a password, or with more than is allowed, is refused."""
    if data.count(b"PK\x01\x02") > MOST_PARTS:
        raise _bomb(file)
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive, warnings.catch_warnings():
            warnings.simplefilter("ignore")
            parts = _Parts(archive, file)
            (_, first), more, others = _related(parts)
            sheet = _Sheet(parts, _texts(parts, others.get("sharedStrings")), _dates(parts, others.get("styles")))
            sheet.read(first)
            sheets = tuple(name for name, part in more[:MOST_SHEETS] if parts.holds(part))
    except InputError:
        raise
    except (  # whatever an archive, a parser, or openpyxl does not like
        _BrokenError, zipfile.BadZipFile, ElementTree.ParseError, zlib.error, LookupError, EOFError,
        RuntimeError, NotImplementedError, OSError, ValueError, TypeError, ArithmeticError,
    ) as problem:  # fmt: skip
        raise InputError("answers-not-xlsx", file=quote(file, SHOWN)) from problem
    merged = grid.by_row(sheet.merged, len(sheet.rows))
    rows = grid.bounded(file, list(map(tuple, sheet.rows)))
    return grid.Grid(file, rows, frozenset(sheet.formulas), frozenset(sheet.days), merged, sheets)


def _bomb(file: str) -> InputError:
    return InputError("answers-bomb", file=quote(file, SHOWN), n=grid.LARGEST // 1_000_000, ratio=RATIO)


class _Parts:
    """The parts of a package, unpacked and looked through within bounds that they share."""

    def __init__(self, archive: zipfile.ZipFile, file: str) -> None:
        infos = archive.infolist()
        self.archive, self.file = archive, file
        self.bytes, self.tags, self.cells = grid.LARGEST, MOST_TAGS, grid.MOST_CELLS  # that are left
        if len({info.filename for info in infos}) < len(infos):  # programs do not agree on which of two is meant
            raise _BrokenError

    def spend(self, cells: int) -> None:
        """Count cells, or what takes as long."""
        self.cells -= cells
        if self.cells < 0:
            raise grid.too_many_texts(self.file)

    def read(self, name: str) -> bytes:
        """Unpack a part as far as it may be; what is said of its size is not relied on."""
        info = self.archive.getinfo(name)
        if info.flag_bits & 1 or info.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
            raise _BrokenError
        most = min(self.bytes, max(FREE, RATIO * info.compress_size))
        with self.archive.open(info) as stream:
            data = stream.read(most + 1)
        self.bytes -= len(data)
        self.tags -= data.count(b"<")
        if len(data) > most:
            raise _bomb(self.file)
        if self.tags < 0:
            raise grid.too_many_texts(self.file)
        if _REFUSED.search(data) or _LONG.search(data):
            raise _BrokenError
        return data.replace(_STRICT, _MAIN)

    def holds(self, name: str) -> bool:
        """Whether a worksheet that is not read has a value near its beginning."""
        with (
            suppress(KeyError, zipfile.BadZipFile, zlib.error, OSError, RuntimeError),
            self.archive.open(name) as stream,
        ):
            return _VALUE.search(stream.read(LOOKED_AT)) is not None
        return False

    def walk(self, name: str) -> Iterator[tuple[int, str, str, Any, bool]]:
        """Go through a part: depth of each element down to cells, part of the root, tag, and whether it has ended."""
        section, depth = "", 0
        above: list[Any] = []
        data = self.read(name)
        parser: Any = ElementTree.XMLPullParser(("start", "end"))
        for at in range(0, len(data) + STEP, STEP):
            parser.feed(data[at : at + STEP])
            if at >= len(data):
                parser.close()
            for event, element in parser.read_events():
                if event == "end":
                    if depth < 5:
                        yield depth, section, element.tag.rpartition("}")[2], element, True
                    depth -= 1
                    if depth == 1 or (depth == 2 and section == "sheetData"):
                        above[depth - 1].clear()  # what has been looked at is forgotten, row by row
                    continue
                depth += 1
                if depth < 5:
                    above[depth - 1 :] = [element]
                    tag = element.tag.rpartition("}")[2]
                    section = tag if depth == 2 else section
                    yield depth, section, tag, element, False
                elif depth > 5 and section == "sheetData":
                    self.spend(TEXT)
                if depth > DEEPEST:
                    raise _BrokenError


def _related(parts: _Parts) -> tuple[tuple[str, str], list[tuple[str, str]], dict[str, str]]:
    """Return name and part of the first sheet of the workbook, those of others, and its texts and formats by kind."""
    ids: dict[str, str] = {}
    targets: dict[str, tuple[str, str]] = {}
    for _, _, tag, element, ended in parts.walk("xl/workbook.xml"):
        if tag == "sheet" and not ended:
            named = element.get("name", "") if element.get("state", "visible") == "visible" else ""
            ids |= {value: named for key, value in element.attrib.items() if key.endswith("}id")}
    for _, _, tag, element, ended in parts.walk("xl/_rels/workbook.xml.rels"):
        if tag == "Relationship" and not ended:
            target = element.attrib["Target"]
            whole = target.lstrip("/") if target.startswith("/") else posixpath.normpath(f"xl/{target}")
            targets[element.attrib["Id"]] = element.get("Type", "").rpartition("/")[2], whole
    sheets = [(name, targets[id][1]) for id, name in ids.items() if id in targets and targets[id][0] == "worksheet"]
    if not sheets:
        raise _BrokenError
    return sheets[0], [one for one in sheets[1:] if one[0]], dict(targets.values())


def _texts(parts: _Parts, name: str | None) -> list[str]:
    """Return the texts that cells refer to by number, without the readings that Asian texts have."""
    texts: list[str] = []
    for depth, _, tag, element, ended in parts.walk(name) if name is not None else ():
        if (depth, tag) != (2, "si"):
            continue
        if not ended:
            parts.spend(TEXT)
        else:
            pieces = (piece for own in element for piece in ([own] if own.tag.endswith("}t") else own)
                      if not own.tag.endswith("}rPh"))  # fmt: skip
            texts.append("".join(piece.text or "" for piece in pieces if piece.tag.endswith("}t")))
    return texts


def _dates(parts: _Parts, name: str | None) -> set[int]:
    """Return the looks of cells, by number, in which a number is shown as a date or a time."""
    from openpyxl.styles.numbers import BUILTIN_FORMATS, is_date_format

    own: list[tuple[int, str]] = []
    looks: list[int] = []
    for depth, section, tag, element, ended in parts.walk(name) if name is not None else ():
        if depth != 3 or ended:
            continue
        if (section, tag) == ("numFmts", "numFmt"):
            code = element.attrib["formatCode"]
            if len(own) == MOST_FORMATS or len(code) > LONGEST_FORMAT or code.count("[") > MOST_BRACKETS:
                raise _BrokenError
            own.append((int(element.attrib["numFmtId"]), code))
        elif (section, tag) == ("cellXfs", "xf"):
            parts.spend(LOOK)
            looks.append(int(element.get("numFmtId", "0")))
    codes = {**BUILTIN_FORMATS, **dict(own)}
    known = {number: is_date_format(codes.get(number, "")) for number in {*looks}}
    return {look for look, number in enumerate(looks) if known[number]}


class _Sheet:
    """The rows of a sheet, with the cells whose formula nobody has worked out, those with dates, and merged ranges."""

    def __init__(self, parts: _Parts, texts: Sequence[str], dates: set[int]) -> None:
        from openpyxl.worksheet._reader import WorkSheetParser

        self.parts, self.dates = parts, dates
        self.rows: list[list[str]] = []
        self.formulas: set[Cell] = set()
        self.days: set[Cell] = set()
        self.merged: list[tuple[Cell, Cell]] = []
        self._parser: Any = WorkSheetParser(None, texts, data_only=True)
        self._row, self._letters = 0, 0

    def read(self, name: str) -> None:
        """Read a part; the other parts of a sheet than rows and merged ranges are passed over."""
        from openpyxl.utils.cell import column_index_from_string

        sheets = 0
        for depth, section, tag, element, ended in self.parts.walk(name):
            if section != "sheetData":
                merged = _RANGE.fullmatch(element.get("ref", "")) if tag == "mergeCell" and not ended else None
                if merged is not None and len(self.merged) < grid.MOST_ROWS:
                    ends = [(int(merged[at + 1]) - 1, column_index_from_string(merged[at]) - 1) for at in (1, 3)]
                    self.merged.append((ends[0], ends[1]))
            elif ended:
                if depth == 3:
                    self._take(element)
            elif depth == 4:
                self.parts.spend(1)
                if tag != "c":
                    raise _BrokenError
            elif depth == 3:
                self._begin(tag, element.get("r", ""))
            elif depth == 2:
                sheets += 1
        if sheets != 1:
            raise _BrokenError

    def _begin(self, tag: str, number: str) -> None:
        """Go on to the next row; those that are left out take a little time, too."""
        if tag != "row" or (number and not _PLACE.fullmatch(number)):
            raise _BrokenError
        row = int(number) if number else self._row + 1
        if row <= self._row:
            raise _BrokenError
        self.parts.spend(1 + (row - self._row) // BLANKS)
        self._row = row

    def _take(self, element: ElementTree.Element) -> None:
        """Take a whole row: refuse a cell that is too long or stands too far away, or that is not in its place."""
        parts, parser, line, last = self.parts, self._parser, list[str](), 0
        parser.row_counter, parser.col_counter = self._row, 0
        for child in element:
            tags = [own.tag.rpartition("}")[2] for own in child]
            value = child[tags.index("v")].text or "" if "v" in tags else ""
            if tags != ["v"] and (len({*tags}) < len(tags) or not {*tags} <= {"v", "f", "is"}):
                raise _BrokenError
            if value and child.get("t") == "s" and not _PLACE.fullmatch(value):
                raise _BrokenError
            cell = parser.parse_cell(child)
            column, held, at = cell["column"], cell["value"], (self._row - 1, cell["column"] - 1)
            if cell["row"] != self._row or column <= last:
                raise _BrokenError
            if column - last > BLANKS:
                parts.spend((column - last) // BLANKS)
            last = column
            if held in (None, "") and "f" in tags:
                self.formulas.add(at)
                held = "="
            number = isinstance(held, int | float)
            if (number and cell["style_id"] in self.dates) or (not number and isinstance(held, TIMES)):
                self.days.add(at)
            length = len(held) if isinstance(held, str) else len(value)
            self._letters += length
            if length > grid.LONGEST:
                raise grid.too_long(parts.file, *at)
            if self._letters > grid.MOST_LETTERS:
                raise grid.too_many_texts(parts.file)
            if held is not None and (text := _shown(held, at in self.days)):
                if self._row > grid.MOST_ROWS or column > grid.MOST_COLUMNS:
                    raise grid.too_many_cells(parts.file)  # blank ones, such as are only coloured, do no harm
                line.extend([""] * (column - 1 - len(line)))
                line.append(text)
        if line:
            self.rows += ([] for _ in range(self._row - 1 - len(self.rows)))
            self.rows.append(line)


def _shown(value: Any, day: bool) -> str:
    """Return what a cell holds as a text: numbers as they are written shortest, dates as the numbers they are."""
    if isinstance(value, str):
        return _ESCAPED.sub(lambda found: chr(int(found[1], 16)), value).strip()
    if isinstance(value, TIMES):
        from openpyxl.utils.datetime import to_excel

        value = to_excel(value)
    if day:
        value = round(value, 9)
    if isinstance(value, float) and value.is_integer() and abs(value) < EXACT:
        return str(int(value))
    return str(int(value)) if isinstance(value, bool) else str(value)
