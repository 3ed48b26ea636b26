"""Tables of a batch: which files each student has got, and the right values for the teacher."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from ...scales.packaged import packaged
from ..marking.wording import texts
from ..roster import WHO
from ..spreadsheets.csv_write import Cell

if TYPE_CHECKING:
    from ..task import Task
    from .batch import Batch, Outcome
    from .student import Student

Rows = Iterator[tuple[Cell, ...]]


def roster_rows(task: Task, language: str) -> Rows:
    """Go through the rows of a roster to fill in: a header, and a row for each variant."""
    said = texts(language)
    yield tuple(said[f"about.{key}"] for key in ("student", "group", "variant"))
    for variant in task.variants:
        yield "", "", variant


def manifest_rows(batch: Batch, language: str) -> Rows:
    """Go through the rows of the list: a header; who, which variant and sheet, which files, or what the problem is."""
    said = packaged(__package__, "texts", language)
    yield (*_about(language), said["files"], said["notes"])
    for student, outcome in zip(batch.students, batch.outcomes, strict=True):
        yield (*_who(student, outcome), ", ".join(outcome.files), outcome.problem or "; ".join(outcome.notes))


def key_rows(batch: Batch, language: str) -> Rows:
    """Go through the rows of the key: a header; who, which variant and sheet, and every right value.

    The columns are those of a class that hands in its answers.
    """
    names = tuple(dict.fromkeys(name for outcome in batch.outcomes for name in outcome.key))
    yield (*_about(language), *names)
    for student, outcome in zip(batch.students, batch.outcomes, strict=True):
        yield (*_who(student, outcome), *(outcome.key.get(name) for name in names))


def _about(language: str) -> tuple[str, ...]:
    said = texts(language)
    return tuple(said[f"about.{key}"] for key in (*WHO, "variant", "sheet"))


def _who(student: Student, outcome: Outcome) -> tuple[Cell, ...]:
    who = student.entry.who
    return (*(getattr(who, key) for key in WHO), outcome.variant, outcome.sheet)
