"""What takes long to make, kept for the next time it is asked for."""

from __future__ import annotations

import gc
import os
import pickle
import zlib
from collections.abc import Callable, Hashable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Generic, TypeVar

Made = TypeVar("Made")
COLLECTED = 200_000  # objects made anew after which garbage is looked for: 40 MB


def collect_seldom() -> tuple[int, int, int]:
    """Look for garbage less often, in this process and its copies, than is usual, which is returned.

    What is kept is gone through every time, and all that is young as soon as it is looked for as often as before.
    """
    usual = gc.get_threshold()
    gc.set_threshold(max(COLLECTED, usual[0]) if usual[0] else 0, *usual[1:])
    return usual


@contextmanager
def seldom_collected() -> Iterator[None]:
    """Look for garbage less often for a while."""
    usual = collect_seldom()
    try:
        yield
    finally:
        gc.set_threshold(*usual)


class Kept(Generic[Made]):
    """The last few things that were made, by what they were made from; the oldest goes first.

    >>> kept = Kept[str](most=2)
    >>> [kept.get(n, lambda: f"made of {n}") for n in (1, 1, 2)]
    ['made of 1', 'made of 1', 'made of 2']
    """

    def __init__(self, most: int) -> None:
        """Keep so many."""
        self.most = most
        self._made: dict[Hashable, Made] = {}

    def __contains__(self, key: Hashable) -> bool:
        """Return whether something is kept under a key."""
        return key in self._made

    def get(self, key: Hashable, make: Callable[[], Made]) -> Made:
        """Return what is kept under a key, or what `make` makes."""
        made = self._made.get(key)
        if made is None:
            made = make()
            if len(self._made) >= self.most:
                self._made.pop(next(iter(self._made)), None)
            self._made[key] = made
        return made


def kept_in(folder: Path, name: str, most: int, make: Callable[[], Made]) -> Made:
    """Return what is kept in a folder of our own under a name, for other processes, too, or what `make` makes.

    That is kept as long as all that is there takes no more than `most` bytes, and the disk has room.
    """
    file = folder / name
    with suppress(OSError):
        found: Made = pickle.loads(zlib.decompress(file.read_bytes()))
        return found
    made = make()
    data = zlib.compress(pickle.dumps(made), 1)
    with suppress(OSError):
        folder.mkdir(exist_ok=True)
        if sum(one.stat().st_size for one in folder.iterdir()) + len(data) <= most:
            part = folder / f"{name}.{os.getpid()}"
            part.write_bytes(data)
            part.replace(file)
    return made
