"""What is done to pages of handouts: a light grid under a drawing, answers in a hidden layer, rulers, a plan alone."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from math import ceil

from ...scales.packaged import packaged
from ..areas import beside
from ..formats import Format, drawing_area, reserved_boxes
from ..layers import Layer
from ..page import Page, extent
from ..pens import Norm
from ..shapes import Group, Line, Pen, Shape, Text, shifted
from ..view import View

SIDE = 5.0  # of a square, mm
LIGHT = "#d9d9d9"
ANSWER = "#0072B2"  # what the teacher's hand adds is blue
ROUND = 30.0  # mm of free paper round a plan: room for the rulers that prove the print
LEAST = (180.0, 180.0)  # of a page, so that both rulers have room
LENGTH, TICK, LONG = 100, 1.5, 3.0  # of a ruler and its marks, mm
LETTERS = 2.5


def gridded(page: Page, sheet: Format, norm: Norm, first: bool) -> Page:
    """Return a page of `sheet` with squares inside its frame, but for the title block and column 26."""
    x0, y0, x1, y1 = drawing_area(sheet, norm)
    boxes = reserved_boxes(sheet, norm, first)
    ways = [(complex(x, y0), complex(x, y1)) for x in _between(x0, x1)]
    ways += [(complex(x0, y), complex(x1, y)) for y in _between(y0, y1)]
    ends = (part for way in ways for part in beside(*way, boxes))
    squares = tuple(Line(*part, Pen.THIN, role="grid", colour=LIGHT) for part in ends)
    return replace(page, shapes=(Group(squares, "grid", layer=Layer.GRID.value), *page.shapes))


def _between(low: float, high: float) -> list[float]:
    """Return the places of the lines of squares between two sides of a frame."""
    return [low + k * SIDE for k in range(1, ceil((high - low) / SIDE - 1e-9))]


def keyed(page: Page, whole: Iterable[Group]) -> Page:
    """Return a begun page with a hidden layer of what `whole`, the views that stand there, have beyond it."""
    shown = {shape.name: shape for shape in page.shapes if isinstance(shape, Group) and shape.role == "view"}
    answers = (replace(view, shapes=tuple(_beyond(view, shown[view.name]))) for view in whole)
    hidden = (replace(view, layer=Layer.KEY.value) for view in answers if view.shapes)
    return replace(page, shapes=(*page.shapes, *hidden))


def _beyond(whole: Group, begun: Group) -> Iterator[Shape]:
    """Go through what a group has and its begun twin has not, in the teacher's colour."""
    shown = set(begun.shapes)
    twins = {(part.role, part.name): part for part in begun.shapes if isinstance(part, Group)}
    for part in whole.shapes:
        if part in shown:
            continue
        if isinstance(part, Group) and (twin := twins.get((part.role, part.name))) is not None:
            yield replace(part, shapes=tuple(_beyond(part, twin)))
        else:
            yield _inked(part)


def _inked(shape: Shape) -> Shape:
    if isinstance(shape, Group):
        return replace(shape, shapes=tuple(map(_inked, shape.shapes)))
    return replace(shape, colour=ANSWER)


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


def over_page(view: View, like: Page) -> Page:
    """Return a page with one plan, its heading above; `like` is the page on which it stood."""
    x0, y0, x1, y1 = extent(view.shapes)
    width, height = max(x1 - x0 + 2 * ROUND, LEAST[0]), max(y1 - y0 + 2 * ROUND, LEAST[1])
    by = complex((width - x1 - x0) / 2, (height - y1 - y0) / 2)
    shapes: tuple[Shape, ...] = tuple(shifted(shape, by) for shape in view.shapes)
    heading = next((shape.markup for shape in view.shapes if isinstance(shape, Text) and shape.role == "heading"), "")
    return replace(like, width=width, height=height, shapes=shapes, title=heading or like.title)
