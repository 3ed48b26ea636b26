"""Rosters as departments and Moodle keep them: words over columns, symbols of givens, names in two columns."""

from __future__ import annotations

from pathlib import Path

import pytest

from kulman import load_task
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
