"""The document about cams: what it shows is what the commands print today, its pictures and columns exist."""

from __future__ import annotations

import importlib.util
import re
import shlex
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

import kulman
from kulman import cli
from kulman.plans.cams.cam import LAWS
from kulman.variants.sweeps.cam import CamSweep

DOCS = Path(kulman.__file__).parent / "docs"
TEXT = (DOCS / "cams.md").read_text(encoding="utf-8")
SLOW = ("chart", "sheet")  # commands


def refresh() -> ModuleType:
    spec = importlib.util.spec_from_file_location("refresh", DOCS / "refresh.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def blocks(slow: bool) -> list[str]:
    found = refresh().BLOCK.findall(TEXT)
    return [block for block in found if block.startswith(tuple(f"$ kulman {name}" for name in SLOW)) == slow]


def test_what_the_document_shows_is_what_is_printed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    module, found = refresh(), blocks(slow=False)
    monkeypatch.setenv("LC_ALL", "en_GB.UTF-8")
    monkeypatch.chdir(tmp_path)

    def here(command: str, folder: str) -> tuple[str, int]:
        """Run a command without starting Python again."""
        with pytest.raises(SystemExit) as stopped:
            cli.main(shlex.split(command)[1:])
        return "".join(capsys.readouterr()), int(stopped.value.code or 0)

    monkeypatch.setattr(module, "run", here)

    assert len(found) >= 5
    for block in found:
        assert module.filled(block, str(tmp_path)) == block


@pytest.mark.soak
def test_charts_and_sheets_of_the_document_are_what_is_printed(tmp_path: Path) -> None:
    found = blocks(slow=True)

    assert len(found) == 3
    for block in found:
        assert refresh().filled(block, str(tmp_path)) == block


def test_every_law_and_every_column_is_named() -> None:
    swept = kulman.sweep("madi-cam", positions=8)
    assert isinstance(swept, CamSweep)
    head = swept.csv("en").splitlines()[0].split(",")

    names = [column.partition(" ")[0] for column in head[1:]]
    assert [name for name in (*names, *LAWS) if f"`{name}`" not in TEXT] == []


def test_pictures_of_the_document_are_drawn_by_its_commands() -> None:
    module = refresh()
    drawn = {*module.SHEETS, *(f"chart-{name}" for name in module.CHARTS)}

    assert "cams" in module.NAMES
    for name in re.findall(r"pictures/([\w-]+)\.png", TEXT):
        assert name in drawn
        assert (DOCS / "pictures" / f"{name}.png").exists()


def test_the_lines_of_python_run() -> None:
    (block,) = re.findall(r"```python\n(.*?)```", TEXT, re.DOTALL)
    names: dict[str, Any] = {}

    exec(block, names)

    assert names["solution"].solved.roller.sizes.on == ("rise", "fall")
    assert len(names["swept"].csv("en").splitlines()) == 361
