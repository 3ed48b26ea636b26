"""A class marked: tables, reports, flags, Moodle; a stopped run goes on; hands that are too exact, or the same."""

from __future__ import annotations

import csv
import random
import re
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Sequence
from dataclasses import asdict, replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import openpyxl
import pytest

from kulman import check
from kulman.plans.hands.shaky import draw, preset
from kulman.tests.support.answer_files import write
from kulman.tests.support.commands import Run
from kulman.tests.support.marking_cases import answer, key, students
from kulman.variants.marking import checks
from kulman.variants.marking.checks import Job, _mark_class, reported, slug
from kulman.variants.marking.class_page import BAR, ClassPage
from kulman.variants.marking.marked import Desk
from kulman.variants.marking.reading import Answers, Reply, answers_of
from kulman.variants.marking.result import Result, _Measured, _too_exact, class_lines, measured, shared
from kulman.variants.marking.wording import mistake_texts, texts
from kulman.variants.roster import Entry, Roster, Who

TASK = "nau-slider-crank"
ASKED = ("V_A", "V_BA", "V_B", "V_S2", "omega_2", "a_BA_n", "a_BA_t", "a_B", "a_S2", "R_12", "R_32", "M_bal")
CHARACTER = 7 / 96 * 25.4  # mm that a character of a column is wide
MUS = {"mu_V": "velocity", "mu_a": "acceleration", "mu_F_23": "forces_23"}


def class_file(tmp_path: Path, count: int, drawn: bool = True) -> Path:
    """Write the answers of a class of variant 3: measured by a shaky hand, or calculated."""
    of = key(TASK, "3")
    hands = students(of, of.paper, count, 1) if drawn else ([answer(n, of[n]) for n in ASKED] for _ in range(count))
    head = ["student", "id number", "variant", *MUS, *(column for name in ASKED for column in (f"{name}.mm", name))]
    rows = [head]
    for number, hand in enumerate(hands, start=1):
        values = {a.name: a.value or 0.0 for a in hand}
        row = [f"Student {number:02d}", f"N{number}", "3", *(f"{of.paper.mus[plan]:.6g}" for plan in MUS.values())]
        for name in ASKED:
            question = of.questions[name]
            mu = of.paper.mus.get(question.plan) if question.step.verb == "read" else None
            mm = values[name] if drawn else abs(of[name])
            row += ["" if mu is None else f"{mm / mu:.1f}", f"{values[name]:.4g}"]
        rows.append(row)
    return write(tmp_path, rows, name="class")


def handed_in(tmp_path: Path, count: int, drawn: bool = True) -> list[Answers]:
    return check(TASK).read(str(class_file(tmp_path, count, drawn)))


def marked(answers: Sequence[Answers], folder: Path | None = None, jobs: int = 1) -> list[Result]:
    job = Job(check(TASK), None if folder is None else str(folder))
    return _mark_class(job, answers, lambda done, whole: None, jobs)


class Stopped:
    """Marks students and notes them; stops before one of a number, as a run that is interrupted."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch, at: int | None = None) -> None:
        self.at, self.names, self._mark = at, list[str](), checks._mark_one
        monkeypatch.setattr(checks, "_mark_one", self)

    def __call__(self, job: Job, desk: checks.Desk, number: int, one: Answers) -> Result:
        if number == self.at:
            raise KeyboardInterrupt
        self.names.append(one.who.student)
        return self._mark(job, desk, number, one)


def test_a_class_gets_tables_reports_and_grades(tmp_path: Path, run: Run) -> None:
    file, out, moodle = class_file(tmp_path, 5), tmp_path / "reports", tmp_path / "grades.csv"
    numbers = [[f"Student {number:02d}", str(number)] for number in (1, 2, 3, 4, 5, 9)]
    roster = write(tmp_path, [["student", "id number"], *numbers], name="roster")
    tables = tmp_path / "marks.xlsx", tmp_path / "marks.csv"

    status, printed, err = run(
        "check", TASK, file, "-v", "3", "--roster", roster, "--out", out, "--moodle", moodle,
        "-o", tables[0], "-o", tables[1], "--lang", "en",
    )  # fmt: skip

    assert (status, err) == (0, "")
    assert "students: 6, marked: 5" in printed
    assert "notes in the report" not in printed  # what is noted of all is said once
    assert printed.count("no direction of any vector was given") == 1
    assert len(list(out.glob("*.html"))) == len(list(out.glob("*.txt"))) == 5
    assert [path.name for path in out.iterdir() if path.name.startswith(".")] == [checks.REPORTS_NOTED]
    sheet = openpyxl.load_workbook(tables[0]).active
    assert sheet is not None
    head, first, *_, last = sheet.iter_rows(values_only=True)
    assert (head[:3], sheet.freeze_panes) == (("student", "group", "record book"), "B2")
    assert "email" not in head
    assert (first[0], first[head.index("mark")] >= 80) == ("Student 01", True)
    assert {"Student 09", "nothing handed in"} <= {*last}
    text = tables[1].read_text(encoding="utf-8-sig")
    assert sum(line.startswith("Student") for line in text.splitlines()) == 6
    grades = list(csv.DictReader(moodle.read_text(encoding="utf-8-sig").splitlines()))
    assert [row["ID number"] for row in grades] == ["1", "2", "3", "4", "5"]
    assert all(0.0 <= float(row["Grade"]) <= 100.0 for row in grades)


def test_a_file_that_cannot_be_read_does_not_stop_the_others(
    tmp_path: Path, run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("LC_ALL", "C")
    (folder := tmp_path / "answers").mkdir()
    class_file(folder, 2)
    (folder / "bad.csv").write_bytes(b"\0\0")
    (folder / "~$open.xlsx").write_bytes(b"x")
    marks = tmp_path / "marks.csv"

    status, out, err = run("check", TASK, folder, "-o", marks, "--lang", "en")
    by_pattern = run("check", TASK, folder / "c*.csv", "--lang", "en")[1]
    single, _, refusal = run("check", TASK, folder / "class.csv", "-o", tmp_path / "r.txt")

    assert (status, err.count("\n")) == (0, 1)
    assert "bad.csv: not a text" in err
    assert "students: 3, marked: 2" in out
    assert "students: 2" in by_pattern
    assert (single, "--out" in refusal, (tmp_path / "r.txt").exists()) == (2, True, False)
    bad = next(row for row in csv.reader(marks.read_text(encoding="utf-8-sig").splitlines()) if "bad.csv" in row[-2])
    assert bad[-3].startswith("not read: ")
    assert bad[7] == ""


def test_processes_and_one_process_give_the_same_and_a_result_survives_its_file(tmp_path: Path) -> None:
    answers, done = handed_in(tmp_path, 20), list[int]()

    alone = marked(answers)
    together = _mark_class(Job(check(TASK)), answers, lambda more, whole: done.append(more), jobs=2)

    assert together == alone
    assert sum(done) == 20
    assert [result.who.student for result in together] == [f"Student {number:02d}" for number in range(1, 21)]
    assert [Result.from_json(asdict(result)) for result in alone] == alone


def other_numbers(answers: Answers) -> dict[str, Reply]:
    return {name: replace(line, mm=None if line.mm is None else 2 * line.mm) for name, line in answers.lines.items()}


def test_a_stopped_run_goes_on_where_it_was(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    answers, folder = handed_in(tmp_path, 12), tmp_path / "reports"
    folder.mkdir()
    stopping = Stopped(monkeypatch, 10)
    with pytest.raises(KeyboardInterrupt):
        marked(answers, folder)
    with (journal := folder / checks.JOURNAL).open("a", encoding="utf-8") as stream:
        stream.write('{"digest": "torn')
    assert len(stopping.names) == 10
    stopping.names.clear()
    stopping.at = None
    changed = [answers[0], replace(answers[1], lines=other_numbers(answers[1])), *answers[2:]]

    results = marked(changed, folder)

    assert stopping.names == ["Student 02", "Student 11", "Student 12"]  # nobody who was marked is marked again
    assert not journal.exists()
    assert [replace(result, reports=()) for result in results] == marked(changed)
    assert all((folder / name).is_file() for result in results for name in result.reports)


def test_reports_of_students_who_are_no_longer_there_are_removed(tmp_path: Path) -> None:
    answers, folder = handed_in(tmp_path, 4), tmp_path / "reports"
    folder.mkdir()
    (foreign := folder / "004-Student-09.html").write_text("somebody's own", encoding="utf-8")
    marked(answers, folder)
    (changed := folder / "004-Student-04.txt").write_text("with remarks", encoding="utf-8")

    marked(answers[:1] + answers[2:3], folder)

    reports = {f"{stem}{kind}" for stem in ("001-Student-01", "002-Student-03") for kind in (".html", ".txt")}
    there = {path.name for path in folder.iterdir() if path.suffix in (".html", ".txt")}
    assert there == {*reports, foreign.name, changed.name}


@pytest.mark.soak
def test_a_killed_run_leaves_no_process_and_goes_on(tmp_path: Path) -> None:
    file, folder, journal = class_file(tmp_path, 200), tmp_path / "out", tmp_path / "out" / checks.JOURNAL
    command = [sys.executable, "-m", "kulman", "check", TASK, str(file), "--out", str(folder), "--jobs", "2"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL) as run_of:
        while not (journal.exists() and journal.read_bytes().count(b"\n") > 20):
            assert run_of.poll() is None
            time.sleep(0.02)
        run_of.kill()
        assert run_of.stdout is not None
        run_of.stdout.read()  # ends when no process holds the other end any more
    before = {path.name: path.stat().st_mtime_ns for path in folder.glob("*.html")}
    kept = journal.read_bytes().count(b"\n")

    done = subprocess.run(command, capture_output=True, text=True, encoding="utf-8", check=True)

    after = {path.name: path.stat().st_mtime_ns for path in folder.glob("*.html")}
    assert len(after) == 200
    assert sum(after[name] == at for name, at in before.items()) >= min(kept, len(before)) - 16
    assert not journal.exists()
    assert "200" in done.stdout


def test_calculated_segments_are_too_exact_and_drawn_or_rounded_ones_are_not(tmp_path: Path) -> None:
    assert [result.exact for result in marked(handed_in(tmp_path, 25))] == [False] * 25
    assert marked(handed_in(tmp_path, 1, drawn=False))[0].exact
    for decimals, step, exact in ((2, 0.01, True), (0, 1.0, False)):
        sizes = [30.0 + 1.37 * i for i in range(8)]
        assert _too_exact({f"q{x}": _Measured(round(x, decimals), x, step, 0.7) for x in sizes}) is exact
    assert not _too_exact({})


def test_students_who_share_their_errors_are_named(tmp_path: Path, run: Run) -> None:
    file = class_file(tmp_path, 12)
    lines = file.read_text(encoding="utf-8").splitlines()
    lines[8] = ";".join(["Student 08", "N8", *lines[3].split(";")[2:]])
    file.write_text("\n".join(lines), encoding="utf-8")

    _, out, _ = run("check", TASK, file, "--lang", "en")

    flagged = [line for line in out.splitlines() if "the same millimetres" in line]
    assert [line.startswith("Student 03") and "Student 08" in line for line in flagged] == [True, False]


def drawn_segments(
    task: str,
    hand: str,
    count: int,
    step: float = 0.5,
    plans: tuple[str, ...] | None = None,
    seed: int = 5,
    variant: str | None = None,
) -> list[dict[str, _Measured]]:
    """Return what students of one variant have measured on drawings of their own, read to `step` mm."""
    of = key(task, variant)
    board = draw(of.paper, preset(hand).hand, np.random.default_rng(seed), count)
    asked = [q for q in of.questions.values() if plans is None or q.plan in plans]
    mus = {q.name: of.paper.mus.get(q.plan) for q in asked if q.step.verb in ("read", "arm")}
    sizes = {name: np.broadcast_to(abs(board.values[name]), (count,)) / mu for name, mu in mus.items() if mu}
    read = [{name: round(float(mm[i] / step)) * step for name, mm in sizes.items()} for i in range(count)]
    lines = [{name: Reply(name, mm, decimals=1) for name, mm in one.items()} for one in read]
    return [measured(Answers("", Who(), {}, one, {}), of, of.paper.mus, {}) for one in lines]


def copied(of: dict[str, _Measured], dice: random.Random) -> dict[str, _Measured]:
    """Return segments of somebody who has copied, and changed a third of them by half a millimetre."""
    changed = {name: dice.choice([-0.5, 0.5]) for name in dice.sample(sorted(of), len(of) // 3)}
    return {name: replace(segment, mm=segment.mm + changed.get(name, 0.0)) for name, segment in of.items()}


@pytest.mark.parametrize("hand", ["careful", "normal"])
@pytest.mark.parametrize(("task", "least"), [("nau-slider-crank", 0.9), ("madi-four-bar", 0.99)])
def test_of_pairs_of_one_variant_only_those_are_told_that_copy(task: str, least: float, hand: str) -> None:
    """Honest: 1,770 pairs, none of them. A careful hand errs by so little that copies of it are hard to tell."""
    hands, dice = drawn_segments(task, hand, 60), random.Random(3)

    told = [len(list(shared([one, copied(one, dice)]))) for one in hands]

    assert len(list(shared(hands))) <= (0 if hand == "normal" else 1)
    assert sum(len(list(shared([one, other]))) for one, other in pairwise(hands)) == 0
    assert sum(told) >= (least if hand == "normal" else 0.4) * len(hands)


@pytest.mark.parametrize(("task", "least"), [("nau-slider-crank", 0.2), ("madi-four-bar", 0.85)])
def test_in_a_class_of_two_plans_copies_are_told_and_honest_hands_are_not(task: str, least: float) -> None:
    plans = ("velocity", "acceleration")
    classes = [drawn_segments(task, "normal", 24, plans=plans, seed=seed) for seed in range(3)]

    told = [
        {(pair.first, pair.second) for pair in shared([*hands, dict(hands[i])])} for hands in classes for i in range(24)
    ]

    assert sum(len(list(shared(hands))) for hands in classes) <= 1  # of 828 pairs
    assert sum((n % 24, 24) in pairs for n, pairs in enumerate(told)) >= least * len(told)


def test_a_work_of_another_variant_is_told_and_honest_works_of_two_are_not() -> None:
    """Nothing was told of a whole row of another variant handed in, gross mistakes too."""
    variants = ["0", "3", "6", "8"]
    classes = {variant: drawn_segments(TASK, "normal", 15, variant=variant) for variant in variants}
    hands = [(variant, hand) for variant, several in classes.items() for hand in several]
    works = classes["0"][:8]
    rights = [classes["8"][0], classes["3"][0]] * 4
    pairs = [
        [one, {name: replace(of, mm=one[name].mm) for name, of in right.items() if name in one}]
        for one, right in zip(works, rights, strict=True)
    ]

    told = [len(list(shared(pair, ["0", "other"]))) for pair in pairs]

    assert told == [1] * 8
    assert list(shared([hand for _, hand in hands], [variant for variant, _ in hands])) == []


def test_marks_that_are_read_in_several_ways_are_counted_as_often_as_they_can_err() -> None:
    """A mark has two coordinates; half of a vector that is laid off errs as little as that does."""
    for task in ("nau-slider-crank", "madi-four-bar"):
        (names,) = (one.keys() for one in drawn_segments(task, "normal", 1, plans=("velocity", "acceleration")))

        assert len({"a_BA", "a_BA_t", "a_B", "a_C", "a_C_t", "a_CB", "a_CB_t"} & {*names}) == 2
        assert not {"V_S1", "a_S1"} & {*names}


def test_who_goes_on_honestly_from_the_same_mistake_has_not_copied() -> None:
    """Two careful hands, both 30 % too large from the same mistake on: what follows from it is what should be there."""
    dice, sizes = random.Random(2), [1.3 * (20.0 + 7 * i) for i in range(16)]
    one, other = ({f"q{x}": _Measured(round(2 * dice.gauss(x, 0.2)) / 2, x, 0.5, 0.7) for x in sizes} for _ in range(2))

    assert list(shared([one, other])) == []
    assert sum(abs(one[name].mm - other[name].mm) < 1e-6 for name in one) > 6


@pytest.mark.parametrize("everybody", [False, True])
def test_wrong_readings_that_two_share_are_told_unless_others_have_them(
    tmp_path: Path, run: Run, everybody: bool
) -> None:
    """Of two plans there were too few segments: not even all seven of one, three far off, told of a copy of it."""
    of, dice, lines = key(TASK, "3"), random.Random(4), list[list[object]]()
    mus, far = {"V": 0.1, "a": 10.0}, {"V_BA": 11.0, "a_B": 27.0, "a_S2": -27.5}
    names = ("V_BA", "V_B", "V_S2", "a_BA_t", "a_BA", "a_B", "a_S2")
    for number in range(20):
        wrong = far if everybody or number in (4, 13) else {}
        right = {name: abs(of[name]) / mus[name[0]] + wrong.get(name, 0.0) for name in names}
        lines.append([f"Student {number:02d}", *(round(2 * dice.gauss(mm, 0.6)) / 2 for mm in right.values())])
    if not everybody:
        lines[13][1:] = lines[4][1:]
        lines[14][6:] = lines[5][6:] = [dice.choice((20.0, 55.0)), 40.0]  # may be chance, among 190 pairs
    file = write(tmp_path, [["student", *(f"{name}, mm" for name in names)], *lines], name="class")

    _, out, _ = run("check", TASK, file, "-v", "3", "--lang", "en")

    told = [line[:10] for line in out.splitlines() if "the same millimetres" in line]
    assert told == ([] if everybody else ["Student 04", "Student 13"])


@pytest.mark.parametrize("step", [0.5, *(pytest.param(step, marks=pytest.mark.soak) for step in (0.1, 1.0))])
def test_honest_hands_seldom_share_their_segments(step: float) -> None:
    """Fifty classes of thirty, 12 segments each, in which chance alone makes hardly a pair: one at most."""
    dice, pairs = random.Random(1), 0
    for _ in range(50):
        sizes = [40.0 + 5 * i for i in range(12)]
        hands = [
            {f"q{x}": _Measured(round((x + dice.gauss(0.0, 0.5)) / step) * step, x, step, 0.5) for x in sizes}
            for _ in range(30)
        ]
        pairs += len(list(shared(hands)))

    assert pairs <= 1


def test_the_form_of_a_class_has_its_students_and_reports_their_names(tmp_path: Path, run: Run) -> None:
    roster = write(tmp_path, [["student", "record book"], ["=HYPERLINK(1)", "417"], ["Б", "5"]], name="roster")
    form = tmp_path / "form.csv"

    status, out, _ = run("check", TASK, "--form", form, "--roster", roster, "--lang", "uk")

    rows = list(csv.reader(form.read_text(encoding="utf-8-sig").splitlines(), delimiter=";"))
    assert (status, out) == (0, f"{form}\n")
    assert rows[1][0] == "'=HYPERLINK(1)"
    assert [row[4] for row in rows[1:]] == ["7", "5"]
    assert {"μ_V", "V_B, мм", "V_B, м/с", "V_B, напрям", "ω_2, рад/с", "ω_2, напрям"} <= {*rows[0]}
    for name, stem in (("Іваненко І. І.", "Іваненко-І-І"), ("../../etc", "etc"), ("???", "x")):
        assert slug(name) == stem


@pytest.mark.parametrize("only", [None, "velocity", "structure,position"])
def test_a_form_of_a_class_is_printed_so_that_it_can_be_read_and_filled_in(tmp_path: Path, only: str | None) -> None:
    roster = write(tmp_path, [["student", "variant"], *([f"Student {n}", n % 10] for n in range(30))], name="roster")
    asked = check("scheme-09-shaper", only=only, roster=roster, lang="uk")
    sheet = openpyxl.load_workbook(asked.write_form(tmp_path / "form.xlsx")).active
    assert sheet is not None

    wide = sum(column.width * (column.max - column.min + 1) for column in sheet.column_dimensions.values())
    across = (297 if sheet.page_setup.orientation == "landscape" else 210) - 25.4 * 2 * sheet.page_margins.left
    fitted = sheet.sheet_properties.pageSetUpPr is not None and sheet.sheet_properties.pageSetUpPr.fitToPage
    scale = min(1.0, across / (wide * CHARACTER)) if fitted else (sheet.page_setup.scale or 100) / 100

    assert 11 * scale >= 7.0  # points
    assert sheet.sheet_format.defaultRowHeight * scale / 72 * 25.4 >= 5.5
    assert (fitted, sheet.page_setup.fitToWidth or 1) == (True, 1) or sheet.print_title_cols == "$A:$A"
    assert (sheet.print_title_rows, sheet.print_options.gridLines) == ("$1:$1", True)


@pytest.mark.parametrize(("language", "head"), [("en", "l_CA, segment, mm"), ("uk", "l_CA, відрізок, мм")])
def test_a_segment_of_a_length_stands_under_words(tmp_path: Path, language: str, head: str) -> None:
    roster = write(tmp_path, [["student", "variant"], ["A", "2"]], name="roster")
    form = check("scheme-09-shaper", only="velocity", roster=roster, lang=language).write_form(tmp_path / "form.csv")
    names, row = csv.reader(
        form.read_text(encoding="utf-8-sig").splitlines(), delimiter="," if language == "en" else ";"
    )

    at = names.index(head)
    filled = [*row, *[""] * (len(names) - len(row))]
    filled[at : at + 2] = "41,5", "0,083"
    (answers,) = check("scheme-09-shaper").read(str(write(tmp_path, [names, filled])))

    assert (answers.lines["l_CA"].mm, answers.lines["l_CA"].value, answers.problems) == (41.5, 0.083, ())
    assert not [name for name in names if "." in name]


def test_a_class_is_told_who_is_missing_and_where_notes_are(tmp_path: Path, run: Run) -> None:
    roster = write(tmp_path, [["student", "variant"], ["Student 01", "3"], ["Student 02", "4"]], name="roster")
    rows = [["student", "V_B", "omega_2", "a_B", "V_A", "V_Q"], ["Student 02"], ["Student 01", "5,6", "-15,7", "", "x"]]
    answers = write(tmp_path, rows)

    status, out, err = run("check", TASK, answers, "--roster", roster, "-o", tmp_path / "m.csv", "--lang", "en")

    assert (status, "V_Q" in err) == (0, True)  # of the file, not of its first student, who has handed in nothing
    assert "  missing 2  " in out
    assert f"  notes in the report: 1 ({answers}" in out
    absent = [" ".join(line.split()) for line in out.splitlines() if "Student 02" in line]
    assert absent == ["Student 02 – nothing handed in"]


def test_a_wrong_row_of_the_roster_harms_no_other_student(tmp_path: Path, run: Run) -> None:
    faulty = [["Student 02", "17", "2"], ["Student 03", "", "1,2E+11"]]
    roster = write(tmp_path, [["student", "variant", "record book"], ["Student 01", "3", "1"], *faulty], name="roster")
    rows = [["student", "V_B", "V_A"], *([f"Student 0{n}", "5,6", "5,86"] for n in (1, 2, 3))]
    answers, form, grades = write(tmp_path, rows), tmp_path / "form.csv", tmp_path / "grades.csv"

    status, out, err = run(
        "check", TASK, answers, "--roster", roster, "--form", form, "--moodle", grades, "--lang", "en"
    )

    told = err.splitlines()
    assert (status, len(told)) == (0, 2)
    assert re.search("B3: .*17", told[0])
    assert re.search("C4: .*1,2E", told[1])
    variants = [row.split(",")[4] for row in form.read_text(encoding="utf-8-sig").splitlines()[1:]]
    assert variants == ["3", "", ""]
    assert "Student 01    100" in out
    assert [" – " in line for line in out.splitlines() if "Student 0" in line] == [False, True, True]
    assert grades.read_text(encoding="utf-8-sig").count("Student") == 1

    wrong = write(tmp_path, [["student", "variant"], ["Student 01", "17"], ["Student 02", "18"]], name="wrong")
    status, _, err = run("check", TASK, answers, "--roster", wrong, "--lang", "en")

    assert (status, "B2: " in err) == (2, True)  # of no row is it known which variant: that is another task's list


def test_a_roster_finds_who_is_named_once_by_the_surest_key() -> None:
    named = [("1", "О'Коннор І."), ("2", "Same Name"), ("3", "same  name."), ("", "Ёлкин")]
    entries = tuple(Entry(Who(student=student, number=number), "3", {}, "") for number, student in named)

    find = Roster(entries).find

    assert find(Who(number="2", student="О'Коннор І.")) is entries[1]
    assert find(Who(student="оконнор і")) is entries[0]
    assert find(Who(student="Same name")) is None
    assert find(Who(number="9", student="елкин")) is entries[3]
    assert find(Who()) is None


def test_students_who_share_a_variant_are_told_but_none_with_data_of_their_own(tmp_path: Path) -> None:
    of = [["Kim", "3", ""], ["Lee", "3", ""], ["Smith", "4", "121 mm"], ["Jones", "4", "122 mm"], ["Brown", "4", ""]]
    roster = write(tmp_path, [["student", "variant", "l_AB"], *of], name="roster")

    told = [warning for warning in check(TASK, roster=roster).warnings if warning.key == "roster-variant-shared"]

    assert [("Kim" in text, "Lee" in text, "Smith" in text) for text in map(str, told)] == [(True, True, False)]


def test_namesakes_are_told_apart_by_group_and_by_variant(tmp_path: Path) -> None:
    of = [["Lee Kim", "M-1", "1"], ["Lee Kim", "M-2", "2"], ["Smith John", "M-1", "3"], ["Smith John", "M-1", "4"]]
    roster = write(tmp_path, [["student", "group", "variant"], *of], name="roster")
    asked = check(TASK, roster=roster)

    entries = [asked.entry_of(one) for one in asked.read(str(asked.write_form(tmp_path / "form.csv")))]

    assert [[entry.who.student, entry.who.group, entry.variant] for entry in entries if entry] == of


def test_a_student_with_initials_is_found_in_the_roster_and_a_stranger_is_told_beside_the_name(
    tmp_path: Path, run: Run
) -> None:
    """Both were told apart by a note in the report alone: the one had handed in nothing, too."""
    names = ("Коваль Ольга Іванівна", "Бондар Іван", "Бондар Ірина", "Мельник Г. П.", "Гончар Олег", "Ян Михайло")
    roster = write(tmp_path, [["student", "variant"], *([name, "3"] for name in names)], name="roster")
    said = (
        "Коваль О.",
        "Бондар Ір.",
        "Бондар І.",
        "Ганна Мельник",
        "Мельник Ганна Петрівна",
        "Олег Гончар",
        "Гончар Ольга",
        "Ян",
    )
    file = write(tmp_path, [["student", "V_B, m/s"], *([name, "5,62"] for name in said)], name="class")

    _, out, _ = run("check", TASK, file, "--roster", roster, "--lang", "en")

    strangers = [line.partition("  ")[0] for line in out.splitlines() if "is not in the roster" in line]
    assert strangers == ["Ганна Мельник", "Гончар Ольга", "Ян"]
    assert "did you mean 'Ян Михайло'?" in out
    assert "which one of the roster, Бондар Іван, Бондар Ірина?" in out
    absent = [line.partition("  ")[0] for line in out.splitlines() if "nothing handed in" in line]
    assert absent == ["Бондар Іван", "Ян Михайло"]


def test_reports_have_the_numbers_of_the_roster(tmp_path: Path, run: Run) -> None:
    """Whoever handed in nothing had none, and all after them those of others."""
    people = [["student", "id number", "variant"], *([f"Student {n}", f"N{n}", "3"] for n in range(1, 6))]
    roster, works = write(tmp_path, people, name="roster"), tmp_path / "works"
    works.mkdir()
    for name, value in (("Student 2", 5.62), ("Student 5", 5.1), ("Student 5 (1)", 5.2), ("Ann", 5.3)):
        rows = [["student", name.partition(" (")[0]], [], ["quantity", "value, m/s"], ["V_B", value]]
        write(works, rows, name=name)

    run("check", TASK, works, "--roster", roster, "--out", tmp_path / "out", "-v", "3", "--lang", "en")

    texts = sorted(path.stem for path in (tmp_path / "out").glob("*.txt"))
    assert texts == ["002-Student-2", "005-Student-5", "006-Student-5", "007-Ann"]


def test_a_form_in_which_nobody_is_named_is_of_the_student_whose_name_its_file_has(tmp_path: Path, run: Run) -> None:
    """A folder of such forms was of strangers, and all of the roster had handed in nothing."""
    people = [
        ["Коваль Ольга", "А", "3"],
        ["Коваль Ольга", "Б", "3"],
        ["Гук Степан Іванович", "А", "3"],
        ["Лис Ян", "А", "3"],
    ]
    roster = write(tmp_path, [["student", "group", "variant"], *people], name="roster")
    works = tmp_path / "works"
    works.mkdir()
    files = [
        ("Коваль_Ольга", "", "Б"),
        ("Гук Степан_4711_assignsubmission_file_answers", "", ""),
        ("Лис Ян", "Гук Марко", ""),
        ("answers", "", ""),
    ]
    for number, (name, student, group) in enumerate(files):
        head = [["student", student], ["group", group], [], ["quantity", "value, m/s"]]
        write(works, [*head, ["V_B", f"5,6{number}"]], (".csv", ".xlsx")[number % 2], name)

    _, out, _ = run("check", TASK, works, "--roster", roster, "--lang", "en")

    lines = out.splitlines()
    assert [line.partition("  ")[0] for line in lines if "nothing handed in" in line] == [
        f"Коваль Ольга ({roster}: row 2)",
        "Лис Ян",
    ]
    assert [line.split("  ")[0] for line in lines if "is not in the roster" in line] == [
        f"{works / 'answers.xlsx'}",
        "Гук Марко",
    ]
    assert "marked: 2" in out


@pytest.mark.parametrize(("again", "grades"), [("5,62", ["N1", "N2"]), ("5,1", ["N2"])])
def test_who_hands_in_twice_or_is_no_one_of_the_roster_gets_no_second_grade(
    tmp_path: Path, run: Run, again: str, grades: list[str]
) -> None:
    """Two files of one student were two rows with one number; a stranger was marked as the first variant."""
    people = [["Коваль Ольга", "N1", "3"], ["Бондар Іван", "N2", "3"], ["Гнатюк Лев", "N3", "4"]]
    roster = write(tmp_path, [["student", "id number", "variant"], *people], name="roster")
    works, moodle = tmp_path / "works", tmp_path / "grades.csv"
    works.mkdir()
    said = [("a", "Коваль Ольга", "5,62"), ("a (1)", "Коваль Ольга", again), ("b", "Бондар Іван", "5,62")]
    for name, student, value in (*said, ("c", "Бондарь Иван", "5,62"), ("d", "Гнатюк Л.", "")):
        write(works, [["student", student], [], ["quantity", "value, m/s"], ["V_B", value]], name=name)
    (works / "photo.docx").write_bytes(b"")

    status, out, err = run(
        "check", TASK, works, "--roster", roster, "--moodle", moodle, "-o", tmp_path / "m.csv", "--lang", "en"
    )

    assert (status, "photo.docx" in err, "it counts once" in err) == (0, True, again == "5,62")
    assert ("several marks" in out) == (again != "5,62")
    assert "students: 3, marked: 2" in out
    assert "did you mean 'Бондар Іван'?" in out
    assert "Гнатюк Лев" in out.partition("Бондарь")[0]  # whose form is empty is known by its name
    rows = csv.DictReader(moodle.read_text(encoding="utf-8-sig").splitlines())
    assert [row["ID number"] for row in rows] == grades


def test_a_class_stands_in_the_order_of_its_roster_and_on_one_page(tmp_path: Path, run: Run) -> None:
    file, page, marks = class_file(tmp_path, 8), tmp_path / "class.html", tmp_path / "marks.csv"
    head, *lines = (line.split(";") for line in file.read_text(encoding="utf-8-sig").splitlines())
    lines[3][1:] = ["N4", *lines[0][2:]]  # copied
    lines[5][0] = "Student 07"
    at = head.index("V_BA.mm")
    for line in lines[1:3]:  # two who have read the absolute velocity for the relative one
        line[at : at + 4] = [*line[at + 2 : at + 4], *line[at : at + 2]]
    rows = [head, *reversed(lines), ["Всього: 8"]]
    answers = write(tmp_path, rows, name="answers")
    known = [[line[0], line[1], book] for line, book in zip(lines, "12345567", strict=True)]
    roster = write(tmp_path, [["student", "id number", "record book"], *known, ["<b>", "N9", "9"]], name="roster")

    given = answers, "-v", "3", "--roster", roster, "-o", page, "-o", marks, "--lang", "en"
    status, printed, told = run("check", TASK, *given)

    html, told = page.read_text(encoding="utf-8"), told.replace("'", "")
    listed = [line.split("  ")[0] for line in printed.splitlines()][:9]
    namesakes = ["Student 07 (5)", "Student 07 (6)"]
    assert status == 0
    assert listed[:5] + listed[7:] == [*(f"Student {n:02d}" for n in range(1, 6)), "Student 08", "<b>"]
    assert listed[5:7] == namesakes
    assert "students: 9, marked: 8" in printed
    assert "record book 5: Student 05, Student 07" in told
    rows = [*csv.reader(marks.read_text(encoding="utf-8-sig").splitlines())]
    assert [row[0] for row in rows[1:6]] == listed[:5]
    assert "<td><b>" not in html
    assert "<td>&lt;b&gt;</td>" in html
    bars = re.findall(r"<rect.*?/><text[^>]*>(\d+)<", html)
    assert sum(map(int, bars)) == 8
    commonest = html.partition("Commonest mistakes")[2]
    often = Counter(re.findall(r"M\d+: (.*?)(?=;|  |$)", printed, re.MULTILINE))
    items = re.findall(r"<li><b>(.*?)</b> – students: (\d+)", commonest)
    assert {re.sub("<.*?>", "", text): int(count) for text, count in items} == often != {}
    assert [int(count) for _, count in items] == sorted(often.values(), reverse=True)
    assert "<figure><svg" in commonest
    assert "<td>Student 01</td><td>Student 04</td>" in html
    assert re.search(r"\bM\d+\b", re.sub(r"<[^>]*>", " ", html)) is None  # no code of a mistake
    assert re.search(r'(src|href)="', html) is None


def test_worksheets_of_a_class_that_are_not_read_are_told(tmp_path: Path, run: Run) -> None:
    book = openpyxl.Workbook()
    for sheet, name in ((book.worksheets[0], "Лис"), (book.create_sheet("АТ-302"), "Сич")):
        for row in (["Студент", "Варіант", "V_B, м/с"], [name, "3", "3,39"]):
            sheet.append(row)
    book.save(file := tmp_path / "class.xlsx")

    _, out, err = run("check", TASK, str(file), "--lang", "en")

    assert "class.xlsx: only the first worksheet is read, not: АТ-302" in out + err
    assert "Сич" not in out


def test_students_of_tasks_that_nobody_knows_are_told(tmp_path: Path) -> None:
    rows = (
        ["student", "task"],
        ["A", TASK],
        ["B", "nau-slider-crnak"],
        ["C", "scheme-09-shaper"],
        ["E", ""],
    )
    asked = check(TASK, roster=write(tmp_path, [*rows], name="roster"), lang="en")

    assert [error.text("en") for error in asked.warnings] == [
        "left out as students of other tasks, which are not among those of the program: nau-slider-crnak"
    ]


def test_a_form_asks_for_what_the_rubric_asks(tmp_path: Path) -> None:
    rubric = tmp_path / "rubric.toml"
    rubric.write_text('asked = ["V_B", "omega_2"]', encoding="utf-8")

    form = check(TASK, "3", rubric=rubric, lang="en").write_form(tmp_path / "form.csv").read_text(encoding="utf-8-sig")

    names = [line.split(",")[0] for line in form.splitlines()]
    assert names[names.index("quantity") + 1 :] == ["Velocity plan", "mu_V", "V_B", "omega_2"]


def test_who_has_answered_nothing_has_no_mark_and_who_copies_a_short_work_of_values_is_seen(
    tmp_path: Path, run: Run
) -> None:
    dice, mu, of = random.Random(1), 0.1, key(TASK, "3")
    names = ("V_BA", "V_B", "V_S2")
    rows = [
        [
            f"Student {n}",
            *(round(mu * (abs(of[name]) / mu + dice.gauss(0, 0.5)), 3) for name in names),
        ]
        for n in range(1, 5)
    ]
    rows[3][1:] = rows[0][1:]
    answers = write(tmp_path, [["student", *names], *rows, ["Student 5", "", "", ""]])

    status, out, _ = run("check", TASK, answers, "-v", "3", "-o", tmp_path / "m.csv", "--lang", "en")

    lines = {line[:9]: " ".join(line.split()) for line in out.splitlines()}
    assert status == 0
    assert lines["Student 5"] == "Student 5 – nothing handed in"
    assert ["the same millimetres" in lines[f"Student {n}"] for n in range(1, 5)] == [True, False, False, True]
    assert "students: 5, marked: 4" in out


@pytest.mark.parametrize(
    ("language", "said"), [("uk", "нічого не здано"), ("ru", "ничего не сдано"), ("en", "nothing handed in")]
)
def test_of_who_has_handed_in_nothing_the_console_tells_in_its_own_language(language: str, said: str) -> None:
    first, _ = class_lines([Result("a.csv", Who("Коваль"))], language)

    assert first == f"Коваль      –  {said}"


def test_a_bar_counts_the_marks_of_its_tenth(tmp_path: Path) -> None:
    asked = check(TASK)
    (one,) = marked(handed_in(tmp_path, 1))
    lines = [replace(one, mark=mark) for mark in (0.0, 9.9, 10.0, 55.0, 95.0, 100.0)]

    page = ClassPage(asked.request, asked.rubric, lines, lambda one: pytest.fail(one.source)).html()

    bars = re.findall(r'<rect x="([\d.]+)".*?/><text[^>]*>(\d+)<', page)
    assert [(int(float(x) // BAR), int(count)) for x, count in bars] == [(0, 2), (1, 1), (5, 1), (9, 2)]


@pytest.mark.parametrize("language", ["uk", "ru", "en"])
def test_a_class_is_told_in_words_what_may_have_gone_wrong(language: str) -> None:
    desk = Desk(check(TASK, "3", lang=language))
    key, words, said = desk.keyed("3", {}), mistake_texts(language), texts(language)

    def explained(mistake: str, asked: int) -> list[list[str]]:
        found = []
        for broken in (one for one in key.book.signatures if one.broken.mistake == mistake):
            names = [name for name in broken.values if name in desk.terms.asked.quantities]
            values = {name: broken.values[name] for name in sorted(names, key=[*key.key.questions].index)[:asked]}
            values = {name: abs(value) if isinstance(value, complex) else value for name, value in values.items()}
            found.append(reported(desk, answers_of(values, desk.terms.asked))[1].explained(language))
        return found

    assert [f"M01: {words['M01']}"] in explained("M01", 3)
    assert [f"M08: {words['M08']}{said['class.or']}M10: {words['M10']}"] in explained("M08", 3)
    assert [said["class.untold"].format(n=3)] in explained("M09", 8)
    assert [said["class.slips"]] in explained("M22", 40)
