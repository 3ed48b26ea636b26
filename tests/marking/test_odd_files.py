"""Files of answers from elsewhere: formulas, dates, bombs, entities, what is no file of answers, any bytes at all."""

from __future__ import annotations

import subprocess
import sys
import zipfile
from contextlib import suppress
from pathlib import Path

import openpyxl
import pytest
import xlsxwriter
from hypothesis import given, settings
from hypothesis import strategies as st

from kulman.scales.errors import InputError
from kulman.tests.support.answer_files import ASKED, HEAD, messages, read
from kulman.tests.support.hostile_workbooks import HOSTILE, SMALL, good, hostile, zipped
from kulman.variants.marking.reading import read_answers
from kulman.variants.spreadsheets.files import read_grid


def workbook(tmp_path: Path, cells: dict[str, object], formats: dict[str, str] | None = None) -> Path:
    """Write a workbook by another program."""
    file = tmp_path / "answers.xlsx"
    book = xlsxwriter.Workbook(str(file))
    sheet = book.add_worksheet()
    for column, text in enumerate(HEAD.strip().split(";")):
        sheet.write(0, column, text)
    for address, value in cells.items():
        look = book.add_format({"num_format": (formats or {})[address]}) if address in (formats or {}) else None
        sheet.write(address, value, look)
    book.close()
    return file


def test_a_formula_is_read_by_its_stored_result_and_never_worked_out(tmp_path: Path) -> None:
    file = tmp_path / "answers.xlsx"
    book = xlsxwriter.Workbook(str(file))
    sheet = book.add_worksheet()
    sheet.write_row(0, 0, HEAD.strip().split(";"))
    sheet.write_row(1, 0, ["V_B", 55.2, 0.05])
    sheet.write_formula("D2", "=B2*C2", None, 2.76)
    sheet.write_row(2, 0, ["V_A", 80])
    sheet.write_formula("D3", '=HYPERLINK("http://x","4")', None, "")
    book.close()

    found = read_answers(file, ASKED)[0]

    assert found.lines["V_B"].value == pytest.approx(2.76)
    assert found.lines["V_A"].value is None
    assert "D3, V_A" in messages(found)[0]
    assert "formula" in messages(found)[0]


def test_a_date_that_was_a_number_is_told_of(tmp_path: Path) -> None:
    found = read_answers(workbook(tmp_path, {"A2": "V_B", "B2": 45789, "D2": 2.76}, {"B2": "dd.mm"}), ASKED)[0]

    assert "holds a date" in messages(found)[0]
    assert found.lines["V_B"].value == pytest.approx(2.76)


def bomb(tmp_path: Path, size: int) -> Path:
    """Write a small workbook that unpacks into `size` bytes."""
    file = workbook(tmp_path, {"A2": "V_B"})
    with zipfile.ZipFile(file) as old:
        parts = {name: old.read(name) for name in old.namelist()}
    parts["xl/worksheets/sheet1.xml"] += b" " * size
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as new:
        for name, data in parts.items():
            new.writestr(name, data)
    return file


def test_a_zip_bomb_is_refused(tmp_path: Path) -> None:
    file = bomb(tmp_path, 22_000_000)
    assert file.stat().st_size < 200_000

    with pytest.raises(InputError, match="unpacked, the file is larger than 20 MB"):
        read_answers(file, ASKED)


def test_entities_are_not_unfolded(tmp_path: Path) -> None:
    file = workbook(tmp_path, {"A2": "V_B"})
    with zipfile.ZipFile(file) as old:
        parts = {name: old.read(name) for name in old.namelist()}
    evil = b'<!DOCTYPE x [<!ENTITY a "aaaaaaaaaa">]>'
    parts["xl/worksheets/sheet1.xml"] = parts["xl/worksheets/sheet1.xml"].replace(b"?>\n", b"?>\n" + evil, 1)
    with zipfile.ZipFile(file, "w") as new:
        for name, data in parts.items():
            new.writestr(name, data)

    with pytest.raises(InputError, match="not an XLSX file"):
        read_answers(file, ASKED)


def test_a_huge_file_is_refused_without_being_read(tmp_path: Path) -> None:
    file = tmp_path / "answers.csv"
    with file.open("wb") as stream:
        stream.truncate(100_000_000)

    with pytest.raises(InputError, match="larger than 20 MB"):
        read_answers(file, ASKED)


@pytest.mark.parametrize(
    ("name", "content", "what"),
    [
        ("a.csv", b"", "the file is empty"),
        ("a.csv", b"\0\1\2" * 100, "not a text"),
        ("a.csv", b"PK\x03\x04abc", "its name end in .xlsx"),
        ("a.xlsx", b"PK\x03\x04abc", "not an XLSX file"),
        ("a.xlsx", b"\xd0\xcf\x11\xe0" * 100, "not an XLSX file"),
        ("a.csv", "щось;інше\n1;2\n".encode(), "no row says what the columns hold"),
        ("a.ods", b"x", "ends in one of: .csv, .xlsx"),
        ("a.csv", b'"V_B;' + b"x" * 200_000, "a quotation mark is not closed"),
    ],
)
def test_what_is_no_file_of_answers_is_refused_in_one_line(
    tmp_path: Path, name: str, content: bytes, what: str
) -> None:
    with pytest.raises(InputError) as caught:
        read(tmp_path, content, name)

    assert what in caught.value.text("en")
    assert "\n" not in caught.value.text("en")


def test_a_folder_or_nothing_is_refused(tmp_path: Path) -> None:
    (tmp_path / "x.csv").mkdir()

    with pytest.raises(InputError, match="not a folder"):
        read_answers(tmp_path / "x.csv", ASKED)
    with pytest.raises(InputError, match="there is no such file"):
        read_answers(tmp_path / "y.csv", ASKED)


@settings(max_examples=60, deadline=None)
@given(st.binary(max_size=400))
def test_whatever_bytes_come_they_are_read_or_refused(tmp_path_factory: pytest.TempPathFactory, data: bytes) -> None:
    folder = tmp_path_factory.mktemp("any")
    for name in ("a.csv", "a.xlsx"):
        with suppress(InputError):  # anything else would be our bug
            read(folder, HEAD.encode() + data if name == "a.csv" else b"PK\x03\x04" + data, name)


@pytest.mark.parametrize("name", [*SMALL, "member twice", "password", "packed by LZMA", "size that is too small"])
def test_a_hostile_workbook_is_refused_in_one_line(tmp_path: Path, name: str) -> None:
    file = tmp_path / "answers.xlsx"
    file.write_bytes(hostile(name))
    line = ""

    try:
        read_grid(file)
    except InputError as error:
        line = error.text("en")

    assert HOSTILE[name] in line
    assert "\n" not in line


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


def test_a_harmless_workbook_is_read_as_the_hostile_ones_are_made_of_it(tmp_path: Path) -> None:
    file = tmp_path / "answers.xlsx"
    file.write_bytes(zipped(good()))

    assert read_answers(file, ASKED)[0].lines["V_B"].value == pytest.approx(2.76)


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


@pytest.mark.parametrize(
    ("content", "what"),
    [
        (b";" * 2_000_000, "more than 20000 rows or 1000 columns"),
        (b"a;b;c\n" * 200_000, "more than 20000 rows or 1000 columns"),
        ((b";" * 900 + b"\n") * 2_000, "than can be read at once"),
        (b"a" * 9_000_000, "than can be read at once"),
        (b"a;" + b"b" * 40_000, "B1: the cell is longer than 32767 characters"),
        (b"a;" + b"b" * 140_000, "a quotation mark is not closed"),
        (b"\xff\xfe\0\0a\0\0\0", "not a text"),
        ("a;\0".encode("utf-16"), "not a text"),
        (b"\xff\xfe\x00\xd8", "not a text"),
        (b'"' * 300_001, ""),
        (b'sep="\n1"2', ""),
        (b"\x98" * 100, "not a text"),
        (b"\r" * 3_000_000, ""),
        ("\N{RIGHT-TO-LEFT OVERRIDE};\u200b\n".encode() * 9, ""),
    ],
)
def test_a_hostile_csv_is_refused_in_one_line(tmp_path: Path, content: bytes, what: str) -> None:
    file = tmp_path / "a.csv"
    file.write_bytes(content)
    line = ""

    try:
        read_grid(file)
    except InputError as error:
        line = error.text("en")

    assert what in line
    assert "\n" not in line
