"""What a page that moves needs of a cam, a gear pair or a hoist: formulas, figures with their steps, quantities.

The formulas are those of the course, written down as JavaScript; the figures are those of the sheet, stage by stage as
the note tells them. What moves is said by the subject: shapes between points that the formulas find, or that stand.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from ...plans.boards.batch import script_of_formulas
from ...plans.solved import Course, Pieces
from ...scales.scale import Scale
from ...scales.units import SHOWN
from ...scales.units import unit as unit_of
from ..areas import coarser, thinned
from ..compose import Drawn
from ..figure import ANSWERS
from ..notes.blocks import Story
from ..printed import DEGREES
from ..shapes import Arc, Arrow, Circle, Group, Head, Line, Pen, Polyline, Shape, Text, Vector
from ..symbols import polar, unit
from ..view import View
from ..words import Given, Words
from . import Data, html, number

FINE = 0.03  # mm by which curves of figures may be simplified
HEAD, SLIM = 3.0, 6.0  # mm, length of an arrowhead; its parts that half of it is wide
CLASSES = {Pen.MAIN: "main", Pen.THIN: "thin", Pen.DASHED: "dashed", Pen.AXIS: "axis", Pen.EXTREME: "axis"}
FILLS = {"white": "paper", "black": "solid", True: "solid"}
BESIDE = 6.0  # mm beside a figure, for letters that are wider than those of the sheet
SIZE = 170.0  # mm that a view takes, about
HALF = 3.14  # rad: arcs of more are drawn in two


@dataclass(frozen=True, slots=True)
class Moving:
    """What moves of a subject, and by what: see the fields of `drive` in `places.js`.

    The `views` are those that move, the first of them the mechanism; `over` are shapes that move over figures of the
    sheet, by their names. `points` stand, in SI; `shown` are the columns of the table, `first` those of the diagrams;
    `symbols` are those of columns that have other ones than quantities. The figure that `opens` is shown at first.
    `measured` are numbers by which views are as large as what moves in them: see `measure` in `places.js`.
    """

    drive: Data
    views: list[Data]
    points: Mapping[str, complex]
    shown: tuple[str, ...]
    first: tuple[str, ...]
    over: Mapping[str, list[Data]] = field(default_factory=dict)
    symbols: Mapping[str, str] = field(default_factory=dict)
    opens: str = ""
    measured: Mapping[str, Data] = field(default_factory=dict)


def driven(name: str, symbol: str, ends: tuple[float, float], speed: float, turns: bool = False, **more: Any) -> Data:
    """Return a drive that goes from one end to the other: its quantity, the symbol in markup, how fast, SI.

    `turns` tells whether it goes round; `more` are further fields, see `places.js`.
    """
    low, high = ends
    head = {"name": name, "symbol": html(symbol), "turns": turns, "sense": 1}
    return head | {"start": low, "low": low, "high": high, "speed": speed, **more}


def moving_course(
    moving: Moving,
    course: Course,
    drawn: Drawn,
    story: Story,
    givens: Mapping[str, Given],
    words: Words,
    bounds: Mapping[str, str],
) -> Data:
    """Return what the page needs of a subject that has a course over its motion; `bounds` are those of givens."""
    solve, names = script_of_formulas(course.formulas)
    if (again := _found_again(course)) is not None:
        solve += again
    figures = [_figure(view, story, drawn.scales.get(view.name), moving.over) for view in drawn.views if view.stages]
    units = {column.name: column.unit for column in course.columns(course.places(2))}
    return {
        "solve": solve,
        "names": names,
        "board": {
            **{name: [number(at.real), number(at.imag)] for name, at in moving.points.items()},
            **{name: one["now"] for name, one in moving.measured.items()},
            **course.changeable,
            **course.kept,
        },
        "near": None,
        "pieces": _pieces(course.pieces()),
        "turned": [],
        "drive": moving.drive,
        "measured": moving.measured,
        "givens": [*_givens(givens, course.changeable, words, bounds)],
        "stroke": None,
        "views": [*({"steps": [], **view} for view in moving.views), *figures],
        "asked": [["given", name] for name, one in moving.measured.items() if "round" in one],
        "opens": moving.opens if moving.opens in {figure["name"] for figure in figures} else "",
        "quantities": [_quantity(name, units[name], moving.symbols, words) for name in moving.shown if name in units],
        "shown": [name for name in moving.first if name in units],
        "senses": ["", ""],
    }


def _pieces(pieces: Pieces | None) -> Data | None:
    if pieces is None:
        return None
    rows = [[number(value) for value in row] for row in pieces.rows.tolist()]
    return {"starts": pieces.starts.tolist(), "names": [*pieces.names], "rows": rows}


def _quantity(name: str, unit_name: str, symbols: Mapping[str, str], words: Words) -> Data:
    shown = SHOWN.get(unit_name, unit_name)
    by = unit_of(shown).from_si(1.0) if shown != unit_name else 1.0
    said = html(words.unit(shown)) if shown != "1" else ""
    return {"name": name, "symbol": html(symbols.get(name) or words.symbol(name)), "unit": said, "by": by, "plan": ""}


def _found_again(course: Course) -> str | None:
    """Return what other numbers make anew as source of JavaScript: by name value, and two places around its zero."""
    names = list[str]()

    def zeros(given: Callable[[str], Any]) -> dict[str, Any]:
        found = course.found_again(given)
        names.extend(found)
        return {f"{name}.{k}": part for name, parts in found.items() for k, part in enumerate(parts)}

    source, _ = script_of_formulas(zeros, "zeros")
    return f"{source}const ZEROS = {json.dumps(names)};\n" if names else None


def _givens(
    givens: Mapping[str, Given], changeable: Mapping[str, float], words: Words, bounds: Mapping[str, str]
) -> Iterator[Data]:
    """Go through the givens, then through sizes that were found; those that cannot be changed are fixed."""
    lengths = {name: Given(unit_of("mm").from_si(now), "mm") for name, now in changeable.items() if name not in givens}
    for name, given in {**givens, **lengths}.items():
        if isinstance(given.value, str):
            continue
        yield {
            "name": name,
            "board": [name],
            "symbol": html(words.symbol(name)),
            "unit": html(words.unit(given.unit)),
            "value": given.value if name in givens else number(given.value, 6),
            "si": 1.0 if given.unit == "1" else unit_of(given.unit).to_si(1.0),
            "bound": bounds.get(name, ""),
            "fixed": name not in changeable,
        }


def _figure(view: View, story: Story, scale: Scale | None, over: Mapping[str, list[Data]]) -> Data:
    """Return a figure of the sheet: what each stage draws, in order, and the sentences of the note that tell it."""
    steps, number_of = story.steps_of(view), dict[str, int]()
    for stage, key in view.stages.items():
        number_of[stage] = max(number_of.values(), default=0) + bool(key)
    number_of |= {ANSWERS: len(steps), "": 0}
    drawn = [
        (number_of[part], shape)
        for shape, part in zip(view.shapes, view.parts, strict=True)
        if not (isinstance(shape, Text) and shape.role == "heading")
    ]
    x0, y0, x1, y1 = view.box
    return {
        "name": view.name,
        "heading": html(view.heading[0]),
        "under": [html(line) for line in view.notes],
        "frame": [round(x0 - BESIDE, 1), round(-y1, 1), round(x1 - x0 + 2.0 * BESIDE, 1), round(y1 - y0, 1)],
        "mu": scale.mu if scale is not None else 1.0,
        "drawn": [*_strokes(drawn)],
        "shapes": over.get(view.name, []),
        "steps": [html(step) for step in steps],
    }


def _strokes(drawn: Iterable[tuple[int, Shape]]) -> Iterator[list[Any]]:
    """Go through what is drawn in a stage: runs of lines of one kind as paths, and letters."""
    run: list[Any] = [-1, "", ""]
    for stage, shape in drawn:
        for kind, path in _paths(coarser(shape, FINE)):
            if isinstance(path, list):
                yield [stage, *path]
            elif run[:2] == [stage, kind] and kind != "paper":
                run[2] += path
            else:
                if run[2]:
                    yield run
                run = [stage, kind, path]
    if run[2]:
        yield run


def _paths(shape: Shape) -> Iterator[tuple[str, Any]]:
    """Go through the paths of a shape, each with its class; letters as lists of their own."""
    match shape:
        case Group(shapes=shapes):
            for part in shapes:
                yield from _paths(part)
        case Text(at=at, markup=markup, height=height, anchor=anchor, angle=angle):
            place = [round(at.real, 2), round(-at.imag, 2), round(-angle * DEGREES, 1)]
            yield "", ["text", html(markup), *place, height, {"left": "start", "right": "end"}.get(anchor, anchor)]
        case Line(a=a, b=b, pen=pen):
            yield CLASSES[pen], _path((a, b))
        case Polyline(points=points, pen=pen, closed=closed, fill=fill):
            yield FILLS.get(fill, CLASSES[pen]), _path(points) + "Z" * closed
        case Circle(centre=centre, radius=radius, pen=pen, fill=fill):
            ends = centre - radius, centre + radius
            turned = "".join(f"A{_mm(radius)} {_mm(radius)} 0 0 0 {_at(end)}" for end in (ends[1], ends[0]))
            yield FILLS.get(fill, CLASSES[pen]), f"M{_at(ends[0])}{turned}Z"
        case Arc(centre=centre, radius=radius, start=start, sweep=sweep, pen=pen):
            parts = [start + sweep * k / 2 for k in (1, 2)] if abs(sweep) > HALF else [start + sweep]
            arcs = (
                f"A{_mm(radius)} {_mm(radius)} 0 0 {int(sweep < 0)} {_at(centre + polar(radius, a))}" for a in parts
            )
            yield CLASSES[pen], f"M{_at(centre + polar(radius, start))}{''.join(arcs)}"
        case Head(tip=tip, direction=direction):
            yield "solid", _head(tip, direction)
        case Vector(tail=tail, tip=tip, pen=pen) | Arrow(tail=tail, tip=tip, pen=pen):
            yield CLASSES[pen], _path((tail, tip))
            if abs(tip - tail) > HEAD:
                yield "solid", _head(tip, tip - tail)


def _head(tip: complex, direction: complex) -> str:
    along = unit(direction) * HEAD
    return _path((tip, tip - along + 1j * along / SLIM, tip - along - 1j * along / SLIM)) + "Z"


def _path(points: Iterable[complex]) -> str:
    return "M" + "L".join(map(_at, points))


def _at(point: complex) -> str:
    return f"{_mm(point.real)} {_mm(-point.imag)}"


def _mm(length: float) -> str:
    return f"{round(length, 1) + 0.0:g}"


def outline(points: Sequence[complex], size: float) -> list[list[float | None]]:
    """Return points of a body, m, in a view of that size, as the page has them: as few as show it."""
    part = FINE * size / SIZE
    return [[number(point.real, 5), number(point.imag, 5)] for point in thinned(points, part)]
