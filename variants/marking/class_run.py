"""A class marked on all cores: reports whole or not at all, and what a killed run has finished is not done again."""

from __future__ import annotations

import gc
import json
import os
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from ... import __version__
from ...drawing.writers import Files, save_all, slug, write_whole
from ...scales.errors import InputError, KulmanError
from ..crew import Advance, Journal, digest_of, remove_stale, shared_out
from ..spreadsheets.grid import SUFFIXES
from ..tables import csv_table, table_bytes
from .answers import Answers
from .marked import Desk, variant_of
from .report import REPORTS, Report, report_bytes
from .result import Result, class_rows, failed, moodle_rows, result_of

if TYPE_CHECKING:
    from .checks import Check

JOURNAL = ".kulman-check.jsonl"
REPORTS_NOTED = ".kulman-reports.json"  # which reports of a folder are the program's own
COLLECTED = 200_000  # objects made anew after which garbage is looked for: 40 MB
Item = tuple[int, Answers]


@dataclass(frozen=True, slots=True)
class Job:
    """What is done for every student of a class: how answers are marked, and where reports go, if anywhere."""

    check: Check
    folder: str | None = None

    def begin(self) -> Callable[[Item], Result]:
        """Set up, and return what marks a student, who comes with a number."""
        desk = Desk(self.check)
        return lambda item: mark_one(self, desk, *item)

    def digest(self) -> str:
        """Return what tells this job from any that would mark or say something else."""
        check, request = self.check, self.check.request
        asked = (request.variant, request.settings, request.only, request.scales, request.notation)
        parts = (__version__, request.task.text, *asked)
        own = (request.language, request.format, check.rubric, check.digits, check.own, tuple(REPORTS))
        return digest_of(repr((parts, own)))


def mark_class(job: Job, answers: Sequence[Answers], advance: Advance, jobs: int | None = None) -> list[Result]:
    """Mark all students of a class, in their order.

    Parameters
    ----------
    advance : callable
        Told how many students more are done, and of how many.
    jobs : int, optional
        Processes; as many as there are cores when left out.

    Raises
    ------
    InputError
        A report cannot be written.
    """
    students = list(enumerate(answers))
    marked = _Marked(job)
    found = {item[0]: result for item in students if (result := marked.before(item)) is not None}
    advance(len(found), len(students))
    todo = sorted((item for item in students if item[0] not in found), key=lambda item: _variant(job.check, item[1]))
    with _seldom_collected():
        for done in shared_out(job, todo, jobs or os.cpu_count() or 1):
            for number, result in (marked.noted(todo[one.place], one.made) for one in done):
                found[number] = result
            advance(len(done), len(students))
    results = [found[number] for number, _ in students]
    marked.finish(results)
    return results


def _variant(check: Check, answers: Answers) -> str:
    """Return the variant of a student: those of one go to one process, one after the other, and share its key."""
    try:
        return variant_of(check, answers, check.roster.find(answers.who) if check.roster else None)[0]
    except KulmanError:
        return ""


@contextmanager
def _seldom_collected() -> Iterator[None]:
    """Look for garbage less often, in this process and its copies: keys are many objects, gone through every time."""
    usual = gc.get_threshold()
    gc.set_threshold(max(COLLECTED, usual[0]) if usual[0] else 0, *usual[1:])
    try:
        yield
    finally:
        gc.set_threshold(*usual)


def mark_one(job: Job, desk: Desk, number: int, answers: Answers) -> Result:
    """Mark a student and write the reports; answers that cannot be marked are a result, too."""
    language = job.check.request.language
    try:
        marked = desk.mark(answers)
    except KulmanError as error:
        return failed(answers, error, language)
    result = result_of(marked, language)
    if job.folder is None:
        return result
    said = Report(marked, job.check.rubric, language, job.check.own, result.flags(language))
    stem = f"{number + 1:03d}-{slug(result.who.student or Path(answers.source).stem)}"
    names = tuple(f"{stem}{kind}" for kind in REPORTS)
    for kind, name in zip(REPORTS, names, strict=True):
        write_whole(Path(job.folder) / name, report_bytes(said, kind))
    return replace(result, reports=names)


def tidy(folder: Path, results: Sequence[Result]) -> None:
    """Remove the reports that the run before has written there and this one has not; note those of this one.

    Only what the note names, and only if nobody has changed it since, is removed: it is the program's own.
    """
    noted = folder / REPORTS_NOTED
    before: dict[str, str] = {}
    with suppress(OSError, ValueError, TypeError):
        before = dict(json.loads(noted.read_text(encoding="utf-8")))
    names = {name for result in results for name in result.reports}
    remove_stale(folder, before.items(), names, REPORTS)
    with suppress(OSError):  # a folder that takes no note keeps its reports
        now = {name: digest_of((folder / name).read_bytes()) for name in sorted(names)}
        write_whole(noted, (json.dumps(now, indent=0) + "\n").encode("ascii"))


class _Marked:
    """What has been marked of a class; with a folder it is noted there, for a run that goes on with a killed one."""

    def __init__(self, job: Job) -> None:
        self.job, self.roster = job, job.check.roster
        self.folder = None if job.folder is None else Path(job.folder)
        self.journal = Journal(self.folder / JOURNAL, Result.from_json, Result.to_json) if self.folder else None
        self._digest = job.digest() if self.folder else ""
        self._names: dict[int, str] = {}

    def _name(self, item: Item) -> str:
        number, answers = item
        if number not in self._names:
            entry = self.roster.find(answers.who) if self.roster else None
            self._names[number] = digest_of(f"{self._digest} {number} {answers!r} {entry!r}")
        return self._names[number]

    def before(self, item: Item) -> Result | None:
        """Return what an earlier run found of the same answers, if its reports are still there."""
        if self.journal is None or self.folder is None:
            return None
        result = self.journal.found(self._name(item))
        there = result is not None and all((self.folder / name).is_file() for name in result.reports)
        return result if there else None

    def noted(self, item: Item, result: Result | None) -> tuple[int, Result]:
        """Keep a result; none means that the student's answers have killed the process that marked them."""
        number, answers = item
        if result is None:
            return number, failed(answers, InputError("process-died"), self.job.check.request.language)
        if self.journal is not None:
            self.journal.note(self._name(item), result)
        return number, result

    def finish(self, results: Sequence[Result]) -> None:
        """Tidy the folder: all is done."""
        if self.journal is not None and self.folder is not None:
            self.journal.finish()
            tidy(self.folder, results)


def write_tables(
    check: Check, results: Sequence[Result], answers: Sequence[Answers], files: Sequence[Path], moodle: Path | None
) -> None:
    """Write the tables of a class."""
    language = check.request.language
    absent = check.roster.missing(one.who for one in answers) if check.roster else []
    rows = list(class_rows(results, absent, language))

    def table(path: Path) -> Files:
        if path == moodle:
            return [(path, csv_table(list(moodle_rows(results, language)), language, ","))]
        return [(path, table_bytes(path, rows, language, check.request.task.id, [0], 1))]

    save_all((*files, *filter(None, (moodle,))), SUFFIXES, table)
