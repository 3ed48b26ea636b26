"""Notes and handouts of hoists: every step draws its part of a view, formulas with their numbers give the results."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from functools import lru_cache, partial
from itertools import chain, pairwise

import pytest

from kulman import note
from kulman.drawing.handouts import _begun_stages, begun_pages
from kulman.drawing.hoist.text import BENT, BY_DRAWING, HANGING, REDUCED, SLACK, STARTED
from kulman.drawing.notes.blocks import Equations, Steps, Story
from kulman.drawing.page import Page
from kulman.drawing.shapes import Group, Line, Shape, Text
from kulman.drawing.view import View
from kulman.plans.hoist.forces import forces
from kulman.plans.laws import form_of
from kulman.scales.errors import LANGUAGES
from kulman.scales.packaged import packaged
from kulman.tests.support.cases import draw_case, solve_case
from kulman.variants.case import Case
from kulman.variants.sheets import Sheet

TASK = "karpenko-hoist"
MOVED = {"V_0": "4 m/s"}  # the load comes back on its support


@lru_cache(maxsize=4)
def drawn(variant: str, moved: bool = False) -> tuple[Case, Sheet]:
    case = solve_case(TASK, variant, MOVED if moved else None)
    return case, draw_case(case, "en")


def pages(steps: int, variant: str) -> list[Page]:
    case, sheet = drawn(variant)
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


def texts(found: Iterable[Page]) -> set[str]:
    return {shape.markup for page in found for shape in parts(page.shapes) if isinstance(shape, Text)}


@pytest.mark.parametrize("moved", [False, pytest.param(True, marks=pytest.mark.soak)])
def test_steps_draw_all_parts_of_views_and_no_others(moved: bool) -> None:
    views = staged(drawn("V04", moved)[1])
    # a blank may be empty, no formula be valid, and before the lift-off there may be no extreme
    idle = {"scheme": {"blank"}, "model": {"blank"}, "forces": {"moved"} if moved else set(), "extremes": {"crossing"}}

    assert views.keys() == {"scheme", "model", "forces", "lift_off", "extremes", "circle", "beams"}
    for name, view in views.items():
        every = zip(view.parts, view.shapes, strict=True)
        own = {part for part, shape in every if not (isinstance(shape, Text) and shape.role == "heading")}
        assert own <= {*view.stages}, name
        assert {*view.stages} - own <= idle.get(name, set()), name
        assert _begun_stages(view, 1000).stages == {*view.stages}


@pytest.mark.parametrize("variant", ["V04", *(pytest.param(v, marks=pytest.mark.soak) for v in ("V01", "V03", "V10"))])
def test_every_step_draws_something_more(variant: str) -> None:
    views = staged(drawn(variant)[1])
    most = max(len(view.stages) for view in views.values())
    counts, reached = (
        [of(steps) for steps in range(most)] for of in (lambda k: count(pages(k, variant)), partial(done, views))
    )

    assert reached[-1] == {name: len(view.stages) - 1 for name, view in views.items()}
    for view in views:
        grows = [after[view] > before[view] for before, after in pairwise(counts)]
        assert grows == [after[view] > before[view] for before, after in pairwise(reached)], view


def done(views: Mapping[str, View], steps: int) -> dict[str, int]:
    """How many stages of each view so many steps draw: none before what it takes has been found."""
    found = dict.fromkeys(views, 0)
    for _ in range(steps * len(views)):
        for name, view in views.items():
            following = [*view.stages][found[name] + 1 : steps + 1][:1]
            needs = (need.split(".") for stage in following for need in view.needs.get(stage, ()))
            if following and all([*views[of].stages].index(stage) <= found[of] for of, stage in needs):
                found[name] += 1
    return found


def test_a_blank_has_axes_symbols_and_units_but_no_result() -> None:
    case, sheet = drawn("V04")
    blank = pages(0, "V04")
    said, results = texts(blank), case.solved.quantities
    for name in ("t_1", "T_1", "P_12_max", "F_12_t1", "C_01", "C_12", "k", "R"):
        number = case.words("en").number(abs(results[name].value or 0.0), 3)[:5].rstrip(".")
        assert not [text for text in said if f"= {number}" in text or text == number], name
    assert not {"satisfied", "not satisfied"} & said
    assert {"t, s", "F, N", "P_{12}, N"} <= said
    roles = {shape.role for page in blank for shape in parts(page.shapes) if isinstance(shape, Line)}
    assert {"axis", "division"} <= roles
    assert not {"level", "time", "projection", "deflection"} & roles
    head, *rows = next(view for view in sheet.views if view.name == "results").rows
    assert head[:3] == head[3:]
    for row in rows:  # symbol, number, unit, twice
        assert {row[0], row[3], row[2], row[5]} - {""} <= said
        assert not ({row[1], row[4]} & said) - {"0", "1", "1.25"}, row


@pytest.mark.parametrize("lang", LANGUAGES)
@pytest.mark.parametrize("moved", [False, True])
def test_the_note_tells_as_many_steps_as_a_handout_has(lang: str, moved: bool) -> None:
    case, sheet = drawn("V04", moved)
    said = packaged("kulman.drawing.notes", "texts", lang)

    story: Story = case.kind.story(case, {}, case.words(lang), said)
    keys = set()
    for view in staged(sheet).values():
        sentences = story.steps_of(view)
        assert len({*sentences}) == len(view.stages) - 1
        assert not any("{" in sentence.replace("_{", "").replace("^{", "") for sentence in sentences)
        before, whole = (_begun_stages(view, len(sentences) - more) for more in (1, 0))
        assert (before.notes, whole.notes) == (False, True)
        keys |= {*view.stages.values()} - {""}
    kept = {"hoist.forces.moved", "hoist.circle.ends"}  # one of a motion, one of formulas that are valid
    prefixes = tuple(f"hoist.{name}." for name in staged(sheet))
    assert {key for key in said if key.startswith(prefixes)} - keys <= kept


@pytest.mark.parametrize("variant", ["V01", "V03", "V04", "V09", "V10"])
def test_expressions_that_are_printed_give_the_results(variant: str) -> None:
    solved = solve_case(TASK, variant, {"slack": "0.03 m"}).solved
    found = dict(forces(solved.givens).found)
    for told in (*REDUCED, SLACK, *STARTED, *HANGING, *BENT):
        step = solved.program.by_name[told]
        law, names = BY_DRAWING.get(told) or (step.law, step.operands)
        value = form_of(law)(*(found[name] for name in names))
        assert value == pytest.approx(found[told], rel=1e-12, abs=1e-300), told


def test_what_a_hoist_has_not_is_not_told() -> None:
    def told(variant: str, **settings: str) -> str:
        blocks = note(TASK, variant, set=settings, lang="en").document.blocks
        lines = chain.from_iterable(block.lines for block in blocks if isinstance(block, Equations))
        steps = chain.from_iterable(block.texts for block in blocks if isinstance(block, Steps))
        return "\n".join([*map(" ".join, lines), *steps])

    rigid, moved, slack = told("V03", I_0="inf", I_2="inf"), told("V04", V_0="4 m/s"), told("V03", slack="0.03 m")
    assert "C_{01} = 3·E_{0}·I_{0}·α_{0}/l_{0}^{3} = ∞ N/m [1, (5)]" in rigid
    assert not [word for word in ("nan", "inf", "w_{0 max}", "V_{t} = √(") if word in rigid]
    assert "V_{t} = √(" in slack
    assert "The closed formulas are not valid here" in moved
    assert "P_{12 max} = P_{m} + R" not in moved
    assert "(11)" not in moved.partition("Divide")[0]
