"""A batch: the sheets of a class drawn on all cores into a folder, each whole; what is there already stays."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

from ...drawing.formats import format_named
from ...drawing.pens import Norm
from ...drawing.words import Words
from ...drawing.writers import WRITERS, folder_for, save_all, write_whole
from ...scales.arguments import of_kind
from ...scales.errors import InputError
from ...scales.names import unknown
from ..arguments import by_name, plans_wanted
from ..case import Settings
from ..crew import Advance, Done, shared_out
from ..journal import Journal, digest_of
from ..kinds import kind_of
from ..reader import load_task
from ..roster import read_roster
from ..spreadsheets.cells_out import csv_table, table_bytes
from ..spreadsheets.grid import SUFFIXES
from ..task import Task
from .student import FORMS, NOTE, Made, Making, Student
from .tables import key_rows, manifest_rows, roster_rows

JOURNAL = ".kulman-batch.jsonl"
MANIFEST, KEY = "manifest.csv", "key.csv"
Crew = Callable[[Making, list[Student]], Iterator[list[Done[Made]]]]


@dataclass(frozen=True, slots=True)
class Outcome:
    """What a student has got: the files with digests of what they hold, the key; or what the problem is."""

    variant: str
    sheet: str
    files: Mapping[str, str]
    key: Mapping[str, float | None]
    notes: tuple[str, ...]
    problem: str

    @classmethod
    def of(cls, made: Made) -> Outcome:
        """Return what has been made, without what the files hold."""
        files = {name: digest_of(data) for name, data in made.files.items()}
        return cls(made.variant, made.sheet, files, made.key, made.notes, made.problem)

    @classmethod
    def from_json(cls, data: Mapping[str, Any]) -> Outcome:
        """Return an outcome from plain data."""
        return cls(**{**data, "notes": tuple(data["notes"])})

    def to_json(self) -> dict[str, Any]:
        """Return the outcome as plain data."""
        return {item.name: getattr(self, item.name) for item in fields(self)}

    def there(self, folder: Path) -> bool:
        """Whether the files are in the folder as they were made; a problem is looked at again."""
        with suppress(OSError):
            return not self.problem and all(
                digest_of((folder / name).read_bytes()) == digest for name, digest in self.files.items()
            )
        return False


@dataclass(frozen=True, slots=True)
class Batch:
    """The students of a class with what each has got, in the order of the roster."""

    students: tuple[Student, ...]
    outcomes: tuple[Outcome, ...]

    @property
    def problems(self) -> list[str]:
        """Why students have got nothing, a line each."""
        return [outcome.problem for outcome in self.outcomes if outcome.problem]


def batch(
    task: str | os.PathLike[str] | Task,
    roster: str | os.PathLike[str],
    folder: str | os.PathLike[str],
    *,
    kinds: Sequence[str] = ("svg", "pdf", NOTE),
    digits: int = 1,
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
    values. A run that was stopped, or one with a longer roster, draws only what is missing or has changed.

    Parameters
    ----------
    task, set, only, scales, format, norm, notation, lang
        As for `sheet`; what the roster says of a student goes before `set`.
    roster : str or PathLike
        A .csv or .xlsx with a student in each row: name, group, variant or record book, givens of one's own.
    folder : str or PathLike
        Where the files go; it is made where it is missing.
    kinds : sequence of str
        What each student gets: the sheet as `svg`, `pdf`, `png`, the explanatory `note`, a blank `handout`.
    digits : int
        How many last digits of the record book give the variant, where the roster has none.
    block : mapping of str to str, optional
        What is said in every title block: `teacher`, `department`, `designation`, `date`.
    jobs : int, optional
        Processes; as many as there are cores when left out.
    dask : str, optional
        The address of a Dask scheduler, whose workers do the work in the place of processes here.
    advance : callable, optional
        Told how many students more are done, and of how many.

    Raises
    ------
    InputError
        The roster, or an argument, is at fault for all; or a file cannot be written: what is done stays.
    """
    found = task if isinstance(task, Task) else load_task(task)
    plans = None if only is None else plans_wanted(only, found.plans, kind_of(found.kind).plans)
    making = Making(
        found, _known(kinds), by_name("set", set), plans, by_name("scales", scales), format, norm, notation, lang,
        dict(block or {}), digits,
    )  # fmt: skip
    _refuse_early(making)
    entries = read_roster(os.fspath(roster), found, each=True).entries
    students = tuple(Student(number, entry) for number, entry in enumerate(entries, 1))
    place = folder_for(folder)
    crew = _crew(jobs or os.cpu_count() or 1, dask)
    outcomes = _run(making, students, place, crew, advance or (lambda done, whole: None))
    done = Batch(students, outcomes)
    for name, rows in ((MANIFEST, manifest_rows(done, lang)), (KEY, key_rows(done, lang))):
        write_whole(place / name, csv_table(list(rows), lang))
    return done


def write_roster(task: str | os.PathLike[str] | Task, file: str | os.PathLike[str], lang: str = "uk") -> Path:
    """Write a roster to fill in, .csv or .xlsx: a row for each variant. As it is, each has a sheet without a name.

    Raises
    ------
    InputError
        A kind of file that is no roster, or a place where none can be written.
    """
    found = task if isinstance(task, Task) else load_task(task)
    rows = list(roster_rows(found, lang))
    return save_all((file,), SUFFIXES, lambda path: [(path, table_bytes(path, rows, lang, found.id, [0], 1))])[0]


def _known(kinds: Sequence[str]) -> tuple[str, ...]:
    for kind in kinds:
        if kind not in FORMS:
            raise unknown("batch-kind", kind, FORMS)
    return tuple(dict.fromkeys(kinds))


def _refuse_early(making: Making) -> None:
    """Refuse what would be wrong for every student alike."""
    if making.format is not None:
        format_named(making.format)
    of_kind("digits", making.digits, (int,), "int")
    Words.of(making.language, making.task.notation if making.notation is None else making.notation)
    making.task.resolve(next(iter(making.task.variants)), making.settings)


def _crew(jobs: int, dask: str | None) -> Crew:
    """Return who does the work."""
    if dask is None:
        return lambda making, students: shared_out(making, students, jobs)
    from ..cluster import on_cluster

    return lambda making, students: on_cluster(making, students, dask)


def _run(
    making: Making, students: Sequence[Student], folder: Path, crew: Crew, advance: Advance
) -> tuple[Outcome, ...]:
    """Make what is not there yet; write it, and note it, as it comes."""
    journal = Journal(folder / JOURNAL, Outcome.from_json, Outcome.to_json)
    how = making.digest()
    digests = [digest_of(f"{how} {student!r}") for student in students]
    found = {
        number: outcome
        for number, digest in enumerate(digests)
        if (outcome := journal.found(digest)) is not None and outcome.there(folder)
    }
    advance(len(found), len(students))
    # students with the same data one after another, as these share what is drawn
    todo = sorted((n for n in range(len(students)) if n not in found), key=lambda n: students[n].data)
    for done in crew(making, [students[number] for number in todo]):
        for one in done:
            number = todo[one.place]
            found[number] = _kept(one.made, students[number], folder, making.language)
            journal.note(digests[number], found[number])
        advance(len(done), len(students))
    outcomes = tuple(found[number] for number in range(len(students)))
    _sweep(folder, journal.before.values(), outcomes)
    journal.keep(zip(digests, outcomes, strict=True))
    return outcomes


def _kept(made: Made | None, student: Student, folder: Path, language: str) -> Outcome:
    """Write what has been made for a student; nothing made means that a process has died of it."""
    if made is None:
        reason = InputError("process-died").text(language)
        return Outcome.of(Made(student.entry.variant, problem=f"{student.entry.place}: {reason}"))
    for name, data in made.files.items():
        write_whole(folder / name, data)
    return Outcome.of(made)


def _sweep(folder: Path, before: Iterable[Outcome], now: Iterable[Outcome]) -> None:
    """Remove files of earlier runs that belong to nobody any more, unless somebody has changed them since."""
    names = {name for outcome in now for name in outcome.files}
    for name, digest in _files(before):
        stale = folder / Path(name).name
        with suppress(OSError):
            if name not in names and stale.suffix in WRITERS and digest_of(stale.read_bytes()) == digest:
                stale.unlink()


def _files(outcomes: Iterable[Outcome]) -> Iterator[tuple[str, str]]:
    for outcome in outcomes:
        yield from outcome.files.items()
