"""Rosters as departments and Moodle keep them: words over columns, symbols of givens, names in two columns."""

from __future__ import annotations

from pathlib import Path

import pytest

from kulman import cli, load_task
from kulman.variants.roster import Entry, Who, read_roster

TASK = "nau-slider-crank"


def entries(folder: Path, head: str, *rows: str) -> tuple[Entry, ...]:
    file = folder / "class.csv"
    file.write_text("\n".join((head, *rows)) + "\n", encoding="utf-8")
    return read_roster(file, load_task(TASK)).entries


@pytest.mark.parametrize(
    ("head", "row", "who"),
    [
        ("№;ПІБ студента;№ зал. кн.;Вар.", "1;Іван П;12343;3", Who("Іван П", book="12343")),
        ("Прізвище;Ім'я;Група;Варіант", "Петренко;Іван;АТ;3", Who("Петренко Іван", "АТ")),
        ("Фамилия;Имя;Зачётка;Вариант", "Петренко;Иван;7;3", Who("Петренко Иван", book="7")),
        ("First name,Last name,ID number,Variant", "Ivan,Petrenko,42,3", Who("Petrenko Ivan", number="42")),
        ("Ім’я;Варіант", "Іван;3", Who("Іван")),
        ("Прізвище, ім'я;Варіант", "Петренко Іван;3", Who("Петренко Іван")),
    ],
)
def test_names_are_found_under_the_words_that_people_use(tmp_path: Path, head: str, row: str, who: Who) -> None:
    (entry,) = entries(tmp_path, head, row)

    assert (entry.who, entry.variant) == (who, "3")


@pytest.mark.parametrize(
    ("head", "cell", "given"),
    [("φ", "45", ("phi", "45")), ("φ, °", "45", ("phi", "45 °")), ("l_{OA} [мм]", "40,5", ("l_OA", "40,5 мм"))],
)
def test_data_of_ones_own_stand_under_symbols_too(tmp_path: Path, head: str, cell: str, given: tuple[str, str]) -> None:
    (entry,) = entries(tmp_path, f"student;variant;{head}", f"А;5;{cell}")

    assert entry.settings == dict([given])


def refused(file: Path, out: Path, capfd: pytest.CaptureFixture[str]) -> list[str]:
    """What the command says on stderr of a batch that is not right."""
    with pytest.raises(SystemExit) as left:
        cli.main(["batch", TASK, "--roster", str(file), "--out", str(out), "--as", "svg", "--jobs", "1"])
    assert left.value.code == 2
    return capfd.readouterr().err.splitlines()


def test_columns_that_say_nothing_are_named(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "class.csv"
    file.write_text("№;student;variant;phi;Кут;note\n1;А;77;45;30;x\n", encoding="utf-8")

    said = refused(file, tmp_path / "out", capfd)

    assert said[0] == "class.csv: columns that are not read: Кут, note"


def test_a_file_is_no_folder(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "class.csv"
    file.write_text("student;variant\nА;3\n", encoding="utf-8")

    said = refused(file, file, capfd)

    assert len(said) == 1
    assert said[0].endswith("class.csv: this is a file, a folder was expected")


@pytest.mark.parametrize("number", ["0", "-3"])
def test_some_process_is_needed(
    number: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)

    with pytest.raises(SystemExit) as left:
        cli.main(["batch", TASK, "--roster", "class.csv", "--out", "out", "--jobs", number])

    assert left.value.code == 2
    assert capfd.readouterr().err.strip() == f"--jobs: '{number}' processes; expected a number from 1"
