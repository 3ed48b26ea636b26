"""Handouts and notes of gears: a blank tells nothing that is to be found, every stage draws something and is told."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import pairwise

import pytest

from kulman import handout, solve
from kulman.drawing.gears.begun import STAGES
from kulman.drawing.handouts.begun import begun_pages
from kulman.drawing.page import Page
from kulman.drawing.shapes import Group, Shape, Text
from kulman.scales.errors import LANGUAGES
from kulman.scales.packaged import packaged
from kulman.scales.scale import Scale
from kulman.variants.case import solve_case
from kulman.variants.sheets import Sheet, draw_case

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
    drawn = draw_case(case, {}, lang="en")
    views = [view.name for view in drawn.views if view.name in STAGES]
    most = max(len(STAGES[name]) for name in views)

    def count(pages: Iterable[Page]) -> int:
        return sum(1 for page in pages for _ in parts(page.shapes))

    counts = []
    for steps in range(most):
        shown = case.kind.begun(case, drawn.scales, case.words("en"), steps)
        counts.append(count(begun_pages(drawn.pages, drawn.views, shown)))

    assert all(a < b for a, b in pairwise(counts))
    assert counts[-1] < count(drawn.pages)


@pytest.mark.parametrize("lang", LANGUAGES)
def test_note_tells_as_many_steps_as_a_handout_has_stages(lang: str) -> None:
    case = solve_case(TASK, None, None, None, None)
    scales = {"meshing": Scale("mu_l", 0.0005, "m")}
    words = case.words(lang)

    story = case.kind.story(case, scales, words, packaged("kulman.drawing.notes", "texts", lang))

    assert {view: len(steps) for view, steps in story.steps.items()} == {
        view: len(STAGES[view]) - 1 for view in story.steps
    }
    said = " ".join(step for steps in story.steps.values() for step in steps)
    assert words.number(78.857, 1) in said  # d_w1 / 2 at 2:1
    assert words.number(35.568, 1) in said  # the active line on paper
    assert f"{words.number(26.65, 2)}°" in said


def test_letters_on_leaders_keep_them_on_a_blank() -> None:
    pages = handout(TASK, only="meshing", lang="en").pages
    leaders = [line.name for page in pages for line in parts(page.shapes) if getattr(line, "role", "") == "leader"]

    assert "P" in leaders
    assert {*leaders} <= {"P", "O_{1}", "O_{2}"}
