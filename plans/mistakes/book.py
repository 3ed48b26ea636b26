"""All ways in which one construction can go wrong, run: what each would give for every question of an answer key."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..boards.exact import SMALL, ExactBoard
from ..hands.shaky import Paper
from ..hands.tolerances import tolerances
from ..marking.key import Key
from . import acceleration, forces, inputs, lever, reading, velocity
from .angles import Turned
from .rules import Broken, Mistake, Scene, breaks

CHAPTERS = (inputs, reading, velocity, acceleration, forces, lever)
MISTAKES: dict[str, Mistake] = {id: found for chapter in CHAPTERS for id, found in chapter.MISTAKES.items()}
NOTHING = 1e-9  # part of a tolerance that is rounding
FLATTER = 0.7  # of the flattest angle of the right construction: lines meet more flatly than they should
UNDRAWN = 1e-9  # scale factor of what is only calculated, SI per mm


def broken(paper: Paper, values: Mapping[str, Any], ids: Iterable[str] = ()) -> Iterator[Broken]:
    """Go through every way in which a construction can go wrong; `ids` are the only mistakes, all when left out."""
    scene = Scene(paper, values)
    for id in sorted(ids or MISTAKES):
        yield from breaks(scene, MISTAKES[id])


@dataclass(frozen=True, slots=True, eq=False)
class Signature:
    """What one broken construction gives for each question, in their order; NaN where it gives nothing.

    `allowed` are the tolerances of a hand that draws it so: what is larger than it should be misses more, and so does
    all that follows from lines that meet more flatly than they should.
    """

    broken: Broken
    values: Mapping[str, Any]
    row: NDArray[np.complex128]
    allowed: NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
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

    def __len__(self) -> int:
        """Return the number of signatures."""
        return len(self.signatures)

    def drawn_to(self, key: Key) -> Book:
        """Return the book for a student's own scales: what hangs on them is run again."""
        if key is self.key:
            return self
        ids = [id for id, mistake in MISTAKES.items() if mistake.by_scale]
        kept = [s for s in self.signatures if s.broken.mistake not in ids]
        return _book(key, [*kept, *_signatures(key, broken(key.paper, key.values, ids))], self.turned)


def book(key: Key) -> Book:
    """Run every mistake that concerns a key."""
    return _book(key, list(_signatures(key, broken(key.paper, key.values))), Turned(key))


def signature(key: Key, found: Broken, columns: Columns | None = None) -> Signature | None:
    """Run a broken construction; None where it cannot be drawn. `columns` are those of the key, if they are there."""
    columns = columns or Columns.of(key)
    try:
        board = _run_again(key, found, columns.steps)
    except (ZeroDivisionError, OverflowError):
        return None
    if board.trouble is not None:
        return None  # lines that are parallel, or arcs that do not reach: nobody goes on from there
    row = np.array([board.values[name] for name in key.questions], complex)
    return Signature(found, board.values, row, _allowed(key, found, board, row, columns))


@dataclass(frozen=True, slots=True, eq=False)
class Columns:
    """The right values and tolerances of a key in the order of its questions, and the identities of its steps."""

    right: NDArray[np.complex128]
    allowed: NDArray[np.float64]
    vector: NDArray[np.bool_]
    steps: frozenset[int]

    @classmethod
    def of(cls, key: Key) -> Columns:
        """Return the columns of a key."""
        names = list(key.questions)
        right = np.array([key.values[name] for name in names], complex)
        allowed = np.array([key.allowed[name] for name in names])
        vector = np.array([key.questions[name].vector for name in names])
        return cls(right, allowed, vector, frozenset(map(id, key.paper.program)))


def _run_again(key: Key, found: Broken, same: frozenset[int]) -> ExactBoard:
    """Run what is different in a broken construction, and all that hangs on it; the rest is as in the right one."""
    givens = key.paper.givens
    changed = {name for name, value in found.givens.items() if name not in givens or givens[name] is not value}
    board = ExactBoard({**key.values, **{name: found.givens[name] for name in changed}})
    board.sines |= key.sines
    for step in found.program:
        if id(step) not in same or not changed.isdisjoint(step.operands):
            board.step(step.verb, step.name, *step.operands, law=step.law)
            changed.add(step.name)
    return board


def _allowed(
    key: Key, found: Broken, board: ExactBoard, row: NDArray[np.complex128], columns: Columns
) -> NDArray[np.float64]:
    sizes = np.abs(columns.right)
    with np.errstate(all="ignore"):
        times = np.where((sizes > 0.0) & ~np.isnan(row), np.abs(row) / sizes, 1.0)
    most = columns.allowed * np.maximum(1.0, times)
    flattest = min(board.sines.values(), default=1.0)
    if 0.0 < flattest < SMALL and flattest < FLATTER * min(key.sines.values(), default=1.0):
        mus = {plan: key.paper.mus.get(plan, UNDRAWN) for plan in found.program.plans}
        again = tolerances(Paper(found.program, found.givens, mus), board.values, board.sines, key.tolerance)
        wider = np.array([again[name] for name in key.questions])
        most = np.where(np.isnan(wider), most, np.maximum(most, wider))
    return most


def _signatures(key: Key, found: Iterable[Broken]) -> Iterator[Signature]:
    columns = Columns.of(key)
    rounding = NOTHING * columns.allowed + 1e-12 * np.abs(columns.right)
    for one in found:
        made = signature(key, one, columns)
        if made is not None and not (np.abs(made.row - columns.right) <= rounding).all():
            yield made


def _book(key: Key, signatures: list[Signature], turned: Turned) -> Book:
    columns = Columns.of(key)
    ordered = sorted(signatures, key=lambda s: s.broken.mistake)
    shape = (len(ordered), len(columns.right))
    table, most = np.empty(shape, complex), np.empty(shape)
    for place, one in enumerate(ordered):
        table[place], most[place] = one.row, one.allowed
    return Book(key, tuple(ordered), table, most, columns.right, columns.allowed, columns.vector, turned)


def key_of(key: Key, signature: Signature) -> Key:
    """Return the answer key as if the broken rule were the right one."""
    allowed = dict(zip(key.questions, signature.allowed.tolist(), strict=True))
    paper = replace(key.paper, program=signature.broken.program, givens=signature.broken.givens)
    return replace(key, paper=paper, values={**key.values, **signature.values}, allowed={**key.allowed, **allowed})
