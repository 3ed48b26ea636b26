"""One student's answers marked: which variant it is, verdicts, mistakes that explain them, the mark, oddities."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from pathlib import Path
from statistics import median
from typing import TYPE_CHECKING, Any

from ...plans.marking.answers import Answer, Line, Verdict
from ...plans.marking.drawn import Recognised
from ...plans.marking.key import Key, hanging_on
from ...plans.marking.verdicts import CLEAR, Marking, bounded, count_right, first_wrong, mark
from ...plans.mistakes.explaining import Candidate, explain
from ...plans.names import LEVER
from ...scales.errors import InputError, KulmanError, Spoken
from ...scales.kept import Kept, kept_in
from ...scales.numbers import SHOWN, quote
from ...scales.packaged import packaged
from ..case import Request, Settings, plans_wanted
from ..crew import digest_of
from ..roster import Digits, Entry, Roster, variant_of_book
from ..sheets import same_id, sheet_id, task_of_id, variant_of_id
from ..shelf import bundled
from ..task import LocatedError, Task
from .cells import Asked, Mu
from .keyed import DATA, PLANS, Keyed, Rubric, data_said, is_arm_of_lever, keyed
from .reading import Answers, Reply, apart
from .seen import Seen, measured, seen
from .wording import plain

if TYPE_CHECKING:
    from ..photos.reading import Sheets

NEAR = 0.05  # part by which values over segments may differ from one another
TELLING = 3  # lines that must tell that a scale factor is not theirs
SHORT = 2.0  # mm; shorter segments are read too coarsely to tell
FEWEST = 4  # answers that must be right under the key of another variant
MANY, MOST = 0.5, 0.8  # parts of the answers: not right under one's own key; that agree, or are right under the other
INSET = 5.0  # mm; longer segments are read on their plan
STRANGE = 0.25  # part of the answers that a task does not ask for, which with another task's name are for that
TOLD_APART = 2  # mistakes that are told together
READ = 1.0  # mm that reading a photograph may miss of a segment
KEPT, BLANKS = 32, 8  # answer keys; handouts that were photographed
READ_KEPT = 400_000_000  # bytes of a class's photographs that have been read


@dataclass(frozen=True, slots=True)
class Terms:
    """How answers to a task are marked; `own` makes reports for students, without right numbers.

    What has been read of photographs is kept in the folder `photographs`, if there is one, for who marks after asking.
    """

    request: Request
    rubric: Rubric
    asked: Asked
    roster: Roster | None = None
    digits: int | str | Digits = 1
    own: bool = False
    photographs: Path | None = None

    def entry_of(self, answers: Answers) -> Entry | None:
        """Return the place of a student in the roster, if there is one."""
        return self.roster.find(answers.who, answers.about.get("variant", "")) if self.roster else None


@dataclass(frozen=True, slots=True)
class Misfit:
    """A scale factor as written and the one that segments and values fit, SI per mm; `names` are their quantities."""

    symbol: str
    written: float
    fits: float
    names: tuple[str, ...]


def _misfits(answers: Answers, key: Keyed) -> Iterator[Misfit]:
    """Go through the scale factors in rows of their own that do not fit what stands under them.

    The values must be nearer to the right ones than the segments times the factor: where the values are wrong, it is
    they that were calculated wrongly.
    """
    by_symbol: dict[str, list[tuple[str, float, float]]] = {}
    for line in answers.lines.values():
        symbol, mm = key.scale_of(line.name, answers.scales), line.mm or 0.0
        if symbol in answers.scales and line.factor is None and mm >= SHORT and line.value:
            by_symbol.setdefault(symbol, []).append((line.name, mm, line.value))
    for symbol, lines in by_symbol.items():
        mu, most = answers.scales[symbol], MOST * len(lines)
        shown = [abs(value) / mm for _, mm, value in lines]
        fits = median(shown)
        agree = sum(abs(one - fits) <= NEAR * fits for one in shown)
        if agree >= max(TELLING, most) and all(abs(way - fits) > 2.0 * NEAR * fits for way in mu.ways):
            written = mu.nearest(fits)
            sizes = ((value, mm * written, abs(key.key[name])) for name, mm, value in lines)
            nearer = sum(not right or apart(value, right) < apart(by_mm, right) for value, by_mm, right in sizes)
            if nearer >= most:
                yield Misfit(symbol, written, fits, tuple(name for name, *_ in lines))


def _counted_once(
    marking: Marking, found: Iterable[Misfit], counted: Collection[str], foreign: Collection[str]
) -> tuple[Marking, dict[str, Misfit]]:
    """Return the marking with each misfit as an error of the first line that it concerns; and the misfits by lines.

    One of the lines `counted`, of which the mark is made, must bear the error. So has a line with a `foreign` unit.
    """
    bearers: dict[str, Misfit] = {}
    for misfit in found:
        names = [line.name for line in marking.lines if line.name in misfit.names]
        bearers[next((name for name in names if name in counted), names[0])] = misfit
    wrong = {*bearers, *foreign}
    if not wrong:
        return marking, bearers
    lines = tuple(
        replace(line, verdict=Verdict.SCALE, about="size") if line.name in wrong and line.verdict.passed else line
        for line in marking.lines
    )
    return replace(marking, lines=lines, first_wrong=first_wrong(lines, marking.marker)), bearers


def _borne_where_asked(marking: Marking, asked: Collection[str]) -> Marking:
    """Return the marking in which an error of a line that is not asked is one of the first line asked that carries it.

    It would count nowhere: whoever has all numbers wrong from one error before would have full marks.
    """
    bits, places = hanging_on(marking.key), marking.key.paper.program.places
    carried = [line.name for line in marking.lines if line.name in asked and line.verdict is Verdict.CARRIED]
    borne: dict[str, Verdict] = {}
    for line in marking.lines:
        if line.verdict.faulty and line.name not in asked:
            bearer = next((name for name in carried if bits[line.name] >> places[name] & 1), "")
            borne.setdefault(bearer, Verdict.SCALE if line.verdict is Verdict.SCALE else Verdict.WRONG)
    lines = (
        replace(line, verdict=borne[line.name], about="size") if line.name in borne else line for line in marking.lines
    )
    return replace(marking, lines=tuple(lines))


def _fits_other(marking: Marking, given: Sequence[Answer], others: Iterable[str], key: Callable[[str], Key]) -> str:
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


@dataclass(frozen=True, slots=True)
class Marked:
    """A student's answers, marked.

    `lines` are those that count, `parts` what part of the full mark each is; `notes` say what was odd: cells that could
    not be read, another variant, another id; `misfits` are scale factors written wrongly, each by the line at which it
    counts; `fits` is another variant that the answers fit, if any; `seen` is what was recognised on a drawing,
    `sheets` the photographs that it was read from, `absent` plans that were not handed in, which costs nothing.
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
    seen: Seen | None = None
    sheets: Sheets | None = None
    absent: frozenset[str] = frozenset()

    @property
    def slips(self) -> bool:
        """Whether all that is wrong is measured, and misses by so little that only the hand may have slipped."""
        faulty = [line for line in self.marking.lines if line.verdict.faulty]
        questions = self.marking.key.questions
        small = (line.verdict is Verdict.WRONG and line.off <= CLEAR for line in faulty)
        return bool(faulty) and all(small) and all(questions[line.name].step.verb != "calc" for line in faulty)

    @property
    def untold(self) -> bool:
        """Whether the answers fit so many mistakes, or are so few, that none of these can be named."""
        best = self.candidates[0].ids if self.candidates else ()
        return len(best) > TOLD_APART or (len(best) > 1 and len(self.marking.answered) < TELLING)

    def count(self, verdict: Verdict) -> int:
        """Return how many lines have a verdict."""
        return sum(line.verdict is verdict for line in self.lines)


def _other_task(task: Task, answers: Answers) -> str:
    """Return the other task that answers are for: what their file says, or whose sheet id it has; else nothing.

    A head that somebody has edited names no task that there is, and what is answered is asked here. Where the sheet id
    is none of this task's, either, both are of a task file that is not the one given.
    """
    written, sheet = answers.about.get("task", ""), answers.about.get("sheet", "")
    if written.casefold() == task.id.casefold() or (sheet and variant_of_id(task, sheet)):
        return ""
    strange = sum(problem.key.startswith("quantity-unknown") for problem in answers.problems)
    known = next((name for name in bundled() if name.casefold() == written.casefold()), "")
    known = known or (sheet and task_of_id(sheet)) or ""
    elsewhere = (sheet and not written.isdigit()) or strange > STRANGE * (strange + len(answers.lines))
    return written if not known and elsewhere else known


def variant_of(terms: Terms, answers: Answers, entry: Entry | None) -> tuple[str, list[KulmanError]]:
    """Return the variant that a student has, by roster, file or record book; and what contradicts it.

    Raises
    ------
    InputError
        The answers are for another task; the record book has no such digits; the student's row of the roster is wrong;
        there is a roster without the student, and nothing else tells the variant.
    """
    task, about, notes = terms.request.task, answers.about, list[KulmanError]()
    if other := _other_task(task, answers):
        raise InputError("marked-other-task", text=quote(other), task=quote(task.id))
    if entry is not None and entry.problem is not None:
        raise entry.problem
    stranger = terms.roster.stranger(answers.who, answers.source) if terms.roster and entry is None else None
    notes += [stranger] if stranger else []
    written, said = about.get("task", ""), about.get("variant", "")
    if written and not written.isdigit() and written.casefold() != task.id.casefold():  # a number may be any task's
        notes.append(InputError("marked-task", text=quote(written), task=quote(task.id)))
    book = answers.who.book or (entry.who.book if entry else "")
    with suppress(InputError):
        said = task.variant(said).id if said else ""

    def by_book() -> str:
        return variant_of_book(task, book, terms.digits) if book else ""

    found = (entry.variant or by_book()) if entry else ""
    found = found or str(terms.request.variant or "") or (said if said in task.variants else "") or by_book()
    found = found or variant_of_id(task, about.get("sheet", "")) or ""
    if not found:
        if stranger and len(task.variants) > 1:  # held against anybody's data, they would be wrong
            raise stranger
        found = next(iter(task.variants))
        notes += [InputError("marked-no-variant", variant=quote(found))] if len(task.variants) > 1 else []
    if said and said != found:
        notes.append(InputError("marked-variant", text=quote(said), variant=quote(found)))
    return found, notes


class Desk:
    """Where answers are marked: keys are made once for each variant with its data."""

    def __init__(self, terms: Terms) -> None:
        self.terms = terms
        self._keys = Kept[Keyed](KEPT)
        self._blanks, self._sheets = Kept[Any](BLANKS), Kept[Any](1)

    def keyed(self, variant: str, settings: Settings, own: bool = True, only: tuple[str, ...] | None = None) -> Keyed:
        """Return the key of a variant, or of `only` some of its plans; the last few are kept.

        One that is not the student's `own` has the scale factors of the rule: no sheet is drawn for it, whatever format
        is asked for, and answers are compared at the scale factors to which they were drawn.
        """
        request = self.terms.request if own else replace(self.terms.request, format=None)
        request = request if only is None else replace(request, only=only)
        name = (variant, request.format, only, *sorted(settings.items()))
        return self._keys.get(name, lambda: keyed(request, variant, settings, self.terms.rubric))

    def photographed(self, answers: Answers, key: Keyed) -> tuple[Sheets, Seen]:
        """Read the photographs of a student; the last ones are kept: what is asked of them, and marks, are of one.

        Raises
        ------
        InputError
            They cannot be read.
        """
        from ..photos.reading import photographed

        if (answers.photos, key) not in self._sheets:
            self._sheets = Kept(1)  # those of another student are large, and go before these come

        def read() -> tuple[Sheets, Seen]:
            return photographed(answers.photos, self.terms.request, key, self._blanks)

        def again() -> tuple[Sheets, Seen]:
            about = (key.sheet, *key.key.questions, *(digest_of(photo.picture) for photo in answers.photos))
            folder = self.terms.photographs
            return read() if folder is None else kept_in(folder, digest_of(repr(about).encode()), READ_KEPT, read)

        found: tuple[Sheets, Seen] = self._sheets.get((answers.photos, key), again)
        return found

    def of(self, answers: Answers) -> tuple[Entry | None, Keyed, list[KulmanError]]:
        """Return a student's place in the roster and answer key, and what contradicts what the answers say of it.

        Raises
        ------
        InputError, PositionError
            The student's variant or data have no answer key.
        """
        entry = self.terms.entry_of(answers)
        variant, notes = variant_of(self.terms, answers, entry)
        only, told = _plans_of(self.terms, answers)
        settings, of_data = _data_of(self.terms, answers, entry, variant)
        key, notes = self.keyed(variant, settings, only=only), notes + told + of_data
        if all(note.key != "marked-data-other" for note in of_data):  # which the sheet id only says once more
            notes += _other_sheet(self.terms, answers.about.get("sheet", ""), key)
        return entry, key, notes

    def mark(self, answers: Answers) -> Marked:
        """Mark the answers of one student.

        Raises
        ------
        InputError, PositionError
            The student's variant or data have no answer key, or the file could not be read.
        """
        if answers.unread is not None:
            raise answers.unread
        terms, rubric = self.terms, self.terms.rubric
        entry, key, notes = self.of(answers)
        variant, settings = key.solution.variant, key.solution.case.settings
        others = [other for other in terms.request.task.variants if other != variant][: KEPT - 1]
        on_drawing, sheets, absent = None, None, frozenset[str]()
        if answers.photos:
            from ..photos.reading import directed

            sheets, on_drawing = self.photographed(answers, key)
            if not sheets.pages:  # none could be read: why is told, not that nothing is drawn
                raise sheets.notes[0]
            notes += sheets.notes
            on_drawing = surely(answers, key, sheets, on_drawing, rubric)
            gone = dict.fromkeys(sheets.bare(), "photo-bare")
            if not any(one.key.startswith("photo-") for one in answers.problems):  # or the page may be the unread one
                gone |= dict.fromkeys(sheets.absent({photo.number for photo in answers.photos}), "photo-no-page")
            said = terms.request.only or rubric.asked or answers.plans is None  # what is asked for
            absent = frozenset() if said else frozenset(gone) - (answers.plans or frozenset())
            gone |= dict.fromkeys(absent, "photo-not-asked")
            answers, told = measured(replace(answers, drawn=sheets.drawn), key, on_drawing, gone)
            # what was not read is looked at by eye, and costs nothing; plans that are asked for must be handed in
            read = directed(answers.lines, key, rubric.tolerance.degrees)
            kept = tuple(
                name
                for name in answers.columns
                if name in read or name in answers.told or key.key.questions[name].plan in gone.keys() - absent
            )
            answers = replace(answers, columns=kept, lines=read)
            notes += told
        elif answers.drawn is not None:
            on_drawing = seen(answers.drawn, key, others, lambda other: self.keyed(other, settings, own=False))
            answers, told = measured(answers, key, on_drawing)
            notes += told
        answers, told = _as_on_the_sheet(answers, key)
        notes += told
        found = tuple(_misfits(answers, key))
        given, undefined = _given(answers, key, {misfit.symbol: misfit.fits for misfit in found})
        given = [rubric.compared(answer, key.key.questions[answer.name]) for answer in given]
        marking, candidates = mark(key.key, given), tuple[Candidate, ...]()
        if marking.first_wrong is not None:
            candidates, marking = explain(key.book if on_drawing is None else key.drawn, marking)
        names: Collection[str] = rubric.asked or answers.columns
        names = names or {q.name for part in key.parts for q in part.asked}
        if on_drawing is not None:  # which shows no more than vectors
            names = tuple(name for name in answers.columns if name in names)
        own = not (rubric.asked or answers.columns)  # whoever is asked for the whole form may answer more

        def counted() -> tuple[Line, ...]:
            return tuple(line for line in marking.lines if line.name in names or (own and line.answer is not None))

        foreign = {line.name for line in answers.lines.values() if any(line.foreign)}
        marking, borne = _counted_once(marking, found, {line.name for line in counted()}, foreign)
        fits = on_drawing.fits if on_drawing else ""
        fits = fits or _fits_other(marking, given, others, lambda other: self.keyed(other, settings, own=False).key)
        marking = bounded(marking, self.keyed(fits, settings, own=False).key if fits else None)
        marking = _borne_where_asked(marking, rubric.asked) if rubric.asked else marking
        lines = counted()
        if rubric.asked:  # what else was answered may explain, but nobody has asked for it
            marking = replace(marking, first_wrong=first_wrong(lines, marking.marker))
        parts = rubric.parts(lines, key.by_plan, key.needed)
        vectors = [line.answer for line in lines if line.answer is not None and isinstance(line.right, complex)]
        notes += undefined
        untold = len(vectors) > 1 and all(answer.direction is None for answer in vectors)
        notes += [InputError("marked-directions")] if untold and rubric.directions != "ignored" else []
        halved = sum(map(rubric.halves, lines))
        notes += [InputError("marked-halved", n=halved)] if halved else []
        mark_of, all_notes = rubric.mark(lines, parts), (*answers.problems, *notes)
        return Marked(
            answers, entry, key, marking, candidates, lines, mark_of, parts, all_notes, borne, fits, on_drawing, sheets,
            absent,
        )  # fmt: skip


def surely(answers: Answers, key: Keyed, sheets: Sheets, found: Seen, rubric: Rubric) -> Seen:
    """Return what is sure of photographs: what was read, without vectors that are wrong by no more than reading misses.

    What somebody has told is as it was told.
    """
    from ..photos.reading import settled

    if found.recognised.vectors:
        found = _without_doubt(replace(answers, drawn=sheets.drawn), key, found, rubric)
    return settled(sheets, key, found, answers.told) if answers.told else found


def _without_doubt(answers: Answers, key: Keyed, found: Seen, rubric: Rubric) -> Seen:
    given, _ = _given(measured(answers, key, found)[0], key, {})
    marking = mark(key.key, [rubric.compared(answer, key.key.questions[answer.name]) for answer in given])
    read = found.recognised
    doubtful = {
        line.name
        for line in marking.lines
        if line.verdict.faulty and line.about == "size" and line.answer is not None and line.answer.mm
        for mu in [found.mus[read.vectors[line.name].plan]]
        if any(abs(line.answer.mm - abs(x) / mu) <= line.allowed / mu + READ for x in (line.right, line.follows))
    }
    sure = {name: one for name, one in read.vectors.items() if name not in doubtful}
    return replace(found, recognised=Recognised(read.plans, sure, (*read.missing, *sorted(doubtful))))


class _PlanNames(Spoken):
    """The ids of plans with commas between, which a message says in its language."""

    __slots__ = ()

    def said(self, language: str) -> str:
        """Return what the plans are called; in English they are their ids."""
        words = packaged("kulman.drawing", "texts", language)
        return ", ".join(words.get(f"hand.plan.{plan}", plan) for plan in self.split(", "))


def _plans_of(terms: Terms, answers: Answers) -> tuple[tuple[str, ...] | None, list[KulmanError]]:
    """Return the plans that a form says it is for, unless those named for marking are the same; and what is told."""
    written, marked = answers.about.get(PLANS, ""), terms.request.only
    try:
        plans = plans_wanted(written, terms.request.task) if written else None
    except InputError as error:
        return None, [error]
    if plans is None or set(plans) == {*(marked or ())}:
        return None, []
    said = {"plans": _PlanNames(", ".join(plans)), "marked": _PlanNames(", ".join(marked or ()))}
    return None if marked else plans, [InputError("marked-plans-other" if marked else "marked-plans", **said)]


def _data_of(terms: Terms, answers: Answers, entry: Entry | None, variant: str) -> tuple[Settings, list[KulmanError]]:
    """Return the data that a student has besides those named for marking, and what is told of them.

    Those of the roster, else those named for marking, else those that the form says it is for.
    """
    written, own = answers.about.get(DATA, ""), entry.settings if entry else {}
    if not written:
        return own, []
    task, marked = terms.request.task, {**(terms.request.settings or {}), **own}
    try:
        said = data_said(written)
        same = sheet_id(task, variant, said) == sheet_id(task, variant, marked)
    except KulmanError as error:
        raise LocatedError(f"{answers.source}, {quote(written)}", error) from error
    if same:
        return own, []
    note = InputError("marked-data-other" if marked else "marked-data", text=quote(written, SHOWN))
    return (own if marked else said), [note]


def _other_sheet(terms: Terms, written: str, key: Keyed) -> list[KulmanError]:
    """Say where the sheet id is that of another sheet."""
    if not written or same_id(written, key.sheet):
        return []
    other, own = variant_of_id(terms.request.task, written), quote(key.solution.variant)
    if other is None:
        return [InputError("marked-sheet", text=quote(written), variant=own)]
    return [InputError("marked-sheet-variant", text=quote(written), variant=quote(other), own=own)]


def _given(answers: Answers, key: Keyed, fits: Mapping[str, float]) -> tuple[list[Answer], list[KulmanError]]:
    """Return the answers for marking, each with the scale factor of its plan; and those that have no right value.

    Where a factor is written wrongly in its row, `fits` has the one that the answers were worked out with.
    """
    given, notes = list[Answer](), list[KulmanError]()
    for line in answers.lines.values():
        if line.name in key.key.questions:
            symbol, own = key.scale_of(line.name, answers.scales), line.factor
            written = own or answers.scales.get(symbol)
            mu = None if written is None else fits.get(symbol, written.value) if own is None else own.value
            elsewhere = own is None and _on_other_drawing(line, symbol, answers, key)
            times = 1.0 if elsewhere else _times(line, symbol, answers, key)
            mm = None if elsewhere or line.mm is None else line.mm / times
            given.append(replace(line, mm=mm, mu=mu if own is None or mu is None else mu * times))
        else:
            notes.append(InputError("marked-undefined", place=line.place, text=line.name))
    return given, notes


def _as_on_the_sheet(answers: Answers, key: Keyed) -> tuple[Answers, list[KulmanError]]:
    """Return answers with the sheet's own scale factor of the lever where its arms fit that; and what is told of it.

    The velocity plan's is meant by who has turned that plan, and writes no other.
    """
    own, by_scale = key.solution.solved.scale_of_figure.get(LEVER, ""), dict[str, list[float]]()
    for line in answers.lines.values():
        of_plan = key.scale_of(line.name, answers.scales)
        if own and own not in answers.scales and line.mm and line.factor is None and is_arm_of_lever(line.name):
            right, written = abs(key.key.values.get(line.name, 0.0)), answers.scales.get(of_plan)
            sheets = key.solution.scales[own].mu
            for mu, by in ((written.nearest(sheets) if written else sheets, of_plan), (sheets, own)):
                by_scale.setdefault(by, []).append(apart(line.mm * mu, right))
    off = {symbol: median(found) for symbol, found in by_scale.items()}
    if own not in off or off[own] > min([NEAR, *(other for symbol, other in off.items() if symbol != own)]):
        return answers, []
    scale = key.solution.scales[own]
    note = InputError("marked-scale", symbol=key.symbol(own), text=plain(key.words.scale(scale)))
    return replace(answers, scales={**answers.scales, own: Mu(scale.mu, True)}), [note]


def _times(line: Reply, symbol: str, answers: Answers, key: Keyed) -> float:
    """Return how many times as large as on its plan a segment was measured: where it fits better.

    In a detail, or on the figure of the driver, as the sheet shows it.
    """
    shown, scale, mm = key.solution.quantities[line.name], key.solution.scales.get(symbol), line.mm
    if not mm or scale is None or shown.scale is None or not shown.mm or is_arm_of_lever(line.name):
        return 1.0
    times, own = scale.mu / key.solution.scales[shown.scale].mu, answers.scales.get(symbol)
    if times == 1.0 and shown.mm < INSET:
        times = key.magnified.get(line.name, 1.0)
    mu = own.nearest(scale.mu) if own else scale.mu
    if line.factor is not None:  # beside the segment, that of the detail itself
        factor = line.factor.nearest(mu / times)
        return times if abs(factor * times - mu) <= NEAR * mu else 1.0
    value = abs(line.value if line.value is not None else key.key[line.name])
    return min((times, 1.0), key=lambda by: apart(mm * mu / by, value)) if value else 1.0


def _on_other_drawing(line: Reply, symbol: str, answers: Answers, key: Keyed) -> bool:
    """Whether a segment is that of the drawing on which the sheet shows it, and not of the plan that finds it.

    The scale factor of that drawing, the student's or else the sheet's, then makes its value of it.
    """
    shown = key.solution.quantities[line.name].scale
    if not line.mm or not line.value or shown is None or shown == symbol:
        return False
    own = answers.scales.get(shown)
    mu = own.nearest(abs(line.value) / line.mm) if own else key.solution.scales[shown].mu
    return abs(line.mm * mu - abs(line.value)) <= NEAR * abs(line.value)
