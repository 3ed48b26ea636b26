"""Handouts: the first steps of a sheet, its answers in a hidden layer, one plan alone; squares and rulers of a page."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from math import ceil

from ..scales.packaged import packaged
from .areas import beside
from .figure import GIVEN
from .formats import Format, Norm, drawing_area, reserved_boxes
from .page import TASK_VIEWS, Layer, Page, extent
from .shapes import Group, Line, Pen, Shape, Text, changed, shifted
from .view import View, cells

NUMBER = re.compile(r"[−-]?\d+(?:[.,]\d+)?(?: |$)")  # what a cell of units does not begin with
SQUARE, LIGHT = 5.0, "#d9d9d9"  # of the grid: side in mm, colour
ANSWER = "#0072B2"  # what the teacher's hand adds is blue
ROUND = 30.0  # mm of free paper round a plan that stands alone: room for the rulers that prove the print
LEAST = 180.0  # mm of the sides of its page, so that both rulers have room
RULER, TICK, LONG = 100, 1.5, 3.0  # lengths of a ruler and of its marks, mm


@dataclass(frozen=True, slots=True)
class Shown:
    """What a handout shows of a view: the shapes of these `stages`; of a table some rows and columns.

    `notes` are the lines under its heading, which may hold results. A table keeps its first `columns`, and the `rows`
    with these first cells; without any said, its last column where that is one of units.
    """

    stages: frozenset[str] = frozenset((GIVEN,))
    notes: bool = False
    rows: frozenset[str] | None = None
    columns: int = 1


def begun_pages(pages: Iterable[Page], views: Iterable[View], shown: Mapping[str, Shown], steps: int = 0) -> list[Page]:
    """Return pages on which so many steps are done, and views that name no stages show no more than is `shown` of them.

    Tables keep their heads and first columns. All of it is given to the student, and in that layer.
    """
    by_name = {view.name: view for view in views}
    shown = {**shown, **{view.name: begun_stages(view, steps) for view in by_name.values() if view.stages}}
    return [replace(page, shapes=tuple(_page_shape(shape, by_name, shown) for shape in page.shapes)) for page in pages]


def begun_stages(view: View, steps: int) -> Shown:
    """Return what is drawn of a view in its first stages; what stands under its heading is known when all are done."""
    drawn = frozenset(list(view.stages)[: steps + 1])
    return Shown(drawn, notes=drawn.issuperset({*view.parts, *view.stages} - {""}))


def _page_shape(shape: Shape, views: Mapping[str, View], shown: Mapping[str, Shown]) -> Shape:
    if not isinstance(shape, Group) or shape.role != "view":
        return shape
    shape = replace(shape, layer=Layer.GIVEN.value)
    view = views.get(shape.name)
    if view is None or (view.name in TASK_VIEWS and view.name not in shown):
        return shape
    kept = shown.get(view.name, Shown())
    if view.rows:
        return replace(shape, shapes=tuple(_table(part, view, kept) for part in shape.shapes))
    hidden = frozenset(() if kept.notes else view.notes)
    parts: list[Shape] = []
    for part, stage in zip(shape.shapes, view.parts or ("",) * len(shape.shapes), strict=True):
        if isinstance(part, Text) and part.role == "heading":
            parts += [part] if part.markup not in hidden else []
        elif stage in kept.stages:
            parts.append(part)
    return replace(shape, shapes=tuple(parts))


def _table(shape: Shape, view: View, shown: Shown) -> Shape:
    """Leave out what a table answers: all cells but the head, the first column and that of units, or whole rows."""
    if not isinstance(shape, Group) or shape.role != "table":
        return shape
    places = [(row, column, end) for row, line in enumerate(view.rows) for column, end, text in cells(line) if text]
    texts = iter(places)
    head = view.rows[0]
    half, odd = divmod(len(head), 2)  # of a table whose halves stand side by side under the same head
    width = half if half and not odd and head[:half] == head[half:] else len(head)
    last = -1 if any(NUMBER.match(row[-1] or "") for row in view.rows[1:]) else width
    kept = []
    for part in shape.shapes:
        if isinstance(part, Text):
            row, column, end = next(texts)
            given = (end - 1) % width + 1 == last if shown.rows is None else view.rows[row][0] in shown.rows
            if row and column % width >= shown.columns and not given:
                continue
        kept.append(part)
    return replace(shape, shapes=tuple(kept))


def gridded(page: Page, sheet: Format, norm: Norm, first: bool) -> Page:
    """Return a page of `sheet` with squares inside its frame, but for the title block and column 26."""
    x0, y0, x1, y1 = drawing_area(sheet, norm)
    boxes = reserved_boxes(sheet, norm, first)
    columns, rows = (
        [low + k * SQUARE for k in range(1, ceil((high - low) / SQUARE - 1e-9))] for low, high in ((x0, x1), (y0, y1))
    )
    ways = [(complex(x, y0), complex(x, y1)) for x in columns] + [(complex(x0, y), complex(x1, y)) for y in rows]
    ends = (part for way in ways for part in beside(*way, boxes))
    squares = tuple(Line(*part, Pen.THIN, role="grid", colour=LIGHT) for part in ends)
    return replace(page, shapes=(Group(squares, "grid", layer=Layer.GRID.value), *page.shapes))


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
            yield changed(part, lambda shape: replace(shape, colour=ANSWER))


def over_page(view: View, like: Page) -> Page:
    """Return a page with one plan, its heading above; `like` is the page on which it stood."""
    x0, y0, x1, y1 = extent(view.shapes)
    width, height = max(x1 - x0 + 2 * ROUND, LEAST), max(y1 - y0 + 2 * ROUND, LEAST)
    by = complex((width - x1 - x0) / 2, (height - y1 - y0) / 2)
    shapes: tuple[Shape, ...] = tuple(shifted(shape, by) for shape in view.shapes)
    heading = next((shape.markup for shape in view.shapes if isinstance(shape, Text) and shape.role == "heading"), "")
    return replace(like, width=width, height=height, shapes=shapes, title=heading or like.title)


def marked(page: Page) -> Page:
    """Return a page in layers with a ruler under the frame and one beside it."""
    start, word = complex(24.0, 6.0), packaged(__package__, "texts", page.language)["print.whole"]
    text = Text(start + RULER + 4.0, word, 2.5, role="stamp", name="print")
    across = Group((*_ruler(start, 1 + 0j), text), "ruler", "across")
    up = Group(tuple(_ruler(complex(12.0, 60.0), 1j)), "ruler", "up")
    return replace(page, shapes=(*page.shapes, across, up), layers=True)


def _ruler(start: complex, along: complex) -> Iterator[Line]:
    """Go through the lines of a ruler with a mark at every 5 mm, longer ones at every 10."""
    yield Line(start, start + RULER * along, Pen.THIN, role="ruler")
    for mm in range(0, RULER + 1, 5):
        at = start + mm * along
        yield Line(at, at + along * 1j * (TICK if mm % 10 else LONG), Pen.THIN, role="ruler")
