"""A plan alone on its page, for a transparency that is laid over a student's drawing."""

from __future__ import annotations

from dataclasses import replace

from ..page import Page, extent
from ..shapes import Shape, Text, shifted
from ..view import View

ROUND = 30.0  # mm of free paper round a plan: room for the rulers that prove the print
LEAST = (180.0, 180.0)  # of a page, so that both rulers have room


def over_page(view: View, like: Page) -> Page:
    """Return a page with one plan, its heading above; `like` is the page on which it stood."""
    x0, y0, x1, y1 = extent(view.shapes)
    width, height = max(x1 - x0 + 2 * ROUND, LEAST[0]), max(y1 - y0 + 2 * ROUND, LEAST[1])
    by = complex((width - x1 - x0) / 2, (height - y1 - y0) / 2)
    shapes: tuple[Shape, ...] = tuple(shifted(shape, by) for shape in view.shapes)
    heading = next((shape.markup for shape in view.shapes if isinstance(shape, Text) and shape.role == "heading"), "")
    return replace(like, width=width, height=height, shapes=shapes, title=heading or like.title)
