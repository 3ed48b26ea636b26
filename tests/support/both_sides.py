"""Limits of quantities at a position: from both sides of it, with a hundred digits and on data that are exact."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from mpmath import mp, mpf

from kulman.plans.board import Program
from kulman.plans.boards.precision import FiftyDigits
from kulman.plans.linkages.solved import SolvedLinkage

DIGITS = 100
STEPS = (mpf(10) ** -18, mpf(10) ** -21)
CLOSE = 1e-7  # part of a value within which two are one: towards a limit of reach it comes as the root of the step
NOTHING = 1e-12  # SI, in mechanisms of about a metre, what vanishes
Exact = Mapping[str, Callable[[], Any]]


class NearBoard(FiftyDigits):
    """As many digits as one likes, without the thresholds of double precision: as near to a position as one likes."""

    parallel = folded = mpf(10) ** -60
    touching = mpf(10) ** -90
    corrections = 16

    def _upright(self, component: Any) -> Any:
        return component


@dataclass(frozen=True, slots=True)
class Limit:
    """What a quantity tends to from each side, None from a side on which the mechanism cannot be assembled."""

    below: complex | None
    above: complex | None
    unique: bool

    @property
    def value(self) -> complex | None:
        """The limit, None where there is none."""
        one = self.above if self.below is None else self.below
        return one if self.unique else None


def limits(solved: SolvedLinkage, along: str, exact: Exact) -> dict[str, Limit]:
    """Return the limits of all quantities, as `along` goes to its value in the solved position.

    Parameters
    ----------
    exact : mapping of str to callable
        Givens that are no decimal fractions, such as a right angle, with all digits.
    """
    with mp.workdps(DIGITS):
        givens = {name: mpf(repr(x)) if isinstance(x, float) else mpf(x) for name, x in solved.givens.items()}
        givens |= {name: number() for name, number in exact.items()}
        sides = [[_run(solved.program, {**givens, along: givens[along] + s * d}) for d in STEPS] for s in (-1, 1)]
    if all(values is None for side in sides for values in side):
        return {}
    names = [name for name in solved.quantities if name in solved.program.names]
    return {name: _limit(name, sides) for name in names}


def _run(program: Program, givens: Mapping[str, Any]) -> Mapping[str, Any] | None:
    board = NearBoard(givens)
    program.run(board)
    return None if board.trouble is not None else board.values


def _limit(name: str, sides: list[list[Mapping[str, Any] | None]]) -> Limit:
    found = [[complex(values[name]) for values in side if values is not None] for side in sides]
    every = [value for side in found for value in side]
    most = max(map(abs, every))
    spread = max(abs(value - every[0]) for value in every)
    unique = most <= NOTHING or spread <= CLOSE * most
    below, above = (side[-1] if side else None for side in found)
    return Limit(below, above, unique)
