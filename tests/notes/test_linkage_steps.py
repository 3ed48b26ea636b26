"""Steps of linkages in notes: none is left out, each group has its equation, conclusions are what is solved."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from functools import lru_cache
from itertools import chain
from pathlib import Path
from typing import Any

import pytest

import kulman
from kulman.drawing.linkages.steps import drawn_views, told_of
from kulman.drawing.linkages.telling import Teller
from kulman.drawing.notes.blocks import Story
from kulman.scales.errors import LANGUAGES
from kulman.scales.packaged import packaged
from kulman.tests.support.cases import draw_case, solve_case
from kulman.tests.support.printed_numbers import recomputes, shows
from kulman.variants.case import Case
from kulman.variants.kinds.linkage import KIND
from kulman.variants.shelf import bundled

FEW = ("bertyaev-six-bar", "scheme-20-press-automaton")
DRAWING = ("pole", "lay", "back", "chain", "meet", "arc", "arcs", "divide", "similar", "same", "template", "tangent")
LAID = re.compile(r" = ([\d.]+)([/·])([\d.]+) = ([\d.]+) [cm]m")
BACK = re.compile(
    r" = ([\d.]+) [cm]m \(\1([/·])([\d.]+) = ([\d.]+) "
)  # where a number has less digits than its segment
TASKS: list[Any] = [
    name if name in FEW else pytest.param(name, marks=pytest.mark.soak) for name in bundled("mechanism")
]


@lru_cache(maxsize=32)
def case_of(task: str) -> Case:
    return solve_case(task, None, None, None, None)


def scene_of(case: Case) -> Any:
    _, scales = KIND.first_scales(case.solved, case.choosers, case.plans)  # as good as those of a format
    return KIND.scene(case, scales, case.words("en"))


def story_of(case: Case, lang: str = "en", notation: str | None = None) -> Story:
    _, scales = KIND.first_scales(case.solved, case.choosers, case.plans)
    words, said = replace(case, notation=notation).words(lang), packaged("kulman.drawing.notes", "texts", lang)
    return KIND.story(case, scales, words, said)


@lru_cache(maxsize=32)
def told(task: str, lang: str = "en") -> Story:
    return story_of(case_of(task), lang)


@pytest.mark.parametrize("task", TASKS)
def test_no_step_of_a_drawn_plan_is_left_out(task: str) -> None:
    teller = Teller.of(scene_of(case_of(task)))
    program = teller.solved.program
    names = {told.step.name for view in drawn_views(teller) for told in told_of(teller, view)}
    hung = {e.name for plan in program.plans for e in teller.reading.on(plan) if teller.reading.is_hung(e)}

    intermediate = re.compile(r"_.*|.*\.[p0]")  # or where a drawing begins
    steps = [step for step in program if step.plan in teller.scales and not intermediate.fullmatch(step.name)]
    made = {step.name for step in steps if step.verb in DRAWING}
    made |= {step.name for step in program.on("lever") if step.verb == "normal"}  # vectors that are turned
    # a vector between two marks is measured once, under the first of its names
    read = (step.operands for step in steps if step.verb == "read" and "." in step.operands[0])
    first = {teller.reading.between(*ends).name for ends in read}
    assert len(made) > 10
    assert made | (first - hung) <= names


@pytest.mark.parametrize("task", TASKS)
def test_every_plan_has_its_steps_and_vector_equations(task: str) -> None:
    scene, story = scene_of(case_of(task)), told(task)

    assert {*story.steps} == {*drawn_views(Teller.of(scene))}
    assert {plan for plan in scene.scales if not plan.startswith(("V_at_", "a_at_"))} - {"driver"} <= {*story.steps}
    for view in story.steps:
        meets = [step for step in scene.solved.program.on(view) if step.verb == "meet"] if view != "position" else []
        lines = [" ".join(line) for line in story.equations.get(view, ())]
        known = [line for line in lines if r"\uu{" in line]  # a vector that is known in size and direction
        assert len([line for line in known if r"\u{" in line]) >= len(meets), view
        assert known or view in ("position", "lever"), view


@pytest.mark.parametrize("notation", [None, "bauman"])
@pytest.mark.parametrize("task", TASKS)
def test_what_is_laid_off_recomputes_from_its_value_and_scale_factor(task: str, notation: str | None) -> None:
    steps = story_of(case_of(task), "en", notation).steps
    laid = [text for texts in steps.values() for text in texts if "lay off" in text or "radius" in text]

    found = [match for text in laid if (match := LAID.search(text))]
    back = [match for text in laid if (match := BACK.search(text))]
    assert len(found) + len(back) >= max(6, 0.9 * len(laid))
    for length, sign, mu, printed in (match.groups() for match in back):
        assert (sign == "/") == (notation == "bauman")
        assert recomputes(float(length) / float(mu) if sign == "/" else float(length) * float(mu), printed)
    for match in found:
        value, sign, mu, length = match.groups()
        assert (sign == "·") == (notation == "bauman")
        exact = float(value) / float(mu) if sign == "/" else float(value) * float(mu)
        assert shows(float(length), exact)


@pytest.mark.parametrize("task", TASKS)
def test_no_intermediate_name_is_printed(task: str) -> None:
    for lang in LANGUAGES:
        story = told(task, lang)
        for text in chain(chain.from_iterable(story.steps.values()), story.conclusions):
            assert not re.search(r"_\{_|origin|minus|_\{\}|\(\)|  ", text), text


@pytest.mark.parametrize("lang", LANGUAGES)
def test_a_second_crank_is_marked_beyond_the_shaft_on_every_plan(lang: str) -> None:
    steps = told("scheme-06-opposed-compressor", lang).steps
    beyond = {"uk": "продовженні", "ru": "продолжении", "en": "beyond"}[lang]

    for view in ("position", "velocity", "acceleration"):
        (text,) = (text for text in steps[view] if beyond in text)
        assert "minus" not in text
        assert "l_{OA}" in text


def test_a_segment_that_is_too_short_to_be_measured_is_no_factor(tmp_path: Path) -> None:
    written = kulman.note("bertyaev-six-bar", lang="en", scales={"mu_V": 0.2}).save(tmp_path / "note.md")[0]
    text = written.read_text("utf-8")
    assert not re.search(r"= *[·/]", text)
    assert "too short to be measured" in text


def test_coriolis_is_laid_off_across_the_sliding_and_compound_motion_told_where_it_is_drawn() -> None:
    shaper, compound = told("scheme-09-shaper"), told("bertyaev-six-bar")

    across = next(text for text in shaper.steps["acceleration"] if r"\bar{a}^{k}" in text)
    assert r"along \bar{V}_{A3A2} turned by 90° in the sense of ω_{3}" in across
    assert "Join C and A: the line CA of the slotted link." in shaper.steps["position"]
    for view in ("compound_velocity", *(f"compound_a_{point}" for point in "BMDK")):
        assert len(compound.steps[view]) >= 6
        parts = [part for line in compound.equations[view] for part in line if r"\bar{" in part]
        kind = "v" if view == "compound_velocity" else "a"
        assert parts
        assert {letter for part in parts for letter in re.findall(r"\\bar\{(\w)\}", part)} == {kind}
        # across a link lies a tangential part: the whole acceleration has a normal one, too
        assert all("t}" in part for part in parts if "⊥" in part and kind == "a")
    assert not any("P_" in text for text in compound.steps["position"])  # centres are marked with the velocities
    assert any("instant centre P_{AB}" in text for text in compound.steps["compound_velocity"])


@pytest.mark.parametrize("task", TASKS)
def test_conclusions_name_the_extremes_that_are_solved_and_what_balances(task: str) -> None:
    case, conclusions = case_of(task), told(task).conclusions
    solved, words = case.solved, scene_of(case).words

    points = {f"V_{point}" for link in solved.mechanism.links for point in link.points}
    sizes = {name: abs(q.shown(words.display).value or 0.0) for name, q in solved.quantities.items() if name in points}
    fastest = max(sizes, key=lambda name: sizes[name])
    said = next(text for text in conclusions if "velocit" in text and "points" in text)
    value = re.search(r"= ([\d.]+) ", said)
    assert value is not None
    alike = (name for name, size in sizes.items() if size == pytest.approx(sizes[fastest]))
    assert any(words.symbol(name) in said.partition("smallest")[0] for name in alike)
    assert float(value[1]) == pytest.approx(sizes[fastest], rel=6e-3)

    if task != "bertyaev-six-bar":  # of which no forces are asked
        driver, values = solved.mechanism.driver, solved.values
        if "M_bal" in solved.quantities:
            power = values["M_bal"] * values[f"omega_{driver.link}"]
        else:
            power = (complex(values["_F_bal"]) * complex(values[f"V_{driver.point}"]).conjugate()).real
        (balance,) = (text for text in conclusions if "balancing" in text)
        assert ("the engine drives" in balance) == (power > 0.0)
        # from printed lengths and arms: not alike, but as near as a ruler reads
        assert any(re.search(r"by the lever .* differ by −?0\.\d\d %", text) for text in conclusions)


@pytest.mark.parametrize(("length", "flat"), [("40.5 mm", True), ("400 mm", False)])
def test_lines_that_meet_flatly_are_named_with_their_angle(length: str, flat: bool) -> None:
    case = solve_case("nau-slider-crank", "3", {"phi": "90", "l_AB": length}, None, None)
    _, sine = case.solved.worst_sine()

    (said,) = (text for text in story_of(case).conclusions if "20°" in text)
    assert f"{math.degrees(math.asin(sine)):.3g}°" in said
    assert ("errors of drawing grow" in said) == flat == (sine < math.sin(math.radians(20.0)))


SLIDERS = ("scheme-19-scotch-yoke", "scheme-09-shaper", "scheme-04-v-engine", "scheme-20-press-automaton")


@pytest.mark.parametrize("task", [SLIDERS[0], *(pytest.param(task, marks=pytest.mark.soak) for task in SLIDERS[1:])])
def test_moments_about_guides_stand_with_the_figure_of_their_slider(task: str) -> None:
    equations = told(task).equations
    views = {view.name for view in draw_case(case_of(task), "en").views}

    assert {*equations} <= views
    assert {view for view in views if view.startswith("link_")} == {name for name in equations if "link_" in name}
    for name, lines in equations.items():
        if name.startswith("link_"):
            assert f"({name[-1]}) = 0:" in lines[0][0]
