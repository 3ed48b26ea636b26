"""The same construction with fifty digits, and what its results are by differences: an independent route to slopes."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any

from mpmath import mp, mpc, mpf

from kulman.plans.board import Program
from kulman.plans.exact import NAN, ExactBoard

DIGITS = 50
STEP = mpf(10) ** -16  # part of a given; the error of a central difference is its square


class FiftyDigits(ExactBoard):
    """One position on numbers of mpmath, in whatever precision it works."""

    def perform(self, operate: Callable[..., Any], name: str, operands: tuple[str, ...]) -> None:
        self._name, self._operands = name, operands
        self.values[name] = operate(*[self.values[operand] for operand in operands])

    @staticmethod
    def _sqrt(square: Any) -> Any:
        return mp.sqrt(square) if square >= 0 else NAN

    @staticmethod
    def _complex(real: Any, imag: Any) -> Any:
        return mpc(real, imag)

    def _turn(self, angle: Any) -> Any:
        return mp.expj(angle)


def fifty_digits(program: Program, givens: Mapping[str, Any]) -> Mapping[str, Any]:
    """Run `program` with fifty digits."""
    with mp.workdps(DIGITS):
        board = FiftyDigits({name: mpf(value) for name, value in givens.items()})
        program.run(board)
        return board.values


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
