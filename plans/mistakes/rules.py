"""Rules that can be broken: each a rewrite of the same construction, found to apply from its steps alone.

The mistakes have numbers, M01 to M128. The other modules here, a chapter each, enter their rules into `MISTAKES`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

from ..board import POSITION, Program, Step
from ..hands.shaky import Paper
from ..names import MAGNITUDE, Name, role


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

    def calculated(self, *laws: str) -> tuple[Step, ...]:
        """Return the steps that calculate by some laws, in their order."""
        return tuple(step for step in self.made_by("calc") if step.law in laws)

    def mu(self, plan: str) -> float:
        """Return the scale factor of a plan, SI per mm."""
        return float(self.paper.mus[plan])

    def is_given(self, name: str) -> bool:
        """Whether a name stands for data, other than nothing."""
        return bool(self.paper.givens.get(name))

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
        sizes = (role(step.operands[2]) for step in self.made_by("lay", "back"))
        return frozenset(size.shown for size in sizes if size.hidden)


class _Number(Name):
    """The name of a number that a mistake brings in, with its value."""

    __slots__ = ("value",)
    value: Any


def constant(value: Any) -> _Number:
    """Return a number as an operand."""
    number = _Number(f"_times_{value!r}", "times")
    number.value = value
    return number


Steps = Mapping[str, tuple[Step, ...]]  # in the place of those of the same names


@dataclass(frozen=True, slots=True)
class Change:
    """How a rule is broken at one place: other steps in the place of those of the same names, other data.

    `how` tells apart several ways to break one rule at one place.
    """

    at: str
    steps: Steps
    how: str = ""
    data: Mapping[str, Any] = field(default_factory=dict)

    @property
    def givens(self) -> dict[str, Any]:
        """The data that are other ones, and the numbers in the steps."""
        operands = (name for steps in self.steps.values() for step in steps for name in step.operands)
        return {**{name: name.value for name in operands if isinstance(name, _Number)}, **self.data}


Changes = Iterable[Change]
Rule = Callable[..., Changes]  # of a scene, and of what else the mistake gives
Where = str | Callable[[Scene], Iterable[Any]]  # a law, or what finds steps, each perhaps with what goes with it
MISTAKES: dict[str, list[Rule]] = {}  # by number: a drawing of another kind has rules of its own under the same one
BY_SCALE: set[str] = set()  # those that hang on the scale factors of the student


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
    def place(self) -> tuple[str, str, str]:
        """What tells it apart from others of the same construction."""
        return self.mistake, self.change.at, self.change.how

    @cached_property
    def program(self) -> Program:
        """The construction with the rule broken: put together for the few that are looked at closely."""
        before, steps = self.paper.program, self.change.steps
        return Program(tuple(new for step in before for new in steps.get(step.name, (step,)))) if steps else before

    @cached_property
    def givens(self) -> Mapping[str, Any]:
        """The data with those that are other ones."""
        return {**self.paper.givens, **self.change.givens}


def mistake(id: str, *given: Any, of: Where = "", by_scale: bool = False) -> Callable[[Rule], Rule]:
    """Enter the function that follows, with what it is given besides the scene; several may break one rule.

    One `of` the steps of a law, or of what is found in a scene, breaks it at each of these, which it is given first.
    """

    def entered(rule: Rule) -> Rule:
        def everywhere(scene: Scene) -> Changes:
            places = scene.calculated(of) if isinstance(of, str) else of(scene)
            for place in places if of else ((),):
                yield from rule(scene, *((place,) if isinstance(place, Step | str) else place), *given)

        MISTAKES.setdefault(id, []).append(everywhere)
        BY_SCALE.update([id] * by_scale)
        return rule

    return entered


def each(id: str, of: Where, *changes: Callable[[Step], Change]) -> None:
    """Enter a rule that is broken at each step of a law, or of some others, in one way after the other."""
    mistake(id, of=of)(lambda scene, step: (change(step) for change in changes))


def broken(paper: Paper, values: Mapping[str, Any], ids: Iterable[str] = ()) -> Iterator[Broken]:
    """Go through every way in which a construction can go wrong; `ids` are the only mistakes, all when left out."""
    scene = Scene(paper, values)
    for id in sorted(ids or MISTAKES):
        yield from (Broken(id, paper, change) for rule in MISTAKES[id] for change in rule(scene))


# Rewrites that many rules share: steps that make something else of what one step makes.


def aside(name: str) -> Name:
    """Return a name for what was right before it was spoilt; it shows the quantity that it was."""
    return Name(f"_right_{name}", MAGNITUDE, name)


def operand(step: Step, place: int, name: str) -> Step:
    """Return a step with another operand at a place."""
    return step.but(operands=(*step.operands[:place], name, *step.operands[place + 1 :]))


def after(step: Step, *more: Step) -> tuple[Step, ...]:
    """Return a step that makes what is `aside`, then others, of which the last one makes what it made."""
    return (step.but(name=aside(step.name)), *more)


def then(step: Step, law: str, *operands: str) -> tuple[Step, ...]:
    """Return a step that makes what is `aside`, and the law that makes of it what it made."""
    return after(step, Step("calc", step.name, operands, law))


def reversed_(step: Step) -> tuple[Step, ...]:
    """Return the steps that make the opposite of what one step makes."""
    return then(step, "opposite", aside(step.name))


def times(step: Step, factor: float | str) -> tuple[Step, ...]:
    """Return the steps that make so many times what one step makes."""
    return then(step, "along", factor if isinstance(factor, str) else constant(factor), aside(step.name))


def nothing(step: Step) -> tuple[Step, ...]:
    """Return the steps that make nothing of what one step makes."""
    return times(step, "zero")


def length_of(vector: str) -> tuple[Step, ...]:
    """Return the steps that find the size of a vector; the last one makes it."""
    pole, tip = f"_aside_{vector}.0", f"_aside_{vector}.1"
    chain = Step("chain", tip, (pole, vector))
    return Step("pole", pole, ()), chain, Step("distance", f"_size_{vector}", (pole, tip))


# Changes made of them.


def instead(step: Step, *new: Step, how: str = "") -> Change:
    """Do other steps in the place of one step."""
    return Change(step.name, {step.name: new}, how)


def otherwise(step: Step, how: str = "", **changed: Any) -> Change:
    """Do one step otherwise: another verb, other operands, another law."""
    return instead(step, step.but(**changed), how=how)


def with_other(step: Step, place: int, name: str, how: str = "") -> Change:
    """Do one step with another operand."""
    return instead(step, operand(step, place, name), how=how)


def mirrored(step: Step, place: int, how: str = "") -> Change:
    """Do one step with the opposite of an operand."""
    right = step.operands[place]
    opposite = Step("calc", f"_other_{right}", (right,), "opposite")
    return instead(step, opposite, operand(step, place, opposite.name), how=how)


def opposed(step: Step, how: str = "") -> Change:
    """Make the opposite of what one step makes."""
    return instead(step, *reversed_(step), how=how)


def scaled(factor: float, *steps: Step, how: str = "", at: str | None = None) -> Change:
    """Make so many times what each of some steps makes."""
    return Change(steps[0].name if at is None else at, {step.name: times(step, factor) for step in steps}, how)


def each_and_all(changed: Steps, how: str = "", at: str = "") -> Iterator[Change]:
    """Change each of some steps, and all of them."""
    yield from (Change(name, {name: steps}, how) for name, steps in changed.items())
    if len(changed) > 1:
        yield Change(at or next(iter(changed)), changed, f"{how}, all".lstrip(", "))


def with_sign(step: Step, size: tuple[Step, ...], value: Any, how: str = "") -> Change:
    """Make the scalar of a step anew, its size by other steps (the last one makes it), with the sign of `value`."""
    sense = constant(-1.0 if value < 0.0 else 1.0)
    return instead(step, *size, Step("calc", step.name, (size[-1].name, sense), "signed"), how=how)


def with_operand(steps: Iterable[Step], place: int, name: str) -> dict[str, tuple[Step, ...]]:
    """Put another operand into each of some steps."""
    return {step.name: (operand(step, place, name),) for step in steps}
