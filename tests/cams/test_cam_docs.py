"""The document about cams: what it shows is what the commands print today, its pictures and columns exist."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest

import kulman
from kulman.docs import refresh
from kulman.plans.cams.cam import LAWS
from kulman.tests.support.documents import blocks, run_here
from kulman.variants.sweeps.cam import CamSweep

DOCS = Path(kulman.__file__).parent / "docs"
TEXT = (DOCS / "cams.md").read_text(encoding="utf-8")


def test_what_the_document_shows_is_what_is_printed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    found = blocks(TEXT)
    run_here(monkeypatch, capsys)
    monkeypatch.chdir(tmp_path)

    assert len(found) >= 5
    for block in found:
        assert refresh.filled(block, str(tmp_path)) == block


@pytest.mark.soak
def test_charts_and_sheets_of_the_document_are_what_is_printed(tmp_path: Path) -> None:
    found = blocks(TEXT, slow=True)

    assert len(found) == 3
    for block in found:
        assert refresh.filled(block, str(tmp_path)) == block


def test_every_law_and_every_column_is_named() -> None:
    swept = kulman.sweep("madi-cam", positions=8)
    assert isinstance(swept, CamSweep)
    head = swept.csv("en").splitlines()[0].split(",")

    names = [column.partition(" ")[0] for column in head[1:]]
    assert [name for name in (*names, *LAWS) if f"`{name}`" not in TEXT] == []


def test_pictures_of_the_document_are_drawn_by_its_commands() -> None:
    drawn = {*refresh.SHEETS, *(f"chart-{name}" for name in refresh.CHARTS)}

    assert "cams" in refresh.NAMES
    for name in re.findall(r"pictures/([\w-]+)\.png", TEXT):
        assert name in drawn
        assert (DOCS / "pictures" / f"{name}.png").exists()


def test_the_lines_of_python_run() -> None:
    (block,) = re.findall(r"```python\n(.*?)```", TEXT, re.DOTALL)
    names: dict[str, Any] = {}

    exec(block, names)

    assert names["solution"].solved.roller.sizes.on == ("rise", "fall")
    assert len(names["swept"].csv("en").splitlines()) == 361
