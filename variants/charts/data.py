"""What all charts share: the case, its words, places of its cycle, how a number is shown."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from ...drawing.words import Words
from ...plans.hands.hand import PRESETS, preset
from ...plans.laws import TURN
from ...plans.linkages.cycles.cycle import Cycle
from ...scales.errors import InputError
from ...scales.numbers import quote
from ...scales.units import format_unit, unit
from ..case import Case
from ..hands import is_own
from ..spreadsheets.csv_write import Cell, csv_bytes, csv_text
from ..sweeps.columns import driver_name

DIGITS = 3
LINE = 110  # characters
PLACES = {"rad": ("place", "deg"), "m": ("place", "mm"), "s": ("t", "s")}  # in files: what they are called, their unit


@dataclass(frozen=True, slots=True)
class Scene:
    """The case of a chart, its words, and the name of the hand that draws."""

    case: Case
    words: Words
    hand: str

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


def place(cycle: Cycle, words: Words, at: float) -> str:
    """Return a place of the driver with its unit, an angle within a turn."""
    if cycle.drive.turns:
        return f"{words.number(round(math.degrees(at) % 360.0, 2) % 360.0, 2)}°"
    return f"{words.short(at * 1e3, 6)} {format_unit('mm', words.language)}"


def place_head(cycle: Cycle, words: Words) -> str:
    """Return the name of the driver's variable with its unit."""
    return f"{driver_name(cycle)}, {format_unit('deg' if cycle.drive.turns else 'mm', words.language)}"


def driver_unit(cycle: Cycle) -> str:
    """Return the SI unit of the driver's places."""
    return "rad" if cycle.drive.turns else "m"


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


def wrapped(text: str) -> str:
    """Return a note as lines of a table's width."""
    return textwrap.fill(text, LINE)


def as_csv(head: Sequence[str], rows: Iterable[Sequence[Cell]], words: Words) -> bytes:
    """Return rows as the CSV file of a chart."""
    return csv_bytes(csv_text([head, *rows], words.language), words.language)


def finite(value: float | None) -> float | None:
    """Return a number for JSON, None for what is not one."""
    return None if value is None or not math.isfinite(value) else float(value) + 0.0
