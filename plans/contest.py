"""Speed against accuracy: what each method takes and errs, and which of them no other beats."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, TypeVar

from numpy.typing import NDArray

Array = NDArray[Any]
Clock = Callable[[], float]  # seconds
T = TypeVar("T")
ROUNDS = 3  # runs of a piece of work
ENOUGH = 0.05  # seconds of work that need no repeating


@dataclass(frozen=True, slots=True)
class Kind:
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


@dataclass(frozen=True, slots=True, eq=False)
class Contest:
    """Speed against accuracy of all methods: `places` of the driver at which they were compared."""

    kinds: tuple[Kind, ...]
    places: Array
    entries: tuple[Entry, ...]
    effort: Effort = FULL

    def of(self, kind: str) -> tuple[Entry, ...]:
        """Return the entries for one kind of quantities."""
        return tuple(entry for entry in self.entries if entry.kind == kind)

    def front(self, kind: str) -> tuple[Entry, ...]:
        """Return the entries that no other beats in both speed and accuracy, the slowest first."""
        timed = [e for e in self.of(kind) if e.seconds is not None and e.error is not None]
        found: list[Entry] = []
        for entry in sorted(timed, key=lambda e: (e.seconds, e.error)):
            if not found or (entry.error or 0.0) < (found[-1].error or 0.0):
                found.append(entry)
        return tuple(reversed(found))


def ran(work: Callable[[], T], clock: Clock) -> tuple[T, float]:
    """Return what a piece of work gives and what it takes, seconds; what takes long is not run again to be timed."""
    start = clock()
    found = work()
    spent = clock() - start
    return found, spent if spent > ENOUGH else timed(work, clock)


def timed(work: Callable[[], object], clock: Clock) -> float:
    """Return what a piece of work takes by a clock, seconds: the shortest of some runs."""
    best, total = float("inf"), 0.0
    for _ in range(ROUNDS):
        start = clock()
        work()
        spent = clock() - start
        best, total = min(best, spent), total + spent
        if total > ENOUGH * ROUNDS:
            break
    return best
