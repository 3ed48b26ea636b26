"""Answers judged under one key after another: of each key that is like the first only what differs is judged anew.

A broken rule changes part of a construction, and what hangs on it. All other lines are as they were judged under the
right key, and so is everything that the student's numbers made on the way to them.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import replace
from functools import cached_property

from ..board import POSITION, Program, Step
from ..names import role
from .answers import Answer, Line, known
from .key import Key
from .student import LAID, shifted
from .verdicts import Marker, judge


class Judged:
    """The answers of one student, judged by a marker under a key that is drawn to the student's scales; and others."""

    def __init__(self, marker: Marker, lines: tuple[Line, ...]) -> None:
        self._marker, self._lines, self._key = marker, lines, marker.key
        self._program = marker.key.paper.program
        self._alone = bool(marker.guessed or marker.key.paper.unscaled)  # whose scale factors follow from the key
        if not self._alone:
            marker.drawn.go_on()

    @property
    def answers(self) -> list[Answer]:
        """What the student says."""
        return list(self._marker.answers.values())

    def by_value(self) -> Judged:
        """Return the answers by their values alone where these are written, without their millimetres."""
        said = [replace(one, mm=None) if known(one.value) else one for one in self.answers]
        marker = Marker(self._key, said)
        marker.settle_scales(redraw=False)
        if self._alone or marker.guessed or any(self._marker.mus[name] != mu for name, mu in marker.mus.items()):
            marker.guessed = True
            return Judged(marker, ())
        anew = self._anew(line.name for line in self._lines if line.verdict.faulty)  # the others fit by their values
        marker.begin(self._marker, anew, self._steps(self._program, anew))
        return Judged(marker, tuple(marker.lines(self._lines, anew)))

    def under(self, key: Key, first: str = "", faulty: Collection[str] = ()) -> tuple[Line, ...] | None:
        """Return what `judge` returns for another key: the right one with a rule broken.

        With `first` also None where no line that is `faulty` under the right key passes: others are not looked at then.
        """
        if self._alone:
            return judge(key, self.answers, first)
        anew = self._anew(self._different(key))
        steps = self._steps(key.paper.program, anew)
        unlikely = first and not self._marker.likely(first, key)
        if unlikely and self._marker.again(key, anew, self._behind(first, steps, key)).misses(first):
            return None
        marker = self._marker.again(key, anew, steps)
        if first:
            kept = (line for line in self._lines if line.name in faulty and line.name not in anew)
            asked = (name for name in marker.key.questions if name in faulty and name in anew)
            if marker.misses(first) or not (
                any(not line.verdict.faulty for line in kept) or any(map(marker.passes, asked))
            ):
                return None
        return tuple(marker.lines(self._lines, anew))

    def _steps(self, program: Program, anew: set[str]) -> tuple[Step, ...]:
        return tuple(step for step in program.steps if step.name in anew)

    def _different(self, key: Key) -> Iterator[str]:
        """Go through the names of data, values, tolerances and steps that differ, and what such steps shift."""
        before = self._key
        yield from (n for n, x in key.paper.givens.items() if before.paper.givens.get(n) is not x)
        yield from (n for n, x in key.values.items() if (y := before.values.get(n)) is not x and y != x)
        yield from (n for n in key.questions if key.allowed[n] != before.allowed[n])
        place = 0
        for step in key.paper.program.steps:
            at = self._places.get(id(step))
            if at is None:
                yield step.name
                yield from self._shifted(step, key.paper.program)
                yield from (name for name in step.operands if self._last.get(name, -1) >= place)
            else:
                place = at

    def _anew(self, names: Iterable[str]) -> set[str]:
        """Return names with all that may differ where they do."""
        found, hanging, steps = set(names), self._hanging, self._program.steps
        left, done = 0, 0
        for name in found:
            left |= hanging.get(name, 0)
        while left:
            place = left.bit_length() - 1
            name = steps[place].name
            found.add(name)
            done |= 1 << place
            left = (left | hanging[name]) & ~done
        return found

    @cached_property
    def _places(self) -> Mapping[int, int]:
        return {id(step): place for place, step in enumerate(self._program.steps)}

    def _shifted(self, step: Step, program: Program) -> tuple[str, ...]:
        """Return what a step may put elsewhere on the student's board, besides what it makes."""
        mark = shifted(step, program)
        asked = role(step.operands[2]).shown if step.verb in LAID else step.name
        return (mark,) if mark and (step.verb == "arm" or asked in self._marker.answers) else ()

    @cached_property
    def _shifts(self) -> tuple[tuple[str, ...], ...]:
        return tuple(self._shifted(step, self._program) for step in self._program.steps)

    @cached_property
    def _last(self) -> Mapping[str, int]:
        """Where a mark is shifted for the last time."""
        return {mark: place for place, marks in enumerate(self._shifts) for mark in marks}

    @cached_property
    def _hanging(self) -> Mapping[str, int]:
        """For each name the steps that are done anew where it differs, as a number whose bit i is the step at place i.

        Besides all that hang on it these are the makers of marks that are shifted with it, or later than it needs them:
        a board that has come to its end has them only where they were shifted to.
        """
        places, last, own = self._program.places, self._last, [0] * len(self._program.steps)
        users: dict[str, int] = {}
        sized = self._sized()
        for place, step in enumerate(self._program.steps):
            back = [*self._shifts[place], *(name for name in step.operands if last.get(name, -1) >= place)]
            own[place] |= 1 << place | sized.get(step.name, 0)
            for name in back:
                own[place] |= 1 << places[name] if name in places else 0
            laid = role(step.operands[2]) if step.verb in LAID else None
            if laid is not None and laid.hidden and laid.shown in places:
                own[places[laid.shown]] |= 1 << place  # what is read is what is laid off
            for name in step.operands:
                users[name] = users.get(name, 0) | 1 << place
        return users | {s.name: own[place] | users.get(s.name, 0) for place, s in enumerate(self._program.steps)}

    def _sized(self) -> Mapping[str, int]:
        """Return for each name the lines that were judged by how large or to which scale its plan is drawn."""
        places, questions = self._program.places, self._key.questions
        faulty: dict[str, int] = {}
        larger: dict[str, int] = {}
        for line in self._lines:
            if line.verdict.faulty:
                faulty[line.plan] = faulty.get(line.plan, 0) | 1 << places[line.name]
        found = {}
        for name in reversed([*questions]):
            plan = questions[name].plan
            if name in self._marker.allowance.sized and plan != POSITION:
                larger[plan] = larger.get(plan, 0) | 1 << places[name]
            found[name] = faulty.get(plan, 0) | (larger.get(plan, 0) if questions[name].vector else 0)
        return found

    def _behind(self, first: str, steps: tuple[Step, ...], key: Key) -> tuple[Step, ...]:
        """Return those of some steps that may change the verdict of a line."""
        need, plans, kept = {first}, set[str](), []
        for step in reversed(steps):
            question = key.questions.get(step.name)
            like = question is not None and question.vector and question.plan in plans  # tells how large the plan is
            if step.name in need or like or not need.isdisjoint(self._shifted(step, key.paper.program)):
                need.add(step.name)
                need.update(step.operands, question.step.operands if question else ())
                need.add(f"_{step.name}")  # what is calculated, though a broken rule may not lay it off
                kept.append(step)
                if question is not None and question.plan != POSITION:
                    plans.add(question.plan)
        return tuple(reversed(kept))
