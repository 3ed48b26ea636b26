"""What is left of a sheet's views when only the beginning of the work is shown."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

from ..layers import TASK_VIEWS, Layer
from ..page import Page
from ..shapes import Arrow, Group, Polyline, Shape, Text, Vector
from ..shapes import Line as LineShape
from ..table import cells
from ..view import View

NUMBER = re.compile(r"[−-]?\d+(?:[.,]\d+)?(?: |$)")  # what a cell of units does not begin with
ALWAYS = ("axis", "pivot", "frame")  # roles of what the task gives, not the work
ENLARGED = ("window", "enlarged")  # roles of what is drawn when the whole view is: its crowded parts, larger
TOGETHER = re.compile(r", | = ")  # between letters of marks at one place, and of vectors that are one


@dataclass(frozen=True, slots=True)
class Shown:
    """What is drawn of a view: names of points, links, construction lines and quantities, and the letters.

    `notes` are the lines under its heading, which may hold results. A table keeps its first `columns`, and the `rows`
    with these first cells; without any said, its last column where that is one of units. Of a view that is drawn in
    stages the shapes of these `stages` are drawn, whatever their names and letters. What is enlarged beside a view is
    drawn when the view is drawn `whole`.
    """

    names: frozenset[str]
    letters: frozenset[str]
    notes: bool = True
    rows: frozenset[str] | None = None
    columns: int = 1
    stages: frozenset[str] | None = None
    whole: bool = False


NOTHING = Shown(frozenset(), frozenset(), notes=False)


def begun_pages(pages: Iterable[Page], views: Iterable[View], shown: Mapping[str, Shown], steps: int = 0) -> list[Page]:
    """Return pages on which so many steps are done, and views without stages show no more than is `shown` of them.

    Tables keep their heads and first columns. All of it is given to the student, and in that layer.
    """
    by_name = {view.name: view for view in views}
    shown = {**shown, **{view.name: begun_stages(view, steps) for view in by_name.values() if view.stages}}
    begun = [replace(page, shapes=tuple(_page_shape(shape, by_name, shown) for shape in page.shapes)) for page in pages]
    return [replace(page, shapes=tuple(map(_given, page.shapes))) for page in begun]


def begun_stages(view: View, steps: int) -> Shown:
    """Return what is drawn of a view in its first stages; what stands under its heading is known when all are done."""
    drawn = frozenset(list(view.stages)[: steps + 1])
    return Shown(frozenset(), frozenset(), notes=drawn.issuperset({*view.parts, *view.stages} - {""}), stages=drawn)


def _given(shape: Shape) -> Shape:
    if isinstance(shape, Group) and shape.role == "view":
        return replace(shape, layer=Layer.GIVEN.value)
    return shape


def _page_shape(shape: Shape, views: Mapping[str, View], shown: Mapping[str, Shown]) -> Shape:
    view = views.get(shape.name) if isinstance(shape, Group) and shape.role == "view" else None
    if view is None or not isinstance(shape, Group) or (view.name in TASK_VIEWS and view.name not in shown):
        return shape
    kept = shown.get(view.name, NOTHING)
    if view.rows:
        return replace(shape, shapes=tuple(_table(part, view, kept) for part in shape.shapes))
    if view.lines:
        return replace(shape, shapes=tuple(part for part in shape.shapes if _is_heading(part)))
    hidden = frozenset(() if kept.notes else view.notes)
    parts = view.parts or ("",) * len(shape.shapes)
    own = (part for part, name in zip(shape.shapes, parts, strict=True) if _belongs(part, name, kept))
    return replace(shape, shapes=tuple(part for part in own if not (_is_heading(part) and _markup(part) in hidden)))


def _belongs(shape: Shape, part: str, shown: Shown) -> bool:
    """Whether a shape of this part is shown, or without parts by its name or letter."""
    if shown.stages is None or _is_heading(shape):
        return _is_shown(shape, shown)
    return part in shown.stages


def _is_heading(shape: Shape) -> bool:
    return isinstance(shape, Text) and shape.role == "heading"


def _markup(shape: Shape) -> str:
    return shape.markup if isinstance(shape, Text) else ""


def _table(shape: Shape, view: View, shown: Shown) -> Shape:
    """Leave out what a table answers: all cells but the head, the first column and that of units, or whole rows."""
    if not isinstance(shape, Group) or shape.role != "table":
        return shape
    places = [(row, column, end) for row, line in enumerate(view.rows) for column, end, _ in cells(line)]
    texts = iter(places)
    width = _width(view.rows[0])
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


def _width(head: Sequence[str | None]) -> int:
    """Return the columns of a table, or of each half of one whose halves stand side by side under the same head."""
    half, odd = divmod(len(head), 2)
    return half if half and not odd and head[:half] == head[half:] else len(head)


def _is_shown(shape: Shape, shown: Shown) -> bool:
    match shape:
        case Text(role="heading"):
            return True
        case Text(role="diameter", name=name):  # at the end of its circle, on a leader
            return name in shown.names
        case Text(markup=markup):
            return _told(markup, shown)
        case Vector(quantity=quantity):
            return quantity in shown.names
        case Arrow(name=name):
            return bool(name) and name in shown.names
        case Group(role=role, name=name):
            own = f"link:{name}" if role == "guide" else f"{role}:{name}"
            return role in ALWAYS or own in shown.names or name in shown.names or (role in ENLARGED and shown.whole)
        case LineShape(role="leader", name=name):
            return name in shown.names or _told(name, shown)
        case Polyline(role=role) if role in ENLARGED:
            return shown.whole
        case LineShape(role="similarity", name=name):
            return shown.names.issuperset(name.split())
        case LineShape(name=name, pen=pen) | Polyline(name=name, pen=pen):
            return name in shown.names or (not name and pen.name == "AXIS")
        case _:
            name = getattr(shape, "name", "")
            return bool(name) and name in shown.names


def _told(letters: str, shown: Shown) -> bool:
    """Whether what is written is shown: as it stands, or each of the letters that stand together."""
    return letters in shown.letters or shown.letters.issuperset(TOGETHER.split(letters))
