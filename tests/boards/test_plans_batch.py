"""Many positions at once: the same bits as one at a time, whatever the chunk, the memory and the names wanted."""

from __future__ import annotations

import subprocess
import sys
from typing import Any

import numpy as np
import pytest

from kulman.plans.boards.batch import batch
from kulman.plans.boards.exact import STATUSES, run
from kulman.plans.linkages.solved import board_givens
from kulman.tests.support.mechanisms import SEED, Solved, general_slider_crank, one_of, random_slider_cranks, solved


def test_many_at_once_equal_one_at_a_time_to_the_last_bit(cranks: Solved) -> None:
    names = [name for name in cranks.program.names if name in cranks.results]

    for index in range(len(cranks.codes)):
        board = run(cranks.program, board_givens(cranks.mechanism, one_of(cranks.values, index)))

        different = [name for name in names if bits(board.values[name]) != bits(cranks.results[name][index])]
        assert (index, different) == (index, [])
        assert board.status == STATUSES[cranks.codes[index]]


def bits(value: Any) -> bytes:
    return np.asarray(value).tobytes()


@pytest.mark.parametrize("chunk", [1, 7, 499, 500, 8192])
def test_size_of_a_chunk_changes_no_bit(chunk: int) -> None:
    values = board_givens(general_slider_crank(), random_slider_cranks(SEED, 500))
    mechanisms = solved(general_slider_crank(), random_slider_cranks(SEED, 500))

    results, codes = batch(mechanisms.program, values, ["a_B", "R_12", "M_bal", "M_bal_lever"], chunk)

    assert np.array_equal(codes, mechanisms.codes)
    assert all(bits(array) == bits(mechanisms[name]) for name, array in results.items())


def test_batch_keeps_only_what_is_wanted_and_its_bits() -> None:
    mechanisms = solved(general_slider_crank(), random_slider_cranks(SEED, 500))
    values = board_givens(general_slider_crank(), mechanisms.values)

    for name in mechanisms.program.names:
        results, _ = batch(mechanisms.program, values, [name])
        assert list(results) == [name]
        assert bits(results[name]) == bits(mechanisms[name])


def test_values_with_gaps_in_memory_change_no_bit() -> None:
    mechanisms = solved(general_slider_crank(), random_slider_cranks(SEED, 500))
    spread = {name: np.repeat(array, 3)[::3] for name, array in mechanisms.values.items()}

    results, _ = batch(mechanisms.program, board_givens(general_slider_crank(), spread), mechanisms.program.names)

    assert all(bits(array) == bits(mechanisms[name]) for name, array in results.items())


def test_what_goes_into_a_batch_comes_out_untouched() -> None:
    values = random_slider_cranks(SEED, 500)
    before = {name: array.copy() for name, array in values.items()}

    solved(general_slider_crank(), values)

    assert all(bits(values[name]) == bits(before[name]) for name in values)


def test_any_one_given_may_vary_while_the_others_stay() -> None:
    mechanism, values = general_slider_crank(), random_slider_cranks(SEED, 1)
    fixed = one_of(values, 0)
    program = solved(mechanism, values).program
    names = [name for name in program.names if not name.startswith("_")]

    for given in values:
        varied = np.array([fixed[given], fixed[given] * (1 + 1e-4), fixed[given]])
        results, codes = batch(program, board_givens(mechanism, {**fixed, given: varied}), names)

        for index, value in enumerate(varied):
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
