"""Figures of cams, gears and hoists, drawn by stages: each draws something, handouts grow by them, notes tell them."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from functools import cache, partial
from itertools import chain, pairwise

import pytest

from kulman.drawing.figure import ANSWERS
from kulman.drawing.handouts import _begun_stages, begun_pages
from kulman.drawing.notes.blocks import Story
from kulman.drawing.page import Page
from kulman.drawing.shapes import Group, Shape, Text
from kulman.drawing.view import View
from kulman.scales.errors import LANGUAGES
from kulman.scales.packaged import packaged
from kulman.tests.support.cams import ROCKER, Settings
from kulman.tests.support.cases import draw_case, solve_case, some
from kulman.variants.case import Case
from kulman.variants.sheets import Sheet

Asked = tuple[str, str | None, Settings]
CAM, GEAR, HOIST = "madi-cam", "madi-gear", "karpenko-hoist"
ALL: list[Asked] = [
    (CAM, "17", ()),
    (GEAR, None, ()),
    (HOIST, "V04", ()),
    (HOIST, "V04", (("V_0", "4 m/s"),)),  # the load comes back on its support
    *((HOIST, variant, ()) for variant in ("V01", "V03", "V10")),
    (GEAR, None, (("z_1", "8"), ("z_2", "25"), ("x_1", "0.5"), ("x_2", "0"))),
    (CAM, "17", (("law", "uniform"), ("limits", "two-sided"))),
    (CAM, "17", (("e", "0"), ("rotation", "cw"))),
    (CAM, "17", (("r_0", "50"), ("law", "sine"))),
    (CAM, "17", (("r_0", "50"), ("e", "3"))),
    (CAM, "17", (("r_0_flat", "50"),)),
    (ROCKER, "1", ()),
    (ROCKER, "2", ()),
]
CASES = some([(asked,) for asked in ALL], 0, 1, 2, 3)
FIGURES = {
    CAM: {"diagrams", "sizes", "profile", "plate_sizes", "plate_profile", "pressure"},
    GEAR: {"meshing", "rolling", "action", "sliding"},
    HOIST: {"scheme", "model", "forces", "lift_off", "extremes", "circle", "beams"},
    ROCKER: {"diagrams", "rocker_sizes", "profile", "pressure"},
}
# what may draw nothing: blanks of pictures, no formula that is valid, no extreme before the lift-off
IDLE = {"scheme": {"blank"}, "model": {"blank"}, "forces": {"moved"}, "extremes": {"crossing"}}


@cache
def drawn(asked: Asked) -> tuple[Case, Sheet]:
    task, variant, settings = asked
    case = solve_case(task, variant, dict(settings))
    return case, draw_case(case, "en")


def staged(asked: Asked) -> dict[str, View]:
    """Return the views that are drawn in stages, by name."""
    return {view.name: view for view in drawn(asked)[1].views if view.stages}


def parts(shapes: Iterable[Shape]) -> Iterator[Shape]:
    """Go through all that is drawn, groups themselves, too."""
    for shape in shapes:
        yield shape
        if isinstance(shape, Group):
            yield from parts(shape.shapes)


def count(pages: Iterable[Page]) -> dict[str, int]:
    """Count the shapes of every view."""
    groups = [shape for page in pages for shape in page.shapes if isinstance(shape, Group) and shape.role == "view"]
    return {group.name: sum(1 for _ in parts(group.shapes)) for group in groups}


def begun(asked: Asked, steps: int) -> list[Page]:
    case, sheet = drawn(asked)
    return begun_pages(sheet.pages, sheet.views, case.kind.begun(case, sheet.scales, case.words("en"), steps), steps)


@pytest.mark.parametrize("asked", CASES)
def test_every_part_of_a_view_belongs_to_a_stage_that_draws_something(asked: Asked) -> None:
    lacking = {"plate_sizes", "plate_profile"} if ("law", "uniform") in asked[2] else set()  # no plate follows a jump
    assert staged(asked).keys() == FIGURES[asked[0]] - lacking
    for name, view in staged(asked).items():
        every = zip(view.parts, view.shapes, strict=True)
        own = {part for part, shape in every if not (isinstance(shape, Text) and shape.role == "heading")}
        assert own <= {*view.stages, ANSWERS}, name
        assert {*view.stages} - own <= IDLE.get(name, set()), name
        assert _begun_stages(view, 1000).stages == {*view.stages}
        assert [_begun_stages(view, len(view.stages) - more).notes for more in (2, 1)] == [False, ANSWERS not in own]


@pytest.mark.parametrize("asked", CASES)
def test_every_step_draws_more_of_each_view_that_it_takes_further(asked: Asked) -> None:
    views = staged(asked)
    most = max(len(view.stages) for view in views.values())
    grown, reached = (
        [of(steps) for steps in range(most)] for of in (lambda k: count(begun(asked, k)), partial(done, views))
    )

    assert reached[-1] == {name: len(view.stages) - 1 for name, view in views.items()}
    for name, view in views.items():
        idle = {at for at, stage in enumerate([*view.stages][:-1]) if stage not in view.parts}  # the last brings notes
        for (before, after), (fewer, more) in zip(pairwise(grown), pairwise(reached), strict=True):
            assert (after[name] > before[name]) == bool({*range(fewer[name] + 1, more[name] + 1)} - idle), name


def done(views: Mapping[str, View], steps: int) -> dict[str, int]:
    """How many stages of each view so many steps draw: none before what it takes has been found."""
    found = dict.fromkeys(views, 0)

    def known(
        of: str, stage: str
    ) -> bool:  # what another sheet has is done there, of a stage that is left out all else
        order = [*views[of].stages] if of in views else []
        return not order or found[of] >= (order.index(stage) if stage in order else len(order) - 1)

    for _ in range(steps * len(views)):
        for name, view in views.items():
            following = [*view.stages][found[name] + 1 : steps + 1][:1]
            needs = (need.split(".") for stage in following for need in view.needs.get(stage, ()))
            found[name] += bool(following) and all(known(*need) for need in needs)
    return found


@pytest.mark.parametrize("lang", LANGUAGES)
@pytest.mark.parametrize("asked", CASES)
def test_the_note_tells_each_stage_but_the_first(asked: Asked, lang: str) -> None:
    case, sheet = drawn(asked)
    said = packaged("kulman.drawing.notes", "texts", lang)
    story: Story = case.kind.story(case, sheet.scales, case.words(lang), said)

    told = {name: [*story.steps_of(view)] for name, view in staged(asked).items()}
    assert all(len({*told[name]}) == len(view.stages) - 1 for name, view in staged(asked).items())
    text = " ".join((*story.aims, *chain.from_iterable(told.values()), *story.conclusions))
    assert not re.search(r"(?<![_^])(?<!bar)\{[a-z]\w+\}|\b(nan|inf|None)\b|  ", text), text
    assert bool(re.search("[іїєґ]", text)) == (lang == "uk")
    assert bool(re.search("[ыэъ]", text)) == (lang == "ru")
    assert all(step.endswith((".", ". ")) for steps in told.values() for step in steps)
