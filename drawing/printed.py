"""Printed numbers that agree: what stands on the sheet recomputes to its last digit."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from ..plans.laws import LAWS, form_of
from .formulas import Symbol
from .words import Words

DEGREES = 180.0 / math.pi  # in a radian
DIGITS = 4  # significant digits of a printed value
MOST = 10  # more digits than that would be rounding noise
FEWEST = 2  # significant digits of what small segments show
HUNDREDTHS = 2  # decimals of a segment, mm: a ruler reads no more
# digits of a result, most digits of what goes into it, whether segments may have more than hundredths of a millimetre
TRIES = ((DIGITS, 6, False), (3, 6, False), (FEWEST, 6, False), (DIGITS, DIGITS + MOST, True))
FINEST = 12  # decimals; what is smaller still is 0
POINT = 1e-6  # mm; a shorter segment is a point, and its quantity 0


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
            if _recomputes(law, shown, round(result, decimals), decimals):
                return _texts(words, values, places), words.number(result, decimals)
    return _texts(words, values, places), words.number(result, decimals)


def _recomputes(law: Callable[..., float], shown: Sequence[float], result: float, decimals: int) -> bool:
    """Whether printed numbers give the printed result; those that are rounded to nothing may give none at all."""
    try:
        return round(law(*shown), decimals) == result
    except (ArithmeticError, ValueError):
        return False


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
