"""A task over its whole cycle, as users ask for it."""

from __future__ import annotations

import os
from collections.abc import Iterable

from ..case import Request, Settings, positions_of
from ..reader import load_task
from ..task import Task
from .swept import SUFFIXES as SUFFIXES
from .swept import CourseSweep, SweepRequest, Swept


def sweep(
    task: str | os.PathLike[str] | Task,
    variant: str | None = None,
    *,
    set: Settings | None = None,
    only: str | Iterable[str] | None = None,
    scales: Settings | None = None,
    positions: int | None = None,
    points: str | Iterable[str] | None = None,
    start: str | float | None = None,
    end: str | float | None = None,
    chords: str | None = None,
    notation: str | None = None,
    lang: str | None = None,
) -> Swept:
    """Solve one variant of a task over its whole cycle.

    Parameters
    ----------
    task, variant, set, only, scales, notation, lang
        As for `solve`.
    positions : int, optional
        How many positions: they divide the circle of the crank evenly, into 12 when left out. Without it a table
        of a cam has its section lines, and files every degree of a cam, 101 places of contact of gears, 361 times of
        a hoist.
    points : str or iterable of str, optional
        Letters of points and numbers of links, `"B,S2,3"`: only their columns are shown.
    start : str or number, optional
        Where the driver begins: a quantity, or a number in the unit of the task's own given. Without it the crank
        begins where the working stroke begins, if the task names its output, otherwise at zero.
    end : str or number, optional
        Where a sliding driver stops; without `start` and `end` it moves as far as the links let it.
    chords : str, optional
        A point's letter, or the number of a link: the table shows its motion by plans and by chords.

    Returns
    -------
    Swept
        `Sweep` of a linkage, else `CourseSweep`.
        Also when some positions, or all, have no plan: each has its status.

    Raises
    ------
    InputError
        As for `solve`; also a number of positions that makes no cycle, and an unknown point.

    >>> from kulman import sweep
    >>> swept = sweep("nau-slider-crank", "example")
    >>> round(swept.cycle.motions[0].travel.length, 6)
    0.1
    """
    if positions is not None:
        positions_of("positions", positions)
    language = "en" if lang is None else lang
    case = Request(load_task(task), variant, set, only, scales, notation, language).case()
    asked, course = SweepRequest(positions, points, start, end, chords), case.kind.course(case.solved)
    if course is not None:
        return CourseSweep.of(case, case.words(), asked, course)
    from .linkage import Sweep  # brings its drawings

    return Sweep.of(case, case.words(), asked)
