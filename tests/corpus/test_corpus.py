"""The corpus: outputs that come out alike again."""

from __future__ import annotations

import pytest

from kulman.tests.corpus.corpus import MACHINE, digest, kept, machine

CASES = [case for case in kept() if case != MACHINE]
COMMANDS = [case.split()[0] for case in CASES]
# every fourth case of a command, of charts the short ones; make corpus and the soak run all
FEW = {
    case
    for at, case in enumerate(CASES)
    if COMMANDS[:at].count(COMMANDS[at]) % 4 == 0 and not (COMMANDS[at] == "chart" and "--positions" in case)
}


@pytest.mark.skipif(kept()[MACHINE] != machine(), reason="library functions round otherwise here")
@pytest.mark.parametrize("case", [pytest.param(case, marks=() if case in FEW else pytest.mark.soak) for case in CASES])
def test_output_is_what_it_was(case: str) -> None:
    assert digest(case) == kept()[case]


def test_digest_is_that_of_the_case_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    usual, other = digest("solve madi-gear --lang uk"), digest("solve madi-gear --lang en")
    monkeypatch.setenv("KULMAN_LANG", "ru")

    assert len(CASES) == 60
    assert digest("solve madi-gear --lang uk") == usual != other
