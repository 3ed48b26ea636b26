"""What commands have found, as data: columns, rows and files of every kind alike, from Python and the command line."""

from __future__ import annotations

import csv
import html
import io
import json
import re
from pathlib import Path

import openpyxl
import pytest

from kulman import all_variants, chart, cli, solve, sweep
from kulman.scales.errors import InputError
from kulman.variants.tables import FILES, Result

TASK = "nau-slider-crank"
FOUND = {
    "solve": lambda: solve(TASK, "3", only="velocity", lang="en", condition=True),
    "sweep": lambda: sweep(TASK, "3", only="velocity", lang="en"),
    "sweep of a hoist": lambda: sweep("karpenko-hoist", positions=9, lang="en"),
    "chart": lambda: chart(TASK, "3", chart="depth", positions=36, lang="en"),
    "variants": lambda: all_variants(TASK, quantities=["V_B", "a_B"], lang="en"),
}


@pytest.mark.parametrize("name", FOUND)
def test_rows_are_the_same_in_every_kind_of_file(name: str, tmp_path: Path) -> None:
    found = FOUND[name]()
    assert isinstance(found, Result)

    written = {path.suffix: path for path in found.save(*(tmp_path / f"x{suffix}" for suffix in FILES))}

    def same(cell: object, text: object) -> bool:
        if cell is None or cell == "":
            return text in (None, "")
        if isinstance(cell, str):
            return str(text).lstrip("'") == cell
        return float(str(text)) == pytest.approx(float(cell), rel=1e-9, abs=1e-12)

    [sheet] = openpyxl.load_workbook(written[".xlsx"]).worksheets
    page = written[".html"].read_text(encoding="utf-8")
    tables = {
        "csv": list(csv.reader(io.StringIO(written[".csv"].read_text(encoding="utf-8-sig"), newline=""))),
        "xlsx": [list(row) for row in sheet.iter_rows(values_only=True)],
        "html": [[html.unescape(x) for x in re.findall("<td>(.*?)</td>", row)] for row in page.split("<tr>")[1:]],
    }
    assert len(found.rows) > 1
    for kind, rows in tables.items():
        assert len(rows) == 1 + len(found.rows), kind
        for row, own in zip(rows, (found.columns, *map(tuple, found.rows)), strict=True):
            assert len(row) == len(own), kind
            assert all(map(same, own, row)), (kind, own, row)
    assert json.loads(written[".json"].read_text(encoding="ascii")) == json.loads(json.dumps(found.to_json()))
    assert found.csv("uk").count(";") >= len(found.columns) - 1
    assert "<pre>" in found._repr_html_()


@pytest.mark.parametrize("command", ["solve", "sweep", "chart --chart depth --positions 36", "variants"])
def test_the_command_line_writes_what_python_does(command: str, tmp_path: Path) -> None:
    name, *options = command.split()
    files = [str(tmp_path / f"x{suffix}") for suffix in FILES]
    arguments = [name, TASK, *options, "--lang", "en", *(word for file in files for word in ("-o", file))]

    with pytest.raises(SystemExit) as ended:
        cli.main(arguments)

    assert ended.value.code == 0
    made = {
        "solve": lambda: solve(TASK, lang="en"),
        "sweep": lambda: sweep(TASK, lang="en"),
        "chart": lambda: chart(TASK, chart="depth", positions=36, lang="en"),
        "variants": lambda: all_variants(TASK, lang="en"),
    }[name]()
    again = made.save(*(tmp_path / f"y{suffix}" for suffix in FILES))
    for file, other in zip(files, again, strict=True):
        if not file.endswith(".xlsx"):
            assert Path(file).read_bytes() == other.read_bytes()


def test_of_several_charts_each_has_rows_of_its_own(tmp_path: Path) -> None:
    charts = chart(TASK, "3", chart="depth,stability", positions=36, lang="en")

    with pytest.raises(InputError, match="each chart has rows of its own: depth, stability"):
        charts.csv()
    assert [path.name for path in charts.save(tmp_path / "x.html")] == ["x-depth.html", "x-stability.html"]
