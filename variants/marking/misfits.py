"""Scale factors written wrongly in their own rows: segments and values agree with one another, and with another one."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from statistics import median

from ...plans.marking.key import Key
from ...plans.marking.verdicts import Marking, Verdict, behind, first_wrong
from .answers import Answers, Line, Mu

NEAR = 0.05  # part by which values over segments may differ from one another
FEWEST, MOST = 3, 0.8  # lines that must tell, and which part of them must agree
SHORT = 2.0  # mm; shorter segments are read too coarsely to tell


@dataclass(frozen=True, slots=True)
class Misfit:
    """A scale factor as written and the one that segments and values fit, SI per mm; `names` are their quantities."""

    symbol: str
    written: float
    fits: float
    names: tuple[str, ...]


def misfits(answers: Answers, key: Key, scale_of_plan: Mapping[str, str]) -> Iterator[Misfit]:
    """Go through the scale factors in rows of their own that do not fit what stands under them.

    The values must be nearer to the right ones than the segments times the factor: where the values are wrong, it is
    they that were calculated wrongly.
    """
    by_symbol: dict[str, list[Line]] = {}
    for line in answers.lines.values():
        question = key.questions.get(line.name)
        symbol = "" if question is None else scale_of_plan.get(question.plan, "")
        if symbol in answers.scales and line.mu is None and (line.mm or 0.0) >= SHORT and line.value:
            by_symbol.setdefault(symbol, []).append(line)
    for symbol, lines in by_symbol.items():
        found = _misfit(symbol, lines, answers.scales[symbol], key)
        if found is not None:
            yield found


def _misfit(symbol: str, lines: list[Line], mu: Mu, key: Key) -> Misfit | None:
    """Return what one scale factor should have been, if it is not what is written."""
    shown = [abs(line.value or 0.0) / (line.mm or 1.0) for line in lines]
    fits = median(shown)
    agree = sum(abs(one - fits) <= NEAR * fits for one in shown)
    if agree < max(FEWEST, MOST * len(lines)) or any(abs(way - fits) <= 2.0 * NEAR * fits for way in mu.ways):
        return None
    written = mu.nearest(fits)
    nearer = [_values_are_nearer(line, written, key) for line in lines]
    if sum(nearer) < MOST * len(lines):
        return None
    return Misfit(symbol, written, fits, tuple(line.name for line in lines))


def _values_are_nearer(line: Line, mu: float, key: Key) -> bool:
    right = abs(key[line.name])
    if not right:
        return True
    value, by_mm = (abs(math.log(abs(one) / right)) for one in (line.value or right, (line.mm or 1.0) * mu))
    return value < by_mm


def counted_once(
    marking: Marking, found: Iterable[Misfit], counted: Collection[str]
) -> tuple[Marking, dict[str, Misfit]]:
    """Return the marking with each misfit as an error of the first line that it concerns; and the misfits by lines.

    Parameters
    ----------
    counted : collection of str
        The lines that the mark is made of: one of them must bear the error.
    """
    bearers: dict[str, Misfit] = {}
    for misfit in found:
        names = [line.name for line in marking.lines if line.name in misfit.names]
        bearers[next((name for name in names if name in counted), names[0])] = misfit
    if not bearers:
        return marking, {}
    lines = tuple(
        replace(line, verdict=Verdict.SCALE, about="size") if line.name in bearers and line.verdict.passed else line
        for line in marking.lines
    )
    first = first_wrong(lines)
    return replace(marking, lines=lines, first_wrong=first, step=behind(marking.key, first) if first else None), bearers
