"""The trace of a batch: what it saves, what it leaves whole, and that no bit of a result depends on it."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from kulman.plans.board import Program, Step
from kulman.plans.boards.arrays import ArrayBoard
from kulman.plans.boards.batch import batch
from kulman.plans.boards.exact import run
from kulman.plans.boards.printers import ARRAYS as FUNCTIONS
from kulman.plans.boards.printers import Chunked, Plain, compiled, in_order, plain_names
from kulman.plans.boards.trace import Real, Trace, TracingBoard, Vector
from kulman.plans.laws import LAWS, cross, dot
from kulman.tests.support.mechanisms import SEED, general_slider_crank, random_slider_cranks, solved

ARRAYS = {name: np.array(values) for name, values in {"x": [3.0, -2.0, 0.5], "y": [7.0, 0.25, -8.0]}.items()}


def worked_out(value: Real) -> Any:
    """Return the numbers that a number of a trace stands for, printed for chunks of two."""
    parts = [{name: array[part] for name, array in ARRAYS.items()} for part in (slice(0, 2), slice(2, 3))]
    return np.concatenate([in_chunk(value, arrays)[0] for arrays in parts])


def in_chunk(value: Real, arrays: dict[str, Any]) -> tuple[Any, Any]:
    """Return the numbers that a number of a trace stands for, printed for one chunk, and the codes of the statuses."""
    chunked = Chunked(value.trace, arrays, [(value.place, value.negative)])
    code, shared = compiled(chunked.once(), "once", plain_names())({})
    size = len(next(iter(arrays.values())))
    constant = dict(zip(chunked.shared, shared, strict=True)).get(value.place, 0.0)
    result, codes = np.full(size, -constant if value.negative else constant), np.full(size, code, np.int8)
    given, buffers = [arrays[name] for name in chunked.given.values()], np.empty((chunked.buffers, size))
    compiled(chunked.chunk(), "chunk", FUNCTIONS)(codes, given, shared, buffers, [result])
    return result, codes


def one_by_one(value: Real) -> list[Any]:
    """Return the same, printed for one position."""
    plain = Plain(value.trace, in_order(value.trace, [value.place]), [value.place])
    one = compiled(plain.source("one", f"({plain.value(value.place)},)"), "one", plain_names())
    found = [one({name: float(array[i]) for name, array in ARRAYS.items()})[1][0] for i in range(3)]
    return [-number if value.negative else number for number in found]


@pytest.fixture
def trace() -> Trace:
    return Trace()


FORMULAS = {
    "sums": lambda x, y: (x + y) - (y - x) + 2.0 + (1.0 - x) - (-y),
    "products": lambda x, y: x * y * 3.0 * (-2.0 * x) * -y,
    "quotients": lambda x, y: (x / y) / 3.0 + 1.0 / (y / -1.0),
    "sizes": lambda x, y: abs(x) - abs(-y),
    "zeros": lambda x, y: (x == 0.5) + (x - x == 0.0) + y * 0.0,
    "orders": lambda x, y: (x > y) * 1.0 + (-x < 2.0) * 2.0 + (y >= 7.0) * 4.0 + (-y >= 0.5) * 8.0 + (x <= 3.0) * 0.5,
    "turns": lambda x, y: x // 2.0 + y // -x,
    "powers": lambda x, y: 2.0 ** (x == 0.5) * y,
    "vectors": lambda x, y: dot(complex(1, 2) * x - 1j, x * complex(3, 0)) + cross(1j * y + complex(2, 1), 2j * x),
}


@pytest.mark.parametrize("formula", FORMULAS.values(), ids=FORMULAS)
def test_numbers_of_a_trace_are_those_of_the_formula(trace: Trace, formula: Any) -> None:
    traced = formula(trace.given("x"), trace.given("y"))

    numbers = [formula(float(x), float(y)) for x, y in zip(ARRAYS["x"], ARRAYS["y"], strict=True)]
    assert worked_out(traced).tolist() == numbers
    assert one_by_one(traced) == numbers


def test_normal_of_a_direction_is_the_turned_direction_and_costs_nothing(trace: Trace) -> None:
    x, y = trace.given("x"), trace.given("y")
    noted = len(trace.entries)

    normal = Vector(x, y) * 1j

    assert len(trace.entries) == noted
    assert worked_out(normal.real).tolist() == (-ARRAYS["y"]).tolist()
    assert worked_out(normal.imag).tolist() == ARRAYS["x"].tolist()


AGAIN = {
    "factors exchanged": lambda x, y: (x * y, y * x),
    "a difference turned round": lambda x, y: (x - y, y - x),
    "a sign": lambda x, y: (x * y, -x * y),
    "one and zero": lambda x, y: (x * y, (x * y) * 1.0 + 0.0),
    "normals": lambda x, y: (dot(Vector(x, y), Vector(y, x)), cross(Vector(x, y), Vector(x, -y))),
}
LOOKS = {
    "truth": bool,
    "order": lambda x: 1.0 if x < 1.0 else 0.0,
    "larger": lambda x: max(x, 0.0),
    "root of one number": math.sqrt,
    "function of numpy": np.sin,
    "product of two vectors": lambda x: Vector(x, x) * Vector(x, x),
    "product with a complex number": lambda x: Vector(x, x) * 2j,
}


@pytest.mark.parametrize("again", AGAIN.values(), ids=AGAIN)
def test_what_is_on_the_trace_is_not_noted_again(trace: Trace, again: Any) -> None:
    first, second = again(trace.given("x"), trace.given("y"))

    assert first.place == second.place


@pytest.mark.parametrize("look", LOOKS.values(), ids=LOOKS)
def test_number_of_a_trace_cannot_be_looked_at(trace: Trace, look: Any) -> None:
    with pytest.raises(TypeError):
        look(trace.given("x"))


STEPS = (("place", "P", ("x", "y")), ("calc", "half", ("P", "y"), "whole"), ("calc", "size", ("P",), "size"))
WHOLE = Program(tuple(Step(*step) for step in (*STEPS, ("lay", "Q", ("P", "half", "size")))))


def test_step_that_is_no_arithmetic_is_done_whole(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(LAWS, "whole", lambda P, y: P * np.where(np.asarray(y) > 0.0, 0.5, 0.25))
    monkeypatch.setitem(LAWS, "size", abs)

    results, codes = batch(WHOLE, ARRAYS, ["half", "size", "Q", "x"], 2)

    for index in range(3):
        board = run(WHOLE, {name: float(array[index]) for name, array in ARRAYS.items()})
        assert [results[name][index] for name in results] == [board.values[name] for name in results]
    assert {name: array.dtype.kind for name, array in results.items()} == {"half": "c", "size": "f", "Q": "c", "x": "f"}
    assert not codes.any()
    monkeypatch.setitem(LAWS, "size", lambda value: value + "")  # an error of a step without arrays is shown
    with pytest.raises(TypeError):
        batch(Program((Step("calc", "z", ("one",), "size"),)), ARRAYS, ["z"])


def test_batch_leaves_no_zero_with_a_sign() -> None:
    program = Program((Step("calc", "less", ("x",), "opposite"), Step("place", "P", ("less", "x"))))
    zeros = {"x": np.array([0.0, -0.0, 1.0])}

    results, _ = batch(program, zeros, ["less", "P", "x"])

    signs = [np.signbit(part).tolist() for part in (results["less"], results["P"].real, results["P"].imag)]
    assert signs == [[False, False, True], [False, False, True], [False] * 3]
    assert math.copysign(1.0, run(program, {"x": 0.0}).values["less"]) == 1.0


def test_array_board_step_by_step_gives_the_numbers_of_the_batch() -> None:
    mechanisms = solved(general_slider_crank(), random_slider_cranks(SEED, 50))
    board = ArrayBoard(mechanisms.values, 50)
    board.values |= {f"|{name}|": mechanisms.values[name] for name in ("F_1", "F_C", "F_B", "F_3")}

    with np.errstate(invalid="ignore", divide="ignore"):
        mechanisms.program.run(board)

    names = [name for name in mechanisms.program.names if np.ndim(board.values[name])]
    assert [name for name in names if not np.array_equal(board.values[name], mechanisms[name])] == []


CHECKS = {  # by the number of operands, which are what they like: not those of a triangle
    **dict.fromkeys(("_near", "_upright", "_lines_sine", "_apart"), 1),
    **dict.fromkeys(("_clear", "_bears"), 2),
    **{"_reaches": 4, "_holds": 4},
}
SIZES = (0.0, 1e-20, 1e-9, 1e-3, 1.0, 1e4)  # below every bound, between two, above all


@pytest.mark.parametrize("check", CHECKS)
def test_check_of_numbers_some_of_which_are_constants_is_that_of_arrays(check: str) -> None:
    luck = np.random.default_rng(12)
    for values in luck.choice(SIZES, (150, CHECKS[check])):
        values[0] *= luck.choice((-1.0, 1.0))  # the others are sizes
        varying = {0} if luck.random() < 0.3 else {*np.flatnonzero(luck.random(values.size) < 0.5)}
        varying = varying or {*range(values.size)}
        board, many = TracingBoard({}, map(str, range(values.size))), ArrayBoard({}, 1)
        arrays = {str(place): values[[place]] for place in varying}

        with np.errstate(invalid="ignore", divide="ignore"):
            traced = getattr(board, check)(*(board.values[str(i)] if i in varying else v for i, v in enumerate(values)))
            expected = getattr(many, check)(*(arrays.get(str(i), v) for i, v in enumerate(values)))
            found, codes = in_chunk(board.trace.real(traced), arrays)

        assert np.array_equal(found, np.ravel(expected), equal_nan=True), (values, varying)
        assert codes == many.codes, (values, varying)


def test_constant_that_is_calm_is_not_looked_at_beside_what_varies() -> None:
    board = TracingBoard({}, ["moment"])

    assert board._bears(2.0, board.values["moment"]) == 2.0
    assert "rare" not in {entry.operation for entry in board.trace.entries}
