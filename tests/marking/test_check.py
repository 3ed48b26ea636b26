"""`kulman check`: one student's answers marked, told to student and teacher; rubrics, sheet ids, oddities."""

from __future__ import annotations

import csv
import json
import math
import re
from dataclasses import replace
from itertools import combinations
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest

from kulman import check, load_task, sheet, solve, tasks
from kulman.plans.hands.shaky import PRESETS
from kulman.scales.errors import InputError
from kulman.tests.support.answer_files import ASKED, messages, write
from kulman.tests.support.answer_files import HEAD as COLUMNS
from kulman.tests.support.cases import some
from kulman.tests.support.commands import Run
from kulman.tests.support.marking_cases import key, right_answers
from kulman.tests.support.mechanisms import SEED
from kulman.variants import sheets
from kulman.variants.case import Case, Request
from kulman.variants.marking.figures import MARGIN, Box, boxes, plan_figures
from kulman.variants.marking.keyed import data_said, data_text, read_rubric
from kulman.variants.marking.reading import Answers
from kulman.variants.marking.report import report_html
from kulman.variants.marking.result import result_of
from kulman.variants.roster import read_roster, variant_of_book
from kulman.variants.sheets import drawing_of, same_id, sheet_id, variant_of_id
from kulman.variants.spreadsheets.files import read_grid

TASK = "nau-slider-crank"
HEAD = "task;nau-slider-crank\nvariant;example\n{about}quantity;mm;mu;value;unit;direction\n"
RIGHT = {"V_A": 4.006, "V_BA": 2.124, "V_B": 2.761, "omega_2": -16.34, "a_BA_n": 34.7, "a_B": 221.8, "epsilon_2": -2173}
Printed = pytest.CaptureFixture[str]


def answers(tmp_path: Path, changed: dict[str, float] | None = None, about: str = "", name: str = "a.csv") -> str:
    """Write a form whose answers are right but for those changed."""
    rows = "".join(f"{name};;;{value};;\n" for name, value in {**RIGHT, **(changed or {})}.items())
    file = tmp_path / name
    file.write_text(HEAD.format(about=about) + rows, encoding="utf-8")
    return str(file)


def marked(run: Run, *arguments: str) -> dict[str, Any]:
    """Return the JSON of a check."""
    status, out, err = run("check", TASK, *arguments, "--json")
    assert (status, err) == (0, "")
    found = json.loads(out)
    return {**found, "verdicts": {line["quantity"]: line["verdict"] for line in found["lines"]}}


def test_an_arm_of_the_lever_is_told_in_the_millimetres_in_which_it_was_drawn(run: Run, tmp_path: Path) -> None:
    solution = solve(TASK, "example")
    arms = {q.name: round(4.0 * q.mm, 1) for q in solution.values() if q.name.startswith("h_lever_F") and q.mm}
    (form := tmp_path / "a.csv").write_text(
        HEAD.format(about="") + "".join(f"{name};;;{mm};mm;\n" for name, mm in arms.items()), encoding="utf-8"
    )

    _, out, _ = run("check", TASK, str(form), "--lang", "en")

    told = re.findall(r"h_F\w+ +([\d.]+) mm +([\d.]+) mm .*right", out)
    assert len(told) == len(arms) > 2
    assert [float(answer) for answer, _ in told] == pytest.approx([float(right) for _, right in told], abs=0.11)
    assert not re.findall(r"h_F\w+ .*m/s", run("check", TASK, answers(tmp_path), "--lang", "en")[1])  # nor one left out


@pytest.mark.parametrize(
    "cells", ["18,3;;", "18,3;;18,3", "18,3;;18,3 мм", "1,83 см;;0,0183 м", ";;18,3", "18,3;;1,83"]
)
def test_an_arm_of_the_lever_may_stand_in_both_cells_in_millimetres(tmp_path: Path, cells: str) -> None:
    """The form states mm for it: who wrote them twice had a wrong unit."""
    rows = f"mu_V;;0,1;;;\nV_A;58,6;;5,86;;\nh_lever_F_i2;{cells};мм;\n"

    report = check(TASK, "3", lang="en").mark(read(tmp_path, rows, "3"))

    assert [str(line.verdict) for line in report.marked.marking.answered] == ["right", "right"]
    assert not report.marked.answers.problems


@pytest.mark.parametrize(("scale", "told"), [("mu_h", True), ("mu_V", False)])
def test_arms_are_marked_by_the_scale_factor_that_they_fit_where_the_lever_has_none(
    tmp_path: Path, scale: str, told: bool
) -> None:
    """Who wrote mu_V alone, and measured arms on the sheet's lever, had five right arms wrong."""
    key, solution = check(TASK, "3"), solve(TASK, "3")
    arms = {q.name: float(q) / solution.scales[scale].mu for q in solution.values() if q.name.startswith("h_lever_F")}
    rows = "mu_V;;0,1;;;\n" + "".join(f"{name};{abs(mm):.1f};;;;\n" for name, mm in arms.items())

    report = key.mark(read(tmp_path, rows, "3"))

    assert {str(line.verdict) for line in report.marked.marking.answered} == {"right"}
    assert any(note.key == "marked-scale" for note in report.marked.notes) is told


@pytest.mark.parametrize(
    ("task", "cell", "verdict"),
    [
        ("madi-gear", "alpha_w;;;26°39′;;", "right"),
        ("madi-gear", "alpha_w;;;26° 40';;", "right"),
        ("madi-gear", "alpha_w;;;26°09′;;", "wrong"),
        ("madi-gear", "u;;;4:3;;", "right"),
        ("madi-gear", "u;;;1,3;;", "right"),
        ("madi-gear", "u;;;1;;", "wrong"),
        ("madi-gear", "epsilon_alpha;;;1;;", "wrong"),
        ("karpenko-hoist", "T_1;;;0,1;с;", "wrong"),
        ("karpenko-hoist", "T_1;;;0,087;с;", "right"),
    ],
)
def test_minutes_of_angle_and_ratios_are_numbers_and_one_digit_is_too_coarse(
    tmp_path: Path, task: str, cell: str, verdict: str
) -> None:
    """Degrees and minutes were degrees of an unknown unit, 4:3 was 4; and 1 was right for 1.333, 0.1 for 0.0875."""
    variant = "V03" if task == "karpenko-hoist" else "17"

    report = check(task, variant).mark(read(tmp_path, cell + "\n", variant, task))

    assert [str(line.verdict) for line in report.marked.marking.answered] == [verdict]
    assert not report.marked.answers.problems


@pytest.mark.parametrize("value", ["3,35 мм/с", "4"])
def test_who_has_the_right_segment_has_copied_none(tmp_path: Path, value: str) -> None:
    """Of a wrong unit beside a right segment it was told that the segment comes from a neighbouring position."""
    rows = f"mu_V;;0,1;;;\nV_A;56,5;;5,65;;\nV_BA;49;;4,9;;\nV_B;33,5;;{value};;\nV_S2;44;;4,4;;\n"

    report = check(TASK, "4").mark(read(tmp_path, rows, "4"))

    assert "M22" not in {one for candidate in report.marked.candidates for one in candidate.ids}
    assert str(report.marked.marking["V_B"].verdict) in ("scale", "arithmetic")


def rubric(tmp_path: Path, text: str) -> str:
    file = tmp_path / "rubric.toml"
    file.write_text(text, encoding="utf-8")
    return str(file)


def read(tmp_path: Path, rows: str, variant: str | None = "example", task: str = TASK) -> Answers:
    """Return the answers of a form with these rows."""
    file = tmp_path / "answers.csv"
    file.write_text(COLUMNS + rows, encoding="utf-8")
    return check(task, variant).read(str(file))[0]


def rows_of(variant: str) -> str:
    """Return the right answers to a variant, as rows of a form; a vector's sense is not said."""
    right = right_answers(key(TASK, variant), directions=False)
    return "".join(f"{one.name};;;{abs(one.value or 0.0):.4g};;\n" for one in right)


def test_right_answers_are_right_an_error_counts_once_and_a_mistake_is_named(tmp_path: Path, run: Run) -> None:
    right = marked(run, answers(tmp_path))
    assert right["first_wrong"] is None
    assert [right["verdicts"][name] for name in RIGHT] == ["right"] * len(RIGHT)
    assert right["counts"]["missing"] == len(right["lines"]) - len(RIGHT)

    once = marked(run, answers(tmp_path, {"V_BA": 1.35, "omega_2": -10.4, "a_BA_n": 14.0}))
    assert once["first_wrong"] == "V_BA"
    assert [once["verdicts"][name] for name in ("V_BA", "omega_2", "a_BA_n")] == ["wrong", "carried", "carried"]

    turned = marked(run, answers(tmp_path, {"a_B": 295.3}))  # with a_BA_n laid off from A to B
    assert turned["first_wrong"] == "a_B"
    assert "M38" in [mistake["id"] for candidate in turned["mistakes"] for mistake in candidate["mistakes"]]

    own = marked(run, answers(tmp_path, {"V_BA": 1.3}), "--verdict-only")  # what a student is told
    assert "mistakes" not in own
    assert {key for line in own["lines"] for key in line} == {"quantity", "verdict", "about", "answer"}


@pytest.mark.parametrize("suffix", [".txt", ".html"])
def test_a_student_sees_no_right_number_and_no_right_vector(tmp_path: Path, run: Run, suffix: str) -> None:
    file, report = answers(tmp_path, {"V_BA": 1.3, "a_B": 300.0, "omega_2": 9.0}), tmp_path / f"report{suffix}"
    written = {f"{abs(value):.4g}" for value in (*RIGHT.values(), 1.3, 300.0, 9.0)}
    solution = solve(TASK, "example", lang="en")
    sizes = [abs(q.value) for q in solution.quantities.values() if q.value and len(f"{q.value:.4g}") > 3]

    run("check", TASK, file, "--verdict-only", "--lang", "en", "-o", str(report))
    own = report.read_text(encoding="utf-8")
    run("check", TASK, file, "--lang", "en", "-o", str(report))
    teachers = report.read_text(encoding="utf-8")

    hidden = {solution.words.short(size, 4) for size in sizes} - written
    assert [number for number in hidden if re.search(rf"(?<![\d.]){re.escape(number)}(?![\d.])", own)] == []
    assert len([number for number in hidden if number in teachers]) > 10
    assert "<svg" not in own
    assert ("<svg" in teachers) is (suffix == ".html")
    assert "First wrong step" in own


def test_a_page_escapes_what_students_write_loads_nothing_and_writes_numbers_in_full(tmp_path: Path, run: Run) -> None:
    file = answers(tmp_path, about="student;<script>alert(1)</script>\n")
    run("check", TASK, file, "-o", str(tmp_path / "r.html"))
    page = (tmp_path / "r.html").read_text(encoding="utf-8")
    assert "<script" not in page
    assert "&lt;script&gt;" in page
    assert not re.search(r"(?:src|href)=|@import|url\(", page)

    rows = "V_B;;;5,6;;359,98\na_BA_n;;;9;;\nF_3;;;78612;;0\n"
    page = report_html(check(TASK, "3", lang="en").mark(read(tmp_path, rows, "3")))
    assert "<td>a<sup>n</sup><sub>BA</sub></td>" in page
    assert "78612 N; 0°" in page
    assert not re.search(r"a\^n_BA|360°|e\+", page)


def test_answers_are_marked_from_python_without_a_word(tmp_path: Path, capsys: Printed) -> None:
    asked, done, told = check(TASK, "example", own=True, lang="en"), list[int](), list[str]()
    files = [answers(tmp_path), answers(tmp_path, {"a_B": 295.3}, name="b.csv")]

    report = asked.mark(asked.read(files[0])[0])
    results = asked.mark_all(asked.read(*files), tmp_path / "reports", lambda more, whole: done.append(more), jobs=1)
    unread = asked.read(files[0], str(tmp_path / "none.csv"), warn=lambda error: told.append(error.key))

    assert report.own
    assert report.marked.marking.first_wrong is None
    assert results[0].mark == report.marked.mark > (results[1].mark or 0.0)
    assert sum(done) == len(list((tmp_path / "reports").glob("*.html"))) == 2
    assert [one.unread is None for one in unread] == [True, False]
    assert told == ["file-missing"]
    with pytest.raises(InputError):
        asked.read(files[0], str(tmp_path / "none.csv"))
    with pytest.raises(InputError, match=r"V_B: 'abc' is not a number.*; .*a_B: 'def'"):
        asked.mark({"V_B": "abc", "a_B": "def"})
    assert asked.mark({"V_B": "abc", "a_B": "295 м/с²"}).marked.notes[0].key == "number-bad"
    assert capsys.readouterr() == ("", "")


@pytest.mark.parametrize(
    ("arguments", "what"),
    [
        ((TASK,), "nothing to do"),
        ((TASK, "missing.csv"), "there is no such file"),
        ((TASK, "--form", "x.docx"), "ends in one of: .csv, .xlsx"),
        ((TASK, "printed", "-v", "99"), "'99'"),
        ((TASK, "printed", "-o", "x.docx"), "unknown kind of file"),
        ((TASK, "printed", "--preset", "best"), ", ".join(PRESETS)),
        (("scheme-01-compressor", "printed"), "the source of scheme-01-compressor prints no answers"),
        ((TASK, "."), "no files with answers"),
    ],
)
def test_what_cannot_be_checked_is_answered_in_one_line(
    tmp_path: Path, run: Run, monkeypatch: pytest.MonkeyPatch, arguments: tuple[str, ...], what: str
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("LC_ALL", "C")

    status, out, err = run("check", *arguments)

    assert (status, out, err.count("\n")) == (2, "", 1)
    assert what in err
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(  # of three, no and two times of equation (12)
    "variant", ["V04", *(pytest.param(variant, marks=pytest.mark.soak) for variant in ("V01", "V07"))]
)
@pytest.mark.parametrize("own", some([True, False], 0))
def test_the_form_of_any_variant_filled_rightly_has_the_full_mark(tmp_path: Path, variant: str, own: bool) -> None:
    """What one variant is asked and another is not was refused as unknown, or missing without having been asked."""
    solution, asked = solve("karpenko-hoist", variant), check("karpenko-hoist", lang="en")
    form = (check("karpenko-hoist", variant, lang="en") if own else asked).write_form(tmp_path / "form.csv")
    rows = [*csv.reader(form.read_text(encoding="utf-8-sig").splitlines())]
    for row in rows:
        if row[0] in solution.quantities and len(row) > 6:
            row[5:7] = [f"{solution[row[0]].value:.6g}", solution[row[0]].unit]
        row[1:2] = [variant] if row[0] == "variant" else row[1:2]

    report = asked.mark(asked.read(str(write(tmp_path, rows)))[0])

    assert (report.marked.mark, report.marked.notes) == (100.0, ())


def test_another_variant_and_a_wrong_sheet_id_are_told_of(tmp_path: Path, run: Run) -> None:
    other = sheet_id(load_task(TASK), "5")

    status, out, _ = run("check", TASK, answers(tmp_path, about=f"sheet id;{other}\n"), "-v", "3", "--lang", "en")

    assert status == 0
    assert f"the sheet id '{other}' is that of variant 5, not of variant 3" in out.partition("To be noted")[0]
    assert "variant: 3" in out
    assert "the form says variant 'example'; it is marked as variant 3" in out


FOUR_BAR = sheet_id(load_task("madi-four-bar"), "17")


@pytest.mark.parametrize(
    ("task", "number", "rows", "other"),
    [
        ("madi-four-bar", "", "", "madi-four-bar"),
        ("MADI-four-bar", "", "", "madi-four-bar"),
        ("", FOUR_BAR.lower(), "", "madi-four-bar"),
        ("our-press", "", "V_C;;;1;;\nV_CB;;;1;;\nomega_3;;;1;;\n", "our-press"),  # a task file of somebody's own
        ("NAU-slider-crank", "", "", ""),
        ("Кривошипно-повзунний механізм", "", "V_C;;;1;;\n", ""),
        ("madi-four-bar", sheet_id(load_task(TASK), "5"), "", ""),  # with the id of a sheet of this task
        ("3", "", "", ""),
        ("our-class", "2SW-4SG", "", "our-class"),  # of the same mechanism with other numbers: neither is of this task
        ("our-class", sheet_id(load_task(TASK), "5"), "", ""),
        ("3", "T3K-12H", "", ""),
        ("", "T3K-12H", "", ""),  # miscopied
    ],
)
def test_answers_for_another_task_are_refused_and_a_head_that_was_edited_is_not(
    tmp_path: Path, run: Run, task: str, number: str, rows: str, other: str
) -> None:
    """They were marked as if they were for this task, with a remark at the end."""
    (folder := tmp_path / "answers").mkdir()
    file = answers(folder, about=f"sheet id;{number}\nstudent;Коваль\n", name="koval.csv")
    text = Path(file).read_text(encoding="utf-8").replace(f"task;{TASK}", f"task;{task}", 1)
    Path(file).write_text(text + rows, encoding="utf-8")
    answers(folder, about="student;Бондар\n", name="bondar.csv")

    status, out, err = run("check", TASK, file, "--lang", "en")
    _, of_class, _ = run("check", TASK, folder, "--lang", "en", "-o", tmp_path / "m.csv", "-o", tmp_path / "c.html")

    assert (status, out == "", err.count("\n")) == ((2, True, 1) if other else (0, False, 0))
    told = f"these answers are for the task '{other}', not for {TASK}"
    line = next(line for line in of_class.splitlines() if line.startswith("Коваль"))
    page = (tmp_path / "c.html").read_text(encoding="utf-8")
    assert [told in where for where in (err, line, page.replace("&#x27;", "'"))] == [bool(other)] * 3
    assert ("there is no quantity" in line) is False
    assert f"marked: {1 if other else 2}," in of_class


def test_the_table_of_a_class_for_another_task_is_refused(tmp_path: Path, run: Run) -> None:
    """Each of its columns was told to be unknown, and the others were marked."""
    head, row = "student;V_B, m/s;V_C, m/s;V_CB, m/s;V_S3, m/s;V_S2, m/s", "Коваль;1;2;3;4;5"
    (file := tmp_path / "class.csv").write_text(f"{head}\n{row}\n", encoding="utf-8")

    status, out, err = run("check", TASK, file, "-v", "3", "--lang", "en")

    assert (status, out, err.count("\n")) == (2, "", 1)
    assert "most columns of answers name no quantity of the task: V_C, V_CB, V_S3" in err.replace("'", "")


def test_a_sheet_id_belongs_to_task_variant_and_data_and_stands_on_the_sheet(tmp_path: Path) -> None:
    task = load_task(TASK)
    ids = {sheet_id(task, name) for name in task.variants}

    assert len(ids) == len(task.variants)
    assert sheet_id(task, "3", {"phi": "121 deg"}) not in ids
    assert sheet_id(task, "3", {"phi": "120 deg"}) == sheet_id(task, "3")
    assert variant_of_id(task, sheet_id(task, "7")) == "7"
    assert all(re.fullmatch(r"[0-9A-HJKMNP-TV-Z]{3}-[0-9A-HJKMNP-TV-Z]{3}", one) for one in ids)
    for norm in ("gost", "iso"):
        sheet(TASK, "3", only="velocity", norm=norm, lang="en").save(tmp_path / "sheet.svg")
        assert f"Sheet id: {sheet_id(task, '3')}" in (tmp_path / "sheet.svg").read_text(encoding="utf-8")
    for written in ("T3K12J", "t3k-12j", " Т3К 12J", "T3K-I2J", "T3K-l2j"):  # as people copy
        assert same_id(written, "T3K-12J")
    assert not same_id("T3K-12H", "T3K-12J")


@pytest.mark.parametrize(("number", "variant", "told"), [("", "0", True), (sheet_id(load_task(TASK), "5"), "5", False)])
def test_a_form_without_a_variant_has_that_of_its_sheet_id(
    tmp_path: Path, number: str, variant: str, told: bool
) -> None:
    found = replace(read(tmp_path, rows_of("5"), None), about={"sheet": number} if number else {})

    marked = check(TASK, lang="en").mark(found).marked

    assert marked.keyed.solution.variant == variant
    assert ["nowhere said" in note.text("en") for note in marked.notes if "nowhere" in note.text("en")] == [True] * told


@pytest.mark.parametrize("suffix", [".csv", ".xlsx"])
@pytest.mark.parametrize(
    ("task", "own", "name"),
    [
        (TASK, {"l_OA": "55,5 mm", "phi": "50 deg"}, "V_B"),
        ("madi-gear", {"z_1": "17"}, "d_1"),
        ("madi-cam", {"h": "31.5 mm"}, "mu_s"),
    ],
)
def test_a_form_for_data_of_ones_own_is_marked_with_them(
    tmp_path: Path, task: str, own: dict[str, str], name: str, suffix: str
) -> None:
    """It said nothing of them: without `--set` it was marked with the data of the variant."""
    variant = next(iter(load_task(task).variants))
    made = check(task, variant, set=own, lang="uk")
    rows = [list(row) for row in read_grid(made.write_form(tmp_path / f"form{suffix}")).rows]
    right = solve(task, variant, set=own)[name]
    for row in rows:
        if row[:1] == [name]:
            row[5:7] = [f"{abs(right.value):.5g}", right.unit]
    file = str(write(tmp_path, rows, suffix))

    def marked(**how: Any) -> tuple[str, list[str]]:
        asked = check(task, lang="en", **how)
        report = asked.mark(asked.read(file)[0])
        (line,) = report.marked.marking.answered
        return line.verdict, [*report.lists["flags"]]

    verdict, flags = marked()
    assert (verdict, len(flags)) == ("right", 1)
    assert "is for data of its own, and marked with them" in flags[0]
    assert marked(set=own) == ("right", [])
    other = {given: "51 deg" if given == "phi" else value for given, value in own.items()} | {"l_OA": "75 mm"}
    if task == TASK:
        verdict, flags = marked(set=other)
        assert verdict == "wrong"
        told = "the form is for the data 'phi = 50 °; l_OA = 55,5 мм'; it is marked with others"
        assert flags == [f"{told}, those of the roster or of --set"]


@pytest.mark.parametrize("language", ["uk", "ru", "en"])
@pytest.mark.parametrize("task", some(tasks(), 1, 2, 5))
def test_all_data_of_a_task_come_back_from_the_row_of_a_form(task: str, language: str) -> None:
    of = load_task(task)
    variant = next(iter(of.variants))
    case = Request(of, variant, language=language).case()

    said = data_said(data_text(case, case.givens))

    assert said.keys() == case.givens.keys()
    assert sheet_id(of, variant, said) == sheet_id(of, variant)


def test_data_of_a_form_that_cannot_be_read_are_told_and_not_passed_over(tmp_path: Path, run: Run) -> None:
    status, out, err = run("check", TASK, answers(tmp_path, about="own data;l_OA = багато\n"), "--lang", "en")

    assert (status, out, err.count("\n")) == (2, "", 1)
    assert "a.csv, l_OA = багато: l_OA: 'багато' is not a number" in err


@pytest.mark.parametrize("shared", [{}, {"l_OA": "55 mm"}])
def test_a_form_of_a_class_carries_the_data_that_students_have(tmp_path: Path, shared: dict[str, str]) -> None:
    roster = write(tmp_path, [["student", "variant", "phi [deg]"], ["А", "3", "50"], ["Б", "3", ""]], name="roster")
    form = check(TASK, roster=roster, set=shared, lang="uk").write_form(tmp_path / "form.csv")
    rows = [list(row) for row in read_grid(form).rows]
    rows = [row + [""] * (len(rows[0]) - len(row)) for row in rows]
    for row, data in zip(rows[1:], ({"phi": "50 deg"}, {}), strict=True):
        row[rows[0].index("V_B, м/с")] = f"{abs(solve(TASK, '3', set=shared | data)['V_B'].value):.4g}"
    file, asked = str(write(tmp_path, rows)), check(TASK, lang="en")
    told = [row[rows[0].index("власні дані")] for row in rows[1:]]

    found = [asked.mark(one).marked for one in asked.read(file)]

    assert told == (["phi = 50 °; l_OA = 55 мм", "l_OA = 55 мм"] if shared else ["phi = 50 °", ""])
    assert [line.verdict for one in found for line in one.marking.answered] == ["right", "right"]
    assert [any(note.key == "marked-data" for note in one.notes) for one in found] == [True, bool(shared)]


@pytest.mark.parametrize(
    ("row", "verdict"),
    [
        ("V_B;;;5,62 км;м/с;", "scale"),
        ("V_B;;;5,62;km;", "scale"),
        ("V_B;;;5,62 м/с²;м/с;", "scale"),
        ("omega_2;;;15,7 м/с;;", "scale"),
        ("h_2;110 км;;;;", "scale"),
        ("V_B;;;6,62 км;;", "wrong"),
        ("V_B;;;20,24 км/год;;", "right"),
        ("V_B;;;5620 мм/с;;", "right"),
        ("V_B;;;5,62 мс;;", "right"),  # a slip of the pen
        ("V_B;;;5,62 сажень;;", "right"),
    ],
)
def test_a_right_number_in_a_unit_of_another_quantity_has_a_wrong_unit(tmp_path: Path, row: str, verdict: str) -> None:
    """It was right, with a remark that the unit does not fit."""
    report = check(TASK, "3", lang="en").mark(read(tmp_path, f"{row}\n", "3"))

    (line,) = report.marked.marking.answered
    assert line.verdict == verdict
    assert (report.marked.marking.first_wrong == line.name) is (verdict != "right")
    if verdict == "scale":
        (said,) = [one["answer"] for one in report.to_json()["lines"] if one["quantity"] == line.name]
        assert said in ("5.62 км", "5.62 km", "5.62 м/с²", "15.7 м/с", "110 км")  # as it was written
        assert report.lists["again"][0].endswith(": only they are wrong")
        assert "does not fit" in report.lists["notes"][0]


@pytest.mark.parametrize(
    ("row", "verdict"),
    [
        ("sigma_max;;;256,1 Па;;", "scale"),
        ("sigma_max;;;256100000;;", "scale"),
        ("sigma_max;;;256100;;", "scale"),
        ("sigma_max;;;2561;;", "wrong"),
        ("m;;;3,265;;", "scale"),
        ("C_12;;;1491;;", "scale"),
        ("C_12;;;6773000;;", "wrong"),
        ("t_1;;;165,8;;", "scale"),
        ("V_t;;;0,13 км/год;;", "scale"),
        ("V_t;;;0,468 км/год;;", "right"),
        ("F_12_max;;;29,82;;", "scale"),
    ],
)
def test_a_right_number_in_another_unit_of_its_quantity_has_a_wrong_unit(
    tmp_path: Path, row: str, verdict: str
) -> None:
    """A stress in Pa, a mass in tons, a stiffness in kN/m were wrong, without a part of the mark."""
    found = check("karpenko-hoist", "V03").mark(read(tmp_path, f"{row}\n", "V03", "karpenko-hoist"))

    assert [line.verdict for line in found.marked.marking.answered] == [verdict]


def test_a_wrong_unit_over_a_column_is_no_error_of_a_student(tmp_path: Path) -> None:
    (file := tmp_path / "class.csv").write_text(
        "student;V_B, м/с²;V_A, m/s\nА;5,62;5,86\nБ;5,62 км;5,86\n", encoding="utf-8"
    )
    asked = check(TASK, "3", lang="en")

    verdicts = [[str(line.verdict) for line in asked.mark(one).marked.lines] for one in asked.read(str(file))]

    assert verdicts == [["right", "right"], ["right", "scale"]]


def test_a_record_book_gives_the_variant() -> None:
    for book, digits, variant in (("АТ-2023/417", 1, "7"), ("20230000", 1, "0"), ("123", 2, "3"), ("115", 2, "5")):
        assert variant_of_book(load_task(TASK), book, digits) == variant
    with pytest.raises(InputError, match="at least so many digits: 1"):
        variant_of_book(load_task(TASK), "АТ")


def test_a_roster_gives_variants_and_own_data(tmp_path: Path, run: Run) -> None:
    roster = tmp_path / "class.csv"
    roster.write_text(
        "student;record book;variant;phi [deg]\nА. Перша;11;example;60\nБ. Другий;12;;\n", encoding="utf-8"
    )

    same = marked(run, answers(tmp_path, about="student;А.Перша\n"), "--roster", str(roster))
    other = marked(run, answers(tmp_path, about="student;Б. Другий\n"), "--roster", str(roster))

    assert (same["variant"], same["verdicts"]["V_B"], other["variant"]) == ("example", "right", "2")
    assert any("variant 'example'" in note or "варіант «example»" in note for note in other["notes"])


@pytest.mark.parametrize(
    ("text", "what"),
    [
        ("student;variant\nX;33\n", "B2: nau-slider-crank has no variant '33'"),
        ("student;phi [deg]\nX;багато\n", "B2, phi"),
        ("student;l_OAA [mm]\nX;5\n", "B1"),
        ("a;b\n1;2\n", "no row says what the columns hold"),
    ],
)
def test_a_wrong_roster_is_refused_with_its_cell(tmp_path: Path, text: str, what: str) -> None:
    file = tmp_path / "r.csv"
    file.write_text(text, encoding="utf-8")

    with pytest.raises(InputError) as caught:
        read_roster(file, load_task(TASK))

    assert what in caught.value.text("en")


@pytest.mark.parametrize(("rows", "another"), [("5", True), ("3", False)])
def test_answers_to_another_variant_are_told(tmp_path: Path, rows: str, another: bool) -> None:
    found = read(tmp_path, rows_of(rows), "3")

    report = check(TASK, "3", lang="en").mark(found)
    own = check(TASK, "3", lang="en", own=True).mark(found)

    assert [flag.startswith("the answers fit variant 5") for flag in report.lists["flags"]] == [True] * another
    assert "flags" not in own.lists
    assert [line.startswith("the variant:") for line in own.lists["again"][:1]] == [True] * another
    assert not any("5" in line.partition(":")[0] for line in own.lists["again"])
    assert bool(own.lists["again"]) is another  # how to go on where something is wrong


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
    segments = [(name, at_five[name].mm) for name in key(TASK, "5").questions]
    rows = "".join(f"{name};{mm:.1f};;;\n" for name, mm in segments if mm is not None)
    drawn.clear()

    report = asked.mark(read(tmp_path, rows, "3"))

    assert report.marked.fits == "5"
    assert drawn == {"3"}


def test_a_rubric_weighs_asks_and_requires_directions(tmp_path: Path, run: Run) -> None:
    asked = rubric(tmp_path, 'out_of = 10\nasked = ["V_B", "V_BA", "a_B"]\n[weights]\nV_B = 2\n')
    found = marked(run, answers(tmp_path, {"V_BA": 1.0}), "--rubric", asked)
    verdicts = found["verdicts"]
    worth = 2.0 * (verdicts["V_B"] in ("right", "carried")) + (verdicts["a_B"] in ("right", "carried"))
    assert [line["quantity"] for line in found["lines"]] == ["V_BA", "V_B", "a_B"]
    assert found["mark"] == pytest.approx(10.0 * worth / 4.0)

    for directions, mark in (("required", 50.0), ("optional", 100.0)):
        asked = rubric(tmp_path, f'asked = ["V_BA", "V_B"]\ndirections = "{directions}"\n')
        found = marked(run, answers(tmp_path), "--rubric", asked)
        assert found["mark"] == mark
        assert any("no direction" in note for note in found["notes"])


def test_the_first_wrong_step_is_one_that_is_asked_for(tmp_path: Path, run: Run) -> None:
    file = answers(tmp_path, {"a_BA_n": 1.5})

    alone = marked(run, file, "--rubric", rubric(tmp_path, 'asked = ["V_B", "V_BA", "omega_2"]\n'))
    other = marked(run, file, "--rubric", rubric(tmp_path, 'asked = ["V_B", "a_BA_n"]\n'))

    assert (alone["mark"], alone["first_wrong"]) == (100.0, None)
    assert other["first_wrong"] == "a_BA_n"


def test_an_error_that_is_not_asked_for_counts_once_in_the_first_line_asked_that_carries_it(tmp_path: Path) -> None:
    """Revolutions per minute in place of radians per second gave full marks for *V_B* and *ω_2* alone."""
    of, names = key(TASK, "3"), ("omega_1", "V_A", "V_BA", "V_B", "omega_2")
    asked = ["V_B", "omega_2"]
    checked = check(TASK, "3", lang="en", rubric=rubric(tmp_path, f"asked = {asked}\n"))
    for times, verdict in ((30.0 / math.pi, "scale"), (3.0, "wrong")):  # rpm is taken for a unit, as elsewhere
        fast = {name: f"{name};;;{times * abs(of[name]):.6g};;\n" for name in names}
        rows = ["".join(fast[name] for name in own) for own in (names, asked)]

        whole, short = (checked.mark(read(tmp_path, own, "3")).marked for own in rows)

        assert {line.name: str(line.verdict) for line in whole.lines} == {"V_B": verdict, "omega_2": "carried"}
        assert whole.marking.first_wrong == "V_B"
        assert short.mark <= whole.mark < 100.0  # from *V_B* alone nobody can say what *ω_2* follows from


def test_numbers_of_a_rubric_may_have_a_decimal_comma_in_quotes(tmp_path: Path) -> None:
    of = [read_rubric(rubric(tmp_path, f"[weights]\nV_B = {text}\n"), "normal", ASKED) for text in ("3.5", '"3,5"')]

    assert of[0] == of[1]


def test_a_rubric_sets_tolerances_and_limits_single_quantities(tmp_path: Path, run: Run) -> None:
    for name, value, text, verdicts in (
        ("V_B", 2.80, "[tolerance]\nmm = 0.1\npercent = 0.1\ndegrees = 0.05\n", ["right", "wrong"]),
        ("V_BA", 2.5, '[limits]\nV_BA = "50 cm/s"\n', ["wrong", "right"]),
    ):
        file, own = answers(tmp_path, {name: value}), ("--rubric", rubric(tmp_path, text))
        assert [marked(run, file, *how)["verdicts"][name] for how in ((), own)] == verdicts


@pytest.mark.parametrize(
    ("text", "what"),
    [
        ("outof = 5", "outof"),
        ('asked = ["V_X"]', "asked: there is no quantity 'V_X'"),
        ("[weights]\nV_B = -1", "weights.V_B"),
        ("[worth]\nalmost = 1", "worth.almost"),
        ("[worth]\nright = 150", "worth.right: '150': expected a number from 0 to 1"),
        ("[worth]\nwrong = 1.01", "worth.wrong"),
        ("[tolerance]\npercent = 101", "tolerance.percent: '101': expected a number from 0 to 100"),
        ("[tolerance]\ndegrees = 181", "tolerance.degrees"),
        ("[weights]\nV_B = -1\nV_X = 2\n[worth]\nright = 2", "V_X"),
        ("[weights]\nV_B = -1\nV_X = 2\n[worth]\nright = 2", "rubric.toml:5:1: worth.right"),
        ('asked = ["V_X", "V_B", "a_X"]', "'a_X'"),
        ("[limits]\nV_B = '1 kg'", "limits.V_B"),
        ("[tolerance]\nmm = true", "tolerance.mm"),
        ("weights = 3", "weights"),
        ('directions = "maybe"', "directions"),
        ("= 3", "rubric.toml:1:1: not valid TOML"),
        ("[worth]\nединица = 1\n", "rubric.toml:2:1: worth.единица: unknown key 'единица'; expected one of: right, "),
        ("вага = 1\n", "unknown key 'вага'; expected one of: out_of, asked"),
        ("[weights]\nV_B = 3,5\n", "rubric.toml:2:8: not valid TOML"),
        ('[weights]\nV_B = "3,5 mm"\n', "weights.V_B: '3,5 mm'"),
        ("\0", "not a rubric in TOML"),
    ],
)
def test_a_wrong_rubric_is_refused_with_its_key(tmp_path: Path, text: str, what: str) -> None:
    with pytest.raises(InputError) as caught:
        read_rubric(rubric(tmp_path, text), "normal", ASKED)

    assert what in caught.value.text("en")


@pytest.mark.parametrize(
    ("task", "rows", "verdict"),
    some(
        [
            ("madi-cam", "mu_s_d2s;;0,0005987 м/мм;;;\nr_0_flat;38,6;;38,6 мм;;\n", "right"),
            ("madi-cam", "mu_s_d2s;;0,0005987 м/мм;;;\nr_0_flat;48,6;;38,6 мм;;\n", "arithmetic"),
            ("karpenko-hoist", "mu_F_circle;;200 Н/мм;;;\nP_st;50;;50053 Н;;\n", "right"),
            ("karpenko-hoist", "P_st;50;;50053 Н;;\nb_0;15;;3 м;;\n", "right"),
        ],
        0,
    ),
)
def test_a_segment_may_be_that_of_the_drawing_on_which_the_sheet_shows_it(
    tmp_path: Path, task: str, rows: str, verdict: str
) -> None:
    marking = check(task, lang="en").mark(read(tmp_path, rows, None, task)).marked.marking

    assert {str(line.verdict) for line in marking.lines if line.answer is not None} == {verdict}


def test_a_line_bears_no_wrong_segment_of_another(tmp_path: Path) -> None:
    """Of two lines of a plan without a scale factor the mean was taken, which is that of neither."""
    marking = (
        check(TASK, "0", lang="en").mark(read(tmp_path, "R_32;169;;2535;;\nR_23;2540;;2535;;\n", "0")).marked.marking
    )

    told = {line.name: str(line.verdict) for line in marking.lines if line.answer is not None}
    assert told == {"R_32": "right", "R_23": "arithmetic"}


def test_equal_rates_of_a_link_are_judged_alike() -> None:
    """The source prints 0,0063 for both: for one it was drawn, for the other it did not follow to half a per cent."""
    asked = check("bertyaev-six-bar", lang="en")

    marking = asked.mark(asked.read("printed")[0]).marked.marking

    told = {line.name: str(line.verdict) for line in marking.lines}
    assert told["epsilon_2"] == told["epsilon_r_2"] == "right"


def test_a_single_slip_of_the_hand_is_called_one(tmp_path: Path) -> None:
    right, allowed = abs(key(TASK, "3")["V_BA"]), key(TASK, "3").allowed["V_BA"]
    for times, slip in ((1.5, True), (4.0, False)):
        rows = f"V_BA;;;{right + times * allowed:.5g};;\n"
        report = check(TASK, "3", lang="en").mark(read(tmp_path, rows, "3"))

        assert report.marked.slips is slip
        assert ("inaccurate" in "".join(report.lists["candidates"][:1])) is slip
        assert not slip or result_of(report.marked, "en").mistakes == ()


SCALED = "mu_a;;1,07;;;\na_A;80;;856;;\na_BA_n;4,4;;47,4;;\na_BA_t;69,9;;748;;\na_BA;70,1;;750;;\na_S2;59;;631;;\n"


def test_a_scale_factor_written_wrongly_in_its_row_counts_once(tmp_path: Path) -> None:
    found = read(tmp_path, SCALED, "3")
    for asked in ((), ("a_BA", "a_S2")):
        report = check(TASK, "3", lang="en", rubric=rubric(tmp_path, f"asked = {[*asked]}\n")).mark(found)

        faulty = [(line.name, str(line.verdict)) for line in report.marked.marking.lines if line.verdict.faulty]
        assert faulty == [((*asked, "a_A")[0], "scale")]
        assert report.lists["again"] == (
            "μ_a: too small by the factor 10; your segments and values fit 10.7 (m/s²)/mm",
        )
        assert report.lists["candidates"] == ()

    right_scale = SCALED.replace("1,07", "10,7").replace("856", "85,6").replace("47,4", "4,74")
    tenths = right_scale.replace("748", "74,8").replace("750", "75").replace("631", "63,1")  # not from segments
    assert check(TASK, "3", lang="en").mark(read(tmp_path, tenths, "3")).marked.misfits == {}


def test_a_scale_factor_beside_which_a_mistake_is_beyond_all_floats_is_marked(tmp_path: Path) -> None:
    checked = check("madi-cam", set={"mu_phi": "7e-9 deg/mm"})
    (tmp_path / "answers.csv").write_text(COLUMNS + "mu_a;;;180;;\n", encoding="utf-8")

    found = checked.mark(checked.read(str(tmp_path / "answers.csv"))[0])

    assert messages(found.marked.answers) == []
    assert "mu_a" in {row.line.name for _, rows in found.parts for row in rows if row.answer}


def test_letters_lie_on_no_others_and_beside_their_vector() -> None:
    random, corner = np.random.default_rng(SEED), complex(150.0, 150.0)
    ends = [complex(*xy) for xy in random.uniform(0.0, 150.0, (24, 2))]
    vectors = [(tail, tip, 4) for tail, tip in zip(ends[::2], ends[1::2], strict=True)]

    placed = list(boxes(vectors, corner))

    assert len(placed) == len(vectors)
    assert all(box.lies_in(corner) for box in placed)
    assert not any(one.meets(other) for one, other in combinations(placed, 2))
    assert Box(0j, 2.0).meets(Box(3.9 + 3.5j, 2.0))
    assert not Box(0j, 2.0).meets(Box(4.1, 2.0))
    for tail, tip in ((20 + 20j, 120 + 20j), (20 + 20j, 20 + 120j), (20 + 20j, 80 + 100j), (70 + 20j, 20 + 20j)):
        (box,) = boxes([(tail, tip, 3)], complex(140.0, 140.0))
        along = np.linspace(0.0, 1.0, 400) * (tip - tail) + tail - box.middle
        assert not np.any((np.abs(along.real) < box.half) & (np.abs(along.imag) < 1.8))


def test_figures_are_well_formed_and_scripts_go_back_to_their_line(tmp_path: Path) -> None:
    asked = check("madi-four-bar", lang="en")
    marked = asked.mark(asked.read("printed")[0]).marked
    figures = [ElementTree.fromstring(svg) for _, svg, _ in plan_figures(marked, "en")]

    texts = [text for figure in figures for text in figure.iter("text")]
    right = [text for text in texts if "".join(text.itertext()).endswith(" (✓)")]  # as in tables and on drawings
    assert "; (✓): right given the earlier error" in report_html(asked.mark(asked.read("printed")[0]))
    assert len(texts) > 20
    assert right
    for text in texts:
        levels = np.cumsum([float(piece.attrib["dy"]) for piece in text])
        assert levels[0] == 0.0
        assert [bool(abs(level) > 0.5) for level in levels] == ["font-size" in piece.attrib for piece in text]
        assert not any("baseline-shift" in piece.attrib for piece in text)
        assert text not in right or math.isclose(levels[-1], 0.0, abs_tol=1e-9)
    asked = check(TASK, "3", lang="en")
    zero = asked.mark(read(tmp_path, "V_A;;;5,9;;30\nV_B;;;0;;0\n", "3")).marked  # a vector that is a point
    for figure in (*figures, *(ElementTree.fromstring(svg) for _, svg, _ in plan_figures(zero, "en"))):
        assert all(re.fullmatch(r"M[-\d. MLhvz]+", path.attrib["d"]) for path in figure.iter("path"))
        width, height = map(float, figure.attrib["viewBox"].split()[2:])
        numbers = [float(n) for path in figure.iter("path") for n in re.findall(r"-?\d+\.\d+", path.attrib["d"])]
        assert 0.0 <= min(numbers) < max(numbers) <= max(width, height)


@pytest.mark.parametrize(
    ("rows", "cut"),
    [
        ("V_A;;;5,86;;\nV_BA;;;29,8;;\nV_B;;;5,62;;\n", "V_BA"),
        ("V_A;58,6;0,1;5,86;;\nV_BA;29,8;;29,8;;\nV_B;56,2;;5,62;;\n", ""),  # it has been drawn as it should be
        ("V_A;;;58,6;;\nV_BA;;;29,8;;\nV_B;;;56,2;;\nV_S2;;;56;;\n", "V_A, V_BA, V_B, V_S2"),
        ("V_A;;;5,86;;\nV_BA;;;4,5;;\nV_B;;;8;;\n", ""),
    ],
)
def test_a_value_many_times_too_large_leaves_the_right_plan_readable(tmp_path: Path, rows: str, cut: str) -> None:
    """It was drawn whole, and the right plan as small as a letter."""
    report = check(TASK, "3", lang="en").mark(read(tmp_path, rows, "3"))

    ((_, svg, told),) = plan_figures(report.marked, "en")

    figure = ElementTree.fromstring(svg)
    width, height = map(float, figure.attrib["viewBox"].split()[2:])
    right = [path.attrib["d"] for path in figure.iter("path") if path.attrib["class"] == "right"]
    places = np.array([re.findall(r"-?\d+\.\d+", path) for path in right], float).reshape(-1, 2)
    assert np.ptp(places, axis=0).max() > 0.45 * (max(width, height) - 2 * MARGIN)
    assert told == (f"Cut off at the edge, or beyond it: {cut}." if cut else "")
    every = [float(n) for p in figure.iter("path") for n in re.findall(r"-?\d+\.\d+", p.attrib["d"])]
    assert 0.0 <= min(every) < max(every) <= max(width, height)
    page = report_html(report)
    assert ("Cut off at the edge" in page) is bool(cut)


@pytest.mark.parametrize(
    ("times", "factors"),
    [
        pytest.param(10.0, "", id="measured in the detail"),
        pytest.param(1.0, "", id="measured on the plan"),
        pytest.param(10.0, "{mu}", id="with the scale factor of the detail"),
    ],
)
def test_a_force_that_is_read_in_a_detail_is_judged_by_its_scale_factor(
    tmp_path: Path, times: float, factors: str
) -> None:
    task = "scheme-13-toggle-press"
    solution = solve(task)
    mu, size = solution.scales["mu_F_23"].mu, abs(solution["R_12_t"].value or 0.0)
    row = f"R_12_t;{size / mu * times:.1f};{factors.format(mu=mu / times)};{size:.1f}"
    whole = f"R_12;{abs(solution['R_12'].value or 0.0) / mu:.1f};;"
    (file := tmp_path / "answers.csv").write_text(f"quantity;mm;mu;value\n{row}\n{whole}\n", encoding="utf-8")
    asked = check(task, "0", lang="en")

    report = asked.mark(asked.read(str(file))[0])

    told = {row.line.name: (str(row.line.verdict), row.answer) for _, rows in report.parts for row in rows}
    assert told["R_12_t"] == ("right", f"{size / mu * times:.1f} mm; {size:.1f} N")
    assert told["R_12"][0] == "right"


@pytest.mark.parametrize(
    "row",
    [
        pytest.param("mu_l;;;0.001\nh_21;39.5;;", id="on the plan"),
        pytest.param("mu_l;;;0.001\nh_21;79;;", id="on the figure of the driver"),
        pytest.param("h_21;79;;0.0395", id="on the figure of the driver, with its value"),
        pytest.param("h_21;79;;0.0395\nmu_l;;;0.002", id="on that of the sheet, the plan at another scale factor"),
        pytest.param("mu_l;;;0.001\nmu_l_1;;;0.0005\nh_21;79;;", id="with the scale factor of the figure"),
    ],
)
def test_an_arm_of_the_driver_is_judged_by_the_drawing_on_which_it_was_measured(tmp_path: Path, row: str) -> None:
    (file := tmp_path / "answers.csv").write_text(f"quantity;mm;mu;value\n{row}\n", encoding="utf-8")
    asked = check(TASK, "3", lang="en")

    report = asked.mark(asked.read(str(file))[0])

    (told,) = [row for _, rows in report.parts for row in rows if row.line.name == "h_21"]
    assert str(told.line.verdict) == "right"
    assert told.answer.startswith(f"{row.partition('h_21;')[2].partition(';')[0]} mm")  # as it was written


@pytest.mark.parametrize(("mm", "verdict"), [(79.0, "right"), (50.0, "wrong"), (39.5, "wrong")])
def test_the_scale_factor_of_the_drivers_figure_is_read_of_any_variant(tmp_path: Path, mm: float, verdict: str) -> None:
    text = f"variant;3\nquantity;mm;value\nmu_l_1;;0.0005\nh_21;{mm};\n"
    (file := tmp_path / "answers.csv").write_text(text, encoding="utf-8")
    asked = check(TASK, lang="en")  # whose first variant has no such figure

    report = asked.mark(asked.read(str(file))[0])

    (told,) = [row for _, rows in report.parts for row in rows if row.line.name == "h_21"]
    assert report.marked.notes == ()
    assert str(told.line.verdict) == verdict


@pytest.mark.parametrize("language", ["uk", "ru", "en"])
@pytest.mark.parametrize("suffix", [".csv", ".xlsx"])
def test_a_form_of_some_plans_tells_so_itself(tmp_path: Path, language: str, suffix: str) -> None:
    form = check(TASK, "3", only="velocity", lang=language).write_form(tmp_path / f"form{suffix}")
    grid = read_grid(form)
    head = next(at for at, row in enumerate(grid.rows) if len(row) > 2 and row[2])
    right = solve(TASK, "3")
    rows = [
        (*row[:5], f"{right[row[0]].value:.6g}", *row[6:]) if at > head and row[0] in right else row
        for at, row in enumerate(grid.rows)
    ]
    file = tmp_path / "filled.csv"
    file.write_text("\n".join(";".join(row) for row in rows), encoding="utf-8")

    whole, other, same = (check(TASK, only=only, lang=language) for only in (None, "acceleration", "velocity"))
    found, elsewhere, asked = (one.mark(one.read(str(file))[0]) for one in (whole, other, same))

    assert found.marked.mark == asked.marked.mark == 100.0
    assert [note.key for note in found.marked.notes if note.key != "marked-directions"] == ["marked-plans"]
    assert "marked-plans" not in {note.key for note in asked.marked.notes}
    assert "marked-plans-other" in {note.key for note in elsewhere.marked.notes}
    plan = {"uk": "бланк лише для планів: швидкості;", "ru": "бланк только для планов: скорости;"}.get(language)
    assert (plan or "asks only for the plans: velocity;") in report_html(found)
