"""Handouts: the first steps of a sheet, its answers in a hidden layer, one plan alone; squares and rulers of a page."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from math import ceil

from ..scales.packaged import packaged
from .areas import beside
from .figure import GIVEN
from .formats import Format, Norm, drawing_area, reserved_boxes
from .page import TASK_VIEWS, Layer, Page, extent
from .shapes import Anchor, Group, Line, Pen, Shape, Text, changed, shifted
from .tables import cells
from .view import View, left_of

SQUARE, LIGHT = 5.0, "#d9d9d9"  # of the grid: side in mm, colour
ANSWER = "#0072B2"  # what the teacher's hand adds is blue
ROUND = 30.0  # mm of free paper round a plan that stands alone: room for the rulers that prove the print
LEAST = 180.0  # mm of the sides of its page, so that both rulers have room
RULER, TICK, LONG = 100, 1.5, 3.0  # lengths of a ruler and of its marks, mm


@dataclass(frozen=True, slots=True)
class Shown:
    """What a handout shows of a view: the shapes of these `stages`; of a table some rows and columns.

    `notes` are the lines under its heading, which may hold results. A table keeps its first `columns`, and the `rows`
    with these first cells; without any said, its columns of units.
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
    shown = {**shown, **{name: _begun_stages(by_name[name], done) for name, done in _done(by_name, steps).items()}}
    begun = []
    for page in pages:
        unit = packaged(__package__, "texts", page.language)["table.unit"]
        shapes = tuple(_page_shape(shape, by_name, shown, unit) for shape in page.shapes)
        begun.append(replace(page, shapes=shapes))
    return begun


def _done(views: Mapping[str, View], steps: int) -> dict[str, int]:
    """Return how many stages of each view are done: so many `steps`, as far as others have found what these need."""

    def found(need: str) -> bool:
        name, _, stage = need.partition(".")
        if name not in done:  # on another sheet, where it is done
            return True
        order = list(views[name].stages)
        return done[name] >= (order.index(stage) if stage in order else len(order) - 1)

    def reached(name: str) -> int:
        order, needs = list(views[name].stages)[1 : done[name] + 1], views[name].needs
        return next((n for n, stage in enumerate(order) if not all(map(found, needs.get(stage, ())))), len(order))

    done = {name: min(steps, len(view.stages) - 1) for name, view in views.items() if view.stages}
    before = dict[str, int]()
    while done != before:
        before, done = done, {name: reached(name) for name in done}
    return done


def _begun_stages(view: View, steps: int) -> Shown:
    """Return what is drawn of a view in its first stages; what stands under its heading is known when all are done."""
    drawn = frozenset(list(view.stages)[: steps + 1])
    return Shown(drawn, notes=drawn.issuperset({*view.parts, *view.stages} - {""}))


def _page_shape(shape: Shape, views: Mapping[str, View], shown: Mapping[str, Shown], unit: str) -> Shape:
    if not isinstance(shape, Group) or shape.role != "view":
        return shape
    shape = replace(shape, layer=Layer.GIVEN.value)
    view = views.get(shape.name)
    name = view.of or view.name if view is not None else ""
    if view is None or (name in TASK_VIEWS and name not in shown):
        return shape
    kept = shown.get(name, Shown())
    if view.rows:
        return replace(shape, shapes=tuple(_table(part, view, kept, unit) for part in shape.shapes))
    hidden = frozenset(() if kept.notes else view.notes)
    parts: list[Shape] = []
    twins = zip(shape.shapes, view.shapes, strict=True)
    by = next((a.at - b.at for a, b in twins if isinstance(a, Text) and isinstance(b, Text)), 0j)
    for k, (part, stage) in enumerate(zip(shape.shapes, view.parts or ("",) * len(shape.shapes), strict=True)):
        if isinstance(part, Text) and part.role == "heading":
            parts += [part] if part.markup not in hidden else []
        elif stage in kept.stages:
            whole, before = view.whole.get(k), view.whole.get(k - 1)
            if whole is None or kept.stages.issuperset(whole.boxes.values()):
                parts.append(part)
            elif before is None or whole.shape is not before.shape:  # broken at the letters that are shown
                boxes = tuple(box for box, of in whole.boxes.items() if of in kept.stages)
                parts += (shifted(piece, by) for piece in (left_of(whole.shape, boxes) if boxes else [whole.shape]))
    return replace(shape, shapes=tuple(parts))


def _table(shape: Shape, view: View, shown: Shown, unit: str) -> Shape:
    """Leave out what a table answers: all but the head, the first column and those headed `unit`, or whole rows."""
    if not isinstance(shape, Group) or shape.role != "table":
        return shape
    places = [(row, column, end) for row, line in enumerate(view.rows) for column, end, text in cells(line) if text]
    texts = iter(places)
    head = view.rows[0]
    half, odd = divmod(len(head), 2)  # of a table whose halves stand side by side under the same head
    width = half if half and not odd and head[:half] == head[half:] else len(head)
    kept = []
    for part in shape.shapes:
        if isinstance(part, Text):
            row, column, end = next(texts)
            given = head[end - 1] == unit if shown.rows is None else view.rows[row][0] in shown.rows
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
    texts = packaged(__package__, "texts", page.language)
    start, side = complex(24.0, 6.0), complex(12.0, 60.0)
    whole = f"{RULER} {texts['unit.mm']}; {texts['print.whole']}"
    below = _said(start - 1.0, "0", "right"), _said(start + RULER + 2.0, whole, "left")
    across = Group((*_ruler(start, 1 + 0j), *below), "ruler", "across")
    ends = _said(side - 3.5j, "0", "middle"), _said(side + 1j * (RULER + 1.0), str(RULER), "middle")
    up = Group((*_ruler(side, 1j), *ends), "ruler", "up")
    return replace(page, shapes=(*page.shapes, across, up), layers=True)


def _said(at: complex, text: str, anchor: Anchor) -> Text:
    return Text(at, text, 2.5, anchor, role="stamp", name="print")


def _ruler(start: complex, along: complex) -> Iterator[Line]:
    """Go through the lines of a ruler with a mark at every 5 mm, longer ones at every 10."""
    yield Line(start, start + RULER * along, Pen.THIN, role="ruler")
    for mm in range(0, RULER + 1, 5):
        at = start + mm * along
        yield Line(at, at + along * 1j * (TICK if mm % 10 else LONG), Pen.THIN, role="ruler")
