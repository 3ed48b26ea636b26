"""Signs that nobody sees, and bytes that are no text, in what people are called and where files stand."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import pytest

import kulman
from kulman.cli import main
from kulman.scales.errors import InputError
from kulman.tests.support.answer_files import HEAD, ROW
from kulman.variants.batches.batch import batch
from kulman.variants.roster import read_roster
from kulman.variants.sheets import BLOCK
from kulman.variants.shelf import bundled_text

TURNED = "\u202eІ\u200b. Пе\u2066тре\ufeffнко\u00ad\x07\x00"
NAME = "І. Петренко"
BYTES = os.fsdecode(b"x\xff")


@pytest.mark.parametrize("command", ["sheet", "handout", "note", "batch"])
@pytest.mark.parametrize("option", BLOCK)
def test_bytes_that_are_no_text_are_refused(
    command: str, option: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    roster, to = tmp_path / "class.csv", tmp_path / "x.pdf"
    roster.write_text("student;variant\nА;1\n", encoding="utf-8")
    where = ["--roster", str(roster), "--out", str(tmp_path / "out")] if command == "batch" else ["-o", str(to)]

    with pytest.raises(SystemExit) as caught:
        main([command, "nau-slider-crank", *where, f"--{option}", BYTES])

    error = capsys.readouterr().err
    assert caught.value.code == 2
    assert error.count("\n") == 1
    assert option in error
    assert not to.exists()


def test_signs_that_nobody_sees_are_left_out_of_names(tmp_path: Path) -> None:
    roster = tmp_path / "class.csv"
    roster.write_text(f"stu\u200bdent;variant;group\n{TURNED.replace(chr(0), '')};1;\u202e\n", encoding="utf-8")

    svg = kulman.sheet("nau-slider-crank", student=TURNED, group="А\t\nБ").svg()
    note = kulman.note("nau-slider-crank", student=TURNED)
    [entry] = read_roster(roster, kulman.load_task("nau-slider-crank")).entries
    made = batch("nau-slider-crank", roster=roster, folder=tmp_path / "out", kinds=("svg",), jobs=1)

    assert NAME in svg
    assert "А Б" in svg
    assert note.document.title.student == NAME
    assert (entry.who.student, entry.who.group) == (NAME, "")
    assert [*made.outcomes[0].files] == ["001-І-Петренко-1.svg"]
    for file in (tmp_path / "out").iterdir():
        assert not {*"\u202e\u200b\u2066\u00ad\x07"} & {*file.read_text("utf-8-sig"), *file.name}


def test_signs_that_nobody_sees_are_left_out_of_titles(tmp_path: Path) -> None:
    file = tmp_path / "own.toml"
    text = bundled_text("nau-slider-crank")
    title = kulman.load_task("nau-slider-crank").title["uk"]
    file.write_text(text.replace(f'"{title}"', f'"\\u202e{title}\\u200b"', 1), encoding="utf-8")

    assert kulman.load_task(file).title["uk"] == title


@pytest.mark.skipif(sys.platform != "linux", reason="other systems have no such names")
def test_files_whose_names_are_bytes_are_read_and_written(tmp_path: Path) -> None:
    folder, reports = tmp_path / "answers", tmp_path / "reports"
    folder.mkdir()
    (folder / f"{BYTES}.csv").write_text(HEAD + ROW, encoding="utf-8")
    note = tmp_path / f"{BYTES}.md"

    kulman.note("nau-slider-crank").save(note)
    files = [str(tmp_path / name) for name in ("t.csv", "t.xlsx", "m.csv")]
    to = ["--out", str(reports), "-o", files[0], "-o", files[1], "--moodle", files[2]]
    with pytest.raises(SystemExit) as caught:
        main(["check", "nau-slider-crank", "-v", "example", str(folder), "--jobs", "1", *to])

    assert caught.value.code == 0
    assert (tmp_path / "t.csv").exists()
    assert (tmp_path / "t.xlsx").exists()
    assert len([*reports.glob("*.html")]) == 1
    assert b"x\xff-" in note.read_bytes()


def test_an_error_of_the_system_is_not_one_of_the_output(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def no_memory(*_: object, **__: object) -> None:
        raise OSError(12, "Cannot allocate memory")

    monkeypatch.setattr("kulman.variants.solution.solve", no_memory)

    with pytest.raises(SystemExit) as caught:
        main(["solve", "nau-slider-crank"])

    error = capsys.readouterr().err
    assert caught.value.code == 2
    assert "Cannot allocate memory" in error
    assert error.count("\n") == 1
    assert "output" not in error
    assert "виведення" not in error


def test_a_name_of_bytes_is_refused_from_python() -> None:
    with pytest.raises(InputError, match="teacher"):
        kulman.sheet("nau-slider-crank", teacher="\ud800")
