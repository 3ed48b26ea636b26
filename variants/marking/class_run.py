"""A class marked on all cores: reports whole or not at all, and what a killed run has finished is not done again."""

from __future__ import annotations

import hashlib
import json
import multiprocessing
import os
import re
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import suppress
from dataclasses import dataclass, replace
from multiprocessing.process import BaseProcess
from pathlib import Path
from threading import Thread

from ... import __version__
from ...drawing.writers import write_whole
from ...scales.errors import KulmanError
from ..shelf import bundled_text
from .answers import Answers
from .checks import Check
from .marked import Desk
from .report import report
from .reports import REPORTS, report_bytes
from .result import Result, failed, result_of

TOGETHER = 8  # students that a process is given at once
ALONE = 16  # students for whom no process is started
REPORTS_NOTED = ".kulman-reports.json"  # which reports of a folder are the program's own
Advance = Callable[[int], None]


@dataclass(frozen=True, slots=True)
class Job:
    """What is done for every student of a class: how answers are marked, and where reports go, if anywhere."""

    check: Check
    folder: str | None = None

    def digest(self) -> str:
        """Return what tells this job from any that would mark or say something else."""
        check, request = self.check, self.check.request
        task = request.task
        text = Path(task.file).read_text(encoding="utf-8") if task.file else bundled_text(task.id)
        parts = (__version__, text, request.variant, request.settings, request.only, request.scales, request.notation)
        own = (request.language, check.rubric, check.digits, check.own, tuple(REPORTS))
        return _digest(repr((parts, own)))


def _digest(text: str) -> str:
    return hashlib.blake2s(text.encode("utf-8", "surrogatepass"), digest_size=12).hexdigest()


def mark_class(job: Job, answers: Sequence[Answers], advance: Advance, jobs: int | None = None) -> list[Result]:
    """Mark all students of a class, in their order.

    Parameters
    ----------
    advance : callable
        Told how many students more are done.
    jobs : int, optional
        Processes; as many as there are cores when left out.

    Raises
    ------
    InputError
        A report cannot be written.
    """
    journal = Journal(Path(job.folder), job) if job.folder is not None else None
    found: dict[int, Result] = {}
    for number, student in enumerate(answers):
        result = journal.found(number, student) if journal else None
        if result is not None:
            found[number] = result
    advance(len(found))
    todo = [number for number in range(len(answers)) if number not in found]
    for numbers, results in _done(job, answers, todo, jobs or os.cpu_count() or 1):
        for number, result in zip(numbers, results, strict=True):
            found[number] = result
            if journal:
                journal.note(number, answers[number], result)
        advance(len(numbers))
    results = [found[number] for number in range(len(answers))]
    if journal:
        journal.finish()
        sweep(journal.folder, results)
    return results


def _done(job: Job, answers: Sequence[Answers], todo: list[int], jobs: int) -> Iterator[tuple[list[int], list[Result]]]:
    """Go through what is done, a few students at a time; a process that is killed is started anew once."""
    pieces = [todo[at : at + TOGETHER] for at in range(0, len(todo), TOGETHER)]
    for _ in range(2 if jobs > 1 and len(todo) > ALONE else 0):
        finished = set[int]()
        with suppress(BrokenProcessPool):
            for numbers, results in _in_processes(job, answers, pieces, min(jobs, len(pieces))):
                finished.update(numbers)
                yield numbers, results
        pieces = [piece for piece in pieces if not finished.issuperset(piece)]
        if not pieces:
            return
    desk = Desk(job.check)
    for piece in pieces:
        yield piece, _marked(job, desk, [(number, answers[number]) for number in piece])


def _in_processes(
    job: Job, answers: Sequence[Answers], pieces: list[list[int]], jobs: int
) -> Iterator[tuple[list[int], list[Result]]]:
    """Mark in processes; only a few pieces wait at a time."""
    waiting: dict[Future[list[Result]], list[int]] = {}
    left = iter(pieces)
    with ProcessPoolExecutor(jobs, initializer=_begin, initargs=(job,)) as pool:
        try:
            while True:
                for piece in left:
                    task = pool.submit(_piece, [(number, answers[number]) for number in piece])
                    waiting[task] = piece
                    if len(waiting) >= 3 * jobs:
                        break
                if not waiting:
                    return
                for task in wait(waiting, return_when=FIRST_COMPLETED).done:
                    yield waiting.pop(task), task.result()
        finally:
            pool.shutdown(wait=False, cancel_futures=True)


_OWN: list[tuple[Job, Desk]] = []  # of a process


def _begin(job: Job) -> None:
    """Set up a process, which ends with the one that has started it, even if that is killed."""
    parent = multiprocessing.parent_process()
    if parent is not None:
        Thread(target=_end_with, args=(parent,), daemon=True).start()
    _OWN.append((job, Desk(job.check)))


def _end_with(parent: BaseProcess) -> None:
    parent.join()
    os._exit(1)


def _piece(students: list[tuple[int, Answers]]) -> list[Result]:
    return _marked(*_OWN[-1], students)


def _marked(job: Job, desk: Desk, students: list[tuple[int, Answers]]) -> list[Result]:
    return [mark_one(job, desk, number, student) for number, student in students]


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
    said = report(marked, job.check.rubric, language, job.check.own, result.flags(language))
    stem = f"{number + 1:03d}-{slug(result.who.student or Path(answers.source).stem)}"
    names = tuple(f"{stem}{kind}" for kind in REPORTS)
    for kind, name in zip(REPORTS, names, strict=True):
        write_whole(Path(job.folder) / name, report_bytes(said, kind))
    return replace(result, reports=names)


def slug(name: str) -> str:
    """Return a name fit for a file on any system, in its own letters.

    >>> slug("О'Коннор, І. / 3"), slug("..")
    ('О-Коннор-І-3', 'x')
    """
    return re.sub(r"[^\w]+", "-", name).strip("-_")[:60] or "x"


def sweep(folder: Path, results: Sequence[Result]) -> None:
    """Remove the reports that the run before has written there and this one has not; note those of this one.

    Only what the note names, and only if nobody has changed it since, is removed: it is the program's own.
    """
    noted = folder / REPORTS_NOTED
    before: dict[str, str] = {}
    with suppress(OSError, ValueError, TypeError):
        before = dict(json.loads(noted.read_text(encoding="utf-8")))
    names = {name for result in results for name in result.reports}
    for name, digest in before.items():
        stale = folder / Path(name).name
        with suppress(OSError):
            if name not in names and stale.suffix in REPORTS and _digest_of(stale) == digest:
                stale.unlink()
    with suppress(OSError):  # a folder that takes no note keeps its reports
        now = {name: _digest_of(folder / name) for name in sorted(names)}
        write_whole(noted, (json.dumps(now, indent=0) + "\n").encode("ascii"))


def _digest_of(file: Path) -> str:
    return hashlib.blake2s(file.read_bytes(), digest_size=12).hexdigest()


class Journal:
    """What a run has finished, a line each, so that a killed one can be gone on with; gone when all is done."""

    def __init__(self, folder: Path, job: Job) -> None:
        self.path, self.folder, self.job = folder / ".kulman-check.jsonl", folder, job.digest()
        self.roster = job.check.roster
        self._named: dict[int, tuple[Answers, str]] = {}
        self.before: dict[str, Result] = {}
        with suppress(FileNotFoundError):
            for line in self.path.read_text(encoding="utf-8").splitlines():
                with suppress(ValueError, KeyError, TypeError):  # the last line of a killed run may be torn
                    item = json.loads(line)
                    self.before[item["digest"]] = Result.from_json(item["result"])

    def _name(self, number: int, answers: Answers) -> str:
        of, name = self._named.get(number, (None, ""))
        if of is not answers:  # a name is asked for before the answers are marked, and after
            entry = self.roster.find(answers.who) if self.roster else None
            name = _digest(f"{self.job} {number} {answers!r} {entry!r}")
            self._named[number] = answers, name
        return name

    def found(self, number: int, answers: Answers) -> Result | None:
        """Return what an earlier run found of the same answers, if its reports are still there."""
        result = self.before.get(self._name(number, answers))
        there = result is not None and all((self.folder / name).is_file() for name in result.reports)
        return result if there else None

    def note(self, number: int, answers: Answers, result: Result) -> None:
        """Keep a result."""
        item = {"digest": self._name(number, answers), "result": result.to_json()}
        with self.path.open("a", encoding="utf-8") as stream:
            stream.write(json.dumps(item, ensure_ascii=True) + "\n")

    def finish(self) -> None:
        """Forget: all is done."""
        with suppress(OSError):
            self.path.unlink()
