"""The plans of a student over the right ones, as SVG for a report: vectors hung together as they were answered."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from ...drawing.areas import clipped
from ...drawing.linkages.reading import read
from ...drawing.text import Box as Frame
from ...plans.board import POSITION
from ...plans.marking.answers import Line, Verdict
from ...plans.names import role
from .marked import Marked
from .wording import plain, script_runs, texts

PLACES = (0.5, 0.36, 0.64, 0.22, 0.78)  # along a vector, the best first
GAP = 0.8  # mm from the line
HEIGHT, WIDTH = 3.6, 1.8  # mm, of a line of text, and of a letter on the average
SIGNS = {Verdict.RIGHT: "✓", Verdict.CARRIED: "(✓)", Verdict.SMALL: "○", Verdict.MISSING: "–"}  # of others ✗


class Box(NamedTuple):
    """The room of a text, mm, y down: its middle and half its width."""

    middle: complex
    half: float

    @property
    def start(self) -> complex:
        """Where the text begins, on its line."""
        return self.middle + complex(-self.half, 0.3 * HEIGHT)

    def lies_in(self, figure: complex) -> bool:
        """Whether the text lies within a figure of this width and height."""
        x, y = self.middle.real, self.middle.imag
        return self.half <= x <= figure.real - self.half and 0.5 * HEIGHT <= y <= figure.imag - 0.5 * HEIGHT

    def meets(self, other: Box) -> bool:
        """Whether two texts lie on each other."""
        apart = self.middle - other.middle
        return abs(apart.real) < self.half + other.half and abs(apart.imag) < HEIGHT


def boxes(vectors: Sequence[tuple[complex, complex, int]], figure: complex) -> Iterator[Box]:
    """Go through the rooms of the texts of vectors, in their order.

    A vector has tail, tip and number of letters, mm, y down; texts turn away from the middle of the figure, of which
    width and height are given, keep within it, and clear of other texts where they can.
    """
    taken: list[Box] = []
    for tail, tip, letters in vectors:
        spots = list(_spots(tail, tip, 0.5 * WIDTH * letters, figure * 0.5))
        spots = [box for box in spots if box.lies_in(figure)] or spots
        box = next((spot for spot in spots if not any(map(spot.meets, taken))), spots[0])
        taken.append(box)
        yield box


def _spots(tail: complex, tip: complex, half: float, centre: complex) -> Iterator[Box]:
    """Go through the places of a text beside a vector: first those on its outer side."""
    length = abs(tip - tail)
    normal = (tip - tail) * 1j * (1.0 / length) if length else 1j
    outward = (0.5 * (tail + tip) - centre) * normal.conjugate()
    for side in (1.0, -1.0) if outward.real >= 0.0 else (-1.0, 1.0):
        away = side * normal * (GAP + abs(normal.real) * half + abs(normal.imag) * 0.5 * HEIGHT)
        for place in PLACES:
            yield Box(tail + (tip - tail) * place + away, half)


SIZE = 150.0  # mm, of the longer side of a plan
MARGIN = 10.0
REACH = 0.6  # of the right plan's size, by which the vectors of a student may stand out of it
LEAST = 1e-9  # part of a plan's size below which a vector is a point
RISE = {0: 0.0, 1: -1.2, -1: 0.9}  # mm down the page, of text, superscripts and subscripts
SMALL = 2.5  # mm, size of scripts


@dataclass(frozen=True, slots=True)
class _Vector:
    """A vector of a plan: the student's, or the right one where `line` is None."""

    symbol: str
    tail: complex
    tip: complex
    line: Line | None

    @property
    def ends(self) -> tuple[complex, complex]:
        """Tail and tip."""
        return self.tail, self.tip

    def cut(self, frame: Frame) -> tuple[complex, complex] | None:
        """Return the ends of what a frame shows of it, its own where it is whole."""
        left, low, right, high = frame
        if all(left <= end.real <= right and low <= end.imag <= high for end in self.ends):
            return self.ends
        return clipped(*self.ends, frame)

    @property
    def kind(self) -> str:
        """What it is, as the style of the page names it."""
        return "right" if self.line is None else "own" if self.line.verdict.passed else "wrong"

    @property
    def text(self) -> str:
        """Its symbol, marked where the line is not simply right."""
        if self.line is None or self.line.verdict is Verdict.RIGHT:
            return self.symbol
        return f"{self.symbol} {SIGNS.get(self.line.verdict, '✗')}"


def plan_figures(marked: Marked, language: str) -> Iterator[tuple[str, str, str]]:
    """Go through heading and SVG of every plan on which something was answered, and what is told of vectors cut off."""
    lines = {line.name: line for line in marked.lines if line.answer is not None and isinstance(line.said, complex)}
    solution, words, said = marked.keyed.solution, marked.keyed.words, texts(language)
    for plan in solution.solved.program.plans:
        vectors = list(_vectors(marked, plan, lines))
        if plan != POSITION and any(vector.line is not None for vector in vectors):
            heading, frame = solution.kind.plan_heading(solution.solved, plan, words), _frame(vectors)
            outside = ", ".join(vector.symbol for vector in vectors if vector.cut(frame) != vector.ends)
            told = said["report.cut"].format(symbols=outside) if outside else ""
            yield plain(heading), _svg(vectors, frame, said["report.figure"]), told


def _frame(vectors: Sequence[_Vector]) -> Frame:
    """Return what a figure shows of the plane: the right plan, and of the student's what lies near to it."""
    left, low, right, high = _around(end for vector in vectors if vector.line is None for end in vector.ends)
    reach = REACH * max(right - left, high - low)
    near = left - reach, low - reach, right + reach, high + reach
    return _around(end for vector in vectors for end in ((vector.cut(near) or ()) if reach else vector.ends))


def _around(places: Iterable[complex]) -> Frame:
    """Return left, low, right and high of places."""
    pairs = [(place.real, place.imag) for place in places]
    (left, right), (low, high) = ((min(each), max(each)) for each in zip(*pairs, strict=True))
    return left, low, right, high


def _vectors(marked: Marked, plan: str, lines: Mapping[str, Line]) -> Iterator[_Vector]:
    """Go through the right vectors of a plan, then the student's, each from where the one before it ends."""
    solved = marked.keyed.solution.solved
    edges = read(solved.program).on(plan)
    right_plan = [_Vector("", solved.point(edge.tail), solved.point(edge.tip), None) for edge in edges]
    yield from right_plan
    left, low, far, high = _around(end for vector in right_plan for end in vector.ends) if edges else (0.0,) * 4
    room = (1.0 + REACH) * max(far - left, high - low)
    mu = marked.marking.marker.shown_scale(plan) or marked.marking.key.paper.mus.get(plan, 0.0)
    marks: dict[str, complex] = {}
    for edge in edges:
        line = lines.get(role(edge.name).shown)
        tail = marks.get(edge.tail, solved.point(edge.tail))
        if line is None:
            marks.setdefault(edge.tip, tail + solved.point(edge.tip) - solved.point(edge.tail))
            continue
        said, right = complex(line.said), complex(line.right)
        told = line.answer is not None and line.answer.direction is not None
        if not told and line.verdict is not Verdict.CARRIED and right:  # it has the direction of the right one
            said = right * (math.hypot(said.real, said.imag) / math.hypot(right.real, right.imag))
        size, mm = math.hypot(said.real, said.imag), line.answer.mm if line.answer else None
        if mm and mm * mu <= room < size:  # the value has none beside the right plan; what was drawn has
            said *= mm * mu / size
        tip = tail + said
        marks.setdefault(edge.tip, tip)
        yield _Vector(marked.keyed.symbol(line.name), tail, tip, line)


def _svg(vectors: list[_Vector], frame: Frame, caption: str) -> str:
    """Return the vectors as SVG, the right ones below; what lies out of the frame is cut off, which a break shows."""
    left, bottom, right, top = frame
    span = max(right - left, top - bottom) or 1.0
    scale = SIZE / span
    width, height = (right - left) * scale + 2 * MARGIN, (top - bottom) * scale + 2 * MARGIN

    def at(place: complex) -> complex:
        return complex((place.real - left) * scale + MARGIN, (top - place.imag) * scale + MARGIN)

    from svgwrite.container import SVG
    from svgwrite.path import Path
    from svgwrite.text import Text, TSpan

    figure = SVG(viewBox=f"0 0 {width:.2f} {height:.2f}", role="img", debug=False)
    figure.set_desc(title=caption)
    drawn = [(vector, at(ends[0]), at(ends[1])) for vector in vectors if (ends := vector.cut(frame)) is not None]
    for vector, tail, tip in drawn:
        line = f"M{tail.real:.2f} {tail.imag:.2f}L{tip.real:.2f} {tip.imag:.2f}"
        if vector.cut(frame) != vector.ends and tip != tail:
            line += _break(tail, tip)
        figure.add(Path(line, class_=vector.kind, factory=figure))
        figure.add(Path(_arrow(tail, tip, span * scale * LEAST), class_=f"{vector.kind} tip", factory=figure))
    own = [(vector, tail, tip) for vector, tail, tip in drawn if vector.line is not None]
    rooms = boxes([(tail, tip, len(vector.text)) for vector, tail, tip in own], complex(width, height))
    for (vector, _, _), room in zip(own, rooms, strict=True):
        place = f"{room.start.real:.2f}", f"{room.start.imag:.2f}"
        text = figure.add(Text("", place, class_=vector.kind, factory=figure))
        level = 0.0
        for run, script in script_runs(vector.text):
            # old browsers know no `baseline-shift`; `dy` moves all that follows, until it is moved back
            size = SMALL if script else None
            text.add(TSpan(run, dy=[f"{RISE[script] - level:.1f}"], font_size=size, factory=figure))
            level = RISE[script]
    return str(figure.tostring())


def _break(tail: complex, tip: complex) -> str:
    """Return the two strokes across a vector that goes on beyond the frame."""
    along = (tip - tail) * (1.0 / abs(tip - tail))
    across = along * complex(0.5, 1.2)
    middles = (tip - along * back for back in (5.0, 6.5))
    ends = ((middle - across, middle + across) for middle in middles)
    return "".join(f"M{a.real:.2f} {a.imag:.2f}L{b.real:.2f} {b.imag:.2f}" for a, b in ends)


def _arrow(tail: complex, tip: complex, least: float) -> str:
    """Return the head of an arrow; a point for a vector of no length."""
    length = math.hypot((tip - tail).real, (tip - tail).imag)
    if length <= least:
        return f"M{tip.real - 0.5:.2f} {tip.imag:.2f}h1v1h-1z"
    along = (tip - tail) * (1.0 / length)
    back, side = tip - 3.0 * along, 0.8 * complex(-along.imag, along.real)
    corners = (tip, back + side, back - side)
    return "M" + "L".join(f"{c.real:.2f} {c.imag:.2f}" for c in corners) + "z"
