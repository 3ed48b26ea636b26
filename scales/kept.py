"""What takes long to make, kept for the next time it is asked for."""

from __future__ import annotations

import gc
from collections.abc import Callable, Hashable, Iterator
from contextlib import contextmanager
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
