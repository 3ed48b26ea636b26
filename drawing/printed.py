"""Printed numbers that agree: what stands on the sheet recomputes to its last digit."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from .words import Words

DIGITS = 4  # significant digits of a printed value
MOST = 10  # more digits than that would be rounding noise
FINEST = 12  # decimals; what is smaller still is 0
POINT = 1e-6  # mm; a shorter segment is a point, and its quantity 0


def decimals_for(value: float, digits: int = DIGITS) -> int:
    """Return how many decimals show `value` with so many significant digits."""
    if value == 0.0 or not math.isfinite(value):
        return 0
    first = -math.floor(math.log10(abs(value)))  # decimals of its first digit
    return max(0, min(first + digits - 1, FINEST)) if first + DIGITS - 1 <= FINEST else 0


def value_text(words: Words, value: float) -> str:
    """Return a value with the usual digits; what is rounding noise of a millionth of a millionth is 0."""
    return words.number(value, decimals_for(value))


def segment_decimals(value: float, mu: float) -> tuple[int, int]:
    """Return decimals for a segment in mm and for its value so that mm * mu is the value to its last printed digit.

    Hundredths of a millimetre and the usual digits of the value where that will do, else one digit more of either.
    """
    size, usual = abs(value), decimals_for(value)
    if size < POINT * mu:
        return 2, 0
    for extra in range(MOST):
        for places, decimals in ((2 + extra, usual), (2 + extra, usual + 1)):
            if round(round(size / mu, places) * mu, decimals) == round(size, decimals):
                return places, decimals
    return 2 + MOST, usual


def calculation(words: Words, law: Callable[..., float], inputs: Sequence[tuple[float, bool]]) -> tuple[list[str], str]:
    """Return the printed inputs and the printed result of a calculation, such that it recomputes.

    Parameters
    ----------
    inputs : sequence of (value, exact)
        A value that is exact (a given, a scale factor) is printed as it is; others get as many digits as it takes for
        the result to come out to its last printed digit.
    """
    values = [value for value, _ in inputs]
    result = law(*values)
    decimals = decimals_for(result)
    for digits in range(DIGITS, MOST + DIGITS):
        shown = [value if exact else round(value, decimals_for(value, digits)) for value, exact in inputs]
        if round(law(*shown), decimals) == round(result, decimals):
            break
    texts = [
        words.short(value) if exact else words.number(value, decimals_for(value, digits)) for value, exact in inputs
    ]
    return texts, words.number(result, decimals)
