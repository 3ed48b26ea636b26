"""The title block of ISO 7200 and the centring marks of ISO 5457."""

from __future__ import annotations

from .cells import fitted
from .formats import Format, block_box, drawing_area
from .shapes import Group, Line, Pen, Shape
from .text import Box
from .titleblock import Stamp, ruled, words

T, t = Pen.MAIN, Pen.THIN

# From the bottom left corner of the block, mm: 180 x 36 in three rows of 12.
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
CELLS: tuple[tuple[str, Box], ...] = (
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
    for key, (x0, y0, x1, y1) in CELLS:
        parts += fitted(caption[f"iso_{key}"], (x0, y1 - 4.6, x1, y1), (2.5,), "left", f"{key}_caption")
        value = (x0, y0, x1, y1 - 3.95)
        parts += fitted(values.get(key, ""), value, (3.5, 2.5), "left", key)
    return parts


def centring_marks(sheet: Format) -> Group:
    """Return the four marks in the middles of the sides, from 5 mm outside the frame to 5 mm inside it."""
    x0, y0, x1, y1 = drawing_area(sheet, "iso")
    across, up = sheet.width / 2, sheet.height / 2
    left, _, right, _ = block_box(sheet, "iso")
    inward = 0 if left < across < right else 5  # a mark through the title block would cross its words
    ends = (
        (complex(x0 - 5, up), complex(x0 + 5, up)),
        (complex(x1 + 5, up), complex(x1 - 5, up)),
        (complex(across, y0 - 5), complex(across, y0 + inward)),
        (complex(across, y1 + 5), complex(across, y1 - 5)),
    )
    return Group(tuple(Line(a, b, T) for a, b in ends), "margin", "centring")
