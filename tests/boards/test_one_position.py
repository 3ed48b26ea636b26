"""A program printed as plain Python, as JavaScript and as a loop: numbers and statuses of the exact board."""

from __future__ import annotations

import json
import math
import struct
import sys
from collections.abc import Iterator, Mapping
from functools import cache
from typing import Any

import numpy as np
import pytest
import quickjs

from kulman import load_task
from kulman.plans.board import Program, Step
from kulman.plans.boards.batch import batch, script_names, script_of, values_of
from kulman.plans.boards.exact import STATUSES, ExactBoard, run
from kulman.plans.linkages.solved import solve_linkage
from kulman.scales.errors import InputError, KulmanError
from kulman.variants.shelf import bundled

EPS = 2.0**-52
LINKAGES = bundled("mechanism")
COUNTS = [pytest.param(6, id="few"), pytest.param(360, id="cycle", marks=pytest.mark.soak)]
CALL = "JSON.stringify(solve({}).flat().map(String))"

Case = tuple[Program, Mapping[str, float]]


@cache
def cases(name: str, count: int) -> tuple[Case, ...]:
    """Return what `positions` finds, once for all printers that a process tests."""
    return tuple(positions(name, count))


def positions(name: str, count: int) -> Iterator[Case]:
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


LOOPS = [pytest.param(name, 360, id=name, marks=pytest.mark.soak) for name in LINKAGES]


@pytest.mark.parametrize(("name", "count"), [pytest.param("nau-slider-crank", 12, id="few"), *LOOPS])
def test_compiled_loop_gives_the_bits_and_statuses_of_the_exact_board(name: str, count: int) -> None:
    pytest.importorskip("numba", reason="the extra `fast` is not installed")
    alike: dict[Any, list[Mapping[str, float]]] = {}
    for program, givens in cases(name, count):
        alike.setdefault((program, tuple(givens)), []).append(givens)
    (program, names), rows = max(alike.items(), key=lambda item: len(item[1]))
    assert len(rows) > count // 2
    wanted = [*program.names[:: len(program.names) // 4], *program.names[-3:]]
    same = {n for n in names if all(row[n] == rows[0][n] for row in rows)}
    givens = {n: rows[0][n] if n in same else np.array([row[n] for row in rows]) for n in names}

    results, codes = batch(program, givens, wanted, loop=True)

    boards = [run(program, row) for row in rows]
    assert [STATUSES[code] for code in codes] == [board.status for board in boards]
    for n in {*wanted} - rounded(program):
        ours = [part for board in boards for part in numbers(board.values[n])]
        assert [*map(bits, ours)] == [bits(part) for value in results[n].tolist() for part in numbers(value)], n


def test_loop_without_its_extra_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "numba", None)
    program = Program((Step("turn", "u", ("phi",)),))

    with pytest.raises(InputError) as error:
        batch(program, {"phi": np.array([1.0])}, ["u"], loop=True)

    assert error.value.key == "fast-extra"


def test_loop_leaves_steps_that_are_more_than_arithmetic_to_arrays(monkeypatch: pytest.MonkeyPatch) -> None:
    from kulman.plans.laws import LAWS

    pytest.importorskip("numba", reason="the extra `fast` is not installed")
    monkeypatch.setitem(LAWS, "more", lambda value: np.sin(value) if np.ndim(value) else math.sin(value))
    program = Program((Step("calc", "z", ("x",), "more"),))

    results, _ = batch(program, {"x": np.array([1.0, 2.0])}, ["z"], loop=True)

    assert results["z"].tolist() == np.sin([1.0, 2.0]).tolist()
