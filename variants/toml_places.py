"""Where each key of a TOML file stands, which tomllib does not tell: `("variant", 3, "l_OA")` -> line and column."""

from __future__ import annotations

import re
import tomllib
from bisect import bisect_right

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
        """Move over one value and note what it holds."""
        self.skip(_BLANK)
        first = self.text[self.at]
        if first in "[{":
            self.items(path, "]" if first == "[" else "}")
        else:
            self.skip(_STRING if first in "\"'" else _SCALAR)

    def items(self, path: Path, closing: str) -> None:
        """Move over an array or an inline table."""
        self.at, index = self.at + 1, 0
        self.skip(_BLANK)
        while self.text[self.at] != closing:
            if closing == "}":
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
