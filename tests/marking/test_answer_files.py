"""Forms, and what comes back: from any spreadsheet; or no file of answers, a bomb, any bytes at all."""

from __future__ import annotations

import csv
import io
import pickle
import re
import subprocess
import sys
from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from functools import partial
from pathlib import Path

import openpyxl
import pytest
import xlsxwriter
from hypothesis import given, settings
from hypothesis import strategies as st

from kulman import check, solve
from kulman.scales.errors import LANGUAGES, InputError
from kulman.scales.packaged import packaged
from kulman.tests.support.answer_files import ASKED, HEAD, ROW, messages, one, read, table
from kulman.tests.support.cases import some
from kulman.tests.support.hostile_workbooks import HOSTILE, SMALL, good, hostile, zipped
from kulman.variants.drawings.apart import handed_in
from kulman.variants.drawings.files import read_drawing
from kulman.variants.marking.reading import _read_answers
from kulman.variants.marking.wording import plain
from kulman.variants.serving.safety import read_passwords
from kulman.variants.shelf import bundled
from kulman.variants.spreadsheets.files import read_grid
from kulman.variants.spreadsheets.grid import Grid, letters
from kulman.variants.tables import _harmless, _xlsx_bytes, csv_table
from kulman.variants.task import LocatedError

QUICK = ("blanks of 22 MB", "member twice", "password", "packed by LZMA", "size that is too small")
PACKAGE = "kulman.variants.marking"


def form(tmp_path: Path, name: str, language: str, task: str = "nau-slider-crank") -> Path:
    """Write an empty form."""
    return check(task, lang=language).write_form(tmp_path / name)


def refused(file: Path) -> str:
    """Return the one line with which a file is refused; nothing where it is read."""
    line = ""
    try:
        _read_answers(file, ASKED)
    except InputError as error:
        line = error.text("en")
    assert "\n" not in line
    return line


def test_a_folder_that_is_not_there_is_told_as_such(tmp_path: Path) -> None:
    assert refused(tmp_path / "answers") == f"{tmp_path / 'answers'}: there is no such file"
    (tmp_path / "a.odt").write_bytes(b"")
    assert "expected a file that ends in" in refused(tmp_path / "a.odt")


@pytest.mark.parametrize(
    ("name", "reader"),
    [
        ("answers.csv", read_grid),
        ("roster.xlsx", read_grid),
        ("drawing.dxf", partial(handed_in, largest=1, other="")),
        ("passwords.txt", read_passwords),
        ("rubric.toml", lambda file: check("nau-slider-crank", rubric=file)),
    ],
)
def test_a_file_that_nobody_may_read_is_refused_in_words(
    name: str, reader: Callable[[Path], object], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def closed(*_: object, **__: object) -> None:
        raise PermissionError

    file = tmp_path / name
    with pytest.raises(InputError) as missing:
        reader(file)
    file.write_text("x", encoding="utf-8")
    with monkeypatch.context() as shut:
        shut.setattr(Path, "open", closed)
        shut.setattr(Path, "read_bytes", closed)
        with pytest.raises(InputError) as refused:
            reader(file)

    assert (missing.value.key, refused.value.key) == ("file-missing", "file-unreadable")
    assert all(file.name in refused.value.text(language) for language in LANGUAGES)


def test_every_mistake_has_words() -> None:
    from kulman.plans.mistakes import book, rules

    assert book.__name__  # by which all rules are entered
    assert list(packaged(PACKAGE, "texts", "mistakes.en")) == sorted(
        rules.MISTAKES, key=lambda id: int(id.removeprefix("M"))
    )


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("name", ["form.csv", "form.xlsx"])
def test_a_form_can_be_read_in_the_language_it_is_written_in(tmp_path: Path, name: str, language: str) -> None:
    file = form(tmp_path, name, language)
    rows = read_grid(file).rows

    names = [row[0] for row in rows if row[0] in ASKED.names]
    assert [len(row) for row in rows if row[0] in ("quantity", "величина")] == [8]
    assert names.index("V_A") < names.index("V_B") < names.index("omega_2") < names.index("a_B") < names.index("R_12")
    ours = {name for name in ASKED.names if "_couple_" not in name} - {"mu_l_1"}  # of variants with a short crank
    assert {*names} == ours
    assert form(tmp_path, f"b{file.suffix}", language).read_bytes() == file.read_bytes()
    with pytest.raises(InputError, match="the form is empty"):
        _read_answers(file, ASKED)


@pytest.mark.parametrize(
    ("task", "told"),
    [
        ("bertyaev-six-bar", {"mu_a": "M_a", "mu_a_B": "M_a (B)"}),
        ("madi-four-bar", {"mu_F_23": "μ_p (2, 3)", "mu_F_1": "μ_p (1)"}),
        (
            "scheme-15-lever-shears",
            {
                "m_2": "m_2",
                "h_2": "h_2",
                "h_G_4": "h_G4",
                "h_lever_G_4": "h_G4 (lever)",
                "F_i4_couple": "F′_i4 = F″_i4",
            },
        ),
    ],
)
def test_no_two_lines_of_a_form_look_alike(tmp_path: Path, task: str, told: dict[str, str]) -> None:
    grid = read_grid(form(tmp_path, "form.csv", "en", task))
    header = next(number for number, row in enumerate(grid.rows) if row[0] == "quantity")
    rows = [[cell for cell in row if cell] for row in grid.rows[header + 1 :]]
    headings = [row[0] for row in rows if len(row) == 1]
    labels = {row[0]: row[1] for row in rows if len(row) > 1}

    assert len(set(headings)) == len(headings) > 1
    assert len(set(labels.values())) == len(labels) > 20
    assert told.items() <= labels.items()


@pytest.mark.parametrize("task", some(["nau-slider-crank", "madi-cam", *sorted(set(bundled()) - {"madi-cam"})], 2))
def test_answers_may_be_named_as_the_sheet_shows_them(task: str) -> None:
    """Forms of one's own had to say M_bal and omega_2: of M_ур it was told that there is none."""
    asked = check(task, lang="ru").asked
    shown = dict[str, set[str]]()
    for language in LANGUAGES:
        words = replace(solve(task, lang=language).words, language=language)
        for name in asked.names:
            shown.setdefault(plain(words.symbol(name)).replace(" ", ""), set()).add(name)
    alone = {text: name for text, (name, *others) in shown.items() if not others and text != name}

    understood = {text: asked.meant(text) for text in alone}

    wrong = {text: name for text, name in understood.items() if name != alone[text]}
    assert len(alone) > 10
    assert wrong == {}


@pytest.mark.parametrize(("name", "language"), some([("form.csv", "uk"), ("form.xlsx", "ru"), ("form.csv", "en")], 1))
@pytest.mark.parametrize("format", some([None, "A4"], 0))
def test_the_form_of_a_variant_says_the_sheets_scale_factors_and_answers_nothing(
    tmp_path: Path, name: str, language: str, format: str | None
) -> None:
    solution = solve("nau-slider-crank", "7", lang=language, format=format)
    scales, said = set(solution.to_json()["scales"]), solution.table().splitlines()[-1]
    own = read_grid(check("nau-slider-crank", "7", lang=language, format=format).write_form(tmp_path / name))
    blank = read_grid(form(tmp_path, "blank.csv", language))

    factors = {row[0]: row[4] + row[5] for row in own.rows if row[0].startswith("mu_")}
    symbols = {row[0]: row[1] for row in own.rows if row[0] in factors} | {"mu_l": "μ_l"}
    said = re.sub(r"mu_\w+", lambda found: symbols[found[0]], said)
    [line] = [row[0] for row in own.rows if said in row[0]]
    assert scales <= {name for name, symbol in symbols.items() if f"{symbol} = " in line}
    assert factors == dict.fromkeys(scales, "")
    assert not any("μ_l = " in row[0] for row in blank.rows if row)
    with pytest.raises(InputError, match="the form is empty"):
        _read_answers(tmp_path / name, ASKED)


def test_a_filled_workbook_comes_back(tmp_path: Path) -> None:
    file = form(tmp_path, "form.xlsx", "ru")
    book = openpyxl.load_workbook(file)
    sheet = book.active
    assert sheet is not None
    for row in sheet.iter_rows():
        if row[0].value == "V_B":
            row[3].value, row[5].value, row[7].value = 55.2, 2.76, 180
        if row[0].value == "mu_V":
            row[4].value = "0,05"
        if row[0].value == "студент":
            row[1].value = "Петренко"
    book.save(file)

    answers = _read_answers(file, ASKED)[0]

    line = answers.lines["V_B"]
    assert (answers.problems, answers.who.student) == ((), "Петренко")
    assert (answers.scales["mu_V"].value, line.mm, line.value) == pytest.approx((0.05, 55.2, 2.76))
    assert line.direction == pytest.approx(3.14159, abs=1e-4)


@pytest.mark.parametrize("separator", [";", ",", "\t"])
@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "cp1251", "utf-16"])
def test_csv_comes_in_any_encoding_with_any_separator(tmp_path: Path, encoding: str, separator: str) -> None:
    rows = [["студент", "Ґалаґан"], HEAD.strip().split(";"), ROW.strip().split(";")]

    answers = one(tmp_path, table(rows, separator).encode(encoding))

    line = answers.lines["V_B"]
    assert (answers.who.student, answers.problems) == ("Ґалаґан", ())
    assert (line.value, line.mm) == pytest.approx((2.76, 55.2))


def test_csv_of_dos_is_read_with_the_letters_that_it_has_not(tmp_path: Path) -> None:
    """Excel offers CSV (MS-DOS), too: nobody was told that its encoding was why no row said what stands in columns."""
    rows = [["студент", "Єва Їжак"], HEAD.strip().split(";"), ROW.strip().split(";")]

    answers = one(tmp_path, table(rows).replace("і", "i").encode("cp866"))

    line = answers.lines["V_B"]
    assert (answers.who.student, answers.problems) == ("Єва Їжак", ())
    assert (line.value, line.mm) == pytest.approx((2.76, 55.2))


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_form_saved_by_an_old_spreadsheet_comes_back(tmp_path: Path, language: str) -> None:
    text = form(tmp_path, "form.csv", language).read_text(encoding="utf-8-sig")
    separator = "," if language == "en" else ";"
    rows = list(csv.reader(io.StringIO(text), delimiter=separator))
    for row in rows:
        if row[0] in ASKED.quantities:
            row[3:6] = ["10", "2", "20"]

    answers = one(tmp_path, table(rows, separator).encode("cp1251", "replace"))  # which has no superscripts

    assert answers.problems == ()
    assert answers.lines["a_B"].value == answers.lines["M_bal"].value == pytest.approx(20.0)


def test_a_form_in_english_saved_by_a_western_spreadsheet_keeps_accents_and_squares(tmp_path: Path) -> None:
    rows = [["student", "Müller Zoë"], ["quantity", "value", "unit"], ["a_B", "339.4", "m/s²"], ["V_B", "5.62", "m/s"]]

    answers = one(tmp_path, table(rows, ",").encode("cp1252"))

    assert (answers.who.student, answers.problems) == ("Müller Zoë", ())
    assert answers.lines["a_B"].value == pytest.approx(339.4)


def test_a_form_may_have_its_columns_in_any_order_names_alike_and_answers_twice(tmp_path: Path) -> None:
    ordered = one(tmp_path, "direction,unit,value,Quantity,мм,масштаб\n180,m/s,2.76,V_B,55.2,0.05\n").lines["V_B"]
    alike = one(tmp_path, f"{HEAD}V_В;55;;2,76;;\n")  # with a Cyrillic letter
    twice = one(tmp_path, f"{HEAD}{ROW}V_B;1;;2;;\n")

    assert (ordered.value, ordered.mm) == pytest.approx((2.76, 55.2))
    assert [*alike.lines] == ["V_B"]
    assert twice.lines["V_B"].value == pytest.approx(2.76)
    assert ["answered a second time" in text for text in messages(twice)] == [True]


def test_what_is_no_quantity_is_told_as_it_is_typed(tmp_path: Path) -> None:
    odd = one(tmp_path, f"{HEAD}{ROW}скорость точки;5;;;;\nМ_хр;3;;;;\n")

    assert [name for text in messages(odd) for name in ("скорость точки", "М_хр") if text.count(name) == 2] == [
        "скорость точки",
        "М_хр",
    ]


def test_columns_that_changed_places_are_put_back_and_others_stay(tmp_path: Path) -> None:
    own = "V_B;2,76;0,05;55,2;;\nV_A;4;0,05;80;;\nV_BA;2,1;0,05;42;;\na_B;220;4;55;;\n"
    scales, rows = "mu_V;;0,05;;;\nmu_a;;4;;;\n", "V_B;2,76;;55,2;;\nV_A;4;;80;;\nV_BA;2,1;;42;;\na_B;220;;55;;\n"
    lone = "omega_1;;;50;;-\na_A;50;;;;\nV_S2;3,26;;;;\n"  # a value, a segment, a value
    right = "V_B;55,2;0,05;2,76;;\nV_A;80;0,05;4;;\nV_BA;42;0,05;2,1;;\na_B;55;4;220;;\n"

    beside, in_rows, in_place = (one(tmp_path, HEAD + text) for text in (own, scales + rows + lone, right))

    for answers in (beside, in_rows):
        line = answers.lines["V_B"]
        assert (line.mm, line.value) == pytest.approx((55.2, 2.76))
        assert "each other's place" in messages(answers)[0]
    alone = {name: (line.mm, line.value) for name, line in in_rows.lines.items()}
    assert (alone["omega_1"], alone["a_A"], alone["V_S2"]) == ((None, 50.0), (50.0, None), (None, 3.26))
    assert in_place.problems == ()
    assert in_place.lines["V_B"].mm == pytest.approx(55.2)


@pytest.mark.parametrize("beside", [True, False])
def test_a_segment_and_a_value_that_changed_places_in_one_line_are_put_back_and_told(
    tmp_path: Path, beside: bool
) -> None:
    mu = "0,05" if beside else ""
    head = HEAD if beside else HEAD + "mu_V;;0,05;;;\n"
    rows = f"V_A;80;{mu};4;;\nV_BA;42;{mu};2,1;;\n"
    one_of, right, no_comma = (
        one(tmp_path, head + rows + f"V_B;{mm};{mu};{value};;\n")
        for mm, value in (("2,76", "55,2"), ("55,2", "2,76"), ("55,2", "276"))
    )

    assert (one_of.lines["V_B"].mm, one_of.lines["V_B"].value) == pytest.approx((55.2, 2.76))
    assert [one_of.lines[name] for name in ("V_A", "V_BA")] == [right.lines[name] for name in ("V_A", "V_BA")]
    assert ["V_B: segment and value are in each other's place" in text for text in messages(one_of)] == [True]
    assert right.problems == no_comma.problems == ()
    assert (no_comma.lines["V_B"].mm, no_comma.lines["V_B"].value) == pytest.approx((55.2, 276.0))


def test_who_exchanges_columns_in_a_class_is_put_right_and_nobody_else(tmp_path: Path) -> None:
    head = "ПІБ;варіант;mu_V;V_A.mm;V_A;V_B.mm;V_B;V_BA.mm;V_BA\n"

    right, exchanged = read(tmp_path, f"{head}Один;1;0,05;80;4;55,2;2,76;42;2,1\nДва;1;0,05;4;80;2,76;55,2;2,1;42\n")

    assert right.problems == ()
    assert ["row 3: " in text and "each other's place" in text for text in messages(exchanged)] == [True]
    for answers in (right, exchanged):
        assert (answers.lines["V_B"].mm, answers.lines["V_B"].value) == pytest.approx((55.2, 2.76))


def test_a_class_is_a_row_for_each_student(tmp_path: Path) -> None:
    head = "ПІБ;варіант;mu_V;V_B.mm;V_B;V_B.dir;omega_2 [рад/с];a_B, м/с²;V_C\n"

    first, second, third = read(
        tmp_path, f"{head}Один;3;0,05;55;2,75;180;-16,3;220;1\nДва;4;;;;;;;\nТри;5;;шість;2,8;;;;\n"
    )

    assert [answers.who.student for answers in (first, second, third)] == ["Один", "Два", "Три"]
    assert first.lines["V_B"].mm == pytest.approx(55.0)
    assert first.lines["omega_2"].value == pytest.approx(-16.3)
    assert first.scales["mu_V"].value == pytest.approx(0.05)
    assert first.columns == ("V_B", "omega_2", "a_B")
    assert ["'V_C'" in text for text in messages(first)] == [True]  # told once
    assert not second.lines
    assert third.lines["V_B"].value == pytest.approx(2.8)
    assert ["D4, V_B" in text for text in messages(third)] == [True]
    for text in ("ПІБ;V_B;a_B, м/с²\nОдин;2,7;220\n", "ПІБ,V_B,a_B,курс;рік\nОдин,2.7,220,1;2\n"):  # names tell
        assert [line.value for line in one(tmp_path, text).lines.values()] == pytest.approx([2.7, 220.0])


@settings(max_examples=20)
@given(st.lists(st.lists(st.text(max_size=12), min_size=1, max_size=5), min_size=1, max_size=5))
def test_nothing_written_starts_a_formula(rows: list[list[str]]) -> None:
    for row in csv.reader(io.StringIO(csv_table(rows, "uk").decode("utf-8-sig"), newline=""), delimiter=";"):
        assert not any(cell.lstrip(" ").startswith(("=", "+", "-", "@", "\t", "\r")) for cell in row)
    book = openpyxl.load_workbook(io.BytesIO(_xlsx_bytes(rows, "=x")))
    assert book.active is not None
    assert all(cell.data_type != "f" for row in book.active.iter_rows() for cell in row)


@pytest.mark.parametrize("language", LANGUAGES)
def test_hints_of_a_form_are_seen_whole_and_it_is_printed_on_pages_one_wide(tmp_path: Path, language: str) -> None:
    sheet = openpyxl.load_workbook(form(tmp_path, "form.xlsx", language)).active
    assert sheet is not None
    wide = sum(column.width * (column.max - column.min + 1) for column in sheet.column_dimensions.values())
    hints = [row for row in sheet.iter_rows() if len(str(row[0].value)) > 100]

    assert hints
    for row in hints:
        assert row[0].alignment.wrap_text
        assert any(row[0].coordinate in span and span.size["columns"] == len(row) for span in sheet.merged_cells)
        assert (sheet.row_dimensions[row[0].row].height or 0.0) >= 15.0 * len(str(row[0].value)) / wide
    assert (sheet.sheet_properties.pageSetUpPr.fitToPage, sheet.page_setup.fitToHeight) == (True, 0)
    assert sheet.page_setup.orientation == "portrait"


def test_an_apostrophe_keeps_a_text_a_text_and_it_comes_back(tmp_path: Path) -> None:
    file = tmp_path / "a.csv"
    file.write_bytes(csv_table([["x", "=1+1", "-5 mm", 1.5], ["V_B", "V_A", "V_BA", 2]], "uk"))

    assert read_grid(file).rows[0] == ("x", "=1+1", "-5 mm", "1,5")
    assert [_harmless(text) for text in ("=A1", "@x", "+1", "V_B", "")] == ["'=A1", "'@x", "'+1", "V_B", ""]
    assert [letters(column) for column in (0, 25, 26, 701, 702)] == ["A", "Z", "AA", "ZZ", "AAA"]


def test_a_formula_is_read_by_its_stored_result_and_a_date_is_told_of(tmp_path: Path) -> None:
    file = tmp_path / "answers.xlsx"
    with xlsxwriter.Workbook(str(file)) as book:
        sheet = book.add_worksheet()
        sheet.write_row(0, 0, HEAD.strip().split(";"))
        sheet.write_row(1, 0, ["V_B", 55.2, 0.05])
        sheet.write_formula("D2", "=B2*C2", None, 2.76)
        sheet.write_row(2, 0, ["V_A", 80])
        sheet.write_formula("D3", '=HYPERLINK("http://x","4")', None, "")
        sheet.write_row(3, 0, ["a_B", None, None, 220])
        sheet.write("B4", 45789, book.add_format({"num_format": "dd.mm"}))

    answers = _read_answers(file, ASKED)[0]

    assert {name: line.value for name, line in answers.lines.items()} == {"V_B": 2.76, "V_A": None, "a_B": 220.0}
    formula, date = messages(answers)
    assert "D3, V_A" in formula
    assert "formula" in formula
    assert "B4, a_B" in date
    assert "holds a date" in date


@pytest.mark.parametrize(
    ("name", "content", "what"),
    [
        ("a.csv", b"", "the file is empty"),
        ("a.csv", b"PK\x03\x04abc", "its name end in .xlsx"),
        ("a.xlsx", b"PK\x03\x04abc", "not an XLSX file"),
        ("a.xlsx", b"\xd0\xcf\x11\xe0" * 100, "not an XLSX file"),
        ("a.csv", "щось;інше\n1;2\n".encode(), "no row says what the columns hold"),
        ("a.ods", b"x", "ends in one of: .csv, .xlsx"),
        ("a.csv", b"x" * 21_000_000, "larger than 20 MB"),
        ("a.csv", b";" * 2_000_000, "more than 20000 rows or 1000 columns"),
        ("a.csv", b"a;b;c\n" * 200_000, "more than 20000 rows or 1000 columns"),
        ("a.csv", (b";" * 900 + b"\n") * 2_000, "than can be read at once"),
        ("a.csv", b"a" * 9_000_000, "than can be read at once"),
        ("a.csv", b"a;" + b"b" * 40_000, "B1: the cell is longer than 32767 characters"),
        ("a.csv", b'"V_B;' + b"x" * 200_000, "a quotation mark is not closed"),
        *(("a.csv", content, "not a text") for content in (b"\0\1\2" * 100, b"\xff\xfe\0\0a\0\0\0")),
        *(("a.csv", content, "not a text") for content in ("a;\0".encode("utf-16"), b"\xff\xfe\x00\xd8")),
        ("a.csv", "відрізок;мм".encode("cp1251") + b"\x98" * 3, "not a text"),
        *(("a.csv", content, "") for content in (b'"' * 300_001, b'sep="\n1"2', b"\r" * 3_000_000)),
        ("a.csv", "\N{RIGHT-TO-LEFT OVERRIDE};\u200b\n".encode() * 9, ""),
    ],
)
def test_what_is_no_file_of_answers_is_refused_in_one_line(
    tmp_path: Path, name: str, content: bytes, what: str
) -> None:
    (file := tmp_path / name).write_bytes(content)

    assert what in refused(file)


def test_a_folder_or_nothing_is_refused(tmp_path: Path) -> None:
    (tmp_path / "x.csv").mkdir()

    assert "a file with a table was expected, not a folder" in refused(tmp_path / "x.csv")
    with pytest.raises(InputError) as no_drawing:
        read_drawing(tmp_path / "x.csv")
    assert "a drawing was expected, not a folder" in no_drawing.value.text("en")
    assert "there is no such file" in refused(tmp_path / "y.csv")


@settings(max_examples=60)
@given(st.binary(max_size=400))
def test_whatever_bytes_come_they_are_read_or_refused(tmp_path_factory: pytest.TempPathFactory, data: bytes) -> None:
    folder = tmp_path_factory.mktemp("any")
    for name in ("a.csv", "a.xlsx"):
        with suppress(InputError):  # anything else would be our bug
            read(folder, HEAD.encode() + data if name == "a.csv" else b"PK\x03\x04" + data, name)


@pytest.mark.parametrize("name", [*SMALL, *QUICK])
def test_a_hostile_workbook_is_refused_in_one_line(tmp_path: Path, name: str) -> None:
    (file := tmp_path / "answers.xlsx").write_bytes(hostile(name))

    assert HOSTILE[name] in refused(file)


READ = """
import sys, time
from pathlib import Path
from kulman.scales.errors import InputError
from kulman.variants.spreadsheets.files import read_grid
line = ""
try:
    read_grid(sys.argv[1])
except InputError as error:
    line = error.text("en")
peak = next(row for row in Path("/proc/self/status").read_text().splitlines() if row.startswith("VmHWM"))
print(time.process_time(), int(peak.split()[1]) / 1024, line)
"""


def cost(folder: Path, name: str) -> tuple[float, float, str]:
    """Return the processor time, s, and the memory, MB, in which a process reads a workbook, and the error it gives."""
    (file := folder / "answers.xlsx").write_bytes(hostile(name))
    run = subprocess.run([sys.executable, "-c", READ, str(file)], capture_output=True, encoding="utf-8", check=True)
    seconds, megabytes, line = run.stdout.split(" ", 2)
    assert run.stderr == ""
    return float(seconds), float(megabytes), line


@pytest.fixture(scope="module")
def largest(tmp_path_factory: pytest.TempPathFactory) -> float:
    """The processor time that this machine takes to read the largest class that is read, s: 1.4 to 1.9."""
    return cost(tmp_path_factory.mktemp("largest"), "numbers, as many as are read")[0]


@pytest.mark.soak
@pytest.mark.skipif(sys.platform != "linux", reason="the peak of memory is read from /proc")
@pytest.mark.parametrize("name", sorted(HOSTILE.keys() - set(SMALL)))
def test_no_workbook_takes_long_or_much_memory(tmp_path: Path, name: str, largest: float) -> None:
    seconds, megabytes, line = cost(tmp_path, name)

    assert HOSTILE[name] in line
    assert seconds < 3.0 * largest  # two thirds at the most where nothing else runs
    assert megabytes < 300


def test_a_workbook_of_two_programs_is_read_alike_whatever_looks_it_has(tmp_path: Path) -> None:
    written = ["ПІБ", "5,5", " a\nb ", "=1", 12, 2.5, 1e-7, True, "q\tr", "🛠"]
    files = [tmp_path / "a.xlsx", tmp_path / "b.xlsx"]
    with xlsxwriter.Workbook(str(files[0]), {"strings_to_formulas": False}) as book:
        sheet = book.add_worksheet()
        sheet.write_row(0, 0, written, book.add_format({"bold": True, "num_format": "0.00%", "bg_color": "red"}))
        sheet.write_rich_string(1, 0, "V", book.add_format({"font_script": 2}), "B")
        sheet.merge_range("C3:D4", "both")
        sheet.write(5, 0, "_x000D_")
        sheet.data_validation("A1:B9", {"validate": "list", "source": ["1"]})
    other = openpyxl.Workbook()
    other.active.append([value if value != "=1" else "'=1" for value in written])
    other.active.append(["VB"])
    other.active["C3"] = "both"
    other.active.merge_cells("C3:D4")
    other.active["A6"] = "end"
    other.save(files[1])

    grids = [read_grid(file) for file in files]

    expected = ("ПІБ", "5,5", "a\nb", "=1", "12", "2.5", "1e-07", "1", "q\tr", "🛠")
    assert grids[0].rows[5] == ("_x000D_",)
    for grid in grids:
        assert tuple(text.lstrip("'") for text in grid.rows[0]) == expected
        assert grid.rows[1] == ("VB",)
        assert [grid.shared(row, column) for row in (2, 3) for column in (1, 2, 3, 4)] == ["", "both", "both", ""] * 2
    (tmp_path / "answers.xlsx").write_bytes(zipped(good()))  # of which the hostile ones are made
    assert _read_answers(tmp_path / "answers.xlsx", ASKED)[0].lines["V_B"].value == pytest.approx(2.76)


@pytest.mark.parametrize(
    ("task", "letters"),
    [
        ("scheme-09-shaper", {"l_CA": "CA", "V_D": "pd"}),
        ("bertyaev-six-bar", {"l_AP2": "AP2", "l_O1D": "O1D"}),
        ("scheme-20-press-automaton", {"l_BC": "BC"}),
    ],
)
def test_a_form_has_the_letters_of_all_that_is_measured_between_points(
    tmp_path: Path, task: str, letters: dict[str, str]
) -> None:
    rows = read_grid(form(tmp_path, "form.csv", "uk", task)).rows
    told = {row[0]: row[2] for row in rows if len(row) > 2}

    assert {name: told[name] for name in letters} == letters
    assert [name for name, letters in told.items() if name.startswith("l_") and not letters] == []


@pytest.mark.parametrize(
    "heads",
    [
        "Ф.И.О.;Вариант №",
        "Фамилия И.О.;№ вар.",
        "Прізвище, ім'я;В-т",
        "ПІБ;Варіант",
        "П.І.Б.;вар-т",
        "Surname;No. variant",
    ],
)
def test_columns_of_a_class_are_known_however_they_are_abbreviated_and_what_stands_below_is_no_student(
    tmp_path: Path, heads: str
) -> None:
    below = "Итого по списку;28\nВсього;\nПреподаватель: Петренко;\n;Староста Сидоренко\nДата:;\n"
    (file := tmp_path / "class.csv").write_text(
        f"{heads};V_B, мм;V_B, м/с\nСтароста Олег;3;45мм?;4,5 м/с?\nІваненко;4;46?;4,6 ??\n{below}", encoding="utf-8"
    )

    first, second = _read_answers(file, ASKED)

    assert (first.who.student, first.about["variant"], second.who.student) == ("Староста Олег", "3", "Іваненко")
    assert (first.lines["V_B"].mm, first.lines["V_B"].value, first.problems) == (45.0, 4.5, ())
    assert (second.lines["V_B"].mm, second.lines["V_B"].value, second.problems) == (46.0, 4.6, ())


def test_a_class_without_a_column_of_names_is_refused(tmp_path: Path) -> None:
    (file := tmp_path / "class.csv").write_text("who;V_B, mm;V_B, m/s\nOne;45;4.5\nTwo;44;4.4\n", encoding="utf-8")

    assert "no column says whose answers these are" in refused(file)


def test_arms_on_the_lever_are_asked_and_read_in_millimetres_and_those_of_couples_where_they_have_some(
    tmp_path: Path,
) -> None:
    arms = {"nau-slider-crank": ["F_i2", "F_i3", "F_3", "M_i2_B", "M_i2_A"]}
    arms["scheme-09-shaper"] = ["F_i3", "G_3", "F_i4", "G_4", "F_i5", "G_5", "F_5"]  # on the sheet a couple has one arm
    for task, names in arms.items():
        rows = form(tmp_path, f"{task}.csv", "uk", task).read_text(encoding="utf-8-sig").splitlines()
        lever = [row.split(";") for row in rows if row.startswith("h_lever")]
        assert [(row[0], row[6]) for row in lever] == [(f"h_lever_{name}", "мм") for name in names]

    (file := tmp_path / "answers.csv").write_text(f"{HEAD}h_lever_F_i2;;;12,5;мм;\n", encoding="utf-8")

    assert _read_answers(file, ASKED)[0].lines["h_lever_F_i2"].mm == 12.5


def test_greek_letters_that_a_code_page_has_not_are_known_by_what_is_left(tmp_path: Path) -> None:
    text = "студент;μ_V;V_B, мм;ω_1, рад/с;ω_2, рад/с;ω_2, направление;ε_2, рад/с²\nА;0,1;56;-147;15,7;+;-3940\n"

    (student,) = read(tmp_path, text.encode("cp1251", "replace"))

    assert {*student.scales, *student.lines} == {"mu_V", "V_B", "omega_1", "omega_2", "epsilon_2"}
    assert (student.lines["omega_2"].sense, student.lines["epsilon_2"].value) == (1, -3940.0)


@pytest.mark.parametrize(("language", "row"), [("en", "row 3"), ("uk", "рядок 3"), ("ru", "строка 3")])
def test_the_place_of_a_row_says_that_it_is_one_in_another_process_too(language: str, row: str) -> None:
    place = Grid("class.csv", ()).place(2)

    error = pickle.loads(pickle.dumps(LocatedError(place, InputError("variant-twice"))))

    assert error.text(language).startswith(f"class.csv: {row}: ")
