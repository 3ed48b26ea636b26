"""Printed calculations: symbols that print the formula they go through, and numbers that recompute to the last digit.

A law that is called with symbols instead of numbers is its own print. Sums, products, quotients and powers become text
with the signs of printed mathematics and no more brackets than they need; functions of numpy, and those of
`plans.laws.named`, become their names. A constant that is a `Sign` stands as it says; π and its parts, halves and whole
numbers are known. A vector is its size: a turn by 90 degrees leaves it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import cache
from operator import add, mul, sub, truediv
from typing import Any, NamedTuple

from ..plans.laws import LAWS, Sign, form_of
from .words import Words

FUNCTIONS = ("sin", "cos", "tan", "arccos", "arcsin", "arctan")
OPERATORS = {"add": add, "subtract": sub, "multiply": mul, "divide": truediv}
POWERS = {1.5: "3/2"}
CONSTANTS = {math.pi: "π", 0.5 * math.pi: "π/2", 2.0 * math.pi: "2π"}
HALF = 0.5  # as a factor it is 2 below the line
DEGREES = 180.0 / math.pi  # in a radian
DIGITS = 4  # significant digits of a printed value
MOST = 10  # more digits than that would be rounding noise
FEWEST = 2  # significant digits of what small segments show
HUNDREDTHS = 2  # decimals of a segment, mm: a ruler reads no more
# digits of a result, most digits of what goes into it, whether segments may have more than hundredths of a millimetre
TRIES = ((DIGITS, 6, False), (3, 6, False), (FEWEST, 6, False), (DIGITS, DIGITS + MOST, True))
FINEST = 12  # decimals; what is smaller still is 0
POINT = 1e-6  # mm; a shorter segment is a point, and its quantity 0


@dataclass(frozen=True, eq=False, slots=True)
class _Atom:
    """A letter, a number or a function: its text; an exponent stands behind `base`, before `rest`."""

    text: str
    base: str = ""
    rest: str = ""

    @property
    def within(self) -> str:
        """Its text below the line or raised to a power, a product in brackets."""
        return f"({self.text})" if ("·" in self.text and not self.base) or self.text == "2π" else self.text


Factor = tuple["_Atom | Symbol", float]  # what stands there, and its power


class _Term(NamedTuple):
    """A product of factors over a product of others, perhaps negative."""

    above: tuple[Factor, ...] = ()
    below: tuple[Factor, ...] = ()
    negative: bool = False

    @property
    def over(self) -> str:
        """What stands below the line, behind a stroke."""
        texts = [*map(_written, self.below)]
        if len(texts) == 1 and isinstance(self.below[0][0], _Atom) and self.below[0][1] == 1:
            texts = [self.below[0][0].within]
        return "/" * bool(texts) + (f"({'·'.join(texts)})" if len(texts) > 1 else "".join(texts))

    @property
    def text(self) -> str:
        """The term without its sign."""
        return ("·".join(map(_written, self.above)) or "1") + self.over


class Symbol:
    """A quantity or an expression of quantities: a sum of terms."""

    __slots__ = ("terms",)
    __hash__ = None  # type: ignore[assignment]

    def __init__(self, *terms: _Term) -> None:
        self.terms = terms

    @classmethod
    def of(cls, text: str, base: str = "", rest: str = "") -> Symbol:
        """Return the symbol of a quantity, a letter or its number; a negative number is put in brackets.

        The exponent of its powers stands behind `base`, before `rest`; behind the text if these are not given.
        """
        if text.startswith("−"):
            text = base = f"({text})"
        return cls(_Term(((_Atom(text, base, rest), 1),)))

    @property
    def real(self) -> Symbol:
        """The size of a vector, all along itself."""
        return self

    @property
    def imag(self) -> float:
        """Nothing."""
        return 0.0

    @property
    def size(self) -> Symbol:
        """The expression without its sign: how large it is, where words tell the sense."""
        return -self if self.terms[0].negative else self

    @property
    def chunks(self) -> list[str]:
        """The terms of the sum with their signs, also those of a sum over something."""
        first, *rest = self.terms or (_Term(((_Atom("0"), 1),)),)
        if not rest and not first.negative and len(first.above) == 1 and isinstance(first.above[0][0], Symbol):
            chunks = first.above[0][0].chunks
            chunks[0], end = f"({chunks[0]}", _written(first.above[0]).rpartition(")")[2]
            chunks[-1] += f"){end}{first.over}"
            return chunks
        return ["−" * first.negative + first.text, *(f"{'−' if term.negative else '+'} {term.text}" for term in rest)]

    def __str__(self) -> str:
        return " ".join(self.chunks)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Symbol) and self.terms == other.terms

    def __neg__(self) -> Symbol:
        return Symbol(*(_Term(above, below, not negative) for above, below, negative in self.terms))

    def __add__(self, other: Any) -> Symbol:
        return Symbol(*self.terms, *_symbol(other).terms)

    def __radd__(self, other: Any) -> Symbol:
        return _symbol(other) + self

    def __sub__(self, other: Any) -> Symbol:
        return self + -_symbol(other)

    def __rsub__(self, other: Any) -> Symbol:
        return _symbol(other) + -self

    def __mul__(self, other: Any) -> Symbol:
        other = _symbol(other)
        if not self.terms or not other.terms:
            return Symbol()
        one, two = self._term, other._term
        above, below = _product(one.above, two.above), _product(one.below, two.below)
        return Symbol(_Term(above, below, one.negative != two.negative))

    def __rmul__(self, other: Any) -> Symbol:
        if type(other) in (int, float) and other == 1 and len(self.terms) == 1:  # as most products begin
            return self
        return _symbol(other) * self

    def __truediv__(self, other: Any) -> Symbol:
        other = _symbol(other)
        one, two = self._term, other._term
        if one.negative or one.below:
            one = _Term(((self, 1),))
        if two.below or two.negative:
            two = _Term(((other, 1),))
        return Symbol(_Term(one.above, two.above)) if two.above else self

    def __rtruediv__(self, other: Any) -> Symbol:
        return _symbol(other) / self

    def __pow__(self, power: float) -> Symbol:
        if power == 1:
            return self
        if power < 0:
            return 1.0 / self**-power
        if power == HALF:
            return Symbol.of(f"√({self})", f"√({self})")
        base, has = self._alone or (self, 1)
        return Symbol(_Term(((base if has == 1 else self, power),)))

    def function(self, name: str) -> Symbol:
        """Return the function of that name of the expression; brackets alone where the name is empty."""
        argument = f" {self}" if self._alone else f" ({self})"
        return Symbol(_Term(((_Atom(name + argument, name, argument) if name else _Atom(argument.lstrip()), 1),)))

    def __array_ufunc__(self, ufunc: Any, method: str, *operands: Any, **options: Any) -> Any:
        """Do for numbers of numpy and functions of numpy what the operators do."""
        name = ufunc.__name__
        if name in OPERATORS:
            return OPERATORS[name](*map(_symbol, operands))
        return self**HALF if name == "sqrt" else self.function(name) if name in FUNCTIONS else NotImplemented

    @property
    def _term(self) -> _Term:
        """The expression as one term: a sum as a factor in brackets."""
        return self.terms[0] if len(self.terms) == 1 else _Term(((self, 1),))

    @property
    def _alone(self) -> Factor | None:
        """The factor that the expression is, where it is no more than one."""
        above, below, negative = self._term
        return above[0] if len(self.terms) == len(above) == 1 and not below and not negative else None


@cache
def prints(law: str, operands: int) -> bool:
    """Whether a law of so many operands is an expression, not a procedure."""
    try:
        form_of(law)(*(Symbol.of("x") for _ in range(operands)))
    except TypeError:
        return False
    return True


def _symbol(value: Any) -> Symbol:
    """Return a number of a formula as a symbol; 0 is no term, 1 and a turn by 90 degrees are no factors."""
    if isinstance(value, Symbol):
        return value
    if isinstance(value, Sign):
        return Symbol.of(value.text) if value.text else Symbol(_Term())
    if getattr(value, "ndim", 0):
        raise TypeError("an array in a formula")
    if value in (1.0, 1j):
        return Symbol(_Term())
    if value < 0.0:
        return -_symbol(-value)
    if value == HALF:
        return Symbol(_Term(below=((_Atom("2"), 1),)))
    return Symbol.of(CONSTANTS.get(value, f"{value:g}")) if value else Symbol()


def _product(first: tuple[Factor, ...], second: tuple[Factor, ...]) -> tuple[Factor, ...]:
    """Return the factors of a product; a factor that is there already becomes a power."""
    if not (first and second):
        return first or second
    found = list(first)
    for base, power in second:
        if found and found[-1][0] == base:
            power += found.pop()[1]
        found.append((base, power))
    return tuple(found)


def _written(factor: Factor) -> str:
    """Return a factor with its power, a sum in brackets."""
    base, power = factor
    atom = _Atom(f"({base})", f"({base})") if isinstance(base, Symbol) else base
    return atom.text if power == 1 else f"{atom.base or atom.within}^{{{POWERS.get(power, f'{power:g}')}}}{atom.rest}"


@dataclass(frozen=True, slots=True)
class Input:
    """A number that goes into a printed calculation.

    One that is `exact` (a given, a scale factor) is printed as it is; one measured on the sheet has at most `places`
    decimals, as many as its ruler shows. In a formula it is called by its `name`, a `sign` follows its number, and its
    law takes one of `times` of it.
    """

    value: float
    exact: bool = False
    places: int | None = None
    name: str = ""
    sign: str = ""
    times: float = 1.0

    def decimals(self, digits: int, free: bool) -> int | None:
        """Return how many decimals show it with so many digits; `free` lets a segment have more than its ruler."""
        if self.exact:
            return None
        wanted = decimals_for(self.value, digits)
        return wanted if free or self.places is None else min(wanted, self.places)


def decimals_for(value: float, digits: int = DIGITS) -> int:
    """Return how many decimals show `value` with so many significant digits."""
    if value == 0.0 or not math.isfinite(value):
        return 0
    first = -math.floor(math.log10(abs(value)))  # decimals of its first digit
    return max(0, min(first + digits - 1, FINEST)) if first + DIGITS - 1 <= FINEST else 0


def value_text(words: Words, value: float) -> str:
    """Return a value with the usual digits; what is rounding noise of a millionth of a millionth is 0."""
    return words.number(value, decimals_for(value))


def ruler_decimals(words: Words) -> int:
    """Return the decimals of a segment that show hundredths of a millimetre in the unit of segments."""
    return HUNDREDTHS if words.display.paper == "mm" else HUNDREDTHS + 1  # of a centimetre


def segment_decimals(value: float, mu: float, least: int = HUNDREDTHS) -> tuple[int, int]:
    """Return decimals for a segment and for its value so that segment * mu is the value to its last printed digit.

    `least` decimals, hundredths of a millimetre, for no ruler reads more, and as many digits of the value as they show;
    only of a segment that shows less than `FEWEST` digits so, there are more.
    """
    size, usual = abs(value), decimals_for(value)
    if size < POINT * mu:
        return HUNDREDTHS, 0
    for places in range(least, least + MOST):
        for digits in range(DIGITS, FEWEST - 1, -1):
            decimals = decimals_for(value, digits)
            if round(round(size / mu, places) * mu, decimals) == round(size, decimals):
                return places, decimals
    return least + MOST, usual


def calculation(
    words: Words, law: Callable[..., float], inputs: Sequence[Input], wanted: int | None = None
) -> tuple[list[str], str]:
    """Return the printed inputs and the printed result of a calculation, such that it recomputes.

    Inputs get as many digits as it takes for the result to come out to its last printed digit; where segments of the
    sheet do not allow that, the result has fewer digits. It may have a `wanted` number of decimals.
    """
    values = [one.value for one in inputs]
    result = law(*values)
    measured = any(one.places is not None for one in inputs)
    for last, most, free in TRIES if measured else TRIES[-1:]:
        decimals = decimals_for(result, last) if wanted is None else wanted
        for digits in range(DIGITS, most + 1):
            places = [one.decimals(digits, free) for one in inputs]
            shown = [x if cut is None else round(x, cut) for x, cut in zip(values, places, strict=True)]
            with suppress(ArithmeticError, ValueError):  # numbers that are rounded to nothing may give none at all
                if round(law(*shown), decimals) == round(result, decimals):
                    return _texts(words, values, places), words.number(result, decimals)
    return _texts(words, values, places), words.number(result, decimals)


class Shown(NamedTuple):
    """How a result is printed: its unit, how many of it an SI unit has, and its decimals if these are said."""

    unit: str = ""
    times: float = 1.0
    decimals: int | None = None


def worked(words: Words, name: str, law: str, inputs: Sequence[Input], shown: Shown) -> tuple[str, ...]:
    """Return `name = formula = numbers = result unit` of a law, printed so that it recomputes."""
    unit, times, decimals = shown

    def of_printed(*numbers: float) -> float:
        return float(LAWS[law](*(number / one.times for number, one in zip(numbers, inputs, strict=True)))) * times

    texts, result = calculation(words, of_printed, inputs, decimals)
    letters = [Symbol.of(words.symbol(one.name)) for one in inputs]
    numbers = [Symbol.of(text + one.sign) for text, one in zip(texts, inputs, strict=True)]
    formula, reckoned = (str(form_of(law)(*terms)).replace("tan", words.symbol("tan")) for terms in (letters, numbers))
    gap = "" if unit == "deg" else " "
    said = f"= {result}{gap}{words.unit(unit)}" if unit else f"= {result}"
    return f"{words.symbol(name)} = {formula}", f"= {reckoned}", said


def _texts(words: Words, values: Sequence[float], places: Sequence[int | None]) -> list[str]:
    pairs = zip(values, places, strict=True)
    return [words.short(value) if cut is None else words.number(value, cut) for value, cut in pairs]
