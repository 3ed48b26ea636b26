"""Handouts of one variant: the blank sheet, the same with the first steps done, the key, a plan to lay over."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from dataclasses import replace

from ..drawing.compose import Drawn
from ..drawing.formats import format_named, printable
from ..drawing.handouts import begun_pages, gridded, keyed, marked, over_page
from ..drawing.page import Page
from ..drawing.pens import Norm
from ..scales.arguments import of_kind
from ..scales.errors import InputError
from ..scales.names import unknown
from ..scales.numbers import quote
from .case import Case, Request, Settings
from .reader import load_task
from .sheets import Sheet, drawing_of, sheet_of, stamp_of
from .task import Task

PAPER = "A4"
APART = (  # what is not asked for together
    ("--hidden-key", "--key"),
    ("--hidden-key", "--over"),
    ("--grid", "--over"),
    ("--steps", "--key"),
    ("--steps", "--over"),
)
ALL = 1000  # steps: no plan has more


def handout(
    task: str | os.PathLike[str] | Task,
    variant: str | None = None,
    *,
    steps: int = 0,
    key: bool = False,
    hidden_key: bool = False,
    over: str | None = None,
    grid: bool = False,
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
    hidden_key : bool
        Add what the handout leaves out as a layer that SVG and PDF open without: for the teacher, never for students.
    over : str, optional
        The view that is drawn alone on its page, to be printed on a transparency and laid over a student's plan.
    grid : bool
        Lay a light grid of 5 mm under the drawing.
    block : mapping of str to str, optional
        What the title block says, as for `sheet`.

    Raises
    ------
    InputError, PositionError
        As for `sheet`; a number of steps below zero; no such view; steps or a hidden key beside the key; steps, a grid
        or a hidden key with one view alone.
    """
    of_kind("steps", steps, (int,), "int")
    if steps < 0:
        raise InputError("handout-steps", text=str(steps))
    asked = {"--key": key, "--over": over is not None, "--hidden-key": hidden_key, "--grid": grid, "--steps": steps > 0}
    for first, second in APART:
        if asked[first] and asked[second]:
            raise InputError("handout-apart", first=first, second=second)
    case = Request(load_task(task), variant, set, only, scales, notation, lang, format, norm, block or {}).case()
    drawing = drawing_for_print(case)
    if over is None and not key:
        drawn = begun_of_case(case, drawing, steps)
    else:
        drawn = sheet_of(case, drawing, stamp_of(case))
        pages = drawn.pages if over is None else (_alone(drawn, over),)
        drawn = replace(drawn, pages=tuple(map(marked, pages)))
    if hidden_key:
        drawn = replace(drawn, pages=tuple(map(keyed, drawn.pages, drawing.placed)))
    if not grid:
        return drawn
    sheet, norm = drawing.sheet, drawing.norm
    return replace(drawn, pages=tuple(gridded(page, sheet, norm, at == 0) for at, page in enumerate(drawn.pages)))


def _alone(drawn: Sheet, over: str) -> Page:
    """Return a page with one view."""
    figures = {view.name: view for view in drawn.views if not (view.rows or view.lines)}
    if over not in figures:
        raise unknown("figure-unknown", over, figures)
    return over_page(figures[over], drawn.pages[0])


def drawing_for_print(case: Case) -> Drawn:
    """Draw the sheet of a case, but for its title block, on paper whose edge printers leave white."""
    return drawing_of(replace(case, format=printable(format_named(case.format or PAPER))))


def begun_of_case(case: Case, drawing: Drawn, steps: int = 0) -> Sheet:
    """Return the handout of a case whose `drawing` is for print, with so many steps done."""
    drawn = sheet_of(case, drawing, stamp_of(case))
    words = case.words()

    def done(count: int) -> list[Page]:
        return begun_pages(drawn.pages, drawn.views, case.kind.begun(case, drawn.scales, words, count), count)

    begun = done(steps)
    stepless = steps > 0 and begun == done(0) == done(ALL)  # the first ones may set a plan up, as on the blank
    idle = (InputError("handout-stepless", task=quote(case.task.id), steps=steps),) if stepless else ()
    return replace(drawn, pages=tuple(map(marked, begun)), warnings=(*drawn.warnings, *idle))
