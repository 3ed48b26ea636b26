"""What is left of sine and cosine: x - sin x and x^2/2 - 1 + cos x, to the last digits where these cancel, too."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

NEAR = 1.0
TERMS = 10  # the next one is 1e-22 of the first at `NEAR`


def sine_rest(x: Any) -> Any:
    """Return x - sin x."""
    return np.where(np.abs(x) < NEAR, _series(x, 3), x - np.sin(x))


def cosine_rest(x: Any) -> Any:
    """Return x^2 / 2 - 1 + cos x."""
    half = np.sin(0.5 * x)
    return np.where(np.abs(x) < NEAR, _series(x, 4), 0.5 * x * x - 2.0 * (half * half))


def _series(x: Any, power: int) -> Any:
    """Return x^p/p! - x^(p+2)/(p+2)! + ..., by Horner's rule; places that are far have no part in it."""
    x = np.where(np.abs(x) < NEAR, x, 0.0)
    square, found = x * x, 0.0
    for k in range(TERMS, 0, -1):
        n = power + 2 * k
        found = (1.0 - found) * square * (1.0 / (n * (n - 1)))
    first = x * square if power == 3 else square * square
    return (1.0 - found) * first * (1.0 / math.factorial(power))
