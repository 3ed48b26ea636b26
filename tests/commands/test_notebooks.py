"""What Python and its notebooks are told: notebooks run as they stand, the page names all that there is."""

from __future__ import annotations

import ast
import json
import re
from pathlib import Path
from typing import Any

import pytest

import kulman
from kulman.tests.support.cases import some
from kulman.variants.commands.guides import guide

DOCS = Path(__file__).resolve().parents[2] / "docs"
NOTEBOOKS = sorted((DOCS / "notebooks").glob("*.ipynb"))
SHOWN = ("_repr_html_", "_repr_svg_", "_repr_markdown_")


def shown(cells: list[str]) -> list[Any]:
    """Run cells one after the other, as a notebook does; return what each shows at its end."""
    names: dict[str, Any] = {"__name__": "__main__"}
    found = []
    for cell in cells:
        tree, value = ast.parse(cell), None
        last = tree.body.pop() if isinstance(tree.body[-1], ast.Expr) else None
        exec(compile(tree, "cell", "exec"), names)
        if isinstance(last, ast.Expr):
            value = eval(compile(ast.Expression(last.value), "cell", "eval"), names)
        found.append(value)
    return found


@pytest.mark.parametrize("path", some(NOTEBOOKS, 0), ids=lambda path: path.stem)
def test_a_notebook_runs_and_shows_what_its_cells_end_with(path: Path, folder: Path) -> None:
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]

    assert not any(cell.get("outputs") for cell in cells)
    values = shown(["".join(cell["source"]) for cell in cells if cell["cell_type"] == "code"])
    results = [value for value in values if value is not None]
    assert len(results) > 2
    for value in results:
        [text] = {getattr(value, name)() for name in SHOWN if hasattr(value, name)}
        assert "<table" in text or "data:image/svg+xml;base64," in text
        assert len(repr(value)) < 100, value
    assert len([*folder.iterdir()]) >= 3


def test_the_page_names_all_that_is_exported() -> None:
    page = guide("python", "en")

    assert [name for name in kulman.__all__ if not re.search(rf"`(kulman\.)?{name}\b", page)] == []
    assert all(getattr(kulman, name) is not None for name in kulman.__all__)
