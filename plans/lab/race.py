"""Speed against accuracy: what each method takes and errs, and which of them no other beats.

A race is rivals, each with a setting: the errors of its quantities at places of the driver, and its time, by one clock.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]
Clock = Callable[[], float]  # seconds
T = TypeVar("T")
ROUNDS = 3  # runs of a piece of work
ENOUGH = 0.004  # seconds of work that need no repeating
SEED = 1  # the same hand on every paper


@dataclass(frozen=True, slots=True)
class Discipline:
    """Quantities of one kind: `velocity`, `acceleration` or `forces` of a linkage, `travel` or `velocity` of a cam."""

    name: str
    names: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Effort:
    """What times are measured on: the sizes of batches of plans, and the positions at once of all other methods."""

    batches: tuple[int, ...] = (1, 10, 100, 1_000, 10_000, 100_000, 1_000_000)
    at_once: int = 10_000


FULL = Effort()


@dataclass(frozen=True, slots=True)
class Entry:
    """One method with its setting, for quantities of one kind."""

    method: str  # `plan`, `plan-single`, `plan-extended`, `newton`, `differences`, `chords` or `hand`
    setting: float | str  # positions in a batch, tolerance, step (rad), sections of the cycle, or a hand's paper
    kind: str
    error: float | None  # the worst one over all positions and quantities
    typical: float | None  # the median over positions of the worst quantity
    name: str  # the quantity whose error is worst
    place: float  # of the driver, where it is
    seconds: float | None  # processor time per position; None for a hand
    at_once: int  # positions in a batch
    failed: float  # part of the positions where the method gives nothing


@dataclass(frozen=True, slots=True)
class Way:
    """A method with its setting, and what it takes: `seconds` a position, None for a hand, of so many `at_once`."""

    method: str
    setting: float | str
    seconds: float | None = None
    at_once: int = 1

    def entry(self, kind: str, places: Array, errors: Mapping[str, Array]) -> Entry:
        """Sum up errors of quantities, by name, at all places; NaN where the method gives nothing."""
        filled = np.stack([np.where(np.isnan(error), -1.0, error) for error in errors.values()])
        worst = filled.max(axis=0)
        row, column = np.unravel_index(np.argmax(filled), filled.shape)
        there = worst >= 0.0
        error, typical = (float(of(worst[there])) if there.any() else None for of in (np.max, np.median))
        of_worst = [*errors][row], float(places[column]), self.seconds, self.at_once
        return Entry(self.method, self.setting, kind, error, typical, *of_worst, float(1.0 - there.mean()))


@dataclass(frozen=True, slots=True, eq=False)
class Contest:
    """Speed against accuracy of all methods: `places` of the driver at which they were compared."""

    kinds: tuple[Discipline, ...]
    places: Array
    entries: tuple[Entry, ...]
    effort: Effort = FULL

    def of(self, kind: str) -> tuple[Entry, ...]:
        """Return the entries for one kind of quantities."""
        return tuple(entry for entry in self.entries if entry.kind == kind)

    def front(self, kind: str) -> tuple[Entry, ...]:
        """Return the entries that no other beats in both speed and accuracy, the slowest first."""
        timed = [e for e in self.of(kind) if e.seconds is not None and e.error is not None]
        front: list[Entry] = []
        for entry in sorted(timed, key=lambda e: (e.seconds, e.error)):
            if not front or (entry.error or 0.0) < (front[-1].error or 0.0):
                front.append(entry)
        return tuple(reversed(front))


def timed(work: Callable[[], T], clock: Clock) -> tuple[T, float]:
    """Return what a piece of work gives, and what it takes by a clock, seconds: the shortest of some runs."""
    best, total = float("inf"), 0.0
    for _ in range(ROUNDS):
        start = clock()
        result = work()
        spent = clock() - start
        best, total = min(best, spent), total + spent
        if total > ENOUGH:
            break
    return result, best
