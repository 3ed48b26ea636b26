"""Many positions, variants or sizes at once: the exact board on numpy arrays, in chunks that fit the cache."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .board import Program
from .exact import ILL, NAN, RIGHT, SINGULAR, STATUSES, TANGENT, ExactBoard, Status
from .template import CLOSED, FOLDED

CHUNK = 8192
_CODE = {status: code for code, status in enumerate(STATUSES)}


class ArrayBoard(ExactBoard):
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

    def _turn(self, angle: Any) -> Any:
        if not np.ndim(angle):
            return super()._turn(angle)
        return self._complex(*(_without_rounding(part(angle)) for part in (np.cos, np.sin)))

    def _mark(self, where: Any, status: Status) -> None:
        np.maximum(self.codes, np.where(where, np.int8(_CODE[status]), np.int8(0)), out=self.codes)

    def _lines_sine(self, sine: Any) -> Any:
        if np.min(sine) >= ILL or np.max(sine) <= -ILL:  # false for NaN as well
            return sine
        size = np.abs(sine)
        self._mark(size < ILL, "ill-conditioned")
        self._mark(size < SINGULAR, "singular")
        return np.where(size < SINGULAR, NAN, sine)

    def _reaches(self, square: Any, radius: Any, distance: Any) -> Any:
        if np.min(square) >= (ILL * np.max(radius)) ** 2:
            return square
        out = square < -TANGENT * radius * radius
        self._mark(square < ILL * ILL * radius * radius, "ill-conditioned")
        self._mark(out, "no-assembly")
        return np.where(out, NAN, np.maximum(square, 0.0))

    def _assembles(self, product: Any, first: Any, second: Any, base: Any, total: Any, double: Any) -> Any:
        if np.min(product) > (ILL * np.max(double)) ** 2:
            return product
        out = product < -2.0 * TANGENT * total * total * first * second
        self._mark(product < (ILL * double) ** 2, "ill-conditioned")
        self._mark(base == 0.0, "singular")
        self._mark(out, "no-assembly")
        return np.where(out | (base == 0.0), NAN, np.maximum(product, 0.0))

    def _apart(self, distance: Any) -> Any:
        if np.min(distance) > 0.0:
            return distance
        self._mark(distance == 0.0, "singular")
        return np.where(distance == 0.0, NAN, distance)

    def _holds(self, determinant: Any, apart: Any, astray: Any, missing: Any) -> Any:
        size = np.abs(determinant)
        if np.min(size) >= ILL and np.max(apart) <= CLOSED and not np.any(astray):
            return determinant
        reached, folded = astray == 0.0, size < FOLDED
        apart_here = ~(reached & (folded | (apart <= CLOSED)))
        self._mark(size < ILL, "ill-conditioned")
        self._mark(reached & folded, "singular")
        self._mark(apart_here, "no-assembly")
        return np.where(folded | apart_here, NAN, determinant)

    def _divisor(self, size: Any) -> Any:
        return size if np.min(size) > 0.0 else np.where(size == 0.0, 1.0, size)

    def _bears(self, size: Any, moment: Any) -> Any:
        if np.min(size) > 0.0:
            return size
        return np.where(size == 0.0, np.where(moment == 0.0, 1.0, NAN), size)


def _without_rounding(component: Any) -> Any:
    size = np.abs(component)
    return component if size.min() > RIGHT else np.where(size > RIGHT, component, 0.0)


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
    arrays = {name: np.asarray(value, float) for name, value in givens.items() if np.ndim(value)}
    size = len(next(iter(arrays.values())))
    if size > chunk:
        settle_heap()
    once, each, dead = _split(program.needed_for(wanted), arrays, wanted)
    fixed = ExactBoard({name: float(value) for name, value in givens.items() if name not in arrays})
    once.run(fixed)
    results: dict[str, NDArray[Any]] = {name: np.empty(size, _kind(fixed.values.get(name))) for name in wanted}
    codes = np.full(size, _CODE[fixed.status], np.int8)
    board = ArrayBoard({}, 0)
    steps = [(board.operation(s.verb, s.law), s.name, s.operands, last) for s, last in zip(each, dead, strict=True)]
    with np.errstate(invalid="ignore", divide="ignore"):
        for start in range(0, size, chunk):
            part = slice(start, min(start + chunk, size))
            board.restart({**fixed.values, **{name: array[part] for name, array in arrays.items()}}, codes[part])
            perform, values = board.perform, board.values
            for operate, name, operands, last in steps:
                perform(operate, name, operands)
                for spent in last:
                    del values[spent]
            for name in wanted:
                value = board.values[name]
                if results[name].dtype != np.result_type(value):
                    results[name] = results[name].astype(complex)
                results[name][part] = value
    return results, codes


def _split(
    program: Program, arrays: Iterable[str], wanted: Sequence[str]
) -> tuple[Program, Program, tuple[tuple[str, ...], ...]]:
    """Return the steps that are the same everywhere, the others, and what nothing needs after each of those."""
    varying, once, each = set(arrays), [], []
    for step in program:
        if varying.isdisjoint(step.operands):
            once.append(step)
        else:
            each.append(step)
            varying.add(step.name)
    rest = Program(tuple(each))
    dead = tuple(tuple(name for name in names if name in varying) for names in rest.last_uses(wanted))
    return Program(tuple(once)), rest, dead


def _kind(value: Any) -> type:
    return complex if isinstance(value, complex) else float


def settle_heap() -> None:
    """Keep glibc from giving memory back after every large temporary: batches run up to four times faster.

    One allocation just below the largest mmap threshold, freed at once, raises the thresholds for the process.
    """
    np.empty(31 << 20, np.uint8)
