"""One position, many, printed as Python, JavaScript or a loop: the same bits; the protractor against fifty digits."""

from __future__ import annotations

import json
import math
import struct
import subprocess
import sys
from collections.abc import Iterable, Mapping
from contextlib import suppress
from functools import cache
from typing import Any

import mpmath
import numpy as np
import pytest
import quickjs

from kulman import load_task
from kulman.plans.board import Program, Step
from kulman.plans.boards.arrays import ArrayBoard
from kulman.plans.boards.batch import batch, script_names, script_of
from kulman.plans.boards.exact import FARTHEST, MARKS, STATUSES, ExactBoard, graduation, run
from kulman.plans.laws import LAWS
from kulman.plans.linkages.solved import board_givens, solve_linkage
from kulman.scales.errors import InputError, KulmanError
from kulman.tests.support.mechanisms import SEED, Solved, general_slider_crank, one_of, random_slider_cranks, solved
from kulman.variants.shelf import bundled


def bits(value: Any) -> bytes:
    return np.asarray(value).tobytes()


def test_many_at_once_equal_one_at_a_time_to_the_last_bit(cranks: Solved) -> None:
    names = [name for name in cranks.program.names if name in cranks.results]
    for index in range(0, len(cranks.codes), 3):
        board = run(cranks.program, board_givens(cranks.mechanism, one_of(cranks.values, index)))
        different = [name for name in names if bits(board.values[name]) != bits(cranks.results[name][index])]
        assert (index, different) == (index, [])
        assert board.status == STATUSES[cranks.codes[index]]


def test_chunks_gaps_in_memory_and_names_wanted_change_no_bit() -> None:
    mechanisms = solved(general_slider_crank(), random_slider_cranks(SEED, 500))
    program, before = mechanisms.program, {name: bits(array) for name, array in mechanisms.values.items()}
    givens = board_givens(general_slider_crank(), mechanisms.values)
    spread = {name: np.repeat(array, 3)[::3] for name, array in mechanisms.values.items()}
    found = [batch(program, givens, ["a_B", "R_12", "M_bal"], chunk) for chunk in (7, 499, 500, 8192)]
    found += [batch(program, givens, [name]) for name in program.names[::5]]
    found.append(batch(program, board_givens(general_slider_crank(), spread), program.names))

    for results, codes in found:
        assert np.array_equal(codes, mechanisms.codes)
        assert [name for name in results if bits(results[name]) != bits(mechanisms[name])] == []
    assert [list(results) for results, _ in found[4:-1]] == [[name] for name in program.names[::5]]
    assert {name: bits(array) for name, array in mechanisms.values.items()} == before  # what goes in stays


def test_any_one_given_may_vary_while_the_others_stay() -> None:
    mechanism, values = general_slider_crank(), random_slider_cranks(SEED, 1)
    fixed = one_of(values, 0)
    program = solved(mechanism, values).program
    names = [name for name in program.names if not name.startswith("_")]
    for given in values:
        varied = np.array([fixed[given], fixed[given] * (1 + 1e-4), fixed[given]])

        results, codes = batch(program, board_givens(mechanism, {**fixed, given: varied}), names)

        for index, value in enumerate(varied[:2]):
            board = run(program, board_givens(mechanism, {**fixed, given: float(value)}))
            assert STATUSES[codes[index]] == board.status
            assert [name for name in names if bits(board.values[name]) != bits(results[name][index])] == []


FAULTS = """
import resource
import numpy as np
from kulman.plans.board import Program, Step
from kulman.plans.boards.batch import batch

program = Program(tuple(Step("turn", f"u{i}", ("phi",)) for i in range(8)))
givens, wanted = {"phi": np.linspace(0.0, 6.0, 700_000)}, [f"u{i}" for i in range(8)]
kept = batch(program, givens, wanted)  # a first one that is still in use
for _ in range(3):
    before = resource.getrusage(resource.RUSAGE_SELF).ru_minflt
    batch(program, givens, wanted)
    print(resource.getrusage(resource.RUSAGE_SELF).ru_minflt - before)
"""


@pytest.mark.skipif(sys.platform != "linux", reason="counts page faults")
def test_memory_of_a_large_batch_serves_the_next() -> None:
    output = subprocess.run([sys.executable, "-c", FAULTS], capture_output=True, text=True, check=True).stdout

    first, _, last = map(int, output.split())
    assert last * 10 <= first


# One position, printed.
EPS = 2.0**-52
LINKAGES = bundled("mechanism")
CALL = "JSON.stringify(solve({}).flat().map(String))"
Case = tuple[Program, Mapping[str, float]]


@cache
def cases(name: str, count: int) -> tuple[Case, ...]:
    """Return positions of a task's first variant, every third with links so long that not all of them assemble."""
    task, found = load_task(name), []
    given = task.values(next(iter(task.variants)))
    for number in range(count):
        longer = 1.0 + (number % 3 == 2) * 0.9 * math.sin(number)
        values = {key: value * longer if key in ("l_AB", "l_BC") else value for key, value in given.items()}
        values |= {"phi": 2.0 * math.pi * number / count + 0.01} if "phi" in values else {}
        with suppress(KulmanError):
            standing = solve_linkage(task.mechanism, values)
            found.append((standing.program, standing.givens))
    return tuple(found)


class Turned(ExactBoard):
    """A board whose angles miss by eight units in the last place, to see what that does to all that hangs on them."""

    def _angle(self, first: Any, second: Any) -> Any:
        return super()._angle(first, second) * (1.0 + 8.0 * EPS)


def numbers(value: Any) -> list[float]:
    return [value.real, value.imag] if isinstance(value, complex) else [value]


def packed(value: float) -> bytes:
    return b"" if value != value else struct.pack("d", value)


def rounded(program: Program) -> set[str]:
    """Return what hangs on an arc tangent, which JavaScript rounds in its own way."""
    angles = {step.name for step in program if step.verb == "angle"}
    own = [program.hanging.get(name, 0) for name in angles]
    return angles | {name for i, name in enumerate(program.names) if any(hanging >> i & 1 for hanging in own)}


@pytest.mark.parametrize(
    ("name", "count"),
    [
        *((name, 3) for name in LINKAGES[::3]),
        *(pytest.param(name, 45, id=name, marks=pytest.mark.soak) for name in LINKAGES),
    ],
)
def test_script_gives_the_numbers_and_statuses_of_the_exact_board(name: str, count: int) -> None:
    seen, scripts = set(), dict[Any, Any]()
    for program, givens in cases(name, count):
        key = program, frozenset(n for n in givens if givens[n] == 0.0)
        if key not in scripts:
            scripts[key] = quickjs.Context()
            scripts[key].eval(script_names() + script_of(program, givens, program.names))
        board, turned = run(program, givens), Turned(givens)
        turned.follow(program)

        code, *found = json.loads(scripts[key].eval(CALL.format(json.dumps(dict(givens)))))

        seen.add(board.status)
        assert STATUSES[int(code)] == board.status
        theirs = iter(map(float, found))
        for n in program.names:
            arc = n in rounded(program)
            for mine, beside in zip(numbers(board.values[n]), numbers(turned.values[n]), strict=True):
                other, allowed = next(theirs), 4 * EPS * abs(mine) + 2 * abs(beside - mine)
                assert packed(mine) == packed(other) or (arc and abs(mine - other) <= allowed), n
    assert "ok" in seen


# together they have every verb and every law; what is compiled takes seconds, as the first test below holds
COMPILED = (
    *("madi-four-bar", "scheme-01-compressor", "scheme-09-shaper", "scheme-15-lever-shears"),
    *("scheme-17-sewing-machine", "scheme-18-hydraulic-drive", "scheme-19-scotch-yoke", "scheme-20-press-automaton"),
)


def parts(names: Iterable[str]) -> set[tuple[str, str]]:
    """Return the verbs and laws of which the programs of some tasks are made."""
    return {(step.verb, step.law) for name in names for program, _ in cases(name, 3) for step in program}


@pytest.mark.soak
def test_every_verb_and_every_law_is_compiled() -> None:
    assert parts(LINKAGES) == parts(COMPILED)


@pytest.mark.soak
@pytest.mark.parametrize(("name", "count"), [(name, 360) for name in COMPILED])
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
        assert [*map(packed, ours)] == [packed(part) for value in results[n].tolist() for part in numbers(value)], n


def test_step_that_is_more_than_arithmetic_is_not_printed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(LAWS, "more", lambda value: np.sin(value) if np.ndim(value) else math.sin(value))
    program, turn = (Program((Step(*step),)) for step in (("calc", "z", ("x",), "more"), ("turn", "u", ("x",))))
    with pytest.raises(TypeError):
        script_of(program, {"x": 1.0}, ("z",))

    if "numba" in sys.modules:
        results, _ = batch(program, {"x": np.array([1.0, 2.0])}, ["z"], loop=True)
        assert results["z"].tolist() == np.sin([1.0, 2.0]).tolist()
    monkeypatch.setitem(sys.modules, "numba", None)
    with pytest.raises(InputError) as error:
        batch(turn, {"x": np.array([1.0])}, ["u"], loop=True)
    assert error.value.key == "fast-extra"


# The protractor.
def turned(angle: float) -> complex:
    board = ExactBoard({"phi": angle})
    board.step("turn", "e", "phi")
    direction: complex = board.values["e"]
    return direction


def angles(count: int) -> np.ndarray:
    """Angles of all kinds: over some turns, near zero, near marks, near right angles, and from far away."""
    random = np.random.default_rng(1024)
    near = 10.0 ** random.uniform(-15.0, -3.0, count) * random.choice([-1.0, 1.0], count)
    mark = math.tau / MARKS
    parts = [random.uniform(-7.0, 7.0, count), near, random.integers(-MARKS, MARKS, count) * mark + near]
    parts += [random.integers(-MARKS, MARKS, count) * mark + mark / 2 + near]
    return np.concatenate(
        [*parts, random.integers(-8, 8, count) * math.pi / 2 + near, random.uniform(-1e4, 1e4, count)]
    )


@pytest.mark.parametrize("count", [200, pytest.param(4_000, marks=pytest.mark.soak)])
def test_direction_of_any_angle_is_right_to_two_units_in_the_last_place(count: int) -> None:
    with mpmath.workdps(50):
        for angle in angles(count):
            direction, exact = turned(float(angle)), mpmath.expj(mpmath.mpf(float(angle)))
            for part, true in ((direction.real, exact.real), (direction.imag, exact.imag)):
                assert abs(part - true) <= 2.0 * math.ulp(true) + 1e-24 * abs(angle) or abs(true) <= 2.0**-50
        for angle in (2e6, -3e9, 1e15):  # of many turns: as right as it is known
            assert abs(turned(angle) - complex(mpmath.expj(mpmath.mpf(angle)))) <= math.ulp(angle)


def test_right_angles_are_exact_and_many_angles_equal_one_at_a_time() -> None:
    many = np.concatenate([angles(300), [0.0, -0.0, FARTHEST, 1.5 * FARTHEST, -1e15, 1e300, math.inf, math.nan]])
    board = ArrayBoard({"phi": many}, len(many))

    with np.errstate(invalid="ignore"):
        board.step("turn", "e", "phi")

    assert np.array_equal(board.values["e"], [turned(float(angle)) for angle in many], equal_nan=True)
    for angle in (math.inf, -math.inf, math.nan):
        assert math.isnan(turned(angle).real)
        assert math.isnan(turned(angle).imag)
    for quarters in range(-9, 10):
        angle = math.radians(90 * quarters)
        near = math.nextafter(angle, 9.0) if 0 <= quarters < 4 else angle  # off by its rounding
        assert turned(angle) == turned(near) == (1, 1j, -1, -1j)[quarters % 4]


def test_graduation_is_right_to_a_unit_in_the_last_place_and_symmetric() -> None:
    cosines, sines = graduation()

    with mpmath.workdps(50):
        for mark in range(MARKS):
            exact = mpmath.sinpi(mpmath.mpf(2 * mark) / MARKS)
            assert abs(sines[mark] - exact) <= math.ulp(exact)
    assert cosines == sines[MARKS // 4 :] + sines[: MARKS // 4]
    assert [cosines[mark] for mark in (0, 256, 512, 768)] == [1.0, 0.0, -1.0, 0.0]
