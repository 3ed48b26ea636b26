"""The document about hoists: what it shows is what the commands print today, its pictures exist."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import kulman
from kulman.docs import refresh
from kulman.tests.support.documents import blocks, run_here

DOCS = Path(kulman.__file__).parent / "docs"
TEXT = (DOCS / "hoist.md").read_text(encoding="utf-8")


def test_what_the_document_shows_is_what_is_printed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    run_here(monkeypatch, capsys)

    found = blocks(TEXT)

    assert len(found) == 1
    for block in found:
        assert refresh.filled(block, str(tmp_path)) == block


@pytest.mark.soak
def test_the_charts_of_the_document_are_as_it_shows(tmp_path: Path) -> None:
    found = blocks(TEXT, slow=True)

    assert len(found) == 4
    for block in found:
        assert refresh.filled(block, str(tmp_path)) == block


def test_pictures_of_the_document_are_drawn_by_its_commands() -> None:
    assert "hoist" in refresh.NAMES
    for name in re.findall(r"pictures/chart-([\w-]+)\.png", TEXT):
        assert name in refresh.CHARTS
        assert (DOCS / "pictures" / f"chart-{name}.png").exists()
