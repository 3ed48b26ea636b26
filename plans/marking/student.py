"""The board that takes some quantities from a student: what follows from them, and by how much it may be missed.

A magnitude keeps the direction and sense of the run unless the student gives one. Later steps start from quantities, so
it is quantities that are replaced, where they are defined. A mark moves only where it is asked for: where a reading is
wrong, the mark that was made last is where the student must have put it.

What is calculated is held against the student's own earlier numbers, each as it was written. Where one of them has not
been said, or is wrong by itself, what a hand may miss takes the place of its rounding. What is measured may miss what
the key allows, less where the student's own plan is smaller than the right one.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from functools import cached_property, lru_cache
from typing import Any

import numpy as np

from ..board import POINTS, POSITION, Program, Step
from ..boards.exact import NAN, ExactBoard
from ..laws import LAWS, cross, dot
from ..names import role
from .answers import Answer, Said
from .key import COARSER, MARKS, READ, ROUNDED, Key, inherited

THREE = 3  # digits that a number has at the least where nobody knows how it was written
LAYING = 0.6  # part of the tolerance in mm by which a segment that is laid off and read again may miss
READ_TO = 0.05  # part of the tolerance in mm to which a segment is read at best
MOST = 30  # numbers that anybody puts into a calculator; a law of more is a table or a curve
COARSEST = 0.1  # part of a value by which one digit may be rounded: 0.3 for 0.277 may, 1 for 1.333 is too coarse
FEWEST = 2  # vectors of a plan that tell how large the student's own is
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
        with np.errstate(all="ignore"):  # a student's numbers may be any
            for step in steps:
                if self._moved is None or not self._moved.isdisjoint(step.operands):
                    self._again(step)
                if step.verb in LAID and role(step.operands[2]).hidden:
                    self._lay_off(step.name, step.operands[0], role(step.operands[2]).shown)
                elif step.verb in TAKEN and not role(step.name).hidden:
                    self._replace(step)

    def _again(self, step: Step) -> None:
        done = step.verb, step.law
        if done not in self._operations:
            self._operations[done] = self.operation(*done)
        try:
            self.perform(self._operations[done], step.name, step.operands)
        except (ZeroDivisionError, OverflowError):  # what a student says is zero
            self.values[step.name] = NAN
        if self._moved is not None:
            self._moved.add(step.name)

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

    def _replace(self, step: Step) -> None:
        """Put what the student says in the place of what a step makes, and of what it was made of."""
        values, (verb, name, operands, _) = self.values, step
        value = values[name]
        self.follows.setdefault(name, value)
        said, moves = self._take(name, value)
        if said is None:
            return
        taken = said.taken(value)
        self._put(name, taken)
        if verb == "arm":  # of the moment before it, which is not asked for
            moment, force = operands
            self._put(moment, taken * abs(values[force]) * (-1.0 if values[moment] < 0.0 else 1.0))
        elif verb == "read" and moves:  # the mark that was made last is where the vector says it is; a pole stays
            tail, tip = operands
            last = _made_last(self._program, tail, tip)
            self._put(last, values[tail] + taken if last == tip else values[tip] - taken)


def _made_last(program: Program, tail: str, tip: str) -> str:
    """Return which of two marks was made last."""
    places = program.places
    return tip if places.get(tip, -1) >= places.get(tail, -1) else tail


def shifted(step: Step, program: Program) -> str:
    """Return what else changes on the board where a student's quantity takes the place of what a step makes."""
    if step.verb == "read":
        return _made_last(program, *step.operands)
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


def _half_digit(number: float) -> float:
    """Return half of the last digit of a number, which is taken to have three digits if it has fewer."""
    if not number or not math.isfinite(number):
        return 0.0
    digits, _, power = f"{abs(number):.11e}".partition("e")
    written = len(digits.replace(".", "").rstrip("0"))
    return 0.5 * 10.0 ** (int(power) + 1 - max(written, THREE))


class Allowance:
    """What the lines of one student may miss.

    `drawn` is the construction with all that the student says, done as far as the line that is asked for; an answer is
    `sure` whose value is known (written, or segment times a scale factor that is written), `faulty` what is wrong by
    itself.
    """

    def __init__(
        self,
        key: Key,
        answers: Mapping[str, Answer],
        drawn: StudentBoard,
        sure: Callable[[str], bool],
        faulty: Callable[[str], bool],
    ) -> None:
        self.key, self.answers, self.drawn, self.sure, self.faulty = key, answers, drawn, sure, faulty
        self._steps = key.paper.program.by_name
        self._arms = {step.operands[0]: step.name for step in key.paper.program.which(("arm",))}
        self._slacks: dict[str, float] = {}
        self._calculations: dict[str, Step | None] = {}
        self._inputs: dict[str, list[str]] = {}
        self._calculated: dict[str, float] = {}
        self.sized: set[str] = set()  # what was held against the size of its plan

    @cached_property
    def _settled(self) -> Mapping[str, int]:
        return settled(self.key.paper.program)

    def after(self, other: Allowance, anew: Collection[str]) -> None:
        """Take over what another one has found, but for the names that are made `anew`."""
        for found, before in (
            (self._slacks, other._slacks),
            (self._calculations, other._calculations),
            (self._inputs, other._inputs),
            (self._calculated, other._calculated),
        ):
            found |= {name: x for name, x in before.items() if name not in anew}  # type: ignore[assignment]

    def of(self, name: str, value: Any, right: bool = False) -> float:
        """Return by how much an answer may miss a value, SI.

        One that is `right` does not follow from the student's own numbers: who has gone on with it after a wrong one
        has measured it. Nor does one behind which nothing is said, where it is known how errors of drawing add up.
        """
        step = self.calculation(name)
        added_up = step is not None and name in self.key.limits and not self.inputs(step)
        if step is None or added_up or (right and any(map(self.faulty, self.inputs(step)))):
            return self.by_hand(name, value)
        answer = self.answers[name]
        coarsest = COARSEST * abs(value)
        last = _half_digit(answer.value or 0.0) if answer.rounded is None else min(answer.rounded, coarsest)
        # a calculator's result may differ by half a per cent, or by what all roundings come to
        return self._marked(name, float(max(ROUNDED * abs(value), last + self._inherited(name, step))))

    def follows(self, name: str) -> bool:
        """Whether a quantity is calculated from numbers of which none is wrong by itself."""
        step = self.calculation(name)
        return step is not None and not any(map(self.faulty, self.inputs(step)))

    def calculation(self, name: str) -> Step | None:
        """Return the step that calculates a quantity, before it is laid off or not; None for what is measured.

        That is also what has a limit of its own, and a segment whose scale factor has to be guessed.
        """
        if name not in self._calculations:
            step = self.key.questions[name].step
            if step.verb == "read":
                step = self._steps.get(f"_{name}", step)
            by_hand = step.verb != "calc" or name in self.key.firm or not self.sure(name)
            by_hand = by_hand or len(step.operands) > MOST or self._drawn(step)
            self._calculations[name] = None if by_hand else step
        return self._calculations[name]

    def _drawn(self, step: Step) -> bool:
        """Whether a law takes places of marks, which are measured however it goes on."""
        before = [self._steps[name] for name in step.operands if name in self._steps]
        return any(one.verb in POINTS or (one.verb in READ and one.name not in self.key.allowed) for one in before)

    def inputs(self, step: Step) -> list[str]:
        """Return the answers from which a step calculates."""
        if step.name in self._inputs:
            return self._inputs[step.name]
        found = self._inputs[step.name] = []
        seen, left = {step.name}, list(step.operands)
        while left:
            operand = left.pop()
            visible = role(operand).shown if role(operand).hidden else operand  # the size of a load is data
            if visible in self.answers:
                found.append(visible)
            elif operand not in seen and (before := self._steps.get(operand)) and before.verb in ("calc", "moment"):
                left += [*before.operands, self._arms.get(operand, operand)]
            seen.add(operand)
        return found

    def _inherited(self, name: str, step: Step) -> float:
        """Return by how much a result may differ because the numbers are rounded that it is calculated from."""
        if name not in self._calculated:
            with np.errstate(all="ignore"):  # a student's numbers may be any
                self._calculated[name] = self._through(step)
        return self._calculated[name]

    def _through(self, step: Step) -> float:
        operands = [self.drawn.values[operand] for operand in step.operands]
        try:
            return sum(inherited(step.law, operands, LAWS[step.law](*operands), map(self._slack, step.operands)))
        except (ZeroDivisionError, OverflowError):  # what a student says is zero
            return 0.0

    def _slack(self, name: str) -> float:
        """Return by how much an operand may differ from that with which the student has gone on."""
        if name not in self._slacks:
            self._slacks[name] = 0.0  # of a step that takes what it makes anew
            self._slacks[name] = self._slack_of(name)
        return self._slacks[name]

    def _slack_of(self, name: str) -> float:
        answer, step = self.answers.get(name), self._steps.get(name)
        if answer is not None and self.sure(name):
            return self._of_answer(name)
        laid = role(name).shown
        if step is None:
            return 0.0
        if laid in self.answers and laid != name and self.sure(laid):
            return self._between(laid)
        if step.verb == "calc":
            return self._through(step)
        if step.verb == "moment":
            return self._of_moment(step)
        if name in self.key.questions:
            return self.by_hand(name, self.drawn.values[name])
        return self._of_hand(step)

    def _of_hand(self, step: Step) -> float:
        """Return what hands miss by something that is not asked, at the student's own size."""
        name = step.name
        allowed, size, own = self.key.allowed.get(name, 0.0), abs(self.key.values[name]), abs(self.drawn.values[name])
        return allowed * (own / size if size and own > size and step.verb not in POINTS else 1.0)

    def _last(self, name: str) -> float:
        """Return half of the last digit of a number with which a student goes on, of few digits a part of it."""
        size, last = abs(self.drawn.values[name]), self.answers[name].rounded
        return _half_digit(size) if last is None else float(min(last, ROUNDED * size))

    def _of_answer(self, name: str) -> float:
        """Return by what a student's own number may differ: by its last digit, by what a segment can be read to.

        A vector that is too short for a hand to tell which way it points may also have the other sense.
        """
        question, size, last = self.key.questions[name], abs(self.drawn.values[name]), self._last(name)
        verb, plan = question.step.verb, question.plan
        if verb in (*READ, "arm"):
            last = max(last, READ_TO * self.key.tolerance.mm * float(self.key.paper.mus.get(plan, 0.0)))
        drawn = verb == "read" and f"_{name}" not in self._steps
        short = drawn and max(size, abs(self.key[name])) <= self.key.allowed[name]
        return last + (2.0 * float(size) if short else 0.0)

    def _between(self, laid: str) -> float:
        """Return how far a number that was calculated and the same one read again are apart."""
        follows = self.drawn.follows.get(laid)
        said = abs(self.drawn.values[laid])
        apart = 0.0 if follows is None or follows != follows or self.faulty(laid) else abs(abs(follows) - said)
        return self._last(laid) + float(apart)

    def _of_moment(self, step: Step) -> float:
        """Return what the moment of a force may miss: its arm as written, or else as hands measure it."""
        force, arm = step.operands[0], self._arms.get(step.name, "")
        size = abs(self.drawn.values[force])
        length = abs(self.drawn.values[step.name]) / size if size else 0.0
        if arm not in self.key.questions:
            return self._of_hand(step)
        missed = self._slack(arm)
        follows = abs(self.drawn.follows.get(arm, length))
        if follows <= self.key.allowed[arm]:
            missed += 2.0 * length  # on which side the force passes a hand cannot tell
        return float(size * missed + length * self._slack(force))

    def _marked(self, name: str, allowed: float) -> float:
        """Return what may be missed by a number that is laid off on paper, and read again."""
        question = self.key.questions[name]
        mm = self.key.tolerance.mm * float(self.key.paper.mus.get(question.plan, 0.0))
        if question.step.verb == "read":
            return math.hypot(allowed, LAYING * mm)
        return allowed if self.answers[name].value is not None else math.hypot(allowed, MARKS * mm)

    def by_hand(self, name: str, value: Any) -> float:
        """Return what a hand may miss at the size of a value."""
        question, size = self.key.questions[name], abs(self.key[name])
        alone = name in self.answers and self.answers[name].value is None
        allowed = self.key.on_paper(name) if alone else self.key.allowed[name]
        times = abs(value) / size if size else 1.0
        if times >= 1.0:
            return allowed * times
        self.sized.add(name)
        return allowed * max(times, min(1.0, COARSER * self._grown(name, question.plan)))

    def _grown(self, name: str, plan: str) -> float:
        """Return how many times larger the student's plan is than the right one, its longest vectors compared.

        They are those drawn until `name` is known, even if the plan is drawn farther already.
        """
        if plan == POSITION:
            return 1.0
        right, own, count, end = 0.0, 0.0, 0, self._settled[name]
        for vector in self.key.vectors.get(plan, ()):
            if vector in self.drawn.follows and self._settled[vector] <= end:
                value = self.drawn.values[vector]
                right, count = max(right, abs(self.key[vector])), count + 1
                own = max(own, abs(value) if value == value else 0.0)
        return own / right if right and count >= FEWEST else 1.0
