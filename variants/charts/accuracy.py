"""The chart of speed against accuracy of one variant: rows, table, CSV, JSON, picture."""

from __future__ import annotations

import os
import platform
import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from ... import __version__
from ...drawing.formats import format_named
from ...drawing.words import Words
from ...plans.contest import FULL, Contest, Effort, Entry
from ...plans.hands.hand import preset
from ...plans.linkages.accuracy.comparison import contest
from ...plans.linkages.accuracy.hand_drawn import DrawnSheet, by_hand
from ...plans.linkages.cycles.cycle import Cycle
from ...scales.choices import SIZES
from ...scales.errors import InputError
from ..kinds.linkage import linkage
from ..sheets import scales_of
from ..tables import Cell, aligned
from .data import Scene, as_csv, finite, place_column, place_si, place_value, short, wrapped

if TYPE_CHECKING:
    from matplotlib.figure import Figure

HEAD = ("method", "setting", "kind", "error", "typical", "quantity")  # errors in parts of the largest: without a unit
TIMES = ("seconds [s]", "at_once", "failed", "front")


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class AccuracyChart:
    """Speed against accuracy: `contest` holds an entry for every method, setting and kind of quantities.

    `turns` tells whether the driver does, None where places are times; `compared` is the key of what errors and times
    are.
    """

    heading: ClassVar[str] = "chart.accuracy"
    scene: Scene
    turns: bool | None
    contest: Contest
    compared: str = "chart.compared"

    def table(self, words: Words) -> str:
        """Return a row for every method and setting: error and time by kinds; * where no other method beats it."""
        kinds = [kind.name for kind in self.contest.kinds]
        head = [words["chart.method"], words["chart.setting"]]
        head += [text for kind in kinds for text in (words[f"chart.kind.{kind}"], words["chart.seconds"], "")]
        fronts = {kind: set(map(id, self.contest.front(kind))) for kind in kinds}
        rows: dict[tuple[str, float | str], dict[str, list[str]]] = {}
        for entry in self.contest.entries:
            row = rows.setdefault((entry.method, entry.setting), {})
            mark = "*" if id(entry) in fronts[entry.kind] else ""
            row[entry.kind] = [short(words, entry.error), short(words, entry.seconds), mark]
        lines = [head]
        for (method, setting), row in rows.items():
            shown = words.decimal(f"{setting:g}" if isinstance(setting, float) else str(setting))
            cells = [cell for kind in kinds for cell in row.get(kind, ["", "", ""])]
            lines.append([words[f"chart.{method}"], shown, *cells])
        said = words["chart.front_mark"].format(text=words["chart.key.front"])
        return "\n".join((aligned(lines), "", said, *map(wrapped, self.notes(words))))

    def notes(self, words: Words) -> tuple[str, str]:
        """Return how and on what it was measured."""
        batch = words.number(self.contest.effort.at_once, 0)
        return words[self.compared].format(positions=len(self.contest.places), batch=batch), machine(words)

    def csv(self, words: Words) -> bytes:
        """Return all entries."""
        fronts = {id(entry) for kind in self.contest.kinds for entry in self.contest.front(kind.name)}
        rows = [self._row(entry, id(entry) in fronts) for entry in self.contest.entries]
        return as_csv((*HEAD, place_column(self.turns), *TIMES), rows, words)

    def _row(self, e: Entry, front: bool) -> list[Cell]:
        at = place_value(self.turns, e.place)
        head: list[Cell] = [e.method, e.setting, e.kind, e.error, e.typical, e.name, at]
        return [*head, e.seconds, e.at_once, e.failed, int(front)]

    def to_json(self) -> dict[str, Any]:
        """Return all entries as data."""
        return {
            "machine": machine(Words.of("en", self.scene.case.task.notation)),
            "hand": self.scene.hand,
            "places": [place_si(self.turns, at) for at in self.contest.places],
            "entries": [self._item(entry) for entry in self.contest.entries],
        }

    def _item(self, entry: Entry) -> dict[str, Any]:
        return {
            "method": entry.method,
            "setting": entry.setting,
            "kind": entry.kind,
            "error": finite(entry.error),
            "typical": finite(entry.typical),
            "quantity": entry.name,
            "at": place_si(self.turns, entry.place),
            "seconds": finite(entry.seconds),
            "at_once": entry.at_once,
            "failed": entry.failed,
            "front": any(entry is one for one in self.contest.front(entry.kind)),
        }

    def figure(self, words: Words) -> Figure:
        """Draw the picture."""
        from ...drawing.charts.accuracy import accuracy_page

        title, note = self.scene.title(self.heading), "\n".join(self.notes(words))
        return accuracy_page(self.contest, words, title, note, self.scene.hand, self.turns)


def accuracy_chart(scene: Scene, cycle: Cycle, names: Sequence[str], effort: Effort = FULL) -> AccuracyChart:
    """Let all methods compete.

    Raises
    ------
    InputError
        With the key `chart-no-rivals`: nothing that is wanted can be compared.
    """
    found = contest(cycle, len(cycle.angles), time.process_time, names, effort)
    if not found.kinds:
        raise InputError("chart-no-rivals")
    hands = tuple(_hands(scene, cycle, found))
    return AccuracyChart(scene, cycle.drive.turns, replace(found, entries=found.entries + hands))


def _hands(scene: Scene, cycle: Cycle, found: Contest) -> Iterator[Entry]:
    """Go through the errors of a hand on the sheets of all formats."""
    for name in SIZES:
        mus = _mus(scene, name)
        if mus is not None:
            drawn = DrawnSheet(name, linkage(scene.case.solved), mus)
            yield from by_hand(cycle, drawn, preset(scene.hand).hand, found.kinds)


def _mus(scene: Scene, name: str) -> Mapping[str, float] | None:
    """Return the scale factors, by plan, that a sheet of a format takes; None where there is no such sheet."""
    case = scene.case
    if case.solved.trouble is not None:
        return None
    try:
        scales = scales_of(case, scene.words, format_named(name))
    except InputError:  # too small for a plan, or for a scale factor that was asked for
        return None
    return {plan: scale.mu for plan, scale in scales.items()}


def machine(words: Words) -> str:
    """Return the machine and the versions on which times were measured."""
    return words["chart.machine"].format(
        machine=f"{platform.system()} {platform.machine()}",
        cores=os.cpu_count() or 1,
        python=platform.python_version(),
        numpy=np.__version__,
        version=__version__,
    )
