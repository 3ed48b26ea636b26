"""Numbers that are written down instead of computed, each operation noted once, and the board that does so.

A construction that runs on them leaves straight real arithmetic, which `printers` writes as a program for many
positions, for one, or for a page. What the trace saves changes no bit of a result: an operation that is there, a
product with +-1 or a sum with 0, a sign (it stays with the number, and a normal to a direction is an exchange of its
parts). Only a zero may have the other sign.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from ..laws import cross, dot
from .arrays import CODES, ArrayBoard
from .exact import TURN, ExactBoard, Rarely


class Entry(NamedTuple):
    """One operation on earlier entries.

    `operation` is the name of a function of numpy, or one of

    - `given`: a number that comes from outside, by the name in `data`;
    - `constant`: the number in `data`;
    - `mark`, `cosine`, `sine`: the protractor's mark of a rounded angle, and its table;
    - `rare`: the first operand, looked at: `data` is a `Rare`;
    - `whole`, `second`: the two results of a step that is more than arithmetic, `data` a function of arrays.
    """

    operation: str
    operands: tuple[int, ...] = ()
    data: Any = None


@dataclass(frozen=True, slots=True)
class Calm:
    """Where a number gives no cause to look at it closely.

    `order` says how it must lie to `bound`: `above`, `at least`, `at most`; `beyond`: all of it above, or all of it
    below the negative; `within`: between the negative and the bound. Where `of` is given, the place of a number, the
    bound is `bound` times the largest of it, or the square of that.
    """

    place: int
    order: str
    bound: float
    of: int | None = None
    squared: bool = False


@dataclass(frozen=True, slots=True)
class Rare:
    """What is done with a number that is not calm: statuses that it sets, and the value to go on with.

    `marks` are codes of statuses with the places of their conditions; the entries of `block` are for this alone.
    """

    calm: tuple[Calm, ...]
    marks: tuple[tuple[int, int], ...]
    result: int
    block: tuple[int, ...]


class Trace:
    """Entries in order of evaluation, each once."""

    def __init__(self) -> None:
        self.entries: list[Entry] = []
        self._places: dict[Any, int] = {}

    def note(self, operation: str, operands: tuple[int, ...] = (), data: Any = None) -> int:
        """Return the place of an entry, a new one or that where it stands."""
        entry = Entry(operation, operands, data)
        place = self._places.setdefault(entry, len(self.entries))
        if place == len(self.entries):
            self.entries.append(entry)
        return place

    def tear_off(self, length: int) -> None:
        """Keep only the first entries."""
        self._places = {key: place for key, place in self._places.items() if place < length}
        del self.entries[length:]

    def given(self, name: str) -> Real:
        """Return the number that comes from outside with that name."""
        return Real(self, self.note("given", data=name))

    def real(self, value: Real | float) -> Real:
        """Return a number as one of the trace; constants are noted without their sign."""
        if isinstance(value, Real):
            return value
        return Real(self, self.note("constant", data=abs(float(value))), value < 0.0)

    def place(self, value: Real | float) -> int:
        """Return where a value stands with its own sign."""
        number = self.real(value)
        return self.note("negative", (number.place,)) if number.negative else number.place

    def apply(self, operation: str, *operands: Real | float) -> Real:
        """Return the result of an operation on numbers with their signs, such as a root."""
        return Real(self, self.note(operation, tuple(map(self.place, operands))))

    def difference(self, more: int, less: int) -> Real:
        """Return the difference of what stands at two places, or the negative of one that is noted the other way."""
        turned = self._places.get(Entry("subtract", (less, more)))
        if turned is not None:
            return Real(self, turned, True)
        return Real(self, self.note("subtract", (more, less)))

    def whole(self, do: Callable[..., tuple[Any, Any]], *operands: Real) -> tuple[Real, Real]:
        """Return the two results of a step that is done as a whole."""
        first = self.note("whole", tuple(map(self.place, operands)), do)
        return Real(self, first), Real(self, self.note("second", (first,)))

    def rare(
        self,
        key: tuple[Any, ...],
        value: Real,
        calm: Iterable[Calm],
        look: Callable[[], tuple[Iterable[tuple[int, Real]], Real | float]],
    ) -> Real:
        """Return a number that is looked at closely where it is not calm; under one `key` once."""
        if key not in self._places:
            start, kept = len(self.entries), dict(self._places)
            marks, result = look()
            found = tuple((code, self.place(condition)) for code, condition in marks)
            rare = Rare(tuple(calm), found, self.place(result), tuple(range(start, len(self.entries))))
            self._places = kept  # what is computed only there is not there elsewhere
            first = self.place(value)
            needed = {o for i in rare.block for o in self.entries[i].operands if o < start}
            needed |= {c.place for c in rare.calm} | {c.of for c in rare.calm if c.of is not None}
            needed |= {place for place in (rare.result, *(place for _, place in found)) if place < start}
            self._places[key] = len(self.entries)
            self.entries.append(Entry("rare", (first, *sorted(needed - {first})), rare))
        return Real(self, self._places[key])


def _applied(operation: str) -> Callable[[Real, Real | float], Real]:
    return lambda number, other: number.trace.apply(operation, number, other)


class Real:
    """A real number of a trace: what stands at `place`, or its negative. What is true is one, what is not is zero."""

    __array_ufunc__ = None  # numpy leaves these numbers to themselves
    __hash__ = None  # type: ignore[assignment]
    __slots__ = ("negative", "place", "trace")

    def __init__(self, trace: Trace, place: int, negative: bool = False) -> None:
        self.trace, self.place, self.negative = trace, place, negative

    @property
    def real(self) -> Real:
        """The number itself, as with numbers of Python."""
        return self

    @property
    def imag(self) -> float:
        """Zero, as with real numbers of Python."""
        return 0.0

    def __bool__(self) -> bool:
        raise TypeError("no value while a program is traced")

    def __neg__(self) -> Real:
        return Real(self.trace, self.place, not self.negative)

    def __abs__(self) -> Real:
        return Real(self.trace, self.trace.note("absolute", (self.place,)))

    def __eq__(self, other: Real | float) -> Real:  # type: ignore[override]
        return self.trace.apply("equal", self, other)

    __gt__, __ge__ = _applied("greater"), _applied("greater_equal")
    __lt__, __le__ = _applied("less"), _applied("less_equal")
    __and__ = __rand__ = _applied("logical_and")
    __or__ = __ror__ = _applied("logical_or")
    __floordiv__ = _applied("floor_divide")

    def __rpow__(self, other: float) -> Real:
        return self.trace.apply("power", other, self)

    def __add__(self, other: Real | float) -> Real:
        if not isinstance(other, Real | float | int):
            return NotImplemented
        if isinstance(other, float | int) and other == 0.0:
            return self
        other = self.trace.real(other)
        if self.negative != other.negative:
            return self.trace.difference(*((other.place, self.place) if self.negative else (self.place, other.place)))
        first, second = sorted((self.place, other.place))
        return Real(self.trace, self.trace.note("add", (first, second)), self.negative)

    __radd__ = __add__

    def __sub__(self, other: Real | float) -> Real:
        return self + -other if isinstance(other, Real | float | int) else NotImplemented

    def __rsub__(self, other: float) -> Real:
        return -self + other

    def __mul__(self, other: Any) -> Any:
        if isinstance(other, complex):
            return Vector(self * other.real, self * other.imag)
        return self._scaled("multiply", other)

    __rmul__ = __mul__

    def __truediv__(self, other: Real | float) -> Any:
        return self._scaled("divide", other)

    def _scaled(self, operation: str, other: Any) -> Any:
        """Return a product, whose factors may be exchanged, or a quotient; signs are not written down."""
        if not isinstance(other, Real | float | int):
            return NotImplemented
        if isinstance(other, float | int) and abs(other) == 1.0:
            return Real(self.trace, self.place, self.negative != (other < 0.0))
        other = self.trace.real(other)
        places = self.place, other.place
        noted = self.trace.note(operation, places if operation == "divide" else (min(places), max(places)))
        return Real(self.trace, noted, self.negative != other.negative)

    def __rtruediv__(self, other: float) -> Any:
        return self.trace.real(other) / self


class Vector:
    """A point or vector whose parts are numbers of a trace, or one of them a constant."""

    __array_ufunc__ = None
    __hash__ = None  # type: ignore[assignment]
    __slots__ = ("imag", "real")

    def __init__(self, real: Any, imag: Any) -> None:
        self.real, self.imag = real, imag

    def __bool__(self) -> bool:
        raise TypeError("no value while a program is traced")

    def __eq__(self, other: object) -> bool:
        raise TypeError("no value while a program is traced")

    def __neg__(self) -> Vector:
        return Vector(-self.real, -self.imag)

    def __add__(self, other: Vector | complex) -> Vector:
        if not isinstance(other, Vector | complex):
            return NotImplemented
        return Vector(self.real + other.real, self.imag + other.imag)

    __radd__ = __add__

    def __sub__(self, other: Vector | complex) -> Vector:
        return self + -other if isinstance(other, Vector | complex) else NotImplemented

    def __rsub__(self, other: complex) -> Vector:
        return -self + other

    def __mul__(self, other: Real | float | complex) -> Vector:
        if isinstance(other, Real | float):
            return Vector(self.real * other, self.imag * other)
        if isinstance(other, complex) and other == 1j:
            return Vector(-self.imag, self.real)
        return NotImplemented  # a product of two vectors is rounded in another way on each machine

    __rmul__ = __mul__


class TracingBoard(ExactBoard):
    """A position as numbers of a trace: what depends on no given of it is computed, all else is noted.

    Steps that are more than sums, products and roots are left to the array board `checks` as a whole, and `sample` does
    the program for one position, to tell a vector from a number there. The `constants` are givens that are the same
    wherever the trace is used, `givens` the names of the others.
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
            self._begin()
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
        return angle.trace.apply("fmod", angle, TURN) if isinstance(angle, Real) else ExactBoard._remainder(angle)

    def _calm(self, value: Any, order: str, bound: float, of: Any = None, squared: bool = False) -> Calm | bool:
        if not isinstance(value, Real):  # it does not change: it can be looked at now, if its bound can
            return not isinstance(of, Real) and super()._calm(value, order, bound, of, squared)
        if isinstance(of, Real):
            return Calm(self.trace.place(value), order, bound, self.trace.place(of), squared)
        bound = bound if of is None else bound * of
        return Calm(self.trace.place(value), order, bound * bound if squared else bound)

    def _look(self, check: str, operands: tuple[Any, ...], calm: tuple[Any, ...], rare: Callable[[], Rarely]) -> Any:
        if not any(isinstance(operand, Real) for operand in operands):
            return super()._look(check, operands, calm, rare)

        def look() -> tuple[Iterable[tuple[int, Real]], Any]:
            marks, result = rare()
            return [(CODES[status], where) for status, where, *_ in marks], result

        key = check, *(self.trace.place(operand) for operand in operands)
        noted = [bounds for bounds in calm if isinstance(bounds, Calm)]
        restless = not all(calm)  # what is noted counts as calm here
        if not noted and not restless:
            return operands[0]
        return self.trace.rare(key, operands[0], () if restless else noted, look)

    def _note_sine(self, part: Any, whole: Any = None) -> None:
        if not isinstance(part, Real) and not isinstance(whole, Real):
            super()._note_sine(part, whole)

    def _note_pins(self, distance: Any, size: Any) -> None:
        if not isinstance(distance, Real) and not isinstance(size, Real):
            super()._note_pins(distance, size)

    def _lines_sine(self, sine: Any) -> Any:
        if not isinstance(sine, Real) or not sine.negative:
            return super()._lines_sine(sine)
        return -super()._lines_sine(-sine)


def _parts(value: Any) -> tuple[Any, ...]:
    return (value.real, value.imag) if isinstance(value, Vector) else (value,)


def _array(board: ArrayBoard, value: Any, rows: Any) -> Any:
    """Return what a value is at the positions of a chunk, its parts being the next of `rows`."""
    if isinstance(value, Vector):
        return board._complex(next(rows), next(rows))
    return next(rows) if isinstance(value, Real) else value
