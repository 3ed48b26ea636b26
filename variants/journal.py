"""What a long run has finished, a line each, so that a killed one can be gone on with."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Container, Iterable, Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any, Generic, TypeVar

from ..drawing.writers import refused, write_whole
from ..scales.errors import InputError

Result = TypeVar("Result")


class Journal(Generic[Result]):
    """The results of a run by the digests of what they were made from.

    Parameters
    ----------
    path : Path
        A file of JSON lines.
    load, dump : callable
        Results from plain data, and to plain data.
    """

    def __init__(
        self, path: Path, load: Callable[[Mapping[str, Any]], Result], dump: Callable[[Result], Mapping[str, Any]]
    ) -> None:
        self.path, self.dump = path, dump
        self.before: dict[str, Result] = {}
        self._torn = False
        with suppress(OSError):  # what cannot be read is made again
            text = path.read_bytes().decode("utf-8", "replace")
            self._torn = text[-1:] not in ("", "\n")  # the last line of a killed run
            for line in text.splitlines():
                with suppress(ValueError, KeyError, TypeError, AttributeError):  # torn, or no line of a journal
                    item = json.loads(line)
                    self.before[item["digest"]] = load(item["result"])

    def found(self, digest: str) -> Result | None:
        """Return what an earlier run has made of the same."""
        return self.before.get(digest)

    def note(self, digest: str, result: Result) -> None:
        """Keep a result.

        Raises
        ------
        InputError
            It cannot be written.
        """
        line = self._line(digest, result)
        with refused(self.path), self.path.open("ab") as stream:
            stream.write(f"\n{line}".encode("ascii") if self._torn else line.encode("ascii"))
        self._torn = False

    def keep(self, results: Iterable[tuple[str, Result]]) -> None:
        """Keep these results alone, for a run that comes later, each with its digest."""
        lines = (self._line(digest, result) for digest, result in results)
        with suppress(InputError):  # a folder that takes no note keeps what is there
            write_whole(self.path, "".join(lines).encode("ascii"))

    def _line(self, digest: str, result: Result) -> str:
        return json.dumps({"digest": digest, "result": self.dump(result)}, ensure_ascii=True) + "\n"

    def finish(self) -> None:
        """Forget: all is done."""
        with suppress(OSError):
            self.path.unlink()


def remove_stale(
    folder: Path, before: Iterable[tuple[str, str]], names: Container[str], suffixes: Container[str]
) -> None:
    """Remove files of earlier runs that belong to nobody any more.

    Parameters
    ----------
    before : iterable of (str, str)
        Names and digests of the files that earlier runs have noted as their own: what somebody has changed stays.
    names : container of str
        Files of this run.
    suffixes : container of str
        What kinds of files such runs write.
    """
    for name, digest in before:
        stale = folder / Path(name).name
        with suppress(OSError):
            if name not in names and stale.suffix in suffixes and digest_of(stale.read_bytes()) == digest:
                stale.unlink()


def digest_of(data: str | bytes) -> str:
    """Return what tells a text, or what a file holds, from any other."""
    whole = data.encode("utf-8", "surrogatepass") if isinstance(data, str) else data
    return hashlib.blake2s(whole, digest_size=12).hexdigest()
