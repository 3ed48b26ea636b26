"""The code of the package, parsed once for all tests that read it."""

from __future__ import annotations

import ast
import gc
from functools import cache
from pathlib import Path

import kulman

ROOT = Path(kulman.__file__).parent
OUTSIDE = ("tests", "benchmarks", "docs", ".venv", ".typing", ".ci", "build")


@cache
def trees() -> dict[Path, ast.Module]:
    """Return the files of the package by their paths from its root."""
    gc.disable()  # half a million nodes, none of them garbage
    try:
        return {path.relative_to(ROOT): ast.parse(path.read_text(encoding="utf-8")) for path in files()}
    finally:
        gc.freeze()
        gc.enable()


@cache
def imports() -> dict[Path, ast.Module]:
    """Return the statements by which the files import something, wherever in a file they stand."""
    found = dict[Path, ast.Module]()
    for path, tree in trees().items():
        found[path] = ast.Module([n for n in ast.walk(tree) if isinstance(n, ast.Import | ast.ImportFrom)], [])
    return found


def files() -> list[Path]:
    """Return the files of the package."""
    inside = [path for path in ROOT.iterdir() if path.name not in OUTSIDE]
    return sorted(file for path in inside for file in ([path] if path.suffix == ".py" else path.rglob("*.py")))
