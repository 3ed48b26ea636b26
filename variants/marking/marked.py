"""One student's answers marked: which variant it is, verdicts, mistakes that explain them, the mark, oddities."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from statistics import median
from typing import TYPE_CHECKING

from ...plans.marking.answers import Answer, Line, Verdict
from ...plans.marking.key import Key, behind
from ...plans.marking.verdicts import CLEAR, Marking, bounded, count_right, first_wrong, mark
from ...plans.mistakes.explaining import Candidate, explain
from ...scales.errors import InputError, KulmanError
from ...scales.kept import Kept
from ...scales.numbers import SHOWN, quote
from ..case import Settings
from ..roster import Entry, variant_of_book
from ..sheets import same_id, variant_of_id
from ..solution import Solution
from .answers import Answers, Mu, apart
from .answers import Line as Written
from .keyed import Keyed, keyed

if TYPE_CHECKING:
    from .checks import Check

NEAR = 0.05  # part by which values over segments may differ from one another
TELLING = 3  # lines that must tell that a scale factor is not theirs
SHORT = 2.0  # mm; shorter segments are read too coarsely to tell
FEWEST = 4  # answers that must be right under the key of another variant
MANY, MOST = 0.5, 0.8  # parts of the answers: not right under one's own key; that agree, or are right under the other


@dataclass(frozen=True, slots=True)
class Misfit:
    """A scale factor as written and the one that segments and values fit, SI per mm; `names` are their quantities."""

    symbol: str
    written: float
    fits: float
    names: tuple[str, ...]


def misfits(answers: Answers, key: Keyed) -> Iterator[Misfit]:
    """Go through the scale factors in rows of their own that do not fit what stands under them.

    The values must be nearer to the right ones than the segments times the factor: where the values are wrong, it is
    they that were calculated wrongly.
    """
    by_symbol: dict[str, list[Written]] = {}
    for line in answers.lines.values():
        symbol = key.scale_of(line.name)
        if symbol in answers.scales and line.mu is None and (line.mm or 0.0) >= SHORT and line.value:
            by_symbol.setdefault(symbol, []).append(line)
    for symbol, lines in by_symbol.items():
        found = _misfit(symbol, lines, answers.scales[symbol], key.key)
        if found is not None:
            yield found


def _misfit(symbol: str, lines: list[Written], mu: Mu, key: Key) -> Misfit | None:
    """Return what one scale factor should have been, if it is not what is written."""
    shown = [abs(line.value or 0.0) / (line.mm or 1.0) for line in lines]
    fits = median(shown)
    agree = sum(abs(one - fits) <= NEAR * fits for one in shown)
    if agree < max(TELLING, MOST * len(lines)) or any(abs(way - fits) <= 2.0 * NEAR * fits for way in mu.ways):
        return None
    written = mu.nearest(fits)
    sizes = [(line.value or 0.0, (line.mm or 0.0) * written, abs(key[line.name])) for line in lines]
    nearer = sum(not right or apart(value, right) < apart(by_mm, right) for value, by_mm, right in sizes)
    return None if nearer < MOST * len(lines) else Misfit(symbol, written, fits, tuple(line.name for line in lines))


def counted_once(
    marking: Marking, found: Iterable[Misfit], counted: Collection[str]
) -> tuple[Marking, dict[str, Misfit]]:
    """Return the marking with each misfit as an error of the first line that it concerns; and the misfits by lines.

    One of the lines `counted`, of which the mark is made, must bear the error.
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


def fits_other(marking: Marking, given: Sequence[Answer], others: Iterable[str], key: Callable[[str], Key]) -> str:
    """Return the variant that the answers fit, if it is not the student's own; nothing where most are right.

    `key` makes the answer key of a variant, or raises KulmanError where it has none: that costs as much as a solution,
    so the `others` are looked at only where many answers fail.
    """
    answered = marking.answered
    right = sum(line.verdict is Verdict.RIGHT for line in answered)  # by themselves, not as what follows from an error
    if len(answered) < FEWEST or right > (1.0 - MANY) * len(answered):
        return ""
    least = max(FEWEST, MOST * len(answered))
    found = {"": 0}
    for variant in others:
        with suppress(KulmanError):  # this variant has no plan with the student's data
            of = key(variant)
            found[variant] = count_right(of, [answer for answer in given if answer.name in of.questions], least)
    return max(found, key=lambda variant: found[variant])


KEPT = 32  # answer keys


@dataclass(frozen=True, slots=True)
class Marked:
    """A student's answers, marked.

    `lines` are those that count, `parts` what part of the full mark each is; `notes` say what was odd: cells that could
    not be read, another variant, another id; `misfits` are scale factors written wrongly, each by the line at which it
    counts; `fits` is another variant that the answers fit, if any.
    """

    answers: Answers
    entry: Entry | None
    keyed: Keyed
    marking: Marking
    candidates: tuple[Candidate, ...]
    lines: tuple[Line, ...]
    mark: float
    parts: Mapping[str, float]
    notes: tuple[KulmanError, ...]
    misfits: Mapping[str, Misfit] = field(default_factory=dict)
    fits: str = ""

    @property
    def slips(self) -> bool:
        """Whether all that is wrong is measured, and misses by so little that only the hand may have slipped."""
        faulty = [line for line in self.marking.lines if line.verdict.faulty]
        measured = all(self.keyed.key.questions[line.name].step.verb != "calc" for line in faulty)
        return bool(faulty) and measured and all(x.verdict is Verdict.WRONG and x.off <= CLEAR for x in faulty)

    def count(self, verdict: Verdict) -> int:
        """Return how many lines have a verdict."""
        return sum(line.verdict is verdict for line in self.lines)


def variant_of(check: Check, answers: Answers, entry: Entry | None) -> tuple[str, list[KulmanError]]:
    """Return the variant that a student has, by roster, file or record book; and what contradicts it.

    Raises
    ------
    InputError
        The record book has no such digits.
    """
    task, said, notes = check.request.task, answers.about.get("variant", ""), list[KulmanError]()
    if check.roster is not None and entry is None:
        notes.append(InputError("marked-stranger", text=quote(answers.who.student or answers.source)))
    other = answers.about.get("task", "")
    if other and other != task.id:
        notes.append(InputError("marked-task", text=quote(other), task=quote(task.id)))
    book = answers.who.book or (entry.who.book if entry else "")
    found = entry.variant if entry else ""
    if not found and entry and book:
        found = variant_of_book(task, book, check.digits)
    found = found or check.request.variant or (said if said in task.variants else "")
    if not found and book:
        found = variant_of_book(task, book, check.digits)
    found = found or variant_of_id(task, answers.about.get("sheet", "")) or ""
    if not found:
        found = next(iter(task.variants))
        notes += [InputError("marked-no-variant", variant=quote(found))] if len(task.variants) > 1 else []
    if said and said != found:
        notes.append(InputError("marked-variant", text=quote(said), variant=quote(found)))
    return found, notes


class Desk:
    """Where answers are marked: keys are made once for each variant with its data."""

    def __init__(self, check: Check) -> None:
        self.check = check
        self._keys = Kept[Keyed](KEPT)

    def keyed(self, variant: str, settings: Settings, own: bool = True) -> Keyed:
        """Return the key of a variant; the last few are kept.

        One that is not the student's `own` has the scale factors of the rule: no sheet is drawn for it, whatever format
        is asked for, and answers are compared at the scale factors to which they were drawn.
        """
        request = self.check.request if own else replace(self.check.request, format=None)
        name = (variant, request.format, *sorted(settings.items()))
        return self._keys.get(name, lambda: keyed(request, variant, settings, self.check.rubric))

    def mark(self, answers: Answers) -> Marked:
        """Mark the answers of one student.

        Raises
        ------
        InputError, PositionError
            The student's variant or data have no answer key, or the file could not be read.
        """
        if answers.unread is not None:
            raise answers.unread
        entry = self.check.roster.find(answers.who) if self.check.roster else None
        variant, notes = variant_of(self.check, answers, entry)
        settings = entry.settings if entry else {}
        key = self.keyed(variant, settings)
        notes += self._sheet(answers, key)
        rubric = self.check.rubric
        found = tuple(misfits(answers, key))
        given, undefined = _given(answers, key, {misfit.symbol: misfit.fits for misfit in found})
        given = [rubric.compared(answer, key.key.questions[answer.name]) for answer in given]
        notes += undefined
        marking, candidates = mark(key.key, given), tuple[Candidate, ...]()
        if marking.first_wrong is not None:
            explanation = explain(key.book, marking)
            marking, candidates = explanation.marking, explanation.candidates
        marking, borne = counted_once(marking, found, {line.name for line in self._counted(key, marking, answers)})
        others = [other for other in self.check.request.task.variants if other != variant][: KEPT - 1]
        fits = fits_other(marking, given, others, lambda other: self.keyed(other, settings, own=False).key)
        marking = bounded(marking, self.keyed(fits, settings, own=False).key if fits else None)
        lines = self._counted(key, marking, answers)
        parts = rubric.parts(lines, key.by_plan, key.needed)
        vectors = [line.answer for line in lines if line.answer is not None and isinstance(line.right, complex)]
        untold = len(vectors) > 1 and all(answer.direction is None for answer in vectors)
        if untold and rubric.directions != "ignored":
            notes.append(InputError("marked-directions"))
        mark_of, all_notes = rubric.mark(lines, parts), (*answers.problems, *notes)
        return Marked(answers, entry, key, marking, candidates, lines, mark_of, parts, all_notes, borne, fits)

    def _sheet(self, answers: Answers, key: Keyed) -> list[KulmanError]:
        """Say where the sheet id is that of another sheet."""
        written = answers.about.get("sheet", "")
        if not written or same_id(written, key.sheet):
            return []
        other, own = variant_of_id(self.check.request.task, written), quote(key.solution.variant)
        if other is not None:
            return [InputError("marked-sheet-variant", text=quote(written), variant=quote(other), own=own)]
        return [InputError("marked-sheet", text=quote(written), variant=own)]

    def _counted(self, key: Keyed, marking: Marking, answers: Answers) -> tuple[Line, ...]:
        """Return the lines that count: those of the rubric, else those of the class's columns, else all."""
        names = self.check.rubric.asked or answers.columns
        if names:
            return tuple(line for line in marking.lines if line.name in names)
        asked = {question.name for part in key.parts for question in part.asked}
        return tuple(line for line in marking.lines if line.answer is not None or line.name in asked)


def _given(answers: Answers, key: Keyed, fits: Mapping[str, float]) -> tuple[list[Answer], list[KulmanError]]:
    """Return the answers for marking, each with the scale factor of its plan; and those that have no right value.

    Where a factor is written wrongly in its row, `fits` has the one that the answers were worked out with.
    """
    given, notes = [], list[KulmanError]()
    for line in answers.lines.values():
        if line.name not in key.key.questions:
            notes.append(InputError("marked-undefined", place=quote(line.place, SHOWN), text=line.name))
            continue
        symbol = key.scale_of(line.name)
        written = line.mu or answers.scales.get(symbol)
        mu = None if written is None else fits.get(symbol, written.value) if line.mu is None else line.mu.value
        mm = None if line.mu is None and _on_other_drawing(line, symbol, answers, key.solution) else line.mm
        given.append(Answer(line.name, mm, mu, line.value, line.direction, line.sense, line.plus, line.rounded))
    return given, notes


def _on_other_drawing(line: Written, symbol: str, answers: Answers, solution: Solution) -> bool:
    """Whether a segment is that of the drawing on which the sheet shows it, and not of the plan that finds it.

    The scale factor of that drawing, the student's or else the sheet's, then makes its value of it.
    """
    shown = solution.quantities[line.name].scale
    if not line.mm or not line.value or shown is None or shown == symbol:
        return False
    own = answers.scales.get(shown)
    mu = own.nearest(abs(line.value) / line.mm) if own else solution.scales[shown].mu
    return abs(line.mm * mu - abs(line.value)) <= NEAR * abs(line.value)
