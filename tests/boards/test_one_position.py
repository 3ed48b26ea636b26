"""A program printed for one position, in Python and in JavaScript: the numbers and statuses of the exact board."""

from __future__ import annotations

import json
import math
import struct
from collections.abc import Iterator, Mapping
from typing import Any

import pytest
import quickjs

from kulman.plans.board import Program, Step
from kulman.plans.boards.exact import STATUSES, ExactBoard, run
from kulman.plans.boards.one import script_of, values_of
from kulman.plans.boards.printers import script_names
from kulman.plans.linkages.solved import solve_linkage
from kulman.scales.errors import KulmanError
from kulman.variants import load_task
from kulman.variants.shelf import bundled

EPS = 2.0**-52
LINKAGES = [name for name in bundled() if name not in ("karpenko-hoist", "madi-cam", "madi-gear")]
COUNTS = [pytest.param(6, id="few"), pytest.param(360, id="cycle", marks=pytest.mark.soak)]
CALL = "JSON.stringify(solve({}).flat().map(String))"

Case = tuple[Program, Mapping[str, float]]


def cases(name: str, count: int) -> Iterator[Case]:
    """Go through positions of a task's first variant, every third with links so long that not all of them assemble."""
    task = load_task(name)
    given = task.values(next(iter(task.variants)))
    for number in range(count):
        longer = 1.0 + (number % 3 == 2) * 0.9 * math.sin(number)
        values = {key: value * longer if key in ("l_AB", "l_BC") else value for key, value in given.items()}
        if "phi" in values:
            values["phi"] = 2.0 * math.pi * number / count + 0.01
        try:
            solved = solve_linkage(task.mechanism, values)
        except KulmanError:
            continue
        yield solved.program, solved.givens


class Turned(ExactBoard):
    """A board whose angles miss by eight units in the last place, to see what that does to all that hangs on them."""

    def _angle(self, first: Any, second: Any) -> Any:
        return super()._angle(first, second) * (1.0 + 8.0 * EPS)


def numbers(value: Any) -> list[float]:
    return [value.real, value.imag] if isinstance(value, complex) else [value]


def bits(value: float) -> bytes:
    return b"" if value != value else struct.pack("d", value)


def rounded(program: Program) -> set[str]:
    """Return what hangs on an arc tangent, which JavaScript rounds in its own way."""
    angles = {step.name for step in program if step.verb == "angle"}
    bits = [program.hanging.get(name, 0) for name in angles]
    return angles | {name for i, name in enumerate(program.names) if any(hanging >> i & 1 for hanging in bits)}


@pytest.mark.parametrize("count", COUNTS)
@pytest.mark.parametrize("name", LINKAGES)
def test_plain_python_gives_the_bits_and_statuses_of_the_exact_board(name: str, count: int) -> None:
    seen = set()
    for program, givens in cases(name, count):
        board = run(program, givens)

        values, status = values_of(program, givens)

        assert values.keys() == {*program.names}
        assert [n for n in values if type(values[n]) is not type(board.values[n])] == []
        assert [n for n in values if [*map(bits, numbers(values[n]))] != [*map(bits, numbers(board.values[n]))]] == []
        assert status == board.status
        seen.add(status)
    assert "ok" in seen


@pytest.mark.parametrize("count", COUNTS)
@pytest.mark.parametrize("name", LINKAGES)
def test_script_gives_the_numbers_of_python(name: str, count: int) -> None:
    scripts: dict[Any, Any] = {}
    for program, givens in cases(name, count):
        key = program, frozenset(n for n in givens if givens[n] == 0.0)
        if key not in scripts:
            scripts[key] = quickjs.Context()
            scripts[key].eval(script_names() + script_of(program, givens, program.names))
        board = run(program, givens)

        code, *found = json.loads(scripts[key].eval(CALL.format(json.dumps(dict(givens)))))

        ours = [number for n in program.names for number in numbers(board.values[n])]
        theirs = [float(number) for number in found]
        assert STATUSES[int(code)] == board.status
        turned = Turned(givens)
        turned.follow(program)
        moved = [number for n in program.names for number in numbers(turned.values[n])]
        free = [n in rounded(program) for n in program.names for _ in numbers(board.values[n])]
        for mine, other, beside, arc in zip(ours, theirs, moved, free, strict=True):
            allowed = 4 * EPS * abs(mine) + 2 * abs(beside - mine)
            assert bits(mine) == bits(other) or (arc and abs(mine - other) <= allowed)


def test_step_that_is_more_than_arithmetic_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    from kulman.plans.laws import LAWS

    monkeypatch.setitem(LAWS, "more", lambda value: math.sin(value))
    program = Program((Step("calc", "z", ("x",), "more"),))

    with pytest.raises(TypeError):
        values_of(program, {"x": 1.0})
