"""A figure of a note as a page of its own, at its true size; how much smaller it is shown."""

from __future__ import annotations

from ..page import Page
from ..shapes import shifted
from .blocks import Figure


def figure_page(figure: Figure, language: str) -> Page:
    """Return a page as large as the figure."""
    x0, y0, x1, y1 = figure.view.box
    shapes = tuple(shifted(shape, complex(-x0, -y0)) for shape in figure.view.shapes)
    return Page(x1 - x0, y1 - y0, shapes, figure.caption, language)


def reduced(said: dict[str, str], share: float) -> tuple[str, ...]:
    """Say by how much a figure that has this share of its size is smaller than on the sheet, if it is."""
    return (said["figure.reduced"].format(part=round(100.0 * share)),) if share < 1.0 else ()
