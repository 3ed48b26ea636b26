"""A task about to be marked: what is asked, how answers are marked, for whom; empty forms out, marks back.

A class is marked on all cores: reports whole or not at all, and what a killed run has finished is not done again.
"""

from __future__ import annotations

import json
import os
import re
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from itertools import count
from pathlib import Path

from ...drawing.formats import format_named
from ...drawing.writers import Files, folder_for, save_all, slug, write_whole
from ...plans.quantities import Quantity
from ...scales.errors import InputError, KulmanError
from ...scales.kept import seldom_collected
from ...scales.names import by_name, names_of, of_its_kinds, unknown
from ...scales.numbers import SHOWN, quote
from ...scales.version import __version__
from ..case import Request, Settings, Wanted, plans_wanted
from ..crew import Advance, Journal, digest_of, remove_stale, shared_out
from ..reader import load_task
from ..roster import (
    Digits,
    Entry,
    Schemes,
    Who,
    collated,
    of_several_groups,
    read_roster,
    shared_books,
    shared_by_mistake,
)
from ..sheets import sheet_id
from ..shelf import bundled
from ..spreadsheets.grid import SUFFIXES as TABLES
from ..tables import csv_table, save_form, table_bytes
from ..task import Task
from .class_page import PAGE, ClassPage
from .keyed import DATA, PLANS, asked_of, class_header, columns_of, data_text, form_rows, fullest, read_rubric, solved
from .marked import Desk, Terms, variant_of
from .reading import Answers, answers_of, drawn_together, read_all, stem_of
from .report import REPORTS, Report
from .result import Result, class_rows, failed, moodle_rows, nothing, result_of
from .wording import texts

PathLike = str | os.PathLike[str]
JOURNAL = ".kulman-check.jsonl"
REPORTS_NOTED = ".kulman-reports.json"  # which reports of a folder are the program's own
RETURNED = ".pdf"  # of sheets that were photographed, with verdicts over them
Item = tuple[int, Answers]


@dataclass(frozen=True, slots=True, repr=False)
class Check(Terms):
    """How answers to a task are marked, and what is done so."""

    def __repr__(self) -> str:
        """Return task, variant and how many quantities may be answered."""
        of = f"{self.request.task.id} {self.request.variant or ''}".strip()
        return f"<Check {of}: {len(self.asked.quantities)} quantities>"

    def form(self) -> tuple[list[tuple[str, ...]], dict[str, tuple[str, ...]]]:
        """Return the rows of the empty form of one student, and which columns each answer has (scale factors: mu)."""
        key = Desk(self).keyed(fullest(self.request), {})
        about = {"task": self.request.task.id, "variant": str(self.request.variant or "")}
        if self.request.settings:
            about[DATA] = data_text(key.solution.case, self.request.settings)
            about["sheet"] = key.sheet if self.request.variant else ""
        if self.request.only is not None:
            about[PLANS] = ", ".join(self.request.only)
        scales = dict.fromkeys((name for part in key.parts for name in part.scales), ("mu",))
        answers = {question.name: columns_of(question) for part in key.parts for question in part.asked}
        return [*form_rows(key, about, self.rubric.asked)], scales | answers

    @of_its_kinds()
    def write_form(self, file: PathLike) -> Path:
        """Write the empty form, .csv or .xlsx: of one student, or with a roster of the whole class.

        Raises
        ------
        InputError
            A kind of file that is no form, or a place where none can be written.
        """
        task, language = self.request.task, self.request.language
        if self.roster is not None:
            key, shared = Desk(self).keyed(fullest(self.request), {}), self.request.settings or {}
            own = [DATA] if shared or any(entry.settings for entry in self.roster.entries) else []
            who = ("student", "group", "book", "number", "variant", "sheet", *own)
            rows = [class_header(key, who, self.rubric.directions != "ignored", self.rubric.asked)]
            for entry in self.roster.entries:  # the sheet id is for them to copy
                settings, data = {**shared, **entry.settings}, ""
                with suppress(KulmanError):  # told where the student is marked
                    asked = replace(self.request, variant=entry.variant or None, settings=settings)
                    data = data_text(asked.case(), settings) if settings else ""
                told = (*(getattr(entry.who, name) for name in who[:4]), entry.variant, "")
                rows.append((*told, *[data] * len(own)))
            bold, frozen = [0], 1
        else:
            rows, _ = self.form()
            columns = texts(language)["column.name"]
            head = next(number for number, row in enumerate(rows) if row[0] == columns)
            bold = [n for n, row in enumerate(rows) if n >= head and (len(row) == 1 or row[0] == columns)]
            frozen = head + 1
        return save_form(file, TABLES, rows, language, task.id, bold, frozen)

    @of_its_kinds()
    def read(self, *names: PathLike, warn: Callable[[KulmanError], None] | None = None) -> list[Answers]:
        """Read the answers in files, folders, patterns.

        Parameters
        ----------
        warn : callable, optional
            Told of each file that cannot be read, if there are others; it then has answers with `unread`, no mark
            and a row in the tables. Without it such a file raises its error.

        Raises
        ------
        InputError
            Nothing can be read.
        """
        found = read_all([os.fspath(name) for name in names], self.request.task.id, self.asked, warn)
        often, sheets = Counter(one.source for one in found if one.photos), dict[str, list[Entry]]()
        if self.roster is not None and max(often.values(), default=1) > 1:
            for entry in self.roster.entries:
                with suppress(KulmanError):  # whose data are none of the task: told where the student is marked
                    sheets.setdefault(sheet_id(self.request.task, entry.variant, entry.settings), []).append(entry)
        named = [self._named(one, sheets if often[one.source] > 1 else {}) for one in found]
        named = [*drawn_together(named, self.entry_of)]
        return named if warn is None else [*self._once(named, warn)]

    def _once(self, found: Iterable[Answers], warn: Callable[[KulmanError], None]) -> Iterator[Answers]:
        """Go through answers without copies: files of one student in which the same stands."""
        kept = dict[tuple[object, str], Answers]()
        for one in found:
            entry = self.entry_of(one)
            lines = {name: replace(line, place="") for name, line in one.lines.items()}
            said = replace(one, source="", who=Who(), lines=lines, problems=()).digest
            first = kept.setdefault((one.who if entry is None else id(entry), said), one)
            if first is one or one.unread or one.source == first.source or (entry is None and one.who == Who()):
                yield one
            else:
                warn(InputError("answers-twice", file=quote(one.source, SHOWN), first=quote(first.source, SHOWN)))

    def _named(self, answers: Answers, sheets: Mapping[str, Sequence[Entry]]) -> Answers:
        """Return answers with whose drawing it is: the name of the file is that of a student, or of a record book.

        So it is of a file that cannot be read, of a form in which nobody is named; Moodle writes more behind a name.

        In a stack the id of the sheet tells, where one student alone has it.
        """
        form = answers.drawn is None and not answers.photos and not answers.unread
        alone = Path(answers.source).suffix.lower() in TABLES  # no row of a class
        if self.roster is None or (form and (replace(answers.who, group="") != Who() or not alone)):
            return answers
        same = sheets.get(answers.about.get("sheet", "").upper(), ())
        stem = Path(answers.source).stem
        of_moodle = re.split(r"_[0-9]+_assignsubmission_", stem)[0]
        ways = stem, of_moodle, re.sub(r"^[0-9]{3}-", "", stem), stem_of(answers.source)
        names = [*(" ".join(re.split(r"[\s_-]+", name)).strip() for name in ways), *ways]
        group = answers.who.group
        known = (self.roster.find(Who(group=group, **{k: n})) for n in names for k in ("student", "book", "number"))
        entry = same[0] if len(same) == 1 else next(filter(None, known), None)
        if entry is None:
            return answers if form or answers.unread else replace(answers, who=Who(student=names[0]))
        return replace(answers, who=entry.who)

    def absent(self, answers: Iterable[Answers]) -> list[Entry]:
        """Return the students of the roster who have handed in nothing."""
        found = {id(self.entry_of(one)) for one in answers}
        return [entry for entry in self.roster.entries if id(entry) not in found] if self.roster else []

    @property
    def warnings(self) -> tuple[InputError, ...]:
        """What a teacher should know of the roster: wrong rows, what several students have, who is left out."""
        entries = self.roster.entries if self.roster else ()
        wrong = (entry.problem for entry in entries if entry.problem is not None)
        books = shared_books((entry.who, entry.task) for entry in entries)
        students = ((entry.who, "" if entry.settings else entry.variant) for entry in entries)
        possible = 0 if self.request.variant else len(self.request.task.variants)
        groups = of_several_groups(entry.who for entry in entries)
        others = [task for task in (self.roster.elsewhere if self.roster else ()) if task not in bundled()]
        named = [InputError("roster-elsewhere", tasks=quote(", ".join(others), SHOWN))] if others else []
        sheets = self.roster.sheets if self.roster else ()
        return (*sheets, *wrong, *books, *shared_by_mistake(students, possible), *groups, *named)

    def ordered(self, answers: Iterable[Answers]) -> list[Answers]:
        """Return answers in the order of the roster; those of strangers, and all without one, by their names."""
        places = {id(entry): place for place, entry in enumerate(self.roster.entries)} if self.roster else {}
        language = self.request.language

        def place(one: Answers) -> tuple[int, object, str]:
            entry = self.entry_of(one)
            return places.get(id(entry), len(places)), collated(one.who.student, language), one.source

        return sorted(answers, key=place)

    def listed(self, answers: Iterable[Answers], results: Iterable[Result]) -> list[Result | Entry]:
        """Return the results, with those of the roster who have handed in nothing at their places between them."""
        if self.roster is None:
            return [*results]
        found, strangers = dict[int, list[Result | Entry]](), list[Result | Entry]()
        for one, result in zip(answers, results, strict=True):
            entry = self.entry_of(one)
            (strangers if entry is None else found.setdefault(id(entry), [])).append(result)
        lines = (found.get(id(entry), [entry]) for entry in self.roster.entries)
        return [*(line for several in lines for line in several), *strangers]

    def mark(self, answers: Answers | Mapping[str, Quantity | str | float]) -> Report:
        """Mark one student: answers that have been read, or values by quantity, `{"V_B": "2,03 m/s"}`, numbers in SI.

        A `Solution` may stand for them, too: what is asked of it.

        Raises
        ------
        InputError, PositionError
            The variant or its data have no answer key.
        """
        if not isinstance(answers, Answers):
            answers = answers_of(by_name("answers", answers), self.asked)
        return reported(Desk(self), answers)[0]

    def mark_all(
        self,
        answers: Sequence[Answers],
        folder: PathLike | None = None,
        advance: Advance | None = None,
        jobs: int | None = None,
    ) -> list[Result]:
        """Mark a class, in its order.

        Parameters
        ----------
        folder : str or PathLike, optional
            Where reports on every student go, .html and .txt; sheets that were photographed as .pdf, too.
        advance : callable, optional
            Told how many students more are done, and of how many.
        jobs : int, optional
            Processes; as many as there are cores when left out.

        Raises
        ------
        InputError
            A report cannot be written.
        """
        place = None if folder is None else str(folder_for(folder))
        return _mark_class(Job(self, place), answers, advance or (lambda done, whole: None), jobs)


def reported(desk: Desk, answers: Answers) -> tuple[Report, Result]:
    """Mark one student, and return what is said of it and what is kept."""
    terms, marked = desk.terms, desk.mark(answers)
    language = terms.request.language
    result = result_of(marked, language)
    return Report(marked, terms.rubric, language, terms.own, result.flags(language)), result


@of_its_kinds()
def check(
    task: PathLike | Task,
    variant: str | int | None = None,
    *,
    set: Settings | None = None,
    only: Wanted = None,
    scales: Settings | None = None,
    preset: str = "normal",
    rubric: PathLike | None = None,
    directions: str | None = None,
    roster: PathLike | None = None,
    schemes: Wanted = None,
    digits: int | str | None = None,
    own: bool = False,
    notation: str | None = None,
    lang: str | None = None,
    format: str | None = None,
) -> Check:
    """Make ready to mark the answers to a task.

    Parameters
    ----------
    task, set, only, scales, notation, lang
        As for `solve`.
    variant : str, optional
        That of all answers; without it the roster, the record book or the answers say which.
    preset : str
        What may be missed by hand: `cad`, `careful`, `normal`, `lenient`.
    rubric, roster : str or PathLike, optional
        Files with weights, worths, tolerances; and with the students of a class.
    directions : str, optional
        `required`: a vector without its direction, a moment or an angular velocity without its sense is worth half;
        `optional`: what is said of them is compared; `ignored`: sizes alone are. In the place of what the rubric says;
        without either `optional`.
    schemes : str or sequence of str, optional
        The tasks of the class in their order, ids or files, where the roster or the record book gives their numbers.
    digits : int or str, optional
        How many last digits of the record book give the variant, where the roster has none; or what each of them is
        for, such as `"variant,scheme"`, which is usual where the roster names none of several `schemes`.
    own : bool
        Make reports for students, in which no right number stands.
    format : str, optional
        `A4`, `A3`, `A2`, `A1`: on what is drawn; the scale factors, and what is measured, are those of its sheet.

    Raises
    ------
    InputError
        Task, roster or rubric cannot be read, or name what there is not.

    >>> from kulman import check
    >>> asked = check("nau-slider-crank", "example", lang="en")
    >>> [asked.mark(answers).mark for answers in asked.read("printed")]
    [80.9]
    """
    of = load_task(task)
    wanted = None if variant is None else of.variant(variant).id
    if format is not None:
        format_named(format)
    of_class = tuple(map(load_task, names_of("schemes", schemes, once=False)))
    tasks = Schemes(of_class or (of,), None if digits is None else Digits.of(digits), bool(of_class))
    if of.id not in tasks.ids:
        raise unknown("task-other", of.id, tasks.ids)
    plans, language = None if only is None else plans_wanted(only, of), "en" if lang is None else lang
    request = Request(of, wanted, by_name("set", set), plans, by_name("scales", scales), notation, language, format)
    unformatted = replace(request, variant=fullest(request), format=None)  # the same is asked on every format
    solution = solved(unformatted)
    asked, whole = asked_of(solution), solution if plans is None else solved(replace(unformatted, only=None))
    others = frozenset(asked_of(whole).names).difference(asked.names)
    asked = replace(asked, others=others, unasked=frozenset(whole.quantities).difference(asked.names))
    marking = read_rubric(None if rubric is None else os.fspath(rubric), preset, asked, directions)
    students = None if roster is None else read_roster(os.fspath(roster), tasks, each=True, of=of)
    problems = [entry.problem for entry in students.entries] if students is not None else []
    if problems and problems[0] is not None and all(problems):  # the list of another task
        raise problems[0]
    return Check(request, marking, asked, students, tasks.digits_of(""), own)


@dataclass(frozen=True, slots=True)
class Job:
    """What is done for every student of a class: how answers are marked, and where reports go, if anywhere."""

    terms: Terms
    folder: str | None = None

    def begin(self) -> Callable[[Item], Result]:
        """Set up, and return what marks a student, who comes with a number."""
        desk = Desk(self.terms)
        return lambda item: _mark_one(self, desk, *item)

    def numbers(self, answers: Iterable[Answers]) -> list[int]:
        """Return the number of each student in names of reports, from 0: the place in the roster, or one after."""
        entries = self.terms.roster.entries if self.terms.roster else ()
        places, others = {id(entry): place for place, entry in enumerate(entries)}, count(len(entries))
        found = (places.pop(id(self.terms.entry_of(one)), None) for one in answers)
        return [next(others) if place is None else place for place in found]

    def names(self, answers: Sequence[Answers]) -> list[str]:
        """Return for each student what tells this job from any that would mark or say something else."""
        terms, request = self.terms, self.terms.request
        asked = (request.variant, request.settings, request.only, request.scales, request.notation)
        parts = (__version__, request.task.text, *asked)
        own = (request.language, request.format, terms.rubric, terms.digits, terms.own, tuple(REPORTS))
        whole, told = digest_of(repr((parts, own))), ((one, terms.entry_of(one)) for one in answers)
        numbered = zip(self.numbers(answers), told, strict=True)
        return [digest_of(f"{whole} {number} {one.digest} {entry!r}") for number, (one, entry) in numbered]


def _mark_class(job: Job, answers: Sequence[Answers], advance: Advance, jobs: int | None) -> list[Result]:
    """Mark all students of a class, in their order, as `Check.mark_all` says.

    Of photographs, a plan that was read of one student is asked of all: who has not handed in its page is marked anew.
    """
    folder = None if job.folder is None else Path(job.folder)
    journal = None if folder is None else Journal(folder / JOURNAL, Result.from_json)
    if sum(bool(one.photos) for one in answers) > 1:
        answers = [replace(one, plans=frozenset()) if one.photos else one for one in answers]
    results = _each_marked(job, answers, {}, journal, advance, jobs)
    plans = frozenset(plan for result in results for plan in result.plans)
    asked = [plans.intersection(result.absent) for result in results]
    if any(asked):
        answers = [replace(one, plans=lost) if lost else one for one, lost in zip(answers, asked, strict=True)]
        done = {number: result for number, result in enumerate(results) if not asked[number]}
        results = _each_marked(job, answers, done, journal, lambda more, whole: None, jobs)
    if journal and folder:
        journal.finish()
        _tidy(folder, {name for result in results for name in result.reports})
    return results


def _each_marked(
    job: Job,
    answers: Sequence[Answers],
    found: dict[int, Result],
    journal: Journal[Result] | None,
    advance: Advance,
    jobs: int | None,
) -> list[Result]:
    """Mark those of a class who are not among the `found`."""
    names, language = job.names(answers) if journal else [], job.terms.request.language
    if journal and job.folder:
        for number, name in enumerate(names):  # what an earlier run made of the same answers, if its reports are there
            before = journal.before.get(name)
            if before is not None and all((Path(job.folder) / report).is_file() for report in before.reports):
                found.setdefault(number, before)
    advance(len(found), len(answers))
    left = [number for number in range(len(answers)) if number not in found]
    of_reports = job.numbers(answers)
    todo = [(of_reports[number], answers[number]) for number in left]
    with seldom_collected():  # keys are many objects
        for done in shared_out(job.begin, todo, jobs or os.cpu_count() or 1, lambda item: _variant(job.terms, item[1])):
            for number, student, result in ((left[place], todo[place][1], one) for place, one in done):
                entry = job.terms.entry_of(student)
                stranger = entry is None and job.terms.roster is not None
                # where there is none, the student's answers have killed the process that marked them
                made = result or failed(student, entry, InputError("process-died"), language)
                found[number] = replace(made, stranger=stranger)
                if journal and result:
                    journal.note(names[number], found[number])
            advance(len(done), len(answers))
    return [found[number] for number in range(len(answers))]


def _variant(terms: Terms, answers: Answers) -> str:
    """Return the variant of a student: those of one go to one process, one after the other, and share its key."""
    try:
        return variant_of(terms, answers, terms.entry_of(answers))[0]
    except KulmanError:
        return ""


def _mark_one(job: Job, desk: Desk, number: int, answers: Answers) -> Result:
    """Mark a student and write the reports; answers that cannot be marked are a result, too."""
    if not (answers.lines or answers.problems or answers.unread or answers.drawn or answers.photos):
        return nothing(answers, job.terms.entry_of(answers), _variant(job.terms, answers))
    try:
        report, result = reported(desk, answers)
    except KulmanError as error:
        return failed(answers, job.terms.entry_of(answers), error, job.terms.request.language)
    if job.folder is None:
        return result
    stem = f"{number + 1:03d}-{slug(result.who.student or Path(answers.source).stem)}"
    kinds = (*REPORTS, RETURNED) if answers.photos else tuple(REPORTS)
    for kind in kinds:
        for path, data in report.files(Path(job.folder) / f"{stem}{kind}"):
            write_whole(path, data)
    return replace(result, reports=tuple(f"{stem}{kind}" for kind in kinds))


def _tidy(folder: Path, names: set[str]) -> None:
    """Remove the reports that the run before has written there and this one has not; note those of this one.

    Only what the note names, and only if nobody has changed it since, is removed: it is the program's own.
    """
    noted, before = folder / REPORTS_NOTED, dict[str, str]()
    with suppress(OSError, ValueError, TypeError):
        before = dict(json.loads(noted.read_text(encoding="utf-8")))
    remove_stale(folder, before.items(), names, (*REPORTS, RETURNED))
    with suppress(OSError):  # a folder that takes no note keeps its reports
        now = {name: digest_of((folder / name).read_bytes()) for name in sorted(names)}
        write_whole(noted, (json.dumps(now, indent=0) + "\n").encode("ascii"))


def write_tables(
    check: Check, results: Sequence[Result], answers: Sequence[Answers], files: Sequence[Path], moodle: Path | None
) -> None:
    """Write the tables of a class, and as .html one page about it."""
    language, task = check.request.language, check.request.task.id
    lines = check.listed(answers, results)
    rows = list(class_rows(lines, language))

    def table(path: Path) -> Files:
        if path == moodle:
            return [(path, csv_table(list(moodle_rows(results, language)), language, ","))]
        if path.suffix.lower() == PAGE:
            by_result = {id(result): one for one, result in zip(answers, results, strict=True)}
            page = ClassPage(
                check.request, check.rubric, lines, lambda result: check.mark(by_result[id(result)]).marked
            )
            return [(path, page.html().encode("utf-8", "replace"))]
        return [(path, table_bytes(path, rows, language, task, [0], 1))]

    save_all((*files, *filter(None, (moodle,))), (*TABLES, PAGE), table)
