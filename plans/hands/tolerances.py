"""What a teacher should let pass: of each segment so much, of what is calculated from it what follows."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ..board import POSITION, Step
from ..laws import LAWS
from ..names import role
from ..quantities import POINTS, RESULTS, worst_behind
from .hand import Tolerance
from .shaky import Paper

READ = ("read", "measure", "distance")
MARKS = 0.35  # part of the tolerance in mm by which two marks miss each other: twice their standard deviation


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
    less. A calculated quantity inherits what the segments in it may miss; data have none.

    Parameters
    ----------
    values, sines : mapping
        Of an exact run.
    most : Tolerance
        A preset's, or one's own.
    """
    rule = _Rule(paper, values, worst_behind(paper.program, sines, same_plan), most, {}, _longest(paper, values))
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

    def of(self, step: Step) -> Any:
        """Return by how much the result of a step may differ, SI."""
        values = self.values
        if step.verb in READ:
            mu, sine = self._mu(step.operands[0]), min(self.flat.get(mark, 1.0) for mark in step.operands)
            slant = max(self.slants.get(mark, 0.0) for mark in step.operands)
            least = self._tilt(self.longest.get(step.plan, 0.0), slant) / sine
            drawn = max(self.most.of_segment(abs(values[step.name]) / mu, sine) * mu, least)
            return min(drawn, self._laid_off(step, mu))
        if step.verb == "moment":
            force, at, about = step.operands
            mu, size = self._mu(at), abs(values[force])
            arm = abs(values[step.name]) / size if size else 0.0
            tilt = self._tilt(abs(values[at] - values[about]))
            missed = max(self.most.of_segment(arm / mu) * mu, tilt) + self.astray.get(at, 0.0)
            missed += self.astray.get(about, 0.0)
            return size * missed + arm * self.allowed.get(force, 0.0)
        if step.verb == "arm":
            return self._arm(*step.operands)
        if step.verb == "calc":
            return self._inherited(step)
        is_point = step.verb in POINTS and "." not in step.name
        return self.most.mm * self._mu(step.name) / self.flat[step.name] if is_point else 0.0

    def _laid_off(self, step: Step, mu: float) -> float:
        """Return what a part may miss that is calculated, laid off and read: as it is calculated, and its two marks."""
        calculated = self.allowed.get(f"_{step.name}")
        if calculated is None:
            return math.inf
        least = self.most.part * abs(self.values[step.name])
        return float(max(least, math.hypot(calculated, MARKS * self.most.mm * mu)))

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

    def _mu(self, mark: str) -> float:
        return float(self.paper.mus[role(mark).plan])

    def _arm(self, moment: str, force: str) -> float:
        size = abs(self.values[force])
        return self.allowed[moment] / size if size else 0.0

    def _inherited(self, step: Step) -> float:
        """Return by how much a calculated value differs when what is in it does, each alone, together."""
        operands = [self.values[name] for name in step.operands]
        exact, law, total = self.values[step.name], LAWS[step.law], 0.0
        for i, name in enumerate(step.operands):
            if miss := self.allowed.get(name, 0.0):
                changed = ([*operands[:i], longer, *operands[i + 1 :]] for longer in longer(operands[i], miss))
                with np.errstate(all="ignore"):  # a miss may lead out of where a law holds
                    changes = [abs(law(*others) - exact) for others in changed]  # a load diagram may be steep one way
                total += max((change for change in changes if change == change), default=0.0)
        return total


def _longest(paper: Paper, values: Mapping[str, Any]) -> dict[str, float]:
    """Return the longest vector of every plan but that of the mechanism, which is drawn link by link."""
    found: dict[str, float] = {}
    for step in paper.program:
        if step.verb in ("read", "chain") and step.plan != POSITION:
            size = abs(values[step.operands[1] if step.verb == "chain" else step.name])
            if size == size:
                found[step.plan] = max(found.get(step.plan, 0.0), size)
    return found


def longer(value: Any, miss: float) -> tuple[Any, ...]:
    """Return values that miss, more and less: a vector along itself, one that is zero along both axes."""
    if not isinstance(value, complex):
        return value + miss, value - miss
    size = abs(value)
    if not size:
        return complex(miss), complex(-miss), 1j * miss, -1j * miss
    return value * (1.0 + miss / size), value * (1.0 - miss / size)


def same_plan(step: Step, operand: str) -> bool:
    """Whether a step draws on the plan of one of its operands."""
    return role(step.name).plan == role(operand).plan
