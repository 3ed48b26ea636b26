"""What the processes of a server make of requests: sheets, notes, forms, verdicts, classes; each by the usual call.

They work in an empty folder, where what is uploaded is written under names of ours, and nothing of a request is a path.
"""

from __future__ import annotations

import re
import shutil
import zipfile
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from html import escape
from pathlib import Path
from typing import Any

from ...drawing.moving import html
from ...drawing.svg import svg_text
from ...drawing.words import Words
from ...drawing.writers import SUFFIXES as DRAWN
from ...drawing.writers import slug
from ...scales.errors import InputError, KulmanError, Written
from ...scales.kept import Kept
from ...scales.numbers import SHOWN, quote
from ...scales.packaged import packaged
from ..batches.batch import batch, write_roster
from ..case import Kind, Request, kind_of
from ..charts.charts import chart
from ..crew import Advance, shared_out
from ..kinds import MODULES
from ..making.questions import bare_page
from ..making.starter import start
from ..marking.checks import RETURNED, Check, check, reported, write_tables
from ..marking.class_page import PAGE
from ..marking.keyed import COLUMNS
from ..marking.marked import Desk, Terms
from ..marking.reading import SUFFIXES as ANSWERS
from ..marking.reading import Answers
from ..marking.report import PHOTOS, report_html
from ..marking.result import class_lines
from ..notes import note
from ..photos.asking import Asking, EndAsk, PageAsk, Told, ends_asked, gathered
from ..photos.returned import stacked
from ..reader import check_file, load_task
from ..roster import read_roster
from ..sheets import BESIDE, BLOCK, Sheet, draw_case, handout, sheet
from ..shelf import bundled
from ..solution import solve
from ..spreadsheets.files import read_grid
from ..spreadsheets.grid import LOOKED_AT, about_kind
from ..spreadsheets.grid import SUFFIXES as TABLES
from ..sweeps.sweeps import sweep
from ..tables import csv_table
from ..task import LocatedError, Task, decoded
from .jobs import KEPT as KEEP

OWN, FORMS = "task.toml", Path("forms")  # in the folder of the process
_OURS = re.compile(rf"\b{FORMS}/([0-9]{{3,}})-[\w-]*(?:\.\w+)?")
ZIP = ".zip"
LETTERS = ("format", "notation", "only")
OF_CYCLE = ("notation", "only")
HOW = (*LETTERS, "norm")
TITLED = "student", "group", "teacher", "department", "date"  # of the title page of a note
POSITIONS = 12  # of the sheet of a cycle
LAST = 4  # sheets that a process keeps, for other kinds of files of them
FIGURES = ("profile", "plate_profile", "meshing", "scheme")  # of subjects that have no scheme: the first that there is
Rows = tuple[tuple[str, ...], ...]


@dataclass(frozen=True, slots=True)
class Asked:
    """What a page is about: a bundled task by its id, or the text of one's own, and what is said of it besides.

    `settings` are what stands in the fields of givens that showed the variant `of`: what differs from that one's is
    one's own.
    """

    task: str
    own: bytes = b""
    variant: str = ""
    of: str = ""
    settings: tuple[tuple[str, str], ...] = ()
    how: tuple[tuple[str, str], ...] = ()  # format, norm, notation, plans
    block: tuple[tuple[str, str], ...] = ()
    language: str = "uk"

    def load(self) -> Task:
        """Return the task."""
        if not self.own:
            return load_task(self.task)
        Path(OWN).write_bytes(self.own)
        return load_task(Path(OWN))


@dataclass(frozen=True, slots=True)
class GivenField:
    """A given as a form shows it: name, symbol and meaning as HTML, unit, words to choose among, values."""

    name: str
    symbol: str
    unit: str
    choices: tuple[tuple[str, str], ...]
    usual: str
    value: str


@dataclass(frozen=True, slots=True)
class Shown:
    """What a page about a task shows: the task, its fields, a drawing or why there is none, what should be known."""

    id: str
    title: str
    note: str
    variants: tuple[str, ...]
    variant: str
    own: tuple[tuple[str, str], ...]  # settings that are not the variant's
    fields: tuple[GivenField, ...]
    moves: bool
    read: bool  # whether its plans are read from photographs
    plans: tuple[tuple[str, str], ...]  # names of its own, and what they are called
    pages: tuple[bytes, ...] = ()
    problem: KulmanError | None = None
    warnings: tuple[KulmanError, ...] = ()


@dataclass(frozen=True, slots=True)
class Upload:
    """A file as it came: only the letters of its name count."""

    name: str
    data: bytes

    def put(self, number: int, known: Sequence[str]) -> str:
        """Write it under a name of ours and return that; one of another kind than those known is refused.

        It is so with its `number` of the files that were sent, from 1, by which `as_sent` finds the name again.
        """
        suffix = Path(self.name).suffix.lower()
        if suffix not in known:
            key = {TABLES: "answers-suffix", ANSWERS: "answers-kind"}.get((*known,), "output-suffix")
            raise InputError(key, file=quote(self.name, SHOWN), known=", ".join(known))
        FORMS.mkdir(exist_ok=True)
        file = FORMS / f"{number:03d}-{slug(Path(self.name).stem)}{suffix}"
        file.write_bytes(self.data)
        return file.as_posix()


def as_sent(text: str, sent: Sequence[Upload], written: Callable[[str], str] = str) -> str:
    """Return a text with the names of files as they were sent, as its kind has them `written`, in the place of ours."""

    def name(ours: re.Match[str]) -> str:
        number = int(ours[1])
        return written(sent[number - 1].name) if 0 < number <= len(sent) else ours[0]

    return _OURS.sub(name, text)


def _settled(asked: Asked, task: Task) -> tuple[tuple[str, str], ...]:
    """Return what is set otherwise than the variant has it whose givens the form showed."""
    usual = _written(task, asked.of or None, asked.language)
    return tuple((name, text) for name, text in asked.settings if text and text != usual.get(name))


def _written(task: Task, variant: str | None, language: str) -> dict[str, str]:
    """Return the givens of a variant as the fields of a form show them."""
    written = {}
    for name, value in task.resolve(variant).items():
        unit = task.givens[name].unit
        text = value if isinstance(value, str) else f"{value if unit is None else unit.from_si(value):.12g}"
        written[name] = text if isinstance(value, str) or language == "en" else text.replace(".", ",")
    return written


def _request(asked: Asked, task: Task, *names: str) -> dict[str, Any]:
    """Return the arguments that all calls have in common, and what is said of those that some have."""
    said = {name: text for name, text in (*asked.how, *asked.block) if name in names}
    return {"variant": asked.variant or None, "set": dict(_settled(asked, task)), "lang": asked.language, **said}


_SHEETS: Kept[Sheet] = Kept(LAST)


def _of(asked: Asked, function: Callable[..., Any], *names: str, **how: Any) -> Any:
    task = asked.load()
    return function(task, **_request(asked, task, *names), **how)


def _sheet(asked: Asked) -> Sheet:
    task = asked.load()
    return _SHEETS.get(asked, lambda: sheet(task, **_request(asked, task, *HOW, *BLOCK)))


def _handout(asked: Asked, **how: Any) -> Sheet:
    drawn: Sheet = _of(asked, handout, *HOW, *BLOCK, **how)
    return drawn


def _check(asked: Asked, **more: Any) -> Check:
    ready: Check = _of(asked, check, *LETTERS, **more)
    return ready


# what can be downloaded, by the stem of its name: saved under a name
SAVED: Mapping[str, Callable[[Asked, str], list[Path]]] = {
    **dict.fromkeys(("sheet", "moving"), lambda asked, name: _sheet(asked).save(name)),
    "handout": lambda asked, name: _handout(asked).save(name),
    "scan": lambda asked, name: _handout(asked, scan=True).save(name),
    "key": lambda asked, name: _handout(asked, key=True).save(name),
    "positions": lambda asked, name: _of(asked, sheet, *HOW, *BLOCK, positions=POSITIONS).save(name),
    "note": lambda asked, name: _of(asked, note, *LETTERS, *TITLED).save(name),
    "results": lambda asked, name: _of(asked, solve, *LETTERS).save(name),
    "cycle": lambda asked, name: _of(asked, sweep, *OF_CYCLE).save(name),
    "charts": lambda asked, name: _of(asked, chart, *OF_CYCLE).save(name),
    "form": lambda asked, name: [_check(asked).write_form(name)],
    "roster": lambda asked, name: [write_roster(asked.load(), name, asked.language)],
}
KINDS: Mapping[str, tuple[str, ...]] = {
    "sheet": DRAWN,
    "moving": BESIDE,
    "handout": DRAWN,
    "scan": (".pdf", ".png", ".svg"),
    "key": DRAWN,
    "positions": DRAWN,
    "note": (".pdf", ".docx", ".md"),
    "results": (".xlsx", ".csv", ".json"),
    "cycle": (".xlsx", ".csv", ".json"),
    "charts": (".pdf", ".svg"),
    "form": (".xlsx", ".csv"),
    "roster": (".xlsx", ".csv"),
}


def made(advance: Advance, asked: Asked, stem: str, suffix: str) -> tuple[str, bytes]:
    """Return a file of what is asked, with its name; several are one archive."""
    files = SAVED[stem](asked, f"{stem}{suffix}")
    if len(files) == 1:
        return files[0].name, files[0].read_bytes()
    return f"{stem}{ZIP}", _zipped(files, Path(f"{stem}{ZIP}")).read_bytes()


def _zipped(files: Sequence[Path], archive: Path, folder: Path = Path()) -> Path:
    """Write files into an archive, which is the same for the same files."""
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as packed:
        for file in files:
            packed.writestr(zipfile.ZipInfo(file.relative_to(folder).as_posix()), file.read_bytes(), packed.compression)
    return archive


def _name_as_sent(files: Iterable[Path], sent: Sequence[Upload]) -> None:
    """Let reports and tables speak of the files that were sent by their names."""
    kinds: Mapping[str, Callable[[str], str]] = {".html": escape, ".txt": str, ".csv": str}
    for file in files:
        if written := kinds.get(file.suffix):
            file.write_bytes(as_sent(file.read_bytes().decode("utf-8"), sent, written).encode("utf-8"))


def shown(advance: Advance, asked: Asked, answers: bool) -> Shown:
    """Return what a page about a task shows: its sheet, or where no `answers` may be seen its handout."""
    task = asked.load()
    variant = task.variant(asked.variant or None).id
    asked = replace(asked, variant=variant)
    own, language = _settled(asked, task), asked.language
    usual, words = _written(task, variant, language), Words.of(language, task.notation)
    fields = tuple(
        GivenField(
            name,
            words.choice(name, "")[0] if given.choices else html(words.symbol(name)),
            words.spelled(given.unit.name) if given.unit is not None else "",
            tuple((word, words.choice(name, word)[1]) for word in given.choices),
            usual.get(name, ""),
            dict(own).get(name, usual.get(name, "")),
        )
        for name, given in task.givens.items()
    )
    moves = type(kind_of(task.kind)).moving is not Kind.moving
    read, told = MODULES[task.kind] == "linkage", (task.title[language], task.note_in(language))
    called = packaged(f"{Kind.home}.drawing", "texts", language)
    plans = tuple((plan, called.get(f"hand.plan.{plan}", plan)) for plan in task.plans)
    about = Shown(task.id, *told, (*task.variants,), variant, own, fields, moves, read, plans)
    try:
        drawn = _sheet(asked) if answers else _handout(asked)
    except KulmanError as error:
        return replace(about, problem=error)
    pages = tuple(drawn.svg(number).encode("utf-8", "replace") for number in range(1, len(drawn.pages) + 1))
    return replace(about, pages=pages, warnings=drawn.warnings)


def picture(advance: Advance, task: str, language: str) -> bytes:
    """Return a picture of a bundled task: its kinematic scheme, or the figure that tells most of another subject."""
    case = Request(load_task(task), language=language).case()
    view = case.kind.pictured(case, case.words())
    if view is None:
        views = {one.name: one for one in draw_case(case).views}
        view = views[next(name for name in (*FIGURES, *views) if name in views)]
    return svg_text(bare_page(view, language)).encode("utf-8", "replace")


def started(advance: Advance, kind: str, language: str) -> str:
    """Return a task file with comments to begin with, of a kind or as a bundled task is written."""
    return start(f"my-{kind}.toml", language, kind).read_text("utf-8")


@dataclass(frozen=True, slots=True)
class Judged:
    """What the checker says of a task file: its text, faults and remarks each with its line, which may be none."""

    text: str
    faults: tuple[tuple[int, str], ...]
    remarks: tuple[tuple[int, str], ...]


def judged(advance: Advance, data: bytes, language: str) -> Judged:
    """Return what the checker says of a task file."""
    Path(OWN).write_bytes(data)
    try:
        faults, remarks = check_file(Path(OWN))
    except InputError as error:
        faults, remarks = (error,), ()
    text = ""
    with suppress(UnicodeDecodeError):
        text = decoded(data)
    return Judged(text, tuple(_lined(faults, language)), tuple(_lined(remarks, language)))


def _lined(errors: Sequence[InputError], language: str) -> Iterator[tuple[int, str]]:
    for error in errors:
        place = error.place.split(":") if isinstance(error, LocatedError) else [""]
        line = int(place[1]) if len(place) > 1 and place[1].isdigit() else 0
        yield line, (error.cause if line and isinstance(error, LocatedError) else error).text(language)


def form(advance: Advance, asked: Asked) -> tuple[Rows, Mapping[str, Sequence[str]]]:
    """Return the rows of the empty form, and which columns each answer has."""
    rows, wanted = _check(asked).form()
    return tuple(rows), wanted


def answered(advance: Advance, asked: Asked, cells: Mapping[tuple[int, int], str], preset: str, own: bool) -> str:
    """Return the report on a form whose cells have been filled in, as a page; `own` is one without right numbers.

    It says which quantity a note is about, as the form calls it: cells have no addresses there, nor has it a file.
    """
    ready = _check(asked, preset=preset, own=own)
    rows = [list(row) for row in read_grid(ready.write_form("answers.csv")).rows]
    for (row, column), text in cells.items():
        if row < len(rows):
            rows[row] += [""] * (len(COLUMNS) - len(rows[row]))
            if column < len(rows[row]):
                rows[row][column] = text
    Path("answers.csv").write_bytes(csv_table(rows, asked.language))
    symbols = {row[0]: row[1] for row in rows if len(row) > 1}
    try:
        (answers,) = ready.read("answers.csv")
    except LocatedError as error:  # all cells are empty
        raise _about_quantity(error, symbols) from error
    problems = tuple(_about_quantity(problem, symbols) for problem in answers.problems)
    return report_html(ready.mark(replace(answers, source="", problems=problems)))


def _about_quantity(problem: KulmanError, symbols: Mapping[str, str]) -> KulmanError:
    """Return what is wrong in a form with the symbol of its quantity in the place of file, cell and name."""
    if not isinstance(problem, LocatedError):
        return problem
    name = problem.place.rpartition(", ")[2]
    return LocatedError(Written(symbols[name]), problem.cause) if name in symbols else problem.cause


def _tasks_named(form: Upload) -> Iterator[str]:
    """Go through the bundled tasks that a form names in its head."""
    with suppress(InputError):  # a drawing; or what is wrong with it is told where it is read
        for row in read_grid(form.put(0, TABLES)).rows[:LOOKED_AT]:
            yield from (name for name in row[1:2] if about_kind(row[0]) == "task" and name in bundled())


@dataclass(frozen=True, slots=True)
class Handed:
    """What has been handed in, as it came: by a student who is `alone`, or a class; `how` it is to be marked."""

    asked: Asked
    files: tuple[Upload, ...]
    how: Mapping[str, Any]
    roster: Upload | None = None
    rubric: Upload | None = None
    alone: bool = False

    @property
    def sent(self) -> tuple[Upload, ...]:
        """All files that have come."""
        return *self.files, *filter(None, (self.roster, self.rubric))

    @property
    def of(self) -> Asked:
        """What is asked: where no task is chosen that which most forms name. Raises InputError: none names one."""
        if self.asked.task or self.asked.own:
            return self.asked
        named = Counter(name for one in self.files for name in _tasks_named(one))
        if not named:
            raise InputError("marks-no-task")
        return replace(self.asked, task=named.most_common(1)[0][0])

    def read(self, told: Told) -> _Read:
        """Read it, in the folder of the process, with what has been answered to questions."""
        asked, notes, beside = self.of, list[KulmanError](), len(self.files)
        listed = None if self.roster is None else self.roster.put(beside + 1, TABLES)
        weights = None if self.rubric is None else self.rubric.put(len(self.sent), (".toml",))
        task = asked.load()
        usual = _request(asked, task, *LETTERS) if self.alone else {"variant": asked.variant or None}
        ready = check(task, **{**usual, "lang": asked.language, **self.how}, roster=listed, rubric=weights)
        names = list[str]()
        for n, one in enumerate(self.files, 1):
            try:
                names.append(one.put(n, ANSWERS))
            except InputError as error:  # the others are read all the same
                if n == len(self.files) and not names:
                    raise
                notes.append(error)
        found, asks = gathered(ready.read(*names, warn=notes.append), ready.roster, told, self.alone)
        return _Read(ready, ready.ordered(found), asks, notes)


@dataclass(frozen=True, slots=True)
class _Read:
    """What has been handed in, read: whose it is as far as that is known, and what is asked of pages."""

    ready: Check
    found: Sequence[Answers]
    asks: Sequence[PageAsk]
    notes: Sequence[KulmanError]


def answered_by_files(advance: Advance, handed: Handed, told: Told) -> tuple[str, Asking, tuple[bytes, ...]]:
    """Return the report on a form, drawings or photographs of a student, as a page with them in it; what is asked.

    Photographs come back with verdicts over them, as PDF and PNG, several PNG in one archive.
    """
    read = handed.read(told)
    if not read.found or read.found[0].unread:
        raise (read.notes or [InputError("photo-no-markers", file=quote(handed.files[0].name, SHOWN))])[0]
    answers, desk = read.found[0], Desk(read.ready)
    ends, pictures = ends_asked(desk, answers) if answers.photos else ([], {})
    report, returned = reported(desk, answers)[0], list[bytes]()
    if answers.photos:
        for kind in sorted(PHOTOS):
            files = [*report.files(Path(f"marked{kind}"))]
            for path, data in files:
                path.write_bytes(data)
            paths = [path for path, _ in files]
            one = len(paths) == 1
            returned.append(paths[0].read_bytes() if one else _zipped(paths, Path(f"marked{ZIP}")).read_bytes())
    asking = Asking(tuple(read.asks), tuple(ends), pictures, tuple(read.notes))
    return as_sent(report_html(report), handed.sent, escape), asking, tuple(returned)


@dataclass(frozen=True, slots=True)
class _Done:
    """What has come of a class: an archive among what is kept, a page about it, lines that tell of it; or questions."""

    archive: str
    lines: tuple[str, ...]
    page: bytes = b""
    asking: Asking | None = None


@dataclass(slots=True)
class Job:
    """How far the work for a class is, and what has come of it."""

    name: str
    title: str
    done: int = 0
    whole: int = 0
    outcome: _Done | None = None
    problem: str = ""

    @property
    def over(self) -> bool:
        """Whether nothing more comes."""
        return self.outcome is not None or bool(self.problem)

    def advance(self, done: int, whole: int) -> None:
        """Note that so many more are done."""
        self.done, self.whole = self.done + done, whole


def drawn_class(
    advance: Advance, tasks: Sequence[Asked], roster: Upload, how: Mapping[str, Any], archive: str, jobs: int
) -> _Done:
    """Draw the sheets of a class as `batch` does, into an archive of what it writes."""
    language, folder = tasks[0].language, Path("class")
    file = roster.put(1, TABLES)
    found = batch([one.load() for one in tasks], file, folder, lang=language, jobs=jobs, advance=advance, **how)
    files = sorted(path for path in folder.rglob("[!.]*") if path.is_file())
    _name_as_sent(files, [roster])
    _zipped(files, Path("..") / KEEP / archive, folder)
    told = (found.whole(language), *(warning.text(language) for warning in found.warnings), *found.told)
    named = (line.replace(file, roster.name).replace(Path(file).name, roster.name) for line in told)
    return _Done(archive, (*named,))


@dataclass(frozen=True, slots=True)
class _Asker:
    """Who looks through the photographs of a class for what is not sure."""

    terms: Terms

    def begin(self) -> Callable[[Answers], tuple[list[EndAsk], dict[str, bytes]]]:
        """Set up, and return what looks through those of a student."""
        desk = Desk(self.terms)

        def looked(answers: Answers) -> tuple[list[EndAsk], dict[str, bytes]]:
            with suppress(KulmanError):  # told where the student is marked
                return ends_asked(desk, answers)
            return [], {}

        return looked


def _asked_of_class(read: _Read, advance: Advance, jobs: int) -> Asking:
    photographed = [one for one in read.found if one.photos]
    ends, pictures = dict[int, list[EndAsk]](), dict[str, bytes]()
    for done in shared_out(_Asker(read.ready).begin, photographed, jobs, lambda one: one.about.get("variant", "")):
        for place, made in done:
            if made is not None:
                ends[place], pictures = made[0], pictures | made[1]
    return Asking(tuple(read.asks), tuple(ask for place in sorted(ends) for ask in ends[place]), pictures)


def marked_class(advance: Advance, handed: Handed, told: Told | None, asked: str, archive: str, jobs: int) -> _Done:
    """Mark what a class has handed in as `check` does: reports, the page about the class, tables of marks.

    Where nobody has been asked yet, nothing `told`, and something is not sure, that is what comes of it. What was read
    of photographs by the job that has `asked` is kept for this one.
    """
    language, out, kept = handed.asked.language, Path("marks"), Path("..").resolve() / KEEP
    photographs = kept / Path(archive).stem
    if asked:
        with suppress(OSError):  # forgotten meanwhile
            (kept / asked).rename(photographs)
    read = handed.read(told or Told())
    ready, found = replace(read.ready, photographs=photographs), read.found
    read = replace(read, ready=ready)
    asking = Asking(tuple(read.asks)) if told is not None else _asked_of_class(read, advance, jobs)
    if asking.pages or asking.ends:
        return _Done("", (), asking=asking)
    unread = [one.unread for one in found]  # of which a line of its student tells
    lines = [warning.text(language) for warning in (*ready.warnings, *(one for one in read.notes if one not in unread))]
    found = [replace(one, source=as_sent(one.source, handed.files)) for one in found]
    results = ready.mark_all(found, out, advance, jobs)
    page, moodle, name = out / f"class{PAGE}", out / "moodle.csv", f"sheets{RETURNED}"
    write_tables(ready, results, found, [page, out / "gradebook.xlsx"], moodle)
    lines += class_lines(ready.listed(found, results), language)
    returned = [out / report for one in results for report in one.reports if report.endswith(RETURNED)]
    if returned:
        (out / name).write_bytes(stacked(returned))
    files = sorted(out.glob("[!.]*"))
    _name_as_sent(files, handed.sent)
    _zipped(files, kept / archive, out)
    if not asked:
        shutil.rmtree(photographs, ignore_errors=True)  # nothing was asked of them
    return _Done(archive, tuple(lines), page.read_bytes())


def students(advance: Advance, handed: Handed) -> list[str]:
    """Return the names of the students of a roster, in its order."""
    assert handed.roster is not None
    entries = read_roster(handed.roster.put(1, TABLES), handed.of.load()).entries
    return [entry.who.student or entry.who.book or entry.who.number for entry in entries]


def warmed(advance: Advance) -> None:
    """Load what drawing needs, before anybody waits for it."""
    draw_case(Request(load_task(bundled("mechanism")[0])).case())
