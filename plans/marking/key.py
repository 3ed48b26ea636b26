"""The answer key of one task and variant: right values, what may be asked in order of construction, and tolerances."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from ..board import POINTS, POSITION, Step
from ..boards.exact import run
from ..hands.shaky import Paper, Tolerance
from ..laws import LAWS
from ..names import COUPLE, role
from ..quantities import RESULTS, results, shown_on, unit_of, worst_behind

ROUNDED = 0.005  # part of a value by which three digits are rounded
COARSER = 2.0  # how much coarser than ours a student's own scale may be for its millimetres to count
LIKE = 1.02  # ratio of scale factors that count as one
SAME = 1e-9  # part of a value that is rounding
READ = ("read", "measure", "distance")
MARKS = 0.35  # part of the tolerance in mm by which two marks miss each other: twice their standard deviation


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


def answer_key(
    paper: Paper,
    tolerance: Tolerance,
    limits: Mapping[str, float] | None = None,
    wanted: Collection[str] | None = None,
    units: Callable[[str], str] = unit_of,
    drawn: Mapping[str, float] | None = None,
) -> Key:
    """Make the answer key of one position.

    The `paper` has the scale factors of the sheet, those that a student is supposed to take. `limits` are tolerances of
    single quantities in SI, in the place of the rule; `drawn` is what errors of drawing come to, SI, where the usual
    rule knows nothing of how they add up. Asked are the quantities `wanted`, all when left out, but for what is
    undefined; `units` gives their SI units by name.
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
    flat = worst_behind(paper.program, key.sines, _same_plan)
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


# What a teacher should let pass: of each segment so much, of what is calculated from it what follows.


def tolerances(
    paper: Paper, values: Mapping[str, Any], sines: Mapping[str, float], most: Tolerance
) -> dict[str, float]:
    """Return for each quantity by how much an answer may differ, SI; and what comes between quantities.

    Of a segment that is read |difference| <= max(mm, part of it, tilt) / |sin gamma|, gamma being the angle of the
    lines whose meeting is read, the worst of those behind the segment's ends on its own plan. The tilt is what the
    longest segment of the plan misses at its end when its direction misses, by the degrees of the preset and by what
    the marks at the ends of a short link do to its direction, those of a slider with the guide that misses its own: a
    short side closes a plan of long vectors no better. Of an arm it is that of the way to the point of the force, and
    what a point misses where lines of the mechanism cross that run on from short links. A
    part that is calculated and laid off (a_BA_n) misses no more than its calculation and its two marks, where that is
    less. A calculated quantity inherits what the segments in it may miss; data have none. Values and sines are those of
    an exact run.
    """
    rule = _Rule(paper, values, worst_behind(paper.program, sines, _same_plan), most, {}, _longest(paper, values))
    for step in paper.program:
        if step.verb == "arc":  # on a line that misses its direction
            rule.aside[step.name] = rule._tilt(abs(values[step.name] - values[step.operands[2]]))
        if step.verb == "meet" and step.plan == POSITION:
            rule.aside[step.name] = rule.astray[step.name] = rule.crossing(step)
        rule.slants[step.name] = rule.slant(step)
        rule.allowed[step.name] = float(rule.of(step))
    return rule.allowed


@dataclass(frozen=True, slots=True)
class _Rule:
    """The rule for one step after the other; `flat` are sines, `allowed` what earlier steps may miss."""

    paper: Paper
    values: Mapping[str, Any]
    flat: Mapping[str, float]
    most: Tolerance
    allowed: dict[str, float]
    longest: Mapping[str, float]
    slants: dict[str, float] = field(default_factory=dict)
    aside: dict[str, float] = field(default_factory=dict)
    astray: dict[str, float] = field(default_factory=dict)
    arms: dict[str, float] = field(default_factory=dict)  # what arms may miss, by their moments

    def of(self, step: Step) -> Any:
        """Return by how much the result of a step may differ, SI."""
        values = self.values
        if step.verb in READ:
            mu, sine = self._mu(step.operands[0]), min(self.flat.get(mark, 1.0) for mark in step.operands)
            slant = max(self.slants.get(mark, 0.0) for mark in step.operands)
            least = self._tilt(self.longest.get(step.plan, 0.0), slant) / sine
            drawn = max(self.most.of_segment(abs(values[step.name]) / mu, sine) * mu, least)
            calculated = self.allowed.get(f"_{step.name}")
            if calculated is None:
                return drawn
            # a part that is calculated, laid off and read: as it is calculated, and its two marks
            laid = math.hypot(calculated, MARKS * self.most.mm * mu)
            return min(drawn, max(self.most.part * abs(values[step.name]), laid))
        if step.verb == "moment":
            force, at, about = step.operands
            mu, size = self._mu(at), abs(values[force])
            arm = abs(values[step.name]) / size if size else 0.0
            tilt = self._tilt(abs(values[at] - values[about]))
            missed = max(self.most.of_segment(arm / mu) * mu, tilt) + self.astray.get(at, 0.0)
            way = math.sqrt(max(abs(values[at] - values[about]) ** 2 - arm * arm, 0.0))
            missed = math.hypot(missed, self._turned(force) * way)
            self.arms[step.name] = missed + self.astray.get(about, 0.0)
            return size * self.arms[step.name] + arm * self.allowed.get(force, 0.0)
        if step.verb == "arm":
            moment, size = step.operands[0], abs(values[step.operands[1]])
            # measured on the drawing, however large the force is; that of a sum of moments is calculated
            return self.arms[moment] if moment in self.arms else self.allowed[moment] / size if size else 0.0
        if step.verb == "calc":
            return self._inherited(step)
        is_point = step.verb in POINTS and "." not in step.name
        return self.most.mm * self._mu(step.name) / self.flat[step.name] if is_point else 0.0

    def slant(self, step: Step) -> float:
        """Return by how much directions behind a mark miss because links are short on paper, radians."""
        if step.verb in (*RESULTS, "moment"):
            return 0.0
        if step.verb == "direction" and not role(step.name).hidden:
            length, ends = abs(self.values[step.operands[2]]), step.operands[:2]
            missed = math.hypot(MARKS * self.most.mm * self._mu(ends[0]), *(self.aside.get(end, 0.0) for end in ends))
            return missed / length if length > 0.0 else 0.0
        return max((self.slants.get(name, 0.0) for name in step.operands), default=0.0)

    def crossing(self, step: Step) -> float:
        """Return by how much the point may miss where two lines of the mechanism cross, such as a triad's special one.

        The lines run on from short links, and where they end is as far aside as their directions miss on the way.
        """
        p, u, q, w = step.operands
        point, ways = self.values[step.name], ((p, u), (q, w))
        tilts = (self._tilt(abs(point - self.values[start]), self.slants.get(line, 0.0)) for start, line in ways)
        return sum(tilts) / self.flat.get(step.name, 1.0)

    def _tilt(self, length: float, slant: float = 0.0) -> float:
        """Return what a line of this length misses at its end when its direction does."""
        return math.hypot(math.radians(self.most.degrees), slant) * length if length == length else 0.0

    def _turned(self, force: str) -> float:
        """Return by how much the direction of a force may miss, radians: a couple's is normal to its link."""
        size = abs(self.values[force])
        return min(self.allowed.get(force, 0.0) / size, 1.0) if size and role(force).part != COUPLE else 0.0

    def _mu(self, mark: str) -> float:
        return float(self.paper.mus[role(mark).plan])

    def _inherited(self, step: Step) -> float:
        """Return by how much a calculated value differs when what is in it does: errors of a hand add as variances."""
        operands = [self.values[name] for name in step.operands]
        with np.errstate(all="ignore"):  # a miss may lead out of where a law holds
            missed = (self.allowed.get(name, 0.0) for name in step.operands)
            return math.hypot(*inherited(step.law, operands, self.values[step.name], missed))


def _longest(paper: Paper, values: Mapping[str, Any]) -> dict[str, float]:
    """Return the longest vector of every plan but that of the mechanism, which is drawn link by link."""
    found: dict[str, float] = {}
    for step in paper.program:
        if step.verb in ("read", "chain") and step.plan != POSITION:
            size = abs(values[step.operands[1] if step.verb == "chain" else step.name])
            if size == size:
                found[step.plan] = max(found.get(step.plan, 0.0), size)
    return found


def inherited(law: str, operands: list[Any], exact: Any, missed: Iterable[float]) -> list[float]:
    """Return by how much a law misses what is exact when each operand does, one after the other."""
    found = []
    for i, miss in enumerate(missed):
        if miss:
            changed = ([*operands[:i], x, *operands[i + 1 :]] for x in _longer(operands[i], miss))
            changes = [abs(LAWS[law](*others) - exact) for others in changed]  # a load diagram may be steep one way
            found.append(max((change for change in changes if change == change), default=0.0))
    return found


def _longer(value: Any, miss: float) -> tuple[Any, ...]:
    """Return values that miss, more and less: a vector along itself, one that is zero along both axes."""
    if not isinstance(value, complex):
        return value + miss, value - miss
    size = abs(value)
    if not size:
        return complex(miss), complex(-miss), 1j * miss, -1j * miss
    return value * (1.0 + miss / size), value * (1.0 - miss / size)


def _same_plan(step: Step, operand: str) -> bool:
    """Whether a step draws on the plan of one of its operands."""
    return role(step.name).plan == role(operand).plan
