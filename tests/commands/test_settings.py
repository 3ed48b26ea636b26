"""The settings of a user: usual values of options, which options and `KULMAN_LANG` come before."""

from __future__ import annotations

import re
import sys
from pathlib import Path

import pytest

from kulman import cli
from kulman.scales.errors import LANGUAGES
from kulman.tests.support.commands import Run
from kulman.variants.commands.console import PARAMETERS, PLACE, _settings_file
from kulman.variants.commands.guides import guide

TASK = "nau-slider-crank"


@pytest.fixture
def file(folder: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The file of settings, where it is by itself."""
    monkeypatch.delenv(PLACE)
    monkeypatch.setenv("APPDATA" if sys.platform == "win32" else "XDG_CONFIG_HOME", str(folder))
    return folder / "kulman.toml"


def test_settings_are_the_usual_values_of_options(file: Path, run: Run) -> None:
    run("sheet", TASK, "-o", "plain.svg")
    said = ("--student", "О. Бойко", "--group", "АТ-301", "--work", "КП", "--norm", "iso", "--notation", "bauman")
    run("sheet", TASK, *said, "--lang", "ru", "-o", "said.svg")
    file.write_text(
        '\ufeffname = "О. Бойко"\ngroup = "АТ-301"\nwork = "КП"\nnorm = "ISO"\nnotation = "bauman"\nlanguage = "ru"\n',
        encoding="utf-8",
    )

    status, _, _ = run("sheet", TASK, "-o", "settled.svg")
    over = ("--student", "І. Шевчук", "--lang", "uk", "--norm", "gost")
    run("sheet", TASK, *over, "-o", "over.svg")

    text = Path("settled.svg").read_text(encoding="utf-8")
    assert status == 0
    assert text == Path("said.svg").read_text(encoding="utf-8") != Path("plain.svg").read_text(encoding="utf-8")
    assert "Бойко" not in Path("over.svg").read_text(encoding="utf-8")


def test_language_of_the_settings_is_that_of_messages_after_the_environment(
    file: Path, run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    file.write_text('language = "uk"\nteacher = "О. Коваль"', encoding="utf-8")

    assert run("solve", "xyzzy")[2].startswith("немає ні завдання")
    assert run("solve", TASK, "-v", "3", "--only", "velocity")[1].find("м/с") > 0
    assert run("solve", "xyzzy", "--lang", "ru")[2].startswith("нет ни задания")
    assert "[типово: О. Коваль]" in run("sheet", "--help")[1]
    monkeypatch.setenv("KULMAN_LANG", "ru")
    assert run("solve", "xyzzy")[2].startswith("нет ни задания")


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (b'\n\nteachr = "x"', ":3:1: teachr: unknown key 'teachr'; did you mean 'teacher'?"),
        (b'colour = "x"', ":1:1: colour: unknown key 'colour'; expected one of: name, group"),
        (b"group = 3", ":1:1: group: a text in quotes was expected"),
        (b'language = "de"', ":1:1: language: 'de' is not a choice; expected one of: uk, ru, en"),
        (b'notation = "klingon"', ":1:1: notation: 'klingon' is not a choice; expected one of: artobolevsky"),
        (
            'language = "u\u043a"'.encode(),
            ":1:1: language: 'u\u043a': character 2 is a Cyrillic letter; type the Latin k",
        ),
        (b'nam = "x"\ngroup = 3', ":1:1: nam: unknown key 'nam'; did you mean 'name'?; "),
        (b'nam = "x"\ngroup = 3', "kulman.toml:2:1: group: a text"),
        (b'name = "x', ':1:10: not valid TOML at \'name = "x\': the quotation marks are not closed: name = "x"'),
        ("name = О. Бойко".encode(), ":1:8: not valid TOML at 'name = О. Бойко': a text, a value with a unit"),
        ("name = О. Бойко".encode(), 'stands in straight quotes: name = "О. Бойко"'),
        ("name = «О. Бойко»".encode(), '« is a typographic quotation mark; type straight ones: name = "О. Бойко"'),
        (b'name = "\xcf"', ": not text in UTF-8"),
    ],
)
def test_a_bad_file_is_one_line_that_names_file_line_key_and_cure(text: bytes, said: str, file: Path, run: Run) -> None:
    file.write_bytes(text)

    status, out, err = run("list")

    assert (status, out, err.count("\n")) == (2, "", 1)
    assert said in err
    assert "kulman.toml:" in err


def test_a_folder_is_no_file_of_settings(file: Path, run: Run) -> None:
    file.mkdir()

    assert run("list")[0] == 2


def test_the_environment_names_another_file_or_none(file: Path, monkeypatch: pytest.MonkeyPatch, run: Run) -> None:
    assert _settings_file() == file
    monkeypatch.setenv(PLACE, "other.toml")
    assert _settings_file() == Path("other.toml")
    assert run("list") == (2, "", "KULMAN_CONFIG: other.toml: there is no such file\n")
    monkeypatch.setenv(PLACE, "")
    assert _settings_file() is None


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_key_is_documented_and_is_an_option(language: str) -> None:
    text = guide("settings", language)
    params = {param.name for command in cli.commands.commands.values() for param in command.params}

    assert set(re.findall(r"^(\w+) = ", text, re.MULTILINE)) == PARAMETERS.keys()
    assert set(PARAMETERS.values()) <= params
