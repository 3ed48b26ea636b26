"""The documents cannot rot: their examples are the bundled task's own lines, and they name every key."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

from kulman.docs import refresh
from kulman.drawing.words import notations
from kulman.plans.cams.cam import FOLLOWERS, LAWS
from kulman.plans.cams.cam import PLANS as CAM_PLANS
from kulman.plans.gears.gear import MATERIALS
from kulman.plans.gears.gear import PLANS as GEAR_PLANS
from kulman.plans.hoist.hoist import PLANS as HOIST_PLANS
from kulman.plans.hoist.hoist import SIDES
from kulman.plans.linkages.chain import PLANS
from kulman.scales.errors import LANGUAGES
from kulman.scales.packaged import packaged
from kulman.tests.support.sources import trees
from kulman.variants import case, reader
from kulman.variants.checks import basics as checks
from kulman.variants.checks import mechanism as checks_mechanism
from kulman.variants.checks import names as checks_names
from kulman.variants.commands.helping import told
from kulman.variants.kinds import cam, gear, hoist
from kulman.variants.making.starter import _template
from kulman.variants.shelf import bundled_text
from kulman.variants.solution import solve

DOCS = Path(__file__).resolve().parents[2] / "docs"
DOCUMENTS = (*DOCS.rglob("*.md"), *refresh.GUIDES)
TASK_FILES = [path.read_text(encoding="utf-8") for path in refresh.GUIDES if path.name.startswith("task-file.")]
NOTATIONS = (DOCS / "notations.md").read_text(encoding="utf-8")
TASK = "nau-slider-crank"


EXAMPLES = sorted((DOCS / "examples").glob("*.toml"))


def example_texts() -> list[str]:
    """Return the task files from which the documents quote."""
    bundled = (TASK, "scheme-20-press-automaton", "madi-cam", "madi-gear", "karpenko-hoist")
    tasks = [*map(bundled_text, bundled), _template("en", "cam")]
    return [*tasks, *(path.read_text(encoding="utf-8") for path in EXAMPLES)]


def keys_read(text: str, monkeypatch: pytest.MonkeyPatch) -> set[str]:
    """Return every key that the reader asks for while it reads a task file, names of its own apart."""
    keys: set[str] = set()
    record = checks.record

    def noting(checker: Any, path: Any, raw: object, fields: Mapping[str, Any]) -> dict[str, Any]:
        keys.update(fields)
        return record(checker, path, raw, fields)

    modules: tuple[ModuleType, ...] = (reader, checks, checks_names, checks_mechanism, cam, case)
    for module in modules:
        monkeypatch.setattr(module, "record", noting)
    task, faults = reader.read_text(text, "t.toml")
    assert task is not None, faults
    words = {word for given in task.givens.values() for word in given.choices}
    return keys - task.givens.keys() - words


def test_every_key_of_a_task_file_is_explained(monkeypatch: pytest.MonkeyPatch) -> None:
    keys = {key for text in example_texts() for key in keys_read(text, monkeypatch)}

    assert {"id", "link", "points", "branch", "reconstructed", "uk", "travel", "back", "gravity", "curve"} <= keys
    for text in TASK_FILES:
        explained = set(re.findall(r"`(\w+)`", text)) | set(re.findall(r"^(\w+) = ", text, re.MULTILINE))
        assert keys - explained == set()


def test_every_example_of_a_task_file_stands_in_a_task() -> None:
    blocks = re.findall(r"```toml\n(.*?)```", TASK_FILES[0], re.DOTALL)

    assert len(blocks) > 10
    for block in blocks:
        assert any(block in text for text in example_texts()), block


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_every_example_is_solved(path: Path) -> None:
    solution = solve(path)

    assert solution.status == "ok"
    assert solution.checks
    assert all(check["ok"] for check in solution.checks.values())
    assert all(f"examples/{path.name})" in text for text in TASK_FILES)


@pytest.mark.parametrize("text", TASK_FILES, ids=lambda text: text.partition("\n")[0])
def test_the_words_that_a_task_file_may_use_are_named(text: str) -> None:
    assert all(f"`{name}`" in text for name in notations())
    assert all(f"`{name}`" in NOTATIONS for name in notations())
    plans = (*PLANS, *CAM_PLANS, *GEAR_PLANS, *HOIST_PLANS)
    assert all(f'"{word}"' in text for word in (*plans, *FOLLOWERS, *LAWS, *MATERIALS, *SIDES))
    assert all(f"`{name}`" in text for of in (cam, gear, hoist) for name in of.KIND.givens)


def test_every_key_of_a_notation_is_explained() -> None:
    keys = packaged("kulman.drawing", "notations", "nau").keys()

    assert [key for key in keys if not re.search(rf"`\[?{key}(\]|\.|`)", NOTATIONS)] == []


@pytest.mark.parametrize("language", LANGUAGES)
def test_help_names_every_notation(language: str) -> None:
    assert all(name in told("sheet", "--notation", language) for name in notations())


def test_links_of_the_documents_lead_somewhere() -> None:
    for path in DOCUMENTS:
        for target in re.findall(r"\]\(([^)#:]+)\)", path.read_text(encoding="utf-8")):
            assert (path.parent / target).exists(), (path.name, target)


def test_files_that_the_documents_name_exist() -> None:
    for path in DOCUMENTS:
        text = path.read_text(encoding="utf-8")
        for name in re.findall(r"`((?:scales|plans|drawing|variants|tests)/[\w/]+\.\w+)`", text):
            assert (DOCS.parent / name).exists(), (path.name, name)


def test_map_of_the_house_names_every_file_once_and_no_other() -> None:
    text, named = (DOCS / "house.md").read_text(encoding="utf-8"), []
    rooms = re.findall(r"^\*\*(?:`(\S+)/`|The root)\*\*(.*?)\n\n", text, re.DOTALL | re.MULTILINE)
    for folder, words in rooms:
        items = [re.split(r"\s–\s", item)[0] for item in words.partition(": ")[2].split(";")]
        named += [f"{folder}/{name}.py".lstrip("/") for item in items for name in re.findall(r"`(\w+)`", item)]
    files = {str(path) for path in trees() if path.name not in ("__init__.py", "__main__.py")} | {"__init__.py"}

    assert sorted(named) == sorted(files)
    for path in re.findall(r"`((?:scales|plans|drawing|variants|tests)/[\w./-]*)`", text):
        assert (DOCS.parent / path).exists(), path
