"""A class: every student gets what is theirs, whole; who cannot get anything is named; nothing is done twice."""

from __future__ import annotations

import csv
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from kulman import batch, check, cli
from kulman.variants.batches.batch import Made, Making, Student

TASK = "nau-slider-crank"


def run(capsys: pytest.CaptureFixture[str], *arguments: str) -> tuple[int, str, str]:
    with pytest.raises(SystemExit) as left:
        cli.main(arguments)
    out, err = capsys.readouterr()
    return int(left.value.code or 0), out, err


def roster(folder: Path, *rows: str) -> Path:
    file = folder / "class.csv"
    file.write_text("\n".join(("student;group;variant;phi", *rows)) + "\n", encoding="utf-8")
    return file


def files(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.iterdir() if not path.name.startswith(".")}


def table(file: Path) -> list[dict[str, str]]:
    return list(csv.DictReader(file.read_text(encoding="utf-8-sig").splitlines()))


@pytest.fixture
def made(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """The numbers of the students for whom something is made."""
    numbers: list[int] = []
    first = Making.make

    def counting(making: Making, student: Student) -> Made:
        numbers.append(student.number)
        return first(making, student)

    monkeypatch.setattr(Making, "make", counting)
    return numbers


def test_every_student_gets_a_sheet_and_who_does_not_is_named(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = roster(tmp_path, "Ivan Koval;MM-21;3;", "Olha;MM-22;5;45 deg", "Bad;MM-21;77;", "None;MM-21;;", "Far;;1;x")
    out = tmp_path / "out"

    status, printed, err = run(
        capsys, "batch", TASK, "--roster", str(file), "--out", str(out), "--lang", "en", "--teacher", "O. Lys",
        "--as", "svg", "--as", "pdf",
    )  # fmt: skip

    assert status == 2
    assert "students: 5, done: 2" in printed
    problems = err.splitlines()
    assert [line.split(":")[1].strip() for line in problems[:3]] == ["C4", "5", "D6, phi"]
    assert "manifest.csv" in problems[3]
    sheets = {f"{stem}{end}" for stem in ("001-Ivan-Koval-3", "002-Olha-5") for end in (".pdf", ".svg")}
    assert set(files(out)) == {*sheets, "key.csv", "manifest.csv"}
    svg = (out / "002-Olha-5.svg").read_text(encoding="utf-8")
    assert all(text in svg for text in ("Olha", "MM-22", "O. Lys"))
    rows = table(out / "manifest.csv")
    assert [row["variant"] for row in rows] == ["3", "5", "", "", ""]
    assert rows[1]["sheet id"] in svg
    assert "77" in rows[2]["notes"]
    keys = table(out / "key.csv")
    assert float(keys[1]["V_B [m/s]"]) != float(keys[0]["V_B [m/s]"])
    assert keys[2]["V_B [m/s]"] == ""


def test_a_student_gets_a_note_and_a_handout(tmp_path: Path) -> None:
    out = tmp_path / "out"

    done = batch(TASK, roster(tmp_path, "Iryna;MM-21;3;"), out, kinds=["note", "handout"], only="structure", jobs=1)

    assert done.problems == []
    assert set(files(out)) == {"001-Iryna-3-note.pdf", "001-Iryna-3-handout.pdf", "key.csv", "manifest.csv"}
    assert all(data.startswith(b"%PDF") for name, data in files(out).items() if name.endswith(".pdf"))


def test_the_key_is_marked_right(tmp_path: Path) -> None:
    file = roster(tmp_path, "A;;3;", "B;;5;45 deg", "C;;7;")
    for lang in ("en", "uk"):
        out = tmp_path / lang
        batch(TASK, file, out, kinds=["svg"], lang=lang, jobs=1)
        asked = check(TASK, roster=file, lang=lang)

        marks = [asked.mark(answers).marked.mark for answers in asked.read(str(out / "key.csv"))]

        assert marks == [100.0, 100.0, 100.0]


def test_only_what_is_missing_or_has_changed_is_made_again(tmp_path: Path, made: list[int]) -> None:
    out = tmp_path / "out"

    def run_again(*rows: str) -> None:
        batch(TASK, roster(tmp_path, *rows), out, only="structure", kinds=["svg"], jobs=1)

    run_again("A;;1;", "B;;2;", "C;;3;")
    assert made == [1, 2, 3]
    whole = files(out)
    made.clear()

    run_again("A;;1;", "B;;2;", "C;;3;")
    assert made == []
    (out / "001-A-1.svg").unlink()
    (out / "003-C-3.svg").write_bytes(b"torn")
    run_again("A;;1;", "B;;2;", "C;;3;")
    assert (made, files(out)) == ([1, 3], whole)
    made.clear()
    run_again("A;;1;", "B;;4;", "C;;3;", "D;;5;")

    assert made == [2, 4]
    assert "002-B-2.svg" not in files(out)  # nobody's any more
    assert {"002-B-4.svg", "004-D-5.svg"} < set(files(out))


def test_a_file_that_somebody_has_changed_is_not_removed(tmp_path: Path) -> None:
    out = tmp_path / "out"
    batch(TASK, roster(tmp_path, "A;;1;", "B;;2;"), out, kinds=["svg"], jobs=1)
    (out / "002-B-2.svg").write_bytes(b"with remarks")

    batch(TASK, roster(tmp_path, "A;;1;"), out, kinds=["svg"], jobs=1)

    assert (out / "002-B-2.svg").read_bytes() == b"with remarks"


def test_processes_give_the_same_bytes(tmp_path: Path) -> None:
    file = roster(tmp_path, *(f"S{number};;{number % 10};" for number in range(18)))

    for jobs in (1, 2):
        batch(TASK, file, tmp_path / str(jobs), only="structure", kinds=["svg"], jobs=jobs)

    assert files(tmp_path / "1") == files(tmp_path / "2")


def test_who_kills_the_process_is_named_and_the_others_are_done(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    first = Making.make

    def poisoned(making: Making, student: Student) -> Made:
        if student.number == 7:
            os.kill(os.getpid(), signal.SIGKILL)
        return first(making, student)

    monkeypatch.setattr(Making, "make", poisoned)
    file = roster(tmp_path, *(f"S{number};;{number % 10};" for number in range(1, 19)))

    done = batch(TASK, file, tmp_path / "out", only="structure", kinds=["svg"], jobs=2, lang="en")

    assert len(done.problems) == 1
    assert "class.csv: 8" in done.problems[0]
    assert len([name for name in files(tmp_path / "out") if name.endswith(".svg")]) == 17


LIMITED = """
import resource, sys
resource.setrlimit(resource.RLIMIT_FSIZE, (int(sys.argv[1]),) * 2)
from kulman.cli import main
main(sys.argv[2:])
"""


@pytest.mark.soak
@pytest.mark.skipif(sys.platform == "win32", reason="no such limit")
def test_a_full_disk_leaves_nothing_half_written(tmp_path: Path) -> None:
    file, out = roster(tmp_path, "A;;1;", "B;;2;"), tmp_path / "out"
    arguments = ["batch", TASK, "--roster", str(file), "--out", str(out), "--only", "structure", "--jobs", "1"]
    arguments += ["--as", "svg", "--as", "pdf"]

    full = subprocess.run(
        [sys.executable, "-c", LIMITED, "9000", *arguments], capture_output=True, text=True, check=False
    )

    assert full.returncode == 2
    assert full.stderr.count("\n") == 1
    assert [name for name in files(out) if name.endswith((".svg", ".pdf", ".part"))] == []
    subprocess.run([sys.executable, "-c", LIMITED, "1000000", *arguments], check=True, capture_output=True)
    assert len(files(out)) == 6


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["-v", "3"], "roster"),
        (["--set", "l_XX=3"], "l_XX"),
        (["--only", "velocit"], "velocity"),
        (["--format", "A9"], "A9"),
        (["--digits", "two"], "two"),
    ],
)
def test_what_is_wrong_for_all_is_refused_before_any_work(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], arguments: list[str], said: str
) -> None:
    file, out = roster(tmp_path, "A;;1;"), tmp_path / "out"

    status, printed, err = run(capsys, "batch", TASK, "--roster", str(file), "--out", str(out), *arguments)

    assert (status, printed, err.count("\n")) == (2, "", 1)
    assert said in err
    assert not out.exists()


def test_a_class_gets_notes_after_one_has_been_written_in_the_same_process(tmp_path: Path) -> None:
    """Threads of typst are not in a copy of the process, which would wait for them for ever."""
    (tmp_path / "class.csv").write_text("name,variant\nA,1\nB,2\n", encoding="utf-8")
    script = tmp_path / "script.py"
    script.write_text(
        "from kulman import batch, note\n"
        "note('nau-slider-crank', only='velocity').save('n.pdf')\n"
        "print('once')\n"
        "done = batch('nau-slider-crank', 'class.csv', 'out', kinds=['note'], only='velocity', jobs=2)\n"
        "print(done.problems)\n",
        encoding="utf-8",
    )

    ran = subprocess.run([sys.executable, script], cwd=tmp_path, capture_output=True, text=True, timeout=120)

    assert (ran.returncode, ran.stdout.split("\n"), ran.stderr) == (0, ["once", "[]", ""], "")
    assert len(list((tmp_path / "out").glob("*-note.pdf"))) == 2
