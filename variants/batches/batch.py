"""A batch: the sheets of a class drawn on all cores into a folder, each whole; what is there already stays."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias

from ...drawing.formats import format_named
from ...drawing.pens import Norm
from ...drawing.words import Words
from ...drawing.writers import folder_for, save_all, slug
from ...scales.errors import InputError, Written
from ...scales.numbers import SHOWN, quote
from ...scales.packaged import packaged
from ..case import Request, Settings, all_known, by_name, plans_wanted
from ..crew import Advance, on_cluster, shared_out
from ..marking.wording import texts
from ..reader import load_task
from ..roster import SCHEME, VARIANT, WHO, Digits, Schemes, read_roster
from ..sheets import said_of
from ..spreadsheets.grid import SUFFIXES
from ..tables import Cell, csv_table, table_bytes
from ..task import Task
from .work import FORMS, NOTE, Batch, Crew, Making, Student, put, run

if TYPE_CHECKING:
    from .work import Outcome

MANIFEST, KEY = "manifest.csv", "key.csv"
One: TypeAlias = str | os.PathLike[str] | Task
Tasks: TypeAlias = One | Sequence[One]
Rows = Iterator[tuple[Cell, ...]]


def batch(
    task: Tasks,
    roster: str | os.PathLike[str],
    folder: str | os.PathLike[str],
    *,
    kinds: Sequence[str] = ("svg", "pdf", NOTE),
    digits: int | str | None = None,
    set: Settings | None = None,
    only: str | Iterable[str] | None = None,
    scales: Settings | None = None,
    format: str | None = None,
    norm: Norm = "gost",
    notation: str | None = None,
    lang: str = "uk",
    block: Mapping[str, str] | None = None,
    jobs: int | None = None,
    dask: str | None = None,
    advance: Advance | None = None,
) -> Batch:
    """Draw the sheet of every student of a class.

    In the folder stand the files of every student, `manifest.csv`, which lists them, and `key.csv` with the right
    values, of several tasks one for each. A run that was stopped, or one with a longer roster, draws only what is
    missing or has changed.

    Parameters
    ----------
    task : str, PathLike, Task, or several of them
        Of several the first is scheme 1; one may stand there more than once.
    set, only, scales, format, norm, notation, lang
        As for `sheet`; what the roster says of a student goes before `set`.
    roster : str or PathLike
        A .csv or .xlsx with a student in each row: name, group, variant or record book, givens of one's own; of several
        tasks also which, by id or number.
    folder : str or PathLike
        Where the files go; it is made where it is missing.
    kinds : sequence of str
        What each student gets: the sheet as `svg`, `pdf`, `png`, the `note`, also as `docx`, a blank `handout`.
    digits : int or str, optional
        How many last digits of the record book give the variant, where the roster has none; or what each of them is
        for, from left to right: `"variant,scheme"`, which is usual for several tasks.
    block : mapping of str to str, optional
        What is said in every title block: `teacher`, `department`, `designation`, `date`.
    jobs : int, optional
        Processes; as many as there are cores when left out. With 1 all is done in this one, and dies with it.
    dask : str, optional
        The address of a Dask scheduler, whose workers do the work in the place of processes here.
    advance : callable, optional
        Told how many students more are done, and of how many.

    Raises
    ------
    InputError
        The roster, or an argument, is at fault for all; or a file cannot be written: what is done stays.
    """
    tasks = _tasks(task)
    all_known("batch-kind", kinds, FORMS)
    wanted, block = only if only is None or isinstance(only, str) else tuple(only), dict(block or {})
    how = by_name("set", set), wanted, by_name("scales", scales), notation, lang, format, norm, block
    making = Making({one.id: _asked_of(Request(one, None, *how)) for one in _once(tasks)}, tuple(dict.fromkeys(kinds)))
    usual = VARIANT if len(tasks) == 1 else f"{VARIANT},{SCHEME}"
    schemes = Schemes(tasks, Digits.of(usual if digits is None else digits))
    listed = read_roster(os.fspath(roster), schemes, each=True)
    students = tuple(Student(number, entry) for number, entry in enumerate(listed.entries, 1))
    place = folder_for(folder)
    outcomes = run(making, students, place, _crew(jobs, dask), advance or (lambda done, whole: None))
    unread = Written(", ".join(quote(head, SHOWN) for head in listed.unread))
    # what was meant by columns that say nothing here has been left out
    error = InputError("roster-unread", file=quote(Path(roster).name, SHOWN), columns=unread)
    done = Batch(students, outcomes, (error,) if listed.unread else ())
    for name, rows in _tables(done, _once(tasks), lang):
        put(place / name, csv_table(list(rows), lang))
    return done


def _tasks(said: Tasks) -> tuple[Task, ...]:
    """Return the tasks of a class in the order in which they are said."""
    several = said if isinstance(said, Sequence) and not isinstance(said, str) else (said,)
    return tuple(map(load_task, several))


def _once(tasks: Sequence[Task]) -> tuple[Task, ...]:
    """Return each task once, as the same one may be several schemes.

    Raises
    ------
    InputError
        There is none, or two have the same id.
    """
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


def _tables(done: Batch, tasks: Sequence[Task], language: str) -> Iterator[tuple[str, Rows]]:
    """Go through the tables of a class by the names of their files."""
    yield MANIFEST, manifest_rows(done, tasks, language)
    for task in tasks:
        name = KEY if len(tasks) == 1 else f"{Path(KEY).stem}-{slug(task.id)}.csv"
        yield name, key_rows(done, task, tasks, language)


def write_roster(task: Tasks, file: str | os.PathLike[str], lang: str = "uk") -> Path:
    """Write a roster to fill in, .csv or .xlsx: a row for each variant. As it is, each has a sheet without a name.

    Parameters
    ----------
    task : str, PathLike, Task, or several of them

    Raises
    ------
    InputError
        A kind of file that is no roster, or a place where none can be written.
    """
    tasks = _once(_tasks(task))
    rows = list(roster_rows(tasks, lang))
    return save_all((file,), SUFFIXES, lambda path: [(path, table_bytes(path, rows, lang, tasks[0].id, [0], 1))])[0]


def _crew(jobs: int | None, dask: str | None) -> Crew:
    """Return who does the work."""
    if dask is None:
        # an item may kill its process, which is not this one unless that is asked for
        return lambda making, students: shared_out(
            making, students, jobs or os.cpu_count() or 1, 0 if jobs != 1 else None, making.afresh
        )
    return lambda making, students: on_cluster(making, students, dask)


def roster_rows(tasks: Sequence[Task], language: str) -> Rows:
    """Go through the rows of a roster to fill in: a header, and a row for each variant of each task."""
    said, alone = texts(language), len(tasks) == 1
    yield tuple(said[f"about.{key}"] for key in ("student", "group", *(() if alone else ("task",)), "variant"))
    for task in tasks:
        for variant in task.variants:
            yield "", "", *(() if alone else (task.id,)), variant


def manifest_rows(batch: Batch, tasks: Sequence[Task], language: str) -> Rows:
    """Go through the rows of the list: a header; who, which variant and sheet, which files, or what the problem is."""
    said = packaged(__package__, "texts", language)
    yield (*_about(tasks, language), said["files"], said["notes"])
    for student, outcome in zip(batch.students, batch.outcomes, strict=True):
        told = outcome.problem or "; ".join(outcome.notes)
        yield (*_who(student, outcome, tasks), ", ".join(outcome.files), told)


def key_rows(batch: Batch, task: Task, tasks: Sequence[Task], language: str) -> Rows:
    """Go through the rows of the key of a task: a header; who, which variant and sheet, and every right value.

    The columns are those of a class that hands in its answers; of several `tasks` only those who have this one are in.
    """
    rows = zip(batch.students, batch.outcomes, strict=True)
    own = [row for row in rows if len(tasks) == 1 or row[0].entry.task == task.id]
    names = tuple(dict.fromkeys(name for _, outcome in own for name in outcome.key))
    yield (*_about(tasks, language), *names)
    for student, outcome in own:
        yield (*_who(student, outcome, tasks), *(outcome.key.get(name) for name in names))


def _about(tasks: Sequence[Task], language: str) -> tuple[str, ...]:
    """Return what stands over who a student is; the task only where there are several."""
    said = texts(language)
    return tuple(said[f"about.{key}"] for key in (*WHO, *(("task",) if len(tasks) > 1 else ()), "variant", "sheet"))


def _who(student: Student, outcome: Outcome, tasks: Sequence[Task]) -> tuple[Cell, ...]:
    who = (getattr(student.entry.who, key) for key in WHO)
    return (*who, *((student.entry.task,) if len(tasks) > 1 else ()), outcome.variant, outcome.sheet)
