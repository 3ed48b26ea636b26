"""The work on a cam step by step: stages are those of the construction and of the sheet, sentences have its numbers."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path
from typing import Any

import pytest

from kulman.drawing.cams.sheet import CamFitting
from kulman.drawing.figure import Figure, SheetContents, _family
from kulman.drawing.formats import FORMATS
from kulman.drawing.handouts import begun_pages
from kulman.drawing.notes.blocks import Story
from kulman.drawing.shapes import Group, Text
from kulman.drawing.view import View
from kulman.plans.cams.cam import PLANS
from kulman.plans.cams.solve import SolvedCam, rules_of
from kulman.scales.packaged import packaged
from kulman.tests.support.cams import ROCKER, Settings
from kulman.tests.support.cases import draw_case, solve_case
from kulman.tests.support.shapes import leaves
from kulman.tests.support.task_files import task_of
from kulman.variants.case import Case
from kulman.variants.sheets import Sheet

TASK = "madi-cam"
CASES: tuple[tuple[str, str, Settings], ...] = (
    (TASK, "17", ()),
    (TASK, "17", (("law", "uniform"), ("limits", "two-sided"))),
    (TASK, "17", (("e", "0"), ("rotation", "cw"))),
    (TASK, "17", (("r_0", "50"), ("law", "sine"))),
    (TASK, "17", (("r_0", "50"), ("e", "3"))),
    (TASK, "17", (("r_0_flat", "50"),)),
    (ROCKER, "1", ()),
    (ROCKER, "2", ()),
)
DRAWN = [CASES[0], *(pytest.param(case, marks=pytest.mark.soak) for case in CASES[1:])]
# marks that are drawn along with those of a stage
BESIDE = (
    (r"diagram_[av]\.#", "axes"),
    (r"diagram_[av]\.O", "axes"),
    (r"diagram_[av]\.f#", "sections"),
    (r"sizes\.#_fall", "points"),
    (r"plate_sizes\.#_after", "points"),
)
PRODUCT = re.compile(r"= ([\d.]+)·([\d.]+) = ([\d.]+) m\b")


@cache
def solved(task: str, variant: str, settings: Settings) -> Case:
    return solve_case(task, variant, dict(settings))


def tables(case: Case) -> dict[str, tuple[Figure[Any], Any]]:
    """Return the figures that are drawn in stages, each with its scene, by name."""
    contents = SheetContents(cam(case), case.plans, case.choosers, case.givens, case.words("en"))
    fitting = CamFitting(contents)
    scene = fitting.scene(FORMATS["A1"], fitting.wanted)
    return {figure.name: (figure, scene) for figure in fitting.figures(scene, 200.0) if figure.stages}


def stages(case: Case) -> dict[str, tuple[str, ...]]:
    """Return the stages that the views of a case have, in order."""
    return {name: tuple(figure.keys(scene)) for name, (figure, scene) in tables(case).items()}


@cache
def drawn(task: str, variant: str, settings: Settings) -> Sheet:
    return draw_case(solved(task, variant, settings), "en")


def cam(case: Case) -> SolvedCam:
    assert isinstance(case.solved, SolvedCam)
    return case.solved


def told(case: Case, lang: str = "en") -> Story:
    _, scales = case.kind.first_scales(case.solved, case.choosers, case.plans)
    return case.kind.story(case, scales, case.words(lang), packaged("kulman.drawing.notes", "texts", lang))


def said(case: Case, story: Story) -> str:
    return " ".join(
        [*story.aims, *(text for steps in sentences(case, story).values() for text in steps), *story.conclusions]
    )


def sentences(case: Case, story: Story) -> dict[str, list[str]]:
    """Return what is told of every view."""
    views = (View(name, (), (0.0, 0.0, 0.0, 0.0), stages=f.keys(scene)) for name, (f, scene) in tables(case).items())
    return {view.name: [*story.steps_of(view)] for view in views}


@pytest.mark.parametrize("case", CASES)
def test_every_mark_of_the_construction_has_its_stage(case: tuple[str, str, Settings]) -> None:
    found = {stage.marks for figure, _ in tables(solved(*case)).values() for stage in figure.stages}

    program = solved(*case).solved.program
    marks = {_family(step.name) for step in program if "." in step.name}
    assert len(marks) >= 15
    assert not [mark for mark in marks if mark not in found and not any(re.fullmatch(p, mark) for p, _ in BESIDE)]
    known = {part for parts in stages(solved(*case)).values() for part in parts}
    assert {part for _, part in BESIDE} <= known | {"points"}


@pytest.mark.parametrize("case", CASES)
def test_stages_stand_in_the_order_of_the_construction(case: tuple[str, str, Settings]) -> None:
    firsts: dict[tuple[str, str], int] = {}
    for k, step in enumerate(solved(*case).solved.program):
        for verb in ("", step.verb):
            firsts.setdefault((_family(step.name), verb), k)
    for name, (figure, scene) in tables(solved(*case)).items():
        own = [stage for stage in figure.stages if stage.marks and stage.name in figure.keys(scene)]
        places = [firsts[stage.marks, stage.verb] for stage in own[1:]]  # the first is there before any step
        assert places == sorted(places), name


@pytest.mark.parametrize("case", CASES)
def test_what_is_read_from_a_plan_recomputes(case: tuple[str, str, Settings]) -> None:
    products = PRODUCT.findall(said(solved(*case), told(solved(*case))))

    assert products or {"r_0", "l_OC"} & dict(case[2]).keys()
    for segment, mu, value in products:
        half = 0.5 * 10.0 ** -len(value.partition(".")[2])
        assert float(segment) * float(mu) == pytest.approx(float(value), abs=1.001 * half)


@pytest.mark.parametrize("case", CASES)
def test_circles_are_drawn_with_the_radii_that_were_found(case: tuple[str, str, Settings]) -> None:
    found = cam(solved(*case))
    told_of = re.findall(
        r"circles? with the radi(?:us|i) (.+?)(?:;|\.(?!\d))", said(solved(*case), told(solved(*case)))
    )

    first = {"r_{0}": found.rolling.sizes.r_0} if found.rolling else {}
    if found.rocker:
        first["l_{OC}"] = found.values["l_OC"]
    elif found.roller and abs(found.roller.sizes.e) > 1e-9:
        first["e"] = abs(found.roller.sizes.e)
    expected = [first, *([{"r_{0 pl}": found.plate.profile.r_0}] if found.plate else [])]
    assert len(told_of) == len(expected)
    for told_radii, radii in zip(told_of, expected, strict=True):
        pairs = re.findall(r"(\S+(?: pl\})?) = ([\d.]+) mm", told_radii)
        assert [name for name, _ in pairs] == [*radii]
        assert [float(mm) for _, mm in pairs] == pytest.approx([1e3 * radius for radius in radii.values()], abs=0.0051)


@pytest.mark.parametrize("task", [TASK, pytest.param(ROCKER, marks=pytest.mark.soak)])
def test_parts_of_the_work_are_told_alone(task: str) -> None:
    every = solve_case(task)
    whole = told(every)
    steps = sentences(every, whole)

    for only in PLANS:
        case = solve_case(task, only=only)
        story = told(case)
        assert sentences(case, story).items() <= steps.items()
        assert {*story.conclusions} <= {*whole.conclusions}


def test_sizes_that_are_all_given_are_marked_and_not_sought() -> None:
    text = Path(ROCKER).read_text(encoding="utf-8").replace("[givens]\n", '[givens]\nr_0 = { unit = "mm" }\n')

    case = solve_case(task_of(text), "2", {"r_0": "60"})

    steps = sentences(case, told(case))["rocker_sizes"]
    assert any("given sizes l_{OC} = 130 mm, r_{0} = 60 mm" in sentence for sentence in steps)


@pytest.mark.parametrize(
    ("name", "settings", "key"),
    [
        ("roller_of_radius", {"R_roller": "19"}, "larger than 0.4"),
        ("roller_of_curvature", {"R_roller": "21"}, "larger than 0.7"),
        ("gamma_rise", {"r_0": "40", "e": "0"}, "less than the permitted [γ_{r}]"),
    ],
)
def test_conclusions_judge_as_the_checks_do(name: str, settings: dict[str, str], key: str) -> None:
    for given, ok in (({}, True), (settings, False)):
        case = solved(TASK, "17", tuple(given.items()))
        sentence = next(text for text in told(case).conclusions if key in text)

        assert next(rule.ok for rule in rules_of(cam(case)) if rule.name == name) is ok
        assert ("not " + key in sentence) is ok
        assert (" is " + key in sentence) is not ok


def test_conclusions_tell_what_a_profile_loses_and_a_law_that_no_plate_can_follow() -> None:
    case = solved(TASK, "17", (("gamma_rise", "40"), ("gamma_fall", "40"), ("R_roller", "13")))

    sentence = next(text for text in told(case).conclusions if "undercut" in text)
    assert re.search(r"from φ = 34\.03° to 72\.91°", sentence)
    assert "0.28" in sentence
    for k in (0, 1):
        assert any("flat face cannot" in text for text in told(solved(*CASES[k])).conclusions) == (k == 1)


@pytest.mark.parametrize("case", DRAWN)
def test_a_blank_has_axes_and_angles_but_no_result(case: tuple[str, str, Settings]) -> None:
    own, sheet = solved(*case), drawn(*case)
    shown = own.kind.begun(own, sheet.scales, own.words("en"), 0)
    pages = begun_pages(sheet.pages, sheet.views, shown, 0)

    views = [shape for page in pages for shape in page.shapes if isinstance(shape, Group) and shape.role == "view"]
    texts = [text for text in leaves(view for view in views if view.name in stages(own)) if isinstance(text, Text)]
    numbers = [text.markup for text in texts if text.role != "heading" and re.search(r"\d", text.markup)]
    assert all(re.match(r"H_|−?\d+°$|d\^\{2\}s", text) for text in numbers), numbers
    assert not any(re.search(r"(ρ|θ|γ|e|h)\S* = ", text.markup) for text in texts if "μ" not in text.markup)


@pytest.mark.parametrize(("rotation", "side"), [("ccw", "to the left"), ("cw", "to the right")])
def test_the_rise_goes_to_the_side_to_which_its_velocity_turns_with_the_cam(rotation: str, side: str) -> None:
    case = solved("madi-cam", "17", (("rotation", rotation),))
    _, scene = tables(case)["sizes"]

    assert f"the rise {side}," in said(case, told(case))
    place = scene.mm("sizes.4_rise")
    assert place.real < 0.0 if rotation == "ccw" else place.real > 0.0
    assert (place.real < 0.0) == (scene.mm("sizes.C").real < 0.0)  # the follower's offset is to the good of the rise
