"""The chart of speed against accuracy of one variant: rows, table, CSV, JSON, picture."""

from __future__ import annotations

import os
import platform
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from ... import __version__
from ...drawing.charts.accuracy import accuracy_page
from ...drawing.words import Words
from ...plans.contest import Contest, Entry
from ..spreadsheets.cells_out import Cell
from ..tables import aligned
from .data import Chart, finite, place_column, place_si, place_value, short, wrapped

if TYPE_CHECKING:
    from matplotlib.figure import Figure

HEAD = ("method", "setting", "kind", "error", "typical", "quantity")  # errors in parts of the largest: without a unit
TIMES = ("seconds [s]", "at_once", "failed", "front")


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class AccuracyChart(Chart):
    """Speed against accuracy: `contest` holds an entry for every method, setting and kind of quantities.

    `places` is the SI unit of the places of entries; `compared` is the key of what errors and times are.
    """

    heading: ClassVar[str] = "chart.accuracy"
    places: str
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

    def _rows(self) -> Iterator[tuple[Cell, ...]]:
        yield (*HEAD, place_column(self.places), *TIMES)
        for entry in self.contest.entries:
            item = self._item(entry)
            item |= {"at": place_value(self.places, entry.place), "front": int(item["front"])}
            yield tuple(item.values())

    def to_json(self) -> dict[str, Any]:
        """Return all entries as data."""
        return {
            "machine": machine(Words.of("en", self.scene.case.task.notation)),
            "hand": self.scene.hand,
            "places": [place_si(self.places, at) for at in self.contest.places],
            "entries": [self._item(entry) for entry in self.contest.entries],
        }

    def _item(self, entry: Entry) -> dict[str, Any]:
        """Return an entry as data, in the order of the columns of the CSV."""
        return {
            "method": entry.method,
            "setting": entry.setting,
            "kind": entry.kind,
            "error": finite(entry.error),
            "typical": finite(entry.typical),
            "quantity": entry.name,
            "at": place_si(self.places, entry.place),
            "seconds": finite(entry.seconds),
            "at_once": entry.at_once,
            "failed": entry.failed,
            "front": any(entry is one for one in self.contest.front(entry.kind)),
        }

    def _page(self, words: Words, title: str) -> Figure:
        return accuracy_page(self.contest, words, title, "\n".join(self.notes(words)), self.scene.hand, self.places)


def machine(words: Words) -> str:
    """Return the machine and the versions on which times were measured."""
    return words["chart.machine"].format(
        machine=f"{platform.system()} {platform.machine()}",
        cores=os.cpu_count() or 1,
        python=platform.python_version(),
        numpy=np.__version__,
        version=__version__,
    )
