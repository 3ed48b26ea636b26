"""Arrays of one quantity that know their name and their unit; many numbers as text."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any, Literal, Self

import numpy as np
import orjson
from numpy.typing import ArrayLike, NDArray

from .units import converted, unit

Floats = NDArray[np.floating[Any]]
PART = 4096  # rows of text at a time
Method = Literal["__call__", "reduce", "reduceat", "accumulate", "outer", "at"]


def _bare(value: Any) -> Any:
    """Return plain arrays for series, also those in a list or a tuple."""
    if isinstance(value, Series):
        return np.asarray(value)
    return type(value)(map(_bare, value)) if type(value) in (list, tuple) else value


def _places(method: str) -> Callable[..., Any]:
    """Return a method of a plain array that tells places: they have neither name nor unit."""
    return lambda series, *arguments, **kwargs: getattr(np.asarray(series), method)(*arguments, **kwargs)


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

    def __reduce__(self) -> tuple[Any, ...]:
        """Return what makes it again, with its name and unit, in another process."""
        return Series, (np.asarray(self), self.name, self.unit)

    def __array_ufunc__(self, ufunc: np.ufunc, method: Method, *inputs: Any, **kwargs: Any) -> Any:
        """Calculate with plain arrays, and into them: a product of lengths is no length."""
        return getattr(ufunc, method)(*map(_bare, inputs), **{name: _bare(value) for name, value in kwargs.items()})

    def __array_function__(self, function: Any, types: Any, inputs: Iterable[Any], kwargs: Mapping[str, Any]) -> Any:
        """Let functions of numpy have plain arrays: a gradient of speeds is no speed."""
        return function(*map(_bare, inputs), **{name: _bare(value) for name, value in kwargs.items()})

    argmax, argmin, argsort, argpartition = map(_places, ("argmax", "argmin", "argsort", "argpartition"))

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
    """Go through rows of numbers as text, part by part, each as short as it reads back: nothing for no number.

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
    ['0,1;1e-7', '-2,0;']
    """
    signs = bytes.maketrans(b".,", f"{',' if comma else '.'}{between}".encode("ascii"))
    for start in range(0, len(columns[0]), PART):
        part = np.column_stack([column[start : start + PART] for column in columns]) + 0.0  # no zero below zero
        text = orjson.dumps(part, option=orjson.OPT_SERIALIZE_NUMPY)[2:-2].translate(signs)
        text = text if np.isfinite(part).all() else text.replace(b"null", b"")
        yield text.decode("ascii").split(f"]{between}[")
