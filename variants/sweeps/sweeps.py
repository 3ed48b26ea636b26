"""A task over the whole cycle: columns of numbers, dead positions, strokes, extremes, as a table, CSV or JSON."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from ...drawing.words import Words
from ...drawing.writers import WRITERS, Files, page_files, save_all
from ...plans.linkages.cycles.cycle import Cycle, cycle
from ...plans.linkages.cycles.diagrams import Diagrams, diagrams
from ...plans.linkages.mechanism import Driver, Mechanism
from ...scales.arguments import of_kind
from ...scales.errors import InputError, PositionError
from ...scales.names import unknown
from ...scales.units import Unit, parse, unit
from ..arguments import names_of, positions_of
from ..case import Case, Settings, solve_case
from ..sheets import Sheet
from ..spreadsheets.csv_write import csv_bytes
from ..task import LocatedError, Task, plain_number
from .asked import OfCase, SweepRequest, Swept
from .columns import letters
from .data import as_json
from .sheet import cycle_sheet
from .table import as_chords, as_csv, as_table

SECTIONS = POSITIONS = 12


@dataclass(frozen=True, slots=True, repr=False)
class Sweep(OfCase):
    """The whole cycle of one variant of a task.

    `cycle` holds positions, values and statuses as arrays in SI; `chosen` are the points and links that were asked for.
    Of a point or a link that is `compared`, the table shows the motion by plans and by chords.
    """

    cycle: Cycle
    chosen: tuple[str, ...]
    compared: str | None = None

    @property
    def status(self) -> str:
        """`ok` when some position has its plans, otherwise the status of all."""
        statuses = self.cycle.statuses
        return min(statuses, key=("ok", "ill-conditioned", "singular", "no-assembly").index)

    @property
    def reason(self) -> PositionError | None:
        """Why no position at all can be assembled, or None."""
        return None if self.cycle.reach.stretches else self.case.solved.error()

    def diagrams(self, of: str | int, sections: int = SECTIONS) -> Diagrams:
        """Return travel, velocity and acceleration of a point or a link, by plans and by chords.

        Parameters
        ----------
        of : str or int
            A point's letter, or the number of a link.
        sections : int
            Sections of the cycle for the chords.
        """
        return diagrams(self.cycle, str(of), positions_of("sections", sections))

    def table(self, language: str | None = None) -> str:
        """Return the main columns position by position, then dead positions, strokes, extremes and what has no plan.

        Where a point or a link is compared, its motion by plans and by chords.
        """
        if self.compared is not None:
            return self.chords(self.compared, language)
        return as_table(self.cycle, self.chosen, self._words(language))

    def chords(self, of: str | int, language: str | None = None) -> str:
        """Return a table of the velocities and accelerations of a point or a link by plans and by chords."""
        return as_chords(self.diagrams(of, len(self.cycle.angles)), str(of), self._words(language))

    def csv(self, language: str | None = None) -> str:
        """Return all columns as CSV: for `uk` and `ru` with `;` and decimal commas, for `en` with `,` and points."""
        return as_csv(self.cycle, self.chosen, self._words(language))

    def to_json(self) -> dict[str, Any]:
        """Return what `kulman sweep --json` prints: everything in SI."""
        head = {"task": self.task.id, "variant": self.variant, "status": self.status}
        return head | as_json(self.cycle, self.chosen)

    def save(self, *paths: str | os.PathLike[str]) -> list[Path]:
        """Write the sweep to each of `paths`; the suffix says how.

        Returns
        -------
        list of Path
            The files written.

        Raises
        ------
        InputError
            An unknown suffix, two outputs of one name, or a file that cannot be written: then none is.
        """
        drawn = cache(self.drawn)  # once for all files, and only where one of them shows it

        def files(path: Path) -> Files:
            saver = SAVERS.get(path.suffix.lower())
            return page_files(drawn().pages, path) if saver is None else [(path, saver(self))]

        return save_all(paths, SUFFIXES, files)

    def drawn(self) -> Sheet:
        """Return the sheet with the plan of positions and the diagrams by plans and by chords.

        Raises
        ------
        PositionError
            The position that the task itself names has no plan.
        """
        return cycle_sheet(self.case, self.cycle, self.words)

    def __repr__(self) -> str:
        """Return task, variant and the number of positions."""
        return f"<Sweep {self.task.id} {self.variant}: {self.status}, {len(self.cycle.angles)} positions>"


def _csv_file(sweep: Sweep) -> bytes:
    return csv_bytes(sweep.csv(), sweep.words.language)


SAVERS: dict[str, Callable[[Sweep], bytes]] = {".csv": _csv_file}
SUFFIXES = (*SAVERS, *WRITERS)


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
        `Sweep` of a linkage, `CamSweep`, `GearSweep`, `HoistSweep`.
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
    case = solve_case(task, variant, set, only, scales)
    asked = SweepRequest(positions, points, start, end, chords)
    found: Swept = case.kind.sweep(case, case.words(lang, notation), asked)
    return found


def linkage_sweep(case: Case, words: Words, asked: SweepRequest) -> Sweep:
    """Solve a linkage over its whole cycle.

    Raises
    ------
    InputError
        An unknown point, a place of the driver that is none, an end where a crank goes round.
    """
    mechanism = case.task.mechanism
    chosen = _chosen(mechanism, asked.points)
    first, last = (_place(case.task, *item) for item in (("start", asked.start), ("end", asked.end)))
    if last is not None and isinstance(mechanism.driver, Driver):
        raise InputError("sweep-end")
    values = case.task.values(case.variant, case.settings)
    plans = (*case.plans, "position")  # a cycle is one of positions, whatever else is wanted
    count = POSITIONS if asked.positions is None else asked.positions
    return Sweep(case, words, cycle(mechanism, values, plans, count, first, last), chosen, asked.chords)


def _chosen(mechanism: Mechanism, points: str | Iterable[str] | None) -> tuple[str, ...]:
    """Return the points and links that are asked for, each named alone or several with commas between."""
    chosen = names_of("points", points, (str, int))
    known = (*letters(mechanism), *(str(link.number) for link in mechanism.links))
    for one in chosen:
        if one not in known:
            raise unknown("motion-unknown", one, known)
    return chosen


def _place(task: Task, name: str, value: str | float | None) -> float | None:
    """Return a place of the driver in SI; a number without a unit is in that of the task's given."""
    if value is None:
        return None
    of_kind(name, value, (str, int, float), "str | float")
    own = _own_unit(task)
    try:
        if isinstance(value, str):
            return parse(value, own, own)
        return plain_number(value, own)
    except InputError as error:
        raise LocatedError(name, error) from error


def _own_unit(task: Task) -> Unit:
    """Return the unit of the given that says where the driver stands."""
    driver = task.mechanism.driver
    given = task.givens.get(driver.coordinate)
    if given is not None and given.unit is not None:
        return given.unit
    return unit("deg" if isinstance(driver, Driver) else "mm")
