"""One position: the arithmetic of a program written down once, as plain Python or as JavaScript for a page."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

from ...scales.kept import Kept
from ..board import Program
from .arrays import CODES, ORDERS
from .exact import STATUSES, Status
from .printers import PYTHON, Plain, compiled, in_order, number, plain_names
from .protractor import MARKS, ROUND, graduation
from .trace import Real, Vector
from .tracing import TracingBoard

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
    "mark": f"({{0}} === {{0}} ? (({{0}} - {ROUND!r}) % {MARKS} + {MARKS}) % {MARKS} : {MARKS})",
}
_KEPT = Kept[Callable[..., Any]](64)


@dataclass(frozen=True)
class Script(Plain):
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

    def source(self, function: str, result: str, code: int = 0, lines: Sequence[str] = ()) -> str:
        """Return the source of the function; it calls what `script_names` defines."""
        lines = [*self.lines(code), *lines, f"return [code, {result}];"]
        return "\n".join([f"function {function}(given) {{", *(f"  {line}" for line in lines), "}", ""])


@cache
def script_names() -> str:
    """Return the source of what the source of `Script` calls, the protractor's table as it is in Python."""
    cosines, sines = graduation()
    eighth = MARKS // 8 + 1
    return f"""\
const nan = NaN, inf = Infinity;
const [cosines, sines] = (function () {{
  const sine = {json.dumps(sines[:eighth])}, cosine = {json.dumps(cosines[:eighth])};
  const quarter = sine.concat(cosine.slice(0, -1).reverse());
  const half = quarter.concat(quarter.slice(1, -1).reverse());
  const turn = half.concat(half.map(value => -value));
  return [turn.slice({MARKS // 4}).concat(turn.slice(0, {MARKS // 4})).concat([NaN]), turn.concat([NaN])];
}})();
function floorDivide(a, b) {{
  const rest = a % b;
  let parts = (a - rest) / b;
  if (rest !== 0 && (b < 0) !== (rest < 0)) parts -= 1;
  const whole = Math.floor(parts);
  return parts - whole > 0.5 ? whole + 1 : whole;
}}
"""


def values_of(
    program: Program, givens: Mapping[str, float], wanted: tuple[str, ...] | None = None
) -> tuple[dict[str, Any], Status]:
    """Return all values of a program at one position by name, or the `wanted` ones, and the status of the position.

    They are those of the exact board to the last bit, in a quarter of the time from the second position on; which lines
    meet flatly, and which step fails, it does not say. Steps that the wanted names do not need are not done.

    Raises
    ------
    TypeError
        The program has steps that are more than arithmetic.
    """
    key = program, tuple([name for name, value in givens.items() if value == 0.0]), len(givens), wanted
    code, values = _KEPT.get(key, lambda: _write(program, givens, wanted))(givens)
    return values, STATUSES[code]


def script_of(program: Program, givens: Mapping[str, float], wanted: Sequence[str]) -> str:
    """Return a program as source of JavaScript, the function `solve(given)`, which calls what `script_names` defines.

    It is what a page that moves will calculate with; nothing of the package itself asks for it.

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
    script, results, code = _printed(Script, program, givens, wanted, "[{}, {}]")
    return script.source("solve", ", ".join(results), code)


def _write(program: Program, givens: Mapping[str, float], wanted: tuple[str, ...] | None) -> Callable[..., Any]:
    names = wanted or program.names
    plain, results, code = _printed(Plain, program, givens, names, "complex({}, {})")
    alike: dict[str, list[str]] = {}
    for name, result in zip(names, results, strict=True):
        alike.setdefault(result, []).append(f"values[{name!r}] = ")
    lines = ["values = blank.copy()", *("".join(into) + result for result, into in alike.items())]
    return compiled(plain.source("one", "values", code, lines), "one", {**plain_names(), "blank": dict.fromkeys(names)})


def _printed(
    printer: type[Plain], program: Program, givens: Mapping[str, float], wanted: Sequence[str], vector: str
) -> tuple[Plain, list[str], int]:
    """Return the printer of a program, expressions of the wanted names, and the code of what depends on no given."""
    zeros = [name for name, value in givens.items() if value == 0.0]
    board = TracingBoard(dict.fromkeys(zeros, 0.0), givens.keys() - zeros)
    program.needed_for(wanted).run(board)
    values = [board.values[name] for name in wanted]
    places = [part.place for value in values for part in (value.real, value.imag) if isinstance(part, Real)]
    plain = printer(board.trace, in_order(board.trace, places), places)
    return plain, [_result(plain, value, vector) for value in values], CODES[board.status]


def _result(plain: Plain, value: Any, vector: str) -> str:
    """Return what gives a value back, its zeros without a sign."""
    if isinstance(value, Vector | complex):
        return vector.format(_result(plain, value.real, vector), _result(plain, value.imag, vector))
    if isinstance(value, Real):
        shown = plain.value(value.place)
        return f"0.0 - {shown}" if value.negative else f"{shown} + 0.0"
    return number(value + 0.0)
