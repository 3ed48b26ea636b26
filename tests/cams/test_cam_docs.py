"""The document about cams: what it shows is what the commands print today, its pictures and columns exist."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import kulman
from kulman.plans.cams.cam import LAWS
from kulman.variants.sweeps.swept import CourseSweep

DOCS = Path(kulman.__file__).parent / "docs"
TEXT = (DOCS / "cams.md").read_text(encoding="utf-8")


def test_every_law_and_every_column_is_named() -> None:
    swept = kulman.sweep("madi-cam", positions=8)
    assert isinstance(swept, CourseSweep)
    head = swept.csv("en").splitlines()[0].split(",")

    names = [column.partition(" ")[0] for column in head[1:]]
    assert [name for name in (*names, *LAWS) if f"`{name}`" not in TEXT] == []


def test_the_lines_of_python_run() -> None:
    (block,) = re.findall(r"```python\n(.*?)```", TEXT, re.DOTALL)
    names: dict[str, Any] = {}

    exec(block, names)

    assert names["solution"].solved.roller.sizes.on == ("rise", "fall")
    assert len(names["swept"].csv("en").splitlines()) == 361
