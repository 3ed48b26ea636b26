"""A class: every student gets what is theirs, whole; who cannot get anything is named; nothing is done twice."""

from __future__ import annotations

import io
import re
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import openpyxl
import pytest
from pdfminer.high_level import extract_pages
from pdfminer.layout import LTTextContainer
from pdfminer.pdfdocument import PDFDocument
from pdfminer.pdfparser import PDFParser

from kulman import batch, check, load_task, solve
from kulman.scales.errors import InputError, speaking
from kulman.tests.support.commands import Run, files, roster, table
from kulman.variants.batches.batch import Outcome, Student, _Making
from kulman.variants.case import Request
from kulman.variants.roster import Digits, Entry, Schemes, Who, of_several_groups, read_roster, variant_of_book
from kulman.variants.sheets import card_of_case, drawing_for_print
from kulman.variants.task import Task, Variant

TASK = "nau-slider-crank"
SCHEMES = ("scheme-01-compressor", "scheme-02-forging-press", "scheme-03-crank-rocker")
BOOKS = "student;record book"


@pytest.fixture
def made(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """The numbers of the students for whom something is made."""
    numbers: list[int] = []
    first = _Making.make

    def counting(making: _Making, student: Student) -> Outcome:
        numbers.append(student.number)
        return first(making, student)

    monkeypatch.setattr(_Making, "make", counting)
    return numbers


@pytest.fixture(scope="module")
def tasks() -> tuple[Task, ...]:
    return tuple(map(load_task, SCHEMES))


def test_every_student_gets_a_sheet_and_who_does_not_is_named(tmp_path: Path, run: Run) -> None:
    file = roster(tmp_path, "Ivan Koval;MM-21;3;", "Olha;MM-22;5;45 deg", "Bad;MM-21;77;", "None;MM-21;;", "Far;;1;x")
    out = tmp_path / "out"

    asked = ("--roster", str(file), "--out", str(out), "--lang", "en", "--teacher", "O. Lys", "--as", "svg")
    status, printed, err = run("batch", TASK, *asked, "--as", "pdf")

    assert status == 2
    assert "students: 5, done: 2" in printed
    problems = err.splitlines()
    assert [line.split(":")[1].strip() for line in problems[:3]] == ["C4", "row 5, None", "D6, phi"]
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


def test_what_an_earlier_run_has_made_and_this_one_does_not_is_said_to_be_gone(tmp_path: Path) -> None:
    listed, out = roster(tmp_path, "Iryna;MM-21;3;", "Olha;MM-22;5;"), tmp_path / "out"
    asked = {"only": "structure", "jobs": 1, "merge": True}
    assert batch(TASK, listed, out, kinds=["handout"], **asked).warnings == ()

    again = batch(TASK, listed, out, kinds=["card"], **asked)

    assert "handouts.pdf" not in files(out)
    assert ["3 (" in warning.text("en") for warning in again.warnings if warning.key == "batch-gone"] == [True]
    assert batch(TASK, listed, out, kinds=["card"], **asked).warnings == ()


def test_problems_of_a_class_are_said_in_the_language_of_messages(tmp_path: Path) -> None:
    with speaking([], "ru"):
        done = batch(TASK, roster(tmp_path, "Bad;MM-21;77;"), tmp_path / "out", lang="uk", jobs=1)

    assert "нет варианта" in done.problems[0]


def test_a_student_gets_a_note_and_a_handout(tmp_path: Path) -> None:
    out = tmp_path / "out"

    done = batch(TASK, roster(tmp_path, "Iryna;MM-21;3;"), out, kinds=["note", "handout"], only="structure", jobs=1)

    assert done.problems == []
    assert set(files(out)) == {"001-Iryna-3-handout.pdf", "manifest.csv"}  # no solution beside the blank
    assert set(files(out / "solutions")) == {"001-Iryna-3-note.pdf", "key.csv"}
    made = {**files(out), **files(out / "solutions")}
    assert all(data.startswith(b"%PDF") for name, data in made.items() if name.endswith(".pdf"))


@pytest.mark.parametrize(
    ("title", "again"),
    [
        ("Группа АТ-301", "Группа АТ-302"),
        ("Группа: АТ-301;", ";Группа:;АТ-302"),
        ("Учебная группа № АТ-301", "гр. АТ-302"),
        ("Академічна група АТ-301", "Підгрупа АТ-302"),
        ("Список студентів групи АТ-301", "Група;АТ-302"),
        ("Group AT-301:", "Subgroup AT-302"),
        ("Student list of group AT-301, autumn term", "List of students, group AT-302, autumn term 2026/27"),
        ("Ведомость группы АТ-301, осенний семестр", "Список студентів групи АТ-302 осінній семестр"),
        ("Дисципліна: ТММ;;група «АТ-301»;дата 01.12.2026", "Відомість групи АТ-302"),
    ],
)
def test_a_row_that_names_a_group_is_the_title_of_those_below_it_and_no_student(
    tmp_path: Path, title: str, again: str
) -> None:
    head = "№;ПІБ;Варіант;Група"
    lines = [title, head, "1;Коваль Іван;3;", ";;;", again, head, "1;Групань Олена;4;", "2;Лис Ян;5;АТ-309"]
    (file := tmp_path / "class.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")

    found = [(entry.who.student, entry.who.group[-3:]) for entry in read_roster(file, load_task(TASK)).entries]

    assert found == [("Коваль Іван", "301"), ("Групань Олена", "302"), ("Лис Ян", "309")]


def department_list(book: openpyxl.Workbook) -> None:
    """Write a list with two rows of heads, whose columns are numbered, as departments have it."""
    (sheet,) = book.worksheets
    for row in (
        ["Відомість обліку успішності № 12"],
        ["№", "Студент", None, None, "№ зал. книжки", "№ варіанта"],
        [None, "Прізвище", "Ім'я", "По батькові"],
        [1, 2, 3, 4, 5, 6],
        [1, "Коваль", "Ольга", "Іванівна", 1203450, "В-1"],
        [2, "Коваль", "Олег", None, None, None],
        [None, "Екзаменатор ______ доц. Іванов І.І."],
        [None, "Нач. відділу ________ Лис О. О."],
    ):
        sheet.append(row)


@pytest.mark.parametrize("merged", [False, True])
def test_a_list_with_two_rows_of_heads_has_their_students_alone(tmp_path: Path, merged: bool) -> None:
    department_list(book := openpyxl.Workbook())
    for cells in ("A2:A3", "B2:D2", "E2:E3", "F2:F3") if merged else ():
        book.worksheets[0].merge_cells(cells)
    book.save(file := tmp_path / "class.xlsx")

    listed = read_roster(file, load_task(TASK))

    assert [(entry.who.student, entry.variant) for entry in listed.entries] == [
        ("Коваль Ольга Іванівна", "1"),
        ("Коваль Олег", ""),
    ]
    assert listed.unread == ()


def test_who_has_neither_variant_nor_book_is_named(tmp_path: Path) -> None:
    done = batch(TASK, roster(tmp_path, "Koval Ivan;;;", "Lys Yan;;3;"), tmp_path / "out", kinds=["svg"], jobs=1)

    assert ["row 2, Koval Ivan: neither" in problem for problem in done.problems] == [True]


def test_other_worksheets_that_hold_something_are_said_not_to_be_read(tmp_path: Path, run: Run) -> None:
    department_list(book := openpyxl.Workbook())
    book.create_sheet("АТ-302").append(["ПІБ", "Варіант"])
    book.create_sheet("Аркуш3")
    book.create_sheet("hidden").append(["ПІБ"])
    book.worksheets[3].sheet_state = "hidden"
    book.save(file := tmp_path / "class.xlsx")

    (told,) = (one for one in check(TASK, roster=file).warnings if one.key == "sheets-unread")
    _, _, err = run("batch", TASK, "--roster", str(file), "--out", str(tmp_path / "out"), "--as", "svg", "--lang", "en")

    assert told.text("en").startswith("class.xlsx: only the first worksheet is read, not: АТ-302;")
    assert told.text("en") in err


@pytest.mark.parametrize(
    ("heads", "who"),
    [
        ("Last name;First name;Email address;Groups;Task variant", Who("Lys Yan", "ME-21", email="a@b.ua")),
        ("Прізвище;Ім'я;Ел. пошта;Групи;Варіант завдання", Who("Lys Yan", "ME-21", email="a@b.ua")),
        ("Фамилия;Имя;Адрес электронной почты;Группы;Вариант", Who("Lys Yan", "ME-21", email="a@b.ua")),
        ("Surname;Given name;E-mail;Section;Variant", Who("Lys Yan", "ME-21", email="a@b.ua")),
        ("Surname;Given name;E-mail;Cohort;Variant", Who("Lys Yan", "ME-21", email="a@b.ua")),
    ],
)
def test_heads_of_lists_that_moodle_writes_are_understood(folder: Path, heads: str, who: Who) -> None:
    (file := folder / "class.csv").write_text(f"{heads}\nLys;Yan;a@b.ua;ME-21;V-3\n", encoding="utf-8")

    (entry,) = read_roster(file, load_task(TASK)).entries

    assert (entry.who, entry.variant) == (who, "3")


def test_a_student_whose_name_begins_like_a_group_stays_one(tmp_path: Path) -> None:
    (file := tmp_path / "class.csv").write_text("ПІБ;Варіант\nГрупа Олена;3\nГруппа;4\n", encoding="utf-8")

    assert [entry.who.student for entry in read_roster(file, load_task(TASK)).entries] == ["Група Олена", "Группа"]


def test_a_name_is_read_without_spaces_that_say_nothing_and_a_group_without_what_is_behind_it(folder: Path) -> None:
    lines = [
        "Список студентів групи АТ-301, осінній семестр (денна форма)",
        "студент;варіант",
        "Іваненко\u00a0 Іван ;3",
    ]
    file = folder / "list.csv"
    file.write_text("\n".join(lines), encoding="utf-8")

    (entry,) = read_roster(file, load_task(TASK)).entries

    assert (entry.who.student, entry.who.group) == ("Іваненко Іван", "АТ-301")
    assert [*of_several_groups([entry.who])] == []


@pytest.mark.parametrize(
    ("title", "group"),
    [
        ("Групи АТ-301, АТ-302", ""),
        ("Список студентів груп АТ-301 і 302 (осінь)", ""),
        ("Группы АТ-301 и АТ-302, осень", ""),
        ("Groups AT 301, AT 302", ""),
        ("Список", "АТ-301, АТ-302"),
    ],
)
def test_several_groups_over_a_list_or_in_a_cell_are_asked_about(folder: Path, title: str, group: str) -> None:
    lines = [title, "ПІБ;варіант;група", f"Коваль Іван;3;{group}", "Лис Ян;4;АТ-302"]
    (file := folder / "class.csv").write_text("\n".join(lines), encoding="utf-8")

    entries = read_roster(file, load_task(TASK)).entries
    (warning,) = of_several_groups(entry.who for entry in entries)

    assert [entry.who.student for entry in entries] == ["Коваль Іван", "Лис Ян"]
    assert {"301", "302"} <= {*re.findall(r"\d+", entries[0].who.group)}
    assert "Коваль Іван" in warning.text("en")
    assert "expected a column 'group'" in warning.text("en")


@pytest.mark.parametrize(
    "said",
    ["1", "01", "V01", "В01", "В-1", "v.1", "вар-1", "v1", "№1", "№ 01", "Варіант 1", "вар. 01", " 1 ", "1.0", "1,0"],
)
@pytest.mark.parametrize("ids", [("1", "2"), ("V01", "V02"), ("v1", "v2"), ("01", "02")])
def test_a_variant_is_meant_by_its_number_however_it_is_written(said: str, ids: tuple[str, ...]) -> None:
    task = load_task(TASK)
    task = replace(task, variants={id: Variant(id, {}) for id in ids})

    assert task.variant(said).id == ids[0]


@pytest.mark.parametrize(
    ("said", "ids"),
    [("1", ("A1", "B1")), ("C1", ("A1", "B1")), ("K1", ("1",)), ("3", ("1",)), ("1.0.2", ("1",)), ("1.05", ("15",))],
)
def test_a_variant_that_could_be_several_or_none_is_refused(said: str, ids: tuple[str, ...]) -> None:
    task = replace(load_task(TASK), variants={id: Variant(id, {}) for id in ids})

    with pytest.raises(InputError):
        task.variant(said)


def test_a_class_is_printed_in_one_go_in_the_order_of_its_roster(tmp_path: Path) -> None:
    out, names = tmp_path / "out", ["Yana", "Bohdan", "Artem"]
    file = roster(tmp_path, *(f"{name};MM-21;{n};" for n, name in enumerate(names, 2)), "Всього: 3;;;")

    for _ in range(2):  # the second time from what is there
        done = batch(TASK, file, out, kinds=["handout", "card", "pdf"], only="velocity", merge=True, jobs=1)

    merged = {name: list(extract_pages(out / name)) for name in ("handouts.pdf", "cards.pdf", "solutions/sheets.pdf")}
    texts = [
        "".join(part.get_text() for part in page if isinstance(part, LTTextContainer)) for page in merged["cards.pdf"]
    ]
    blanks = [len([*extract_pages(file)]) for file in sorted(out.glob("*-handout.pdf"))]
    assert len(done.students) == 3
    assert [error.key for error in done.warnings] == ["batch-twice"]
    assert 1 in blanks  # behind which stands an empty page: printed on both sides each has a leaf
    assert {name: len(pages) for name, pages in merged.items()} == dict(zip(merged, (6, 3, 3), strict=True))
    assert [next(name for name in names if name in text) for text in texts] == names
    tree = PDFDocument(PDFParser(io.BytesIO((out / "handouts.pdf").read_bytes()))).catalog["Pages"]
    documents = [kid.resolve() for kid in tree.resolve()["Kids"]]
    assert {document["Parent"].objid for document in documents} == {tree.objid}  # `extract_pages` does without
    assert sum(len(document["Kids"]) for document in documents) == 6
    layers = [(out / name).read_bytes().count(b"/Type /OCG") for name in ("handouts.pdf", "002-Bohdan-3-handout.pdf")]
    assert layers[0] == layers[1] > 0  # those of one name are one

    batch(TASK, file, out, kinds=["handout"], only="velocity", jobs=1)

    assert [name for name in merged if (out / name).exists()] == []  # they would not follow what is there now


@pytest.mark.parametrize(
    ("task", "variant"),
    [
        ("nau-slider-crank", None),
        pytest.param("scheme-16-hay-baler", None, marks=pytest.mark.soak),
        # ropes of 24, 8, 60 m
        *(pytest.param("karpenko-hoist", variant, marks=pytest.mark.soak) for variant in ("V07", "V01", "V09")),
        *(pytest.param(task, None, marks=pytest.mark.soak) for task in ("madi-cam", "madi-gear")),
    ],
)
def test_a_card_has_picture_data_and_what_is_to_be_found(task: str, variant: str | None) -> None:
    case = Request(load_task(task), variant, language="en").case()

    card = card_of_case(case, drawing_for_print(case))

    views = {view.name: view for view in card.views}
    assert len(card.pages) == 1
    assert {*views} >= {"kinematic", "givens", "task"}
    assert len(views["givens"].rows) > 12
    assert all(called for _, called, *_ in views["givens"].rows)
    assert "ind" in " ".join(chunk for line in views["task"].lines for chunk in line)


def test_only_what_is_drawn_page_by_page_is_merged(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="pdf, handout, card"):
        batch(TASK, roster(tmp_path, "Iryna;MM-21;3;"), tmp_path / "out", kinds=["note"], merge=True)


@pytest.mark.parametrize("lang", ["en", "uk"])
def test_the_key_is_marked_right(lang: str, tmp_path: Path) -> None:
    file, out = roster(tmp_path, "A;;3;", "B;;5;45 deg", "C;;7;"), tmp_path / lang
    batch(TASK, file, out, kinds=["svg"], only="velocity,forces", lang=lang, jobs=1)
    asked = check(TASK, roster=file, only="velocity,forces", lang=lang)

    marks = [asked.mark(answers).marked.mark for answers in asked.read(str(out / "key.csv"))]

    assert marks == [100.0, 100.0, 100.0]


@pytest.mark.parametrize(
    ("task", "kind", "only", "format"),
    [
        (TASK, "handout", "position,velocity", None),
        (TASK, "card", None, None),
        (TASK, "handout", "velocity", "A3"),  # blanks are A4 all the same
        ("madi-cam", "svg", None, "A4"),  # whose diagrams are smaller there
        ("karpenko-hoist", "handout", None, None),
    ],
)
def test_the_key_has_the_numbers_of_the_paper_that_students_have(
    task: str, kind: str, only: str | None, format: str | None, tmp_path: Path
) -> None:
    right = solve(task, only=only, format="A4", lang="en")

    file, how = roster(tmp_path, f"A;;{right.variant};"), {"only": only, "format": format, "lang": "en"}
    batch(task, file, tmp_path / "out", kinds=[kind], jobs=1, **how)

    (row,) = table(next((tmp_path / "out").rglob("key.csv")))
    lengths = {head.removesuffix(".mm"): float(text) for head, text in row.items() if head.endswith(".mm") and text}
    values = {head.partition(" [")[0]: float(text) for head, text in row.items() if "[" in head and text}
    shown = {name: quantity.shown(right.words.display) for name, quantity in right.items()}
    assert lengths
    assert lengths == pytest.approx({name: quantity.mm for name, quantity in right.items() if name in lengths})
    assert values == pytest.approx({name: shown[name].value for name in values})


def test_only_what_is_missing_or_has_changed_is_made_again(tmp_path: Path, made: list[int]) -> None:
    out = tmp_path / "out"

    def made_again(*rows: str) -> list[int]:
        made.clear()
        batch(TASK, roster(tmp_path, *rows), out, only="structure", kinds=["svg"], jobs=1)
        return made

    assert made_again("A;;1;", "B;;2;", "C;;3;") == [1, 2, 3]
    whole = files(out)
    assert made_again("A;;1;", "B;;2;", "C;;3;") == []
    (out / "001-A-1.svg").unlink()
    (out / "003-C-3.svg").write_bytes(b"torn")
    assert made_again("A;;1;", "B;;2;", "C;;3;") == [1, 3]
    assert files(out) == whole
    assert made_again("A;;1;", "B;;4;", "C;;3;", "D;;5;") == [2, 4]
    assert "002-B-2.svg" not in files(out)  # nobody's any more
    (out / "004-D-5.svg").write_bytes(b"with remarks")
    assert made_again("A;;1;", "B;;4;") == []
    assert {"001-A-1.svg", "002-B-4.svg", "004-D-5.svg"} == {name for name in files(out) if name.endswith(".svg")}
    assert files(out)["004-D-5.svg"] == b"with remarks"  # somebody has changed it


def test_processes_give_the_same_bytes(tmp_path: Path) -> None:
    file = roster(tmp_path, *(f"S{number};;{number % 10};" for number in range(18)))

    for jobs in (1, 2):
        batch(TASK, file, tmp_path / str(jobs), only="structure", kinds=["svg"], jobs=jobs)

    assert files(tmp_path / "1") == files(tmp_path / "2")


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["-v", "3"], "roster"),
        (["--set", "l_XX=3"], "l_XX"),
        (["--only", "velocit"], "velocity"),
        (["--format", "A9"], "A9"),
        (["--digits", "two"], "two"),
        (["--jobs", "0"], "--jobs: '0' processes; expected a number from 1"),
        (["--jobs", "-3"], "--jobs: '-3' processes; expected a number from 1"),
        (["--out", "class.csv"], "class.csv: this is a file, a folder was expected"),
    ],
)
def test_what_is_wrong_for_all_is_refused_before_any_work(
    folder: Path, run: Run, arguments: list[str], said: str
) -> None:
    roster(folder, "A;;1;")
    to = [] if "--out" in arguments else ["--out", "out"]

    status, printed, err = run("batch", TASK, "--roster", "class.csv", *to, *arguments)

    assert (status, printed, err.count("\n")) == (2, "", 1)
    assert said in err
    assert not (folder / "out").exists()


@pytest.mark.soak
def test_a_class_gets_notes_after_one_has_been_written_in_the_same_process(tmp_path: Path) -> None:
    """Threads of typst are not in a copy of the process, which would wait for them for ever."""
    roster(tmp_path, "A,1", "B,2", head="name,variant")
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


# Scheme and column by the last digits of the record book: what departments say, and what rosters say of it.
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


def test_digits_of_no_meaning_and_books_that_have_lost_theirs_are_refused() -> None:
    for digits in ("0", 0, -1, "", "10", "column", "variant,,scheme", ",".join(["variant"] * 10), "१"):
        with pytest.raises(InputError, match=r"^digits"):
            Digits.of(digits)
    for book in ("1,2E+11", "1.23e11", "2,E+10", "7", "", "КБ"):
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
    file, out = roster(tmp_path, "A;КБ-471", "B;КБ-482", "C;КБ-403", "D;КБ-404", "E;", head=BOOKS), tmp_path / "out"

    done = batch(SCHEMES, file, out, kinds=["svg"], only="structure", jobs=1, lang="en")

    rows = table(out / "manifest.csv")
    assert [(row["task"], row["variant"]) for row in rows] == [*zip(SCHEMES, "780", strict=True), ("", ""), ("", "")]
    assert [row["files"] for row in rows[:2]] == [
        f"00{n}-{who}-{SCHEMES[n - 1]}-{v}.svg" for n, who, v in ((1, "A", 7), (2, "B", 8))
    ]
    assert [problem.split(": ", 1)[1] for problem in done.problems] == [
        "B5: record book 'КБ-404' gives scheme 4, and only so many tasks are named: 3",
        "row 6, E: neither a task nor a record book that gives one is written for this student; the tasks are: "
        + ", ".join(SCHEMES),
    ]


def test_each_task_has_a_key_that_is_marked_right(tmp_path: Path) -> None:
    file, out = roster(tmp_path, "A;71", "B;82", "C;03", "D;51", head=BOOKS), tmp_path / "out"
    batch(SCHEMES, file, out, kinds=["svg"], only="velocity", jobs=1, lang="en")
    for task, students in zip(SCHEMES, ("AD", "B", "C"), strict=True):
        asked = check(task, roster=file, schemes=SCHEMES, only="velocity", lang="en")

        results = asked.mark_all(asked.read(str(out / f"key-{task}.csv")), jobs=1)

        assert [(result.who.student, result.mark) for result in results] == [(student, 100.0) for student in students]
        assert [entry.who.student for entry in asked.roster.entries] == [*students]
        assert [result.variant for result in results] == [{"A": "7", "D": "5", "B": "8", "C": "0"}[s] for s in students]


def test_what_the_roster_says_goes_before_the_record_book(tmp_path: Path, tasks: tuple[Task, ...]) -> None:
    rows = ("A;71;3;", "B;71;scheme-02-forging-press;4", "C;71;;4", "D;;2;0", "E;71;9;1", "F;71;scheme-03;")
    file = roster(tmp_path, *rows, head="ПІБ;залікова книжка;Схема;№ варіанта")

    entries = read_roster(file, Schemes(tasks, Digits.of("variant,scheme")), each=True).entries

    said = [(entry.task, entry.variant) for entry in entries[:4]]
    assert said == [(SCHEMES[2], "7"), (SCHEMES[1], "4"), (SCHEMES[0], "4"), (SCHEMES[1], "0")]
    assert "C6: no task '9'" in str(entries[4].problem)
    assert "C7: no task 'scheme-03'" in str(entries[5].problem)


@pytest.mark.parametrize("said", ["9", "09", "9,0", "№9", "схема 9", "Схема № 9", "scheme 9", "завд. 9", "task 9", "2"])
def test_a_number_of_a_task_is_that_in_its_name_before_its_place(tmp_path: Path, said: str) -> None:
    names = ("scheme-14-jaw-crusher", "scheme-09-shaper", "karpenko-hoist")
    file = roster(tmp_path, "A;14;в. 2", f"B;{said};в.1", "C;26;V05", head="student;scheme;variant")

    entries = read_roster(file, Schemes(tuple(map(load_task, names))), each=True).entries

    assert [(str(entry.problem or ""), entry.task) for entry in entries] == [("", name) for name in names]
    if "9" in said:  # no list of the tasks is needed for that
        (tmp_path / "alone").mkdir()
        alone = roster(tmp_path / "alone", f"B;{said};1", head="student;scheme;variant")
        assert [entry.task for entry in read_roster(alone, load_task(names[1])).entries] == [names[1]]
        of_class = read_roster(file, load_task(names[1]))
        assert [entry.who.student for entry in of_class.entries] == ["B"]
        assert of_class.elsewhere == ("14", "26")


def test_a_number_in_the_names_of_two_tasks_is_neither(tmp_path: Path, tasks: tuple[Task, ...]) -> None:
    file = roster(tmp_path, "A;2;4", head="student;scheme;variant")
    alike = replace(tasks[0], id="exam-2")

    (entry,) = read_roster(file, Schemes((alike, *tasks)), each=True).entries

    assert "its tasks are: exam-2, " in str(entry.problem)


def test_batch_and_check_give_a_student_whose_task_the_roster_names_the_same_variant(tmp_path: Path) -> None:
    rows = (f"A;71;{SCHEMES[0]};", f"B;82;{SCHEMES[0]};", f"C;53;{SCHEMES[1]};", f"D;64;{SCHEMES[1]};5")
    file, out = roster(tmp_path, *rows, head="ПІБ;залікова книжка;Завдання;варіант"), tmp_path / "out"

    batch(SCHEMES, file, out, kinds=["svg"], only="velocity", jobs=1, lang="en")

    assert [row["variant"] for row in table(out / "manifest.csv")] == ["1", "2", "3", "5"]
    for task in SCHEMES[:2]:
        asked = check(task, roster=file, only="velocity", lang="en")
        results = asked.mark_all(asked.read(str(out / f"key-{task}.csv")), jobs=1)
        assert [result.mark for result in results] == [100.0, 100.0]


def test_what_two_students_have_alike_and_rows_without_a_name_are_told(tmp_path: Path) -> None:
    own = ("A", 71, 0), ("a.", 71, 1), ("B", 52, 1), ("C", 62, 1), ("", 87, 0)
    works = *own, ("D", 83, 1), ("E", 84, 1), ("E", 84, 1), ("F", 83, 0)
    rows = [f"{who};{book};{SCHEMES[scheme]}" for who, book, scheme in works]
    file = roster(tmp_path, *rows, head="ПІБ;залікова книжка;Завдання")

    done = batch(SCHEMES[:2], file, tmp_path / "out", kinds=["svg"], only="structure", jobs=1, lang="en")

    said = [(error.key, str(error.data.get("text", error.data.get("n")))) for error in done.warnings]
    assert said == [
        *(("roster-book-twice", book) for book in ("83", "84")),
        *(("roster-variant-shared", f"{variant} ({SCHEMES[1]})") for variant in "24"),
        ("roster-nameless", "1"),
    ]


def test_data_of_ones_own_are_those_of_ones_own_task(tmp_path: Path, tasks: tuple[Task, ...]) -> None:
    only_one = next(name for name in tasks[1].givens if name not in tasks[0].givens)
    file = roster(tmp_path, "A;01;45", "B;02;45", head=f"{BOOKS};{only_one}")

    first, second = read_roster(file, Schemes(tasks, Digits.of("variant,scheme")), each=True).entries

    assert f"C2, {only_one}: {SCHEMES[0]} has no given" in str(first.problem)
    assert second.settings == {only_one: "45"}


def test_what_is_noted_of_blanks_is_about_blanks(tmp_path: Path) -> None:
    file, out = roster(tmp_path, "A;7", head="student;variant"), tmp_path / "out"

    batch("scheme-20-press-automaton", file, out, kinds=["handout"], only="position,velocity", jobs=1, lang="en")

    (row,) = table(out / "manifest.csv")
    assert re.findall("--format A.", row["notes"]) == ["--format A4"]  # not the sheet's, which nobody gets


def test_marking_takes_only_students_of_its_task(tmp_path: Path, tasks: tuple[Task, ...]) -> None:
    rows = (f"A;{SCHEMES[0]};1;", f"B;{SCHEMES[1]};no such;", "C;3;2;", "D;;4;51", "E;1;5;", "F;;;42", "G;9;1;")
    file = roster(tmp_path, *rows, head="student;task;variant;record book")

    read = [read_roster(file, Schemes(tasks), each=True, of=task) for task in tasks]

    assert ["".join(entry.who.student for entry in one.entries) for one in read] == ["ADE", "BF", "C"]
    assert {one.elsewhere[-1] for one in read} == {"9"}
    assert [entry.variant for entry in read[0].entries] == ["1", "4", "5"]


@pytest.mark.parametrize(
    ("rows", "digits"), [("A;2;3;51", None), (f"A;{SCHEMES[0]};;51\nB;;;52", "variant,scheme")], ids=["number", "book"]
)
def test_a_number_is_a_task_only_where_the_tasks_are_listed(tmp_path: Path, rows: str, digits: str | None) -> None:
    file = roster(tmp_path, rows, head="student;task;variant;record book")

    with pytest.raises(InputError, match="schemes TASK") as refused:
        check(SCHEMES[0], roster=file, digits=digits)
    with pytest.raises(InputError, match="in this class"):
        check(TASK, roster=file, digits=digits, schemes=SCHEMES)

    assert "B2" in str(refused.value) or "D3" in str(refused.value)
    assert check(SCHEMES[0], roster=file, digits=digits, schemes=SCHEMES, lang="en").roster


def test_a_changed_task_changes_only_its_own_students(tmp_path: Path) -> None:
    own, other = tmp_path / "own.toml", tmp_path / "other.toml"
    own.write_text((load_task(SCHEMES[0]).text).replace(SCHEMES[0], "own"), encoding="utf-8")
    other.write_text(own.read_text(encoding="utf-8") + "# other\n", encoding="utf-8")
    file, out = roster(tmp_path, "A;71", "B;82", head=BOOKS), tmp_path / "out"

    def written() -> dict[str, int]:
        batch((own, SCHEMES[1]), file, out, kinds=["svg"], only="structure", jobs=1)
        return {path.name: path.stat().st_ino for path in out.glob("*.svg")}

    before = written()
    own.write_text(own.read_text(encoding="utf-8") + "\n# a remark\n", encoding="utf-8")
    (out / "001-A-own-7.svg").write_bytes(b"torn")
    after = written()

    assert [name for name in after if after[name] != before[name]] == ["001-A-own-7.svg"]
    with pytest.raises(InputError, match="has the id 'own' already"):
        batch((own, other), file, out)


# Rosters as departments and Moodle keep them: words over columns, symbols of givens, names in two columns.
def entry_of(folder: Path, head: str, row: str) -> Entry:
    (entry,) = read_roster(roster(folder, row, head=head), load_task(TASK)).entries
    return entry


@pytest.mark.parametrize(
    ("head", "row", "who"),
    [
        ("№;ПІБ студента;№ зал. кн.;Вар.", "1;Іван П;12343;3", Who("Іван П", book="12343")),
        ("Прізвище;Ім'я;Група;Варіант", "Петренко;Іван;АТ;3", Who("Петренко Іван", "АТ")),
        ("Фамилия;Имя;Зачётка;Вариант", "Петренко;Иван;7;3", Who("Петренко Иван", book="7")),
        ("First name,Last name,ID number,Variant", "Ivan,Petrenko,42,3", Who("Petrenko Ivan", number="42")),
        ("Ім’я;Варіант", "Іван;3", Who("Іван")),
        ("Прізвище;Ім`я;Варіант", "Лі;Іван;3", Who("Лі Іван")),
        ("Прізвище та ім´я;Вар.", "Лі Іван;в. 3", Who("Лі Іван")),
        ("Ф.И.О. студента;Гр.;№ зач. книжки;Вар.", "Иван П;АТ;12;3", Who("Иван П", "АТ", "12")),
        ("П.І.Б.;Шифр групи;Залікова книжка №;Вар.", "Іван П;АТ;12;3", Who("Іван П", "АТ", "12")),
        ("Фамилия И.О.;Учебная группа;Зач. кн.;Вар.", "Иван П;АТ;12;3", Who("Иван П", "АТ", "12")),
        ("Прізвище, ім'я;Варіант", "Петренко Іван;3", Who("Петренко Іван")),
        ("Student No.,Student name,Class,Variant", "S1042,Ann Lee,ME-3,3", Who("Ann Lee", "ME-3", "S1042")),
        ("Family name,Forename,Matriculation number,Var.", "Lee,Ann,1042,3", Who("Lee Ann", book="1042")),
        ("Прізвище;Ім'я;№ студентського квитка;Вар.", "Лі;Анна;12;3", Who("Лі Анна", book="12")),
        ("ПІБ;№ залікової;Вар.", "Лі А;12;3", Who("Лі А", book="12")),
        ("ПІБ;Номер залікової;Вар.", "Лі А;12;3", Who("Лі А", book="12")),
        ("Student,Reg. No.,Variant", "Ann Lee,12,3", Who("Ann Lee", book="12")),
        ("Student,Record book no.,Variant", "Ann Lee,12,3", Who("Ann Lee", book="12")),
        (
            "Last Name,First Name,Username,Student ID,Availability,Variant",
            "Lee,Ann,al,12,Yes,3",
            Who("Lee Ann", book="12"),
        ),
        ("Student,Student ID number,ID number,Variant", "Ann Lee,12,7,3", Who("Ann Lee", book="12", number="7")),
        ("Identifier,Full name,Email address,Variant", "Participant 7,Ann Lee,a@b.c,3", Who("Ann Lee", email="a@b.c")),
        ("ФИО;Индивидуальный номер;Номер студента;Вар.", "Ли А;7;12;3", Who("Ли А", book="12", number="7")),
        ("ФИО;Студенческий билет №;E-Mail address;Вар.", "Ли А;12;a@b.c;3", Who("Ли А", book="12", email="a@b.c")),
    ],
)
def test_names_are_found_under_the_words_that_people_use(tmp_path: Path, head: str, row: str, who: Who) -> None:
    entry = entry_of(tmp_path, head, row)

    assert (entry.who, entry.variant) == (who, "3")


@pytest.mark.parametrize(
    ("head", "cell", "given"),
    [("φ", "45", ("phi", "45")), ("φ, °", "45", ("phi", "45 °")), ("l_{OA} [мм]", "40,5", ("l_OA", "40,5 мм"))],
)
def test_data_of_ones_own_stand_under_symbols_too(tmp_path: Path, head: str, cell: str, given: tuple[str, str]) -> None:
    assert entry_of(tmp_path, f"student;variant;{head}", f"А;5;{cell}").settings == dict([given])


def test_columns_that_say_nothing_are_named(tmp_path: Path, run: Run) -> None:
    file = roster(tmp_path, "1;А;77;45;30;x;9", head="№;student;variant;phi;Кут;note;ID")

    status, _, err = run("batch", TASK, "--roster", str(file), "--out", str(tmp_path / "out"), "--jobs", "1")

    assert status == 2
    assert err.splitlines()[0] == "class.csv: columns that are not read: Кут, note, ID"


@pytest.mark.parametrize(
    ("variant", "said"),
    [
        ("x", r"csv: C3–C5, C8: .*x"),
        ("", "csv: row 3–5, 8, Student 2, Student 3, Student 4, Student 7: neither a variant nor a record book"),
    ],
)
def test_what_is_wrong_with_many_students_is_told_once(variant: str, said: str, tmp_path: Path) -> None:
    rows = [f"Student {n};MM;{variant if n in (2, 3, 4, 7) else 3};" for n in range(1, 9)]

    told = batch(TASK, roster(tmp_path, *rows), tmp_path / "out", kinds=["card"], jobs=1).told

    assert len(told) == 1
    assert re.search(said, told[0])
