"""What a teacher should check: segments too exact to be measured, and errors of drawing that two students share.

Only segments whose end is found by drawing tell anything: a vector that is laid off is as long as it was calculated.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from ...plans.marking.key import Key
from .answers import Answers, Line

FOUND = ("meet", "arc", "arcs", "tangent", "similar", "divide", "template")  # verbs that find a mark by drawing
LEAST_MM = 5.0  # shorter segments say little
HAND = 0.25  # mm, by which a usual hand misses at the least
UNLIKELY = 1e-3  # that an honest hand is so exact
SHARED = 0.03  # ratio of likelihoods of all pairs of a class together at which one of them is told of
UNLIKELY_PAIR = 1e-3  # that of a pair in a small class
FEWEST = 4  # segments that two students must share
CHANGED = 0.5  # mm by which somebody who copies changes some of them
SAME, AGREE = 0.65, 0.9  # parts of the segments that must be the same, and at the most changed so
SAME_OF_ALL = 0.5  # part that must be the same where all others are changed so
COPIED, FAR = 0.65, 0.02  # how often a copied segment is the same, and another one altogether
CERTAIN = 0.6  # the chance that two honest readings are the same is no more than this
WIDEST = 2.0  # mm of spread
BEST = 0.242  # 1/sqrt(2 pi e): density of a normal law at its deviation, at the deviation where it is largest
ROUNDING = 1e-6  # mm


@dataclass(frozen=True, slots=True)
class Measured:
    """A segment of one student, mm on his own scale: as written, as it should be, what it is read to, its spread.

    It should be what follows from the student's earlier errors: who goes on honestly from the same mistake is no copy.
    """

    mm: float
    right: float
    step: float
    spread: float


def measured(answers: Answers, key: Key, mus: Mapping[str, float], follows: Mapping[str, float]) -> dict[str, Measured]:
    """Return the segments that can only have been measured.

    Parameters
    ----------
    follows : mapping of str to float
        What follows for each quantity from the student's earlier errors, SI; the right size where it is not there.
    mus : mapping of str to float
        The student's scale factors by plan, value in SI per mm.
    """
    made = {one.name: one for one in key.paper.program}
    found: dict[str, tuple[Line, float]] = {}
    for name, line in answers.lines.items():
        question = key.questions.get(name)
        if question is None or line.mm is None or question.step.verb not in ("read", "arm"):
            continue
        mu = mus.get(question.plan)
        ends = question.step.operands if question.step.verb == "read" else ()
        drawn = question.step.verb == "arm" or any(made[end].verb in FOUND for end in ends if end in made)
        if mu and drawn and abs(key[name]) / mu >= LEAST_MM:
            found[name] = line, mu
    step = _resolution([line for line, _ in found.values()])  # what is laid off may be written to more digits
    return {
        name: Measured(
            line.mm or 0.0,
            follows.get(name, abs(key[name])) / mu,
            step,
            max(HAND, key.allowed[name] / mu / 3.0),
        )
        for name, (line, mu) in found.items()
    }


def _resolution(lines: Sequence[Line]) -> float:
    """Return to what a student reads segments: halves of a millimetre are written with one decimal, too."""
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
    """Two students, by their numbers in the list, whose segments agree.

    `names` are those that are the same, `near` is how many are so at least nearly, `of` how many both have.
    """

    first: int
    second: int
    names: tuple[str, ...]
    near: int
    of: int


def shared(students: Sequence[Mapping[str, Measured]]) -> Iterator[Pair]:
    """Go through the pairs of students whose measured segments agree as those of somebody who has copied.

    Who copies leaves most millimetres as they are and changes some of them a little; two honest drawings miss by
    different amounts. Pairs that agree so far are held against both hypotheses, segment by segment.
    """
    import numpy as np

    names = sorted({name for student in students for name in student})
    if not names or len(students) < 2:
        return
    mm = np.full((len(students), len(names)), np.nan)
    for i, student in enumerate(students):
        for j, name in enumerate(names):
            if name in student:
                mm[i, j] = student[name].mm
    reach = np.array([max([CHANGED, *(s.step for s in student.values())]) for student in students]) + ROUNDING
    least = math.log(min(UNLIKELY_PAIR, SHARED / (len(students) * (len(students) - 1) / 2)))
    for i in range(len(students) - 1):
        apart = np.abs(mm[i + 1 :] - mm[i])
        both, same = np.isfinite(apart).sum(axis=1), (apart < ROUNDING).sum(axis=1)
        near = (apart <= np.maximum(reach[i + 1 :], reach[i])[:, None]).sum(axis=1)
        most, all_near = (same >= SAME * both) & (near >= AGREE * both), (same >= SAME_OF_ALL * both) & (near == both)
        for k in np.flatnonzero((same >= FEWEST) & (most | all_near)):
            other = int(i + 1 + k)
            if _likelihood(students[i], students[other]) < least:
                alike = tuple(name for j, name in enumerate(names) if apart[k, j] < ROUNDING)
                yield Pair(i, other, alike, int(near[k]), int(both[k]))


def _likelihood(one: Mapping[str, Measured], other: Mapping[str, Measured]) -> float:
    """Return the logarithm of how much likelier two drawings agree as they do if both are honest than if one is copied.

    That an honest hand reads the same step as another has the chance of step / (2 sqrt(pi) spread); of a segment that
    is nearly right much more: however good the hand, 0.242 step / deviation at the most, certain within half a step.
    """
    total = 0.0
    for name in one.keys() & other.keys():
        pair = one[name], other[name]
        step = max(s.step for s in pair)
        steps = max(round(CHANGED / step), 1)  # to either side
        spread = min(max(s.spread for s in pair), WIDEST)
        same = min(max(step / (2.0 * math.sqrt(math.pi) * spread), *map(_most, pair)), CERTAIN)
        near = min(2 * steps * same, 1.0 - FAR - same)
        apart = abs(pair[0].mm - pair[1].mm)
        if apart < ROUNDING:
            total += math.log(same / COPIED)
        elif apart <= steps * step + ROUNDING:
            total += math.log(near / (1.0 - FAR - COPIED))
        else:
            total += math.log((1.0 - same - near) / FAR)
    return total


def _most(segment: Measured) -> float:
    """Return the largest chance that a hand, be it good or bad, reads what was read."""
    off = abs(segment.mm - segment.right)
    return BEST * segment.step / off if off > segment.step / 2.0 else 1.0
