"""Files that somebody hands in: read as far as a bound, and in a process of its own, whose time and memory are bounded.

Forms of a PDF may hold forms, streams and pictures unpack into more than memory holds: it is that process that dies.
"""

from __future__ import annotations

import atexit
import os
from collections import deque
from collections.abc import Callable, Iterable
from functools import cache
from pathlib import Path
from threading import Thread
from time import process_time
from typing import Any

from ...scales.errors import InputError
from ...scales.numbers import SHOWN, quote
from .marks import FaultError

MEMORY = 800_000_000  # bytes of that process
PATIENCE, BEAT = 60.0, 0.02  # s, for a process to begin or to end; between looks at its time
_ALL = object()  # comes after the last part
LONGEST = 3600.0  # s, until a process is given up that does nothing, however busy the machine is


def handed_in(file: str | os.PathLike[str], largest: int, other: str) -> tuple[bytes, str, str]:
    """Return what a file holds, one byte more than the `largest` at the most, its name as it is shown, its suffix.

    Raises InputError: there is no such file, it cannot be read, or it is a folder or a device: the key `other` says so.
    """
    path = Path(file)
    shown = quote(path, SHOWN)
    try:
        if path.is_file() or not path.exists():
            with path.open("rb") as stream:
                return stream.read(largest + 1), shown, path.suffix.lower()
    except FileNotFoundError:
        raise InputError("file-missing", file=shown) from None
    except (OSError, ValueError):
        raise InputError("file-unreadable", file=shown) from None
    raise InputError(other, file=shown)


def apart(
    begin: Callable[..., None], read: Callable[[bytes], Iterable[Any]], data: bytes, seconds: float, more: float = 1.0
) -> list[Any]:
    """Return the parts that `read` goes through, after `begin` has loaded what it needs.

    It has so many seconds of the processor for the first part, then `more` from each part to the next.

    Raises
    ------
    FaultError
        With the key that `read` gives in the place of a part where something is wrong; it takes too long or too much
        memory.
    ValueError
        It fails in any other way.
    """
    from ..serving.jobs import CrashError

    parts = dict[int, Any]()
    try:
        seat = _seat()
        seat.do(begin, (), PATIENCE, lambda done, whole: None)
        wrong = seat.do(_bounded, (read, data, seconds, more), LONGEST, parts.__setitem__)
    except InputError as error:
        raise error if error.key.endswith("-missing") else FaultError("drawing-late") from None
    except CrashError:
        raise ValueError from None
    if wrong:
        if wrong == "drawing-late":  # it is still at it
            seat.stop()
        raise FaultError(wrong)
    return [parts[number] for number in sorted(parts)]


@cache
def _seat() -> Any:
    """Return the process that reads one file after the other, begun when there is one."""
    from ..serving.jobs import Home, Seat

    home = Home()
    seat = Seat(home.path / "apart", MEMORY)

    def end() -> None:
        seat.stop()
        home.remove()

    atexit.register(end)
    return seat


def _bounded(
    give: Callable[[int, Any], None], read: Callable[[bytes], Iterable[Any]], data: bytes, seconds: float, more: float
) -> str:
    """Give the parts of what is read, and return the key of what is wrong: that it takes too long, or what `read` says.

    The processor's time counts, however busy that is.
    """
    parts, given = deque[tuple[Any, float]](), 0

    def work() -> None:
        for part in read(data):
            parts.append((part, process_time()))
        parts.append((_ALL, process_time()))

    worker = Thread(target=work, daemon=True)
    until = process_time() + seconds
    worker.start()
    while worker.is_alive() or parts:
        if not parts:
            if process_time() >= until:
                return "drawing-late"
            worker.join(BEAT)
            continue
        part, at = parts.popleft()
        if at >= until:  # however late it is looked at
            return "drawing-late"
        if part is _ALL:
            return ""
        if isinstance(part, str):
            return part
        give(given, part)
        given, until = given + 1, at + more
    return "drawing-broken"
