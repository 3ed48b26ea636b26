"""Arrays of one quantity that know their name and their unit; many numbers as text."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from functools import cache
from typing import Any, Literal, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .units import converted, unit

Floats = NDArray[np.floating[Any]]
PART = 4096  # rows of text at a time
PLAIN = 1e-4, 1e15  # sizes between which no number needs an exponent
POWERS = 10.0 ** np.arange(21)  # all of them exact
FEWEST, WIDE = 10**16, 24  # the smallest number of 17 digits; characters of the longest text of a number
SURE = 1e-6  # of the last one of 17 digits: `repr` decides where something is nearer to a limit
Method = Literal["__call__", "reduce", "reduceat", "accumulate", "outer", "at"]


class Series(np.ndarray[Any, np.dtype[Any]]):
    """Values of one quantity by its `name`, in its `unit`; what is calculated of them is a plain array."""

    name: str
    unit: str

    def __new__(cls, values: ArrayLike, name: str, of: str) -> Self:
        """Return values with a name and a unit."""
        series = np.asarray(values).view(cls)
        series.name, series.unit = name, of
        return series

    def __array_finalize__(self, whole: Any) -> None:
        """Leave its name and unit to a part of a series."""
        self.name, self.unit = getattr(whole, "name", ""), getattr(whole, "unit", "")

    def __array_ufunc__(self, ufunc: np.ufunc, method: Method, *inputs: Any, **kwargs: Any) -> Any:
        """Calculate with plain arrays: a product of lengths is no length."""
        bare = [np.asarray(value) if isinstance(value, Series) else value for value in inputs]
        return getattr(ufunc, method)(*bare, **kwargs)

    def to(self, of: str) -> Series:
        """Return the values in another unit, `"mm"`, `"об/хв"`.

        Raises InputError: a unit that is not known, or is one of something else.
        """
        own, one = unit(self.unit), converted(1.0, unit(of), unit(self.unit))
        return Series(np.asarray(self) * (own.to_si(1.0) / one), self.name, unit(of).name)

    def __repr__(self) -> str:
        """Return name, unit and values, of many the first and the last ones."""
        return f"{self.name}, {self.unit}: {np.array2string(np.asarray(self), threshold=8, precision=6)}"

    __str__ = __repr__


def rows_of(columns: Sequence[Floats], between: str, comma: bool) -> Iterator[list[str]]:
    """Go through rows of numbers as text, part by part, as `repr` has them in half its time: nothing for no number.

    Parameters
    ----------
    columns : sequence of float64 arrays of shape (N,)
    between : str
        One character, between two numbers of a row.
    comma : bool
        Numbers have decimal commas.

    Yields
    ------
    list of str, N in all

    >>> next(rows_of([np.array([0.1, -2.0]), np.array([1e-7, np.nan])], ";", True))
    ['0,1;1e-07', '-2,0;']
    """
    commas = bytes.maketrans(b".", b",") if comma else None
    for start in range(0, len(columns[0]), PART):
        parts = [column[start : start + PART] + 0.0 for column in columns]  # no zero below zero
        page = np.full((len(parts[0]), len(parts), WIDE + 1), ord(between), np.uint8)
        page[:, -1, -1] = ord("\n")
        for at, part in enumerate(parts):
            page[:, at, :-1] = _characters(part)
        yield page.tobytes().translate(commas, b"\0").decode().split("\n")[:-1]


def _characters(values: Floats) -> NDArray[np.uint8]:
    """Return the text of each number, uint8 of shape (N, WIDE); zeros among its characters are to be left out.

    Digits are laid on a row twice, four at a time: those before the point and those behind it, one place further.
    """
    fours, ends, before, behind, kept, point = _tables()
    digits, k, sure = _shortest(np.abs(values))
    laid = np.zeros((2, len(values), WIDE), np.uint8)
    zeros: Any = 0  # at the end
    for four, power in enumerate((10**16, 10**12, 10**8, 10**4, 1), 1):
        group = digits // power
        digits = digits - group * power
        laid[1].view(np.uint32)[:, four] = fours.take(group)
        zeros = ends.take(group) + (group == 0) * zeros
    laid[0].reshape(-1)[:-1] = laid[1].reshape(-1)[1:]
    first, second = laid.view(np.uint64)
    first &= before.take(k, 0)
    second &= behind.take(k, 0)
    second &= kept.take(np.maximum(WIDE - 1 - zeros, WIDE - k), 0)
    text: NDArray[np.uint8] = (first | second | point.take(k, 0)).view(np.uint8)
    text[:, 0] = np.signbit(values) * np.uint8(ord("-"))
    written = [repr(value) if math.isfinite(value) else "" for value in values[~sure].tolist()]
    text[~sure] = np.array(written, f"S{WIDE}").view(np.uint8).reshape(-1, WIDE)
    return text


def _shortest(sizes: Floats) -> tuple[NDArray[np.int64], NDArray[np.intp], NDArray[np.bool_]]:
    """Return 17 digits of each number, with most zeros at their end; how many are behind the point; if all is sure.

    Multiplied by the power of ten that leaves 17 digits before the point, a number is the sum of two floats, exactly
    (T. J. Dekker, A floating-point technique for extending the available precision, Numer. Math. 18, 1971). What is
    less than half a unit of its last place off reads back as the number: at most 11.1 here, so there are a few whole
    numbers, perhaps multiples of ten, and no more than one of a hundred, which has as many zeros as any.
    """
    nothing, sure = sizes == 0.0, (sizes >= PLAIN[0]) & (sizes < PLAIN[1])
    sizes = np.where(sure, sizes, 1.5)
    k = 16 - np.floor(np.log10(sizes)).astype(np.intp)
    power = POWERS.take(k)
    (a, b), (c, d) = _halves(sizes), _halves(power)
    product = sizes * power
    lost = ((a * c - product) + a * d + b * c) + b * d
    whole = np.rint(lost)
    digits = product.astype(np.int64) + whole.astype(np.int64)
    fraction, exponent = np.frexp(sizes)
    half = np.ldexp(power, exponent - 54)
    sure &= (fraction != 0.5) & (np.abs(lost - whole) < 0.5 - SURE)  # below a power of two the unit is half as large
    last = (digits - digits // 100 * 100).astype(float)
    place, to = last + (lost - whole), last
    for step in (10.0, 100.0):
        multiple = np.rint(place / step) * step
        off = np.abs(place - multiple)
        sure &= (np.abs(off - half) > SURE) & (np.abs(off - 5.0) > SURE)
        to = np.where(off < half, multiple, to)
    digits += (to - last).astype(np.int64)
    sure &= (digits >= FEWEST) & (digits < 10 * FEWEST)
    return np.where(nothing, 0, digits), k, sure | nothing


def _halves(values: Floats) -> tuple[Floats, Floats]:
    """Return numbers as sums of two, of 26 digits of two each."""
    carried = 134217729.0 * values
    high = carried - (carried - values)
    return high, values - high


@cache
def _tables() -> tuple[NDArray[Any], ...]:
    """Return four digits as text, the zeros at their end, and by place of the point what stays of a row of digits."""
    fours = [f"{number:04}" for number in range(10_000)]
    ends = np.array([4 - len(text.rstrip("0")) for text in fours], np.int8)
    at, point = np.arange(WIDE), WIDE - 1 - np.arange(len(POWERS))[:, None]
    nought = (at == 1) & (point < 7)  # before the point of what is less than one
    masks = (at >= 6) & (at < point), at > point, at <= at[:, None]
    rows = [*(255 * mask for mask in masks), np.where(at == point, ord("."), nought * ord("0"))]
    return np.array(fours, "S4").view(np.uint32), ends, *(row.astype(np.uint8).view(np.uint64) for row in rows)
