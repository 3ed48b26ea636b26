"""A linkage over its whole cycle: positions, dead positions, strokes, extremes; table, CSV, JSON, sheet."""

from __future__ import annotations

import os
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from ...drawing.linkages.layout.sheet import draw
from ...drawing.linkages.views import Contents
from ...drawing.titleblock import Stamp
from ...drawing.words import Words
from ...drawing.writers import Files, page_files, save_all
from ...plans.linkages.cycles.cycle import Cycle, Diagrams, cycle, diagrams
from ...plans.linkages.mechanism import Driver, Mechanism
from ...scales.arguments import of_kind
from ...scales.errors import InputError, PositionError
from ...scales.units import parse, unit
from ..case import Case, all_known, names_of, positions_of
from ..kinds.linkage import placed
from ..sheets import Sheet, sheet_of
from ..task import LocatedError, Task, plain_number
from .cycles import as_chords, as_csv, as_json, as_table, letters
from .sweeps import CSV, SUFFIXES, SweepRequest, Swept

SECTIONS = POSITIONS = 12


@dataclass(frozen=True, slots=True, repr=False)
class Sweep(Swept):
    """The whole cycle of one variant of a task.

    `cycle` holds positions, values and statuses as arrays in SI; `chosen` are the points and links that were asked for.
    Of a point or a link that is `compared`, the table shows the motion by plans and by chords.
    """

    cycle: Cycle
    chosen: tuple[str, ...]
    compared: str | None = None

    @classmethod
    def of(cls, case: Case, words: Words, asked: SweepRequest) -> Sweep:
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
        return cls(case, words, cycle(mechanism, values, plans, count, first, last), chosen, asked.chords)

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
        """Return the columns of what is chosen, or all, as CSV."""
        return as_csv(self.cycle, self.chosen, self._words(language))

    def _data(self) -> dict[str, Any]:
        return as_json(self.cycle, self.chosen)

    def save(self, *paths: str | os.PathLike[str]) -> list[Path]:
        """Write all columns to .csv, the drawing to other kinds of files."""
        drawn = cache(self.drawn)  # once for all files, and only where one of them shows it

        def files(path: Path) -> Files:
            return [(path, self._csv_file())] if path.suffix.lower() == CSV else page_files(drawn().pages, path)

        return save_all(paths, SUFFIXES, files)

    def drawn(self) -> Sheet:
        """Return the sheet with the plan of positions and the diagrams by plans and by chords.

        Raises
        ------
        PositionError
            The position that the task itself names, which the plan of positions shows, has no plan.
        """
        case, words = self.case, self.words
        error = case.solved.error()
        if error is not None:
            raise error
        title, kind = self.task.title[words.language], words["sheet.document"]
        contents = Contents(placed(case), ("cycle",), case.choosers, case.givens, words, "gost", self.cycle)
        return sheet_of(case, draw(contents), Stamp(title=title, document_type=kind, language=words.language))

    def __repr__(self) -> str:
        """Return task, variant and the number of positions."""
        return f"<Sweep {self.task.id} {self.variant}: {self.status}, {len(self.cycle.angles)} positions>"


SWEEP = Sweep


def _chosen(mechanism: Mechanism, points: str | Iterable[str] | None) -> tuple[str, ...]:
    """Return the points and links that are asked for, each named alone or several with commas between."""
    chosen = names_of("points", points, (str, int))
    known = (*letters(mechanism), *(str(link.number) for link in mechanism.links))
    all_known("motion-unknown", chosen, known)
    return chosen


def _place(task: Task, name: str, value: str | float | None) -> float | None:
    """Return a place of the driver in SI; a number without a unit is in that of the task's given."""
    if value is None:
        return None
    of_kind(name, value, (str, int, float), "str | float")
    given, crank = task.givens.get(task.mechanism.driver.coordinate), isinstance(task.mechanism.driver, Driver)
    own = given.unit if given is not None and given.unit is not None else unit("deg" if crank else "mm")
    try:
        if isinstance(value, str):
            return parse(value, own, own)
        return plain_number(value, own)
    except InputError as error:
        raise LocatedError(name, error) from error
