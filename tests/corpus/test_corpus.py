"""The corpus: cases that are told apart, and outputs that come out alike again."""

from __future__ import annotations

from kulman.tests.corpus.corpus import Case, cases, digest, some


def test_cases_are_many_and_each_is_one_of_its_own() -> None:
    names = [case.name for case in cases()]

    assert len(names) == len({*names}) > 1400
    assert 50 < len(some("few")) < len(some("many")) < 250


def test_same_command_has_the_same_digest_and_another_one_another() -> None:
    first, again, other = (digest(Case(("solve", "madi-gear", "--lang", language))) for language in ("uk", "uk", "en"))

    assert first == again != other
