"""All ways in which one construction can go wrong, run: what each would give for every question of an answer key."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..exact import run
from ..marking.key import Key
from ..shaky import Paper
from . import acceleration, forces, inputs, lever, reading, velocity
from .rules import MISTAKES, Broken, Scene, breaks

CHAPTERS = {
    module.__name__.rpartition(".")[2]: module for module in (inputs, reading, velocity, acceleration, forces, lever)
}
NOTHING = 1e-9  # part of a tolerance that is rounding


def broken(paper: Paper, values: Mapping[str, Any], ids: Iterable[str] = ()) -> Iterator[Broken]:
    """Go through every way in which a construction can go wrong; `ids` are the only mistakes, all when left out."""
    scene = Scene(paper, values)
    for id in sorted(ids or MISTAKES):
        yield from breaks(scene, id)


@dataclass(frozen=True, slots=True, eq=False)
class Signature:
    """What one broken construction gives for each question, in their order; NaN where it gives nothing."""

    broken: Broken
    values: Mapping[str, Any]
    row: NDArray[np.complex128]


@dataclass(frozen=True, slots=True, eq=False)
class Book:
    """The signatures of all mistakes for one answer key; those that change nothing are left out.

    Parameters
    ----------
    table : complex128 array of shape (mistakes, questions)
        Their rows; `right` of shape (questions,) is that of the right construction, `allowed` the tolerances.
    vector : bool array of shape (questions,)
        Which of them are vectors.
    """

    key: Key
    signatures: tuple[Signature, ...]
    table: NDArray[np.complex128]
    right: NDArray[np.complex128]
    allowed: NDArray[np.float64]
    vector: NDArray[np.bool_]

    def __len__(self) -> int:
        """Return the number of signatures."""
        return len(self.signatures)

    def drawn_to(self, key: Key) -> Book:
        """Return the book for a student's own scales: what hangs on them is run again."""
        if key is self.key:
            return self
        ids = [id for id, mistake in MISTAKES.items() if mistake.by_scale]
        kept = [s for s in self.signatures if s.broken.mistake not in ids]
        return _book(key, [*kept, *_signatures(key, broken(key.paper, key.values, ids))])


def book(key: Key) -> Book:
    """Run every mistake that concerns a key."""
    return _book(key, list(_signatures(key, broken(key.paper, key.values))))


def signature(key: Key, found: Broken) -> Signature | None:
    """Run a broken construction; None where it cannot be drawn, or changes nothing that is asked."""
    try:
        board = run(found.program, found.givens)
    except (ZeroDivisionError, OverflowError):
        return None
    row = np.array([complex(board.values[name]) for name in key.questions])
    if board.trouble is not None and np.isnan(row).mean() > 0.5:
        return None
    return Signature(found, board.values, row)


def _signatures(key: Key, found: Iterable[Broken]) -> Iterator[Signature]:
    right, allowed, _ = _columns(key)
    for one in found:
        made = signature(key, one)
        if made is None:
            continue
        changed = ~(np.abs(made.row - right) <= NOTHING * allowed + 1e-12 * np.abs(right))
        if changed.any():
            yield made


def _columns(key: Key) -> tuple[NDArray[np.complex128], NDArray[np.float64], NDArray[np.bool_]]:
    names = list(key.questions)
    right = np.array([complex(key.values[name]) for name in names])
    allowed = np.array([key.allowed[name] for name in names])
    return right, allowed, np.array([key.questions[name].vector for name in names])


def _book(key: Key, signatures: list[Signature]) -> Book:
    right, allowed, vector = _columns(key)
    ordered = sorted(signatures, key=lambda s: s.broken.mistake)
    table = np.array([s.row for s in ordered]) if ordered else np.empty((0, len(right)), complex)
    return Book(key, tuple(ordered), table, right, allowed, vector)


def key_of(key: Key, signature: Signature) -> Key:
    """Return the answer key as if the broken rule were the right one."""
    values, allowed = signature.values, {}
    for name, most in key.allowed.items():
        size = abs(key.values[name])
        allowed[name] = most * max(1.0, abs(values[name]) / size) if size and values[name] == values[name] else most
    paper = replace(key.paper, program=signature.broken.program, givens=signature.broken.givens)
    return replace(key, paper=paper, values={**key.values, **values}, allowed=allowed)
