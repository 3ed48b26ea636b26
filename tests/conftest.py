"""What the tests of the numbers share: random mechanisms, 500 by default and 10,000 with the marker `soak`."""

from __future__ import annotations

import gc
import os
from inspect import signature
from typing import Any

import pytest

from kulman.drawing.compose import Drawn
from kulman.scales.choices import SHEET
from kulman.scales.errors import VARIABLE
from kulman.scales.kept import Kept
from kulman.tests.support.mechanisms import SEED, Solved, general_slider_crank, random_slider_cranks, solved
from kulman.variants import sheets
from kulman.variants.case import Case
from kulman.variants.commands.settings import PLACE
from kulman.variants.reader import load_task
from kulman.variants.shelf import bundled

drawing_of, bundled_tasks = sheets.drawing_of, frozenset(bundled())
drawings = Kept[Drawn](most=40)  # what has been drawn last
PARTS = (
    *("variant", "settings", "plans", "scales", "notation", "language"),
    *("format", "norm", "lettering", "positions", "as_wanted"),
)


def drawn_once(case: Case) -> Drawn:
    """Draw a sheet of a bundled task, unless it has just been drawn for another test."""
    named = case.task.id in bundled_tasks and case.task is load_task(case.task.id)
    if not named or case.readings != SHEET:  # what a note reads by ruler has scale factors that nobody has asked for
        return drawing_of(case)
    key = case.task.id, repr([getattr(case, part) for part in PARTS])
    return drawings.get(key, lambda: drawing_of(case))


def pytest_runtest_setup(item: pytest.Item) -> None:
    """Let tests that change parts of the program draw anew, and leave nothing to others."""
    changing = isinstance(item, pytest.Function) and "monkeypatch" in signature(item.function).parameters
    sheets.drawing_of = drawing_of if changing else drawn_once


os.environ.pop(VARIABLE, None)  # tests choose the language of messages themselves, those in processes too
os.environ[PLACE] = ""  # and have no settings of whoever runs them


@pytest.fixture(
    scope="session",
    params=[pytest.param(500, id="500"), pytest.param(10_000, id="10000", marks=pytest.mark.soak)],
)
def cranks(request: pytest.FixtureRequest) -> Solved:
    """Random slider-cranks: offset, oblique guide off the pivot, O off the origin, both branches, both senses."""
    return solved(general_slider_crank(), random_slider_cranks(SEED, request.param))


def pytest_collection_finish() -> None:
    """Spare the thousands of tests, which stay to the end, from every later search for garbage."""
    gc.collect()
    gc.freeze()
    gc.set_threshold(50_000, 20, 50)


@pytest.fixture(scope="session")
def stack(tmp_path_factory: pytest.TempPathFactory) -> Any:
    """A small stack of photographed sheets, see `tests/photos/stacks.py`."""
    from kulman.tests.photos.stacks import SMALL, stack_of

    return stack_of(tmp_path_factory.mktemp("stack"), SMALL)
