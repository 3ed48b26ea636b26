"""The exact board on numpy arrays, for many positions at once: the same operations, and a status for each position."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .exact import FARTHEST, ILL, MARKS, NAN, RIGHT, STATUSES, TURN, PlainBoard, Status, graduation


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


Marks = Iterable[tuple[Status, Any]]  # statuses with their conditions
Rarely = tuple[Marks, Any]  # and the value to go on with
CODES = {status: code for code, status in enumerate(STATUSES)}


class ManyChecks:
    """What boards of many positions look at, written once for arrays and for numbers that are only written down.

    A check says how its first operand must lie to be left alone, and else what statuses it sets and what to go on with.
    """

    parallel: float
    touching: float
    closed: float
    folded: float

    def _look(self, check: str, operands: tuple[Any, ...], calm: tuple[Any, ...], rare: Callable[[], Rarely]) -> Any:
        """Return the first of the operands of a check, or what it is worth where not all is calm."""
        raise NotImplementedError

    def _calm(self, value: Any, order: str, bound: float, of: Any = None, squared: bool = False) -> Any:
        """Return whether numbers lie so that nothing is the matter: to `bound`, or to it times the largest `of`."""
        raise NotImplementedError

    @staticmethod
    def _choose(where: Any, value: Any, other: Any) -> Any:
        raise NotImplementedError

    @staticmethod
    def _remainder(angle: Any) -> Any:
        raise NotImplementedError

    def _near(self, angle: Any) -> Any:
        calm = self._calm(angle, "within", FARTHEST)
        return self._look(
            "near", (angle,), (calm,), lambda: ((), self._choose(abs(angle) < FARTHEST, angle, self._remainder(angle)))
        )

    def _upright(self, component: Any) -> Any:
        size = abs(component)
        calm = self._calm(size, "above", RIGHT)
        return self._look(
            "upright", (component, size), (calm,), lambda: ((), self._choose(size <= RIGHT, 0.0, component))
        )

    def _lines_sine(self, sine: Any) -> Any:
        def rare() -> Rarely:
            size = abs(sine)
            flat = size < self.parallel
            return [("ill-conditioned", size < ILL), ("singular", flat)], self._choose(flat, NAN, sine)

        return self._look("sine", (sine,), (self._calm(sine, "beyond", ILL),), rare)

    def _reaches(self, square: Any, radius: Any, distance: Any, *places: Any) -> Any:
        def rare() -> Rarely:
            touching = self.touching * radius * (radius + sum(map(abs, places)))
            out = square < -touching
            half = self._choose(out, NAN, self._choose(square <= touching, 0.0, square))
            return [("ill-conditioned", square < ILL * ILL * radius * radius), ("no-assembly", out)], half

        calm = self._calm(square, "at least", ILL, radius, squared=True)
        return self._look("reaches", (square, radius, *places), (calm,), rare)

    def _assembles(self, product: Any, first: Any, second: Any, base: Any, total: Any, *places: Any) -> Any:
        double = first * second * 2.0

        def rare() -> Rarely:
            rounded = self.touching * (total + sum(map(abs, places)))
            touching, together = rounded * double, base <= rounded
            out = product < -touching * total
            ill = product < ILL * double * (ILL * double)
            area = self._choose(out | together, NAN, self._choose(product <= touching * base, 0.0, product))
            return [("ill-conditioned", ill), ("singular", together), ("no-assembly", out)], area

        calm = self._calm(product, "above", ILL, double, squared=True)
        return self._look("assembles", (product, first, second, base, total, *places), (calm,), rare)

    def _apart(self, distance: Any) -> Any:
        def rare() -> Rarely:
            together = distance == 0.0
            return [("singular", together)], self._choose(together, NAN, distance)

        return self._look("apart", (distance,), (self._calm(distance, "above", 0.0),), rare)

    def _holds(self, determinant: Any, apart: Any, astray: Any, missing: Any) -> Any:
        size, astray = abs(determinant), abs(astray)

        def rare() -> Rarely:
            reached, folded = astray == 0.0, size < self.folded
            apart_here = (reached & (folded | (apart <= self.closed))) == 0.0
            marks: Marks = [
                ("ill-conditioned", size < ILL),
                ("singular", reached & folded),
                ("no-assembly", apart_here),
            ]
            return marks, self._choose(folded | apart_here, NAN, determinant)

        calm = [self._calm(size, "at least", ILL), self._calm(apart, "at most", self.closed)]
        calm.append(self._calm(astray, "at most", 0.0))
        return self._look("holds", (determinant, apart, astray), tuple(calm), rare)

    def _clear(self, distance: Any, size: Any) -> Any:
        def rare() -> Rarely:
            together = distance <= self.parallel * size
            marks: Marks = [("ill-conditioned", distance < ILL * size), ("singular", together)]
            return marks, self._choose(together, NAN, distance)

        return self._look("clear", (distance, size), (self._calm(distance, "at least", ILL, size),), rare)

    def _divisor(self, size: Any) -> Any:
        calm = self._calm(size, "above", 0.0)
        return self._look("divisor", (size,), (calm,), lambda: ((), self._choose(size == 0.0, 1.0, size)))

    def _bears(self, size: Any, moment: Any) -> Any:
        def rare() -> Rarely:
            return (), self._choose(size == 0.0, self._choose(moment == 0.0, 1.0, NAN), size)

        return self._look("bears", (size, moment), (self._calm(size, "above", 0.0),), rare)


class ArrayBoard(ManyChecks, PlainBoard):
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

    def _mark(self, where: Any, status: Status) -> None:
        np.maximum(self.codes, np.where(where, np.int8(CODES[status]), np.int8(0)), out=self.codes)

    def _look(self, check: str, operands: tuple[Any, ...], calm: tuple[bool, ...], rare: Callable[[], Rarely]) -> Any:
        if all(calm):
            return operands[0]
        marks, result = rare()
        for status, where in marks:
            self._mark(where, status)
        return result

    def _calm(self, value: Any, order: str, bound: float, of: Any = None, squared: bool = False) -> bool:
        if of is not None:
            bound = bound * _most(of)
        return CALM[order](value, bound * bound if squared else bound)

    @staticmethod
    def _choose(where: Any, value: Any, other: Any) -> Any:
        return np.where(where, value, other)

    @staticmethod
    def _remainder(angle: Any) -> Any:
        return np.fmod(angle, TURN)


def _least(value: Any) -> Any:
    return np.minimum.reduce(value, axis=None)


def _most(value: Any) -> Any:
    return np.maximum.reduce(value, axis=None)


# how numbers, by the least and the most of them, must lie to a bound to be left alone; never where a number is none
ORDERS = {
    "above": "{least} > {bound}",
    "at least": "{least} >= {bound}",
    "at most": "{most} <= {bound}",
    "beyond": "({least} >= {bound} or {most} <= -{bound})",
    "within": "({least} > -{bound} and {most} < {bound})",
}


def _order(said: str) -> Callable[[Any, Any], bool]:
    lies = said.format(least="least(value)", most="most(value)", bound="bound")
    order: Callable[[Any, Any], bool] = eval(f"lambda value, bound: {lies}", {"least": _least, "most": _most})
    return order


CALM = {name: _order(said) for name, said in ORDERS.items()}
