"""What takes long to make, kept for the next time it is asked for."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from typing import Generic, TypeVar

Made = TypeVar("Made")


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

    def get(self, key: Hashable, make: Callable[[], Made]) -> Made:
        """Return what is kept under a key, or what `make` makes."""
        made = self._made.get(key)
        if made is None:
            made = make()
            if len(self._made) >= self.most:
                self._made.pop(next(iter(self._made)), None)
            self._made[key] = made
        return made
