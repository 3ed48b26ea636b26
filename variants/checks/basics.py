"""Checking what a task file holds: faults are collected with their places, which tomllib does not tell, not raised."""

from __future__ import annotations

import re
import time
import tomllib
from bisect import bisect_right
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any, TypeVar

from ...scales.errors import InputError, KulmanError, Written
from ...scales.names import cyrillic, latin, seen, unknown
from ...scales.numbers import quote
from ..task import LocatedError

MOST_FAULTS = 1000  # nobody reads more of them, and a file of a megabyte may hold a million
NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]*")
Path = tuple[str | int, ...]
Place = tuple[int, int]

_BLANK = re.compile(r"(?:[ \t\r\n]+|#[^\n]*)*")
_KEY = re.compile(r"""[ \t]*([A-Za-z0-9_-]+|"(?:[^"\\\n]|\\.)*"|'[^'\n]*')[ \t]*(\.?)""")
_STRING = re.compile(
    r'"""(?:[^"\\]|\\.|"(?!""))*"{3,5}' r"|'''(?:[^']|'(?!''))*'{3,5}" r'|"(?:[^"\\\n]|\\.)*"' r"|'[^'\n]*'", re.DOTALL
)
_SCALAR = re.compile(r"[^,\]}#\n]*")


class Places:
    """Line and column, from 1, of every key, array element and table of a text that tomllib has accepted.

    One pass over the text finds them; `at` is where it reads.
    """

    def __init__(self, text: str) -> None:
        self.text, self.at = text, 0
        self._offsets: dict[Path, int] = {}
        self._rows: dict[Path, int] = {}
        self._lines = [0, *(found.end() for found in re.finditer("\n", text))]
        table: Path = ()
        self.skip(_BLANK)
        while self.at < len(text):
            if text[self.at] == "[":
                table = self.header()
            else:
                self.assignment(table)
            self.skip(_BLANK)

    def __contains__(self, path: Path) -> bool:
        """Tell whether `path` stands in the file."""
        return path in self._offsets

    def __getitem__(self, path: Path) -> Place:
        """Return the place of `path`, or of the innermost table around it that stands in the file."""
        while path and path not in self._offsets:
            path = path[:-1]
        offset = self._offsets.get(path, 0)
        line = bisect_right(self._lines, offset)
        return line, offset - self._lines[line - 1] + 1

    def skip(self, what: re.Pattern[str]) -> None:
        """Move over what begins here; it may be blank."""
        found = what.match(self.text, self.at)
        self.at = found.end() if found else len(self.text)

    def key(self) -> list[tuple[str, int]]:
        """Read a dotted key: its parts and where each begins."""
        parts, dotted = [], True
        while dotted:
            found = _KEY.match(self.text, self.at)
            if found is None:
                raise ValueError(f"no key at offset {self.at}")
            part = found[1]
            name = tomllib.loads(f"k = {part}")["k"] if part[0] in "\"'" else part
            parts.append((name, found.start(1)))
            dotted = bool(found[2])
            self.at = found.end()
        return parts

    def header(self) -> Path:
        """Read `[table]` or `[[table]]`; a name on the way that is an array of tables means its last row."""
        start = self.at
        array = self.text.startswith("[[", start)
        self.at += 2 if array else 1
        parts = self.key()
        self.at = self.text.index("]", self.at) + (2 if array else 1)
        path: Path = ()
        for i, (name, _) in enumerate(parts):
            path += (name,)
            if array and i == len(parts) - 1:
                self._rows[path] = self._rows.get(path, -1) + 1
            self._offsets.setdefault(path, start)
            if path in self._rows:
                path += (self._rows[path],)
                self._offsets.setdefault(path, start)
        return path

    def assignment(self, table: Path) -> None:
        """Read `key = value` under `table`."""
        path = table
        for name, start in self.key():
            path += (name,)
            self._offsets.setdefault(path, start)
        self.at = self.text.index("=", self.at) + 1
        self.value(path)

    def value(self, path: Path) -> None:
        """Move over one value and note what it holds, where it is an array or an inline table."""
        self.skip(_BLANK)
        first = self.text[self.at]
        if first not in "[{":
            self.skip(_STRING if first in "\"'" else _SCALAR)
            return
        self.at, index = self.at + 1, 0
        self.skip(_BLANK)
        while self.text[self.at] not in "]}":
            if first == "{":
                self.assignment(path)
            else:
                self._offsets[(*path, index)] = self.at
                self.value((*path, index))
            index += 1
            self.skip(_BLANK)
            if self.text[self.at] == ",":
                self.at += 1
                self.skip(_BLANK)
        self.at += 1


class EnoughError(Exception):
    """There are so many faults that looking for more helps nobody."""


@dataclass(slots=True)
class Checker:
    """The faults of one file so far."""

    file: str
    places: Places
    faults: list[tuple[int, int, InputError]] = field(default_factory=list)
    remarks: list[tuple[int, int, InputError]] = field(default_factory=list)  # what is no fault, and worth knowing
    faulty: set[Path] = field(default_factory=set)  # where the faults are
    begun: float = field(default_factory=time.process_time)  # seconds of processor time when the reading began
    unread: set[str] = field(default_factory=set)  # givens and diagrams at fault: that others name them is no fault

    def fault(self, path: Path, error: KulmanError, *variant: str) -> None:
        """Note `error` at `path`; the keys of the path go before its message, and the `variant` that has shown it."""
        self.faulty.add(path)
        self.faults.append(self._located(path, error, *variant))
        if len(self.faults) >= MOST_FAULTS:
            raise EnoughError

    @contextmanager
    def at(self, path: Path) -> Iterator[None]:
        """Note why what is done with the value at `path` is refused."""
        try:
            yield
        except InputError as error:
            self.fault(path, error)

    def remark(self, path: Path, error: InputError, variant: str) -> None:
        """Note what solving a variant, whose table is at `path`, has shown, and what is no fault."""
        self.remarks.append(self._located(path, error, variant))

    def table(self, path: Path, raw: object) -> dict[str, Any]:
        """Return a table; what is none is a fault, and an empty one."""
        if isinstance(raw, dict):
            return raw
        self.fault(path, InputError("type-table"))
        return {}

    def _located(self, path: Path, error: KulmanError, *more: str) -> tuple[int, int, InputError]:
        """Return line and column of a path, and an error with its place before it."""
        line, column = self.places[path]
        keys = ".".join((*(str(part) for part in path if isinstance(part, str)), *more))
        place = f"{self.file}:{line}:{column}"
        return line, column, LocatedError(f"{place}: {quote(keys)}" if keys else place, error)

    def twice(self, path: Path, name: object, first: Path) -> None:
        """Note that `name` stands at `path` again, after it stood at `first`."""
        self.fault(path, InputError("id-twice", name=quote(name), line=self.places[first][0]))


Read = Callable[[Checker, Path, Any], Any]
Made = TypeVar("Made")


@dataclass(frozen=True, slots=True)
class Field:
    """How a key is read, and whether it must be there."""

    read: Read
    required: bool = True


def record(checker: Checker, path: Path, raw: object, fields: Mapping[str, Field]) -> dict[str, Any]:
    """Read a table with fixed keys; a key that is missing, unknown or unreadable is a fault and left out."""
    before, raw = len(checker.faults), checker.table(path, raw)
    if len(checker.faults) > before:
        return {}
    missing = [name for name, wanted in fields.items() if wanted.required and name not in raw]
    for name in raw:
        if name not in fields:
            error = unknown("key-unknown", name, fields)
            checker.fault((*path, name), error)
            # A misspelt key is one fault, not an unknown key and a missing one.
            missing = [other for other in missing if other != error.data.get("like")]
    for name in missing:
        checker.fault(path, InputError("key-missing", name=name))
    read = {name: wanted.read(checker, (*path, name), raw[name]) for name, wanted in fields.items() if name in raw}
    return {name: value for name, value in read.items() if value is not None}


def trying(read: Callable[[Any], Any]) -> Read:
    """Return a reader that notes why what it reads is refused."""

    def read_value(checker: Checker, path: Path, raw: object) -> Any:
        with checker.at(path):
            return read(raw)
        return None

    return read_value


def as_is(checker: Checker, path: Path, raw: object) -> Any:
    """Leave a value to be read later, by its own reader."""
    return raw


@trying
def text(raw: object) -> str:
    """Read a string that is not blank."""
    if isinstance(raw, str) and seen(raw).strip():
        return seen(raw)
    raise InputError("type-text")


def name(checker: Checker, path: Path, raw: object) -> str | None:
    """Read a name: an ASCII letter, then letters, digits and underscores."""
    if isinstance(raw, str) and NAME.fullmatch(raw):
        return raw
    if isinstance(raw, str) and NAME.fullmatch(latin(raw)):
        checker.fault(path, cyrillic(raw))
    else:
        checker.fault(path, InputError("type-name", text=quote(raw)))
    return None


def word(checker: Checker, path: Path, raw: object) -> str | None:
    """Read a word of a choice: a name in which hyphens may stand, too."""
    if isinstance(raw, str) and name(checker, path, raw.replace("-", "_")) is not None:
        return raw
    return None if isinstance(raw, str) else name(checker, path, raw)


@trying
def label(raw: object) -> str:
    """Read an id of a task or variant: something to type on a command line."""
    if isinstance(raw, str) and re.fullmatch(r"\w[\w.-]*", raw):
        return raw
    raise InputError("type-id")


@trying
def whole_number(raw: object) -> int:
    """Read a whole number from 0 to 99: of a link, where 0 is the frame, or of a task."""
    if isinstance(raw, int) and not isinstance(raw, bool) and 0 <= raw < 100:
        return raw
    raise InputError("type-whole-number")


def array_of(read: Read, length: int | None = None) -> Read:
    """Return a reader of arrays: of `length` items, or of any number but none."""

    def read_array(checker: Checker, path: Path, raw: object) -> tuple[Any, ...] | None:
        if not isinstance(raw, list) or (len(raw) != length if length else not raw):
            checker.fault(path, InputError("type-array", n=length or "1, 2, …"))
            return None
        items = tuple(read(checker, (*path, i), item) for i, item in enumerate(raw))
        return None if None in items else items

    return read_array


def one_of(key: str, known: Callable[[], tuple[str, ...]]) -> Read:
    """Return a reader of a word out of `known`; `key` is the message for another."""

    def read_word(checker: Checker, path: Path, raw: object) -> str | None:
        if not isinstance(raw, str):
            checker.fault(path, InputError("type-text"))
        elif raw not in known():
            checker.fault(path, unknown(key, raw, known()))
        else:
            return raw
        return None

    return read_word


def rows(checker: Checker, path: Path, raw: object) -> list[tuple[Path, object]]:
    """Return the tables of an array of tables with their paths."""
    if not isinstance(raw, list) or not raw:
        heading = Written(f"[[{'.'.join(str(part) for part in path if isinstance(part, str))}]]")
        checker.fault(path, InputError("type-tables", cure=heading))
        return []
    return [((*path, i), row) for i, row in enumerate(raw)]
