"""What broken constructions give: of each only what differs is run again, and all of them are compared at once."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from operator import itemgetter
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..board import Prepared, prepared
from ..boards.exact import SMALL, ExactBoard
from ..hands.shaky import Paper
from ..hands.tolerances import tolerances
from ..marking.key import Key
from .rules import Broken

NOTHING = 1e-9  # part of a tolerance that is rounding
FLATTER = 0.7  # of the flattest angle of the right construction: lines meet more flatly than they should
UNDRAWN = 1e-9  # scale factor of what is only calculated, SI per mm


@dataclass(frozen=True, slots=True, eq=False)
class Signature:
    """What one broken construction gives for each question, in their order; NaN where it gives nothing.

    `allowed` are the tolerances of a hand that draws it so: what is larger than it should be misses more, and so does
    all that follows from lines that meet more flatly than they should.
    """

    broken: Broken
    values: Mapping[str, Any]
    sines: Mapping[str, float]
    row: NDArray[np.complex128]
    allowed: NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Columns:
    """The right values and tolerances of a key in the order of its questions."""

    right: NDArray[np.complex128]
    allowed: NDArray[np.float64]
    vector: NDArray[np.bool_]

    @classmethod
    def of(cls, key: Key) -> Columns:
        """Return the columns of a key."""
        right = np.array([key.values[name] for name in key.questions], complex)
        allowed = np.array([key.allowed[name] for name in key.questions])
        vector = np.array([question.vector for question in key.questions.values()])
        return cls(right, allowed, vector)


def signature(key: Key, found: Broken) -> Signature | None:
    """Run the right construction with a rule broken; None where it cannot be drawn."""
    return next(_made(key, (found,), Columns.of(key)), None)


def signatures_after(key: Key, last: Signature | None, found: Iterable[Broken]) -> Iterator[Signature]:
    """Run constructions in which one that is broken already, or the right one, is broken once more; go through them."""
    return _made(key, found, Columns.of(key), last)


def signatures(key: Key, found: Iterable[Broken]) -> Iterator[Signature]:
    """Run broken constructions, and go through what they give; those that change nothing are left out."""
    columns = Columns.of(key)
    rounding = NOTHING * columns.allowed + 1e-12 * np.abs(columns.right)
    for made in _made(key, found, columns):
        with np.errstate(invalid="ignore"):  # of values beyond all floats
            same = bool((np.abs(made.row - columns.right) <= rounding).all())
        if not same:
            yield made


def _made(key: Key, found: Iterable[Broken], columns: Columns, last: Signature | None = None) -> Iterator[Signature]:
    runs = [(one, board) for one in found if (board := _run(key, one, last)) is not None]
    asked = itemgetter(*key.questions) if len(key.questions) > 1 else lambda values: [values[n] for n in key.questions]
    rows = np.array([asked(board.values) for _, board in runs], complex).reshape(len(runs), len(key.questions))
    sizes = np.abs(columns.right)
    with np.errstate(all="ignore"):
        times = np.where((sizes > 0.0) & ~np.isnan(rows), np.abs(rows) / sizes, 1.0)
    table = columns.allowed * np.maximum(1.0, times)
    flattest = min(key.sines.values(), default=1.0)
    for (one, board), row, most in zip(runs, rows, table, strict=True):
        flat = min(board.sines.values(), default=1.0)
        if 0.0 < flat < SMALL and flat < FLATTER * flattest:
            most = _wider(key, one, board, most)
        yield Signature(one, board.values, board.sines, row, most)


def _wider(key: Key, found: Broken, board: ExactBoard, most: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the tolerances of a construction whose lines meet more flatly than they should."""
    mus = {plan: key.paper.mus.get(plan, UNDRAWN) for plan in found.program.plans}
    again = tolerances(Paper(found.program, found.givens, mus), board.values, board.sines, key.tolerance)
    wider = np.array([again[name] for name in key.questions])
    return np.where(np.isnan(wider), most, np.maximum(most, wider))


def _run(key: Key, found: Broken, last: Signature | None) -> ExactBoard | None:
    """Run what is different in a broken construction, and all that hangs on it; the rest is as in the one before it.

    None where lines are parallel, arcs do not reach, or a number is out of range: nobody goes on from there.
    """
    before = key if last is None else last
    givens = key.paper.givens if last is None else last.broken.givens
    changed = [name for name, value in found.givens.items() if name not in givens or givens[name] is not value]
    board = ExactBoard({})
    board.values = {**before.values}
    board.values.update((name, found.givens[name]) for name in changed)
    board.sines.update(before.sines)
    try:
        board.do(_at_once(found, changed))
    except (ZeroDivisionError, OverflowError):
        return None
    return board if board.trouble is None else None


def _at_once(found: Broken, changed: Iterable[str]) -> Iterable[Prepared]:
    """Return the steps that are other ones, and those that hang on them or on changed data."""
    before, bits, replaced = found.before, 0, 0
    hanging, places = before.hanging, before.places
    for name in changed:
        bits |= hanging.get(name, 0)
    for name, steps in found.steps.items():
        if name in places:
            replaced |= 1 << places[name]
            for step in steps:
                bits |= hanging.get(step.name, 0)
    if not replaced:
        return before.at(bits)
    if not bits & ((replaced & -replaced) - 1) and len(found.steps) == 1:  # what hangs on one step comes after it
        return (*map(prepared, *found.steps.values()), *before.at(bits & ~replaced))
    new = {name: tuple(map(prepared, steps)) for name, steps in found.steps.items()}
    return [step for one in before.at(bits | replaced) for step in new.get(one[0].name, (one,))]
