"""The condition of each quantity: how much of an error of the data comes through, how flatly lines meet behind it.

K = sum over the givens of |x dQ/dx| over a size: when every given errs by one part in a thousand, Q may miss by K
thousandths of that size. It is the largest vector of the plan that shows Q (for points and lengths the size of the
mechanism), and the magnitude of Q itself where Q is calculated and no plan shows it: of a calculated Q log10 K digits
are lost. Per cents count beside a hundred. A value that is zero but for rounding has no digit to lose, and no K. The
derivatives are exact: the same program runs on dual numbers.

Dual numbers know how they change: a value, and its derivatives by several givens at once. A construction that runs on
them gives exact derivatives of everything it makes, by the rules of sums, products, quotients and roots, without a
second formula.

Source: Griewank, Walther, Evaluating Derivatives, 2nd edition, SIAM 2008, chapter 3.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..scales.errors import InputError
from .board import Program
from .boards.exact import PlainBoard
from .boards.template import ASTRAY, FEWEST, Laid, lay
from .laws import cross, dot
from .quantities import plans_of, references, results, unit_of, worst_behind
from .solved import Solved

Slopes = NDArray[Any]
# functions of numpy, and their derivatives: of one number by its value and their own, of two by both values
SLOPES: dict[str, Callable[[Any, Any], Any]] = {
    "sin": lambda x, found: np.cos(x),
    "cos": lambda x, found: -np.sin(x),
    "tan": lambda x, found: 1.0 + found * found,
    "arctan": lambda x, found: 1.0 / (1.0 + x * x),
    "sqrt": lambda x, found: _divided(0.5, found),
    **dict.fromkeys(("floor", "ceil"), lambda x, found: 0.0),
}
SLOPES_OF_TWO: dict[str, Callable[[Any, Any], tuple[Any, Any]]] = {
    "arctan2": lambda y, x: (_divided(x, x * x + y * y), _divided(-y, x * x + y * y)),
    "hypot": lambda x, y: (_divided(x, math.hypot(x, y)), _divided(y, math.hypot(x, y))),
    "maximum": lambda x, y: (float(not x < y), float(x < y)),
    "minimum": lambda x, y: (float(not x > y), float(x > y)),
}
OPERATORS = {
    **{"add": operator.add, "subtract": operator.sub, "multiply": operator.mul, "divide": operator.truediv},
    **{"less": operator.lt, "less_equal": operator.le, "greater": operator.gt, "greater_equal": operator.ge},
    "equal": operator.eq,
}


def _compared(compare: Callable[[Any, Any], bool]) -> Callable[[_Dual, Any], bool]:
    return lambda number, other: bool(compare(number.value, _value_of(other)))


class _Dual:
    """A real number or a vector (complex), and its derivatives as an array of shape (givens,).

    Comparisons look at the value alone.
    """

    __slots__ = ("slopes", "value")

    def __init__(self, value: Any, slopes: Slopes) -> None:
        self.value, self.slopes = value, slopes

    @property
    def real(self) -> _Dual:
        """The x component."""
        return _Dual(self.value.real, self.slopes.real)

    @property
    def imag(self) -> _Dual:
        """The y component."""
        return _Dual(self.value.imag, self.slopes.imag)

    def through(self, function: Callable[[Any], Any], slope: Callable[[Any], Any]) -> _Dual:
        """Return a function of the number whose derivative is known."""
        return _Dual(function(self.value), self.slopes * slope(self.value))

    def __array_ufunc__(self, ufunc: Any, method: str, *operands: Any, **options: Any) -> Any:
        """Do for numbers of numpy and functions of numpy what the operators do."""
        name, values = ufunc.__name__, [_value_of(operand) for operand in operands]
        if method != "__call__" or options or any(map(np.ndim, values)):
            return NotImplemented
        if name in OPERATORS:
            return OPERATORS[name](*(x.item() if hasattr(x, "item") else x for x in operands))
        if name not in SLOPES and name not in SLOPES_OF_TWO:
            return NotImplemented
        found = ufunc(*values)
        slopes = SLOPES_OF_TWO[name](*values) if len(values) > 1 else (SLOPES[name](values[0], found),)
        return _Dual(found, sum(slope * _slopes_of(x) for slope, x in zip(slopes, operands, strict=True)))

    def __array_function__(self, function: Any, types: Any, operands: Any, options: Any) -> Any:
        """Choose between numbers as numpy does; one has no axes."""
        if function is np.where:
            condition, first, second = operands
            return first if _value_of(condition) else second
        return 0 if function is np.ndim else NotImplemented

    def __pow__(self, power: float) -> _Dual:
        return _Dual(self.value**power, self.slopes * (power * self.value ** (power - 1.0)))

    def __add__(self, other: Any) -> _Dual:
        if isinstance(other, _Dual):
            return _Dual(self.value + other.value, self.slopes + other.slopes)
        return _Dual(self.value + other, self.slopes)

    __radd__ = __add__

    def __neg__(self) -> _Dual:
        return _Dual(-self.value, -self.slopes)

    def __sub__(self, other: Any) -> Any:
        return self + -other

    def __rsub__(self, other: Any) -> Any:
        return -self + other

    def __mul__(self, other: Any) -> _Dual:
        if isinstance(other, _Dual):
            return _Dual(self.value * other.value, self.slopes * other.value + other.slopes * self.value)
        return _Dual(self.value * other, self.slopes * other)

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> _Dual:
        if isinstance(other, _Dual):
            quotient = _divided(self.value, other.value)
            return _Dual(quotient, (self.slopes - other.slopes * quotient) * _divided(1.0, other.value))
        return _Dual(_divided(self.value, other), self.slopes * _divided(1.0, other))

    def __rtruediv__(self, other: Any) -> _Dual:
        quotient = _divided(other, self.value)
        return _Dual(quotient, self.slopes * -_divided(quotient, self.value))

    def __rfloordiv__(self, other: Any) -> Any:
        return other // self.value

    def __floordiv__(self, other: Any) -> Any:
        return self.value // _value_of(other)

    def __abs__(self) -> _Dual:
        if self.value == 0.0:  # to either side the size grows
            return _Dual(0.0, np.abs(self.slopes))
        return -self if self.value < 0.0 else self

    def __float__(self) -> float:
        return float(self.value)

    def __bool__(self) -> bool:
        return bool(self.value)

    def __eq__(self, other: object) -> bool:
        return bool(self.value == _value_of(other))

    __hash__ = None  # type: ignore[assignment]

    __lt__, __le__ = _compared(operator.lt), _compared(operator.le)
    __gt__, __ge__ = _compared(operator.gt), _compared(operator.ge)


def _value_of(number: Any) -> Any:
    """Return the value of a number of either kind."""
    return number.value if isinstance(number, _Dual) else number


def _slopes_of(number: Any) -> Any:
    """Return the derivatives of a number of either kind."""
    return number.slopes if isinstance(number, _Dual) else 0.0


def _divided(number: Any, divisor: Any) -> Any:
    """Divide, NaN by zero."""
    return number / divisor if divisor else math.nan


def root(square: _Dual) -> _Dual:
    """Return the square root; at zero its derivatives are infinite, or none where the square does not change."""
    size = math.sqrt(square.value) if square.value >= 0.0 else math.nan
    if size == 0.0:
        return _Dual(0.0, np.where(square.slopes == 0.0, 0.0, math.inf))
    return _Dual(size, square.slopes * (0.5 / size))


STEP = 1e-5  # part of a given, of central differences where duals do not reach; what these leave out is its square
MOST = 2.0**52  # K from which on a value is nothing but rounding


@dataclass(frozen=True, slots=True)
class Condition:
    """The condition of a quantity, None where it has none, and the sine of the worst intersection behind it."""

    value: float | None
    sine: float


class _DualBoard(PlainBoard):
    """One position with its derivatives by the givens that are dual numbers."""

    @staticmethod
    def _sqrt(square: Any) -> Any:
        return root(square) if isinstance(square, _Dual) else PlainBoard._sqrt(square)

    @staticmethod
    def _complex(real: Any, imag: Any) -> Any:
        value = complex(_value_of(real), _value_of(imag))
        if isinstance(real, _Dual) or isinstance(imag, _Dual):
            return _Dual(value, _slopes_of(real) + _slopes_of(imag) * 1j)
        return value

    def _turn(self, angle: Any) -> Any:
        """Turn a direction by 90 degrees for its derivative by the angle: the protractor's table has none."""
        if not isinstance(angle, _Dual):
            return super()._turn(angle)
        direction = super()._turn(angle.value)
        return _Dual(direction, angle.slopes * (direction * 1j))

    def _lay_template(self, names: tuple[str, ...], where: tuple[Any, ...]) -> Laid:
        """Begin where the template lies in the end: there a single correction has all derivatives."""
        if names not in self._templates:
            laid = lay([*map(_value_of, where)], names, PlainBoard._sqrt, PlainBoard._complex, self.corrections)
            place, turn = laid.finished(laid.determinant)
            begin = place.real, place.imag, turn.real, turn.imag
            self._templates[names] = lay((*begin, *where[ASTRAY:]), names, self._sqrt, self._complex, FEWEST)
        return self._templates[names]

    def _angle(self, first: Any, second: Any) -> Any:
        angle = super()._angle(_value_of(first), _value_of(second))
        return _Dual(angle, _turning(second) - _turning(first))


def _turning(direction: Any) -> Any:
    """Return the derivatives of the angle of a direction."""
    value, slopes = _value_of(direction), _slopes_of(direction)
    return cross(value, slopes) / dot(value, value)


def derivatives(
    program: Program, givens: Mapping[str, Any], varied: Collection[str], names: Iterable[str] = ()
) -> dict[str, Any]:
    """Return x dQ/dx of `names`, without them of every name that the program makes, for each given x of `varied`.

    The derivatives, in units of the quantity, have the shape (givens,), and are complex for vectors.
    """
    one = np.eye(len(varied))
    own = {name: _Dual(float(givens[name]), one[i] * givens[name]) for i, name in enumerate(varied)}
    board = _DualBoard({**givens, **own})
    with np.errstate(invalid="ignore", divide="ignore"):
        program.run(board)
    return {name: np.broadcast_to(_slopes_of(board.values[name]), len(varied)) for name in names or program.names}


def by_solving_again(
    solve_with: Callable[[Mapping[str, float]], Mapping[str, Any]], numbers: Mapping[str, float]
) -> dict[str, float]:
    """Return the sum of |x dQ/dx| over the `numbers` x of every Q, by differences: of what is found beside the board.

    A number at the end of what is permitted is changed to one side alone; one that is nothing or infinite has no parts.
    """
    right = solve_with(numbers)
    totals = dict.fromkeys(right, 0.0)
    for name, value in numbers.items():
        if value == 0.0 or math.isinf(value):
            continue
        found, apart = [], 0.0
        for step in (STEP, -STEP):
            try:
                found.append(solve_with({**numbers, name: value * (1.0 + step)}))
                apart += STEP
            except InputError:
                found.append(right)
        more, less = found
        for quantity in totals:
            totals[quantity] += abs(more[quantity] - less[quantity]) / apart if apart else math.inf
    return totals


def conditions_again(
    solved: Solved, solve: Callable[[Mapping[str, float]], Solved], numbers: Mapping[str, float]
) -> dict[str, Condition]:
    """Return the condition of every quantity of what is solved again from changed `numbers`."""

    def solve_with(others: Mapping[str, float]) -> dict[str, float]:
        there = solve(others).quantities
        values = ((name, there[name].value if name in there else None) for name in solved.quantities)
        return {name: math.nan if value is None else value for name, value in values}

    totals, own = by_solving_again(solve_with, numbers), solve_with(numbers)
    worst = worst_behind(solved.program, solved.sines)
    return {name: Condition(ratio(total, abs(own[name])), worst.get(name, 1.0)) for name, total in totals.items()}


def conditions(
    program: Program,
    givens: Mapping[str, Any],
    varied: Collection[str],
    values: Mapping[str, Any],
    sines: Any,
    names: Collection[str] = (),
) -> dict[str, Condition]:
    """Return the condition of every quantity of `program`, or of `names`, whose exact run gave `values` and `sines`.

    The givens `varied` may err: not senses and branches.
    """
    wanted = tuple(names) or tuple(step.name for step in results(program))
    slopes = derivatives(program.needed_for(wanted) if names else program, givens, varied, wanted)
    sizes, worst, found = _sizes_beside(program, values), worst_behind(program, sines), {}
    for name in wanted:
        total = float(np.abs(slopes[name]).sum())
        found[name] = Condition(ratio(total, sizes[name]) if values[name] == values[name] else None, worst[name])
    return found


def _sizes_beside(program: Program, values: Mapping[str, Any]) -> dict[str, float]:
    """Return for each quantity the size that its condition refers to, in its unit: see above."""
    shown, sizes = plans_of(program), references(program, values)
    own = {name: float(abs(values[name])) for name in sizes if name not in shown and unit_of(name) != "%"}
    return sizes | own


def ratio(total: float, size: float) -> float | None:
    """Return K from what data do together to a quantity, None for what is undefined or nothing but rounding."""
    if not math.isfinite(total) or size != size:
        return None
    if total == 0.0:
        return 0.0
    return total / size if total < MOST * size else None
