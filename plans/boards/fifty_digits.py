"""The same construction with fifty digits: beside it all rounding of double precision shows."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from ..board import Program
from .exact import NAN, PlainBoard

DIGITS = 50
CORRECTIONS = 12  # of a template: five reach 16 digits from where it lies about, seven more any number


class FiftyDigits(PlainBoard):
    """One position on numbers of mpmath, in whatever precision it works."""

    corrections = CORRECTIONS

    @staticmethod
    def _sqrt(square: Any) -> Any:
        from mpmath import mp

        return mp.sqrt(square) if square >= 0 else NAN

    @staticmethod
    def _complex(real: Any, imag: Any) -> Any:
        from mpmath import mpc

        return mpc(real, imag)

    def _turn(self, angle: Any) -> Any:
        from mpmath import mp

        if not math.isfinite(angle):
            return NAN
        direction = mp.expj(angle)
        return self._complex(self._upright(direction.real), self._upright(direction.imag))

    def _angle(self, first: Any, second: Any) -> Any:
        from mpmath import mp

        turned = second * first.conjugate()
        return mp.arg(turned)


def fifty_digits(program: Program, givens: Mapping[str, Any]) -> Mapping[str, Any]:
    """Run `program` with fifty digits for one position.

    Parameters
    ----------
    givens : mapping of str to float
        Values in SI, taken as exact; numbers of mpmath as well.

    Returns
    -------
    mapping of str to mpf or mpc
        Every name.
    """
    from mpmath import mp, mpf

    with mp.workdps(DIGITS):
        board = FiftyDigits({name: mpf(value) for name, value in givens.items()})
        program.run(board)
        return board.values
