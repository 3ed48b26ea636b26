"""The documents cannot rot: their examples are the bundled task's own lines, and they name every key."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

from kulman.drawing.words import notations
from kulman.plans.linkages.chain import PLANS
from kulman.variants import checks, checks_givens, checks_mechanism, reader
from kulman.variants.shelf import bundled_text

DOCS = Path(__file__).resolve().parent.parent / "docs"
TASK_FILE = (DOCS / "task-file.md").read_text(encoding="utf-8")
TASK = "nau-slider-crank"


def keys_read(monkeypatch: pytest.MonkeyPatch) -> set[str]:
    """Return every key that the reader asks for while it reads the bundled task, names of its own apart."""
    keys: set[str] = set()

    def noting(checker: Any, path: Any, raw: object, fields: Mapping[str, Any]) -> dict[str, Any]:
        keys.update(fields)
        return checks.record(checker, path, raw, fields)

    modules: tuple[ModuleType, ...] = (reader, checks_givens, checks_mechanism)
    for module in modules:
        monkeypatch.setattr(module, "record", noting)
    task, faults = reader.read_text(bundled_text(TASK), "t.toml")
    assert task is not None, faults
    words = {word for given in task.givens.values() for word in given.choices}
    return keys - task.givens.keys() - words


def test_every_key_of_a_task_file_is_explained(monkeypatch: pytest.MonkeyPatch) -> None:
    keys = keys_read(monkeypatch)

    assert {"id", "link", "points", "branch", "reconstructed", "uk"} <= keys
    explained = set(re.findall(r"`(\w+)`", TASK_FILE)) | set(re.findall(r"^(\w+) = ", TASK_FILE, re.MULTILINE))
    assert keys <= explained


def test_every_example_of_a_task_file_stands_in_the_bundled_task() -> None:
    blocks = re.findall(r"```toml\n(.*?)```", TASK_FILE, re.DOTALL)

    assert len(blocks) > 10
    for block in blocks:
        assert block in bundled_text(TASK)


def test_the_words_that_a_task_file_may_use_are_named() -> None:
    assert all(f"`{name}`" in TASK_FILE for name in notations())
    assert all(f'"{plan}"' in TASK_FILE for plan in PLANS)


def test_links_of_the_documents_lead_somewhere() -> None:
    for path in DOCS.rglob("*.md"):
        for target in re.findall(r"\]\(([^)#:]+)\)", path.read_text(encoding="utf-8")):
            assert (path.parent / target).exists(), (path.name, target)


def test_files_that_the_documents_name_exist() -> None:
    for path in DOCS.rglob("*.md"):
        text = path.read_text(encoding="utf-8")
        for name in re.findall(r"`((?:scales|plans|drawing|variants|tests)/[\w/]+\.\w+)`", text):
            assert (DOCS.parent / name).exists(), (path.name, name)
