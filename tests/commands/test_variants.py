"""All variants of a task beside one another: values, languages, those asked for, a page to print."""

from __future__ import annotations

import csv
import json
import re
from pathlib import Path

import openpyxl
import pytest

from kulman import all_variants, load_task, solve
from kulman.tests.support.commands import Run

TASK = "nau-slider-crank"


def test_values_are_those_of_every_variant(tmp_path: Path, run: Run) -> None:
    file = tmp_path / "key.xlsx"

    status, _, err = run("variants", TASK, "--quantities", "V_B,M_bal", "-o", str(file), "--lang", "en")

    assert (status, err) == (0, "")
    found = openpyxl.load_workbook(file).active
    assert found is not None
    head, *rows = found.iter_rows(values_only=True)
    assert list(head[2:]) == list(load_task(TASK).variants)
    assert [row[0] for row in rows] == ["V_B", "M_bal"]
    for row in rows:
        for variant, value in zip(head[2:], row[2:], strict=True):
            assert value == pytest.approx(solve(TASK, str(variant))[str(row[0])].value, rel=1e-9)


def test_a_variant_without_a_solution_does_not_hide_the_others() -> None:
    found = all_variants(TASK, quantities=["V_B"], set={"l_AB": "36 mm", "phi": "90 deg"}, lang="en")

    assert {*found.problems} == {"2", "3", "4", "5", "6", "7", "8", "9", "example"} - {*found.keys}
    assert found.problems
    assert found.keys
    assert len(found.table().splitlines()) == 2


def test_a_table_is_said_in_the_language_that_is_asked_for(tmp_path: Path) -> None:
    found = all_variants(TASK, quantities=["V_B"], lang="uk")

    rows = list(csv.reader(found.save(tmp_path / "key.csv")[0].read_text("utf-8-sig").splitlines(), delimiter=";"))

    assert found.table("en") == all_variants(TASK, quantities=["V_B"], lang="en").table() != found.table()
    assert rows[0][:3] == ["name", "unit", "0"]  # the same in every language
    assert rows[1][:3] == ["V_B", "м/с", "2,16225964"]


def test_only_the_variants_asked_for_are_solved(run: Run) -> None:
    asked = "variants", TASK, "-v", "3,example", "--quantities", "V_B"
    status, out, err = run(*asked, "--json")

    assert (status, err) == (0, "")
    found = json.loads(out)["variants"]
    assert found == {name: {"V_B": solve(TASK, name)["V_B"].value} for name in ("3", "example")}
    assert run(*asked)[1].startswith("quantity  unit")  # as other results, in the language of the system


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--make", "0"], "1000"),
        (["--make", "x"], "x"),
        (["--make", "3", "--range", "l_OA=9"], "25..60/5 mm"),
        (["--make", "3", "--range", "l_OA=60..20 mm"], "60..20"),
        (["--make", "3", "--range", "rotation=1..2"], "rotation"),
        (["--make", "3", "--range", "lOA=25..60 mm"], "nau-slider-crank"),
        (["--make", "3", "--range", "l_OA=-5..-1 mm"], "l_OA"),
        (["--make", "3", "--set", "l_OA=300 mm"], "--make 3: found: 0; of 50 more sets"),
        (["--make", "3", "--from", "x.csv"], "--from"),
        (["--seed", "3"], "--make"),
        (["-v", "3,77"], "77"),
        (["--quantities", "V_X"], "V_X"),
        (["--from", "none.csv"], "none.csv"),
        (["-o", "new.toml"], "--make"),
    ],
)
def test_what_cannot_be_done_is_said_in_a_line(arguments: list[str], said: str, folder: Path, run: Run) -> None:
    status, out, err = run("variants", TASK, *arguments)

    assert (status, out, err.count("\n")) == (2, "", 1)
    assert said in err
    assert list(folder.iterdir()) == []


def test_the_key_of_all_variants_has_the_millimetres_of_the_format_that_is_printed(tmp_path: Path, run: Run) -> None:
    asked = ("--quantities", "R_12_t", "--format", "A4", "-v", "3", "--lang", "en")
    status, *_ = run("variants", "nau-slider-crank", *asked, "-o", str(tmp_path / "key.html"))

    page = (tmp_path / "key.html").read_text(encoding="utf-8")
    blank, sheet = (solve("nau-slider-crank", "3", format=name)["R_12_t"].mm or 0.0 for name in ("A4", None))
    assert status == 0
    assert "as on a sheet of the format A4" in page
    assert blank < sheet
    assert f"<small>{blank:.1f} mm</small>" in page


@pytest.mark.soak
def test_the_key_of_all_variants_is_a_page_to_print(tmp_path: Path) -> None:
    page = all_variants("nau-slider-crank", lang="en").save(tmp_path / "key.html")[0].read_text(encoding="utf-8")

    solution = solve("nau-slider-crank", "3", lang="en")
    size, mm = solution["V_B"].value or 0.0, solution["V_B"].mm or 0.0
    assert f"<td>{size:.4g}<br><small>{mm:.1f} mm</small></td>" in page
    assert f"<td>{solution.scales['mu_V'].mu:.4g}</td>" in page
    assert f"<td>{(solution['h_2'].value or 0.0) * 1e3:.4g}<br>" in page  # an arm in mm
    assert f"<p>Segments, mm, as on a sheet of the format {solution.format}</p>" in page
    assert "F″<sub>i2</sub>" in page  # F′ = F″, both with their indices
    two = (
        all_variants("nau-slider-crank", make=12, lang="en").save(tmp_path / "made.html")[0].read_text(encoding="utf-8")
    )
    assert (
        re.findall(r"<th>(\d+)</th>", two.partition("<section>")[2].partition("<section>")[0])[-1] == "6"
    )  # not 11 and one
    assert "@page{size:A4 landscape" in page
