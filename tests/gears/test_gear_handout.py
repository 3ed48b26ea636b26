"""Handouts and notes of gears: a blank tells nothing that is to be found, every stage draws something and is told."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from itertools import pairwise

import pytest

from kulman import handout, note, solve
from kulman.drawing.figure import ANSWERS
from kulman.drawing.handouts import begun_pages
from kulman.drawing.notes.blocks import Steps
from kulman.drawing.page import Page
from kulman.drawing.shapes import Group, Line, Shape, Text
from kulman.drawing.view import View
from kulman.scales.errors import LANGUAGES
from kulman.scales.packaged import packaged
from kulman.scales.scale import Scale
from kulman.tests.support.cases import draw_case, solve_case
from kulman.variants.sheets import Sheet

TASK = "madi-gear"


def parts(shapes: Iterable[Shape]) -> Iterator[Shape]:
    for shape in shapes:
        yield shape
        if isinstance(shape, Group):
            yield from parts(shape.shapes)


def texts(sheet: Sheet) -> list[str]:
    return [
        text.markup
        for page in sheet.pages
        for view in page.shapes
        if isinstance(view, Group) and view.role == "view"
        for text in parts(view.shapes)
        if isinstance(text, Text)
    ]


@pytest.mark.parametrize(
    "only",
    ["sliding", "geometry", pytest.param(None, marks=pytest.mark.soak)],
)
def test_a_blank_tells_what_is_given_and_no_result(only: str | None) -> None:
    said = texts(handout(TASK, only=only, lang="en"))

    results = solve(TASK, only=only)
    assert only == "sliding" or {"5", "20", "0.85", "0.2", "15"} <= set(said)
    for name in ("a_w", "d_a1", "d_w2", "s_1", "h", "p_b", "rho_p1"):
        number = f"{(results[name].value or 0.0) * 1e3:.2f}"
        assert not any(number in text for text in said), name
    assert not any("1.20" in text or "26.65" in text or "−3.07" in text or "satisfied" in text for text in said)


@pytest.mark.parametrize("only", ["sliding", pytest.param("meshing", marks=pytest.mark.soak)])
def test_every_stage_draws_something_more(only: str) -> None:
    case = solve_case(TASK, None, None, only, None)
    drawn = draw_case(case, "en")
    most = max(len(view.stages) for view in drawn.views)

    def count(pages: Iterable[Page]) -> int:
        return sum(1 for page in pages for _ in parts(page.shapes))

    counts = []
    for steps in range(most):
        shown = case.kind.begun(case, drawn.scales, case.words("en"), steps)
        counts.append(count(begun_pages(drawn.pages, drawn.views, shown, steps)))

    assert all(a < b for a, b in pairwise(counts))
    assert counts[-1] < count(drawn.pages)


PAIRS = ({}, {"z_1": 40, "z_2": 60, "x_1": 0, "x_2": 0}, {"z_1": 8, "z_2": 25, "x_1": 0.5, "x_2": 0})
# what a mark that has no shape of its own is drawn with
DRAWN_BY = (
    (r"meshing\.C_([af][12])", r"d_\1"),
    (r"meshing\.[MRS]([12])_[123]", r"teeth_\1"),
    (r"meshing\.B[12]_(start|end)", r"\1_1"),
    (r"meshing\.O([12])", r"O\1"),
    (r"sliding\.V([12])_(\d\d)", r"y_\1_\2"),
    (r"sliding\.(\d\d)", r"y_1_\1"),
    (r"theta\.T(12|21)_(\d\d)", r"theta_\1_\2"),
    (r"theta\.(\d\d)", r"theta_12"),
    (r"(?:meshing|sliding|theta)\.(\w+)", r"\1"),
)

CUT_OFF = {"theta.T21_10", "theta.T21_11", "theta.T12_02"}  # so far below that the diagram ends before


def shown(views: Iterable[View]) -> set[str]:
    """Return the names of what is drawn in a stage of any view."""
    staged = [view for view in views if view.stages]
    drawn = [shape for view in staged for shape, stage in zip(view.shapes, view.parts, strict=True) if stage != ANSWERS]
    return {getattr(part, "name", "") for part in parts(drawn)}


def test_stages_draw_something_and_leave_what_the_work_comes_to() -> None:
    case = solve_case(TASK, None, None, None, None)
    views = [view for view in draw_case(case, "en").views if view.stages]

    assert [view.name for view in views] == ["meshing", "rolling", "action", "sliding"]
    for view in views:
        assert {*view.stages} <= {*view.parts} <= {*view.stages, ANSWERS, ""}, view.name
        answers = [shape for shape, part in zip(view.shapes, view.parts, strict=True) if part == ANSWERS]
        numbers = [text.markup for text in answers if isinstance(text, Text) and "=" in text.markup]
        assert all(stage != ANSWERS for stage in view.stages)
        assert numbers, view.name
        left = [shape for shape, part in zip(view.shapes, view.parts, strict=True) if part in view.stages]
        assert not [t.markup for t in left if isinstance(t, Text) and "=" in t.markup and t.role != "diameter"]


@pytest.mark.parametrize("others", [PAIRS[0], *(pytest.param(pair, marks=pytest.mark.soak) for pair in PAIRS[1:])])
def test_every_mark_of_the_construction_has_its_stage(others: dict[str, float]) -> None:
    case = solve_case(TASK, None, {name: str(value) for name, value in others.items()}, None, None)
    said = shown(draw_case(case, "en").views)

    program = case.solved.program
    marks = [step.name for plan in ("meshing", "sliding", "theta") for step in program.on(plan)]
    assert len(marks) > 100
    undercut = ["meshing.H1"] if others == PAIRS[2] else []  # the rack's edge leaves the line of action beyond N1
    missing = [mark for mark in marks if drawn_by(mark) not in said]
    assert missing[: len(undercut)] == undercut
    assert {*missing[len(undercut) :]} == CUT_OFF


def drawn_by(mark: str) -> str:
    """Return the name of what shows a mark."""
    pattern, name = next((pattern, name) for pattern, name in DRAWN_BY if re.fullmatch(pattern, mark))
    return re.sub(pattern, name, mark)


@pytest.mark.parametrize("lang", LANGUAGES)
def test_note_tells_as_many_steps_as_a_handout_has_stages(lang: str) -> None:
    case = solve_case(TASK, None, None, None, None)
    scales = {"meshing": Scale("mu_l", 0.0005, "m")}
    words = case.words(lang)

    story = case.kind.story(case, scales, words, packaged("kulman.drawing.notes", "texts", lang))

    views = [view for view in draw_case(case, lang).views if view.stages]
    assert all(len(story.steps_of(view)) == len(view.stages) - 1 for view in views)
    assert {key for view in views for key in view.stages.values()} - {""} == {
        key for key in story.texts if re.match(r"gear\.(meshing|rolling|action|sliding)\.", key)
    }
    said = " ".join(step for view in views for step in story.steps_of(view))
    assert words.number(78.857, 1) in said  # d_w1 / 2 at 2:1
    assert words.number(35.568, 1) in said  # the active line on paper
    assert f"{words.number(26.65, 2)}°" in said


def test_letters_on_leaders_keep_them_on_a_blank() -> None:
    pages = handout(TASK, only="meshing", lang="en").pages
    leaders = [line.name for page in pages for line in parts(page.shapes) if getattr(line, "role", "") == "leader"]

    assert "P" in leaders
    assert {*leaders} <= {"P", "O_{1}", "O_{2}"}


def test_no_leader_of_a_begun_sheet_ends_at_nothing() -> None:
    shapes = [shape for page in handout(TASK, steps=2, only="meshing").pages for shape in parts(page.shapes)]
    texts = [shape for shape in shapes if isinstance(shape, Text)]
    leaders = {shape.name for shape in shapes if isinstance(shape, Line) and shape.role == "leader"}

    assert {"d_w1", "d_w2", "P"} <= leaders
    assert leaders <= {name for text in texts for name in (text.name, text.markup)}


@pytest.mark.parametrize("language", LANGUAGES)
def test_what_is_laid_off_is_told_on_paper_and_as_it_is(language: str) -> None:
    written = note(TASK, lang=language)
    steps = [text for block in written.document.blocks if isinstance(block, Steps) for text in block.texts]

    laid_off = [
        pair for text in steps for pair in re.findall(r"([\d.,]+) (?:mm|мм) \(\S+ = ([\d.,]+) (?:mm|мм)\)", text)
    ]
    assert len(laid_off) == 8  # s_1, s_2, p, rho_f, p_b, l_N1N2, twice the active line
    for paper, length in laid_off:
        drawn, real = (float(text.replace(",", ".")) for text in (paper, length))
        assert drawn == pytest.approx(5.0 * real, abs=0.05 + 5.0 * 0.005)  # M 5:1, as they are rounded
