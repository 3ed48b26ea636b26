"""The help of every command in every language: nothing is missing, nothing is cut, whichever way it is asked for."""

from __future__ import annotations

import re
from collections.abc import Iterator

import click
import pytest

from kulman import cli
from kulman.scales.errors import LANGUAGES
from kulman.tests.support.commands import Run
from kulman.variants.commands.helping import _longest, texts, told

NAMES = ("", *cli.commands.commands)
CYRILLIC = re.compile("[а-яіїєґ]", re.IGNORECASE)
FOREIGN = {"uk": re.compile("[ыэъё]", re.IGNORECASE), "ru": re.compile("[іїєґ]", re.IGNORECASE)}


def keys(name: str) -> Iterator[str]:
    """What the help of a command says: what it does, its options."""
    command = cli.commands.commands[name] if name else cli.commands
    yield "about"
    for param in command.get_params(click.Context(command, help_option_names=["-h", "--help"])):
        if isinstance(param, click.Option):
            yield _longest(param)


def leaves(language: str) -> dict[tuple[str, str], str]:
    return {(table, key): text for table, rows in texts(language).items() for key, text in rows.items()}


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("name", NAMES)
def test_every_command_and_option_has_its_text(name: str, language: str) -> None:
    for key in keys(name):
        text = told(name or "kulman", key, language)

        assert text.endswith((".", "...")), key
        assert "{" not in text
        assert "  " not in text or key == "about"
        if language != "en":
            assert CYRILLIC.search(text)
            assert not FOREIGN[language].search(text)
            assert text != told(name or "kulman", key, "en")


def test_no_text_is_of_a_command_or_an_option_that_is_not_there() -> None:
    asked = {(name or "kulman", key) for name in NAMES for key in keys(name)}

    for language in LANGUAGES:
        given = leaves(language)
        assert [key for key in given if key[0] not in ("words", "places", "shared") and key not in asked] == []
        assert {key for table, key in given if table == "shared"} <= {key for _, key in asked}


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("name", NAMES)
def test_help_is_in_the_language_of_messages_however_it_is_asked_for(
    name: str, language: str, run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    words = name.split()
    status, shown, err = run("--lang", language, *words, "--help")
    after = ("--lang", language)
    ways = [(*words, "--help", *after), (*words, "-h", f"--lang={language}"), ("help", *words, *after)]
    heads = texts(language)["words"]

    assert (status, err) == (0, "")
    assert shown.startswith(f"{heads['usage']}: kulman {name}".rstrip())
    assert f"\n{heads['options']}:\n" in shown
    assert f"\n{heads['example']}:\n  kulman " in shown
    assert all(run(*way) == (0, shown, "") for way in ways)
    monkeypatch.setenv("KULMAN_LANG", language)
    assert run(*words, "--help") == (0, shown, "")
    if language != "en":
        left = re.sub(r"^  kulman .*|'[^']*'|`\w+`", "", shown, flags=re.MULTILINE)
        assert not re.search(r"\b(the|of|FILE|NAME|TEXT|OPTIONS|default)\b", left)


def test_help_is_in_the_language_of_the_system(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("LC_ALL", "uk_UA.UTF-8")

    assert run("solve", "--help")[1].startswith("Використання: kulman solve [ПАРАМЕТРИ] ЗАВДАННЯ\n")


@pytest.mark.parametrize("language", LANGUAGES)
def test_no_summary_of_a_command_is_cut(language: str, run: Run) -> None:
    shown = " ".join(run("--lang", language)[1].split())

    assert "..." not in shown.partition(f"{texts(language)['words']['commands']}:")[2]
    for name in NAMES[1:]:
        assert " ".join(told(name, "about", language).partition("\n\n")[0].split()) in shown


def test_help_of_no_command_is_refused_with_the_one_that_was_meant(run: Run) -> None:
    assert run("help", "sovle") == (2, "", "unknown command 'sovle'; did you mean solve?\n")
