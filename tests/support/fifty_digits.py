"""What results of a construction are by differences with fifty digits: an independent route to slopes."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from mpmath import mp, mpf

from kulman.plans.board import Program
from kulman.plans.boards.precision import DIGITS, fifty_digits

STEP = mpf(10) ** -13  # part of a given, more than a right angle is rounded by; the error of a difference is its square


def differences(
    program: Program, givens: Mapping[str, Any], varied: Iterable[str], names: Iterable[str]
) -> dict[str, list[Any]]:
    """Return x dQ/dx of `names` for every given x of `varied`, by central differences with fifty digits."""
    slopes: dict[str, list[Any]] = {name: [] for name in names}
    with mp.workdps(DIGITS):
        exact = {name: mpf(value) for name, value in givens.items()}
        for given in varied:
            more, less = (
                fifty_digits(program, {**exact, given: exact[given] * factor}) for factor in (1 + STEP, 1 - STEP)
            )
            for name, found in slopes.items():
                found.append((more[name] - less[name]) / (2 * STEP))
    return slopes
