"""Gears for students and teachers: handouts, notes, answers marked, mistakes that are planted and found."""

import math
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import pytest

from kulman import check, handout, note, solve
from kulman.drawing.figure import ANSWERS
from kulman.drawing.gears.text import _calculations
from kulman.drawing.handouts import begun_pages
from kulman.drawing.notes.blocks import Steps
from kulman.drawing.page import Page
from kulman.drawing.shapes import Line, Shape, Text
from kulman.plans.boards.exact import run
from kulman.plans.hands.shaky import preset
from kulman.plans.marking.answers import Answer, Verdict
from kulman.plans.marking.key import Key
from kulman.plans.marking.verdicts import mark
from kulman.plans.mistakes.book import Book, book, broken
from kulman.plans.mistakes.explaining import explain
from kulman.plans.mistakes.rules import Broken
from kulman.scales.errors import LANGUAGES
from kulman.scales.packaged import packaged
from kulman.scales.scale import Scale
from kulman.tests.support.cases import draw_case, solve_case
from kulman.tests.support.shapes import leaves
from kulman.variants.case import Case, Request
from kulman.variants.marking.keyed import Rubric, keyed
from kulman.variants.reader import load_task
from kulman.variants.sheets import Sheet
from kulman.variants.solution import Solution

TASK = "madi-gear"
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
WRONG = {  # at any tolerance
    "a",  # a slip of the pen
    *("P_1", "P_2", "rho_l1", "rho_l2"),  # sines of other angles
    "epsilon_alpha",  # contradicts the numbers beside it
    "y_2_03",  # 39 for 59
    *(f"y_{i}_{k:02d}" for i in (1, 2) for k in range(7, 12)),  # rows exchanged beyond the pole
    "y_1_12",
}
FOLLOWS = {f"theta_{pair}_{k:02d}" for pair in ("12", "21") for k in range(7, 12)}
IDS = [f"M{n}" for n in range(100, 115)]
DIGITS = 4  # of an answer
MM = 1e-3
SOAKED = [pytest.param(language, marks=pytest.mark.soak) for language in LANGUAGES[1:]]


@cache
def whole() -> Case:
    return solve_case(TASK)


@cache
def drawn(lang: str = "en") -> Sheet:
    return draw_case(whole(), lang)


def parts(things: Iterable[Page | Shape]) -> Iterator[Page | Shape]:
    """Go through all that is drawn, pages and groups themselves, too."""
    for thing in things:
        yield thing
        yield from parts(getattr(thing, "shapes", ()))


@pytest.mark.parametrize("only", ["sliding", "geometry", pytest.param(None, marks=pytest.mark.soak)])
def test_a_blank_tells_what_is_given_and_no_result(only: str | None) -> None:
    views = [view for page in handout(TASK, only=only, lang="en").pages for view in page.shapes]
    shown = leaves(view for view in views if getattr(view, "role", "") == "view")
    said = [text.markup for text in shown if isinstance(text, Text)]
    results = solve(TASK, only=only)
    assert only == "sliding" or {"5", "20", "0.85", "0.2", "15"} <= set(said)
    for name in ("a_w", "d_a1", "d_w2", "s_1", "h", "p_b", "rho_p1"):
        number = f"{(results[name].value or 0.0) * 1e3:.2f}"
        assert not any(number in text for text in said), name
    assert not any("1.20" in text or "26.65" in text or "−3.07" in text or "satisfied" in text for text in said)


def test_stages_leave_what_the_work_comes_to() -> None:
    for view in (view for view in drawn().views if view.stages):
        texts = [(s, part) for s, part in zip(view.shapes, view.parts, strict=True) if isinstance(s, Text)]
        assert ANSWERS not in view.stages
        assert [text for text, part in texts if part == ANSWERS and "=" in text.markup], view.name
        left = [text for text, part in texts if part in view.stages and text.role != "diameter"]
        assert not [text.markup for text in left if "=" in text.markup]


@pytest.mark.parametrize("others", [PAIRS[0], *(pytest.param(pair, marks=pytest.mark.soak) for pair in PAIRS[1:])])
def test_every_mark_of_the_construction_has_its_stage(others: dict[str, float]) -> None:
    case = solve_case(TASK, None, {name: str(value) for name, value in others.items()}) if others else whole()
    views = draw_case(case, "en").views if others else drawn().views
    pieces = [piece for view in views if view.stages for piece in zip(view.shapes, view.parts, strict=True)]
    page = Page(1.0, 1.0, tuple(shape for shape, stage in pieces if stage != ANSWERS), "", "en")
    said = {getattr(part, "name", "") for part in parts([page])}

    marks = [step.name for plan in ("meshing", "sliding", "theta") for step in case.solved.program.on(plan)]
    assert len(marks) > 100
    undercut = ["meshing.H1"] if others == PAIRS[2] else []  # the rack's edge leaves the line of action beyond N1
    missing = [mark for mark in marks if drawn_by(mark) not in said]
    assert missing[: len(undercut)] == undercut
    assert {*missing[len(undercut) :]} == CUT_OFF


def drawn_by(mark: str) -> str:
    """Return the name of what shows a mark."""
    pattern, name = next((pattern, name) for pattern, name in DRAWN_BY if re.fullmatch(pattern, mark))
    return re.sub(pattern, name, mark)


@pytest.mark.parametrize("lang", [LANGUAGES[0], *SOAKED])
def test_note_tells_the_steps_of_a_handout_with_their_numbers(lang: str) -> None:
    words, scales = whole().words(lang), {"meshing": Scale("mu_l", 0.0005, "m")}

    story = whole().kind.story(whole(), scales, words, packaged("kulman.drawing.notes", "texts", lang))

    views = [view for view in drawn(lang).views if view.stages]
    assert {key for view in views for key in view.stages.values()} - {""} == {
        key for key in story.texts if re.match(r"gear\.(meshing|rolling|action|sliding)\.", key)
    }
    said = " ".join(step for view in views for step in story.steps_of(view))
    assert words.number(78.857, 1) in said  # d_w1 / 2 at 2:1
    assert words.number(35.568, 1) in said  # the active line on paper
    assert f"{words.number(26.65, 2)}°" in said


def test_letters_on_leaders_keep_them_on_a_blank_and_none_of_a_begun_sheet_ends_at_nothing() -> None:
    blank, second = [*parts(handout(TASK, only="meshing", lang="en").pages)], begun(whole(), drawn(), 2)
    kept, leaders = (
        {shape.name for shape in shapes if isinstance(shape, Line) and shape.role == "leader"}
        for shapes in (blank, second)
    )
    assert "P" in kept
    assert kept <= {"P", "O_{1}", "O_{2}"}
    assert {"d_w1", "d_w2"} <= leaders
    texts = [shape for shape in second if isinstance(shape, Text)]
    assert leaders <= {name for text in texts for name in (text.name, text.markup)}


def test_numbers_of_the_note_that_end_are_written_so_and_others_with_all_digits() -> None:
    case = whole()
    scene = case.kind.scene(case, drawn().scales, case.words("en"))

    results = [line[-1] for line in _calculations(scene, ("d_1", "a", "x_sum", "a_w"))]

    assert results == ["= 75 mm", "= 87.5 mm", "= 1.05", "= 92.000 mm"]  # the last is 91.99986 mm


@pytest.mark.parametrize("language", [LANGUAGES[0], *SOAKED])
def test_what_is_laid_off_is_told_on_paper_and_as_it_is(language: str) -> None:
    written = note(TASK, lang=language)
    steps = [text for block in written.document.blocks if isinstance(block, Steps) for text in block.texts]
    told = re.compile(r"([\d.,]+) (?:mm|мм) \(\S+ = ([\d.,]+) (?:mm|мм)\)")
    laid_off = [pair for text in steps for pair in told.findall(text)]
    assert len(laid_off) == 9  # a_w, s_1, s_2, p, rho_f, p_b, l_N1N2, twice the active line
    for paper, length in laid_off:
        drawn, real = (float(text.replace(",", ".")) for text in (paper, length))
        assert drawn == pytest.approx(5.0 * real, abs=0.05 + 5.0 * 0.005)  # M 5:1, as they are rounded


@cache
def solution() -> Solution:
    return solve(TASK)


def test_form_asks_for_no_given_in_the_sections_of_the_note_and_right_answers_get_the_full_mark(tmp_path: Path) -> None:
    lines = check(TASK, lang="en").write_form(tmp_path / "form.csv").read_text(encoding="utf-8-sig").splitlines()
    asked = [line.split(",")[0] for line in lines]
    shown = {n: solution()[n].shown(solution().words.display).value for n in asked if n in solution()}

    found = verdicts(tmp_path / "class.csv", {n: float(value) for n, value in shown.items() if value is not None})

    assert not {"m", "z_1", "x_1", "alpha", "PW", "mu_theta", "theta_12_01", "y_1_01"} & set(asked)
    headings = ["Main dimensions", "Auxiliary dimensions", "Geometrical quality indices", "Dimensions for inspection"]
    headings.append("Measured on the drawing")
    assert [asked.index(heading) for heading in headings] == sorted(asked.index(heading) for heading in headings)
    assert asked.index(headings[0]) < asked.index("a_w") < asked.index(headings[1]) < asked.index("d_b1")
    assert len(shown) > 100
    assert set(found.values()) <= {Verdict.RIGHT, Verdict.MISSING}
    assert [name for name in shown if found[name] is Verdict.MISSING] == []


def verdicts(path: Path, answers: dict[str, float], preset: str = "normal") -> dict[str, Verdict]:
    """Mark one student's values, in the units of the task."""
    asked = check(TASK, preset=preset, lang="en")
    path.write_text(
        f"student,{','.join(answers)}\nA,{','.join(f'{value!r}' for value in answers.values())}\n", encoding="utf-8"
    )
    (read,) = asked.read(str(path))
    return {line.name: line.verdict for line in asked.mark(read).marked.lines}


def test_printed_answers_are_wrong_where_the_note_is() -> None:
    asked = check(TASK, preset="careful", lang="en")
    (answers,) = asked.read("printed")
    marked = asked.mark(answers).marked
    found = {line.name: line.verdict for line in marked.lines}
    assert {name for name, verdict in found.items() if verdict is Verdict.WRONG} == WRONG
    assert {name for name, verdict in found.items() if verdict is Verdict.CARRIED} == FOLLOWS
    assert marked.count(Verdict.MISSING) == 0


@pytest.mark.parametrize(
    ("name", "answer", "verdict"),
    [
        ("alpha_w", 26.654, Verdict.RIGHT),  # degrees
        ("alpha_w", math.radians(26.654), Verdict.SCALE),
        ("W_1", 2.3875, Verdict.SCALE),  # centimetres
        ("theta_12_A1", -2.9, Verdict.RIGHT),  # of a drawing
        ("theta_12_A1", -3.9, Verdict.WRONG),
        ("epsilon_alpha", 3.72121, Verdict.WRONG),  # as printed
        ("x_min2", 0.169778, Verdict.WRONG),  # the sign of a number without unit counts
        ("theta_21_07", 0.2879, Verdict.WRONG),
    ],
)
def test_an_answer_is_judged_by_what_it_is(name: str, answer: float, verdict: Verdict, tmp_path: Path) -> None:
    assert verdicts(tmp_path / "class.csv", {name: answer})[name] is verdict


@cache
def key() -> Key:
    request = Request(load_task(TASK), "", language="en")
    return keyed(request, "17", {}, Rubric(preset("careful").tolerance)).key


@cache
def mistakes() -> Book:
    return book(key())


def planted(id: str, how: str, at: str = "") -> Mapping[str, Any]:
    """Return the values that come out of the one broken rule that is meant."""
    [found] = [b for b in broken(key().paper, key().values, (id,)) if b.change.how == how and at in ("", b.at)]
    return values(found)


def test_what_follows_from_a_wrong_size_is_right(tmp_path: Path) -> None:
    """With s_1 = 9 mm the thickness on the base circle and the common normal are larger by as much."""
    found = verdicts(tmp_path / "class.csv", {"s_1": 9.0, "s_b1": 9.508, "W_1": 24.268}, "cad")
    assert found["s_1"] is Verdict.WRONG
    assert (found["s_b1"], found["W_1"]) == (Verdict.CARRIED, Verdict.CARRIED)


def values(found: Broken) -> Mapping[str, Any]:
    return run(found.program, found.givens).values


@pytest.mark.parametrize(
    ("id", "how", "at", "name", "value"),
    [
        ("M100", "", "", "inv_alpha", math.tan(math.radians(20.0)) - 20.0),  # degrees subtracted
        ("M101", "profile", "", "a_w", 87.5 * MM),  # a for a_w
        ("M101", "once", "", "inv_alpha_w", 0.0149044 + 1.05 * 0.36397 / 35.0),  # the sum once
        ("M102", "everywhere", "", "s_1", 10.94773 * MM),  # shifts exchanged
        ("M102", "tip_diameter", "", "d_a1", 91.99971 * MM),
        ("M103", "none tooth_thickness", "s_1", "s_1", math.pi * 2.5 * MM),  # half a pitch
        ("M103", "side root_diameter", "d_f1", "d_f1", 60.5 * MM),  # shift inwards
        ("M104", "tip", "d_a1", "d_a1", 87.0 * MM),  # tip not shortened
        ("M105", "root", "d_f1", "d_f1", 67.0 * MM),  # no clearance
        ("M106", "root_diameter", "d_f1", "d_f1", 69.75 * MM),  # dedendum once
        ("M107", "diameter", "d_b1", "d_b1", 75.0 * MM * math.cos(math.radians(26.65411))),  # alpha_w
        ("M108", "sine", "P_1", "P_1", 15.25262 * MM),  # chord as printed
        ("M109", "", "rho_l1", "rho_l1", 1.32853 * MM),  # curvatures as printed
        ("M109", "", "rho_l2", "rho_l2", 15.17197 * MM),
        ("M110", "", "rho_p1", "rho_p1", 17.06819 * MM),  # own tip
        ("M111", "none", "", "epsilon_alpha", 1.20483 * 2.0 * math.pi),  # not divided
        ("M112", "more", "W_1", "W_1", (23.87544 + 14.76066) * MM),  # one pitch more
        ("M113", "beyond", "", "theta_12_08", (28.949 - 54.735) / 28.949),  # rows as printed
        ("M114", "mate", "", "theta_12_03", (14.5168 - 59.1124) / 59.1124),  # by the mate
        ("M114", "sign", "", "theta_12_A1", 3.072),
    ],
)
def test_a_broken_rule_gives_what_it_says(id: str, how: str, at: str, name: str, value: float) -> None:
    assert planted(id, how, at)[name] == pytest.approx(value, rel=2e-4)


def test_rows_exchanged_beyond_the_pole_leave_the_others_and_beams_of_a_hoist_are_no_rows() -> None:
    found = planted("M113", "beyond")
    beam = keyed(Request(load_task("karpenko-hoist"), ""), "V01", {}, Rubric(preset("careful").tolerance)).key
    for k in range(1, 13):
        first, second = key()[f"y_1_{k:02d}"] if k > 1 else 0.0, key()[f"y_2_{k:02d}"] if k < 12 else 0.0
        expected = (second, first) if k > 6 else (first, second)
        assert (found[f"y_1_{k:02d}"], found[f"y_2_{k:02d}"]) == pytest.approx(expected, abs=1e-9)
    assert "M113" not in {one.mistake for one in broken(beam.paper, beam.values)}


def answers(made: Mapping[str, Any]) -> list[Answer]:
    """Return what a student writes, numbers rounded; what is nothing by construction is not asked."""
    asked = [name for name, question in key().questions.items() if question.step.operands != ("_zero",)]
    names = [name for name in asked if math.isfinite(made[name])]
    return [Answer(name, value=float(f"{made[name]:.{DIGITS}g}")) for name in names]


@pytest.mark.parametrize("id", [pytest.param(id, marks=() if k % 2 else pytest.mark.soak) for k, id in enumerate(IDS)])
def test_a_planted_mistake_is_the_first_that_is_told(id: str) -> None:
    planted = list(broken(key().paper, key().values, (id,)))[:: 1 if id != "M103" else 6]
    told = [explain(mistakes(), mark(key(), answers(values(found)))).candidates for found in planted]
    assert [found.place for found, told_of in zip(planted, told, strict=True) if not told_of] == []
    assert [(f.place, t[0].ids) for f, t in zip(planted, told, strict=True) if id not in t[0].ids] == []


@pytest.mark.parametrize("ids", [("M108", "M109", "M113"), ("M102", "M108", "M109", "M113")], ids=["three", "four"])
def test_each_of_several_mistakes_is_named(ids: tuple[str, ...]) -> None:
    paper, made = key().paper, key().values
    for id in ids:
        found = next(iter(broken(paper, made, (id,))))
        made = {**made, **values(found)}
        paper = replace(paper, program=found.program, givens=found.givens)
    told = explain(mistakes(), mark(key(), answers(made))).candidates[0]
    assert set(ids) <= told.ids
    assert told.left == ()


def test_right_answers_have_no_mistake_told() -> None:
    assert explain(mistakes(), mark(key(), answers(key().values))).candidates == ()


def begun(case: Case, sheet: Sheet, steps: int) -> list[Page | Shape]:
    """Return all that is drawn on a sheet begun with so many steps."""
    shown = case.kind.begun(case, sheet.scales, case.words("en"), steps)
    return [*parts(begun_pages(sheet.pages, sheet.views, shown, steps))]


def test_the_contact_ratio_has_no_sense_to_be_written(tmp_path: Path) -> None:
    (tmp_path / "class.csv").write_text("student,variant\nО. Коваль,17\n", encoding="utf-8")
    asked = check("madi-gear", roster=tmp_path / "class.csv", directions="required", lang="en")

    head = asked.write_form(tmp_path / "form.csv").read_text("utf-8-sig").splitlines()[0]
    assert ",ε_alpha," in head
    assert "ε_alpha, " not in head
