"""The protractor: sine and cosine that one position and a million round alike, on any machine, without numpy.

An angle is the nearest of 1024 marks around the circle and a rest of at most 0.18 degrees, for which three terms of the
series do. Sums, products and a table round alike everywhere; marks at multiples of 90 degrees are exact.
"""

from __future__ import annotations

import math
from functools import cache

MARKS = 1024
TURN = 2.0 * math.pi
STEP = TURN / MARKS
COARSE = math.ldexp(round(math.ldexp(STEP, 40)), -40)  # so few bits that its product with a number of marks is exact
FINE = STEP - COARSE + 2.4492935982947064e-16 / MARKS  # with what 2 pi is more than TURN
PER_RADIAN = 1.0 / STEP
ROUND = 1.5 * 2.0**52  # added and taken away again, it rounds to a whole number; added, it puts it into the last bits
FARTHEST = 1e6  # radians; full turns are taken off a larger angle, which is not known any better


@cache
def graduation() -> tuple[list[float], list[float]]:
    """Return cosine and sine of the marks, correct to a unit in the last place."""
    sines = [math.sin(mark * COARSE) + mark * FINE * math.cos(mark * COARSE) for mark in range(MARKS // 8 + 1)]
    cosines = [math.cos(mark * COARSE) - mark * FINE * math.sin(mark * COARSE) for mark in range(MARKS // 8 + 1)]
    quarter = sines + cosines[-2::-1]
    half = quarter + quarter[-2:0:-1]
    sine = half + [-value for value in half]
    return sine[MARKS // 4 :] + sine[: MARKS // 4], sine
