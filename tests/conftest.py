"""What the tests of the numbers share: random mechanisms, 500 by default and 10,000 with the marker `soak`."""

from __future__ import annotations

import gc
import hashlib
import os
import pickle
from collections.abc import Callable
from contextlib import suppress
from inspect import signature
from pathlib import Path
from shutil import rmtree
from tempfile import mkdtemp
from typing import Any

import pytest
from hypothesis import settings

from kulman import cli
from kulman.drawing.compose import Drawn
from kulman.scales.choices import SHEET
from kulman.scales.errors import VARIABLE
from kulman.scales.kept import Kept
from kulman.tests.support.commands import Run
from kulman.tests.support.mechanisms import SEED, Solved, general_slider_crank, random_slider_cranks, solved
from kulman.variants import sheets
from kulman.variants.case import Case, Request
from kulman.variants.commands.console import PLACE
from kulman.variants.marking.keyed import Keyed
from kulman.variants.photos import reading
from kulman.variants.photos.pictures import Photo
from kulman.variants.reader import load_task
from kulman.variants.shelf import bundled

settings.register_profile("kulman", deadline=None)  # no test is timed
settings.load_profile("kulman")
drawing_of, read_page, blank_of = sheets.drawing_of, reading._read, reading._blank_of
bundled_tasks, SHARED = frozenset(bundled()), "KULMAN_TESTS_SHARED"
drawings = Kept[Drawn](most=40)  # what has been drawn last
blanks, photographs = Kept[Any](most=8), Kept[Any](most=8)  # handouts, their pages that have been read, 12 MB each
PARTS = (
    *("variant", "settings", "plans", "scales", "notation", "language"),
    *("format", "norm", "lettering", "positions", "as_wanted"),
)


def of_bundled(request: Request) -> str:
    """Return the bundled task that is meant, nothing where it is another, or one that a test has changed."""
    task = request.task
    return task.id if task.id in bundled_tasks and task is load_task(task.id) else ""


def drawn_once(case: Case) -> Drawn:
    """Draw a sheet of a bundled task, unless it has just been drawn for another test."""
    task = of_bundled(case)
    if not task or case.readings != SHEET:  # what a note reads by ruler has scale factors that nobody has asked for
        return drawing_of(case)
    asked = repr([task, *(getattr(case, part) for part in PARTS)])
    return drawings.get(asked, lambda: of_all_workers(asked, lambda: drawing_of(case)))


def of_all_workers(asked: str, make: Callable[[], Any]) -> Any:
    """Return what this worker or another one has made: it lies in a folder as long as the tests run."""
    file = Path(os.environ[SHARED], hashlib.sha256(asked.encode()).hexdigest())
    with suppress(FileNotFoundError):
        return pickle.loads(file.read_bytes())
    made = make()
    (own := file.with_suffix(f".{os.getpid()}")).write_bytes(pickle.dumps(made))
    own.replace(file)
    return made


def blank_once(request: Request, keyed: Keyed, language: str, paper: str) -> Any:
    """Make the handout anew that was photographed, unless that has just been done."""
    task, case = of_bundled(request), keyed.solution.case
    if not task:
        return blank_of(request, keyed, language, paper)
    asked = repr([getattr(request, part, None) for part in PARTS]), repr((request.only, case.plans, case.settings))
    return blanks.get(
        (task, keyed.solution.variant, *asked, language, paper), lambda: blank_of(request, keyed, language, paper)
    )


def read_once(photo: Photo, blank: Any) -> Any:
    """Read a photographed page, unless it has just been read for another test, or of another student."""
    key = photo.picture, photo.number, photo.code, repr((photo.markers, photo.centre)), blank.codes, repr(blank.poles)
    return photographs.get(key, lambda: read_page(photo, blank))


def pytest_configure(config: pytest.Config) -> None:
    """Make the folder of all workers, who are started with its name in their environment."""
    if not hasattr(config, "workerinput"):
        os.environ[SHARED] = mkdtemp()


def pytest_unconfigure(config: pytest.Config) -> None:
    """Remove the folder of all workers."""
    if not hasattr(config, "workerinput"):
        rmtree(os.environ.pop(SHARED), ignore_errors=True)


def pytest_runtest_setup(item: pytest.Item) -> None:
    """Let tests that change parts of the program draw and read anew, and leave nothing to others."""
    changing = isinstance(item, pytest.Function) and "monkeypatch" in signature(item.function).parameters
    sheets.drawing_of = drawing_of if changing else drawn_once
    reading._read = read_page if changing else read_once
    reading._blank_of = blank_of if changing else blank_once


os.environ.pop(VARIABLE, None)  # tests choose the language of messages themselves, those in processes too
os.environ[PLACE] = ""  # and have no settings of whoever runs them


@pytest.fixture
def run(capsys: pytest.CaptureFixture[str]) -> Run:
    """Runs a command in this process: its status, standard output and standard error."""

    def running(*arguments: object) -> tuple[int, str, str]:
        with pytest.raises(SystemExit) as stopped:
            cli.main([*map(str, arguments)])
        return int(stopped.value.code or 0), *capsys.readouterr()

    return running


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

    return of_all_workers("stack", lambda: stack_of(tmp_path_factory.mktemp("stack"), SMALL))
