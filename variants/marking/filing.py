"""What a check writes: the empty form, reports on one student or on each of a class, tables of a class."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from pathlib import Path

from ...drawing.writers import Files, folder_for, save_all
from ..crew import Advance
from ..roster import Roster
from ..spreadsheets.cells_out import csv_table, table_bytes
from ..spreadsheets.grid import SUFFIXES
from .answers import Answers
from .checks import Check
from .class_run import Job, mark_class
from .class_table import class_rows, moodle_rows
from .form import class_header, form_rows
from .marked import Desk
from .report import Report, report
from .reports import REPORTS, report_bytes
from .result import Result, result_of
from .wording import texts


def write_form(check: Check, file: str | os.PathLike[str]) -> Path:
    """Write the empty form: of one student, or with a roster of the whole class.

    Raises
    ------
    InputError
        A kind of file that is no form, or a place where none can be written.
    """
    desk = Desk(check)
    task, language = check.request.task, check.request.language
    key = desk.keyed(check.request.variant or next(iter(task.variants)), {})
    if check.roster is not None:
        rows = [
            class_header(key.parts, language, check.rubric.directions != "ignored"),
            *_students(check, check.roster),
        ]
        bold, frozen = [0], 1
    else:
        about = {"task": task.id, "variant": check.request.variant}
        rows = list(form_rows(key, about))
        columns = texts(language)["column.name"]
        frozen = next(number for number, row in enumerate(rows) if row[0] == columns) + 1
        bold = [
            number for number, row in enumerate(rows) if number >= frozen - 1 and (len(row) == 1 or row[0] == columns)
        ]
    made = save_all((file,), SUFFIXES, lambda path: [(path, table_bytes(path, rows, language, task.id, bold, frozen))])
    return made[0]


def _students(check: Check, roster: Roster) -> Iterator[tuple[str, ...]]:
    """Go through the rows of a class's form: who they are, which variant; the sheet id is for them to copy."""
    for entry in roster.entries:
        variant = entry.variant_of(check.request.task, check.digits)
        yield entry.who.student, entry.who.group, entry.who.book, entry.who.number, variant, ""


def mark_alone(check: Check, answers: Answers) -> Report:
    """Mark one student.

    Raises
    ------
    InputError, PositionError
        The variant or its data have no answer key.
    """
    marked = Desk(check).mark(answers)
    language = check.request.language
    return report(marked, check.rubric, language, check.own, result_of(marked, language).flags(language))


def write_reports(found: Report, files: Sequence[Path]) -> None:
    """Write the report on one student to each file; the suffix picks text or HTML."""
    save_all(files, REPORTS, lambda file: [(file, report_bytes(found, file.suffix))])


def mark_all(
    check: Check, answers: Sequence[Answers], folder: str | os.PathLike[str] | None, advance: Advance, jobs: int | None
) -> list[Result]:
    """Mark a class; with a folder each student's reports go there."""
    place = None if folder is None else str(folder_for(folder))
    return mark_class(Job(check, place), answers, advance, jobs)


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
