"""Workbooks made to hurt who reads them, each of another trick; and the harmless one of which they are made."""

from __future__ import annotations

import io
import random
import struct
import warnings
import zipfile
from collections.abc import Callable, Mapping

from kulman.variants.spreadsheets.grid import letters

MAIN = "http://schemas.openxmlformats.org/spreadsheetml/2006/main"
OFFICE = "http://schemas.openxmlformats.org/officeDocument/2006/relationships"
PACKAGE = "http://schemas.openxmlformats.org/package/2006/relationships"
SHEET, TEXTS, STYLES = "xl/worksheets/sheet1.xml", "xl/sharedStrings.xml", "xl/styles.xml"
BOOK, RELATIONS = "xl/workbook.xml", "xl/_rels/workbook.xml.rels"
NAMES = ("величина", "відрізок, мм", "масштаб", "значення", "одиниця", "напрям")
DEEP = 100_000
FORMATS = '<numFmts><numFmt numFmtId="164" formatCode="{}"/></numFmts>'
LOOK = '<xf numFmtId="164"/>'
RULE = '<cfRule type="cellIs" priority="1"><formula>1</formula></cfRule>'
RULES = f'<conditionalFormatting sqref="A1">{RULE}</conditionalFormatting>'
LAUGHS = "".join(f'<!ENTITY {chr(98 + n)} "{f"&{chr(97 + n)};" * 10}">' for n in range(9))
FAR, BROKEN, BOMB, MANY = "rows or", "not an XLSX", "unpacked", "than can be read"  # words of refusals


def row(number: int, cells: str) -> str:
    return f'<row r="{number}">{cells}</row>'


HEADER = row(1, "".join(f'<c r="{at}1" t="s"><v>{n}</v></c>' for n, at in enumerate("ABCDEF")))
ANSWER = row(2, '<c r="A2" t="inlineStr"><is><t>V_B</t></is></c><c r="D2" s="1"><v>2.76</v></c>')


def rows(*lines: str, after: str = "", before: str = "") -> str:
    return f'<worksheet xmlns="{MAIN}">{before}<sheetData>{"".join(lines)}</sheetData>{after}</worksheet>'


def answer(cell: str) -> str:
    """Return a sheet with one more cell."""
    return rows(HEADER, row(2, cell))


def inline(inside: str) -> str:
    """Return a sheet with one more cell that has a text of its own."""
    return answer(f'<c r="A2" t="inlineStr"><is>{inside}</is></c>')


def numbered(count: int, cell: str = "<v>1.5</v>", kind: str = "") -> str:
    """Return a sheet of so many rows of 200 cells."""
    names = [letters(column) for column in range(200)]
    numbers = range(2, count + 2)
    return rows(HEADER, *(row(n, "".join(f'<c r="{name}{n}"{kind}>{cell}</c>' for name in names)) for n in numbers))


def texts(*more: str) -> str:
    plain = "".join(f"<si><t>{name}</t></si>" for name in NAMES)
    return f'<sst xmlns="{MAIN}">{plain}{"".join(more)}</sst>'


def text(long: str) -> str:
    """Return shared texts with one more."""
    return texts(f"<si><t>{long}</t></si>")


def shown(cells: int) -> str:
    """Return a sheet with so many cells that show this one."""
    return numbered(cells // 200, "<v>6</v>", ' t="s"')


def styles(inside: str = '<xf numFmtId="0"/><xf numFmtId="2"/>', before: str = "") -> str:
    return f'<styleSheet xmlns="{MAIN}">{before}<cellXfs>{inside}</cellXfs></styleSheet>'


def book(more: str = "") -> str:
    sheets = f'<sheets><sheet name="1" sheetId="1" r:id="rId1"/></sheets>{more}'
    return f'<workbook xmlns="{MAIN}" xmlns:r="{OFFICE}">{sheets}</workbook>'


def related(sheet: str = "worksheets/sheet1.xml") -> str:
    targets = {"worksheet": sheet, "sharedStrings": "sharedStrings.xml", "styles": "styles.xml"}
    inside = "".join(
        f'<Relationship Id="rId{number}" Type="{OFFICE}/{kind}" Target="{target}"/>'
        for number, (kind, target) in enumerate(targets.items(), 1)
    )
    return f'<Relationships xmlns="{PACKAGE}">{inside}</Relationships>'


def good() -> dict[str, str | bytes]:
    """Return the parts of a workbook that is read: one answer, V_B = 2.76."""
    return {BOOK: book(), RELATIONS: related(), SHEET: rows(HEADER, ANSWER), TEXTS: texts(), STYLES: styles()}


def zipped(parts: Mapping[str, str | bytes]) -> bytes:
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in parts.items():
            archive.writestr(name, content)
    return stream.getvalue()


def patched(at: int, value: bytes) -> bytes:
    """Return the good workbook with bytes of its headers changed; those of the directory are two further on."""
    out = bytearray(zipped(good()))
    for mark, place in ((b"PK\x03\x04", at), (b"PK\x01\x02", at + 2)):
        found = out.find(mark)
        while found >= 0:
            out[found + place : found + place + len(value)] = value
            found = out.find(mark, found + 1)
    return bytes(out)


def noise(length: int) -> str:
    """Return letters that hardly shrink."""
    return random.Random(9).randbytes(length // 2).hex()


def endless() -> bytes:
    """Return a ZIP whose directory has a hundred thousand entries."""
    entry, count = b"PK\x01\x02" + b"\0" * 42, 100_000
    return entry * count + b"PK\x05\x06" + struct.pack("<HHHHIIH", 0, 0, 65535, 65535, len(entry) * count, 0, 0)


def doubled() -> bytes:
    stream = io.BytesIO()
    with warnings.catch_warnings(), zipfile.ZipFile(stream, "w") as archive:
        warnings.simplefilter("ignore")
        for name, content in (*good().items(), (SHEET, rows(HEADER))):
            archive.writestr(name, content)
    return stream.getvalue()


Parts = Callable[[], Mapping[str, str | bytes]]
# What is wrong: the parts that are changed, and words of the refusal, none where the file may be read as well.
SMALL: dict[str, tuple[Parts, str]] = {
    "encoding unknown": (lambda: {SHEET: '<?xml version="1.0" encoding="UTF-9"?>' + rows(HEADER)}, BROKEN),
    "text -1": (lambda: {SHEET: answer('<c r="A2" t="s"><v>-1</v></c>')}, BROKEN),
    "text beyond the last": (lambda: {SHEET: answer('<c r="A2" t="s"><v>999999</v></c>')}, BROKEN),
    "text in other digits": (lambda: {SHEET: answer('<c r="A2" t="s"><v>\u0661</v></c>')}, BROKEN),
    "styles nested": (lambda: {STYLES: styles("<x>" * DEEP + "</x>" * DEEP)}, BROKEN),
    "texts nested": (lambda: {TEXTS: texts("<si>" * DEEP + "</si>" * DEEP)}, BROKEN),
    "workbook nested": (lambda: {BOOK: "<sheets>" * DEEP}, BROKEN),
    "rows nested": (lambda: {SHEET: rows("<row>" * DEEP)}, BROKEN),
    "cell nested": (lambda: {SHEET: answer('<c r="A2"><is>' + "<a>" * DEEP)}, BROKEN),
    "rules nested": (lambda: {SHEET: rows(HEADER, after="<a>" * DEEP)}, BROKEN),
    "cells in cells": (lambda: {SHEET: rows(row(1, '<c r="A1"><c r="XFD1"/></c>'))}, BROKEN),
    "cells of another name": (lambda: {SHEET: rows(row(1, '<a r="XFD1"/>'))}, BROKEN),
    "values in a cell": (lambda: {SHEET: answer('<c r="A2">' + "<v>1</v>" * 50_000 + "</c>")}, BROKEN),
    "looks": (lambda: {STYLES: styles("<xf/>" * 100_000)}, MANY),
    "looks with slow formats": (lambda: {STYLES: styles(LOOK * 30_000, FORMATS.format("[" * 255))}, BROKEN),
    "format that is long": (lambda: {STYLES: styles("<xf/>", FORMATS.format("[" * 150_000))}, BROKEN),
    "formats": (lambda: {STYLES: styles("<xf/>", FORMATS.format("0") * 10_000)}, BROKEN),
    "format that is no number": (lambda: {STYLES: styles('<xf numFmtId="x"/>')}, BROKEN),
    "entities that unfold": (lambda: {SHEET: f'<!DOCTYPE x [<!ENTITY a "ha">{LAUGHS}]><x>&i;</x>'}, BROKEN),
    "entity from elsewhere": (lambda: {TEXTS: '<!DOCTYPE x [<!ENTITY a SYSTEM "file:///x">]><sst>&a;</sst>'}, BROKEN),
    "one cell in the last corner": (lambda: {SHEET: rows(row(1_048_576, '<c r="XFD1048576"><v>1</v></c>'))}, FAR),
    "size that is claimed": (lambda: {SHEET: rows(HEADER, ANSWER, before='<dimension ref="A1:XFD1048576"/>')}, ""),
    "rows backwards": (lambda: {SHEET: rows(row(9, ""), row(3, '<c r="A3"><v>1</v></c>'))}, BROKEN),
    "cells backwards": (lambda: {SHEET: rows(row(1, '<c r="C1"><v>1</v></c><c r="A1"><v>1</v></c>'))}, BROKEN),
    "cell in another row": (lambda: {SHEET: rows(row(1, '<c r="A9"><v>1</v></c>'))}, BROKEN),
    "cell without a row": (lambda: {SHEET: rows('<c r="A9"><v>1</v></c>')}, BROKEN),
    "row below nought": (lambda: {SHEET: rows(row(-5, '<c r="A1"><v>1</v></c>'))}, BROKEN),
    "row of many digits": (lambda: {SHEET: rows(f'<row r="{"9" * 100_000}"/>')}, BROKEN),
    "number of many digits": (lambda: {SHEET: answer(f'<c r="A2"><v>{"9" * 30_000}</v></c>')}, BROKEN),
    "number that is infinite": (lambda: {SHEET: answer('<c r="A2"><v>1e999</v></c>')}, ""),
    "date beyond all dates": (lambda: {SHEET: answer('<c r="A2" s="2"><v>1e300</v></c>')}, ""),
    "truth that is none": (lambda: {SHEET: answer('<c r="A2" t="b"><v>maybe</v></c>')}, BROKEN),
    "date that is none": (lambda: {SHEET: answer('<c r="A2" t="d"><v>yesterday</v></c>')}, BROKEN),
    "look that is no number": (lambda: {SHEET: answer('<c r="A2" s="x"><v>1</v></c>')}, BROKEN),
    "lone surrogate": (lambda: {SHEET: inline("<t>_xD800_</t>")}, ""),
    "sheet outside": (lambda: {RELATIONS: related("/../../etc/passwd")}, BROKEN),
    "sheet that is the workbook": (lambda: {RELATIONS: related("workbook.xml")}, BROKEN),
    "sheet twice": (lambda: {SHEET: rows(HEADER, after="<sheetData/>")}, BROKEN),
    "sheet in UTF-16": (lambda: {SHEET: rows(HEADER, ANSWER).encode("utf-16")}, BROKEN),
    "sheet that is an archive": (lambda: {SHEET: zipped(good())}, BROKEN),
}
LARGE: dict[str, tuple[Parts, str]] = {
    "texts, a million": (lambda: {TEXTS: texts("<si><t>aaaa</t></si>" * 900_000)}, MANY),
    "texts, as many as are read": (lambda: {TEXTS: texts(*(f"<si><t>{n}</t></si>" for n in range(85_000)))}, ""),
    "text of 16 MB": (lambda: {TEXTS: text(noise(16_000_000))}, ""),
    "text of 15 MB that is shown": (lambda: {TEXTS: text("a" * 15_000_000), SHEET: shown(200)}, "longer"),
    "text of 30 kB shown 100,000 times": (lambda: {SHEET: shown(100_000), TEXTS: text(noise(30_000))}, MANY),
    "text with many looks": (lambda: {TEXTS: text("x</t><r><rPr><b/></rPr><t>x</t></r><t>" * 100_000)}, ""),
    "cell with many looks": (lambda: {SHEET: inline("<r><t>x</t></r>" * 200_000)}, MANY),
    "looks, as many as are read": (lambda: {STYLES: styles(LOOK * 33_000, FORMATS.format("[x]" * 10 + "0" * 99))}, ""),
    "tag of 16 MB": (lambda: {SHEET: rows(f'<row a="{noise(16_000_000)}"/>')}, BROKEN),
    "tag of a million attributes": (lambda: {SHEET: rows("<row", *(f' a{n}=""' for n in range(1_000_000)))}, BROKEN),
    "comment of 16 MB": (lambda: {SHEET: rows(HEADER, f"<!--{noise(16_000_000)}-->")}, BROKEN),
    "blank cell in the last corner": (lambda: {SHEET: rows(HEADER, row(1_048_576, '<c r="XFD1048576"/>'))}, ""),
    "blank cells far away": (lambda: {SHEET: rows(*(row(n, f'<c r="XFD{n}"/>') for n in range(1, 20_001)))}, MANY),
    "blank cells": (lambda: {SHEET: numbered(5_000, "")}, MANY),
    "blank rows": (lambda: {SHEET: rows(HEADER, *(f'<row r="{n}"/>' for n in range(2, 900_000)))}, MANY),
    "rows without numbers": (lambda: {SHEET: rows(HEADER, "<row/>" * 3_000_000)}, MANY),
    "elements in a cell": (lambda: {SHEET: answer('<c r="A2"><is>' + "<a/>" * 4_000_000 + "</is></c>")}, MANY),
    "elements behind the rows": (lambda: {SHEET: rows(HEADER, after="<a/>" * 1_200_000)}, ""),
    "merged ranges": (lambda: {SHEET: rows(HEADER, ANSWER, after='<mergeCell ref="A1:XFD1048576"/>' * 400_000)}, ""),
    "rules for looks": (lambda: {SHEET: rows(HEADER, ANSWER, after=RULES * 60_000)}, ""),
    "names": (lambda: {BOOK: book("<definedName name='a'>Sheet1!$A:$XFD</definedName>" * 200_000)}, ""),
    "sheets": (lambda: {BOOK: book('<sheet name="a" sheetId="1" r:id="rId1"/>' * 300_000)}, ""),
    "numbers of many digits": (lambda: {SHEET: numbered(20, f"<v>{'9' * 4_000}</v>")}, MANY),
    "numbers, as many as are read": (lambda: {SHEET: numbered(1_340)}, ""),
}
FILES: dict[str, tuple[Callable[[], bytes], str]] = {
    "blanks of 22 MB": (lambda: zipped(good() | {SHEET: rows(HEADER) + " " * 22_000_000}), BOMB),
    "zeros of 200 MB": (lambda: zipped(good() | {SHEET: "\0" * 200_000_000}), BOMB),
    "text of 60 MB": (lambda: zipped(good() | {TEXTS: text("a" * 60_000_000)}), BOMB),
    "members": (endless, BOMB),
    "member twice": (doubled, BROKEN),
    "password": (lambda: patched(6, b"\1"), BROKEN),
    "packed by LZMA": (lambda: patched(8, b"\x0e"), BROKEN),
    "size that is too small": (lambda: patched(22, b"\x10\0\0\0"), BROKEN),
    "size of 4 GB": (lambda: patched(22, b"\xf0\xff\xff\xff"), ""),
}
HOSTILE = {name: words for name, (_, words) in (*SMALL.items(), *LARGE.items(), *FILES.items())}


def hostile(name: str) -> bytes:
    """Return a file; so that it is not refused for its ratio alone, letters that hardly shrink stand in its parts."""
    if name in FILES:
        return FILES[name][0]()
    salt, parts = f"<!--{noise(150_000)}-->", good()
    for part, content in (SMALL | LARGE)[name][0]().items():
        marks = ("<sheetData>", "<cellXfs>", "<si>", "<sheets>")
        mark = next((mark for mark in marks if isinstance(content, str) and mark in content), None)
        parts[part] = content.replace(mark, salt + mark, 1) if mark and isinstance(content, str) else content
    return zipped(parts)
