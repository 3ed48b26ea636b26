"""Answers to another variant: under whose key most of them are right that are wrong under the student's own."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

from ...plans.marking.answers import Answer
from ...plans.marking.key import Key
from ...plans.marking.verdicts import Line, Marking, Verdict, count_right
from ...scales.errors import KulmanError

FEWEST = 4  # answers that must be right under the other key
MANY, MOST = 0.5, 0.8  # parts of the answers: not right under one's own key, right under the other


def fits_other(marking: Marking, given: Sequence[Answer], others: Iterable[str], key: Callable[[str], Key]) -> str:
    """Return the variant that the answers fit, if it is not the student's own; nothing where most are right.

    Parameters
    ----------
    others : iterable of str
        Variants to look at; a key costs as much as a solution, so they are looked at only where many answers fail.
    key : callable
        Makes the answer key of a variant, or raises KulmanError where it has none.
    """
    answered = marking.answered
    if len(answered) < FEWEST or _right(answered) > (1.0 - MANY) * len(answered):
        return ""
    least = max(FEWEST, MOST * len(answered))
    found = {variant: _under(variant, given, key, least) for variant in others}
    best = max(found, key=lambda variant: found[variant], default="")
    return best if best and found[best] >= least else ""


def _right(lines: Iterable[Line]) -> int:
    """Return how many lines are right by themselves, and not as what follows from an error."""
    return sum(line.verdict is Verdict.RIGHT for line in lines)


def _under(variant: str, given: Sequence[Answer], key: Callable[[str], Key], least: float) -> int:
    """Return how many answers are right under the key of a variant, nothing where that is less than `least`."""
    try:
        of = key(variant)
    except KulmanError:
        return 0  # this variant has no plan with the student's data
    return count_right(of, [answer for answer in given if answer.name in of.questions], least)
