"""One position: the arithmetic of a program written down once, as plain Python or as JavaScript for a page."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from ..board import Program
from .arrays import CODES
from .exact import STATUSES, Status
from .printers import Plain, Script, compiled, in_order, number, plain_names
from .trace import Real, Vector
from .tracing import TracingBoard

KEPT = 64
_KEPT: dict[Any, Callable[..., Any]] = {}


def values_of(program: Program, givens: Mapping[str, float]) -> tuple[dict[str, Any], Status]:
    """Return all values of a program at one position by name, and the status of the position.

    They are those of the exact board to the last bit, in a quarter of the time from the second position on; which lines
    meet flatly, and which step fails, it does not say.

    Raises
    ------
    TypeError
        The program has steps that are more than arithmetic.
    """
    zeros = frozenset([name for name, value in givens.items() if value == 0.0])
    key = program, zeros, len(givens)
    found = _KEPT.get(key)
    if found is None:
        if len(_KEPT) >= KEPT:
            del _KEPT[next(iter(_KEPT))]
        found = _KEPT[key] = _write(program, givens)
    code, values = found(givens)
    return dict(zip(program.names, values, strict=True)), STATUSES[code]


def script_of(program: Program, givens: Mapping[str, float], wanted: Sequence[str]) -> str:
    """Return a program as source of JavaScript, the function `solve(given)`, which calls what `script_names` defines.

    It takes an object of numbers in SI by name and returns an array: the index of the status in `STATUSES`, then each
    of the `wanted` names, vectors as arrays of two numbers; equal to Python to the last bit, but for the last one of an
    arc tangent.

    Parameters
    ----------
    givens : mapping of str to float
        Of these the zeros stay zeros: what lies in the origin is no point of the drawing.

    Raises
    ------
    TypeError
        The program has steps that are more than arithmetic.
    """
    return _printed(Script, program.needed_for(wanted), givens, wanted, "solve", "[{}, {}]")


def _write(program: Program, givens: Mapping[str, float]) -> Callable[..., Any]:
    source = _printed(Plain, program, givens, program.names, "one", "complex({}, {})")
    return compiled(source, "one", plain_names())


def _printed(
    printer: type[Plain],
    program: Program,
    givens: Mapping[str, float],
    wanted: Sequence[str],
    function: str,
    vector: str,
) -> str:
    """Print a program with a function that returns the wanted names."""
    zeros = [name for name, value in givens.items() if value == 0.0]
    board = TracingBoard(dict.fromkeys(zeros, 0.0), givens.keys() - zeros)
    program.run(board)
    values = [board.values[name] for name in wanted]
    places = [part.place for value in values for part in _parts(value) if isinstance(part, Real)]
    plain = printer(board.trace, in_order(board.trace, places), places)
    return plain.source(function, [_result(plain, value, vector) for value in values], CODES[board.status])


def _parts(value: Any) -> tuple[Any, Any]:
    return value.real, value.imag


def _result(plain: Plain, value: Any, vector: str) -> str:
    """Return what gives a value back, its zeros without a sign."""
    if isinstance(value, Vector | complex):
        return vector.format(_result(plain, value.real, vector), _result(plain, value.imag, vector))
    if isinstance(value, Real):
        shown = plain.value(value.place)
        return f"0.0 - {shown}" if value.negative else f"{shown} + 0.0"
    return number(value + 0.0)
