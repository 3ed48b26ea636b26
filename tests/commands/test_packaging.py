"""What is installed: every module, and every file of words, tasks and looks beside them."""

from __future__ import annotations

import tomllib
from pathlib import Path

from kulman.tests.support.sources import ROOT, files

SETUPTOOLS = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["setuptools"]


def package(folder: Path) -> str:
    return ".".join(("kulman", *folder.relative_to(ROOT).parts))


def test_every_folder_with_modules_is_a_package_that_is_installed() -> None:
    assert set(SETUPTOOLS["packages"]) == {package(file.parent) for file in files()}


def test_every_file_beside_the_modules_is_installed() -> None:
    folders = {file.relative_to(ROOT).parts[0] for file in files() if file.parent != ROOT}
    inside = (file for name in folders for file in (ROOT / name).rglob("*") if file.is_file())
    beside = {file for file in inside if file.suffix != ".py" and "__pycache__" not in file.parts}
    installed = {
        file
        for name, patterns in SETUPTOOLS["package-data"].items()
        for pattern in patterns
        for file in ROOT.joinpath(*name.split(".")[1:]).glob(pattern)
    }

    assert beside
    assert beside - installed == set()
