"""Rules that can be broken: each a rewrite of the same construction, found to apply from its steps alone.

The mistakes have numbers, M01 to M125; the other modules here, a chapter each, hold their rules, `book` all of them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from ..board import POSITION, Program, Step
from ..hands.shaky import Paper
from ..names import role


@dataclass(frozen=True)
class Scene:
    """A construction in which a rule may be broken: its steps, data, right values, and the scales of its plans."""

    paper: Paper
    values: Mapping[str, Any]

    @property
    def program(self) -> Program:
        """The construction."""
        return self.paper.program

    @property
    def steps(self) -> Mapping[str, Step]:
        """The steps by the names they make."""
        return self.program.by_name

    def made_by(self, *verbs: str, plan: str = "") -> tuple[Step, ...]:
        """Return the steps of some verbs, on the plans of a kind."""
        return self.program.which(verbs, plan=plan)

    def calculated(self, law: str) -> tuple[Step, ...]:
        """Return the steps that calculate by a law."""
        return self.program.which(("calc",), law)

    def mu(self, plan: str) -> float:
        """Return the scale factor of a plan, SI per mm."""
        return float(self.paper.mus[plan])

    def is_given(self, name: str) -> bool:
        """Whether a name stands for data, other than nothing."""
        return name in self.paper.givens and bool(self.paper.givens[name])

    def along(self, direction: str) -> str:
        """Return the direction of a link, or of a guide, to which one is the normal; nothing for other directions."""
        made = self.steps.get(direction)
        return made.operands[0] if made is not None and made.verb == "normal" and made.plan == POSITION else ""

    @cached_property
    def pin(self) -> str:
        """The point of the driver: the first to have a velocity."""
        return next((role(s.name).of for s in self.made_by("lay", plan="velocity")), "")

    @cached_property
    def laid_off(self) -> frozenset[str]:
        """Vectors that are calculated and laid off; to read them back needs no scale."""
        steps = self.made_by("lay", "back")
        return frozenset(role(s.operands[2]).shown for s in steps if role(s.operands[2]).hidden)


Steps = Mapping[str, tuple[Step, ...]]  # in the place of those of the same names


@dataclass(frozen=True, slots=True)
class Change:
    """How a rule is broken at one place: other steps in the place of those of the same names, other data.

    `how` tells apart several ways to break one rule at one place.
    """

    at: str
    steps: Steps
    givens: Mapping[str, Any]
    how: str = ""

    @staticmethod
    def instead(step: Step, how: str = "", **changed: Any) -> Change:
        """Do one step otherwise: another verb, other operands, another law."""
        return Change(step.name, {step.name: (step.but(**changed),)}, {}, how)

    @staticmethod
    def with_other(step: Step, place: int, name: str, how: str = "") -> Change:
        """Do one step with another operand."""
        return Change(step.name, {step.name: (operand(step, place, name),)}, {}, how)

    @staticmethod
    def mirrored(step: Step, place: int, how: str = "") -> Change:
        """Do one step with the opposite of an operand."""
        right = step.operands[place]
        opposite = Step("calc", f"_other_{right}", (right,), "opposite")
        return Change(step.name, {step.name: (opposite, operand(step, place, opposite.name))}, {}, how)

    @staticmethod
    def opposed(step: Step, how: str = "") -> Change:
        """Make the opposite of what one step makes."""
        return Change(step.name, {step.name: reversed_(step)}, {}, how)

    @staticmethod
    def scaled(step: Step, factor: float, how: str = "") -> Change:
        """Make so many times what one step makes."""
        return Change(step.name, {step.name: times(step, factor)}, {constant(factor): factor}, how)

    @staticmethod
    def all_scaled(at: str, steps: Iterable[Step], factor: float, how: str = "") -> Change:
        """Make so many times what each of some steps makes."""
        return Change(at, {step.name: times(step, factor) for step in steps}, {constant(factor): factor}, how)

    @staticmethod
    def one_and_all_scaled(at: str, steps: Sequence[Step], factor: float) -> Iterator[Change]:
        """Make so many times what one of some steps makes, and what all of them make."""
        yield from (Change.scaled(step, factor) for step in steps)
        if len(steps) > 1:
            yield Change.all_scaled(at, steps, factor, "all")

    @staticmethod
    def each_and_all(changed: Steps, how: str = "", givens: Mapping[str, float] | None = None) -> Iterator[Change]:
        """Change each of some steps, and all of them."""
        for name, steps in changed.items():
            yield Change(name, {name: steps}, givens or {}, how)
        if len(changed) > 1:
            yield Change(next(iter(changed)), changed, givens or {}, f"{how}, all".lstrip(", "))


Rule = Callable[[Scene], Iterable[Change]]


@dataclass(frozen=True, slots=True)
class Mistake:
    """A mistake, and the rules that it breaks; where `by_scale` it hangs on the scale factors of the student."""

    id: str
    rules: tuple[Rule, ...] = ()
    by_scale: bool = False


@dataclass(frozen=True, eq=False)
class Broken:
    """A construction with a rule broken: the `paper` as it was before, the right one or broken already; the change."""

    mistake: str
    paper: Paper
    change: Change

    @property
    def at(self) -> str:
        """The step, the quantity or the given at which it is broken."""
        return self.change.at

    @property
    def how(self) -> str:
        """In which of several ways."""
        return self.change.how

    @property
    def place(self) -> tuple[str, str, str]:
        """What tells it apart from others of the same construction."""
        return self.mistake, self.at, self.how

    @cached_property
    def program(self) -> Program:
        """The construction with the rule broken: put together for the few that are looked at closely."""
        before, steps = self.paper.program, self.change.steps
        return Program(tuple(new for step in before for new in steps.get(step.name, (step,)))) if steps else before

    @cached_property
    def givens(self) -> Mapping[str, Any]:
        """The data with those that are other ones."""
        return {**self.paper.givens, **self.change.givens}


class Chapter(dict[str, Mistake]):
    """The mistakes of one module by their numbers."""

    def enter(self, id: str, by_scale: bool = False) -> Callable[[Rule], Rule]:
        """Enter the function that follows; several may break the rule of one mistake."""

        def entered(rule: Rule) -> Rule:
            self.add(Mistake(id, (rule,), by_scale))
            return rule

        return entered

    def add(self, mistake: Mistake) -> None:
        """Add a mistake, to another of its number if there is one: a drawing of another kind has rules of its own."""
        before = self.get(mistake.id, Mistake(mistake.id))
        by_scale = before.by_scale or mistake.by_scale
        self[mistake.id] = Mistake(mistake.id, before.rules + mistake.rules, by_scale)

    def each(self, id: str, law: str, *changes: Callable[[Step], Change]) -> None:
        """Enter a rule that is broken at each step of a law, in one way after the other."""
        self.enter(id)(lambda scene: (change(step) for step in scene.calculated(law) for change in changes))


def breaks(scene: Scene, mistake: Mistake) -> Iterator[Broken]:
    """Go through all ways in which the rules of one mistake can be broken here."""
    return (Broken(mistake.id, scene.paper, change) for rule in mistake.rules for change in rule(scene))


# Rewrites that many rules share.


def aside(name: str) -> str:
    """Return a name for what was right before it was spoilt."""
    return f"_right_{name}"


def constant(value: float) -> str:
    """Return the name of a number that a mistake brings in."""
    return f"_times_{value!r}"


def operand(step: Step, place: int, name: str) -> Step:
    """Return a step with another operand at a place."""
    return step.but(operands=(*step.operands[:place], name, *step.operands[place + 1 :]))


def with_operand(steps: Iterable[Step], place: int, name: str) -> dict[str, tuple[Step, ...]]:
    """Put another operand into each of some steps."""
    return {step.name: (operand(step, place, name),) for step in steps}


def after(step: Step, *more: Step) -> tuple[Step, ...]:
    """Return a step that makes what is `aside`, then others, of which the last one makes what it made."""
    return (step.but(name=aside(step.name)), *more)


def then(step: Step, law: str, *operands: str) -> tuple[Step, ...]:
    """Return a step that makes what is `aside`, and the law that makes of it what it made."""
    return after(step, Step("calc", step.name, operands, law))


def reversed_(step: Step) -> tuple[Step, ...]:
    """Return the steps that make the opposite of what one step makes."""
    return then(step, "opposite", aside(step.name))


def nothing(step: Step) -> tuple[Step, ...]:
    """Return the steps that make nothing of what one step makes."""
    return then(step, "along", "zero", aside(step.name))


def times(step: Step, factor: float) -> tuple[Step, ...]:
    """Return the steps that make so many times what one step makes."""
    return then(step, "along", constant(factor), aside(step.name))


def with_sign(step: Step, size: tuple[Step, ...], value: Any, how: str = "") -> Change:
    """Make the scalar of a step anew, its size by other steps (the last one makes it), with the sign of `value`."""
    sense = -1.0 if value < 0.0 else 1.0
    signed = Step("calc", step.name, (size[-1].name, constant(sense)), "signed")
    return Change(step.name, {step.name: (*size, signed)}, {constant(sense): sense}, how)


def length_of(vector: str) -> tuple[Step, ...]:
    """Return the steps that find the size of a vector; the last one makes it."""
    pole, tip = f"_aside_{vector}.0", f"_aside_{vector}.1"
    chain = Step("chain", tip, (pole, vector))
    return Step("pole", pole, ()), chain, Step("distance", f"_size_{vector}", (pole, tip))
