"""The answer key of one task and variant: right values, tolerances, and what may be asked, in order of construction."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

from ..board import POSITION, Step
from ..boards.exact import run
from ..hands.hand import Tolerance
from ..hands.shaky import Paper
from ..hands.tolerances import MARKS, same_plan, tolerances
from ..names import role
from ..quantities import POINTS, results, shown_on, unit_of, worst_behind

ROUNDED = 0.005  # part of a value by which three digits are rounded
COARSER = 2.0  # how much coarser than ours a student's own scale may be for its millimetres to count
LIKE = 1.02  # ratio of scale factors that count as one
SAME = 1e-9  # part of a value that is rounding


@dataclass(frozen=True, slots=True)
class Question:
    """One line that may be asked: the plan that shows it, or on whose way it is calculated; whether it is a vector."""

    name: str
    plan: str
    vector: bool
    unit: str
    step: Step


@dataclass(frozen=True, slots=True)
class Key:
    """The answer key; `allowed` are sizes in SI, `angles` directions in radians.

    `values` are those of the construction; `also` has what is right, too, because another way leads to it. What is
    `firm` has a tolerance of the teacher's own, whatever it follows from. `vectors` are those of each plan.
    """

    paper: Paper
    tolerance: Tolerance
    limits: Mapping[str, float]
    values: Mapping[str, Any]
    sines: Mapping[str, float]
    allowed: Mapping[str, float]
    angles: Mapping[str, float]
    questions: Mapping[str, Question]
    also: Mapping[str, Any] = field(default_factory=dict)
    firm: frozenset[str] = frozenset()
    vectors: Mapping[str, tuple[str, ...]] = field(default_factory=dict)

    def __getitem__(self, name: str) -> Any:
        """Return the right value, a float or complex."""
        return self.values[name]

    def right(self, name: str) -> tuple[Any, ...]:
        """Return all right values of a quantity, that of the construction first."""
        return (self.values[name], self.also[name]) if name in self.also else (self.values[name],)

    def or_else(self, values: Mapping[str, Any]) -> Key:
        """Return the key in which the numbers that another way has led to are right, too, where they differ."""
        others = {n: values[n] for n in self.questions if n in values and values[n] != self[n]}  # both may be infinite
        return replace(self, also={n: x for n, x in others.items() if abs(x - self[n]) > SAME * abs(self[n])})

    def on_paper(self, name: str) -> float:
        """Return what an answer in millimetres alone may miss, SI: a calculated vector by its two marks, too."""
        question = self.questions[name]
        if question.step.verb != "calc":
            return self.allowed[name]
        marks = MARKS * self.tolerance.mm * float(self.paper.mus.get(question.plan, 0.0))
        return math.hypot(self.allowed[name], marks)

    def drawn_to(self, mus: Mapping[str, float]) -> Key:
        """Return the key for a sheet drawn to a student's own scale factors, by plan, value in SI per mm.

        Their millimetres count, but for a plan much smaller than ours: a small plan makes no error right.
        """
        within = {plan: min(max(mus.get(plan, mu), mu / COARSER), mu * COARSER) for plan, mu in self.paper.mus.items()}
        if all(mu / LIKE < within[plan] < mu * LIKE for plan, mu in self.paper.mus.items()):
            return self
        return _key(replace(self.paper, mus=within), self)


def behind(key: Key, name: str) -> Step:
    """Return the step that a quantity shows: of one that is read the mark that was made last, else its calculation."""
    step = key.questions[name].step
    if step.verb != "read":
        return step
    program = key.paper.program
    return program.steps[max(program.places.get(operand, -1) for operand in step.operands)]


def hanging_on(key: Key) -> Mapping[str, int]:
    """Return for each quantity all steps that hang on it, or on the mark that it shows, as `Program.hanging` does."""
    hanging = key.paper.program.hanging
    return {name: hanging.get(name, 0) | hanging.get(behind(key, name).name, 0) for name in key.questions}


def needed_by(key: Key) -> dict[str, float]:
    """Return for each quantity the part of those asked after it that hang on it, on its mark or its value."""
    places = key.paper.program.places
    asked, found, after = list(key.questions), {}, 0
    hanging = hanging_on(key)
    for count, name in enumerate(reversed(asked)):
        found[name] = (hanging[name] & after).bit_count() / count if count else 0.0
        after |= 1 << places[name]
    return found


def answer_key(
    paper: Paper,
    tolerance: Tolerance,
    limits: Mapping[str, float] | None = None,
    wanted: Collection[str] | None = None,
    units: Callable[[str], str] = unit_of,
    drawn: Mapping[str, float] | None = None,
) -> Key:
    """Make the answer key of one position.

    Parameters
    ----------
    paper : Paper
        The construction with the scale factors of the sheet, those that a student is supposed to take.
    limits : mapping of str to float, optional
        Tolerances of single quantities in SI, in the place of the rule.
    wanted : collection of str, optional
        The quantities that are asked; all when left out. What is undefined is not asked.
    units : callable
        The SI unit of each quantity by its name.
    drawn : mapping of str to float, optional
        What errors of drawing come to, SI, where the usual rule knows nothing of how they add up.
    """
    board = run(paper.program, paper.givens)
    asked = _questions(paper, board.values, wanted, units)
    own = limits or {}
    ruled = {**(drawn or {}), **own}
    vectors: dict[str, tuple[str, ...]] = {}
    for name, question in asked.items():
        if question.vector:
            vectors[question.plan] = (*vectors.get(question.plan, ()), name)
    key = Key(paper, tolerance, ruled, board.values, board.sines, {}, {}, asked, firm=frozenset(own), vectors=vectors)
    return _key(paper, key)


def _key(paper: Paper, key: Key) -> Key:
    """Find the tolerances of a key on another paper."""
    ruled = {step.name for step in results(paper.program)} - key.limits.keys()
    allowed = {**(tolerances(paper, key.values, key.sines, key.tolerance) if ruled else {}), **key.limits}
    for name in key.questions:
        least = rounded(key.values[name], key.tolerance)
        allowed[name] = key.limits.get(name, max(allowed[name], least))
    flat = worst_behind(paper.program, key.sines, same_plan)
    angles = {
        name: _angle(key, name, allowed[name], flat) for name, question in key.questions.items() if question.vector
    }
    return replace(key, paper=paper, allowed=allowed, angles=angles)


def rounded(value: Any, tolerance: Tolerance) -> float:
    """Return by how much a value may differ in any case: three digits, or a part of what a segment may miss."""
    return float(max(ROUNDED, 0.2 * tolerance.part) * abs(value))


def _angle(key: Key, name: str, allowed: float, flat: Mapping[str, float]) -> float:
    """Return by how much a direction may miss: as lines may, and as a mark that misses turns a short vector."""
    size, step = abs(key.values[name]), key.questions[name].step
    sine = min(flat.get(mark, 1.0) for mark in step.operands) if step.verb == "read" else 1.0
    if allowed >= size:
        return math.pi
    return min(math.radians(key.tolerance.degrees) / sine + math.asin(allowed / size), math.pi)


def _questions(
    paper: Paper, values: Mapping[str, Any], wanted: Collection[str] | None, units: Callable[[str], str]
) -> dict[str, Question]:
    shown, last, found = shown_on(paper.program), POSITION, {}
    asked = {step.name for step in results(paper.program) if step.verb not in POINTS and step.law != "difference"}
    for step in paper.program:
        if step.verb != "calc" and step.plan != POSITION:
            last = step.plan
        value = values[step.name]
        if step.name in asked and value == value and (wanted is None or step.name in wanted):
            here = role(step.operands[0]).plan  # where a distance is measured
            plan = shown.get(step.name, here if step.verb in ("distance", "measure") else last)
            found[step.name] = Question(step.name, plan, isinstance(value, complex), units(step.name), step)
    return found
