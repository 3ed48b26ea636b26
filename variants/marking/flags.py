"""What a teacher should check: segments too exact to be measured, and errors of drawing that two students share.

Only segments whose end is found by drawing tell anything: a vector that is laid off is as long as it was calculated.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from ...plans.marking.key import Key
from .answers import Answers

FOUND = ("meet", "arc", "arcs", "tangent", "similar", "divide", "template")  # verbs that find a mark by drawing
LEAST_MM = 5.0  # shorter segments say little
HAND = 0.25  # mm, by which a usual hand misses at the least
UNLIKELY = 1e-3  # that an honest hand is so exact
SHARED = 1e-2  # expected number of pairs in the class that would agree so by chance
FEWEST = 4  # segments that two students must share


@dataclass(frozen=True, slots=True)
class Measured:
    """A segment of one student, mm on his own scale: as written, as it should be, what it is read to, its spread."""

    mm: float
    right: float
    step: float
    spread: float


def measured(answers: Answers, key: Key, mus: Mapping[str, float]) -> dict[str, Measured]:
    """Return the segments that can only have been measured.

    Parameters
    ----------
    mus : mapping of str to float
        The student's scale factors by plan, value in SI per mm.
    """
    made, step = {one.name: one for one in key.paper.program}, _resolution(answers)
    found = {}
    for name, line in answers.lines.items():
        question = key.questions.get(name)
        if question is None or line.mm is None or question.step.verb not in ("read", "arm"):
            continue
        mu = mus.get(question.plan)
        ends = question.step.operands if question.step.verb == "read" else ()
        drawn = question.step.verb == "arm" or any(made[end].verb in FOUND for end in ends if end in made)
        if mu and drawn and abs(key[name]) / mu >= LEAST_MM:
            spread = max(HAND, key.allowed[name] / mu / 3.0)
            found[name] = Measured(line.mm, abs(key[name]) / mu, step, spread)
    return found


def _resolution(answers: Answers) -> float:
    """Return to what a student reads segments: halves of a millimetre are written with one decimal, too."""
    lines = [line for line in answers.lines.values() if line.mm is not None]
    decimals = min(max((line.decimals for line in lines), default=0), 3)
    halves = all((2.0 * (line.mm or 0.0)).is_integer() for line in lines)
    return 0.5 if decimals == 1 and halves else 10.0**-decimals


def too_exact(segments: Mapping[str, Measured]) -> bool:
    """Whether all segments are so near to the calculated ones that no hand has measured them."""
    if not segments:
        return False
    off = max(max(abs(s.mm - s.right), s.step / 2.0) for s in segments.values())
    chance = math.erf(off / (HAND * math.sqrt(2.0)))
    return chance ** len(segments) < UNLIKELY


@dataclass(frozen=True, slots=True)
class Pair:
    """Two students, by their numbers in the list, whose segments are the same; `names` are those."""

    first: int
    second: int
    names: tuple[str, ...]


def shared(students: Sequence[Mapping[str, Measured]]) -> Iterator[Pair]:
    """Go through the pairs of students whose measured segments agree more often than chance lets them.

    Two honest drawings miss by different amounts: that the same tenth or half of a millimetre is read twice has the
    chance of step / (2 sqrt(pi) spread), segment by segment.
    """
    import numpy as np

    names = sorted({name for student in students for name in student})
    if not names or len(students) < 2:
        return
    shape = (len(students), len(names))
    mm, chance = np.full(shape, np.nan), np.ones(shape)
    for i, student in enumerate(students):
        for j, name in enumerate(names):
            if name in student:
                s = student[name]
                mm[i, j], chance[i, j] = s.mm, min(1.0, s.step / (2.0 * math.sqrt(math.pi) * s.spread))
    pairs = len(students) * (len(students) - 1) / 2
    for i in range(len(students) - 1):
        same = np.abs(mm[i + 1 :] - mm[i]) < 1e-6
        both = ~np.isnan(mm[i + 1 :]) & ~np.isnan(mm[i])
        likely = np.where(same, np.log(np.maximum(chance[i + 1 :], chance[i])), 0.0).sum(axis=1)
        enough = (same.sum(axis=1) >= FEWEST) & (same.sum(axis=1) >= 0.9 * both.sum(axis=1))
        for k in np.flatnonzero(enough & (likely < math.log(SHARED / pairs))):
            yield Pair(i, int(i + 1 + k), tuple(name for j, name in enumerate(names) if same[k, j]))
