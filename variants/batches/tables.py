"""Tables of a batch: which files each student has got, and the right values for the teacher."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from ...scales.packaged import packaged
from ..marking.wording import texts
from ..roster import WHO
from ..spreadsheets.csv_write import Cell

if TYPE_CHECKING:
    from ..task import Task
    from .outcome import Batch, Outcome
    from .student import Student

Rows = Iterator[tuple[Cell, ...]]


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
