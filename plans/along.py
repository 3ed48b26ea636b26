"""A program as a function of one of its values: what does not depend on that value is done once."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from ..scales.kept import Kept
from .board import Program, Step
from .boards.arrays import ArrayBoard
from .boards.exact import STATUSES, ExactBoard, Status

Array = NDArray[np.float64]
Result = TypeVar("Result")
More = Callable[[Array], Mapping[str, Array]]


class Along:
    """The steps that `wanted` needs, ready to be done for many values of `variable` again and again.

    The `givens` are in SI, and `board` may note something besides. `more` takes values of the variable, shape (N,), and
    gives other arrays by name that go with them.
    """

    def __init__(
        self,
        program: Program,
        givens: Mapping[str, Any],
        variable: str,
        wanted: Sequence[str],
        board: type[ArrayBoard] = ArrayBoard,
        more: More | None = None,
    ) -> None:
        with_it = more(np.zeros(1)) if more else {}
        given = {name: value for name, value in givens.items() if name not in {variable, *with_it}}
        varying, once, each = {variable, *with_it}, [], []
        for step in program.needed_for(wanted):
            if varying.isdisjoint(step.operands):
                once.append(step)
            else:
                each.append(step)
                varying.add(step.name)
        fixed = ExactBoard(given)
        Program(tuple(once)).run(fixed)
        self._variable, self._more, self._wanted = variable, more, tuple(wanted)
        self._fixed, self._board = fixed, board({}, 0)
        self._steps = [(self._board.operation(s.verb, s.law), s.name, s.operands) for s in each]
        self.steps: tuple[Step, ...] = tuple(each)

    @property
    def status(self) -> Status:
        """Status of the steps that do not depend on the variable."""
        return self._fixed.status

    def run(self, at: Array) -> ArrayBoard:
        """Do the steps for the values `at` of the variable, shape (N,), and return the board."""
        board = self._board
        more = self._more(at) if self._more else {}
        board.restart({**self._fixed.values, **more, self._variable: at}, np.zeros(len(at), np.int8))
        perform = board.perform
        with np.errstate(invalid="ignore", divide="ignore"):
            for operate, name, operands in self._steps:
                perform(operate, name, operands)
        return board

    def __call__(self, at: Array) -> dict[str, NDArray[Any]]:
        """Return the wanted names for the values `at`, each of shape (N,)."""
        return self.batch(at)[0]

    def batch(self, at: Array) -> tuple[dict[str, NDArray[Any]], NDArray[np.int8]]:
        """Return the wanted names, and the status of every position as an index into `STATUSES`.

        For some hundred positions this is faster than `batch.batch`, which prepares itself for millions.
        """
        board = self.run(at)
        codes = np.maximum(board.codes, np.int8(STATUSES.index(self._fixed.status)))
        return {name: _as_long_as(at, board.values[name]) for name in self._wanted}, codes


def _as_long_as(at: Array, value: Any) -> NDArray[Any]:
    return value if np.shape(value) == at.shape else np.broadcast_to(value, at.shape)


def remembering(function: Callable[[Array], Result]) -> Callable[[Array], Result]:
    """Return `function` with a memory of its last results: one search often asks for the places of the one before."""
    kept = Kept[Result](8)
    return lambda at: kept.get(at.tobytes(), lambda: function(at))
