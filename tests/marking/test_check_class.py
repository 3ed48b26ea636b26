"""A class marked: tables, reports, flags, Moodle; a stopped run goes on; hands that are too exact, or the same."""

from __future__ import annotations

import csv
import io
import math
import random
import subprocess
import sys
import time
from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import openpyxl
import pytest

from kulman import check, cli
from kulman.plans.hands.shaky import draw, preset
from kulman.tests.support.marking_cases import answer, key, students
from kulman.variants.marking import checks
from kulman.variants.marking.checks import Job, mark_class, slug
from kulman.variants.marking.reading import Answers, Reply
from kulman.variants.marking.result import Measured, Result, measured, shared, too_exact
from kulman.variants.roster import Entry, Roster, Who

TASK = "nau-slider-crank"
ASKED = ("V_A", "V_BA", "V_B", "V_S2", "omega_2", "a_BA_n", "a_BA_t", "a_B", "a_S2", "R_12", "R_32", "M_bal")


def run(capsys: pytest.CaptureFixture[str], *arguments: str) -> tuple[int, str, str]:
    with pytest.raises(SystemExit) as left:
        cli.main(["check", TASK, *arguments])
    out, err = capsys.readouterr()
    return int(left.value.code or 0), out, err


def table(rows: Sequence[Sequence[str]]) -> bytes:
    stream = io.StringIO()
    csv.writer(stream, delimiter=";").writerows(rows)
    return stream.getvalue().encode("utf-8-sig")


def class_file(tmp_path: Path, count: int, seed: int = 1, drawn: bool = True) -> Path:
    """Write the answers of a class of variant 3: measured by a shaky hand, or calculated."""
    of = key(TASK, "3")
    hands = students(of, of.paper, count, seed) if drawn else ([answer(n, of[n]) for n in ASKED] for _ in range(count))
    rows = [["student", "id number", "variant", "mu_V", "mu_a", "mu_F_23"]]
    rows[0] += [column for name in ASKED for column in (f"{name}.mm", name)]
    mus = [f"{of.paper.mus[plan]:.6g}" for plan in ("velocity", "acceleration", "forces_23")]
    for number, hand in enumerate(hands, start=1):
        said = {a.name: a.value or 0.0 for a in hand}
        row = [f"Student {number:02d}", f"N{number}", "3", *mus]
        for name in ASKED:
            question = of.questions[name]
            mu = of.paper.mus.get(question.plan) if question.step.verb == "read" else None
            row += ["" if mu is None else f"{(said[name] if drawn else abs(of[name])) / mu:.1f}", f"{said[name]:.4g}"]
        rows.append(row)
    file = tmp_path / "class.csv"
    file.write_bytes(table(rows))
    return file


def job(folder: Path | None = None) -> Job:
    return Job(check(TASK), None if folder is None else str(folder))


def handed_in(file: Path) -> list[Answers]:
    return check(TASK).read(str(file))


def test_a_class_gets_tables_reports_and_grades(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = class_file(tmp_path, 5)
    roster = tmp_path / "roster.csv"
    names = [f"Student {number:02d};{number}" for number in (1, 2, 3, 4, 5, 9)]
    roster.write_text("student;id number\n" + "\n".join(names) + "\n", encoding="utf-8")
    out = tmp_path / "reports"
    tables = [tmp_path / "marks.xlsx", tmp_path / "marks.csv"]
    moodle = tmp_path / "grades.csv"

    status, printed, err = run(
        capsys, str(file), "-v", "3", "--roster", str(roster), "--out", str(out), "--moodle", str(moodle),
        *(argument for path in tables for argument in ("-o", str(path))), "--lang", "en",
    )  # fmt: skip

    assert (status, err) == (0, "")
    assert "students: 5, marked: 5" in printed
    assert len(list(out.glob("*.html"))) == len(list(out.glob("*.txt"))) == 5
    assert [path.name for path in out.iterdir() if path.name.startswith(".")] == [checks.REPORTS_NOTED]
    sheet = openpyxl.load_workbook(tables[0]).active
    assert sheet is not None
    rows = list(sheet.iter_rows(values_only=True))
    assert rows[0][:3] == ("student", "group", "record book")
    assert rows[1][0] == "Student 01"
    assert rows[1][7] >= 80
    assert "Student 09" in rows[6]
    assert "nothing handed in" in rows[6]
    text = tables[1].read_text(encoding="utf-8-sig")
    assert sum(line.startswith("Student") for line in text.splitlines()) == 6
    grades = list(csv.DictReader(io.StringIO(moodle.read_text(encoding="utf-8-sig"))))
    assert [row["ID number"] for row in grades] == ["1", "2", "3", "4", "5"]
    assert all(0.0 <= float(row["Grade"]) <= 100.0 for row in grades)


def test_a_file_that_cannot_be_read_does_not_stop_the_others(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("LC_ALL", "C")
    folder = tmp_path / "answers"
    folder.mkdir()
    class_file(tmp_path, 2).rename(folder / "good.csv")
    (folder / "bad.csv").write_bytes(b"\0\0")
    (folder / "~$open.xlsx").write_bytes(b"x")
    marks = tmp_path / "marks.csv"

    status, out, err = run(capsys, str(folder), "-o", str(marks), "--lang", "en")

    assert status == 0
    assert err.count("\n") == 1
    assert "bad.csv: not a text" in err
    assert "students: 3, marked: 2" in out
    bad = next(row for row in csv.reader(marks.read_text(encoding="utf-8-sig").splitlines()) if "bad.csv" in row[-2])
    assert bad[-3].startswith("not read: ")
    assert bad[7] == ""


def test_marks_on_the_screen_have_the_decimal_sign_of_the_language(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    class_file(tmp_path, 2, drawn=False)
    rubric = tmp_path / "rubric.toml"
    rubric.write_text("out_of = 97.5\n", encoding="utf-8")

    _, out, _ = run(capsys, str(tmp_path / "class.csv"), "--rubric", str(rubric), "--lang", "uk")

    assert "97,5" in out
    assert "97.5" not in out


def test_a_pattern_names_files(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    class_file(tmp_path, 2)

    status, out, _ = run(capsys, str(tmp_path / "*.csv"), "--lang", "en")

    assert status == 0
    assert "students: 2" in out


def test_a_class_has_no_single_report(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    status, _, err = run(capsys, str(class_file(tmp_path, 2)), "-o", str(tmp_path / "r.html"))

    assert status == 2
    assert "--out" in err
    assert not (tmp_path / "r.html").exists()


def test_processes_and_one_process_give_the_same(tmp_path: Path) -> None:
    answers = handed_in(class_file(tmp_path, 20))
    done: list[int] = []

    alone = mark_class(job(), answers, lambda done, whole: None, jobs=1)
    together = mark_class(job(), answers, lambda more, whole: done.append(more), jobs=2)

    assert together == alone
    assert sum(done) == 20
    assert [result.who.student for result in together] == [f"Student {number:02d}" for number in range(1, 21)]


def test_a_stopped_run_goes_on_where_it_was(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    answers, folder = handed_in(class_file(tmp_path, 12)), tmp_path / "reports"
    folder.mkdir()
    marked: list[int] = []
    first = checks.mark_one

    def stopping(job: Job, desk: object, number: int, one: Answers) -> Result:
        if number == 10:
            raise KeyboardInterrupt
        marked.append(number)
        return first(job, desk, number, one)

    monkeypatch.setattr(checks, "mark_one", stopping)
    with pytest.raises(KeyboardInterrupt):
        mark_class(job(folder), answers, lambda done, whole: None, jobs=1)
    journal = folder / ".kulman-check.jsonl"
    assert journal.exists()
    journal.write_text(journal.read_text(encoding="utf-8") + '{"digest": "torn', encoding="utf-8")
    before, again = len(marked), []

    def counting(job: Job, desk: object, number: int, one: Answers) -> Result:
        again.append(number)
        return first(job, desk, number, one)

    monkeypatch.setattr(checks, "mark_one", counting)
    results = mark_class(job(folder), answers, lambda done, whole: None, jobs=1)

    assert before == 10
    assert again == [10, 11]  # nobody who was marked is marked again
    assert not journal.exists()
    alone = mark_class(job(), answers, lambda done, whole: None, jobs=1)
    assert [replace(result, reports=()) for result in results] == alone
    assert all((folder / name).is_file() for result in results for name in result.reports)


def test_reports_of_students_who_are_no_longer_there_are_removed(tmp_path: Path) -> None:
    answers, folder = handed_in(class_file(tmp_path, 4)), tmp_path / "reports"
    folder.mkdir()
    foreign = folder / "004-Student-09.html"
    foreign.write_text("somebody's own", encoding="utf-8")
    mark_class(job(folder), answers, lambda done, whole: None, jobs=1)
    changed = folder / "004-Student-04.txt"
    changed.write_text("with remarks", encoding="utf-8")

    mark_class(job(folder), answers[:1] + answers[2:3], lambda done, whole: None, jobs=1)

    stems = {"001-Student-01.html", "001-Student-01.txt", "002-Student-03.html", "002-Student-03.txt"}
    there = {path.name for path in folder.iterdir() if path.suffix in (".html", ".txt")}
    assert there == {*stems, foreign.name, changed.name}


def test_changed_answers_are_marked_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    answers, folder = handed_in(class_file(tmp_path, 3)), tmp_path / "reports"
    folder.mkdir()
    marked: list[str] = []
    first = checks.mark_one

    def counting(job: Job, desk: object, number: int, one: Answers) -> Result:
        if number == 2:
            raise KeyboardInterrupt
        marked.append(one.who.student)
        return first(job, desk, number, one)

    monkeypatch.setattr(checks, "mark_one", counting)
    with pytest.raises(KeyboardInterrupt):
        mark_class(job(folder), answers, lambda done, whole: None, jobs=1)
    changed = [answers[0], replace(answers[1], lines={})]
    marked.clear()

    mark_class(job(folder), changed, lambda done, whole: None, jobs=1)

    assert marked == ["Student 02"]


def test_calculated_segments_are_too_exact_and_drawn_ones_are_not(tmp_path: Path) -> None:
    drawn = mark_class(job(), handed_in(class_file(tmp_path, 25)), lambda done, whole: None, jobs=1)
    calculated = mark_class(job(), handed_in(class_file(tmp_path, 1, drawn=False)), lambda done, whole: None, jobs=1)

    assert sum(result.exact for result in drawn) == 0
    assert calculated[0].exact


def test_students_who_share_their_errors_are_named(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = class_file(tmp_path, 12)
    lines = file.read_text(encoding="utf-8-sig").splitlines()
    copied = lines[3].split(";")
    lines[8] = ";".join(["Student 08", "N8", *copied[2:]])
    file.write_text("\n".join(lines), encoding="utf-8")

    _, out, _ = run(capsys, str(file), "--lang", "en")

    flagged = [line for line in out.splitlines() if "the same millimetres" in line]
    assert len(flagged) == 2
    assert flagged[0].startswith("Student 03")
    assert "Student 08" in flagged[0]


def drawn_segments(task: str, hand: str, count: int, step: float = 0.5) -> list[dict[str, Measured]]:
    """Return what students of one variant have measured on drawings of their own, read to `step` mm."""
    of = key(task)
    board = draw(of.paper, preset(hand).hand, np.random.default_rng(5), count)
    mus = {q.name: of.paper.mus.get(q.plan) for q in of.questions.values() if q.step.verb in ("read", "arm")}
    sizes = {name: np.broadcast_to(abs(board.values[name]), (count,)) / mu for name, mu in mus.items() if mu}
    read = [{name: round(float(mm[i] / step)) * step for name, mm in sizes.items()} for i in range(count)]
    lines = [{name: Reply(name, mm, decimals=1) for name, mm in one.items()} for one in read]
    return [measured(Answers("", Who(), {}, one, {}), of, of.paper.mus, {}) for one in lines]


def copied(of: dict[str, Measured], dice: random.Random) -> dict[str, Measured]:
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


def test_who_goes_on_honestly_from_the_same_mistake_has_not_copied() -> None:
    """Two careful hands, both 30 % too large from the same mistake on: what follows from it is what should be there."""
    dice, hands = random.Random(2), []
    for _ in range(2):
        sizes = [1.3 * (20.0 + 7 * i) for i in range(16)]
        hands.append({f"q{i}": Measured(round(2 * dice.gauss(x, 0.2)) / 2, x, 0.5, 0.7) for i, x in enumerate(sizes)})

    assert list(shared(hands)) == []
    assert sum(abs(hands[0][name].mm - hands[1][name].mm) < 1e-6 for name in hands[0]) > 6


@pytest.mark.parametrize("step", [0.1, 0.5, 1.0])
def test_honest_hands_seldom_share_their_segments(step: float) -> None:
    """A hundred classes of thirty, 12 segments each, in which chance alone makes one pair: three at most."""
    dice, pairs = random.Random(1), 0
    for _ in range(100):
        hands = [
            {
                f"q{i}": Measured(round((40.0 + 5 * i + dice.gauss(0.0, 0.5)) / step) * step, 40.0 + 5 * i, step, 0.5)
                for i in range(12)
            }
            for _ in range(30)
        ]
        pairs += len(list(shared(hands)))

    assert pairs <= 3


def test_rounding_hides_exactness() -> None:
    rounded = {f"q{i}": Measured(round(30.0 + 1.37 * i), 30.0 + 1.37 * i, 1.0, 0.7) for i in range(8)}
    exact = {f"q{i}": Measured(round(30.0 + 1.37 * i, 2), 30.0 + 1.37 * i, 0.01, 0.7) for i in range(8)}

    assert not too_exact(rounded)
    assert too_exact(exact)
    assert not too_exact({})


def test_a_result_survives_its_file(tmp_path: Path) -> None:
    result = mark_class(job(), handed_in(class_file(tmp_path, 1)), lambda done, whole: None, jobs=1)[0]

    assert Result.from_json(result.to_json()) == result
    assert result.mark is not None
    assert not math.isnan(result.mark)


@pytest.mark.parametrize(("name", "file"), [("Іваненко І. І.", "Іваненко-І-І"), ("../../etc", "etc"), ("???", "x")])
def test_a_report_is_named_after_the_student(name: str, file: str) -> None:
    assert slug(name) == file


def test_the_form_of_a_class_has_its_students(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    roster, form = tmp_path / "roster.csv", tmp_path / "form.csv"
    roster.write_text("student;record book\n=HYPERLINK(1);417\nБ;5\n", encoding="utf-8")

    status, out, _ = run(capsys, "--form", str(form), "--roster", str(roster), "--lang", "uk")

    rows = list(csv.reader(io.StringIO(form.read_text(encoding="utf-8-sig")), delimiter=";"))
    assert (status, out) == (0, f"{form}\n")
    assert rows[1][0] == "'=HYPERLINK(1)"
    assert [row[4] for row in rows[1:]] == ["7", "5"]
    assert {"mu_V", "V_B.mm", "V_B", "V_B.dir", "omega_2"} <= {*rows[0]}


@pytest.mark.soak
def test_a_killed_run_leaves_no_process_and_goes_on(tmp_path: Path) -> None:
    file, folder, journal = class_file(tmp_path, 200), tmp_path / "out", tmp_path / "out" / ".kulman-check.jsonl"
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


def test_a_class_is_told_who_is_missing_and_where_notes_are(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    roster, answers = tmp_path / "roster.csv", tmp_path / "answers.csv"
    roster.write_bytes(table([["student", "variant"], ["Student 01", "3"], ["Student 02", "4"]]))
    answers.write_bytes(table([["student", "V_B", "omega_2", "a_B", "V_Q"], ["Student 01", "5,6", "-15,7", "", "1"]]))

    status, out, _ = run(capsys, str(answers), "--roster", str(roster), "-o", str(tmp_path / "m.csv"), "--lang", "en")

    assert status == 0
    assert "  missing 1  " in out
    assert f"  notes in the report: 1 ({answers}" in out
    assert [line.split() for line in out.splitlines() if "Student 02" in line] == [
        ["Student", "02", "–", "nothing", "handed", "in"]
    ]


def test_a_roster_finds_who_is_named_once_by_the_surest_key() -> None:
    def entry(number: str, student: str) -> Entry:
        return Entry(Who(student=student, number=number), "3", {}, "")

    first, second, _, fourth = found = [
        entry("1", "О'Коннор І."),
        entry("2", "Same Name"),
        entry("3", "same  name."),
        entry("", "Ёлкин"),
    ]
    roster = Roster(tuple(found))

    assert roster.find(Who(number="2", student="О'Коннор І.")) is second
    assert roster.find(Who(student="оконнор і")) is first
    assert roster.find(Who(student="Same name")) is None
    assert roster.find(Who(number="9", student="елкин")) is fourth
    assert roster.find(Who()) is None
