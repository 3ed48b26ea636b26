"""The code of the package, parsed once for all tests that read it."""

from __future__ import annotations

import ast
from functools import cache
from pathlib import Path

import kulman

ROOT = Path(kulman.__file__).parent
OUTSIDE = ("tests", "benchmarks", "docs", ".venv", ".typing", ".ci", "build")


@cache
def trees() -> dict[Path, ast.Module]:
    """Return the files of the package by their paths from its root."""
    paths = [path.relative_to(ROOT) for path in sorted(ROOT.rglob("*.py"))]
    return {
        path: ast.parse((ROOT / path).read_text(encoding="utf-8")) for path in paths if path.parts[0] not in OUTSIDE
    }
