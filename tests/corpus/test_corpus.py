"""The corpus: outputs that come out alike again."""

from __future__ import annotations

import pytest

from kulman.tests.corpus.corpus import MACHINE, digest, kept, machine

CASES = [case for case in kept() if case != MACHINE]


@pytest.mark.skipif(kept()[MACHINE] != machine(), reason="library functions round otherwise here")
@pytest.mark.parametrize("case", CASES)
def test_output_is_what_it_was(case: str) -> None:
    assert digest(case) == kept()[case]


def test_digest_is_that_of_the_case_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    usual, other = digest("solve madi-gear --lang uk"), digest("solve madi-gear --lang en")
    monkeypatch.setenv("KULMAN_LANG", "ru")

    assert len(CASES) == 60
    assert digest("solve madi-gear --lang uk") == usual != other
