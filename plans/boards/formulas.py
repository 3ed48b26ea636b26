"""Formulas on arrays written down for a page: numbers that note what numpy does with them, printed as JavaScript.

What a course calculates for many places at once it calculates with these for none: the sums, products and functions
are noted (`trace`), complex numbers as their two parts, and printed as a program for one place.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from .batch import Script, result_of
from .printers import in_order
from .trace import Real, Trace, Vector

Part = Real | float
Formulas = Callable[[Callable[[str], Any]], Mapping[str, Any]]


class Written:
    """A number, real or complex, that is written down; numpy's functions leave it to `FUNCTIONS`."""

    __hash__ = None  # type: ignore[assignment]
    __slots__ = ("x", "y")

    def __init__(self, x: Part, y: Part = 0.0) -> None:
        self.x, self.y = x, y

    @property
    def real(self) -> Written:
        """The real part."""
        return Written(self.x)

    @property
    def imag(self) -> Written:
        """The imaginary part."""
        return Written(self.y)

    def conj(self) -> Written:
        """Return the conjugate number."""
        return Written(self.x, -self.y)

    def __array_ufunc__(self, function: Any, method: str, *numbers: Any, **how: Any) -> Any:
        do = FUNCTIONS.get(function.__name__)
        return NotImplemented if do is None or method != "__call__" or how else do(*map(_written, numbers))

    def __array_function__(self, function: Any, kinds: Any, numbers: Any, how: Any) -> Any:
        return _where(*numbers) if function is np.where and not how else NotImplemented

    def __bool__(self) -> bool:
        raise TypeError("no value while formulas are written down")

    def __neg__(self) -> Written:
        return Written(-self.x, -self.y)

    def __add__(self, other: Any) -> Written:
        other = _written(other)
        return Written(self.x + other.x, self.y + other.y)

    __radd__ = __add__

    def __sub__(self, other: Any) -> Written:
        return self + -_written(other)

    def __rsub__(self, other: Any) -> Written:
        return -self + _written(other)

    def __mul__(self, other: Any) -> Written:
        other = _written(other)
        return Written(
            _times(self.x, other.x) + -_times(self.y, other.y), _times(self.x, other.y) + _times(self.y, other.x)
        )

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> Written:
        other = _written(other)
        if not _is_zero(other.y):
            raise TypeError("a quotient of complex numbers")
        return Written(_over(self.x, other.x), _over(self.y, other.x))

    def __rtruediv__(self, other: Any) -> Written:
        return _written(other) / self

    def __pow__(self, power: float) -> Written:
        return _applied("power")(self, Written(float(power)))

    def __abs__(self) -> Written:
        if _is_zero(self.y):
            return Written(abs(self.x))  # type: ignore[arg-type]
        return SQRT(Written(_times(self.x, self.x) + _times(self.y, self.y)))

    def __lt__(self, other: Any) -> Written:
        return _applied("less")(self, _written(other))

    def __le__(self, other: Any) -> Written:
        return _applied("less_equal")(self, _written(other))

    def __gt__(self, other: Any) -> Written:
        return _written(other) < self

    def __ge__(self, other: Any) -> Written:
        return _written(other) <= self


def _written(number: Any) -> Written:
    if isinstance(number, Written):
        return number
    number = complex(number)
    return Written(number.real, number.imag)


def _is_zero(part: Part) -> bool:
    return not isinstance(part, Real) and part == 0.0


def _times(a: Part, b: Part) -> Part:
    return 0.0 if _is_zero(a) or _is_zero(b) else a * b


def _over(a: Part, b: Part) -> Part:
    if isinstance(a, Real) or isinstance(b, Real):
        return 0.0 if _is_zero(a) else a / b
    return float(np.divide(a, b))


def _applied(operation: str) -> Callable[..., Written]:
    """Return an operation on real numbers that is noted, or done where all of them are known."""

    def do(*numbers: Any) -> Written:
        if not all(_is_zero(number.y) for number in numbers):
            raise TypeError(f"{operation} of complex numbers")
        noted = next((number.x for number in numbers if isinstance(number.x, Real)), None)
        if noted is None:
            return Written(float(getattr(np, operation)(*(number.x for number in numbers))))
        return Written(noted.trace.apply(operation, *(number.x for number in numbers)))

    return do


def _where(condition: Any, first: Any, second: Any) -> Written:
    yes, no = _written(first), _written(second)
    if not isinstance(condition, Written):
        return yes if condition else no
    if not isinstance(condition.x, Real):
        return yes if condition.x else no
    if _is_zero(yes.y) and _is_zero(no.y):
        return Written(condition.x.trace.apply("where", condition.x, yes.x, no.x))
    return Written(*(condition.x.trace.apply("where", condition.x, a, b) for a, b in ((yes.x, no.x), (yes.y, no.y))))


SQRT = _applied("sqrt")
FUNCTIONS: dict[str, Callable[..., Any]] = {
    **{name: _applied(name) for name in ("sin", "cos", "arctan2", "sqrt", "less", "less_equal", "power")},
    "greater": lambda a, b: b < a,
    "greater_equal": lambda a, b: b <= a,
    "add": lambda a, b: a + b,
    "subtract": lambda a, b: a - b,
    "multiply": lambda a, b: a * b,
    "divide": lambda a, b: a / b,
    "negative": lambda a: -a,
    "absolute": abs,
    "conjugate": Written.conj,
    "hypot": lambda a, b: abs(a + b * 1j),
    "floor": lambda a: _applied("floor_divide")(a, Written(1.0)),
    "isinf": lambda a: Written(0.0),  # what changes from place to place is finite
}


def script_of_formulas(formulas: Formulas, function: str = "solve") -> tuple[str, list[str]]:
    """Return formulas as source of JavaScript, such as `solve(given)`, and the names of what it finds, in order.

    The `formulas` are a function that asks for what is given by its name, and returns numbers by their names. The
    function of JavaScript takes the given numbers by name and returns an array as that of a program does
    (`batch.script_of`): zero first, then each of the names, complex numbers as arrays of two.
    """
    trace = Trace()
    found = {name: _written(number) for name, number in formulas(lambda name: Written(trace.given(name))).items()}
    values = [number.x if _is_zero(number.y) else Vector(number.x, number.y) for number in found.values()]
    places = [part.place for number in found.values() for part in (number.x, number.y) if isinstance(part, Real)]
    script = Script(trace, in_order(trace, places), places)
    return script.source(function, ", ".join(result_of(script, value, "[{}, {}]") for value in values)), [*found]
