"""Symbols that print the formula they go through: a law that is called with them instead of numbers is its own print.

Sums, products, quotients and powers become text with the signs of printed mathematics and no more brackets than they
need; functions of numpy, and those of `plans.laws.named`, become their names. A constant that is a `Sign` stands as it
says; π and its parts, halves and whole numbers are known. A vector is its size: a turn by 90 degrees leaves it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cache
from typing import Any

from ..plans.laws import Sign, form_of

FUNCTIONS = {name: name for name in ("sin", "cos", "tan", "arccos", "arcsin", "arctan")}
POWERS = {1.5: "3/2"}
CONSTANTS = {math.pi: "π", 0.5 * math.pi: "π/2", 2.0 * math.pi: "2π"}
HALF = 0.5  # as a factor it is 2 below the line


@dataclass(frozen=True, eq=False, slots=True)
class Atom:
    """A letter, a number or a function: its text; an exponent stands behind `base`, before `rest`."""

    text: str
    base: str = ""
    rest: str = ""

    @property
    def is_compound(self) -> bool:
        """Whether it must stand in brackets below the line, or raised to a power."""
        return ("·" in self.text and not self.base) or self.text == "2π"


Factor = tuple["Atom | Symbol", float]  # what stands there, and its power


@dataclass(frozen=True, slots=True)
class Term:
    """A product of factors over a product of others, perhaps negative."""

    above: tuple[Factor, ...]
    below: tuple[Factor, ...] = ()
    negative: bool = False

    @property
    def over(self) -> str:
        """What stands below the line, behind a stroke."""
        below = "·".join(map(_written, self.below))
        alone = len(self.below) == 1 and not (isinstance(self.below[0][0], Atom) and self.below[0][0].is_compound)
        return f"/{below}" if alone else f"/({below})" if below else ""

    def __str__(self) -> str:
        return ("·".join(map(_written, self.above)) or "1") + self.over


class Symbol:
    """A quantity or an expression of quantities: a sum of terms."""

    __slots__ = ("terms",)
    __hash__ = None  # type: ignore[assignment]

    def __init__(self, *terms: Term) -> None:
        self.terms = terms

    @classmethod
    def of(cls, text: str, base: str = "", rest: str = "") -> Symbol:
        """Return the symbol of a quantity, a letter or its number; a negative number is put in brackets.

        The exponent of its powers stands behind `base`, before `rest`; behind the text if these are not given.
        """
        if text.startswith("−"):
            text = base = f"({text})"
        return cls(Term(((Atom(text, base, rest), 1),)))

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
        first, *rest = self.terms
        whole = first.above[0][0] if len(first.above) == 1 and first.above[0][1] == 1 else None
        if not rest and not first.negative and isinstance(whole, Symbol):
            chunks = whole.chunks
            chunks[0] = f"({chunks[0]}"
            chunks[-1] += f"){first.over}"
            return chunks
        return [f"{'−' * first.negative}{first}", *(f"{'−' if term.negative else '+'} {term}" for term in rest)]

    def __str__(self) -> str:
        return " ".join(self.chunks)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Symbol) and self.terms == other.terms

    def __neg__(self) -> Symbol:
        return Symbol(*(Term(term.above, term.below, not term.negative) for term in self.terms))

    def __add__(self, other: Any) -> Symbol:
        return Symbol(*self.terms, *_symbol(other).terms) if _is_something(other) else self

    def __radd__(self, other: Any) -> Symbol:
        return _symbol(other) + self if _is_something(other) else self

    def __sub__(self, other: Any) -> Symbol:
        return self + -_symbol(other) if _is_something(other) else self

    def __rsub__(self, other: Any) -> Symbol:
        return _symbol(other) + -self if _is_something(other) else -self

    def __mul__(self, other: Any) -> Symbol:
        one, two = self._term(), _symbol(other)._term()
        above, below = _product(one.above, two.above), _product(one.below, two.below)
        return Symbol(Term(above, below, one.negative != two.negative))

    def __rmul__(self, other: Any) -> Symbol:
        return _symbol(other) * self

    def __truediv__(self, other: Any) -> Symbol:
        one, two = self._term(), _symbol(other)._term()
        if one.negative or one.below:
            one = Term(((self, 1),))
        if two.below or two.negative:
            two = Term(((_symbol(other), 1),))
        return Symbol(Term(one.above, two.above)) if two.above else self

    def __rtruediv__(self, other: Any) -> Symbol:
        return _symbol(other) / self

    def __pow__(self, power: float) -> Symbol:
        if power == 1:
            return self
        if power < 0:
            return 1.0 / self**-power
        if power == 0.5:
            return self._root()
        term = self._term()
        if len(term.above) == 1 and not term.below and not term.negative and term.above[0][1] == 1:
            return Symbol(Term(((term.above[0][0], power),)))
        return Symbol(Term(((self, power),)))

    def function(self, name: str) -> Symbol:
        """Return the function of that name of the expression."""
        term = self.terms[0]
        alone = len(self.terms) == 1 and len(term.above) == 1 and not term.below and not term.negative
        argument = f" {self}" if alone else f" ({self})"
        return Symbol(Term(((Atom(name + argument, name, argument) if name else Atom(argument.lstrip()), 1),)))

    def _root(self) -> Symbol:
        return Symbol.of(f"√({self})", f"√({self})")

    def __array_ufunc__(self, ufunc: Any, method: str, *operands: Any, **options: Any) -> Any:
        """Do for numbers of numpy and functions of numpy what the operators do."""
        name = ufunc.__name__
        if method != "__call__" or options:
            return NotImplemented
        if name in FUNCTIONS:
            return self.function(FUNCTIONS[name])
        if name == "sqrt":
            return self._root()
        if name in OPERATIONS:
            first, second = map(_symbol, operands)
            return OPERATIONS[name](first, second)
        return NotImplemented

    def _term(self) -> Term:
        """Return the expression as one term: a sum as a factor in brackets."""
        return self.terms[0] if len(self.terms) == 1 else Term(((self, 1),))


OPERATIONS = {
    "add": Symbol.__add__,
    "subtract": Symbol.__sub__,
    "multiply": Symbol.__mul__,
    "divide": Symbol.__truediv__,
}


@cache
def prints(law: str, operands: int) -> bool:
    """Whether a law of so many operands is an expression, not a procedure."""
    try:
        form_of(law)(*(Symbol.of("x") for _ in range(operands)))
    except TypeError:
        return False
    return True


def _is_something(value: Any) -> bool:
    return isinstance(value, Symbol) or value != 0.0


def _symbol(value: Any) -> Symbol:
    """Return a number of a formula as a symbol; 1 and a turn by 90 degrees are no factors."""
    if isinstance(value, Symbol):
        return value
    if isinstance(value, Sign):
        return Symbol.of(value.text) if value.text else Symbol(Term(()))
    if getattr(value, "ndim", 0):
        raise TypeError("an array in a formula")
    if value in (1.0, 1j):
        return Symbol(Term(()))
    if value < 0.0:
        return -_symbol(-value)
    if value == HALF:
        return Symbol(Term((), ((Atom("2"), 1),)))
    return Symbol(Term(((Atom(CONSTANTS.get(value, f"{value:g}")), 1),)))


def _product(first: tuple[Factor, ...], second: tuple[Factor, ...]) -> tuple[Factor, ...]:
    """Return the factors of a product; a factor that is there already becomes a power."""
    found = list(first)
    for base, power in second:
        if found and found[-1][0] == base:
            found[-1] = base, found[-1][1] + power
        else:
            found.append((base, power))
    return tuple(found)


def _written(factor: Factor) -> str:
    """Return a factor with its power, a sum in brackets."""
    base, power = factor
    if isinstance(base, Symbol):
        base = Atom(f"({base})")
    if power == 1:
        return base.text
    text = f"({base.text})" if base.is_compound else base.base or base.text
    return f"{text}^{{{POWERS.get(power, f'{power:g}')}}}{base.rest}"
