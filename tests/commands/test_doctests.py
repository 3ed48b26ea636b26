"""Examples in docstrings run, and say what comes out."""

from __future__ import annotations

import doctest
from importlib import import_module

import pytest

from kulman.tests.support.sources import ROOT, files

WITH_EXAMPLES = sorted(
    ".".join(("kulman", *path.relative_to(ROOT).with_suffix("").parts)).removesuffix(".__init__")
    for path in files()
    if ">>> " in path.read_text(encoding="utf-8")
)


@pytest.mark.parametrize("module", WITH_EXAMPLES)
def test_examples_of_a_module_say_what_comes_out(module: str) -> None:
    found = doctest.testmod(import_module(module))

    assert found.attempted > 0
    assert found.failed == 0
