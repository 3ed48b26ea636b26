"""The protractor's marks as arrays: functions that put what they find into their last operand."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .protractor import MARKS, graduation


@cache
def _graduation_arrays() -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    cosines, sines = graduation()
    return np.array(cosines), np.array(sines)


def mark_of(rounded: Any, mark: Any) -> None:
    """Put the number of the protractor's mark, which the last bits of a rounded number are, into the bits of `mark`."""
    np.bitwise_and(rounded.view(np.int64), MARKS - 1, mark.view(np.int64))


def cosine_of(mark: Any, cosine: Any) -> None:
    """Put the cosines of marks into `cosine`; marks are none but those of the protractor, so that none is clipped."""
    _graduation_arrays()[0].take(mark.view(np.int64), out=cosine, mode="clip")


def sine_of(mark: Any, sine: Any) -> None:
    """Put the sines of marks into `sine`."""
    _graduation_arrays()[1].take(mark.view(np.int64), out=sine, mode="clip")
