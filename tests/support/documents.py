"""The console blocks of a document, run again without starting Python for each."""

import shlex

import pytest

from kulman import cli
from kulman.docs import refresh

SLOW = ("chart", "sheet")  # commands


def blocks(text: str, slow: bool = False) -> list[str]:
    """Return the console blocks of a document that begin with a slow command, or all others."""
    found: list[str] = refresh.BLOCK.findall(text)
    return [block for block in found if block.startswith(tuple(f"$ kulman {name}" for name in SLOW)) == slow]


def run_here(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    """Let `refresh.filled` run commands in this process."""

    def here(command: str, folder: str, language: str = "en") -> tuple[str, int]:
        monkeypatch.setenv("LC_ALL", refresh.locale(language))
        with pytest.raises(SystemExit) as stopped:
            cli.main(shlex.split(command)[1:])
        return "".join(capsys.readouterr()), int(stopped.value.code or 0)

    monkeypatch.setattr(refresh, "run", here)
