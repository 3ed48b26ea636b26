"""What `kulman check` does: the empty form out, answers in, reports and tables out."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import click

from ...drawing.writers import check_outputs, save_all, write_whole
from ...scales.errors import InputError, KulmanError
from ...scales.numbers import quote
from ..reader import load_task
from .answers import Answers, Asked
from .cells_out import csv_bytes, table_bytes
from .class_run import Advance, Job, mark_class
from .class_table import class_rows, flags_of, moodle_rows, summary
from .flags import too_exact
from .form import class_header, form_rows
from .grid import SUFFIXES
from .intake import read_all
from .keyed import Request, asked_of
from .marked import Desk
from .report import Report, report
from .report_json import to_json
from .report_text import report_text
from .reports import REPORTS, report_bytes
from .result import Result, result_of
from .roster import Roster, read_roster, variant_of_book
from .rubric import Rubric, read_rubric
from .wording import texts


def run(
    task: str,
    answers: Sequence[str],
    *,
    form: str | None,
    folder: str | None,
    files: Sequence[Path],
    moodle: str | None,
    jobs: int,
    as_json: bool,
    warn: Callable[[KulmanError], None],
    **options: Any,
) -> None:
    """Do what the command line asks for; print what is to be read, `warn` of what is odd.

    Raises
    ------
    InputError
        Task, roster, rubric or answers cannot be read, or something cannot be written: then nothing has been.
    """
    if form is None and not answers:
        raise InputError("check-nothing")
    if moodle is not None:
        check_outputs(Path(moodle), known=(".csv",))
    check = prepare(task, **options)
    if form is not None:
        write_form(check, Path(form))
        click.echo(form)
    if not answers:
        return
    found = read_all(answers, check.request.task.id, check.asked, warn)
    if len(found) == 1 and folder is None and moodle is None and not any(map(_is_table, files)):
        _one(check, found[0], files, as_json)
    elif as_json or any(not _is_table(file) for file in files):
        raise InputError("check-class")
    else:
        _class(check, found, files, folder, moodle, jobs)


def _is_table(file: Path) -> bool:
    return file.suffix.lower() in SUFFIXES


def _one(check: Check, answers: Answers, files: Sequence[Path], as_json: bool) -> None:
    """Mark one student: the report to files, else to the console."""
    told = mark_alone(check, answers)
    if as_json:
        click.echo(json.dumps(to_json(told, check.rubric), ensure_ascii=True, allow_nan=False, indent=2))
    elif not files:
        click.echo(report_text(told), nl=False)
    write_reports(told, files)
    for file in files:
        click.echo(str(file))


def _class(
    check: Check, found: Sequence[Answers], files: Sequence[Path], folder: str | None, moodle: str | None, jobs: int
) -> None:
    """Mark a class: a line per student to the console, reports to the folder, tables to files."""
    place = None if folder is None else Path(folder)
    if sys.stderr is not None and sys.stderr.isatty():
        with click.progressbar(length=len(found), file=sys.stderr) as bar:
            results = mark_all(check, found, place, bar.update, jobs or None)
    else:
        results = mark_all(check, found, place, lambda done: None, jobs or None)
    table = None if moodle is None else Path(moodle)
    write_tables(check, results, found, files, table)
    for line in class_lines(check, results):
        click.echo(line)
    for path in (*files, *filter(None, (place, table))):
        click.echo(str(path))


@dataclass(frozen=True, slots=True)
class Check:
    """A task about to be marked, as the command line asks for it."""

    request: Request
    rubric: Rubric
    asked: Asked
    roster: Roster | None
    digits: int
    own: bool


def prepare(
    task: str,
    variant: str | None,
    *,
    settings: Mapping[str, str],
    only: Iterable[str] | None,
    scales: Mapping[str, str],
    notation: str | None,
    language: str,
    preset: str,
    rubric: str | None,
    roster: str | None,
    digits: int,
    own: bool,
) -> Check:
    """Read task, rubric and roster.

    Raises
    ------
    InputError
        One of them cannot be read, or names what there is not.
    """
    found = load_task(task)
    if variant is not None:
        found.variant(variant)
    plans = None if only is None else tuple(only)
    request = Request(found, variant or "", settings, plans, scales, notation, language)
    asked = asked_of(request.solution(variant or next(iter(found.variants)), {}))
    if plans is not None:
        whole = asked_of(replace(request, only=None).solution(variant or next(iter(found.variants)), {}))
        asked = replace(asked, others=frozenset(whole.names).difference(asked.names))
    marking = read_rubric(rubric, preset, asked)
    return Check(request, marking, asked, read_roster(roster, found) if roster else None, digits, own)


def write_form(check: Check, file: Path) -> None:
    """Write the empty form: of one student, or with a roster of the whole class.

    Raises
    ------
    InputError
        A kind of file that is no form, or a place where none can be written.
    """
    check_outputs(file, known=SUFFIXES)
    desk = _desk(check)
    task, language = check.request.task, check.request.language
    key = desk.keyed(check.request.variant or next(iter(task.variants)), {})
    if check.roster is not None:
        rows = [class_header(key.parts, language), *_students(check, check.roster)]
        bold, frozen = [0], 1
    else:
        about = {"task": task.id, "variant": check.request.variant}
        rows = list(form_rows(key.solution.solved, key.parts, key.asked, key.solution.words, about))
        columns = texts(language)["column.name"]
        frozen = next(number for number, row in enumerate(rows) if row[0] == columns) + 1
        bold = [
            number for number, row in enumerate(rows) if number >= frozen - 1 and (len(row) == 1 or row[0] == columns)
        ]
    write_whole(file, table_bytes(file, rows, language, task.id, bold, frozen))


def _students(check: Check, roster: Roster) -> Iterator[tuple[str, ...]]:
    """Go through the rows of a class's form: who they are, which variant; the sheet id is for them to copy."""
    for entry in roster.entries:
        variant = entry.variant
        if not variant and entry.who.book:
            variant = variant_of_book(check.request.task, entry.who.book, check.digits)
        yield entry.who.student, entry.who.group, entry.who.book, entry.who.number, variant, ""


def mark_alone(check: Check, answers: Answers) -> Report:
    """Mark one student.

    Raises
    ------
    InputError, PositionError
        The variant or its data have no answer key.
    """
    marked = _desk(check).mark(answers)
    language = check.request.language
    exact = too_exact(result_of(marked, language).segments)
    flags = [texts(language)["flag.exact"]] if exact else []
    return report(marked, check.rubric, language, check.own, flags)


def _desk(check: Check) -> Desk:
    return Desk(check.request, check.rubric, check.roster, check.digits)


def write_reports(found: Report, files: Sequence[Path]) -> None:
    """Write the report on one student to each file; the suffix picks text or HTML."""
    save_all(files, REPORTS, lambda file: [(file, report_bytes(found, file.suffix))])


def mark_all(
    check: Check, answers: Sequence[Answers], folder: Path | None, advance: Advance, jobs: int | None
) -> list[Result]:
    """Mark a class; with a folder each student's reports go there."""
    if folder is not None:
        _make(folder)
    place = None if folder is None else str(folder)
    job = Job(check.request, check.rubric, check.roster, check.digits, check.own, place)
    return mark_class(job, answers, advance, jobs)


def _make(folder: Path) -> None:
    """Make a folder for reports."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except (OSError, ValueError) as problem:
        reason = getattr(problem, "strerror", "") or ""
        raise InputError("output-refused", file=quote(folder, 200), reason=reason) from None


def write_tables(
    check: Check, results: Sequence[Result], answers: Sequence[Answers], files: Sequence[Path], moodle: Path | None
) -> None:
    """Write the tables of a class."""
    language = check.request.language
    absent = check.roster.missing(answers) if check.roster else []
    rows = list(class_rows(results, absent, language))
    for file in files:
        write_whole(file, table_bytes(file, rows, language, check.request.task.id, [0], 1))
    if moodle is not None:
        write_whole(moodle, csv_bytes(list(moodle_rows(results, language)), language, ","))


def class_lines(check: Check, results: Sequence[Result]) -> Iterator[str]:
    """Go through what is printed of a class: a line per student, then the whole."""
    language = check.request.language
    width = max((len(_called(result)) for result in results), default=0)
    for result, flags in zip(results, flags_of(results, language), strict=True):
        mark = "–" if result.mark is None else f"{result.mark:g}"
        told = [result.first and texts(language)["class.feedback_first"].format(symbol=result.first)]
        told += [", ".join(result.mistakes), *flags, *(result.notes if result.mark is None else ())]
        yield f"{_called(result):{width}}  {mark:>5}  {'  '.join(filter(None, told))}".rstrip()
    yield summary(results, language)


def _called(result: Result) -> str:
    return result.who.student or result.source
