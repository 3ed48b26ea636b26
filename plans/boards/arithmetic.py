"""Numbers that are written down instead of computed: a tape of real operations, each noted once.

A construction that runs on them leaves the straight real arithmetic of a batch. What the tape saves changes no bit of a
result: an operation that is there already, a product with +-1 or a sum with 0, a sign (it stays with the number, and
a normal to a direction is an exchange of its parts). Only a zero may have the other sign.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

Operation = Callable[..., Any]


class Entry(NamedTuple):
    """One line of a tape: an operation on earlier lines, or a given array or a constant, which have none.

    A check looks at its operands as whole arrays and returns the first of them, or a changed copy of it. An operation
    that `fills` puts its result into its last operand, as those of numpy do.
    """

    operation: Operation | None
    operands: tuple[int, ...] = ()
    check: bool = False
    given: str = ""
    constant: float | None = None
    fills: bool = False


class Tape:
    """Entries in order of evaluation, each once."""

    def __init__(self) -> None:
        self.entries: list[Entry] = []
        self._places: dict[Entry, int] = {}

    def note(self, entry: Entry) -> int:
        """Return the place of an entry, a new one or that where it stands."""
        place = self._places.setdefault(entry, len(self.entries))
        if place == len(self.entries):
            self.entries.append(entry)
        return place

    def tear_off(self, length: int) -> None:
        """Keep only the first entries."""
        for entry in self.entries[length:]:
            del self._places[entry]
        del self.entries[length:]

    def given(self, name: str) -> Real:
        """Return the array with that name."""
        return Real(self, self.note(Entry(None, given=name)))

    def real(self, value: Real | float) -> Real:
        """Return a number as one of the tape; constants are noted without their sign."""
        if isinstance(value, Real):
            return value
        return Real(self, self.note(Entry(None, constant=abs(value))), value < 0.0)

    def place(self, value: Real | float) -> int:
        """Return where a value stands with its own sign."""
        number = self.real(value)
        return self.note(Entry(np.negative, (number.place,))) if number.negative else number.place

    def apply(self, operation: Operation, *operands: Real | float) -> Real:
        """Return the result of an operation on numbers with their signs, such as a root."""
        return Real(self, self.note(Entry(operation, tuple(map(self.place, operands)))))

    def fill(self, operation: Operation, *operands: Real | float) -> Real:
        """Return what an operation puts into its last operand."""
        return Real(self, self.note(Entry(operation, tuple(map(self.place, operands)), fills=True)))

    def difference(self, more: int, less: int) -> Real:
        """Return the difference of what stands at two places, or the negative of one that is noted the other way."""
        turned = self._places.get(Entry(np.subtract, (less, more)))
        if turned is not None:
            return Real(self, turned, True)
        return Real(self, self.note(Entry(np.subtract, (more, less))))

    def both(self, operation: Operation, *operands: Real | float) -> tuple[Real, Real]:
        """Return the two results of an operation."""
        kept = _Both(operation)
        first = self.apply(kept.first, *operands)
        return first, self.apply(kept.second, first)

    def check(self, operation: Operation, *operands: Real | float) -> Real:
        """Return the first operand as a check leaves it."""
        return Real(self, self.note(Entry(operation, tuple(map(self.place, operands)), check=True)))


class _Both:
    """An operation with two results: the second is kept until it is asked for."""

    def __init__(self, operation: Operation) -> None:
        self._operation = operation

    def first(self, *operands: Any) -> Any:
        result, self._second = self._operation(*operands)
        return result

    def second(self, first: Any) -> Any:
        return self._second


class Real:
    """A real number on a tape: what stands at `place`, or the negative of it. What is true is one, what is not zero."""

    __array_ufunc__ = None  # numpy leaves these numbers to themselves
    __hash__ = None  # type: ignore[assignment]
    __slots__ = ("negative", "place", "tape")

    def __init__(self, tape: Tape, place: int, negative: bool = False) -> None:
        self.tape, self.place, self.negative = tape, place, negative

    def __bool__(self) -> bool:
        raise TypeError("no value while a program is noted")

    def __neg__(self) -> Real:
        return Real(self.tape, self.place, not self.negative)

    def __abs__(self) -> Real:
        return Real(self.tape, self.tape.note(Entry(np.abs, (self.place,))))

    def __eq__(self, other: Real | float) -> Real:  # type: ignore[override]
        return self.tape.apply(np.equal, self, other)

    def __gt__(self, other: Real | float) -> Real:
        return self.tape.apply(np.greater, self, other)

    def __lt__(self, other: Real | float) -> Real:
        return self.tape.apply(np.less, self, other)

    def __ge__(self, other: Real | float) -> Real:
        return self.tape.apply(np.greater_equal, self, other)

    def __le__(self, other: Real | float) -> Real:
        return self.tape.apply(np.less_equal, self, other)

    def __floordiv__(self, other: Real | float) -> Real:
        return self.tape.apply(np.floor_divide, self, other)

    def __add__(self, other: Real | float) -> Real:
        if not isinstance(other, Real | float):
            return NotImplemented
        if isinstance(other, float) and other == 0.0:
            return self
        other = self.tape.real(other)
        if self.negative != other.negative:
            return self.tape.difference(*((other.place, self.place) if self.negative else (self.place, other.place)))
        first, second = sorted((self.place, other.place))
        return Real(self.tape, self.tape.note(Entry(np.add, (first, second))), self.negative)

    def __radd__(self, other: float) -> Real:
        return self + other

    def __sub__(self, other: Real | float) -> Real:
        return self + -other if isinstance(other, Real | float) else NotImplemented

    def __rsub__(self, other: float) -> Real:
        return -self + other

    def __mul__(self, other: Any) -> Any:
        if isinstance(other, complex):
            return Vector(self * other.real, self * other.imag)
        if not isinstance(other, Real | float):
            return NotImplemented
        if isinstance(other, float) and abs(other) == 1.0:
            return Real(self.tape, self.place, self.negative != (other < 0.0))
        other = self.tape.real(other)
        first, second = sorted((self.place, other.place))
        return Real(self.tape, self.tape.note(Entry(np.multiply, (first, second))), self.negative != other.negative)

    def __rmul__(self, other: Any) -> Any:
        return self * other

    def __truediv__(self, other: Real | float) -> Real:
        if not isinstance(other, Real | float):
            return NotImplemented
        if isinstance(other, float) and abs(other) == 1.0:
            return Real(self.tape, self.place, self.negative != (other < 0.0))
        other = self.tape.real(other)
        entry = Entry(np.divide, (self.place, other.place))
        return Real(self.tape, self.tape.note(entry), self.negative != other.negative)

    def __rtruediv__(self, other: float) -> Real:
        return self.tape.real(other) / self


class Vector:
    """A point or vector whose parts are numbers on a tape, or one of them a constant."""

    __array_ufunc__ = None
    __hash__ = None  # type: ignore[assignment]
    __slots__ = ("imag", "real")

    def __init__(self, real: Any, imag: Any) -> None:
        self.real, self.imag = real, imag

    def __bool__(self) -> bool:
        raise TypeError("no value while a program is noted")

    def __eq__(self, other: object) -> bool:
        raise TypeError("no value while a program is noted")

    def __neg__(self) -> Vector:
        return Vector(-self.real, -self.imag)

    def __add__(self, other: Vector | complex) -> Vector:
        if not isinstance(other, Vector | complex):
            return NotImplemented
        return Vector(self.real + other.real, self.imag + other.imag)

    def __radd__(self, other: complex) -> Vector:
        return self + other

    def __sub__(self, other: Vector | complex) -> Vector:
        if not isinstance(other, Vector | complex):
            return NotImplemented
        return Vector(self.real - other.real, self.imag - other.imag)

    def __rsub__(self, other: complex) -> Vector:
        return -self + other

    def __mul__(self, other: Real | float | complex) -> Vector:
        if isinstance(other, Real | float):
            return Vector(self.real * other, self.imag * other)
        if isinstance(other, complex) and other == 1j:
            return Vector(-self.imag, self.real)
        return NotImplemented  # a product of two vectors is rounded in another way on each machine

    def __rmul__(self, other: Real | float | complex) -> Vector:
        return self * other
