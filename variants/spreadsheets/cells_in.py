"""A file of cells read as a grid, CSV or XLSX, with bounds on what it may hold."""

from __future__ import annotations

from pathlib import Path

from ...scales.errors import InputError
from ...scales.numbers import SHOWN, quote
from .csv_read import grid_of_csv
from .grid import LARGEST, SUFFIXES, Grid
from .xlsx_read import grid_of_xlsx


def read_grid(file: str | Path) -> Grid:
    """Read a file of answers, or a roster, as a grid; the suffix says which kind it is.

    Raises
    ------
    InputError
        There is no such file, it is too large, or is not what its suffix says.
    """
    path = Path(file)
    shown = quote(path, SHOWN)
    suffix = path.suffix.lower()
    if suffix not in SUFFIXES:
        raise InputError("answers-suffix", file=shown, known=", ".join(SUFFIXES))
    data = _bytes(path, shown)
    if suffix == ".xlsx":
        return grid_of_xlsx(str(path), data)
    return grid_of_csv(str(path), data)


def _bytes(path: Path, shown: str) -> bytes:
    """Return what a file holds, as long as it is a file and not too large."""
    try:
        other = path.exists() and not path.is_file()
    except (OSError, ValueError):
        other = False
    if other:
        raise InputError("answers-not-file", file=shown)
    try:
        with path.open("rb") as stream:
            data = stream.read(LARGEST + 1)
    except FileNotFoundError:
        raise InputError("file-missing", file=shown) from None
    except (OSError, ValueError):
        raise InputError("file-unreadable", file=shown) from None
    if len(data) > LARGEST:
        raise InputError("answers-large", file=shown, n=LARGEST // 1_000_000)
    if not data.strip():
        raise InputError("answers-empty", file=shown)
    return data
