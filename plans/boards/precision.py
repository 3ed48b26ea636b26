"""Boards in another precision: single and extended arrays, and fifty digits for one position.

The same program runs on them; only protractor, thresholds and the number of corrections of a template go with the
digits.

Beside fifty digits all rounding of double precision shows.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..board import Program
from .arrays import ArrayBoard
from .batch import CHUNK, batch, traced
from .exact import NAN, RIGHT, SINGULAR, TANGENT, PlainBoard, run
from .template import CLOSED, CORRECTIONS, FOLDED
from .trace import Real, TracingBoard, Vector

DIGITS = 50
OF_FIFTY = 9  # of a template: five reach 16 digits from where it lies about, two more fifty, two are to spare


class _FiftyDigits(PlainBoard):
    """One position on numbers of mpmath, in whatever precision it works."""

    corrections = OF_FIFTY

    @staticmethod
    def _sqrt(square: Any) -> Any:
        from mpmath import mp

        return mp.sqrt(square) if square >= 0 else NAN

    @staticmethod
    def _complex(real: Any, imag: Any) -> Any:
        from mpmath import mpc

        return mpc(real, imag)

    def _turn(self, angle: Any) -> Any:
        from mpmath import mp

        if not math.isfinite(angle):
            return NAN
        direction = mp.expj(angle)
        return self._complex(self._upright(direction.real), self._upright(direction.imag))

    def _angle(self, first: Any, second: Any) -> Any:
        from mpmath import mp

        turned = second * first.conjugate()
        return mp.arg(turned)


def fifty_digits(program: Program, givens: Mapping[str, Any]) -> Mapping[str, Any]:
    """Run `program` with fifty digits for one position, and return every name.

    The `givens` are values in SI, taken as exact, floats or numbers of mpmath; what is returned is mpf or mpc.
    """
    from mpmath import mp, mpf

    with mp.workdps(DIGITS):
        board = _FiftyDigits({name: mpf(value) for name, value in givens.items()})
        program.run(board)
        return board.values


NO_WORD: dict[str, Any] = dict.fromkeys(("invalid", "divide", "over", "under"), "ignore")
LESS = 2.0**29  # how much coarser single precision is than double


class _PrecisionBoard(ArrayBoard):
    """N positions on arrays of the real type `number` and the complex type that goes with it."""

    number: type[np.floating[Any]]
    vector: type[np.complexfloating[Any, Any]]
    right: float

    def taken(self, givens: Mapping[str, Any]) -> dict[str, Any]:
        """Return the givens as numbers of this precision."""
        return {n: np.asarray(value, self.number)[()] for n, value in {"zero": 0.0, "one": 1.0, **givens}.items()}

    def perform(self, operate: Callable[..., Any], name: str, operands: tuple[str, ...]) -> None:
        """Make `name` with the operation of a step; what came of truth values is double."""
        super().perform(operate, name, operands)
        value = self.values[name]
        if isinstance(value, np.generic | np.ndarray):
            kind = self.number if np.isrealobj(value) else self.vector
            self.values[name] = value.astype(kind, copy=False)

    @staticmethod
    def _complex(real: Any, imag: Any) -> Any:
        kind = np.result_type(real, imag, np.complex64)
        points = np.empty(np.broadcast_shapes(np.shape(real), np.shape(imag)), kind)
        points.real, points.imag = real, imag
        return points[()]

    def _turn(self, angle: Any) -> Any:
        return self._complex(self._upright(np.cos(angle)), self._upright(np.sin(angle)))

    def _upright(self, component: Any) -> Any:
        return np.where(np.abs(component) <= self.right, self.number(0.0), component)[()]

    def _angle(self, first: Any, second: Any) -> Any:
        between = super()._angle(first, second)
        return between if np.ndim(between) else self.number(between)


class _SingleBoard(_PrecisionBoard):
    """Single precision: thresholds of as many units in the last place as always."""

    number, vector = np.float32, np.complex64
    right, parallel, touching, closed = (LESS * share for share in (RIGHT, SINGULAR, TANGENT, CLOSED))
    folded = LESS**0.5 * FOLDED


class _ExtendedBoard(_PrecisionBoard):
    """The longest floating-point numbers of the machine; the givens are no better, so the thresholds stay."""

    number, vector = np.longdouble, np.clongdouble
    right = RIGHT
    corrections = CORRECTIONS + 1


class _SingleTracing(TracingBoard):
    """Writes down the arithmetic of single precision; what depends on no array is done in double, and rounded then."""

    def _turn(self, angle: Any) -> Any:
        if not isinstance(angle, Real):
            return super()._turn(angle)
        return Vector(*(self._upright(self.trace.apply(function, angle)) for function in ("cos", "sin")))


BOARDS: dict[str, type[_PrecisionBoard]] = {"single": _SingleBoard, "extended": _ExtendedBoard}


def batch_in(
    program: Program, givens: Mapping[str, Any], wanted: Sequence[str], precision: str, chunk: int = CHUNK
) -> tuple[dict[str, NDArray[Any]], NDArray[np.int8]]:
    """Run `program` for N positions in a precision: `single`, `double` or `extended`.

    Parameters and results are those of `batch`, with the results of the precision's own types.
    """
    if precision == "double":
        return batch(program, givens, wanted, chunk)
    if precision == "single":
        return traced(program, givens, wanted, (_SingleTracing, _SingleBoard({}, 0)), chunk, np.float32)
    needed, board = program.needed_for(wanted), BOARDS[precision]({}, 0)
    exact = board.taken(givens)
    size = next(len(value) for value in exact.values() if value.ndim)
    codes = np.zeros(size, np.int8)
    rooms: dict[str, NDArray[Any]] = {}
    with np.errstate(**NO_WORD):
        for start in range(0, size, chunk):
            part = slice(start, min(start + chunk, size))
            board.restart({name: value[part] if value.ndim else value for name, value in exact.items()}, codes[part])
            needed.run(board)
            for name in wanted:
                value = board.values[name]
                if start == 0:
                    rooms[name] = np.empty(size, np.result_type(value))
                rooms[name][part] = value
    return rooms, codes


def run_in(program: Program, givens: Mapping[str, Any], precision: str) -> Mapping[str, Any]:
    """Run `program` for one position in a precision: `single`, `double`, `extended` or `fifty` digits.

    Every name is returned with its number: of numpy, Python or mpmath, as the precision is.
    """
    if precision == "fifty":
        return fifty_digits(program, givens)
    if precision == "double":
        return run(program, givens).values
    board = BOARDS[precision]({}, 1)
    board.restart(board.taken(givens), board.codes)
    with np.errstate(**NO_WORD):
        program.run(board)
    return board.values
