"""Columns of cams, gears, hoists as text: lengths in mm, angles in degrees, stresses in MPa, all else in SI."""

from __future__ import annotations

from collections.abc import Callable, Collection
from typing import Any

import numpy as np

from ...drawing.words import Words
from ...plans.columned import Columned, Ends
from ...scales.units import format_unit, unit
from ..tables import aligned

SHOWN = {"m": "mm", "rad": "deg", "Pa": "MPa"}
DIGITS, PLACES = 6, 9  # of a number in the table; decimals of the degrees of what drives
DRIVES = "phi"
NOTHING = 1e-9  # part of the largest value of a column below which one is rounding


def in_degrees_and_millimetres(column: Columned) -> Columned:
    """Return a column as it is shown."""
    shown = SHOWN.get(column.unit)
    if shown is None:
        return column
    to: Callable[[Any], Any] = unit(shown).from_si
    values = to(column.values)
    return Columned(column.name, shown, np.round(values, PLACES) if column.name == DRIVES else values)


def csv_head(shown: Collection[Columned], words: Words) -> list[str]:
    """Return the names of columns with their units."""
    return [f"{one.name} [{of}]" if (of := format_unit(one.unit, words.language)) else one.name for one in shown]


def column_table(found: Collection[Columned], heads: list[str], words: Words) -> str:
    """Return columns as a table, the heads of the rows before them, one that comes again but once."""
    shown = [in_degrees_and_millimetres(column) for column in found]
    rows = [["", *(_titled(column.name, column.unit, words) for column in shown)]]
    for k, head in enumerate(heads):
        rows.append([head if k == 0 or heads[k - 1] != head else "", *(_cell(column, k, words) for column in shown)])
    return aligned(rows, ())


def _titled(name: str, of: str, words: Words) -> str:
    spelled = format_unit(of, words.language)
    return f"{name}, {spelled}" if spelled else name


def _cell(column: Columned, k: int, words: Words) -> str:
    size = float(np.max(np.abs(column.values), initial=0.0, where=np.isfinite(column.values)))
    value = float(column.values[k])
    if np.isinf(value):
        return "−∞" if value < 0.0 else "∞"
    return words.short(0.0 if abs(value) <= NOTHING * size else value, DIGITS)


def extremes_table(found: Collection[Ends], words: Words) -> str:
    """Return the extremes of columns, and at which angles of what drives they are."""
    rows = [["", words["sweep.most"], "", words["sweep.least"], ""]]
    for one in found:
        shown = SHOWN.get(one.unit, one.unit)
        of = unit(shown)
        cells = [_titled(one.name, shown, words)]
        small = NOTHING * max(abs(one.most), abs(one.least))
        for value, at in ((one.most, one.most_at), (one.least, one.least_at)):
            tidy = 0.0 if abs(value) <= small else value
            cells += [words.short(of.from_si(tidy) + 0.0, DIGITS), f"{DRIVES} = {degrees(at, words)}"]
        rows.append(cells)
    return aligned(rows, (0, 2, 4))


def degrees(at: float, words: Words) -> str:
    """Return an angle in degrees."""
    return f"{words.short(round(unit('deg').from_si(at), 4), DIGITS)}°"
