"""The work of a batch: what is not in its folder yet is made, written whole, and noted as it comes."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

from ...drawing.writers import sweep_parts, write_whole
from ...scales.errors import InputError
from ..crew import Advance, Done
from ..journal import Journal, digest_of, remove_stale
from .student import SUFFIXES, Made, Making, Student

JOURNAL = ".kulman-batch.jsonl"
Crew = Callable[[Making, list[Student]], Iterator[list[Done[Made]]]]
_OWN = re.compile(rf"[0-9]{{3,}}-.+|(?:manifest|key)\b.*\.csv|{re.escape(JOURNAL)}")  # names of files of a batch


def run(making: Making, students: Sequence[Student], folder: Path, crew: Crew, advance: Advance) -> tuple[Outcome, ...]:
    """Make what is not there yet; write it, and note it, as it comes."""
    sweep_parts(folder, lambda name: _OWN.match(name) is not None)
    journal = Journal(folder / JOURNAL, Outcome.from_json, Outcome.to_json)
    of = {task.id: making.digest_of_task(task) for task in making.tasks}
    digests = [digest_of(f"{of.get(student.entry.task)} {student!r}") for student in students]
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
    before = (item for outcome in journal.before.values() for item in outcome.files.items())
    remove_stale(folder, before, {name for outcome in outcomes for name in outcome.files}, SUFFIXES)
    journal.keep(zip(digests, outcomes, strict=True))
    return outcomes


def _kept(made: Made | None, student: Student, folder: Path, language: str) -> Outcome:
    """Write what has been made for a student, but for what is there already; nothing means that a process died."""
    if made is None:
        reason = InputError("process-died").text(language)
        return Outcome.of(Made(student.entry.variant, problem=f"{student.entry.place}: {reason}"))
    outcome = Outcome.of(made)
    for name, data in made.files.items():
        put(folder / name, data)
    return outcome


def put(path: Path, data: bytes) -> None:
    """Write a file whole, unless it is there as it should be.

    Raises
    ------
    InputError
        It cannot be written.
    """
    with suppress(OSError):
        if path.read_bytes() == data:
            return
    write_whole(path, data)


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
        """Return an outcome from plain data.

        Raises
        ------
        TypeError
            The data are of something else.
        """
        if not isinstance(data["files"], dict):
            raise TypeError
        return cls(**{**data, "notes": tuple(data["notes"])})

    def to_json(self) -> dict[str, Any]:
        """Return the outcome as plain data."""
        return {item.name: getattr(self, item.name) for item in fields(self)}

    def there(self, folder: Path) -> bool:
        """Whether the files are in the folder as they were made; a problem is looked at again."""
        return not self.problem and all(self.has(folder, name) for name in self.files)

    def has(self, folder: Path, name: str) -> bool:
        """Whether one of the files is in the folder as it was made."""
        with suppress(OSError):
            return digest_of((folder / name).read_bytes()) == self.files[name]
        return False


@dataclass(frozen=True, slots=True)
class Batch:
    """The students of a class with what each has got, in the order of the roster; `warnings` are about the roster."""

    students: tuple[Student, ...]
    outcomes: tuple[Outcome, ...]
    warnings: tuple[InputError, ...] = ()

    @property
    def problems(self) -> list[str]:
        """Why students have got nothing, a line each."""
        return [outcome.problem for outcome in self.outcomes if outcome.problem]
