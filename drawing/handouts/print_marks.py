"""Marks that prove a print: rulers of 100 mm in the margins, with a word on how to print."""

from __future__ import annotations

from dataclasses import replace

from ...scales.packaged import packaged
from ..page import Page
from ..shapes import Group, Line, Pen, Shape, Text

LENGTH, TICK, LONG = 100, 1.5, 3.0  # of a ruler and its marks, mm
LETTERS = 2.5


def marked(page: Page) -> Page:
    """Return a page in layers with a ruler under the frame and one beside it."""
    x, y = 24.0, 6.0
    across = _ruler(complex(x, y), 1 + 0j)
    up = _ruler(complex(12.0, 60.0), 1j)
    text = Text(
        complex(x + LENGTH + 4.0, y),
        packaged(__package__, "texts", page.language)["print.whole"],
        LETTERS,
        role="stamp",
        name="print",
    )
    rulers = Group((*across, text), "ruler", "across"), Group(tuple(up), "ruler", "up")
    return replace(page, shapes=(*page.shapes, *rulers), layers=True)


def _ruler(start: complex, along: complex) -> list[Shape]:
    """Return a ruler with a mark at every 5 mm, longer ones at every 10."""
    beside = along * 1j
    shapes: list[Shape] = [Line(start, start + LENGTH * along, Pen.THIN, role="ruler")]
    for mm in range(0, LENGTH + 1, 5):
        at = start + mm * along
        shapes.append(Line(at, at + beside * (TICK if mm % 10 else LONG), Pen.THIN, role="ruler"))
    return shapes
