"""What is made for one student: the files of the sheet, the right values for the key; or why there are none."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from ... import __version__
from ...drawing.notes.typst import pdf_bytes
from ...drawing.pens import Norm
from ...drawing.writers import page_files, slug
from ...plans.quantities import measured
from ...scales.errors import InputError, KulmanError
from ...scales.numbers import quote
from ...scales.units import format_unit
from ..case import Case, solve_case
from ..journal import digest_of
from ..roster import Entry
from ..sheet_id import sheet_id
from ..sheets import Sheet, draw_case
from ..spreadsheets.grid import SHOWN
from ..task import Task

NOTE, HANDOUT = "note", "handout"
FORMS = ("svg", "pdf", "png", NOTE, HANDOUT)


@dataclass(frozen=True, slots=True)
class Student:
    """A row of the roster, counted from 1."""

    number: int
    entry: Entry


@dataclass(frozen=True, slots=True)
class Made:
    """The files of a student by name, the values of the key by quantity with its unit; or what the problem is."""

    variant: str = ""
    sheet: str = ""
    files: Mapping[str, bytes] = field(default_factory=dict)
    key: Mapping[str, float | None] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    problem: str = ""


@dataclass(frozen=True, slots=True)
class Making:
    """What is made for every student of a class, and how; the values of a row go before `settings`."""

    task: Task
    kinds: tuple[str, ...]
    settings: Mapping[str, str | float] = field(default_factory=dict)
    only: tuple[str, ...] | None = None
    scales: Mapping[str, str | float] = field(default_factory=dict)
    format: str | None = None
    norm: Norm = "gost"
    notation: str | None = None
    language: str = "uk"
    block: Mapping[str, str] = field(default_factory=dict)
    digits: int = 1

    def begin(self) -> Callable[[Student], Made]:
        """Return what makes the files of a student."""
        return self.make

    def digest(self) -> str:
        """Return what tells this making from any that would make other files."""
        how = (self.kinds, self.settings, self.only, self.scales, self.format, self.norm, self.notation)
        return digest_of(repr((__version__, self.task.text, how, self.language, self.block, self.digits)))

    def make(self, student: Student) -> Made:
        """Make the files of a student; what cannot be made is told, not raised."""
        try:
            return self._made(student)
        except KulmanError as error:
            place = "" if error is student.entry.problem else f"{student.entry.place}: "
            return Made(student.entry.variant, problem=f"{place}{error.text(self.language)}")

    def _made(self, student: Student) -> Made:
        case = self._case(student.entry)
        who = student.entry.who
        block = {**self.block, "student": who.student, "group": who.group or self.block.get("group", "")}
        drawn = draw_case(case, block, self.format, self.norm, self.notation, self.language)
        stem = f"{student.number:03d}-{slug(f'{who.student} {case.variant}')}"
        files = {name: data for kind in self.kinds for name, data in self._files(case, block, drawn, kind, stem)}
        notes = tuple(warning.text(self.language) for warning in drawn.warnings)
        return Made(
            case.variant,
            sheet_id(case.task, case.variant, case.settings),
            files,
            _key(case, drawn, self.language),
            notes,
        )

    def _files(
        self, case: Case, block: dict[str, str], drawn: Sheet, kind: str, stem: str
    ) -> Iterator[tuple[str, bytes]]:
        """Go through the files of one kind: their names and what they hold."""
        if kind == NOTE:
            from ..notes import note_of_sheet

            page = {name: text for name, text in block.items() if name != "designation"}
            document = note_of_sheet(case, drawn, page, self.notation, self.language).document
            yield f"{stem}-note.pdf", pdf_bytes(document)
            return
        if kind == HANDOUT:
            from ..handouts import begun_of_case

            drawn, stem, kind = (
                begun_of_case(case, block, lang=self.language, notation=self.notation),
                f"{stem}-handout",
                "pdf",
            )
        yield from ((path.name, data) for path, data in page_files(drawn.pages, Path(f"{stem}.{kind}")))

    def _case(self, entry: Entry) -> Case:
        """Solve the variant of a row with its data.

        Raises
        ------
        InputError
            The row was wrong, or says no variant.
        """
        if entry.problem is not None:
            raise entry.problem
        variant = entry.variant_of(self.task, self.digits)
        if not variant:
            raise InputError("batch-no-variant", known=quote(", ".join(self.task.variants), SHOWN))
        return solve_case(self.task, variant, {**self.settings, **entry.settings}, self.only, self.scales)


def _key(case: Case, drawn: Sheet, language: str) -> dict[str, float | None]:
    """Return the right values in the units in which they are shown, and the segments on the sheet, mm.

    The names are those of the columns in which a class hands in its answers.
    """
    found: dict[str, float | None] = {}
    for name, quantity in measured(case.solved.quantities, case.solved.shown_on, drawn.scales).items():
        if quantity.kind != "point":
            shown = quantity.shown(case.display)
            unit = format_unit(shown.unit, language)
            found[f"{name} [{unit}]" if unit else name] = shown.value
            if quantity.mm is not None:
                found[f"{name}.mm"] = quantity.mm
    return found
