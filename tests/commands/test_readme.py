"""The README cannot rot: its commands run, they print what it shows, its Python runs, its links lead somewhere."""

import re

import pytest

from kulman.docs import refresh
from kulman.tests.support.documents import run_here

TEXT = refresh.README.read_text(encoding="utf-8")
BLOCKS = refresh.BLOCK.findall(TEXT)
# blocks whose commands start Python, as a user does: the first of some; in the long run all do
STARTED = [
    next(block for block in BLOCKS if block.startswith(f"$ kulman {name}")) for name in ("solve", "sheet", "new")
]


@pytest.mark.parametrize("block", BLOCKS, ids=lambda block: refresh.commands(block)[0][:40])
def test_commands_print_what_the_readme_shows(block, tmp_path, monkeypatch, capsys):
    if block not in STARTED:
        monkeypatch.chdir(tmp_path)
        run_here(monkeypatch, capsys)

    printed = refresh.filled(block, str(tmp_path))

    assert printed == block


def test_every_command_of_the_program_stands_in_the_readme():
    from kulman.cli import commands

    assert BLOCKS
    for name in commands.commands:
        assert f"kulman {name}" in TEXT


def test_python_of_the_readme_runs(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    code = "\n".join(re.findall(r"```python\n(.*?)```", TEXT, re.DOTALL)).replace("1_000_000", "1_000")
    names: dict[str, object] = {}

    exec(compile(code, "README.md", "exec"), names)

    assert (tmp_path / "sheet.svg").exists() or (tmp_path / "sheet-1.svg").exists()
    assert len(names["codes"]) == 1000


def test_links_of_the_readme_lead_somewhere():
    for target in re.findall(r"\]\(([^)#:]+)\)", TEXT):
        assert (refresh.ROOT / target).exists(), target
