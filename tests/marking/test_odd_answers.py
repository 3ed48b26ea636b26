"""Answers that are odd as a whole: exchanged columns, a wrong scale factor, those of another variant."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from kulman import check, load_task, solve
from kulman.tests.support.marking_cases import key, right_answers
from kulman.variants import sheets
from kulman.variants.case import Case
from kulman.variants.marking.reading import Answers
from kulman.variants.marking.report import report_html
from kulman.variants.marking.result import result_of
from kulman.variants.sheets import drawing_of, sheet_id

TASK = "nau-slider-crank"
HEAD = "величина;відрізок, мм;масштаб;значення;одиниця;напрям\n"


def read(tmp_path: Path, rows: str, variant: str | None = "example") -> Answers:
    """Return the answers of a form with these rows."""
    file = tmp_path / "answers.csv"
    file.write_text(HEAD + rows, encoding="utf-8")
    return check(TASK, variant).read(str(file))[0]


def test_columns_that_changed_places_are_put_back_by_scale_factors_in_rows_of_their_own(tmp_path: Path) -> None:
    scales, rows = "mu_V;;0,05;;;\nmu_a;;4;;;\n", "V_B;2,76;;55,2;;\nV_A;4;;80;;\nV_BA;2,1;;42;;\na_B;220;;55;;\n"
    lone = "omega_1;;;50;;-\na_A;50;;;;\nV_S2;3,26;;;;\n"  # a value, a segment, a value

    found = read(tmp_path, scales + rows + lone)

    assert found.lines["V_B"].mm == pytest.approx(55.2)
    assert found.lines["V_B"].value == pytest.approx(2.76)
    assert (found.lines["omega_1"].mm, found.lines["omega_1"].value) == (None, pytest.approx(50.0))
    assert (found.lines["a_A"].mm, found.lines["a_A"].value) == (pytest.approx(50.0), None)
    assert (found.lines["V_S2"].mm, found.lines["V_S2"].value) == (None, pytest.approx(3.26))
    assert "each other's place" in found.problems[0].text("en")


def rows_of(variant: str) -> str:
    """Return the right answers to a variant, as rows of a form; a vector's sense is not said."""
    given = right_answers(key(TASK, variant), directions=False)
    return "".join(f"{one.name};;;{abs(one.value or 0.0):.4g};;\n" for one in given)


@pytest.mark.parametrize(("rows", "another"), [("5", True), ("3", False)])
def test_answers_to_another_variant_are_told(tmp_path: Path, rows: str, another: bool) -> None:
    answers = read(tmp_path, rows_of(rows), "3")

    report = check(TASK, "3", lang="en").mark(answers)
    own = check(TASK, "3", lang="en", own=True).mark(answers)

    assert [flag.startswith("the answers fit variant 5") for flag in report.lists["flags"]] == [True] * another
    assert "flags" not in own.lists
    assert [line.startswith("the variant:") for line in own.lists["again"][:1]] == [True] * another
    assert not any("5" in line.partition(":")[0] for line in own.lists["again"])


def test_another_variant_is_recognised_on_any_format_without_a_sheet_of_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    drawn = set[str]()

    def noted(case: Case) -> Any:
        drawn.add(case.variant)
        return drawing_of(case)

    monkeypatch.setattr(sheets, "drawing_of", noted)
    asked = check(TASK, "3", lang="en", format="A3")
    at_five = solve(TASK, "5", format="A4")  # other scale factors than those of the format that is asked for
    rows = "".join(
        f"{name};{q.mm:.1f};;;\n" for name in key(TASK, "5").questions if (q := at_five[name]).mm is not None
    )
    drawn.clear()

    report = asked.mark(read(tmp_path, rows, "3"))

    assert report.marked.fits == "5"
    assert drawn == {"3"}


@pytest.mark.parametrize(
    ("task", "rows", "found"),
    [
        ("madi-cam", "mu_s_d2s;;0,0005987 м/мм;;;\nr_0_flat;38,6;;38,6 мм;;\n", "right"),
        ("madi-cam", "mu_s_d2s;;0,0005987 м/мм;;;\nr_0_flat;48,6;;38,6 мм;;\n", "arithmetic"),
        ("karpenko-hoist", "mu_F_circle;;200 Н/мм;;;\nP_st;50;;50053 Н;;\n", "right"),
        ("karpenko-hoist", "P_st;50;;50053 Н;;\nb_0;15;;3 м;;\n", "right"),
    ],
)
def test_a_segment_may_be_that_of_the_drawing_on_which_the_sheet_shows_it(
    tmp_path: Path, task: str, rows: str, found: str
) -> None:
    file = tmp_path / "answers.csv"
    file.write_text(HEAD + rows, encoding="utf-8")
    asked = check(task, lang="en")

    report = asked.mark(asked.read(str(file))[0])

    assert {str(line.verdict) for line in report.marked.marking.lines if line.answer is not None} == {found}


@pytest.mark.parametrize(("sheet", "variant", "told"), [("", "0", True), (sheet_id(load_task(TASK), "5"), "5", False)])
def test_a_form_without_a_variant_has_that_of_its_sheet_id(
    tmp_path: Path, sheet: str, variant: str, told: bool
) -> None:
    answers = replace(read(tmp_path, rows_of("5"), None), about={"sheet": sheet} if sheet else {})

    marked = check(TASK, lang="en").mark(answers).marked

    assert marked.keyed.solution.variant == variant
    assert ["nowhere said" in note.text("en") for note in marked.notes if "nowhere" in note.text("en")] == [True] * told


def test_a_single_slip_of_the_hand_is_called_one(tmp_path: Path) -> None:
    right, allowed = abs(key(TASK, "3")["V_BA"]), key(TASK, "3").allowed["V_BA"]
    reports = [
        check(TASK, "3", lang="en").mark(read(tmp_path, f"V_BA;;;{right + times * allowed:.5g};;\n", "3"))
        for times in (1.5, 4.0)
    ]

    assert [report.marked.slips for report in reports] == [True, False]
    assert ["inaccurate" in "".join(report.lists["candidates"][:1]) for report in reports] == [True, False]
    assert result_of(reports[0].marked, "en").mistakes == ()


def test_one_degree_is_the_direction_of_a_vector_and_the_sense_of_a_scalar(tmp_path: Path) -> None:
    lines = read(tmp_path, "V_B;;;5,6;;1\nV_A;;;5,9;;-1\nomega_2;;;15,7;;1\n", "3").lines

    assert lines["V_B"].direction == pytest.approx(math.radians(1.0))
    assert lines["V_A"].direction == pytest.approx(math.radians(-1.0))
    assert (lines["omega_2"].direction, lines["omega_2"].sense) == (None, 1)


def test_a_student_is_told_how_to_go_on_where_something_is_wrong(tmp_path: Path) -> None:
    own = check(TASK, "3", lang="en", own=True)

    wrong, right = (own.mark(read(tmp_path, rows, "3")) for rows in ("V_B;;;9;;\n", rows_of("3")))

    assert wrong.lists["again"][-1].startswith("then: begin with the first wrong step")
    assert right.lists["again"] == ()


def test_a_page_sets_scripts_and_writes_numbers_and_directions_in_full(tmp_path: Path) -> None:
    rows = "V_B;;;5,6;;359,98\na_BA_n;;;9;;\nF_3;;;78612;;0\n"

    page = report_html(check(TASK, "3", lang="en").mark(read(tmp_path, rows, "3")))

    assert "<td>a<sup>n</sup><sub>BA</sub></td>" in page
    assert "a^n_BA" not in page
    assert "78612 N; 0°" in page
    assert "360°" not in page
    assert "e+" not in page


def test_the_force_of_a_couple_and_each_of_the_two_have_symbols_of_their_own() -> None:
    asked = check(TASK, "3", lang="en")

    symbols = asked.mark(asked.read("printed")[0]).marked.keyed.symbols

    couple = [symbol for name, symbol in symbols.items() if "i2_couple" in name]
    assert sorted(couple) == ["F′_i2", "F′_i2 = F″_i2", "F″_i2"]


def test_a_direction_in_the_place_of_a_sense_is_told(tmp_path: Path) -> None:
    found = read(tmp_path, "omega_1;;;50;;вліво\nomega_2;;;5;;+\nV_B;;;5;;вліво\n")

    assert ["omega_1" in problem.text("en") for problem in found.problems] == [True]
    assert "a sense" in found.problems[0].text("en")
    assert found.lines["omega_1"].direction is None
    assert found.lines["omega_1"].value == pytest.approx(50.0)


SCALED = "mu_a;;1,07;;;\na_A;80;;856;;\na_BA_n;4,4;;47,4;;\na_BA_t;69,9;;748;;\na_BA;70,1;;750;;\na_S2;59;;631;;\n"


@pytest.mark.parametrize("asked", [(), ("a_BA", "a_S2")])
def test_a_scale_factor_written_wrongly_in_its_row_counts_once(tmp_path: Path, asked: tuple[str, ...]) -> None:
    rubric = tmp_path / "rubric.toml"
    rubric.write_text(f"asked = {list(asked)}\n", encoding="utf-8")
    answers = read(tmp_path, SCALED, "3")

    report = check(TASK, "3", lang="en", rubric=rubric).mark(answers)

    faulty = [(line.name, str(line.verdict)) for line in report.marked.marking.lines if line.verdict.faulty]
    assert faulty == [((*asked, "a_A")[0], "scale")]
    assert report.lists["again"] == ("μ_a: too small by the factor 10; your segments and values fit 10.7 (m/s²)/mm",)
    assert report.lists["candidates"] == ()


def test_values_that_do_not_come_from_segments_blame_no_scale_factor(tmp_path: Path) -> None:
    right_scale = SCALED.replace("1,07", "10,7").replace("856", "85,6").replace("47,4", "4,74")
    tenths = right_scale.replace("748", "74,8").replace("750", "75").replace("631", "63,1")

    marked = check(TASK, "3", lang="en").mark(read(tmp_path, tenths, "3")).marked

    assert marked.misfits == {}


def test_a_scale_factor_beside_which_a_mistake_is_beyond_all_floats_is_marked(tmp_path: Path) -> None:
    checked = check("madi-cam", set={"mu_phi": "7e-9 deg/mm"})
    file = tmp_path / "answers.csv"
    file.write_text(HEAD + "mu_a;;;180;;\n", encoding="utf-8")

    found = checked.mark(checked.read(str(file))[0])

    assert "mu_a" in {row.line.name for _, rows in found.parts for row in rows if row.answer}
