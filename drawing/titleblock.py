"""Title blocks after GOST 2.104, forms 1 and 2a, and after ISO 7200, and what any title block says."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from ..scales.packaged import packaged
from .cells import fitted
from .people import named
from .shapes import Line, Pen, Shape, Text
from .text import Box

T, t = Pen.MAIN, Pen.THIN
CAPTION = (2.5,)


@dataclass(frozen=True, slots=True)
class Stamp:
    """What the title block says; an empty field stays blank on the sheet.

    `identity` stands under the frame: what tells sheets of one task from one another.
    """

    title: str = ""
    designation: str = ""
    organisation: str = ""
    group: str = ""
    student: str = ""
    teacher: str = ""
    date: str = ""
    document_type: str = ""
    sheet: int = 1
    sheets: int = 1
    scale: str = ""
    language: str = "uk"
    identity: str = ""


# From the bottom left corner of the block: level and ends of horizontal lines, place and ends of vertical ones, mm.
# The bottom and the right side of every block are lines of the frame.
_ROW_LINES = (25, 20, 15, 10, 5)
FORM_1: tuple[tuple[float, float, float, float, Pen], ...] = (
    (0, 55, 185, 55, T),
    *((0, y, 65, y, t) for y in (50, 45, 40)),
    (65, 40, 185, 40, T),
    (0, 35, 65, 35, T),
    (135, 35, 185, 35, T),
    (0, 30, 65, 30, T),
    *((0, y, 65, y, t) for y in _ROW_LINES),
    (135, 20, 185, 20, T),
    (65, 15, 185, 15, T),
    (0, 0, 0, 55, T),
    (7, 30, 7, 55, T),
    *((x, 0, x, 55, T) for x in (17, 40, 55, 65)),
    (135, 0, 135, 40, T),
    *((x, 20, x, 35, t) for x in (140, 145)),
    *((x, 20, x, 40, T) for x in (150, 167)),
    (155, 15, 155, 20, T),
)
FORM_2A: tuple[tuple[float, float, float, float, Pen], ...] = (
    (0, 15, 185, 15, T),
    (0, 10, 65, 10, t),
    (0, 5, 65, 5, T),
    (175, 8, 185, 8, T),
    *((x, 0, x, 15, T) for x in (0, 7, 17, 40, 55, 65, 175)),
)
# 180 x 36 mm in three rows of 12
ISO_7200: tuple[tuple[float, float, float, float, Pen], ...] = (
    (0, 36, 180, 36, T),
    (0, 0, 0, 36, T),
    (0, 24, 140, 24, t),
    (0, 12, 180, 12, t),
    (80, 0, 80, 36, t),
    (100, 0, 100, 12, t),
    (140, 0, 140, 36, t),
    (160, 0, 160, 12, t),
)
ISO_CELLS: tuple[tuple[str, Box], ...] = (
    ("title", (0.0, 24.0, 80.0, 36.0)),
    ("document_type", (0.0, 12.0, 80.0, 24.0)),
    ("identification", (0.0, 0.0, 80.0, 12.0)),
    ("creator", (80.0, 24.0, 140.0, 36.0)),
    ("approver", (80.0, 12.0, 140.0, 24.0)),
    ("owner", (140.0, 12.0, 180.0, 36.0)),
    ("language", (80.0, 0.0, 100.0, 12.0)),
    ("issued", (100.0, 0.0, 140.0, 12.0)),
    ("revision", (140.0, 0.0, 160.0, 12.0)),
    ("sheet", (160.0, 0.0, 180.0, 12.0)),
)
CHANGES = (("change", 0, 7), ("row_sheet", 7, 17), ("document_no", 17, 40), ("signature", 40, 55), ("date", 55, 65))
ROLES = (("drawn", 25), ("checked", 20), ("technical", 15), ("norms", 5), ("approved", 0))


def words(language: str) -> dict[str, str]:
    """Return the captions of title blocks in `language`, by key."""
    captions: dict[str, str] = packaged(__package__, "texts", f"titleblock.{language}")["titleblock"]
    return captions


def ruled(lines: Iterable[tuple[float, float, float, float, Pen]]) -> list[Shape]:
    """Return the lines of a table of ends and pens."""
    return [Line(complex(x0, y0), complex(x1, y1), pen, role="cell") for x0, y0, x1, y1, pen in lines]


def _changes(caption: dict[str, str], y: float) -> list[Text]:
    cells = ((caption[key], (float(x0), y, float(x1), y + 5.0), key) for key, x0, x1 in CHANGES)
    return [text for plain, cell, key in cells for text in fitted(plain, cell, CAPTION, name=key)]


def form_1(stamp: Stamp) -> list[Shape]:
    """Return form 1, 185 x 55 mm, filled in."""
    caption = words(stamp.language)
    filled: list[Shape] = [*_changes(caption, 30.0), *_people(caption, stamp)]
    name_cell = (65.0, 22.0 if stamp.document_type else 15.0, 135.0, 40.0)
    below_name = (65.0, 15.0, 135.0, 22.5)
    owner = ", ".join(part for part in (stamp.organisation, stamp.group) if part)
    for key, plain, cell, heights in (
        ("designation", stamp.designation, (65.0, 40.0, 185.0, 55.0), (7.0, 5.0, 3.5, 2.5)),
        ("title", stamp.title, name_cell, (5.0, 3.5, 2.5)),
        ("document_type", stamp.document_type, below_name, (3.5, 2.5)),
        ("organisation", owner, (135.0, 0.0, 185.0, 15.0), (5.0, 3.5, 2.5)),
        ("letter", caption["letter"], (135.0, 35.0, 150.0, 40.0), CAPTION),
        ("letter_value", caption["letter_value"], (135.0, 20.0, 140.0, 35.0), (3.5, 2.5)),
        ("mass", caption["mass"], (150.0, 35.0, 167.0, 40.0), CAPTION),
        ("scale_caption", caption["scale"], (167.0, 35.0, 185.0, 40.0), CAPTION),
        ("scale", stamp.scale, (167.0, 20.0, 185.0, 35.0), (5.0, 3.5, 2.5)),
        ("sheet", f"{caption['sheet']} {stamp.sheet}", (135.0, 15.0, 155.0, 20.0), CAPTION),
        ("sheets", f"{caption['sheets']} {stamp.sheets}", (155.0, 15.0, 185.0, 20.0), CAPTION),
    ):
        filled += fitted(plain, cell, heights, name=key)
    return [*ruled(FORM_1), *filled]


def _people(caption: dict[str, str], stamp: Stamp) -> list[Text]:
    """Return the rows of roles, names and the date."""
    texts: list[Text] = []
    for key, y in ROLES:
        texts += fitted(caption[key], (0.0, y, 17.0, y + 5.0), CAPTION, "left", key)
    for key, plain, level in (("student", stamp.student, 25.0), ("teacher", stamp.teacher, 20.0)):
        texts += named(plain, (17.0, level, 40.0, level + 5.0), CAPTION, "left", key)
    return texts + fitted(stamp.date, (55.0, 25.0, 65.0, 30.0), CAPTION, name="date_value")


def form_2a(stamp: Stamp) -> list[Shape]:
    """Return form 2a, 185 x 15 mm, for the sheets after the first."""
    caption = words(stamp.language)
    filled: list[Shape] = [*_changes(caption, 0.0)]
    filled += fitted(stamp.designation, (65.0, 0.0, 175.0, 15.0), (7.0, 5.0, 3.5, 2.5), name="designation")
    filled += fitted(caption["row_sheet"], (175.0, 8.0, 185.0, 15.0), CAPTION, name="sheet_caption")
    filled += fitted(str(stamp.sheet), (175.0, 0.0, 185.0, 8.0), (3.5, 2.5), name="sheet")
    return [*ruled(FORM_2A), *filled]


def iso_block(stamp: Stamp) -> list[Shape]:
    """Return the block of ISO 7200, filled in; a caption stands in the top left of each cell."""
    caption = words(stamp.language)
    values = {
        "title": stamp.title,
        "document_type": stamp.document_type,
        "identification": stamp.designation,
        "creator": " ".join(part for part in (stamp.student, stamp.group) if part),
        "approver": stamp.teacher,
        "owner": stamp.organisation,
        "language": stamp.language,
        "issued": stamp.date,
        "sheet": f"{stamp.sheet}/{stamp.sheets}",
    }
    parts = ruled(ISO_7200)
    for key, (x0, y0, x1, y1) in ISO_CELLS:
        parts += fitted(caption[f"iso_{key}"], (x0, y1 - 4.6, x1, y1), (2.5,), "left", f"{key}_caption")
        value = (x0, y0, x1, y1 - 3.95)
        parts += fitted(values.get(key, ""), value, (3.5, 2.5), "left", key)
    return parts
