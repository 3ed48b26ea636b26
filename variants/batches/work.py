"""The work of a batch: what is not in its folder yet is made, written whole, and noted as it comes."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from pathlib import Path

from ...drawing.writers import sweep_parts, write_whole
from ...scales.errors import InputError
from ..crew import Advance, Done
from ..journal import Journal, digest_of, remove_stale
from .outcome import Outcome
from .student import SUFFIXES, Made, Making, Student

JOURNAL = ".kulman-batch.jsonl"
Crew = Callable[[Making, list[Student]], Iterator[list[Done[Made]]]]
_OWN = re.compile(rf"[0-9]{{3,}}-.+|(?:manifest|key)\b.*\.csv|{re.escape(JOURNAL)}")  # names of files of a batch


def run(making: Making, students: Sequence[Student], folder: Path, crew: Crew, advance: Advance) -> tuple[Outcome, ...]:
    """Make what is not there yet; write it, and note it, as it comes."""
    sweep_parts(folder, lambda name: _OWN.match(name) is not None)
    journal = Journal(folder / JOURNAL, Outcome.from_json, Outcome.to_json)
    digests = _digests(making, students)
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


def _digests(making: Making, students: Sequence[Student]) -> list[str]:
    """Return what tells the work of each student from any other."""
    of = {task.id: making.digest_of_task(task) for task in making.tasks}
    return [digest_of(f"{of.get(student.entry.task)} {student!r}") for student in students]


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
