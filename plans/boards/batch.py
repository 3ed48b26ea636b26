"""Many positions, variants or sizes at once: arithmetic is noted once, then done in chunks that fit the cache."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import DTypeLike, NDArray

from ..board import Program
from .arrays import CODES, ArrayBoard
from .chunks import Chunks, Store, room
from .exact import run
from .noting import NotingBoard

CHUNK = 8192
FEW = 2000  # positions up to which preparing a batch takes longer than running them on arrays


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
    codes = np.full(size, CODES[board.status], np.int8)
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
