"""A board that notes the real arithmetic of a program, once for all positions of a batch."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .arithmetic import Real, Tape, Vector
from .arrays import ArrayBoard
from .exact import ExactBoard
from .graduation import cosine_of, mark_of, sine_of
from .protractor import FARTHEST


class NotingBoard(ExactBoard):
    """Positions as numbers on a tape: what depends on no array is computed, all else is noted.

    Looking at values is left to the array board `checks`, and so are whole steps that are more than sums, products and
    roots; `sample` does the program for one position, to tell a vector from a number there.
    """

    def __init__(
        self,
        givens: Mapping[str, Any],
        arrays: Mapping[str, NDArray[np.float64]],
        checks: ArrayBoard,
        sample: Callable[[], Mapping[str, Any]],
    ) -> None:
        super().__init__(givens)
        self.tape, self._arrays, self._checks, self._sample = Tape(), arrays, checks, sample
        self.values |= {name: self.tape.given(name) for name in arrays}

    def step(self, verb: str, name: str, *operands: str, law: str = "") -> None:
        """Note the arithmetic of a step, or the step as a whole."""
        length, values = len(self.tape.entries), [self.values[operand] for operand in operands]
        self._name, self._operands = name, operands
        try:
            self.values[name] = self.operation(verb, law)(*values)
        except TypeError:
            if not any(isinstance(value, Real | Vector) for value in values):
                raise
            self.tape.tear_off(length)
            self._sine_of = {}
            self.lift_templates()
            self.values[name] = self._whole(self._checks.operation(verb, law), name, operands)

    def _whole(self, operate: Callable[..., Any], name: str, operands: tuple[str, ...]) -> Any:
        """Note a step that the array board does."""
        values = [self.values[operand] for operand in operands]
        numbers = [part for value in values if isinstance(value, Real | Vector) for part in _parts(value)]

        def do(*rows: Any) -> tuple[Any, Any]:
            rest = iter(rows)
            arrays = [self._array(value, rest) for value in values]
            self._checks.restart(dict(zip(operands, arrays, strict=True)), self._checks.codes)
            self._checks.perform(operate, name, operands)
            result = self._checks.values[name]
            return np.real(result), np.imag(result)

        real, imag = self.tape.both(do, *numbers)
        return Vector(real, imag) if isinstance(self._sample()[name], complex) else real

    def _array(self, value: Any, rows: Any) -> Any:
        """Return what a value is at the positions of a chunk, its parts being the next of `rows`."""
        if isinstance(value, Vector):
            return self._checks._complex(next(rows), next(rows))
        return next(rows) if isinstance(value, Real) else value

    # What an exact board says of itself.

    @staticmethod
    def _sqrt(square: Any) -> Any:
        return square.tape.apply(np.sqrt, square) if isinstance(square, Real) else ExactBoard._sqrt(square)

    @staticmethod
    def _complex(real: Any, imag: Any) -> Any:
        return Vector(real, imag) if isinstance(real, Real) or isinstance(imag, Real) else complex(real, imag)

    def _graduation(self, rounded: Any) -> tuple[Any, Any]:
        if not isinstance(rounded, Real):
            return super()._graduation(rounded)
        mark = self.tape.fill(mark_of, rounded)
        return self.tape.fill(cosine_of, mark), self.tape.fill(sine_of, mark)

    def _lines_sine(self, sine: Any) -> Any:
        if not isinstance(sine, Real):
            return super()._lines_sine(sine)
        size = self.tape.check(self._checks._lines_sine, Real(self.tape, sine.place))
        return -size if sine.negative else size

    def _near(self, angle: Any) -> Any:
        if isinstance(angle, Real):
            array = self._arrays.get(self.tape.entries[angle.place].given)
            if array is not None and array.min() > -FARTHEST and array.max() < FARTHEST:
                return angle
        return self._checked("_near", angle)

    def _upright(self, component: Any) -> Any:
        if not isinstance(component, Real):
            return super()._upright(component)
        return self.tape.check(self._checks._straight, component, abs(component))

    def _reaches(self, *operands: Any) -> Any:
        return self._checked("_reaches", *operands)

    def _assembles(self, *operands: Any) -> Any:
        return self._checked("_assembles", *operands)

    def _apart(self, *operands: Any) -> Any:
        return self._checked("_apart", *operands)

    def _clear(self, *operands: Any) -> Any:
        return self._checked("_clear", *operands)

    def _divisor(self, *operands: Any) -> Any:
        return self._checked("_divisor", *operands)

    def _bears(self, *operands: Any) -> Any:
        return self._checked("_bears", *operands)

    def _holds(self, *operands: Any) -> Any:
        return self._checked("_holds", *operands)

    def _checked(self, check: str, *operands: Any) -> Any:
        """Note a look at whole arrays; what depends on none is looked at here and now."""
        if any(isinstance(operand, Real) for operand in operands):
            return self.tape.check(getattr(self._checks, check), *operands)
        return getattr(super(), check)(*operands)


def _parts(value: Any) -> tuple[Any, ...]:
    return (value.real, value.imag) if isinstance(value, Vector) else (value,)
