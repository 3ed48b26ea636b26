"""What comes with the program: tasks, their ids, texts, what `list` shows of them; guides."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterator
from typing import Any

from ..scales.names import all_known, of_its_kinds, unknown
from ..scales.packaged import home
from .kinds import MODULES, table_in

_TASKS, _GUIDES = home(__package__) / "tasks", home(__package__) / "guides"
# in the order of reading
GUIDES = ("start", "install", "own-mechanism", "task-file", "subjects", "marking", "classes", "settings", "python")
# what the files of the bundled tasks look like: a row of variants begins with its id, a given with unit or choices
_ID = re.compile(r'^(?:  \{ )?id = "([^"]+)"', re.MULTILINE)
_TABLE = re.compile(r"^variant = \[\n.*?^\]\n", re.MULTILINE | re.DOTALL)
HEADS = re.compile(r"^\[+(\w+)", re.MULTILINE)  # of tables
_GIVEN = re.compile(r'^(\w+) = \{ (?:unit = "([^"]+)"|choices = \[([^]]+)\])', re.MULTILINE)
STEM, ENDING = 4, 2  # letters of a word that count at least, and that may be its ending
_COMMENT = re.compile(r"^<!--.*?-->\n", re.MULTILINE | re.DOTALL)


@of_its_kinds()
def bundled(kind: str | None = None) -> tuple[str, ...]:
    """Return the ids of the bundled tasks; only those of a kind: `mechanism`, `cam`, `gear` or `hoist`."""
    if kind is not None:
        all_known("kind-unknown", [kind], MODULES)
    names = (entry.name for entry in _TASKS.iterdir())
    tasks = sorted(name.removesuffix(".toml") for name in names if name.endswith(".toml"))
    return tuple(task for task in tasks if kind is None or kind == table_in(HEADS.findall(bundled_text(task))))


tasks = bundled  # the name in Python


def bundled_text(task: str) -> str:
    """Return the TOML of a bundled task."""
    return (_TASKS / f"{task}.toml").read_text(encoding="utf-8")


def numbered(said: str) -> str:
    """Return the bundled task whose name has the number that is said, `8`; anything else as it is.

    >>> numbered("8"), numbered("80"), numbered("8.toml")
    ('scheme-08-planer', '80', '8.toml')
    """
    numbers = [int(said)] if said.isascii() and said.isdecimal() else []
    found = [task for task in bundled() if numbers and numbers[0] in map(int, re.findall(r"\d+", task))]
    return found[0] if len(found) == 1 else said


def text_of(task: str) -> str:
    """Return the TOML of a bundled task that a user has named; `InputError` where there is none of that name."""
    known, task = bundled(), numbered(task)
    if task not in known:
        raise unknown("bundled-unknown", task, known)
    return bundled_text(task)


def summary(task: str) -> dict[str, Any]:
    """Return what `list` shows of a bundled task: id, title, source, note, variants, plans, givens and their units.

    To parse whole files would take most of the time of `list`: only their heads are parsed.
    """
    text = bundled_text(task)
    head, _, rest = text.partition("[givens]\n")
    raw = tomllib.loads(_TABLE.sub("", head))
    rows = _GIVEN.findall(rest[: rest.index("\n[")])
    givens = {name: unit or re.findall('"([^"]+)"', choices) for name, unit, choices in rows}
    return {name: raw[name] for name in ("id", "title", "source", "plans", "note") if name in raw} | {
        "variants": _ID.findall(text)[1:],
        "givens": givens,
    }


def called(words: str) -> Iterator[dict[str, Any]]:
    """Go through what `list` shows of the bundled tasks with all these words in names or titles, whatever their ends.

    >>> [task["id"] for task in called("щокова")]
    ['scheme-14-jaw-crusher']
    """
    for task in map(summary, bundled()):
        name, asked = (
            re.findall(r"[^\W_]+", text.casefold().replace("ё", "е"))
            for text in (" ".join((task["id"], *task["title"].values())), words)
        )
        stems = (word[: max(STEM, len(word) - ENDING)] for word in asked)
        if all(any(one.startswith(stem) for one in name) for stem in stems):
            yield task


def guides(language: str) -> dict[str, str]:
    """Return the headings of the guides by topic."""
    return {topic: guide_text(topic, language).partition("\n")[0].lstrip("# ") for topic in GUIDES}


def guide_text(topic: str, language: str) -> str:
    """Return a guide as Markdown; `InputError` where there is no such topic."""
    if topic not in GUIDES:
        raise unknown("guide-unknown", topic, GUIDES)
    return _COMMENT.sub("", (_GUIDES / f"{topic}.{language}.md").read_text(encoding="utf-8"))
