"""Printed calculations: symbols that print the formula they go through, and numbers that recompute to the last digit.

A law that is called with symbols instead of numbers is its own print. Sums, products, quotients and powers become text
with the signs of printed mathematics and no more brackets than they need; functions of numpy, and those of
`plans.laws.named`, become their names. A constant that is a `Sign` stands as it says; π and its parts, halves and whole
numbers are known. A vector is its size: a turn by 90 degrees leaves it.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from itertools import combinations
from operator import add, mul, sub, truediv
from typing import Any, NamedTuple, TypeAlias

from ..plans.laws import LAWS, Sign, form_of
from ..scales.numbers import rounded
from .words import Words

FUNCTIONS = ("sin", "cos", "tan", "arccos", "arcsin", "arctan")
OPERATORS = {"add": add, "subtract": sub, "multiply": mul, "divide": truediv}
POWERS = {1.5: "3/2"}
CONSTANTS = {math.pi: "π", 0.5 * math.pi: "π/2", 2.0 * math.pi: "2π"}
HALF = 0.5  # as a factor it is 2 below the line
DEGREES = 180.0 / math.pi  # in a radian
DIGITS = 4  # significant digits of a printed value
ONE_WITH = 6  # digits of one input that is printed with more than the others
MOST = 10  # more digits than that would be rounding noise
FEWEST = 2  # of what small segments show
HUNDREDTHS, LONG = 2, 100.0  # decimals of a segment, mm: a ruler reads no more; from where on it has one less
AS_TOLD = 0  # instead of a number of digits: as many as the sheet prints elsewhere
Fits: TypeAlias = Callable[[str, bool], bool]  # whether a number has a segment, one that a ruler tells if that is asked
AS_PRINTED = -1  # instead of decimals of a result: what the printed numbers give, with a digit more than usual
FINEST = 12  # decimals; what is smaller still is 0
SLACK = 5.0  # of the last digit, by which what printed numbers give may miss what is solved
READABLE = 1.0  # mm; of a shorter segment hundredths may be too few to tell its value
TIE = 1e-9  # of the last digit, by which what is reckoned may miss a half
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

    One that is `exact` (a given, a scale factor) is printed as it is; what the sheet prints elsewhere stands there as
    `told`, and never otherwise if it is `fixed`. In a formula it is called by its `name`, a `sign` follows its number,
    and its law takes one of `times` of it.
    """

    value: float
    exact: bool = False
    fixed: bool = False
    name: str = ""
    sign: str = ""
    times: float = 1.0
    told: str = ""

    def printed(self, digits: int) -> float:
        """Return it as it is printed with so many digits, or as it is `AS_TOLD`."""
        if self.told and digits == AS_TOLD:
            return number_of(self.told)
        return self.value if self.exact else rounded(self.value, decimals_for(self.value, digits or DIGITS))

    def text(self, words: Words, digits: int) -> str:
        """Return its number with so many digits, or as it is `AS_TOLD`."""
        if self.told and digits == AS_TOLD:
            return self.told
        return words.short(self.value) if self.exact else value_text(words, self.value, digits or DIGITS)


def decimals_for(value: float, digits: int = DIGITS) -> int:
    """Return how many decimals show `value` with so many significant digits."""
    if value == 0.0 or not math.isfinite(value):
        return 0
    first = -math.floor(math.log10(abs(value)))  # decimals of its first digit
    return max(0, min(first + digits - 1, FINEST)) if first + DIGITS - 1 <= FINEST else 0


def value_text(words: Words, value: float, digits: int = DIGITS) -> str:
    """Return a value with the usual digits, ∞ with its sign; rounding noise of a millionth of a millionth is 0."""
    if math.isinf(value):
        return "∞" if value > 0.0 else "−∞"
    return words.number(value, decimals_for(value, digits))


def ruler_decimals(words: Words, segment: float) -> int:
    """Return the decimals of a segment in the unit of segments: hundredths of a mm, from 100 mm on tenths.

    What is read with a ruler has tenths from a millimetre on: what is shorter is read in a detail.
    """
    centimetres = words.display.paper != "mm"
    mm = round(abs(segment) * (10.0 if centimetres else 1.0), HUNDREDTHS)
    long = mm >= (READABLE if words.ruler else LONG)
    return HUNDREDTHS - long + centimetres


def segment_text(words: Words, segment: float, fine: bool = False) -> str:
    """Return a length on paper, in the unit of segments, as a ruler shows it; `fine` with its hundredths of a mm."""
    usual, finest = (words.number(segment, ruler_decimals(words, size)) for size in (segment, 0.0))
    return finest if fine and number_of(finest) != number_of(usual) else usual


def read_off(
    words: Words, value: float, mu: float, readable: float = READABLE, *, fine: bool = False
) -> tuple[str, str]:
    """Return a segment that shows a value at the scale factor `mu`, as a ruler reads it, and their product.

    Of what is shorter than `readable` and has fewer than two digits there is no segment. One that is `fine` has its
    hundredths of a mm however long it is.
    """
    segment = abs(value) / mu
    if segment < POINT:
        return segment_text(words, 0.0), words.number(0.0, 0)
    mm = segment_text(words, segment, fine)
    digits = len(re.sub(r"\D", "", mm).lstrip("0"))
    if segment < readable and digits < FEWEST:
        return "", value_text(words, abs(value))
    return mm, shortest(words, number_of(mm) * mu, digits)


def shortest(words: Words, value: float, digits: int = DIGITS) -> str:
    """Return a value with so many digits, or with more of the five that it has at most, where it is not rounded."""
    most = decimals_for(value, DIGITS + 1)
    places = range(min(decimals_for(value, digits), most), most + 1)
    return words.number(value, next(d for d in places if rounded(value, d) == rounded(value, most)))


def laid_off(words: Words, value: float, mu: float, known: str, readable: bool = False) -> str:
    """Return the segment of a value whose number is `known`, so that segment * mu is that number; else nothing.

    It is as long as it is drawn, to the last digit that a ruler shows. It has one digit more than a ruler where a
    number could not be told from others, or even two unless it must be `readable`, and is a hundredth of a mm off its
    drawing at most.
    """
    segment = abs(value) / mu
    usual, finest = ruler_decimals(words, segment), ruler_decimals(words, 0.0)
    for decimals in range(usual, finest + 1 + (not readable)):
        here, step = rounded(segment, decimals), 10.0**-decimals
        most = (0.5 * step if decimals < finest else 10.0**-finest) * (1.0 + TIE)
        beside = (here - step, here + step, rounded(number_of(known) / mu, decimals)) if decimals >= finest else ()
        for mm in (here, *beside):
            if abs(mm - segment) <= most and recomputes(mm * mu, known):
                return words.number(mm, decimals)
    return ""


def number_of(text: str) -> float:
    """Return a printed number as a number."""
    return float(text.replace("−", "-").replace(",", "."))


def recomputes(reckoned: float, text: str) -> bool:
    """Whether a printed number is what other printed ones give, rounded as usual."""
    return _agree(reckoned, number_of(text), places_of(text))


def places_of(text: str) -> int:
    """Return how many decimals a printed number has."""
    return len(text.replace(",", ".").partition(".")[2])


def _agree(reckoned: float, value: float, decimals: int) -> bool:
    """Whether a value with so many decimals is what printed numbers give, to its last digit: a half goes up."""
    over = math.copysign(1.0, reckoned) * (reckoned - rounded(value, decimals)) * 10.0**decimals
    return -HALF - TIE <= over < HALF - TIE


def calculation(
    words: Words,
    law: Callable[..., float],
    inputs: Sequence[Input],
    wanted: int | None = None,
    fits: Fits | None = None,
    same: str = "",
) -> tuple[list[str], str]:
    """Return the printed inputs and the printed result of a calculation, such that it recomputes.

    Inputs that the sheet tells elsewhere are as they are there, and then the result is what they give, with as many
    digits as its segment `fits`, or as it has in common with one that is the `same`; its last but one is right. Other
    inputs have as many digits as it takes for the result to come out. It has a `wanted` number of decimals, or is
    `AS_PRINTED`.
    """
    if inputs and all(one.fixed for one in inputs):
        reckoned = as_printed(law, inputs)
        if same:
            most, known = places_of(same), number_of(same)
            alike = (n for n in range(most, -1, -1) if rounded(abs(reckoned), n) == rounded(known, n))
            text = words.number(reckoned, next(alike, most))
        elif wanted is None or wanted == AS_PRINTED:
            text = _as_it_fits(words, reckoned, law, inputs, DIGITS + (wanted == AS_PRINTED), fits)
        else:
            text = words.number(reckoned, wanted)
        return _texts(words, inputs, [AS_TOLD] * len(inputs)), text
    result, numbers = law(*(one.value for one in inputs)), _Numbers(inputs)
    decimals = decimals_for(result) if wanted is None else wanted
    for digits in _digits(inputs):
        with suppress(ArithmeticError, ValueError):  # numbers that are rounded to nothing may give none at all
            if _agree(law(*numbers.with_digits(digits)), result, decimals):
                break
    return _texts(words, inputs, digits), words.number(result, decimals)


def _as_it_fits(
    words: Words,
    reckoned: float,
    law: Callable[..., float],
    inputs: Sequence[Input],
    most: int,
    fits: Fits | None,
) -> str:
    """Return what printed numbers give with as many digits as its segment fits, the last but one of which is right.

    Of what follows from exact numbers alone there is one digit more where it is not rounded.
    """
    right, usual = law(*(one.value for one in inputs)), value_text(words, reckoned, most)
    usual = shortest(words, reckoned) if all(one.exact for one in inputs) else usual
    ways = [usual, *(value_text(words, reckoned, digits) for digits in (DIGITS + 1, *range(DIGITS, FEWEST, -1)))]
    if most == DIGITS:  # with more it is to be compared with what is found another way
        ways = [way for way in ways if abs(number_of(way) - right) <= SLACK * 10.0 ** -places_of(way)] or ways
    if fits is None:
        return ways[0]
    return next((way for readable in (True, False) for way in ways if fits(way, readable)), ways[0])


def as_printed(law: Callable[..., float], inputs: Sequence[Input]) -> float:
    """Return what the printed numbers of a calculation give, without the noise of reckoning."""
    try:
        reckoned = law(*(one.printed(AS_TOLD) for one in inputs))
    except ArithmeticError:  # a divisor that is rounded to nothing
        reckoned = law(*(one.value for one in inputs))
    return rounded(reckoned, decimals_for(reckoned, MOST))


class Shown(NamedTuple):
    """How a result is printed: its unit, how many of it an SI unit has, its decimals if these are said, its power."""

    unit: str = ""
    times: float = 1.0
    decimals: int | None = None
    sign: str = ""


def worked(words: Words, name: str, law: str, inputs: Sequence[Input], shown: Shown) -> tuple[str, ...]:
    """Return `name = formula = numbers = result unit` of a law, printed so that it recomputes."""
    unit, times, decimals, sign = shown

    def of_printed(*numbers: float) -> float:
        return float(LAWS[law](*(number / one.times for number, one in zip(numbers, inputs, strict=True)))) * times

    texts, result = calculation(words, of_printed, inputs, decimals)
    letters = [Symbol.of(words.symbol(one.name)) for one in inputs]
    numbers = [Symbol.of(text + one.sign) for text, one in zip(texts, inputs, strict=True)]
    formula, reckoned = (str(form_of(law)(*terms)).replace("tan", words.symbol("tan")) for terms in (letters, numbers))
    gap = "" if unit == "deg" else " "
    said = f"= {result}{sign}{gap}{words.unit(unit)}" if unit else f"= {result}{sign}"
    return f"{words.symbol(name)} = {formula}", f"= {reckoned}", said


def _digits(inputs: Sequence[Input]) -> Iterator[list[int]]:
    """Go through the digits of inputs: as they are told, one or two with more digits than the others, all with more."""
    count = len(inputs)
    yield [AS_TOLD] * count
    free = [i for i, one in enumerate(inputs) if not one.exact and not one.fixed]
    for some in (1, 2):
        for more in range(DIGITS + 1, ONE_WITH + 1):
            yield from ([more if i in finer else AS_TOLD for i in range(count)] for finer in combinations(free, some))
        yield [DIGITS] * count
    yield from ([more] * count for more in range(DIGITS + 1, DIGITS + MOST + 1))


class _Numbers(dict[tuple[int, int], float]):
    """Inputs as they are printed, by their places and their digits: many ways to print them are tried."""

    def __init__(self, inputs: Sequence[Input]) -> None:
        super().__init__()
        self.inputs = inputs

    def __missing__(self, key: tuple[int, int]) -> float:
        self[key] = self.inputs[key[0]].printed(key[1])
        return self[key]

    def with_digits(self, digits: Sequence[int]) -> list[float]:
        """Return all inputs, each with its digits."""
        return [self[key] for key in enumerate(digits)]


def _texts(words: Words, inputs: Sequence[Input], digits: Sequence[int]) -> list[str]:
    return [one.text(words, own) for one, own in zip(inputs, digits, strict=True)]
