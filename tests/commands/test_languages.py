"""Ukrainian, Russian, English: nothing is missing in one of them, no placeholder, no command, no name differs."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from kulman.cli import commands
from kulman.scales.errors import LANGUAGES, KulmanError
from kulman.tests.support.sources import ROOT
from kulman.variants.shelf import bundled, bundled_text

FOLDERS = [ROOT / name for name in ("scales", "drawing", "variants")]
WORDS = sorted(file for folder in FOLDERS for file in folder.rglob("*uk.toml") if file.parent.name != "templates")
TEMPLATES = sorted((ROOT / "variants" / "templates").glob("*.uk.toml"))
# what stands in a text that no language changes: placeholders, commands, options, suffixes, names of quantities
HANDED = ("drawing", "variants/serving")
COMMAND = rf"\bkulman (?:{'|'.join(commands.commands)})\b"
KEPT = re.compile(rf"(?<![_^])\{{\w+|`[^`]*`|{COMMAND}|--[a-z]+|(?<=[ ,(])\.[a-z]{{2,5}}\b|\b[a-z]+_[A-Z]\w*")
FOREIGN = {"uk": re.compile("[ыэъё]", re.IGNORECASE), "ru": re.compile("[іїєґ]", re.IGNORECASE)}
ABBREVIATION = re.compile(r"\b[А-Я]{2,3}\b")  # of title blocks
CYRILLIC = re.compile("[а-яіїєґё]", re.IGNORECASE)


def leaves(table: dict[str, Any], path: str = "") -> Iterator[tuple[str, str]]:
    """Go through the texts of a table, of tables in it, too."""
    for key, value in table.items():
        if isinstance(value, dict):
            yield from leaves(value, f"{path}{key}.")
        elif isinstance(value, list):
            yield from ((f"{path}{key}.{n}", str(one)) for n, one in enumerate(value))
        else:
            yield f"{path}{key}", str(value)


def beside(file: Path) -> dict[str, Path]:
    return {language: file.with_name(file.name.replace("uk.toml", f"{language}.toml")) for language in LANGUAGES}


def kept(text: str) -> list[str]:
    return sorted(KEPT.findall(text))


@pytest.mark.parametrize("file", WORDS, ids=lambda file: str(file.relative_to(ROOT)))
def test_every_text_is_in_every_language_with_what_none_of_them_changes(file: Path) -> None:
    texts = {language: dict(leaves(tomllib.loads(path.read_text("utf-8")))) for language, path in beside(file).items()}
    english = texts["en"]

    for language in ("uk", "ru"):
        given = texts[language]
        assert given.keys() == english.keys()
        assert [key for key in given if kept(given[key]) != kept(english[key])] == [], language
        assert [key for key in given if FOREIGN[language].search(given[key]) and "ГОСТ" not in given[key]] == []
        same = [
            key for key in given if given[key] == english[key] and re.search(r"\b[a-z]{4,}\b", KEPT.sub("", given[key]))
        ]
        assert same == []
    assert [key for key in english if CYRILLIC.search(ABBREVIATION.sub("", english[key]))] == []


@pytest.mark.parametrize("file", TEMPLATES, ids=lambda file: file.stem)
def test_a_file_to_begin_with_is_the_same_task_whatever_its_comments_say(file: Path) -> None:
    written = {language: path.read_text("utf-8") for language, path in beside(file).items()}
    tasks = {language: dict(leaves(tomllib.loads(text))) for language, text in written.items()}

    for language in ("uk", "ru"):
        changed = {key for key, value in tasks[language].items() if tasks["en"].get(key) != value}
        assert tasks[language].keys() == tasks["en"].keys()
        assert {key.partition(".")[0] for key in changed} <= {"source", "title"}
        assert re.findall(COMMAND, written[language]) == re.findall(COMMAND, written["en"])
        assert not FOREIGN[language].search(re.sub("^(uk|ru) = .*", "", written[language], flags=re.MULTILINE))


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_hand_and_a_guess_are_called_by_one_word_in_a_language(language: str) -> None:
    rooms = [tomllib.loads((ROOT / room / f"texts/{language}.toml").read_text("utf-8")) for room in HANDED]
    guide = (ROOT / f"variants/guides/marking.{language}.md").read_text("utf-8")
    for hand in ("careful", "normal", "lenient"):
        told = re.findall(rf"^\| `{hand}`, (\w+)", guide, re.MULTILINE) if language != "en" else []
        assert len({word[:5] for word in (*told, *(room[f"hand.{hand}"] for room in rooms))}) == 1, hand
    written = (ROOT / f"scales/messages/{language}.toml").read_text("utf-8")
    guesses = re.findall(r"; ([\w ]+), «?\{like", written)
    assert len({*guesses}) == (language != "en")


@pytest.mark.parametrize("task", bundled())
def test_a_bundled_task_says_what_it_is_in_every_language(task: str) -> None:
    raw = tomllib.loads(bundled_text(task))

    head = bundled_text(task).partition("\nid = ")[0]
    about = dict(re.findall(r"^# (\w\w): ((?:.+(?:\n#     )?)+)$", head, re.MULTILINE))
    assert [line for line in bundled_text(task).splitlines() if "#" in line] == head.splitlines()

    for said in filter(None, (raw["title"], raw.get("note"), about)):
        assert said.keys() == {*LANGUAGES}
        assert len({*said.values()}) == len(LANGUAGES)
        assert not any(FOREIGN[language].search(said[language]) for language in FOREIGN)


@pytest.mark.parametrize(("number", "said"), [("-1.7201e+08", "−1,7201·10⁸"), ("2e-05", "2·10⁻⁵"), ("-67.9", "−67,9")])
def test_numbers_of_messages_are_written_as_by_hand(number: str, said: str) -> None:
    error = KulmanError("hoist-rule-strength", value=number, limit=5.0)

    assert f" {said}," in error.text("uk")
    assert f" {said.replace(',', '.')}," in error.text("en")
