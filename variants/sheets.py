"""The sheet of one variant of a task, drawn and saved."""

from __future__ import annotations

import io
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from ..drawing.formats import format_named
from ..drawing.linkages.fitting import Contents
from ..drawing.linkages.sheet import draw
from ..drawing.page import Page
from ..drawing.pens import Norm
from ..drawing.titleblock import Stamp
from ..drawing.words import Words
from ..drawing.writers import write_pages, writer_for
from ..scales.errors import InputError
from ..scales.scale import Scale
from .solution import Settings, givens_of, read_choosers, solve_variant, warnings_of
from .task import Task


@dataclass(frozen=True, slots=True)
class Sheet:
    """A drawn sheet: one page or several, and the scale factors drawn; a notebook shows its first page."""

    pages: tuple[Page, ...]
    scales: Mapping[str, Scale]
    format: str
    warnings: tuple[InputError, ...] = ()

    def save(self, *paths: str | os.PathLike[str], tile: str | None = None) -> list[Path]:
        """Write the sheet to each of `paths`; the suffix picks the writer.

        Returns
        -------
        list of Path
            The files written; several pages as SVG or PNG become `x-1.svg`, `x-2.svg`, ...

        Raises
        ------
        InputError
            An unknown suffix (before anything is written), or a file that cannot be written.
        """
        targets = [Path(path) for path in paths]
        for path in targets:
            writer_for(path)
        return [written for path in targets for written in write_pages(self.pages, path, tile)]

    def svg(self, page: int = 1) -> str:
        """Return one page as SVG text."""
        from ..drawing.svg import write_svg

        stream = io.BytesIO()
        write_svg(self.pages[page - 1], stream)
        return stream.getvalue().decode("utf-8")

    def _repr_svg_(self) -> str:
        """Show the first page in a notebook."""
        return self.svg()


def sheet(
    task: str | os.PathLike[str] | Task,
    variant: str | None = None,
    *,
    set: Settings | None = None,
    only: Sequence[str] | None = None,
    scales: Settings | None = None,
    format: str | None = None,
    norm: Norm = "gost",
    notation: str | None = None,
    lang: str = "uk",
    student: str = "",
    group: str = "",
    teacher: str = "",
    department: str = "",
    designation: str = "",
    date: str = "",
) -> Sheet:
    """Draw the sheet of one variant of a task to scale.

    Parameters
    ----------
    task, variant, set, only, scales, notation
        As for `solve`.
    format : str, optional
        `A4`, `A3`, `A2`, `A1`; without it the smallest of which one sheet holds everything. On a smaller one the
        sheet has several pages.
    norm : {"gost", "iso"}
        Lines, frame and title block by GOST, or by ISO 5457 and 7200.
    lang : {"uk", "ru", "en"}
        Language of all words on the sheet.
    student, group, teacher, department, designation, date : str
        For the title block; what is left out stays blank.

    Raises
    ------
    InputError
        As for `solve`; also an unknown format, and a scale factor at which a plan does not fit.
    PositionError
        The position has no plan.
    """
    paper = format_named(format) if format else None
    found, name, solved = solve_variant(task, variant, set, only)
    words = Words.of(lang, notation or found.notation)
    error = solved.error()
    if error is not None:
        raise error
    stamp = Stamp(
        title=found.title[lang],
        designation=designation,
        organisation=department,
        group=group,
        student=student,
        teacher=teacher,
        date=date,
        document_type=words["sheet.document"],
        language=lang,
    )
    contents = Contents(
        solved,
        tuple(only or found.plans),
        read_choosers(found, scales, solved),
        givens_of(found, name, set),
        words,
        norm,
    )
    drawn = draw(contents, stamp, paper)
    return Sheet(tuple(drawn.pages), drawn.scales, drawn.format, warnings_of(solved))
