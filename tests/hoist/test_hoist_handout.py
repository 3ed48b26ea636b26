"""Handouts of hoists: a blank has axes and no result, every step of the note draws its part of a view."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import lru_cache
from itertools import pairwise

import pytest

from kulman.drawing.handouts import begun_pages, begun_stages
from kulman.drawing.notes.blocks import Story
from kulman.drawing.page import Page
from kulman.drawing.shapes import Group, Line, Shape, Text
from kulman.drawing.view import View
from kulman.scales.errors import LANGUAGES
from kulman.scales.packaged import packaged
from kulman.tests.support.cases import draw_case, solve_case
from kulman.variants.case import Case
from kulman.variants.sheets import Sheet

TASK = "karpenko-hoist"
MOVED = {"V_0": "4 m/s"}  # the load comes back on its support


@lru_cache(maxsize=4)
def drawn(variant: str, moved: bool = False, only: str | None = None) -> tuple[Case, Sheet]:
    case = solve_case(TASK, variant, MOVED if moved else None, only, None)
    return case, draw_case(case, "en")


def pages(steps: int, variant: str, moved: bool = False, only: str | None = None) -> list[Page]:
    case, sheet = drawn(variant, moved, only)
    return begun_pages(sheet.pages, sheet.views, case.kind.begun(case, sheet.scales, case.words("en"), steps), steps)


def staged(sheet: Sheet) -> dict[str, View]:
    """Return the views that are drawn in stages, by name."""
    return {view.name: view for view in sheet.views if view.stages}


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
    views = staged(drawn("V04", moved)[1])

    assert views.keys() == {"scheme", "model", "forces", "lift_off", "extremes", "circle", "beams"}
    for name, view in views.items():
        shapes = [
            part
            for part, shape in zip(view.parts, view.shapes, strict=True)
            if not (isinstance(shape, Text) and shape.role == "heading")
        ]
        assert {*shapes} <= {*view.stages}, name
        # a blank may be empty, no formula be valid, and before the lift-off there may be no extreme
        idle = {
            "scheme": {"blank"},
            "model": {"blank"},
            "forces": {"moved"} if moved else set(),
            "extremes": {"crossing"},
        }
        assert {*view.stages} - {*shapes} <= idle.get(name, set()), name
        assert begun_stages(view, 1000).stages == {*view.stages}


@pytest.mark.parametrize("variant", ["V04", *(pytest.param(v, marks=pytest.mark.soak) for v in ("V01", "V03", "V10"))])
def test_every_step_draws_something_more(variant: str) -> None:
    steps_of = {name: len(view.stages) - 1 for name, view in staged(drawn(variant)[1]).items()}
    counts = [count(pages(steps, variant)) for steps in range(1 + max(steps_of.values()))]

    for before, after in pairwise(enumerate(counts)):
        for view, most in steps_of.items():
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
    case, sheet = drawn("V04", moved)
    words, said = case.words(lang), packaged("kulman.drawing.notes", "texts", lang)

    story: Story = case.kind.story(case, {}, words, said)
    keys = set()
    for view in staged(sheet).values():
        sentences = story.steps_of(view)
        assert len({*sentences}) == len(view.stages) - 1
        assert not any("{" in sentence.replace("_{", "").replace("^{", "") for sentence in sentences)
        before, whole = (begun_stages(view, len(sentences) - more) for more in (1, 0))
        assert (before.notes, whole.notes) == (False, True)
        keys |= {*view.stages.values()} - {""}
    kept = {"hoist.forces.moved", "hoist.circle.ends"}  # one of a motion, one of formulas that are valid
    prefixes = tuple(f"hoist.{name}." for name in staged(sheet))
    assert {key for key in said if key.startswith(prefixes)} - keys <= kept
