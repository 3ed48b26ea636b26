"""Scheme and column by the last digits of the record book: what departments say, and what rosters say of it."""

from __future__ import annotations

import csv
import doctest
from pathlib import Path
from types import ModuleType

import pytest

from kulman import batch, check, load_task
from kulman.drawing import titleblock
from kulman.scales.errors import InputError
from kulman.variants import roster as rosters
from kulman.variants import tables
from kulman.variants.roster import Digits, Schemes, read_roster, variant_of_book
from kulman.variants.spreadsheets import grid
from kulman.variants.task import Task

SCHEMES = ("scheme-01-compressor", "scheme-02-forging-press", "scheme-03-crank-rocker")


def roster(folder: Path, *rows: str, head: str = "student;record book") -> Path:
    file = folder / "class.csv"
    file.write_text("\n".join((head, *rows)) + "\n", encoding="utf-8")
    return file


def table(file: Path) -> list[dict[str, str]]:
    return list(csv.DictReader(file.read_text(encoding="utf-8-sig").splitlines()))


@pytest.fixture(scope="module")
def tasks() -> tuple[Task, ...]:
    return tuple(map(load_task, SCHEMES))


@pytest.mark.parametrize(
    ("digits", "book", "scheme", "variant"),
    [
        ("variant,scheme", "КБ-123471", 1, 7),
        ("scheme,variant", "КБ-1/234 27", 2, 7),
        ("variant,-,scheme", "593", 3, 5),
        ("варіант,схема", "593", 3, 9),
        ("-,variant", "93", None, 3),
        (" Variant , SCHEME ", "71.0", 1, 7),  # what a table of numbers makes of 71
        (2, "АТ-2023/417", None, 17),
        ("3", "АТ-2023/417", None, 417),
        ("scheme,scheme,variant", "1204", 20, 4),
    ],
)
def test_digits_are_read_from_the_end(digits: int | str, book: str, scheme: int | None, variant: int) -> None:
    meant = Digits.of(digits)

    assert (meant.number("scheme", book), meant.number("variant", book)) == (scheme, variant)


@pytest.mark.parametrize("digits", ["0", 0, -1, "", "10", "column", "variant,,scheme", ",".join(["variant"] * 10), "१"])
def test_digits_of_no_meaning_are_refused(digits: int | str) -> None:
    with pytest.raises(InputError, match="--digits"):
        Digits.of(digits)


@pytest.mark.parametrize("book", ["1,2E+11", "1.23e11", "2,E+10", "7", "", "КБ"])
def test_a_record_book_that_has_lost_its_digits_gives_nothing(book: str) -> None:
    with pytest.raises(InputError, match="record book"):
        Digits.of(2).number("variant", book)


@pytest.mark.parametrize(
    ("task", "book", "digits", "variant"),
    [
        ("karpenko-hoist", "11", 1, "V01"),
        ("karpenko-hoist", "10", 1, "V10"),  # a table that begins at 1 has its tenth column for 0
        ("karpenko-hoist", "12", 2, "V02"),
        ("karpenko-hoist", "00", 2, "V10"),
        ("nau-slider-crank", "10", 1, "0"),
        ("madi-cam", "5", 1, "17"),
    ],
)
def test_a_digit_is_the_column_of_this_number(task: str, book: str, digits: int, variant: str) -> None:
    assert variant_of_book(load_task(task), book, digits) == variant


def test_the_tenth_task_has_the_digit_0(tasks: tuple[Task, ...]) -> None:
    ten = (*tasks, *tasks, *tasks, tasks[1])  # the same task for several digits

    found = [Schemes(ten, Digits.of("variant,scheme")).of("", f"5{digit}").id for digit in range(10)]

    assert found == [ten[digit - 1].id for digit in range(10)]


def test_scheme_and_variant_are_those_of_the_record_book(tmp_path: Path) -> None:
    file = roster(tmp_path, "A;КБ-471", "B;КБ-482", "C;КБ-403", "D;КБ-404", "E;")
    out = tmp_path / "out"

    done = batch(SCHEMES, file, out, kinds=["svg"], only="structure", jobs=1, lang="en")

    rows = table(out / "manifest.csv")
    assert [(row["task"], row["variant"]) for row in rows] == [*zip(SCHEMES, "780", strict=True), ("", ""), ("", "")]
    assert [row["files"] for row in rows[:2]] == [
        f"00{n}-{who}-{SCHEMES[n - 1]}-{v}.svg" for n, who, v in ((1, "A", 7), (2, "B", 8))
    ]
    assert [problem.split(": ", 1)[1] for problem in done.problems] == [
        "B5: record book 'КБ-404' gives scheme 4, and only so many tasks are named: 3",
        "6: neither a task nor a record book that gives one is written for this student; the tasks are: "
        + ", ".join(SCHEMES),
    ]


def test_each_task_has_a_key_that_is_marked_right(tmp_path: Path) -> None:
    file, out = roster(tmp_path, "A;71", "B;82", "C;03", "D;51"), tmp_path / "out"
    batch(SCHEMES, file, out, kinds=["svg"], only="velocity", jobs=1, lang="en")
    for task, students in zip(SCHEMES, ("AD", "B", "C"), strict=True):
        asked = check(task, roster=file, digits="variant,scheme", only="velocity", lang="en")

        results = asked.mark_all(asked.read(str(out / f"key-{task}.csv")), jobs=1)

        assert [(result.who.student, result.mark) for result in results] == [(student, 100.0) for student in students]
        assert [result.variant for result in results] == [{"A": "7", "D": "5", "B": "8", "C": "0"}[s] for s in students]


def test_what_the_roster_says_goes_before_the_record_book(tmp_path: Path, tasks: tuple[Task, ...]) -> None:
    rows = ("A;71;3;", "B;71;scheme-02-forging-press;4", "C;71;;4", "D;;2;0", "E;71;9;1", "F;71;scheme-03;")
    file = roster(tmp_path, *rows, head="ПІБ;залікова книжка;Схема;№ варіанта")

    entries = read_roster(file, Schemes(tasks, Digits.of("variant,scheme")), each=True).entries

    assert [(entry.task, entry.variant) for entry in entries[:4]] == [
        (SCHEMES[2], "7"), (SCHEMES[1], "4"), (SCHEMES[0], "4"), (SCHEMES[1], "0"),
    ]  # fmt: skip
    assert ["C6: no task '9'" in str(entries[4].problem), "C7: no task 'scheme-03'" in str(entries[5].problem)] == [
        True
    ] * 2


def test_data_of_ones_own_are_those_of_ones_own_task(tmp_path: Path, tasks: tuple[Task, ...]) -> None:
    only_one = next(name for name in tasks[1].givens if name not in tasks[0].givens)
    file = roster(tmp_path, "A;01;45", "B;02;45", head=f"student;record book;{only_one}")

    first, second = read_roster(file, Schemes(tasks, Digits.of("variant,scheme")), each=True).entries

    assert f"C2, {only_one}: {SCHEMES[0]} has no given" in str(first.problem)
    assert second.settings == {only_one: "45"}


def test_marking_takes_only_students_of_its_task(tmp_path: Path, tasks: tuple[Task, ...]) -> None:
    rows = (f"A;{SCHEMES[0]};1", f"B;{SCHEMES[1]};no such", "C;3;2", "D;;4")
    file = roster(tmp_path, *rows, head="student;task;variant")

    entries = read_roster(file, tasks[0]).entries

    assert [entry.who.student for entry in entries] == ["A", "C", "D"]


def test_a_changed_task_changes_only_its_own_students(tmp_path: Path) -> None:
    own = tmp_path / "own.toml"
    own.write_text((load_task(SCHEMES[0]).text).replace(SCHEMES[0], "own"), encoding="utf-8")
    file, out = roster(tmp_path, "A;71", "B;82"), tmp_path / "out"
    pair = (own, SCHEMES[1])
    batch(pair, file, out, kinds=["svg"], only="structure", jobs=1)
    before = {path.name: path.stat().st_ino for path in out.glob("*.svg")}
    own.write_text(own.read_text(encoding="utf-8") + "\n# a remark\n", encoding="utf-8")
    (out / "001-A-own-7.svg").write_bytes(b"torn")

    batch(pair, file, out, kinds=["svg"], only="structure", jobs=1)

    after = {path.name: path.stat().st_ino for path in out.glob("*.svg")}
    assert [name for name in after if after[name] != before[name]] == ["001-A-own-7.svg"]
    with pytest.raises(InputError, match="has the id 'own' already"):
        batch((own, _copy(own, tmp_path / "other.toml")), file, out)


def _copy(task: Path, other: Path) -> Path:
    other.write_text(task.read_text(encoding="utf-8") + "# other\n", encoding="utf-8")
    return other


@pytest.mark.parametrize("module", [rosters, grid, tables, titleblock])
def test_examples_in_docstrings_say_what_comes_out(module: ModuleType) -> None:
    found = doctest.testmod(module)

    assert found.attempted
    assert found.failed == 0
