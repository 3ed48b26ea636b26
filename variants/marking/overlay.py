"""The drawing of a student returned: its lines thin and grey, over them the vectors that were found, by their verdicts.

What tells verdicts apart must be seen on a black-and-white print: a right vector is solid, a wrong one dashed and has a
cross behind its symbol; where it should be is a thin axis line. Colours only help.
"""

from __future__ import annotations

import cmath
from base64 import b64encode
from collections.abc import Iterator, Sequence
from itertools import pairwise
from pathlib import Path

from ...drawing.labels import place
from ...drawing.page import Page, extent
from ...drawing.shapes import Arrow, Circle, Group, Line, Pen, Shape, Text, shifted
from ...drawing.spots import Obstacles, Request
from ...drawing.text import Box as LetterBox
from ...drawing.text import escape, lay_out
from ...drawing.writers import page_files
from ...plans.marking.answers import Line as Judged
from ...plans.marking.lines import Drawn, Letter
from .figures import SIGNS
from .marked import Marked
from .wording import texts

GREY, BLUE, RED = "#999", "#0072b2", "#d55e00"
MARGIN = 10.0  # mm around the drawing
LARGEST = 4500.0  # mm of a page, or only what is around the vectors is shown
AROUND = 40.0
SMALL, PART = 3.5, 1.0 / 200.0  # mm of a letter at the least; its part of a page
WIDE = 0.7  # of a letter's width, of its height
SHOWN = 0.4  # letters: the radius of a circle at an end that somebody has shown
SAMPLE, ROW = 16.0, 1.9  # of the legend: length of a line in mm, height of a row in letters


def marked_files(marked: Marked, language: str, own: bool, path: Path) -> Iterator[tuple[Path, bytes]]:
    """Make the file of a marked drawing, .svg, .pdf or .dxf; a student's `own` has no right vectors.

    Raises
    ------
    InputError
        A package for this kind of file is missing.
    """
    yield from page_files([_marked_page(marked, language, own)], path)


def picture(marked: Marked, language: str, own: bool) -> str:
    """Return a marked drawing as the address of a picture in a page."""
    ((_, data),) = page_files([_marked_page(marked, language, own)], Path("drawing.svg"))
    return f"data:image/svg+xml;base64,{b64encode(data).decode()}"


def _marked_page(marked: Marked, language: str, own: bool) -> Page:
    """Return the drawing of a student with verdicts over it, as a page of its own size."""
    drawn, found = marked.answers.drawn, list(vectors(marked))
    assert drawn is not None
    ends = [end for _, tail, tip, _ in found for end in (tail, tip)]
    box = _box(drawn, ends)
    height = max(SMALL, PART * max(box[2] - box[0], box[3] - box[1]))
    shapes = [*_under(drawn, box), *(() if own else right(found)), *over(marked, found, height)]
    lowest = complex(box[0], min(box[1], extent(shapes)[1]) - 2.0 * height) if shapes else complex(*box[:2])
    shapes += legend(marked, language, own, lowest, height)
    x0, y0, x1, y1 = extent(shapes)
    by = complex(MARGIN - x0, MARGIN - y0)
    moved = tuple(shifted(shape, by) for shape in shapes)
    title = marked.keyed.solution.task.title[language]
    return Page(x1 - x0 + 2.0 * MARGIN, y1 - y0 + 2.0 * MARGIN, moved, title, language)


Vector = tuple[Judged, complex, complex, complex]  # a line, its tail and tip, where its tip should be, mm


def vectors(marked: Marked) -> Iterator[Vector]:
    """Go through the vectors that were found and judged."""
    found = marked.seen
    assert found is not None
    drawn = found.recognised.vectors
    for line in marked.lines:
        one = drawn.get(line.name)
        if one is not None and line.answer is not None and isinstance(line.right, complex):
            should = line.right * cmath.rect(1.0 / found.mus[one.plan], found.turn)
            yield line, one.tail, one.tip, one.tail + should


def _box(drawn: Drawn, ends: Sequence[complex]) -> tuple[float, float, float, float]:
    """Return what is shown of a drawing: all, or of a very large one what is around the vectors."""
    import numpy as np

    every = np.concatenate([drawn.tails, drawn.tips])
    box = every.real.min(), every.imag.min(), every.real.max(), every.imag.max()
    if max(box[2] - box[0], box[3] - box[1]) > LARGEST:
        some = np.array(ends) if ends else every[:1]
        box = some.real.min(), some.imag.min(), some.real.max(), some.imag.max()
        x, y = box[0] - AROUND, box[1] - AROUND
        box = x, y, min(box[2] + AROUND, x + LARGEST), min(box[3] + AROUND, y + LARGEST)
    x0, y0, x1, y1 = map(float, box)
    return x0, y0, x1, y1


def _under(drawn: Drawn, box: tuple[float, float, float, float]) -> Iterator[Shape]:
    """Go through the student's own lines and letters."""
    x0, y0, x1, y1 = box

    def inside(place: complex) -> bool:
        return x0 <= place.real <= x1 and y0 <= place.imag <= y1

    ends = zip(drawn.tails.tolist(), drawn.tips.tolist(), strict=True)
    lines = tuple(Line(a, b, Pen.THIN, colour=GREY) for a, b in ends if inside(a) and inside(b))
    yield Group(lines, "drawing")
    for letter in drawn.letters:
        if inside(letter.place) and letter.height > 0.5:
            at = letter.place - 0.5j * letter.height
            yield Text(at, escape(letter.text), min(letter.height, 20.0), "middle", colour=GREY)


def right(found: Sequence[Vector]) -> Iterator[Shape]:
    """Go through where wrong vectors should be."""
    for line, tail, _, tip in found:
        if not line.verdict.passed and tail != tip:
            yield Arrow(tail, tip, Pen.AXIS, line.name, colour=BLUE)


def over(marked: Marked, found: Sequence[Vector], height: float) -> Iterator[Shape]:
    """Go through the vectors that were found, each with its symbol and a mark."""
    words, times = marked.keyed.words, height / SMALL  # places are thought for letters of the usual height

    def reduced(letter: Letter) -> LetterBox:
        half = complex(WIDE * len(letter.text) * letter.height, letter.height) / 2.0
        low, high = (letter.place - half) / times, (letter.place + half) / times
        return low.real, low.imag, high.real, high.imag

    texts_of = [f"{words.symbol(line.name)} {SIGNS.get(line.verdict, '✗')}" for line, *_ in found]
    layouts = [lay_out(text, SMALL) for text in texts_of]
    ends = [(tail / times, tip / times) for _, tail, tip, _ in found]
    requests = [
        Request(str(number), *layout.size, segment, along=False)
        for number, (layout, segment) in enumerate(zip(layouts, ends, strict=True))
    ]
    letters = marked.answers.drawn.letters if marked.answers.drawn else ()
    near = [reduced(one) for one in letters if one.height and any(_by(one.place, *ends) for _, *ends, _ in found)]
    placed = place(requests, Obstacles(segments=ends, boxes=near))
    for number, ((line, tail, tip, _), layout, text) in enumerate(zip(found, layouts, texts_of, strict=True)):
        colour, pen = (BLUE, Pen.MAIN) if line.verdict.passed else (RED, Pen.DASHED)
        if tail != tip:
            yield Arrow(tail, tip, pen, line.name, colour=colour)
        if line.name in marked.answers.told:
            yield from (Circle(end, SHOWN * height, Pen.MAIN, colour=colour) for end in (tail, tip))
        at = (placed.corners[str(number)] - complex(layout.left, layout.bottom)) * times
        yield Text(at, text, height, role="label", name=line.name, colour=colour)
        way = [point * times for point in placed.leaders.get(str(number), ())]
        yield from (Line(a, b, Pen.THIN, colour=colour) for a, b in pairwise(way))


def _by(at: complex, tail: complex, tip: complex) -> bool:
    """Whether a letter stands so near to a vector that a word at this may cover it."""
    return min(abs(at - tail), abs(at - tip)) <= AROUND + abs(tip - tail)


def legend(marked: Marked, language: str, own: bool, at: complex, height: float) -> Iterator[Shape]:
    """Go through the rows that say what lines mean, and what was marked, from the top."""
    said, solution = texts(language), marked.keyed.solution
    head = f"{solution.task.title[language]}; {said['about.variant']}: {solution.variant}"
    yield Text(at, escape(head), height)
    rows = [(Pen.MAIN, BLUE, "drawing.right"), (Pen.DASHED, RED, "drawing.wrong")]
    rows += [] if own else [(Pen.AXIS, BLUE, "drawing.should")]
    rows.append((Pen.THIN, GREY, "drawing.own"))
    sample = SAMPLE * height / SMALL
    for number, (pen, colour, key) in enumerate(rows, start=1):
        place = at - 1j * ROW * height * number
        middle = place + 0.5j * height
        yield Line(middle, middle + sample, pen, colour=colour)
        yield Text(place + sample + height, escape(said[key]), height)
    if marked.answers.told:
        place = at - 1j * ROW * height * (len(rows) + 1)
        yield Circle(place + 0.5 * (sample + 1j * height), SHOWN * height, Pen.MAIN, colour=BLUE)
        yield Text(place + sample + height, escape(said["drawing.told"]), height)
