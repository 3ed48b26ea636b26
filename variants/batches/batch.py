"""A batch: the sheets of a class drawn on all cores into a folder, each whole; what is there already stays."""

from __future__ import annotations

import os
import re
import sys
import traceback
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, fields, replace
from functools import cached_property, partial
from operator import attrgetter
from pathlib import Path
from typing import Any, TypeAlias

from ...drawing.compose import Drawn
from ...drawing.formats import Norm, format_named
from ...drawing.notes.blocks import Block, Document
from ...drawing.notes.docx import Drawing, docx_bytes, drawings_of
from ...drawing.notes.typst import Body, pdf_bytes
from ...drawing.pdf import joined, on_leaves
from ...drawing.words import Words
from ...drawing.writers import WRITERS, folder_for, page_files, slug, sweep_parts, write_whole
from ...plans.quantities import measured
from ...scales.choices import SHEETS
from ...scales.errors import InputError, KulmanError, Written, messages, spoken, system_language
from ...scales.kept import Kept
from ...scales.names import all_known, by_name, names_of, of_its_kinds
from ...scales.numbers import SHOWN, quote
from ...scales.packaged import packaged
from ...scales.units import format_unit
from ...scales.version import __version__
from .. import sheets
from ..case import Case, Request, Settings, Wanted, plans_wanted
from ..crew import Advance, Begin, Done, Journal, digest_of, on_cluster, remove_stale, shared_out
from ..marking.wording import texts
from ..notes import body_of, title_page
from ..reader import load_task
from ..roster import WHO, Digits, Entry, Schemes, of_several_groups, read_roster, shared_books, shared_by_mistake
from ..sheets import BLOCK, PAPER, Sheet, drawing_for_print, drawing_of, said_of, sheet_id, sheet_of, stamp_of
from ..spreadsheets.grid import SUFFIXES
from ..tables import Cell, csv_table, save_form
from ..task import AnyTask, Task

MANIFEST, KEY = "manifest.csv", "key.csv"
Tasks: TypeAlias = "AnyTask | Sequence[AnyTask]"
NOTE, HANDOUT, CARD = "note", "handout", "card"
FOR_STUDENTS = {HANDOUT, CARD}  # beside which no solution stands: those have a folder of their own
SOLUTIONS = "solutions"
MERGED = {"pdf": "sheets.pdf", HANDOUT: "handouts.pdf", CARD: "cards.pdf"}  # of the whole class, by kind
KEPT = 32  # variants whose drawings a process keeps for the next students that have them
NOTES = {NOTE: ".pdf", "docx": ".docx"}
FORMS = (*SHEETS, *NOTES, HANDOUT, CARD)
_SUFFIXES = {*WRITERS, *NOTES.values()}
JOURNAL = ".kulman-batch.jsonl"
# a problem: file, column or the word for a row, its number, whose row it is, what it is
_PLACED = re.compile(r"(.+?: )([A-Z]{0,3}|\w+ (?=[0-9]+(, [^:]+)?))([0-9]+)(?:\3)?([:,] .+)", re.DOTALL)
_OWN = re.compile(rf"[0-9]{{3,}}-.+|(?:manifest|key)\b.*\.csv|{re.escape(JOURNAL)}")  # names of files of a batch


@dataclass(frozen=True, slots=True)
class Student:
    """A row of the roster, counted from 1."""

    number: int
    entry: Entry

    @property
    def data(self) -> tuple[str, str, tuple[tuple[str, str], ...]]:
        """What the work depends on: task, variant, data of one's own."""
        return self.entry.task, self.entry.variant, tuple(sorted(self.entry.settings.items()))


@dataclass(frozen=True, slots=True)
class Outcome:
    """The files of a student by name, the values of the key by quantity with its unit; or what the problem is.

    Of each file it says what that holds, once it is written a digest.
    """

    variant: str = ""
    sheet: str = ""
    files: Mapping[str, Any] = field(default_factory=dict)
    key: Mapping[str, float | None] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    problem: str = ""

    @classmethod
    def from_json(cls, data: Mapping[str, Any]) -> Outcome:
        """Return an outcome from plain data; those of something else are a `TypeError`, or lack keys."""
        if not isinstance(data["files"], dict):
            raise TypeError
        return cls(**{**data, "notes": tuple(data["notes"])})

    def there(self, folder: Path) -> bool:
        """Whether the files are in the folder as they were made; a problem is looked at again."""
        with suppress(OSError):
            return not self.problem and all(
                digest_of((folder / name).read_bytes()) == digest for name, digest in self.files.items()
            )
        return False


@dataclass(frozen=True, slots=True, repr=False)
class Batch:
    """The students of a class with what each has got, in the order of the roster; `warnings` are about the roster."""

    students: tuple[Student, ...]
    outcomes: tuple[Outcome, ...]
    warnings: tuple[InputError, ...] = ()

    def __repr__(self) -> str:
        """Return how many students there are, and how many of them have got nothing."""
        return f"<Batch: students: {len(self.students)}, problems: {len(self.problems)}>"

    @property
    def problems(self) -> list[str]:
        """Why students have got nothing, a line each."""
        return [outcome.problem for outcome in self.outcomes if outcome.problem]

    def whole(self, language: str) -> str:
        """Return how many students there are, and how many of them have got what they should."""
        n = len(self.students)
        return messages(language)["batch-done"].format(n=n, done=n - len(self.problems))

    @property
    def told(self) -> list[str]:
        """The same problems, in one line those that several students have: `class.csv: E3–E6, E9: no such variant`."""
        several = dict[tuple[str, str, str], dict[int, str]]()
        for problem in self.problems:
            found = _PLACED.fullmatch(problem)
            before, column, whose, row, after = found.groups("") if found else (problem, "", "", "", "")
            several.setdefault((before, column, after), {}).update({int(row): whose} if row else {})
        return [
            f"{before}{_spans([*rows], column)}{''.join(rows.values())}{after}"
            for (before, column, after), rows in several.items()
        ]


def _spans(rows: Sequence[int], column: str) -> str:
    """Return the places of cells of a column, of neighbours the first and the last; a word for a row stands once.

    >>> _spans([3, 4, 5, 9], "E"), _spans([3, 4, 5, 9], "row ")
    ('E3–E5, E9', 'row 3–5, 9')
    """
    word, column = (column, "") if column.endswith(" ") else ("", column)
    starts = [row for row in rows if row - 1 not in rows]
    ends = [row for row in rows if row + 1 not in rows]
    spans = (f"{column}{a}" + f"–{column}{b}" * (b > a) for a, b in zip(starts, ends, strict=True))
    return word + ", ".join(spans)


@dataclass(frozen=True)
class _Work:
    """What students with the same data share: all but the names; each part is made when it is first asked for."""

    case: Case
    on_blanks: bool  # whether students have blanks or cards before them, whatever stands in the folder of solutions

    @cached_property
    def drawing(self) -> Drawn:
        """The drawing of the sheet, which blanks and cards do without."""
        return drawing_of(self.case)

    @cached_property
    def body(self) -> tuple[Block, ...]:
        """The note after its first page."""
        return body_of(self.case, self.drawing)

    @cached_property
    def written(self) -> Body:
        """The same for a note as PDF."""
        return Body.of(self.body, self.case.language)

    @cached_property
    def drawings(self) -> list[Drawing]:
        """Its figures for a note as DOCX."""
        return drawings_of(self.body, self.case.language)

    @cached_property
    def blank(self) -> Drawn:
        """The drawing on the paper of handouts."""
        return drawing_for_print(replace(self.case, format=PAPER, norm="gost"))

    @cached_property
    def key(self) -> dict[str, float | None]:
        """The right values in the units in which they are shown, and the segments on what students have, mm.

        The names are those of the columns in which a class hands in its answers.
        """
        case, found = self.case, dict[str, float | None]()
        drawing = self.blank if self.on_blanks else self.drawing
        solved, _ = case.kind.fitted(case.solved, drawing)
        for name, quantity in measured(solved.quantities, solved.shown_on, drawing.scales).items():
            if quantity.kind != "point":
                shown = quantity.shown(case.display)
                unit = format_unit(shown.unit, case.language)
                found[f"{name} [{unit}]" if unit else name] = shown.value
                if quantity.mm is not None:
                    found[f"{name}.mm"] = quantity.mm
        return found


@dataclass(frozen=True, slots=True)
class _Making:
    """What is made for every student of a class: what is asked of each task, by its id; values of a row go before."""

    asked: Mapping[str, Request]
    kinds: tuple[str, ...]
    spoken: str = field(default_factory=system_language, compare=False)  # the language of messages
    scan: bool = False  # whether handouts have markers, to be photographed
    _works: Kept[_Work] = field(default_factory=partial(Kept, KEPT), init=False, repr=False, compare=False)

    @property
    def afresh(self) -> bool:
        """Whether processes for it must be no copies of this one: typst, once at work, stands still in a copy."""
        return NOTE in self.kinds and "typst" in sys.modules

    def begin(self) -> Callable[[Student], Outcome]:
        """Return what makes the files of a student."""
        return self.make

    @property
    def language(self) -> str:
        """The language of all that is made; messages are in `spoken`."""
        return next(iter(self.asked.values())).language

    def digests(self) -> dict[str, str]:
        """Return by task what tells this making from any that would make other files of the same student."""
        said = {
            name: [getattr(asked, item.name) for item in fields(asked) if item.name != "task"]
            for name, asked in self.asked.items()
        }
        how = __version__, self.kinds, len(self.asked) == 1, *((self.scan,) if self.scan else ())
        return {name: digest_of(repr((how, self.asked[name].task.text, *items))) for name, items in said.items()}

    def make(self, student: Student) -> Outcome:
        """Make the files of a student; what cannot be made is told, not raised."""
        entry = student.entry
        try:
            return self._made(student)
        except KulmanError as error:
            place = "" if error is entry.problem else f"{spoken(entry.place, self.spoken)}: "
            return Outcome(entry.variant, problem=f"{place}{error.text(self.spoken)}")
        except (KeyboardInterrupt, SystemExit):
            raise
        except BaseException as error:  # what typst panics with is no Exception
            source = traceback.extract_tb(error.__traceback__)[-1]
            name = quote(f"{type(error).__name__}: {error}".rstrip(": "), SHOWN)
            crash = InputError("student-crash", error=name, source=f"{Path(source.filename).name}:{source.lineno}")
            return Outcome(entry.variant, problem=f"{spoken(entry.place, self.spoken)}: {crash.text(self.spoken)}")

    def _made(self, student: Student) -> Outcome:
        who, work = student.entry.who, self._work(student)
        common = work.case.block
        block = {**common, "student": who.student, "group": who.group or common.get("group", "")}
        case = replace(work.case, block=block)
        of = {kind: kind if kind in FOR_STUDENTS else "" for kind in self.kinds}
        drawn = {own: self._drawn(work, case, own) for own in dict.fromkeys(of.values())}
        what = case.variant if len(self.asked) == 1 else f"{case.task.id} {case.variant}"
        stem = f"{student.number:03d}-{slug(f'{who.student} {what}')}"
        made = ((kind, self._files(work, case, drawn[own], kind, stem)) for kind, own in of.items())
        files = {f"{self.folder(kind)}{name}": data for kind, own in made for name, data in own}
        told = next(drawn[own] for own in ("", HANDOUT, CARD) if own in drawn).warnings
        notes = tuple(warning.text(self.spoken) for warning in told)
        return Outcome(case.variant, sheet_id(case.task, case.variant, case.settings), files, work.key, notes)

    def folder(self, kind: str = "") -> str:
        """Return where the files of a kind stand in that of the batch; without a kind the key, another solution."""
        return f"{SOLUTIONS}/" if FOR_STUDENTS & {*self.kinds} and kind not in FOR_STUDENTS else ""

    def _files(self, work: _Work, case: Case, drawn: Sheet, kind: str, stem: str) -> Iterator[tuple[str, bytes]]:
        """Go through the files of one kind: their names and what they hold."""
        if kind in NOTES:
            block = {name: text for name, text in case.block.items() if name not in ("designation", "work")}
            document = Document(title_page(replace(case, block=block)), work.body, case.language)
            data = pdf_bytes(document, work.written) if kind == NOTE else docx_bytes(document, work.drawings)
            yield f"{stem}-note{NOTES[kind]}", data
            return
        if kind in FOR_STUDENTS:
            stem, kind = f"{stem}-{kind}", "pdf"
        yield from ((path.name, data) for path, data in page_files(drawn.pages, Path(f"{stem}.{kind}")))

    def _drawn(self, work: _Work, case: Case, of: str) -> Sheet:
        """Return a blank or a card of a student, else the sheet."""
        if of not in FOR_STUDENTS:
            return sheet_of(case, work.drawing, stamp_of(case))
        blank = sheets.scannable_of_case if self.scan else sheets.begun_of_case
        return (blank if of == HANDOUT else sheets.card_of_case)(case, work.blank)

    def _work(self, student: Student) -> _Work:
        """Return what students with the same data share, from the last ones where it is there."""
        entry, data = student.entry, student.data
        if entry.problem is not None:
            raise entry.problem

        def make() -> _Work:
            asked = self.asked[entry.task]
            settings = {**(asked.settings or {}), **entry.settings}
            case = replace(asked, variant=entry.variant, settings=settings).case()
            return _Work(case, not FOR_STUDENTS.isdisjoint(self.kinds))

        return self._works.get(data, make)


Crew = Callable[[Begin[Student, Outcome], list[Student]], Iterator[list[Done[Outcome]]]]


def _run(
    making: _Making, students: Sequence[Student], folder: Path, crew: Crew, advance: Advance, merged: Collection[str]
) -> tuple[tuple[Outcome, ...], list[str]]:
    """Make what is not there yet; write it, and note it, as it comes; `merged` are files that are made of it later.

    Returned are what has been made, and the files of earlier runs that are gone.
    """
    for of_kinds in (folder, folder / SOLUTIONS):
        sweep_parts(of_kinds, lambda name: _OWN.match(name) is not None)
    journal = Journal(folder / JOURNAL, Outcome.from_json)
    of = making.digests()
    digests = [digest_of(f"{of.get(student.entry.task)} {student!r}") for student in students]
    found = {
        number: outcome
        for number, digest in enumerate(digests)
        if (outcome := journal.before.get(digest)) is not None and outcome.there(folder)
    }
    advance(len(found), len(students))
    todo = [number for number in range(len(students)) if number not in found]
    for done in crew(making.begin, [students[number] for number in todo]):
        for place, made in done:
            number = todo[place]
            found[number] = _kept(made, students[number], folder, making.spoken)
            journal.note(digests[number], found[number])
        advance(len(done), len(students))
    outcomes = tuple(found[number] for number in range(len(students)))
    before = (item for outcome in journal.before.values() for item in outcome.files.items())
    gone = remove_stale(folder, before, {*merged, *(name for outcome in outcomes for name in outcome.files)}, _SUFFIXES)
    journal.keep(zip(digests, outcomes, strict=True))
    return outcomes, gone


def _kept(made: Outcome | None, student: Student, folder: Path, language: str) -> Outcome:
    """Write what has been made for a student, but for what is there already; nothing means that a process died."""
    if made is None:
        reason = InputError("process-died").text(language)
        return Outcome(student.entry.variant, problem=f"{spoken(student.entry.place, language)}: {reason}")
    for name, data in made.files.items():
        _put(folder / name, data)
    return replace(made, files={name: digest_of(data) for name, data in made.files.items()})


def _put(path: Path, data: bytes) -> None:
    """Write a file whole, in a folder that may have to be made, unless it is there as it should be."""
    folder_for(path.parent)
    with suppress(OSError):
        if path.read_bytes() == data:
            return
    write_whole(path, data)


@of_its_kinds(*BLOCK)
def batch(
    task: Tasks,
    roster: str | os.PathLike[str],
    folder: str | os.PathLike[str],
    *,
    kinds: Wanted = ("svg", "pdf", NOTE),
    digits: int | str | None = None,
    set: Settings | None = None,
    only: Wanted = None,
    scales: Settings | None = None,
    format: str | None = None,
    norm: Norm = "gost",
    lettering: str = "gost",
    notation: str | None = None,
    lang: str = "uk",
    merge: bool = False,
    scan: bool = False,
    jobs: int | None = None,
    dask: str | None = None,
    advance: Advance | None = None,
    **block: str,
) -> Batch:
    """Draw the sheet of every student of a class.

    In the folder stand the files of every student, `manifest.csv`, which lists them, and `key.csv` with the right
    values, of several tasks one for each. A run that was stopped, or one with a longer roster, draws only what is
    missing or has changed.

    Parameters
    ----------
    task : str, PathLike, Task, or several of them
        Of several the first is scheme 1 of a record book; one may stand there more than once.
    set, only, scales, format, norm, lettering, notation, lang
        As for `sheet`; what the roster says of a student goes before `set`.
    roster : str or PathLike
        A .csv or .xlsx with a student in each row: name, group, variant or record book, givens of one's own; of several
        tasks also which, by id or number.
    folder : str or PathLike
        Where the files go; it is made where it is missing.
    kinds : sequence of str
        What each student gets: the sheet as `svg`, `pdf`, `png`, the `note`, also as `docx`, a blank `handout`, the
        task alone as a `card`. Beside the last two no solution stands: those have a folder of their own, `solutions`.
    digits : int or str, optional
        How many last digits of the record book give the variant, where the roster has none; or what each of them is
        for, from left to right: `"variant,scheme"`, which is usual where the roster names none of several tasks.
    merge : bool
        Write the sheets (`pdf`), handouts and cards of the class as one document each, too, in the order of the roster,
        to be printed on both sides: behind an odd number of pages of a student an empty one follows.
    scan : bool
        Add markers and a QR code to the handouts, as `handout` does.
    jobs : int, optional
        Processes; as many as there are cores when left out. With 1 all is done in this one, and dies with it.
    dask : str, optional
        The address of a Dask scheduler, whose workers do the work in the place of processes here.
    advance : callable, optional
        Told how many students more are done, and of how many.
    **block : str
        What is said in every title block: `teacher`, `department`, `designation`, `work`, `date`.

    Raises
    ------
    InputError
        The roster, or an argument, is at fault for all; or a file cannot be written: what is done stays.
    """
    tasks = _tasks(task)
    kinds = names_of("kinds", kinds)
    all_known("batch-kind", kinds, FORMS)
    if merge and not MERGED.keys() & {*kinds}:
        raise InputError("batch-merge", known=", ".join(MERGED))
    if scan and HANDOUT not in kinds:
        raise InputError("batch-scan")
    wanted = only if only is None or isinstance(only, str) else names_of("only", only)
    how = by_name("set", set), wanted, by_name("scales", scales), notation, lang, format, norm, block, lettering
    once = _once(tasks)
    making = _Making(
        {one.id: _asked_of(Request(one, None, *how)) for one in once}, tuple(dict.fromkeys(kinds)), scan=scan
    )
    schemes = Schemes(tasks, None if digits is None else Digits.of(digits))
    listed = read_roster(os.fspath(roster), schemes, each=True)
    students = tuple(Student(number, entry) for number, entry in enumerate(listed.entries, 1))
    place = folder_for(folder)
    alike = attrgetter("data")  # students with the same data share what is drawn
    if dask is not None:
        crew: Crew = partial(on_cluster, alike=alike, address=dask)
    else:  # an item may kill its process, which is not this one unless that is asked for
        alone = 0 if jobs != 1 else None
        crew = partial(shared_out, jobs=jobs or os.cpu_count() or 1, alike=alike, alone=alone, afresh=making.afresh)
    merged = {kind: f"{making.folder(kind)}{MERGED[kind]}" for kind in making.kinds if merge and kind in MERGED}
    outcomes, gone = _run(making, students, place, crew, advance or (lambda done, whole: None), merged.values())
    unread = Written(", ".join(quote(head, SHOWN) for head in listed.unread))
    # what was meant by columns that say nothing here has been left out
    error = InputError("roster-unread", file=quote(Path(roster).name, SHOWN), columns=unread)
    groups = of_several_groups(student.entry.who for student in students)
    doubled = [*shared_books((student.entry.who, student.entry.task) for student in students)]
    for one in once:  # a student may have a row for each of several tasks
        its = [student for student in students if len(once) == 1 or student.entry.task == one.id]
        of = f" ({one.id})" if len(once) > 1 else ""
        alike_in = (student.entry.variant if not student.entry.settings else "" for student in its)
        works = zip((student.entry.who for student in its), (work and f"{work}{of}" for work in alike_in), strict=True)
        doubled += shared_by_mistake(works, len(one.variants))
    nameless = sum(not student.entry.who.student for student in students)
    if 0 < nameless < len(students):  # an empty roster is drawn without names
        doubled.append(InputError("roster-nameless", n=nameless))
    twice = (InputError("batch-twice"),) if {*kinds} >= FOR_STUDENTS else ()
    removed = (InputError("batch-gone", n=len(gone), file=quote(gone[0], SHOWN)),) if gone else ()
    columns = (error,) if listed.unread else ()
    done = Batch(students, outcomes, (*listed.sheets, *columns, *doubled, *groups, *twice, *removed))
    for name, rows in _tables(done, once, lang):
        _put(place / (name if name == MANIFEST else f"{making.folder()}{name}"), csv_table(rows, lang))
    whole = dict[str, bytes]()
    for kind, name in merged.items():
        if files := [place / name for name in _of_kind(outcomes, kind)]:
            whole[name] = joined(on_leaves([file.read_bytes() for file in files]))
            _put(place / name, whole[name])
    if whole:  # a later run without them removes them
        noted = Outcome(files={name: digest_of(data) for name, data in whole.items()})
        Journal(place / JOURNAL, Outcome.from_json).note("merged", noted)
    return done


def _of_kind(outcomes: Iterable[Outcome], kind: str) -> Iterator[str]:
    """Go through the files of a kind that students have, in the order of the roster."""
    others = tuple(f"-{other}.pdf" for other in (*FOR_STUDENTS, NOTE))
    for file in (file for outcome in outcomes for file in outcome.files):
        own = file.endswith(f"-{kind}.pdf")
        if own if kind in FOR_STUDENTS else file.endswith(".pdf") and not file.endswith(others):
            yield file


def _tasks(said: Tasks) -> tuple[Task, ...]:
    """Return the tasks of a class in the order in which they are said."""
    several = said if isinstance(said, Sequence) and not isinstance(said, str) else (said,)
    return tuple(map(load_task, several))


def _once(tasks: Sequence[Task]) -> tuple[Task, ...]:
    """Return each task once, as the same one may be several schemes; two of the same id are refused."""
    found: dict[str, Task] = {}
    for task in tasks:
        if found.setdefault(task.id, task).text != task.text:
            raise InputError("batch-same-id", file=quote(task.file or task.id, SHOWN), id=quote(task.id))
    if not found:
        raise InputError("batch-nothing")
    return tuple(found.values())


def _asked_of(request: Request) -> Request:
    """Return what is asked of a task, by the names of its plans; what is wrong for every student alike is refused."""
    task, plans = request.task, None if request.only is None else plans_wanted(request.only, request.task)
    said_of(request.block)
    if request.format is not None:
        format_named(request.format)
    Words.of(request.language, task.notation if request.notation is None else request.notation)
    task.resolve(None, request.settings)
    return replace(request, only=plans)


def write_roster(task: Tasks, file: str | os.PathLike[str], lang: str = "uk") -> Path:
    """Write a roster to fill in, .csv or .xlsx: a row for each variant. As it is, each has a sheet without a name."""
    tasks = _once(_tasks(task))
    said, alone = texts(lang), len(tasks) == 1
    head = tuple(said[f"about.{key}"] for key in ("student", "group", *(() if alone else ("task",)), "variant"))
    rows = [head, *(("", "", *(() if alone else (one.id,)), name) for one in tasks for name in one.variants)]
    return save_form(file, SUFFIXES, rows, lang, tasks[0].id, [0], 1)


def _tables(batch: Batch, tasks: Sequence[Task], language: str) -> Iterator[tuple[str, list[tuple[Cell, ...]]]]:
    """Go through the tables of a class: the names of their files, and their rows.

    The manifest lists who has which variant, sheet and files, or what the problem is. The key of a task has every right
    value of those who have that one, in the columns in which a class hands in its answers.
    """
    said, about, several = packaged(__package__, "texts", language), texts(language), len(tasks) > 1
    head = tuple(about[f"about.{key}"] for key in (*WHO, *(("task",) if several else ()), "variant", "sheet"))
    students = []
    for student, outcome in zip(batch.students, batch.outcomes, strict=True):
        who, task = student.entry.who, (student.entry.task,) if several else ()
        students.append(((*(getattr(who, key) for key in WHO), *task, outcome.variant, outcome.sheet), outcome, task))
    made = [(*row, ", ".join(got.files), got.problem or "; ".join(got.notes)) for row, got, _ in students]
    yield MANIFEST, [(*head, said["files"], said["notes"]), *made]
    for one in tasks:
        own = [(row, got.key) for row, got, task in students if not several or task == (one.id,)]
        names = tuple(dict.fromkeys(name for _, key in own for name in key))
        rows = [(*head, *names), *((*row, *(key.get(name) for name in names)) for row, key in own)]
        yield f"{Path(KEY).stem}-{slug(one.id)}.csv" if several else KEY, rows
