"""The exact board on numpy arrays, for many positions at once, and a program as a function of one of its values."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import cache, partial
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from ...scales.kept import Kept
from ..board import Program, Step
from .exact import MARKS, STATUSES, TURN, ExactBoard, PlainBoard, Rarely, Status, calm_by, graduation

Array = NDArray[np.float64]
Result = TypeVar("Result")


@cache
def _graduation_arrays() -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    cosines, sines = graduation()
    return np.array(cosines), np.array(sines)


def mark_of(rounded: Any, mark: Any) -> None:
    """Put the number of the protractor's mark, which the last bits of a rounded number are, into the bits of `mark`."""
    np.bitwise_and(rounded.view(np.int64), MARKS - 1, mark.view(np.int64))


def cosine_of(mark: Any, cosine: Any) -> None:
    """Put the cosines of marks into `cosine`; marks are none but those of the protractor, so that none is clipped."""
    _graduation_arrays()[0].take(mark.view(np.int64), out=cosine, mode="clip")


def sine_of(mark: Any, sine: Any) -> None:
    """Put the sines of marks into `sine`."""
    _graduation_arrays()[1].take(mark.view(np.int64), out=sine, mode="clip")


CODES = {status: code for code, status in enumerate(STATUSES)}


_least, _most = (partial(ufunc.reduce, axis=None) for ufunc in (np.minimum, np.maximum))
_CALM = calm_by("least(value)", "most(value)", {"least": _least, "most": _most})


class ArrayBoard(PlainBoard):
    """N positions on arrays of shape (N,): a status per position in `codes`, NaN only where a position fails."""

    def __init__(self, givens: Mapping[str, Any], size: int) -> None:
        super().__init__(givens)
        self.codes = np.zeros(size, np.int8)

    def restart(self, givens: Mapping[str, Any], codes: NDArray[np.int8]) -> None:
        """Begin with other positions; the status of each goes into `codes`."""
        self.values, self.codes = dict(givens), codes
        self._begin()

    @staticmethod
    def _sqrt(square: Any) -> Any:
        return np.sqrt(square)

    @staticmethod
    def _complex(real: Any, imag: Any) -> Any:
        if not np.ndim(real) and not np.ndim(imag):
            return complex(real, imag)
        points = np.empty(np.broadcast_shapes(np.shape(real), np.shape(imag)), complex)
        points.real, points.imag = real, imag
        return points

    def _graduation(self, rounded: Any) -> tuple[Any, Any]:
        rounded = np.asarray(rounded)
        mark, cosine, sine = (np.empty_like(rounded) for _ in range(3))
        mark_of(rounded, mark)
        cosine_of(mark, cosine)
        sine_of(mark, sine)
        return cosine[()], sine[()]

    def _look(self, check: str, operands: tuple[Any, ...], calm: tuple[Any, ...], rare: Callable[[], Rarely]) -> Any:
        if all(calm):
            return operands[0]
        marks, result = rare()
        for status, where, *_ in marks:
            np.maximum(self.codes, np.where(where, np.int8(CODES[status]), np.int8(0)), out=self.codes)
        return result

    def _calm(self, value: Any, order: str, bound: float, of: Any = None, squared: bool = False) -> Any:
        if of is not None:
            bound = bound * _most(of)
        return _CALM[order](value, bound * bound if squared else bound)

    def _note_sine(self, part: Any, whole: Any = None) -> None:
        """Do nothing: the status of each position tells enough."""

    def _note_pins(self, distance: Any, size: Any) -> None:
        """Do nothing, too."""

    @staticmethod
    def _choose(where: Any, value: Any, other: Any) -> Any:
        return np.where(where, value, other)

    @staticmethod
    def _remainder(angle: Any) -> Any:
        return np.fmod(angle, TURN)


class Along:
    """A program as a function of one of its values: what does not depend on that value is done once.

    The steps that `wanted` needs, ready to be done for many values of `variable` again and again.

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
        more: Callable[[Array], Mapping[str, Array]] | None = None,
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
        codes = np.maximum(board.codes, np.int8(CODES[self._fixed.status]))
        values = {name: board.values[name] for name in self._wanted}
        return {
            name: value if np.shape(value) == at.shape else np.broadcast_to(value, at.shape)
            for name, value in values.items()
        }, codes


def remembering(function: Callable[[Array], Result]) -> Callable[[Array], Result]:
    """Return `function` with a memory of its last results: one search often asks for the places of the one before."""
    kept = Kept[Result](8)
    return lambda at: kept.get(at.tobytes(), lambda: function(at))
