"""What a recorded program says: which vectors each plan draws, and by which way a mark is reached from the pole."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import lru_cache
from itertools import combinations

from ...plans.board import POSITION, Program, Step
from ...plans.linkages.parts import SYMBOLS
from ...plans.linkages.solved import SolvedLinkage
from ...plans.names import CORIOLIS, COUPLE, NORMAL, POLE, role
from ..words import Words

Triangle = tuple[str, str, str]
HUNG = ("lay", "back", "chain")  # verbs that lay a vector off from a mark


@dataclass(frozen=True, slots=True)
class Edge:
    """A vector on a plan: the quantity, the marks from which and to which it runs, the number of its step."""

    name: str
    tail: str
    tip: str
    at: int = field(default=0, compare=False)


class Reading:
    """A program with what is looked up in it: the step and the number of each name, the vectors of each plan."""

    def __init__(self, program: Program) -> None:
        self.program, self._edges = program, dict[str, list[Edge]]()
        self.made = {step.name: step for step in program}
        self.number = {step.name: at for at, step in enumerate(program)}
        for at, step in enumerate(program):
            if step.verb in ("read", "chain"):
                tail, last = step.operands
                name, tip = (step.name, last) if step.verb == "read" else (last, step.name)
                self._edges.setdefault(step.plan, []).append(Edge(name, tail, tip, at))

    def on(self, plan: str) -> Sequence[Edge]:
        """Return the vectors of a plan in the order in which they are drawn."""
        return self._edges.get(plan, ())

    def meetings(self, plan: str) -> Iterator[tuple[Step, int, str, str]]:
        """Go through the lines that meet: the step, which of its two lines, the mark where it begins, its direction."""
        for step in self.program.on(plan):
            if step.verb == "meet":
                p, u, q, w = step.operands
                yield from ((step, 1, p, u), (step, 2, q, w))

    def triangles(self, plan: str) -> Iterator[Triangle]:
        """Go through the marks of each triangle of a plan that is similar to one of a link."""
        similar = (step for step in self.program.on(plan) if step.verb == "similar")
        return ((step.operands[0], step.operands[1], step.name) for step in similar)

    def on_link(self, triangle: Triangle) -> Triangle:
        """Return the points of the link to whose triangle that of a plan is similar.

        At the pole stands a pivot of the frame: its letter is that of the same step on the plan of the mechanism.
        """
        *ends, point = map(role, triangle)
        own = self.made[point.of].operands
        first, second = (own[i] if end.kind == POLE else end.of for i, end in enumerate(ends))
        return first, second, point.of

    def _beside(self, mark: str) -> Sequence[Edge]:
        """Return the vectors of the plan on which a mark stands; the mechanism itself has none."""
        plan = role(mark).plan
        return () if plan == POSITION else self.on(plan)

    def between(self, tail: str, tip: str) -> Edge | None:
        """Return the vector from one mark to another, the first that is drawn."""
        return next((e for e in self._beside(tip) if (e.tail, e.tip) == (tail, tip)), None)

    def absolute(self, mark: str, before: int | None = None) -> Edge | None:
        """Return the vector from the pole to a mark; of two names for it the last one."""
        pole = f"{role(mark).plan}.p"
        edges = [e for e in self._beside(mark) if (e.tail, e.tip) == (pole, mark)]
        return next((e for e in reversed(edges) if before is None or e.at < before), None)

    def way(self, mark: str, before: int) -> list[Edge]:
        """Return the known vectors that lead from the pole to a mark: its absolute one if it has one.

        Otherwise that which ends at it, hung on the way to where that one begins.
        """
        if (absolute := self.absolute(mark, before)) is not None:
            return [absolute]
        end = next((e for e in self._beside(mark) if e.tip == mark and e.at < before), None)
        return [] if end is None else [*self.way(end.tail, before), end]

    def parts(self, whole: Edge) -> list[Edge]:
        """Return the vectors of which an absolute one was hung together; none where it was not."""
        step = self.made[whole.tip]
        last = self.between(step.operands[0], step.name) if step.verb in HUNG else None
        return [] if last is None or last.name == whole.name else [*self.way(last.tail, len(self.made)), last]

    def is_hung(self, edge: Edge) -> bool:
        """Whether a vector was laid off or hung, not read between marks that were there."""
        step = self.made[edge.tip]
        return step.verb in HUNG and step.operands[0] == edge.tail

    def drawn_with(self, edge: Edge) -> str:
        """Return the step that draws a vector: that of its end where it was hung, else the first that measures it."""
        first = None if self.is_hung(edge) else self.between(edge.tail, edge.tip)
        return edge.tip if first is None else first.name

    def visible(self, name: str) -> str:
        """Return the quantity that a calculated size is: `a_BA_n`, which the plan shows, of `_a_BA_n`."""
        laid = (s for s in self.program.which(("lay", "back")) if role(name).hidden and s.operands[2] == name)
        edges = (self.between(step.operands[0], step.name) for step in laid)
        return next((edge.name for edge in edges if edge is not None), role(name).shown)

    def users(self, name: str) -> Iterator[Step]:
        """Go through the steps that need a name."""
        return (step for step in self.program if name in step.operands)


read = lru_cache(maxsize=16)(Reading)  # a program is looked through once


def lettered(words: Words, solved: SolvedLinkage) -> Words:
    """Return the words for the sheet of one mechanism."""
    reading = read(solved.program)
    frame = str(len(solved.mechanism.links) + 1) if words.notation["frame"] == "last" else "0"
    letters, ends = _ends(reading, words), dict[str, str]()
    for link in solved.mechanism.links:  # by the two joints that are farthest apart, in the order of the link
        joints = {pair.point for pair in solved.mechanism.pairs if link.number in pair.links}
        pairs = combinations([point for point in link.points if point in joints], 2)
        at = {point: complex(*(solved.values[xy] for xy in place)) for point, place in link.points.items()}
        if farthest := max(pairs, key=lambda ends: abs(at[ends[1]] - at[ends[0]]), default=()):
            ends[str(link.number)] = "".join(re.sub(r"(\d+)", r"_{\1}", end) for end in farthest)
    # the second force of each couple on the lever, and its arm
    seconds = [step.name for step in solved.program if step.law == "opposite" and role(step.name).part == COUPLE]
    arms = [arm.name for name in seconds for moment in reading.users(name) for arm in reading.users(moment.name)]
    seconds += [name for name in arms if role(name).part == COUPLE or role(name).kind == "h"]
    parted = solved.mechanism.parted
    return replace(words, seconds=frozenset(seconds), letters=letters, frame=frame, ends=ends, parted=parted)


def _ends(reading: Reading, words: Words) -> dict[str, str]:
    """Return the letters of ends of normal parts and accelerations of Coriolis where a plan has several of them."""
    letters: dict[str, str] = {}
    for kind, key in ((NORMAL, "normal_end"), (CORIOLIS, "coriolis_end")):
        marks = [mark for name in reading.made if (mark := role(name)).plan in SYMBOLS and mark.kind == kind]
        for plan in dict.fromkeys(mark.plan for mark in marks):
            here, taken = [mark for mark in marks if mark.plan == plan], set[str]()
            for mark in here if len(here) > 1 else ():
                link = _link_of(reading, mark)
                index = mark.letters if link in (*taken, "") else link
                taken.add(link)
                letters[mark] = f"{words.notation[key]}_{{{index}}}"
    return letters


def _link_of(reading: Reading, mark: str) -> str:
    """Return the number of the link whose turning makes the vector that ends at a mark; of a guide for Coriolis."""
    step = reading.made[mark]
    made = reading.made.get(step.operands[1 if step.verb == "chain" else 2])
    names = made.operands if made else ()
    # the law of a normal part takes omega itself, or the relative velocity from which omega is read
    rates = [name for name in names if role(name).kind == "omega"]
    rates += [user.name for name in names for user in reading.users(name) if user.law == "turning"]
    return role(rates[0]).of if rates else ""


def ends_of(reading: Reading, direction: str) -> tuple[str, str]:
    """Return the two points of which a direction is the line."""
    step = reading.made[direction]
    if step.verb in ("direction", "tangent"):
        return step.operands[0], step.operands[1]
    # the crank is turned to its angle: its end is laid off along this direction
    lay = next(s for s in reading.users(direction) if s.verb == "lay" and s.plan == POSITION)
    return lay.operands[0], lay.name
