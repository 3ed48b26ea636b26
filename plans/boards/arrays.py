"""The exact board on numpy arrays, for many positions at once: the same operations, and a status for each position."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .exact import ILL, NAN, RIGHT, STATUSES, PlainBoard, Status
from .graduation import cosine_of, mark_of, sine_of
from .protractor import FARTHEST, TURN

CODES = {status: code for code, status in enumerate(STATUSES)}


class ArrayBoard(PlainBoard):
    """N positions on arrays of shape (N,): a status per position in `codes`, NaN only where a position fails."""

    def __init__(self, givens: Mapping[str, Any], size: int) -> None:
        super().__init__(givens)
        self.codes = np.zeros(size, np.int8)

    def restart(self, givens: Mapping[str, Any], codes: NDArray[np.int8]) -> None:
        """Begin with other positions; the status of each goes into `codes`."""
        self.values, self.codes, self._sine_of = dict(givens), codes, {}
        self.lift_templates()

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

    def _near(self, angle: Any) -> Any:
        if _least(angle) > -FARTHEST and _most(angle) < FARTHEST:
            return angle
        return np.where(np.abs(angle) < FARTHEST, angle, np.fmod(angle, TURN))

    def _graduation(self, rounded: Any) -> tuple[Any, Any]:
        rounded = np.asarray(rounded)
        mark, cosine, sine = (np.empty_like(rounded) for _ in range(3))
        mark_of(rounded, mark)
        cosine_of(mark, cosine)
        sine_of(mark, sine)
        return cosine[()], sine[()]

    def _upright(self, component: Any) -> Any:
        return self._straight(component, np.abs(component))

    def _straight(self, component: Any, size: Any) -> Any:
        return component if _least(size) > RIGHT else np.where(size <= RIGHT, 0.0, component)

    def _mark(self, where: Any, status: Status) -> None:
        np.maximum(self.codes, np.where(where, np.int8(CODES[status]), np.int8(0)), out=self.codes)

    def _lines_sine(self, sine: Any) -> Any:
        if _least(sine) >= ILL or _most(sine) <= -ILL:  # false for NaN as well
            return sine
        size = np.abs(sine)
        self._mark(size < ILL, "ill-conditioned")
        self._mark(size < self.parallel, "singular")
        return np.where(size < self.parallel, NAN, sine)

    def _reaches(self, square: Any, radius: Any, distance: Any, *places: Any) -> Any:
        if _least(square) >= (ILL * _most(radius)) ** 2:
            return square
        touching = self.touching * radius * (radius + sum(map(abs, places)))
        out = square < -touching
        self._mark(square < ILL * ILL * radius * radius, "ill-conditioned")
        self._mark(out, "no-assembly")
        return np.where(out, NAN, np.where(square <= touching, 0.0, square))

    def _assembles(self, product: Any, first: Any, second: Any, base: Any, total: Any, *places: Any) -> Any:
        double = first * second * 2.0
        if _least(product) > (ILL * _most(double)) ** 2:
            return product
        rounded = self.touching * (total + sum(map(abs, places)))
        touching, together = rounded * double, base <= rounded
        out = product < -touching * total
        self._mark(product < (ILL * double) ** 2, "ill-conditioned")
        self._mark(together, "singular")
        self._mark(out, "no-assembly")
        return np.where(out | together, NAN, np.where(product <= touching * base, 0.0, product))

    def _apart(self, distance: Any) -> Any:
        if _least(distance) > 0.0:
            return distance
        self._mark(distance == 0.0, "singular")
        return np.where(distance == 0.0, NAN, distance)

    def _holds(self, determinant: Any, apart: Any, astray: Any, missing: Any) -> Any:
        size = np.abs(determinant)
        if _least(size) >= ILL and _most(apart) <= self.closed and not np.any(astray):
            return determinant
        reached, folded = astray == 0.0, size < self.folded
        apart_here = ~(reached & (folded | (apart <= self.closed)))
        self._mark(size < ILL, "ill-conditioned")
        self._mark(reached & folded, "singular")
        self._mark(apart_here, "no-assembly")
        return np.where(folded | apart_here, NAN, determinant)

    def _clear(self, distance: Any, size: Any) -> Any:
        if _least(distance) >= ILL * _most(size):
            return distance
        together = distance <= self.parallel * size
        self._mark(distance < ILL * size, "ill-conditioned")
        self._mark(together, "singular")
        return np.where(together, NAN, distance)

    def _divisor(self, size: Any) -> Any:
        return size if _least(size) > 0.0 else np.where(size == 0.0, 1.0, size)

    def _bears(self, size: Any, moment: Any) -> Any:
        if _least(size) > 0.0:
            return size
        return np.where(size == 0.0, np.where(moment == 0.0, 1.0, NAN), size)


def _least(value: Any) -> Any:
    return np.minimum.reduce(value, axis=None)


def _most(value: Any) -> Any:
    return np.maximum.reduce(value, axis=None)
