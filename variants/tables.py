"""Rows of cells as aligned text, CSV or XLSX, in which nothing is taken for a formula; data as JSON takes them."""

from __future__ import annotations

import csv
import io
import json
import math
import os
import re
from abc import ABC, abstractmethod
from base64 import b64encode
from collections.abc import Callable, Collection, Container, Iterable, Iterator, Mapping, Sequence
from contextvars import ContextVar
from dataclasses import dataclass, field
from datetime import datetime
from functools import cache
from html import escape
from importlib import import_module
from itertools import groupby
from pathlib import Path
from textwrap import wrap
from typing import TYPE_CHECKING, Any, ClassVar, TypeAlias, cast

from ..drawing.writers import WRITERS, Files, save_all
from ..scales.errors import InputError, KeptError
from ..scales.names import of_kind, unknown
from ..scales.numbers import SHOWN, quote

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..drawing.words import Words
    from ..plans.linkages.cycle import Cycle
    from ..plans.solved import Columned
    from ..scales.errors import PositionError
    from ..scales.series import Series
    from .case import Case
    from .task import Task

    Array = NDArray[Any]
Cell: TypeAlias = str | float | int | None
Rows: TypeAlias = Sequence[Sequence[Cell]]
DANGEROUS = tuple("=+-@|%\t\r\n＝＋－＠")  # with which programs begin a formula or a command
# the same behind what another program, or one of another country, takes for the end of a cell; -5 mm is no formula
_INSIDE = re.compile(r"([,;\t\r\n][^\S\t\r\n]*+)(?=[=@|%＝＠]|[-+－＋][^,;\t\r\n]*[(|!=@])")
_CREATED = datetime(2000, 1, 1)
_WIDEST, _PIXELS, _LINE = 45, 7, 15  # characters of a column, how wide each is, and points that a line is high
_PORTRAIT, _LANDSCAPE, _SCREEN = 120, 220, 180  # characters that pages, printed small, and a screen are wide
_A4, _MARGIN = 9, 0.4  # the number of that paper, inches
_SMALLEST, _HANDY = 65, 25  # per cent at which 11 points are 7; points of a row that a hand fills there
MANY = 5_000  # rows from which on writing them takes seconds
# who is told how much more of a long table is written, and of how much
watching: ContextVar[Callable[[int, int], None] | None] = ContextVar("watching", default=None)
COPIES_ON_WRITE = 3  # the version of pandas from which on a frame that shares its arrays copies what is changed
LONGEST = 32_000  # characters of a cell: programs take 32,767


class Saved(ABC):
    """What can be written to files."""

    __slots__ = ()
    suffixes: ClassVar[tuple[str, ...]]

    def save(self, *paths: str | os.PathLike[str]) -> list[Path]:
        """Write it to each of `paths`; the suffix says how.

        Returns
        -------
        list of Path
            The files written.

        Raises
        ------
        InputError
            A kind of file that is not written, two outputs of one name, a missing extra, a file that cannot be
            written, or one that people have filled in or saved (`KeptError`): then none is.
        """
        from .spreadsheets.files import keep_filled_in

        drawn = cache(self.drawn)  # once for all files, and only where one of them shows it

        def made(path: Path) -> Files:
            keep_filled_in(path)
            return self._files(path, drawn)

        return save_all(paths, self.suffixes, made)

    def drawn(self) -> Any:
        """Draw what pictures show, if there are any."""
        return None

    @abstractmethod
    def _files(self, path: Path, drawn: Callable[[], Any]) -> Files:
        """Return the files that a path stands for."""


@dataclass(frozen=True, slots=True, eq=False)
class Table:
    """Rows of cells under their columns, as files of every kind have them.

    Where it is `exact` numbers of CSV are in full precision, else as people want to see them.
    """

    columns: tuple[str, ...]
    rows: Sequence[Sequence[Cell]]
    language: str
    title: str = ""
    exact: bool = True

    def csv(self) -> str:
        """Return it as CSV: for `uk` and `ru` with `;` and decimal commas, for `en` with `,` and points."""
        return _csv_text((self.columns, *self.rows), self.language, number=exact if self.exact else _rounded)

    def html(self) -> str:
        """Return it as a page for a browser."""
        cells = (
            (escape(_text(cell, self.language != "en", _rounded)) for cell in row) for row in (self.columns, *self.rows)
        )
        rows = "\n".join(f"<tr>{''.join(f'<td>{text}</td>' for text in row)}</tr>" for row in cells)
        head = f'<html lang="{self.language}"><meta charset="utf-8"><title>{escape(self.title)}</title>'
        return f"<!DOCTYPE html>\n{head}\n<table>\n{rows}\n</table></html>\n"

    def small(self, most: int = 24) -> str:
        """Return it as a table of a notebook: of many rows the first and the last ones."""
        cut = max(0, len(self.rows) - most)
        rows = [*self.rows[: most // 2], ["…"], *self.rows[-most // 2 :]] if cut else self.rows

        def shown(cell: Cell) -> str:
            return cell if isinstance(cell, str) else _text(cell, self.language != "en", "{:.6g}".format)

        return html_table([self.columns, *([*map(shown, row)] for row in rows)])

    def file(self, suffix: str) -> bytes:
        """Return what a file holds, of one of `FILES` but JSON."""
        match suffix.lower():
            case ".xlsx":
                return _xlsx_bytes((self.columns, *self.rows), self.title, (0,), 1)
            case ".html":
                return self.html().encode("utf-8", "replace")
        return _csv_encoded(self.csv(), self.exact and self.language == "en")


FILES: tuple[str, ...] = (".csv", ".xlsx", ".json", ".html")  # of every result


def json_text(data: Mapping[str, Any]) -> str:
    """Return one JSON object in ASCII, which every console and pipe lets through."""
    return json.dumps(data, ensure_ascii=True, allow_nan=False, indent=2)


def _pandas() -> Any:
    """Return the user's own pandas, if there is one."""
    try:
        return import_module("pandas")
    except ImportError:
        raise InputError("pandas-missing") from None


class Result(Saved):
    """What a command has found; `words` are those of its tables and files."""

    __slots__ = ()
    suffixes = FILES
    words: Words

    @abstractmethod
    def table(self, language: str | None = None) -> str:
        """Return it as lines of text."""

    @abstractmethod
    def data(self, language: str | None = None) -> Table:
        """Return all of it as rows under columns."""

    @abstractmethod
    def to_json(self) -> dict[str, Any]:
        """Return, as a dict, what is printed with `--json`: everything in SI; `save("x.json")` writes its text."""

    def to_dataframe(self) -> Any:
        """Return a pandas data frame of all rows, as they are in CSV.

        Raises InputError: pandas is not installed.
        """
        table = self.data()
        return _pandas().DataFrame([*map(list, table.rows)], columns=[*table.columns])

    @property
    def columns(self) -> tuple[str, ...]:
        """The heads of the columns."""
        return self.data().columns

    @property
    def rows(self) -> Sequence[Sequence[Cell]]:
        """The rows under them."""
        return self.data().rows

    def csv(self, language: str | None = None) -> str:
        """Return all rows as CSV: for `uk` and `ru` with `;` and decimal commas, for `en` with `,` and points."""
        return self.data(language).csv()

    def html(self, language: str | None = None) -> str:
        """Return all rows as a page for a browser."""
        return self.data(language).html()

    def _files(self, path: Path, drawn: Callable[[], Any]) -> Files:
        if path.suffix.lower() == ".json":
            return [(path, (json_text(self.to_json()) + "\n").encode("ascii"))]
        return [(path, self._file(path.suffix))]

    def _file(self, suffix: str) -> bytes:
        return self.data().file(suffix)

    def _repr_html_(self) -> str:
        """Show the table in a notebook."""
        return self.data().small()

    def _words(self, language: str | None) -> Words:
        return self.words if language is None else self.words.speaking(language)


@dataclass(frozen=True, slots=True)
class OfCase(Result):
    """What has been found of a case; `words` are those of its tables and files."""

    case: Case
    words: Words

    @property
    def task(self) -> Task:
        """The task."""
        return self.case.task

    @property
    def variant(self) -> str:
        """The variant."""
        return self.case.variant


@dataclass(frozen=True, slots=True)
class Arrays(OfCase):
    """What has been found of many states: a `Series` by the name of each quantity, in SI."""

    _frames: list[Any] = field(default_factory=list, init=False, repr=False, compare=False)  # of pandas, once asked for

    @abstractmethod
    def arrays(self, name: str = "") -> Iterable[Columned]:
        """Go through all columns in SI: of a vector its size, `.x` and `.y`; or find the one that is asked for."""

    @abstractmethod
    def _columns(self, words: Words) -> tuple[Sequence[Columned], Mapping[str, Sequence[str]]]:
        """Return the columns in the units in which they are shown, and what is said of each row."""

    @abstractmethod
    def _data(self) -> dict[str, Any]:
        """Return what has been found, for JSON: everything in SI."""

    @property
    @abstractmethod
    def statuses(self) -> Any:
        """The status of each state, an array of texts."""

    @property
    def status(self) -> str:
        """The status of all: `ok` where something moves."""
        return "ok"

    def __getitem__(self, name: str) -> Series:
        """Return the values of a quantity, `"V_B"`, of a part of it, `"V_B.x"`, or what is said of rows, `"status"`.

        Raises InputError: there is none of this name.
        """
        import numpy as np

        from ..scales.series import Series  # which needs numpy

        of_kind("name", name, (str,), "str")
        for column in self.arrays(name):
            if column.name == name:
                return Series(column.values, column.name, column.unit)
        said = self._columns(self.words)[1]
        if name in said:
            return Series(np.reshape(said[name], self.statuses.shape), name, "")
        if f"{name}.x" in self:
            raise InputError("quantity-point", text=quote(name))
        raise unknown("quantity-unknown", name, self)

    def __iter__(self) -> Iterator[str]:
        """Go through the names of all columns."""
        return (column.name for column in self.arrays())

    def __contains__(self, name: object) -> bool:
        """Tell whether `self[name]` are numbers."""
        return isinstance(name, str) and any(name == column.name for column in self.arrays(name))

    def _ipython_key_completions_(self) -> list[str]:
        """Return what a notebook offers behind `swept["`."""
        return list(self)

    def __len__(self) -> int:
        """Return the number of states, as a pandas data frame does."""
        return int(self.statuses.size)

    def to_dict(self) -> dict[str, Series]:
        """Return all columns by name, in SI."""
        from ..scales.series import Series

        return {column.name: Series(column.values, column.name, column.unit) for column in self.arrays()}

    def to_dataframe(self) -> Any:
        """Return a pandas data frame of all columns in SI, a row for each state, their units in `attrs["units"]`.

        What is said of each row, such as `status`, comes last. From pandas 3 on it shares what has been found, and
        pandas copies a column when it is first written into.

        Raises InputError: pandas is not installed.
        """
        import numpy as np

        pandas = _pandas()
        sharing = int(pandas.__version__.partition(".")[0]) >= COPIES_ON_WRITE
        if not (self._frames and sharing):
            columns = [*self.arrays()]
            arrays = {column.name: column.values.reshape(-1) for column in columns}
            writable = {name: array if array.flags.writeable else array.copy() for name, array in arrays.items()}
            said = {name: np.array(states) for name, states in self._columns(self.words)[1].items()}
            self._frames[:] = [pandas.DataFrame(writable | said, copy=not sharing)]
            self._frames[0].attrs["units"] = {column.name: column.unit for column in columns}
        # as long as the first one is kept, pandas knows that its arrays are not those of another one alone
        return self._frames[0].copy(deep=False) if sharing else self._frames.pop()

    def data(self, language: str | None = None) -> Table:
        """Return all columns, the number of the row before them, after them what is said of each row."""
        words = self._words(language)
        heads, values, states = self._headed(words)
        rows = tuple(zip(range(len(self)), *(column.tolist() for column in values), *states, strict=True))
        return Table(heads, rows, words.language, self.task.id)

    def _headed(self, words: Words) -> tuple[tuple[str, ...], list[Array], list[Sequence[str]]]:
        """Return the heads of all columns, with that of the rows' numbers, their values, and what is said of rows."""
        shown, states = self._columns(words)
        units = [words.spelled(column.unit) for column in shown]
        heads = (f"{column.name} [{of}]" if of else column.name for column, of in zip(shown, units, strict=True))
        return ("k", *heads, *states), [column.values.ravel() for column in shown], [*states.values()]

    def csv(self, language: str | None = None) -> str:
        """Return the same as CSV, put together column by column: without its rows half the time."""
        words = self._words(language)
        heads, values, states = self._headed(words)
        return _csv_of(heads, [range(len(self)), *values, *states], words.language != "en")

    def _file(self, suffix: str) -> bytes:
        if suffix.lower() == ".csv":
            return _csv_encoded(self.csv(), self.words.language == "en")
        return Result._file(self, suffix)

    def to_json(self) -> dict[str, Any]:
        """Return, as a dict, what is printed with `--json`: everything in SI; `save("x.json")` writes its text."""
        data = {"task": self.task.id, "variant": self.variant, "status": self.status} | self._data()
        return {name: plain(value) for name, value in data.items()}


@dataclass(frozen=True, slots=True)
class Swept(Arrays):
    """A variant of a task over its whole cycle; `swept["V_B"]` are the values over it, in SI."""

    suffixes = (*FILES, *WRITERS)

    @property
    def reason(self) -> PositionError | None:
        """Why no position at all can be assembled, or None."""
        return None

    @property
    def warnings(self) -> tuple[InputError, ...]:
        """What a user of its drawing should know."""
        return ()

    if TYPE_CHECKING:

        @property
        def cycle(self) -> Cycle:
            """The positions of a linkage; of anything else there are none, and an InputError says so."""


def html_table(rows: Sequence[Sequence[str]]) -> str:
    """Return rows, the first one the head, as a table in a notebook; a row of one cell goes over all columns."""
    aside, wide = ' style="text-align: left"', max(map(len, rows))
    lines = []
    for number, row in enumerate(rows):
        tag = "td" if number else "th"
        if len(row) == 1 < wide:
            lines.append(f'<tr><td colspan="{wide}"{aside}>{escape(row[0])}</td></tr>')
            continue
        cells = (f"<{tag}{'' if k else aside}>{escape(text)}</{tag}>" for k, text in enumerate(row))
        lines.append(f"<tr>{''.join(cells)}</tr>")
    table = f'<table style="text-align: right">{"".join(lines)}</table>'
    return f'<div style="max-width: 100%; overflow-x: auto">{table}</div>'  # a wide one is moved sideways, not cut off


def picture(svg: str | bytes, said: str = "") -> str:
    """Return SVG as a picture in a page, apart from all others: they may have fonts of one name."""
    data = b64encode(svg.encode("utf-8", "replace") if isinstance(svg, str) else svg).decode("ascii")
    return f'<img src="data:image/svg+xml;base64,{data}" alt="{escape(said)}" style="max-width: 100%">'


def ends_data(of: str, most: tuple[float, float], least: tuple[float, float]) -> dict[str, Any]:
    """Return the largest and the smallest value, each with its place, as data."""
    return {"unit": of} | {key: {"value": x, "at": at} for key, (x, at) in (("max", most), ("min", least))}


def aligned(rows: Sequence[Sequence[str]], left: Container[int] = (0,)) -> str:
    """Return rows as lines, the columns that `left` names to the left, the others to the right.

    A row may have fewer cells than others.
    """
    widths = [max(len(row[i]) for row in rows if i < len(row)) for i in range(max(map(len, rows)))]

    def cell(text: str, i: int) -> str:
        return f"{text:{widths[i]}}" if i in left else f"{text:>{widths[i]}}"

    return "\n".join("  ".join(cell(text, i) for i, text in enumerate(row)).rstrip() for row in rows)


def plain(data: Any) -> Any:
    """Return data, arrays among them, for JSON: None in the place of a number that is not finite, no zero below zero.

    >>> plain({"values": (1.0, -0.0, math.inf)})
    {'values': [1.0, 0.0, None]}
    """
    if isinstance(data, Mapping):
        return {key: plain(value) for key, value in data.items()}
    if isinstance(data, float):
        return float(data) + 0.0 if math.isfinite(data) else None
    if hasattr(data, "tolist"):
        data = data.tolist()
    if isinstance(data, list | tuple):
        return [x + 0.0 if type(x) is float and math.isfinite(x) else plain(x) for x in data]
    return data


def table_bytes(
    path: Path, rows: Rows, language: str, title: str, bold: Iterable[int], frozen: int, high: int = _LINE
) -> bytes:
    """Return rows as the kind of file that the suffix of `path` picks, those of a workbook so many points `high`."""
    return _xlsx_bytes(rows, title, bold, frozen, high) if path.suffix.lower() == ".xlsx" else csv_table(rows, language)


def save_form(
    file: str | os.PathLike[str],
    known: Collection[str],
    rows: Rows,
    language: str,
    title: str,
    bold: Iterable[int],
    frozen: int,
) -> Path:
    """Save rows to be filled in; a file of the name that holds anything else, as one that is filled in, stays."""

    def made(path: Path) -> Files:
        return fresh(path, table_bytes(path, rows, language, title, bold, frozen, _HANDY if frozen == 1 else _LINE))

    return save_all((file,), known, made)[0]


def fresh(path: Path, data: bytes) -> Files:
    """Return a file that people go on with; one of its name that holds anything else is theirs: an `InputError`."""
    if path.is_file() and path.read_bytes() != data:
        raise KeptError("output-exists", file=quote(path, SHOWN))
    return [(path, data)]


def csv_table(rows: Rows, language: str, separator: str | None = None) -> bytes:
    """Return rows as CSV that a spreadsheet of the language opens, names in it, too: with a byte order mark.

    With a `separator` of its own the file is for another program: decimal points.
    """
    return _csv_text(rows, language, separator, _rounded).encode("utf-8-sig", "replace")  # bytes in a name of a file


def _csv_text(
    rows: Iterable[Sequence[Cell]],
    language: str,
    separator: str | None = None,
    number: Callable[[float], str] | None = None,
) -> str:
    """Return rows as CSV: for `uk` and `ru` with `;` and decimal commas, with a `separator` decimal points.

    Numbers are in full precision where nothing else writes a `number`.
    """
    comma, told = separator is None and language != "en", number or exact
    head, *under = [tuple(row) for row in rows] or [()]
    if separator is None and told is exact and len(head) > 1 and {*map(len, under)} == {len(head)}:
        return _csv_of(head, [*zip(*under, strict=True)], comma)
    stream = io.StringIO(newline="")
    writer = csv.writer(stream, delimiter=separator or (";" if comma else ","), lineterminator="\r\n")
    writer.writerows([_text(cell, comma, told) for cell in row] for row in (head, *under))
    return stream.getvalue()


def _csv_encoded(text: str, plain: bool) -> bytes:
    """Return CSV as a file: spreadsheets know UTF-8 by the mark at its beginning, `plain` numbers need none."""
    return text.encode("utf-8" if plain else "utf-8-sig", "replace")


def _csv_of(heads: Sequence[Cell], columns: Sequence[Sequence[Cell] | Array], comma: bool) -> str:
    """Return columns under their heads as CSV, in full precision: a tenth of the time that it takes row by row."""
    between = ";" if comma else ","
    cells: list[Sequence[str]] = []
    tell = _teller(len(columns[0]), len(columns) * len(columns[0]))
    for numbers, together in groupby(columns, key=_are_floats):
        group = [*together]
        if numbers:
            from ..scales.series import rows_of  # which needs numpy

            cells.append(rows := [])
            for part in rows_of(cast("Sequence[Array]", group), between, comma):
                rows += part
                tell(len(part) * len(group))
        else:
            for column in group:
                cells.append(_texts(column, comma, between))
                tell(len(column))
    head = between.join(_quoted(_text(cell, comma, exact), between) for cell in heads)
    return "\r\n".join((head, *map(between.join, zip(*cells, strict=True)), ""))


def _are_floats(column: Sequence[Cell] | Array) -> bool:
    return not isinstance(column, Sequence) and column.dtype == "float64"


def _teller(rows: int, whole: int) -> Callable[[int], None]:
    """Return what tells whoever is watching, of a long table, that so many of the whole are done."""
    told = watching.get() if rows >= MANY else None
    return (lambda done: None) if told is None else (lambda done: told(done, whole))


def _texts(column: Sequence[Cell] | Array, comma: bool, between: str) -> list[str]:
    """Return the cells of a column as a spreadsheet reads them, in full precision, and with quotes as CSV has them."""
    column = column if isinstance(column, Sequence) else column.tolist()
    kinds = {int} if isinstance(column, range) else {*map(type, column)}
    if kinds == {int}:
        return [*map(repr, column)]
    if kinds == {str}:  # statuses
        known = {text: _quoted(_harmless(cast("str", text)), between) for text in {*column}}
        return [*map(known.__getitem__, column)]
    if kinds != {float}:
        return [_quoted(_text(cell, comma, exact), between) for cell in column]
    texts = [repr(x + 0.0) if -math.inf < x < math.inf else "" for x in cast("Sequence[float]", column)]
    return [text.replace(".", ",") for text in texts] if comma else texts


def _quoted(text: str, between: str) -> str:
    """Return the text of a cell as it stands in a row of CSV."""
    return '"' + text.replace('"', '""') + '"' if any(sign in text for sign in (between, '"', "\r", "\n")) else text


def _text(cell: Cell, comma: bool, number: Callable[[float], str]) -> str:
    """Return a cell as a spreadsheet reads it; nothing for an undefined number."""
    if cell is None or (isinstance(cell, float) and not math.isfinite(cell)):
        return ""
    if isinstance(cell, str):
        return _harmless(cell)
    text = number(cell)
    return text.replace(".", ",") if comma else text


def _harmless(text: str) -> str:
    """Return a text that no spreadsheet takes for a formula: an apostrophe is put before what might be one.

    >>> _harmless("=1+1"), _harmless("V_B"), _harmless("-5 mm")
    ("'=1+1", 'V_B', "'-5 mm")
    >>> _harmless("x,=1+1"), _harmless("2, -5 mm")
    ("x,'=1+1", '2, -5 mm')
    """
    within = _INSIDE.sub(r"\1'", text)
    seen = next((sign for sign in text if sign in DANGEROUS or (sign.isprintable() and sign != " ")), "")
    return f"'{within}" if seen in DANGEROUS else within


def exact(value: float) -> str:
    """Return a number in full precision, without the sign of a zero."""
    return repr(float(value) + 0.0) if isinstance(value, float) else str(value)


def _rounded(value: float) -> str:
    """Return a number as people want to see it in a table."""
    return f"{value:.10g}"


def _xlsx_bytes(rows: Rows, title: str, bold: Iterable[int] = (), frozen: int = 0, high: int = _LINE) -> bytes:
    """Return rows as a workbook of one sheet, named by a title; texts are texts there, whatever they begin with.

    `bold` rows are counted from 0; so many as are `frozen`, the last of them the heads, stay in sight when the sheet is
    scrolled, and of a wide sheet its first column. Columns are as wide as their longest texts, up to a limit; what is
    longer, and heads, go on in a next line, and a text that has its row to itself goes over all columns. A wide sheet
    is printed in landscape, on as many pages side by side as it can be read on, each with its lines and the first
    column.
    """
    from xlsxwriter import Workbook  # takes a tenth of a second

    stream = io.BytesIO()
    name = "".join(c for c in title if c.isprintable() and c < "\U00010000" and c not in r"[]:*?/\'")[:31]
    widths, long = dict[int, int](), list[tuple[int, int, str]]()
    with Workbook(stream, {"in_memory": True, "default_format_properties": {"valign": "top"}}) as book:
        book.set_properties({"created": _CREATED})
        sheet, looks = book.add_worksheet(name or "1"), dict.fromkeys(bold, book.add_format({"bold": True}))
        wrapped, heads = book.add_format({"text_wrap": True}), book.add_format({"bold": True, "text_wrap": True})
        if frozen:
            looks[frozen - 1] = heads
        tell = _teller(len(rows), len(rows))
        for at, row in enumerate(rows):
            for column, cell in enumerate(row):
                length = len(str(cell)) if cell is not None else 0
                if len(row) > 1:
                    if at == frozen - 1:  # heads go on in a next line
                        length = max(map(len, str(cell).split()), default=0)
                    widths[column] = max(widths.get(column, 8), length)
                if isinstance(cell, str) and cell:
                    plain = "".join(c if c.isprintable() or c == "\n" else " " for c in cell[:LONGEST])
                    plain = f" {plain}" if plain.startswith("<r>") else plain  # XlsxWriter would take it for XML
                    sheet.write_string(at, column, plain, looks.get(at, wrapped if length > _WIDEST else None))
                    if at == frozen - 1 or length > _WIDEST:
                        long.append((at, column, plain))
                elif isinstance(cell, int | float) and math.isfinite(cell):
                    sheet.write_number(at, column, float(_rounded(cell)), looks.get(at))
            tell(1)
        widths = {column: min(width, _WIDEST) + 2 for column, width in widths.items()}
        whole, lines = sum(widths.values()), dict[int, int]()
        for column, width in widths.items():
            sheet.set_column_pixels(column, column, _PIXELS * width)
        for at, column, text in long:
            alone = len(rows[at]) == 1 < len(widths)
            if alone:
                sheet.merge_range(at, 0, at, max(widths), text, wrapped)
            lines[at] = max(lines.get(at, 1), len(wrap(text, whole if alone else widths.get(column, _WIDEST))))
        sheet.set_default_row(high)
        for at, count in lines.items():  # not every program finds out by itself
            sheet.set_row(at, max(_LINE * count, high))
        sheet.set_paper(_A4)
        sheet.set_margins(*[_MARGIN] * 4)
        sheet.hide_gridlines(0)  # printed, too
        if whole > _LANDSCAPE:  # to be taken together by its first column
            sheet.set_print_scale(_SMALLEST)
            sheet.repeat_columns(0)
        else:
            sheet.fit_to_pages(1, 0)
        if whole > _PORTRAIT:
            sheet.set_landscape()
        if frozen:
            sheet.freeze_panes(frozen, int(whole > _SCREEN))
            sheet.repeat_rows(frozen - 1)
    return stream.getvalue()
