"""The words of a sheet: the same keys and the same {placeholders} in every language, and none that nothing uses."""

from __future__ import annotations

import ast
import string
from collections.abc import Iterator
from functools import cache
from importlib.resources import files
from typing import Any

import pytest

from kulman.drawing.words import Words, notations
from kulman.scales.errors import LANGUAGES, messages
from kulman.scales.packaged import packaged
from kulman.tests.support.sources import trees
from kulman.variants.kinds import KINDS
from kulman.variants.reader import load_task
from kulman.variants.shelf import bundled

PACKAGE = "kulman.drawing"


def tables(kind: str) -> dict[str, dict[str, str]]:
    """Return the texts of a kind ("" or "titleblock.") by language."""
    found = {language: packaged(PACKAGE, "texts", f"{kind}{language}") for language in LANGUAGES}
    return {language: table.get("titleblock", table) for language, table in found.items()}


def placeholders(template: str) -> list[str]:
    return sorted(name for _, name, _, _ in string.Formatter().parse(template) if name is not None)


@cache
def patterns() -> frozenset[str]:
    """Return the texts in the package's code; what an f-string fills in is a `*`."""
    return frozenset(_patterns())


def _patterns() -> Iterator[str]:
    for tree in trees().values():
        for node in ast.walk(tree):
            if isinstance(node, ast.JoinedStr):
                yield "".join(str(p.value) if isinstance(p, ast.Constant) else "*" for p in node.values)
            elif isinstance(node, ast.Constant) and isinstance(node.value, str):
                yield node.value


@cache
def words_of(stem: str) -> frozenset[str]:
    """Return what may stand in place of the `*` of `stem*`: names of the bundled tasks, or any text of the code."""
    if stem not in ("given.", "choice."):
        return patterns()
    givens = [given for task in bundled() for given in load_task(task).givens.values()]
    if stem == "given.":
        return frozenset(given.name for given in givens if given.choices)
    return frozenset(word for given in givens for word in given.choices)


def used(key: str) -> bool:
    """Whether the code names a text, whole or composed of a beginning and a word, or of the name of a subject, too."""
    if key in patterns() or any(key.replace(table, "*", 1) in patterns() for table in KINDS):
        return True
    cuts = [at for at in range(1, len(key)) if key[at - 1] in "._-"]
    stems = [(key[:at], key[at:]) for at in cuts]
    return any(
        word in words_of(stem)
        and not {f"{stem}*", *(f"{stem.replace(kind, '*')}*" for kind in KINDS)}.isdisjoint(patterns())
        for stem, word in stems
    )


@pytest.mark.parametrize("kind", ["", "titleblock."])
def test_every_language_has_the_same_texts_with_the_same_placeholders(kind: str) -> None:
    texts = tables(kind)

    assert texts["uk"].keys() == texts["ru"].keys() == texts["en"].keys()
    for key in texts["en"]:
        assert len({tuple(placeholders(texts[language][key])) for language in LANGUAGES}) == 1, key


@pytest.mark.parametrize("kind", ["cams.", "gears.", "hoist."])
def test_every_language_has_letters_for_the_same_quantities(kind: str) -> None:
    letters = tables(kind)

    assert letters["uk"].keys() == letters["ru"].keys() == letters["en"].keys()


@pytest.mark.parametrize("kind", ["", "titleblock."])
def test_every_text_is_used(kind: str) -> None:
    assert [key for key in tables(kind)["en"] if not used(key)] == []


def test_a_text_that_nothing_uses_is_noticed() -> None:
    assert not used("heading.nothing")
    assert not used("given.nothing")
    assert not used("choice.rotation")


def test_every_message_is_used() -> None:
    keys = {key.removesuffix("-like") for key in messages("en")}

    assert [key for key in sorted(keys) if not used(key)] == []


def test_every_choice_of_a_bundled_task_has_words() -> None:
    texts: dict[str, Any] = tables("")["en"]

    for task in map(load_task, bundled()):
        for given in task.givens.values():
            if given.choices:
                assert {f"given.{given.name}", *(f"choice.{word}" for word in given.choices)} <= texts.keys()


def test_every_notation_has_the_same_keys_and_every_task_names_one() -> None:
    tables_of = {name: packaged(PACKAGE, "notations", name) for name in notations()}
    first = next(iter(tables_of.values()))

    for table in tables_of.values():
        assert table.keys() == first.keys()
        assert table["letters"].keys() == first["letters"].keys()
        assert table["parts"].keys() == first["parts"].keys()
        assert table["symbols"].keys() == set(LANGUAGES)
        assert all(symbols.keys() == first["symbols"]["en"].keys() for symbols in table["symbols"].values())
    assert {load_task(task).notation for task in bundled()} <= tables_of.keys()


@pytest.mark.parametrize("language", LANGUAGES)
def test_words_can_be_looked_up_by_key(language: str) -> None:
    assert Words.of(language, "nau")["heading.velocity"] == tables("")[language]["heading.velocity"]


def test_every_table_of_words_is_read() -> None:
    names = {path.name for path in files(PACKAGE).joinpath("texts").iterdir()}

    assert names == {
        f"{kind}{language}.toml" for kind in ("", "titleblock.", "cams.", "gears.", "hoist.") for language in LANGUAGES
    }
