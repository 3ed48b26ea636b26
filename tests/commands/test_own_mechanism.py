"""docs/own-mechanism.md cannot rot: its commands print what it shows, its blocks stand in files that are solved."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from kulman.docs import refresh
from kulman.tests.support.documents import run_here
from kulman.variants.making.starter import template
from kulman.variants.reader import read_text
from kulman.variants.shelf import bundled_text

ROOT = Path(__file__).resolve().parents[2]
TEXT = (ROOT / "docs" / "own-mechanism.md").read_text(encoding="utf-8")
FIRST, OTHERS = TEXT.split("# Other parts\n")
TOML = re.compile(r"```toml\n(.*?)```", re.DOTALL)
SECTIONS = re.split(r"^## ", OTHERS, flags=re.MULTILINE)[1:]


def test_commands_print_what_the_document_shows(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    run_here(monkeypatch, capsys)

    assert refresh.refreshed(TEXT, str(tmp_path)) == TEXT


def test_steps_quote_the_file_to_begin_with_in_its_order() -> None:
    blocks = TOML.findall(FIRST)
    text = template("en")

    assert len(blocks) >= 9
    assert all(block in text for block in blocks)
    parts = {line for block in blocks for line in block.splitlines() if line.startswith("[")}
    assert parts >= {"[givens]", "[[mechanism.link]]", "[[mechanism.pair]]", "[mechanism.driver]", "[[variant]]"}


@pytest.mark.parametrize("section", SECTIONS, ids=lambda section: section.split("\n")[0])
def test_lines_of_other_parts_stand_in_the_task_that_the_section_names(section: str) -> None:
    tasks = re.findall(r"tasks/([\w-]+)\.toml\)", section)

    assert TOML.findall(section)
    assert tasks
    for block in TOML.findall(section):
        # the task that is named last before the block
        named = re.findall(r"tasks/([\w-]+)\.toml\)", section[: section.index(block)])
        assert block in bundled_text(named[-1]), block


def test_fault_that_the_document_shows_is_the_one_of_the_program() -> None:
    (shown,) = re.findall(r"```text\n(my-mechanism.*?)\n```", FIRST)
    pivot = '[[mechanism.pair]]\nkind = "revolute"\npoint = "C"\nlinks = [3, 0]\nat = ["280 mm", "0 mm"]\n'
    assert pivot in template("en")

    _, faults = read_text(template("en").replace(pivot, ""), "my-mechanism.toml")

    assert [str(fault) for fault in faults] == [shown]


def test_document_is_linked_from_where_a_newcomer_looks() -> None:
    assert "docs/own-mechanism.md" in (ROOT / "README.md").read_text(encoding="utf-8")
    assert "own-mechanism.md" in (ROOT / "docs" / "task-file.md").read_text(encoding="utf-8")
