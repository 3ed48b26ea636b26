"""Commands and classes as tests want them: run here, a roster of some rows, the files and tables that come out."""

from __future__ import annotations

import csv
from collections.abc import Callable
from pathlib import Path

Run = Callable[..., tuple[int, str, str]]  # of arguments: status, standard output, standard error


def roster(folder: Path, *rows: str, head: str = "student;group;variant;phi") -> Path:
    """Write a roster of these rows."""
    file = folder / "class.csv"
    file.write_text("\n".join((head, *rows)) + "\n", encoding="utf-8")
    return file


def files(folder: Path) -> dict[str, bytes]:
    """Return what the files of a folder hold, without those whose names begin with a dot."""
    return {path.name: path.read_bytes() for path in folder.iterdir() if path.is_file() and path.name[0] != "."}


def table(file: Path) -> list[dict[str, str]]:
    """Return the rows of a table with commas."""
    with file.open(encoding="utf-8-sig", newline="") as stream:
        return list(csv.DictReader(stream))
