"""A task file to begin with, one for each kind of task: with comments, valid as it stands and easy to change."""

from __future__ import annotations

import os
import re
from pathlib import Path

from ..scales.errors import InputError
from ..scales.numbers import SHOWN, quote
from ..scales.packaged import home
from .kinds import KINDS

SUFFIX = ".toml"
_OWN = re.compile(r'^id = "([^"]+)"', re.MULTILINE)  # what a template calls itself


def template(language: str, kind: str = KINDS[0]) -> str:
    """Return the task file of a kind that `start` writes, with its comments in `language`."""
    return (home(__package__) / "templates" / f"{kind}.{language}.toml").read_text(encoding="utf-8")


def start(file: str | os.PathLike[str], language: str, kind: str = KINDS[0]) -> Path:
    """Write a task file to begin with, and return its path; a name without a suffix gets one.

    Parameters
    ----------
    language : str
        Of the comments.
    kind : str
        What the task is about, of `kinds.KINDS`: a linkage, a cam.

    Raises
    ------
    InputError
        A name of another kind, a file that is there already, or a place where none can be written.
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
