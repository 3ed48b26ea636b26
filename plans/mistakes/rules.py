"""Rules that can be broken: each a rewrite of the same construction, found to apply from its steps alone.

The mistakes have numbers, M01 to M125; the other modules here, a chapter each, hold their rules, `book` all of them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
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

    def made_by(self, *verbs: str, law: str = "", plan: str = "") -> Iterator[Step]:
        """Go through the steps of some verbs, of one law, on the plans whose names begin so."""
        return iter(self.program.which(verbs, law, plan))

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


Rule = Callable[[Scene], Iterable[Change]]


@dataclass(frozen=True, slots=True)
class Mistake:
    """A mistake; where `by_scale` it hangs on the scale factors that the student has chosen."""

    id: str
    breaks: Rule
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

    @cached_property
    def program(self) -> Program:
        """The construction with the rule broken: put together for the few that are looked at closely."""
        before, steps = self.paper.program, self.change.steps
        return Program(tuple(new for step in before for new in steps.get(step.name, (step,)))) if steps else before

    @cached_property
    def givens(self) -> Mapping[str, Any]:
        """The data with those that are other ones."""
        return {**self.paper.givens, **self.change.givens}

    @property
    def place(self) -> tuple[str, str, str]:
        """What tells it apart from others of the same construction."""
        return self.mistake, self.at, self.how


class Chapter(dict[str, Mistake]):
    """The mistakes of one module by their numbers."""

    def enter(self, id: str, by_scale: bool = False) -> Callable[[Rule], Rule]:
        """Enter the function that follows; several may break the rule of one mistake."""

        def entered(rule: Rule) -> Rule:
            self.add(Mistake(id, rule, by_scale))
            return rule

        return entered

    def add(self, mistake: Mistake) -> None:
        """Add a mistake, to another of its number if there is one."""
        before = self.get(mistake.id)
        if before is not None:
            mistake = Mistake(mistake.id, _both(before.breaks, mistake.breaks), before.by_scale or mistake.by_scale)
        self[mistake.id] = mistake


def put_together(chapters: Iterable[Chapter]) -> Chapter:
    """Return the mistakes of all chapters: one that is made on drawings of several kinds has rules in several."""
    found = Chapter()
    for chapter in chapters:
        for mistake in chapter.values():
            found.add(mistake)
    return found


def _both(first: Rule, second: Rule) -> Rule:
    def rule(scene: Scene) -> Iterator[Change]:
        yield from first(scene)
        yield from second(scene)

    return rule


def breaks(scene: Scene, mistake: Mistake) -> Iterator[Broken]:
    """Go through all ways in which the rule of one mistake can be broken here."""
    return (Broken(mistake.id, scene.paper, change) for change in mistake.breaks(scene))


# Rewrites that many rules share.


def aside(name: str) -> str:
    """Return a name for what was right before it was spoilt."""
    return f"_right_{name}"


def constant(value: float) -> str:
    """Return the name of a number that a mistake brings in."""
    return f"_times_{value!r}"


def instead(step: Step, how: str = "", **changed: Any) -> Change:
    """Do one step otherwise: another verb, other operands, another law."""
    return Change(step.name, {step.name: (replace(step, **changed),)}, {}, how)


def operand(step: Step, place: int, name: str) -> tuple[str, ...]:
    """Return the operands of a step with another one at a place."""
    return (*step.operands[:place], name, *step.operands[place + 1 :])


def with_operand(steps: Iterable[Step], place: int, name: str) -> dict[str, tuple[Step, ...]]:
    """Put another operand into each of some steps."""
    return {step.name: (replace(step, operands=operand(step, place, name)),) for step in steps}


def each_and_all(changed: Steps, how: str = "", givens: Mapping[str, float] | None = None) -> Iterator[Change]:
    """Change each of some steps, and all of them."""
    for name, steps in changed.items():
        yield Change(name, {name: steps}, givens or {}, how)
    if len(changed) > 1:
        yield Change(next(iter(changed)), changed, givens or {}, f"{how}, all".lstrip(", "))


def reversed_(step: Step) -> tuple[Step, ...]:
    """Return the steps that make the opposite of what one step makes."""
    right = aside(step.name)
    return replace(step, name=right), Step("calc", step.name, (right,), "opposite")


def times(step: Step, factor: float) -> tuple[tuple[Step, ...], dict[str, float]]:
    """Return the steps that make so many times what one step makes, and the data they need."""
    right, name = aside(step.name), constant(factor)
    return (replace(step, name=right), Step("calc", step.name, (name, right), "along")), {name: factor}


def scaled(step: Step, factor: float, how: str = "") -> Change:
    """Make so many times what one step makes."""
    steps, givens = times(step, factor)
    return Change(step.name, {step.name: steps}, givens, how)


def all_scaled(at: str, steps: Iterator[Step] | list[Step], factor: float, how: str = "") -> Change:
    """Make so many times what each of some steps makes."""
    found = [(step.name, times(step, factor)) for step in steps]
    return Change(at, {name: new for name, (new, _) in found}, {constant(factor): factor}, how)


def opposed(step: Step, how: str = "") -> Change:
    """Make the opposite of what one step makes."""
    return Change(step.name, {step.name: reversed_(step)}, {}, how)


def nothing(step: Step) -> tuple[Step, ...]:
    """Return the steps that make nothing of what one step makes."""
    right = aside(step.name)
    return replace(step, name=right), Step("calc", step.name, ("zero", right), "along")


def mirrored(step: Step, place: int, how: str = "") -> Change:
    """Do one step with the opposite of an operand."""
    right = step.operands[place]
    other = f"_other_{right}"
    turned = replace(step, operands=operand(step, place, other))
    return Change(step.name, {step.name: (Step("calc", other, (right,), "opposite"), turned)}, {}, how)


def with_sign(step: Step, size: tuple[Step, ...], value: Any, how: str = "") -> Change:
    """Make the scalar of a step anew, its size by other steps (the last one makes it), with the sign of `value`."""
    sense = constant(-1.0 if value < 0.0 else 1.0)
    given = {sense: -1.0 if value < 0.0 else 1.0}
    signed = Step("calc", step.name, (size[-1].name, sense), "signed")
    return Change(step.name, {step.name: (*size, signed)}, given, how)


def length_of(vector: str) -> tuple[Step, ...]:
    """Return the steps that find the size of a vector; the last one makes it."""
    pole, tip = f"_aside_{vector}.0", f"_aside_{vector}.1"
    return (
        Step("pole", pole, ()),
        Step("chain", tip, (pole, vector)),
        Step("distance", f"_size_{vector}", (pole, tip)),
    )
