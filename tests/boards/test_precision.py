"""The same construction in other precisions: each misses fifty digits by its own rounding, and a batch by no more."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
import pytest
from mpmath import mp, mpc, mpf

from kulman import solve
from kulman.plans.boards.exact import run
from kulman.plans.boards.precision import batch_in, run_in
from kulman.plans.linkages.cycles.limits import swept
from kulman.plans.linkages.solved import SolvedLinkage
from kulman.plans.quantities import references, results

ROUNDING = {"single": 2.0**-23, "double": 2.0**-52, "extended": float(np.finfo(np.longdouble).eps)}
TASKS = ("nau-slider-crank", "scheme-11-slotter", "scheme-20-press-automaton")  # the last has a group of class III


def exactly(value: Any) -> Any:
    """Return a number of any precision as one of mpmath, without rounding."""

    def part(number: Any) -> Any:
        high = float(number)
        return mpf(high) + mpf(float(number - type(number)(high)))

    if isinstance(value, (mpf, mpc)):
        return value
    return mpc(part(np.real(value)), part(np.imag(value)))


def worst(solved: SolvedLinkage, values: Mapping[str, Any], right: Mapping[str, Any]) -> float:
    """Return the largest error of all quantities, in parts of the largest vectors beside them."""
    sizes = references(solved.program, solved.values)
    with mp.workdps(50):
        errors = [
            float(abs(exactly(values[step.name]) - right[step.name])) / sizes[step.name]
            for step in results(solved.program)
            if sizes[step.name] and solved.values[step.name] == solved.values[step.name]
        ]
    assert not any(map(math.isnan, errors))
    return max(errors)


@pytest.mark.parametrize("task", TASKS)
def test_each_precision_misses_fifty_digits_by_its_own_rounding(task: str) -> None:
    solved = solve(task).solved
    right = run_in(solved.program, solved.givens, "fifty")

    for precision, rounding in ROUNDING.items():
        missed = worst(solved, run_in(solved.program, solved.givens, precision), right)

        assert rounding / 100.0 < missed < 1e3 * rounding, precision


def test_double_precision_is_the_exact_board() -> None:
    solved = solve("nau-slider-crank").solved

    assert run_in(solved.program, solved.givens, "double") == run(solved.program, solved.givens).values


@pytest.mark.parametrize("precision", ["single", "double", "extended"])
@pytest.mark.parametrize("task", TASKS)
def test_a_batch_misses_fifty_digits_by_the_rounding_of_its_precision(task: str, precision: str) -> None:
    solved = solve(task).solved
    drive = swept(solved.mechanism, solved.givens)
    givens = drive.givens(solved.givens, np.full(3, drive.start))
    wanted = [step.name for step in results(solved.program)]

    found, codes = batch_in(solved.program, givens, wanted, precision, chunk=2)
    here = {name: float(np.ravel(value)[0]) for name, value in givens.items()}

    kinds = {np.dtype(np.result_type(array)).type for array in found.values()}
    assert kinds == {type(np.ones(1, kind)[0]) for kind in KINDS[precision]}
    assert not codes.any()
    assert all((array == array[0]).all() for array in found.values())
    rows = {name: array[0] for name, array in found.items()}
    assert worst(solved, rows, run_in(solved.program, here, "fifty")) < 1e3 * ROUNDING[precision]


KINDS = {
    "single": (np.float32, np.complex64),
    "double": (np.float64, np.complex128),
    "extended": (np.longdouble, np.clongdouble),
}


def test_a_position_that_fails_has_its_status_in_every_precision() -> None:
    solved = solve("nau-slider-crank").solved
    givens = {**solved.givens, "l_AB": np.array([solved.givens["l_AB"], 1e-3])}

    for precision in KINDS:
        found, codes = batch_in(solved.program, givens, ["V_A", "V_B"], precision)

        assert codes.tolist() == [0, 3]
        assert np.isnan(found["V_B"]).tolist() == [False, True]
        assert not np.isnan(found["V_A"]).any()
