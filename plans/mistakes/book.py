"""The book of mistakes: every way in which one construction can go wrong, run, and what it gives for every question.

Of a broken construction only what differs is run again, and all of them are compared at once.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from operator import itemgetter
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..board import Prepared, prepared
from ..boards.batch import batch
from ..boards.exact import SMALL, ExactBoard
from ..hands.shaky import Paper
from ..marking.key import Key, tolerances
from . import cams, forces, gears  # noqa: F401  they enter their rules
from .data import angle_of_driver
from .rules import BY_SCALE, Broken, Change, Scene, broken

NOTHING = 1e-9  # part of a tolerance that is rounding
FLATTER = 0.7  # of the flattest angle of the right construction: lines meet more flatly than they should
UNDRAWN = 1e-9  # scale factor of what is only calculated, SI per mm
STEP = 5  # degrees; tasks give no finer angles, and nobody misreads a protractor by less
OWN = 0.5  # part of a step by which an angle differs from the right one

Complex = NDArray[np.complex128]
Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Signature:
    """What one broken construction gives for each question, in their order; NaN where it gives nothing.

    `allowed` are the tolerances of a hand that draws it so: what is larger than it should be misses more, and so does
    all that follows from lines that meet more flatly than they should.
    """

    broken: Broken
    values: Mapping[str, Any]
    sines: Mapping[str, float]
    row: Complex
    allowed: Floats


@dataclass(frozen=True, eq=False)
class Book:
    """The signatures of all mistakes for one answer key, in the order of their numbers.

    `turned` is the same construction at other angles of the crank.
    """

    key: Key
    signatures: tuple[Signature, ...]
    turned: _Turned

    @cached_property
    def table(self) -> Complex:
        """The rows of the signatures, of shape (mistakes, questions)."""
        rows = np.array([one.row for one in self.signatures], complex)
        return rows.reshape(len(self.signatures), len(self.key.questions))

    @cached_property
    def most(self) -> Floats:
        """The tolerances of the signatures, of shape (mistakes, questions)."""
        return np.array([one.allowed for one in self.signatures]).reshape(self.table.shape)

    @cached_property
    def right(self) -> Complex:
        """The right values, of shape (questions,)."""
        return _right(self.key)

    @cached_property
    def allowed(self) -> Floats:
        """The tolerances of the right construction, of shape (questions,)."""
        return _allowed(self.key)

    @cached_property
    def vector(self) -> NDArray[np.bool_]:
        """Which questions ask for vectors."""
        return np.array([question.vector for question in self.key.questions.values()])

    @cached_property
    def other(self) -> Floats:
        """How many times larger what another way gives is than what the construction does, a mistake in it or none."""
        return np.array([_ratio(self.key, name) for name in self.key.questions])

    def drawn_to(self, key: Key, mus: Mapping[str, float]) -> Book:
        """Return the book for a student's own scale factors, by plan: what hangs on them is run again.

        `key` is the key to which the answers were marked.
        """
        if key is self.key:
            return self
        kept = [s for s in self.signatures if s.broken.mistake not in BY_SCALE]
        paper = replace(key.paper, mus={**key.paper.mus, **mus})
        all_of_them = sorted(
            [*kept, *_moving(key, broken(paper, key.values, BY_SCALE))], key=lambda s: s.broken.mistake
        )
        return Book(key, tuple(all_of_them), self.turned)


@dataclass(frozen=True)
class _Turned:
    """The construction of a key at other angles of its crank; none where a slider drives, or an angle is calculated."""

    key: Key

    @cached_property
    def name(self) -> str:
        """The given that is the crank's angle; empty where there is none."""
        return angle_of_driver(Scene(self.key.paper, self.key.values))

    @cached_property
    def angles(self) -> Floats:
        """The angles, radians, without the right one."""
        if not self.name:
            return np.zeros(0)
        found = np.radians(np.arange(0.0, 360.0, STEP))
        apart = np.abs(np.angle(np.exp(1j * (found - self.key.paper.givens[self.name]))))
        return np.asarray(found[apart > OWN * math.radians(STEP)])

    @cached_property
    def table(self) -> Complex:
        """What each angle gives for every question, of shape (angles, questions); NaN where it gives nothing."""
        names, paper = list(self.key.questions), self.key.paper
        rows = np.full((len(self.angles), len(names)), np.nan, complex)
        if len(rows):
            values, _ = batch(paper.program, {**paper.givens, self.name: self.angles}, names)
            for place, name in enumerate(names):
                rows[:, place] = values[name]
        return rows

    def broken(self, row: int) -> Broken:
        """Return the construction at one of the angles, as a mistake."""
        angle = float(self.angles[row])
        return Broken("M10", self.key.paper, Change(self.name, {}, f"={angle!r}", {self.name: angle}))


def book(key: Key) -> Book:
    """Run every mistake that concerns a key; those that change nothing are left out."""
    return Book(key, tuple(_moving(key, broken(key.paper, key.values))), _Turned(key))


def _moving(key: Key, found: Iterable[Broken]) -> Iterator[Signature]:
    """Run broken constructions, and go through what those give that change anything."""
    right = _right(key)
    rounding = NOTHING * _allowed(key) + 1e-12 * np.abs(right)
    for made in signatures(key, found):
        with np.errstate(invalid="ignore"):  # of values beyond all floats
            same = bool((np.abs(made.row - right) <= rounding).all())
        if not same:
            yield made


def signatures(key: Key, found: Iterable[Broken], last: Signature | None = None) -> Iterator[Signature]:
    """Run the right construction, or one that is broken already, with a rule broken; go through what they give.

    Those are left out that cannot be drawn.
    """
    right, allowed = _right(key), _allowed(key)
    runs = [(one, board) for one in found if (board := _run(one, key if last is None else last)) is not None]
    asked = itemgetter(*key.questions) if len(key.questions) > 1 else lambda values: [values[n] for n in key.questions]
    rows = np.array([asked(board.values) for _, board in runs], complex).reshape(len(runs), len(key.questions))
    sizes = np.abs(right)
    with np.errstate(all="ignore"):
        times = np.where((sizes > 0.0) & ~np.isnan(rows), np.abs(rows) / sizes, 1.0)
    table = allowed * np.maximum(1.0, times)
    flattest = min(key.sines.values(), default=1.0)
    for (one, board), row, most in zip(runs, rows, table, strict=True):
        flat = min(board.sines.values(), default=1.0)
        if 0.0 < flat < SMALL and flat < FLATTER * flattest:
            mus = {plan: key.paper.mus.get(plan, UNDRAWN) for plan in one.program.plans}
            again = tolerances(Paper(one.program, one.givens, mus), board.values, board.sines, key.tolerance)
            most = np.fmax(most, np.array([again[name] for name in key.questions]))
        yield Signature(one, board.values, board.sines, row, most)


def _right(key: Key) -> Complex:
    return np.array([key.values[name] for name in key.questions], complex)


def _allowed(key: Key) -> Floats:
    return np.array([key.allowed[name] for name in key.questions])


def _run(found: Broken, before: Key | Signature) -> ExactBoard | None:
    """Run what is different in a broken construction, and all that hangs on it; the rest is as in the one before it.

    None where lines are parallel, arcs do not reach, or a number is out of range: nobody goes on from there.
    """
    board = ExactBoard({})
    board.values = {**before.values, **found.change.givens}
    board.sines.update(before.sines)
    try:
        board.do(_at_once(found))
    except (ZeroDivisionError, OverflowError):
        return None
    return board if board.trouble is None else None


def _at_once(found: Broken) -> Iterable[Prepared]:
    """Return the steps that are other ones, and those that hang on them or on changed data."""
    before, change, bits, replaced = found.paper.program, found.change, 0, 0
    hanging, places = before.hanging, before.places
    for name in change.givens:
        bits |= hanging.get(name, 0)
    for name, steps in change.steps.items():
        if name in places:
            replaced |= 1 << places[name]
            for step in steps:
                bits |= hanging.get(step.name, 0)
    if not replaced:
        return before.at(bits)
    if not bits & ((replaced & -replaced) - 1) and len(change.steps) == 1:  # what hangs on one step comes after it
        return (*map(prepared, *change.steps.values()), *before.at(bits & ~replaced))
    new = {name: tuple(map(prepared, steps)) for name, steps in change.steps.items()}
    return [step for one in before.at(bits | replaced) for step in new.get(one[0], (one,))]


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
