"""Files that somebody hands in, read in a process of its own, whose time and memory are bounded.

Forms of a PDF may hold forms, streams and pictures unpack into more than memory holds: it is that process that dies.
"""

from __future__ import annotations

import atexit
from collections.abc import Callable
from functools import cache
from threading import Thread
from time import process_time
from typing import Any

from ...scales.errors import InputError
from .marks import FaultError

MEMORY = 800_000_000  # bytes of that process
PATIENCE, BEAT = 60.0, 0.02  # s, for a process to begin or to end; between looks at its time


def apart(begin: Callable[..., None], read: Callable[[bytes], Any], data: bytes, seconds: float) -> Any:
    """Return what `read` makes of data within so many seconds of the processor, after `begin` has loaded what it needs.

    Raises
    ------
    FaultError
        With the key that `read` returns where it makes nothing of them; it takes too long or too much memory.
    ValueError
        It fails in any other way.
    """
    from ..serving.jobs import CrashError

    try:
        seat = _seat()
        seat.do(begin, (), PATIENCE, lambda done, whole: None)
        found = seat.do(_bounded, (read, data, seconds), PATIENCE, lambda done, whole: None)
    except InputError as error:
        raise error if error.key.endswith("-missing") else FaultError("drawing-late") from None
    except CrashError:
        raise ValueError from None
    if isinstance(found, str):
        if found == "drawing-late":  # it is still at it
            seat.stop()
        raise FaultError(found)
    return found


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


def _bounded(advance: Any, read: Callable[[bytes], Any], data: bytes, seconds: float) -> Any:
    """Return what `read` does, or the key that it takes too long: of the processor's time, however busy that is."""
    found: list[Any] = []
    worker = Thread(target=lambda: found.append(read(data)), daemon=True)
    until = process_time() + seconds
    worker.start()
    while worker.is_alive() and process_time() < until:
        worker.join(BEAT)
    if worker.is_alive():
        return "drawing-late"
    return found[0] if found else "drawing-broken"
