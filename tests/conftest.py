"""What the tests of the numbers share: random mechanisms, 500 by default and 10,000 with the marker `soak`."""

from __future__ import annotations

import gc
import os
from typing import Any

import pytest

from kulman.scales.errors import VARIABLE
from kulman.tests.support.mechanisms import SEED, Solved, general_slider_crank, random_slider_cranks, solved
from kulman.variants.commands.settings import PLACE

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
    gc.set_threshold(10_000, 10, 20)


@pytest.fixture(scope="session")
def stack(tmp_path_factory: pytest.TempPathFactory) -> Any:
    """A small stack of photographed sheets, see `tests/photos/stacks.py`."""
    from kulman.tests.photos.stacks import SMALL, stack_of

    return stack_of(tmp_path_factory.mktemp("stack"), SMALL)
