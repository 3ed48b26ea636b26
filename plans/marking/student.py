"""The board that takes some quantities from a student: what follows after them follows from what was said.

A magnitude keeps the direction and sense of the run unless the student gives one. Later steps start from quantities, so
it is quantities that are replaced, where they are defined. A mark moves only where it is asked for: where a reading is
wrong, the mark that was made last is where the student must have put it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from functools import lru_cache
from typing import Any

import numpy as np

from ..board import Program, Step
from ..boards.exact import NAN, ExactBoard
from ..laws import cross, dot
from ..names import role
from .answers import Said

ASIDE = 1e-9  # part of a vector that is rounding
LAID = ("lay", "back")
TAKEN = ("read", "calc", "distance", "measure", "arm")
Take = Callable[[str, Any], tuple[Said | None, bool]]


class StudentBoard(ExactBoard):
    """One position with a student's quantities; `follows` has for each what follows from those before it.

    `values` are the data, SI; with `made` all values of the construction, and only what hangs on the student is done
    again. `take` says for the name of a quantity and its value on this board what the student says and goes on with, or
    None, and whether the mark behind it moves. `steps` are those to do, all when left out, where others have been done
    on a board that this one comes `after`.
    """

    def __init__(
        self,
        program: Program,
        values: Mapping[str, Any],
        take: Take,
        made: bool = False,
        steps: Sequence[Step] | None = None,
    ) -> None:
        super().__init__({} if made else values)
        if made:
            self.values = {**values}
        self.follows: dict[str, Any] = {}
        self._program, self._take = program, take
        self._steps = program.steps if steps is None else steps
        self._operations: dict[tuple[str, str], Callable[..., Any]] = {}
        self._done = 0
        self._moved: set[str] | None = set() if made else None

    def operation(self, verb: str, law: str) -> Callable[..., Any]:
        """Return what computes a step; a student divides the length of a vector, however it is drawn."""
        return _turning if law == "turning" else super().operation(verb, law)

    def _direction(self, start: Any, end: Any, length: Any) -> Any:
        """Return the unit vector of a link, whose marks may be farther apart than a student has measured."""
        exact = super()._direction(start, end, length)
        size = abs(exact)
        return exact / size if size > ASIDE and abs(size - 1.0) > ASIDE else exact

    def after(self, other: StudentBoard, anew: Collection[str]) -> None:
        """Take over what another board has made, but for the names that are made `anew`."""
        if self._moved is None or other._moved is None:
            data = {n: x for n, x in self.values.items() if n in anew or n not in other.values}
            self.values = other.values | data
        else:
            self._moved = other._moved.difference(anew)
            self.values.update((name, other.values[name]) for name in self._moved)
        self.follows = other.follows.copy()
        for name in anew:
            self.follows.pop(name, None)

    def go_on(self, end: int | None = None) -> None:
        """Do the steps before the place `end` that are not done yet, all without it."""
        if end is not None and end <= self._done:
            return
        steps = self._steps[self._done : end]
        self._done += len(steps)
        moved = self._moved
        with np.errstate(all="ignore"):  # a student's numbers may be any
            self._do(steps, moved)

    def _do(self, steps: Iterable[Step], moved: set[str] | None) -> None:
        operations = self._operations
        for step in steps:
            verb, name, operands = step.verb, step.name, step.operands
            if moved is None or not moved.isdisjoint(operands):
                done = verb, step.law
                if done not in operations:
                    operations[done] = self.operation(*done)
                try:
                    self.perform(operations[done], name, operands)
                except (ZeroDivisionError, OverflowError):  # what a student says is zero
                    self.values[name] = NAN
                if moved is not None:
                    moved.add(name)
            if verb in LAID and role(operands[2]).hidden:
                self._lay_off(name, operands[0], role(operands[2]).shown)
            elif verb in TAKEN and not role(name).hidden:
                self._replace(verb, name, operands)

    def _put(self, name: str, value: Any) -> None:
        self.values[name] = value
        if self._moved is not None:
            self._moved.add(name)

    def _lay_off(self, name: str, start: str, quantity: str) -> None:
        """Lay off the student's segment in the place of ours: the part that is calculated, laid off, and read."""
        values = self.values
        vector = complex(values[name] - values[start])
        said, _ = self._take(quantity, vector)
        if said is not None:
            self.follows[quantity] = vector
            taken = said.taken(vector)
            self._put(name, values[start] + taken)
            turned = -1.0 if dot(taken, vector) < 0.0 else 1.0
            self._put(f"_{quantity}", math.copysign(abs(taken), values[f"_{quantity}"] * turned))

    def _replace(self, verb: str, name: str, operands: tuple[str, ...]) -> None:
        value = self.values[name]
        self.follows.setdefault(name, value)
        said, moves = self._take(name, value)
        if said is None:
            return
        taken = said.taken(value)
        self._put(name, taken)
        if verb == "arm":  # of the moment before it, which is not asked for
            moment, force = operands
            self._put(moment, taken * abs(self.values[force]) * (-1.0 if self.values[moment] < 0.0 else 1.0))
        elif verb == "read" and moves:
            self._move(operands[0], operands[1], taken)

    def _move(self, tail: str, tip: str, vector: complex) -> None:
        """Put the mark that was made last where the vector that was read says it is; a pole stays."""
        if made_last(self._program, tail, tip) == tip:
            self._put(tip, self.values[tail] + vector)
        else:
            self._put(tail, self.values[tip] - vector)


def made_last(program: Program, tail: str, tip: str) -> str:
    """Return which of two marks was made last."""
    places = program.places
    return tip if places.get(tip, -1) >= places.get(tail, -1) else tail


def shifted(step: Step, program: Program) -> str:
    """Return what else changes on the board where a student's quantity takes the place of what a step makes."""
    if step.verb == "read":
        return made_last(program, *step.operands)
    if step.verb in LAID:
        return step.operands[2] if role(step.operands[2]).hidden else ""
    return step.operands[0] if step.verb == "arm" else ""


def _turning(vector: complex, normal: complex, length: float) -> float:
    along, across = dot(vector, normal), cross(vector, normal)
    aside = abs(across) > ASIDE * abs(along)
    return float((math.copysign(abs(vector), along) if aside else along) / length)


@lru_cache(maxsize=64)
def settled(program: Program) -> Mapping[str, int]:
    """Return what `settled_in` does for a whole program; kept, for many answers are held against the same one."""
    return settled_in(program)


def settled_in(steps: Iterable[Step]) -> Mapping[str, int]:
    """Return for each quantity how many of the steps must be done until it is known what follows for it."""
    found: dict[str, int] = {}
    for place, step in enumerate(steps, start=1):
        if step.verb in LAID and role(step.operands[2]).hidden:
            found[role(step.operands[2]).shown] = place
        elif step.verb in TAKEN and not role(step.name).hidden:
            found[step.name] = place
    return found
