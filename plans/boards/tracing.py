"""A board that writes the real arithmetic of a program down, once for all positions."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any

import numpy as np

from ..laws import cross, dot
from .arrays import CALM, CODES, ArrayBoard, ManyChecks, Rarely
from .exact import ExactBoard
from .protractor import TURN
from .trace import Calm, Real, Trace, Vector


class TracingBoard(ManyChecks, ExactBoard):
    """A position as numbers of a trace: what depends on no given of it is computed, all else is noted.

    Steps that are more than sums, products and roots are left to the array board `checks` as a whole, and `sample` does
    the program for one position, to tell a vector from a number there.

    Parameters
    ----------
    constants : mapping of str to float
        Givens that are the same wherever the trace is used.
    givens : iterable of str
        Names of the others.
    """

    def __init__(
        self,
        constants: Mapping[str, Any],
        givens: Iterable[str],
        checks: ArrayBoard | None = None,
        sample: Callable[[], Mapping[str, Any]] = dict,
    ) -> None:
        super().__init__(constants)
        self.trace, self._checks, self._sample = Trace(), checks, sample
        self.values |= {name: self.trace.given(name) for name in givens}
        if checks is not None:  # thresholds go with the precision
            self.parallel, self.touching = checks.parallel, checks.touching
            self.closed, self.folded = checks.closed, checks.folded

    def step(self, verb: str, name: str, *operands: str, law: str = "") -> None:
        """Note the arithmetic of a step, or the step as a whole."""
        length, values = len(self.trace.entries), [self.values[operand] for operand in operands]
        self._name, self._operands = name, operands
        try:
            self.values[name] = self.operation(verb, law)(*values)
        except TypeError:
            if self._checks is None or not any(isinstance(value, Real | Vector) for value in values):
                raise
            self.trace.tear_off(length)
            self._sine_of = {}
            self.lift_templates()
            self.values[name] = self._whole(self._checks.operation(verb, law), name, operands)

    def _whole(self, operate: Callable[..., Any], name: str, operands: tuple[str, ...]) -> Any:
        """Note a step that the array board does."""
        values = [self.values[operand] for operand in operands]
        numbers = [part for value in values if isinstance(value, Real | Vector) for part in _parts(value)]
        board = self._checks
        assert board is not None

        def do(codes: Any, *rows: Any) -> tuple[Any, Any]:
            rest = iter(rows)
            arrays = [_array(board, value, rest) for value in values]
            board.restart(dict(zip(operands, arrays, strict=True)), codes)
            board.perform(operate, name, operands)
            result = board.values[name]
            return np.real(result), np.imag(result)

        real, imag = self.trace.whole(do, *numbers)
        return Vector(real, imag) if isinstance(self._sample()[name], complex) else real

    # What an exact board says of itself.

    @staticmethod
    def _sqrt(square: Any) -> Any:
        return square.trace.apply("sqrt", square) if isinstance(square, Real) else ExactBoard._sqrt(square)

    @staticmethod
    def _complex(real: Any, imag: Any) -> Any:
        return Vector(real, imag) if isinstance(real, Real) or isinstance(imag, Real) else complex(real, imag)

    def _graduation(self, rounded: Any) -> tuple[Any, Any]:
        if not isinstance(rounded, Real):
            return super()._graduation(rounded)
        mark = self.trace.apply("mark", rounded)
        return self.trace.apply("cosine", mark), self.trace.apply("sine", mark)

    def _angle(self, first: Any, second: Any) -> Any:
        across, along = cross(first, second), dot(first, second)
        if not isinstance(across, Real) and not isinstance(along, Real):
            return super()._angle(first, second)
        return self.trace.apply("arctan2", across, along)

    @staticmethod
    def _choose(where: Any, value: Any, other: Any) -> Any:
        if not isinstance(where, Real):
            return value if where else other
        return where.trace.apply("where", where, value, other)

    @staticmethod
    def _remainder(angle: Any) -> Any:
        return angle.trace.apply("fmod", angle, TURN)

    def _calm(self, value: Any, order: str, bound: float, of: Any = None, squared: bool = False) -> Calm | bool:
        if not isinstance(value, Real):  # it does not change: it can be looked at now, if its bound can
            return not isinstance(of, Real) and CALM[order](value, _bound(bound, of, squared))
        if isinstance(of, Real):
            return Calm(self.trace.place(value), order, bound, self.trace.place(of), squared)
        return Calm(self.trace.place(value), order, _bound(bound, of, squared))

    def _look(self, check: str, operands: tuple[Any, ...], calm: tuple[Any, ...], rare: Callable[[], Rarely]) -> Any:
        def look() -> tuple[Iterable[tuple[int, Real]], Any]:
            marks, result = rare()
            return [(CODES[status], where) for status, where in marks], result

        key = check, *(self.trace.place(operand) for operand in operands)
        noted = [one for one in calm if isinstance(one, Calm)]
        restless = not all(calm)  # what is noted counts as calm here
        if not noted and not restless:
            return operands[0]
        return self.trace.rare(key, operands[0], () if restless else noted, look)

    def _lines_sine(self, sine: Any) -> Any:
        if not isinstance(sine, Real):
            return ExactBoard._lines_sine(self, sine)
        size = ManyChecks._lines_sine(self, Real(self.trace, sine.place))
        return -size if sine.negative else size


def _either(check: str) -> Callable[..., Any]:
    """Return a check of numbers of a trace that looks at others here and now."""
    many, one = getattr(ManyChecks, check), getattr(ExactBoard, check)

    def checked(self: TracingBoard, *operands: Any) -> Any:
        return (many if any(isinstance(operand, Real) for operand in operands) else one)(self, *operands)

    return checked


for _check in ("_near", "_upright", "_reaches", "_assembles", "_apart", "_holds", "_clear", "_divisor", "_bears"):
    setattr(TracingBoard, _check, _either(_check))


def _bound(bound: float, of: Any, squared: bool) -> float:
    bound = bound if of is None else bound * of
    return bound * bound if squared else bound


def _parts(value: Any) -> tuple[Any, ...]:
    return (value.real, value.imag) if isinstance(value, Vector) else (value,)


def _array(board: ArrayBoard, value: Any, rows: Any) -> Any:
    """Return what a value is at the positions of a chunk, its parts being the next of `rows`."""
    if isinstance(value, Vector):
        return board._complex(next(rows), next(rows))
    return next(rows) if isinstance(value, Real) else value
