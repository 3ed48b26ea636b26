"""Calculations as they are written: `75 · 0,93969 = 70,747675` is worked out, and both sides held against each other.

Numbers of three digits and more may have been rounded to the last one; shorter ones and whole ones are taken as exact.
What cannot be worked out, such as letters, is passed over. A text is never run: only numbers, signs and a few functions
are understood, in texts of a bounded length.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

from ...scales.errors import InputError
from ...scales.numbers import quote, split_number

LONGEST = 250  # characters of a calculation
DIGITS = 3  # from which a number with a decimal sign may be a rounded one
ROUNDING = 1e-9  # part of a value
_TOKEN = re.compile(r"\d+(?:[.,]\d+)?|[^\W\d_]+|[^\s]")
_NUMBER = re.compile(r"\d+(?:[.,]\d+)?")
_PI = re.compile(r"3[.,]14(?:1[56]\d*|2)?")  # written for pi
_SIGNS = str.maketrans(
    {**dict.fromkeys("·×⋅∙•∗", "*"), **dict.fromkeys("−–", "-"), **dict.fromkeys(":÷∕", "/"), "º": "°"}
    | {**dict.fromkeys("[{", "("), **dict.fromkeys("]}", ")")}
)
_RAISED = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-")
_POWER = re.compile(r"[⁰¹²³⁴⁵⁶⁷⁸⁹⁻]+")
_FUNCTIONS: dict[str, Callable[[float], float]] = {
    **dict.fromkeys(("√", "sqrt"), math.sqrt),
    "sin": math.sin,
    "cos": math.cos,
    **dict.fromkeys(("tg", "tan"), math.tan),
    **dict.fromkeys(("ctg", "cot"), lambda angle: 1.0 / math.tan(angle)),
}


class Slip(NamedTuple):
    """A calculation that does not make what stands behind it."""

    text: str
    makes: float
    written: str


class _Value(NamedTuple):
    """A number, and by how much rounding of what it comes from may have moved it."""

    number: float
    off: float


@dataclass(slots=True)
class _Reader:
    """Works out a calculation, sign by sign; `pi` takes 3.14 for pi."""

    tokens: list[str]
    pi: bool
    at: int = 0

    def value(self) -> _Value:
        """Return what it makes; a ValueError where it is no calculation."""
        total = self._sum()
        if self.at < len(self.tokens) or not math.isfinite(total.number):
            raise ValueError
        return total

    def _next(self, *wanted: str) -> str:
        """Take the next sign if it is one of those wanted."""
        if self.at < len(self.tokens) and (not wanted or self.tokens[self.at] in wanted):
            self.at += 1
            return self.tokens[self.at - 1]
        return ""

    def _sum(self) -> _Value:
        total = self._product()
        while sign := self._next("+", "-"):
            other = self._product()
            number = total.number + other.number if sign == "+" else total.number - other.number
            total = _Value(number, total.off + other.off)
        return total

    def _product(self) -> _Value:
        total = self._power()
        while sign := self._next("*", "/"):
            other = self._power()
            if sign == "/":
                other = _Value(1.0 / other.number, other.off / other.number**2)
            off = abs(total.number) * other.off + abs(other.number) * total.off
            total = _Value(total.number * other.number, off)
        return total

    def _power(self) -> _Value:
        if sign := self._next("+", "-"):
            inside = self._power()
            return inside if sign == "+" else _Value(-inside.number, inside.off)
        base = self._primary()
        if not self._next("^"):
            return base
        sign = self._next("-")
        exponent = self._primary().number * (-1.0 if sign else 1.0)
        raised = math.pow(base.number, exponent)
        return _Value(raised, abs(exponent * raised / base.number) * base.off if base.off else 0.0)

    def _primary(self) -> _Value:
        token = self._next()
        if token == "(":
            inside = self._sum()
            if not self._next(")"):
                raise ValueError
            return inside
        if token.lower() in _FUNCTIONS:
            function, inside = _FUNCTIONS[token.lower()], self._power()
            number = function(inside.number)
            return _Value(number, abs(function(inside.number + inside.off) - number))
        if token in ("π", "pi"):
            return _Value(math.pi, 0.0)
        if not _NUMBER.fullmatch(token):
            raise ValueError
        unit = math.radians(1.0) if self._next("°") else 1.0
        if _PI.fullmatch(token) and self.pi:
            return _Value(math.pi, 0.0)
        exact = _PI.fullmatch(token) or len(re.sub("[.,]", "", token).lstrip("0")) < DIGITS or token.isdigit()
        return _Value(_float(token) * unit, 0.0 if exact else 0.5 * _last_digit(token) * unit)


def slip_in(text: str) -> Slip | None:
    """Return the first place of a calculation where two sides are not equal; None where all are, or none is one.

    >>> slip_in("d = 75 · 0,93969 = 70,747675")
    Slip(text='75 · 0,93969', makes=70.47675, written='70,747675')
    >>> slip_in("15 · 5/2 = 37,5") is None
    True
    """
    if "=" not in text or len(text) > LONGEST:
        return None
    sides = [side.strip() for side in text.split("=")]
    worked = [(side, _ways(side)) for side in (*sides[:-1], _without_unit(sides[-1]))]
    known = [(side, ways) for side, ways in worked if ways]
    for (side, ways), (written, others) in pairwise(known):
        if not any(_agree(a, b) for a in ways for b in others):
            return Slip(quote(side, LONGEST), ways[-1].number, quote(written))
    return None


def _agree(one: _Value, other: _Value) -> bool:
    """Whether two sides are equal but for rounding, and for the sign: it may stand for a sense."""
    apart = abs(abs(one.number) - abs(other.number))
    return apart <= one.off + other.off + ROUNDING * abs(one.number)


def result_of(text: str) -> str:
    """Return what stands behind the last equals sign of a calculation; else the text itself."""
    return text.rpartition("=")[2].strip()


def _without_unit(side: str) -> str:
    """Return the number of a side that is followed by its unit; a calculation stays as it is."""
    side = re.sub(r"^([+\-−–])\s+", r"\1", side)
    try:
        rest = split_number(side)[1]
    except InputError:
        return side
    return side[: len(side) - len(rest)].strip() if rest[:1].isalpha() or rest[:2] == "1/" else side


def _ways(side: str) -> list[_Value]:
    """Return what a side makes, with 3.14 as it stands and as pi; nothing where it is no calculation.

    A number alone is a result: it may be rounded to its last digit, or cut off there; a whole one, to or at the last
    that is not zero.
    """
    plain = _POWER.sub(lambda found: f"^{found.group().translate(_RAISED)}", side).translate(_SIGNS)
    tokens = _TOKEN.findall(plain)
    try:
        if _NUMBER.fullmatch(tokens[-1]) and tokens[:-1] in ([], ["-"], ["+"]):
            digit = _last_digit(tokens[-1])
            return [_Value(_float(tokens[-1]) + 0.25 * digit, 0.75 * digit)]
        ways = (False, True) if any(map(_PI.fullmatch, tokens)) else (False,)
        return [_Reader(tokens, pi).value() for pi in ways]
    except (ValueError, ArithmeticError, IndexError, RecursionError):
        return []


def _float(number: str) -> float:
    return float(number.replace(",", "."))


def _last_digit(number: str) -> float:
    """Return a unit of the last digit of a number, of a whole one the last that is not zero."""
    whole, _, decimals = number.replace(",", ".").partition(".")
    return 10.0 ** (-len(decimals) if decimals else len(whole) - len(whole.rstrip("0") or whole))
