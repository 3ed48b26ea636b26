"""The document about gears: what it shows is what the commands print today, its names exist."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import kulman

DOCS = Path(kulman.__file__).parent / "docs"
TEXT = (DOCS / "gears.md").read_text(encoding="utf-8")


def test_every_quantity_every_check_and_every_column_is_named() -> None:
    solution, swept = kulman.solve("madi-gear"), kulman.sweep("madi-gear")
    names = [name for name in solution.quantities if not re.match(r"(y|theta)_.*\d\d$|mu_|PW$", name)]
    of_pinion = {name: re.sub(r"(?<=[A-Za-z_])2(?=_|$)", "1", name) for name in names}  # of the wheel alike
    columns = [column.partition(" ")[0] for column in swept.csv("en").splitlines()[0].split(",")[1:]]
    checks = {re.sub(r"2$", "1", name) for name in solution.checks if not name.startswith("centre")}

    prose = re.sub(r"```.*?```", "", TEXT, flags=re.DOTALL)
    named = {found for quoted in re.findall(r"`([^`]+)`", prose) for found in quoted.split()}
    assert [name for name in names if not named & {name, of_pinion[name]}] == []
    assert [name for name in (*columns, *checks) if name not in named] == []


def test_the_lines_of_python_run() -> None:
    (block,) = re.findall(r"```python\n(.*?)```", TEXT, re.DOTALL)
    names: dict[str, Any] = {}

    exec(block, names)

    assert names["solution"]["z_W1"].value == 2.0
    assert len(names["pinion"]) > 1000
