"""Answer forms: what is asked, how it is written, and how it comes back from any spreadsheet."""

from __future__ import annotations

import csv
import io
import re
from pathlib import Path

import openpyxl
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from kulman import check, solve
from kulman.scales.errors import LANGUAGES, InputError
from kulman.scales.packaged import packaged
from kulman.tests.support.answer_files import ASKED, HEAD, ROW, messages, one, read
from kulman.variants.marking.reading import read_answers
from kulman.variants.spreadsheets.files import read_grid
from kulman.variants.spreadsheets.grid import letters
from kulman.variants.tables import csv_table, harmless, xlsx_bytes

PACKAGE = "kulman.variants.marking"


def form(tmp_path: Path, name: str, language: str, task: str = "nau-slider-crank") -> Path:
    """Write an empty form."""
    return check(task, lang=language).write_form(tmp_path / name)


@pytest.mark.parametrize("kind", ["", "mistakes."])
def test_every_language_has_the_same_texts_with_the_same_placeholders(kind: str) -> None:
    tables = {language: packaged(PACKAGE, "texts", f"{kind}{language}") for language in LANGUAGES}

    assert tables["uk"].keys() == tables["ru"].keys() == tables["en"].keys()
    for key in tables["en"]:
        assert len({tuple(sorted(re.findall(r"{\w+}", tables[lang][key]))) for lang in LANGUAGES}) == 1, key


def test_every_mistake_has_words() -> None:
    import kulman.plans.mistakes.book  # noqa: F401  all rules are entered
    from kulman.plans.mistakes.rules import MISTAKES

    texts = packaged(PACKAGE, "texts", "mistakes.en")

    assert list(texts) == sorted(MISTAKES, key=lambda id: int(id.removeprefix("M")))


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("name", ["form.csv", "form.xlsx"])
def test_a_form_can_be_read_in_the_language_it_is_written_in(tmp_path: Path, name: str, language: str) -> None:
    grid = read_grid(form(tmp_path, name, language))
    header = next(row for row in grid.rows if len(row) == 8 and row[0] in ("quantity", "величина"))
    asked = [row[0] for row in grid.rows if row[0] in ASKED.names]

    assert len(header) == 8
    assert asked.index("V_A") < asked.index("V_B") < asked.index("omega_2") < asked.index("a_B") < asked.index("R_12")
    assert {*asked} == {name for name in ASKED.names if "_couple_" not in name}


@pytest.mark.parametrize(
    ("task", "told"),
    [
        ("bertyaev-six-bar", {"mu_a": "M_a", "mu_a_B": "M_a (B)"}),
        ("madi-four-bar", {"mu_F_23": "μ_p (2, 3)", "mu_F_1": "μ_p (1)"}),
        ("scheme-15-lever-shears", {"h_G_4": "h_G4", "h_lever_G_4": "h_G4 (lever)", "F_i4_couple": "F′_i4 = F″_i4"}),
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


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("name", ["form.csv", "form.xlsx"])
@pytest.mark.parametrize("format", [None, "A4"])
def test_the_form_of_a_variant_says_the_sheets_scale_factors_and_answers_nothing(
    tmp_path: Path, name: str, language: str, format: str | None
) -> None:
    solution = solve("nau-slider-crank", "7", lang=language, format=format)
    said = solution.table().splitlines()[-1]
    own = read_grid(check("nau-slider-crank", "7", lang=language, format=format).write_form(tmp_path / name))
    blank = read_grid(form(tmp_path, "blank.csv", language))

    [line] = [row[0] for row in own.rows if said in row[0]]
    assert set(solution.to_json()["scales"]) <= set(re.findall(r"mu_\w+", line))
    factors = [row for row in own.rows if row[0].startswith("mu_")]
    assert {row[0] for row in factors} == set(solution.to_json()["scales"])
    assert not any(row[4] or row[5] for row in factors)
    assert not any("mu_l = " in row[0] for row in blank.rows if row)
    with pytest.raises(InputError, match="the form is empty"):
        read_answers(tmp_path / name, ASKED)


def test_an_empty_form_is_told_to_be_empty(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="the form is empty"):
        read_answers(form(tmp_path, "form.xlsx", "uk"), ASKED)


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

    found = read_answers(file, ASKED)[0]

    assert found.problems == ()
    assert found.who.student == "Петренко"
    assert found.scales["mu_V"].value == pytest.approx(0.05)
    line = found.lines["V_B"]
    assert (line.mm, line.value) == (pytest.approx(55.2), pytest.approx(2.76))
    assert line.direction == pytest.approx(3.14159, abs=1e-4)


@pytest.mark.parametrize("separator", [";", ",", "\t"])
@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "cp1251", "utf-16"])
def test_csv_comes_in_any_encoding_with_any_separator(tmp_path: Path, encoding: str, separator: str) -> None:
    rows = [["студент", "Ґалаґан"], HEAD.strip().split(";"), ROW.strip().split(";")]
    stream = io.StringIO()
    csv.writer(stream, delimiter=separator).writerows(rows)

    found = one(tmp_path, stream.getvalue().encode(encoding))

    assert found.who.student == "Ґалаґан"
    assert found.problems == ()
    assert found.lines["V_B"].value == pytest.approx(2.76)
    assert found.lines["V_B"].mm == pytest.approx(55.2)


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_form_saved_by_an_old_spreadsheet_comes_back(tmp_path: Path, language: str) -> None:
    text = form(tmp_path, "form.csv", language).read_text(encoding="utf-8-sig")
    separator = "," if language == "en" else ";"
    rows = list(csv.reader(io.StringIO(text), delimiter=separator))
    for row in rows:
        if row[0] in ASKED.quantities:
            row[3:6] = ["10", "2", "20"]
    stream = io.StringIO()
    csv.writer(stream, delimiter=separator).writerows(rows)

    found = one(tmp_path, stream.getvalue().encode("cp1251", "replace"))  # which has no superscripts

    assert found.problems == ()
    assert found.lines["a_B"].value == pytest.approx(20.0)
    assert found.lines["M_bal"].value == pytest.approx(20.0)


def test_columns_may_stand_in_any_order_in_any_language(tmp_path: Path) -> None:
    found = one(tmp_path, "direction,unit,value,Quantity,мм,масштаб\n180,m/s,2.76,V_B,55.2,0.05\n")

    line = found.lines["V_B"]
    assert (line.value, line.mm) == (pytest.approx(2.76), pytest.approx(55.2))


@pytest.mark.parametrize(
    ("cell", "mm"), [("12,5 мм", 12.5), ("12.5mm", 12.5), ("1,25 см", 12.5), (" 12,5 ", 12.5), ("0", 0.0)]
)
def test_units_stand_in_cells(tmp_path: Path, cell: str, mm: float) -> None:
    found = one(tmp_path, f"{HEAD}V_B;{cell};;2,76;;\n")

    assert found.problems == ()
    assert found.lines["V_B"].mm == pytest.approx(mm)


@pytest.mark.parametrize(
    ("cell", "mu", "sure"),
    [
        ("0,05", 0.05, False),
        ("20", 20.0, False),
        ("0,05 (м/с)/мм", 0.05, True),
        ("20 мм/(м/с)", 0.05, True),
        ("20 mm/(m/s)", 0.05, True),
    ],
)
def test_a_scale_factor_is_meant_either_way(tmp_path: Path, cell: str, mu: float, sure: bool) -> None:
    found = one(tmp_path, f"{HEAD}V_B;55;{cell};2,76;;\n")

    assert found.problems == ()
    line = found.lines["V_B"].factor
    assert line is not None
    assert (line.value, line.sure) == (pytest.approx(mu), sure)


@pytest.mark.parametrize(
    ("cell", "sense"),
    [("+", 1), ("-", -1), ("−", -1), ("cw", -1), ("за годинниковою стрілкою", -1), ("против ч.с.", 1), ("проти", 1)],
)
def test_senses_are_words_or_signs(tmp_path: Path, cell: str, sense: int) -> None:
    assert one(tmp_path, f"{HEAD}omega_2;;;16,3;;{cell}\n").lines["omega_2"].sense == sense


@pytest.mark.parametrize(
    ("row", "where", "what"),
    [
        ("V_B;багато;;2,76;;", "B2, V_B", "is not a number"),
        ("V_B;55;0;2,76;;", "C2, V_B", "greater than zero"),
        ("V_B;-55;;2,76;;", "B2, V_B", "cannot be negative"),
        ("V_B;=5*11;;2,76;;", "B2, V_B", "formulas are not worked out"),
        ("V_B;55;;2,76 кг;;", "D2, V_B", "unit kg does not fit"),
        ("V_B;55;;2,76;;кудись", "F2, V_B", "is no direction"),
        ("V_BB;55;;2,76;;", "A2, V_BB", "did you mean 'V_B'"),
        ("V_B;55 м/с;;2,76;;", "B2, V_B", "unit m/s does not fit"),
        ("V_B;1e400;;2,76;;", "B2, V_B", "too large or too small"),
    ],
)
def test_a_bad_cell_is_told_of_with_its_place_and_the_rest_is_read(
    tmp_path: Path, row: str, where: str, what: str
) -> None:
    found = one(tmp_path, f"{HEAD}{row}\na_B;49;4;196;;\n")

    assert len(found.problems) == 1
    assert where in messages(found)[0]
    assert what in messages(found)[0]
    assert found.lines["a_B"].value == pytest.approx(196.0)


def test_a_value_with_a_wrong_unit_is_taken_in_that_of_the_form(tmp_path: Path) -> None:
    assert one(tmp_path, f"{HEAD}V_B;;;2,76;кг;\n").lines["V_B"].value == pytest.approx(2.76)


def test_a_quantity_answered_twice_counts_once(tmp_path: Path) -> None:
    found = one(tmp_path, f"{HEAD}{ROW}V_B;1;;2;;\n")

    assert found.lines["V_B"].value == pytest.approx(2.76)
    assert "answered a second time" in messages(found)[0]


def test_names_with_cyrillic_letters_that_look_alike_are_known(tmp_path: Path) -> None:
    assert "V_B" in one(tmp_path, f"{HEAD}V_В;55;;2,76;;\n").lines


def test_columns_that_changed_places_are_put_back(tmp_path: Path) -> None:
    rows = "V_B;2,76;0,05;55,2;;\nV_A;4;0,05;80;;\nV_BA;2,1;0,05;42;;\na_B;220;4;55;;\n"

    found = one(tmp_path, HEAD + rows)

    assert found.lines["V_B"].mm == pytest.approx(55.2)
    assert found.lines["V_B"].value == pytest.approx(2.76)
    assert "each other's place" in messages(found)[0]


def test_columns_in_their_places_stay_there(tmp_path: Path) -> None:
    rows = "V_B;55,2;0,05;2,76;;\nV_A;80;0,05;4;;\nV_BA;42;0,05;2,1;;\na_B;55;4;220;;\n"

    assert one(tmp_path, HEAD + rows).problems == ()


def test_a_class_is_a_row_for_each_student(tmp_path: Path) -> None:
    head = "ПІБ;варіант;mu_V;V_B.mm;V_B;V_B.dir;omega_2 [рад/с];a_B, м/с²;V_C\n"
    found = read(tmp_path, f"{head}Один;3;0,05;55;2,75;180;-16,3;220;1\nДва;4;;;;;;;\nТри;5;;шість;2,8;;;;\n")

    assert [answers.who.student for answers in found] == ["Один", "Два", "Три"]
    assert found[0].lines["V_B"].mm == pytest.approx(55.0)
    assert found[0].lines["omega_2"].value == pytest.approx(-16.3)
    assert found[0].scales["mu_V"].value == pytest.approx(0.05)
    assert "'V_C'" in messages(found[0])[0]
    assert not found[1].lines
    assert found[2].lines["V_B"].value == pytest.approx(2.8)
    assert "D4, V_B" in messages(found[2])[0]
    assert found[0].columns == ("V_B", "omega_2", "a_B")


@settings(max_examples=60, deadline=None)
@given(st.lists(st.lists(st.text(max_size=12), min_size=1, max_size=5), min_size=1, max_size=5))
def test_nothing_written_starts_a_formula(rows: list[list[str]]) -> None:
    for row in csv.reader(io.StringIO(csv_table(rows, "uk").decode("utf-8-sig"), newline=""), delimiter=";"):
        assert not any(cell.lstrip(" ").startswith(("=", "+", "-", "@", "\t", "\r")) for cell in row)
    book = openpyxl.load_workbook(io.BytesIO(xlsx_bytes(rows, "=x")))
    assert book.active is not None
    assert all(cell.data_type != "f" for row in book.active.iter_rows() for cell in row)


def test_a_text_that_looks_like_a_formula_comes_back(tmp_path: Path) -> None:
    file = tmp_path / "a.csv"
    file.write_bytes(csv_table([["x", "=1+1", "-5 mm", 1.5], ["V_B", "V_A", "V_BA", 2]], "uk"))

    assert read_grid(file).rows[0] == ("x", "=1+1", "-5 mm", "1,5")


def test_the_same_form_is_the_same_bytes(tmp_path: Path) -> None:
    assert form(tmp_path, "a.xlsx", "uk").read_bytes() == form(tmp_path, "b.xlsx", "uk").read_bytes()


@pytest.mark.parametrize(("number", "name"), [(0, "A"), (25, "Z"), (26, "AA"), (701, "ZZ"), (702, "AAA")])
def test_columns_have_the_letters_of_spreadsheets(number: int, name: str) -> None:
    assert letters(number) == name


def test_an_apostrophe_keeps_a_text_a_text() -> None:
    assert [harmless(text) for text in ("=A1", "@x", "+1", "V_B", "")] == ["'=A1", "'@x", "'+1", "V_B", ""]
