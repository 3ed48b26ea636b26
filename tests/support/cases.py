"""Cases as tests want them: solved, and drawn in a language."""

from __future__ import annotations

import os
from collections.abc import Iterable
from dataclasses import replace

from kulman.variants.case import Case, Request, Settings
from kulman.variants.reader import load_task
from kulman.variants.sheets import Sheet
from kulman.variants.sheets import draw_case as drawn
from kulman.variants.task import Task


def solve_case(
    task: str | os.PathLike[str] | Task,
    variant: str | None = None,
    settings: Settings | None = None,
    only: str | Iterable[str] | None = None,
    scales: Settings | None = None,
) -> Case:
    return Request(load_task(task), variant, settings, only, scales).case()


def draw_case(case: Case, lang: str) -> Sheet:
    return drawn(replace(case, language=lang))
