"""Arithmetic of a program written down once: for many positions in chunks that fit a cache, or for a page.

Formulas on arrays are written down likewise: what a course calculates for many places at once it calculates with
numbers that note what numpy does with them for none: the sums, products and functions are noted (`trace`), complex
numbers as their two parts, and printed as a program in JavaScript for one place.
"""

from __future__ import annotations

import ctypes
import json
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cache, cached_property
from typing import Any

import numpy as np
from numpy.lib.mixins import NDArrayOperatorsMixin
from numpy.typing import DTypeLike, NDArray

from ...scales.errors import InputError
from ...scales.kept import Kept
from ..board import Program
from .arrays import CODES, ArrayBoard
from .exact import MARKS, ORDERS, ROUND, graduation, run
from .printers import ARRAYS, PYTHON, Chunked, Output, Plain, compiled, in_order, number, plain_names
from .trace import Real, Trace, TracingBoard, Vector

CHUNK = 8192
FEW = 2000  # positions up to which preparing a batch takes longer than running them on arrays
PADDING = 72  # numbers between two buffers, lest all of them begin at the same place of a memory page
HEAP = {-3: 32 << 20, -1: 256 << 20}  # glibc's M_MMAP_THRESHOLD, the largest that it takes, and M_TRIM_THRESHOLD
PLAIN = frozenset((0.0, 1.0, -1.0))  # numbers that make a program shorter: they are written down as what they are


def batch(
    program: Program, givens: Mapping[str, Any], wanted: Sequence[str], chunk: int = CHUNK, loop: bool = False
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
    loop : bool
        Let numba (the extra `fast`) compile one loop for all: a second or two the first time, then up to three times as
        fast where few names are wanted. Arc tangents and powers may differ in the last bit.

    Returns
    -------
    results : dict of str to array of shape (N,)
        float64 for scalars, complex128 for vectors and points.
    codes : int8 array of shape (N,)
        Index into `STATUSES`.

    Raises InputError: a loop is asked for, and the extra `fast` is not installed.
    """
    return traced(program, givens, wanted, (TracingBoard, ArrayBoard({}, 0)), chunk, loop=loop)


def traced(
    program: Program,
    givens: Mapping[str, Any],
    wanted: Sequence[str],
    boards: tuple[type[TracingBoard], ArrayBoard],
    chunk: int = CHUNK,
    number: DTypeLike = float,
    loop: bool = False,
) -> tuple[dict[str, NDArray[Any]], NDArray[np.int8]]:
    """Run `program` as `batch` does, on numbers of another type, real ones, and with boards that go with them.

    Of the `boards` one writes the arithmetic down, and one does what is more than arithmetic.
    """
    arrays = {name: np.asarray(value, number) for name, value in givens.items() if np.ndim(value)}
    size = len(next(iter(arrays.values())))
    if size > chunk:
        settle_heap()
    scalars = {name: float(value) for name, value in givens.items() if name not in arrays}
    work = _written(program, scalars, arrays, tuple(wanted), boards)
    rooms = {name: _room(value, size, number) for name, value in work.results.items()}
    results = {name: room for name, (room, _) in rooms.items()}
    outputs = [into for _, filled in rooms.values() for into in filled]
    given = [arrays[name] for name in work.chunked.given.values()]
    with np.errstate(invalid="ignore", divide="ignore"):
        code, shared = work.once(scalars)
        codes = np.full(size, max(code, work.code), np.int8)
        kept = dict(zip(work.chunked.shared, shared, strict=True))
        for (place, negative), out in zip(work.chunked.outputs, outputs, strict=True):
            if place in kept:
                out[:] = 0.0 - kept[place] if negative else kept[place] + 0.0
        if loop and work.loop:
            varying = [out for (place, _), out in zip(work.chunked.outputs, outputs, strict=True) if place not in kept]
            work.loop(codes, *given, *(kept[p] for p in work.chunked.computed), *varying)
            return results, codes
        constants = [np.array(value, number) for value in shared]
        block = work.buffers(min(size, chunk) + PADDING, number)
        for start in range(0, size, chunk):
            part = slice(start, min(start + chunk, size))
            buffers = [buffer[: part.stop - start] for buffer in block]
            work.chunk(codes[part], [a[part] for a in given], constants, buffers, [o[part] for o in outputs])
    work.spare.append(block)
    return results, codes


@dataclass(frozen=True, eq=False)
class _Work:
    """A program for chunks, ready to be run: `code` is the status of what depends on no given."""

    results: Mapping[str, Any]
    chunked: Chunked
    code: int
    once: Callable[..., Any]
    chunk: Callable[..., Any]
    spare: list[NDArray[Any]] = field(default_factory=list)

    def buffers(self, length: int, number: DTypeLike) -> NDArray[Any]:
        """Return the buffers of a chunk, those of the last time where they fit."""
        block = self.spare.pop() if self.spare else np.empty((0, 0), number)
        shape = self.chunked.buffers, length
        return block if block.shape == shape and block.dtype == number else np.empty(shape, number)

    @cached_property
    def loop(self) -> Callable[..., Any] | None:
        """All positions at once, compiled by numba; none where steps are more than arithmetic."""
        try:
            from numba import njit
        except ImportError:
            raise InputError("fast-extra") from None
        names = {**plain_names(), "fmod": np.fmod}
        names |= {name: np.array(names[name]) for name in ("cosines", "sines")}
        try:
            function = compiled(self.chunked.loop(), "loop", names)
        except TypeError:
            return None
        looped: Callable[..., Any] = njit(error_model="numpy")(function)
        return looped


_KEPT = Kept[_Work](16)


def _written(
    program: Program,
    scalars: Mapping[str, float],
    arrays: Mapping[str, NDArray[Any]],
    wanted: tuple[str, ...],
    boards: tuple[type[TracingBoard], ArrayBoard],
) -> _Work:
    """Write a program down, once for all data of which the same names are arrays."""
    plain, (tracing, checks) = {name: value for name, value in scalars.items() if value in PLAIN}, boards
    givens: dict[str, Any] = {**scalars, **arrays}

    def write() -> _Work:
        needed = program.needed_for(wanted)
        first = cache(lambda: run(needed, {name: float(np.ravel(value)[0]) for name, value in givens.items()}).values)
        board = tracing(plain, givens.keys() - plain.keys(), checks, first)
        needed.run(board)
        results = {name: board.values[name] for name in wanted}
        outputs = [part for value in results.values() for part in _parts(value)]
        chunked = Chunked(board.trace, [*arrays], outputs)
        whole = {i: entry.data for i, entry in enumerate(board.trace.entries) if entry.operation == "whole"}
        once = compiled(chunked.once(), "once", plain_names())
        chunk = compiled(chunked.chunk(), "chunk", {**ARRAYS, "whole": whole})
        return _Work(results, chunked, CODES[board.status], once, chunk)

    key = program, tuple(plain.items()), frozenset(scalars), frozenset(arrays), wanted, tracing
    return _KEPT.get(key, write)


def _parts(value: Any) -> list[Output]:
    """Return the numbers of a trace that a value is made of."""
    numbers = (value.real, value.imag) if isinstance(value, Vector) else (value,)
    return [(number.place, number.negative) for number in numbers if isinstance(number, Real)]


def _room(value: Any, size: int, kind: DTypeLike) -> tuple[NDArray[Any], list[NDArray[Any]]]:
    """Return an array for a value at all positions, filled where that is the same, and what is to be filled."""
    vectors = np.result_type(kind, np.complex64)
    if isinstance(value, Real):
        room = np.empty(size, kind)
        return room, [room]
    if not isinstance(value, Vector):
        return np.full(size, value + type(value)(), vectors if isinstance(value, complex) else kind), []
    room = np.empty(size, vectors)
    parts = (value.real, room.real), (value.imag, room.imag)
    for part, into in parts:
        if not isinstance(part, Real):
            into[:] = part + 0.0
    return room, [into for part, into in parts if isinstance(part, Real)]


@cache
def settle_heap() -> None:
    """Keep glibc from giving memory back after every batch, to fetch it anew for the next, as long as it is not much.

    Batches run up to four times faster. Other C libraries are left as they are.
    """
    with suppress(AttributeError, OSError, TypeError):
        mallopt = ctypes.CDLL(None).mallopt
        for parameter, size in HEAP.items():
            mallopt(parameter, size)


JAVASCRIPT = {
    **PYTHON,
    "absolute": "Math.abs({0})",
    "sqrt": "Math.sqrt({0})",
    "root": "Math.sqrt({0})",
    "equal": "({0} == {1})",  # what is false is zero
    "logical_and": "({0} && {1})",
    "logical_or": "({0} || {1})",
    "where": "({0} ? {1} : {2})",
    "floor_divide": "floorDivide({0}, {1})",
    "power": "Math.pow({0}, {1})",
    "fmod": "({0} % {1})",
    "arctan2": "Math.atan2({0}, {1})",
    "cos": "Math.cos({0})",
    "sin": "Math.sin({0})",
    "mark": f"({{0}} === {{0}} ? (({{0}} - {ROUND!r}) % {MARKS} + {MARKS}) % {MARKS} : {MARKS})",
}


@dataclass(frozen=True)
class _Script(Plain):
    """The program of a trace for one position, as source of JavaScript.

    The function it defines takes the givens as an object by name and returns an array, the code of the status first.
    """

    operations = JAVASCRIPT
    orders = {  # noqa: RUF012
        order: said.replace(" or ", " || ").replace(" and ", " && ") for order, said in ORDERS.items()
    }
    new, again = "let {0} = {1};", "{0} = {1};"
    unless, worse, end = "if (!({0})) {{", "if ({0} && code < {1}) code = {1};", ("}",)
    both, never = " && ", "false"

    def source(self, function: str, result: str, code: int = 0) -> str:
        """Return the source of the function; it calls what `script_names` defines."""
        lines = [*self.lines(code), f"return [code, {result}];"]
        return "\n".join([f"function {function}(given) {{", *(f"  {line}" for line in lines), "}", ""])


@cache
def script_names(protractor: bool = True) -> str:
    """Return the source of what the source of JavaScript calls, the protractor's table as it is in Python."""
    return f"""\
const nan = NaN, inf = Infinity;
{_protractor() if protractor else ""}\
function floorDivide(a, b) {{
  const rest = a % b;
  let parts = (a - rest) / b;
  if (rest !== 0 && (b < 0) !== (rest < 0)) parts -= 1;
  const whole = Math.floor(parts);
  return parts - whole > 0.5 ? whole + 1 : whole;
}}
"""


def _protractor() -> str:
    cosines, sines = graduation()
    eighth = MARKS // 8 + 1
    return f"""\
const [cosines, sines] = (function () {{
  const sine = {json.dumps(sines[:eighth])}, cosine = {json.dumps(cosines[:eighth])};
  const quarter = sine.concat(cosine.slice(0, -1).reverse());
  const half = quarter.concat(quarter.slice(1, -1).reverse());
  const turn = half.concat(half.map(value => -value));
  return [turn.slice({MARKS // 4}).concat(turn.slice(0, {MARKS // 4})).concat([NaN]), turn.concat([NaN])];
}})();
"""


def script_of(program: Program, givens: Mapping[str, float], wanted: Sequence[str]) -> str:
    """Return a program as source of JavaScript, the function `solve(given)`, which calls what `script_names` defines.

    It is what a page that moves calculates with.

    It takes an object of numbers in SI by name and returns an array: the index of the status in `STATUSES`, then each
    of the `wanted` names, vectors as arrays of two numbers; equal to Python to the last bit, but for the last one of an
    arc tangent. Of the `givens` the zeros stay zeros: what lies in the origin is no point of the drawing.

    Raises TypeError: the program has steps that are more than arithmetic.
    """
    zeros = [name for name, value in givens.items() if value == 0.0]
    board = TracingBoard(dict.fromkeys(zeros, 0.0), [name for name in givens if name not in zeros])
    program.needed_for(wanted).run(board)
    return _script_of(board.trace, "solve", [board.values[name] for name in wanted], CODES[board.status])


def _script_of(trace: Trace, function: str, values: Iterable[Any], code: int = 0) -> str:
    """Return a function of JavaScript that gives back values of a trace; `code` is of what depends on no given."""
    values = [*values]
    places = [part.place for value in values for part in (value.real, value.imag) if isinstance(part, Real)]
    script = _Script(trace, in_order(trace, places), places)
    return script.source(function, ", ".join(_result_of(script, value) for value in values), code)


def _result_of(script: _Script, value: Any) -> str:
    """Return what gives a value back, its zeros without a sign; vectors as arrays."""
    if isinstance(value, Vector | complex):
        return f"[{_result_of(script, value.real)}, {_result_of(script, value.imag)}]"
    if isinstance(value, Real):
        shown = script.value(value.place)
        return f"0.0 - {shown}" if value.negative else f"{shown} + 0.0"
    return number(value + 0.0)


Part = Real | float
Formulas = Callable[[Callable[[str], Any]], Mapping[str, Any]]


class _Written(NDArrayOperatorsMixin):
    """A number, real or complex, that is written down; operators and numpy's functions do what `FUNCTIONS` say."""

    __eq__ = object.__eq__  # what changes from place to place equals no number everywhere
    __hash__ = None  # type: ignore[assignment]
    __slots__ = ("x", "y")

    def __init__(self, x: Part, y: Part = 0.0) -> None:
        self.x, self.y = x, y

    @property
    def real(self) -> _Written:
        """The real part."""
        return _Written(self.x)

    @property
    def imag(self) -> _Written:
        """The imaginary part."""
        return _Written(self.y)

    def conj(self) -> _Written:
        """Return the conjugate number."""
        return _Written(self.x, -self.y)

    def __array_ufunc__(self, function: Any, method: str, *numbers: Any, **how: Any) -> Any:
        do, elsewhere = FUNCTIONS.get(function.__name__), how.keys() - {"out"}  # no number is changed in its place
        return NotImplemented if do is None or method != "__call__" or elsewhere else do(*map(_as_written, numbers))

    def __array_function__(self, function: Any, kinds: Any, numbers: Any, how: Any) -> Any:
        return _where(*numbers) if function is np.where and not how else NotImplemented

    def __bool__(self) -> bool:
        raise TypeError("no value while formulas are written down")


def _as_written(number: Any) -> _Written:
    if isinstance(number, _Written):
        return number
    number = complex(number)
    return _Written(number.real, number.imag)


def _is_zero(part: Part) -> bool:
    return not isinstance(part, Real) and part == 0.0


def _times(a: Part, b: Part) -> Part:
    return 0.0 if _is_zero(a) or _is_zero(b) else a * b


def _product(a: _Written, b: _Written) -> _Written:
    return _Written(_times(a.x, b.x) + -_times(a.y, b.y), _times(a.x, b.y) + _times(a.y, b.x))


def _over(a: Part, b: Part) -> Part:
    if isinstance(a, Real) or isinstance(b, Real):
        return 0.0 if _is_zero(a) else a / b
    return float(np.divide(a, b))


def _quotient(a: _Written, b: _Written) -> _Written:
    if not _is_zero(b.y):
        raise TypeError("a quotient of complex numbers")
    return _Written(_over(a.x, b.x), _over(a.y, b.x))


def _size(a: _Written) -> _Written:
    if _is_zero(a.y):
        return _Written(abs(a.x))  # type: ignore[arg-type]
    return FUNCTIONS["sqrt"](_Written(_times(a.x, a.x) + _times(a.y, a.y)))


def _applied(operation: str) -> Callable[..., _Written]:
    """Return an operation on real numbers that is noted, or done where all of them are known."""

    def do(*numbers: Any) -> _Written:
        if not all(_is_zero(number.y) for number in numbers):
            raise TypeError(f"{operation} of complex numbers")
        noted = next((number.x for number in numbers if isinstance(number.x, Real)), None)
        if noted is None:
            return _Written(float(getattr(np, operation)(*(number.x for number in numbers))))
        return _Written(noted.trace.apply(operation, *(number.x for number in numbers)))

    return do


def _where(condition: Any, first: Any, second: Any) -> _Written:
    yes, no = _as_written(first), _as_written(second)
    if not isinstance(condition, _Written):
        return yes if condition else no
    if not isinstance(condition.x, Real):
        return yes if condition.x else no
    if _is_zero(yes.y) and _is_zero(no.y):
        return _Written(condition.x.trace.apply("where", condition.x, yes.x, no.x))
    return _Written(*(condition.x.trace.apply("where", condition.x, a, b) for a, b in ((yes.x, no.x), (yes.y, no.y))))


FUNCTIONS: dict[str, Callable[..., _Written]] = {
    **{name: _applied(name) for name in ("sin", "cos", "arctan2", "sqrt", "less", "less_equal", "power")},
    "greater": lambda a, b: b < a,
    "greater_equal": lambda a, b: b <= a,
    "add": lambda a, b: _Written(a.x + b.x, a.y + b.y),
    "subtract": lambda a, b: a + -b,
    "multiply": _product,
    "divide": _quotient,
    "negative": lambda a: _Written(-a.x, -a.y),
    "absolute": _size,
    "conjugate": _Written.conj,
    "hypot": lambda a, b: abs(a + b * 1j),
    "floor": lambda a: _applied("floor_divide")(a, _Written(1.0)),
    "isinf": lambda a: _Written(0.0),  # what changes from place to place is finite
}


def script_of_formulas(formulas: Formulas, function: str = "solve") -> tuple[str, list[str]]:
    """Return formulas as source of JavaScript, such as `solve(given)`, and the names of what it finds, in order.

    The `formulas` are a function that asks for what is given by its name, and returns numbers by their names. The
    function of JavaScript takes the given numbers by name and returns an array as that of a program does
    (`batch.script_of`): zero first, then each of the names, complex numbers as arrays of two.
    """
    trace = Trace()
    found = {name: _as_written(number) for name, number in formulas(lambda name: _Written(trace.given(name))).items()}
    values = [number.x if _is_zero(number.y) else Vector(number.x, number.y) for number in found.values()]
    return _script_of(trace, function, values), [*found]
