"""The guides read in the console."""

from __future__ import annotations

import re
import sys
from pathlib import Path

import click

from ..shelf import GUIDES, guide_text

_LINK = re.compile(r"!?\[([^\]]+)\]\(([^)\s]+)\)")


def guide(topic: str, language: str) -> str:
    """Return a guide as a console shows it; `InputError` where there is no such topic."""
    return _LINK.sub(_followed, guide_text(topic, language))


def _followed(link: re.Match[str]) -> str:
    """Return a link as words: with the command that shows where it leads, if one does."""
    words, target = link[1], Path(link[2].partition("#")[0])
    name = target.name.partition(".")[0]
    if target.suffix == ".md" and name in GUIDES:
        return f"{words} (kulman guide {name})"
    if target.suffix == ".toml" and target.parent.name == "tasks":
        return f"{words} (kulman show {name})"
    if not link[0].startswith("!") and target.is_relative_to("../.."):  # among the sources, which are not installed
        return f"{words} ({target.relative_to('../..').as_posix()})"
    return f"{words} ({link[2]})" if "://" in link[2] and words != link[2] else words


def page(text: str) -> None:
    """Print a long text, on a console page by page; `more` of Windows would show it in another encoding than ours."""
    if sys.stdout is None or not sys.stdout.isatty() or sys.platform == "win32":
        click.echo(text)
    else:  # the pager is handed bytes: signs that its console lacks are replaced before
        signs = sys.stdout.encoding
        click.echo_via_pager(text.encode(signs, "kulman-nearest").decode(signs))
