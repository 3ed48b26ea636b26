"""The explanatory note of one variant: the figures of its sheet with the work told step by step."""

from __future__ import annotations

import io
from base64 import b64encode
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from ..drawing.compose import Drawn
from ..drawing.notes.blocks import (
    PROFILES,
    Block,
    Document,
    Figure,
    Heading,
    Sentences,
    Steps,
    TitlePage,
    blocks_of,
    figure_page,
)
from ..drawing.notes.docx import docx_bytes
from ..drawing.notes.markdown import markdown
from ..drawing.notes.typst import pdf_bytes
from ..drawing.text import escape
from ..drawing.writers import WRITERS, Files
from ..scales.choices import PLAIN, READINGS, RULER, SHEET
from ..scales.errors import InputError
from ..scales.names import of_its_kinds, unknown
from ..scales.numbers import SHOWN, quote
from ..scales.packaged import packaged
from ..scales.scale import Fixed
from .case import Case, Request, Settings, Wanted
from .reader import load_task
from .sheets import NOTE_TEXTS as TEXTS
from .sheets import Sheet, draw_case, said_of, sheet_id, work_code
from .tables import Saved
from .task import WITH_FORCES, AnyTask

DOCUMENTS = (".pdf", ".docx", ".md")
# documents that hold their figures
ALONE: Mapping[str, Callable[[Document], bytes]] = {".pdf": pdf_bytes, ".docx": docx_bytes}
SUFFIXES = (*DOCUMENTS, ".svg", ".png")


@dataclass(frozen=True, slots=True, repr=False)
class Note(Saved):
    """A note with the sheet whose figures it shows, to be saved to .pdf, .docx, or .md with the figures beside it.

    Of `figure` alone it can be saved as a picture, .svg or .png.
    """

    suffixes = SUFFIXES
    document: Document
    sheet: Sheet
    figure: str | None = None

    @property
    def figures(self) -> dict[str, Figure]:
        """The figures by the names of their views."""
        return {block.view.name: block for block in self.document.blocks if isinstance(block, Figure)}

    def __repr__(self) -> str:
        """Return task, variant and the number of figures."""
        title = self.document.title
        return f"<Note {title.task} {title.variant}: figures: {len(self.figures)}>"

    def _repr_markdown_(self) -> str:
        """Show the note, or its only figure, in a notebook."""
        wanted = self.figures.values() if self.figure is None else (self.figures[self.figure],)
        svg = (b64encode(self._drawn(figure, ".svg")).decode("ascii") for figure in wanted)
        drawn = [f"data:image/svg+xml;base64,{data}" for data in svg]
        return markdown(self.document, drawn) if self.figure is None else f"![]({drawn[0]})"

    def _files(self, path: Path, drawn: Callable[[], Any]) -> Files:
        """Return the document, the figures of Markdown beside it; or the one picture."""
        suffix = path.suffix.lower()
        if suffix not in DOCUMENTS:
            if self.figure is None:
                raise InputError("note-figure-missing", file=quote(path, SHOWN), known=", ".join(self.figures))
            return [(path, self._drawn(self.figures[self.figure], suffix))]
        if self.figure is not None:
            raise InputError("note-figure-alone", file=quote(path, SHOWN), figure=quote(self.figure))
        if suffix in ALONE:
            return [(path, ALONE[suffix](self.document))]
        names = [f"{path.stem}-{name}.svg" for name in self.figures]
        text = markdown(self.document, names)
        pictures = zip(names, self.figures.values(), strict=True)
        return [
            (path, text.encode("utf-8", "surrogateescape")),  # names of figures may be any bytes
            *((path.with_name(name), self._drawn(figure, ".svg")) for name, figure in pictures),
        ]

    def _drawn(self, figure: Figure, suffix: str) -> bytes:
        stream = io.BytesIO()
        WRITERS[suffix]([figure_page(figure, self.document.language)], stream)
        return stream.getvalue()


TITLED = ("student", "group", "teacher", "department", "designation", "date")  # what a title page says of a student


@of_its_kinds(*TITLED)
def note(
    task: AnyTask,
    variant: str | int | None = None,
    *,
    set: Settings | None = None,
    only: Wanted = None,
    scales: Settings | None = None,
    notation: str | None = None,
    lang: str = "uk",
    format: str | None = None,
    figure: str | None = None,
    readings: str = SHEET,
    profile: str = PLAIN,
    **block: str,
) -> Note:
    """Write the explanatory note of one variant of a task, with the figures and numbers of its sheet.

    Parameters
    ----------
    task, variant, set, only, scales, notation, lang, format
        As for `sheet`.
    figure : str, optional
        The name of the only figure that is wanted, such as `velocity`.
    readings : {"sheet", "ruler"}
        Segments as on the sheet, or to 0.5 mm as a hand reads them, with all that follows from them.
    profile : {"plain", "dstu3008"}
        How pages look: 12 pt, or 14 pt, one and a half lines, in a frame with title blocks of forms 2 and 2a.
    **block : str
        `student`, `group`, `teacher`, `department`, `date` for the title page.

    Raises
    ------
    InputError, PositionError
        As for `sheet`; or there is no such figure.
    """
    if readings not in READINGS:
        raise unknown("readings-unknown", readings, READINGS)
    if profile not in PROFILES:
        raise unknown("profile-unknown", profile, PROFILES)
    case = Request(load_task(task), variant, set, only, scales, notation, lang, format).case()
    drawn = draw_case(case)
    if readings == RULER:
        case, drawn = _by_ruler(case, drawn)
    document = Document(title_page(replace(case, block=block)), body_of(case, drawn), lang, PROFILES[profile])
    found = Note(document, drawn, figure)
    if figure is not None and figure not in found.figures:
        raise unknown("figure-unknown", figure, found.figures)
    return found


def _by_ruler(case: Case, drawn: Sheet) -> tuple[Case, Sheet]:
    """Return a case as its drawing is read with a ruler, and drawn so at the same scale factors."""
    fixed = {scale.symbol: Fixed(scale.mu, firm=True) for scale in drawn.scales.values()}
    read = replace(case, solved=case.kind.read_by_ruler(case, drawn.scales), readings=RULER)
    return read, draw_case(replace(read, choosers={**case.choosers, **fixed}, format=drawn.format))


def title_page(case: Case) -> TitlePage:
    """Return what the first page of the note of a case says."""
    identity = sheet_id(case.task, case.variant, case.settings)
    title, said = case.task.title[case.language], packaged(TEXTS, "texts", case.language)
    # of the text among the sheets of the work
    named = {"designation": f"{work_code(case)}.000 {said['title.code']}", "document_type": said["title.note"]}
    return TitlePage(title, case.task.id, case.variant, identity=identity, **{**named, **said_of(case.block)})


def body_of(case: Case, drawn: Drawn | Sheet) -> tuple[Block, ...]:
    """Return what follows the first page: who the author is changes nothing of it."""
    said, words = packaged(TEXTS, "texts", case.language), case.words()
    story = case.kind.story(replace(case, format=drawn.format), drawn.scales, words, said)
    by = said["note.over" if words.per_unit else "note.times"]
    identity = sheet_id(case.task, case.variant, case.settings)
    sources = [
        escape(case.task.source[case.language].rstrip(".") + "."),
        *filter(None, [said.get(f"literature.{case.kind.room}")]),
    ]
    cited = said["note.source" if len(sources) > 1 else "note.source_alone"]
    read = said["note.ruler" if case.readings == RULER else "note.sheet"]
    about = Sentences((said["note.about"].format(sheet=identity, by=by), read, cited))
    end = (Heading(said["note.conclusions"], numbered=False), Steps(story.conclusions)) if story.conclusions else ()
    forces = case.kind.room == "linkages" and WITH_FORCES.intersection(case.plans)
    aim = said.get("note.aim.forces" if forces else f"note.aim.{case.kind.room}", "")
    studied = said["note.studied"].format(title=escape(case.title.partition(":")[0]), variant=escape(case.variant))
    return (
        Heading(said["note.introduction"], numbered=False),
        Sentences(tuple(filter(None, (studied, aim)))),
        about,
        Heading(said["note.task"]),
        *blocks_of(drawn.views, story, said),
        *end,
        Heading(said["note.literature"], numbered=False),
        Steps(tuple(sources)),
    )
