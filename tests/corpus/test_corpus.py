"""The corpus: outputs that come out alike again."""

from __future__ import annotations

import pytest

from kulman.tests.corpus.corpus import MACHINE, digest, kept, machine

CASES = [case for case in kept() if case != MACHINE]
COMMANDS = [case.split()[0] for case in CASES]
# which of a command's cases, quick ones: one of six of those that draw, one of four of the others; the soak runs all
DRAWS = {"batch": 1, "chart": 2, "handout": 5, "note": 1, "sheet": 1, "sweep": 0}
COUNTED = [(COMMANDS[at], COMMANDS[:at].count(COMMANDS[at]), case) for at, case in enumerate(CASES)]
FEW = {case for name, n, case in COUNTED if (n % 6 == DRAWS[name] if name in DRAWS else n % 4 == 0)}


@pytest.mark.skipif(kept()[MACHINE] != machine(), reason="library functions round otherwise here")
@pytest.mark.parametrize("case", [pytest.param(case, marks=() if case in FEW else pytest.mark.soak) for case in CASES])
def test_output_is_what_it_was(case: str) -> None:
    assert digest(case) == kept()[case]


def test_digest_is_that_of_the_case_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    usual, other = digest("solve madi-gear --lang uk"), digest("solve madi-gear --lang en")
    monkeypatch.setenv("KULMAN_LANG", "ru")

    assert len(CASES) == 60
    assert digest("solve madi-gear --lang uk") == usual != other
