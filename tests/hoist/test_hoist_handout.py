"""Handouts of hoists: a blank has axes and no result, every step of the note draws its part of a view."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import lru_cache
from itertools import pairwise

import pytest

from kulman.drawing.handouts.begun import begun_pages
from kulman.drawing.hoist.begun import STAGES
from kulman.drawing.hoist.steps import TOLD
from kulman.drawing.notes.blocks import Story
from kulman.drawing.page import Page
from kulman.drawing.shapes import Group, Line, Shape, Text
from kulman.scales.errors import LANGUAGES
from kulman.scales.packaged import packaged
from kulman.variants.case import Case, solve_case
from kulman.variants.sheets import Sheet, draw_case

TASK = "karpenko-hoist"
MOVED = {"V_0": "4 m/s"}  # the load comes back on its support


@lru_cache(maxsize=4)
def drawn(variant: str, moved: bool = False, only: str | None = None) -> tuple[Case, Sheet]:
    case = solve_case(TASK, variant, MOVED if moved else None, only, None)
    return case, draw_case(case, {}, lang="en")


def pages(steps: int, variant: str, moved: bool = False, only: str | None = None) -> list[Page]:
    case, sheet = drawn(variant, moved, only)
    return begun_pages(sheet.pages, sheet.views, case.kind.begun(case, sheet.scales, case.words("en"), steps))


def parts(shapes: Iterable[Shape]) -> Iterator[Shape]:
    for shape in shapes:
        yield shape
        if isinstance(shape, Group):
            yield from parts(shape.shapes)


def count(found: Iterable[Page]) -> dict[str, int]:
    """Count the shapes of every view."""
    groups = [shape for page in found for shape in page.shapes if isinstance(shape, Group) and shape.role == "view"]
    return {group.name: sum(1 for _ in parts(group.shapes)) for group in groups}


def texts(found: Iterable[Page]) -> list[str]:
    return [shape.markup for page in found for shape in parts(page.shapes) if isinstance(shape, Text)]


@pytest.mark.parametrize("moved", [False, pytest.param(True, marks=pytest.mark.soak)])
def test_steps_draw_all_parts_of_views_and_no_others(moved: bool) -> None:
    case, sheet = drawn("V04", moved)
    views = {view.name: view for view in sheet.views}

    for name, table in STAGES.items():
        said = [part for stage in table for part in stage]
        shapes = [
            part
            for part, shape in zip(views[name].parts, views[name].shapes, strict=True)
            if not (isinstance(shape, Text) and shape.role == "heading")
        ]
        assert len(said) == len({*said})
        assert {*shapes} <= {*said}, name
        missing = {*said} - {*shapes}  # before the lift-off there may be no extreme, and so no points beside it
        assert missing <= ({"crossing", "points"} if name == "extremes" else set()), name
    whole = case.kind.begun(case, sheet.scales, case.words("en"), 1000)
    assert {name: shown.parts for name, shown in whole.items() if shown.parts is not None} == {
        name: frozenset(part for stage in table for part in stage) for name, table in STAGES.items()
    }


@pytest.mark.parametrize("variant", ["V04", *(pytest.param(v, marks=pytest.mark.soak) for v in ("V01", "V03", "V10"))])
def test_every_step_draws_something_more(variant: str) -> None:
    counts = [count(pages(steps, variant)) for steps in range(1 + max(TOLD.values()))]

    for before, after in pairwise(enumerate(counts)):
        for view, most in TOLD.items():
            assert (after[1][view] > before[1][view]) == (after[0] <= most), (view, after[0])


def test_a_blank_has_axes_and_no_result() -> None:
    case, _ = drawn("V04")
    blank = pages(0, "V04")
    said = texts(blank)

    results = case.solved.quantities
    for name in ("t_1", "T_1", "P_12_max", "F_12_t1", "C_01", "C_12", "k", "R"):
        number = case.words("en").number(abs(results[name].value or 0.0), 3)[:5].rstrip(".")
        assert not [text for text in said if f"= {number}" in text or text == number], name
    assert not {"satisfied", "not satisfied"} & {*said}
    assert {"t, s", "F, N", "P_{12}, N"} <= {*said}
    roles = {shape.role for page in blank for shape in parts(page.shapes) if isinstance(shape, Line)}
    assert {"axis", "division"} <= roles
    assert not {"level", "time", "projection", "deflection"} & roles


def test_the_table_of_results_keeps_symbols_and_units_in_both_halves() -> None:
    rows = next(view for view in drawn("V04")[1].views if view.name == "results").rows
    said = {*texts(pages(0, "V04"))}

    assert rows[0][:3] == rows[0][3:]
    for row in rows[1:]:
        assert {row[0], row[3], row[2], row[5]} - {""} <= said
        assert not ({row[1], row[4]} & said) - {"0", "1", "1.25"}, row


@pytest.mark.parametrize("lang", LANGUAGES)
@pytest.mark.parametrize("moved", [False, True])
def test_the_note_tells_as_many_steps_as_a_handout_has(lang: str, moved: bool) -> None:
    case = solve_case(TASK, "V04", MOVED if moved else None, None, None)
    words, said = case.words(lang), packaged("kulman.drawing.notes", "texts", lang)

    story: Story = case.kind.story(case, {}, words, said)
    for view, sentences in story.steps.items():
        before, whole = (case.kind.begun(case, {}, words, len(sentences) - more)[view] for more in (1, 0))
        assert before.parts is not None
        assert whole.parts is not None
        assert whole.parts == {part for stage in STAGES[view] for part in stage}
        assert before.parts < whole.parts or view == "extremes"
        assert (before.notes, whole.notes) == (False, True)
    assert not [key for view, n in TOLD.items() for key in said if key == f"hoist.{view}.{n + 1}"]
