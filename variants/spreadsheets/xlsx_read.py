"""XLSX read by openpyxl, behind bounds: the first sheet's texts, numbers and worked-out results, no formula evaluated.

openpyxl reads all shared texts and formats before the first row, makes as many rows as a file claims, and fails at
looks that it does not know. So everything that is read goes through one pass before: unpacked as far as it may be, XML
without declarations, rows and cells in order at their places. What openpyxl is given is a workbook of one sheet: its
rows as they stand in the file, the texts without looks, the formats of numbers.
"""

from __future__ import annotations

import io
import posixpath
import re
import warnings
import zipfile
import zlib
from collections.abc import Callable, Sequence
from datetime import date, time, timedelta
from functools import cache, reduce
from itertools import islice
from typing import Any
from xml.parsers import expat
from xml.sax.saxutils import escape, quoteattr

from ...scales.errors import InputError
from ...scales.numbers import SHOWN, quote
from . import grid

MOST_PARTS = 2_000
RATIO, FREE = 250, 1_000_000  # times its size that a part may unpack into, from so many bytes on
DEEPEST, LONGEST_TAG, STEP = 50, 200_000, 65_536  # elements in one another; bytes of a tag, and parsed at a time
MOST_TAGS = 1_300_000  # in all: a class of 1000 with 259 numbers each has 1,040,000
TEXT, LOOK = 3, 8  # cells that a text, or a look of a cell, counts for: so much longer openpyxl takes for it
BLANKS = 50  # rows or cells left out that count for one
EXACT = 1e15  # whole numbers below are written as such
TIMES = (date, time, timedelta)
MOST_FORMATS, LONGEST_FORMAT, MOST_BRACKETS = 1_000, 255, 10  # of numbers, made in the file; programs make 250
_MAIN = "http://schemas.openxmlformats.org/spreadsheetml/2006/main"
_STRICT = "http://purl.oclc.org/ooxml/spreadsheetml/main"
_OFFICE = "http://schemas.openxmlformats.org/officeDocument/2006/relationships"
_PACKAGE = "http://schemas.openxmlformats.org/package/2006"
_TYPE = "application/vnd.openxmlformats-officedocument.spreadsheetml"
_ESCAPED = re.compile("_x((?!D[89A-Fa-f])[0-9A-Fa-f]{4})_", re.IGNORECASE)
_RANGE = re.compile("([A-Z]{1,3})([0-9]{1,7}):([A-Z]{1,3})([0-9]{1,7})")
_LETTERS = re.compile("[A-Z]{1,3}")
_PLACE = re.compile("[0-9]{1,7}")  # of a text among those that are shared


class _BrokenError(Exception):
    """The file is not what it should be."""


def grid_of_xlsx(file: str, data: bytes) -> grid.Grid:
    """Return the cells of the first sheet; a file with a password, or with more than is allowed, is refused."""
    shown = quote(file, SHOWN)
    if data.count(b"PK\x01\x02") > MOST_PARTS:
        raise _bomb(file)
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            parts = _Parts(archive, file)
            first, others = _related(parts)
            texts = _texts(parts, others.get("sharedStrings"))
            formats = _formats(parts, others.get("styles"))
            sheet = _Sheet(texts, parts)
            rows = sheet.walk(first)
    except (_BrokenError, zipfile.BadZipFile, expat.ExpatError, zlib.error, LookupError, EOFError):
        raise InputError("answers-not-xlsx", file=shown) from None
    except (RuntimeError, NotImplementedError, OSError, ValueError, OverflowError) as problem:
        if isinstance(problem, InputError):
            raise
        raise InputError("answers-not-xlsx", file=shown) from None
    return _grid(file, sheet, _packed(rows, texts, formats))


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
        return data

    def parse(self, data: bytes, parser: Any) -> None:
        """Give XML to a parser, piece by piece."""
        parser.buffer_text = True
        parser.StartDoctypeDeclHandler = _refuse_doctype
        for at in range(0, len(data), STEP):
            parser.Parse(data[at : at + STEP], False)
            if at + STEP - parser.CurrentByteIndex > LONGEST_TAG:  # it would be gone through again and again
                raise _BrokenError
        parser.Parse(b"", True)

    def walk(
        self,
        name: str,
        start: Callable[[list[str], dict[str, str]], None],
        text: Callable[[list[str], str], None] | None = None,
    ) -> None:
        """Go through a small part; `start` and `text` are told in which elements one is."""
        parser: Any = expat.ParserCreate()
        path: list[str] = []

        def begin(tag: str, given: dict[str, str]) -> None:
            path.append(_local(tag))
            if len(path) > DEEPEST:
                raise _BrokenError
            start(path, given)

        def take(piece: str) -> None:
            if text is not None:
                text(path, piece)

        parser.StartElementHandler, parser.EndElementHandler = begin, lambda _: path.pop()
        parser.CharacterDataHandler = take
        self.parse(self.read(name), parser)


def _local(tag: str) -> str:
    """Return a tag without its namespace."""
    return tag.rpartition(":")[2] if ":" in tag else tag


def _refuse_doctype(*_: object) -> None:
    raise _BrokenError


def _related(parts: _Parts) -> tuple[str, dict[str, str]]:
    """Return the parts that hold the first sheet of the workbook, and its texts and formats by kind."""
    ids: list[str] = []
    targets: dict[str, tuple[str, str]] = {}

    def sheet(path: list[str], given: dict[str, str]) -> None:
        if path[-1] == "sheet":
            ids.extend(value for key, value in given.items() if key.rpartition(":")[2] == "id" and ":" in key)

    def relation(path: list[str], given: dict[str, str]) -> None:
        if path[-1] == "Relationship":
            targets[given["Id"]] = (given.get("Type", "").rpartition("/")[2], given["Target"])

    parts.walk("xl/workbook.xml", sheet)
    parts.walk("xl/_rels/workbook.xml.rels", relation)
    found = next((targets[name][1] for name in ids if targets[name][0] == "worksheet"), None)
    if found is None:
        raise _BrokenError
    return _part(found), {kind: _part(target) for kind, target in targets.values()}


def _part(target: str) -> str:
    """Return the name of a part that the workbook names."""
    return target.lstrip("/") if target.startswith("/") else posixpath.normpath(f"xl/{target}")


def _texts(parts: _Parts, name: str | None) -> list[str]:
    """Return the texts that cells refer to by number, without the readings that Asian texts have."""
    found: list[list[str]] = []

    def start(path: list[str], given: dict[str, str]) -> None:
        if path[1:] == ["si"]:
            parts.spend(TEXT)
            found.append([])

    def text(path: list[str], piece: str) -> None:
        if path[1:2] == ["si"] and path[-1] == "t" and "rPh" not in path:
            found[-1].append(piece)

    if name is not None:
        parts.walk(name, start, text)
    return ["".join(pieces) for pieces in found]


def _formats(parts: _Parts, name: str | None) -> str:
    """Return the formats of numbers, and which of them each look of a cell has, as openpyxl reads them."""
    own: list[str] = []
    looks: list[str] = []

    def start(path: list[str], given: dict[str, str]) -> None:
        if path[1:] == ["numFmts", "numFmt"]:
            code, number = given["formatCode"], int(given["numFmtId"])
            if len(own) == MOST_FORMATS or len(code) > LONGEST_FORMAT or code.count("[") > MOST_BRACKETS:
                raise _BrokenError
            own.append(f'<numFmt numFmtId="{number}" formatCode={quoteattr(code)}/>')
        elif path[1:] == ["cellXfs", "xf"]:
            parts.spend(LOOK)
            looks.append(f'<xf numFmtId="{int(given.get("numFmtId", "0"))}"/>')

    if name is not None:
        parts.walk(name, start)
    return f"<numFmts>{''.join(own)}</numFmts><cellXfs>{''.join(looks) or '<xf/>'}</cellXfs>"


@cache
def _column(name: str) -> int:
    """Return the number of a column, counted from 0, by its letters."""
    if not _LETTERS.fullmatch(name):
        raise _BrokenError
    return reduce(lambda number, letter: 26 * number + ord(letter) - ord("A") + 1, name, 0) - 1


class _Sheet:
    """What is found out of the rows of a sheet before openpyxl reads them.

    `formulas` are cells with a formula that nobody has worked out; `merged` the first and last of those that are one.
    """

    def __init__(self, texts: Sequence[str], parts: _Parts) -> None:
        self.texts, self.parts = texts, parts
        self.formulas: set[tuple[int, int]] = set()
        self.merged: list[tuple[tuple[int, int], tuple[int, int]]] = []
        self._parser: Any = expat.ParserCreate()
        self._marks: dict[str, int] = {}  # where in the part what begins
        self._depth, self._part, self._inner = 0, "", ""
        self._row, self._number, self._column, self._letters = -1, "", -1, 0
        self._kind, self._has, self._pieces = "n", "", list[str]()

    def walk(self, name: str) -> bytes:
        """Look through a part; return its rows as they stand there, with the root round them."""
        data, marks, parser = self.parts.read(name), self._marks, self._parser
        parser.StartElementHandler, parser.EndElementHandler = self._start, self._end
        parser.CharacterDataHandler = self._text
        self.parts.parse(data, parser)
        if "sheetData" not in marks:
            raise _BrokenError
        rows = data[marks["sheetData"] : data.index(b">", marks["end of rows"]) + 1]
        size = f'<dimension xmlns="{_MAIN}" ref="A1"/>'.encode()  # so that openpyxl does not look for it
        whole = data[: marks["first"]] + size + rows + data[data.rindex(b"</") :]
        return whole.replace(_STRICT.encode(), _MAIN.encode())

    def _start(self, tag: str, given: dict[str, str]) -> None:
        """Begin a row, a cell, or what is in it; the other parts of a sheet are passed over."""
        self._depth = depth = self._depth + 1
        tag = _local(tag)
        if depth < 3 or self._part != "sheetData":
            self._around(tag, given)
        elif (tag == "row") != (depth == 3) or (tag == "c") != (depth == 4) or depth > DEEPEST:
            raise _BrokenError
        elif depth == 4:
            address = given.get("r", "")
            if address and not address.endswith(self._number):
                raise _BrokenError
            column = _column(address[: -len(self._number)]) if address else self._column + 1
            self._pass(column - self._column)
            self._column, self._kind, self._has, self._pieces = column, given.get("t", "n"), "", []
        elif depth == 3:
            row = int(given["r"]) - 1 if "r" in given else self._row + 1
            self._pass(row - self._row)
            self._row, self._number, self._column = row, str(row + 1), -1
        else:
            self._begin(tag)

    def _begin(self, tag: str) -> None:
        """Begin what is in a cell: its value, its formula, or a text of its own, each once."""
        if self._depth > 5:
            self.parts.spend(TEXT)
        elif tag not in ("v", "f", "is") or tag in self._has:
            raise _BrokenError
        else:
            self._has += tag
        if tag != "t" or self._inner != "rPh":
            self._inner = tag

    def _around(self, tag: str, given: dict[str, str]) -> None:
        """Note where the rows begin, and which cells are one."""
        if self._depth == 2:
            if tag == "sheetData" and tag in self._marks:
                raise _BrokenError
            self._part, at = tag, self._parser.CurrentByteIndex
            self._marks.setdefault("first", at)
            self._marks[tag] = at
        elif self._depth > DEEPEST:
            raise _BrokenError
        elif (
            tag == "mergeCell"
            and len(self.merged) < grid.MOST_ROWS
            and (found := _RANGE.fullmatch(given.get("ref", "")))
        ):
            first, last = ((int(found[at + 1]) - 1, _column(found[at])) for at in (1, 3))
            self.merged.append((first, last))

    def _pass(self, places: int) -> None:
        """Go on to the next row or cell; those that are left out take a little time, too."""
        if places < 1:
            raise _BrokenError
        self.parts.spend(1 + places // BLANKS)

    def _text(self, piece: str) -> None:
        """Take a piece of what a cell shows."""
        if self._inner in ("v", "t"):
            self._pieces.append(piece)

    def _end(self, _: str) -> None:
        """Note where the rows end; look at a whole cell."""
        self._depth = depth = self._depth - 1
        if depth == 3 and self._part == "sheetData":
            self._look("".join(self._pieces))
        elif depth == 1 and self._part == "sheetData":
            self._marks["end of rows"] = self._parser.CurrentByteIndex
            self._part = ""
        elif self._inner != "rPh" or depth < 6:
            self._inner = ""

    def _look(self, text: str) -> None:
        """Refuse a cell that is too long, that stands too far away, or that refers to no text; note a formula."""
        at, file = (self._row, self._column), self.parts.file
        if self._kind == "s" and text:
            if not _PLACE.fullmatch(text) or int(text) >= len(self.texts):
                raise _BrokenError
            text = self.texts[int(text)]
        if "f" in self._has and not text:
            self.formulas.add(at)
            text = "="
        self._letters += len(text)
        if len(text) > grid.LONGEST:
            raise grid.too_long(file, *at)
        if self._letters > grid.MOST_LETTERS:
            raise grid.too_many_texts(file)
        if (self._row >= grid.MOST_ROWS or self._column >= grid.MOST_COLUMNS) and text.strip():
            raise grid.too_many_cells(file)  # blank ones, such as are only coloured, do no harm


def _packed(rows: bytes, texts: Sequence[str], formats: str) -> io.BytesIO:
    """Return a workbook of one sheet, as little of it as openpyxl needs."""
    kinds = {"worksheet": "sheet1", "styles": "styles", "sharedStrings": "sharedStrings"}
    types = "".join(f'<Override PartName="/xl/{kinds[kind]}.xml" ContentType="{_TYPE}.{kind}+xml"/>' for kind in kinds)
    main = f'<Override PartName="/xl/workbook.xml" ContentType="{_TYPE}.sheet.main+xml"/>'
    related = f'<Relationship Id="rId1" Type="{_OFFICE}/worksheet" Target="sheet1.xml"/>'
    # openpyxl drops each "x005F_", which makes an underscore out of its number; then so does the reader of a cell
    plain = (escape(text.replace("x005F_", "x005Fx005F__"), {"\r": "&#13;"}) for text in texts)
    shared = "".join(f'<si><t xml:space="preserve">{text}</t></si>' for text in plain)
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w") as archive:
        archive.writestr("[Content_Types].xml", f'<Types xmlns="{_PACKAGE}/content-types">{main}{types}</Types>')
        sheets = '<sheets><sheet name="1" sheetId="1" r:id="rId1"/></sheets>'
        archive.writestr("xl/workbook.xml", f'<workbook xmlns="{_MAIN}" xmlns:r="{_OFFICE}">{sheets}</workbook>')
        relations = f'<Relationships xmlns="{_PACKAGE}/relationships">{related}</Relationships>'
        archive.writestr("xl/_rels/workbook.xml.rels", relations)
        archive.writestr("xl/styles.xml", f'<styleSheet xmlns="{_MAIN}">{formats}</styleSheet>')
        archive.writestr("xl/sharedStrings.xml", f'<sst xmlns="{_MAIN}">{shared}</sst>')
        archive.writestr("xl/sheet1.xml", rows)
    return stream


def _grid(file: str, sheet: _Sheet, packed: io.BytesIO) -> grid.Grid:
    """Read the rows of a workbook of one sheet by openpyxl; what it says of looks does not matter here."""
    from openpyxl import load_workbook

    rows: list[list[str]] = []
    dates: set[tuple[int, int]] = set()
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            [only] = load_workbook(packed, read_only=True, data_only=True).worksheets
            only.reset_dimensions()
            for number, values in enumerate(islice(only.iter_rows(values_only=True), grid.MOST_ROWS)):
                dates.update((number, column) for column, value in enumerate(values) if isinstance(value, TIMES))
                cells = [_shown(value) for value in values]
                while cells and not cells[-1]:
                    cells.pop()
                rows.append(cells)
    except Exception as problem:  # whatever it does not like of a number or a kind of cell
        raise InputError("answers-not-xlsx", file=quote(file, SHOWN)) from problem
    for row, column in sheet.formulas:
        rows[row] += [""] * (column + 1 - len(rows[row]))
        rows[row][column] = "="
    formulas, merged = frozenset(sheet.formulas), grid.by_row(sheet.merged, len(rows))
    return grid.Grid(file, grid.bounded(file, list(map(tuple, rows))), formulas, frozenset(dates), merged)


def _shown(value: Any) -> str:
    """Return what a cell holds as a text: numbers as they are written shortest, dates as the numbers they are."""
    if value is None:
        return ""
    if isinstance(value, str):
        return _ESCAPED.sub(lambda found: chr(int(found[1], 16)), value).strip()
    if isinstance(value, TIMES):
        from openpyxl.utils.datetime import to_excel

        value = round(to_excel(value), 9)
    if isinstance(value, float) and value.is_integer() and abs(value) < EXACT:
        return str(int(value))
    return str(int(value)) if isinstance(value, bool) else str(value)
