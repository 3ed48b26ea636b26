"""A task file with other variants: everything else stays as it is written, comments too."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Mapping

_HEADER = re.compile(r"\s*\[")
_VARIANT = re.compile(r"\s*\[\[\s*variant\s*\]\]|\s*\[\s*variant\s*\.")
_ARRAY = re.compile(r"\s*variant\s*=\s*\[")
_STRING = re.compile(r'"(?:\\.|[^"\\])*"|\'[^\']*\'')
_ID = re.compile(r"^id\s*=.*$", re.MULTILINE)


def with_variants(text: str, rows: Iterable[tuple[str, Mapping[str, str]]], name: str | None = None) -> str:
    """Return the text of a task file with `rows` in the place of its variants: ids, and givens as they are written.

    Parameters
    ----------
    name : str, optional
        Another id of the task.
    """
    kept, inside, depth = [], False, 0
    for line in text.splitlines():
        if depth or _ARRAY.match(line):  # variant = [ ... ]
            plain = _STRING.sub("", line).partition("#")[0]
            depth += plain.count("[") - plain.count("]")
            continue
        if _HEADER.match(line):
            inside = _VARIANT.match(line) is not None
        if not inside:
            kept.append(line)
    whole = "\n".join(kept).rstrip("\n")
    if name is not None:
        whole = _ID.sub(lambda found: f"id = {_quoted(name)}", whole, count=1)
    tables = ("\n".join(("[[variant]]", *_lines({"id": number, **row}))) for number, row in rows)
    return "\n\n".join((whole, *tables)) + "\n"


def _lines(row: Mapping[str, str]) -> Iterable[str]:
    return (f"{name} = {_quoted(text)}" for name, text in row.items())


def _quoted(text: str) -> str:
    """Return a text as a basic string of TOML."""
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007F")
