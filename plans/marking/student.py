"""The board that takes some quantities from a student: what follows after them follows from what was said.

A magnitude keeps the direction and sense of the run unless the student gives one. Later steps start from quantities, so
it is quantities that are replaced, where they are defined. A mark moves only where it is asked for: where a reading is
wrong, the mark that was made last is where the student must have put it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from ..board import Program
from ..boards.exact import NAN, ExactBoard
from .answers import Said

LAID = ("lay", "back")
TAKEN = ("read", "calc", "distance", "measure", "arm")
Take = Callable[[str, Any], tuple[Said | None, bool]]


class StudentBoard(ExactBoard):
    """One position with a student's quantities; `follows` has for each what follows from those before it.

    Parameters
    ----------
    givens : mapping
        The data, SI.
    take : callable
        For the name of a quantity and its value on this board: what the student says and goes on with, or None, and
        whether the mark behind it moves.
    """

    def __init__(self, givens: Mapping[str, Any], take: Take) -> None:
        super().__init__(givens)
        self.follows: dict[str, Any] = {}
        self._take = take
        self._order: dict[str, int] = {}

    def step(self, verb: str, name: str, *operands: str, law: str = "") -> None:
        """Do the step; go on with what the student says of its quantity."""
        super().step(verb, name, *operands, law=law)
        self._order[name] = len(self._order)
        if verb in LAID and operands[2].startswith("_"):
            self._lay_off(name, operands[0], operands[2][1:])
        elif verb in TAKEN and not name.startswith("_"):
            self._replace(verb, name, operands)

    def perform(self, operate: Callable[..., Any], name: str, operands: tuple[str, ...]) -> None:
        """Make `name`; a division by what a student says is zero gives nothing."""
        try:
            super().perform(operate, name, operands)
        except (ZeroDivisionError, OverflowError):
            self.values[name] = NAN

    def _lay_off(self, name: str, start: str, quantity: str) -> None:
        """Lay off the student's segment in the place of ours: the part that is calculated, laid off, and read."""
        values = self.values
        vector = complex(values[name] - values[start])
        said, _ = self._take(quantity, vector)
        if said is not None:
            self.follows[quantity] = vector
            values[name] = values[start] + said.taken(vector)

    def _replace(self, verb: str, name: str, operands: tuple[str, ...]) -> None:
        value = self.values[name]
        self.follows.setdefault(name, value)
        said, moves = self._take(name, value)
        if said is None:
            return
        self.values[name] = taken = said.taken(value)
        if verb == "arm":  # of the moment before it, which is not asked for
            moment, force = operands
            self.values[moment] = taken * abs(self.values[force]) * (-1.0 if self.values[moment] < 0.0 else 1.0)
        elif verb == "read" and moves:
            self._move(operands[0], operands[1], taken)

    def _move(self, tail: str, tip: str, vector: complex) -> None:
        """Put the mark that was made last where the vector that was read says it is; a pole stays."""
        if self._order.get(tip, -1) >= self._order.get(tail, -1):
            self.values[tip] = self.values[tail] + vector
        else:
            self.values[tail] = self.values[tip] - vector


def follow(program: Program, givens: Mapping[str, Any], take: Take) -> dict[str, Any]:
    """Run a construction with what a student says; return for each quantity what follows from those before it."""
    board = StudentBoard(givens, take)
    program.run(board)
    return board.follows
