"""Which files hold answers: single ones, folders, patterns, or what the source of a bundled task prints."""

from __future__ import annotations

import glob
from collections.abc import Callable, Sequence
from dataclasses import replace
from importlib.resources import files
from pathlib import Path

from ...scales.errors import InputError, KulmanError
from ...scales.numbers import SHOWN, quote
from ..roster import Who
from ..spreadsheets.grid import SUFFIXES
from .answers import Answers, Asked
from .reading import read_answers

PRINTED = "printed"


def found_files(names: Sequence[str], task: str = "") -> list[str]:
    """Return the files that are meant: files as they are, all answers in a folder, all that a pattern fits.

    The word `printed` means the answers that the source of a bundled task prints.

    Raises
    ------
    InputError
        A folder or a pattern without answers.
    """
    found: list[str] = []
    for name in names:
        path = Path(name)
        if name == PRINTED and not path.exists():
            inside = [_printed(task)]
        elif path.is_dir():
            inside = sorted(str(file) for file in path.iterdir() if _is_answers(file))
        elif not path.exists() and glob.has_magic(name):
            inside = sorted(file for file in glob.glob(name) if _is_answers(Path(file)))
        else:
            inside = [name]
        if not inside:
            raise InputError("answers-nowhere", file=quote(name, SHOWN), known=", ".join(SUFFIXES))
        found += inside
    return list(dict.fromkeys(found))


def _printed(task: str) -> str:
    """Return the file of the answers that the source of a task prints.

    Raises
    ------
    InputError
        It prints none.
    """
    if not (file := _file_of(task)).is_file():
        raise InputError("answers-none-printed", task=quote(task))
    return str(file)


def _file_of(task: str) -> Path:
    return Path(str(files(__package__) / "printed" / f"{task}.csv"))


def _is_answers(path: Path) -> bool:
    return path.suffix.lower() in SUFFIXES and path.is_file() and not path.name.startswith((".", "~$"))


def read_all(names: Sequence[str], task: str, asked: Asked, warn: Callable[[KulmanError], None]) -> list[Answers]:
    """Read all answers; a file that cannot be read is told of and has its place, and those beside it are marked.

    Raises
    ------
    InputError
        The only file there is cannot be read.
    """
    inside, found = found_files(names, task), list[Answers]()
    for file in inside:
        try:
            of_source = file == str(_file_of(task))
            read = read_answers(file, asked, PRINTED if of_source else "")
        except InputError as error:
            if len(inside) == 1:
                raise
            warn(error)
            found.append(Answers(file, Who(), {}, {}, {}, unread=error))
            continue
        found += map(_of_source, read) if of_source else read
    return found


def _of_source(printed: Answers) -> Answers:
    """Return the answers of a source: what it does not print is not missing."""
    return replace(printed, source=PRINTED, columns=tuple(printed.lines))
