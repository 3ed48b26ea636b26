"""The exact board on numpy arrays, for many positions at once: the same operations, and a status for each position."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache, partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .exact import MARKS, STATUSES, TURN, PlainBoard, Rarely, calm_by, graduation


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


CODES = {status: code for code, status in enumerate(STATUSES)}


_least, _most = (partial(ufunc.reduce, axis=None) for ufunc in (np.minimum, np.maximum))
_CALM = calm_by("least(value)", "most(value)", {"least": _least, "most": _most})


class ArrayBoard(PlainBoard):
    """N positions on arrays of shape (N,): a status per position in `codes`, NaN only where a position fails."""

    def __init__(self, givens: Mapping[str, Any], size: int) -> None:
        super().__init__(givens)
        self.codes = np.zeros(size, np.int8)

    def restart(self, givens: Mapping[str, Any], codes: NDArray[np.int8]) -> None:
        """Begin with other positions; the status of each goes into `codes`."""
        self.values, self.codes = dict(givens), codes
        self._begin()

    @staticmethod
    def _sqrt(square: Any) -> Any:
        return np.sqrt(square)

    @staticmethod
    def _complex(real: Any, imag: Any) -> Any:
        if not np.ndim(real) and not np.ndim(imag):
            return complex(real, imag)
        points = np.empty(np.broadcast_shapes(np.shape(real), np.shape(imag)), complex)
        points.real, points.imag = real, imag
        return points

    def _graduation(self, rounded: Any) -> tuple[Any, Any]:
        rounded = np.asarray(rounded)
        mark, cosine, sine = (np.empty_like(rounded) for _ in range(3))
        mark_of(rounded, mark)
        cosine_of(mark, cosine)
        sine_of(mark, sine)
        return cosine[()], sine[()]

    def _look(self, check: str, operands: tuple[Any, ...], calm: tuple[Any, ...], rare: Callable[[], Rarely]) -> Any:
        if all(calm):
            return operands[0]
        marks, result = rare()
        for status, where, *_ in marks:
            np.maximum(self.codes, np.where(where, np.int8(CODES[status]), np.int8(0)), out=self.codes)
        return result

    def _calm(self, value: Any, order: str, bound: float, of: Any = None, squared: bool = False) -> Any:
        if of is not None:
            bound = bound * _most(of)
        return _CALM[order](value, bound * bound if squared else bound)

    def _note_sine(self, part: Any, whole: Any = None) -> None:
        """Do nothing: the status of each position tells enough."""

    def _note_pins(self, distance: Any, size: Any) -> None:
        """Do nothing, too."""

    @staticmethod
    def _choose(where: Any, value: Any, other: Any) -> Any:
        return np.where(where, value, other)

    @staticmethod
    def _remainder(angle: Any) -> Any:
        return np.fmod(angle, TURN)
