"""Rows of cells written as CSV or XLSX: nothing is taken for a formula, the same rows give the same bytes."""

from __future__ import annotations

import csv
import io
import math
import re
import zipfile
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import TypeAlias
from xml.sax.saxutils import escape

from .grid import letters

Cell: TypeAlias = str | float | int | None
Rows: TypeAlias = Sequence[Sequence[Cell]]
DANGEROUS = tuple("=+-@|%\t\r\n＝＋－＠")  # with which programs begin a formula or a command
# the same behind what another program, or one of another country, takes for the end of a cell; -5 mm is no formula
_INSIDE = re.compile(r"([,;\t\r\n][^\S\t\r\n]*+)(?=[=@|%＝＠]|[-+－＋][^,;\t\r\n]*[(|!=@])")
_DATE = (2000, 1, 1, 0, 0, 0)
_WIDEST = 60
_ESCAPE = re.compile("_(?=x[0-9A-Fa-f]{4}_)")  # what would be read as a sign by its number
LONGEST = 32_000  # characters of a cell: programs take 32,767
_MAIN = "http://schemas.openxmlformats.org/spreadsheetml/2006/main"
_OFFICE = "http://schemas.openxmlformats.org/officeDocument/2006/relationships"
_PACKAGE = "http://schemas.openxmlformats.org/package/2006"
_TYPE = "application/vnd.openxmlformats-officedocument.spreadsheetml"
_HEAD = '<?xml version="1.0" encoding="UTF-8" standalone="yes"?>\n'


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


def xlsx_bytes(rows: Rows, title: str, bold: Iterable[int] = (), frozen: int = 0) -> bytes:
    """Return rows as a workbook of one sheet; texts are texts there, whatever they begin with.

    Parameters
    ----------
    title : str
        Name of the sheet.
    bold : iterable of int
        Rows set in bold, counted from 0.
    frozen : int
        Rows that stay in sight when the sheet is scrolled.
    """
    name = escape("".join(c for c in title if c.isprintable() and c not in r"[]:*?/\'")[:31], {'"': "&quot;"})
    sheets = f'<sheets><sheet name="{name or "1"}" sheetId="1" r:id="rId1"/></sheets>'
    stream = io.BytesIO()
    parts = {
        "[Content_Types].xml": _content_types(),
        "_rels/.rels": _relations((("rId1", f"{_OFFICE}/officeDocument", "xl/workbook.xml"),)),
        "xl/workbook.xml": f'<workbook xmlns="{_MAIN}" xmlns:r="{_OFFICE}">{sheets}</workbook>',
        "xl/_rels/workbook.xml.rels": _relations(
            (("rId1", f"{_OFFICE}/worksheet", "worksheets/sheet1.xml"), ("rId2", f"{_OFFICE}/styles", "styles.xml"))
        ),
        "xl/styles.xml": _styles(),
        "xl/worksheets/sheet1.xml": _sheet(rows, frozenset(bold), frozen),
    }
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, text in parts.items():
            info = zipfile.ZipInfo(name, _DATE)
            info.compress_type, info.external_attr, info.create_system = zipfile.ZIP_DEFLATED, 0o644 << 16, 3
            archive.writestr(info, _HEAD + text)
    return stream.getvalue()


def _content_types() -> str:
    parts = {"xl/workbook.xml": "sheet.main", "xl/styles.xml": "styles", "xl/worksheets/sheet1.xml": "worksheet"}
    defaults = (
        '<Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>'
        '<Default Extension="xml" ContentType="application/xml"/>'
    )
    own = "".join(f'<Override PartName="/{p}" ContentType="{_TYPE}.{kind}+xml"/>' for p, kind in parts.items())
    return f'<Types xmlns="{_PACKAGE}/content-types">{defaults}{own}</Types>'


def _relations(items: Iterable[tuple[str, str, str]]) -> str:
    own = "".join(f'<Relationship Id="{name}" Type="{kind}" Target="{target}"/>' for name, kind, target in items)
    return f'<Relationships xmlns="{_PACKAGE}/relationships">{own}</Relationships>'


def _styles() -> str:
    """Return the two looks of a cell: plain and bold; both are texts until a number is typed."""
    font = '<sz val="11"/><name val="Calibri"/><family val="2"/>'
    border = "<border><left/><right/><top/><bottom/><diagonal/></border>"
    return (
        f'<styleSheet xmlns="{_MAIN}"><fonts count="2"><font>{font}</font><font><b/>{font}</font></fonts>'
        '<fills count="2"><fill><patternFill patternType="none"/></fill>'
        '<fill><patternFill patternType="gray125"/></fill></fills>'
        f'<borders count="1">{border}</borders>'
        '<cellStyleXfs count="1"><xf numFmtId="0" fontId="0" fillId="0" borderId="0"/></cellStyleXfs>'
        '<cellXfs count="2"><xf numFmtId="0" fontId="0" fillId="0" borderId="0" xfId="0"/>'
        '<xf numFmtId="0" fontId="1" fillId="0" borderId="0" xfId="0" applyFont="1"/></cellXfs>'
        '<cellStyles count="1"><cellStyle name="Normal" xfId="0" builtinId="0"/></cellStyles></styleSheet>'
    )


def _sheet(rows: Rows, bold: frozenset[int], frozen: int) -> str:
    body = "".join(_row(number, row, number in bold) for number, row in enumerate(rows))
    pane = ""
    if frozen:
        at = f'topLeftCell="A{frozen + 1}" activePane="bottomLeft" state="frozen"'
        pane = f'<sheetViews><sheetView workbookViewId="0"><pane ySplit="{frozen}" {at}/></sheetView></sheetViews>'
    return f'<worksheet xmlns="{_MAIN}">{pane}{_widths(rows)}<sheetData>{body}</sheetData></worksheet>'


def _widths(rows: Rows) -> str:
    """Return widths that hold the longest text of each column, but for a text that has its row to itself."""
    longest: dict[int, int] = {}
    for row in rows:
        for column, cell in enumerate(row if len(row) > 1 else ()):
            longest[column] = max(longest.get(column, 8), len(str(cell)) if cell is not None else 0)
    widths = (
        f'<col min="{column + 1}" max="{column + 1}" width="{min(width, _WIDEST) + 2}" customWidth="1"/>'
        for column, width in longest.items()
    )
    return f"<cols>{''.join(widths)}</cols>" if longest else ""


def _row(number: int, row: Sequence[Cell], bold: bool) -> str:
    cells = "".join(_cell(f"{letters(column)}{number + 1}", cell, bold) for column, cell in enumerate(row))
    return f'<row r="{number + 1}">{cells}</row>'


def _cell(address: str, cell: Cell, bold: bool) -> str:
    style = ' s="1"' if bold else ""
    if cell is None or cell == "":
        return ""
    if isinstance(cell, str):
        plain = "".join(c if c.isprintable() or c == "\n" else " " for c in cell[:LONGEST])
        text = escape(_ESCAPE.sub("_x005F_", plain))
        return f'<c r="{address}"{style} t="inlineStr"><is><t xml:space="preserve">{text}</t></is></c>'
    return f'<c r="{address}"{style}><v>{rounded(cell)}</v></c>'
