"""Handouts of one variant: the blank sheet, the same with the first steps done, the key, a plan to lay over."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from dataclasses import replace

from ..drawing.formats import format_named
from ..drawing.handouts.begun import begun_pages
from ..drawing.handouts.over import over_page
from ..drawing.handouts.print_marks import marked, printable
from ..drawing.pens import Norm
from ..scales.arguments import of_kind
from ..scales.errors import InputError
from ..scales.names import unknown
from .case import Case, Settings, solve_case
from .sheets import Sheet, draw_case
from .task import Task

PAPER = "A4"


def handout(
    task: str | os.PathLike[str] | Task,
    variant: str | None = None,
    *,
    steps: int = 0,
    key: bool = False,
    over: str | None = None,
    set: Settings | None = None,
    only: str | Iterable[str] | None = None,
    scales: Settings | None = None,
    format: str = PAPER,
    norm: Norm = "gost",
    notation: str | None = None,
    lang: str = "uk",
    block: Mapping[str, str] | None = None,
) -> Sheet:
    """Draw a handout: the sheet of a variant with its answers left out, at the same places and scales as the key.

    Parameters
    ----------
    task, variant, set, only, scales, format, norm, notation, lang
        As for `sheet`.
    steps : int
        How many steps of every plan are done, as the note numbers them; poles, pivots, guides are always there. Where
        nothing that is drawn has steps, a warning says so.
    key : bool
        Draw the whole work, to be laid on the blank.
    over : str, optional
        The view that is drawn alone on its page, to be printed on a transparency and laid over a student's plan.
    block : mapping of str to str, optional
        What the title block says, as for `sheet`.

    Raises
    ------
    InputError, PositionError
        As for `sheet`; a number of steps below zero; no such view.
    """
    of_kind("steps", steps, (int,), "int")
    if steps < 0:
        raise InputError("handout-steps", text=str(steps))
    case = solve_case(task, variant, set, only, scales)
    if over is None and not key:
        return begun_of_case(case, block or {}, steps, format, norm, notation, lang)
    drawn = draw_case(case, block or {}, printable(format_named(format)), norm, notation, lang)
    if over is not None:
        figures = {view.name: view for view in drawn.views if not (view.rows or view.lines)}
        if over not in figures:
            raise unknown("figure-unknown", over, figures)
        return replace(drawn, pages=(marked(over_page(figures[over], drawn.pages[0])),))
    return replace(drawn, pages=tuple(map(marked, drawn.pages)))


def begun_of_case(
    case: Case,
    block: Mapping[str, str],
    steps: int = 0,
    format: str = PAPER,
    norm: Norm = "gost",
    notation: str | None = None,
    lang: str = "uk",
) -> Sheet:
    """Draw the handout of a case with so many steps done."""
    drawn = draw_case(case, block, printable(format_named(format)), norm, notation, lang)
    words = case.words(lang, notation)
    shown = case.kind.begun(case, drawn.scales, words, steps)
    idle = (InputError("handout-stepless", task=case.task.id, steps=steps),) if steps and not shown else ()
    pages = tuple(map(marked, begun_pages(drawn.pages, drawn.views, shown)))
    return replace(drawn, pages=pages, warnings=(*drawn.warnings, *idle))
