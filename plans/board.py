"""The board: the verbs of ruler, compass and set square, each one step on names.

A construction speaks to a board in verbs whose operands are names of marks, directions and quantities. Every verb goes
through one funnel, `step`, so that a board of another kind (recording, exact, with a shaky hand, with a student's
values, with one rule broken, tracing) is one class with one method.

A name with a dot, `velocity.B`, is a mark of that plan; a name that begins with an underscore is an intermediate value;
marks of the mechanism itself are bare letters. What a name is, whose and about what, is its role: see `names`.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cache, cached_property, wraps
from operator import itemgetter
from typing import Any, NamedTuple, TypeVar, cast

from ..scales.errors import InputError
from .names import POSITION, Name, role

__all__ = ["POSITION", "Board", "Program", "RecordingBoard", "Step", "recorded", "with_needs"]
Made = TypeVar("Made")
Verb = TypeVar("Verb", bound=Callable[..., None])


class _Fields(NamedTuple):
    verb: str
    name: str
    operands: tuple[str, ...]
    law: str


class Step(_Fields):
    """One step of a construction: what is done, the name it makes, the names it needs, and the law of a calculation."""

    __slots__ = ()

    def __new__(cls, verb: str, name: str, operands: Iterable[str], law: str = "") -> Step:
        """Note a step; names without a role have that of their letters."""
        return tuple.__new__(cls, (verb, role(name), tuple(map(role, operands)), law))

    def but(self, **changed: Any) -> Step:
        """Return the step with another verb, name, operands or law."""
        return Step(**{**self._asdict(), **changed})

    @property
    def plan(self) -> Name:
        """The plan on which the step draws: that of the mark it makes, or of the mark it reads from."""
        return role(self.operands[0] if self.verb == "read" else self.name).plan


def _verb(signature: Verb) -> Verb:
    """Return a verb: one step of its name, with the operands that its signature has."""
    verb = signature.__name__

    def step(board: Board, name: str, *operands: str) -> None:
        board.step(verb, name, *operands)

    return cast(Verb, wraps(signature)(step))


POINTS: list[str] = []  # verbs that mark points
LINES: list[str] = []  # verbs that give directions


def _point(signature: Verb) -> Verb:
    """Return a verb that marks a point."""
    POINTS.append(signature.__name__)
    return _verb(signature)


def _line(signature: Verb) -> Verb:
    """Return a verb that gives a direction."""
    LINES.append(signature.__name__)
    return _verb(signature)


class Board:
    """Verbs for constructions; a kind of board says what a step does."""

    def step(self, verb: str, name: str, *operands: str, law: str = "") -> None:
        """Do one step: make `name` from `operands`."""
        raise NotImplementedError

    @_point
    def place(self, name: str, x: str, y: str) -> None:
        """Mark the point with the coordinates `x`, `y`."""

    @_verb
    def pole(self, name: str) -> None:
        """Choose the pole of a plan: its origin."""

    @_line
    def turn(self, name: str, angle: str) -> None:
        """Lay off `angle` with the protractor: the unit direction at that angle."""

    @_line
    def direction(self, name: str, start: str, end: str, length: str) -> None:
        """Take the unit direction from `start` to `end`, which are `length` apart."""

    @_line
    def normal(self, name: str, vector: str) -> None:
        """Turn a direction or a vector by +90 degrees with the set square."""

    @_point
    def lay(self, name: str, start: str, direction: str, length: str) -> None:
        """Lay off `length` (signed) from `start` along the unit `direction`."""

    @_point
    def back(self, name: str, start: str, direction: str, length: str) -> None:
        """Lay off `length` (signed) from `start` against the unit `direction`."""

    @_verb
    def chain(self, name: str, start: str, vector: str) -> None:
        """Hang `vector` on `start`: tip to tail."""

    @_point
    def meet(self, name: str, p: str, u: str, q: str, w: str) -> None:
        """Mark where the line through `p` along `u` meets the line through `q` along `w` (unit directions)."""

    @_point
    def arc(self, name: str, centre: str, radius: str, q: str, w: str, side: str) -> None:
        """Mark where the arc about `centre` crosses the line through `q` along `w`, on the side +1 or -1 of the two."""

    @_point
    def arcs(self, name: str, first: str, radius: str, second: str, other: str, side: str) -> None:
        """Mark where arcs about `first` and `second` cross, to the left (+1) or right (-1) of the way between them."""

    @_line
    def tangent(self, name: str, centre: str, point: str, offset: str, side: str, size: str) -> None:
        """Take the unit direction of a line through `point` at `offset` to the left of `centre`.

        There are two; `side` says whether the line runs from the foot of the normal towards `point` (+1) or back (-1).
        `size` is that of the whole drawing: two marks that are close together beside it settle no direction.
        """

    @_point
    def template(self, name: str, point: str, *where: str) -> None:
        """Lay a template of a link on the paths of its three joints and mark `point` through it.

        `where` are the operands of `template.lay`: where it lies already, about, and the paths.
        """

    @_line
    def incline(self, name: str, direction: str, slope: str) -> None:
        """Lay off with the protractor, from `direction`, the angle of the unit direction `slope` of another drawing."""

    @_line
    def decline(self, name: str, direction: str, slope: str) -> None:
        """Lay off the angle of `slope` the other way: the result makes that angle with `direction`."""

    @_verb
    def measure(self, name: str, start: str, end: str) -> None:
        """Measure the distance of two marks."""

    @_verb
    def distance(self, name: str, start: str, end: str) -> None:
        """Measure a distance as a result: marks may coincide."""

    @_verb
    def angle(self, name: str, first: str, second: str) -> None:
        """Read with the protractor the angle from one unit direction to another, -180 to 180 degrees."""

    @_point
    def similar(self, name: str, start: str, end: str, along: str, across: str) -> None:
        """Mark the third point of a figure on start-end similar to the link: parts of it along and to the left."""

    @_point
    def divide(self, name: str, start: str, end: str, part: str, whole: str) -> None:
        """Divide start-end in the ratio part : whole, counted from `start` (theorem of similarity on a line)."""

    @_point
    def same(self, name: str, mark: str) -> None:
        """Give a mark another letter: a point of a link that does not turn moves like this one."""

    @_verb
    def read(self, name: str, tail: str, tip: str) -> None:
        """Read a vector off the plan: the quantity `name` from `tail` to `tip`."""

    def moment(self, name: str, arm: str, force: str, at: str, about: str) -> None:
        """Take the moment of `force`, applied at `at`, about `about`; the arm is measured on the drawing."""
        self.step("moment", name, force, at, about)
        self.step("arm", arm, name, force)

    def calc(self, name: str, law: str, *names: str) -> None:
        """Calculate `name` by a law of `laws.py`."""
        self.step("calc", name, *names, law=law)


class _Names(dict[str, Name]):
    """Names by their letters: with the role that they were made with, else with that of their letters."""

    __missing__ = staticmethod(role)


class RecordingBoard(Board):
    """A board that notes the steps, each once, and computes nothing."""

    def __init__(self) -> None:
        self._steps: dict[str, Step] = {}
        self._names = _Names()
        self._named = self._names.__getitem__

    @property
    def steps(self) -> tuple[Step, ...]:
        """The steps in order."""
        return tuple(self._steps.values())

    def step(self, verb: str, name: str, *operands: str, law: str = "") -> None:
        """Note the step, once where two dyads need it.

        Raises InputError: when a name is made in two ways, such as two points with one letter.
        """
        own = name if type(name) is Name else role(name)
        step = tuple.__new__(Step, (verb, own, tuple(map(self._named, operands)), law))
        made = self._steps.setdefault(name, step)
        if made is step:
            self._names[name] = own
        elif made != step:
            raise InputError("name-twice", name=own.shown)


# a step for a board that does many: name, operands, what is done, and what takes several operands out of the values
Prepared = tuple[str, tuple[str, ...], tuple[str, str], Callable[[Mapping[str, Any]], Any] | None]


def prepared(step: Step) -> Prepared:
    """Return a step prepared for a board."""
    verb, name, operands, law = step
    return name, operands, (verb, law), itemgetter(*operands) if len(operands) > 1 else None


@dataclass(frozen=True)
class Program:
    """A construction as it was recorded: straight steps on names, in order; what is looked up in it is kept."""

    steps: tuple[Step, ...]

    def __hash__(self) -> int:
        """Return the hash of the steps, computed once: tables of what a program says are looked up by it."""
        return self._hash

    def __iter__(self) -> Iterator[Step]:
        """Go through the steps in order."""
        return iter(self.steps)

    @cached_property
    def _hash(self) -> int:
        return hash(self.steps)

    @cached_property
    def prepared(self) -> tuple[Prepared, ...]:
        """The steps, prepared for a board that does them one after the other."""
        return tuple(map(prepared, self.steps))

    @cached_property
    def names(self) -> tuple[str, ...]:
        """All names that the steps make, in order."""
        return tuple(step.name for step in self.steps)

    @cached_property
    def by_name(self) -> Mapping[str, Step]:
        """The steps by the names that they make."""
        return {step.name: step for step in self.steps}

    @cached_property
    def places(self) -> Mapping[str, int]:
        """Where in the order the step stands that makes a name."""
        return {step.name: place for place, step in enumerate(self.steps)}

    @cached_property
    def hanging(self) -> Mapping[str, int]:
        """For each name that a step needs all steps that hang on it, as a number whose bit i is the step at place i."""
        found: dict[str, int] = {}
        for place in range(len(self.steps) - 1, -1, -1):
            step = self.steps[place]
            own = 1 << place | found.get(step.name, 0)
            for name in step.operands:
                found[name] = found.get(name, 0) | own
        return found

    def at(self, bits: int) -> tuple[Prepared, ...]:
        """Return the steps that are set in a number of `hanging`, in order; kept, for the same ones come again."""
        return self.once(bits, lambda: tuple(one for place, one in enumerate(self.prepared) if bits >> place & 1))

    def which(self, verbs: tuple[str, ...], law: str = "", plan: str = "") -> tuple[Step, ...]:
        """Return the steps of some verbs, of one law if it is named, on the plans of a kind; kept, too."""
        steps = (s for s in self.steps if s.verb in verbs and law in ("", s.law))
        return self.once((verbs, law, plan), lambda: tuple(s for s in steps if plan in ("", s.plan.kind, s.plan)))

    def counting(self, counts: Callable[[Step, str], bool]) -> tuple[tuple[str, tuple[str, ...]], ...]:
        """Return what each step makes, with those of its operands that count; kept."""
        return self.once(
            counts, lambda: tuple((s.name, tuple(x for x in s.operands if counts(s, x))) for s in self.steps)
        )

    def once(self, key: Hashable, make: Callable[[], Made]) -> Made:
        """Return what `make` makes, or what is kept under its key."""
        if key not in self._kept:
            self._kept[key] = make()
        made: Made = self._kept[key]
        return made

    @cached_property
    def _kept(self) -> dict[Hashable, Any]:
        return {}

    @property
    def needs(self) -> frozenset[str]:
        """All names that the steps need and none of them makes."""
        return frozenset(name for step in self.steps for name in step.operands).difference(self.names)

    @cached_property
    def plans(self) -> tuple[str, ...]:
        """The plans that are drawn, in order."""
        return tuple(dict.fromkeys(step.plan for step in self.steps if step.verb != "calc"))

    @cached_property
    def _by_plan(self) -> Mapping[str, tuple[Step, ...]]:
        by_plan: dict[str, list[Step]] = {}
        for step in self.steps:
            by_plan.setdefault(step.plan, []).append(step)
        return {plan: tuple(steps) for plan, steps in by_plan.items()}

    def on(self, plan: str) -> tuple[Step, ...]:
        """Return the steps drawn on `plan`."""
        return self._by_plan.get(plan, ())

    def needed_for(self, wanted: Iterable[str]) -> Program:
        """Keep only the steps that `wanted` needs."""
        needed, kept = set(wanted), []
        for step in reversed(self.steps):
            if step.name in needed:
                needed.update(step.operands)
                kept.append(step)
        return Program(tuple(reversed(kept)))

    def run(self, board: Board) -> None:
        """Do every step again on `board`."""
        step = board.step
        for s in self.steps:
            step(s.verb, s.name, *s.operands, law=s.law)


@cache
def recorded(*parts: Callable[[Board], None]) -> Program:
    """Return the construction of some parts, functions of modules, in order: recorded once and kept."""
    board = RecordingBoard()
    for part in parts:
        part(board)
    return Program(board.steps)


def with_needs(plans: Iterable[str], known: Mapping[str, Iterable[str]]) -> tuple[str, ...]:
    """Return `plans` and all that they need, in order of construction.

    `known` are all plans in that order, each with those it needs.
    """
    wanted = set(plans)
    for plan in reversed(tuple(known)):
        if plan in wanted:
            wanted.update(known[plan])
    return tuple(plan for plan in known if plan in wanted)
