"""The document about gears: what it shows is what the commands print today, its names exist."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest

import kulman
from kulman.docs import refresh
from kulman.tests.support.documents import blocks, run_here

DOCS = Path(kulman.__file__).parent / "docs"
TEXT = (DOCS / "gears.md").read_text(encoding="utf-8")


def test_what_the_document_shows_is_what_is_printed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    run_here(monkeypatch, capsys)

    found = blocks(TEXT)

    assert len(found) == 4
    for block in found:
        assert refresh.filled(block, str(tmp_path)) == block


@pytest.mark.soak
def test_the_sheet_and_the_chart_of_the_document_are_drawn(tmp_path: Path) -> None:
    found = blocks(TEXT, slow=True)

    assert len(found) == 2
    for block in found:
        assert refresh.filled(block, str(tmp_path)) == block


def test_every_quantity_every_check_and_every_column_is_named() -> None:
    solution, swept = kulman.solve("madi-gear"), kulman.sweep("madi-gear")
    names = [name for name in solution.quantities if not re.match(r"(y|theta)_.*\d\d$|mu_|PW$", name)]
    of_pinion = {name: re.sub(r"(?<=[A-Za-z_])2(?=_|$)", "1", name) for name in names}  # of the wheel alike
    columns = [column.partition(" ")[0] for column in swept.csv("en").splitlines()[0].split(",")[1:]]
    checks = {re.sub(r"2$", "1", name) for name in solution.checks if not name.startswith("centre")}

    prose = re.sub(r"```.*?```", "", TEXT, flags=re.DOTALL)
    named = {found for quoted in re.findall(r"`([^`]+)`", prose) for found in quoted.split()}
    assert [name for name in names if not named & {name, of_pinion[name]}] == []
    assert [name for name in (*columns, *checks) if name not in named] == []


def test_pictures_of_the_document_are_drawn_by_its_commands() -> None:
    assert "gears" in refresh.NAMES
    for name in re.findall(r"pictures/([\w-]+)\.png", TEXT):
        assert name in refresh.SHEETS
        assert (DOCS / "pictures" / f"{name}.png").exists()


def test_the_lines_of_python_run() -> None:
    (block,) = re.findall(r"```python\n(.*?)```", TEXT, re.DOTALL)
    names: dict[str, Any] = {}

    exec(block, names)

    assert names["solution"]["z_W1"].value == 2.0
    assert len(names["pinion"]) > 1000
