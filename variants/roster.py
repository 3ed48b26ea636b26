"""The roster of a class: who is in it, which variant and data each one has; or a variant by the record book."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from ..scales.errors import InputError
from ..scales.names import latin, unknown
from ..scales.numbers import quote
from .spreadsheets.cells_in import read_grid
from .spreadsheets.grid import SHOWN, Grid
from .spreadsheets.headers import LOOKED_AT, about_kind, quantity_part
from .task import LocatedError, Task

WHO = ("student", "group", "book", "number", "email")
KEYS = ("number", "book", "email", "student")  # by which a student is found, the surest first


@dataclass(frozen=True, slots=True)
class Who:
    """A student as the file, or the roster, names one; what is not said is empty."""

    student: str = ""
    group: str = ""
    book: str = ""
    number: str = ""
    email: str = ""

    @classmethod
    def of(cls, about: Mapping[str, str]) -> Who:
        """Return the student of whom a file says so."""
        return cls(*(about.get(key, "") for key in WHO))


@dataclass(frozen=True, slots=True)
class Entry:
    """One student of the roster: the variant, empty where the record book decides, and other values for givens.

    `problem` is why the row cannot be used, where others can be without it.
    """

    who: Who
    variant: str
    settings: Mapping[str, str]
    place: str
    problem: InputError | None = None

    def variant_of(self, task: Task, digits: int = 1) -> str:
        """Return the variant, that of the record book where none is written; empty where neither is.

        Raises
        ------
        InputError
            The record book has no such digits.
        """
        return self.variant or (variant_of_book(task, self.who.book, digits) if self.who.book else "")


@dataclass(frozen=True)
class Roster:
    """The students of a class, in the order of the file."""

    entries: tuple[Entry, ...]

    @cached_property
    def _by_key(self) -> Mapping[tuple[str, str], list[Entry]]:
        """The entries by what they are found by."""
        found: dict[tuple[str, str], list[Entry]] = {}
        for entry in self.entries:
            for key in KEYS:
                found.setdefault((key, _folded(getattr(entry.who, key))), []).append(entry)
        return found

    def find(self, who: Who) -> Entry | None:
        """Return the entry of a student: by number, record book, e-mail or name, whichever is there first."""
        for key in KEYS:
            said = _folded(getattr(who, key))
            found = self._by_key.get((key, said), []) if said else []
            if len(found) == 1:
                return found[0]
        return None

    def missing(self, there: Iterable[Who]) -> list[Entry]:
        """Return those who are not there."""
        found = {id(entry) for who in there if (entry := self.find(who)) is not None}
        return [entry for entry in self.entries if id(entry) not in found]


def _folded(text: str) -> str:
    """Return a name without what people write differently: capitals, apostrophes, dots, spaces."""
    return re.sub(r"[\s.'’ʼ`]+", "", text.casefold().replace("ё", "е"))


def read_roster(file: str | Path, task: Task, each: bool = False) -> Roster:
    """Read a roster: CSV or XLSX with a column `student`, and `variant`, `record book`, givens such as `phi [deg]`.

    Parameters
    ----------
    each : bool
        Let a row that is wrong be the problem of its student alone.

    Raises
    ------
    InputError
        No such columns; an unknown variant or given, or a value that it cannot take, with the cell.
    """
    grid = read_grid(file)
    header = next((row for row in range(min(len(grid.rows), LOOKED_AT)) if _is_header(grid.rows[row])), None)
    if header is None:
        raise InputError("roster-header", file=quote(grid.file, SHOWN))
    about: dict[str, int] = {}
    givens: dict[int, tuple[str, str]] = {}
    for column, text in enumerate(grid.rows[header]):
        kind, part = about_kind(text), quantity_part(text)
        if kind is not None:
            about.setdefault(kind, column)
        elif part is not None and part[0] in task.givens:
            givens[column] = (part[0], part[2])
        elif part is not None and "_" in text:
            error = unknown("given-unknown", part[0], task.givens, task=task.id)
            raise LocatedError(grid.place(header, column), error)
    rows = range(header + 1, len(grid.rows))
    read = _told if each else _entry
    return Roster(tuple(read(grid, row, about, givens, task) for row in rows if any(grid.rows[row])))


def _is_header(row: tuple[str, ...]) -> bool:
    kinds = {about_kind(text) for text in row}
    return bool(kinds & set(KEYS)) and len(row) > 1


def _told(grid: Grid, row: int, about: Mapping[str, int], givens: Mapping[int, tuple[str, str]], task: Task) -> Entry:
    """Read one student; what is wrong is said with the student."""
    try:
        return _entry(grid, row, about, givens, task)
    except InputError as error:
        return Entry(Who.of(_said(grid, row, about)), "", {}, grid.place(row), error)


def _said(grid: Grid, row: int, about: Mapping[str, int]) -> dict[str, str]:
    return {kind: grid.text(row, column) for kind, column in about.items()}


def _entry(grid: Grid, row: int, about: Mapping[str, int], givens: Mapping[int, tuple[str, str]], task: Task) -> Entry:
    """Read one student."""
    said = _said(grid, row, about)
    variant = said.get("variant", "")
    if variant and variant not in task.variants:
        error = unknown("variant-unknown", variant, task.variants, task=task.id)
        raise LocatedError(grid.place(row, about["variant"]), error)
    settings = {}
    for column, (name, unit) in givens.items():
        text = grid.text(row, column)
        if text:
            settings[name] = f"{text} {unit}" if unit and re.fullmatch(r"[-−+0-9.,\s]+", text) else text
            try:
                task.givens[name].read(settings[name])
            except InputError as error:
                raise LocatedError(f"{grid.place(row, column)}, {name}", error) from error
    return Entry(Who.of(said), variant, settings, grid.place(row))


def variant_of_book(task: Task, book: str, digits: int = 1) -> str:
    """Return the variant by the last digits of a record book: the one of this number, else counted round.

    Raises
    ------
    InputError
        The record book has no such digits.

    >>> from kulman import load_task
    >>> variant_of_book(load_task("nau-slider-crank"), "АТ-2023/417")
    '7'
    """
    found = re.sub(r"\D", "", latin(book))[-digits:]
    if len(found) < digits:
        raise InputError("roster-book", text=quote(book), n=digits)
    names = [name for name in task.variants if name.isdigit()] or list(task.variants)
    by_number = {int(name): name for name in names if name.isdigit()}
    return by_number.get(int(found)) or names[int(found) % len(names)]
