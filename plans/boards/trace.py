"""Numbers that are written down instead of computed: a trace of real operations, each noted once.

A construction that runs on them leaves straight real arithmetic, which `printers` writes as a program for many
positions, for one, or for a page. What the trace saves changes no bit of a result: an operation that is there, a
product with +-1 or a sum with 0, a sign (it stays with the number, and a normal to a direction is an exchange of its
parts). Only a zero may have the other sign.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any, NamedTuple


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

    def __gt__(self, other: Real | float) -> Real:
        return self.trace.apply("greater", self, other)

    def __lt__(self, other: Real | float) -> Real:
        return self.trace.apply("less", self, other)

    def __ge__(self, other: Real | float) -> Real:
        return self.trace.apply("greater_equal", self, other)

    def __le__(self, other: Real | float) -> Real:
        return self.trace.apply("less_equal", self, other)

    def __and__(self, other: Real | float) -> Real:
        return self.trace.apply("logical_and", self, other)

    __rand__ = __and__

    def __or__(self, other: Real | float) -> Real:
        return self.trace.apply("logical_or", self, other)

    __ror__ = __or__

    def __floordiv__(self, other: Real | float) -> Real:
        return self.trace.apply("floor_divide", self, other)

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

    def __radd__(self, other: float) -> Real:
        return self + other

    def __sub__(self, other: Real | float) -> Real:
        return self + -other if isinstance(other, Real | float | int) else NotImplemented

    def __rsub__(self, other: float) -> Real:
        return -self + other

    def __mul__(self, other: Any) -> Any:
        if isinstance(other, complex):
            return Vector(self * other.real, self * other.imag)
        if not isinstance(other, Real | float | int):
            return NotImplemented
        if isinstance(other, float | int) and abs(other) == 1.0:
            return Real(self.trace, self.place, self.negative != (other < 0.0))
        other = self.trace.real(other)
        first, second = sorted((self.place, other.place))
        return Real(self.trace, self.trace.note("multiply", (first, second)), self.negative != other.negative)

    def __rmul__(self, other: Any) -> Any:
        return self * other

    def __truediv__(self, other: Real | float) -> Real:
        if not isinstance(other, Real | float | int):
            return NotImplemented
        if isinstance(other, float | int) and abs(other) == 1.0:
            return Real(self.trace, self.place, self.negative != (other < 0.0))
        other = self.trace.real(other)
        return Real(self.trace, self.trace.note("divide", (self.place, other.place)), self.negative != other.negative)

    def __rtruediv__(self, other: float) -> Real:
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
