"""What is kept of each marked student, what a teacher should check of it, and the tables of a class.

A teacher is told of segments too exact to be measured, and of errors of drawing that two students share. Only segments
whose end is found by drawing tell anything: a vector that is laid off is as long as it was calculated.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from types import MappingProxyType
from typing import Any, TypeAlias

from ...plans.marking.answers import Verdict
from ...plans.marking.key import Key
from ...plans.marking.verdicts import CLEAR
from ...scales.errors import LANGUAGES, KulmanError, Told, spoken
from ..roster import WHO, Entry, Who
from ..tables import Cell
from .marked import TOLD_APART, Marked
from .reading import Answers, Reply
from .wording import heads, mistake_texts, texts

FOUND = ("meet", "arc", "arcs", "tangent", "similar", "divide", "template")  # verbs that find a mark by drawing
PARTED = ("divide",)  # between marks
LEAST_MM = 5.0  # shorter segments say little
HAND = 0.25  # mm, by which a usual hand misses at the least
UNLIKELY = 1e-3  # that an honest hand is so exact
SHARED = 1.0  # ratio of likelihoods of all pairs of a class together at which one of them is told of
BY_WRONG = 0.03  # the same of two who share readings that are wrong, by these alone
UNLIKELY_PAIR = 5e-3  # that of a pair in a small class
DOUBT = 2.0  # students more by which the others of a class are counted who have read the same
FEWEST = 3  # segments that two students must share
FEWEST_OF_ANOTHER = 4  # that students of two variants must share
FEWEST_WRONG = 2  # wrong ones, where the others need not agree
KNOWN, ALIKE = 0.5, 0.1  # how often two honest students make the same mistake: a known one, any other one
READ_TO = 0.1  # mm to which a segment is read at best of which only the value is said
CHANGED = 0.5  # mm by which somebody who copies changes some of them
SAME, AGREE = 0.65, 0.9  # parts of the segments that must be the same, and at the most changed so
SAME_OF_ALL = 0.5  # more than this part must be the same where all others are changed so
COPIED, FAR = 0.65, 0.02  # how often a copied segment is the same, and another one altogether
CERTAIN = 0.6  # the chance that two honest readings are the same is no more than this
WIDEST = 2.0  # mm of spread
BEST = 0.242  # 1/sqrt(2 pi e): density of a normal law at its deviation, at the deviation where it is largest
ROUNDING = 1e-6  # mm
OF = ("stranger", "stranger-like", "namesakes", "task", "variant", "data", "data-other", "sheet", "sheet-variant")
CONTRADICTS = {f"marked-{of}" for of in OF}  # keys of notes
LISTS = ("mistakes", "notes", "reports", "plans", "absent", "perhaps", "contradicts")  # of a result


@dataclass(frozen=True, slots=True)
class _Measured:
    """A segment of one student, mm on his own scale: as written, as it should be, what it is read to, its spread.

    It should be what follows from the student's earlier errors: who goes on honestly from the same mistake is no copy.
    What is not `said` is that of a value alone. Of what is clearly wrong by itself, `alike` is how often two honest
    students have made the same mistake there, as far as the rest of a class does not tell.
    """

    mm: float
    right: float
    step: float
    spread: float
    said: bool = True
    alike: float = 1.0


def measured(
    answers: Answers,
    key: Key,
    mus: Mapping[str, float],
    follows: Mapping[str, float],
    wrong: Mapping[str, float] = MappingProxyType({}),
) -> dict[str, _Measured]:
    """Return the segments that can only have been measured, at the student's scale factors by plan, SI per mm.

    `follows` has what follows for each quantity from the student's earlier errors, SI, if that is not the right size;
    `wrong` says of those that are so by themselves how often two students make the same mistake.
    """
    made = {one.name: one for one in key.paper.program}
    found: dict[str, tuple[Reply, float]] = {}
    at: dict[str, list[str]] = {}  # by the mark where they end

    def drawn(mark: str) -> bool:
        step = made.get(mark)
        parted = step is not None and step.verb in PARTED  # as sure as what it parts
        return step is not None and (any(map(drawn, step.operands)) if parted else step.verb in FOUND)

    for name, line in answers.lines.items():
        question = key.questions.get(name)
        if question is None or line.empty or question.step.verb not in ("read", "arm"):
            continue
        mu = mus.get(question.plan)
        ends = [end for end in question.step.operands if drawn(end)] if question.step.verb == "read" else [name]
        if mu and ends and abs(key[name]) / mu >= LEAST_MM:
            found[name] = line, mu
            at.setdefault(ends[-1], []).append(name)
    for names in at.values():  # a mark has two coordinates: what else ends there errs as two segments do
        while len(names) > 1:
            sizes = sorted((abs(key[name]) / found[name][1], name) for name in names)
            gap, name = min((two[0] - one[0], one[1]) for one, two in pairwise(sizes))
            if len(names) == 2 and gap > ROUNDING:
                break
            names.remove(name)
            del found[name]
    # halves of a millimetre are written with one decimal, too; what is laid off may be written to more digits
    decimals = min(max((line.decimals for line, _ in found.values()), default=0), 3)
    halves = all((2.0 * (line.mm or 0.0)).is_integer() for line, _ in found.values())
    step, segments = 0.5 if decimals == 1 and halves else 10.0**-decimals, dict[str, _Measured]()
    values = {name: (abs(line.value or 0.0) / mu, (line.rounded or 0.0) / mu) for name, (line, mu) in found.items()}
    coarse = all(abs(2.0 * mm - round(2.0 * mm)) <= 2.0 * last for mm, last in values.values())
    for name, (line, mu) in found.items():
        right, spread = follows.get(name, abs(key[name])) / mu, max(HAND, key.allowed[name] / mu / 3.0)
        mm, last = (values[name][0], max(0.5 if coarse else READ_TO, 2.0 * values[name][1]))
        said, clear = line.mm is not None, CLEAR * key.allowed[name] / mu
        alike = wrong.get(name, 1.0) if abs((line.mm or mm) - right) > clear else 1.0
        segments[name] = _Measured(line.mm or mm, right, step if said else last, spread, said, alike)
    return segments


def _too_exact(segments: Mapping[str, _Measured]) -> bool:
    """Whether all segments are so near to the calculated ones that no hand has measured them."""
    read = [segment for segment in segments.values() if segment.said]
    off = max((max(abs(s.mm - s.right), s.step / 2.0) for s in read), default=0.0)
    chance = math.erf(off / (HAND * math.sqrt(2.0)))
    return bool(read) and chance ** len(read) < UNLIKELY


@dataclass(frozen=True, slots=True)
class _Pair:
    """Two students, by their numbers in the list, whose segments agree.

    `names` are those that are the same, `near` is how many are so at least nearly, `of` how many both have.
    """

    first: int
    second: int
    names: tuple[str, ...]
    near: int
    of: int


def shared(students: Sequence[Mapping[str, _Measured]], variants: Sequence[str] = ()) -> Iterator[_Pair]:
    """Go through the pairs of students whose measured segments agree as those of somebody who has copied.

    Who copies leaves most millimetres as they are and changes some of them a little; two honest drawings miss by
    different amounts. Pairs that agree so far are held against both hypotheses, segment by segment; and those who share
    two segments or more that are wrong by themselves, by these alone. What many others have read, too, tells little.
    Of students of other `variants` segments are held against each other where theirs should be clearly different ones.
    """
    import numpy as np

    names = sorted({name for student in students for name in student})
    if not names or len(students) < 2:
        return
    mm, right, alike, spread = np.full((4, len(students), len(names)), np.nan)
    for i, student in enumerate(students):
        for j, name in enumerate(names):
            if name in student:
                of = student[name]
                mm[i, j], right[i, j], alike[i, j], spread[i, j] = of.mm, of.right, of.alike, of.spread
    reach = np.array([max([CHANGED, *(s.step for s in student.values())]) for student in students]) + ROUNDING
    # pairs of other variants have no millimetres alike
    like = sum(int(((abs(right[i + 1 :] - own) <= CHANGED).sum(axis=1) >= FEWEST).sum()) for i, own in enumerate(right))
    least, least_wrong = (math.log(min(UNLIKELY_PAIR, ratio / max(like, 1))) for ratio in (SHARED, BY_WRONG))
    for i in range(len(students) - 1):
        apart = np.abs(mm[i + 1 :] - mm[i])
        both, same = np.isfinite(apart).sum(axis=1), (apart < ROUNDING).sum(axis=1)
        near = (apart <= np.maximum(reach[i + 1 :], reach[i])[:, None]).sum(axis=1)
        most, all_near = (same >= SAME * both) & (near >= AGREE * both), (same > SAME_OF_ALL * both) & (near == both)
        wrong = np.maximum(alike[i + 1 :], alike[i]) < 1.0
        agree = (same >= FEWEST) & (most | all_near)
        other_work = abs(right[i + 1 :] - right[i]) > CLEAR * np.fmax(spread[i + 1 :], spread[i])
        of_another = np.array([variant != variants[i] for variant in variants[i + 1 :]] or [False])
        copied = of_another & (((apart < ROUNDING) & other_work).sum(axis=1) >= FEWEST_OF_ANOTHER)
        for k in np.flatnonzero(copied | agree | ((wrong & (apart < ROUNDING)).sum(axis=1) >= FEWEST_WRONG)):
            other, said = int(i + 1 + k), np.flatnonzero(apart[k] < ROUNDING)
            one, two = students[i], students[other]
            rest = abs(right - right[i]) <= CHANGED  # of others under the same key
            rest[[i, other]] = False
            as_wrong = (rest & (abs(mm - mm[i]) <= WIDEST)).sum(axis=0) + np.maximum(alike[i], alike[other])
            common = np.where(wrong[k], np.maximum(as_wrong / (rest.sum(axis=0) + 1.0), ALIKE), 1.0)
            seen = (rest & (abs(mm - mm[i]) < ROUNDING)).sum(axis=0) / (rest.sum(axis=0) + DOUBT)
            both_have = [(j, n) for j, n in enumerate(names) if n in one and n in two]
            chances = {n: max(_chance(one[n], two[n], common[j]), min(seen[j], CERTAIN)) for j, n in both_have}
            by_wrong = sum(math.log(chances[names[j]]) for j in said if wrong[k, j])
            if copied[k] or by_wrong < least_wrong or (agree[k] and _likelihood(one, two, chances) < least):
                yield _Pair(i, other, tuple(names[j] for j in said), int(near[k]), int(both[k]))


def _chance(one: _Measured, other: _Measured, common: float) -> float:
    """Return the chance that two honest hands read the same step, where the mistake behind it is so `common`.

    It is step / (2 sqrt(pi) spread), of a segment that is nearly right much more: however good the hand, 0.242 step /
    deviation at the most, certain within half a step.
    """
    step, spread = max(one.step, other.step), min(max(one.spread, other.spread), WIDEST)
    return common * min(max(step / (2.0 * math.sqrt(math.pi) * spread), _most(one), _most(other)), CERTAIN)


def _likelihood(one: Mapping[str, _Measured], other: Mapping[str, _Measured], chances: Mapping[str, float]) -> float:
    """Return the logarithm of how much likelier two drawings agree as they do if both are honest than if one copies."""
    total = 0.0
    for name, same in chances.items():
        pair = one[name], other[name]
        step = max(s.step for s in pair)
        steps = max(round(CHANGED / step), 1)  # to either side
        near = min(2 * steps * same, 1.0 - FAR - same)
        apart = abs(pair[0].mm - pair[1].mm)
        if apart < ROUNDING:
            total += math.log(same / COPIED)
        elif apart <= steps * step + ROUNDING:
            total += math.log(near / (1.0 - FAR - COPIED))
        else:
            total += math.log((1.0 - same - near) / FAR)
    return total


def _most(segment: _Measured) -> float:
    """Return the largest chance that a hand, be it good or bad, reads what was read."""
    off = abs(segment.mm - segment.right)
    return BEST * segment.step / off if off > segment.step / 2.0 else 1.0


@dataclass(frozen=True, slots=True)
class Result:
    """One student: who, which variant, the mark (None where the answers could not be marked), verdicts, mistakes.

    `plans` are those that were read on photographs, `absent` those not handed in, which has cost nothing; `perhaps` are
    mistakes that these answers do not tell from the others, `slips` that only the hand may have slipped; `contradicts`
    what the answers say of student, task, variant or data that is not what the teacher has said; a `stranger` is in no
    place of the roster.
    """

    source: str
    who: Who
    variant: str = ""
    sheet: str = ""
    mark: float | None = None
    counts: Mapping[str, int] = field(default_factory=dict)
    first: str = ""
    mistakes: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    exact: bool = False
    segments: Mapping[str, _Measured] = field(default_factory=dict)
    reports: tuple[str, ...] = ()
    fits: str = ""
    plans: tuple[str, ...] = ()
    absent: tuple[str, ...] = ()
    perhaps: tuple[str, ...] = ()
    slips: bool = False
    contradicts: tuple[str, ...] = ()
    stranger: bool = False

    @property
    def student(self) -> tuple[Who, str] | str:
        """Who it is, namesakes told apart by their variants; the source where nobody is named."""
        return (self.who, self.variant) if self.who != Who() else self.source

    @property
    def empty(self) -> bool:
        """Whether the student stands in the list of a class and has answered nothing."""
        return self.mark is None and not self.notes

    def noted(self, language: str) -> tuple[str, ...]:
        """Return what is noted of this student, that nothing has been handed in, too."""
        return (
            (texts(language)["class.absent"],) if self.empty else tuple(spoken(note, language) for note in self.notes)
        )

    def flags(self, language: str) -> list[str]:
        """Return what a teacher should check of this student alone."""
        said = texts(language)
        exact = [said["flag.exact"]] if self.exact else []
        contradicts = [spoken(note, language) for note in self.contradicts]
        return [*contradicts, *exact, *([said["flag.variant"].format(variant=self.fits)] if self.fits else [])]

    def explained(self, language: str, numbered: bool = True) -> list[str]:
        """Return what explains the answers: mistakes in words, after their numbers, or how many it may be."""
        said, words = texts(language), mistake_texts(language)
        if self.slips or len(self.perhaps) > TOLD_APART:
            return [said["class.slips" if self.slips else "class.untold"].format(n=len(self.perhaps))]
        known, doubtful = (
            [f"{name}: " * numbered + words[name] for name in names] for names in (self.mistakes, self.perhaps)
        )
        return [said["class.or"].join((*known, *doubtful))] if doubtful else known

    @classmethod
    def from_json(cls, data: Mapping[str, Any]) -> Result:
        """Return a result from plain data.

        Raises
        ------
        KeyError, TypeError
            The data are none of a result.
        """
        segments = {name: _Measured(**of) for name, of in data["segments"].items()}
        lists = {name: tuple(data[name]) for name in LISTS}
        return cls(**{**data, "who": Who(**data["who"]), "segments": segments, **lists})


def result_of(marked: Marked, language: str) -> Result:
    """Return what is kept of a student who was marked."""
    key, first = marked.keyed, marked.marking.first_wrong
    follows = {line.name: abs(line.follows) for line in marked.marking.lines if line.follows == line.follows}
    ours, answers = marked.marking.key.paper.mus, marked.answers
    mus = {**ours}  # the student's scale factors, in whichever convention they are meant; ours where none is written
    for name, line in answers.lines.items():
        question = key.key.questions.get(name)
        mu = line.factor or answers.scales.get(key.scale_of(name, answers.scales))
        if question is not None and mu is not None and question.plan in ours:
            mus[question.plan] = mu.nearest(ours[question.plan])
    exact = marked.seen is not None  # as drawings of a computer are: that tells nothing of them
    told = {name for candidate in marked.candidates for name in candidate.explained}
    faulty = (line.name for line in marked.marking.lines if line.verdict.faulty)
    wrong = {name: KNOWN if name in told else ALIKE for name in faulty}
    segments = {} if exact else measured(answers, marked.marking.key, mus, follows, wrong)
    best = marked.candidates[0].mistakes if marked.candidates and not (marked.slips or marked.untold) else ()
    ids = marked.candidates[0].ids if marked.candidates and not marked.slips else frozenset[str]()
    return Result(
        answers.source,
        marked.entry.who if marked.entry else answers.who,
        key.solution.variant,
        answers.about.get("sheet", ""),
        marked.mark,
        {str(verdict): marked.count(verdict) for verdict in Verdict},
        "" if first is None else key.symbol(first),
        tuple(dict.fromkeys(broken.mistake for broken in best)),
        tuple(_told(note, language) for note in marked.notes if note.key not in CONTRADICTS),
        _too_exact(segments),
        segments,
        (),
        marked.fits,
        tuple(sorted({one.plan for one in marked.seen.recognised.vectors.values()})) if marked.seen else (),
        tuple(sorted(marked.absent)),
        tuple(sorted(ids - {broken.mistake for broken in best})),
        marked.slips,
        tuple(_told(note, language) for note in marked.notes if note.key in CONTRADICTS),
    )


def nothing(answers: Answers, entry: Entry | None, variant: str) -> Result:
    """Return what is kept of a student who stands in the list of a class and has answered nothing."""
    return Result(answers.source, entry.who if entry else answers.who, variant)


def _told(error: KulmanError, language: str, unread: bool = False) -> Told:
    """Return a note as tables have it, which a console says in its own language; of `unread` files that they are."""
    said = {known: error.text(known) for known in LANGUAGES}
    if unread:
        said = {known: texts(known)["class.unread"].format(reason=reason) for known, reason in said.items()}
    return Told(said, language)


def failed(answers: Answers, entry: Entry | None, error: KulmanError, language: str) -> Result:
    """Return what is kept of a student whose answers cannot be marked: why, and what else was odd in them."""
    # what another task asks is no problem of these answers
    problems = () if error.key == "marked-other-task" else answers.problems
    notes = (_told(error, language, bool(answers.unread)), *(_told(problem, language) for problem in problems))
    return Result(answers.source, entry.who if entry else answers.who, entry.variant if entry else "", notes=notes)


Lines: TypeAlias = Sequence[Result | Entry]  # of a class: who has handed in, and who has not


def marked_of(lines: Lines) -> list[Result]:
    """Return those of a class who have handed in."""
    return [line for line in lines if isinstance(line, Result)]


def names_of(lines: Lines, language: str) -> list[str]:
    """Return what the students of a class are called: namesakes with the record book, or the variant, or the file."""
    places = [spoken(line.source if isinstance(line, Result) else line.place, language) for line in lines]
    called = [line.who.student or place for line, place in zip(lines, places, strict=True)]
    often, found = Counter(called), list[str]()
    for name, line, place in zip(called, lines, places, strict=True):
        twins = [one for one, other in zip(lines, called, strict=True) if other == name]
        ways = (line.who.book, line.variant, place)
        apart = zip(ways, ([one.who.book for one in twins], [one.variant for one in twins], [""]), strict=True)
        told = next(way for way, all_of in apart if way and (all_of == [""] or all_of.count(way) == 1))
        found.append(f"{name} ({told})" if often[name] > 1 else name)
    return found


def twice(results: Iterable[Result]) -> dict[tuple[Who, str] | str, list[Result]]:
    """Return those who have several marks, with them."""
    found = dict[tuple[Who, str] | str, list[Result]]()
    for result in results:
        if result.mark is not None:
            found.setdefault(result.student, []).append(result)
    return {student: several for student, several in found.items() if len(several) > 1}


def shared_of(lines: Lines) -> Iterator[_Pair]:
    """Go through the pairs of a class whose segments agree as those of somebody who has copied."""
    return shared([line.segments if isinstance(line, Result) else {} for line in lines], [one.variant for one in lines])


def flags_of(lines: Lines, language: str) -> list[list[str]]:
    """Return for each student what a teacher should check: several marks, too exact segments, and shared ones."""
    said, names, several = texts(language), names_of(lines, language), twice(marked_of(lines))
    found = [line.flags(language) if isinstance(line, Result) else [] for line in lines]
    for line, flags in zip(lines, found, strict=True):
        if isinstance(line, Result) and line.mark is not None and line.student in several:
            others = (spoken(one.source, language) for one in several[line.student] if one is not line)
            flags.append(said["flag.twice"].format(files=", ".join(others)))
    for pair in shared_of(lines):
        for one, other in ((pair.first, pair.second), (pair.second, pair.first)):
            said_of = {"n": len(pair.names), "of": pair.of, "near": pair.near, "student": names[other]}
            found[one].append(said["flag.shared"].format(**said_of))
    return found


def commonest(lines: Lines) -> list[tuple[str, list[Result]]]:
    """Return the mistakes of a class with those who have made them, the commonest first."""
    by = dict[str, list[Result]]()
    for result in marked_of(lines):
        for name in result.mistakes:
            by.setdefault(name, []).append(result)
    return sorted(by.items(), key=lambda item: (-len(item[1]), item[0]))


def class_rows(lines: Lines, language: str) -> Iterator[tuple[Cell, ...]]:
    """Go through the rows of the table: a header, the students in their order, commonest mistakes.

    A number, an address and a code of the sheet have no column where nobody has any.
    """
    said = texts(language)
    told = [key for key in WHO if key not in ("number", "email") or any(getattr(line.who, key) for line in lines)]
    sheets = any(isinstance(line, Result) and line.sheet for line in lines)
    keys = (*(f"about.{key}" for key in (*told, "variant", *["sheet"] * sheets)), "class.mark")
    keys += tuple(f"verdict.{verdict}" for verdict in Verdict)
    keys += ("class.first", "report.candidates", "report.flags", "report.notes", "report.source", "class.report")
    yield heads(keys, language)
    for line, flags in zip(lines, flags_of(lines, language), strict=True):
        who = (*(getattr(line.who, key) for key in told), line.variant)
        if isinstance(line, Entry):
            absent = said["class.absent"], spoken(line.place, language)
            yield *who, *(None,) * (sheets + len(Verdict) + 4), *absent
            continue
        counts = tuple(line.counts.get(str(verdict)) for verdict in Verdict)
        about = (line.first, "; ".join(line.explained(language)), "; ".join(flags), "; ".join(line.noted(language)))
        kept = spoken(line.source, language), ", ".join(line.reports)
        yield *who, *[line.sheet] * sheets, line.mark, *counts, *about, *kept
    counted = commonest(lines)
    if counted:
        yield ()
        yield (said["class.commonest"],)
    for name, students in counted:
        yield (f"{name}: {mistake_texts(language)[name]}", len(students))


def moodle_rows(results: Sequence[Result], language: str) -> Iterator[tuple[Cell, ...]]:
    """Go through the rows of a file that Moodle's gradebook imports: whose it is, the grade, no right number.

    Who has several marks, or is not in the roster, has none there until the teacher has said which counts.
    """
    said, several = texts(language), twice(results)
    yield ("ID number", "Full name", "Email address", "Grade", "Feedback comments")
    for result in results:
        if result.mark is not None and not result.stranger and result.student not in several:
            who = result.who
            counts = (f"{said[f'verdict.{name}']} {count}" for name, count in result.counts.items() if count)
            first = said["class.feedback_first" if result.first else "report.no_wrong"].format(symbol=result.first)
            yield who.number or who.book, who.student, who.email, result.mark, f"{', '.join(counts)}. {first}"


def class_lines(lines: Lines, language: str) -> Iterator[str]:
    """Go through what is printed of a class: a line per student, what is noted of all of them, then the whole."""
    said, sign = texts(language), "." if language == "en" else ","
    names, results = names_of(lines, language), marked_of(lines)
    width = max(map(len, names), default=0)
    noted = [result.noted(language) for result in results if result.mark is not None]
    of_all = [note for note in noted[0] if all(note in notes for notes in noted)] if len(noted) > 1 else []
    for name, line, flags in zip(names, lines, flags_of(lines, language), strict=True):
        if isinstance(line, Entry):
            yield f"{name:{width}}  {'–':>5}  {said['class.absent']}"
            continue
        mark = "–" if line.mark is None else f"{line.mark:g}".replace(".", sign)
        missing, notes = line.counts.get(str(Verdict.MISSING), 0), line.noted(language)
        told = [line.first and said["class.feedback_first"].format(symbol=line.first)]
        told += [f"{said['verdict.missing']} {missing}"] if missing else []
        if line.mark is not None:  # else they say why there is no mark
            n = sum(note not in of_all for note in notes)
            notes = (said["class.notes"].format(n=n, file=spoken(line.source, language)),) if n else ()
        told += ["; ".join(line.explained(language)), *flags, *notes]
        yield f"{name:{width}}  {mark:>5}  {'  '.join(filter(None, told))}".rstrip()
    yield from (said["class.all"].format(note=note) for note in of_all)
    of_class = [line for line in lines if isinstance(line, Entry) or not line.stranger]
    marked = [line for line in of_class if isinstance(line, Result) and line.mark is not None]
    mean = sum(line.mark or 0.0 for line in marked) / max(len(marked), 1)
    students = {line.student if isinstance(line, Result) else id(line) for line in of_class}
    counts = {"n": len(students), "marked": len({line.student for line in marked})}
    strangers = said["class.strangers"].format(n=len(lines) - len(of_class))
    yield said["class.summary"].format(**counts, mean=f"{mean:.1f}".replace(".", sign)) + f"; {strangers}" * (
        len(lines) > len(of_class)
    )
