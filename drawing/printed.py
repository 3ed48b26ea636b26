"""Printed numbers that agree: what stands on the sheet recomputes to its last digit."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from .words import Words

DIGITS = 4  # significant digits of a printed value
MOST = 10  # more digits than that would be rounding noise
FEWEST = 2  # significant digits of what small segments show
HUNDREDTHS = 2  # decimals of a segment, mm: a ruler reads no more
# digits of a result, most digits of what goes into it, whether segments may have more than hundredths of a millimetre
TRIES = ((DIGITS, 6, False), (3, 6, False), (FEWEST, 6, False), (DIGITS, DIGITS + MOST, True))
FINEST = 12  # decimals; what is smaller still is 0
Terms = Sequence[tuple[str, float, bool]]  # symbol, number as it is printed, whether it is exact
POINT = 1e-6  # mm; a shorter segment is a point, and its quantity 0


@dataclass(frozen=True, slots=True)
class Input:
    """A number that goes into a printed calculation.

    One that is `exact` (a given, a scale factor) is printed as it is; one measured on the sheet has at most `places`
    decimals, as many as its ruler shows.
    """

    value: float
    exact: bool = False
    places: int | None = None

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
            if _recomputes(law, shown, round(result, decimals), decimals):
                return _texts(words, values, places), words.number(result, decimals)
    return _texts(words, values, places), words.number(result, decimals)


def _recomputes(law: Callable[..., float], shown: Sequence[float], result: float, decimals: int) -> bool:
    """Whether printed numbers give the printed result; those that are rounded to nothing may give none at all."""
    try:
        return round(law(*shown), decimals) == result
    except (ArithmeticError, ValueError):
        return False


@dataclass(frozen=True, slots=True)
class Formula:
    """How a quantity is calculated: in `text` a term stands as `{name}`, a degree sign after its number as `{deg}`.

    The result is in `unit`, with so many `decimals` if these are said.
    """

    name: str
    text: str
    law: Callable[..., float]
    terms: Terms
    unit: str = ""
    decimals: int | None = None


def worked(words: Words, formula: Formula, more: str = "") -> tuple[str, ...]:
    """Return `name = formula = numbers = result unit`, printed so that it recomputes."""
    inputs = [Input(value, exact) for _, value, exact in formula.terms]
    texts, result = calculation(words, formula.law, inputs, formula.decimals)
    names = [term for term, _, _ in formula.terms]
    symbols = formula.text.format(deg="", **{name: words.symbol(name) for name in names})
    numbers = formula.text.format(deg="°", **{name: _within(text) for name, text in zip(names, texts, strict=True)})
    gap, unit = "" if formula.unit == "deg" else " ", formula.unit
    said = f"= {result}{gap}{words.unit(unit)}" if unit else f"= {result}"
    return tuple(filter(None, (f"{words.symbol(formula.name)} = {symbols}", f"= {numbers}", said, more)))


def _within(text: str) -> str:
    """Return a number as it stands in a formula: a negative one in brackets."""
    return f"({text})" if text.startswith("−") else text


def _texts(words: Words, values: Sequence[float], places: Sequence[int | None]) -> list[str]:
    pairs = zip(values, places, strict=True)
    return [words.short(value) if cut is None else words.number(value, cut) for value, cut in pairs]
