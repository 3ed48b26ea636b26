"""The guides, shown by `kulman guide`, and the README: the same in every language."""

from __future__ import annotations

import re
import shlex
import sys
from pathlib import Path

import click
import pytest

from kulman.cli import commands
from kulman.docs import refresh
from kulman.scales.errors import LANGUAGES
from kulman.scales.packaged import home
from kulman.tests.support.commands import Run
from kulman.variants.commands import guides
from kulman.variants.shelf import GUIDES

FENCE = re.compile(r"^```(\w*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
TYPED = re.compile(r"\s*(kulman|py|python3?|source|uv|echo|_KULMAN\w*) ")  # lines of blocks that a user types
SPOKEN = re.compile(r'(?<= )(--lang |lang=")\w+|(?<=^language = ")\w+')
TRANSLATED = [path for path in refresh.DOCUMENTS if refresh.language(path) != "en"]


def skeleton(path: Path) -> list[object]:
    """Return what no language changes: levels of headings, commands, links, lines of task files without words."""
    text = path.read_text(encoding="utf-8")
    parts: list[object] = [re.findall(r"^#+(?= )", FENCE.sub("", text), re.MULTILINE)]
    for kind, block in FENCE.findall(text):
        if kind == "console":
            parts.append([SPOKEN.sub("", command).strip() for command in refresh.commands(block)])
        elif kind in ("toml", "python"):
            parts.append([SPOKEN.sub("", line.partition("#")[0].rstrip()) for line in block.splitlines()])
        else:
            parts.append(
                [kind, *(line.partition("  #")[0].strip() for line in block.splitlines() if TYPED.match(line))]
            )
    parts.append(re.findall(r"^    (\w+ .+?)(?=  #|$)", text, re.MULTILINE))
    parts += [re.sub(r"\.(uk|ru|en)\.", ".", link) for link in re.findall(r"\]\(([^)#\s]+)", text)]
    parts.append(sorted(set(re.findall(r"`(--[\w-]+)", text))))
    return parts


@pytest.mark.parametrize("path", TRANSLATED, ids=lambda path: path.name)
def test_a_document_says_the_same_in_every_language(path: Path) -> None:
    english = next(path.parent.glob(f"{path.name.partition('.')[0]}.en.md"), refresh.READMES[0])

    assert skeleton(path) == skeleton(english)
    text = path.read_text(encoding="utf-8")
    assert not re.search(r"\.en\.md", text)
    assert {refresh.language(path)} >= {*re.findall(r'^language = "(\w+)"', text, re.MULTILINE)}  # settings to copy


@pytest.mark.parametrize("path", refresh.GUIDES, ids=lambda path: path.name)
def test_commands_and_options_that_a_guide_names_are_there(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    known = {name: {word for of in command.params for word in of.opts} for name, command in commands.commands.items()}
    lines = [line for _, block in FENCE.findall(text) for line in block.splitlines()]
    lines = [line.removeprefix("$ ").partition("  #")[0] for line in lines] + re.findall(r"`(kulman [^`]+)`", text)
    typed = [shlex.split(line) for line in lines if line.startswith("kulman ")]

    assert typed
    for _, name, *words in (words for words in typed if words[1] in known):
        assert {word for word in words if re.match(r"--?[a-z]", word)} - known[name] == set(), (name, words)
    assert {name for _, name, *_ in typed if name.isalpha()} - {*known, "help"} == set()
    assert set(re.findall(r"`(--[\w-]+)", text)) - set().union(*known.values()) == set()


def test_every_file_is_a_guide_and_every_guide_is_listed_by_its_heading(run: Run) -> None:
    assert {path.name for path in (home("kulman.variants") / "guides").iterdir()} == {
        f"{of}.{to}.md" for of in GUIDES for to in LANGUAGES
    }
    for language in LANGUAGES:
        lines = run("guide", "--lang", language)[1].splitlines()
        assert [line.split()[0] for line in lines] == [*GUIDES]
        assert all(len(line.split()) > 2 for line in lines)


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("topic", GUIDES)
def test_a_guide_is_shown_in_the_language(topic: str, language: str, run: Run) -> None:
    status, shown, warning = run("guide", topic, "--lang", language)

    assert status == 0
    assert shown.startswith("# ")
    assert not re.search(r"\]\(|<!--", shown)
    assert warning == ""


def test_a_guide_leads_on_to_others_and_to_tasks(run: Run) -> None:
    shown = run("guide", "own-mechanism")[1]

    assert "(kulman guide task-file)" in shown
    assert "(kulman show scheme-09-shaper)" in shown
    assert "first steps (docs/notebooks/first-steps.ipynb)" in run("guide", "python")[1]  # among the sources
    assert run("guide", "marknig") == (2, "", "there is no guide 'marknig'; did you mean marking?\n")


@pytest.mark.skipif(sys.platform == "win32", reason="no pager there")
def test_a_console_gets_a_guide_page_by_page_in_its_own_signs(monkeypatch: pytest.MonkeyPatch) -> None:
    class Console:
        encoding = "cp866"

        def isatty(self) -> bool:
            return True

    paged: list[str] = []
    monkeypatch.setattr(sys, "stdout", Console())
    monkeypatch.setattr(click, "echo_via_pager", paged.append)

    guides.page("кут φ – 30° · і")

    assert paged == ["кут phi - 30° · i"]
