"""Prints of handouts, read back from their PDF: paper, rulers, frames, tiles, key and transparencies on the blank."""

from __future__ import annotations

from collections.abc import Iterable
from functools import lru_cache
from io import BytesIO
from typing import Any

import pytest

from kulman import handout
from kulman.drawing.formats import FORMATS
from kulman.drawing.page import extent
from kulman.drawing.pdf import MARGIN, tiles, write_tiles
from kulman.drawing.pdf import write as write_pdf
from kulman.drawing.shapes import Group, Shape
from kulman.tests.support.prints import Print, Stroke, farthest, prints
from kulman.variants.sheets import Sheet

COINCIDES = 0.01  # mm
FIGURES = 3  # of a sheet that are laid over it: each is drawn with its whole sheet
FEW = {"nau-slider-crank": "velocity", "madi-cam": "pressure", "madi-gear": "sliding", "karpenko-hoist": "scheme"}


def tasks(*few: str) -> list[Any]:
    """Return tasks of some kinds with one plan each; for the soak whole sheets of every kind."""
    whole = [(task, None) for task in (*FEW, "bertyaev-six-bar", "scheme-20-press-automaton")]
    return [*((task, FEW[task]) for task in few), *(pytest.param(*one, marks=pytest.mark.soak) for one in whole)]


@lru_cache(maxsize=16)
def printed(task: str, only: str | None, **how: Any) -> tuple[Sheet, tuple[Print, ...]]:
    drawn = handout(task, only=only, **how)
    stream = BytesIO()
    write_pdf(drawn.pages, stream)
    return drawn, tuple(prints(stream.getvalue()))


def ruler(page: Print, along: complex) -> tuple[Stroke, list[float]]:
    """Return the ruler of a print, and where on it the marks stand, mm."""
    base = next(line for line in page.straight(along) if is_ruler(page, line, along))
    ends = [(end - base[0]) / along for line in page.straight(1j if along == 1 else 1) for end in line]
    marks = [end for end in ends if abs(end.imag) < 1e-3]
    places = sorted({round(float(mark.real), 3) for mark in marks})
    return base, [place for place in places if -1.0 < place < 101.0]


def is_ruler(page: Print, line: Stroke, along: complex) -> bool:
    """Whether a line of 100 mm stands in the margin below or on the left."""
    beside = line[0].imag if along == 1 else line[0].real
    return abs(abs(line[1] - line[0]) - 100.0) < 0.05 and beside < 14.0


@pytest.mark.parametrize(("task", "only"), tasks("nau-slider-crank"))
def test_a_print_has_the_size_of_its_paper_and_rulers_of_100_mm(task: str, only: str | None) -> None:
    drawn, pages = printed(task, only)

    paper = FORMATS[drawn.format]
    assert len(pages) == len(drawn.pages)
    for page in pages:
        assert (page.width, page.height) == pytest.approx((paper.width, paper.height), abs=COINCIDES)
        for along in (1, 1j):
            line, marks = ruler(page, along)
            assert abs(line[1] - line[0]) == pytest.approx(100.0, abs=COINCIDES)
            assert marks == pytest.approx([5.0 * k for k in range(21)], abs=COINCIDES)


@pytest.mark.parametrize("format", ["A4", pytest.param("A3", marks=pytest.mark.soak)])
def test_the_frame_keeps_the_margin_that_printers_need(format: str) -> None:
    _, pages = printed("nau-slider-crank", "velocity", format=format)

    for page in pages:
        boxes = [(min(s.real), min(s.imag), max(s.real), max(s.imag)) for s in page.strokes if len(s) > 2]
        large = sorted((box for box in boxes if box[2] - box[0] > 0.8 * page.width), key=lambda box: box[0])
        edge, (x0, y0, x1, y1), *_ = large  # the paper's own edge, then the frame
        assert edge == pytest.approx((0.0, 0.0, page.width, page.height), abs=COINCIDES)
        assert min(x0, y0, page.width - x1, page.height - y1) >= 8.0 - COINCIDES


@pytest.mark.parametrize(("task", "only"), tasks("nau-slider-crank", "karpenko-hoist"))
def test_the_key_on_top_of_a_blank_coincides(task: str, only: str | None) -> None:
    _, blank = printed(task, only)
    _, key = printed(task, only, key=True)

    assert len(blank) == len(key)
    for page, whole in zip(blank, key, strict=True):
        assert (page.width, page.height) == (whole.width, whole.height)
        assert farthest(page.strokes, whole.strokes) <= COINCIDES
    assert sum(len(page.strokes) for page in key) > sum(len(page.strokes) for page in blank)


@pytest.mark.parametrize(("task", "only"), tasks("nau-slider-crank"))
def test_a_transparency_coincides_with_the_key(task: str, only: str | None) -> None:
    drawn, pages = printed(task, only, key=True)

    placed = {
        shape.name: (shape.shapes, page)
        for drawing, page in zip(drawn.pages, pages, strict=True)
        for shape in drawing.shapes
        if isinstance(shape, Group) and shape.role == "view"
    }
    for view in [view for view in drawn.views if not (view.rows or view.lines)][:FIGURES]:
        over, (alone,) = printed(task, only, over=view.name)
        shapes, page = placed[view.name]
        shift = corner(shapes) - corner(shape for shape in over.pages[0].shapes if not is_a_ruler(shape))
        own = [stroke for stroke in alone.strokes if not in_margin(stroke)]
        assert len(own) > 4
        assert farthest((stroke + shift for stroke in own), page.strokes) <= COINCIDES
        assert ruler(alone, 1)[1] == pytest.approx([5.0 * k for k in range(21)], abs=COINCIDES)


def corner(shapes: Iterable[Shape]) -> complex:
    x, y, *_ = extent(tuple(shapes))
    return complex(x, y)


def is_a_ruler(shape: Shape) -> bool:
    return isinstance(shape, Group) and shape.role == "ruler"


def in_margin(stroke: Stroke) -> bool:
    """Whether a stroke belongs to the rulers, which stand in the margins below and on the left."""
    return bool(stroke.imag.max() < 14.0 or stroke.real.max() < 20.0)


@pytest.mark.parametrize("format", ["A3", pytest.param("A1", marks=pytest.mark.soak)])
def test_tiles_join_to_the_sheet(format: str) -> None:
    drawn, (page,) = printed("nau-slider-crank", "velocity", format=format)
    stream = BytesIO()
    write_tiles(drawn.pages, stream)

    parts = prints(stream.getvalue())
    windows = [tile.window for tile in tiles(drawn.pages[0])]
    assert len(parts) == len(windows) > 1
    for part, (x0, _, x1, y1) in zip(parts, windows, strict=True):
        assert (part.width, part.height) == pytest.approx((210.0, 297.0), abs=COINCIDES)
        assert x1 - x0 <= 210.0 - 2 * MARGIN
        top = complex(x0 - MARGIN, y1 - (part.height - MARGIN))  # tiles hang from their upper left corner
        assert farthest(page.strokes, [stroke + top for stroke in part.strokes]) <= COINCIDES
    assert (min(w[0] for w in windows), min(w[1] for w in windows)) == (0.0, 0.0)
    assert max(w[2] for w in windows) == pytest.approx(page.width)
    assert max(w[3] for w in windows) == pytest.approx(page.height)
