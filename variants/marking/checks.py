"""A task about to be marked: what is asked, how answers are marked, for whom; empty forms out, marks back."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from ...drawing.formats import format_named
from ...drawing.writers import folder_for, save_all
from ...scales.errors import KulmanError
from ..case import Request, Settings, by_name, plans_wanted
from ..crew import Advance
from ..reader import load_task
from ..roster import Digits, Roster, read_roster
from ..spreadsheets.grid import SUFFIXES as TABLES
from ..tables import table_bytes
from ..task import Task
from .answers import Answers, Asked
from .class_run import Job, mark_class
from .keyed import asked_of, class_header, form_rows, solved
from .marked import Desk
from .reading import read_all
from .report import Report
from .result import Result, result_of
from .rubric import Rubric, read_rubric
from .wording import texts

PathLike = str | os.PathLike[str]


@dataclass(frozen=True, slots=True)
class Check:
    """How the answers to a task are marked; `own` makes reports for students, without right numbers."""

    request: Request
    rubric: Rubric
    asked: Asked
    roster: Roster | None = None
    digits: int | str = 1
    own: bool = False

    def write_form(self, file: PathLike) -> Path:
        """Write the empty form, .csv or .xlsx: of one student, or with a roster of the whole class.

        Raises
        ------
        InputError
            A kind of file that is no form, or a place where none can be written.
        """
        task, language = self.request.task, self.request.language
        key = Desk(self).keyed(self.request.variant or next(iter(task.variants)), {})
        if self.roster is not None:
            rows = [class_header(key.parts, language, self.rubric.directions != "ignored"), *self._students()]
            bold, frozen = [0], 1
        else:
            rows = list(form_rows(key, {"task": task.id, "variant": self.request.variant or ""}))
            columns = texts(language)["column.name"]
            frozen = next(number for number, row in enumerate(rows) if row[0] == columns) + 1
            bold = [n for n, row in enumerate(rows) if n >= frozen - 1 and (len(row) == 1 or row[0] == columns)]
        looks = rows, language, task.id, bold, frozen
        return save_all((file,), TABLES, lambda path: [(path, table_bytes(path, *looks))])[0]

    def _students(self) -> Iterator[tuple[str, ...]]:
        """Go through the rows of a class's form: who they are, which variant; the sheet id is for them to copy."""
        for entry in self.roster.entries if self.roster else ():
            variant = entry.variant_of(self.request.task, self.digits)
            yield entry.who.student, entry.who.group, entry.who.book, entry.who.number, variant, ""

    def read(self, *names: str, warn: Callable[[KulmanError], None] | None = None) -> list[Answers]:
        """Read the answers in files, folders, patterns.

        Parameters
        ----------
        warn : callable, optional
            Told of each file that cannot be read, if there are others; it then has answers with `unread`, no mark
            and a row in the tables. Without it such a file raises its error.

        Raises
        ------
        InputError
            Nothing can be read.
        """
        return read_all(names, self.request.task.id, self.asked, _refuse if warn is None else warn)

    def mark(self, answers: Answers) -> Report:
        """Mark one student.

        Raises
        ------
        InputError, PositionError
            The variant or its data have no answer key.
        """
        marked, language = Desk(self).mark(answers), self.request.language
        return Report(marked, self.rubric, language, self.own, result_of(marked, language).flags(language))

    def mark_all(
        self,
        answers: Sequence[Answers],
        folder: PathLike | None = None,
        advance: Advance | None = None,
        jobs: int | None = None,
    ) -> list[Result]:
        """Mark a class, in its order.

        Parameters
        ----------
        folder : str or PathLike, optional
            Where reports on every student go, .html and .txt.
        advance : callable, optional
            Told how many students more are done, and of how many.
        jobs : int, optional
            Processes; as many as there are cores when left out.

        Raises
        ------
        InputError
            A report cannot be written.
        """
        place = None if folder is None else str(folder_for(folder))
        return mark_class(Job(self, place), answers, advance or (lambda done, whole: None), jobs)


def _refuse(error: KulmanError) -> None:
    raise error


def check(
    task: PathLike | Task,
    variant: str | None = None,
    *,
    set: Settings | None = None,
    only: str | Iterable[str] | None = None,
    scales: Settings | None = None,
    preset: str = "normal",
    rubric: PathLike | None = None,
    directions: str | None = None,
    roster: PathLike | None = None,
    digits: int | str = 1,
    own: bool = False,
    notation: str | None = None,
    lang: str | None = None,
    format: str | None = None,
) -> Check:
    """Make ready to mark the answers to a task.

    Parameters
    ----------
    task, set, only, scales, notation, lang
        As for `solve`.
    variant : str, optional
        That of all answers; without it the roster, the record book or the answers say which.
    preset : str
        What may be missed by hand: `cad`, `careful`, `normal`, `lenient`.
    rubric, roster : str or PathLike, optional
        Files with weights, worths, tolerances; and with the students of a class.
    directions : str, optional
        `required`: a vector without its direction, a moment or an angular velocity without its sense is worth half;
        `optional`: what is said of them is compared; `ignored`: sizes alone are. In the place of what the rubric says;
        without either `optional`.
    digits : int or str
        How many last digits of the record book give the variant, where the roster has none; or what each of them is
        for, such as `"variant,scheme"`.
    own : bool
        Make reports for students, in which no right number stands.
    format : str, optional
        `A4`, `A3`, `A2`, `A1`: on what is drawn; the scale factors, and what is measured, are those of its sheet.

    Raises
    ------
    InputError
        Task, roster or rubric cannot be read, or name what there is not.

    >>> from kulman import check
    >>> asked = check("nau-slider-crank", "example", lang="en")
    >>> [asked.mark(answers).marked.mark for answers in asked.read("printed")]
    [80.9]
    """
    found = load_task(task)
    if variant is not None:
        found.variant(variant)
    Digits.of(digits)
    plans, language = None if only is None else plans_wanted(only, found), "en" if lang is None else lang
    said = by_name("set", set), plans, by_name("scales", scales), notation, language, format
    request = Request(found, variant, *said)
    if format is not None:
        format_named(format)
    unformatted = replace(request, format=None)  # the same is asked on every format
    asked = asked_of(solved(unformatted))
    if plans is not None:
        whole = asked_of(solved(replace(unformatted, only=None)))
        asked = replace(asked, others=frozenset(whole.names).difference(asked.names))
    marking = read_rubric(None if rubric is None else os.fspath(rubric), preset, asked, directions)
    students = None if roster is None else read_roster(os.fspath(roster), found)
    return Check(request, marking, asked, students, digits, own)
