"""Rows of cells written as XLSX: a workbook of one sheet without a library, the same rows give the same bytes."""

from __future__ import annotations

import io
import re
import zipfile
from collections.abc import Iterable, Sequence
from xml.sax.saxutils import escape

from .csv_write import Cell, Rows, rounded
from .grid import letters

_DATE = (2000, 1, 1, 0, 0, 0)
_WIDEST = 60
_ESCAPE = re.compile("_(?=x[0-9A-Fa-f]{4}_)")  # what would be read as a sign by its number
LONGEST = 32_000  # characters of a cell: programs take 32,767
_MAIN = "http://schemas.openxmlformats.org/spreadsheetml/2006/main"
_OFFICE = "http://schemas.openxmlformats.org/officeDocument/2006/relationships"
_PACKAGE = "http://schemas.openxmlformats.org/package/2006"
_TYPE = "application/vnd.openxmlformats-officedocument.spreadsheetml"
_HEAD = '<?xml version="1.0" encoding="UTF-8" standalone="yes"?>\n'


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
    stream = io.BytesIO()
    parts = {
        "[Content_Types].xml": _content_types(),
        "_rels/.rels": _relations((("rId1", f"{_OFFICE}/officeDocument", "xl/workbook.xml"),)),
        "xl/workbook.xml": _workbook(title),
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


def _workbook(title: str) -> str:
    name = escape("".join(c for c in title if c.isprintable() and c not in r"[]:*?/\'")[:31], {'"': "&quot;"})
    sheet = f'<sheet name="{name or "1"}" sheetId="1" r:id="rId1"/>'
    return f'<workbook xmlns="{_MAIN}" xmlns:r="{_OFFICE}"><sheets>{sheet}</sheets></workbook>'


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
