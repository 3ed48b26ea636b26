"""`kulman new`: a file with comments in each language that is valid at once, and never in place of another file."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from kulman import cli, load_task, solve
from kulman.scales.errors import LANGUAGES, InputError
from kulman.variants.kinds import KINDS, MODULES
from kulman.variants.making.starter import start, template
from kulman.variants.reader import read_text


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("LC_ALL", "en_GB.UTF-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("language", LANGUAGES)
def test_file_is_valid_at_once_in_every_language(language: str, kind: str) -> None:
    path = start("own-task.toml", language, kind)

    task = load_task(path)

    assert (task.id, MODULES[task.kind]) == ("own-task", kind)
    assert "own-task.toml" in path.read_text(encoding="utf-8")
    assert not re.search("my-(mechanism|cam|gear|hoist)", path.read_text(encoding="utf-8"))
    for variant in task.variants:
        solution = solve(path, variant)
        assert (solution.status, solution.warnings) == ("ok", ())
        assert all(check["ok"] for check in solution.checks.values())


@pytest.mark.parametrize("kind", KINDS)
def test_templates_differ_in_words_alone(kind: str) -> None:
    def plain(language: str) -> str:
        lines = (line.partition("#")[0].rstrip() for line in template(language, kind).splitlines())
        return re.sub('source = ".*"', "", "\n".join(line for line in lines if line))

    assert plain("uk") == plain("ru") == plain("en")
    assert all(len(line) <= 120 for language in LANGUAGES for line in template(language, kind).splitlines())


def test_file_is_easy_to_change() -> None:
    text = template("en")
    for old, new in (
        ("l_OA = 100", "l_OA = 95"),
        ('at = ["280 mm"', 'at = ["300 mm"'),
        ("sense = 1\n", "sense = -1\n"),
    ):
        assert old in text
        text = text.replace(old, new)

    task, faults = read_text(text, "t.toml")

    assert (task is not None, faults) == (True, ())


def test_command_writes_the_file_in_the_language_asked_for_and_shows_its_name(
    capsys: pytest.CaptureFixture[str],
) -> None:
    for arguments, words in ((["new", "a.toml"], "The links."), (["new", "b.toml", "--lang", "uk"], "Ланки.")):
        with pytest.raises(SystemExit) as stopped:
            cli.main(arguments)

        assert (stopped.value.code, capsys.readouterr().out) == (0, f"{arguments[1]}\n")
        assert words in Path(arguments[1]).read_text(encoding="utf-8")


def test_name_without_a_suffix_gets_one_and_any_name_makes_an_id() -> None:
    assert start("press", "en") == Path("press.toml")
    assert load_task(start("мій механізм (2).toml", "uk")).id == "мій-механізм-2"
    assert 'kulman sheet "мій механізм (2).toml"' in Path("мій механізм (2).toml").read_text(encoding="utf-8")
    assert load_task(start("---.toml", "en")).id == "my-mechanism"


@pytest.mark.parametrize(
    ("name", "key"),
    [
        ("there.toml", "output-exists"),
        ("x.svg", "output-suffix"),
        ("none/x.toml", "output-folder-missing"),
        ("folder.toml", "output-exists"),
        ("a\0.toml", "output-name"),
        ("", "output-name"),
    ],
)
def test_place_where_no_file_can_be_written_is_refused(name: str, key: str) -> None:
    Path("there.toml").write_text("mine", encoding="utf-8")
    Path("folder.toml").mkdir()

    with pytest.raises(InputError) as refused:
        start(name, "en")

    assert refused.value.key == key
    assert Path("there.toml").read_text(encoding="utf-8") == "mine"
    assert sorted(path.name for path in Path().iterdir()) == ["folder.toml", "there.toml"]
