"""The documents cannot rot: commands print what they show, Python runs, links lead somewhere, all is installed."""

from __future__ import annotations

import doctest
import inspect
import re
import tomllib
from importlib import import_module
from pathlib import Path

import pytest

from kulman.cli import commands
from kulman.docs import refresh
from kulman.scales.errors import LANGUAGES, messages
from kulman.tests.support.cases import some
from kulman.tests.support.documents import blocks, run_here
from kulman.tests.support.sources import ROOT, files
from kulman.variants.making.starter import _template
from kulman.variants.reader import read_text
from kulman.variants.shelf import GUIDES, bundled_text

TEXTS = {path.stem: path.read_text(encoding="utf-8") for path in refresh.DOCUMENTS}
COMMANDS = refresh.BLOCK.findall(TEXTS["commands"])
# blocks whose commands start Python, as a user does: the first of some; in the long run a third
STARTED = [next(block for block in COMMANDS if block.startswith(f"$ kulman {name}")) for name in ("solve", "new")]
SLOWEST = ("$ kulman handout", "$ kulman sheet madi-cam", "$ kulman note")
BLOCKS = {"cams": (8, 3), "gears": (4, 2), "hoist": (1, 4)}  # of commands, quick and slow ones
FIRST, OTHERS = TEXTS["own-mechanism.en"].split("# Other parts\n")
LONGEST = 700  # words of a README
TOML = re.compile(r"```toml\n(.*?)```", re.DOTALL)
WITH_EXAMPLES = sorted(
    ".".join(("kulman", *path.relative_to(ROOT).with_suffix("").parts)).removesuffix(".__init__")
    for path in files()
    if ">>> " in path.read_text(encoding="utf-8")
)
SETUPTOOLS = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["setuptools"]


# what takes longest the soak starts with some others, below
@pytest.mark.parametrize(
    "block",
    [block for block in COMMANDS if not block.startswith(SLOWEST)],
    ids=lambda block: refresh.commands(block)[0][:40],
)
def test_commands_print_what_their_page_shows(
    block: str, folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    if block not in STARTED:
        run_here(monkeypatch, capsys)

    assert refresh.filled(block, str(folder)) == block


# documents that are in three languages take turns, in the long run all are read
IN_TURN = [name for name in TEXTS if name != "commands"]
NOW = map(IN_TURN.index, ("README", "classes.uk", "marking.uk", "start.uk"))


@pytest.mark.parametrize("name", some(IN_TURN, *NOW))
def test_commands_one_after_the_other_print_what_a_document_shows(
    name: str, folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    run_here(monkeypatch, capsys)

    language = name.partition(".")[2] or "en"

    assert refresh.refreshed(TEXTS[name], str(folder), language) == TEXTS[name]


@pytest.mark.parametrize("name", some(BLOCKS, 1, 2))
def test_a_document_of_a_subject_shows_what_is_printed_and_drawn(
    name: str, folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    run_here(monkeypatch, capsys)
    quick, slow = (blocks(TEXTS[name], slow=slow) for slow in (False, True))
    pictures = re.findall(r"pictures/([\w-]+)\.png", TEXTS[name])

    assert (len(quick), len(slow)) == BLOCKS[name]
    assert [block for block in quick if refresh.filled(block, str(folder)) != block] == []
    assert pictures
    assert {*pictures} <= {*refresh.SHEETS, *(f"chart-{chart}" for chart in refresh.CHARTS)}
    assert all((refresh.PICTURES / f"{picture}.png").exists() for picture in pictures)


# all others print it in this process, above
@pytest.mark.soak
@pytest.mark.parametrize(
    "block",
    [block for n, block in enumerate(COMMANDS) if block.startswith(SLOWEST) or n % 3 == 0],
    ids=lambda block: refresh.commands(block)[0][:40],
)
def test_a_command_started_by_itself_prints_what_its_page_shows(block: str, folder: Path) -> None:
    assert refresh.filled(block, str(folder)) == block


@pytest.mark.parametrize("name", ["README", "cycle", "python.en"])
def test_python_of_a_document_runs(name: str, folder: Path) -> None:
    blocks = re.findall(r"```python\n(.*?)```", TEXTS[name], re.DOTALL)
    names: dict[str, object] = {}

    exec(compile("\n".join(blocks), name, "exec"), names)

    assert name != "README" or [*folder.glob("sheet*.svg")]
    assert {"README": "solution", "cycle": "swept", "python.en": "columns"}[name] in names


def test_the_page_of_commands_names_every_command_and_links_of_the_readme_lead_somewhere() -> None:
    assert [name for name in commands.commands if f"kulman {name}" not in TEXTS["commands"]] == []
    for path in refresh.READMES:
        links = re.findall(r"\]\(([^)#:]+)\)", TEXTS[path.stem])
        assert [target for target in links if not (refresh.ROOT / target).exists()] == []
        assert {f"variants/guides/{topic}.{refresh.language(path)}.md" for topic in GUIDES} <= {*links}
        assert len(TEXTS[path.stem].split()) <= LONGEST


def test_steps_to_an_own_mechanism_quote_the_file_to_begin_with() -> None:
    quoted = TOML.findall(FIRST)

    assert len(quoted) >= 8
    assert all(block in _template("en") for block in quoted)
    parts = {line for block in quoted for line in block.splitlines() if line.startswith("[")}
    assert parts >= {"[givens]", "[[mechanism.link]]", "[[mechanism.pair]]", "[mechanism.driver]", "[[variant]]"}


def test_lines_of_other_parts_stand_in_the_task_that_is_named_last_before_them() -> None:
    for section in re.split(r"^## ", OTHERS, flags=re.MULTILINE)[1:]:
        assert TOML.findall(section)
        for block in TOML.findall(section):
            named = re.findall(r"tasks/([\w-]+)\.toml\)", section[: section.index(block)])
            assert block in bundled_text(named[-1]), block


@pytest.mark.parametrize("language", LANGUAGES)
def test_fault_that_the_document_shows_is_the_one_of_the_program(language: str) -> None:
    (shown,) = re.findall(r"```text\n(my-mechanism.*?)\n```", TEXTS[f"own-mechanism.{language}"])
    pivot = '[[mechanism.pair]]\nkind = "revolute"\npoint = "C"\nlinks = [3, 0]\nat = ["280 mm", "0 mm"]\n'
    assert pivot in _template("en")

    _, faults = read_text(_template("en").replace(pivot, ""), "my-mechanism.toml")

    assert [fault.text(language) for fault in faults] == [shown]


@pytest.mark.parametrize("name", [name for name in TEXTS if name.startswith(("own-mechanism", "task-file"))])
def test_faults_often_made_are_told_in_the_words_of_the_messages(name: str) -> None:
    *_, table = re.findall(r"(?:^\|.*\n)+", TEXTS[name], re.MULTILINE)
    quoted = [words for row in table.splitlines() for words in re.findall(r"`(.*?)`", row.split("|")[1])]

    assert len(quoted) > 5
    said = messages(name.partition(".")[2]).values()
    assert [words for words in quoted if not any(words in message for message in said)] == []


@pytest.mark.parametrize("module", WITH_EXAMPLES)
def test_examples_in_docstrings_say_what_comes_out(module: str) -> None:
    loaded, finder, runner = import_module(module), doctest.DocTestFinder(), doctest.DocTestRunner()
    # in what a decorator has wrapped doctest itself looks for none
    own = (value for value in vars(loaded).values() if getattr(value, "__module__", "") == module)
    wrapped = [inspect.unwrap(value) for value in own if hasattr(value, "__wrapped__")]

    for test in (*finder.find(loaded), *(one for each in wrapped for one in finder.find(each, globs=vars(loaded)))):
        runner.run(test)

    assert runner.tries > 0
    assert runner.failures == 0


def test_every_module_and_every_file_of_words_tasks_and_looks_beside_it_is_installed() -> None:
    packages = {".".join(("kulman", *file.parent.relative_to(ROOT).parts)) for file in files()}
    folders = {file.relative_to(ROOT).parts[0] for file in files() if file.parent != ROOT}
    inside = (file for name in folders for file in (ROOT / name).rglob("*") if file.is_file())
    beside = {file for file in inside if file.suffix != ".py" and "__pycache__" not in file.parts}
    installed = {
        file
        for name, patterns in SETUPTOOLS["package-data"].items()
        for pattern in patterns
        for file in ROOT.joinpath(*name.split(".")[1:]).glob(pattern)
    }

    assert set(SETUPTOOLS["packages"]) == packages
    assert beside
    assert beside - installed == set()
