"""The work of a batch: files of students that are not there yet are made, written whole, and noted as they come."""

from __future__ import annotations

import re
import sys
import traceback
from collections.abc import Callable, Hashable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, fields, replace
from functools import cached_property
from pathlib import Path
from typing import Any

from ... import __version__
from ...drawing.compose import Drawn
from ...drawing.notes.blocks import Block, Document
from ...drawing.notes.docx import Drawing, docx_bytes, drawings_of
from ...drawing.notes.typst import Body, pdf_bytes
from ...drawing.writers import WRITERS, page_files, slug, sweep_parts, write_whole
from ...plans.quantities import measured
from ...scales.errors import InputError, KulmanError
from ...scales.numbers import SHOWN, quote
from ...scales.units import format_unit
from ..case import Case, Request
from ..crew import Advance, Done
from ..handouts import PAPER, begun_of_case, drawing_for_print
from ..journal import Journal, digest_of, remove_stale
from ..notes import body_of, title_page
from ..roster import Entry
from ..sheets import Sheet, drawing_of, sheet_id, sheet_of, stamp_of

NOTE, HANDOUT = "note", "handout"
KEPT = 32  # variants whose drawings a process keeps for the next students that have them
NOTES = {NOTE: ".pdf", "docx": ".docx"}
FORMS = ("svg", "pdf", "png", *NOTES, HANDOUT)
SUFFIXES = {*WRITERS, *NOTES.values()}
JOURNAL = ".kulman-batch.jsonl"
_OWN = re.compile(rf"[0-9]{{3,}}-.+|(?:manifest|key)\b.*\.csv|{re.escape(JOURNAL)}")  # names of files of a batch


@dataclass(frozen=True, slots=True)
class Student:
    """A row of the roster, counted from 1."""

    number: int
    entry: Entry

    @property
    def data(self) -> tuple[str, str, tuple[tuple[str, str], ...]]:
        """What the work depends on: task, variant, data of one's own."""
        return self.entry.task, self.entry.variant, tuple(sorted(self.entry.settings.items()))


@dataclass(frozen=True, slots=True)
class Made:
    """The files of a student by name, the values of the key by quantity with its unit; or what the problem is."""

    variant: str = ""
    sheet: str = ""
    files: Mapping[str, Any] = field(default_factory=dict)
    key: Mapping[str, float | None] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    problem: str = ""


@dataclass(frozen=True, slots=True)
class Outcome(Made):
    """What a student has got, with digests of what the files hold in the place of that."""

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
            return bool(digest_of((folder / name).read_bytes()) == self.files[name])
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


@dataclass(frozen=True)
class Work:
    """What students with the same data share: all but the names; each part is made when it is first asked for."""

    case: Case
    drawing: Drawn

    @cached_property
    def body(self) -> tuple[Block, ...]:
        """The note after its first page."""
        return body_of(self.case, self.drawing)

    @cached_property
    def written(self) -> Body:
        """The same for a note as PDF."""
        return Body.of(self.body, self.case.language)

    @cached_property
    def drawings(self) -> list[Drawing]:
        """Its figures for a note as DOCX."""
        return drawings_of(self.body, self.case.language)

    @cached_property
    def blank(self) -> Drawn:
        """The drawing on the paper of handouts."""
        return drawing_for_print(replace(self.case, format=PAPER, norm="gost"))

    @cached_property
    def key(self) -> dict[str, float | None]:
        """The right values in the units in which they are shown, and the segments on the sheet, mm.

        The names are those of the columns in which a class hands in its answers.
        """
        case, found = self.case, dict[str, float | None]()
        for name, quantity in measured(case.solved.quantities, case.solved.shown_on, self.drawing.scales).items():
            if quantity.kind != "point":
                shown = quantity.shown(case.display)
                unit = format_unit(shown.unit, case.language)
                found[f"{name} [{unit}]" if unit else name] = shown.value
                if quantity.mm is not None:
                    found[f"{name}.mm"] = quantity.mm
        return found


@dataclass(frozen=True, slots=True)
class Making:
    """What is made for every student of a class: what is asked of each task, by its id; values of a row go before."""

    asked: Mapping[str, Request]
    kinds: tuple[str, ...]
    _works: dict[Hashable, Work] = field(default_factory=dict, init=False, repr=False, compare=False)

    @property
    def afresh(self) -> bool:
        """Whether processes for it must be no copies of this one: typst, once at work, stands still in a copy."""
        return NOTE in self.kinds and "typst" in sys.modules

    def begin(self) -> Callable[[Student], Made]:
        """Return what makes the files of a student."""
        return self.make

    @property
    def language(self) -> str:
        """The language of all that is made."""
        return next(iter(self.asked.values())).language

    def digests(self) -> dict[str, str]:
        """Return by task what tells this making from any that would make other files of the same student."""
        said = {
            name: [getattr(asked, item.name) for item in fields(asked) if item.name != "task"]
            for name, asked in self.asked.items()
        }
        how = __version__, self.kinds, len(self.asked) == 1
        return {name: digest_of(repr((how, self.asked[name].task.text, *items))) for name, items in said.items()}

    def make(self, student: Student) -> Made:
        """Make the files of a student; what cannot be made is told, not raised."""
        entry = student.entry
        try:
            return self._made(student)
        except KulmanError as error:
            place = "" if error is entry.problem else f"{entry.place}: "
            return Made(entry.variant, problem=f"{place}{error.text(self.language)}")
        except (KeyboardInterrupt, SystemExit):
            raise
        except BaseException as error:  # what typst panics with is no Exception
            return Made(entry.variant, problem=f"{entry.place}: {_crash(error).text(self.language)}")

    def _made(self, student: Student) -> Made:
        who, work = student.entry.who, self._work(student)
        common = work.case.block
        block = {**common, "student": who.student, "group": who.group or common.get("group", "")}
        case = replace(work.case, block=block)
        drawn = sheet_of(case, work.drawing, stamp_of(case))
        what = case.variant if len(self.asked) == 1 else f"{case.task.id} {case.variant}"
        stem = f"{student.number:03d}-{slug(f'{who.student} {what}')}"
        files = {name: data for kind in self.kinds for name, data in self._files(work, case, drawn, kind, stem)}
        notes = tuple(warning.text(self.language) for warning in drawn.warnings)
        return Made(case.variant, sheet_id(case.task, case.variant, case.settings), files, work.key, notes)

    def _files(self, work: Work, case: Case, drawn: Sheet, kind: str, stem: str) -> Iterator[tuple[str, bytes]]:
        """Go through the files of one kind: their names and what they hold."""
        if kind in NOTES:
            block = {name: text for name, text in case.block.items() if name != "designation"}
            document = Document(title_page(replace(case, block=block)), work.body, case.language)
            data = pdf_bytes(document, work.written) if kind == NOTE else docx_bytes(document, work.drawings)
            yield f"{stem}-note{NOTES[kind]}", data
            return
        if kind == HANDOUT:
            drawn = begun_of_case(case, work.blank)
            stem, kind = f"{stem}-handout", "pdf"
        yield from ((path.name, data) for path, data in page_files(drawn.pages, Path(f"{stem}.{kind}")))

    def _work(self, student: Student) -> Work:
        """Return what students with the same data share, from the last ones where it is there.

        Raises
        ------
        KulmanError
            The row was wrong, or its data have no solution.
        """
        entry, data = student.entry, student.data
        if entry.problem is not None:
            raise entry.problem
        if data not in self._works:
            for oldest in [*self._works][: len(self._works) + 1 - KEPT]:
                del self._works[oldest]
            asked = self.asked[entry.task]
            settings = {**(asked.settings or {}), **entry.settings}
            case = replace(asked, variant=entry.variant, settings=settings).case()
            self._works[data] = Work(case, drawing_of(case))
        return self._works[data]


def _crash(error: BaseException) -> InputError:
    """Return what to say of an error of the program, with the place of its source."""
    last = traceback.extract_tb(error.__traceback__)[-1]
    said = f"{type(error).__name__}: {error}".rstrip(": ")
    return InputError("student-crash", error=quote(said, SHOWN), source=f"{Path(last.filename).name}:{last.lineno}")


Crew = Callable[[Making, list[Student]], Iterator[list[Done[Made]]]]


def run(making: Making, students: Sequence[Student], folder: Path, crew: Crew, advance: Advance) -> tuple[Outcome, ...]:
    """Make what is not there yet; write it, and note it, as it comes."""
    sweep_parts(folder, lambda name: _OWN.match(name) is not None)
    journal = Journal(folder / JOURNAL, Outcome.from_json, Outcome.to_json)
    of = making.digests()
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
