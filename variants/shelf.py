"""The tasks that come with the program: their ids, texts, what `list` shows of them; task files to begin with."""

from __future__ import annotations

import os
import re
import tomllib
from pathlib import Path
from typing import Any

from ..scales.errors import InputError
from ..scales.numbers import SHOWN, quote
from ..scales.packaged import home
from .kinds import KINDS, table_in

_TASKS = home(__package__) / "tasks"
# what the files of the bundled tasks look like: a row of variants begins with its id, a given with unit or choices
_ID = re.compile(r'^(?:  \{ )?id = "([^"]+)"', re.MULTILINE)
_TABLE = re.compile(r"^variant = \[\n.*?^\]\n", re.MULTILINE | re.DOTALL)
_HEADS = re.compile(r"^\[+(\w+)", re.MULTILINE)  # of tables
_GIVEN = re.compile(r'^(\w+) = \{ (?:unit = "([^"]+)"|choices = \[([^]]+)\])', re.MULTILINE)
SUFFIX = ".toml"
_OWN = re.compile(r'^id = "([^"]+)"', re.MULTILINE)  # what a template calls itself


def bundled(kind: str | None = None) -> tuple[str, ...]:
    """Return the ids of the bundled tasks; only those of one kind where its table is said, `mechanism` or `cam`."""
    names = (entry.name for entry in _TASKS.iterdir())
    tasks = sorted(name.removesuffix(".toml") for name in names if name.endswith(".toml"))
    return tuple(task for task in tasks if kind is None or kind == table_in(_HEADS.findall(bundled_text(task))))


def bundled_text(task: str) -> str:
    """Return the TOML of a bundled task."""
    return (_TASKS / f"{task}.toml").read_text(encoding="utf-8")


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


def template(language: str, kind: str = KINDS[0]) -> str:
    """Return the task file of a kind that `start` writes, with its comments in `language`."""
    return (home(__package__) / "templates" / f"{kind}.{language}.toml").read_text(encoding="utf-8")


def start(file: str | os.PathLike[str], language: str, kind: str = KINDS[0]) -> Path:
    """Write a task file of a kind to begin with, its comments in a language, and return its path.

    A name without a suffix gets one; a file that is there already stays, and is an error.
    """
    path = Path(file)
    shown = quote(path, SHOWN)
    if "\0" in str(path) or not path.name:
        raise InputError("output-name", file=shown)
    if not path.suffix:
        path = path.with_suffix(SUFFIX)
        shown = quote(path, SHOWN)
    if path.suffix != SUFFIX:
        raise InputError("output-suffix", file=shown, known=SUFFIX)
    if not path.parent.is_dir():
        raise InputError("output-folder-missing", file=shown, folder=quote(path.parent, SHOWN))
    called = f'"{path}"' if " " in str(path) else str(path)
    text = template(language, kind)
    own = _OWN.findall(text)[0]
    text = text.replace(f'"{own}"', f'"{_label(path.stem) or own}"').replace(f"{own}{SUFFIX}", called)
    try:
        with path.open("x", encoding="utf-8", newline="\n") as stream:
            stream.write(text)
    except FileExistsError as error:
        raise InputError("output-exists", file=shown) from error
    except OSError as error:
        raise InputError("output-refused", file=shown, reason=error.strerror or "") from error
    return path


def _label(stem: str) -> str:
    """Return the id of a task out of the name of its file, nothing where there is none in it."""
    return re.sub(r"^[.-]+|[^\w.-]+", "-", stem).strip("-")
