"""Tables of variants as departments keep them: whatever symbols, units, merged cells and empty rows they have."""

from __future__ import annotations

import csv
import re
from collections.abc import Callable
from pathlib import Path

import openpyxl
import pytest

from kulman import load_task
from kulman.scales.errors import InputError
from kulman.scales.units import format_unit
from kulman.variants.making.new_variants import import_variants, read_variants
from kulman.variants.shelf import bundled
from kulman.variants.task import Task

TASK = "nau-slider-crank"
GUIDE = """\
Параметр;Позначення;Одиниці;Номер варіанта;;
;;;0;1;2
Положення механізму;φ;град;30;45;60
Розмір ланок;;;;;
;l_{OA};мм;25;30;35

;l_{AB};мм;125;140;170
;l_{AS_2};мм;42;46;55
Частота обертання ланки 1;n₁;об/хв;2 000;1800;1600
Маса ланок;;;;;
;m2;кг;0,8;1,8;2,5
;m3;кг;0,6;1,5;2,0
Момент інерції;JS2;кг·м²;0,005;0,01;0,015
Сила;F_3;Н;2000;3500;4000
"""


def table(folder: Path, text: str) -> str:
    file = folder / "table.csv"
    file.write_text(text, encoding="utf-8-sig")
    return str(file)


def values(task: Task, file: str) -> dict[str, dict[str, float | str]]:
    read = read_variants(file, task)
    assert [str(problem) for one in read for problem in one.problems] == []
    return {one.id: {name: task.givens[name].read(text) for name, text in one.row.items()} for one in read}


def turned(rows: list[list[str]]) -> list[list[str]]:
    return [list(row) for row in zip(*rows, strict=True)]


def latex(name: str) -> str:
    head, _, rest = name.partition("_")
    return f"{head}_{{{rest}}}" if rest else head


def told(name: str) -> str:
    return f"Величина {name}" if len(name) > 1 else name


@pytest.mark.parametrize("form", [str, latex, lambda name: name.replace("_", ""), told])
@pytest.mark.parametrize("name", bundled())
def test_symbols_and_units_are_read_in_every_usual_form(name: str, form: Callable[[str], str], tmp_path: Path) -> None:
    task = load_task(name)
    variants = {variant: row.values for variant, row in task.variants.items() if variant.isdigit()} or {
        variant: row.values for variant, row in task.variants.items()
    }
    givens = [given for given in task.givens if all(isinstance(row.get(given), float) for row in variants.values())]
    units = [task.givens[given].unit for given in givens]
    shown = ["" if unit is None or unit.name == "1" else format_unit(unit, "uk") for unit in units]
    head = ["", *(f"{form(given)}, {unit}" if unit else form(given) for given, unit in zip(givens, shown, strict=True))]
    rows = [
        [
            variant,
            *(
                f"{unit.from_si(row[given]):.12g}".replace(".", ",")
                for given, unit in zip(givens, units, strict=True)
                if unit
            ),
        ]
        for variant, row in variants.items()
    ]
    for way, cells in (("rows", [head, *rows]), ("columns", turned([head, *rows]))):
        file = tmp_path / f"{way}.csv"
        with file.open("w", encoding="utf-8-sig", newline="") as stream:
            csv.writer(stream, delimiter=";").writerows(cells)

        found = values(task, str(file))

        assert list(found) == list(variants)
        for variant, row in variants.items():
            assert found[variant] == pytest.approx({given: row[given] for given in givens}, rel=1e-9)


def test_the_table_of_a_printed_guide_is_read_as_it_stands(tmp_path: Path) -> None:
    task = load_task(TASK)

    found = values(task, table(tmp_path, GUIDE))

    for variant in "012":
        stated = task.variants[variant].values
        assert found[variant] == pytest.approx({name: stated[name] for name in found[variant]})
        assert len(found[variant]) == 9


def test_merged_cells_say_the_same_of_all(tmp_path: Path) -> None:
    book = openpyxl.Workbook()
    sheet = book.active
    assert sheet is not None
    rows: list[list[object]] = [["Курсова робота"], [], ["Параметр", "Одиниці", "Варіант"], [None, None, 3, 4, 5]]
    rows += [[name, unit, *cells] for name, unit, *cells in (
        ("phi", "град", 30, 45, 60), ("l_OA", "мм", 25), ("l_AB", "мм", 125, 140, 170), ("m_2", None, 0.8, 1.8, 2.5),
    )]  # fmt: skip
    for row in rows:
        sheet.append(row)
    for cells in ("A1:E1", "A3:A4", "C3:E3", "C6:E6", "Z1:Z300"):
        sheet.merge_cells(cells)
    book.save(tmp_path / "table.xlsx")

    found = values(load_task(TASK), str(tmp_path / "table.xlsx"))

    assert list(found) == ["3", "4", "5"]
    assert [row["l_OA"] for row in found.values()] == [pytest.approx(0.025)] * 3
    assert [row["m_2"] for row in found.values()] == [0.8, 1.8, 2.5]


@pytest.mark.parametrize(
    ("header", "given", "said"),
    [
        ("l_OA [см]", "l_OA", "0.025"),
        ("F_3, кгс", "F_3", "кгс"),
        ("Сила F_3 (кгс)", "F_3", "кгс"),
        ("Сила корисного опору, Н: F_3", "F_3", "2.5"),
        ("m_2 (маса шатуна), кг", "m_2", "2.5"),
    ],
)
def test_a_unit_of_a_header_is_never_passed_over(header: str, given: str, said: str, tmp_path: Path) -> None:
    task = load_task(TASK)
    file = table(tmp_path, f'Варіант;phi, град;"{header}"\n1;30;2,5\n')

    [read] = read_variants(file, task)

    if read.problems:
        assert re.search(rf"C2, {given}: .*{said}", str(read.problems[0]))
    else:
        assert task.givens[given].read(read.row[given]) == pytest.approx(float(said))
    assert bool(read.problems) == (said == "кгс")


def test_numbers_without_ids_are_counted_and_other_rows_left(tmp_path: Path) -> None:
    file = table(tmp_path, "phi;l_OA\n\n30;25\n45;30\n\n\n")

    assert list(values(load_task(TASK), file)) == ["1", "2"]


def test_data_that_are_missing_are_named(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"table\.csv: A2, 1: no value of l_OA is given"):
        import_variants(TASK, table(tmp_path, "Варіант;phi;l_AB\n1;30;125\n"))


def test_two_symbols_of_one_name_are_not_taken_for_a_given(tmp_path: Path) -> None:
    file = table(tmp_path, "Варіант;phi;Відношення l_OA до l_AB\n1;30;0,2\n")

    [read] = read_variants(file, load_task(TASK))

    assert set(read.row) == {"phi"}
