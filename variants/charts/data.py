"""What all charts share: the scene, what is asked, what a chart answers; the chart of speed against accuracy."""

from __future__ import annotations

import math
import os
import platform
import textwrap
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from ... import __version__
from ...drawing.charts.accuracy import accuracy_page
from ...drawing.words import Words
from ...plans.contest import Contest, Entry
from ...plans.hands.hand import PRESETS, Hand, preset
from ...plans.laws import TURN
from ...plans.linkages.cycles.cycle import Cycle
from ...scales.errors import InputError
from ...scales.numbers import quote
from ...scales.units import unit
from ..case import Case
from ..hands import is_own
from ..spreadsheets.cells_out import Cell, csv_bytes, csv_text
from ..tables import aligned

if TYPE_CHECKING:
    from matplotlib.figure import Figure

DIGITS = 3
LINE = 110  # characters
PERCENT = 100.0
PLACES = {"rad": ("place", "deg"), "m": ("place", "mm"), "s": ("t", "s")}  # in files: what they are called, their unit
HANDS: Mapping[str, Hand] = {name: found.hand for name, found in PRESETS.items()}
HEAD = ("method", "setting", "kind", "error", "typical", "quantity")  # errors in parts of the largest: without a unit
TIMES = ("seconds [s]", "at_once", "failed", "front")


@dataclass(frozen=True, slots=True)
class Scene:
    """The case of a chart, its words, the name of the hand that draws; cycles by their numbers of positions."""

    case: Case
    words: Words
    hand: str
    cycles: dict[int, Cycle] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Refuse a hand that nobody knows, and one of the user's own."""
        if is_own(self.hand):
            raise InputError("hand-chart", text=quote(self.hand), known=", ".join(PRESETS))
        preset(self.hand)

    def title(self, key: str) -> str:
        """Return the title of a chart."""
        task = self.case.task
        of = self.words["chart.variant"].format(title=task.title[self.words.language], variant=self.case.variant)
        return f"{self.words[key]}. {of}"


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Chart(ABC):
    """One chart of a variant: a table, rows, data, a picture; `heading` is the key of what it shows."""

    heading: ClassVar[str]
    scene: Scene

    @abstractmethod
    def table(self, words: Words) -> str:
        """Return it as text."""

    @abstractmethod
    def _rows(self) -> Iterable[Sequence[Cell]]:
        """Go through the rows of the CSV, the head first."""

    def csv(self, words: Words) -> bytes:
        """Return all its rows."""
        return csv_bytes(csv_text(self._rows(), words.language), words.language)

    @abstractmethod
    def to_json(self) -> dict[str, Any]:
        """Return it as data in SI."""

    @abstractmethod
    def _page(self, words: Words, title: str) -> Figure:
        """Draw the picture under a title."""

    def figure(self, words: Words) -> Figure:
        """Draw the picture."""
        return self._page(words, self.scene.title(self.heading))


@dataclass(frozen=True, slots=True)
class ChartRequest:
    """What is asked of charts: quantities (none: all), positions of the cycle (None: the chart's own), per cent."""

    quantities: tuple[str, ...]
    positions: int | None
    tolerance: float


@dataclass(frozen=True, slots=True)
class Gallery:
    """The charts that tasks of a kind have, which of them each argument changes, and what makes one by its name.

    `make` raises InputError where the case cannot have a chart, or no such quantity, PositionError where no position
    of a cycle can be assembled.
    """

    charts: tuple[str, ...]
    used_by: Mapping[str, tuple[str, ...]]
    make: Callable[[str, Scene, ChartRequest], Chart]


def place_value(of: str, at: float) -> float:
    """Return a place of the SI unit `of` in that of `place_column`, an angle within a turn."""
    value = unit(PLACES[of][1]).from_si(at)
    return float(round(value % 360.0, 9) % 360.0 if of == "rad" else value)


def place_column(of: str) -> str:
    """Return the head of a CSV's column with places of the SI unit `of`."""
    return "{} [{}]".format(*PLACES[of])


def place_si(of: str, at: float) -> float:
    """Return a place of the SI unit `of` for JSON, an angle in [0, 2 pi)."""
    return float(at % TURN % TURN if of == "rad" else at)  # -1e-17 % TURN is TURN


def short(words: Words, value: float | None, digits: int = DIGITS) -> str:
    """Return a number for a table, small ones with a power of ten; a dash for none."""
    if value is None or not math.isfinite(value):
        return "–"
    if value and not 1e-4 <= abs(value) < 1e6:
        return words.decimal(f"{value:.{digits - 1}e}")
    return words.short(value, digits)


def per_cent(part: float | None) -> float | None:
    """Return a part in per cent, None for none."""
    return None if part is None else PERCENT * part


def error_rows(
    label: str, settings: Sequence[str], errors: Iterable[Iterable[float]], last: Sequence[str], words: Words
) -> list[list[str]]:
    """Return rows of a table: errors in parts, a column for each quantity, as per cents for every setting.

    The label stands before the first of them, and at the end what is said `last`.
    """
    cells = ([short(words, PERCENT * float(error)) for error in row] for row in zip(*errors, strict=True))
    rows = [["", setting, *row] for setting, row in zip(settings, cells, strict=True)]
    rows[0][0] = label
    return [*rows, ["", *last]]


def wrapped(text: str) -> str:
    """Return a note as lines of a table's width."""
    return textwrap.fill(text, LINE)


def finite(value: float | None) -> float | None:
    """Return a number for JSON, None for what is not one."""
    return None if value is None or not math.isfinite(value) else float(value) + 0.0


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
