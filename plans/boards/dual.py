"""Numbers that know how they change: a value, and its derivatives by several givens at once.

A construction that runs on them gives exact derivatives of everything it makes, by the rules of sums, products,
quotients and roots (forward differentiation with dual numbers), without a second formula.

Source: Griewank, Walther, Evaluating Derivatives, 2nd edition, SIAM 2008, chapter 3.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

Slopes = NDArray[Any]
# functions of numpy, and their derivatives: of one number by its value and their own, of two by both values
SLOPES: dict[str, Callable[[Any, Any], Any]] = {
    "sin": lambda x, found: np.cos(x),
    "cos": lambda x, found: -np.sin(x),
    "tan": lambda x, found: 1.0 + found * found,
    "arctan": lambda x, found: 1.0 / (1.0 + x * x),
    "sqrt": lambda x, found: divided(0.5, found),
    **dict.fromkeys(("floor", "ceil"), lambda x, found: 0.0),
}
SLOPES_OF_TWO: dict[str, Callable[[Any, Any], tuple[Any, Any]]] = {
    "arctan2": lambda y, x: (divided(x, x * x + y * y), divided(-y, x * x + y * y)),
    "hypot": lambda x, y: (divided(x, math.hypot(x, y)), divided(y, math.hypot(x, y))),
    "maximum": lambda x, y: (float(not x < y), float(x < y)),
    "minimum": lambda x, y: (float(not x > y), float(x > y)),
}
OPERATORS = {
    **{"add": operator.add, "subtract": operator.sub, "multiply": operator.mul, "divide": operator.truediv},
    **{"less": operator.lt, "less_equal": operator.le, "greater": operator.gt, "greater_equal": operator.ge},
    "equal": operator.eq,
}


class Dual:
    """A real number or a vector (complex), and its derivatives as an array of shape (givens,).

    Comparisons look at the value alone.
    """

    __slots__ = ("slopes", "value")

    def __init__(self, value: Any, slopes: Slopes) -> None:
        self.value, self.slopes = value, slopes

    @property
    def real(self) -> Dual:
        """The x component."""
        return Dual(self.value.real, self.slopes.real)

    @property
    def imag(self) -> Dual:
        """The y component."""
        return Dual(self.value.imag, self.slopes.imag)

    def through(self, function: Callable[[Any], Any], slope: Callable[[Any], Any]) -> Dual:
        """Return a function of the number whose derivative is known."""
        return Dual(function(self.value), self.slopes * slope(self.value))

    def __array_ufunc__(self, ufunc: Any, method: str, *operands: Any, **options: Any) -> Any:
        """Do for numbers of numpy and functions of numpy what the operators do."""
        name, values = ufunc.__name__, [value_of(operand) for operand in operands]
        if method != "__call__" or options or any(map(np.ndim, values)):
            return NotImplemented
        if name in OPERATORS:
            return OPERATORS[name](*(x.item() if hasattr(x, "item") else x for x in operands))
        if name not in SLOPES and name not in SLOPES_OF_TWO:
            return NotImplemented
        found = ufunc(*values)
        slopes = SLOPES_OF_TWO[name](*values) if len(values) > 1 else (SLOPES[name](values[0], found),)
        return Dual(found, sum(slope * slopes_of(x) for slope, x in zip(slopes, operands, strict=True)))

    def __array_function__(self, function: Any, types: Any, operands: Any, options: Any) -> Any:
        """Choose between numbers as numpy does; one has no axes."""
        if function is np.where:
            condition, first, second = operands
            return first if value_of(condition) else second
        return 0 if function is np.ndim else NotImplemented

    def __pow__(self, power: float) -> Dual:
        return Dual(self.value**power, self.slopes * (power * self.value ** (power - 1.0)))

    def __add__(self, other: Any) -> Dual:
        if isinstance(other, Dual):
            return Dual(self.value + other.value, self.slopes + other.slopes)
        return Dual(self.value + other, self.slopes)

    __radd__ = __add__

    def __neg__(self) -> Dual:
        return Dual(-self.value, -self.slopes)

    def __sub__(self, other: Any) -> Dual:
        if isinstance(other, Dual):
            return Dual(self.value - other.value, self.slopes - other.slopes)
        return Dual(self.value - other, self.slopes)

    def __rsub__(self, other: Any) -> Dual:
        return Dual(other - self.value, -self.slopes)

    def __mul__(self, other: Any) -> Dual:
        if isinstance(other, Dual):
            return Dual(self.value * other.value, self.slopes * other.value + other.slopes * self.value)
        return Dual(self.value * other, self.slopes * other)

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> Dual:
        if isinstance(other, Dual):
            quotient = divided(self.value, other.value)
            return Dual(quotient, (self.slopes - other.slopes * quotient) * divided(1.0, other.value))
        return Dual(divided(self.value, other), self.slopes * divided(1.0, other))

    def __rtruediv__(self, other: Any) -> Dual:
        quotient = divided(other, self.value)
        return Dual(quotient, self.slopes * -divided(quotient, self.value))

    def __rfloordiv__(self, other: Any) -> Any:
        return other // self.value

    def __floordiv__(self, other: Any) -> Any:
        return self.value // value_of(other)

    def __abs__(self) -> Dual:
        if self.value == 0.0:  # to either side the size grows
            return Dual(0.0, np.abs(self.slopes))
        return -self if self.value < 0.0 else self

    def __float__(self) -> float:
        return float(self.value)

    def __bool__(self) -> bool:
        return bool(self.value)

    def __eq__(self, other: object) -> bool:
        return bool(self.value == value_of(other))

    __hash__ = None  # type: ignore[assignment]

    def __lt__(self, other: Any) -> bool:
        return bool(self.value < value_of(other))

    def __le__(self, other: Any) -> bool:
        return bool(self.value <= value_of(other))

    def __gt__(self, other: Any) -> bool:
        return bool(self.value > value_of(other))

    def __ge__(self, other: Any) -> bool:
        return bool(self.value >= value_of(other))


def value_of(number: Any) -> Any:
    """Return the value of a number of either kind."""
    return number.value if isinstance(number, Dual) else number


def slopes_of(number: Any) -> Any:
    """Return the derivatives of a number of either kind."""
    return number.slopes if isinstance(number, Dual) else 0.0


def divided(number: Any, divisor: Any) -> Any:
    """Divide, NaN by zero."""
    return number / divisor if divisor else math.nan


def root(square: Dual) -> Dual:
    """Return the square root; at zero its derivatives are infinite, or none where the square does not change."""
    size = math.sqrt(square.value) if square.value >= 0.0 else math.nan
    if size == 0.0:
        return Dual(0.0, np.where(square.slopes == 0.0, 0.0, math.inf))
    return Dual(size, square.slopes * (0.5 / size))
