"""Many positions, variants or sizes at once: the exact board on numpy arrays, in chunks that fit the cache."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import DTypeLike, NDArray

from ..board import Program
from .exact import ILL, NAN, RIGHT, STATUSES, PlainBoard, Status, run
from .protractor import FARTHEST, MARKS, TURN, graduation

if TYPE_CHECKING:
    from .noting import NotingBoard

CHUNK = 8192
_CODE = {status: code for code, status in enumerate(STATUSES)}


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
        np.maximum(self.codes, np.where(where, np.int8(_CODE[status]), np.int8(0)), out=self.codes)

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


def batch(
    program: Program, givens: Mapping[str, Any], wanted: Sequence[str], chunk: int = CHUNK
) -> tuple[dict[str, NDArray[Any]], NDArray[np.int8]]:
    """Run `program` for N positions and keep the `wanted` names.

    Parameters
    ----------
    givens : mapping of str to float or float64 array of shape (N,)
        Values in SI; at least one array.
    wanted : sequence of str
        Names to keep; steps that they do not need are not done.
    chunk : int
        Positions at a time.

    Returns
    -------
    results : dict of str to array of shape (N,)
        float64 for scalars, complex128 for vectors and points.
    codes : int8 array of shape (N,)
        Index into `STATUSES`.
    """
    from .noting import NotingBoard  # a board of arrays alone does without a tape

    return noted(program, givens, wanted, (NotingBoard, ArrayBoard({}, 0)), chunk)


def noted(
    program: Program,
    givens: Mapping[str, Any],
    wanted: Sequence[str],
    boards: tuple[type[NotingBoard], ArrayBoard],
    chunk: int = CHUNK,
    number: DTypeLike = float,
) -> tuple[dict[str, NDArray[Any]], NDArray[np.int8]]:
    """Run `program` as `batch` does, on numbers of another type and with boards that go with them.

    Parameters
    ----------
    boards : type of NotingBoard and ArrayBoard
        The one that notes the arithmetic, and the one that looks at its numbers.
    number : dtype
        Of the numbers, real ones.
    """
    from .chunks import Chunks, Store, room

    noting, checks = boards
    arrays = {name: np.asarray(value, number) for name, value in givens.items() if np.ndim(value)}
    size = len(next(iter(arrays.values())))
    if size > chunk:
        settle_heap()
    values = {name: float(value) for name, value in givens.items() if name not in arrays}
    needed = program.needed_for(wanted)
    first = cache(lambda: run(needed, {**values, **{name: float(array[0]) for name, array in arrays.items()}}).values)
    board = noting(values, arrays, checks, first)
    needed.run(board)
    results: dict[str, NDArray[Any]] = {}
    stores: list[Store] = []
    for name in wanted:
        results[name], into = room(board.values[name], size, number)
        stores += into
    codes = np.full(size, _CODE[board.status], np.int8)
    chunks = Chunks(board.tape.entries, stores, arrays, min(size, chunk), number)
    with np.errstate(invalid="ignore", divide="ignore"):
        for start in range(0, size, chunk):
            part = slice(start, min(start + chunk, size))
            checks.codes = codes[part]
            chunks.do(part)
    return results, codes


def settle_heap() -> None:
    """Keep glibc from giving memory back after every large temporary: batches run up to four times faster.

    One allocation just below the largest mmap threshold, freed at once, raises the thresholds for the process.
    """
    np.empty(31 << 20, np.uint8)
