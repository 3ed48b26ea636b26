"""All ways in which one construction can go wrong, run: what each would give for every question of an answer key."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..hands.shaky import Paper
from ..marking.key import Key
from . import acceleration, cam_sizes, cams, forces, gears, inputs, lever, reading, velocity
from .angles import Turned
from .rules import Broken, Mistake, Scene, breaks, put_together
from .signatures import Columns, Signature, signature, signatures, signatures_after

__all__ = ["MISTAKES", "Book", "Signature", "book", "broken", "key_of", "signature", "signatures_after"]

CHAPTERS = (inputs, reading, velocity, acceleration, forces, lever, cams, cam_sizes, gears)
MISTAKES: dict[str, Mistake] = put_together(chapter.MISTAKES for chapter in CHAPTERS)


def broken(paper: Paper, values: Mapping[str, Any], ids: Iterable[str] = ()) -> Iterator[Broken]:
    """Go through every way in which a construction can go wrong; `ids` are the only mistakes, all when left out."""
    scene = Scene(paper, values)
    for id in sorted(ids or MISTAKES):
        yield from breaks(scene, MISTAKES[id])


@dataclass(frozen=True, eq=False)
class Book:
    """The signatures of all mistakes for one answer key; those that change nothing are left out.

    Parameters
    ----------
    table, most : complex128, float64 array of shape (mistakes, questions)
        Their rows and tolerances; `right`, `allowed` of shape (questions,) are those of the right construction.
    vector : bool array of shape (questions,)
        Which of them are vectors.
    turned : Turned
        The same construction at other angles of the crank.
    """

    key: Key
    signatures: tuple[Signature, ...]
    table: NDArray[np.complex128]
    most: NDArray[np.float64]
    right: NDArray[np.complex128]
    allowed: NDArray[np.float64]
    vector: NDArray[np.bool_]
    turned: Turned

    @cached_property
    def other(self) -> NDArray[np.float64]:
        """How many times larger what another way gives is than what the construction does, a mistake in it or none."""
        return np.array([_ratio(self.key, name) for name in self.key.questions])

    def __len__(self) -> int:
        """Return the number of signatures."""
        return len(self.signatures)

    def drawn_to(self, key: Key, mus: Mapping[str, float]) -> Book:
        """Return the book for a student's own scale factors, by plan: what hangs on them is run again.

        `key` is the key to which the answers were marked.
        """
        if key is self.key:
            return self
        ids = [id for id, mistake in MISTAKES.items() if mistake.by_scale]
        kept = [s for s in self.signatures if s.broken.mistake not in ids]
        paper = replace(key.paper, mus={**key.paper.mus, **mus})
        return _book(key, [*kept, *signatures(key, broken(paper, key.values, ids))], self.turned)


def book(key: Key) -> Book:
    """Run every mistake that concerns a key."""
    return _book(key, signatures(key, broken(key.paper, key.values)), Turned(key))


def _book(key: Key, found: Iterable[Signature], turned: Turned) -> Book:
    columns = Columns.of(key)
    ordered = sorted(found, key=lambda s: s.broken.mistake)
    shape = (len(ordered), len(columns.right))
    table, most = np.empty(shape, complex), np.empty(shape)
    for place, one in enumerate(ordered):
        table[place], most[place] = one.row, one.allowed
    return Book(key, tuple(ordered), table, most, columns.right, columns.allowed, columns.vector, turned)


def _ratio(key: Key, name: str) -> float:
    """Return by how much what another way gives differs from the construction, as a factor."""
    size = abs(key.values[name])
    return float(abs(key.also[name]) / size) if name in key.also and size else 1.0


def key_of(key: Key, signature: Signature) -> Key:
    """Return the answer key as if the broken rule were the right one, on either way."""
    allowed = dict(zip(key.questions, signature.allowed.tolist(), strict=True))
    paper = replace(key.paper, program=signature.broken.program, givens=signature.broken.givens)
    values = {**key.values, **signature.values}
    also = {name: values[name] * _ratio(key, name) for name in key.also}
    return replace(key, paper=paper, values=values, allowed={**key.allowed, **allowed}, also=also)
