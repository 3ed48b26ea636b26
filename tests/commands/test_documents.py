"""The documents show what commands print today; those about cams, gears, hoists the pictures that these draw."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import kulman
from kulman.docs import refresh
from kulman.tests.support.documents import blocks, run_here

DOCS = Path(kulman.__file__).parent / "docs"
BLOCKS = {"cams": (8, 3), "gears": (4, 2), "hoist": (1, 4)}  # of commands, quick and slow ones


def text(name: str) -> str:
    return (DOCS / f"{name}.md").read_text(encoding="utf-8")


@pytest.mark.parametrize("name", BLOCKS)
def test_what_a_document_shows_is_what_is_printed(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    run_here(monkeypatch, capsys)
    quick, slow = (blocks(text(name), slow=slow) for slow in (False, True))

    assert (len(quick), len(slow)) == BLOCKS[name]
    for block in quick:
        assert refresh.filled(block, str(tmp_path)) == block


@pytest.mark.soak
@pytest.mark.parametrize("document", refresh.DOCUMENTS, ids=lambda path: path.stem)
def test_every_command_started_by_itself_prints_what_its_document_shows(document: Path, tmp_path: Path) -> None:
    shown = document.read_text(encoding="utf-8")

    assert refresh.BLOCK.search(shown)
    assert refresh.refreshed(shown, str(tmp_path)) == shown


@pytest.mark.parametrize("name", BLOCKS)
def test_pictures_of_a_document_are_drawn_by_its_commands(name: str) -> None:
    drawn = {*refresh.SHEETS, *(f"chart-{chart}" for chart in refresh.CHARTS)}
    shown = re.findall(r"pictures/([\w-]+)\.png", text(name))

    assert name in refresh.NAMES
    assert shown
    for picture in shown:
        assert picture in drawn
        assert (DOCS / "pictures" / f"{picture}.png").exists()
