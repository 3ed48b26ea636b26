"""Guides that come with the program, `guides/<topic>.<language>.md`: read in the console, or as pages of Git."""

from __future__ import annotations

import re
import sys
from pathlib import Path

import click

from ...scales.names import unknown
from ...scales.packaged import home

FOLDER = home((__package__ or "").rpartition(".")[0]) / "guides"
# in the order of reading
TOPICS = ("start", "install", "own-mechanism", "task-file", "subjects", "marking", "classes", "settings", "python")
_LINK = re.compile(r"!?\[([^\]]+)\]\(([^)\s]+)\)")
_COMMENT = re.compile(r"^<!--.*?-->\n", re.MULTILINE | re.DOTALL)


def contents(language: str) -> dict[str, str]:
    """Return the headings of the guides by topic."""
    return {topic: _text(topic, language).partition("\n")[0].lstrip("# ") for topic in TOPICS}


def guide(topic: str, language: str) -> str:
    """Return a guide as a console shows it; `InputError` where there is no such topic."""
    if topic not in TOPICS:
        raise unknown("guide-unknown", topic, TOPICS)
    return _LINK.sub(_followed, _COMMENT.sub("", _text(topic, language)))


def _text(topic: str, language: str) -> str:
    return (FOLDER / f"{topic}.{language}.md").read_text(encoding="utf-8")


def _followed(link: re.Match[str]) -> str:
    """Return a link as words: with the command that shows where it leads, if one does."""
    words, target = link[1], Path(link[2].partition("#")[0])
    name = target.name.partition(".")[0]
    if target.suffix == ".md" and name in TOPICS:
        return f"{words} (kulman guide {name})"
    if target.suffix == ".toml" and target.parent.name == "tasks":
        return f"{words} (kulman show {name})"
    return f"{words} ({link[2]})" if "://" in link[2] and words != link[2] else words


def page(text: str) -> None:
    """Print a long text, on a console page by page; `more` of Windows would show it in another encoding than ours."""
    if sys.stdout is None or not sys.stdout.isatty() or sys.platform == "win32":
        click.echo(text)
    else:  # the pager is handed bytes: signs that its console lacks are replaced before
        signs = sys.stdout.encoding
        click.echo_via_pager(text.encode(signs, "kulman-nearest").decode(signs))
