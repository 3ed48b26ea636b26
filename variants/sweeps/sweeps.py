"""A task over its whole cycle, as users ask for it; the columns of what has a course: cams, gears, hoists."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ...drawing.words import Words
from ...drawing.writers import Files
from ...plans.solved import Columned, Course, Ends
from ...scales.errors import InputError, Option, Written
from ...scales.names import of_its_kinds
from ...scales.numbers import quote
from ...scales.units import SHOWN, unit
from ..case import Request, Settings, Wanted, positions_of
from ..reader import load_task
from ..sheets import BLOCK
from ..tables import FILES, Result, Swept, aligned, ends_data
from ..task import AnyTask

if TYPE_CHECKING:
    from ...plans.linkages.cycle import Cycle

SUFFIXES = Swept.suffixes
DIGITS, PLACES = 6, 9  # of a number in the table; decimals of the degrees of what drives
DRIVES = "phi"
CUT = ".dxf"  # of outlines
NOTHING = 1e-9  # part of the largest value of a column below which one is rounding


@dataclass(frozen=True, slots=True, repr=False)
class CourseSweep(Swept):
    """What is solved over its motion, at `positions` places; None for the marked ones in the table, many in files."""

    course: Course
    positions: int | None

    @property
    def cycle(self) -> Cycle:
        """What a linkage alone has: refused."""
        raise InputError("kind-without", task=quote(self.task.id), text="cycle")

    @property
    def count(self) -> int:
        """The number of places in files."""
        return self.positions or self.course.usual

    @property
    def statuses(self) -> NDArray[np.str_]:
        """What is said of each place: `ok`, where a follower rests on an undercut, what bears the load."""
        places = self.course.places(self.count)
        return np.array(next(iter(self.course.states(places).values()), ["ok"] * len(places)))

    def table(self, language: str | None = None) -> str:
        """Return the columns at what is marked, or at the positions asked for, then extremes and remarks."""
        words = self._words(language)
        heads, columns = self.course.rows(self.positions)
        shown = [_in_degrees_and_millimetres(column) for column in columns]
        rows = [["", *(_titled(column.name, column.unit, words) for column in shown)]]
        for k, head in enumerate(heads):  # one that comes again stands but once
            first = k == 0 or heads[k - 1] != head
            rows.append([head if first else "", *(_cell(column, k, words) for column in shown)])
        remarks = [
            words[key].format(**{name: _filled(value, words) for name, value in values.items()})
            for key, values in self.course.remarks()
        ]
        warnings = [warning.text(words.language) for warning in self.case.warnings]
        parts = aligned(rows, ()), _extremes_table(self.course.extremes(), words), "\n".join((*remarks, *warnings))
        return "\n\n".join(part for part in parts if part)

    def arrays(self, name: str = "") -> Iterator[Columned]:
        """Go through the columns in SI, or find one."""
        columns = self.course.columns(self.course.places(self.count))
        return (column for column in columns if name in ("", column.name))

    def _columns(self, words: Words) -> tuple[Sequence[Columned], Mapping[str, Sequence[str]]]:
        places = self.course.places(self.count)
        columns = [_in_degrees_and_millimetres(column) for column in self.course.columns(places)]
        return columns, self.course.states(places)

    def _data(self) -> dict[str, Any]:
        """Return columns, extremes where they are told, and what else the course has."""
        places = self.course.places(self.count)
        columns = {column.name: {"unit": column.unit, "value": column.values} for column in self.course.columns(places)}
        extremes = {
            ends.name: ends_data(ends.unit, (ends.most, ends.most_at), (ends.least, ends.least_at))
            for ends in self.course.extremes()
        }
        return {"columns": columns, **({"extremes": extremes} if extremes else {}), **self.course.data(places)}

    def _files(self, path: Path, drawn: Callable[[], Any]) -> Files:
        """Return the file of the columns, or of outlines to be cut: diagrams are on the sheet."""
        outlines = self.course.outlines() if path.suffix.lower() == CUT else {}
        if outlines:
            from ...drawing.dxf import outlined

            return [(path, outlined(outlines))]
        if path.suffix.lower() not in FILES:
            known = ", ".join((*FILES, *((CUT,) if self.course.outlines() else ())))
            sheet = self.case.command("sheet", "-o", path.name)
            raise InputError("sweep-drawing", task=quote(self.task.id), known=Written(known), command=sheet)
        return Result._files(self, path, drawn)

    def __repr__(self) -> str:
        """Return task, variant and the number of places."""
        return f"<{self.task.kind.title()}Sweep {self.task.id} {self.variant}: {self.count} {self.course.called}>"


def _in_degrees_and_millimetres(column: Columned) -> Columned:
    """Return a column as it is shown."""
    shown = SHOWN.get(column.unit)
    if shown is None:
        return column
    values: Any = column.values
    values = unit(shown).from_si(values)
    return Columned(column.name, shown, np.round(values, PLACES) if column.name == DRIVES else values)


def _titled(name: str, of: str, words: Words) -> str:
    spelled = words.spelled(of)
    return f"{name}, {spelled}" if spelled else name


def _cell(column: Columned, k: int, words: Words) -> str:
    size = float(np.max(np.abs(column.values), initial=0.0, where=np.isfinite(column.values)))
    value = float(column.values[k])
    if np.isinf(value):
        return "−∞" if value < 0.0 else "∞"
    return words.short(0.0 if abs(value) <= NOTHING * size else value, DIGITS)


def _extremes_table(found: Collection[Ends], words: Words) -> str:
    """Return the extremes of columns, and at which angles of what drives they are."""
    rows = [["", words["sweep.most"], "", words["sweep.least"], ""]]
    for one in found:
        shown = SHOWN.get(one.unit, one.unit)
        of = unit(shown)
        cells = [_titled(one.name, shown, words)]
        small = NOTHING * max(abs(one.most), abs(one.least))
        for value, at in ((one.most, one.most_at), (one.least, one.least_at)):
            tidy = 0.0 if abs(value) <= small else value
            cells += [words.short(of.from_si(tidy) + 0.0, DIGITS), f"{DRIVES} = {_degrees(at, words)}"]
        rows.append(cells)
    return aligned(rows, (0, 2, 4)) if found else ""


def _degrees(at: float, words: Words) -> str:
    """Return an angle in degrees."""
    return f"{words.short(round(unit('deg').from_si(at), 4), DIGITS)}°"


def _filled(value: Any, words: Words) -> Any:
    """Return what fills in a remark: a value with its SI unit in degrees or millimetres, else as it is."""
    if not isinstance(value, tuple):
        return value
    number, of = value
    if of == "rad":
        return _degrees(number, words)
    return f"{words.short(unit('mm').from_si(number), DIGITS)} {words.spelled('mm')}"


@of_its_kinds(*BLOCK)
def sweep(
    task: AnyTask,
    variant: str | int | None = None,
    *,
    set: Settings | None = None,
    only: Wanted = None,
    scales: Settings | None = None,
    positions: int | None = None,
    points: Wanted = None,
    start: str | float | None = None,
    end: str | float | None = None,
    chords: str | int | None = None,
    notation: str | None = None,
    lang: str | None = None,
    **block: str,
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
    chords : str or int, optional
        A point's letter, or the number of a link: the table shows its motion by plans and by chords.
    **block : str
        `student`, `group` and so on for the title block of the drawing, as for `sheet`.

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
        positions_of(positions)
    language = "en" if lang is None else lang
    case = Request(load_task(task), variant, set, only, scales, notation, language, block=block).case()
    course = case.kind.course(case.solved)
    if course is None:
        from .linkage import Sweep  # brings its drawings

        return Sweep.of(case, positions, points, (start, end), chords)
    asked = {"--points": points, Option("--from", "start"): start, "--to": end, "--chords": chords}
    for option, value in asked.items():
        if value is not None:  # what only the cycle of a linkage has
            raise InputError("kind-without", task=quote(case.task.id), text=option)
    return CourseSweep(case, case.words(), course, positions)
