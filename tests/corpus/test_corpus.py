"""The corpus: cases that are told apart, and outputs that come out alike again."""

from __future__ import annotations

import os

import pytest

from kulman.tests.corpus.corpus import MACHINE, Case, cases, digest, kept, machine, some

here = pytest.mark.skipif(kept()[MACHINE] != machine(), reason="library functions round otherwise here")


def test_cases_are_many_and_each_is_one_of_its_own() -> None:
    names = [case.name for case in cases()]

    assert len(names) == len({*names}) > 1400
    assert 50 < len(some("few")) < len(some("many")) < 250


def test_digest_does_not_hang_on_the_language_of_the_shell(monkeypatch: pytest.MonkeyPatch) -> None:
    case = Case(("list", "--check", "no.toml"))
    usual = digest(case)
    monkeypatch.setenv("KULMAN_LANG", "ru")

    assert digest(case) == usual
    assert os.environ["KULMAN_LANG"] == "ru"


def test_same_command_has_the_same_digest_and_another_one_another() -> None:
    first, again, other = (digest(Case(("solve", "madi-gear", "--lang", language))) for language in ("uk", "uk", "en"))

    assert first == again != other


@here
@pytest.mark.parametrize("case", some("few"), ids=lambda case: case.name)
def test_output_is_what_it_was(case: Case) -> None:
    assert digest(case) == kept()[case.name]


@here
@pytest.mark.soak
@pytest.mark.parametrize("case", some("many"), ids=lambda case: case.name)
def test_outputs_are_what_they_were(case: Case) -> None:
    assert digest(case) == kept()[case.name]


def test_every_case_is_kept() -> None:
    assert [*kept()] == [MACHINE, *(case.name for case in cases())]
