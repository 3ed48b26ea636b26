"""A task file to begin with: a four-bar linkage with comments, valid as it stands and easy to change."""

from __future__ import annotations

import os
import re
from pathlib import Path

from ..scales.errors import InputError
from ..scales.numbers import quote
from ..scales.packaged import home

SUFFIX = ".toml"
_NAME = "my-mechanism"  # what the templates call themselves
_SHOWN = 200


def template(language: str) -> str:
    """Return the task file that `start` writes, with its comments in `language`."""
    return (home(__package__) / "templates" / f"{language}.toml").read_text(encoding="utf-8")


def start(file: str | os.PathLike[str], language: str) -> Path:
    """Write a task file to begin with, and return its path; a name without a suffix gets one.

    Raises
    ------
    InputError
        A name of another kind, a file that is there already, or a place where none can be written.
    """
    path = Path(file)
    shown = quote(path, _SHOWN)
    if "\0" in str(path) or not path.name:
        raise InputError("output-name", file=shown)
    if not path.suffix:
        path = path.with_suffix(SUFFIX)
        shown = quote(path, _SHOWN)
    if path.suffix != SUFFIX:
        raise InputError("output-suffix", file=shown, known=SUFFIX)
    if not path.parent.is_dir():
        raise InputError("output-folder-missing", file=shown, folder=quote(path.parent, _SHOWN))
    called = f'"{path}"' if " " in str(path) else str(path)
    text = template(language).replace(f'"{_NAME}"', f'"{_label(path.stem)}"').replace(f"{_NAME}{SUFFIX}", called)
    try:
        with path.open("x", encoding="utf-8", newline="\n") as stream:
            stream.write(text)
    except FileExistsError as error:
        raise InputError("output-exists", file=shown) from error
    except OSError as error:
        raise InputError("output-refused", file=shown, reason=error.strerror or "") from error
    return path


def _label(stem: str) -> str:
    """Return the id of a task out of the name of its file."""
    return re.sub(r"^[.-]+|[^\w.-]+", "-", stem).strip("-") or _NAME
